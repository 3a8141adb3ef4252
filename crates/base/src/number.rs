//! Numbers: the same bits on every machine, and how they are compared and written.
//!
//! Every function that the hardware or the platform's library may round differently goes through
//! `libm`, compiled from one source for native and WebAssembly alike.

pub use libm::{acos, asin, atan, atan2, cos, exp, hypot, log as ln, pow, sin, sqrt, tan};

/// How far the two sides of a rule may differ, relative to the larger side.
pub const RULE_TOLERANCE: f64 = 1e-9;

/// Returns true if `a` and `b` agree to [`RULE_TOLERANCE`] of the larger side, at least of the unit.
pub fn close(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= RULE_TOLERANCE * a.abs().max(b.abs()).max(1.0)
}

/// How far the two sides of a rule may differ.
///
/// ```
/// use base::number::Tolerance;
/// assert!(Tolerance::Relative.is_met(1e6, 1e6 + 1e-4));
/// assert!(!Tolerance::within(1e-6).is_met(1e6, 1e6 + 1e-4));
/// assert!(Tolerance::within(0.5).is_met(2.0, 2.25));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub enum Tolerance {
    /// [`RULE_TOLERANCE`] of the larger side, at least of the unit.
    #[default]
    Relative,
    /// As was written: so much, in base units, by the bits of the number.
    Within(u64),
}

impl Tolerance {
    /// Returns what `within e` asks for.
    pub fn within(e: f64) -> Self {
        Self::Within(e.abs().to_bits())
    }
    /// Returns the difference that two sides may have. The written measure itself is met up to rounding.
    pub fn allowed(self, left: f64, right: f64) -> f64 {
        match self {
            Self::Relative => RULE_TOLERANCE * left.abs().max(right.abs()).max(1.0),
            Self::Within(bits) => f64::from_bits(bits) * (1.0 + RULE_TOLERANCE),
        }
    }
    /// Returns true if two sides agree.
    pub fn is_met(self, left: f64, right: f64) -> bool {
        left == right || (left - right).abs() <= self.allowed(left, right)
    }
}

/// Returns the shortest decimal that reads back as `x`, without `.0`; exponents where they are shorter.
///
/// Infinities and NaN, which no document stores, are written `inf`, `-inf` and `nan`.
///
/// ```
/// assert_eq!(base::number::shortest(1.50), "1.5");
/// assert_eq!(base::number::shortest(-3.0), "-3");
/// assert_eq!(base::number::shortest(1e-12), "1e-12");
/// ```
pub fn shortest(x: f64) -> String {
    if x.is_nan() {
        return "nan".into();
    }
    if x == 0.0 {
        return "0".into();
    }
    let magnitude = x.abs();
    if (1e-6..1e17).contains(&magnitude) || x.is_infinite() {
        format!("{x}")
    } else {
        format!("{x:e}")
    }
}

/// Returns `x` rounded to `digits` decimals, trailing zeros dropped.
///
/// ```
/// assert_eq!(base::number::rounded(1.41421, 3), "1.414");
/// assert_eq!(base::number::rounded(9.0, 3), "9");
/// ```
pub fn rounded(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text.as_str()
    };
    if text == "-0" { "0".into() } else { text.into() }
}
