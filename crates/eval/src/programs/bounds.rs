//! Bounds of made things: what a program makes has no solver behind it, so it is within the bounds that its class says,
//! or the step that makes it fails. An equality is left to whoever makes it: an arc takes its end as a direction.

use super::Run;
use crate::answer::{Answer, Frame};
use crate::evaluator::Result;
use crate::fault::Fault;
use base::Name;
use kernel::{BinaryOperator, ClassId, Constraint, DOCUMENT, Document, Strength, Term};

impl<'a> Run<'_, 'a> {
    /// Passes on what a step has made, where it is within the bounds of its class.
    ///
    /// # Errors
    /// The first bound that it does not keep, with its sides.
    pub(super) fn within_bounds(&self, made: Answer<'a>) -> Result<Answer<'a>> {
        let Answer::Made(of) = &made else { return Ok(made) };
        for (class, constraint) in bounds(self.evaluator.document, of.class) {
            let frame = Frame::sent(made.clone(), DOCUMENT);
            let Some(sides) = self.broken(&constraint.rule, &frame)? else { continue };
            let class = &self.evaluator.document.classes[class].name;
            let name = constraint.name.as_ref().map_or("a constraint", Name::as_str);
            return Err(Fault::wrong(format!("{name} of {class} does not hold{sides}")));
        }
        Ok(made)
    }

    /// Says how far apart the sides of a bound are that does not hold; nothing of one that does.
    fn broken(&self, rule: &'a Term, frame: &Frame<'a>) -> Result<Option<String>> {
        if self.evaluator.truth(rule, frame)? {
            return Ok(None);
        }
        match rule {
            Term::Binary(BinaryOperator::And, a, b) => {
                Ok(self.broken(a, frame)?.or(self.broken(b, frame)?))
            }
            Term::Binary(operator, a, b) if *operator != BinaryOperator::Or => {
                let [a, b] = [self.evaluator.term(a, frame)?, self.evaluator.term(b, frame)?];
                let [a, b] = [self.evaluator.in_words(&a), self.evaluator.in_words(&b)];
                Ok(Some(format!(": left is {a}, right is {b}")))
            }
            _ => Ok(Some(String::new())),
        }
    }
}

/// The required bounds of a made thing of a class that nothing switches, with the class that says each.
fn bounds(document: &Document, class: ClassId) -> Vec<(ClassId, &Constraint)> {
    let line = document.primary_line(class);
    let mut all = Vec::new();
    for (above, &of) in line.iter().enumerate() {
        for constraint in &document.classes[of].constraints {
            let is_switched = line[..=above].iter().any(|&nearer| {
                let switches = &document.classes[nearer].switches;
                switches.iter().any(|switch| Some(&switch.name) == constraint.name.as_ref())
            });
            if constraint.strength == Strength::Required
                && is_bound(&constraint.rule)
                && !is_switched
                && !document.is_masked(&line[..above], constraint.name.as_ref())
            {
                all.push((of, constraint));
            }
        }
    }
    all
}

/// Whether a rule says of numbers which is the greater one.
fn is_bound(rule: &Term) -> bool {
    match rule {
        Term::Binary(BinaryOperator::And | BinaryOperator::Or, a, b) => is_bound(a) && is_bound(b),
        Term::Binary(operator, ..) => operator.is_order(),
        _ => false,
    }
}
