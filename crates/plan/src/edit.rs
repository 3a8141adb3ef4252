//! Edits: opening a document, setting values, moving parts; and what came of it.

use crate::aim::{Aim, nearest, storable};
use crate::component::{Component, rules_of};
use crate::course::{CourseChange, Guard};
use crate::diagnose::trial::Setup;
use crate::drag::{move_at_once, move_pressed};
use crate::host::{Failure, Host};
use crate::limit::Limit;
use crate::past::CameId;
use crate::planner::{Latest, Model, Planner, Unmet, is_any_new};
use crate::rule::Source;
use crate::run::{Ran, run, scatter};
use crate::task::{Holding, Task, Wish};
use base::IdVec;
use base::number::Toward;
use kernel::{SlotId, Term, ThingId, Value, Values};
use solve::Level;
use std::collections::BTreeSet;

/// An edit that took so many multiplications is not tried again in parts to say why it is refused: a refusal
/// is wanted at once.
const DEAR: u64 = 500_000_000;

/// So many courses of programs are tried.
const COURSES: usize = 8;

/// What an edit is about.
#[derive(Clone, Copy, Debug)]
pub enum Target<'a> {
    /// A stored part: a number, a text, a place, any thing.
    Thing(ThingId),
    /// A virtual part, or any expression of numbers, of a thing.
    Term {
        /// What is `Me` in it.
        me: ThingId,
        /// The expression.
        term: &'a Term,
    },
}

/// How an edit wants its targets.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum EditKind {
    /// Required for this edit; lifts the anchor of exactly what it sets.
    Set,
    /// A wish; never lifts an anchor.
    Move,
}

/// What came of an edit.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct EditReport {
    /// Why nothing was changed; nothing if the edit was made.
    pub refusal: Option<RefusalReason>,
    /// The slots whose values differ in any bit, in order.
    pub changed: Vec<SlotId>,
    /// The constraints around what changed that do not hold (in a refused edit: that would not have).
    pub unmet: Vec<Unmet>,
    /// What stood against what: a rule that could not be had, and the rules that it depends on.
    pub conflicts: Vec<Conflict>,
    /// True if every target has the value that was wanted.
    pub reached: bool,
    /// Which way slots go whose values, as the edit left them, do not say on which of two branches.
    pub undecided: Vec<(SlotId, Toward)>,
    /// How far towards these values a refused edit could have gone.
    pub limit: Option<Limit>,
    /// Slots where two solutions coincide: their values are known to half the digits only.
    pub double_roots: Vec<SlotId>,
    /// Where a solution was looked for in vain and not to the end.
    pub not_decided: Option<NotDecided>,
    /// The courses that programs take otherwise than before; where a drag stops, that they would have to take.
    pub courses: Vec<CourseChange>,
}

/// A search that was given up: there may be a solution, and there may be none.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NotDecided {
    /// After so many states of whole numbers.
    Search(u64),
    /// After methods in a ring had run once round.
    Round,
    /// After so many modes.
    Modes(u64),
    /// After so many ways to choose among the roots of equations.
    Roots(u64),
    /// After so many choices of whole numbers among real unknowns.
    Whole(u64),
    /// After so much work, in multiplications.
    Work(u64),
}

/// Why an edit changed nothing.
#[derive(Clone, PartialEq, Debug)]
pub enum RefusalReason {
    /// Required constraints would not hold.
    Unmet,
    /// Whether they can hold was not decided.
    NotDecided(NotDecided),
    /// A whole number would leave its domain.
    OutOfRange(SlotId),
    /// An anchor holds this slot.
    Anchored(SlotId),
    /// A written method failed.
    Method(Failure),
    /// Of the courses that programs could take none holds: what they would do otherwise.
    Course(Vec<CourseChange>),
    /// The values do not fit the target, or it cannot be edited.
    Target(String),
}

/// A rule that could not be accepted, and the others that it depends on.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Conflict {
    /// The rule.
    pub source: Source,
    /// Rules that were accepted before it; with them it is a minimal dependent set.
    pub circuit: Vec<Source>,
}

impl Planner {
    /// Opens a document: given values are taken from the host, the others are what rules make them.
    ///
    /// `values` are overwritten. Rules that cannot hold are reported; nothing is refused.
    pub fn open(
        &mut self,
        model: Model<'_>,
        values: &mut Values,
        host: &mut dyn Host,
    ) -> EditReport {
        let mut report = self.open_once(model, values, host);
        for _ in 0..COURSES {
            if !self.take_course_at(model, values) {
                return report;
            }
            report = self.open_once(model, values, host);
        }
        if self.take_course_at(model, values) {
            // which course holds is not found: what programs draw, and what speaks of as many as a value says, is
            // tested, and nothing follows from it
            let tried = self.lowering.clone();
            self.lower_on(model, None);
            report = self.open_once(model, values, host);
            let patterns = self.plans.patterns();
            let decided = tried.guards.iter().map(|guard| guard.decided_at(patterns, values));
            let decided = decided.collect();
            self.note_unsettled(decided);
        }
        report
    }

    fn open_once(
        &mut self,
        model: Model<'_>,
        values: &mut Values,
        host: &mut dyn Host,
    ) -> EditReport {
        let n = model.structure.slots.len();
        *values = Values::new(n);
        let mut has_value: IdVec<SlotId, bool> = IdVec::filled(false, n);
        for (slot, s) in model.structure.slots.iter() {
            if s.primitive.is_number() {
                continue;
            }
            values.put(slot, Value::Text("".into()));
        }
        for (&slot, &(low, high)) in &model.structure.ranges {
            values.put(slot, Value::Number(0.0_f64.clamp(low as f64, high as f64)));
        }
        for slot in model.structure.slots.ids() {
            let given = host.given(slot, values);
            // a whole number that may not be so is the nearest that may
            let given = given.map(|value| nearest(model, slot, &value).unwrap_or(value));
            if let Some(value) = given.filter(|v| storable(model, slot, v)) {
                values.put(slot, value);
                has_value[slot] = true;
            }
        }
        crate::sides::begin(model, &has_value, values);
        let holding = |slot: SlotId| {
            match Self::resting_hold(model.structure, slot) {
                resting if has_value[slot] => resting,
                // an anchor holds zero unless rules make it another
                Holding::Fixed => Holding::Kept,
                Holding::Given(_) | Holding::Kept | Holding::Alone | Holding::Free => Holding::Free,
            }
        };
        let slots = model.structure.slots.iter();
        // an anchor holds what it has; where that is nothing yet, rules may give it a value
        let are_anchors_given = slots.filter(|(_, s)| s.anchored).all(|(id, _)| has_value[id]);
        let components = if are_anchors_given {
            self.whole(model.structure).components.clone()
        } else {
            self.net.all(&self.rules, |s| holding(s) == Holding::Fixed).components
        };
        let mut tasks = self.tasks(model.structure, components, &holding, &[], None);
        let mut report = EditReport { reached: true, ..EditReport::default() };
        let before = values.clone();
        self.plans.past.begin();
        self.given_up.clear();
        let mut is_known = vec![false; self.rules.len()];
        let mut came = Vec::with_capacity(tasks.len());
        let mut local = Vec::new();
        for task in &mut tasks {
            let known = self
                .recalled(task, &before, values, &mut local)
                .or_else(|| self.came_now(model, task, &before, values, &mut report, host));
            if known.is_some() {
                task.component.rules().iter().for_each(|&r| is_known[r as usize] = true);
            }
            came.push(known);
        }
        let others = (0..self.rules.len() as u32).filter(|&r| !is_known[r as usize]);
        report.unmet = self.unmet(model, others, values, host);
        report.changed = values.changed(&before).collect();
        self.latest = Latest { tasks, ..Latest::default() };
        self.came = if are_anchors_given { came } else { Vec::new() };
        report
    }

    /// Puts into the slots of a task of an opening what came of it before, if that is known, and returns
    /// where it is kept. What `local` holds is overwritten.
    fn recalled(
        &mut self,
        task: &Task,
        before: &Values,
        values: &mut Values,
        local: &mut Vec<f64>,
    ) -> Option<CameId> {
        let plan = task.number().filter(|_| !self.plans.past.is_empty())?;
        task.gather_into(&before.numbers, local);
        let came = self.plans.past.recall(plan, &task.system.slots, local)?;
        scatter(task, local, values);
        Some(came)
    }

    /// Runs a task of an opening. Returns where is kept what came of it, if nothing is to be told of it
    /// but its values: all its rules hold.
    fn came_now(
        &mut self,
        model: Model<'_>,
        task: &mut Task,
        before: &Values,
        values: &mut Values,
        report: &mut EditReport,
        host: &mut dyn Host,
    ) -> Option<CameId> {
        let ran = run(self, model, task, &Aim::default(), before, values, host);
        let is_plain = ran.is_solved && ran.is_met && ran.double_roots.is_empty();
        if let Some(bound) = ran.not_decided {
            self.given_up.push((task.component.clone(), bound));
        }
        note(report, task, ran);
        let plan = task.number().filter(|_| is_plain)?;
        let began = task.gather(&before.numbers);
        let mut local = began.clone();
        local.iter_mut().zip(task.numbers(&values.numbers)).for_each(|(x, now)| *x = now);
        Some(self.plans.past.keep(plan, &task.system.slots, &began, &local))
    }

    /// Makes the constraints hold from these values, with nothing edited: given numbers hold, places
    /// move as little as they can. Returns true if every required one could be had.
    ///
    /// Plans what was not planned yet; after that it is numbers only.
    pub fn satisfy(&mut self, model: Model<'_>, values: &mut Values, host: &mut dyn Host) -> bool {
        self.satisfy_where(model, |_| true, values, host)
    }

    /// Makes the constraints hold from these values as [`Self::satisfy`] does, but only in components in which
    /// some are others than in a state that is `known`.
    pub fn satisfy_since(
        &mut self,
        model: Model<'_>,
        known: &Values,
        values: &mut Values,
        host: &mut dyn Host,
    ) -> bool {
        let changed: BTreeSet<SlotId> = values.changed(known).collect();
        let is_other = |task: &Task| task.component.slots().iter().any(|s| changed.contains(s));
        self.satisfy_where(model, is_other, values, host)
    }

    pub(crate) fn satisfy_where(
        &mut self,
        model: Model<'_>,
        counts: impl Fn(&Task) -> bool,
        values: &mut Values,
        host: &mut dyn Host,
    ) -> bool {
        self.plan_resting(model.structure);
        let start = values.clone();
        let aim = Aim::default();
        let mut is_solved = true;
        for task in self.resting().iter().filter(|task| counts(task)) {
            is_solved &= run_or_stay(self, model, task, &aim, &start, values, host).is_solved;
        }
        is_solved
    }

    /// Sets or moves targets, each to its values in order, as one edit.
    ///
    /// A refused edit leaves every bit as it was. A move that cannot reach its target comes as near
    /// as it can and says so; when it has ended, soft constraints act again. Where a program would take another course,
    /// the edit is solved on that one; a move for which none holds goes as far as one does.
    pub fn edit(
        &mut self,
        model: Model<'_>,
        values: &mut Values,
        kind: EditKind,
        targets: &[(Target<'_>, Vec<Value>)],
        host: &mut dyn Host,
    ) -> EditReport {
        self.take_course(model, values);
        let start = values.clone();
        let report = self.edit_from(model, (&start, values), kind, targets, host);
        if report.refusal.is_some() {
            // the rules are on the course of what stays
            self.take_course(model, &start);
        }
        report
    }

    fn edit_from(
        &mut self,
        model: Model<'_>,
        (start, values): (&Values, &mut Values),
        kind: EditKind,
        targets: &[(Target<'_>, Vec<Value>)],
        host: &mut dyn Host,
    ) -> EditReport {
        let began = self.lowering.clone();
        let (mut on, mut first) = (start.clone(), None);
        let mut tried = Vec::new();
        loop {
            let aim = match self.aim(model, (start, &on), kind, targets) {
                Ok(aim) => aim,
                Err(refusal) => return refused(refusal),
            };
            let guards = [&aim.guards[..], &self.lowering.guards].concat();
            let edited = aim.slots();
            let report = match kind {
                EditKind::Move => move_at_once(self, model, values, aim, host),
                EditKind::Set => self.set(model, values, &aim, host),
            };
            let is_moved_on = kind == EditKind::Move && !tried.is_empty();
            if is_moved_on && (report.refusal.is_some() || self.is_faulty_beside(&began)) {
                values.clone_from(start);
                return self.move_on_course(model, values, targets, host);
            }
            if report.refusal.is_some() {
                return report;
            }
            let first: &[Guard] = first.get_or_insert_with(|| guards.clone());
            if self.is_on_course(&guards, values) {
                let mut courses = self.course_changes(model, first, (start, values));
                courses.retain(|change| !change.is_of(model.structure, &edited));
                return EditReport { courses, ..report };
            }
            let changes = self.course_changes(model, &guards, (start, values));
            let decided = self.decided_at(&guards, values);
            on.clone_from(values);
            values.clone_from(start);
            if tried.len() == COURSES || tried.contains(&decided) {
                return match kind {
                    EditKind::Move => self.move_on_course(model, values, targets, host),
                    EditKind::Set => refused(RefusalReason::Course(changes)),
                };
            }
            tried.push(decided);
            self.take_course(model, &on);
        }
    }

    /// Moves targets as a hand does, which stops where the course of a program ends.
    fn move_on_course(
        &mut self,
        model: Model<'_>,
        values: &mut Values,
        targets: &[(Target<'_>, Vec<Value>)],
        host: &mut dyn Host,
    ) -> EditReport {
        let handles: Vec<Target<'_>> = targets.iter().map(|(target, _)| *target).collect();
        let pressed = self.press(model, values, &handles);
        let aim = self.aim(model, (values, values), EditKind::Move, targets);
        match (pressed, aim) {
            (Ok(press), Ok(aim)) => {
                let wanted = aim.wanted.concat();
                move_pressed(self, model, (press, &wanted), values, host)
            }
            (Err(refusal), _) | (_, Err(refusal)) => refused(refusal),
        }
    }

    fn set(
        &mut self,
        model: Model<'_>,
        values: &mut Values,
        aim: &Aim,
        host: &mut dyn Host,
    ) -> EditReport {
        let mut wanted = values.clone();
        for (&slot, value) in &aim.fixed {
            wanted.put(slot, value.clone());
        }
        let mut scratch = wanted.clone();
        let mut tasks = self.plan_edit(model, aim);
        let mut report = EditReport::default();
        let began = self.spent();
        for task in &mut tasks {
            let ran = self.run_or_without_implied(model, task, aim, values, &mut scratch, host);
            note(&mut report, task, ran);
        }
        let is_dear = self.spent() - began > DEAR;
        let rules = rules_of(tasks.iter().map(|task| &task.component));
        self.latest = Latest { tasks, edited: Some(aim.slots()), ..Latest::default() };
        report.unmet = self.unmet(model, rules.iter().copied(), &scratch, host);
        report.reached = self.reached(aim, &scratch);
        // what did not hold before is asked only where something now does not
        let was_unmet = match report.unmet.is_empty() && report.reached {
            true => Vec::new(),
            false => self.unmet(model, rules.iter().copied(), values, host),
        };
        let broken = is_any_new(&report.unmet, &was_unmet) || !report.reached;
        if report.refusal.is_none() && broken {
            report.refusal =
                Some(report.not_decided.map_or(RefusalReason::Unmet, RefusalReason::NotDecided));
            let holding = |s| aim.holding(model.structure, s);
            let setup = Setup { model, holding: &holding, aim };
            let may_be_tried = match report.not_decided {
                // every part of it would be searched as long
                Some(NotDecided::Roots(_) | NotDecided::Whole(_) | NotDecided::Work(_)) => false,
                Some(NotDecided::Search(_) | NotDecided::Modes(_) | NotDecided::Round) | None => {
                    !is_dear
                }
            };
            let conflict = match may_be_tried {
                true => self.against(&setup, &rules, &wanted, host),
                false => None,
            };
            report.conflicts = conflict.map_or(report.conflicts, |c| vec![c]);
            if report.not_decided.is_none() && !is_dear {
                let tasks = &self.latest.tasks;
                report.limit = self.limit(model, values, aim, tasks, &was_unmet, host);
            }
        }
        if report.refusal.is_none() {
            report.refusal = leaves_domain(model, values, &scratch).map(RefusalReason::OutOfRange);
        }
        if report.refusal.is_none() {
            report.changed = scratch.changed(values).collect();
            let tasks = &self.latest.tasks;
            report.undecided = self.undecided(model, tasks, aim, values, &scratch);
            *values = scratch;
        }
        report
    }

    /// Runs a task with the rules left to the test that others imply by a theorem; where that falls short as planned,
    /// and where that does, with those that others imply where the edit began.
    fn run_or_without_implied(
        &mut self,
        model: Model<'_>,
        task: &mut Task,
        aim: &Aim,
        start: &Values,
        values: &mut Values,
        host: &mut dyn Host,
    ) -> Ran {
        let before = task.component.slots().iter().map(|&s| (s, values.get(s)));
        let before: Vec<(SlotId, Value)> = before.collect();
        let left = self.without_theorems(model, task, start, host);
        if let Some(left) = &left {
            let found = run(self, model, left, aim, start, values, host);
            if !found.falls_short() {
                task.clone_from(left);
                return found;
            }
            before.iter().cloned().for_each(|(slot, value)| values.put(slot, value));
        }
        let ran = run(self, model, task, aim, start, values, host);
        if !ran.falls_short() || ran.not_decided.is_some() {
            return ran;
        }
        let Some(left) = self.without_implied(model, task, start, host) else { return ran };
        let mut again = values.clone();
        before.into_iter().for_each(|(slot, value)| again.put(slot, value));
        let found = run(self, model, &left, aim, start, &mut again, host);
        if found.falls_short() {
            return ran;
        }
        (*task, *values) = (left, again);
        found
    }

    /// Plans what an edit starts.
    pub(crate) fn plan_edit(&mut self, model: Model<'_>, aim: &Aim) -> Vec<Task> {
        if let Some(tasks) = self.recent.find(aim) {
            tasks.iter().for_each(|_| self.plans.reuse());
            return tasks;
        }
        let structure = model.structure;
        let spoken_of = aim.slots();
        // most slots lie far from those that the edit speaks of
        let near = spoken_of.first().zip(spoken_of.last()).map(|(&first, &last)| first..=last);
        let holding = |slot: SlotId| match &near {
            Some(near) if near.contains(&slot) => aim.holding(structure, slot),
            Some(_) | None => Self::resting_hold(structure, slot),
        };
        let tied: Vec<Vec<SlotId>> = aim.wishes.iter().map(Wish::slots).collect();
        let start: BTreeSet<SlotId> =
            spoken_of.iter().chain(tied.iter().flatten()).copied().collect();
        let components = if aim.fixed.is_empty() {
            self.resting_around(structure, &start, &tied)
        } else {
            let is_fixed = |s| holding(s) == Holding::Fixed;
            self.net.around(start, &self.rules, &is_fixed, &tied)
        };
        let is_edited = |slot: SlotId| aim.fixed.contains_key(&slot);
        let tasks = self.tasks(structure, components, &holding, &aim.wishes, Some(&is_edited));
        self.recent.add(aim, &tasks);
        tasks
    }

    /// Lets soft constraints act when the wishes are withdrawn.
    pub(crate) fn settle(
        &mut self,
        model: Model<'_>,
        components: &[Component],
        values: &mut Values,
        host: &mut dyn Host,
    ) -> Option<Failure> {
        let is_soft = |&&r: &&u32| self.rules.get(r).shape.level != Level::Required;
        let soft: BTreeSet<SlotId> = components
            .iter()
            .flat_map(|c| c.rules().iter().filter(is_soft))
            .flat_map(|&r| self.rules.get(r).slots.iter().copied())
            .collect();
        if soft.is_empty() {
            return None;
        }
        let holding = |s| Self::resting_hold(model.structure, s);
        let components = self.resting_around(model.structure, &soft, &[]);
        let tasks = self.tasks(model.structure, components, &holding, &[], None);
        let start = values.clone();
        let aim = Aim::default();
        tasks
            .iter()
            .find_map(|task| run_or_stay(self, model, task, &aim, &start, values, host).failure)
    }
}

/// Reports that nothing was changed.
fn refused(refusal: RefusalReason) -> EditReport {
    EditReport { refusal: Some(refusal), ..EditReport::default() }
}

/// Returns the first whole number that would leave its domain.
fn leaves_domain(model: Model<'_>, before: &Values, after: &Values) -> Option<SlotId> {
    let leaves = |&(&slot, &(low, high)): &(&SlotId, &(i64, i64))| {
        let x = after.numbers[slot];
        x != before.numbers[slot] && !(low as f64..=high as f64).contains(&x)
    };
    model.structure.ranges.iter().find(leaves).map(|(&slot, _)| slot)
}

/// Runs a task; where not everything required can hold, nothing of it changes.
fn run_or_stay(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    aim: &Aim,
    start: &Values,
    values: &mut Values,
    host: &mut dyn Host,
) -> Ran {
    let ran = run(planner, model, task, aim, start, values, host);
    if !ran.is_solved {
        for &slot in task.component.slots() {
            values.put(slot, start.get(slot));
        }
    }
    ran
}

/// Adds what came of one component, and puts it into the mode that stands.
pub(crate) fn note(report: &mut EditReport, task: &mut Task, ran: Ran) {
    if let Some(stands) = ran.stands {
        task.stand(stands);
    }
    report.not_decided = report.not_decided.or(ran.not_decided);
    report.conflicts.extend(ran.conflicts);
    report.double_roots.extend(ran.double_roots);
    if report.refusal.is_none() {
        report.refusal = ran.failure.map(RefusalReason::Method);
    }
}
