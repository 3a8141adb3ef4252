//! Status: what holds, what can still move.

use crate::host::Host;
use crate::planner::{Model, Planner, Unmet};
use crate::rule::Source;
use crate::task::{Course, Holding, Task};
use base::IdVec;
use kernel::{SlotId, Values};
use solve::{Giver, Level};
use std::collections::BTreeSet;

/// The state of a document at rest.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Status {
    /// True if every required constraint holds.
    pub satisfied: bool,
    /// In how many independent ways the numbers can still move, given numbers and anchors held; what is of layout
    /// alone is not counted. Where constraints follow from others by a theorem, there are `more`.
    pub freedom: usize,
    /// How many more there are, where it is seen without solving anything that there are none, or once
    /// [`Planner::surplus`] has told.
    pub more: Option<usize>,
    /// The constraints of any strength that do not hold, in order of declaration.
    pub unmet: Vec<Unmet>,
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
    /// that opening it came to, of which there was nothing to tell before, that is known. Nothing is solved: what
    /// constraints follow from others is asked by [`Planner::surplus`].
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
        let mut may_be_more = false;
        for (i, task) in tasks.iter().enumerate().filter(|(i, _)| !is_quiet[*i]) {
            // of what fails that is to be told, and nothing else
            if self.fails(task, &is_unmet) {
                continue;
            }
            if self.may_follow(model, task, values, &is_unmet, host) {
                may_be_more |= !task.is_of_layout(structure);
            } else if let (Some(Some(came)), Some(plan)) = (self.came.get(i), task.number()) {
                self.plans.past.note_quiet(*came, plan, task.numbers(&values.numbers));
            }
        }
        let mut slots = IdVec::filled(SlotState::Fixed, structure.slots.len());
        let mut freedom = 0;
        for (slot, s) in structure.slots.iter() {
            let lone = self.net.rules_of(slot).is_empty();
            if lone && Self::resting_hold(structure, slot) == Holding::Kept {
                slots[slot] = SlotState::Free;
                freedom += usize::from(s.primitive.is_number() && !s.is_layout);
            }
        }
        for task in &tasks {
            let in_mode = task.by_values(self, model, values, host);
            let task = in_mode.as_ref().unwrap_or(task);
            if !task.is_of_layout(structure) && !matches!(task.course, Course::Search(_)) {
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
            more: (!may_be_more).then_some(0),
            unmet,
            slots,
        }
    }

    /// Returns the numbers that are arbitrary: neither given, nor copied, nor determined by constraints and by all that is
    /// given, the places that are given as well. Layout is arbitrary by its nature and none of them.
    ///
    /// Plans what speaks of a number that is not given once more. Changes nothing.
    pub fn arbitrary(
        &mut self,
        model: Model<'_>,
        values: &Values,
        host: &mut dyn Host,
    ) -> BTreeSet<SlotId> {
        let structure = model.structure;
        let is_given = |slot: SlotId| {
            structure.slots[slot].given.is_some() || structure.copied.contains_key(&slot)
        };
        let is_asked = |slot: SlotId| {
            let s = &structure.slots[slot];
            !is_given(slot) && !s.anchored && !s.is_layout && s.primitive.is_number()
        };
        let lone = |&slot: &SlotId| is_asked(slot) && self.net.rules_of(slot).is_empty();
        let mut found: BTreeSet<SlotId> = structure.slots.ids().filter(lone).collect();
        let mut components = self.whole(structure).components.clone();
        components.retain(|component| component.slots().iter().any(|&s| is_asked(s)));
        let holding = |slot: SlotId| match Self::resting_hold(structure, slot) {
            Holding::Kept if is_given(slot) => Holding::Given(Giver::Document),
            held => held,
        };
        for task in self.tasks(structure, components, &holding, &[], None) {
            let in_mode = task.by_values(self, model, values, host);
            let task = in_mode.as_ref().unwrap_or(&task);
            // whole numbers are searched for, nearest to where they are
            if matches!(task.course, Course::Search(_)) || task.plan.report.freedom == 0 {
                continue;
            }
            let could: BTreeSet<SlotId> = task.movable().filter(|&s| is_asked(s)).collect();
            if !could.is_empty() {
                let moves = |s: &SlotId| {
                    structure.slots[*s].primitive.is_number()
                        && !matches!(holding(*s), Holding::Given(_) | Holding::Fixed)
                };
                let moving = self.moving(model, task, values, &moves, host);
                found.extend(moving.into_iter().filter(|s| could.contains(s)));
            }
        }
        found
    }

    /// Returns true if no constraint speaks of a number.
    pub fn is_lone(&self, slot: SlotId) -> bool {
        self.net.rules_of(slot).is_empty()
    }

    /// Returns the numbers that hang together with one of these by constraints, in order.
    pub fn connected(&mut self, model: Model<'_>, slots: &BTreeSet<SlotId>) -> Vec<SlotId> {
        let components = self.resting_around(model.structure, slots, &[]);
        let mut found: Vec<SlotId> = components.iter().flat_map(|c| c.slots().to_vec()).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Returns true if nothing was to be told of a component before, in this state.
    fn is_quiet(&self, index: usize, task: &Task, values: &Values) -> bool {
        let (Some(Some(came)), Some(plan)) = (self.came.get(index), task.number()) else {
            return false;
        };
        self.plans.past.is_quiet(*came, plan, task.numbers(&values.numbers))
    }
}
