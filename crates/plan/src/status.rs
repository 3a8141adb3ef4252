//! Status: what holds, what can still move, what says nothing new.

use crate::diagnose::redundancy::{Redundancy, Redundant};
use crate::host::Host;
use crate::planner::{Model, Planner, Unmet};
use crate::rule::Source;
use crate::task::{Course, Holding, Task};
use base::IdVec;
use kernel::{SlotId, Values};
use solve::Level;
use std::collections::BTreeSet;

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
    /// Plans what was not planned yet; after that, linear in the rules. Of a component in the state
    /// that opening it came to, of which there was nothing to tell before, that is known.
    pub fn status(&mut self, model: Model<'_>, values: &Values, host: &mut dyn Host) -> Status {
        let structure = model.structure;
        self.plan_resting(structure);
        let tasks = self.take_resting();
        let is_quiet: Vec<bool> =
            (0..).zip(&tasks).map(|(i, task)| self.is_quiet(i, task, values)).collect();
        let mut tells = vec![true; self.rules.len()];
        for (task, _) in tasks.iter().zip(&is_quiet).filter(|(_, is_quiet)| **is_quiet) {
            task.component.rules().iter().for_each(|&r| tells[r as usize] = false);
        }
        let rules = (0..self.rules.len() as u32).filter(|&r| tells[r as usize]);
        let unmet = self.unmet(model, rules, values, host);
        let required = unmet.iter().filter(|u| u.level == Level::Required);
        let is_unmet: BTreeSet<Source> = required.map(|u| u.source).collect();
        let mut redundancy = Redundancy::default();
        for (i, task) in tasks.iter().enumerate().filter(|(i, _)| !is_quiet[*i]) {
            let found = self.redundant(model, task, values, &is_unmet, host);
            if matches!(&found, (redundant, 0) if redundant.is_empty())
                && let (Some(Some(came)), Some(plan)) = (self.came.get(i), task.number())
            {
                self.plans.past.note_quiet(*came, plan, task.numbers(&values.numbers));
            }
            redundancy.add(i, found);
        }
        let mut slots = IdVec::filled(SlotState::Fixed, structure.slots.len());
        let mut freedom = redundancy.theorem_motions();
        for (slot, s) in structure.slots.iter() {
            let lone = self.net.rules_of(slot).is_empty();
            if lone && Self::resting_hold(structure, slot) == Holding::Kept {
                slots[slot] = SlotState::Free;
                freedom += usize::from(s.primitive.is_number());
            }
        }
        for task in &tasks {
            let in_mode = task.by_values(self, model, values, host);
            let task = in_mode.as_ref().unwrap_or(task);
            if !matches!(task.course, Course::Search(_)) {
                freedom += task.plan.report.freedom;
            }
            for slot in task.movable() {
                slots[slot] = SlotState::Free;
            }
        }
        self.give_resting(tasks);
        for rule in self.rules.iter() {
            if rule.shape.level == Level::Required && is_unmet.contains(&rule.source) {
                rule.slots.iter().for_each(|&s| slots[s] = SlotState::Conflicting);
            }
        }
        Status {
            satisfied: unmet.iter().all(|u| u.level != Level::Required),
            freedom,
            unmet,
            redundant: redundancy.sorted().constraints,
            slots,
        }
    }

    /// Returns true if nothing was to be told of a component before, in this state.
    fn is_quiet(&self, index: usize, task: &Task, values: &Values) -> bool {
        let (Some(Some(came)), Some(plan)) = (self.came.get(index), task.number()) else {
            return false;
        };
        self.plans.past.is_quiet(*came, plan, task.numbers(&values.numbers))
    }
}
