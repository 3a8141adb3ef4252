//! Measure: how much, where structure leaves a choice.
//!
//! In: rows with their levels, unknowns, the state x0 that distance is measured from, a start. Out: the
//! unknowns, in place: hard rows hold; then, level by level and never at the cost of a higher one,
//! the sum of squares of the soft rows is least; then the distance of given numbers from x0, then that of
//! everything else that has a value, then that of what has none.
//!
//! Newton's method on the Lagrangian of every level, each in the directions that the levels above
//! leave free. A direction is left free where the level above has no curvature, the curvature of the
//! stronger rows included (exact second derivatives): an elbow that is stretched to its limit is
//! held there by curvature alone. Where curvature is negative the step goes downhill; where a wish is met worst, and
//! no slope says which way is down, it goes to one side: that on which the unknown that moves most grows. A large
//! block is solved by
//! sparse factors, a linear one level by level ([`levels`]), a curved one with all levels together ([`curved`]).
//!
//! **Source:** Nocedal and Wright, *Numerical Optimization*, 2nd ed., §18.1 and §3.4.

mod advance;
mod curved;
mod levels;
mod step;
mod weight;

use crate::block::{Block, Local, Workspace};
use crate::dense;
use crate::least::Least;
use crate::lower::{Definers, Problem};
use crate::square::Trust;
use crate::system::{Level, SlotIndex, Turn};
use advance::Advance;
use base::number::{ROUNDING, power_of_two};
use curved::Curved;
use levels::Levels;
use std::collections::BTreeMap;
use step::Direction;
use weight::Kinds;

/// A block of rows and unknowns of any number.
#[derive(Debug)]
pub(crate) struct Measure {
    block: Block,
    /// The unknowns of the core.
    unknowns: Vec<SlotIndex>,
    /// The levels of the core's rows.
    levels: Vec<Level>,
    /// What the error of every row of the core measures.
    measured: Vec<Kinds>,
    /// Of every kind of number, slots whose extent it has.
    kinds: BTreeMap<u16, Vec<SlotIndex>>,
    /// For every unknown of the core, when its change counts.
    turns: Vec<Turn>,
    /// True if no second derivative is there.
    pub(crate) is_linear: bool,
    /// What solves a large block.
    large: Option<Large>,
}

/// What solves a large block.
#[derive(Debug)]
enum Large {
    Linear(Levels),
    Curved(Curved),
}

/// What came of it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Measured {
    /// The hard rows hold and every level is least.
    Least,
    /// The hard rows do not hold, or the steps did not settle.
    Failed,
}

/// One evaluation of the core, in scaled unknowns and weighted rows.
struct Scaled {
    residual: Vec<f64>,
    /// The core's rows; of a large block none.
    jacobian: Vec<Vec<f64>>,
    /// Of a large block, the slopes in the order of its pattern.
    slopes: Vec<f64>,
    local: Local,
    /// Every unknown's gradient by the core.
    gradients: Vec<f64>,
}

/// How far rows are off: norms of what they lack.
#[derive(Clone, Copy, Default)]
struct Off {
    /// Of those that must hold.
    hard: f64,
    /// Of those of the highest level else.
    soft: f64,
}

impl Off {
    /// Returns true if a step from `before` may lead here.
    fn follows(self, before: Self) -> bool {
        // what is wished may get worse while what must hold gets better
        let soft = 1.01 * before.soft + before.hard;
        self.hard <= 0.1f64.max(2.0 * before.hard) && self.soft <= 0.1f64.max(soft)
    }
}

/// What the rows should come to after the first step, were they straight.
struct Begun {
    residual: Vec<f64>,
    /// How far they should go.
    way: f64,
}

/// A state at the crest of a level's errors that was left, and what they came to there.
struct Left {
    at: Vec<f64>,
    level: Level,
    errors: f64,
}

impl Begun {
    fn new(from: &Scaled, step: &[f64]) -> Self {
        let along: Vec<f64> = from.jacobian.iter().map(|row| dense::dot(row, step)).collect();
        let residual = from.residual.iter().zip(&along).map(|(r, a)| r + a).collect();
        Self { residual, way: dense::norm(&along) }
    }
    /// Returns true where the rows, after a long way, come to something else by half of the way: a hand that turns
    /// by a radian may have gone round.
    fn bends_to(&self, now: &Scaled) -> bool {
        let off: Vec<f64> = self.residual.iter().zip(&now.residual).map(|(a, b)| a - b).collect();
        let off = dense::norm(&off);
        off > BENT && off > 0.5 * self.way
    }
}

const STEPS: usize = 200;
/// What rows may be off after the first step, in parts of the extent, however they bend.
const BENT: f64 = 0.1;
/// From how many unknowns on a block's algebra is sparse.
const LARGE: usize = 120;
/// Steps below this, in parts of the extent, are no steps.
const SETTLED: f64 = 1e-12;
/// How many of those are taken all the same where a hard row does not hold yet: what is small beside its scale
/// has a steep slope.
const POLISH: usize = 8;
/// After so many steps that do not shrink a way ends next to where rows have no value any more.
const IDLE: usize = 4;
/// How far aside it goes from there, in parts of the extent.
const ASIDE: f64 = 1e-3;
/// A way of more than this, in parts of the extent, may have leapt to another branch, and how far, in parts of its
/// length, a step back from its end may come from where it began.
const LONG: f64 = 0.05;
const OFF: f64 = 0.5;
/// A state from which no step is longer than this is settled.
const STILL: f64 = 1e-9;

impl Measure {
    /// Lays a block out; `kind` tells a slot's scale, and when its change counts.
    pub(crate) fn new(problem: &Problem, kind: &dyn Fn(SlotIndex) -> (u16, Turn)) -> Self {
        // Where the rows leave a choice, distance decides, and counts every unknown.
        let has_choice = problem.rows.len() < problem.unknowns.len();
        let is_large = problem.unknowns.len() >= LARGE;
        let definers = if has_choice || is_large { Definers::None } else { Definers::Required };
        let block = Block::new(problem, definers);
        let unknowns: Vec<SlotIndex> =
            block.core.iter().map(|&u| block.unknowns[u as usize]).collect();
        let rows = || block.core_rows.iter().map(|&r| r as usize);
        let measured = |r: usize| match block.levels[r] {
            Level::Required => Kinds::new(),
            _ => weight::measured(&problem.rows[r], &|s| kind(s).0),
        };
        let mut kinds: BTreeMap<u16, Vec<SlotIndex>> = BTreeMap::new();
        for &slot in problem.rows.iter().flat_map(|row| row.arguments.iter()) {
            kinds.entry(kind(slot).0).or_default().push(slot);
        }
        kinds.values_mut().for_each(|slots| {
            slots.sort_unstable();
            slots.dedup();
        });
        Self {
            levels: rows().map(|r| block.levels[r]).collect(),
            measured: rows().map(measured).collect(),
            kinds,
            turns: unknowns.iter().map(|&s| kind(s).1).collect(),
            is_linear: block.is_linear,
            large: is_large.then(|| match block.is_linear {
                true => Large::Linear(Levels::new(&block.pattern)),
                false => Large::Curved(Curved::new(&block)),
            }),
            unknowns,
            block,
        }
    }

    /// Returns the same as a least change, where nothing in it is soft.
    pub(crate) fn least(&self) -> Option<Least> {
        let is_hard = self.block.levels.iter().all(|&level| level == Level::Required);
        let turn = |slot: SlotIndex| {
            let own = self.unknowns.iter().zip(&self.turns).find(|(u, _)| **u == slot);
            own.map_or(Turn::Open, |(_, &turn)| turn)
        };
        is_hard.then(|| Least::new(&self.block.problem(), &turn))
    }

    /// Returns every slot that solving writes.
    pub(crate) fn targets(&self) -> &[SlotIndex] {
        &self.block.unknowns
    }

    /// Returns about how many multiplications an iteration takes.
    fn cost(&self) -> usize {
        let n = self.unknowns.len();
        match self.large {
            Some(_) => 100 * self.block.pattern.len(),
            None => n * n * (10 * n + self.levels.len()),
        }
    }

    /// Solves from the values that the unknowns have now; distance is measured from `x0`. Where a branch is followed,
    /// it is so from the `last` state.
    pub(crate) fn solve(
        &self,
        x0: &[f64],
        last: Option<&[f64]>,
        values: &mut [f64],
        scales: &[f64],
        trust: Trust,
        w: &mut Workspace,
    ) -> Measured {
        let scale = self.scale(scales);
        let weights = self.weights(x0, values, scales, w);
        if let Some(Large::Curved(curved)) = &self.large {
            let (block, turns, weights, scale) = (&self.block, &self.turns, &weights, &scale);
            let asked = curved::Asked { block, turns, weights, x0, scale, trust };
            let result = curved.solve(asked, values, w);
            return match self.evaluate(values, scale, weights, w) {
                Some(local) if self.hard_rows_hold(&local, values, w) => result,
                Some(_) | None => Measured::Failed,
            };
        }
        if trust != Trust::Branch && self.evaluate(values, &scale, &weights, w).is_none() {
            self.go_inside(values, &scale, &weights, w);
        }
        let (mut smallest, mut idle) = (f64::INFINITY, 0);
        let (mut settled, mut polished) = (false, 0);
        let mut begun: Option<Begun> = None;
        let mut left: Option<Left> = None;
        let mut is_near_end = false;
        for iteration in 0..STEPS {
            w.spend(self.cost());
            if w.is_spent() {
                return Measured::Failed;
            }
            let Some(scaled) = self.evaluate(values, &scale, &weights, w) else {
                return Measured::Failed;
            };
            let away = self.away(values, x0, &scale);
            let Direction { mut step, crest } = self.direction(&scaled, &away, &weights, values, w);
            let size = step.iter().fold(0.0f64, |m, d| m.max(d.abs()));
            if !size.is_finite() {
                return Measured::Failed;
            }
            let curved = !self.is_linear;
            let leaps = leaps(iteration, size, smallest);
            let bends = iteration == 1 && begun.as_ref().is_some_and(|b| b.bends_to(&scaled));
            if trust == Trust::Branch && curved && left.is_none() && (leaps || bends) {
                return Measured::Failed;
            }
            // longer steps than half the extent are not believed
            if size > 0.5 && curved {
                for d in &mut step {
                    *d *= 0.5 / size;
                }
            }
            let off = self.off(&scaled);
            if size <= SETTLED || (idle >= 4 && smallest < 1e-7) {
                settled = true;
                let is_polished = size > SETTLED || polished == POLISH;
                if is_near_end && self.comes_to_end(values, &scale, w) {
                    return Measured::Least;
                }
                if is_polished || self.hard_rows_hold(&scaled, values, w) {
                    let Some(crest) = crest.filter(|_| left.is_none()) else { break };
                    let at = self.unknowns.iter().map(|&u| values[u as usize]).collect();
                    let errors = self.errors(&scaled, crest.level);
                    left = Some(Left { at, level: crest.level, errors });
                    for ((&u, d), s) in self.unknowns.iter().zip(&crest.along).zip(&scale) {
                        values[u as usize] += ASIDE * d * s;
                    }
                    (smallest, idle, settled, polished) = (f64::INFINITY, 0, false, 0);
                    continue;
                }
                polished += 1;
            }
            if size < 0.9 * smallest {
                (smallest, idle) = (size, 0);
            } else {
                idle += 1;
                if idle > 60 {
                    break;
                }
            }
            let advance = self.advance(values, &step, &scale, off, &weights, w);
            is_near_end = matches!(advance, Advance::NearEnd(_));
            let length = match advance {
                Advance::Part(length) => length,
                // along the end other levels do no better than they can by going on
                Advance::NearEnd(length) if idle < IDLE => length,
                Advance::NearEnd(_) | Advance::End => return Measured::Least,
            };
            if trust == Trust::Branch && curved && iteration == 0 && self.large.is_none() {
                step.iter_mut().for_each(|d| *d *= length);
                begun = Some(Begun::new(&scaled, &step));
            }
        }
        let end = self.evaluate(values, &scale, &weights, w);
        let end = end.filter(|end| settled && self.hard_rows_hold(end, values, w));
        let Some(left) = left else {
            let may_leap = trust == Trust::Branch && !self.is_linear && self.leaves_choice();
            let is_found = end.is_some()
                && last
                    .filter(|_| may_leap)
                    .is_none_or(|last| self.leads_back([x0, last], values, &scale, &weights, w));
            return if is_found { Measured::Least } else { Measured::Failed };
        };
        if end.is_none_or(|end| self.errors(&end, left.level) >= left.errors) {
            // there is nothing better beside it
            self.unknowns.iter().zip(&left.at).for_each(|(&u, x)| values[u as usize] = *x);
            self.block.compute_defined(values, w);
        }
        Measured::Least
    }

    /// Returns true if there are fewer rows than unknowns: distance decides.
    fn leaves_choice(&self) -> bool {
        self.levels.len() < self.unknowns.len()
    }

    /// Returns true if the way from the last state is a short one, or a step from its end leads about back to where it
    /// began. From another branch, to which steps have leapt, it leads elsewhere.
    fn leads_back(
        &self,
        [x0, last]: [&[f64]; 2],
        values: &[f64],
        scale: &[f64],
        weights: &[f64],
        w: &mut Workspace,
    ) -> bool {
        let from = |state: &[f64]| self.away(values, state, scale);
        let mut gone = from(last);
        let far = dense::norm(&gone);
        if far <= LONG {
            return true;
        }
        w.spend(self.cost());
        let mut back = last.to_vec();
        self.targets().iter().for_each(|&u| back[u as usize] = values[u as usize]);
        let Some(scaled) = self.evaluate(&mut back, scale, weights, w) else { return false };
        let Direction { step, .. } = self.direction(&scaled, &from(x0), weights, &back, w);
        dense::add(&mut gone, 1.0, &step);
        dense::norm(&gone) <= OFF * far
    }

    /// Returns true if the state, as it is, is what solving would leave: hard rows hold and no level
    /// can be improved noticeably.
    pub(crate) fn is_settled(
        &self,
        x0: &[f64],
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
    ) -> bool {
        if let Some(Large::Curved(_)) = self.large {
            let before: Vec<f64> = self.targets().iter().map(|&u| values[u as usize]).collect();
            let result = self.solve(x0, None, values, scales, Trust::Branch, w);
            let stays = |(&u, x): (&SlotIndex, &f64)| {
                (values[u as usize] - x).abs() <= STILL * scales[u as usize]
            };
            let is_settled =
                result == Measured::Least && self.targets().iter().zip(&before).all(stays);
            for (&u, x) in self.targets().iter().zip(before) {
                values[u as usize] = x;
            }
            return is_settled;
        }
        let scale = self.scale(scales);
        let weights = self.weights(x0, values, scales, w);
        let Some(local) = self.evaluate(values, &scale, &weights, w) else {
            return false;
        };
        let away = self.away(values, x0, &scale);
        let Direction { step, .. } = self.direction(&local, &away, &weights, values, w);
        self.hard_rows_hold(&local, values, w) && step.iter().all(|d| d.abs() <= STILL)
    }

    /// Returns how the block scales: all by one factor, with which the first unknown's scale is a power of two. Where
    /// others have the same, nothing is rounded by them, and what is elsewhere changes no bit.
    fn own(&self, scales: &[f64]) -> impl Fn(f64) -> f64 + use<> {
        let first = self.unknowns.first().map_or(1.0, |&u| scales[u as usize]);
        let power = power_of_two(first);
        move |scale| power * (scale / first)
    }
    /// Returns how far the unknowns are from where they are in another state, in parts of their scales.
    fn away(&self, values: &[f64], from: &[f64], scale: &[f64]) -> Vec<f64> {
        let parts = self.unknowns.iter().zip(scale);
        parts.map(|(&u, s)| (values[u as usize] - from[u as usize]) / s).collect()
    }
    /// Returns the scales of the unknowns.
    fn scale(&self, scales: &[f64]) -> Vec<f64> {
        let own = self.own(scales);
        self.unknowns.iter().map(|&u| own(scales[u as usize])).collect()
    }

    fn hard_rows_hold(&self, scaled: &Scaled, values: &[f64], w: &mut Workspace) -> bool {
        let hard = |&r: &usize| self.block.levels[r] == Level::Required;
        (0..self.block.height())
            .filter(hard)
            .all(|r| self.block.row_holds(&scaled.local, r, values, w))
    }
    /// Returns the sum of squares of the errors of a level.
    fn errors(&self, scaled: &Scaled, level: Level) -> f64 {
        let errors = scaled.residual.iter().zip(&self.levels).filter(|(_, own)| **own == level);
        errors.map(|(r, _)| r * r).sum()
    }
    /// Computes how far rows are off.
    fn off(&self, local: &Scaled) -> Off {
        let highest = self.levels.iter().filter(|l| **l != Level::Required).min();
        let mut off = Off::default();
        for (r, level) in local.residual.iter().zip(&self.levels) {
            if *level == Level::Required {
                off.hard += r * r;
            } else if Some(level) == highest {
                off.soft += r * r;
            }
        }
        Off { hard: base::number::sqrt(off.hard), soft: base::number::sqrt(off.soft) }
    }

    /// Returns the weight of every row, frozen when the edit begins.
    fn weights(
        &self,
        x0: &[f64],
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
    ) -> Vec<f64> {
        let scale = self.scale(scales);
        let own = self.own(scales);
        let block = &self.block;
        let ones = vec![1.0; self.levels.len()];
        let now: Vec<f64> = block.unknowns.iter().map(|&u| values[u as usize]).collect();
        for &u in &block.unknowns {
            values[u as usize] = x0[u as usize];
        }
        let at_start = self.evaluate(values, &scale, &ones, w);
        for (&u, x) in block.unknowns.iter().zip(now) {
            values[u as usize] = x;
        }
        let Some(scaled) = at_start.or_else(|| self.evaluate(values, &scale, &ones, w)) else {
            return ones;
        };
        // by the unknowns of the core what must hold, else by what a row speaks of, whatever that comes from
        let slope = |r: usize| {
            let row = block.core_rows[r] as usize;
            let size = match (&self.large, self.levels[r]) {
                (None, Level::Required) => dense::norm(&scaled.jacobian[r]),
                _ => {
                    let slope = |e: usize| {
                        let unknown = block.unknowns[block.pattern.column(e)];
                        scaled.local.jacobian[e] * own(scales[unknown as usize])
                    };
                    dense::norm(&block.pattern.range(row).map(slope).collect::<Vec<f64>>())
                }
            };
            // a slope that rounding of its sides makes is none
            let sides = [&scaled.local.left, &scaled.local.right].map(|side| side[row].abs());
            if size > ROUNDING * sides[0].max(sides[1]) { size } else { 0.0 }
        };
        let slopes: Vec<f64> = (0..self.levels.len()).map(slope).collect();
        // slots that stand for several have a smaller scale
        let extent = |kind: u16| {
            let slots = self.kinds.get(&kind).into_iter().flatten();
            let extent = slots.map(|&s| scales[s as usize]).fold(0.0, f64::max);
            if extent > 0.0 { extent } else { 1.0 }
        };
        weight::weights(&self.levels, &self.measured, &slopes, &extent)
    }

    /// Computes what is defined, then evaluates in scaled unknowns and weighted rows; nothing where
    /// that is not finite.
    fn evaluate(
        &self,
        values: &mut [f64],
        scale: &[f64],
        weights: &[f64],
        w: &mut Workspace,
    ) -> Option<Scaled> {
        let block = &self.block;
        let n = self.unknowns.len();
        block.compute_defined(values, w);
        let mut local = Local::default();
        block.slopes(values, w, &mut local);
        if self.large.is_some() {
            return self.evaluated_large(local, scale, weights);
        }
        let mut gradients = Vec::new();
        block.gradients(&local, &|i| scale[i], &mut gradients);
        let mut jacobian = vec![vec![0.0; n]; block.core_rows.len()];
        let mut residual = Vec::with_capacity(block.core_rows.len());
        for ((row, &r), weight) in jacobian.iter_mut().zip(&block.core_rows).zip(weights) {
            let r = r as usize;
            for e in block.pattern.range(r) {
                let gradient = &gradients[block.pattern.column(e) * n..][..n];
                dense::add(row, local.jacobian[e] * weight, gradient);
            }
            residual.push((local.left[r] - local.right[r]) * weight);
        }
        let finite = residual.iter().chain(jacobian.iter().flatten()).all(|v| v.is_finite());
        finite.then_some(Scaled { residual, jacobian, slopes: Vec::new(), local, gradients })
    }

    /// A large block defines nothing: its rows and unknowns are the core.
    fn evaluated_large(&self, local: Local, scale: &[f64], weights: &[f64]) -> Option<Scaled> {
        let pattern = &self.block.pattern;
        let mut slopes = Vec::with_capacity(pattern.len());
        for (r, weight) in weights.iter().enumerate() {
            let slope = |e: usize| local.jacobian[e] * weight * scale[pattern.column(e)];
            slopes.extend(pattern.range(r).map(slope));
        }
        let sides = local.left.iter().zip(&local.right).zip(weights);
        let residual: Vec<f64> = sides.map(|((left, right), w)| (left - right) * w).collect();
        let finite = residual.iter().chain(&slopes).all(|v| v.is_finite());
        let (jacobian, gradients) = (Vec::new(), Vec::new());
        finite.then_some(Scaled { residual, jacobian, slopes, local, gradients })
    }
}

/// Returns true if a step, so long after ones of which the smallest is so long, leads off its branch.
fn leaps(iteration: usize, size: f64, smallest: f64) -> bool {
    match iteration {
        0 => size > 0.5,
        1 => size > 1e-3f64.max(0.5 * smallest),
        _ => false,
    }
}
