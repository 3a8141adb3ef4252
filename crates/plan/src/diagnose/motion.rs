//! Motions: the ways in which a state can move while every required constraint goes on holding.
//!
//! They are the null space of the rows at the present state, with anchors and given numbers held. Any
//! basis would do; a readable one has the motions of one place first, then those of the whole as a
//! rigid body, then what is left, shortest first. Where two curves only touch, the null space is
//! larger than the freedom: then it is that of what rows say to second order as well (`second`), and where that
//! does not tell either, a motion counts if a small step along it can be completed as it is.

use crate::aim::Aim;
use crate::diagnose::gradient::gradient;
use crate::diagnose::redundancy::Redundancy;
use crate::diagnose::second;
use crate::diagnose::trial::{Setup, Trial, scattered};
use crate::holds::counts;
use crate::host::Host;
use crate::planner::{Model, Planner};
use crate::rule::{Body, Source};
use crate::task::{Course, Holding, Task};
use kernel::{Primitive, SlotId, ThingId, Values};
use solve::echelon::{Basis, Echelon, Row, Vanishing};
use solve::{Level, Scratch};
use std::collections::{BTreeMap, BTreeSet};

/// At most so many motions of a component are listed.
const LISTED: usize = 64;

/// One way to move, to first order.
#[derive(Clone, PartialEq, Debug)]
pub struct Motion {
    /// What kind of motion it is.
    pub kind: MotionKind,
    /// The slots that move, in order, with their velocities; the largest is 1.
    pub moves: Vec<(SlotId, f64)>,
}

/// What a motion looks like.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum MotionKind {
    /// One place, or one number, alone.
    Alone,
    /// All places of a component, in one direction.
    Translation,
    /// All places of a component, about this point.
    Rotation {
        /// The centre's coordinates.
        center: [f64; 2],
    },
    /// Several that move together.
    Together,
}

/// How much of a state is free.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Freedom {
    /// In how many independent ways the numbers can move, given numbers and anchors held.
    pub freedom: usize,
    /// The slots that move in some of these ways, in order.
    pub free: Vec<SlotId>,
    /// The ways, at most 64 of each component.
    pub motions: Vec<Motion>,
}

impl Planner {
    /// Finds the ways in which a state at rest can move; `redundancy` is what is superfluous in it.
    pub fn freedom(
        &mut self,
        model: Model<'_>,
        values: &Values,
        redundancy: &Redundancy,
        host: &mut dyn Host,
    ) -> Freedom {
        self.plan_resting(model.structure);
        let tasks = self.take_resting();
        let superfluous: BTreeSet<Source> =
            redundancy.constraints.iter().map(|r| r.source).collect();
        let mut out = Freedom::default();
        let mut scratch = Scratch::default();
        let mut lone: BTreeMap<ThingId, Vec<SlotId>> = BTreeMap::new();
        for (slot, s) in model.structure.slots.iter() {
            let moves =
                self.net.rules_of(slot).is_empty() && s.primitive.is_number() && !s.is_layout;
            if moves && Self::resting_hold(model.structure, slot) == Holding::Kept {
                lone.entry(s.place.unwrap_or(s.thing)).or_default().push(slot);
            }
        }
        for slot in lone.into_values().flatten() {
            out.freedom += 1;
            out.free.push(slot);
            out.motions.push(Motion { kind: MotionKind::Alone, moves: vec![(slot, 1.0)] });
        }
        for (index, task) in tasks.iter().enumerate() {
            if matches!(task.course, Course::Search(_)) || task.is_of_layout(model.structure) {
                // whole numbers do not move by degrees, and layout is free by its nature
                continue;
            }
            let in_mode = task.by_values(self, model, values, host);
            let task = in_mode.as_ref().unwrap_or(task);
            let wanted = task.plan.report.freedom
                + redundancy.theorems.get(&index).copied().unwrap_or_default();
            out.freedom += wanted;
            if wanted == 0 {
                continue;
            }
            let mut space = Space::new(self, model, task, values, &superfluous, host);
            if space.free.len() > wanted
                && let Some(bent) = space.to_second_order(self, model, values, &mut scratch)
                && bent.free.len() == wanted
            {
                space = bent;
            }
            if space.free.len() > wanted {
                let goes_on = &mut |m: &Motion| self.goes_on(model, task, values, m, host);
                let motions = space.motions(model, values, (wanted, goes_on));
                out.free.extend(motions.iter().flat_map(|m| m.moves.iter().map(|e| e.0)));
                out.motions.extend(motions);
            } else {
                out.free.extend(space.movable());
                out.motions.extend(space.motions(model, values, (wanted, &mut |_| true)));
            }
        }
        self.give_resting(tasks);
        out.free.sort_unstable();
        out.free.dedup();
        out
    }

    /// Returns the slots of a component that can move at this state while those that do not move, as `moves` says, are
    /// constants.
    pub(crate) fn moving(
        &self,
        model: Model<'_>,
        task: &Task,
        values: &Values,
        moves: &dyn Fn(&SlotId) -> bool,
        host: &mut dyn Host,
    ) -> Vec<SlotId> {
        Space::of(self, model, task, values, (moves, &BTreeSet::new()), host).movable()
    }

    /// Returns true if a small step along a motion can be completed to one that holds, by next to nothing.
    fn goes_on(
        &mut self,
        model: Model<'_>,
        task: &Task,
        values: &Values,
        motion: &Motion,
        host: &mut dyn Host,
    ) -> bool {
        /// How far, as a part of the largest number of its kind around it, and which part of that it may be off.
        const PART: f64 = 1e-3;
        const OFF: f64 = 0.1;
        let size = size_around(model, task.component.slots(), &motion.moves, values);
        let mut there = values.clone();
        for &(s, v) in &motion.moves {
            there.numbers[s] += PART * size * v;
        }
        let asked = there.clone();
        let is_required = |r: &u32| self.rules.get(*r).shape.level == Level::Required;
        let rules: Vec<u32> = task.component.rules().iter().copied().filter(is_required).collect();
        let holding = |s| Self::resting_hold(model.structure, s);
        let setup = Setup { model, holding: &holding, aim: &Aim::default() };
        if self.try_rules(&setup, &rules, &mut there, host) != Trial::Holds {
            return false;
        }
        let is_near =
            |s: &SlotId| (there.numbers[*s] - asked.numbers[*s]).abs() <= OFF * PART * size;
        task.component.slots().iter().all(is_near)
    }
}

/// Returns the largest of the numbers of the kinds that move, one at least.
fn size_around(
    model: Model<'_>,
    slots: &[SlotId],
    moves: &[(SlotId, f64)],
    values: &Values,
) -> f64 {
    let kind = |s: &SlotId| model.structure.slots[*s].primitive;
    let is_alike = |s: &&SlotId| moves.iter().any(|m| kind(&m.0) == kind(s));
    slots.iter().filter(is_alike).map(|s| values.numbers[*s].abs()).fold(1.0, f64::max)
}

/// The null space of the required rows of a component.
struct Space {
    /// The slots that may move: the columns.
    columns: Vec<SlotId>,
    rows: Vec<Row>,
    /// For every row, which equation of which rule it is.
    stated: Vec<(u32, usize)>,
    echelon: Echelon,
    /// The columns without a pivot.
    free: Vec<u32>,
    /// Where places of the component stand that cannot move.
    held: Vec<[f64; 2]>,
}

/// Of so many motions what rows say to second order is looked at.
const BENT: usize = 64;
/// By how much numbers are moved to find how slopes turn, in parts of the largest of their kind.
const NUDGE: f64 = 1e-5;

/// Whether a motion can be made, and not to first order alone.
type GoesOn<'m> = &'m mut dyn FnMut(&Motion) -> bool;

/// Which slots can move.
type Moves<'m> = &'m dyn Fn(&SlotId) -> bool;

impl Space {
    fn new(
        planner: &Planner,
        model: Model<'_>,
        task: &Task,
        values: &Values,
        superfluous: &BTreeSet<Source>,
        host: &mut dyn Host,
    ) -> Self {
        let structure = model.structure;
        let moves = |&s: &SlotId| {
            structure.slots[s].primitive.is_number()
                && matches!(Planner::resting_hold(structure, s), Holding::Kept | Holding::Alone)
        };
        Self::of(planner, model, task, values, (&moves, superfluous), host)
    }

    /// Returns that of the slots that `moves` says can move.
    fn of(
        planner: &Planner,
        model: Model<'_>,
        task: &Task,
        values: &Values,
        (moves, superfluous): (Moves<'_>, &BTreeSet<Source>),
        host: &mut dyn Host,
    ) -> Self {
        let scratch = &mut Scratch::default();
        let structure = model.structure;
        let columns: Vec<SlotId> = task.component.slots().iter().copied().filter(moves).collect();
        let column = |s: SlotId| columns.binary_search(&s).ok().map(|i| i as u32);
        let patterns = planner.plans.patterns();
        let (mut rows, mut stated) = (Vec::<Row>::new(), Vec::new());
        for &index in task.component.rules() {
            let rule = planner.rules.get(index);
            let Body::Equations(equations) = &rule.shape.body else { continue };
            if rule.shape.level != Level::Required
                || superfluous.contains(&rule.source)
                || !counts(patterns, structure, rule, values, host, scratch)
            {
                continue;
            }
            for (place, equation) in equations.iter().enumerate() {
                stated.push((index, place));
                let row = gradient(patterns, rule, equation, &values.numbers, scratch);
                rows.push(row.into_iter().filter_map(|(s, v)| Some((column(s)?, v))).collect());
            }
        }
        let echelon = Echelon::new(&rows, columns.len());
        let free = (0..columns.len() as u32).filter(|&c| !echelon.has_pivot(c)).collect();
        let mut held: BTreeMap<ThingId, Vec<f64>> = BTreeMap::new();
        for &s in task.component.slots().iter().filter(|&&s| column(s).is_none()) {
            if let Some(place) = structure.slots[s].place {
                held.entry(place).or_default().push(values.numbers[s]);
            }
        }
        let held = held.into_values().filter_map(|c| <[f64; 2]>::try_from(c).ok()).collect();
        Self { columns, rows, stated, echelon, free, held }
    }

    /// Returns the same with what the rows say to second order; nothing where too much is free.
    fn to_second_order(
        &self,
        planner: &Planner,
        model: Model<'_>,
        values: &Values,
        scratch: &mut Scratch,
    ) -> Option<Self> {
        if self.free.len() > BENT {
            return None;
        }
        let slope = |r: u32| self.rows[r as usize].iter().fold(0.0f64, |m, e| m.max(e.1.abs()));
        let free = self.free.iter().copied();
        let motions: Vec<(u32, Row)> = free.zip(self.echelon.complete_each(&self.free)).collect();
        let slots = |motion: &Row| -> Vec<(SlotId, f64)> {
            motion.iter().map(|&(c, v)| (self.columns[c as usize], v)).collect()
        };
        let all: Vec<(SlotId, f64)> = motions.iter().flat_map(|m| slots(&m.1)).collect();
        let size = size_around(model, &self.columns, &all, values);
        // sums are of rows whose largest slope is one
        let sums: Vec<(Vanishing, f64)> =
            self.echelon.vanishing().into_iter().map(|sum| (sum, 1.0 / size)).collect();
        let patterns = planner.plans.patterns();
        let turned = |sum: &Vanishing, motion: &Row| -> Row {
            let largest = motion.iter().fold(0.0f64, |m, e| m.max(e.1.abs()));
            let by = NUDGE * size / largest;
            let mut turned = vec![0.0; self.columns.len()];
            for by in [by, -by] {
                let mut there = values.numbers.clone();
                slots(motion).into_iter().for_each(|(s, v)| there[s] += by * v);
                for &(r, share) in &sum.sum {
                    let (rule, place) = self.stated[r as usize];
                    let rule = planner.rules.get(rule);
                    let Body::Equations(equations) = &rule.shape.body else { continue };
                    let share = share / slope(r);
                    for (s, v) in gradient(patterns, rule, &equations[place], &there, scratch) {
                        if let Ok(c) = self.columns.binary_search(&s) {
                            turned[c] += share * v / (2.0 * by);
                        }
                    }
                }
            }
            (0..).zip(turned).filter(|e| e.1 != 0.0).collect()
        };
        let equations = second::equations(&motions, &sums, turned);
        let rows = [self.rows.clone(), equations].concat();
        let echelon = Echelon::new(&rows, self.columns.len());
        let free = (0..self.columns.len() as u32).filter(|&c| !echelon.has_pivot(c)).collect();
        let (columns, stated, held) =
            (self.columns.clone(), self.stated.clone(), self.held.clone());
        Some(Self { columns, rows, stated, echelon, free, held })
    }

    /// Returns the slots that some motion moves: those that a motion of no particular kind does.
    fn movable(&self) -> Vec<SlotId> {
        let any: Row = self.free.iter().map(|&c| (c, scattered(c))).collect();
        let moves = self.echelon.complete(&any);
        moves.iter().map(|&(c, _)| self.columns[c as usize]).collect()
    }

    /// Returns a readable basis of so many motions that go on.
    fn motions(
        &self,
        model: Model<'_>,
        values: &Values,
        (wanted, goes_on): (usize, GoesOn<'_>),
    ) -> Vec<Motion> {
        if self.free.is_empty() {
            return Vec::new();
        }
        let mut groups: BTreeMap<ThingId, Vec<u32>> = BTreeMap::new();
        for (c, &s) in (0..).zip(&self.columns) {
            let slot = &model.structure.slots[s];
            groups.entry(slot.place.unwrap_or(slot.thing)).or_default().push(c);
        }
        let mut rows_of: Vec<Vec<u32>> = vec![Vec::new(); self.columns.len()];
        for (r, row) in (0..).zip(&self.rows) {
            row.iter().for_each(|e| rows_of[e.0 as usize].push(r));
        }
        let mut chosen = Chosen {
            space: self,
            rows_of: &rows_of,
            velocity: vec![0.0; self.columns.len()],
            known: Basis::default(),
            motions: Vec::new(),
            tried: 0,
            most: wanted.min(self.free.len()).min(LISTED),
            goes_on,
        };
        let mut by_first: Vec<&Vec<u32>> = groups.values().collect();
        by_first.sort();
        for group in &by_first {
            self.alone(group, &mut chosen);
        }
        let planar = |c: u32| {
            let s = &model.structure.slots[self.columns[c as usize]];
            s.place.is_some() && matches!(s.primitive, Primitive::Real(_))
        };
        let places: Vec<[u32; 2]> = by_first
            .iter()
            .filter_map(|g| <[u32; 2]>::try_from(g.as_slice()).ok())
            .filter(|g| g.iter().all(|&c| planar(c)))
            .collect();
        self.rigid(&places, values, &mut chosen);
        let mut rest = self.echelon.complete_each(&self.free[..self.free.len().min(4 * LISTED)]);
        rest.sort_by_key(Vec::len);
        for row in rest {
            chosen.consider(MotionKind::Together, row);
        }
        chosen.motions
    }

    /// Adds the motions of one place or number alone.
    fn alone(&self, group: &[u32], chosen: &mut Chosen<'_>) {
        let rows_of = chosen.rows_of;
        if self.is_held(group, rows_of) {
            return;
        }
        let touching: BTreeSet<u32> =
            group.iter().flat_map(|&c| rows_of[c as usize].iter().copied()).collect();
        let own = |r: u32| -> Row {
            let row = self.rows[r as usize].iter();
            let place = |c: u32| group.iter().position(|&g| g == c).map(|i| i as u32);
            row.filter_map(|&(c, v)| Some((place(c)?, v))).collect()
        };
        let rows: Vec<Row> = touching.into_iter().map(own).collect();
        let echelon = Echelon::new(&rows, group.len());
        for c in (0..group.len() as u32).filter(|&c| !echelon.has_pivot(c)) {
            let motion = echelon.complete(&[(c, 1.0)]);
            let motion = motion.into_iter().map(|(c, v)| (group[c as usize], v)).collect();
            chosen.consider(MotionKind::Alone, motion);
        }
    }

    /// Adds the motions of all places as one rigid body.
    fn rigid(&self, places: &[[u32; 2]], values: &Values, chosen: &mut Chosen<'_>) {
        if places.len() < 2 {
            return;
        }
        for along in [0, 1] {
            chosen.consider(
                MotionKind::Translation,
                places.iter().map(|p| (p[along], 1.0)).collect(),
            );
        }
        let at = |c: u32| values.numbers[self.columns[c as usize]];
        let mean = |i: usize| places.iter().map(|p| at(p[i])).sum::<f64>() / places.len() as f64;
        let centers = self.held.iter().copied().chain([[mean(0), mean(1)]]);
        for center in centers {
            let turn = places
                .iter()
                .flat_map(|p| [(p[0], center[1] - at(p[1])), (p[1], at(p[0]) - center[0])])
                .filter(|e| e.1 != 0.0);
            let mut turn: Row = turn.collect();
            turn.sort_unstable_by_key(|e| e.0);
            chosen.consider(MotionKind::Rotation { center }, turn);
        }
    }

    /// Returns true if the rows that speak of a number, or of a place in the plane, clearly leave it no motion
    /// of its own.
    fn is_held(&self, group: &[u32], rows_of: &[Vec<u32>]) -> bool {
        /// The sine, about, of an angle between directions that are two for certain: far above rounding, so that
        /// the joints of a long loop, whose bars hardly turn, are held at a glance.
        const APART: f64 = 1e-4;
        let touching = |c: u32| rows_of[c as usize].iter().map(|&r| &self.rows[r as usize]);
        let slope = |row: &Row, c: u32| row.iter().find(|e| e.0 == c).map_or(0.0, |e| e.1);
        match *group {
            [c] => touching(c).next().is_some(),
            [x, y] => {
                let mut directions = touching(x).chain(touching(y)).map(|row| {
                    let (a, b) = (slope(row, x), slope(row, y));
                    let size = a.abs().max(b.abs());
                    (a / size, b / size)
                });
                directions
                    .next()
                    .is_some_and(|(p, q)| directions.any(|(a, b)| f64::abs(a * q - b * p) > APART))
            }
            _ => false,
        }
    }
}

/// The motions chosen so far.
struct Chosen<'s> {
    space: &'s Space,
    /// For every column, the rows that it stands in.
    rows_of: &'s [Vec<u32>],
    /// Room for a velocity of every column.
    velocity: Vec<f64>,
    /// The free columns of the chosen ones: a motion is known by these alone.
    known: Basis,
    motions: Vec<Motion>,
    /// How many were tried whether they go on: no more than are listed, since each try solves the component.
    tried: usize,
    /// So many are chosen.
    most: usize,
    goes_on: GoesOn<'s>,
}

impl Chosen<'_> {
    fn consider(&mut self, kind: MotionKind, mut row: Row) {
        let space = self.space;
        let is_over = self.motions.len() == self.most || self.tried == LISTED;
        if is_over || row.is_empty() || !self.is_null(&row) {
            return;
        }
        row.sort_unstable_by_key(|e| e.0);
        let shadow = row.iter().filter(|e| !space.echelon.has_pivot(e.0)).copied().collect();
        let mut known = self.known.clone();
        if !known.add(&shadow) {
            return;
        }
        let largest = row.iter().fold(0.0f64, |m, e| if e.1.abs() > m.abs() { e.1 } else { m });
        let moves = row.iter().map(|&(c, v)| (space.columns[c as usize], v / largest)).collect();
        let motion = Motion { kind, moves };
        self.tried += 1;
        // those that do not go on are no reason to leave out one that they make together
        if (self.goes_on)(&motion) {
            self.known = known;
            self.motions.push(motion);
        }
    }
    /// Returns true if every row goes on holding along a motion.
    fn is_null(&mut self, motion: &Row) -> bool {
        /// States are solved to about 1e-12.
        const ROUNDING: f64 = 1e-8;
        let Self { space, rows_of, velocity, .. } = self;
        motion.iter().for_each(|&(c, v)| velocity[c as usize] = v);
        let holds = |&r: &u32| {
            let (mut sum, mut size) = (0.0, 0.0f64);
            for &(c, v) in &space.rows[r as usize] {
                let term = v * velocity[c as usize];
                sum += term;
                size = size.max(term.abs());
            }
            f64::abs(sum) <= ROUNDING * size
        };
        let is_null = motion.iter().flat_map(|e| &rows_of[e.0 as usize]).all(holds);
        motion.iter().for_each(|e| velocity[e.0 as usize] = 0.0);
        is_null
    }
}
