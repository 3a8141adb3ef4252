//! The arena: expressions as nodes, each stored once, operands before their users.
//!
//! In: operations on expressions already there. Out: the id of the one node that means it. Building
//! folds constants and drops operations whose result is the same number for all finite operands;
//! nothing is reordered, collected or distributed, so that what is built computes what was written.

use crate::op::{Binary, Unary, number_from_truth};
use base::{Id, Mixer};
use indexmap::IndexSet;
use std::collections::BTreeSet;
use std::hash::{BuildHasherDefault, Hash, Hasher};

base::define_id!(ExprId, "e", "An expression in an arena.");
base::define_id!(Var, "v", "A number supplied from outside: `values[var.index()]`.");

/// One operation, with its operands by id.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Node {
    /// A number, by its bits; never -0, one NaN.
    Constant(u64),
    /// A number supplied from outside.
    Var(Var),
    /// An operation with one operand.
    Unary(Unary, ExprId),
    /// An operation with two operands.
    Binary(Binary, ExprId, ExprId),
    /// One of two expressions; the other may be undefined.
    Select {
        /// Which: 0 means `otherwise`.
        condition: ExprId,
        /// The value if the condition is not 0.
        then: ExprId,
        /// The value if the condition is 0.
        otherwise: ExprId,
    },
}

impl Node {
    /// Calls `visit` with every operand, first to last.
    #[inline]
    pub fn each_operand(self, mut visit: impl FnMut(ExprId)) {
        match self {
            Self::Constant(_) | Self::Var(_) => {}
            Self::Unary(_, a) => visit(a),
            Self::Binary(_, a, b) => {
                visit(a);
                visit(b);
            }
            Self::Select { condition, then, otherwise } => {
                visit(condition);
                visit(then);
                visit(otherwise);
            }
        }
    }
}

/// Up to sixty-four times as many nodes are marked in place.
const MARKS: usize = 32;

/// A set in order of insertion, without random state.
type Set<T> = IndexSet<T, BuildHasherDefault<Mixer>>;

/// Expressions, each stored once.
///
/// ```
/// use expr::{Arena, Var};
/// let mut arena = Arena::default();
/// let (x, two) = (arena.var(Var(0)), arena.constant(2.0));
/// let e = arena.mul(two, x);
/// assert_eq!(arena.evaluate(e, &[21.0]), 42.0);
/// assert_eq!(arena.mul(x, two), e); // stored once
/// ```
#[derive(Clone, Default)]
pub struct Arena {
    nodes: Set<Node>,
}

impl Arena {
    /// Makes an empty arena.
    pub fn new() -> Self {
        Self::default()
    }
    /// Makes an empty arena with room for so many nodes.
    pub fn for_nodes(count: usize) -> Self {
        Self { nodes: Set::with_capacity_and_hasher(count, BuildHasherDefault::default()) }
    }
    /// Returns the number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }
    /// Returns true if there is no node.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
    /// Returns every operation, in the order of their ids.
    pub fn nodes(&self) -> impl Iterator<Item = Node> + '_ {
        self.nodes.iter().copied()
    }
    /// Returns the operation that `id` names.
    #[inline]
    pub fn node(&self, id: ExprId) -> Node {
        self.nodes[id.index()]
    }
    /// Returns the number that `id` is, if it is a constant.
    pub fn as_constant(&self, id: ExprId) -> Option<f64> {
        match self.node(id) {
            Node::Constant(bits) => Some(f64::from_bits(bits)),
            Node::Var(_) | Node::Unary(..) | Node::Binary(..) | Node::Select { .. } => None,
        }
    }
    fn intern(&mut self, node: Node) -> ExprId {
        ExprId::from_index(self.nodes.insert_full(node).0)
    }
    fn is(&self, id: ExprId, number: f64) -> bool {
        self.as_constant(id) == Some(number)
    }
    /// Returns the operand of a negation.
    fn negated(&self, id: ExprId) -> Option<ExprId> {
        if let Node::Unary(Unary::Neg, a) = self.node(id) { Some(a) } else { None }
    }
    /// Returns true if the expression is always 0 or 1.
    fn is_truth(&self, id: ExprId) -> bool {
        match self.node(id) {
            Node::Constant(_) => self.is(id, 0.0) || self.is(id, 1.0),
            Node::Unary(op, _) => op == Unary::Not,
            Node::Binary(op, ..) => op.is_truth(),
            Node::Var(_) | Node::Select { .. } => false,
        }
    }

    /// Makes a number. -0 becomes 0, every NaN the same one.
    pub fn constant(&mut self, x: f64) -> ExprId {
        let x = if x == 0.0 {
            0.0
        } else if x.is_nan() {
            f64::NAN
        } else {
            x
        };
        self.intern(Node::Constant(x.to_bits()))
    }
    /// Makes the number supplied from outside.
    pub fn var(&mut self, var: Var) -> ExprId {
        self.intern(Node::Var(var))
    }
    /// Makes an operation with one operand.
    pub fn unary(&mut self, op: Unary, a: ExprId) -> ExprId {
        if let Some(x) = self.as_constant(a) {
            return self.constant(op.apply(x));
        }
        match (op, self.node(a)) {
            (Unary::Neg, Node::Unary(Unary::Neg, b)) => b,
            (Unary::Neg, Node::Binary(Binary::Sub, b, c)) => self.sub(c, b),
            (Unary::Abs, Node::Unary(Unary::Neg, b)) => self.unary(Unary::Abs, b),
            (Unary::Abs, Node::Unary(Unary::Abs | Unary::Sqrt, _)) => a,
            (Unary::Floor | Unary::Round, Node::Unary(Unary::Floor | Unary::Round, _)) => a,
            (Unary::Not, Node::Unary(Unary::Not, b)) if self.is_truth(b) => b,
            _ => self.intern(Node::Unary(op, a)),
        }
    }
    /// Makes an operation with two operands.
    pub fn binary(&mut self, op: Binary, a: ExprId, b: ExprId) -> ExprId {
        if let (Some(x), Some(y)) = (self.as_constant(a), self.as_constant(b)) {
            return self.constant(op.apply(x, y));
        }
        match op {
            Binary::Add => self.make_sum(a, b),
            Binary::Sub => self.make_difference(a, b),
            Binary::Mul => self.make_product(a, b),
            Binary::Div => self.make_quotient(a, b),
            Binary::Pow => self.make_power(a, b),
            Binary::Min | Binary::Max if a == b => a,
            Binary::Less | Binary::NotEqual if a == b => self.constant(0.0),
            Binary::LessEqual | Binary::Equal if a == b => self.constant(1.0),
            Binary::And | Binary::Or => self.make_junction(op, a, b),
            Binary::Equal | Binary::NotEqual => self.intern(Node::Binary(op, a.min(b), a.max(b))),
            Binary::Atan2
            | Binary::Min
            | Binary::Max
            | Binary::Remainder
            | Binary::Less
            | Binary::LessEqual => self.intern(Node::Binary(op, a, b)),
        }
    }
    /// Makes a choice: `a` where the condition is not 0, else `b`.
    pub fn select(&mut self, condition: ExprId, a: ExprId, b: ExprId) -> ExprId {
        if let Some(x) = self.as_constant(condition) {
            return if x != 0.0 { a } else { b };
        }
        if a == b {
            return a;
        }
        if let Node::Unary(Unary::Not, c) = self.node(condition) {
            return self.select(c, b, a);
        }
        self.intern(Node::Select { condition, then: a, otherwise: b })
    }

    /// Makes `a + b`.
    pub fn add(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.binary(Binary::Add, a, b)
    }
    /// Makes `a - b`.
    pub fn sub(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.binary(Binary::Sub, a, b)
    }
    /// Makes `a * b`.
    pub fn mul(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.binary(Binary::Mul, a, b)
    }
    /// Makes `a / b`.
    pub fn div(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.binary(Binary::Div, a, b)
    }
    /// Makes `a ^ b`.
    pub fn pow(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.binary(Binary::Pow, a, b)
    }
    /// Makes `-a`.
    pub fn neg(&mut self, a: ExprId) -> ExprId {
        self.unary(Unary::Neg, a)
    }
    /// Makes the square root of `a`.
    pub fn sqrt(&mut self, a: ExprId) -> ExprId {
        self.unary(Unary::Sqrt, a)
    }
    /// Makes `a * a`.
    pub fn square(&mut self, a: ExprId) -> ExprId {
        self.mul(a, a)
    }

    fn make_sum(&mut self, a: ExprId, b: ExprId) -> ExprId {
        if self.is(a, 0.0) {
            b
        } else if self.is(b, 0.0) {
            a
        } else if let Some(b) = self.negated(b) {
            self.sub(a, b)
        } else if let Some(a) = self.negated(a) {
            self.sub(b, a)
        } else {
            self.intern(Node::Binary(Binary::Add, a.min(b), a.max(b)))
        }
    }
    fn make_difference(&mut self, a: ExprId, b: ExprId) -> ExprId {
        if a == b {
            self.constant(0.0)
        } else if self.is(b, 0.0) {
            a
        } else if self.is(a, 0.0) {
            self.neg(b)
        } else if let Some(b) = self.negated(b) {
            self.add(a, b)
        } else {
            self.intern(Node::Binary(Binary::Sub, a, b))
        }
    }
    /// Signs move outward, or into a constant: both leave the bits of the result alone.
    fn make_product(&mut self, a: ExprId, b: ExprId) -> ExprId {
        let (a, b) = (a.min(b), a.max(b));
        for (x, y) in [(a, b), (b, a)] {
            let Some(number) = self.as_constant(x) else { continue };
            if number == 0.0 {
                return x;
            } else if number == 1.0 {
                return y;
            } else if number == -1.0 {
                return self.neg(y);
            } else if let Some(y) = self.negated(y) {
                let x = self.constant(-number);
                return self.mul(x, y);
            }
        }
        if let Some(a) = self.negated(a) {
            let product = self.mul(a, b);
            self.neg(product)
        } else if let Some(b) = self.negated(b) {
            let product = self.mul(a, b);
            self.neg(product)
        } else {
            self.intern(Node::Binary(Binary::Mul, a, b))
        }
    }
    fn make_quotient(&mut self, a: ExprId, b: ExprId) -> ExprId {
        if self.is(b, 1.0) || (self.is(a, 0.0) && !self.is(b, 0.0)) {
            a
        } else if self.is(b, -1.0) {
            self.neg(a)
        } else if let Some(a) = self.negated(a) {
            let quotient = self.div(a, b);
            self.neg(quotient)
        } else if let Some(b) = self.negated(b) {
            let quotient = self.div(a, b);
            self.neg(quotient)
        } else {
            self.intern(Node::Binary(Binary::Div, a, b))
        }
    }
    fn make_power(&mut self, a: ExprId, b: ExprId) -> ExprId {
        if self.is(b, 2.0) {
            self.square(a)
        } else if self.is(b, 3.0) {
            let square = self.square(a);
            self.mul(a, square)
        } else if self.is(b, 1.0) {
            a
        } else if self.is(b, 0.0) {
            self.constant(1.0)
        } else if self.is(b, 0.5) {
            self.sqrt(a)
        } else if self.is(b, -1.0) {
            let one = self.constant(1.0);
            self.div(one, a)
        } else {
            self.intern(Node::Binary(Binary::Pow, a, b))
        }
    }
    /// `and` and `or`, where one side decides or does not matter.
    fn make_junction(&mut self, op: Binary, a: ExprId, b: ExprId) -> ExprId {
        let (a, b) = (a.min(b), a.max(b));
        for (x, y) in [(a, b), (b, a)] {
            let Some(number) = self.as_constant(x) else { continue };
            let decides = (op == Binary::Or) == (number != 0.0);
            if decides {
                return self.constant(number_from_truth(op == Binary::Or));
            } else if self.is_truth(y) {
                return y;
            }
        }
        if a == b && self.is_truth(a) { a } else { self.intern(Node::Binary(op, a, b)) }
    }

    /// Returns every node that the `roots` are made of, operands before users.
    ///
    /// Cost: that of the nodes reached, and a bit for every other one before them.
    pub fn reachable(&self, roots: &[ExprId]) -> Vec<ExprId> {
        let end = roots.iter().map(|r| r.index() + 1).max().unwrap_or(0);
        let mut reached = Vec::with_capacity(end.min(MARKS * 64));
        self.each_marked(roots, end, |id, _| reached.push(id));
        reached.reverse();
        reached
    }
    /// Marks what is reached among the nodes before `end`; users stand after their operands, so that one
    /// pass from the end meets them all.
    fn each_marked(&self, roots: &[ExprId], end: usize, mut visit: impl FnMut(ExprId, Node)) {
        let (mut few, mut many) = ([0_u64; MARKS], Vec::new());
        let marks = if end <= MARKS * 64 {
            &mut few[..]
        } else {
            many.resize(end.div_ceil(64), 0);
            &mut many[..]
        };
        let mark = |marks: &mut [u64], id: ExprId| {
            marks[id.index() / 64] |= 1 << (id.index() % 64);
        };
        roots.iter().for_each(|&r| mark(marks, r));
        for word in (0..end.div_ceil(64)).rev() {
            let mut below = u64::MAX;
            while marks[word] & below != 0 {
                let bit = 63 - (marks[word] & below).leading_zeros();
                below = (1 << bit) - 1;
                let id = ExprId::from_index(word * 64 + bit as usize);
                let node = self.node(id);
                visit(id, node);
                node.each_operand(|operand| mark(marks, operand));
            }
        }
    }
    /// Returns the value of an expression.
    ///
    /// For tests and rare use: what is computed again and again becomes a tape.
    ///
    /// # Panics
    /// If a variable that occurs in it has no value.
    pub fn evaluate(&self, id: ExprId, values: &[f64]) -> f64 {
        let order = self.reachable(&[id]);
        let mut results: Vec<f64> = Vec::with_capacity(order.len());
        for &id in &order {
            let of = |id| results[place(&order, id)];
            let result = match self.node(id) {
                Node::Constant(bits) => f64::from_bits(bits),
                Node::Var(var) => values[var.index()],
                Node::Unary(op, a) => op.apply(of(a)),
                Node::Binary(op, a, b) => op.apply(of(a), of(b)),
                Node::Select { condition, then, otherwise } => {
                    if of(condition) != 0.0 {
                        of(then)
                    } else {
                        of(otherwise)
                    }
                }
            };
            results.push(result);
        }
        results[place(&order, id)]
    }
    /// Returns true if every operation that the value of an expression needs has one: none is divided by zero, and no
    /// branch is asked that is not taken.
    ///
    /// ```
    /// use expr::{Arena, Unary, Var};
    /// let mut arena = Arena::new();
    /// let (one, x) = (arena.constant(1.0), arena.var(Var(0)));
    /// let reciprocal = arena.div(one, x);
    /// let id = arena.unary(Unary::Atan, reciprocal);
    /// assert!(arena.has_value(id, &[2.0]) && !arena.has_value(id, &[0.0]));
    /// ```
    ///
    /// # Panics
    /// If a variable that occurs in it has no value.
    pub fn has_value(&self, id: ExprId, values: &[f64]) -> bool {
        let order = self.reachable(&[id]);
        let mut results: Vec<f64> = Vec::with_capacity(order.len());
        // NaN stands for none: it passes on to whatever needs it
        for &id in &order {
            let of = |id| results[place(&order, id)];
            let result = match self.node(id) {
                Node::Constant(bits) => f64::from_bits(bits),
                Node::Var(var) => values[var.index()],
                Node::Unary(op, a) if of(a).is_finite() => op.apply(of(a)),
                Node::Binary(Binary::And, a, b) if of(a) == 0.0 || of(b) == 0.0 => 0.0,
                Node::Binary(Binary::Or, a, b) if is_true(of(a)) || is_true(of(b)) => 1.0,
                Node::Binary(op, a, b) if of(a).is_finite() && of(b).is_finite() => {
                    op.apply(of(a), of(b))
                }
                Node::Unary(..) | Node::Binary(..) => f64::NAN,
                Node::Select { condition, .. } if !of(condition).is_finite() => f64::NAN,
                Node::Select { condition, then, .. } if of(condition) != 0.0 => of(then),
                Node::Select { otherwise, .. } => of(otherwise),
            };
            results.push(result);
        }
        results[place(&order, id)].is_finite()
    }
    /// Calls `visit` with every operation that an expression is made of, users before operands.
    pub fn each_node(&self, id: ExprId, mut visit: impl FnMut(Node)) {
        self.each_marked(&[id], id.index() + 1, |_, node| visit(node));
    }
    /// Returns the variables that occur in an expression.
    pub fn variables(&self, id: ExprId) -> BTreeSet<Var> {
        let mut variables = BTreeSet::new();
        for &id in &self.reachable(&[id]) {
            if let Node::Var(var) = self.node(id) {
                variables.insert(var);
            }
        }
        variables
    }
    /// Returns the last of the expressions that the `roots` are made of of which `is` is true: it is no part
    /// of any other.
    pub fn last(&self, roots: &[ExprId], is: impl Fn(Node) -> bool) -> Option<ExprId> {
        let reached = self.reachable(roots);
        reached.into_iter().rev().find(|&id| is(self.node(id)))
    }
    /// Replaces the variables for which `replacement` gives an expression.
    pub fn substitute(
        &mut self,
        id: ExprId,
        replacement: &dyn Fn(Var) -> Option<ExprId>,
    ) -> ExprId {
        self.replace(id, &|arena, old| match arena.node(old) {
            Node::Var(var) => replacement(var),
            Node::Constant(_) | Node::Unary(..) | Node::Binary(..) | Node::Select { .. } => None,
        })
    }
    /// Replaces the parts for which `replacement` gives an expression; that is taken as it is.
    pub fn replace(
        &mut self,
        id: ExprId,
        replacement: &dyn Fn(&Self, ExprId) -> Option<ExprId>,
    ) -> ExprId {
        let order = self.reachable(&[id]);
        let mut made: Vec<ExprId> = Vec::with_capacity(order.len());
        for &old in &order {
            let node = self.node(old);
            let mut changed = false;
            node.each_operand(|a| changed |= made[place(&order, a)] != a);
            let new = match replacement(self, old) {
                Some(new) => new,
                None if changed => self.rebuild(node, |a| made[place(&order, a)]),
                None => old,
            };
            made.push(new);
        }
        made[place(&order, id)]
    }
    /// Copies an expression of another arena into this one, its variables by `map`.
    ///
    /// `map` is called once for each variable, in the order of the other arena.
    pub fn import(
        &mut self,
        from: &Self,
        id: ExprId,
        map: &mut impl FnMut(Var) -> ExprId,
    ) -> ExprId {
        let order = from.reachable(&[id]);
        let mut made: Vec<ExprId> = Vec::with_capacity(order.len());
        for &old in &order {
            let new = match from.node(old) {
                Node::Var(var) => map(var),
                node => self.rebuild(node, |a| made[place(&order, a)]),
            };
            made.push(new);
        }
        made[place(&order, id)]
    }
    /// Takes expressions out, alone: nodes and variables are numbered anew, in their order here.
    ///
    /// Two excerpts are equal if the expressions differ in nothing but which variables they speak of;
    /// what else either arena holds does not matter, except that operands of a sum or a product stand
    /// in the order in which they were made.
    pub fn excerpt(&self, roots: &[ExprId]) -> (Excerpt, Vec<Var>) {
        let order = self.reachable(roots);
        let mut variables = Vec::new();
        let at = |id: ExprId| ExprId::from_index(place(&order, id));
        let nodes = order.iter().map(|&id| match self.node(id) {
            Node::Constant(bits) => Node::Constant(bits),
            Node::Var(var) => {
                variables.push(var);
                Node::Var(Var::from_index(variables.len() - 1))
            }
            Node::Unary(op, a) => Node::Unary(op, at(a)),
            Node::Binary(op, a, b) => Node::Binary(op, at(a), at(b)),
            Node::Select { condition, then, otherwise } => {
                Node::Select { condition: at(condition), then: at(then), otherwise: at(otherwise) }
            }
        });
        let nodes = nodes.collect();
        (Excerpt { nodes, roots: roots.iter().map(|&r| at(r)).collect() }, variables)
    }
    /// Makes the arena of an excerpt, in which its roots have the ids that they have there.
    pub fn of_excerpt(excerpt: &Excerpt) -> Self {
        Self { nodes: excerpt.nodes.iter().copied().collect() }
    }
    /// Makes the same arena, with room for the derivatives of its roots.
    pub fn to_derive(excerpt: &Excerpt) -> Self {
        let mut arena = Self::for_nodes(4 * excerpt.nodes.len() + 8);
        arena.nodes.extend(excerpt.nodes.iter().copied());
        arena
    }
    /// Makes a node again over other operands, simplified anew.
    fn rebuild(&mut self, node: Node, operand: impl Fn(ExprId) -> ExprId) -> ExprId {
        match node {
            Node::Constant(bits) => self.constant(f64::from_bits(bits)),
            Node::Var(var) => self.var(var),
            Node::Unary(op, a) => self.unary(op, operand(a)),
            Node::Binary(op, a, b) => self.binary(op, operand(a), operand(b)),
            Node::Select { condition, then, otherwise } => {
                self.select(operand(condition), operand(then), operand(otherwise))
            }
        }
    }
}

/// Expressions by themselves, in the smallest arena that holds them.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Excerpt {
    /// Every node, operands before users.
    pub nodes: Box<[Node]>,
    /// The expressions that were asked for, as places among the nodes.
    pub roots: Box<[ExprId]>,
}

/// Where nodes stand in an order of reachable nodes.
pub(crate) struct Places<'o> {
    order: &'o [ExprId],
    /// For every node from the first on, its place, anything where it is not reachable; empty where few
    /// of them are.
    of: Vec<u32>,
}

impl<'o> Places<'o> {
    pub(crate) fn of(order: &'o [ExprId]) -> Self {
        let reach = order.last().map_or(0, |last| last.index() + 1 - order[0].index());
        if reach > 8 * order.len() {
            return Self { order, of: Vec::new() };
        }
        let mut of = vec![0; reach];
        for (id, place) in order.iter().zip(0..) {
            of[id.index() - order[0].index()] = place;
        }
        Self { order, of }
    }
    pub(crate) fn place(&self, id: ExprId) -> usize {
        match self.of.get(id.index() - self.order[0].index()) {
            Some(&place) => place as usize,
            None => place(self.order, id),
        }
    }
}

/// Returns true for a truth value that is known, and true.
fn is_true(x: f64) -> bool {
    x.is_finite() && x != 0.0
}

/// Returns where `id` stands in an order that holds it.
pub(crate) fn place(order: &[ExprId], id: ExprId) -> usize {
    // where nothing is left out, that is its distance from the first
    let most = id.index() - order[0].index();
    if order.get(most) == Some(&id) {
        return most;
    }
    order.binary_search(&id).expect("an order of reachable nodes holds their operands")
}

impl PartialEq for Arena {
    fn eq(&self, other: &Self) -> bool {
        self.nodes.as_slice() == other.nodes.as_slice()
    }
}
impl Eq for Arena {}
impl Hash for Arena {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.nodes.as_slice().hash(state);
    }
}
impl std::fmt::Debug for Arena {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let nodes = self.nodes.iter().enumerate();
        f.debug_map().entries(nodes.map(|(i, node)| (ExprId::from_index(i), node))).finish()
    }
}
