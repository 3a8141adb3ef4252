//! Echelon forms: which rows depend on which, and what motions they leave.
//!
//! In: sparse rows with numbers, doubles or those of a finite field. Out: their rank; for each row that depends on earlier ones, which; and for
//! any choice of the columns that are left free, what the others then are. What is eliminated next is what
//! makes few new entries (Markowitz), so that large sparse rows stay sparse; what depends on what is told in
//! the order in which the rows came all the same.
//!
//! **Source:** Markowitz, *The elimination form of the inverse*, Management Science 3 (1957).

use crate::number::{Number, Sum};
use crate::sparse::pivot::Counts;
use std::collections::BTreeMap;

/// What cancels to this part of its terms counts as zero. States are solved to about 1e-12.
const CANCELLED: f64 = 1e-8;
/// What is smaller than this part of the largest number of its row is rounding: a slope that vanishes
/// where the state is solved.
const ROUNDING: f64 = 1e-12;
/// A pivot is at least this part of the largest number of its row …
const PIVOT: f64 = 0.1;
/// … or this part, where no other row has anything in its column.
const ALONE: f64 = 1e-8;
/// A row with a share below this part of the largest in a sum that vanishes is not told as depending.
const SHARE: f64 = 1e-6;
/// How many rows are looked at for one pivot.
const CANDIDATES: usize = 4;

/// A sparse row: columns in order, with their coefficients.
pub type Row<N = f64> = Vec<(u32, N)>;

/// Rows in echelon form.
#[derive(Clone, Debug)]
pub struct Echelon<N = f64> {
    /// In order of elimination: the row, its pivot's column, and the rest of it where the pivot is one.
    pivots: Vec<(u32, u32, Row<N>)>,
    /// For every column: it is the pivot of a row.
    has_pivot: Vec<bool>,
    /// For every row, how much of which pivots' rows was subtracted.
    taken: Vec<Row<N>>,
    /// Rows of which nothing is left.
    vanished: Vec<u32>,
}

/// A row that is a combination of rows that came before it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Dependent {
    /// The row.
    pub row: u32,
    /// The rows that it is a combination of, in order; none of them depends on others.
    pub circuit: Vec<u32>,
}

/// Rows whose sum vanishes, each so many times.
#[derive(Clone, PartialEq, Debug)]
pub struct Vanishing<N = f64> {
    /// The last of them, there once.
    pub last: u32,
    /// How much of each row there is, in order.
    pub sum: Row<N>,
}

impl<N: Number> Echelon<N> {
    /// Eliminates rows over this many columns.
    pub fn new(rows: &[Row<N>], columns: usize) -> Self {
        let mut rest = Remainder::new(rows, columns);
        while let Some((row, column)) = rest.best() {
            rest.eliminate(row, column);
        }
        rest.out
    }

    /// Returns how many rows are independent.
    pub fn rank(&self) -> usize {
        self.pivots.len()
    }

    /// Returns true if the column is the pivot of a row.
    pub fn has_pivot(&self, column: u32) -> bool {
        self.has_pivot[column as usize]
    }

    /// Returns the rows that are eliminated, each with the column of its pivot.
    pub(crate) fn pivots(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.pivots.iter().map(|&(row, column, _)| (row, column))
    }

    /// Returns the rows of which nothing was left, in the order in which they were found.
    pub(crate) fn vanished(&self) -> &[u32] {
        &self.vanished
    }

    /// Returns the rows that depend on earlier ones.
    pub fn dependent(&self) -> Vec<Dependent> {
        let told = self.vanishing().into_iter().map(|Vanishing { last, sum }| {
            let circuit = sum.iter().map(|e| e.0).filter(|&r| r != last).collect();
            Dependent { row: last, circuit }
        });
        told.collect()
    }

    /// Returns the sums of rows that vanish, each row scaled so that the largest of its numbers is one, in
    /// order of their last rows; the last row of each is in no other.
    pub fn vanishing(&self) -> Vec<Vanishing<N>> {
        let mut reduced: Vec<Vanishing<N>> = Vec::new();
        for &row in &self.vanished {
            let mut own = self.combination(row);
            for other in &reduced {
                take_away(&mut own, other.last, &other.sum);
            }
            let largest = own.iter().fold(0.0f64, |m, e| m.max(e.1.size()));
            let suits = |e: &&(u32, N)| e.1.size() >= SHARE * largest;
            let Some(&(last, value)) = own.iter().rfind(suits) else { continue };
            N::divide(&mut own, value);
            for other in &mut reduced {
                take_away(&mut other.sum, last, &own);
            }
            reduced.push(Vanishing { last, sum: own });
        }
        reduced.sort_unstable_by_key(|v| v.last);
        reduced
    }

    /// Returns how much of each row there is in a sum that vanishes, with one of this vanished row.
    fn combination(&self, row: u32) -> Row<N> {
        let mut made = vec![(row, N::ONE)];
        let mut weight: BTreeMap<u32, Sum<N>> =
            self.taken[row as usize].iter().map(|&(k, f)| (k, Sum::of(f.negated()))).collect();
        while let Some((k, share)) = weight.pop_last() {
            if share.cancels_to(CANCELLED) {
                continue;
            }
            let pivot_row = self.pivots[k as usize].0;
            made.push((pivot_row, share.value));
            for &(j, f) in &self.taken[pivot_row as usize] {
                weight.entry(j).or_default().add(share.value.times(f).negated());
            }
        }
        made.sort_unstable_by_key(|e| e.0);
        made
    }
}

impl Echelon {
    /// Computes the pivots that go with a choice of the free columns.
    pub fn complete(&self, free: &[(u32, f64)]) -> Row {
        let mut made = vec![0.0; self.has_pivot.len()];
        free.iter().for_each(|&(c, v)| made[c as usize] = v);
        for (_, column, row) in self.pivots.iter().rev() {
            let (mut sum, mut size) = (0.0, 0.0f64);
            for &(c, v) in row {
                let term = v * made[c as usize];
                sum -= term;
                size = size.max(term.abs());
            }
            if sum.abs() > CANCELLED * size {
                made[*column as usize] = sum;
            }
        }
        (0..).zip(made).filter(|e| e.1 != 0.0).collect()
    }

    /// Does the same for each of these free columns: it is one, and the others are nothing.
    pub fn complete_each(&self, free: &[u32]) -> Vec<Row> {
        // for every column, what it is for which of them
        let mut made: Vec<Row> = vec![Vec::new(); self.has_pivot.len()];
        for (i, &c) in (0..).zip(free) {
            made[c as usize].push((i, 1.0));
        }
        let mut sums = vec![(0.0, 0.0f64); free.len()];
        let mut met: Vec<u32> = Vec::with_capacity(free.len());
        for (_, column, row) in self.pivots.iter().rev() {
            for &(c, v) in row {
                for &(i, x) in &made[c as usize] {
                    let (sum, size) = &mut sums[i as usize];
                    if *size == 0.0 {
                        met.push(i);
                    }
                    let term = v * x;
                    *sum -= term;
                    *size = size.max(term.abs());
                }
            }
            let own = &mut made[*column as usize];
            own.reserve_exact(met.len());
            own.extend(met.drain(..).filter_map(|i| {
                let (sum, size) = std::mem::take(&mut sums[i as usize]);
                (sum.abs() > CANCELLED * size).then_some((i, sum))
            }));
        }
        let mut lengths = vec![0; free.len()];
        made.iter().flatten().for_each(|&(i, _)| lengths[i as usize] += 1);
        let mut rows: Vec<Row> = lengths.into_iter().map(Vec::with_capacity).collect();
        for (c, of) in (0..).zip(made) {
            of.into_iter().for_each(|(i, x)| rows[i as usize].push((c, x)));
        }
        rows
    }
}

/// Subtracts so much of a row, one in its `last` column, that the other has nothing there.
fn take_away<N: Number>(from: &mut Row<N>, last: u32, row: &Row<N>) {
    let Ok(at) = from.binary_search_by_key(&last, |e| e.0) else { return };
    let factor = from[at].1;
    let mut out = Vec::with_capacity(from.len() + row.len());
    let (mut own, mut other) = (from.iter().peekable(), row.iter().peekable());
    loop {
        let a = own.peek().map_or(u32::MAX, |e| e.0);
        let b = other.peek().map_or(u32::MAX, |e| e.0);
        let column = a.min(b);
        if column == u32::MAX {
            break;
        }
        let mut sum = Sum::default();
        if let Some(&(_, value)) = own.next_if(|e| e.0 == column) {
            sum.add(value);
        }
        if let Some(&(_, value)) = other.next_if(|e| e.0 == column) {
            sum.add(factor.times(value).negated());
        }
        if column != last && !sum.cancels_to(CANCELLED) {
            out.push((column, sum.value));
        }
    }
    *from = out;
}

/// An entry of what is left.
#[derive(Clone, Copy, Debug)]
struct Entry<N> {
    column: u32,
    value: N,
    /// The largest of the terms that it was summed of.
    size: f64,
}

impl<N: Number> Entry<N> {
    fn is_something(&self) -> bool {
        let size = self.value.size();
        size.is_finite() && size > CANCELLED * self.size
    }
}

fn largest<N: Number>(entries: &[Entry<N>]) -> f64 {
    entries.iter().fold(0.0, |most, e| most.max(e.value.size()))
}

/// What is left to be eliminated.
struct Remainder<N> {
    rows: Vec<Vec<Entry<N>>>,
    /// The rows that each column may stand in; what is gone or cancelled is named too.
    columns: Vec<Vec<u32>>,
    by_row: Counts,
    by_column: Counts,
    /// Where each column stands in the row at hand.
    at: Vec<u32>,
    out: Echelon<N>,
}

const NONE: u32 = u32::MAX;

impl<N: Number> Remainder<N> {
    fn new(rows: &[Row<N>], width: usize) -> Self {
        let mut columns: Vec<Vec<u32>> = vec![Vec::new(); width];
        let mut own = Vec::with_capacity(rows.len());
        for (r, row) in (0..).zip(rows) {
            let largest = row.iter().fold(0.0f64, |m, e| m.max(e.1.size()));
            let entry = |&(column, value): &(u32, N)| {
                let value = value.scaled_down(largest);
                Entry { column, value, size: value.size() }
            };
            let counts = |e: &Entry<N>| e.size.is_finite() && e.size > ROUNDING;
            let entries: Vec<Entry<N>> = row.iter().map(entry).filter(counts).collect();
            entries.iter().for_each(|e| columns[e.column as usize].push(r));
            own.push(entries);
        }
        let by_row = Counts::new(own.iter().map(|r| r.len() as u32).collect(), width);
        let by_column = Counts::new(columns.iter().map(|c| c.len() as u32).collect(), rows.len());
        let out = Echelon {
            has_pivot: vec![false; width],
            taken: vec![Vec::new(); rows.len()],
            pivots: Vec::new(),
            vanished: Vec::new(),
        };
        let mut made = Self { rows: own, columns, by_row, by_column, at: vec![NONE; width], out };
        for r in 0..rows.len() as u32 {
            if made.rows[r as usize].is_empty() {
                made.vanish(r);
            }
        }
        made
    }

    fn vanish(&mut self, row: u32) {
        self.by_row.unlink(row);
        self.out.vanished.push(row);
    }

    /// The pivot that makes the fewest new entries, among a few candidates; none where nothing is left.
    fn best(&mut self) -> Option<(u32, u32)> {
        // what stands alone in its column changes no other row
        let alone = self.by_column.of(1).take(CANDIDATES).find_map(|column| {
            let stands = |r: &&u32| {
                let entries = &self.rows[**r as usize];
                let own = entries.iter().find(|e| e.column == column);
                own.is_some_and(|e| e.value.size() >= ALONE * largest(entries))
            };
            let row = self.columns[column as usize].iter().find(stands)?;
            Some((*row, column))
        });
        if alone.is_some() {
            return alone;
        }
        let mut best: Option<(usize, f64, u32, u32)> = None;
        let mut looked = 0;
        let least = self.by_row.least();
        for count in least..=self.columns.len() {
            for row in self.by_row.of(count) {
                let entries = &self.rows[row as usize];
                let least = PIVOT * largest(entries);
                for e in entries.iter().filter(|e| e.value.size() >= least) {
                    let cost = (count - 1) * (self.by_column.count(e.column) as usize - 1);
                    let size = e.value.size();
                    if best.is_none_or(|b| cost < b.0 || cost == b.0 && size > b.1) {
                        best = Some((cost, size, row, e.column));
                    }
                }
                looked += 1;
                if best.is_some_and(|b| b.0 <= (count - 1) * (count - 1) || looked >= CANDIDATES) {
                    return best.map(|b| (b.2, b.3));
                }
            }
        }
        best.map(|b| (b.2, b.3))
    }

    fn eliminate(&mut self, row: u32, column: u32) {
        let mut pivot_row = std::mem::take(&mut self.rows[row as usize]);
        let number = self.out.pivots.len() as u32;
        for e in &pivot_row {
            self.by_column.set(e.column, self.by_column.count(e.column) as usize - 1);
        }
        let own = pivot_row.iter().position(|e| e.column == column);
        let pivot = pivot_row.swap_remove(own.expect("the pivot stands in its row")).value;
        let by = pivot.divisor();
        for r in std::mem::take(&mut self.columns[column as usize]) {
            self.subtract(r, &pivot_row, by, (column, number));
        }
        self.by_row.unlink(row);
        self.by_column.unlink(column);
        self.out.has_pivot[column as usize] = true;
        let mut rest: Row<N> = pivot_row.iter().map(|e| (e.column, e.value)).collect();
        N::divide(&mut rest, pivot);
        self.out.pivots.push((row, column, rest));
    }

    /// Subtracts as much of a pivot's row, the pivot left out, as takes its column away from another.
    fn subtract(
        &mut self,
        r: u32,
        pivot_row: &[Entry<N>],
        pivot: N::Divisor,
        (column, number): (u32, u32),
    ) {
        let target = &mut self.rows[r as usize];
        let Some(own) = target.iter().position(|e| e.column == column) else { return };
        let factor = target.swap_remove(own).value.divided(pivot);
        for (i, e) in (0..).zip(target.iter()) {
            self.at[e.column as usize] = i;
        }
        for e in pivot_row {
            let (c, value) = (e.column as usize, factor.times(e.value).negated());
            if self.at[c] == NONE {
                target.push(Entry { column: e.column, value, size: value.size() });
                self.columns[c].push(r);
                self.by_column.set(e.column, self.by_column.count(e.column) as usize + 1);
            } else {
                let entry = &mut target[self.at[c] as usize];
                entry.value = entry.value.plus(value);
                entry.size = entry.size.max(value.size());
            }
        }
        target.iter().for_each(|e| self.at[e.column as usize] = NONE);
        let by_column = &mut self.by_column;
        target.retain(|e| {
            let stays = e.is_something();
            if !stays {
                by_column.set(e.column, by_column.count(e.column) as usize - 1);
            }
            stays
        });
        self.out.taken[r as usize].push((number, factor));
        self.by_row.set(r, target.len());
        if target.is_empty() {
            self.vanish(r);
        }
    }
}

/// Rows that come one after the other, each told apart from what those before can make.
#[derive(Clone, Debug, Default)]
pub struct Basis {
    /// Each with a pivot of one, which no other has.
    rows: Vec<(u32, Row)>,
}

impl Basis {
    /// Adds a row; returns false, and adds nothing, if those before can make it.
    pub fn add(&mut self, row: &Row) -> bool {
        let mut own = row.clone();
        for (pivot, other) in &self.rows {
            take_away(&mut own, *pivot, other);
        }
        let size = |e: &(u32, f64)| e.1.abs();
        let larger = |a: &&(u32, f64), b: &&(u32, f64)| size(a).total_cmp(&size(b));
        let Some(&(pivot, value)) = own.iter().max_by(larger) else { return false };
        own.iter_mut().for_each(|e| e.1 /= value);
        for (_, other) in &mut self.rows {
            take_away(other, pivot, &own);
        }
        self.rows.push((pivot, own));
        true
    }

    /// Returns how many rows there are.
    pub fn rank(&self) -> usize {
        self.rows.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dependent_row_tells_the_rows_that_it_is_made_of() {
        // row 3 is row 0 twice and row 1, row 4 is row 2
        let rows: [Row; 5] = [
            vec![(0, 1.0), (1, 2.0)],
            vec![(1, 1.0), (2, -1.0)],
            vec![(3, 1.0)],
            vec![(0, 2.0), (1, 5.0), (2, -1.0)],
            vec![(3, 7.0)],
        ];
        let e = Echelon::new(&rows, 4);
        let told = [(3, vec![0, 1]), (4, vec![2])];
        let told = told.map(|(row, circuit)| Dependent { row, circuit });
        assert_eq!(e.dependent(), told);
        assert_eq!(e.rank(), 3);
    }

    /// The last of those that depend on each other is told, and by rows that depend on nothing.
    #[test]
    fn of_what_depends_the_last_is_told() {
        let rows: Vec<Row> = vec![
            vec![(0, 1.0), (1, 1.0)],
            vec![(0, 2.0), (1, 2.0)],
            vec![(0, 1.0), (1, -1.0)],
            vec![(0, 1.0)],
            vec![(1, 3.0)],
        ];
        let told = Echelon::new(&rows, 2).dependent();
        let told: Vec<(u32, &[u32])> = told.iter().map(|d| (d.row, &d.circuit[..])).collect();
        assert_eq!(told, [(1, &[0][..]), (3, &[0, 2]), (4, &[0, 2])]);
    }

    #[test]
    fn the_free_columns_determine_the_others() {
        // a + b = 0, b + c = 0
        let rows = [vec![(0, 1.0), (1, 1.0)], vec![(1, 1.0), (2, 1.0)]];
        let e = Echelon::new(&rows, 3);
        let free: Vec<u32> = (0..3).filter(|&c| !e.has_pivot(c)).collect();
        assert_eq!(free.len(), 1);
        let motion = e.complete(&[(free[0], 1.0)]);
        let of = |c: u32| motion.iter().find(|m| m.0 == c).map_or(0.0, |m| m.1);
        assert_eq!((of(0), of(1), of(2)), (of(2), -of(2), of(2)));
        assert_ne!(of(2), 0.0);
    }

    #[test]
    fn an_empty_row_depends_on_nothing() {
        let told = Echelon::new(&[Row::new(), vec![(0, 1.0)]], 1).dependent();
        assert_eq!(told, [Dependent { row: 0, circuit: Vec::new() }]);
    }

    /// Differences along all edges of a grid: as many depend on others as there are faces, and each is
    /// told by those about a face or more.
    #[test]
    fn a_large_sparse_system_keeps_its_rank() {
        let side = 60u32;
        let mut rows = Vec::new();
        for i in 0..side * side {
            if i % side + 1 < side {
                rows.push(vec![(i, 1.0), (i + 1, -1.0)]);
            }
            if i + side < side * side {
                rows.push(vec![(i, 1.0), (i + side, -1.0)]);
            }
        }
        let e = Echelon::new(&rows, (side * side) as usize);
        assert_eq!(e.rank() as u32, side * side - 1);
        let told = e.dependent();
        assert_eq!(told.len() as u32, (side - 1) * (side - 1));
        assert!(told.iter().all(|d| d.circuit.len() >= 3 && d.circuit.iter().all(|&r| r < d.row)));
    }

    #[test]
    fn what_a_basis_can_make_is_not_added() {
        let mut basis = Basis::default();
        assert!(basis.add(&vec![(0, 1.0), (2, 2.0)]));
        assert!(basis.add(&vec![(2, -1.0), (3, 5.0)]));
        assert!(!basis.add(&vec![(0, 1.0), (3, 10.0)]));
        assert!(!basis.add(&Row::new()));
        assert_eq!(basis.rank(), 2);
    }
}
