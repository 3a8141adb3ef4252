//! A system with the patterns that it uses, and its equations written out.

use crate::pattern::{Pattern, PatternId, Patterns};
use crate::system::{MethodBody, SlotIndex, Span, System};
use expr::{Arena, ExprId, Var};
use std::collections::BTreeMap;
use std::rc::Rc;

/// A system and what its patterns are, as long as a plan of it lives.
#[derive(Clone, Debug)]
pub(crate) struct Stated {
    pub(crate) system: Rc<System>,
    patterns: Rc<BTreeMap<PatternId, Rc<Pattern>>>,
}

impl Stated {
    pub(crate) fn new(system: &Rc<System>, patterns: &Patterns) -> Self {
        let mut used = BTreeMap::new();
        let mut add = |id: PatternId| {
            used.entry(id).or_insert_with(|| patterns.get(id).clone());
        };
        system.equations.iter().for_each(|e| add(e.pattern));
        for method in system.relations.iter().flat_map(|r| &r.methods) {
            match method.body {
                MethodBody::Formulas { pattern, .. } => add(pattern),
                MethodBody::Opaque { .. } => {}
            }
        }
        Self { system: system.clone(), patterns: Rc::new(used) }
    }
    /// The same patterns for another system over them.
    pub(crate) fn with(&self, system: System) -> Self {
        Self { system: Rc::new(system), patterns: self.patterns.clone() }
    }
    pub(crate) fn pattern(&self, id: PatternId) -> &Rc<Pattern> {
        &self.patterns[&id]
    }
    /// Writes a pattern out over slots, each replaced by the one that stands for it.
    pub(crate) fn write_out(
        &self,
        arena: &mut Arena,
        representative: &[SlotIndex],
        pattern: PatternId,
        arguments: Span,
    ) -> Vec<ExprId> {
        let arguments: Vec<SlotIndex> =
            self.system.arguments(arguments).iter().map(|&s| representative[s as usize]).collect();
        self.pattern(pattern).write_out(arena, &arguments)
    }
    /// Makes an arena in which every slot has a place of its own, in order.
    pub(crate) fn arena(&self) -> Arena {
        let mut arena = Arena::new();
        for slot in 0..self.system.slots.len() as u32 {
            arena.var(Var(slot));
        }
        arena
    }
}
