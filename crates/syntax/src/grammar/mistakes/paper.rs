//! What is written on paper, or is a word of everyday language, where a member begins or goes on.

use super::MEMBER;
use crate::kind::SyntaxKind::{
    AndKw, Colon, Comma, Eq, Ident, LParen, Minus, Number, RParen, Unit,
};
use crate::parser::Parser;

/// Reports what begins no member; returns false where it is no mistake that is known.
pub(super) fn of_member(p: &mut Parser<'_>) -> bool {
    name_with_minus(p)
        || name_with_digit(p)
        || names_in_brackets(p)
        || returned(p)
        || product_of_pi(p)
        || anchored_path(p)
}

/// `my-part: Real`
fn name_with_minus(p: &mut Parser<'_>) -> bool {
    if !p.at(Ident) || !p.begins_line(0) {
        return false;
    }
    let joins = |n: usize| {
        p.nth(n) == Minus && p.is_adjacent(n) && p.nth(n + 1) == Ident && p.is_adjacent(n + 1)
    };
    let last = (0..).step_by(2).find(|n| !joins(n + 1)).unwrap_or_default();
    let is_one = last > 0 && p.nth(last + 1) == Colon;
    if is_one {
        let at = p.pos();
        let name = p.text_between(at, at + last).replace('-', "_");
        let said = (
            "expected-name",
            "found `-` in a name".to_string(),
            format!("a name is of letters, digits and `_`: `{name}`"),
        );
        let span = p.span_at(at).join(p.span_at(at + last));
        p.report_mistake((at, at + last), said, Some((span, name)));
    }
    is_one
}

/// `2nd: Real`
fn name_with_digit(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(Number)
        && p.begins_line(0)
        && matches!(p.nth(1), Ident | Unit)
        && p.is_adjacent(1)
        && p.nth(2) == Colon;
    if is_one {
        let at = p.pos();
        let name = p.text_between(at, at + 1);
        let said = (
            "expected-name",
            format!("found `{name}`, wanted a name"),
            format!("a name begins with a letter: `a{name}`"),
        );
        p.report_mistake((at, at + 1), said, None);
    }
    is_one
}

/// `(a, b): Real`, `a and b: Real`
fn names_in_brackets(p: &mut Parser<'_>) -> bool {
    if !p.begins_line(0) {
        return false;
    }
    let is_bracketed = p.at(LParen);
    let mut n = usize::from(is_bracketed);
    let mut names = Vec::new();
    while p.nth(n) == Ident {
        names.push(p.text_between(p.pos() + n, p.pos() + n));
        n += 1;
        if !matches!(p.nth(n), Comma | AndKw) {
            break;
        }
        n += 1;
    }
    let ends = !is_bracketed || p.nth(n) == RParen;
    n += usize::from(is_bracketed);
    let is_one = names.len() > 1 && ends && p.nth(n) == Colon;
    if is_one {
        let at = p.pos();
        let names = names.join(", ");
        let said = (
            "expected-member",
            format!("found `{}`, wanted {MEMBER}", p.word(0)),
            format!("several of a class stand with commas between them: `{names}: Class`"),
        );
        let span = p.span_at(at).join(p.span_at(at + n - 1));
        p.report_mistake((at, at + n - 1), said, Some((span, names)));
    }
    is_one
}

/// `return Circle(r)`
fn returned(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(Ident) && p.word(0) == "return" && !p.begins_line(1) && p.nth(1) != Colon;
    if is_one {
        let (first, last) = (p.pos(), p.line_end());
        let said = (
            "expected-member",
            format!("found `return`, wanted {MEMBER}"),
            "nothing is returned: what a program draws has names, and is its result; what is computed is a message, \
             `name => …`"
                .to_string(),
        );
        p.report_mistake((first, last), said, None);
    }
    is_one
}

/// `pi r^2`
fn product_of_pi(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(Ident)
        && !p.begins_line(0)
        && p.behind(1) == Ident
        && p.text_between(p.pos() - 1, p.pos() - 1) == "pi"
        && p.nth(1) != Colon;
    if is_one {
        let at = p.pos();
        let start = p.span_at(at).start;
        let said = (
            "implied-product",
            format!("found `pi` before `{}`, wanted an operator between them", p.word(0)),
            format!("write `pi * {}`", p.word(0)),
        );
        let fix = (base::Span::new(start, start), "* ".to_string());
        p.report_mistake((at - 1, at), said, Some(fix));
    }
    is_one
}

/// `anchor a.p1 = (3, 4)`
fn anchored_path(p: &mut Parser<'_>) -> bool {
    let word = p.word_before();
    let is_one = p.at(Eq) && !p.begins_line(0) && matches!(word, "anchor" | "stay");
    if is_one {
        let at = p.pos();
        let before = p.line_before();
        let path = before.split_once(word).map_or("x", |(_, path)| path.trim());
        let value = p.quoted_line(at + 1);
        let said = (
            "expected-member",
            "found `=`, wanted the end of the line".to_string(),
            format!("give the value by itself: `{path} = {value}`, and then `{word} {path}`"),
        );
        p.report_mistake((at, at), said, None);
    }
    is_one
}
