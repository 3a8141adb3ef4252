//! Least change: fewer rows than unknowns, all to hold, and the distance from x0 to be least; first that
//! of given numbers, then that of everything else.
//!
//! In: the block, the state x0 that distance is measured from, a start. Out: the unknowns, in place.
//! Newton's method on the Lagrangian with exact second derivatives, `[H Jᵀ; J -δ]`, sparse and
//! symmetric. Where the Hessian, reduced to what the rows leave free, is not positive (the factors have
//! other than one negative pivot a row), its diagonal grows until it is. The small `-δ` is that of the
//! proximal method of multipliers: it keeps the factors tame and disappears with the change of the
//! multipliers. While given numbers are counted the others are held a little to where they are, which
//! leaves no trace once they have settled; while the others are counted given numbers are constants.
//!
//! **Source:** Nocedal and Wright, *Numerical Optimization*, 2nd ed., §18.1 and §16.3; Friedlander and
//! Orban, *A primal-dual regularized interior-point method*, Math. Prog. Comp. 4 (2012).

use crate::block::{Block, Local, Workspace};
use crate::lower::{Definers, Problem};
use crate::measure::Measured;
use crate::sparse::{Ldl, Symmetric};
use crate::square::Trust;
use crate::system::{Level, SlotIndex};
use std::sync::OnceLock;

/// A block of fewer rows than unknowns.
#[derive(Debug)]
pub(crate) struct Least {
    pub(crate) block: Block,
    /// For every unknown: it is a given number that yields. Empty where all are or none is.
    given: Vec<bool>,
    /// Of unknowns, then rows; made when it is first needed.
    structure: OnceLock<Symmetric>,
}

/// Buffers that a block needs while it is solved.
#[derive(Clone, Debug, Default)]
pub(crate) struct LeastScratch {
    local: Local,
    scale: Vec<f64>,
    weight: Vec<f64>,
    /// What the matrix is made of: diagonals, the Jacobian, second derivatives.
    entries: Vec<f64>,
    ldl: Ldl,
    /// The right side, then the step and the new multipliers.
    right: Vec<f64>,
    multipliers: Vec<f64>,
    start: Vec<f64>,
}

/// Whose change is counted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Counted {
    /// Every unknown's.
    All,
    /// That of given numbers; the others go along.
    Given,
    /// That of the others; given numbers are constants.
    Others,
}

/// What an unknown is while some are counted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Part {
    Counted,
    GoesAlong,
    Constant,
}

/// What is known of the rows' curvature.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Curvature {
    /// Nothing yet: there are no multipliers.
    None,
    /// Second derivatives, with the present multipliers.
    Exact,
}

const STEPS: usize = 100;
/// The regularisation of the rows.
const DELTA: f64 = 1e-6;
/// How many steps are taken beyond the last where a row does not hold yet.
const POLISH: usize = 8;
/// How much what goes along is held to where it is.
const ALONG: f64 = 1e-6;
/// Steps below this, in parts of the extent, are no steps.
const SETTLED: f64 = 1e-13;
/// A branch of least change is left where the curvature of what is least, one at first, has come down to
/// this in some direction. At nothing the branch ends, and near there what is free runs ahead of the wish
/// without bound.
const FIRM: f64 = 0.125;

impl Least {
    /// Lays a block out; `is_given` tells which slots are given numbers.
    pub(crate) fn new(problem: &Problem, is_given: &dyn Fn(SlotIndex) -> bool) -> Self {
        let block = Block::new(problem, Definers::None);
        let mut given: Vec<bool> = block.unknowns.iter().map(|&s| is_given(s)).collect();
        if given.iter().all(|&g| g == given[0]) {
            given.clear();
        }
        Self { block, given, structure: OnceLock::new() }
    }

    /// Returns true if a row may give way.
    pub(crate) fn has_soft_rows(&self) -> bool {
        self.block.levels.iter().any(|&level| level != Level::Required)
    }
    /// Returns true if every row holds for these values.
    pub(crate) fn holds_at(&self, values: &[f64], w: &mut Workspace, s: &mut LeastScratch) -> bool {
        self.block.sides(values, w, &mut s.local);
        self.holds(values, w, s)
    }
    fn holds(&self, values: &[f64], w: &mut Workspace, s: &LeastScratch) -> bool {
        (0..self.block.height()).all(|r| self.block.row_holds(&s.local, r, values, w))
    }

    fn structure(&self) -> &Symmetric {
        self.structure.get_or_init(|| {
            let (n, m) = (self.block.unknowns.len() as u32, self.block.height() as u32);
            let mut entries: Vec<(u32, u32)> = (0..n + m).map(|i| (i, i)).collect();
            for r in 0..m {
                entries.extend(self.block.pattern.row(r as usize).iter().map(|&c| (c, n + r)));
            }
            entries.extend(self.block.second_places());
            Symmetric::new((n + m) as usize, &entries)
        })
    }

    /// Solves from the values that the unknowns have now; distance is measured from `x0`.
    pub(crate) fn solve(
        &self,
        x0: &[f64],
        values: &mut [f64],
        scales: &[f64],
        trust: Trust,
        w: &mut Workspace,
        s: &mut LeastScratch,
    ) -> Measured {
        s.scale.clear();
        s.scale.extend(self.block.unknowns.iter().map(|&u| scales[u as usize]));
        if self.given.is_empty() {
            return self.least(Counted::All, x0, values, trust, w, s);
        }
        match self.least(Counted::Given, x0, values, trust, w, s) {
            Measured::Least => self.least(Counted::Others, x0, values, trust, w, s),
            Measured::Failed => Measured::Failed,
        }
    }
    fn part(&self, counted: Counted, unknown: usize) -> Part {
        match (counted, self.given.get(unknown)) {
            (Counted::All, _) | (_, None) => Part::Counted,
            (Counted::Given, Some(true)) | (Counted::Others, Some(false)) => Part::Counted,
            (Counted::Given, Some(false)) => Part::GoesAlong,
            (Counted::Others, Some(true)) => Part::Constant,
        }
    }

    /// Makes the change of those that are counted least.
    fn least(
        &self,
        counted: Counted,
        x0: &[f64],
        values: &mut [f64],
        trust: Trust,
        w: &mut Workspace,
        s: &mut LeastScratch,
    ) -> Measured {
        let block = &self.block;
        s.multipliers.clear();
        s.multipliers.resize(block.height(), 0.0);
        block.slopes(values, w, &mut s.local);
        self.weigh(s);
        let mut norm = self.norm(s);
        let follows = trust == Trust::Branch && !block.is_linear;
        // on a branch the multipliers are those of the last state, and the first step is Newton's too
        if follows && self.step(counted, x0, values, Curvature::None, w, s).is_none() {
            return Measured::Failed;
        }
        let mut size = f64::INFINITY;
        let mut smallest = (f64::INFINITY, 0);
        let mut polished = 0;
        for iteration in 0..STEPS {
            let curvature =
                if follows || iteration > 0 { Curvature::Exact } else { Curvature::None };
            let Some(shift) =
                self.step(counted, x0, values, curvature, w, s).filter(|_| norm.is_finite())
            else {
                return Measured::Failed;
            };
            let before = size;
            size = s.right[..block.unknowns.len()].iter().fold(0.0, |m: f64, d| m.max(d.abs()));
            if !size.is_finite() {
                return Measured::Failed;
            }
            if follows {
                // a branch of least change ends where it has no minimum any more
                let leaves = match iteration {
                    0 => size > 0.5 || shift > 1.0,
                    1 => size > 0.1 * before && size > 1e-7,
                    _ => size > 0.5 * before && size > 1e-7,
                };
                if leaves {
                    return Measured::Failed;
                }
            }
            if size < 0.9 * smallest.0 {
                smallest = (size, 0);
            } else {
                smallest.1 += 1;
            }
            // what comes after a step that shrank like this is no step
            let next = if iteration > 0 { size * (size / before) } else { size };
            let last = size <= SETTLED
                || iteration > 1 && next <= SETTLED
                || smallest.1 >= 4 && smallest.0 < 1e-7;
            norm = self.advance(values, size, norm, w, s);
            if last {
                // of what is small beside its scale, a few more steps find the last digits
                polished += 1;
                if polished > POLISH || self.holds(values, w, s) {
                    break;
                }
            }
            if smallest.1 > 30 {
                return Measured::Failed;
            }
        }
        let is_found = self.holds(values, w, s) && size < 1e-6;
        let may_bend = follows && counted == Counted::All;
        if is_found && (!may_bend || self.is_firm(s)) { Measured::Least } else { Measured::Failed }
    }

    /// Returns true if what is least is curved by [`FIRM`] in every direction that the rows leave free, by the
    /// matrix of the last step.
    fn is_firm(&self, s: &mut LeastScratch) -> bool {
        let (n, m) = (self.block.unknowns.len(), self.block.height());
        let seconds = s.entries.len() - self.block.second_places().count();
        // rows of small sums cannot bring it down so far
        s.start.clear();
        s.start.resize(n, 0.0);
        for ((i, j), h) in self.block.second_places().zip(&s.entries[seconds..]) {
            s.start[i as usize] += h.abs();
            if i != j {
                s.start[j as usize] += h.abs();
            }
        }
        if s.start.iter().all(|&sum| sum < 1.0 - FIRM) {
            return true;
        }
        s.entries[..n].fill(1.0 - FIRM);
        self.structure().factorise(&s.entries, &mut s.ldl) == Some(m)
    }

    /// Freezes a weight for every row that makes it dimensionless.
    fn weigh(&self, s: &mut LeastScratch) {
        s.weight.clear();
        for r in 0..self.block.height() {
            let mut sum = 0.0;
            for e in self.block.pattern.range(r) {
                let d = s.local.jacobian[e] * s.scale[self.block.pattern.column(e)];
                sum += d * d;
            }
            let size = base::number::sqrt(sum);
            s.weight.push(if size > 0.0 && size.is_finite() { 1.0 / size } else { 1.0 });
        }
    }
    fn norm(&self, s: &LeastScratch) -> f64 {
        let mut sum = 0.0;
        for ((left, right), w) in s.local.left.iter().zip(&s.local.right).zip(&s.weight) {
            sum += (left - right) * w * ((left - right) * w);
        }
        base::number::sqrt(sum)
    }

    /// Finds step and multipliers; returns the diagonal that it took, or nothing where the matrix cannot
    /// be factorised.
    fn step(
        &self,
        counted: Counted,
        x0: &[f64],
        values: &[f64],
        curvature: Curvature,
        w: &mut Workspace,
        s: &mut LeastScratch,
    ) -> Option<f64> {
        let block = &self.block;
        let (n, m) = (block.unknowns.len(), block.height());
        let structure = self.structure();
        let part = |i: usize| self.part(counted, i);
        let moves = |i: usize| part(i) != Part::Constant;
        s.entries.clear();
        s.entries.extend((0..n).map(|i| held(part(i))));
        s.entries.resize(n + m, -DELTA);
        for r in 0..m {
            for e in block.pattern.range(r) {
                let column = block.pattern.column(e);
                let scale = if moves(column) { s.scale[column] } else { 0.0 };
                s.entries.push(s.local.jacobian[e] * s.weight[r] * scale);
            }
        }
        let first_curved = s.entries.len();
        match curvature {
            Curvature::None => s.entries.extend(block.second_places().map(|_| 0.0)),
            Curvature::Exact => block.each_second(values, w, &mut |row, i, j, second| {
                let factor = s.multipliers[row] * s.weight[row];
                let value = factor * second * s.scale[i] * s.scale[j];
                let counts = factor != 0.0 && value.is_finite() && moves(i) && moves(j);
                s.entries.push(if counts { value } else { 0.0 });
            }),
        }
        let mut shift = 1.0;
        loop {
            match structure.factorise(&s.entries, &mut s.ldl) {
                Some(negative) if negative == m => break,
                Some(_) | None if shift > 1e8 => return None,
                Some(_) | None => {
                    if s.entries[first_curved..].iter().all(|&h| h == 0.0) {
                        return None;
                    }
                    s.entries[..n].iter_mut().for_each(|d| *d += 3.0 * shift);
                    shift *= 4.0;
                }
            }
        }
        s.right.clear();
        s.right.extend(block.unknowns.iter().zip(&s.scale).enumerate().map(|(i, (&u, scale))| {
            match part(i) {
                Part::Counted => (x0[u as usize] - values[u as usize]) / scale,
                Part::GoesAlong | Part::Constant => 0.0,
            }
        }));
        // what the multipliers have now is taken off, so that rounding shrinks with the steps
        let mut entry = n + m;
        for r in 0..m {
            for e in block.pattern.range(r) {
                s.right[block.pattern.column(e)] -= s.entries[entry] * s.multipliers[r];
                entry += 1;
            }
        }
        let residual = |r: usize| (s.local.left[r] - s.local.right[r]) * s.weight[r];
        s.right.extend((0..m).map(|r| -residual(r)));
        structure.solve(&mut s.ldl, &mut s.right);
        for (multiplier, change) in s.multipliers.iter_mut().zip(&s.right[n..]) {
            *multiplier += change;
        }
        Some(shift)
    }

    /// Goes along the step, shortened until the rows are not torn apart; returns the norm there.
    fn advance(
        &self,
        values: &mut [f64],
        size: f64,
        norm: f64,
        w: &mut Workspace,
        s: &mut LeastScratch,
    ) -> f64 {
        let block = &self.block;
        // longer steps than half the extent are not believed
        let mut length = if size > 0.5 && !block.is_linear { 0.5 / size } else { 1.0 };
        s.start.clear();
        s.start.extend(block.unknowns.iter().map(|&u| values[u as usize]));
        loop {
            for (i, &u) in block.unknowns.iter().enumerate() {
                values[u as usize] = s.start[i] + length * s.right[i] * s.scale[i];
            }
            block.slopes(values, w, &mut s.local);
            let now = self.norm(s);
            if now <= 0.1f64.max(2.0 * norm) || length < 1e-6 {
                return now;
            }
            length *= 0.5;
        }
    }
}

/// How strongly an unknown is held.
fn held(part: Part) -> f64 {
    match part {
        Part::Counted | Part::Constant => 1.0,
        Part::GoesAlong => ALONG,
    }
}
