//! Operators on meanings, and the choice between two.

use crate::evaluate::{Answer, Opening, kind};
use crate::fault::Trouble;
use crate::meaning::{Made, Meaning};
use base::number::joined;
use expr::{Binary, Unary};
use kernel::BinaryOperator;
use std::rc::Rc;

impl<'a> Opening<'a> {
    /// Applies an operation to a number.
    pub(crate) fn unary(&mut self, operator: Unary, operand: &Meaning<'a>) -> Answer<'a> {
        match operand {
            Meaning::Number(id) => Ok(Meaning::Number(self.arena.unary(operator, *id))),
            Meaning::Opaque(_) => Ok(self.opaque([operand])),
            other => Err(Trouble::wrong(format!("{} is not a number", kind(other)))),
        }
    }

    /// Applies an operator: numbers to expressions, things part by part, the rest to the host.
    pub(crate) fn binary(
        &mut self,
        operator: BinaryOperator,
        a: &Meaning<'a>,
        b: &Meaning<'a>,
    ) -> Answer<'a> {
        if let (Meaning::Number(a), Meaning::Number(b)) = (a, b) {
            let (a, b) = (*a, *b);
            if operator == BinaryOperator::Remainder {
                // by a step, whose pieces the solver knows
                let quotient = self.arena.div(a, b);
                let whole = self.arena.unary(Unary::Floor, quotient);
                let whole = self.arena.mul(b, whole);
                return Ok(Meaning::Number(self.arena.sub(a, whole)));
            }
            let (operator, a, b) = match operator {
                BinaryOperator::Add => (Binary::Add, a, b),
                BinaryOperator::Subtract => (Binary::Sub, a, b),
                BinaryOperator::Multiply => (Binary::Mul, a, b),
                BinaryOperator::Divide => (Binary::Div, a, b),
                BinaryOperator::Power => (Binary::Pow, a, b),
                BinaryOperator::Equal => (Binary::Equal, a, b),
                BinaryOperator::NotEqual => (Binary::NotEqual, a, b),
                BinaryOperator::Less => (Binary::Less, a, b),
                BinaryOperator::LessEqual => (Binary::LessEqual, a, b),
                BinaryOperator::Greater => (Binary::Less, b, a),
                BinaryOperator::GreaterEqual => (Binary::LessEqual, b, a),
                BinaryOperator::And => (Binary::And, a, b),
                BinaryOperator::Or => (Binary::Or, a, b),
                BinaryOperator::In | BinaryOperator::Remainder => {
                    return Err(Trouble::wrong("a number has no members"));
                }
            };
            return Ok(Meaning::Number(self.arena.binary(operator, a, b)));
        }
        match operator {
            BinaryOperator::Equal => self.equal(a, b),
            BinaryOperator::NotEqual => {
                let equal = self.equal(a, b)?;
                self.unary(Unary::Not, &equal)
            }
            BinaryOperator::In => self.is_in(a, b),
            BinaryOperator::Add
            | BinaryOperator::Subtract
            | BinaryOperator::Multiply
            | BinaryOperator::Divide
            | BinaryOperator::Remainder
            | BinaryOperator::Power
            | BinaryOperator::Less
            | BinaryOperator::LessEqual
            | BinaryOperator::Greater
            | BinaryOperator::GreaterEqual
            | BinaryOperator::And
            | BinaryOperator::Or => match (a, b) {
                (Meaning::Opaque(_) | Meaning::Number(_), Meaning::Opaque(_))
                | (Meaning::Opaque(_), Meaning::Number(_)) => Ok(self.opaque([a, b])),
                _ => {
                    Err(Trouble::wrong(format!("{} and {}: numbers are wanted", kind(a), kind(b))))
                }
            },
        }
    }

    /// Says by an expression whether two meanings are equal, part by part.
    fn equal(&mut self, a: &Meaning<'a>, b: &Meaning<'a>) -> Answer<'a> {
        let mut truth = self.number(1.0);
        for (a, b) in self.leaves(a, b)? {
            let one = match (&a, &b) {
                (Meaning::Number(a), Meaning::Number(b)) => {
                    Meaning::Number(self.arena.binary(Binary::Equal, *a, *b))
                }
                _ => self.opaque([&a, &b]),
            };
            truth = self.binary(BinaryOperator::And, &truth, &one)?;
        }
        Ok(truth)
    }

    fn is_in(&mut self, a: &Meaning<'a>, b: &Meaning<'a>) -> Answer<'a> {
        if let Meaning::Opaque(_) = b {
            return Ok(self.opaque([a, b]));
        }
        let mut each = vec![Ok(self.number(0.0))];
        for item in self.items(b)?.iter() {
            each.push(Ok(match (a, item) {
                (Meaning::Thing(a), Meaning::Thing(b)) => {
                    let same = self.reach.is_same(*a, *b);
                    self.number(f64::from(u8::from(same)))
                }
                _ => self.equal(a, item)?,
            }));
        }
        // in groups: of many it is not as high as they are many
        let either = |a: Answer<'a>, b: Answer<'a>| self.binary(BinaryOperator::Or, &a?, &b?);
        joined(each, either).unwrap_or_else(|| Ok(self.number(0.0)))
    }

    /// Takes one of two meanings by a condition that depends on values, part by part.
    pub(crate) fn select(
        &mut self,
        condition: &Meaning<'a>,
        then: &Meaning<'a>,
        otherwise: &Meaning<'a>,
    ) -> Answer<'a> {
        match (condition, then, otherwise) {
            (Meaning::Number(c), Meaning::Number(a), Meaning::Number(b)) => {
                Ok(Meaning::Number(self.arena.select(*c, *a, *b)))
            }
            (_, Meaning::Thing(_) | Meaning::Made(_), Meaning::Thing(_) | Meaning::Made(_)) => {
                let class = self.common_ancestor(then, otherwise)?;
                let mut fields = Vec::new();
                for name in self.field_names(class) {
                    let a = self.send(then, &name, &[], None)?;
                    let b = self.send(otherwise, &name, &[], None)?;
                    fields.push((name, self.select(condition, &a, &b)?));
                }
                Ok(Meaning::Made(Rc::new(Made { class, fields })))
            }
            (_, Meaning::List(a), Meaning::List(b)) if a.len() == b.len() => {
                let pairs = a.iter().zip(b.iter());
                let items: Result<Vec<_>, _> =
                    pairs.map(|(a, b)| self.select(condition, a, b)).collect();
                Ok(Meaning::List(items?.into()))
            }
            _ => Ok(self.opaque([condition, then, otherwise])),
        }
    }
}
