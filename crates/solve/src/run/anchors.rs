//! Anchors: where least change was measured anew.
//!
//! In: a way along a branch of least change. Least change from the press has no minimum any more beyond some
//! wish, as where a chain that bent one way would have to bend the other. The way goes on from there, measured
//! from there: the state is an anchor. Where the wish comes back past it, the former measure is taken up
//! again. So what a wish leads to depends on the way there and not on its frames, and the way back is the way out.

use super::way::{LONGEST, SHORTEST, Way};
use crate::attempt::{Approach, Buffers, Failure, Frame};
use crate::fork;
use crate::least::Least;
use crate::lower::Program;
use crate::outcome::{Outcome, Reason, Status};
use crate::plan::Step;
use crate::rows::{Point, generic_number};
use crate::slice::Slice;
use crate::square::Trust;
use crate::system::{SlotIndex, Turn};
use std::collections::BTreeSet;

/// Up to so many slots what was measured anew is measured from the press again.
const MOST_MEASURED_TWICE: usize = 200;
/// The shortest stride where the end of a branch is to be found exactly.
const EXACT: f64 = 1e-11;
/// How often least change is measured anew in one drag.
const ANCHORS: usize = 256;
/// A way comes past an anchor where it is as near to it as this, in parts of its own length.
const PASSING: f64 = 0.5;
/// How far a state goes that buckles, in parts of the extent: the second where the first is too far, as it is for what is
/// small beside numbers of its kind.
const BUCKLED: [f64; 2] = [1e-5, 1e-8];
/// What lies no farther apart than this lies at one place, in the same parts: rules hold no closer.
const ONE_PLACE: f64 = 1e-12;
/// How far apart it goes.
const APART: f64 = 1e-9;
/// How far the least change from the press may be from that from an anchor, in parts of the farthest change: what
/// follows the pointer jumps no farther.
const NEAR: f64 = 1e-3;
/// Two measures agree where no slot differs by more, in parts of the extent.
const SAME: f64 = 5e-3;
/// The part of the way on from there that shows whether a measure can go on.
const ONWARD: f64 = 1.0 / 1024.0;

impl Way<'_> {
    /// Many strides; where least change goes no further on its branch, it is measured anew from there, and where
    /// something runs away the way ends while it has not yet. Returns the part that was gone.
    pub(super) fn walk_near(&mut self, last: &mut [f64], goal: &[f64], trust: Trust) -> f64 {
        let (from, anchors) = (last.to_vec(), self.frame.anchors.len());
        let gone = self.walk_on(last, goal, trust);
        if gone == 1.0 || trust != Trust::Branch || !self.runs_away(&from, last) {
            return gone;
        }
        self.frame.anchors.truncate(anchors);
        last.copy_from_slice(&from);
        self.walk_in_sight(last, goal)
    }

    /// The same, whatever runs away.
    pub(super) fn walk_on(&mut self, last: &mut [f64], goal: &[f64], trust: Trust) -> f64 {
        let is_first = trust == Trust::Branch && self.frame.x0 == *last;
        if is_first {
            self.buckle(last, goal);
        }
        let strides = self.strides(last, goal);
        let mut gone = self.walk(last, goal, trust, strides);
        if trust != Trust::Branch || !self.plan.has_least {
            if gone == 0.0 && trust == Trust::Branch && !self.frame.anchors.is_empty() {
                gone = self.walk(last, goal, trust, SHORTEST..EXACT);
            }
            return gone;
        }
        while gone < 1.0
            && self.frame.anchors.len() < ANCHORS
            && self.buffers.work.spent() <= self.until
        {
            self.frame.anchors.push(last.to_vec());
            // what is short beside the way, as a bar that hardly has a length, goes on in shorter strides
            let lengths = if is_first && gone < SHORTEST { 2 } else { 1 };
            let goes_on = [SHORTEST, EXACT][..lengths]
                .iter()
                .any(|&length| self.stride(last, goal, length, trust, &Approach::Nowhere).is_ok());
            self.frame.anchors.pop();
            if !goes_on {
                break;
            }
            // from exactly where the branch ends, however long the strides were
            gone += (1.0 - gone) * self.walk(last, goal, trust, SHORTEST..EXACT);
            self.frame.anchors.push(last.to_vec());
            let on = self.walk(last, goal, trust, LONGEST..SHORTEST);
            gone = if on == 1.0 { 1.0 } else { gone + (1.0 - gone) * on };
        }
        gone
    }

    /// Says what holds at the limit of a way of which that part was gone: where strides do not find exactly where the
    /// branch ends, it goes on to there first.
    pub(super) fn stop(
        &mut self,
        limit: &mut [f64],
        goal: &[f64],
        trust: Trust,
        mut fraction: f64,
        failure: Failure,
    ) -> Outcome {
        if fraction < 1.0 && trust == Trust::Branch && !self.plan.has_least {
            let stood = limit.to_vec();
            let gone = self.walk(limit, goal, trust, SHORTEST..EXACT);
            if self.runs_away(&stood, limit) {
                limit.copy_from_slice(&stood);
            } else {
                fraction += (1.0 - fraction) * gone;
            }
        }
        let mut outcome = self.test(limit, &[]);
        if fraction < 1.0 {
            outcome.status = Status::Stopped(failure.at(fraction));
        }
        outcome
    }

    /// Where the press is a state that no branch leads out of to first order, as a straight chain is one, goes a
    /// little way on out of it, and measures from where that begins: from the press no direction is nearer than its
    /// opposite.
    fn buckle(&mut self, last: &mut [f64], goal: &[f64]) {
        let way = self.distance(last, goal);
        for far in BUCKLED {
            if !self.buckles_too_far((far / way).min(1.0), last, goal) {
                return;
            }
        }
    }

    /// The same by that part of the way; returns true where it buckles and does not go on from there.
    fn buckles_too_far(&mut self, mut part: f64, last: &mut [f64], goal: &[f64]) -> bool {
        let anchors = self.frame.anchors.len();
        let way = self.distance(last, goal);
        let mut aside = last.to_vec();
        let mut steps = BTreeSet::new();
        let mut is_apart = false;
        loop {
            let has_buckled = !steps.is_empty();
            match self.stride(&aside, goal, part, Trust::Branch, &Approach::Nowhere) {
                Ok(()) if has_buckled => {
                    last.copy_from_slice(self.trial);
                    return false;
                }
                Err(Failure { reason: Reason::NoSolution { step }, .. }) if steps.insert(step) => {
                    let step = &self.plan.steps()[step as usize];
                    if !self.buckle_step(step, &mut aside) {
                        if !self.part_step(step, &mut aside) {
                            break;
                        }
                        is_apart = true;
                        part = (APART / way).min(1.0);
                    }
                }
                Ok(()) | Err(_) => break,
            }
            self.frame.anchors.truncate(anchors);
            self.frame.anchors.push(aside.clone());
        }
        // what went apart lies anyhow, perhaps far from where its rows can hold
        if is_apart && self.stride(&aside, goal, part, Trust::Any, &Approach::Nowhere).is_ok() {
            last.copy_from_slice(self.trial);
            aside.copy_from_slice(self.trial);
            self.frame.anchors.truncate(anchors);
            self.frame.anchors.push(aside);
            return false;
        }
        self.frame.anchors.truncate(anchors);
        aside != last
    }

    /// Moves what lies at one place, where its rows have no slope, a little apart: of all directions that which
    /// numbers give that nothing could coincide with. Returns false where everything has a slope.
    fn part_step(&mut self, step: &Step, aside: &mut [f64]) -> bool {
        let block = match (&step.program, fork::forking(&step.program)) {
            (Program::Least(least), _) => &least.0.block,
            (_, Some(square)) => &square.block,
            (_, None) => return false,
        };
        let apart =
            block.without_slope(aside, &self.frame.scales, ONE_PLACE, &mut self.buffers.work);
        for &unknown in &apart {
            let slot = block.unknowns[unknown];
            let by = generic_number(u64::from(slot), Point::Mixed);
            aside[slot as usize] += APART * by * self.frame.scales[slot as usize];
        }
        !apart.is_empty()
    }

    /// Where least change was measured anew on the way to a state, measures it from the press again: what is least
    /// near by, put where attempts run. Returns false where there is none, and in large systems: it costs another
    /// step of the drag.
    pub(super) fn measure_from_press(&mut self, state: &[f64]) -> bool {
        if self.frame.anchors.is_empty() || state.len() > MOST_MEASURED_TWICE {
            return false;
        }
        let anchors = std::mem::take(&mut self.frame.anchors);
        let is_least = self.direct(state, state, Trust::Branch).is_ok();
        self.frame.anchors = anchors;
        let Frame { x0, scales, .. } = &*self.frame;
        let apart = |a: &[f64], b: &[f64]| {
            let parts = a.iter().zip(b).zip(scales).map(|((a, b), scale)| (a - b).abs() / scale);
            parts.fold(0.0, f64::max)
        };
        is_least && apart(self.trial, state) <= NEAR * apart(state, x0)
    }

    /// Moves the targets of a step that has failed to where it goes on from; returns false where it does not.
    fn buckle_step(&mut self, step: &Step, aside: &mut [f64]) -> bool {
        step.targets.iter().for_each(|&t| self.trial[t as usize] = aside[t as usize]);
        let Buffers { work, least: scratch, .. } = &mut *self.buffers;
        let scales = &self.frame.scales;
        let buckles = match (&step.program, fork::forking(&step.program)) {
            (Program::Least(least), _) => least.0.buckle(self.trial, scales, work, scratch),
            (_, Some(square)) => {
                let least = Least::new(&square.block.problem(), &|_| Turn::Valued);
                least.buckle(self.trial, scales, work, scratch)
            }
            (Program::Measure(measure), None) => {
                let least = measure.least();
                least.is_some_and(|least| least.buckle(self.trial, scales, work, scratch))
            }
            (_, None) => false,
        };
        if buckles {
            step.targets.iter().for_each(|&t| aside[t as usize] = self.trial[t as usize]);
        }
        buckles
    }

    /// Where the way from `last` to the goal comes back past the wish at which least change was last measured
    /// anew, goes there, and measures again from where it was measured from before. Returns true if it did.
    pub(super) fn take_back(&mut self, slice: &Slice, last: &mut [f64], goal: &[f64]) -> bool {
        let Some(anchor) = self.frame.anchors.pop() else { return false };
        let taken = self.former(slice, &anchor, last, goal);
        if let Some(state) = &taken {
            last.copy_from_slice(state);
        } else {
            self.frame.anchors.push(anchor);
        }
        taken.is_some()
    }

    /// Finds the state that the former measure gives where a way passes an anchor, if the present one, whose
    /// `anchor` it is, gives the same there and the former one can go on.
    fn former(
        &mut self,
        slice: &Slice,
        anchor: &[f64],
        last: &[f64],
        goal: &[f64],
    ) -> Option<Vec<f64>> {
        let turn = passing(slice, &self.frame.scales, anchor, last, goal)?;
        let arrives = |from: &mut [f64], way: &mut Self| {
            way.walk(from, &turn, Trust::Branch, LONGEST..SHORTEST) == 1.0
        };
        let (mut state, mut present) = (anchor.to_vec(), last.to_vec());
        if !arrives(&mut state, self) {
            return None;
        }
        self.frame.anchors.push(anchor.to_vec());
        let came = arrives(&mut present, self);
        self.frame.anchors.pop();
        let is_near = |&t: &SlotIndex| {
            let t = t as usize;
            (present[t] - state[t]).abs() <= SAME * self.frame.scales[t]
        };
        (came && slice.targets.iter().all(is_near)).then_some(state)
    }

    /// Forgets the anchors where everything is as it was when the edit began.
    pub(super) fn rest_at(&mut self, state: &[f64]) {
        if !self.frame.anchors.is_empty() && self.frame.x0 == state {
            self.frame.anchors.clear();
        }
    }
}

/// Returns where the way from one wish to another has just been nearest to an anchor's, if that is near.
fn passing(
    slice: &Slice,
    scales: &[f64],
    anchor: &[f64],
    last: &[f64],
    goal: &[f64],
) -> Option<Vec<f64>> {
    let inputs = || slice.inputs.iter().map(|&i| i as usize);
    let (mut along, mut square) = (0.0, 0.0);
    for i in inputs() {
        let way = (goal[i] - last[i]) / scales[i];
        along += way * ((anchor[i] - last[i]) / scales[i]);
        square += way * way;
    }
    let part = (along / square).max(0.0);
    let mut turn = goal.to_vec();
    if part < 1.0 {
        let part = part + ONWARD * (1.0 - part);
        inputs().for_each(|i| turn[i] = last[i] + part * (goal[i] - last[i]));
    }
    let off = |i: usize| (turn[i] - anchor[i]) / scales[i];
    let distance: f64 = inputs().map(|i| off(i) * off(i)).sum();
    (distance <= PASSING * PASSING * square).then_some(turn)
}
