//! Classes where they are named, and the parts of a declaration that hang on them.

use super::expressions::{self, expression};
use super::mistakes;
use crate::kind::SyntaxKind::{
    Colon, Comma, Domain, Dot, DottedName, Eq, Error, Greater, GreaterEq, Ident, LParen, Less,
    LessEq, Minus, Number, NumberExpr, Param, ParamList, Plus, RParen, Slash, Star, Text, Type,
    Unit,
};
use crate::parser::Parser;

/// `List of 12 C`, `Set of C`, `Path to C`, `Placed of C`, `geometry.Line`.
pub(super) fn class_name(p: &mut Parser<'_>) {
    class_within(p, false);
}

/// A class, within brackets that were told already or not.
fn class_within(p: &mut Parser<'_>, is_told: bool) {
    if mistakes::elsewhere::is_list_in_brackets(p, 0) {
        if !is_told {
            mistakes::elsewhere::list_in_brackets(p);
        }
        bump_wrong(p);
        class_within(p, true);
        if p.at(RParen) {
            bump_wrong(p);
        }
        return;
    }
    if matches!(p.word(0), "a" | "an" | "new") && p.nth(1) == Ident && !p.line_ended(1) {
        let (at, class) = (p.pos(), p.word(1));
        if class.starts_with(char::is_uppercase) {
            let said = (
                "expected-class",
                format!("found `{} {class}`, wanted a class", p.word(0)),
                match p.word(0) {
                    "new" => format!("a part is there by being declared: `{class}`"),
                    _ => format!("a class has no article: `{class}`"),
                },
            );
            let span = p.span_at(at).join(p.span_at(at + 1));
            p.report_mistake((at, at + 1), said, Some((span, class.into())));
            bump_wrong(p);
        }
    }
    if !(p.at(Ident) || p.at(Unit)) || p.line_ended(0) && p.nth(1) == Colon {
        let hint = if p.line_ended(0) { None } else { mistakes::value_for_class(p) };
        p.expected_hint("expected-class", "a class", hint);
        return;
    }
    p.nested(|p| {
        p.start(Type);
        let joiner = match p.word(0) {
            "List" | "Set" | "Placed" => "of",
            "Path" => "to",
            _ => "",
        };
        if p.at(Ident) && !joiner.is_empty() && p.nth(1) == Less {
            let element = p.word(2);
            let said = (
                "expected-member",
                format!("found `<` after {}, wanted `{joiner}`", p.word(0)),
                format!("it is written `{} {joiner} {element}`", p.word(0)),
            );
            p.report_mistake((p.pos() + 1, p.pos() + 1), said, None);
            p.bump_keyword();
            bump_wrong(p);
            class_within(p, is_told);
            if p.at(Greater) {
                bump_wrong(p);
            }
        } else if p.at(Ident) && !joiner.is_empty() && p.at_word(1, joiner) {
            let counted = p.word(0) == "List";
            p.bump_keyword();
            p.bump_keyword();
            if counted {
                count(p);
            }
            class_within(p, is_told);
        } else {
            p.name_class();
            p.bump_as(Ident);
            dotted_rest(p);
        }
        p.finish();
    });
}

/// Takes a token that does not belong here, and was told.
fn bump_wrong(p: &mut Parser<'_>) {
    p.start(Error);
    p.bump();
    p.finish();
}

/// The number of elements in `List of 12 C`, `List of n C`, `List of n + 1 C`, `List of (2 * n) C`.
///
/// A name counts where it is small and a class follows on its line.
fn count(p: &mut Parser<'_>) {
    if p.at(Number) && mistakes::elsewhere::is_list_in_brackets(p, 1) {
        p.start(NumberExpr);
        p.bump();
        return p.finish();
    }
    if mistakes::elsewhere::is_list_in_brackets(p, 0) {
        return;
    }
    if is_sum(p) {
        return expressions::sum(p);
    }
    let small = p.at(Ident) && p.word(0).starts_with(char::is_lowercase);
    let counts = p.at(Number)
        || p.at(LParen)
        || small && p.nth(1) == Ident && !p.begins_line(1) && !p.names_itself(2);
    if counts {
        expressions::count(p);
    }
}

/// Returns true where names and numbers with operators between them stand before a class, on one line.
fn is_sum(p: &Parser<'_>) -> bool {
    let is_operand = |n: usize| {
        p.nth(n) == Number || p.nth(n) == Ident && p.word(n).starts_with(char::is_lowercase)
    };
    let is_operator = |n: usize| matches!(p.nth(n), Plus | Minus | Star | Slash);
    let goes_on = |n: usize| is_operator(n) && is_operand(n + 1) && !p.begins_line(n + 1);
    if !is_operand(0) {
        return false;
    }
    let mut end = 1;
    while goes_on(end) {
        end += 2;
    }
    end > 1 && p.nth(end) == Ident && !p.begins_line(end)
}

/// `geometry.parts`
pub(super) fn dotted_name(p: &mut Parser<'_>, wanted: &str) {
    if !p.at(Ident) {
        let is_quoted = p.at(Text) && !p.line_ended(0);
        let hint =
            is_quoted.then(|| format!("it has no quotes: `{}`", p.word(0).trim_matches('"')));
        p.expected_hint("expected-name", wanted, hint);
        return;
    }
    p.start(DottedName);
    p.bump();
    dotted_rest(p);
    p.finish();
}

fn dotted_rest(p: &mut Parser<'_>) {
    while p.eat(Dot) {
        if !p.expect(Ident, "expected-name", "a name after `.`") {
            break;
        }
    }
}

/// `in 0..9`, `in 0.5..`, `in ..9`, `in > 0`
pub(super) fn domain(p: &mut Parser<'_>) {
    if p.at_word(0, "in") {
        p.start(Domain);
        p.bump_keyword();
        expressions::domain(p);
        if mistakes::range_in_words(p) {
            p.bump();
            p.bump();
        }
        p.finish();
    }
}

/// `(by k: Real, inner: Length in 1 mm..9 mm = 8.4 mm "prompt")`
pub(super) fn parameters(p: &mut Parser<'_>) {
    p.start(ParamList);
    expressions::bracketed(p, RParen, "`)` after the parameters", |p| {
        parameter(p);
        1
    });
    p.finish();
}

/// `d: Length 5 mm`: returns true where it was reported.
fn value_without_equals(p: &mut Parser<'_>) -> bool {
    let is_one = matches!(p.current(), Number | Text) && p.behind(1) == Ident;
    if is_one {
        let (at, has_unit) = (p.pos(), p.nth(1) == Unit);
        let declared = p.text_between(at.saturating_sub(3), at - 1);
        let value = p.text_between(at, at + usize::from(has_unit));
        let said = (
            "expected-value",
            format!("found `{}`, wanted `=` before it", p.word(0)),
            format!("a parameter's value has its sign: `{declared} = {value}`"),
        );
        p.report_mistake((at, at), said, None);
        expression(p);
    }
    is_one
}

/// `rise: Length > 0`: returns true where it was reported; it is read as if `in` stood there.
fn bound_without_in(p: &mut Parser<'_>) -> bool {
    let is_one = matches!(p.current(), Greater | GreaterEq | Less | LessEq)
        && p.behind(1) == Ident
        && matches!(p.nth(1), Number | Minus);
    if is_one {
        let at = p.pos();
        let declared = p.text_between(at.saturating_sub(3), at - 1);
        let said = (
            "expected-word",
            format!("found `{}`, wanted `in` before it", p.word(0)),
            format!("what is allowed stands behind `in`: `{declared} in {} …`", p.word(0)),
        );
        p.report_mistake((at, at), said, None);
        p.start(Domain);
        expressions::domain(p);
        p.finish();
    }
    is_one
}

fn parameter(p: &mut Parser<'_>) {
    if !p.at(Ident) {
        p.expected("expected-parameter", "a parameter: `name: Class`");
        return;
    }
    p.start_documented(Param);
    p.bump();
    if p.at(Ident) {
        p.bump();
    }
    if p.at(Eq) {
        let name = p.text_between(p.pos() - 1, p.pos() - 1);
        let unit = (p.nth(2) == Unit).then(|| expr::units::unit(p.word(2))).flatten();
        let class = unit.and_then(|unit| unit.dimension.named()).unwrap_or("Real");
        let hint = format!("a parameter has its class: `{name}: {class} = …`");
        p.expected_hint("expected-class", "`:` and the parameter's class", Some(hint));
    } else if p.at(Comma) && is_after_bare_one(p) {
        // said once for all of them
    } else if let Some(names) = names_of_one_class(p) {
        let class = p.word(2 * names.len() - 1);
        let each: Vec<String> = names.iter().map(|name| format!("{name}: {class}")).collect();
        let hint = format!("each parameter has its class: `{}`", each.join(", "));
        p.expected_hint("expected-class", "`:` and the parameter's class", Some(hint));
    } else if p.expect(Colon, "expected-class", "`:` and the parameter's class") {
        class_name(p);
        if !bound_without_in(p) && !value_without_equals(p) {
            domain(p);
        }
    }
    if p.eat(Eq) {
        expression(p);
    }
    p.eat(Text);
    p.finish();
}

/// Behind a parameter's name: whether the parameter before it is a name alone.
fn is_after_bare_one(p: &Parser<'_>) -> bool {
    (p.behind(2), p.behind(3)) == (Comma, Ident) && matches!(p.behind(4), LParen | Comma)
}

/// Behind the first name of `a, b, c: Length`: the names; nothing elsewhere.
fn names_of_one_class(p: &Parser<'_>) -> Option<Vec<String>> {
    let mut names = vec![p.text_between(p.pos() - 1, p.pos() - 1).to_string()];
    let mut next = 0;
    while p.nth(next) == Comma && p.nth(next + 1) == Ident {
        names.push(p.word(next + 1).to_string());
        next += 2;
    }
    let is_classed = p.nth(next) == Colon && p.nth(next + 1) == Ident;
    (names.len() > 1 && is_classed).then_some(names)
}

/// `a, b, c`: names, each a path.
pub(super) fn paths(p: &mut Parser<'_>) {
    loop {
        expressions::path(p);
        if !p.eat(Comma) {
            break;
        }
    }
}
