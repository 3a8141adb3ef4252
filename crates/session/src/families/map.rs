//! The map of a program: over a lattice of values of two parameters, where it draws and why not elsewhere.

use super::grid::{class_of, written};
use super::{ended, find, literal, names_in, run_of, values_of};
use crate::state::State;
use crate::view::{FamilyAxis, FamilyMap, MapAxis, MapReason, Refusal};
use crate::words;
use base::Name;
use eval::Measures;
use kernel::{ClassId, ClassKind, Literal, Primitive, Term};

/// So many values an axis has.
const STEPS: usize = 32;
/// A range that suggests itself begins at this part of the example's value.
const LEAST: f64 = 0.1;
/// A range that suggests itself ends at this multiple of the example's value.
const MOST: f64 = 2.5;

/// Returns the parameters that are numbers, each with the range around its value that suggests itself.
///
/// # Errors
/// No such program.
pub(crate) fn axes(
    state: &State,
    name: &str,
    values: &[(String, Literal)],
) -> Result<Vec<FamilyAxis>, Refusal> {
    let (program, _) = find(state, name)?;
    let document = &state.lowered.document;
    let asked = document.program(program).map(|p| p.parameters.as_slice()).unwrap_or_default();
    let axis = |asked: &kernel::program::Asked| {
        let class = class_of(state, program, &asked.name)?;
        is_number(state, class).then_some(())?;
        let now = number_of(state, (program, class), (&asked.name, values))?;
        let is_whole = is_integer(state, class);
        let [from, to] = if now == 0.0 { [-1.0, 1.0] } else { [LEAST * now, MOST * now] };
        let [from, to] = if is_whole {
            [from.floor(), (to - from).max(1.0).ceil() + from.floor()]
        } else {
            [from, to]
        };
        let text = |x: f64| rounded(state, class, x);
        Some(FamilyAxis { parameter: asked.name.to_string(), from: text(from), to: text(to) })
    };
    Ok(asked.iter().filter_map(axis).collect())
}

fn rounded(state: &State, class: ClassId, x: f64) -> String {
    let tidy = base::number::significant(x, 3).parse().unwrap_or(x);
    written(state, class, &Literal::Number(tidy))
}

fn is_number(state: &State, class: ClassId) -> bool {
    let kind = &state.lowered.document.classes[class].kind;
    matches!(kind, ClassKind::Primitive(Primitive::Real(_) | Primitive::Integer))
}

fn is_integer(state: &State, class: ClassId) -> bool {
    let kind = &state.lowered.document.classes[class].kind;
    matches!(kind, ClassKind::Primitive(Primitive::Integer))
}

/// The number of a parameter among values, or in the program's own example.
fn number_of(
    state: &State,
    (program, class): (ClassId, ClassId),
    (name, values): (&str, &[(String, Literal)]),
) -> Option<f64> {
    if let Some((_, Literal::Number(x))) = values.iter().find(|(own, _)| own == name) {
        return Some(*x);
    }
    let document = &state.lowered.document;
    let asked = &document.program(program)?.parameters;
    let at = asked.iter().position(|a| *a.name == *name)?;
    let text = super::grid::examples(state, program).into_iter().nth(at)?;
    match literal(document, class, &text).ok()? {
        Literal::Number(x) => Some(x),
        Literal::Bool(_) | Literal::Text(_) | Literal::Tuple(_) | Literal::Path(_) => None,
    }
}

/// Runs a program over a lattice of values of two parameters; the others are as given, else the program's own.
///
/// # Errors
/// No such program or parameter, an end that is no value, two axes that are one.
pub(crate) fn map(
    state: &State,
    name: &str,
    values: &[(String, Literal)],
    [across, up]: [&FamilyAxis; 2],
) -> Result<FamilyMap, Refusal> {
    let (program, family) = find(state, name)?;
    if across.parameter == up.parameter {
        return Err(words::refuse("a map is over two parameters: choose another one".into()));
    }
    let (across_numbers, across_axis) = lattice(state, program, across)?;
    let (up_numbers, up_axis) = lattice(state, program, up)?;
    let evaluator = state.evaluator(&state.values);
    // what a table says besides, no value of a parameter tells
    let document = &state.lowered.document;
    let of_program = |name: &&Name| {
        class_of(state, program, name).is_some()
            || document.find_message(program, name, None).is_some()
    };
    let rules = family.map_or(&[][..], |family| &family.rules).iter();
    let rules: Vec<&(String, Term)> =
        rules.filter(|(_, rule)| names_in(rule).iter().all(of_program)).collect();
    let others: Vec<(String, Literal)> = values
        .iter()
        .filter(|(name, _)| *name != across.parameter && *name != up.parameter)
        .cloned()
        .collect();
    let mut made = FamilyMap { across: across_axis, up: up_axis, ..FamilyMap::default() };
    let what = format!("map of {name}");
    for y in &up_numbers {
        for x in &across_numbers {
            let mut row = others.clone();
            row.push((across.parameter.clone(), Literal::Number(*x)));
            row.push((up.parameter.clone(), Literal::Number(*y)));
            let values = values_of(state, program, &row);
            let drawn = evaluator.measure_with(&what, program, values, |run| {
                let is_in = ended(&evaluator, rules.iter().copied(), run).is_none();
                is_in.then(Measures::default)
            });
            if drawn.map_err(|f| words::refuse(f.message))?.is_some() {
                made.places.push(None);
                continue;
            }
            let run = run_of((state, &evaluator), program, &row)?;
            let why =
                ended(&evaluator, rules.iter().copied(), &run).map(|(outcome, step, message)| {
                    let is_it = |r: &MapReason| r.outcome == outcome && r.step == step;
                    made.reasons.iter().position(is_it).unwrap_or_else(|| {
                        let outcome = outcome.into();
                        made.reasons.push(MapReason { outcome, step, message });
                        made.reasons.len() - 1
                    })
                });
            made.places.push(why);
        }
    }
    let now = |axis: &FamilyAxis, numbers: &[f64]| {
        let class = class_of(state, program, &axis.parameter)?;
        let x = number_of(state, (program, class), (&axis.parameter, values))?;
        let (first, last) = (numbers.first()?, numbers.last()?);
        let part = (x - first) / (last - first);
        (0.0..=1.0).contains(&part).then_some(part)
    };
    made.now = now(across, &across_numbers).zip(now(up, &up_numbers));
    Ok(made)
}

/// Rounds a value of a lattice to the power of ten below the step between two of them.
fn tidy(x: f64, step: f64) -> f64 {
    let mut fine = 1.0;
    while fine > step {
        fine /= 10.0;
    }
    while fine * 10.0 <= step {
        fine *= 10.0;
    }
    let parts = (x / fine * 10.0).round();
    base::number::significant(parts * fine / 10.0, 6).parse().unwrap_or(x)
}

/// The values of an axis, as the document counts and as they are read.
fn lattice(
    state: &State,
    program: ClassId,
    axis: &FamilyAxis,
) -> Result<(Vec<f64>, MapAxis), Refusal> {
    let document = &state.lowered.document;
    let name = &axis.parameter;
    let none = || words::refuse(format!("there is no number among the parameters called {name}"));
    let class = class_of(state, program, name).filter(|&c| is_number(state, c));
    let class = class.ok_or_else(none)?;
    let end = |typed: &str| match literal(document, class, typed) {
        Ok(Literal::Number(x)) => Ok(x),
        Ok(_) => Err(none()),
        Err(message) => Err(words::refuse(format!("{name}: {message}"))),
    };
    let (from, to) = (end(&axis.from)?, end(&axis.to)?);
    if from >= to {
        let (from, to) = (&axis.from, &axis.to);
        return Err(words::refuse(format!(
            "{name} goes from {from} to {to}: wanted is a range upwards"
        )));
    }
    let is_whole = is_integer(state, class);
    let steps = if is_whole { (to - from).min(STEPS as f64 - 1.0) as usize + 1 } else { STEPS };
    let number = |at: usize| {
        let x = from + (to - from) * at as f64 / (steps - 1) as f64;
        if is_whole { x.round() } else { tidy(x, (to - from) / (steps - 1) as f64) }
    };
    let numbers: Vec<f64> = (0..steps).map(number).collect();
    let (unit, per) = match document.classes[class].kind {
        ClassKind::Primitive(Primitive::Real(dimension)) => {
            let class = &document.classes[document.named_class(class)].name;
            let quantity = kernel::Quantity { dimension, class, written: &axis.from };
            let unit = kernel::show_quantity(to, quantity, document).unit;
            let one = |x: f64| kernel::in_unit(x, dimension, &unit, document);
            let values = numbers.iter().map(|&x| one(x)).collect();
            (unit, values)
        }
        _ => (String::new(), numbers.clone()),
    };
    Ok((numbers, MapAxis { parameter: name.clone(), values: per, unit }))
}
