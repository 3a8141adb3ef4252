//! Further solutions of a square block, beside those that are known.
//!
//! In: the block, where to start, the solutions known. Out: another one, in place, or none. The steps
//! are Newton's for the residuals times `1 + 1 / distance` of every known solution: the same direction,
//! another length, so that what is known repels and nothing new has to be factorised.
//!
//! **Source:** Farrell, Birkisson, Funke, *Deflation techniques for finding distinct solutions of
//! nonlinear partial differential equations*, SIAM J. Sci. Comput. 37, 2015.

use super::{Course, Side, Solved, Square, SquareScratch, Trust};
use crate::block::Workspace;

/// How many steps are taken.
const STEPS: usize = 60;
/// Solutions nearer to each other than this, in scaled unknowns, are one where rows hold between them as well.
const APART: f64 = 1e-6;
/// Those that differ by less than this part of them are one.
const ALIKE: f64 = 1e-6;
/// The longest stretch of a step.
const STRETCH: f64 = 8.0;
/// The shortest step, as a part of the whole.
const SHORTEST: f64 = 1e-4;

impl Square {
    /// Looks for a solution other than the known ones, from the values that the unknowns have now.
    ///
    /// A known solution is a value for each unknown, in their order. Returns true if one was found.
    pub(crate) fn further(
        &self,
        known: &[Vec<f64>],
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        s.own = None;
        self.evaluate(values, w, s);
        self.weigh(scales, s);
        for _ in 0..STEPS {
            if self.holds(values, w, s) {
                let side = &mut Side::default();
                let course = Course { last: &[], trust: Trust::Any, side };
                let end = self.solve(course, values, scales, w, s);
                return end != Solved::Failed && self.is_apart(known, values, scales, w, s);
            }
            self.fill(scales, s);
            if self.factorise(s).ratio > 1e-14 {
                self.newton(scales, s);
            } else {
                self.damped_direction(scales, 1e-6, s);
            }
            let stretch = self.stretch(known, values, scales, s);
            let size = self.step_size(scales, s) * stretch.abs();
            let longest = if size > 0.5 { 0.5 / size } else { 1.0 };
            s.step.iter_mut().for_each(|d| *d *= longest * stretch);
            if !self.downhill(known, values, scales, w, s) {
                return false;
            }
        }
        false
    }

    /// Walks along the step, halving it until the residuals, repelled, are smaller.
    fn downhill(
        &self,
        known: &[Vec<f64>],
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        let before = self.weighted_norm(s) * self.repulsion(known, values, scales);
        s.start.clear();
        s.start.extend((0..s.step.len()).map(|c| values[self.slot(c)]));
        let mut length = 1.0;
        while length >= SHORTEST {
            for (c, (start, d)) in s.start.iter().zip(&s.step).enumerate() {
                values[self.slot(c)] = start + length * d;
            }
            self.evaluate(values, w, s);
            let now = self.weighted_norm(s) * self.repulsion(known, values, scales);
            if now.is_finite() && now < (1.0 - 1e-4 * length) * before {
                return true;
            }
            length *= 0.5;
        }
        false
    }

    fn repulsion(&self, known: &[Vec<f64>], values: &[f64], scales: &[f64]) -> f64 {
        let factor = |solution: &Vec<f64>| {
            let mut square = 0.0;
            for c in 0..self.block.core.len() {
                let slot = self.slot(c);
                let off = (values[slot] - solution[self.block.core[c] as usize]) / scales[slot];
                square += off * off;
            }
            1.0 + 1.0 / base::number::sqrt(square)
        };
        known.iter().map(factor).product()
    }

    /// Returns true if the unknowns are at none of these solutions.
    pub(crate) fn is_apart(
        &self,
        known: &[Vec<f64>],
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        known.iter().all(|solution| !self.is_at(solution, values, scales, w, s))
    }

    /// Returns true if the unknowns are at a solution. What is small where numbers of its kind are large tells others
    /// apart as well: between them rows do not hold.
    fn is_at(
        &self,
        solution: &[f64],
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        let unknowns = self.block.unknowns.iter().map(|&u| u as usize).zip(solution);
        let lies_within = |part: f64, least: &dyn Fn(usize) -> f64, values: &[f64]| {
            let off =
                |(u, at): (usize, &f64)| (values[u] - at).abs() <= part * least(u).max(at.abs());
            unknowns.clone().all(off)
        };
        if !lies_within(APART, &|u| scales[u], values) {
            return false;
        }
        if lies_within(ALIKE, &|u| values[u].abs(), values) {
            return true;
        }
        let own: Vec<f64> = unknowns.clone().map(|(u, _)| values[u]).collect();
        for (u, at) in unknowns.clone() {
            values[u] = 0.5 * (values[u] + at);
        }
        self.block.compute_defined(values, w);
        let is_between = self.holds_at(values, w, s);
        for ((u, _), own) in unknowns.zip(own) {
            values[u] = own;
        }
        is_between
    }

    /// By how much Newton's step is longer, or turned round, for what repels.
    fn stretch(
        &self,
        known: &[Vec<f64>],
        values: &[f64],
        scales: &[f64],
        s: &SquareScratch,
    ) -> f64 {
        let mut slope = 0.0;
        for solution in known {
            let (mut square, mut along) = (0.0, 0.0);
            for (c, d) in s.step.iter().enumerate() {
                let slot = self.slot(c);
                let off = (values[slot] - solution[self.block.core[c] as usize]) / scales[slot];
                square += off * off;
                along += off * (d / scales[slot]);
            }
            let distance = base::number::sqrt(square);
            slope -= along / (square * (1.0 + distance)).max(1e-300);
        }
        let stretch = 1.0 / (1.0 - slope);
        if stretch.is_nan() { 1.0 } else { stretch.clamp(-STRETCH, STRETCH) }
    }
}
