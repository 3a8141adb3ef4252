//! Explanations: the plan in words, and why a value is what it is.

use crate::document::Open;
use crate::view::{ExplainedStep, Explanation};
use crate::words;
use kernel::{Path, SlotId};
use plan::{ExplainedKind, Root, RootKind, Source};

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
        plan::PlanKind::OnePass => "one pass",
        plan::PlanKind::Block => "blocks of equations solved together",
        plan::PlanKind::Relaxation => "an approach to the least change",
    };
    let about = match open.done.last() {
        Some(step) => step.label.clone(),
        None => "opening".into(),
    };
    let n = steps.len();
    let plural = if n == 1 { "step" } else { "steps" };
    let summary = format!("The plan of {about} has {n} {plural}: {kind}.");
    let steps = steps.iter().map(|s| step(open, s)).collect();
    Explanation { about, summary, steps }
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
    let summary = match (steps.is_empty(), from.is_empty()) {
        (true, false) => format!("{about} is {value}: {}.", from.join("; ")),
        (false, false) => format!("{about} is {value}. It comes from {}.", from.join("; ")),
        (_, true) => format!("{about} is {value}."),
    };
    let steps = steps.iter().map(|s| step(open, s)).collect();
    Explanation { about, summary, steps }
}

fn root(open: &Open, root: Root) -> String {
    let path = open.state.slot_path(root.slot);
    let how = match root.kind {
        RootKind::Anchored => "anchored",
        RootKind::Given => "given in the text",
        RootKind::Kept => "as it was",
        RootKind::Edited => "as the edit wanted it",
    };
    format!("{path} = {}, {how}", value(open, root.slot))
}

fn value(open: &Open, slot: SlotId) -> String {
    let (text, unit) = words::show_slot(&open.state, slot, open.values());
    if unit.is_empty() { text } else { format!("{text} {unit}") }
}

fn step(open: &Open, s: &plan::ExplainedStep) -> ExplainedStep {
    let state = &open.state;
    let rules = s.sources.iter().filter_map(|&source| rule(open, source));
    let names: Vec<String> =
        s.sources.iter().filter_map(|&source| words::source_name(state, source)).collect();
    let reads: Vec<String> = s
        .reads
        .iter()
        .take(12)
        .map(|&r| format!("{} = {}", state.slot_path(r), value(open, r)))
        .collect();
    let mut reason = match names.is_empty() {
        true => "the edit wants it".to_string(),
        false => format!("{} shall hold", names.join(", ")),
    };
    if !reads.is_empty() {
        reason.push_str(&format!(", with {}", reads.join(", ")));
        if s.reads.len() > reads.len() {
            reason.push_str(&format!(" and {} more", s.reads.len() - reads.len()));
        }
    }
    ExplainedStep {
        targets: s.targets.iter().map(|&t| state.slot_path(t).to_string()).collect(),
        method: method(s.kind),
        formula: rules.collect::<Vec<_>>().join("\n"),
        reason,
        values: s.targets.iter().map(|&t| value(open, t)).collect(),
    }
}

/// Returns what was written for a constraint.
fn rule(open: &Open, source: Source) -> Option<String> {
    let Source::Constraint(index) = source else { return None };
    let state = &open.state;
    let instance = state.structure.constraints[index as usize];
    let class = &state.lowered.document.classes[instance.class];
    Some(state.lowered.source_of(class.constraints[instance.index as usize].origin))
}

fn method(kind: ExplainedKind) -> String {
    match kind {
        ExplainedKind::Alias => "takes the value of its equal".into(),
        ExplainedKind::Method { index, of } => format!("written method {} of {of}", index + 1),
        ExplainedKind::Isolated { roots: 1 } => "isolated".into(),
        ExplainedKind::Isolated { roots } => format!("isolated, the nearest of {roots} solutions"),
        ExplainedKind::Linear { unknowns } => format!("linear block of {unknowns}"),
        ExplainedKind::Newton { unknowns } => format!("Newton block of {unknowns}"),
        ExplainedKind::LeastChange { unknowns } => format!("least change of {unknowns}"),
        ExplainedKind::Compromise { unknowns } => format!("compromise of {unknowns}"),
    }
}
