//! Shown: what is in a slot, as people read it.
//!
//! In: a state and values. Out: a number in its unit, a word, a truth value. What is no more than rounding beside its
//! like is shown as nothing.

use crate::state::State;
use crate::words::{plain, quantity_of, written_for};
use kernel::{Primitive, Quantity, Shown, SlotId, ThingId, Value, Values};

/// A computed coordinate is rounding where it is a smaller part than this of the largest of its place.
pub(crate) const ROUNDING: f64 = 1e-12;

/// Smaller whole numbers are shown with all their digits.
const MOST_WHOLE: f64 = 1e6;

/// Returns a value as a person reads it: six digits and its unit.
pub(crate) fn show_slot(state: &State, slot: SlotId, values: &Values) -> Shown {
    match (state.structure.slots[slot].primitive, values.get(slot)) {
        (Primitive::Real(_), Value::Number(x)) => {
            let written = written_for(state, slot);
            let quantity = quantity_of(state, slot, &written);
            let document = &state.lowered.document;
            if !is_rounding(state, slot, values) && !is_rounding_of_a_sum(state, slot, values) {
                return match is_told_as_it_is(x, quantity) {
                    true => plain((x as i64).to_string()),
                    false => kernel::show_quantity(x, quantity, document),
                };
            }
            let nothing = kernel::show_quantity(0.0, quantity, document);
            let exact = kernel::in_unit(x, quantity.dimension, &nothing.unit, document);
            Shown { exact: base::number::shortest(exact), ..nothing }
        }
        (Primitive::Bool, Value::Number(x)) => plain((x != 0.0).to_string()),
        (Primitive::Choice(of), Value::Number(x)) => {
            let name = state.lowered.document.option_at(of, x);
            plain(name.map_or_else(|| base::number::shortest(x), ToString::to_string))
        }
        (_, Value::Number(x)) => plain(base::number::shortest(x)),
        (_, Value::Text(t)) => plain(t.to_string()),
    }
}

/// Returns true for a whole number of few digits that has no unit, nor is written with one: most of what tables of many
/// plain numbers show.
fn is_told_as_it_is(x: f64, quantity: Quantity<'_>) -> bool {
    let Quantity { dimension, class, written } = quantity;
    let is_plain = dimension.is_none() && class != "Angle";
    let is_number = |b: u8| b.is_ascii_digit() || matches!(b, b'.' | b'-');
    is_plain && x.fract() == 0.0 && x.abs() < MOST_WHOLE && written.bytes().all(is_number)
}

/// Returns true for a computed coordinate that is no more than rounding beside the others of its place, as the sine of
/// half a turn is.
fn is_rounding(state: &State, slot: SlotId, values: &Values) -> bool {
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
fn is_rounding_of_a_sum(state: &State, slot: SlotId, values: &Values) -> bool {
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
