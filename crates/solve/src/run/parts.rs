//! Parts: a long way to a wish is gone in short ones, so that how often the pointer is asked plays no part.

use super::start::measure_what_is_set;
use super::{Drag, Runner};
use crate::outcome::{Host, Outcome, Reason, Status};
use crate::plan::Plan;
use crate::system::{SlotIndex, Stay};

/// A way longer than this is cut, in parts of the extent, over the number of slots that move.
const PART: f64 = 0.25;
/// Into so many ways at most, over the same number.
const MOST_WORK: usize = 20_000;
/// What one wish of a drag may cost, in multiplications: the pointer waits for it.
pub const PATIENCE: u64 = 300_000_000;
/// What a part of the way may cost that an edit drags, for every slot besides that.
const SLOT: u64 = 100_000;

/// Returns true where a way leads from one value of these slots to another: they are known numbers, none of them
/// whole.
pub fn are_continuous(plan: &Plan, slots: &[SlotIndex]) -> bool {
    let is_known = |&slot: &SlotIndex| {
        let slot = &plan.slots()[slot as usize];
        slot.is_number && !slot.is_discrete && slot.stay == Stay::Fixed
    };
    !slots.is_empty() && slots.iter().all(is_known)
}

/// What came of dragging what an edit sets.
pub(super) enum Dragged {
    /// It was not dragged.
    Nowhere,
    There(Outcome),
    Stopped(Reason),
}

/// How long a way is followed.
#[derive(Clone, Copy)]
enum Until {
    /// Until so much was spent.
    Spent(u64),
    /// As long as it can be followed.
    Missed,
}

impl Runner {
    /// Drags the `changed` slots from a state that holds to what they are in `values`, where a long way there has
    /// to be gone in short ones; where that does not arrive, all values are as they came.
    pub(super) fn dragged(
        &mut self,
        plan: &Plan,
        x0: &[f64],
        values: &mut [f64],
        changed: &[SlotIndex],
        host: &mut dyn Host,
    ) -> Dragged {
        if !plan.bends || !plan.has_branches || plan.opens() || !are_continuous(plan, changed) {
            return Dragged::Nowhere;
        }
        let leans = std::mem::take(&mut self.leans);
        let mut drag = Drag::by(std::mem::take(self), plan, x0, changed);
        drag.lean(plan, &leans);
        measure_what_is_set(plan, &mut drag.runner.frame, values, changed);
        let targets: Vec<f64> = changed.iter().map(|&slot| values[slot as usize]).collect();
        let has_branch = drag.has_branch;
        let outcome = has_branch.then(|| drag.follow_until(Until::Missed, plan, &targets, host));
        let dragged = match outcome {
            None => Dragged::Nowhere,
            Some(Outcome { status: Status::Stopped(reason), .. }) => Dragged::Stopped(reason),
            Some(outcome) => {
                values.copy_from_slice(&drag.now);
                Dragged::There(outcome)
            }
        };
        *self = drag.runner;
        self.leans = leans;
        if let Dragged::Stopped(_) = dragged {
            self.stopped.clone_from(&drag.now);
        }
        dragged
    }
}

impl Drag {
    /// Follows the wish: one target for each input, in their order.
    ///
    /// Where the required relations cannot follow, the drag stops at the limit and says so; a wish
    /// that they do not allow is met as nearly as they do. Later wishes go on from there. A long way is gone in
    /// short ones, so that how often the pointer is asked plays no part, as long as that is done soon: where
    /// the way is hard to find the drag stops on it.
    ///
    /// # Panics
    /// If there are not as many targets as inputs.
    pub fn follow(&mut self, plan: &Plan, targets: &[f64], host: &mut dyn Host) -> Outcome {
        let bound = self.runner.spent() + PATIENCE;
        let outcome = self.follow_until(Until::Spent(bound), plan, targets, host);
        let is_met = outcome.is_solved() && outcome.unmet.is_empty();
        self.is_cut = !is_met && self.runner.spent() > bound;
        outcome
    }

    fn follow_until(
        &mut self,
        until: Until,
        plan: &Plan,
        targets: &[f64],
        host: &mut dyn Host,
    ) -> Outcome {
        assert_eq!(targets.len(), self.slice.inputs.len(), "a wish names every input");
        let may_leap = self.has_branch && plan.bends;
        let mut parts = if may_leap { self.parts(plan, targets) } else { 1 };
        if !may_leap {
            let outcome = self.follow_part(until, plan, targets, host);
            if !self.has_branch || outcome.status != Status::Stopped(Reason::Conflict) {
                return outcome;
            }
            // what is tested alone may hold all the way on roots that are met in short ones
            parts = self.parts(plan, targets);
        }
        if parts > 1 {
            let mut at: Vec<f64> =
                self.slice.inputs.iter().map(|&input| self.now[input as usize]).collect();
            while parts > 1 {
                let part = 1.0 / f64::from(parts);
                at.iter_mut().zip(targets).for_each(|(at, to)| *at += part * (to - *at));
                let outcome = self.follow_part(until, plan, &at, host);
                match until {
                    Until::Missed if !outcome.is_solved() => return outcome,
                    Until::Spent(bound) if self.runner.spent() > bound => break,
                    Until::Missed | Until::Spent(_) => {}
                }
                // what was small and has grown has a shorter way to go
                parts = (parts - 1).min(self.parts_from(plan, &at, targets));
            }
        }
        self.follow_part(until, plan, targets, host)
    }

    /// Follows a wish that is near, until it is known to be missed or that costs too much.
    fn follow_part(
        &mut self,
        until: Until,
        plan: &Plan,
        targets: &[f64],
        host: &mut dyn Host,
    ) -> Outcome {
        if let Until::Spent(bound) = until {
            return self.follow_on(plan, targets, bound, host);
        }
        let bound = PATIENCE + SLOT * plan.slots().len() as u64;
        let end = self.runner.spent() + bound;
        let mut outcome = self.follow_on(plan, targets, end, host);
        let is_limit = matches!(outcome.status, Status::Stopped(Reason::Limit { .. }));
        if is_limit && self.runner.spent() > end {
            outcome.status = Status::Stopped(Reason::GivenUp { bound });
        }
        outcome
    }

    /// Returns what following has cost so far, in multiplications, roughly.
    pub fn spent(&self) -> u64 {
        self.runner.spent()
    }
    /// Says what following may cost from now on, as [`Runner::end_at`] does.
    pub fn end_at(&mut self, bound: Option<u64>) {
        self.runner.end_at(bound);
    }

    /// Returns into how many ways that to a wish is cut: where least change bends, a stride might pass over the
    /// end of a branch, and where inequalities wait, over them. The more of a kind moves, the nearer to one another
    /// it lies.
    pub fn parts(&self, plan: &Plan, targets: &[f64]) -> u32 {
        let at = self.slice.inputs.iter().map(|&input| self.now[input as usize]);
        self.parts_from(plan, &at.collect::<Vec<_>>(), targets)
    }
    fn parts_from(&self, plan: &Plan, at: &[f64], targets: &[f64]) -> u32 {
        if !plan.has_branches {
            return 1;
        }
        let scales = &self.runner.frame.scales;
        let kind = |slot: SlotIndex| plan.slots()[slot as usize].scale;
        let part = |((&input, at), to): ((&SlotIndex, &f64), &f64)| {
            let alike = || self.slice.targets.iter().filter(|&&t| kind(t) == kind(input));
            let sizes = alike().map(|&t| self.now[t as usize].abs());
            let extent = sizes.fold(scales[input as usize], f64::max);
            (to - at).abs() / extent * alike().count().max(1) as f64 / PART
        };
        let parts = self.slice.inputs.iter().zip(at).zip(targets).map(part).fold(1.0, f64::max);
        let most = (MOST_WORK / self.slice.targets.len().max(1)).max(1);
        parts.ceil().min(most as f64) as u32
    }
}
