//! Centres: one place as far from three known ones, where how far that is is unknown as well.
//!
//! In: a block of three such rows. Out: the place and the distance, in place. The differences of their squares are
//! linear, so that there is one solution alone, though it comes from the infinite where the three lie on a line.

use super::{Square, SquareScratch};
use crate::block::Workspace;
use crate::system::SlotIndex;
use base::number::hypot;

/// The sine of the angle between two ways below which three places lie on a line.
const FLAT: f64 = 1e-9;

/// What a row says: the place that is so far from a known one.
struct Row {
    place: [SlotIndex; 2],
    from: [SlotIndex; 2],
    distance: SlotIndex,
}

impl Square {
    /// Solves the block if it is such a one; nothing is changed where it is none or its places lie on a line.
    pub(super) fn solve_center(
        &self,
        values: &mut [f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        if self.block.height() != 3 || self.block.unknowns.len() != 3 {
            return false;
        }
        let [Some(a), Some(b), Some(c)] = [0, 1, 2].map(|row| self.distance_row(row)) else {
            return false;
        };
        let is_alike = |r: &Row| r.place == a.place && r.distance == a.distance;
        if !is_alike(&b) || !is_alike(&c) {
            return false;
        }
        let at = |slot: SlotIndex| values[slot as usize];
        let way = |r: &Row| [0, 1].map(|i| at(r.from[i]) - at(a.from[i]));
        let ([p, q], [u, v]) = (way(&b), way(&c));
        let (first, second) = (hypot(p, q), hypot(u, v));
        let area = p * v - q * u;
        if area.abs() <= FLAT * first * second || !area.is_finite() {
            return false;
        }
        let (first, second) = (0.5 * first * first, 0.5 * second * second);
        let by = [(first * v - second * q) / area, (second * p - first * u) / area];
        let slots = [a.place[0], a.place[1], a.distance].map(|slot| slot as usize);
        let sign = if values[slots[2]] < 0.0 { -1.0 } else { 1.0 };
        let found = [at(a.from[0]) + by[0], at(a.from[1]) + by[1], sign * hypot(by[0], by[1])];
        let before = slots.map(|slot| values[slot]);
        (0..3).for_each(|i| values[slots[i]] = found[i]);
        let holds = self.holds_at(values, w, s);
        if !holds {
            (0..3).for_each(|i| values[slots[i]] = before[i]);
        }
        holds
    }

    /// Reads a row that says how far a place lies from a known one.
    fn distance_row(&self, row: usize) -> Option<Row> {
        let (kernel, arguments) = self.block.row(row);
        let is_unknown =
            |&a: &u32| self.block.unknowns.binary_search(&arguments[a as usize]).is_ok();
        let unknown: Vec<u32> = (0..arguments.len() as u32).filter(is_unknown).collect();
        let &[a, b, c] = &unknown[..] else { return None };
        let slot = |argument: u32| arguments[argument as usize];
        [([a, b], c), ([a, c], b), ([b, c], a)].into_iter().find_map(|(place, distance)| {
            let round = kernel.curve(place)?.round?;
            let is_known = !round.center.iter().any(|a| unknown.contains(a));
            let (mut place, mut from) = (place.map(slot), round.center.map(slot));
            if place[0] > place[1] {
                place.reverse();
                from.reverse();
            }
            let row = Row { place, from, distance: slot(distance) };
            (round.radius == distance && is_known).then_some(row)
        })
    }
}
