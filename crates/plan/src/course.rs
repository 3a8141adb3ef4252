//! Courses: which turns and branches programs take and how many ranges count, where rules and wishes speak of that.
//!
//! A rule says what it says on the course that was taken at some state. Each decision on the way is kept: while all
//! come out as they did, the rule is right. Where one comes out otherwise the rules are opened anew.

use crate::counting::whole;
use crate::evaluate::Opening;
use crate::planner::{Model, Planner};
use crate::rule::Formula;
use expr::ExprId;
use kernel::{SlotId, Structure, ThingId, Values};
use solve::Patterns;
use std::collections::{BTreeMap, BTreeSet};

/// What is decided.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Decided {
    /// How many turns a loop takes.
    Turns,
    /// Which branch of an `if` is drawn.
    Branch,
    /// Whether a demand on the parameters is met.
    Demand,
    /// A parameter that is a whole number or a truth value.
    Parameter,
    /// What says how many there are.
    Count,
}

/// Where in a program something is decided.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Block {
    /// The thing whose program it is, or the number that counts; none in a program that is called.
    pub(crate) of: Option<ThingId>,
    /// The step, the demand or the parameter, as it is reached from there; an `if` without a name by its block.
    pub(crate) path: String,
    pub(crate) what: Decided,
}

/// What was decided, as an expression of the rule at hand.
#[derive(Clone, Debug)]
pub(crate) struct Decision {
    pub(crate) of: ExprId,
    pub(crate) is: f64,
    pub(crate) place: Block,
}

/// What has to come out as it did.
#[derive(Clone, Debug)]
pub(crate) struct Guard {
    of: Formula<SlotId>,
    is: f64,
    place: Block,
}

impl Guard {
    fn value(&self, patterns: &Patterns, values: &Values) -> f64 {
        self.of.value(patterns, &values.numbers)
    }
    /// Returns true if it comes out as it did; what had no value has none again.
    fn holds(&self, patterns: &Patterns, values: &Values) -> bool {
        let value = self.value(patterns, values);
        value == self.is || value.is_nan() && self.is.is_nan()
    }
    /// Returns how it would be if it had been decided at other values.
    pub(crate) fn decided_at(&self, patterns: &Patterns, values: &Values) -> Self {
        Self { is: self.value(patterns, values), ..self.clone() }
    }
}

/// Another course than before.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct CourseChange {
    /// The thing whose program takes it; the number that counts.
    pub of: ThingId,
    /// The step, the demand or the parameter, as it is reached from there.
    pub path: String,
    /// What is decided there.
    pub what: Decided,
    /// How many turns a loop took, or what a count was; nothing for anything else.
    pub from: Option<u32>,
    /// How many it would take now.
    pub to: Option<u32>,
}

impl Opening<'_> {
    /// Takes what was decided since the rule at hand began.
    pub(crate) fn guards(&mut self, patterns: &mut Patterns) -> Vec<Guard> {
        let decisions = std::mem::take(&mut self.decisions);
        let guard = |Decision { of, is, place }| Guard {
            of: Formula::of(patterns, &self.arena, &[of]),
            is,
            place,
        };
        decisions.into_iter().map(guard).collect()
    }
}

impl Planner {
    /// Returns true if everything was decided as it is decided at these values.
    pub(crate) fn is_on_course(&self, guards: &[Guard], values: &Values) -> bool {
        guards.iter().all(|guard| guard.holds(self.plans.patterns(), values))
    }

    /// Says what programs that guards are about do otherwise at other values.
    pub(crate) fn course_changes(
        &self,
        model: Model<'_>,
        guards: &[Guard],
        (before, after): (&Values, &Values),
    ) -> Vec<CourseChange> {
        let patterns = self.plans.patterns();
        let broken = guards.iter().filter(|g| !g.holds(patterns, after));
        let counts = |g: &Guard| match g.place.what {
            Decided::Count => [g.is, g.value(patterns, after)].map(count),
            Decided::Turns | Decided::Branch | Decided::Demand | Decided::Parameter => [None; 2],
        };
        let places: BTreeSet<_> = broken.map(|g| (&g.place, counts(g))).collect();
        let change = |(place, counts): (&Block, [Option<u32>; 2])| {
            let of = place.of?;
            let turns = |values| turns(model, of, values).get(&place.path).copied();
            let [from, to] = match place.what {
                Decided::Count => counts,
                _ => [before, after].map(turns),
            };
            Some(CourseChange { of, path: place.path.clone(), what: place.what, from, to })
        };
        places.into_iter().filter_map(change).collect()
    }

    /// Returns how everything is decided at some values: where, and the bits of what comes out.
    pub(crate) fn decided_at(&self, guards: &[Guard], values: &Values) -> Vec<(Block, u64)> {
        let patterns = self.plans.patterns();
        let value = |guard: &Guard| guard.value(patterns, values).to_bits();
        guards.iter().map(|guard| (guard.place.clone(), value(guard))).collect()
    }

    /// Returns true if one of these numbers decides a count, and comes out otherwise.
    pub(crate) fn counts_otherwise(
        &self,
        structure: &Structure,
        guards: &[Guard],
        numbers: &BTreeSet<SlotId>,
        values: &Values,
    ) -> bool {
        let mut broken = guards.iter().filter(|g| !g.holds(self.plans.patterns(), values));
        broken.any(|guard| {
            guard.place.what == Decided::Count && is_of(structure, guard.place.of, numbers)
        })
    }
}

impl CourseChange {
    /// Returns true for a count that is one of some numbers: whoever edits these knows.
    pub(crate) fn is_of(&self, structure: &Structure, numbers: &BTreeSet<SlotId>) -> bool {
        self.what == Decided::Count && is_of(structure, Some(self.of), numbers)
    }
}

fn is_of(structure: &Structure, thing: Option<ThingId>, numbers: &BTreeSet<SlotId>) -> bool {
    thing.and_then(|thing| structure.slot_of(thing)).is_some_and(|slot| numbers.contains(&slot))
}

/// Returns how many a number is, where it counts.
fn count(number: f64) -> Option<u32> {
    whole(number).and_then(|n| u32::try_from(n).ok())
}

/// Returns how many turns the loops of a thing's program take.
fn turns(model: Model<'_>, of: ThingId, values: &Values) -> BTreeMap<String, u32> {
    let mut opening = Opening::new(model.document, model.structure);
    opening.at = Some(values);
    opening.begin(of);
    let mut found = BTreeMap::new();
    if let Ok(Some(drawn)) = opening.drawn_by(of) {
        drawn.count_turns("", &mut found);
    }
    found
}
