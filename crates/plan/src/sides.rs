//! On which side a document opens, where its text says so and nothing given does.
//!
//! In: what was opened, and the sides that are written. Out: the values at the roots that lie the way that is written.

use crate::ghost::{Ghost, GhostKind};
use crate::host::Host;
use crate::planner::{Model, Planner};
use base::IdVec;
use base::number::{Toward, close};
use kernel::{Primitive, SlotId, Values};
use std::collections::BTreeSet;

/// Begins what a side is written of and nothing is given to on that side, as far out as the largest number that is
/// given of its kind: what starts at the same place does not end in one. Cost: linear where sides are written, else none.
pub(crate) fn begin(model: Model<'_>, has_value: &IdVec<SlotId, bool>, values: &mut Values) {
    let slots = &model.structure.slots;
    let is_open =
        |slot: SlotId| !has_value[slot] && matches!(slots[slot].primitive, Primitive::Real(_));
    let sides: Vec<(SlotId, Toward)> =
        model.structure.sides.iter().map(|(&slot, &toward)| (slot, toward)).collect();
    if !sides.iter().any(|&(slot, _)| is_open(slot)) {
        return;
    }
    // there are few kinds of quantities
    let mut farthest: Vec<(Primitive, f64)> = Vec::new();
    for (id, s) in slots.iter().filter(|(id, s)| has_value[*id] && s.primitive.is_number()) {
        let size = values.numbers[id].abs();
        match farthest.iter_mut().find(|(primitive, _)| *primitive == s.primitive) {
            Some((_, far)) => *far = far.max(size),
            None => farthest.push((s.primitive, size)),
        }
    }
    for (slot, toward) in sides.into_iter().filter(|&(slot, _)| is_open(slot)) {
        let alike = farthest.iter().find(|(primitive, _)| *primitive == slots[slot].primitive);
        let far = alike.map_or(0.0, |&(_, far)| far);
        let far = if far > 0.0 { far } else { 1.0 };
        values.numbers[slot] = if toward == Toward::More { far } else { -far };
    }
}

impl Planner {
    /// Goes over to the roots that lie as is written, one side after the other in order of declaration. What is given stays as it
    /// is, and so does what an earlier side says.
    ///
    /// Cost: nothing where no side is written of what is not given, else a solve for each root of its component.
    pub fn take_sides(&mut self, model: Model<'_>, values: &mut Values, host: &mut dyn Host) {
        let structure = model.structure;
        let is_free = |slot: SlotId| structure.given(slot).is_none();
        let sides = structure.sides.iter().map(|(&slot, &toward)| (slot, toward));
        let mark = self.plans.mark();
        let mut settled: Vec<SlotId> = Vec::new();
        for (slot, toward) in sides.filter(|&(slot, _)| is_free(slot)) {
            let s = &structure.slots[slot];
            let own: BTreeSet<SlotId> =
                structure.slots_under(s.place.unwrap_or(s.thing)).into_iter().collect();
            let lies_so = |ghost: &Ghost| {
                let (is, was) = (ghost.values.numbers[slot], values.numbers[slot]);
                let stays = |&s: &SlotId| close(ghost.values.numbers[s], values.numbers[s]);
                let further = if toward == Toward::More { is > was } else { is < was };
                further
                    && !close(is, was)
                    && matches!(ghost.kind, GhostKind::Root { .. })
                    && settled.iter().all(stays)
                    && values.changed(&ghost.values).all(is_free)
            };
            let found = self.roots(model, values, &own, host);
            if let Some(other) = found.into_iter().find(lies_so) {
                *values = other.values;
            }
            settled.push(slot);
        }
        self.plans.forget_since(mark);
    }
}
