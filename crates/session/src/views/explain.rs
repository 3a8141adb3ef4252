//! Explanations: the plan in words, and why a value is what it is.

use crate::document::Open;
use crate::state::State;
use crate::view::{ExplainedStep, Explanation, Refusal};
use crate::words;
use eval::FaultKind;
use indexmap::{IndexMap, IndexSet};
use kernel::{ConstraintInstance, Path, SlotId, Step, ThingId};
use plan::{Acting, ExplainedKind, Root, RootKind, Source};

/// So many things are named of what is approached.
const MOST_APPROACHED: usize = 6;

/// Explains the latest plan, or why the value at a path is what it is.
pub(crate) fn view(open: &Open, about: Option<&Path>) -> Explanation {
    match about {
        None => plan_in_words(open),
        Some(path) => why(open, path),
    }
}

fn plan_in_words(open: &Open) -> Explanation {
    let steps = open.planner.explain();
    let kind = match open.planner.latest_kind() {
        plan::PlanKind::OnePass => ", one after the other",
        plan::PlanKind::Block => "; in some, several equations are solved together",
        plan::PlanKind::Relaxation => "; in some, the least change is sought",
        plan::PlanKind::Search => "; in some, whole numbers are searched",
    };
    let about = match open.done.last() {
        Some(step) => step.label.clone(),
        None => "opening".into(),
    };
    let summary = match steps.len() {
        0 => format!("{about}: nothing else had to be computed."),
        1 => format!("{about}: one step."),
        n => format!("{about}: {n} steps{kind}."),
    };
    let acting: Vec<String> =
        open.planner.acting().into_iter().filter_map(|a| acting(open, a)).collect();
    let summary = match acting.as_slice() {
        [] => summary,
        _ => format!("{summary} Here {}.", enumerated(&acting)),
    };
    let approached = steps.iter().filter(|s| s.kind.is_approached());
    let warnings = approached.map(|s| approach(open, s)).collect();
    let steps = steps.iter().map(|s| step(open, s)).collect();
    Explanation { about, summary, steps, warnings }
}

/// Warns of a step that may not converge.
fn approach(open: &Open, step: &plan::ExplainedStep) -> String {
    let names = words::slots_listed(&open.state, &step.targets);
    let told: Vec<String> = names.iter().take(MOST_APPROACHED).cloned().collect();
    let told = match names.len() - told.len() {
        0 => words::listed(&told),
        more => format!("{} and {more} more", told.join(", ")),
    };
    let is = if names.len() == 1 { "is" } else { "are" };
    format!("{told} {is} approached step by step: from far away that may not converge")
}

/// Says how a constraint acts in the mode that stands.
fn acting(open: &Open, acting: Acting) -> Option<String> {
    let name = words::source_name(&open.state, acting.source)?;
    Some(words::acting(&open.state, &name, acting.kind))
}

/// What is asked about: how its sentence begins, and the numbers that make it so.
struct Subject {
    opening: String,
    slots: Vec<SlotId>,
}

fn why(open: &Open, path: &Path) -> Explanation {
    let state = &open.state;
    let about = path.to_string();
    let Subject { opening, slots } = match subject(open, path) {
        Ok(subject) => subject,
        Err(refusal) => {
            let summary = refusal.message;
            return Explanation { about, summary, ..Explanation::default() };
        }
    };
    let mut steps: Vec<plan::ExplainedStep> = Vec::new();
    let mut roots: Vec<Root> = Vec::new();
    let gave_way = state.yielded().collect();
    for &slot in &slots {
        let why = open.planner.why(state.model(), slot, &gave_way);
        for step in why.steps {
            if !steps.contains(&step) {
                steps.push(step);
            }
        }
        for root in why.roots {
            if !roots.contains(&root) {
                roots.push(root);
            }
        }
    }
    let summary = match (roots.as_slice(), steps.is_empty()) {
        ([], true) => format!("{opening}."),
        ([], false) => format!("{opening}: {}.", decided_by(&steps)),
        ([only], true) if slots == [only.slot] && state.slot_path(only.slot) == *path => {
            format!("{opening}: it {}.", held_by((only.kind, open.state.is_constant(only.slot)), 1))
        }
        (_, _) => format!("{opening}, because {}.", enumerated(&reasons(open, &roots))),
    };
    let warnings = steps.iter().filter(|s| s.kind.is_approached()).map(|s| approach(open, s));
    let warnings = warnings.collect();
    let sides = sides(state, &slots);
    let summary = if sides.is_empty() { summary } else { format!("{summary} {sides}") };
    let steps = steps.iter().map(|s| step(open, s)).collect();
    Explanation { about, summary, steps, warnings }
}

/// Says what decides a value that begins nowhere.
fn decided_by(steps: &[plan::ExplainedStep]) -> &'static str {
    let is = |kind: fn(ExplainedKind) -> bool| steps.iter().any(|s| kind(s.kind));
    if is(|k| matches!(k, ExplainedKind::Compromise { .. })) {
        "a compromise of what the constraints ask for"
    } else if is(|k| matches!(k, ExplainedKind::LeastChange { .. })) {
        "the least change with which the constraints hold"
    } else {
        "the constraints leave it no other value"
    }
}

/// Says on which side these slots go on, where their values do not.
fn sides(state: &State, slots: &[SlotId]) -> String {
    let told = slots.iter().filter_map(|slot| {
        let toward = *state.structure.sides.get(slot)?;
        let (path, way) = state.structure.side_of(&state.lowered.document, *slot, toward);
        let way = way.word();
        Some(format!("Two branches meet at {path}: it goes on {way}, as is written (side)."))
    });
    told.collect::<Vec<_>>().join(" ")
}

/// Finds what is at a path: a part, a virtual part or a constraint.
fn subject(open: &Open, path: &Path) -> Result<Subject, Refusal> {
    let state = &open.state;
    let astray = match words::find(state, path) {
        Ok(thing) => {
            let slots = state.structure.slots_under(thing);
            let opening = match words::show_thing(state, thing, open.values()) {
                Some(value) => format!("{path} is {value}"),
                None => format!("{path} is as it is"),
            };
            return Ok(Subject { opening, slots });
        }
        Err(astray) => astray,
    };
    let evaluator = state.evaluator(open.values());
    let (opening, slots) = match constraint_at(state, path) {
        Some(constraint) => {
            let (verdict, slots) = evaluator.listening(|| evaluator.test(constraint));
            (judged(state, path, constraint, verdict.ok()), slots)
        }
        None => {
            let (answer, slots) = evaluator.listening(|| evaluator.at(path));
            let opening = match answer {
                Ok(answer) => {
                    let value = super::answers::in_words(&state.lowered.document, &answer)
                        .unwrap_or_else(|| evaluator.text_of(&answer));
                    format!("{path} is {value}")
                }
                Err(fault) if fault.kind == FaultKind::NoAnswer => {
                    format!("{path} has no value, {}", fault.message)
                }
                Err(_) => return Err(astray),
            };
            (opening, slots)
        }
    };
    Ok(Subject { opening, slots: slots.into_iter().collect() })
}

/// Returns the constraint of this path, if there is one.
fn constraint_at(state: &State, path: &Path) -> Option<ConstraintInstance> {
    let Some((Step::Part(name), owner)) = path.0.split_last() else { return None };
    let owner = words::find(state, &Path(owner.to_vec())).ok()?;
    let its = |c: &&ConstraintInstance| {
        c.owner == owner && words::constraint_name(&state.lowered.document, **c) == **name
    };
    state.structure.constraints.iter().find(its).copied()
}

/// Says whether a constraint holds, and by how much it does not.
fn judged(
    state: &State,
    path: &Path,
    constraint: ConstraintInstance,
    verdict: Option<eval::Verdict>,
) -> String {
    let off = |error: f64| {
        let index = state.structure.constraints.iter().position(|c| *c == constraint);
        let source = Source::Constraint(index.unwrap_or_default() as u32);
        words::amount(state, source, error.abs())
    };
    match verdict {
        _ if !state.structure.is_on(constraint) => format!("{path} is switched off"),
        Some(verdict) if verdict.holds => format!("{path} holds"),
        Some(eval::Verdict { error: Some(error), .. }) => {
            format!("{path} does not hold: it is off by {}", off(error))
        }
        Some(_) => format!("{path} does not hold"),
        None => format!("{path} cannot be tested"),
    }
}

/// Says where values begin, those that are held alike together.
fn reasons(open: &Open, roots: &[Root]) -> Vec<String> {
    const MOST: usize = 6;
    let kind = |root: &Root| (root.kind, open.state.is_constant(root.slot));
    let mut kinds: Vec<(RootKind, bool)> = Vec::new();
    for root in roots {
        if !kinds.contains(&kind(root)) {
            kinds.push(kind(root));
        }
    }
    let of_kind = |of: (RootKind, bool)| {
        let its: Vec<&Root> = roots.iter().filter(|r| kind(r) == of).collect();
        let named =
            |r: &&Root| format!("{} = {}", open.state.slot_path(r.slot), value(open, r.slot));
        let mut names: Vec<String> = its.iter().take(MOST).map(named).collect();
        if its.len() > MOST {
            names.push(format!("{} more", its.len() - MOST));
        }
        format!("{} {}", enumerated(&names), held_by(of, its.len()))
    };
    kinds.into_iter().map(of_kind).collect()
}

fn held_by((kind, is_constant): (RootKind, bool), number: usize) -> &'static str {
    match (kind, number) {
        (RootKind::Anchored, 1) if is_constant => "is constant",
        (RootKind::Anchored, _) if is_constant => "are constant",
        (RootKind::Anchored, 1) => "is anchored",
        (RootKind::Anchored, _) => "are anchored",
        (RootKind::Given, 1) => "is given in the text",
        (RootKind::Given, _) => "are given in the text",
        (RootKind::Kept, 1) => "stays as it was",
        (RootKind::Kept, _) => "stay as they were",
        (RootKind::Edited, 1) => "is what the edit wanted",
        (RootKind::Edited, _) => "are what the edit wanted",
    }
}

/// Puts things in a row: `a`, `a and b`, `a, b and c`.
fn enumerated(items: &[String]) -> String {
    match items {
        [] => String::new(),
        [only] => only.clone(),
        [firsts @ .., last] => format!("{} and {last}", firsts.join(", ")),
    }
}

fn value(open: &Open, slot: SlotId) -> String {
    words::slot_in_words(&open.state, slot, open.values())
}

fn step(open: &Open, s: &plan::ExplainedStep) -> ExplainedStep {
    let state = &open.state;
    let formulas: IndexSet<String> =
        s.sources.iter().filter_map(|&source| formula(open, source, s.kind)).collect();
    let names = s.sources.iter().filter_map(|&source| {
        let name = words::source_name(state, source)?;
        Some(Told { class: of_class(state, source), name, value: None })
    });
    let names = first_ones(by_class(names).into_iter());
    let read = |&r: &SlotId| Told {
        class: part_of_class(state, r),
        name: state.slot_path(r).to_string(),
        value: Some(value(open, r)),
    };
    let reads = first_ones(by_class(s.reads.iter().map(read)).into_iter());
    let mut reason = match names.is_empty() {
        true => "the edit wants it".to_string(),
        false => format!("{} must hold", enumerated(&names)),
    };
    if !reads.is_empty() {
        reason.push_str(&format!(", given {}", enumerated(&reads)));
    }
    let beyond = s.beyond.iter().filter_map(|&source| words::source_name(state, source));
    match &first_ones(beyond)[..] {
        [] => {}
        [one] => reason.push_str(&format!("; {one} would go beyond")),
        more => reason.push_str(&format!("; {} would go beyond", enumerated(more))),
    }
    ExplainedStep {
        targets: s.targets.iter().map(|&t| state.slot_path(t).to_string()).collect(),
        method: method(s.kind),
        formula: formulas.into_iter().collect::<Vec<_>>().join("\n"),
        reason,
        values: s.targets.iter().map(|&t| value(open, t)).collect(),
    }
}

/// So many things are named one by one; more are told by what their classes call them.
const MOST_NAMED: usize = 12;

/// A constraint or a value that is told.
struct Told {
    /// What its class calls it.
    class: Option<String>,
    name: String,
    value: Option<String>,
}

/// Tells things; of many, those that classes call alike once: `Bar.stiffness = 200 MN (3999 times)`.
fn by_class(all: impl Iterator<Item = Told>) -> Vec<String> {
    let valued = |name: &str, value: &Option<String>| match value {
        Some(value) => format!("{name} = {value}"),
        None => name.to_string(),
    };
    let all: Vec<Told> = all.collect();
    if all.len() <= MOST_NAMED {
        return all.iter().map(|t| valued(&t.name, &t.value)).collect();
    }
    let mut groups: IndexMap<String, Vec<Told>> = IndexMap::new();
    for told in all {
        let key = told.class.clone().unwrap_or_else(|| told.name.clone());
        groups.entry(key).or_default().push(told);
    }
    let told = |(class, group): (String, Vec<Told>)| {
        let first = &group[0];
        let alike = group.iter().all(|t| t.value == first.value);
        match group.len() {
            1 => valued(&first.name, &first.value),
            n if alike => format!("{} ({n} times)", valued(&class, &first.value)),
            n => format!("{class} ({n} times)"),
        }
    };
    groups.into_iter().map(told).collect()
}

/// Returns what its class calls a constraint: `Bar.hooke`.
fn of_class(state: &State, source: Source) -> Option<String> {
    let Source::Constraint(index) = source else { return None };
    let document = &state.lowered.document;
    let instance = state.structure.constraints[index as usize];
    let of = named_class(state, instance.owner)?;
    Some(format!("{of}.{}", words::constraint_name(document, instance)))
}

/// Returns what the class of the thing around it calls a value: `Bar.stiffness`, `Joint.at.x`.
fn part_of_class(state: &State, slot: SlotId) -> Option<String> {
    let (structure, document) = (&state.structure, &state.lowered.document);
    let mut thing = structure.slots[slot].thing;
    let mut names: Vec<&str> = Vec::new();
    loop {
        names.push(structure.field_name(document, thing)?);
        thing = structure.owner(thing)?;
        if !document.is_place(structure.things[thing].class) {
            break;
        }
    }
    names.push(named_class(state, thing)?);
    names.reverse();
    Some(names.join("."))
}

/// Returns the name of the class that the text has for a thing.
fn named_class(state: &State, thing: ThingId) -> Option<&str> {
    let document = &state.lowered.document;
    let name = &document.classes[document.named_class(state.structure.things[thing].class)].name;
    (!name.is_empty()).then_some(name)
}

/// Returns the first dozen, and how many more there are.
fn first_ones(mut items: impl Iterator<Item = String>) -> Vec<String> {
    let mut first: Vec<String> = items.by_ref().take(MOST_NAMED).collect();
    match items.count() {
        0 => {}
        more => first.push(format!("{more} more")),
    }
    first
}

/// Returns what was written for a constraint: the method that ran, else the rule.
fn formula(open: &Open, source: Source, kind: ExplainedKind) -> Option<String> {
    let Source::Constraint(index) = source else { return None };
    let state = &open.state;
    let instance = state.structure.constraints[index as usize];
    let constraint =
        &state.lowered.document.classes[instance.class].constraints[instance.index as usize];
    if let ExplainedKind::Method { index, .. } = kind
        && let Some(method) = constraint.methods.get(index as usize)
    {
        return Some(state.lowered.source_of(method.origin));
    }
    Some(words::rule_of(state, index))
}

fn method(kind: ExplainedKind) -> String {
    match kind {
        ExplainedKind::Alias => "equal to another part".into(),
        ExplainedKind::Number => "equal to a number".into(),
        ExplainedKind::Method { of: 1, .. } => "its one method".into(),
        ExplainedKind::Method { index, of } => format!("method {} of {of}", index + 1),
        ExplainedKind::Isolated { roots: 1 } => "its rule, solved for it".into(),
        ExplainedKind::Isolated { roots } => {
            format!("its rule, solved for it: the nearest of {roots} solutions")
        }
        ExplainedKind::Linear { unknowns: 1 } => "a linear equation".into(),
        ExplainedKind::Linear { unknowns } => {
            format!("{unknowns} linear equations, solved together")
        }
        ExplainedKind::Closed => "2 equations, solved together by formula".into(),
        ExplainedKind::Newton { unknowns: 1 } => "an equation, solved by Newton's method".into(),
        ExplainedKind::Newton { unknowns } => {
            format!("{unknowns} equations, solved together by Newton's method")
        }
        ExplainedKind::LeastChange { unknowns: 1, .. } => "least change".into(),
        ExplainedKind::LeastChange { unknowns, .. } => {
            format!("least change of {unknowns} numbers")
        }
        ExplainedKind::Compromise { unknowns: 1, .. } => "compromise".into(),
        ExplainedKind::Compromise { unknowns, .. } => format!("compromise of {unknowns} numbers"),
        ExplainedKind::Search { unknowns: 1 } => "search for a whole number".into(),
        ExplainedKind::Search { unknowns } => format!("search for {unknowns} whole numbers"),
    }
}
