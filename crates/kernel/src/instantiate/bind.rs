//! Bindings: what a part is given in terms of others holds at all times.
//!
//! In: slots with what they are given. Out: where that is a binding the slot has its constraint instead, and where
//! it is something else the binding's constraint is gone. A body's value so takes the place of a class's binding.

use super::copies::forget_computed;
use crate::class::Binding;
use crate::document::Document;
use crate::structure::{ConstraintInstance, Form, Givens, SlotId};
use std::collections::BTreeSet;
use std::rc::Rc;

/// Settles for every binding whether it holds, and takes values away that are those of computed parts.
pub(super) fn bind(document: &Document, form: &mut Form, givens: &Givens) {
    if document.classes.iter().all(|(_, class)| class.bindings.is_empty()) {
        return forget_computed(form, givens);
    }
    let bound = |&instance: &ConstraintInstance| {
        let bindings = &document.classes[instance.class].bindings;
        let at = bindings.binary_search_by_key(&instance.index, |b| b.constraint).ok()?;
        let part = form.follow(instance.owner, &bindings[at].path).ok();
        let slots = part.map(|part| form.slots_under(part)).unwrap_or_default();
        Some((instance, &bindings[at], slots))
    };
    let bindings: Vec<_> = form.constraints.iter().filter_map(bound).collect();
    let (hold, others): (Vec<_>, Vec<_>) =
        bindings.into_iter().partition(|(of, binding, slots)| {
            !slots.is_empty() && slots.iter().all(|&slot| counts(form, givens, *of, binding, slot))
        });
    for slot in hold.into_iter().flat_map(|(_, _, slots)| slots) {
        form.slots[slot].given = None;
        form.bound.insert(slot);
    }
    forget_computed(form, givens);
    // what a copy gets of a bound part is bound there as well
    let mut gone: BTreeSet<ConstraintInstance> = BTreeSet::new();
    for (instance, _, slots) in others {
        let is_free =
            |slot: &SlotId| form.slots[*slot].given.is_none() && !form.bound.contains(slot);
        match !slots.is_empty() && slots.iter().all(is_free) {
            true => form.bound.extend(slots),
            false => drop(gone.insert(instance)),
        }
    }
    if !gone.is_empty() {
        let kept = form.constraints.iter().filter(|c| !gone.contains(c));
        form.constraints = Rc::new(kept.copied().collect());
    }
}

/// Returns true if a binding is what counts of all that a slot is given.
fn counts(
    form: &Form,
    givens: &Givens,
    of: ConstraintInstance,
    binding: &Binding,
    slot: SlotId,
) -> bool {
    form.slots[slot].given.is_some_and(|given| {
        form.merged[given.me] == form.merged[of.owner]
            && givens[given.value].origin == binding.value
    })
}
