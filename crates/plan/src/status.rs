//! Status: what holds, what can still move, what says nothing new.

use crate::diagnose::redundancy::Redundant;
use crate::host::Host;
use crate::planner::{Model, Planner, Unmet};
use crate::rule::Source;
use crate::task::{Course, Holding, Task};
use base::IdVec;
use kernel::{SlotId, Values};
use solve::{Level, Stay};

/// The state of a document at rest.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Status {
    /// True if every required constraint holds.
    pub satisfied: bool,
    /// In how many independent ways the numbers can still move, given numbers and anchors held.
    pub freedom: usize,
    /// The constraints of any strength that do not hold, in order of declaration.
    pub unmet: Vec<Unmet>,
    /// Required constraints that hold and say nothing new, in order of declaration.
    pub redundant: Vec<Redundant>,
    /// The state of every slot.
    pub slots: IdVec<SlotId, SlotState>,
}

/// Whether a slot can move.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SlotState {
    /// It can still move.
    Free,
    /// Constraints, anchors or given numbers determine it.
    Fixed,
    /// A required constraint on it does not hold.
    Conflicting,
}

impl Planner {
    /// Says how the document stands while nothing is edited.
    ///
    /// Plans what was not planned yet; after that, linear in the rules.
    pub fn status(&mut self, model: Model<'_>, values: &Values, host: &mut dyn Host) -> Status {
        let structure = model.structure;
        let unmet = self.unmet(model, 0..self.rules.len() as u32, values, host);
        let is_unmet = |s: Source| unmet.iter().any(|u| u.source == s);
        let mut slots = IdVec::filled(SlotState::Fixed, structure.slots.len());
        let mut freedom = 0;
        for (slot, s) in structure.slots.iter() {
            let lone = self.net.rules_of(slot).is_empty();
            if lone && Self::resting_hold(structure, slot) == Holding::Kept {
                slots[slot] = SlotState::Free;
                freedom += usize::from(s.primitive.is_number());
            }
        }
        let redundancy = self.redundancy(model, values, &unmet, host);
        freedom += redundancy.theorem_rows();
        for task in self.resting() {
            let in_mode = task.by_values(self, values);
            let task = in_mode.as_ref().unwrap_or(task);
            if !matches!(task.course, Course::Search(_)) {
                freedom += task.plan.report.freedom;
            }
            for slot in movable(task) {
                slots[slot] = SlotState::Free;
            }
        }
        for rule in self.rules.iter() {
            if rule.shape.level == Level::Required && is_unmet(rule.source) {
                rule.slots.iter().for_each(|&s| slots[s] = SlotState::Conflicting);
            }
        }
        Status {
            satisfied: unmet.iter().all(|u| u.level != Level::Required),
            freedom,
            unmet,
            redundant: redundancy.constraints,
            slots,
        }
    }
}

/// Returns the slots of a task at rest that can move: those that keep their own value, and those
/// that follow them.
fn movable(task: &Task) -> Vec<SlotId> {
    let mut moves: Vec<bool> =
        task.system.slots.iter().map(|s| matches!(s.stay, Stay::Kept { .. })).collect();
    for step in &task.plan.steps {
        let rows: usize = step
            .relations
            .iter()
            .map(|&r| match &task.system.relations[r as usize].body {
                solve::RelationBody::Equations(equations) => equations.len as usize,
                solve::RelationBody::Opaque { .. } => step.targets.len(),
            })
            .sum();
        let follows = step.reads.iter().any(|&r| moves[r as usize]) || step.targets.len() > rows;
        for &t in &step.targets {
            moves[t as usize] = follows;
        }
    }
    let slots = task.component.slots.iter().zip(moves);
    slots.filter(|(_, moves)| *moves).map(|(&s, _)| s).collect()
}
