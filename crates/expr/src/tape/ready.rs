//! Which operation of a tape comes next: nodes whose operands are computed wait in a queue for each operation, and the
//! longest queue is a run.

use super::{NOBODY, Operation};
use crate::arena::Node;
use crate::op::{Binary, Unary};

/// Returns where a node waits for its turn.
pub(super) fn queue_of(node: Node) -> usize {
    match node {
        Node::Unary(op, _) => op as usize,
        Node::Binary(op, ..) => Unary::ALL.len() + op as usize,
        Node::Select { .. } => Unary::ALL.len() + Binary::ALL.len(),
        Node::Constant(_) | Node::Var(_) => unreachable!("constants and variables do not wait"),
    }
}

/// Nodes whose operands are computed, in a queue for each operation.
pub(super) struct Ready {
    /// How many wait in each queue, and the first and the last of them.
    queues: [(u32, u32, u32); Operation::COUNT],
    /// The queues in which somebody waits, as bits.
    waiting: u64,
    /// For every node, the next in its queue.
    next: Vec<u32>,
}

impl Ready {
    pub(super) fn new(nodes: usize) -> Self {
        const { assert!(Operation::COUNT <= 64, "there is a bit for every queue") };
        Self {
            queues: [(0, NOBODY, NOBODY); Operation::COUNT],
            waiting: 0,
            next: vec![NOBODY; nodes],
        }
    }
    pub(super) fn put_first(&mut self, queue: usize, node: usize) {
        let (count, first, last) = &mut self.queues[queue];
        self.next[node] = *first;
        *first = node as u32;
        if *count == 0 {
            *last = node as u32;
        }
        *count += 1;
        self.waiting |= 1 << queue;
    }
    pub(super) fn put_last(&mut self, queue: usize, node: usize) {
        let (count, first, last) = &mut self.queues[queue];
        self.next[node] = NOBODY;
        if *count == 0 {
            *first = node as u32;
        } else {
            self.next[*last as usize] = node as u32;
        }
        *last = node as u32;
        *count += 1;
        self.waiting |= 1 << queue;
    }
    pub(super) fn take(&mut self, queue: usize) -> Option<usize> {
        let (count, first, _) = &mut self.queues[queue];
        if *count == 0 {
            return None;
        }
        let node = *first as usize;
        *first = self.next[node];
        *count -= 1;
        if *count == 0 {
            self.waiting &= !(1 << queue);
        }
        Some(node)
    }
    /// Returns the queue in which most wait, the first of several.
    pub(super) fn longest(&self) -> Option<usize> {
        let (mut rest, mut longest) = (self.waiting, None);
        while rest != 0 {
            let queue = rest.trailing_zeros() as usize;
            rest &= rest - 1;
            let count = self.queues[queue].0;
            if longest.is_none_or(|(most, _)| count > most) {
                longest = Some((count, queue));
            }
        }
        longest.map(|(_, queue)| queue)
    }
}
