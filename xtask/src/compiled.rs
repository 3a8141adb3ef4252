//! What cargo makes of a selection of packages: the artifacts that it tells of, and whether the linter complained.

use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::{say, tools};

/// What one command of cargo's made.
#[derive(Debug, Default)]
pub(crate) struct Made {
    /// Everything was compiled.
    pub(crate) is_whole: bool,
    /// Nobody complained.
    pub(crate) is_clean: bool,
    /// In the order in which cargo tells of them.
    pub(crate) artifacts: Vec<Artifact>,
    /// Where build scripts wrote: the package's folder, theirs.
    pub(crate) written: Vec<(PathBuf, PathBuf)>,
}

/// A library or a program.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Artifact {
    /// `lib`, `proc-macro`, `bin`, `test`.
    pub(crate) kind: String,
    pub(crate) name: String,
    /// The package's folder.
    pub(crate) package: PathBuf,
    /// The package's version.
    pub(crate) version: Vec<u64>,
    /// The file that the compiler began with.
    pub(crate) source: PathBuf,
    pub(crate) edition: String,
    /// Programs are linked with it, rather than build scripts and procedural macros: by these profiles in Cargo.toml,
    /// overflows are checked in it.
    pub(crate) is_of_programs: bool,
    /// Its tests were compiled with it.
    pub(crate) is_test: bool,
    /// The library that others are compiled with.
    pub(crate) library: Option<PathBuf>,
    pub(crate) executable: Option<PathBuf>,
}

impl Made {
    /// The path of a program.
    pub(crate) fn executable(&self, kind: &str, name: &str) -> Option<PathBuf> {
        let mut found = self.artifacts.iter().filter(|a| a.kind == kind && a.name == name);
        found.find_map(|artifact| artifact.executable.clone())
    }
}

/// Compiles the tests of a selection of packages by a cargo, and lints them; narrowed to some targets by `which`.
pub(crate) fn make(cargo: fn(&[&str]) -> Command, which: &[&str], selection: &[&str]) -> Made {
    let mut cargo = cargo(&["test", "--quiet", "--no-run"]);
    follow(tools::lint(cargo.args(which).args(selection)), &[])
}

/// Runs a command of cargo's and takes down what it made. What the compiler and the linter say is shown; to the last
/// compiler it is said what is `told_rustc`.
pub(crate) fn follow(cargo: &mut Command, told_rustc: &[&str]) -> Made {
    cargo.arg("--message-format=json-render-diagnostics").args(told_rustc);
    // lines begin with what they are, not with a colour
    cargo.env("CARGO_TERM_COLOR", "never");
    cargo.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = match cargo.spawn() {
        Ok(child) => child,
        Err(error) => {
            say!("{} cannot be started: {error}", cargo.get_program().display());
            return Made::default();
        }
    };
    let (told, said) = (child.stdout.take().expect("piped"), child.stderr.take().expect("piped"));
    let complaints = std::thread::spawn(move || {
        let mut is_clean = true;
        for line in BufReader::new(said).lines().map_while(Result::ok) {
            is_clean &= !line.starts_with("warning") && !line.starts_with("error");
            say!("{line}");
        }
        is_clean
    });
    let mut made = Made::default();
    for line in BufReader::new(told).lines().map_while(Result::ok) {
        made.artifacts.extend(artifact(&line));
        made.written.extend(written(&line));
    }
    made.is_clean = complaints.join().unwrap_or(false);
    made.is_whole = child.wait().is_ok_and(|status| status.success());
    made
}

/// What a line of cargo's JSON tells of an artifact.
fn artifact(line: &str) -> Option<Artifact> {
    let is_one = line.contains(r#""reason":"compiler-artifact""#);
    let (_, target) = line.split_once(r#""target":{"kind":[""#).filter(|_| is_one)?;
    let (_, files) = line.split_once(r#""filenames":["#)?;
    let (files, _) = files.split_once(']')?;
    let library = |file: &&str| {
        [".rlib", ".so", ".dylib", ".dll"].iter().any(|ending| file.ends_with(ending))
    };
    Some(Artifact {
        kind: target.split_once('"')?.0.into(),
        name: text(target, "name")?,
        package: Path::new(&text(line, "manifest_path")?).parent()?.into(),
        version: version(&text(line, "package_id")?),
        source: text(target, "src_path")?.into(),
        edition: text(target, "edition")?,
        is_of_programs: line.contains(r#""overflow_checks":true"#),
        is_test: line.contains(r#""test":true},"features""#),
        library: files.split('"').find(library).map(|file| unescaped(file).into()),
        executable: text(line, "executable").map(PathBuf::from),
    })
}

/// The version that a package's name ends with, `…#serde@1.0.229` or `…#0.1.0`.
fn version(id: &str) -> Vec<u64> {
    let last = id.rsplit(['#', '@']).next().unwrap_or_default();
    last.split('.').map_while(|number| number.parse().ok()).collect()
}

/// What a line of cargo's JSON tells of a build script.
fn written(line: &str) -> Option<(PathBuf, PathBuf)> {
    let is_one = line.contains(r#""reason":"build-script-executed""#);
    let id = text(line, "package_id").filter(|_| is_one)?;
    let folder = id.strip_prefix("path+file://")?.split('#').next()?;
    Some((folder.into(), text(line, "out_dir")?.into()))
}

/// The text under the first key of a name.
fn text(json: &str, key: &str) -> Option<String> {
    let (_, value) = json.split_once(&format!("\"{key}\":\""))?;
    Some(unescaped(value.split_once('"')?.0))
}

/// The only escapes in paths: backslashes.
fn unescaped(text: &str) -> String {
    text.replace(r"\\", r"\")
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIBRARY: &str = r#"{"reason":"compiler-artifact","package_id":"path+file:///t/crates/base#0.1.0","manifest_path":"/t/crates/base/Cargo.toml","target":{"kind":["lib"],"crate_types":["lib"],"name":"base","src_path":"/t/crates/base/src/lib.rs","edition":"2024","doc":true,"doctest":true,"test":true},"profile":{"opt_level":"1","debuginfo":"line-tables-only","debug_assertions":true,"overflow_checks":true,"test":false},"features":[],"filenames":["/t/target/debug/deps/libbase-1.rlib","/t/target/debug/deps/libbase-1.rmeta"],"executable":null,"fresh":true}"#;

    #[test]
    fn a_library_is_read_from_what_cargo_tells() {
        let base = artifact(LIBRARY).unwrap();
        assert_eq!((base.kind.as_str(), base.name.as_str(), base.is_test), ("lib", "base", false));
        assert_eq!(base.package, Path::new("/t/crates/base"));
        assert_eq!(base.library.as_deref(), Some(Path::new("/t/target/debug/deps/libbase-1.rlib")));
        assert_eq!((base.executable, base.version), (None, vec![0, 1, 0]));
        assert_eq!(version("registry+https://crates#serde@1.0.229"), [1, 0, 229]);
    }

    #[test]
    fn a_program_is_found_by_kind_and_name() {
        let line = LIBRARY.replace("\"test\":false}", "\"test\":true}");
        let line = line.replace("[\"lib\"]", "[\"test\"]").replace("\"base\"", "\"lab\"");
        let line = line.replace("\"executable\":null", r#""executable":"C:\\target\\lab-1""#);
        let made = Made { artifacts: vec![artifact(&line).unwrap()], ..Made::default() };
        assert!(made.artifacts[0].is_test);
        assert_eq!(made.executable("test", "lab"), Some(PathBuf::from(r"C:\target\lab-1")));
        assert_eq!(made.executable("lib", "lab"), None);
    }

    #[test]
    fn a_build_scripts_folder_is_its_packages() {
        let line = r#"{"reason":"build-script-executed","package_id":"path+file:///t/crates/cli#0.1.0","linked_libs":[],"out_dir":"/t/target/debug/build/cli-1/out"}"#;
        let found = ("/t/crates/cli".into(), "/t/target/debug/build/cli-1/out".into());
        assert_eq!(written(line), Some(found));
        assert_eq!(written(LIBRARY), None);
    }
}
