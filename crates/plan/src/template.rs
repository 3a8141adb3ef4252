//! Templates: a constraint of a class is opened once for all things that are built alike.
//!
//! The first time a constraint is opened in a thing, the way to every slot is noted beside the rules
//! that came of it. For another instance the way is followed; where that leads to things of the same
//! classes, in lists and sets of the same length, the rules are the same over other slots. So templates
//! belong to the classes: they can be made, and all that they say compiled, when the things are, and
//! what is left to a planner is which slots they are of.

use crate::component::Groups;
use crate::course::Guard;
use crate::evaluate::Opening;
use crate::fault::Fault;
use crate::lower::{Lowered, guard, held, hold, lower_constraint};
use crate::planner::Model;
use crate::reach::{Route, Routes, Trail};
use crate::rule::{Formula, Position, Rules, Shape, ShapeId, Source, When};
use base::IdVec;
use kernel::{
    ClassId, ConstraintInstance, Document, OriginId, SlotId, Strength, Structure, Values,
};
use solve::{Level, Patterns, Span};
use std::collections::BTreeSet;
use std::rc::Rc;

/// How many ways of being built one constraint is remembered for.
const REMEMBERED: u32 = 16;

/// Up to this many arguments an equation is compiled where some of them are equal.
const MERGED: usize = 16;

/// No template.
const NONE: u32 = u32::MAX;

/// What the constraints of a document's classes say, of things that are built in so many ways.
#[derive(Debug, Default)]
pub struct Templates {
    /// What their rules say.
    pub(crate) patterns: Patterns,
    pub(crate) known: Known,
}

/// The constraints that were opened.
#[derive(Debug, Default)]
pub(crate) struct Known {
    shapes: IdVec<ShapeId, Shape>,
    /// For every class, where its constraints begin in `latest`.
    first: IdVec<ClassId, u32>,
    /// For every constraint, the template that served last, and how many there are.
    latest: Vec<(u32, u32)>,
    list: Vec<Template>,
    routes: Routes,
    rules: Vec<(ShapeId, Span)>,
    positions: Vec<Position>,
}

/// A constraint as it was opened in one thing.
#[derive(Debug)]
struct Template {
    route: Route,
    /// Its rules: what they say, of which of the slots that the route leads to.
    rules: Span,
    /// The one of the same constraint that served before it.
    before: u32,
}

impl Templates {
    /// Opens the constraints of all classes in the things that have them, and compiles what they say.
    ///
    /// Planners of documents with these classes are quicker made with them. Cost: linear in the things
    /// that are constrained; every kind of rule is compiled once, and once more where others make what it
    /// speaks of equal in another way.
    pub fn of(model: Model<'_>) -> Self {
        let Self { mut patterns, mut known } = Self::default();
        let (rules, _) = lower_all((model, None), &mut patterns, &mut known);
        for Formula { pattern, .. } in rules.shapes().flat_map(Shape::equations) {
            patterns.get(*pattern).compile();
        }
        compile_merged(model.structure, &rules, &patterns);
        known.shapes = rules.into_shapes();
        Self { patterns, known }
    }
}

/// Compiles what rules say where others make some of what they speak of equal, as the ends of a level line.
fn compile_merged(structure: &Structure, rules: &Rules, patterns: &Patterns) {
    let mut groups = Groups::new(structure.slots.len());
    for rule in rules.iter().filter(|r| r.shape.level == Level::Required) {
        let is_equality = |e: &&Formula| patterns.get(e.pattern).is_equality();
        for equation in rule.shape.equations().filter(is_equality) {
            groups.unite_all(rule.slots_at(&equation.slots));
        }
    }
    let (mut slots, mut first) = (Vec::new(), Vec::new());
    for rule in rules.iter() {
        for equation in rule.shape.equations().filter(|e| e.slots.len() <= MERGED) {
            slots.clear();
            slots.extend(rule.slots_at(&equation.slots).map(|s| groups.first(s)));
            let place = |slot: &SlotId| slots.iter().position(|s| s == slot).unwrap_or(0) as u32;
            first.clear();
            first.extend(slots.iter().map(place));
            if !first.iter().copied().eq(0..slots.len() as u32) {
                patterns.get(equation.pattern).compile_where(&first);
            }
        }
    }
}

impl Known {
    fn of(document: &Document) -> Self {
        let mut count = 0;
        let begin = |class: &kernel::Class| {
            let first = count;
            count += class.constraints.len() as u32;
            first
        };
        let first = document.classes.iter().map(|(_, class)| class).map(begin).collect();
        Self { first, latest: vec![(NONE, 0); count as usize], ..Self::default() }
    }
    /// Returns where the templates of a constraint begin.
    fn place(&self, instance: ConstraintInstance) -> usize {
        (self.first[instance.class] + instance.index) as usize
    }
    fn has_room(&self, instance: ConstraintInstance) -> bool {
        self.latest[self.place(instance)].1 < REMEMBERED
    }
    /// Adds the rules that a template says of an instance, if there is one that was built alike.
    fn follow(
        &mut self,
        structure: &Structure,
        instance: ConstraintInstance,
        source: Source,
        trail: &mut Trail,
        rules: &mut Rules,
    ) -> bool {
        let place = self.place(instance);
        let (latest, _) = self.latest[place];
        let (mut at, mut last) = (latest, NONE);
        while let Some(template) = self.list.get(at as usize) {
            let before = template.before;
            if self.routes.follow(&template.route, structure, instance.owner, trail) {
                for &(shape, positions) in &self.rules[template.rules.range()] {
                    let positions = &self.positions[positions.range()];
                    rules.add(source, shape, positions.iter().map(|&p| trail.slots[p as usize]));
                }
                // neighbours are built alike, as a rule: it is asked first from now on
                if let Some(last) = self.list.get_mut(last as usize) {
                    last.before = before;
                    self.list[at as usize].before = latest;
                    self.latest[place].0 = at;
                }
                return true;
            }
            (last, at) = (at, before);
        }
        false
    }
    /// Notes the rules that came of a constraint; nothing where one of their slots is not on the route.
    fn add(
        &mut self,
        instance: ConstraintInstance,
        (route, slots): (Route, &[SlotId]),
        made: &[(ShapeId, Vec<SlotId>)],
    ) {
        let (first, start) = (self.rules.len(), self.positions.len());
        let mut place: Vec<(SlotId, Position)> = slots.iter().copied().zip(0..).collect();
        place.sort_unstable();
        for (shape, slots) in made {
            let start = self.positions.len() as u32;
            for slot in slots {
                let Ok(at) = place.binary_search_by_key(slot, |p| p.0) else { break };
                self.positions.push(place[at].1);
            }
            let len = self.positions.len() as u32 - start;
            self.rules.push((*shape, Span { start, len }));
            if len as usize != slots.len() {
                break;
            }
        }
        let added = self.rules[first..].iter().map(|r| r.1.len as usize);
        if !added.eq(made.iter().map(|m| m.1.len())) {
            self.rules.truncate(first);
            self.positions.truncate(start);
            return;
        }
        let next = self.list.len() as u32;
        let place = self.place(instance);
        let (latest, count) = &mut self.latest[place];
        let before = std::mem::replace(latest, next);
        *count += 1;
        let rules = Span { start: first as u32, len: made.len() as u32 };
        self.list.push(Template { route, rules, before });
    }
}

/// What was noted while rules were lowered.
#[derive(Clone, Debug, Default)]
pub(crate) struct LoweringReport {
    /// What cannot be planned, whatever the values are.
    pub(crate) faults: Vec<Fault>,
    /// What besides cannot be planned on the course that is taken.
    pub(crate) course_faults: Vec<Fault>,
    /// The constraints of the structure that all of these left out.
    pub(crate) left_out: BTreeSet<u32>,
    /// The rules that are left out until there is a state that says how many they speak of.
    pub(crate) awaiting: Vec<OriginId>,
    /// The courses that are taken in what the rules say, and in what cannot be planned on them.
    pub(crate) guards: Vec<Guard>,
    /// Whether some speak of what a program draws, or of as many as a value says.
    pub(crate) has_courses: bool,
    /// Where these are opened.
    pub(crate) on: On,
    /// How it is decided at a state at which no course was found to hold, where there was one.
    pub(crate) unsettled: Option<Rc<[Guard]>>,
}

/// Where rules are opened that may take several courses.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) enum On {
    /// On none, for want of a state.
    #[default]
    Nothing,
    /// On the course that is taken at some state.
    Course,
    /// On none, as at some state none holds.
    Unsettled,
}

/// Lowers every constraint that is not switched off and every declared stay. What cannot be planned is left
/// out and reported.
///
/// What is known of the classes is not opened again; what is not is added.
pub(crate) fn lower_all(
    (model, on): (Model<'_>, Option<&Values>),
    patterns: &mut Patterns,
    known: &mut Known,
) -> (Rules, LoweringReport) {
    let structure = model.structure;
    let shapes = std::mem::take(&mut known.shapes);
    let mut rules = Rules::over(shapes, structure.constraints.len());
    let (mut faults, mut awaiting, mut left_out) = (Vec::new(), Vec::new(), BTreeSet::new());
    let mut guarded = Vec::new();
    let mut opening = Opening::new(model.document, structure);
    opening.at = on;
    let mut guards = Vec::new();
    if known.first.len() != model.document.classes.len() {
        *known = Known::of(model.document);
    }
    let mut trail = Trail::new(structure);
    for (index, &instance) in (0..).zip(structure.constraints.iter()) {
        if !structure.is_on(instance) {
            continue;
        }
        let source = Source::Constraint(index);
        // what is set of one constraint alone says nothing of others
        let is_set = structure.conditions.contains_key(&instance)
            || structure.strengths.contains_key(&instance);
        if !is_set && known.follow(structure, instance, source, &mut trail, &mut rules) {
            continue;
        }
        let (lowered, is_guard) = match lower_counted(&mut opening, patterns, instance) {
            // how many it speaks of is known once the document has values
            _ if opening.awaits_count => {
                let class = &model.document.classes[instance.class];
                awaiting.push(class.constraints[instance.index as usize].origin);
                continue;
            }
            Ok(lowered) => {
                let is_guard = !lowered.things.is_empty();
                let said_here = |when: Vec<When<SlotId>>| {
                    when.into_iter().map(|when| when.said_by(index)).collect()
                };
                let things = lowered.things.into_iter();
                guarded.extend(things.map(|(thing, when)| (thing, said_here(when))));
                guards.extend(opening.guards(patterns));
                (lowered.shapes, is_guard)
            }
            Err(fault) => {
                faults.push(fault);
                left_out.insert(index);
                // decided otherwise, it may be planned
                guards.extend(opening.guards(patterns));
                continue;
            }
        };
        let mut made = Vec::with_capacity(lowered.len());
        for shape in lowered {
            let (shape, slots) = shape.numbered();
            let shape = rules.add_shape(shape);
            rules.add(source, shape, slots.iter().copied());
            made.push((shape, slots));
        }
        // what guards the rules of things is opened for each, and of the document there is one
        let is_alone = is_guard || is_set || instance.class == model.document.root;
        if !is_alone && known.has_room(instance) {
            let mut slots = Vec::new();
            if let Some(route) = opening.reach.route(&mut known.routes, &mut slots) {
                known.add(instance, (route, &slots), &made);
            }
        }
    }
    guard(structure, &mut rules, &guarded);
    lower_stays(model, &mut rules);
    let report = LoweringReport {
        faults,
        course_faults: Vec::new(),
        left_out,
        awaiting,
        guards,
        has_courses: opening.has_courses,
        on: on.map_or(On::Nothing, |_| On::Course),
        unsettled: None,
    };
    (rules, report)
}

/// Lowers a constraint; once more where it spoke of a number before that counted something: what counts is as it
/// stands, on either side of a rule.
fn lower_counted(
    opening: &mut Opening<'_>,
    patterns: &mut Patterns,
    instance: ConstraintInstance,
) -> Result<Lowered, Fault> {
    let lowered = lower_constraint(opening, patterns, instance)?;
    let is_counted = |slot: &SlotId| opening.counted.contains_key(slot);
    let speaks_of_counted = |shape: &Shape<SlotId>| shape.numbered().1.iter().any(is_counted);
    if opening.counted.is_empty() || !lowered.shapes.iter().any(speaks_of_counted) {
        return Ok(lowered);
    }
    opening.known_counts = opening.counted.clone();
    lower_constraint(opening, patterns, instance)
}

fn lower_stays(model: Model<'_>, rules: &mut Rules) {
    let mut shapes: Vec<((Strength, u32), ShapeId)> = Vec::new();
    for (index, &stay) in (0..).zip(&model.structure.stays) {
        let Some(strength) = stay.strength else { continue };
        let slots = held(model.structure, stay);
        let kind = (strength, slots.len() as u32);
        let shape = match shapes.iter().find(|known| known.0 == kind) {
            Some(&(_, shape)) => shape,
            None => {
                let shape = rules.add_shape(hold(kind.0, kind.1));
                shapes.push((kind, shape));
                shape
            }
        };
        rules.add(Source::Stay(index), shape, slots);
    }
}
