//! Problems: what was found while solving, said at the lines of the text that it comes from.
//!
//! In: an open document. Out: diagnostics as an editor shows them: of every contradiction the whole set,
//! each constraint at its line; of what has no value why; what nothing holds though it is loaded.

use super::analysis::{contradiction, place_without_value};
use crate::document::Open;
use crate::state::State;
use crate::texts::Texts;
use crate::view::DiagnosticView;
use crate::{rules, words};
use base::{Diagnostic, FileId, Name, Place};
use eval::Fault;
use expr::Dimension;
use kernel::{ClassId, Message, OriginId, Primitive, SlotId, Step, Term, ThingId, Values};
use plan::{Certainty, Contradiction, Source};
use solve::Level;
use std::collections::{BTreeMap, BTreeSet};

/// Behind so many messages without a value no more are looked for: each may take as long as an answer may take.
const MOST_FAULTS: usize = 20;
/// Looking for them ends once so many terms were evaluated.
const MOST_STEPS: u64 = 10_000_000;

/// Returns what was found, in the order of the text.
pub(crate) fn view(open: &mut Open) -> Vec<DiagnosticView> {
    let state = open.state.clone();
    let mut texts = Texts::new(&state.lowered.document, &state.structure);
    let unmet = &open.status.unmet;
    let against = open.planner.contradictions(state.model(), &state.values, unmet, &mut texts);
    let mechanism = mechanism(open, &state);
    let falls = mechanism.as_ref().map_or(&[][..], |(_, unbalanced)| unbalanced);
    let mut problems: Vec<Diagnostic> = Vec::new();
    for c in &against {
        if c.certainty == Certainty::Holds && c.constraints.iter().all(|s| falls.contains(s)) {
            continue;
        }
        let together = match c.certainty {
            Certainty::GivenUp(_) => {
                Some(words::solved_together(open, &words::read_by(&state, &c.constraints)))
            }
            _ => None,
        };
        problems.extend(of_contradiction(open, c, together));
    }
    // where something contradicts, what hangs together with it was not solved, and says nothing of itself
    let told: Vec<Source> = against.iter().flat_map(|c| c.constraints.clone()).collect();
    let around = open.planner.connected(state.model(), &words::read_by(&state, &told));
    let around: BTreeSet<SlotId> = around.into_iter().collect();
    // what could not be planned is said where it stands already
    let is_told = |s: &Source| {
        told.contains(s)
            || !is_planned(&state, s)
            || !words::read_by(&state, &[*s]).is_disjoint(&around)
    };
    let required = open.status.unmet.iter().filter(|u| u.level == Level::Required);
    let untold = required.map(|u| u.source).filter(|s| !is_told(s));
    problems.extend(untold.filter_map(|source| of_unmet(&state, source)));
    problems.extend(mechanism.map(|(problem, _)| problem));
    problems.extend(without_value(&state, &open.values().clone()));
    problems.sort_by_key(|d| (d.place.file, d.place.span.start));
    super::text::diagnostics(&state, &problems)
}

/// Returns false for what could not be planned.
fn is_planned(state: &State, source: &Source) -> bool {
    match source {
        Source::Constraint(index) => state.is_planned(*index),
        Source::Stay(_) | Source::Wish(_) => true,
    }
}

fn of_contradiction(
    open: &Open,
    c: &Contradiction,
    together: Option<String>,
) -> Option<Diagnostic> {
    let state = &open.state;
    let said = contradiction(open, c);
    let code = match c.certainty {
        Certainty::Contradiction => "contradiction",
        Certainty::NoSolution { .. } => "no-solution",
        Certainty::Holds => "out-of-reach",
        Certainty::NotDecided { .. } | Certainty::GivenUp(_) => "not-decided",
    };
    let places: Vec<(Place, String)> =
        c.constraints.iter().filter_map(|&source| place_of(state, source)).collect();
    let (first, others) = places.split_first()?;
    let message = match together {
        Some(together) => format!("{}; {together}", said.message),
        None => said.message,
    };
    let own = |place: &Place| place.file == FileId(0);
    let operation = place_without_value(open, c).filter(own);
    let mut d = Diagnostic::error(code, operation.unwrap_or(first.0), message);
    let mut known = BTreeSet::from([first.clone()]);
    // where the first stands is marked already
    let alone = others.is_empty() && first.0.file == FileId(0);
    if !alone {
        d = d.label(first.0, first.1.clone());
    }
    for (place, rule) in others {
        if known.insert((*place, rule.clone())) {
            d = d.label(*place, rule.clone());
        }
    }
    Some(match said.repairs.as_slice() {
        [] => d,
        repairs => d.hint(repairs.join("; or ")),
    })
}

/// Warns of what the text computes and has no value, `1 / x` where `x` is 0: each message once, of the first such thing.
fn without_value(state: &State, values: &Values) -> Vec<Diagnostic> {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let own = |m: &&Message| {
        m.parameters.is_empty()
            && !m.is_asked
            && !m.is_of_class()
            && state.lowered.place(m.origin).file == FileId(0)
    };
    let mut messages: BTreeMap<ClassId, Vec<&Message>> = BTreeMap::new();
    // what a program did not draw is not missing
    for (id, _) in document.classes.iter().filter(|(_, class)| class.program.is_none()) {
        let line = document.primary_line(id).into_iter();
        let all = line.flat_map(|class| &document.classes[class].messages);
        // what is defined anew below is never asked
        let mut names = BTreeSet::new();
        let asked: Vec<&Message> = all.filter(|m| names.insert(&m.name)).filter(own).collect();
        if !asked.is_empty() {
            messages.insert(id, asked);
        }
    }
    let failing = failing(state, values, &messages);
    let answered: BTreeSet<OriginId> = { structure.things.ids() }
        .filter_map(|thing| messages.get(&structure.things[thing].class))
        .flatten()
        .map(|message| message.origin)
        .collect();
    let mut found = Vec::new();
    for Failing { thing, message, fault } in &failing {
        // what an inner message lacks is told there
        let is_inner = fault.origin.is_some_and(|origin| {
            let alike = failing.iter().filter(|other| other.fault.origin == fault.origin);
            answered.contains(&origin) || sends(message, &alike)
        });
        if !fault.kind.is_of_missing() && !is_inner {
            let place = state.lowered.place(message.origin);
            let path = structure.path(document, *thing).then(Step::Part(message.name.clone()));
            let said = format!("{path} has no value: {}", fault.message);
            found.push(Diagnostic::warning("no-value", place, said));
        }
    }
    found
}

/// A message that a thing cannot answer.
struct Failing<'a> {
    thing: ThingId,
    message: &'a Message,
    fault: Fault,
}

/// Returns the messages that fail, each of the first thing where it does, until there are too many.
fn failing<'a>(
    state: &'a State,
    values: &'a Values,
    messages: &BTreeMap<ClassId, Vec<&'a Message>>,
) -> Vec<Failing<'a>> {
    let structure = &state.structure;
    let evaluator = state.evaluator(values);
    let mut failing = Vec::new();
    let mut known = BTreeSet::new();
    let mut steps = 0;
    for thing in structure.things.ids().filter(|&t| structure.merged[t] == t) {
        for &message in messages.get(&structure.things[thing].class).into_iter().flatten() {
            let place = state.lowered.place(message.origin);
            if known.contains(&place) {
                continue;
            }
            if let Err(fault) = evaluator.evaluate(&message.answer, thing) {
                known.insert(place);
                failing.push(Failing { thing, message, fault });
            }
            steps += evaluator.steps();
            if failing.len() >= MOST_FAULTS || steps > MOST_STEPS {
                return failing;
            }
        }
    }
    failing
}

/// Returns true if a message asks for another one of these.
fn sends<'a>(message: &Message, others: &(impl Iterator<Item = &'a Failing<'a>> + Clone)) -> bool {
    let is_other =
        |other: &Message, name: &Name| other.origin != message.origin && other.name == *name;
    let mut terms = vec![&*message.answer];
    while let Some(term) = terms.pop() {
        terms.extend(term.operands());
        if let Term::Send { name, .. } = term
            && others.clone().any(|other| is_other(other.message, name))
        {
            return true;
        }
    }
    false
}

fn of_unmet(state: &State, source: Source) -> Option<Diagnostic> {
    let name = rules::told(state, source)?;
    let (place, _) = place_of(state, source)?;
    let why = words::shortfall(state, source, &state.values);
    let operation = words::place_of_fault(state, source, &state.values);
    let place = operation.filter(|operation| operation.file == place.file).unwrap_or(place);
    let why = why.map_or(String::new(), |why| format!(": {why}"));
    Some(Diagnostic::error("unmet", place, format!("{name} does not hold{why}")))
}

/// Returns where a constraint is said, and what it says: of one of a library the document's own part that has it.
fn place_of(state: &State, source: Source) -> Option<(Place, String)> {
    let name = words::source_name(state, source)?;
    let Source::Constraint(index) = source else { return None };
    let instance = state.structure.constraints[index as usize];
    let class = &state.lowered.document.classes[instance.class];
    let place = state.lowered.place(class.constraints[instance.index as usize].origin);
    let rule = words::rule_alone(state, index);
    let said = format!("{name}: {rule}");
    if place.file == FileId(0) {
        return Some((place, said));
    }
    Some((own_place(state, instance.owner).unwrap_or(place), said))
}

/// Returns where the innermost part of the document's own text that a thing belongs to is declared.
fn own_place(state: &State, thing: ThingId) -> Option<Place> {
    let structure = &state.structure;
    let mut at = Some(thing);
    while let Some(thing) = at {
        let t = &structure.things[thing];
        let layout = t.owner.and_then(|owner| structure.layout(structure.things[owner].class));
        let field = layout.and_then(|layout| layout.fields.get(t.field as usize));
        let part = field.and_then(|field| state.lowered.document.declared(*field));
        if let Some(place) = part.map(|part| state.lowered.place(part.origin))
            && place.file == FileId(0)
        {
            return Some(place);
        }
        at = t.owner;
    }
    None
}

/// Says that what is loaded can move without resistance: forces that do not balance, or a load that gave way,
/// where lengths hang together with them that nothing decides. Returns the constraints that do not balance as well.
fn mechanism(open: &mut Open, state: &State) -> Option<(Diagnostic, Vec<Source>)> {
    let is_load = |dimension| matches!(dimension, Dimension::FORCE | Dimension::MOMENT);
    let measures = |slot: SlotId| match state.structure.slots[slot].primitive {
        Primitive::Real(dimension) => Some(dimension),
        Primitive::Integer
        | Primitive::Bool
        | Primitive::Choice(_)
        | Primitive::Text
        | Primitive::Color => None,
    };
    let required = open.status.unmet.iter().filter(|u| u.level == Level::Required);
    let unmet = required.map(|u| u.source).filter(|s| is_planned(state, s));
    let unbalanced: Vec<Source> = unmet
        .filter(|&s| words::measure(state, s).is_some_and(|(measured, _)| is_load(measured)))
        .collect();
    let gave_way: Vec<SlotId> =
        state.yielded().filter(|&s| measures(s).is_some_and(is_load)).collect();
    let mut loaded = words::read_by(state, &unbalanced);
    loaded.extend(&gave_way);
    if loaded.is_empty() {
        return None;
    }
    let place = match (unbalanced.first(), gave_way.first()) {
        (Some(&source), _) => place_of(state, source)?.0,
        (None, Some(&slot)) => state.lowered.place(state.structure.given(slot)?.origin),
        (None, None) => return None,
    };
    let mut texts = Texts::new(&state.lowered.document, &state.structure);
    let arbitrary = open.planner.arbitrary(state.model(), &state.values, &mut texts);
    let around = open.planner.connected(state.model(), &loaded);
    let moves = |s: &SlotId| {
        let is_length = measures(*s) == Some(Dimension::LENGTH);
        arbitrary.contains(s) && (is_length || is_angle(state, *s))
    };
    let moving: Vec<SlotId> = around.into_iter().filter(moves).collect();
    if moving.is_empty() {
        return None;
    }
    let moving = words::listed(&words::slots_listed(state, &moving));
    let names = rules::all_told(state, &unbalanced);
    let so = match names.is_empty() {
        true => String::new(),
        false => format!(", so {} cannot be met", words::listed(&names)),
    };
    let message = format!("a mechanism under load: nothing holds {moving}{so}");
    let hint = "add a bar or a support that keeps it from moving, or take the load away";
    Some((Diagnostic::error("mechanism", place, message).hint(hint), unbalanced))
}

fn is_angle(state: &State, slot: SlotId) -> bool {
    words::class_name(state, state.structure.slots[slot].thing) == "Angle"
}
