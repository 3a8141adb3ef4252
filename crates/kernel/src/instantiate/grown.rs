//! Grown: the parts of a document before its own class spoke of them, kept from one edit to the next.
//!
//! What the document's class says of its parts (merges, constraints, stays, memberships) stands apart
//! from what its parts are. Where an edit left these as they were, they are taken over by identity.

use super::body::Body;
use crate::class::{Class, Given};
use crate::document::Document;
use crate::structure::{GivenId, GivenIn, GivenTerm, Givens, Layouts, Structure, ThingId};
use crate::term::Term;
use base::{Id, IdVec};
use std::rc::Rc;

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

/// Returns the parts of a document before an edit, and the values that they are given after it, if the
/// edit changed nothing of them but constants.
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
    let givens = is_kept.then(|| given_again(document, was, &grown, &structure.givens))??;
    Some((grown, givens))
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

/// Returns the given values after an edit of constants; nothing where it changed more of them.
fn given_again(
    document: &Document,
    was: &Document,
    grown: &Grown,
    givens: &Rc<Givens>,
) -> Option<Rc<Givens>> {
    let (now, then) = [document, was].map(|d| &d.classes[d.root].givens).into();
    if now.len() != then.len() {
        return None;
    }
    // the document's own stand first, behind those of its superclasses
    let above = document.primary_line(document.root).into_iter().skip(1);
    let first: usize = above.map(|c| document.classes[c].givens.len()).sum();
    let mut changed: Vec<usize> = Vec::new();
    for (i, (a, b)) in now.iter().zip(then).enumerate() {
        if Rc::ptr_eq(a, b) || a == b {
            continue;
        }
        if a.path != b.path || !is_like(&a.value, &b.value) {
            return None;
        }
        changed.push(i);
    }
    if changed.is_empty() {
        return Some(givens.clone());
    }
    let mut again = Givens::clone(givens);
    let mut is_changed = IdVec::<GivenId, bool>::filled(false, again.len());
    for i in changed {
        let id = GivenId::from_index(first + i);
        let Given { value, origin, .. } = &*now[i];
        again[id] = GivenTerm { term: value.clone(), origin: *origin, of_copy: false };
        is_changed[id] = true;
    }
    for shared in &grown.shared {
        if is_changed[shared.whole] {
            let GivenTerm { term, origin, .. } = &again[shared.whole];
            let (Term::Tuple(items) | Term::List(items)) = term else { return None };
            let term = items.get(shared.part as usize)?.clone();
            again[shared.value] = GivenTerm { term, origin: *origin, of_copy: false };
            is_changed[shared.value] = true;
        }
    }
    Some(Rc::new(again))
}

/// Returns true if two terms differ in constants alone.
fn is_like(a: &Term, b: &Term) -> bool {
    match (a, b) {
        (
            Term::Number { dimension: a, bare: a_bare, .. },
            Term::Number { dimension: b, bare: b_bare, .. },
        ) => a == b && a_bare == b_bare,
        (Term::Text(_), Term::Text(_)) | (Term::Bool(_), Term::Bool(_)) => true,
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
        && a.messages == b.messages
        && a.inserts == b.inserts
        && a.stays == b.stays
        && a.sides == b.sides
        && a.switches == b.switches
        && a.without == b.without
        && a.attachers == b.attachers;
    let names_same = structure.references.is_empty() || Rc::ptr_eq(givens, &structure.givens);
    says_same
        && names_same
        && document.vertical == was.vertical
        && document.units_per_metre.to_bits() == was.units_per_metre.to_bits()
}
