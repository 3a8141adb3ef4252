//! What is always true of a structure, as sentences that are tested.
//!
//! - An owner stands before its parts, and its parts stand together.
//! - A thing's identity is its own identity's identity, and merged things share their slot.
//! - Every primitive thing has a slot, and no other thing has one.
//! - A slot's first thing has that slot.
//! - Values hold one number for each slot, all finite and none negative zero.

use crate::class::ClassKind;
use crate::document::Document;
use crate::structure::Structure;
use crate::values::Values;

/// Tests every sentence.
///
/// # Errors
/// The first sentence that is not true, with the thing or slot where it fails.
pub fn structure(document: &Document, structure: &Structure) -> Result<(), String> {
    for (id, thing) in structure.things.iter() {
        if thing.parts > 0 && thing.first_part <= id {
            return Err(format!("an owner stands before its parts: {id}"));
        }
        if structure.parts(id).any(|p| structure.things[p].owner != Some(id)) {
            return Err(format!("the parts of a thing stand together: {id}"));
        }
        let first = structure.merged[id];
        if structure.merged[first] != first {
            return Err(format!("an identity is its own identity: {id}"));
        }
        let primitive = matches!(document.classes[thing.class].kind, ClassKind::Primitive(_));
        if primitive != structure.slot_of(id).is_some() {
            return Err(format!("primitive things, and only they, have slots: {id}"));
        }
        if structure.slot_of(first) != structure.slot_of(id) {
            return Err(format!("merged things share their slot: {id}"));
        }
    }
    for (id, slot) in structure.slots.iter() {
        if structure.slot_of(slot.thing) != Some(id) {
            return Err(format!("a slot's first thing has that slot: {id}"));
        }
    }
    Ok(())
}

/// Tests what is always true of values.
///
/// # Errors
/// The slot where it fails.
pub fn values(structure: &Structure, values: &Values) -> Result<(), String> {
    if values.numbers.len() != structure.slots.len() {
        return Err("values hold one number for each slot".into());
    }
    for (slot, &x) in values.numbers.iter() {
        if !x.is_finite() || (x == 0.0 && x.is_sign_negative()) {
            return Err(format!("numbers are finite, and zero is positive: {slot} is {x}"));
        }
    }
    Ok(())
}
