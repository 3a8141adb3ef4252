//! Statements of checks and lessons, and `if` as a block.

use super::expressions::{conditional_rest, expression, path};
use super::members::{self, into, one};
use super::rules::tolerance;
use super::types::paths;
use super::{Scope, body, mistakes};
use crate::kind::SyntaxKind::{
    Comma, Delete, Dot, Edit, ElseKw, Eq, Expect, Greater, GreaterEq, Hint, Ident, If, IfExpr,
    IfKw, LBrace, LBracket, Less, LessEq, LetKw, Move, NotEq, Note, Number, OwnerKw, Promote, Redo,
    Rename, Say, Set, Simulate, Target, Task, Text, Try, Undo, Unit, Unmerge,
};
use crate::parser::Parser;

/// `"name" { … }`, after `check` and `lesson`
pub(super) fn text_body(p: &mut Parser<'_>, scope: Scope) {
    if !p.eat(Text) {
        let word = p.text_between(p.pos().saturating_sub(1), p.pos().saturating_sub(1));
        let hint = match (word, p.at(Ident)) {
            ("lesson", true) => {
                format!("its name stands in quotes: `lesson \"{}\" {{ }}`", p.word(0))
            }
            _ => "what it promises stands in quotes: `check \"…\" { }`".to_string(),
        };
        p.expected_hint("expected-text", "a name in quotes", Some(hint));
    } else if p.at(Ident) && !p.begins_line(0) {
        // `check "a" expect x = 1`
        let (at, name) = (p.pos(), p.text_between(p.pos().saturating_sub(2), p.pos() - 1));
        let hint = format!("what it says stands in braces: `{name} {{ {} }}`", p.quoted_line(at));
        p.expected_hint("expected-body", "a body in `{ }`", Some(hint));
        return p.skip_line();
    }
    body(p, scope);
}

/// A statement, if one begins here; where none may stand it is read and reported.
pub(super) fn statement(p: &mut Parser<'_>, scope: Scope) -> bool {
    if scope == Scope::Check && p.at(LetKw) && p.nth(1) == Ident && !p.begins_line(1) {
        one(p, Note, |p| {
            p.bump();
            if p.expect(Eq, "expected-value", "`=` and a value") {
                expression(p);
            }
        });
        return true;
    }
    if !p.at(Ident) || p.names_itself(1) {
        return false;
    }
    let home = match p.word(0) {
        "say" | "task" | "hint" => Scope::Lesson,
        "set" | "move" | "unmerge" | "delete" | "edit" | "rename" | "promote" | "undo" | "redo"
            if scope == Scope::Lesson =>
        {
            Scope::Lesson
        }
        "set" | "move" | "unmerge" | "delete" | "edit" | "rename" | "promote" | "undo" | "redo"
        | "simulate" | "try" => Scope::Check,
        "expect" if scope == Scope::Lesson => Scope::Lesson,
        "expect" => Scope::Check,
        _ => return false,
    };
    let plain = matches!(p.nth(1), Ident | OwnerKw | Text | Number) && !p.begins_line(1);
    if scope != home && !plain {
        return false;
    }
    let (word, start) = (p.word(0), p.pos());
    command(p);
    if scope != home {
        let (message, hint) = match home {
            Scope::Lesson => {
                (format!("found `{word}` outside a lesson"), "it stands in `lesson \"…\" { }`")
            }
            Scope::Check | Scope::Thing | Scope::Family => {
                (format!("found `{word}` outside a check"), "it stands in `check \"…\" { }`")
            }
        };
        p.report_since(start, "statement-outside-check", message, hint);
    }
    true
}

fn command(p: &mut Parser<'_>) {
    match p.word(0) {
        "say" => one(p, Say, |p| quoted(p, "what to say")),
        "hint" => one(p, Hint, |p| quoted(p, "the hint")),
        "task" => one(p, Task, expression),
        "set" => one(p, Set, targets),
        "move" => one(p, Move, targets),
        "unmerge" => one(p, Unmerge, paths),
        "delete" => one(p, Delete, paths),
        "edit" => one(p, Edit, |p| {
            path(p);
            body(p, Scope::Thing);
        }),
        "rename" => one(p, Rename, |p| {
            path(p);
            into(p, "to", |p| {
                if p.current().is_reserved() && !p.begins_line(0) {
                    let message = format!("found the reserved word `{}`, wanted a name", p.word(0));
                    p.report("reserved-word", message, Some("give it another name".into()));
                    return p.bump_as(Ident);
                }
                p.expect(Ident, "expected-name", "the new name");
            });
        }),
        "promote" => one(p, Promote, |p| {
            path(p);
            into(p, "as", |p| {
                p.expect(Ident, "expected-name", "the class's name");
            });
        }),
        "undo" => one(p, Undo, |_| {}),
        "redo" => one(p, Redo, |_| {}),
        "simulate" => one(p, Simulate, expression),
        "try" => one(p, Try, |p| {
            p.nested(|p| {
                let merges = p.at_word(0, "merge");
                if !(statement(p, Scope::Check) || merges && members::member(p)) {
                    p.expected(
                        "expected-statement",
                        "a statement to try: `set`, `move`, `merge`, …",
                    );
                }
            });
        }),
        _ => one(p, Expect, expectation),
    }
}

fn quoted(p: &mut Parser<'_>, wanted: &str) {
    p.expect(Text, "expected-text", &format!("{wanted} in quotes"));
}

/// `a to 1, b to 2`
fn targets(p: &mut Parser<'_>) {
    loop {
        p.start(Target);
        let first = p.pos();
        path(p);
        if p.at_word(0, "by") {
            let of = p.text_between(first, p.pos() - 1);
            let hint = format!("say where it goes or what it becomes: `{of} to …`");
            p.expected_hint("expected-word", "`to`", Some(hint));
            p.bump();
            expression(p);
        } else if matches!(p.behind(1), Number | Unit) {
            // what is missing before the number was told
        } else if p.at(Eq) {
            let (of, value) = (p.text_between(first, p.pos() - 1), p.word(1));
            let hint = format!("write `{of} to {value}`");
            p.expected_hint("expected-word", "`to`", Some(hint));
            p.bump();
            expression(p);
        } else {
            into(p, "to", expression);
            while mistakes::several_values(p) {
                p.bump();
                expression(p);
            }
        }
        p.finish();
        if !p.eat(Comma) {
            break;
        }
    }
}

/// What is expected, after `expect`, where `satisfied moved free solutions plan error` are reserved
/// unless a path goes on after them.
fn expectation(p: &mut Parser<'_>) {
    match (p.at(Ident) && !matches!(p.nth(1), Dot | LBracket), p.word(0)) {
        (true, "satisfied") => p.bump_keyword(),
        (true, "moved") => {
            p.bump_keyword();
            if !p.at_word(0, "only") {
                paths(p);
            }
            into(p, "only", |_| {});
        }
        (true, "free" | "solutions") => {
            p.bump_keyword();
            if matches!(p.current(), Less | LessEq | Greater | GreaterEq | NotEq) {
                p.bump();
                expression(p);
            } else if p.expect(Eq, "expected-value", "`=` and a number") {
                expression(p);
            }
        }
        (true, "plan") => {
            p.bump_keyword();
            p.expect(Ident, "expected-plan", "`one_pass`, `block`, `relaxation` or `search`");
        }
        (true, "error") => {
            p.bump_keyword();
            quoted(p, "a word of the report");
        }
        _ => {
            expression(p);
            tolerance(p);
        }
    }
}

/// `if c { … } else { … }` as a member or statement.
pub(super) fn conditional(p: &mut Parser<'_>, scope: Scope) -> bool {
    p.start_documented(If);
    p.bump();
    expression(p);
    if p.at(ElseKw) {
        // `x: Real = 1 if c else 2`
        let hint = "a value is chosen by `if c then a else b`".to_string();
        p.expected_hint("expected-body", "a body in `{ }`", Some(hint));
        p.skip_line();
    } else {
        branches(p, scope);
    }
    p.finish();
    true
}

/// `if c then a else b` or `if c { … } else { … }` as a step's value.
pub(super) fn conditional_value(p: &mut Parser<'_>) {
    let start = p.checkpoint();
    p.bump();
    expression(p);
    if p.at(LBrace) && mistakes::holds_value(p) {
        let hint = "a value is chosen by `if c then a else b`".to_string();
        p.expected_hint("expected-then", "`then`", Some(hint));
        p.skip_line();
        p.start_at(start, IfExpr);
        p.finish();
    } else if p.at(LBrace) {
        branches(p, Scope::Thing);
        p.start_at(start, If);
        p.finish();
    } else {
        conditional_rest(p, start);
    }
}

fn branches(p: &mut Parser<'_>, scope: Scope) {
    body(p, scope);
    if p.at(ElseKw) {
        p.bump();
        if p.at(IfKw) {
            p.nested(|p| conditional(p, scope));
        } else {
            body(p, scope);
        }
    }
}
