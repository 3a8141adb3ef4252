//! Reach: how a rule comes to the things that it speaks of.
//!
//! Whatever symbolic evaluation asks of the structure it asks here, and each answer is noted as a
//! step: the third part of the owner, four members of the set. Another thing of the same class for
//! which the same steps lead to things of the same classes says the same of those.

use base::{IdVec, Mixer};
use indexmap::{IndexMap, IndexSet};
use kernel::{ClassId, DOCUMENT, Path, SlotId, Step as PathStep, Structure, ThingId};
use solve::Span;
use std::hash::BuildHasherDefault;

/// A thing that was reached, by its number: the owner is the first.
pub(crate) type Reached = u32;

/// How things are reached from those reached before.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Step {
    /// The document itself.
    Document,
    /// What a thing is a part of.
    Owner(Reached),
    /// One part, by its place.
    Part(Reached, u32),
    /// All parts, and there are so many.
    Parts(Reached, u32),
    /// That a list has so many elements.
    Count(Reached, u32),
    /// One element of a list, by its place.
    Element(Reached, u32),
    /// All members of a set, and there are so many.
    Members(Reached, u32),
    /// What a reference names.
    Referent(Reached),
    /// Two things are one, or not.
    Same(Reached, Reached, bool),
}

/// The structure as one rule meets it.
#[derive(Debug)]
pub(crate) struct Reach<'a> {
    structure: &'a Structure,
    things: Vec<ThingId>,
    number: IndexMap<ThingId, Reached, BuildHasherDefault<Mixer>>,
    steps: IndexSet<Step, BuildHasherDefault<Mixer>>,
    stored: Vec<(Reached, SlotId)>,
    is_repeatable: bool,
}

/// The ways to everything that rules speak of, for other things to go.
#[derive(Debug, Default)]
pub(crate) struct Routes {
    classes: Vec<ClassId>,
    unlike: Vec<(Reached, ClassId)>,
    steps: Vec<Step>,
    parts: Vec<(Reached, u32)>,
    stored: Vec<Reached>,
    again: Vec<(Reached, u32)>,
}

/// One of them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Route {
    /// The class of the thing where it begins.
    owner: ClassId,
    classes: Span,
    /// The classes of what is merged with things unlike it, which answers messages too.
    unlike: Span,
    way: Way,
    /// Where slots were met for the first time.
    stored: Span,
    /// Where a slot was met again: its place among the stored.
    again: Span,
}

/// The steps of a route.
#[derive(Clone, Copy, Debug)]
enum Way {
    /// From things to parts of theirs alone: what a thing has for parts, its class says.
    Parts(Span),
    /// Any.
    Steps(Span),
}

/// Adds a list to others; returns where it is.
fn put<T>(all: &mut Vec<T>, own: impl IntoIterator<Item = T>) -> Span {
    let start = all.len() as u32;
    all.extend(own);
    Span { start, len: all.len() as u32 - start }
}

impl<'a> Reach<'a> {
    pub(crate) fn new(structure: &'a Structure) -> Self {
        Self {
            structure,
            things: Vec::new(),
            number: IndexMap::default(),
            steps: IndexSet::default(),
            stored: Vec::new(),
            is_repeatable: true,
        }
    }
    /// Begins anew at the owner of another rule.
    pub(crate) fn begin(&mut self, owner: ThingId) {
        self.things.clear();
        self.number.clear();
        self.steps.clear();
        self.stored.clear();
        self.is_repeatable = true;
        self.found(owner);
    }

    fn found(&mut self, thing: ThingId) {
        let number = self.things.len() as Reached;
        self.things.push(thing);
        // the last way counts: every way is noted
        self.number.insert(thing, number);
    }
    fn number_of(&mut self, thing: ThingId) -> Reached {
        if let Some(&number) = self.number.get(&thing) {
            return number;
        }
        // nobody said how it was come by
        self.is_repeatable = false;
        0
    }
    fn step(&mut self, step: Step, found: impl IntoIterator<Item = ThingId>) {
        if self.is_repeatable && self.steps.insert(step) {
            for thing in found {
                let known = self.number.get(&thing).copied();
                self.found(thing);
                if let Some(known) = known {
                    let now = self.things.len() as Reached - 1;
                    self.steps.insert(Step::Same(known, now, true));
                }
            }
        }
    }

    /// Returns the document.
    pub(crate) fn document(&mut self) -> ThingId {
        self.step(Step::Document, [DOCUMENT]);
        DOCUMENT
    }
    /// Returns what a thing is a part of.
    pub(crate) fn owner(&mut self, thing: ThingId) -> Option<ThingId> {
        let owner = self.structure.owner(thing)?;
        let from = self.number_of(thing);
        self.step(Step::Owner(from), [owner]);
        Some(owner)
    }
    /// Returns the part of a thing that has this name.
    pub(crate) fn part_named(&mut self, thing: ThingId, name: &str) -> Option<ThingId> {
        let part = self.structure.part_named(thing, name)?;
        self.descend(thing, part);
        Some(part)
    }
    /// Notes the way from a thing to a part of a part of it.
    fn descend(&mut self, thing: ThingId, part: ThingId) {
        if thing == part || !self.is_repeatable {
            return;
        }
        let t = &self.structure.things[part];
        let Some(owner) = t.owner.filter(|_| part > thing) else {
            self.is_repeatable = false;
            return;
        };
        self.descend(thing, owner);
        let place = part.0 - self.structure.things[owner].first_part.0;
        let from = self.number_of(owner);
        self.step(Step::Part(from, place), [part]);
    }
    /// Returns what a reference names.
    pub(crate) fn referent(&mut self, reference: ThingId) -> Option<ThingId> {
        let target = self.structure.references.get(&reference).copied()?;
        let from = self.number_of(reference);
        self.step(Step::Referent(from), [target]);
        Some(target)
    }
    /// Returns the parts of a thing, in order.
    pub(crate) fn parts(&mut self, thing: ThingId) -> Vec<ThingId> {
        let parts: Vec<ThingId> = self.structure.parts(thing).collect();
        let from = self.number_of(thing);
        self.step(Step::Parts(from, parts.len() as u32), parts.iter().copied());
        parts
    }
    /// Returns how many elements a list has.
    pub(crate) fn count(&mut self, list: ThingId) -> usize {
        let count = self.structure.parts(list).len();
        let from = self.number_of(list);
        self.step(Step::Count(from, count as u32), []);
        count
    }
    /// Returns the element of a list at a place that it has.
    pub(crate) fn element(&mut self, list: ThingId, at: usize) -> ThingId {
        let element = ThingId(self.structure.things[list].first_part.0 + at as u32);
        let from = self.number_of(list);
        self.step(Step::Element(from, at as u32), [element]);
        element
    }
    /// Returns the members of a set.
    pub(crate) fn members(&mut self, set: ThingId) -> Vec<ThingId> {
        let members = members(self.structure, set).to_vec();
        let from = self.number_of(set);
        self.step(Step::Members(from, members.len() as u32), members.iter().copied());
        members
    }
    /// Returns true if two things are one.
    pub(crate) fn is_same(&mut self, a: ThingId, b: ThingId) -> bool {
        let same = self.structure.merged[a] == self.structure.merged[b];
        let (i, j) = (self.number_of(a), self.number_of(b));
        self.step(Step::Same(i, j, same), []);
        same
    }
    /// Returns the slot of a thing, if it is primitive.
    pub(crate) fn slot(&mut self, thing: ThingId) -> Option<SlotId> {
        let slot = self.structure.slot_of(thing)?;
        let number = self.number_of(thing);
        self.stored.push((number, slot));
        Some(slot)
    }
    /// Returns the slots of a thing and of all its parts, in order of declaration.
    pub(crate) fn slots_under(&mut self, thing: ThingId) -> Vec<SlotId> {
        let mut slots = Vec::new();
        let mut stack = vec![thing];
        while let Some(t) = stack.pop() {
            match self.slot(t) {
                Some(slot) => slots.push(slot),
                None => stack.extend(self.parts(t).into_iter().rev()),
            }
        }
        slots
    }
    /// Follows a path from a thing.
    pub(crate) fn follow(&mut self, from: ThingId, path: &Path) -> Option<ThingId> {
        let mut at = from;
        for step in &path.0 {
            at = match step {
                PathStep::Part(name) => self.part_named(at, name)?,
                PathStep::Index(n) => {
                    let at_place = Some(*n as usize).filter(|&n| n < self.count(at))?;
                    self.element(at, at_place)
                }
                PathStep::Last => {
                    let last = self.count(at).checked_sub(1)?;
                    self.element(at, last)
                }
                PathStep::Owner => self.owner(at)?,
            };
            at = self.referent(at).unwrap_or(at);
        }
        Some(at)
    }
    /// Says that the rule looks at more of the document than is noted.
    pub(crate) fn looks_around(&mut self) {
        self.is_repeatable = false;
    }

    /// Adds the way that was gone, for others of its class; the slots that it led to are put in `slots`.
    /// None where it cannot be gone again.
    pub(crate) fn route(&self, routes: &mut Routes, slots: &mut Vec<SlotId>) -> Option<Route> {
        if !self.is_repeatable {
            return None;
        }
        let mut place: IndexSet<SlotId, BuildHasherDefault<Mixer>> = IndexSet::default();
        let mut again = Vec::new();
        let stored = routes.stored.len() as u32;
        for &(number, slot) in &self.stored {
            match place.insert_full(slot) {
                (at, false) => again.push((number, at as u32)),
                (_, true) => routes.stored.push(number),
            }
        }
        slots.clear();
        slots.extend(place);
        again.sort_unstable();
        again.dedup();
        let class = |t: &ThingId| self.structure.things[*t].class;
        let others = |(n, &t)| self.structure.unlike(t).iter().map(move |t| (n, class(t)));
        let part = |step: &Step| {
            let Step::Part(n, place) = *step else { return None };
            Some((n, place))
        };
        let way = match self.steps.iter().map(part).collect::<Option<Vec<_>>>() {
            Some(parts) => Way::Parts(put(&mut routes.parts, parts)),
            None => Way::Steps(put(&mut routes.steps, self.steps.iter().copied())),
        };
        Some(Route {
            owner: class(self.things.first()?),
            way,
            classes: put(&mut routes.classes, self.things.iter().map(class)),
            unlike: put(&mut routes.unlike, (0..).zip(&self.things).flat_map(others)),
            stored: Span { start: stored, len: slots.len() as u32 },
            again: put(&mut routes.again, again),
        })
    }
}

fn members(structure: &Structure, set: ThingId) -> &[ThingId] {
    structure.sets.get(&structure.merged[set]).map_or(&[], |m| m)
}

/// Where a way led; serves any number of ways of one structure, one after the other.
#[derive(Debug)]
pub(crate) struct Trail {
    things: Vec<ThingId>,
    /// The slots that it led to, each once.
    pub(crate) slots: Vec<SlotId>,
    /// For every slot, the way that met it last.
    met: IdVec<SlotId, u32>,
    way: u32,
}

impl Trail {
    pub(crate) fn new(structure: &Structure) -> Self {
        // a rule speaks of a handful of things, as a rule
        let (things, slots) = (Vec::with_capacity(32), Vec::with_capacity(32));
        Self { things, slots, met: IdVec::filled(0, structure.slots.len()), way: 0 }
    }
    fn begin(&mut self) {
        self.things.clear();
        self.slots.clear();
        self.way += 1;
    }
}

impl Routes {
    /// Goes a way from another thing; where it leads is left in `trail`. False where something on the way is
    /// not as it was.
    pub(crate) fn follow(
        &self,
        route: &Route,
        structure: &Structure,
        owner: ThingId,
        trail: &mut Trail,
    ) -> bool {
        trail.begin();
        let class = |t: ThingId| structure.things[t].class;
        if class(owner) != route.owner {
            return false;
        }
        trail.things.push(owner);
        let holds = match route.way {
            Way::Parts(parts) => self.go_to_parts(parts, structure, &mut trail.things),
            Way::Steps(steps) => {
                let classes = &self.classes[route.classes.range()];
                self.go(steps, classes, structure, &mut trail.things)
            }
        };
        if !holds {
            return false;
        }
        let Trail { things, slots, met, way } = trail;
        let mut unlike = self.unlike[route.unlike.range()].iter();
        for (number, &thing) in (0..).zip(&*things) {
            for &other in structure.unlike(thing) {
                if unlike.next() != Some(&(number, class(other))) {
                    return false;
                }
            }
        }
        if unlike.next().is_some() {
            return false;
        }
        let slot = |n: Reached| structure.slot_of(things[n as usize]);
        for &n in &self.stored[route.stored.range()] {
            let Some(slot) = slot(n) else { return false };
            if std::mem::replace(&mut met[slot], *way) == *way {
                return false;
            }
            slots.push(slot);
        }
        let again = &self.again[route.again.range()];
        again.iter().all(|&(n, at)| slot(n) == Some(slots[at as usize]))
    }

    /// Goes from things to parts of theirs; false where one is not there.
    fn go_to_parts(&self, parts: Span, structure: &Structure, things: &mut Vec<ThingId>) -> bool {
        let all = structure.things.as_slice();
        for &(n, place) in &self.parts[parts.range()] {
            let t = &all[things[n as usize].0 as usize];
            if place >= t.parts {
                return false;
            }
            things.push(ThingId(t.first_part.0 + place));
        }
        true
    }

    /// Takes steps; false where one leads elsewhere than to a thing of its class.
    fn go(
        &self,
        steps: Span,
        classes: &[ClassId],
        structure: &Structure,
        things: &mut Vec<ThingId>,
    ) -> bool {
        let fits = |thing: ThingId, number: usize| structure.things[thing].class == classes[number];
        for step in &self.steps[steps.range()] {
            let of = |n: Reached| things[n as usize];
            let at = things.len();
            let holds = match *step {
                Step::Part(n, place) => {
                    let t = &structure.things[of(n)];
                    things.push(ThingId(t.first_part.0 + place));
                    place < t.parts
                }
                Step::Same(a, b, same) => {
                    (structure.merged[of(a)] == structure.merged[of(b)]) == same
                }
                Step::Document => {
                    things.push(DOCUMENT);
                    fits(DOCUMENT, at)
                }
                Step::Owner(n) => {
                    let owner = structure.owner(of(n)).filter(|&owner| fits(owner, at));
                    things.extend(owner);
                    owner.is_some()
                }
                Step::Parts(n, count) => {
                    let parts = structure.parts(of(n));
                    let is_like = parts.len() == count as usize;
                    things.extend(parts);
                    is_like
                }
                Step::Count(n, count) => structure.parts(of(n)).len() == count as usize,
                Step::Element(n, place) => {
                    let list = &structure.things[of(n)];
                    let element = ThingId(list.first_part.0 + place);
                    things.push(element);
                    place < list.parts && fits(element, at)
                }
                Step::Members(n, count) => {
                    let members = members(structure, of(n));
                    things.extend_from_slice(members);
                    members.len() == count as usize
                        && members.iter().zip(at..).all(|(&t, number)| fits(t, number))
                }
                Step::Referent(n) => {
                    let target = structure.references.get(&of(n)).filter(|&&t| fits(t, at));
                    things.extend(target);
                    target.is_some()
                }
            };
            if !holds {
                return false;
            }
        }
        true
    }
}
