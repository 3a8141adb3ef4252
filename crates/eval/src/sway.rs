//! Sway: how far the sides of a rule move apart where the numbers that it is made of move.
//!
//! In: a rule that its sides alone do not let hold. Out: for each of its comparisons the sum, over every
//! number that is read, of its size times the slope of the difference by it; found by moving one after
//! the other a little, so that the checker shares nothing with derivatives.

use crate::evaluator::{Evaluator, Result};
use crate::verdict::Verdict;
use base::number::Tolerance;

/// How far a number is moved, as a part of it.
const NUDGE: f64 = 1.0 / 1_048_576.0;

/// The comparisons of two numbers that a rule makes, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Compared {
    /// The differences found so far.
    pub(crate) differences: Vec<f64>,
    /// The differences of their squares, whose slopes may be the same everywhere where those of distances are not.
    pub(crate) squares: Vec<f64>,
    /// How each shall compare with zero.
    pub(crate) orders: Vec<Order>,
    /// Which branches a rule takes, in order: those of conditions that are true.
    pub(crate) taken: Vec<bool>,
    /// The sway of each, where it is known.
    sways: Vec<f64>,
}

/// How the difference of two sides shall compare with zero.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Order {
    Equal,
    AtMost,
}

impl<'a> Evaluator<'a> {
    /// Returns true if two sides agree, to `within` where that is written.
    pub(crate) fn agree(&self, x: f64, y: f64, within: Option<Tolerance>, order: Order) -> bool {
        let mut compared = self.compared.borrow_mut();
        let sway = compared.sways.get(compared.differences.len()).copied().unwrap_or(0.0);
        compared.differences.push(x - y);
        compared.squares.push(x * x - y * y);
        compared.orders.push(order);
        within.unwrap_or_default().is_met_with(x, y, || sway)
    }

    /// Judges a rule by its sides, and where it does not hold by its sway too.
    pub(crate) fn with_sway(
        &self,
        within: Option<Tolerance>,
        judge: impl Fn() -> Result<Verdict>,
    ) -> Result<Verdict> {
        let outer = self.compared.take();
        let verdict = self.judge_with_sway(within, judge);
        self.compared.replace(outer);
        verdict
    }

    fn judge_with_sway(
        &self,
        within: Option<Tolerance>,
        judge: impl Fn() -> Result<Verdict>,
    ) -> Result<Verdict> {
        let verdict = judge()?;
        let Compared { differences, .. } = self.compared.take();
        if verdict.holds || within.is_some() || differences.is_empty() {
            return Ok(verdict);
        }
        let (_, reads) = self.listening(&judge);
        self.compared.take();
        let mut sways = vec![0.0; differences.len()];
        for slot in reads {
            let number = self.values.numbers[slot];
            if number == 0.0 || !self.structure.slots[slot].primitive.is_number() {
                continue;
            }
            // what cannot be computed there, or asks for something else, says nothing
            if self.nudging(slot, number * (1.0 + NUDGE), &judge).is_err() {
                self.compared.take();
                continue;
            }
            let moved = self.compared.take().differences;
            if moved.len() == sways.len() {
                for ((sway, now), before) in sways.iter_mut().zip(moved).zip(&differences) {
                    *sway += (now - before).abs() / NUDGE;
                }
            }
        }
        self.compared.replace(Compared { sways, ..Compared::default() });
        judge()
    }
}
