//! Strides: whether what a block came to lies on the branch that was followed there.
//!
//! In: the state that a stride began in, the one that it came to. Out: whether nothing was passed over between them.
//! The sign of a determinant does not tell: where two orientations turn over at once it is what it was. So the
//! slopes of both states are eliminated in one order, and every pivot has to keep its sign. Where one does not,
//! that may be the order's fault: then it is asked of both halves of the way, up to a few times. A divisor of a row
//! that has another sign than before tells of a pole on the way, whatever the slopes are.

use super::{Square, SquareScratch};
use crate::block::Workspace;
use crate::dense;

/// How often a way is halved to find out whether the order of elimination is at fault.
const HALVES: u32 = 5;
/// A pivot below this part of the largest is told by rounding.
const FLAT: f64 = 1e-9;

/// On which side of where branches meet a block lies in the state that a branch is followed from: the sign of
/// its determinant, as the closed form tells it and as Newton's steps do; zero where that is not known yet. On
/// a branch it stays.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct Side {
    pub(super) closed: i8,
    pub(super) newton: i8,
    /// Where the last stride ended, the values of all slots of the block, and the slopes there.
    at: Vec<f64>,
    slopes: Vec<f64>,
}

/// A part of a way: where it begins and ends, as parts of the whole, the slopes of both ends, and how often it may
/// be halved.
struct Piece {
    ends: [f64; 2],
    slopes: [Vec<f64>; 2],
    halves: u32,
}

impl Square {
    /// Returns on which side a state lies, as far as the closed form tells.
    pub(crate) fn side_of(&self, state: &[f64], w: &mut Workspace) -> Side {
        Side { closed: self.closed_side(state, w), ..Side::default() }
    }

    /// Returns true if no branch ends and no pole lies between the last state and that in which its rows were last
    /// evaluated, as far as the states on the straight way between them tell.
    pub(super) fn stays(
        &self,
        last: &[f64],
        values: &[f64],
        side: &mut Side,
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        if self.block.changes_divisors(last, values, w) {
            return false;
        }
        if !self.is_dense() {
            return true;
        }
        let n = self.block.core.len();
        self.fill(scales, s);
        self.factorise(s);
        let is_known = side.at.iter().copied().eq(self.block.slots().map(|u| last[u as usize]));
        let there = std::mem::take(&mut s.matrix);
        if side.at.is_empty() || !is_known {
            self.slopes_at(last, scales, w, s);
            side.slopes.clone_from(&s.matrix);
        }
        let stays = keeps_signs(&side.slopes, n, s)
            || self.stays_by_halves([&side.slopes, &there], last, values, scales, w, s);
        s.matrix = there;
        if stays {
            side.at.clear();
            side.at.extend(self.block.slots().map(|u| values[u as usize]));
            side.slopes.clone_from(&s.matrix);
        }
        stays
    }

    /// Puts the scaled slopes of a state together.
    fn slopes_at(&self, values: &[f64], scales: &[f64], w: &mut Workspace, s: &mut SquareScratch) {
        w.spend(self.cost());
        self.block.slopes(values, w, &mut s.kept);
        std::mem::swap(&mut s.local, &mut s.kept);
        self.fill(scales, s);
        std::mem::swap(&mut s.local, &mut s.kept);
    }

    /// Asks it of pieces of the way.
    fn stays_by_halves(
        &self,
        slopes: [&[f64]; 2],
        last: &[f64],
        values: &[f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        let n = self.block.core.len();
        let mut between = values.to_vec();
        let whole = Piece { ends: [0.0, 1.0], slopes: slopes.map(<[f64]>::to_vec), halves: HALVES };
        let mut pieces = vec![whole];
        while let Some(Piece { ends, slopes: [from, to], halves }) = pieces.pop() {
            s.factors.clone_from(&to);
            dense::factorise(&mut s.factors, n, &mut s.swaps);
            if keeps_signs(&from, n, s) {
                continue;
            }
            if halves == 0 {
                return false;
            }
            let middle = 0.5 * (ends[0] + ends[1]);
            for slot in self.block.slots().map(|u| u as usize) {
                between[slot] = last[slot] + middle * (values[slot] - last[slot]);
            }
            self.block.compute_defined(&mut between, w);
            self.slopes_at(&between, scales, w, s);
            let (here, halves) = (s.matrix.clone(), halves - 1);
            let first = Piece { ends: [ends[0], middle], slopes: [from, here.clone()], halves };
            pieces.extend([first, Piece { ends: [middle, ends[1]], slopes: [here, to], halves }]);
        }
        true
    }
}

/// Returns true if slopes, eliminated in the order of the factors at hand, have pivots of the signs that these have;
/// what is hardly one in either has none.
fn keeps_signs(slopes: &[f64], n: usize, s: &mut SquareScratch) -> bool {
    s.pivots.clear();
    s.pivots.extend_from_slice(slopes);
    dense::eliminate(&mut s.pivots, n, &s.swaps);
    let most = |a: &[f64]| (0..n).fold(0.0f64, |most, k| most.max(a[k * n + k].abs()));
    let least = [&s.pivots, &s.factors].map(|a| FLAT * most(a));
    let keeps = |k: usize| {
        let [here, there] = [s.pivots[k * n + k], s.factors[k * n + k]];
        here * there > 0.0 || here.abs() <= least[0] || there.abs() <= least[1]
    };
    s.swaps.len() == n && (0..n).all(keeps)
}
