//! Calls where a member begins: `cube([10, 20, 30])`, `connect(a, b)`, `print(x)`. Nothing is called for what it does.

use super::MEMBER;
use crate::kind::SyntaxKind::{
    AndKw, Colon, Comma, Eof, Eq, FatArrow, Greater, GreaterEq, Ident, LBrace, LParen, Less,
    LessEq, RParen, Text,
};
use crate::parser::Parser;

/// `f(x) = x^2`, `print(x)`: returns true where the call or definition was reported.
pub(in crate::grammar) fn called_member(p: &mut Parser<'_>) -> bool {
    let before = p.word_before();
    if p.word(0) == "at" && matches!(before, "anchor" | "stay") && !p.begins_line(0) {
        let at = p.pos();
        let (of, value) = (p.text_between(at - 1, at - 1), p.quoted_line(at + 1));
        let said = (
            "expected-member",
            "found `at`, wanted the end of the line".to_string(),
            format!("give the value by itself: `{of} = {value}`, and then `{before} {of}`"),
        );
        p.report_mistake((at, at), said, None);
        return true;
    }
    if parameters_without_class(p) || unnamed_thing(p) {
        return true;
    }
    let is_one = p.nth(1) == LParen
        && matches!(p.nth(2), Ident | Text)
        && p.nth(3) == RParen
        && !p.begins_line(1);
    let ends = p.begins_line(4) || p.nth(4) == Eof;
    if !is_one || !ends {
        return calls(p);
    }
    let (first, last) = (p.pos(), p.line_end());
    let (name, of) = (p.word(0), p.word(2));
    let said = (
        "expected-member",
        format!("found `{name}({of})`, wanted {MEMBER}"),
        format!(
            "nothing is called for what it does: `thinglab run` shows what `{of}` is; a rule is `constraint …`"
        ),
    );
    p.report_mistake((first, last), said, None);
    true
}

/// `Circle(center: p, radius: 3)` by itself
fn unnamed_thing(p: &mut Parser<'_>) -> bool {
    let class = p.word(0);
    let is_one = class.starts_with(char::is_uppercase)
        && !p.begins_line(1)
        && !matches!(p.after_bracket(1), Eq | FatArrow | Colon);
    if is_one {
        let at = p.pos();
        let (first, rest) = class.split_at(class.chars().next().map_or(0, char::len_utf8));
        let name = first.to_lowercase() + rest;
        let said = (
            "expected-member",
            format!("found `{class}(…)`, wanted {MEMBER}"),
            format!(
                "what is made has a name: `{name}: {class} = {class}(…)`, as a step of a program `{name} = {class}(…)`"
            ),
        );
        p.report_mistake((at, p.line_end()), said, None);
    }
    is_one
}

/// `f(x) = x^2`, `f(x, y) => x + y`
fn parameters_without_class(p: &mut Parser<'_>) -> bool {
    let mut end = 2;
    while p.nth(end) == Ident && p.nth(end + 1) == Comma {
        end += 2;
    }
    let is_one = p.nth(1) == LParen
        && !p.begins_line(1)
        && p.nth(end) == Ident
        && p.nth(end + 1) == RParen
        && matches!(p.nth(end + 2), Eq | FatArrow)
        && !p.begins_line(end + 2);
    if is_one {
        let (first, last) = (p.pos(), p.line_end());
        let name = p.word(0);
        let names: Vec<&str> = (2..=end).step_by(2).map(|n| p.word(n)).collect();
        let classed: Vec<String> = names.iter().map(|n| format!("{n}: Real")).collect();
        let whose =
            if names.len() == 1 { "the parameter's class" } else { "the parameters' classes" };
        let said = (
            "expected-class",
            format!("found `{name}({})`, wanted {whose}", names.join(", ")),
            format!(
                "write `{name}({}) => {}`",
                classed.join(", "),
                returned(p.text_between(first + end + 3, last))
            ),
        );
        p.report_mistake((first, last), said, None);
    }
    is_one
}

/// Returns what is computed in `{ return 2 * x; }`.
fn returned(body: &str) -> &str {
    let inner = body.strip_prefix('{').map_or(body, |rest| rest.trim_end_matches('}').trim());
    inner.strip_prefix("return ").map_or(body, |value| value.trim_end_matches(';').trim())
}

/// `cube([10, 20, 30])`, `connect(r1.b, r2.a)`, `minimize (x - 3)^2`: what no parameters stand in the brackets of.
/// Returns true where it was reported.
fn calls(p: &mut Parser<'_>) -> bool {
    let is_definition = matches!(p.after_bracket(1), Eq | FatArrow | Colon | Eof);
    let declares = p.nth(2) == Ident
        && (p.nth(3) == Colon || p.nth(3) == Ident && p.nth(4) == Colon || p.nth(3) == RParen);
    let is_one = p.nth(1) == LParen
        && p.begins_line(0)
        && !p.begins_line(1)
        && !declares
        && (!is_definition || is_last(p));
    if !is_one {
        return false;
    }
    let (first, last) = (p.pos(), p.line_end());
    let name = p.word(0);
    let said = ("expected-member", format!("found `{name}(…)`, wanted {MEMBER}"), meant(p));
    p.report_mistake((first, last), said, None);
    true
}

/// Returns true where nothing follows the brackets in the whole text.
fn is_last(p: &Parser<'_>) -> bool {
    let last = p.line_end();
    p.text_between(last, last) == ")" && p.after_bracket(1) == Eof
}

/// Says what is written for a call of this word.
fn meant(p: &Parser<'_>) -> String {
    // `(a.b, c.d)`
    let within = p.text_between(p.pos() + 2, p.line_end());
    let inner = within.trim_end_matches(';').trim_end_matches(')');
    match p.word(0).to_lowercase().as_str() {
        "connect" | "join" | "link" | "attach" | "coincident" => match inner.split_once(", ") {
            Some((a, b)) if !b.contains(',') => format!("two become one by `merge {a} = {b}`"),
            _ => "two become one by `merge a = b`".into(),
        },
        "minimize" | "minimise" | "maximize" | "maximise" => {
            "nothing is minimized: what is wished is a soft rule, `weak constraint x = 0`".into()
        }
        "assert" => "what is to be true in a check is expected: `expect x = 3`".into(),
        "print" | "echo" | "alert" => {
            "nothing is called for what it does: `thinglab run` shows all values".into()
        }
        "translate" | "rotate" | "scale" | "mirror" => {
            "a thing says itself where it is: `c: Circle { center = (1, 2) }`; a set of steps is `moved`, `turned`, `scaled`".into()
        }
        word if p.nth(2) == RParen && p.nth(3) == LBrace => {
            format!("what is computed is a message, without `return`: `{word}() => …`")
        }
        _ => "a thing is declared with a name and its class, `c: Circle { … }`; a rule begins with `constraint`".into(),
    }
}

/// `1..=3`
pub(in crate::grammar) fn range_with_equals(p: &mut Parser<'_>) {
    let at = p.pos();
    let said = (
        "expected-expression",
        "found `..=`, wanted `..`".to_string(),
        "both ends belong to a range: `1..3`".to_string(),
    );
    let span = p.span_at(at);
    p.report_mistake((at, at), said, Some((span, String::new())));
    p.bump();
}

/// What a part without a value is told.
const NO_VALUE: &str = "of what nothing is said the constraints decide: leave the `=` out";

/// Says what is written where an operand is wanted and a sign of other languages stands.
pub(in crate::grammar) fn no_operand(p: &Parser<'_>) -> Option<String> {
    match (p.behind(1), p.current()) {
        (Eq, Eq) => Some("one `=` is enough".into()),
        (Eq, Eof) => Some(NO_VALUE.into()),
        (Eq, _) if p.begins_line(0) => Some(NO_VALUE.into()),
        (Eq, LBrace) if p.nth(2) != Colon => {
            Some("a list stands in square brackets: `[1, 2, 3]`".into())
        }
        (Eq, LBrace) => Some("the parts of a thing stand in round brackets: `(x: 1, y: 2)`".into()),
        (_, LBrace) if p.pos() > 0 && p.text_between(p.pos() - 1, p.pos() - 1) == "in" => {
            Some("a range is `1..3`; what is one of several is a rule, `x in [1, 2, 4]`".into())
        }
        (AndKw, Less | LessEq | Greater | GreaterEq) => {
            Some("comparisons stand in a chain: `0 < x < 3`".into())
        }
        (FatArrow, LBrace) => {
            Some("what is answered stands behind `=>` without braces and without `return`".into())
        }
        _ => None,
    }
}
