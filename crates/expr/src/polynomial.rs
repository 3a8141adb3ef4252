//! Polynomials: an expression as coefficients of the powers of one variable, up to the second.
//!
//! In: expressions and a variable. Out: coefficients free of it, or none where the expression is no
//! such polynomial.

use crate::arena::{Arena, ExprId, Node, Var, place};
use crate::op::{Binary, Unary};

/// Coefficients of the powers 0, 1 and 2 of the variable; the last is not the constant 0.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Coefficients {
    /// Free of the variable.
    Constant(ExprId),
    /// `[0] + [1] x`
    Linear([ExprId; 2]),
    /// `[0] + [1] x + [2] x²`
    Quadratic([ExprId; 3]),
}

impl Coefficients {
    fn all(self, zero: ExprId) -> [ExprId; 3] {
        match self {
            Self::Constant(c) => [c, zero, zero],
            Self::Linear([c, b]) => [c, b, zero],
            Self::Quadratic(all) => all,
        }
    }
    fn of(zero: ExprId, [c, b, a]: [ExprId; 3]) -> Self {
        if a != zero {
            Self::Quadratic([c, b, a])
        } else if b != zero {
            Self::Linear([c, b])
        } else {
            Self::Constant(c)
        }
    }
}

/// Returns the coefficients of `left - right`, if it is a polynomial of degree two or less in `var`.
pub(crate) fn difference(
    arena: &mut Arena,
    left: ExprId,
    right: ExprId,
    var: Var,
) -> Option<Coefficients> {
    let order = arena.reachable(&[left, right]);
    let (zero, one) = (arena.constant(0.0), arena.constant(1.0));
    // None for what is no such polynomial; it matters only if what is wanted is made of it.
    let mut known: Vec<Option<Coefficients>> = Vec::with_capacity(order.len());
    for &id in &order {
        let of = |a: ExprId| known[place(&order, a)];
        let node = arena.node(id);
        let mut is_free = node != Node::Var(var);
        node.each_operand(|a| is_free &= matches!(of(a), Some(Coefficients::Constant(_))));
        let coefficients = match node {
            Node::Constant(_) => Some(Coefficients::Constant(id)),
            _ if is_free => Some(Coefficients::Constant(id)),
            Node::Var(_) => Some(Coefficients::Linear([zero, one])),
            Node::Unary(Unary::Neg, a) => {
                of(a).map(|a| Coefficients::of(zero, a.all(zero).map(|c| arena.neg(c))))
            }
            Node::Unary(..) => None,
            Node::Binary(op, a, b) => of(a).zip(of(b)).and_then(|(a, b)| combine(arena, op, a, b)),
            Node::Select { condition, then, otherwise } => {
                match (of(condition), of(then), of(otherwise)) {
                    (Some(Coefficients::Constant(condition)), Some(a), Some(b)) => {
                        let (a, b) = (a.all(zero), b.all(zero));
                        let chosen = [0, 1, 2].map(|i| arena.select(condition, a[i], b[i]));
                        Some(Coefficients::of(zero, chosen))
                    }
                    _ => None,
                }
            }
        };
        known.push(coefficients);
    }
    let (left, right) = (known[place(&order, left)]?, known[place(&order, right)]?);
    combine(arena, Binary::Sub, left, right)
}

/// Computes with polynomials.
fn combine(
    arena: &mut Arena,
    op: Binary,
    a: Coefficients,
    b: Coefficients,
) -> Option<Coefficients> {
    let zero = arena.constant(0.0);
    let (x, y) = (a.all(zero), b.all(zero));
    let all = match (op, a, b) {
        (Binary::Add | Binary::Sub, ..) => [0, 1, 2].map(|i| arena.binary(op, x[i], y[i])),
        (Binary::Mul, Coefficients::Constant(c), _) => y.map(|y| arena.mul(c, y)),
        (Binary::Mul | Binary::Div, _, Coefficients::Constant(c)) => {
            x.map(|x| arena.binary(op, x, c))
        }
        (Binary::Mul, Coefficients::Linear(x), Coefficients::Linear(y)) => {
            let (across, along) = (arena.mul(x[0], y[1]), arena.mul(x[1], y[0]));
            [arena.mul(x[0], y[0]), arena.add(across, along), arena.mul(x[1], y[1])]
        }
        _ => return None,
    };
    Some(Coefficients::of(zero, all))
}

/// Returns true if an expression is linear in `vars` taken together; coefficients may hold others.
///
/// It looks at the form alone: `x * x / x` is not linear.
pub(crate) fn is_linear(arena: &Arena, id: ExprId, vars: &[Var]) -> bool {
    let order = arena.reachable(&[id]);
    let mut wanted = vars.to_vec();
    wanted.sort_unstable();
    // 0 for free of the variables, 1 for linear, 2 for everything else.
    let mut degrees: Vec<u8> = Vec::with_capacity(order.len());
    for &id in &order {
        let of = |a: ExprId| degrees[place(&order, a)];
        let node = arena.node(id);
        let mut highest = 0;
        node.each_operand(|a| highest = highest.max(of(a)));
        let degree = match node {
            Node::Constant(_) => 0,
            Node::Var(var) => u8::from(wanted.binary_search(&var).is_ok()),
            _ if highest == 0 => 0,
            Node::Unary(Unary::Neg, _) | Node::Binary(Binary::Add | Binary::Sub, ..) => highest,
            Node::Binary(Binary::Mul, a, b) => (of(a) + of(b)).min(2),
            Node::Binary(Binary::Div, a, b) if of(b) == 0 => of(a),
            Node::Select { condition, then, otherwise } if of(condition) == 0 => {
                of(then).max(of(otherwise))
            }
            Node::Unary(..) | Node::Binary(..) | Node::Select { .. } => 2,
        };
        degrees.push(degree);
    }
    degrees[place(&order, id)] < 2
}
