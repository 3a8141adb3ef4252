//! Fixed: what an answer is now, as a term that speaks of nothing, and what it is called.

use crate::answer::Answer;
use crate::evaluator::{Evaluator, Result};
use crate::fault::Fault;
use kernel::{Argument, ClassId, ClassKind, Term};

impl<'a> Evaluator<'a> {
    /// Returns a term that speaks of nothing and is what an answer is now: things by position.
    ///
    /// # Errors
    /// Pictures, functions and what programs draw are no values.
    pub fn fixed(&self, answer: &Answer<'a>) -> Result<Term> {
        let all = |items: &[Answer<'a>]| {
            self.deeper(|| items.iter().map(|item| self.fixed(item)).collect::<Result<Vec<Term>>>())
        };
        Ok(match answer {
            Answer::Number(value, dimension) => {
                Term::Number { value: *value, dimension: *dimension, bare: false }
            }
            Answer::Bool(b) => Term::Bool(*b),
            Answer::Option(of, at) => Term::Option(*of, *at),
            Answer::Text(text) => Term::Text(text.to_string()),
            Answer::List(items) => Term::List(all(items)?),
            Answer::Made(made) => made_of(made.class, all(&made.fields)?),
            Answer::Thing(thing) => {
                let parts = all(&self.by_position(answer)?)?;
                let class = self.structure.things[*thing].class;
                match self.document.classes[class].kind {
                    ClassKind::List(_) | ClassKind::Set(_) => Term::List(parts),
                    ClassKind::Primitive(_) | ClassKind::Composite | ClassKind::Reference(_) => {
                        made_of(class, parts)
                    }
                }
            }
            Answer::Context(_) | Answer::Picture(_) | Answer::Function(_) => {
                return Err(Fault::wrong(format!("{} is no value", self.kind(answer))));
            }
        })
    }

    /// Returns the name of an option of a choice.
    pub fn option_name(&self, answer: &Answer<'a>) -> String {
        let Answer::Option(of, at) = answer else { return String::new() };
        let name = self.document.option_at(*of, f64::from(*at));
        name.map_or_else(String::new, ToString::to_string)
    }
}

/// Makes the term of a new thing with these parts.
fn made_of(class: ClassId, parts: Vec<Term>) -> Term {
    let arguments = parts.into_iter().map(|value| Argument { label: None, value }).collect();
    Term::Make { class, arguments }
}
