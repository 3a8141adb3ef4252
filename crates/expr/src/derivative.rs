//! Derivatives: exact, symbolic, of one expression by any number of variables at once.
//!
//! In: an expression and variables. Out: one expression for each. The derivative of the result by each
//! inner node is carried from the result down to the variables (the reverse mode), so that the cost is
//! that of the expression, however many variables there are.
//!
//! A choice (`select`, `min`, `max`) is differentiated branch by branch and chosen afterwards, never
//! multiplied by 0: the branch that is not taken may have no derivative. The largest of many that share no
//! variable, and have derivatives everywhere, passes its own down to the one that is taken: so that of a list
//! costs no more than a sum.
//!
//! **Source:** Griewank and Walther, *Evaluating Derivatives*, 2nd ed., §3.2 (adjoints).

use crate::arena::{Arena, ExprId, Node, Var, place};
use crate::op::{Binary, Unary};
use base::Id;
use std::collections::BTreeMap;
use std::f64::consts::{LN_2, LN_10};

/// Derivatives by the variables on which there is a dependence, by position in the list of variables.
type Sparse = BTreeMap<usize, ExprId>;

/// Returns the derivative of an expression by one variable.
///
/// ```
/// use expr::{Arena, Var, derivative};
/// let mut arena = Arena::default();
/// let x = arena.var(Var(0));
/// let square = arena.square(x);
/// let slope = derivative(&mut arena, square, Var(0));
/// assert_eq!(arena.evaluate(slope, &[3.0]), 6.0);
/// ```
pub fn derivative(arena: &mut Arena, id: ExprId, var: Var) -> ExprId {
    gradient(arena, id, &[var])[0]
}

/// Returns the derivatives of an expression by each of `vars`, in their order.
///
/// `floor`, `round`, `sign` and truth values have the derivative 0; where `abs` turns, it is 0; where
/// `min` and `max` turn, it is that of the first operand. Nothing is guarded: where there is no
/// derivative the result is not finite.
pub fn gradient(arena: &mut Arena, id: ExprId, vars: &[Var]) -> Vec<ExprId> {
    let order = arena.reachable(&[id]);
    let wanted: BTreeMap<Var, usize> =
        vars.iter().enumerate().rev().map(|(i, &v)| (v, i)).collect();
    let mut depends = Vec::with_capacity(order.len());
    for &e in &order {
        let node = arena.node(e);
        depends.push(match node {
            Node::Var(var) => wanted.contains_key(&var),
            _ if is_flat(node) => false,
            Node::Select { then, otherwise, .. } => {
                depends[place(&order, then)] || depends[place(&order, otherwise)]
            }
            _ => {
                let mut any = false;
                node.each_operand(|a| any |= depends[place(&order, a)]);
                any
            }
        });
    }
    let is_apart = apart(arena, &order);
    let mut pass = Pass { arena, order, depends, is_apart, wanted, choices: BTreeMap::new() };
    for i in 0..pass.order.len() {
        if let Some((condition, then, otherwise)) = pass.choice(i) {
            let (then, otherwise) = (pass.sweep(then), pass.sweep(otherwise));
            let chosen = pass.choose(condition, &then, &otherwise);
            pass.choices.insert(i, chosen);
        }
    }
    let result = pass.sweep(id);
    let zero = pass.arena.constant(0.0);
    vars.iter().map(|v| result.get(&pass.wanted[v]).copied().unwrap_or(zero)).collect()
}

/// Returns for every node of an arena whether its value changes other than by steps.
pub fn varying(arena: &Arena) -> Vec<bool> {
    let mut varies = Vec::with_capacity(arena.len());
    for node in arena.nodes() {
        let mut any = matches!(node, Node::Var(_));
        match node {
            _ if is_flat(node) => {}
            Node::Select { then, otherwise, .. } => {
                any = varies[then.index()] || varies[otherwise.index()];
            }
            _ => node.each_operand(|operand| any |= varies[operand.index()]),
        }
        varies.push(any);
    }
    varies
}

/// Finds, among nodes in order, every `min` and `max` that chooses between values that share no variable and
/// have finite derivatives wherever they are finite.
fn apart(arena: &Arena, order: &[ExprId]) -> Vec<bool> {
    const NONE: u32 = u32::MAX;
    let choice = |id: ExprId| match arena.node(id) {
        Node::Binary(Binary::Min | Binary::Max, a, b) => Some([a, b]),
        Node::Constant(_) | Node::Var(_) | Node::Unary(..) | Node::Binary(..) => None,
        Node::Select { .. } => None,
    };
    let mut is_apart = vec![false; order.len()];
    if !order.iter().any(|&id| choice(id).is_some()) {
        return is_apart;
    }
    let mut is_tame: Vec<bool> = Vec::with_capacity(order.len());
    for &id in order {
        let is = |a: ExprId| is_tame[place(order, a)];
        is_tame.push(match arena.node(id) {
            Node::Constant(_) | Node::Var(_) => true,
            Node::Unary(Unary::Neg, a) => is(a),
            Node::Binary(Binary::Add | Binary::Sub | Binary::Mul, a, b) => is(a) && is(b),
            Node::Binary(Binary::Div, a, b) => is(a) && arena.as_constant(b).is_some(),
            Node::Unary(..) | Node::Binary(..) | Node::Select { .. } => false,
        });
    }
    // which value of which tree of choices a node is part of
    let mut part_of = vec![(NONE, NONE); order.len()];
    let mut is_known = vec![false; order.len()];
    for top in (0..order.len()).rev() {
        if is_known[top] || choice(order[top]).is_none() {
            continue;
        }
        let (mut choices, mut values) = (vec![top], Vec::new());
        let (mut next, mut holds) = (0, true);
        while let Some(&at) = choices.get(next) {
            next += 1;
            if std::mem::replace(&mut is_known[at], true) {
                holds = false;
                continue;
            }
            for operand in choice(order[at]).into_iter().flatten() {
                let at = place(order, operand);
                let list = if choice(operand).is_some() { &mut choices } else { &mut values };
                list.push(at);
            }
        }
        holds &= values.iter().all(|&value| is_tame[value]);
        let mut stack = Vec::new();
        for (&value, number) in values.iter().zip(0..) {
            if !holds {
                break;
            }
            stack.push(value);
            while let Some(at) = stack.pop() {
                let now = (top as u32, number);
                let before = std::mem::replace(&mut part_of[at], now);
                if before == now || arena.as_constant(order[at]).is_some() {
                    continue;
                }
                holds &= before.0 != now.0;
                arena.node(order[at]).each_operand(|operand| stack.push(place(order, operand)));
            }
        }
        choices.iter().for_each(|&at| is_apart[at] = holds);
    }
    is_apart
}

/// Returns true if the derivative of the node is 0 wherever there is one.
fn is_flat(node: Node) -> bool {
    match node {
        Node::Constant(_) => true,
        Node::Var(_) | Node::Select { .. } => false,
        Node::Unary(op, _) => {
            matches!(op, Unary::Floor | Unary::Round | Unary::Sign | Unary::Not)
        }
        Node::Binary(op, ..) => op.is_truth(),
    }
}

/// One expression being differentiated; nodes are named by their place in `order`.
struct Pass<'a> {
    arena: &'a mut Arena,
    order: Vec<ExprId>,
    depends: Vec<bool>,
    /// Choices that pass their derivative down.
    is_apart: Vec<bool>,
    wanted: BTreeMap<Var, usize>,
    /// The derivatives of the choices met so far.
    choices: BTreeMap<usize, Sparse>,
}

impl Pass<'_> {
    /// Returns the condition and branches of a choice that depends on the variables.
    fn choice(&mut self, i: usize) -> Option<(ExprId, ExprId, ExprId)> {
        let waits = self.depends[i] && !self.is_apart[i];
        if waits { self.alternatives(i) } else { None }
    }
    /// Returns the condition and branches of a choice.
    fn alternatives(&mut self, i: usize) -> Option<(ExprId, ExprId, ExprId)> {
        match self.arena.node(self.order[i]) {
            Node::Select { condition, then, otherwise } => Some((condition, then, otherwise)),
            Node::Binary(Binary::Min, a, b) => {
                Some((self.arena.binary(Binary::LessEqual, a, b), a, b))
            }
            Node::Binary(Binary::Max, a, b) => {
                Some((self.arena.binary(Binary::LessEqual, b, a), a, b))
            }
            Node::Constant(_) | Node::Var(_) | Node::Unary(..) | Node::Binary(..) => None,
        }
    }
    fn choose(&mut self, condition: ExprId, then: &Sparse, otherwise: &Sparse) -> Sparse {
        let zero = self.arena.constant(0.0);
        let mut chosen = Sparse::new();
        for &v in then.keys().chain(otherwise.keys()) {
            let a = then.get(&v).copied().unwrap_or(zero);
            let b = otherwise.get(&v).copied().unwrap_or(zero);
            chosen.insert(v, self.arena.select(condition, a, b));
        }
        chosen
    }
    /// Carries the derivative 1 of `root` down to the variables, through choices met before.
    fn sweep(&mut self, root: ExprId) -> Sparse {
        let mut result = Sparse::new();
        // Users stand after operands, so the last pending node has all its contributions.
        let top = place(&self.order, root);
        let mut pending = vec![None; top + 1];
        let one = self.arena.constant(1.0);
        self.contribute(&mut pending, root, one);
        for i in (0..=top).rev() {
            let Some(adjoint) = pending[i] else { continue };
            if let Some(choice) = self.choices.get(&i) {
                for (v, d) in choice.clone() {
                    let contribution = self.arena.mul(adjoint, d);
                    self.accumulate(&mut result, v, contribution);
                }
                continue;
            }
            if self.is_apart[i]
                && let Some((condition, then, otherwise)) = self.alternatives(i)
            {
                let zero = self.arena.constant(0.0);
                let taken = self.arena.select(condition, adjoint, zero);
                self.contribute(&mut pending, then, taken);
                let taken = self.arena.select(condition, zero, adjoint);
                self.contribute(&mut pending, otherwise, taken);
                continue;
            }
            let id = self.order[i];
            match self.arena.node(id) {
                Node::Var(var) => self.accumulate(&mut result, self.wanted[&var], adjoint),
                Node::Unary(op, a) => {
                    let d = unary(self.arena, op, a, id, adjoint);
                    self.contribute(&mut pending, a, d);
                }
                Node::Binary(op, a, b) => {
                    if self.depends[place(&self.order, a)] {
                        let d = first_operand(self.arena, op, a, b, adjoint);
                        self.contribute(&mut pending, a, d);
                    }
                    if self.depends[place(&self.order, b)] && !(op == Binary::Mul && a == b) {
                        let d = second_operand(self.arena, op, a, b, id, adjoint);
                        self.contribute(&mut pending, b, d);
                    }
                }
                Node::Constant(_) | Node::Select { .. } => {
                    unreachable!("constants do not depend, selects are choices")
                }
            }
        }
        result
    }
    fn contribute(&mut self, pending: &mut [Option<ExprId>], to: ExprId, contribution: ExprId) {
        let i = place(&self.order, to);
        if self.depends[i] {
            pending[i] = Some(self.sum(pending[i], contribution));
        }
    }
    fn accumulate(&mut self, sums: &mut Sparse, key: usize, contribution: ExprId) {
        let sum = self.sum(sums.get(&key).copied(), contribution);
        sums.insert(key, sum);
    }
    fn sum(&mut self, before: Option<ExprId>, contribution: ExprId) -> ExprId {
        before.map_or(contribution, |before| self.arena.add(before, contribution))
    }
}

/// Returns `adjoint` times the derivative of `op(a)`, whose value is `id`, by `a`.
fn unary(arena: &mut Arena, op: Unary, a: ExprId, id: ExprId, adjoint: ExprId) -> ExprId {
    let one = arena.constant(1.0);
    match op {
        Unary::Neg => arena.neg(adjoint),
        Unary::Abs => {
            let sign = arena.unary(Unary::Sign, a);
            arena.mul(adjoint, sign)
        }
        Unary::Sqrt => {
            let half = arena.constant(0.5);
            let half = arena.mul(half, adjoint);
            arena.div(half, id)
        }
        Unary::Sin => {
            let cos = arena.unary(Unary::Cos, a);
            arena.mul(adjoint, cos)
        }
        Unary::Cos => {
            let sin = arena.unary(Unary::Sin, a);
            let d = arena.mul(adjoint, sin);
            arena.neg(d)
        }
        Unary::Tan => {
            let square = arena.square(id);
            let slope = arena.add(one, square);
            arena.mul(adjoint, slope)
        }
        Unary::Asin | Unary::Acos => {
            // (1 - a)(1 + a) keeps its digits near the ends, where 1 - a² does not.
            let (below, above) = (arena.sub(one, a), arena.add(one, a));
            let product = arena.mul(below, above);
            let root = arena.sqrt(product);
            let d = arena.div(adjoint, root);
            if op == Unary::Asin { d } else { arena.neg(d) }
        }
        Unary::Atan => {
            let square = arena.square(a);
            let below = arena.add(one, square);
            arena.div(adjoint, below)
        }
        Unary::Exp => arena.mul(adjoint, id),
        Unary::Ln => arena.div(adjoint, a),
        Unary::Log10 | Unary::Log2 => {
            let base = if op == Unary::Log10 { LN_10 } else { LN_2 };
            let base = arena.constant(base);
            let below = arena.mul(a, base);
            arena.div(adjoint, below)
        }
        Unary::Sinh => {
            let cosh = arena.unary(Unary::Cosh, a);
            arena.mul(adjoint, cosh)
        }
        Unary::Cosh => {
            let sinh = arena.unary(Unary::Sinh, a);
            arena.mul(adjoint, sinh)
        }
        Unary::Tanh => {
            // (1 - t)(1 + t) keeps its digits near the ends
            let (below, above) = (arena.sub(one, id), arena.add(one, id));
            let slope = arena.mul(below, above);
            arena.mul(adjoint, slope)
        }
        Unary::Asinh => {
            let square = arena.square(a);
            let sum = arena.add(square, one);
            let root = arena.sqrt(sum);
            arena.div(adjoint, root)
        }
        Unary::Acosh => {
            let (below, above) = (arena.sub(a, one), arena.add(a, one));
            let product = arena.mul(below, above);
            let root = arena.sqrt(product);
            arena.div(adjoint, root)
        }
        Unary::Atanh => {
            let (below, above) = (arena.sub(one, a), arena.add(one, a));
            let product = arena.mul(below, above);
            arena.div(adjoint, product)
        }
        Unary::Cbrt => {
            let three = arena.constant(3.0);
            let square = arena.square(id);
            let below = arena.mul(three, square);
            arena.div(adjoint, below)
        }
        Unary::Floor | Unary::Round | Unary::Sign | Unary::Not => arena.constant(0.0),
    }
}

/// Returns `adjoint` times the derivative of `op(a, b)` by `a`; for `a * a`, by both at once.
fn first_operand(arena: &mut Arena, op: Binary, a: ExprId, b: ExprId, adjoint: ExprId) -> ExprId {
    match op {
        Binary::Add | Binary::Sub | Binary::Remainder => adjoint,
        Binary::Mul => {
            let factor = if a == b {
                let two = arena.constant(2.0);
                arena.mul(two, a)
            } else {
                b
            };
            arena.mul(adjoint, factor)
        }
        Binary::Div => arena.div(adjoint, b),
        Binary::Pow => {
            let one = arena.constant(1.0);
            let exponent = arena.sub(b, one);
            let power = arena.pow(a, exponent);
            let slope = arena.mul(b, power);
            arena.mul(adjoint, slope)
        }
        Binary::Atan2 => {
            let slope = over_square_of_radius(arena, b, a, b);
            arena.mul(adjoint, slope)
        }
        Binary::Min
        | Binary::Max
        | Binary::Less
        | Binary::LessEqual
        | Binary::Equal
        | Binary::NotEqual
        | Binary::And
        | Binary::Or => unreachable!("min and max are choices, truth values do not depend"),
    }
}

/// Returns `adjoint` times the derivative of `op(a, b)`, whose value is `id`, by `b`.
fn second_operand(
    arena: &mut Arena,
    op: Binary,
    a: ExprId,
    b: ExprId,
    id: ExprId,
    adjoint: ExprId,
) -> ExprId {
    match op {
        Binary::Add => adjoint,
        Binary::Sub => arena.neg(adjoint),
        Binary::Mul => arena.mul(adjoint, a),
        Binary::Div => {
            let product = arena.mul(adjoint, id);
            let d = arena.div(product, b);
            arena.neg(d)
        }
        Binary::Pow => {
            let ln = arena.unary(Unary::Ln, a);
            let slope = arena.mul(id, ln);
            arena.mul(adjoint, slope)
        }
        Binary::Atan2 => {
            let slope = over_square_of_radius(arena, a, a, b);
            let d = arena.mul(adjoint, slope);
            arena.neg(d)
        }
        Binary::Remainder => {
            let quotient = arena.div(a, b);
            let times = arena.unary(Unary::Floor, quotient);
            let d = arena.mul(adjoint, times);
            arena.neg(d)
        }
        Binary::Min
        | Binary::Max
        | Binary::Less
        | Binary::LessEqual
        | Binary::Equal
        | Binary::NotEqual
        | Binary::And
        | Binary::Or => unreachable!("min and max are choices, truth values do not depend"),
    }
}

/// Returns `top / (a² + b²)`.
fn over_square_of_radius(arena: &mut Arena, top: ExprId, a: ExprId, b: ExprId) -> ExprId {
    let (a, b) = (arena.square(a), arena.square(b));
    let sum = arena.add(a, b);
    arena.div(top, sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_branch_not_taken_does_not_spoil_the_derivative() {
        let mut arena = Arena::new();
        let (x, zero) = (arena.var(Var(0)), arena.constant(0.0));
        let positive = arena.binary(Binary::Less, zero, x);
        let root = arena.sqrt(x);
        let e = arena.select(positive, root, x);
        let d = derivative(&mut arena, e, Var(0));
        assert_eq!(arena.evaluate(d, &[4.0]), 0.25);
        assert_eq!(arena.evaluate(d, &[-4.0]), 1.0);
    }
    #[test]
    fn a_sum_of_many_variables_has_simple_derivatives() {
        let mut arena = Arena::new();
        let vars: Vec<Var> = (0..100_000).map(Var).collect();
        let mut sum = arena.constant(0.0);
        for &v in &vars {
            let x = arena.var(v);
            sum = arena.add(sum, x);
        }
        let before = arena.len();
        let one = arena.constant(1.0);
        let gradient = gradient(&mut arena, sum, &vars);
        assert!(gradient.iter().all(|&d| d == one));
        assert!(arena.len() <= before + 2);
    }
    #[test]
    fn the_largest_of_many_costs_no_more_than_their_sum() {
        let mut arena = Arena::new();
        let vars: Vec<Var> = (0..5000).map(Var).collect();
        let two = arena.constant(2.0);
        let doubled = |arena: &mut Arena, v: &Var| {
            let x = arena.var(*v);
            arena.mul(two, x)
        };
        let items: Vec<ExprId> = vars.iter().map(|v| doubled(&mut arena, v)).collect();
        let all = items.into_iter().reduce(|a, b| arena.binary(Binary::Max, a, b));
        let before = arena.len();
        let gradient = gradient(&mut arena, all.expect("there are some"), &vars);
        assert!(arena.len() < 3 * before);
        // of equal ones the first counts
        let mut values: Vec<f64> = (0..5000).map(|i| f64::from(i % 70)).collect();
        for largest in [69, 4321] {
            values[largest] += (largest - 69) as f64;
            let slope = |i: usize| arena.evaluate(gradient[i], &values);
            let others = (0..5000).step_by(23).filter(|&i| i != largest);
            assert_eq!(slope(largest), 2.0);
            assert!(others.map(slope).all(|slope| slope == 0.0));
        }
    }
    #[test]
    fn values_that_share_a_variable_are_chosen_between_afterwards() {
        let mut arena = Arena::new();
        let (x, y) = (arena.var(Var(0)), arena.var(Var(1)));
        let one = arena.constant(1.0);
        let more = arena.add(x, one);
        let larger = arena.binary(Binary::Max, x, more);
        assert_eq!(derivative(&mut arena, larger, Var(0)), one);
        // the root has no slope at nothing, and is not taken
        let root = arena.sqrt(x);
        let larger = arena.binary(Binary::Max, root, y);
        let d = derivative(&mut arena, larger, Var(0));
        assert_eq!(arena.evaluate(d, &[0.0, 1.0]), 0.0);
        assert_eq!(arena.evaluate(d, &[4.0, 1.0]), 0.25);
    }
    #[test]
    fn a_deep_chain_does_not_overflow() {
        let mut arena = Arena::new();
        let x = arena.var(Var(0));
        let mut e = x;
        for _ in 0..100_000 {
            let sin = arena.unary(Unary::Sin, e);
            e = arena.add(sin, x);
        }
        let d = derivative(&mut arena, e, Var(0));
        assert!(arena.evaluate(d, &[0.1]).is_finite());
    }
}
