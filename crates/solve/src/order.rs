//! Order: the blocks, and which comes before which.
//!
//! In: rows, their direction, and sets of rows that must be solved together. Out: blocks in an order in
//! which each reads only what stands before it. What a free slot can reach against the direction of
//! the rows is the under-determined part (Dulmage and Mendelsohn); each connected piece of it is one
//! block. The rest splits into strongly connected blocks (Tarjan).

use crate::direct::Direction;
use crate::lists::Lists;
use crate::rows::Rows;
use crate::system::SlotIndex;
use crate::union::Union;
use std::collections::BTreeMap;

/// Rows that are solved together, with the slots that they determine.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Block {
    /// Its rows, in order.
    pub(crate) rows: Vec<usize>,
    /// Its unknowns, in order; more than rows where it is under-determined.
    pub(crate) unknowns: Vec<SlotIndex>,
}

/// What the order is made of.
pub(crate) struct Incidence<'a> {
    /// All rows.
    pub(crate) rows: &'a Rows,
    /// Rows that take part, in order: the accepted ones and those that compromise with them.
    pub(crate) taking_part: &'a [usize],
    /// For every slot: the plan may write it.
    pub(crate) unknown: &'a [bool],
    /// Which way.
    pub(crate) direction: &'a Direction,
    /// For rows solved by a written method, what that method reads.
    pub(crate) method_reads: &'a BTreeMap<u32, Vec<SlotIndex>>,
    /// Rows that must be solved together.
    pub(crate) together: &'a [Vec<usize>],
}

/// Splits and orders. Unknown slots that no row reaches are in no block.
pub(crate) fn order(incidence: &Incidence<'_>) -> Vec<Block> {
    let n = incidence.rows.len();
    let slots = incidence.unknown.len();
    let mut union = Union::new(n + slots);
    for (s, row) in incidence.direction.row_of_slot.iter().enumerate() {
        if let Some(row) = row {
            union.unite(*row, n + s);
        }
    }
    for &(s, row) in &incidence.direction.written_by {
        union.unite(row, n + s as usize);
    }
    for rows in incidence.together {
        for &r in rows {
            union.unite(rows[0], r);
        }
    }
    let relation = |r: usize| incidence.rows[r].relation;
    for own in incidence.taking_part.chunk_by(|&a, &b| relation(a) == relation(b)) {
        if own.len() > 1 && incidence.direction.method_of(relation(own[0])).is_some() {
            own.iter().for_each(|&r| union.unite(own[0], r));
        }
    }
    unite_free(incidence, &mut union);
    components(incidence, &mut union)
}

/// Unites every piece of the under-determined part.
fn unite_free(incidence: &Incidence<'_>, union: &mut Union) {
    let n = incidence.rows.len();
    let mut reached = vec![false; incidence.unknown.len()];
    let mut stack: Vec<SlotIndex> = (0..incidence.unknown.len() as u32)
        .filter(|&s| {
            incidence.unknown[s as usize]
                && incidence.direction.row_of_slot[s as usize].is_none()
                && !incidence.direction.is_written(s)
        })
        .collect();
    if stack.is_empty() {
        return;
    }
    for &s in &stack {
        reached[s as usize] = true;
    }
    let free = |&&r: &&usize| incidence.direction.method_of(incidence.rows[r].relation).is_none();
    let columns = |&r: &usize| incidence.rows.columns(r).iter().map(move |e| (e.0, r as u32));
    let pairs = incidence.taking_part.iter().filter(free).flat_map(columns);
    let rows_of_slot = Lists::new(incidence.unknown.len(), pairs);
    while let Some(slot) = stack.pop() {
        for &r in rows_of_slot.of(slot) {
            let r = r as usize;
            union.unite(n + slot as usize, r);
            if let Some(next) = incidence.direction.slot_of_row[r]
                && !std::mem::replace(&mut reached[next as usize], true)
            {
                stack.push(next);
            }
        }
    }
}

/// Strongly connected components of the united rows, each after what it reads.
fn components(incidence: &Incidence<'_>, union: &mut Union) -> Vec<Block> {
    const NONE: u32 = u32::MAX;
    let n = incidence.rows.len();
    // nodes are numbered by their first row, so that the order is that of declaration
    let mut node_of_root = vec![NONE; n + incidence.unknown.len()];
    let mut node_of_row = Vec::with_capacity(incidence.taking_part.len());
    let mut nodes = 0;
    for &r in incidence.taking_part {
        let node = &mut node_of_root[union.find(r)];
        if *node == NONE {
            *node = nodes;
            nodes += 1;
        }
        node_of_row.push(*node);
    }
    let node_of_slot: Vec<u32> = incidence
        .unknown
        .iter()
        .enumerate()
        .map(|(s, &unknown)| if unknown { node_of_root[union.find(n + s)] } else { NONE })
        .collect();
    let edges = |&(node, r): &(u32, usize)| {
        let read = match incidence.method_reads.get(&incidence.rows[r].relation) {
            Some(reads) => reads,
            None => incidence.rows.mentions(r),
        };
        let read = read.iter().map(|&s| node_of_slot[s as usize]);
        read.filter(move |&b| b != node && b != NONE).map(move |b| (node, b))
    };
    let rows: Vec<(u32, usize)> =
        node_of_row.iter().copied().zip(incidence.taking_part.iter().copied()).collect();
    let before = Lists::new(nodes as usize, rows.iter().flat_map(edges));
    let rows_of_node = Lists::new(nodes as usize, rows.iter().map(|&(node, r)| (node, r as u32)));
    let slots = (0..).zip(&node_of_slot).filter(|(_, n)| **n != NONE);
    let slots_of_node = Lists::new(nodes as usize, slots.map(|(s, &node)| (node, s)));
    let block = |nodes: &[u32]| {
        let count = |lists: &Lists| nodes.iter().map(|&v| lists.of(v).len()).sum();
        let mut rows: Vec<usize> = Vec::with_capacity(count(&rows_of_node));
        let mut unknowns = Vec::with_capacity(count(&slots_of_node));
        for &v in nodes {
            rows.extend(rows_of_node.of(v).iter().map(|&r| r as usize));
            unknowns.extend_from_slice(slots_of_node.of(v));
        }
        rows.sort_unstable();
        unknowns.sort_unstable();
        Block { rows, unknowns }
    };
    let mut blocks = Vec::with_capacity(nodes as usize);
    strong_components(&before, &mut |component| blocks.push(block(component)));
    blocks
}

/// Tarjan's algorithm on `before`: components in an order in which each follows what it needs.
pub(crate) fn strong_components(before: &Lists, found: &mut dyn FnMut(&[u32])) {
    const UNSEEN: u32 = u32::MAX;
    const DONE: u32 = u32::MAX - 1;
    let n = before.len();
    // when a node was met, and the first that leads to it and that it leads to
    let (mut index, mut low) = (vec![UNSEEN; n], vec![0; n]);
    let (mut stack, mut calls, mut count) = (Vec::with_capacity(n), Vec::with_capacity(n), 0);
    for root in 0..n as u32 {
        if index[root as usize] != UNSEEN {
            continue;
        }
        calls.push((root, 0));
        while let Some(&(v, edge)) = calls.last() {
            let at = v as usize;
            if edge == 0 {
                (index[at], low[at]) = (count, count);
                count += 1;
                stack.push(v);
            }
            if let Some(&w) = before.of(v).get(edge) {
                calls.last_mut().expect("the call was just seen").1 += 1;
                if index[w as usize] == UNSEEN {
                    calls.push((w, 0));
                } else if index[w as usize] != DONE {
                    low[at] = low[at].min(index[w as usize]);
                }
                continue;
            }
            calls.pop();
            if let Some(&(parent, _)) = calls.last() {
                low[parent as usize] = low[parent as usize].min(low[at]);
            }
            if low[at] == index[at] {
                let first = stack.iter().rposition(|&w| w == v).expect("the node is on the stack");
                stack[first..].iter().for_each(|&w| index[w as usize] = DONE);
                stack[first..].sort_unstable();
                found(&stack[first..]);
                stack.truncate(first);
            }
        }
    }
}
