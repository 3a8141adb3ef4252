//! Parts: a long way to a wish is gone in short ones, so that how often the pointer is asked plays no part.

use super::Drag;
use crate::outcome::{Host, Outcome};
use crate::plan::Plan;
use crate::system::SlotIndex;

/// A way longer than this is cut, in parts of the extent, over the number of slots that move.
const PART: f64 = 0.25;
/// Into so many ways at most, over the same number.
const MOST_WORK: usize = 20_000;
/// What one wish of a drag may cost, in multiplications: the pointer waits for it.
pub const PATIENCE: u64 = 300_000_000;

impl Drag {
    /// Follows the wish: one target for each input, in their order.
    ///
    /// Where the required relations cannot follow, the drag stops at the limit and says so; a wish
    /// that they do not allow is met as nearly as they do. Later wishes go on from there. A long way is gone in
    /// short ones, so that how often the pointer is asked plays no part, as long as that is done soon: where
    /// the way is hard to find the drag stops on it.
    ///
    /// # Panics
    /// If there are not as many targets as inputs.
    pub fn follow(&mut self, plan: &Plan, targets: &[f64], host: &mut dyn Host) -> Outcome {
        assert_eq!(targets.len(), self.slice.inputs.len(), "a wish names every input");
        let may_leap = self.has_branch && plan.bends;
        let parts = if may_leap { self.parts(plan, targets) } else { 1 };
        let until = self.runner.spent() + PATIENCE;
        if parts > 1 {
            let from: Vec<f64> =
                self.slice.inputs.iter().map(|&input| self.now[input as usize]).collect();
            for part in 1..parts {
                let part = f64::from(part) / f64::from(parts);
                let on = from.iter().zip(targets).map(|(a, b)| a + part * (b - a));
                self.follow_on(plan, &on.collect::<Vec<_>>(), until, host);
                if self.runner.spent() > until {
                    break;
                }
            }
        }
        self.follow_on(plan, targets, until, host)
    }

    /// Returns what following has cost so far, in multiplications, roughly.
    pub fn spent(&self) -> u64 {
        self.runner.spent()
    }

    /// Returns into how many ways that to a wish is cut: where least change bends, a stride might pass over the
    /// end of a branch, and where inequalities wait, over them. The more of a kind moves, the nearer to one another
    /// it lies.
    pub fn parts(&self, plan: &Plan, targets: &[f64]) -> u32 {
        if !plan.has_branches {
            return 1;
        }
        let scales = &self.runner.frame.scales;
        let kind = |slot: SlotIndex| plan.slots()[slot as usize].scale;
        let part = |(&input, to): (&SlotIndex, &f64)| {
            let alike = self.slice.targets.iter().filter(|&&t| kind(t) == kind(input)).count();
            let way = (to - self.now[input as usize]).abs() / scales[input as usize];
            way * alike.max(1) as f64 / PART
        };
        let parts = self.slice.inputs.iter().zip(targets).map(part).fold(1.0, f64::max);
        let most = (MOST_WORK / self.slice.targets.len().max(1)).max(1);
        parts.ceil().min(most as f64) as u32
    }
}
