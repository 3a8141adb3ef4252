//! Acceptance: who may yield.
//!
//! In: the rows, level by level. Out: the rows that can hold together, the circuits of those that
//! cannot, and the slots that may move. A given number is a constant unless a row could not be
//! accepted otherwise; of the rest, a place or lone number stays if the accepted rows can do without
//! it, asked in order of declaration, all its coordinates at once.

use crate::rows::Rows;
use crate::substitute::Classes;
use crate::system::{Level, SlotIndex, Stay, System};
use crate::tableau::{Reduced, SparseRow, Tableau};
use std::collections::BTreeMap;

/// What may move a column.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Column {
    /// A given number that has not yielded.
    Given,
    /// May be a pivot.
    Open,
    /// Constant in this plan.
    Stays,
}

/// A row that depends on accepted ones.
#[derive(Clone, Debug)]
pub(crate) struct Dependent {
    /// The row.
    pub(crate) row: usize,
    /// The accepted rows that it is a combination of.
    pub(crate) circuit: Vec<usize>,
}

/// Who holds and who yields.
#[derive(Clone, Debug, Default)]
pub(crate) struct Acceptance {
    /// The accepted rows, in order of acceptance.
    pub(crate) accepted: Vec<usize>,
    /// The others.
    pub(crate) dependent: Vec<Dependent>,
    /// For every slot: it is a representative and the plan may write it.
    pub(crate) unknown: Vec<bool>,
    /// Given numbers that had to yield, over representatives.
    pub(crate) yielded: Vec<SlotIndex>,
    /// Motions that required relations leave with every given number held.
    pub(crate) freedom: usize,
}

/// Decides which rows are accepted and which slots stay.
pub(crate) fn accept(system: &System, classes: &Classes, rows: &Rows) -> Acceptance {
    let mut order: Vec<usize> = (0..rows.len()).collect();
    order.sort_by_key(|&r| (rows[r].level, r));
    let mut state = State::new(system, classes);
    let mut out = Acceptance::default();
    let mut required_rank = 0;
    for r in order {
        let reduced = state.tableau.reduce(rows.columns(r));
        match state.pivot(&reduced.row) {
            Some(column) => {
                if rows[r].level == Level::Required
                    && classes.stay[column as usize] != Stay::Given
                    && system.slots[column as usize].is_number
                {
                    required_rank += 1;
                }
                state.tableau.accept(reduced, column);
                out.accepted.push(r);
            }
            None => {
                let circuit = circuit(&state, &reduced, &out.accepted);
                out.dependent.push(Dependent { row: r, circuit });
            }
        }
    }
    let movable = (0..system.slots.len()).filter(|&s| {
        classes.representative[s] == s as u32
            && system.slots[s].is_number
            && matches!(classes.stay[s], Stay::Kept { .. } | Stay::Free)
    });
    out.freedom = movable.count().saturating_sub(required_rank);
    hold_places(system, classes, &mut state);
    out.unknown = state.columns.iter().map(|c| *c == Some(Column::Open)).collect();
    out.yielded = (0..system.slots.len() as u32)
        .filter(|&s| classes.stay[s as usize] == Stay::Given && out.unknown[s as usize])
        .collect();
    out
}

fn circuit(state: &State, reduced: &Reduced, accepted: &[usize]) -> Vec<usize> {
    state.tableau.circuit(reduced).into_iter().map(|k| accepted[k as usize]).collect()
}

struct State {
    tableau: Tableau,
    /// By slot; none for what is never an unknown.
    columns: Vec<Option<Column>>,
    /// How willing a column is to be a pivot: the larger, the sooner it yields.
    willing: Vec<u64>,
}

impl State {
    fn new(system: &System, classes: &Classes) -> Self {
        let n = system.slots.len();
        let mut columns = vec![None; n];
        let mut willing = vec![0; n];
        for s in 0..n {
            if classes.representative[s] != s as u32 {
                continue;
            }
            (columns[s], willing[s]) = match classes.stay[s] {
                Stay::Fixed => (None, 0),
                Stay::Given => (Some(Column::Given), 0),
                Stay::Kept { group } => (Some(Column::Open), 1 + u64::from(group)),
                Stay::Free => (Some(Column::Open), u64::MAX),
            };
        }
        Self { tableau: Tableau::default(), columns, willing }
    }
    /// Chooses the pivot of a reduced row, letting given numbers yield where nothing else can.
    fn pivot(&mut self, row: &SparseRow) -> Option<u32> {
        if let Some(column) = self.best(row) {
            return Some(column);
        }
        for &(c, _) in row {
            self.columns[c as usize] = Some(Column::Open);
        }
        self.best(row)
    }
    /// Returns the most willing open column among those that are not small.
    fn best(&self, row: &SparseRow) -> Option<u32> {
        let open = || row.iter().filter(|(c, _)| self.columns[*c as usize] == Some(Column::Open));
        let largest = open().fold(0.0f64, |m, e| m.max(e.1.abs()));
        open()
            .filter(|e| e.1.abs() >= 0.05 * largest)
            .max_by_key(|e| (self.willing[e.0 as usize], e.0))
            .map(|e| e.0)
    }
}

/// Lets every place stay that the accepted rows can do without, in order of declaration.
fn hold_places(system: &System, classes: &Classes, state: &mut State) {
    let mut groups: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (s, slot) in system.slots.iter().enumerate() {
        if let Stay::Kept { group } = slot.stay {
            groups.entry(group).or_default().push(s as u32);
        }
    }
    for c in 0..state.columns.len() {
        if state.columns[c] == Some(Column::Given) {
            state.columns[c] = Some(Column::Stays);
        }
    }
    for (group, slots) in groups {
        let own = |s: &u32| {
            let r = classes.representative[*s as usize];
            classes.stay[r as usize] == Stay::Kept { group }
        };
        // a coordinate that equals an earlier or firmer one has yielded, and its place with it
        if slots.iter().all(own) {
            let columns: Vec<u32> =
                slots.iter().map(|&s| classes.representative[s as usize]).collect();
            hold(state, &columns);
        }
    }
}

/// Holds the columns if the rows keep their rank without them; else changes nothing.
fn hold(state: &mut State, columns: &[u32]) {
    for &c in columns {
        state.columns[c as usize] = Some(Column::Stays);
    }
    for &c in columns {
        let Some(row) = state.tableau.row_with_pivot(c) else { continue };
        match state.best(state.tableau.row(row)) {
            Some(other) => state.tableau.exchange(row, other),
            None => {
                for &c in columns {
                    state.columns[c as usize] = Some(Column::Open);
                }
                return;
            }
        }
    }
}
