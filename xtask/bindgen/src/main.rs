//! `bindgen [--quick] [--named] PAGE.wasm FOLDER [FILE…]`: writes the module `PAGE.js` and its `PAGE_bg.wasm` into the
//! folder, and beside them, compressed by brotli as `NAME.br`, these two and further files. `--quick` compresses
//! them little; `--named` keeps the names of functions for whoever looks where time goes, a sixth of the module.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{fs, io};

use wasm_bindgen_cli_support::Bindgen;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1).peekable();
    let quality = match arguments.next_if(|first| first == "--quick") {
        Some(_) => QUICK,
        None => QUALITY,
    };
    let is_named = arguments.next_if(|first| first == "--named").is_some();
    let (Some(page), Some(folder)) = (arguments.next(), arguments.next()) else {
        let _ = writeln!(io::stderr(), "bindgen [--quick] [--named] PAGE.wasm FOLDER [FILE…]");
        return ExitCode::from(2);
    };
    let name = Path::new(&page).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let mut bindgen = Bindgen::new();
    // Without the default path the module cannot find its own .wasm.
    let result = bindgen
        .input_path(&page)
        .out_name(&name.unwrap_or_default())
        .typescript(false)
        .remove_name_section(!is_named)
        .remove_producers_section(true)
        .omit_default_module_path(false)
        .web(true)
        .and_then(|bindgen| bindgen.generate(&folder));
    let stem = Path::new(&page).file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let made = ["_bg.wasm", ".js"].map(|end| {
        Path::new(&folder).join(format!("{}{end}", stem.as_deref().unwrap_or_default()))
    });
    let further: Vec<PathBuf> = arguments.map(PathBuf::from).collect();
    let written = result.map_err(|error| format!("{error:#}")).and_then(|()| {
        let mut all = made.iter().chain(&further);
        all.try_for_each(|file| compress(file, Path::new(&folder), quality))
            .map_err(|error| error.to_string())
    });
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(io::stderr(), "bindgen: {error}");
            ExitCode::FAILURE
        }
    }
}

/// How hard the compressor tries, and how far back it looks, as a power of two: hard enough that more gains
/// less than a hundredth.
const QUALITY: u32 = 10;
const QUICK: u32 = 1;
const WINDOW: u32 = 24;

/// Writes a file compressed into a folder, under its name with `.br`.
fn compress(file: &Path, folder: &Path, quality: u32) -> io::Result<()> {
    let name = file.file_name().map(|name| name.to_string_lossy().into_owned());
    let mut out = Vec::new();
    let mut writer = brotli::CompressorWriter::new(&mut out, 1 << 16, quality, WINDOW);
    writer.write_all(&fs::read(file)?)?;
    drop(writer);
    fs::write(folder.join(format!("{}.br", name.unwrap_or_default())), out)
}
