//! What other languages do step by step: what stands for it here.

use super::MEMBER;
use crate::kind::SyntaxKind::{Eq, Ident, LBrace, Minus, Plus, RBrace, Semicolon, Slash, Star};
use crate::parser::Parser;

/// `n += 1`
pub(super) fn increment(p: &mut Parser<'_>) -> bool {
    let first = p.pos();
    let last = p.line_end();
    let is_changed = |n: &usize| {
        matches!(p.nth(*n), Plus | Minus | Star | Slash)
            && p.nth(n + 1) == Eq
            && p.is_adjacent(n + 1)
    };
    let begins = p.at(Ident) && (p.begins_line(0) || matches!(p.behind(1), LBrace | Semicolon));
    let found = (1..last - first).find(is_changed).filter(|_| begins);
    if let Some(n) = found {
        let (of, sign) = (p.text_between(first, first + n - 1), p.word(n));
        let said = (
            "expected-member",
            format!("found `{sign}=`, wanted {MEMBER}"),
            match loop_around(p) {
                Some(begins) => format!(
                    "a loop hands on what its next turn begins with: `{begins} with {of} = 0 {{ more = {of} {sign} {}  next {of} = more }}`",
                    p.quoted_line(first + n + 2)
                ),
                None => format!(
                    "nothing is done step by step: a value is what it is, `{of} = …`, and what is made of it is another"
                ),
            },
        );
        p.report_mistake((first, last), said, None);
    }
    found.is_some()
}

/// Returns how the loop begins whose body this stands in; nothing outside of one.
fn loop_around<'t>(p: &Parser<'t>) -> Option<&'t str> {
    let mut depth = 0;
    let opener = (1..=p.pos()).find(|&n| match p.behind(n) {
        RBrace => {
            depth += 1;
            false
        }
        LBrace => {
            depth -= 1;
            depth < 0
        }
        _ => false,
    })?;
    let opener = p.pos() - opener;
    let stands_apart = |at: &usize| matches!(p.text_between(*at, *at), "for" | "repeat" | "while");
    let first = (opener.saturating_sub(12)..opener).rev().find(stands_apart)?;
    let begins = p.text_between(first, opener - 1);
    let is_plain = !begins.contains(['{', '}', '\n']) && !begins.contains(" with ");
    is_plain.then_some(begins)
}
