//! Dimensions: what a number measures, as exponents of the SI base quantities.

/// Exponents of length, mass, time, current, temperature, amount, luminous intensity.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Dimension(pub [i8; 7]);

impl Dimension {
    /// A plain number.
    pub const NONE: Self = Self([0; 7]);
    /// A length.
    pub const LENGTH: Self = Self([1, 0, 0, 0, 0, 0, 0]);
}
