//! Trials: a part of the rules solved on its own, on a copy of the values.

use crate::aim::Aim;
use crate::component::Component;
use crate::host::Host;
use crate::modal::Stands;
use crate::planner::{Model, Planner};
use crate::run::{Adapter, Ran, ground, run, scatter};
use crate::task::{Course, Holding, Task, Wish};
use crate::vanish::vanished;
use base::scrambled;
use kernel::{SlotId, Values};
use std::collections::BTreeSet;

/// What planning costs, in multiplications a constraint, roughly.
const PLANNING: u64 = 30_000;

/// What a trial is about, besides its rules.
pub(crate) struct Setup<'t> {
    pub(crate) model: Model<'t>,
    /// What holds a slot.
    pub(crate) holding: &'t dyn Fn(SlotId) -> Holding,
    /// What is wanted of expressions; what it sets is in the values already.
    pub(crate) aim: &'t Aim,
}

/// How a trial came out.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Trial {
    /// Everything required holds.
    Holds,
    /// What depends on the others does not hold where they do, which is one place.
    Contradicts,
    /// No state was found in which everything required holds.
    NotFound,
}

impl Planner {
    /// Solves these rules from these values, every other rule left out. The plans are not kept.
    pub(crate) fn try_rules(
        &mut self,
        setup: &Setup<'_>,
        rules: &[u32],
        values: &mut Values,
        host: &mut dyn Host,
    ) -> Trial {
        self.try_rules_noting(setup, rules, values, &mut BTreeSet::new(), host)
    }

    /// Does the same, and notes which given numbers may yield in it.
    pub(crate) fn try_rules_noting(
        &mut self,
        setup: &Setup<'_>,
        rules: &[u32],
        values: &mut Values,
        yielding: &mut BTreeSet<SlotId>,
        host: &mut dyn Host,
    ) -> Trial {
        let mark = self.plans.mark();
        let tasks = self.tasks_of(setup, rules);
        let start = values.clone();
        let mut trial = Trial::Holds;
        for task in &tasks {
            let ran = run(self, setup.model, task, setup.aim, &start, values, host);
            let plan = ran.stands.as_ref().map_or(&task.plan, Stands::plan);
            let slots = task.component.slots();
            let yielded = plan.report.yielded.iter();
            yielding.extend(yielded.filter_map(|&s| slots.get(s as usize)));
            // by other roots of the others it may hold
            let is_sure = !plan.is_curved();
            trial = match ran {
                Ran { is_solved: true, .. } => trial,
                Ran { is_conflict: true, .. } if is_sure => Trial::Contradicts,
                Ran { .. } => Trial::NotFound,
            };
        }
        self.plans.forget_since(mark);
        trial
    }

    /// States these rules alone, and counts what planning them costs.
    pub(crate) fn tasks_of(&mut self, setup: &Setup<'_>, rules: &[u32]) -> Vec<Task> {
        let wished = setup.aim.wishes.iter().flat_map(Wish::slots);
        self.spend(PLANNING * rules.len() as u64);
        let slots: BTreeSet<SlotId> =
            rules.iter().flat_map(|&r| self.rules.get(r).slots.to_vec()).chain(wished).collect();
        let mut rules = rules.to_vec();
        rules.sort_unstable();
        let component = Component::of(rules, slots.into_iter().collect());
        let alike = std::mem::take(&mut self.alike);
        let structure = setup.model.structure;
        let components = vec![component];
        let tasks = self.tasks(structure, components, setup.holding, &setup.aim.wishes, None);
        self.alike = alike;
        tasks
    }

    /// Looks near these values for others with which these rules hold, everything moved at once; returns false
    /// where none were found, which is soon known and says little. Leaves the values with which they hold.
    pub(crate) fn try_at_once(
        &mut self,
        setup: &Setup<'_>,
        rules: &[u32],
        values: &mut Values,
        host: &mut dyn Host,
    ) -> bool {
        let mark = self.plans.mark();
        let tasks = self.tasks_of(setup, rules);
        let start = values.clone();
        let by_plan = || tasks.iter().filter(|task| matches!(task.course, Course::Plan));
        let mut is_near = true;
        for task in by_plan() {
            let mut ground = ground(self, task, setup.aim, &start, &start);
            ground.compute(self, setup.model, task, &start, host);
            let mut runner = self.take_runner(Vec::new());
            let mut adapter = Adapter { planner: self, model: setup.model, task, values, host };
            let found = solve::near(&task.plan, &mut runner, &ground.local, &mut adapter);
            self.put_back(runner);
            is_near &= found.is_some();
            if let Some(found) = found {
                scatter(task, &found, values);
            }
        }
        is_near = is_near && self.try_rules(setup, rules, values, host) == Trial::Holds;
        is_near &= by_plan().all(|task| {
            let before = ground(self, task, setup.aim, &start, &start).x0;
            vanished(self, setup.model, task, (&before, &|_| true), values, host).is_none()
        });
        self.plans.forget_since(mark);
        is_near
    }
}

/// Moves every number by a little of the extent, differently each: a start that is not special.
///
/// Given numbers too: what holds for these alone is no theorem. What has to be whole or is anchored
/// keeps its value.
pub(crate) fn perturbed(model: Model<'_>, slots: &[SlotId], values: &Values) -> Values {
    perturbed_by(1.0 / 128.0, 0, model, slots, values)
}

/// Does the same by this part of the extent, differently with every seed.
pub(crate) fn perturbed_by(
    part: f64,
    seed: u32,
    model: Model<'_>,
    slots: &[SlotId],
    values: &Values,
) -> Values {
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
        if slot.primitive.is_number() && !slot.primitive.is_whole() && !slot.anchored {
            moved.numbers[s] += extent(slot.primitive) * part * scattered(s.0 ^ seed << 24);
        }
    }
    moved
}

/// Returns a number between -1 and 1, away from 0, that depends on `seed` alone.
pub(crate) fn scattered(seed: u32) -> f64 {
    let z = scrambled(u64::from(seed));
    let unit = (z >> 11) as f64 / (1u64 << 53) as f64;
    let size = 0.25 + 0.75 * unit;
    if z & 1 == 1 { -size } else { size }
}
