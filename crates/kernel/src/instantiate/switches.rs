//! Switches: which constraints of which things are off, or hold under a condition, and how strongly.
//!
//! The class of a thing has the last word on the constraints below it: what is said of a whole counts
//! more than what is said of its part.

use crate::class::{Setting, Switch};
use crate::document::Document;
use crate::structure::{Condition, ConstraintInstance, Form, ThingId};
use crate::term::Term;
use std::collections::BTreeMap;

/// Finds what is set of constraints. A switch of nothing, as where a class masks it, does nothing.
pub(super) fn switch(document: &Document, structure: &mut Form) {
    if document.classes.iter().all(|(_, c)| c.switches.is_empty()) {
        return;
    }
    let mut constraints: BTreeMap<ThingId, Vec<ConstraintInstance>> = BTreeMap::new();
    for &instance in structure.constraints.iter() {
        constraints.entry(structure.merged[instance.owner]).or_default().push(instance);
    }
    for thing in structure.things.ids().collect::<Vec<_>>().into_iter().rev() {
        let line = document.primary_line(structure.things[thing].class);
        let switches = line.iter().rev().flat_map(|&class| {
            (0..).zip(&document.classes[class].switches).map(move |(i, s)| (class, i, s))
        });
        for (class, index, switch) in switches {
            let at = structure.follow(thing, &switch.path).ok();
            let named = at.map(|at| named(document, structure, &constraints, at, switch));
            for instance in named.unwrap_or_default() {
                let condition = Condition { me: thing, class, switch: index };
                set(structure, instance, &switch.setting, condition);
            }
        }
    }
}

fn set(
    structure: &mut Form,
    instance: ConstraintInstance,
    setting: &Setting,
    condition: Condition,
) {
    match setting {
        Setting::Strength(strength) => {
            structure.strengths.insert(instance, *strength);
        }
        Setting::Enabled(term) => {
            structure.off.remove(&instance);
            structure.conditions.remove(&instance);
            match term {
                Term::Bool(true) => {}
                Term::Bool(false) => {
                    structure.off.insert(instance);
                }
                _ => {
                    structure.conditions.insert(instance, condition);
                }
            }
        }
    }
}

/// Returns the constraints of a thing that a switch names; where it has none, those of what it is by
/// its other superclasses.
fn named(
    document: &Document,
    structure: &Form,
    constraints: &BTreeMap<ThingId, Vec<ConstraintInstance>>,
    thing: ThingId,
    switch: &Switch,
) -> Vec<ConstraintInstance> {
    let is_named = |i: &&ConstraintInstance| {
        let constraint = &document.classes[i.class].constraints[i.index as usize];
        constraint.name.as_ref() == Some(&switch.name)
    };
    let own = constraints.get(&structure.merged[thing]).into_iter().flatten();
    let own: Vec<ConstraintInstance> = own.filter(is_named).copied().collect();
    if !own.is_empty() {
        return own;
    }
    let others = structure.superclass_parts(thing).into_iter();
    others.flat_map(|part| named(document, structure, constraints, part, switch)).collect()
}
