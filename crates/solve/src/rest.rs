//! Rest: rows that hold where an edit begins, and that nothing it speaks of moves by itself.
//!
//! In: the system, its classes and rows. Out: which rows rest. A place on a rail or at the end of a bar stays where
//! it is, and what is measured from it follows, though a row determines one of its coordinates.

use crate::rows::Rows;
use crate::substitute::Classes;
use crate::system::{SlotIndex, Stay, System};

/// Which rows rest.
#[derive(Clone, Debug, Default)]
pub(crate) struct Resting {
    /// For every row; empty where none does.
    is: Vec<bool>,
}

/// No row rests.
pub(crate) static NONE: Resting = Resting { is: Vec::new() };

impl Resting {
    /// Finds them: their relations rest, and so do those that make slots equal which they speak of; what they only
    /// read is constant, and no whole number is tried out in them.
    pub(crate) fn new(system: &System, classes: &Classes, rows: &Rows) -> Self {
        if !system.relations.iter().any(|r| r.rests) {
            return Self::default();
        }
        let equalities = classes.equalities(system);
        let rests = |&r: &u32| system.relations[r as usize].rests;
        let row = |r: usize| {
            let relation = &system.relations[rows[r].relation as usize];
            let stands = |&slot: &SlotIndex| {
                let root = classes.representative[slot as usize];
                let is_constant = match classes.stay[root as usize] {
                    Stay::Fixed | Stay::Given(_) => true,
                    Stay::Kept { .. } | Stay::Free => false,
                };
                let is_written = || rows.columns(r).iter().any(|e| e.0 == root);
                !system.slots[slot as usize].is_discrete
                    && equalities.of(root).iter().all(rests)
                    && (is_constant || is_written())
            };
            let equations = system.equations_of(relation).iter();
            let mut slots = equations.flat_map(|e| system.arguments(e.arguments));
            relation.rests && slots.all(stands)
        };
        Self { is: (0..rows.len()).map(row).collect() }
    }
    /// Has these rows rest.
    #[cfg(test)]
    pub(crate) fn of(is: Vec<bool>) -> Self {
        Self { is }
    }
    /// Has no row rest that reads one of these slots, which yield after all. Returns true if one would have.
    pub(crate) fn wakes(
        &mut self,
        setting: (&System, &Classes, &Rows),
        yielded: &[SlotIndex],
    ) -> bool {
        let (system, classes, rows) = setting;
        let yields = |&slot: &SlotIndex| {
            yielded.binary_search(&classes.representative[slot as usize]).is_ok()
        };
        let mut wakes = false;
        for (r, is) in self.is.iter_mut().enumerate().filter(|(_, is)| **is) {
            let relation = &system.relations[rows[r].relation as usize];
            let equations = system.equations_of(relation).iter();
            *is = !equations.flat_map(|e| system.arguments(e.arguments)).any(yields);
            wakes |= !*is;
        }
        wakes
    }
    /// Returns true if no row rests.
    pub(crate) fn is_empty(&self) -> bool {
        self.is.is_empty()
    }
    /// Returns true if this row rests.
    pub(crate) fn has(&self, row: usize) -> bool {
        self.is.get(row).is_some_and(|&is| is)
    }
}
