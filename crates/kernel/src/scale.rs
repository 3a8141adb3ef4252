//! The scale of a document: how large its base units are, so that its numbers are of everyday size.

use expr::dimension::Dimension;

/// For every base quantity of SI, in which power of two of its unit the document counts: a length of `x` metres is
/// stored as `x * 2^scale`.
///
/// Powers of two change no digit of a number and of nothing that is computed from it, as long as dimensions are
/// right. Tolerances that are a part of the unit are then a part of what the document speaks of.
///
/// ```
/// use expr::Dimension;
/// let scale = kernel::Scale([20, 0, 10, 0, 0, 0, 0]);
/// assert_eq!(scale.factor(Dimension::LENGTH), 1048576.0);
/// assert_eq!(scale.factor(Dimension::VELOCITY), 1024.0);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Scale(pub [i16; 7]);

impl Scale {
    /// Returns how many stored units a unit of SI has.
    pub fn factor(self, dimension: Dimension) -> f64 {
        let exponent = self.0.iter().zip(dimension.0).map(|(&s, d)| i32::from(s) * i32::from(d));
        match exponent.sum::<i32>() {
            0 => 1.0,
            exponent => base::number::pow(2.0, f64::from(exponent)),
        }
    }
}
