//! Instantiation: a document in, its structure out.
//!
//! Four passes, each linear in what it reads: make every thing with its given values; merge; give
//! slots to the primitive things; collect constraints, stays and set members. What cannot be done
//! becomes a [`Fault`], and the rest goes on without it.

use crate::class::{ClassId, ClassKind, Count, Given};
use crate::document::{Document, PartRef, PartRole};
use crate::path::{Path, Step};
use crate::structure::{
    ConstraintInstance, GivenIn, Layout, Slot, StayInstance, Structure, Thing, ThingId,
};
use crate::term::{OriginId, Term};
use base::{IdVec, Name};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Something in a document that cannot be made as written.
#[derive(Clone, PartialEq, Debug)]
pub struct Fault {
    /// The member at fault.
    pub origin: OriginId,
    /// What kind of fault it is.
    pub kind: FaultKind,
    /// What was found and what was wanted.
    pub message: String,
}

/// The kinds of faults of a structure.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum FaultKind {
    /// A thing that would have to be a part of itself.
    EndlessParts,
    /// More things than a document may have.
    TooManyThings,
    /// A path that leads nowhere.
    UnknownPart,
    /// A merge of things that have no parts in common.
    VacuousMerge,
    /// A merge of primitive things of different kinds, or of lists of different lengths.
    UnlikeMerge,
    /// A class that cannot have things of its own.
    AbstractPart,
}

impl FaultKind {
    /// Returns the kebab-case code of its diagnostic.
    pub fn code(self) -> &'static str {
        match self {
            Self::EndlessParts => "endless-parts",
            Self::TooManyThings => "too-many-things",
            Self::UnknownPart => "unknown-part",
            Self::VacuousMerge => "vacuous-merge",
            Self::UnlikeMerge => "unlike-merge",
            Self::AbstractPart => "abstract-part",
        }
    }
}

/// How many things a document may have.
///
/// A thing costs some forty bytes; the bound keeps a mistyped count from filling the memory.
const MOST_THINGS: usize = 4_000_000;

/// Makes the structure of a document, and says what could not be made.
///
/// Cost: linear in the things of the document, the merges times the things below them.
pub fn instantiate(document: &Document) -> (Structure, Vec<Fault>) {
    let mut maker = Maker {
        document,
        structure: Structure::default(),
        givens: IdVec::new(),
        on_the_way: Vec::new(),
        faults: Vec::new(),
        places: BTreeMap::new(),
    };
    let origin = document.classes[document.root].origin;
    let root = maker.blank(document.root, None, 0);
    maker.make(root, Vec::new(), origin);
    let ranks = maker.rank();
    maker.merge(&ranks.rank);
    maker.give_slots(&ranks.order);
    maker.collect(&ranks);
    maker.faults.dedup();
    (maker.structure, maker.faults)
}

/// A given value on its way down to the thing that it is for.
#[derive(Clone)]
struct Binding {
    path: Path,
    given: GivenIn,
}

struct Maker<'d> {
    document: &'d Document,
    structure: Structure,
    givens: IdVec<ThingId, Option<GivenIn>>,
    on_the_way: Vec<ClassId>,
    faults: Vec<Fault>,
    places: BTreeMap<ClassId, bool>,
}

/// The order of declaration: parts of a thing before its next sibling.
struct Ranks {
    order: Vec<ThingId>,
    rank: IdVec<ThingId, u32>,
}

impl<'d> Maker<'d> {
    fn blank(&mut self, class: ClassId, owner: Option<ThingId>, field: u32) -> ThingId {
        let id = self.structure.things.next_id();
        self.structure.things.push(Thing { class, owner, field, first_part: id, parts: 0 });
        self.structure.merged.push(id);
        self.givens.push(None);
        id
    }

    fn layout(&mut self, class: ClassId) -> Rc<Layout> {
        let document = self.document;
        let layouts = &mut self.structure.layouts;
        layouts.entry(class).or_insert_with(|| Rc::new(Layout::new(document, class))).clone()
    }

    fn fault(&mut self, origin: OriginId, kind: FaultKind, message: String) {
        self.faults.push(Fault { origin, kind, message });
    }

    /// Makes the parts of a thing. `bindings` come from its owners, the outermost last.
    fn make(&mut self, thing: ThingId, mut bindings: Vec<Binding>, origin: OriginId) {
        let document = self.document;
        let class = self.structure.things[thing].class;
        let name = &document.classes[class].name;
        if self.on_the_way.contains(&class) && !self.is_list(class) {
            let message = format!("a {name} would have another {name} as a part, without end");
            return self.fault(origin, FaultKind::EndlessParts, message);
        }
        if document.classes[class].is_abstract {
            let message = format!("{name} is abstract: it has no things of its own");
            self.fault(origin, FaultKind::AbstractPart, message);
        }
        let own = document.primary_line(class).into_iter().rev().flat_map(|c| {
            document.classes[c]
                .givens
                .iter()
                .map(|g| Binding { path: g.path.clone(), given: given_in(g, thing) })
        });
        let outer = std::mem::take(&mut bindings);
        bindings = own.chain(outer).collect();
        let whole = bindings.iter().rev().find(|b| b.path.is_empty()).map(|b| b.given.clone());
        match &document.classes[class].kind {
            ClassKind::Primitive(_) | ClassKind::Reference(_) | ClassKind::Set(_) => {
                self.givens[thing] = whole;
            }
            ClassKind::List(element) => {
                self.make_list(thing, *element, &bindings, whole.as_ref(), origin);
            }
            ClassKind::Composite => self.make_fields(thing, bindings),
        }
    }

    fn is_list(&self, class: ClassId) -> bool {
        matches!(self.document.classes[class].kind, ClassKind::List(_))
    }

    fn make_list(
        &mut self,
        thing: ThingId,
        element: ClassId,
        bindings: &[Binding],
        whole: Option<&GivenIn>,
        origin: OriginId,
    ) {
        let given_count = whole.map_or(0, |w| match &w.value {
            Term::List(items) => items.len(),
            _ => 0,
        });
        let count = match self.declared_count(thing) {
            Some(Count::Fixed(n)) => n as usize,
            Some(Count::Given) | None => given_count,
        };
        if self.structure.things.len() + count > MOST_THINGS {
            let message = format!("{count} elements are more than a document may have");
            return self.fault(origin, FaultKind::TooManyThings, message);
        }
        let first = self.structure.things.next_id();
        for i in 0..count {
            self.blank(element, Some(thing), i as u32);
        }
        self.structure.things[thing].first_part = first;
        self.structure.things[thing].parts = count as u32;
        let mut shares: Vec<Vec<Binding>> = vec![Vec::new(); count];
        for b in bindings {
            match b.path.0.first() {
                None => share_whole(&b.given, &mut shares, |i| {
                    Term::Index(Box::new(b.given.value.clone()), Box::new(Term::number(i as f64)))
                }),
                Some(step) => {
                    let i = match step {
                        Step::Index(i) => Some(*i as usize),
                        Step::Last => count.checked_sub(1),
                        Step::Part(_) | Step::Owner => None,
                    };
                    let rest = Path(b.path.0[1..].to_vec());
                    match i.and_then(|i| shares.get_mut(i)) {
                        Some(share) => share.push(Binding { path: rest, given: b.given.clone() }),
                        None => self.faults.push(Fault {
                            origin: b.given.origin,
                            kind: FaultKind::UnknownPart,
                            message: format!("{} leads nowhere in a list of {count}", b.path),
                        }),
                    }
                }
            }
        }
        for (i, share) in shares.into_iter().enumerate() {
            self.make(ThingId(first.0 + i as u32), share, origin);
        }
    }

    fn declared_count(&self, thing: ThingId) -> Option<Count> {
        let t = &self.structure.things[thing];
        let layout = self.structure.layouts.get(&self.structure.things[t.owner?].class)?;
        self.document.declared(*layout.fields.get(t.field as usize)?)?.count
    }

    fn make_fields(&mut self, thing: ThingId, bindings: Vec<Binding>) {
        let class = self.structure.things[thing].class;
        let layout = self.layout(class);
        let first = self.structure.things.next_id();
        let count = layout.fields.len();
        if self.structure.things.len() + count > MOST_THINGS {
            let origin = self.document.classes[class].origin;
            let message = "more things than a document may have".to_string();
            return self.fault(origin, FaultKind::TooManyThings, message);
        }
        for (i, &field) in layout.fields.iter().enumerate() {
            self.blank(self.document.field_class(field), Some(thing), i as u32);
        }
        self.structure.things[thing].first_part = first;
        self.structure.things[thing].parts = count as u32;
        let mut shares: Vec<Vec<Binding>> = vec![Vec::new(); count];
        for b in bindings {
            self.share(thing, &layout, b, &mut shares);
        }
        self.on_the_way.push(class);
        for (i, (share, &field)) in shares.into_iter().zip(&layout.fields).enumerate() {
            let part = ThingId(first.0 + i as u32);
            let origin = self.field_origin(field);
            self.make(part, share, origin);
        }
        self.on_the_way.pop();
    }

    /// Hands a binding on to the field that its path leads through.
    fn share(&mut self, thing: ThingId, layout: &Layout, b: Binding, shares: &mut [Vec<Binding>]) {
        let Some(step) = b.path.0.first() else {
            let name = |i: usize| self.document.field_name(layout.fields[i]).clone();
            return share_fields(&b.given, &name, shares);
        };
        let rest = Path(b.path.0[1..].to_vec());
        let field = match step {
            Step::Part(name) => self.field_towards(layout, name),
            Step::Index(_) | Step::Last | Step::Owner => None,
        };
        match field {
            Some(Towards::Field(i)) => shares[i].push(Binding { path: rest, given: b.given }),
            Some(Towards::Within(i)) => shares[i].push(b),
            Some(Towards::Self_) => {
                self.share(thing, layout, Binding { path: rest, given: b.given }, shares);
            }
            None => {
                let class = &self.document.classes[self.structure.things[thing].class].name;
                let message = format!("{class} has no part {}", b.path);
                self.fault(b.given.origin, FaultKind::UnknownPart, message);
            }
        }
    }

    /// Finds the field that a bare name leads to or through.
    fn field_towards(&self, layout: &Layout, name: &Name) -> Option<Towards> {
        if let Some(&i) = layout.index.get(name) {
            return Some(Towards::Field(i as usize));
        }
        if layout.own_names.contains(name) {
            return Some(Towards::Self_);
        }
        let has = |&&i: &&u32| {
            let class = self.document.field_class(layout.fields[i as usize]);
            self.field_towards(&Layout::new(self.document, class), name).is_some()
        };
        layout.superclasses.iter().find(has).map(|&i| Towards::Within(i as usize))
    }

    fn field_origin(&self, field: PartRef) -> OriginId {
        match field.role {
            PartRole::Part => self.document.classes[field.class].parts[field.index].origin,
            PartRole::Superclass => self.document.classes[field.class].origin,
        }
    }

    fn rank(&self) -> Ranks {
        let mut order = Vec::with_capacity(self.structure.things.len());
        let mut stack = vec![ThingId(0)];
        while let Some(thing) = stack.pop() {
            order.push(thing);
            stack.extend(self.structure.parts(thing).rev());
        }
        let mut rank = IdVec::filled(0, self.structure.things.len());
        for (i, &thing) in order.iter().enumerate() {
            rank[thing] = i as u32;
        }
        Ranks { order, rank }
    }

    /// Merges what every thing's classes say, until no path opens up another.
    fn merge(&mut self, rank: &IdVec<ThingId, u32>) {
        let document = self.document;
        let mut waiting = Vec::new();
        for (thing, t) in self.structure.things.iter() {
            for class in document.primary_line(t.class).into_iter().rev() {
                for merge in &document.classes[class].merges {
                    if !self.masked(thing, merge.name.as_ref()) {
                        waiting.push((thing, merge));
                    }
                }
            }
        }
        loop {
            let before = waiting.len();
            let mut next = Vec::new();
            for (thing, merge) in waiting {
                let all: Result<Vec<_>, _> =
                    merge.paths.iter().map(|p| self.structure.follow(thing, p)).collect();
                match all {
                    Ok(things) => {
                        for pair in things.windows(2) {
                            self.merge_pair(pair[0], pair[1], merge.origin, rank);
                        }
                    }
                    Err(_) => next.push((thing, merge)),
                }
            }
            if next.len() == before || next.is_empty() {
                for (thing, merge) in next {
                    self.fault_astray(thing, &merge.paths, merge.origin);
                }
                return;
            }
            waiting = next;
        }
    }

    /// Returns true if a class of the thing says `without` this name.
    fn masked(&self, thing: ThingId, name: Option<&Name>) -> bool {
        let Some(name) = name else { return false };
        let class = self.structure.things[thing].class;
        self.document.primary_line(class).into_iter().any(|c| {
            let step = Step::Part(name.clone());
            self.document.classes[c].without.iter().any(|p| p.0.last() == Some(&step))
        })
    }

    fn fault_astray(&mut self, thing: ThingId, paths: &[Path], origin: OriginId) {
        for path in paths {
            if let Err(astray) = self.structure.follow(thing, path) {
                let class = self.structure.things[astray.at].class;
                let step = Path(vec![path.0[astray.step].clone()]);
                let name = &self.document.classes[class].name;
                let message = format!("{name} has no part {step}, in {path}");
                self.fault(origin, FaultKind::UnknownPart, message);
            }
        }
    }

    fn merge_pair(&mut self, a: ThingId, b: ThingId, origin: OriginId, rank: &IdVec<ThingId, u32>) {
        let mut pairs = vec![(a, b)];
        while let Some((a, b)) = pairs.pop() {
            if self.structure.merged[a] == self.structure.merged[b] {
                continue;
            }
            let (ones, others) = (self.alike(a), self.alike(b));
            for &one in &ones {
                for &other in &others {
                    match self.common_parts(one, other, (one, other) == (a, b)) {
                        Ok(common) => pairs.extend(common),
                        Err((kind, message)) => {
                            return self.fault(origin, kind, message);
                        }
                    }
                }
            }
            self.unite(a, b, rank);
        }
    }

    /// Returns one thing of each class among those merged with `thing`, `thing` itself first.
    fn alike(&self, thing: ThingId) -> Vec<ThingId> {
        let mut classes = BTreeSet::from([self.structure.things[thing].class]);
        let mut alike = vec![thing];
        for &t in self.structure.merges.get(&self.structure.merged[thing]).into_iter().flatten() {
            if classes.insert(self.structure.things[t].class) {
                alike.push(t);
            }
        }
        alike
    }

    /// Returns the parts that two things have from their nearest common ancestor, pair by pair.
    ///
    /// `named` pairs must have some: an ancestor without parts is a vacuous merge.
    fn common_parts(
        &mut self,
        a: ThingId,
        b: ThingId,
        named: bool,
    ) -> Result<Vec<(ThingId, ThingId)>, (FaultKind, String)> {
        let document = self.document;
        let (ca, cb) = (self.structure.things[a].class, self.structure.things[b].class);
        let name = |c: ClassId| &document.classes[c].name;
        let (ka, kb) = (&document.classes[ca].kind, &document.classes[cb].kind);
        match (ka, kb) {
            (ClassKind::Composite, ClassKind::Composite) => {}
            (ClassKind::List(_), ClassKind::List(_)) if ka == kb => {
                let (na, nb) = (self.structure.things[a].parts, self.structure.things[b].parts);
                if na == nb {
                    return Ok(self.structure.parts(a).zip(self.structure.parts(b)).collect());
                }
                let message = format!("a list of {na} and a list of {nb} cannot be one list");
                return Err((FaultKind::UnlikeMerge, message));
            }
            _ if ka == kb => return Ok(Vec::new()),
            _ => {
                let message = format!("{} and {} cannot be one part", name(ca), name(cb));
                return Err((FaultKind::UnlikeMerge, message));
            }
        }
        let others = document.lineage(cb);
        let ancestor = document.lineage(ca).into_iter().find(|c| others.contains(c));
        let views = ancestor.and_then(|c| Some((self.seen_as(a, c)?, self.seen_as(b, c)?, c)));
        let pairs = views.map_or_else(Vec::new, |(a, b, c)| {
            let n = document.layout(c).len();
            self.structure.parts(a).zip(self.structure.parts(b)).take(n).collect()
        });
        if named && pairs.is_empty() && ca != cb {
            let message = format!(
                "a {} and a {} have no parts in common: merging them would say nothing",
                name(ca),
                name(cb)
            );
            return Err((FaultKind::VacuousMerge, message));
        }
        Ok(pairs)
    }

    /// Finds the thing or superclass part that is `thing` seen as a `class`.
    fn seen_as(&self, thing: ThingId, class: ClassId) -> Option<ThingId> {
        let own = self.structure.things[thing].class;
        if self.document.primary_line(own).contains(&class) {
            return Some(thing);
        }
        let layout = self.structure.layouts.get(&own)?;
        let first = self.structure.things[thing].first_part.0;
        layout.superclasses.iter().find_map(|&i| self.seen_as(ThingId(first + i), class))
    }

    fn unite(&mut self, a: ThingId, b: ThingId, rank: &IdVec<ThingId, u32>) {
        let s = &mut self.structure;
        let (a, b) = (s.merged[a], s.merged[b]);
        let mut all = s.merges.remove(&a).unwrap_or_else(|| vec![a]);
        let mut more = s.merges.remove(&b).unwrap_or_else(|| vec![b]);
        let (first, last) = if rank[a] < rank[b] { (a, b) } else { (b, a) };
        if all.len() < more.len() {
            std::mem::swap(&mut all, &mut more);
        }
        all.extend(more);
        // The larger half is renamed only where the smaller one was declared first.
        for &t in &all {
            if s.merged[t] == last {
                s.merged[t] = first;
            }
        }
        s.merges.insert(first, all);
    }

    fn give_slots(&mut self, order: &[ThingId]) {
        let document = self.document;
        self.structure.slot_of = IdVec::filled(None, self.structure.things.len());
        for &thing in order {
            let first = self.structure.merged[thing];
            let class = self.structure.things[thing].class;
            let ClassKind::Primitive(primitive) = document.classes[class].kind else { continue };
            let slot = match self.structure.slot_of[first] {
                Some(slot) => slot,
                None => {
                    let place = self.place_of(first);
                    let given = None;
                    let slot = self.structure.slots.push(Slot {
                        thing: first,
                        primitive,
                        given,
                        anchored: false,
                        place,
                        range: None,
                    });
                    self.structure.slot_of[first] = Some(slot);
                    slot
                }
            };
            self.structure.slot_of[thing] = Some(slot);
            let range = self.declared_range(thing);
            let given = self.givens[thing].take();
            let s = &mut self.structure.slots[slot];
            if s.given.is_none() {
                s.given = given;
            }
            s.range = s.range.or(range);
        }
    }

    fn place_of(&mut self, thing: ThingId) -> Option<ThingId> {
        let document = self.document;
        let owner = self.structure.things[thing].owner?;
        let class = self.structure.things[owner].class;
        let is_place = *self.places.entry(class).or_insert_with(|| document.is_place(class));
        is_place.then(|| self.structure.merged[owner])
    }

    fn declared_range(&self, thing: ThingId) -> Option<(i64, i64)> {
        let t = &self.structure.things[thing];
        let layout = self.structure.layouts.get(&self.structure.things[t.owner?].class)?;
        self.document.declared(*layout.fields.get(t.field as usize)?)?.range
    }

    /// Collects constraints, stays and set members in order of declaration.
    fn collect(&mut self, ranks: &Ranks) {
        let document = self.document;
        let mut seen = BTreeSet::new();
        let mut members: Vec<(ThingId, ThingId)> = Vec::new();
        for thing in self.parts_first() {
            let class = self.structure.things[thing].class;
            for class in document.primary_line(class).into_iter().rev() {
                let c = &document.classes[class];
                for (index, constraint) in c.constraints.iter().enumerate() {
                    let owner = self.structure.merged[thing];
                    let fresh = !self.masked(thing, constraint.name.as_ref())
                        && seen.insert((class, index, owner));
                    if fresh {
                        let index = index as u32;
                        let instance = ConstraintInstance { owner: thing, class, index };
                        self.structure.constraints.push(instance);
                    }
                }
                for stay in &c.stays {
                    match self.structure.follow(thing, &stay.path) {
                        Ok(at) => {
                            let instance = StayInstance { thing: at, strength: stay.strength };
                            self.structure.stays.push(instance);
                        }
                        Err(_) => {
                            self.fault_astray(thing, std::slice::from_ref(&stay.path), stay.origin);
                        }
                    }
                }
                for insert in &c.inserts {
                    let part = self.structure.follow(thing, &insert.part);
                    let set = self.structure.follow(thing, &insert.set);
                    match (part, set) {
                        (Ok(part), Ok(set)) => {
                            members.push((self.structure.merged[set], self.structure.merged[part]));
                        }
                        _ => {
                            let paths = [insert.part.clone(), insert.set.clone()];
                            self.fault_astray(thing, &paths, insert.origin);
                        }
                    }
                }
            }
        }
        members.sort_by_key(|&(set, part)| (ranks.rank[set], ranks.rank[part]));
        members.dedup();
        for (set, part) in members {
            self.structure.sets.entry(set).or_default().push(part);
        }
        for stay in self.structure.stays.clone() {
            if stay.strength.is_none() {
                for slot in self.structure.slots_under(stay.thing) {
                    self.structure.slots[slot].anchored = true;
                }
            }
        }
        for all in self.structure.merges.values_mut() {
            all.sort_by_key(|&t| ranks.rank[t]);
        }
    }

    /// Returns every thing, parts before their owner, siblings in order of declaration.
    fn parts_first(&self) -> Vec<ThingId> {
        let mut order = Vec::with_capacity(self.structure.things.len());
        let mut stack = vec![ThingId(0)];
        while let Some(thing) = stack.pop() {
            order.push(thing);
            stack.extend(self.structure.parts(thing));
        }
        order.reverse();
        order
    }
}

/// Where a bare name leads from a thing.
enum Towards {
    /// To the field of this index.
    Field(usize),
    /// Through the superclass part of this index, which has the name.
    Within(usize),
    /// To the thing itself, by the name of its primary superclass.
    Self_,
}

fn given_in(given: &Given, me: ThingId) -> GivenIn {
    GivenIn { value: given.value.clone(), me, origin: given.origin }
}

/// Hands a given list to the elements, one each; any other value element by element.
fn share_whole(given: &GivenIn, shares: &mut [Vec<Binding>], element: impl Fn(usize) -> Term) {
    for (i, share) in shares.iter_mut().enumerate() {
        let value = match &given.value {
            Term::List(items) => match items.get(i) {
                Some(item) => item.clone(),
                None => continue,
            },
            _ => element(i),
        };
        let given = GivenIn { value, ..given.clone() };
        share.push(Binding { path: Path::default(), given });
    }
}

/// Hands a given thing to its fields: by position, by name, or by asking it for each.
fn share_fields(given: &GivenIn, name: &dyn Fn(usize) -> Name, shares: &mut [Vec<Binding>]) {
    for (i, share) in shares.iter_mut().enumerate() {
        let value = match &given.value {
            Term::Tuple(items) => items.get(i).cloned(),
            Term::Make { arguments, .. } => {
                let labelled =
                    arguments.iter().find(|a| a.label.as_ref().is_some_and(|l| *l == name(i)));
                let positional = || arguments.get(i).filter(|a| a.label.is_none());
                labelled.or_else(positional).map(|a| a.value.clone())
            }
            other => Some(Term::send(other.clone(), &name(i))),
        };
        if let Some(value) = value {
            let given = GivenIn { value, ..given.clone() };
            share.push(Binding { path: Path::default(), given });
        }
    }
}
