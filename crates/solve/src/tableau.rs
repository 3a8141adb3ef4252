//! Elimination: rows in, their pivots and what they depend on out.
//!
//! A fully reduced tableau of sparse rows: every accepted row has a pivot column that no other row
//! contains. The history of the elimination is kept, so that the combination of accepted rows that
//! a dependent row is can be told exactly. Cancellation to 1e-9 of what was subtracted counts as
//! zero: coefficients are taken at a generic point, where nothing vanishes by accident.

use std::collections::BTreeMap;

/// What cancels to this part of its terms is zero.
const CANCELLED: f64 = 1e-9;

/// A sparse row: columns in order, with their coefficients.
pub(crate) type SparseRow = Vec<(u32, f64)>;

/// A row reduced by the accepted ones.
#[derive(Clone, Debug)]
pub(crate) struct Reduced {
    /// What is left of it.
    pub(crate) row: SparseRow,
    /// How much of each accepted row was subtracted, as the rows stand now.
    multipliers: SparseRow,
}

#[derive(Clone, Debug)]
struct Accepted {
    multipliers: SparseRow,
    pivot: f64,
    /// How much of this row was then subtracted from each older one.
    back: SparseRow,
}

/// Rows accepted so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tableau {
    rows: Vec<SparseRow>,
    history: Vec<Accepted>,
    pivot_of_row: Vec<u32>,
    row_of_pivot: BTreeMap<u32, u32>,
    /// For every column, the rows that may contain it.
    occurrences: BTreeMap<u32, Vec<u32>>,
    /// How many coefficients have been written so far.
    work: usize,
}

impl Tableau {
    /// Returns the row whose pivot a column is.
    pub(crate) fn row_with_pivot(&self, column: u32) -> Option<u32> {
        self.row_of_pivot.get(&column).copied()
    }
    /// Returns an accepted row as it stands, its pivot scaled to one.
    pub(crate) fn row(&self, row: u32) -> &SparseRow {
        &self.rows[row as usize]
    }
    /// Returns how many coefficients of accepted rows have been written so far.
    pub(crate) fn work(&self) -> usize {
        self.work
    }
    /// Subtracts from a row whatever accepted rows can take away.
    pub(crate) fn reduce(&self, row: &[(u32, f64)]) -> Reduced {
        let mut work: BTreeMap<u32, (f64, f64)> =
            row.iter().map(|&(c, v)| (c, (v, v.abs()))).collect();
        let mut multipliers = Vec::new();
        for &(column, value) in row {
            if let Some(r) = self.row_with_pivot(column) {
                multipliers.push((r, value));
                for &(c, v) in &self.rows[r as usize] {
                    let entry = work.entry(c).or_insert((0.0, 0.0));
                    entry.0 -= value * v;
                    entry.1 = entry.1.max((value * v).abs());
                }
            }
        }
        let row = work
            .into_iter()
            .filter(|(c, (v, size))| {
                v.abs() > CANCELLED * size && !self.row_of_pivot.contains_key(c)
            })
            .map(|(c, (v, _))| (c, v))
            .collect();
        multipliers.sort_unstable_by_key(|m| m.0);
        Reduced { row, multipliers }
    }
    /// Accepts a reduced row with the pivot chosen among its columns; returns its number.
    pub(crate) fn accept(&mut self, reduced: Reduced, pivot_column: u32) -> u32 {
        let index = self.rows.len() as u32;
        let pivot = coefficient(&reduced.row, pivot_column);
        let row: SparseRow = reduced.row.iter().map(|&(c, v)| (c, v / pivot)).collect();
        let back = self.clear_column(pivot_column, &row, None);
        for &(c, _) in &row {
            self.occurrences.entry(c).or_default().push(index);
        }
        self.rows.push(row);
        self.history.push(Accepted { multipliers: reduced.multipliers, pivot, back });
        self.pivot_of_row.push(pivot_column);
        self.row_of_pivot.insert(pivot_column, index);
        index
    }
    /// Makes another of a row's columns its pivot. Circuits can no longer be asked for afterwards.
    pub(crate) fn exchange(&mut self, row: u32, column: u32) {
        let pivot = coefficient(&self.rows[row as usize], column);
        let scaled: SparseRow =
            self.rows[row as usize].iter().map(|&(c, v)| (c, v / pivot)).collect();
        self.clear_column(column, &scaled, Some(row));
        self.rows[row as usize] = scaled;
        let old = std::mem::replace(&mut self.pivot_of_row[row as usize], column);
        self.row_of_pivot.remove(&old);
        self.row_of_pivot.insert(column, row);
    }
    /// Returns the accepted rows that a row without remainder is a combination of.
    pub(crate) fn circuit(&self, reduced: &Reduced) -> Vec<u32> {
        let mut weight: BTreeMap<u32, (f64, f64)> =
            reduced.multipliers.iter().map(|&(r, m)| (r, (m, m.abs()))).collect();
        let mut circuit = Vec::new();
        for k in (0..self.rows.len() as u32).rev() {
            let step = &self.history[k as usize];
            let mut total = weight.get(&k).copied().unwrap_or((0.0, 0.0));
            for &(j, t) in &step.back {
                if let Some(&(m, _)) = weight.get(&j) {
                    total.0 -= m * t;
                    total.1 = total.1.max((m * t).abs());
                }
            }
            if total.0.abs() <= CANCELLED * total.1 {
                continue;
            }
            circuit.push(k);
            let share = total.0 / step.pivot;
            for &(j, m) in &step.multipliers {
                let entry = weight.entry(j).or_insert((0.0, 0.0));
                entry.0 -= share * m;
                entry.1 = entry.1.max((share * m).abs());
                if entry.0.abs() <= CANCELLED * entry.1 {
                    entry.0 = 0.0;
                }
            }
        }
        circuit.reverse();
        circuit
    }
    fn clear_column(&mut self, column: u32, by: &SparseRow, except: Option<u32>) -> SparseRow {
        let mut back = Vec::new();
        for r in self.occurrences.get(&column).cloned().unwrap_or_default() {
            let factor = coefficient(&self.rows[r as usize], column);
            if Some(r) == except || factor == 0.0 {
                continue;
            }
            let pivot = self.pivot_of_row[r as usize];
            let merged = subtract(&self.rows[r as usize], factor, by, column, pivot);
            for &(c, _) in by {
                if coefficient(&self.rows[r as usize], c) == 0.0 {
                    self.occurrences.entry(c).or_default().push(r);
                }
            }
            self.work += merged.len();
            self.rows[r as usize] = merged;
            back.push((r, factor));
        }
        back.sort_unstable_by_key(|b| b.0);
        back
    }
}

/// Returns a row's coefficient in a column.
pub(crate) fn coefficient(row: &SparseRow, column: u32) -> f64 {
    row.binary_search_by_key(&column, |e| e.0).map_or(0.0, |i| row[i].1)
}

/// Returns `row - factor * by`, with `cleared` exactly absent and `pivot` exactly kept.
fn subtract(row: &SparseRow, factor: f64, by: &SparseRow, cleared: u32, pivot: u32) -> SparseRow {
    let mut out = Vec::with_capacity(row.len() + by.len());
    let (mut i, mut j) = (0, 0);
    while i < row.len() || j < by.len() {
        let a = row.get(i).map_or(u32::MAX, |e| e.0);
        let b = by.get(j).map_or(u32::MAX, |e| e.0);
        let column = a.min(b);
        let mut value = 0.0;
        let mut size = 0.0f64;
        if a == column {
            value = row[i].1;
            size = value.abs();
            i += 1;
        }
        if b == column {
            let term = factor * by[j].1;
            value -= term;
            size = size.max(term.abs());
            j += 1;
        }
        if column == pivot || (column != cleared && value.abs() > CANCELLED * size) {
            out.push((column, value));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dependent_row_names_exactly_its_circuit() {
        let mut t = Tableau::default();
        let rows: [SparseRow; 4] = [
            vec![(0, 1.0), (1, 2.0)],
            vec![(1, 1.0), (2, -1.0)],
            vec![(3, 1.0)],
            vec![(0, 2.0), (1, 5.0), (2, -1.0)],
        ];
        for (row, pivot) in rows[..3].iter().zip([0, 1, 3]) {
            let reduced = t.reduce(row);
            t.accept(reduced, pivot);
        }
        let reduced = t.reduce(&rows[3]);
        assert!(reduced.row.is_empty());
        assert_eq!(t.circuit(&reduced), vec![0, 1]);
    }

    #[test]
    fn an_exchange_keeps_the_span() {
        let mut t = Tableau::default();
        for (row, pivot) in [(vec![(0, 1.0), (1, 1.0)], 0), (vec![(1, 1.0), (2, 1.0)], 2)] {
            let reduced = t.reduce(&row);
            t.accept(reduced, pivot);
        }
        t.exchange(0, 1);
        assert_eq!(t.row_with_pivot(1), Some(0));
        assert_eq!(t.row(1), &vec![(0, -1.0), (2, 1.0)]);
        assert!(t.reduce(&[(0, 1.0), (2, -1.0)]).row.is_empty());
    }
}
