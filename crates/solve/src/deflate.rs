//! Acceptance of large pieces: by sparse elimination what depends on what, by matching what may stay.
//!
//! In: a piece that neither matching nor a tableau that stays small could decide. Out: the answer of
//! elimination, or nothing. Rows are eliminated over what is not given. Sums of them that vanish there
//! leave given numbers: defaults have to yield, where sums of these sums leave none what the document gives, and
//! one that leaves nothing is a circuit. The pivots are a slot
//! for each independent row, and regular together; from these, matching holds what it can. Where the
//! numbers do not bear that out, slots are eliminated by rows as rows were by slots. Cost: that of sparse
//! factors, where few depend on others.

use crate::accept::{Acceptance, Dependent, Piece};
use crate::echelon::{Echelon, Row, Vanishing};
use crate::matching::Matcher;
use crate::number::{Number, Sum};
use crate::rows::Rows;
use crate::substitute::Classes;
use crate::system::{Giver, Level, SlotIndex, Stay};
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// What cancels to this part of its terms is zero.
const CANCELLED: f64 = 1e-8;

/// The most slots that are held by elimination.
const HELD: usize = 400;

/// A piece whose rows were eliminated.
pub(crate) struct Deflated<'a, N> {
    classes: &'a Classes,
    piece: Piece<'a>,
    /// What is not given, in order of slots.
    open: Vec<SlotIndex>,
    /// The rows over it.
    over_open: Vec<Row<N>>,
    eliminated: Echelon<N>,
    /// Sums of rows that vanish over what is not given.
    vanishing: Vec<Vanishing<N>>,
    /// The given numbers that have to yield.
    yielding: Vec<SlotIndex>,
    /// Sums of rows that vanish over given numbers too.
    circuits: Vec<Vanishing<N>>,
}

/// Decides for a piece with these coefficients, row by row; false where only full elimination can.
pub(crate) fn accept<N: Number>(
    classes: &Classes,
    rows: &Rows,
    coefficients: &[Row<N>],
    matcher: &mut Matcher<'_>,
    piece: Piece<'_>,
    out: &mut Acceptance,
) -> bool {
    if !matcher.is_of_numbers(piece) {
        return false;
    }
    let deflated = Deflated::new(classes, coefficients, piece);
    let is_held = deflated.hold(matcher, out) || deflated.hold_by_elimination(out);
    if is_held {
        deflated.accept(rows, out);
    }
    is_held
}

impl<'a, N: Number> Deflated<'a, N> {
    pub(crate) fn new(classes: &'a Classes, coefficients: &[Row<N>], piece: Piece<'a>) -> Self {
        let is_open = |s: SlotIndex| match classes.stay[s as usize] {
            Stay::Kept { .. } | Stay::Free => true,
            Stay::Fixed | Stay::Given(_) => false,
        };
        let scale = |row: &Row<N>| size_of(row.iter().filter(|e| is_open(e.0)));
        let scales: Vec<f64> = coefficients.iter().map(scale).collect();
        let part = |kind: &dyn Fn(SlotIndex) -> bool| -> (Vec<SlotIndex>, Vec<Row<N>>) {
            let mut columns: Vec<SlotIndex> =
                coefficients.iter().flatten().map(|e| e.0).filter(|&s| kind(s)).collect();
            columns.sort_unstable();
            columns.dedup();
            let place = |s: SlotIndex| columns.partition_point(|&c| c < s) as u32;
            let row = |(row, scale): (&Row<N>, &f64)| {
                let own = row.iter().filter(|e| kind(e.0));
                own.map(|&(s, value)| (place(s), value.scaled_down(*scale))).collect()
            };
            let made = coefficients.iter().zip(&scales).map(row).collect();
            (columns, made)
        };
        let (open, over_open) = part(&is_open);
        let eliminated = Echelon::new(&over_open, open.len());
        let vanishing = eliminated.vanishing();
        let (mut circuits, mut yielding) = (vanishing.clone(), Vec::new());
        for giver in Giver::YIELDING {
            if circuits.is_empty() {
                break;
            }
            let (given, over_given) = part(&|s| classes.stay[s as usize] == Stay::Given(giver));
            let left: Vec<Row<N>> = circuits.iter().map(|v| sum(&v.sum, &over_given)).collect();
            yielding.extend(left.iter().flatten().map(|&(column, _)| given[column as usize]));
            circuits = vanishing_too(&circuits, &left, given.len());
        }
        Self { classes, piece, open, over_open, eliminated, vanishing, yielding, circuits }
    }

    /// Holds what the rows can do without, by matching from the pivots; false where the numbers do not bear
    /// it out.
    pub(crate) fn hold(&self, matcher: &mut Matcher<'_>, out: &mut Acceptance) -> bool {
        let slot = |(r, c): (u32, u32)| (self.piece.rows[r as usize], self.open[c as usize]);
        matcher.hold(self.piece, self.eliminated.pivots().map(slot), self.may_rest(), out)
    }
    /// Returns true if no given number yields: what yields may be read by what would rest.
    fn may_rest(&self) -> bool {
        self.yielding.is_empty()
    }

    /// Holds what the rows can do without, by eliminating slots, the first declared last; false where they are
    /// many, or where several yield as one.
    pub(crate) fn hold_by_elimination(&self, out: &mut Acceptance) -> bool {
        let rank = self.eliminated.rank();
        if self.piece.places().any(|place| place.len() > 1) || self.open.len() > rank + HELD {
            return false;
        }
        let willing = |&c: &u32| match self.classes.stay[self.open[c as usize] as usize] {
            Stay::Kept { group } => Some(Reverse(group)),
            Stay::Fixed | Stay::Given(_) | Stay::Free => None,
        };
        let mut columns: Vec<u32> = (0..self.open.len() as u32).collect();
        columns.sort_by_key(willing);
        let mut number = vec![0; columns.len()];
        for (&c, i) in columns.iter().zip(0..) {
            number[c as usize] = i as usize;
        }
        let mut by_column: Vec<Row<N>> = vec![Row::new(); columns.len()];
        for (row, r) in self.over_open.iter().zip(0..) {
            row.iter().for_each(|&(c, value)| by_column[number[c as usize]].push((r, value)));
        }
        for &slot in self.piece.places().flatten() {
            out.unknown[slot as usize] = self.open.binary_search(&slot).is_ok();
        }
        for held in Echelon::new(&by_column, self.over_open.len()).vanishing() {
            let column = columns[held.last as usize];
            if willing(&column).is_some() {
                out.unknown[self.open[column as usize] as usize] = false;
            }
        }
        true
    }

    /// Says which rows are accepted, which depend on others, and which given numbers yield.
    pub(crate) fn accept(&self, rows: &Rows, out: &mut Acceptance) {
        self.yielding.iter().for_each(|&slot| out.unknown[slot as usize] = true);
        let needs_given = |r: u32| self.vanishing.binary_search_by_key(&r, |v| v.last).is_ok();
        let mut circuits = self.circuits.iter().peekable();
        let mut accepted: Vec<u32> = Vec::new();
        for (&row, r) in self.piece.rows.iter().zip(0..) {
            match circuits.next_if(|c| c.last == r) {
                Some(Vanishing { sum, .. }) => {
                    let others = sum.iter().map(|e| e.0).filter(|&o| o != r);
                    let circuit = others.map(|o| self.piece.rows[o as usize] as usize).collect();
                    out.dependent.push(Dependent { row: row as usize, circuit });
                }
                None => {
                    let is_required = rows[row as usize].level == Level::Required;
                    out.determined += usize::from(is_required && !needs_given(r));
                    accepted.push(r);
                }
            }
        }
        if !self.circuits.is_empty() {
            self.let_rest(&mut accepted, out);
        }
        out.accepted.extend(accepted.iter().map(|&r| self.piece.rows[r as usize] as usize));
    }

    /// Takes from the accepted rows of the piece, where some rest, those that say nothing more over what still moves:
    /// what others imply there. The row of a circuit that was not accepted may be one of those that rest.
    fn let_rest(&self, accepted: &mut Vec<u32>, out: &mut Acceptance) {
        let moves = |e: &&(u32, N)| out.unknown[self.open[e.0 as usize] as usize];
        if !self.may_rest() || self.over_open.iter().all(|row| row.iter().any(|e| moves(&e))) {
            return;
        }
        let moving = |&r: &u32| self.over_open[r as usize].iter().filter(moves).copied().collect();
        let moving: Vec<Row<N>> = accepted.iter().map(moving).collect();
        let implied = Echelon::new(&moving, self.open.len()).vanishing();
        out.some_rest |= !implied.is_empty();
        let is_implied = |i: u32| implied.binary_search_by_key(&i, |v| v.last).is_ok();
        let mut places = 0..;
        accepted.retain(|_| !places.next().is_some_and(is_implied));
    }
}

/// Finds the sums of rows that vanish over these given numbers too, of those that vanish over all that yields
/// before and leave so much of them.
fn vanishing_too<N: Number>(
    vanishing: &[Vanishing<N>],
    left: &[Row<N>],
    given: usize,
) -> Vec<Vanishing<N>> {
    let sums: Vec<Row<N>> = vanishing.iter().map(|v| v.sum.clone()).collect();
    let scales: Vec<f64> = left.iter().map(|row| size_of(row.iter())).collect();
    let again = Echelon::new(left, given).vanishing().into_iter().map(|v| {
        let part = |&(k, w): &(u32, N)| (k, w.scaled_down(scales[k as usize]));
        let parts: Row<N> = v.sum.iter().map(part).collect();
        Vanishing { last: vanishing[v.last as usize].last, sum: sum(&parts, &sums) }
    });
    again.collect()
}

fn size_of<'e, N: Number + 'e>(entries: impl Iterator<Item = &'e (u32, N)>) -> f64 {
    match entries.fold(0.0f64, |most, e| most.max(e.1.size())) {
        0.0 => 1.0,
        size => size,
    }
}

/// Adds rows up, each so many times.
fn sum<N: Number>(parts: &[(u32, N)], rows: &[Row<N>]) -> Row<N> {
    let mut total: BTreeMap<u32, Sum<N>> = BTreeMap::new();
    for &(r, weight) in parts {
        for &(column, value) in &rows[r as usize] {
            total.entry(column).or_default().add(weight.times(value));
        }
    }
    let stays =
        |(column, sum): (u32, Sum<N>)| (!sum.cancels_to(CANCELLED)).then_some((column, sum.value));
    total.into_iter().filter_map(stays).collect()
}
