//! Steps: what all levels together ask for at a state.
//!
//! In: a block at a state, in scaled unknowns and weighted rows. Out: the step. Each level has what the levels above
//! leave free; the curvature of what they multiply counts.

use super::levels::Asked;
use super::{Large, Measure, Scaled};
use crate::block::Workspace;
use crate::dense::{self, Spaces};
use crate::system::{Level, Turn};

/// Curvature below this, where one is ordinary, leaves a direction to the next level.
const FLAT: f64 = 1e-9;
/// A slope above this is one, even where there is no curvature.
const SLOPING: f64 = 1e-6;
/// Rows whose slopes in free directions come to more than this part of their squares can be met there.
const STEEP: f64 = 1e-2;
/// A wish is at its worst, and not at its best, where it is bent down more than this, where ordinary curvature is one.
const CREST: f64 = 1e-6;

/// What all levels together ask for, in scaled unknowns.
pub(super) struct Direction {
    pub(super) step: Vec<f64>,
    /// Where the highest level that is bent down somewhere is.
    pub(super) crest: Option<Crest>,
}

/// A direction in which the errors of a level grow less to both sides.
pub(super) struct Crest {
    pub(super) level: Level,
    pub(super) along: Vec<f64>,
}

impl Measure {
    /// The step that all levels together ask for.
    pub(super) fn direction(
        &self,
        local: &Scaled,
        away: &[f64],
        weights: &[f64],
        values: &[f64],
        w: &mut Workspace,
    ) -> Direction {
        if let Some(Large::Linear(large)) = &self.large {
            let step = large.step(Asked {
                pattern: &self.block.pattern,
                slopes: &local.slopes,
                residual: &local.residual,
                levels: &self.levels,
                turns: &self.turns,
                away,
            });
            return Direction { step, crest: None };
        }
        let n = self.unknowns.len();
        let of_level =
            |level: Level| (0..self.levels.len()).filter(move |&r| self.levels[r] == level);
        let mut above: Vec<usize> = of_level(Level::Required).collect();
        let hard: Vec<Vec<f64>> = above.iter().map(|&r| local.jacobian[r].clone()).collect();
        let Spaces { range, null } = dense::spaces(&hard, n);
        let mut step = least_norm(&above, local, &range, n);
        let mut free = null;
        let mut crest = None;
        for level in Level::SOFT {
            let own: Vec<usize> = of_level(level).collect();
            if own.is_empty() || free.is_empty() {
                continue;
            }
            let mut gradient = vec![0.0; n];
            let mut hessian = vec![0.0; n * n];
            for &r in &own {
                dense::add(&mut gradient, local.residual[r], &local.jacobian[r]);
                for i in 0..n {
                    for j in 0..n {
                        hessian[i * n + j] += local.jacobian[r][i] * local.jacobian[r][j];
                    }
                }
            }
            let flat = hessian.clone();
            let mut factor = self.multipliers(local, &above, &gradient);
            for &r in &own {
                factor[r] += local.residual[r];
            }
            self.add_curvature(local, &factor, weights, values, w, &mut hessian);
            let to_meet = meeting_step(&own, &free, local);
            let meets = |step: &Vec<f64>| can_be_met(&own, local, step, [&hessian, &flat]);
            if to_meet.as_ref().is_some_and(meets) {
                hessian.clone_from(&flat);
            }
            let descended = descend(&mut step, &free, &gradient, [&hessian, &flat], n);
            free = descended.left;
            crest = crest.or_else(|| Some(Crest { level, along: descended.crest? }));
            above.extend(own);
        }
        for turn in Turn::ALL {
            if free.is_empty() {
                break;
            }
            let mut gradient = vec![0.0; n];
            let mut hessian = vec![0.0; n * n];
            let mut is_empty = true;
            for i in (0..n).filter(|&i| self.turns[i] == turn) {
                is_empty = false;
                gradient[i] = away[i];
                hessian[i * n + i] = 1.0;
            }
            if is_empty {
                continue;
            }
            let factor = self.multipliers(local, &above, &gradient);
            let flat = hessian.clone();
            self.add_curvature(local, &factor, weights, values, w, &mut hessian);
            free = descend(&mut step, &free, &gradient, [&hessian, &flat], n).left;
        }
        Direction { step, crest }
    }

    /// Multipliers of the rows above that best balance a gradient, by row.
    fn multipliers(&self, local: &Scaled, above: &[usize], gradient: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.levels.len()];
        let m = above.len();
        if m == 0 {
            return out;
        }
        // the smallest solution of the normal equations, by eigenvectors: rows may depend
        let mut normal = vec![0.0; m * m];
        let mut right = vec![0.0; m];
        for (i, &r) in above.iter().enumerate() {
            for (j, &q) in above.iter().enumerate() {
                normal[i * m + j] = dense::dot(&local.jacobian[r], &local.jacobian[q]);
            }
            right[i] = -dense::dot(&local.jacobian[r], gradient);
        }
        let (values, vectors) = dense::eigen(normal, m);
        let largest = values.iter().fold(0.0f64, |a, v| a.max(*v));
        for (value, v) in values.iter().zip(&vectors) {
            if *value > 1e-12 * largest {
                let along = dense::dot(v, &right) / value;
                for (i, &r) in above.iter().enumerate() {
                    out[r] += along * v[i];
                }
            }
        }
        out
    }

    /// Adds the second derivatives of the core's rows, each times its factor, to the Hessian.
    fn add_curvature(
        &self,
        local: &Scaled,
        factor: &[f64],
        weights: &[f64],
        values: &[f64],
        w: &mut Workspace,
        hessian: &mut [f64],
    ) {
        if self.is_linear {
            return;
        }
        let (block, n) = (&self.block, self.unknowns.len());
        let mut by_row = vec![0.0; block.height()];
        for ((&r, f), weight) in block.core_rows.iter().zip(factor).zip(weights) {
            by_row[r as usize] = f * weight;
        }
        block.pass_back(&local.local, &mut by_row);
        block.each_second(values, w, &mut |row, places, out| {
            for place in places {
                let value = by_row[row] * place.of(out);
                if !value.is_finite() || value == 0.0 {
                    continue;
                }
                let (i, j) = (place.i as usize, place.j as usize);
                let mirror = if i == j { 1 } else { 2 };
                for (i, j) in [(i, j), (j, i)].into_iter().take(mirror) {
                    let (from, to) =
                        (&local.gradients[i * n..][..n], &local.gradients[j * n..][..n]);
                    for (a, x) in from.iter().enumerate().filter(|g| *g.1 != 0.0) {
                        dense::add(&mut hessian[a * n..][..n], value * x, to);
                    }
                }
            }
        });
    }
}

/// The smallest step that makes the linearised hard rows hold, or nearly so where they contradict.
fn least_norm(rows: &[usize], local: &Scaled, range: &[Vec<f64>], n: usize) -> Vec<f64> {
    let k = range.len();
    let mut normal = vec![0.0; k * k];
    let mut right = vec![0.0; k];
    for &r in rows {
        let along: Vec<f64> = range.iter().map(|q| dense::dot(q, &local.jacobian[r])).collect();
        for i in 0..k {
            right[i] -= along[i] * local.residual[r];
            for j in 0..k {
                normal[i * k + j] += along[i] * along[j];
            }
        }
    }
    let mut swaps = Vec::new();
    dense::factorise(&mut normal, k, &mut swaps);
    if swaps.len() == k {
        dense::substitute_back(&normal, k, &swaps, &mut right);
    }
    let mut step = vec![0.0; n];
    for (q, y) in range.iter().zip(&right) {
        dense::add(&mut step, *y, q);
    }
    step
}

/// Returns the shortest step in the free directions that meets rows as far as their slopes tell; nothing where these
/// tell of none.
fn meeting_step(rows: &[usize], free: &[Vec<f64>], local: &Scaled) -> Option<Vec<f64>> {
    if rows.len() > free.len() {
        return None;
    }
    let along = |&r: &usize| -> Vec<f64> {
        free.iter().map(|z| dense::dot(z, &local.jacobian[r])).collect()
    };
    let along: Vec<Vec<f64>> = rows.iter().map(along).collect();
    let gram = along.iter().flat_map(|a| along.iter().map(|b| dense::dot(a, b))).collect();
    let (values, vectors) = dense::eigen(gram, rows.len());
    let size = |&r: &usize| dense::dot(&local.jacobian[r], &local.jacobian[r]);
    let largest = rows.iter().map(size).fold(0.0, f64::max);
    if values.iter().any(|value| *value <= STEEP * largest) {
        return None;
    }
    let residual: Vec<f64> = rows.iter().map(|&r| local.residual[r]).collect();
    let mut step = vec![0.0; local.jacobian[rows[0]].len()];
    for (value, v) in values.iter().zip(&vectors) {
        let part = -dense::dot(v, &residual) / value;
        for (row, by) in along.iter().zip(v) {
            for (z, slope) in free.iter().zip(row) {
                dense::add(&mut step, part * by * slope, z);
            }
        }
    }
    Some(step)
}

/// Returns true if what is left of rows comes to nothing on the way of a step, by their slopes and curvatures: then
/// the slopes tell the way, and curvature, which counts where rows cannot be met, would lead across it. What is left
/// of a quotient's wish, say, would lead both numbers to nothing. The Hessian comes with and without curvature.
fn can_be_met(rows: &[usize], local: &Scaled, step: &[f64], [hessian, flat]: [&[f64]; 2]) -> bool {
    let left: f64 = rows.iter().map(|&r| local.residual[r] * local.residual[r]).sum();
    let n = step.len();
    let row = |i: usize| {
        let (with, without) = (&hessian[i * n..][..n], &flat[i * n..][..n]);
        step[i] * (dense::dot(with, step) - dense::dot(without, step))
    };
    // 1 - t + (bend / left) t² / 2 has a root
    let bend: f64 = (0..n).map(row).sum();
    2.0 * bend <= left
}

/// What a level's step leaves.
struct Descended {
    /// The directions that it leaves free.
    left: Vec<Vec<f64>>,
    /// The direction, of length one, in which it is bent down most, if it is.
    crest: Option<Vec<f64>>,
}

/// Adds the step that is best for one level in the free directions. The
/// Hessian comes with and without the curvature of the rows: where both slopes and curvatures balance to
/// nothing but a slope (a crank a quarter turn from its wish), the level's own curvature decides.
fn descend(
    step: &mut [f64],
    free: &[Vec<f64>],
    gradient: &[f64],
    [hessian, own]: [&[f64]; 2],
    n: usize,
) -> Descended {
    let k = free.len();
    let apply =
        |v: &[f64]| -> Vec<f64> { (0..n).map(|i| dense::dot(&hessian[i * n..][..n], v)).collect() };
    let mut slope = gradient.to_vec();
    dense::add(&mut slope, 1.0, &apply(step));
    let mut reduced = vec![0.0; k * k];
    for (i, z) in free.iter().enumerate() {
        let hz = apply(z);
        for (j, y) in free.iter().enumerate() {
            reduced[i * k + j] = dense::dot(y, &hz);
        }
    }
    let (values, vectors) = dense::eigen(reduced, k);
    let mut left = Vec::new();
    let (mut lowest, mut crest) = (-CREST, None);
    for (value, v) in values.iter().zip(&vectors) {
        let mut along = vec![0.0; n];
        for (z, part) in free.iter().zip(v) {
            dense::add(&mut along, *part, z);
        }
        if *value < lowest {
            (lowest, crest) = (*value, Some(along.clone()));
        }
        let down = -dense::dot(&along, &slope);
        if value.abs() > FLAT {
            dense::add(step, down / value.abs(), &along);
            continue;
        }
        let mut bend = 0.0;
        for (i, a) in along.iter().enumerate() {
            bend += a * dense::dot(&own[i * n..][..n], &along);
        }
        if bend > FLAT && down.abs() > SLOPING {
            dense::add(step, down / bend, &along);
        } else {
            left.push(along);
        }
    }
    Descended { left, crest: crest.map(to_grow) }
}

/// Returns a direction or its opposite: that in which the unknown that moves most grows, of several the first.
fn to_grow(mut along: Vec<f64>) -> Vec<f64> {
    let largest = along.iter().fold(0.0f64, |size, d| size.max(d.abs()));
    if along.iter().find(|d| d.abs() > 0.999 * largest).is_some_and(|first| *first < 0.0) {
        along.iter_mut().for_each(|d| *d = -*d);
    }
    along
}
