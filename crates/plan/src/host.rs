//! The host: whoever can compute the value of any expression of the language.
//!
//! `plan` knows numbers and their equations. Texts, given terms and rules over them it asks for.

use crate::rule::{SideOf, Source, Way};
use kernel::{ConstraintInstance, SlotId, Value, Values};

/// What the planner asks of whoever evaluates expressions.
pub trait Host {
    /// Returns the value that a slot has before anything is solved: its given value or, after a
    /// change of structure, the one that it had. Nothing where there is none; then rules make it.
    fn given(&mut self, slot: SlotId, values: &Values) -> Option<Value>;
    /// Computes what a method writes, and where.
    ///
    /// # Errors
    /// Why it cannot, in the words for the user: `"hot".number`.
    fn compute(
        &mut self,
        constraint: ConstraintInstance,
        way: Way,
        values: &Values,
    ) -> Result<Vec<(SlotId, Value)>, String>;
    /// Computes a side of a comparison or of an `or` in the constraint's rule, or the condition of an `if`: how wide a
    /// text is, or 1 where it is another's and 0 where it is not.
    ///
    /// # Errors
    /// Why it cannot, in the words for the user.
    fn number(
        &mut self,
        constraint: ConstraintInstance,
        side: SideOf,
        values: &Values,
    ) -> Result<f64, String>;
    /// Returns true if the constraint's rule is true.
    fn holds(&mut self, constraint: ConstraintInstance, values: &Values) -> bool;
}

/// A method that could not be run.
#[derive(Clone, PartialEq, Debug)]
pub struct Failure {
    /// Where the method comes from.
    pub source: Source,
    /// Why.
    pub message: String,
}
