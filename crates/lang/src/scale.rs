//! The scale of a text: its base units are such that the quantities which it writes are of everyday size.
//!
//! In: the numbers with units that a text states, and the constants of other texts that it reads, checks and tolerances
//! apart. Out: powers of two for the base quantities. A text whose numbers are of everyday size in SI stays in SI.

use crate::files::File;
use base::Name;
use expr::dimension::Dimension;
use kernel::builtin::{FUNCTIONS, NUMBER_MESSAGES, find};
use kernel::quantity::{is_of_si, is_of_the_sheet, sharing};
use kernel::{Customary, Quantity, Scale, Usual};
use std::collections::{BTreeMap, BTreeSet};
use syntax::ast::{
    Arg, Assign, AstNode, Expr, FieldExpr, Member, NumberExpr, Param, Part, Type, UnitLine, Value,
    Word,
};
use syntax::{Parse, SyntaxKind, SyntaxNode, WalkEvent};

/// Numbers between these, in units of SI, are of everyday size.
const EVERYDAY: std::ops::Range<f64> = 1e-3..1e6;
/// How much it counts against a scale that it is not one, beside a number that is not of its size.
const PLAINNESS: f64 = 1e-3;
/// Up to so many powers of two from what would be best, the scale of the text before is kept: what was typed is
/// followed from there.
const NEAR: u16 = 8;
/// The largest power of two for one base quantity, and for all of them: the units of dimensions whose exponents are
/// no larger than 4 stay within what a number can be, 2^±1022.
const MOST: f64 = 120.0;
const TOGETHER: f64 = 300.0;
/// A smaller number does not read well in a unit in which the text writes others.
const LEAST: f64 = 1e-2;
/// A smaller number is not told in a unit of time that the text only joins with others, `h` of `km/h`.
const LEAST_WITHIN: f64 = 1.0;
/// How many base quantities there are.
const BASES: usize = 7;

/// How a text counts.
#[derive(Clone, Debug)]
pub(crate) struct Counting {
    pub(crate) scale: Scale,
    /// Whether it writes lengths with their units and names no unit of its sheet.
    pub(crate) writes_lengths: bool,
    /// The units of its quantities, as [`kernel::Document::usual`] has them.
    pub(crate) usual: BTreeMap<(Dimension, Option<Name>), Usual>,
    /// The system of its units, where that is not SI.
    pub(crate) customary: Option<Customary>,
    /// Quotients of its units.
    pub(crate) quotients: BTreeMap<Dimension, Vec<Name>>,
}

/// Returns how a text counts that uses others; the scale is that of the text `before` where it is near.
///
/// It is the one in which the logarithms of its numbers are nearest to zero, in the sense of least squares. Lengths
/// are scaled only where the text writes some with a unit and names no unit of its sheet.
pub(crate) fn of<'a>(
    parse: &Parse,
    used: impl Iterator<Item = &'a File>,
    before: Option<Scale>,
) -> Counting {
    let with_units = stated_with_units(parse);
    let quantities: Vec<(f64, Dimension)> = with_units.iter().filter_map(quantity).collect();
    let has_unit = parse.outline().any(|(kind, _)| kind == SyntaxKind::UnitLine);
    let any = |is: fn(Dimension) -> bool| quantities.iter().any(|(_, d)| is(*d));
    let read = constants_read(parse, used);
    let joins_a_length = |number: &NumberExpr| {
        quantity(number).is_some_and(|(_, d)| names_a_length(d)) || spells_a_length(number)
    };
    let writes_lengths = !has_unit
        && (any(is_of_the_sheet)
            || with_units.iter().chain(&read).any(joins_a_length)
                && !has_bare_places(parse, &stated(parse)));
    let usual = usual(parse, &with_units);
    let written = written_units(parse, &with_units);
    let customary = Customary::of(written.iter().map(|unit| &**unit));
    let quotients = kernel::quotients(&written);
    let keeps_length = has_unit || !any(|d| d == Dimension::LENGTH);
    let all = quantities.into_iter().chain(read.iter().filter_map(quantity)).collect();
    let best = best(all, keeps_length);
    let is_near = |scale: &Scale| scale.0.iter().zip(best.0).all(|(a, b)| a.abs_diff(b) <= NEAR);
    let before = before.filter(|scale| *scale != Scale::default()).filter(is_near);
    Counting { scale: before.unwrap_or(best), writes_lengths, usual, customary, quotients }
}

/// Returns the units that a text writes for each sort of quantity; none for those that it writes in one of SI with a
/// prefix of a thousand.
fn usual(parse: &Parse, stated: &[NumberExpr]) -> BTreeMap<(Dimension, Option<Name>), Usual> {
    let mut usual: BTreeMap<(Dimension, Option<Name>), Usual> = BTreeMap::new();
    let is_shared = |unit: &str| {
        expr::units::unit(unit).is_some_and(|known| sharing(known.dimension).is_some())
    };
    let tells = |unit: &str| !is_of_si(unit) || is_shared(unit);
    if !stated.iter().filter_map(NumberExpr::unit).any(|unit| tells(unit.text())) {
        return usual;
    }
    let classes = classes(parse);
    let mut of_si = Vec::new();
    let mut times: BTreeMap<&str, usize> = BTreeMap::new();
    let units: Vec<Word> = stated.iter().filter_map(NumberExpr::unit).collect();
    units.iter().for_each(|unit| *times.entry(unit.text()).or_default() += 1);
    for number in stated {
        let Some(unit) = number.unit() else { continue };
        let Some(known) = expr::units::unit(unit.text()) else { continue };
        // nothing is nothing in every unit
        if known.dimension.is_none() || is_of_si(unit.text()) && is_nothing(number) {
            continue;
        }
        let class = class_of(number, &classes);
        let class = class.filter(|class| Dimension::by_name(class) == Some(known.dimension));
        let key = (known.dimension, class.map(|class| Name::new(Quantity::sort(&class))));
        let found = usual.entry(key.clone());
        let units = &mut found.or_insert(Usual { units: Vec::new(), least: LEAST }).units;
        if is_of_si(unit.text()) {
            of_si.push(key);
        } else if !units.iter().any(|u| **u == *unit.text()) {
            units.push(unit.text().into());
        }
    }
    for key in of_si {
        usual.entry(key).and_modify(|usual| usual.units.clear());
    }
    let size = |unit: &Name| expr::units::read_quantity("1", unit).map_or(0.0, |(si, _)| si);
    let order = |a: &Name, b: &Name| {
        times.get(&**b).cmp(&times.get(&**a)).then(size(b).total_cmp(&size(a)))
    };
    usual.values_mut().for_each(|usual| usual.units.sort_by(order));
    if !usual.keys().any(|(dimension, _)| *dimension == Dimension::TIME)
        && let Some(time) = time_within(stated)
    {
        let within = Usual { units: vec![time], least: LEAST_WITHIN };
        usual.insert((Dimension::TIME, Some(Name::new(""))), within);
    }
    usual
}

/// Returns the units that a text writes, that of its sheet too; not those of nothing, which is nothing in every unit.
fn written_units(parse: &Parse, stated: &[NumberExpr]) -> Vec<Name> {
    let told = stated.iter().filter(|n| !is_nothing(n)).filter_map(NumberExpr::unit);
    let sheet = parse.syntax().children().find_map(UnitLine::cast).map(|line| line.unit());
    let all = told.map(|unit| Name::new(unit.text())).chain(sheet.map(|unit| Name::new(&unit)));
    let mut known = BTreeSet::new();
    all.filter(|unit| known.insert(unit.clone())).collect()
}

fn is_nothing(number: &NumberExpr) -> bool {
    number.value() == Some(0.0)
}

/// Returns the classes of the names that a text declares; none for a name of several.
fn classes(parse: &Parse) -> BTreeMap<Name, Option<Name>> {
    let mut classes: BTreeMap<Name, Option<Name>> = BTreeMap::new();
    for part in parse.syntax().descendants().filter_map(Part::cast) {
        let class = innermost(part.class());
        for word in part.names() {
            let known = classes.entry(word.name()).or_insert_with(|| class.clone());
            if *known != class {
                *known = None;
            }
        }
    }
    classes
}

/// Returns the class of what a number is the value of, or a term of its value; none where the text alone does not tell.
fn class_of(number: &NumberExpr, classes: &BTreeMap<Name, Option<Name>>) -> Option<Name> {
    let named = |word: Word| classes.get(&word.name()).cloned().flatten();
    let within = |kind| {
        use SyntaxKind::{BinaryExpr, ListExpr, ParenExpr, UnaryExpr};
        matches!(kind, BinaryExpr | UnaryExpr | ParenExpr | ListExpr)
    };
    let above = number.syntax().ancestors().skip(1).find(|n| !within(n.kind()))?;
    match above.kind() {
        SyntaxKind::Part => innermost(Part::cast(above)?.class()),
        SyntaxKind::Param => innermost(Param::cast(above)?.class()),
        SyntaxKind::Assign => named(last_word(&Assign::cast(above)?.target()?)?),
        SyntaxKind::Arg if !is_of_function(&above) => named(Arg::cast(above)?.label()?),
        _ => None,
    }
}

/// Returns the class of a type, of a list that of its elements.
fn innermost(class: Option<Type>) -> Option<Name> {
    let text = class?.syntax().text().to_string();
    text.split_whitespace().last().map(Name::new)
}

/// Returns the unit of time in all units that a text joins, `min` of `L/min`; nothing where it is the second, or there
/// are several.
fn time_within(stated: &[NumberExpr]) -> Option<Name> {
    let units = stated.iter().filter(|n| !is_nothing(n)).filter_map(NumberExpr::unit);
    let factors = units.flat_map(|unit| {
        let factors = unit.text().split(['*', '/']).map(|f| f.split('^').next().unwrap_or(f));
        factors.map(Name::new).collect::<Vec<_>>()
    });
    let is_time =
        |unit: &Name| expr::units::unit(unit).is_some_and(|u| u.dimension == Dimension::TIME);
    let mut times = factors.filter(is_time);
    let first = times.next().filter(|unit| !is_of_si(unit))?;
    times.all(|unit| unit == first).then_some(first)
}

/// Returns true for what is written with a unit of length, `m/s`, `kg/m^3`, and for a pressure; not for a newton, which
/// the writer of a bare length may well have.
fn names_a_length(dimension: Dimension) -> bool {
    let [length, mass, time, others @ ..] = dimension.0;
    let is_plain = others.iter().all(|&exponent| exponent == 0) && (mass == 0 || time == 0);
    is_plain && length != 0 || dimension == Dimension::PRESSURE
}

/// Returns true for a unit that is joined of others, one of which is of length: `N/m`, `W/m/K`.
fn spells_a_length(number: &NumberExpr) -> bool {
    number.unit().is_some_and(|unit| {
        let factors = unit.text().split(['*', '/']).map(|f| f.split('^').next().unwrap_or(f));
        let mut units = factors.filter_map(expr::units::unit);
        units.any(|u| u.dimension == Dimension::LENGTH)
    })
}

/// Returns true for a text that writes places or lengths without units. Where it does not say itself of which class a
/// number is, this may be a length.
fn has_bare_places(parse: &Parse, stated: &[NumberExpr]) -> bool {
    let is_bare =
        |number: &NumberExpr| number.unit().is_none() && number.value().is_some_and(|x| x != 0.0);
    let root = parse.syntax();
    let mut said: BTreeMap<Name, bool> = BTreeMap::new();
    for part in root.descendants().filter_map(Part::cast) {
        let is = is_length(part.class());
        part.names().for_each(|word| *said.entry(word.name()).or_default() |= is);
    }
    let may_be_one = |word: &Word| said.get(&word.name()).copied().unwrap_or(true);
    stated.iter().filter(|number| is_bare(number)).any(|number| {
        let within = |kind| {
            use SyntaxKind::{ListExpr, ParenExpr, UnaryExpr};
            matches!(kind, UnaryExpr | ParenExpr | ListExpr)
        };
        let mut above = number.syntax().ancestors().skip(1);
        let Some(above) = above.find(|n| !within(n.kind())) else { return false };
        match above.kind() {
            SyntaxKind::TupleExpr => true,
            SyntaxKind::Part => is_length(Part::cast(above).and_then(|part| part.class())),
            SyntaxKind::Param => is_length(Param::cast(above).and_then(|param| param.class())),
            SyntaxKind::Assign => {
                let target = Assign::cast(above).and_then(|assign| assign.target());
                target.and_then(|e| last_word(&e)).is_some_and(|word| may_be_one(&word))
            }
            SyntaxKind::Arg => {
                let label = Arg::cast(above.clone()).and_then(|arg| arg.label());
                !is_of_function(&above) && label.is_none_or(|word| may_be_one(&word))
            }
            _ => false,
        }
    })
}

/// Returns true for `Length` and lists of it.
fn is_length(class: Option<Type>) -> bool {
    innermost(class).is_some_and(|class| *class == *"Length")
}

/// Returns the last word of a path.
fn last_word(path: &Expr) -> Option<Word> {
    match path {
        Expr::Name(name) => name.name(),
        Expr::Field(field) => field.name(),
        Expr::Index(index) => last_word(&index.receiver()?),
        _ => None,
    }
}

/// Returns true for an argument of a function, or of a message to a number: that of a class, a program or a message to
/// a thing may be a length.
fn is_of_function(arg: &SyntaxNode) -> bool {
    let asked = arg.ancestors().nth(2).and_then(Expr::cast);
    match asked {
        Some(Expr::Call(call)) => {
            call.name().is_some_and(|word| find(FUNCTIONS, word.text()).is_some())
        }
        Some(Expr::Field(field)) => {
            field.name().is_some_and(|word| find(NUMBER_MESSAGES, word.text()).is_some())
        }
        _ => false,
    }
}

fn best(mut quantities: Vec<(f64, Dimension)>, keeps_length: bool) -> Scale {
    quantities.retain(|(x, _)| *x != 0.0);
    if quantities.iter().all(|(x, _)| EVERYDAY.contains(x)) {
        return Scale::default();
    }
    let mut normal = [[0.0; BASES + 1]; BASES];
    for (i, row) in normal.iter_mut().enumerate() {
        row[i] = if i == 0 && keeps_length { 1.0 / PLAINNESS } else { PLAINNESS };
    }
    for (x, dimension) in quantities {
        let size = f64::from(exponent(x));
        let d = dimension.0.map(f64::from);
        for i in (0..BASES).filter(|&i| i > 0 || !keeps_length) {
            for j in (0..BASES).filter(|&j| j > 0 || !keeps_length) {
                normal[i][j] += d[i] * d[j];
            }
            normal[i][BASES] -= d[i] * size;
        }
    }
    let powers = solved(normal).map(|x| x.clamp(-MOST, MOST));
    let together: f64 = powers.iter().map(|x| x.abs()).sum();
    let shrink = (TOGETHER / together).min(1.0);
    Scale(powers.map(|x| (shrink * x).round() as i16))
}

/// Returns the numbers that a text states, checks and tolerances apart.
pub(crate) fn stated(parse: &Parse) -> Vec<NumberExpr> {
    said(parse)
}

/// Returns those of them that have units. Only what holds a unit is looked at: many long texts have none.
fn stated_with_units(parse: &Parse) -> Vec<NumberExpr> {
    let file = parse.file();
    let members = parse.holding(SyntaxKind::Unit).filter_map(|span| file.member_at(span));
    let numbers = members.flat_map(|member| said_in::<NumberExpr>(member.syntax()));
    numbers.filter(|number| number.unit().is_some()).collect()
}

/// Returns what a text says of one kind, checks and tolerances apart.
fn said<N: AstNode>(parse: &Parse) -> Vec<N> {
    said_in(&parse.syntax())
}

/// Returns what is said of one kind in a node.
fn said_in<N: AstNode>(node: &SyntaxNode) -> Vec<N> {
    let mut found = Vec::new();
    let mut walk = node.preorder();
    while let Some(event) = walk.next() {
        let WalkEvent::Enter(node) = event else { continue };
        match node.kind() {
            SyntaxKind::Check | SyntaxKind::Lesson | SyntaxKind::Within | SyntaxKind::UnitLine => {
                walk.skip_subtree();
            }
            _ => found.extend(N::cast(node)),
        }
    }
    found
}

/// Returns the numbers of the constants of other texts that a text reads: of `constants.h`, or of a part of one,
/// `materials.copper.resistivity`.
fn constants_read<'a>(parse: &Parse, used: impl Iterator<Item = &'a File>) -> Vec<NumberExpr> {
    let has_constants = |file: &&File| constants(file).next().is_some();
    let texts: BTreeMap<&str, &File> = used
        .filter(has_constants)
        .filter_map(|file| Some((file.name.rsplit('.').next()?, file)))
        .collect();
    if texts.is_empty() {
        return Vec::new();
    }
    let numbers = said::<FieldExpr>(parse).into_iter().flat_map(|field| {
        let Some(Expr::Name(text)) = field.receiver() else { return Vec::new() };
        let file = text.name().and_then(|word| texts.get(word.text()));
        let value = file.zip(field.name()).and_then(|(file, word)| constant(file, word.text()));
        let part = field.syntax().parent().and_then(FieldExpr::cast).and_then(|of| of.name());
        value.map_or_else(Vec::new, |value| numbers_of(&value, part.as_ref()))
    });
    numbers.collect()
}

/// Returns the constants at the top of a text.
fn constants(file: &File) -> impl Iterator<Item = Part> {
    file.members_of(&[SyntaxKind::Part]).into_iter().filter_map(|member| match member {
        Member::Part(part) if part.is_constant() => Some(part),
        _ => None,
    })
}

/// Returns the value of a constant at the top of a text.
fn constant(file: &File, name: &str) -> Option<Expr> {
    let mut named = constants(file).filter(|part| part.names().any(|word| word.text() == name));
    named.next()?.value().and_then(Value::expr)
}

/// Returns the numbers of a value, those of one part of it where that is asked.
fn numbers_of(value: &Expr, part: Option<&Word>) -> Vec<NumberExpr> {
    let numbers = value.syntax().descendants().filter_map(NumberExpr::cast);
    let is_of_part = |number: &NumberExpr| {
        let arg = number.syntax().ancestors().find_map(Arg::cast);
        let label = arg.and_then(|arg| arg.label());
        part.is_none_or(|part| label.is_some_and(|label| label.text() == part.text()))
    };
    numbers.filter(is_of_part).collect()
}

/// Returns the size of a number with a unit, and what it measures.
pub(crate) fn quantity(number: &NumberExpr) -> Option<(f64, Dimension)> {
    let (digits, unit) = (number.digits()?, number.unit()?);
    let (si, dimension) = expr::units::read_quantity(digits.text(), unit.text())?;
    let measures = dimension.0.iter().any(|&d| d != 0);
    (measures && si.is_finite()).then_some((si.abs(), dimension))
}

/// Returns the power of two next below a positive number.
fn exponent(x: f64) -> i32 {
    const BIAS: i32 = 1023;
    const MANTISSA: u32 = 52;
    (x.to_bits() >> MANTISSA) as i32 - BIAS
}

/// Solves the normal equations, which are positive definite, by elimination.
fn solved(mut rows: [[f64; BASES + 1]; BASES]) -> [f64; BASES] {
    for k in 0..BASES {
        let pivot = rows[k];
        for row in rows.iter_mut().skip(k + 1) {
            let factor = row[k] / pivot[k];
            row.iter_mut().zip(pivot).for_each(|(x, p)| *x -= factor * p);
        }
    }
    let mut solution = [0.0; BASES];
    for k in (0..BASES).rev() {
        let known: f64 = (k + 1..BASES).map(|j| rows[k][j] * solution[j]).sum();
        solution[k] = (rows[k][BASES] - known) / rows[k][k];
    }
    solution
}
