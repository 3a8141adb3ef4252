//! Components: which rules have to be looked at together.
//!
//! Two rules belong together if they share a slot that is not fixed, or if they speak of two
//! coordinates of one place: a place yields as one.

use crate::rule::Rules;
use base::{IdVec, Mixer};
use indexmap::IndexSet;
use kernel::{SlotId, Structure, ThingId};
use std::hash::BuildHasherDefault;
use std::rc::Rc;

/// Rules with the slots that they mention, both in order of declaration.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Component {
    pub(crate) rules: Vec<u32>,
    pub(crate) slots: Vec<SlotId>,
}

/// Which rules mention a slot, and which slots are one place.
#[derive(Clone, Debug, Default)]
pub(crate) struct Net {
    /// For every slot, where its rules begin in `rules`; one more at the end.
    first: Vec<u32>,
    rules: Vec<u32>,
    places: Places,
}

/// Which slots are coordinates of one place.
#[derive(Clone, Debug, Default)]
struct Places {
    /// For every slot, its place by number.
    of: IdVec<SlotId, u32>,
    /// For every place, where its slots begin; one more at the end.
    first: Vec<u32>,
    slots: Vec<SlotId>,
}

/// The slot is a lone number.
const NO_PLACE: u32 = u32::MAX;

impl Places {
    fn new(structure: &Structure) -> Self {
        let mut of = IdVec::filled(NO_PLACE, structure.slots.len());
        let mut number: IdVec<ThingId, u32> = IdVec::filled(NO_PLACE, structure.things.len());
        let mut first = vec![0];
        for (slot, s) in structure.slots.iter() {
            let Some(thing) = s.place else { continue };
            if number[thing] == NO_PLACE {
                number[thing] = first.len() as u32 - 1;
                first.push(0);
            }
            of[slot] = number[thing];
            first[number[thing] as usize + 1] += 1;
        }
        for i in 1..first.len() {
            first[i] += first[i - 1];
        }
        let mut next = first.clone();
        let mut slots = vec![SlotId(0); *first.last().unwrap_or(&0) as usize];
        for (slot, &place) in of.iter().filter(|(_, p)| **p != NO_PLACE) {
            slots[next[place as usize] as usize] = slot;
            next[place as usize] += 1;
        }
        Self { of, first, slots }
    }
}

impl Net {
    pub(crate) fn new(structure: &Structure, rules: &Rules) -> Self {
        let n = structure.slots.len();
        let mut first = vec![0; n + 1];
        for rule in rules.iter() {
            rule.slots.iter().for_each(|s| first[s.0 as usize + 1] += 1);
        }
        for i in 0..n {
            first[i + 1] += first[i];
        }
        let mut next = first.clone();
        let mut by_slot = vec![0; first[n] as usize];
        for (i, rule) in (0..).zip(rules.iter()) {
            for s in rule.slots {
                by_slot[next[s.0 as usize] as usize] = i;
                next[s.0 as usize] += 1;
            }
        }
        Self { first, rules: by_slot, places: Places::new(structure) }
    }

    /// Returns the rules that mention a slot, in order.
    pub(crate) fn rules_of(&self, slot: SlotId) -> &[u32] {
        let i = slot.0 as usize;
        &self.rules[self.first[i] as usize..self.first[i + 1] as usize]
    }

    /// Returns the coordinates of the slot's place, itself included; nothing for a lone number.
    pub(crate) fn place_of(&self, slot: SlotId) -> &[SlotId] {
        let place = self.places.of[slot];
        if place == NO_PLACE {
            return &[];
        }
        let [from, to] = [place, place + 1].map(|p| self.places.first[p as usize] as usize);
        &self.places.slots[from..to]
    }

    /// Returns every component of the document, in order of their first slot.
    pub(crate) fn all(
        &self,
        rules: &Rules,
        is_fixed: &dyn Fn(SlotId) -> bool,
    ) -> Vec<Rc<Component>> {
        let slots = (0..self.places.of.len() as u32).map(SlotId);
        let slots = slots.filter(|&s| !self.rules_of(s).is_empty());
        let slot_seen = Seen::Dense(vec![false; self.places.of.len()]);
        let rule_seen = Seen::Dense(vec![false; rules.len()]);
        let walk = Walk { net: self, rules, is_fixed, rule_seen, slot_seen, tied: &[] };
        walk.around(slots)
    }

    /// Returns the components of these slots; those of a fixed slot are the components of its rules.
    ///
    /// Each of `tied` speaks of several slots and ties them together, as a rule does. Cost: that of
    /// the components, whatever else the document holds.
    pub(crate) fn around(
        &self,
        slots: impl IntoIterator<Item = SlotId>,
        rules: &Rules,
        is_fixed: &dyn Fn(SlotId) -> bool,
        tied: &[Vec<SlotId>],
    ) -> Vec<Rc<Component>> {
        let [rule_seen, slot_seen] = [(); 2].map(|()| Seen::Sparse(IndexSet::default()));
        Walk { net: self, rules, is_fixed, rule_seen, slot_seen, tied }.around(slots)
    }
}

/// Which numbers were met.
enum Seen {
    /// For a walk through everything.
    Dense(Vec<bool>),
    /// For a walk through a little.
    Sparse(IndexSet<u32, BuildHasherDefault<Mixer>>),
}

impl Seen {
    /// Returns true the first time.
    fn add(&mut self, i: u32) -> bool {
        match self {
            Self::Dense(seen) => !std::mem::replace(&mut seen[i as usize], true),
            Self::Sparse(seen) => seen.insert(i),
        }
    }
}

struct Walk<'w> {
    net: &'w Net,
    rules: &'w Rules,
    is_fixed: &'w dyn Fn(SlotId) -> bool,
    rule_seen: Seen,
    slot_seen: Seen,
    tied: &'w [Vec<SlotId>],
}

/// A component on the way: what was reached and not yet looked at.
#[derive(Default)]
struct Found {
    component: Component,
    fixed: Vec<SlotId>,
    slots: Vec<SlotId>,
    rules: Vec<u32>,
}

impl Walk<'_> {
    fn around(mut self, slots: impl IntoIterator<Item = SlotId>) -> Vec<Rc<Component>> {
        let mut components = Vec::new();
        for slot in slots {
            if !(self.is_fixed)(slot) {
                let mut found = Found::default();
                self.reach(slot, &mut found);
                components.extend(self.complete(found));
                continue;
            }
            for &rule in self.net.rules_of(slot) {
                if self.rule_seen.add(rule) {
                    let found = Found { rules: vec![rule], ..Found::default() };
                    components.extend(self.complete(found));
                }
            }
        }
        components
    }

    fn reach(&mut self, slot: SlotId, found: &mut Found) {
        if (self.is_fixed)(slot) {
            found.fixed.push(slot);
        } else if self.slot_seen.add(slot.0) {
            found.slots.push(slot);
        }
    }

    fn complete(&mut self, mut found: Found) -> Option<Rc<Component>> {
        let net = self.net;
        loop {
            while let Some(rule) = found.rules.pop() {
                found.component.rules.push(rule);
                for &s in self.rules.get(rule).slots {
                    self.reach(s, &mut found);
                }
            }
            let Some(slot) = found.slots.pop() else { break };
            found.component.slots.push(slot);
            for &rule in net.rules_of(slot) {
                if self.rule_seen.add(rule) {
                    found.rules.push(rule);
                }
            }
            for &s in net.place_of(slot) {
                if s != slot && !net.rules_of(s).is_empty() {
                    self.reach(s, &mut found);
                }
            }
            for tied in self.tied.iter().filter(|t| t.contains(&slot)) {
                for &s in tied {
                    self.reach(s, &mut found);
                }
            }
        }
        let Found { mut component, fixed, .. } = found;
        if component.slots.is_empty() && component.rules.is_empty() {
            return None;
        }
        component.slots.extend(fixed);
        component.slots.sort_unstable();
        component.slots.dedup();
        component.rules.sort_unstable();
        component.slots.shrink_to_fit();
        component.rules.shrink_to_fit();
        Some(Rc::new(component))
    }
}
