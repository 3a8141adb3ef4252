//! Views: superfluous rows that tell one after the other what others tell only together.
//!
//! In: blocks, and the required rows that were not accepted because others say the same. Out: exchanges
//! of one for an accepted row of its circuit that is solved together with others; the planner keeps
//! those that make less to be solved together. So a second view of a part (two resistors in series as
//! one) makes a plan of one pass, and a text that is said breaks a ring of texts that follow from each
//! other. Which rows are equivalent does not depend on values, and both are tested. A row that has no
//! formula of one solution is left where it is: it could choose a branch.

use crate::accept::Dependent;
use crate::lower::Inverse;
use crate::order::{Block, Blocks};
use crate::plan::Analysis;
use crate::rows::Row;
use crate::system::{Level, SlotIndex};

/// So many exchanges are tried.
const MOST: usize = 32;

/// One superfluous row for an accepted one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Exchange {
    /// Which of the dependent rows is accepted.
    pub(crate) dependent: usize,
    /// The row that it replaces.
    pub(crate) row: usize,
}

/// Returns how many rows are solved together with others and determine as many unknowns.
pub(crate) fn together(blocks: &Blocks) -> usize {
    blocks.iter().filter(|block| is_joint(block)).map(|block| block.rows.len()).sum()
}

fn is_joint(block: &Block<'_>) -> bool {
    block.unknowns.len() > 1 && block.rows.len() == block.unknowns.len()
}

/// Returns the exchanges that may make less to be solved together, in order; at most a few.
pub(crate) fn exchanges(analysis: &Analysis<'_>, blocks: &Blocks) -> Vec<Exchange> {
    let dependent = &analysis.acceptance.dependent;
    if dependent.is_empty() || together(blocks) == 0 {
        return Vec::new();
    }
    let mut block_of_row = vec![None; analysis.rows.len()];
    for (b, block) in blocks.iter().enumerate().filter(|(_, block)| is_joint(block)) {
        block.rows.iter().for_each(|&r| block_of_row[r] = Some(b));
    }
    let system = &analysis.stated.system;
    let is_plain = |row: usize| {
        let Row { level, relation, .. } = analysis.rows[row];
        let relation = &system.relations[relation as usize];
        // the methods of an equality of texts were not written
        let is_of_texts = relation.derived && analysis.rows.kernel(row).is_none();
        level == Level::Required && (relation.methods.is_empty() || is_of_texts)
    };
    // where rows rest, a circuit is one no more over what still moves if some row of it was left out that does
    let mut is_accepted = vec![!analysis.acceptance.some_rest; analysis.rows.len()];
    analysis.acceptance.accepted.iter().for_each(|&r| is_accepted[r] = true);
    let stays = |row: usize| {
        let mut columns = analysis.rows.columns(row).iter();
        columns.all(|e| !analysis.acceptance.unknown[e.0 as usize])
    };
    let is_whole = |d: &Dependent| d.circuit.iter().all(|&r| is_accepted[r] || stays(r));
    let times_needed = |row: usize| dependent.iter().filter(|d| d.circuit.contains(&row)).count();
    let mut found = Vec::new();
    for (d, candidate) in
        dependent.iter().enumerate().filter(|(_, d)| is_plain(d.row) && is_whole(d))
    {
        let its = candidate.circuit.iter().copied();
        let mut replaced: Vec<usize> =
            its.filter(|&r| block_of_row[r].is_some() && is_plain(r)).collect();
        // of the rows of one block the last one is tested instead
        replaced.sort_unstable_by_key(|&r| (block_of_row[r], std::cmp::Reverse(r)));
        replaced.dedup_by_key(|r| block_of_row[*r]);
        let asked = analysis.rows.mentions(candidate.row);
        if replaced.is_empty() || !asked.iter().any(|&s| tells(analysis, candidate.row, s)) {
            continue;
        }
        replaced.retain(|&r| times_needed(r) == 1);
        found.extend(replaced.into_iter().map(|row| Exchange { dependent: d, row }));
        if found.len() >= MOST {
            break;
        }
    }
    found.truncate(MOST);
    found
}

/// Whether a row has a formula of one solution for a slot, or is of texts and has a method for it.
fn tells(analysis: &Analysis<'_>, row: usize, slot: SlotIndex) -> bool {
    if analysis.rows.kernel(row).is_none() {
        let relation = analysis.rows[row].relation;
        let methods = &analysis.stated.system.relations[relation as usize].methods;
        return methods.iter().any(|m| m.targets == [slot]);
    }
    crate::lower::problem_row(&analysis.stated.system, analysis.rows, row)
        .and_then(|row| Inverse::new(row, slot))
        .is_some_and(|inverse| inverse.roots() == 1)
}
