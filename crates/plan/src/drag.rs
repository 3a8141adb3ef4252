//! Drags: planned once at the press, then followed wish by wish.

mod back;
mod course;

use crate::aim::Aim;
use crate::component::{Component, rules_of};
use crate::edit::{EditReport, NotDecided, RefusalReason, Target, note};
use crate::host::Host;
use crate::modal::{Acting, ModalDrag, ModeChange};
use crate::planner::{Latest, Model, Planner, is_any_new};
use crate::run::{
    Adapter, Ground, Ran, Texts, compute, leans, or_otherwise, put_texts, ran, scatter, searched,
};
use crate::task::restated::LETTING_GO;
use crate::task::{Course, Task};
use crate::vanish::{Together, vanished};
use kernel::{SlotId, Values};
use solve::{Level, PATIENCE, Puzzle, Rejected, SlotIndex, Stay, Verdict};
use std::rc::Rc;

/// What a drag keeps from the press to the release.
///
/// The result depends on the state at the press and the present wish, not on what came between.
#[derive(Debug)]
pub struct Press {
    aim: Aim,
    pulls: Vec<Pull>,
    /// The same on other courses of programs, where what is dragged is drawn by one.
    courses: Option<Box<course::Courses>>,
}

/// One component of a drag.
#[derive(Debug)]
struct Pull {
    task: Task,
    /// The task as it was planned, where whole numbers or pieces that were looked for put it into another mode.
    planned: Option<Box<Task>>,
    way: Way,
    /// The numbers at the press, by the slots of the system.
    x0: Vec<f64>,
    /// False until what the host computes at the press is known: it is asked at the first wish.
    is_begun: bool,
    /// The texts at the press that the drag may write.
    texts: Texts,
    targets: Vec<f64>,
    /// True once it was asked which of its rules others imply by a theorem.
    knows_theorems: bool,
    /// The task as it is with these, where it is followed without them.
    with_theorems: Option<Box<Task>>,
    /// True once it was asked which of its rules others imply at the press.
    knows_implied: bool,
    /// The same with the numbers let go that the plan holds, once a wish fell short; nothing where it holds none.
    free: Option<Option<Box<Pull>>>,
    /// The same with places kept apart, once some came together; nothing where it is another's.
    apart: Option<Option<Box<Pull>>>,
    /// What it came to itself, while that is shown.
    short: Option<(Vec<f64>, Texts)>,
}

/// How a component follows a drag.
#[derive(Debug)]
enum Way {
    Plan(Box<solve::Drag>),
    Modes(Box<ModalDrag>),
    /// Searched anew from where it was at the press.
    Search(Rc<Puzzle>),
}

impl Press {
    /// Returns the slots that the drag depends on and cannot move, in order of their component.
    pub fn held(&self) -> Vec<SlotId> {
        let held = |pull: &Pull| {
            let slots = pull.task.component.slots().iter().zip(&pull.task.system.slots);
            let held = slots.filter(|(_, s)| s.stay == Stay::Fixed);
            held.map(|(&slot, _)| slot).collect::<Vec<_>>()
        };
        self.pulls.iter().flat_map(held).collect()
    }
    /// Returns the slots that the drag may change, and more: all that its targets are connected with.
    pub fn reach(&self) -> impl Iterator<Item = SlotId> + '_ {
        self.pulls.iter().flat_map(|pull| pull.task.component.slots()).copied()
    }
    /// Returns what acts in the modes that stand.
    pub fn acting(&self, planner: &Planner) -> Vec<Acting> {
        self.pulls.iter().flat_map(|pull| pull.task.acting(planner)).collect()
    }
    /// Says what acts otherwise with these values than at the press.
    pub fn mode_changes(
        &self,
        planner: &Planner,
        model: Model<'_>,
        values: &Values,
        host: &mut dyn Host,
    ) -> Vec<ModeChange> {
        if self.pulls.iter().all(|p| !matches!(p.task.course, Course::Modes(..))) {
            return Vec::new();
        }
        let start = self.start(values);
        let changes = |pull: &Pull| pull.task.mode_changes(planner, model, &start, values, host);
        self.pulls.iter().flat_map(changes).collect()
    }
    /// Returns the values at the press, given those of now.
    fn start(&self, values: &Values) -> Values {
        let mut start = values.clone();
        for pull in &self.pulls {
            for (&slot, &x) in pull.task.component.slots().iter().zip(&pull.x0) {
                start.numbers[slot] = x;
            }
            put_texts(&pull.texts, &mut start);
        }
        start
    }
}

impl Planner {
    /// Presses on targets, to move them together.
    ///
    /// Cost: that of planning the components of the targets; where they were pressed not long ago, that of
    /// copying the state of these, and of testing it where no drag by their plan began or ended there.
    ///
    /// # Errors
    /// Why they cannot be moved at all.
    pub fn press(
        &mut self,
        model: Model<'_>,
        values: &Values,
        targets: &[Target<'_>],
    ) -> Result<Press, RefusalReason> {
        self.press_keeping(model, values, targets, &[])
    }

    /// Presses on targets, to move them together, while others stay where they are wished: below the move, as a
    /// `medium stay` does. The numbers of those follow the targets' in every wish.
    ///
    /// # Errors
    /// Why they cannot be moved at all.
    pub fn press_keeping(
        &mut self,
        model: Model<'_>,
        values: &Values,
        targets: &[Target<'_>],
        kept: &[Target<'_>],
    ) -> Result<Press, RefusalReason> {
        self.take_course(model, values);
        let aim = self.aim_keeping(model, (values, values), targets, kept)?;
        let mut press = self.press_aim(model, values, aim);
        press.courses = self.courses(model.structure, &press.aim, (targets, kept), values);
        Ok(press)
    }

    pub(crate) fn press_aim(&mut self, model: Model<'_>, values: &Values, aim: Aim) -> Press {
        let tasks = self.plan_edit(model, &aim);
        self.latest =
            Latest { tasks: tasks.clone(), edited: Some(aim.slots()), ..Latest::default() };
        let pull = |task| self.pull(model, task, &aim, values);
        let pulls = tasks.into_iter().map(pull).collect();
        Press { aim, pulls, courses: None }
    }

    /// Follows the pointer: `wanted` are the targets' numbers, one after the other.
    ///
    /// The report says whether the wish is reached and what stands in its way; what changed is told
    /// at the release. Cost: what is downstream of the targets; that of asking once what is superfluous in
    /// their components, where a wish is not reached.
    ///
    /// # Panics
    /// If there are not as many numbers as were pressed.
    pub fn drag(
        &mut self,
        model: Model<'_>,
        press: &mut Press,
        values: &mut Values,
        wanted: &[f64],
        host: &mut dyn Host,
    ) -> EditReport {
        let whole = press.courses.as_ref().map(|courses| courses.wish(wanted));
        let goals = press.aim.wanted.iter_mut().flatten();
        let wished = whole.as_deref().unwrap_or(wanted);
        let count = goals.zip(wished).map(|(goal, &x)| *goal = x + 0.0).count();
        assert_eq!(count, wanted.len(), "a wish names every number that was pressed");
        let report = self.pull_all(model, press, values, host);
        match press.courses.take() {
            None => report,
            Some(mut courses) => {
                let report = self.on_courses(model, (press, &mut courses), values, report, host);
                press.courses = Some(courses);
                report
            }
        }
    }

    /// Makes every component follow what is wished.
    fn pull_all(
        &mut self,
        model: Model<'_>,
        press: &mut Press,
        values: &mut Values,
        host: &mut dyn Host,
    ) -> EditReport {
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
        let report = self.let_go(model, press, values, host);
        if report.refusal.is_some() {
            self.take_course(model, values);
        }
        report
    }

    fn let_go(
        &mut self,
        model: Model<'_>,
        press: Press,
        values: &mut Values,
        host: &mut dyn Host,
    ) -> EditReport {
        let mut press = press.on_its_course();
        let reached = self.reached(&press.aim, values);
        let mut report = EditReport { reached, ..EditReport::default() };
        let start = press.start(values);
        if !reached {
            self.step_back(model, &mut press, &start, values, host);
        }
        let aim = press.aim;
        self.latest.tasks = press.pulls.into_iter().map(Pull::end).collect();
        let components: Vec<Component> =
            self.latest.tasks.iter().map(|t| t.component.clone()).collect();
        if let Some(failure) = self.settle(model, &components, values, host) {
            *values = start;
            report.refusal = Some(RefusalReason::Method(failure));
            return report;
        }
        let rules = rules_of(&components);
        report.unmet = self.unmet(model, rules.iter().copied(), values, host);
        if !report.unmet.is_empty() {
            let was_unmet = self.unmet(model, rules, &start, host);
            if is_any_new(&report.unmet, &was_unmet) {
                *values = start;
                report.refusal = Some(RefusalReason::Unmet);
                return report;
            }
        }
        report.changed = values.changed(&start).collect();
        report.undecided = self.undecided(model, &self.latest.tasks, &aim, &start, values);
        report
    }

    fn pull(&self, model: Model<'_>, task: Task, aim: &Aim, values: &Values) -> Pull {
        let mut x0 = task.gather(&values.numbers);
        for &(known, wish, coordinate) in task.targets() {
            let formula = &aim.wishes[wish as usize].formulas[coordinate as usize];
            x0[known as usize] = formula.value(self.plans.patterns(), &values.numbers);
        }
        let (way, texts) = Way::of(&task, &x0, model, values);
        let targets = vec![0.0; task.targets().len()];
        let is_begun = task.computed().len() == 0;
        Pull {
            task,
            planned: None,
            way,
            x0,
            is_begun,
            texts,
            targets,
            knows_theorems: false,
            with_theorems: None,
            knows_implied: false,
            free: None,
            apart: None,
            short: None,
        }
    }
}

impl Way {
    /// Begins at the press; returns as well the texts there that the drag may write.
    fn of(task: &Task, x0: &[f64], model: Model<'_>, values: &Values) -> (Self, Texts) {
        let inputs: Vec<SlotIndex> = task.targets().iter().map(|t| t.0).collect();
        let slots = task.component.slots();
        let text = |slot: SlotId| (slot, values.texts.get(&slot).cloned());
        match &task.course {
            Course::Plan => {
                let mut drag = solve::Drag::begin(&task.plan, x0, &inputs);
                drag.lean(&task.plan, &leans(model, task));
                let texts = drag.texts().iter().map(|&t| text(slots[t as usize])).collect();
                (Self::Plan(Box::new(drag)), texts)
            }
            Course::Modes(modes, _) => {
                let texts = slots.iter().copied().filter(|s| values.texts.contains_key(s));
                let way = Self::Modes(Box::new(ModalDrag::begin(modes, x0.to_vec(), inputs)));
                (way, texts.map(text).collect())
            }
            Course::Search(puzzle) => (Self::Search(puzzle.clone()), Vec::new()),
        }
    }
}

impl Pull {
    fn follow(
        &mut self,
        planner: &mut Planner,
        model: Model<'_>,
        aim: &Aim,
        values: &mut Values,
        host: &mut dyn Host,
        report: &mut EditReport,
    ) -> bool {
        if let Some((numbers, texts)) = self.short.take() {
            scatter(&self.task, &numbers, values);
            put_texts(&texts, values);
        }
        for (target, &(_, wish, coordinate)) in self.targets.iter_mut().zip(self.task.targets()) {
            *target = aim.wanted[wish as usize][coordinate as usize];
        }
        if let Some(planned) = self.planned.take() {
            self.task = *planned;
        }
        if !std::mem::replace(&mut self.is_begun, true) {
            compute(planner, model, &self.task, values, host, &mut self.x0);
            (self.way, self.texts) = Way::of(&self.task, &self.x0, model, values);
        }
        if !std::mem::replace(&mut self.knows_theorems, true)
            && let Some(task) = planner.without_theorems(model, &self.task, values, host)
        {
            self.with_theorems = Some(Box::new(self.task.clone()));
            self.goes_by(task, model, values);
        }
        let targets = &self.targets;
        let drag = match &mut self.way {
            Way::Plan(drag) => drag,
            Way::Modes(drag) => {
                let ran = drag.follow(planner, model, &mut self.task, targets, values, host);
                return self.came_to(ran, planner, model, aim, values, host, report);
            }
            Way::Search(puzzle) => {
                let mut wanted = self.x0.clone();
                let known = self.task.targets().iter().zip(targets);
                known.for_each(|(&(known, ..), &target)| wanted[known as usize] = target);
                let verdict = puzzle.nearest(&self.x0, &wanted);
                if let Verdict::Found(found) = &verdict {
                    scatter(&self.task, found, values);
                }
                let ran = searched(&verdict);
                let falls_short = ran.falls_short();
                note(report, &mut self.task, ran);
                return !falls_short;
            }
        };
        let text = |&(slot, _): &(SlotId, _)| (slot, values.texts.get(&slot).cloned());
        let texts: Texts = self.texts.iter().map(text).collect();
        let mut adapter = Adapter { planner, model, task: &self.task, values, host };
        let outcome = drag.follow(&self.task.plan, targets, &mut adapter);
        if drag.is_cut() {
            report.not_decided = Some(NotDecided::Work(PATIENCE));
        }
        if !outcome.is_solved() {
            put_texts(&texts, values);
        }
        let now = drag.values();
        let slots = self.task.component.slots();
        let put = |local: SlotIndex| {
            if let Some(&slot) = slots.get(local as usize) {
                values.numbers[slot] = now[local as usize] + 0.0;
            }
        };
        match drag.moved() {
            Some(moved) => moved.iter().copied().for_each(put),
            None => self.task.plan.targets().for_each(put),
        }
        let patterns = planner.plans.patterns();
        let is_met = outcome.is_solved() && outcome.unmet.is_empty();
        let may_go_on = self.task.whole().is_some() || self.task.may_yield_in_pieces(patterns);
        if is_met && let Some(together) = self.together(planner, model, aim, values, host) {
            // what was met so is met otherwise, where something lets go or they stay apart
            if self.lets_go(planner, model, aim, values, host, report)
                || self.keeps_apart(&together, planner, model, aim, values, host, report)
            {
                return true;
            }
        }
        if is_met && !may_go_on {
            return true;
        }
        let ran = ran(planner, &self.task, &outcome);
        self.came_to(ran, planner, model, aim, values, host, report)
    }

    /// Notes what a wish came to by the plan at hand, and where it fell short what it comes to otherwise: with what
    /// others imply at the press left to the test, by other pieces or whole numbers, with numbers let go that the plan
    /// holds. Returns true if the wish is reached.
    #[expect(clippy::too_many_arguments, reason = "it is the second half of following")]
    fn came_to(
        &mut self,
        ran: Ran,
        planner: &mut Planner,
        model: Model<'_>,
        aim: &Aim,
        values: &mut Values,
        host: &mut dyn Host,
        report: &mut EditReport,
    ) -> bool {
        if ran.falls_short()
            && let Some(task) = self.with_theorems.take()
        {
            self.back(values);
            self.goes_by(*task, model, values);
            return self.follow(planner, model, aim, values, host, report);
        }
        if ran.falls_short()
            && let Some(task) = self.without_implied(planner, model, values, host)
        {
            self.back(values);
            self.goes_by(task, model, values);
            return self.follow(planner, model, aim, values, host, report);
        }
        let ran = self.or_otherwise(planner, model, ran, values, host);
        let is_reached = !ran.falls_short();
        if !is_reached && self.lets_go(planner, model, aim, values, host, report) {
            return true;
        }
        self.note(report, ran);
        is_reached
    }

    /// Returns the places that have come together so that rows hold by that, or may.
    fn together(
        &self,
        planner: &Planner,
        model: Model<'_>,
        aim: &Aim,
        values: &Values,
        host: &mut dyn Host,
    ) -> Option<Together> {
        let is_set = |slot: SlotId| aim.slots().contains(&slot);
        if self.task.component.slots().len() > LETTING_GO || !self.task.plan.speaks_of_bends() {
            return None;
        }
        vanished(planner, model, &self.task, (&self.x0, &is_set), values, host)
    }

    /// Follows another task from the press on, where it is.
    fn goes_by(&mut self, task: Task, model: Model<'_>, values: &Values) {
        (self.way, self.texts) = Way::of(&task, &self.x0, model, values);
        self.task = task;
    }

    /// Follows a wish that fell short with the numbers let go that the plan holds. Returns false where there are none
    /// or it falls short all the same; the values are then as they were.
    fn lets_go(
        &mut self,
        planner: &mut Planner,
        model: Model<'_>,
        aim: &Aim,
        values: &mut Values,
        host: &mut dyn Host,
        report: &mut EditReport,
    ) -> bool {
        if self.free.is_none() {
            let free = self.letting_go(planner, model, values);
            self.free = Some(free.map(Box::new));
        }
        let mut free = self.free.take().flatten();
        let is_reached = free
            .as_mut()
            .is_some_and(|free| self.goes_with(free, planner, model, aim, values, host, report));
        self.free = Some(free);
        is_reached
    }

    /// Follows a wish with these places as far apart as they were at the press. Returns false where it falls short
    /// so; the values are then as they were.
    #[expect(clippy::too_many_arguments, reason = "it follows as the others do")]
    fn keeps_apart(
        &mut self,
        together: &Together,
        planner: &mut Planner,
        model: Model<'_>,
        aim: &Aim,
        values: &mut Values,
        host: &mut dyn Host,
        report: &mut EditReport,
    ) -> bool {
        if self.apart.is_none() {
            let kept = self.task.kept_apart(&together.pairs, &planner.plans);
            let far = together.pairs.iter().map(|pair| pair.apart);
            let x0: Vec<f64> = self.x0.iter().copied().chain(far).collect();
            let kept = kept.map(|task| Box::new(self.with(task, x0, model, values)));
            self.apart = Some(kept);
        }
        let mut kept = self.apart.take().flatten();
        let is_reached = kept
            .as_mut()
            .is_some_and(|kept| self.goes_with(kept, planner, model, aim, values, host, report));
        self.apart = Some(kept);
        is_reached
    }

    /// Follows a wish as another drag of the same component does. Returns false where that falls short; the values
    /// are then as they were.
    #[expect(clippy::too_many_arguments, reason = "it follows as the others do")]
    fn goes_with(
        &mut self,
        other: &mut Self,
        planner: &mut Planner,
        model: Model<'_>,
        aim: &Aim,
        values: &mut Values,
        host: &mut dyn Host,
        report: &mut EditReport,
    ) -> bool {
        let numbers: Vec<f64> = self.task.numbers(&values.numbers).collect();
        let text = |(slot, _): &(SlotId, _)| (*slot, values.texts.get(slot).cloned());
        let texts: Texts = other.texts.iter().map(text).collect();
        let mut noted = EditReport::default();
        other.back(values);
        let is_reached = other.follow(planner, model, aim, values, host, &mut noted);
        if is_reached {
            other.shows(values);
            self.short = Some((numbers, texts));
            report.double_roots.append(&mut noted.double_roots);
        } else {
            scatter(&self.task, &numbers, values);
            put_texts(&texts, values);
        }
        is_reached
    }

    /// Puts all its numbers where they are to be seen.
    fn shows(&self, values: &mut Values) {
        if let Way::Plan(drag) = &self.way {
            scatter(&self.task, drag.values(), values);
        }
    }

    /// Puts back what was at the press.
    fn back(&self, values: &mut Values) {
        scatter(&self.task, &self.x0, values);
        put_texts(&self.texts, values);
    }

    /// Returns the same drag with the numbers let go that the plan holds; nothing where it holds none, or the wish
    /// falls short whatever they do.
    fn letting_go(&self, planner: &Planner, model: Model<'_>, values: &Values) -> Option<Self> {
        let relations = &self.task.system.relations;
        let is_wish = |r: &Rejected| relations[r.relation as usize].level == Level::Move;
        if self.task.plan.report.rejected.iter().any(is_wish) {
            return None;
        }
        let task = self.task.letting_go(&planner.plans)?;
        Some(self.with(task, self.x0.clone(), model, values))
    }

    /// Returns a drag of another task from the same press.
    fn with(&self, task: Task, x0: Vec<f64>, model: Model<'_>, values: &Values) -> Self {
        let mut press = values.clone();
        self.back(&mut press);
        let (way, texts) = Way::of(&task, &x0, model, &press);
        Self {
            task,
            planned: None,
            way,
            x0,
            is_begun: true,
            texts,
            targets: self.targets.clone(),
            knows_theorems: true,
            with_theorems: None,
            knows_implied: true,
            free: None,
            apart: Some(None),
            short: None,
        }
    }

    /// Returns the task with what others imply at the press left to the test.
    fn without_implied(
        &mut self,
        planner: &mut Planner,
        model: Model<'_>,
        values: &Values,
        host: &mut dyn Host,
    ) -> Option<Task> {
        if std::mem::replace(&mut self.knows_implied, true) {
            return None;
        }
        let mut press = values.clone();
        self.back(&mut press);
        planner.without_implied(model, &self.task, &press, host)
    }

    /// Ends the drag of a component; returns the task that stands.
    fn end(self) -> Task {
        if let Way::Plan(drag) = self.way {
            drag.end(&self.planned.as_deref().unwrap_or(&self.task).plan);
        }
        self.task
    }

    /// Adds what came of a wish; the next one is for the task as it was planned.
    fn note(&mut self, report: &mut EditReport, ran: Ran) {
        self.planned = ran.stands.is_some().then(|| Box::new(self.task.clone()));
        note(report, &mut self.task, ran);
    }

    /// Looks for other pieces of equations where the drag comes to no end on those at hand, or to others, and for
    /// whole numbers where it made none, both from where it began.
    fn or_otherwise(
        &self,
        planner: &Planner,
        model: Model<'_>,
        ran: Ran,
        values: &mut Values,
        host: &mut dyn Host,
    ) -> Ran {
        let is_reached = ran.is_solved && !ran.is_missed;
        let may_go_on = || self.task.may_yield_in_pieces(planner.plans.patterns());
        if is_reached && self.task.whole().is_none() && !may_go_on() {
            return ran;
        }
        let inputs: Vec<SlotIndex> = self.task.targets().iter().map(|t| t.0).collect();
        let mut local = self.x0.clone();
        inputs.iter().zip(&self.targets).for_each(|(&i, &target)| local[i as usize] = target);
        let (x0, texts) = (self.x0.clone(), self.texts.clone());
        let ground = Ground { x0, local, texts, changed: inputs };
        or_otherwise(planner, model, &self.task, &ground, ran, values, host)
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
    let press = planner.press_aim(model, values, aim);
    move_pressed(planner, model, (press, &wanted), values, host)
}

/// Moves what was pressed on to where it is wanted, and lets go.
pub(crate) fn move_pressed(
    planner: &mut Planner,
    model: Model<'_>,
    (mut press, wanted): (Press, &[f64]),
    values: &mut Values,
    host: &mut dyn Host,
) -> EditReport {
    let step = planner.drag(model, &mut press, values, wanted, host);
    if step.refusal.is_some() {
        *values = press.start(values);
        return EditReport { refusal: step.refusal, ..EditReport::default() };
    }
    let mut report = planner.release(model, press, values, host);
    report.conflicts = step.conflicts;
    report.courses = step.courses;
    report
}
