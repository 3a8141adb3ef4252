//! `bindgen [--quick] [--named] [--rest LIST | --followed] PAGE.wasm FOLDER [FILE…]`: writes the module `PAGE.js` and
//! its `PAGE_bg.wasm` into the folder, and beside them, compressed by brotli as `NAME.br`, these two and further files.
//! `--quick` compresses them little; `--named` keeps the names of functions for whoever looks where time goes, a sixth
//! of the module. `--rest` leaves the functions of a list to `PAGE_rest.wasm`, and the data that only they name;
//! `--followed` has the module mark which of them are called, and writes to `PAGE.functions` where, and their keys.

mod data;
mod order;
mod split;

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{fs, io};

use wasm_bindgen_cli_support::Bindgen;

const USAGE: &str =
    "bindgen [--quick] [--named] [--rest LIST | --followed] PAGE.wasm FOLDER [FILE…]";

/// What becomes of the module that bindgen makes.
enum Then {
    AsItIs,
    Divided(BTreeSet<u32>),
    Followed,
}

struct Wish {
    quality: u32,
    is_named: bool,
    then: Then,
    page: PathBuf,
    folder: PathBuf,
    further: Vec<PathBuf>,
}

fn main() -> ExitCode {
    match parsed().and_then(|wish| run(&wish)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(io::stderr(), "bindgen: {error}");
            ExitCode::FAILURE
        }
    }
}

fn parsed() -> Result<Wish, String> {
    let mut arguments = std::env::args().skip(1).peekable();
    let mut is_asked = |option: &str| arguments.next_if(|first| first == option).is_some();
    let quality = if is_asked("--quick") { QUICK } else { QUALITY };
    let is_named = is_asked("--named");
    let then = if is_asked("--followed") {
        Then::Followed
    } else if is_asked("--rest") {
        let list = arguments.next().ok_or(USAGE)?;
        let text = fs::read_to_string(&list).map_err(|error| format!("{list}: {error}"))?;
        Then::Divided(split::keys(&text))
    } else {
        Then::AsItIs
    };
    let mut path = || arguments.next().map(PathBuf::from).ok_or(USAGE);
    let (page, folder) = (path()?, path()?);
    Ok(Wish {
        quality,
        is_named,
        then,
        page,
        folder,
        further: arguments.map(PathBuf::from).collect(),
    })
}

fn run(wish: &Wish) -> Result<(), String> {
    let name = wish.page.file_stem().ok_or(USAGE)?.to_string_lossy();
    let keeps_names = wish.is_named || !matches!(wish.then, Then::AsItIs);
    // Without the default path the module cannot find its own .wasm.
    Bindgen::new()
        .input_path(&wish.page)
        .out_name(&name)
        .typescript(false)
        .remove_name_section(!keeps_names)
        // by the linker's names one function is told from another
        .demangle(matches!(wish.then, Then::AsItIs))
        .remove_producers_section(true)
        .omit_default_module_path(false)
        .web(true)
        .and_then(|bindgen| bindgen.generate(&wish.folder))
        .map_err(|error| format!("{error:#}"))?;
    let beside = |end: &str| wish.folder.join(format!("{name}{end}"));
    let module = beside("_bg.wasm");
    let told = |error: io::Error| error.to_string();
    let mut files = vec![module.clone(), beside(".js")];
    match &wish.then {
        Then::AsItIs => {}
        Then::Divided(rest) => {
            let linked = fs::read(&wish.page).map_err(told)?;
            let module = fs::read(&module).map_err(told)?;
            let parts = split::split(&module, &linked, rest, wish.is_named)?;
            fs::write(beside("_bg.wasm"), parts.first).map_err(told)?;
            files.push(beside("_rest.wasm"));
            fs::write(beside("_rest.wasm"), parts.rest).map_err(told)?;
        }
        Then::Followed => {
            let followed = split::follow(&fs::read(&module).map_err(told)?)?;
            let mut list = followed.address.to_string();
            for key in followed.keys {
                // a String takes all that is written
                let _ = write!(list, "\n{key:08x}");
            }
            fs::write(&module, followed.module).map_err(told)?;
            fs::write(beside(".functions"), list).map_err(told)?;
        }
    }
    // who looks at a module's names or marks wants it as it was made
    if !wish.is_named && !matches!(wish.then, Then::Followed) {
        for module in files.iter().filter(|file| file.extension().is_some_and(|e| e == "wasm")) {
            fs::write(module, order::ordered(&fs::read(module).map_err(told)?)?).map_err(told)?;
        }
    }
    let mut all = files.iter().chain(&wish.further);
    all.try_for_each(|file| compress(file, &wish.folder, wish.quality)).map_err(told)
}

/// How hard the compressor tries, and how far back it looks, as a power of two. The hardest gains a twenty-fifth.
const QUALITY: u32 = 11;
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
