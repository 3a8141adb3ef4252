//! The first mode: conditions as the values have them, of every choice the alternative that holds, else the nearest.
//!
//! In: the state when an edit began, and the values now. Out: the mode to begin with.

use super::{Formula, Mode, Modes, Sides, Tree};
use crate::moved::{self, Extents, Moved};
use crate::system::{Stay, TRUTH};
use crate::truth::Comparing;
use crate::whole::Constants;
use base::Id;
use expr::{Var, gradient};
use std::collections::BTreeSet;

impl Modes {
    /// Returns the mode to begin with: conditions as they are in `values`, alternatives as they were
    /// in `start`, no inequality acting.
    pub fn first(&self, start: &[f64], values: &[f64]) -> Mode {
        let assumed = (0..self.conditions.len()).map(|c| self.is_true(c, values)).collect();
        let mut taken = vec![0; self.choices.len()];
        for want in &self.wants {
            self.take(&want.tree, start, &mut taken);
        }
        Mode { assumed, taken, active: BTreeSet::new(), constants: Constants::None }
    }

    /// Takes the first alternative of every choice that holds, where none does the nearest.
    fn take(&self, tree: &Tree, values: &[f64], taken: &mut [u32]) {
        match tree {
            Tree::Holds(_) | Tree::Either(_) => {}
            Tree::All(parts) => parts.iter().for_each(|p| self.take(p, values, taken)),
            Tree::Any { choice, ways } => {
                let holds = ways.iter().position(|w| self.tree_holds(w, values));
                taken[*choice as usize] =
                    holds.unwrap_or_else(|| self.nearest_way(ways, values)) as u32;
                ways.iter().for_each(|w| self.take(w, values, taken));
            }
        }
    }

    /// Returns the way that is nearest to hold, of equals the first.
    fn nearest_way(&self, ways: &[Tree], values: &[f64]) -> usize {
        let extents = &Extents::of(&self.conditional.system.slots, values);
        let mut nearest = (0, [f64::INFINITY; 3]);
        for (i, away) in ways.iter().map(|way| self.away(way, values, extents)).enumerate() {
            if away < nearest.1 {
                nearest = (i, away);
            }
        }
        nearest.0
    }

    /// Returns how far given numbers have to go until it holds, and how far others that have a value, squared, in parts
    /// of their extents and to first order: given numbers go where nothing else does, what has no value goes anywhere,
    /// and what is true or not goes no way.
    fn away(&self, tree: &Tree, values: &[f64], extents: &Extents) -> Moved {
        match tree {
            Tree::Holds(c) => self.comparison_away(*c, values, extents),
            Tree::All(parts) => {
                let parts = parts.iter().map(|part| self.away(part, values, extents));
                parts.fold([0.0; 3], |[a, b, c], [d, e, f]| [a + d, b + e, c + f])
            }
            Tree::Any { ways, .. } | Tree::Either(ways) => {
                let ways = ways.iter().map(|way| self.away(way, values, extents));
                ways.fold([f64::INFINITY; 3], |a, b| if b < a { b } else { a })
            }
        }
    }

    fn comparison_away(&self, index: u32, values: &[f64], extents: &Extents) -> Moved {
        let Sides { comparing, sides: Formula { pattern, arguments }, .. } =
            &self.comparisons[index as usize];
        if self.comparison_holds(index, values) {
            return [0.0; 3];
        }
        let mut arena = pattern.arena().clone();
        let difference = arena.sub(pattern.roots()[0], pattern.roots()[1]);
        let vars: Vec<Var> = arena.variables(difference).into_iter().collect();
        let slopes = gradient(&mut arena, difference, &vars);
        let now: Vec<f64> = arguments.iter().map(|&s| values[s as usize]).collect();
        let (mut valued, mut free): (Moved, f64) = ([0.0; 3], 0.0);
        for (var, slope) in vars.iter().zip(slopes) {
            let slot = &self.conditional.system.slots[arguments[var.index()] as usize];
            let slope = arena.evaluate(slope, &now) * extents.at(slot);
            match slot.stay {
                Stay::Fixed => {}
                _ if slot.scale == TRUTH => free += slope * slope,
                Stay::Free => free += slope * slope,
                stay @ (Stay::Given(_) | Stay::Kept { .. }) => {
                    valued[moved::rank(stay)] += slope * slope;
                }
            }
        }
        let gap = arena.evaluate(difference, &now);
        let gap = gap * gap;
        let can_hold = *comparing != Comparing::Differ && gap.is_finite();
        if can_hold && free > 0.0 {
            return [0.0; 3];
        }
        // what holds least goes
        match valued.iter().rposition(|&own| own > 0.0).filter(|_| can_hold) {
            Some(rank) => {
                let mut away = [0.0; 3];
                away[rank] = gap / valued[rank];
                away
            }
            None => [f64::INFINITY; 3],
        }
    }
}
