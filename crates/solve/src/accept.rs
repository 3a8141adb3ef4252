//! Acceptance: who may yield.
//!
//! In: the rows, level by level. Out: the rows that can hold together, the circuits of those that
//! cannot, and the slots that may move. A given number is a constant unless a row could not be
//! accepted otherwise. Of the rest, a place or lone number stays if the accepted rows can do without
//! it, asked in order of declaration, all its coordinates at once; but no given number that yields takes
//! its part in them: it changes least first, and what is computed follows. A place that rows determine all the same
//! stays too where those rest: they hold where the edit begins, and nothing that it speaks of moves them.
//!
//! All rows are first tried by matching, which is linear as a rule and certain where it says yes. Where it does
//! not, rows that share no slot that may move, by way of places either, are decided apart: a piece by matching
//! again, else by elimination: in a tableau and, where that fills up in a large piece, sparse.

use crate::deflate;
use crate::echelon::Row;
use crate::exact::{self, Came};
use crate::lists::Lists;
use crate::matching::Matcher;
use crate::number::Number;
use crate::order::Blocks;
use crate::rest::Resting;
use crate::rows::Rows;
use crate::sparse::{Pattern, Symbolic};
use crate::substitute::Classes;
use crate::system::{Giver, Level, SlotIndex, Stay, System};
use crate::union::Union;
use std::rc::Rc;

/// A row that depends on accepted ones.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Dependent {
    /// The row.
    pub(crate) row: usize,
    /// The accepted rows that it is a combination of.
    pub(crate) circuit: Vec<usize>,
}

/// Who holds and who yields.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Acceptance {
    /// The accepted rows, in order of acceptance.
    pub(crate) accepted: Vec<usize>,
    /// The others, in the same order.
    pub(crate) dependent: Vec<Dependent>,
    /// For every slot: it is a representative and the plan may write it.
    pub(crate) unknown: Vec<bool>,
    /// Given numbers that had to yield, over representatives.
    pub(crate) yielded: Vec<SlotIndex>,
    /// Motions that required relations leave with every given number held.
    pub(crate) freedom: usize,
    /// How many motions required relations take away.
    pub(crate) determined: usize,
    /// The large blocks that were found regular.
    pub(crate) factored: Vec<Factored>,
    /// True if some rows are not among the accepted because they hold where they are: all that they speak of stays.
    pub(crate) some_rest: bool,
    /// A slot for every row, where all were accepted by matching at once.
    pub(crate) matched: Option<Matched>,
    /// For every slot: nothing determines it, or it can be exchanged for one that nothing does; where that is known.
    pub(crate) exchangeable: Option<Vec<bool>>,
    /// The slots of every place that may be held, by its group, over representatives.
    pub(crate) places: Lists,
}

/// A slot of its own for every row, among those that may move.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Matched {
    /// For every row, its slot; none for one that rests.
    pub(crate) slot_of_row: Vec<Option<SlotIndex>>,
    /// For every slot, its row.
    pub(crate) row_of_slot: Vec<Option<usize>>,
    /// The blocks that rows and their slots fall into.
    pub(crate) blocks: Blocks,
}

/// A large block whose pivots are chosen.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Factored {
    /// Its rows, in order.
    pub(crate) rows: Vec<u32>,
    /// Its unknowns, in order.
    pub(crate) columns: Vec<SlotIndex>,
    /// Where the rows depend on the unknowns, both by position.
    pub(crate) pattern: Pattern,
    /// The pivots.
    pub(crate) symbolic: Rc<Symbolic>,
}

impl Acceptance {
    /// Returns how many given numbers yield, the firmest first, how many slots in all, and how many motions are taken
    /// away: the fewer the better, in this order.
    pub(crate) fn yields(&self, classes: &Classes) -> ([usize; 2], usize, usize) {
        let unknown = self.unknown.iter().filter(|u| **u).count();
        let of = |giver: Giver| {
            let is_of = |s: &&SlotIndex| classes.stay[**s as usize] == Stay::Given(giver);
            self.yielded.iter().filter(is_of).count()
        };
        ([of(Giver::Document), of(Giver::Class)], unknown, self.determined)
    }
    /// Takes from the accepted rows those that hold where they are.
    fn let_rest(&mut self, rows: &Rows, resting: &Resting) {
        if resting.is_empty() {
            return;
        }
        let Self { accepted, unknown, some_rest, .. } = self;
        let moves =
            |&r: &usize| !resting.has(r) || rows.columns(r).iter().any(|e| unknown[e.0 as usize]);
        let before = accepted.len();
        accepted.retain(moves);
        *some_rest |= accepted.len() < before;
    }
    /// Returns the pivots that suit a block, where it is one of those that were factorised.
    pub(crate) fn pivots(&self, rows: &[usize], unknowns: &[SlotIndex]) -> Option<&Factored> {
        self.factored.iter().find(|f| {
            f.columns == unknowns && f.rows.iter().map(|&r| r as usize).eq(rows.iter().copied())
        })
    }
}

/// Rows that have to be decided together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece<'a> {
    /// The rows, in order of acceptance.
    pub(crate) rows: &'a [u32],
    /// The places that may be held, in order of declaration.
    places: &'a [u32],
    all_places: &'a Lists,
}

impl<'a> Piece<'a> {
    /// Returns the places that may be held, each by its slots, in order of declaration.
    pub(crate) fn places(self) -> impl Iterator<Item = &'a [SlotIndex]> {
        self.places.iter().map(move |&p| self.all_places.of(p))
    }
}

/// Up to this many rows a piece is decided by a tableau of doubles, whatever that takes.
const LARGE: usize = 100;

/// For larger ones it may write so many times what the rows hold, and nothing may be in doubt; else residues
/// are asked, and then sparse elimination.
const MOST_WORK: usize = 16;

/// What acceptance is asked about.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setting<'a> {
    pub(crate) system: &'a System,
    pub(crate) classes: &'a Classes,
    pub(crate) rows: &'a Rows,
    /// Rows that nothing moves while what they speak of stays.
    pub(crate) resting: &'a Resting,
}

/// All rows in order of acceptance, and all places.
struct Asked {
    order: Vec<u32>,
    all_places: Lists,
    /// The places that may be held.
    places: Vec<u32>,
}

impl Asked {
    fn new(system: &System, classes: &Classes, rows: &Rows) -> Self {
        let mut order: Vec<u32> = (0..rows.len() as u32).collect();
        order.sort_by_key(|&r| rows[r as usize].level);
        let all_places = places(system, classes);
        let may_hold = |&p: &u32| !all_places.of(p).is_empty();
        let places = (0..all_places.len() as u32).filter(may_hold).collect();
        Self { order, all_places, places }
    }
    fn all(&self) -> Piece<'_> {
        Piece { rows: &self.order, places: &self.places, all_places: &self.all_places }
    }
}

/// Decides which rows are accepted and which slots stay.
pub(crate) fn accept(setting: Setting<'_>) -> Acceptance {
    let Setting { system, classes, rows, resting } = setting;
    let asked = Asked::new(system, classes, rows);
    let mut out = undecided(classes);
    let mut matcher = Matcher::new(setting);
    if matcher.accept(asked.all(), &mut out) {
        out.matched = Some(matcher.into_matched());
    } else {
        let failing = matcher.failing();
        matcher.forget();
        apart(classes, rows, asked.all(), &mut out, &mut |piece, out| {
            let may_match = failing.is_none_or(|row| !piece.rows.contains(&row));
            if may_match && matcher.accept(piece, out) {
                return;
            }
            let near = rows.doubles(piece.rows);
            let most = (piece.rows.len() > LARGE).then_some(MOST_WORK);
            let came = exact::accept(setting, &near, piece, most, out);
            if came == Came::All {
                return;
            }
            let is_too_much = came == Came::TooMuch;
            let mut eliminate = Eliminating { setting, matcher: &mut matcher, piece };
            match rows.residues(piece.rows) {
                Some(exact) => eliminate.with(&exact, is_too_much, out),
                None => eliminate.with(&near, true, out),
            }
        });
    }
    count(system, classes, &mut out);
    out.let_rest(rows, resting);
    out.places = asked.all_places;
    out
}

/// Accepts all rows, each of which determines a slot of its own, and no other row could determine it: these
/// slots move, and what nothing holds.
pub(crate) fn peeled(
    system: &System,
    classes: &Classes,
    rows: &Rows,
    is_determined: &[bool],
) -> Acceptance {
    let is_unknown = |s: usize| is_determined[s] || classes.stay[s] == Stay::Free;
    let unknown = (0..classes.stay.len()).map(|s| is_open(classes, s) && is_unknown(s)).collect();
    let required = (0..rows.len()).filter(|&r| rows[r].level == Level::Required);
    let mut out = Acceptance { unknown, determined: required.count(), ..Acceptance::default() };
    count(system, classes, &mut out);
    out
}

/// Returns true if a slot stands for itself, and may move without a given number's yielding.
fn is_open(classes: &Classes, slot: usize) -> bool {
    classes.representative[slot] == slot as u32
        && matches!(classes.stay[slot], Stay::Kept { .. } | Stay::Free)
}

/// Nothing is accepted yet, and all may move.
fn undecided(classes: &Classes) -> Acceptance {
    let unknown = (0..classes.stay.len()).map(|s| is_open(classes, s)).collect();
    Acceptance { unknown, ..Acceptance::default() }
}

/// Counts what is left free, and who yields.
fn count(system: &System, classes: &Classes, out: &mut Acceptance) {
    let n = system.slots.len();
    let movable = (0..n).filter(|&s| is_open(classes, s) && system.slots[s].is_number).count();
    out.freedom = movable.saturating_sub(out.determined);
    let is_given = |s: u32| classes.stay[s as usize].is_given();
    out.yielded = (0..n as u32).filter(|&s| is_given(s) && out.unknown[s as usize]).collect();
}

/// A large piece that is decided by elimination.
struct Eliminating<'a, 'p> {
    setting: Setting<'a>,
    matcher: &'p mut Matcher<'a>,
    piece: Piece<'p>,
}

impl Eliminating<'_, '_> {
    /// Decides with coefficients that are residues, or doubles where there are none; a tableau may be known to
    /// be too much work.
    fn with<N: Number>(
        &mut self,
        coefficients: &[Row<N>],
        is_too_much: bool,
        out: &mut Acceptance,
    ) {
        let Self { setting, ref mut matcher, piece } = *self;
        let Setting { classes, rows, .. } = setting;
        let tableau = |most, out: &mut Acceptance| {
            exact::accept(setting, coefficients, piece, most, out) == Came::All
        };
        let is_decided = !is_too_much && tableau(Some(MOST_WORK), out)
            || deflate::accept(classes, rows, coefficients, matcher, piece, out);
        if !is_decided {
            tableau(None, out);
        }
    }
}

/// Splits the rows into pieces and puts together what is decided for each.
fn apart(
    classes: &Classes,
    rows: &Rows,
    all: Piece<'_>,
    out: &mut Acceptance,
    decide_piece: &mut dyn FnMut(Piece<'_>, &mut Acceptance),
) {
    const NONE: u32 = u32::MAX;
    let n = classes.stay.len();
    let mut union = Union::new(n + rows.len());
    for r in 0..rows.len() {
        rows.columns(r).iter().for_each(|e| union.unite(e.0 as usize, n + r));
    }
    for slots in all.places() {
        slots.iter().for_each(|&s| union.unite(slots[0] as usize, s as usize));
    }
    let mut piece_of_root = vec![NONE; n + rows.len()];
    let mut pieces = 0;
    let mut rows_of = Vec::with_capacity(rows.len());
    for &r in all.rows {
        let piece = &mut piece_of_root[union.find(n + r as usize)];
        if *piece == NONE {
            *piece = pieces;
            pieces += 1;
        }
        rows_of.push((*piece, r));
    }
    let mut places_of = Vec::new();
    for (&place, slots) in all.places.iter().zip(all.places()) {
        match piece_of_root[union.find(slots[0] as usize)] {
            NONE => slots.iter().for_each(|&s| out.unknown[s as usize] = false),
            piece => places_of.push((piece, place)),
        }
    }
    let rows_of = Lists::new(pieces as usize, rows_of.iter().copied());
    let places_of = Lists::new(pieces as usize, places_of.iter().copied());
    for piece in 0..pieces {
        decide_piece(Piece { rows: rows_of.of(piece), places: places_of.of(piece), ..all }, out);
    }
    out.accepted.sort_by_key(|&r| (rows[r].level, r));
    out.dependent.sort_by_key(|d| (rows[d.row].level, d.row));
}

/// Returns the slots of every place that may be held, by its group, over representatives.
///
/// A coordinate that equals an earlier or firmer one is that one's, and stays where that does.
fn places(system: &System, classes: &Classes) -> Lists {
    let grouped = || {
        (0..).zip(&system.slots).filter_map(|(s, slot)| match slot.stay {
            Stay::Kept { group } => Some((group, classes.representative[s as usize])),
            Stay::Fixed | Stay::Given(_) | Stay::Free => None,
        })
    };
    let count = grouped().map(|g: (u32, u32)| g.0 as usize + 1).max().unwrap_or(0);
    let is_own = |&(group, slot): &(u32, u32)| classes.stay[slot as usize] == Stay::Kept { group };
    Lists::new(count, grouped().filter(is_own))
}

#[cfg(test)]
mod tests;
