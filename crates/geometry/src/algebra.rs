//! The numbers that closed forms are written in.

/// Arithmetic: on numbers, or on expressions that stand for them.
pub trait Algebra {
    /// A number.
    type N: Copy;
    /// Makes a constant.
    fn constant(&mut self, x: f64) -> Self::N;
    /// Returns `a + b`.
    fn add(&mut self, a: Self::N, b: Self::N) -> Self::N;
    /// Returns `a - b`.
    fn sub(&mut self, a: Self::N, b: Self::N) -> Self::N;
    /// Returns `a b`.
    fn mul(&mut self, a: Self::N, b: Self::N) -> Self::N;
    /// Returns `a / b`.
    fn div(&mut self, a: Self::N, b: Self::N) -> Self::N;
    /// Returns `-a`.
    fn neg(&mut self, a: Self::N) -> Self::N;
    /// Returns the square root; of what is less than 0 whatever the algebra likes, since a margin says so.
    fn sqrt(&mut self, a: Self::N) -> Self::N;
    /// Returns 1, -1, or 0 of 0.
    fn sign(&mut self, a: Self::N) -> Self::N;
    /// Returns the sine of an angle in radians.
    fn sin(&mut self, a: Self::N) -> Self::N;
    /// Returns the cosine of an angle in radians.
    fn cos(&mut self, a: Self::N) -> Self::N;
    /// Returns `a` where `condition` is 0 at least, else `b`.
    fn choose(&mut self, condition: Self::N, a: Self::N, b: Self::N) -> Self::N;
}

/// Numbers, as they are.
///
/// ```
/// use geometry::{Algebra, Plain};
/// assert_eq!(Plain.sqrt(9.0), 3.0);
/// assert_eq!(Plain.choose(-1.0, 2.0, 3.0), 3.0);
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Plain;

impl Algebra for Plain {
    type N = f64;
    fn constant(&mut self, x: f64) -> f64 {
        x
    }
    fn add(&mut self, a: f64, b: f64) -> f64 {
        a + b
    }
    fn sub(&mut self, a: f64, b: f64) -> f64 {
        a - b
    }
    fn mul(&mut self, a: f64, b: f64) -> f64 {
        a * b
    }
    fn div(&mut self, a: f64, b: f64) -> f64 {
        a / b
    }
    fn neg(&mut self, a: f64) -> f64 {
        -a
    }
    fn sqrt(&mut self, a: f64) -> f64 {
        base::number::sqrt(if a < 0.0 { 0.0 } else { a })
    }
    fn sign(&mut self, a: f64) -> f64 {
        f64::from(u8::from(a > 0.0)) - f64::from(u8::from(a < 0.0))
    }
    fn sin(&mut self, a: f64) -> f64 {
        base::number::sin(a)
    }
    fn cos(&mut self, a: f64) -> f64 {
        base::number::cos(a)
    }
    fn choose(&mut self, condition: f64, a: f64, b: f64) -> f64 {
        if condition >= 0.0 { a } else { b }
    }
}
