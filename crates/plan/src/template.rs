//! Templates: a constraint of a class is opened once for all things that are built alike.
//!
//! The first time a constraint is opened in a thing, the way to every slot is noted beside the rules
//! that came of it. For another instance the way is followed; where that leads to things of the same
//! classes, in lists and sets of the same length, the rules are the same over other slots.

use crate::evaluate::Opening;
use crate::fault::Fault;
use crate::lower::{guard, held, hold, lower_constraint};
use crate::planner::Model;
use crate::reach::Route;
use crate::rule::{Position, Rules, ShapeId, Source};
use base::IdVec;
use kernel::{ClassId, SlotId, Strength};
use solve::Patterns;
use std::collections::BTreeMap;

/// How many ways of being built one constraint is remembered for.
const REMEMBERED: usize = 16;

/// A constraint as it was opened in one thing.
struct Template {
    route: Route,
    /// Its rules: what they say, of which of the slots that the route leads to.
    rules: Vec<(ShapeId, Vec<Position>)>,
}

/// Lowers every constraint that is not switched off and every declared stay. What cannot be planned is left out and reported.
pub(crate) fn lower_all(model: Model<'_>, patterns: &mut Patterns) -> (Rules, Vec<Fault>) {
    let structure = model.structure;
    let mut rules = Rules::default();
    let mut faults = Vec::new();
    let mut guarded = Vec::new();
    let mut opening = Opening::new(model.document, structure);
    // by class, and by the constraint's index there
    let mut templates: IdVec<ClassId, Vec<Vec<Template>>> =
        model.document.classes.ids().map(|_| Vec::new()).collect();
    let (mut things, mut slots) = (Vec::new(), Vec::new());
    for (index, &instance) in (0..).zip(structure.constraints.iter()) {
        if !structure.is_on(instance) {
            continue;
        }
        let source = Source::Constraint(index);
        // what is set of one constraint alone says nothing of others
        let is_set = structure.conditions.contains_key(&instance)
            || structure.strengths.contains_key(&instance);
        let (class, at) = (&mut templates[instance.class], instance.index as usize);
        if class.len() <= at {
            class.resize_with(at + 1, Vec::new);
        }
        let known = &mut class[at];
        let alike = known
            .iter()
            .filter(|_| !is_set)
            .find(|t| t.route.follow(structure, instance.owner, &mut things, &mut slots));
        if let Some(template) = alike {
            for (shape, positions) in &template.rules {
                rules.add(source, *shape, positions.iter().map(|&p| slots[p as usize]));
            }
            continue;
        }
        let (shapes, guards) = match lower_constraint(&mut opening, patterns, instance) {
            Ok(lowered) => {
                let guards = !lowered.things.is_empty();
                guarded.extend(lowered.things);
                (lowered.shapes, guards)
            }
            Err(fault) => {
                faults.push(fault);
                continue;
            }
        };
        // what guards the rules of things is opened for each
        let route =
            opening.reach.route().filter(|_| known.len() < REMEMBERED && !guards && !is_set);
        let place: BTreeMap<SlotId, Position> =
            route.iter().flat_map(|(_, slots)| slots.iter().copied().zip(0..)).collect();
        let mut made = Some(Vec::new());
        for shape in shapes {
            let (shape, slots) = shape.numbered();
            let shape = rules.add_shape(shape);
            let positions: Option<Vec<Position>> =
                slots.iter().map(|s| place.get(s).copied()).collect();
            made = made.zip(positions).map(|(mut made, positions)| {
                made.push((shape, positions));
                made
            });
            rules.add(source, shape, slots);
        }
        if let (Some((route, _)), Some(rules)) = (route, made) {
            known.push(Template { route, rules });
        }
    }
    guard(structure, &mut rules, &guarded);
    lower_stays(model, &mut rules);
    (rules, faults)
}

fn lower_stays(model: Model<'_>, rules: &mut Rules) {
    let mut shapes: BTreeMap<(Strength, u32), ShapeId> = BTreeMap::new();
    for (index, &stay) in (0..).zip(&model.structure.stays) {
        let Some(strength) = stay.strength else { continue };
        let slots = held(model.structure, stay);
        let count = slots.len() as u32;
        let shape = *shapes
            .entry((strength, count))
            .or_insert_with(|| rules.add_shape(hold(strength, count)));
        rules.add(Source::Stay(index), shape, slots);
    }
}
