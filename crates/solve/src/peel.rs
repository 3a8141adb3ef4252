//! Peeling: rows that are solved one after the other, or two by two.
//!
//! In: rows without coefficients. Out: for every row the one slot that it determines, in an order in which
//! each reads only what stands before it; nothing where some rows do not go so. A row with one slot left that
//! may move without a given number's yielding says something of it that no row before does: it is accepted,
//! it is solved for that slot, and it comes next; what it only reads, or what shows in no derivative of it, it
//! waits for where another row determines it. Where no row has one slot left, two rows with the same two
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
    /// The slot that it determines.
    pub(crate) target: SlotIndex,
    /// Which of the row's arguments that is; of a row that is solved together with the next one, as many more
    /// as [`Solved::FIRST_OF_TWO`] says.
    marked: u32,
}

impl Solved {
    const FIRST_OF_TWO: u32 = 1 << 31;

    fn new(row: u32, target: SlotIndex, argument: u32, is_first_of_two: bool) -> Self {
        let mark = if is_first_of_two { Self::FIRST_OF_TWO } else { 0 };
        Self { row, target, marked: argument | mark }
    }
    /// Returns which of the row's arguments it determines.
    pub(crate) fn argument(self) -> u32 {
        self.marked & !Self::FIRST_OF_TWO
    }
    /// Returns true if the row is solved together with the next one.
    fn is_first_of_two(self) -> bool {
        self.marked & Self::FIRST_OF_TWO != 0
    }
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
            let is_discrete = system.slots[solved.target as usize].is_discrete;
            !is_discrete && !solved.is_first_of_two() && self.way(solved).is_formula
        })
    }
    /// Returns the rows that are solved together with what they determine.
    pub(crate) fn blocks(&self) -> Blocks {
        let count = self.order.len();
        let mut blocks = Blocks::with_room(count, count, count);
        for own in self.order.chunk_by(|solved, _| solved.is_first_of_two()) {
            let rows = own.iter().map(|solved| solved.row as usize);
            blocks.add(rows, own.iter().map(|solved| solved.target));
        }
        blocks
    }
    fn way(&self, solved: Solved) -> Way {
        let first = self.first[self.rows[solved.row as usize].kernel as usize];
        self.ways[(first + solved.argument()) as usize]
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
    if !has_slot_for_each(system, classes, &rows) {
        return Found::Not(rows);
    }
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
    if !rows::are_independent(&rows, classes.stay.len(), &twos(&order)) {
        return Found::Not(rows);
    }
    for (kernel, &own) in rows.kernels().iter().zip(&first) {
        kernel.stated().for_each(|(a, _)| ways[(own + a) as usize].is_stated = true);
    }
    // what is solved together needs no formula
    if !order.iter().any(|solved| solved.is_first_of_two()) {
        find_formulas(&rows, &order, &first, &mut ways);
    }
    Found::All(Peeled { rows, order, ways, first })
}

/// Returns true if rows speak of as many slots that may move as there are rows; most that do not all go one after
/// the other speak of more, which is quickly seen.
fn has_slot_for_each(system: &System, classes: &Classes, rows: &Rows) -> bool {
    let mut is_open: Vec<bool> = classes.stay.iter().map(|&stay| is_open(stay)).collect();
    let mut slots = 0;
    for r in 0..rows.len() {
        let reads = system.reads(&system.relations[rows[r].relation as usize]);
        for &slot in rows.mentions(r) {
            let is = |s: &SlotIndex| classes.representative[*s as usize] == slot;
            if is_open[slot as usize] && !reads.iter().any(is) {
                is_open[slot as usize] = false;
                slots += 1;
            }
        }
    }
    slots == rows.len()
}

/// Returns true if a slot may move without a given number's yielding.
fn is_open(stay: Stay) -> bool {
    matches!(stay, Stay::Kept { .. } | Stay::Free)
}

/// Finds out which rows have one formula for what they determine.
fn find_formulas(rows: &Rows, order: &[Solved], first: &[u32], ways: &mut [Way]) {
    let mut asked = vec![false; ways.len()];
    for solved in order {
        let kernel = rows[solved.row as usize].kernel as usize;
        let at = (first[kernel] + solved.argument()) as usize;
        if !std::mem::replace(&mut asked[at], true) {
            let formulas = rows.kernels()[kernel].solved(solved.argument());
            ways[at].is_formula = formulas.is_some_and(|s| s.guards.len() == 1);
        }
    }
}

/// Returns the rows that are solved two by two, each two with what they determine.
fn twos(order: &[Solved]) -> Vec<[(u32, SlotIndex); 2]> {
    let of = |two: &[Solved]| [two[0], two[1]].map(|solved| (solved.row, solved.target));
    order.windows(2).filter(|two| two[0].is_first_of_two()).map(of).collect()
}

/// What is left of a row: how many of its slots are not determined yet, and all of these in one number,
/// which is the last of them in the end, or with one of the last two says the other.
#[derive(Clone, Copy, PartialEq, Eq, Default)]
struct Left {
    count: u32,
    slots: u32,
}

impl Left {
    fn add(&mut self, slot: SlotIndex) {
        *self = Self { count: self.count + 1, slots: self.slots ^ slot };
    }
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
    let mut is_open: Vec<bool> = classes.stay.iter().map(|&stay| is_open(stay)).collect();
    // what a row reads and is never solved for
    let mut reading: Vec<(SlotIndex, u32)> = Vec::new();
    for (r, left) in (0..).zip(&mut left) {
        let row = rows[r as usize];
        let relation = &system.relations[row.relation as usize];
        let own = ways.get(*first.get(row.kernel as usize)? as usize..)?;
        if !relation.methods.is_empty() {
            return None;
        }
        let reads = system.reads(relation);
        for (way, &slot) in own.iter().zip(rows.mentions(r as usize)) {
            if !is_open[slot as usize] {
                continue;
            }
            let is = |s: &SlotIndex| classes.representative[*s as usize] == slot;
            if !way.shows || reads.iter().any(is) {
                reading.push((slot, r));
                continue;
            }
            if !system.slots[slot as usize].is_number {
                return None;
            }
            left.add(slot);
            pairs.push((slot, r));
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
    // what some row is solved for comes before those that read it
    reading.retain(|&(slot, _)| !is_open[slot as usize]);
    reading.sort_unstable();
    for &(slot, r) in &reading {
        left[r as usize].add(slot);
        pairs.push((slot, r));
    }
    let rows_of = Lists::new(classes.stay.len(), pairs.iter().copied());
    let mut next: Vec<u32> = Vec::with_capacity(rows.len());
    next.extend((0..).zip(&left).filter(|(_, left)| left.count == 1).map(|(r, _)| r));
    // what is determined is open again
    let is_determined = is_open;
    let order = Vec::with_capacity(rows.len());
    let twos = None;
    let mut peeling = Peeling { rows, rows_of, reading, left, is_determined, next, twos, order };
    let (mut done, mut looked) = (0, 0);
    while peeling.order.len() < rows.len() {
        if let Some(&row) = peeling.next.get(done) {
            done += 1;
            let Left { count: 1, slots: slot } = peeling.left[row as usize] else { return None };
            peeling.determine(row, slot, false)?;
            peeling.release(slot);
            continue;
        }
        let row = *peeling.twos().get(looked)?;
        looked += 1;
        if let Some([first, second]) = peeling.two_alike(row) {
            peeling.determine(first.0, first.1, true)?;
            peeling.determine(second.0, second.1, false)?;
            [first, second].iter().for_each(|two| peeling.release(two.1));
        }
    }
    Some(peeling.order)
}

/// Rows that are being put in order.
struct Peeling<'a> {
    rows: &'a Rows,
    /// For every slot, the rows that may be solved for it, or wait for it.
    rows_of: Lists,
    /// The slots that rows wait for and are never solved for, in order.
    reading: Vec<(SlotIndex, u32)>,
    left: Vec<Left>,
    is_determined: Vec<bool>,
    /// Rows that have one slot left, in order.
    next: Vec<u32>,
    /// Rows that came to have two, once somebody has asked for them.
    twos: Option<Vec<u32>>,
    order: Vec<Solved>,
}

impl Peeling<'_> {
    /// Returns true if a row is never solved for a slot.
    fn only_reads(&self, row: u32, slot: SlotIndex) -> bool {
        self.reading.binary_search(&(slot, row)).is_ok()
    }
    /// Puts a row next, for one of its slots; nothing where it only reads that.
    fn determine(&mut self, row: u32, slot: SlotIndex, is_first_of_two: bool) -> Option<()> {
        if self.only_reads(row, slot) {
            return None;
        }
        let mentions = self.rows.mentions(row as usize);
        let argument = mentions.iter().position(|&s| s == slot)? as u32;
        self.order.push(Solved::new(row, slot, argument, is_first_of_two));
        self.left[row as usize].count = 0;
        self.is_determined[slot as usize] = true;
        Some(())
    }
    /// Takes a slot that is determined from the rows that are left.
    fn release(&mut self, slot: SlotIndex) {
        for &r in self.rows_of.of(slot) {
            let left = &mut self.left[r as usize];
            if left.count == 0 {
                continue;
            }
            *left = Left { count: left.count - 1, slots: left.slots ^ slot };
            match left.count {
                1 => self.next.push(r),
                2 => self.twos.iter_mut().for_each(|twos| twos.push(r)),
                _ => {}
            }
        }
    }
    /// Returns the rows that have, or had, two slots left.
    fn twos(&mut self) -> &[u32] {
        let left = &self.left;
        let all = || (0..).zip(left).filter(|(_, left)| left.count == 2).map(|(r, _)| r).collect();
        self.twos.get_or_insert_with(all)
    }
    /// Finds another row with the same two slots left as this one has, if it still has two: both, each with
    /// one of the slots.
    fn two_alike(&self, row: u32) -> Option<[(u32, SlotIndex); 2]> {
        let Self { rows, rows_of, left, is_determined, .. } = self;
        let own = left[row as usize];
        let mentions = rows.mentions(row as usize);
        let may_be = |&slot: &SlotIndex| {
            let is_left = !is_determined[slot as usize] && !rows_of.of(slot).is_empty();
            is_left && mentions.contains(&(slot ^ own.slots))
        };
        let with = |slot: SlotIndex| {
            // many rows may speak of one of them
            let pair = [slot, slot ^ own.slots].map(|s| rows_of.of(s));
            let least = pair.into_iter().min_by_key(|rows| rows.len())?;
            let is_alike = |r: &&u32| **r != row && left[**r as usize] == own;
            let other = least.iter().find(is_alike).filter(|_| least.contains(&row))?;
            let two = [(row, slot), (*other, slot ^ own.slots)];
            two.iter().all(|&(row, slot)| !self.only_reads(row, slot)).then_some(two)
        };
        let slots = || mentions.iter().copied();
        (own.count == 2).then(|| slots().filter(may_be).find_map(with)).flatten()
    }
}
