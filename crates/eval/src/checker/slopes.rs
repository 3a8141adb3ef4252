//! The slopes of a rule's comparisons, found by moving one number after the other a little.

use crate::answer::Frame;
use crate::evaluator::Evaluator;
use crate::sway::{Compared, Order};
use kernel::{ConstraintInstance, SlotId};
use std::collections::BTreeSet;

/// How far a number is moved, as a part of it, and of the unit at least.
const NUDGE: f64 = 1.0 / 1_048_576.0;
/// How near to its bound an inequality acts, as a part of its slopes.
const AT_BOUND: f64 = 1e-6;

/// How much a slope may differ from one side of a number to the other, as a part of it, and of one at least.
const KINK: f64 = 1e-3;

/// A comparison: the difference of its sides and its slope by each column.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) order: Order,
    pub(crate) difference: f64,
    pub(crate) slopes: Vec<f64>,
    /// The same of the squares of its sides.
    pub(crate) squared: Vec<f64>,
}

impl Row {
    /// Returns true for an equality, and for an inequality at its bound.
    pub(crate) fn acts(&self) -> bool {
        match self.order {
            Order::Equal => true,
            Order::AtMost => {
                let size = self.slopes.iter().map(|s| s.abs()).fold(1.0, f64::max);
                self.difference.abs() <= AT_BOUND * size
            }
        }
    }
}

/// Returns the slots that a constraint reads and, as is written, never writes.
pub(crate) fn only_read(
    evaluator: &Evaluator<'_>,
    constraint: ConstraintInstance,
) -> BTreeSet<SlotId> {
    let structure = evaluator.structure;
    let class = &evaluator.document.classes[constraint.class];
    let paths = class.constraints[constraint.index as usize].reads.iter();
    let things = paths.filter_map(|path| structure.follow(constraint.owner, path).ok());
    things.flat_map(|thing| structure.slots_under(thing)).collect()
}

/// Returns which branches of its conditions a constraint takes, in order.
pub(crate) fn taken(evaluator: &Evaluator<'_>, constraint: ConstraintInstance) -> Vec<bool> {
    let class = &evaluator.document.classes[constraint.class];
    let rule = &class.constraints[constraint.index as usize].rule;
    evaluator.compared.take();
    evaluator.begin();
    // as far as it goes
    evaluator.judge(rule, &Frame::of(constraint.owner), None).ok();
    evaluator.compared.take().taken
}

/// Returns the rows of a constraint, with their slopes by some slots; nothing where it compares no
/// numbers, or others where they move, or is at a kink. By what the constraint never writes it has none.
pub(crate) fn rows(
    evaluator: &Evaluator<'_>,
    constraint: ConstraintInstance,
    columns: &[SlotId],
) -> Option<Vec<Row>> {
    let class = &evaluator.document.classes[constraint.class];
    let rule = &class.constraints[constraint.index as usize].rule;
    let held = only_read(evaluator, constraint);
    let compared = || -> Option<Compared> {
        evaluator.compared.take();
        evaluator.begin();
        let judged = evaluator.judge(rule, &Frame::of(constraint.owner), None);
        let compared = evaluator.compared.take();
        judged.ok().map(|_| compared).filter(|c| !c.differences.is_empty())
    };
    let (here, reads) = evaluator.listening(compared);
    let here = here?;
    let row = |(&difference, &order): (&f64, &Order)| Row {
        order,
        difference,
        slopes: vec![0.0; columns.len()],
        squared: vec![0.0; columns.len()],
    };
    let mut rows: Vec<Row> = here.differences.iter().zip(&here.orders).map(row).collect();
    let writes = |slot: &SlotId| reads.contains(slot) && !held.contains(slot);
    for (column, slot) in columns.iter().enumerate().filter(|(_, slot)| writes(slot)) {
        let x = evaluator.values.numbers[*slot];
        let step = NUDGE * x.abs().max(1.0);
        let (above, below) = (x + step, x - step);
        let [high, low] = [above, below].map(|x| evaluator.nudging(*slot, x, compared));
        let (high, low) = (high?, low?);
        if high.orders != here.orders || low.orders != here.orders {
            return None;
        }
        for (i, row) in rows.iter_mut().enumerate() {
            let [rise, fall] = [
                (high.differences[i] - row.difference) / (above - x),
                (row.difference - low.differences[i]) / (x - below),
            ];
            if (rise - fall).abs() > KINK * rise.abs().max(fall.abs()).max(1.0) {
                return None;
            }
            row.slopes[column] = (high.differences[i] - low.differences[i]) / (above - below);
            row.squared[column] = (high.squares[i] - low.squares[i]) / (above - below);
        }
    }
    Some(rows)
}
