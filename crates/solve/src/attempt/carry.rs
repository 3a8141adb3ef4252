//! What hangs on places that have moved is carried along before it is solved.
//!
//! In: where the places that a step reads began and where they are now. Out: where its targets start: moved,
//! turned and scaled as those were, as nearly as one such map can. So a sketch that only lies elsewhere is solved
//! where it is carried to, and what is solved block by block from a rough start does not fall behind.

use super::Run;
use crate::lists::Lists;
use crate::plan::Step;
use crate::system::{Slot, SlotIndex, Stay, System};

/// Which slots are the two coordinates of one place.
#[derive(Clone, Debug, Default)]
pub(crate) struct Places {
    /// In the order of the slots, each place with the slots that stand for its own.
    all: Vec<Coordinates>,
    /// For every slot, the places that it stands for a coordinate of.
    of: Lists,
}

/// The two coordinates of a place.
#[derive(Clone, Copy, Debug)]
struct Coordinates {
    own: [SlotIndex; 2],
    /// The slots that stand for them, which are computed.
    roots: [SlotIndex; 2],
}

impl Places {
    /// Finds the places of two numbers of one kind in a system, in which some slots stand for others.
    pub(crate) fn new(system: &System, stood_for: &[(SlotIndex, SlotIndex)]) -> Self {
        let root = |slot: SlotIndex| {
            let found = stood_for.binary_search_by_key(&slot, |&(s, _)| s);
            found.map_or(slot, |i| stood_for[i].1)
        };
        let group = |(slot, s): (SlotIndex, &Slot)| match s.stay {
            Stay::Kept { group } => Some((group, slot)),
            Stay::Fixed | Stay::Given(_) | Stay::Free => None,
        };
        let mut kept: Vec<(u32, SlotIndex)> = (0..).zip(&system.slots).filter_map(group).collect();
        kept.sort_unstable();
        let scale = |slot: SlotIndex| system.slots[slot as usize].scale;
        let place = |slots: &[(u32, SlotIndex)]| match *slots {
            [(_, x), (_, y)] if scale(x) == scale(y) => {
                Some(Coordinates { own: [x, y], roots: [x, y].map(root) })
            }
            _ => None,
        };
        let all: Vec<Coordinates> = kept.chunk_by(|a, b| a.0 == b.0).filter_map(place).collect();
        let roots = (0..).zip(&all).flat_map(|(n, place)| place.roots.map(|r| (r, n)));
        let of = Lists::new(system.slots.len(), roots);
        Self { all, of }
    }

    /// Returns the places that a slot stands for a coordinate of.
    fn of(&self, slot: SlotIndex) -> impl Iterator<Item = Coordinates> {
        self.of.of(slot).iter().map(|&n| self.all[n as usize])
    }
}

/// Where a place was, and where it is.
pub(super) type Move = [[f64; 2]; 2];

/// A map of the plane that keeps shapes: places as complex numbers, `to + turn * (z - from)`.
struct Similarity {
    from: [f64; 2],
    to: [f64; 2],
    turn: [f64; 2],
}

impl Similarity {
    /// Returns the one that comes nearest to moving places so, in the sum of squares.
    fn of(moves: &[Move]) -> Self {
        let count = moves.len() as f64;
        let mut middles = [[0.0; 2]; 2];
        for (middle, i) in moves.iter().flat_map(|m| [0, 1].map(|i| (m[i], i))) {
            (0..2).for_each(|c| middles[i][c] += middle[c] / count);
        }
        let [from, to] = middles;
        let (mut inner, mut cross, mut square) = (0.0, 0.0, 0.0);
        for [a, b] in moves {
            let (a, b) = ([a[0] - from[0], a[1] - from[1]], [b[0] - to[0], b[1] - to[1]]);
            inner += a[0] * b[0] + a[1] * b[1];
            cross += a[0] * b[1] - a[1] * b[0];
            square += a[0] * a[0] + a[1] * a[1];
        }
        let turn = [inner / square, cross / square];
        // one place alone tells neither turn nor scale
        let turn = if turn.iter().all(|c| c.is_finite()) { turn } else { [1.0, 0.0] };
        Self { from, to, turn }
    }

    fn at(&self, p: [f64; 2]) -> [f64; 2] {
        let ([c, s], [x, y]) = (self.turn, [p[0] - self.from[0], p[1] - self.from[1]]);
        [self.to[0] + c * x - s * y, self.to[1] + s * x + c * y]
    }
}

impl Run<'_> {
    /// Moves the targets of a step, which stand where they began, to where what it reads has carried them. Returns
    /// how many places told where: one tells of neither turn nor scale.
    pub(super) fn carry(&mut self, step: &Step) -> usize {
        let places = self.plan.coordinates();
        let at = |state: &[f64], slots: [SlotIndex; 2]| slots.map(|s| state[s as usize]);
        let mut moves = std::mem::take(&mut self.buffers.moves);
        moves.clear();
        for &read in &step.reads {
            let whole = |p: &Coordinates| p.roots[0] == read && step.reads.contains(&p.roots[1]);
            for place in places.of(read).filter(whole) {
                let to = at(self.values, place.roots);
                // places that are one tell the same, wherever each began
                if moves.iter().all(|known: &Move| known[1] != to) {
                    moves.push([at(self.last, place.own), to]);
                }
            }
        }
        if moves.iter().any(|[from, to]| from != to) {
            let map = Similarity::of(&moves);
            for &target in &step.targets {
                let own = places.of(target).find(|p| p.own.contains(&target));
                if let Some(place) = own {
                    let to = map.at(at(self.last, place.own));
                    self.values[target as usize] = to[usize::from(target == place.own[1])];
                }
            }
        }
        self.buffers.moves = moves;
        self.buffers.moves.len()
    }
}
