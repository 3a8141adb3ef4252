//! Proofs: by which equations substitution made slots equal, or known.
//!
//! In: a system. Out, for rows of it, the equalities that connect what those speak of. A plan keeps no
//! proofs; they are made where someone asks for reasons.

use crate::pattern::Patterns;
use crate::stated::Stated;
use crate::substitute::{Classes, Forest, Key, substitute};
use crate::system::{RelationBody, Stay, System};
use std::collections::BTreeMap;
use std::rc::Rc;

/// The equalities of a system, as ways from slot to slot.
#[derive(Debug)]
pub struct Proofs {
    system: Rc<System>,
    classes: Classes,
    forest: Forest,
}

impl Proofs {
    /// Finds the equalities of a system over its patterns.
    pub fn new(system: &Rc<System>, patterns: &Patterns) -> Self {
        let classes = substitute(&Stated::new(system, patterns));
        let forest = Forest::new(&classes, system);
        Self { system: system.clone(), classes, forest }
    }

    /// Returns the equations (relation, equation) that make slots of some rows equal or known, in order.
    pub fn connecting(&self, rows: &[Key]) -> Vec<Key> {
        let mut spoken_of: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for &(relation, equation) in rows {
            let relation = &self.system.relations[relation as usize];
            if let RelationBody::Equations(span) = relation.body {
                let equation = &self.system.equations[span.range()][equation as usize];
                for &slot in self.system.arguments(equation.arguments) {
                    let root = self.classes.representative[slot as usize];
                    spoken_of.entry(root).or_default().push(slot as usize);
                }
            }
        }
        let mut ways = Vec::new();
        for (root, slots) in spoken_of {
            let is_constant = self.classes.constants.iter().any(|c| c.0 == root);
            let known = match self.classes.stay[root as usize] {
                Stay::Fixed if is_constant => Some(self.system.slots.len()),
                Stay::Fixed => Some(root as usize),
                Stay::Given(_) | Stay::Kept { .. } | Stay::Free => None,
            };
            let from = known.unwrap_or(slots[0]);
            slots.iter().for_each(|&slot| self.forest.way(slot, from, &mut ways));
        }
        ways.sort_unstable();
        ways.dedup();
        ways
    }
}
