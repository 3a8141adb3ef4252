//! Whole numbers among real unknowns: where the plan makes no whole numbers of them, they are looked for.
//!
//! In: a task that its course could not solve, or solved with a whole number that is none. Out: the
//! nearest whole numbers with which everything holds. Each trial is a mode in which they are constants.

use crate::aim::Aim;
use crate::edit::NotDecided;
use crate::host::Host;
use crate::modal::{Decide, attempt_in_mode, has_texts, stands, tell};
use crate::planner::{Model, Planner};
use crate::run::{Ground, Ran, ground, leans, scatter};
use crate::task::Task;
use kernel::{SlotId, Values};
use solve::{
    Conditional, Constants, Decision, Ended, Lean, Level, Looked, Mode, Modes, Patterns, Puzzle,
    SlotIndex, Trial, Tried, Wholes, moved,
};
use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use std::sync::Arc;

/// The modes of a component, and the whole numbers among its real unknowns.
#[derive(Debug)]
pub(crate) struct Whole {
    pub(crate) modes: Rc<Modes>,
    wholes: OnceCell<Wholes>,
    puzzle: OnceCell<Option<Puzzle>>,
}

impl Whole {
    pub(crate) fn new(modes: Rc<Modes>) -> Self {
        Self { modes, wholes: OnceCell::new(), puzzle: OnceCell::new() }
    }
    fn wholes(&self, patterns: &Patterns) -> &Wholes {
        self.wholes.get_or_init(|| Wholes::new(self.modes.conditional(), patterns))
    }
    /// Returns the search for all its solutions, where nothing but whole numbers is unknown.
    pub(crate) fn puzzle(&self, patterns: &Patterns) -> Option<&Puzzle> {
        let make = || {
            let conditional = self.modes.conditional();
            conditional.is_of_whole_numbers().then(|| Puzzle::new(conditional, patterns))
        };
        self.puzzle.get_or_init(make).as_ref()
    }
    /// Returns true if other alternatives hold with these numbers than where an edit began.
    pub(crate) fn is_on_others(&self, ground: &Ground, numbers: &[f64]) -> bool {
        let mut now = ground.local.clone();
        now[..numbers.len()].copy_from_slice(numbers);
        let [before, now] = [&ground.x0, &now].map(|state| self.modes.first(state, state).taken);
        before != now
    }
    /// Returns the slots of whole numbers that are not known.
    pub(crate) fn slots(&self) -> impl Iterator<Item = SlotIndex> + '_ {
        let conditional = self.modes.conditional();
        (0..conditional.system.slots.len() as SlotIndex)
            .filter(|&s| conditional.is_whole_unknown(s))
    }
    /// Returns true if every one of its whole numbers is one, and in its range.
    pub(crate) fn is_whole(&self, task: &Task, values: &Values) -> bool {
        let conditional = self.modes.conditional();
        let value = |slot: SlotIndex| {
            task.component.slots().get(slot as usize).map_or(0.0, |&s| values.numbers[s])
        };
        let mut ranges = conditional.ranges.iter();
        self.slots().all(|s| value(s).fract() == 0.0) && ranges.all(|r| r.holds(value(r.slot)))
    }
}

/// Tries modes of a task in which whole numbers are constants.
struct Trying<'a> {
    planner: &'a Planner,
    model: Model<'a>,
    task: &'a Task,
    modes: &'a Rc<Modes>,
    decide: Decide,
    ground: &'a Ground,
    leans: Vec<Lean>,
    texts: BTreeMap<SlotId, Arc<str>>,
    values: &'a mut Values,
    host: &'a mut dyn Host,
}

impl Trying<'_> {
    /// Decides which mode stands with these slots constants, as they are in `with`.
    fn decided(&mut self, constants: Constants, with: &[f64]) -> Decision {
        let modes = self.modes;
        let mut first = modes.first(&self.ground.x0, with);
        first.constants = constants;
        let begun = self.begun(with);
        let x0 = &self.ground.x0;
        (self.decide)(modes, &first, x0, &mut |mode: &Mode| self.attempt(mode, &begun))
    }
    fn begun(&self, with: &[f64]) -> Ground {
        let Ground { x0, texts, changed: known, .. } = self.ground;
        let (local, changed) = (with.to_vec(), changed(x0, with, known));
        Ground { x0: x0.clone(), local, texts: texts.clone(), changed }
    }
    fn attempt(&mut self, mode: &Mode, begun: &Ground) -> Tried {
        self.values.texts.clone_from(&self.texts);
        let Self { planner, model, task, modes, leans, values, host, .. } = self;
        attempt_in_mode(planner, *model, task, modes, mode, begun, leans, values, *host)
    }
}

/// How whole numbers are looked for.
pub(crate) struct Looking<'a> {
    /// In which modes.
    pub(crate) whole: &'a Whole,
    /// How the mode is decided, of given whole numbers.
    pub(crate) decide: Decide,
    /// True if given numbers change for wishes too.
    pub(crate) may_yield: bool,
}

/// Looks for whole numbers with which everything required holds, and puts what comes of them into
/// `values`. Returns nothing where there are none; else what to tell.
pub(crate) fn run(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    Looking { whole, decide, may_yield }: Looking<'_>,
    ground: &Ground,
    values: &mut Values,
    host: &mut dyn Host,
) -> Option<Ran> {
    let modes = &whole.modes;
    let texts = values.texts.clone();
    let numbers: Vec<f64> = task.numbers(&values.numbers).collect();
    let leans = leans(model, task);
    let mut trying =
        Trying { planner, model, task, modes, decide, ground, leans, texts, values, host };
    let mut trial = |constants: Constants, with: &[f64]| match trial(
        modes,
        &trying.decided(constants, with),
        &ground.x0,
    ) {
        Trial::NotDecided if planner.is_spent() => Trial::Spent,
        tried => tried,
    };
    let wholes = whole.wholes(planner.plans.patterns());
    let looked = wholes.look(&ground.x0, &ground.local, may_yield, &mut trial);
    match looked {
        Looked::Found(constants, with) => {
            let decision = trying.decided(constants, &with);
            if has_texts(task) {
                // the host's texts are those of the mode that stands
                let begun = trying.begun(&with);
                trying.attempt(&decision.mode, &begun);
            }
            scatter(task, &decision.tried.values, trying.values);
            Some(tell(planner, stands(planner, modes, decision.mode.clone()), task, &decision))
        }
        looked @ (Looked::Impossible | Looked::NotDecided(_)) => {
            trying.values.texts = trying.texts;
            scatter(task, &numbers, trying.values);
            let Looked::NotDecided(tried) = looked else { return None };
            let not_decided = Some(NotDecided::Whole(tried as u64));
            Some(Ran { not_decided, ..Ran::default() })
        }
    }
}

/// Finds other states of a task that holds, in which one of its whole numbers among `own` is a little
/// larger or smaller and everything else follows. `values` are left anywhere.
pub(crate) fn others(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    own: &BTreeSet<SlotId>,
    values: &Values,
    host: &mut dyn Host,
) -> Vec<Vec<f64>> {
    /// How far from what it is.
    const STEPS: [f64; 6] = [1.0, -1.0, 2.0, -2.0, 3.0, -3.0];
    let Some(whole) = task.whole() else { return Vec::new() };
    let modes = &whole.modes;
    let mut ground = ground(planner, task, &Aim::default(), values, values);
    ground.compute(planner, model, task, values, host);
    let (leans, texts) = (leans(model, task), values.texts.clone());
    let own = whole.slots().filter(|&s| own.contains(&task.component.slots()[s as usize]));
    let own: Vec<SlotIndex> = own.collect();
    let (ground, values) = (&ground, &mut values.clone());
    let decide = solve::decide;
    let mut trying =
        Trying { planner, model, task, modes, decide, ground, leans, texts, values, host };
    let mut found = Vec::new();
    for (&slot, step) in own.iter().flat_map(|slot| STEPS.map(|step| (slot, step))) {
        let mut with = ground.local.clone();
        with[slot as usize] += step;
        let mut ranges = modes.conditional().ranges.iter().filter(|r| r.slot == slot);
        if ranges.all(|r| r.holds(with[slot as usize])) {
            let decision = trying.decided(Constants::WholeAndGiven, &with);
            let tried = trial(modes, &decision, &ground.x0);
            if matches!(tried, Trial::Holds(unmet, _) if unmet == [0.0; Level::SOFT.len()]) {
                found.push(decision.tried.values.clone());
            }
        }
    }
    found
}

/// Returns the known slots that an edit changes, those of whole numbers included.
fn changed(x0: &[f64], with: &[f64], known: &[SlotIndex]) -> Vec<SlotIndex> {
    let mut changed = known.to_vec();
    let moved = (0..).zip(x0.iter().zip(with)).filter(|(_, (a, b))| a.to_bits() != b.to_bits());
    changed.extend(moved.map(|(i, _): (SlotIndex, _)| i));
    changed.sort_unstable();
    changed.dedup();
    changed
}

/// Says how much of the wishes a decision leaves unmet, and how far given numbers went.
fn trial(modes: &Modes, decision: &Decision, start: &[f64]) -> Trial {
    match decision.ended {
        Ended::Settled => {}
        Ended::Contradiction(_) => return Trial::Fails,
        Ended::NotDecided(_) => return Trial::NotDecided,
    }
    let system = &modes.conditional().system;
    let mut unmet = [0.0; Level::SOFT.len()];
    for u in &decision.tried.outcome.unmet {
        let relation = system.relations.get(u.relation as usize);
        let Some(rank) = relation.and_then(|r| r.level.rank()) else { return Trial::Fails };
        unmet[rank] += u.error * u.error;
    }
    let [document, class, _] = moved(&system.slots, start, &decision.tried.values);
    Trial::Holds(unmet, [document, class])
}

/// Returns what a component is besides its course, if whole numbers are among its unknowns.
pub(crate) fn stated(conditional: &Conditional) -> bool {
    conditional.has_whole_unknowns() && !conditional.is_searched()
}
