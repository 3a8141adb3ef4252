//! The page's bundle: crates/web compiled for the browser, its JavaScript module, and the files of
//! crates/web/assets, all in `dist/`; and the `thinglab` command that carries them.
//!
//! What is up to date is left alone, down to the modification times in `dist/`.

use std::collections::BTreeMap;
use std::io::{self, IsTerminal as _};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs};

use crate::compiled::{self, Made};
use crate::tools::{self, WasmCompiler};
use crate::{say, top};

/// How much a compiler does for speed and size.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Effort {
    /// What people get: the rooms compiled as one.
    Full,
    /// For the browser tests: compiled room by room, a large page that runs slower.
    Tests,
    /// For trying a change: as for the tests, and what is compiled is kept in pieces.
    Quick,
    /// As people get it, but undivided; its functions mark that they have been called.
    Followed,
}

impl Effort {
    /// The page's profile in Cargo.toml.
    fn page_profile(self) -> &'static str {
        match self {
            Effort::Full | Effort::Followed => "wasm-release",
            Effort::Tests => "wasm-tests",
            Effort::Quick => "wasm-quick",
        }
    }
}

/// Builds `dist/`; gives what was taken down of its making, as [`module`] does.
///
/// # Errors
/// A sentence that says which step failed; the step's own messages are on the terminal.
pub(crate) fn build(compiler: &WasmCompiler, effort: Effort) -> Result<Option<Made>, String> {
    let (module, made) = module("web", compiler, effort)?;
    let files = page_files(&module).and_then(|files| synchronise(&top().join("dist"), &files));
    let size = files.map_err(|error| format!("dist/ could not be written: {error}"))?;
    say!("page: {} kB in dist/", size / 1000);
    Ok(made)
}

/// The files of the assets that are worth compressing.
const COMPRESSED: [&str; 7] =
    ["codemirror.js", "host.js", "page.js", "painter.js", "rest.js", "stamps.js", "style.css"];

/// Which functions of the page come after a first drag; `cargo run -p xtask -- figures rest` writes it.
pub(crate) fn rest() -> PathBuf {
    top().join("crates/web/rest.txt")
}

/// Compiles a package's program of the same name for the browser; gives the folder of its module: `NAME.js`, and
/// `NAME_bg.wasm` that it loads. For the tests it is taken down what was made, and the package is linted where the
/// toolchain has a linter.
///
/// # Errors
/// As [`build`].
pub(crate) fn module(
    package: &str,
    compiler: &WasmCompiler,
    effort: Effort,
) -> Result<(PathBuf, Option<Made>), String> {
    say!("page: compiling {package} (minutes the first time)");
    let profile = effort.page_profile();
    let made = target().join("wasm32-unknown-unknown").join(profile).join(package);
    let made = made.with_extension("wasm");
    let wasm = compile(package, compiler, effort)?;
    let folder = if effort == Effort::Followed { "followed" } else { profile };
    let module = target().join("bindgen").join(folder).join(package);
    let is_divided = is_divided(package, effort);
    let compressed = COMPRESSED.map(|name| top().join("crates/web/assets").join(name));
    let is_stale =
        |(name, file): (&str, &PathBuf)| is_older(&module.join(format!("{name}.br")), file);
    let code = module.join(format!("{package}_bg.wasm"));
    if is_older(&code, &made)
        || is_divided && is_older(&code, &rest())
        || COMPRESSED.into_iter().zip(&compressed).any(is_stale)
    {
        say!("page: making its module");
        // the tests may be compiled meanwhile, in the other folder
        let mut bindgen = tools::cargo(&["run", "--package", "bindgen", "--target-dir"]);
        if effort == Effort::Tests {
            tools::lint(&mut bindgen).env("CLIPPY_ARGS", "--deny__CLIPPY_HACKERY__warnings");
        }
        bindgen.arg(target()).arg("--");
        match effort {
            Effort::Full => {}
            // a smaller module is read sooner, for each page anew
            Effort::Tests => _ = bindgen.arg("--quick"),
            Effort::Quick => _ = bindgen.args(["--quick", "--named"]),
            Effort::Followed => _ = bindgen.args(["--quick", "--followed"]),
        }
        if is_divided {
            bindgen.arg("--rest").arg(rest());
        }
        bindgen.arg(&made).arg(&module).args(&compressed);
        run("the page's module was not made", quiet(&mut bindgen))?;
    }
    Ok((module, wasm))
}

/// Whether a package's module comes in two parts.
fn is_divided(package: &str, effort: Effort) -> bool {
    package == "web" && matches!(effort, Effort::Full | Effort::Tests)
}

fn compile(package: &str, compiler: &WasmCompiler, effort: Effort) -> Result<Option<Made>, String> {
    let failure = "the page did not compile";
    let mut command = compile_command(package, compiler, effort);
    let told_rustc = told_rustc(package, effort);
    if effort != Effort::Tests {
        return run(failure, command.args(told_rustc)).map(|()| None);
    }
    if *compiler == WasmCompiler::Toolchain {
        // the rooms below are linted where they are compiled for this machine
        tools::lint(&mut command).env("CLIPPY_ARGS", "--no-deps__CLIPPY_HACKERY__");
    }
    let made = compiled::follow(&mut command, &told_rustc);
    if made.is_whole { Ok(Some(made)) } else { Err(String::from(failure)) }
}

/// The packages that are compiled for this machine. Cargo chooses the features of libraries for all of a command's
/// packages, and another choice would compile the rooms once more.
pub(crate) const NATIVE: [&str; 5] = ["--workspace", "--exclude", "bindgen", "--exclude", "web"];

/// Builds the command out of a selection of packages; gives its path. It is told where the page is: `serve --page`.
///
/// # Errors
/// As [`build`].
pub(crate) fn build_command(effort: Effort, selection: &[&str]) -> Result<PathBuf, String> {
    say!("thinglab: compiling");
    let mut command = tools::cargo(&["build", "--bin", "thinglab"]);
    command.args(selection);
    if effort == Effort::Tests {
        tools::lint(&mut command);
    }
    run("thinglab did not compile", quiet(&mut command))?;
    let target =
        env::var_os("CARGO_TARGET_DIR").map_or_else(|| top().join("target"), PathBuf::from);
    Ok(top().join(target).join("debug").join(format!("thinglab{}", env::consts::EXE_SUFFIX)))
}

/// The page has a target folder of its own: two compilers in one would undo each other's work.
fn target() -> PathBuf {
    top().join("target-web")
}

fn compile_command(package: &str, compiler: &WasmCompiler, effort: Effort) -> Command {
    let mut command = match compiler {
        WasmCompiler::Toolchain => tools::cargo(&["rustc"]),
        WasmCompiler::Debian { linker } => debian_cargo(linker),
    };
    command.args(["--package", package, "--bin", package, "--profile", effort.page_profile()]);
    command.args(["--target", "wasm32-unknown-unknown", "--target-dir"]).arg(target());
    quiet(&mut command);
    command
}

/// What the compiler of the page itself, not of what it is made of, is told; behind all that cargo is.
fn told_rustc(package: &str, effort: Effort) -> Vec<&'static str> {
    let mut told = vec!["--"];
    if matches!(effort, Effort::Full | Effort::Followed) {
        // what leads to a message (`#[cold]`) becomes a function of its own, which comes after a first drag
        told.push("-Cllvm-args=-hot-cold-split -hotcoldsplit-max-params=12");
    }
    if is_divided(package, effort) {
        // by these is told which data come after it, too
        told.push("-Clink-arg=--emit-relocs");
    }
    told
}

/// Debian's cargo and rustc, free of what the toolchain that runs us has put into the environment;
/// the standard library is built from source, which a stable compiler does only when told so.
fn debian_cargo(linker: &Path) -> Command {
    let mut command = Command::new("/usr/bin/cargo");
    command.args(["rustc", "-Z", "build-std=std,panic_abort"]).current_dir(top());
    let kept = ["CARGO_HOME", "CARGO_HTTP_", "CARGO_NET_", "CARGO_REGISTR", "CARGO_TERM_"];
    for (name, _) in env::vars_os() {
        let name = name.to_string_lossy();
        let ours = name.starts_with("CARGO") || name.starts_with("RUST");
        if ours && !kept.iter().any(|prefix| name.starts_with(prefix)) {
            command.env_remove(&*name);
        }
    }
    command
        .env("PATH", "/usr/bin:/bin")
        .env("RUSTC", "/usr/bin/rustc")
        .env("RUSTC_BOOTSTRAP", "1")
        .env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", linker);
    command
}

/// Cargo draws a bar on a terminal, and is silent elsewhere.
fn quiet(command: &mut Command) -> &mut Command {
    command.env("CARGO_TERM_QUIET", if io::stderr().is_terminal() { "false" } else { "true" })
}

fn run(failure: &str, command: &mut Command) -> Result<(), String> {
    match command.stdin(Stdio::null()).status() {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err(String::from(failure)),
        Err(error) => Err(format!("{failure}: {error}")),
    }
}

/// Whether a file is missing or was made before another.
fn is_older(file: &Path, than: &Path) -> bool {
    let time = |path: &Path| fs::metadata(path).and_then(|found| found.modified());
    match (time(file), time(than)) {
        (Ok(file), Ok(than)) => file < than,
        (Err(_), _) | (_, Err(_)) => true,
    }
}

/// The files of the page by their names: the module's, and those that lie directly in the assets
/// (its folders hold sources).
fn page_files(module: &Path) -> io::Result<BTreeMap<String, Vec<u8>>> {
    let mut files = BTreeMap::new();
    for folder in [top().join("crates/web/assets"), module.to_path_buf()] {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            if path.is_file() {
                let name = path.file_name().expect("listed by name").to_string_lossy().into_owned();
                files.insert(name, fs::read(&path)?);
            }
        }
    }
    Ok(files)
}

/// Makes a folder hold exactly these files, writing only what differs; gives their size in bytes.
fn synchronise(folder: &Path, files: &BTreeMap<String, Vec<u8>>) -> io::Result<usize> {
    fs::create_dir_all(folder)?;
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if !files.contains_key(&*entry.file_name().to_string_lossy()) {
            fs::remove_file(entry.path())?;
        }
    }
    for (name, bytes) in files {
        let path = folder.join(name);
        if fs::read(&path).ok().as_ref() != Some(bytes) {
            fs::write(&path, bytes)?;
        }
    }
    Ok(files.values().map(Vec::len).sum())
}
