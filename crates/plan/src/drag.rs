//! Drags: planned once at the press, then followed wish by wish.

use crate::aim::{Aim, with_present_values};
use crate::component::Component;
use crate::edit::{EditKind, EditReport, RefusalReason, Target, note};
use crate::host::Host;
use crate::modal::{Acting, ModalDrag, ModeChange};
use crate::planner::{Latest, Model, Planner};
use crate::run::{Adapter, ran, scatter, searched};
use crate::task::{Course, Task};
use kernel::{SlotId, Values};
use solve::{Puzzle, Stay, Verdict};
use std::collections::BTreeSet;
use std::rc::Rc;
use std::sync::Arc;

/// What a drag keeps from the press to the release.
///
/// The result depends on the state at the press and the present wish, not on what came between.
#[derive(Debug)]
pub struct Press {
    aim: Aim,
    pulls: Vec<Pull>,
    start: Values,
}

/// One component of a drag.
#[derive(Debug)]
struct Pull {
    task: Task,
    way: Way,
    /// The wish and coordinate of every input.
    inputs: Vec<(u32, u32)>,
    targets: Vec<f64>,
    /// The slots that the plan writes: of the system, and of the document.
    written: Vec<(u32, SlotId)>,
    texts: Vec<SlotId>,
}

/// How a component follows a drag.
#[derive(Debug)]
enum Way {
    Plan(Box<solve::Drag>),
    Modes(ModalDrag),
    /// Searched anew from where it was at the press.
    Search(Rc<Puzzle>, Vec<f64>, Vec<u32>),
}

impl Press {
    /// Returns the slots that the drag depends on and cannot move, in order of their component.
    pub fn held(&self) -> Vec<SlotId> {
        let held = |pull: &Pull| {
            let slots = pull.task.component.slots.iter().zip(&pull.task.system.slots);
            let held = slots.filter(|(_, s)| s.stay == Stay::Fixed);
            held.map(|(&slot, _)| slot).collect::<Vec<_>>()
        };
        self.pulls.iter().flat_map(held).collect()
    }
    /// Returns what acts in the modes that stand.
    pub fn acting(&self, planner: &Planner) -> Vec<Acting> {
        self.pulls.iter().flat_map(|pull| pull.task.acting(planner)).collect()
    }
    /// Says what acts otherwise with these values than at the press.
    pub fn mode_changes(&self, planner: &Planner, values: &Values) -> Vec<ModeChange> {
        let changes = |pull: &Pull| pull.task.mode_changes(planner, &self.start, values);
        self.pulls.iter().flat_map(changes).collect()
    }
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
    ) -> Result<Press, RefusalReason> {
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
    ) -> Press {
        let tasks = self.plan_edit(model, &aim);
        self.latest = Latest { tasks: tasks.clone(), edited: Some(aim.slots()) };
        let mut start = values.clone();
        let pull = |task| self.pull(model, task, &aim, &mut start, host);
        let pulls = tasks.into_iter().map(pull).collect();
        Press { aim, pulls, start: values.clone() }
    }

    /// Follows the pointer: `wanted` are the targets' numbers, one after the other.
    ///
    /// The report says whether the wish is reached and what stands in its way; what changed is told
    /// at the release. Cost: what is downstream of the targets.
    ///
    /// # Panics
    /// If there are not as many numbers as were pressed.
    pub fn drag(
        &self,
        model: Model<'_>,
        press: &mut Press,
        values: &mut Values,
        wanted: &[f64],
        host: &mut dyn Host,
    ) -> EditReport {
        let goals = press.aim.wanted.iter_mut().flatten();
        let count = goals.zip(wanted).map(|(goal, &x)| *goal = x + 0.0).count();
        assert_eq!(count, wanted.len(), "a wish names every number that was pressed");
        let mut report = EditReport::default();
        for pull in &mut press.pulls {
            pull.follow(self, model, &press.aim, values, host, &mut report);
        }
        report.reached = report.refusal.is_none() && self.reached(&press.aim, values);
        report
    }

    /// Ends a drag: the wish is withdrawn and soft constraints act again.
    ///
    /// Where that fails, everything is as it was at the press.
    pub fn release(
        &mut self,
        model: Model<'_>,
        press: Press,
        values: &mut Values,
        host: &mut dyn Host,
    ) -> EditReport {
        let reached = self.reached(&press.aim, values);
        self.latest.tasks = press.pulls.iter().map(|p| p.task.clone()).collect();
        let mut report = EditReport { reached, ..EditReport::default() };
        let components: Vec<Rc<Component>> =
            press.pulls.iter().map(|p| p.task.component.clone()).collect();
        if let Some(failure) = self.settle(model, &components, values, host) {
            *values = press.start;
            report.refusal = Some(RefusalReason::Method(failure));
            return report;
        }
        let rules: BTreeSet<u32> =
            components.iter().flat_map(|c| c.rules.iter().copied()).collect();
        report.unmet = self.unmet(model, rules.iter().copied(), values, host);
        let was_unmet = self.unmet(model, rules, &press.start, host);
        if report.unmet.iter().any(|u| u.is_new(&was_unmet)) {
            *values = press.start;
            report.refusal = Some(RefusalReason::Unmet);
            return report;
        }
        report.changed = values.changed(&press.start).collect();
        report
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
        for &(known, wish, coordinate) in task.targets() {
            let formula = &aim.wishes[wish as usize].formulas[coordinate as usize];
            x0[known as usize] = formula.value(self.plans.patterns(), &start.numbers);
        }
        let known: Vec<u32> = task.targets().iter().map(|t| t.0).collect();
        let inputs: Vec<(u32, u32)> = task.targets().iter().map(|t| (t.1, t.2)).collect();
        let way = match &task.course {
            Course::Plan => {
                let mut adapter =
                    Adapter { planner: self, model, task: &task, values: start, host };
                Way::Plan(Box::new(solve::Drag::begin(&task.plan, &x0, &known, &mut adapter)))
            }
            Course::Modes(modes, _) => Way::Modes(ModalDrag::begin(modes, x0, known)),
            Course::Search(puzzle) => Way::Search(puzzle.clone(), x0, known),
        };
        let slots = &task.component.slots;
        let written: BTreeSet<u32> =
            task.plan.steps.iter().flat_map(|s| s.targets.iter().copied()).collect();
        let of = |i: u32| slots.get(i as usize).map(|&s| (i, s));
        let written = written.into_iter().filter_map(of).collect();
        let is_text = |s: &&SlotId| !model.structure.slots[**s].primitive.is_number();
        let texts = slots.iter().filter(is_text).copied().collect();
        let targets = vec![0.0; inputs.len()];
        Pull { way, inputs, targets, written, texts, task }
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
        report: &mut EditReport,
    ) {
        for (target, &(wish, coordinate)) in self.targets.iter_mut().zip(&self.inputs) {
            *target = aim.wanted[wish as usize][coordinate as usize];
        }
        let targets = &self.targets;
        let drag = match &mut self.way {
            Way::Plan(drag) => drag,
            Way::Modes(drag) => {
                let ran = drag.follow(planner, model, &mut self.task, targets, values, host);
                return note(report, &mut self.task, ran);
            }
            Way::Search(puzzle, x0, known) => {
                let mut wanted = x0.clone();
                known.iter().zip(targets).for_each(|(&k, &t)| wanted[k as usize] = t);
                let verdict = puzzle.nearest(x0, &wanted);
                if let Verdict::Found(found) = &verdict {
                    scatter(&self.task, found, values);
                }
                return note(report, &mut self.task, searched(&verdict));
            }
        };
        let texts: Vec<Option<Arc<str>>> =
            self.texts.iter().map(|s| values.texts.get(s).cloned()).collect();
        let mut adapter = Adapter { planner, model, task: &self.task, values, host };
        let outcome = drag.follow(&self.task.plan, targets, &mut adapter);
        if !outcome.is_solved() {
            for (&slot, text) in self.texts.iter().zip(texts) {
                match text {
                    Some(text) => values.texts.insert(slot, text),
                    None => values.texts.remove(&slot),
                };
            }
        }
        let now = drag.values();
        match drag.moved() {
            Some(moved) => {
                for &local in moved {
                    if let Some(&slot) = self.task.component.slots.get(local as usize) {
                        values.numbers[slot] = now[local as usize] + 0.0;
                    }
                }
            }
            None => {
                for &(local, slot) in &self.written {
                    values.numbers[slot] = now[local as usize] + 0.0;
                }
            }
        }
        if !outcome.is_solved() || !outcome.unmet.is_empty() {
            let ran = ran(planner, &self.task, &outcome);
            note(report, &mut self.task, ran);
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
    let wanted = aim.wanted.concat();
    let mut press = planner.press_aim(model, values, aim, host);
    let step = planner.drag(model, &mut press, values, &wanted, host);
    if step.refusal.is_some() {
        *values = press.start;
        return EditReport { refusal: step.refusal, ..EditReport::default() };
    }
    let mut report = planner.release(model, press, values, host);
    report.conflicts = step.conflicts;
    report
}
