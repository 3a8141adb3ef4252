//! Equality of whole things, part by part.

use crate::answer::Answer;
use crate::evaluator::{Evaluator, Result};
use crate::fault::{Fault, FaultKind};
use kernel::ClassId;

/// What is done with every pair of values without parts.
pub(crate) type EachLeaf<'f, 'a> = dyn FnMut(&Answer<'a>, &Answer<'a>) -> Result<()> + 'f;

impl<'a> Evaluator<'a> {
    /// Names every pair of values without parts that are equal where `a` and `b` are.
    ///
    /// Lists and tuples compare by position, things by the parts that they have from their nearest
    /// common ancestor. A thing is equal to what it is merged with, and then nothing is named.
    ///
    /// # Errors
    /// Values that cannot be compared: different lengths, nothing in common, functions.
    pub(crate) fn leaves(
        &self,
        a: &Answer<'a>,
        b: &Answer<'a>,
        each: &mut EachLeaf<'_, 'a>,
    ) -> Result<()> {
        self.burn()?;
        match (a, b) {
            (Answer::Function(_) | Answer::Picture(_), _)
            | (_, Answer::Function(_) | Answer::Picture(_)) => {
                Err(Fault::wrong(format!("{} is not compared", self.kind(a))))
            }
            (Answer::Number(..) | Answer::Bool(_) | Answer::Option(..) | Answer::Text(_), _)
            | (_, Answer::Number(..) | Answer::Bool(_) | Answer::Option(..) | Answer::Text(_)) => {
                each(a, b)
            }
            (Answer::Thing(s), Answer::Thing(t))
                if self.structure.merged[*s] == self.structure.merged[*t] =>
            {
                Ok(())
            }
            (Answer::List(_), _) | (_, Answer::List(_)) => self.pairs(a, b, each),
            (
                Answer::Thing(_) | Answer::Made(_) | Answer::Context(_),
                Answer::Thing(_) | Answer::Made(_) | Answer::Context(_),
            ) => {
                if self.items(a).is_ok() && self.items(b).is_ok() {
                    return self.pairs(a, b, each);
                }
                let class = self.common_ancestor(a, b)?;
                let layout = self.layout(class);
                self.deeper(|| {
                    layout.fields.iter().try_for_each(|&field| {
                        let name = self.document.field_name(field);
                        let nearest = kernel::DOCUMENT;
                        let a = self.send(a, name, Vec::new(), None, nearest)?;
                        let b = self.send(b, name, Vec::new(), None, nearest)?;
                        self.leaves(&a, &b, each)
                    })
                })
            }
        }
    }

    fn pairs(&self, a: &Answer<'a>, b: &Answer<'a>, each: &mut EachLeaf<'_, 'a>) -> Result<()> {
        let (a, b) = (self.by_position(a)?, self.by_position(b)?);
        if a.len() != b.len() {
            let message = format!("{} elements and {} are never equal", a.len(), b.len());
            return Err(Fault::new(FaultKind::Unequal, message));
        }
        self.deeper(|| a.iter().zip(&b).try_for_each(|(a, b)| self.leaves(a, b, each)))
    }

    /// Returns the elements of a list, or the stored parts of a thing, in order.
    pub(crate) fn by_position(&self, answer: &Answer<'a>) -> Result<Vec<Answer<'a>>> {
        if let Ok(items) = self.items(answer) {
            return Ok(items.to_vec());
        }
        match answer {
            Answer::Thing(t) => self.structure.parts(*t).map(|t| self.part(t)).collect(),
            Answer::Made(made) => Ok(made.fields.clone()),
            Answer::Number(..)
            | Answer::Bool(_)
            | Answer::Option(..)
            | Answer::Text(_)
            | Answer::Context(_)
            | Answer::List(_)
            | Answer::Picture(_)
            | Answer::Function(_) => {
                Err(Fault::wrong(format!("{} has no parts", self.kind(answer))))
            }
        }
    }

    /// Returns the nearest class that both things are of and that has parts.
    pub(crate) fn common_ancestor(&self, a: &Answer<'a>, b: &Answer<'a>) -> Result<ClassId> {
        let (Some(ca), Some(cb)) = (self.class_of(a), self.class_of(b)) else {
            let message = format!("{} and {} have nothing in common", self.kind(a), self.kind(b));
            return Err(Fault::wrong(message));
        };
        if ca == cb {
            return Ok(ca);
        }
        let others = self.document.lineage(cb);
        let nearest = self.document.lineage(ca).into_iter().find(|c| others.contains(c));
        nearest.filter(|&c| !self.layout(c).fields.is_empty()).ok_or_else(|| {
            let name = |c: ClassId| &self.document.classes[c].name;
            Fault::wrong(format!("{} and {} have no parts in common", name(ca), name(cb)))
        })
    }

    /// Returns the class of a thing, or of what was made; nothing for values.
    pub fn class_of(&self, answer: &Answer<'a>) -> Option<ClassId> {
        match answer {
            Answer::Thing(t) => Some(self.structure.things[*t].class),
            Answer::Made(made) => Some(made.class),
            Answer::Context(context) => Some(context.class),
            Answer::Number(..)
            | Answer::Bool(_)
            | Answer::Option(..)
            | Answer::Text(_)
            | Answer::List(_)
            | Answer::Picture(_)
            | Answer::Function(_) => None,
        }
    }
}
