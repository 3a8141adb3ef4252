//! Intervals: what values an expression can have while its variables stay in boxes.
//!
//! In: an expression and an interval for each variable. Out: an interval that holds every value it
//! can have there, rounding included; often a wider one, since each occurrence of a variable is taken
//! by itself. Places where an operation is undefined (the root of a negative number) have no value
//! and widen nothing.
//!
//! **Source:** Moore, Kearfott and Cloud, *Introduction to Interval Analysis*, §5.

mod narrow;

use crate::arena::{Arena, ExprId, Node, place};
use crate::op::{Binary, Unary};
use base::Id;
use std::f64::consts::{FRAC_PI_2, PI};

/// All numbers from `low` to `high`, both included; none if `low` is above `high`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Interval {
    /// The least number.
    pub low: f64,
    /// The greatest number.
    pub high: f64,
}

/// How many neighbouring numbers a function of `base::number` may be away from the exact value.
const FUNCTION_ERROR: usize = 2;

impl Interval {
    /// Every number.
    pub const ALL: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };
    /// No number.
    pub const NONE: Self = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };
    const TRUTH: Self = Self { low: 0.0, high: 1.0 };

    /// Makes the interval of one number.
    pub fn point(x: f64) -> Self {
        Self { low: x, high: x }
    }
    /// Returns true if there is no number in it.
    pub fn is_none(self) -> bool {
        self.low.is_nan() || self.high.is_nan() || self.low > self.high
    }
    /// Returns true if the number is in it.
    pub fn contains(self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }
    /// Returns the smallest interval that holds both.
    #[must_use]
    pub fn join(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }
    /// Returns what is in both.
    #[must_use]
    pub fn meet(self, other: Self) -> Self {
        self.clip(other.low, other.high)
    }
    /// Returns all that is at most so far from it.
    #[must_use]
    pub fn inflate(self, by: f64) -> Self {
        Self { low: self.low - by, high: self.high + by }
    }
    fn clip(self, low: f64, high: f64) -> Self {
        Self { low: self.low.max(low), high: self.high.min(high) }
    }
    /// Moves both ends outward by some numbers.
    fn widen(self, steps: usize) -> Self {
        (0..steps).fold(self, |i, _| Self { low: i.low.next_down(), high: i.high.next_up() })
    }
    /// Moves both ends of what arithmetic made of two intervals outward by a number, where it may have rounded: of whole
    /// numbers below 2⁵³ a whole number is exact, quotients too.
    fn rounded_of(self, operands: [Self; 2]) -> Self {
        let is_whole = |x: f64| x.fract() == 0.0 && x.abs() < (1u64 << f64::MANTISSA_DIGITS) as f64;
        let are_whole = |i: Self| is_whole(i.low) && is_whole(i.high);
        let is_exact = are_whole(self) && operands.into_iter().all(are_whole);
        self.widen(usize::from(!is_exact))
    }
    /// Returns the smallest interval that holds these numbers; all if one of them is undefined.
    fn hull(numbers: &[f64]) -> Self {
        if numbers.iter().any(|x| x.is_nan()) {
            return Self::ALL;
        }
        numbers.iter().fold(Self::NONE, |i, &x| i.join(Self::point(x)))
    }
    /// The image under an operation that rises with its operand.
    fn rising(self, op: Unary, steps: usize) -> Self {
        Self { low: op.apply(self.low), high: op.apply(self.high) }.widen(steps)
    }
    /// The image under an operation whose extremes over a box lie at its corners.
    fn corners(self, other: Self, f: impl Fn(f64, f64) -> f64, steps: usize) -> Self {
        let (a, b) = (self, other);
        let all = [f(a.low, b.low), f(a.low, b.high), f(a.high, b.low), f(a.high, b.high)];
        Self::hull(&all).widen(steps)
    }
}

impl Arena {
    /// Returns an interval that holds every value of an expression over a box of variables.
    ///
    /// # Panics
    /// If a variable that occurs in it has no interval.
    pub fn enclose(&self, id: ExprId, boxes: &[Interval]) -> Interval {
        let order = self.reachable(&[id]);
        self.enclose_each(&order, boxes)[place(&order, id)]
    }

    /// Returns an interval for every one of these expressions, operands before users.
    fn enclose_each(&self, order: &[ExprId], boxes: &[Interval]) -> Vec<Interval> {
        let mut known: Vec<Interval> = Vec::with_capacity(order.len());
        for &id in order {
            let of = |a| known[place(order, a)];
            let interval = match self.node(id) {
                Node::Constant(bits) => Interval::point(f64::from_bits(bits)),
                Node::Var(var) => boxes[var.index()],
                Node::Unary(op, a) => unary(op, of(a)),
                Node::Binary(Binary::Mul, a, b) if a == b => square(of(a)),
                Node::Binary(op, a, b) => binary(op, of(a), of(b)),
                Node::Select { condition, then, otherwise } => {
                    select(of(condition), of(then), of(otherwise))
                }
            };
            known.push(interval);
        }
        known
    }
}

fn unary(op: Unary, a: Interval) -> Interval {
    if a.is_none() {
        return Interval::NONE;
    }
    let domain = match op {
        Unary::Sqrt | Unary::Ln | Unary::Log10 | Unary::Log2 => a.clip(0.0, f64::INFINITY),
        Unary::Acosh => a.clip(1.0, f64::INFINITY),
        Unary::Asin | Unary::Acos | Unary::Atanh => a.clip(-1.0, 1.0),
        Unary::Neg
        | Unary::Abs
        | Unary::Sin
        | Unary::Cos
        | Unary::Tan
        | Unary::Atan
        | Unary::Exp
        | Unary::Sinh
        | Unary::Cosh
        | Unary::Tanh
        | Unary::Asinh
        | Unary::Cbrt
        | Unary::Floor
        | Unary::Round
        | Unary::Sign
        | Unary::Not => a,
    };
    if domain.is_none() {
        return Interval::NONE;
    }
    match op {
        Unary::Neg => Interval { low: -a.high, high: -a.low },
        Unary::Abs => magnitude(a),
        Unary::Sqrt => domain.rising(op, 1),
        Unary::Sin => wave(op, a, FRAC_PI_2),
        Unary::Cos => wave(op, a, 0.0),
        Unary::Tan if holds_a_multiple(a, PI, FRAC_PI_2) => Interval::ALL,
        Unary::Tan
        | Unary::Asin
        | Unary::Atan
        | Unary::Ln
        | Unary::Log10
        | Unary::Log2
        | Unary::Sinh
        | Unary::Asinh
        | Unary::Atanh
        | Unary::Cbrt => domain.rising(op, FUNCTION_ERROR),
        Unary::Tanh => domain.rising(op, FUNCTION_ERROR).clip(-1.0, 1.0),
        Unary::Acosh => domain.rising(op, FUNCTION_ERROR).clip(0.0, f64::INFINITY),
        Unary::Cosh => magnitude(domain).rising(op, FUNCTION_ERROR).clip(1.0, f64::INFINITY),
        Unary::Exp => domain.rising(op, FUNCTION_ERROR).clip(0.0, f64::INFINITY),
        Unary::Acos => {
            let falling = Interval { low: domain.high, high: domain.low };
            falling.rising(op, FUNCTION_ERROR)
        }
        Unary::Floor | Unary::Round | Unary::Sign => a.rising(op, 0),
        Unary::Not => a.truth_of().negated(),
    }
}

/// Returns the truth value of something that certainly holds, certainly does not, or may do either.
fn truth(is_true: bool, is_false: bool) -> Interval {
    match (is_true, is_false) {
        (true, _) => Interval::point(1.0),
        (false, true) => Interval::point(0.0),
        (false, false) => Interval::TRUTH,
    }
}

impl Interval {
    /// The truth values that are left when true and false change places.
    fn negated(self) -> Self {
        Self { low: 1.0 - self.high, high: 1.0 - self.low }
    }
    fn truth_of(self) -> Self {
        truth(!self.contains(0.0), self == Self::point(0.0))
    }
}

fn magnitude(a: Interval) -> Interval {
    let high = a.low.abs().max(a.high.abs());
    let low = if a.contains(0.0) { 0.0 } else { a.low.abs().min(a.high.abs()) };
    Interval { low, high }
}

fn square(a: Interval) -> Interval {
    let size = magnitude(a);
    let square = Interval { low: size.low * size.low, high: size.high * size.high };
    if a.is_none() { a } else { square.widen(1).clip(0.0, f64::INFINITY) }
}

/// The image under sine or cosine, whose crests stand at `crest` and every turn from there.
fn wave(op: Unary, a: Interval, crest: f64) -> Interval {
    let ends = Interval::hull(&[op.apply(a.low), op.apply(a.high)]).widen(FUNCTION_ERROR);
    let high = if holds_a_multiple(a, 2.0 * PI, crest) { 1.0 } else { ends.high };
    let low = if holds_a_multiple(a, 2.0 * PI, crest + PI) { -1.0 } else { ends.low };
    Interval { low, high }.clip(-1.0, 1.0)
}

/// Returns true if a number `start + k * period` lies in the interval, or so near that rounding hides
/// it.
fn holds_a_multiple(a: Interval, period: f64, start: f64) -> bool {
    let (low, high) = ((a.low - start) / period, (a.high - start) / period);
    // Beyond this the position in the period has too few digits; NaN and infinities end here too.
    let is_near = low.abs() < 1e6 && high.abs() < 1e6;
    !is_near || (low - 1e-9).ceil() <= high + 1e-9
}

fn binary(op: Binary, a: Interval, b: Interval) -> Interval {
    if a.is_none() || b.is_none() {
        return Interval::NONE;
    }
    let apply = |x: f64, y: f64| op.apply(x, y);
    match op {
        Binary::Add => Interval { low: a.low + b.low, high: a.high + b.high }.rounded_of([a, b]),
        Binary::Sub => Interval { low: a.low - b.high, high: a.high - b.low }.rounded_of([a, b]),
        Binary::Mul => {
            let product = |x: f64, y: f64| if x == 0.0 || y == 0.0 { 0.0 } else { x * y };
            a.corners(b, product, 0).rounded_of([a, b])
        }
        Binary::Div if b.contains(0.0) => Interval::ALL,
        Binary::Div => a.corners(b, apply, 0).rounded_of([a, b]),
        Binary::Pow => power(a, b),
        Binary::Atan2 if a.contains(0.0) && b.low <= 0.0 => {
            Interval { low: -PI, high: PI }.widen(1)
        }
        Binary::Atan2 => a.corners(b, apply, FUNCTION_ERROR),
        Binary::Min => Interval { low: a.low.min(b.low), high: a.high.min(b.high) },
        Binary::Max => Interval { low: a.low.max(b.low), high: a.high.max(b.high) },
        Binary::Remainder => remainder(a, b),
        Binary::Less => truth(a.high < b.low, a.low >= b.high),
        Binary::LessEqual => truth(a.high <= b.low, a.low > b.high),
        Binary::Equal => equality(a, b),
        Binary::NotEqual => equality(a, b).negated(),
        Binary::And => {
            let (a, b) = (a.truth_of(), b.truth_of());
            Interval { low: a.low.min(b.low), high: a.high.min(b.high) }
        }
        Binary::Or => {
            let (a, b) = (a.truth_of(), b.truth_of());
            Interval { low: a.low.max(b.low), high: a.high.max(b.high) }
        }
    }
}

fn equality(a: Interval, b: Interval) -> Interval {
    let is_same_point = a.low == a.high && a == b;
    truth(is_same_point, a.high < b.low || b.high < a.low)
}

fn power(a: Interval, b: Interval) -> Interval {
    let apply = |x: f64, y: f64| Binary::Pow.apply(x, y);
    if a.low >= 0.0 {
        // In each operand by itself a power rises or falls throughout.
        return a.corners(b, apply, FUNCTION_ERROR).clip(0.0, f64::INFINITY);
    }
    let is_whole = b.low == b.high && b.low == b.low.round() && b.low.is_finite();
    if !is_whole || (b.low < 0.0 && a.contains(0.0)) {
        return Interval::ALL;
    }
    let base = if b.low % 2.0 == 0.0 { magnitude(a) } else { a };
    base.corners(b, apply, FUNCTION_ERROR)
}

fn remainder(a: Interval, b: Interval) -> Interval {
    let whole = Interval { low: b.low.min(0.0), high: b.high.max(0.0) };
    if b.low != b.high || b.low == 0.0 || !b.low.is_finite() {
        return whole;
    }
    let ends = [a.low, a.high].map(|x| Binary::Remainder.apply(x, b.low));
    // Over less than a period the remainder rises, unless it starts anew between the ends.
    let starts_anew = holds_a_multiple(a, b.low.abs(), 0.0);
    if starts_anew { whole } else { Interval::hull(&ends).widen(1) }
}

fn select(condition: Interval, then: Interval, otherwise: Interval) -> Interval {
    if condition.is_none() {
        Interval::NONE
    } else if !condition.contains(0.0) {
        then
    } else if condition == Interval::point(0.0) {
        otherwise
    } else {
        then.join(otherwise)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Var;

    #[test]
    fn a_root_has_no_value_below_zero() {
        let mut arena = Arena::new();
        let x = arena.var(Var(0));
        let root = arena.sqrt(x);
        assert!(arena.enclose(root, &[Interval { low: -2.0, high: -1.0 }]).is_none());
        let partly = arena.enclose(root, &[Interval { low: -1.0, high: 4.0 }]);
        assert!(partly.contains(0.0) && partly.contains(2.0) && !partly.contains(2.1));
    }
    #[test]
    fn a_divisor_that_may_be_zero_tells_nothing() {
        let mut arena = Arena::new();
        let (x, one) = (arena.var(Var(0)), arena.constant(1.0));
        let e = arena.div(one, x);
        assert_eq!(arena.enclose(e, &[Interval { low: -1.0, high: 1.0 }]), Interval::ALL);
    }
    #[test]
    fn the_crest_of_a_wave_is_seen() {
        let mut arena = Arena::new();
        let x = arena.var(Var(0));
        let sin = arena.unary(Unary::Sin, x);
        let over_crest = arena.enclose(sin, &[Interval { low: 1.0, high: 2.0 }]);
        assert_eq!(over_crest.high, 1.0);
        assert!((over_crest.low - base::number::sin(1.0)).abs() < 1e-15);
        let rising = arena.enclose(sin, &[Interval { low: -1.0, high: 1.0 }]);
        assert!(rising.high < 0.85 && rising.low > -0.85);
    }
    #[test]
    fn a_square_is_never_negative() {
        let mut arena = Arena::new();
        let x = arena.var(Var(0));
        let e = arena.square(x);
        let i = arena.enclose(e, &[Interval { low: -3.0, high: 2.0 }]);
        assert!(i.low == 0.0 && i.contains(9.0) && !i.contains(9.1));
    }
}
