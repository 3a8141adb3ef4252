//! Acceptance of large pieces: by sparse elimination what depends on what, by matching what may stay.
//!
//! In: a piece that matching alone could not decide. Out: the answer of elimination, or nothing. Rows are
//! eliminated over what is not given. Sums of them that vanish there leave given numbers: those have to
//! yield, and a sum that leaves none is a circuit. The pivots are a slot for each independent row, and
//! regular together; from these, matching holds what it can. Cost: that of sparse factors, where few
//! rows depend on others.

use crate::accept::{Acceptance, Dependent, Piece};
use crate::echelon::{Echelon, Row, Vanishing};
use crate::matching::Matcher;
use crate::rows::{Entry, Rows};
use crate::substitute::Classes;
use crate::system::{Level, SlotIndex, Stay};
use std::collections::BTreeMap;

/// What cancels to this part of its terms is zero.
const CANCELLED: f64 = 1e-8;

/// Decides for a piece; false where only full elimination can.
pub(crate) fn accept(
    classes: &Classes,
    rows: &Rows,
    matcher: &mut Matcher<'_>,
    piece: Piece<'_>,
    out: &mut Acceptance,
) -> bool {
    if !matcher.is_of_numbers(piece) {
        return false;
    }
    let is_open = |s: SlotIndex| match classes.stay[s as usize] {
        Stay::Kept { .. } | Stay::Free => true,
        Stay::Fixed | Stay::Given => false,
    };
    let own = |r: &u32| rows.columns(*r as usize).iter();
    let scales: Vec<f64> = piece
        .rows
        .iter()
        .map(|r| match largest(own(r).filter(|e| is_open(e.0))) {
            0.0 => 1.0,
            size => size,
        })
        .collect();
    let part = |kind: &dyn Fn(SlotIndex) -> bool| -> (Vec<SlotIndex>, Vec<Row>) {
        let mut columns: Vec<SlotIndex> =
            piece.rows.iter().flat_map(own).map(|e| e.0).filter(|&s| kind(s)).collect();
        columns.sort_unstable();
        columns.dedup();
        let place = |s: SlotIndex| columns.partition_point(|&c| c < s) as u32;
        let row = |(r, scale): (&u32, &f64)| {
            own(r).filter(|e| kind(e.0)).map(|&(s, value)| (place(s), value / scale)).collect()
        };
        let made = piece.rows.iter().zip(&scales).map(row).collect();
        (columns, made)
    };
    let (open, over_open) = part(&is_open);
    let (given, over_given) = part(&|s| classes.stay[s as usize] == Stay::Given);
    let eliminated = Echelon::new(&over_open, open.len());
    let vanishing = eliminated.vanishing();
    let left: Vec<Row> = vanishing.iter().map(|v| sum(&v.sum, &over_given)).collect();
    let circuits = circuits(&vanishing, &left, given.len());

    let pivots = eliminated.pivots().map(|(r, c)| (piece.rows[r as usize], open[c as usize]));
    if !matcher.hold(piece, pivots, out) {
        return false;
    }
    for &(column, _) in left.iter().flatten() {
        out.unknown[given[column as usize] as usize] = true;
    }
    let needs_given = |r: u32| vanishing.binary_search_by_key(&r, |v| v.last).is_ok();
    let mut circuits = circuits.into_iter().peekable();
    for (&row, r) in piece.rows.iter().zip(0..) {
        match circuits.next_if(|c| c.last == r) {
            Some(Vanishing { sum, .. }) => {
                let others = sum.iter().map(|e| e.0).filter(|&o| o != r);
                let circuit = others.map(|o| piece.rows[o as usize] as usize).collect();
                out.dependent.push(Dependent { row: row as usize, circuit });
            }
            None => {
                let is_required = rows[row as usize].level == Level::Required;
                out.determined += usize::from(is_required && !needs_given(r));
                out.accepted.push(row as usize);
            }
        }
    }
    true
}

/// Finds the sums of rows that vanish over given numbers too, of those that vanish over all else and leave
/// so much of given numbers.
fn circuits(vanishing: &[Vanishing], left: &[Row], given: usize) -> Vec<Vanishing> {
    let sums: Vec<Row> = vanishing.iter().map(|v| v.sum.clone()).collect();
    let scaled = |row: &Row| match largest(row.iter()) {
        0.0 => 1.0,
        size => size,
    };
    let scales: Vec<f64> = left.iter().map(scaled).collect();
    let again = Echelon::new(left, given).vanishing().into_iter().map(|v| {
        let parts: Row = v.sum.iter().map(|&(k, w)| (k, w / scales[k as usize])).collect();
        Vanishing { last: vanishing[v.last as usize].last, sum: sum(&parts, &sums) }
    });
    again.collect()
}

fn largest<'e>(entries: impl Iterator<Item = &'e Entry>) -> f64 {
    entries.fold(0.0, |most, e| most.max(e.1.abs()))
}

/// Adds rows up, each so many times.
fn sum(parts: &[Entry], rows: &[Row]) -> Row {
    let mut total: BTreeMap<u32, (f64, f64)> = BTreeMap::new();
    for &(r, weight) in parts {
        for &(column, value) in &rows[r as usize] {
            let entry = total.entry(column).or_insert((0.0, 0.0));
            entry.0 += weight * value;
            entry.1 = entry.1.max((weight * value).abs());
        }
    }
    let stays = |(column, (value, size)): (u32, (f64, f64))| {
        (value.abs() > CANCELLED * size).then_some((column, value))
    };
    total.into_iter().filter_map(stays).collect()
}
