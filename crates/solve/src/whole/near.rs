//! Boxes by how near their whole numbers may be to those at the start.

use crate::moved::Extents;
use crate::system::{Slot, SlotIndex, Stay};
use expr::Interval;
use std::cmp::Ordering;
use std::rc::Rc;

/// What every slot may be.
pub(crate) type Boxes = Rc<[Interval]>;

/// Where whole numbers should be near to.
pub(crate) struct Near {
    cells: Vec<Cell>,
}

/// A whole number.
struct Cell {
    slot: SlotIndex,
    /// What it should be near to, and whether that is given.
    near: f64,
    is_given: bool,
    extent: f64,
}

/// How far whole numbers are from those at the start, squared, in parts of their extent: given ones, then the
/// others.
type Distance = [f64; 2];

/// A box that is to be looked at.
pub(crate) struct Open {
    pub(crate) boxes: Boxes,
    pub(crate) distance: Distance,
    made: usize,
}

impl Near {
    pub(crate) fn new(whole: &[SlotIndex], slots: &[Slot], start: &[f64]) -> Self {
        let extents = Extents::of(slots, start);
        let cell = |&slot: &SlotIndex| {
            let own = &slots[slot as usize];
            let near = if own.stay == Stay::Free { 0.0 } else { start[slot as usize] };
            Cell { slot, near, is_given: own.stay == Stay::Given, extent: extents.at(own) }
        };
        Self { cells: whole.iter().map(cell).collect() }
    }

    /// Returns a distance that no whole numbers in the boxes come below.
    fn distance(&self, boxes: &[Interval]) -> Distance {
        let mut distance = [0.0; 2];
        for cell in &self.cells {
            let away = nearest(boxes[cell.slot as usize], cell.near) - cell.near;
            let part = away / cell.extent;
            distance[usize::from(!cell.is_given)] += part * part;
        }
        distance
    }

    /// Returns the open whole number with the fewest values, and the nearest of these; nothing where all
    /// are known.
    pub(crate) fn choice(&self, boxes: &[Interval]) -> Option<(SlotIndex, f64)> {
        let width = |slot: SlotIndex| boxes[slot as usize].high - boxes[slot as usize].low;
        let open = self.cells.iter().filter(|c| width(c.slot) > 0.0);
        let cell = open.min_by(|a, b| width(a.slot).total_cmp(&width(b.slot)))?;
        Some((cell.slot, nearest(boxes[cell.slot as usize], cell.near)))
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
