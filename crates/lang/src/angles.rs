//! Angles among plain numbers: what is computed of angles is one, and is shown in degrees.
//!
//! In: what a message without a class answers. Out: whether it is an angle. `30 deg`, `atan2(y, x)`, what is declared
//! as an `Angle`, their sums and differences, and what is so many times as large. A factor that speaks of `pi`
//! turns radians into something else: `a * 180 / pi` is a plain number.

use crate::kinds::Kind;
use crate::lower::{Lowerer, OWN};
use crate::scope::Scope;
use base::{Diagnostic, Place};
use kernel::{ClassId, ClassKind};
use syntax::ast::{AstNode, BinaryOp, CallExpr, Expr, Part, Type, TypeShape, UnaryOp, Value};

/// A whole turn, in radians.
const TURN: f64 = std::f64::consts::TAU;

/// The units of angles by which a number is told from other plain numbers.
pub(crate) const UNITS: [&str; 8] = ["deg", "°", "rad", "turn", "rev", "grad", "arcmin", "arcsec"];
/// The functions that answer angles.
const ANSWERING: [&str; 4] = ["atan2", "atan", "asin", "acos"];
/// The functions of numbers that answer what these are.
const KEEPING: [&str; 4] = ["abs", "min", "max", "clamp"];
/// Expressions are looked into so deep.
const DEEPEST: usize = 64;

/// The class of angles.
pub(crate) const ANGLE: &str = "Angle";

impl Lowerer<'_> {
    /// Warns of `sin(30)` and `sin(-30)`: more than a whole turn without a unit, where degrees were perhaps meant.
    pub(crate) fn warn_of_degrees(&mut self, scope: &Scope, call: &CallExpr) {
        let Some(word) = call.name().filter(|w| matches!(w.text(), "sin" | "cos" | "tan")) else {
            return;
        };
        let Some(written) = call.args().and_then(|args| args.args().next()?.value()) else {
            return;
        };
        self.warn_of_bare_angle(scope, &written, |degrees| format!("`{}({degrees})`", word.text()));
    }

    /// Warns of an angle of more than a whole turn that is written without a unit; `shown` is how it stands there.
    pub(crate) fn warn_of_bare_angle(
        &mut self,
        scope: &Scope,
        written: &Expr,
        shown: impl Fn(&str) -> String,
    ) {
        if bare_number(written).is_none_or(|x| x <= TURN) || scope.file != OWN || self.silent > 0 {
            return;
        }
        let place = Place { file: scope.file, span: written.span() };
        // `45°30'`, which is told as what it is
        if self.goes_on(place, "°") {
            return;
        }
        let number = written.syntax().text().to_string();
        let message = format!("{number} is an angle in radians here");
        let degrees = format!("{number} deg");
        let d = Diagnostic::warning("bare-angle", place, message);
        let hint =
            format!("degrees have their unit: {}; so may radians, `{number} rad`", shown(&degrees));
        self.report(d.hint(hint).fix(format!("write {degrees}"), [(place, degrees)]));
    }

    /// Warns of what is given to something of a class, where that is an angle, or a list of angles, and more than a whole
    /// turn is given without a unit.
    pub(crate) fn warn_of_bare_degrees(
        &mut self,
        scope: &Scope,
        class: ClassId,
        value: &Expr,
        shown: &dyn Fn(&str) -> String,
    ) {
        if self.document.classes[class].name.as_str() == ANGLE {
            return self.warn_of_bare_angle(scope, value, shown);
        }
        if let (ClassKind::List(of), Expr::List(list)) = (&self.document.classes[class].kind, value)
        {
            let of = *of;
            for element in list.elements() {
                self.warn_of_bare_degrees(scope, of, &element, &|degrees| format!("`{degrees}`"));
            }
        }
    }

    /// Warns of `a = 90` and `0 <= a <= 90`: an angle that is compared with more than a whole turn without a unit.
    pub(crate) fn warn_of_bare_angles(&mut self, scope: &Scope, compared: &[Expr]) {
        let is_over = |e: &&Expr| bare_number(e).is_some_and(|x| x > TURN);
        let (numbers, others): (Vec<&Expr>, Vec<&Expr>) = compared.iter().partition(is_over);
        let is_told = self.silent == 0 && !numbers.is_empty();
        if is_told && others.iter().any(|other| self.is_angle(scope, other)) {
            for number in numbers {
                self.warn_of_bare_angle(scope, number, |degrees| format!("`{degrees}`"));
            }
        }
    }

    /// Warns of `f: Frequency = 80 rpm` and of `300 rad/s`: turns are counted as angles, and how often something comes
    /// was perhaps meant.
    pub(crate) fn warn_of_turns(&mut self, scope: &Scope, part: &Part, class: &Type) {
        let TypeShape::Named(words) = class.shape() else { return };
        let is_frequency = words.last().is_some_and(|word| word.text() == "Frequency");
        let Some(Expr::Number(number)) = part.value().and_then(Value::expr) else { return };
        let Some((digits, unit)) = number.digits().zip(number.unit()) else { return };
        if !is_frequency || !is_of_angles(unit.text()) || scope.file != OWN || self.silent > 0 {
            return;
        }
        let place = Place { file: scope.file, span: number.span() };
        let written = number.syntax().text().to_string();
        let measured = "how fast something turns is an `AngularVelocity`";
        if unit.text() != "rpm" {
            let message = format!("{written} is an angular velocity: a turn of it is 2π, not one");
            let d = Diagnostic::warning("turns-as-frequency", place, message);
            return self
                .report(d.hint(format!("{measured}; how often it comes is `w / (2 * pi)`")));
        }
        let often = format!("{} 1/min", digits.text());
        let message = format!("{written} is an angular velocity: so many turns of 2π in a minute");
        let d = Diagnostic::warning("turns-as-frequency", place, message);
        let hint = format!("how often something comes is `{often}`; {measured}");
        self.report(d.hint(hint).fix(format!("write {often}"), [(place, often)]));
    }

    /// Returns true for an expression whose value is an angle.
    pub(crate) fn is_angle(&mut self, scope: &Scope, e: &Expr) -> bool {
        self.is_angle_within(scope, e, DEEPEST)
    }

    /// Says of a message without a class whose answer is an angle that it answers one.
    pub(crate) fn tell_angle(&mut self, scope: &Scope, index: usize, answer: &Expr) {
        let class = scope.class();
        let message = &self.document.classes[class].messages[index];
        let name = message.name.clone();
        if message.class.is_some()
            || !matches!(self.message_kind(class, &name), Kind::Number(None) | Kind::PLAIN)
            || !self.is_angle_within(scope, answer, DEEPEST)
        {
            return;
        }
        let angle = self.visible.of_language(ANGLE);
        self.document.classes[class].messages[index].class = angle;
    }

    /// Returns true for an expression whose value is an angle, as far as its form and the classes of its parts tell.
    fn is_angle_within(&mut self, scope: &Scope, e: &Expr, depth: usize) -> bool {
        let Some(depth) = depth.checked_sub(1) else { return false };
        let mut of = |e: Option<Expr>| e.is_some_and(|e| self.is_angle_within(scope, &e, depth));
        match e {
            Expr::Number(number) => number.unit().is_some_and(|unit| UNITS.contains(&unit.text())),
            Expr::Paren(inner) => of(inner.inner()),
            Expr::Unary(unary) => unary.op() != Some(UnaryOp::Not) && of(unary.operand()),
            Expr::If(choice) => of(choice.then_value()) || of(choice.else_value()),
            Expr::Let(bindings) => {
                // what it binds is not looked into, nor what is further out by its names
                let names = bindings.bindings().filter_map(|b| b.name());
                let inner = names.fold(scope.clone(), |s, w| s.with_local(w.name(), Kind::Unknown));
                bindings.body().is_some_and(|e| self.is_angle_within(&inner, &e, depth))
            }
            Expr::Binary(binary) => {
                let (left, right) = (of(binary.left()), of(binary.right()));
                let by = |e: Option<Expr>| e.is_some_and(|e| is_factor(&e));
                match binary.op() {
                    Some(BinaryOp::Add | BinaryOp::Subtract) => left || right,
                    Some(BinaryOp::Multiply) => {
                        left && !right && by(binary.right()) || right && !left && by(binary.left())
                    }
                    Some(BinaryOp::Divide) => left && !right && by(binary.right()),
                    Some(BinaryOp::Remainder) => left,
                    _ => false,
                }
            }
            Expr::Call(call) => {
                let Some(word) = call.name() else { return false };
                let args = || call.args().into_iter().flat_map(|args| args.args());
                let is_own = |l: &Self| l.find_message(scope.class(), &word.name(), None).is_none();
                match word.text() {
                    name if ANSWERING.contains(&name) => is_own(self),
                    name if KEEPING.contains(&name) => {
                        is_own(self)
                            && args().any(|arg| {
                                arg.value().is_some_and(|e| self.is_angle_within(scope, &e, depth))
                            })
                    }
                    _ => self.is_declared_as(scope, e, ANGLE),
                }
            }
            Expr::Name(name)
                if name.name().is_some_and(|w| self.is_step_of_angle(scope, &w.name())) =>
            {
                true
            }
            Expr::Name(_) | Expr::Field(_) | Expr::Index(_) => self.is_declared_as(scope, e, ANGLE),
            _ => false,
        }
    }

    /// Returns true for what is declared as a class of the language, or answers one.
    pub(crate) fn is_declared_as(&mut self, scope: &Scope, e: &Expr, class: &str) -> bool {
        let references = self.references.take();
        self.silent += 1;
        let found = self.expr(scope, e);
        self.silent -= 1;
        self.references = references;
        let found = found.and_then(|(term, _)| self.declared_class(scope, &term));
        found.is_some() && found == self.visible.of_language(class)
    }
}

/// Returns the size of a number that is written without a unit, with a minus or without.
pub(crate) fn bare_number(written: &Expr) -> Option<f64> {
    match written {
        Expr::Unary(unary) if unary.op() == Some(UnaryOp::Negate) => bare_number(&unary.operand()?),
        Expr::Number(number) => number.value().filter(|_| number.unit().is_none()),
        _ => None,
    }
}

/// Returns true for a unit in which turns are counted: `deg`, `1/rad`, `rpm`.
fn is_of_angles(unit: &str) -> bool {
    unit.split(['/', '*', '^']).any(|factor| UNITS.contains(&factor) || factor == "rpm")
}

/// Returns true for what an angle stays one by, so many times as large: it has no unit of angles, and does not speak of
/// `pi`.
fn is_factor(e: &Expr) -> bool {
    let mut parts = e.syntax().descendants().filter_map(Expr::cast);
    !parts.any(|part| match part {
        Expr::Number(number) => number.unit().is_some_and(|unit| is_of_angles(unit.text())),
        Expr::Name(name) => name.name().is_some_and(|word| word.text() == "pi"),
        Expr::Call(call) => call.name().is_some_and(|word| word.text() == "pi"),
        _ => false,
    })
}
