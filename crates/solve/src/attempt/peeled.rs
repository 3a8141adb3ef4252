//! Running rows that are solved one after the other by formula, of which no steps are written out.
//!
//! A row comes to the bits that its step would come to. Where its formula is not defined it is left to its step.

use super::strips::value_of;
use super::{Attempt, Buffers, Failure, Motion, Run};
use crate::outcome::Host;
use crate::peel::{Peeled, Solved};
use crate::system::Stay;
use crate::test::Place;

impl Attempt<'_> {
    /// Runs all rows once.
    pub(super) fn rows(
        self,
        peeled: &Peeled,
        values: &mut [f64],
        buffers: &mut Buffers,
        host: &mut dyn Host,
    ) -> Result<(), Failure> {
        let Self { plan, frame, last, trust, part: _ } = self;
        let mut run = Run { plan, frame, last, values, trust, buffers, host, index: 0 };
        peeled.order.iter().enumerate().try_for_each(|(index, &solved)| {
            run.index = index;
            run.row(peeled, solved)
        })
    }
}

impl Run<'_> {
    fn row(&mut self, peeled: &Peeled, solved: Solved) -> Result<(), Failure> {
        let (row, target) = (solved.row, solved.target);
        let arguments = peeled.rows.mentions(row as usize);
        let inputs = self.inputs(arguments.iter().filter(|&&slot| slot != target));
        let has_value = self.plan.slots()[target as usize].stay != Stay::Free;
        match inputs {
            Motion::Still if has_value => {
                let relation = peeled.rows[row as usize].relation;
                let place = Place { relation, row: self.plan.place_of_row(&peeled.rows, row) };
                if self.frame.holds(self.plan, place, &mut self.buffers.work) {
                    self.values[target as usize] = self.frame.x0[target as usize];
                    self.buffers.motion[target as usize] = Motion::Still;
                    return Ok(());
                }
            }
            Motion::Opened if has_value => return self.step(&self.plan.steps()[self.index]),
            Motion::Still | Motion::Opened | Motion::Moved => {}
        }
        let formula = peeled.kernel(solved).solved(solved.argument());
        let formula = formula.expect("every row has a formula");
        let output = self.buffers.work.outputs(&formula.tape, arguments, self.values);
        match value_of(formula, output) {
            Some(value) => {
                self.values[target as usize] = value;
                self.buffers.motion[target as usize] = self.outcome(target, inputs);
                Ok(())
            }
            None => self.step(&self.plan.steps()[self.index]),
        }
    }
}
