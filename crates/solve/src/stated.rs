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
    /// For every equation, the place of its pattern among them.
    of_equation: Rc<[u32]>,
}

impl Stated {
    pub(crate) fn new(system: &Rc<System>, patterns: &Patterns) -> Self {
        const UNUSED: u32 = u32::MAX;
        let mut place = vec![UNUSED; patterns.len()];
        let mut add = |id: PatternId| place[id.0 as usize] = 0;
        system.equations.iter().for_each(|e| add(e.pattern));
        for method in system.relations.iter().flat_map(|r| &r.methods) {
            match method.body {
                MethodBody::Formulas { pattern, .. } => add(pattern),
                MethodBody::Opaque { .. } => {}
            }
        }
        let used = place.iter().filter(|place| **place != UNUSED).count();
        let mut own = Vec::with_capacity(used);
        for (id, place) in (0..).map(PatternId).zip(&mut place) {
            if *place != UNUSED {
                *place = own.len() as u32;
                own.push((id, patterns.get(id).clone()));
            }
        }
        let of_equation = system.equations.iter().map(|e| place[e.pattern.0 as usize]).collect();
        Self { system: system.clone(), patterns: own.into(), of_equation }
    }
    /// The same for another system of the same equations.
    pub(crate) fn with(&self, system: System) -> Self {
        let Self { patterns, of_equation, .. } = self.clone();
        Self { system: Rc::new(system), patterns, of_equation }
    }
    /// Returns the place of an equation's pattern among those that the system uses.
    pub(crate) fn place_of(&self, equation: usize) -> usize {
        self.of_equation[equation] as usize
    }
    pub(crate) fn pattern_count(&self) -> usize {
        self.patterns.len()
    }
    pub(crate) fn pattern_at(&self, place: usize) -> &Rc<Pattern> {
        &self.patterns[place].1
    }
    pub(crate) fn pattern(&self, id: PatternId) -> &Rc<Pattern> {
        self.pattern_at(self.patterns.partition_point(|p| p.0 < id))
    }
}
