//! Acceptance by matching: quick, and certain where it says yes.
//!
//! In: a piece. Out: the answer of elimination, or nothing. Every row is given a slot of its own among
//! those that may move without a given number's yielding; then every place is held that the rows can
//! do without, by giving its rows other slots. Where no way to another slot is found, none exists: the
//! numbers can only make the rank less than the structure. Where one is found, the numbers must bear
//! it out: the rows with their slots fall into strongly connected blocks, and if each of those is
//! regular at the generic point, the rows are independent without everything that was held.
//!
//! **Source:** Dulmage and Mendelsohn, *Coverings of bipartite graphs*, Canadian J. Math. 10 (1958).

use crate::accept::{Acceptance, Factored, Matched, Piece, Setting};
use crate::dense;
use crate::echelon::{Echelon, Row};
use crate::lists::Lists;
use crate::order::{Blocks, strong_components};
use crate::residue::Residue;
use crate::rest::{self, Resting};
use crate::rows::{REGULAR, Rows};
use crate::sparse::lu::POOR;
use crate::sparse::pivot::{self, How};
use crate::sparse::{Lu, Pattern, Symbolic};
use crate::substitute::Classes;
use crate::system::{Level, SlotIndex, Stay, System};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Up to this many unknowns a block is factorised densely.
const DENSE: usize = 16;
/// Up to this many unknowns the columns of a block are found by looking at all.
const FEW: usize = 4;

/// From so many unknowns on a chain may be too long for doubles to tell.
const LONG: usize = 100;

/// No row, no slot.
const NONE: u32 = u32::MAX;

/// Rows and their slots, for any number of pieces.
pub(crate) struct Matcher<'a> {
    system: &'a System,
    classes: &'a Classes,
    rows: &'a Rows,
    resting: &'a Resting,
    /// Where a row stands in its piece.
    position: Vec<u32>,
    slot_of_row: Vec<SlotIndex>,
    row_of_slot: Vec<u32>,
    /// What a slot may be used for.
    state: Vec<Use>,
    /// In which search a slot was met.
    seen: Vec<u32>,
    search: u32,
    /// The slots met in the latest search.
    met: Vec<SlotIndex>,
    /// The way of a search: each row on it, and how many of its slots were looked at.
    way: Vec<(u32, usize)>,
    /// The slots on that way.
    taken: Vec<SlotIndex>,
    /// Of the place that is to be held: what was closed, and the rows that came to rest with the slots that they had.
    closed: Vec<SlotIndex>,
    rested: Vec<(u32, SlotIndex)>,
    /// The blocks of the latest rows that were found regular.
    blocks: Blocks,
    /// A row of the latest piece at which matching could not decide.
    failing: Option<u32>,
}

/// A block of rows that is being factorised.
#[derive(Default)]
struct BlockScratch {
    rows: Vec<u32>,
    columns: Vec<SlotIndex>,
    /// Where a slot stands among the columns, if it does.
    place: Vec<u32>,
    matrix: Vec<f64>,
    swaps: Vec<usize>,
}

/// What a slot may be used for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Use {
    /// Nothing: it is known, given, or held.
    Closed,
    /// A row may take it.
    Open,
    /// It is a row's, no other way is left for that row, and it leads to one that does not rest.
    Rigid,
}

impl Use {
    /// What a slot that nobody has asked for yet may be used for.
    fn by(stay: Stay) -> Self {
        match stay {
            Stay::Kept { .. } | Stay::Free => Self::Open,
            Stay::Fixed | Stay::Given(_) => Self::Closed,
        }
    }
}

impl<'a> Matcher<'a> {
    pub(crate) fn new(setting: Setting<'a>) -> Self {
        let Setting { system, classes, rows, resting } = setting;
        let n = system.slots.len();
        let state = classes.stay.iter().map(|&stay| Use::by(stay));
        Self {
            system,
            classes,
            rows,
            resting,
            position: vec![NONE; rows.len()],
            slot_of_row: vec![NONE; rows.len()],
            row_of_slot: vec![NONE; n],
            state: state.collect(),
            seen: vec![0; n],
            search: 0,
            met: Vec::new(),
            way: Vec::new(),
            taken: Vec::new(),
            closed: Vec::new(),
            rested: Vec::new(),
            blocks: Blocks::default(),
            failing: None,
        }
    }

    /// Returns a row of the latest piece at which matching could not decide: whatever piece has it, apart
    /// from rows that share no slot with it, is no better off.
    pub(crate) fn failing(&self) -> Option<u32> {
        self.failing
    }

    /// Takes back everything that was decided.
    pub(crate) fn forget(&mut self) {
        self.slot_of_row.fill(NONE);
        self.row_of_slot.fill(NONE);
        for (state, &stay) in self.state.iter_mut().zip(&self.classes.stay) {
            *state = Use::by(stay);
        }
    }

    /// Returns the slots that were found for all rows of one piece that was accepted.
    pub(crate) fn into_matched(self) -> Matched {
        Matched {
            slot_of_row: self.slot_of_row.iter().map(|&s| (s != NONE).then_some(s)).collect(),
            row_of_slot: self
                .row_of_slot
                .iter()
                .map(|&r| (r != NONE).then_some(r as usize))
                .collect(),
            blocks: self.blocks,
        }
    }

    /// Decides for a piece; false where only elimination can.
    pub(crate) fn accept(&mut self, piece: Piece<'_>, out: &mut Acceptance) -> bool {
        if !self.is_of_numbers(piece) {
            return false;
        }
        for &row in piece.rows {
            if !self.take_most_willing(row) && !self.find(row) {
                self.failing = Some(row);
                return false;
            }
        }
        if !self.hold_places(piece, piece.rows, out) {
            return false;
        }
        let required =
            piece.rows.iter().filter(|&&r| self.rows[r as usize].level == Level::Required);
        out.determined += required.count();
        out.accepted.extend(piece.rows.iter().map(|&r| r as usize));
        true
    }

    /// Returns true if the rows of a piece speak of numbers alone.
    pub(crate) fn is_of_numbers(&self, piece: Piece<'_>) -> bool {
        let is_number = |r: &u32| {
            let columns = self.rows.columns(*r as usize);
            columns.iter().all(|e| self.system.slots[e.0 as usize].is_number)
        };
        piece.rows.iter().all(is_number)
    }

    /// Holds the places that rows can do without, from a slot for each that leaves all of them independent, or, where
    /// rows may rest, that hold where they are; false where the numbers do not bear it out.
    pub(crate) fn hold(
        &mut self,
        piece: Piece<'_>,
        pivots: impl Iterator<Item = (u32, SlotIndex)>,
        may_rest: bool,
        out: &mut Acceptance,
    ) -> bool {
        let slots = piece.rows.iter().flat_map(|&r| self.rows.columns(r as usize)).map(|e| e.0);
        for slot in slots.chain(piece.places().flatten().copied()) {
            self.state[slot as usize] = Use::by(self.classes.stay[slot as usize]);
            self.row_of_slot[slot as usize] = NONE;
        }
        let mut rows: Vec<u32> = Vec::with_capacity(piece.rows.len());
        for (row, slot) in pivots {
            self.give(row, slot);
            rows.push(row);
        }
        // what may not be held stays regular as it is
        if piece.places().next().is_none() {
            return true;
        }
        let resting = if may_rest { self.resting } else { &rest::NONE };
        let resting = std::mem::replace(&mut self.resting, resting);
        let is_held = self.hold_places(piece, &rows, out);
        self.resting = resting;
        is_held
    }

    /// Holds every place of a piece that its rows can do without; false where the numbers do not bear it out.
    fn hold_places(&mut self, piece: Piece<'_>, rows: &[u32], out: &mut Acceptance) -> bool {
        for place in piece.places() {
            self.hold_place(place);
        }
        let before = out.factored.len();
        let mut rows = Cow::Borrowed(rows);
        if !self.resting.is_empty() {
            rows.to_mut().retain(|&r| self.slot_of_row[r as usize] != NONE);
        }
        if !self.is_regular(rows, &mut out.factored) {
            out.factored.truncate(before);
            return false;
        }
        for &slot in piece.places().flatten() {
            out.unknown[slot as usize] = self.state[slot as usize] != Use::Closed;
        }
        true
    }

    /// Gives a row the most willing of its slots that is free: what is declared last yields first.
    fn take_most_willing(&mut self, row: u32) -> bool {
        let willing = |s: SlotIndex| match self.classes.stay[s as usize] {
            Stay::Fixed | Stay::Given(_) => 0,
            Stay::Kept { group } => 1 + u64::from(group),
            Stay::Free => u64::MAX,
        };
        let free = self.rows.columns(row as usize).iter().map(|e| e.0).filter(|&s| {
            self.state[s as usize] == Use::Open && self.row_of_slot[s as usize] == NONE
        });
        let Some(slot) = free.max_by_key(|&s| (willing(s), s)) else { return false };
        self.give(row, slot);
        true
    }
    fn give(&mut self, row: u32, slot: SlotIndex) {
        self.slot_of_row[row as usize] = slot;
        self.row_of_slot[slot as usize] = row;
    }

    /// Finds a slot for a row, moving other rows to other slots where that is needed.
    fn find(&mut self, row: u32) -> bool {
        self.search += 1;
        self.met.clear();
        let (mut way, mut slots) = (std::mem::take(&mut self.way), std::mem::take(&mut self.taken));
        way.clear();
        way.push((row, 0));
        slots.clear();
        let found = self.follow(&mut way, &mut slots);
        (self.way, self.taken) = (way, slots);
        found
    }
    /// Goes on with a search until a slot is found or no way is left.
    fn follow(&mut self, way: &mut Vec<(u32, usize)>, slots: &mut Vec<SlotIndex>) -> bool {
        while let Some(&(r, next)) = way.last() {
            let columns = self.rows.columns(r as usize);
            if next == 0 {
                let is_free = |s: SlotIndex| {
                    self.state[s as usize] == Use::Open && self.row_of_slot[s as usize] == NONE
                };
                if let Some(e) = columns.iter().rev().find(|e| is_free(e.0)) {
                    slots.push(e.0);
                    for (&(r, _), &s) in way.iter().zip(&*slots) {
                        self.slot_of_row[r as usize] = s;
                        self.row_of_slot[s as usize] = r;
                    }
                    return true;
                }
            }
            let found = (next..columns.len()).find(|&i| {
                let s = columns[columns.len() - 1 - i].0 as usize;
                self.state[s] == Use::Open && self.seen[s] != self.search
            });
            match found {
                Some(i) => {
                    let slot = columns[columns.len() - 1 - i].0;
                    way.last_mut().expect("the row was just seen").1 = i + 1;
                    self.seen[slot as usize] = self.search;
                    self.met.push(slot);
                    slots.push(slot);
                    way.push((self.row_of_slot[slot as usize], 0));
                }
                None => {
                    way.pop();
                    slots.pop();
                }
            }
        }
        false
    }

    /// Holds a place if every row finds a slot without it, or rests; else changes nothing that matters.
    fn hold_place(&mut self, place: &[SlotIndex]) {
        if place.iter().any(|&s| self.state[s as usize] == Use::Rigid) {
            return;
        }
        self.closed.clear();
        self.rested.clear();
        for (i, &slot) in place.iter().enumerate() {
            if std::mem::replace(&mut self.state[slot as usize], Use::Closed) == Use::Closed {
                continue;
            }
            self.closed.push(slot);
            let row = std::mem::replace(&mut self.row_of_slot[slot as usize], NONE);
            if row == NONE || self.find(row) {
                continue;
            }
            if self.may_rest(row) {
                self.rested.push((row, slot));
                for &slot in &self.met {
                    let row = std::mem::replace(&mut self.row_of_slot[slot as usize], NONE);
                    self.state[slot as usize] = Use::Closed;
                    self.rested.push((row, slot));
                }
                continue;
            }
            // what was closed before opens again; rows that found other slots may keep them
            self.give(row, slot);
            for i in 0..self.rested.len() {
                let (row, slot) = self.rested[i];
                self.give(row, slot);
                self.state[slot as usize] = Use::Open;
            }
            self.closed.iter().for_each(|&s| self.state[s as usize] = Use::Open);
            if i == 0 {
                self.stiffen(slot);
            }
            return;
        }
        self.rested.iter().for_each(|&(row, _)| self.slot_of_row[row as usize] = NONE);
    }
    /// Returns true if a row that found no slot rests, and all rows that were met do: they hold where everything
    /// that they speak of stays.
    fn may_rest(&self, row: u32) -> bool {
        let owners = self.met.iter().map(|&s| self.row_of_slot[s as usize]);
        std::iter::once(row).chain(owners).all(|r| self.may_rest_alone(r))
    }
    /// Returns true if a row rests, whatever those do that it leads to, unless they are known not to.
    fn may_rest_alone(&self, row: u32) -> bool {
        let is_stiff = |e: &(SlotIndex, f64)| self.state[e.0 as usize] == Use::Rigid;
        let row = row as usize;
        self.resting.has(row) && !self.rows.columns(row).iter().any(is_stiff)
    }
    /// Notes that whatever was met leads to nothing but what was met, once a row could not do without its slot;
    /// where rows rest, only what leads to one that does not.
    fn stiffen(&mut self, slot: SlotIndex) {
        self.met.push(slot);
        if !self.resting.is_empty() {
            let mut stiff = std::mem::take(&mut self.met);
            let owner = |s: SlotIndex| self.row_of_slot[s as usize];
            let own: BTreeMap<u32, SlotIndex> = stiff.iter().map(|&s| (owner(s), s)).collect();
            let mut from: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
            for &r in own.keys() {
                for &(s, _) in self.rows.columns(r as usize) {
                    let next = owner(s);
                    if next != r && own.contains_key(&next) {
                        from.entry(next).or_default().push(r);
                    }
                }
            }
            let mut reached: BTreeSet<u32> =
                own.keys().copied().filter(|&r| !self.may_rest_alone(r)).collect();
            let mut next: Vec<u32> = reached.iter().copied().collect();
            while let Some(r) = next.pop() {
                let before = from.get(&r).into_iter().flatten();
                next.extend(before.copied().filter(|&r| reached.insert(r)));
            }
            stiff.retain(|&s| reached.contains(&owner(s)));
            self.met = stiff;
        }
        self.met.iter().for_each(|&s| self.state[s as usize] = Use::Rigid);
    }

    /// Returns true if every block of rows and their slots is regular at the generic point.
    fn is_regular(&mut self, mut rows: Cow<'_, [u32]>, factored: &mut Vec<Factored>) -> bool {
        // numbered in order of declaration, as blocks are
        if !rows.is_sorted() {
            rows.to_mut().sort_unstable();
        }
        for (i, &r) in (0..).zip(&*rows) {
            self.position[r as usize] = i;
        }
        // a row may mention what a row of another piece takes
        let place = |owner: u32| {
            let at = self.position[owner as usize];
            (rows.get(at as usize) == Some(&owner)).then_some(at)
        };
        let owners = |&r: &u32| {
            let owners = self.rows.mentions(r as usize).iter().filter_map(|&s| self.taken_by(s));
            owners.filter(move |&owner| owner != r).filter_map(place)
        };
        let mut before = Lists::with_room(rows.len(), 4 * rows.len());
        rows.iter().for_each(|r| before.push_each(owners(r)));
        let mut blocks = Blocks::with_room(rows.len(), rows.len(), rows.len());
        let mut regular = true;
        let mut scratch = BlockScratch::default();
        strong_components(&before, &mut |block| {
            let own = || block.iter().map(|&i| rows[i as usize]);
            if block.len() > 1 && regular {
                scratch.rows.clear();
                scratch.rows.extend(own());
                sort_among(&mut scratch.rows, self.rows.len());
                regular = self.is_regular_block(&mut scratch, factored);
                if !regular {
                    self.failing = scratch.rows.first().copied();
                }
            }
            blocks.add(own().map(|r| r as usize), own().map(|r| self.slot_of_row[r as usize]));
        });
        self.blocks = blocks;
        regular
    }
    fn taken_by(&self, slot: SlotIndex) -> Option<u32> {
        let row = self.row_of_slot[slot as usize];
        (row != NONE && self.state[slot as usize] != Use::Closed).then_some(row)
    }

    fn is_regular_block(&self, scratch: &mut BlockScratch, factored: &mut Vec<Factored>) -> bool {
        let BlockScratch { rows: block, columns, place, matrix, swaps } = scratch;
        columns.clear();
        columns.extend(block.iter().map(|&r| self.slot_of_row[r as usize]));
        sort_among(columns, self.row_of_slot.len());
        let n = block.len();
        if n > FEW {
            place.resize(self.row_of_slot.len(), NONE);
            for (&slot, at) in columns.iter().zip(0..) {
                place[slot as usize] = at;
            }
        }
        let entries = |r: u32| {
            let own = self.rows.columns(r as usize).iter();
            let at = |slot: SlotIndex| {
                if n <= FEW {
                    return columns.iter().position(|&c| c == slot);
                }
                // what is left of another block does no harm
                let at = place[slot as usize] as usize;
                (columns.get(at) == Some(&slot)).then_some(at)
            };
            own.filter_map(move |e| Some((at(e.0)?, e.1)))
        };
        if n <= DENSE {
            matrix.clear();
            matrix.resize(n * n, 0.0);
            for (i, &r) in block.iter().enumerate() {
                entries(r).for_each(|(c, value)| matrix[i * n + c] = value);
            }
            let factors = dense::factorise(matrix, n, swaps);
            return factors.sign != 0 && factors.ratio > REGULAR;
        }
        let most = block.iter().map(|&r| self.rows.columns(r as usize).len()).sum();
        let (mut pattern, mut values) = (Pattern::with_room(n, n, most), Vec::with_capacity(most));
        for &r in block.iter() {
            pattern.push(entries(r).map(|(c, _)| c as u32));
            values.extend(entries(r).map(|e| e.1));
        }
        let mut lu = Lu::default();
        let choose = |how| Symbolic::new(pivot::choose(&pattern, &values, how));
        let mut tells = |symbolic: &Symbolic, least: f64| {
            symbolic.factorise(&pattern, &values, &mut lu).map(|f| {
                f.sign != 0 && (f.ratio > least || symbolic.gives_back(&pattern, &values, &mut lu))
            })
        };
        let mut symbolic = choose(How::Paired);
        let mut told = tells(&symbolic, POOR);
        let mut exact = None;
        if told == Some(false) && n > LONG {
            exact = self.residues(block, columns);
            let numbers = |exact: &Vec<Row<Residue>>| -> Vec<Residue> {
                exact.iter().flatten().map(|e| e.1).collect()
            };
            told = exact.as_ref().and_then(|exact| symbolic.is_regular(&pattern, &numbers(exact)));
            if told == Some(false) {
                return false;
            }
        }
        if told != Some(true) {
            symbolic = choose(How::Single);
            if tells(&symbolic, REGULAR) != Some(true) {
                if exact.is_none() && n > LONG {
                    exact = self.residues(block, columns);
                }
                return exact.is_some_and(|exact| Echelon::new(&exact, n).rank() == n);
            }
        }
        let (rows, columns) = (block.clone(), columns.clone());
        factored.push(Factored { rows, columns, pattern, symbolic: Rc::new(symbolic) });
        true
    }

    /// Returns the coefficients of a block in a finite field, by place among its columns.
    fn residues(&self, block: &[u32], columns: &[SlotIndex]) -> Option<Vec<Row<Residue>>> {
        let mut exact = self.rows.residues(block)?;
        for row in &mut exact {
            row.retain_mut(|(slot, _)| {
                let place = columns.binary_search(slot);
                place.map(|place| *slot = place as u32).is_ok()
            });
        }
        Some(exact)
    }
}

/// Sorts numbers below an end, no two of which are equal.
fn sort_among(numbers: &mut Vec<u32>, end: usize) {
    const MANY: usize = 1000;
    const PART: usize = 16;
    if numbers.len() < MANY.max(end / PART) {
        numbers.sort_unstable();
        return;
    }
    // where they are many it is quicker to go through all and ask which are there
    let mut is_there = vec![false; end];
    numbers.iter().for_each(|&i| is_there[i as usize] = true);
    numbers.clear();
    numbers.extend((0..).zip(is_there).filter(|(_, is_there)| *is_there).map(|(i, _)| i));
}
