//! Drags of what programs draw and of what counts: followed on the course of the press; where that is left, on the one
//! that is come to; where neither holds what is wished, up to where it ends.

use super::Press;
use crate::aim::Aim;
use crate::course::{CourseChange, Guard};
use crate::edit::{EditReport, Target};
use crate::host::Host;
use crate::planner::{Model, Planner, Unmet, is_any_new};
use crate::rule::{Formula, Source};
use crate::task::Task;
use crate::template::LoweringReport;
use kernel::{Primitive, SlotId, Structure, Term, ThingId, Values};
use std::collections::BTreeSet;
use std::rc::Rc;

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
    /// Which of their numbers are whole ones.
    are_whole: Vec<bool>,
    /// What was decided at the press.
    pressed: Vec<Guard>,
    /// How the rules were lowered there.
    lowered: Rc<LoweringReport>,
    /// What the rules of the drag at hand were decided by.
    rules: Vec<Guard>,
    /// The same drag on other courses.
    others: Vec<Press>,
    /// The one that is followed; nothing while that of the press is.
    present: Option<usize>,
    /// What did not hold at the press, once it was asked.
    unmet: Option<Vec<Unmet>>,
}

impl Courses {
    /// Returns what is wished on the straight way from the press to what is wanted.
    fn between(&self, wanted: &[f64], part: f64) -> Vec<f64> {
        let wish: Vec<f64> =
            self.from.iter().zip(wanted).map(|(a, b)| a + part * (b - a)).collect();
        self.wish(&wish)
    }
    /// Returns what is wished where these numbers are: of whole numbers the nearest, as of moves.
    pub(super) fn wish(&self, wanted: &[f64]) -> Vec<f64> {
        let wish = |(&x, &is_whole): (&f64, &bool)| if is_whole { x.round() } else { x };
        wanted.iter().zip(&self.are_whole).map(wish).collect()
    }
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
    /// Returns what a drag needs to leave its course; nothing where nothing is decided.
    pub(super) fn courses(
        &self,
        structure: &Structure,
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
        let is_whole = |formula: &Formula<SlotId>| match formula.slots[..] {
            [slot] if self.plans.patterns().get(formula.pattern).is_argument() => {
                structure.slots[slot].primitive == Primitive::Integer
            }
            _ => false,
        };
        Some(Box::new(Courses {
            are_whole: aim.wishes.iter().flat_map(|w| &w.formulas).map(is_whole).collect(),
            targets: targets.iter().map(owned).collect(),
            kept: kept.iter().map(owned).collect(),
            start: values.clone(),
            from: aim.wanted.iter().flatten().copied().collect(),
            pressed: [&aim.guards[..], &self.lowering.guards].concat(),
            lowered: self.lowering.clone(),
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
            let courses = self.courses_taken(model, (press, courses), values);
            return EditReport { courses, ..report };
        }
        let there = values.clone();
        let wanted: Vec<f64> = press.aim.wanted.iter().flatten().copied().collect();
        if self.counts_otherwise(model.structure, &courses.rules, &press.aim.alone, &there) {
            let way = (&mut *press, &mut *courses);
            if let Some(found) = self.on_its_count(model, way, &wanted, values, host) {
                let courses = self.courses_taken(model, (press, courses), values);
                return EditReport { courses, ..found };
            }
            let (way, wish) = ((&mut *press, &mut *courses), (&wanted[..], &there));
            if let Some(found) = self.up_to_its_count(model, way, wish, values, host) {
                let courses =
                    self.course_changes(model, &courses.pressed, (&courses.start, &there));
                return EditReport { courses, reached: false, ..found };
            }
            let start = courses.start.clone();
            self.press_on(model, (&mut *press, &mut *courses), &start);
        }
        // what other rules say of another course is not planned in the midst of a drag
        if self.is_on_course(&courses.rules, &there)
            && let Some(found) = self.on_another(model, courses, &wanted, values, &there, host)
        {
            let courses = self.course_changes(model, &courses.pressed, (&courses.start, values));
            return EditReport { courses, ..found };
        }
        let mut report = self.up_to_the_end(model, (press, courses), &wanted, values, host);
        report.courses = self.course_changes(model, &courses.pressed, (&courses.start, &there));
        report.reached = false;
        report
    }

    /// Returns what is decided otherwise than at the press, but for what is dragged.
    fn courses_taken(
        &self,
        model: Model<'_>,
        (press, courses): (&Press, &Courses),
        values: &Values,
    ) -> Vec<CourseChange> {
        let mut changes = self.course_changes(model, &courses.pressed, (&courses.start, values));
        changes.retain(|change| !change.is_of(model.structure, &press.aim.alone));
        changes
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
        let start = courses.start.clone();
        let report = self.pull_from(model, press, (&start, wanted), values, host);
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
        let holds = self.is_on_course(&guards, values) && !is_any_new(&now, &unmet);
        (holds && !self.is_faulty_beside(&courses.lowered)).then_some(report)
    }

    /// Follows a drag of what counts up to a count that holds, on the straight way from the press to what is wanted,
    /// which leads `there`: the last before one that does not. Nothing where none is found but that of the press.
    ///
    /// The way is doubled until a count fails, then halved: what is far beyond the last that holds is dear to open.
    fn up_to_its_count(
        &mut self,
        model: Model<'_>,
        (press, courses): (&mut Press, &mut Courses),
        (wanted, there): (&[f64], &Values),
        values: &mut Values,
        host: &mut dyn Host,
    ) -> Option<EditReport> {
        let start = courses.start.clone();
        let pressed = self.decided_at(&courses.pressed, &start);
        let (mut low, mut holds) = (0.0, pressed.clone());
        let (mut high, mut fails) = (1.0, self.decided_at(&courses.pressed, there));
        self.press_on(model, (&mut *press, &mut *courses), &start)?;
        let least = 1.0 / (1_u64 << HALVINGS) as f64;
        for _ in 0..2 * HALVINGS {
            let doubled = f64::max(2.0 * low, least);
            let mid = if doubled < high { doubled } else { 0.5 * (low + high) };
            let wish = courses.between(wanted, mid);
            self.pull_from(model, press, (&start, &wish), values, host);
            let decided = self.decided_at(&courses.pressed, values);
            if decided == holds {
                low = mid;
            } else if decided == fails {
                high = mid;
            } else {
                let way = (&mut *press, &mut *courses);
                if self.on_its_count(model, way, &wish, values, host).is_some() {
                    (low, holds) = (mid, decided);
                } else {
                    (high, fails) = (mid, decided);
                    self.press_on(model, (&mut *press, &mut *courses), &start)?;
                }
            }
        }
        if holds == pressed {
            return None;
        }
        let wish = courses.between(wanted, low);
        self.pull_from(model, press, (&start, &wish), values, host);
        let found = self.on_its_count(model, (&mut *press, courses), &wish, values, host);
        press.wish(wanted);
        found
    }

    /// Follows a wish from where the press was.
    fn pull_from(
        &mut self,
        model: Model<'_>,
        press: &mut Press,
        (start, wish): (&Values, &[f64]),
        values: &mut Values,
        host: &mut dyn Host,
    ) -> EditReport {
        press.wish(wish);
        values.clone_from(start);
        self.pull_all(model, press, values, host)
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
        let (other, start) = (&mut courses.others[at], &courses.start);
        let report = self.pull_from(model, other, (start, wanted), values, host);
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
            let wish = courses.between(wanted, part);
            planner.pull_from(model, press, (&courses.start, &wish), values, host)
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
