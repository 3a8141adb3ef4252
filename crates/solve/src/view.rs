//! Views: superfluous rows that tell at once what others tell only together.
//!
//! In: blocks, and the required rows that were not accepted because others say the same. Out: an exchange
//! of one for an accepted row of its circuit, where it has a formula for an unknown of a block and all
//! else that it speaks of is known before that block. So a second view of a part (two resistors in
//! series as one) makes a plan of one pass out of equations that had to be solved together. Which rows
//! are equivalent does not depend on values, and both are tested.

use crate::lower::Inverse;
use crate::order::Block;
use crate::plan::Analysis;
use crate::system::{Level, SlotIndex};

/// One superfluous row for an accepted one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Exchange {
    /// Which of the dependent rows is accepted.
    pub(crate) dependent: usize,
    /// The row that it replaces.
    pub(crate) row: usize,
}

/// Finds the first exchange that takes an unknown out of a block.
pub(crate) fn exchange(analysis: &Analysis<'_>, blocks: &[Block]) -> Option<Exchange> {
    const NONE: usize = usize::MAX;
    let dependent = &analysis.acceptance.dependent;
    let joint =
        |block: &Block| block.unknowns.len() > 1 && block.rows.len() == block.unknowns.len();
    if dependent.is_empty() || !blocks.iter().any(joint) {
        return None;
    }
    let mut block_of_row = vec![NONE; analysis.rows.len()];
    let mut block_of_slot = vec![NONE; analysis.acceptance.unknown.len()];
    for (b, block) in blocks.iter().enumerate() {
        block.rows.iter().for_each(|&r| block_of_row[r] = b);
        block.unknowns.iter().for_each(|&s| block_of_slot[s as usize] = b);
    }
    let system = &analysis.stated.system;
    let is_plain = |row: usize| {
        let row = analysis.rows[row];
        row.level == Level::Required && system.relations[row.relation as usize].methods.is_empty()
    };
    let times_needed = |row: usize| dependent.iter().filter(|d| d.circuit.contains(&row)).count();
    for (d, candidate) in dependent.iter().enumerate().filter(|(_, d)| is_plain(d.row)) {
        let asked = analysis.rows.mentions(candidate.row).iter();
        let asked = asked.filter(|&&s| analysis.acceptance.unknown[s as usize]);
        let asked: Vec<(usize, SlotIndex)> =
            asked.map(|&s| (block_of_slot[s as usize], s)).collect();
        if asked.iter().any(|a| a.0 == NONE) {
            continue;
        }
        for &(own, unknown) in asked.iter().filter(|a| joint(&blocks[a.0])) {
            let others: Vec<usize> = asked.iter().filter(|a| a.1 != unknown).map(|a| a.0).collect();
            let its = candidate.circuit.iter().copied();
            let replaced = its.filter(|&r| block_of_row[r] == own && is_plain(r));
            if let Some(row) = replaced.filter(|&r| times_needed(r) == 1).max()
                && !others.contains(&own)
                && tells(analysis, candidate.row, unknown)
                && !follow(analysis, blocks, &block_of_slot, own, &others)
            {
                return Some(Exchange { dependent: d, row });
            }
        }
    }
    None
}

/// Whether one of some blocks needs what another determines.
fn follow(
    analysis: &Analysis<'_>,
    blocks: &[Block],
    block_of_slot: &[usize],
    first: usize,
    others: &[usize],
) -> bool {
    let last = others.iter().copied().max().unwrap_or(0);
    let mut follows = vec![false; blocks.len()];
    follows[first] = true;
    for (b, block) in blocks.iter().enumerate().take(last + 1).skip(first + 1) {
        let mut read = block.rows.iter().flat_map(|&r| analysis.reads_of_row(r));
        follows[b] =
            read.any(|&s| follows.get(block_of_slot[s as usize]).is_some_and(|follows| *follows));
    }
    others.iter().any(|&b| follows[b])
}

/// Whether a row has a formula of one solution for a slot.
fn tells(analysis: &Analysis<'_>, row: usize, slot: SlotIndex) -> bool {
    crate::lower::problem_row(analysis, row)
        .and_then(|row| Inverse::new(&row, slot))
        .is_some_and(|inverse| inverse.roots() == 1)
}
