//! The pages of the language: every example is understood, and kept byte for byte.

use base::FileId;
use std::path::{Path, PathBuf};

fn examples() -> Vec<(PathBuf, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/language");
    let mut paths: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("the examples stand here")
        .map(|entry| entry.expect("a file").path())
        .collect();
    paths.sort();
    paths
        .into_iter()
        .map(|path| (path.clone(), std::fs::read_to_string(path).expect("a text")))
        .collect()
}

#[test]
fn every_example_is_understood() {
    let examples = examples();
    assert_eq!(examples.len(), 14);
    for (path, text) in examples {
        let parse = syntax::parse(FileId(0), &text);
        assert_eq!(parse.diagnostics(), [], "{}", path.display());
        assert_eq!(parse.text(), text);
    }
}
