//! The roots of one step: the solutions that it has for the values that it reads.

use super::Run;
use crate::lower::Program;
use crate::plan::Step;
use crate::square::{Course, Side, Solved, Square, Trust};

/// A solution of a step.
#[derive(Clone, Debug)]
pub(crate) struct Root {
    /// A value for each target, in their order.
    pub(crate) values: Vec<f64>,
    /// How far that is from where the step starts: the root of the mean square, in scaled unknowns.
    pub(crate) distance: f64,
}

/// How far solutions are sought from where the step starts.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Reach {
    /// Near by: from there, and from starts up to a thirtieth of the extent away.
    Near,
    /// From starts up to sixteen times the extent away.
    Far,
}

/// How many further solutions are looked for beside the first, from the same start.
const FURTHER: usize = 4;
/// Blocks with at most this many unknowns have few solutions, and those are found from one start.
const SMALL: usize = 2;

impl Run<'_> {
    /// Finds solutions of a step for what it reads now, nearest first; none for a step that has at most
    /// one. Leaves the targets anywhere.
    pub(super) fn roots(&mut self, step: &Step, reach: Reach) -> Vec<Root> {
        let square = match &step.program {
            Program::Inverse(inverse) => inverse.fallback(),
            Program::Square(square) => square,
            Program::Constant(_)
            | Program::Copy
            | Program::Formulas(..)
            | Program::Least(_)
            | Program::Measure(_)
            | Program::Host { .. } => return Vec::new(),
        };
        if square.block.is_linear {
            return Vec::new();
        }
        self.start_from_last(&step.targets);
        let known = square.all_solutions(self.values, &self.frame.scales, &mut self.buffers.work);
        let is_known = known.is_some();
        self.buffers.square.work += known.iter().flatten().map(Vec::len).sum::<usize>();
        let mut found = known.unwrap_or_default();
        if reach == Reach::Near && !is_known {
            for way in [Trust::Any, Trust::Leap] {
                self.start_from_last(&step.targets);
                self.look(step, square, way, &mut found);
            }
            self.look_further(step, square, &mut found);
        }
        let starts = match reach {
            _ if is_known => 0..0,
            Reach::Near if !found.is_empty() && step.targets.len() <= SMALL => 1..1,
            Reach::Near => 1..7,
            Reach::Far => 7..25,
        };
        for k in starts {
            for way in [Trust::Any, Trust::Leap] {
                self.start_from_last(&step.targets);
                let far = base::number::sqrt(f64::from(1u32 << k)) / 256.0;
                self.scatter(&step.targets, k, far);
                self.look(step, square, way, &mut found);
            }
        }
        let root = |values: Vec<f64>| Root { distance: self.distance(step, &values), values };
        let mut roots: Vec<Root> = found.into_iter().map(root).collect();
        roots.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        roots
    }

    /// Looks on the other side of the first solution, and for what is left where the known ones repel.
    fn look_further(&mut self, step: &Step, square: &Square, found: &mut Vec<Vec<f64>>) {
        let Some(first) = found.first() else { return };
        for (&t, root) in step.targets.iter().zip(first) {
            self.values[t as usize] = 2.0 * root - self.last[t as usize];
        }
        self.look(step, square, Trust::Any, found);
        for _ in 0..FURTHER {
            self.start_from_last(&step.targets);
            let (work, scratch) = (&mut self.buffers.work, &mut self.buffers.square);
            if !square.further(found, self.values, &self.frame.scales, work, scratch) {
                break;
            }
            found.push(self.targets(step));
        }
    }

    /// Keeps what is found from where the targets stand, if it is new.
    pub(super) fn look(
        &mut self,
        step: &Step,
        square: &Square,
        way: Trust,
        found: &mut Vec<Vec<f64>>,
    ) {
        let (work, scratch) = (&mut self.buffers.work, &mut self.buffers.square);
        let scales = &self.frame.scales;
        let course = Course { last: self.last, trust: way, side: &mut Side::default() };
        let end = square.solve(course, self.values, scales, work, scratch);
        if end != Solved::Failed && square.is_apart(found, self.values, scales, work, scratch) {
            found.push(self.targets(step));
        }
    }

    /// Returns the values that the targets have.
    pub(super) fn targets(&self, step: &Step) -> Vec<f64> {
        step.targets.iter().map(|&t| self.values[t as usize]).collect()
    }
    /// Gives values to the targets.
    pub(super) fn set_targets(&mut self, step: &Step, values: &[f64]) {
        for (&t, &value) in step.targets.iter().zip(values) {
            self.values[t as usize] = value;
        }
    }
    /// Returns true if these are the same solution.
    pub(super) fn is_same(&self, step: &Step, a: &[f64], b: &[f64]) -> bool {
        let scales = step.targets.iter().map(|&t| self.frame.scales[t as usize]);
        scales
            .zip(a.iter().zip(b))
            .all(|(scale, (a, b))| (a - b).abs() <= 1e-6 * scale.max(a.abs()))
    }
    /// How far values of the targets are from where the step starts.
    pub(super) fn distance(&self, step: &Step, values: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (&t, value) in step.targets.iter().zip(values) {
            let off = (value - self.last[t as usize]) / self.frame.scales[t as usize];
            sum += off * off;
        }
        base::number::sqrt(sum / step.targets.len().max(1) as f64)
    }
}
