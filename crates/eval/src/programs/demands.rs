//! Demands: what a program wants of its parameters before its first step.

use super::{Ended, Run, Why};
use crate::answer::{Answer, Frame};
use crate::evaluator::Evaluator;
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

/// Returns the parameter and the ends of a rule that allows it a range: `least <= d and d <= most`.
fn allowed_range(rule: &Term) -> Option<(&Name, [&Term; 2])> {
    let Term::Binary(BinaryOperator::And, least, most) = rule else { return None };
    let (Term::Binary(BinaryOperator::LessEqual, least, of), Term::Binary(less, same, most)) =
        (&**least, &**most)
    else {
        return None;
    };
    let is_less = matches!(less, BinaryOperator::Less | BinaryOperator::LessEqual);
    match &**of {
        Term::Send { to, name, .. } if **to == Term::Me && of == same && is_less => {
            Some((name, [least, most]))
        }
        _ => None,
    }
}

impl<'a> Evaluator<'a> {
    /// Says which values are allowed of a parameter, with their units.
    pub fn one_of_in_words(&self, name: &Name, values: &[Answer<'a>]) -> String {
        let values: Vec<String> = values.iter().map(|value| self.in_words(value)).collect();
        format!("{name} has to be one of {}", values.join(", "))
    }
    /// Returns a value as people read it; of a figure of many parts what it is.
    pub(super) fn in_words_briefly(&self, value: &Answer<'a>) -> String {
        /// So many letters are read at a glance.
        const LONGEST: usize = 80;
        let words = self.in_words(value);
        match value {
            Answer::Made(made) if words.len() > LONGEST => {
                format!("{}(…)", self.document.classes[made.class].name)
            }
            Answer::List(items) if words.len() > LONGEST => format!("[{} elements]", items.len()),
            _ => words,
        }
    }
    /// Returns a value as people read it, every number with its unit.
    pub fn in_words(&self, value: &Answer<'a>) -> String {
        self.in_words_as(value, "")
    }
    /// The same of what is of a class: angles are in degrees.
    fn in_words_as(&self, value: &Answer<'a>, class: &str) -> String {
        match value {
            Answer::Number(x, dimension) => {
                let quantity = Quantity { dimension: *dimension, class, written: "" };
                kernel::show_quantity(*x, quantity, self.document).with_unit()
            }
            Answer::Made(made) => {
                let of = |field| &*self.document.classes[self.document.field_class(field)].name;
                let classes = self.document.layout(made.class).into_iter().map(of);
                let said = made.fields.iter().zip(classes);
                let said = said.map(|(field, class)| self.in_words_as(field, class));
                let name = &self.document.classes[made.class].name;
                format!("{name}({})", said.collect::<Vec<_>>().join(", "))
            }
            Answer::List(items) => Self::listed_as(&|item| self.in_words(item), items, ['[', ']']),
            other => self.text_of(other),
        }
    }
}

impl<'a> Run<'_, 'a> {
    /// Tests what a program demands of its parameters.
    pub(super) fn demands(&self, program: &'a Program, frame: &Frame<'a>) -> Result<(), Ended> {
        for demand in &program.demands {
            let met = self.evaluator.truth(&demand.rule, frame);
            if matches!(met, Ok(true)) {
                continue;
            }
            let mut operands = Vec::new();
            self.parameters(program, &demand.rule, frame, &mut operands);
            return Err(Ended {
                why: Why::Outside,
                step: demand.said.to_string(),
                operands,
                is_called: false,
                reason: match met {
                    Ok(_) => self.allowed(&demand.rule, frame).unwrap_or_default(),
                    Err(fault) => fault.message,
                },
                origin: demand.origin,
            });
        }
        Ok(())
    }

    /// Says what a rule allows of a parameter that has a range or a table; nothing of any other rule.
    fn allowed(&self, rule: &'a Term, frame: &Frame<'a>) -> Option<String> {
        let value = |term: &'a Term| self.evaluator.term(term, frame).ok();
        if let Some((name, values)) = allowed_table(rule) {
            let values = values.iter().map(value).collect::<Option<Vec<_>>>()?;
            return Some(self.evaluator.one_of_in_words(name, &values));
        }
        let (name, [least, most]) = allowed_range(rule)?;
        let [least, most] = [value(least)?, value(most)?].map(|end| self.evaluator.in_words(&end));
        Some(format!("{name} has to be from {least} to {most}"))
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
