//! The structure: every thing of a document, what it is part of, what it is merged with.

use crate::class::{ClassId, Primitive, Strength, Switch};
use crate::document::{Document, PartRef, PartRole, SideWay};
use crate::instantiate::Grown;
use crate::path::{Path, Step};
use crate::term::{OriginId, Term};
use base::number::Toward;
use base::{IdVec, Name};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Deref;
use std::rc::Rc;

base::define_id!(ThingId, "t", "A thing: the document, a part, a part of a part, a number.");
base::define_id!(SlotId, "s", "Where the value of a primitive thing is stored.");
base::define_id!(GivenId, "g", "A given value: one for all things that get it from their class.");

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
    /// Its given value, if it has one.
    pub given: Option<GivenIn>,
    /// True if an anchor holds it.
    pub anchored: bool,
    /// True if it only says where something is drawn: every part that has it is of layout, or of a whole that is.
    pub is_layout: bool,
    /// The place that it is a coordinate of, named by that place's thing.
    pub place: Option<ThingId>,
}

/// A given value in its context.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct GivenIn {
    /// The value.
    pub value: GivenId,
    /// The thing that the value is in terms of: `Me` in its term.
    pub me: ThingId,
}

/// A given value as it was written, or what a part gets of one: a coordinate of `(3, 4)`.
#[derive(Clone, PartialEq, Debug)]
pub struct GivenTerm {
    /// The value; shared by structures that follow one another.
    pub term: Rc<Term>,
    /// Where it was written; for a coordinate of `(3, 4)`, where the whole was.
    pub origin: OriginId,
    /// True if a class gives it to all its things, false if the document says so itself.
    pub of_class: bool,
    /// True if it is what a part gets of another thing that is given to the whole: a copy's part.
    pub of_copy: bool,
}

/// What a part of a copy begins with.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Copied {
    /// What it is a copy of: something computed, and no copy itself.
    pub of: SlotId,
    /// What it would be given.
    pub value: GivenId,
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
    pub strength: Option<Strength>,
}

/// All things of a document: their form, and what values they are given.
///
/// What the form has is read as the structure's own: `structure.things`.
#[derive(Clone, Debug, Default)]
pub struct Structure {
    /// Everything but the given values. An edit that changes constants alone leaves it as it is.
    pub form: Rc<Form>,
    /// The given values of slots.
    pub givens: Rc<Givens>,
}

/// The given values of slots, and what coordinates get of them.
pub type Givens = IdVec<GivenId, GivenTerm>;

impl Deref for Structure {
    type Target = Form;
    fn deref(&self) -> &Form {
        &self.form
    }
}

/// Stands for the slot of a thing that has none: half the memory of an `Option`.
pub(crate) const NO_SLOT: SlotId = SlotId(u32::MAX);

impl Form {
    /// Returns the slot of a primitive thing; nothing for others.
    pub fn slot_of(&self, thing: ThingId) -> Option<SlotId> {
        Some(self.own_slots[thing]).filter(|&slot| slot != NO_SLOT)
    }
}

impl Structure {
    /// Returns the given value of a slot.
    pub fn given(&self, slot: SlotId) -> Option<&GivenTerm> {
        self.given_in(slot).map(|(given, _)| given)
    }
    /// Returns what a thing is given by itself, the document's own merges of it left aside.
    pub fn given_apart(&self, thing: ThingId) -> Option<&GivenTerm> {
        self.given_apart_in(thing).map(|(given, _)| given)
    }
    /// The same, and the thing that it is in terms of.
    pub fn given_apart_in(&self, thing: ThingId) -> Option<(&GivenTerm, ThingId)> {
        let given = self.grown.as_ref()?.given(thing)?;
        Some((&self.givens[given.value], given.me))
    }
    /// Returns the given value of a slot, and the thing that this is in terms of.
    pub fn given_in(&self, slot: SlotId) -> Option<(&GivenTerm, ThingId)> {
        self.slots[slot].given.map(|g| (&self.givens[g.value], g.me))
    }
}

/// The form of a document: its things, what they are merged with, their slots, and what constrains them.
#[derive(Clone, Debug, Default)]
pub struct Form {
    /// Every thing, the document first; an owner before its parts, in order of declaration.
    pub things: Rc<IdVec<ThingId, Thing>>,
    /// For every thing, the first thing that it is merged with (itself where it is not).
    pub merged: Rc<IdVec<ThingId, ThingId>>,
    /// For every thing, the next that it is merged with, in order of declaration; the first again
    /// after the last.
    pub(crate) next_merged: IdVec<ThingId, ThingId>,
    pub(crate) unlike: Unlike,
    /// For every primitive thing, its slot; [`NO_SLOT`] for others. It is asked by [`Form::slot_of`].
    pub(crate) own_slots: IdVec<ThingId, SlotId>,
    /// Every slot, in order of declaration of its first thing.
    pub slots: IdVec<SlotId, Slot>,
    /// The values that an integer may take, for slots where that is written.
    pub ranges: BTreeMap<SlotId, (i64, i64)>,
    /// Every constraint, in order of declaration, each merged one once.
    pub constraints: Rc<Vec<ConstraintInstance>>,
    /// What bindings say: slots that are given by others at all times, and have no given value.
    pub bound: BTreeSet<SlotId>,
    /// Parts of copies that stand for what is computed, and are given nothing.
    pub copied: BTreeMap<SlotId, Copied>,
    /// The constraints that are switched off.
    pub off: BTreeSet<ConstraintInstance>,
    /// The constraints that hold only while something else is true.
    pub conditions: BTreeMap<ConstraintInstance, Condition>,
    /// How strong constraints are that were declared stronger or weaker.
    pub strengths: BTreeMap<ConstraintInstance, Strength>,
    /// Declared stays and anchors.
    pub stays: Vec<StayInstance>,
    /// Which way slots go that stand where two branches meet, for those of which it is written.
    pub sides: BTreeMap<SlotId, Toward>,
    /// The members of every set, by the set's first thing, in order of declaration, merged ones once.
    pub sets: BTreeMap<ThingId, Vec<ThingId>>,
    /// What references name, for those that name something. No target is a reference.
    pub references: BTreeMap<ThingId, ThingId>,
    /// The layout of every class that has things.
    pub(crate) layouts: Layouts,
    /// The things as they were before the document's own class spoke of them; none where that had faults.
    pub(crate) grown: Option<Rc<Grown>>,
    /// True if all could be made as it is written.
    pub(crate) is_faultless: bool,
}

/// Merges of things of several classes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Unlike {
    /// For every thing, one more than the place of its merge; zero where all are of its class. Empty where
    /// there is no such merge.
    place: IdVec<ThingId, u32>,
    /// Of every such merge, the first thing of each class, in order.
    merges: Vec<Vec<ThingId>>,
}

impl Unlike {
    /// Takes the merges, each with its first thing; `merged` names for every thing the first that it is merged
    /// with.
    pub(crate) fn new(
        merges: impl Iterator<Item = (ThingId, Vec<ThingId>)>,
        merged: &IdVec<ThingId, ThingId>,
    ) -> Self {
        let (firsts, merges): (Vec<ThingId>, Vec<_>) = merges.unzip();
        if merges.is_empty() {
            return Self::default();
        }
        let mut place = IdVec::filled(0, merged.len());
        firsts.iter().zip(1..).for_each(|(&first, at)| place[first] = at);
        for (thing, &first) in merged.iter().filter(|(thing, first)| thing != *first) {
            place[thing] = place[first];
        }
        Self { place, merges }
    }
    fn of(&self, thing: ThingId) -> &[ThingId] {
        match self.place.get(thing) {
            None | Some(0) => &[],
            Some(&at) => &self.merges[at as usize - 1],
        }
    }
}

/// Where merges of unlike things are looked up by their first thing.
#[derive(Clone, Copy)]
pub(crate) enum Unlikes<'s> {
    /// While things are made.
    Growing(&'s BTreeMap<ThingId, Vec<ThingId>>),
    /// Once they are.
    Made(&'s Unlike),
}

impl<'s> Unlikes<'s> {
    fn of(self, first: ThingId) -> &'s [ThingId] {
        match self {
            Self::Growing(unlike) => unlike.get(&first).map_or(&[], |all| all),
            Self::Made(unlike) => unlike.of(first),
        }
    }
    fn is_empty(self) -> bool {
        match self {
            Self::Growing(unlike) => unlike.is_empty(),
            Self::Made(unlike) => unlike.merges.is_empty(),
        }
    }
}

/// The layouts of classes, each made when its first thing is.
pub(crate) type Layouts = IdVec<ClassId, Option<Rc<Layout>>>;

/// The fields of a class's instances, and where each name stands.
#[derive(Clone, Debug)]
pub struct Layout {
    /// The fields, in order.
    pub fields: Vec<PartRef>,
    /// For every field, the class of its things.
    pub classes: Vec<ClassId>,
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
        let own_names = line
            .filter_map(|s| s.first())
            .map(|s| s.name.clone())
            .filter(|n| !n.is_empty())
            .collect();
        let classes = document.refined_classes(class, &fields);
        Self { fields, classes, index, superclasses, own_names }
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

/// Things as far as they are merged: what paths are followed through.
#[derive(Clone, Copy)]
pub(crate) struct Paths<'s> {
    pub(crate) things: &'s IdVec<ThingId, Thing>,
    /// For every thing, one that it is merged with and that stands before it, or itself.
    pub(crate) merged: &'s IdVec<ThingId, ThingId>,
    pub(crate) unlike: Unlikes<'s>,
    pub(crate) layouts: &'s Layouts,
    pub(crate) references: &'s BTreeMap<ThingId, ThingId>,
}

impl Paths<'_> {
    pub(crate) fn identity(&self, thing: ThingId) -> ThingId {
        let mut at = thing;
        while self.merged[at] != at {
            at = self.merged[at];
        }
        at
    }
    fn referent(&self, thing: ThingId) -> ThingId {
        if self.references.is_empty() {
            return thing;
        }
        self.references.get(&thing).copied().unwrap_or(thing)
    }
    pub(crate) fn part_named(&self, thing: ThingId, name: &str) -> Option<ThingId> {
        let own = self.own_part_named(thing, name);
        if own.is_some() || self.unlike.is_empty() {
            return own;
        }
        let unlike = self.unlike.of(self.identity(thing));
        unlike.iter().find_map(|&t| self.own_part_named(t, name))
    }
    fn own_part_named(&self, thing: ThingId, name: &str) -> Option<ThingId> {
        let layout = self.layouts[self.things[thing].class].as_ref()?;
        let part = |i: u32| ThingId(self.things[thing].first_part.0 + i);
        if let Some(&i) = layout.index.get(name) {
            // a thing that could not be made has no parts
            return (i < self.things[thing].parts).then(|| part(i));
        }
        if layout.own_names.iter().any(|n| *n == name) {
            return Some(thing);
        }
        let has = layout.superclasses.iter().filter(|&&i| i < self.things[thing].parts);
        let mut found = has.filter_map(|&i| self.own_part_named(part(i), name));
        let first = found.next()?;
        found.all(|t| self.identity(t) == self.identity(first)).then_some(first)
    }
    /// Returns what a thing belongs to: of an element, what its list is a part of.
    fn owner(&self, thing: ThingId) -> Option<ThingId> {
        let mut owner = self.things[thing].owner?;
        // lists have no layout
        while self.layouts[self.things[owner].class].is_none() {
            owner = self.things[owner].owner?;
        }
        Some(owner)
    }
    pub(crate) fn follow(&self, from: ThingId, path: &Path) -> Result<ThingId, Astray> {
        let mut at = from;
        for (i, step) in path.0.iter().enumerate() {
            let t = &self.things[at];
            let next = match step {
                Step::Part(name) => self.part_named(at, name),
                Step::Index(n) => (*n < t.parts).then(|| ThingId(t.first_part.0 + n)),
                Step::Last => t.parts.checked_sub(1).map(|n| ThingId(t.first_part.0 + n)),
                Step::Owner => self.owner(at),
            };
            at = self.referent(next.ok_or(Astray { step: i, at })?);
        }
        Ok(at)
    }
}

/// What has to be true for a constraint to hold: a switch of a class, read in a thing of it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Condition {
    /// The thing.
    pub me: ThingId,
    /// The class.
    pub class: ClassId,
    /// The index of the switch there.
    pub switch: u32,
}

impl Condition {
    /// Returns the switch.
    pub fn switch(self, document: &Document) -> &Switch {
        &document.classes[self.class].switches[self.switch as usize]
    }
}

impl Form {
    /// Returns how strong a constraint is.
    pub fn strength(&self, document: &Document, constraint: ConstraintInstance) -> Strength {
        let declared =
            || document.classes[constraint.class].constraints[constraint.index as usize].strength;
        self.strengths.get(&constraint).copied().unwrap_or_else(declared)
    }
    /// Returns true for a constraint that is not switched off.
    pub fn is_on(&self, constraint: ConstraintInstance) -> bool {
        self.off.is_empty() || !self.off.contains(&constraint)
    }
    /// Returns what a thing is by superclasses other than the primary one.
    pub(crate) fn superclass_parts(&self, thing: ThingId) -> Vec<ThingId> {
        let layout = self.layouts[self.things[thing].class].as_ref();
        let fields = layout.map(|l| l.superclasses.clone()).unwrap_or_default();
        let (first, n) = (self.things[thing].first_part.0, self.things[thing].parts);
        fields.into_iter().filter(|&i| i < n).map(|i| ThingId(first + i)).collect()
    }
    /// Returns true if the things are those of another structure, which was edited: none has come or gone.
    pub fn has_things_of(&self, other: &Self) -> bool {
        Rc::ptr_eq(&self.things, &other.things)
    }
    /// Returns the parts of a thing, in order.
    pub fn parts(
        &self,
        thing: ThingId,
    ) -> impl DoubleEndedIterator<Item = ThingId> + ExactSizeIterator + use<> {
        let t = &self.things[thing];
        let (first, n) = (t.first_part.0, t.parts);
        (0..n).map(move |i| ThingId(first + i))
    }
    /// Returns the layout of a class, if it has things.
    pub fn layout(&self, class: ClassId) -> Option<&Rc<Layout>> {
        self.layouts.get(class)?.as_ref()
    }
    /// Returns the classes that have things with parts.
    pub fn classes(&self) -> impl Iterator<Item = ClassId> {
        self.layouts.iter().filter(|(_, l)| l.is_some()).map(|(c, _)| c)
    }
    /// Returns the first thing that `thing` is merged with: its identity.
    pub fn identity(&self, thing: ThingId) -> ThingId {
        self.merged[thing]
    }
    /// Returns true if anything else is merged with `thing`.
    pub fn is_merged(&self, thing: ThingId) -> bool {
        self.next_merged[thing] != thing
    }
    /// Returns everything that is merged with `thing`, the first first; itself alone where nothing is.
    pub fn merged_with(&self, thing: ThingId) -> Vec<ThingId> {
        let first = self.merged[thing];
        let next = |&t: &ThingId| Some(self.next_merged[t]).filter(|&t| t != first);
        std::iter::successors(Some(first), next).collect()
    }
    /// Returns the first thing of each class that `thing` is merged with, in order of declaration;
    /// nothing where all are of its own class.
    #[inline]
    pub fn unlike(&self, thing: ThingId) -> &[ThingId] {
        self.unlike.of(thing)
    }
    /// Returns true for a thing that is merged with one declared before it, and has more: its class is not among those of
    /// what is merged with it and declared before.
    pub fn adds(&self, document: &Document, thing: ThingId) -> bool {
        let class = |t: ThingId| self.things[t].class;
        let mut before = self.unlike(thing).iter().take_while(|&&t| t != thing);
        self.merged[thing] != thing
            && self.unlike(thing).contains(&thing)
            && !before.any(|&t| document.is_a(class(t), class(thing)))
    }
    /// Returns the slot that is meant where a thing goes some way: a coordinate of a place, or a number.
    pub fn slot_of_side(&self, thing: ThingId, way: SideWay) -> Option<SlotId> {
        match way.coordinate() {
            Some(coordinate) => self.slot_of(self.part_named(thing, coordinate)?),
            None => self.slot_of(thing),
        }
    }
    /// Returns how it is written that a slot goes some way: of its place where it is a coordinate.
    pub fn side_of(&self, document: &Document, slot: SlotId, toward: Toward) -> (Path, SideWay) {
        let s = &self.slots[slot];
        let thing = s.place.unwrap_or(s.thing);
        let says = |way: &SideWay| {
            way.toward(document.vertical) == toward && self.slot_of_side(thing, *way) == Some(slot)
        };
        match SideWay::ALL.into_iter().find(says) {
            Some(way) => (self.path(document, thing), way),
            None => {
                let way = if toward == Toward::More { SideWay::More } else { SideWay::Less };
                (self.path(document, s.thing), way)
            }
        }
    }
    /// Returns the name of the field that a thing is, or nothing for the document and list elements.
    pub fn field_name<'d>(&self, document: &'d Document, thing: ThingId) -> Option<&'d Name> {
        let owner = self.things[thing].owner?;
        let layout = self.layout(self.things[owner].class)?;
        layout.fields.get(self.things[thing].field as usize).map(|&f| document.field_name(f))
    }
    pub(crate) fn paths(&self) -> Paths<'_> {
        let Self { things, merged, unlike, layouts, references, .. } = self;
        Paths { things, merged, unlike: Unlikes::Made(unlike), layouts, references }
    }
    /// Returns the part of `thing` named `name`, looking at what it is merged with as well.
    ///
    /// A bare name means the primary line's part, else the only other superclass's that has it.
    /// A reference is a part like any other: [`Form::referent`] goes on to what it names.
    pub fn part_named(&self, thing: ThingId, name: &str) -> Option<ThingId> {
        self.paths().part_named(thing, name)
    }
    /// Returns what a thing belongs to: of an element, what its list is a part of. `Thing::owner` is what
    /// it is stored in.
    pub fn owner(&self, thing: ThingId) -> Option<ThingId> {
        self.paths().owner(thing)
    }
    /// Returns what a reference names; of any other thing, the thing itself.
    pub fn referent(&self, thing: ThingId) -> ThingId {
        self.paths().referent(thing)
    }
    /// Follows a path from a thing, through references to what they name.
    ///
    /// # Errors
    /// The first step that leads nowhere, and the thing where it was taken.
    pub fn follow(&self, from: ThingId, path: &Path) -> Result<ThingId, Astray> {
        self.paths().follow(from, path)
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
    /// Returns the constraint of a thing that has this name; where it has none, that of what it is by
    /// its other superclasses.
    pub fn constraint_named(
        &self,
        document: &Document,
        thing: ThingId,
        name: &str,
    ) -> Option<ConstraintInstance> {
        let is_named = |i: &&ConstraintInstance| {
            let named = &document.classes[i.class].constraints[i.index as usize].name;
            self.merged[i.owner] == self.merged[thing]
                && named.as_ref().is_some_and(|n| *n == *name)
        };
        self.constraints.iter().find(is_named).copied().or_else(|| {
            let others = self.superclass_parts(thing).into_iter();
            others.into_iter().find_map(|part| self.constraint_named(document, part, name))
        })
    }
    /// Returns the things of a class in order of declaration, merged ones once. Unseen ones are none of the document's.
    pub fn all(&self, document: &Document, class: ClassId) -> Vec<ThingId> {
        let mut is: BTreeMap<ClassId, bool> = BTreeMap::new();
        let mut of_class = |t: ThingId| {
            let c = self.things[t].class;
            *is.entry(c).or_insert_with(|| document.is_a(c, class))
        };
        let mut found = Vec::new();
        let mut stack: Vec<ThingId> = self.things.ids().take(1).collect();
        while let Some(thing) = stack.pop() {
            let is_first = self.merged[thing] == thing;
            if is_first && self.merged_with(thing).into_iter().any(&mut of_class) {
                found.push(thing);
            }
            stack.extend(self.parts(thing).rev().filter(|&t| !self.is_unseen(document, t)));
        }
        found
    }
    /// Returns true for the things of a text that is used where nothing speaks of them.
    pub fn is_unseen(&self, document: &Document, thing: ThingId) -> bool {
        document.classes[self.things[thing].class].is_unseen
    }
    /// Returns the slots of a thing and of all its parts, in order of declaration.
    pub fn slots_under(&self, thing: ThingId) -> Vec<SlotId> {
        let mut slots = Vec::new();
        let mut stack = vec![thing];
        while let Some(t) = stack.pop() {
            match self.slot_of(t) {
                Some(slot) => slots.push(slot),
                None => stack.extend(self.parts(t).rev()),
            }
        }
        slots
    }
}
