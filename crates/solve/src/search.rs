//! Search: whole numbers that rules leave a finite choice of.
//!
//! In: a [`Conditional`] system whose slots are all whole numbers, compiled once to a [`Puzzle`]. Out,
//! for any values: the nearest solution, or how many there are. Domains shrink by propagation; what
//! stays open is explored depth first, the same way in every run.
//!
//! Of several solutions the nearest is taken. Near is, one after the other: how far `strong` relations
//! are from holding, then the wish of a drag, then `medium` and `weak` ones, all in sums of squares; what is true
//! or not is met or not met, in order of declaration, and the sum stands where the first number does. Then
//! the sum of the squared changes of given numbers, then that of the others. Given numbers are tried as
//! constants first, and yield only where nothing else can. Of solutions that are equally near the
//! first found counts: cells are taken by the number of their values, then by declaration. Once there
//! is a solution nearer ones are looked for in [`IMPROVING`] more states and no further.

mod domain;
mod explore;
mod propagate;
mod row;

use crate::conditional::{Conditional, DemandKind};
use crate::pattern::Patterns;
use crate::system::{RelationBody, Slot, SlotIndex, Stay};
use crate::truth::{Comparing, Comparison, Truth, is_truth, truth};
pub(crate) use domain::Domain;
use domain::MOST;
use explore::{End, Net, Visitor, explore};
use expr::{Arena, ExprId};
use propagate::{Field, Prospect};
pub(crate) use row::{Cells, Linear, Row, Sum, row};
use row::{different, whole_number};

/// How many states are visited in search of a solution.
pub const PATIENCE: u64 = 200_000;
/// How many more are visited in search of a nearer one.
pub const IMPROVING: u64 = 5_000;
/// What a search, or counting solutions, may cost, in multiplications, roughly.
pub const COUNTING: u64 = 2_000_000_000;

/// What is searched, for any values of what is known.
#[derive(Debug)]
pub struct Puzzle {
    arena: Arena,
    stays: Vec<Stay>,
    whole: Vec<bool>,
    ranges: Vec<Domain>,
    required: Vec<Row>,
    soft: Vec<Soft>,
    /// How many places soft relations have in a distance.
    ranks: usize,
}

/// A relation that is wished.
#[derive(Debug)]
struct Soft {
    /// Where its error counts in a distance.
    rank: usize,
    wish: Wish,
}

/// What is wished: sides that are equal, or a row that holds.
#[derive(Debug)]
enum Wish {
    Equal(ExprId, ExprId),
    Row(Row),
}

/// How far a state is from what is wished: by rank, the first counts most; then from where given numbers were, then
/// from where the others were.
type Distance = Vec<f64>;

/// What came of a search.
#[derive(Clone, PartialEq, Debug)]
pub enum Verdict {
    /// A solution: a value for every slot.
    Found(Vec<f64>),
    /// There is none.
    Impossible,
    /// None was found in so many states, and there may be one.
    NotDecided {
        /// How many states were visited.
        visited: u64,
    },
}

/// How many solutions there are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Count {
    /// How many were found.
    pub solutions: u64,
    /// True if there are no others.
    pub is_complete: bool,
}

impl Count {
    /// Returns how many there are together of two things that have nothing to do with one another.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let is_none = |count: Self| count.is_complete && count.solutions == 0;
        Self {
            solutions: self.solutions.saturating_mul(other.solutions),
            is_complete: self.is_complete && other.is_complete || is_none(self) || is_none(other),
        }
    }
}

impl Puzzle {
    /// Compiles a system of whole numbers. Values play no part in it.
    pub fn new(conditional: &Conditional, patterns: &Patterns) -> Self {
        let system = &conditional.system;
        let mut arena = Arena::new();
        let mut ranges = vec![Domain::between(-MOST, MOST); system.slots.len()];
        for r in &conditional.ranges {
            let range = &mut ranges[r.slot as usize];
            *range = range.clip(r.low, r.high);
        }
        let whole: Vec<bool> = system.slots.iter().map(|s| s.is_discrete).collect();
        let cells = Cells { whole: &whole, ranges: &ranges };
        let mut conditions = Vec::new();
        for c in &conditional.conditions {
            let slots = system.arguments(c.arguments);
            conditions.push(patterns.get(c.pattern).write_out(&mut arena, slots)[0]);
        }
        let (mut required, mut soft) = (Vec::new(), Vec::<(usize, Wish)>::new());
        for (index, relation) in (0..).zip(&system.relations) {
            let mut rows = Vec::new();
            let mut equal = Vec::new();
            match &relation.body {
                RelationBody::Equations(_) => {}
                RelationBody::Opaque { .. } => continue,
            }
            for e in system.equations_of(relation) {
                let slots = system.arguments(e.arguments);
                let sides = patterns.get(e.pattern).write_out(&mut arena, slots);
                equal.push((sides[0], sides[1]));
            }
            for demand in conditional.demands_of(index) {
                let slots = system.arguments(demand.arguments);
                let roots = patterns.get(demand.pattern).write_out(&mut arena, slots);
                rows.push(match demand.kind {
                    DemandKind::True => {
                        let truth = truth(&mut arena, roots[0], true);
                        row(&arena, cells, truth)
                    }
                    DemandKind::Different => different(&arena, cells, &roots),
                });
            }
            let unless: Vec<Row> = conditional
                .guards_of(index)
                .iter()
                .map(|g| {
                    let not = truth(&mut arena, conditions[g.condition as usize], !g.truth);
                    row(&arena, cells, not)
                })
                .collect();
            let rank = relation.level.rank();
            if let (Some(rank), true) = (rank, unless.is_empty()) {
                let wishes = equal.iter().map(|&(l, r)| Wish::Equal(l, r));
                soft.extend(wishes.chain(rows.into_iter().map(Wish::Row)).map(|wish| (rank, wish)));
                continue;
            }
            rows.extend(equal.into_iter().map(|(left, right)| {
                let comparing = Comparing::Equal;
                row(&arena, cells, Truth::Holds(Comparison { comparing, left, right }))
            }));
            if !unless.is_empty() {
                let mut ways = unless;
                ways.push(Row::All(std::mem::take(&mut rows)));
                rows.push(Row::Any(ways));
            }
            match rank {
                Some(rank) => {
                    soft.extend(rows.into_iter().map(|r| (rank, Wish::Row(r))));
                }
                None => required.extend(rows.into_iter().flat_map(split)),
            }
        }
        let stay = |(slot, is_only_read): (&Slot, bool)| match (slot.stay, is_only_read) {
            (Stay::Given(_) | Stay::Kept { .. }, true) => Stay::Fixed,
            (stay @ (Stay::Fixed | Stay::Given(_) | Stay::Kept { .. } | Stay::Free), _) => stay,
        };
        let stays = system.slots.iter().zip(conditional.only_read()).map(stay).collect();
        let of_slot = |slot: u32| {
            let range = &ranges[slot as usize];
            range.size() == 2 && range.low() == 0
        };
        let (soft, ranks) = ranked(soft, |wish| match wish {
            Wish::Equal(left, right) => {
                [*left, *right].iter().all(|side| is_truth(&arena, *side, &of_slot))
            }
            Wish::Row(_) => true,
        });
        Self { arena, stays, whole, ranges, required, soft, ranks }
    }

    /// Finds the solution nearest to where the slots were.
    ///
    /// `start` is the state when the edit began; `values` is the same with what the edit set. A slot
    /// without a stay is looked for near zero.
    pub fn nearest(&self, start: &[f64], values: &[f64]) -> Verdict {
        self.nearest_within(start, values, &mut Effort::default())
    }

    /// Does the same, and counts what it costs: it ends where that is spent.
    pub(crate) fn nearest_within(
        &self,
        start: &[f64],
        values: &[f64],
        effort: &mut Effort,
    ) -> Verdict {
        let held = self.nearest_with(start, values, Given::Held, effort);
        if let Ended::Found(values, distance) = &held
            && distance[..self.ranks].iter().all(|&d| d == 0.0)
        {
            return Verdict::Found(values.clone());
        }
        if !self.stays.iter().any(|stay| stay.is_given()) {
            return held.verdict();
        }
        let released = self.nearest_with(start, values, Given::Released, effort);
        match (held, released) {
            (Ended::Found(a, x), Ended::Found(b, y)) => {
                Verdict::Found(if is_less(&y, &x) { b } else { a })
            }
            (found @ Ended::Found(..), Ended::None | Ended::Bound(_)) => found.verdict(),
            (Ended::None | Ended::Bound(_), released) => released.verdict(),
        }
    }

    /// Counts the solutions with given numbers held, until there are `enough` or it has cost what is `left`, which is
    /// [`COUNTING`] at first.
    pub fn count(&self, values: &[f64], enough: u64, left: &mut u64) -> Count {
        let none = Count { solutions: 0, is_complete: true };
        let Some(ground) = self.ground(values, values, Given::Held) else { return none };
        let mut field = Field::new(&self.arena, ground.domains, &ground.known);
        field.most = *left;
        let net = Net::new(self.required.iter().collect(), &mut field);
        if net.settle_all(&mut field).is_err() {
            return none;
        }
        let mut counting = Counting { solutions: 0, enough };
        let end = explore(&net, &mut field, &ground.near, &mut counting);
        *left = left.saturating_sub(field.spent);
        Count { solutions: counting.solutions, is_complete: end == End::Exhausted }
    }

    /// Finds other solutions, in which some of `own` are otherwise than in `values`: for each thing that they can
    /// be the nearest, at `most` so many, as far as [`IMPROVING`] states reach.
    pub fn others(&self, values: &[f64], own: &[SlotIndex], most: usize) -> Vec<Vec<f64>> {
        let Some(ground) = self.ground(values, values, Given::Held) else { return Vec::new() };
        let mut field = Field::new(&self.arena, ground.domains, &ground.known);
        let net = Net::new(self.required.iter().collect(), &mut field);
        if net.settle_all(&mut field).is_err() {
            return Vec::new();
        }
        let known = &ground.known;
        let mut visitor = Others { values, known, own, found: Vec::new() };
        explore(&net, &mut field, values, &mut visitor);
        let mut found = visitor.found;
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        found.into_iter().take(most).map(|(_, solution)| solution).collect()
    }

    fn nearest_with(
        &self,
        start: &[f64],
        values: &[f64],
        given: Given,
        effort: &mut Effort,
    ) -> Ended {
        let Some(ground) = self.ground(start, values, given) else { return Ended::None };
        let mut field = Field::new(&self.arena, ground.domains, &ground.known);
        (field.spent, field.most) = (effort.spent, effort.most);
        let net = Net::new(self.required.iter().collect(), &mut field);
        if net.settle_all(&mut field).is_err() {
            effort.spent = field.spent;
            return Ended::None;
        }
        let mut improving = Improving {
            puzzle: self,
            near: &ground.near,
            best: None,
            at: 0,
            visited: 0,
            more: effort.improving,
        };
        let end = explore(&net, &mut field, &ground.near, &mut improving);
        effort.spent = field.spent;
        match (improving.best, end) {
            (Some((found, distance)), _) => {
                let exact = |(d, known): (&Domain, &Option<f64>)| known.unwrap_or(d.low() as f64);
                Ended::Found(found.iter().zip(&ground.known).map(exact).collect(), distance)
            }
            (None, End::Exhausted | End::Content) => Ended::None,
            (None, End::Bound(visited)) => Ended::Bound(visited),
        }
    }

    /// States the domains of a run; nothing where a required row speaks of a number that is not whole.
    fn ground(&self, start: &[f64], values: &[f64], given: Given) -> Option<Ground> {
        let n = self.stays.len();
        let (mut domains, mut known) = (Vec::with_capacity(n), vec![None; n]);
        let mut near = Vec::with_capacity(n);
        for (i, stay) in self.stays.iter().enumerate() {
            let is_known = match stay {
                Stay::Fixed => true,
                Stay::Given(_) => given == Given::Held,
                Stay::Kept { .. } | Stay::Free => false,
            };
            near.push(match stay {
                Stay::Free => 0.0,
                Stay::Fixed | Stay::Given(_) | Stay::Kept { .. } => start[i],
            });
            if !is_known {
                domains.push(self.ranges[i]);
                continue;
            }
            known[i] = Some(values[i]);
            domains.push(match whole_number(values[i]) {
                Some(v) if self.whole[i] => self.ranges[i].clip(v, v),
                Some(_) | None => Domain::one(0),
            });
        }
        let is_odd = |&c: &SlotIndex| {
            let known: Option<f64> = known[c as usize];
            self.whole[c as usize] && known.is_some_and(|x| whole_number(x).is_none())
        };
        let impossible = domains.iter().any(|d| d.is_empty())
            || self.required.iter().any(|r| r.cells().iter().any(is_odd));
        (!impossible).then_some(Ground { domains, known, near })
    }

    /// Returns a distance that no solution within the domains comes below.
    fn distance(&self, field: &Field<'_>, near: &[f64]) -> Distance {
        let (given, kept) = (self.ranks, self.ranks + 2);
        let mut distance = vec![0.0; kept + 1];
        for (i, stay) in self.stays.iter().enumerate() {
            let rank = match stay {
                Stay::Fixed => continue,
                Stay::Given(giver) => given + *giver as usize,
                Stay::Kept { .. } | Stay::Free => kept,
            };
            let away = field.domains[i].nearest(near[i]) as f64 - near[i];
            distance[rank] += away * away;
        }
        for soft in &self.soft {
            distance[soft.rank] += match &soft.wish {
                Wish::Equal(left, right) => {
                    let (l, r) = (field.enclose(*left), field.enclose(*right));
                    let gap = (l.low - r.high).max(r.low - l.high).max(0.0);
                    if gap.is_finite() { gap * gap } else { 0.0 }
                }
                Wish::Row(row) => {
                    let mut trial = field.again();
                    f64::from(u8::from(trial.prospect(row) == Prospect::Never))
                }
            };
        }
        distance
    }
}

/// What a run starts from.
struct Ground {
    domains: Vec<Domain>,
    known: Vec<Option<f64>>,
    near: Vec<f64>,
}

/// What a search has cost, in multiplications, roughly, what it may, and how many states more are visited in search
/// of a nearer solution.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effort {
    pub(crate) spent: u64,
    pub(crate) most: u64,
    pub(crate) improving: u64,
}

impl Default for Effort {
    fn default() -> Self {
        Self { spent: 0, most: COUNTING, improving: IMPROVING }
    }
}

/// Whether given numbers are constants.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Given {
    Held,
    Released,
}

enum Ended {
    Found(Vec<f64>, Distance),
    None,
    Bound(u64),
}

impl Ended {
    fn verdict(self) -> Verdict {
        match self {
            Self::Found(values, _) => Verdict::Found(values),
            Self::None => Verdict::Impossible,
            Self::Bound(visited) => Verdict::NotDecided { visited },
        }
    }
}

/// Looks for the nearest solution.
struct Improving<'a> {
    puzzle: &'a Puzzle,
    near: &'a [f64],
    best: Option<(Vec<Domain>, Distance)>,
    /// How many states had been visited when the first solution was found.
    at: u64,
    visited: u64,
    /// How many states more are visited then.
    more: u64,
}

impl Visitor for Improving<'_> {
    fn enter(&mut self, field: &Field<'_>) -> bool {
        self.visited += 1;
        let Some((_, best)) = &self.best else { return true };
        is_less(&self.puzzle.distance(field, self.near), best)
    }
    fn found(&mut self, field: &Field<'_>) -> bool {
        let distance = self.puzzle.distance(field, self.near);
        if self.best.is_none() {
            self.at = self.visited;
        }
        let is_away = distance.iter().any(|&d| d > 0.0);
        if self.best.as_ref().is_none_or(|(_, best)| is_less(&distance, best)) {
            self.best = Some((field.domains.clone(), distance));
        }
        is_away
    }
    fn patience(&self, visited: u64) -> u64 {
        let bound = if self.best.is_some() { self.at + self.more } else { PATIENCE };
        bound.saturating_sub(visited)
    }
}

/// Collects solutions that are otherwise in some slots.
struct Others<'a> {
    values: &'a [f64],
    known: &'a [Option<f64>],
    own: &'a [SlotIndex],
    /// How far each is from the values, and what it is.
    found: Vec<(f64, Vec<f64>)>,
}

impl Visitor for Others<'_> {
    fn enter(&mut self, _: &Field<'_>) -> bool {
        true
    }
    fn found(&mut self, field: &Field<'_>) -> bool {
        let exact = |(d, known): (&Domain, &Option<f64>)| known.unwrap_or(d.low() as f64);
        let solution: Vec<f64> = field.domains.iter().zip(self.known).map(exact).collect();
        let own_alike =
            |a: &[f64], b: &[f64]| self.own.iter().all(|&s| a[s as usize] == b[s as usize]);
        if own_alike(&solution, self.values) {
            return true;
        }
        let away: f64 = solution.iter().zip(self.values).map(|(a, b)| (a - b) * (a - b)).sum();
        match self.found.iter_mut().find(|(_, known)| own_alike(known, &solution)) {
            Some(known) if away < known.0 => *known = (away, solution),
            Some(_) => {}
            None => self.found.push((away, solution)),
        }
        true
    }
    fn patience(&self, visited: u64) -> u64 {
        IMPROVING.saturating_sub(visited)
    }
}

/// Counts solutions, until there are enough.
struct Counting {
    solutions: u64,
    enough: u64,
}

impl Visitor for Counting {
    fn enter(&mut self, _: &Field<'_>) -> bool {
        true
    }
    fn found(&mut self, _: &Field<'_>) -> bool {
        self.solutions += 1;
        self.solutions < self.enough
    }
    fn patience(&self, _: u64) -> u64 {
        u64::MAX
    }
}

/// Gives wishes, each with the rank of its level, their places in a distance, and returns how many these are. What is
/// true or not has one of its own; the numbers of a level share that of the first.
fn ranked(wishes: Vec<(usize, Wish)>, is_truth: impl Fn(&Wish) -> bool) -> (Vec<Soft>, usize) {
    let mut order: Vec<usize> = (0..wishes.len()).collect();
    order.sort_by_key(|&i| wishes[i].0);
    let mut place = vec![0; wishes.len()];
    let mut places = 0;
    let mut numbers = None;
    for i in order {
        let level = wishes[i].0;
        place[i] = match numbers {
            Some((of, known)) if of == level && !is_truth(&wishes[i].1) => known,
            _ => {
                places += 1;
                places - 1
            }
        };
        if !is_truth(&wishes[i].1) {
            numbers = Some((level, place[i]));
        }
    }
    let soft = wishes.into_iter().zip(place).map(|((_, wish), rank)| Soft { rank, wish });
    (soft.collect(), places)
}

/// Returns true if the first is nearer.
fn is_less(a: &Distance, b: &Distance) -> bool {
    let differs = a.iter().zip(b).find(|(x, y)| x != y);
    differs.is_some_and(|(x, y)| x < y)
}

/// Takes a conjunction apart.
fn split(row: Row) -> Vec<Row> {
    match row {
        Row::All(rows) => rows.into_iter().flat_map(split).collect(),
        other @ (Row::Linear(_) | Row::Different(_) | Row::General(_) | Row::Any(_)) => vec![other],
    }
}
