//! Points that coincide: which names are one point, and where that is.

use drawing::Point;
use std::collections::BTreeMap;

/// Points closer than this part of the drawing's extent are one.
const CLOSE: f64 = 1e-7;

/// The points of a drawing, by cells of a grid.
pub(crate) struct Merging {
    cell: f64,
    /// For each cell the points in it, by number.
    cells: BTreeMap<(i64, i64), Vec<usize>>,
    found: Vec<(Point, Vec<String>)>,
}

impl Merging {
    /// Makes one for points within this extent.
    pub(crate) fn of(all: impl Iterator<Item = Point>) -> Self {
        let extent = all.map(|p| p.x.abs().max(p.y.abs())).fold(0.0, f64::max);
        let cell = if extent > 0.0 { CLOSE * extent } else { 1.0 };
        Self { cell, cells: BTreeMap::new(), found: Vec::new() }
    }

    /// Takes in a point by its name; returns where it is: where the first one was that is as good as there.
    pub(crate) fn take(&mut self, p: Point, name: String) -> Point {
        let at = |x: f64| (x / self.cell).floor() as i64;
        let (x, y) = (at(p.x), at(p.y));
        let around = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y)));
        let near = around.filter_map(|cell| self.cells.get(&cell)).flatten().copied();
        let is_close = |q: Point| (q.x - p.x).abs() <= self.cell && (q.y - p.y).abs() <= self.cell;
        let known = near.filter(|&i| is_close(self.found[i].0)).min();
        match known {
            Some(i) => {
                self.found[i].1.push(name);
                self.found[i].0
            }
            None => {
                self.cells.entry((x, y)).or_default().push(self.found.len());
                self.found.push((p, vec![name]));
                p
            }
        }
    }

    /// Returns the names of each point that has several, in the order in which they were taken in.
    pub(crate) fn groups(&self) -> impl Iterator<Item = &[String]> {
        self.found.iter().map(|(_, names)| names.as_slice()).filter(|names| names.len() > 1)
    }
}
