//! The table of every limit and tolerance at the end of `book/solver.md` is the code's own.
//!
//! In: the sources of the rooms that solve. Out: a row for each numeric constant, with its first doc comment. With
//! `THINGLAB_UPDATE` set the test writes the table anew.

use std::fs;

use super::files;
use crate::top;

/// Rooms whose numbers decide what an answer is or when it is given up.
const ROOMS: [&str; 6] = ["base", "expr", "solve", "plan", "eval", "session"];

/// What the table begins with: all after it is made by this test.
const HEAD: &str = "| file | name | value | meaning |\n|---|---|---|---|\n";

/// A numeric constant of the sources.
#[derive(Debug, PartialEq, Eq)]
struct Limit {
    name: String,
    value: String,
    meaning: String,
}

/// The numeric constants of a source text; marks like `NONE` that are the largest number of a type are no limits.
fn limits(text: &str) -> Vec<Limit> {
    let mut found = Vec::new();
    let (mut meaning, mut in_comment) = (String::new(), false);
    let mut lines = text.lines().map(str::trim);
    while let Some(line) = lines.next() {
        if line.starts_with("#[cfg(test)]") {
            break;
        }
        if let Some(comment) = line.strip_prefix("///") {
            if !in_comment {
                meaning.clear();
            }
            in_comment = true;
            if !meaning.is_empty() {
                meaning.push(' ');
            }
            meaning.push_str(comment.trim());
            continue;
        }
        in_comment = false;
        let Some((name, kind, mut value)) = constant(line) else {
            meaning.clear();
            continue;
        };
        while !value.ends_with(';') {
            let Some(next) = lines.next() else { break };
            value.push(' ');
            value.push_str(next);
        }
        let value = value.trim_end_matches(';').trim().to_owned();
        if is_numeric(&kind) && !value.contains("::MAX") {
            found.push(Limit { name, value, meaning: meaning.clone() });
        }
    }
    found
}

/// The name, type and value of a line that begins a constant.
fn constant(line: &str) -> Option<(String, String, String)> {
    let visible = line.strip_prefix("pub").unwrap_or(line);
    let plain = match visible.strip_prefix('(') {
        Some(rest) => rest.split_once(')')?.1,
        None => visible,
    };
    let (name, rest) = plain.trim_start().strip_prefix("const ")?.split_once(':')?;
    let (kind, value) = rest.split_once('=')?;
    let is_name = name.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_');
    is_name.then(|| (name.to_owned(), kind.trim().to_owned(), value.trim().to_owned()))
}

fn is_numeric(kind: &str) -> bool {
    let kind = kind.trim_start_matches('[').split(';').next().unwrap_or(kind);
    ["f64", "usize", "u8", "u16", "u32", "u64", "i32", "i64", "RangeInclusive<f64>"].contains(&kind)
}

/// The rows of the table, file by file.
fn table() -> String {
    let mut rows = String::from(HEAD);
    for (path, place) in files() {
        let is_ours = ROOMS.iter().any(|room| path.starts_with(&format!("crates/{room}/src/")))
            && !path.ends_with("tests.rs");
        if !is_ours || !path.ends_with(".rs") {
            continue;
        }
        let text = fs::read_to_string(place).expect("text");
        for Limit { name, value, meaning } in limits(&text) {
            let short = path.replacen("crates/", "", 1).replacen("/src/", "/", 1);
            let meaning = meaning.replace('|', "\\|");
            rows.push_str(
                &format!("| {short} | `{name}` | `{value}` | {meaning} |\n").replace("|  |", "| |"),
            );
        }
    }
    rows
}

#[test]
fn the_book_has_every_limit() {
    let book = top().join("book/solver.md");
    let text = fs::read_to_string(&book).expect("the book has a chapter on the solver");
    let (before, _) = text.split_once(HEAD).unwrap_or((&text, ""));
    let wanted = format!("{before}{}", table());
    if std::env::var_os("THINGLAB_UPDATE").is_some() {
        fs::write(&book, &wanted).expect("the book can be written");
    } else {
        assert!(
            text == wanted,
            "the table of limits in book/solver.md is not the code's: run this test with THINGLAB_UPDATE=1"
        );
    }
}

#[test]
fn a_constant_is_read_with_its_meaning() {
    let text = "/// How many\n/// steps.\nconst STEPS: usize = 100;\npub(crate) const NONE: u32 = u32::MAX;\nconst NAME: &str = \"x\";\n\nconst NEAR: [f64; 2] =\n    [0.5, 1.0];\n";
    let limit = |name: &str, value: &str, meaning: &str| Limit {
        name: name.into(),
        value: value.into(),
        meaning: meaning.into(),
    };
    assert_eq!(
        limits(text),
        [limit("STEPS", "100", "How many steps."), limit("NEAR", "[0.5, 1.0]", "")]
    );
}
