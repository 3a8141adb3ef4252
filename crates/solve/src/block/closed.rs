//! Closed forms: two rows of the second degree in two unknowns that differ by a line, as two circles do.
//!
//! In: a layout. Out: which arguments of its two rows are the unknowns, and at any state the coefficients
//! of both around it. What a row says of two of its arguments is its kernel's ([`Kernel::curve`]).
//!
//! [`Kernel::curve`]: crate::kernel::Kernel::curve

use super::layout::Layout;
use super::{Block, KNOWN, Workspace};
use base::number::Tolerance;

/// The rows of a layout as conics.
#[derive(Debug)]
pub(crate) struct Closed {
    pairs: [Pair; 2],
    guards_move: bool,
}

/// The arguments of a row that are the two unknowns.
#[derive(Clone, Copy, Debug)]
struct Pair {
    /// In order; one more than the last where only one occurs.
    arguments: [u32; 2],
    /// True if the first of them is the second unknown.
    is_swapped: bool,
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
    /// Returns true if rows may have one, whatever they say.
    fn may_be_of(layout: &Layout) -> bool {
        let is_of_two = layout.height() == 2 && layout.core.len() == 2;
        is_of_two
            && !layout.is_linear
            && layout.within.iter().all(|&within| within == Tolerance::Relative)
    }
    /// Makes the closed form of rows that may have one and whose arguments are these unknowns, by position.
    fn new(layout: &Layout, arguments: &[u32]) -> Option<Self> {
        let pair = |row: usize| {
            let positions = &arguments[layout.arguments_of_row(row)];
            let twice = |u: u32| positions.iter().filter(|&&p| p == u).count() > 1;
            if [0, 1].into_iter().any(twice) {
                return None;
            }
            let at = |u: u32| positions.iter().position(|&p| p == u).unwrap_or(positions.len());
            let [a, b] = [0, 1].map(|u| at(u) as u32);
            Some(Pair { arguments: [a.min(b), a.max(b)], is_swapped: a > b })
        };
        let pairs = [pair(0)?, pair(1)?];
        let curve = |row: usize| layout.kernel_of_row(row).curve(pairs[row].arguments);
        let [first, second] = [curve(0)?, curve(1)?];
        let is_swapped = pairs[0].is_swapped != pairs[1].is_swapped;
        let guards_move = first.guards_move || second.guards_move;
        first.form.is_like(second.form, is_swapped).then_some(Self { pairs, guards_move })
    }

    /// Returns true if what the equations ask for besides depends on the unknowns.
    pub(crate) fn guards_move(&self) -> bool {
        self.guards_move
    }
}

impl Block {
    /// Returns its closed form; made when it is first asked.
    pub(crate) fn closed(&self) -> Option<&Closed> {
        let unknown = |s: &u32| self.unknowns.binary_search(s).map_or(KNOWN, |at| at as u32);
        let make = || {
            Closed::may_be_of(&self.layout).then_some(())?;
            let arguments: Vec<u32> = self.arguments.iter().map(unknown).collect();
            Closed::new(&self.layout, &arguments)
        };
        self.layout.closed.get_or_init(make).as_ref()
    }

    /// Computes the coefficients of a closed form of it around a state.
    pub(crate) fn conics(&self, closed: &Closed, values: &[f64], w: &mut Workspace) -> Conics {
        let mut is_guarded = true;
        let mut conic = |row: usize| {
            let Pair { arguments, is_swapped } = closed.pairs[row];
            let (kernel, own) = self.row(row);
            let Some(curve) = kernel.curve(arguments) else { unreachable!("it was found before") };
            let (one, [u, v], second) = if let Some(round) = &curve.round {
                let at = |argument: u32| values[own[argument as usize] as usize];
                let [dx, dy] = [0, 1].map(|i| at(arguments[i]) - at(round.center[i]));
                let radius = at(round.radius);
                is_guarded &= radius >= 0.0 || !round.is_length;
                (dx * dx + dy * dy - radius * radius, [2.0 * dx, 2.0 * dy], [1.0, 0.0, 1.0])
            } else {
                let out = w.run(&curve.tape, own, values, 6 + curve.guards);
                is_guarded &= out[6..].iter().all(|&guard| guard >= 0.0);
                (out[0], [out[1], out[2]], [out[3], out[4], out[5]])
            };
            if is_swapped {
                let [uu, uv, vv] = second;
                Conic { one, slope: [v, u], second: [vv, uv, uu] }
            } else {
                Conic { one, slope: [u, v], second }
            }
        };
        let rows = [conic(0), conic(1)];
        Conics { rows, is_guarded }
    }
}
