//! Numbers that their writer may have meant otherwise: each is a warning, for what is written is allowed.
//!
//! In: expressions. Out: warnings of `1/4 turn`, which is 1 over 4 turns; of `x^1/2`, half of x; of `pi() * d * n`, where
//! n turns in radians; of degrees that are taken as radians, of hertz as radians in a second, of dates that are
//! differences, of roots that measure nothing, of powers that may measure anything, of percents of nothing, and of
//! chains of `!=`.

use crate::angles::{ANGLE, UNITS, bare_number};
use crate::kinds::Kind;
use crate::lower::{Lowerer, OWN};
use crate::scope::Scope;
use base::{Diagnostic, Place};
use expr::dimension::Dimension;
use kernel::Term;
use std::iter::successors;
use syntax::SyntaxNode;
use syntax::ast::{AstNode, BinaryExpr, BinaryOp, ChainExpr, Expr, NumberExpr, Part, Value};

/// The class of what turns.
const TURNING: &str = "AngularVelocity";

/// What is told of an expression: the warning's code, its message and its hint.
type Told = (&'static str, String, String);

impl Lowerer<'_> {
    /// Warns of a product or quotient that may be meant otherwise.
    pub(crate) fn warn_of_misreading(&mut self, scope: &Scope, binary: &BinaryExpr) {
        if scope.file != OWN || self.silent > 0 {
            return;
        }
        // a loop asks at each turn
        if !scope.turns.is_empty() && !self.read_in_turns.insert(binary.span()) {
            return;
        }
        let told = match binary.op() {
            Some(BinaryOp::Divide) => fraction(binary).or_else(|| root(binary)),
            Some(BinaryOp::Add | BinaryOp::Subtract) => {
                percent_of_itself(binary).or_else(|| date(binary))
            }
            Some(BinaryOp::Multiply) => None,
            _ => return,
        };
        if let Some((code, message, hint)) = told.or_else(|| self.turns_by_pi(scope, binary)) {
            let place = Place { file: scope.file, span: binary.span() };
            self.report(Diagnostic::warning(code, place, message).hint(hint));
        }
    }

    /// Warns of a whole number that is another one as a number of the computer.
    pub(crate) fn warn_of_lost_digits(&mut self, scope: &Scope, number: &NumberExpr, value: f64) {
        /// From here on not every whole number is one of the computer's: 2^53.
        const LARGE: f64 = 9_007_199_254_740_992.0;
        if value < LARGE || scope.file != OWN || self.silent > 0 {
            return;
        }
        let Some(digits) = number.digits() else { return };
        let written = digits.text().replace('_', "");
        // the nearest of the computer's is whole, and is written in full here
        let kept = format!("{value:.0}");
        if written.bytes().all(|b| b.is_ascii_digit()) && written.trim_start_matches('0') != kept {
            let place = Place { file: scope.file, span: number.span() };
            let message = format!("{written} is kept as {kept}: beyond 2^53 digits are lost");
            let d = Diagnostic::warning("lost-digits", place, message);
            self.report(d.hint("up to 9007199254740992 every whole number is exact"));
        }
    }

    /// Warns of a value that a part of some class may be meant to have otherwise.
    pub(crate) fn warn_of_value(&mut self, scope: &Scope, class: &str, value: &Expr) {
        if scope.file != OWN || self.silent > 0 {
            return;
        }
        let written = || value.syntax().text().to_string();
        let told = match value {
            Expr::Number(number) if class == TURNING => hertz(number).map(|(once, turns)| {
                let message = format!("{} is {once} rad/s here, not so many turns", written());
                ("turns-as-frequency", message, format!("what turns so often has `{turns} rpm`"))
            }),
            _ if class == ANGLE && is_in_degrees(value) => Some((
                "bare-angle",
                format!("{} is a number of degrees, and is taken as radians", written()),
                "an angle is shown in degrees by itself: leave `180 / pi()` out".to_string(),
            )),
            _ => None,
        };
        if let Some((code, message, hint)) = told {
            let place = Place { file: scope.file, span: value.span() };
            self.report(Diagnostic::warning(code, place, message).hint(hint));
        }
    }

    /// Warns of `a != b != c`, which compares neighbours alone.
    pub(crate) fn warn_of_unequals(&mut self, scope: &Scope, chain: &ChainExpr) {
        let operands: Vec<String> =
            chain.operands().map(|e| e.syntax().text().to_string()).collect();
        let ([first, _, .., last], OWN, 0) = (&operands[..], scope.file, self.silent) else {
            return;
        };
        if operands.len() < 3 {
            return;
        }
        let place = Place { file: scope.file, span: chain.span() };
        let message = format!("a chain compares neighbours alone: {first} and {last} may be equal");
        let all = operands.join(", ");
        let d = Diagnostic::warning("unequal-neighbours", place, message);
        self.report(d.hint(format!("that no two are equal is `allDifferent({all})`")));
    }

    /// Warns of a root or another power by a fraction that measures nothing, as that of a mass does: what it is given to
    /// cannot be checked. One that is a factor, or a sum in one, may meet another.
    pub(crate) fn warn_of_uneven_root(
        &mut self,
        scope: &Scope,
        operand: &Expr,
        (kind, exponent): (&Kind, f64),
    ) {
        let Kind::Number(Some(dimension)) = kind else { return };
        let is_whole =
            |e: &i8| (f64::from(*e) * exponent - (f64::from(*e) * exponent).round()).abs() < 1e-9;
        // lengths of a sheet are plain numbers to many a program
        let is_of_length =
            *dimension == Dimension::LENGTH.power(dimension.0[0]) && !self.document.writes_lengths;
        if dimension.0.iter().all(is_whole) || is_of_length || scope.file != OWN || self.silent > 0
        {
            return;
        }
        let mut around = operand.syntax().ancestors().skip(1).filter_map(Expr::cast);
        let is_root = |e: &Expr| matches!(e, Expr::Call(_) | Expr::Binary(_));
        let Some(root) = around.find(is_root) else { return };
        let is_sum = |e: &Expr| match e {
            Expr::Paren(_) => true,
            Expr::Binary(sum) => matches!(sum.op(), Some(BinaryOp::Add | BinaryOp::Subtract)),
            _ => false,
        };
        if let Some(Expr::Binary(around)) = around.find(|e| !is_sum(e))
            && (is_product(&around) || around.op() == Some(BinaryOp::Power))
        {
            return;
        }
        let place = Place { file: scope.file, span: root.span() };
        let measured = kind.words(&self.document);
        let message =
            format!("a root of {measured} measures nothing: its powers are no whole ones");
        let hint =
            format!("look whether each factor of `{}` has its unit", operand.syntax().text());
        self.report(Diagnostic::warning("uneven-root", place, message).hint(hint));
    }

    /// Warns of `a^n` where a measures something and n may become another number: so may what the power measures, and
    /// nothing tells that it does not go with what it is given to.
    pub(crate) fn warn_of_open_power(
        &mut self,
        scope: &Scope,
        power: &BinaryExpr,
        (kind, exponent): (&Kind, &Term),
    ) {
        let Kind::Number(Some(dimension)) = kind else { return };
        let is_known = matches!(exponent, Term::Number { .. }) || dimension.is_none();
        let (Some(base), Some(by)) = (power.left(), power.right()) else { return };
        // lengths of a sheet are plain numbers to many a program
        let is_of_length =
            *dimension == Dimension::LENGTH.power(dimension.0[0]) && !self.document.writes_lengths;
        if is_known || is_of_length || scope.file != OWN || self.silent > 0 {
            return;
        }
        let place = Place { file: scope.file, span: power.span() };
        let (written, base, by) = (power.syntax().text(), base.syntax().text(), by.syntax().text());
        let measured = kind.words(&self.document);
        let message = format!(
            "what {written} measures changes with {by}: {base} is {measured}, and the power is not checked"
        );
        let hint = format!(
            "divide by a unit first, as in `({base} / 1 m)^{by}`, or write the exponent as a number"
        );
        self.report(Diagnostic::warning("open-power", place, message).hint(hint));
    }

    /// `pi() * d * n`, where n is an angular velocity: told of the whole product.
    fn turns_by_pi(&mut self, scope: &Scope, product: &BinaryExpr) -> Option<Told> {
        let around = product.syntax().parent().and_then(BinaryExpr::cast);
        if !is_product(product) || around.is_some_and(|around| is_product(&around)) {
            return None;
        }
        let factors = factors(&Expr::Binary(product.clone()));
        if !factors.iter().any(is_pi) {
            return None;
        }
        let turning = factors.into_iter().find(|e| self.is_declared_as(scope, e, TURNING))?;
        let turning = turning.syntax().text().to_string();
        Some((
            "turns-by-pi",
            format!("{turning} is an angular velocity: each turn is 2π already"),
            format!(
                "a speed is `{turning} * radius`, a power `{turning} * torque`; how often something turns is a Frequency"
            ),
        ))
    }
}

/// `1/4 turn`, `1/2 %`: what it is, and what is written for a fraction of the unit.
fn fraction(quotient: &BinaryExpr) -> Option<Told> {
    let (Expr::Number(above), Expr::Number(below)) = (quotient.left()?, quotient.right()?) else {
        return None;
    };
    let unit = below.unit().filter(|unit| UNITS.contains(&unit.text()) || unit.text() == "%")?;
    let (above, below) = (above.digits().filter(|_| above.unit().is_none())?, below.digits()?);
    let (above, below, unit) = (above.text(), below.text(), unit.text());
    // what stands apart is a quotient
    let written = quotient.syntax().text().to_string();
    let is_tight = written.starts_with(&format!("{above}/{below}"));
    let hint =
        format!("a unit belongs to the number before it alone: write `{above} {unit} / {below}`");
    let message = format!("{written} is {above} divided by {below} {unit}");
    is_tight.then_some(("fraction", message, hint))
}

/// `price + 19%` of a price that is more than one: what it comes to, and what is written for so much of the price.
fn percent_of_itself(sum: &BinaryExpr) -> Option<Told> {
    let sign = match sum.op() {
        Some(BinaryOp::Add) => '+',
        Some(BinaryOp::Subtract) => '-',
        _ => return None,
    };
    let (left, Expr::Number(part)) = (sum.left()?, sum.right()?) else { return None };
    part.unit().filter(|unit| unit.text() == "%")?;
    // a quotient may be a share, as what has percents itself is
    let is_share = matches!(&left, Expr::Binary(b) if b.op() != Some(BinaryOp::Multiply));
    if is_share || !factors(&left).iter().any(is_more_than_one) {
        return None;
    }
    let (whole, part) = (left.syntax().text(), part.syntax().text());
    let message = format!("{part} is {part} of 1, not of {whole}", part = part.to_string().trim());
    let hint = match left {
        Expr::Binary(_) => format!("so much of it is `({whole}) * (1 {sign} {part})`"),
        _ => format!("so much of it is `{whole} * (1 {sign} {part})`"),
    };
    Some(("percent-of-what", message, hint))
}

/// Returns true for a number without a unit that is more than one, and for the name of what is declared with one not far
/// above or below.
fn is_more_than_one(e: &Expr) -> bool {
    /// So many members are looked at, either way: a long document has more.
    const NEAR: usize = 64;
    let Expr::Name(name) = e else { return bare_number(e).is_some_and(|x| x > 1.0) };
    let Some(word) = name.name() else { return false };
    let is_it = |part: &Part| part.names().any(|name| name.text() == word.text());
    let near = |node: SyntaxNode| {
        let before = successors(node.prev_sibling(), SyntaxNode::prev_sibling).take(NEAR);
        before.chain(successors(node.next_sibling(), SyntaxNode::next_sibling).take(NEAR))
    };
    let mut parts = name.syntax().ancestors().flat_map(near).filter_map(Part::cast);
    let value = parts.find(is_it).and_then(|part| part.value()).and_then(Value::expr);
    value.is_some_and(|value| bare_number(&value).is_some_and(|x| x > 1.0))
}

/// `2026-01-15`: a date that is a difference.
fn date(binary: &BinaryExpr) -> Option<Told> {
    let (Expr::Binary(_), Expr::Number(_)) = (binary.left()?, binary.right()?) else { return None };
    let written = binary.syntax().text().to_string();
    let is_one = binary.op() == Some(BinaryOp::Subtract)
        && written.matches('-').count() == 2
        && written.split('-').next().is_some_and(|year| year.len() == 4)
        && crate::hints::is_date(&written);
    let message = format!("{written} is a difference of three numbers here");
    let hint = format!(
        "a date is a text, `\"{written}\"`, or three numbers, of which days are counted; a difference has spaces"
    );
    is_one.then_some(("date", message, hint))
}

/// `x^1/2`: what it is, and what is written for the root.
fn root(quotient: &BinaryExpr) -> Option<Told> {
    let (Expr::Binary(power), Expr::Number(below)) = (quotient.left()?, quotient.right()?) else {
        return None;
    };
    let Expr::Number(one) = power.right()? else { return None };
    if power.op() != Some(BinaryOp::Power) || one.value() != Some(1.0) {
        return None;
    }
    let written = quotient.syntax().text().to_string();
    let is_tight = !written.contains(char::is_whitespace);
    let (of, below) = (power.left()?.syntax().text().to_string(), below.digits()?);
    let hint = format!("a root is a power in brackets: `{of}^(1/{})`", below.text());
    let message = format!("{written} is {of} divided by {}", below.text());
    is_tight.then_some(("fraction", message, hint))
}

fn is_product(binary: &BinaryExpr) -> bool {
    matches!(binary.op(), Some(BinaryOp::Multiply | BinaryOp::Divide))
}

/// How much a number of hertz is as it stands, and in turns a minute.
fn hertz(number: &NumberExpr) -> Option<(String, String)> {
    let unit = number.unit().filter(|unit| unit.text().ends_with("Hz"))?;
    let (once, _) = expr::units::read_quantity(number.digits()?.text(), unit.text())?;
    Some((base::number::shortest(once), base::number::shortest(once * 60.0)))
}

/// Returns what is multiplied in a product.
fn factors(e: &Expr) -> Vec<Expr> {
    let mut open = vec![e.clone()];
    let mut found = Vec::new();
    while let Some(e) = open.pop() {
        match &e {
            Expr::Paren(inner) => open.extend(inner.inner()),
            Expr::Binary(binary) if binary.op() == Some(BinaryOp::Multiply) => {
                open.extend(binary.right());
                open.extend(binary.left());
            }
            Expr::Binary(binary) if binary.op() == Some(BinaryOp::Divide) => {
                open.extend(binary.left());
            }
            _ => found.push(e),
        }
    }
    found
}

fn is_pi(e: &Expr) -> bool {
    match e {
        Expr::Call(call) => call.name().is_some_and(|word| word.text() == "pi"),
        Expr::Name(name) => name.name().is_some_and(|word| word.text() == "pi"),
        _ => false,
    }
}

/// Returns true for what is multiplied by 180 and divided by pi: radians made degrees.
fn is_in_degrees(value: &Expr) -> bool {
    let is_180 =
        |e: &Expr| matches!(e, Expr::Number(n) if n.unit().is_none() && n.value() == Some(180.0));
    let mut quotients = value.syntax().descendants().filter_map(BinaryExpr::cast).filter(|b| {
        b.op() == Some(BinaryOp::Divide)
            && b.right().is_some_and(|right| factors(&right).iter().any(is_pi))
    });
    quotients.any(|quotient| quotient.left().is_some_and(|left| factors(&left).iter().any(is_180)))
}
