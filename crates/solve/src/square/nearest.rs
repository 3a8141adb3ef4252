//! The nearest root of a block with one unknown left, on whichever side of the start it lies.
//!
//! In: the block, where to start. Out: the root, in place, or none. Newton's steps come to some root, which may lie
//! far off, or go round a hill; of one number, all others can be looked at: outwards from the start, in both
//! directions by turns, until the residual changes its sign. A pole, where it does so too, is passed over.

use super::{Course, Side, Solved, Square, SquareScratch, Trust};
use crate::block::Workspace;

/// How far the first look goes, in parts of the number itself, how many times farther each next one, and how many
/// there are in each direction.
const FIRST: f64 = 0.01;
const FARTHER: f64 = 1.2;
const LOOKS: usize = 100;
/// How often what holds a root is halved before Newton's steps.
const HALVES: usize = 30;

impl Square {
    /// Puts the root nearest to where the unknown stands into `values`, if one is found: then the rows hold.
    pub(super) fn solve_nearest(
        &self,
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> Option<Solved> {
        if self.block.core.len() != 1 || self.block.is_linear {
            return None;
        }
        let slot = self.slot(0);
        let start = values[slot];
        let size = if start == 0.0 { scales[slot] } else { start.abs() };
        let first = self.residual_at(start, values, w, s);
        if self.holds(values, w, s) {
            return Some(Solved::Regular);
        }
        let mut sides = [(start, first); 2];
        let mut off = FIRST * size;
        for _ in 0..LOOKS {
            for (side, way) in sides.iter_mut().zip([1.0, -1.0]) {
                let to = start + way * off;
                let now = self.residual_at(to, values, w, s);
                let (from, before) = std::mem::replace(side, (to, now));
                if before * now <= 0.0
                    && let Some(solved) =
                        self.root_between([from, to], before, values, scales, w, s)
                {
                    return Some(solved);
                }
            }
            off *= FARTHER;
        }
        self.residual_at(start, values, w, s);
        None
    }

    fn residual_at(
        &self,
        x: f64,
        values: &mut [f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> f64 {
        values[self.slot(0)] = x;
        self.evaluate(values, w, s);
        s.residual[0]
    }

    /// Finds the root between two numbers for which the residual has other signs, `before` at the first; nothing where
    /// it runs off there.
    fn root_between(
        &self,
        [mut from, mut to]: [f64; 2],
        before: f64,
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> Option<Solved> {
        let ends = if from < to { from..=to } else { to..=from };
        for _ in 0..HALVES {
            let middle = 0.5 * (from + to);
            let now = self.residual_at(middle, values, w, s);
            if before * now > 0.0 { from = middle } else { to = middle }
        }
        values[self.slot(0)] = 0.5 * (from + to);
        let side = &mut Side::default();
        let course = Course { last: &[], trust: Trust::Any, side };
        let solved = self.solve_by_steps(course, values, scales, w, s);
        (solved != Solved::Failed && ends.contains(&values[self.slot(0)])).then_some(solved)
    }
}
