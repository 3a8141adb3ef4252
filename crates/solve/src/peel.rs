//! Peeling: rows that are solved one after the other, or two by two.
//!
//! In: rows without coefficients. Out: for every row the one slot that it determines, in an order in which
//! each reads only what stands before it; nothing where some rows do not go so. A row with one slot left that
//! may move without a given number's yielding says something of it that no row before does: it is accepted,
//! it is solved for that slot, and it comes next. Where no row has one slot left, two rows with the same two
//! left, as those of two bars that meet, come next together, if they are independent at the generic point.
//! Where all rows go so, no row can be given a slot of another block, no place can be held that a row
//! determines, and every block is one row or two: acceptance, direction and order are found in one pass, in
//! time linear in what the rows speak of.

use crate::kernel::Kernel;
use crate::lists::Lists;
use crate::order::Blocks;
use crate::rows::{self, Rows};
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
    /// True if the row is solved together with the next one.
    is_first_of_two: bool,
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
            !is_discrete && !solved.is_first_of_two && self.way(solved).is_formula
        })
    }
    /// Returns the rows that are solved together with what they determine.
    pub(crate) fn blocks(&self) -> Blocks {
        let count = self.order.len();
        let mut blocks = Blocks::with_room(count, count, count);
        for own in self.order.chunk_by(|solved, _| solved.is_first_of_two) {
            let rows = own.iter().map(|solved| solved.row as usize);
            blocks.add(rows, own.iter().map(|&solved| self.target(solved)));
        }
        blocks
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
    if !rows::are_independent(&rows, classes.stay.len(), &twos(&rows, &order)) {
        return Found::Not(rows);
    }
    for (kernel, &own) in rows.kernels().iter().zip(&first) {
        kernel.stated().for_each(|(a, _)| ways[(own + a) as usize].is_stated = true);
    }
    // what is solved together needs no formula
    if !order.iter().any(|solved| solved.is_first_of_two) {
        find_formulas(&rows, &order, &first, &mut ways);
    }
    Found::All(Peeled { rows, order, ways, first })
}

/// Finds out which rows have one formula for what they determine.
fn find_formulas(rows: &Rows, order: &[Solved], first: &[u32], ways: &mut [Way]) {
    let mut asked = vec![false; ways.len()];
    for solved in order {
        let kernel = rows[solved.row as usize].kernel as usize;
        let at = (first[kernel] + solved.argument) as usize;
        if !std::mem::replace(&mut asked[at], true) {
            let formulas = rows.kernels()[kernel].solved(solved.argument);
            ways[at].is_formula = formulas.is_some_and(|s| s.guards.len() == 1);
        }
    }
}

/// Returns the rows that are solved two by two, each two with what they determine.
fn twos(rows: &Rows, order: &[Solved]) -> Vec<[(u32, SlotIndex); 2]> {
    let target = |s: &Solved| (s.row, rows.mentions(s.row as usize)[s.argument as usize]);
    let of = |two: &[Solved]| [&two[0], &two[1]].map(target);
    order.windows(2).filter(|two| two[0].is_first_of_two).map(of).collect()
}

/// What is left of a row: how many of its slots are not determined yet, and all of these in one number,
/// which is the last of them in the end, or with one of the last two says the other.
#[derive(Clone, Copy, PartialEq, Eq, Default)]
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
        let reads = &relation.reads[..];
        for (way, &slot) in own.iter().zip(rows.mentions(r as usize)) {
            let is = |s: &SlotIndex| classes.representative[*s as usize] == slot;
            if way.shows && is_open[slot as usize] && !reads.iter().any(is) {
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
    let with =
        |count| (0..).zip(&left).filter(move |l: &(u32, &Left)| l.1.count == count).map(|l| l.0);
    let mut next: Vec<u32> = Vec::with_capacity(rows.len());
    next.extend(with(1));
    let mut twos: Vec<u32> = with(2).collect();
    let (mut done, mut looked) = (0, 0);
    let mut order: Vec<Solved> = Vec::with_capacity(rows.len());
    let mut found: Vec<(u32, SlotIndex)> = Vec::with_capacity(2);
    while order.len() < rows.len() {
        found.clear();
        if let Some(&row) = next.get(done) {
            done += 1;
            let Left { count: 1, slots: slot } = left[row as usize] else { return None };
            found.push((row, slot));
        } else {
            let row = *twos.get(looked)?;
            looked += 1;
            // what is determined is open again
            let is_left = |slot: SlotIndex| !is_open[slot as usize] && !rows_of.of(slot).is_empty();
            let two = two_alike(row, &left, &rows_of, rows.mentions(row as usize), &is_left);
            found.extend(two.into_iter().flatten());
        }
        let is_two = found.len() > 1;
        for (at, &(row, slot)) in found.iter().enumerate() {
            let argument = rows.mentions(row as usize).iter().position(|&s| s == slot)? as u32;
            order.push(Solved { row, argument, is_first_of_two: is_two && at == 0 });
            left[row as usize].count = 0;
            is_open[slot as usize] = true;
        }
        for &(_, slot) in &found {
            for &r in rows_of.of(slot) {
                let left = &mut left[r as usize];
                if left.count > 0 {
                    *left = Left { count: left.count - 1, slots: left.slots ^ slot };
                    match left.count {
                        1 => next.push(r),
                        2 => twos.push(r),
                        _ => {}
                    }
                }
            }
        }
    }
    Some(order)
}

/// Finds another row with the same two slots left as this one has, if it still has two: both, each with one of
/// the slots.
fn two_alike(
    row: u32,
    left: &[Left],
    rows_of: &Lists,
    mentions: &[SlotIndex],
    is_left: &dyn Fn(SlotIndex) -> bool,
) -> Option<[(u32, SlotIndex); 2]> {
    let own = left[row as usize];
    let with = |slot: SlotIndex| {
        // many rows may speak of one of them
        let pair = [slot, slot ^ own.slots].map(|s| rows_of.of(s));
        let least = pair.into_iter().min_by_key(|rows| rows.len())?;
        let is_alike = |r: &&u32| **r != row && left[**r as usize] == own;
        let other = least.iter().find(is_alike).filter(|_| least.contains(&row))?;
        Some([(row, slot), (*other, slot ^ own.slots)])
    };
    let may_be = |&slot: &SlotIndex| is_left(slot) && mentions.contains(&(slot ^ own.slots));
    let slots = || mentions.iter().copied();
    (own.count == 2).then(|| slots().filter(may_be).find_map(with)).flatten()
}
