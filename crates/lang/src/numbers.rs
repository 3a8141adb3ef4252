//! Numbers in text: units, what a person types into a value, and how a value is written.

use crate::kinds::{dimension_in_words, with_article};
use crate::lower::OWN;
use base::number::{RULE_TOLERANCE, rounded, shortest};
use base::{Diagnostic, Name, Place, Span};
use expr::dimension::Dimension;
use expr::units;
use kernel::quantity::{from_bare, from_si, is_of_the_sheet, spelling_for, to_bare, to_si};
use kernel::{ClassId, ClassKind, Document, Literal, Primitive, Quantity, in_unit};
use syntax::ast::{AstNode, BinaryOp, Expr, UnaryOp};

/// Says which unit was meant in a value that measures something else than is wanted: the letter of another quantity, or
/// none behind the one number of a product, where its factor would have a name.
pub(crate) fn unit_meant(value: &Expr, found: Dimension, wanted: Dimension) -> Option<String> {
    match (found, wanted) {
        (Dimension::CHARGE, Dimension::TEMPERATURE) => {
            return Some(
                "`C` is a coulomb; temperatures are in kelvin: 20 °C is `293.15 K`".into(),
            );
        }
        (Dimension::CAPACITANCE, Dimension::TEMPERATURE) => {
            return Some("`F` is a farad; temperatures are in kelvin: 68 °F is `293.15 K`".into());
        }
        _ if found.is_none() || wanted.is_none() => return None,
        _ => {}
    }
    let mut numbers = Vec::new();
    factors(value, false, &mut numbers);
    let [(number, is_divisor)] = &numbers[..] else { return None };
    let missing = if *is_divisor { found.over(wanted) } else { wanted.over(found) };
    let (factor, quantity) = (missing.named()?, wanted.named()?);
    let unit = units::preferred(missing).map_or_else(|| missing.to_string(), str::to_string);
    Some(format!(
        "is {number} {}? `{number} {unit}` makes it {}",
        with_article(factor),
        with_article(quantity)
    ))
}

/// Collects the numbers without a unit that a product multiplies or divides by, as they are written, each with whether
/// it divides.
fn factors(product: &Expr, is_divisor: bool, into: &mut Vec<(String, bool)>) {
    match product {
        Expr::Paren(inner) => {
            inner.inner().iter().for_each(|inner| factors(inner, is_divisor, into));
        }
        Expr::Number(number) if number.unit().is_none() => {
            into.push((number.syntax().text().to_string().trim().to_string(), is_divisor));
        }
        Expr::Binary(e) if matches!(e.op(), Some(BinaryOp::Multiply | BinaryOp::Divide)) => {
            e.left().iter().for_each(|left| factors(left, is_divisor, into));
            let turns = e.op() == Some(BinaryOp::Divide);
            e.right().iter().for_each(|right| factors(right, is_divisor != turns, into));
        }
        _ => {}
    }
}

/// Returns a limit of a way that began at `from` as text and unit: as few digits as say it to a
/// thousandth, rounded towards the beginning, so that what is read lies on the way.
///
/// The unit is that of [`kernel::show_quantity`].
pub fn show_limit(
    limit: f64,
    from: f64,
    quantity: Quantity<'_>,
    document: &Document,
) -> (String, String) {
    // a limit that is nothing beside the way to it is read in the unit of the beginning
    let is_nothing = limit.abs() <= 4.0 * RULE_TOLERANCE * from.abs();
    let spelling = spelling_for(if is_nothing { from } else { limit }, quantity, document);
    let shown = |x: f64| in_unit(x, quantity.dimension, &spelling, document);
    (short_of(shown(limit), shown(from)), spelling)
}

/// Writes a limit with as few decimals as say it to a thousandth, rounded towards `from`.
fn short_of(limit: f64, from: f64) -> String {
    let size = limit.abs().max((limit - from).abs());
    // a limit is known to the tolerance of rules, and no better
    let known = 4.0 * RULE_TOLERANCE * limit.abs().max(1.0);
    for decimals in 0..12 {
        let step = base::number::pow(10.0, -(decimals as f64));
        let beyond = |x: f64| (x - limit) * (limit - from).signum() > known && limit != from;
        let nearest = (limit / step).round() * step;
        let x = if beyond(nearest) { nearest - (limit - from).signum() * step } else { nearest };
        if (x - limit).abs() <= 1e-3 * size {
            return rounded(x + 0.0, decimals);
        }
    }
    shortest(limit)
}

/// Writes a number so that reading it gives its bits, with the unit that was written before, if any.
pub(crate) fn write_number(
    x: f64,
    dimension: Dimension,
    document: &Document,
    written: Option<&str>,
) -> String {
    let preferred = units::preferred(dimension).filter(|_| !is_of_the_sheet(dimension));
    for spelling in [written, preferred].into_iter().flatten() {
        let Some(unit) = units::unit(spelling).filter(|u| u.dimension == dimension) else {
            continue;
        };
        let Some(shown) = unit.show(to_si(document, x, dimension)) else { continue };
        let read = |text: &str| unit.read(text).map(|si| from_si(document, si, dimension));
        let is_it = |text: &str| read(text).map(f64::to_bits) == Some(x.to_bits());
        if let Some(text) = near(shown, is_it).or_else(|| in_many_digits(shown, x, read)) {
            return format!("{text} {spelling}");
        }
    }
    let read = |text: &str| text.parse().ok().map(|x| from_bare(document, x, dimension));
    let bare = to_bare(document, x, dimension);
    let written = || {
        let spelling = written?;
        let unit = units::unit(spelling).filter(|u| u.dimension == dimension)?;
        Some(format!("{} {spelling}", shortest(unit.show(to_si(document, x, dimension))?)))
    };
    near(bare, |text| read(text).map(f64::to_bits) == Some(x.to_bits()))
        .or_else(written)
        .unwrap_or_else(|| shortest(bare))
}

/// So many digits behind the first one of a number that was computed are more than anybody reads; what is left out is
/// a hundredth of the tolerance of rules.
const MEANT: i32 = 10;

/// Returns a written number, with its unit, without digits that only computing has made. `part` is how much larger the
/// largest number is that says the same place.
pub(crate) fn without_noise(text: String, part: f64) -> String {
    let (digits, unit) = text.split_at(text.find(' ').unwrap_or(text.len()));
    let Ok(x) = digits.parse::<f64>() else { return text };
    let first = format!("{:e}", x * part);
    let first = first.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0_i32);
    let decimals = usize::try_from(MEANT.saturating_sub(first)).unwrap_or(0);
    let short = rounded(x, decimals).parse().map(shortest).unwrap_or_default();
    if short.len() < digits.len() { short + unit } else { text }
}

/// Finds a number next to `x` whose shortest decimal reads as it should.
fn near(x: f64, reads: impl Fn(&str) -> bool) -> Option<String> {
    let (mut up, mut down) = (x, x);
    for _ in 0..4 {
        for candidate in [up, down] {
            let text = shortest(candidate);
            if reads(&text) {
                return Some(text);
            }
        }
        (up, down) = (up.next_up(), down.next_down());
    }
    None
}

/// Returns a decimal next to `shown` that reads as `x`, with more digits than a number keeps: not every one has a number
/// of another unit that reads as it does.
fn in_many_digits(shown: f64, x: f64, read: impl Fn(&str) -> Option<f64>) -> Option<String> {
    let (digits, power) = format!("{:.17e}", shown.abs())
        .split_once('e')
        .map(|(d, p)| (d.replace('.', "").parse::<i64>(), p.parse::<i32>()))?;
    let (digits, power) = (digits.ok()?, power.ok()?);
    let decimals =
        usize::try_from(17_i32.checked_sub(power)?).ok().filter(|d| (1..40).contains(d))?;
    let sign = if shown < 0.0 { "-" } else { "" };
    let text = |digits: i64| {
        let all = format!("{digits:0>width$}", width = decimals + 1);
        let (whole, parts) = all.split_at(all.len() - decimals);
        format!("{sign}{whole}.{parts}").trim_end_matches('0').to_string()
    };
    let (mut low, mut high) = (digits - 1000, digits + 1000);
    while low <= high {
        let middle = low + (high - low) / 2;
        let text = text(middle);
        let is = read(&text)?;
        if is.to_bits() == x.to_bits() {
            return Some(text);
        }
        (low, high) = if is.abs() < x.abs() { (middle + 1, high) } else { (low, middle - 1) };
    }
    None
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
    if let (Some(Primitive::Bool), Some(truth)) = (primitive, yes_or_no(typed)) {
        return Ok(Literal::Bool(truth));
    }
    let in_full = match primitive {
        Some(Primitive::Real(dimension)) => with_unit_of_prefix(typed.trim(), dimension),
        _ => None,
    };
    let span = Span::new(0, typed.len() as u32);
    let place = Place { file: OWN, span };
    let parse = syntax::parse_expression(OWN, in_full.as_deref().unwrap_or(typed.trim()));
    let broken = || Diagnostic::error("not-a-value", place, format!("`{typed}` is no value"));
    if let Some(d) = parse.diagnostics().first() {
        if let (Some(number), Some(Primitive::Real(_) | Primitive::Integer) | None) =
            (with_point(typed), primitive)
        {
            let hint = format!("the tenths of a number stand after a point: `{number}`");
            return Err(broken().hint(hint));
        }
        return Err(match crate::files::word_for_unit(&parse, d) {
            Some(word) if matches!(primitive, None | Some(Primitive::Real(_))) => {
                let unit = crate::hints::unknown_unit(place, word.text());
                let hint = unit.hint.map(|hint| format!("{}; {hint}", unit.message));
                broken().hint(hint.unwrap_or(unit.message))
            }
            Some(_) | None => broken().hint(d.message.clone()),
        });
    }
    let expr = parse.file().expression().ok_or_else(broken)?;
    let wanted = match wanted {
        Wanted::Class(class) => Some(class),
        Wanted::Anything => None,
    };
    literal(&expr, wanted, document).map_err(|wrong| {
        let d = match wrong {
            Wrong::Value => broken(),
            Wrong::Dimension(d, wanted) => {
                let (is, wanted) = (dimension_in_words(d), dimension_in_words(wanted));
                let message = format!("`{typed}` is {is}, wanted is {wanted}");
                Diagnostic::error("dimension-mismatch", place, message)
            }
        };
        match primitive {
            Some(Primitive::Bool) => d.hint("write `true` or `false`"),
            Some(Primitive::Choice(of)) => {
                let options: Vec<&str> =
                    document.classes[of].options.iter().map(Name::as_str).collect();
                d.hint(format!("it has {}", options.join(", ")))
            }
            Some(Primitive::Integer) => d.hint("a whole number is wanted"),
            Some(Primitive::Real(_)) if d.code == "not-a-value" => d.hint("a number is wanted"),
            None => match wanted.and_then(|class| made_of(class, document)) {
                Some(hint) => d.hint(hint),
                None => d,
            },
            _ => d,
        }
    })
}

/// Says what a thing is made of that has no value of its own; nothing where it has no parts.
fn made_of(class: ClassId, document: &Document) -> Option<String> {
    let ClassKind::Composite = document.classes[class].kind else { return None };
    let layout = document.layout(class);
    let parts: Vec<&str> = layout.iter().map(|&part| document.field_name(part).as_str()).collect();
    match parts.as_slice() {
        [] => None,
        ["x", "y"] => Some(String::from("a place is wanted, as `(3, 4)`")),
        parts => Some(format!("it is made of {}: set one of these", parts.join(", "))),
    }
}

/// The prefixes of the short form, each with that of a unit; not `m` and `T`, which are units of other quantities.
const SHORT_PREFIXES: [(&str, &str); 10] = [
    ("f", "f"),
    ("p", "p"),
    ("n", "n"),
    ("u", "u"),
    ("\u{b5}", "u"),
    ("\u{3bc}", "u"),
    ("k", "k"),
    ("K", "k"),
    ("M", "M"),
    ("G", "G"),
];

/// Returns a number in the short form of IEC 60062 with its unit in full: `2k` and `4k7` of a resistance are `2 kohm`
/// and `4.7 kohm`, `100n` of a capacitance `100 nF`. Nothing for any other.
fn with_unit_of_prefix(typed: &str, dimension: Dimension) -> Option<String> {
    let is_digit = |c: char| c.is_ascii_digit();
    let at = typed.find(char::is_alphabetic)?;
    let (whole, rest) = typed.split_at(at);
    let mut short = SHORT_PREFIXES.into_iter();
    let (prefix, decimals) =
        short.find_map(|(short, prefix)| Some((prefix, rest.strip_prefix(short)?)))?;
    let begins = whole.strip_prefix('-').unwrap_or(whole).starts_with(is_digit);
    let spelling = format!("{prefix}{}", units::preferred(dimension)?);
    let is_unit = units::unit(&spelling).is_some_and(|unit| unit.dimension == dimension);
    // a kelvin is one
    if !begins || !decimals.chars().all(is_digit) || !is_unit || dimension == Dimension::TEMPERATURE
    {
        return None;
    }
    Some(match decimals {
        "" => format!("{whole} {spelling}"),
        _ => format!("{whole}.{decimals} {spelling}"),
    })
}

/// Returns the unit that a person typed with a number for a thing of a class; nothing for what is no number with a unit,
/// and for quantities that a sheet has a unit of its own for.
pub fn unit_typed(typed: &str, class: ClassId, document: &Document) -> Option<Name> {
    let ClassKind::Primitive(Primitive::Real(dimension)) = document.classes[class].kind else {
        return None;
    };
    let in_full = with_unit_of_prefix(typed.trim(), dimension);
    let parse = syntax::parse_expression(OWN, in_full.as_deref().unwrap_or(typed.trim()));
    let unit = unit_of(&parse.file().expression()?)?;
    (!is_of_the_sheet(dimension)).then_some(unit)
}

/// Returns what `yes` and `no` say, as people answer a question.
fn yes_or_no(typed: &str) -> Option<bool> {
    match typed.trim().to_lowercase().as_str() {
        "yes" => Some(true),
        "no" => Some(false),
        _ => None,
    }
}

/// Returns `8.5 mm` for `8,5 mm`.
fn with_point(typed: &str) -> Option<String> {
    let (whole, rest) = typed.trim().split_once(',')?;
    let digits = whole.trim_start_matches(['-', '+']);
    let is_number = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    let goes_on = rest.starts_with(|c: char| c.is_ascii_digit()) && !rest.contains(',');
    (is_number && goes_on).then(|| format!("{whole}.{rest}"))
}

/// Why an expression is no value for what is wanted.
enum Wrong {
    Value,
    Dimension(Dimension, Dimension),
}

fn literal(expr: &Expr, class: Option<ClassId>, document: &Document) -> Result<Literal, Wrong> {
    let kind = class.map(|c| &document.classes[c].kind);
    match expr {
        Expr::Paren(p) => literal(&p.inner().ok_or(Wrong::Value)?, class, document),
        Expr::Tuple(t) => {
            let fields = match (kind, class) {
                (Some(ClassKind::Composite), Some(class)) => Some(document.layout(class)),
                (None, _) => None,
                _ => return Err(Wrong::Value),
            };
            let elements: Vec<Expr> = t.elements().collect();
            if fields.as_ref().is_some_and(|f| f.len() != elements.len()) {
                return Err(Wrong::Value);
            }
            let class = |i: usize| fields.as_ref().map(|f| document.field_class(f[i]));
            let items = elements.iter().enumerate().map(|(i, e)| literal(e, class(i), document));
            Ok(Literal::Tuple(items.collect::<Result<_, _>>()?))
        }
        Expr::Text(t) => match kind {
            None | Some(ClassKind::Primitive(Primitive::Text | Primitive::Color)) => {
                Ok(Literal::Text(t.plain().ok_or(Wrong::Value)?))
            }
            _ => Err(Wrong::Value),
        },
        Expr::Bool(b) => match kind {
            None | Some(ClassKind::Primitive(Primitive::Bool)) => Ok(Literal::Bool(b.value())),
            _ => Err(Wrong::Value),
        },
        Expr::Name(name) if let Some(ClassKind::Primitive(Primitive::Choice(of))) = kind => {
            let word = name.name().ok_or(Wrong::Value)?;
            let at = document.option_named(*of, word.text()).ok_or(Wrong::Value)?;
            Ok(Literal::Number(f64::from(at)))
        }
        other => {
            let (x, found) = quantity(other, document).ok_or(Wrong::Value)?;
            let wanted = match kind {
                Some(ClassKind::Primitive(Primitive::Real(d))) => *d,
                Some(ClassKind::Primitive(Primitive::Integer)) if x.fract() == 0.0 => {
                    Dimension::NONE
                }
                None => found.unwrap_or(Dimension::NONE),
                _ => return Err(Wrong::Value),
            };
            match found {
                None => finite(from_bare(document, x, wanted)),
                Some(d) if d == wanted => finite(x),
                Some(d) => Err(Wrong::Dimension(d, wanted)),
            }
        }
    }
}

/// Infinities and negative zero are no values.
fn finite(x: f64) -> Result<Literal, Wrong> {
    if x.is_finite() { Ok(Literal::Number(x + 0.0)) } else { Err(Wrong::Value) }
}

/// Computes an expression of numbers with units, in base units. A bare number fits any other.
fn quantity(expr: &Expr, document: &Document) -> Option<(f64, Option<Dimension>)> {
    match expr {
        Expr::Number(n) => match n.unit() {
            None => Some((n.value()?, None)),
            Some(unit) => {
                let (si, d) = units::read_quantity(n.digits()?.text(), unit.text())?;
                Some((from_si(document, si, d), Some(d)))
            }
        },
        Expr::Paren(p) => quantity(&p.inner()?, document),
        Expr::Unary(u) => match (u.op()?, quantity(&u.operand()?, document)?) {
            (UnaryOp::Negate, (x, d)) => Some((-x, d)),
            (UnaryOp::Plus, number) => Some(number),
            (UnaryOp::Not, _) => None,
        },
        Expr::Binary(b) => {
            let ((x, dx), (y, dy)) =
                (quantity(&b.left()?, document)?, quantity(&b.right()?, document)?);
            let plain = |d: Option<Dimension>| d.unwrap_or(Dimension::NONE);
            let of = |d: Dimension| (dx.is_some() || dy.is_some()).then_some(d);
            match b.op()? {
                op @ (BinaryOp::Add | BinaryOp::Subtract) => {
                    let d = dx.or(dy);
                    let same = d.unwrap_or(Dimension::NONE);
                    if [dx, dy].into_iter().flatten().any(|d| d != same) {
                        return None;
                    }
                    let base = |x: f64, own: Option<Dimension>| match own {
                        None if d.is_some() => from_bare(document, x, same),
                        _ => x,
                    };
                    let (x, y) = (base(x, dx), base(y, dy));
                    Some((if op == BinaryOp::Add { x + y } else { x - y }, d))
                }
                BinaryOp::Multiply => Some((x * y, of(plain(dx).times(plain(dy))))),
                BinaryOp::Divide => Some((x / y, of(plain(dx).over(plain(dy))))),
                _ => constant(&|_| None, expr).map(|x| (x, None)),
            }
        }
        _ => None,
    }
}

/// Returns the unit of a number as it is written; nothing for a bare number, and for any other expression.
pub(crate) fn unit_of(value: &Expr) -> Option<Name> {
    match value {
        Expr::Number(number) => Some(Name::new(number.unit()?.text())),
        Expr::Unary(negated) => unit_of(&negated.operand()?),
        _ => None,
    }
}

/// Computes an expression of numbers and of names that stand for numbers.
pub(crate) fn constant(known: &dyn Fn(&Expr) -> Option<f64>, expr: &Expr) -> Option<f64> {
    let x = match expr {
        Expr::Number(n) if n.unit().is_none() => n.value()?,
        Expr::Paren(p) => constant(known, &p.inner()?)?,
        Expr::Unary(u) => match u.op()? {
            UnaryOp::Negate => -constant(known, &u.operand()?)?,
            UnaryOp::Plus => constant(known, &u.operand()?)?,
            UnaryOp::Not => return None,
        },
        Expr::Binary(b) => {
            let (x, y) = (constant(known, &b.left()?)?, constant(known, &b.right()?)?);
            match b.op()? {
                BinaryOp::Add => x + y,
                BinaryOp::Subtract => x - y,
                BinaryOp::Multiply => x * y,
                BinaryOp::Divide => x / y,
                BinaryOp::Remainder => expr::Binary::Remainder.apply(x, y),
                BinaryOp::Power => expr::Binary::Pow.apply(x, y),
                _ => return None,
            }
        }
        other => known(other)?,
    };
    x.is_finite().then_some(x)
}
