//! Culprits: the operation that leaves a rule without a value.
//!
//! In: a constraint. Out: which of its operations has no answer for what it is given, as they are written in a line.

use crate::answer::Frame;
use crate::evaluator::Evaluator;
use crate::fault::FaultKind;
use kernel::{BinaryOperator, ConstraintInstance, Term};

/// An operation of a rule, told by its place among those of its kind.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Culprit {
    /// The sign of the operator, or the name of the function.
    pub operation: String,
    /// How many of the same kind are written before it in the rule.
    pub before: usize,
    /// How many of the same kind the rule has.
    pub all: usize,
}

impl<'a> Evaluator<'a> {
    /// Finds the innermost operation of a constraint's rule that has no answer, as a division by zero; nothing where
    /// that happens in what a message answers.
    pub fn culprit(&self, constraint: ConstraintInstance) -> Option<Culprit> {
        let class = &self.document.classes[constraint.class];
        let rule = &class.constraints[constraint.index as usize].rule;
        let frame = Frame::of(constraint.owner);
        let value = |term: &'a Term| {
            self.begin();
            self.term(term, &frame)
        };
        let is_it = |&(_, term): &(&str, &'a Term)| {
            let fails = value(term).is_err_and(|fault| fault.kind == FaultKind::NoAnswer);
            fails && term.operands().into_iter().all(|operand| value(operand).is_ok())
        };
        let mut written = Vec::new();
        in_order(rule, &mut written);
        let at = written.iter().position(is_it)?;
        let operation = written[at].0;
        let alike = |written: &[(&str, &Term)]| written.iter().filter(|w| w.0 == operation).count();
        let (before, all) = (alike(&written[..at]), alike(&written));
        Some(Culprit { operation: operation.into(), before, all })
    }
}

/// Lists operations with their names, in the order in which these are written.
fn in_order<'t>(term: &'t Term, written: &mut Vec<(&'t str, &'t Term)>) {
    match term {
        Term::Binary(operator, left, right) => {
            in_order(left, written);
            written.extend(sign(*operator).map(|sign| (sign, term)));
            in_order(right, written);
        }
        Term::Call { name, arguments } => {
            written.push((name.as_str(), term));
            arguments.iter().for_each(|a| in_order(&a.value, written));
        }
        Term::Send { to, name, arguments, .. } => {
            in_order(to, written);
            written.push((name.as_str(), term));
            arguments.iter().for_each(|a| in_order(&a.value, written));
        }
        other => other.operands().into_iter().for_each(|operand| in_order(operand, written)),
    }
}

/// Returns the sign of an operator that may have no answer.
fn sign(operator: BinaryOperator) -> Option<&'static str> {
    match operator {
        BinaryOperator::Add => Some("+"),
        BinaryOperator::Subtract => Some("-"),
        BinaryOperator::Multiply => Some("*"),
        BinaryOperator::Divide => Some("/"),
        BinaryOperator::Remainder => Some("mod"),
        BinaryOperator::Power => Some("^"),
        BinaryOperator::Equal
        | BinaryOperator::NotEqual
        | BinaryOperator::Less
        | BinaryOperator::LessEqual
        | BinaryOperator::Greater
        | BinaryOperator::GreaterEqual
        | BinaryOperator::And
        | BinaryOperator::Or
        | BinaryOperator::In => None,
    }
}
