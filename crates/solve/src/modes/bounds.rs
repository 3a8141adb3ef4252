//! The bounds of conditions: what is assumed of numbers is an inequality, and may act at its bound.
//!
//! `if p > 0 { q = p } else { q = 0 }` asks for `p > 0` and `q = p`, or for `p <= 0` and `q = 0`: in either mode
//! the answer may lie at `p = 0`. A condition is compared exactly, as whoever reads it does: one that holds at its
//! bound acts a little short of it where rounding misses it.

use super::{Formula, Making, Mode, Modes, Tree};
use crate::system::{Equation, Level, Relation, RelationBody, Span, System, TRUTH};
use crate::truth::{Comparing, truth};
use base::number::Tolerance;
use expr::Arena;

impl Making<'_> {
    /// Makes what a condition says where it is false and where it is true; nothing where numbers are in it that
    /// are whole, truth values, or texts. Returns nothing at all where a pattern is to be found that is not there.
    pub(super) fn bounds(
        &mut self,
        system: &System,
        relation: u32,
        condition: &Formula,
    ) -> Option<Option<[Tree; 2]>> {
        let slots = || condition.arguments.iter().map(|&s| &system.slots[s as usize]);
        if !slots().all(|s| s.is_number && !s.is_discrete && s.scale != TRUTH) {
            return Some(None);
        }
        let mut arena = Arena::new();
        let root = condition.pattern.write_out(&mut arena, &condition.arguments)[0];
        let mut tree = |wanted| {
            let truth = truth(&mut arena, root, wanted);
            self.tree(&mut arena, relation, Tolerance::within(0.0), truth)
        };
        Some(Some([tree(false)?, tree(true)?]))
    }
}

impl Modes {
    /// Adds the bounds of conditions that act in a mode: where one does, every condition is a relation of its own,
    /// after all others.
    pub(super) fn add_bounds(&self, mode: &Mode, system: &mut System) {
        let acting = |(bounds, &truth): (&Option<[Tree; 2]>, &bool)| {
            let mut acting = Vec::new();
            let tree = bounds.as_ref().map(|b| &b[usize::from(truth)]);
            tree.into_iter().for_each(|tree| self.acting(tree, mode, &mut acting));
            acting.retain(|c| mode.active.contains(c));
            acting
        };
        let acting: Vec<Vec<u32>> = self.bounds.iter().zip(&mode.assumed).map(acting).collect();
        if acting.iter().all(Vec::is_empty) {
            return;
        }
        for (condition, acting) in (0..).zip(acting) {
            let mut guards = self.conditional.guards.iter().filter(|g| g.condition == condition);
            let guarded = guards.next().map_or(0, |g| g.relation as usize);
            let start = system.equations.len() as u32;
            for c in &acting {
                let sides = &self.comparisons[*c as usize];
                let arguments = system.add_arguments(sides.arguments.iter().copied());
                system.equations.push(Equation { pattern: sides.bound, arguments });
            }
            system.relations.push(Relation {
                level: Level::Required,
                body: RelationBody::Equations(Span { start, len: acting.len() as u32 }),
                methods: Default::default(),
                derived: true,
                reads: Default::default(),
                within: Tolerance::Relative,
                source: system.relations[guarded].source,
                rests: false,
            });
        }
    }

    /// Returns the first comparison to act so that conditions are as assumed; nothing where they are, or where
    /// none can.
    pub(super) fn bound_to_act(&self, mode: &Mode, values: &[f64]) -> Option<u32> {
        let is_wrong = |&c: &usize| self.is_true(c, values) != mode.assumed[c];
        (0..mode.assumed.len()).filter(is_wrong).find_map(|c| {
            let tree = &self.bounds[c].as_ref()?[usize::from(mode.assumed[c])];
            self.to_act(tree, mode, values)
        })
    }

    fn to_act(&self, tree: &Tree, mode: &Mode, values: &[f64]) -> Option<u32> {
        match tree {
            Tree::Holds(c) => {
                let sides = &self.comparisons[*c as usize];
                let can_act = matches!(sides.comparing, Comparing::AtMost | Comparing::Less);
                if !can_act || self.comparison_holds(*c, values) {
                    return None;
                }
                let mut stronger = [Some(*c), sides.short].into_iter().flatten();
                stronger.find(|c| !mode.active.contains(c))
            }
            Tree::All(parts) => parts.iter().find_map(|p| self.to_act(p, mode, values)),
            Tree::Either(_) if self.tree_holds(tree, values) => None,
            Tree::Either(parts) => {
                let miss = |part: &&Tree| self.miss(part, values);
                let nearest = parts.iter().min_by(|a, b| miss(a).total_cmp(&miss(b)));
                nearest.and_then(|part| self.to_act(part, mode, values))
            }
            Tree::Any { .. } => None,
        }
    }

    /// Returns how far the sides of comparisons lie apart that would have to hold.
    fn miss(&self, tree: &Tree, values: &[f64]) -> f64 {
        match tree {
            Tree::Holds(c) if self.comparison_holds(*c, values) => 0.0,
            Tree::Holds(c) => {
                let mut scratch = self.scratch.borrow_mut();
                let both = self.comparisons[*c as usize].sides.evaluate(values, &mut scratch);
                (both[0] - both[1]).abs()
            }
            Tree::All(parts) => parts.iter().map(|p| self.miss(p, values)).fold(0.0, f64::max),
            Tree::Any { ways: parts, .. } | Tree::Either(parts) => {
                parts.iter().map(|p| self.miss(p, values)).fold(f64::INFINITY, f64::min)
            }
        }
    }
}
