//! Order: the blocks, and which comes before which.
//!
//! In: rows, their direction, and sets of rows that must be solved together. Out: blocks in an order in
//! which each reads only what stands before it. What a free slot can reach against the direction of
//! the rows is the under-determined part (Dulmage and Mendelsohn); each connected piece of it is one
//! block. The rest splits into strongly connected blocks (Tarjan).

use crate::direct::Direction;
use crate::rows::Row;
use crate::system::SlotIndex;
use std::collections::{BTreeMap, BTreeSet};

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
    pub(crate) rows: &'a [Row],
    /// Rows that take part: the accepted ones and those that compromise with them.
    pub(crate) taking_part: &'a [usize],
    /// For every slot: the plan may write it.
    pub(crate) unknown: &'a [bool],
    /// Which way.
    pub(crate) direction: &'a Direction,
    /// For rows solved by a written method, what that method reads.
    pub(crate) method_reads: &'a BTreeMap<u32, BTreeSet<SlotIndex>>,
    /// Rows that must be solved together.
    pub(crate) together: &'a [Vec<usize>],
}

/// A partition of rows and slots: rows first, then slots.
struct Union(Vec<usize>);

impl Union {
    fn find(&mut self, i: usize) -> usize {
        let mut root = i;
        while self.0[root] != root {
            root = self.0[root];
        }
        let mut walk = i;
        while self.0[walk] != root {
            walk = std::mem::replace(&mut self.0[walk], root);
        }
        root
    }
    fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b)] = a.min(b);
    }
}

/// Splits and orders. Unknown slots that no row reaches are in no block.
pub(crate) fn order(incidence: &Incidence<'_>) -> Vec<Block> {
    let n = incidence.rows.len();
    let slots = incidence.unknown.len();
    let mut union = Union((0..n + slots).collect());
    for (s, row) in incidence.direction.row_of_slot.iter().enumerate() {
        if let Some(row) = row {
            union.unite(*row, n + s);
        }
    }
    for (&s, &row) in &incidence.direction.written_by {
        union.unite(row, n + s as usize);
    }
    for rows in incidence.together {
        for &r in rows {
            union.unite(rows[0], r);
        }
    }
    let mut by_relation: BTreeMap<u32, usize> = BTreeMap::new();
    for &r in incidence.taking_part {
        let relation = incidence.rows[r].relation;
        if incidence.direction.method.contains_key(&relation) {
            let first = *by_relation.entry(relation).or_insert(r);
            union.unite(first, r);
        }
    }
    unite_free(incidence, &mut union);
    components(incidence, &mut union)
}

/// Unites every piece of the under-determined part.
fn unite_free(incidence: &Incidence<'_>, union: &mut Union) {
    let n = incidence.rows.len();
    let mut rows_of_slot: BTreeMap<SlotIndex, Vec<usize>> = BTreeMap::new();
    for &r in incidence.taking_part {
        if !incidence.direction.method.contains_key(&incidence.rows[r].relation) {
            for &(c, _) in &incidence.rows[r].columns {
                if incidence.unknown[c as usize] {
                    rows_of_slot.entry(c).or_default().push(r);
                }
            }
        }
    }
    let mut reached = vec![false; incidence.unknown.len()];
    let mut stack: Vec<SlotIndex> = (0..incidence.unknown.len() as u32)
        .filter(|&s| {
            incidence.unknown[s as usize]
                && incidence.direction.row_of_slot[s as usize].is_none()
                && !incidence.direction.written_by.contains_key(&s)
        })
        .collect();
    for &s in &stack {
        reached[s as usize] = true;
    }
    while let Some(slot) = stack.pop() {
        for &r in rows_of_slot.get(&slot).into_iter().flatten() {
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
    let n = incidence.rows.len();
    // nodes are numbered by their first row, so that the order is that of declaration
    let mut node_of_root: BTreeMap<usize, usize> = BTreeMap::new();
    let mut rows_of_node: Vec<Vec<usize>> = Vec::new();
    let mut taking_part = incidence.taking_part.to_vec();
    taking_part.sort_unstable();
    for &r in &taking_part {
        let root = union.find(r);
        let node = *node_of_root.entry(root).or_insert_with(|| {
            rows_of_node.push(Vec::new());
            rows_of_node.len() - 1
        });
        rows_of_node[node].push(r);
    }
    let mut slots_of_node: Vec<Vec<SlotIndex>> = vec![Vec::new(); rows_of_node.len()];
    let mut node_of_slot: Vec<Option<usize>> = vec![None; incidence.unknown.len()];
    for (s, &unknown) in incidence.unknown.iter().enumerate() {
        if unknown && let Some(&node) = node_of_root.get(&union.find(n + s)) {
            slots_of_node[node].push(s as u32);
            node_of_slot[s] = Some(node);
        }
    }
    let before: Vec<BTreeSet<usize>> = rows_of_node
        .iter()
        .enumerate()
        .map(|(node, rows)| {
            let read = rows.iter().flat_map(|&r| {
                let row = &incidence.rows[r];
                incidence.method_reads.get(&row.relation).unwrap_or(&row.mentions)
            });
            read.filter_map(|&s| node_of_slot[s as usize]).filter(|&b| b != node).collect()
        })
        .collect();
    strong_components(&before)
        .into_iter()
        .map(|nodes| {
            let mut rows: Vec<usize> =
                nodes.iter().flat_map(|&v| rows_of_node[v].iter().copied()).collect();
            let mut unknowns: Vec<SlotIndex> =
                nodes.iter().flat_map(|&v| slots_of_node[v].iter().copied()).collect();
            rows.sort_unstable();
            unknowns.sort_unstable();
            Block { rows, unknowns }
        })
        .collect()
}

/// Tarjan's algorithm on `before`: components in an order in which each follows what it needs.
fn strong_components(before: &[BTreeSet<usize>]) -> Vec<Vec<usize>> {
    const UNSEEN: usize = usize::MAX;
    let n = before.len();
    let edges: Vec<Vec<usize>> = before.iter().map(|b| b.iter().copied().collect()).collect();
    let (mut index, mut low) = (vec![UNSEEN; n], vec![0; n]);
    let mut on_stack = vec![false; n];
    let (mut stack, mut out, mut count) = (Vec::new(), Vec::new(), 0);
    for root in 0..n {
        if index[root] != UNSEEN {
            continue;
        }
        let mut calls = vec![(root, 0)];
        while let Some(&(v, edge)) = calls.last() {
            if edge == 0 {
                (index[v], low[v]) = (count, count);
                count += 1;
                stack.push(v);
                on_stack[v] = true;
            }
            if let Some(&w) = edges[v].get(edge) {
                calls.last_mut().expect("the call was just seen").1 += 1;
                if index[w] == UNSEEN {
                    calls.push((w, 0));
                } else if on_stack[w] {
                    low[v] = low[v].min(index[w]);
                }
                continue;
            }
            calls.pop();
            if let Some(&(parent, _)) = calls.last() {
                low[parent] = low[parent].min(low[v]);
            }
            if low[v] == index[v] {
                let mut component = Vec::new();
                while let Some(w) = stack.pop() {
                    on_stack[w] = false;
                    component.push(w);
                    if w == v {
                        break;
                    }
                }
                component.sort_unstable();
                out.push(component);
            }
        }
    }
    out
}
