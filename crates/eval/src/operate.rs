//! Operators: arithmetic, comparison, membership.

use crate::answer::Answer;
use crate::evaluator::{Evaluator, Result};
use crate::fault::{Fault, FaultKind};
use crate::measure;
use crate::replay::{Binary, Unary, is_marked};
use expr::dimension::Dimension;
use kernel::{BinaryOperator, UnaryOperator};
use std::rc::Rc;

/// Longer texts are not made: each of a row of parts may join the one before to itself.
const LONGEST_TEXT: usize = 1_000_000;

impl<'a> Evaluator<'a> {
    /// Returns the answer of `and` and `or` where the left side alone decides it.
    pub(crate) fn decided(
        &self,
        operator: BinaryOperator,
        a: &Answer<'a>,
    ) -> Result<Option<Answer<'a>>> {
        let deciding = match operator {
            BinaryOperator::And => false,
            BinaryOperator::Or => true,
            BinaryOperator::Add
            | BinaryOperator::Subtract
            | BinaryOperator::Multiply
            | BinaryOperator::Divide
            | BinaryOperator::Remainder
            | BinaryOperator::Power
            | BinaryOperator::Equal
            | BinaryOperator::NotEqual
            | BinaryOperator::Less
            | BinaryOperator::LessEqual
            | BinaryOperator::Greater
            | BinaryOperator::GreaterEqual
            | BinaryOperator::In => return Ok(None),
        };
        Ok((self.truth_of(a)? == deciding).then_some(Answer::Bool(deciding)))
    }

    /// Computes an operation on two values. Kept out of the recursion, whose frames stay small.
    #[inline(never)]
    pub(crate) fn binary(
        &self,
        operator: BinaryOperator,
        a: &Answer<'a>,
        b: &Answer<'a>,
    ) -> Result<Answer<'a>> {
        use BinaryOperator as B;
        let numbers = || Ok::<_, Fault>((self.operand(a)?, self.operand(b)?));
        let made =
            |operator, x, y, dimension| finite(self.binary_number(operator, x, y), dimension);
        let holds = match operator {
            B::Add => return self.sum(a, b),
            B::Subtract => {
                let ((x, dx), (y, dy)) = numbers()?;
                return made(Binary::Subtract, x, y, measure::common(dx, dy)?);
            }
            B::Multiply => {
                let ((x, dx), (y, dy)) = numbers()?;
                return made(Binary::Multiply, x, y, dx.times(dy));
            }
            B::Divide => {
                let ((x, dx), (y, dy)) = numbers()?;
                if y == 0.0 {
                    let x = base::number::shortest(x);
                    return Err(Fault::no_answer(format!("{x} divided by zero")));
                }
                return made(Binary::Divide, x, y, dx.over(dy));
            }
            B::Remainder => {
                let ((x, dx), (y, dy)) = numbers()?;
                if y == 0.0 {
                    let x = base::number::shortest(x);
                    return Err(Fault::no_answer(format!("{x} mod zero")));
                }
                return made(Binary::Remainder, x, y, measure::common(dx, dy)?);
            }
            B::Power => {
                let ((x, dx), (y, _)) = numbers()?;
                let y = if dx == Dimension::NONE { y } else { self.fixed_number(y) };
                return made(Binary::Power, x, y, measure::power(dx, y));
            }
            // The left side did not decide, so that the right one does.
            B::And | B::Or => self.truth_of(b)?,
            B::Equal => self.equal(a, b)?,
            B::NotEqual => !self.equal(a, b)?,
            B::In => self.contains(b, a)?,
            B::Less => self.order(a, b)?.is_lt(),
            B::LessEqual => self.order(a, b)?.is_le(),
            B::Greater => self.order(a, b)?.is_gt(),
            B::GreaterEqual => self.order(a, b)?.is_ge(),
        };
        Ok(Answer::Bool(holds))
    }

    /// Adds numbers, or joins texts.
    fn sum(&self, a: &Answer<'a>, b: &Answer<'a>) -> Result<Answer<'a>> {
        if let (Answer::Text(a), Answer::Text(b)) = (a, b) {
            fits(a.len().saturating_add(b.len()))?;
            return Ok(Answer::text(&format!("{a}{b}")));
        }
        if let (Answer::Text(_), Answer::Number(..)) | (Answer::Number(..), Answer::Text(_)) =
            (a, b)
        {
            let message = "a text and a number are not joined: write `.text` after the number";
            return Err(Fault::wrong(message));
        }
        let ((x, dx), (y, dy)) = (self.operand(a)?, self.operand(b)?);
        finite(self.binary_number(Binary::Add, x, y), measure::common(dx, dy)?)
    }

    /// Returns true if two values are equal: numbers to the rule tolerance, things part by part.
    fn equal(&self, a: &Answer<'a>, b: &Answer<'a>) -> Result<bool> {
        let mut equal = true;
        self.leaves(a, b, &mut |a, b| {
            equal = equal && self.same_leaf(a, b)?;
            Ok(())
        })?;
        Ok(equal)
    }

    /// Returns true if two values without parts are equal.
    pub(crate) fn same_leaf(&self, a: &Answer<'a>, b: &Answer<'a>) -> Result<bool> {
        match (a, b) {
            (Answer::Number(x, dx), Answer::Number(y, dy)) => {
                measure::common(*dx, *dy)?;
                Ok(self.are_close(*x, *y))
            }
            (Answer::Bool(x), Answer::Bool(y)) => Ok(x == y),
            (Answer::Option(of, x), Answer::Option(other, y)) if of == other => Ok(x == y),
            (Answer::Text(x), Answer::Text(y)) => Ok(x == y),
            _ => {
                let message = format!("{} and {} are never equal", self.kind(a), self.kind(b));
                Err(Fault::wrong(message))
            }
        }
    }

    /// Compares numbers exactly, or texts by their characters.
    pub(crate) fn order(&self, a: &Answer<'a>, b: &Answer<'a>) -> Result<std::cmp::Ordering> {
        if let (Answer::Text(a), Answer::Text(b)) = (a, b) {
            return Ok(a.cmp(b));
        }
        let ((x, dx), (y, dy)) = (self.operand(a)?, self.operand(b)?);
        measure::common(dx, dy)?;
        Ok(self.order_of(x, y))
    }

    /// Makes a list. The elements of lists in it count as work: a list that stands in it twice is gone through twice.
    pub(crate) fn list(&self, items: Rc<[Answer<'a>]>) -> Result<Answer<'a>> {
        self.burn_for_lists(&items)?;
        Ok(Answer::List(items))
    }

    fn burn_for_lists(&self, items: &[Answer<'a>]) -> Result<()> {
        items.iter().try_for_each(|item| {
            let Answer::List(inner) = item else { return Ok(()) };
            self.burn_several(inner.len() as u64)?;
            self.burn_for_lists(inner)
        })
    }

    /// Returns true if a list or set has an element: a thing by identity, a value by equality.
    pub(crate) fn contains(&self, list: &Answer<'a>, wanted: &Answer<'a>) -> Result<bool> {
        self.is_among(&self.items(list)?, wanted)
    }

    /// Returns true if these have an element: a thing by identity, a value by equality.
    pub(crate) fn is_among(&self, items: &[Answer<'a>], wanted: &Answer<'a>) -> Result<bool> {
        for item in items {
            self.burn()?;
            let found = match (item, wanted) {
                (Answer::Thing(a), Answer::Thing(b)) => {
                    self.structure.merged[*a] == self.structure.merged[*b]
                }
                (Answer::Thing(_), _) | (_, Answer::Thing(_)) => false,
                _ => match self.equal(item, wanted) {
                    Err(fault) if fault.kind == FaultKind::Unequal => false,
                    outcome => outcome?,
                },
            };
            if found {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Computes an operation on one value.
    pub(crate) fn unary(
        &self,
        operator: UnaryOperator,
        operand: &Answer<'a>,
    ) -> Result<Answer<'a>> {
        match (operator, operand) {
            (UnaryOperator::Negate, Answer::Number(x, dimension)) => {
                Ok(Answer::Number(self.unary_number(Unary::Negate, *x), *dimension))
            }
            (UnaryOperator::Not, Answer::Bool(b)) => Ok(Answer::Bool(!b)),
            (UnaryOperator::Negate, other) => {
                Err(Fault::wrong(format!("{} where a number is wanted", other.kind())))
            }
            (UnaryOperator::Not, other) => {
                Err(Fault::wrong(format!("{} where a truth value is wanted", other.kind())))
            }
        }
    }
}

/// Refuses to make a text of so many letters, where they are too many.
pub(crate) fn fits(length: usize) -> Result<()> {
    match length > LONGEST_TEXT {
        true => {
            let message = format!("the text would have more than {LONGEST_TEXT} letters");
            Err(Fault::no_answer(message))
        }
        false => Ok(()),
    }
}

/// Returns a number, if it is one, or is marked as one.
pub(crate) fn finite<'a>(value: f64, dimension: Dimension) -> Result<Answer<'a>> {
    if value.is_finite() || is_marked(value) {
        Ok(Answer::Number(value, dimension))
    } else if value.is_nan() {
        Err(Fault::no_answer("a number that is not defined, as the square root of -1"))
    } else {
        Err(Fault::no_answer("a number too large to be written"))
    }
}
