//! Limits: where a drag through modes stops on the way to a wish that none meets.

use super::{Hands, ModalDrag};
use crate::task::Task;
use solve::{Ended, SlotIndex};

/// What is no larger a part of what is moved makes no difference.
const EXACT: f64 = 1e-12;
/// How often the way is halved at most.
const HALVINGS: u32 = 60;
/// A drag stands at its limit where it cannot go on by this part of the way.
const ONWARD: f64 = EXACT;

impl ModalDrag {
    /// Goes on towards a wish that no mode meets as far as one stands and no inequality is passed: by halves, until
    /// what is moved is known to a part of 1e-12, or so much was spent.
    pub(super) fn come_near(
        &mut self,
        task: &Task,
        targets: &[f64],
        until: u64,
        hands: &mut Hands<'_>,
    ) {
        let mut beyond = targets.to_vec();
        let mut part = ONWARD;
        for _ in 0..=HALVINGS {
            if self.is_exact(&beyond) || hands.planner.spent() > until || hands.planner.is_spent() {
                return;
            }
            let on = |(&input, to): (&SlotIndex, &f64)| {
                let at = self.now[input as usize];
                at + part * (to - at)
            };
            let on: Vec<f64> = self.inputs.iter().zip(&beyond).map(on).collect();
            let decision = self.decide(task, &on, hands);
            let stands = decision.ended == Ended::Settled
                && !self.met.modes.passes(&decision.mode, &self.now, &decision.tried.values);
            if stands {
                self.stand_in(task, &decision, hands);
            } else if part == ONWARD {
                return;
            } else {
                beyond = on;
            }
            part = 0.5;
        }
    }

    /// Returns true if a wish differs by nothing that counts from where the drag stands.
    fn is_exact(&self, wish: &[f64]) -> bool {
        let is_same = |(&input, to): (&SlotIndex, &f64)| {
            let at = self.now[input as usize];
            (to - at).abs() <= EXACT * at.abs().max(to.abs())
        };
        self.inputs.iter().zip(wish).all(is_same)
    }
}
