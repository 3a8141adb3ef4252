//! Elimination: rows in, their pivots and what they depend on out.
//!
//! A fully reduced tableau of sparse rows: every accepted row has a pivot column that no other row
//! contains. The history of the elimination is kept, so that the combination of accepted rows that
//! a dependent row is can be told exactly. Cancellation to 1e-9 of what was subtracted counts as
//! zero: coefficients are taken at a generic point, where nothing vanishes by accident.

use crate::echelon::Row;
use crate::number::{Number, Sum};
use std::cell::Cell;
use std::collections::BTreeMap;

/// What cancels to this part of its terms is zero.
const CANCELLED: f64 = 1e-9;
/// Of what cancels to a part between these, rounding may decide whether it is zero.
const DOUBTFUL: std::ops::Range<f64> = 1e-12..1e-6;

/// A row reduced by the accepted ones.
#[derive(Clone, Debug)]
pub(crate) struct Reduced<N> {
    /// What is left of it.
    pub(crate) row: Row<N>,
    /// How much of each accepted row was subtracted, as the rows stand now.
    multipliers: Row<N>,
}

#[derive(Clone, Debug)]
struct Accepted<N> {
    multipliers: Row<N>,
    pivot: N,
    /// How much of this row was then subtracted from each older one.
    back: Row<N>,
}

/// Rows accepted so far.
#[derive(Clone, Debug)]
pub(crate) struct Tableau<N> {
    rows: Vec<Row<N>>,
    history: Vec<Accepted<N>>,
    pivot_of_row: Vec<u32>,
    row_of_pivot: BTreeMap<u32, u32>,
    /// For every column, the rows that may contain it.
    occurrences: BTreeMap<u32, Vec<u32>>,
    /// How many coefficients have been read and written so far.
    work: Cell<usize>,
    is_doubtful: Cell<bool>,
}

impl<N> Default for Tableau<N> {
    fn default() -> Self {
        Self {
            rows: Vec::new(),
            history: Vec::new(),
            pivot_of_row: Vec::new(),
            row_of_pivot: BTreeMap::new(),
            occurrences: BTreeMap::new(),
            work: Cell::new(0),
            is_doubtful: Cell::new(false),
        }
    }
}

impl<N: Number> Tableau<N> {
    /// Returns the row whose pivot a column is.
    pub(crate) fn row_with_pivot(&self, column: u32) -> Option<u32> {
        self.row_of_pivot.get(&column).copied()
    }
    /// Returns an accepted row as it stands, its pivot scaled to one.
    pub(crate) fn row(&self, row: u32) -> &Row<N> {
        &self.rows[row as usize]
    }
    /// Returns how many coefficients of accepted rows have been read and written so far.
    pub(crate) fn work(&self) -> usize {
        self.work.get()
    }
    fn spend(&self, coefficients: usize) {
        self.work.set(self.work.get() + coefficients);
    }
    /// Returns true if rounding may have decided whether something is zero.
    pub(crate) fn is_doubtful(&self) -> bool {
        self.is_doubtful.get()
    }
    /// Returns true if a sum is zero.
    fn vanishes(&self, sum: &Sum<N>) -> bool {
        let is_small = sum.cancels_to(DOUBTFUL.end);
        if is_small && !sum.cancels_to(DOUBTFUL.start) {
            self.is_doubtful.set(true);
        }
        is_small && sum.cancels_to(CANCELLED)
    }
    /// Subtracts from a row whatever accepted rows can take away.
    pub(crate) fn reduce(&self, row: &[(u32, N)]) -> Reduced<N> {
        let mut work: BTreeMap<u32, Sum<N>> = row.iter().map(|&(c, v)| (c, Sum::of(v))).collect();
        let mut multipliers = Vec::new();
        for &(column, value) in row {
            if let Some(r) = self.row_with_pivot(column) {
                multipliers.push((r, value));
                self.spend(self.rows[r as usize].len());
                for &(c, v) in &self.rows[r as usize] {
                    work.entry(c).or_default().add(value.times(v).negated());
                }
            }
        }
        let row = work
            .into_iter()
            .filter(|(c, sum)| !self.vanishes(sum) && !self.row_of_pivot.contains_key(c))
            .map(|(c, sum)| (c, sum.value))
            .collect();
        multipliers.sort_unstable_by_key(|m| m.0);
        Reduced { row, multipliers }
    }
    /// Accepts a reduced row with the pivot chosen among its columns; returns its number.
    pub(crate) fn accept(&mut self, reduced: Reduced<N>, pivot_column: u32) -> u32 {
        let index = self.rows.len() as u32;
        let own = coefficient(&reduced.row, pivot_column);
        let pivot = own.expect("a row has its pivot");
        let mut row = reduced.row;
        N::divide(&mut row, pivot);
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
        let own = coefficient(&self.rows[row as usize], column);
        let pivot = own.expect("a row has its pivot");
        let mut scaled = self.rows[row as usize].clone();
        N::divide(&mut scaled, pivot);
        self.clear_column(column, &scaled, Some(row));
        self.rows[row as usize] = scaled;
        let old = std::mem::replace(&mut self.pivot_of_row[row as usize], column);
        self.row_of_pivot.remove(&old);
        self.row_of_pivot.insert(column, row);
    }
    /// Returns the accepted rows that a row without remainder is a combination of.
    pub(crate) fn circuit(&self, reduced: &Reduced<N>) -> Vec<u32> {
        let own = reduced.multipliers.iter();
        let mut weight: BTreeMap<u32, Sum<N>> = own.map(|&(r, m)| (r, Sum::of(m))).collect();
        let mut circuit = Vec::new();
        for k in (0..self.rows.len() as u32).rev() {
            let step = &self.history[k as usize];
            let mut total = weight.get(&k).copied().unwrap_or_default();
            for &(j, t) in &step.back {
                if let Some(Sum { value, .. }) = weight.get(&j) {
                    total.add(value.times(t).negated());
                }
            }
            if self.vanishes(&total) {
                continue;
            }
            circuit.push(k);
            let share = total.value.over(step.pivot);
            for &(j, m) in &step.multipliers {
                let entry = weight.entry(j).or_default();
                entry.add(share.times(m).negated());
                if self.vanishes(entry) {
                    entry.value = N::ZERO;
                }
            }
        }
        circuit.reverse();
        circuit
    }
    fn clear_column(&mut self, column: u32, by: &Row<N>, except: Option<u32>) -> Row<N> {
        let mut back = Vec::new();
        for r in self.occurrences.get(&column).cloned().unwrap_or_default() {
            let own = coefficient(&self.rows[r as usize], column);
            let Some(factor) = own.filter(|_| Some(r) != except) else { continue };
            let pivot = self.pivot_of_row[r as usize];
            let vanishes = |sum: &Sum<N>| self.vanishes(sum);
            let merged = subtract(&self.rows[r as usize], factor, by, (column, pivot), &vanishes);
            for &(c, _) in by {
                if coefficient(&self.rows[r as usize], c).is_none() {
                    self.occurrences.entry(c).or_default().push(r);
                }
            }
            self.spend(merged.len());
            self.rows[r as usize] = merged;
            back.push((r, factor));
        }
        back.sort_unstable_by_key(|b| b.0);
        back
    }
}

/// Returns a row's coefficient in a column, where it has one.
fn coefficient<N: Number>(row: &Row<N>, column: u32) -> Option<N> {
    row.binary_search_by_key(&column, |e| e.0).ok().map(|i| row[i].1)
}

/// Returns `row - factor * by` without the cleared column; the row's own pivot stays whatever cancels.
fn subtract<N: Number>(
    row: &Row<N>,
    factor: N,
    by: &Row<N>,
    (cleared, pivot): (u32, u32),
    vanishes: &impl Fn(&Sum<N>) -> bool,
) -> Row<N> {
    let mut out = Row::with_capacity(row.len() + by.len());
    let (mut own, mut other) = (row.iter().peekable(), by.iter().peekable());
    loop {
        let a = own.peek().map_or(u32::MAX, |e| e.0);
        let b = other.peek().map_or(u32::MAX, |e| e.0);
        let column = a.min(b);
        if column == u32::MAX {
            return out;
        }
        let mut sum = Sum::default();
        if let Some(&(_, value)) = own.next_if(|e| e.0 == column) {
            sum.add(value);
        }
        if let Some(&(_, value)) = other.next_if(|e| e.0 == column) {
            sum.add(factor.times(value).negated());
        }
        if column == pivot || (column != cleared && !vanishes(&sum)) {
            out.push((column, sum.value));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dependent_row_names_exactly_its_circuit() {
        let mut t = Tableau::default();
        let rows: [Row; 4] = [
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
