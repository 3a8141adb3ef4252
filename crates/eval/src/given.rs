//! Given values: those of all slots, each after those that it speaks of.
//!
//! What is given in terms of something computed is *late*: it can be read only once that is solved. Whoever
//! opens a document solves with what is known, lets late values be read again, and solves once more, until
//! nothing is another. Each round settles at least one, unless values are given in terms of what is computed
//! from them.

use crate::evaluator::Evaluator;
use crate::fault::{Fault, FaultKind};
use crate::lookup::Tables;
use crate::measure;
use base::IdVec;
use kernel::{Document, Primitive, SlotId, Structure, Term, Value, Values};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::rc::Rc;

/// How often late values are read again: one may speak of what is computed from another, that of what is
/// computed from a third, so many times over.
const MOST_ROUNDS: usize = 100;

/// The given values of a structure.
#[derive(Clone, Debug)]
pub struct Given {
    /// By slot. What is not given is zero, false or empty; so are values that have a fault.
    pub values: Values,
    faults: Vec<(SlotId, Fault)>,
    late: Late,
}

/// Values that are given in terms of what is computed, or of each other.
#[derive(Clone, Debug, Default)]
struct Late {
    /// Each after those that it speaks of.
    slots: Vec<SlotId>,
    /// What they speak of that is not given.
    reads: BTreeSet<SlotId>,
}

impl Given {
    /// Computes the given values of all slots, each after those that it speaks of. Values that are given in
    /// terms of each other in a ring are faults.
    ///
    /// Cost: linear; a value that speaks of many later ones is looked at once more for some of them.
    pub fn of(document: &Document, structure: &Structure) -> Self {
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
            match (structure.given(slot).map(|given| &given.term), s.primitive) {
                (None, _) => {}
                // speaks of nothing, as most values that are given
                (Some(Term::Number { value, dimension, .. }), Primitive::Real(wanted))
                    if measure::common(wanted, *dimension).is_ok() =>
                {
                    values.put(slot, Value::Number(*value));
                }
                (Some(Term::Number { .. }), _) => match constants.given(slot) {
                    Ok(value) => value.into_iter().for_each(|value| values.put(slot, value)),
                    Err(fault) => faults.push((slot, fault)),
                },
                (Some(_), _) => {
                    is_open[slot] = true;
                    next.push_back(slot);
                }
            }
        }
        let mut late = Late::default();
        let mut is_late: BTreeSet<SlotId> = BTreeSet::new();
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
            let is_computed = |r: &SlotId| structure.slots[*r].given.is_none();
            if reads.iter().any(|r| is_computed(r) || is_late.contains(r)) {
                late.reads.extend(reads.into_iter().filter(is_computed));
                late.slots.push(slot);
                is_late.insert(slot);
            }
            match found {
                Ok(Some(value)) => values.put(slot, value),
                Ok(None) => {}
                Err(fault) => faults.push((slot, fault)),
            }
        }
        for slot in is_open.ids().filter(|&slot| is_open[slot]) {
            faults.push((slot, endless(structure, slot, "a given value that depends on itself")));
        }
        Self { values, faults, late }
    }

    /// Returns what is wrong with them.
    pub fn faults(&self) -> impl Iterator<Item = &Fault> {
        self.faults.iter().map(|(_, fault)| fault)
    }

    /// Returns how often at most late values are read again: each time settles at least one.
    pub fn rounds(&self) -> usize {
        self.late.slots.len().min(MOST_ROUNDS)
    }

    /// Reads late values again, where what they speak of came to what it is in `solved`. Returns those that
    /// are others now.
    pub fn read_again(
        &mut self,
        document: &Document,
        structure: &Structure,
        solved: &Values,
    ) -> Vec<SlotId> {
        if self.late.slots.is_empty() {
            return Vec::new();
        }
        for &slot in &self.late.reads {
            self.values.put(slot, solved.get(slot));
        }
        let tables = Rc::new(Tables::new(document));
        let mut others = Vec::new();
        for &slot in &self.late.slots {
            let evaluator =
                Evaluator::with_tables(document, structure, &self.values, tables.clone());
            let found = evaluator.given(slot);
            self.faults.retain(|(known, _)| *known != slot);
            match found {
                Ok(Some(value)) if !value.same_bits(&self.values.get(slot)) => {
                    self.values.put(slot, value);
                    others.push(slot);
                }
                Ok(_) => {}
                Err(fault) => self.faults.push((slot, fault)),
            }
        }
        others
    }

    /// Gives values up that are in terms of what is computed from them: they are faults, and zero.
    pub fn give_up(&mut self, structure: &Structure, slots: &[SlotId]) {
        for &slot in slots {
            self.values.put(
                slot,
                match structure.slots[slot].primitive.is_number() {
                    true => Value::Number(0.0),
                    false => Value::Text("".into()),
                },
            );
            let message = "a given value in terms of what is computed from it";
            self.faults.push((slot, endless(structure, slot, message)));
        }
    }
}

fn endless(structure: &Structure, slot: SlotId, message: &str) -> Fault {
    let fault = Fault::new(FaultKind::Endless, message);
    Fault { origin: structure.given(slot).map(|g| g.origin), ..fault }
}

/// Computes the given values of all slots, before anything is solved, and says what is wrong with them.
pub fn given_values(document: &Document, structure: &Structure) -> (Values, Vec<Fault>) {
    let given = Given::of(document, structure);
    let faults = given.faults.into_iter().map(|(_, fault)| fault).collect();
    (given.values, faults)
}
