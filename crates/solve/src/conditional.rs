//! A conditional system: a system that asks for more than equations.
//!
//! Some of its relations ask for truths (an inequality, alternatives) or for differences instead of
//! equations, and some hold only while conditions are assumed true or false. It has no plan of its
//! own: in every *mode* it is a plain system that has one, or its whole numbers are searched.

use crate::pattern::PatternId;
use crate::system::{Relation, RelationBody, Slot, SlotIndex, Span, Stay, System};

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
    /// True for what its class says: that a truth value is 0 or 1. Formulas keep that.
    pub is_by_class: bool,
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

/// Returns those that are a relation's, of what stands in the order of relations.
pub(crate) fn of_relation<T>(all: &[T], relation: u32, own: impl Fn(&T) -> u32) -> &[T] {
    let start = all.partition_point(|item| own(item) < relation);
    let end = all.partition_point(|item| own(item) <= relation);
    &all[start..end]
}

impl Conditional {
    /// Returns true if nothing in it asks for more than equations.
    pub fn is_plain(&self) -> bool {
        self.demands.is_empty()
            && self.guards.is_empty()
            && self.ranges.iter().all(|r| r.is_by_class)
    }
    /// Returns the guards of a relation.
    pub fn guards_of(&self, relation: u32) -> &[Guard] {
        of_relation(&self.guards, relation, |g| g.relation)
    }
    /// Returns the demands of a relation.
    pub fn demands_of(&self, relation: u32) -> &[Demand] {
        of_relation(&self.demands, relation, |d| d.relation)
    }
    /// Returns the slots that the conditions ask for under which a relation holds.
    pub fn conditions_of(&self, relation: u32) -> impl Iterator<Item = SlotIndex> {
        let asked = self
            .guards_of(relation)
            .iter()
            .map(|g| self.conditions[g.condition as usize].arguments);
        asked.flat_map(|arguments| self.system.arguments(arguments).iter().copied())
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
    /// Returns for every slot whether relations speak of it, and none may write it, nor a condition ask for it. A
    /// complete list of methods writes its targets alone.
    pub(crate) fn only_read(&self) -> Vec<bool> {
        let system = &self.system;
        let n = system.slots.len();
        let (mut mentioned, mut written) = (vec![false; n], vec![false; n]);
        let mut mention = |relation: &Relation, slots: &[SlotIndex]| {
            let is_open = relation.derived || relation.methods.is_empty();
            for &slot in slots {
                mentioned[slot as usize] = true;
                written[slot as usize] |= is_open && !system.reads(relation).contains(&slot);
            }
        };
        for relation in &system.relations {
            for equation in system.equations_of(relation) {
                mention(relation, system.arguments(equation.arguments));
            }
            match &relation.body {
                RelationBody::Opaque { slots } => mention(relation, slots),
                RelationBody::Equations(_) => {}
            }
        }
        for demand in &self.demands {
            let relation = &system.relations[demand.relation as usize];
            mention(relation, system.arguments(demand.arguments));
        }
        let methods = system.relations.iter().flat_map(|r| &r.methods);
        let conditions = self.conditions.iter().map(|c| system.arguments(c.arguments));
        let others = methods.map(|m| &m.targets[..]).chain(conditions).flatten();
        others.for_each(|&slot| written[slot as usize] = true);
        mentioned
            .into_iter()
            .zip(written)
            .map(|(mentioned, written)| mentioned && !written)
            .collect()
    }
    /// Makes constants of whole numbers with a value that relations only read.
    pub fn hold_what_is_only_read(&mut self) {
        let only_read = self.only_read();
        for (slot, _) in self.system.slots.iter_mut().zip(only_read).filter(|(_, is)| *is) {
            if slot.is_discrete && slot.stay != Stay::Free {
                slot.stay = Stay::Fixed;
            }
        }
    }
    fn has_finite_ranges(&self) -> bool {
        let is_ranged = |s: SlotIndex| self.ranges.binary_search_by_key(&s, |r| r.slot).is_ok();
        let mut slots = 0..self.system.slots.len() as SlotIndex;
        slots.all(|s| !self.is_whole_unknown(s) || is_ranged(s))
    }
    /// Returns true if nothing but whole numbers is unknown, and not equations alone decide them. Where
    /// they are summed up with what is not whole, their ranges have to be finite.
    pub fn is_searched(&self) -> bool {
        !self.is_plain() && self.is_of_whole_numbers()
    }
    /// Returns true if nothing but whole numbers is unknown, and it can be searched.
    pub fn is_of_whole_numbers(&self) -> bool {
        let is_unknown = |s: &&Slot| s.stay != Stay::Fixed;
        let mut unknown = self.system.slots.iter().filter(is_unknown).peekable();
        unknown.peek().is_some()
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
