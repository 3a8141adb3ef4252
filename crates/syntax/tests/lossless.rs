//! Any text gives a tree whose text is the same, and no text makes the parser fail.

use base::FileId;
use proptest::prelude::*;
use syntax::{parse, parse_expression, parse_statements};

fn check(text: &str) {
    for parse in [parse, parse_expression, parse_statements] {
        let parse = parse(FileId(0), text);
        assert_eq!(parse.text(), text);
        for diagnostic in parse.diagnostics() {
            let span = diagnostic.place.span;
            assert!(text.get(span.range()).is_some(), "{diagnostic:?} lies outside the text");
        }
    }
}

/// Pieces of the language, in which any order is as good as another.
const PIECES: &[&str] = &[
    "class",
    "is",
    "as",
    "constraint",
    "merge",
    "for",
    "in",
    "let",
    "if",
    "then",
    "else",
    "repeat",
    "until",
    "with",
    "next",
    "when",
    "expect",
    "moved",
    "only",
    "set",
    "to",
    "try",
    "check",
    "lesson",
    "program",
    "family",
    "of",
    "rows",
    "rows:",
    "table",
    "List",
    "Set",
    "all",
    "copy",
    "weak",
    "ref",
    "->",
    "document",
    "reads",
    "...",
    "default",
    "builtin",
    "view",
    "unit",
    "y",
    "down",
    "toolbox",
    "x",
    "p1",
    "Line",
    "super",
    "owner",
    "true",
    "not",
    "and",
    "within",
    "12",
    "4.7",
    "1e-9",
    "kohm",
    "m/s^2",
    "\"text\"",
    "\"open",
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ";",
    ":",
    ":=",
    "=",
    "==",
    "=>",
    "!=",
    "<",
    "<=",
    "+",
    "-",
    "*",
    "/",
    "^",
    ".",
    "..",
    "\n",
    "\n",
    "\n    ",
    " ",
    "/// doc\n",
    "// c\n",
    "/* c */",
    "/*",
    "é",
    "°",
    "€",
    "\\",
    "\r\n",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_text_is_kept(text in "\\PC*") {
        check(&text);
    }
    #[test]
    fn any_characters_are_kept(text in any::<Vec<char>>()) {
        check(&text.into_iter().collect::<String>());
    }
    #[test]
    fn any_soup_is_kept(
        pieces in prop::collection::vec((prop::sample::select(PIECES), any::<bool>()), 0..120)
    ) {
        let soup: String = pieces
            .into_iter()
            .flat_map(|(piece, spaced)| [piece, if spaced { " " } else { "" }])
            .collect();
        check(&soup);
    }
}

#[test]
fn deep_nesting_is_reported_and_survived() {
    let many = |piece: &str| piece.repeat(100_000);
    for text in [
        format!("x = {}", many("(")),
        format!("x = {}1{}", many("("), many(")")),
        format!("x = {}", many("[")),
        format!("x = {}", many("-")),
        format!("x = 1{}", many(" + 1")),
        format!("x = a{}", many(".b")),
        format!("x = {}", many("f(a, ")),
        format!("x = {}1", many("if a then ")),
        format!("x = {}1", many("let a = ")),
        format!("x = 2{}", many("^2")),
        many("class A { "),
        many("class A {\n"),
        format!("x: {}Real", many("List of ")),
        format!("check \"c\" {{ {} undo }}", many("try ")),
        format!("constraint {}", many("if a { b } else ")),
        many("if a { } else "),
        format!("{}{}", many("(["), many(")")),
    ] {
        let parse = parse(FileId(0), &text);
        assert_eq!(parse.text(), text);
        let codes: Vec<_> = parse.diagnostics().iter().map(|d| d.code).collect();
        assert!(!codes.is_empty(), "{} is too deep", &text[..20]);
    }
}

#[test]
fn brackets_that_nest_too_deep_are_no_second_fault() {
    let deep = |count: usize| format!("x = {}1{}\ny = 2\n", "(".repeat(count), ")".repeat(count));
    let codes = |text: &str| -> Vec<&str> {
        parse(FileId(0), text).diagnostics().iter().map(|d| d.code).collect()
    };
    assert_eq!(codes(&deep(10_000)), ["too-deep"]);
    assert!(codes(&deep(10)).is_empty());
    // what is wrong further on is told
    assert_eq!(codes(&format!("{}z = )", deep(10_000))).len(), 2);
}

#[test]
fn depth_within_the_bound_is_fine() {
    let text = format!("x = {}1{}", "(".repeat(150), ")".repeat(150));
    assert_eq!(parse(FileId(0), &text).diagnostics(), []);
    let text = format!("x = 1{}", " + 1".repeat(450));
    assert_eq!(parse(FileId(0), &text).diagnostics(), []);
}
