//! Advancing: along a step, and where the way ends because rows have no value farther on.
//!
//! In: a state, a step. Out: the state that it leads to. A root has a value at nothing and no slope there, so that
//! Newton's steps neither begin nor end there: they begin a little inside, and go on until hardly any way is left to
//! the end; where what is nearly nothing can be nothing, it then is.

use super::{Measure, Off, SETTLED};
use crate::block::{Local, Workspace};
use crate::system::Level;

/// So near to where rows have no value any more, in parts of the extent, a step is next to it.
const BRINK: f64 = 1e-10;
/// How far inside a way begins.
const INSIDE: f64 = 1e-6;
/// The shortest part of a step that is tried.
const SHORTEST: f64 = 1e-30;

/// How far a step was gone.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Advance {
    /// This part of it.
    Part(f64),
    /// This part of it, hardly anything, since rows have no value farther on.
    NearEnd(f64),
    /// To where rows have a value and no slopes, as a root has none of nothing.
    End,
}

impl Measure {
    /// Moves the core a little aside from where rows have a value and no slopes, as a root has none of nothing, to
    /// where they have; where there is no such place, all is as it was.
    pub(super) fn go_inside(
        &self,
        values: &mut [f64],
        scale: &[f64],
        weights: &[f64],
        w: &mut Workspace,
    ) {
        let start: Vec<f64> = self.unknowns.iter().map(|&u| values[u as usize]).collect();
        for (i, &u) in self.unknowns.iter().enumerate() {
            for by in [INSIDE, -INSIDE] {
                values[u as usize] = start[i] + by * scale[i];
                if self.evaluate(values, scale, weights, w).is_some() {
                    return;
                }
            }
            values[u as usize] = start[i];
        }
        self.block.compute_defined(values, w);
    }

    /// Goes along the step, shortened until rows are not torn apart and have a value.
    pub(super) fn advance(
        &self,
        values: &mut [f64],
        step: &[f64],
        scale: &[f64],
        off: Off,
        weights: &[f64],
        w: &mut Workspace,
    ) -> Advance {
        let start: Vec<f64> = self.unknowns.iter().map(|&u| values[u as usize]).collect();
        let size = step.iter().fold(0.0f64, |most, d| most.max(d.abs()));
        let (mut length, mut is_outside) = (1.0, false);
        loop {
            for (i, &u) in self.unknowns.iter().enumerate() {
                values[u as usize] = start[i] + length * step[i] * scale[i];
            }
            let now = self.evaluate(values, scale, weights, w).map(|local| self.off(&local));
            match now {
                Some(now) if now.follows(off) || length < 1e-6 => {
                    let is_near = is_outside && length * size <= BRINK;
                    let holds = is_near && self.stands_at_end(values, w);
                    return if holds { Advance::NearEnd(length) } else { Advance::Part(length) };
                }
                None if length * size <= SETTLED && self.stands_at_end(values, w) => {
                    return Advance::End;
                }
                None if length < SHORTEST => return Advance::Part(length),
                Some(_) => {}
                None => is_outside = true,
            }
            length *= 0.5;
        }
    }

    /// Comes from next to the end of where rows have a value to where what is nearly nothing is nothing, if required
    /// rows hold there; else all is as it was.
    pub(super) fn comes_to_end(
        &self,
        values: &mut [f64],
        scale: &[f64],
        w: &mut Workspace,
    ) -> bool {
        let start: Vec<f64> = self.unknowns.iter().map(|&u| values[u as usize]).collect();
        for (&u, scale) in self.unknowns.iter().zip(scale) {
            if values[u as usize].abs() <= SETTLED * scale {
                values[u as usize] = 0.0;
            }
        }
        self.block.compute_defined(values, w);
        if self.stands_at_end(values, w) {
            return true;
        }
        self.unknowns.iter().zip(start).for_each(|(&u, x)| values[u as usize] = x);
        self.block.compute_defined(values, w);
        false
    }

    /// Returns true if required rows hold as they are, whatever their slopes.
    fn stands_at_end(&self, values: &[f64], w: &mut Workspace) -> bool {
        let mut local = Local::default();
        self.block.sides(values, w, &mut local);
        let hard = |&r: &usize| self.block.levels[r] == Level::Required;
        let rows = (0..self.block.height()).filter(hard);
        let are_finite = local.left.iter().chain(&local.right).all(|side| side.is_finite());
        are_finite && { rows }.all(|r| self.block.row_holds(&local, r, values, w))
    }
}
