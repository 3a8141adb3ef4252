//! Whether the pointer's wish is met as well as can be.
//!
//! A wish that is not met leaves an error. Nothing that the rules leave open makes it less: its gradient is a sum
//! of the slopes of the rules, with the signs of inequalities. Told where nothing soft acts once the pointer has let
//! go, and no given number has yielded to it.

use super::answer::{Answer, OFF, acting, aside, rank, unpushed};
use super::{Edit, algebra::length};
use crate::evaluator::Evaluator;
use kernel::{ConstraintInstance, Primitive, SlotId};
use std::collections::BTreeSet;

/// How far off a wish is missed, as a part of it, and of the unit at least.
const MISSED: f64 = 1e-6;

/// Returns true if some of the wishes of an edit are not met.
pub(super) fn is_missed(edit: Edit<'_>) -> bool {
    let missed = |&(slot, to): &(SlotId, f64)| {
        (edit.after.numbers[slot] - to).abs() > MISSED * to.abs().max(1.0)
    };
    edit.wishes.iter().any(missed)
}

impl Answer<'_> {
    /// A wish that is not met could not be met better.
    pub(super) fn wish(
        &mut self,
        after: &Evaluator<'_>,
        of: &[ConstraintInstance],
        connected: &BTreeSet<SlotId>,
        extent: &dyn Fn(SlotId) -> f64,
    ) {
        let slots = &self.structure.slots;
        let wished = |slot: SlotId| self.edit.wishes.iter().find(|(s, _)| *s == slot);
        let yields = |&slot: &SlotId| {
            let is_real = matches!(slots[slot].primitive, Primitive::Real(_));
            is_real && !slots[slot].anchored && (!self.is_given(slot) || wished(slot).is_some())
        };
        let columns: Vec<SlotId> = connected.iter().copied().filter(yields).collect();
        let all = self.edit.wishes.iter().all(|(slot, _)| {
            let first = self.edit.wishes[0].0;
            slots[*slot].primitive == slots[first].primitive && columns.contains(slot)
        });
        let yielded = self.edit.before.changed(self.edit.after);
        if !all || yielded.into_iter().any(|slot| self.is_given(slot) && wished(slot).is_none()) {
            return;
        }
        let state = aside(self.edit.after, &columns, extent);
        let here = acting(after, of, &columns);
        let aside = acting(&after.in_state(&state), of, &columns);
        let (Some(here), Some(aside)) = (here, aside) else { return };
        // where rules depend on one another only here slopes prove nothing
        if rank(&here) < rank(&aside) {
            return;
        }
        let error =
            |&slot: &SlotId| wished(slot).map_or(0.0, |(_, to)| self.edit.after.numbers[slot] - to);
        let gradient: Vec<f64> = columns.iter().map(error).collect();
        let rest = unpushed(&here, &gradient);
        if rest > OFF * length(&gradient) {
            let paths: Vec<String> =
                self.edit.wishes.iter().map(|(slot, _)| (self.path)(*slot)).collect();
            let part = rest / length(&gradient);
            self.wrong.push(format!(
                "{} could be nearer to the pointer, by {part:.1e} of its slope",
                paths.join(", ")
            ));
        }
    }
}
