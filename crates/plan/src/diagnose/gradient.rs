//! Gradients: the rows of required rules at one state.
//!
//! In: a rule and numbers. Out: for each of its equations the derivative of `left - right` by every
//! slot that it speaks of.

use crate::rule::{Body, Formula, Rule};
use base::IdVec;
use kernel::SlotId;
use solve::{Patterns, Scratch};

/// Returns true if a rule's derivatives are the same at every state.
pub(crate) fn is_linear(patterns: &Patterns, rule: Rule<'_>) -> bool {
    match &rule.shape.body {
        Body::Equations(equations) => equations.iter().all(|e| patterns.get(e.pattern).is_linear()),
        Body::True(_) | Body::Beside(_) | Body::Different(_) | Body::Opaque(_) | Body::Hold(_) => {
            true
        }
    }
}

/// Returns the derivatives of an equation of a rule, slots in order; what is no number is none.
pub(crate) fn gradient(
    patterns: &Patterns,
    rule: Rule<'_>,
    equation: &Formula,
    numbers: &IdVec<SlotId, f64>,
    scratch: &mut Scratch,
) -> Vec<(SlotId, f64)> {
    let slots: Vec<SlotId> = rule.slots_at(&equation.slots).collect();
    let arguments = slots.iter().map(|&s| numbers[s]);
    let mut row: Vec<(SlotId, f64)> = patterns
        .get(equation.pattern)
        .slopes(arguments, scratch)
        .filter(|(_, slope)| slope.is_finite() && *slope != 0.0)
        .map(|(argument, slope)| (slots[argument], slope))
        .collect();
    row.sort_unstable_by_key(|e| e.0);
    row
}
