//! The canonical layout keeps tokens, comments and line breaks, and is a fixed point.

use base::FileId;
use proptest::prelude::*;
use syntax::{SyntaxElement, SyntaxKind, format, parse};

fn check(text: &str, expected: &str) {
    assert_eq!(format(&parse(FileId(0), text)), expected);
    check_promises(text);
}

/// Tokens and comments, white space left out.
fn tokens(text: &str) -> Vec<(SyntaxKind, String)> {
    parse(FileId(0), text)
        .syntax()
        .descendants_with_tokens()
        .filter_map(SyntaxElement::into_token)
        .filter(|t| t.kind() != SyntaxKind::Whitespace)
        .map(|t| {
            let text = if t.kind().is_comment() { t.text().trim_end() } else { t.text() };
            (t.kind(), text.to_owned())
        })
        .collect()
}

fn check_promises(text: &str) {
    let once = format(&parse(FileId(0), text));
    assert_eq!(tokens(&once), tokens(text), "the layout of {text:?} means the same");
    let twice = format(&parse(FileId(0), &once));
    assert_eq!(twice, once, "the layout of {text:?} is a fixed point");
}

#[test]
fn spaces_between_tokens() {
    check("x:Real=1", "x: Real = 1\n");
    check("x , y :Real  =  - 3 mm", "x, y: Real = -3 mm\n");
    check("p=( 0,0 )", "p = (0, 0)\n");
    check("f = g ( a , to : b ) [ 0 ] . c", "f = g(a, to: b)[0].c\n");
    check("constraint 0<=x<=2*y+1", "constraint 0 <= x <= 2*y+1\n");
    check("x = a+ b *c^ 2", "x = a + b * c^2\n");
    check("for i in 0 .. 7{constraint x[ i ]>0}", "for i in 0..7 { constraint x[i] > 0 }\n");
}
#[test]
fn members_on_one_line_stand_two_spaces_apart() {
    check("class A{x:Real y:Real;z:Real}", "class A { x: Real  y: Real; z: Real }\n");
    check("class A is B{}", "class A is B { }\n");
}
#[test]
fn lines_stay_broken_and_are_indented() {
    check(
        "class A {\n  x: Real\n\n\n   y: Real =\n 3 +\n4\n /// doc\nz: Real { a=1\nb=2\n}\n}",
        "class A {\n    x: Real\n\n    y: Real =\n        3 +\n        4\n    /// doc\n    z: Real { a = 1\n        b = 2\n    }\n}\n",
    );
    check(
        "program A(\nr: Real,\n) {\na = f(\n1,\n2)\n}",
        "program A(\n    r: Real,\n) {\n    a = f(\n        1,\n        2)\n}\n",
    );
}
#[test]
fn comments_stay_and_align() {
    check(
        "// top\nx: Real // one\nlonger: Real // two\n\n\n  // three\ny: Real /* in */ = 1\nclass A {\n// inside\n}\n",
        "// top\nx: Real       // one\nlonger: Real  // two\n\n// three\ny: Real /* in */ = 1\nclass A {\n    // inside\n}\n",
    );
}
#[test]
fn what_would_read_otherwise_stays_apart() {
    check("x = 2 m ^2", "x = 2 m ^2\n");
    check("x = 2 m / s", "x = 2 m / s\n");
    check("x = - > 3", "x = - > 3\n");
    check("x = 1 . 5", "x = 1. 5\n");
}
#[test]
fn empty_texts_stay_empty() {
    check("", "");
    check("  \n\n", "");
}
#[test]
fn the_examples_keep_their_meaning() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/language");
    for entry in std::fs::read_dir(folder).unwrap() {
        check_promises(&std::fs::read_to_string(entry.unwrap().path()).unwrap());
    }
}

const PIECES: &[&str] = &[
    "class",
    "A",
    "is",
    "constraint",
    "merge",
    "for",
    "in",
    "let",
    "if",
    "then",
    "else",
    "x",
    "p1",
    "rows:",
    "List",
    "of",
    "12",
    "4.7",
    "kohm",
    "m",
    "\"text\"",
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
    "=>",
    "<",
    "+",
    "-",
    "*",
    "/",
    "^",
    ".",
    "..",
    "...",
    "\n",
    "\n\n\n",
    "\n  ",
    "/// doc\n",
    "// c\n",
    "/* c\nd */",
    "°",
    "€",
    "\"open ",
    "/* open",
    "set",
    "to",
    "check",
    "when",
    "/",
    "!",
];

#[test]
fn a_text_with_an_error_stays_where_white_space_decides() {
    let text = "... /* c\nd */class set  :  ";
    assert_eq!(format(&parse(FileId(0), text)), text);
    check("x:Real y=1 z", "x: Real  y = 1 z\n");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_soup_keeps_its_tokens(
        pieces in prop::collection::vec((prop::sample::select(PIECES), 0..3usize), 0..60)
    ) {
        let soup: String =
            pieces.into_iter().map(|(piece, blanks)| format!("{piece}{}", " ".repeat(blanks))).collect();
        check_promises(&soup);
    }
}

#[test]
fn a_range_that_is_open_at_an_end_keeps_its_distance() {
    check(
        "program P(a:Real in   >0=2,b:Real in ..9 = 1,c:Real in 1 .. <9=2,d:Real in 0.5 ..  = 1){}\n",
        "program P(a: Real in > 0 = 2, b: Real in ..9 = 1, c: Real in 1..<9 = 2, d: Real in 0.5.. = 1) { }\n",
    );
}
