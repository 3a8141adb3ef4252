//! Square blocks: as many equations as unknowns, solved by damped Newton steps.
//!
//! In: the block, the state so far, the branch to stay on. Out: the
//! unknowns, in place, or the reason why not. Linear blocks take one step. Steps are accepted while
//! the norm of the scaled residuals falls (Armijo); where Newton's direction is no help, Levenberg
//! and Marquardt's is. Iteration goes on to stagnation, so that double roots come out as well as the
//! arithmetic allows. The linear algebra is dense where the core is small, sparse where it is not.

mod aside;
mod center;
mod closed;
mod further;
mod nearest;
mod step;
mod stride;

pub(crate) use stride::Side;

use crate::block::{Block, Layouts, Local, Workspace};
use crate::dense::{self, Factors};
use crate::lower::{Definers, Problem};
use crate::rows::{Point, generic_number};
use crate::sparse::damped::{Damped, DampedScratch};
use crate::sparse::pivot::{self, How};
use crate::sparse::{Lu, Pattern, Symbolic};
use crate::system::SlotIndex;
use std::ops::RangeInclusive;
use std::rc::Rc;
use std::sync::OnceLock;

/// A compiled square block.
#[derive(Debug)]
pub(crate) struct Square {
    pub(crate) block: Block,
    /// Pivots that suit the block at a generic point; made when they are first needed.
    pivots: OnceLock<Rc<Symbolic>>,
    /// What finds damped steps of a large core.
    damped: OnceLock<Damped>,
}

/// Buffers that a block needs while it is solved.
#[derive(Clone, Debug, Default)]
pub(crate) struct SquareScratch {
    /// True while a large core gives up where a step is wide or has to be cut.
    pub(crate) is_hasty: bool,
    local: Local,
    /// The block and the residuals where a step began.
    kept: Local,
    kept_residual: Vec<f64>,
    /// The scaled Jacobian of the core, dense, or of all rows, in the order of their pattern.
    matrix: Vec<f64>,
    factors: Vec<f64>,
    /// The same of another state, in the same order.
    pivots: Vec<f64>,
    swaps: Vec<usize>,
    lu: Lu,
    damped: DampedScratch,
    /// Pivots for numbers that the generic ones do not suit.
    own: Option<Symbolic>,
    /// Gradients of what is defined, by the core.
    gradients: Vec<f64>,
    /// A right side and the solution, by row and unknown.
    right: Vec<f64>,
    /// Residuals of the core rows.
    residual: Vec<f64>,
    /// By unknown of the core.
    step: Vec<f64>,
    start: Vec<f64>,
    /// By row.
    weight: Vec<f64>,
    /// How much was done: unknowns of the core, each time that a matrix was factorised.
    pub(crate) work: usize,
}

/// How much a solution may differ from where it started.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Trust {
    /// Only along the branch: full steps that shrink fast and turn no orientation.
    Branch,
    /// Whatever solves it, by steps that make the residuals smaller.
    Any,
    /// Whatever solves it, by full steps, even where the residuals grow for a while.
    Leap,
    /// Of one unknown the nearest root, on whichever side it lies; of several whatever solves it.
    Nearest,
}

/// Which solution is looked for.
#[derive(Debug)]
pub(crate) struct Course<'a> {
    /// The state that a branch is followed from.
    pub(crate) last: &'a [f64],
    pub(crate) trust: Trust,
    /// On which side that state lies.
    pub(crate) side: &'a mut Side,
}

/// What came of it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Solved {
    /// Solved; the Jacobian is regular there.
    Regular,
    /// Solved where the Jacobian is singular; the unknown that is least determined.
    Double(SlotIndex),
    /// Not solved, or not within the trust.
    Failed,
}

const STEPS: usize = 200;
/// How often a linear solution is refined: each time takes away most of what is wrong with it.
const REFINEMENTS: usize = 10;
/// How many steps may be taken whatever the residuals do.
const LEAPS: usize = 60;
/// A step this long, in parts of the extent, leads away from what is near.
const WIDE: f64 = 0.1;
/// A last step no longer than this, in parts of the extent, is rounding.
const ROUNDED: f64 = 1e-7;
/// What part of the last step one is that goes to a double root.
const HALVES: RangeInclusive<f64> = 0.45..=0.55;
/// What of the norm is left, at most, where the same step once more comes to it.
const FAR_BETTER: f64 = 0.01;
/// A step that has to be cut this short, in a large core, goes across a narrow valley.
const SHORT: f64 = 0.1;
/// Where the least pivot is below this part of the largest, two solutions coincide.
const DOUBLE: f64 = 1e-6;
/// The largest core whose linear algebra is dense.
const DENSE: usize = 12;

impl Square {
    /// Lays a block out.
    pub(crate) fn new(problem: &Problem) -> Self {
        Self::of(Block::new(problem, Definers::Any))
    }
    /// Lays a block out, as one was before that differs in its slots alone.
    pub(crate) fn alike(problem: &Problem, layouts: &mut Layouts) -> Self {
        Self::of(Block::alike(problem, Definers::Any, layouts))
    }
    fn of(block: Block) -> Self {
        Self { block, pivots: OnceLock::new(), damped: OnceLock::new() }
    }

    /// Takes over the pivots that were chosen for its pattern.
    pub(crate) fn take_pivots(&mut self, pattern: &Pattern, pivots: &Rc<Symbolic>) {
        if !self.is_dense() && *pattern == self.block.pattern {
            self.pivots = OnceLock::from(Rc::clone(pivots));
        }
    }

    /// Returns true if the rows hold for these values.
    pub(crate) fn holds_at(
        &self,
        values: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        self.block.sides(values, w, &mut s.local);
        self.holds(values, w, s)
    }

    /// Returns the sign of the determinant at these values: the orientation of the block.
    pub(crate) fn orientation(
        &self,
        values: &[f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> i8 {
        self.factors_at(values, scales, w, s).sign
    }

    /// Returns true if there is hardly an inverse at these values: two branches lie one on the other here.
    pub(crate) fn is_double(
        &self,
        values: &[f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> bool {
        self.factors_at(values, scales, w, s).ratio < DOUBLE
    }

    fn factors_at(
        &self,
        values: &[f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> Factors {
        self.block.slopes(values, w, &mut s.local);
        s.own = None;
        self.weigh(scales, s);
        self.factorise(s)
    }

    /// Returns true if it is curved and its core is so large that from a rough start its solution may lie far off.
    pub(crate) fn is_large(&self) -> bool {
        !self.block.is_linear && !self.is_dense()
    }

    /// Returns about how many multiplications an iteration takes.
    fn cost(&self) -> usize {
        let n = self.block.core.len();
        let factors = if self.is_dense() { n * n * n / 3 } else { 100 * self.block.pattern.len() };
        factors + 20 * self.block.unknowns.len()
    }
    fn is_dense(&self) -> bool {
        self.block.core.len() <= DENSE
    }
    /// Returns the slot of an unknown of the core.
    pub(crate) fn slot(&self, core: usize) -> usize {
        self.block.unknowns[self.block.core[core] as usize] as usize
    }

    /// Computes what is defined, then sides and Jacobian.
    fn evaluate(&self, values: &mut [f64], w: &mut Workspace, s: &mut SquareScratch) {
        w.spend(self.cost());
        self.block.compute_defined(values, w);
        self.block.slopes(values, w, &mut s.local);
        s.residual.clear();
        let rows = self.block.core_rows.iter().map(|&r| r as usize);
        s.residual.extend(rows.map(|r| s.local.left[r] - s.local.right[r]));
    }
    fn holds(&self, values: &[f64], w: &mut Workspace, s: &SquareScratch) -> bool {
        (0..self.block.height()).all(|r| self.block.row_holds(&s.local, r, values, w))
    }

    /// Puts the weighted Jacobian in scaled unknowns together.
    fn fill(&self, scales: &[f64], s: &mut SquareScratch) {
        let block = &self.block;
        let scale = |u: usize| scales[block.unknowns[u] as usize];
        s.matrix.clear();
        if !self.is_dense() {
            for r in 0..block.height() {
                let weight = s.weight[r];
                let entries = block.pattern.range(r);
                s.matrix.extend(
                    entries.map(|e| s.local.jacobian[e] * weight * scale(block.pattern.column(e))),
                );
            }
            return;
        }
        let n = block.core.len();
        s.matrix.resize(n * n, 0.0);
        if block.definitions.is_empty() {
            for r in 0..n {
                for e in block.pattern.range(r) {
                    let c = block.pattern.column(e);
                    s.matrix[r * n + c] = s.local.jacobian[e] * s.weight[r] * scale(c);
                }
            }
            return;
        }
        block.gradients(&s.local, &|i| scales[self.slot(i)], &mut s.gradients);
        for (i, &r) in block.core_rows.iter().enumerate() {
            let weight = s.weight[r as usize];
            for e in block.pattern.range(r as usize) {
                let gradient = &s.gradients[block.pattern.column(e) * n..][..n];
                dense::add(&mut s.matrix[i * n..][..n], s.local.jacobian[e] * weight, gradient);
            }
        }
    }

    /// Freezes a weight for every row that makes it dimensionless, and puts the matrix together.
    fn weigh(&self, scales: &[f64], s: &mut SquareScratch) {
        let weigh = |row: &mut [f64]| {
            let size = row.iter().fold(0.0f64, |m, v| m.max(v.abs()));
            let weight = if size > 0.0 && size.is_finite() { 1.0 / size } else { 1.0 };
            row.iter_mut().for_each(|v| *v *= weight);
            weight
        };
        s.weight.clear();
        s.weight.resize(self.block.height(), 1.0);
        self.fill(scales, s);
        if self.is_dense() {
            let n = self.block.core.len();
            for (i, &r) in self.block.core_rows.iter().enumerate() {
                s.weight[r as usize] = weigh(&mut s.matrix[i * n..][..n]);
            }
        } else {
            for r in 0..self.block.height() {
                s.weight[r] = weigh(&mut s.matrix[self.block.pattern.range(r)]);
            }
        }
    }

    /// Factorises the matrix.
    fn factorise(&self, s: &mut SquareScratch) -> Factors {
        s.work += self.block.core.len();
        if self.is_dense() {
            s.factors.clear();
            s.factors.extend_from_slice(&s.matrix);
            return dense::factorise(&mut s.factors, self.block.core.len(), &mut s.swaps);
        }
        let pattern = &self.block.pattern;
        let singular = Factors { sign: 0, ratio: 0.0 };
        if s.own.is_none() {
            let symbolic = self.pivots.get_or_init(|| Rc::new(self.generic_pivots()));
            if let Some(factors) = symbolic.factorise(pattern, &s.matrix, &mut s.lu) {
                return factors;
            }
        }
        let (symbolic, factors) = Symbolic::suited(pattern, &s.matrix, &mut s.lu);
        s.own = Some(symbolic);
        factors.unwrap_or(singular)
    }

    /// Chooses pivots by numbers that depend on the block alone.
    fn generic_pivots(&self) -> Symbolic {
        let (mut local, mut w) = (Local::default(), Workspace::default());
        let last = self.block.slots().max().map_or(0, |s| s as usize + 1);
        let values: Vec<f64> =
            (0..last as u64).map(|i| generic_number(i, Point::Positive)).collect();
        self.block.slopes(&values, &mut w, &mut local);
        for (i, value) in local.jacobian.iter_mut().enumerate() {
            if !value.is_finite() || *value == 0.0 {
                *value = generic_number(i as u64, Point::Mixed);
            }
        }
        Symbolic::new(pivot::choose(&self.block.pattern, &local.jacobian, How::Paired))
    }

    /// Solves from the values that the unknowns have now, one scale for every slot.
    ///
    /// Where no second derivative is left in the sum of a row, as where two squares take each other away, there is one
    /// solution alone, though a branch may come to it by way of the infinite; so it is with a centre and its radius.
    pub(crate) fn solve(
        &self,
        mut course: Course<'_>,
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> Solved {
        let Course { last, trust, .. } = course;
        if trust == Trust::Nearest
            && let Some(solved) = self.solve_nearest(values, scales, w, s)
        {
            return solved;
        }
        let solved = match self.solve_closed(&mut course, values, scales, w) {
            Some(solved) => {
                s.work += self.block.core.len();
                solved
            }
            None => self.solve_by_steps(course, values, scales, w, s),
        };
        let is_lost = trust == Trust::Branch && solved == Solved::Failed;
        if !is_lost || self.block.is_linear || !self.is_dense() {
            return solved;
        }
        for &u in &self.block.unknowns {
            values[u as usize] = last[u as usize];
        }
        if !self.block.seconds().is_empty() {
            return if self.solve_center(values, w, s) { Solved::Regular } else { solved };
        }
        let side = &mut Side::default();
        match self.solve_by_steps(Course { last, trust: Trust::Any, side }, values, scales, w, s) {
            Solved::Regular => Solved::Regular,
            Solved::Double(_) | Solved::Failed => Solved::Failed,
        }
    }

    fn solve_by_steps(
        &self,
        course: Course<'_>,
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> Solved {
        let Course { last, trust, side } = course;
        let is_linear = self.block.is_linear;
        let branch = match trust {
            Trust::Branch if is_linear => None,
            Trust::Branch if side.newton != 0 => Some(side.newton),
            Trust::Branch => Some(self.orientation(last, scales, w, s)),
            Trust::Any | Trust::Leap | Trust::Nearest => None,
        };
        s.own = None;
        if is_linear && !self.is_dense() {
            match self.solve_linear(values, scales, w, s) {
                Solved::Failed => {}
                solved @ (Solved::Regular | Solved::Double(_)) => return solved,
            }
        }
        let Some((factors, size)) = self.iterate(branch, trust, values, scales, w, s) else {
            return Solved::Failed;
        };
        if !self.holds(values, w, s)
            || self.goes_on(last, values, size, scales, w, s)
            || (size > WIDE || factors.ratio == 0.0)
                && !is_linear
                && self.runs_away(values, scales, w, s)
        {
            return Solved::Failed;
        }
        let solved =
            if factors.ratio < DOUBLE { self.least_determined(s) } else { Solved::Regular };
        if let Some(branch) = branch {
            side.newton = branch;
            if !self.stays(last, values, side, scales, w, s) {
                return Solved::Failed;
            }
        }
        solved
    }

    /// Takes steps until they do no better, on the `branch` of this orientation if there is one; returns the last
    /// factors and how long the last step was, or nothing where they lead nowhere.
    fn iterate(
        &self,
        branch: Option<i8>,
        trust: Trust,
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> Option<(Factors, f64)> {
        let is_linear = self.block.is_linear;
        self.evaluate(values, w, s);
        self.weigh(scales, s);
        let mut norm = self.weighted_norm(s);
        if !norm.is_finite() {
            return None;
        }
        // where no step is needed none was taken
        s.step.clear();
        s.step.resize(self.block.core.len(), 0.0);
        let (mut first_size, mut last_size, mut damping) = (0.0, 0.0, 0.0f64);
        let mut nudges = aside::NUDGES.iter();
        let mut factors = Factors { sign: 0, ratio: 1.0 };
        for iteration in 0..STEPS {
            if norm == 0.0 && iteration > 0 {
                break;
            }
            if iteration > 0 && !is_linear {
                self.fill(scales, s);
            }
            if iteration == 0 || !is_linear {
                factors = self.factorise(s);
            }
            if branch.is_some_and(|sign| sign != factors.sign || sign == 0) && norm > 0.0 {
                return None;
            }
            if iteration == 1 && branch.is_some() && first_size > 1e-7 && self.bends(scales, s) {
                return None;
            }
            if norm == 0.0 {
                break;
            }
            let newton = factors.ratio > 1e-14 && damping == 0.0;
            if newton {
                self.newton(scales, s);
            } else {
                self.damped_direction(scales, damping.max(1e-12), s);
            }
            let size = self.step_size(scales, s);
            let ratio = size / std::mem::replace(&mut last_size, size);
            match iteration {
                0 => first_size = size,
                1 if branch.is_some() && size > 0.5 * first_size && size > 1e-7 => {
                    return None;
                }
                _ => {}
            }
            let was_held = self.holds(values, w, s);
            let halves = newton && was_held && HALVES.contains(&ratio);
            let mut found = if trust == Trust::Leap && !was_held && iteration < LEAPS {
                Some((1.0, self.leap(values, size, w, s)))
            } else {
                self.search(values, norm, was_held, w, s)
            };
            if let (Some((_, norm)), true) = (&mut found, halves) {
                *norm = self.step_again(values, *norm, &mut factors, w, s);
            }
            let is_cut = found.is_none_or(|(length, _)| length < 1.0);
            if (is_cut || size > WIDE) && !was_held && s.is_hasty && self.is_large() {
                return None;
            }
            match found {
                Some((length, better)) => {
                    let leaves = branch.is_some() && length < 1.0 && !was_held;
                    if leaves || !better.is_finite() || w.is_spent() {
                        return None;
                    }
                    let slow = better > 0.5 * norm;
                    norm = better;
                    let is_short = length < SHORT && !was_held && self.is_large();
                    damping = step::next_damping(damping, newton, is_short);
                    if was_held && slow {
                        if damping == 0.0 {
                            break;
                        }
                        damping = 0.0;
                    }
                }
                None if was_held && damping == 0.0 => break,
                None if was_held => damping = 0.0,
                None if branch.is_some() => return None,
                None => {
                    damping = (damping * 10.0).max(1e-6);
                    if damping > 1e8 {
                        if !nudges.by_ref().any(|&by| self.leaves_crest(by, values, scales, w, s)) {
                            return None;
                        }
                        norm = self.weighted_norm(s);
                        damping = 0.0;
                    }
                }
            }
        }
        Some((factors, last_size))
    }

    /// Solves a linear block that has factors: all unknowns at once, those that rows define too, and
    /// refined until every row holds as well as its own numbers are stored. What is computed forward
    /// from differences of large numbers would be off by their rounding.
    ///
    /// **Source:** Skeel, *Iterative refinement implies numerical stability for Gaussian elimination*,
    /// Math. Comp. 35 (1980).
    fn solve_linear(
        &self,
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> Solved {
        let block = &self.block;
        block.slopes(values, w, &mut s.local);
        self.weigh(scales, s);
        if self.factorise(s).ratio == 0.0 {
            return Solved::Failed;
        }
        let mut error = f64::INFINITY;
        for _ in 0..REFINEMENTS {
            s.right.clear();
            let residual = s.local.left.iter().zip(&s.local.right);
            s.right.extend(residual.zip(&s.weight).map(|((left, right), w)| (right - left) * w));
            let symbolic = s.own.as_ref().or(self.pivots.get().map(Rc::as_ref));
            let symbolic = symbolic.expect("there are factors");
            symbolic.solve(&mut s.lu, &mut s.right);
            s.start.clear();
            s.start.extend(block.unknowns.iter().map(|&u| values[u as usize]));
            for (&u, d) in block.unknowns.iter().zip(&s.right) {
                values[u as usize] += d * scales[u as usize];
            }
            block.sides(values, w, &mut s.local);
            let now = block.backward_error(0..block.height(), values, &s.local);
            if now >= error {
                for (&u, x) in block.unknowns.iter().zip(&s.start) {
                    values[u as usize] = *x;
                }
                block.sides(values, w, &mut s.local);
                break;
            }
            let settled = now <= f64::EPSILON || now > 0.5 * error;
            error = now;
            if settled {
                break;
            }
        }
        if self.holds(values, w, s) { Solved::Regular } else { Solved::Failed }
    }

    /// Takes the whole step, but not more than half the extent; returns the norm there.
    fn leap(&self, values: &mut [f64], size: f64, w: &mut Workspace, s: &mut SquareScratch) -> f64 {
        let length = if size > 0.5 { 0.5 / size } else { 1.0 };
        for (c, d) in s.step.iter().enumerate() {
            values[self.slot(c)] += length * d;
        }
        self.evaluate(values, w, s);
        self.weighted_norm(s)
    }

    /// Takes the step once more, where that does far better: steps to a double root halve, and what is left of the way
    /// is as long as the last. Where solutions lie one on the other throughout, it does not; where several meet at
    /// once, what is left of the way says on which branch they were come to. Returns the norm.
    fn step_again(
        &self,
        values: &mut [f64],
        norm: f64,
        factors: &mut Factors,
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> f64 {
        if !self.is_nearly_open_once(s) {
            return norm;
        }
        s.start.clear();
        s.start.extend((0..s.step.len()).map(|c| values[self.slot(c)]));
        for (c, (start, d)) in s.start.iter().zip(&s.step).enumerate() {
            values[self.slot(c)] = start + d;
        }
        self.evaluate(values, w, s);
        let now = self.weighted_norm(s);
        if now <= FAR_BETTER * norm {
            // that of where it came from says less
            factors.ratio = factors.ratio.min(0.5 * DOUBLE);
            return now;
        }
        s.start.iter().enumerate().for_each(|(c, start)| values[self.slot(c)] = *start);
        self.evaluate(values, w, s);
        norm
    }

    /// Walks along the step, halving it until the residuals are smaller; returns length and norm, or
    /// nothing where that does not come about: then all is as it was.
    fn search(
        &self,
        values: &mut [f64],
        norm: f64,
        was_held: bool,
        w: &mut Workspace,
        s: &mut SquareScratch,
    ) -> Option<(f64, f64)> {
        s.start.clear();
        s.start.extend((0..s.step.len()).map(|c| values[self.slot(c)]));
        std::mem::swap(&mut s.local, &mut s.kept);
        std::mem::swap(&mut s.residual, &mut s.kept_residual);
        let mut length = 1.0;
        let shortest = if was_held { 1.0 } else { 1e-7 };
        // what is too short to change a bit finds nothing better
        let moves = |s: &SquareScratch, length: f64| {
            s.start.iter().zip(&s.step).any(|(start, d)| start + length * d != *start)
        };
        while length >= shortest && moves(s, length) {
            for (c, (start, d)) in s.start.iter().zip(&s.step).enumerate() {
                values[self.slot(c)] = start + length * d;
            }
            self.evaluate(values, w, s);
            let now = self.weighted_norm(s);
            if now.is_finite() && now < (1.0 - 1e-4 * length) * norm {
                return Some((length, now));
            }
            length *= 0.5;
        }
        for (c, start) in s.start.iter().enumerate() {
            values[self.slot(c)] = *start;
        }
        self.block.compute_defined(values, w);
        std::mem::swap(&mut s.local, &mut s.kept);
        std::mem::swap(&mut s.residual, &mut s.kept_residual);
        None
    }
}
