//! From a rough start: everything that does not hold is moved at once, so that the steps begin near.
//!
//! In: an attempt. Out: values for which everything holds, or none. What holds in x0, and comes from
//! nothing else, keeps its bits, except where all that is asked is whether everything can hold.

use super::{Approach, Attempt, Buffers, Motion, Run, begin};
use crate::joint::Gathered;
use crate::lower::Program;
use crate::outcome::Host;
use crate::plan::Step;
use crate::system::{Level, SlotIndex, Stay};
use std::rc::Rc;

/// What all rows together may err when the steps take over: the last digits are soon found block by block, and
/// slowly in the narrow valley that many rows make together. Where that is too rough, as little as can be.
const ENOUGH: [f64; 2] = [1e-7, 0.0];

/// What is moved.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Moves {
    /// What does not hold in x0, and what comes from that.
    WhatDoesNotHold,
    All,
}

impl Attempt<'_> {
    /// Runs the steps from where all rows together err least, near the last state; returns true if everything
    /// then holds. Of `values` the known slots count; what they are afterwards counts only then.
    pub(crate) fn run_from_near(
        self,
        values: &mut [f64],
        buffers: &mut Buffers,
        host: &mut dyn Host,
    ) -> bool {
        for (i, slot) in self.plan.slots().iter().enumerate() {
            if slot.stay != Stay::Fixed {
                values[i] = self.last[i];
            }
        }
        let gathered = self.gather(values, Moves::WhatDoesNotHold, buffers, host);
        let mut near = values.to_vec();
        ENOUGH.iter().any(|&enough| {
            gathered.joint.settle(&mut near, &self.frame.scales, enough, &mut buffers.work);
            values.copy_from_slice(&near);
            let attempt = Attempt { last: &near, ..self };
            attempt.run(values, &Approach::Nowhere, buffers, host).is_ok()
                && self.broken(values, buffers, host).is_none()
        })
    }

    /// Moves everything that is not known at once, what holds too, from the last state to where all rows together
    /// err least. `values` comes with the last state in it; returns true if all of them then hold.
    pub(crate) fn settle(
        self,
        values: &mut [f64],
        buffers: &mut Buffers,
        host: &mut dyn Host,
    ) -> bool {
        let Self { plan, frame, last, trust, part: _ } = self;
        let gathered = self.gather(values, Moves::All, buffers, host);
        let holds = gathered.joint.settle(values, &frame.scales, ENOUGH[1], &mut buffers.work);
        for (index, step) in plan.steps().iter().enumerate() {
            if matches!(step.program, Program::Copy) {
                // of a number that has just been found: it cannot fail
                _ = Run { plan, frame, last, values, trust, buffers, host, index }.step(step);
            }
        }
        holds
    }

    /// Takes all rows and unknowns of steps that move. `values` comes with the last state in it,
    /// and the known slots set, and leaves with what comes from those alone.
    fn gather(
        self,
        values: &mut [f64],
        moves: Moves,
        buffers: &mut Buffers,
        host: &mut dyn Host,
    ) -> Rc<Gathered> {
        let Self { plan, frame, last, trust, part: _ } = self;
        begin(plan, frame, values, buffers);
        let mut unknowns: Vec<SlotIndex> = Vec::new();
        let mut equations: Vec<u32> = Vec::new();
        for (index, step) in plan.steps().iter().enumerate() {
            let mut run = Run { plan, frame, last, values, trust, buffers, host, index };
            match &step.program {
                // what is no number there is found out when the steps run
                Program::Constant(_) | Program::Copy => _ = run.step(step),
                Program::Host { .. } => run.mark(step, Motion::Moved),
                Program::Formulas(..)
                | Program::Inverse(_)
                | Program::Square(_)
                | Program::Least(_)
                | Program::Measure(_) => {
                    let inputs = run.inputs(&step.reads);
                    if moves == Moves::All || !run.keeps(step, inputs) {
                        run.start_from_last(&step.targets);
                        run.mark(step, Motion::Moved);
                        unknowns.extend(&*step.targets);
                        equations.extend(&*step.rows);
                    }
                }
            }
        }
        let surplus = plan.report.rejected.iter().filter_map(|rejected| {
            let is_required = plan.relation(rejected.relation).level == Level::Required;
            plan.rows_of(rejected.relation).nth(rejected.row as usize).filter(|_| is_required)
        });
        equations.extend(surplus);
        plan.gathered(equations, unknowns)
    }
}

impl Run<'_> {
    fn mark(&mut self, step: &Step, motion: Motion) {
        for &t in &step.targets {
            self.buffers.motion[t as usize] = motion;
        }
    }
}
