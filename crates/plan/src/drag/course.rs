//! Drags of what programs draw: followed on the course of the press; where that is left, on the one that is come to;
//! where neither holds what is wished, up to where it ends.

use super::Press;
use crate::aim::Aim;
use crate::course::Guard;
use crate::edit::{EditReport, Target};
use crate::host::Host;
use crate::planner::{Model, Planner, Unmet, is_any_new};
use crate::rule::Source;
use crate::task::Task;
use kernel::{Term, ThingId, Values};
use std::collections::BTreeSet;

/// How many other courses are kept for when the drag comes back to them.
const KEPT: usize = 4;
/// How often the way to the end of a course is halved.
const HALVINGS: usize = 40;

/// The courses of a drag.
#[derive(Debug)]
pub(super) struct Courses {
    /// What is dragged.
    targets: Vec<Owned>,
    /// What stays meanwhile.
    kept: Vec<Owned>,
    /// The values at the press.
    start: Values,
    /// Where the targets were then.
    from: Vec<f64>,
    /// What the rules were decided by at the press.
    rules: Vec<Guard>,
    /// The same drag on other courses.
    others: Vec<Press>,
    /// The one that is followed; nothing while that of the press is.
    present: Option<usize>,
    /// What did not hold at the press, once it was asked.
    unmet: Option<Vec<Unmet>>,
}

impl Courses {
    fn targets(&self) -> (Vec<Target<'_>>, Vec<Target<'_>>) {
        let targets = self.targets.iter().map(Owned::target).collect();
        (targets, self.kept.iter().map(Owned::target).collect())
    }
}

#[derive(Clone, Debug)]
enum Owned {
    Thing(ThingId),
    Term { me: ThingId, term: Term },
}

impl Owned {
    fn target(&self) -> Target<'_> {
        match self {
            Self::Thing(thing) => Target::Thing(*thing),
            Self::Term { me, term } => Target::Term { me: *me, term },
        }
    }
}

impl Press {
    /// Returns the drag on the course that it is on.
    pub(super) fn on_its_course(mut self) -> Self {
        match self.courses.take() {
            Some(mut courses) => match courses.present {
                Some(at) => courses.others.swap_remove(at),
                None => self,
            },
            None => self,
        }
    }
    fn wish(&mut self, wanted: &[f64]) {
        let goals = self.aim.wanted.iter_mut().flatten();
        goals.zip(wanted).for_each(|(goal, &x)| *goal = x);
    }
}

impl Planner {
    /// Returns what a drag needs to leave its course; nothing where no program has a part in it.
    pub(super) fn courses(
        &self,
        aim: &Aim,
        (targets, kept): (&[Target<'_>], &[Target<'_>]),
        values: &Values,
    ) -> Option<Box<Courses>> {
        if aim.guards.is_empty() && self.lowering.guards.is_empty() {
            return None;
        }
        let owned = |target: &Target<'_>| match *target {
            Target::Thing(thing) => Owned::Thing(thing),
            Target::Term { me, term } => Owned::Term { me, term: term.clone() },
        };
        Some(Box::new(Courses {
            targets: targets.iter().map(owned).collect(),
            kept: kept.iter().map(owned).collect(),
            start: values.clone(),
            from: aim.wanted.iter().flatten().copied().collect(),
            rules: self.lowering.guards.clone(),
            others: Vec::new(),
            present: None,
            unmet: None,
        }))
    }

    /// Looks whether what a drag came to is on its course, and follows another where it is not.
    pub(super) fn on_courses(
        &mut self,
        model: Model<'_>,
        (press, courses): (&mut Press, &mut Courses),
        values: &mut Values,
        report: EditReport,
        host: &mut dyn Host,
    ) -> EditReport {
        courses.present = None;
        let guards = [&press.aim.guards[..], &courses.rules].concat();
        if self.is_on_course(&guards, values) {
            return report;
        }
        let there = values.clone();
        let wanted: Vec<f64> = press.aim.wanted.iter().flatten().copied().collect();
        if self.counts_otherwise(model.structure, &courses.rules, &press.aim.alone, &there) {
            let way = (&mut *press, &mut *courses);
            if let Some(found) = self.on_its_count(model, way, &wanted, values, host) {
                let mut changes = self.course_changes(model, &guards, (&courses.start, values));
                changes.retain(|change| !change.is_of(model.structure, &press.aim.alone));
                return EditReport { courses: changes, ..found };
            }
            let start = courses.start.clone();
            self.press_on(model, (&mut *press, &mut *courses), &start);
        }
        // what other rules say of another course is not planned in the midst of a drag
        if self.is_on_course(&courses.rules, &there)
            && let Some(found) = self.on_another(model, courses, &wanted, values, &there, host)
        {
            let courses = self.course_changes(model, &guards, (&courses.start, values));
            return EditReport { courses, ..found };
        }
        let mut report = self.up_to_the_end(model, (press, courses), &wanted, values, host);
        report.courses = self.course_changes(model, &guards, (&courses.start, &there));
        report.reached = false;
        report
    }

    /// Follows a drag on a course that was come to before, or that `there` is on. Nothing where that is not kept.
    fn on_another(
        &mut self,
        model: Model<'_>,
        courses: &mut Courses,
        wanted: &[f64],
        values: &mut Values,
        there: &Values,
        host: &mut dyn Host,
    ) -> Option<EditReport> {
        for at in 0..courses.others.len() {
            let found = self.on_kept(model, (courses, at), wanted, values, host);
            if found.is_some() {
                return found;
            }
        }
        let (targets, kept) = courses.targets();
        let aim = self.aim_keeping(model, (&courses.start, there), &targets, &kept).ok()?;
        if courses.others.iter().any(|other| other.aim.wishes == aim.wishes) {
            return None;
        }
        let other = self.press_aim(model, &courses.start, aim);
        if courses.others.len() == KEPT {
            courses.others.remove(0);
        }
        courses.others.push(other);
        let at = courses.others.len() - 1;
        self.on_kept(model, (courses, at), wanted, values, host)
    }

    /// Presses anew, from where the press was, on the course that is taken at some values.
    fn press_on(
        &mut self,
        model: Model<'_>,
        (press, courses): (&mut Press, &mut Courses),
        on: &Values,
    ) -> Option<()> {
        self.take_course(model, on);
        let (targets, kept) = courses.targets();
        let aim = self.aim_keeping(model, (&courses.start, on), &targets, &kept).ok()?;
        *press = self.press_aim(model, &courses.start, aim);
        courses.rules.clone_from(&self.lowering.guards);
        courses.others.clear();
        Some(())
    }

    /// Follows a drag of what counts: rules that speak of so many are opened for as many as it says, and what they
    /// speak of follows. Nothing where they do not hold then.
    fn on_its_count(
        &mut self,
        model: Model<'_>,
        (press, courses): (&mut Press, &mut Courses),
        wanted: &[f64],
        values: &mut Values,
        host: &mut dyn Host,
    ) -> Option<EditReport> {
        // of what did not hold at the press nothing is asked
        let unmet = match courses.unmet.take() {
            Some(unmet) => unmet,
            None => self.unmet(model, self.all_rules(), &courses.start, host),
        };
        let unmet = courses.unmet.insert(unmet).clone();
        let there = values.clone();
        self.press_on(model, (&mut *press, &mut *courses), &there)?;
        values.clone_from(&courses.start);
        press.wish(wanted);
        let report = self.pull_all(model, press, values, host);
        let known: BTreeSet<Source> = unmet.iter().map(|unmet| unmet.source).collect();
        let now = self.unmet(model, self.all_rules(), values, host).into_iter();
        let new: BTreeSet<Source> =
            now.map(|unmet| unmet.source).filter(|source| !known.contains(source)).collect();
        let (rules, own) = (self.rules.clone(), press.reach().collect::<BTreeSet<_>>());
        let follows = |task: &Task| {
            let component = &task.component;
            !component.slots().iter().any(|slot| own.contains(slot))
                && component.rules().iter().any(|&r| new.contains(&rules.get(r).source))
        };
        self.satisfy_where(model, follows, values, host);
        let guards = [&press.aim.guards[..], &courses.rules].concat();
        let now = self.unmet(model, self.all_rules(), values, host);
        (self.is_on_course(&guards, values) && !is_any_new(&now, &unmet)).then_some(report)
    }

    fn all_rules(&self) -> std::ops::Range<u32> {
        0..self.rules.len() as u32
    }

    /// Follows a drag on one of the courses that are kept. Nothing where it leaves that.
    fn on_kept(
        &mut self,
        model: Model<'_>,
        (courses, at): (&mut Courses, usize),
        wanted: &[f64],
        values: &mut Values,
        host: &mut dyn Host,
    ) -> Option<EditReport> {
        let other = &mut courses.others[at];
        values.clone_from(&courses.start);
        other.wish(wanted);
        let report = self.pull_all(model, other, values, host);
        if !self.is_on_course(&other.aim.guards, values) {
            return None;
        }
        courses.present = Some(at);
        Some(report)
    }

    /// Follows a drag as far as it stays on its course on the straight way from the press to what is wished.
    fn up_to_the_end(
        &mut self,
        model: Model<'_>,
        (press, courses): (&mut Press, &Courses),
        wanted: &[f64],
        values: &mut Values,
        host: &mut dyn Host,
    ) -> EditReport {
        let guards = [&press.aim.guards[..], &courses.rules].concat();
        let (mut low, mut high) = (0.0, 1.0);
        let mut follow = |planner: &mut Self, part: f64, values: &mut Values| {
            let mid: Vec<f64> =
                courses.from.iter().zip(wanted).map(|(a, b)| a + part * (b - a)).collect();
            press.wish(&mid);
            values.clone_from(&courses.start);
            planner.pull_all(model, press, values, host)
        };
        for _ in 0..HALVINGS {
            let mid = 0.5 * (low + high);
            follow(self, mid, values);
            match self.is_on_course(&guards, values) {
                true => low = mid,
                false => high = mid,
            }
        }
        let report = follow(self, low, values);
        press.wish(wanted);
        report
    }
}
