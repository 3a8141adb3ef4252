//! Rounding: numbers that are no more than what computing has left, and are shown as nothing.

use crate::state::State;
use kernel::{SlotId, ThingId, Values};

/// A computed coordinate is rounding where it is a smaller part than this of the largest of its place.
pub const ROUNDING: f64 = 1e-12;

/// Of more constraints nobody looks for those that speak of one number.
const MOST_CONSTRAINTS: usize = 2000;

/// Returns true for a computed number that is no more than rounding beside others: of its place, of a set that it is
/// counted in, or of a constraint.
pub(crate) fn is_rounding(state: &State, slot: SlotId, values: &Values) -> bool {
    is_of_a_place(state, slot, values)
        || is_of_a_sum(state, slot, values)
        || is_of_a_rule(state, slot, values)
}

/// Returns true for a computed coordinate that is no more than rounding beside the others of its place, as the sine of
/// half a turn is.
fn is_of_a_place(state: &State, slot: SlotId, values: &Values) -> bool {
    let s = &state.structure.slots[slot];
    let x = values.numbers[slot].abs();
    // what a class gives is often no more than how a thing looks at first
    let is_computed = state.structure.given(slot).is_none_or(|given| given.of_class);
    let Some(place) = s.place.filter(|_| is_computed && x > 0.0) else { return false };
    let all = state.structure.slots_under(place);
    let largest = all.into_iter().map(|slot| values.numbers[slot].abs()).fold(0.0, f64::max);
    x < ROUNDING * largest
}

/// Returns true for a computed member of a set that is no more than rounding beside the others there: what is left of a
/// sum, as the current into a ground that nothing else leads to.
fn is_of_a_sum(state: &State, slot: SlotId, values: &Values) -> bool {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let s = &structure.slots[slot];
    let x = values.numbers[slot].abs();
    if s.given.is_some() || x == 0.0 || structure.sets.is_empty() {
        return false;
    }
    let largest_beside = |thing: ThingId| {
        let owner = structure.things[thing].owner?;
        let line = document.primary_line(structure.things[owner].class);
        let inserts = line.iter().flat_map(|&c| &document.classes[c].inserts);
        let mut sets = inserts.filter(|i| structure.follow(owner, &i.part).ok() == Some(thing));
        let set = structure.follow(owner, &sets.next()?.set).ok()?;
        let members = structure.sets.get(&structure.merged[set])?;
        let sizes = members.iter().filter_map(|&m| structure.slot_of(m));
        Some(sizes.map(|slot| values.numbers[slot].abs()).fold(0.0, f64::max))
    };
    let merged = structure.merged_with(s.thing);
    merged.into_iter().filter_map(largest_beside).any(|largest| x < ROUNDING * largest)
}

/// Returns true for a solved number that is no more than rounding beside another of its quantity, which a constraint of
/// the same body speaks of with it: all of these hold where it is nothing.
fn is_of_a_rule(state: &State, slot: SlotId, values: &Values) -> bool {
    let structure = &state.structure;
    let s = &structure.slots[slot];
    let x = values.numbers[slot].abs();
    let is_small = x > 0.0 && x < ROUNDING && s.given.is_none();
    if !is_small || structure.constraints.len() > MOST_CONSTRAINTS {
        return false;
    }
    let evaluator = state.evaluator(values);
    let owner = structure.things[s.thing].owner;
    let own = structure.constraints.iter().filter(|c| Some(c.owner) == owner);
    let reading = own.filter_map(|&c| {
        let read = evaluator.listening(|| evaluator.test(c)).1;
        read.contains(&slot).then_some((c, read))
    });
    let reading: Vec<_> = reading.collect();
    let is_alike = |other: &&SlotId| structure.slots[**other].primitive == s.primitive;
    let alike = reading.iter().flat_map(|(_, read)| read.iter().filter(is_alike));
    let largest = alike.map(|&other| values.numbers[other].abs()).fold(0.0, f64::max);
    if x >= ROUNDING * largest {
        return false;
    }
    let mut without = values.clone();
    without.numbers[slot] = 0.0;
    let evaluator = state.evaluator(&without);
    reading.iter().all(|(c, _)| evaluator.test(*c).is_ok_and(|verdict| verdict.holds))
}
