//! Where a state stands to a mode: which inequalities are at their bound, which it breaks, which were passed on the way
//! to it.

use super::{Mode, Modes, Sides, Tree};
use crate::truth::Comparing;
use base::number::RULE_TOLERANCE;

impl Modes {
    /// Returns a mode in which those inequalities act, and no others, that are at their bound in
    /// `values`.
    pub fn at_bounds(&self, mode: &Mode, values: &[f64]) -> Mode {
        let relations = self.conditional.system.relations.len() as u32;
        let is_at_bound = |sides: &Sides| {
            let mut scratch = self.scratch.borrow_mut();
            let both = sides.sides.evaluate(values, &mut scratch);
            let bounded = matches!(sides.comparing, Comparing::AtMost | Comparing::Less)
                && sides.relation < relations;
            // a strict one stops twice its tolerance short
            let size = both[0].abs().max(both[1].abs()).max(1.0);
            bounded && (both[0] - both[1]).abs() <= 4.0 * RULE_TOLERANCE * size
        };
        let all = (0..).zip(&self.comparisons);
        let active = all.filter(|(_, sides)| is_at_bound(sides)).map(|(index, _)| index).collect();
        Mode { active, ..mode.clone() }
    }

    /// Returns the index of every relation that a demand is of, with whether it holds.
    pub fn broken(&self, mode: &Mode, values: &[f64]) -> Vec<u32> {
        let broken = self.wants_in(mode).filter(|w| !self.tree_holds(&w.tree, values));
        broken.map(|w| w.relation).collect()
    }

    /// Returns the mode in which inequalities act as well that a state breaks, of every demand the first; nothing where
    /// none can.
    pub fn with_broken(&self, mode: &Mode, values: &[f64]) -> Option<Mode> {
        let broken = self.wants_in(mode).filter(|w| !self.tree_holds(&w.tree, values));
        let mut with = mode.clone();
        with.active.extend(broken.filter_map(|w| self.breaks_in(&w.tree, mode, values)));
        (with != *mode).then_some(with)
    }

    /// Returns the first inequality that does not act and does not hold, among those taken.
    pub(super) fn breaks_in(&self, tree: &Tree, mode: &Mode, values: &[f64]) -> Option<u32> {
        match tree {
            Tree::Holds(c) => {
                let can_act = match self.comparisons[*c as usize].comparing {
                    Comparing::AtMost | Comparing::Less => !mode.active.contains(c),
                    Comparing::Equal | Comparing::Differ => false,
                };
                (can_act && !self.comparison_holds(*c, values)).then_some(*c)
            }
            Tree::All(parts) => parts.iter().find_map(|p| self.breaks_in(p, mode, values)),
            Tree::Any { choice, ways } => {
                let way = ways.get(mode.taken[*choice as usize] as usize)?;
                self.breaks_in(way, mode, values)
            }
            Tree::Either(_) => None,
        }
    }

    /// Returns true if a condition is not as a mode assumes it.
    pub fn contradicts(&self, mode: &Mode, values: &[f64]) -> bool {
        mode.assumed.iter().enumerate().any(|(c, &truth)| self.is_true(c, values) != truth)
    }

    /// Returns true if an inequality that a mode takes and that does not act in it is passed between two states: it
    /// is broken in the second, however little, and less or not at all in the first.
    pub fn passes(&self, mode: &Mode, from: &[f64], to: &[f64]) -> bool {
        self.wants_in(mode).any(|want| self.tree_passes(&want.tree, mode, from, to))
    }

    fn tree_passes(&self, tree: &Tree, mode: &Mode, from: &[f64], to: &[f64]) -> bool {
        match tree {
            Tree::Holds(c) => {
                let sides = &self.comparisons[*c as usize];
                let may_act = matches!(sides.comparing, Comparing::AtMost | Comparing::Less);
                let excess = |values| sides.excess(values, &mut self.scratch.borrow_mut());
                may_act && !mode.active.contains(c) && excess(to) > excess(from).max(0.0)
            }
            Tree::All(parts) => parts.iter().any(|p| self.tree_passes(p, mode, from, to)),
            Tree::Any { choice, ways } => {
                let way = ways.get(mode.taken[*choice as usize] as usize);
                way.is_some_and(|way| self.tree_passes(way, mode, from, to))
            }
            Tree::Either(_) => false,
        }
    }
}
