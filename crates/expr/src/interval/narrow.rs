//! Narrowing: what boxes of variables are left where an expression has to be in an interval.
//!
//! In: an expression, what it may be, boxes. Out: smaller boxes that lose no point at which the
//! expression is allowed. Every operation is asked once what its operands can be, users before operands;
//! one that tells nothing narrows nothing.
//!
//! **Source:** Benhamou, Goualard, Granvilliers and Puget, "Revising hull and box consistency" (1999), the
//! algorithm HC4revise.

use super::{FUNCTION_ERROR, Interval, binary, magnitude};
use crate::arena::{Arena, ExprId, Node, place};
use crate::op::{Binary, Unary};
use base::Id;

impl Arena {
    /// Makes boxes of variables lose what would put an expression outside `allowed`. Returns false if
    /// nothing is left.
    ///
    /// # Panics
    /// If a variable that occurs in it has no interval.
    pub fn narrow(&self, id: ExprId, allowed: Interval, boxes: &mut [Interval]) -> bool {
        let order = self.reachable(&[id]);
        let mut left = self.enclose_each(&order, boxes);
        let root = place(&order, id);
        left[root] = left[root].meet(allowed);
        for (at, &id) in order.iter().enumerate().rev() {
            let result = left[at];
            if result.is_none() {
                return false;
            }
            let of = |operand| left[place(&order, operand)];
            let asked = match self.node(id) {
                Node::Constant(_) => [None, None],
                Node::Var(var) => {
                    boxes[var.index()] = boxes[var.index()].meet(result);
                    [None, None]
                }
                Node::Unary(op, a) => [Some((a, operand_of(op, of(a), result))), None],
                Node::Binary(Binary::Mul, a, b) if a == b => {
                    [Some((a, root_of(of(a), result))), None]
                }
                Node::Binary(op, a, b) => {
                    let (x, y) = operands_of(op, of(a), of(b), result);
                    [Some((a, x)), Some((b, y))]
                }
                Node::Select { condition, then, otherwise } => match of(condition) {
                    decided if !decided.contains(0.0) => [Some((then, result)), None],
                    decided if decided == Interval::point(0.0) => [Some((otherwise, result)), None],
                    _ => [None, None],
                },
            };
            for (operand, allowed) in asked.into_iter().flatten() {
                let own = &mut left[place(&order, operand)];
                *own = own.meet(allowed);
            }
        }
        true
    }
}

/// What an operand can be, for what its operation comes to.
fn operand_of(op: Unary, own: Interval, result: Interval) -> Interval {
    match op {
        Unary::Neg => Interval { low: -result.high, high: -result.low },
        Unary::Abs => either_sign(own, result),
        Unary::Sqrt => {
            let result = result.clip(0.0, f64::INFINITY);
            Interval { low: result.low * result.low, high: result.high * result.high }.widen(3)
        }
        Unary::Exp if result.high <= 0.0 => Interval::NONE,
        Unary::Exp => {
            result.clip(0.0, f64::INFINITY).rising(Unary::Ln, FUNCTION_ERROR).widen(FUNCTION_ERROR)
        }
        Unary::Floor => Interval { low: result.low, high: result.high + 1.0 },
        Unary::Round => Interval { low: result.low - 0.5, high: result.high + 0.5 }.widen(1),
        Unary::Not if result == Interval::point(1.0) => Interval::point(0.0),
        Unary::Sin
        | Unary::Cos
        | Unary::Tan
        | Unary::Asin
        | Unary::Acos
        | Unary::Atan
        | Unary::Ln
        | Unary::Log10
        | Unary::Log2
        | Unary::Sinh
        | Unary::Cosh
        | Unary::Tanh
        | Unary::Asinh
        | Unary::Acosh
        | Unary::Atanh
        | Unary::Cbrt
        | Unary::Sign
        | Unary::Not => Interval::ALL,
    }
}

/// What operands can be, for what their operation comes to.
fn operands_of(op: Binary, a: Interval, b: Interval, result: Interval) -> (Interval, Interval) {
    match op {
        Binary::Add => (binary(Binary::Sub, result, b), binary(Binary::Sub, result, a)),
        Binary::Sub => (binary(Binary::Add, result, b), binary(Binary::Sub, a, result)),
        Binary::Mul => (quotient(result, b), quotient(result, a)),
        Binary::Div => (binary(Binary::Mul, result, b), quotient(a, result)),
        Binary::Min => {
            let above = Interval { low: result.low, high: f64::INFINITY };
            (above, above)
        }
        Binary::Max => {
            let below = Interval { low: f64::NEG_INFINITY, high: result.high };
            (below, below)
        }
        Binary::Less | Binary::LessEqual if result == Interval::point(1.0) => rising_pair(a, b),
        Binary::Less | Binary::LessEqual if result == Interval::point(0.0) => {
            let (b, a) = rising_pair(b, a);
            (a, b)
        }
        Binary::Equal if result == Interval::point(1.0) => (b, a),
        Binary::Pow
        | Binary::Atan2
        | Binary::Remainder
        | Binary::Less
        | Binary::LessEqual
        | Binary::Equal
        | Binary::NotEqual
        | Binary::And
        | Binary::Or => (Interval::ALL, Interval::ALL),
    }
}

/// What two numbers can be of which the first is not above the second.
fn rising_pair(a: Interval, b: Interval) -> (Interval, Interval) {
    (
        Interval { low: f64::NEG_INFINITY, high: b.high },
        Interval { low: a.low, high: f64::INFINITY },
    )
}

/// What a number can be whose product with one of `by` is in `product`.
fn quotient(product: Interval, by: Interval) -> Interval {
    if product.contains(0.0) && by.contains(0.0) {
        return Interval::ALL;
    }
    if by == Interval::point(0.0) {
        return Interval::NONE;
    }
    if by.low < 0.0 && by.high > 0.0 {
        // on either side of zero: one interval tells nothing
        return Interval::ALL;
    }
    if !by.contains(0.0) {
        return binary(Binary::Div, product, by).widen(1);
    }
    // the divisor has one sign and comes as near to zero as one likes
    let (product, most) = if by.high > 0.0 {
        (product, by.high)
    } else {
        (Interval { low: -product.high, high: -product.low }, -by.low)
    };
    if product.low > 0.0 {
        Interval { low: product.low / most, high: f64::INFINITY }.widen(2)
    } else {
        Interval { low: f64::NEG_INFINITY, high: product.high / most }.widen(2)
    }
}

/// What a number can be whose size is in `size`.
fn either_sign(own: Interval, size: Interval) -> Interval {
    let size = size.clip(0.0, f64::INFINITY);
    let below = Interval { low: -size.high, high: -size.low };
    match (own.meet(below).is_none(), own.meet(size).is_none()) {
        (true, _) => size,
        (false, true) => below,
        (false, false) => below.join(size),
    }
}

/// What a number can be whose square is in `square`.
fn root_of(own: Interval, square: Interval) -> Interval {
    let square = square.clip(0.0, f64::INFINITY);
    if square.is_none() {
        return square;
    }
    let root = magnitude(square.rising(Unary::Sqrt, 2).clip(0.0, f64::INFINITY));
    either_sign(own, root)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Var;

    fn between(low: f64, high: f64) -> Interval {
        Interval { low, high }
    }

    #[test]
    fn a_product_narrows_both_its_factors() {
        let mut arena = Arena::new();
        let (n, pitch) = (arena.var(Var(0)), arena.var(Var(1)));
        let length = arena.mul(n, pitch);
        let mut boxes = [between(1.0, 200.0), between(f64::NEG_INFINITY, 30.0)];
        assert!(arena.narrow(length, Interval::point(100.0), &mut boxes));
        assert!(boxes[1].contains(0.5) && boxes[1].low > 0.49);
        assert!(arena.narrow(length, Interval::point(100.0), &mut boxes));
        assert!(boxes[0].contains(100.0 / 30.0) && boxes[0].low > 3.33, "{:?}", boxes[0]);
    }
    #[test]
    fn a_divisor_of_one_sign_bounds_what_is_divided() {
        let mut arena = Arena::new();
        let (x, y) = (arena.var(Var(0)), arena.var(Var(1)));
        let product = arena.mul(x, y);
        let mut boxes = [Interval::ALL, between(0.0, 5.0)];
        assert!(arena.narrow(product, between(1.0, 2.0), &mut boxes));
        assert!(boxes[0].contains(0.2) && boxes[0].low > 0.19);
        let mut boxes = [Interval::ALL, Interval::point(0.0)];
        assert!(!arena.narrow(product, between(1.0, 2.0), &mut boxes), "nothing times zero is one");
    }
    #[test]
    fn squares_and_roots_are_taken_back() {
        let mut arena = Arena::new();
        let x = arena.var(Var(0));
        let square = arena.square(x);
        let mut boxes = [between(0.0, 10.0)];
        assert!(arena.narrow(square, between(4.0, 9.0), &mut boxes));
        assert!(boxes[0].contains(2.0) && boxes[0].contains(3.0));
        assert!(boxes[0].low > 1.99 && boxes[0].high < 3.01);
        let mut boxes = [between(-10.0, 10.0)];
        assert!(!arena.narrow(square, between(-2.0, -1.0), &mut boxes));
        let root = arena.sqrt(x);
        let mut boxes = [Interval::ALL];
        assert!(arena.narrow(root, between(2.0, 3.0), &mut boxes));
        assert!(boxes[0].contains(4.0) && boxes[0].contains(9.0) && boxes[0].high < 9.01);
    }
    #[test]
    fn no_point_is_lost() {
        // (x - 2)^2 + |y| = 5 at (3, -4), (0, 1), (2, 5)
        let mut arena = Arena::new();
        let (x, y) = (arena.var(Var(0)), arena.var(Var(1)));
        let two = arena.constant(2.0);
        let moved = arena.sub(x, two);
        let square = arena.square(moved);
        let size = arena.unary(Unary::Abs, y);
        let sum = arena.add(square, size);
        let mut boxes = [between(-9.0, 9.0), between(-9.0, 9.0)];
        assert!(arena.narrow(sum, Interval::point(5.0), &mut boxes));
        for (x, y) in [(3.0, -4.0), (0.0, 1.0), (2.0, 5.0), (2.0, -5.0)] {
            assert!(boxes[0].contains(x) && boxes[1].contains(y), "{boxes:?}");
        }
        assert!(boxes[1].high < 5.1);
    }
}
