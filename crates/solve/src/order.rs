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
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Block<'a> {
    /// Its rows, in order.
    pub(crate) rows: &'a [usize],
    /// Its unknowns, in order; more than rows where it is under-determined.
    pub(crate) unknowns: &'a [SlotIndex],
}

/// Blocks, each after those that it reads.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Blocks {
    rows: Vec<usize>,
    unknowns: Vec<SlotIndex>,
    /// Where each ends: among the rows, and among the unknowns.
    ends: Vec<(u32, u32)>,
}

impl Blocks {
    /// Makes room for so many rows and unknowns, in so many blocks.
    pub(crate) fn with_room(rows: usize, unknowns: usize, blocks: usize) -> Self {
        Self {
            rows: Vec::with_capacity(rows),
            unknowns: Vec::with_capacity(unknowns),
            ends: Vec::with_capacity(blocks),
        }
    }
    /// Adds a block of these rows and unknowns, in any order.
    pub(crate) fn add(
        &mut self,
        rows: impl Iterator<Item = usize>,
        unknowns: impl Iterator<Item = SlotIndex>,
    ) {
        let (first_row, first_unknown) = (self.rows.len(), self.unknowns.len());
        self.rows.extend(rows);
        self.unknowns.extend(unknowns);
        if self.rows.len() > first_row + 1 {
            self.rows[first_row..].sort_unstable();
        }
        if self.unknowns.len() > first_unknown + 1 {
            self.unknowns[first_unknown..].sort_unstable();
        }
        self.ends.push((self.rows.len() as u32, self.unknowns.len() as u32));
    }
    /// Returns how many there are.
    pub(crate) fn len(&self) -> usize {
        self.ends.len()
    }
    /// Returns every block, in order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = Block<'_>> {
        let mut start = (0, 0);
        self.ends.iter().map(move |&end| {
            let (first, last) = (std::mem::replace(&mut start, end), end);
            Block {
                rows: &self.rows[first.0 as usize..last.0 as usize],
                unknowns: &self.unknowns[first.1 as usize..last.1 as usize],
            }
        })
    }
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
pub(crate) fn order(incidence: &Incidence<'_>) -> Blocks {
    let direction = incidence.direction;
    let mut union = Union::new(incidence.rows.len());
    let home = |row: &Option<usize>| row.map_or(NONE, |row| row as u32);
    let mut home: Vec<u32> = direction.row_of_slot.iter().map(home).collect();
    for &(s, row) in &direction.written_by {
        home[s as usize] = row as u32;
    }
    for rows in incidence.together {
        for &r in rows {
            union.unite(rows[0], r);
        }
    }
    if !direction.methods.is_empty() {
        let relation = |r: usize| incidence.rows[r].relation;
        for own in incidence.taking_part.chunk_by(|&a, &b| relation(a) == relation(b)) {
            if own.len() > 1 && direction.method_of(relation(own[0])).is_some() {
                own.iter().for_each(|&r| union.unite(own[0], r));
            }
        }
    }
    unite_free(incidence, &mut union, &mut home);
    components(incidence, &mut union, &home)
}

/// No node, no row.
const NONE: u32 = u32::MAX;

/// The largest block in which it is looked who can be exchanged for whom, round by round.
const SMALL: usize = 16;

/// For every slot that the plan may write: no row determines it, or it can be exchanged for one that none does.
/// In: the blocks that rows and the slots that these determine fall into, each after those that it reads. None
/// where one of them is large.
pub(crate) fn exchangeable(
    blocks: &Blocks,
    rows: &Rows,
    unknown: &[bool],
    direction: &Direction,
) -> Option<Vec<bool>> {
    let is_free = |(&unknown, row): (&bool, &Option<usize>)| unknown && row.is_none();
    let mut free: Vec<bool> = unknown.iter().zip(&direction.row_of_slot).map(is_free).collect();
    for block in blocks.iter() {
        if block.rows.len() > SMALL {
            return None;
        }
        let mut grows = true;
        while grows {
            grows = false;
            for &r in block.rows {
                let own = direction.slot_of_row[r]? as usize;
                if !free[own] && rows.columns(r).iter().any(|e| free[e.0 as usize]) {
                    free[own] = true;
                    grows = block.rows.len() > 1;
                }
            }
        }
    }
    Some(free)
}

/// Splits and orders as [`order`] does, where every row has a slot, no method is written and the blocks without
/// what is free are known: what is free, which is [`exchangeable`], comes last. None where that takes more.
pub(crate) fn beside_free(
    blocks: &Blocks,
    rows: &Rows,
    (unknown, free): (&[bool], &[bool]),
    direction: &Direction,
) -> Option<Blocks> {
    let is_free = |r: usize| direction.slot_of_row[r].is_some_and(|s| free[s as usize]);
    let mut union = Union::new(rows.len());
    let mut home = vec![NONE; unknown.len()];
    let mut all = Blocks::with_room(rows.len(), unknown.len(), blocks.len() + 1);
    for block in blocks.iter() {
        for &r in block.rows {
            let mut shown = 0;
            for &(slot, _) in rows.columns(r) {
                shown += usize::from(unknown[slot as usize]);
                if free[slot as usize] {
                    match &mut home[slot as usize] {
                        home if *home == NONE => *home = r as u32,
                        home => union.unite(*home as usize, r),
                    }
                }
            }
            // what a row mentions and does not show might be free, or what is free might read it
            if shown != rows.mentions(r).iter().filter(|s| unknown[**s as usize]).count() {
                return None;
            }
        }
        if !block.rows.iter().any(|&r| is_free(r)) {
            all.add(block.rows.iter().copied(), block.unknowns.iter().copied());
        }
    }
    let free_rows = || (0..rows.len()).filter(|&r| is_free(r));
    let free_slots = || (0..).zip(&home).filter(|(_, home)| **home != NONE).map(|(s, _)| s);
    let pieces: Vec<usize> = free_rows().filter(|&r| union.find(r) == r).collect();
    if let [_] = pieces[..] {
        all.add(free_rows(), free_slots());
        return Some(all);
    }
    let mut piece = |r: usize| pieces.binary_search(&union.find(r)).map_or(0, |at| at as u32);
    let row_pairs: Vec<(u32, u32)> = free_rows().map(|r| (piece(r), r as u32)).collect();
    let slot_pairs: Vec<(u32, SlotIndex)> =
        free_slots().map(|s| (piece(home[s as usize] as usize), s)).collect();
    let rows_of = Lists::new(pieces.len(), row_pairs.iter().copied());
    let slots_of = Lists::new(pieces.len(), slot_pairs.iter().copied());
    for piece in 0..pieces.len() as u32 {
        all.add(rows_of.of(piece).iter().map(|&r| r as usize), slots_of.of(piece).iter().copied());
    }
    Some(all)
}

/// Unites every piece of the under-determined part; a slot that no row determines finds its `home` there.
fn unite_free(incidence: &Incidence<'_>, union: &mut Union, home: &mut [u32]) {
    let unknown = incidence.unknown;
    let mut stack: Vec<SlotIndex> = (0..unknown.len() as u32)
        .filter(|&s| unknown[s as usize] && home[s as usize] == NONE)
        .collect();
    if stack.is_empty() {
        return;
    }
    let mut reached = vec![false; unknown.len()];
    for &s in &stack {
        reached[s as usize] = true;
    }
    let free = |&&r: &&usize| incidence.direction.method_of(incidence.rows[r].relation).is_none();
    let columns = |&r: &usize| incidence.rows.columns(r).iter().map(move |e| (e.0, r as u32));
    let pairs = incidence.taking_part.iter().filter(free).flat_map(columns);
    let rows_of_slot = Lists::new(unknown.len(), pairs);
    while let Some(slot) = stack.pop() {
        for &r in rows_of_slot.of(slot) {
            let own = &mut home[slot as usize];
            match *own {
                NONE => *own = r,
                own => union.unite(own as usize, r as usize),
            }
            if let Some(next) = incidence.direction.slot_of_row[r as usize]
                && !std::mem::replace(&mut reached[next as usize], true)
            {
                stack.push(next);
            }
        }
    }
}

/// Strongly connected components of the united rows, each after what it reads.
fn components(incidence: &Incidence<'_>, union: &mut Union, home: &[u32]) -> Blocks {
    // nodes are numbered by their first row, so that the order is that of declaration
    let mut node_of_root = vec![NONE; incidence.rows.len()];
    let mut rows: Vec<(u32, u32)> = Vec::with_capacity(incidence.taking_part.len());
    let mut nodes = 0;
    for &r in incidence.taking_part {
        let node = &mut node_of_root[union.find(r)];
        if *node == NONE {
            *node = nodes;
            nodes += 1;
        }
        rows.push((*node, r as u32));
    }
    let node = |(&unknown, &home): (&bool, &u32)| match home {
        home if unknown && home != NONE => node_of_root[union.find(home as usize)],
        _ => NONE,
    };
    let node_of_slot: Vec<u32> = incidence.unknown.iter().zip(home).map(node).collect();
    let slots = (0..).zip(&node_of_slot).filter(|(_, n)| **n != NONE);
    if nodes == 1 {
        let mut blocks = Blocks::default();
        blocks.add(incidence.taking_part.iter().copied(), slots.map(|(s, _)| s));
        return blocks;
    }
    let edges = |&(node, r): &(u32, u32)| {
        let r = r as usize;
        let read = match incidence.method_reads.get(&incidence.rows[r].relation) {
            Some(reads) => reads,
            None => incidence.rows.mentions(r),
        };
        let read = read.iter().map(|&s| node_of_slot[s as usize]);
        read.filter(move |&b| b != node && b != NONE).map(move |b| (node, b))
    };
    let before = Lists::new(nodes as usize, rows.iter().flat_map(edges));
    let rows_of_node = Lists::new(nodes as usize, rows.iter().copied());
    let slots_of_node = Lists::new(nodes as usize, slots.map(|(s, &node)| (node, s)));
    let (all_rows, all_slots) = (rows_of_node.all().len(), slots_of_node.all().len());
    let mut blocks = Blocks::with_room(all_rows, all_slots, nodes as usize);
    strong_components(&before, &mut |nodes| {
        let rows = nodes.iter().flat_map(|&v| rows_of_node.of(v)).map(|&r| r as usize);
        blocks.add(rows, nodes.iter().flat_map(|&v| slots_of_node.of(v)).copied());
    });
    blocks
}

/// Tarjan's algorithm on `before`: components in an order in which each follows what it needs.
pub(crate) fn strong_components(before: &Lists, found: &mut dyn FnMut(&[u32])) {
    const UNSEEN: u32 = u32::MAX;
    const DONE: u32 = u32::MAX - 1;
    let n = before.len();
    // when a node was met, and the first that leads to it and that it leads to
    let mut met = vec![(UNSEEN, 0); n];
    let (mut stack, mut calls, mut count) = (Vec::with_capacity(n), Vec::with_capacity(n), 0);
    for root in 0..n as u32 {
        if met[root as usize].0 != UNSEEN {
            continue;
        }
        calls.push((root, 0));
        while let Some(&(v, edge)) = calls.last() {
            let at = v as usize;
            if edge == 0 {
                met[at] = (count, count);
                count += 1;
                stack.push(v);
            }
            if let Some(&w) = before.of(v).get(edge) {
                calls.last_mut().expect("the call was just seen").1 += 1;
                match met[w as usize].0 {
                    UNSEEN => calls.push((w, 0)),
                    DONE => {}
                    index => met[at].1 = met[at].1.min(index),
                }
                continue;
            }
            calls.pop();
            if let Some(&(parent, _)) = calls.last() {
                met[parent as usize].1 = met[parent as usize].1.min(met[at].1);
            }
            if met[at].1 == met[at].0 {
                let first = stack.iter().rposition(|&w| w == v).expect("the node is on the stack");
                stack[first..].iter().for_each(|&w| met[w as usize].0 = DONE);
                stack[first..].sort_unstable();
                found(&stack[first..]);
                stack.truncate(first);
            }
        }
    }
}
