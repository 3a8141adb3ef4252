//! Expressions, by binding power; each function returns the height of the tree that it made.

use super::mistakes;
use super::types::class_name;
use crate::kind::SyntaxKind::{
    self, AllExpr, AndKw, Arg, ArgList, BinaryExpr, Binding, BoolExpr, CallExpr, Caret, ChainExpr,
    Colon, ColonEq, Comma, CopyExpr, Dot, DotDot, ElseKw, Eof, Eq, EqEq, Error, FalseKw, FatArrow,
    FieldExpr, Greater, GreaterEq, Ident, IfExpr, IfKw, IndexExpr, IsExpr, LBrace, LBracket,
    LParen, LambdaExpr, Less, LessEq, LetExpr, LetKw, ListExpr, Minus, NameExpr, NotEq, NotKw,
    Number, NumberExpr, OrKw, OwnerExpr, OwnerKw, ParenExpr, Plus, RBrace, RBracket, RParen,
    RangeExpr, Semicolon, Slash, Star, SuperExpr, SuperKw, Text, TextClose, TextExpr, TextMiddle,
    TextOpen, ThenKw, TrueKw, TupleExpr, UnaryExpr, Unit,
};
use crate::parser::{MAX_HEIGHT, Parser};
use rowan::Checkpoint;

/// How tightly an operator holds its operands, loosest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Power {
    Or,
    And,
    Not,
    Compare,
    Range,
    Add,
    Multiply,
    Sign,
    Raise,
}

impl Power {
    /// The next tighter one.
    fn tighter(self) -> Self {
        match self {
            Power::Or => Power::And,
            Power::And => Power::Not,
            Power::Not => Power::Compare,
            Power::Compare => Power::Range,
            Power::Range => Power::Add,
            Power::Add => Power::Multiply,
            Power::Multiply => Power::Sign,
            Power::Sign | Power::Raise => Power::Raise,
        }
    }
}

/// Any expression.
pub(super) fn expression(p: &mut Parser<'_>) {
    operators(p, Power::Or);
}

/// An expression whose outermost operator joins no truths: a tolerance.
pub(super) fn comparison(p: &mut Parser<'_>) {
    operators(p, Power::Compare);
}

/// The values of a domain: an expression whose outermost operator may not compare, or a range that is open at an end.
pub(super) fn domain(p: &mut Parser<'_>) {
    let start = p.checkpoint();
    match p.current() {
        Less | LessEq | Greater | GreaterEq => p.bump(),
        DotDot => {
            p.bump();
            p.eat(Less);
        }
        _ => {
            operators(p, Power::Add);
            if !p.at(DotDot) {
                return;
            }
            p.bump();
            p.eat(Less);
            if p.at(Eq) && p.is_adjacent(0) {
                mistakes::calls::range_with_equals(p);
            }
            if matches!(p.current(), Eq | Comma | RParen | Semicolon | RBrace | LBrace | Eof)
                || p.line_ended(0)
            {
                p.start_at(start, RangeExpr);
                p.finish();
                return;
            }
        }
    }
    binary(p, start, Power::Add, RangeExpr);
}

/// A sum of products, the count of a list.
pub(super) fn sum(p: &mut Parser<'_>) {
    operators(p, Power::Add);
}

/// A path: names, fields, indices.
pub(super) fn path(p: &mut Parser<'_>) {
    if p.line_ended(0) && p.names_itself(1) && p.nth(1) == Colon {
        p.expected("expected-path", "a path");
        return;
    }
    if matches!(p.current(), Ident | OwnerKw | SuperKw) {
        let start = p.checkpoint();
        operand(p, start);
    } else {
        p.expected("expected-path", "a path");
    }
}

/// The count of a list: a number, a name or something in brackets.
pub(super) fn count(p: &mut Parser<'_>) {
    if p.at(Ident) {
        name(p, NameExpr);
    } else {
        let start = p.checkpoint();
        primary(p, start);
    }
}

fn operators(p: &mut Parser<'_>, least: Power) -> u32 {
    p.nested(|p| {
        let start = p.checkpoint();
        let mut height = prefixed(p, start);
        while let Some(power) = operator(p).filter(|power| *power >= least) {
            if height >= MAX_HEIGHT {
                p.too_deep();
                break;
            }
            height = height.max(infix(p, start, power)) + 1;
        }
        height
    })
    .unwrap_or(0)
}

/// What an expression begins with: an operand, or an operator before one.
fn prefixed(p: &mut Parser<'_>, start: Checkpoint) -> u32 {
    let power = match p.current() {
        NotKw => Power::Compare,
        Minus | Plus => Power::Sign,
        _ => return operand(p, start),
    };
    p.bump();
    let height = operators(p, power) + 1;
    p.start_at(start, UnaryExpr);
    p.finish();
    height
}

/// The power of the infix operator here, if one stands here.
fn operator(p: &Parser<'_>) -> Option<Power> {
    Some(match p.current() {
        OrKw => Power::Or,
        AndKw => Power::And,
        Eq | EqEq | NotEq | Less | LessEq | Greater | GreaterEq => Power::Compare,
        DotDot => Power::Range,
        Plus | Minus => Power::Add,
        Star | Slash => Power::Multiply,
        Caret => Power::Raise,
        Ident if p.unclosed > 0 && p.line_ended(0) => return None,
        Ident if p.names_itself(1) => return None,
        Ident => match p.word(0) {
            "in" if !p.in_bindings => Power::Compare,
            "is" | "subset" => Power::Compare,
            "union" => Power::Add,
            "mod" => Power::Multiply,
            _ => return None,
        },
        _ => return None,
    })
}

/// Takes an operator and its right side; the left one begins at `start`.
fn infix(p: &mut Parser<'_>, start: Checkpoint, power: Power) -> u32 {
    match power {
        Power::Compare if p.at(Ident) && p.word(0) == "is" => {
            p.bump_keyword();
            class_name(p);
            p.start_at(start, IsExpr);
            p.finish();
            1
        }
        Power::Compare => comparisons(p, start),
        Power::Or | Power::And | Power::Not | Power::Add | Power::Multiply | Power::Sign => {
            let twice = p.at(Star) && p.nth(1) == Star && p.is_adjacent(1);
            let is_plus = p.at(Plus);
            bump_operator(p);
            if is_plus {
                mistakes::elsewhere::tolerance_sign(p);
                mistakes::elsewhere::two_bounds(p);
            }
            if twice {
                let at = p.pos();
                let said =
                    ("power", "found `**`, wanted `^`".to_string(), "a power is `x^2`".to_string());
                let span = p.span_at(at - 1).join(p.span_at(at));
                p.report_mistake((at - 1, at), said, Some((span, "^".into())));
                p.bump();
            }
            binary(p, start, power.tighter(), BinaryExpr)
        }
        Power::Raise => {
            p.bump();
            binary(p, start, Power::Raise, BinaryExpr)
        }
        Power::Range => {
            p.bump();
            p.eat(Less);
            if p.at(Eq) {
                mistakes::calls::range_with_equals(p);
            }
            binary(p, start, Power::Add, RangeExpr)
        }
    }
}

fn binary(p: &mut Parser<'_>, start: Checkpoint, right: Power, kind: SyntaxKind) -> u32 {
    let height = operators(p, right);
    p.start_at(start, kind);
    p.finish();
    height
}

/// `< b <= c`: one comparison is binary, several make a chain.
fn comparisons(p: &mut Parser<'_>, start: Checkpoint) -> u32 {
    let (mut height, mut count) = (0, 0);
    while operator(p) == Some(Power::Compare) && !(p.at(Ident) && p.word(0) == "is") {
        let turned = p.is_adjacent(1).then(|| mistakes::elsewhere::turned(p)).flatten();
        bump_operator(p);
        if let Some((found, wanted, hint)) = turned {
            let at = p.pos();
            let said = ("unlike", format!("found `{found}`, wanted `{wanted}`"), hint.to_string());
            let span = p.span_at(at - 1).join(p.span_at(at));
            p.report_mistake((at - 1, at), said, Some((span, wanted.into())));
            p.bump();
        }
        height = height.max(operators(p, Power::Range));
        count += 1;
    }
    p.start_at(start, if count == 1 { BinaryExpr } else { ChainExpr });
    p.finish();
    height
}

fn bump_operator(p: &mut Parser<'_>) {
    match p.current() {
        Ident => p.bump_keyword(),
        EqEq => {
            let hint = Some("write `=`: there is no assignment to tell it from".into());
            let is_third = p.nth(1) == Eq && p.is_adjacent(1);
            let found = if is_third { "===" } else { "==" };
            p.report("double-equals", format!("found `{found}`, wanted `=`"), hint);
            p.bump();
            if is_third {
                p.start(Error);
                p.bump();
                p.finish();
            }
        }
        _ => p.bump(),
    }
}

/// An operand with its fields and indices.
fn operand(p: &mut Parser<'_>, start: Checkpoint) -> u32 {
    let mut height = primary(p, start);
    loop {
        if height >= MAX_HEIGHT {
            p.too_deep();
            return height;
        }
        match p.current() {
            Dot if mistakes::numbers::dotted_digits(p) => {
                p.bump();
                p.bump();
                p.start_at(start, FieldExpr);
                p.finish();
            }
            Dot => {
                p.bump();
                if p.at(OwnerKw) {
                    p.bump_as(Ident);
                } else if p.at(Eof) || p.line_ended(0) && (!p.at(Ident) || p.names_itself(1)) {
                    let hint = "a line has no point at its end".to_string();
                    p.expected_hint("expected-name", "a name after `.`", Some(hint));
                } else {
                    p.expect(Ident, "expected-name", "a name after `.`");
                }
                if p.at(LParen) && !p.line_ended(0) {
                    height = height.max(arguments(p));
                } else if mistakes::elsewhere::braces_for_arguments(p) {
                    p.start(ArgList);
                    p.bump();
                    height = height.max(argument(p));
                    p.expect(RBrace, "expected-bracket", "`}`");
                    p.finish();
                }
                p.start_at(start, FieldExpr);
                p.finish();
            }
            LBracket if !p.line_ended(0) => {
                in_brackets(p, |p| {
                    p.bump();
                    height = height.max(operators(p, Power::Or));
                    if p.at(Comma) && p.behind(1) == Number && p.nth(1) == Number {
                        let (row, column) = (p.text_between(p.pos() - 1, p.pos() - 1), p.word(1));
                        let hint = format!("a list of lists is asked twice: `[{row}][{column}]`");
                        p.expected_hint("expected-bracket", "`]`", Some(hint));
                    } else if p.at(Colon) {
                        let hint = "some elements of a list are `(0..1).map(i => xs[i])`".into();
                        p.expected_hint("expected-bracket", "`]`", Some(hint));
                    } else {
                        p.expect(RBracket, "expected-bracket", "`]`");
                    }
                });
                p.start_at(start, IndexExpr);
                p.finish();
            }
            Ident if mistakes::numbers::unit_after_name(p) => {
                p.bump();
                p.start_at(start, BinaryExpr);
                p.finish();
            }
            _ => return height,
        }
        height += 1;
    }
}

fn primary(p: &mut Parser<'_>, start: Checkpoint) -> u32 {
    match p.current() {
        _ if begins_next_member(p) => {
            let hint = mistakes::calls::no_operand(p);
            p.expected_hint("expected-expression", "an expression", hint);
        }
        Number => {
            p.start(NumberExpr);
            p.bump();
            p.eat(Unit);
            p.finish();
            if let Some(length) = mistakes::numbers::strange_number(p) {
                p.start_at(start, BinaryExpr);
                (0..length).for_each(|_| p.bump());
                p.eat(Unit);
                p.finish();
                return 2;
            }
            if mistakes::numbers::implied_product(p) {
                let height = operators(p, Power::Sign);
                p.start_at(start, BinaryExpr);
                p.finish();
                return height + 1;
            }
        }
        Text => name(p, TextExpr),
        TextOpen => return text_with_values(p),
        TrueKw | FalseKw => name(p, BoolExpr),
        SuperKw => name(p, SuperExpr),
        OwnerKw => name(p, OwnerExpr),
        IfKw => return conditional(p, start),
        LetKw => return bindings(p),
        LParen => return parenthesized(p),
        LBracket => {
            p.start(ListExpr);
            let height =
                bracketed(p, RBracket, "`]` at the list's end", |p| operators(p, Power::Or));
            p.finish();
            return height;
        }
        Dot if mistakes::numbers::leading_dot(p) => {
            p.start(BinaryExpr);
            p.bump();
            p.bump();
            p.eat(Unit);
            p.finish();
        }
        Ident if mistakes::numbers::unit_before_number(p) || mistakes::bare_call(p) => {
            p.start(BinaryExpr);
            p.bump();
            p.bump();
            p.eat(Unit);
            p.finish();
        }
        Ident => return named(p),
        _ => {
            let hint = mistakes::calls::no_operand(p);
            let is_in = p.pos() > 0 && p.text_between(p.pos() - 1, p.pos() - 1) == "in";
            let is_braced = hint.is_some() && p.at(LBrace) && (p.behind(1) == Eq || is_in);
            p.expected_hint("expected-expression", "an expression", hint);
            if is_braced {
                p.skip_brackets();
            }
        }
    }
    1
}

/// `"R = {r} ohm"`
fn text_with_values(p: &mut Parser<'_>) -> u32 {
    p.start(TextExpr);
    p.bump();
    let outside = std::mem::replace(&mut p.in_bindings, false);
    let mut height = 0;
    loop {
        height = height.max(operators(p, Power::Or));
        if p.eat(TextClose) {
            break;
        }
        if !p.eat(TextMiddle) {
            let is_format = p.at(Colon) || p.at(Comma);
            let unit = (p.at(Ident) && p.at_word(0, "to")).then(|| p.word(1));
            let hint = match unit {
                _ if is_format => Some("digits are asked for: `{x.text(digits: 3)}`".to_string()),
                Some(unit) if p.behind(1) == Ident => Some(format!(
                    "another unit is asked for by a message, `said => {}.shown(unit: \"{unit}\")`, and `{{said}}`",
                    p.text_between(p.pos() - 1, p.pos() - 1)
                )),
                _ => None,
            };
            p.expected_hint("expected-brace", "`}` after the value", hint);
            break;
        }
    }
    p.in_bindings = outside;
    p.finish();
    height + 1
}

/// Returns true if the line is over and what begins the next one cannot belong to an expression.
fn begins_next_member(p: &Parser<'_>) -> bool {
    if !p.line_ended(0) || !p.at(Ident) {
        return false;
    }
    p.unclosed > 0
        || matches!(p.nth(1), Colon | ColonEq | FatArrow)
        || super::members::is_keyword(p.word(0))
            && matches!(p.nth(1), Ident | LBrace | Text)
            && !p.begins_line(1)
}

/// What begins with a name: `all C`, `copy of x`, `f(…)`, `x`.
fn named(p: &mut Parser<'_>) -> u32 {
    match p.word(0) {
        // `set all to 3`: a part of this name
        "all" if p.nth(1) == Ident && !p.line_ended(1) && !p.at_word(1, "to") => {
            p.start(AllExpr);
            p.bump_keyword();
            class_name(p);
            p.finish();
            1
        }
        "new" if p.nth(1) == Ident && !p.line_ended(1) => {
            let at = p.pos();
            let said = (
                "unknown-name",
                "found `new`, wanted a value".to_string(),
                format!("a thing is made by its class's name alone: `{}(…)`", p.word(1)),
            );
            let (new, class) = (p.span_at(at), p.span_at(at + 1));
            let fix = (base::Span::new(new.start, class.start), String::new());
            p.report_mistake((at, at), said, Some(fix));
            p.bump_keyword();
            named(p)
        }
        "copy" if p.at_word(1, "of") || mistakes::elsewhere::copy_without_of(p) => {
            p.start(CopyExpr);
            p.bump_keyword();
            if p.at_word(0, "of") {
                p.bump_keyword();
            }
            let height = p.nested(|p| {
                let start = p.checkpoint();
                operand(p, start)
            });
            p.finish();
            height.unwrap_or(0) + 1
        }
        _ if p.nth(1) == LParen && !p.line_ended(1) => {
            p.start(CallExpr);
            p.bump();
            let height = arguments(p);
            p.finish();
            height + 1
        }
        _ => {
            name(p, NameExpr);
            1
        }
    }
}

/// A node of one token.
fn name(p: &mut Parser<'_>, kind: SyntaxKind) {
    p.start(kind);
    p.bump();
    p.finish();
}

/// `(a)`, `(a, b)`
fn parenthesized(p: &mut Parser<'_>) -> u32 {
    let start = p.checkpoint();
    let (mut count, mut is_labelled) = (0, false);
    let height = bracketed(p, RParen, "`)`", |p| {
        count += 1;
        is_labelled |= mistakes::labels_without_class(p, is_labelled);
        operators(p, Power::Or)
    });
    p.start_at(start, if count == 1 { ParenExpr } else { TupleExpr });
    p.finish();
    height
}

/// `(a, to: b)`
fn arguments(p: &mut Parser<'_>) -> u32 {
    p.start(ArgList);
    let height = bracketed(p, RParen, "`)` after the arguments", argument);
    p.finish();
    height
}

fn argument(p: &mut Parser<'_>) -> u32 {
    p.start(Arg);
    if p.at(Ident) && p.nth(1) == Colon {
        p.bump();
        p.bump();
    }
    let one = p.at(Ident) && p.nth(1) == FatArrow;
    let height = if one || p.at(LParen) && p.after_bracket(0) == FatArrow {
        lambda(p)
    } else {
        operators(p, Power::Or)
    };
    p.finish();
    height + 1
}

/// `x => e`, `(x, y) => e`
fn lambda(p: &mut Parser<'_>) -> u32 {
    p.start(LambdaExpr);
    if p.eat(LParen) {
        while p.eat(Ident) && p.eat(Comma) {}
        p.expect(RParen, "expected-bracket", "`)` after the parameters");
    } else {
        p.bump();
    }
    p.expect(FatArrow, "expected-expression", "`=>`");
    let height = operators(p, Power::Or);
    p.finish();
    height + 1
}

/// Takes an opening bracket, elements with commas between, and the closing bracket.
///
/// Returns the height of the tallest expression that can stand in it.
pub(super) fn bracketed(
    p: &mut Parser<'_>,
    closer: SyntaxKind,
    wanted: &str,
    mut element: impl FnMut(&mut Parser<'_>) -> u32,
) -> u32 {
    let mut height = 0;
    let end = p.pos() + p.bracket_length();
    in_brackets(p, |p| {
        let is_closed = p.is_closed();
        p.bump();
        while !p.at(closer) && !p.at(Eof) && !p.at(RBrace) && !begins_next_member(p) {
            let before = p.pos();
            height = height.max(element(p));
            if p.at(Semicolon) && p.brackets > 0 {
                let hint = Some("elements stand between commas: `[1, 2]`".to_string());
                p.expected_hint("expected-comma", "`,`", hint);
                p.bump();
                continue;
            }
            // where a list lacks one, its elements may be of two kinds; what took nothing here would take nothing again
            let may_lack = closer == RParen && p.pos() > before;
            if may_lack && mistakes::elsewhere::without_comma(p) {
                continue;
            }
            if !p.eat(Comma) || p.pos() == before {
                break;
            }
        }
        if !mistakes::elsewhere::in_brackets(p, wanted) {
            p.expect(closer, "expected-bracket", wanted);
            return;
        }
        if p.at(LParen) {
            return;
        }
        let is_over = |p: &Parser<'_>| match is_closed {
            true => p.pos() >= end,
            false => p.at(closer) || p.at(Eof) || p.at(RBrace) || p.line_ended(0),
        };
        p.start(Error);
        while !is_over(p) {
            p.bump();
        }
        p.finish();
        p.eat(closer);
    });
    height + 1
}

/// Runs `f` in the bracket that opens here: its line ends end nothing, if it is closed.
fn in_brackets(p: &mut Parser<'_>, f: impl FnOnce(&mut Parser<'_>)) {
    let outside = (p.brackets, p.unclosed, p.in_bindings);
    if p.is_closed() {
        p.brackets += 1;
    } else {
        p.unclosed += 1;
    }
    p.in_bindings = false;
    f(p);
    (p.brackets, p.unclosed, p.in_bindings) = outside;
}

/// `if c then a else b`; a `{` where `then` should stand is left to the caller's member.
fn conditional(p: &mut Parser<'_>, start: Checkpoint) -> u32 {
    p.bump();
    let condition = operators(p, Power::Or);
    condition.max(conditional_rest(p, start)) + 1
}

/// `then a else b` of the `if` that begins at `start`.
pub(super) fn conditional_rest(p: &mut Parser<'_>, start: Checkpoint) -> u32 {
    let mut height = 0;
    // `if(c, a, b)`, as in a spreadsheet
    let is_call = p.text_between(p.pos().saturating_sub(1), p.pos().saturating_sub(1)) == ")";
    if p.at(ThenKw) {
        p.bump();
        height = operators(p, Power::Or);
    } else {
        let hint = (is_call || p.at(Colon))
            .then(|| "a value is chosen by `if c then a else b`".to_string());
        p.expected_hint("expected-then", "`then`", hint);
    }
    if p.at(ElseKw) {
        p.bump();
        height = height.max(operators(p, Power::Or));
    } else {
        let hint = match p.member_word() {
            "constraint" => "a rule under a condition is `constraint if c { a = b }`",
            _ => "an expression has a value either way",
        };
        p.expected_hint("expected-else", "`else`", Some(hint.into()));
    }
    p.start_at(start, IfExpr);
    p.finish();
    height
}

/// `let a = e, b = f in g`
fn bindings(p: &mut Parser<'_>) -> u32 {
    p.start(LetExpr);
    p.bump();
    let outside = std::mem::replace(&mut p.in_bindings, true);
    let mut height = 0;
    loop {
        p.start(Binding);
        p.expect(Ident, "expected-name", "a name to bind");
        if p.expect(Eq, "expected-value", "`=` and a value") {
            height = height.max(operators(p, Power::Or));
        }
        p.finish();
        if !p.eat(Comma) {
            break;
        }
    }
    p.in_bindings = outside;
    if p.eat_word("in") {
        height = height.max(operators(p, Power::Or));
    } else {
        p.expected("expected-in", "`in` after the bindings");
    }
    p.finish();
    height + 1
}
