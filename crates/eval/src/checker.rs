//! The independent checker: what must be true after an edit, tested from the rules alone.
//!
//! It shares no code with planner or solver: it evaluates rules as they are written and compares
//! states bit by bit. What it says is a list of sentences; an empty one is praise.

mod algebra;
mod answer;
mod blocks;
mod slopes;
mod ways;
mod wish;

use crate::evaluator::Evaluator;
use base::number::shortest;
use kernel::{
    ConstraintInstance, Document, Primitive, SlotId, Strength, Structure, ThingId, Value, Values,
};
use std::collections::BTreeSet;

/// An edit as the checker sees it.
#[derive(Clone, Copy, Debug)]
pub struct Edit<'a> {
    /// The state before.
    pub before: &'a Values,
    /// The state after.
    pub after: &'a Values,
    /// The slots that the edit itself was about.
    pub edited: &'a [SlotId],
    /// What the pointer wished of slots at last, where it was a drag or a move.
    pub wishes: &'a [(SlotId, f64)],
}

/// Tests a state for itself: rules hold, values are what their slots can hold.
///
/// Returns what is wrong, in words.
pub fn check_state(document: &Document, structure: &Structure, values: &Values) -> Vec<String> {
    let mut wrong = Vec::new();
    check_values(document, structure, values, &mut wrong);
    if wrong.is_empty() {
        check_rules(&Evaluator::new(document, structure, values), &mut wrong);
    }
    wrong
}

/// Tests an edit: the state after it, and what it must not have changed.
///
/// Returns what is wrong, in words.
pub fn check_edit(document: &Document, structure: &Structure, edit: Edit<'_>) -> Vec<String> {
    let mut wrong = check_state(document, structure, edit.after);
    if edit.before.numbers.len() != structure.slots.len() {
        wrong.push("the state before has another number of slots".into());
        return wrong;
    }
    let path = |slot: SlotId| structure.path(document, structure.slots[slot].thing);
    let connected = connected(document, structure, edit);
    for slot in edit.before.changed(edit.after) {
        let (before, after) = (shown(edit.before, slot), shown(edit.after, slot));
        // what no text gives is computed anew when an edit's text is opened, the same but for rounding
        let rounds = structure.slots[slot].given.is_none()
            && base::number::close(edit.before.numbers[slot], edit.after.numbers[slot]);
        if structure.slots[slot].anchored && !rounds && !edit.edited.contains(&slot) {
            wrong.push(format!("{} is anchored, and went from {before} to {after}", path(slot)));
        } else if !connected.contains(&slot) {
            let path = path(slot);
            wrong.push(format!("nothing connects {path} to the edit; {before} became {after}"));
        }
    }
    if wrong.is_empty() {
        wrong.extend(answer::complaints(document, structure, edit, &connected));
        wrong.extend(ways::complaints(document, structure, edit));
    }
    wrong
}

fn check_values(
    document: &Document,
    structure: &Structure,
    values: &Values,
    wrong: &mut Vec<String>,
) {
    if values.numbers.len() != structure.slots.len() {
        wrong.push("the state has another number of slots than the structure".into());
        return;
    }
    for (id, slot) in structure.slots.iter() {
        let path = || structure.path(document, slot.thing);
        let x = values.numbers[id];
        if !x.is_finite() {
            wrong.push(format!("{} is {x}", path()));
        } else if x == 0.0 && x.is_sign_negative() {
            wrong.push(format!("{} is a negative zero", path()));
        }
        match slot.primitive {
            Primitive::Real(_) => {}
            Primitive::Integer | Primitive::Choice(_) => {
                if x.fract() != 0.0 {
                    wrong.push(format!("{} is {}, no whole number", path(), shortest(x)));
                }
                if let Some((least, most)) = structure.ranges.get(&id).copied()
                    && !(least as f64..=most as f64).contains(&x)
                {
                    let (path, x) = (path(), shortest(x));
                    wrong.push(format!("{path} is {x}, not in {least}..{most}"));
                }
            }
            Primitive::Bool => {
                if x != 0.0 && x != 1.0 {
                    wrong.push(format!("{} is {}, neither true nor false", path(), shortest(x)));
                }
            }
            Primitive::Text | Primitive::Color => {
                if !values.texts.contains_key(&id) {
                    wrong.push(format!("{} holds no text", path()));
                }
            }
        }
    }
}

/// Tests every required constraint that is switched on.
fn check_rules(evaluator: &Evaluator<'_>, wrong: &mut Vec<String>) {
    let structure = evaluator.structure;
    let on = structure.constraints.iter().filter(|&&c| structure.is_on(c));
    let idle: BTreeSet<ThingId> = on.flat_map(|&c| evaluator.idle(c).unwrap_or_default()).collect();
    for &constraint in evaluator.structure.constraints.iter() {
        if !idle.is_empty() && is_inside(structure, constraint.owner, &idle) {
            continue;
        }
        let strength = structure.strength(evaluator.document, constraint);
        if strength != Strength::Required || !structure.is_on(constraint) {
            continue;
        }
        match evaluator.test(constraint) {
            Ok(verdict) if verdict.holds => {}
            Ok(verdict) => {
                let sides = match (verdict.left, verdict.right) {
                    (Some(left), Some(right)) => format!(": {left} and {right}"),
                    (Some(_) | None, _) => String::new(),
                };
                let error = verdict.error.map_or(String::new(), |e| format!(", off by {e:e}"));
                wrong.push(format!("{} does not hold{sides}{error}", name(evaluator, constraint)));
            }
            Err(fault) => {
                let name = name(evaluator, constraint);
                wrong.push(format!("{name} has no value: {}", fault.message));
            }
        }
    }
}

/// Returns true for one of these things and what they are made of.
fn is_inside(structure: &Structure, thing: ThingId, of: &BTreeSet<ThingId>) -> bool {
    let mut at = Some(thing);
    while let Some(thing) = at {
        if of.contains(&structure.merged[thing]) {
            return true;
        }
        at = structure.things[thing].owner;
    }
    false
}

/// Returns the path of a constraint: of its owner, and its name or number.
fn name(evaluator: &Evaluator<'_>, constraint: ConstraintInstance) -> String {
    let path = evaluator.structure.path(evaluator.document, constraint.owner);
    let class = &evaluator.document.classes[constraint.class];
    let own = match &class.constraints[constraint.index as usize].name {
        Some(name) => name.to_string(),
        None => format!("constraint {}", constraint.index),
    };
    if path.is_empty() { own } else { format!("{path}.{own}") }
}

/// Returns the slots that constraints connect to the edited ones.
///
/// A constraint that is switched on connects what its rule reads in either state and what its
/// methods write.
fn connected(document: &Document, structure: &Structure, edit: Edit<'_>) -> BTreeSet<SlotId> {
    let before = Evaluator::new(document, structure, edit.before);
    let after = before.in_state(edit.after);
    let mut groups: Vec<BTreeSet<SlotId>> = Vec::new();
    for &constraint in structure.constraints.iter() {
        let class = &document.classes[constraint.class];
        let written = &class.constraints[constraint.index as usize];
        if !structure.is_on(constraint) {
            continue;
        }
        let (_, mut slots) = before.listening(|| before.test(constraint));
        slots.extend(after.listening(|| after.test(constraint)).1);
        for method in &written.methods {
            for target in &method.targets {
                if let Ok(thing) = structure.follow(constraint.owner, target) {
                    slots.extend(structure.slots_under(thing));
                }
            }
        }
        groups.push(slots);
    }
    let mut of_slot = vec![Vec::new(); structure.slots.len()];
    for (i, group) in groups.iter().enumerate() {
        for slot in group {
            of_slot[slot.0 as usize].push(i);
        }
    }
    let mut reached: BTreeSet<SlotId> = BTreeSet::new();
    let mut opened = vec![false; groups.len()];
    let mut stack = edit.edited.to_vec();
    while let Some(slot) = stack.pop() {
        if !reached.insert(slot) {
            continue;
        }
        for &i in &of_slot[slot.0 as usize] {
            if !std::mem::replace(&mut opened[i], true) {
                stack.extend(&groups[i]);
            }
        }
    }
    reached
}

fn shown(values: &Values, slot: SlotId) -> String {
    match values.get(slot) {
        Value::Number(x) => shortest(x),
        Value::Text(text) => format!("\"{text}\""),
    }
}
