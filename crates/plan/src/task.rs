//! Tasks: one component in one edit, stated as a system with slots and rules numbered within it.
//!
//! Equal components have equal systems whatever their slots and rules are called in the document,
//! so that one plan serves all of them.

pub(crate) mod restated;
mod stating;

use crate::component::{Component, Net};
use crate::planner::Planner;
use crate::plans::Plans;
use crate::rule::{Formula, Rules, Source};
use crate::vanish::Pair;
use crate::whole::{self, Whole};
use base::{IdVec, Mixer};
use indexmap::IndexMap;
use kernel::{Primitive, SlotId, Structure};
use solve::pieces::taken_apart;
use solve::{
    Conditional, Giver, Level, Method, MethodBody, Mode, Modes, Patterns, Plan, Puzzle, Relation,
    RelationBody, SlotIndex, Stay, System,
};
use stating::Making;
use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::hash::BuildHasherDefault;
use std::rc::Rc;

/// What holds a slot of the document in an edit.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Holding {
    /// Anchored, or set in this edit.
    Fixed,
    /// A given number.
    Given(Giver),
    /// Its present value, with the other coordinates of its place.
    Kept,
    /// Its present value, alone: a coordinate that the edit speaks of.
    Alone,
    /// Nothing yet.
    Free,
}

impl Holding {
    /// Returns a number below 16 that tells it from the others.
    fn number(self) -> u32 {
        match self {
            Self::Fixed => 0,
            Self::Given(giver) => 1 + giver as u32,
            Self::Kept => 3,
            Self::Alone => 4,
            Self::Free => 5,
        }
    }
}

/// Expressions that shall take the values of a target.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Wish {
    pub(crate) level: Level,
    /// One for each coordinate.
    pub(crate) formulas: Vec<Formula<SlotId>>,
}

impl Wish {
    /// Returns the slots that it speaks of, in order.
    pub(crate) fn slots(&self) -> Vec<SlotId> {
        let all: BTreeSet<SlotId> = self.formulas.iter().flat_map(|f| f.slots.to_vec()).collect();
        all.into_iter().collect()
    }
}

/// One component in one edit.
#[derive(Clone, Debug)]
pub(crate) struct Task {
    /// What is solved; where modes are, in the mode that stands.
    pub(crate) system: Rc<System>,
    pub(crate) plan: Rc<Plan>,
    pub(crate) course: Course,
    /// The rules and slots of the document that it is about. Its slots are the system's first.
    pub(crate) component: Component,
    /// What the system's slots and relations are in a component, whichever it is.
    stated: Rc<Stated>,
}

/// How a component is solved.
#[derive(Clone, Debug)]
pub(crate) enum Course {
    /// By its plan.
    Plan,
    /// By the plan of one of its modes.
    Modes(Rc<Modes>, Box<Mode>),
    /// By search.
    Search(Rc<Puzzle>),
}

/// How a system speaks of a component: the same for all components that are alike.
#[derive(Debug, Default)]
struct Stated {
    /// Slots of the system that hold what another had when the edit began.
    holds: Vec<(SlotIndex, SlotIndex)>,
    /// Slots of the system that hold coordinates of wishes: wish and coordinate.
    targets: Vec<(SlotIndex, u32, u32)>,
    /// Slots of the system that hold what the host computes beside rules, which are those of the component.
    numbers: Vec<(SlotIndex, Number)>,
    /// For every source in the system, the rule of the component or the wish that it is.
    relations: Vec<Origin>,
    /// The number of its plan, where what that comes to depends on numbers alone.
    number: Option<u32>,
    /// How its whole numbers are looked for, where some are among real unknowns.
    whole: Option<Rc<Whole>>,
    /// What it is with every equation with an `if` taken apart, where some have; found when first asked
    /// for.
    pieces: OnceCell<Option<Whole>>,
    /// The component's slots that can move while nothing is edited; found when first asked for.
    movable: OnceCell<Vec<SlotIndex>>,
    /// The rows that may depend on others at some state; found when first asked for.
    core: OnceCell<Vec<(u32, u32)>>,
    /// The places that its rules speak of, two by two; found when first asked for.
    pairs: OnceCell<Vec<Pair>>,
    /// Where what such components are at rest is known among all; noted when first asked for.
    at_rest: OnceCell<u32>,
    /// What it is where numbers let go that its plan holds; found when first asked for.
    letting_go: OnceCell<Option<Known>>,
    /// What it is with the rules left to the test that others imply by a theorem; found in a state that holds.
    implied: OnceCell<Option<Known>>,
}

/// What components without wishes were stated as, by what there is to see of them.
#[derive(Debug, Default)]
pub(crate) struct Alike {
    known: IndexMap<Box<[u32]>, Known, BuildHasherDefault<Mixer>>,
    signature: Vec<u32>,
    /// What is stored in slots, each kind once.
    kinds: Vec<Primitive>,
}

/// A system, its plan, and how it speaks of a component.
type Known = (Rc<System>, Rc<Plan>, Course, Rc<Stated>);

/// What a relation of a system comes from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Origin {
    /// The rule of this index.
    Rule(u32),
    /// What the host computes beside a rule.
    Number(Number),
    /// The wish of this index in the edit.
    Wish(u32),
}

/// A number that the host computes beside a rule.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Number {
    /// The rule.
    pub(crate) rule: u32,
    /// Its condition of this index, if that is what is computed; else it is a side of a comparison.
    pub(crate) when: Option<u32>,
}

/// What makes a task besides its component.
pub(crate) struct Setting<'s> {
    pub(crate) structure: &'s Structure,
    pub(crate) rules: &'s Rules,
    pub(crate) net: &'s Net,
    pub(crate) holding: &'s dyn Fn(SlotId) -> Holding,
    /// Wishes by their index in the edit.
    pub(crate) wishes: &'s [Wish],
    /// Which slots the edit gives a value, where the rules hold when it begins.
    pub(crate) is_edited: Option<&'s dyn Fn(SlotId) -> bool>,
}

/// States a component as a system and plans it, unless one was that is alike.
pub(crate) fn task(
    plans: &mut Plans,
    alike: Option<&mut Alike>,
    setting: &Setting<'_>,
    locals: &mut Locals,
    component: Component,
) -> Task {
    for (&slot, local) in component.slots().iter().zip(0..) {
        locals.0[slot] = local;
    }
    let Some(alike) = alike.filter(|_| setting.wishes.is_empty() && setting.is_edited.is_none())
    else {
        return Task::of(state(plans, setting, locals, &component), component);
    };
    alike.sign(setting, locals, &component);
    if let Some(known) = alike.known.get(alike.signature.as_slice()) {
        plans.reuse();
        return Task::of(known.clone(), component);
    }
    let known = state(plans, setting, locals, &component);
    alike.known.insert(alike.signature.as_slice().into(), known.clone());
    Task::of(known, component)
}

/// Plans a component at rest that opening planned as `opened`: what is alike there is alike at rest.
pub(crate) fn at_rest<'s>(
    plans: &mut Plans,
    alike: &mut Alike,
    setting: &Setting<'s>,
    locals: &mut Option<Locals>,
    (component, opened): (Component, Option<&Task>),
) -> Task {
    let opened = opened.filter(|task| task.component.is(&component)).map(|task| &task.stated);
    let known = opened.and_then(|stated| alike.known.get_index(*stated.at_rest.get()? as usize));
    if let Some((_, known)) = known {
        plans.reuse();
        return Task::of(known.clone(), component);
    }
    let locals = locals.get_or_insert_with(|| Locals::new(setting.structure));
    let task = task(plans, Some(alike), setting, locals, component);
    if let (Some(stated), Some(index)) =
        (opened, alike.known.get_index_of(alike.signature.as_slice()))
    {
        stated.at_rest.get_or_init(|| index as u32);
    }
    task
}

fn state(
    plans: &mut Plans,
    setting: &Setting<'_>,
    locals: &mut Locals,
    component: &Component,
) -> Known {
    let mut making = Making::new(setting, locals, component);
    for (position, &rule) in (0..).zip(component.rules()) {
        making.rule(position, rule);
    }
    for (index, wish) in (0..).zip(setting.wishes) {
        making.wish(plans.patterns_mut(), index, wish);
    }
    making.ranges();
    let Making { conditional, holds, targets, numbers, relations, .. } = making;
    let whole = whole::stated(&conditional).then(|| plans.whole(conditional.clone()));
    plans.patterns_mut().take_apart(&conditional.system);
    let (system, plan, course, number) = course(plans, conditional);
    let number = number.filter(|_| whole.is_none() && !has_host(&system));
    let stated = Stated { holds, targets, numbers, relations, number, whole, ..Stated::default() };
    (system, plan, course, Rc::new(stated))
}

/// Returns true if the host takes part: in texts, in relations or in methods.
fn has_host(system: &System) -> bool {
    let by_host = |m: &Method| match m.body {
        MethodBody::Opaque { .. } => true,
        MethodBody::Formulas { .. } => false,
    };
    let is_opaque = |r: &Relation| match r.body {
        RelationBody::Opaque { .. } => true,
        RelationBody::Equations(_) => r.methods.iter().any(by_host),
    };
    system.slots.iter().any(|s| !s.is_number) || system.relations.iter().any(is_opaque)
}

/// Plans a system, or what it is in its modes, or takes it for a matter of search. A plain plan has
/// a number.
fn course(
    plans: &mut Plans,
    conditional: Conditional,
) -> (Rc<System>, Rc<Plan>, Course, Option<u32>) {
    if conditional.is_plain() {
        let (system, plan, number) = plans.plan(conditional.system);
        (system, plan, Course::Plan, Some(number))
    } else if conditional.is_searched() {
        let (system, puzzle) = plans.puzzle(conditional);
        let slots = system.slots.clone();
        let (_, plan, _) = plans.plan(System { slots, ..System::default() });
        (system, plan, Course::Search(puzzle), None)
    } else {
        let modes = plans.modes(conditional);
        let mode = modes.blank();
        let (system, plan, _) = plans.in_mode(&modes, &mode);
        (system, plan, Course::Modes(modes, Box::new(mode)), None)
    }
}

/// Returns the first slots of a system at rest that can move: those that keep their own value, and
/// those that follow them.
fn movable(system: &System, plan: &Plan, slots: usize) -> Vec<SlotIndex> {
    let mut moves: Vec<bool> =
        system.slots.iter().map(|s| matches!(s.stay, Stay::Kept { .. })).collect();
    for step in plan.steps() {
        let rows: usize = step
            .relations
            .iter()
            .map(|&r| match &system.relations[r as usize].body {
                RelationBody::Equations(equations) => equations.len as usize,
                RelationBody::Opaque { .. } => step.targets.len(),
            })
            .sum();
        let follows = step.reads.iter().any(|&r| moves[r as usize]) || step.targets.len() > rows;
        for &t in &step.targets {
            moves[t as usize] = follows;
        }
    }
    (0..).zip(&moves[..slots]).filter(|(_, moves)| **moves).map(|(i, _)| i).collect()
}

impl Alike {
    /// Notes all that a component's system depends on, and that of the component at rest: what holds each
    /// slot, what it is and may be, with whom it is one place; what each rule says, and of which of the slots.
    fn sign(&mut self, setting: &Setting<'_>, locals: &Locals, component: &Component) {
        let Self { signature, kinds, .. } = self;
        signature.clear();
        signature.push(component.slots().len() as u32);
        for &slot in component.slots() {
            let range = setting.structure.ranges.get(&slot);
            let here = |&&s: &&SlotId| component.slots().get(locals.0[s] as usize) == Some(&s);
            let coordinates = setting.net.place_of(slot);
            let place = coordinates.iter().find(here);
            let primitive = setting.structure.slots[slot].primitive;
            let kind = kinds.iter().position(|&k| k == primitive).unwrap_or_else(|| {
                kinds.push(primitive);
                kinds.len() - 1
            }) as u32;
            let is_pair = u32::from(coordinates.len() == 2) << 2;
            let has = u32::from(range.is_some()) | u32::from(place.is_some()) << 1 | is_pair;
            let rests = Planner::resting_hold(setting.structure, slot).number();
            let holding = (setting.holding)(slot).number() | rests << 4;
            signature.push(holding | has << 8 | kind << 16);
            if let Some((least, most)) = range {
                signature.extend(halves(*least).into_iter().chain(halves(*most)));
            }
            signature.extend(place.map(|&s| locals.0[s]));
        }
        for &rule in component.rules() {
            signature.push(setting.rules.shape(rule).0);
            let slots = setting.rules.get(rule).slots;
            signature.extend(slots.iter().map(|&s| locals.0[s]));
        }
    }
}

/// Returns a whole number in two halves.
fn halves(x: i64) -> [u32; 2] {
    [x as u32, (x >> 32) as u32]
}

/// Where the slots of the document stand in the component at hand; what is left of another component
/// does no harm, since the component says which slot it has there.
#[derive(Debug)]
pub(crate) struct Locals(IdVec<SlotId, SlotIndex>);

impl Locals {
    pub(crate) fn new(structure: &Structure) -> Self {
        Self(IdVec::filled(0, structure.slots.len()))
    }
}

impl Task {
    fn of((system, plan, course, stated): Known, component: Component) -> Self {
        Self { system, plan, course, component, stated }
    }
    /// Returns true if all it speaks of only says where something is drawn.
    pub(crate) fn is_of_layout(&self, structure: &Structure) -> bool {
        self.component.slots().iter().all(|&s| structure.slots[s].is_layout)
    }
    /// Returns what a source of the system is.
    pub(crate) fn origin(&self, source: u32) -> Origin {
        match self.stated.relations[source as usize] {
            Origin::Rule(position) => Origin::Rule(self.component.rules()[position as usize]),
            Origin::Number(number) => Origin::Number(self.number_of(number)),
            Origin::Wish(wish) => Origin::Wish(wish),
        }
    }
    fn number_of(&self, Number { rule, when }: Number) -> Number {
        Number { rule: self.component.rules()[rule as usize], when }
    }
    /// Returns the slots of the system that hold what a slot of the document had when the edit began.
    pub(crate) fn holds(&self) -> impl Iterator<Item = (SlotIndex, SlotId)> {
        let slots = self.component.slots();
        self.stated.holds.iter().map(|&(known, local)| (known, slots[local as usize]))
    }
    /// Returns the slots of the system that hold what the host computes beside rules.
    pub(crate) fn computed(&self) -> impl ExactSizeIterator<Item = (SlotIndex, Number)> {
        self.stated.numbers.iter().map(|&(slot, number)| (slot, self.number_of(number)))
    }
    /// Returns the slots of the system that hold coordinates of wishes: wish and coordinate.
    pub(crate) fn targets(&self) -> &[(SlotIndex, u32, u32)] {
        &self.stated.targets
    }
    /// Returns what a relation of the system comes from.
    pub(crate) fn source(&self, rules: &Rules, relation: u32) -> Source {
        match self.origin(self.system.relations[relation as usize].source) {
            Origin::Rule(rule) | Origin::Number(Number { rule, .. }) => rules.source(rule),
            Origin::Wish(w) => Source::Wish(w),
        }
    }
    /// Returns how its whole numbers are looked for, where some are among real unknowns.
    pub(crate) fn whole(&self) -> Option<&Rc<Whole>> {
        self.stated.whole.as_ref()
    }
    /// Returns what it is with every equation with an `if` taken apart, where some have one, and wishes have to
    /// be met.
    pub(crate) fn pieces(&self, patterns: &Patterns) -> Option<&Whole> {
        let find = || {
            let stated = match (self.whole(), &self.course) {
                (Some(whole), _) => whole.modes.conditional().clone(),
                (None, Course::Search(_)) => return None,
                (None, Course::Modes(modes, _)) => modes.conditional().clone(),
                (None, Course::Plan) => {
                    Conditional { system: (*self.system).clone(), ..Conditional::default() }
                }
            };
            let mut apart = taken_apart(&stated, patterns)?;
            for relation in &mut apart.system.relations {
                match self.stated.relations[relation.source as usize] {
                    Origin::Wish(_) => relation.level = Level::Required,
                    Origin::Rule(_) | Origin::Number(_) => {}
                }
            }
            Modes::known(apart, patterns).map(|modes| Whole::new(Rc::new(modes)))
        };
        self.stated.pieces.get_or_init(find).as_ref()
    }
    /// Returns true if given numbers yield in it, and equations have pieces: on others the same may be nearer.
    pub(crate) fn may_yield_in_pieces(&self, patterns: &Patterns) -> bool {
        !self.plan.report.yielded.is_empty() && self.pieces(patterns).is_some()
    }
    /// Returns the number of its plan, where what that comes to depends on numbers alone.
    pub(crate) fn number(&self) -> Option<u32> {
        self.stated.number
    }
    /// Returns the slots that can move, of a task at rest: those that keep their own value, and those
    /// that follow them.
    pub(crate) fn movable(&self) -> impl Iterator<Item = SlotId> {
        let find = || movable(&self.system, &self.plan, self.component.slots().len());
        let found = match self.course {
            Course::Plan => Cow::Borrowed(self.stated.movable.get_or_init(find).as_slice()),
            // the mode at hand, which need not be the one that was stated
            Course::Modes(..) | Course::Search(_) => Cow::Owned(find()),
        };
        (0..found.len()).map(move |i| self.component.slots()[found[i] as usize])
    }
    /// Returns the rows that may depend on others at some state, of a task at rest: rule of the
    /// component and equation. `find` finds them.
    pub(crate) fn core(&self, find: impl FnOnce() -> Vec<(u32, u32)>) -> Cow<'_, [(u32, u32)]> {
        match self.course {
            Course::Plan => Cow::Borrowed(self.stated.core.get_or_init(find)),
            // the mode at hand, which need not be the one that was stated
            Course::Modes(..) | Course::Search(_) => Cow::Owned(find()),
        }
    }
    /// Returns the places that its rules speak of, two by two. `find` finds them.
    pub(crate) fn pairs(&self, find: impl FnOnce() -> Vec<Pair>) -> &[Pair] {
        self.stated.pairs.get_or_init(find)
    }
    /// Reads the numbers of the component's slots.
    pub(crate) fn numbers(&self, numbers: &IdVec<SlotId, f64>) -> impl Iterator<Item = f64> {
        self.component.slots().iter().map(|&s| numbers[s])
    }
    /// Reads the numbers of the document into the system's slots; targets are left at zero.
    pub(crate) fn gather(&self, numbers: &IdVec<SlotId, f64>) -> Vec<f64> {
        let mut local = Vec::new();
        self.gather_into(numbers, &mut local);
        local
    }
    /// Does the same into a vector that is there already.
    pub(crate) fn gather_into(&self, numbers: &IdVec<SlotId, f64>, local: &mut Vec<f64>) {
        local.clear();
        local.reserve(self.system.slots.len());
        local.extend(self.numbers(numbers));
        local.resize(self.system.slots.len(), 0.0);
        for (known, slot) in self.holds() {
            local[known as usize] = numbers[slot];
        }
    }
}
