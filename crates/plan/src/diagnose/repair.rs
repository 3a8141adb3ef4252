//! Repairs: what would make a contradictory set hold, each tried on everything that belongs to it.

use crate::diagnose::conflict::{Unit, rules_of};
use crate::diagnose::gradient::gradient;
use crate::diagnose::trial::{Setup, Trial};
use crate::host::Host;
use crate::planner::Planner;
use crate::rule::{Body, Source};
use crate::task::Holding;
use kernel::{SlotId, ThingId, Values};
use std::collections::{BTreeMap, BTreeSet};

/// Something that works.
#[derive(Clone, PartialEq, Debug)]
pub enum Repair {
    /// Delete the constraint, or switch it off.
    LeaveOut {
        /// The constraint.
        source: Source,
        /// What the numbers that it speaks of then are.
        numbers: Vec<(SlotId, f64)>,
    },
    /// Let go of the anchor that holds this slot and the others of its place.
    LetGo {
        /// The slot.
        slot: SlotId,
    },
    /// Give a number another value.
    Change {
        /// The number's slot.
        slot: SlotId,
        /// The value.
        to: f64,
    },
    /// Give several numbers other values at once.
    Move {
        /// Their slots and values.
        to: Vec<(SlotId, f64)>,
    },
}

/// Returns the number with as few digits as a person would write, if it is nearly that.
fn plain(x: f64) -> f64 {
    let rounded: f64 = format!("{x:.9e}").parse().unwrap_or(x);
    if base::number::close(x, rounded) { rounded } else { x }
}

/// A contradictory set, and everything that has to hold beside it.
pub(crate) struct Suspects<'s> {
    pub(crate) planner: &'s mut Planner,
    pub(crate) setup: &'s Setup<'s>,
    pub(crate) values: &'s Values,
    pub(crate) set: &'s [Unit],
    pub(crate) whole: &'s [Unit],
}

impl Suspects<'_> {
    /// Returns the anchored slots, the first of each place, without which the set would hold.
    pub(crate) fn anchors(&mut self, host: &mut dyn Host) -> Vec<SlotId> {
        let structure = self.setup.model.structure;
        let mut places: BTreeMap<ThingId, SlotId> = BTreeMap::new();
        for rule in rules_of(self.set) {
            for &s in self.planner.rules.get(rule).slots {
                let slot = &structure.slots[s];
                if slot.anchored {
                    places.entry(slot.place.unwrap_or(slot.thing)).or_insert(s);
                }
            }
        }
        let rules = rules_of(self.set);
        let takes_part = |s: &SlotId| self.holds_without_anchor(&rules, *s, host);
        places.into_values().filter(takes_part).collect()
    }

    fn holds_without_anchor(
        &mut self,
        rules: &[u32],
        anchored: SlotId,
        host: &mut dyn Host,
    ) -> bool {
        let structure = self.setup.model.structure;
        let place = |s: SlotId| structure.slots[s].place.unwrap_or(structure.slots[s].thing);
        let holding = |s: SlotId| match (self.setup.holding)(s) {
            Holding::Fixed if place(s) == place(anchored) => Holding::Kept,
            held => held,
        };
        let setup = Setup { model: self.setup.model, holding: &holding, aim: self.setup.aim };
        self.planner.can_hold(&setup, rules, &mut self.values.clone(), host) == Trial::Holds
    }

    /// Tries every repair that there is, until what that may cost is spent.
    pub(crate) fn repairs(&mut self, anchors: &[SlotId], host: &mut dyn Host) -> Vec<Repair> {
        let mut works = Vec::new();
        let mut numbers: BTreeMap<SlotId, f64> = BTreeMap::new();
        for unit in self.set {
            if self.planner.is_spent() {
                break;
            }
            let rest = self.whole.iter().filter(|u| u.source != unit.source);
            let rest: Vec<u32> = rest.flat_map(|u| u.rules.iter().copied()).collect();
            let mut there = self.values.clone();
            if self.planner.try_rules(self.setup, &rest, &mut there, host) != Trial::Holds {
                continue;
            }
            let slots = unit.rules.iter().flat_map(|&r| self.planner.rules.get(r).slots.to_vec());
            let then: BTreeMap<SlotId, f64> = slots.map(|s| (s, there.numbers[s])).collect();
            let then = then.into_iter().collect();
            works.push(Repair::LeaveOut { source: unit.source, numbers: then });
            for slot in self.given(unit) {
                if let Some(to) = self.number_for(unit, slot, &there) {
                    numbers.entry(slot).or_insert(to);
                }
            }
        }
        let whole = rules_of(self.whole);
        for &slot in anchors {
            if self.holds_without_anchor(&whole, slot, host) {
                works.push(Repair::LetGo { slot });
            }
        }
        for (slot, to) in numbers {
            if self.planner.is_spent() {
                break;
            }
            let to = plain(to);
            let mut there = self.values.clone();
            there.numbers[slot] = to;
            let holding = |s: SlotId| match (self.setup.holding)(s) {
                _ if s == slot => Holding::Fixed,
                held => held,
            };
            let setup = Setup { model: self.setup.model, holding: &holding, aim: self.setup.aim };
            if self.planner.try_rules(&setup, &whole, &mut there, host) == Trial::Holds {
                works.push(Repair::Change { slot, to });
            }
        }
        works
    }

    /// Returns the given numbers that a unit speaks of.
    fn given(&self, unit: &Unit) -> BTreeSet<SlotId> {
        let slots = unit.rules.iter().flat_map(|&r| self.planner.rules.get(r).slots.to_vec());
        let model = self.setup.model;
        let is_given = |s: &SlotId| {
            let slot = &model.structure.slots[*s];
            slot.given.is_some() && slot.place.is_none() && slot.primitive.is_number()
        };
        slots.filter(is_given).collect()
    }

    /// Finds the value of a number for which the one equation of a unit holds, all else as it is.
    fn number_for(&self, unit: &Unit, slot: SlotId, values: &Values) -> Option<f64> {
        /// Steps of Newton's method.
        const STEPS: usize = 40;
        let [r] = unit.rules.as_slice() else { return None };
        let rule = self.planner.rules.get(*r);
        let Body::Equations(equations) = &rule.shape.body else { return None };
        let [equation] = equations.as_slice() else { return None };
        let patterns = self.planner.plans.patterns();
        let mut scratch = solve::Scratch::default();
        let mut numbers = values.numbers.clone();
        for _ in 0..STEPS {
            let sides = rule.evaluate(equation, patterns, &numbers, &mut scratch);
            let residual = sides[0] - sides[1];
            if sides[0] == sides[1] || base::number::close(sides[0], sides[1]) {
                let x = numbers[slot];
                return (x.is_finite() && x != self.values.numbers[slot]).then_some(x);
            }
            let row = gradient(patterns, rule, equation, &numbers, &mut scratch);
            let slope = row.iter().find(|e| e.0 == slot)?.1;
            numbers[slot] -= residual / slope;
        }
        None
    }
}
