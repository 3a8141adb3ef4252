//! Members of a body: parts, assignments, messages, classes, merges and their kin.

use super::expressions::{expression, path};
use super::rules::{constraint, methods_if_any, rule, tolerance, when};
use super::types::{class_name, domain, dotted_name, parameters, paths};
use super::{Scope, body, mistakes, programs, statements};
use crate::kind::SyntaxKind::{
    self, Anchor, Arrow, Assign, Attachers, Choice, Class, Colon, ColonEq, Comma, Dot, Eq, Erase,
    Error, FatArrow, Greater, GreaterEq, Handle, Ident, IfKw, Insert, LBrace, LBracket, LParen,
    Less, LessEq, Merge, Message, Minus, Modify, NotEq, Part, Plus, RBracket, RParen, Ref, Replace,
    Side, Slash, Star, Stay, Superclass, Text, Toolbox, UnitLine, Use, View, Without, YLine,
};
use crate::parser::Parser;

/// The words that begin a member, a statement or a clause.
pub(crate) const KEYWORDS: &[&str] = &[
    "unit",
    "y",
    "use",
    "class",
    "choice",
    "abstract",
    "modify",
    "constraint",
    "required",
    "strong",
    "medium",
    "weak",
    "merge",
    "stay",
    "anchor",
    "constant",
    "layout",
    "insert",
    "default",
    "combining",
    "builtin",
    "static",
    "replacing",
    "without",
    "replace",
    "for",
    "repeat",
    "while",
    "next",
    "guide",
    "erase",
    "when",
    "ref",
    "attachers",
    "handle",
    "view",
    "side",
    "toolbox",
    "lesson",
    "program",
    "family",
    "check",
    "set",
    "move",
    "unmerge",
    "delete",
    "edit",
    "rename",
    "promote",
    "undo",
    "redo",
    "simulate",
    "try",
    "expect",
    "say",
    "task",
    "hint",
    "table",
    "reads",
];

/// Returns true if `word` can begin a member or a statement.
pub(super) fn is_keyword(word: &str) -> bool {
    KEYWORDS.contains(&word)
}

/// A member, if one begins here.
pub(super) fn member(p: &mut Parser<'_>) -> bool {
    if !p.at(Ident) {
        return false;
    }
    if p.names_itself(1) {
        return named(p);
    }
    match p.word(0) {
        "unit" => unit(p),
        "y" if matches!(p.word(1), "down" | "up") => {
            p.start_documented(YLine);
            p.bump_keyword();
            p.bump_keyword();
            p.finish();
        }
        "use" => one(p, Use, |p| dotted_name(p, "the name of a library or file")),
        "class" | "abstract" => class(p),
        "choice" if p.nth(1) == Ident => one(p, Choice, choice),
        "modify" => one(p, Modify, |p| {
            class_name(p);
            body(p, Scope::Thing);
        }),
        "required" | "strong" | "medium" | "weak" => strengthened(p),
        "constraint" => constraint(p),
        "stay" | "anchor" if p.nth(1) == Ident && p.nth(2) == Colon => {
            mistakes::anchored_part(p);
            part(p);
        }
        "stay" => one(p, Stay, paths),
        "when" => when(p),
        "anchor" => one(p, Anchor, paths),
        "constant" => constant(p),
        "layout" if p.nth(1) == Ident => part(p),
        "merge" => one(p, Merge, merge),
        "insert" => one(p, Insert, |p| {
            path(p);
            into(p, "into", path);
        }),
        "without" => one(p, Without, paths),
        "replace" => one(p, Replace, |p| {
            path(p);
            p.expect(Colon, "expected-rule", "`:` and the rule in its place");
            rule(p);
            tolerance(p);
            methods_if_any(p);
        }),
        "default" | "combining" | "builtin" | "static" | "replacing" => modified(p),
        "ref" => one(p, Ref, reference),
        "attachers" => one(p, Attachers, paths),
        "handle" => one(p, Handle, |p| {
            path(p);
            into(p, "keeps", paths);
        }),
        "guide" if p.nth(1) == Ident => one(p, Assign, assigned),
        "erase" => one(p, Erase, paths),
        "view" => one(p, View, |p| {
            name_in_quotes(p, "the view's name in quotes", "view");
            p.expect(FatArrow, "expected-value", "`=>` and what it shows");
            expression(p);
        }),
        "side" => one(p, Side, |p| {
            path(p);
            p.expect(Colon, "expected-side", "`:` and the side");
            p.expect(Ident, "expected-side", "a side");
        }),
        "toolbox" => one(p, Toolbox, toolbox),
        _ if matches!(p.nth(1), LBracket | LParen) => return named(p),
        _ => return false,
    }
    true
}

/// A node of a keyword and what follows it.
pub(super) fn one(p: &mut Parser<'_>, kind: SyntaxKind, rest: impl FnOnce(&mut Parser<'_>)) {
    p.start_documented(kind);
    p.bump_keyword();
    rest(p);
    p.finish();
}

/// A word in the middle of a member, and what follows it.
pub(super) fn into(p: &mut Parser<'_>, word: &'static str, rest: impl FnOnce(&mut Parser<'_>)) {
    if p.eat_word(word) {
        rest(p);
    } else {
        p.expected("expected-word", &format!("`{word}`"));
    }
}

/// What begins with its own name: a part, a message, a value.
fn named(p: &mut Parser<'_>) -> bool {
    match p.nth(1) {
        Colon if mistakes::elsewhere::colon_without_name(p) => {}
        Colon | Comma => part(p),
        LParen if mistakes::calls::called_member(p) => p.skip_line(),
        FatArrow | LParen => {
            p.start_documented(Message);
            if !message(p) {
                let hint = p.at(Eq).then(|| "write `=>`: what `=` gives is a value".to_string());
                p.expected_hint("expected-value", "`=>` and what the message answers", hint);
            }
            p.finish();
        }
        Eq | Dot | LBracket => assign(p),
        ColonEq => {
            let start = p.pos();
            p.start_documented(Assign);
            path(p);
            p.bump();
            value(p);
            p.finish();
            let message = "found `:=` among members, wanted `=`".into();
            let written = p.text_between(start, p.pos() - 1).replacen(":=", "=", 1);
            let hint = match p.in_check {
                true => {
                    format!("what a check changes is set: `set {}`", written.replacen("=", "to", 1))
                }
                false => format!("write `{written}`; `:=` stands in the methods of a constraint"),
            };
            p.report_since(start, "assignment-outside-method", message, &hint);
        }
        _ => return false,
    }
    true
}

/// `x, y: Length in 0..9 = 3 { … }`, `length: Length => …`, `layout at: Point`
fn part(p: &mut Parser<'_>) {
    p.start_documented(Part);
    if p.nth(1) == Ident && matches!(p.word(0), "layout" | "anchor" | "stay") {
        p.bump_keyword();
    }
    p.bump();
    rest_of_part(p);
    p.finish();
}

/// `constant g: Acceleration = 9.81 m/s^2`
fn constant(p: &mut Parser<'_>) {
    p.start_documented(Part);
    p.bump_keyword();
    if p.expect(Ident, "expected-name", "the constant's name") {
        mistakes::constant_without_class(p);
        rest_of_part(p);
    }
    p.finish();
}

/// What follows the first name of a part.
fn rest_of_part(p: &mut Parser<'_>) {
    while p.eat(Comma) {
        p.expect(Ident, "expected-name", "a part's name");
    }
    if p.at(Eq) && !p.begins_line(0) {
        let hint = "each has a value of its own: `a = 1`, and then `b = 2`".to_string();
        p.expected_hint("expected-class", "`:` and the parts' class", Some(hint));
    } else if p.expect(Colon, "expected-class", "`:` and the parts' class") {
        if named_constraint(p) {
            return;
        }
        class_name(p);
        domain(p);
    }
    if mistakes::value_by_assignment(p) {
        p.start(Error);
        p.bump();
        p.finish();
        value(p);
    } else if p.eat(Eq) {
        value(p);
    } else if p.eat(FatArrow) {
        expression(p);
    }
    if p.at(LBrace) {
        body(p, Scope::Thing);
    }
}

/// `sum: constraint x = 3`: the name stands behind the word. Returns true where that was reported.
fn named_constraint(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(Ident) && p.word(0) == "constraint" && p.nth(1) == Ident;
    if is_one {
        let (at, name) = (p.pos(), p.text_between(p.pos() - 2, p.pos() - 2));
        let said = (
            "expected-class",
            "found `constraint`, wanted a class".to_string(),
            format!("the name of a constraint stands behind the word: `constraint {name}: …`"),
        );
        p.report_mistake((at, at), said, None);
        p.skip_line();
    }
    is_one
}

/// `p1.x = 3`
fn assign(p: &mut Parser<'_>) {
    p.start_documented(Assign);
    assigned(p);
    p.finish();
}

/// `ring = Circle(…)`, after the word `guide` where a step is one.
fn assigned(p: &mut Parser<'_>) {
    let first = p.pos();
    path(p);
    if matches!(p.current(), Less | LessEq | Greater | GreaterEq | NotEq | Plus | Minus | Star)
        && !p.line_ended(0)
    {
        let last = p.line_end();
        mistakes::equation_since(p, first, last);
        return p.skip_line();
    }
    if mistakes::arrow(p, first) {
        return p.skip_line();
    }
    if mistakes::body_of_path(p, first) {
        return;
    }
    if p.at(Eq) {
        p.bump();
        return value(p);
    }
    let adds = |word: &str| {
        [".append(", ".push(", ".add(", ".insert("].iter().any(|call| word.contains(call))
    };
    let hint = (p.behind(1) == RParen).then(|| {
        if adds(p.text_between(first, p.pos() - 1)) {
            return "nothing is added step by step: a list has what its value says, `[1, 2, 3]`"
                .into();
        }
        format!(
            "what is asked is the value of something: `name => {}`",
            p.quoted(first, p.pos() - 1)
        )
    });
    let hint = hint.or_else(|| {
        let assigns = p.at(ColonEq);
        assigns
            .then(|| "a value is given with `=`; `:=` stands in the methods of a constraint".into())
    });
    let hint = hint.or_else(|| {
        let is_given = p.at(Colon) && !p.begins_line(0) && !p.begins_line(1);
        is_given.then(|| {
            // `a[i]: Real = i`
            if p.behind(1) == RBracket {
                return format!(
                    "a part that is declared in a loop has an element for every turn: `{}: {}`",
                    p.text_between(first, first),
                    p.quoted_line(p.pos() + 1)
                );
            }
            format!("write `{} = {}`", p.quoted(first, p.pos() - 1), p.quoted_line(p.pos() + 1))
        })
    });
    p.expected_hint("expected-value", "`=` and a value", hint);
}

/// What a part or a step is: an expression, or a block of steps.
fn value(p: &mut Parser<'_>) {
    if p.at(IfKw) {
        statements::conditional_value(p);
    } else if !programs::block_value(p) {
        expression(p);
    }
}

/// `scaled(by k: Real): Rectangle => …`, after its modifiers; returns true if it says what it answers.
fn message(p: &mut Parser<'_>) -> bool {
    p.expect(Ident, "expected-name", "a message's name");
    if p.at(LParen) {
        parameters(p);
    }
    if p.eat(Colon) {
        class_name(p);
    }
    let defined = p.eat(FatArrow);
    if defined {
        expression(p);
    }
    defined
}

/// `default picture => …`, `combining picture => …`, `replacing trimmed(at c: Curve) => …`, `static builtin around(center: Point, through: Point): Circle`
fn modified(p: &mut Parser<'_>) {
    p.start_documented(Message);
    let mut builtin = false;
    let modifiers = ["default", "combining", "builtin", "static", "replacing"];
    while p.nth(1) == Ident && modifiers.contains(&p.word(0)) {
        builtin |= p.word(0) == "builtin";
        p.bump_keyword();
    }
    if !message(p) && !builtin {
        p.expected("expected-value", "`=>` and what the message answers");
    }
    p.finish();
}

/// `unit mm`, `unit m/s`
fn unit(p: &mut Parser<'_>) {
    p.start_documented(UnitLine);
    p.bump_keyword();
    p.expect(Ident, "expected-unit", "a unit");
    while p.at(Slash) && !p.begins_line(0) {
        p.bump();
        p.expect(Ident, "expected-unit", "a unit after `/`");
    }
    p.finish();
}

/// `abstract class A is B as b, C { … }`
fn class(p: &mut Parser<'_>) {
    p.start_documented(Class);
    if p.eat_word("abstract") && !p.at_word(0, "class") {
        p.expected("expected-class", "`class` or `program`");
        p.finish();
        return;
    }
    p.bump_keyword();
    p.expect(Ident, "expected-name", "the class's name");
    superclasses(p);
    if p.at(LBrace) {
        body(p, Scope::Thing);
    }
    p.finish();
}

/// `is B as b, C`; returns true where a colon behind it was reported, in the place of a body.
pub(super) fn superclasses(p: &mut Parser<'_>) -> bool {
    if mistakes::elsewhere::body_by_colon(p, "") {
        return true;
    }
    let elsewhere = p.at(Colon) && p.nth(1) == Ident
        || p.at(Ident) && matches!(p.word(0), "extends" | "inherits" | "implements");
    if elsewhere {
        let (at, class, above) = (p.pos(), p.text_between(p.pos() - 1, p.pos() - 1), p.word(1));
        let said = (
            "expected-is",
            format!("found `{}`, wanted `is`", p.word(0)),
            format!("write `class {class} is {above}`"),
        );
        let is = if p.is_adjacent(0) { " is" } else { "is" };
        p.report_mistake((at, at), said, Some((p.span_at(at), is.into())));
        p.bump();
    } else if !p.eat_word("is") {
        return false;
    }
    loop {
        p.start(Superclass);
        class_name(p);
        if p.eat_word("as") {
            p.expect(Ident, "expected-name", "a name for the superclass's part");
        }
        p.finish();
        if !p.eat(Comma) {
            return mistakes::elsewhere::body_by_colon(p, "");
        }
    }
}

/// `weak constraint …`, `strong stay …`
fn strengthened(p: &mut Parser<'_>) {
    if mistakes::elsewhere::strength_behind_rule(p) {
        return p.skip_line();
    }
    match p.word(1) {
        "stay" => {
            p.start_documented(Stay);
            p.bump_keyword();
            p.bump_keyword();
            paths(p);
            p.finish();
        }
        "constraint" => constraint(p),
        _ => {
            let message = format!("found `{}` alone, wanted a constraint after it", p.word(0));
            p.report(
                "strength-alone",
                message,
                Some("write `weak constraint a = b` or `weak stay a`".into()),
            );
            p.skip_line();
        }
    }
}

/// `apex: side2.p2 = side3.p2`, after `merge`
fn merge(p: &mut Parser<'_>) {
    if p.at(Ident) && p.nth(1) == Colon {
        p.bump();
        p.bump();
    }
    path(p);
    if !p.at(Eq) {
        let is_joined = p.at(Comma) || p.at(SyntaxKind::AndKw);
        let hint = is_joined.then(|| "merged are things with `=`: `merge a = b`".to_string());
        p.expected_hint("expected-merge", "`=` and what to merge it with", hint);
    }
    while p.eat(Eq) {
        path(p);
    }
}

/// `target: Section -> document report.introduction`, after `ref`
fn reference(p: &mut Parser<'_>) {
    p.expect(Ident, "expected-name", "the reference's name");
    if p.expect(Colon, "expected-class", "`:` and a class") {
        class_name(p);
    }
    if p.at(Eq) {
        let hint =
            format!("what is named stands behind an arrow: `-> {}`", p.quoted_line(p.pos() + 1));
        p.expected_hint("expected-value", "`->` and what it names", Some(hint));
        p.bump();
        expression(p);
    }
    if p.eat(Arrow) {
        if p.nth(1) == Ident && !p.begins_line(1) {
            p.eat_word("document");
        }
        path(p);
    }
}

/// `Fit { loose, normal, close }`, after `choice`
fn choice(p: &mut Parser<'_>) {
    p.expect(Ident, "expected-name", "the choice's name");
    if !p.expect(LBrace, "expected-body", "what there is to choose in `{ }`") {
        return;
    }
    while p.at(Ident) {
        p.bump();
        if !p.eat(Comma) && !p.begins_line(0) && !p.at(SyntaxKind::RBrace) {
            break;
        }
    }
    if !p.at(SyntaxKind::RBrace) {
        let hint = "options are names with commas between them: `choice Fit { loose, close }`";
        p.expected_hint("expected-option", "a name, `,` or `}`", Some(hint.into()));
        p.skip_in_braces();
    }
    p.eat(SyntaxKind::RBrace);
}

/// A name in quotes; one without them is taken for it.
fn name_in_quotes(p: &mut Parser<'_>, wanted: &str, word: &str) {
    if p.at(Ident) {
        let hint = format!("its name stands in quotes: `{word} \"{}\"`", p.word(0));
        p.expected_hint("expected-text", wanted, Some(hint));
        p.bump();
    } else {
        p.expect(Text, "expected-text", wanted);
    }
}

/// `"Mechanics" { Spring, Beam }`, after `toolbox`
fn toolbox(p: &mut Parser<'_>) {
    name_in_quotes(p, "the toolbox's name in quotes", "toolbox");
    if !p.expect(LBrace, "expected-body", "the tools in `{ }`") {
        return;
    }
    while p.at(Ident) {
        dotted_name(p, "a class");
        p.eat(Comma);
    }
    p.expect(SyntaxKind::RBrace, "expected-brace", "a class or `}`");
}

/// Reports what begins no member, and skips its line.
pub(super) fn unknown(p: &mut Parser<'_>) {
    if p.current().is_reserved() && p.names_itself(1) {
        let message = format!("found the reserved word `{}`, wanted a name", p.word(0));
        p.report("reserved-word", message, Some("give it another name".into()));
        p.skip_line();
        return;
    }
    if !mistakes::elsewhere::rule_follows(p) && mistakes::comma_between(p) {
        return p.bump();
    }
    if mistakes::elsewhere::strange_unit(p) {
        p.start(Error);
        p.bump();
        return p.finish();
    }
    if mistakes::of_member(p) {
        p.skip_line();
        return;
    }
    let hint = if p.at(Ident) {
        let words = KEYWORDS.iter().copied().filter(|word| word.len() > 2);
        Some(match base::diagnostic::nearest(p.word(0), words) {
            Some(word) if p.word(0) != word && p.nth(1) == Ident => {
                format!("did you mean `{word}`?")
            }
            _ => "a part is written `name: Class`, a value `name = value`".into(),
        })
    } else if matches!(p.current(), RParen | RBracket) {
        Some("it closes nothing: take it away, or write the bracket that it closes".into())
    } else {
        None
    };
    p.expected_hint("expected-member", mistakes::MEMBER, hint);
    p.skip_line();
}
