//! LU: factors of a square matrix whose pivots are known.
//!
//! In: the pivots of a pattern, numbers. Out: factors, the sign of the determinant, solutions. The
//! tail, dense, is factorised with partial pivoting of its own.

use super::pattern::Pattern;
use super::pivot::{self, How, Pivots};
use crate::dense::{self, Factors};
use crate::lists::Lists;
use crate::residue::Residue;

/// An entry this many times its row's pivot means that the pivots do not suit the numbers.
const WILD: f64 = 1e6;

/// The factors' structure: every index is a place in the order of elimination.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Symbolic {
    rows: Vec<u32>,
    columns: Vec<u32>,
    /// For every column, its place.
    place: Vec<u32>,
    sparse: usize,
    lower_starts: Vec<u32>,
    lower: Vec<u32>,
    upper_starts: Vec<u32>,
    upper: Vec<u32>,
    /// For every pivot before the tail: its row is that of the next, and the next's pivot.
    is_joined: Vec<bool>,
    /// The sign of both orders as permutations.
    parity: i8,
}

/// Factors with their numbers, and working space.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lu {
    lower: Vec<f64>,
    upper: Vec<f64>,
    pivots: Vec<f64>,
    tail: Vec<f64>,
    swaps: Vec<usize>,
    work: Vec<f64>,
}

/// Up to so many rows are subtracted at once.
const ABREAST: usize = 4;

/// Pivots of this ratio, ordered as a whole, are not trusted before they were tried.
pub(crate) const POOR: f64 = 1e-9;

impl Symbolic {
    /// Chooses pivots that suit these numbers and puts them in; no factors where none do.
    pub(crate) fn suited(
        pattern: &Pattern,
        values: &[f64],
        lu: &mut Lu,
    ) -> (Self, Option<Factors>) {
        let paired = Self::new(pivot::choose(pattern, values, How::Paired));
        let factors = paired.factorise(pattern, values, lu);
        if factors
            .as_ref()
            .is_some_and(|f| f.ratio > POOR || paired.gives_back(pattern, values, lu))
        {
            return (paired, factors);
        }
        let single = Self::new(pivot::choose(pattern, values, How::Single));
        let factors = single.factorise(pattern, values, lu);
        (single, factors)
    }

    /// Returns true if a known solution comes back from the factors of these numbers: however unlike their
    /// pivots are, the matrix is regular then.
    pub(crate) fn gives_back(&self, pattern: &Pattern, values: &[f64], lu: &mut Lu) -> bool {
        const OFF: f64 = 1e-6;
        let sum = |row: usize| values[pattern.range(row)].iter().sum();
        let mut ones: Vec<f64> = (0..pattern.height()).map(sum).collect();
        self.solve(lu, &mut ones);
        ones.iter().all(|x| (x - 1.0).abs() < OFF)
    }

    /// Lays the factors out.
    pub(crate) fn new(pivots: Pivots) -> Self {
        let n = pivots.rows.len();
        let place = places(&pivots.columns);
        let place_of_row = places(&pivots.rows);
        let lower = pivots.lower.iter().map(|&(r, pivot)| (place_of_row[r as usize], pivot));
        let (lower_starts, lower) = Lists::new(n, lower).into_parts();
        let (upper_starts, mut upper) = pivots.upper.into_parts();
        upper.iter_mut().for_each(|c| *c = place[*c as usize]);
        for row in upper_starts.windows(2) {
            upper[row[0] as usize..row[1] as usize].sort_unstable();
        }
        let row = |k: usize| &upper[upper_starts[k] as usize..upper_starts[k + 1] as usize];
        let joins = |k: usize| {
            k + 1 < pivots.sparse && row(k).split_first() == Some((&(k as u32 + 1), row(k + 1)))
        };
        let is_joined = (0..pivots.sparse).map(joins).collect();
        Self {
            is_joined,
            parity: parity(&pivots.rows) * parity(&pivots.columns),
            sparse: pivots.sparse,
            rows: pivots.rows,
            columns: pivots.columns,
            place,
            lower_starts,
            lower,
            upper_starts,
            upper,
        }
    }

    fn lower(&self, k: usize) -> std::ops::Range<usize> {
        self.lower_starts[k] as usize..self.lower_starts[k + 1] as usize
    }
    fn upper(&self, k: usize) -> std::ops::Range<usize> {
        self.upper_starts[k] as usize..self.upper_starts[k + 1] as usize
    }

    /// Puts numbers in; nothing where the pivots do not suit them.
    pub(crate) fn factorise(
        &self,
        pattern: &Pattern,
        values: &[f64],
        lu: &mut Lu,
    ) -> Option<Factors> {
        let n = self.rows.len();
        let tail = n - self.sparse;
        lu.lower.resize(self.lower.len(), 0.0);
        lu.upper.resize(self.upper.len(), 0.0);
        lu.pivots.resize(self.sparse, 0.0);
        lu.tail.clear();
        lu.tail.resize(tail * tail, 0.0);
        lu.work.clear();
        lu.work.resize(n, 0.0);
        let work = &mut lu.work;
        let mut sign = self.parity;
        let (mut least, mut most) = (f64::INFINITY, 0.0f64);
        for k in 0..n {
            for e in pattern.range(self.rows[k] as usize) {
                work[self.place[pattern.column(e)] as usize] = values[e];
            }
            let mut lower = self.lower(k);
            while !lower.is_empty() {
                let first = self.lower[lower.start] as usize;
                let is_next = |i: usize| {
                    self.lower.get(lower.start + i) == Some(&((first + i) as u32))
                        && self.is_joined[first + i - 1]
                };
                let most = lower.len().min(ABREAST);
                let count = (1..most).find(|&i| !is_next(i)).unwrap_or(most);
                let factors = &mut lu.lower[lower.start..lower.start + count];
                self.subtract(first, &lu.pivots, &lu.upper, factors, work);
                lower.start += count;
            }
            if k < self.sparse {
                let pivot = std::mem::take(&mut work[k]);
                if pivot == 0.0 || !pivot.is_finite() {
                    return None;
                }
                lu.pivots[k] = pivot;
                least = least.min(pivot.abs());
                most = most.max(pivot.abs());
                if pivot < 0.0 {
                    sign = -sign;
                }
                for i in self.upper(k) {
                    let value = std::mem::take(&mut work[self.upper[i] as usize]);
                    if value.abs() > WILD * pivot.abs() {
                        return None;
                    }
                    lu.upper[i] = value;
                }
            } else {
                let row = &mut lu.tail[(k - self.sparse) * tail..][..tail];
                row.copy_from_slice(&work[self.sparse..]);
                work[self.sparse..].fill(0.0);
            }
        }
        let dense = dense::factorise(&mut lu.tail, tail, &mut lu.swaps);
        for i in 0..lu.swaps.len() {
            let pivot = lu.tail[i * tail + i].abs();
            least = least.min(pivot);
            most = most.max(pivot);
        }
        let ratio = if n == 0 { 1.0 } else { least / most };
        Some(Factors { sign: sign * dense.sign, ratio })
    }

    /// Returns whether a matrix of these numbers, of which nothing is rounded, is regular; nothing where a pivot
    /// vanishes before the tail, so that others would have to be chosen.
    pub(crate) fn is_regular(&self, pattern: &Pattern, values: &[Residue]) -> Option<bool> {
        let n = self.rows.len();
        let mut upper = vec![Residue::ZERO; self.upper.len()];
        let mut inverses = Vec::with_capacity(self.sparse);
        let mut tail = Vec::new();
        let mut work = vec![Residue::ZERO; n];
        for k in 0..n {
            for e in pattern.range(self.rows[k] as usize) {
                work[self.place[pattern.column(e)] as usize] = values[e];
            }
            for i in self.lower(k) {
                let j = self.lower[i] as usize;
                let factor = std::mem::take(&mut work[j]).times(inverses[j]).negated();
                if factor.is_zero() {
                    continue;
                }
                for u in self.upper(j) {
                    let x = &mut work[self.upper[u] as usize];
                    *x = x.plus(factor.times(upper[u]));
                }
            }
            if k < self.sparse {
                inverses.push(Residue::ONE.over(std::mem::take(&mut work[k]))?);
                for i in self.upper(k) {
                    upper[i] = std::mem::take(&mut work[self.upper[i] as usize]);
                }
            } else {
                tail.push(work[self.sparse..].to_vec());
                work[self.sparse..].fill(Residue::ZERO);
            }
        }
        Some(is_regular(tail))
    }

    /// Subtracts as much of joined rows, from the first on, as leaves nothing at their pivots; how much is put
    /// in `factors`. What it comes to has the bits of one row after the other.
    fn subtract(
        &self,
        first: usize,
        pivots: &[f64],
        upper: &[f64],
        factors: &mut [f64],
        work: &mut [f64],
    ) {
        let last = first + factors.len() - 1;
        for (j, at) in (first..).zip(0..factors.len()) {
            let factor = std::mem::take(&mut work[j]) / pivots[j];
            factors[at] = factor;
            let row = &upper[self.upper(j).start..];
            for (x, u) in work[j + 1..=last].iter_mut().zip(row) {
                *x -= factor * u;
            }
        }
        // what lies behind the last of them is the same for all
        let columns = &self.upper[self.upper(last)];
        let row = |at: usize| {
            let own = self.upper(first + at);
            &upper[own.end - columns.len()..own.end]
        };
        match *factors {
            [a] if a != 0.0 => {
                for (&c, u) in columns.iter().zip(row(0)) {
                    work[c as usize] -= a * u;
                }
            }
            [_] => {}
            [a, b] => {
                for ((&c, u), v) in columns.iter().zip(row(0)).zip(row(1)) {
                    let x = &mut work[c as usize];
                    *x = (*x - a * u) - b * v;
                }
            }
            [a, b, c, d] => {
                let rows = row(0).iter().zip(row(1)).zip(row(2).iter().zip(row(3)));
                for (&column, ((s, t), (u, v))) in columns.iter().zip(rows) {
                    let x = &mut work[column as usize];
                    *x = (((*x - a * s) - b * t) - c * u) - d * v;
                }
            }
            _ => {
                for (at, factor) in factors.iter().enumerate() {
                    for (&c, u) in columns.iter().zip(row(at)) {
                        work[c as usize] -= factor * u;
                    }
                }
            }
        }
    }

    /// Solves with the factors; `b` becomes the solution.
    pub(crate) fn solve(&self, lu: &mut Lu, b: &mut [f64]) {
        let n = self.rows.len();
        let work = &mut lu.work;
        for k in 0..n {
            let mut value = b[self.rows[k] as usize];
            for i in self.lower(k) {
                value -= lu.lower[i] * work[self.lower[i] as usize];
            }
            work[k] = value;
        }
        dense::substitute_back(&lu.tail, n - self.sparse, &lu.swaps, &mut work[self.sparse..]);
        for k in (0..self.sparse).rev() {
            let mut value = work[k];
            for i in self.upper(k) {
                value -= lu.upper[i] * work[self.upper[i] as usize];
            }
            work[k] = value / lu.pivots[k];
        }
        for (k, &c) in self.columns.iter().enumerate() {
            b[c as usize] = std::mem::take(&mut work[k]);
        }
    }
}

/// Returns whether a dense matrix is regular, by its rows.
fn is_regular(mut rows: Vec<Vec<Residue>>) -> bool {
    for k in 0..rows.len() {
        let Some(found) = (k..rows.len()).find(|&r| !rows[r][k].is_zero()) else { return false };
        rows.swap(k, found);
        let (above, below) = rows.split_at_mut(k + 1);
        let pivot_row = &above[k];
        let Some(inverse) = Residue::ONE.over(pivot_row[k]) else { return false };
        for row in below {
            let factor = row[k].times(inverse).negated();
            for (x, y) in row[k..].iter_mut().zip(&pivot_row[k..]) {
                *x = x.plus(factor.times(*y));
            }
        }
    }
    true
}

/// Returns where each stands in an order.
fn places(order: &[u32]) -> Vec<u32> {
    let mut place = vec![0; order.len()];
    for (&i, k) in order.iter().zip(0..) {
        place[i as usize] = k;
    }
    place
}

fn parity(order: &[u32]) -> i8 {
    let mut seen = vec![false; order.len()];
    let mut sign = 1;
    for i in 0..order.len() {
        let mut at = i;
        let mut length = 0;
        while !std::mem::replace(&mut seen[at], true) {
            at = order[at] as usize;
            length += 1;
        }
        if length > 0 && length % 2 == 0 {
            sign = -sign;
        }
    }
    sign
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sparse::pivot::{self, How};

    fn random(seed: &mut u64) -> f64 {
        *seed =
            seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }

    fn case(n: usize, others: usize, seed: &mut u64) -> (Pattern, Vec<f64>) {
        let rows = (0..n).map(|r| {
            let some = (0..others).map(|_| ((random(seed) + 0.5) * n as f64) as u32);
            some.chain([(r * 7 + 3) as u32 % n as u32]).collect()
        });
        let rows: Vec<Vec<u32>> = rows.collect();
        let pattern = Pattern::of_rows(n, rows.into_iter());
        let values = (0..pattern.len()).map(|_| random(seed)).collect();
        (pattern, values)
    }

    #[test]
    fn a_singular_matrix_is_told() {
        let pattern = Pattern::of_rows(2, [vec![0, 1], vec![0, 1]].into_iter());
        let values = [1.0, 2.0, 2.0, 4.0];
        let symbolic = Symbolic::new(pivot::choose(&pattern, &values, How::Paired));
        let factors = symbolic.factorise(&pattern, &values, &mut Lu::default());
        assert!(factors.is_none_or(|f| f.sign == 0));
    }

    /// What flows between the nodes of a grid is known but for one sum, and known where one node is held.
    #[test]
    fn residues_tell_whether_a_grid_floats() {
        let (side, number) = (25u32, Residue::drawn);
        for held in [false, true] {
            let (mut rows, mut values) = (Vec::new(), Vec::new());
            for i in 0..side * side {
                let (x, y) = (i % side, i / side);
                let near = [(x > 0, 1), (y > 0, side)];
                let before = near.into_iter().filter(|n| n.0).map(|n| (i - n.1, i - n.1));
                let near = [(x + 1 < side, 1), (y + 1 < side, side)];
                let after = near.into_iter().filter(|n| n.0).map(|n| (i + n.1, i));
                // a link has the number of its first node, and of its direction
                let link = |(j, first): (u32, u32)| {
                    (j, number(u64::from(first) << 32 | u64::from(i.abs_diff(j))))
                };
                let mut row: Vec<(u32, Residue)> = before.chain(after).map(link).collect();
                let begin = if held && i == 7 { Residue::ONE } else { Residue::ZERO };
                let own = row.iter().fold(begin, |sum, e| sum.plus(e.1.negated()));
                row.push((i, own));
                row.sort_unstable_by_key(|e| e.0);
                rows.push(row.iter().map(|e| e.0).collect::<Vec<u32>>());
                values.extend(row.iter().map(|e| e.1));
            }
            let pattern = Pattern::of_rows(rows.len(), rows.into_iter());
            let doubles: Vec<f64> = (0..pattern.height())
                .flat_map(|r| {
                    let row = pattern.row(r);
                    let own = row.len() as f64 - 1.0;
                    row.iter().map(move |&c| if c as usize == r { own } else { -1.0 })
                })
                .collect();
            for how in [How::Paired, How::Single] {
                let symbolic = Symbolic::new(pivot::choose(&pattern, &doubles, how));
                assert_eq!(symbolic.is_regular(&pattern, &values), Some(held), "{how:?}");
            }
        }
    }

    #[test]
    fn random_sparse_systems_agree_with_dense_ones() {
        let mut seed = 1;
        for n in [1, 5, 30, 200, 700] {
            for others in [1, 3] {
                let (pattern, values) = case(n, others, &mut seed);
                let mut full = vec![0.0; n * n];
                for r in 0..n {
                    for e in pattern.range(r) {
                        full[r * n + pattern.column(e)] = values[e];
                    }
                }
                let symbolic = Symbolic::new(pivot::choose(&pattern, &values, How::Paired));
                let mut lu = Lu::default();
                let right: Vec<f64> = (0..n).map(|_| random(&mut seed)).collect();
                let dense = dense::factorise(&mut full.clone(), n, &mut Vec::new());
                let Some(factors) = symbolic.factorise(&pattern, &values, &mut lu) else {
                    assert!(dense.ratio < 1e-9);
                    continue;
                };
                if dense.ratio < 1e-9 {
                    continue;
                }
                assert_eq!(factors.sign, dense.sign);
                let mut x = right.clone();
                symbolic.solve(&mut lu, &mut x);
                for r in 0..n {
                    let got: f64 = dense::dot(&full[r * n..][..n], &x);
                    assert!((got - right[r]).abs() < 1e-6, "{n} {others}: {got} {}", right[r]);
                }
            }
        }
    }

    /// A net of nodes whose first is tied to the ground; pivots are chosen for links of any resistance and sign,
    /// and serve where all are alike: those of a node's own row and column never vanish.
    #[test]
    fn pivots_of_a_net_serve_other_links() {
        let (k, mut seed) = (40, 3);
        let n = k * k;
        let links = (0..n).flat_map(|i| {
            let across = (i % k + 1 < k).then_some((i, i + 1));
            across.into_iter().chain((i + k < n).then_some((i, i + k)))
        });
        let links: Vec<(usize, usize)> = links.collect();
        let m = links.len();
        // of every link what falls along it, then of every node what flows out of it
        let mut rows: Vec<Vec<(usize, f64)>> = vec![Vec::new(); m + n];
        rows[m].push((0, 1.0));
        for (link, &(a, b)) in links.iter().enumerate() {
            rows[link].extend([(a, 1.0), (b, -1.0)]);
            rows[m + a].push((n + link, 1.0));
            rows[m + b].push((n + link, -1.0));
        }
        let net = |resistance: &mut dyn FnMut() -> f64| {
            let mut rows = rows.clone();
            for (link, row) in rows[..m].iter_mut().enumerate() {
                row.push((n + link, -resistance()));
            }
            rows.iter_mut().for_each(|row| row.sort_by_key(|e| e.0));
            let columns = |row: &Vec<(usize, f64)>| row.iter().map(|e| e.0 as u32).collect();
            let pattern = Pattern::of_rows(n + m, rows.iter().map(columns));
            (pattern, rows.iter().flatten().map(|e| e.1).collect::<Vec<f64>>())
        };
        // as large as generic numbers are, of either sign
        let (pattern, any) = net(&mut || {
            let x = random(&mut seed);
            1.3 * x + 1.25 * x.signum()
        });
        let (_, alike) = net(&mut || 1.0);
        let symbolic = Symbolic::new(pivot::choose(&pattern, &any, How::Paired));
        let mut lu = Lu::default();
        assert!(symbolic.factorise(&pattern, &alike, &mut lu).is_some());
        // what flows into the nodes, one each, the ground carries away
        let mut volts = vec![0.0; m];
        volts.resize(m + n, 1.0);
        symbolic.solve(&mut lu, &mut volts);
        assert!((volts[0] - n as f64).abs() < 1e-6, "{}", volts[0]);
    }

    #[test]
    fn factors_serve_other_numbers_of_the_pattern() {
        let mut seed = 5;
        let (pattern, values) = case(60, 2, &mut seed);
        let symbolic = Symbolic::new(pivot::choose(&pattern, &values, How::Paired));
        let others: Vec<f64> = values.iter().map(|v| v * 3.0).collect();
        let mut lu = Lu::default();
        assert!(symbolic.factorise(&pattern, &others, &mut lu).is_some());
        let mut b = vec![0.0; 60];
        for (r, sum) in b.iter_mut().enumerate() {
            *sum = others[pattern.range(r)].iter().sum();
        }
        symbolic.solve(&mut lu, &mut b);
        assert!(b.iter().all(|x| (x - 1.0).abs() < 1e-8), "{b:?}");
    }
}
