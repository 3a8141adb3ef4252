//! Other states: what a plan comes to where one of its steps takes another root.
//!
//! In: an attempt. Out: for every step with several roots, each root that it does not take, with what the
//! steps after it make of that. Only states in which every step has a solution and every surplus row holds.

use super::{Approach, Attempt, Buffers, Run, begin};
use crate::fork::forking;
use crate::outcome::Host;
use crate::plan::Step;
use crate::square::{Square, Trust};

/// The largest step that is asked for other roots: a dozen unknowns have few.
const LARGEST: usize = 12;
/// How many steps are asked.
const MOST_STEPS: usize = 24;
/// How often another root is looked for, each time from farther away, in both directions.
const TRIES: u32 = 6;
/// How many are looked for from a state beside.
const FURTHER: usize = 4;
/// In parts of the extent, how far from the present root that is: √2 times this first, √2 times farther
/// each time, eight times this at last.
const NEAREST: f64 = 0.25;
/// What lies farther off, in the same parts, is no other state: rows hold there because nothing depends on it any more.
const FAR: f64 = 1e8;

/// Another state that a plan can come to.
#[derive(Clone, PartialEq, Debug)]
pub struct Other {
    /// The index of the step that takes another root.
    pub step: u32,
    /// A value for each slot.
    pub values: Vec<f64>,
}

impl Attempt<'_> {
    /// Runs the steps; then from each that has several roots on, for each that it does not take. Returns as
    /// many states as are asked for at `most`, in the order of steps, nearest roots first. Roots are looked for
    /// from `beside` as well.
    pub(crate) fn others(
        self,
        values: &mut [f64],
        beside: Option<&[f64]>,
        most: usize,
        buffers: &mut Buffers,
        host: &mut dyn Host,
    ) -> Vec<Other> {
        let Self { plan, frame, last, trust, part: _ } = self;
        let mut found: Vec<Other> = Vec::new();
        let mut asked = 0;
        begin(plan, frame, values, buffers);
        for (index, step) in plan.steps().iter().enumerate() {
            if self.step(index, values, &Approach::Nowhere, buffers, host).is_err() {
                break;
            }
            let Some(square) = forking(&step.program).filter(|s| !s.block.is_linear) else {
                continue;
            };
            if step.targets.len() > LARGEST || asked == MOST_STEPS {
                continue;
            }
            asked += 1;
            let (came, motion) = (values.to_vec(), buffers.motion.clone());
            let mut run = Run { plan, frame, last, values, trust, buffers, host, index };
            for root in run.other_roots(step, square, beside) {
                if found.len() == most {
                    break;
                }
                run.values.copy_from_slice(&came);
                run.buffers.motion.copy_from_slice(&motion);
                run.set_targets(step, &root);
                let inputs = run.inputs(&step.reads);
                let settled = run.settle(step, inputs).is_ok();
                let Run { values, buffers, host, .. } = &mut run;
                let rest = index + 1..plan.step_count();
                let goes_on = settled
                    && rest
                        .into_iter()
                        .all(|i| self.step(i, values, &Approach::Nowhere, buffers, *host).is_ok())
                    && self.broken(values, buffers, *host).is_none();
                if goes_on {
                    found.push(Other { step: index as u32, values: values.to_vec() });
                }
            }
            values.copy_from_slice(&came);
            buffers.motion.copy_from_slice(&motion);
        }
        found
    }
}

impl Run<'_> {
    /// Finds roots of a step beside the one that it has now, nearest first. Leaves the targets anywhere.
    fn other_roots(
        &mut self,
        step: &Step,
        square: &Square,
        beside: Option<&[f64]>,
    ) -> Vec<Vec<f64>> {
        let now = self.targets(step);
        let mut known = vec![now.clone()];
        for beside in beside.iter().cycle().take(FURTHER) {
            for &t in &step.targets {
                self.values[t as usize] = beside[t as usize];
            }
            if !self.look_beyond(step, square, &mut known) {
                break;
            }
        }
        for k in 1..=TRIES {
            let far = NEAREST * base::number::sqrt(f64::from(1u32 << k));
            for way in [far, -far] {
                self.set_targets(step, &now);
                self.scatter(&step.targets, k, way);
                if self.look_beyond(step, square, &mut known) {
                    continue;
                }
                // what repels may stand in the way of what lies beyond
                self.set_targets(step, &now);
                self.scatter(&step.targets, k, way);
                self.look(step, square, Trust::Any, &mut known);
            }
        }
        let mut others = known.split_off(1);
        let scales: Vec<f64> =
            step.targets.iter().map(|&t| self.frame.scales[t as usize]).collect();
        let away = |root: &[f64]| -> f64 {
            let off = root.iter().zip(&now).zip(&scales).map(|((a, b), scale)| (a - b) / scale);
            off.map(|d| d * d).sum()
        };
        others.retain(|root| away(root) <= FAR * FAR);
        others.sort_by(|a, b| away(a).total_cmp(&away(b)));
        others
    }

    /// Keeps what is found from where the targets stand, what is known repelling, if there is something.
    fn look_beyond(&mut self, step: &Step, square: &Square, known: &mut Vec<Vec<f64>>) -> bool {
        let (work, scratch) = (&mut self.buffers.work, &mut self.buffers.square);
        let is_new = square.further(known, self.values, &self.frame.scales, work, scratch);
        if is_new {
            known.push(self.targets(step));
        }
        is_new
    }
}
