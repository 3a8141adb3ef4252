//! What holds a number where it is: the circuit that its own wish would close, and the anchors in it.

use crate::planner::{Model, Planner};
use crate::rule::Source;
use kernel::SlotId;
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
    /// Returns what holds a number where it is; nothing where it can move.
    ///
    /// A given number in its way is no hindrance: it yields.
    pub fn held(&mut self, model: Model<'_>, slot: SlotId) -> Option<Held> {
        if model.structure.slots[slot].anchored {
            return Some(Held { constraints: Vec::new(), anchors: vec![slot] });
        }
        let conflicts = self.why_not(model, slot);
        let constraints: BTreeSet<Source> =
            conflicts.iter().flat_map(|c| c.circuit.iter().copied()).collect();
        if conflicts.is_empty() {
            return None;
        }
        let rules = self.rules.iter().filter(|r| constraints.contains(&r.source));
        let slots = rules.flat_map(|r| r.slots.iter().copied());
        let anchors: BTreeSet<SlotId> =
            slots.filter(|&s| model.structure.slots[s].anchored).collect();
        Some(Held {
            constraints: constraints.into_iter().collect(),
            anchors: anchors.into_iter().collect(),
        })
    }
}
