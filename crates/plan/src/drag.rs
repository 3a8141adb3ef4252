//! Drags: planned once at the press, then followed wish by wish.

use crate::aim::{Aim, with_present_values};
use crate::component::Component;
use crate::edit::{Conflict, EditKind, EditReport, RefusalReason, Target};
use crate::host::{Failure, Host};
use crate::planner::{Latest, Model, Planner};
use crate::run::{Adapter, ran};
use crate::task::Task;
use kernel::{SlotId, Values};
use std::collections::BTreeSet;
use std::sync::Arc;

/// A drag under way, from the press on.
///
/// The result depends on the state at the press and the present wish, not on what came between.
#[derive(Debug)]
pub struct Drag {
    aim: Aim,
    pulls: Vec<Pull>,
    start: Values,
}

/// One component of a drag.
#[derive(Debug)]
struct Pull {
    task: Task,
    drag: solve::Drag,
    /// The wish and coordinate of every input.
    inputs: Vec<(u32, u32)>,
    targets: Vec<f64>,
    /// The slots that the plan writes: of the system, and of the document.
    written: Vec<(u32, SlotId)>,
    texts: Vec<SlotId>,
}

/// Where a drag has got to.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct DragStep {
    /// True if every target is where it was wished.
    pub reached: bool,
    /// What stands in the way, if something does.
    pub conflicts: Vec<Conflict>,
    /// A method that could not be run.
    pub failure: Option<Failure>,
}

impl Planner {
    /// Presses on targets, to move them together.
    ///
    /// # Errors
    /// Why they cannot be moved at all.
    pub fn press(
        &mut self,
        model: Model<'_>,
        values: &Values,
        targets: &[Target<'_>],
        host: &mut dyn Host,
    ) -> Result<Drag, RefusalReason> {
        let targets = with_present_values(self, model, values, targets)?;
        let aim = self.aim(model, values, EditKind::Move, &targets)?;
        Ok(self.press_aim(model, values, aim, host))
    }

    pub(crate) fn press_aim(
        &mut self,
        model: Model<'_>,
        values: &Values,
        aim: Aim,
        host: &mut dyn Host,
    ) -> Drag {
        let tasks = self.plan_edit(model, &aim);
        self.latest = Latest { tasks: tasks.clone(), edited: Some(aim.slots()) };
        let mut start = values.clone();
        let pull = |task| self.pull(model, task, &aim, &mut start, host);
        let pulls = tasks.into_iter().map(pull).collect();
        Drag { aim, pulls, start: values.clone() }
    }

    fn pull(
        &self,
        model: Model<'_>,
        task: Task,
        aim: &Aim,
        start: &mut Values,
        host: &mut dyn Host,
    ) -> Pull {
        let mut x0 = task.gather(&start.numbers);
        for &(known, wish, coordinate) in &task.targets {
            let expression = aim.wishes[wish as usize].expressions[coordinate as usize];
            x0[known as usize] = self.arena.evaluate(expression, start.numbers.as_slice());
        }
        let known: Vec<u32> = task.targets.iter().map(|t| t.0).collect();
        let inputs: Vec<(u32, u32)> = task.targets.iter().map(|t| (t.1, t.2)).collect();
        let mut adapter = Adapter { planner: self, model, task: &task, values: start, host };
        let drag = solve::Drag::begin(&task.plan, &x0, &known, &mut adapter);
        let slots = &task.component.slots;
        let written: BTreeSet<u32> =
            task.plan.steps.iter().flat_map(|s| s.targets.iter().copied()).collect();
        let of = |i: u32| slots.get(i as usize).map(|&s| (i, s));
        let written = written.into_iter().filter_map(of).collect();
        let is_text = |s: &&SlotId| !model.structure.slots[**s].primitive.is_number();
        let texts = slots.iter().filter(is_text).copied().collect();
        let targets = vec![0.0; inputs.len()];
        Pull { drag, inputs, targets, written, texts, task }
    }
}

impl Drag {
    /// Follows the pointer: `wanted` has the values of each target, in their order.
    ///
    /// Cost: what is downstream of the targets.
    ///
    /// # Panics
    /// If `wanted` has not the targets and coordinates of the press.
    pub fn to(
        &mut self,
        planner: &Planner,
        model: Model<'_>,
        values: &mut Values,
        wanted: &[&[f64]],
        host: &mut dyn Host,
    ) -> DragStep {
        assert_eq!(wanted.len(), self.aim.wanted.len(), "a wish names every target");
        for (goal, wanted) in self.aim.wanted.iter_mut().zip(wanted) {
            goal.copy_from_slice(wanted);
        }
        let mut step = DragStep::default();
        for pull in &mut self.pulls {
            pull.follow(planner, model, &self.aim, values, host, &mut step);
        }
        step.reached = step.failure.is_none() && planner.reached(&self.aim, values);
        step
    }

    /// Ends the drag: the wish is withdrawn and soft constraints act again.
    pub fn end(
        self,
        planner: &mut Planner,
        model: Model<'_>,
        values: &mut Values,
        host: &mut dyn Host,
    ) -> EditReport {
        let mut report =
            EditReport { reached: planner.reached(&self.aim, values), ..Default::default() };
        let components: Vec<Component> =
            self.pulls.iter().map(|p| p.task.component.clone()).collect();
        if let Some(failure) = planner.settle(model, &components, values, host) {
            *values = self.start;
            report.refusal = Some(RefusalReason::Method(failure));
            return report;
        }
        let rules: BTreeSet<u32> =
            components.iter().flat_map(|c| c.rules.iter().copied()).collect();
        report.unmet = planner.unmet(model, rules, values, host);
        report.changed = values.changed(&self.start).collect();
        report
    }

    /// Takes the drag back: every value is as it was at the press.
    pub fn cancel(self, values: &mut Values) {
        *values = self.start;
    }
}

impl Pull {
    fn follow(
        &mut self,
        planner: &Planner,
        model: Model<'_>,
        aim: &Aim,
        values: &mut Values,
        host: &mut dyn Host,
        step: &mut DragStep,
    ) {
        for (target, &(wish, coordinate)) in self.targets.iter_mut().zip(&self.inputs) {
            *target = aim.wanted[wish as usize][coordinate as usize];
        }
        let texts: Vec<Option<Arc<str>>> =
            self.texts.iter().map(|&s| values.texts[s].clone()).collect();
        let mut adapter = Adapter { planner, model, task: &self.task, values, host };
        let outcome = self.drag.follow(&self.task.plan, &self.targets, &mut adapter);
        if !outcome.is_solved() {
            for (&slot, text) in self.texts.iter().zip(texts) {
                values.texts[slot] = text;
            }
        }
        let now = self.drag.values();
        for &(local, slot) in &self.written {
            values.numbers[slot] = now[local as usize] + 0.0;
        }
        if !outcome.is_solved() || !outcome.unmet.is_empty() {
            let ran = ran(planner, &self.task, &outcome);
            step.conflicts.extend(ran.conflicts);
            step.failure = step.failure.take().or(ran.failure);
        }
    }
}

/// Moves by a drag of one step, from press to release.
pub(crate) fn move_at_once(
    planner: &mut Planner,
    model: Model<'_>,
    values: &mut Values,
    aim: Aim,
    host: &mut dyn Host,
) -> EditReport {
    let wanted = aim.wanted.clone();
    let wanted: Vec<&[f64]> = wanted.iter().map(Vec::as_slice).collect();
    let mut drag = planner.press_aim(model, values, aim, host);
    let step = drag.to(planner, model, values, &wanted, host);
    if let Some(failure) = step.failure {
        drag.cancel(values);
        return EditReport { refusal: Some(RefusalReason::Method(failure)), ..Default::default() };
    }
    let mut report = drag.end(planner, model, values, host);
    report.conflicts = step.conflicts;
    report
}
