//! Grown: the parts of a document before its own class spoke of them, kept from one edit to the next.
//!
//! What the document's class says of its parts (merges, constraints, stays, memberships) stands apart
//! from what its parts are. Where an edit left these as they were, they are taken over by identity, and so
//! are they where it gave a few numbers and places more.

use super::body::{Body, ROOT};
use crate::class::{Class, ClassKind, Given};
use crate::document::Document;
use crate::path::{Path, Step};
use crate::structure::{GivenId, GivenIn, GivenTerm, Givens, Layouts, Structure, ThingId};
use crate::term::Term;
use base::{Id, IdVec};
use std::rc::Rc;

/// How many values an edit may give that were not given before.
const MOST_NEW: usize = 64;

/// A document's parts before its own class spoke of them.
#[derive(Debug)]
pub(crate) struct Grown {
    pub(super) body: Body,
    pub(super) layouts: Layouts,
    pub(super) shared: Vec<Shared>,
}

impl Grown {
    /// Returns what a thing is given, whatever it will be merged with.
    pub(crate) fn given(&self, thing: ThingId) -> Option<GivenIn> {
        self.body.givens[thing]
    }
}

/// A value that a part gets of a value for the whole: a coordinate of `(3, 4)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shared {
    pub(super) value: GivenId,
    pub(super) whole: GivenId,
    pub(super) part: u32,
}

/// Returns the parts of a document after an edit, and the values that they are given, if the edit changed
/// nothing of them but constants, or gave some more.
pub(super) fn kept(
    document: &Document,
    (was, structure): (&Document, &Structure),
) -> Option<(Rc<Grown>, Rc<Givens>)> {
    let grown = structure.grown.clone()?;
    let of = |document: &Document| document.classes.len();
    if of(document) != of(was) || document.root != was.root {
        return None;
    }
    let mut classes = document.classes.iter().zip(was.classes.iter());
    let is_kept = classes.all(|((id, a), (_, b))| match id == document.root {
        true => has_same_parts(a, b),
        false => a == b,
    });
    is_kept.then(|| given_again(document, was, grown, &structure.givens))?
}

fn has_same_parts(a: &Class, b: &Class) -> bool {
    let is_same = |(a, b): (&crate::class::Part, &crate::class::Part)| {
        a.class == b.class && a.count == b.count && a.range == b.range && a.name == b.name
    };
    a.kind == b.kind
        && a.supers == b.supers
        && a.is_abstract == b.is_abstract
        && a.refined == b.refined
        && a.parts.len() == b.parts.len()
        && a.parts.iter().zip(&b.parts).all(is_same)
}

/// Returns the parts, and the given values after an edit of constants; nothing where it changed more of them.
fn given_again(
    document: &Document,
    was: &Document,
    grown: Rc<Grown>,
    givens: &Rc<Givens>,
) -> Option<(Rc<Grown>, Rc<Givens>)> {
    let [now, then] = [document, was].map(|d| d.classes[d.root].givens.as_slice());
    let mut left = now.len().checked_sub(then.len()).filter(|&n| n <= MOST_NEW)?;
    // the document's own stand first, behind those of its superclasses
    let above = document.primary_line(document.root).into_iter().skip(1);
    let first: usize = above.map(|c| document.classes[c].givens.len()).sum();
    let (mut changed, mut new): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
    let mut before = then.iter();
    for (i, a) in now.iter().enumerate() {
        match before.as_slice().first() {
            Some(b) if Rc::ptr_eq(a, b) || a == b => {}
            Some(b) if a.path == b.path && is_like(&a.value, &b.value) => changed.push(i),
            _ => {
                left = left.checked_sub(1)?;
                new.push(i);
                continue;
            }
        }
        before.next();
    }
    if changed.is_empty() && new.is_empty() {
        return Some((grown, givens.clone()));
    }
    let term = |i: usize| {
        let Given { value, origin, .. } = &*now[i];
        let term = Rc::new(value.clone());
        GivenTerm { term, origin: *origin, of_class: false, of_copy: false }
    };
    let new: Vec<GivenId> = new.into_iter().map(|i| GivenId::from_index(first + i)).collect();
    let (grown, mut again) = match new.is_empty() {
        true => (grown, Givens::clone(givens)),
        false => {
            let given: Vec<_> = new.iter().map(|id| (*id, &*now[id.index() - first])).collect();
            let terms = new.iter().map(|id| (*id, term(id.index() - first)));
            let mut again = with_more(givens, terms);
            let more = given_more(document, &grown, &mut again, &given)?;
            (Rc::new(more), again)
        }
    };
    let mut is_changed = IdVec::<GivenId, bool>::filled(false, again.len());
    for i in changed {
        let id = GivenId::from_index(first + i);
        (again[id], is_changed[id]) = (term(i), true);
    }
    for shared in &grown.shared {
        if is_changed[shared.whole] {
            let GivenTerm { term, origin, of_class, .. } = &again[shared.whole];
            let (origin, of_class) = (*origin, *of_class);
            let (Term::Tuple(items) | Term::List(items)) = &**term else { return None };
            let term = Rc::new(items.get(shared.part as usize)?.clone());
            again[shared.value] = GivenTerm { term, origin, of_class, of_copy: false };
            is_changed[shared.value] = true;
        }
    }
    Some((grown, Rc::new(again)))
}

/// Returns given values with more of them, at their places.
fn with_more(givens: &Givens, new: impl Iterator<Item = (GivenId, GivenTerm)>) -> Givens {
    let mut old = givens.iter().map(|(_, given)| given.clone());
    let mut again = Givens::new();
    for (id, term) in new {
        again.extend(old.by_ref().take(id.index() - again.len()));
        again.push(term);
    }
    again.extend(old);
    again
}

/// Returns the parts and the given values where some numbers, texts and places are given constants that the document
/// gave nothing before, or that stand behind all that it gave them. `new` is where they stand among `again`. Nothing
/// where that may change more.
fn given_more(
    document: &Document,
    grown: &Grown,
    again: &mut Givens,
    new: &[(GivenId, &Given)],
) -> Option<Grown> {
    let mut body = grown.body.clone();
    // where values decide how many things there are, what is given makes them
    if body.counts_givens {
        return None;
    }
    // each stands behind those that it stood behind
    let before: Vec<usize> = new.iter().enumerate().map(|(n, (id, _))| id.index() - n).collect();
    let moved = |id: GivenId| {
        GivenId::from_index(id.index() + before.partition_point(|&at| at <= id.index()))
    };
    let of_part = |s: &Shared| Shared { value: moved(s.value), whole: moved(s.whole), ..*s };
    let mut shared: Vec<Shared> = grown.shared.iter().map(of_part).collect();
    let givens = Rc::make_mut(&mut body.givens);
    for (_, given) in givens.iter_mut() {
        *given = given.map(|given| GivenIn { value: moved(given.value), ..given });
    }
    for (id, given) in new {
        let thing = thing_at(document, grown, &given.path)?;
        for (value, leaf) in shares(document, grown, (again, &mut shared), (*id, thing))? {
            let is_behind = body.givens[leaf]
                .is_none_or(|given| given.me != ROOT || whole(&shared, given.value) < *id);
            if !is_behind {
                return None;
            }
            Rc::make_mut(&mut body.givens)[leaf] = Some(GivenIn { value, me: ROOT });
        }
    }
    Some(Grown { body, layouts: grown.layouts.clone(), shared })
}

/// Returns the value that was written of which another is a part; `shared` is in order of its values.
fn whole(shared: &[Shared], mut value: GivenId) -> GivenId {
    while let Ok(at) = shared.binary_search_by_key(&value, |s| s.value) {
        value = shared[at].whole;
    }
    value
}

/// Shares a constant that a thing is given among its parts; returns what each number and text gets. Nothing where it is
/// no constant, or another value than its parts have.
fn shares(
    document: &Document,
    grown: &Grown,
    (again, shared): (&mut Givens, &mut Vec<Shared>),
    given: (GivenId, ThingId),
) -> Option<Vec<(GivenId, ThingId)>> {
    let (mut leaves, mut left) = (Vec::new(), vec![given]);
    while let Some((value, thing)) = left.pop() {
        let t = &grown.body.things[thing];
        let (parts, GivenTerm { term, origin, of_class, .. }) = (t.parts, again[value].clone());
        match (&document.classes[t.class].kind, &*term) {
            (
                ClassKind::Primitive(_),
                Term::Number { .. } | Term::Text(_) | Term::Bool(_) | Term::Option(..),
            ) => leaves.push((value, thing)),
            (ClassKind::Composite, Term::Tuple(items)) if items.len() == parts as usize => {
                for (part, term) in (0..).zip(items) {
                    let term = Rc::new(term.clone());
                    let share = again.push(GivenTerm { term, origin, of_class, of_copy: false });
                    shared.push(Shared { value: share, whole: value, part });
                    left.push((share, grown.body.part(thing, part as usize)));
                }
            }
            _ => return None,
        }
    }
    Some(leaves)
}

/// Returns the thing that a path of parts leads to, each of which the thing before it has itself.
fn thing_at(document: &Document, grown: &Grown, path: &Path) -> Option<ThingId> {
    let mut at = ROOT;
    for step in &path.0 {
        let t = &grown.body.things[at];
        let is_list = matches!(document.classes[t.class].kind, ClassKind::List(_));
        let part = match step {
            Step::Part(name) => *grown.layouts[t.class].as_ref()?.index.get(name)?,
            Step::Index(i) if is_list => *i,
            Step::Index(_) | Step::Last | Step::Owner => return None,
        };
        at = (part < t.parts).then(|| grown.body.part(at, part as usize))?;
    }
    Some(at)
}

/// Returns true if two terms differ in constants alone.
fn is_like(a: &Term, b: &Term) -> bool {
    match (a, b) {
        (
            Term::Number { dimension: a, bare: a_bare, .. },
            Term::Number { dimension: b, bare: b_bare, .. },
        ) => a == b && a_bare == b_bare,
        (Term::Text(_), Term::Text(_)) | (Term::Bool(_), Term::Bool(_)) => true,
        (Term::Option(a, _), Term::Option(b, _)) => a == b,
        (Term::Tuple(a), Term::Tuple(b)) | (Term::List(a), Term::List(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_like(a, b))
        }
        (a, b) => a == b,
    }
}

/// Returns true if all that a document's own class says besides what its parts are is as it was.
pub(super) fn is_form_kept(
    document: &Document,
    was: &Document,
    structure: &Structure,
    givens: &Rc<Givens>,
) -> bool {
    let (a, b) = (&document.classes[document.root], &was.classes[was.root]);
    let says_same = a.merges == b.merges
        && a.constraints == b.constraints
        && a.bindings == b.bindings
        && a.messages == b.messages
        && a.inserts == b.inserts
        && a.stays == b.stays
        && a.sides == b.sides
        && a.switches == b.switches
        && a.without == b.without
        && a.attachers == b.attachers
        && a.handles == b.handles;
    let names_same = structure.references.is_empty() || Rc::ptr_eq(givens, &structure.givens);
    says_same
        && names_same
        && document.vertical == was.vertical
        && document.units_per_metre.to_bits() == was.units_per_metre.to_bits()
        && document.scale == was.scale
}
