//! The structure: every thing of a document, what it is part of, what it is merged with.

use crate::class::{ClassId, Primitive};
use crate::document::{Document, PartRef, PartRole};
use crate::path::{Path, Step};
use crate::term::{OriginId, Term};
use base::{IdVec, Name};
use std::collections::BTreeMap;
use std::rc::Rc;

base::define_id!(ThingId, "t", "A thing: the document, a part, a part of a part, a number.");
base::define_id!(SlotId, "s", "Where the value of a primitive thing is stored.");

/// A thing, before merging: one for every path of the document.
#[derive(Clone, Debug)]
pub struct Thing {
    /// Its class.
    pub class: ClassId,
    /// What it is a part of; none for the document.
    pub owner: Option<ThingId>,
    /// Which field of its owner it is: the index in the owner's layout, or in its list.
    pub field: u32,
    /// Its first part; the others follow. Parts of a thing have consecutive ids.
    pub first_part: ThingId,
    /// How many parts it has.
    pub parts: u32,
}

/// A slot: the value of a primitive thing, or of several merged ones.
#[derive(Clone, Debug)]
pub struct Slot {
    /// The first thing, by declaration, that has it.
    pub thing: ThingId,
    /// What it holds.
    pub primitive: Primitive,
    /// Its given value, if it has one: a term, and the thing that is `Me` in it.
    pub given: Option<GivenIn>,
    /// True if an anchor holds it.
    pub anchored: bool,
    /// The place that it is a coordinate of, named by that place's thing.
    pub place: Option<ThingId>,
    /// The values that an integer may take.
    pub range: Option<(i64, i64)>,
}

/// A given value in its context.
#[derive(Clone, Debug)]
pub struct GivenIn {
    /// The value.
    pub value: Term,
    /// The thing that the value is in terms of.
    pub me: ThingId,
    /// Where it was written; for a coordinate of `(3, 4)`, where the whole was.
    pub origin: OriginId,
}

/// A constraint of a thing.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct ConstraintInstance {
    /// The thing that it constrains.
    pub owner: ThingId,
    /// The class that declares it.
    pub class: ClassId,
    /// Its index among that class's constraints.
    pub index: u32,
}

/// A declared stay of a thing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct StayInstance {
    /// The thing that stays.
    pub thing: ThingId,
    /// How strongly; `None` for an anchor.
    pub strength: Option<crate::class::Strength>,
}

/// All things of a document.
#[derive(Clone, Debug, Default)]
pub struct Structure {
    /// Every thing, the document first; an owner before its parts, in order of declaration.
    pub things: IdVec<ThingId, Thing>,
    /// For every thing, the first thing that it is merged with (itself where it is not).
    pub merged: IdVec<ThingId, ThingId>,
    /// For every primitive thing, its slot.
    pub slot_of: IdVec<ThingId, Option<SlotId>>,
    /// Every slot, in order of declaration of its first thing.
    pub slots: IdVec<SlotId, Slot>,
    /// Every constraint, in order of declaration, each merged one once.
    pub constraints: Vec<ConstraintInstance>,
    /// Declared stays and anchors.
    pub stays: Vec<StayInstance>,
    /// The members of every set, by the set's first thing, in order of declaration, merged ones once.
    pub sets: BTreeMap<ThingId, Vec<ThingId>>,
    /// For every first thing of a merge, all things merged with it, itself first.
    pub merges: BTreeMap<ThingId, Vec<ThingId>>,
    /// The layout of every class that has things.
    pub layouts: BTreeMap<ClassId, Rc<Layout>>,
}

/// The fields of a class's instances, and where each name stands.
#[derive(Clone, Debug)]
pub struct Layout {
    /// The fields, in order.
    pub fields: Vec<PartRef>,
    /// The index of the first field of each name.
    pub index: BTreeMap<Name, u32>,
    /// The indices of fields that stand for superclasses other than the primary one.
    pub superclasses: Vec<u32>,
    /// The names by which the thing itself is reached as its primary superclasses.
    pub own_names: Vec<Name>,
}

impl Layout {
    /// Makes the layout of a class.
    pub fn new(document: &Document, class: ClassId) -> Self {
        let fields = document.layout(class);
        let mut index = BTreeMap::new();
        let mut superclasses = Vec::new();
        for (i, &field) in fields.iter().enumerate() {
            index.entry(document.field_name(field).clone()).or_insert(i as u32);
            if field.role == PartRole::Superclass {
                superclasses.push(i as u32);
            }
        }
        let line = document.primary_line(class).into_iter().map(|c| &document.classes[c].supers);
        let own_names = line.filter(|s| s.len() > 1).map(|s| s[0].name.clone()).collect();
        Self { fields, index, superclasses, own_names }
    }
}

/// A path that leads nowhere.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Astray {
    /// The index of the first step that leads nowhere.
    pub step: usize,
    /// The thing where it was taken.
    pub at: ThingId,
}

/// The document's own thing.
pub const DOCUMENT: ThingId = ThingId(0);

impl Structure {
    /// Returns the parts of a thing, in order.
    pub fn parts(
        &self,
        thing: ThingId,
    ) -> impl DoubleEndedIterator<Item = ThingId> + ExactSizeIterator + use<> {
        let t = &self.things[thing];
        let (first, n) = (t.first_part.0, t.parts);
        (0..n).map(move |i| ThingId(first + i))
    }
    /// Returns the first thing that `thing` is merged with: its identity.
    pub fn identity(&self, thing: ThingId) -> ThingId {
        self.merged[thing]
    }
    /// Returns everything that is merged with `thing`, the first first; itself alone where nothing is.
    pub fn merged_with(&self, thing: ThingId) -> Vec<ThingId> {
        let first = self.merged[thing];
        self.merges.get(&first).cloned().unwrap_or_else(|| vec![first])
    }
    /// Returns the name of the field that a thing is, or nothing for the document and list elements.
    pub fn field_name<'d>(&self, document: &'d Document, thing: ThingId) -> Option<&'d Name> {
        let owner = self.things[thing].owner?;
        let layout = self.layouts.get(&self.things[owner].class)?;
        layout.fields.get(self.things[thing].field as usize).map(|&f| document.field_name(f))
    }
    /// Returns the part of `thing` named `name`, looking at what it is merged with as well.
    ///
    /// A bare name means the primary line's part, else the only other superclass's that has it.
    pub fn part_named(&self, thing: ThingId, name: &str) -> Option<ThingId> {
        let own = self.own_part_named(thing, name);
        if own.is_some() {
            return own;
        }
        let alike = self.merges.get(&self.merged[thing])?;
        alike.iter().find_map(|&t| self.own_part_named(t, name))
    }
    fn own_part_named(&self, thing: ThingId, name: &str) -> Option<ThingId> {
        let layout = self.layouts.get(&self.things[thing].class)?;
        let part = |i: u32| ThingId(self.things[thing].first_part.0 + i);
        if let Some(&i) = layout.index.get(&Name::new(name)) {
            return Some(part(i));
        }
        if layout.own_names.iter().any(|n| *n == name) {
            return Some(thing);
        }
        let mut found =
            layout.superclasses.iter().filter_map(|&i| self.own_part_named(part(i), name));
        let first = found.next()?;
        found.all(|t| self.merged[t] == self.merged[first]).then_some(first)
    }
    /// Follows a path from a thing.
    ///
    /// # Errors
    /// The first step that leads nowhere, and the thing where it was taken.
    pub fn follow(&self, from: ThingId, path: &Path) -> Result<ThingId, Astray> {
        let mut at = from;
        for (i, step) in path.0.iter().enumerate() {
            let next = match step {
                Step::Part(name) => self.part_named(at, name),
                Step::Index(n) => self.parts(at).nth(*n as usize),
                Step::Last => self.parts(at).next_back(),
                Step::Owner => self.things[at].owner,
            };
            at = next.ok_or(Astray { step: i, at })?;
        }
        Ok(at)
    }
    /// Returns the path from the document to a thing.
    pub fn path(&self, document: &Document, thing: ThingId) -> Path {
        let mut steps = Vec::new();
        let mut at = thing;
        while let Some(owner) = self.things[at].owner {
            steps.push(match self.field_name(document, at) {
                Some(name) => Step::Part(name.clone()),
                None => Step::Index(self.things[at].field),
            });
            at = owner;
        }
        steps.reverse();
        Path(steps)
    }
    /// Returns the slots of a thing and of all its parts, in order of declaration.
    pub fn slots_under(&self, thing: ThingId) -> Vec<SlotId> {
        let mut slots = Vec::new();
        let mut stack = vec![thing];
        while let Some(t) = stack.pop() {
            match self.slot_of[t] {
                Some(slot) => slots.push(slot),
                None => stack.extend(self.parts(t).rev()),
            }
        }
        slots
    }
}
