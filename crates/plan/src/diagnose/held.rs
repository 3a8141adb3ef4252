//! What holds a number where it is: the circuit that its own wish would close, and the anchors in it.

use crate::host::Host;
use crate::planner::{Model, Planner};
use crate::rule::Source;
use kernel::{SlotId, Structure, Values};
use std::collections::BTreeSet;

/// What holds a number.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Held {
    /// The constraints that would have to give way, in order of declaration.
    pub constraints: Vec<Source>,
    /// The anchored slots that these constraints speak of, or the number itself.
    pub anchors: Vec<SlotId>,
}

impl Planner {
    /// Returns what holds a number where it is in a state; nothing where it can move.
    ///
    /// A given number in its way is no hindrance: it yields. Nor is a constraint that follows there from the others.
    pub fn held(
        &mut self,
        model: Model<'_>,
        values: &Values,
        slot: SlotId,
        host: &mut dyn Host,
    ) -> Option<Held> {
        if model.structure.slots[slot].anchored {
            return Some(Held { constraints: Vec::new(), anchors: vec![slot] });
        }
        let mut tasks = self.wishing(model, slot);
        let mut conflicts = self.against_wish(&tasks);
        if !conflicts.is_empty() {
            for task in &mut tasks {
                if let Some(left) = self.without_implied(model, task, values, host) {
                    *task = left;
                }
            }
            conflicts = self.against_wish(&tasks);
        }
        let constraints: BTreeSet<Source> =
            conflicts.iter().flat_map(|c| c.circuit.iter().copied()).collect();
        if conflicts.is_empty() {
            return None;
        }
        let anchors = self.anchors_of(model.structure, &constraints);
        Some(Held { constraints: constraints.into_iter().collect(), anchors })
    }

    /// Returns the anchored slots that constraints speak of, in order. Cost: a look at every rule.
    pub fn anchors_of(&self, structure: &Structure, constraints: &BTreeSet<Source>) -> Vec<SlotId> {
        let rules = self.rules.iter().filter(|r| constraints.contains(&r.source));
        let slots = rules.flat_map(|r| r.slots.iter().copied());
        let anchors: BTreeSet<SlotId> = slots.filter(|&s| structure.slots[s].anchored).collect();
        anchors.into_iter().collect()
    }
}
