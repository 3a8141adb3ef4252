//! Numbers: the same bits on every machine, and how they are compared and written.
//!
//! Every function that the hardware or the platform's library may round differently goes through
//! `libm`, compiled from one source for native and WebAssembly alike.

pub use libm::{
    acos, acosh, asin, asinh, atan, atan2, atanh, cbrt, cos, cosh, exp, hypot, log as ln, log2,
    log10, pow, sin, sinh, tan, tanh,
};

/// Returns the square root, which every machine has as an instruction and rounds alike: IEEE 754 prescribes its bits.
/// For WebAssembly `libm` would compute it digit by digit.
///
/// ```
/// assert_eq!(base::number::sqrt(2.0).to_bits(), 0x3ff6_a09e_667f_3bcd);
/// assert!(base::number::sqrt(-1.0).is_nan());
/// ```
pub fn sqrt(x: f64) -> f64 {
    x.sqrt()
}

/// How far the two sides of a rule may differ, relative to the larger side.
pub const RULE_TOLERANCE: f64 = 1e-9;

/// How far a stored number may be from the one that is meant, as a part of it: some roundings.
pub const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// What rounding may explain at most, in parts of the larger side, at least of the unit.
pub const MOST_ROUNDING: f64 = 1e-3;

/// Joins a list to one, as a sum joins its terms: a few one after the other, more in groups of a few, so that
/// the roundings of a long sum do not add up. None of nothing.
///
/// **Source:** Higham, *The accuracy of floating point summation*, SIAM J. Sci. Comput. 14 (1993).
///
/// ```
/// let tenths = vec![0.1; 100_000];
/// let one_by_one: f64 = tenths.iter().sum();
/// let in_groups = base::number::joined(tenths, |a, b| a + b).unwrap();
/// assert!((in_groups - 10_000.0).abs() < 1e-10 && (one_by_one - 10_000.0).abs() > 1e-9);
/// ```
pub fn joined<T>(mut items: Vec<T>, mut join: impl FnMut(T, T) -> T) -> Option<T> {
    const FEW: usize = 16;
    while items.len() > FEW {
        let mut rest = items.into_iter();
        let mut groups = Vec::new();
        while let Some(first) = rest.next() {
            groups.push(rest.by_ref().take(FEW - 1).fold(first, &mut join));
        }
        items = groups;
    }
    items.into_iter().reduce(join)
}

/// Returns the power of two that is nearest to a positive number, by their ratio; the number itself where that has
/// no normal one. What is multiplied by it is not rounded.
///
/// ```
/// assert_eq!([3.0, 1.4, 0.3, 1.5].map(base::number::power_of_two), [4.0, 1.0, 0.25, 2.0]);
/// ```
pub fn power_of_two(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    let power = f64::from_bits((x * std::f64::consts::SQRT_2).to_bits() & EXPONENT);
    if power > 0.0 && power.is_finite() { power } else { x }
}

/// Returns true if `a` and `b` agree to [`RULE_TOLERANCE`] of the larger side, at least of the unit.
pub fn close(a: f64, b: f64) -> bool {
    Tolerance::Relative.is_met(a, b)
}

/// How far the two sides of a rule may differ.
///
/// The *sway* of a rule is how far its sides move apart where every number that it is made of moves by its
/// own size, each to the worse: the sum of `|x| |d(left - right)/dx|`. A rule whose sides differ by
/// [`ROUNDING`] of its sway holds for numbers that nobody can tell from those that are stored; but where that is
/// more than [`MOST_ROUNDING`] of its sides, as of the sine of 1e16, they say nothing and it does not.
///
/// **Source:** Oettli and Prager, *Compatibility of approximate solution of linear equations with given
/// error bounds*, Numer. Math. 6 (1964).
///
/// ```
/// use base::number::Tolerance;
/// assert!(Tolerance::Relative.is_met(1e6, 1e6 + 1e-4));
/// assert!(!Tolerance::within(1e-6).is_met(1e6, 1e6 + 1e-4));
/// assert!(Tolerance::within(0.5).is_met(2.0, 2.25));
/// assert!(Tolerance::part(0.01).is_met(99.0, 100.0));
/// assert!(!Tolerance::part(0.01).is_met(98.9, 100.0));
/// // 1e9 + 1e-6 - 1e9 = 0, of three numbers that are stored to 1e-7
/// assert!(!Tolerance::Relative.is_met(1e-6, 0.0));
/// assert!(Tolerance::Relative.is_met_with(1e-6, 0.0, || 2e9));
/// assert!(!Tolerance::Relative.is_met_with(1e-3, 0.0, || 2e9));
/// assert!(!Tolerance::Relative.is_met_with(0.5, 0.0, || 1e16));
/// assert!(!Tolerance::Relative.is_met(f64::INFINITY, 5.0));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub enum Tolerance {
    /// [`RULE_TOLERANCE`] of the larger side, at least of the unit; or [`ROUNDING`] of the sway.
    #[default]
    Relative,
    /// As was written: so much, in base units, by the bits of the number.
    Within(u64),
    /// As was written: so large a part of the larger side, by the bits of the number.
    Part(u64),
}

impl Tolerance {
    /// Returns what `within e` asks for.
    pub fn within(e: f64) -> Self {
        Self::Within(e.abs().to_bits())
    }
    /// Returns what `within 1%` asks for.
    pub fn part(e: f64) -> Self {
        Self::Part(e.abs().to_bits())
    }
    /// Returns the difference that two sides may have. The written measure itself is met up to rounding.
    pub fn allowed(self, left: f64, right: f64) -> f64 {
        match self {
            Self::Relative => RULE_TOLERANCE * size(left, right),
            Self::Within(bits) => f64::from_bits(bits) * (1.0 + RULE_TOLERANCE),
            Self::Part(bits) => {
                f64::from_bits(bits) * (1.0 + RULE_TOLERANCE) * left.abs().max(right.abs())
            }
        }
    }
    /// Returns the difference that two sides of a rule with this sway may have.
    pub fn allowed_with(self, left: f64, right: f64, sway: f64) -> f64 {
        let allowed = self.allowed(left, right);
        match self {
            Self::Relative if sway.is_finite() => {
                allowed.max((ROUNDING * sway).min(MOST_ROUNDING * size(left, right)))
            }
            Self::Relative | Self::Within(_) | Self::Part(_) => allowed,
        }
    }
    /// Returns true if two sides agree, or differ by no more than rounding; the sway is asked for only
    /// where that decides.
    pub fn is_met_with(self, left: f64, right: f64, sway: impl FnOnce() -> f64) -> bool {
        let off = (left - right).abs();
        self.is_met(left, right)
            || self == Self::Relative
                && off <= MOST_ROUNDING * size(left, right)
                && off <= self.allowed_with(left, right, sway())
    }
    /// Returns true if two sides agree whatever they are made of. A side without a value agrees with none.
    pub fn is_met(self, left: f64, right: f64) -> bool {
        left == right && left.is_finite() || (left - right).abs() <= self.allowed(left, right)
    }
}

/// Returns the size of the larger side, at least the unit; zero where one has no value.
fn size(left: f64, right: f64) -> f64 {
    let size = left.abs().max(right.abs()).max(1.0);
    if size.is_finite() { size } else { 0.0 }
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

/// Returns `x` rounded to so many significant digits, one at least, as its [`shortest`] decimal.
///
/// ```
/// assert_eq!(base::number::significant(163.857384, 6), "163.857");
/// assert_eq!(base::number::significant(-0.00022857142857, 3), "-0.000229");
/// assert_eq!(base::number::significant(1500.0, 6), "1500");
/// ```
pub fn significant(x: f64, digits: usize) -> String {
    if !x.is_finite() {
        return shortest(x);
    }
    shortest(format!("{x:.*e}", digits.max(1) - 1).parse().unwrap_or(x))
}

/// Which way a number goes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Toward {
    /// It shrinks.
    Less,
    /// It grows.
    More,
}

/// Returns `x` rounded to `digits` decimals, trailing zeros dropped.
///
/// ```
/// assert_eq!(base::number::rounded(1.41421, 3), "1.414");
/// assert_eq!(base::number::rounded(9.0, 3), "9");
/// ```
pub fn rounded(x: f64, digits: usize) -> String {
    let text = decimals(x, digits);
    if !text.contains('.') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').into()
}

/// Writes a number with so many decimals, zeros too.
///
/// ```
/// assert_eq!(base::number::decimals(24.0, 2), "24.00");
/// assert_eq!(base::number::decimals(-0.001, 2), "0.00");
/// ```
pub fn decimals(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    let is_nothing = text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.'));
    if is_nothing { text.trim_start_matches('-').into() } else { text }
}
