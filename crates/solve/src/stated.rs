//! A system with the patterns that it uses.

use crate::pattern::{Pattern, PatternId, Patterns};
use crate::system::{Equation, MethodBody, System};
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
        let written = system.relations.iter().flat_map(|r| &r.methods);
        let formulas = written.filter_map(|method| match method.body {
            MethodBody::Formulas { pattern, .. } => Some(pattern.0),
            MethodBody::Opaque { .. } => None,
        });
        let ids = || system.equations.iter().map(|e| e.pattern.0).chain(formulas.clone());
        // of many patterns it uses few, and these were mostly made one after the other
        let (least, most) =
            ids().fold((u32::MAX, 0), |(least, most), id| (least.min(id), most.max(id + 1)));
        let mut place = vec![UNUSED; most.saturating_sub(least) as usize];
        ids().for_each(|id| place[(id - least) as usize] = 0);
        let used = place.iter().filter(|place| **place != UNUSED).count();
        let mut own = Vec::with_capacity(used);
        for (id, place) in (least..most).map(PatternId).zip(&mut place) {
            if *place != UNUSED {
                *place = own.len() as u32;
                own.push((id, patterns.get(id).clone()));
            }
        }
        let place_of = |e: &Equation| place[(e.pattern.0 - least) as usize];
        let of_equation = system.equations.iter().map(place_of).collect();
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
    /// Returns true if some of the plain numbers of the system are angles.
    pub(crate) fn has_angles(&self) -> bool {
        self.patterns.iter().any(|(_, pattern)| pattern.has_angles())
    }
    /// Returns true if some equation bends.
    pub(crate) fn has_bends(&self) -> bool {
        self.patterns.iter().any(|(_, p)| p.roots().len() == 2 && !p.kernel().is_linear())
    }
    pub(crate) fn pattern(&self, id: PatternId) -> &Rc<Pattern> {
        self.pattern_at(self.patterns.partition_point(|p| p.0 < id))
    }
}
