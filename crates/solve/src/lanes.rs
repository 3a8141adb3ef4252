//! Lanes: a tape run for several rows at once.
//!
//! In: up to [`LANES`] rows, each by the slots of its arguments. Out: what the tape comes to for each, to the bits
//! of a run for it alone. Up to half as many rows take half the lanes.

use crate::system::SlotIndex;
use expr::{LANES, Lanes, Tape};

/// From how many rows of a kernel on they are evaluated in lanes.
pub(crate) const WIDE: usize = 3;

/// Working space has room for at least so many arguments and outputs, so that it serves small tapes without growing.
const ROOM: usize = 16;

/// How many lanes a few rows take.
const HALF: usize = LANES / 2;

/// Working space, of any content.
#[derive(Clone, Debug, Default)]
pub(crate) struct LaneScratch {
    all: Space<LANES>,
    half: Space<HALF>,
}

/// Working space for so many lanes.
#[derive(Clone, Debug, Default)]
struct Space<const N: usize> {
    registers: Vec<Lanes<N>>,
    arguments: Vec<Lanes<N>>,
    out: Vec<Lanes<N>>,
}

/// What a tape came to for several rows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outs<'a> {
    /// Output by output, each for every lane.
    all: &'a [f64],
    lanes: usize,
}

/// What a tape came to for one row, among what it came to for the rows beside it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Out<'a> {
    outs: Outs<'a>,
    row: usize,
}

impl<'a> Outs<'a> {
    /// Takes the outputs of one row alone.
    pub(crate) fn of_one(all: &'a [f64]) -> Self {
        Self { all, lanes: 1 }
    }
    /// Returns the outputs of one of the rows.
    pub(crate) fn of(self, row: usize) -> Out<'a> {
        Out { outs: self, row }
    }
}

impl Out<'_> {
    /// Returns one of the outputs.
    pub(crate) fn get(self, output: usize) -> f64 {
        self.outs.all[output * self.outs.lanes + self.row]
    }
}

impl LaneScratch {
    /// Runs a tape for up to [`LANES`] rows, `of` telling the slots of the arguments of each.
    pub(crate) fn run<'r>(
        &mut self,
        tape: &Tape,
        rows: usize,
        of: impl Fn(usize) -> &'r [SlotIndex],
        values: &[f64],
        outs: usize,
    ) -> Outs<'_> {
        if rows > HALF {
            self.all.run(tape, rows, of, values, outs)
        } else {
            self.half.run(tape, rows, of, values, outs)
        }
    }
}

impl<const N: usize> Space<N> {
    /// Does the same for up to as many rows as there are lanes; those beyond them repeat the last row.
    fn run<'r>(
        &mut self,
        tape: &Tape,
        rows: usize,
        of: impl Fn(usize) -> &'r [SlotIndex],
        values: &[f64],
        outs: usize,
    ) -> Outs<'_> {
        let own: [&[SlotIndex]; N] = std::array::from_fn(|lane| of(lane.min(rows - 1)));
        let arity = own[0].len();
        self.arguments.clear();
        self.arguments.reserve(arity.max(ROOM));
        let argument = |a: usize| std::array::from_fn(|lane| values[own[lane][a] as usize]);
        self.arguments.extend((0..arity).map(argument));
        if self.out.len() < outs {
            self.out.resize(outs.max(ROOM), [0.0; N]);
        }
        let out = &mut self.out[..outs];
        tape.run_lanes(&self.arguments, &mut self.registers, out);
        Outs { all: out.as_flattened(), lanes: N }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use expr::{Arena, Var};

    #[test]
    fn any_number_of_rows_has_the_bits_of_single_runs() {
        let mut arena = Arena::new();
        let [x, y] = [0, 1].map(|i| arena.var(Var(i)));
        let (product, quotient) = (arena.mul(x, y), arena.div(x, y));
        let tape = Tape::compile(&arena, &[product, quotient]);
        let values: Vec<f64> = (1..20).map(|i| f64::from(i).sqrt()).collect();
        let arguments: Vec<[SlotIndex; 2]> = (0..LANES as u32).map(|i| [i, 18 - i]).collect();
        let mut scratch = LaneScratch::default();
        for rows in 1..=LANES {
            let outs = scratch.run(&tape, rows, |row| &arguments[row][..], &values, 2);
            for (row, own) in arguments[..rows].iter().enumerate() {
                let [x, y] = own.map(|slot| values[slot as usize]);
                let out = [0, 1].map(|output| outs.of(row).get(output).to_bits());
                assert_eq!(out, [x * y, x / y].map(f64::to_bits), "row {row} of {rows}");
            }
        }
    }
}
