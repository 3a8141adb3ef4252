//! What the planner asks of whoever evaluates expressions, answered by `eval`.

use eval::{Evaluator, Side};
use kernel::{ConstraintInstance, Document, OriginId, SlotId, Structure, Value, Values};
use plan::{Host, SideOf, Way};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Answers the planner's questions about texts and given terms.
pub(crate) struct Texts<'a> {
    document: &'a Document,
    structure: &'a Structure,
    /// Given values, computed when first asked for.
    given: Option<Cow<'a, Values>>,
    /// What copies begin with where they are given nothing.
    copied: BTreeMap<SlotId, Value>,
}

impl<'a> Texts<'a> {
    /// Makes an answerer for one structure.
    pub(crate) fn new(document: &'a Document, structure: &'a Structure) -> Self {
        Self { document, structure, given: None, copied: BTreeMap::new() }
    }
    /// Makes an answerer that knows the given values.
    pub(crate) fn knowing(
        document: &'a Document,
        structure: &'a Structure,
        given: &'a Values,
    ) -> Self {
        Self { document, structure, given: Some(Cow::Borrowed(given)), copied: BTreeMap::new() }
    }
    /// Takes what copies begin with: what those have by these values that they are copies of. Returns true if that is
    /// something else than what they are, and than what they began with.
    pub(crate) fn copy(&mut self, values: &Values) -> bool {
        let copied = &self.structure.copied;
        if copied.iter().all(|(&slot, copied)| values.get(slot) == values.get(copied.of)) {
            return false;
        }
        let now = copied.iter().map(|(&slot, copied)| (slot, values.get(copied.of))).collect();
        std::mem::replace(&mut self.copied, now) != self.copied
    }
    /// Returns where a copy is written that began with something else than that has by these values of which it is one.
    pub(crate) fn unlike_copy(&self, values: &Values) -> Option<OriginId> {
        let mut copied = self.structure.copied.iter();
        let is_unlike = |slot, of| self.copied.get(slot).is_some_and(|was| *was != values.get(of));
        let (_, found) = copied.find(|(slot, copied)| is_unlike(slot, copied.of))?;
        Some(self.structure.givens[found.value].origin)
    }
}

impl Host for Texts<'_> {
    fn given(&mut self, slot: SlotId, _: &Values) -> Option<Value> {
        if self.structure.slots[slot].given.is_none() {
            return self.copied.get(&slot).cloned();
        }
        let compute = || Cow::Owned(eval::given_values(self.document, self.structure).0);
        Some(self.given.get_or_insert_with(compute).get(slot))
    }
    fn compute(
        &mut self,
        constraint: ConstraintInstance,
        way: Way,
        values: &Values,
    ) -> Result<Vec<(SlotId, Value)>, String> {
        let evaluator = Evaluator::new(self.document, self.structure, values);
        let written = match way {
            Way::Written(index) => evaluator.method(constraint, index as usize),
            Way::Left(turns) => evaluator.copy_side(constraint, turns.each(), Side::Left),
            Way::Right(turns) => evaluator.copy_side(constraint, turns.each(), Side::Right),
        };
        written.map_err(|f| f.message)
    }
    fn number(
        &mut self,
        constraint: ConstraintInstance,
        side: SideOf,
        values: &Values,
    ) -> Result<f64, String> {
        let evaluator = Evaluator::new(self.document, self.structure, values);
        let of = if side.is_right { Side::Right } else { Side::Left };
        evaluator.side(constraint, side.turns.each(), of).map_err(|f| f.message)
    }
    fn holds(&mut self, constraint: ConstraintInstance, values: &Values) -> bool {
        let evaluator = Evaluator::new(self.document, self.structure, values);
        evaluator.test(constraint).is_ok_and(|verdict| verdict.holds)
    }
}
