//! Pieces: an equation with an `if` or a comparison in an expression, as alternatives.
//!
//! In: a system. Out: a conditional one in which each equation with an `if`, a larger, a smaller, a size or a
//! comparison is a choice: of the piece that it is on, where that piece ends being inequalities. So what
//! Newton's steps cannot leave, a piece that is flat, another mode is not on.
//!
//! `y = max(a, b)` says `b <= a and y = a or a <= b and y = b`; `t = (a < b)` says `a < b and t = 1 or
//! b <= a and t = 0`.

use crate::conditional::{Conditional, Demand, DemandKind};
use crate::modes;
use crate::pattern::{Pattern, PatternId, Patterns};
use crate::system::{Equation, RelationBody};
use base::Id;
use expr::{Arena, Binary, ExprId, Node, Unary, Var};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// An equation is taken apart into so many pieces at most; what is left of it stays whole.
const MOST_PIECES: u32 = 64;
/// So many equations of a system at most are taken apart.
pub(crate) const MOST_EQUATIONS: usize = 200;

/// Returns true if an equation with this operation in it may be taken apart.
pub(crate) fn has_pieces(node: Node) -> bool {
    let is_step = matches!(node, Node::Unary(Unary::Floor | Unary::Round, _));
    is_step || is_piecewise(node)
}

/// Returns true if an operation is one of several expressions, each on its own piece.
fn is_piecewise(node: Node) -> bool {
    match node {
        Node::Select { .. } => true,
        Node::Unary(op, _) => op == Unary::Abs,
        Node::Binary(op, ..) => matches!(op, Binary::Min | Binary::Max) || op.is_comparison(),
        Node::Constant(_) | Node::Var(_) => false,
    }
}

/// Takes the equations of a system apart that have pieces. Returns nothing where none has, or too many
/// have, or where [`Patterns::take_apart`] did not look at them.
pub fn taken_apart(stated: &Conditional, patterns: &Patterns) -> Option<Conditional> {
    let has_pieces = |e: &Equation| patterns.get(e.pattern).has_pieces();
    let count = stated.system.equations.iter().filter(|e| has_pieces(e)).count();
    if count == 0 || count > MOST_EQUATIONS || stated.is_searched() {
        return None;
    }
    let mut apart = stated.clone();
    let mut known: BTreeMap<PatternId, (PatternId, Vec<Var>)> = BTreeMap::new();
    for (index, relation) in (0..).zip(&stated.system.relations) {
        let equations = stated.system.equations_of(relation).iter().copied();
        let (pieces, whole): (Vec<Equation>, Vec<Equation>) = equations.partition(has_pieces);
        if pieces.is_empty() {
            continue;
        }
        for equation in pieces {
            let (pattern, variables) = match known.entry(equation.pattern) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(new) => {
                    let (arena, truth) = alternatives(patterns.get(equation.pattern));
                    new.insert(patterns.find(&arena, &[truth])?)
                }
            };
            let slots = stated.system.arguments(equation.arguments);
            let slots = variables.iter().map(|v| slots[v.index()]);
            let arguments = apart.system.add_arguments(slots);
            let (kind, pattern) = (DemandKind::True, *pattern);
            apart.demands.push(Demand { relation: index, kind, pattern, arguments });
        }
        let whole =
            whole.iter().map(|e| (e.pattern, stated.system.arguments(e.arguments).to_vec()));
        let whole = apart.system.add_equations(whole.collect::<Vec<_>>());
        let relation = &mut apart.system.relations[index as usize];
        relation.body = RelationBody::Equations(whole);
        // a method may be that of another piece
        relation.methods.clear();
    }
    apart.demands.sort_by_key(|d| d.relation);
    Some(apart)
}

/// Adds the patterns of what an equation is taken apart into.
pub(crate) fn add(patterns: &mut Patterns, equation: PatternId) {
    let (arena, truth) = alternatives(patterns.get(equation));
    let (pattern, _) = patterns.intern(&arena, &[truth]);
    modes::add(patterns, pattern);
}

/// Returns what is true where an equation holds, over its arguments.
fn alternatives(equation: &Pattern) -> (Arena, ExprId) {
    let mut arena = equation.arena().clone();
    let [left, right] = equation.roots() else { unreachable!("an equation has two sides") };
    let known = arena.constant(1.0);
    let mut lifting = Lifting { arena: &mut arena, assumed: Vec::new(), left: MOST_PIECES };
    let truth = lifting.lift(known, [*left, *right]);
    (arena, truth)
}

struct Lifting<'a> {
    arena: &'a mut Arena,
    /// The conditions of the piece at hand, as they are on it.
    assumed: Vec<(ExprId, bool)>,
    /// How many more pieces there may be.
    left: u32,
}

impl Lifting<'_> {
    /// Returns what is true where two sides are equal, without pieces in them, and they are on the piece that is
    /// `known` of them. Every piece is one alternative, of which what is known is a part.
    fn lift(&mut self, known: ExprId, sides: [ExprId; 2]) -> ExprId {
        let [left, right] = sides;
        for (side, other) in [(left, right), (right, left)] {
            if let Node::Unary(op @ (Unary::Floor | Unary::Round), x) = self.arena.node(side) {
                let holds = self.between(op, x, other);
                return self.arena.binary(Binary::And, known, holds);
            }
        }
        let piecewise = self.arena.last(&sides, is_piecewise);
        let (Some(whole), true) = (piecewise, self.left > 1) else {
            let holds = self.arena.binary(Binary::Equal, left, right);
            return self.arena.binary(Binary::And, known, holds);
        };
        if let Node::Select { condition, then, otherwise } = self.arena.node(whole) {
            let assumed = self.assumed.iter().find(|(c, _)| *c == condition);
            if let Some(&(_, truth)) = assumed {
                return self.on(whole, if truth { then } else { otherwise }, known, sides);
            }
            self.left -= 1;
            let fails = self.arena.unary(Unary::Not, condition);
            let mut on = |truth, condition_holds, piece| {
                self.assumed.push((condition, truth));
                let known = self.arena.binary(Binary::And, known, condition_holds);
                let holds = self.on(whole, piece, known, sides);
                self.assumed.pop();
                holds
            };
            let first = on(true, condition, then);
            let second = on(false, fails, otherwise);
            return self.arena.binary(Binary::Or, first, second);
        }
        self.left -= 1;
        if matches!(self.arena.node(whole), Node::Binary(op, ..) if op.is_comparison()) {
            let [first, second] = [true, false].map(|truth| self.told(whole, truth, known, sides));
            return self.arena.binary(Binary::Or, first, second);
        }
        let [first, second] = self.halves(whole).map(|(condition, value)| {
            let known = self.arena.binary(Binary::And, known, condition);
            self.on(whole, value, known, sides)
        });
        self.arena.binary(Binary::Or, first, second)
    }

    /// Returns what is true where a number rounds to another, if that is whole.
    fn between(&mut self, op: Unary, x: ExprId, whole: ExprId) -> ExprId {
        let arena = &mut *self.arena;
        let (below, above) = if op == Unary::Floor { (0.0, 1.0) } else { (0.5, 0.5) };
        let [below, above] = [below, above].map(|by| arena.constant(by));
        let (low, high) = (arena.sub(whole, below), arena.add(whole, above));
        let low = arena.binary(Binary::LessEqual, low, x);
        let high = arena.binary(Binary::Less, x, high);
        arena.binary(Binary::And, low, high)
    }

    /// Returns what is true where two sides are equal and a comparison in them is so.
    fn told(&mut self, whole: ExprId, truth: bool, known: ExprId, sides: [ExprId; 2]) -> ExprId {
        let value = self.arena.constant(f64::from(u8::from(truth)));
        let replacement = |_: &Arena, part: ExprId| (part == whole).then_some(value);
        let [known, left, right] =
            [known, sides[0], sides[1]].map(|e| self.arena.replace(e, &replacement));
        let holds = if truth { whole } else { self.arena.unary(Unary::Not, whole) };
        let known = self.arena.binary(Binary::And, known, holds);
        self.lift(known, [left, right])
    }

    /// Returns what is true where two sides are equal with one piece for a part of theirs.
    fn on(&mut self, whole: ExprId, piece: ExprId, known: ExprId, sides: [ExprId; 2]) -> ExprId {
        let replacement = |_: &Arena, part: ExprId| (part == whole).then_some(piece);
        let [known, left, right] =
            [known, sides[0], sides[1]].map(|e| self.arena.replace(e, &replacement));
        self.lift(known, [left, right])
    }

    /// Returns what is true where one number is at most another, of which every piece is asked where that is as
    /// much.
    fn at_most(&mut self, low: ExprId, high: ExprId) -> ExprId {
        let pairs = match (self.arena.node(low), self.arena.node(high)) {
            (Node::Binary(Binary::Max, a, b), _) => [(a, high), (b, high)],
            (_, Node::Binary(Binary::Min, a, b)) => [(low, a), (low, b)],
            (Node::Unary(Unary::Abs, a), _) => [(a, high), (self.arena.unary(Unary::Neg, a), high)],
            _ => return self.arena.binary(Binary::LessEqual, low, high),
        };
        let [first, second] = pairs.map(|(low, high)| self.at_most(low, high));
        self.arena.binary(Binary::And, first, second)
    }

    /// Returns both pieces of a larger, a smaller or a size: where each is, and what it is there.
    fn halves(&mut self, whole: ExprId) -> [(ExprId, ExprId); 2] {
        let arena = &mut *self.arena;
        let (low, high, [under, over]) = match arena.node(whole) {
            Node::Binary(Binary::Max, a, b) => (b, a, [b, a]),
            Node::Binary(_, a, b) => (b, a, [a, b]),
            Node::Unary(_, a) => {
                let zero = arena.constant(0.0);
                let negated = arena.unary(Unary::Neg, a);
                (zero, a, [negated, a])
            }
            Node::Constant(_) | Node::Var(_) | Node::Select { .. } => {
                unreachable!("these have no halves")
            }
        };
        let [above, below] = [self.at_most(low, high), self.at_most(high, low)];
        [(above, over), (below, under)]
    }
}
