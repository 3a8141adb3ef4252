//! Closed forms: two rows of the second degree in two unknowns that differ by a line, as two circles do.
//!
//! In: a layout. Out: the rows as [`expr::conic`]s, compiled together, and at any state their
//! coefficients around it. One closed form serves all blocks of a layout.

use super::layout::Layout;
use super::{Block, Workspace};
use base::number::Tolerance;
use expr::{Arena, ExprId, Tape, Var};

/// The rows of a layout as conics.
#[derive(Debug)]
pub(crate) struct Closed {
    /// The coefficients of both rows, then the guards; its variables are the arguments of all rows.
    tape: Tape,
    outs: usize,
}

/// A row around a state: zero is `one + slope · p + second · (p₀², p₀ p₁, p₁²)`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Conic {
    pub(crate) one: f64,
    pub(crate) slope: [f64; 2],
    pub(crate) second: [f64; 3],
}

/// Both rows around a state.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Conics {
    pub(crate) rows: [Conic; 2],
    /// True if what the equations ask for besides holds there.
    pub(crate) is_guarded: bool,
}

impl Closed {
    /// Makes the closed form of rows whose arguments are these unknowns, by position, if they have one.
    pub(super) fn new(layout: &Layout, arguments: &[u32]) -> Option<Self> {
        let exact = layout.within.iter().all(|&within| within == Tolerance::Relative);
        if layout.height() != 2 || layout.core.len() != 2 || layout.is_linear || !exact {
            return None;
        }
        let mut arena = Arena::for_nodes(64);
        // an unknown is the first argument that it is
        let of = |unknown: u32| arguments.iter().position(|&p| p == unknown);
        let firsts = [of(0)?, of(1)?];
        let mut found = Vec::with_capacity(2);
        for row in 0..2 {
            let (kernel, own) = (layout.kernel_of_row(row), layout.arguments_of_row(row));
            let positions = &arguments[own.clone()];
            let arity = positions.len();
            let twice = |u: u32| positions.iter().filter(|&&p| p == u).count() > 1;
            if [0, 1].into_iter().any(twice) {
                return None;
            }
            let vars =
                [0, 1].map(|u| Var(positions.iter().position(|&p| p == u).unwrap_or(arity) as u32));
            let name = |var: Var| match positions[var.0 as usize] {
                super::KNOWN => Var(own.start as u32 + var.0),
                unknown => Var(firsts[unknown as usize] as u32),
            };
            found.push(kernel.conic(vars, &mut arena, &name)?);
        }
        if !found[0].is_like(&found[1], &arena) {
            return None;
        }
        let coefficients = found.iter().flat_map(|conic| conic.coefficients);
        let guards = found.iter().flat_map(|conic| conic.guards.iter().copied());
        let outs: Vec<ExprId> = coefficients.chain(guards).collect();
        Some(Self { tape: Tape::compile(&arena, &outs), outs: outs.len() })
    }
}

impl Block {
    /// Returns its closed form; made when it is first asked.
    pub(crate) fn closed(&self) -> Option<&Closed> {
        let unknown = |s: &u32| self.unknowns.binary_search(s).map_or(super::KNOWN, |at| at as u32);
        let make = || {
            let arguments: Vec<u32> = self.arguments.iter().map(unknown).collect();
            Closed::new(&self.layout, &arguments)
        };
        self.layout.closed.get_or_init(make).as_ref()
    }

    /// Computes the coefficients of a closed form of it around a state.
    pub(crate) fn conics(&self, closed: &Closed, values: &[f64], w: &mut Workspace) -> Conics {
        let out = w.run(&closed.tape, &self.arguments, values, closed.outs);
        let row = |at: usize| Conic {
            one: out[at],
            slope: [out[at + 1], out[at + 2]],
            second: [out[at + 3], out[at + 4], out[at + 5]],
        };
        Conics { rows: [row(0), row(6)], is_guarded: out[12..].iter().all(|&guard| guard >= 0.0) }
    }
}
