//! Direction: which way each row is solved.
//!
//! In: accepted rows and unknown slots. Out: a matching that gives each row a slot of its own, and the
//! written methods that were chosen: relations choose in order of declaration the first of their
//! methods whose targets are all unknown and that leaves every other row a slot.

use crate::accept::{Acceptance, Matched};
use crate::rows::Rows;
use crate::substitute::Classes;
use crate::system::{SlotIndex, System};

/// Which way.
#[derive(Clone, Debug, Default)]
pub(crate) struct Direction {
    /// For every row, the slot that it determines; none for a row that was not accepted.
    pub(crate) slot_of_row: Vec<Option<SlotIndex>>,
    /// For every slot, the row that determines it.
    pub(crate) row_of_slot: Vec<Option<usize>>,
    /// Every relation with the written method that was chosen, in order.
    pub(crate) methods: Vec<(u32, u32)>,
    /// Every slot that a method writes beyond its relation's rows, with that relation's first row, in
    /// order.
    pub(crate) written_by: Vec<(SlotIndex, usize)>,
}

impl Direction {
    /// Returns the written method that was chosen for a relation.
    pub(crate) fn method_of(&self, relation: u32) -> Option<u32> {
        let at = self.methods.binary_search_by_key(&relation, |m| m.0).ok()?;
        Some(self.methods[at].1)
    }
    /// Returns true if a method writes the slot beyond its relation's rows.
    pub(crate) fn is_written(&self, slot: SlotIndex) -> bool {
        self.written_by.binary_search_by_key(&slot, |w| w.0).is_ok()
    }
}

struct Matching<'a> {
    rows: &'a Rows,
    open: Vec<bool>,
    fixed_row: Vec<bool>,
    slot_of_row: Vec<Option<SlotIndex>>,
    row_of_slot: Vec<Option<usize>>,
    seen: Vec<u32>,
    round: u32,
    /// Rows that were given other slots since a method was tried, with those that they had.
    changed: Vec<(usize, Option<SlotIndex>)>,
}

/// Matches rows and slots and chooses methods. Where acceptance has found the way, it is taken over.
pub(crate) fn direct(
    system: &System,
    classes: &Classes,
    rows: &Rows,
    acceptance: &mut Acceptance,
) -> Direction {
    let is_settled = is_settled(system, acceptance);
    let (slot_of_row, row_of_slot) = match &mut acceptance.matched {
        Some(Matched { slot_of_row, row_of_slot, .. }) if is_settled => {
            (std::mem::take(slot_of_row), std::mem::take(row_of_slot))
        }
        Some(known) => (known.slot_of_row.clone(), known.row_of_slot.clone()),
        None => (vec![None; rows.len()], vec![None; acceptance.unknown.len()]),
    };
    let known = Direction { slot_of_row, row_of_slot, ..Direction::default() };
    match is_settled {
        true => known,
        false => direct_from(system, classes, rows, acceptance, known),
    }
}

/// Returns true if the direction is what acceptance found, whatever else may yield: every row has its slot, and
/// no method is written.
pub(crate) fn is_settled(system: &System, acceptance: &Acceptance) -> bool {
    acceptance.matched.is_some() && system.relations.iter().all(|r| r.methods.is_empty())
}

/// Chooses methods from a direction in which some rows have slots already; the others find theirs.
pub(crate) fn direct_from(
    system: &System,
    classes: &Classes,
    rows: &Rows,
    acceptance: &Acceptance,
    known: Direction,
) -> Direction {
    let mut m = Matching::new(rows, acceptance, known);
    let mut with_methods: Vec<usize> = acceptance
        .accepted
        .iter()
        .copied()
        .filter(|&r| !system.relations[rows[r].relation as usize].methods.is_empty())
        .collect();
    with_methods.sort_unstable();
    let mut methods = Vec::new();
    let mut written_by = Vec::new();
    for own in with_methods.chunk_by(|&a, &b| rows[a].relation == rows[b].relation) {
        let relation = rows[own[0]].relation;
        for (index, written) in (0..).zip(&system.relations[relation as usize].methods) {
            let targets: Vec<SlotIndex> =
                written.targets.iter().map(|&t| classes.representative[t as usize]).collect();
            if m.force(own, &targets) {
                methods.push((relation, index));
                written_by.extend(targets[own.len()..].iter().map(|&t| (t, own[0])));
                break;
            }
        }
    }
    written_by.sort_unstable();
    Direction { slot_of_row: m.slot_of_row, row_of_slot: m.row_of_slot, methods, written_by }
}

impl<'a> Matching<'a> {
    /// Matches the accepted rows that have no slot yet.
    fn new(rows: &'a Rows, acceptance: &Acceptance, known: Direction) -> Self {
        let mut matching = Self {
            rows,
            open: acceptance.unknown.clone(),
            fixed_row: vec![false; rows.len()],
            seen: vec![0; known.row_of_slot.len()],
            slot_of_row: known.slot_of_row,
            row_of_slot: known.row_of_slot,
            round: 0,
            changed: Vec::new(),
        };
        for &row in &acceptance.accepted {
            if matching.slot_of_row[row].is_none() {
                matching.match_row(row);
            }
        }
        matching
    }
    /// Finds a slot for a row, moving other rows to other slots where that is needed.
    fn match_row(&mut self, row: usize) -> bool {
        let mut columns = self.rows.columns(row).iter().rev().map(|e| e.0);
        if let Some(free) = columns.find(|&c| self.is_free(c)) {
            self.give(row, Some(free));
            return true;
        }
        self.round += 1;
        // an explicit stack: (row, next column); the path is undone from its end
        let mut stack = vec![(row, 0usize)];
        let mut path: Vec<SlotIndex> = Vec::new();
        while let Some(&(r, next)) = stack.last() {
            let columns = self.rows.columns(r);
            let free = (next == 0)
                .then(|| columns.iter().rev().map(|e| e.0).find(|&c| self.is_free(c)))
                .flatten();
            if let Some(c) = free {
                path.push(c);
                for (&(r, _), &c) in stack.iter().zip(&path) {
                    self.give(r, Some(c));
                }
                return true;
            }
            let at = stack.len() - 1;
            let found = (next..columns.len()).find(|&i| {
                let c = columns[columns.len() - 1 - i].0;
                self.open[c as usize]
                    && self.seen[c as usize] != self.round
                    && self.row_of_slot[c as usize].is_some_and(|o| !self.fixed_row[o])
            });
            match found {
                Some(i) => {
                    let c = columns[columns.len() - 1 - i].0;
                    stack[at].1 = i + 1;
                    self.seen[c as usize] = self.round;
                    path.push(c);
                    let owner = self.row_of_slot[c as usize].expect("the column was found taken");
                    stack.push((owner, 0));
                }
                None => {
                    stack.pop();
                    path.pop();
                }
            }
        }
        false
    }
    /// Gives a row another slot, or none, and notes which it had.
    fn give(&mut self, row: usize, slot: Option<SlotIndex>) {
        let before = std::mem::replace(&mut self.slot_of_row[row], slot);
        self.changed.push((row, before));
        if let Some(before) = before.filter(|&s| self.row_of_slot[s as usize] == Some(row)) {
            self.row_of_slot[before as usize] = None;
        }
        if let Some(slot) = slot {
            self.row_of_slot[slot as usize] = Some(row);
        }
    }
    /// Takes back what was noted, last first.
    fn take_back(&mut self) {
        while let Some((row, slot)) = self.changed.pop() {
            let now = std::mem::replace(&mut self.slot_of_row[row], slot);
            if let Some(now) = now.filter(|&s| self.row_of_slot[s as usize] == Some(row)) {
                self.row_of_slot[now as usize] = None;
            }
            if let Some(slot) = slot {
                self.row_of_slot[slot as usize] = Some(row);
            }
        }
    }
    fn is_free(&self, slot: SlotIndex) -> bool {
        self.open[slot as usize] && self.row_of_slot[slot as usize].is_none()
    }
    /// Gives the rows of a relation the targets of a method, if every other row keeps a slot.
    fn force(&mut self, own: &[usize], targets: &[SlotIndex]) -> bool {
        let distinct = targets.iter().enumerate().all(|(i, t)| !targets[..i].contains(t));
        let available = targets.iter().all(|&t| {
            self.open[t as usize]
                && self.row_of_slot[t as usize].is_none_or(|owner| !self.fixed_row[owner])
        });
        if !distinct || !available || targets.len() < own.len() {
            return false;
        }
        self.changed.clear();
        for &row in own {
            self.give(row, None);
        }
        let mut displaced = Vec::new();
        for &t in targets {
            if let Some(owner) = self.row_of_slot[t as usize] {
                self.give(owner, None);
                displaced.push(owner);
            }
            self.open[t as usize] = false;
        }
        if displaced.into_iter().all(|row| self.match_row(row)) {
            for (&row, &t) in own.iter().zip(targets) {
                self.give(row, Some(t));
                self.fixed_row[row] = true;
            }
            return true;
        }
        self.take_back();
        for &t in targets {
            self.open[t as usize] = true;
        }
        false
    }
}
