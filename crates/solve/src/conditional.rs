//! A conditional system: a system that asks for more than equations.
//!
//! Some of its relations ask for truths (an inequality, alternatives) or for differences instead of
//! equations, and some hold only while conditions are assumed true or false. It has no plan of its
//! own: in every *mode* it is a plain system that has one, or its whole numbers are searched.

use crate::pattern::PatternId;
use crate::system::{RelationBody, Slot, SlotIndex, Span, Stay, System};

/// What a relation asks for besides its equations.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Demand {
    /// The relation's index in the system.
    pub relation: u32,
    /// What kind of demand it is.
    pub kind: DemandKind,
    /// Its expressions.
    pub pattern: PatternId,
    /// Of which slots, in [`System::arguments`].
    pub arguments: Span,
}

/// The kinds of demands.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum DemandKind {
    /// The one expression is true.
    True,
    /// No two of the expressions are equal.
    Different,
}

/// An expression that is assumed true or false before anything is solved, and tested afterwards.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Condition {
    /// The one expression.
    pub pattern: PatternId,
    /// Of which slots, in [`System::arguments`].
    pub arguments: Span,
}

/// That a relation holds only while a condition is assumed so.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Guard {
    /// The relation's index in the system.
    pub relation: u32,
    /// The condition's index.
    pub condition: u32,
    /// Whether it has to be true or false.
    pub truth: bool,
}

/// The whole numbers that a slot may hold, both included.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct SlotRange {
    /// The slot.
    pub slot: SlotIndex,
    /// The least.
    pub low: i64,
    /// The greatest.
    pub high: i64,
}

impl SlotRange {
    /// Returns true if a number is in it.
    pub fn holds(&self, x: f64) -> bool {
        (self.low as f64..=self.high as f64).contains(&x)
    }
}

/// A system with demands, conditions and ranges.
#[derive(Clone, PartialEq, Eq, Hash, Debug, Default)]
pub struct Conditional {
    /// The slots and relations; one that has a demand has no equations.
    pub system: System,
    /// The demands, in the order of their relations.
    pub demands: Vec<Demand>,
    /// The conditions, in order of declaration.
    pub conditions: Vec<Condition>,
    /// The guards, in the order of their relations; one relation may have several.
    pub guards: Vec<Guard>,
    /// Ranges of whole numbers, in the order of their slots.
    pub ranges: Vec<SlotRange>,
}

impl Conditional {
    /// Returns true if nothing in it asks for more than equations.
    pub fn is_plain(&self) -> bool {
        self.demands.is_empty() && self.guards.is_empty() && self.ranges.is_empty()
    }
    /// Returns true for a slot whose whole number is unknown.
    pub fn is_whole_unknown(&self, slot: SlotIndex) -> bool {
        let slot = &self.system.slots[slot as usize];
        slot.is_number && slot.is_discrete && slot.stay != Stay::Fixed
    }
    /// Returns true if a whole number is unknown, whatever else is.
    pub fn has_whole_unknowns(&self) -> bool {
        (0..self.system.slots.len() as SlotIndex).any(|s| self.is_whole_unknown(s))
    }
    fn has_finite_ranges(&self) -> bool {
        let is_ranged = |s: SlotIndex| self.ranges.binary_search_by_key(&s, |r| r.slot).is_ok();
        let mut slots = 0..self.system.slots.len() as SlotIndex;
        slots.all(|s| !self.is_whole_unknown(s) || is_ranged(s))
    }
    /// Returns true if nothing but whole numbers is unknown, and not equations alone decide them. Where
    /// they are summed up with what is not whole, their ranges have to be finite.
    pub fn is_searched(&self) -> bool {
        let is_unknown = |s: &&Slot| s.stay != Stay::Fixed;
        let mut unknown = self.system.slots.iter().filter(is_unknown).peekable();
        !self.is_plain()
            && unknown.peek().is_some()
            && unknown.all(|s| s.is_number && s.is_discrete)
            && self.system.slots.iter().all(|s| s.is_number)
            && (self.system.slots.iter().all(|s| s.is_discrete) || self.has_finite_ranges())
            && self
                .system
                .relations
                .iter()
                .all(|r| r.methods.is_empty() && matches!(r.body, RelationBody::Equations(_)))
    }
}
