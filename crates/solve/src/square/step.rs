//! Steps: Newton's, that of Levenberg and Marquardt, and what their matrix says where it has hardly an inverse.
//!
//! In: the scaled slopes of the core, what its rows are off by. Out: the step, in the scratch.

use super::{Solved, Square, SquareScratch};
use crate::dense;
use crate::sparse::damped::Damped;
use crate::system::SlotIndex;
use std::rc::Rc;

/// The largest core whose least determined unknown is sought by eigenvectors.
const EIGEN: usize = 30;

impl Square {
    /// Newton's step for the core, from the factors.
    pub(super) fn newton(&self, scales: &[f64], s: &mut SquareScratch) {
        let weighted = s.residual.iter().zip(&self.block.core_rows);
        if self.is_dense() {
            s.step.clear();
            s.step.extend(weighted.map(|(v, &r)| -v * s.weight[r as usize]));
            dense::substitute_back(&s.factors, self.block.core.len(), &s.swaps, &mut s.step);
        } else {
            s.right.clear();
            s.right.resize(self.block.height(), 0.0);
            for (v, &r) in weighted {
                s.right[r as usize] = -v * s.weight[r as usize];
            }
            let symbolic = s.own.as_ref().or(self.pivots.get().map(Rc::as_ref));
            let symbolic = symbolic.expect("there are factors");
            symbolic.solve(&mut s.lu, &mut s.right);
            s.step.clear();
            s.step.extend(self.block.core.iter().map(|&u| s.right[u as usize]));
        }
        for (c, step) in s.step.iter_mut().enumerate() {
            *step *= scales[self.slot(c)];
        }
    }

    /// Returns true if slopes change by more than themselves along the step that was taken from where they were: what
    /// it comes to may lie on any branch. Of a core whose linear algebra is sparse that is not asked.
    ///
    /// **Source:** Kantorovich's condition, as in Deuflhard, *Newton Methods for Nonlinear Problems* (2004), 2.1.
    pub(super) fn bends(&self, scales: &[f64], s: &SquareScratch) -> bool {
        if !self.is_dense() || self.block.is_linear {
            return false;
        }
        let n = self.block.core.len();
        let (mut changed, mut before) = (0.0, 0.0);
        for (i, (row, &r)) in s.matrix.chunks_exact(n).zip(&self.block.core_rows).enumerate() {
            // what the slopes of before make of the step is what the row was off by
            let off = s.kept_residual[i] * s.weight[r as usize];
            let step = s.step.iter().enumerate();
            let now: f64 =
                row.iter().zip(step).map(|(a, (c, d))| a * d / scales[self.slot(c)]).sum();
            changed += (now + off) * (now + off);
            before += off * off;
        }
        changed > before
    }

    pub(super) fn weighted_norm(&self, s: &SquareScratch) -> f64 {
        let mut sum = 0.0;
        for (v, &r) in s.residual.iter().zip(&self.block.core_rows) {
            let w = s.weight[r as usize];
            sum += (v * w) * (v * w);
        }
        base::number::sqrt(sum)
    }

    pub(super) fn step_size(&self, scales: &[f64], s: &SquareScratch) -> f64 {
        let mut size = 0.0f64;
        for (c, d) in s.step.iter().enumerate() {
            size = size.max((d / scales[self.slot(c)]).abs());
        }
        size
    }

    /// The step of Levenberg and Marquardt in scaled unknowns.
    pub(super) fn damped_direction(&self, scales: &[f64], damping: f64, s: &mut SquareScratch) {
        let n = self.block.core.len();
        s.right.clear();
        if self.is_dense() {
            let weighted = s.residual.iter().zip(&self.block.core_rows);
            s.right.extend(weighted.map(|(v, &r)| -v * s.weight[r as usize]));
            normal_step(&s.matrix, n, damping, &s.right, &mut s.factors, &mut s.swaps, &mut s.step);
        } else {
            self.damped_sparse(damping, s);
        }
        for (c, d) in s.step.iter_mut().enumerate() {
            *d *= scales[self.slot(c)];
        }
    }

    /// The damped step of all unknowns; no step where there is none.
    fn damped_sparse(&self, damping: f64, s: &mut SquareScratch) {
        let block = &self.block;
        let made = self.damped.get_or_init(|| Damped::new(&block.pattern));
        s.right.clear();
        s.right.resize(block.height(), 0.0);
        for (v, &r) in s.residual.iter().zip(&block.core_rows) {
            s.right[r as usize] = -v * s.weight[r as usize];
        }
        let found = made.step(&s.matrix, s.right.iter().copied(), damping, &mut s.damped);
        s.step.clear();
        match found {
            Some(step) => s.step.extend(block.core.iter().map(|&u| step[u as usize])),
            None => s.step.resize(block.core.len(), 0.0),
        }
    }

    /// The unknown whose column the others come nearest to replacing; in a large core, the one that
    /// moved most in the end.
    pub(super) fn least_determined(&self, s: &mut SquareScratch) -> Solved {
        let n = self.block.core.len();
        let largest =
            |v: &[f64]| (0..n).fold(0, |best, c| if v[c].abs() > v[best].abs() { c } else { best });
        if !self.is_dense() || n > EIGEN {
            return Solved::Double(self.slot(largest(&s.step)) as SlotIndex);
        }
        let (values, vectors) = dense::eigen(normal(&s.matrix, n), n);
        let least = (0..n).min_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap_or(0);
        Solved::Double(self.slot(largest(&vectors[least])) as SlotIndex)
    }
}

/// Returns `AᵀA` of a square matrix.
pub(super) fn normal(matrix: &[f64], n: usize) -> Vec<f64> {
    let mut normal = vec![0.0; n * n];
    for row in matrix.chunks_exact(n) {
        for i in 0..n {
            for j in 0..n {
                normal[i * n + j] += row[i] * row[j];
            }
        }
    }
    normal
}

/// Solves `(AᵀA + damping) step = Aᵀ right`.
fn normal_step(
    matrix: &[f64],
    n: usize,
    damping: f64,
    right: &[f64],
    normal: &mut Vec<f64>,
    swaps: &mut Vec<usize>,
    step: &mut Vec<f64>,
) {
    normal.clear();
    normal.resize(n * n, 0.0);
    step.clear();
    step.resize(n, 0.0);
    for (row, b) in matrix.chunks_exact(n).zip(right) {
        dense::add(step, *b, row);
        for i in 0..n {
            dense::add(&mut normal[i * n..][..n], row[i], row);
        }
    }
    for i in 0..n {
        normal[i * n + i] += damping;
    }
    dense::factorise(normal, n, swaps);
    dense::substitute_back(normal, n, swaps, step);
}

/// Returns how much the step after one that made the residuals smaller is held back.
pub(super) fn next_damping(damping: f64, newton: bool, is_short: bool) -> f64 {
    let next = match () {
        // along a narrow valley steps that are held back go further
        () if is_short => (damping * 10.0).max(1e-6),
        () if newton => 0.0,
        () => damping * 0.1,
    };
    if next < 1e-10 { 0.0 } else { next }
}
