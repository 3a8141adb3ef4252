//! What lies a little aside of a state: where two branches meet, where a row has no slope, and where one holds only
//! because an unknown has run away.

use super::step::normal;
use super::{ROUNDED, Square, SquareScratch, WIDE};
use crate::block::{Local, Workspace};
use crate::dense;
use crate::rows::{Point, generic_number};

/// How far aside slopes are compared, in parts of the extent.
const ASIDE: f64 = 1e-3;

/// How far aside a row is left that has no slope, in parts of the extent.
pub(super) const NUDGES: [f64; 2] = [1e-3, -1e-3];

/// So many extents farther on rows hold no more that are solved; two, so that no period hides it.
const FARTHER: [f64; 2] = [8.0, 13.7];

/// Nothing lies so many extents away.
const FAR: f64 = 1e4;

impl Square {
    /// Returns the direction that the core is free to go in to first order, in scaled unknowns, where the
    /// Jacobian is so nearly singular that two solutions meet to the tolerance of rules. Nothing where
    /// values decide between them, where more than one direction is open, and in a core too large for
    /// dense algebra.
    pub(crate) fn fork(
        &self,
        values: &[f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> Option<Vec<f64>> {
        // two solutions that lie nearer than this are solutions where the other one is: their
        // residual is the square of it
        const MEET: f64 = 3e-5;
        if self.block.is_linear || !self.is_dense() {
            return None;
        }
        let n = self.block.core.len();
        if n == 1 {
            return self.turns(values, MEET, scales, w, s).then(|| vec![1.0]);
        }
        self.block.slopes(values, w, &mut s.local);
        // a distance has no slope where it is nothing
        s.local.jacobian.iter_mut().filter(|d| !d.is_finite()).for_each(|d| *d = 0.0);
        s.own = None;
        self.weigh(scales, s);
        self.weigh_by_bends(values, scales, w, s);
        if self.factorise(s).ratio > 1e-2 {
            return None;
        }
        let (values, vectors) = dense::eigen(normal(&s.matrix, n), n);
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
        let open = MEET * MEET * values[*order.last()?];
        let is_fork = values[order[0]] <= open && order.get(1).is_none_or(|&i| values[i] > open);
        is_fork.then(|| vectors[order[0]].clone())
    }

    /// Returns true if the matrix that was filled last is nearly singular in one direction and in no other, given that
    /// it is in one; false in a core too large for dense algebra.
    pub(super) fn is_nearly_open_once(&self, s: &SquareScratch) -> bool {
        const NEARLY: f64 = 1e-3;
        let n = self.block.core.len();
        if !self.is_dense() || n == 1 {
            return n == 1;
        }
        let (values, _) = dense::eigen(normal(&s.matrix, n), n);
        let most = values.iter().copied().fold(0.0, f64::max);
        values.iter().filter(|&&value| value <= NEARLY * NEARLY * most).count() == 1
    }

    /// Weighs rows by how they bend where that is much more than their slope: one that has none here, as that of an
    /// angle at its extreme, is not made out to be as steep as others.
    fn weigh_by_bends(
        &self,
        values: &[f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) {
        // how much less steep a row is than what its sides come to that may have no slope
        const FLAT: f64 = 1e-3;
        // how much more a row bends that has none
        const MORE: f64 = 1e2;
        let n = self.block.core.len();
        let is_flat = |&r: &u32| {
            let r = r as usize;
            let size = s.local.left[r].abs().max(s.local.right[r].abs());
            size == 0.0 || FLAT * size * s.weight[r] > 1.0
        };
        if !self.block.core_rows.iter().any(is_flat) {
            return;
        }
        let here = s.matrix.clone();
        let mut bends = vec![0.0f64; n];
        for core in 0..n {
            let bent = self.bent(core, values, scales, w, s);
            for (bend, row) in bends.iter_mut().zip(bent.chunks_exact(n)) {
                *bend = row.iter().fold(*bend, |most, d| most.max(d.abs()));
            }
        }
        s.matrix = here;
        for (i, &r) in self.block.core_rows.iter().enumerate() {
            if bends[i] > MORE {
                s.weight[r as usize] /= bends[i];
                s.matrix[i * n..][..n].iter_mut().for_each(|d| *d /= bends[i]);
            }
        }
    }

    /// Returns how the slopes of the core rows, weighted as they are, change with one unknown of the core.
    fn bent(
        &self,
        core: usize,
        values: &[f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> Vec<f64> {
        let mut direction = vec![0.0; self.block.core.len()];
        direction[core] = 1.0;
        let [less, mut more] = [-ASIDE, ASIDE].map(|by| {
            let mut at = values.to_vec();
            self.shift(&mut at, &direction, by, scales, w);
            self.block.slopes(&at, w, &mut s.local);
            // a distance has no slope where it is nothing
            s.local.jacobian.iter_mut().filter(|d| !d.is_finite()).for_each(|d| *d = 0.0);
            self.fill(scales, s);
            s.matrix.clone()
        });
        more.iter_mut().zip(&less).for_each(|(more, less)| *more = (*more - less) / (2.0 * ASIDE));
        more
    }

    /// Measures unknowns of the core, those that `is_plain` says, by how far they have to go for a row to bend by
    /// what it comes to, where that is much farther than their extent: an angle of nearly nothing is no small angle.
    pub(crate) fn measure_plain(
        &self,
        values: &[f64],
        is_plain: &dyn Fn(usize) -> bool,
        scales: &mut [f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) {
        const MUCH: f64 = 10.0;
        if self.block.is_linear || !self.is_dense() {
            return;
        }
        let n = self.block.core.len();
        let plain: Vec<usize> = (0..n).filter(|&core| is_plain(self.slot(core))).collect();
        if plain.is_empty() {
            return;
        }
        self.block.slopes(values, w, &mut s.local);
        let rows = self.block.core_rows.iter().map(|&r| r as usize);
        let sizes: Vec<f64> =
            rows.map(|r| s.local.left[r].abs().max(s.local.right[r].abs())).collect();
        s.weight.clear();
        s.weight.resize(self.block.height(), 1.0);
        s.own = None;
        for core in plain {
            let bent = self.bent(core, values, scales, w, s);
            let far = |(row, size): (usize, &f64)| 2.0 * size / bent[row * n + core].abs();
            let least = sizes.iter().enumerate().map(far).fold(f64::INFINITY, f64::min);
            if least.is_finite() && least > MUCH * MUCH {
                scales[self.slot(core)] *= base::number::sqrt(least);
            }
        }
    }

    /// Returns true if the slope by the one unknown of the core vanishes as near as `meet`, in scaled unknowns: so
    /// far from there lies the other root.
    fn turns(
        &self,
        values: &[f64],
        meet: f64,
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        s.weight.clear();
        s.weight.resize(self.block.height(), 1.0);
        let mut slope = |by: f64| {
            let mut at = values.to_vec();
            self.shift(&mut at, &[1.0], by, scales, w);
            self.block.slopes(&at, w, &mut s.local);
            // a distance has no slope where it is nothing
            s.local.jacobian.iter_mut().filter(|d| !d.is_finite()).for_each(|d| *d = 0.0);
            s.own = None;
            self.fill(scales, s);
            s.matrix[0]
        };
        let [here, more, less] = [0.0, ASIDE, -ASIDE].map(&mut slope);
        here.abs() <= meet * (more - less).abs() / (2.0 * ASIDE)
    }

    /// Moves the core by so much of a direction in scaled unknowns, and what it defines with it.
    pub(crate) fn shift(
        &self,
        values: &mut [f64],
        direction: &[f64],
        by: f64,
        scales: &[f64],
        w: &mut Workspace,
    ) {
        for (core, d) in direction.iter().enumerate() {
            let slot = self.slot(core);
            values[slot] += by * d * scales[slot];
        }
        self.block.compute_defined(values, w);
    }

    /// Moves the core a little aside from where a row has no slope though it does not hold, as `q²` has none at
    /// nothing, and weighs rows anew there; returns false, with all as it was, where no row has much more of a slope.
    pub(super) fn leaves_crest(
        &self,
        by: f64,
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        const STEEPER: f64 = 1e3;
        if !self.is_dense() {
            return false;
        }
        let n = self.block.core.len();
        let slopes = |s: &mut SquareScratch| -> Vec<f64> {
            s.weight.iter_mut().for_each(|weight| *weight = 1.0);
            self.fill(scales, s);
            let size = |row: &[f64]| row.iter().fold(0.0f64, |most, d| most.max(d.abs()));
            s.matrix.chunks_exact(n).map(size).collect()
        };
        let (start, weight) = (values.to_vec(), s.weight.clone());
        let here = slopes(s);
        let direction: Vec<f64> =
            (0..n as u64).map(|i| generic_number(i, Point::Positive)).collect();
        self.shift(values, &direction, by, scales, w);
        self.evaluate(values, w, s);
        let there = slopes(s);
        let leaves = here.iter().zip(&there).any(|(here, there)| *there > STEEPER * *here);
        if leaves && there.iter().all(|slope| slope.is_finite()) {
            s.own = None;
            self.weigh(scales, s);
            return true;
        }
        values.copy_from_slice(&start);
        self.evaluate(values, w, s);
        s.weight = weight;
        false
    }

    /// Returns true if rows hold only because an unknown goes on and on, until rounding takes for nothing what it makes,
    /// as where `exp(x)` is to be nothing: they hold as well much farther on. That is asked where the last step, so
    /// long, was no rounding, and where none was needed though it was not stood there before.
    pub(super) fn goes_on(
        &self,
        last: &[f64],
        values: &[f64],
        size: f64,
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        let n = self.block.core.len();
        // a piece of a function may be flat
        if self.block.is_linear || self.block.has_pieces() {
            return false;
        }
        let stood = || (0..n).all(|c| last.get(self.slot(c)) == Some(&values[self.slot(c)]));
        let is_asked = match size > 0.0 {
            true => size > ROUNDED,
            false => self.is_dense() && self.is_flat(scales, s) && !stood(),
        };
        if !is_asked {
            return false;
        }
        if size > 0.0 {
            let along = (0..n).map(|c| s.step[c] / (size * scales[self.slot(c)]));
            return self.hold_farther(&along.collect::<Vec<f64>>(), values, scales, w, s);
        }
        (0..n).any(|core| {
            let mut along = vec![0.0; n];
            along[core] = 1.0;
            self.hold_farther(&along, values, scales, w, s)
        })
    }

    /// Returns true if a row, as it was evaluated last, has slopes, but none that an extent would show.
    fn is_flat(&self, scales: &[f64], s: &SquareScratch) -> bool {
        let block = &self.block;
        (0..block.height()).any(|r| {
            let slope =
                |e| s.local.jacobian[e] * scales[block.unknowns[block.pattern.column(e)] as usize];
            let most = block.pattern.range(r).map(slope).fold(0.0f64, |most, d| most.max(d.abs()));
            most > 0.0 && most <= rounding(&s.local, r)
        })
    }

    /// Returns true if the rows, as they were evaluated last, hold as well many extents farther on, to one side or the
    /// other.
    fn hold_farther(
        &self,
        along: &[f64],
        values: &[f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        let off = |sides: &Local, r: usize| (sides.left[r] - sides.right[r]).abs();
        [1.0, -1.0].into_iter().any(|side| {
            FARTHER.into_iter().all(|by| {
                let mut there = values.to_vec();
                self.shift(&mut there, along, side * by, scales, w);
                self.block.sides(&there, w, &mut s.kept);
                (0..self.block.height())
                    .all(|r| off(&s.kept, r) <= off(&s.local, r).max(rounding(&s.kept, r)))
            })
        })
    }

    /// Returns true if rows hold only because an unknown has gone so far that nothing depends on it any more:
    /// Newton's step from there is no smaller than what it has come to, as where `1 / r` is to vanish, or there is
    /// none so far out, as where parallels are to meet.
    pub(super) fn runs_away(
        &self,
        values: &[f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        self.block.slopes(values, w, &mut s.local);
        self.fill(scales, s);
        if self.factorise(s).ratio == 0.0 {
            let is_far = |slot: usize| values[slot].abs() > FAR * scales[slot];
            return (0..self.block.core.len()).any(|c| is_far(self.slot(c)));
        }
        self.newton(scales, s);
        (0..s.step.len()).any(|c| {
            let slot = self.slot(c);
            s.step[c].abs() > WIDE * values[slot].abs().max(scales[slot])
        })
    }
}

/// Returns what rounding makes the sides of a row differ by.
fn rounding(sides: &Local, row: usize) -> f64 {
    4.0 * f64::EPSILON * sides.left[row].abs().max(sides.right[row].abs())
}
