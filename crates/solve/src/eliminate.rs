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
