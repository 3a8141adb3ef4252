//! Conics: an equation as a polynomial of the second degree in two variables, around where they are.
//!
//! In: both sides and two variables. Out: with `x + u` and `y + v` put in, the coefficients of `1`, `u`, `v`,
//! `u²`, `u v` and `v²` in what is zero where the equation holds, as expressions of all variables: a circle, a
//! line, a product. A root, an angle or a quotient is taken off first where the other side is free of the two;
//! what that asks for besides is a guard. None where the equation is no such polynomial by its form.

use crate::arena::{Arena, ExprId, Node, Var, place};
use crate::op::{Binary, Unary};

/// A curve of the second degree or a line in two variables, around where they are.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Conic {
    /// The coefficients of `1`, `u`, `v`, `u²`, `u v` and `v²`: zero is where the equation holds.
    pub coefficients: [ExprId; 6],
    /// What is not negative where the equation holds: expressions of all variables.
    pub guards: Vec<ExprId>,
}

impl Conic {
    /// Returns true if it is a line.
    pub fn is_line(&self, arena: &Arena) -> bool {
        self.coefficients[3..].iter().all(|&c| arena.as_constant(c) == Some(0.0))
    }
    /// Returns true if it is a circle or a line.
    pub fn is_round(&self, arena: &Arena) -> bool {
        let [_, _, _, uu, uv, vv] = self.coefficients;
        uu == vv && arena.as_constant(uv) == Some(0.0)
    }
}

type Coefficients = [ExprId; 6];

/// Finds what `left = right` says of two variables, if that is of the second degree in them.
///
/// The sides are expressions of `from`; what is found is one of `into`, every variable as `name` has it there.
///
/// ```
/// use expr::{Arena, ExprId, Var, conic};
/// let mut from = Arena::default();
/// // sqrt(x² + y²) = r, around (3, 0) where r is 5: (3 + u)² + v² - 5²
/// let [x, y, r] = [0, 1, 2].map(|v| from.var(Var(v)));
/// let squares = [x, y].map(|a| from.square(a));
/// let sum = from.add(squares[0], squares[1]);
/// let length = from.sqrt(sum);
/// let mut into = Arena::default();
/// let circle = conic(&from, [length, r], [Var(0), Var(1)], &mut into, &|v| v).expect("it is one");
/// let at = |e: ExprId| into.evaluate(e, &[3.0, 0.0, 5.0]);
/// assert_eq!(circle.coefficients.map(at), [-16.0, 6.0, 0.0, 1.0, 0.0, 1.0]);
/// ```
pub fn conic(
    from: &Arena,
    [left, right]: [ExprId; 2],
    vars: [Var; 2],
    into: &mut Arena,
    name: &dyn Fn(Var) -> Var,
) -> Option<Conic> {
    let order = from.reachable(&[left, right]);
    let free = Vec::with_capacity(order.len());
    let [zero, one] = [0.0, 1.0].map(|c| into.constant(c));
    let mut reading = Reading { from, order, free, into, zero, one };
    reading.copy_free(vars, name);
    let peeled = reading.peel(left, right);
    let known = reading.polynomials(vars, name);
    let sum = |reading: &mut Reading<'_>, terms: &[Term; 2]| {
        let mut sum = [zero; 6];
        for &Term { node, factor } in terms {
            if factor != zero {
                let polynomial = known[place(&reading.order, node)]?;
                for (sum, c) in sum.iter_mut().zip(polynomial) {
                    let product = reading.into.mul(factor, c);
                    *sum = reading.into.add(*sum, product);
                }
            }
        }
        Some(sum)
    };
    let mut coefficients = sum(&mut reading, &peeled.terms)?;
    let mut guards = peeled.guards;
    if let Some(along) = &peeled.along {
        guards.push(sum(&mut reading, along)?[0]);
    }
    coefficients[0] = into.sub(coefficients[0], peeled.free);
    Some(Conic { coefficients, guards })
}

/// An equation that is being read.
struct Reading<'a> {
    from: &'a Arena,
    /// The nodes of both sides.
    order: Vec<ExprId>,
    /// Of every node the copy, where it is free of the two variables.
    free: Vec<Option<ExprId>>,
    into: &'a mut Arena,
    zero: ExprId,
    one: ExprId,
}

/// A node that is not free of the two variables, and a factor that is.
#[derive(Clone, Copy)]
struct Term {
    node: ExprId,
    factor: ExprId,
}

/// What is left of an equation: a sum that is equal to something free of the two variables.
struct Peeled {
    terms: [Term; 2],
    free: ExprId,
    guards: Vec<ExprId>,
    /// A sum that is not negative where the equation holds.
    along: Option<[Term; 2]>,
}

impl Reading<'_> {
    /// Copies what is free of the two variables.
    fn copy_free(&mut self, vars: [Var; 2], name: &dyn Fn(Var) -> Var) {
        let Self { from, order, free, into, zero, .. } = self;
        for &id in order.iter() {
            let node = from.node(id);
            let of = |a: ExprId| free[place(order, a)];
            let mut is_free = !matches!(node, Node::Var(var) if vars.contains(&var));
            node.each_operand(|a| is_free &= of(a).is_some());
            let of = |a: ExprId| of(a).unwrap_or(*zero);
            let copy = is_free.then(|| match node {
                Node::Constant(bits) => into.constant(f64::from_bits(bits)),
                Node::Var(var) => into.var(name(var)),
                Node::Unary(op, a) => into.unary(op, of(a)),
                Node::Binary(op, a, b) => into.binary(op, of(a), of(b)),
                Node::Select { condition, then, otherwise } => {
                    into.select(of(condition), of(then), of(otherwise))
                }
            });
            free.push(copy);
        }
    }
    fn of(&self, id: ExprId) -> Option<ExprId> {
        self.free[place(&self.order, id)]
    }
    fn one_term(&self, node: ExprId) -> [Term; 2] {
        [Term { node, factor: self.one }, Term { node, factor: self.zero }]
    }

    /// Takes off the outermost operations, as long as one side is free of the variables.
    fn peel(&mut self, left: ExprId, right: ExprId) -> Peeled {
        let (mut open, mut free) = match (self.of(left), self.of(right)) {
            (_, Some(free)) => (left, free),
            (Some(free), None) => (right, free),
            (None, None) => return self.both(left, right),
        };
        let mut guards = Vec::new();
        loop {
            let next = match self.from.node(open) {
                Node::Unary(Unary::Neg, a) => Some((a, self.into.neg(free))),
                Node::Unary(Unary::Sqrt, a) => {
                    guards.push(free);
                    open = a;
                    free = self.into.square(free);
                    None
                }
                Node::Binary(Binary::Atan2, a, b) => {
                    // the vector (b, a) lies in this direction, and not the other way
                    let [sin, cos] = [Unary::Sin, Unary::Cos].map(|op| self.into.unary(op, free));
                    let minus = self.into.neg(sin);
                    let terms = [(a, cos), (b, minus), (a, sin), (b, cos)];
                    let [up, across, rise, run] = terms.map(|(node, factor)| Term { node, factor });
                    let along = Some([rise, run]);
                    return Peeled { terms: [up, across], free: self.zero, guards, along };
                }
                // zero where what is divided is
                Node::Binary(Binary::Div, a, _) if free == self.zero => Some((a, free)),
                Node::Binary(op, a, b) => match (self.of(a), self.of(b)) {
                    (None, Some(b)) => self.without_second(op, b, free).map(|free| (a, free)),
                    (Some(a), None) => self.without_first(op, a, free).map(|free| (b, free)),
                    (None, None) | (Some(_), Some(_)) => None,
                },
                Node::Constant(_) | Node::Var(_) | Node::Unary(..) | Node::Select { .. } => None,
            };
            match next {
                Some(next) => (open, free) = next,
                None => return Peeled { terms: self.one_term(open), free, guards, along: None },
            }
        }
    }
    /// Both sides depend on the variables: their difference, or that of what they are roots of.
    fn both(&mut self, left: ExprId, right: ExprId) -> Peeled {
        let sides = match [left, right].map(|side| self.from.node(side)) {
            [Node::Unary(Unary::Sqrt, a), Node::Unary(Unary::Sqrt, b)] => [a, b],
            _ => [left, right],
        };
        let minus = self.into.constant(-1.0);
        let [left, right] = sides;
        let terms = [Term { node: left, factor: self.one }, Term { node: right, factor: minus }];
        Peeled { terms, free: self.zero, guards: Vec::new(), along: None }
    }
    /// Returns what the first operand equals, where the second is free.
    fn without_second(&mut self, op: Binary, b: ExprId, free: ExprId) -> Option<ExprId> {
        match op {
            Binary::Add => Some(self.into.sub(free, b)),
            Binary::Sub => Some(self.into.add(free, b)),
            Binary::Mul => Some(self.into.div(free, b)),
            Binary::Div => Some(self.into.mul(free, b)),
            _ => None,
        }
    }
    /// Returns what the second operand equals, where the first is free.
    fn without_first(&mut self, op: Binary, a: ExprId, free: ExprId) -> Option<ExprId> {
        match op {
            Binary::Add => Some(self.into.sub(free, a)),
            Binary::Sub => Some(self.into.sub(a, free)),
            Binary::Mul => Some(self.into.div(free, a)),
            _ => None,
        }
    }

    /// Finds what every node is as a polynomial, if it is one of the second degree.
    fn polynomials(
        &mut self,
        vars: [Var; 2],
        name: &dyn Fn(Var) -> Var,
    ) -> Vec<Option<Coefficients>> {
        let (zero, one) = (self.zero, self.one);
        let mut known: Vec<Option<Coefficients>> = Vec::with_capacity(self.order.len());
        for i in 0..self.order.len() {
            let of = |a: ExprId| known[place(&self.order, a)];
            let polynomial = match (self.free[i], self.from.node(self.order[i])) {
                (Some(copy), _) => Some([copy, zero, zero, zero, zero, zero]),
                (None, Node::Var(var)) => {
                    let own = self.into.var(name(var));
                    let slopes = if var == vars[0] { [one, zero] } else { [zero, one] };
                    Some([own, slopes[0], slopes[1], zero, zero, zero])
                }
                (None, Node::Unary(Unary::Neg, a)) => of(a).map(|a| a.map(|c| self.into.neg(c))),
                (None, Node::Binary(op, a, b)) => {
                    of(a).zip(of(b)).and_then(|(a, b)| self.combine(op, a, b))
                }
                (None, Node::Constant(_) | Node::Unary(..) | Node::Select { .. }) => None,
            };
            known.push(polynomial);
        }
        known
    }
    fn degree(&self, all: &Coefficients) -> u8 {
        match all {
            [_, _, _, second @ ..] if second.iter().any(|&c| c != self.zero) => 2,
            [_, first @ ..] if first.iter().any(|&c| c != self.zero) => 1,
            _ => 0,
        }
    }
    /// Computes with polynomials.
    fn combine(&mut self, op: Binary, a: Coefficients, b: Coefficients) -> Option<Coefficients> {
        match (op, self.degree(&a), self.degree(&b)) {
            (Binary::Add | Binary::Sub, ..) => {
                let mut sum = a;
                for (a, b) in sum.iter_mut().zip(b) {
                    *a = self.into.binary(op, *a, b);
                }
                Some(sum)
            }
            (Binary::Mul, 0, _) => Some(b.map(|b| self.into.mul(a[0], b))),
            (Binary::Mul | Binary::Div, _, 0) => Some(a.map(|a| self.into.binary(op, a, b[0]))),
            (Binary::Mul, 1, 1) => {
                let [u, v, uv] = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| {
                    let [first, second] = [(i, j), (j, i)].map(|(i, j)| self.into.mul(a[i], b[j]));
                    if first == second {
                        let two = self.into.constant(2.0);
                        return self.into.mul(two, first);
                    }
                    self.into.add(first, second)
                });
                let [one, uu, vv] = [0, 1, 2].map(|i| self.into.mul(a[i], b[i]));
                Some([one, u, v, uu, uv, vv])
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const XY: [Var; 2] = [Var(0), Var(1)];

    /// An arena with `x`, `y` and three numbers that are known.
    fn arena() -> (Arena, [ExprId; 5]) {
        let mut arena = Arena::default();
        let vars = [0, 1, 2, 3, 4].map(|v| arena.var(Var(v)));
        (arena, vars)
    }
    fn found(from: &Arena, left: ExprId, right: ExprId) -> (Arena, Option<Conic>) {
        let mut into = Arena::new();
        let found = conic(from, [left, right], XY, &mut into, &|v| v);
        (into, found)
    }
    fn values(arena: &Arena, found: &Conic, at: &[f64]) -> [f64; 6] {
        found.coefficients.map(|c| arena.evaluate(c, at))
    }

    #[test]
    fn what_is_no_polynomial_of_the_second_degree_is_told() {
        let (mut arena, [x, y, a, ..]) = arena();
        let squares = [x, y].map(|e| arena.square(e));
        let cube = arena.mul(squares[0], x);
        assert_eq!(found(&arena, cube, a).1, None);
        // a distance that is one of the two
        let sum = arena.add(squares[0], squares[1]);
        let root = arena.sqrt(sum);
        assert_eq!(found(&arena, root, x).1, None);
        let sine = arena.unary(Unary::Sin, x);
        assert_eq!(found(&arena, sine, y).1, None);
    }

    #[test]
    fn lines_and_circles_are_told_by_their_form() {
        let (mut arena, [x, y, a, ..]) = arena();
        let two = arena.constant(2.0);
        let squares = [x, y].map(|e| arena.square(e));
        let product = arena.mul(x, y);
        let doubled = arena.mul(two, squares[1]);
        let [circle, ellipse] = [squares[1], doubled].map(|s| arena.add(squares[0], s));
        let sum = arena.add(x, y);
        let mut into = Arena::new();
        let [circle, ellipse, product, line] = [circle, ellipse, product, sum].map(|left| {
            conic(&arena, [left, a], XY, &mut into, &|v| v).expect("it is of the second degree")
        });
        let arena = into;
        assert!(line.is_line(&arena) && line.is_round(&arena));
        assert!(circle.is_round(&arena) && !circle.is_line(&arena));
        assert!(!product.is_line(&arena) && !product.is_round(&arena));
        assert!(!ellipse.is_line(&arena) && !ellipse.is_round(&arena));
    }

    #[test]
    fn a_distance_is_a_circle_whatever_stands_around_it() {
        // 3 - 2 sqrt((a - x)² + (y - b)²) = r: around (a, b), with radius (3 - r) / 2
        let (mut arena, [x, y, a, b, r]) = arena();
        let (across, up) = (arena.sub(a, x), arena.sub(y, b));
        let squares = [across, up].map(|e| arena.square(e));
        let sum = arena.add(squares[0], squares[1]);
        let root = arena.sqrt(sum);
        let (two, three) = (arena.constant(2.0), arena.constant(3.0));
        let scaled = arena.mul(two, root);
        let left = arena.sub(three, scaled);
        let (arena, found) = found(&arena, left, r);
        let found = found.expect("it is a circle");
        // from (5, 2), with the centre (1, -1) and the radius 4: 25 - 16 + 2 (4 u + 3 v) + u² + v²
        let at = [5.0, 2.0, 1.0, -1.0, -5.0];
        assert_eq!(values(&arena, &found, &at), [9.0, 8.0, 6.0, 1.0, 0.0, 1.0]);
        assert_eq!(found.guards.iter().map(|&g| arena.evaluate(g, &at)).collect::<Vec<_>>(), [4.0]);
    }

    #[test]
    fn equal_distances_are_a_line() {
        // as far from (a, 0) as from (0, b)
        let (mut arena, [x, y, a, b, _]) = arena();
        let (across, up) = (arena.sub(x, a), arena.sub(y, b));
        let mut far = |across: ExprId, up: ExprId| {
            let squares = [across, up].map(|e| arena.square(e));
            let sum = arena.add(squares[0], squares[1]);
            arena.sqrt(sum)
        };
        let (left, right) = (far(across, y), far(x, up));
        let (arena, found) = found(&arena, left, right);
        let found = found.expect("it is a line");
        // from (1, 1), of (2, 0) and (0, 4): (1 - u)² + (1 + v)² - (1 + u)² - (3 - v)²
        let at = [1.0, 1.0, 2.0, 4.0, 0.0];
        assert_eq!(values(&arena, &found, &at), [-8.0, -4.0, 8.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn a_direction_is_a_line_with_an_end() {
        // atan2(y - b, x - a) = r
        let (mut arena, [x, y, a, b, r]) = arena();
        let (across, up) = (arena.sub(x, a), arena.sub(y, b));
        let angle = arena.binary(Binary::Atan2, up, across);
        let (arena, found) = found(&arena, angle, r);
        let found = found.expect("it is a line");
        let at = |x: f64| [x, 7.0, 1.0, 2.0, 0.0];
        assert_eq!(values(&arena, &found, &at(3.0)), [5.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
        let along = |x: f64| arena.evaluate(found.guards[0], &at(x));
        assert_eq!((along(3.0), along(0.0)), (2.0, -1.0));
    }
}
