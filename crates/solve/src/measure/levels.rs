//! Levels of a large block: the step that they ask for, by sparse factors.
//!
//! In: rows with their residuals, slopes and levels, and how far the unknowns are from where they were. Out: the
//! step that makes the required rows hold, then level by level leaves the least sum of squares, then the
//! least distance. Each level is a problem of least squares under the rows above it, which keep what they
//! came to: one matrix `[0 Jᵀ; J -1 or 0]` of unknowns and rows. It is factorised with small diagonals,
//! `ε` for what no row moves and `-δ` for rows that depend on others, and what these do to the solution is
//! refined away (the proximal method of multipliers).
//!
//! **Source:** Friedlander and Orban, *A primal-dual regularized interior-point method*, Math. Prog. Comp. 4
//! (2012); Siciliano and Slotine, *A general framework for managing multiple tasks*, ICAR (1991).

use crate::sparse::{Ldl, Pattern, Symmetric};
use crate::system::{Level, Turn};
use std::cmp::Ordering;

/// What stands on the diagonal of an unknown that the level at hand does not move.
const EPSILON: f64 = 1e-7;
/// What stands on the diagonal of a row that has to hold.
const DELTA: f64 = 1e-7;
/// How often a solution is refined.
const REFINEMENTS: usize = 60;

/// The order in which unknowns and rows are eliminated.
#[derive(Debug)]
pub(crate) struct Levels {
    symmetric: Symmetric,
}

/// What a step is asked for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked<'a> {
    /// Where rows depend on unknowns.
    pub(crate) pattern: &'a Pattern,
    /// The slopes, in the order of the pattern.
    pub(crate) slopes: &'a [f64],
    /// For every row, by how much it does not hold.
    pub(crate) residual: &'a [f64],
    /// For every row, how strongly it wants to.
    pub(crate) levels: &'a [Level],
    /// For every unknown, when its change counts.
    pub(crate) turns: &'a [Turn],
    /// For every unknown, how far it is from where it was.
    pub(crate) away: &'a [f64],
}

/// What becomes of a row while one level is decided.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Part {
    /// It is to change by this.
    Changes(f64),
    /// It is to come as near to changing by this as others allow.
    Tends(f64),
    /// It is not asked.
    None,
}

impl Levels {
    pub(crate) fn new(pattern: &Pattern) -> Self {
        let size = pattern.width + pattern.height();
        Self { symmetric: Symmetric::new(size, &pattern.bordered(std::iter::empty())) }
    }

    /// Returns the step that all levels together ask for; what cannot be factorised is no number.
    pub(crate) fn step(&self, asked: Asked<'_>) -> Vec<f64> {
        let n = asked.pattern.width;
        let mut parts = vec![Part::None; asked.levels.len()];
        for (part, (level, residual)) in
            parts.iter_mut().zip(asked.levels.iter().zip(asked.residual))
        {
            if *level == Level::Required {
                *part = Part::Changes(-residual);
            }
        }
        let mut step = vec![0.0; n];
        for level in Level::SOFT {
            let own = || (0..asked.levels.len()).filter(|&r| asked.levels[r] == level);
            if own().next().is_none() {
                continue;
            }
            own().for_each(|r| parts[r] = Part::Tends(-asked.residual[r]));
            step = self.solve(asked, &parts, &vec![0.0; n], &step);
            for r in own() {
                parts[r] = Part::Changes(along(asked, r, &step));
            }
        }
        let back: Vec<f64> = asked.away.iter().map(|away| -away).collect();
        let mut near = back;
        for turn in Turn::ALL.into_iter().filter(|turn| asked.turns.contains(turn)) {
            // those before are held where they came to, those after go along
            let weight = |own: &Turn| match own.cmp(&turn) {
                Ordering::Less => 1.0 / EPSILON,
                Ordering::Equal => 1.0,
                Ordering::Greater => 0.0,
            };
            let weights: Vec<f64> = asked.turns.iter().map(weight).collect();
            step = self.solve(asked, &parts, &weights, &near);
            let own = asked.turns.iter().zip(near.iter_mut().zip(&step));
            own.filter(|(own, _)| **own == turn).for_each(|(_, (near, came))| *near = *came);
        }
        step
    }

    /// Finds the step of least squares for the rows that tend and for unknowns that are to go so far, each
    /// by its weight; where nothing decides it is what it is near.
    fn solve(&self, asked: Asked<'_>, parts: &[Part], weights: &[f64], near: &[f64]) -> Vec<f64> {
        let Asked { pattern, slopes, .. } = asked;
        let n = pattern.width;
        let mut matrix: Vec<f64> = weights.iter().map(|w| w.max(EPSILON)).collect();
        matrix.extend(parts.iter().map(|part| match part {
            Part::Changes(_) => -DELTA,
            Part::Tends(_) | Part::None => -1.0,
        }));
        for (r, part) in parts.iter().enumerate() {
            let is_asked = *part != Part::None;
            matrix.extend(slopes[pattern.range(r)].iter().map(|s| if is_asked { *s } else { 0.0 }));
        }
        let mut ldl = Ldl::default();
        if self.symmetric.factorise(&matrix, &mut ldl).is_none() {
            return vec![f64::NAN; n];
        }
        // unknowns, then the factors of rows
        let mut found = near.to_vec();
        found.resize(n + parts.len(), 0.0);
        let mut last = f64::INFINITY;
        for _ in 0..REFINEMENTS {
            let mut right: Vec<f64> = (0..n).map(|i| weights[i] * (near[i] - found[i])).collect();
            for (r, part) in parts.iter().enumerate() {
                let factor = found[n + r];
                right.push(match part {
                    Part::Changes(by) => by - along(asked, r, &found),
                    Part::Tends(by) => by + factor - along(asked, r, &found),
                    Part::None => 0.0,
                });
                if *part != Part::None {
                    for e in pattern.range(r) {
                        right[pattern.column(e)] -= slopes[e] * factor;
                    }
                }
            }
            self.symmetric.solve(&mut ldl, &mut right);
            let size = right[..n].iter().fold(0.0f64, |most, d| most.max(d.abs()));
            if !size.is_finite() || size >= 2.0 * last {
                break;
            }
            found.iter_mut().zip(&right).for_each(|(x, d)| *x += d);
            let extent = found[..n].iter().fold(1.0f64, |most, x| most.max(x.abs()));
            if size <= f64::EPSILON * extent {
                break;
            }
            last = size;
        }
        found.truncate(n);
        found
    }
}

/// Returns by how much a row changes along a step.
fn along(asked: Asked<'_>, row: usize, step: &[f64]) -> f64 {
    let entries = asked.pattern.range(row);
    entries.map(|e| asked.slopes[e] * step[asked.pattern.column(e)]).sum()
}
