//! Given numbers typed anew in a document that held: followed from the state before, as where they are set.
//!
//! In: the state before, and that of the text as it was typed, opened. Out: the state that counts. As a rule both
//! ways come to the same, and the text stays as it was typed. Where opening comes to another solution, what is
//! followed counts, and the places that it came to are written into the text, so that it opens so again. Where a
//! number that the text gives would have to yield, or the way does not lead there, the text has been opened: that
//! says what is wrong with it.

use crate::host::Host;
use crate::state::State;
use crate::texts::Texts;
use crate::write_back::{Edited, differing, sides_after, unit_of_writing, write_back, write_sides};
use base::number::{Toward, close};
use kernel::{SlotId, Term, ThingId, Value, Values};
use plan::{EditKind, Planner, Target};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Where following leads.
struct Followed {
    values: Values,
    /// The slots of the numbers that were typed.
    typed: Vec<SlotId>,
    sides: BTreeMap<SlotId, Toward>,
}

/// Returns the state that counts of a text that was typed, and its planner. `before` held.
pub(crate) fn follow(
    before: &State,
    (state, mut planner): (State, Planner),
    host: &dyn Host,
) -> (State, Planner) {
    let followed = followed(before, &state, &mut planner);
    let Some(followed) = followed.filter(|f| differing(&state, &f.values).next().is_some()) else {
        return (state, planner);
    };
    let Followed { values, typed, sides } = followed;
    let edited = Edited { slots: typed, ..Edited::default() };
    let (next, planner) = write_back(&state, &values, &edited, host, planner.into_plans());
    let (next, planner) = write_sides(next, planner, &sides, host);
    let is_kept = next.diagnostics.len() <= state.diagnostics.len()
        && next.structure.slots.len() == state.structure.slots.len()
        && differing(&next, &values).next().is_none();
    if is_kept {
        return (next, planner);
    }
    State::of(state.text.clone(), Some(before), host, planner.into_plans())
}

/// Follows the numbers that were typed from the state before; nothing where something else changed, where that is
/// refused, or where another number that is given would yield.
fn followed(before: &State, state: &State, planner: &mut Planner) -> Option<Followed> {
    let (old, new) = (&before.structure, &state.structure);
    let is_wrong = state.diagnostics.iter().any(|d| d.severity == base::Severity::Error);
    if !Rc::ptr_eq(&old.form, &new.form) || is_wrong {
        return None;
    }
    let is_typed = |&slot: &SlotId| {
        let [old, new] = [old, new].map(|s| s.given(slot).map(|g| &g.term));
        old != new
    };
    let typed: Vec<SlotId> = new.slots.ids().filter(is_typed).collect();
    let is_number = |slot: &SlotId| {
        let given = new.given(*slot).map(|g| &*g.term);
        matches!(given, Some(Term::Number { .. })) && new.slots[*slot].primitive.is_number()
    };
    // a place is set as a whole, as it is anchored
    let units: BTreeSet<ThingId> = typed.iter().map(|&slot| unit_of_writing(state, slot)).collect();
    let set = || units.iter().flat_map(|&unit| new.slots_under(unit));
    if typed.is_empty() || !set().all(|slot| is_number(&slot)) {
        return None;
    }
    let given = eval::given_values(&state.lowered.document, new).0;
    let target = |unit: ThingId| {
        let numbers = new.slots_under(unit).into_iter().map(|slot| given.get(slot));
        (Target::Thing(unit), numbers.collect())
    };
    let targets: Vec<(Target<'_>, Vec<Value>)> = units.iter().map(|&unit| target(unit)).collect();
    let mut values = before.values.clone();
    let mut texts = Texts::knowing(&state.lowered.document, new, &given);
    let kind = EditKind::Set;
    let latest = planner.take_latest();
    let report = planner.edit(state.model(), &mut values, kind, &targets, &mut texts);
    planner.restore_latest(latest);
    let yields = |slot: SlotId| {
        let s = &new.slots[slot];
        let is_lone = s.primitive.is_number() && s.place.is_none() && s.given.is_some();
        is_lone && !close(values.numbers[slot], given.numbers[slot])
    };
    if report.refusal.is_some() || new.slots.ids().any(yields) {
        return None;
    }
    let sides = sides_after(before, &values, &report.undecided);
    Some(Followed { values, typed, sides })
}
