//! What the command answers to the shell: nothing was in order where it says why not.

use std::path::PathBuf;
use std::process::{Command, Output};

/// Runs the command on a document of that text.
fn asked(name: &str, text: &str, command: &str, about: &[&str]) -> Output {
    let path: PathBuf = std::env::temp_dir().join(format!("thinglab-{name}.thing"));
    std::fs::write(&path, text).expect("there is a folder for such files");
    let mut thinglab = Command::new(env!("CARGO_BIN_EXE_thinglab"));
    thinglab.arg(command).arg(&path).args(about).output().expect("the command starts")
}

#[test]
fn what_is_not_there_cannot_be_explained() {
    let explain = |name: &str, about: &str| asked(name, "a: Real = 3\n", "explain", &[about]);
    let there = explain("explain-there", "a");
    assert!(there.status.success() && there.stdout.starts_with(b"a is 3"), "{there:?}");
    assert!(!explain("explain-missing", "b.c").status.success());
}

#[test]
fn a_picture_without_end_is_no_empty_drawing() {
    let endless =
        "class Leaf { size: Real = 3  picture => Leaf(size: size + 1).picture }\nl: Leaf\n";
    let drawn = asked("draw-endless", endless, "draw", &[]);
    assert!(!drawn.status.success());
    assert!(drawn.stdout.starts_with(b"something is not drawn: messages call each other"));
    let nothing = "class Leaf { size: Real = 3  picture => picture() }\nl: Leaf\n";
    assert!(asked("draw-nothing", nothing, "draw", &[]).stdout.starts_with(b"<svg"));
}
