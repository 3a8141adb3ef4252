//! A system with the patterns that it uses.

use crate::pattern::{Pattern, PatternId, Patterns};
use crate::system::{MethodBody, System};
use std::rc::Rc;

/// A system and what its patterns are, as long as a plan of it lives.
#[derive(Clone, Debug)]
pub(crate) struct Stated {
    pub(crate) system: Rc<System>,
    /// In order of their ids.
    patterns: Rc<[(PatternId, Rc<Pattern>)]>,
}

impl Stated {
    pub(crate) fn new(system: &Rc<System>, patterns: &Patterns) -> Self {
        let mut is_used = vec![false; patterns.len()];
        let mut add = |id: PatternId| is_used[id.0 as usize] = true;
        system.equations.iter().for_each(|e| add(e.pattern));
        for method in system.relations.iter().flat_map(|r| &r.methods) {
            match method.body {
                MethodBody::Formulas { pattern, .. } => add(pattern),
                MethodBody::Opaque { .. } => {}
            }
        }
        let used = (0..patterns.len() as u32).filter(|&i| is_used[i as usize]).map(PatternId);
        let patterns = used.map(|id| (id, patterns.get(id).clone())).collect();
        Self { system: system.clone(), patterns }
    }
    /// The same patterns for another system over them.
    pub(crate) fn with(&self, system: System) -> Self {
        Self { system: Rc::new(system), patterns: self.patterns.clone() }
    }
    /// Returns the place of a pattern among those that the system uses.
    pub(crate) fn place(&self, id: PatternId) -> usize {
        self.patterns.partition_point(|p| p.0 < id)
    }
    pub(crate) fn pattern_count(&self) -> usize {
        self.patterns.len()
    }
    pub(crate) fn pattern_at(&self, place: usize) -> &Rc<Pattern> {
        &self.patterns[place].1
    }
    pub(crate) fn pattern(&self, id: PatternId) -> &Rc<Pattern> {
        self.pattern_at(self.place(id))
    }
}
