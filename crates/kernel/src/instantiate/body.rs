//! Bodies: a thing with all that is below it, numbered from the thing, to be copied.

use crate::class::ClassId;
use crate::structure::{
    ConstraintInstance, GivenIn, Layouts, Paths, StayInstance, Thing, ThingId, Unlikes,
};
use base::IdVec;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// The thing that a body is of.
pub(super) const ROOT: ThingId = ThingId(0);

/// No reference names anything before the things are all made.
static NO_REFERENCES: BTreeMap<ThingId, ThingId> = BTreeMap::new();

/// A thing with all that is below it. Ids are those of the body; its own thing is the first.
///
/// What may be as long as the document is shared with whoever holds a copy of the body, until it is changed.
#[derive(Clone, Debug, Default)]
pub(super) struct Body {
    pub(super) things: Rc<IdVec<ThingId, Thing>>,
    /// For every thing, one that it is merged with and that is declared before it, or itself.
    pub(super) merged: Rc<IdVec<ThingId, ThingId>>,
    /// For every first thing of a merge of unlike things, one of each class.
    pub(super) unlike: BTreeMap<ThingId, Vec<ThingId>>,
    /// The classes of those.
    pub(super) mixed: BTreeSet<ClassId>,
    /// For every thing, its place in the order of declaration: parts before the next sibling.
    pub(super) rank: Rc<IdVec<ThingId, u32>>,
    pub(super) givens: Rc<IdVec<ThingId, Option<GivenIn>>>,
    /// Parts before their owner.
    pub(super) constraints: Rc<Vec<ConstraintInstance>>,
    pub(super) stays: Vec<StayInstance>,
    /// Members of sets: the set, and the part that is in it.
    pub(super) members: Vec<(ThingId, ThingId)>,
    /// What could not be followed in here.
    pub(super) waiting: Vec<Waiting>,
    /// How many levels of parts lie below its thing.
    pub(super) below: usize,
    /// True if a list in it has as many elements as are given.
    pub(super) counts_givens: bool,
}

/// A member of a class whose paths lead nowhere yet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waiting {
    pub(super) thing: ThingId,
    pub(super) class: ClassId,
    pub(super) member: Member,
}

/// A member that speaks of parts by paths, by its index among the class's members of its kind.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Member {
    Merge(u32),
    Stay(u32),
    Insert(u32),
}

impl Body {
    /// Makes a thing that has no parts yet.
    pub(super) fn new(class: ClassId) -> Self {
        let thing = Thing { class, owner: None, field: 0, first_part: ROOT, parts: 0 };
        Self {
            things: Rc::new(IdVec::from(vec![thing])),
            merged: Rc::new(IdVec::from(vec![ROOT])),
            rank: Rc::new(IdVec::from(vec![0])),
            givens: Rc::new(IdVec::from(vec![None])),
            ..Self::default()
        }
    }

    pub(super) fn len(&self) -> usize {
        self.things.len()
    }

    /// Returns the part of this index.
    pub(super) fn part(&self, thing: ThingId, index: usize) -> ThingId {
        ThingId(self.things[thing].first_part.0 + index as u32)
    }

    pub(super) fn paths<'s>(&'s self, layouts: &'s Layouts) -> Paths<'s> {
        let Self { things, merged, unlike, .. } = self;
        let unlike = Unlikes::Growing(unlike);
        Paths { things, merged, unlike, layouts, references: &NO_REFERENCES }
    }

    /// Gives a thing its parts, one of each class, still without parts of their own.
    pub(super) fn add_parts(
        &mut self,
        owner: ThingId,
        classes: impl ExactSizeIterator<Item = ClassId>,
    ) {
        let (things, merged) = (Rc::make_mut(&mut self.things), Rc::make_mut(&mut self.merged));
        things[owner].first_part = things.next_id();
        things[owner].parts = classes.len() as u32;
        for (field, class) in (0..).zip(classes) {
            let id = things.next_id();
            let owner = Some(owner);
            things.push(Thing { class, owner, field, first_part: id, parts: 0 });
            merged.push(id);
        }
        let more = things.len() - self.rank.len();
        Rc::make_mut(&mut self.rank).extend(std::iter::repeat_n(0, more));
        Rc::make_mut(&mut self.givens).extend(std::iter::repeat_n(None, more));
    }

    /// Puts what is below the thing of another body below a thing of the same class in this one.
    pub(super) fn copy(&mut self, at: ThingId, from: &Self) {
        // the copied thing becomes `at`, all others follow what is here
        let base = self.len() as u32;
        let moved = |t: ThingId| if t == ROOT { at } else { ThingId(base + t.0 - 1) };
        let given = |g: GivenIn| GivenIn { me: moved(g.me), ..g };
        let rank = self.rank[at];
        let thing = |t: &Thing| Thing {
            owner: t.owner.map(moved),
            first_part: ThingId(base + t.first_part.0 - 1),
            ..*t
        };
        let things = Rc::make_mut(&mut self.things);
        things.extend(from.things.as_slice()[1..].iter().map(thing));
        if from.things[ROOT].parts > 0 {
            things[at].first_part = moved(from.things[ROOT].first_part);
            things[at].parts = from.things[ROOT].parts;
        }
        let merged = from.merged.as_slice()[1..].iter().map(|&t| moved(t));
        Rc::make_mut(&mut self.merged).extend(merged);
        Rc::make_mut(&mut self.rank).extend(from.rank.as_slice()[1..].iter().map(|&r| rank + r));
        let givens = from.givens.as_slice()[1..].iter().map(|g| g.map(given));
        Rc::make_mut(&mut self.givens).extend(givens);
        let unlike = |all: &Vec<ThingId>| all.iter().map(|&t| moved(t)).collect();
        self.unlike.extend(from.unlike.iter().map(|(&t, all)| (moved(t), unlike(all))));
        self.mixed.extend(&from.mixed);
        let constraint =
            |c: &ConstraintInstance| ConstraintInstance { owner: moved(c.owner), ..*c };
        Rc::make_mut(&mut self.constraints).extend(from.constraints.iter().map(constraint));
        let stay = |s: &StayInstance| StayInstance { thing: moved(s.thing), ..*s };
        self.stays.extend(from.stays.iter().map(stay));
        self.members.extend(from.members.iter().map(|&(set, part)| (moved(set), moved(part))));
        let waiting = |w: &Waiting| Waiting { thing: moved(w.thing), ..*w };
        self.waiting.extend(from.waiting.iter().map(waiting));
        self.counts_givens |= from.counts_givens;
    }

    /// Makes every thing that is merged name the first that it is merged with.
    pub(super) fn settle_merges(&mut self) {
        for thing in self.things.ids() {
            let first = self.identity(thing);
            self.set_merged(thing, first);
        }
    }

    /// Returns the first thing that a thing is merged with, and shortens the way there.
    pub(super) fn identity(&mut self, thing: ThingId) -> ThingId {
        let mut at = thing;
        while self.merged[at] != at {
            let next = self.merged[self.merged[at]];
            self.set_merged(at, next);
            at = next;
        }
        at
    }

    /// Makes two things one, each the first that it is merged with; returns the one declared first, then the
    /// other.
    pub(super) fn make_one(&mut self, a: ThingId, b: ThingId) -> (ThingId, ThingId) {
        let (first, last) = if self.rank[a] < self.rank[b] { (a, b) } else { (b, a) };
        self.set_merged(last, first);
        (first, last)
    }

    /// Says that a thing is merged with one that stands before it.
    pub(super) fn set_merged(&mut self, thing: ThingId, with: ThingId) {
        if self.merged[thing] != with {
            Rc::make_mut(&mut self.merged)[thing] = with;
        }
    }
}
