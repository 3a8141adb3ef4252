//! Narrowing boxes by rows: what every slot may be where everything required holds.
//!
//! A row is narrowed again when a slot that it speaks of has lost something worth it. Rows hold to their
//! tolerance, so a box is left that much wider.

use crate::conditional::{Conditional, DemandKind};
use crate::pattern::Patterns;
use crate::search::{self, Cells, Domain, Linear, Sum};
use crate::system::{Level, RelationBody, SlotIndex};
use crate::truth::{Comparing, Comparison, Truth, truth};
use base::number::{RULE_TOLERANCE, Tolerance};
use expr::{Arena, ExprId, Interval};
use std::collections::VecDeque;

/// The largest whole number that a slot may hold: beyond it `f64` skips some.
const MOST: f64 = (1_u64 << 53) as f64;
/// How many times a box is narrowed for each of its rows.
const TURNS: usize = 40;

/// The required rows of a system.
#[derive(Debug)]
pub(crate) struct Net {
    arena: Arena,
    rows: Vec<Row>,
    /// For every slot, the rows that speak of it.
    watching: Vec<Vec<u32>>,
    is_whole: Vec<bool>,
    ranges: Vec<Interval>,
}

#[derive(Debug)]
struct Row {
    truth: Truth,
    within: Tolerance,
    slots: Vec<SlotIndex>,
    /// The sum with whole coefficients that it says, where it is one.
    sum: Option<Linear>,
}

impl Net {
    pub(crate) fn new(conditional: &Conditional, patterns: &Patterns) -> Self {
        let system = &conditional.system;
        let slots = &system.slots;
        let is_whole: Vec<bool> = slots.iter().map(|s| s.is_number && s.is_discrete).collect();
        let range = |&whole: &bool| match whole {
            true => Interval { low: -MOST, high: MOST },
            false => Interval::ALL,
        };
        let mut ranges: Vec<Interval> = is_whole.iter().map(range).collect();
        for r in &conditional.ranges {
            let own = &mut ranges[r.slot as usize];
            *own = own.meet(Interval { low: r.low as f64, high: r.high as f64 });
        }
        let mut domains = vec![Domain::between(-(MOST as i64), MOST as i64); slots.len()];
        for r in &conditional.ranges {
            let own = &mut domains[r.slot as usize];
            *own = own.clip(r.low, r.high);
        }
        let cells = Cells { whole: &is_whole, ranges: &domains };
        let mut arena = Arena::new();
        let mut rows = Vec::new();
        for (index, relation) in (0..).zip(&system.relations) {
            if relation.level != Level::Required {
                continue;
            }
            match relation.body {
                RelationBody::Equations(_) => {}
                RelationBody::Opaque { .. } => continue,
            }
            let mut parts = Vec::new();
            for e in system.equations_of(relation) {
                let slots = system.arguments(e.arguments);
                let sides = patterns.get(e.pattern).write_out(&mut arena, slots);
                let (left, right) = (sides[0], sides[1]);
                parts.push(Truth::Holds(Comparison { comparing: Comparing::Equal, left, right }));
            }
            for demand in conditional.demands_of(index) {
                let slots = system.arguments(demand.arguments);
                let roots = patterns.get(demand.pattern).write_out(&mut arena, slots);
                match demand.kind {
                    DemandKind::True => parts.push(truth(&mut arena, roots[0], true)),
                    DemandKind::Different => parts.extend(pairs(&roots)),
                }
            }
            let mut unless = Vec::new();
            for guard in conditional.guards_of(index) {
                let condition = &conditional.conditions[guard.condition as usize];
                let slots = system.arguments(condition.arguments);
                let root = patterns.get(condition.pattern).write_out(&mut arena, slots)[0];
                unless.push(truth(&mut arena, root, !guard.truth));
            }
            let truths = if unless.is_empty() {
                parts
            } else {
                unless.push(Truth::All(parts));
                vec![Truth::Any(unless)]
            };
            for truth in truths {
                let mut slots = Vec::new();
                slots_of(&arena, &truth, &mut slots);
                slots.sort_unstable();
                slots.dedup();
                let sum = sum(&arena, cells, &truth);
                rows.push(Row { truth, within: relation.within, slots, sum });
            }
        }
        let mut watching = vec![Vec::new(); slots.len()];
        for (index, row) in (0..).zip(&rows) {
            row.slots.iter().for_each(|&s| watching[s as usize].push(index));
        }
        Self { arena, rows, watching, is_whole, ranges }
    }

    /// Returns the boxes that are left around what is known; nothing where no box is. Counts numbers as they are
    /// narrowed.
    pub(crate) fn ground(
        &self,
        known: impl Iterator<Item = Option<f64>>,
        narrowed: &mut usize,
    ) -> Option<Vec<Interval>> {
        let own = known.zip(&self.ranges);
        let mut boxes: Vec<Interval> =
            own.map(|(known, &range)| known.map_or(range, Interval::point)).collect();
        let all = (0..self.rows.len() as u32).collect();
        self.narrow(&mut boxes, all, narrowed).then_some(boxes)
    }

    /// Returns the boxes that are left where a slot is in a part of its own.
    pub(crate) fn with(
        &self,
        boxes: &[Interval],
        slot: SlotIndex,
        part: Interval,
        narrowed: &mut usize,
    ) -> Option<Vec<Interval>> {
        *narrowed += boxes.len();
        let mut boxes = boxes.to_vec();
        boxes[slot as usize] = part;
        let rows = self.watching[slot as usize].iter().copied().collect();
        self.narrow(&mut boxes, rows, narrowed).then_some(boxes)
    }

    fn narrow(
        &self,
        boxes: &mut [Interval],
        mut waiting: VecDeque<u32>,
        narrowed: &mut usize,
    ) -> bool {
        let mut waits = vec![false; self.rows.len()];
        waiting.iter().for_each(|&r| waits[r as usize] = true);
        let mut turns = TURNS * self.rows.len();
        let mut before = Vec::new();
        while let Some(index) = waiting.pop_front() {
            if turns == 0 {
                break;
            }
            turns -= 1;
            waits[index as usize] = false;
            let row = &self.rows[index as usize];
            *narrowed += row.slots.len();
            before.clear();
            before.extend(row.slots.iter().map(|&s| boxes[s as usize]));
            let known = |slot: u32| {
                let Interval { low, high } = boxes[slot as usize];
                (low == high).then_some(low as i64)
            };
            if row.sum.as_ref().is_some_and(|sum| !sum.divides(known)) {
                return false;
            }
            if !self.leave(&row.truth, row.within, boxes) {
                return false;
            }
            for (&slot, &before) in row.slots.iter().zip(&before) {
                let own = &mut boxes[slot as usize];
                if self.is_whole[slot as usize] && *own != before {
                    *own = whole(*own);
                }
                if own.is_none() {
                    return false;
                }
                if is_worth_it(before, *own) {
                    for &row in &self.watching[slot as usize] {
                        if !std::mem::replace(&mut waits[row as usize], true) {
                            waiting.push_back(row);
                        }
                    }
                }
            }
        }
        true
    }

    /// Leaves what a truth allows; false where that is nothing.
    fn leave(&self, truth: &Truth, within: Tolerance, boxes: &mut [Interval]) -> bool {
        match truth {
            Truth::Holds(comparison) => self.leave_compared(*comparison, within, boxes),
            Truth::All(parts) => parts.iter().all(|p| self.leave(p, within, boxes)),
            Truth::Any(parts) => {
                let mut only = None;
                for part in parts {
                    let mut trial = boxes.to_vec();
                    match (self.leave(part, within, &mut trial), &only) {
                        (false, _) => {}
                        (true, None) => only = Some(trial),
                        (true, Some(_)) => return true,
                    }
                }
                if let Some(only) = &only {
                    boxes.copy_from_slice(only);
                }
                only.is_some()
            }
        }
    }

    fn leave_compared(
        &self,
        comparison: Comparison,
        within: Tolerance,
        boxes: &mut [Interval],
    ) -> bool {
        let Comparison { comparing, left, right } = comparison;
        let of = |id: ExprId, boxes: &[Interval]| self.arena.enclose(id, boxes);
        let (l, r) = (of(left, boxes), of(right, boxes));
        if l.is_none() || r.is_none() {
            return false;
        }
        // where the sides are near one another neither is larger than the smaller bound of both
        let size = size(l).min(size(r));
        let slack = 2.0 * within.allowed(size, size);
        let (of_left, of_right) = match comparing {
            Comparing::Equal => (r.inflate(slack), l.inflate(slack)),
            Comparing::AtMost | Comparing::Less => (
                Interval { low: f64::NEG_INFINITY, high: r.high + slack },
                Interval { low: l.low - slack, high: f64::INFINITY },
            ),
            Comparing::Differ => {
                let is_point = |i: Interval| i.low == i.high;
                return !(is_point(l) && l == r);
            }
        };
        self.arena.narrow(left, of_left, boxes) && self.arena.narrow(right, of_right, boxes)
    }
}

/// Returns the sum with whole coefficients that a truth says to be a constant; nothing where it says something else.
fn sum(arena: &Arena, cells: Cells<'_>, truth: &Truth) -> Option<Linear> {
    let Truth::Holds(comparison) = truth else { return None };
    match search::row(arena, cells, Truth::Holds(*comparison)) {
        search::Row::Linear(sum) if sum.comparing == Sum::Equal => Some(sum),
        _ => None,
    }
}

fn size(i: Interval) -> f64 {
    i.low.abs().max(i.high.abs())
}

/// Returns the whole numbers of an interval, those among them that are so to a tolerance.
fn whole(own: Interval) -> Interval {
    let slack = |x: f64| RULE_TOLERANCE * x.abs().max(1.0);
    let (low, high) = (own.low.max(-MOST), own.high.min(MOST));
    Interval { low: (low - slack(low)).ceil(), high: (high + slack(high)).floor() }
        .meet(Interval { low: -MOST, high: MOST })
}

/// Returns true if enough was lost for others to hear of it: an end at infinity, or a hundredth.
fn is_worth_it(before: Interval, now: Interval) -> bool {
    let width = |i: Interval| i.high - i.low;
    let is_finite = |i: Interval| (i.low.is_finite(), i.high.is_finite());
    is_finite(before) != is_finite(now) || width(now) < 0.99 * width(before)
}

fn pairs(roots: &[ExprId]) -> Vec<Truth> {
    let mut pairs = Vec::new();
    for (i, &left) in roots.iter().enumerate() {
        for &right in &roots[i + 1..] {
            pairs.push(Truth::Holds(Comparison { comparing: Comparing::Differ, left, right }));
        }
    }
    pairs
}

fn slots_of(arena: &Arena, truth: &Truth, slots: &mut Vec<SlotIndex>) {
    match truth {
        Truth::Holds(c) => {
            for side in [c.left, c.right] {
                slots.extend(arena.variables(side).into_iter().map(|v| v.0));
            }
        }
        Truth::All(parts) | Truth::Any(parts) => {
            parts.iter().for_each(|p| slots_of(arena, p, slots));
        }
    }
}
