//! What only follows: unknowns that a row states outright from those whose change is least before theirs counts.
//!
//! In: the rows and unknowns of a block of least change, and when the change of each unknown counts. Out: the rows
//! and unknowns that are left to be solved together, and what is computed after them, in order. What follows has no
//! say in how much the others change: where these have changed least it is what it is, and no curve of it stands in
//! their way.

use crate::lists::Lists;
use crate::lower::Problem;
use crate::system::{Level, SlotIndex, Turn};
use std::collections::VecDeque;

/// A block of least change, taken apart.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Apart {
    /// The rows that are solved together, by their place in the block.
    pub(crate) rows: Vec<usize>,
    /// Their unknowns.
    pub(crate) unknowns: Vec<SlotIndex>,
    /// The rows that follow, each with what it states, in the order in which they are computed.
    pub(crate) follow: Vec<(usize, SlotIndex)>,
}

/// Takes a block apart; nothing where nothing follows. The unknowns are in order. Cost: linear in what the rows
/// mention.
pub(crate) fn apart(problem: &Problem, turn: &dyn Fn(SlotIndex) -> Turn) -> Option<Apart> {
    let Problem { rows, unknowns } = problem;
    let turns: Vec<Turn> = unknowns.iter().map(|&u| turn(u)).collect();
    if turns.iter().all(|t| *t == turns[0]) {
        return None;
    }
    let place = |slot: &SlotIndex| unknowns.binary_search(slot).ok();
    // unknowns by row, each as often as it is mentioned, and rows by unknown
    let mentions: Vec<Vec<usize>> =
        rows.iter().map(|row| row.arguments.iter().filter_map(place).collect()).collect();
    let pairs = (0..).zip(&mentions).flat_map(|(r, own)| own.iter().map(move |&u| (u as u32, r)));
    let rows_of = Lists::new(unknowns.len(), pairs);
    let stated = |r: usize, u: usize| {
        let row = &rows[r];
        let mut stated = row.kernel.stated();
        row.level == Level::Required
            && stated.any(|(argument, _)| row.arguments[argument as usize] == unknowns[u])
    };

    // from outside in: what a row states that nothing else is left to mention
    let mut left: Vec<usize> = (0..unknowns.len()).map(|u| rows_of.of(u as u32).len()).collect();
    let mut row_of: Vec<Option<usize>> = vec![None; unknowns.len()];
    let mut stated_by: Vec<Option<usize>> = vec![None; rows.len()];
    let mut peeled = Vec::new();
    let mut ends: VecDeque<usize> = (0..unknowns.len()).filter(|&u| left[u] == 1).collect();
    while let Some(u) = ends.pop_front() {
        let row =
            rows_of.of(u as u32).iter().map(|&r| r as usize).find(|&r| stated_by[r].is_none());
        let Some(row) = row.filter(|&r| left[u] == 1 && stated(r, u)) else { continue };
        (row_of[u], stated_by[row]) = (Some(row), Some(u));
        peeled.push((row, u));
        for &other in &mentions[row] {
            left[other] -= 1;
            if left[other] == 1 {
                ends.push_back(other);
            }
        }
    }

    // what reads something whose change counts no earlier, and does not follow itself, does not follow; nor does what
    // is left to read
    let counts_too_late = |u: usize, r: usize, row_of: &[Option<usize>]| {
        mentions[r].iter().any(|&o| o != u && row_of[o].is_none() && turns[o] >= turns[u])
    };
    let mut stays: Vec<usize> =
        peeled.iter().filter(|&&(r, u)| counts_too_late(u, r, &row_of)).map(|p| p.1).collect();
    while let Some(u) = stays.pop() {
        let Some(row) = row_of[u].take() else { continue };
        stated_by[row] = None;
        stays.extend(mentions[row].iter().filter(|&&o| row_of[o].is_some()));
        for &r in rows_of.of(u as u32) {
            if let Some(reader) = stated_by[r as usize]
                && turns[u] >= turns[reader]
            {
                stays.push(reader);
            }
        }
    }
    let follow = peeled.iter().rev().filter(|&&(_, u)| row_of[u].is_some());
    let follow: Vec<(usize, SlotIndex)> = follow.map(|&(r, u)| (r, unknowns[u])).collect();
    let rows: Vec<usize> = (0..rows.len()).filter(|&r| stated_by[r].is_none()).collect();
    let together = unknowns.iter().zip(&row_of).filter(|(_, row)| row.is_none());
    let unknowns = together.map(|(&u, _)| u).collect();
    (!follow.is_empty() && !rows.is_empty()).then_some(Apart { rows, unknowns, follow })
}
