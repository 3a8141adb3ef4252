//! Boxes by how near their whole numbers may be to those at the start.

use crate::moved::Extents;
use crate::system::{Slot, SlotIndex, Stay};
use expr::Interval;
use std::cmp::Ordering;
use std::rc::Rc;

/// What every slot may be.
pub(crate) type Boxes = Rc<[Interval]>;

/// Where whole numbers and given real ones should be near to.
pub(crate) struct Near {
    cells: Vec<Cell>,
}

/// A whole number, or a given real one.
struct Cell {
    slot: SlotIndex,
    is_whole: bool,
    /// What it should be near to, and where in a distance that counts.
    near: f64,
    rank: usize,
    extent: f64,
}

/// How far numbers are from those at the start, squared, in parts of their extent: given ones, the firmest
/// first, then whole ones that had a value, then those that had none, from zero.
type Distance = [f64; 4];

/// A box that is to be looked at.
pub(crate) struct Open {
    pub(crate) boxes: Boxes,
    pub(crate) distance: Distance,
    made: usize,
}

impl Near {
    /// Measures from the start: whole numbers, and `with_reals` given real ones too.
    pub(crate) fn new(
        whole: &[SlotIndex],
        slots: &[Slot],
        start: &[f64],
        with_reals: bool,
    ) -> Self {
        let extents = Extents::of(slots, start);
        let cell = |(slot, own): (SlotIndex, &Slot)| {
            let is_whole = whole.binary_search(&slot).is_ok();
            let rank = match own.stay {
                Stay::Given(giver) => giver as usize,
                Stay::Kept { .. } => 2,
                Stay::Free | Stay::Fixed => 3,
            };
            let near = if rank < 3 { start[slot as usize] } else { 0.0 };
            let counts = is_whole || (with_reals && rank < 2 && own.is_number);
            counts.then(|| Cell { slot, is_whole, near, rank, extent: extents.at(own) })
        };
        Self { cells: (0..).zip(slots).filter_map(cell).collect() }
    }

    /// Returns a distance that no numbers in the boxes come below.
    fn distance(&self, boxes: &[Interval]) -> Distance {
        let mut distance = [0.0; 4];
        for cell in &self.cells {
            let own = boxes[cell.slot as usize];
            let to = if cell.is_whole {
                nearest(own, cell.near)
            } else {
                cell.near.max(own.low).min(own.high)
            };
            let part = (to - cell.near) / cell.extent;
            distance[cell.rank] += part * part;
        }
        distance
    }

    /// Returns the open whole number with the fewest values, and the parts of what it may be; nothing where all are
    /// known. The part that is made last is the one to be looked at first, of equals.
    ///
    /// Where given real numbers are open the parts are halves: how far these have to go says more than how far the
    /// whole number goes.
    pub(crate) fn parts(&self, boxes: &[Interval]) -> Option<(SlotIndex, [Interval; 3])> {
        let width = |slot: SlotIndex| boxes[slot as usize].high - boxes[slot as usize].low;
        let open = self.cells.iter().filter(|c| c.is_whole && width(c.slot) > 0.0);
        let cell = open.min_by(|a, b| width(a.slot).total_cmp(&width(b.slot)))?;
        let own = boxes[cell.slot as usize];
        let first = nearest(own, cell.near);
        let is_open = |c: &Cell| !c.is_whole && width(c.slot) > 0.0;
        if !self.cells.iter().any(is_open) {
            return Some((cell.slot, around(own, first)));
        }
        let middle = (own.low + 0.5 * (own.high - own.low)).floor();
        let below = Interval { low: own.low, high: middle };
        let above = Interval { low: middle + 1.0, high: own.high };
        let [far, near] = if first <= middle { [above, below] } else { [below, above] };
        Some((cell.slot, [Interval::NONE, far, near]))
    }
}

/// Parts an interval of whole numbers at one of them.
fn around(own: Interval, at: f64) -> [Interval; 3] {
    let below = Interval { low: own.low, high: at - 1.0 };
    let above = Interval { low: at + 1.0, high: own.high };
    [above, below, Interval::point(at)]
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
        let pairs = other.distance.iter().zip(&self.distance);
        let nearer = pairs.map(|(b, a)| b.total_cmp(a)).find(|o| o.is_ne());
        nearer.unwrap_or(Ordering::Equal).then(self.made.cmp(&other.made))
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
