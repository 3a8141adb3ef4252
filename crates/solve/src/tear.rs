//! Tearing: unknowns that an equation of the block states outright are taken out of it.
//!
//! In: a square block. Out: a smaller one, and a definition for each unknown that was taken out. `pull =
//! tension * dx / length` says what `pull` is: put into the other equations, it leaves them to be
//! solved for the positions alone. What is left often has a formula, and Newton's steps are judged by
//! what was to be balanced, not by intermediate numbers.

use crate::lower::Problem;
use crate::system::SlotIndex;
use expr::{Arena, ExprId, Node, Var};

/// Above this size the definitions stay equations.
const LARGEST: usize = 400;

/// An unknown that a row states outright.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Definition {
    /// The row, by its place in the block.
    pub(crate) row: usize,
    /// The unknown.
    pub(crate) slot: SlotIndex,
    /// Its value, over known slots, what is left, and unknowns of the definitions after this one.
    pub(crate) value: ExprId,
}

/// A block without what its rows state outright.
#[derive(Clone, Debug)]
pub(crate) struct Torn {
    /// What is left, and for each of its rows its place in the block.
    pub(crate) problem: Problem,
    pub(crate) rows: Vec<usize>,
    /// What was taken out; to be computed from last to first.
    pub(crate) definitions: Vec<Definition>,
}

/// Takes out of a block what its rows state outright, in the order of its rows.
pub(crate) fn tear(arena: &mut Arena, problem: &Problem) -> Torn {
    let mut torn = Torn {
        problem: problem.clone(),
        rows: (0..problem.rows.len()).collect(),
        definitions: Vec::new(),
    };
    if problem.rows.len() > LARGEST {
        return torn;
    }
    let mut at = 0;
    while at < torn.rows.len() && torn.rows.len() > 1 {
        let Some((slot, value)) = stated(arena, &torn.problem, at) else {
            at += 1;
            continue;
        };
        torn.problem.rows.remove(at);
        torn.problem.unknowns.retain(|&u| u != slot);
        let row = torn.rows.remove(at);
        torn.definitions.push(Definition { row, slot, value });
        for row in &mut torn.problem.rows {
            for side in [&mut row.left, &mut row.right] {
                if arena.variables(*side).contains(&Var(slot)) {
                    *side = arena.substitute(*side, &|v| (v.0 == slot).then_some(value));
                }
            }
        }
    }
    torn
}

/// Returns the unknown that one side of a row is, and the other side, if that is free of it.
fn stated(arena: &Arena, problem: &Problem, row: usize) -> Option<(SlotIndex, ExprId)> {
    let row = &problem.rows[row];
    [(row.left, row.right), (row.right, row.left)].into_iter().find_map(|(one, other)| {
        let Node::Var(Var(slot)) = arena.node(one) else { return None };
        let is_unknown = problem.unknowns.binary_search(&slot).is_ok();
        (is_unknown && !arena.variables(other).contains(&Var(slot))).then_some((slot, other))
    })
}
