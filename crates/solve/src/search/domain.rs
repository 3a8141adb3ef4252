//! Domains: the whole numbers that a cell may still be.

/// The largest whole number that a cell may be: beyond it `f64` skips some.
pub(crate) const MOST: i64 = 1 << 53;

/// How many values a domain may have to be kept one by one.
const BITS: i64 = 64;

/// A set of whole numbers: one by one where they lie within 64 of each other, else all between two.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Domain {
    /// `base + i` for every bit `i` that is set.
    Bits {
        base: i64,
        bits: u64,
    },
    Range {
        low: i64,
        high: i64,
    },
}

impl Domain {
    /// All whole numbers between two, both included, as far as a cell can hold them.
    pub(crate) fn between(low: i64, high: i64) -> Self {
        let (low, high) = (low.max(-MOST), high.min(MOST));
        if high < low {
            Self::Bits { base: low, bits: 0 }
        } else if high - low < BITS {
            Self::Bits { base: low, bits: u64::MAX >> (BITS - 1 - (high - low)) }
        } else {
            Self::Range { low, high }
        }
    }
    pub(crate) fn one(value: i64) -> Self {
        Self::Bits { base: value, bits: 1 }
    }
    pub(crate) fn is_empty(self) -> bool {
        self.size() == 0
    }
    pub(crate) fn size(self) -> u64 {
        match self {
            Self::Bits { bits, .. } => u64::from(bits.count_ones()),
            Self::Range { low, high } => (high - low + 1) as u64,
        }
    }
    /// Returns the least value; anything where there is none.
    pub(crate) fn low(self) -> i64 {
        match self {
            Self::Bits { base, bits } => base + i64::from(bits.trailing_zeros()),
            Self::Range { low, .. } => low,
        }
    }
    /// Returns the greatest value; anything where there is none.
    pub(crate) fn high(self) -> i64 {
        match self {
            Self::Bits { base, bits } => base + 63 - i64::from(bits.leading_zeros()),
            Self::Range { high, .. } => high,
        }
    }
    /// Returns the value, where there is only one.
    pub(crate) fn known(self) -> Option<i64> {
        (self.size() == 1).then(|| self.low())
    }
    pub(crate) fn contains(self, value: i64) -> bool {
        match self {
            Self::Bits { base, bits } => {
                let at = value.wrapping_sub(base);
                (0..BITS).contains(&at) && bits >> at & 1 == 1
            }
            Self::Range { low, high } => (low..=high).contains(&value),
        }
    }
    /// Leaves the values between two out of which none is lost.
    pub(crate) fn clip(self, low: i64, high: i64) -> Self {
        match self {
            Self::Range { low: l, high: h } => Self::between(l.max(low), h.min(high)),
            Self::Bits { base, bits } => {
                let below = low.saturating_sub(base).clamp(0, BITS);
                let upto = high.saturating_sub(base).saturating_add(1).clamp(0, BITS);
                let first = |n: i64| if n == BITS { u64::MAX } else { (1u64 << n) - 1 };
                Self::Bits { base, bits: bits & first(upto) & !first(below) }
            }
        }
    }
    /// Takes a value out, where that can be told: not from the middle of a range.
    pub(crate) fn without(self, value: i64) -> Self {
        match self {
            Self::Bits { base, bits } if self.contains(value) => {
                Self::Bits { base, bits: bits & !(1 << (value - base)) }
            }
            Self::Range { low, high } if low == value => Self::between(low + 1, high),
            Self::Range { low, high } if high == value => Self::between(low, high - 1),
            Self::Bits { .. } | Self::Range { .. } => self,
        }
    }
    /// Names its values in rising order, where they are kept one by one.
    pub(crate) fn values(self) -> Option<impl Iterator<Item = i64>> {
        match self {
            Self::Bits { base, bits } => {
                let mut left = bits;
                Some(std::iter::from_fn(move || {
                    let at = left.trailing_zeros();
                    if left == 0 {
                        return None;
                    }
                    left &= left - 1;
                    Some(base + i64::from(at))
                }))
            }
            Self::Range { .. } => None,
        }
    }
    /// Returns the value nearest to a number, the smaller of two.
    pub(crate) fn nearest(self, to: f64) -> i64 {
        match self {
            Self::Range { low, high } => (to.round() as i64).clamp(low, high),
            Self::Bits { .. } => {
                let distance = |v: i64| (v as f64 - to).abs();
                let values = self.values().into_iter().flatten();
                values.min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap_or(self.low())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listed(d: Domain) -> Vec<i64> {
        d.values().into_iter().flatten().collect()
    }

    #[test]
    fn small_sets_are_exact() {
        let d = Domain::between(-3, 4).without(0).clip(-1, 9);
        assert_eq!(listed(d), [-1, 1, 2, 3, 4]);
        assert_eq!((d.low(), d.high(), d.size(), d.known()), (-1, 4, 5, None));
        assert!(d.clip(5, 9).is_empty());
        assert_eq!(d.nearest(0.4), 1);
        assert_eq!(d.nearest(0.0), -1, "the smaller of two that are as near");
        assert_eq!(Domain::between(0, 63).size(), 64);
        assert!(Domain::between(2, 1).is_empty());
    }

    #[test]
    fn large_ones_are_ranges_until_they_are_small() {
        let d = Domain::between(i64::MIN, i64::MAX);
        assert_eq!((d.low(), d.high()), (-MOST, MOST));
        assert_eq!(d.without(5), d, "the middle of a range stays");
        assert_eq!(d.without(MOST).high(), MOST - 1);
        assert_eq!(listed(d.clip(7, 9)), [7, 8, 9]);
        assert_eq!(d.nearest(-2.4), -2);
    }
}
