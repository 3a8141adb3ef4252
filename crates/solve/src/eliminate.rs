//! Elimination at planning: unknowns that an equation defines outright leave the block.
//!
//! In: the rows and unknowns of a block. Out: definitions, and a smaller block without their unknowns.
//! An equation `u = e`, with u on one side alone and not in e, defines u. Forces between beams,
//! results of operations: they are computed after the block, in the reverse order of elimination, and
//! what is iterated is what remains, from where it is.

use crate::lower::{Problem, ProblemRow};
use crate::system::{Level, SlotIndex};
use expr::{Arena, ExprId, Node, Var};
use std::collections::BTreeMap;

/// The largest block that is looked at: substitution is quadratic in it.
const LARGEST: usize = 400;

/// An unknown that left the block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Definition {
    /// The unknown.
    pub(crate) slot: SlotIndex,
    /// Its value, in terms of what remains.
    pub(crate) value: ExprId,
    /// The row, by its position in the block.
    pub(crate) row: usize,
}

/// What is left of a block, and what left it.
#[derive(Debug)]
pub(crate) struct Reduced {
    /// The rows that remain, by position, over the unknowns that remain.
    pub(crate) problem: Problem,
    /// The positions of the rows that remain.
    pub(crate) rows: Vec<usize>,
    /// In the order in which they are computed, after the block.
    pub(crate) definitions: Vec<Definition>,
}

/// Which rows may define an unknown.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Definers {
    /// All: every row will hold.
    Any,
    /// Required ones: the others may have to give way.
    Required,
}

/// Takes every unknown out of a block that one of its rows defines.
pub(crate) fn eliminate(arena: &mut Arena, problem: &Problem, definers: Definers) -> Reduced {
    let mut known: BTreeMap<Var, ExprId> = BTreeMap::new();
    let mut definitions: Vec<Definition> = Vec::new();
    let mut rows: Vec<(usize, ProblemRow)> = Vec::new();
    let small = problem.unknowns.len() <= LARGEST;
    for (position, row) in problem.rows.iter().enumerate() {
        let row = replaced(arena, *row, &known);
        let left = problem.unknowns.len() - definitions.len();
        let may = match definers {
            Definers::Any => true,
            Definers::Required => row.level == Level::Required,
        };
        let defined =
            if small && left > 1 && may { definition(arena, problem, &row) } else { None };
        match defined {
            Some((slot, value)) => {
                known.insert(Var(slot), value);
                definitions.push(Definition { slot, value, row: position });
            }
            None => rows.push((position, row)),
        }
    }
    // Earlier definitions may speak of unknowns that were defined later.
    for at in (0..definitions.len()).rev() {
        let value = arena.substitute(definitions[at].value, &|v| known.get(&v).copied());
        known.insert(Var(definitions[at].slot), value);
        definitions[at].value = value;
    }
    let mut reduced = Problem {
        rows: Vec::with_capacity(rows.len()),
        unknowns: problem
            .unknowns
            .iter()
            .copied()
            .filter(|&u| !known.contains_key(&Var(u)))
            .collect(),
    };
    let mut positions = Vec::with_capacity(rows.len());
    for (position, row) in rows {
        reduced.rows.push(replaced(arena, row, &known));
        positions.push(position);
    }
    definitions.reverse();
    Reduced { problem: reduced, rows: positions, definitions }
}

fn replaced(arena: &mut Arena, row: ProblemRow, known: &BTreeMap<Var, ExprId>) -> ProblemRow {
    let left = arena.substitute(row.left, &|v| known.get(&v).copied());
    let right = arena.substitute(row.right, &|v| known.get(&v).copied());
    ProblemRow { left, right, ..row }
}

/// Finds the unknown that a row defines: alone on one side, and not on the other.
fn definition(arena: &Arena, problem: &Problem, row: &ProblemRow) -> Option<(SlotIndex, ExprId)> {
    [(row.left, row.right), (row.right, row.left)].into_iter().find_map(|(side, other)| {
        let Node::Var(var) = arena.node(side) else { return None };
        let own = problem.unknowns.contains(&var.0) && !arena.variables(other).contains(&var);
        own.then_some((var.0, other))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(level: Level, left: ExprId, right: ExprId) -> ProblemRow {
        ProblemRow { level, left, right, within: 1e-9 }
    }

    /// z = x², w = z + x, p = w, in x, z and w.
    fn chain(arena: &mut Arena, last: Level) -> Problem {
        let [x, z, w, p] = [0, 1, 2, 3].map(|i| arena.var(Var(i)));
        let square = arena.square(x);
        let sum = arena.add(z, x);
        let required = Level::Required;
        let rows = vec![row(required, z, square), row(required, w, sum), row(last, p, w)];
        Problem { rows, unknowns: vec![0, 1, 2] }
    }

    #[test]
    fn what_rows_define_leaves_and_is_computed_afterwards() {
        let mut arena = Arena::new();
        let problem = chain(&mut arena, Level::Required);
        let reduced = eliminate(&mut arena, &problem, Definers::Any);
        assert_eq!(reduced.problem.unknowns, [0]);
        assert_eq!(reduced.rows, [2]);
        // x = 3: z = 9, w = 12, and the row that is left says p = 12
        let values = [3.0, f64::NAN, f64::NAN, 12.0];
        let left = &reduced.problem.rows[0];
        assert_eq!(arena.evaluate(left.left, &values), arena.evaluate(left.right, &values));
        let computed: Vec<(SlotIndex, f64)> = reduced
            .definitions
            .iter()
            .map(|d| (d.slot, arena.evaluate(d.value, &values)))
            .collect();
        assert_eq!(computed, [(2, 12.0), (1, 9.0)]);
    }

    #[test]
    fn soft_rows_define_nothing_where_they_may_give_way() {
        let mut arena = Arena::new();
        let [x, z] = [0, 1].map(|i| arena.var(Var(i)));
        let square = arena.square(x);
        let rows = vec![row(Level::Weak, z, square), row(Level::Required, z, x)];
        let problem = Problem { rows, unknowns: vec![0, 1] };
        let reduced = eliminate(&mut arena, &problem, Definers::Required);
        assert_eq!(reduced.definitions.len(), 1);
        assert_eq!(reduced.definitions[0].row, 1);
    }

    #[test]
    fn an_unknown_on_both_sides_is_not_defined() {
        let mut arena = Arena::new();
        let [x, y] = [0, 1].map(|i| arena.var(Var(i)));
        let product = arena.mul(x, y);
        let rows = vec![row(Level::Required, x, product), row(Level::Required, y, product)];
        let problem = Problem { rows, unknowns: vec![0, 1] };
        assert!(eliminate(&mut arena, &problem, Definers::Any).definitions.is_empty());
    }
}
