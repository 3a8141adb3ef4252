//! Forks: states in which two branches meet, and which way a way goes on from them.
//!
//! In: a plan and a state. Where the core of a block is singular, as where a triangle is flat or a crank
//! at its dead centre, the values do not say on which of the two branches the state lies: both hold
//! to the tolerance of rules. There a [`Lean`] says it: which way a slot goes when the state is left.
//! It is measured along the one direction that the block leaves open to first order, so that neither the
//! order of equations nor the way they are written plays a part.

use crate::attempt::{Buffers, Frame};
use crate::lower::Program;
use crate::plan::Plan;
use crate::square::Square;
use crate::system::{PLAIN, SlotIndex};
use base::number::Toward;

/// How far a state is moved off a fork to look which branch lies there, in units of the extent.
const ASIDE: f64 = 1e-3;

/// How much further each block is moved than the one before it, and the furthest.
const FURTHER: f64 = 4.0;
const MOST_ASIDE: f64 = 0.1;

/// Which way a slot goes from a fork.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Lean {
    /// The slot.
    pub slot: SlotIndex,
    /// Whether it grows or shrinks.
    pub toward: Toward,
}

/// Moves the unknowns of blocks that are at a fork a little aside, the way that is said.
///
/// Only a state to follow a branch from: the rules do not hold in it exactly.
pub(crate) fn lean(
    plan: &Plan,
    frame: &Frame,
    buffers: &mut Buffers,
    leans: &[Lean],
    state: &mut [f64],
) {
    if leans.is_empty() {
        return;
    }
    let fork = state.to_vec();
    let mut by = ASIDE;
    for step in plan.branching() {
        let Some(square) = forking(&step.program) else { continue };
        for lean in leans.iter().filter(|l| step.targets.contains(&l.slot)) {
            let slot = lean.slot as usize;
            let scales = &scales_of(square, plan, frame, &fork, buffers);
            let Buffers { work, square: scratch, .. } = &mut *buffers;
            let Some(open) = square.fork(&fork, scales, work, scratch) else { continue };
            let before = state[slot];
            let whole = state.to_vec();
            square.shift(state, &open, by, scales, work);
            let toward = if state[slot] > before { Toward::More } else { Toward::Less };
            if toward != lean.toward {
                state.copy_from_slice(&whole);
                square.shift(state, &open, -by, scales, work);
            }
            // what comes after, and may follow what was moved, goes past that
            by = (FURTHER * by).min(MOST_ASIDE);
        }
    }
}

/// Returns which way every block leans that is at a fork in `after`, and was not in `before`, or leant there.
///
/// The branch is the one whose orientation is that of the state before. A slot that moves most along the
/// open direction speaks for its block; of several, the first.
pub(crate) fn leaning(
    plan: &Plan,
    frame: &Frame,
    buffers: &mut Buffers,
    leans: &[Lean],
    after: &[f64],
) -> Vec<Lean> {
    let mut before = frame.x0.clone();
    lean(plan, frame, buffers, leans, &mut before);
    let mut found = Vec::new();
    for square in plan.branching().iter().filter_map(|step| forking(&step.program)) {
        let scales = &scales_of(square, plan, frame, after, buffers);
        let Buffers { work, square: scratch, .. } = &mut *buffers;
        let Some(open) = square.fork(after, scales, work, scratch) else { continue };
        let sign = square.orientation(&before, scales, work, scratch);
        let mut lies = |by: f64| {
            let mut aside = after.to_vec();
            square.shift(&mut aside, &open, by, scales, work);
            square.orientation(&aside, scales, work, scratch) == sign
        };
        let aside = match (sign, lies(ASIDE), lies(-ASIDE)) {
            (1 | -1, true, false) => 1.0,
            (1 | -1, false, true) => -1.0,
            _ => continue,
        };
        if let Some(core) = most_open(&open) {
            let toward = if open[core] * aside > 0.0 { Toward::More } else { Toward::Less };
            found.push(Lean { slot: square.slot(core) as SlotIndex, toward });
        }
    }
    found
}

/// Returns for every block that is at a fork in a state two ways to lean, each with the state that lies that way
/// a little aside.
pub(crate) fn asides(
    plan: &Plan,
    frame: &Frame,
    buffers: &mut Buffers,
    state: &[f64],
) -> Vec<[(Lean, Vec<f64>); 2]> {
    let mut found = Vec::new();
    for square in plan.branching().iter().filter_map(|step| forking(&step.program)) {
        let scales = &scales_of(square, plan, frame, state, buffers);
        let Buffers { work, square: scratch, .. } = &mut *buffers;
        let Some(open) = square.fork(state, scales, work, scratch) else { continue };
        let Some(core) = most_open(&open) else { continue };
        let slot = square.slot(core) as SlotIndex;
        let mut aside = |toward: Toward| {
            let by = if (open[core] > 0.0) == (toward == Toward::More) { ASIDE } else { -ASIDE };
            let mut aside = state.to_vec();
            square.shift(&mut aside, &open, by, scales, work);
            (Lean { slot, toward }, aside)
        };
        found.push([aside(Toward::More), aside(Toward::Less)]);
    }
    found
}

/// Returns the extents by which a block is measured in a state: those of the edit, but for plain numbers that are
/// nearly nothing there, as angles of what lies flat.
fn scales_of(
    square: &Square,
    plan: &Plan,
    frame: &Frame,
    state: &[f64],
    buffers: &mut Buffers,
) -> Vec<f64> {
    let mut scales = frame.scales.clone();
    let is_plain = |slot: usize| plan.slots()[slot].scale == PLAIN;
    let Buffers { work, square: scratch, .. } = buffers;
    square.measure_plain(state, &is_plain, &mut scales, work, scratch);
    scales
}

/// Returns which unknown of a core moves most along an open direction; of several, the first.
fn most_open(open: &[f64]) -> Option<usize> {
    let largest = open.iter().fold(0.0_f64, |size, d| size.max(d.abs()));
    open.iter().position(|d| d.abs() > 0.999 * largest)
}

impl Plan {
    /// Returns true if two branches can meet in one of its blocks.
    pub fn may_fork(&self) -> bool {
        self.branching().iter().any(|step| forking(&step.program).is_some())
    }
}

/// Returns the equations of a step that may have several solutions.
pub(crate) fn forking(program: &Program) -> Option<&Square> {
    match program {
        Program::Square(square) => Some(square),
        Program::Inverse(inverse) if inverse.roots() > 1 => Some(inverse.fallback()),
        Program::Inverse(_)
        | Program::Constant(_)
        | Program::Copy
        | Program::Formulas(..)
        | Program::Least(_)
        | Program::Measure(_)
        | Program::Host { .. } => None,
    }
}
