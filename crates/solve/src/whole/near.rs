//! Boxes by how near their whole numbers may be to those at the start.

use crate::system::{SlotIndex, Stay};
use expr::Interval;
use std::cmp::Ordering;
use std::rc::Rc;

/// What every slot may be.
pub(crate) type Boxes = Rc<[Interval]>;

/// Where whole numbers should be near to.
pub(crate) struct Near {
    /// Slot, what it should be near to, and whether that is given.
    cells: Vec<(SlotIndex, f64, bool)>,
}

/// How far whole numbers are from those at the start: given ones, then the others.
type Distance = [f64; 2];

/// A box that is to be looked at.
pub(crate) struct Open {
    pub(crate) boxes: Boxes,
    distance: Distance,
    made: usize,
}

impl Near {
    pub(crate) fn new(whole: &[SlotIndex], stays: &[Stay], start: &[f64]) -> Self {
        let cell = |&slot: &SlotIndex| match stays[slot as usize] {
            Stay::Free => (slot, 0.0, false),
            Stay::Given => (slot, start[slot as usize], true),
            Stay::Fixed | Stay::Kept { .. } => (slot, start[slot as usize], false),
        };
        Self { cells: whole.iter().map(cell).collect() }
    }

    /// Returns a distance that no whole numbers in the boxes come below.
    fn distance(&self, boxes: &[Interval]) -> Distance {
        let mut distance = [0.0; 2];
        for &(slot, near, is_given) in &self.cells {
            let away = nearest(boxes[slot as usize], near) - near;
            distance[usize::from(!is_given)] += away * away;
        }
        distance
    }

    /// Returns the open whole number with the fewest values, and the nearest of these; nothing where all
    /// are known.
    pub(crate) fn choice(&self, boxes: &[Interval]) -> Option<(SlotIndex, f64)> {
        let width = |slot: SlotIndex| boxes[slot as usize].high - boxes[slot as usize].low;
        let open = self.cells.iter().filter(|c| width(c.0) > 0.0);
        let (slot, near, _) = open.min_by(|a, b| width(a.0).total_cmp(&width(b.0)))?;
        Some((*slot, nearest(boxes[*slot as usize], *near)))
    }
}

/// Returns the whole number of a box that is nearest to a number, the smaller of two.
fn nearest(own: Interval, near: f64) -> f64 {
    (near - 0.5).ceil().clamp(own.low, own.high)
}

impl Open {
    pub(crate) fn new(boxes: Boxes, near: &Near, made: usize) -> Self {
        let distance = near.distance(&boxes);
        Self { boxes, distance, made }
    }
}

// The greatest is looked at first: the nearest, of these the one made last.
impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        let [a, b] = [self.distance, other.distance];
        let nearer = b[0].total_cmp(&a[0]).then(b[1].total_cmp(&a[1]));
        nearer.then(self.made.cmp(&other.made))
    }
}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}
