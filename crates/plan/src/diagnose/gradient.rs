//! Gradients: the rows of required rules at one state.
//!
//! In: a rule and numbers. Out: for each of its equations the derivative of `left - right` by every
//! slot that it speaks of. What can be known of a pattern is worked out once.

use crate::rule::{Body, Formula, Rule};
use base::IdVec;
use expr::{Node, Tape, Var};
use kernel::SlotId;
use solve::{PatternId, Patterns};
use std::collections::BTreeMap;

/// The derivatives of the patterns met so far, and working space.
#[derive(Debug, Default)]
pub(crate) struct Gradients {
    made: BTreeMap<PatternId, Derived>,
    arguments: Vec<f64>,
    registers: Vec<f64>,
}

/// The derivatives of a pattern by its arguments.
#[derive(Debug)]
struct Derived {
    tape: Tape,
    arity: usize,
    is_linear: bool,
}

impl Gradients {
    fn derived(&mut self, patterns: &Patterns, id: PatternId) -> &Derived {
        self.made.entry(id).or_insert_with(|| {
            let pattern = patterns.get(id);
            let mut arena = pattern.arena().clone();
            let residual = arena.sub(pattern.roots()[0], pattern.roots()[1]);
            let arguments: Vec<Var> = (0..pattern.arity() as u32).map(Var).collect();
            let slopes = expr::gradient(&mut arena, residual, &arguments);
            let is_linear = slopes.iter().all(|&s| matches!(arena.node(s), Node::Constant(_)));
            Derived { tape: Tape::compile(&arena, &slopes), arity: pattern.arity(), is_linear }
        })
    }

    /// Returns true if the derivatives are the same at every state.
    pub(crate) fn is_linear(&mut self, patterns: &Patterns, rule: Rule<'_>) -> bool {
        match &rule.shape.body {
            Body::Equations(equations) => {
                equations.iter().all(|e| self.derived(patterns, e.pattern).is_linear)
            }
            Body::True(_) | Body::Different(_) | Body::Opaque(_) | Body::Hold(_) => true,
        }
    }

    /// Returns the derivatives of an equation of a rule, slots in order; what is no number is none.
    pub(crate) fn row(
        &mut self,
        patterns: &Patterns,
        rule: Rule<'_>,
        equation: &Formula,
        numbers: &IdVec<SlotId, f64>,
    ) -> Vec<(SlotId, f64)> {
        let mut arguments = std::mem::take(&mut self.arguments);
        let mut registers = std::mem::take(&mut self.registers);
        let derived = self.derived(patterns, equation.pattern);
        arguments.clear();
        arguments.extend(rule.slots_at(&equation.slots).map(|s| numbers[s]));
        let mut slopes = vec![0.0; derived.arity];
        derived.tape.run(&arguments, &mut registers, &mut slopes);
        (self.arguments, self.registers) = (arguments, registers);
        let mut row: Vec<(SlotId, f64)> = rule
            .slots_at(&equation.slots)
            .zip(slopes)
            .filter(|(_, slope)| slope.is_finite() && *slope != 0.0)
            .collect();
        row.sort_unstable_by_key(|e| e.0);
        row
    }
}
