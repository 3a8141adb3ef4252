//! Ways from one state to another: strides as long as the branch allows, over crests, to where wishes are met as
//! nearly as they can be, and the tests at their end.

use crate::attempt::{Approach, Attempt, Buffers, Failure, Frame, Part};
use crate::lower::Program;
use crate::outcome::{Host, Outcome, Reason, Status, Unmet};
use crate::plan::Plan;
use crate::square::{Square, Trust};
use crate::system::{Level, SlotIndex, Stay};
use crate::test::{Failing, Tests};
use std::ops::Range;

/// The first stride of a walk, and the shortest, as parts of the whole way.
pub(super) const LONGEST: f64 = 0.5;
pub(super) const SHORTEST: f64 = 1e-7;
/// The same in parts of the extent, where that is farther: what is small grows in strides as small.
const SMALL: f64 = 1e-3;
/// How far a stride over a crest goes, as a part of what is left of the way, and how far what it finds may lie off,
/// in parts of the extent.
const CREST: f64 = 1e-3;
const NEAR: f64 = 0.1;
/// What goes so many times as far as the wish that it follows runs away.
const AWAY: f64 = 1e4;
/// How far what ends at the goal may come from, in parts of how far that is.
const ENDS: f64 = 100.0;
/// What came to less than this part has come to nothing.
const NOTHING: f64 = 1e-5;
/// From so near the end of a way is found by how fast it comes near, in parts of the extent: a quarter of it may be left
/// so often, and so large a part of that is gone back in each of three strides.
const CLOSE: f64 = 1e-4;
const QUARTERS: usize = 6;
const BACK: f64 = -0.5;
/// What moves by more than this part of what it moved in the stride behind tends nowhere; what moves by this part of the
/// extent rests, and this part of a number is left where the rest cancels.
const SLOWEST: f64 = 0.9;
const ROUNDING: f64 = 1e-14;
/// What a stride costs for every slot, in multiplications.
const STRIDE: usize = 64;
/// How many strides are tried before a way is given up.
const STRIDES: usize = 600;

/// The way from one state to another.
pub(super) struct Way<'a> {
    pub(super) plan: &'a Plan,
    pub(super) frame: &'a mut Frame,
    pub(super) buffers: &'a mut Buffers,
    pub(super) host: &'a mut dyn Host,
    /// Where attempts put their values.
    pub(super) trial: &'a mut Vec<f64>,
    pub(super) part: Part<'a>,
    /// A walk ends where it stands when so much was spent.
    pub(super) until: u64,
}

impl Way<'_> {
    /// Goes from `last` to where the known slots are as in `goal`; the solution is put in `values`.
    pub(super) fn go(
        &mut self,
        last: &mut [f64],
        goal: &[f64],
        values: &mut [f64],
        trust: Trust,
    ) -> Result<(), Reason> {
        let is_rough = trust == Trust::Any && self.plan.has_large_core;
        self.buffers.square.is_hasty = is_rough;
        let mut direct = self.direct(last, goal, trust);
        self.buffers.square.is_hasty = false;
        if is_rough && direct.is_err() {
            // what a large block finds alone by small steps lies farther off than what all rows find together
            if self.all_at_once(last, goal) {
                values.copy_from_slice(self.trial);
                return Ok(());
            }
            direct = self.direct(last, goal, trust);
        }
        let failure = match direct {
            Ok(()) => {
                values.copy_from_slice(self.trial);
                // on another root a surplus row may hold
                if trust != Trust::Branch && self.is_broken() && self.search(last, goal).is_ok() {
                    values.copy_from_slice(self.trial);
                }
                return Ok(());
            }
            Err(failure) => failure,
        };
        let fraction = match trust {
            Trust::Branch => self.walk_on(last, goal, trust),
            Trust::Any | Trust::Leap | Trust::Nearest => 0.0,
        };
        if fraction == 1.0 {
            let is_nearer = self.measure_from_press(last);
            values.copy_from_slice(if is_nearer { self.trial } else { last });
            return Ok(());
        }
        let arrived = match self.approach(last, goal, &failure) {
            Ok(()) => Ok(()),
            Err(_) if trust == Trust::Branch => {
                // a branch that ends on the way does not lead there
                let x0 = self.frame.x0.clone();
                let arrives = (fraction == 0.0 || self.goes_beyond(&x0))
                    && self.same_orientation(&x0, goal, 1.0);
                arrives.then_some(()).ok_or_else(|| failure.at(fraction))
            }
            Err(_) => self.search(last, goal).map_err(|failure| failure.reason),
        };
        arrived.map(|()| values.copy_from_slice(self.trial))
    }

    /// One stride.
    pub(super) fn direct(
        &mut self,
        last: &[f64],
        goal: &[f64],
        trust: Trust,
    ) -> Result<(), Failure> {
        self.stride(last, goal, 1.0, trust, &Approach::Nowhere)
    }

    pub(super) fn stride(
        &mut self,
        last: &[f64],
        goal: &[f64],
        part: f64,
        trust: Trust,
        approach: &Approach,
    ) -> Result<(), Failure> {
        self.set_out(last, goal, part);
        self.buffers.work.spend(STRIDE * self.trial.len());
        let Self { plan, part, .. } = *self;
        let attempt = Attempt { plan, frame: self.frame, last, trust, part };
        attempt.run(self.trial, approach, self.buffers, self.host)
    }

    /// Puts the last state and the known slots, that part of the way on, where attempts run.
    pub(super) fn set_out(&mut self, last: &[f64], goal: &[f64], part: f64) {
        self.trial.clear();
        self.trial.extend_from_slice(last);
        let mut move_known = |i: usize| {
            if goal[i].to_bits() != last[i].to_bits() {
                self.trial[i] =
                    if part == 1.0 { goal[i] } else { last[i] + (goal[i] - last[i]) * part };
            }
        };
        match self.part {
            Part::Whole => (0..goal.len())
                .filter(|&i| self.plan.slots()[i].stay == Stay::Fixed)
                .for_each(&mut move_known),
            Part::Downstream(slice) => {
                slice.inputs.iter().for_each(|&slot| move_known(slot as usize));
            }
        }
    }

    /// Returns how far the wish lies, in parts of the extent.
    pub(super) fn distance(&self, last: &[f64], goal: &[f64]) -> f64 {
        let part = |i: usize| ((goal[i] - last[i]) / self.frame.scales[i]).abs();
        match self.part {
            Part::Whole => (0..goal.len())
                .filter(|&i| self.plan.slots()[i].stay == Stay::Fixed)
                .map(part)
                .fold(0.0, f64::max),
            Part::Downstream(slice) => {
                slice.inputs.iter().map(|&slot| part(slot as usize)).fold(0.0, f64::max)
            }
        }
    }

    /// Returns how long the strides of a walk are, from the first to the shortest, as parts of the whole way.
    pub(super) fn strides(&self, last: &[f64], goal: &[f64]) -> Range<f64> {
        LONGEST..SHORTEST.min(SMALL / (self.distance(last, goal) * self.frame.growth))
    }

    /// Arrives from next to the goal where the branch ends there, as what shrinks to nothing does: no block has a
    /// side any more.
    fn ends(&mut self, last: &[f64], goal: &[f64]) -> bool {
        let near = ENDS * self.distance(last, goal);
        self.stride(last, goal, 1.0, Trust::Any, &Approach::Nowhere).is_ok() && {
            let scales = &self.frame.scales;
            let gone =
                self.trial.iter().zip(last).zip(scales).map(|((to, from), by)| (to - from) / by);
            gone.fold(0.0, |far: f64, part| part.abs().max(far)) <= near
        }
    }

    /// Arrives from next to the goal where solutions come together there, as all numbers do whose variance comes to
    /// nothing, or their standard deviation. Where they have come so near that rows hardly tell them apart, it is from
    /// where they were.
    fn closes(&mut self, last: &[f64], goal: &[f64]) -> bool {
        if self.distance(last, goal) > CLOSE {
            return false;
        }
        let mut near = last.to_vec();
        for _ in 0..QUARTERS {
            if self.stride(&near, goal, 0.75, Trust::Branch, &Approach::Nowhere).is_err() {
                break;
            }
            near.copy_from_slice(self.trial);
        }
        self.tends(&near, goal) || near != last && self.tends(last, goal)
    }

    /// Arrives where unknowns tend: what is left for each follows from how much less it moves by each of three strides
    /// than by the one behind.
    fn tends(&mut self, last: &[f64], goal: &[f64]) -> bool {
        let mut at = last.to_vec();
        let mut states = [(); 3].map(|()| Vec::new());
        for state in &mut states {
            if self.stride(&at, goal, BACK, Trust::Branch, &Approach::Nowhere).is_err() {
                return false;
            }
            at.copy_from_slice(self.trial);
            state.clone_from(self.trial);
        }
        let [near, middle, far] = &states;
        self.set_out(near, goal, 1.0);
        for (i, x) in self.trial.iter_mut().enumerate() {
            let moved = near[i] - middle[i];
            let ratio = moved / (middle[i] - far[i]);
            // what is known is where it shall be, and what hardly moves where it tends
            if *x != near[i] || moved.abs() <= ROUNDING * self.frame.scales[i] {
                continue;
            }
            if ratio.abs() > SLOWEST {
                return false;
            }
            *x = near[i] + moved * ratio / (1.0 - ratio);
            if x.abs() <= ROUNDING * near[i].abs() {
                *x = 0.0;
            }
        }
        self.test_trial(&[]).is_solved()
    }

    /// Many strides, each as long as the branch allows, the first and the shortest so long; returns the part
    /// that was gone.
    pub(super) fn walk(
        &mut self,
        last: &mut [f64],
        goal: &[f64],
        trust: Trust,
        strides: Range<f64>,
    ) -> f64 {
        let mut gone = 0.0;
        let mut length = strides.start;
        for _ in 0..STRIDES {
            if self.buffers.work.spent() > self.until || self.buffers.work.is_spent() {
                break;
            }
            let part = if gone + length >= 1.0 { 1.0 } else { length / (1.0 - gone) };
            if self.stride(last, goal, part, trust, &Approach::Nowhere).is_ok() {
                last.copy_from_slice(self.trial);
                if part == 1.0 {
                    return 1.0;
                }
                gone += length;
                length *= 2.0;
            } else {
                length = length.min(1.0 - gone) * 0.5;
                if length < strides.end {
                    let is_near = 1.0 - gone <= 4.0 * strides.end;
                    if is_near && self.ends(last, goal) || self.closes(last, goal) {
                        last.copy_from_slice(self.trial);
                        return 1.0;
                    }
                    let part = CREST * (1.0 - gone);
                    if trust != Trust::Branch || !self.crosses(last, goal) {
                        break;
                    }
                    last.copy_from_slice(self.trial);
                    gone += part;
                    length = part;
                }
            }
        }
        gone
    }

    /// Returns true if a state holds only because something has run away: it went so many times as far as the wish that
    /// it follows, as the point does where a line that turns to a parallel meets another.
    pub(super) fn runs_away(&self, from: &[f64], to: &[f64]) -> bool {
        let (mut wish, mut most) = (0.0f64, 0.0f64);
        let slots = self.plan.slots().iter().zip(&self.frame.scales);
        for ((slot, scale), (to, from)) in slots.zip(to.iter().zip(from)) {
            let far = if slot.stay == Stay::Fixed { &mut wish } else { &mut most };
            *far = far.max(((to - from) / scale).abs());
        }
        most > NEAR.max(AWAY * wish)
    }

    /// Goes along a branch as far as nothing runs away; returns the part that was gone.
    pub(super) fn walk_in_sight(&mut self, last: &mut [f64], goal: &[f64]) -> f64 {
        let from = last.to_vec();
        let (mut gone, mut length) = (0.0, LONGEST);
        for _ in 0..STRIDES {
            if length < SHORTEST || self.buffers.work.spent() > self.until {
                break;
            }
            let part = length / (1.0 - gone);
            let goes_on = part < 1.0
                && self.stride(last, goal, part, Trust::Branch, &Approach::Nowhere).is_ok()
                && !self.runs_away(&from, self.trial);
            if goes_on {
                last.copy_from_slice(self.trial);
                gone += length;
            } else {
                length *= 0.5;
            }
        }
        gone
    }

    /// Goes a little on over a place where a row has no slope, as `q |q|` has none at nothing, but no branch ends.
    pub(super) fn crosses(&mut self, last: &[f64], goal: &[f64]) -> bool {
        self.same_orientation(last, goal, CREST) && self.is_near(last)
    }

    /// Arrives on other roots beside those that were followed, where a required row that is tested alone does not
    /// hold on these, as past a place where two branches meet.
    pub(super) fn goes_beside(&mut self, last: &[f64], goal: &[f64]) -> bool {
        self.is_broken() && {
            self.part = Part::Whole;
            self.search(last, goal).is_ok() && self.is_near(last)
        }
    }

    /// Returns true if nothing that has branches lies far from a state where attempts ran.
    fn is_near(&self, state: &[f64]) -> bool {
        let near = |&t: &SlotIndex| {
            let t = t as usize;
            (self.trial[t] - state[t]).abs() <= NEAR * self.frame.scales[t]
        };
        self.plan.branching().iter().flat_map(|step| &step.targets).all(near)
    }

    /// Comes as near to soft wishes as the hard rows allow, from the limit of the branch.
    pub(super) fn approach(
        &mut self,
        limit: &[f64],
        goal: &[f64],
        failure: &Failure,
    ) -> Result<(), Failure> {
        let mut failure = failure.clone();
        let mut regions = Vec::new();
        loop {
            let region = failure.region;
            let possible = self.plan.regions().get(region as usize).is_some_and(|r| r.can_approach);
            if !possible || regions.contains(&region) {
                return Err(failure);
            }
            regions.push(region);
            let approach = Approach::In(regions.clone());
            match self.stride(limit, goal, 1.0, Trust::Any, &approach) {
                Ok(()) => return Ok(()),
                Err(next) => failure = next,
            }
        }
    }

    /// One stride, going back to other roots where a step has no solution.
    pub(super) fn search(&mut self, last: &[f64], goal: &[f64]) -> Result<(), Failure> {
        self.set_out(last, goal, 1.0);
        let Self { plan, part, .. } = *self;
        let attempt = Attempt { plan, frame: self.frame, last, trust: Trust::Any, part };
        attempt.search(self.trial, self.buffers, self.host)
    }

    /// One stride, from where all rows together err least; returns true if everything then holds.
    pub(super) fn all_at_once(&mut self, last: &[f64], goal: &[f64]) -> bool {
        self.set_out(last, goal, 1.0);
        let Self { plan, part, .. } = *self;
        let attempt = Attempt { plan, frame: self.frame, last, trust: Trust::Any, part };
        attempt.run_from_near(self.trial, self.buffers, self.host)
    }

    /// Returns true if a required row that depends on others, or is tested alone, does not hold, but may on another
    /// root.
    pub(super) fn is_broken(&mut self) -> bool {
        let Self { plan, part, .. } = *self;
        let attempt = Attempt { plan, frame: self.frame, last: &[], trust: Trust::Any, part };
        plan.has_branches && attempt.broken(self.trial, self.buffers, self.host).is_some()
    }

    /// Tries to arrive so far on without a way: allowed where every block lies as it did, if the values told there.
    pub(super) fn same_orientation(&mut self, from: &[f64], goal: &[f64], part: f64) -> bool {
        self.stride(from, goal, part, Trust::Any, &Approach::Nowhere).is_ok()
            && self.lies_as(from, |_| true)
    }

    /// Arrives without a way: one unknown at its nearest root, which lies on no side of anything, and every block of
    /// several as it did.
    pub(super) fn leaps(&mut self, from: &[f64], goal: &[f64]) -> bool {
        self.stride(from, goal, 1.0, Trust::Nearest, &Approach::Nowhere).is_ok()
            && self.lies_as(from, |square| square.block.core.len() > 1)
    }

    /// Returns true if every block that `counts` lies where attempts ran as it does in a state, if the values tell there.
    fn lies_as(&mut self, from: &[f64], counts: impl Fn(&Square) -> bool) -> bool {
        let Buffers { work, square: scratch, .. } = &mut *self.buffers;
        let scales = &self.frame.scales;
        self.plan.steps().iter().all(|step| match &step.program {
            Program::Square(square) if !square.block.is_linear && counts(square) => {
                let before = square.orientation(from, scales, work, scratch);
                let after = square.orientation(self.trial, scales, work, scratch);
                before == 0 || before == after
            }
            Program::Measure(_) | Program::Least(_) => false,
            Program::Square(_)
            | Program::Inverse(_)
            | Program::Constant(_)
            | Program::Copy
            | Program::Formulas(..)
            | Program::Host { .. } => true,
        })
    }

    /// Comes from a state as near to soft wishes as the hard rows allow, past the limit of a branch that was followed
    /// from another state. Returns false where that is not possible, or what meets them has turned over there or runs
    /// away.
    pub(super) fn comes_near(
        &mut self,
        state: &[f64],
        [from, limit]: [&[f64]; 2],
        goal: &[f64],
        failure: &Failure,
        trust: Trust,
    ) -> bool {
        if self.approach(state, goal, failure).is_err()
            || trust == Trust::Branch && self.runs_away(from, self.trial)
        {
            return false;
        }
        // what was approached need not hold because of how it is computed
        let part = std::mem::replace(&mut self.part, Part::Whole);
        let turns = trust == Trust::Branch
            && self.test_trial(&[]).unmet.is_empty()
            && self.turns_over(from, limit);
        self.part = part;
        !turns
    }

    /// Returns true if what is determined lies, where attempts ran, on another side than at `from`, or where that is
    /// between two sides than at x0, and what a row divides by came to nothing at the `limit` that it came past: a
    /// tangent to a line that came to nothing there is one to a line that points the other way. Where rows depend on
    /// one another alone, as those of a parallelogram that lies flat, the way may go straight on.
    fn turns_over(&mut self, from: &[f64], limit: &[f64]) -> bool {
        let Buffers { work, square: scratch, .. } = &mut *self.buffers;
        let Frame { x0, scales, .. } = &*self.frame;
        let trial = &*self.trial;
        self.plan.branching().iter().any(|step| match &step.program {
            Program::Square(square) if !square.block.is_linear => {
                let mut side = |state: &[f64]| square.orientation(state, scales, work, scratch);
                let before = match side(from) {
                    0 => side(x0),
                    before => before,
                };
                let turns = before != 0 && side(trial) == -before;
                turns && square.block.loses_divisors(x0, limit, NOTHING, work)
            }
            _ => false,
        })
    }

    /// Returns true if something that has branches may go on where it is lost: it is made of pieces, of which one begins
    /// where another ends, or two branches lie one on the other from the start, and rounding tells which is followed.
    fn goes_beyond(&mut self, from: &[f64]) -> bool {
        let Buffers { work, square: scratch, .. } = &mut *self.buffers;
        let scales = &self.frame.scales;
        self.plan.branching().iter().any(|step| match &step.program {
            Program::Square(square) => {
                square.block.has_pieces()
                    || !square.block.is_linear && square.is_double(from, scales, work, scratch)
            }
            Program::Inverse(inverse) => inverse.row.kernel.has_pieces(),
            Program::Measure(_)
            | Program::Least(_)
            | Program::Constant(_)
            | Program::Copy
            | Program::Formulas(..)
            | Program::Host { .. } => false,
        })
    }

    pub(super) fn test_trial(&mut self, upstream: &[Unmet]) -> Outcome {
        let trial = std::mem::take(self.trial);
        let outcome = self.test(&trial, upstream);
        *self.trial = trial;
        outcome
    }

    /// Tests the relations, each against its own tolerance; what is not met `upstream` is known.
    pub(super) fn test(&mut self, values: &[f64], upstream: &[Unmet]) -> Outcome {
        let mut unmet = Vec::new();
        match self.part {
            Part::Whole => {
                self.failing(self.plan.tests(), &self.plan.opaque, values, &mut unmet);
            }
            Part::Downstream(slice) => {
                self.failing(&slice.tests, &slice.opaque, values, &mut unmet);
                unmet.extend(upstream);
            }
        }
        unmet.sort_unstable_by_key(|u| u.relation);
        let required = |u: &Unmet| self.plan.relation(u.relation).level == Level::Required;
        let conflict = unmet.iter().any(required);
        let status = if conflict { Status::Stopped(Reason::Conflict) } else { Status::Solved };
        Outcome { status, unmet, notes: Vec::new() }
    }

    /// Adds the relations that do not hold: those of equations, and those that only the host can test.
    pub(super) fn failing(
        &mut self,
        tests: &Tests,
        opaque: &[u32],
        values: &[f64],
        unmet: &mut Vec<Unmet>,
    ) {
        let mut add = |f: Failing| match unmet.last_mut() {
            Some(last) if last.relation == f.relation => {
                if f.error > last.error {
                    (last.error, last.tolerance) = (f.error, f.tolerance);
                }
            }
            Some(_) | None => {
                let Failing { relation, error, tolerance, .. } = f;
                unmet.push(Unmet { relation, error, tolerance });
            }
        };
        let Buffers { work, test, .. } = &mut *self.buffers;
        self.plan.each_failing(tests, values, work, test, &mut add);
        for &relation in opaque {
            if !self.host.holds(self.plan.relation(relation).source, values) {
                unmet.push(Unmet { relation, error: 1.0, tolerance: 0.0 });
            }
        }
    }
}
