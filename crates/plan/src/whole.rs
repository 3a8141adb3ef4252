//! Whole numbers among real unknowns: where the plan makes no whole numbers of them, they are looked for.
//!
//! In: a task that its course could not solve, or solved with a whole number that is none. Out: the
//! nearest whole numbers with which everything holds. Each trial is a mode in which they are constants.

use crate::edit::NotDecided;
use crate::host::Host;
use crate::modal::{attempt_in_mode, has_texts, tell};
use crate::planner::{Model, Planner};
use crate::run::{Ground, Ran, leans, scatter};
use crate::task::Task;
use kernel::Values;
use solve::{
    Conditional, Constants, Decision, Ended, Level, Looked, Mode, Modes, Patterns, SlotIndex,
    Trial, Wholes, decide,
};
use std::cell::OnceCell;
use std::rc::Rc;

/// The whole numbers of a component among its real unknowns.
#[derive(Debug)]
pub(crate) struct Whole {
    pub(crate) modes: Rc<Modes>,
    wholes: OnceCell<Wholes>,
}

impl Whole {
    pub(crate) fn new(modes: Rc<Modes>) -> Self {
        Self { modes, wholes: OnceCell::new() }
    }
    fn wholes(&self, patterns: &Patterns) -> &Wholes {
        self.wholes.get_or_init(|| Wholes::new(self.modes.conditional(), patterns))
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
        self.slots().all(|s| value(s).fract() == 0.0)
            && ranges.all(|r| (r.low as f64..=r.high as f64).contains(&value(r.slot)))
    }
}

/// Looks for whole numbers with which everything required holds, and puts what comes of them into
/// `values`. Returns nothing where there are none; else what to tell.
pub(crate) fn run(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    ground: &Ground,
    values: &mut Values,
    host: &mut dyn Host,
) -> Option<Ran> {
    let whole = task.whole()?;
    let modes = &whole.modes;
    let texts = values.texts.clone();
    let numbers: Vec<f64> = task.numbers(&values.numbers).collect();
    let leans = leans(model, task);
    let mut decided = |constants: Constants, with: &[f64]| -> Decision {
        let mut first = modes.first(&ground.x0, with);
        first.constants = constants;
        let changed = changed(&ground.x0, with, &ground.changed);
        let mut attempt = |mode: &Mode| {
            values.texts.clone_from(&texts);
            let ground =
                Ground { x0: ground.x0.clone(), local: with.to_vec(), changed: changed.clone() };
            attempt_in_mode(planner, model, task, modes, mode, &ground, &leans, values, host)
        };
        decide(modes, &first, &mut attempt)
    };
    let mut trial = |constants: Constants, with: &[f64]| trial(modes, &decided(constants, with));
    let looked = whole.wholes(planner.plans.patterns()).look(&ground.x0, &ground.local, &mut trial);
    match looked {
        Looked::Found(constants, with) => {
            let decision = decided(constants, &with);
            if has_texts(task) {
                // the host's texts are those of the mode that stands
                decided(constants, &with);
            }
            scatter(task, &decision.tried.values, values);
            Some(tell(planner, modes, task, decision))
        }
        Looked::Impossible => {
            values.texts = texts;
            scatter(task, &numbers, values);
            None
        }
        Looked::NotDecided(tried) => {
            values.texts = texts;
            scatter(task, &numbers, values);
            let not_decided = Some(NotDecided::Whole(tried as u64));
            Some(Ran { not_decided, ..Ran::default() })
        }
    }
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

/// Says how much of the wishes a decision leaves unmet.
fn trial(modes: &Modes, decision: &Decision) -> Trial {
    match decision.ended {
        Ended::Settled => {}
        Ended::Contradiction(_) => return Trial::Fails,
        Ended::NotDecided(_) => return Trial::NotDecided,
    }
    let mut unmet = [0.0; Level::SOFT.len()];
    for u in &decision.tried.outcome.unmet {
        let relation = &modes.conditional().system.relations[u.relation as usize];
        let Some(rank) = relation.level.rank() else { return Trial::Fails };
        unmet[rank] += u.error * u.error;
    }
    Trial::Holds(unmet)
}

/// Returns what a component is besides its course, if whole numbers are among its unknowns.
pub(crate) fn stated(conditional: &Conditional) -> bool {
    conditional.has_whole_unknowns() && !conditional.is_searched()
}
