//! Ties: places that curved rows tie to one that has no freedom yield with it.
//!
//! In: what may yield by acceptance, and which way. Out: the same, with every place to which an accepted
//! curved row (a length) ties a place that has no freedom left. Structure lets as few places
//! yield as the rows can do with, which in a chain of bars is every other joint: its elbows are soon
//! stretched, and a wish would be lost to stays that are weaker. Where all of the chain yields, the change is
//! least. A place with freedom (one end of a bar) reaches as far as it ever will, and so do linear
//! rows (midpoints, alignments, offsets), and a place that lies on a line through others, wherever they are:
//! these tie nothing; nor does a row that determines a lone number. A chain over a place on a rail is
//! stretched from what is wished or set, and yields whole, whatever freedom is left in it.

use crate::accept::Acceptance;
use crate::direct::{self, Direction};
use crate::lists::Lists;
use crate::order;
use crate::rows::Rows;
use crate::substitute::Classes;
use crate::system::{Level, SlotIndex, Stay, System};
use std::cell::OnceCell;

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
        Stay::Kept { group } => places.of(group),
        Stay::Fixed | Stay::Given(_) | Stay::Free => &[],
    };
    let sizes = OnceCell::new();
    let is_on_rail = |slot: SlotIndex| match classes.stay[slot as usize] {
        Stay::Kept { group } if place(slot).len() == 1 => {
            sizes.get_or_init(|| sizes_of_places(system))[group as usize] > 1
        }
        Stay::Kept { .. } | Stay::Fixed | Stay::Given(_) | Stay::Free => false,
    };
    let is_place = |slot: SlotIndex| place(slot).len() > 1 || is_on_rail(slot);
    let may_be_stiff = |r: usize| {
        let written = &system.relations[rows[r].relation as usize].methods;
        rows[r].curved && written.is_empty()
    };
    // whichever of its places a row determines: in a block it may be any
    let yields = unknown.clone();
    let is_line = |r: usize| {
        let mut columns = rows.columns(r).iter().filter(|e| yields[e.0 as usize]);
        columns.any(|e| place(e.0).len() > 1 && rows.is_line(r, place(e.0)))
    };
    let mut tied = false;
    for &r in &*accepted {
        let Some(slot) = direction.slot_of_row[r] else { continue };
        let is_stiff = may_be_stiff(r)
            && !free[slot as usize]
            && place(slot).len() > 1
            && rows.columns(r).iter().any(|e| !unknown[e.0 as usize])
            && !is_line(r);
        if !is_stiff {
            continue;
        }
        let columns = rows.columns(r).iter();
        for &s in columns.filter(|e| is_place(e.0)).flat_map(|e| place(e.0)) {
            tied |= !std::mem::replace(&mut unknown[s as usize], true);
        }
    }
    // what an edit sets is wished, and what a rule that speaks of it determines
    let is_edit = system.relations.iter().any(|relation| relation.rests);
    let is_set = |relation: u32| {
        let relation = &system.relations[relation as usize];
        let mut slots =
            system.equations_of(relation).iter().flat_map(|e| system.arguments(e.arguments));
        is_edit && !relation.rests && slots.any(|&s| system.slots[s as usize].stay == Stay::Fixed)
    };
    let has_rail = |&r: &usize| may_be_stiff(r) && rows.columns(r).iter().any(|e| is_on_rail(e.0));
    if accepted.iter().any(has_rail) {
        // a chain over a rail is stretched from what is wished, whatever freedom is left in it
        let is_wish = |r: &&usize| rows[**r].level == Level::Move || is_set(rows[**r].relation);
        let wished = accepted.iter().filter(is_wish).filter_map(|&r| direction.slot_of_row[r]);
        let rows_of = rows_of(rows, accepted, unknown.len());
        let mut reached: Vec<SlotIndex> = wished.collect();
        let mut is_reached = vec![false; unknown.len()];
        reached.iter().for_each(|&slot| is_reached[slot as usize] = true);
        let leads_on = |r: usize, from: SlotIndex| {
            let ties = |slot| is_place(slot) && !rows.is_line(r, place(slot));
            may_be_stiff(r)
                && direction.slot_of_row[r].is_some_and(ties)
                && !rows.is_line(r, &[from])
        };
        while let Some(from) = reached.pop() {
            let stretched = rows_of.of(from).iter().filter(|&&r| leads_on(r as usize, from));
            let columns = stretched.flat_map(|&r| rows.columns(r as usize));
            for &s in columns.filter(|e| is_place(e.0)).flat_map(|e| place(e.0)) {
                tied |= !std::mem::replace(&mut unknown[s as usize], true);
                if !std::mem::replace(&mut is_reached[s as usize], true) {
                    reached.push(s);
                }
            }
        }
    }
    acceptance.exchangeable = (is_known && !tied).then_some(free);
    tied
}

/// For every place, of how many coordinates it is.
fn sizes_of_places(system: &System) -> Vec<u32> {
    let mut sizes = Vec::new();
    for slot in &system.slots {
        if let Stay::Kept { group } = slot.stay {
            sizes.resize(sizes.len().max(group as usize + 1), 0);
            sizes[group as usize] += 1;
        }
    }
    sizes
}

/// For every slot: a slot that no row determines can be exchanged for it.
fn with_freedom(rows: &Rows, direction: &Direction, acceptance: &Acceptance) -> Vec<bool> {
    let rows_of = rows_of(rows, &acceptance.accepted, acceptance.unknown.len());
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

/// For every slot, the accepted rows that have it as a column.
fn rows_of(rows: &Rows, accepted: &[usize], slots: usize) -> Lists {
    let columns = |&r: &usize| rows.columns(r).iter().map(move |e| (e.0, r as u32));
    Lists::new(slots, accepted.iter().flat_map(columns))
}
