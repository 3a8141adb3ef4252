//! Rows: what a search has to make true, in the forms that it can reason about.
//!
//! In: truths over cells. Out: [`Row`]s: sums with whole coefficients, sets of different numbers,
//! anything else by its two sides, and conjunctions and alternatives of these.

use crate::truth::{Comparing, Comparison, Truth};
use expr::{Arena, Binary, ExprId, Node, Tape, Unary};
use std::collections::BTreeMap;

/// Something that must hold of cells.
#[derive(Debug)]
pub(crate) enum Row {
    Linear(Linear),
    Different(Vec<Shifted>),
    General(General),
    All(Vec<Row>),
    Any(Vec<Row>),
}

/// A cell plus a constant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shifted {
    pub(crate) cell: u32,
    pub(crate) by: i64,
}

/// The sum of `coefficient * cell` compared with a constant.
#[derive(Debug)]
pub(crate) struct Linear {
    pub(crate) terms: Vec<(u32, i64)>,
    pub(crate) comparing: Sum,
    pub(crate) constant: i64,
}

/// How a sum of whole numbers compares; strictly less is at most one less.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Sum {
    Equal,
    AtMost,
    Differ,
}

/// Two sides of any form.
#[derive(Debug)]
pub(crate) struct General {
    pub(crate) comparing: Comparing,
    pub(crate) left: ExprId,
    pub(crate) right: ExprId,
    pub(crate) sides: Tape,
    /// In order of declaration.
    pub(crate) cells: Vec<u32>,
    /// A cell that one side is, and the other side, where that does not speak of it.
    pub(crate) defined: Vec<(u32, ExprId)>,
}

/// Makes the row of a truth; `whole` says which cells are whole numbers, known or not.
pub(crate) fn row(arena: &Arena, whole: &[bool], truth: Truth) -> Row {
    match truth {
        Truth::Holds(comparison) => compare(arena, whole, comparison),
        Truth::All(parts) => Row::All(parts.into_iter().map(|p| row(arena, whole, p)).collect()),
        Truth::Any(parts) => Row::Any(parts.into_iter().map(|p| row(arena, whole, p)).collect()),
    }
}

/// Makes the rows that say that no two expressions are equal.
pub(crate) fn different(arena: &Arena, whole: &[bool], expressions: &[ExprId]) -> Row {
    let shifted = |&e: &ExprId| {
        let sum = linear(arena, e)?;
        let mut terms = sum.terms.iter();
        match (terms.next(), terms.next()) {
            (Some((&cell, 1)), None) if whole[cell as usize] => {
                Some(Shifted { cell, by: sum.constant })
            }
            _ => None,
        }
    };
    if let Some(cells) = expressions.iter().map(shifted).collect::<Option<Vec<_>>>() {
        return Row::Different(cells);
    }
    let mut pairs = Vec::new();
    for (i, &left) in expressions.iter().enumerate() {
        for &right in &expressions[i + 1..] {
            let comparison = Comparison { comparing: Comparing::Differ, left, right };
            pairs.push(compare(arena, whole, comparison));
        }
    }
    Row::All(pairs)
}

fn compare(arena: &Arena, whole: &[bool], comparison: Comparison) -> Row {
    let Comparison { comparing, left, right } = comparison;
    if let (Some(l), Some(r)) = (linear(arena, left), linear(arena, right))
        && let Some(difference) = l.plus(&r, -1)
        && difference.terms.keys().all(|&cell| whole[cell as usize])
    {
        let terms = difference.terms.into_iter().filter(|t| t.1 != 0).collect();
        let below = difference.constant.checked_neg();
        let (comparing, constant) = match comparing {
            Comparing::Equal => (Sum::Equal, below),
            Comparing::AtMost => (Sum::AtMost, below),
            Comparing::Less => (Sum::AtMost, below.and_then(|b| b.checked_sub(1))),
            Comparing::Differ => (Sum::Differ, below),
        };
        if let Some(constant) = constant {
            return Row::Linear(Linear { terms, comparing, constant });
        }
    }
    let mut cells: Vec<u32> = arena.variables(left).into_iter().map(|v| v.0).collect();
    cells.extend(arena.variables(right).into_iter().map(|v| v.0));
    cells.sort_unstable();
    cells.dedup();
    let mut defined = Vec::new();
    if comparing == Comparing::Equal {
        for (side, other) in [(left, right), (right, left)] {
            if let Node::Var(v) = arena.node(side)
                && !arena.variables(other).contains(&v)
            {
                defined.push((v.0, other));
            }
        }
    }
    let sides = Tape::compile(arena, &[left, right]);
    Row::General(General { comparing, left, right, sides, cells, defined })
}

/// A sum of cells with whole coefficients, and a constant.
struct Affine {
    terms: BTreeMap<u32, i64>,
    constant: i64,
}

impl Affine {
    fn constant(constant: i64) -> Self {
        Self { terms: BTreeMap::new(), constant }
    }
    /// Returns the sum with `factor` times another; nothing where a number becomes too large.
    fn plus(mut self, other: &Self, factor: i64) -> Option<Self> {
        for (&cell, &c) in &other.terms {
            let sum = self.terms.entry(cell).or_insert(0);
            *sum = sum.checked_add(c.checked_mul(factor)?)?;
        }
        self.constant = self.constant.checked_add(other.constant.checked_mul(factor)?)?;
        Some(self)
    }
}

/// Returns the sum that an expression is, where its coefficients are whole.
fn linear(arena: &Arena, id: ExprId) -> Option<Affine> {
    match arena.node(id) {
        Node::Constant(bits) => Some(Affine::constant(whole_number(f64::from_bits(bits))?)),
        Node::Var(v) => Some(Affine { terms: BTreeMap::from([(v.0, 1)]), constant: 0 }),
        Node::Unary(Unary::Neg, a) => Affine::constant(0).plus(&linear(arena, a)?, -1),
        Node::Binary(Binary::Add, a, b) => linear(arena, a)?.plus(&linear(arena, b)?, 1),
        Node::Binary(Binary::Sub, a, b) => linear(arena, a)?.plus(&linear(arena, b)?, -1),
        Node::Binary(Binary::Mul, a, b) => {
            let (a, b) = (linear(arena, a)?, linear(arena, b)?);
            match (a.terms.is_empty(), b.terms.is_empty()) {
                (true, _) => Affine::constant(0).plus(&b, a.constant),
                (false, true) => Affine::constant(0).plus(&a, b.constant),
                (false, false) => None,
            }
        }
        Node::Unary(..) | Node::Binary(..) | Node::Select { .. } => None,
    }
}

/// Returns the whole number that a number is.
pub(crate) fn whole_number(x: f64) -> Option<i64> {
    (x == x.trunc() && x.abs() <= super::domain::MOST as f64).then_some(x as i64)
}

impl Row {
    /// Names the cells that it speaks of.
    pub(crate) fn cells(&self) -> Vec<u32> {
        let mut cells: Vec<u32> = match self {
            Self::Linear(linear) => linear.terms.iter().map(|t| t.0).collect(),
            Self::Different(cells) => cells.iter().map(|c| c.cell).collect(),
            Self::General(general) => general.cells.clone(),
            Self::All(rows) | Self::Any(rows) => rows.iter().flat_map(Self::cells).collect(),
        };
        cells.sort_unstable();
        cells.dedup();
        cells
    }
}
