//! Running strips.
//!
//! A row whose inputs have moved is computed here; one whose inputs have not, or whose formula is not
//! defined at them, is left to its step.

use super::{Failure, Held, Motion, Run, motion};
use crate::kernel::Solved;
use crate::strip::{Strip, StripRow};
use crate::system::{SlotIndex, Stay};
use expr::LANES;
use std::cell::Cell;

impl Run<'_> {
    /// Runs rows one after the other.
    pub(super) fn in_turn(&mut self, strip: &Strip) -> Result<(), Failure> {
        for rows in strip.rows.chunk_by(|a, b| a.formula == b.formula) {
            let formula = &strip.formulas[rows[0].formula as usize];
            let (arity, solved) = (formula.arity(), formula.solved());
            for row in rows {
                let arguments = &strip.arguments[row.first as usize..][..arity];
                self.one(row, arguments, (formula.argument, solved))?;
            }
        }
        Ok(())
    }

    /// Runs a row for one of its arguments.
    fn one(
        &mut self,
        row: &StripRow,
        arguments: &[SlotIndex],
        (argument, solved): (u32, &Solved),
    ) -> Result<(), Failure> {
        if !self.has_moved(arguments, argument) {
            return self.at_rest(row, arguments);
        }
        let output = self.buffers.work.outputs(&solved.tape, arguments, self.values);
        match value_of(solved, output) {
            Some(value) => {
                self.put(row.target, value);
                Ok(())
            }
            None => self.alone(row),
        }
    }

    /// Runs rows of one formula in lanes.
    pub(super) fn abreast(&mut self, strip: &Strip) -> Result<(), Failure> {
        let formula = &strip.formulas[0];
        let (arity, solved) = (formula.arity(), formula.solved());
        let outs = solved.guards[0].len() + 1;
        let chunks = strip.rows.chunks(LANES).zip(strip.arguments.chunks(LANES * arity));
        for (rows, arguments) in chunks {
            let each = || arguments.chunks_exact(arity);
            if !each().all(|a| self.has_moved(a, formula.argument)) {
                let mut own = rows.iter().zip(each());
                own.try_for_each(|(row, own)| self.one(row, own, (formula.argument, solved)))?;
                continue;
            }
            let of = |lane: usize| &arguments[lane * arity..][..arity];
            let work = &mut self.buffers.work;
            let outs = work.lanes.run(&solved.tape, rows.len(), of, self.values, outs);
            let value = |lane: usize| value_of(solved, |i| outs.of(lane).get(i));
            let values: [Option<f64>; LANES] =
                std::array::from_fn(|lane| if lane < rows.len() { value(lane) } else { None });
            for (row, value) in rows.iter().zip(values) {
                match value {
                    Some(value) => self.put(row.target, value),
                    None => self.alone(row)?,
                }
            }
        }
        Ok(())
    }

    fn has_moved(&self, arguments: &[SlotIndex], target: u32) -> bool {
        let motion = &self.buffers.motion;
        let mut moved = false;
        for (i, &slot) in (0..).zip(arguments) {
            moved |= i != target && motion[slot as usize] == Motion::Moved;
        }
        moved
    }

    fn put(&mut self, target: SlotIndex, value: f64) {
        self.values[target as usize] = value;
        self.buffers.motion[target as usize] = motion(self.frame, self.values, target);
    }

    /// Runs a row whose inputs have not moved: where it held when the edit began, it has nothing to do.
    fn at_rest(&mut self, row: &StripRow, arguments: &[SlotIndex]) -> Result<(), Failure> {
        let target = row.target as usize;
        let is_still =
            |&s: &SlotIndex| s == row.target || self.buffers.motion[s as usize] == Motion::Still;
        let held = self.frame.held.get(row.row as usize).map(Cell::get);
        let has_value = self.plan.slots()[target].stay != Stay::Free;
        if held != Some(Held::Yes) || !has_value || !arguments.iter().all(is_still) {
            return self.alone(row);
        }
        self.values[target] = self.frame.x0[target];
        self.buffers.motion[target] = Motion::Still;
        Ok(())
    }

    fn alone(&mut self, row: &StripRow) -> Result<(), Failure> {
        self.index = row.step as usize;
        self.step(&self.plan.steps()[self.index])
    }
}

/// Returns the value of a formula, if it is defined; guards come first.
pub(super) fn value_of(solved: &Solved, out: impl Fn(usize) -> f64) -> Option<f64> {
    let guards = &solved.guards[0];
    let value = out(guards.len());
    let admitted = guards.iter().enumerate().all(|(i, kind)| kind.admits(out(i)));
    (admitted && value.is_finite()).then_some(value)
}
