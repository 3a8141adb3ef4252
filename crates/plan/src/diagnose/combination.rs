//! Combinations: why linear constraints contradict, as a sum that nobody has to believe.
//!
//! In: a set of constraints of which none can be spared. Out, where all are linear equations and inequalities:
//! how often each has to be taken so that together they say of the same thing what the last one denies.
//! Factors are ratios of small whole numbers, and the sums are tested with them, so that the proof does not
//! rest on the solver.
//!
//! **Source:** Farkas' lemma, as in Schrijver, *Theory of Linear and Integer Programming* (1986), §7.3;
//! where no row can be spared the factors are unique.

use crate::diagnose::conflict::Unit;
use crate::diagnose::trial::Setup;
use crate::planner::Planner;
use crate::rule::{Body, Formula, Rule, Source};
use crate::task::Holding;
use base::Id;
use base::number::RULE_TOLERANCE;
use expr::{Arena, ExprId, Var, gradient};
use kernel::{Primitive, SlotId, Values};
use solve::{Comparing, comparisons};
use std::collections::{BTreeMap, BTreeSet};

/// How many rows a combination may have.
const MOST: usize = 200;
/// The largest denominator of a factor.
const LARGEST: i32 = 64;
/// What of a sum counts as rounding, as a part of its terms.
const ROUNDED: f64 = 1e-12;

/// What some constraints say together, and what another says of the same.
#[derive(Clone, PartialEq, Debug)]
pub struct Combination {
    /// The constraints that are added up, and how often each.
    pub terms: Vec<(Source, f64)>,
    /// What they say.
    pub says: Said,
    /// The constraint that says otherwise.
    pub against: Source,
    /// What it says.
    pub denies: Said,
}

/// What is said of a sum.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Said {
    /// It is this number.
    Is(f64),
    /// It is this number at most.
    AtMost(f64),
    /// It is this number at least.
    AtLeast(f64),
}

/// A linear row: the sum of factors times slots is a number, or that at most.
struct Row {
    source: Source,
    terms: BTreeMap<SlotId, f64>,
    is_bound: bool,
    number: f64,
    /// How far it may be off.
    allowed: f64,
}

impl Planner {
    /// Proves that a set of constraints contradicts itself; nothing where its rows are not linear, or
    /// where more than their sum is needed.
    pub(crate) fn combination(
        &self,
        setup: &Setup<'_>,
        set: &[Unit],
        values: &Values,
    ) -> Option<Combination> {
        let mut rows = Vec::new();
        for unit in set {
            for &rule in &unit.rules {
                self.linear_rows(setup, self.rules.get(rule), values, &mut rows)?;
            }
        }
        if rows.len() > MOST {
            return None;
        }
        let factors = factors(&rows)?;
        told(&rows, &factors)
    }

    /// Adds the rows of a rule; nothing where they are not linear.
    fn linear_rows(
        &self,
        setup: &Setup<'_>,
        rule: Rule<'_>,
        values: &Values,
        rows: &mut Vec<Row>,
    ) -> Option<()> {
        let shape = rule.shape;
        let is_real =
            |s: &SlotId| matches!(setup.model.structure.slots[*s].primitive, Primitive::Real(_));
        if !shape.when.is_empty() || !rule.slots.iter().all(is_real) {
            return None;
        }
        let patterns = self.plans.patterns();
        let written = |formula: &Formula| {
            let pattern = patterns.get(formula.pattern);
            let slots: Vec<SlotId> = rule.slots_at(&formula.slots).collect();
            (pattern.arena().clone(), pattern.roots(), slots)
        };
        match &shape.body {
            Body::Equations(equations) => {
                for equation in equations {
                    let (mut arena, sides, slots) = written(equation);
                    let sides = [sides[0], sides[1]];
                    let row = linear(&mut arena, sides, &slots, rule, setup, values)?;
                    rows.push(row);
                }
            }
            Body::True(formula) => {
                let (mut arena, roots, slots) = written(formula);
                for c in comparisons(&mut arena, roots[0])? {
                    let is_bound = match c.comparing {
                        Comparing::Equal => false,
                        Comparing::AtMost | Comparing::Less => true,
                        Comparing::Differ => return None,
                    };
                    let sides = [c.left, c.right];
                    let row = linear(&mut arena, sides, &slots, rule, setup, values)?;
                    rows.push(Row { is_bound, ..row });
                }
            }
            Body::Beside(_) | Body::Different(_) | Body::Opaque(_) | Body::Hold(_) => {
                return None;
            }
        }
        Some(())
    }
}

/// Returns the equation that two sides of a rule are, if it is linear in what may move.
fn linear(
    arena: &mut Arena,
    [left, right]: [ExprId; 2],
    slots: &[SlotId],
    rule: Rule<'_>,
    setup: &Setup<'_>,
    values: &Values,
) -> Option<Row> {
    let difference = arena.sub(left, right);
    let spoken_of: Vec<Var> = arena.variables(difference).into_iter().collect();
    let is_known = |v: &Var| (setup.holding)(slots[v.index()]) == Holding::Fixed;
    let unknown: Vec<Var> = spoken_of.iter().copied().filter(|v| !is_known(v)).collect();
    let slopes = gradient(arena, difference, &unknown);
    // at zero for what may move, at its value for what is known
    let numbers: Vec<f64> = (0..slots.len())
        .map(|i| if is_known(&Var::from_index(i)) { values.numbers[slots[i]] } else { 0.0 })
        .collect();
    let mut terms = BTreeMap::new();
    for (var, slope) in unknown.iter().zip(slopes) {
        if arena.variables(slope).iter().any(|v| !is_known(v)) {
            return None;
        }
        *terms.entry(slots[var.index()]).or_insert(0.0) += arena.evaluate(slope, &numbers);
    }
    let number = 0.0 - arena.evaluate(difference, &numbers);
    let finite = number.is_finite() && terms.values().all(|t: &f64| t.is_finite());
    let size = [left, right].map(|side| arena.evaluate(side, &numbers).abs());
    let allowed = rule.shape.within.allowed(size[0], size[1]);
    finite.then_some(Row { source: rule.source, terms, is_bound: false, number, allowed })
}

/// Returns how often to take each row so that nothing that may move is left, the last one backwards once;
/// nothing where there is no such way, or several.
fn factors(rows: &[Row]) -> Option<Vec<f64>> {
    let columns: BTreeSet<SlotId> = rows.iter().flat_map(|r| r.terms.keys().copied()).collect();
    let term = |row: &Row, slot: &SlotId| row.terms.get(slot).copied().unwrap_or(0.0);
    // one equation a slot, one unknown a row
    let mut system: Vec<Vec<f64>> =
        columns.iter().map(|slot| rows.iter().map(|row| term(row, slot)).collect()).collect();
    let last = rows.len().checked_sub(1)?;
    for k in 0..last {
        let size = |i: usize| system[i][k].abs();
        let pivot = (k..system.len()).max_by(|&a, &b| size(a).total_cmp(&size(b)))?;
        if size(pivot) < 1e-9 {
            return None;
        }
        system.swap(pivot, k);
        let row = system[k].clone();
        for (_, other) in system.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = other[k] / row[k];
            other.iter_mut().zip(&row).for_each(|(x, r)| *x -= factor * r);
        }
    }
    let solved = (0..last).map(|k| small_ratio(system[k][last] / system[k][k]));
    let mut factors: Vec<f64> = solved.collect::<Option<_>>()?;
    factors.push(-1.0);
    let adds_up = |slot: &SlotId| {
        let terms = rows.iter().zip(&factors).map(|(row, f)| f * term(row, slot));
        let (sum, size) = terms.fold((0.0, 0.0), |(sum, size), t| (sum + t, size + t.abs()));
        sum.abs() <= ROUNDED * size
    };
    columns.iter().all(adds_up).then_some(factors)
}

/// Returns the ratio of small whole numbers that a number is.
fn small_ratio(x: f64) -> Option<f64> {
    let ratio = |q: i32| (x * f64::from(q)).round() / f64::from(q);
    (1..=LARGEST).map(ratio).find(|r| (r - x).abs() <= 1e-9 * x.abs().max(1.0))
}

/// Says what the rows come to, if that is a contradiction beyond all tolerance.
fn told(rows: &[Row], factors: &[f64]) -> Option<Combination> {
    let (last, others) = rows.split_last()?;
    let together = others.iter().zip(factors);
    let bounds: Vec<f64> =
        together.clone().filter(|(row, _)| row.is_bound).map(|(_, f)| *f).collect();
    let number: f64 = together.clone().map(|(row, f)| f * row.number).sum();
    let allowed: f64 = together.clone().map(|(row, f)| f.abs() * row.allowed).sum();
    let sizes: f64 = together.clone().map(|(row, f)| (f * row.number).abs()).sum();
    let slack = allowed + last.allowed + RULE_TOLERANCE * (sizes + last.number.abs());
    let says = match (bounds.iter().all(|f| *f >= 0.0), bounds.iter().all(|f| *f <= 0.0)) {
        (true, true) => Said::Is(number),
        (true, false) => Said::AtMost(number),
        (false, true) => Said::AtLeast(number),
        (false, false) => return None,
    };
    let denies = if last.is_bound { Said::AtMost(last.number) } else { Said::Is(last.number) };
    let gap = match (says, denies) {
        (Said::Is(a), Said::Is(b)) => (a - b).abs(),
        (Said::Is(a) | Said::AtLeast(a), Said::AtMost(b)) | (Said::AtLeast(a), Said::Is(b)) => {
            a - b
        }
        (Said::AtMost(a), Said::Is(b)) => b - a,
        (Said::AtMost(_), Said::AtMost(_)) | (_, Said::AtLeast(_)) => return None,
    };
    if gap <= slack {
        return None;
    }
    // what is said of a sum that begins with a minus is said the other way round
    let is_turned = last.terms.values().find(|t| **t != 0.0).is_some_and(|t| *t < 0.0);
    let turned = |said: Said| match said {
        said if !is_turned => said,
        Said::Is(x) => Said::Is(0.0 - x),
        Said::AtMost(x) => Said::AtLeast(0.0 - x),
        Said::AtLeast(x) => Said::AtMost(0.0 - x),
    };
    let mut terms: Vec<(Source, f64)> = Vec::new();
    for (row, factor) in together.filter(|(_, f)| **f != 0.0) {
        // bounds can be added up one way alone
        let factor = if row.is_bound { factor.abs() } else { *factor };
        let factor = if is_turned && !row.is_bound { 0.0 - factor } else { factor };
        terms.push((row.source, factor));
    }
    let (says, denies) = (turned(says), turned(denies));
    Some(Combination { terms, says, against: last.source, denies })
}
