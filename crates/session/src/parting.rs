//! Parting: what the text has to give once a path is taken out of its merges.
//!
//! Every path keeps its present value. What the structure before tells of that is written with the same
//! edit, so that the text is opened once: what the path is given by itself, and the numbers that gave way
//! as long as it was merged. What is left is found by opening.

use crate::document::Open;
use crate::state::State;
use crate::write_back::literal;
use kernel::{DOCUMENT, Literal, Path, SlotId, Term, ThingId, Value};
use plan::Planner;
use std::collections::BTreeSet;
use syntax::edit::TextEdit;

/// Returns the edits that part a path, and those that give what it leads to, and what gave way for it, the
/// present values; the first alone where they would touch.
pub(crate) fn edits(open: &Open, path: &Path, parting: Vec<TextEdit>) -> Vec<TextEdit> {
    let state = &open.state;
    let Ok(thing) = state.structure.follow(DOCUMENT, path) else { return parting };
    let document = &state.lowered.document;
    let write = |t: ThingId| (state.structure.path(document, t), literal(state, t, &state.values));
    // leaves may be one with each other as well
    let leaves = leaves(state, thing).into_iter();
    let apart: BTreeSet<ThingId> =
        leaves.flat_map(|leaf| std::iter::once(leaf).chain(next_given(state, leaf))).collect();
    let own = apart.into_iter().filter(|&t| is_given_another(state, t));
    let mut writes: Vec<(Path, Literal)> = own.map(write).collect();
    if !state.gave_way.is_empty() {
        let slots = state.structure.slots_under(thing);
        let apart: BTreeSet<SlotId> = slots.iter().copied().collect();
        let tied = open.planner.tied_to(slots);
        let gave_way = state.yielded().filter(|s| tied.contains(s) && !apart.contains(s));
        writes.extend(gave_way.map(|slot| write(state.structure.slots[slot].thing)));
    }
    let mut all = parting.clone();
    for edit in lang::write_values(&state.lowered, &writes) {
        let touched = |a: &TextEdit| a.span.start <= edit.span.end && edit.span.start <= a.span.end;
        let mut touching = all.iter_mut().filter(|a| touched(a));
        match (touching.next(), touching.next()) {
            (None, _) => all.push(edit),
            // what is new stands where the merge stood
            (Some(gone), None) if gone.insert.is_empty() && edit.span.range().is_empty() => {
                *gone = syntax::edit::instead(&state.text, gone, &edit);
            }
            (Some(_), _) => return parting,
        }
    }
    all
}

/// Returns the slots whose values are computed anew once a thing is taken out of its merges, where nobody gave them
/// before: those that follow from given numbers, as the voltages and currents of what a lead is taken from do. Beside
/// these they would stand as given wherever the thing is merged next, and what is given would yield to them. What
/// rules tie to a place goes on from where it is, and a number that is parted itself keeps its value.
pub(crate) fn computed_anew(
    before: &State,
    path: &Path,
    after: &State,
    planner: &mut Planner,
) -> BTreeSet<SlotId> {
    let thing = before.structure.follow(DOCUMENT, path);
    if thing.is_ok_and(|thing| before.structure.slot_of(thing).is_some()) {
        return BTreeSet::new();
    }
    planner.tied_to_given(&after.structure)
}

/// Returns true for a number that is given by itself, and is another as it is merged.
fn is_given_another(state: &State, thing: ThingId) -> bool {
    let structure = &state.structure;
    let Some((given, slot)) = structure.given_apart(thing).zip(structure.slot_of(thing)) else {
        return false;
    };
    // a lone number holds what it is given, whoever gives it
    let is_lone = structure.slots[slot].place.is_none();
    match (&*given.term, state.values.get(slot)) {
        (Term::Number { value, .. }, Value::Number(is)) => {
            value.to_bits() != is.to_bits() && (is_lone || state.lowered.is_own_given(given.origin))
        }
        _ => false,
    }
}

/// Returns what decides the value of those that a thing is merged with, once it is none of them.
fn next_given(state: &State, thing: ThingId) -> Option<ThingId> {
    let others = state.structure.merged_with(thing).into_iter().filter(|&t| t != thing);
    let mut given = others.filter(|&t| state.structure.given_apart(t).is_some());
    given.next()
}

/// Returns the primitive things of a thing.
fn leaves(state: &State, thing: ThingId) -> Vec<ThingId> {
    let mut leaves = Vec::new();
    let mut stack = vec![thing];
    while let Some(t) = stack.pop() {
        match state.structure.slot_of(t) {
            Some(_) => leaves.push(t),
            None => stack.extend(state.structure.parts(t).rev()),
        }
    }
    leaves
}
