//! Gridded places: many that hang together are set on the cells of a grid, each once, beside what it hangs together with.
//!
//! In: a net that is too large for all its drawings to be compared (`linked.rs`). Out: a cell for each place. What is
//! asked of a cell is told by its neighbourhood alone, so that hundreds of places take no time.

use super::linked::{Cell, Net};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Columns and rows of a cell, as whole numbers.
type Spot = [i64; 2];

/// So many places are set at most: around one with thousands beside it every free cell is far.
pub(super) const MOST: usize = 1000;
/// So many columns and rows away from what it hangs together with a place is tried at first.
const NEAR: i64 = 3;
/// What it costs that a part is slanted.
const SLANTED: f64 = 4.0;
/// What it costs that a part passes over a place, or a place lies on a part.
const COVERED: f64 = 24.0;
/// What it costs that a part passes over another.
const CROSSED: f64 = 6.0;
/// What each column and row away from the first costs: rows are filled from above, there and back.
const AWAY: Cell = [0.1, 0.15];

/// Sets places that hang together on cells, in rows of at most so many columns where none is given.
pub(super) fn gridded(net: &Net, columns: f64) -> Vec<Cell> {
    let mut near = vec![BTreeSet::new(); net.given.len()];
    for &[a, b] in &net.links {
        near[a].insert(b);
        near[b].insert(a);
    }
    let is_free = net.given.iter().all(Option::is_none);
    let most = if is_free { columns as i64 } else { i64::MAX };
    let mut sheet = Sheet { at: net.given.clone(), is_free, most, ..Sheet::default() };
    let mut waiting: VecDeque<usize> = VecDeque::new();
    for (place, given) in net.given.iter().enumerate() {
        if let Some(cell) = given {
            sheet.places.insert(spot(*cell), place);
            waiting.push_back(place);
        }
    }
    if waiting.is_empty() {
        let first = net.links.first().map_or(0, |link| link[0]);
        sheet.set(first, &near[first]);
        waiting.push_back(first);
    }
    while let Some(place) = waiting.pop_front() {
        for &next in &near[place] {
            if sheet.at[next].is_none() {
                sheet.set(next, &near[next]);
                waiting.push_back(next);
            }
        }
    }
    sheet.at.into_iter().map(Option::unwrap_or_default).collect()
}

/// The cells that are taken.
#[derive(Default)]
struct Sheet {
    /// Where each place is; nothing for one that is not set yet.
    at: Vec<Option<Cell>>,
    /// What lies on each cell.
    places: BTreeMap<Spot, usize>,
    /// The cells that parts pass over.
    passed: BTreeSet<Spot>,
    /// Nothing is given: cells count from zero, and rows have an end.
    is_free: bool,
    /// The last column.
    most: i64,
}

impl Sheet {
    /// Sets a place where it costs least beside those of `near` that are set.
    fn set(&mut self, place: usize, near: &BTreeSet<usize>) {
        let beside: Vec<Spot> = near.iter().filter_map(|&n| self.at[n].map(spot)).collect();
        let mut reach = NEAR;
        let best = loop {
            if let Some(best) = self.best(&beside, reach) {
                break best;
            }
            reach *= 2;
        };
        self.places.insert(best, place);
        self.at[place] = Some([best[0] as f64, best[1] as f64]);
        for other in beside {
            self.passed.extend(between(best, other));
        }
    }

    /// The free cell that costs least of those so near to what it hangs together with.
    fn best(&self, beside: &[Spot], reach: i64) -> Option<Spot> {
        let around = if beside.is_empty() { &[[0, 0]] } else { beside };
        let mut best: Option<(f64, Spot)> = None;
        for &[column, row] in around {
            for y in row.saturating_sub(reach)..=row.saturating_add(reach) {
                for x in column.saturating_sub(reach)..=column.saturating_add(reach) {
                    let is_out = self.is_free && (x < 0 || y < 0 || x > self.most);
                    if is_out || self.places.contains_key(&[x, y]) {
                        continue;
                    }
                    let cost = self.cost([x, y], beside);
                    if best.is_none_or(|(least, _)| cost < least) {
                        best = Some((cost, [x, y]));
                    }
                }
            }
        }
        best.map(|(_, spot)| spot)
    }

    fn cost(&self, at: Spot, beside: &[Spot]) -> f64 {
        let on_part = if self.passed.contains(&at) { COVERED } else { 0.0 };
        let away = AWAY[0] * at[0].abs() as f64 + AWAY[1] * at[1].abs() as f64;
        let parts = beside.iter().map(|&other| {
            let [dx, dy] = [at[0] - other[0], at[1] - other[1]];
            let slanted = if dx != 0 && dy != 0 { SLANTED } else { 0.0 };
            let over = between(at, other).map(|cell| match self.places.contains_key(&cell) {
                true => COVERED,
                false if self.passed.contains(&cell) => CROSSED,
                false => 0.0,
            });
            (dx.abs() + dy.abs()) as f64 + slanted + over.sum::<f64>()
        });
        on_part + away + parts.sum::<f64>()
    }
}

/// The cells that a part in a row or a column passes over, but for its ends.
fn between(a: Spot, b: Spot) -> impl Iterator<Item = Spot> {
    let is_straight = a[0] == b[0] || a[1] == b[1];
    let long = if is_straight { (a[0] - b[0]).abs() + (a[1] - b[1]).abs() } else { 0 };
    let step = [(b[0] - a[0]).signum(), (b[1] - a[1]).signum()];
    (1..long).map(move |n| [a[0] + n * step[0], a[1] + n * step[1]])
}

/// The cell that a place is on or nearest to.
fn spot(cell: Cell) -> Spot {
    cell.map(|x| x.round() as i64)
}
