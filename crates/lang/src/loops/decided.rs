//! Conditions that are decided as the text stands: `i = 0`, `fit = close`, where `for` binds these names.

use kernel::{BinaryOperator, Term, UnaryOperator};

/// Returns the truth value that a term has whatever the values are.
pub(crate) fn decided(term: &Term) -> Option<bool> {
    match term {
        Term::Bool(holds) => Some(*holds),
        Term::Unary(UnaryOperator::Not, operand) => decided(operand).map(|holds| !holds),
        Term::Binary(BinaryOperator::And, a, b) => match (decided(a), decided(b)) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (a, b) => Some(a? && b?),
        },
        Term::Binary(BinaryOperator::Or, a, b) => match (decided(a), decided(b)) {
            (Some(true), _) | (_, Some(true)) => Some(true),
            (a, b) => Some(a? || b?),
        },
        Term::Binary(BinaryOperator::Equal, a, b) => are_equal(a, b),
        Term::Binary(BinaryOperator::NotEqual, a, b) => are_equal(a, b).map(|equal| !equal),
        Term::Binary(operator, a, b) => {
            let (a, b) = (whole(a)?, whole(b)?);
            match operator {
                BinaryOperator::Less => Some(a < b),
                BinaryOperator::LessEqual => Some(a <= b),
                BinaryOperator::Greater => Some(a > b),
                BinaryOperator::GreaterEqual => Some(a >= b),
                _ => None,
            }
        }
        _ => None,
    }
}

fn are_equal(a: &Term, b: &Term) -> Option<bool> {
    match (a, b) {
        (Term::Text(a), Term::Text(b)) => Some(a == b),
        (Term::Option(of, a), Term::Option(other, b)) if of == other => Some(a == b),
        _ => match (decided(a), decided(b)) {
            (Some(a), Some(b)) => Some(a == b),
            _ => Some(whole(a)? == whole(b)?),
        },
    }
}

/// Returns the whole number that a term is; of others a tolerance says which are equal.
fn whole(term: &Term) -> Option<f64> {
    number(term).filter(|x| x.fract() == 0.0)
}

fn number(term: &Term) -> Option<f64> {
    let x = match term {
        Term::Number { value, .. } => *value,
        Term::Unary(UnaryOperator::Negate, operand) => -number(operand)?,
        Term::Binary(operator, a, b) => {
            let (a, b) = (number(a)?, number(b)?);
            match operator {
                BinaryOperator::Add => a + b,
                BinaryOperator::Subtract => a - b,
                BinaryOperator::Multiply => a * b,
                BinaryOperator::Divide => a / b,
                BinaryOperator::Remainder => expr::Binary::Remainder.apply(a, b),
                _ => return None,
            }
        }
        _ => return None,
    };
    x.is_finite().then_some(x)
}
