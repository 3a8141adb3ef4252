//! Operations on numbers: the fixed list, and what each computes, bit for bit, on every machine.
//!
//! Whoever computes an expression (folding, evaluation, the tape) computes it through [`Unary::apply`]
//! and [`Binary::apply`]. A truth value is 1 or 0; every number but 0 counts as true.

use base::number;

/// An operation with one operand.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Unary {
    /// `-a`
    Neg,
    /// `|a|`
    Abs,
    /// The square root; NaN below 0.
    Sqrt,
    /// The sine of an angle in radians.
    Sin,
    /// The cosine of an angle in radians.
    Cos,
    /// The tangent of an angle in radians.
    Tan,
    /// The angle from -π/2 to π/2 with this sine.
    Asin,
    /// The angle from 0 to π with this cosine.
    Acos,
    /// The angle from -π/2 to π/2 with this tangent.
    Atan,
    /// e to the power a.
    Exp,
    /// The natural logarithm.
    Ln,
    /// The logarithm to the base 10.
    Log10,
    /// The logarithm to the base 2.
    Log2,
    /// The hyperbolic sine.
    Sinh,
    /// The hyperbolic cosine.
    Cosh,
    /// The hyperbolic tangent.
    Tanh,
    /// The number with this hyperbolic sine.
    Asinh,
    /// The number, 0 or more, with this hyperbolic cosine.
    Acosh,
    /// The number with this hyperbolic tangent.
    Atanh,
    /// The cube root, of negative numbers too.
    Cbrt,
    /// The greatest whole number not above a.
    Floor,
    /// The nearest whole number; halves go away from 0.
    Round,
    /// -1, 0 or 1.
    Sign,
    /// 1 if a is 0, else 0.
    Not,
}

/// An operation with two operands.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Binary {
    /// `a + b`
    Add,
    /// `a - b`
    Sub,
    /// `a * b`
    Mul,
    /// `a / b`
    Div,
    /// `a ^ b`; the exponents -1, 0, 1/2, 1, 2 and 3 mean reciprocal, 1, root and products.
    Pow,
    /// The angle of the vector (b, a), from -π to π.
    Atan2,
    /// The smaller; NaN if either is.
    Min,
    /// The larger; NaN if either is.
    Max,
    /// `a - b * floor(a / b)`: what is left of a, with the sign of b.
    Remainder,
    /// 1 if a < b, else 0.
    Less,
    /// 1 if a ≤ b, else 0.
    LessEqual,
    /// 1 if a = b, else 0.
    Equal,
    /// 0 if a = b, else 1.
    NotEqual,
    /// 1 if neither is 0, else 0.
    And,
    /// 0 if both are 0, else 1.
    Or,
}

/// Returns 1 for true and 0 for false.
pub(crate) fn number_from_truth(truth: bool) -> f64 {
    f64::from(u8::from(truth))
}

impl Unary {
    /// Every operation with one operand, in the order of [`Unary`].
    pub const ALL: [Self; 24] = [
        Self::Neg,
        Self::Abs,
        Self::Sqrt,
        Self::Sin,
        Self::Cos,
        Self::Tan,
        Self::Asin,
        Self::Acos,
        Self::Atan,
        Self::Exp,
        Self::Ln,
        Self::Log10,
        Self::Log2,
        Self::Sinh,
        Self::Cosh,
        Self::Tanh,
        Self::Asinh,
        Self::Acosh,
        Self::Atanh,
        Self::Cbrt,
        Self::Floor,
        Self::Round,
        Self::Sign,
        Self::Not,
    ];

    /// Computes the operation.
    #[inline(always)]
    pub fn apply(self, a: f64) -> f64 {
        match self {
            Self::Neg => -a,
            Self::Abs => a.abs(),
            Self::Sqrt => a.sqrt(), // correctly rounded everywhere, by IEEE 754
            Self::Sin => number::sin(a),
            Self::Cos => number::cos(a),
            Self::Tan => number::tan(a),
            Self::Asin => number::asin(a),
            Self::Acos => number::acos(a),
            Self::Atan => number::atan(a),
            Self::Exp => number::exp(a),
            Self::Ln => number::ln(a),
            Self::Log10 => number::log10(a),
            Self::Log2 => number::log2(a),
            Self::Sinh => number::sinh(a),
            Self::Cosh => number::cosh(a),
            Self::Tanh => number::tanh(a),
            Self::Asinh => number::asinh(a),
            Self::Acosh => number::acosh(a),
            Self::Atanh => number::atanh(a),
            Self::Cbrt => number::cbrt(a),
            Self::Floor => a.floor(),
            Self::Round => a.round(),
            Self::Sign => {
                if a > 0.0 {
                    1.0
                } else if a < 0.0 {
                    -1.0
                } else {
                    a
                }
            }
            Self::Not => number_from_truth(a == 0.0),
        }
    }
    /// Returns the name by which the operation is shown.
    pub fn name(self) -> &'static str {
        match self {
            Self::Neg => "-",
            Self::Abs => "abs",
            Self::Sqrt => "sqrt",
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Tan => "tan",
            Self::Asin => "asin",
            Self::Acos => "acos",
            Self::Atan => "atan",
            Self::Exp => "exp",
            Self::Ln => "ln",
            Self::Log10 => "log10",
            Self::Log2 => "log2",
            Self::Sinh => "sinh",
            Self::Cosh => "cosh",
            Self::Tanh => "tanh",
            Self::Asinh => "asinh",
            Self::Acosh => "acosh",
            Self::Atanh => "atanh",
            Self::Cbrt => "cbrt",
            Self::Floor => "floor",
            Self::Round => "round",
            Self::Sign => "sign",
            Self::Not => "not",
        }
    }
}

impl Binary {
    /// Returns true if it says how two numbers compare.
    pub fn is_comparison(self) -> bool {
        matches!(self, Self::Less | Self::LessEqual | Self::Equal | Self::NotEqual)
    }
    /// Returns true if it is always 0 or 1.
    pub fn is_truth(self) -> bool {
        self.is_comparison() || matches!(self, Self::And | Self::Or)
    }
    /// Every operation with two operands, in the order of [`Binary`].
    pub const ALL: [Self; 15] = [
        Self::Add,
        Self::Sub,
        Self::Mul,
        Self::Div,
        Self::Pow,
        Self::Atan2,
        Self::Min,
        Self::Max,
        Self::Remainder,
        Self::Less,
        Self::LessEqual,
        Self::Equal,
        Self::NotEqual,
        Self::And,
        Self::Or,
    ];

    /// Computes the operation.
    #[inline(always)]
    pub fn apply(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Add => a + b,
            Self::Sub => a - b,
            Self::Mul => a * b,
            Self::Div => a / b,
            Self::Pow => power(a, b),
            Self::Atan2 => number::atan2(a, b),
            Self::Min => {
                if b < a || b.is_nan() {
                    b
                } else {
                    a
                }
            }
            Self::Max => {
                if b > a || b.is_nan() {
                    b
                } else {
                    a
                }
            }
            Self::Remainder => {
                let rest = a % b; // exact, by IEEE 754
                if rest != 0.0 && (rest < 0.0) != (b < 0.0) { rest + b } else { rest }
            }
            Self::Less => number_from_truth(a < b),
            Self::LessEqual => number_from_truth(a <= b),
            Self::Equal => number_from_truth(a == b),
            Self::NotEqual => number_from_truth(a != b),
            Self::And => number_from_truth(a != 0.0 && b != 0.0),
            Self::Or => number_from_truth(a != 0.0 || b != 0.0),
        }
    }
    /// Returns the name by which the operation is shown.
    pub fn name(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Sub => "-",
            Self::Mul => "*",
            Self::Div => "/",
            Self::Pow => "^",
            Self::Atan2 => "atan2",
            Self::Min => "min",
            Self::Max => "max",
            Self::Remainder => "mod",
            Self::Less => "<",
            Self::LessEqual => "<=",
            Self::Equal => "=",
            Self::NotEqual => "!=",
            Self::And => "and",
            Self::Or => "or",
        }
    }
    /// Returns true if the operation is written between its operands.
    pub fn is_infix(self) -> bool {
        !matches!(self, Self::Atan2 | Self::Min | Self::Max)
    }
}

/// Returns `a ^ b`; the small exponents agree with what [`crate::Arena::pow`] builds for them.
fn power(a: f64, b: f64) -> f64 {
    if b == 2.0 {
        a * a
    } else if b == 3.0 {
        a * (a * a)
    } else if b == 1.0 {
        a
    } else if b == 0.0 {
        1.0
    } else if b == 0.5 {
        a.sqrt()
    } else if b == -1.0 {
        1.0 / a
    } else {
        number::pow(a, b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_remainder_has_the_sign_of_the_divisor() {
        let cases = [(7.0, 3.0, 1.0), (-7.0, 3.0, 2.0), (7.0, -3.0, -2.0), (-7.0, -3.0, -1.0)];
        for (a, b, rest) in cases {
            assert_eq!(Binary::Remainder.apply(a, b), rest);
        }
        assert!(Binary::Remainder.apply(1.0, 0.0).is_nan());
    }
    #[test]
    fn nan_is_never_lost_by_a_choice() {
        for op in [Binary::Min, Binary::Max] {
            assert!(op.apply(f64::NAN, 1.0).is_nan());
            assert!(op.apply(1.0, f64::NAN).is_nan());
        }
        assert!(Unary::Sign.apply(f64::NAN).is_nan());
    }
    #[test]
    fn powers_of_negative_numbers() {
        assert_eq!(Binary::Pow.apply(-2.0, 3.0), -8.0);
        assert_eq!(Binary::Pow.apply(-2.0, 4.0), 16.0);
        assert_eq!(Binary::Pow.apply(0.0, 0.0), 1.0);
        assert!(Binary::Pow.apply(-2.0, 0.5).is_nan());
    }
}
