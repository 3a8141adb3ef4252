//! Least change: fewer rows than unknowns, all to hold, and the distance from x0 to be least; first that
//! of given numbers, then that of everything else that has a value, then that of what has none.
//!
//! In: the block, the state x0 that distance is measured from, a start. Out: the unknowns, in place.
//! Newton's method on the Lagrangian with exact second derivatives, `[H Jᵀ; J -δ]`, sparse and
//! symmetric. Where the Hessian, reduced to what the rows leave free, is not positive (the factors have
//! other than one negative pivot a row), its diagonal grows until it is. The small `-δ` is that of the
//! proximal method of multipliers: it keeps the factors tame and disappears with the change of the
//! multipliers. While some are counted those that come after are held a little to where they are, which
//! leaves no trace once they have settled, and those before are constants. A large linear block is solved by
//! elimination.
//!
//! **Source:** Nocedal and Wright, *Numerical Optimization*, 2nd ed., §18.1 and §16.3; Friedlander and
//! Orban, *A primal-dual regularized interior-point method*, Math. Prog. Comp. 4 (2012).

mod buckle;
mod linear;

use crate::block::{Block, Local, Workspace};
use crate::lists::Lists;
use crate::lower::{Definers, Problem};
use crate::measure::Measured;
use crate::sparse::{Ldl, Symmetric};
use crate::square::Trust;
use crate::system::{Level, SlotIndex, Turn};
use base::number::ROUNDING;
use std::sync::OnceLock;

/// A block of fewer rows than unknowns.
#[derive(Debug)]
pub(crate) struct Least {
    pub(crate) block: Block,
    /// When the change of every unknown counts; empty where all count together.
    turns: Vec<Turn>,
    /// Of unknowns, then rows; made when it is first needed.
    structure: OnceLock<Symmetric>,
    /// Of a large linear block; made when it is first needed.
    basic: OnceLock<Option<linear::Structure>>,
}

/// Buffers that a block needs while it is solved.
#[derive(Clone, Debug, Default)]
pub(crate) struct LeastScratch {
    /// The slopes by constants are nothing.
    local: Local,
    /// By unknown: what a change is measured in, and one over its square.
    scale: Vec<f64>,
    pull: Vec<f64>,
    /// By row: the square of its slopes, in units of the scales.
    steepness: Vec<f64>,
    /// What the matrix is made of: diagonals, the Jacobian, second derivatives.
    entries: Vec<f64>,
    ldl: Ldl,
    /// The factors that tell whether a branch is left.
    firm: Ldl,
    /// The right side, then the step and the change of the multipliers.
    right: Vec<f64>,
    multipliers: Vec<f64>,
    start: Vec<f64>,
    came: Came,
    /// How far a stride may go that began or ended where the last did, in parts of what one may where the branch
    /// is soft; without bound where it is firm.
    pub(crate) reach: f64,
}

/// The solution that was found last, from where its branch is followed.
#[derive(Clone, Debug, Default)]
struct Came {
    /// The unknowns, what distance was measured from, and the multipliers there.
    unknowns: Vec<SlotIndex>,
    values: Vec<f64>,
    anchor: Vec<f64>,
    multipliers: Vec<f64>,
    /// How far a stride may go from there.
    reach: f64,
    /// True while the factors are those of its last step.
    has_factors: bool,
}

impl LeastScratch {
    /// Forgets what was found, so that what comes depends on what is given alone.
    pub(crate) fn forget(&mut self) {
        self.came.unknowns.clear();
    }
    /// Takes what changes of a block's unknowns are measured in.
    fn measure(&mut self, block: &Block, scales: &[f64]) {
        self.scale.clear();
        self.scale.extend(block.unknowns.iter().map(|&u| scales[u as usize]));
        self.pull.clear();
        self.pull.extend(self.scale.iter().map(|scale| 1.0 / (scale * scale)));
    }
}

/// Whose change is counted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Counted {
    /// Every unknown's.
    All,
    /// That of those whose turn it is; those after them go along, those before are constants.
    These(Turn),
}

/// What distance is measured from and how, and how far the solution may be.
struct Asked<'a> {
    x0: &'a [f64],
    scales: &'a [f64],
    trust: Trust,
}

/// A state whose multipliers are known.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Known {
    /// The solution found last.
    Came,
    /// That from which distance is measured, where there are none.
    None,
}

/// What an unknown is while some are counted.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Part {
    Counted,
    GoesAlong,
    Constant,
}

/// What of the rows is evaluated behind a step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum What {
    Sides,
    Slopes,
}

/// The matrix that a step is found by.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Matrix {
    /// Without the rows' curvature: there are no multipliers yet.
    Flat,
    /// With second derivatives and the present multipliers.
    Exact,
    /// That of the step before, whose factors are there.
    Kept,
}

/// A linear block of more unknowns is solved by elimination.
const LARGE: usize = 60;
const STEPS: usize = 100;
/// The regularisation of the rows.
const DELTA: f64 = 1e-9;
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
/// Below this curvature a branch is soft: a little farther on it may be left, and farther still be firm again. The
/// nearer to where it is left, the less far strides go.
const SOFT: [(f64, f64); 2] = [(0.5, 1.0), (0.16, 0.125)];

impl Least {
    /// Lays a block out; `turn` tells when the change of a slot counts.
    pub(crate) fn new(problem: &Problem, turn: &dyn Fn(SlotIndex) -> Turn) -> Self {
        let block = Block::new(problem, Definers::None);
        let mut turns: Vec<Turn> = block.unknowns.iter().map(|&s| turn(s)).collect();
        if turns.iter().all(|&t| t == turns[0]) {
            turns.clear();
        }
        Self { block, turns, structure: OnceLock::new(), basic: OnceLock::new() }
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
            let curved = self.block.seconds().iter().map(|place| (place.i, place.j));
            Symmetric::of_chain(self.chain(), &self.block.pattern.bordered(curved))
        })
    }

    /// Returns unknowns, then rows, as they stand in a chain: the unknowns in order, each row where half of
    /// its unknowns have come.
    fn chain(&self) -> Vec<u32> {
        let (n, m) = (self.block.unknowns.len() as u32, self.block.height() as u32);
        let middle = |r: u32| {
            let own = self.block.pattern.row(r as usize);
            own.get(own.len().saturating_sub(1) / 2).copied().unwrap_or(0)
        };
        let rows_at = Lists::new(n as usize, (0..m).map(|r| (middle(r), n + r)));
        let mut chain = Vec::with_capacity((n + m) as usize);
        for u in 0..n {
            chain.push(u);
            chain.extend_from_slice(rows_at.of(u));
        }
        chain
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
        let asked = Asked { x0, scales, trust };
        s.reach = f64::INFINITY;
        if self.block.is_linear
            && self.block.unknowns.len() > LARGE
            && self.solve_linear(&asked, values, w, s)
        {
            return Measured::Least;
        }
        if self.turns.is_empty() {
            return self.least(Counted::All, &asked, values, w, s);
        }
        for turn in Turn::ALL.into_iter().filter(|turn| self.turns.contains(turn)) {
            if self.least(Counted::These(turn), &asked, values, w, s) == Measured::Failed {
                return Measured::Failed;
            }
        }
        Measured::Least
    }
    /// Solves by elimination, by what holds for any numbers or else for these; where that is not possible, all is
    /// as it was.
    fn solve_linear(
        &self,
        asked: &Asked<'_>,
        values: &mut [f64],
        w: &mut Workspace,
        s: &mut LeastScratch,
    ) -> bool {
        let before: Vec<f64> = self.block.unknowns.iter().map(|&u| values[u as usize]).collect();
        let scale = |&u: &SlotIndex| asked.scales[u as usize];
        let scale: Vec<f64> = self.block.unknowns.iter().map(scale).collect();
        // those whose turn is first are told apart from all the others
        let first = self.turns.iter().min();
        let last = self.turns.iter().max();
        if self.turns.iter().any(|turn| Some(turn) != first && Some(turn) != last) {
            return false;
        }
        let is_first: Vec<bool> = self.turns.iter().map(|turn| Some(turn) == first).collect();
        let structure = || linear::Structure::of_block(&self.block, &is_first);
        let structure = self.basic.get_or_init(structure).as_ref();
        for structure in structure.map(Some).into_iter().chain([None]) {
            let asked = (&*is_first, &*scale, asked.x0);
            let is_solved = linear::solve(&self.block, asked, structure, values, w, &mut s.local)
                && self.holds_at(values, w, s);
            if is_solved {
                return true;
            }
            for (&u, x) in self.block.unknowns.iter().zip(&before) {
                values[u as usize] = *x;
            }
        }
        false
    }
    fn part(&self, counted: Counted, unknown: usize) -> Part {
        match (counted, self.turns.get(unknown)) {
            (Counted::These(now), Some(own)) if own > &now => Part::GoesAlong,
            (Counted::These(now), Some(own)) if own < &now => Part::Constant,
            (Counted::All | Counted::These(_), _) => Part::Counted,
        }
    }

    /// Makes the change of those that are counted least.
    fn least(
        &self,
        counted: Counted,
        &Asked { x0, scales, trust }: &Asked<'_>,
        values: &mut [f64],
        w: &mut Workspace,
        s: &mut LeastScratch,
    ) -> Measured {
        let block = &self.block;
        s.measure(block, scales);
        self.evaluate(counted, values, w, s);
        self.weigh(s);
        let mut norm = norm(s);
        let follows = trust == Trust::Branch && !block.is_linear;
        // on a branch the multipliers are those of the last state, and the first step is Newton's too
        s.multipliers.clear();
        s.multipliers.resize(block.height(), 0.0);
        let had_factors = std::mem::take(&mut s.came.has_factors);
        let mut reach = f64::INFINITY;
        let mut first = if follows { Matrix::Exact } else { Matrix::Flat };
        if follows {
            let known = self.take_multipliers(x0, values, s);
            if known == Some(Known::Came) {
                reach = s.came.reach;
            }
            match known {
                Some(Known::Came) if had_factors && counted == Counted::All => first = Matrix::Kept,
                Some(Known::Came | Known::None) => {}
                None => {
                    if self.step(counted, x0, values, Matrix::Flat, w, s).is_none() {
                        return Measured::Failed;
                    }
                    take_on(s);
                }
            }
        }
        let mut size = f64::INFINITY;
        // how the steps before shrank
        let mut shrank = f64::INFINITY;
        let mut was_exact = false;
        let mut smallest = (f64::INFINITY, 0);
        let mut polished = 0;
        for iteration in 0..STEPS {
            if w.is_spent() {
                return Measured::Failed;
            }
            let matrix = match iteration {
                0 => first,
                // what it is off by is the last step times this one, and how much they shrank by how long
                // but where rows do not hold by that, the matrix is made anew
                _ if polished < 2 && size * shrank * shrank * shrank <= SETTLED => Matrix::Kept,
                _ => Matrix::Exact,
            };
            let Some(shift) =
                self.step(counted, x0, values, matrix, w, s).filter(|_| norm.is_finite())
            else {
                return Measured::Failed;
            };
            let before = size;
            size = s.right.iter().zip(&s.scale).fold(0.0, |m: f64, (d, by)| m.max((d / by).abs()));
            if !size.is_finite() {
                return Measured::Failed;
            }
            if follows && leaves(iteration, shift, [before, size]) {
                return Measured::Failed;
            }
            shrank = if iteration > 0 { size / before } else { f64::INFINITY };
            if size < 0.9 * smallest.0 {
                smallest = (size, 0);
            } else {
                smallest.1 += 1;
            }
            take_on(s);
            // what comes after a step that shrank like this is no step; after Newton's it shrinks by the square,
            // as far as the rows are not held back
            let next = size * shrank;
            let is_newton = was_exact && matrix == Matrix::Exact;
            was_exact = matrix == Matrix::Exact;
            // behind the last step nothing is asked but whether the rows hold
            let may_be_last =
                size <= SETTLED || iteration > 1 && next.min(next * shrank) <= SETTLED;
            let what = if may_be_last { What::Sides } else { What::Slopes };
            norm = self.advance(counted, values, (size, what), norm, w, s);
            let last = size <= SETTLED
                || iteration > 1 && next <= SETTLED
                || iteration > 1 && is_newton && norm.max(next * shrank) <= SETTLED
                || smallest.1 >= 4 && smallest.0 < 1e-7;
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
            if may_be_last {
                self.evaluate(counted, values, w, s);
            }
        }
        let is_found = self.holds(values, w, s) && size < 1e-6;
        let may_bend = follows && counted == Counted::All;
        if !is_found || may_bend && !self.is_on_branch(reach, s) {
            return Measured::Failed;
        }
        if may_bend {
            self.keep(x0, values, s);
        }
        Measured::Least
    }

    /// Evaluates the rows; what is constant has no slopes.
    fn evaluate(&self, counted: Counted, values: &[f64], w: &mut Workspace, s: &mut LeastScratch) {
        let block = &self.block;
        block.slopes(values, w, &mut s.local);
        if self.has_constants(counted) {
            for r in 0..block.height() {
                for e in block.pattern.range(r) {
                    if self.part(counted, block.pattern.column(e)) == Part::Constant {
                        s.local.jacobian[e] = 0.0;
                    }
                }
            }
        }
    }
    fn has_constants(&self, counted: Counted) -> bool {
        matches!(counted, Counted::These(now) if self.turns.iter().any(|&own| own < now))
    }

    /// Takes the multipliers of the state that the values are still in, if they are known: those of the solution
    /// found last, and none where distance is measured from.
    fn take_multipliers(&self, x0: &[f64], values: &[f64], s: &mut LeastScratch) -> Option<Known> {
        let is_at = |state: &[f64], of: &[f64]| {
            self.block.unknowns.iter().zip(state).all(|(&u, x)| *x == of[u as usize])
        };
        let came = &s.came;
        if came.unknowns == self.block.unknowns
            && is_at(&came.values, values)
            && is_at(&came.anchor, x0)
        {
            s.multipliers.clone_from(&came.multipliers);
            return Some(Known::Came);
        }
        let is_start = self.block.unknowns.iter().all(|&u| values[u as usize] == x0[u as usize]);
        is_start.then_some(Known::None)
    }
    /// Keeps the solution, whose last factors are there.
    fn keep(&self, x0: &[f64], values: &[f64], s: &mut LeastScratch) {
        let LeastScratch { came, multipliers, .. } = s;
        came.unknowns.clone_from(&self.block.unknowns);
        for (kept, of) in [(&mut came.values, values), (&mut came.anchor, x0)] {
            kept.clear();
            kept.extend(self.block.unknowns.iter().map(|&u| of[u as usize]));
        }
        came.multipliers.clone_from(multipliers);
        came.has_factors = true;
    }

    /// Returns true if the branch is not left, and finds how far a stride may go that came from where one may go so
    /// far.
    fn is_on_branch(&self, before: f64, s: &mut LeastScratch) -> bool {
        let soft = SOFT.iter().take_while(|(soft, _)| !self.is_firm(*soft, s)).last();
        if soft.is_some() && !self.is_firm(FIRM, s) {
            return false;
        }
        s.came.reach = soft.map_or(f64::INFINITY, |(_, reach)| *reach);
        s.reach = before.min(s.came.reach);
        true
    }

    /// Returns true if what is least is curved by so much in every direction that the rows leave free, by the
    /// matrix of the last step.
    fn is_firm(&self, firm: f64, s: &mut LeastScratch) -> bool {
        let (n, m) = (self.block.unknowns.len(), self.block.height());
        let places = self.block.seconds();
        let seconds = s.entries.len() - places.len();
        // rows of small sums cannot bring it down so far
        s.start.clear();
        s.start.resize(n, 0.0);
        for (place, h) in places.iter().zip(&s.entries[seconds..]) {
            let (i, j) = (place.i as usize, place.j as usize);
            let size = (h * s.scale[i] * s.scale[j]).abs();
            s.start[i] += size;
            if i != j {
                s.start[j] += size;
            }
        }
        if s.start.iter().all(|&sum| sum < 1.0 - firm) {
            return true;
        }
        s.entries[..n].iter_mut().zip(&s.pull).for_each(|(d, pull)| *d = (1.0 - firm) * pull);
        self.structure().factorise(&s.entries, &mut s.firm) == Some(m)
    }

    /// Takes the slopes of rows for none that are rounding; the rows have to be weighed.
    fn flatten(&self, s: &mut LeastScratch) {
        let pattern = &self.block.pattern;
        for r in 0..self.block.height() {
            let LeastScratch { local, scale, steepness, .. } = &mut *s;
            let slopes = pattern.range(r).map(|e| local.jacobian[e] * scale[pattern.column(e)]);
            if slopes.map(|d| d * d).sum::<f64>() != steepness[r] {
                pattern.range(r).for_each(|e| local.jacobian[e] = 0.0);
            }
        }
    }

    /// Freezes for every row how steep it is, so that its error is dimensionless.
    fn weigh(&self, s: &mut LeastScratch) {
        let pattern = &self.block.pattern;
        s.steepness.clear();
        s.steepness.reserve(self.block.height());
        for r in 0..self.block.height() {
            let mut sum = 0.0;
            for e in pattern.range(r) {
                let d = s.local.jacobian[e] * s.scale[pattern.column(e)];
                sum += d * d;
            }
            // a slope that rounding of its sides makes is none
            let rounding = ROUNDING * s.local.left[r].abs().max(s.local.right[r].abs());
            let is_slope = sum > rounding * rounding && sum.is_finite();
            s.steepness.push(if is_slope { sum } else { 1.0 });
        }
    }

    /// Finds step and change of the multipliers; returns the diagonal that it took, or nothing where the matrix
    /// cannot be factorised.
    fn step(
        &self,
        counted: Counted,
        x0: &[f64],
        values: &[f64],
        matrix: Matrix,
        w: &mut Workspace,
        s: &mut LeastScratch,
    ) -> Option<f64> {
        let block = &self.block;
        let shift = match matrix {
            Matrix::Kept => 1.0,
            Matrix::Flat | Matrix::Exact => self.factorise(counted, values, matrix, w, s)?,
        };
        s.right.clear();
        s.right.reserve(block.unknowns.len() + block.height());
        s.right.extend(block.unknowns.iter().zip(&s.pull).enumerate().map(|(i, (&u, pull))| {
            match self.part(counted, i) {
                Part::Counted => (x0[u as usize] - values[u as usize]) * pull,
                Part::GoesAlong | Part::Constant => 0.0,
            }
        }));
        // what the multipliers have now is taken off, so that rounding shrinks with the steps
        for (r, multiplier) in s.multipliers.iter().enumerate() {
            for e in block.pattern.range(r) {
                s.right[block.pattern.column(e)] -= s.local.jacobian[e] * multiplier;
            }
        }
        s.right.extend(s.local.left.iter().zip(&s.local.right).map(|(left, right)| right - left));
        self.structure().solve(&mut s.ldl, &mut s.right);
        Some(shift)
    }

    /// Factorises the matrix, its diagonal larger where it has to be; returns that, or nothing.
    fn factorise(
        &self,
        counted: Counted,
        values: &[f64],
        matrix: Matrix,
        w: &mut Workspace,
        s: &mut LeastScratch,
    ) -> Option<f64> {
        let block = &self.block;
        let (n, m) = (block.unknowns.len(), block.height());
        w.spend(100 * (n + block.pattern.len()));
        s.entries.clear();
        s.entries.reserve(n + m + s.local.jacobian.len() + block.seconds().len());
        let pulls = s.pull.iter().enumerate();
        s.entries.extend(pulls.map(|(i, pull)| held(self.part(counted, i)) * pull));
        s.entries.extend(s.steepness.iter().map(|steepness| -DELTA * steepness));
        s.entries.extend_from_slice(&s.local.jacobian);
        let first_curved = s.entries.len();
        let places = block.seconds();
        if matrix == Matrix::Exact {
            let LeastScratch { entries, multipliers, .. } = &mut *s;
            block.each_second(values, w, &mut |row, own, out| {
                let multiplier = multipliers[row];
                entries.extend(own.iter().map(|place| multiplier * place.of(out)));
            });
            let curved = &mut s.entries[first_curved..];
            curved.iter_mut().filter(|h| !h.is_finite()).for_each(|h| *h = 0.0);
            if self.has_constants(counted) {
                let is_constant = |i: u32| self.part(counted, i as usize) == Part::Constant;
                for (place, h) in places.iter().zip(curved) {
                    if is_constant(place.i) || is_constant(place.j) {
                        *h = 0.0;
                    }
                }
            }
        } else {
            s.entries.resize(first_curved + places.len(), 0.0);
        }
        let mut shift = 1.0;
        loop {
            match self.structure().factorise(&s.entries, &mut s.ldl) {
                Some(negative) if negative == m => return Some(shift),
                Some(_) | None if shift > 1e8 => return None,
                Some(_) | None => {
                    if s.entries[first_curved..].iter().all(|&h| h == 0.0) {
                        return None;
                    }
                    let diagonal = s.entries[..n].iter_mut().zip(&s.pull);
                    diagonal.for_each(|(d, pull)| *d += 3.0 * shift * pull);
                    shift *= 4.0;
                }
            }
        }
    }

    /// Goes along the step, shortened until the rows are not torn apart; returns the norm there.
    fn advance(
        &self,
        counted: Counted,
        values: &mut [f64],
        (size, what): (f64, What),
        before: f64,
        w: &mut Workspace,
        s: &mut LeastScratch,
    ) -> f64 {
        let block = &self.block;
        // longer steps than half the extent are not believed
        let mut length = if size > 0.5 && !block.is_linear { 0.5 / size } else { 1.0 };
        s.start.clear();
        s.start.extend(block.unknowns.iter().map(|&u| values[u as usize]));
        loop {
            for ((&u, start), d) in block.unknowns.iter().zip(&s.start).zip(&s.right) {
                values[u as usize] = start + length * d;
            }
            match what {
                What::Sides => block.sides(values, w, &mut s.local),
                What::Slopes => self.evaluate(counted, values, w, s),
            }
            let now = norm(s);
            if now <= 0.1f64.max(2.0 * before) || length < 1e-6 {
                return now;
            }
            length *= 0.5;
        }
    }
}

/// Returns true if a step, so long after one so long, tells that a branch of least change ends, where it has no
/// minimum any more.
fn leaves(iteration: usize, shift: f64, [before, size]: [f64; 2]) -> bool {
    match iteration {
        0 => size > 0.5 || shift > 1.0,
        1 => size > 0.1 * before && size > 1e-7,
        _ => size > 0.5 * before && size > 1e-7,
    }
}

/// Returns the dimensionless norm of what the rows are off by.
fn norm(s: &LeastScratch) -> f64 {
    let mut sum = 0.0;
    for ((left, right), steepness) in s.local.left.iter().zip(&s.local.right).zip(&s.steepness) {
        sum += (left - right) * (left - right) / steepness;
    }
    base::number::sqrt(sum)
}

/// Takes on the multipliers of a step.
fn take_on(s: &mut LeastScratch) {
    let changes = &s.right[s.scale.len()..];
    s.multipliers.iter_mut().zip(changes).for_each(|(multiplier, change)| *multiplier += change);
}

/// How strongly an unknown is held.
fn held(part: Part) -> f64 {
    match part {
        Part::Counted | Part::Constant => 1.0,
        Part::GoesAlong => ALONG,
    }
}
