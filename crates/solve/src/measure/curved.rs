//! Levels of a large curved block: Newton's steps on the Lagrangian, by sparse factors.
//!
//! In: rows with their levels and weights, a start, the state x0. Out: the unknowns, in place. Required rows
//! hold; of the others each level counts for a small part of the one above, the distance of given numbers
//! for as small a part of the last level, and that of everything else for as small a part again, those with a
//! value first. The part
//! comes down in stages, each of which begins where the one before ended, so that far from a wish
//! distance still tells which way. One matrix `[H Jᵀ; J -E]` of unknowns and rows, with exact second
//! derivatives; where it has other than one negative pivot a row, the diagonal of `H` grows. `E` is what a soft row
//! gives way by, and for a required one the small number of the proximal method of multipliers.
//!
//! **Source:** Nocedal and Wright, *Numerical Optimization*, 2nd ed., §17.1 and §18.1; Friedlander and
//! Orban, *A primal-dual regularized interior-point method*, Math. Prog. Comp. 4 (2012).

use super::Measured;
use crate::block::{Block, Local, Workspace};
use crate::dense;
use crate::sparse::{Ldl, Symmetric};
use crate::square::Trust;
use crate::system::{Level, Turn};

/// The part that a level counts for of the one above, stage after stage, as a power of the last.
const STAGES: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
/// The least part, and what all parts together come to at least.
const PART: f64 = 1e-8;
const ALL_PARTS: f64 = 1e-12;
/// What stands on the diagonal of a required row.
const DELTA: f64 = 1e-8;
/// How many steps a stage takes at most.
const STEPS: usize = 60;
/// Steps below this, in parts of the extent, are none; in the stages before the last, below the second.
const SETTLED: f64 = 1e-11;
const NEAR: f64 = 1e-4;
/// Where steps no longer shrink, those below this are none.
const STALLED: f64 = 1e-7;
/// The longest diagonal that is tried.
const FIRMEST: f64 = 1e8;

/// The order in which unknowns and rows are eliminated.
#[derive(Debug)]
pub(crate) struct Curved {
    symmetric: Symmetric,
}

/// What is to be solved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked<'a> {
    pub(crate) block: &'a Block,
    /// For every unknown, when its change counts.
    pub(crate) turns: &'a [Turn],
    /// What makes each row dimensionless.
    pub(crate) weights: &'a [f64],
    /// The state that distance is measured from.
    pub(crate) x0: &'a [f64],
    /// By unknown.
    pub(crate) scale: &'a [f64],
    pub(crate) trust: Trust,
}

/// What rows and distances count for in a stage.
struct Counts {
    /// For every row, by how much it gives way under a multiplier of one: nothing for a required one.
    gives: Vec<f64>,
    /// For every unknown, what its distance counts for.
    distance: Vec<f64>,
}

/// A state of the iteration.
#[derive(Default)]
struct Scratch {
    local: Local,
    multipliers: Vec<f64>,
    entries: Vec<f64>,
    right: Vec<f64>,
    ldl: Ldl,
    /// By how much the diagonal grew last.
    shift: f64,
}

impl Curved {
    pub(crate) fn new(block: &Block) -> Self {
        let curved = block.seconds().iter().map(|place| (place.i, place.j));
        let size = block.unknowns.len() + block.height();
        Self { symmetric: Symmetric::new(size, &block.pattern.bordered(curved)) }
    }

    /// Solves from the values that the unknowns have now; whether required rows then hold is not tested.
    pub(crate) fn solve(
        &self,
        asked: Asked<'_>,
        values: &mut [f64],
        w: &mut Workspace,
    ) -> Measured {
        let mut s = Scratch::default();
        s.multipliers.resize(asked.block.height(), 0.0);
        asked.block.slopes(values, w, &mut s.local);
        for stage in STAGES {
            let counts = asked.counts(stage);
            let enough = if stage < 1.0 { NEAR } else { SETTLED };
            let (mut smallest, mut idle) = (f64::INFINITY, 0);
            let mut is_settled = false;
            for iteration in 0..STEPS {
                let is_first = stage == STAGES[0] && iteration == 0;
                if w.is_spent() || !self.step(&asked, &counts, is_first, values, w, &mut s) {
                    return Measured::Failed;
                }
                let step = &s.right[..asked.scale.len()];
                let size = step.iter().fold(0.0f64, |m, d| m.max(d.abs()));
                if !size.is_finite() || is_first && asked.trust == Trust::Branch && size > 0.5 {
                    return Measured::Failed;
                }
                asked.advance(size, &counts, values, w, &mut s);
                if size < 0.9 * smallest {
                    (smallest, idle) = (size, 0);
                } else {
                    idle += 1;
                }
                is_settled = size <= enough || idle >= 4 && smallest < STALLED;
                if is_settled {
                    break;
                }
            }
            if !is_settled && stage == 1.0 {
                return Measured::Failed;
            }
        }
        Measured::Least
    }

    /// Finds the step, and that of the multipliers; returns false where the matrix cannot be factorised.
    fn step(
        &self,
        asked: &Asked<'_>,
        counts: &Counts,
        is_flat: bool,
        values: &[f64],
        w: &mut Workspace,
        s: &mut Scratch,
    ) -> bool {
        let Asked { block, weights, scale, .. } = *asked;
        let (n, m) = (block.unknowns.len(), block.height());
        s.entries.clear();
        s.entries.extend_from_slice(&counts.distance);
        s.entries.extend(counts.gives.iter().map(|give| -give.max(DELTA)));
        let slopes = s.entries.len();
        for (r, weight) in weights.iter().enumerate() {
            let slope = |e: usize| s.local.jacobian[e] * weight * scale[block.pattern.column(e)];
            s.entries.extend(block.pattern.range(r).map(slope));
        }
        s.right.clear();
        let away = block.unknowns.iter().zip(scale).zip(&counts.distance);
        s.right.extend(
            away.map(|((&u, scale), part)| {
                part * (asked.x0[u as usize] - values[u as usize]) / scale
            }),
        );
        let slopes = &s.entries[slopes..];
        for (r, multiplier) in s.multipliers.iter().enumerate() {
            for e in block.pattern.range(r) {
                s.right[block.pattern.column(e)] -= slopes[e] * multiplier;
            }
        }
        let rows = s.local.left.iter().zip(&s.local.right).zip(weights);
        let rows = rows.zip(counts.gives.iter().zip(&s.multipliers));
        s.right.extend(rows.map(|(((left, right), weight), (give, multiplier))| {
            give * multiplier - (left - right) * weight
        }));
        if is_flat {
            s.entries.resize(s.entries.len() + block.seconds().len(), 0.0);
        } else {
            let Scratch { entries, multipliers, .. } = &mut *s;
            block.each_second(values, w, &mut |row, places, out| {
                let factor = multipliers[row] * weights[row];
                entries.extend(places.iter().map(|place| {
                    let value =
                        factor * place.of(out) * scale[place.i as usize] * scale[place.j as usize];
                    if value.is_finite() { value } else { 0.0 }
                }));
            });
        }
        let mut shift = s.shift * 0.1;
        while self.symmetric.factorise(&s.entries, &mut s.ldl) != Some(m) {
            shift = (shift * 10.0).max(counts.distance.iter().fold(1.0, |m, d| d.min(m)));
            if shift > FIRMEST {
                return false;
            }
            for (entry, part) in s.entries[..n].iter_mut().zip(&counts.distance) {
                *entry = part + shift;
            }
        }
        s.shift = shift;
        self.symmetric.solve(&mut s.ldl, &mut s.right);
        true
    }
}

impl Asked<'_> {
    fn counts(&self, stage: f64) -> Counts {
        let levels = &self.block.levels;
        let soft: Vec<Level> =
            Level::SOFT.into_iter().filter(|level| levels.contains(level)).collect();
        let turns: Vec<Turn> =
            Turn::ALL.into_iter().filter(|turn| self.turns.contains(turn)).collect();
        let depth = (soft.len() + turns.len().saturating_sub(1)) as f64;
        let least = PART.max(base::number::pow(ALL_PARTS, 1.0 / depth.max(1.0)));
        let part = base::number::pow(least, stage);
        let power = |k: usize| (0..k).map(|_| part).product::<f64>();
        let give = |level: &Level| soft.iter().position(|l| l == level).map(|k| 1.0 / power(k));
        let place = |own: &Turn| turns.iter().position(|turn| turn == own).unwrap_or(0);
        let distance = |own: &Turn| power(soft.len() + place(own));
        Counts {
            gives: levels.iter().map(|level| give(level).unwrap_or(0.0)).collect(),
            distance: self.turns.iter().map(distance).collect(),
        }
    }

    /// Goes along the step, shortened until the required rows are not torn apart.
    fn advance(
        &self,
        size: f64,
        counts: &Counts,
        values: &mut [f64],
        w: &mut Workspace,
        s: &mut Scratch,
    ) {
        let before = self.hard_norm(counts, &s.local);
        let start: Vec<f64> = self.block.unknowns.iter().map(|&u| values[u as usize]).collect();
        // longer steps than half the extent are not believed
        let mut length = if size > 0.5 { 0.5 / size } else { 1.0 };
        loop {
            for (i, &u) in self.block.unknowns.iter().enumerate() {
                values[u as usize] = start[i] + length * s.right[i] * self.scale[i];
            }
            self.block.slopes(values, w, &mut s.local);
            if self.hard_norm(counts, &s.local) <= 0.1f64.max(2.0 * before) || length < 1e-6 {
                break;
            }
            length *= 0.5;
        }
        let changes = &s.right[self.block.unknowns.len()..];
        for (multiplier, change) in s.multipliers.iter_mut().zip(changes) {
            *multiplier += length * change;
        }
    }

    fn hard_norm(&self, counts: &Counts, local: &Local) -> f64 {
        let sides = local.left.iter().zip(&local.right).zip(self.weights).zip(&counts.gives);
        let hard = sides.filter(|(_, give)| **give == 0.0);
        let errors: Vec<f64> = hard.map(|(((l, r), weight), _)| (l - r) * weight).collect();
        dense::norm(&errors)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Measure;
    use super::*;
    use crate::kernel::Kernel;
    use crate::lower::{Problem, ProblemRow};
    use base::number::Tolerance;
    use expr::{Arena, Var};
    use std::rc::Rc;

    /// A chain of bars of 10 from the origin, up and down in turn, and a wish for its end; returns where
    /// its joints are then, beginning with the first after the origin.
    fn pulled(bars: u32, wish: [f64; 2]) -> Vec<[f64; 2]> {
        let mut arena = Arena::new();
        let mut rows = Vec::new();
        let mut add = |arena: &Arena, level, left, right| {
            let (kernel, arguments) = Kernel::of_slots(arena, left, right);
            let (kernel, arguments) = (Rc::new(kernel), arguments.into());
            rows.push(ProblemRow { kernel, arguments, level, within: Tolerance::Relative });
        };
        let ten = arena.constant(10.0);
        for k in 0..bars {
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| arena.var(Var(2 * k + i)));
            let (x, y) = (arena.sub(c, a), arena.sub(d, b));
            let (x, y) = (arena.square(x), arena.square(y));
            let sum = arena.add(x, y);
            let distance = arena.sqrt(sum);
            add(&arena, Level::Required, distance, ten);
        }
        for (i, at) in (0..).zip(wish) {
            let (end, at) = (arena.var(Var(2 * bars + i)), arena.constant(at));
            add(&arena, Level::Move, end, at);
        }
        let place = |k: u32| [6.0 * f64::from(k), 8.0 * f64::from(k % 2)];
        let x0: Vec<f64> = (0..=bars).flat_map(place).collect();
        let problem = Problem { rows, unknowns: (2..2 * bars + 2).collect() };
        let measure = Measure::new(&problem, &|_| (0, Turn::Valued));
        assert!(measure.large.is_some());
        let (mut values, scales) = (x0.clone(), vec![6.0 * f64::from(bars); x0.len()]);
        let result =
            measure.solve(&x0, None, &mut values, &scales, Trust::Any, &mut Workspace::default());
        assert_eq!(result, Measured::Least, "{bars} bars");
        values.chunks_exact(2).skip(1).map(|at| [at[0], at[1]]).collect()
    }

    #[test]
    fn a_chain_points_at_a_wish_beyond_its_reach() {
        for (k, [x, y]) in (1..).zip(pulled(100, [960.0, 720.0])) {
            let [far, high] = [8.0, 6.0].map(|along| along * f64::from(k));
            let off = (x - far).abs().max((y - high).abs());
            assert!(off < 1e-2, "joint {k}: {x}, {y}");
        }
    }

    #[test]
    fn a_wish_within_reach_is_met() {
        let joints = pulled(100, [560.0, 130.0]);
        let [x, y] = joints[99];
        assert!((x - 560.0).abs().max((y - 130.0).abs()) < 1e-4, "{x}, {y}");
    }
}
