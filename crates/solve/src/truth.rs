//! Truths: what a Bool expression asks for, as conjunctions and alternatives of comparisons.
//!
//! In: an expression and whether it shall be true. Out: a [`Truth`] without negations and choices by
//! condition: both are written out, so that whoever makes it hold has to know comparisons alone.

use expr::{Arena, Binary, ExprId, Node, Unary};

/// How the sides of a comparison shall compare.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Comparing {
    /// `left = right`
    Equal,
    /// `left <= right`
    AtMost,
    /// `left < right`
    Less,
    /// `left != right`
    Differ,
}

impl Comparing {
    /// Compares two numbers exactly.
    pub fn holds(self, left: f64, right: f64) -> bool {
        match self {
            Self::Equal => left == right,
            Self::AtMost => left <= right,
            Self::Less => left < right,
            Self::Differ => left != right,
        }
    }
}

/// What must hold for an expression to be true.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Truth {
    Holds(Comparison),
    /// Every one; with none, what is always true.
    All(Vec<Truth>),
    /// One at least; with none, what is never true.
    Any(Vec<Truth>),
}

/// Two sides and how they shall compare.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Comparison {
    /// How.
    pub comparing: Comparing,
    /// The left side.
    pub left: ExprId,
    /// The right side.
    pub right: ExprId,
}

/// Returns true if an expression can only be true or false; `of_slot` tells that of a slot.
pub(crate) fn is_truth(arena: &Arena, id: ExprId, of_slot: &dyn Fn(u32) -> bool) -> bool {
    match arena.node(id) {
        Node::Constant(_) => matches!(arena.as_constant(id), Some(0.0 | 1.0)),
        Node::Var(var) => of_slot(var.0),
        Node::Unary(op, _) => op == Unary::Not,
        Node::Binary(op, ..) => op.is_truth(),
        Node::Select { then, otherwise, .. } => {
            [then, otherwise].iter().all(|&side| is_truth(arena, side, of_slot))
        }
    }
}

/// Returns the comparisons that an expression is true with, all of them; nothing where it leaves a choice.
pub fn comparisons(arena: &mut Arena, id: ExprId) -> Option<Vec<Comparison>> {
    fn collect(truth: &Truth, all: &mut Vec<Comparison>) -> Option<()> {
        match truth {
            Truth::Holds(comparison) => all.push(*comparison),
            Truth::All(parts) => parts.iter().try_for_each(|part| collect(part, all))?,
            Truth::Any(_) => return None,
        }
        Some(())
    }
    let mut all = Vec::new();
    collect(&truth(arena, id, true), &mut all)?;
    Some(all)
}

/// Writes out what makes an expression true, or false where that is `wanted`.
pub(crate) fn truth(arena: &mut Arena, id: ExprId, wanted: bool) -> Truth {
    let holds = |comparing, left, right| Truth::Holds(Comparison { comparing, left, right });
    match arena.node(id) {
        Node::Constant(bits) => {
            if (f64::from_bits(bits) != 0.0) == wanted {
                Truth::All(Vec::new())
            } else {
                Truth::Any(Vec::new())
            }
        }
        Node::Unary(Unary::Not, a) => truth(arena, a, !wanted),
        Node::Binary(op @ (Binary::And | Binary::Or), a, b) => {
            let parts = vec![truth(arena, a, wanted), truth(arena, b, wanted)];
            if (op == Binary::And) == wanted { all(parts) } else { any(parts) }
        }
        Node::Binary(Binary::LessEqual, a, b) if wanted => holds(Comparing::AtMost, a, b),
        Node::Binary(Binary::LessEqual, a, b) => holds(Comparing::Less, b, a),
        Node::Binary(Binary::Less, a, b) if wanted => holds(Comparing::Less, a, b),
        Node::Binary(Binary::Less, a, b) => holds(Comparing::AtMost, b, a),
        Node::Binary(op @ (Binary::Equal | Binary::NotEqual), a, b) => {
            let equal = (op == Binary::Equal) == wanted;
            if is_truth_value(arena, a) && is_truth_value(arena, b) {
                let both = vec![truth(arena, a, true), truth(arena, b, equal)];
                let neither = vec![truth(arena, a, false), truth(arena, b, !equal)];
                return any(vec![all(both), all(neither)]);
            }
            holds(if equal { Comparing::Equal } else { Comparing::Differ }, a, b)
        }
        Node::Select { condition, then, otherwise } => {
            let first = vec![truth(arena, condition, true), truth(arena, then, wanted)];
            let second = vec![truth(arena, condition, false), truth(arena, otherwise, wanted)];
            any(vec![all(first), all(second)])
        }
        Node::Var(_) => {
            let value = arena.constant(f64::from(u8::from(wanted)));
            holds(Comparing::Equal, id, value)
        }
        Node::Unary(..) | Node::Binary(..) => {
            let zero = arena.constant(0.0);
            holds(if wanted { Comparing::Differ } else { Comparing::Equal }, id, zero)
        }
    }
}

/// Returns true for an expression that is a truth value whatever its variables are.
fn is_truth_value(arena: &Arena, id: ExprId) -> bool {
    match arena.node(id) {
        Node::Unary(op, _) => op == Unary::Not,
        Node::Binary(op, ..) => op.is_truth(),
        Node::Constant(_) | Node::Var(_) | Node::Select { .. } => false,
    }
}

fn all(parts: Vec<Truth>) -> Truth {
    let mut flat = Vec::new();
    for part in parts {
        match part {
            Truth::All(inner) => flat.extend(inner),
            Truth::Any(inner) if inner.is_empty() => return Truth::Any(inner),
            other @ (Truth::Holds(_) | Truth::Any(_)) => flat.push(other),
        }
    }
    one_or(flat, Truth::All)
}

fn any(parts: Vec<Truth>) -> Truth {
    let mut flat = Vec::new();
    for part in parts {
        match part {
            Truth::Any(inner) => flat.extend(inner),
            Truth::All(inner) if inner.is_empty() => return Truth::All(inner),
            other @ (Truth::Holds(_) | Truth::All(_)) => flat.push(other),
        }
    }
    one_or(flat, Truth::Any)
}

fn one_or(mut parts: Vec<Truth>, several: fn(Vec<Truth>) -> Truth) -> Truth {
    match parts.len() {
        1 => parts.remove(0),
        _ => several(parts),
    }
}
