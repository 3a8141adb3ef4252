//! Dimensions at evaluation: what sums and powers measure.
//!
//! `lang` checks dimensions strictly when a class is compiled. Here only what cannot be meant is a
//! fault: a volt and an ampere in one sum. A number without a dimension goes with any other, as a
//! bare number takes the dimension that its context wants.

use crate::fault::{Fault, FaultKind};
use expr::dimension::Dimension;

/// Returns the dimension of a sum, a difference, or of numbers that are compared.
pub(crate) fn common(a: Dimension, b: Dimension) -> Result<Dimension, Fault> {
    if a == b || b == Dimension::NONE {
        Ok(a)
    } else if a == Dimension::NONE {
        Ok(b)
    } else {
        let message = format!("{} and {} do not go together", named(a), named(b));
        Err(Fault::new(FaultKind::WrongDimension, message))
    }
}

/// Returns the dimension of a power; none where an exponent would not be whole.
pub(crate) fn power(a: Dimension, exponent: f64) -> Dimension {
    let exponents = a.0.map(|e| f64::from(e) * exponent);
    if exponents.iter().all(|e| e.fract() == 0.0 && e.abs() <= 127.0) {
        Dimension(exponents.map(|e| e as i8))
    } else {
        Dimension::NONE
    }
}

/// Says what a dimension is: by its name, or in base units.
fn named(dimension: Dimension) -> String {
    dimension.named().map_or_else(|| dimension.to_string(), str::to_string)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FORCE: Dimension = Dimension::FORCE;

    #[test]
    fn unlike_numbers_do_not_go_together() {
        let fault = common(Dimension::CURRENT, FORCE).unwrap_err();
        assert_eq!(fault.message, "Current and Force do not go together");
        assert_eq!(common(Dimension::NONE, FORCE), Ok(FORCE));
    }
    #[test]
    fn roots_undo_squares() {
        assert_eq!(power(power(FORCE, 2.0), 0.5), FORCE);
        assert_eq!(power(FORCE, 0.5), Dimension::NONE);
    }
}
