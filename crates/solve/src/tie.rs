//! Ties: places that curved rows tie to one that has no freedom yield with it.
//!
//! In: what may yield by acceptance, and which way. Out: the same, with every place to which an accepted
//! curved row (a length) ties a place that has no freedom left. Structure lets as few places
//! yield as the rows can do with, which in a chain of bars is every other joint: its elbows are soon
//! stretched, and a wish would be lost to stays that are weaker. Where all of the chain yields, the change is
//! least. A place with freedom (one end of a bar) reaches as far as it ever will, and so do linear
//! rows (midpoints, alignments, offsets), and a place that lies on a line through others, wherever they are:
//! these tie nothing; nor does a row that determines a lone number.

use crate::accept::Acceptance;
use crate::direct::{self, Direction};
use crate::lists::Lists;
use crate::order;
use crate::rows::Rows;
use crate::substitute::Classes;
use crate::system::{SlotIndex, Stay, System};

/// Lets tied places yield; `direction` is that of the acceptance. Returns true if any does.
pub(crate) fn tie(
    system: &System,
    classes: &Classes,
    rows: &Rows,
    direction: &Direction,
    acceptance: &mut Acceptance,
) -> bool {
    let is_kept = |slot: SlotIndex| {
        let stay = classes.stay[slot as usize];
        !acceptance.unknown[slot as usize] && matches!(stay, Stay::Kept { .. })
    };
    let may_tie = |&r: &usize| rows[r].curved && rows.columns(r).iter().any(|e| is_kept(e.0));
    if !acceptance.accepted.iter().any(may_tie) {
        return false;
    }
    let known = acceptance.matched.as_ref().filter(|_| direct::is_settled(system, acceptance));
    let exchangeable =
        known.and_then(|m| order::exchangeable(&m.blocks, rows, &acceptance.unknown, direction));
    let is_known = exchangeable.is_some();
    let free = exchangeable.unwrap_or_else(|| with_freedom(rows, direction, acceptance));
    let Acceptance { places, unknown, accepted, .. } = acceptance;
    let place = |slot: SlotIndex| match classes.stay[slot as usize] {
        Stay::Kept { group } => {
            let place = places.of(group);
            if place.len() > 1 { place } else { &[] }
        }
        Stay::Fixed | Stay::Given | Stay::Free => &[],
    };
    let mut tied = false;
    for &r in &*accepted {
        let row = rows[r];
        let stays = |&(c, _): &(SlotIndex, f64)| !unknown[c as usize] && !place(c).is_empty();
        let Some(slot) = direction.slot_of_row[r] else { continue };
        let is_stiff = row.curved
            && !free[slot as usize]
            && !place(slot).is_empty()
            && rows.columns(r).iter().any(stays)
            && !rows.is_line(r, place(slot))
            && system.relations[row.relation as usize].methods.is_empty();
        if !is_stiff {
            continue;
        }
        for &(c, _) in rows.columns(r) {
            for &s in place(c) {
                unknown[s as usize] = true;
                tied = true;
            }
        }
    }
    acceptance.exchangeable = (is_known && !tied).then_some(free);
    tied
}

/// For every slot: a slot that no row determines can be exchanged for it.
fn with_freedom(rows: &Rows, direction: &Direction, acceptance: &Acceptance) -> Vec<bool> {
    let columns = |&r: &usize| rows.columns(r).iter().map(move |e| (e.0, r as u32));
    let pairs = acceptance.accepted.iter().flat_map(columns);
    let rows_of = Lists::new(acceptance.unknown.len(), pairs);
    let mut free: Vec<bool> = (0..acceptance.unknown.len())
        .map(|s| acceptance.unknown[s] && direction.row_of_slot[s].is_none())
        .collect();
    let mut reached: Vec<usize> = (0..free.len()).filter(|&s| free[s]).collect();
    while let Some(slot) = reached.pop() {
        for &r in rows_of.of(slot as u32) {
            if let Some(next) = direction.slot_of_row[r as usize]
                && !std::mem::replace(&mut free[next as usize], true)
            {
                reached.push(next as usize);
            }
        }
    }
    free
}
