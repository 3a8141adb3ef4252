//! Copies: what a part gets of another that is computed is not given.
//!
//! Where a thing is given another, `copy of wheel`, it has the same constraints as that: what they compute
//! there they compute here as well. What other constraints compute there a copy begins with, once that is known. What is
//! given by itself, `z: Real = p.m`, has a value whatever `m` is.

use super::body::Body;
use crate::path::{Path, Step};
use crate::structure::{
    Copied, DOCUMENT, Form, GivenIn, GivenTerm, Givens, Layouts, Paths, Slot, SlotId, ThingId,
};
use crate::term::Term;

/// Takes given values away that are those of computed parts, and of copies of such, and notes what these are copies of.
pub(super) fn forget_computed(form: &mut Form, givens: &Givens) {
    if !givens.iter().any(|(_, given)| given.of_copy) {
        return;
    }
    let from = |(slot, s): (SlotId, &Slot)| {
        let given = &givens[s.given?.value];
        let source = follow(form.paths(), &given.term, s.given?.me).filter(|_| given.of_copy)?;
        Some((slot, form.slot_of(source)?))
    };
    let mut waiting: Vec<(SlotId, SlotId)> = form.slots.iter().filter_map(from).collect();
    loop {
        let before = waiting.len();
        waiting.retain(|&(slot, source)| {
            let is_known = slot == source || form.slots[source].given.is_some();
            if !is_known {
                let given = form.slots[slot].given.take();
                // of a copy of a copy, what that one is a copy of
                let of = form.copied.get(&source).map_or(source, |copied| copied.of);
                let copied = given.map(|given| Copied { of, value: given.value });
                form.copied.extend(copied.map(|copied| (slot, copied)));
            }
            is_known
        });
        if waiting.len() == before {
            return;
        }
    }
}

/// Returns true for the copy of what a thing is merged with: it says nothing, and what else is given counts.
pub(super) fn is_of_itself(
    body: &Body,
    layouts: &Layouts,
    givens: &Givens,
    (thing, given): (ThingId, GivenIn),
) -> bool {
    let GivenTerm { term, of_copy, .. } = &givens[given.value];
    (*of_copy || matches!(**term, Term::Copy(_)))
        && follow(body.paths(layouts), term, given.me)
            .is_some_and(|source| body.merged[source] == body.merged[thing])
}

/// Returns the part of another thing that a given value is, if it is no more than that.
fn follow(paths: Paths<'_>, term: &Term, me: ThingId) -> Option<ThingId> {
    let step = |from: ThingId, step: Step| paths.follow(from, &Path(vec![step])).ok();
    match term {
        Term::Me => Some(me),
        Term::Document => Some(DOCUMENT),
        Term::Owner => step(me, Step::Owner),
        Term::Copy(of) => follow(paths, of, me),
        Term::Send { to, name, arguments, search: None } if arguments.is_empty() => {
            step(follow(paths, to, me)?, Step::Part(name.clone()))
        }
        Term::Index(list, at) => match at.as_ref() {
            Term::Number { value, .. } if value.fract() == 0.0 && *value >= 0.0 => {
                step(follow(paths, list, me)?, Step::Index(*value as u32))
            }
            _ => None,
        },
        _ => None,
    }
}
