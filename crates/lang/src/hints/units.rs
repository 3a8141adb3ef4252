//! Hints about units: which one is meant, and what stands behind a number in its place.

use crate::names::raised;
use base::{Diagnostic, Place};
use expr::dimension::Dimension;
use kernel::Document;
use kernel::builtin::{FUNCTIONS, find};
use kernel::quantity::is_of_the_sheet;
use syntax::ast::{self, BinaryOp, Expr};

/// Returns `0.25 in` for `1/4 in`, which is 1 divided by 4 inches, where a quantity of this dimension is wanted.
pub(super) fn fraction_of_unit(quotient: &ast::BinaryExpr, wanted: Dimension) -> Option<String> {
    let (BinaryOp::Divide, Expr::Number(above), Expr::Number(below)) =
        (quotient.op()?, quotient.left()?, quotient.right()?)
    else {
        return None;
    };
    let x = above.value().filter(|_| above.unit().is_none())? / below.value()?;
    let word = below.unit()?;
    let unit = expr::units::unit(word.text()).filter(|unit| unit.dimension == wanted);
    unit.filter(|_| x.is_finite())?;
    Some(format!("{} {}", base::number::shortest(x), word.text()))
}

/// Says how a quantity becomes a plain number, and what else it may be declared as.
pub(super) fn counted(
    document: &Document,
    found: Dimension,
    value: &Expr,
    written: &str,
) -> String {
    // a length, an area, … counts in the unit of the sheet, where that has one
    let of_sheet = document.unit.as_ref().filter(|_| is_of_the_sheet(found));
    let unit = match (of_sheet, found.0[0]) {
        (Some(unit), 1) => unit.to_string(),
        (Some(unit), power) => format!("{unit}^{power}"),
        (None, _) => {
            expr::units::preferred(found).map_or_else(|| found.to_string(), str::to_string)
        }
    };
    let written = match value {
        Expr::Binary(_) | Expr::If(_) | Expr::Let(_) => format!("({written})"),
        _ => written.to_string(),
    };
    match found.named() {
        Some(quantity) => {
            format!(
                "with its unit it is a `{quantity}`, the plain number of {unit} is `{written} / 1 {unit}`"
            )
        }
        None => format!("no class is named for its unit: `name => {written}` keeps it"),
    }
}

/// Returns the unit in `5 h = 6`, which somebody may have meant for the name of the next part.
pub(crate) fn unit_before_equals(value: &Expr) -> Option<String> {
    let Expr::Binary(comparison) = value else { return None };
    match (comparison.op()?, comparison.left()?) {
        (BinaryOp::Equal, Expr::Number(number)) => Some(number.unit()?.text().to_owned()),
        _ => None,
    }
}

/// Says what to do where a unit was meant for the name of the next part.
pub(crate) fn is_a_unit(unit: &str) -> String {
    format!("`{unit}` is a unit here: write `;` before it")
}

/// Returns `m^2` for `m2`.
fn squared(word: &str) -> Option<String> {
    let of = word.strip_suffix(['2', '3', '4'])?;
    Some(format!("{of}^{}", &word[of.len()..]))
}

/// Says of a name behind a number that what is meant is a product.
pub(crate) fn product_without_sign(place: Place, name: &str) -> Diagnostic {
    let written = format!("* {name}");
    no_unit(place, name)
        .hint(format!("a product has its sign: `{written}`"))
        .fix(format!("write {written}"), [(place, written)])
}

fn no_unit(place: Place, spelling: &str) -> Diagnostic {
    let message = format!("{spelling} is no unit that is known here");
    Diagnostic::error("unknown-unit", place, message)
}

/// Says of a name behind a number, with a comparison behind it, that it belongs to another rule.
pub(crate) fn comparison_without_and(place: Place, name: &str) -> Diagnostic {
    no_unit(place, name)
        .hint("two rules are joined by `and`; comparisons stand in a chain, `0 <= x <= 10`")
}

/// Says that a word is no unit, and which one is meant.
pub(crate) fn unknown_unit(place: Place, spelling: &str) -> Diagnostic {
    let d = no_unit(place, spelling);
    match spelling {
        "weak" | "medium" | "strong" | "required" => {
            return d.hint(format!("a strength stands before its rule: `{spelling} constraint …`"));
        }
        "step" | "by" => {
            return d
                .hint("every second of a list is `for i in 0..2 { constraint xs[2 * i] = 1 }`");
        }
        "where" | "and" | "with" => {
            return d.hint("two rules are joined by `and`: `constraint x^2 = 2 and x > 0`");
        }
        "unless" | "when" => {
            return d.hint("a rule under a condition is `constraint if x > 3 { y = 1 }`");
        }
        "elif" | "elseif" => return d.hint("write `else if`"),
        prefix @ ("n" | "p" | "u" | "µ" | "M" | "G") => {
            return d.hint(format!(
                "`{prefix}` stands before a unit: `{prefix}m`, `{prefix}F`, `{prefix}V`"
            ));
        }
        concentration @ ("mM" | "uM" | "µM" | "nM" | "pM") => {
            let prefix = concentration.trim_end_matches('M');
            let hint = format!("moles a litre are `{prefix}mol/L`, a length is `{prefix}m`");
            return d.hint(hint);
        }
        "x" | "X" => {
            return d.hint("a product has its sign: `3 * 10^8`; a power of ten is `3e8`, too");
        }
        "degC" | "celsius" | "Celsius" | "degF" | "fahrenheit" | "Fahrenheit" => {
            return d.hint("temperatures are in kelvin: 20 °C and 68 °F are `293.15 K`");
        }
        "EUR" | "USD" | "GBP" | "CHF" | "euro" | "euros" | "dollar" | "dollars" => {
            return d.hint("money is a plain number without its unit: `price: Real = 3.50`");
        }
        _ => {}
    }
    // a unit after it or an operator's words: each of its factors by itself
    let meant = expr::units::meant(spelling);
    match meant.as_slice() {
        [] if find(FUNCTIONS, spelling).is_some_and(|f| f.parameters.is_empty()) => {
            product_without_sign(place, spelling)
        }
        [] if let Some(power) = raised(spelling).or_else(|| squared(spelling)).filter(|u| expr::units::unit(u).is_some()) => d
            .hint(format!("the unit is `{power}`"))
            .fix(format!("write {power}"), [(place, power)]),
        [] => d.hint(
            "known are m, s, kg, N, J, W, V, A, ohm, … with every prefix, and ft, lb, psi, …; a product has its sign, \
             `2 * x`",
        ),
        [one] => d.meant(one),
        several => d.hint(format!("write {}", several.join(" or "))),
    }
}
