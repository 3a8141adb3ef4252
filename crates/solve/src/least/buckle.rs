//! Buckling: how a block leaves a state in which its rows depend on one another.
//!
//! In: rows that held where the unknowns are, asked for a little more. A straight chain that is pushed together
//! is such a state, and a crank at its dead centre: some sum of the rows has no slope, so that no step to first
//! order makes it hold, and no direction is nearer than the opposite one. Out: the unknowns moved by the least
//! change that makes the sum hold to second order. With `λ` that sum, `λJ = 0`, it is `λr + ½ dᵀ(λH)d = 0`
//! for the smallest `d` that the rows leave free: the direction of the greatest curvature there, found by
//! Lanczos' method. Of it and its opposite the one is taken that slopes tell which are next to none; where they are
//! none, that in which the unknown that moves most grows; of several that move as far, the first.
//!
//! **Source:** Koiter's theory of initial post-buckling in Thompson and Hunt, *A General Theory of Elastic
//! Stability* (1973), ch. 2; Golub and Van Loan, *Matrix Computations*, 4th ed., §10.1.

use super::{Counted, DELTA, Least, LeastScratch, Matrix};
use crate::block::Workspace;
use crate::dense;
use crate::rows::{Point, generic_number};
use base::number::RULE_TOLERANCE;

/// Slopes of a sum below this, squared, are none: what they move holds to the tolerance of rules as well.
const FLAT: f64 = 1e-8;
/// How often the sum without slope is looked for: what is wrong with it shrinks by a thousand each time.
const ROUNDS: usize = 4;
/// In how many directions curvature is looked at.
const DIRECTIONS: usize = 48;

impl Least {
    /// Moves the unknowns by the least change that makes the rows hold to second order where to first order none
    /// does; returns false, and moves nothing, where a step does or where the rows bend the other way.
    pub(crate) fn buckle(
        &self,
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut LeastScratch,
    ) -> bool {
        let block = &self.block;
        let (n, m) = (block.unknowns.len(), block.height());
        s.came.has_factors = false;
        s.measure(block, scales);
        self.evaluate(Counted::All, values, w, s);
        self.weigh(s);
        self.flatten(s);
        let flattened = self.flatten_what_bends(values, w, s);
        if self.factorise(Counted::All, values, Matrix::Flat, w, s).is_none() {
            return false;
        }
        let Some((mut sum, off)) = self.sum_without_slope(s) else { return false };
        // what the sum is off by is to be made up for
        if off > 0.0 {
            sum.iter_mut().for_each(|factor| *factor = -*factor);
        }
        let mut curvature = Vec::with_capacity(block.seconds().len());
        block.each_second(values, w, &mut |row, places, out| {
            let factor = sum[row];
            curvature.extend(places.iter().map(|place| {
                let second = factor * place.of(out);
                if second.is_finite() { second } else { 0.0 }
            }));
        });
        w.spend(DIRECTIONS * (DIRECTIONS * n + 20 * (n + m + block.pattern.len())));
        let Some((bend, along)) = self.greatest(&curvature, s) else { return false };
        let size = base::number::sqrt(2.0 * off.abs() / bend);
        if !size.is_finite() || size > 0.5 {
            return false;
        }
        let largest = along.iter().fold(0.0f64, |size, d| size.max(d.abs()));
        let first = along.iter().find(|d| d.abs() > 0.999 * largest).copied().unwrap_or(1.0);
        // where what is left of the slopes tells, the sum grows that way
        let slope = |&(row, e, slope): &(usize, usize, f64)| {
            let unknown = block.pattern.column(e);
            sum[row] * slope * s.scale[unknown] * along[unknown]
        };
        let tells: f64 = flattened.iter().map(slope).sum();
        let by = size.copysign(if tells == 0.0 { first } else { tells });
        for ((&u, d), scale) in block.unknowns.iter().zip(&along).zip(&s.scale) {
            values[u as usize] += by * d * scale;
        }
        true
    }

    /// Takes the slopes of rows for none that vanish so near by that rows hold there as well, as those of `q²` next to
    /// nothing; returns what they were, by row and entry.
    fn flatten_what_bends(
        &self,
        values: &[f64],
        w: &mut Workspace,
        s: &mut LeastScratch,
    ) -> Vec<(usize, usize, f64)> {
        let block = &self.block;
        let mut flattened = Vec::new();
        let LeastScratch { local, scale, steepness, .. } = s;
        let mut along = vec![0.0; block.unknowns.len()];
        block.each_second(values, w, &mut |row, places, out| {
            let slopes = block.pattern.range(row);
            let columns = slopes.clone().map(|e| (e, block.pattern.column(e)));
            columns.clone().for_each(|(e, c)| along[c] = local.jacobian[e] * scale[c]);
            // how much the row bends along its slopes, times their square
            let bend: f64 = places
                .iter()
                .map(|place| {
                    let (i, j) = (place.i as usize, place.j as usize);
                    let twice = if i == j { 1.0 } else { 2.0 };
                    twice * place.of(out) * scale[i] * scale[j] * along[i] * along[j]
                })
                .sum();
            columns.for_each(|(_, c)| along[c] = 0.0);
            let size = local.left[row].abs().max(local.right[row].abs()).max(1.0);
            let steep = steepness[row];
            if steep * steep <= 2.0 * bend.abs() * RULE_TOLERANCE * size && bend.is_finite() {
                steepness[row] = 1.0;
                flattened.extend(slopes.map(|e| (row, e, std::mem::take(&mut local.jacobian[e]))));
            }
        });
        flattened
    }

    /// Returns the factors of a sum of the rows that has no slope, and what it is off by; nothing where there is none
    /// that is off. Inverse iteration by the factors, from what the rows are off by.
    fn sum_without_slope(&self, s: &mut LeastScratch) -> Option<(Vec<f64>, f64)> {
        let (n, m) = (self.block.unknowns.len(), self.block.height());
        let errors = s.local.left.iter().zip(&s.local.right).map(|(left, right)| left - right);
        let errors: Vec<f64> = errors.collect();
        let mut sum: Vec<f64> = errors.iter().zip(&s.steepness).map(|(e, by)| e / by).collect();
        let mut slope = f64::INFINITY;
        for _ in 0..ROUNDS {
            let size = s.size_of_sum(&sum);
            if !(size > 0.0 && size.is_finite()) {
                return None;
            }
            sum.iter_mut().for_each(|factor| *factor /= size);
            s.right.clear();
            s.right.resize(n, 0.0);
            s.right.extend(sum.iter().zip(&s.steepness).map(|(factor, by)| factor * by));
            self.structure().solve(&mut s.ldl, &mut s.right);
            // of a sum of slope `σ` the factor of `-1 / (σ² + δ)` is left
            slope = 1.0 / s.size_of_sum(&s.right[n..]) - DELTA;
            sum.clear();
            sum.extend(s.right[n..].iter().map(|factor| -factor));
        }
        let size = s.size_of_sum(&sum);
        sum.iter_mut().for_each(|factor| *factor /= size);
        debug_assert_eq!(sum.len(), m, "a factor for every row");
        let off = dense::dot(&sum, &errors);
        (slope.abs() <= FLAT && off != 0.0).then_some((sum, off))
    }

    /// Returns the greatest curvature in the directions that the rows leave free, and its direction, of length one in
    /// scaled unknowns; nothing where none is bent that way.
    fn greatest(&self, curvature: &[f64], s: &mut LeastScratch) -> Option<(f64, Vec<f64>)> {
        let n = self.block.unknowns.len();
        let (mut basis, mut images): (Vec<Vec<f64>>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
        let mut next: Vec<f64> = (0..n as u64).map(|i| generic_number(i, Point::Mixed)).collect();
        while basis.len() < DIRECTIONS.min(n) {
            // twice, so that what rounding leaves of the others is gone too
            for _ in 0..2 {
                self.leave_free(&mut next, s);
                basis.iter().for_each(|other| {
                    let along = dense::dot(other, &next);
                    dense::add(&mut next, -along, other);
                });
            }
            let size = dense::norm(&next);
            if size.is_nan() || size <= 1e-9 {
                break;
            }
            next.iter_mut().for_each(|d| *d /= size);
            let mut image = vec![0.0; n];
            for (place, second) in self.block.seconds().iter().zip(curvature) {
                let (i, j) = (place.i as usize, place.j as usize);
                let value = second * s.scale[i] * s.scale[j];
                image[i] += value * next[j];
                if i != j {
                    image[j] += value * next[i];
                }
            }
            basis.push(std::mem::replace(&mut next, image.clone()));
            let size = dense::norm(&next);
            next.iter_mut().for_each(|d| *d /= size);
            images.push(image);
        }
        let k = basis.len();
        let mut reduced = vec![0.0; k * k];
        for (i, direction) in basis.iter().enumerate() {
            for (j, image) in images.iter().enumerate() {
                reduced[i * k + j] = dense::dot(direction, image);
            }
        }
        let (values, vectors) = dense::eigen(reduced, k);
        let (bend, parts) = values.into_iter().zip(vectors).max_by(|a, b| a.0.total_cmp(&b.0))?;
        let mut along = vec![0.0; n];
        basis
            .iter()
            .zip(&parts)
            .for_each(|(direction, part)| dense::add(&mut along, *part, direction));
        (bend > FLAT).then_some((bend, along))
    }

    /// Takes what the rows do not leave free out of a direction in scaled unknowns.
    fn leave_free(&self, direction: &mut [f64], s: &mut LeastScratch) {
        s.right.clear();
        s.right.extend(direction.iter().zip(&s.scale).map(|(d, scale)| d / scale));
        s.right.resize(s.right.len() + self.block.height(), 0.0);
        self.structure().solve(&mut s.ldl, &mut s.right);
        for ((d, x), scale) in direction.iter_mut().zip(&s.right).zip(&s.scale) {
            *d = x / scale;
        }
    }
}

impl LeastScratch {
    /// Returns how large a sum of rows is, by its factors.
    fn size_of_sum(&self, factors: &[f64]) -> f64 {
        let parts = factors.iter().zip(&self.steepness);
        base::number::sqrt(parts.map(|(factor, by)| factor * factor * by).sum())
    }
}
