//! How far a state lies from the one in which an edit began.
//!
//! Each number counts in parts of the extent of what is measured alike: the largest of those that had a value.

use crate::system::{Slot, Stay, TRUTH};

/// The sums of squared ways: that of numbers that the document gives, of those that a class gives, then that of all
/// others that had a value.
pub type Moved = [f64; 3];

/// For every class of what is measured alike, the largest size at the start; 1 where there is none.
#[derive(Clone, Debug)]
pub(crate) struct Extents(Vec<f64>);

impl Extents {
    pub(crate) fn of(slots: &[Slot], start: &[f64]) -> Self {
        let classes = slots.iter().map(|s| s.scale as usize + 1).max().unwrap_or(0);
        let mut extents = vec![0.0_f64; classes];
        for (slot, from) in slots.iter().zip(start).filter(|(s, _)| had_value(s)) {
            let extent = &mut extents[slot.scale as usize];
            *extent = extent.max(from.abs());
        }
        extents.iter_mut().filter(|e| **e == 0.0).for_each(|e| *e = 1.0);
        Self(extents)
    }
    /// Returns the extent of what is measured as a slot is.
    pub(crate) fn at(&self, slot: &Slot) -> f64 {
        self.0[slot.scale as usize]
    }
}

/// Measures how far the numbers of slots that an edit may move lie from where they were. What is true or not goes no
/// way: it follows numbers, not they it.
pub fn moved(slots: &[Slot], start: &[f64], values: &[f64]) -> Moved {
    let extents = Extents::of(slots, start);
    let mut moved = [0.0; 3];
    let ways = slots.iter().zip(start.iter().zip(values));
    for (slot, (from, to)) in ways.filter(|(s, _)| had_value(s) && s.scale != TRUTH) {
        let part = (to - from) / extents.at(slot);
        moved[rank(slot.stay)] += part * part;
    }
    moved
}

/// Returns the place among the ways of what is held so.
pub(crate) fn rank(stay: Stay) -> usize {
    match stay {
        Stay::Given(giver) => giver as usize,
        Stay::Fixed | Stay::Kept { .. } | Stay::Free => 2,
    }
}

fn had_value(slot: &Slot) -> bool {
    slot.is_number && matches!(slot.stay, Stay::Given(_) | Stay::Kept { .. })
}
