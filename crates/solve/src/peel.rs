//! Peeling: rows that are solved one after the other.
//!
//! In: rows without coefficients. Out: for every row the one slot that it determines, in an order in which
//! each reads only what stands before it; nothing where some rows do not go so. A row with one slot left that
//! may move without a given number's yielding says something of it that no row before does: it is accepted,
//! it is solved for that slot, and it comes next. Where all rows go so, there is no other way to give each a
//! slot, no place can be held that a row determines, and every block is one row: acceptance, direction and
//! order are found in one pass, in time linear in what the rows speak of.

use crate::kernel::Kernel;
use crate::lists::Lists;
use crate::rows::Rows;
use crate::substitute::Classes;
use crate::system::{SlotIndex, Stay, System};
use std::rc::Rc;

/// Every row with what it determines, each after those that it reads.
#[derive(Debug)]
pub(crate) struct Peeled {
    pub(crate) rows: Rows,
    pub(crate) order: Vec<Solved>,
    /// What is known of every argument of every kernel, one kernel's after the other's.
    ways: Vec<Way>,
    /// Where those of each kernel begin.
    first: Vec<u32>,
}

/// A row and what it determines.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Solved {
    pub(crate) row: u32,
    /// Which of the row's arguments.
    pub(crate) argument: u32,
}

/// What is known of an argument of a kernel.
#[derive(Clone, Copy, Default, Debug)]
struct Way {
    /// True if a change of it shows at a generic point.
    shows: bool,
    /// True if there is one formula for it.
    is_formula: bool,
    /// True if it is one side of the equation.
    is_stated: bool,
    /// True if the kernel is curved.
    is_curved: bool,
}

impl Peeled {
    /// Returns the slot that a row determines.
    pub(crate) fn target(&self, solved: Solved) -> SlotIndex {
        self.rows.mentions(solved.row as usize)[solved.argument as usize]
    }
    /// Returns what a row says.
    pub(crate) fn kernel(&self, solved: Solved) -> &Rc<Kernel> {
        self.rows.kernel(solved.row as usize).expect("no row that is peeled is opaque")
    }
    /// Returns true if the row holds once it has been solved: what it determines is one of its sides.
    pub(crate) fn is_stated(&self, solved: Solved) -> bool {
        self.way(solved).is_stated
    }
    /// Returns true if a derivative of the row depends on what it speaks of.
    pub(crate) fn is_curved(&self, solved: Solved) -> bool {
        self.way(solved).is_curved
    }
    /// Returns true if every row has one formula for a number that need not be whole.
    pub(crate) fn is_by_formula(&self, system: &System) -> bool {
        self.order.iter().all(|&solved| {
            let is_discrete = system.slots[self.target(solved) as usize].is_discrete;
            !is_discrete && self.way(solved).is_formula
        })
    }
    fn way(&self, solved: Solved) -> Way {
        let first = self.first[self.rows[solved.row as usize].kernel as usize];
        self.ways[(first + solved.argument) as usize]
    }
}

/// What peeling takes.
pub(crate) enum Found {
    /// All rows.
    All(Peeled),
    /// Not all; these are the rows.
    Not(Rows),
}

/// Peels rows, where all go one after the other and no method is written for any.
pub(crate) fn peel(system: &System, classes: &Classes, rows: Rows) -> Found {
    let mut first = Vec::with_capacity(rows.kernels().len() + 1);
    let mut ways = Vec::new();
    for kernel in rows.kernels() {
        first.push(ways.len() as u32);
        let way = Way { is_curved: !kernel.is_linear(), ..Way::default() };
        ways.extend((0..kernel.arity()).map(|_| way));
        let own = ways.len() - kernel.arity();
        kernel.shown().for_each(|argument| ways[own + argument as usize].shows = true);
    }
    let Some(order) = order(system, classes, &rows, &first, &ways) else { return Found::Not(rows) };
    for (kernel, &own) in rows.kernels().iter().zip(&first) {
        kernel.stated().for_each(|(a, _)| ways[(own + a) as usize].is_stated = true);
    }
    let mut asked = vec![false; ways.len()];
    for solved in &order {
        let kernel = rows[solved.row as usize].kernel as usize;
        let at = (first[kernel] + solved.argument) as usize;
        if !std::mem::replace(&mut asked[at], true) {
            let formulas = rows.kernels()[kernel].solved(solved.argument);
            ways[at].is_formula = formulas.is_some_and(|s| s.guards.len() == 1);
        }
    }
    Found::All(Peeled { rows, order, ways, first })
}

/// What is left of a row: how many of its slots are not determined yet, and all of these in one number,
/// which is the last of them in the end.
#[derive(Clone, Copy, Default)]
struct Left {
    count: u32,
    slots: u32,
}

/// Orders the rows; nothing where some do not go one after the other.
fn order(
    system: &System,
    classes: &Classes,
    rows: &Rows,
    first: &[u32],
    ways: &[Way],
) -> Option<Vec<Solved>> {
    let mut left = vec![Left::default(); rows.len()];
    let mut pairs: Vec<(SlotIndex, u32)> = Vec::with_capacity(2 * rows.len());
    let mut is_open: Vec<bool> =
        classes.stay.iter().map(|stay| matches!(stay, Stay::Kept { .. } | Stay::Free)).collect();
    for (r, left) in (0..).zip(&mut left) {
        let row = rows[r as usize];
        let relation = &system.relations[row.relation as usize];
        let own = ways.get(*first.get(row.kernel as usize)? as usize..)?;
        if !relation.methods.is_empty() {
            return None;
        }
        for (way, &slot) in own.iter().zip(rows.mentions(r as usize)) {
            let is = |s: &SlotIndex| classes.representative[*s as usize] == slot;
            if way.shows && is_open[slot as usize] && !relation.reads.iter().any(is) {
                if !system.slots[slot as usize].is_number {
                    return None;
                }
                *left = Left { count: left.count + 1, slots: left.slots ^ slot };
                pairs.push((slot, r));
            }
        }
    }
    // a slot for each row, and none left over
    let mut slots = 0;
    for &(slot, _) in &pairs {
        slots += usize::from(std::mem::replace(&mut is_open[slot as usize], false));
    }
    if slots != rows.len() {
        return None;
    }
    let rows_of = Lists::new(classes.stay.len(), pairs.iter().copied());
    let mut next: Vec<u32> = Vec::with_capacity(rows.len());
    next.extend((0..).zip(&left).filter(|(_, left)| left.count == 1).map(|(r, _)| r));
    let mut order = Vec::with_capacity(rows.len());
    while let Some(&row) = next.get(order.len()) {
        let Left { count: 1, slots: slot } = left[row as usize] else { return None };
        let argument = rows.mentions(row as usize).iter().position(|&s| s == slot)? as u32;
        order.push(Solved { row, argument });
        for &r in rows_of.of(slot) {
            let left = &mut left[r as usize];
            *left = Left { count: left.count - 1, slots: left.slots ^ slot };
            if left.count == 1 {
                next.push(r);
            }
        }
    }
    (order.len() == rows.len()).then_some(order)
}
