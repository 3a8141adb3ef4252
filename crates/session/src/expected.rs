//! What an expectation says that is not true: both sides as people read them, and the given values that moved though
//! nobody spoke of them.
//!
//! A number stands in the unit in which the expectation writes it, with as many digits as tell the sides apart. Of
//! comparisons joined by `and` the first that is not true is told.

use crate::state::State;
use crate::view::ModeView;
use crate::words::{listed, show_thing};
use crate::write_back::unit_of_writing;
use crate::{angles, words};
use base::number::{close, significant};
use eval::{Answer, Evaluator};
use kernel::{BinaryOperator, DOCUMENT, Quantity, Shown, SlotId, Term, ThingId, Value};
use std::collections::BTreeSet;

/// So many digits tell most numbers apart, and more only where they do not.
const DIGITS: std::ops::RangeInclusive<usize> = 6..=17;

/// So many numbers make a place at most.
const MOST_OF_PLACE: usize = 3;

/// How many values that moved are named.
const MOST_NAMED: usize = 3;
/// How many of them are put into words at all.
const MOST_SHOWN: usize = 32;

/// Tests a rule, and shows both sides where it is not true; `source` is how it is written.
///
/// # Errors
/// What both sides are.
pub(crate) fn expect_rule(
    state: &State,
    rule: &Term,
    within: Option<&Term>,
    source: &str,
) -> Result<(), String> {
    let evaluator = state.evaluator(&state.values);
    let verdict = evaluator.test_rule(rule, within, DOCUMENT).map_err(|f| f.message)?;
    if verdict.holds {
        return Ok(());
    }
    let source = source.rsplit_once(" within ").map_or(source, |(before, _)| before).trim();
    let parts = conjuncts(rule);
    if parts.len() > 1 {
        let written: Vec<&str> = source.split(" and ").collect();
        for (at, part) in parts.iter().enumerate() {
            let own = if written.len() == parts.len() { written[at] } else { "" };
            expect_rule(state, part, within, own).map_err(|told| match own.trim() {
                "" => told,
                own => format!("{own}: {told}"),
            })?;
        }
    }
    let raw = verdict.left.zip(verdict.right);
    match both_sides(state, &evaluator, rule, source).or(raw) {
        Some((left, right)) => Err(format!("{left} and {right}")),
        None => Err("this is not true".into()),
    }
}

/// Returns what `and` joins, in order.
fn conjuncts(rule: &Term) -> Vec<&Term> {
    let (mut open, mut parts) = (vec![rule], Vec::new());
    while let Some(term) = open.pop() {
        match term {
            Term::Binary(BinaryOperator::And, a, b) => open.extend([&**b, &**a]),
            other => parts.push(other),
        }
    }
    parts
}

/// Returns both sides of a comparison of numbers or places in words that differ; nothing for others.
fn both_sides<'a>(
    state: &'a State,
    evaluator: &Evaluator<'a>,
    rule: &'a Term,
    source: &str,
) -> Option<(String, String)> {
    use BinaryOperator::{Equal, Greater, GreaterEqual, Less, LessEqual};
    let Term::Binary(Equal | Greater | GreaterEqual | Less | LessEqual, left, right) = rule else {
        return None;
    };
    let class = angles::class_of_sides(state, evaluator, DOCUMENT, [left, right]);
    let shown = |side: &'a Term| {
        let answer = evaluator.evaluate(side, DOCUMENT).ok()?;
        numbers(state, &answer, Quantity { class, written: source, ..Quantity::default() })
    };
    // a list alone is shown as one
    let is_list =
        |side: &'a Term| matches!(evaluator.evaluate(side, DOCUMENT), Ok(Answer::List(_)));
    if is_list(left) && is_list(right) {
        return None;
    }
    let (left, right) = (shown(left)?, shown(right)?);
    let all = DIGITS.map(|digits| (said(&left, digits), said(&right, digits)));
    all.into_iter().find(|(left, right)| left != right)
}

/// Returns the numbers of a value as they are shown: one of a number, several of a place.
fn numbers(state: &State, answer: &Answer<'_>, quantity: Quantity<'_>) -> Option<Vec<Shown>> {
    let document = &state.lowered.document;
    match answer {
        Answer::Number(x, dimension) => {
            let quantity = Quantity { dimension: *dimension, ..quantity };
            Some(vec![kernel::show_quantity(*x, quantity, document)])
        }
        Answer::Made(made) => numbers_of_all(state, &made.fields, quantity),
        Answer::List(items) => numbers_of_all(state, items, quantity),
        Answer::Thing(thing) if document.is_place(state.structure.things[*thing].class) => {
            let slots = state.structure.slots_under(*thing);
            Some(
                slots
                    .into_iter()
                    .map(|slot| words::show_slot(state, slot, &state.values))
                    .collect(),
            )
        }
        Answer::Thing(_)
        | Answer::Bool(_)
        | Answer::Option(..)
        | Answer::Text(_)
        | Answer::Context(_)
        | Answer::Picture(_)
        | Answer::Function(_) => None,
    }
}

fn numbers_of_all(state: &State, all: &[Answer<'_>], quantity: Quantity<'_>) -> Option<Vec<Shown>> {
    let each = all.iter().take(MOST_OF_PLACE + 1).map(|one| numbers(state, one, quantity));
    let numbers = each.collect::<Option<Vec<_>>>()?.concat();
    (1..=MOST_OF_PLACE).contains(&numbers.len()).then_some(numbers)
}

/// Says numbers with so many digits; a whole number and what six digits tell exactly have all that they need.
fn said(all: &[Shown], digits: usize) -> String {
    let number = |shown: &Shown| {
        let exact: f64 = shown.exact.parse().unwrap_or(f64::NAN);
        let text = match exact.fract() == 0.0 || exact.is_nan() {
            true => shown.exact.clone(),
            false => significant(exact, digits),
        };
        words::with_unit(text, &shown.unit)
    };
    let words: Vec<String> = all.iter().map(number).collect();
    if let [one] = &words[..] { one.clone() } else { format!("({})", words.join(", ")) }
}

/// Given values that moved though nobody spoke of them.
pub(crate) struct Unasked<'s> {
    before: &'s State,
    after: &'s State,
    /// What is written as one, in order of declaration.
    units: Vec<ThingId>,
    told: Vec<String>,
    /// How many more there are that are not looked at.
    more: usize,
}

impl<'s> Unasked<'s> {
    /// Returns the given values that are others than they were; `spoken` are the slots of what was set or moved itself.
    ///
    /// Places are among them where nothing else moved. What moved by less than six digits tell is left out.
    pub(crate) fn of(before: &'s State, after: &'s State, spoken: &BTreeSet<SlotId>) -> Self {
        let shown = |unit: ThingId| {
            let was = show_thing(before, unit, &before.values).unwrap_or_default();
            let is = show_thing(before, unit, &after.values).unwrap_or_default();
            (was != is).then(|| (unit, format!("{} moved from {was} to {is}", path(before, unit))))
        };
        let mut units = units_moved(before, after, spoken);
        let is_lone = |unit: &ThingId| before.structure.slot_of(*unit).is_some();
        if units.iter().any(is_lone) {
            units.retain(is_lone);
        }
        let more = units.split_off(units.len().min(MOST_SHOWN)).len();
        let (units, told) = units.into_iter().filter_map(shown).unzip();
        Self { before, after, units, told, more }
    }

    /// Says what moved for a number that was set, where there was a choice of which one moves.
    #[cold]
    #[inline(never)]
    pub(crate) fn view(&self) -> Option<ModeView> {
        let is_lone = |&unit: &ThingId| self.before.structure.slot_of(unit).is_some();
        let are_several = self.units.len() + self.more > 1 && self.units.iter().all(is_lone);
        are_several.then(|| {
            let message = format!("lock what shall stay: {}", self.in_words());
            ModeView { constraint: String::new(), message, span: None }
        })
    }

    /// Says what moved; empty where nothing did.
    fn in_words(&self) -> String {
        let mut all: Vec<String> = self.told.iter().take(MOST_NAMED).cloned().collect();
        let more = self.told.len() - all.len() + self.more;
        if more > 0 {
            all.push(format!("{more} more moved"));
        }
        listed(&all)
    }

    /// Says what moved and how it is held, where that would help a rule that is not true: one that was true asks that
    /// what it speaks of stays, another that this moves instead of the rest.
    pub(crate) fn for_rule(&self, rule: &Term, within: Option<&Term>) -> Option<String> {
        let now = self.after.evaluator(&self.after.values);
        let is_true = |part| now.test_rule(part, within, DOCUMENT).is_ok_and(|v| v.holds);
        let rule = conjuncts(rule).into_iter().find(|&part| !is_true(part))?;
        let evaluator = self.before.evaluator(&self.before.values);
        let (verdict, read) = evaluator.listening(|| evaluator.test_rule(rule, within, DOCUMENT));
        let was_true = verdict.is_ok_and(|verdict| verdict.holds);
        let slots = |unit: ThingId| self.before.structure.slots_under(unit);
        let is_read = |unit: &&ThingId| slots(**unit).iter().any(|slot| read.contains(slot));
        let all = || self.units.iter();
        // places yield as a matter of course: they are told to who asks of them that they stay
        let are_lone = all().any(|&unit| self.before.structure.slot_of(unit).is_some());
        let unit = match (was_true, are_lone) {
            (true, _) => all().find(is_read).or_else(|| all().next().filter(|_| are_lone)),
            (false, true) => all().find(|unit| !is_read(unit)),
            (false, false) => None,
        }?;
        let unit = path(self.before, *unit);
        Some(format!("{}; `anchor {unit}` holds it", self.in_words()))
    }
}

fn path(state: &State, unit: ThingId) -> String {
    state.structure.path(&state.lowered.document, unit).to_string()
}

/// Returns what is written as one, and given, and moved, in order of declaration.
fn units_moved(before: &State, after: &State, spoken: &BTreeSet<SlotId>) -> Vec<ThingId> {
    if before.structure.slots.len() != after.structure.slots.len() {
        return Vec::new();
    }
    let differs = |slot: SlotId| match (before.values.get(slot), after.values.get(slot)) {
        (Value::Number(was), Value::Number(is)) => !close(was, is),
        _ => false,
    };
    let is_meant = |slot: SlotId| {
        before.structure.given(slot).is_some()
            && !before.structure.slots[slot].is_layout
            && !spoken.contains(&slot)
            && differs(slot)
    };
    let slots = after.values.changed(&before.values).filter(|&slot| is_meant(slot));
    let mut units: Vec<ThingId> = slots.map(|slot| unit_of_writing(before, slot)).collect();
    units.sort_unstable();
    units.dedup();
    units
}
