//! All rows at once: from a rough start to a state near by in which every row errs as little as it can.
//!
//! In: rows and unknowns of any number, a start. Out: the unknowns, in place, where the sum of squares of
//! all errors is least near by. Solved one after the other, each of many blocks hands what it errs on to the
//! next; here all share it. The steps are Levenberg and Marquardt's, by sparse factors.
//!
//! **Source:** Nielsen, *Damping parameter in Marquardt's method*, IMM-REP-1999-05, DTU 1999.

use crate::block::{Block, Local, Workspace};
use crate::lower::{Definers, Problem};
use crate::sparse::damped::{Damped, DampedScratch};
use crate::system::SlotIndex;

/// Rows over unknowns, none of which is defined by a row.
#[derive(Debug)]
pub(crate) struct Joint {
    block: Block,
    damped: Damped,
}

/// Equations of a plan that are moved all at once.
#[derive(Debug)]
pub(crate) struct Gathered {
    /// The equations, by their places in the system, in order.
    pub(crate) equations: Vec<u32>,
    /// The unknowns, in order.
    pub(crate) unknowns: Vec<SlotIndex>,
    pub(crate) joint: Joint,
}

impl Gathered {
    /// Returns true if it is of these equations and unknowns.
    pub(crate) fn is_of(&self, equations: &[u32], unknowns: &[SlotIndex]) -> bool {
        self.equations == equations && self.unknowns == unknowns
    }
}

/// The rows at one state, each divided by what it weighs.
struct Standing {
    local: Local,
    error: Vec<f64>,
    /// The sum of the squares of the errors.
    sum: f64,
}

const STEPS: usize = 100;
/// The first damping: steps are bold where all is smooth.
const FIRST: f64 = 1e-4;
const LEAST: f64 = 1e-12;
const MOST: f64 = 1e8;
/// Steps below this, in parts of the extent, are no steps.
const SETTLED: f64 = 1e-10;

impl Joint {
    /// Lays the rows out.
    pub(crate) fn new(problem: &Problem) -> Self {
        let block = Block::new(problem, Definers::None);
        let damped = Damped::new(&block.pattern);
        Self { block, damped }
    }

    /// Moves the unknowns until every row holds, no step makes the errors smaller, or they are `enough` so, in
    /// parts of the extent; returns true if every row holds. Where rows are not finite nothing is moved.
    pub(crate) fn settle(
        &self,
        values: &mut [f64],
        scales: &[f64],
        enough: f64,
        w: &mut Workspace,
    ) -> bool {
        let unknowns = &self.block.unknowns;
        let weight = self.weights(values, scales, w);
        let mut now = self.stand(values, &weight, w);
        let mut scratch = DampedScratch::default();
        let mut matrix = Vec::new();
        let (mut damping, mut factor) = (FIRST, 2.0);
        for _ in 0..STEPS {
            w.spend(50 * self.block.pattern.len());
            if !now.sum.is_finite() || w.is_spent() {
                return false;
            }
            if self.holds(&now.local, values, w) {
                return true;
            }
            if now.sum <= enough * enough * now.error.len() as f64 {
                return false;
            }
            self.fill(&now.local, &weight, scales, &mut matrix);
            let right = now.error.iter().map(|e| -e);
            let Some(step) = self.damped.step(&matrix, right, damping, &mut scratch) else {
                return false;
            };
            let size = step.iter().fold(0.0f64, |m, d| m.max(d.abs()));
            if size <= SETTLED || damping > MOST {
                return false;
            }
            let kept: Vec<f64> = unknowns.iter().map(|&u| values[u as usize]).collect();
            for (&u, d) in unknowns.iter().zip(step) {
                values[u as usize] += d * scales[u as usize];
            }
            let foreseen = now.sum - self.foreseen(&matrix, &now.error, step);
            let then = self.stand(values, &weight, w);
            let gain = (now.sum - then.sum) / foreseen;
            if then.sum < now.sum {
                now = then;
                let eased = 1.0 - (2.0 * gain - 1.0) * (2.0 * gain - 1.0) * (2.0 * gain - 1.0);
                damping = (damping * eased.max(0.1)).max(LEAST);
                factor = 2.0;
            } else {
                for (&u, x) in unknowns.iter().zip(kept) {
                    values[u as usize] = x;
                }
                damping *= factor;
                factor *= 2.0;
            }
        }
        false
    }

    /// Freezes a weight for every row that makes it dimensionless.
    fn weights(&self, values: &[f64], scales: &[f64], w: &mut Workspace) -> Vec<f64> {
        let mut local = Local::default();
        self.block.slopes(values, w, &mut local);
        let mut matrix = Vec::new();
        self.fill(&local, &vec![1.0; self.block.height()], scales, &mut matrix);
        let weight = |r: usize| {
            let own = &matrix[self.block.pattern.range(r)];
            let size = own.iter().fold(0.0f64, |m, d| m.max(d.abs()));
            if size > 0.0 && size.is_finite() { 1.0 / size } else { 1.0 }
        };
        (0..self.block.height()).map(weight).collect()
    }

    fn stand(&self, values: &[f64], weight: &[f64], w: &mut Workspace) -> Standing {
        let mut local = Local::default();
        self.block.slopes(values, w, &mut local);
        let sides = local.left.iter().zip(&local.right).zip(weight);
        let error: Vec<f64> = sides.map(|((left, right), w)| (left - right) * w).collect();
        let sum = error.iter().map(|e| e * e).sum();
        Standing { local, error, sum }
    }

    fn fill(&self, local: &Local, weight: &[f64], scales: &[f64], matrix: &mut Vec<f64>) {
        let Block { unknowns, .. } = &self.block;
        matrix.clear();
        for (r, weight) in weight.iter().enumerate() {
            let scale = |e: usize| scales[unknowns[self.block.pattern.column(e)] as usize];
            let slope = |e: usize| {
                let slope = local.jacobian[e] * weight * scale(e);
                // a distance has no slope where it is nothing
                if slope.is_finite() { slope } else { 0.0 }
            };
            matrix.extend(self.block.pattern.range(r).map(slope));
        }
    }

    /// What the sum of squares would be after a step, were all rows straight.
    fn foreseen(&self, matrix: &[f64], error: &[f64], step: &[f64]) -> f64 {
        let pattern = &self.block.pattern;
        let after = error.iter().enumerate().map(|(r, e)| {
            let moved = pattern.range(r).map(|at| matrix[at] * step[pattern.column(at)]);
            e + moved.sum::<f64>()
        });
        after.map(|e| e * e).sum()
    }

    fn holds(&self, local: &Local, values: &[f64], w: &mut Workspace) -> bool {
        (0..self.block.height()).all(|r| self.block.row_holds(local, r, values, w))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Kernel;
    use crate::lower::ProblemRow;
    use crate::system::Level;
    use base::number::Tolerance;
    use expr::{Arena, ExprId, Var};
    use std::rc::Rc;

    fn joint(unknowns: &[u32], make: impl FnOnce(&mut Arena) -> Vec<(ExprId, ExprId)>) -> Joint {
        let mut arena = Arena::new();
        let sides = make(&mut arena);
        let row = |(left, right)| {
            let (kernel, arguments) = Kernel::of_slots(&arena, left, right);
            let (kernel, arguments) = (Rc::new(kernel), arguments.into());
            let within = Tolerance::Relative;
            ProblemRow { kernel, arguments, level: Level::Required, within }
        };
        let rows = sides.into_iter().map(row).collect();
        Joint::new(&Problem { rows, unknowns: unknowns.to_vec() })
    }

    /// A root of x, which is 2.
    fn root(arena: &mut Arena) -> Vec<(ExprId, ExprId)> {
        let x = arena.var(Var(0));
        vec![(arena.sqrt(x), arena.constant(2.0))]
    }

    #[test]
    fn rows_that_are_not_finite_move_nothing() {
        let mut values = [-1.0];
        assert!(!joint(&[0], root).settle(&mut values, &[1.0], 0.0, &mut Workspace::default()));
        assert_eq!(values, [-1.0]);
    }

    #[test]
    fn rows_that_contradict_share_what_they_err() {
        let contradiction = |arena: &mut Arena| {
            let x = arena.var(Var(0));
            [1.0, 2.0, 6.0].map(|at| (x, arena.constant(at))).to_vec()
        };
        let mut values = [0.0];
        let joint = joint(&[0], contradiction);
        assert!(!joint.settle(&mut values, &[1.0], 0.0, &mut Workspace::default()));
        assert!((values[0] - 3.0).abs() < 1e-9, "{values:?}");
    }

    #[test]
    fn what_is_left_free_moves_as_little_as_the_rows_ask() {
        // x² + y² = 25 from (6, 8): along the ray
        let circle = |arena: &mut Arena| {
            let [x, y] = [0, 1].map(|i| arena.var(Var(i)));
            let (x, y) = (arena.square(x), arena.square(y));
            vec![(arena.add(x, y), arena.constant(25.0))]
        };
        let mut values = [6.0, 8.0];
        assert!(joint(&[0, 1], circle).settle(
            &mut values,
            &[10.0; 2],
            0.0,
            &mut Workspace::default()
        ));
        assert!((values[0] - 3.0).abs() + (values[1] - 4.0).abs() < 1e-6, "{values:?}");
    }

    #[test]
    fn a_root_is_found_from_afar() {
        let mut values = [100.0];
        assert!(joint(&[0], root).settle(&mut values, &[100.0], 0.0, &mut Workspace::default()));
        assert!((values[0] - 4.0).abs() < 1e-7, "{values:?}");
    }
}
