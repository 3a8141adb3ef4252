//! Running a plan: one edit, or a drag.
//!
//! In: a plan, the state x0 when the edit began, new values of known slots. Out: the nearest state on
//! the present branch in which everything required holds, and an [`Outcome`]. The way from the last
//! state is taken in one stride where that is safe and in as many as needed where it is not; where
//! the branch ends, soft wishes are met as nearly as they can be, and required ones stop the edit.

mod anchors;
mod parts;
pub(crate) mod start;
mod way;

pub use parts::{PATIENCE, are_continuous};

use crate::attempt::others::Other;
use crate::attempt::{Attempt, Buffers, Failure, Frame, Held, Motion, Part};
use crate::fork::{self, Lean};
use crate::lower::Program;
use crate::outcome::{Host, Outcome, Reason, Status, Unmet};
use crate::plan::Plan;
use crate::search::{Puzzle, Verdict};
use crate::slice::Slice;
use crate::square::Trust;
use crate::system::{SlotIndex, Stay};
use parts::Dragged;
use start::{Begins, measure_what_is_set, required_rows_held, start};
use std::cell::Cell;
use std::rc::Rc;
use way::Way;

/// Reusable storage for runs. One serves any number of plans, one after the other.
#[derive(Clone, Debug, Default)]
pub struct Runner {
    frame: Frame,
    buffers: Buffers,
    last: Vec<f64>,
    goal: Vec<f64>,
    came: Vec<f64>,
    trial: Vec<f64>,
    leans: Vec<Lean>,
    /// Where the way ended that its last run went; empty where none ended.
    stopped: Vec<f64>,
}

impl Runner {
    /// Makes an empty one.
    pub fn new() -> Self {
        Self::default()
    }
    /// Returns the state where the way ended that its last run went, if that did not arrive.
    pub fn stopped(&self) -> Option<&[f64]> {
        (!self.stopped.is_empty()).then_some(&self.stopped)
    }
    /// Returns what its runs have cost so far, in multiplications, roughly: the same on every machine.
    pub fn spent(&self) -> u64 {
        self.buffers.work.spent()
    }
    /// Says what its runs may cost from now on, by what they have [`spent`](Self::spent) then: one that comes to
    /// that finds no solution.
    pub fn end_at(&mut self, bound: Option<u64>) {
        self.buffers.work.end_at(bound);
    }
    /// Does the same for trials: of solutions that are searched for any will do.
    pub fn try_until(&mut self, bound: Option<u64>) {
        self.buffers.work.try_until(bound);
    }
    /// Returns what its runs may still cost, where that is bounded.
    pub fn left(&self) -> Option<u64> {
        self.buffers.work.left()
    }
    /// Counts what was run without it.
    pub fn spend(&mut self, multiplications: u64) {
        self.buffers.work.spend(multiplications as usize);
    }
    /// Finds the solution of a puzzle [nearest](Puzzle::nearest) to a start; it counts as a run does.
    pub fn nearest(&mut self, puzzle: &Puzzle, start: &[f64], values: &[f64]) -> Verdict {
        self.buffers.work.nearest(puzzle, start, values)
    }
    /// Says which way the states lean that it starts from from now on, where two branches meet.
    pub fn lean(&mut self, leans: Vec<Lean>) {
        self.leans = leans;
    }
}

/// Returns which way the state that a run or drag came to leans where two branches meet, so that the
/// branch on which it came can be gone back.
///
/// `x0` is the state when the edit began, where `leans` said what its values do not. Blocks whose
/// core is of more than a dozen unknowns are not looked at.
pub fn leaning(plan: &Plan, x0: &[f64], leans: &[Lean], values: &[f64]) -> Vec<Lean> {
    let mut runner = Runner::new();
    start(plan, &mut runner, x0, &[], Begins::Rest);
    fork::leaning(plan, &runner.frame, &mut runner.buffers, leans, values)
}

/// Returns for every block in which two branches meet in a state two ways to lean, each with the state that lies
/// that way a little aside: the rules do not hold in it exactly.
pub fn forks(plan: &Plan, x0: &[f64]) -> Vec<[(Lean, Vec<f64>); 2]> {
    let mut runner = Runner::new();
    start(plan, &mut runner, x0, &[], Begins::Rest);
    fork::asides(plan, &runner.frame, &mut runner.buffers, x0)
}

/// Returns other states that a plan can come to from a state that holds: in each, one step takes another of
/// its roots, and the rest follows. At `most` so many; steps of more than a dozen unknowns are not asked.
/// Roots are looked for around that state, and from `beside`, if there is such a state.
pub fn others(
    plan: &Plan,
    x0: &[f64],
    beside: Option<&[f64]>,
    most: usize,
    host: &mut dyn Host,
) -> Vec<Other> {
    let mut runner = Runner::new();
    start(plan, &mut runner, x0, &[], Begins::Rest);
    let Runner { frame, buffers, .. } = &mut runner;
    let mut values = frame.x0.clone();
    let last = frame.x0.clone();
    let attempt = Attempt { plan, frame, last: &last, trust: Trust::Any, part: Part::Whole };
    attempt.others(&mut values, beside, most, buffers, host)
}

/// Looks near a state for one in which every row of a plan holds, everything moved at once: nothing keeps its
/// value, and no branch is followed. Returns nothing where none was found, which does not say that there is none.
///
/// What the host computes is not looked at, nor what follows from that. Where a number ran off, the rows hold only
/// because nothing depends on it any more: that is no solution.
pub fn near(plan: &Plan, runner: &mut Runner, x0: &[f64], host: &mut dyn Host) -> Option<Vec<f64>> {
    /// What lies farther than this, in parts of the extent, ran off.
    const FAR: f64 = 1e6;
    start(plan, runner, x0, &[], Begins::Rest);
    let Runner { frame, buffers, .. } = runner;
    let mut values = frame.x0.clone();
    let last = frame.x0.clone();
    let attempt = Attempt { plan, frame, last: &last, trust: Trust::Any, part: Part::Whole };
    let holds = attempt.settle(&mut values, buffers, host);
    let mut ways = values.iter().zip(x0).zip(&frame.scales);
    let has_run_off = ways.any(|((x, x0), scale)| (x - x0).abs() > FAR * scale);
    (holds && !has_run_off).then_some(values)
}

/// Runs a plan for one edit.
///
/// `x0` is the state when the edit began; slots without a stay are searched from the value that they
/// have there (zero where it is not a number) and measured from it. `values` comes as `x0` with the
/// `changed` known slots set, and leaves as the solution; where a required relation cannot hold it
/// is as it came. What is not downstream of a change keeps its bits. In a state that holds, the
/// solution is the one on the present branch, and where rows bend the one that a [`Drag`] of what has changed
/// comes to.
pub fn run(
    plan: &Plan,
    runner: &mut Runner,
    x0: &[f64],
    values: &mut [f64],
    changed: &[SlotIndex],
    host: &mut dyn Host,
) -> Outcome {
    runner.stopped.clear();
    let stopped = match runner.dragged(plan, x0, values, changed, host) {
        Dragged::There(outcome) => return outcome,
        Dragged::Stopped(reason) => Some(reason),
        Dragged::Nowhere => None,
    };
    runner.came.clear();
    runner.came.extend_from_slice(values);
    let begins = if changed.is_empty() { Begins::Rest } else { Begins::Edit };
    start(plan, runner, x0, changed, begins);
    let Runner { frame, buffers, last, goal, came, trial, leans, .. } = runner;
    measure_what_is_set(plan, frame, came, changed);
    let solved_before =
        frame.changed_texts.is_empty() && !plan.opens() && required_rows_held(plan, frame, buffers);
    last.clear();
    last.extend_from_slice(&frame.x0);
    fork::lean(plan, frame, buffers, leans, last);
    goal.clear();
    goal.extend_from_slice(&frame.x0);
    for (i, slot) in plan.slots().iter().enumerate() {
        if slot.stay == Stay::Fixed && slot.is_number {
            goal[i] = came[i];
        }
    }
    let trust = if solved_before && plan.has_branches { Trust::Branch } else { Trust::Any };
    let mut way = Way { plan, frame, buffers, host, trial, part: Part::Whole, until: u64::MAX };
    let mut result = match stopped {
        Some(reason) => Err(reason),
        None => way.go(last, goal, values, trust),
    };
    if let Err(Reason::NoSolution { .. } | Reason::NotDecided { .. }) = result
        && !solved_before
        // whole numbers that come out broken are looked for with everything else as planned
        && !plan.has_whole_unknowns()
        && let Some(relaxed) = plan.relaxed()
    {
        way.plan = relaxed;
        result = way.go(last, goal, values, Trust::Any).or(result);
        way.plan = plan;
    }
    let mut outcome = match result {
        Ok(()) => way.test(values, &[]),
        Err(reason) => Outcome {
            status: Status::Stopped(reason),
            unmet: way.test(goal, &[]).unmet,
            notes: Vec::new(),
        },
    };
    outcome.notes.append(&mut buffers.notes);
    outcome.note_spent(&buffers.work);
    // On opening there is nothing to go back to: what could be accepted stands.
    let stands = plan.opens() && matches!(outcome.status, Status::Stopped(Reason::Conflict));
    if !outcome.is_solved() && !stands {
        values.copy_from_slice(came);
    }
    outcome
}

/// Runs a plan for one edit of a state that holds without a way there: in one stride, in which one unknown takes its
/// nearest root, which is allowed where every block of several lies as it did, if the values told where it began. It is
/// for several numbers that are set together: of the many ways from what they were to what they shall be the straight
/// one is no better than others.
///
/// It takes what [`run`] does, and leaves `values` as they came where it does not arrive.
pub fn leap(
    plan: &Plan,
    runner: &mut Runner,
    x0: &[f64],
    values: &mut [f64],
    changed: &[SlotIndex],
    host: &mut dyn Host,
) -> Outcome {
    start(plan, runner, x0, changed, Begins::Edit);
    let Runner { frame, buffers, trial, .. } = runner;
    measure_what_is_set(plan, frame, values, changed);
    let last = frame.x0.clone();
    let mut way = Way { plan, frame, buffers, host, trial, part: Part::Whole, until: u64::MAX };
    let mut outcome = if way.leaps(&last, values) {
        way.test_trial(&[])
    } else {
        Outcome { status: Status::Stopped(Reason::Conflict), unmet: Vec::new(), notes: Vec::new() }
    };
    if outcome.is_solved() {
        values.copy_from_slice(trial);
    }
    outcome.note_spent(&buffers.work);
    outcome
}

/// A drag: from the press to the release, one wish after the other.
///
/// The result depends on the state at the press, the present wish and the branch, not on how many
/// wishes came between.
#[derive(Debug)]
pub struct Drag {
    runner: Runner,
    slice: Rc<Slice>,
    /// The relations that the drag cannot change and that do not hold.
    upstream: Vec<Unmet>,
    /// True if all that is not downstream has run, and stands in the branch.
    has_run: bool,
    /// True if the last wish changed nothing but what is downstream.
    moved_slice: bool,
    /// The last state in which every accepted row held: where the branch is followed from.
    branch: Vec<f64>,
    /// False until a state was seen in which everything required holds.
    has_branch: bool,
    /// True if every equation holds in the present state.
    is_met: bool,
    /// True while the branch is followed from a state that leans: the press, a little aside.
    leans: bool,
    /// True if the last wish could not be met: the present state is as near to it as the hard rows allow, and
    /// the next one is come near to from there.
    is_near: bool,
    /// True if the last wish was left on the way to it: that cost too much.
    is_cut: bool,
    now: Vec<f64>,
}

impl Drag {
    /// Begins a drag at the press, in state `x0`, which moves the known slots `inputs`.
    pub fn begin(plan: &Plan, x0: &[f64], inputs: &[SlotIndex]) -> Self {
        Self::by(Runner::new(), plan, x0, inputs)
    }

    fn by(mut runner: Runner, plan: &Plan, x0: &[f64], inputs: &[SlotIndex]) -> Self {
        start(plan, &mut runner, x0, &[], Begins::Edit);
        let slice = plan.slice(inputs);
        let Runner { frame, buffers, .. } = &mut runner;
        let mut is_met = plan.is_met_at(&frame.x0);
        let has_branch = is_met || required_rows_held(plan, frame, buffers);
        if is_met {
            frame.held.fill(Cell::new(Held::Yes));
        } else {
            is_met = has_branch && frame.held.iter().all(|held| held.get() == Held::Yes);
            if is_met {
                plan.note_met_at(frame.x0.clone());
            }
        }
        // what is not downstream rests where everything holds: it need not run
        let rests = slice.is_held && is_met;
        let has_run = rests && slice.restless.iter().all(|&s| stands(plan, s, &frame.x0));
        if has_run {
            buffers.motion.clear();
            buffers.motion.resize(frame.x0.len(), Motion::Still);
        }
        let branch = frame.x0.clone();
        Self {
            runner,
            slice,
            upstream: Vec::new(),
            has_run,
            moved_slice: false,
            now: branch.clone(),
            branch,
            has_branch,
            is_met,
            leans: false,
            is_near: false,
            is_cut: false,
        }
    }

    /// Ends the drag: another that begins where this one ended need not test what held there.
    pub fn end(self, plan: &Plan) {
        if self.is_met {
            plan.note_met_at(self.now);
        }
    }

    /// Says which way the state at the press leans where two branches meet.
    pub fn lean(&mut self, plan: &Plan, leans: &[Lean]) {
        if leans.is_empty() {
            return;
        }
        let Runner { frame, buffers, .. } = &mut self.runner;
        fork::lean(plan, frame, buffers, leans, &mut self.branch);
        buffers.sides.clear();
        self.leans = true;
        // what is not downstream is to have its bits back
        self.has_run = false;
    }

    /// Goes on from another state, which another plan's drag came to: what this plan does not find is as it was at
    /// the press.
    ///
    /// # Panics
    /// If it has not as many slots.
    pub fn stand_at(&mut self, plan: &Plan, state: &[f64]) {
        self.branch.copy_from_slice(&self.runner.frame.x0);
        for slot in plan.targets().chain(self.slice.inputs.iter().copied()) {
            self.branch[slot as usize] = state[slot as usize];
        }
        self.now.copy_from_slice(&self.branch);
        self.has_branch = false;
        self.is_met = false;
        self.leans = false;
        self.is_near = false;
        // what the drag does not move has to be computed again from here
        self.run_anew();
    }

    /// Returns the states from which least change was measured anew on the way to where it stands, in order.
    pub fn anchors(&self) -> &[Vec<f64>] {
        &self.runner.frame.anchors
    }

    /// Measures least change from where another plan's drag in the same system has measured it.
    pub fn measure_from(&mut self, anchors: Vec<Vec<f64>>) {
        self.runner.frame.anchors = anchors;
    }

    /// Lets everything run at the next wish, what the drag does not move as well.
    pub fn run_anew(&mut self) {
        self.has_run = false;
        self.upstream.clear();
    }

    /// Returns true if a state was seen in which everything required holds.
    pub fn holds(&self) -> bool {
        self.has_branch
    }

    /// Returns true if the last wish was left on the way to it, since that cost too much: the next goes on from there.
    pub fn is_cut(&self) -> bool {
        self.is_cut
    }

    /// Returns the present state.
    pub fn values(&self) -> &[f64] {
        &self.now
    }

    /// Returns the texts that the drag may write.
    pub fn texts(&self) -> &[SlotIndex] {
        &self.slice.texts
    }

    /// Returns the slots that the last wish may have changed, where they are not all.
    pub fn moved(&self) -> Option<&[SlotIndex]> {
        self.moved_slice.then_some(&self.slice.targets[..])
    }

    /// Follows a wish that is near.
    fn follow_on(
        &mut self,
        plan: &Plan,
        targets: &[f64],
        until: u64,
        host: &mut dyn Host,
    ) -> Outcome {
        let Self { slice, branch, now, .. } = self;
        let Runner { frame, buffers, goal, trial, .. } = &mut self.runner;
        goal.clear();
        goal.extend_from_slice(branch);
        for (&slot, &target) in slice.inputs.iter().zip(targets) {
            goal[slot as usize] = target;
        }
        let is_safe = self.has_branch && plan.has_branches;
        let trust = if is_safe { Trust::Branch } else { Trust::Any };
        if !is_safe {
            buffers.sides.clear();
        }
        let part = if self.has_run { Part::Downstream(slice) } else { Part::Whole };
        self.moved_slice = self.has_run;
        let mut way = Way { plan, frame, buffers, host, trial, part, until };
        let mut outcome;
        while trust == Trust::Branch && way.take_back(slice, branch, goal) {}
        let anchors = way.frame.anchors.len();
        let mut direct = way.direct(branch, goal, trust);
        // where nothing held, a surplus row may hold on another root
        let is_rough = trust == Trust::Any && !self.has_branch;
        if direct.is_ok() && is_rough && way.is_broken() && way.search(branch, goal).is_err() {
            direct = way.direct(branch, goal, trust);
        }
        match direct {
            Ok(()) => {
                outcome = way.test_trial(&self.upstream);
                if self.has_branch && !outcome.is_solved() && way.goes_beside(branch, goal) {
                    outcome = way.test_trial(&[]);
                    self.moved_slice = false;
                }
                if outcome.is_solved() {
                    if !self.has_run {
                        let upstream =
                            |u: &&Unmet| slice.relations.binary_search(&u.relation).is_err();
                        self.upstream = outcome.unmet.iter().filter(upstream).copied().collect();
                        self.has_run = true;
                    }
                    std::mem::swap(way.trial, now);
                    branch.copy_from_slice(now);
                    way.rest_at(now);
                    self.has_branch = true;
                    self.leans = false;
                    self.is_near = false;
                }
            }
            Err(failure) => {
                let mut limit = branch.clone();
                let fraction = way.walk_near(&mut limit, goal, trust);
                self.leans &= fraction == 0.0;
                if self.leans {
                    limit.clone_from(&way.frame.x0);
                }
                let passed = [&branch[..], &limit];
                let approached = fraction < 1.0
                    && (self.is_near && way.comes_near(now, passed, goal, &failure, trust)
                        || way.comes_near(&limit, passed, goal, &failure, trust));
                self.is_near = approached;
                let is_left = fraction < 1.0 && !approached;
                let searched = is_left && is_rough && way.search(branch, goal).is_ok()
                    || fraction == 1.0 && way.goes_beside(branch, goal);
                // from here on nothing is known to hold because of how it was computed
                way.part = Part::Whole;
                if approached || searched {
                    // the branch is followed from where it was
                    way.frame.anchors.truncate(anchors);
                    outcome = way.test_trial(&[]);
                    if outcome.is_solved() {
                        std::mem::swap(way.trial, now);
                        if searched {
                            branch.copy_from_slice(now);
                            self.has_branch = true;
                        }
                    }
                } else {
                    outcome = way.stop(&mut limit, goal, trust, fraction, failure);
                    // a state that breaks something is none to stand in, where one is known that does not
                    if !(self.has_branch && outcome.status == Status::Stopped(Reason::Conflict)) {
                        if !self.leans {
                            branch.copy_from_slice(&limit);
                        }
                        now.copy_from_slice(&limit);
                    }
                }
                // a region that was approached is not downstream alone
                self.has_run = false;
                self.moved_slice = false;
            }
        }
        let was_measured_anew = !way.frame.anchors.is_empty() && outcome.is_solved();
        if was_measured_anew && now == branch && way.measure_from_press(branch) {
            // the branch is followed by the measure that it has
            let nearer = way.test_trial(&self.upstream);
            if nearer.is_solved() {
                outcome = nearer;
                std::mem::swap(way.trial, now);
            }
        }
        if !outcome.is_solved() && slice.has_host {
            // the host's texts follow the state that stands; a failure here says nothing new
            way.part = Part::Whole;
            let _ = way.direct(now, now, trust);
        }
        self.is_met = outcome.is_solved() && outcome.unmet.is_empty();
        outcome.notes.append(&mut buffers.notes);
        outcome.note_spent(&buffers.work);
        outcome
    }
}

/// Returns true if a step that runs even where everything holds changes no bit.
fn stands(plan: &Plan, step: u32, x0: &[f64]) -> bool {
    let step = &plan.steps()[step as usize];
    let is = |value: f64| x0[step.targets[0] as usize].to_bits() == value.to_bits();
    match &step.program {
        Program::Constant(value) => is(*value),
        Program::Copy => is(x0[step.reads[0] as usize]),
        Program::Formulas(..)
        | Program::Inverse(_)
        | Program::Square(_)
        | Program::Least(_)
        | Program::Measure(_)
        | Program::Host { .. } => false,
    }
}

impl Failure {
    /// Returns why a way stopped of which that part was gone.
    fn at(self, fraction: f64) -> Reason {
        match self.reason {
            Reason::Method { .. } => self.reason,
            Reason::Limit { .. }
            | Reason::NoSolution { .. }
            | Reason::NotDecided { .. }
            | Reason::Spent
            | Reason::GivenUp { .. }
            | Reason::Conflict => Reason::Limit { fraction },
        }
    }
}
