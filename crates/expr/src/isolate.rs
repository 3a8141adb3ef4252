//! Isolation: an equation solved for one of its variables.
//!
//! In: both sides and a variable. Out: its possible values as expressions free of it, each with the
//! conditions under which it is one. Where the variable stands in one operand only, operations are
//! peeled off from the outside; where it stands in both, or on both sides, the equation is collected
//! as a polynomial of degree one or two.
//!
//! Of the inverse of a periodic function only the principal value is given (for `sin` and `cos`, both
//! values within one turn).

use crate::arena::{Arena, ExprId, Node, Var, place};
use crate::op::{Binary, Unary};
use crate::polynomial::{self, Coefficients};
use std::f64::consts::{FRAC_PI_2, PI};

/// A condition under which a root is one. How near to the limit is near, the caller decides.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Guard {
    /// A divisor: not 0.
    NonZero(ExprId),
    /// A radicand, a distance from the end of a range: 0 or more.
    NonNegative(ExprId),
    /// The operand of a logarithm: more than 0.
    Positive(ExprId),
}

impl Guard {
    /// Returns the expression that the condition is about.
    pub fn subject(self) -> ExprId {
        match self {
            Self::NonZero(e) | Self::NonNegative(e) | Self::Positive(e) => e,
        }
    }
    /// Returns true if the condition is met by this value of its subject.
    pub fn is_met(self, subject: f64) -> bool {
        match self {
            Self::NonZero(_) => subject != 0.0,
            Self::NonNegative(_) => subject >= 0.0,
            Self::Positive(_) => subject > 0.0,
        }
    }
    fn with(self, subject: ExprId) -> Self {
        match self {
            Self::NonZero(_) => Self::NonZero(subject),
            Self::NonNegative(_) => Self::NonNegative(subject),
            Self::Positive(_) => Self::Positive(subject),
        }
    }
}

/// One value that solves an equation.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Root {
    /// The value, free of the variable solved for.
    pub value: ExprId,
    /// What must hold for it to be one, all free of the variable solved for. Conditions that always
    /// hold are left out; one that never holds is kept.
    pub guards: Vec<Guard>,
}

/// The greatest number of roots: nested absolute values double it at each level.
const MOST_ROOTS: usize = 8;

/// Solves `left = right` for `var`; of two roots the one with + comes first.
///
/// None if it cannot: the variable does not occur, or occurs in a way that has no rule here.
///
/// ```
/// use expr::{Arena, Var, isolate};
/// let mut arena = Arena::default();
/// // voltage = current * resistance, for the current
/// let [u, i, r] = [0, 1, 2].map(|v| arena.var(Var(v)));
/// let product = arena.mul(i, r);
/// let roots = isolate(&mut arena, u, product, Var(1)).expect("it is linear");
/// assert_eq!(arena.evaluate(roots[0].value, &[12.0, 0.0, 4.0]), 3.0);
/// assert_eq!(roots[0].guards, [expr::Guard::NonZero(r)]);
/// ```
pub fn isolate(arena: &mut Arena, left: ExprId, right: ExprId, var: Var) -> Option<Vec<Root>> {
    let order = arena.reachable(&[left, right]);
    let holds = occurrences(arena, &order, var);
    let dependent = |id: ExprId| holds[place(&order, id)];
    let (open, free) = match (dependent(left), dependent(right)) {
        (true, false) => (left, right),
        (false, true) => (right, left),
        (false, false) => return None,
        (true, true) => {
            let roots = collect(arena, left, right, var, Vec::new())?;
            return Some(finish(arena, var, roots));
        }
    };
    let mut roots = Vec::new();
    // The branch on top is worked on; each keeps its place, so that + roots come first.
    let mut branches = vec![Branch { open, free, guards: Vec::new() }];
    while let Some(branch) = branches.pop() {
        if roots.len() + branches.len() >= MOST_ROOTS {
            return None;
        }
        match arena.node(branch.open) {
            Node::Var(_) => roots.push(Root { value: branch.free, guards: branch.guards }),
            Node::Unary(op, a) => {
                let peeled = peel_unary(arena, op, a, branch)?;
                branches.extend(peeled.into_iter().rev());
            }
            Node::Binary(op, a, b) => {
                let peeled = match (dependent(a), dependent(b)) {
                    (true, false) => peel_first(arena, op, a, b, branch)?,
                    (false, true) => peel_second(arena, op, a, b, branch)?,
                    (true, true) if op == Binary::Mul && is_power_of(arena, a, b).is_some() => {
                        let (base, n) = is_power_of(arena, a, b)?;
                        peel_power(arena, base, n, branch)
                    }
                    (true, true) if op == Binary::Div => {
                        let Branch { free, mut guards, .. } = branch;
                        guards.push(Guard::NonZero(b));
                        let product = arena.mul(free, b);
                        roots.extend(collect(arena, a, product, var, guards)?);
                        continue;
                    }
                    _ => {
                        let Branch { open, free, guards } = branch;
                        roots.extend(collect(arena, open, free, var, guards)?);
                        continue;
                    }
                };
                branches.extend(peeled.into_iter().rev());
            }
            Node::Select { .. } => {
                let Branch { open, free, guards } = branch;
                roots.extend(collect(arena, open, free, var, guards)?);
            }
            Node::Constant(_) => return None,
        }
    }
    Some(finish(arena, var, roots))
}

/// Returns true if an expression is linear in `vars` taken together; coefficients may hold others.
pub fn is_linear_in(arena: &Arena, id: ExprId, vars: &[Var]) -> bool {
    polynomial::is_linear(arena, id, vars)
}

/// `open = free`, where only `open` holds the variable.
#[derive(Clone)]
struct Branch {
    open: ExprId,
    free: ExprId,
    guards: Vec<Guard>,
}

impl Branch {
    fn to(self, open: ExprId, free: ExprId) -> Self {
        Self { open, free, guards: self.guards }
    }
    fn guarded(mut self, guards: &[Guard]) -> Self {
        self.guards.extend(guards);
        self
    }
}

/// Tells for every node whether the variable occurs in it.
fn occurrences(arena: &Arena, order: &[ExprId], var: Var) -> Vec<bool> {
    let mut holds: Vec<bool> = Vec::with_capacity(order.len());
    for &id in order {
        let node = arena.node(id);
        let mut any = node == Node::Var(var);
        node.each_operand(|a| any |= holds[place(order, a)]);
        holds.push(any);
    }
    holds
}

/// `op(a) = free`
fn peel_unary(arena: &mut Arena, op: Unary, a: ExprId, branch: Branch) -> Option<Vec<Branch>> {
    let e = branch.free;
    Some(match op {
        Unary::Neg => vec![branch.to(a, arena.neg(e))],
        Unary::Abs => {
            let negative = arena.neg(e);
            let guard = [Guard::NonNegative(e)];
            vec![branch.clone().to(a, e).guarded(&guard), branch.to(a, negative).guarded(&guard)]
        }
        Unary::Sqrt => {
            let square = arena.square(e);
            vec![branch.to(a, square).guarded(&[Guard::NonNegative(e)])]
        }
        Unary::Exp => {
            let ln = arena.unary(Unary::Ln, e);
            vec![branch.to(a, ln).guarded(&[Guard::Positive(e)])]
        }
        Unary::Ln => vec![branch.to(a, arena.unary(Unary::Exp, e))],
        Unary::Log10 | Unary::Log2 => {
            let base = arena.constant(if op == Unary::Log10 { 10.0 } else { 2.0 });
            vec![branch.to(a, arena.pow(base, e))]
        }
        Unary::Sinh => vec![branch.to(a, arena.unary(Unary::Asinh, e))],
        Unary::Asinh => vec![branch.to(a, arena.unary(Unary::Sinh, e))],
        Unary::Cosh => {
            let one = arena.constant(1.0);
            let guard = [Guard::NonNegative(arena.sub(e, one))];
            let positive = arena.unary(Unary::Acosh, e);
            let negative = arena.neg(positive);
            vec![
                branch.clone().to(a, positive).guarded(&guard),
                branch.to(a, negative).guarded(&guard),
            ]
        }
        Unary::Acosh => {
            vec![branch.to(a, arena.unary(Unary::Cosh, e)).guarded(&[Guard::NonNegative(e)])]
        }
        Unary::Tanh => {
            let guard = Guard::Positive(below(arena, 1.0, e));
            vec![branch.to(a, arena.unary(Unary::Atanh, e)).guarded(&[guard])]
        }
        Unary::Atanh => vec![branch.to(a, arena.unary(Unary::Tanh, e))],
        Unary::Cbrt => {
            let square = arena.square(e);
            vec![branch.to(a, arena.mul(e, square))]
        }
        Unary::Sin => {
            let (angle, guard) =
                (arena.unary(Unary::Asin, e), Guard::NonNegative(below(arena, 1.0, e)));
            let half_turn = arena.constant(PI);
            let other = arena.sub(half_turn, angle);
            vec![
                branch.clone().to(a, angle).guarded(&[guard]),
                branch.to(a, other).guarded(&[guard]),
            ]
        }
        Unary::Cos => {
            let (angle, guard) =
                (arena.unary(Unary::Acos, e), Guard::NonNegative(below(arena, 1.0, e)));
            let other = arena.neg(angle);
            vec![
                branch.clone().to(a, angle).guarded(&[guard]),
                branch.to(a, other).guarded(&[guard]),
            ]
        }
        Unary::Tan => vec![branch.to(a, arena.unary(Unary::Atan, e))],
        Unary::Asin => {
            let guard = Guard::NonNegative(below(arena, FRAC_PI_2, e));
            vec![branch.to(a, arena.unary(Unary::Sin, e)).guarded(&[guard])]
        }
        Unary::Acos => {
            let half_turn = arena.constant(PI);
            let rest = arena.sub(half_turn, e);
            let guards = [Guard::NonNegative(e), Guard::NonNegative(rest)];
            vec![branch.to(a, arena.unary(Unary::Cos, e)).guarded(&guards)]
        }
        Unary::Atan => {
            let guard = Guard::Positive(below(arena, FRAC_PI_2, e));
            vec![branch.to(a, arena.unary(Unary::Tan, e)).guarded(&[guard])]
        }
        Unary::Floor | Unary::Round | Unary::Sign | Unary::Not => return None,
    })
}

/// Returns `limit - |e|`.
fn below(arena: &mut Arena, limit: f64, e: ExprId) -> ExprId {
    let size = arena.unary(Unary::Abs, e);
    let limit = arena.constant(limit);
    arena.sub(limit, size)
}

/// `op(a, b) = free`, where `a` holds the variable.
fn peel_first(
    arena: &mut Arena,
    op: Binary,
    a: ExprId,
    b: ExprId,
    branch: Branch,
) -> Option<Vec<Branch>> {
    let e = branch.free;
    Some(match op {
        Binary::Add => vec![branch.to(a, arena.sub(e, b))],
        Binary::Sub => vec![branch.to(a, arena.add(e, b))],
        Binary::Mul => vec![branch.to(a, arena.div(e, b)).guarded(&[Guard::NonZero(b)])],
        Binary::Div => vec![branch.to(a, arena.mul(e, b)).guarded(&[Guard::NonZero(b)])],
        Binary::Pow => {
            peel_power(arena, a, arena.as_constant(b).filter(|n| n.is_finite())?, branch)
        }
        Binary::Atan2
        | Binary::Min
        | Binary::Max
        | Binary::Remainder
        | Binary::Less
        | Binary::LessEqual
        | Binary::Equal
        | Binary::NotEqual
        | Binary::And
        | Binary::Or => return None,
    })
}

/// `op(a, b) = free`, where `b` holds the variable.
fn peel_second(
    arena: &mut Arena,
    op: Binary,
    a: ExprId,
    b: ExprId,
    branch: Branch,
) -> Option<Vec<Branch>> {
    let e = branch.free;
    Some(match op {
        Binary::Add => vec![branch.to(b, arena.sub(e, a))],
        Binary::Sub => vec![branch.to(b, arena.sub(a, e))],
        Binary::Mul => vec![branch.to(b, arena.div(e, a)).guarded(&[Guard::NonZero(a)])],
        Binary::Div => {
            let guards = [Guard::NonZero(e), Guard::NonZero(a)];
            vec![branch.to(b, arena.div(a, e)).guarded(&guards)]
        }
        Binary::Pow => {
            let (top, bottom) = (arena.unary(Unary::Ln, e), arena.unary(Unary::Ln, a));
            let guards = [Guard::Positive(e), Guard::Positive(a), Guard::NonZero(bottom)];
            vec![branch.to(b, arena.div(top, bottom)).guarded(&guards)]
        }
        Binary::Atan2
        | Binary::Min
        | Binary::Max
        | Binary::Remainder
        | Binary::Less
        | Binary::LessEqual
        | Binary::Equal
        | Binary::NotEqual
        | Binary::And
        | Binary::Or => return None,
    })
}

/// Returns base and exponent of the products by which the arena writes squares and cubes.
fn is_power_of(arena: &Arena, a: ExprId, b: ExprId) -> Option<(ExprId, f64)> {
    if a == b {
        return Some((a, 2.0));
    }
    let square = |base| Node::Binary(Binary::Mul, base, base);
    if arena.node(b) == square(a) {
        Some((a, 3.0))
    } else if arena.node(a) == square(b) {
        Some((b, 3.0))
    } else {
        None
    }
}

/// `base ^ n = free`, for a constant exponent other than 0.
fn peel_power(arena: &mut Arena, base: ExprId, n: f64, branch: Branch) -> Vec<Branch> {
    let e = branch.free;
    let is_whole = n == n.round();
    let is_odd = is_whole && n % 2.0 != 0.0;
    let inverse = arena.constant(1.0 / n);
    if is_odd {
        let size = arena.unary(Unary::Abs, e);
        let size = arena.pow(size, inverse);
        let sign = arena.unary(Unary::Sign, e);
        let value = arena.mul(sign, size);
        let guards: &[Guard] = if n < 0.0 { &[Guard::NonZero(e)] } else { &[] };
        return vec![branch.to(base, value).guarded(guards)];
    }
    let guard = [if n < 0.0 { Guard::Positive(e) } else { Guard::NonNegative(e) }];
    let value = arena.pow(e, inverse);
    let mut peeled = vec![branch.clone().to(base, value).guarded(&guard)];
    if is_whole {
        let negative = arena.neg(value);
        peeled.push(branch.to(base, negative).guarded(&guard));
    }
    peeled
}

/// Solves an equation that is a polynomial of degree one or two in the variable.
fn collect(
    arena: &mut Arena,
    left: ExprId,
    right: ExprId,
    var: Var,
    mut guards: Vec<Guard>,
) -> Option<Vec<Root>> {
    let coefficients = polynomial::difference(arena, left, right, var)?;
    match coefficients {
        Coefficients::Constant(_) => None,
        Coefficients::Linear([c, b]) => {
            guards.push(Guard::NonZero(b));
            let above = arena.neg(c);
            Some(vec![Root { value: arena.div(above, b), guards }])
        }
        Coefficients::Quadratic(c) => Some(solve_quadratic(arena, c, guards)),
    }
}

/// Solves `a x² + b x + c = 0`, without cancellation in either root.
///
/// **Source:** Press et al., *Numerical Recipes*, §5.6: of -b ± √d the sum that does not cancel is
/// taken, and the other root is had from the product of the roots, c / a.
fn solve_quadratic(arena: &mut Arena, [c, b, a]: [ExprId; 3], guards: Vec<Guard>) -> Vec<Root> {
    let (two, four, zero) = (arena.constant(2.0), arena.constant(4.0), arena.constant(0.0));
    let product = arena.mul(a, c);
    let product = arena.mul(four, product);
    let square = arena.square(b);
    let discriminant = arena.sub(square, product);
    let root = arena.sqrt(discriminant);
    let (twice_a, twice_c) = (arena.mul(two, a), arena.mul(two, c));
    let mut guards = guards;
    guards.extend([Guard::NonZero(a), Guard::NonNegative(discriminant)]);

    let rising = arena.sub(root, b);
    let sum = arena.add(root, b);
    let plus_by_sum = arena.div(rising, twice_a);
    let quotient = arena.div(twice_c, sum);
    let plus_by_product = arena.neg(quotient);
    let b_is_positive = arena.binary(Binary::Less, zero, b);
    let plus = arena.select(b_is_positive, plus_by_product, plus_by_sum);

    let quotient = arena.div(sum, twice_a);
    let minus_by_sum = arena.neg(quotient);
    let minus_by_product = arena.div(twice_c, rising);
    let b_is_negative = arena.binary(Binary::Less, b, zero);
    let minus = arena.select(b_is_negative, minus_by_product, minus_by_sum);
    [plus, minus].into_iter().map(|value| Root { value, guards: guards.clone() }).collect()
}

/// Frees the guards of the variable and drops those that always hold.
fn finish(arena: &mut Arena, var: Var, roots: Vec<Root>) -> Vec<Root> {
    let mut finished = Vec::with_capacity(roots.len());
    for root in roots {
        let mut guards: Vec<Guard> = Vec::new();
        for guard in root.guards {
            let subject = arena.substitute(guard.subject(), &|v| (v == var).then_some(root.value));
            let guard = guard.with(subject);
            let always = arena.as_constant(subject).is_some_and(|x| guard.is_met(x));
            if !always && !guards.contains(&guard) {
                guards.push(guard);
            }
        }
        finished.push(Root { value: root.value, guards });
    }
    finished
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: Var = Var(0);

    /// Solves `left = right` for x and returns the roots whose guards are met.
    fn solve(arena: &mut Arena, left: ExprId, right: ExprId, values: &[f64]) -> Vec<f64> {
        let roots = isolate(arena, left, right, X).expect("there is a rule");
        let is_met = |guard: &Guard| guard.is_met(arena.evaluate(guard.subject(), values));
        roots
            .iter()
            .filter(|root| root.guards.iter().all(is_met))
            .map(|root| arena.evaluate(root.value, values))
            .collect()
    }
    fn variables(arena: &mut Arena) -> [ExprId; 4] {
        [0, 1, 2, 3].map(|v| arena.var(Var(v)))
    }

    #[test]
    fn what_does_not_occur_or_cancels_is_not_solved_for() {
        let mut arena = Arena::new();
        let [x, a, b, _] = variables(&mut arena);
        assert_eq!(isolate(&mut arena, a, b, X), None);
        let (left, right) = (arena.add(x, a), arena.add(x, b));
        assert_eq!(isolate(&mut arena, left, right, X), None);
    }
    #[test]
    fn what_has_no_rule_is_refused() {
        let mut arena = Arena::new();
        let [x, a, ..] = variables(&mut arena);
        let (floor, sin) = (arena.unary(Unary::Floor, x), arena.unary(Unary::Sin, x));
        let sum = arena.add(sin, x);
        let least = arena.binary(Binary::Min, x, a);
        for e in [floor, sum, least] {
            assert_eq!(isolate(&mut arena, e, a, X), None);
        }
    }
    #[test]
    fn a_linear_equation_gathers_the_variable_from_both_sides() {
        let mut arena = Arena::new();
        let [x, a, b, _] = variables(&mut arena);
        // a x + 3 = b - x
        let product = arena.mul(a, x);
        let three = arena.constant(3.0);
        let (left, right) = (arena.add(product, three), arena.sub(b, x));
        assert_eq!(solve(&mut arena, left, right, &[0.0, 4.0, 13.0, 0.0]), [2.0]);
        // The coefficient is a + 1: at -1 there is no root.
        assert_eq!(solve(&mut arena, left, right, &[0.0, -1.0, 13.0, 0.0]), []);
    }
    #[test]
    fn both_roots_of_a_quadratic_keep_their_digits() {
        let mut arena = Arena::new();
        let [x, b, c, _] = variables(&mut arena);
        let (square, product) = (arena.square(x), arena.mul(b, x));
        let sum = arena.add(square, product);
        let left = arena.add(sum, c);
        let zero = arena.constant(0.0);
        assert_eq!(solve(&mut arena, left, zero, &[0.0, -5.0, 6.0]), [3.0, 2.0]);
        assert_eq!(solve(&mut arena, left, zero, &[0.0, 5.0, 6.0]), [-2.0, -3.0]);
        assert_eq!(solve(&mut arena, left, zero, &[0.0, 0.0, -4.0]), [2.0, -2.0]);
        assert_eq!(solve(&mut arena, left, zero, &[0.0, 0.0, 0.0]), [0.0, 0.0]);
        assert_eq!(solve(&mut arena, left, zero, &[0.0, 1.0, 1.0]), []);
        let small = solve(&mut arena, left, zero, &[0.0, 1e9, 1.0]);
        assert_eq!(small, [-1e-9, -1e9]);
    }
    #[test]
    fn a_distance_is_solved_by_peeling() {
        let mut arena = Arena::new();
        let [x, a, dy, d] = variables(&mut arena);
        let dx = arena.sub(x, a);
        let (dx, dy) = (arena.square(dx), arena.square(dy));
        let sum = arena.add(dx, dy);
        let length = arena.sqrt(sum);
        assert_eq!(solve(&mut arena, length, d, &[0.0, 10.0, 3.0, 5.0]), [14.0, 6.0]);
        assert_eq!(solve(&mut arena, length, d, &[0.0, 10.0, 6.0, 5.0]), []);
        assert_eq!(solve(&mut arena, length, d, &[0.0, 10.0, 3.0, -5.0]), []);
    }
    #[test]
    fn parallel_resistors_are_solved_for_one_of_them() {
        let mut arena = Arena::new();
        let [x, r, whole, _] = variables(&mut arena);
        let (product, sum) = (arena.mul(x, r), arena.add(x, r));
        let parallel = arena.div(product, sum);
        assert_eq!(solve(&mut arena, whole, parallel, &[0.0, 6.0, 2.0]), [3.0]);
        assert_eq!(solve(&mut arena, whole, parallel, &[0.0, 2.0, 2.0]), []);
    }
    #[test]
    fn cubes_have_one_root_and_absolute_values_two() {
        let mut arena = Arena::new();
        let [x, a, ..] = variables(&mut arena);
        let three = arena.constant(3.0);
        let cube = arena.pow(x, three);
        let root = solve(&mut arena, cube, a, &[0.0, -8.0]);
        assert!(root.len() == 1 && (root[0] + 2.0).abs() < 1e-15, "{root:?}");
        let size = arena.unary(Unary::Abs, x);
        assert_eq!(solve(&mut arena, size, a, &[0.0, 7.0]), [7.0, -7.0]);
        assert_eq!(solve(&mut arena, size, a, &[0.0, -7.0]), []);
    }
    #[test]
    fn a_choice_by_something_else_stays_linear() {
        let mut arena = Arena::new();
        let [x, a, b, _] = variables(&mut arena);
        let two = arena.constant(2.0);
        let doubled = arena.mul(two, x);
        let choice = arena.select(a, doubled, x);
        assert!(is_linear_in(&arena, choice, &[X]));
        assert!(!is_linear_in(&arena, choice, &[X, Var(1)]));
        assert_eq!(solve(&mut arena, choice, b, &[0.0, 1.0, 8.0]), [4.0]);
        assert_eq!(solve(&mut arena, choice, b, &[0.0, 0.0, 8.0]), [8.0]);
    }
    #[test]
    fn linear_together_is_more_than_linear_in_each() {
        let mut arena = Arena::new();
        let [x, a, b, _] = variables(&mut arena);
        let product = arena.mul(x, a);
        let e = arena.add(product, b);
        assert!(is_linear_in(&arena, e, &[X, Var(2)]));
        assert!(!is_linear_in(&arena, e, &[X, Var(1)]));
        assert!(is_linear_in(&arena, e, &[]));
    }
    #[test]
    fn a_deep_sum_is_peeled() {
        let mut arena = Arena::new();
        let [x, a, ..] = variables(&mut arena);
        let mut e = x;
        for i in 0..100_000 {
            let term = if i % 2 == 0 { a } else { arena.constant(1.0) };
            e = arena.add(e, term);
        }
        let zero = arena.constant(0.0);
        assert_eq!(solve(&mut arena, e, zero, &[0.0, 2.0]), [-150_000.0]);
    }
}
