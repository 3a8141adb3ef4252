//! What the planner asks of whoever evaluates expressions, answered by `eval`.

use eval::{Evaluator, Side};
use kernel::{ConstraintInstance, Document, SlotId, Structure, Value, Values};
use plan::{Host, SideOf, Way};
use std::borrow::Cow;

/// Answers the planner's questions about texts and given terms.
pub(crate) struct Texts<'a> {
    document: &'a Document,
    structure: &'a Structure,
    /// Given values, computed when first asked for.
    given: Option<Cow<'a, Values>>,
}

impl<'a> Texts<'a> {
    /// Makes an answerer for one structure.
    pub(crate) fn new(document: &'a Document, structure: &'a Structure) -> Self {
        Self { document, structure, given: None }
    }
    /// Makes an answerer that knows the given values.
    pub(crate) fn knowing(
        document: &'a Document,
        structure: &'a Structure,
        given: &'a Values,
    ) -> Self {
        Self { document, structure, given: Some(Cow::Borrowed(given)) }
    }
}

impl Host for Texts<'_> {
    fn given(&mut self, slot: SlotId, _: &Values) -> Option<Value> {
        self.structure.slots[slot].given.as_ref()?;
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
