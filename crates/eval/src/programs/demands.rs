//! Demands: what a program wants of its parameters before its first step.

use super::{Ended, Run, Why};
use crate::answer::{Answer, Frame};
use crate::evaluator::{Evaluator, Result};
use base::Name;
use kernel::program::Program;
use kernel::{BinaryOperator, Quantity, Term};

/// Returns the parameter and the values of a rule that allows it those of a table alone.
pub fn allowed_table(rule: &Term) -> Option<(&Name, &[Term])> {
    match rule {
        Term::Binary(BinaryOperator::In, of, values) => match (&**of, &**values) {
            (Term::Send { to, name, .. }, Term::List(values)) if **to == Term::Me => {
                Some((name, values))
            }
            _ => None,
        },
        _ => None,
    }
}

impl<'a> Evaluator<'a> {
    /// Says which values are allowed of a parameter, with their units.
    pub fn one_of_in_words(&self, name: &Name, values: &[Answer<'a>]) -> String {
        let values: Vec<String> = values.iter().map(|value| self.in_words(value)).collect();
        format!("{name} has to be one of {}", values.join(", "))
    }
    /// Returns a value as people read it, a number with its unit.
    pub(super) fn in_words(&self, value: &Answer<'a>) -> String {
        match value {
            Answer::Number(x, dimension) => {
                let quantity = Quantity { dimension: *dimension, ..Quantity::default() };
                kernel::show_quantity(*x, quantity, self.document).with_unit()
            }
            other => self.text_of(other),
        }
    }
}

impl<'a> Run<'_, 'a> {
    /// Tests what a program demands of its parameters.
    pub(super) fn demands(
        &self,
        program: &'a Program,
        frame: &Frame<'a>,
    ) -> std::result::Result<(), Ended> {
        for demand in &program.demands {
            let met = self.evaluator.truth(&demand.rule, frame);
            if matches!(met, Ok(true)) {
                continue;
            }
            let mut operands = Vec::new();
            self.parameters(program, &demand.rule, frame, &mut operands);
            let allowed = || {
                let (name, values) = allowed_table(&demand.rule)?;
                let values = values.iter().map(|value| self.evaluator.term(value, frame));
                let values = values.collect::<Result<Vec<_>>>().ok()?;
                Some(self.evaluator.one_of_in_words(name, &values))
            };
            return Err(Ended {
                why: Why::Outside,
                step: demand.name.as_ref().map_or("a demand", Name::as_str).to_string(),
                operands,
                is_called: false,
                reason: match met {
                    Ok(_) => allowed().unwrap_or_default(),
                    Err(fault) => fault.message,
                },
                origin: demand.origin,
            });
        }
        Ok(())
    }

    /// Collects the parameters that a rule speaks of, with their values.
    pub(super) fn parameters(
        &self,
        program: &'a Program,
        rule: &'a Term,
        frame: &Frame<'a>,
        found: &mut Vec<(String, String)>,
    ) {
        match rule {
            Term::Send { to, name, .. } if **to == Term::Me => {
                let is_asked = program.parameters.iter().any(|p| p.name == *name);
                let is_new = found.iter().all(|(known, _)| known != name.as_str());
                if let (true, true, Ok(value)) =
                    (is_asked, is_new, self.evaluator.term(rule, frame))
                {
                    found.push((name.to_string(), self.evaluator.in_words(&value)));
                }
            }
            Term::Send { to, .. } => self.parameters(program, to, frame, found),
            Term::Binary(_, a, b) => {
                self.parameters(program, a, frame, found);
                self.parameters(program, b, frame, found);
            }
            Term::Unary(_, a) => self.parameters(program, a, frame, found),
            Term::Call { arguments, .. } => {
                arguments.iter().for_each(|a| self.parameters(program, &a.value, frame, found));
            }
            _ => {}
        }
    }
}
