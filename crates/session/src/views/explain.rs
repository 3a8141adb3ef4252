//! Explanations: the plan in words, and why a value is what it is.

use crate::document::Open;
use crate::view::{ExplainedStep, Explanation};
use crate::words;
use kernel::{Path, SlotId};
use plan::{Acting, ExplainedKind, Root, RootKind, Source};

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
    let steps = steps.iter().map(|s| step(open, s)).collect();
    Explanation { about, summary, steps }
}

/// Says how a constraint acts in the mode that stands.
fn acting(open: &Open, acting: Acting) -> Option<String> {
    let name = words::source_name(&open.state, acting.source)?;
    Some(words::acting(&name, acting.kind))
}

fn why(open: &Open, path: &Path) -> Explanation {
    let state = &open.state;
    let about = path.to_string();
    let thing = match words::find(state, path) {
        Ok(thing) => thing,
        Err(refusal) => {
            return Explanation { about, summary: refusal.message, steps: Vec::new() };
        }
    };
    let mut steps: Vec<plan::ExplainedStep> = Vec::new();
    let mut roots: Vec<Root> = Vec::new();
    for slot in state.structure.slots_under(thing) {
        let why = open.planner.why(state.model(), slot);
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
    let value = words::show_thing(state, thing, &state.values).unwrap_or_default();
    let from: Vec<String> = roots.iter().map(|r| root(open, *r)).collect();
    let summary = match (roots.as_slice(), steps.is_empty()) {
        ([], true) => format!("{about} is {value}."),
        ([], false) => format!("{about} is {value}: its constraints alone decide it."),
        ([only], true) => format!("{about} is {value}: it {}.", held_by(only.kind)),
        (_, _) => format!("{about} is {value}, because {}.", enumerated(&from)),
    };
    let steps = steps.iter().map(|s| step(open, s)).collect();
    Explanation { about, summary, steps }
}

fn root(open: &Open, root: Root) -> String {
    let path = open.state.slot_path(root.slot);
    format!("{path} = {} {}", value(open, root.slot), held_by(root.kind))
}

fn held_by(kind: RootKind) -> &'static str {
    match kind {
        RootKind::Anchored => "is anchored",
        RootKind::Given => "is given in the text",
        RootKind::Kept => "stays as it was",
        RootKind::Edited => "is what the edit wanted",
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
    let (text, unit) = words::show_slot(&open.state, slot, open.values());
    if unit.is_empty() { text } else { format!("{text} {unit}") }
}

fn step(open: &Open, s: &plan::ExplainedStep) -> ExplainedStep {
    let state = &open.state;
    let formulas = s.sources.iter().filter_map(|&source| formula(open, source, s.kind));
    let names: Vec<String> =
        s.sources.iter().filter_map(|&source| words::source_name(state, source)).collect();
    let mut reads: Vec<String> = s
        .reads
        .iter()
        .take(12)
        .map(|&r| format!("{} = {}", state.slot_path(r), value(open, r)))
        .collect();
    let mut reason = match names.is_empty() {
        true => "the edit wants it".to_string(),
        false => format!("{} must hold", enumerated(&names)),
    };
    if !reads.is_empty() {
        let more = s.reads.len() - reads.len();
        if more > 0 {
            reads.push(format!("{more} more"));
        }
        reason.push_str(&format!(", given {}", enumerated(&reads)));
    }
    ExplainedStep {
        targets: s.targets.iter().map(|&t| state.slot_path(t).to_string()).collect(),
        method: method(s.kind),
        formula: formulas.collect::<Vec<_>>().join("\n"),
        reason,
        values: s.targets.iter().map(|&t| value(open, t)).collect(),
    }
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
        ExplainedKind::Newton { unknowns: 1 } => "an equation, solved by Newton's method".into(),
        ExplainedKind::Newton { unknowns } => {
            format!("{unknowns} equations, solved together by Newton's method")
        }
        ExplainedKind::LeastChange { unknowns: 1 } => "least change".into(),
        ExplainedKind::LeastChange { unknowns } => format!("least change of {unknowns} numbers"),
        ExplainedKind::Compromise { unknowns: 1 } => "compromise".into(),
        ExplainedKind::Compromise { unknowns } => format!("compromise of {unknowns} numbers"),
        ExplainedKind::Search { unknowns: 1 } => "search for a whole number".into(),
        ExplainedKind::Search { unknowns } => format!("search for {unknowns} whole numbers"),
    }
}
