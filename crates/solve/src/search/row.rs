//! Rows: what a search has to make true, in the forms that it can reason about.
//!
//! In: truths over cells. Out: [`Row`]s: sums with whole coefficients, sets of different numbers,
//! anything else by its two sides, and conjunctions and alternatives of these.

use super::domain::Domain;
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
}

/// What cells can be, whatever the values.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cells<'a> {
    /// Which are whole numbers, known or not.
    pub(crate) whole: &'a [bool],
    pub(crate) ranges: &'a [Domain],
}

impl Cells<'_> {
    /// Returns true for a cell that is 0 or 1.
    fn is_truth_value(self, cell: u32) -> bool {
        let range = self.ranges[cell as usize];
        self.whole[cell as usize] && range.low() >= 0 && range.high() <= 1
    }
}

/// Makes the row of a truth.
pub(crate) fn row(arena: &Arena, of: Cells<'_>, truth: Truth) -> Row {
    match truth {
        Truth::Holds(comparison) => compare(arena, of, comparison),
        Truth::All(parts) => Row::All(parts.into_iter().map(|p| row(arena, of, p)).collect()),
        Truth::Any(parts) => Row::Any(parts.into_iter().map(|p| row(arena, of, p)).collect()),
    }
}

/// Makes the rows that say that no two expressions are equal.
pub(crate) fn different(arena: &Arena, of: Cells<'_>, expressions: &[ExprId]) -> Row {
    let shifted = |&e: &ExprId| {
        let sum = linear(arena, of, e)?;
        let mut terms = sum.terms.iter();
        match (terms.next(), terms.next()) {
            (Some((&cell, 1)), None) if sum.per == 1 && of.whole[cell as usize] => {
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
            pairs.push(compare(arena, of, comparison));
        }
    }
    Row::All(pairs)
}

fn compare(arena: &Arena, of: Cells<'_>, comparison: Comparison) -> Row {
    let Comparison { comparing, left, right } = comparison;
    if let (Some(l), Some(r)) = (linear(arena, of, left), linear(arena, of, right))
        && let Some(difference) = l.plus(r.times(-1, 1))
        && difference.terms.keys().all(|&cell| of.whole[cell as usize])
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
    let sides = Tape::compile(arena, &[left, right]);
    Row::General(General { comparing, left, right, sides, cells })
}

/// A sum of cells and a constant, with whole coefficients over one positive divisor.
#[derive(Clone)]
struct Affine {
    terms: BTreeMap<u32, i64>,
    constant: i64,
    per: i64,
}

impl Affine {
    fn constant(constant: i64, per: i64) -> Self {
        Self { terms: BTreeMap::new(), constant, per }
    }
    fn cell(cell: u32) -> Self {
        Self { terms: BTreeMap::from([(cell, 1)]), constant: 0, per: 1 }
    }
    /// Returns the sum times a fraction; nothing where a number becomes too large, or the fraction is by nothing.
    fn times(mut self, factor: i64, per: i64) -> Option<Self> {
        let factor = factor.checked_mul(per.signum())?;
        for number in self.terms.values_mut().chain([&mut self.constant]) {
            *number = number.checked_mul(factor)?;
        }
        self.per = self.per.checked_mul(per.checked_abs()?)?;
        (self.per > 0).then_some(self)
    }
    /// Returns the sum of two; nothing where a number becomes too large.
    fn plus(self, other: Option<Self>) -> Option<Self> {
        let other = other?;
        let common = common_divisor(self.per.unsigned_abs(), other.per.unsigned_abs()) as i64;
        let (more, less) = (other.per / common, self.per / common);
        let (mut sum, other) = (self.widened(more)?, other.widened(less)?);
        for (cell, c) in other.terms {
            let own = sum.terms.entry(cell).or_insert(0);
            *own = own.checked_add(c)?;
        }
        sum.constant = sum.constant.checked_add(other.constant)?;
        Some(sum)
    }
    /// Returns the same sum with every number so many times as large.
    fn widened(self, factor: i64) -> Option<Self> {
        let per = self.per.checked_mul(factor)?;
        Some(Self { per, ..self.times(factor, 1)? })
    }
}

/// Returns the sum that an expression is, where its coefficients are fractions. What a truth value chooses between is
/// one, where the two lie a constant apart.
fn linear(arena: &Arena, of: Cells<'_>, id: ExprId) -> Option<Affine> {
    let sum = |id| linear(arena, of, id);
    match arena.node(id) {
        Node::Constant(bits) => {
            let (number, per) = fraction(f64::from_bits(bits))?;
            Some(Affine::constant(number, per))
        }
        Node::Var(v) => Some(Affine::cell(v.0)),
        Node::Unary(Unary::Neg, a) => sum(a)?.times(-1, 1),
        Node::Unary(Unary::Not, a) => match arena.node(a) {
            Node::Var(v) if of.is_truth_value(v.0) => {
                Affine::constant(1, 1).plus(sum(a)?.times(-1, 1))
            }
            _ => None,
        },
        Node::Binary(Binary::Add, a, b) => sum(a)?.plus(sum(b)),
        Node::Binary(Binary::Sub, a, b) => sum(a)?.plus(sum(b)?.times(-1, 1)),
        Node::Binary(Binary::Mul, a, b) => {
            let (a, b) = (sum(a)?, sum(b)?);
            match (a.terms.is_empty(), b.terms.is_empty()) {
                (true, _) => b.times(a.constant, a.per),
                (false, true) => a.times(b.constant, b.per),
                (false, false) => None,
            }
        }
        Node::Binary(Binary::Div, a, b) => {
            let (a, b) = (sum(a)?, sum(b)?);
            b.terms.is_empty().then(|| a.times(b.per, b.constant))?
        }
        Node::Select { condition, then, otherwise } => {
            let Node::Var(v) = arena.node(condition) else { return None };
            let (then, otherwise) = (sum(then)?, sum(otherwise)?);
            let more = then.plus(otherwise.clone().times(-1, 1))?;
            let is_constant = more.terms.values().all(|&c| c == 0);
            let truth = Affine::cell(v.0).times(more.constant, more.per);
            (of.is_truth_value(v.0) && is_constant).then(|| otherwise.plus(truth))?
        }
        Node::Unary(..) | Node::Binary(..) => None,
    }
}

/// Returns the fraction that a number is as it is written: 0.1 is a tenth. Nothing for one of more decimal digits than
/// a double keeps: only computing made it, and it is the number that was meant within rounding alone.
fn fraction(x: f64) -> Option<(i64, i64)> {
    if let Some(whole) = whole_number(x) {
        return Some((whole, 1));
    }
    let written = x.to_string();
    let (whole, decimals) = written.split_once('.')?;
    let number: i64 = format!("{whole}{decimals}").parse().ok()?;
    let is_written = number.abs() < 10i64.pow(f64::DIGITS);
    let per = 10i64.checked_pow(u32::try_from(decimals.len()).ok()?)?;
    is_written.then_some((number, per))
}

/// Returns the whole number that a number is.
pub(crate) fn whole_number(x: f64) -> Option<i64> {
    (x == x.trunc() && x.abs() <= super::domain::MOST as f64).then_some(x as i64)
}

impl Linear {
    /// Returns true if the greatest common divisor of the open terms divides what the known ones leave, without
    /// which no whole numbers make the sum.
    pub(crate) fn divides(&self, known: impl Fn(u32) -> Option<i64>) -> bool {
        let (mut rest, mut divisor) = (i128::from(self.constant), 0u64);
        for &(cell, c) in &self.terms {
            match known(cell) {
                Some(v) => rest -= i128::from(c) * i128::from(v),
                None => divisor = common_divisor(divisor, c.unsigned_abs()),
            }
            if divisor == 1 {
                return true;
            }
        }
        divisor == 0 || rest % i128::from(divisor) == 0
    }
}

/// Returns the greatest common divisor of two numbers; of nothing and a number, that number.
fn common_divisor(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { common_divisor(b, a % b) }
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
