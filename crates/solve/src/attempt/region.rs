//! Regions: parts in which something gives way, approached as a whole.
//!
//! In: the values so far. Out: those of the region, as near to all that it asks for as can be.

use super::{Buffers, Failure, Frame, Motion, motion};
use crate::lower::Region;
use crate::measure::{Measure, Measured};
use crate::outcome::Reason;
use crate::plan::{Plan, Step};
use crate::square::Trust;
use crate::system::{SlotIndex, Stay};

/// Approaches the region of a step, once.
pub(super) fn approach_region(
    plan: &Plan,
    frame: &Frame,
    step: &Step,
    index: usize,
    values: &mut [f64],
    buffers: &mut Buffers,
) -> Result<(), Failure> {
    if buffers.approached.contains(&step.region) {
        return Ok(());
    }
    buffers.approached.push(step.region);
    let region = &plan.regions()[step.region as usize];
    let refused = || {
        let reason = Reason::NoSolution { step: index as u32 };
        Err(Failure { reason, region: step.region })
    };
    if !region.is_within_reach() {
        return refused();
    }
    let make = || Box::new(Measure::new(&region.problem, &|s| plan.kind(s)));
    let measure = region.approach.get_or_init(make);
    if keeps_region(plan, frame, measure, region, values, buffers) {
        return Ok(());
    }
    let work = &mut buffers.work;
    let result = measure.solve(&frame.x0, None, values, &frame.scales, Trust::Any, work);
    if result == Measured::Failed {
        return refused();
    }
    for &u in measure.targets() {
        buffers.motion[u as usize] = motion(frame, values, u);
    }
    Ok(())
}

/// Gives a region the bits of x0 where nothing that it reads has moved and it cannot come nearer; returns whether
/// that is so.
fn keeps_region(
    plan: &Plan,
    frame: &Frame,
    measure: &Measure,
    region: &Region,
    values: &mut [f64],
    buffers: &mut Buffers,
) -> bool {
    let own = &region.problem.unknowns;
    let is_free = |&u: &SlotIndex| plan.slots()[u as usize].stay == Stay::Free;
    let mut read = region.problem.rows.iter().flat_map(|row| row.arguments.iter());
    let has_moved = |slot: &SlotIndex| {
        own.binary_search(slot).is_err() && buffers.motion[*slot as usize] == Motion::Moved
    };
    if own.iter().any(is_free) || read.any(has_moved) {
        return false;
    }
    let now: Vec<f64> = own.iter().map(|&u| values[u as usize]).collect();
    own.iter().for_each(|&u| values[u as usize] = frame.x0[u as usize]);
    let is_kept = measure.is_settled(&frame.x0, values, &frame.scales, &mut buffers.work);
    for (&u, now) in own.iter().zip(now) {
        values[u as usize] = if is_kept { frame.x0[u as usize] } else { now };
        if is_kept {
            buffers.motion[u as usize] = Motion::Still;
        }
    }
    is_kept
}
