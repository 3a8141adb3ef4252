//! The documentation of the workspace's packages, by rustdoc beside what was compiled for the tests: `cargo doc` would
//! compile every library once more, for itself alone.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::{Command, Stdio};

use crate::compiled::{Artifact, Made};
use crate::{say, tools, top};

/// Writes it to `target/doc`; gives whether nobody complained.
pub(crate) fn write(made: &Made) -> bool {
    let libraries = libraries(made.artifacts.iter());
    let mut is_clean = made.is_whole;
    for artifact in documented(made) {
        is_clean &= is_written(artifact, rustdoc(artifact, &libraries, made));
    }
    is_clean
}

/// Writes that of a package that was compiled for the browser, beside the others.
pub(crate) fn write_for_the_browser(package: &str, made: &Made) -> bool {
    // procedural macros run here, and what they are made of is compiled for this machine too
    let is_there = |file: &Path| file.components().any(|part| part.as_os_str() == tools::WASM);
    let those = made.artifacts.iter().filter(|artifact| {
        artifact.kind == "proc-macro" || artifact.library.as_deref().is_some_and(is_there)
    });
    let libraries = libraries(those);
    let own = made.artifacts.iter().find(|a| a.kind == "lib" && a.name == package);
    own.is_some_and(|artifact| {
        let mut rustdoc = rustdoc(artifact, &libraries, made);
        rustdoc.args(["--target", tools::WASM]);
        is_written(artifact, rustdoc)
    })
}

fn is_written(artifact: &Artifact, mut rustdoc: Command) -> bool {
    let passed = rustdoc.status().is_ok_and(|status| status.success());
    if !passed {
        say!("documentation of {} failed", artifact.name);
    }
    passed
}

/// One of each: the libraries of the workspace, and the programs of packages that have none.
fn documented(made: &Made) -> Vec<&Artifact> {
    let own = |a: &&Artifact| a.package.starts_with(top());
    let has_library =
        |package: &Path| made.artifacts.iter().any(|a| a.kind == "lib" && a.package == package);
    let mut found: BTreeMap<&Path, &Artifact> = BTreeMap::new();
    for artifact in made.artifacts.iter().filter(own) {
        if artifact.kind == "lib" || (artifact.kind == "bin" && !has_library(&artifact.package)) {
            found.insert(&artifact.source, artifact);
        }
    }
    found.into_values().collect()
}

/// The libraries to compile with, by name. Of several it is the newest that programs are linked with, rather than build
/// scripts and procedural macros.
fn libraries<'made>(
    artifacts: impl Iterator<Item = &'made Artifact>,
) -> BTreeMap<String, &'made Path> {
    let mut found: BTreeMap<String, &Artifact> = BTreeMap::new();
    let rank = |a: &Artifact| (a.is_of_programs, a.version.clone());
    for artifact in artifacts.filter(|a| !a.is_test && a.library.is_some()) {
        let best = found.entry(artifact.name.replace('-', "_")).or_insert(artifact);
        if rank(artifact) > rank(best) {
            *best = artifact;
        }
    }
    found.into_iter().filter_map(|(name, a)| Some((name, a.library.as_deref()?))).collect()
}

fn rustdoc(artifact: &Artifact, libraries: &BTreeMap<String, &Path>, made: &Made) -> Command {
    let mut command = Command::new(tools::rustdoc());
    command.current_dir(&artifact.package).stdin(Stdio::null());
    command.args([
        "--deny",
        "warnings",
        "--edition",
        &artifact.edition,
        "--crate-type",
        &artifact.kind,
    ]);
    command.args(["--crate-name", &artifact.name.replace('-', "_")]);
    if artifact.kind == "bin" {
        command.args(["--document-private-items", "--allow", "rustdoc::private_intra_doc_links"]);
    }
    command.arg("--out-dir").arg(top().join("target/doc"));
    let folders: BTreeSet<_> = libraries.values().filter_map(|library| library.parent()).collect();
    for folder in folders {
        command.arg("-L").arg(format!("dependency={}", folder.display()));
    }
    for (name, library) in libraries {
        command.arg("--extern").arg(format!("{name}={}", library.display()));
    }
    // as cargo tells procedural macros
    let version: Vec<String> = artifact.version.iter().map(u64::to_string).collect();
    command.env("CARGO_MANIFEST_DIR", &artifact.package);
    command.env("CARGO_PKG_NAME", &artifact.name).env("CARGO_PKG_VERSION", version.join("."));
    if let Some((_, out)) = made.written.iter().find(|(package, _)| *package == artifact.package) {
        command.env("OUT_DIR", out);
    }
    command.arg(&artifact.source);
    command
}
