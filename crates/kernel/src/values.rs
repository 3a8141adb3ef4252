//! Values: what is in the slots.

use crate::structure::SlotId;
use base::IdVec;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The content of one slot.
#[derive(Clone, PartialEq, Debug)]
pub enum Value {
    /// A number in base units; whole numbers and truth values too.
    Number(f64),
    /// A text or a colour.
    Text(Arc<str>),
}

impl Value {
    /// Returns true if both have the same bits.
    pub fn same_bits(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Number(a), Self::Number(b)) => a.to_bits() == b.to_bits(),
            (Self::Text(a), Self::Text(b)) => a == b,
            (Self::Number(_), Self::Text(_)) | (Self::Text(_), Self::Number(_)) => false,
        }
    }
}

/// The contents of all slots of a structure.
///
/// Numbers are dense, one for every slot (0 where the slot holds a text); texts, which are few, stand
/// beside.
/// No NaN, no infinity and no negative zero is ever stored.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Values {
    /// The number in each slot, in base units.
    pub numbers: IdVec<SlotId, f64>,
    /// The text in each slot that holds one.
    pub texts: BTreeMap<SlotId, Arc<str>>,
}

impl Values {
    /// Makes values for `n` slots: zero, and no text.
    pub fn new(n: usize) -> Self {
        Self { numbers: IdVec::filled(0.0, n), texts: BTreeMap::new() }
    }
    /// Returns what is in a slot.
    pub fn get(&self, slot: SlotId) -> Value {
        match self.texts.get(&slot) {
            Some(text) => Value::Text(text.clone()),
            None => Value::Number(self.numbers[slot]),
        }
    }
    /// Puts a value into a slot. Negative zero becomes zero.
    pub fn put(&mut self, slot: SlotId, value: Value) {
        match value {
            Value::Number(x) => {
                debug_assert!(x.is_finite(), "only finite numbers are stored");
                self.numbers[slot] = x + 0.0;
                self.texts.remove(&slot);
            }
            Value::Text(text) => {
                self.texts.insert(slot, text);
            }
        }
    }
    /// Returns the slots whose contents differ in any bit.
    pub fn changed<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = SlotId> + 'a {
        let has_texts = !self.texts.is_empty() || !other.texts.is_empty();
        self.numbers.ids().filter(move |&s| {
            self.numbers[s].to_bits() != other.numbers[s].to_bits()
                || has_texts && self.texts.get(&s) != other.texts.get(&s)
        })
    }
}
