//! What elimination works with: doubles, or the numbers of a finite field.

use crate::residue::Residue;

/// What coefficients are: doubles, of which what cancels leaves a rounding, or residues, of which it leaves
/// nothing.
pub trait Number: Copy {
    /// The number that changes nothing it is added to.
    const ZERO: Self;
    /// The number that changes nothing it is multiplied with.
    const ONE: Self;
    /// Returns how large it is beside others; nothing of zero alone.
    fn size(self) -> f64;
    /// Returns the sum.
    fn plus(self, other: Self) -> Self;
    /// Returns the product.
    fn times(self, other: Self) -> Self;
    /// Returns it with the other sign.
    fn negated(self) -> Self;
    /// What many are divided by.
    type Divisor: Copy;
    /// Returns what divides by it; it is not zero.
    fn divisor(self) -> Self::Divisor;
    /// Returns the quotient.
    fn divided(self, by: Self::Divisor) -> Self;
    /// Returns the quotient; the other is not zero.
    fn over(self, other: Self) -> Self {
        self.divided(other.divisor())
    }
    /// Divides every one by the same, which is not zero.
    fn divide(row: &mut [(u32, Self)], by: Self) {
        let by = by.divisor();
        row.iter_mut().for_each(|e| e.1 = e.1.divided(by));
    }
    /// Returns it scaled down where sizes tell anything.
    fn scaled_down(self, by: f64) -> Self;
}

impl Number for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    fn size(self) -> f64 {
        self.abs()
    }
    fn plus(self, other: Self) -> Self {
        self + other
    }
    fn times(self, other: Self) -> Self {
        self * other
    }
    fn negated(self) -> Self {
        -self
    }
    type Divisor = Self;
    fn divisor(self) -> Self {
        self
    }
    fn divided(self, by: Self) -> Self {
        self / by
    }
    fn scaled_down(self, by: f64) -> Self {
        self / by
    }
}

impl Number for Residue {
    const ZERO: Self = Residue::ZERO;
    const ONE: Self = Residue::ONE;
    fn size(self) -> f64 {
        if self.is_zero() { 0.0 } else { 1.0 }
    }
    fn plus(self, other: Self) -> Self {
        self.plus(other)
    }
    fn times(self, other: Self) -> Self {
        self.times(other)
    }
    fn negated(self) -> Self {
        self.negated()
    }
    type Divisor = Self;
    fn divisor(self) -> Self {
        Residue::ONE.over(self).expect("nothing is divided by zero")
    }
    fn divided(self, by: Self) -> Self {
        self.times(by)
    }
    fn scaled_down(self, _: f64) -> Self {
        self
    }
}

/// A sum, and how large the largest of its terms is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sum<N> {
    pub(crate) value: N,
    pub(crate) size: f64,
}

impl<N: Number> Default for Sum<N> {
    fn default() -> Self {
        Self { value: N::ZERO, size: 0.0 }
    }
}

impl<N: Number> Sum<N> {
    /// Begins with one term.
    pub(crate) fn of(term: N) -> Self {
        Self { value: term, size: term.size() }
    }
    /// Adds a term.
    pub(crate) fn add(&mut self, term: N) {
        self.value = self.value.plus(term);
        self.size = self.size.max(term.size());
    }
    /// Returns true if its terms cancel to this part of the largest.
    pub(crate) fn cancels_to(&self, part: f64) -> bool {
        self.value.size() <= part * self.size
    }
}
