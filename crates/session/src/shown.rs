//! Shown: what is in a slot, as people read it.
//!
//! In: a state and values. Out: a number in its unit, a word, a truth value. What is no more than rounding beside its
//! like is shown as nothing.

use crate::rounding::is_rounding;
use crate::state::State;
use crate::templates;
use crate::words::{plain, quantity_of, written_for};
use kernel::{Primitive, Quantity, Shown, SlotId, Value, Values};

/// Smaller whole numbers are shown with all their digits.
const MOST_WHOLE: f64 = 1e6;

/// Returns a value as a person reads it: six digits and its unit.
pub(crate) fn show_slot(state: &State, slot: SlotId, values: &Values) -> Shown {
    match (state.structure.slots[slot].primitive, values.get(slot)) {
        (Primitive::Real(_), Value::Number(x)) => {
            let written = written_for(state, slot);
            let quantity = quantity_of(state, slot, &written);
            let document = &state.lowered.document;
            if !is_rounding(state, slot, values) {
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
        (_, Value::Text(t)) => {
            let exact = templates::source(state, slot).unwrap_or_else(|| t.to_string());
            Shown { exact, ..plain(t.to_string()) }
        }
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
