//! Given values: those of all slots, each after those that it speaks of.
//!
//! What is given in terms of something computed is a binding, and has a constraint in the place of its value. Where it
//! cannot be one, as in a thing that is copied, it is a fault: what it speaks of is not known before the solve.

use crate::evaluator::Evaluator;
use crate::fault::{Fault, FaultKind};
use crate::lookup::Tables;
use crate::measure;
use base::IdVec;
use kernel::{Document, Primitive, SlotId, Structure, Term, Value, Values};
use std::collections::{BTreeMap, VecDeque};
use std::rc::Rc;

/// Computes the given values of all slots, each after those that it speaks of, and says what is wrong with them: a ring
/// of values in terms of each other, one in terms of what is computed. What is not given is zero, false or empty; so
/// are values that have a fault.
///
/// Cost: linear; a value that speaks of many later ones is looked at once more for some of them.
pub fn given_values(document: &Document, structure: &Structure) -> (Values, Vec<Fault>) {
    let mut values = Values::new(structure.slots.len());
    let tables = Rc::new(Tables::new(document));
    let mut faults = Vec::new();
    let nothing = Values::default();
    let constants = Evaluator::with_tables(document, structure, &nothing, tables.clone());
    let mut is_open: IdVec<SlotId, bool> = IdVec::filled(false, structure.slots.len());
    let mut next: VecDeque<SlotId> = VecDeque::new();
    for (slot, s) in structure.slots.iter() {
        if !s.primitive.is_number() {
            values.put(slot, Value::Text("".into()));
        }
        match (structure.given(slot).map(|given| &*given.term), s.primitive) {
            (None, _) => {}
            // speaks of nothing, as most values that are given
            (Some(Term::Number { value, dimension, .. }), Primitive::Real(wanted))
                if measure::common(wanted, *dimension).is_ok() =>
            {
                values.put(slot, Value::Number(*value));
            }
            (Some(Term::Number { .. }), _) => match constants.given(slot) {
                Ok(value) => value.into_iter().for_each(|value| values.put(slot, value)),
                Err(fault) => faults.push(fault),
            },
            (Some(_), _) => {
                is_open[slot] = true;
                next.push_back(slot);
            }
        }
    }
    // values that wait for another, by that other
    let mut waiting: BTreeMap<SlotId, Vec<SlotId>> = BTreeMap::new();
    while let Some(slot) = next.pop_front() {
        let evaluator = Evaluator::with_tables(document, structure, &values, tables.clone());
        let (found, reads) = evaluator.listening(|| evaluator.given(slot));
        // by the time the last of them is known, so are the others, as a rule
        if let Some(&other) = reads.iter().rev().find(|&&read| is_open[read]) {
            waiting.entry(other).or_default().push(slot);
            continue;
        }
        is_open[slot] = false;
        next.extend(waiting.remove(&slot).into_iter().flatten());
        if let Some(&computed) = reads.iter().find(|&&read| structure.slots[read].given.is_none()) {
            let path = structure.path(document, structure.slots[computed].thing);
            let message = format!("a value that is given in terms of {path}, which is computed");
            let origin = structure.given(slot).map(|g| g.origin);
            faults.push(Fault { origin, ..Fault::no_answer(message) });
            continue;
        }
        match found {
            Ok(Some(value)) => values.put(slot, value),
            Ok(None) => {}
            Err(fault) => faults.push(fault),
        }
    }
    for slot in is_open.ids().filter(|&slot| is_open[slot]) {
        let fault = Fault::new(FaultKind::Endless, "a given value that depends on itself");
        faults.push(Fault { origin: structure.given(slot).map(|g| g.origin), ..fault });
    }
    (values, faults)
}
