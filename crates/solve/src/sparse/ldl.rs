//! LDLᵀ: factors of a symmetric matrix, without exchanges.
//!
//! In: the places of a symmetric matrix's entries; then numbers. Out: factors, how many pivots are
//! negative (the inertia), solutions. The order has minimum degree, or is that of a chain, and is chosen by
//! structure alone, so the matrix has to be quasi-definite, or its failure to be so has to be what the
//! caller asks. A chain's factors are a band.
//!
//! **Source:** Davis, *Algorithm 849: a concise sparse Cholesky factorization package*, ACM TOMS 31
//! (2005); Vanderbei, *Symmetric quasidefinite matrices*, SIAM J. Optim. 5 (1995).

use super::band::{Band, BandFactors};
use super::degree;

/// How wide bands are.
const NARROW: usize = 6;
const WIDE: usize = 8;

/// No place.
const NONE: u32 = u32::MAX;

/// The factors' structure.
#[derive(Clone, Debug)]
pub(crate) struct Symmetric {
    /// What is eliminated, in order.
    order: Vec<u32>,
    layout: Layout,
}

/// How the factors are kept: every index is a place in the order of elimination.
#[derive(Clone, Debug)]
enum Layout {
    /// What is near the diagonal, as where each of a chain of bars in the plane is joined to the next, and the
    /// ends to what is known.
    Narrow(Band<NARROW>),
    /// What is a little farther from it.
    Wide(Band<WIDE>),
    /// What is not zero.
    Sparse(Sparse),
}

/// Where the factors are not zero.
#[derive(Clone, Debug)]
struct Sparse {
    /// For every place, where its entries of the matrix start.
    entry_starts: Vec<u32>,
    /// The earlier place (or the same) and the number of an entry.
    entries: Vec<(u32, u32)>,
    /// For every place, where its row of L starts, and the earlier places in it, in order.
    row_starts: Vec<u32>,
    rows: Vec<u32>,
    /// For every place, where its column of L starts.
    column_starts: Vec<u32>,
}

/// Factors with their numbers, and working space.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ldl {
    band: BandFactors,
    /// One over every pivot.
    inverses: Vec<f64>,
    /// Columns of L: rows and values.
    below: Vec<(u32, f64)>,
    filled: Vec<u32>,
    work: Vec<f64>,
}

impl Symmetric {
    /// Lays the factors out for a matrix of `n` rows; each entry stands for its mirror too, and
    /// those at one place are summed.
    pub(crate) fn new(n: usize, entries: &[(u32, u32)]) -> Self {
        let order = degree::eliminate(n, entries.iter().copied()).order;
        let places = places(&order, entries);
        let sparse = Sparse::new(n, &places, usize::MAX).expect("no number of entries is too many");
        Self { order, layout: Layout::Sparse(sparse) }
    }
    /// Does the same for rows as they stand in a chain, if that makes few new entries: no more than a third of
    /// the entries. Else by degree.
    pub(crate) fn of_chain(chain: Vec<u32>, entries: &[(u32, u32)]) -> Self {
        let n = chain.len();
        let joins = entries.iter().filter(|e| e.0 != e.1).count();
        let places = places(&chain, entries);
        let sparse = || Sparse::new(n, &places, joins + joins / 3).map(Layout::Sparse);
        let wide = || Band::new(n, &places).map(Layout::Wide);
        match Band::new(n, &places).map(Layout::Narrow).or_else(wide).or_else(sparse) {
            Some(layout) => Self { order: chain, layout },
            None => Self::new(n, entries),
        }
    }

    /// Puts numbers in, in the order of the entries; returns how many pivots are negative, or
    /// nothing where one vanished.
    pub(crate) fn factorise(&self, values: &[f64], ldl: &mut Ldl) -> Option<usize> {
        match &self.layout {
            Layout::Narrow(band) => band.factorise(values, &mut ldl.band),
            Layout::Wide(band) => band.factorise(values, &mut ldl.band),
            Layout::Sparse(sparse) => sparse.factorise(values, ldl),
        }
    }

    /// Solves with the factors; `b` becomes the solution.
    pub(crate) fn solve(&self, ldl: &mut Ldl, b: &mut [f64]) {
        let right = self.order.iter().map(|&i| b[i as usize]);
        let solution = match &self.layout {
            Layout::Narrow(band) => band.solve(&mut ldl.band, right),
            Layout::Wide(band) => band.solve(&mut ldl.band, right),
            Layout::Sparse(sparse) => sparse.solve(ldl, right),
        };
        for (value, &i) in solution.iter().zip(&self.order) {
            b[i as usize] = *value;
        }
    }
}

/// Returns the places of entries in an order, the later one of each first.
fn places(order: &[u32], entries: &[(u32, u32)]) -> Vec<(u32, u32)> {
    let mut place = vec![0u32; order.len()];
    for (k, &i) in (0..).zip(order) {
        place[i as usize] = k;
    }
    let places = |&(i, j): &(u32, u32)| {
        let (i, j) = (place[i as usize], place[j as usize]);
        (i.max(j), i.min(j))
    };
    entries.iter().map(places).collect()
}

impl Sparse {
    /// Lays the factors out, if they have no more than so many entries beside the diagonal.
    fn new(n: usize, places: &[(u32, u32)], most: usize) -> Option<Self> {
        let entry_starts = starts(n, places.iter().map(|e| e.0));
        let mut next = entry_starts.clone();
        let mut own = vec![(0, 0); places.len()];
        for (number, &(later, earlier)) in (0..).zip(places) {
            own[next[later as usize] as usize] = (earlier, number);
            next[later as usize] += 1;
        }
        // a row of L is what its entries lead to in the tree of elimination, in which every place stands under
        // the first that its column reaches
        let (mut above, mut met) = (vec![NONE; n], vec![NONE; n]);
        let mut rows = Vec::with_capacity(most.min(2 * places.len()));
        let mut row_starts = Vec::with_capacity(n + 1);
        row_starts.push(0);
        for (k, ends) in (0..).zip(entry_starts.windows(2)) {
            met[k as usize] = k;
            let start = rows.len();
            for &(earlier, _) in &own[ends[0] as usize..ends[1] as usize] {
                let mut at = earlier;
                while met[at as usize] != k {
                    met[at as usize] = k;
                    rows.push(at);
                    if above[at as usize] == NONE {
                        above[at as usize] = k;
                    }
                    at = above[at as usize];
                }
            }
            if rows.len() > most {
                return None;
            }
            rows[start..].sort_unstable();
            row_starts.push(rows.len() as u32);
        }
        let column_starts = starts(n, rows.iter().copied());
        Some(Self { entry_starts, entries: own, row_starts, rows, column_starts })
    }

    fn factorise(&self, values: &[f64], ldl: &mut Ldl) -> Option<usize> {
        let n = self.column_starts.len() - 1;
        ldl.inverses.clear();
        ldl.inverses.resize(n, 0.0);
        ldl.below.resize(self.rows.len(), (0, 0.0));
        ldl.filled.clear();
        ldl.filled.extend_from_slice(&self.column_starts[..n]);
        ldl.work.clear();
        ldl.work.resize(n, 0.0);
        let work = &mut ldl.work;
        let mut negative = 0;
        for k in 0..n {
            let range = self.entry_starts[k] as usize..self.entry_starts[k + 1] as usize;
            for &(j, number) in &self.entries[range] {
                work[j as usize] += values[number as usize];
            }
            let mut pivot = std::mem::take(&mut work[k]);
            for &j in &self.rows[self.row_starts[k] as usize..self.row_starts[k + 1] as usize] {
                let j = j as usize;
                let value = std::mem::take(&mut work[j]);
                let (start, end) = (self.column_starts[j] as usize, ldl.filled[j] as usize);
                for &(i, l) in &ldl.below[start..end] {
                    work[i as usize] -= l * value;
                }
                let l = value * ldl.inverses[j];
                pivot -= l * value;
                ldl.below[end] = (k as u32, l);
                ldl.filled[j] += 1;
            }
            let inverse = 1.0 / pivot;
            if !pivot.is_finite() || !inverse.is_finite() {
                return None;
            }
            negative += usize::from(pivot < 0.0);
            ldl.inverses[k] = inverse;
        }
        Some(negative)
    }

    fn solve<'l>(&self, ldl: &'l mut Ldl, right: impl Iterator<Item = f64>) -> &'l [f64] {
        let Ldl { work, inverses, below, .. } = ldl;
        work.clear();
        work.extend(right);
        let n = work.len();
        let column = |k: usize| self.column_starts[k] as usize..self.column_starts[k + 1] as usize;
        for k in 0..n {
            let value = work[k];
            for &(i, l) in &below[column(k)] {
                work[i as usize] -= l * value;
            }
        }
        for k in (0..n).rev() {
            let mut value = work[k] * inverses[k];
            for &(i, l) in &below[column(k)] {
                value -= l * work[i as usize];
            }
            work[k] = value;
        }
        work
    }
}

/// Returns where the items of each of `n` numbers start, and where the last end, of items of these.
fn starts(n: usize, of: impl Iterator<Item = u32>) -> Vec<u32> {
    let mut starts = vec![0; n + 1];
    of.for_each(|i| starts[i as usize + 1] += 1);
    for i in 0..n {
        starts[i + 1] += starts[i];
    }
    starts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vanishing_pivot_is_told() {
        let symmetric = Symmetric::new(2, &[(0, 0), (1, 0), (1, 1)]);
        assert_eq!(symmetric.factorise(&[1.0, 1.0, 1.0], &mut Ldl::default()), None);
    }

    #[test]
    fn a_saddle_has_as_many_negative_pivots_as_rows() {
        // least x² + y² + z² where x + y = 3 and y + z = 3
        let entries = [(0, 0), (1, 1), (2, 2), (3, 0), (3, 1), (4, 1), (4, 2), (3, 3), (4, 4)];
        let values = [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, -1e-14, -1e-14];
        let symmetric = Symmetric::new(5, &entries);
        let mut ldl = Ldl::default();
        assert_eq!(symmetric.factorise(&values, &mut ldl), Some(2));
        let mut b = [0.0, 0.0, 0.0, 3.0, 3.0];
        symmetric.solve(&mut ldl, &mut b);
        for (x, wanted) in b.iter().zip([1.0, 2.0, 1.0, -1.0, -1.0]) {
            assert!((x - wanted).abs() < 1e-12, "{b:?}");
        }
    }

    #[test]
    fn a_chain_is_eliminated_as_it_stands_and_a_star_is_not() {
        for n in [9, 900] {
            let order: Vec<u32> = (0..n).collect();
            let chain: Vec<(u32, u32)> =
                (1..n).flat_map(|i| [(i - 1, i), (i.saturating_sub(2), i)]).collect();
            let found = Symmetric::of_chain(order.clone(), &chain);
            assert_eq!(found.order, order);
            assert!(matches!(found.layout, Layout::Narrow(_)));
            // its hub comes first, and would join all others to one another
            let star: Vec<(u32, u32)> = (1..n).map(|i| (0, i)).collect();
            let found = Symmetric::of_chain(order, &star);
            let Layout::Sparse(Sparse { rows, .. }) = found.layout else { panic!("{found:?}") };
            assert_eq!(rows.len() as u32, n - 1);
        }
    }

    #[test]
    fn a_band_has_the_pivots_and_solutions_of_what_is_sparse() {
        // a chain, each joined to the next two and to the seventh; every third pivot is negative
        let n = 30u32;
        let mut entries: Vec<(u32, u32)> = (0..n).map(|i| (i, i)).collect();
        entries.extend((1..n).flat_map(|i| [(i - 1, i), (i.saturating_sub(2), i), (i, i - 1)]));
        entries.extend((7..n).map(|i| (i - 7, i)));
        let value = |at: usize| match at {
            at if at >= n as usize => 0.3 + 0.01 * (at % 7) as f64,
            at if at % 3 == 2 => -2.0,
            _ => 3.0,
        };
        let values: Vec<f64> = (0..entries.len()).map(value).collect();
        let order: Vec<u32> = (0..n).collect();
        let places = places(&order, &entries);
        let band = Band::new(n as usize, &places);
        let sparse = Sparse::new(n as usize, &places, usize::MAX);
        let layouts = [band.map(Layout::Wide), sparse.map(Layout::Sparse)];
        let [one, other] = layouts.map(|layout| {
            let layout = layout.expect("all entries are near the diagonal, and not too many");
            let symmetric = Symmetric { order: order.clone(), layout };
            let mut ldl = Ldl::default();
            assert_eq!(symmetric.factorise(&values, &mut ldl), Some(10));
            let mut b: Vec<f64> = (0..n).map(f64::from).collect();
            symmetric.solve(&mut ldl, &mut b);
            b
        });
        assert!(one.iter().zip(&other).all(|(x, y)| (x - y).abs() < 1e-12), "{one:?} {other:?}");
        assert!(Band::<8>::new(n as usize, &[(8, 0)]).is_none());
    }

    #[test]
    fn a_grid_solves() {
        let side = 20u32;
        let at = |i: u32, j: u32| i * side + j;
        let (mut entries, mut values) = (Vec::new(), Vec::new());
        for i in 0..side {
            for j in 0..side {
                let mut next = vec![(at(i, j), 4.5)];
                if i > 0 {
                    next.push((at(i - 1, j), -1.0));
                }
                if j > 0 {
                    next.push((at(i, j - 1), -1.0));
                }
                for (other, value) in next {
                    entries.push((at(i, j), other));
                    values.push(value);
                }
            }
        }
        let n = (side * side) as usize;
        let symmetric = Symmetric::new(n, &entries);
        let mut ldl = Ldl::default();
        assert_eq!(symmetric.factorise(&values, &mut ldl), Some(0));
        let wanted: Vec<f64> = (0..n).map(|i| (i % 7) as f64).collect();
        let mut b = vec![0.0; n];
        for (&(i, j), v) in entries.iter().zip(&values) {
            b[i as usize] += v * wanted[j as usize];
            if i != j {
                b[j as usize] += v * wanted[i as usize];
            }
        }
        symmetric.solve(&mut ldl, &mut b);
        assert!(b.iter().zip(&wanted).all(|(x, y)| (x - y).abs() < 1e-10));
    }
}
