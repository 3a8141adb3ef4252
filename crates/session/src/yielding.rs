//! What is given and gave way when a document was opened: a warning at its line.
//!
//! In: a state, and the planner that opened it. Out: for every line that gives such a value, what it is, what was
//! given, what it became, and the constraints that made it so. What a class gives its things is told where the
//! document declares the thing, for there it can be given another value.

use crate::rules;
use crate::state::State;
use crate::words::{listed, show_both, show_slot};
use crate::write_back::unit_of_writing;
use base::{Diagnostic, Place};
use kernel::{DOCUMENT, Shown, SlotId, Term, ThingId, Values};
use plan::{Planner, Source};
use std::collections::{BTreeMap, BTreeSet};

/// The code of the warning.
pub(crate) const CODE: &str = "given-yields";

/// How many values of one line are named.
const MOST_NAMED: usize = 3;

/// What one line gives that gave way.
struct Line {
    of_class: bool,
    units: Vec<ThingId>,
    slots: BTreeSet<SlotId>,
}

/// Returns a warning for every line that gives what gave way.
///
/// Cost: nothing where nothing gave way, else that of going through the steps of what was opened.
pub(crate) fn warnings(state: &State, planner: &Planner) -> Vec<Diagnostic> {
    if state.gave_way.is_empty() { Vec::new() } else { told(state, planner) }
}

#[cold]
#[inline(never)]
fn told(state: &State, planner: &Planner) -> Vec<Diagnostic> {
    let mut lines: BTreeMap<(u32, u32, u32), (Place, Line)> = BTreeMap::new();
    for &(slot, _) in &state.gave_way {
        let Some((place, of_class)) = line_of(state, slot) else { continue };
        let key = (place.file.0, place.span.start, place.span.end);
        let (_, line) = lines.entry(key).or_insert_with(|| {
            (place, Line { of_class, units: Vec::new(), slots: BTreeSet::new() })
        });
        let unit = unit_of_writing(state, slot);
        if !line.units.contains(&unit) {
            line.units.push(unit);
        }
        line.of_class &= of_class;
        line.slots.insert(slot);
    }
    if lines.is_empty() {
        return Vec::new();
    }
    let slots = state.gave_way.iter().map(|(slot, _)| *slot).collect();
    let behind = planner.behind(&slots);
    let given = as_given(state);
    lines.into_values().map(|(place, line)| warning(state, place, &line, &given, &behind)).collect()
}

/// Returns the values as they were given, of what is given.
fn as_given(state: &State) -> Values {
    let written = eval::given_values(&state.lowered.document, &state.structure).0;
    let mut values = state.values.clone();
    let given = state.structure.slots.iter().filter(|(_, slot)| slot.given.is_some());
    given.for_each(|(slot, _)| values.put(slot, written.get(slot)));
    values
}

/// Returns where the document itself speaks of what a slot is given, and whether a class gives it.
fn line_of(state: &State, slot: SlotId) -> Option<(Place, bool)> {
    let given = state.structure.given(slot)?;
    if !given.of_class {
        return Some((state.lowered.place(given.origin), false));
    }
    let structure = &state.structure;
    let mut thing = structure.slots[slot].given?.me;
    while let Some(owner) = structure.things[thing].owner.filter(|&t| t != DOCUMENT) {
        thing = owner;
    }
    let field = structure.things[thing].field as usize;
    let layout = structure.layout(structure.things[DOCUMENT].class)?;
    let part = state.lowered.document.declared(*layout.fields.get(field)?)?;
    Some((state.lowered.place(part.origin), true))
}

fn warning(
    state: &State,
    place: Place,
    line: &Line,
    given: &Values,
    behind: &BTreeMap<SlotId, BTreeSet<Source>>,
) -> Diagnostic {
    let path = |unit| state.structure.path(&state.lowered.document, unit).to_string();
    let told = |&unit: &ThingId| {
        let [was, is] = show_both(state, unit, [given, &state.values]).unwrap_or_default();
        let by = if line.of_class { "by its class" } else { "here" };
        format!("{} is given {by} as {was}, and became {is}", path(unit))
    };
    let mut all: Vec<String> = line.units.iter().take(MOST_NAMED).map(told).collect();
    let more = line.units.len() - all.len();
    if more > 0 {
        all.push(format!("{more} more gave way"));
    }
    let sources: BTreeSet<Source> =
        line.slots.iter().filter_map(|slot| behind.get(slot)).flatten().copied().collect();
    let constraints: Vec<String> =
        sources.iter().filter_map(|&source| rules::told(state, source)).collect();
    let because = match constraints.is_empty() {
        true => String::new(),
        false => format!(", because of {}", listed(&constraints)),
    };
    // what is computed of numbers alone is seldom meant to yield
    let is_computed = |slot: &SlotId| {
        let given = state.structure.given(*slot);
        given.is_some_and(|given| matches!(*given.term, Term::Binary(..) | Term::Call { .. }))
    };
    let one = line.units.first().filter(|_| line.units.len() == 1);
    let said = match line.of_class {
        false if line.slots.iter().all(is_computed) => {
            "give a value with which the constraints hold, or write `constant` before it where it never yields"
        }
        true => "give it a value with which the constraints hold, in the body of the part",
        false if one.is_some() => {
            "leave its value out if it is to be computed, or `anchor` it and let another yield"
        }
        false => {
            "give a value with which the constraints hold, or `anchor` it and let another yield"
        }
    };
    let kept = one.filter(|_| line.of_class).and_then(|&unit| keeping(state, unit));
    let hint = kept.unwrap_or_else(|| said.to_string());
    Diagnostic::warning(CODE, place, format!("{}{because}", all.join("; "))).hint(hint)
}

/// Says what to write where a number that a class gives is meant to be computed: the value that was found, with all its
/// digits, in the body of the part. Nothing for an element of a list, whose body is that of every one.
fn keeping(state: &State, unit: ThingId) -> Option<String> {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let slot = structure.slot_of(unit)?;
    let path = structure.path(document, unit).to_string();
    let (part, within) = path.split_once('.').filter(|(part, _)| !part.contains('['))?;
    let Shown { unit, exact, .. } = show_slot(state, slot, &state.values);
    let found = format!("{within} = {exact} {unit}");
    Some(format!(
        "where it is to be computed all is well: `{}` in the body of {part} keeps what was found, and is told no more",
        found.trim_end()
    ))
}
