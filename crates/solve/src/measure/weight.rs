//! Weights: what makes the errors of rows dimensionless, so that they can be summed.
//!
//! In: the rows of a block, the extent of every kind of number. Out: a weight for every row. An error counts in
//! parts of the extent of what it measures: lengths by the extent of lengths, areas by its square; plain
//! numbers count as they are written. What a row measures follows from its expressions and the kinds of its
//! slots; a factor that is written as a number is taken for a plain one where nothing tells more. The rows of
//! one level have a factor in common that makes the steepest of them about as steep as what is stronger: a power of
//! two, which rounds nothing. It changes no answer. What must hold cannot give way: its weight is but for rounding, and
//! is one over its slope.

use crate::kernel::Kernel;
use crate::lower::ProblemRow;
use crate::system::{Level, PLAIN, SlotIndex, TRUTH};
use base::number::power_of_two;
use expr::{Arena, Binary, ExprId, Node, Unary};
use std::collections::BTreeMap;

/// What an error measures: kinds of slots, each to a power.
pub(super) type Kinds = BTreeMap<u16, f64>;

/// Rows less steep than this part of the steepest of their level count as if they were as steep: what could hardly be
/// told from what has no slope.
const LEAST: f64 = 1e-4;

/// Returns what the error of a row measures; plain numbers have no kind.
pub(super) fn measured(row: &ProblemRow, scale: &dyn Fn(SlotIndex) -> u16) -> Kinds {
    let argument = |i: usize| match scale(row.arguments[i]) {
        PLAIN | TRUTH => Kinds::new(),
        kind => Kinds::from([(kind, 1.0)]),
    };
    kinds(&row.kernel, &argument)
}

/// Returns the weights of rows, by their levels, what they measure and how steep they are; `extent` is that of a kind.
pub(super) fn weights(
    levels: &[Level],
    measured: &[Kinds],
    slopes: &[f64],
    extent: &dyn Fn(u16) -> f64,
) -> Vec<f64> {
    let own = |(level, kinds): (&Level, &Kinds)| match level {
        Level::Required => 1.0,
        _ => kinds.iter().map(|(&k, &n)| base::number::pow(extent(k), -n)).product(),
    };
    let mut weights: Vec<f64> = levels.iter().zip(measured).map(own).collect();
    // alike they are one
    let mut first: BTreeMap<Level, f64> = BTreeMap::new();
    for (level, weight) in levels.iter().zip(&mut weights) {
        *weight /= *first.entry(*level).or_insert(*weight);
    }
    let mut steepest: BTreeMap<Level, f64> = BTreeMap::new();
    for ((level, weight), slope) in levels.iter().zip(&weights).zip(slopes) {
        let most = steepest.entry(*level).or_default();
        *most = most.max(weight * slope);
    }
    for ((level, weight), slope) in levels.iter().zip(&mut weights).zip(slopes) {
        let most = steepest[level];
        if *level == Level::Required {
            *weight = if *slope > 0.0 { 1.0 / slope } else { 1.0 };
        } else if most > 0.0 && most.is_finite() {
            let own = *weight * slope / most;
            *weight /= power_of_two(most);
            if own > 0.0 && own < LEAST {
                *weight *= LEAST / own;
            }
        }
    }
    weights
}

/// What an expression measures, and whether that is sure: of a number that is written it is not known, so that what
/// has one as a factor may measure more than it shows.
#[derive(Clone)]
struct Told {
    kinds: Kinds,
    is_sure: bool,
}

impl Told {
    fn plain() -> Self {
        Self { kinds: Kinds::new(), is_sure: true }
    }
    fn power(self, n: f64) -> Self {
        Self { kinds: power(self.kinds, n), ..self }
    }
    fn unsure(self) -> Self {
        Self { is_sure: false, ..self }
    }
}

/// Returns what the difference of an equation's sides measures, by what its arguments do.
fn kinds(kernel: &Kernel, argument: &dyn Fn(usize) -> Kinds) -> Kinds {
    let (arena, [left, right]) = kernel.expressions();
    // of what is made of numbers alone nothing is told
    let mut known: BTreeMap<ExprId, Option<Told>> = BTreeMap::new();
    for id in arena.reachable(&[left, right]) {
        let of = |operand: ExprId| known.get(&operand).cloned().flatten();
        let own = match arena.node(id) {
            Node::Constant(_) => None,
            Node::Var(var) => Some(Told { kinds: argument(var.0 as usize), is_sure: true }),
            Node::Unary(op, a) => match op {
                Unary::Neg | Unary::Abs | Unary::Floor | Unary::Round => of(a),
                Unary::Sqrt => of(a).map(|a| a.power(0.5)),
                Unary::Cbrt => of(a).map(|a| a.power(1.0 / 3.0)),
                _ => of(a).map(|_| Told::plain()),
            },
            Node::Binary(op, a, b) => binary(arena, op, (of(a), of(b)), b),
            Node::Select { then, otherwise, .. } => alike(of(then), of(otherwise)),
        };
        known.insert(id, own);
    }
    let side = |id| known.get(&id).cloned().flatten();
    alike(side(left), side(right)).map(|told| told.kinds).unwrap_or_default()
}

fn binary(
    arena: &Arena,
    op: Binary,
    (a, b): (Option<Told>, Option<Told>),
    exponent: ExprId,
) -> Option<Told> {
    match op {
        Binary::Add | Binary::Sub | Binary::Min | Binary::Max | Binary::Remainder => alike(a, b),
        Binary::Mul | Binary::Div => {
            let sign = if op == Binary::Div { -1.0 } else { 1.0 };
            match (a, b) {
                (None, None) => None,
                (Some(a), None) => Some(a.unsure()),
                (None, Some(b)) => Some(b.power(sign).unsure()),
                (Some(a), Some(b)) => Some(Told {
                    is_sure: a.is_sure && b.is_sure,
                    kinds: times(a.kinds, power(b.kinds, sign)),
                }),
            }
        }
        Binary::Pow => match arena.as_constant(exponent) {
            Some(n) => a.map(|a| a.power(n)),
            None => Some(Told::plain()),
        },
        _ => a.or(b).map(|_| Told::plain()),
    }
}

/// Of two that have to measure the same, returns what is sure, the first of two that are.
fn alike(a: Option<Told>, b: Option<Told>) -> Option<Told> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.is_sure && !a.is_sure { b } else { a }),
        (a, b) => a.or(b),
    }
}

fn power(kinds: Kinds, n: f64) -> Kinds {
    kinds.into_iter().map(|(kind, own)| (kind, own * n)).filter(|e| e.1 != 0.0).collect()
}

fn times(mut a: Kinds, b: Kinds) -> Kinds {
    for (kind, n) in b {
        *a.entry(kind).or_default() += n;
    }
    a.retain(|_, n| *n != 0.0);
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use expr::Var;

    /// What `left - right` of three numbers of kinds 0 (plain), 1 and 2 measures.
    fn of(build: impl Fn(&mut Arena, [ExprId; 3]) -> (ExprId, ExprId)) -> Vec<(u16, f64)> {
        let mut arena = Arena::new();
        let vars = [0, 1, 2].map(|i| arena.var(Var(i)));
        let (left, right) = build(&mut arena, vars);
        let (kernel, slots) = Kernel::of_slots(&arena, left, right);
        let argument = |i: usize| match slots[i] as u16 {
            PLAIN => Kinds::new(),
            kind => Kinds::from([(kind, 1.0)]),
        };
        kinds(&kernel, &argument).into_iter().collect()
    }

    #[test]
    fn what_errors_measure_follows_from_what_they_are_made_of() {
        let area = of(|a, [_, x, _]| (a.square(x), a.constant(4.0)));
        assert_eq!(area, [(1, 2.0)]);
        let length = of(|a, [_, x, _]| {
            let (x, four) = (a.square(x), a.constant(4.0));
            let sum = a.add(x, four);
            (a.sqrt(sum), a.constant(5.0))
        });
        assert_eq!(length, [(1, 1.0)]);
        let product = of(|a, [n, x, y]| {
            let product = a.mul(x, y);
            let more = a.mul(n, product);
            (product, more)
        });
        assert_eq!(product, [(1, 1.0), (2, 1.0)]);
        let area_too = of(|a, [_, x, _]| {
            let width = a.constant(0.025);
            (a.mul(width, x), a.square(x))
        });
        assert_eq!(area_too, [(1, 2.0)]);
        let plain = of(|a, [n, x, _]| {
            let ratio = a.div(x, x);
            let twice = a.constant(2.0);
            (a.mul(n, ratio), twice)
        });
        assert_eq!(plain, []);
    }

    #[test]
    fn errors_count_in_parts_of_extents() {
        let area = Kinds::from([(1, 2.0)]);
        let length = Kinds::from([(1, 1.0)]);
        let levels = [Level::Weak, Level::Weak, Level::Required];
        let found = weights(&levels, &[area, length, Kinds::new()], &[100.0, 10.0, 5.0], &|_| 10.0);
        // as a hundredth and a tenth are to each other, with slopes of about one
        assert_eq!(found, [1.0 / 128.0, 10.0 / 128.0, 0.2]);
    }
}
