//! Programs, their blocks and families; `for` stands wherever members do.

use super::expressions::{bracketed, expression};
use super::members::{one, superclasses};
use super::mistakes::elsewhere::body_by_colon;
use super::statements::text_body;
use super::types::{class_name, parameters};
use super::{Scope, body};
use crate::kind::SyntaxKind::{
    Binding, Body, Check, Colon, Comma, Eq, Error, Family, For, Ident, LBrace, LBracket, LParen,
    Lesson, Next, Number, Program, RParen, Repeat, Rows, Table, Text, TupleExpr, While, With,
};
use crate::parser::Parser;

/// A member that holds steps or statements, if one begins here.
pub(super) fn member(p: &mut Parser<'_>, scope: Scope) -> bool {
    if scope == Scope::Family && p.at(LParen) {
        rows_without_colon(p);
        return true;
    }
    if !p.at(Ident) {
        return false;
    }
    if scope == Scope::Family && p.word(0) == "rows" && p.nth(1) == Colon {
        rows(p);
        return true;
    }
    if scope == Scope::Family && p.word(0) == "rows" && p.nth(1) == LParen {
        rows_without_colon(p);
        return true;
    }
    if p.names_itself(1) {
        return false;
    }
    match p.word(0) {
        "table" if scope == Scope::Family => one(p, Table, |p| {
            p.expect(Text, "expected-text", "the name of a table's file in quotes");
        }),
        "program" => one(p, Program, program),
        "abstract" if p.word(1) == "program" => one(p, Program, |p| {
            p.bump_keyword();
            program(p);
        }),
        "family" => one(p, Family, family),
        "check" => one(p, Check, |p| text_body(p, Scope::Check)),
        "lesson" => one(p, Lesson, |p| text_body(p, Scope::Lesson)),
        "next" => one(p, Next, bindings),
        "for" => {
            p.start_documented(For);
            for_rest(p, scope);
            p.finish();
        }
        "repeat" => {
            p.start_documented(Repeat);
            repeat_rest(p, scope);
            p.finish();
        }
        "while" => {
            p.start_documented(While);
            while_rest(p, scope);
            p.finish();
        }
        _ => return false,
    }
    true
}

/// `P(d: Length = 1 mm) { … }`, behind the keyword.
fn program(p: &mut Parser<'_>) {
    p.expect(Ident, "expected-name", "the program's name");
    if p.at(LParen) {
        parameters(p);
    }
    if !superclasses(p) || p.at(LBrace) {
        body(p, Scope::Thing);
    }
}

/// `F of P { table "sizes.csv" }`, behind the keyword.
fn family(p: &mut Parser<'_>) {
    p.expect(Ident, "expected-name", "the family's name");
    if body_by_colon(p, " of …") {
        return;
    }
    if p.at(LBrace) {
        let hint = "a family says which program draws it: `family Discs of Disc { … }`".to_string();
        p.expected_hint("expected-word", "`of`", Some(hint));
    } else {
        super::members::into(p, "of", class_name);
    }
    if !body_by_colon(p, "") || p.at(LBrace) {
        body(p, Scope::Family);
    }
}

/// A block as a step's value, if one begins here: `column = repeat with … { … }`.
pub(super) fn block_value(p: &mut Parser<'_>) -> bool {
    if !p.at(Ident) || p.names_itself(1) || p.begins_line(1) && p.nth(1) != LBrace {
        return false;
    }
    let follows = matches!(p.nth(1), Ident | Number | LBrace | LParen);
    match p.word(0) {
        "repeat" if follows => {
            p.start(Repeat);
            repeat_rest(p, Scope::Thing);
        }
        "while" if follows => {
            p.start(While);
            while_rest(p, Scope::Thing);
        }
        "for" if p.nth(1) == Ident => {
            p.start(For);
            for_rest(p, Scope::Thing);
        }
        _ => return false,
    }
    p.finish();
    true
}

/// `for a, b in links.neighbours with … { … }`
fn for_rest(p: &mut Parser<'_>, scope: Scope) {
    let first = p.pos();
    p.bump_keyword();
    if p.at_word(0, "each") && p.nth(1) == Ident && p.word(1) != "in" {
        let said = (
            "expected-word",
            "found `each`, wanted a name".to_string(),
            format!("leave `each` out: `for {} in … {{ … }}`", p.word(1)),
        );
        p.report_mistake((p.pos(), p.pos()), said, Some((p.span_at(p.pos()), String::new())));
        p.start(Error);
        p.bump();
        p.finish();
    }
    loop {
        if !p.eat(Ident) {
            let hint = "a loop goes through numbers or a list: `for i in 0..<3 { … }`".to_string();
            p.expected_hint("expected-name", "a name", Some(hint));
        }
        if !p.eat(Comma) {
            break;
        }
    }
    if p.at(Eq) {
        let hint = "a loop goes through numbers or a list: `for i in 1..3 { … }`".to_string();
        p.expected_hint("expected-word", "`in`", Some(hint));
    } else {
        super::members::into(p, "in", expression);
    }
    super::mistakes::range_in_words(p);
    with(p);
    if super::mistakes::loop_without_braces(p, first) {
        p.nested(|p| {
            p.start(Body);
            let _ = member(p, scope) || super::members::member(p);
            p.finish();
        });
        return;
    }
    if p.at(Colon) || p.begins_line(0) && !p.at(LBrace) {
        let head = p.quoted(first, p.pos() - 1);
        let hint = format!("what a loop repeats stands in braces: `{head} {{ … }}`");
        p.expected_hint("expected-body", "a body in `{ }`", Some(hint));
    }
    body(p, scope);
}

/// `repeat 5 times with … { … } until c`
fn repeat_rest(p: &mut Parser<'_>, scope: Scope) {
    p.bump_keyword();
    if p.at_word(0, "while") || p.at_word(0, "until") {
        let hint = "a loop goes on while something holds, `while c { … }`, or until it does, \
                    `repeat { … } until c`";
        p.expected_hint("expected-word", "a count or the body", Some(hint.into()));
        return while_rest(p, scope);
    }
    if !p.at(LBrace) && !p.at_word(0, "with") {
        let first = p.pos();
        expression(p);
        if p.at(LBrace) {
            let count = p.text_between(first, p.pos() - 1);
            let hint = format!(
                "steps of a program are repeated by `repeat {count} times {{ … }}`, members of a class by `for i in 0..<{count} {{ … }}`"
            );
            p.expected_hint("expected-word", "`times`", Some(hint));
        } else {
            super::members::into(p, "times", |_| {});
        }
    }
    with(p);
    body(p, scope);
    if p.eat_word("until") {
        expression(p);
    }
}

/// `while c with … { … }`
fn while_rest(p: &mut Parser<'_>, scope: Scope) {
    p.bump_keyword();
    expression(p);
    with(p);
    body(p, scope);
}

/// `with under = floor, r = radius`
fn with(p: &mut Parser<'_>) {
    if p.at_word(0, "with") {
        p.start(With);
        p.bump_keyword();
        bindings(p);
        p.finish();
    }
}

fn bindings(p: &mut Parser<'_>) {
    loop {
        p.start(Binding);
        p.expect(Ident, "expected-name", "a name");
        if p.expect(Eq, "expected-value", "`=` and a value") {
            expression(p);
        }
        p.finish();
        if !p.eat(Comma) {
            break;
        }
    }
}

/// `rows (3 mm) (4 mm)`, or the rows alone
fn rows_without_colon(p: &mut Parser<'_>) {
    let hint = "rows stand behind their word and a colon: `rows: (3 mm) (4 mm)`".to_string();
    let is_word = p.at(Ident);
    p.start_documented(Rows);
    if is_word {
        p.bump_keyword();
    }
    let wanted = if is_word { "`:`" } else { "`rows:`" };
    p.expected_hint("expected-member", wanted, Some(hint));
    each_row(p);
    p.finish();
}

/// `rows: (40 mm, 2 mm)  (20 mm, 1 mm)`
fn rows(p: &mut Parser<'_>) {
    p.start_documented(Rows);
    p.bump_keyword();
    p.bump();
    each_row(p);
    p.finish();
}

fn each_row(p: &mut Parser<'_>) {
    if p.at(LBracket) {
        let rows = p.text_between(p.pos() + 1, p.line_end());
        let rows = rows.trim_end().trim_end_matches([']', '}']).trim_end();
        let rows = if rows.len() < 60 && rows.starts_with('(') { rows } else { "(1, 2) (3, 4)" };
        let hint = format!("rows stand one behind the other, without brackets: `rows: {rows}`");
        p.expected_hint("expected-member", "a row, `(…)`", Some(hint));
        return p.skip_line();
    }
    while p.at(LParen) {
        p.start(TupleExpr);
        bracketed(p, RParen, "`)` at the row's end", |p| {
            expression(p);
            1
        });
        p.finish();
        p.eat(Comma);
    }
}
