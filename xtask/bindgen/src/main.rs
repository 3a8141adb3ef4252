//! `bindgen PAGE.wasm FOLDER`: writes the module `PAGE.js` and its `PAGE_bg.wasm` into the folder.

use std::io::Write as _;
use std::path::Path;
use std::process::ExitCode;

use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let (Some(page), Some(folder)) = (arguments.next(), arguments.next()) else {
        let _ = writeln!(std::io::stderr(), "bindgen PAGE.wasm FOLDER");
        return ExitCode::from(2);
    };
    let name = Path::new(&page).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let mut bindgen = Bindgen::new();
    // Without the default path the module cannot find its own .wasm.
    let result = bindgen
        .input_path(&page)
        .out_name(&name.unwrap_or_default())
        .typescript(false)
        .remove_name_section(true)
        .remove_producers_section(true)
        .omit_default_module_path(false)
        .web(true)
        .and_then(|bindgen| bindgen.generate(folder));
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "bindgen: {error:#}");
            ExitCode::FAILURE
        }
    }
}
