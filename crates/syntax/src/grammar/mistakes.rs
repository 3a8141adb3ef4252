//! Mistakes that beginners make, each told as a teacher would: what it is, and what to write instead.

pub(super) mod calls;
pub(super) mod elsewhere;
pub(super) mod numbers;
mod paper;
mod steps;

use super::members::is_keyword;
use crate::kind::SyntaxKind::{
    AndKw, Arrow, Colon, ColonEq, Comma, Dot, Ellipsis, Eof, Eq, EqEq, FatArrow, Greater,
    GreaterEq, Ident, LBrace, LBracket, LParen, Less, LessEq, LetKw, Minus, NotEq, NotKw, Number,
    OrKw, RBrace, RBracket, RParen, Semicolon, Text, TextOpen, Unit,
};
use crate::parser::Parser;
use base::Span;

/// What a member is, where another word begins one.
pub(super) const MEMBER: &str = "a part, constraint, message or value";

/// Reports a `{` that nothing closes, and what its body ended at.
pub(super) fn unclosed(p: &mut Parser<'_>, opener: usize) {
    let hint = match p.current() {
        Eof => "write `}` at its end".to_string(),
        _ => format!("by its indentation it ends before `{}`: write `}}` there", p.word(0)),
    };
    let said = ("expected-brace", "found no `}` for this `{`".to_string(), hint);
    p.report_mistake((opener, opener), said, None);
}

/// Reports what begins no member as the mistake that it is; returns false where it is none that is known.
pub(super) fn of_member(p: &mut Parser<'_>) -> bool {
    numbers::grouped_digits(p)
        || numbers::decimal_comma(p)
        || paper::of_member(p)
        || elsewhere::of_member(p)
        || comment(p)
        || declared_elsewhere(p)
        || enumeration(p)
        || steps::increment(p)
        || body_of_name(p)
        || bare_equation(p)
        || held(p)
        || capital_keyword(p)
        || name_and_class(p)
        || class_and_brackets(p)
        || values_in_braces(p)
        || relation_in_words(p)
        || several_values(p)
        || numbers::time_of_day(p)
        || prefixed_text(p)
        || spaces_in_name(p)
}

/// `= 3, 4`, where what is given is a place or a list: returns true where it was reported.
pub(super) fn several_values(p: &mut Parser<'_>) -> bool {
    let are_names =
        (p.behind(2), p.behind(1), p.nth(1)) == (Eq, Ident, Ident) && !p.names_itself(2);
    let is_one = p.at(Comma)
        && !p.begins_line(0)
        && (matches!(p.behind(1), Number | Unit | Text)
            && matches!(p.nth(1), Number | Minus | Text)
            || are_names);
    if is_one {
        let at = p.pos();
        let said = (
            "several-values",
            "found `,` after a value, wanted the end of the value".to_string(),
            "several values stand in brackets: `(3, 4)` is a place, `[3, 4]` a list".to_string(),
        );
        p.report_mistake((at, at), said, None);
    }
    is_one
}

/// `f"x = {x}"`
fn prefixed_text(p: &mut Parser<'_>) -> bool {
    let is_one = matches!(p.current(), Text | TextOpen)
        && p.is_adjacent(0)
        && p.behind(1) == Ident
        && matches!(p.text_between(p.pos() - 1, p.pos() - 1), "f" | "r" | "b" | "u");
    if is_one {
        let at = p.pos();
        let prefix = p.text_between(at - 1, at - 1);
        let said = (
            "expected-member",
            format!("found `{prefix}` before a text"),
            format!("a text has its values in braces by itself: leave `{prefix}` out"),
        );
        p.report_mistake((at - 1, at - 1), said, Some((p.span_at(at - 1), String::new())));
    }
    is_one
}

/// `{ load = 900 N, arm = 1.2 m }`: returns true where the comma was reported.
pub(super) fn comma_between(p: &mut Parser<'_>) -> bool {
    let mut end = 2;
    while p.nth(end) == Dot && p.nth(end + 1) == Ident {
        end += 2;
    }
    let is_one = p.at(Comma) && p.nth(1) == Ident && matches!(p.nth(end), Eq | Colon);
    if is_one {
        let at = p.pos();
        let said = (
            "comma-between",
            format!("found `,` before `{}`, wanted no sign or `;`", p.word(1)),
            "members of a body stand one after the other: write `;`".to_string(),
        );
        p.report_mistake((at, at), said, Some((p.span_at(at), ";".into())));
    }
    is_one
}

/// `-- words`
fn comment(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(Minus) && p.nth(1) == Minus && p.begins_line(0);
    if is_one {
        let at = p.pos();
        let said =
            ("comment", "found `--`, wanted `//`".to_string(), "a comment begins with `//`".into());
        p.report_mistake(
            (at, at + 1),
            said,
            Some((p.span_at(at).join(p.span_at(at + 1)), "//".into())),
        );
    }
    is_one
}

/// `let x = 3`, `var x`, `const g = 9.81`, `int n`
fn declared_elsewhere(p: &mut Parser<'_>) -> bool {
    const WORDS: [&str; 14] = [
        "let", "var", "val", "const", "def", "dim", "int", "float", "double", "number", "string",
        "part", "given", "known",
    ];
    let is_one = (p.at(LetKw) || p.at(Ident) && WORDS.contains(&p.word(0)))
        && p.nth(1) == Ident
        && !p.begins_line(1);
    if is_one {
        let (at, name) = (p.pos(), p.word(1));
        let class = match p.word(0) {
            "int" => "Integer",
            "string" => "Text",
            _ => "Real",
        };
        let has_value = p.nth(2) == Eq && !p.begins_line(2);
        let value = if has_value { p.text_between(at + 3, p.line_end()) } else { "" };
        let is_plain = !value.contains(|c: char| c.is_alphabetic() || c == '(');
        let is_quantity = (p.nth(3), p.nth(4)) == (Number, Unit) && at + 4 == p.line_end();
        // `(x) => 2 * x`
        let is_function = (p.nth(3), p.nth(4), p.nth(5), p.nth(6))
            == (LParen, Ident, RParen, FatArrow)
            && has_value;
        let hint = match value {
            "" if p.nth(2) == Colon && !p.begins_line(2) => {
                format!("a part is declared by itself: `{}`", p.quoted_line(at + 1))
            }
            "" => format!("a part is declared with its class: `{name}: {class}`"),
            _ if is_function => format!(
                "what is computed is a message: `{name}({}: Real) => {}`",
                p.word(4),
                p.quoted_line(at + 7)
            ),
            value if is_quantity => {
                let unit = expr::units::unit(p.word(4)).and_then(|unit| unit.dimension.named());
                let class = unit.unwrap_or("Real");
                format!("a part is declared with its class: `{name}: {class} = {value}`")
            }
            value if is_plain || class == "Text" => {
                format!("a part is declared with its class: `{name}: {class} = {value}`")
            }
            value => format!("what is computed is a message: `{name} => {value}`"),
        };
        let said = ("expected-member", format!("found `{}`, wanted {MEMBER}", p.word(0)), hint);
        p.report_mistake((at, at), said, None);
    }
    is_one
}

/// `enum Colour { red, green }`
fn enumeration(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(Ident)
        && matches!(p.word(0), "enum" | "enumeration" | "option")
        && p.nth(1) == Ident
        && p.nth(2) == LBrace;
    if is_one {
        let (at, name) = (p.pos(), p.word(1));
        let said = (
            "expected-member",
            format!("found `{}`, wanted {MEMBER}", p.word(0)),
            format!("options with names are a choice: `choice {name} {{ one, other }}`"),
        );
        p.report_mistake((at, at), said, None);
    }
    is_one
}

/// `x + y = 3`, `x > 3`
fn bare_equation(p: &mut Parser<'_>) -> bool {
    let first = p.pos();
    let last = p.line_end();
    let begins = matches!(p.current(), Ident | Number | LParen | Minus | Text);
    let compares = |n| matches!(p.nth(n), Eq | EqEq | Less | LessEq | Greater | GreaterEq | NotEq);
    let joins = p.at(Ident) && p.nth(1) == Ident;
    let before_brace = (1..=last - first).take_while(|&n| p.nth(n) != LBrace);
    let is_first = p.begins_line(0) || p.behind(1) == Semicolon;
    let is_one = begins && !joins && is_first && { before_brace }.any(compares);
    if is_one {
        equation_since(p, first, last);
    }
    is_one
}

/// Reports a comparison that stands among members.
pub(super) fn equation_since(p: &mut Parser<'_>, first: usize, last: usize) {
    let rule = p.text_between(first, last);
    let short = if rule.len() > 60 { "x = y" } else { rule };
    let said = (
        "bare-equation",
        format!("found an equation by itself, wanted {MEMBER}"),
        format!("write `constraint {short}`"),
    );
    let start = p.span_at(first).start;
    let fix = (Span::new(start, start), "constraint ".to_string());
    p.report_mistake((first, last), said, Some(fix));
}

/// `fix a`, `lock a.x`: what holds a part in other tools
fn held(p: &mut Parser<'_>) -> bool {
    const WORDS: [&str; 6] = ["fix", "fixed", "lock", "pin", "freeze", "hold"];
    let is_one =
        p.at(Ident) && WORDS.contains(&p.word(0)) && p.nth(1) == Ident && !p.begins_line(1);
    if is_one {
        let at = p.pos();
        let said = (
            "expected-member",
            format!("found `{}`, wanted {MEMBER}", p.word(0)),
            format!(
                "what shall stay as it is is held by `anchor {}`",
                p.text_between(at + 1, p.line_end())
            ),
        );
        p.report_mistake((at, at), said, Some((p.span_at(at), "anchor".into())));
    }
    is_one
}

/// `Class A { … }`, `Constraint x = 3`
fn capital_keyword(p: &mut Parser<'_>) -> bool {
    // the other words that begin a member might be classes, `Side a`
    const WORDS: [&str; 16] = [
        "class",
        "constraint",
        "merge",
        "use",
        "anchor",
        "check",
        "program",
        "constant",
        "choice",
        "abstract",
        "weak",
        "medium",
        "strong",
        "unit",
        "if",
        "for",
    ];
    let small = p.word(0).to_lowercase();
    let is_one = p.at(Ident)
        && p.word(0) != small
        && WORDS.contains(&small.as_str())
        && matches!(p.nth(1), Ident | Text)
        && !p.begins_line(1);
    if is_one {
        let at = p.pos();
        let said = (
            "expected-member",
            format!("found `{}`, wanted `{small}`", p.word(0)),
            format!("words of the language are written small: `{small} {}`", p.quoted_line(at + 1)),
        );
        p.report_mistake((at, at), said, Some((p.span_at(at), small)));
    }
    is_one
}

/// `constraint my rule: x = 3`: returns how many words the name has, where it was reported.
pub(super) fn spaced_name(p: &mut Parser<'_>) -> Option<usize> {
    let mut words = 1;
    while p.nth(words) == Ident && !p.begins_line(words) && words < 4 {
        words += 1;
    }
    let is_one = p.at(Ident) && words > 1 && p.nth(words) == Colon && !p.begins_line(words);
    is_one.then(|| {
        report_spaces(p, words);
        words
    })
}

/// Reports a name of so many words.
fn report_spaces(p: &mut Parser<'_>, words: usize) {
    let at = p.pos();
    let named: Vec<&str> = (0..words).map(|n| p.word(n)).collect();
    let (spaced, joined) = (named.join(" "), named.join("_"));
    let said = (
        "expected-name",
        format!("found `{spaced}`, wanted one word for a name"),
        format!("a name has no spaces: `{joined}`"),
    );
    let span = p.span_at(at).join(p.span_at(at + words - 1));
    p.report_mistake((at, at + words - 1), said, Some((span, joined)));
}

/// `my length: Length`
fn spaces_in_name(p: &mut Parser<'_>) -> bool {
    let mut words = 1;
    while p.nth(words) == Ident && !p.begins_line(words) && words < 4 {
        words += 1;
    }
    let is_class = |word: &str| word.starts_with(char::is_uppercase);
    let is_declared =
        p.nth(words) == Colon && p.nth(words + 1) == Ident && is_class(p.word(words + 1));
    let is_one = p.at(Ident) && words > 1 && !p.begins_line(words) && is_declared;
    if is_one {
        report_spaces(p, words);
    }
    is_one
}

/// `a Line`, `Line a`, `Point A = (1, 2)`
fn name_and_class(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(Ident) && p.nth(1) == Ident && !p.begins_line(1) && !is_keyword(p.word(0));
    if !is_one {
        return false;
    }
    let (a, b) = (p.word(0), p.word(1));
    let is_class = |word: &str| word.starts_with(char::is_uppercase);
    let (name, class) = match (is_class(a), is_class(b)) {
        (false, true) => (a, b),
        (true, _) => (b, a),
        (false, false) => return false,
    };
    let at = p.pos();
    let rest = if p.nth(2) == Eq && !p.begins_line(2) {
        format!(" {}", p.text_between(at + 2, p.line_end()))
    } else {
        String::new()
    };
    let said = (
        "expected-member",
        format!("found `{a} {b}`, wanted a part with its class"),
        format!("write `{name}: {class}{rest}`"),
    );
    let span = p.span_at(at).join(p.span_at(at + 1));
    p.report_mistake((at, at + 1), said, Some((span, format!("{name}: {class}"))));
    true
}

/// `c: Circle(a, 5)`, `q: Point[5]`: what follows a class without `=`
fn class_and_brackets(p: &mut Parser<'_>) -> bool {
    let is_one = matches!(p.current(), LParen | LBracket)
        && !p.begins_line(0)
        && p.behind(1) == Ident
        && p.behind(2) == Colon
        && p.behind(3) == Ident;
    if !is_one {
        return false;
    }
    let at = p.pos();
    let (name, class) = (p.text_between(at - 3, at - 3), p.text_between(at - 1, at - 1));
    let is_unit = p.at(LBracket) && p.nth(2) == RBracket && expr::units::unit(p.word(1)).is_some();
    let (said, fix) = if is_unit {
        let value = if p.nth(3) == Eq { p.quoted_line(at + 4) } else { "3".into() };
        let said = (
            "expected-member",
            format!("found a unit after the class {class}, wanted it after a number"),
            format!("a unit stands behind its number: `{name}: {class} = {value} {}`", p.word(1)),
        );
        (said, None)
    } else if p.at(LParen) {
        let value = p.text_between(at, p.line_end());
        let said = (
            "expected-member",
            format!("found `(` after the class {class}, wanted `=` and a value"),
            format!("a value is given with `=`: `{name}: {class} = {class}{value}`"),
        );
        let start = p.span_at(at).start;
        (said, Some((Span::new(start, start), format!(" = {class}"))))
    } else {
        let inner = if p.nth(1) == RBracket { "" } else { p.word(1) };
        let is_list = ["list", "array", "vector"].iter().any(|w| class.eq_ignore_ascii_case(w));
        let of = match (is_list, inner.starts_with(char::is_uppercase)) {
            (true, true) => inner.to_string(),
            // `List[3] of Real`
            (true, false) if p.at_word(3, "of") => format!("{inner} {}", p.word(4)),
            (true, false) => format!("{inner} Real"),
            (false, _) => format!("{inner} {class}"),
        };
        let said = (
            "expected-member",
            format!("found `[` after the class {class}, wanted {MEMBER}"),
            format!("a list is written `{name}: List of {}`", of.trim_start()),
        );
        (said, None)
    };
    p.report_mistake((at, at), said, fix);
    true
}

/// `p: Point { 1, 2 }`
fn values_in_braces(p: &mut Parser<'_>) -> bool {
    let is_one = matches!(p.current(), Number | Minus | LParen | LBracket)
        && p.behind(1) == LBrace
        && p.behind(2) == Ident
        && p.behind(3) == Colon;
    if is_one {
        let at = p.pos();
        let class = p.text_between(at - 2, at - 2);
        let said = (
            "expected-member",
            format!("found `{}`, wanted {MEMBER}", p.word(0)),
            format!(
                "the parts of a {class} by their places stand in round brackets: `= (…)` after its class"
            ),
        );
        p.report_mistake((at, at), said, None);
    }
    is_one
}

/// `constraint a on b`, `constraint a touches b`
fn relation_in_words(p: &mut Parser<'_>) -> bool {
    const WORDS: [&str; 9] = [
        "on",
        "lies",
        "touches",
        "meets",
        "through",
        "parallel",
        "perpendicular",
        "tangent",
        "equals",
    ];
    let is_one = p.at(Ident)
        && !p.begins_line(0)
        && WORDS.contains(&p.word(0))
        && matches!(p.behind(1), Ident | RParen | RBracket);
    if is_one {
        let at = p.pos();
        let hint = match p.word(0) {
            "equals" => "equal is `=`".to_string(),
            _ => "a relation is asked of a thing: `l.passes(through: p)`, `l.parallel(to: m)`"
                .to_string(),
        };
        let said = (
            "expected-member",
            format!("found `{}` after a rule, wanted its end", p.word(0)),
            hint,
        );
        p.report_mistake((at, at), said, None);
    }
    is_one
}

/// `for i in 1 to 5`, `0...5`. Returns true where it was reported.
pub(super) fn range_in_words(p: &mut Parser<'_>) -> bool {
    let is_sign = p.at(Ellipsis) || p.at(Ident) && matches!(p.word(0), "to" | "until");
    let is_one = is_sign && p.behind(1) == Number && p.nth(1) == Number;
    if is_one {
        let at = p.pos();
        let (from, to) = (p.text_between(at - 1, at - 1), p.word(1));
        let said = (
            "expected-range",
            format!("found `{}`, wanted a range", p.word(0)),
            format!("write `{from}..{to}`"),
        );
        let span = p.span_at(at - 1).join(p.span_at(at + 1));
        p.report_mistake((at, at + 1), said, Some((span, format!("{from}..{to}"))));
    }
    is_one
}

/// `for i in 0..2 for j in 0..2 { … }`: a loop whose members stand in no braces. Returns true where it was reported.
pub(super) fn loop_without_braces(p: &mut Parser<'_>, first: usize) -> bool {
    let is_one = p.at(Ident) && is_keyword(p.word(0)) && !p.names_itself(1);
    if is_one {
        let at = p.pos();
        let (head, word) = (p.text_between(first, at - 1), p.word(0));
        let said = (
            "expected-body",
            format!("found `{word}`, wanted a body in `{{ }}`"),
            format!("what a loop repeats stands in braces: `{head} {{ {word} … }}`"),
        );
        p.report_mistake((at, at), said, None);
    }
    is_one
}

/// `constant R = 8.31`: a constant without its class.
pub(super) fn constant_without_class(p: &mut Parser<'_>) {
    if !p.at(Eq) || p.begins_line(0) {
        return;
    }
    let (at, name) = (p.pos(), p.text_between(p.pos() - 1, p.pos() - 1));
    let value = if p.begins_line(1) { String::new() } else { p.quoted_line(at + 1) };
    let unit = (p.nth(1) == Number && p.nth(2) == Unit).then(|| p.word(2));
    let dimension = unit.and_then(expr::units::unit).map(|unit| unit.dimension);
    let class = match (p.nth(1), dimension) {
        (Text, _) => "Text",
        (_, Some(dimension)) => dimension.named().unwrap_or("Real"),
        (_, None) => "Real",
    };
    let said = (
        "expected-class",
        "found `=`, wanted `:` and the constant's class".to_string(),
        format!("write `constant {name}: {class} = {value}`"),
    );
    p.report_mistake((at, at), said, Some((p.span_at(at - 1), format!("{name}: {class}"))));
}

/// `x = 3 within 1e-9 and y = 4`: returns true where `and` or `or` stands behind a tolerance.
pub(super) fn joined_after_tolerance(p: &mut Parser<'_>) -> bool {
    let is_one = !p.begins_line(0) && (p.at(AndKw) || p.at(OrKw));
    if is_one {
        let (at, word) = (p.pos(), p.word(0));
        let said = (
            "joined-after-tolerance",
            format!("found `{word}` behind a tolerance, which ends what it belongs to"),
            "each that has a tolerance is said by itself: `expect x = 3 within 1e-9  expect y = 4`"
                .to_string(),
        );
        p.report_mistake((at, at), said, None);
    }
    is_one
}

/// `anchor x: Real = 3`, which is read as the part that it declares.
pub(super) fn anchored_part(p: &mut Parser<'_>) {
    let at = p.pos();
    let (word, name, rest) = (p.word(0), p.word(1), p.quoted_line(at + 1));
    let said = (
        "expected-member",
        format!("found a part that is declared after `{word}`, wanted its name alone"),
        format!("declare it by itself: `{rest}`, and then `{word} {name}`"),
    );
    p.report_mistake((at, at), said, None);
}

/// `x: Real := 3`: returns true where it was reported.
pub(super) fn value_by_assignment(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(ColonEq) && !p.begins_line(0);
    if is_one {
        let at = p.pos();
        let said = (
            "assignment-outside-method",
            "found `:=` after a class, wanted `=`".to_string(),
            "a value is given with `=`; `:=` stands in the methods of a constraint".to_string(),
        );
        p.report_mistake((at, at), said, Some((p.span_at(at), "=".into())));
    }
    is_one
}

/// `sqrt 4`: a function without brackets. Returns true where one was reported.
pub(super) fn bare_call(p: &mut Parser<'_>) -> bool {
    let is_one = p.nth(1) == Number && !p.line_ended(1) && !p.begins_line(1);
    if is_one {
        let at = p.pos();
        let unit = if p.nth(2) == Unit { format!(" {}", p.word(2)) } else { String::new() };
        let call = format!("{}({}{unit})", p.word(0), p.word(1));
        let before = p.text_between(at.saturating_sub(1), at.saturating_sub(1));
        if matches!(before, "set" | "move") {
            let (name, value) = (p.word(0), p.word(1));
            let said = (
                "expected-word",
                format!("found `{value}`, wanted `to`"),
                format!("write `{before} {name} to {value}{unit}`"),
            );
            p.report_mistake((at + 1, at + 1), said, None);
            return true;
        }
        if p.word(0) == "return" {
            let said = (
                "bare-call",
                "found `return` before what is answered".to_string(),
                "what stands behind `=>` is the answer: leave `return` out".to_string(),
            );
            p.report_mistake((at, at), said, None);
            return true;
        }
        let said = (
            "bare-call",
            format!("found `{}` right after a name, wanted an operator", p.word(1)),
            format!("what a function is of stands in brackets: `{call}`"),
        );
        let last = at + 1 + usize::from(!unit.is_empty());
        p.report_mistake((at, last), said, Some((p.span_at(at).join(p.span_at(last)), call)));
    }
    is_one
}

/// `(x: 1, y: 2)`: labels in brackets that no class stands before. The first of them is reported, all are passed over.
/// Returns true where one was passed over.
pub(super) fn labels_without_class(p: &mut Parser<'_>, is_said: bool) -> bool {
    if !(p.at(Ident) && p.nth(1) == Colon) {
        return false;
    }
    let (at, label) = (p.pos(), p.word(0).to_string());
    let said = (
        "label-without-class",
        format!("found the label `{label}:` in brackets without a class"),
        format!("name the class: `Name({label}: …)`, or leave the labels out"),
    );
    if !is_said {
        p.report_mistake((at, at + 1), said, None);
    }
    p.bump();
    p.bump();
    true
}

/// Returns the hint for a value that stands where a class is wanted, `x: 3`.
pub(super) fn value_for_class(p: &Parser<'_>) -> Option<String> {
    let name = p.pos().checked_sub(2).map(|i| p.text_between(i, i)).unwrap_or_default();
    let value = p.word(0);
    match p.current() {
        // `holes: 6 Circle`, `holes: 6 of Circle`
        Number if p.nth(1) == Ident && !p.line_ended(1) => {
            let class = if p.word(1) == "of" { p.word(2) } else { p.word(1) };
            Some(format!("a list is written `{name}: List of {value} {class}`"))
        }
        Number if p.nth(1) == Unit => {
            let (value, unit) = (format!("{value} {}", p.word(1)), expr::units::unit(p.word(1)));
            let class = unit.and_then(|unit| unit.dimension.named()).unwrap_or("Real");
            Some(format!(
                "write `{name} = {value}` for a value, `{name}: {class} = {value}` for a new part"
            ))
        }
        Number => Some(format!(
            "write `{name} = {value}` for a value, `{name}: Real = {value}` for a new part"
        )),
        Text => Some(format!(
            "write `{name} = {value}` for a value, `{name}: Text = {value}` for a new part"
        )),
        Eq if !p.line_ended(1) => {
            let value = p.quoted_line(p.pos() + 1);
            Some(format!("what is computed is a message: `{name} => {value}`"))
        }
        LBracket if p.nth(1) == Ident && p.nth(2) == RBracket => {
            Some(format!("a list is written `{name}: List of {}`", p.word(1)))
        }
        LParen if (p.nth(1), p.nth(2), p.nth(3)) == (Ident, RParen, FatArrow) => Some(format!(
            "what is computed of something is a message: `{name}({}: Real) => {}`",
            p.word(1),
            p.quoted_line(p.pos() + 4)
        )),
        NotKw if p.behind(1) == Ident => {
            Some("unlike is `!=`, no thing of a class `not (x is C)`".into())
        }
        Colon => Some("one `:` is enough".into()),
        Minus if p.text_between(p.pos() - 1, p.pos() - 1) == "of" => {
            Some("how many a list has is a whole number, from 0: `List of 3 Real`".into())
        }
        LParen | LBracket | Minus => {
            Some(format!("a class follows `:`; a value is given with `=`: `{name} = …`"))
        }
        _ => None,
    }
}

/// Reports what joins two things in other languages, `a.p1 -> b.p1`.
pub(super) fn arrow(p: &mut Parser<'_>, first: usize) -> bool {
    let is_one = p.at(Arrow) && p.nth(1) == Ident;
    if is_one {
        let last = p.line_end();
        let left = p.text_between(first, p.pos() - 1);
        let right = p.text_between(p.pos() + 1, last);
        let said = (
            "expected-value",
            "found `->`, wanted `=` and a value".to_string(),
            format!("write `merge {left} = {right}` to make the two one"),
        );
        p.report_mistake((first, last), said, None);
    }
    is_one
}

/// `box { width = 3 }`
fn body_of_name(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(Ident) && p.nth(1) == LBrace && !p.begins_line(1);
    if is_one {
        let (at, of) = (p.pos(), p.word(0));
        let said = match of.starts_with(char::is_uppercase) {
            true => (
                "expected-member",
                format!("found a body after `{of}`, wanted a name before it"),
                format!("a thing has a name before its class: `name: {of} {{ … }}`"),
            ),
            false => (
                "expected-member",
                format!("found a body after `{of}`, wanted its class before it"),
                format!(
                    "declare it with its class, `{of}: Class {{ … }}`; what is declared gets its values one by one, `{of}.x = …`"
                ),
            ),
        };
        p.report_mistake((at, at), said, None);
    }
    is_one
}

/// `rows[0] { name = "pen" }`: a body for what is there already.
pub(super) fn body_of_path(p: &mut Parser<'_>, first: usize) -> bool {
    let is_one = p.at(LBrace) && !p.begins_line(0);
    if is_one {
        let at = p.pos();
        let of = p.text_between(first, at - 1);
        let hint = match p.nth(1) == Ident && p.nth(2) == Eq {
            true => {
                format!("give what is declared its values one by one: `{of}.{} = …`", p.word(1))
            }
            false => format!("a body stands where a part is declared: `{of}: Class {{ … }}`"),
        };
        let said = ("expected-value", "found `{`, wanted `=` and a value".to_string(), hint);
        p.report_mistake((at, at), said, None);
    }
    is_one
}

/// Returns true if the braces here hold a value, as those of an `if` in other languages do.
pub(super) fn holds_value(p: &Parser<'_>) -> bool {
    let is_value = matches!(p.nth(1), Number | Text | Minus | LParen);
    let has_unit = usize::from(p.nth(2) == Unit);
    is_value && p.nth(2 + has_unit) == RBrace || p.nth(1) == Ident && p.nth(2) == RBrace
}

/// `=>` for `>=`: returns true where it was reported.
pub(super) fn turned_comparison(p: &mut Parser<'_>) -> bool {
    let is_one = p.at(FatArrow);
    if is_one {
        let at = p.pos();
        let said = (
            "expected-comparison",
            "found `=>`, wanted a comparison".to_string(),
            "greater or equal is `>=`".to_string(),
        );
        p.report_mistake((at, at), said, Some((p.span_at(at), ">=".into())));
    }
    is_one
}
