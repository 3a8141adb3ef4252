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
            Term::Binary(BinaryOperator::Or, ..) => Ok(Some(String::new())),
            Term::Binary(_, a, b) => {
                let [a, b] = [self.evaluator.term(a, frame)?, self.evaluator.term(b, frame)?];
                let [a, b] = [self.evaluator.in_words(&a), self.evaluator.in_words(&b)];
                Ok(Some(format!(": left is {a}, right is {b}")))
            }
            _ => Ok(Some(String::new())),
        }
    }
}

/// The required bounds of a made thing of a class that nothing switches, with the class that says each.
fn bounds(document: &Document, class: ClassId) -> impl Iterator<Item = (ClassId, &Constraint)> {
    let line = document.primary_line(class);
    (0..line.len()).flat_map(move |depth| {
        let says = &document.classes[line[depth]];
        let (nearer, class) = (line[..depth].to_vec(), line[depth]);
        let up_to_here = line[..=depth].to_vec();
        says.constraints.iter().filter_map(move |constraint| {
            let is_switched = up_to_here.iter().any(|&c| {
                let switches = &document.classes[c].switches;
                switches.iter().any(|s| Some(&s.name) == constraint.name.as_ref())
            });
            let is_wanted = constraint.strength == Strength::Required
                && is_bound(&constraint.rule)
                && !is_switched
                && !document.is_masked(&nearer, constraint.name.as_ref());
            is_wanted.then_some((class, constraint))
        })
    })
}

/// Whether a rule says of numbers which is the greater one.
fn is_bound(rule: &Term) -> bool {
    use BinaryOperator::{And, Greater, GreaterEqual, Less, LessEqual, Or};
    match rule {
        Term::Binary(And | Or, a, b) => is_bound(a) && is_bound(b),
        Term::Binary(operator, ..) => {
            matches!(operator, Less | LessEqual | Greater | GreaterEqual)
        }
        _ => false,
    }
}
