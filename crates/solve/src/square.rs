//! Square blocks: as many equations as unknowns, solved by damped Newton steps.
//!
//! In: the block's tape (sides and exact derivatives), the state so far, the branch to stay on. Out: the
//! unknowns, in place, or the reason why not. Linear blocks take one step. Steps are accepted while
//! the norm of the scaled residuals falls (Armijo); where Newton's direction is no help, Levenberg
//! and Marquardt's is. Iteration goes on to stagnation, so that double roots come out as well as the
//! arithmetic allows.

use crate::dense;
use crate::lower::Problem;
use crate::system::SlotIndex;
use expr::{Arena, Tape, Var};

/// A compiled square block.
#[derive(Debug)]
pub(crate) struct Square {
    pub(crate) unknowns: Vec<SlotIndex>,
    within: Vec<f64>,
    /// Left and right of every row, then every derivative that is not zero everywhere.
    tape: Tape,
    entries: Vec<(u32, u32)>,
    pub(crate) is_linear: bool,
}

/// Buffers that a block needs while it is solved.
#[derive(Clone, Debug, Default)]
pub(crate) struct SquareScratch {
    out: Vec<f64>,
    jacobian: Vec<f64>,
    factors: Vec<f64>,
    swaps: Vec<usize>,
    residual: Vec<f64>,
    step: Vec<f64>,
    start: Vec<f64>,
    weight: Vec<f64>,
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
}

/// What came of it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Solved {
    /// Solved; the Jacobian is regular there.
    Regular,
    /// Solved where the Jacobian is singular; the unknown, by position, that is least determined.
    Double(u32),
    /// Not solved, or not within the trust.
    Failed,
}

const STEPS: usize = 200;
/// How many steps may be taken whatever the residuals do.
const LEAPS: usize = 60;

impl Square {
    /// Compiles sides and derivatives of a block.
    pub(crate) fn compile(arena: &mut Arena, problem: &Problem) -> Self {
        let vars: Vec<Var> = problem.unknowns.iter().map(|&s| Var(s)).collect();
        let mut outs = Vec::new();
        let mut derivatives = Vec::new();
        let mut entries = Vec::new();
        let mut is_linear = true;
        for (r, row) in problem.rows.iter().enumerate() {
            outs.extend([row.left, row.right]);
            let residual = arena.sub(row.left, row.right);
            let mentioned = arena.variables(residual);
            let own: Vec<(usize, Var)> =
                vars.iter().copied().enumerate().filter(|(_, v)| mentioned.contains(v)).collect();
            let own_vars: Vec<Var> = own.iter().map(|o| o.1).collect();
            let gradient = expr::gradient(arena, residual, &own_vars);
            for (&(column, _), d) in own.iter().zip(gradient) {
                if arena.as_constant(d) != Some(0.0) {
                    entries.push((r as u32, column as u32));
                    is_linear &= arena.variables(d).iter().all(|v| !vars.contains(v));
                    derivatives.push(d);
                }
            }
        }
        outs.extend(derivatives);
        Self {
            unknowns: problem.unknowns.clone(),
            within: problem.rows.iter().map(|r| r.within).collect(),
            tape: Tape::compile(arena, &outs),
            entries,
            is_linear,
        }
    }

    /// Returns true if the rows hold for these values.
    pub(crate) fn holds_at(
        &self,
        values: &[f64],
        registers: &mut Vec<f64>,
        s: &mut SquareScratch,
    ) -> bool {
        self.prepare(s);
        self.evaluate(values, registers, s);
        self.holds(s)
    }

    /// Returns the sign of the determinant at these values: the orientation of the block.
    pub(crate) fn orientation(
        &self,
        values: &[f64],
        registers: &mut Vec<f64>,
        s: &mut SquareScratch,
    ) -> i8 {
        self.prepare(s);
        self.evaluate(values, registers, s);
        self.fill_jacobian(s);
        dense::factorise(&mut s.jacobian, self.unknowns.len(), &mut s.swaps).sign
    }

    fn evaluate(&self, values: &[f64], registers: &mut Vec<f64>, s: &mut SquareScratch) {
        self.tape.run(values, registers, &mut s.out);
        for r in 0..self.within.len() {
            s.residual[r] = s.out[2 * r] - s.out[2 * r + 1];
        }
    }
    fn holds(&self, s: &SquareScratch) -> bool {
        (0..self.within.len()).all(|r| {
            let (left, right) = (s.out[2 * r], s.out[2 * r + 1]);
            (left - right).abs() <= self.within[r] * left.abs().max(right.abs()).max(1.0)
        })
    }
    fn fill_jacobian(&self, s: &mut SquareScratch) {
        let n = self.unknowns.len();
        s.jacobian.clear();
        s.jacobian.resize(n * n, 0.0);
        for (&(r, c), &d) in self.entries.iter().zip(&s.out[2 * n..]) {
            s.jacobian[r as usize * n + c as usize] = d;
        }
    }
    fn prepare(&self, s: &mut SquareScratch) {
        let n = self.unknowns.len();
        s.out.clear();
        s.out.resize(2 * n + self.entries.len(), 0.0);
        for buffer in [&mut s.residual, &mut s.step, &mut s.start, &mut s.weight] {
            buffer.clear();
            buffer.resize(n, 0.0);
        }
    }
    /// Freezes a weight for every row that makes it dimensionless.
    fn weigh(&self, scales: &[f64], s: &mut SquareScratch) {
        let n = self.unknowns.len();
        for r in 0..n {
            let mut size = 0.0f64;
            for c in 0..n {
                size = size.max((s.jacobian[r * n + c] * scales[self.unknowns[c] as usize]).abs());
            }
            s.weight[r] = if size > 0.0 && size.is_finite() { 1.0 / size } else { 1.0 };
        }
    }
    fn weighted_norm(&self, s: &SquareScratch) -> f64 {
        let mut sum = 0.0;
        for (r, w) in s.residual.iter().zip(&s.weight) {
            sum += (r * w) * (r * w);
        }
        base::number::sqrt(sum)
    }
    fn step_size(&self, scales: &[f64], s: &SquareScratch) -> f64 {
        let mut size = 0.0f64;
        for (&u, d) in self.unknowns.iter().zip(&s.step) {
            size = size.max((d / scales[u as usize]).abs());
        }
        size
    }

    /// Solves from the values that the unknowns have now, one scale for every slot; `last` is the
    /// state whose orientation is kept.
    pub(crate) fn solve(
        &self,
        last: &[f64],
        values: &mut [f64],
        scales: &[f64],
        trust: Trust,
        registers: &mut Vec<f64>,
        s: &mut SquareScratch,
    ) -> Solved {
        let n = self.unknowns.len();
        let branch = match trust {
            Trust::Branch if !self.is_linear => Some(self.orientation(last, registers, s)),
            Trust::Branch | Trust::Any | Trust::Leap => None,
        };
        self.prepare(s);
        self.evaluate(values, registers, s);
        self.fill_jacobian(s);
        self.weigh(scales, s);
        let mut norm = self.weighted_norm(s);
        if !norm.is_finite() {
            return Solved::Failed;
        }
        let (mut first_size, mut damping) = (0.0, 0.0f64);
        let mut ratio = 1.0;
        for iteration in 0..STEPS {
            if norm == 0.0 && iteration > 0 {
                break;
            }
            s.factors.clear();
            s.factors.extend_from_slice(&s.jacobian);
            for r in 0..n {
                for c in 0..n {
                    s.factors[r * n + c] *= s.weight[r] * scales[self.unknowns[c] as usize];
                }
            }
            let factors = dense::factorise(&mut s.factors, n, &mut s.swaps);
            ratio = factors.ratio;
            if branch.is_some_and(|sign| sign != factors.sign || sign == 0) && norm > 0.0 {
                return Solved::Failed;
            }
            if norm == 0.0 {
                break;
            }
            let newton = factors.ratio > 1e-14 && damping == 0.0;
            if newton {
                for r in 0..n {
                    s.step[r] = -s.residual[r] * s.weight[r];
                }
                dense::substitute_back(&s.factors, n, &s.swaps, &mut s.step);
                for c in 0..n {
                    s.step[c] *= scales[self.unknowns[c] as usize];
                }
            } else {
                self.damped_direction(scales, damping.max(1e-12), s);
            }
            let size = self.step_size(scales, s);
            match iteration {
                0 => first_size = size,
                1 if branch.is_some() && size > 0.5 * first_size && size > 1e-7 => {
                    return Solved::Failed;
                }
                _ => {}
            }
            let was_held = self.holds(s);
            let found = if trust == Trust::Leap && !was_held && iteration < LEAPS {
                Some((1.0, self.leap(values, size, registers, s)))
            } else {
                self.search(values, norm, was_held, registers, s)
            };
            match found {
                Some((length, better)) => {
                    if branch.is_some() && length < 1.0 && !was_held {
                        return Solved::Failed;
                    }
                    if !better.is_finite() {
                        return Solved::Failed;
                    }
                    let slow = better > 0.5 * norm;
                    norm = better;
                    self.fill_jacobian(s);
                    damping = if newton { 0.0 } else { damping * 0.1 };
                    if damping < 1e-10 {
                        damping = 0.0;
                    }
                    if was_held && slow {
                        if damping == 0.0 {
                            break;
                        }
                        damping = 0.0;
                    }
                }
                None if was_held && damping == 0.0 => break,
                None if was_held => damping = 0.0,
                None if branch.is_some() => return Solved::Failed,
                None => {
                    damping = (damping * 10.0).max(1e-6);
                    if damping > 1e8 {
                        return Solved::Failed;
                    }
                }
            }
        }
        self.evaluate(values, registers, s);
        if !self.holds(s) {
            return Solved::Failed;
        }
        if ratio < 1e-6 { self.least_determined(s) } else { Solved::Regular }
    }

    /// Takes the whole step, but not more than half the extent; returns the norm there.
    fn leap(
        &self,
        values: &mut [f64],
        size: f64,
        registers: &mut Vec<f64>,
        s: &mut SquareScratch,
    ) -> f64 {
        let length = if size > 0.5 { 0.5 / size } else { 1.0 };
        for (&u, d) in self.unknowns.iter().zip(&s.step) {
            values[u as usize] += length * d;
        }
        self.evaluate(values, registers, s);
        self.weighted_norm(s)
    }

    /// Walks along the step, halving it until the residuals are smaller; returns length and norm.
    fn search(
        &self,
        values: &mut [f64],
        norm: f64,
        was_held: bool,
        registers: &mut Vec<f64>,
        s: &mut SquareScratch,
    ) -> Option<(f64, f64)> {
        for (start, &u) in s.start.iter_mut().zip(&self.unknowns) {
            *start = values[u as usize];
        }
        let mut length = 1.0;
        let shortest = if was_held { 1.0 } else { 1e-7 };
        while length >= shortest {
            for ((&u, start), d) in self.unknowns.iter().zip(&s.start).zip(&s.step) {
                values[u as usize] = start + length * d;
            }
            self.evaluate(values, registers, s);
            let now = self.weighted_norm(s);
            if now.is_finite() && now < (1.0 - 1e-4 * length) * norm {
                return Some((length, now));
            }
            length *= 0.5;
        }
        for (&u, start) in self.unknowns.iter().zip(&s.start) {
            values[u as usize] = *start;
        }
        self.evaluate(values, registers, s);
        None
    }

    /// The step of Levenberg and Marquardt in scaled unknowns.
    fn damped_direction(&self, scales: &[f64], damping: f64, s: &mut SquareScratch) {
        let n = self.unknowns.len();
        let scaled = |s: &SquareScratch, r: usize, c: usize| {
            s.jacobian[r * n + c] * s.weight[r] * scales[self.unknowns[c] as usize]
        };
        s.factors.clear();
        s.factors.resize(n * n, 0.0);
        for i in 0..n {
            for j in 0..n {
                let mut sum = 0.0;
                for r in 0..n {
                    sum += scaled(s, r, i) * scaled(s, r, j);
                }
                s.factors[i * n + j] = sum;
            }
            s.factors[i * n + i] += damping;
        }
        for i in 0..n {
            let mut sum = 0.0;
            for r in 0..n {
                sum -= scaled(s, r, i) * s.residual[r] * s.weight[r];
            }
            s.step[i] = sum;
        }
        let mut swaps = std::mem::take(&mut s.swaps);
        dense::factorise(&mut s.factors, n, &mut swaps);
        let mut step = std::mem::take(&mut s.step);
        dense::substitute_back(&s.factors, n, &swaps, &mut step);
        for (c, d) in step.iter_mut().enumerate() {
            *d *= scales[self.unknowns[c] as usize];
        }
        (s.swaps, s.step) = (swaps, step);
    }

    /// The unknown whose column the others come nearest to replacing.
    fn least_determined(&self, s: &mut SquareScratch) -> Solved {
        let n = self.unknowns.len();
        self.fill_jacobian(s);
        let rows: Vec<Vec<f64>> = (0..n).map(|r| s.jacobian[r * n..][..n].to_vec()).collect();
        let mut normal = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..n {
                for row in &rows {
                    normal[i * n + j] += row[i] * row[j];
                }
            }
        }
        let (values, vectors) = dense::eigen(normal, n);
        let least = (0..n).min_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap_or(0);
        let mut slot = 0;
        for c in 1..n {
            if vectors[least][c].abs() > vectors[least][slot].abs() {
                slot = c;
            }
        }
        Solved::Double(slot as u32)
    }
}
