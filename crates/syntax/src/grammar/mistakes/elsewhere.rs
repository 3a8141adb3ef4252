//! Words and signs that other languages have where a member begins: what stands for them here.

use super::MEMBER;
use crate::kind::SyntaxKind;
use crate::kind::SyntaxKind::{
    AndKw, Arrow, Colon, ColonEq, Comma, Eof, Eq, FatArrow, Greater, GreaterEq, Ident, LBrace,
    LBracket, LParen, Less, LessEq, Minus, NotEq, NotKw, Number, Plus, RBrace, RBracket, RParen,
    Semicolon, Slash, Star, Text, Unit,
};
use crate::parser::Parser;
use crate::units::follows_operand;

/// Reports what begins no member as the word or sign of another language; returns false where it is none that is known.
pub(super) fn of_member(p: &mut Parser<'_>) -> bool {
    if let Some(hint) = word_for_sign(p).or_else(|| sign(p)).or_else(|| word(p)) {
        let at = p.pos();
        let message = format!("found `{}`, wanted {MEMBER}", p.word(0));
        p.report_mistake((at, at), ("expected-member", message, hint), None);
        return true;
    }
    false
}

/// A word that begins a member in other languages: what is written for it.
fn word(p: &Parser<'_>) -> Option<String> {
    if matches!(p.word(0), "equation" | "equations" | "algorithm" | "constraints" | "rules")
        && p.at(Ident)
        && p.begins_line(1)
    {
        return Some("each rule has its own word: `constraint x + y = 3`".into());
    }
    if p.at_word(0, "begin") && p.begins_line(1) {
        return Some(
            "what belongs together stands in braces, `{ … }`, without `begin` and `end`".into(),
        );
    }
    if !p.at(Ident) || p.begins_line(1) || p.nth(1) == Eof {
        return None;
    }
    let next = p.word(1);
    let is_named = p.nth(1) == Ident;
    Some(match p.word(0) {
        "from" if p.nth(1) == Number && p.at_word(2, "to") && !p.begins_line(0) => {
            format!("a range of whole numbers is `in {next}..{}`", p.word(3))
        }
        "import" | "include" | "require" | "using" if is_named => {
            format!("a library is brought by its name: `use {next}`")
        }
        "import" | "include" | "require" if p.nth(1) == Text => {
            format!("a library is brought by its name: `use {}`", next.trim_matches('"'))
        }
        "def" | "function" | "fn" | "func" | "fun" | "method" | "sub" if p.nth(2) == LParen => {
            format!("what is computed is a message: `{next}(x: Real) => 2 * x`")
        }
        "elif" | "elseif" | "elsif" => "another condition is `else if c { … }`".into(),
        "do" if is_named && p.nth(2) == Eq && p.nth(4) == Comma => {
            let (first, last) = (p.word(3), p.word(5));
            format!("a loop goes through numbers: `for {next} in {first}..{last} {{ … }}`")
        }
        "connect" | "join" | "link" | "attach" | "glue" | "wire" if is_named => {
            let rest = p.text_between(p.pos() + 1, p.line_end());
            let pair = [" to ", " with ", " and "].iter().find_map(|word| rest.split_once(word));
            let (a, b) = pair.filter(|_| rest.len() < 60).unwrap_or(("a", "b"));
            format!("two become one by `merge {} = {}`", a.trim(), b.trim())
        }
        "forall" | "foreach" | "loop" if is_named => {
            "many at once are a loop: `for i in 0..<3 { constraint xs[i] > 0 }`".into()
        }
        "solve" => "what is to hold is a rule, and is solved: `constraint x^2 = 4`".into(),
        "minimize" | "minimise" | "maximize" | "maximise" => {
            "nothing is minimized: what is wished is a soft rule, `weak constraint x = 0`".into()
        }
        "private" | "public" | "protected" | "final" | "readonly" | "mut" if is_named => {
            format!("every part is seen, and stays as it is given: leave `{}` out", p.word(0))
        }
        "assert" | "ensure" | "should" => {
            "what is to be true in a check is expected: `expect x = 3`".into()
        }
        "test" | "it" | "describe" if p.nth(1) == Text => format!("write `check {next} {{ … }}`"),
        "struct" | "type" | "record" | "object" | "interface" | "entity" | "model" | "block"
        | "module" | "trait"
            if is_named =>
        {
            format!("a class is declared by `class {next} {{ … }}`")
        }
        "end" | "endif" | "endfor" if is_named => {
            "a body ends with the `}` that closes its `{`: leave the line out".into()
        }
        "table" if p.nth(1) == Text => {
            format!(
                "a table belongs to a family of a program: `family Bolts of Bolt {{ table {next} }}`"
            )
        }
        "parameter" | "input" | "output" | "attribute" | "property"
            if is_named && p.nth(2) == Colon =>
        {
            format!(
                "a program's parameters stand in its brackets, parts by themselves: leave `{}` out",
                p.word(0)
            )
        }
        "parameter" | "input" | "output" | "attribute" | "property" if is_named => {
            let is_of_class = p.nth(2) == Ident && !p.begins_line(2) && p.nth(3) != Colon;
            let has_value = p.nth(3) == Eq && !p.begins_line(3) && !ends_line(p, 4);
            let declared = match is_of_class {
                true if has_value => {
                    format!("{}: {next} = {}", p.word(2), p.quoted_line(p.pos() + 4))
                }
                true => format!("{}: {next}", p.word(2)),
                false => format!("{next}: Real"),
            };
            format!("a part has its class behind it: `{declared}`")
        }
        _ => return other_word(p, is_named),
    })
}

/// The same of words that begin a sentence rather than a declaration.
fn other_word(p: &Parser<'_>, is_named: bool) -> Option<String> {
    let next = p.word(1);
    Some(match p.word(0) {
        "override" | "virtual" | "new" if is_named => {
            format!("what a class says again counts: leave `{}` out", p.word(0))
        }
        "from" if is_named => format!("a library is brought by its name: `use {next}`"),
        "subject" if next == "to" => {
            format!("what is to hold is a rule: `constraint {}`", p.quoted_line(p.pos() + 2))
        }
        "where" if is_named && !matches!(p.nth(2), Colon | Ident) => {
            format!("what is to hold is a rule: `constraint {}`", p.quoted_line(p.pos() + 1))
        }
        "print" | "show" | "display" | "echo" | "println" if is_named && p.nth(2) != Colon => {
            format!(
                "every value is shown by itself; what is computed has a name: `answer => {}`",
                p.quoted_line(p.pos() + 1)
            )
        }
        "soft" | "hard" | "optional" if next == "constraint" => {
            "a strength is weak, medium or strong: `weak constraint x = 0`".into()
        }
        "include" | "import" if p.nth(1) == Less => {
            "a library is brought by its name: `use geometry`".into()
        }
        _ => return None,
    })
}

/// `class A()`, `class A(B)`, `class A(x, y)`: what is written for it.
fn class_in_brackets(p: &Parser<'_>) -> Option<String> {
    if p.behind(1) != Ident {
        return None;
    }
    let (class, inner) = (p.text_between(p.pos() - 1, p.pos() - 1), p.word(1));
    Some(match (p.nth(1), p.nth(2)) {
        (RParen, _) => format!("a class has no brackets: `class {class} {{ … }}`"),
        (Ident, RParen | Comma) if inner.starts_with(char::is_uppercase) => {
            format!("write `class {class} is {inner}`")
        }
        (Ident, _) => {
            format!("the parts of a class stand in its body: `class {class} {{ {inner}: Real }}`")
        }
        _ => return None,
    })
}

/// What goes on where a member has ended: what is written for it.
fn sign(p: &Parser<'_>) -> Option<String> {
    if p.begins_line(0) {
        return None;
    }
    let of = p.word_before();
    let before = |n: usize| p.text_between(p.pos().saturating_sub(n), p.pos().saturating_sub(n));
    let hint = match p.current() {
        Comma if of == "use" => format!("each has a line of its own: `use {}`", p.word(1)),
        LBrace if of == "use" => "a library brings all that it has: leave the braces out".into(),
        Comma if of == "unit" => {
            "a sheet has one unit, that of its lengths; others stand behind their numbers, `30 deg`"
                .into()
        }
        Comma if ends_line(p, 1) => "nothing follows the comma: leave it out".into(),
        Comma if rule_follows(p) && of == "expect" => "each has its own `expect`".into(),
        Comma if rule_follows(p) => "two rules are joined by `and`".into(),
        Colon if of == "constraint" && p.behind(1) == Text => {
            let name = before(1).trim_matches('"');
            format!("the name of a constraint has no quotes: `constraint {name}: …`")
        }
        Colon if p.behind(1) == Number && p.nth(1) == Number && !p.is_adjacent(1) => {
            "a proportion is an equation of quotients: `constraint a / b = 2 / 3`".into()
        }
        LParen if of == "class" => return class_in_brackets(p),
        Ident if p.word(0) == "as" && of == "use" => {
            format!(
                "what is used keeps its names; of two alike one says whose: `{}.Line`",
                before(1)
            )
        }
        LParen if before(1) == "super" => {
            "the answer of the superclasses has a name: `super.picture`".into()
        }
        Text if matches!(p.behind(1), Number | Unit | Text) && p.word(0).len() > 1 => {
            format!(
                "what the lab says of it stands before it: `/// {}`",
                p.word(0).trim_matches('"')
            )
        }
        Less | LessEq | Greater | GreaterEq
            if p.behind(1) == Ident && p.behind(2) == Colon && before(1) != "List" =>
        {
            let bound = p.quoted(p.pos(), p.line_end());
            format!("a bound is a rule of its own: `constraint {} {bound}`", before(3))
        }
        // `5 ft 3 in`
        Number if p.behind(1) == Unit && p.behind(2) == Number && p.nth(1) == Unit => {
            let (large, small) =
                (p.quoted(p.pos() - 2, p.pos() - 1), p.quoted(p.pos(), p.pos() + 1));
            format!("what is measured in two units is a sum: `{large} + {small}`")
        }
        Ident if p.behind(1) == Unit && expr::units::unit(p.word(0)).is_some() => {
            format!("units are joined without spaces: `{}*{}`", before(1), p.word(0))
        }
        Ident if before(1) == "%" && p.word(0) == "of" => {
            format!("a part of something is a product: `{}% * {}`", before(2), p.word(1))
        }
        Number | Ident if before(1) == "%" && p.behind(2) == Number => {
            format!("the remainder is `{} mod {}`", before(2), p.word(0))
        }
        FatArrow if p.behind(2) == Eq && p.behind(3) == Ident => {
            let (name, of, body) = (before(3), before(1), p.quoted_line(p.pos() + 1));
            format!("what is computed is a message: `{name}({of}: Real) => {body}`")
        }
        FatArrow
            if (p.behind(1), p.behind(2), p.behind(3)) == (RParen, Ident, LParen)
                && (p.behind(4), p.behind(5)) == (Eq, Ident) =>
        {
            let (name, of, body) = (before(5), before(2), p.quoted_line(p.pos() + 1));
            format!("what is computed is a message: `{name}({of}: Real) => {body}`")
        }
        Number | Ident | Minus if is_bound(p) => {
            let bound = p.quoted(p.pos(), p.line_end());
            format!("a bound is a rule of its own: `constraint {bound}`")
        }
        Ident if matches!(p.word(0), "weak" | "medium" | "strong" | "required") => {
            format!("a strength stands before its rule: `{} constraint …`", p.word(0))
        }
        Ident if p.word(0) == "to" && matches!(of, "set" | "move") => {
            format!("several are {of} with commas between: `{of} x to 3, y to 4`")
        }
        Ident if p.word(0) == "where" => {
            "what a value speaks of is named before it: `let a = 3 in 2 * a`".into()
        }
        NotKw if p.at_word(1, "in") || p.word(1) == "in" => {
            "it is denied as a whole: `not (x in [1, 2])`".into()
        }
        Less if of == "class" && p.behind(1) == Ident => {
            format!("write `class {} is {}`", before(1), p.word(1))
        }
        Eq if of == "class" && p.nth(1) == LBrace => {
            format!("a body follows its class: `class {} {{ … }}`", before(1))
        }
        _ => return behind_value(p, of),
    };
    Some(hint)
}

/// The same where that stands behind a value; `of` is the word before the member.
fn behind_value(p: &Parser<'_>, of: &str) -> Option<String> {
    let before = |n: usize| p.text_between(p.pos().saturating_sub(n), p.pos().saturating_sub(n));
    Some(match p.current() {
        // `List of Bolt 3`
        Number if p.behind(1) == Ident && p.behind(2) == Ident && before(2) == "of" => {
            format!(
                "how many there are stands before the class: `List of {} {}`",
                p.word(0),
                before(1)
            )
        }
        Ident if p.word(0) == "between" => "write `1 <= x <= 3`".into(),
        Ident if p.word(0) == "div" => {
            format!("how often it goes into it is `floor({} / {})`", before(1), p.word(1))
        }
        ColonEq if of == "constraint" => {
            let rule = p.quoted_line(p.pos() + 1);
            format!("a rule is an equation: `constraint {} = {rule}`", before(1))
        }
        // `x: Real = 3 within 0.1`
        Ident if p.word(0) == "within" && (p.behind(2) == Eq || p.behind(3) == Eq) => {
            "a value is exact; how nearly something holds is said of a rule: `constraint x = 3 within 0.1`"
                .into()
        }
        // `x: Integer 1..10`
        Number if (p.behind(1), p.behind(2), p.nth(1)) == (Ident, Colon, SyntaxKind::DotDot) => {
            format!("a range of whole numbers is `in {}..{}`", p.word(0), p.word(2))
        }
        // `r: Resistor 100 ohm`
        Number if (p.behind(1), p.behind(2)) == (Ident, Colon) => {
            let class = before(1);
            format!("a value is given with `=`, those of parts in a body: `{class} {{ x = {} }}`", p.word(0))
        }
        // `3 4`, and no thousands
        Number if p.behind(1) == Number && p.behind(2) == Eq && p.word(0).len() != 3 => {
            format!("several values stand in a list: `[{}, {}]`", before(1), p.word(0))
        }
        // `= a b`, `2 * a b`
        Ident
            if p.behind(1) == Ident
                && matches!(p.behind(2), Eq | Plus | Minus | Star | Slash)
                && !p.names_itself(1) =>
        {
            format!("a product has its sign: `{} * {}`", before(1), p.word(0))
        }
        Ident if p.word(0) == "per" && p.behind(1) == Unit => {
            format!("a unit is divided without spaces: `{}/{}`", before(1), p.word(1))
        }
        _ => return None,
    })
}

/// `5 % per year`, `3 m x 4 m`, `x between 1 and 3`: words that stand for a sign.
fn word_for_sign(p: &Parser<'_>) -> Option<String> {
    let before = |n: usize| p.text_between(p.pos().saturating_sub(n), p.pos().saturating_sub(n));
    Some(match p.current() {
        Ident if before(1) == "%" && p.word(0) == "per" => {
            format!("a unit is divided without spaces: `{} %/{}`", before(2), p.word(1))
        }
        Ident if p.word(0) == "x" && p.behind(1) == Unit && p.nth(1) == Number => {
            let (one, other) =
                (p.quoted(p.pos() - 2, p.pos() - 1), p.quoted(p.pos() + 1, p.line_end()));
            format!("a product has its sign: `{one} * {other}`")
        }
        Ident
            if p.word(0) == "between"
                && (p.nth(1), p.nth(2), p.nth(3)) == (Number, AndKw, Number) =>
        {
            match (p.behind(2), before(1)) {
                (Colon, "Integer") => {
                    format!("a range of whole numbers is `in {}..{}`", p.word(1), p.word(3))
                }
                (Colon, _) => {
                    let (low, name, high) = (p.word(1), before(3), p.word(3));
                    format!("what lies between is a rule: `constraint {low} <= {name} <= {high}`")
                }
                _ => format!("write `{} <= {} <= {}`", p.word(1), before(1), p.word(3)),
            }
        }
        _ => return None,
    })
}

/// `<>`, `=<`: what it is, what is written for it, and the hint.
pub(in crate::grammar) fn turned(
    p: &Parser<'_>,
) -> Option<(&'static str, &'static str, &'static str)> {
    match (p.current(), p.nth(1)) {
        (Less, Greater) => Some(("<>", "!=", "unlike is `!=`")),
        (Eq, Less) => Some(("=<", "<=", "less or equal is `<=`")),
        _ => None,
    }
}

/// `constraint: x = 3`: a rule of which the name was left out, with its colon. Returns true where it was reported.
pub(in crate::grammar) fn colon_without_name(p: &mut Parser<'_>) -> bool {
    let (first, last) = (p.pos(), p.line_end());
    let is_class = p.nth(2) == Ident && p.word(2).starts_with(char::is_uppercase);
    let is_one =
        p.word(0) == "constraint" && !is_class && (2..=last - first).any(|n| compares(p.nth(n)));
    if is_one {
        let rule = p.quoted_line(first + 2);
        let said = (
            "expected-name",
            "found `:` after `constraint`, wanted a name or a rule".to_string(),
            format!("a rule without a name has no colon: `constraint {rule}`"),
        );
        p.report_mistake((first + 1, first + 1), said, Some((p.span_at(first + 1), String::new())));
        p.skip_line();
    }
    is_one
}

fn compares(kind: SyntaxKind) -> bool {
    matches!(kind, Eq | Less | LessEq | Greater | GreaterEq | NotEq)
}

/// `x: Real {1 <= x <= 3}`: returns true at the first word of a part's body, where a comparison stands on its line.
fn is_bound(p: &Parser<'_>) -> bool {
    let begins_body = p.behind(1) == LBrace && p.behind(2) == Ident && p.behind(3) == Colon;
    // what has two names in a row, commas or a body of its own is something else
    let goes_on = |&n: &usize| {
        !matches!(p.nth(n), Comma | Colon | LBrace) && (p.nth(n - 1), p.nth(n)) != (Ident, Ident)
    };
    let mut within = (1..=p.line_end() - p.pos()).take_while(goes_on);
    begins_body && !p.begins_line(0) && within.any(|n| compares(p.nth(n)))
}

/// `forall i: xs[i] > 0` after `constraint`: returns true where it was reported.
pub(in crate::grammar) fn for_all(p: &mut Parser<'_>) -> bool {
    let is_one = matches!(p.word(0), "forall" | "foreach" | "every")
        && p.nth(1) == Ident
        && !p.begins_line(1);
    if is_one {
        let at = p.pos();
        let said = (
            "expected-member",
            format!("found `{}` in a rule", p.word(0)),
            format!("a rule for each is a loop: `for {} in … {{ constraint … }}`", p.word(1)),
        );
        p.report_mistake((at, at), said, None);
    }
    is_one
}

/// `sum x = 3` after `constraint`: a name without its colon, or a product without its sign. Returns true where it was
/// reported.
pub(in crate::grammar) fn name_without_colon(p: &mut Parser<'_>) -> bool {
    let compares = matches!(
        p.nth(2),
        Eq | Less | LessEq | Greater | GreaterEq | NotEq | Plus | Minus | Star | Slash
    );
    let is_one = p.at(Ident)
        && p.nth(1) == Ident
        && compares
        && !p.begins_line(1)
        && !p.begins_line(2)
        && ![p.word(0), p.word(1)].iter().any(|word| follows_operand(word));
    if is_one {
        let at = p.pos();
        let (name, next, rest) = (p.word(0), p.word(1), p.quoted_line(at + 1));
        let said = (
            "expected-colon",
            format!("found `{next}` after the name `{name}`, wanted `:`"),
            format!(
                "a name has its colon, `constraint {name}: {rest}`; a product its sign, `constraint {name} * {rest}`"
            ),
        );
        p.report_mistake((at + 1, at + 1), said, None);
    }
    is_one
}

/// Returns true where no more of the line follows, so many tokens ahead.
fn ends_line(p: &Parser<'_>, n: usize) -> bool {
    p.begins_line(n) || matches!(p.nth(n), Eof | RBrace | Semicolon)
}

/// `constraint x = 3, y = 4`: returns true at a comma between rules, where no member with a class follows.
pub(in crate::grammar) fn rule_follows(p: &Parser<'_>) -> bool {
    let declares =
        p.nth(1) == Ident && p.nth(2) == Colon && p.word(3).starts_with(char::is_uppercase);
    let is_rule = match p.word_before() {
        "replace" => !p.declared_before(),
        word => matches!(word, "constraint" | "expect" | "task"),
    };
    p.at(Comma) && is_rule && !ends_line(p, 1) && !declares
}

/// Returns true where the class of a list stands in brackets, so many tokens ahead: `(List of 3 Integer)`.
pub(in crate::grammar) fn is_list_in_brackets(p: &Parser<'_>, n: usize) -> bool {
    p.nth(n) == LParen
        && p.nth(n + 1) == Ident
        && matches!(p.word(n + 1), "List" | "Set" | "Path" | "Placed")
        && matches!(p.word(n + 2), "of" | "to")
}

/// Returns true for the words before the class of a list's elements, `List of 3`, by the index of one.
fn is_of_list(p: &Parser<'_>, at: usize) -> bool {
    let word = p.text_between(at, at);
    let is_count = || {
        word.starts_with(char::is_alphanumeric) && at > 0 && p.text_between(at - 1, at - 1) == "of"
    };
    matches!(word, "List" | "Set" | "Path" | "Placed" | "of" | "to") || is_count()
}

/// Reports the brackets around the class of a list; those within are none either.
pub(in crate::grammar) fn list_in_brackets(p: &mut Parser<'_>) {
    let at = p.pos();
    let mut first = at;
    while first > 0 && is_of_list(p, first - 1) {
        first -= 1;
    }
    let before = if first < at { p.quoted(first, at - 1) } else { String::new() };
    let inner = match p.bracket_length() {
        0 => p.quoted_class(at + 1),
        length => p.quoted(at + 1, (at + length - 1).max(at + 1)),
    };
    let computes = inner.contains(['+', '-', '*', '/']);
    let inner = if computes { inner } else { inner.replace(['(', ')'], "") };
    let class = format!("{before} {inner}");
    let said = (
        "expected-class",
        "found `(`, wanted a class".to_string(),
        format!("a class stands without brackets: `{}`", class.trim_start()),
    );
    p.report_mistake((at, at), said, None);
}

/// `4 furlong  x: Real`: a word that is no unit, with the next member on its line. Returns true where it was reported.
pub(in crate::grammar) fn strange_unit(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(Ident)
        && p.behind(1) == Number
        && !p.begins_line(0)
        && p.nth(1) == Ident
        && !p.begins_line(1)
        && p.names_itself(2);
    if is_one {
        p.expected("expected-member", MEMBER);
    }
    is_one
}

/// `Point(3 4)`: returns true where it was reported. What follows is the next element.
pub(in crate::grammar) fn without_comma(p: &mut Parser<'_>) -> bool {
    let said = comma_left_out(p);
    let is_one = said.is_some();
    // of three names one after the other the first gap is told
    let is_told = p.at(Ident)
        && (p.behind(2) == Ident || p.text_between(p.pos() - 1, p.pos() - 1) == "lambda");
    if let Some(said) = said.filter(|_| !is_told) {
        p.report_mistake((p.pos(), p.pos()), said, None);
    }
    is_one
}

/// What is said of a number behind another, and of a name.
fn comma_left_out(p: &Parser<'_>) -> Option<(&'static str, String, String)> {
    let begins = |n: usize| matches!(p.behind(n), LParen | Comma);
    let are_names = p.at(Ident)
        && p.behind(1) == Ident
        && !super::is_keyword(p.text_between(p.pos() - 1, p.pos() - 1))
        && (begins(2) || p.behind(2) == Ident && begins(3));
    let are_numbers = p.at(Number) && matches!(p.behind(1), Number | Unit);
    let is_one = (are_numbers || are_names) && !p.begins_line(0);
    is_one.then(|| {
        (
            "expected-comma",
            format!("found `{}`, wanted `,` before it", p.word(0)),
            "what stands in brackets has commas between: `(3, 4)`".to_string(),
        )
    })
}

/// `[2 * i for i in 1..3]`, `Circle(…)` where a parameter stands: what brackets hold elsewhere, where their
/// end is wanted. Returns true where it was reported.
pub(in crate::grammar) fn in_brackets(p: &mut Parser<'_>, wanted: &str) -> bool {
    let at = p.pos();
    let said = match p.current() {
        Ident if p.behind(1) == Ident && p.text_between(at - 1, at - 1) == "lambda" => (
            "expected-bracket",
            format!("found `{}` after `lambda`, wanted {wanted}", p.word(0)),
            format!("a function of one argument is `{0} => 2 * {0}`", p.word(0)),
        ),
        _ if let Some(said) = comma_left_out(p) => said,
        Arrow if p.behind(1) == Ident => (
            "expected-bracket",
            format!("found `->` after `{}`, wanted `=>`", p.text_between(at - 1, at - 1)),
            format!("a function is written `{0} => 2 * {0}`", p.text_between(at - 1, at - 1)),
        ),
        Ident if p.word(0) == "for" && p.nth(1) == Ident && !p.begins_line(0) => (
            "expected-bracket",
            format!("found `for`, wanted {wanted}"),
            comprehension(p).unwrap_or_else(|| {
                "a list of what is computed is `(1..3).map(i => 2 * i)`".to_string()
            }),
        ),
        LParen if p.behind(1) == Ident && p.member_word().starts_with(char::is_uppercase) => (
            "expected-bracket",
            format!(
                "found `(` after `{}`, wanted `)` after the parameters",
                p.text_between(at - 1, at - 1)
            ),
            format!("a step has a name before it: `step = {}(…)`", p.member_word()),
        ),
        _ => return false,
    };
    p.report_mistake((at, at), said, None);
    true
}

/// Says at the `for` of `[2 * x for x in xs if x > 1]` how that is written.
fn comprehension(p: &Parser<'_>) -> Option<String> {
    /// So many tokens are looked at either way.
    const MOST: usize = 100;
    if p.word(2) != "in" {
        return None;
    }
    let (mut depth, mut first) = (0u32, p.pos().checked_sub(1)?);
    loop {
        match p.behind(p.pos() - first) {
            RParen | RBracket | RBrace => depth += 1,
            LParen | LBracket | LBrace if depth == 0 => break,
            LParen | LBracket | LBrace => depth -= 1,
            _ => {}
        }
        first = first.checked_sub(1).filter(|first| p.pos() - first < MOST)?;
    }
    let made = p.quoted(first + 1, p.pos() - 1);
    let (name, mut n, mut only) = (p.word(1), 3, None);
    loop {
        match p.nth(n) {
            RParen | RBracket | RBrace if depth == 0 => break,
            Eof | Semicolon => return None,
            _ if n > MOST => return None,
            LParen | LBracket | LBrace => depth += 1,
            RParen | RBracket | RBrace => depth -= 1,
            _ if p.word(n) == "if" && depth == 0 => only = Some(n),
            _ => {}
        }
        n += 1;
    }
    let (end, last) = (p.pos() + n - 1, p.pos() + only.unwrap_or(n) - 1);
    let of = p.quoted(p.pos() + 3, last);
    let of = if of.contains("..") { format!("({of})") } else { of };
    let only = only.map(|n| format!(".filter({name} => {})", p.quoted(p.pos() + n + 1, end)));
    let mapped = if made == name { String::new() } else { format!(".map({name} => {made})") };
    let is_sum = p.behind(p.pos() - first) == LParen
        && first.checked_sub(1).is_some_and(|at| p.text_between(at, at) == "sum");
    let sum = if is_sum { ".sum" } else { "" };
    Some(format!("write `{of}{}{mapped}{sum}`", only.unwrap_or_default()))
}

/// `xs.map { x => 2 * x }`: returns true at the `{`, where it was reported.
pub(in crate::grammar) fn braces_for_arguments(p: &mut Parser<'_>) -> bool {
    let at = p.pos();
    let asked = p.text_between(at - 1, at - 1);
    let is_one = p.at(LBrace)
        && !p.begins_line(0)
        && (p.nth(1), p.nth(2)) == (Ident, FatArrow)
        && matches!(asked, "map" | "filter" | "all" | "any");
    if is_one {
        let said = (
            "expected-bracket",
            format!("found `{{` after `{asked}`, wanted `(`"),
            format!("a function is an argument like any other: `{asked}({0} => …)`", p.word(1)),
        );
        p.report_mistake((at, at), said, None);
    }
    is_one
}

/// `constraint a = b weak` before the end of a line: returns true where it was reported. The next line is a rule of its
/// own.
pub(in crate::grammar) fn strength_behind_rule(p: &mut Parser<'_>) -> bool {
    let is_one = p.begins_line(1)
        && !p.begins_line(0)
        && !matches!(p.behind(1), LBrace | Semicolon | Eof)
        && matches!(p.word_before(), "constraint" | "stay");
    if is_one {
        let (at, strength) = (p.pos(), p.word(0));
        let said = (
            "expected-member",
            format!("found `{strength}` behind a rule, wanted the end of the line"),
            format!("a strength stands before its rule: `{strength} {} …`", p.word_before()),
        );
        p.report_mistake((at, at), said, None);
    }
    is_one
}

/// `copy a`: returns true where it was reported.
pub(in crate::grammar) fn copy_without_of(p: &mut Parser<'_>) -> bool {
    let is_one =
        p.nth(1) == Ident && !p.begins_line(1) && !p.names_itself(2) && !follows_operand(p.word(1));
    if is_one {
        let (at, of) = (p.pos(), p.word(1));
        let said = (
            "expected-word",
            format!("found `{of}` after `copy`, wanted `of`"),
            format!("write `copy of {of}`"),
        );
        p.report_mistake((at, at), said, Some((p.span_at(at), "copy of".into())));
    }
    is_one
}

/// `class Box:` at the end of a line, where `missing` stands in a hint before the body: returns true where it was
/// reported.
pub(in crate::grammar) fn body_by_colon(p: &mut Parser<'_>, missing: &str) -> bool {
    let is_one = p.at(Colon) && p.begins_line(1);
    if is_one {
        let at = p.pos();
        let said = (
            "expected-body",
            "found `:`, wanted `{`".to_string(),
            format!("a body stands in braces: `{}{missing} {{ … }}`", p.quoted(p.member(), at - 1)),
        );
        p.report_mistake((at, at), said, None);
        p.bump();
    }
    is_one
}

/// `12 mm +0.1/-0.2`: reports the two bounds of a drawing, behind the `+`.
pub(in crate::grammar) fn two_bounds(p: &mut Parser<'_>) {
    let signs = (p.nth(0), p.nth(1), p.nth(2), p.nth(3)) == (Number, Slash, Minus, Number);
    if signs && (0..4).all(|n| p.is_adjacent(n)) {
        let at = p.pos();
        let said = (
            "tolerance-sign",
            format!("found `+{}`, wanted one value", p.text_between(at, at + 3)),
            "what lies between two bounds is a rule: `constraint 11.8 mm <= d <= 12.1 mm`".into(),
        );
        p.report_mistake((at - 1, at + 3), said, None);
    }
}

/// `3 mm +- 0.1 mm`: reports the sign of a tolerance, behind its `+`.
pub(in crate::grammar) fn tolerance_sign(p: &mut Parser<'_>) {
    let is_one = p.at(Minus) && p.is_adjacent(0) && !p.is_adjacent(1) && p.nth(1) == Number;
    if is_one {
        let at = p.pos();
        let said = (
            "tolerance-sign",
            "found `+-`, wanted one operator".to_string(),
            "what is nearly equal is a rule, `constraint a = b within 0.1`".to_string(),
        );
        p.report_mistake((at - 1, at), said, None);
    }
}
