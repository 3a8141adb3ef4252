//! Gradients: the rows of required rules at one state.
//!
//! In: a rule and numbers. Out: for each of its equations the derivative of `left - right` by every
//! slot that it speaks of.

use crate::rule::{Body, Formula, Rule};
use base::IdVec;
use base::number::RULE_TOLERANCE;
use kernel::{Primitive, SlotId, Structure};
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

/// How large numbers of each kind are.
pub(crate) struct Sizes<'s> {
    structure: &'s Structure,
    of_kinds: Vec<(Primitive, f64)>,
}

impl<'s> Sizes<'s> {
    /// Measures some slots in a state.
    pub(crate) fn of(
        structure: &'s Structure,
        slots: &[SlotId],
        numbers: &IdVec<SlotId, f64>,
    ) -> Self {
        let mut of_kinds: Vec<(Primitive, f64)> = Vec::new();
        for &slot in slots {
            let (kind, size) = (structure.slots[slot].primitive, numbers[slot].abs());
            match of_kinds.iter_mut().find(|known| known.0 == kind) {
                Some(known) => known.1 = known.1.max(size),
                None => of_kinds.push((kind, size)),
            }
        }
        Self { structure, of_kinds }
    }

    fn at(&self, slot: SlotId) -> f64 {
        let kind = self.structure.slots[slot].primitive;
        self.of_kinds.iter().find(|known| known.0 == kind).map_or(0.0, |known| known.1)
    }
}

/// Returns true if the slopes of an equation are rounding alone: were every number moved as far as numbers of its kind
/// are large, its sides would not move apart by what a rule allows.
pub(crate) fn is_rounding(row: &[(SlotId, f64)], sides: &[f64], sizes: &Sizes<'_>) -> bool {
    let larger = sides.iter().fold(0.0_f64, |larger, side| larger.max(side.abs()));
    let moved = row.iter().map(|&(slot, slope)| (slope * sizes.at(slot)).abs());
    row.iter().all(|e| sizes.at(e.0) > 0.0) && moved.sum::<f64>() < RULE_TOLERANCE * larger
}
