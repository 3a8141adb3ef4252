//! Slopes of a kernel in a finite field.
//!
//! In: a generic point, every argument as a double and as a residue. Out: the derivatives as residues;
//! nothing where one is made of what has no counterpart in the field, as sines and π have none. The
//! doubles tell which case is taken, which of two is larger, which sign counts.

use super::Kernel;
use crate::residue::Residue;
use crate::rows::{Point, generic_number};
use crate::system::SlotIndex;
use base::Id;
use expr::{Binary, Node, Unary};

/// A number at a generic point: as a double, and exactly where it has a counterpart.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Exact {
    pub(crate) near: f64,
    pub(crate) residue: Option<Residue>,
}

impl Exact {
    /// What a slot is where nothing is known of it.
    pub(crate) fn generic(slot: SlotIndex, point: Point) -> Self {
        let seed = u64::from(slot);
        Self { near: generic_number(seed, point), residue: Some(Residue::drawn(seed)) }
    }
}

/// The highest power that is multiplied out.
const HIGHEST: f64 = 8.0;

impl Kernel {
    /// Computes the derivatives, in the order of the entries; false where one has no counterpart.
    pub(crate) fn exact_slopes(
        &self,
        arguments: &[Exact],
        work: &mut Vec<Exact>,
        out: &mut Vec<Residue>,
    ) -> bool {
        work.clear();
        for node in self.arena.nodes() {
            let at = |id: expr::ExprId| work[id.index()];
            let made = match node {
                Node::Constant(bits) => told(f64::from_bits(bits)),
                Node::Var(var) => arguments[var.index()],
                Node::Unary(op, a) => unary(op, at(a)),
                Node::Binary(op, a, b) => binary(op, at(a), at(b)),
                Node::Select { condition, then, otherwise } => {
                    at(if at(condition).near == 0.0 { otherwise } else { then })
                }
            };
            work.push(made);
        }
        out.clear();
        out.extend(self.derivatives.iter().map_while(|d| work[d.index()].residue));
        out.len() == self.derivatives.len()
    }
}

/// A number that is known outright.
fn told(near: f64) -> Exact {
    Exact { near, residue: Residue::standing_for(near) }
}

fn unary(op: Unary, a: Exact) -> Exact {
    let near = op.apply(a.near);
    let residue = match op {
        Unary::Neg => a.residue.map(Residue::negated),
        Unary::Abs if a.near < 0.0 => a.residue.map(Residue::negated),
        Unary::Abs => a.residue,
        Unary::Sqrt => a.residue.and_then(Residue::root),
        Unary::Floor | Unary::Round | Unary::Sign | Unary::Not => return told(near),
        Unary::Sin
        | Unary::Cos
        | Unary::Tan
        | Unary::Asin
        | Unary::Acos
        | Unary::Atan
        | Unary::Exp
        | Unary::Ln
        | Unary::Log10
        | Unary::Log2
        | Unary::Sinh
        | Unary::Cosh
        | Unary::Tanh
        | Unary::Asinh
        | Unary::Acosh
        | Unary::Atanh
        | Unary::Cbrt => None,
    };
    Exact { near, residue }
}

fn binary(op: Binary, a: Exact, b: Exact) -> Exact {
    let near = op.apply(a.near, b.near);
    let both = a.residue.zip(b.residue);
    let residue = match op {
        Binary::Add => both.map(|(a, b)| a.plus(b)),
        Binary::Sub => both.map(|(a, b)| a.plus(b.negated())),
        Binary::Mul => both.map(|(a, b)| a.times(b)),
        Binary::Div => both.and_then(|(a, b)| a.over(b)),
        Binary::Pow => a.residue.and_then(|a| power(a, b)),
        Binary::Min | Binary::Max => return if near == a.near { a } else { b },
        Binary::Remainder => both.and_then(|(a_, b_)| {
            let times = Residue::standing_for((a.near / b.near).floor())?;
            Some(a_.plus(b_.times(times).negated()))
        }),
        Binary::Less
        | Binary::LessEqual
        | Binary::Equal
        | Binary::NotEqual
        | Binary::And
        | Binary::Or => return told(near),
        Binary::Atan2 => None,
    };
    Exact { near, residue }
}

/// Multiplies out a power whose exponent is a small multiple of a half.
fn power(base: Residue, exponent: Exact) -> Option<Residue> {
    let is_told = exponent.residue == Residue::standing_for(exponent.near);
    let twice = 2.0 * exponent.near;
    if !is_told || twice.fract() != 0.0 || twice.abs() > 2.0 * HIGHEST {
        return None;
    }
    let of = if exponent.near.fract() == 0.0 { base } else { base.root()? };
    let times = if exponent.near.fract() == 0.0 { exponent.near } else { twice }.abs() as u32;
    let made = (0..times).fold(Residue::ONE, |made, _| made.times(of));
    if exponent.near < 0.0 { Residue::ONE.over(made) } else { Some(made) }
}
