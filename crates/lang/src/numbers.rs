//! Numbers in text: units, what a person types into a value, and how a value is written.

use crate::lower::OWN;
use base::number::shortest;
use base::{Diagnostic, Name, Place, Span};
use expr::dimension::Dimension;
use expr::units;
use kernel::{ClassId, ClassKind, Document, Literal, Primitive};
use syntax::ast::{BinaryOp, Expr, UnaryOp};

/// Returns a number of SI in the document's base units. Powers of ten are shifted, not multiplied.
pub(crate) fn from_si(document: &Document, si: f64, dimension: Dimension) -> f64 {
    shifted(document, si, i32::from(dimension.0[0]))
}

/// Returns a number of the document's base units in SI.
pub(crate) fn to_si(document: &Document, x: f64, dimension: Dimension) -> f64 {
    shifted(document, x, -i32::from(dimension.0[0]))
}

/// Scales by the document's units of length in a metre, to a power.
fn shifted(document: &Document, x: f64, power: i32) -> f64 {
    let scale = document.units_per_metre;
    if power == 0 || scale == 1.0 || x == 0.0 {
        return x;
    }
    let tens = [10.0, 100.0, 1000.0, 1e6, 1e9].iter().position(|t| *t == scale);
    let Some(exponent) = tens.map(|i| [1, 2, 3, 6, 9][i]) else {
        return x * base::number::pow(scale, f64::from(power));
    };
    format!("{x:e}")
        .split_once('e')
        .and_then(|(digits, own)| {
            let own: i32 = own.parse().ok()?;
            format!("{digits}e{}", own + exponent * power).parse().ok()
        })
        .unwrap_or(x * base::number::pow(scale, f64::from(power)))
}

/// Returns a number of base units as text and unit: what a person reads and may type back.
///
/// Lengths and plain numbers have no unit, as bare numbers mean them.
pub fn show_number(x: f64, dimension: Dimension, document: &Document) -> (String, String) {
    match units::preferred(dimension) {
        Some(unit) => (shortest(to_si(document, x, dimension)), unit.into()),
        None => (shortest(x), String::new()),
    }
}

/// Writes a number so that reading it gives its bits, with the unit that was written before, if any.
pub(crate) fn write_number(
    x: f64,
    dimension: Dimension,
    document: &Document,
    written: Option<&str>,
) -> String {
    let preferred = units::preferred(dimension);
    for spelling in [written, preferred].into_iter().flatten() {
        let Some(unit) = units::unit(spelling).filter(|u| u.dimension == dimension) else {
            continue;
        };
        let Some(shown) = unit.show(to_si(document, x, dimension)) else { continue };
        for candidate in [shown, shown.next_up(), shown.next_down()] {
            let text = shortest(candidate);
            let read = unit.read(&text).map(|si| from_si(document, si, dimension));
            if read.map(f64::to_bits) == Some(x.to_bits()) {
                return format!("{text} {spelling}");
            }
        }
    }
    // A bare number means the base unit, whatever it measures.
    shortest(x)
}

/// What a typed value is for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wanted {
    /// A thing of a class.
    Class(ClassId),
    /// Whatever it is.
    Anything,
}

/// Reads what a person typed into a value: `300 ohm`, `2*80`, `(3, 4)`, `true`, any words for a text.
///
/// # Errors
/// What was found and what was wanted; the place counts in what was typed.
pub fn read_literal(
    typed: &str,
    wanted: Wanted,
    document: &Document,
) -> Result<Literal, Diagnostic> {
    let primitive = match wanted {
        Wanted::Class(class) => match document.classes[class].kind {
            ClassKind::Primitive(p) => Some(p),
            ClassKind::Composite
            | ClassKind::List(_)
            | ClassKind::Set(_)
            | ClassKind::Reference(_) => None,
        },
        Wanted::Anything => None,
    };
    if let Some(Primitive::Text | Primitive::Color) = primitive {
        return Ok(Literal::Text(typed.to_string()));
    }
    let span = Span::new(0, typed.len() as u32);
    let place = Place { file: OWN, span };
    let parse = syntax::parse_expression(OWN, typed.trim());
    let broken = || Diagnostic::error("not-a-value", place, format!("`{typed}` is no value"));
    if let Some(d) = parse.diagnostics().first() {
        return Err(broken().hint(d.message.clone()));
    }
    let expr = parse.file().expression().ok_or_else(broken)?;
    let literal = literal(&expr, document).ok_or_else(broken)?;
    let wanted_dimension = match primitive {
        Some(Primitive::Real(d)) => d,
        Some(Primitive::Integer) => Dimension::NONE,
        Some(Primitive::Bool | Primitive::Text | Primitive::Color) | None => {
            return match (primitive, &literal) {
                (Some(Primitive::Bool), Typed::Literal(Literal::Bool(_))) | (None, _) => {
                    Ok(literal.into_literal())
                }
                _ => Err(broken().hint("write `true` or `false`")),
            };
        }
    };
    match literal {
        Typed::Number(x, None) => Ok(Literal::Number(x)),
        Typed::Number(x, Some(d)) if d == wanted_dimension => Ok(Literal::Number(x)),
        Typed::Number(_, Some(d)) => {
            let name = |d: Dimension| d.named().map_or_else(|| d.to_string(), str::to_string);
            let message = format!("`{typed}` is {}, wanted is {}", name(d), name(wanted_dimension));
            Err(Diagnostic::error("dimension-mismatch", place, message))
        }
        Typed::Literal(_) => Err(broken().hint("a number is wanted")),
    }
}

/// A typed value before it is known what is wanted.
enum Typed {
    Number(f64, Option<Dimension>),
    Literal(Literal),
}

impl Typed {
    fn into_literal(self) -> Literal {
        match self {
            Self::Number(x, _) => Literal::Number(x),
            Self::Literal(l) => l,
        }
    }
}

fn literal(expr: &Expr, document: &Document) -> Option<Typed> {
    match expr {
        Expr::Text(t) => Some(Typed::Literal(Literal::Text(t.text()?.unquoted()))),
        Expr::Bool(b) => Some(Typed::Literal(Literal::Bool(b.value()))),
        Expr::Paren(p) => literal(&p.inner()?, document),
        Expr::Tuple(t) => {
            let items: Option<Vec<Literal>> =
                t.elements().map(|e| Some(literal(&e, document)?.into_literal())).collect();
            Some(Typed::Literal(Literal::Tuple(items?)))
        }
        Expr::Number(n) => {
            let digits = n.digits()?;
            match n.unit() {
                None => Some(Typed::Number(n.value()?, None)),
                Some(unit) => {
                    let (si, d) = units::read_quantity(digits.text(), unit.text())?;
                    Some(Typed::Number(from_si(document, si, d), Some(d)))
                }
            }
        }
        Expr::Unary(u) => match (u.op()?, literal(&u.operand()?, document)?) {
            (UnaryOp::Negate, Typed::Number(x, d)) => Some(Typed::Number(-x, d)),
            (UnaryOp::Plus, number) => Some(number),
            (UnaryOp::Negate | UnaryOp::Not, _) => None,
        },
        other => constant(&|_| None, other).map(|x| Typed::Number(x, None)),
    }
}

/// Computes an expression of numbers and of names that stand for numbers.
pub(crate) fn constant(names: &dyn Fn(&Name) -> Option<f64>, expr: &Expr) -> Option<f64> {
    let x = match expr {
        Expr::Number(n) if n.unit().is_none() => n.value()?,
        Expr::Name(n) => names(&n.name()?.name())?,
        Expr::Paren(p) => constant(names, &p.inner()?)?,
        Expr::Unary(u) => match u.op()? {
            UnaryOp::Negate => -constant(names, &u.operand()?)?,
            UnaryOp::Plus => constant(names, &u.operand()?)?,
            UnaryOp::Not => return None,
        },
        Expr::Binary(b) => {
            let (x, y) = (constant(names, &b.left()?)?, constant(names, &b.right()?)?);
            match b.op()? {
                BinaryOp::Add => x + y,
                BinaryOp::Subtract => x - y,
                BinaryOp::Multiply => x * y,
                BinaryOp::Divide => x / y,
                BinaryOp::Power => expr::Binary::Pow.apply(x, y),
                _ => return None,
            }
        }
        _ => return None,
    };
    x.is_finite().then_some(x)
}
