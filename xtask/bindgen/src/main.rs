//! `bindgen [--quick] [--named] [--split LATER | --counted] PAGE.wasm FOLDER [FILE…]`: writes the module `PAGE.js` and
//! its `PAGE_bg.wasm` into the folder, and beside them, compressed by brotli as `NAME.br`, these two and further files.
//! `--quick` compresses them little; `--named` keeps the names of functions for whoever looks where time goes, a sixth
//! of the module. `--split` puts what the lines of a file name into a second module, `PAGE_rest.wasm`. `--counted` has
//! each function note that it was called, and writes their names into `PAGE.names`: lines for that file come of it.

mod split;

use std::collections::BTreeSet;
use std::io::Write as _;
use std::ops::Bound;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, fs, io};

use wasm_bindgen_cli_support::Bindgen;

/// What is said where the arguments are others.
const USAGE: &str =
    "bindgen [--quick] [--named] [--split LATER | --counted] PAGE.wasm FOLDER [FILE…]";

/// What the command line asks for.
struct Wish {
    quality: u32,
    is_named: bool,
    /// The file that says what goes into a second module.
    later: Option<PathBuf>,
    is_counted: bool,
    page: PathBuf,
    folder: PathBuf,
    further: Vec<PathBuf>,
}

fn main() -> ExitCode {
    let Some(wish) = Wish::of(env::args().skip(1)) else {
        let _ = writeln!(io::stderr(), "{USAGE}");
        return ExitCode::from(2);
    };
    match wish.granted() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(io::stderr(), "bindgen: {error}");
            ExitCode::FAILURE
        }
    }
}

impl Wish {
    fn of(arguments: impl Iterator<Item = String>) -> Option<Self> {
        let mut arguments = arguments.peekable();
        let mut is_said = |option: &str| arguments.next_if(|next| next == option).is_some();
        let quality = if is_said("--quick") { QUICK } else { QUALITY };
        let (is_named, is_split) = (is_said("--named"), is_said("--split"));
        let later = if is_split { Some(PathBuf::from(arguments.next()?)) } else { None };
        let is_counted = arguments.next_if(|next| next == "--counted").is_some();
        let (page, folder) = (arguments.next()?.into(), arguments.next()?.into());
        let further = arguments.map(PathBuf::from).collect();
        Some(Self { quality, is_named, later, is_counted, page, folder, further })
    }

    fn granted(&self) -> Result<(), String> {
        let stem = self.page.file_stem().unwrap_or_default().to_string_lossy();
        let is_told_by_names = self.later.is_some() || self.is_counted;
        // Without the default path the module cannot find its own .wasm.
        Bindgen::new()
            .input_path(&self.page)
            .out_name(&stem)
            .typescript(false)
            .remove_name_section(!self.is_named && !is_told_by_names)
            .remove_producers_section(true)
            .omit_default_module_path(false)
            .web(true)
            .and_then(|bindgen| bindgen.generate(&self.folder))
            .map_err(|error| format!("{error:#}"))?;
        let file = |end: &str| self.folder.join(format!("{stem}{end}"));
        let mut made = vec![file("_bg.wasm"), file(".js")];
        let said = |error: io::Error| error.to_string();
        let read = || fs::read(&made[0]).map_err(said);
        if let Some(later) = &self.later {
            let later = Later::read(&fs::read_to_string(later).map_err(said)?);
            let split = split::split(&read()?, &|name| later.has(name))?;
            fs::write(&made[0], split.first).map_err(said)?;
            let rest = file("_rest.wasm");
            fs::write(&rest, split.rest).map_err(said)?;
            made.push(rest);
        } else if self.is_counted {
            let (module, names) = split::counted(&read()?)?;
            fs::write(&made[0], module).map_err(said)?;
            fs::write(file(".names"), names).map_err(said)?;
        }
        let mut all = made.iter().chain(&self.further);
        all.try_for_each(|file| compress(file, &self.folder, self.quality)).map_err(said)
    }
}

/// What a page does not need at first: how the names of functions begin.
struct Later(BTreeSet<String>);

impl Later {
    fn read(text: &str) -> Self {
        let is_said = |line: &&str| !line.is_empty() && !line.starts_with('#');
        Self(text.lines().map(str::trim_end).filter(is_said).map(String::from).collect())
    }

    /// Returns true for the name of a function that begins as a line does: `<a::B as Debug>::fmt` begins with `a::`.
    fn has(&self, name: &str) -> bool {
        let name = name.trim_start_matches('<');
        let upto = self.0.range::<str, _>((Bound::Unbounded, Bound::Included(name)));
        // lines that begin with another line say nothing
        upto.rev().next().is_some_and(|line| name.starts_with(line.as_str()))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_names_all_functions_that_begin_with_it() {
        let later = Later::read("# why\nplan::conflict::\nweb::plot\n");
        let has = ["plan::conflict::find", "<web::plot::Plot as Drop>::drop", "web::plot"];
        let not = ["plan::conflict", "plan::find", "web::plan", "core::web::plot"];
        assert!(has.iter().all(|name| later.has(name)));
        assert!(not.iter().all(|name| !later.has(name)));
    }
}
