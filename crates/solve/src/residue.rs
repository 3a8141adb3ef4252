//! Residues: numbers of a finite field, in which what is zero is known.
//!
//! Whether rows depend on each other is the same at almost every point of almost every field. Doubles
//! cannot tell it of a long chain: what each link leaves is a little less than before, until it is lost
//! in rounding. In the field of the numbers `a + b i` modulo the prime 2⁶¹ - 1 nothing is rounded, and
//! every number without `i` has a square root. A sum that is zero at a point drawn at random, and not
//! everywhere, is met once in 10¹⁸ / its degree.
//!
//! **Source:** Schwartz, *Fast probabilistic algorithms for verification of polynomial identities*,
//! J. ACM 27 (1980).

/// The prime; -1 is no square modulo it.
const P: u64 = (1 << 61) - 1;

/// The largest denominator of a constant that is taken for a fraction: any two such that are no larger
/// differ by more than doubles are rounded.
const DENOMINATOR: f64 = 1e7;

/// A number of the field.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Residue {
    real: u64,
    imaginary: u64,
}

impl Residue {
    pub(crate) const ZERO: Self = Self { real: 0, imaginary: 0 };
    pub(crate) const ONE: Self = Self { real: 1, imaginary: 0 };

    fn of(real: u64) -> Self {
        Self { real, imaginary: 0 }
    }

    /// Draws a number without `i` that depends on `seed` alone.
    pub(crate) fn drawn(seed: u64) -> Self {
        Self::of(reduced(u128::from(base::scrambled(seed))))
    }

    /// Returns the number that a double stands for: a whole number or the fraction that rounds to it. None
    /// for one that stands for neither, as π does.
    pub(crate) fn standing_for(x: f64) -> Option<Self> {
        let size = x.abs();
        let (mut rest, mut before, mut now) = (size, (0.0, 1.0), (1.0, 0.0));
        let (top, bottom) = loop {
            let whole = rest.floor();
            let next = (whole * now.0 + before.0, whole * now.1 + before.1);
            let is_told = next.0 < 9e15 && next.1 <= DENOMINATOR;
            if !is_told {
                return None;
            }
            if next.0 / next.1 == size {
                break next;
            }
            (before, now) = (now, next);
            rest = 1.0 / (rest - whole);
        };
        let made = Self::of(reduced(top as u128)).over(Self::of(bottom as u64))?;
        Some(if x < 0.0 { made.negated() } else { made })
    }

    pub(crate) fn is_zero(self) -> bool {
        self == Self::ZERO
    }
    pub(crate) fn plus(self, other: Self) -> Self {
        Self { real: add(self.real, other.real), imaginary: add(self.imaginary, other.imaginary) }
    }
    pub(crate) fn negated(self) -> Self {
        Self { real: negative(self.real), imaginary: negative(self.imaginary) }
    }
    pub(crate) fn times(self, other: Self) -> Self {
        if self.imaginary == 0 && other.imaginary == 0 {
            return Self::of(multiply(self.real, other.real));
        }
        let (real, turned) =
            (multiply(self.real, other.real), multiply(self.imaginary, other.imaginary));
        Self {
            real: add(real, negative(turned)),
            imaginary: add(
                multiply(self.real, other.imaginary),
                multiply(self.imaginary, other.real),
            ),
        }
    }
    /// Returns the quotient; none where the other is zero.
    pub(crate) fn over(self, other: Self) -> Option<Self> {
        if other == Self::ONE {
            return Some(self);
        }
        let norm = other.norm();
        (norm != 0).then(|| {
            let inverse = Self::of(power(norm, P - 2));
            let other = Self { real: other.real, imaginary: negative(other.imaginary) };
            self.times(other.times(inverse))
        })
    }
    /// Returns the square of its size, a number without `i`.
    fn norm(self) -> u64 {
        add(multiply(self.real, self.real), multiply(self.imaginary, self.imaginary))
    }
    /// Returns one of its square roots; none where there are none.
    pub(crate) fn root(self) -> Option<Self> {
        if self.imaginary == 0 {
            let root = power(self.real, (P + 1) / 4);
            let is_real = multiply(root, root) == self.real;
            return Some(if is_real { Self::of(root) } else { Self { real: 0, imaginary: root } });
        }
        let size = square_root(self.norm())?;
        let half = power(2, P - 2);
        let real = [size, negative(size)]
            .into_iter()
            .find_map(|size| square_root(multiply(half, add(self.real, size))))?;
        let imaginary = multiply(self.imaginary, power(add(real, real), P - 2));
        Some(Self { real, imaginary })
    }
}

fn square_root(of: u64) -> Option<u64> {
    let root = power(of, (P + 1) / 4);
    (multiply(root, root) == of).then_some(root)
}

fn reduced(x: u128) -> u64 {
    let once = (x & u128::from(P)) + (x >> 61);
    let twice = (once as u64 & P) + (once >> 61) as u64;
    if twice >= P { twice - P } else { twice }
}
fn add(a: u64, b: u64) -> u64 {
    let sum = a + b;
    if sum >= P { sum - P } else { sum }
}
fn negative(a: u64) -> u64 {
    if a == 0 { 0 } else { P - a }
}
fn multiply(a: u64, b: u64) -> u64 {
    reduced(u128::from(a) * u128::from(b))
}
fn power(base: u64, mut exponent: u64) -> u64 {
    let (mut made, mut square) = (1, base);
    while exponent > 0 {
        if exponent & 1 == 1 {
            made = multiply(made, square);
        }
        square = multiply(square, square);
        exponent >>= 1;
    }
    made
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_divided_by_zero() {
        assert_eq!(Residue::ONE.over(Residue::ZERO), None);
    }

    #[test]
    fn a_quotient_times_the_divisor_is_the_dividend() {
        for seed in 0..50 {
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| Residue::drawn(4 * seed + i).real);
            let a = Residue { real: a, imaginary: b };
            let b = Residue { real: c, imaginary: d };
            assert_eq!(a.over(b).expect("it is not zero").times(b), a);
            assert!(a.plus(a.negated()).is_zero());
        }
    }

    /// Every number without `i` has a root, and half of the others.
    #[test]
    fn roots_squared_are_what_they_are_roots_of() {
        let mut with = 0;
        for seed in 0..200 {
            let real = Residue::drawn(seed);
            let root = real.root().expect("a number without i has a root");
            assert_eq!(root.times(root), real);
            let other = Residue { real: real.real, imaginary: Residue::drawn(seed + 1000).real };
            if let Some(root) = other.root() {
                assert_eq!(root.times(root), other);
                with += 1;
            }
        }
        assert!((70..130).contains(&with), "{with}");
    }

    #[test]
    fn doubles_stand_for_fractions() {
        let of = |x: f64| Residue::standing_for(x);
        let ratio = |a: u64, b: u64| Residue::of(a).over(Residue::of(b));
        assert_eq!(of(0.1), ratio(1, 10));
        assert_eq!(of(1.0 / 3.0), ratio(1, 3));
        assert_eq!(of(-2.5).map(Residue::negated), ratio(5, 2));
        assert_eq!(of(0.0), Some(Residue::ZERO));
        assert_eq!(of(1.000_000_1), ratio(10_000_001, 10_000_000));
        assert_eq!(of(1e12), Some(Residue::of(1_000_000_000_000)));
        for irrational in [std::f64::consts::PI, std::f64::consts::SQRT_2, f64::NAN, 1e300] {
            assert_eq!(of(irrational), None);
        }
    }
}
