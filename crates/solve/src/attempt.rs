//! One attempt: the steps of a plan, run once, from one state to the next.
//!
//! In: the state x0 that bits are kept from, the last state (the branch), new values of known slots.
//! Out: the values, or the step that failed. A step whose reads are as in x0 and whose relations hold
//! there keeps x0's bits.

use crate::block::Workspace;
use crate::least::{Least, LeastScratch};
use crate::lower::{Inverse, Program};
use crate::measure::{Measure, Measured};
use crate::outcome::{Host, Note, Reason};
use crate::plan::{Plan, Step};
use crate::rows::{Point, generic_number};
use crate::slice::Slice;
use crate::square::{Course, Side, Solved, Square, SquareScratch, Trust};
use crate::strip::Portion;
use crate::system::{SlotIndex, Stay};
use crate::test::{Place, TestScratch};
use std::cell::{Cell, OnceCell};

mod backtrack;
pub(crate) mod carry;
pub(crate) mod others;
mod peeled;
mod region;
mod roots;
mod rough;
mod strips;

/// Up to this many unknowns least change is tried by the measure too, whose cost is cubic.
const DENSE: usize = 60;

/// How far a stride may go where least change is hardly the least, in parts of the extent over the number of
/// slots that move, which counts as at most so many: there a branch may end and another begin close by.
const SOFT_STRIDE: f64 = 0.05;
const SOFT_SLOTS: usize = 40;

/// How far apart what lies at one place is taken to be, in parts of the extent: as little as will do.
const APART: [f64; 2] = [1e-3, 0.5];

/// How a slot stands to x0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Motion {
    /// The bits of x0.
    Still,
    /// It had no value in x0, and nothing that it comes from has moved.
    Opened,
    /// Other bits than in x0.
    Moved,
}

/// Buffers that runs share.
#[derive(Clone, Debug, Default)]
pub(crate) struct Buffers {
    pub(crate) work: Workspace,
    pub(crate) out: Vec<f64>,
    pub(crate) square: SquareScratch,
    pub(crate) least: LeastScratch,
    pub(crate) motion: Vec<Motion>,
    /// For every step up to the last that follows a branch, the side on which it does.
    pub(crate) sides: Vec<Side>,
    pub(crate) test: TestScratch,
    /// Where places were and are that carry a step's targets along.
    moves: Vec<carry::Move>,
    /// The regions that were approached.
    pub(crate) approached: Vec<u32>,
    pub(crate) notes: Vec<Note>,
}

/// What does not change during an edit.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frame {
    /// The state when the edit began; slots that are one lie in their middle.
    pub(crate) x0: Vec<f64>,
    /// True if slots that are one lay apart when the edit began.
    pub(crate) are_shared_apart: bool,
    /// The states that least change was measured from anew, each where the branch from the one before ended.
    pub(crate) anchors: Vec<Vec<f64>>,
    /// The measure of every slot.
    pub(crate) scales: Vec<f64>,
    /// For every row, whether it holds in x0.
    pub(crate) held: Vec<Cell<Held>>,
    /// Texts that the edit changed.
    pub(crate) changed_texts: Vec<SlotIndex>,
    /// How many times larger what an edit sets is than what was there of its kind, where that is small beside it.
    pub(crate) growth: f64,
}

/// Whether a row holds in x0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Held {
    /// Nobody has asked yet.
    Unknown,
    Yes,
    No,
}

impl Frame {
    /// Returns true if a row holds in x0, which is found out where it is not known.
    pub(crate) fn holds(&self, plan: &Plan, place: Place, work: &mut Workspace) -> bool {
        let held = &self.held[place.row as usize];
        if held.get() == Held::Unknown {
            let holds = plan.holds(place, &self.x0, work) && !plan.is_parted(place, &self.x0);
            held.set(if holds { Held::Yes } else { Held::No });
        }
        held.get() == Held::Yes
    }
    /// Returns what least change is measured from.
    pub(crate) fn anchor(&self) -> &[f64] {
        self.anchors.last().unwrap_or(&self.x0)
    }
}

/// Which regions are approached instead of met.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Approach {
    /// None.
    Nowhere,
    /// These, by number.
    In(Vec<u32>),
}

/// Why an attempt failed.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Failure {
    pub(crate) reason: Reason,
    /// The region of the failed step.
    pub(crate) region: u32,
}

/// How much of a plan is run.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Part<'a> {
    /// All of it.
    Whole,
    /// What is downstream of a drag; the rest ran before, and nothing that it comes from has changed.
    Downstream(&'a Slice),
}

/// A stride to be taken: from which state, on which branch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Attempt<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) frame: &'a Frame,
    /// The state that the branch is followed from.
    pub(crate) last: &'a [f64],
    pub(crate) trust: Trust,
    pub(crate) part: Part<'a>,
}

impl Attempt<'_> {
    /// Runs the steps once. `values` comes with the last state in it, and the known slots set.
    pub(crate) fn run(
        self,
        values: &mut [f64],
        approach: &Approach,
        buffers: &mut Buffers,
        host: &mut dyn Host,
    ) -> Result<(), Failure> {
        buffers.notes.clear();
        buffers.approached.clear();
        match self.part {
            Part::Whole => {
                begin(self.plan, self.frame, values, buffers);
                if let Some(peeled) = self.plan.peeled()
                    && *approach == Approach::Nowhere
                {
                    return self.rows(peeled, values, buffers, host);
                }
                (0..self.plan.step_count())
                    .try_for_each(|index| self.step(index, values, approach, buffers, host))
            }
            Part::Downstream(slice) => {
                for &slot in &slice.inputs {
                    buffers.motion[slot as usize] = motion(self.frame, values, slot);
                }
                slice
                    .portions
                    .iter()
                    .try_for_each(|p| self.portion(p, values, approach, buffers, host))
            }
        }
    }

    fn portion(
        self,
        portion: &Portion,
        values: &mut [f64],
        approach: &Approach,
        buffers: &mut Buffers,
        host: &mut dyn Host,
    ) -> Result<(), Failure> {
        let strip = match portion {
            Portion::Step(index) => {
                return self.step(*index as usize, values, approach, buffers, host);
            }
            Portion::InTurn(strip) | Portion::Abreast(strip) => strip,
        };
        if *approach != Approach::Nowhere {
            return strip
                .rows
                .iter()
                .try_for_each(|r| self.step(r.step as usize, values, approach, buffers, host));
        }
        let Self { plan, frame, last, trust, part: _ } = self;
        let mut run = Run { plan, frame, last, values, trust, buffers, host, index: 0 };
        match portion {
            Portion::Abreast(_) => run.abreast(strip),
            Portion::Step(_) | Portion::InTurn(_) => run.in_turn(strip),
        }
    }

    fn step(
        self,
        index: usize,
        values: &mut [f64],
        approach: &Approach,
        buffers: &mut Buffers,
        host: &mut dyn Host,
    ) -> Result<(), Failure> {
        let Self { plan, frame, last, trust, part: _ } = self;
        let step = &plan.steps()[index];
        if let Approach::In(regions) = approach
            && regions.contains(&step.region)
            && !matches!(step.program, Program::Host { .. })
        {
            return region::approach_region(plan, frame, step, index, values, buffers);
        }
        Run { plan, frame, last, values, trust, buffers, host, index }.step(step)
    }
}

pub(crate) fn begin(plan: &Plan, frame: &Frame, values: &mut [f64], buffers: &mut Buffers) {
    for &(root, _) in &plan.shares {
        if matches!(plan.slots()[root as usize].stay, Stay::Given(_) | Stay::Kept { .. }) {
            values[root as usize] = frame.x0[root as usize];
        }
    }
    buffers.motion.clear();
    buffers.motion.extend(plan.slots().iter().zip(values.iter().zip(&frame.x0)).map(
        |(slot, (value, start))| match slot.stay {
            Stay::Free => Motion::Opened,
            Stay::Fixed | Stay::Given(_) if value.to_bits() != start.to_bits() => Motion::Moved,
            Stay::Fixed | Stay::Given(_) | Stay::Kept { .. } => Motion::Still,
        },
    ));
    for &text in &frame.changed_texts {
        buffers.motion[text as usize] = Motion::Moved;
    }
}

/// Returns true if a number is not whole. Few slots ask.
#[cold]
fn is_broken(value: f64) -> bool {
    value.fract() != 0.0
}

fn motion(frame: &Frame, values: &[f64], slot: SlotIndex) -> Motion {
    let same = values[slot as usize].to_bits() == frame.x0[slot as usize].to_bits();
    if same { Motion::Still } else { Motion::Moved }
}

struct Run<'a> {
    plan: &'a Plan,
    frame: &'a Frame,
    last: &'a [f64],
    values: &'a mut [f64],
    trust: Trust,
    buffers: &'a mut Buffers,
    host: &'a mut dyn Host,
    index: usize,
}

impl Run<'_> {
    fn step(&mut self, step: &Step) -> Result<(), Failure> {
        let inputs = self.inputs(&step.reads);
        if self.keeps(step, inputs) {
            return Ok(());
        }
        self.compute(step)?;
        self.settle(step, inputs)
    }

    /// Gives the targets of a step that has nothing to do the bits of x0; returns whether it is such a one.
    fn keeps(&mut self, step: &Step, inputs: Motion) -> bool {
        let valued = step.targets.iter().all(|&t| self.plan.slots()[t as usize].stay != Stay::Free);
        let keeps = inputs != Motion::Moved && valued && self.holds_in_x0(step, inputs);
        if keeps {
            for &t in &step.targets {
                self.values[t as usize] = self.frame.x0[t as usize];
                self.buffers.motion[t as usize] = Motion::Still;
            }
        }
        keeps
    }

    /// How what is read stands to x0.
    fn inputs<'r>(&self, reads: impl IntoIterator<Item = &'r SlotIndex>) -> Motion {
        let mut inputs = Motion::Still;
        for &r in reads {
            match self.buffers.motion[r as usize] {
                Motion::Still => {}
                Motion::Opened if inputs == Motion::Still => inputs = Motion::Opened,
                Motion::Opened => {}
                Motion::Moved => {
                    inputs = Motion::Moved;
                    break;
                }
            }
        }
        inputs
    }

    /// Tests and marks what a step has computed.
    fn settle(&mut self, step: &Step, inputs: Motion) -> Result<(), Failure> {
        for &t in &step.targets {
            let slot = &self.plan.slots()[t as usize];
            let value = self.values[t as usize];
            if slot.is_number && (!value.is_finite() || slot.is_discrete && is_broken(value)) {
                return self.fail(step);
            }
            self.buffers.motion[t as usize] = self.outcome(t, inputs);
        }
        Ok(())
    }
    /// How a slot stands to x0 that was computed from what stands so.
    fn outcome(&self, target: SlotIndex, inputs: Motion) -> Motion {
        let slot = &self.plan.slots()[target as usize];
        match slot.stay {
            Stay::Free if inputs != Motion::Moved => Motion::Opened,
            _ if !slot.is_number => Motion::Moved,
            Stay::Free | Stay::Fixed | Stay::Given(_) | Stay::Kept { .. } => {
                motion(self.frame, self.values, target)
            }
        }
    }

    fn fail<T>(&self, step: &Step) -> Result<T, Failure> {
        let reason = Reason::NoSolution { step: self.index as u32 };
        Err(Failure { reason, region: step.region })
    }

    /// Returns true if the step has nothing to do: its relations hold with x0's targets.
    fn holds_in_x0(&mut self, step: &Step, inputs: Motion) -> bool {
        if let Program::Measure(measure) = &step.program {
            for &t in &step.targets {
                self.values[t as usize] = self.frame.x0[t as usize];
            }
            let (x0, scales) = (&self.frame.x0, &self.frame.scales);
            return measure.is_settled(x0, self.values, scales, &mut self.buffers.work);
        }
        if let Program::Least(least) = &step.program {
            let fails = |&row: &u32| self.frame.held[row as usize].get() == Held::No;
            if inputs == Motion::Still && step.rows.iter().any(fails) {
                return false;
            }
            for &t in &step.targets {
                self.values[t as usize] = self.frame.x0[t as usize];
            }
            let Buffers { work, least: scratch, .. } = &mut *self.buffers;
            return least.0.holds_at(self.values, work, scratch);
        }
        if inputs == Motion::Still {
            return match &step.program {
                Program::Constant(_) | Program::Copy => false,
                Program::Formulas(..) | Program::Inverse(_) | Program::Square(_) => {
                    step.rows.iter().all(|&row| {
                        let place = self.plan.place_of(row);
                        self.frame.holds(self.plan, place, &mut self.buffers.work)
                    })
                }
                Program::Host { source, .. } => self.host_holds(step, *source),
                Program::Measure(_) | Program::Least(_) => unreachable!("asked above"),
            };
        }
        for &t in &step.targets {
            self.values[t as usize] = self.frame.x0[t as usize];
        }
        let square = match &step.program {
            Program::Square(square) => square,
            Program::Inverse(inverse) => {
                let row = &inverse.row;
                let work = &mut self.buffers.work;
                let sides = work.run(&row.kernel.sides, &row.arguments, self.values, 2);
                let (left, right) = (sides[0], sides[1]);
                return row.within.is_met_with(left, right, || {
                    work.sway(&row.kernel, &row.arguments, self.values)
                });
            }
            Program::Host { source, .. } => return self.host_holds(step, *source),
            Program::Formulas(pattern, arguments) => {
                let out = self.buffers.work.run(
                    pattern.values(),
                    arguments,
                    self.values,
                    step.targets.len(),
                );
                return step
                    .targets
                    .iter()
                    .zip(out)
                    .all(|(&t, value)| base::number::close(*value, self.frame.x0[t as usize]));
            }
            Program::Constant(_) | Program::Copy | Program::Measure(_) | Program::Least(_) => {
                return false;
            }
        };
        square.holds_at(self.values, &mut self.buffers.work, &mut self.buffers.square)
    }

    /// Returns true if a relation that only the host can test holds with x0's targets, and with them in all slots
    /// that they stand for.
    fn host_holds(&mut self, step: &Step, source: u32) -> bool {
        for &t in &step.targets {
            self.values[t as usize] = self.frame.x0[t as usize];
        }
        let is_target = |root: &SlotIndex| step.targets.contains(root);
        for (slot, root) in self.plan.stood_for.iter().filter(|(_, root)| is_target(root)) {
            self.values[*slot as usize] = self.values[*root as usize];
        }
        self.host.holds(source, self.values)
    }

    fn compute(&mut self, step: &Step) -> Result<(), Failure> {
        match &step.program {
            Program::Constant(value) => self.values[step.targets[0] as usize] = *value,
            Program::Copy => {
                self.values[step.targets[0] as usize] = self.values[step.reads[0] as usize];
            }
            Program::Formulas(pattern, arguments) => {
                let out = self.buffers.work.run(
                    pattern.values(),
                    arguments,
                    self.values,
                    step.targets.len(),
                );
                for (&t, &value) in step.targets.iter().zip(out.iter()) {
                    self.values[t as usize] = value;
                }
            }
            Program::Inverse(inverse) => return self.inverse(step, inverse),
            Program::Square(square) => return self.square(step, square),
            Program::Least(least) => return self.least(step, least),
            Program::Measure(measure) => return self.measure(step, measure),
            Program::Host { source, method } => {
                let out = &mut self.buffers.out;
                out.clear();
                out.extend(step.targets.iter().map(|&t| self.values[t as usize]));
                let result = self.host.compute(*source, *method as usize, self.values, out);
                if let Err(message) = result {
                    let reason = Reason::Method { step: self.index as u32, message };
                    return Err(Failure { reason, region: step.region });
                }
                for (&t, &value) in step.targets.iter().zip(out.iter()) {
                    if self.plan.slots()[t as usize].is_number {
                        self.values[t as usize] = value;
                    }
                }
            }
        }
        Ok(())
    }

    fn start_from_last(&mut self, targets: &[SlotIndex]) {
        for &t in targets {
            self.values[t as usize] = self.last[t as usize];
        }
    }

    fn least(
        &mut self,
        step: &Step,
        (least, measure): &(Least, OnceCell<Measure>),
    ) -> Result<(), Failure> {
        self.start_from_last(&step.targets);
        let (anchor, scales) = (self.frame.anchor(), &self.frame.scales);
        let Buffers { work, least: scratch, .. } = &mut *self.buffers;
        let result = least.solve(anchor, self.values, scales, self.trust, work, scratch);
        let may_compromise = self.trust != Trust::Branch || least.has_soft_rows();
        match result {
            Measured::Least if scratch.reach < f64::INFINITY && self.is_wide(step) => {
                self.fail(step)
            }
            Measured::Least => Ok(()),
            Measured::Failed if self.trust == Trust::Any && self.buckles(step, least) => Ok(()),
            Measured::Failed if may_compromise && step.targets.len() <= DENSE => {
                let make = || Measure::new(&least.block.problem(), &|s| self.plan.kind(s));
                self.measure(step, measure.get_or_init(make))
            }
            Measured::Failed => self.fail(step),
        }
    }

    /// Solves from where a state that no step leads out of to first order goes on, as a straight chain does;
    /// returns false where it is none.
    fn buckles(&mut self, step: &Step, least: &Least) -> bool {
        self.start_from_last(&step.targets);
        let (anchor, scales) = (self.frame.anchor(), &self.frame.scales);
        let Buffers { work, least: scratch, .. } = &mut *self.buffers;
        if !least.buckle(self.values, scales, work, scratch) {
            return false;
        }
        let buckled = self.values.to_vec();
        let mut is_solved = |from: &[f64], values: &mut [f64], trust| {
            least.solve(from, values, scales, trust, work, scratch) == Measured::Least
        };
        if is_solved(anchor, self.values, self.trust) {
            return true;
        }
        // far from there, what is nearest to where it buckles to is found more surely; it counts from x0 again
        self.values.copy_from_slice(&buckled);
        if !is_solved(&buckled, self.values, self.trust) {
            return false;
        }
        let near = self.values.to_vec();
        if !is_solved(anchor, self.values, Trust::Branch) {
            self.values.copy_from_slice(&near);
        }
        true
    }

    /// Returns true if a step goes farther from the last state than one may where least change is hardly the least.
    fn is_wide(&self, step: &Step) -> bool {
        let most =
            SOFT_STRIDE * self.buffers.least.reach / step.targets.len().min(SOFT_SLOTS) as f64;
        let goes_far = |&t: &SlotIndex| {
            let t = t as usize;
            (self.values[t] - self.last[t]).abs() > most * self.frame.scales[t]
        };
        step.targets.iter().any(goes_far)
    }

    fn measure(&mut self, step: &Step, measure: &Measure) -> Result<(), Failure> {
        for k in 0..self.tries(step) {
            self.start_from_last(&step.targets);
            self.scatter(&step.targets, k, 0.25 * f64::from(1u32 << k));
            let Frame { x0, scales, .. } = self.frame;
            let work = &mut self.buffers.work;
            let last = Some(self.last);
            if measure.solve(x0, last, self.values, scales, self.trust, work) == Measured::Least {
                return Ok(());
            }
        }
        if self.trust == Trust::Any && self.measure_apart(step, measure) {
            return Ok(());
        }
        self.fail(step)
    }

    /// Solves from where no direction is nearer than another, as where two places lie at one, or two rows slope
    /// alike: as if it had been a little apart. What is found counts from x0 again, unless all is as near there.
    fn measure_apart(&mut self, step: &Step, measure: &Measure) -> bool {
        let mut from = self.frame.x0.clone();
        let is_found = APART.iter().any(|&reach| {
            self.start_from_last(&step.targets);
            self.scatter(&step.targets, 1, reach);
            for &t in &step.targets {
                from[t as usize] = self.values[t as usize];
            }
            let (scales, work) = (&self.frame.scales, &mut self.buffers.work);
            measure.solve(&from, None, self.values, scales, self.trust, work) == Measured::Least
        });
        if !is_found {
            return false;
        }
        let Frame { x0, scales, .. } = self.frame;
        let found: Vec<f64> = measure.targets().iter().map(|&t| self.values[t as usize]).collect();
        let work = &mut self.buffers.work;
        let near = measure.solve(x0, None, self.values, scales, Trust::Branch, work);
        if near == Measured::Failed {
            for (&t, x) in measure.targets().iter().zip(found) {
                self.values[t as usize] = x;
            }
        }
        true
    }

    /// How often a search may begin elsewhere: only where nothing had a value before.
    fn tries(&self, step: &Step) -> u32 {
        let opening =
            step.targets.iter().all(|&t| self.plan.slots()[t as usize].stay == Stay::Free);
        if opening && self.trust == Trust::Any { 8 } else { 1 }
    }

    fn square(&mut self, step: &Step, square: &Square) -> Result<(), Failure> {
        let ways: &[Trust] = match self.trust {
            Trust::Branch => &[Trust::Branch],
            Trust::Nearest => &[Trust::Nearest, Trust::Leap],
            Trust::Any | Trust::Leap if self.buffers.square.is_hasty && square.is_large() => {
                &[Trust::Any]
            }
            Trust::Any | Trust::Leap => &[Trust::Any, Trust::Leap],
        };
        let is_told =
            self.trust != Trust::Branch && !square.block.is_linear && self.has_start(step);
        for &way in ways {
            self.start_from_last(&step.targets);
            let is_carried = is_told && self.carry(step) > 1;
            let Buffers { work, square: scratch, sides, .. } = &mut *self.buffers;
            let mut start = match is_told && !is_carried {
                true => square.side_of(self.last, work),
                false => Side::default(),
            };
            let side = match way {
                Trust::Branch => {
                    sides.resize(sides.len().max(self.index + 1), Side::default());
                    &mut sides[self.index]
                }
                Trust::Any | Trust::Leap | Trust::Nearest => &mut start,
            };
            let course = Course { last: self.last, trust: way, side };
            match square.solve(course, self.values, &self.frame.scales, work, scratch) {
                Solved::Regular => return Ok(()),
                Solved::Double(slot) => {
                    self.buffers.notes.push(Note::DoubleRoot { slot });
                    return Ok(());
                }
                Solved::Failed => {}
            }
        }
        if self.trust == Trust::Branch && self.goes_doubly(step, square) {
            return Ok(());
        }
        self.fail(step)
    }

    /// Returns true if everything that a step speaks of had a value where the edit began: that tells its side.
    fn has_start(&self, step: &Step) -> bool {
        let slots = self.plan.slots();
        let has_value = |&s: &SlotIndex| slots[s as usize].stay != Stay::Free;
        step.reads.iter().all(has_value) && step.targets.iter().all(has_value)
    }

    /// Goes from a double root to a double root, where there was one when the edit began: two branches lie one on the
    /// other all along, as where a line touches a circle and ends on it, and a state lies on no side.
    fn goes_doubly(&mut self, step: &Step, square: &Square) -> bool {
        let scales = &self.frame.scales;
        let Buffers { work, square: scratch, .. } = &mut *self.buffers;
        let mut is_double = |state: &[f64]| square.is_double(state, scales, work, scratch);
        if square.block.is_linear || !is_double(&self.frame.x0) || !is_double(self.last) {
            return false;
        }
        self.start_from_last(&step.targets);
        let Buffers { work, square: scratch, notes, .. } = &mut *self.buffers;
        let course = Course { last: self.last, trust: Trust::Any, side: &mut Side::default() };
        let solved = square.solve(course, self.values, scales, work, scratch);
        if let Solved::Double(slot) = solved {
            notes.push(Note::DoubleRoot { slot });
        }
        matches!(solved, Solved::Double(_))
    }

    /// Moves the `k`th start of a search; its first begins where it stands.
    fn scatter(&mut self, targets: &[SlotIndex], k: u32, reach: f64) {
        if k == 0 {
            return;
        }
        let point = if k % 2 == 1 { Point::Positive } else { Point::Mixed };
        for &t in targets {
            let by = generic_number(u64::from(t) << 8 | u64::from(k), point);
            self.values[t as usize] += reach * self.frame.scales[t as usize] * by;
        }
    }

    fn inverse(&mut self, step: &Step, inverse: &Inverse) -> Result<(), Failure> {
        let row = &inverse.row;
        let Some(roots) = row.kernel.solved(inverse.argument) else {
            return self.square(step, inverse.fallback());
        };
        let target = step.targets[0] as usize;
        let count = roots.guards.len();
        let has_start = count > 1 && self.trust == Trust::Any && self.has_start(step);
        let mut carried = None;
        if has_start {
            self.start_from_last(&step.targets);
            carried = (self.carry(step) > 0).then(|| self.values[target]);
        }
        let size = count + roots.guards.iter().map(Vec::len).sum::<usize>();
        let Buffers { work, out: now, notes, .. } = &mut *self.buffers;
        work.run(&roots.tape, &row.arguments, self.values, size);
        work.swap_out(now);
        let at = |i: usize| roots.guards[..=i].iter().map(Vec::len).sum::<usize>() + i;
        let mut chosen = Some(0);
        if count > 1 {
            let previous = self.last[target];
            let before = work.run(&roots.tape, &row.arguments, self.last, size);
            let away = |out: &[f64], i: usize, from: f64| (out[at(i)] - from).abs();
            let near = 1e-6 * previous.abs().max(self.frame.scales[target]);
            let mut on_branch = (0..count).filter(|&i| away(before, i, previous) <= near);
            chosen = match (on_branch.next(), on_branch.next()) {
                (Some(one), None) => Some(one),
                (None, _) if self.trust != Trust::Any => None,
                (None | Some(_), _) => {
                    // where the start has roots of its own, it tells beside which of them it lies
                    let is_told = has_start && (0..count).all(|i| before[at(i)].is_finite());
                    let (roots, from) = match carried {
                        Some(carried) => (&now[..], carried),
                        None if is_told => (&before[..], previous),
                        None => (&now[..], previous),
                    };
                    (0..count)
                        .filter(|&i| now[at(i)].is_finite())
                        .min_by(|&a, &b| away(roots, a, from).total_cmp(&away(roots, b, from)))
                }
            };
        }
        if let Some(i) = chosen {
            let end = at(i);
            let start = end - roots.guards[i].len();
            let value = now[end];
            let guarded = roots.guards[i].iter().zip(&now[start..end]).all(|(k, &v)| k.admits(v));
            if guarded && value.is_finite() {
                self.values[target] = value;
                let close = |j: usize| {
                    (now[at(j)] - value).abs() <= 1e-6 * value.abs().max(self.frame.scales[target])
                };
                if (0..count).any(|j| j != i && close(j)) {
                    notes.push(Note::DoubleRoot { slot: step.targets[0] });
                }
                return Ok(());
            }
        }
        self.square(step, inverse.fallback())
    }
}
