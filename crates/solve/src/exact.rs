//! Acceptance by elimination: the exact answer for any piece, and the circuits of dependent rows.
//!
//! In: the rows of a piece in order of acceptance, the places that touch it. Out: the same as by
//! matching, found by a fully reduced tableau at a generic point. Cost: up to cubic in the piece.

use crate::accept::{Acceptance, Dependent, Piece, Setting};
use crate::echelon::Row;
use crate::number::Number;
use crate::substitute::Classes;
use crate::system::{Giver, Level, SlotIndex, Stay};
use crate::tableau::{Reduced, Tableau};
use std::collections::{BTreeMap, BTreeSet};

/// What may move a column.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Column {
    /// A given number: a pivot where nothing else can be one, a default before what the document says.
    Given(Giver),
    /// May be a pivot.
    Open,
    /// A given number that has to yield.
    Yields,
    /// Constant in this plan.
    Stays,
}

/// What came of elimination.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Came {
    /// Everything is decided.
    All,
    /// Nothing is: it takes too much work.
    TooMuch,
    /// Nothing is: rounding may have decided something.
    Doubtful,
}

/// The first of the columns that are no slots: each tells that a row which does not rest takes part.
const MOVING: u32 = 1 << 31;

/// Decides for one piece with these coefficients, row by row, unless that takes more work than some times what
/// the rows hold; then also not where rounding may decide something.
pub(crate) fn accept<N: Number>(
    setting: Setting<'_>,
    coefficients: &[Row<N>],
    piece: Piece<'_>,
    most: Option<usize>,
    out: &mut Acceptance,
) -> Came {
    let Setting { system, classes, rows, resting } = setting;
    let may_rest = piece.rows.iter().any(|&r| resting.has(r as usize));
    let size: usize = coefficients.iter().map(Row::len).sum();
    let is_bounded = most.is_some();
    let most = most.map_or(usize::MAX, |times| times * size);
    let mut state = State::new(classes, coefficients, piece);
    let (mut accepted, mut dependent, mut determined) = (Vec::new(), Vec::new(), 0);
    for (r, own) in piece.rows.iter().map(|&r| r as usize).zip(coefficients) {
        let reduced = if may_rest && !resting.has(r) {
            let mut marked = own.clone();
            marked.push((MOVING + r as u32, N::ONE));
            state.tableau.reduce(&marked)
        } else {
            state.tableau.reduce(own)
        };
        match state.pivot(&reduced.row) {
            Some(column) => {
                if rows[r].level == Level::Required
                    && !classes.stay[column as usize].is_given()
                    && system.slots[column as usize].is_number
                {
                    determined += 1;
                }
                state.tableau.accept(reduced, column);
                accepted.push(r);
                if state.tableau.work() > most {
                    return Came::TooMuch;
                }
            }
            None => {
                let circuit = circuit(&state, &reduced, &accepted);
                dependent.push(Dependent { row: r, circuit });
            }
        }
    }
    hold_given(&mut state);
    // what yields may be read
    let may_rest = may_rest && !state.columns.values().any(|&column| column == Column::Yields);
    let mut some_rest = false;
    for place in piece.places() {
        some_rest |= hold(&mut state, place, may_rest);
        if state.tableau.work() > most {
            return Came::TooMuch;
        }
    }
    if is_bounded && state.tableau.is_doubtful() {
        return Came::Doubtful;
    }
    for (&slot, &column) in &state.columns {
        out.unknown[slot as usize] = matches!(column, Column::Open | Column::Yields);
    }
    if some_rest {
        // of rows over what still moves, those that others imply say nothing more
        let mut left = Tableau::default();
        let own: BTreeMap<u32, &Row<N>> = piece.rows.iter().copied().zip(coefficients).collect();
        accepted.retain(|r| {
            let moves = own[&(*r as u32)].iter().filter(|e| out.unknown[e.0 as usize]).copied();
            let reduced = left.reduce(&moves.collect::<Row<N>>());
            let pivot = state.best(&reduced.row, Column::Open);
            match pivot {
                Some(column) => drop(left.accept(reduced, column)),
                None => out.some_rest = true,
            }
            pivot.is_some()
        });
    }
    out.accepted.extend(accepted);
    out.dependent.extend(dependent);
    out.determined += determined;
    Came::All
}

fn circuit<N: Number>(state: &State<N>, reduced: &Reduced<N>, accepted: &[usize]) -> Vec<usize> {
    state.tableau.circuit(reduced).into_iter().map(|k| accepted[k as usize]).collect()
}

struct State<N> {
    tableau: Tableau<N>,
    /// What is never an unknown is not here.
    columns: BTreeMap<SlotIndex, Column>,
    /// How willing a column is to be a pivot: the larger, the sooner it yields.
    willing: BTreeMap<SlotIndex, u64>,
}

impl<N: Number> State<N> {
    fn new(classes: &Classes, coefficients: &[Row<N>], piece: Piece<'_>) -> Self {
        let mut columns = BTreeMap::new();
        let mut willing = BTreeMap::new();
        let met = coefficients.iter().flatten().map(|e| e.0);
        for s in met.chain(piece.places().flatten().copied()) {
            let (column, will) = match classes.stay[s as usize] {
                Stay::Fixed => continue,
                Stay::Given(giver) => (Column::Given(giver), 0),
                Stay::Kept { group } => (Column::Open, 1 + u64::from(group)),
                Stay::Free => (Column::Open, u64::MAX),
            };
            columns.insert(s, column);
            willing.insert(s, will);
        }
        Self { tableau: Tableau::default(), columns, willing }
    }
    /// Chooses the pivot of a reduced row: a given number where nothing else can be one.
    fn pivot(&self, row: &Row<N>) -> Option<u32> {
        let given = || Giver::YIELDING.iter().find_map(|&g| self.best(row, Column::Given(g)));
        self.best(row, Column::Open).or_else(given)
    }
    /// Returns true if everything that a row depends on stays, and only rows that rest take part in it.
    fn rests(&self, row: u32) -> bool {
        let stays = |c: u32| self.columns.get(&c).is_none_or(|&column| column == Column::Stays);
        self.tableau.row(row).iter().all(|e| e.0 < MOVING && stays(e.0))
    }
    /// Returns the most willing of these columns among those that are not small.
    fn best(&self, row: &Row<N>, kind: Column) -> Option<u32> {
        let own = || row.iter().filter(|(c, _)| self.columns.get(c) == Some(&kind));
        let largest = own().fold(0.0f64, |m, e| m.max(e.1.size()));
        own()
            .filter(|e| e.1.size() >= 0.05 * largest)
            .max_by_key(|e| (self.willing.get(&e.0), e.0))
            .map(|e| e.0)
    }
}

/// Holds every given number but those without which the rows would lose rank, each by itself: whether
/// one yields does not depend on the order of the rows.
fn hold_given<N: Number>(state: &mut State<N>) {
    let giver = |(&c, column): (&u32, &Column)| match column {
        Column::Given(giver) => Some((c, *giver)),
        Column::Open | Column::Yields | Column::Stays => None,
    };
    let given: BTreeMap<u32, Giver> = state.columns.iter().filter_map(giver).collect();
    let firmness = |c: u32| given.get(&c).copied();
    // what is not given yields first, however small, then what is given less firmly
    let yields_first = |c: u32, held: Giver| firmness(c).is_none_or(|giver| giver > held);
    for (&c, &held) in &given {
        let Some(row) = state.tableau.row_with_pivot(c) else { continue };
        let row_of = state.tableau.row(row).iter();
        let others = row_of.filter(|e| e.0 < MOVING && yields_first(e.0, held));
        let rank = |c: u32| firmness(c).map_or(2, |giver| giver as usize);
        let most = |a: &&(u32, N), b: &&(u32, N)| {
            rank(a.0).cmp(&rank(b.0)).then(a.1.size().total_cmp(&b.1.size()))
        };
        if let Some(other) = others.max_by(most).map(|e| e.0) {
            state.tableau.exchange(row, other);
        }
    }
    let mut yielded: BTreeSet<u32> = BTreeSet::new();
    for (&c, &giver) in &given {
        let Some(row) = state.tableau.row_with_pivot(c) else { continue };
        let alike = state.tableau.row(row).iter().map(|e| e.0);
        yielded.extend(alike.filter(|&o| firmness(o) == Some(giver)));
        yielded.insert(c);
    }
    for c in given.into_keys() {
        let column = if yielded.contains(&c) { Column::Yields } else { Column::Stays };
        state.columns.insert(c, column);
    }
}

/// Holds the columns if the others that are not given leave the rows their rank, or rows that rest determine them;
/// else changes nothing. Returns true if some rest.
///
/// A given number that yields is no other: how much it changes is decided before what is computed is
/// asked to stay.
fn hold<N: Number>(state: &mut State<N>, columns: &[u32], may_rest: bool) -> bool {
    for &c in columns {
        state.columns.insert(c, Column::Stays);
    }
    let mut some_rest = false;
    for &c in columns {
        let Some(row) = state.tableau.row_with_pivot(c) else { continue };
        match state.best(state.tableau.row(row), Column::Open) {
            Some(other) => state.tableau.exchange(row, other),
            None if may_rest && state.rests(row) => some_rest = true,
            None => {
                for &c in columns {
                    state.columns.insert(c, Column::Open);
                }
                return false;
            }
        }
    }
    some_rest
}
