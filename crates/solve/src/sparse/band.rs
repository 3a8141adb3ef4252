//! Bands: LDLᵀ of a symmetric matrix whose entries are all near its diagonal.
//!
//! In: the places of the entries, in an order in which each is near what it is joined to, as in a chain of bars;
//! then numbers. Out: factors, how many pivots are negative, solutions. Elimination fills the band and nothing
//! beside it, so that no place of a factor is written down: a column is as many numbers as the band is wide.
//!
//! **Source:** Golub and Van Loan, *Matrix Computations*, 4th ed., §4.3.

/// Where the entries of a matrix stand in its band: a column has `W` places, its own first.
#[derive(Clone, Debug)]
pub(crate) struct Band<const W: usize> {
    /// How many columns there are.
    size: usize,
    /// For every entry, where it is added, of all columns.
    at: Vec<u32>,
}

/// The numbers of factors.
#[derive(Clone, Debug, Default)]
pub(crate) struct BandFactors {
    /// Columns of L, each with one over its pivot where the one would be; behind the last a few of nothing.
    columns: Vec<f64>,
    /// A right side, then the solution.
    work: Vec<f64>,
}

/// Why there is a column after each that elimination reaches.
const BEHIND: &str = "behind the last column there are as many of nothing as elimination reaches";

impl<const W: usize> Band<W> {
    /// Lays out the entries between `size` places, the later of each first, if none of them is too far from
    /// the diagonal.
    pub(crate) fn new(size: usize, places: &[(u32, u32)]) -> Option<Self> {
        let is_near = |&(later, earlier): &(u32, u32)| later - earlier < W as u32;
        let at = |&(later, earlier): &(u32, u32)| earlier * W as u32 + (later - earlier);
        let is_band = places.iter().all(is_near);
        is_band.then(|| Self { size, at: places.iter().map(at).collect() })
    }

    /// Puts numbers in, in the order of the entries, and makes factors of them; returns how many pivots are
    /// negative, or nothing where one vanished.
    pub(crate) fn factorise(&self, values: &[f64], factors: &mut BandFactors) -> Option<usize> {
        let all = &mut factors.columns;
        all.clear();
        all.resize((self.size + W) * W, 0.0);
        for (&at, value) in self.at.iter().zip(values) {
            all[at as usize] += value;
        }
        let columns = all.as_chunks_mut::<W>().0;
        let mut negative = 0;
        for k in 0..self.size {
            let window = columns[k..].first_chunk_mut::<W>().expect(BEHIND);
            let values = window[0];
            let inverse = 1.0 / values[0];
            if !values[0].is_finite() || !inverse.is_finite() {
                return None;
            }
            negative += usize::from(values[0] < 0.0);
            window[0][0] = inverse;
            for r in 1..W {
                let l = values[r] * inverse;
                window[0][r] = l;
                for c in r..W {
                    window[r][c - r] -= l * values[c];
                }
            }
        }
        Some(negative)
    }

    /// Solves for a right side that is given by place, and gives the solution so.
    pub(crate) fn solve<'f>(
        &self,
        factors: &'f mut BandFactors,
        right: impl Iterator<Item = f64>,
    ) -> &'f [f64] {
        let BandFactors { columns, work } = factors;
        let columns = &columns.as_chunks::<W>().0[..self.size];
        work.clear();
        work.reserve(self.size);
        // what the places before take from those that follow, the next one first
        let mut taken = [0.0; W];
        for (column, b) in columns.iter().zip(right) {
            let value = b - taken[0];
            work.push(value);
            for r in 1..W {
                taken[r - 1] = taken[r] + column[r] * value;
            }
        }
        // the solution at the places that follow, the next one first
        let mut after = [0.0; W];
        for (column, b) in columns.iter().zip(work.iter_mut()).rev() {
            let mut value = *b * column[0];
            for r in (1..W).rev() {
                value -= column[r] * after[r - 1];
                if r > 1 {
                    after[r - 1] = after[r - 2];
                }
            }
            after[0] = value;
            *b = value;
        }
        work
    }
}
