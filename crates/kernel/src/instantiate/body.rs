//! Bodies: a thing with all that is below it, numbered from the thing, to be copied.

use crate::class::ClassId;
use crate::structure::{ConstraintInstance, GivenIn, Layouts, Paths, StayInstance, Thing, ThingId};
use base::IdVec;
use std::collections::BTreeMap;

/// The thing that a body is of.
pub(super) const ROOT: ThingId = ThingId(0);

/// No reference names anything before the things are all made.
static NO_REFERENCES: BTreeMap<ThingId, ThingId> = BTreeMap::new();

/// A thing with all that is below it. Ids are those of the body; its own thing is the first.
#[derive(Default)]
pub(super) struct Body {
    pub(super) things: IdVec<ThingId, Thing>,
    /// For every thing, one that it is merged with and that is declared before it, or itself.
    pub(super) merged: IdVec<ThingId, ThingId>,
    /// For every first thing of a merge of unlike things, one of each class.
    pub(super) unlike: BTreeMap<ThingId, Vec<ThingId>>,
    /// For every thing, its place in the order of declaration: parts before the next sibling.
    pub(super) rank: IdVec<ThingId, u32>,
    pub(super) givens: IdVec<ThingId, Option<GivenIn>>,
    /// Parts before their owner.
    pub(super) constraints: Vec<ConstraintInstance>,
    pub(super) stays: Vec<StayInstance>,
    /// Members of sets: the set, and the part that is in it.
    pub(super) members: Vec<(ThingId, ThingId)>,
    /// What could not be followed in here.
    pub(super) waiting: Vec<Waiting>,
    /// True if a list in it has as many elements as are given.
    pub(super) counts_givens: bool,
}

/// A member of a class whose paths lead nowhere yet.
#[derive(Clone, Copy)]
pub(super) struct Waiting {
    pub(super) thing: ThingId,
    pub(super) class: ClassId,
    pub(super) member: Member,
}

/// A member that speaks of parts by paths, by its index among the class's members of its kind.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Member {
    Merge(u32),
    Stay(u32),
    Insert(u32),
}

impl Body {
    /// Makes a thing that has no parts yet.
    pub(super) fn new(class: ClassId) -> Self {
        let mut body = Self::default();
        body.things.push(Thing { class, owner: None, field: 0, first_part: ROOT, parts: 0 });
        body.merged.push(ROOT);
        body.rank.push(0);
        body.givens.push(None);
        body
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
        Paths { things, merged, unlike, layouts, references: &NO_REFERENCES }
    }

    /// Gives a thing its parts, one of each class, still without parts of their own.
    pub(super) fn add_parts(
        &mut self,
        owner: ThingId,
        classes: impl ExactSizeIterator<Item = ClassId>,
    ) {
        let first = self.things.next_id();
        self.things[owner].first_part = first;
        self.things[owner].parts = classes.len() as u32;
        for (field, class) in (0..).zip(classes) {
            let id = self.things.next_id();
            let owner = Some(owner);
            self.things.push(Thing { class, owner, field, first_part: id, parts: 0 });
            self.merged.push(id);
            self.rank.push(0);
            self.givens.push(None);
        }
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
        self.things.extend(from.things.as_slice()[1..].iter().map(thing));
        self.merged.extend(from.merged.as_slice()[1..].iter().map(|&t| moved(t)));
        self.rank.extend(from.rank.as_slice()[1..].iter().map(|&r| rank + r));
        self.givens.extend(from.givens.as_slice()[1..].iter().map(|g| g.map(given)));
        if from.things[ROOT].parts > 0 {
            self.things[at].first_part = moved(from.things[ROOT].first_part);
            self.things[at].parts = from.things[ROOT].parts;
        }
        let unlike = |all: &Vec<ThingId>| all.iter().map(|&t| moved(t)).collect();
        self.unlike.extend(from.unlike.iter().map(|(&t, all)| (moved(t), unlike(all))));
        let constraint =
            |c: &ConstraintInstance| ConstraintInstance { owner: moved(c.owner), ..*c };
        self.constraints.extend(from.constraints.iter().map(constraint));
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
            self.merged[thing] = first;
        }
    }

    /// Returns the first thing that a thing is merged with, and shortens the way there.
    pub(super) fn identity(&mut self, thing: ThingId) -> ThingId {
        let mut at = thing;
        while self.merged[at] != at {
            let next = self.merged[self.merged[at]];
            self.merged[at] = next;
            at = next;
        }
        at
    }
}
