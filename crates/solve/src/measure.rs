//! Measure: how much, where structure leaves a choice.
//!
//! In: rows with their levels, unknowns, the state x0 that distance is measured from, a start. Out: the
//! unknowns, in place: hard rows hold; then, level by level and never at the cost of a higher one,
//! the sum of squares of the soft rows is least; then the distance of given numbers from x0, then that of
//! everything else.
//!
//! Newton's method on the Lagrangian of every level, each in the directions that the levels above
//! leave free. A direction is left free where the level above has no curvature, the curvature of the
//! stronger rows included (exact second derivatives): an elbow that is stretched to its limit is
//! held there by curvature alone. Where curvature is negative the step goes downhill.
//!
//! **Source:** Nocedal and Wright, *Numerical Optimization*, 2nd ed., §18.1 and §3.4.

use crate::dense::{self, Spaces};
use crate::eliminate::{Definers, Definition, eliminate};
use crate::lower::{Problem, ProblemRow};
use crate::square::Trust;
use crate::system::{Level, SlotIndex};
use base::number::close;
use expr::{Arena, Tape, Var};

/// A compiled block of rows and unknowns of any number.
#[derive(Debug)]
pub(crate) struct Measure {
    pub(crate) unknowns: Vec<SlotIndex>,
    levels: Vec<Level>,
    within: Vec<f64>,
    /// For every row, the scale of the slots that it speaks of, where they have one.
    classes: Vec<Option<u16>>,
    /// For every unknown: it is a given number that yields.
    given: Vec<bool>,
    /// Left and right of every row, first derivatives, second derivatives.
    tape: Tape,
    gradient: Vec<(u32, u32)>,
    /// Row and two unknowns, the first not after the second.
    curvature: Vec<(u32, u32, u32)>,
    outs: usize,
    /// Unknowns that required rows define outright, and the tape that computes them afterwards.
    defined: Vec<SlotIndex>,
    definitions: Tape,
}

/// What came of it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Measured {
    /// The hard rows hold and every level is least.
    Least,
    /// The hard rows do not hold, or the steps did not settle.
    Failed,
}

/// One evaluation, in scaled unknowns and weighted rows.
struct Local {
    residual: Vec<f64>,
    jacobian: Vec<Vec<f64>>,
    out: Vec<f64>,
}

const STEPS: usize = 200;
/// Curvature below this, where one is ordinary, leaves a direction to the next level.
const FLAT: f64 = 1e-9;
/// Steps below this, in parts of the extent, are no steps.
const SETTLED: f64 = 1e-12;

impl Measure {
    /// Compiles sides, derivatives and second derivatives; `kind` tells a slot's scale, and whether it is
    /// a given number.
    pub(crate) fn compile(
        arena: &mut Arena,
        problem: &Problem,
        kind: &dyn Fn(SlotIndex) -> (u16, bool),
    ) -> Self {
        // Where the rows leave no choice, distance decides nothing, and definitions can be put in.
        if problem.rows.len() < problem.unknowns.len() {
            return Self::of_core(arena, problem, &[], kind);
        }
        let reduced = eliminate(arena, problem, Definers::Required);
        Self::of_core(arena, &reduced.problem, &reduced.definitions, kind)
    }

    fn of_core(
        arena: &mut Arena,
        problem: &Problem,
        definitions: &[Definition],
        kind: &dyn Fn(SlotIndex) -> (u16, bool),
    ) -> Self {
        let vars: Vec<Var> = problem.unknowns.iter().map(|&s| Var(s)).collect();
        let (mut outs, mut first, mut second) = (Vec::new(), Vec::new(), Vec::new());
        let (mut gradient, mut curvature) = (Vec::new(), Vec::new());
        for (r, row) in problem.rows.iter().enumerate() {
            outs.extend([row.left, row.right]);
            let residual = arena.sub(row.left, row.right);
            for (i, d) in non_zero_gradient(arena, residual, &vars, 0) {
                gradient.push((r as u32, i));
                first.push(d);
                for (j, h) in non_zero_gradient(arena, d, &vars, i as usize) {
                    curvature.push((r as u32, i, j));
                    second.push(h);
                }
            }
        }
        outs.extend(first);
        outs.extend(second);
        Self {
            unknowns: problem.unknowns.clone(),
            levels: problem.rows.iter().map(|r| r.level).collect(),
            within: problem.rows.iter().map(|r| r.within).collect(),
            classes: problem.rows.iter().map(|r| common_scale(arena, r, kind)).collect(),
            given: problem.unknowns.iter().map(|&s| kind(s).1).collect(),
            tape: Tape::compile(arena, &outs),
            gradient,
            curvature,
            outs: outs.len(),
            defined: definitions.iter().map(|d| d.slot).collect(),
            definitions: Tape::compile(
                arena,
                &definitions.iter().map(|d| d.value).collect::<Vec<_>>(),
            ),
        }
    }

    /// Returns every slot that solving writes.
    pub(crate) fn targets(&self) -> impl Iterator<Item = SlotIndex> + '_ {
        self.unknowns.iter().chain(&self.defined).copied()
    }

    /// Solves from the values that the unknowns have now; distance is measured from `x0`.
    pub(crate) fn solve(
        &self,
        x0: &[f64],
        values: &mut [f64],
        scales: &[f64],
        trust: Trust,
        registers: &mut Vec<f64>,
    ) -> Measured {
        let scale: Vec<f64> = self.unknowns.iter().map(|&u| scales[u as usize]).collect();
        let weights = self.weights(x0, values, &scale, registers);
        let (mut smallest, mut idle) = (f64::INFINITY, 0);
        let mut settled = false;
        for iteration in 0..STEPS {
            let Some(local) = self.evaluate(values, &scale, &weights, registers) else {
                return Measured::Failed;
            };
            let away: Vec<f64> = self
                .unknowns
                .iter()
                .zip(&scale)
                .map(|(&u, s)| (values[u as usize] - x0[u as usize]) / s)
                .collect();
            let mut step = self.direction(&local, &away, &weights, &scale);
            let size = step.iter().fold(0.0f64, |m, d| m.max(d.abs()));
            if !size.is_finite() {
                return Measured::Failed;
            }
            let curved = !self.curvature.is_empty();
            let leaps = match iteration {
                0 => size > 0.5,
                1 => size > 1e-3f64.max(0.5 * smallest),
                _ => false,
            };
            if trust == Trust::Branch && curved && leaps {
                return Measured::Failed;
            }
            // longer steps than half the extent are not believed
            if size > 0.5 && curved {
                for d in &mut step {
                    *d *= 0.5 / size;
                }
            }
            let hard = self.hard_norm(&local);
            if size <= SETTLED || (idle >= 4 && smallest < 1e-7) {
                settled = true;
                break;
            }
            if size < 0.9 * smallest {
                (smallest, idle) = (size, 0);
            } else {
                idle += 1;
                if idle > 60 {
                    return Measured::Failed;
                }
            }
            self.advance(values, &step, &scale, hard, &weights, registers);
        }
        match self.evaluate(values, &scale, &weights, registers) {
            Some(local) if settled && self.hard_rows_hold(&local) => {
                self.define(values, registers);
                Measured::Least
            }
            Some(_) | None => Measured::Failed,
        }
    }

    /// Computes what required rows define outright.
    fn define(&self, values: &mut [f64], registers: &mut Vec<f64>) {
        let mut out = vec![0.0; self.defined.len()];
        self.definitions.run(values, registers, &mut out);
        for (&slot, value) in self.defined.iter().zip(out) {
            values[slot as usize] = value;
        }
    }

    /// Returns true if the state, as it is, is what solving would leave: hard rows hold and no level
    /// can be improved noticeably.
    pub(crate) fn is_settled(
        &self,
        x0: &[f64],
        values: &[f64],
        scales: &[f64],
        registers: &mut Vec<f64>,
    ) -> bool {
        let scale: Vec<f64> = self.unknowns.iter().map(|&u| scales[u as usize]).collect();
        let weights = self.weights(x0, values, &scale, registers);
        let Some(local) = self.evaluate(values, &scale, &weights, registers) else {
            return false;
        };
        let away: Vec<f64> = self
            .unknowns
            .iter()
            .zip(&scale)
            .map(|(&u, s)| (values[u as usize] - x0[u as usize]) / s)
            .collect();
        let step = self.direction(&local, &away, &weights, &scale);
        let mut out = vec![0.0; self.defined.len()];
        self.definitions.run(values, registers, &mut out);
        let agrees = |(&slot, &x): (&SlotIndex, &f64)| close(values[slot as usize], x);
        self.hard_rows_hold(&local)
            && step.iter().all(|d| d.abs() <= 1e-9)
            && self.defined.iter().zip(&out).all(agrees)
    }

    fn hard_rows_hold(&self, local: &Local) -> bool {
        (0..self.levels.len()).all(|r| {
            let (left, right) = (local.out[2 * r], local.out[2 * r + 1]);
            self.levels[r] != Level::Required
                || (left - right).abs() <= self.within[r] * left.abs().max(right.abs()).max(1.0)
        })
    }
    fn hard_norm(&self, local: &Local) -> f64 {
        let mut sum = 0.0;
        for (r, level) in local.residual.iter().zip(&self.levels) {
            if *level == Level::Required {
                sum += r * r;
            }
        }
        base::number::sqrt(sum)
    }

    /// What makes each row dimensionless, taken at x0 so that it does not change during the edit.
    ///
    /// Rows of one level that speak of slots of one scale, and slope alike, weigh the same: a bar with
    /// one end anchored is stretched as unwillingly as one with both ends free.
    fn weights(
        &self,
        x0: &[f64],
        values: &[f64],
        scale: &[f64],
        registers: &mut Vec<f64>,
    ) -> Vec<f64> {
        let ones = vec![1.0; self.levels.len()];
        let Some(local) = self
            .evaluate(x0, scale, &ones, registers)
            .or_else(|| self.evaluate(values, scale, &ones, registers))
        else {
            return ones;
        };
        let own: Vec<f64> = local
            .jacobian
            .iter()
            .map(|row| {
                let size = dense::norm(row);
                if size > 0.0 { 1.0 / size } else { 1.0 }
            })
            .collect();
        let alike = |r: usize, q: usize| {
            self.levels[r] == self.levels[q]
                && self.classes[r].is_some()
                && self.classes[r] == self.classes[q]
                && own[q] * 3.0 >= own[r]
        };
        let least = |r: usize| {
            (0..own.len()).filter(|&q| alike(r, q)).fold(own[r], |least, q| least.min(own[q]))
        };
        (0..own.len())
            .map(|r| if self.levels[r] == Level::Required { own[r] } else { least(r) })
            .collect()
    }

    /// Evaluates in scaled unknowns and weighted rows; nothing where that is not finite.
    fn evaluate(
        &self,
        values: &[f64],
        scale: &[f64],
        weights: &[f64],
        registers: &mut Vec<f64>,
    ) -> Option<Local> {
        let n = self.unknowns.len();
        let rows = self.levels.len();
        let mut out = vec![0.0; self.outs];
        self.tape.run(values, registers, &mut out);
        let mut jacobian = vec![vec![0.0; n]; rows];
        for (&(r, c), &d) in self.gradient.iter().zip(&out[2 * rows..]) {
            let (r, c) = (r as usize, c as usize);
            jacobian[r][c] = d * scale[c] * weights[r];
        }
        let residual: Vec<f64> =
            (0..rows).map(|r| (out[2 * r] - out[2 * r + 1]) * weights[r]).collect();
        let finite = residual.iter().chain(jacobian.iter().flatten()).all(|v| v.is_finite());
        finite.then_some(Local { residual, jacobian, out })
    }

    /// The step that all levels together ask for.
    fn direction(&self, local: &Local, away: &[f64], weights: &[f64], scale: &[f64]) -> Vec<f64> {
        let n = self.unknowns.len();
        let of_level =
            |level: Level| (0..self.levels.len()).filter(move |&r| self.levels[r] == level);
        let mut above: Vec<usize> = of_level(Level::Required).collect();
        let hard: Vec<Vec<f64>> = above.iter().map(|&r| local.jacobian[r].clone()).collect();
        let Spaces { range, null } = dense::spaces(&hard, n);
        let mut step = least_norm(&above, local, &range, n);
        let mut free = null;
        for level in [Level::Strong, Level::Move, Level::Medium, Level::Weak] {
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
            let mut factor = self.multipliers(local, &above, &gradient);
            for &r in &own {
                factor[r] += local.residual[r];
            }
            self.add_curvature(local, &factor, weights, scale, &mut hessian);
            free = descend(&mut step, &free, &gradient, &hessian, n);
            above.extend(own);
        }
        for given in [true, false] {
            if free.is_empty() {
                break;
            }
            let mut gradient = vec![0.0; n];
            let mut hessian = vec![0.0; n * n];
            for i in (0..n).filter(|&i| self.given[i] == given) {
                gradient[i] = away[i];
                hessian[i * n + i] = 1.0;
            }
            let factor = self.multipliers(local, &above, &gradient);
            self.add_curvature(local, &factor, weights, scale, &mut hessian);
            free = descend(&mut step, &free, &gradient, &hessian, n);
        }
        step
    }

    /// Multipliers of the rows above that best balance a gradient, by row.
    fn multipliers(&self, local: &Local, above: &[usize], gradient: &[f64]) -> Vec<f64> {
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

    fn add_curvature(
        &self,
        local: &Local,
        factor: &[f64],
        weights: &[f64],
        scale: &[f64],
        hessian: &mut [f64],
    ) {
        let n = self.unknowns.len();
        let second = &local.out[2 * self.levels.len() + self.gradient.len()..];
        for (&(r, i, j), &h) in self.curvature.iter().zip(second) {
            let (r, i, j) = (r as usize, i as usize, j as usize);
            let value = factor[r] * weights[r] * h * scale[i] * scale[j];
            if value.is_finite() {
                hessian[i * n + j] += value;
                if i != j {
                    hessian[j * n + i] += value;
                }
            }
        }
    }

    /// Goes along the step, shortened until the hard rows are not torn apart.
    fn advance(
        &self,
        values: &mut [f64],
        step: &[f64],
        scale: &[f64],
        hard: f64,
        weights: &[f64],
        registers: &mut Vec<f64>,
    ) {
        let start: Vec<f64> = self.unknowns.iter().map(|&u| values[u as usize]).collect();
        let mut length = 1.0;
        loop {
            for (i, &u) in self.unknowns.iter().enumerate() {
                values[u as usize] = start[i] + length * step[i] * scale[i];
            }
            let now = self
                .evaluate(values, scale, weights, registers)
                .map_or(f64::INFINITY, |local| self.hard_norm(&local));
            if now <= 0.1f64.max(2.0 * hard) || length < 1e-6 {
                return;
            }
            length *= 0.5;
        }
    }
}

fn common_scale(
    arena: &Arena,
    row: &ProblemRow,
    kind: &dyn Fn(SlotIndex) -> (u16, bool),
) -> Option<u16> {
    let mut scales = [row.left, row.right]
        .into_iter()
        .flat_map(|side| arena.variables(side))
        .map(|v| kind(v.0).0);
    let first = scales.next()?;
    scales.all(|s| s == first).then_some(first)
}

fn non_zero_gradient(
    arena: &mut Arena,
    id: expr::ExprId,
    vars: &[Var],
    from: usize,
) -> Vec<(u32, expr::ExprId)> {
    let mentioned = arena.variables(id);
    let own: Vec<(u32, Var)> = vars
        .iter()
        .enumerate()
        .skip(from)
        .filter(|(_, v)| mentioned.contains(v))
        .map(|(i, v)| (i as u32, *v))
        .collect();
    let own_vars: Vec<Var> = own.iter().map(|o| o.1).collect();
    let gradient = expr::gradient(arena, id, &own_vars);
    own.iter()
        .zip(gradient)
        .filter(|(_, d)| arena.as_constant(*d) != Some(0.0))
        .map(|(o, d)| (o.0, d))
        .collect()
}

/// The smallest step that makes the linearised hard rows hold, or nearly so where they contradict.
fn least_norm(rows: &[usize], local: &Local, range: &[Vec<f64>], n: usize) -> Vec<f64> {
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

/// Adds the step that is best for one level in the free directions; returns those it leaves free.
fn descend(
    step: &mut [f64],
    free: &[Vec<f64>],
    gradient: &[f64],
    hessian: &[f64],
    n: usize,
) -> Vec<Vec<f64>> {
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
    for (value, v) in values.iter().zip(&vectors) {
        let mut along = vec![0.0; n];
        for (z, part) in free.iter().zip(v) {
            dense::add(&mut along, *part, z);
        }
        if value.abs() > FLAT {
            let by = -dense::dot(&along, &slope) / value.abs();
            dense::add(step, by, &along);
        } else {
            left.push(along);
        }
    }
    left
}
