//! Echelon form: rows in, pivots out; which rows depend on others, and what is left free.
//!
//! Rows are taken one by one and kept sparse. A row whose remainder cancels is dependent, and the
//! combination of earlier rows that it is can be told. Columns without a pivot are free: any choice of
//! them determines the rest, from the last row back to the first.

use std::collections::{BTreeMap, BTreeSet};

/// What cancels to this part of its terms counts as zero. States are solved to about 1e-12.
const CANCELLED: f64 = 1e-8;
/// A pivot is at least this part of the largest number of its row.
const PIVOT: f64 = 0.1;

/// A sparse row: columns in order, with their coefficients.
pub type Row = Vec<(u32, f64)>;

/// Rows in echelon form.
#[derive(Debug, Default)]
pub struct Echelon {
    rows: Vec<Reduced>,
    row_of_pivot: BTreeMap<u32, u32>,
}

#[derive(Debug)]
struct Reduced {
    pivot: u32,
    /// Scaled to a pivot of one; columns that earlier rows have as pivots do not occur.
    row: Row,
    /// What the row was divided by.
    scale: f64,
    /// How much of which earlier rows was subtracted.
    taken: Vec<(u32, f64)>,
}

/// What became of a row.
#[derive(Clone, PartialEq, Debug)]
pub enum Verdict {
    /// It is independent of the rows before it: it has this number among the independent ones.
    Independent(u32),
    /// It is a combination of these independent rows.
    Dependent(Vec<u32>),
}

impl Echelon {
    /// Adds a row. Of the columns that may be its pivot, `cost` tells which would rather be.
    pub fn add(&mut self, row: &Row, cost: impl Fn(u32) -> u32) -> Verdict {
        let mut work: BTreeMap<u32, (f64, f64)> =
            row.iter().map(|&(c, v)| (c, (v, v.abs()))).collect();
        let mut waiting: BTreeSet<u32> =
            row.iter().filter_map(|(c, _)| self.row_of_pivot.get(c).copied()).collect();
        let mut taken = Vec::new();
        while let Some(r) = waiting.pop_first() {
            let by = &self.rows[r as usize];
            let Some((factor, size)) = work.remove(&by.pivot) else { continue };
            if factor.abs() <= CANCELLED * size {
                continue;
            }
            taken.push((r, factor));
            for &(c, v) in by.row.iter().filter(|e| e.0 != by.pivot) {
                let entry = work.entry(c).or_insert((0.0, 0.0));
                entry.0 -= factor * v;
                entry.1 = entry.1.max((factor * v).abs());
                if let Some(&next) = self.row_of_pivot.get(&c) {
                    waiting.insert(next);
                }
            }
        }
        let left = work.into_iter().filter(|(_, (v, size))| v.abs() > CANCELLED * size);
        let left: Row = left.map(|(c, (v, _))| (c, v)).collect();
        let largest = left.iter().fold(0.0f64, |m, e| m.max(e.1.abs()));
        let pivot = left
            .iter()
            .filter(|e| e.1.abs() >= PIVOT * largest)
            .min_by_key(|e| (cost(e.0), e.0))
            .copied();
        let Some((pivot, scale)) = pivot else { return Verdict::Dependent(self.spread(&taken)) };
        let number = self.rows.len() as u32;
        let row = left.into_iter().map(|(c, v)| (c, v / scale)).collect();
        self.rows.push(Reduced { pivot, row, scale, taken });
        self.row_of_pivot.insert(pivot, number);
        Verdict::Independent(number)
    }

    /// Returns how many rows are independent.
    pub fn rank(&self) -> usize {
        self.rows.len()
    }

    /// Returns true if the column is the pivot of a row.
    pub fn has_pivot(&self, column: u32) -> bool {
        self.row_of_pivot.contains_key(&column)
    }

    /// Tells a combination of reduced rows as one of the rows that were added.
    fn spread(&self, taken: &[(u32, f64)]) -> Vec<u32> {
        let mut weight: BTreeMap<u32, (f64, f64)> =
            taken.iter().map(|&(r, f)| (r, (f, f.abs()))).collect();
        let mut rows = Vec::new();
        while let Some((r, (w, size))) = weight.pop_last() {
            if w.abs() <= CANCELLED * size {
                continue;
            }
            rows.push(r);
            let reduced = &self.rows[r as usize];
            let share = w / reduced.scale;
            for &(k, f) in &reduced.taken {
                let entry = weight.entry(k).or_insert((0.0, 0.0));
                entry.0 -= share * f;
                entry.1 = entry.1.max((share * f).abs());
            }
        }
        rows.reverse();
        rows
    }

    /// Computes the pivots that go with a choice of the free columns.
    pub fn complete(&self, free: &[(u32, f64)]) -> Row {
        let mut made: BTreeMap<u32, f64> = free.iter().copied().collect();
        for reduced in self.rows.iter().rev() {
            let (mut sum, mut size) = (0.0, 0.0f64);
            for &(c, v) in reduced.row.iter().filter(|e| e.0 != reduced.pivot) {
                if let Some(x) = made.get(&c) {
                    sum -= v * x;
                    size = size.max((v * x).abs());
                }
            }
            if sum.abs() > CANCELLED * size {
                made.insert(reduced.pivot, sum);
            }
        }
        made.into_iter().filter(|e| e.1 != 0.0).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first(_: u32) -> u32 {
        0
    }

    #[test]
    fn a_dependent_row_tells_the_rows_that_it_is_made_of() {
        let mut e = Echelon::default();
        let rows: [Row; 3] = [vec![(0, 1.0), (1, 2.0)], vec![(1, 1.0), (2, -1.0)], vec![(3, 1.0)]];
        for row in &rows {
            assert!(matches!(e.add(row, first), Verdict::Independent(_)));
        }
        // row 0 twice, and row 1
        let sum = vec![(0, 2.0), (1, 5.0), (2, -1.0)];
        assert_eq!(e.add(&sum, first), Verdict::Dependent(vec![0, 1]));
        assert_eq!(e.add(&vec![(3, 7.0)], first), Verdict::Dependent(vec![2]));
        assert_eq!(e.rank(), 3);
    }

    #[test]
    fn the_free_columns_determine_the_others() {
        let mut e = Echelon::default();
        // a + b = 0, b + c = 0, with the last column as pivot of the first row
        e.add(&vec![(0, 1.0), (1, 1.0)], |c| 1 - c);
        e.add(&vec![(1, 1.0), (2, 1.0)], first);
        let free: Vec<u32> = (0..3).filter(|&c| !e.has_pivot(c)).collect();
        assert_eq!(free.len(), 1);
        let motion = e.complete(&[(free[0], 1.0)]);
        let of = |c: u32| motion.iter().find(|m| m.0 == c).map_or(0.0, |m| m.1);
        assert_eq!((of(0), of(1), of(2)), (of(2), -of(2), of(2)));
        assert_ne!(of(2), 0.0);
    }

    #[test]
    fn an_empty_row_depends_on_nothing() {
        assert_eq!(Echelon::default().add(&Row::new(), first), Verdict::Dependent(Vec::new()));
    }
}
