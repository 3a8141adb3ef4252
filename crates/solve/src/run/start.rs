//! Where an edit begins: the state that it starts from, how its slots are measured, and what holds there.

use crate::attempt::{Buffers, Frame, Held};
use crate::block::Workspace;
use crate::plan::Plan;
use crate::run::Runner;
use crate::system::{PLAIN, SlotIndex, Stay, System};
use crate::test::{Differing, Place};
use expr::LANES;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::ops::ControlFlow;

/// Slots one after the other whose numbers are measured alike.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Alike {
    /// Where they end.
    pub(crate) end: SlotIndex,
    pub(crate) scale: u16,
    /// True if they are numbers that have a value when an edit begins.
    pub(crate) has_value: bool,
}

impl Alike {
    /// Returns the stretches of slots that are alike.
    pub(crate) fn all(system: &System) -> Vec<Self> {
        let mut stretches: Vec<Self> = Vec::new();
        for (slot, end) in system.slots.iter().zip(1..) {
            let has_value = slot.is_number && slot.stay != Stay::Free;
            match stretches.last_mut() {
                Some(last) if last.scale == slot.scale && last.has_value == has_value => {
                    last.end = end;
                }
                Some(_) | None => stretches.push(Self { end, scale: slot.scale, has_value }),
            }
        }
        stretches
    }
}

/// What is no larger is nothing: rules hold no closer.
const NOTHING: f64 = 1e-9;
/// What is no larger, in parts of what an edit sets of its kind, is small beside it.
const SMALL: f64 = 1e-3;

/// What begins: whether something is set or moved, or what is there is looked at.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Begins {
    Edit,
    Rest,
}

/// Fixes what does not change during the edit.
pub(super) fn start(
    plan: &Plan,
    runner: &mut Runner,
    x0: &[f64],
    changed: &[SlotIndex],
    begins: Begins,
) {
    let Runner { frame, buffers, .. } = runner;
    buffers.least.forget();
    frame.x0.clear();
    frame.x0.extend(x0.iter().map(|&v| if v.is_finite() { v } else { 0.0 }));
    frame.are_shared_apart = share(plan, &mut frame.x0, begins);
    frame.anchors.clear();
    frame.growth = 1.0;
    measure_scales(plan, frame);
    frame.changed_texts.clear();
    frame
        .changed_texts
        .extend(changed.iter().copied().filter(|&c| !plan.slots()[c as usize].is_number));
    buffers.sides.clear();
    frame.held.clear();
    frame.held.resize(plan.system().equations.len(), Cell::new(Held::Unknown));
}

/// Has slots that one stands for begin in their middle: what is nearest to it is nearest to all of them. Only those
/// count that hold as firmly as the one does, and where nothing is edited given numbers alone: of others the first
/// stands. Returns true if some lay apart.
fn share(plan: &Plan, x0: &mut [f64], begins: Begins) -> bool {
    if plan.shares.is_empty() {
        return false;
    }
    let stay = |slot: SlotIndex| plan.slots()[slot as usize].stay;
    let counts = |slot, root| match (stay(slot), stay(root)) {
        (Stay::Given(slot), Stay::Given(root)) => slot == root,
        (Stay::Kept { .. }, Stay::Kept { .. }) => begins == Begins::Edit,
        _ => false,
    };
    let shared = plan.stood_for.iter().copied().filter(|&(slot, root)| counts(slot, root));
    let differs = |&(s, root): &(SlotIndex, SlotIndex)| {
        x0[s as usize].to_bits() != x0[root as usize].to_bits()
    };
    let mut middles: BTreeMap<SlotIndex, (f64, f64)> =
        shared.clone().filter(differs).map(|(_, root)| (root, (x0[root as usize], 1.0))).collect();
    let mut are_apart = false;
    for (slot, root) in shared.clone() {
        if let Some((sum, count)) = middles.get_mut(&root) {
            let x = x0[slot as usize];
            are_apart |= !base::number::close(x, x0[root as usize]);
            (*sum, *count) = (*sum + x, *count + 1.0);
        }
    }
    for (slot, root) in shared {
        if let Some(&(sum, count)) = middles.get(&root) {
            (x0[slot as usize], x0[root as usize]) = (sum / count, sum / count);
        }
    }
    are_apart
}

/// Returns true if every required row holds in x0. Where that is so it is known of the others too.
pub(super) fn required_rows_held(plan: &Plan, frame: &Frame, buffers: &mut Buffers) -> bool {
    if frame.are_shared_apart {
        return false;
    }
    let work = &mut buffers.work;
    let mut differs = |differing: Differing, work: &mut Workspace| {
        let Place { relation, row } = differing.place;
        if plan.is_rounding(differing, &frame.x0, work) {
            return ControlFlow::Continue(());
        }
        frame.held[row as usize].set(Held::No);
        match plan.relation(relation).level.rank() {
            None => ControlFlow::Break(()),
            Some(_) => ControlFlow::Continue(()),
        }
    };
    if plan.each_differing(plan.tests(), &frame.x0, work, &mut differs).is_break() {
        return false;
    }
    let unknown = frame.held.iter().filter(|held| held.get() == Held::Unknown);
    unknown.for_each(|held| held.set(Held::Yes));
    true
}

/// The extent of every class of slots that have a value; at least their size, one where all is nothing, and at
/// least one of what angles are among.
fn measure_scales(plan: &Plan, frame: &mut Frame) {
    let mut ranges = vec![(f64::INFINITY, f64::NEG_INFINITY); plan.scale_classes];
    let mut start = 0;
    for alike in &plan.alike {
        let end = alike.end as usize;
        if alike.has_value {
            let range = &mut ranges[alike.scale as usize];
            let (low, high) = extremes(&frame.x0[start..end]);
            *range = (range.0.min(low), range.1.max(high));
        }
        start = end;
    }
    for (low, high) in &mut ranges {
        let extent = (*high - *low).max(high.abs()).max(low.abs());
        *low = if extent.is_finite() && extent > NOTHING { extent } else { 1.0 };
    }
    // a radian is a turn as long as any, however near to nothing the angles are
    if let Some((extent, _)) = ranges.get_mut(PLAIN as usize).filter(|_| plan.has_angles) {
        *extent = extent.max(1.0);
    }
    frame.scales.clear();
    frame.scales.reserve(plan.slots().len());
    for alike in &plan.alike {
        frame.scales.resize(alike.end as usize, ranges[alike.scale as usize].0);
    }
    plan.shares.iter().for_each(|&(slot, share)| frame.scales[slot as usize] *= share);
}

/// Measures what is small beside what an edit sets by that: it grows so far.
pub(super) fn measure_what_is_set(
    plan: &Plan,
    frame: &mut Frame,
    values: &[f64],
    changed: &[SlotIndex],
) {
    for &slot in changed.iter().filter(|&&slot| plan.slots()[slot as usize].is_number) {
        let more = SMALL * values[slot as usize].abs() / frame.scales[slot as usize];
        if more.is_finite() && more > 1.0 {
            let kind = plan.slots()[slot as usize].scale;
            let alike = frame.scales.iter_mut().zip(plan.slots()).filter(|(_, s)| s.scale == kind);
            alike.for_each(|(scale, _)| *scale *= more / SMALL);
            frame.growth = frame.growth.max(more / SMALL);
        }
    }
}

/// Returns the least and the largest of finite numbers.
fn extremes(numbers: &[f64]) -> (f64, f64) {
    let (some, rest) = numbers.as_chunks::<LANES>();
    let (mut low, mut high) = ([f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
    for numbers in some {
        for lane in 0..LANES {
            let x = numbers[lane];
            low[lane] = if x < low[lane] { x } else { low[lane] };
            high[lane] = if x > high[lane] { x } else { high[lane] };
        }
    }
    let least = low.iter().chain(rest).copied().fold(f64::INFINITY, f64::min);
    let largest = high.iter().chain(rest).copied().fold(f64::NEG_INFINITY, f64::max);
    (least, largest)
}
