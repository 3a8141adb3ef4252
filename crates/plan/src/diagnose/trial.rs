//! Trials: a part of the rules solved on its own, on a copy of the values.

use crate::aim::Aim;
use crate::component::Component;
use crate::host::Host;
use crate::planner::{Model, Planner};
use crate::run::run;
use crate::task::Holding;
use kernel::{SlotId, Values};
use std::collections::BTreeSet;
use std::rc::Rc;

impl Planner {
    /// Solves these rules from these values with nothing edited, every other rule left out.
    ///
    /// Returns true if every required one of them then holds. The plans are not kept.
    pub(crate) fn try_rules(
        &mut self,
        model: Model<'_>,
        rules: &[u32],
        values: &mut Values,
        holding: &dyn Fn(SlotId) -> Holding,
        host: &mut dyn Host,
    ) -> bool {
        let slots: BTreeSet<SlotId> =
            rules.iter().flat_map(|&r| self.rules.get(r).slots.iter().copied()).collect();
        let mut rules = rules.to_vec();
        rules.sort_unstable();
        let component = Component { rules, slots: slots.into_iter().collect() };
        let mark = self.plans.mark();
        let alike = std::mem::take(&mut self.alike);
        let tasks = self.tasks(model.structure, vec![Rc::new(component)], holding, &[]);
        self.alike = alike;
        let start = values.clone();
        let aim = Aim::default();
        let solved =
            tasks.iter().all(|t| run(self, model, t, &aim, &start, values, host).is_solved);
        self.plans.forget_since(mark);
        solved
    }
}

/// Moves every number by a little of the extent, differently each: a start that is not special.
///
/// Given numbers too: what holds for these alone is no theorem. What has to be whole or is anchored
/// keeps its value.
pub(crate) fn perturbed(model: Model<'_>, slots: &[SlotId], values: &Values) -> Values {
    /// How far, as a part of the extent.
    const PART: f64 = 1.0 / 128.0;
    let mut moved = values.clone();
    let mut extents: Vec<(kernel::Primitive, f64, f64)> = Vec::new();
    for &s in slots {
        let (primitive, x) = (model.structure.slots[s].primitive, values.numbers[s]);
        match extents.iter_mut().find(|e| e.0 == primitive) {
            Some((_, low, high)) => (*low, *high) = (low.min(x), high.max(x)),
            None => extents.push((primitive, x, x)),
        }
    }
    let extent = |primitive| {
        let found = extents.iter().find(|e| e.0 == primitive);
        found.map_or(1.0, |(_, low, high)| (high - low).max(1.0))
    };
    for &s in slots {
        let slot = &model.structure.slots[s];
        let moves = match slot.primitive {
            kernel::Primitive::Real(_) => !slot.anchored,
            kernel::Primitive::Integer
            | kernel::Primitive::Bool
            | kernel::Primitive::Text
            | kernel::Primitive::Color => false,
        };
        if moves {
            moved.numbers[s] += extent(slot.primitive) * PART * scattered(s.0);
        }
    }
    moved
}

/// Returns a number between -1 and 1, away from 0, that depends on `seed` alone.
pub(crate) fn scattered(seed: u32) -> f64 {
    let mut z = u64::from(seed).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^= z >> 31;
    let unit = (z >> 11) as f64 / (1u64 << 53) as f64;
    let size = 0.25 + 0.75 * unit;
    if z & 1 == 1 { -size } else { size }
}
