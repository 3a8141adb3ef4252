//! Components: which rules have to be looked at together.
//!
//! Two rules belong together if they share a slot that is not fixed, or if they speak of two
//! coordinates of one place: a place yields as one.

use crate::rule::Rules;
use base::IdVec;
use kernel::{SlotId, Structure, ThingId};
use std::fmt;
use std::rc::Rc;

/// Rules with the slots that they mention, both in order of declaration.
///
/// Components that are found together stand together: each is a place among them.
#[derive(Clone)]
pub(crate) struct Component {
    all: Rc<Components>,
    at: u32,
}

/// The rules and slots of several components, one after the other.
#[derive(Default)]
struct Components {
    rules: Vec<u32>,
    slots: Vec<SlotId>,
    /// Where each component ends: among the rules, and among the slots.
    ends: Vec<(u32, u32)>,
}

impl Components {
    fn end(&mut self) {
        self.ends.push((self.rules.len() as u32, self.slots.len() as u32));
    }
    fn split(mut self) -> Vec<Component> {
        self.rules.shrink_to_fit();
        self.slots.shrink_to_fit();
        let count = self.ends.len() as u32;
        let all = Rc::new(self);
        (0..count).map(|at| Component { all: all.clone(), at }).collect()
    }
}

impl Component {
    /// Makes a component that stands alone.
    pub(crate) fn of(rules: Vec<u32>, slots: Vec<SlotId>) -> Self {
        let mut all = Components { rules, slots, ends: Vec::new() };
        all.end();
        Self { all: Rc::new(all), at: 0 }
    }
    /// Returns true if the other was found together with this one, and is the same.
    pub(crate) fn is(&self, other: &Self) -> bool {
        Rc::ptr_eq(&self.all, &other.all) && self.at == other.at
    }
    fn bounds(&self) -> ((u32, u32), (u32, u32)) {
        let at = self.at as usize;
        let start = at.checked_sub(1).map_or((0, 0), |before| self.all.ends[before]);
        (start, self.all.ends[at])
    }
    /// Returns its rules.
    pub(crate) fn rules(&self) -> &[u32] {
        let ((start, _), (end, _)) = self.bounds();
        &self.all.rules[start as usize..end as usize]
    }
    /// Returns the slots that they mention.
    pub(crate) fn slots(&self) -> &[SlotId] {
        let ((_, start), (_, end)) = self.bounds();
        &self.all.slots[start as usize..end as usize]
    }
}

/// Returns the rules of components, in order, each once.
pub(crate) fn rules_of<'c>(components: impl IntoIterator<Item = &'c Component>) -> Vec<u32> {
    let mut rules: Vec<u32> = Vec::new();
    components.into_iter().for_each(|c| rules.extend_from_slice(c.rules()));
    rules.sort_unstable();
    rules.dedup();
    rules
}

impl PartialEq for Component {
    fn eq(&self, other: &Self) -> bool {
        self.rules() == other.rules() && self.slots() == other.slots()
    }
}
impl Eq for Component {}

impl fmt::Debug for Component {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (rules, slots) = (self.rules(), self.slots());
        f.debug_struct("Component").field("rules", &rules).field("slots", &slots).finish()
    }
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
        let mut first = Vec::with_capacity(structure.slots.len() + 1);
        first.push(0);
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
    /// Returns the coordinates of every place.
    fn all(&self) -> impl Iterator<Item = &[SlotId]> {
        self.first.windows(2).map(|ends| &self.slots[ends[0] as usize..ends[1] as usize])
    }
}

impl Net {
    pub(crate) fn new(structure: &Structure, rules: &Rules) -> Self {
        let n = structure.slots.len();
        // counted two further on, so that where a slot's rules begin can move on to where they end
        let mut first = vec![0; n + 2];
        for slots in rules.mentioned() {
            slots.iter().for_each(|s| first[s.0 as usize + 2] += 1);
        }
        for i in 2..n + 2 {
            first[i] += first[i - 1];
        }
        let mut by_slot = vec![0; first[n + 1] as usize];
        for (i, slots) in (0..).zip(rules.mentioned()) {
            for s in slots {
                let next = &mut first[s.0 as usize + 1];
                by_slot[*next as usize] = i;
                *next += 1;
            }
        }
        first.truncate(n + 1);
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
    ///
    /// Cost: linear in what the rules mention.
    pub(crate) fn all(&self, rules: &Rules, is_fixed: impl Fn(SlotId) -> bool) -> Partition {
        let count = self.places.of.len() as u32;
        let fixed: IdVec<SlotId, bool> = (0..count).map(|s| is_fixed(SlotId(s))).collect();
        let mut groups = Groups::new(fixed.len());
        for slots in rules.mentioned() {
            groups.unite_all(slots.iter().copied().filter(|&s| !fixed[s]));
        }
        let has_rules = |s: SlotId| !self.rules_of(s).is_empty();
        let moves = |s: &SlotId| !fixed[*s] && has_rules(*s);
        for place in self.places.all() {
            groups.unite_all(place.iter().copied().filter(moves));
        }
        let numbers = self.numbered(rules, &fixed, &mut groups);
        let components = self.gathered(rules, &fixed, &numbers);
        Partition { components, of_slot: numbers.of_slot }
    }

    /// Numbers the components in order of their first slot.
    fn numbered(&self, rules: &Rules, fixed: &IdVec<SlotId, bool>, groups: &mut Groups) -> Numbers {
        let mut numbers = Numbers {
            of_slot: IdVec::filled(NONE, fixed.len()),
            of_rule: vec![NONE; rules.len()],
            counts: Vec::new(),
        };
        let counts = &mut numbers.counts;
        let mut number = |known: &mut u32, slots: u32| {
            if *known == NONE {
                *known = counts.len() as u32;
                counts.push((0, 0));
            }
            counts[*known as usize].1 += slots;
            *known
        };
        for (slot, &is_fixed) in (0..).map(SlotId).zip(fixed.as_slice()) {
            let rules_of = self.rules_of(slot);
            if !is_fixed && !rules_of.is_empty() {
                let first = groups.first(slot);
                numbers.of_slot[slot] = number(&mut numbers.of_slot[first], 1);
                continue;
            }
            for &rule in rules_of {
                let moving = rules.slots_of(rule).iter().find(|s| !fixed[**s]);
                let known = match moving {
                    Some(&s) => &mut numbers.of_slot[groups.first(s)],
                    None => &mut numbers.of_rule[rule as usize],
                };
                number(known, 0);
            }
        }
        let Numbers { of_slot, of_rule, counts } = &mut numbers;
        for (slots, of_rule) in rules.mentioned().zip(of_rule) {
            if let Some(&s) = slots.iter().find(|s| !fixed[**s]) {
                *of_rule = of_slot[s];
            }
            if *of_rule != NONE {
                counts[*of_rule as usize].0 += 1;
            }
        }
        numbers
    }

    /// Makes the components from the numbers of their slots and rules.
    fn gathered(
        &self,
        rules: &Rules,
        fixed: &IdVec<SlotId, bool>,
        numbers: &Numbers,
    ) -> Vec<Component> {
        let component = |number: u32| (number != NONE).then_some(number as usize);
        // slots that are fixed may be in several
        let known = match fixed.as_slice().contains(&true) {
            true => self.known(rules, fixed, numbers),
            false => Vec::new(),
        };
        // where there is room for them
        let mut ends = numbers.counts.clone();
        known.iter().for_each(|&(n, _)| ends[n].1 += 1);
        let (mut rule_at, mut slot_at) = (0, 0);
        for (rules, slots) in &mut ends {
            // where the component begins, until it is full
            let count = (*rules, *slots);
            (*rules, *slots) = (rule_at, slot_at);
            (rule_at, slot_at) = (rule_at + count.0, slot_at + count.1);
        }
        let mut all = Components {
            rules: vec![0; rule_at as usize],
            slots: vec![SlotId(0); slot_at as usize],
            ends,
        };
        let put_slot = |all: &mut Components, n: usize, slot: SlotId| {
            all.slots[all.ends[n].1 as usize] = slot;
            all.ends[n].1 += 1;
        };
        for (slot, &n) in (0..).map(SlotId).zip(numbers.of_slot.as_slice()) {
            component(n).into_iter().for_each(|n| put_slot(&mut all, n, slot));
        }
        known.iter().for_each(|&(n, slot)| put_slot(&mut all, n, slot));
        for (index, &n) in (0..).zip(&numbers.of_rule) {
            let Some(n) = component(n) else { continue };
            all.rules[all.ends[n].0 as usize] = index;
            all.ends[n].0 += 1;
        }
        for fixed_of_one in known.chunk_by(|a, b| a.0 == b.0) {
            let n = fixed_of_one[0].0;
            let start = n.checked_sub(1).map_or(0, |before| all.ends[before].1);
            all.slots[start as usize..all.ends[n].1 as usize].sort_unstable();
        }
        all.split()
    }

    /// Returns the fixed slots that components mention, each with the number of the component.
    fn known(
        &self,
        rules: &Rules,
        fixed: &IdVec<SlotId, bool>,
        numbers: &Numbers,
    ) -> Vec<(usize, SlotId)> {
        let mut known: Vec<(usize, SlotId)> = Vec::new();
        for (slot, &n) in numbers.of_slot.iter().filter(|(_, n)| **n != NONE) {
            let place = self.place_of(slot).iter().copied();
            let mentioned = place.filter(|&s| fixed[s] && !self.rules_of(s).is_empty());
            known.extend(mentioned.map(|s| (n as usize, s)));
        }
        for (slots, &n) in rules.mentioned().zip(&numbers.of_rule).filter(|(_, n)| **n != NONE) {
            known.extend(slots.iter().filter(|s| fixed[**s]).map(|&s| (n as usize, s)));
        }
        known.sort_unstable();
        known.dedup();
        known
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
    ) -> Vec<Component> {
        let [rule_seen, slot_seen] = [rules.len(), self.places.of.len()].map(Seen::new);
        Walk { net: self, rules, is_fixed, rule_seen, slot_seen, tied }.around(slots)
    }
}

/// No component.
const NONE: u32 = u32::MAX;

/// Every component of a document.
#[derive(Debug)]
pub(crate) struct Partition {
    /// In order of their first slot.
    pub(crate) components: Vec<Component>,
    /// For every slot that is not fixed, its component; none for one that no rule mentions.
    of_slot: IdVec<SlotId, u32>,
}

impl Partition {
    /// Returns the components of these slots, as [`Net::around`] finds them; nothing where that has to be asked:
    /// where one of them is fixed or no rule speaks of it, or `tied` ties several components together.
    pub(crate) fn around<'t>(
        &self,
        slots: impl IntoIterator<Item = SlotId>,
        tied: impl IntoIterator<Item = &'t [SlotId]>,
    ) -> Option<Vec<Component>> {
        for tied in tied {
            let mut numbers = tied.iter().map(|&s| self.of_slot[s]);
            let first = numbers.next();
            if numbers.any(|number| Some(number) != first) {
                return None;
            }
        }
        let mut seen = Seen::new(self.components.len());
        let mut found = Vec::new();
        for slot in slots {
            let number = self.of_slot[slot];
            let component = self.components.get(number as usize)?;
            if seen.insert(number) {
                found.push(component.clone());
            }
        }
        Some(found)
    }
}

/// The components of slots that are not fixed, and of rules.
struct Numbers {
    of_slot: IdVec<SlotId, u32>,
    of_rule: Vec<u32>,
    /// How many rules, and how many slots that are not fixed, each component has.
    counts: Vec<(u32, u32)>,
}

/// Slots in disjoint groups, each known by its first.
pub(crate) struct Groups(IdVec<SlotId, SlotId>);

impl Groups {
    pub(crate) fn new(slots: usize) -> Self {
        Self((0..slots as u32).map(SlotId).collect())
    }
    pub(crate) fn first(&mut self, slot: SlotId) -> SlotId {
        let mut at = slot;
        while self.0[at] != at {
            let next = self.0[self.0[at]];
            self.0[at] = next;
            at = next;
        }
        at
    }
    /// Puts slots into one group.
    pub(crate) fn unite_all(&mut self, mut slots: impl Iterator<Item = SlotId>) {
        let Some(first) = slots.next() else { return };
        let mut all = self.first(first);
        for slot in slots {
            let other = self.first(slot);
            if other != all {
                self.0[all.max(other)] = all.min(other);
                all = all.min(other);
            }
        }
    }
}

/// The numbers that were met, a bit for each.
struct Seen(Vec<u64>);

impl Seen {
    fn new(count: usize) -> Self {
        Self(vec![0; count.div_ceil(64)])
    }
    /// Notes a number; true the first time.
    fn insert(&mut self, number: u32) -> bool {
        let bits = &mut self.0[number as usize / 64];
        let bit = 1 << (number % 64);
        let is_new = *bits & bit == 0;
        *bits |= bit;
        is_new
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

/// A component on the way, and what was reached and not yet looked at.
#[derive(Default)]
struct Found {
    /// Its rules and slots.
    component: (Vec<u32>, Vec<SlotId>),
    fixed: Vec<SlotId>,
    slots: Vec<SlotId>,
    rules: Vec<u32>,
}

impl Walk<'_> {
    fn around(mut self, slots: impl IntoIterator<Item = SlotId>) -> Vec<Component> {
        let mut components = Vec::new();
        for slot in slots {
            if !(self.is_fixed)(slot) {
                let mut found = Found::default();
                self.reach(slot, &mut found);
                components.extend(self.complete(found));
                continue;
            }
            for &rule in self.net.rules_of(slot) {
                if self.rule_seen.insert(rule) {
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
        } else if self.slot_seen.insert(slot.0) {
            found.slots.push(slot);
        }
    }

    fn complete(&mut self, mut found: Found) -> Option<Component> {
        let net = self.net;
        loop {
            while let Some(rule) = found.rules.pop() {
                found.component.0.push(rule);
                for &s in self.rules.get(rule).slots {
                    self.reach(s, &mut found);
                }
            }
            let Some(slot) = found.slots.pop() else { break };
            found.component.1.push(slot);
            for &rule in net.rules_of(slot) {
                if self.rule_seen.insert(rule) {
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
        let Found { component: (mut rules, mut slots), fixed, .. } = found;
        if slots.is_empty() && rules.is_empty() {
            return None;
        }
        slots.extend(fixed);
        slots.sort_unstable();
        slots.dedup();
        rules.sort_unstable();
        Some(Component::of(rules, slots))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rule::{Body, Shape, Source};
    use base::Dice;
    use base::number::Tolerance;
    use kernel::{Form, Primitive, Slot};
    use solve::Level;

    /// A stay of so many slots.
    fn held(count: u32) -> Shape {
        Shape {
            level: Level::WeakStay,
            body: Body::Hold((0..count).collect()),
            methods: Vec::new(),
            derived: true,
            reads: Vec::new(),
            within: Tolerance::Relative,
            when: Vec::new(),
        }
    }

    fn structure(dice: &mut Dice, slots: u32) -> Structure {
        let (mut form, mut things) = (Form::default(), IdVec::new());
        for i in 0..slots {
            // some slots are the coordinates of one place, not always side by side
            let place = (dice.below(3) == 0).then(|| ThingId(dice.below(slots as usize) as u32));
            let thing = ThingId(i);
            things.push(kernel::Thing {
                class: kernel::ClassId(0),
                owner: None,
                field: 0,
                first_part: thing,
                parts: 0,
            });
            let (primitive, given, anchored) = (Primitive::Integer, None, dice.below(5) == 0);
            form.slots.push(Slot { thing, primitive, given, anchored, is_layout: false, place });
        }
        form.things = Rc::new(things);
        Structure { form: Rc::new(form), ..Structure::default() }
    }

    #[test]
    fn all_components_are_those_around_every_slot() {
        let mut dice = Dice::new(1);
        let (mut several, mut looked_up) = (0, 0);
        for _ in 0..300 {
            let slots = 2 + dice.below(12) as u32;
            let structure = structure(&mut dice, slots);
            let mut rules = Rules::default();
            for i in 0..dice.below(8) as u32 {
                let mut mentioned: Vec<SlotId> = (0..1 + dice.below(3) as u32)
                    .map(|_| SlotId(dice.below(slots as usize) as u32))
                    .collect();
                mentioned.sort_unstable();
                mentioned.dedup();
                let shape = rules.add_shape(held(mentioned.len() as u32));
                rules.add(Source::Stay(i), shape, mentioned);
            }
            let net = Net::new(&structure, &rules);
            let is_fixed = |s: SlotId| structure.slots[s].anchored;
            let every = structure.slots.ids().filter(|&s| !net.rules_of(s).is_empty());
            let around = net.around(every, &rules, &is_fixed, &[]);
            several += usize::from(around.len() > 1);
            let all = net.all(&rules, is_fixed);
            for slot in structure.slots.ids() {
                let other = SlotId(dice.below(slots as usize) as u32);
                let tied = [vec![slot, other]];
                if let Some(found) = all.around([slot], tied.iter().map(Vec::as_slice)) {
                    assert_eq!(found, net.around([slot], &rules, &is_fixed, &tied));
                    looked_up += 1;
                }
            }
            assert_eq!(all.components, around, "{rules:?} {structure:?}");
        }
        assert!(several > 100, "{several} documents of several components");
        assert!(looked_up > 300, "{looked_up} components were known");
    }
}
