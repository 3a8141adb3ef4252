//! Components: which rules have to be looked at together.
//!
//! Two rules belong together if they share a slot that is not fixed, or if they speak of two
//! coordinates of one place: a place yields as one.

use crate::rule::Rule;
use base::IdVec;
use kernel::{SlotId, Structure, ThingId};
use std::collections::BTreeMap;

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
    place: IdVec<SlotId, Option<u32>>,
    places: Vec<Vec<SlotId>>,
}

impl Net {
    pub(crate) fn new(structure: &Structure, rules: &[Rule]) -> Self {
        let n = structure.slots.len();
        let mut first = vec![0; n + 1];
        for rule in rules {
            rule.slots.iter().for_each(|s| first[s.0 as usize + 1] += 1);
        }
        for i in 0..n {
            first[i + 1] += first[i];
        }
        let mut next = first.clone();
        let mut by_slot = vec![0; first[n] as usize];
        for (i, rule) in rules.iter().enumerate() {
            for s in &rule.slots {
                by_slot[next[s.0 as usize] as usize] = i as u32;
                next[s.0 as usize] += 1;
            }
        }
        let mut places: Vec<Vec<SlotId>> = Vec::new();
        let mut index: BTreeMap<ThingId, u32> = BTreeMap::new();
        let mut place = IdVec::filled(None, n);
        for (slot, s) in structure.slots.iter() {
            if let Some(thing) = s.place {
                let i = *index.entry(thing).or_insert_with(|| {
                    places.push(Vec::new());
                    places.len() as u32 - 1
                });
                places[i as usize].push(slot);
                place[slot] = Some(i);
            }
        }
        Self { first, rules: by_slot, place, places }
    }

    /// Returns the rules that mention a slot, in order.
    pub(crate) fn rules_of(&self, slot: SlotId) -> &[u32] {
        let i = slot.0 as usize;
        &self.rules[self.first[i] as usize..self.first[i + 1] as usize]
    }

    /// Returns the coordinates of the slot's place, itself included; nothing for a lone number.
    pub(crate) fn place_of(&self, slot: SlotId) -> &[SlotId] {
        self.place[slot].map_or(&[], |p| &self.places[p as usize])
    }

    /// Returns every component of the document, in order of their first slot.
    pub(crate) fn all(&self, rules: &[Rule], is_fixed: &dyn Fn(SlotId) -> bool) -> Vec<Component> {
        let slots = (0..self.place.len() as u32).map(SlotId);
        let slots = slots.filter(|&s| !self.rules_of(s).is_empty());
        self.around(slots, rules, is_fixed, &[])
    }

    /// Returns the components of these slots; those of a fixed slot are the components of its rules.
    ///
    /// Each of `tied` speaks of several slots and ties them together, as a rule does.
    pub(crate) fn around(
        &self,
        slots: impl IntoIterator<Item = SlotId>,
        rules: &[Rule],
        is_fixed: &dyn Fn(SlotId) -> bool,
        tied: &[Vec<SlotId>],
    ) -> Vec<Component> {
        let mut walk = Walk { rule_seen: Seen::default(), slot_seen: Seen::default(), tied };
        let mut components = Vec::new();
        for slot in slots {
            if !is_fixed(slot) {
                let component = walk.from(self, rules, is_fixed, &[slot], &[]);
                components.extend(component);
                continue;
            }
            for &rule in self.rules_of(slot) {
                components.extend(walk.from(self, rules, is_fixed, &[], &[rule]));
            }
        }
        components
    }
}

/// Small sets of numbers that start empty: the walk costs what it visits, not the document.
#[derive(Default)]
struct Seen(std::collections::BTreeSet<u32>);

impl Seen {
    fn add(&mut self, i: u32) -> bool {
        self.0.insert(i)
    }
}

struct Walk<'t> {
    rule_seen: Seen,
    slot_seen: Seen,
    tied: &'t [Vec<SlotId>],
}

impl Walk<'_> {
    fn from(
        &mut self,
        net: &Net,
        rules: &[Rule],
        is_fixed: &dyn Fn(SlotId) -> bool,
        slots: &[SlotId],
        first_rules: &[u32],
    ) -> Option<Component> {
        let mut component = Component::default();
        let mut fixed = Vec::new();
        let mut waiting: Vec<SlotId> = Vec::new();
        let reach =
            |seen: &mut Seen, s: SlotId, waiting: &mut Vec<SlotId>, fixed: &mut Vec<SlotId>| {
                if is_fixed(s) {
                    fixed.push(s);
                } else if seen.add(s.0) {
                    waiting.push(s);
                }
            };
        for &s in slots {
            reach(&mut self.slot_seen, s, &mut waiting, &mut fixed);
        }
        let mut new_rules: Vec<u32> =
            first_rules.iter().copied().filter(|&r| self.rule_seen.add(r)).collect();
        loop {
            while let Some(rule) = new_rules.pop() {
                component.rules.push(rule);
                for &s in &rules[rule as usize].slots {
                    reach(&mut self.slot_seen, s, &mut waiting, &mut fixed);
                }
            }
            let Some(slot) = waiting.pop() else { break };
            component.slots.push(slot);
            for &rule in net.rules_of(slot) {
                if self.rule_seen.add(rule) {
                    new_rules.push(rule);
                }
            }
            for &s in net.place_of(slot).iter().filter(|&&s| s != slot) {
                if !net.rules_of(s).is_empty() {
                    reach(&mut self.slot_seen, s, &mut waiting, &mut fixed);
                }
            }
            for tied in self.tied.iter().filter(|t| t.contains(&slot)) {
                for &s in tied {
                    reach(&mut self.slot_seen, s, &mut waiting, &mut fixed);
                }
            }
        }
        if component.slots.is_empty() && component.rules.is_empty() {
            return None;
        }
        component.slots.extend(fixed);
        component.slots.sort_unstable();
        component.slots.dedup();
        component.rules.sort_unstable();
        Some(component)
    }
}
