//! Words: how values, paths and reasons are put to people.

use crate::document::Open;
use crate::state::State;
use crate::view::{Freedom, Refusal};
use crate::views;
use base::Diagnostic;
use indexmap::IndexSet;
use kernel::{
    ClassId, ClassKind, Command, ConstraintInstance, Document, Literal, Path, Primitive, SlotId,
    Step, Structure, Term, ThingId, Value, Values,
};
use plan::{Acting, ActingKind, EditReport, NotDecided, RefusalReason, Source};
use std::collections::BTreeSet;

/// Makes a refusal of one sentence.
pub(crate) fn refuse(message: String) -> Refusal {
    Refusal { message, ..Refusal::default() }
}

/// Makes a refusal of diagnostics.
pub(crate) fn refusal_of_text(state: &State, diagnostics: &[Diagnostic]) -> Refusal {
    let message = diagnostics.first().map_or_else(String::new, |d| match &d.hint {
        Some(hint) => format!("{}: {hint}", d.message),
        None => d.message.clone(),
    });
    let diagnostics = views::text::diagnostics(state, diagnostics);
    Refusal { message, diagnostics, ..Refusal::default() }
}

/// Says why an edit was refused, and by which constraints.
pub(crate) fn refusal_for(state: &State, reason: &RefusalReason, report: &EditReport) -> Refusal {
    let (sources, are_several) = refusing(state, report);
    let mut constraints: Vec<String> =
        sources.iter().filter_map(|&source| source_name(state, source)).collect();
    let said = sources.iter().filter_map(|&source| source_in_words(state, source));
    let said = listed(&said.collect::<Vec<_>>());
    let message = match reason {
        RefusalReason::Unmet if sources.is_empty() => {
            "refused: what stands fixed does not leave room for this".to_string()
        }
        RefusalReason::Unmet if are_several => format!("refused: {said} would not all hold"),
        RefusalReason::Unmet => format!("refused: {said} would not hold"),
        RefusalReason::NotDecided(bound) => {
            format!("not decided: no solution was found in {}", given_up(*bound))
        }
        RefusalReason::OutOfRange(slot) => {
            let path = state.slot_path(*slot);
            match state.structure.ranges.get(slot) {
                Some((low, high)) => format!("refused: {path} has to be one of {low}..{high}"),
                None => format!("refused: {path} cannot have this value"),
            }
        }
        RefusalReason::Anchored(slot) => {
            format!("refused: {} is anchored", state.slot_path(*slot))
        }
        RefusalReason::Method(failure) => {
            let name = source_name(state, failure.source).unwrap_or_default();
            constraints.retain(|known| *known != name);
            constraints.insert(0, name.clone());
            format!("refused by {name}: {}", failure.message)
        }
        RefusalReason::Target(message) => message.clone(),
    };
    Refusal { message, constraints, ..Refusal::default() }
}

/// Returns the constraints for which an edit was refused: those of a conflict, since what is only downstream of it
/// has no part in it, and whether they are several; else those that would not hold.
pub(crate) fn refusing(state: &State, report: &EditReport) -> (Vec<Source>, bool) {
    let mut conflicting: Vec<Source> = Vec::new();
    for conflict in &report.conflicts {
        for &source in std::iter::once(&conflict.source).chain(&conflict.circuit) {
            if source_name(state, source).is_some() && !conflicting.contains(&source) {
                conflicting.push(source);
            }
        }
    }
    if conflicting.is_empty() {
        let required = report.unmet.iter().filter(|u| u.level == solve::Level::Required);
        return (required.map(|u| u.source).collect(), false);
    }
    let are_several = conflicting.len() > 1;
    (conflicting, are_several)
}

/// Names the bound at which a search was given up.
pub(crate) fn given_up(bound: NotDecided) -> String {
    match bound {
        NotDecided::Search(n) => format!("{n} states of the search, and not all were looked at"),
        NotDecided::Round => "one round of methods, and no other was tried".into(),
        NotDecided::Modes(n) => format!("{n} modes, and not all were tried"),
        NotDecided::Whole(n) => {
            format!("{n} choices of whole numbers, and not all were looked at")
        }
        NotDecided::Work(n) => format!("{n} multiplications, and there was more to do"),
        NotDecided::Roots(n) => format!("{n} choices among roots, and not all were tried"),
    }
}

/// Says which required constraints do not hold, as the reason why an edit was refused; nothing if all
/// do.
pub(crate) fn refusal_of_status(state: &State, status: &plan::Status) -> Option<Refusal> {
    let unmet = status.unmet.iter().filter(|u| u.level == solve::Level::Required);
    let unmet: Vec<Source> = unmet.map(|u| u.source).collect();
    let constraints: Vec<String> = unmet.iter().filter_map(|&u| source_name(state, u)).collect();
    let said: Vec<String> = unmet.iter().filter_map(|&u| source_in_words(state, u)).collect();
    let message = format!("refused: {} would not hold", listed(&said));
    (!status.satisfied).then(|| Refusal { message, constraints, ..Refusal::default() })
}

/// Returns the paths of the things that have a required constraint which does not hold.
pub(crate) fn unmet_things(state: &State, status: &plan::Status) -> Vec<String> {
    let mut paths: Vec<String> = Vec::new();
    let unmet = status.unmet.iter().filter(|u| u.level == solve::Level::Required);
    for thing in unmet.filter_map(|u| match u.source {
        Source::Constraint(c) => Some(state.structure.constraints[c as usize].owner),
        Source::Stay(s) => Some(state.structure.stays[s as usize].thing),
        Source::Wish(_) => None,
    }) {
        let path = state.structure.path(&state.lowered.document, thing).to_string();
        if !paths.contains(&path) {
            paths.push(path);
        }
    }
    paths
}

/// Lists names for a sentence: the first few, and how many more there are.
pub(crate) fn listed(names: &[String]) -> String {
    const SHOWN: usize = 4;
    match names.get(..SHOWN) {
        Some(first) if names.len() > SHOWN + 1 => {
            format!("{} and {} more", first.join(", "), names.len() - SHOWN)
        }
        _ => names.join(", "),
    }
}

/// Names slots: a place whose coordinates are all among them by its own path.
pub(crate) fn slots_listed(state: &State, slots: &[SlotId]) -> Vec<String> {
    let all: BTreeSet<SlotId> = slots.iter().copied().collect();
    let name = |&slot: &SlotId| {
        let place = state.structure.slots[slot].place;
        let whole = place
            .filter(|&place| state.structure.slots_under(place).iter().all(|s| all.contains(s)));
        match whole {
            Some(place) => state.structure.path(&state.lowered.document, place).to_string(),
            None => state.slot_path(slot).to_string(),
        }
    };
    let names: IndexSet<String> = slots.iter().map(name).collect();
    names.into_iter().collect()
}

/// Says what holds a drag that did not reach the pointer; nothing where no constraint can be named.
pub(crate) fn what_holds(state: &State, report: &EditReport, acting: &[Acting]) -> Option<String> {
    let mut names: Vec<String> = Vec::new();
    for conflict in &report.conflicts {
        let sources = std::iter::once(&conflict.source).chain(&conflict.circuit);
        for name in sources.filter_map(|s| source_in_words(state, *s)) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    let bounds = acting.iter().filter(|a| a.kind == ActingKind::AtBound);
    for name in bounds.filter_map(|a| source_in_words(state, a.source)) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    (!names.is_empty()).then(|| format!("held by {}", listed(&names)))
}

/// Returns the path and name of a constraint; nothing for a wish.
pub(crate) fn source_name(state: &State, source: Source) -> Option<String> {
    match source {
        Source::Constraint(c) => {
            Some(constraint_path(state, state.structure.constraints[c as usize]))
        }
        Source::Stay(s) => {
            let thing = state.structure.stays[s as usize].thing;
            Some(format!("stay {}", state.structure.path(&state.lowered.document, thing)))
        }
        Source::Wish(_) => None,
    }
}

/// Returns what a reader is told of a constraint: its path; of one without a name what it says as well.
pub(crate) fn source_in_words(state: &State, source: Source) -> Option<String> {
    let name = source_name(state, source)?;
    match source {
        Source::Constraint(index) => Some(name + &unnamed_rule(state, index)),
        Source::Stay(_) | Source::Wish(_) => Some(name),
    }
}

/// The longest rule that is told with the path of its constraint, in letters.
const LONGEST_RULE: usize = 48;

/// Returns the rule of a constraint that has no name, in brackets; nothing where it has one, or is long.
pub(crate) fn unnamed_rule(state: &State, index: u32) -> String {
    let instance = state.structure.constraints[index as usize];
    let class = &state.lowered.document.classes[instance.class];
    if class.constraints[instance.index as usize].name.is_some() {
        return String::new();
    }
    let rule = rule_alone(state, index);
    let is_short = !rule.is_empty() && rule.chars().count() <= LONGEST_RULE && !rule.contains('\n');
    if is_short { format!(" ({rule})") } else { String::new() }
}

/// Returns the path of a constraint: its owner's, and its name.
pub(crate) fn constraint_path(state: &State, instance: ConstraintInstance) -> String {
    let document = &state.lowered.document;
    let owner = state.structure.path(document, instance.owner);
    owner.then(Step::Part(constraint_name(document, instance).as_str().into())).to_string()
}

/// Returns a constraint's name; one without is called after its place among its class's.
pub(crate) fn constraint_name(document: &Document, instance: ConstraintInstance) -> String {
    let constraint = &document.classes[instance.class].constraints[instance.index as usize];
    match &constraint.name {
        Some(name) => name.to_string(),
        None => format!("constraint{}", instance.index + 1),
    }
}

/// Returns the rule of a constraint as it is written, without its methods.
pub(crate) fn rule_of(state: &State, index: u32) -> String {
    let instance = state.structure.constraints[index as usize];
    let class = &state.lowered.document.classes[instance.class];
    let written = state.lowered.source_of(class.constraints[instance.index as usize].origin);
    let rule = written.strip_suffix('}').and_then(|w| w.split_once('{')).map(|(rule, _)| rule);
    rule.unwrap_or(&written).trim().to_string()
}

/// Returns the rule of a constraint as it is written, without its strength, name and methods.
pub(crate) fn rule_alone(state: &State, index: u32) -> String {
    let instance = state.structure.constraints[index as usize];
    let declared =
        &state.lowered.document.classes[instance.class].constraints[instance.index as usize];
    let written = rule_of(state, index);
    let rule = written.split_once("constraint").map_or(written.as_str(), |(_, rest)| rest.trim());
    let named =
        declared.name.as_deref().and_then(|name| rule.strip_prefix(name)?.strip_prefix(':'));
    named.unwrap_or(rule).trim().to_string()
}

/// Says how a constraint of this name acts in a mode.
pub(crate) fn acting(state: &State, name: &str, kind: ActingKind) -> String {
    match kind {
        ActingKind::Whole { slot, value } => {
            format!("{} is {} now", state.slot_path(slot), base::number::shortest(value))
        }
        ActingKind::AtBound => format!("{name} is at its bound"),
        ActingKind::Assumed(true) => format!("the condition of {name} is true"),
        ActingKind::Assumed(false) => format!("the condition of {name} is false"),
        ActingKind::Taken { way, of } => format!("{name} holds by alternative {} of {of}", way + 1),
    }
}

/// Returns what a thing is, in the words of its class where that has some.
pub(crate) fn description(state: &State, thing: ThingId, values: &Values) -> String {
    let own = crate::general::defines(state, thing, "description").then(|| {
        let evaluator = state.evaluator(values);
        evaluator.ask(thing, &base::Name::new("description")).ok()
    });
    match own.flatten() {
        Some(eval::Answer::Text(words)) => words.to_string(),
        _ => class_name(state, thing),
    }
}

/// Returns the path that a term of parts and messages spells.
pub(crate) fn term_path(term: &Term) -> String {
    match term {
        Term::Send { to, name, .. } if **to == Term::Me => name.to_string(),
        Term::Send { to, name, .. } => format!("{}.{name}", term_path(to)),
        Term::Index(of, at) => match &**at {
            Term::Number { value, .. } => format!("{}[{value}]", term_path(of)),
            _ => term_path(of),
        },
        _ => String::new(),
    }
}

/// Finds the thing at a path.
///
/// # Errors
/// That there is none, with the nearest name that there is.
pub(crate) fn find(state: &State, path: &Path) -> Result<ThingId, Refusal> {
    state.structure.follow(kernel::DOCUMENT, path).map_err(|astray| {
        let layout = state.structure.layout(state.structure.things[astray.at].class);
        let step = Path(vec![path.0[astray.step].clone()]).to_string();
        let names = layout.into_iter().flat_map(|l| l.index.keys().map(base::Name::as_str));
        let hint = base::diagnostic::nearest(&step, names)
            .map_or_else(String::new, |n| format!("; did you mean {n}?"));
        let place = match &path.0[..astray.step] {
            [] => "here".to_string(),
            whole => format!("in {}", Path(whole.to_vec())),
        };
        refuse(format!("there is no {step} {place}{hint}"))
    })
}

/// Returns a value as text and unit, as a person reads it.
pub(crate) fn show_slot(state: &State, slot: SlotId, values: &Values) -> (String, String) {
    match (state.structure.slots[slot].primitive, values.get(slot)) {
        (Primitive::Real(dimension), Value::Number(x)) => {
            lang::show_number(x, dimension, &state.lowered.document)
        }
        (Primitive::Bool, Value::Number(x)) => ((x != 0.0).to_string(), String::new()),
        (_, Value::Number(x)) => (base::number::shortest(x), String::new()),
        (_, Value::Text(t)) => (t.to_string(), String::new()),
    }
}

/// Puts a number and its unit together, where it has one.
pub(crate) fn with_unit(text: String, unit: &str) -> String {
    if unit.is_empty() { text } else { format!("{text} {unit}") }
}

/// Returns the value of a thing, if it is primitive or a place.
pub(crate) fn show_thing(state: &State, thing: ThingId, values: &Values) -> Option<String> {
    let joined = |slot| {
        let (text, unit) = show_slot(state, slot, values);
        with_unit(text, &unit)
    };
    match state.structure.slot_of(thing) {
        Some(slot) => Some(joined(slot)),
        None if state.lowered.document.is_place(state.structure.things[thing].class) => {
            let slots = state.structure.slots_under(thing);
            Some(format!("({})", slots.into_iter().map(joined).collect::<Vec<_>>().join(", ")))
        }
        None => None,
    }
}

/// Returns the class of a thing; for a class of one, the class that it comes from.
pub(crate) fn class_name(state: &State, thing: ThingId) -> String {
    let document = &state.lowered.document;
    let class = state.structure.things[thing].class;
    match &document.classes[class].kind {
        ClassKind::List(element) => {
            let n = state.structure.things[thing].parts;
            format!("List of {n} {}", document.classes[*element].name)
        }
        _ => document.classes[document.named_class(class)].name.to_string(),
    }
}

/// Returns what `///` says of a thing: of its part, else of its class.
pub(crate) fn doc_of(state: &State, thing: ThingId) -> String {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let t = &structure.things[thing];
    let declared = t.owner.and_then(|owner| {
        let layout = structure.layout(structure.things[owner].class)?;
        document.declared(*layout.fields.get(t.field as usize)?)
    });
    match declared {
        Some(part) if !part.doc.is_empty() => part.doc.clone(),
        Some(_) | None => document.classes[t.class].doc.clone(),
    }
}

/// Returns the state of a thing's values.
pub(crate) fn freedom_of(
    structure: &Structure,
    status: &plan::Status,
    thing: ThingId,
) -> Option<Freedom> {
    if let Some(slot) = structure.slot_of(thing) {
        return Some(match status.slots[slot] {
            plan::SlotState::Conflicting => Freedom::Conflicting,
            plan::SlotState::Free => Freedom::Free,
            plan::SlotState::Fixed => Freedom::Fixed,
        });
    }
    let slots = structure.slots_under(thing);
    let of = |f: plan::SlotState| slots.iter().any(|&s| status.slots[s] == f);
    if slots.is_empty() {
        None
    } else if of(plan::SlotState::Conflicting) {
        Some(Freedom::Conflicting)
    } else if of(plan::SlotState::Free) {
        Some(Freedom::Free)
    } else {
        Some(Freedom::Fixed)
    }
}

/// Reads what a person typed into a value.
///
/// # Errors
/// What was found and what was wanted.
pub(crate) fn read_typed(state: &State, path: &Path, typed: &str) -> Result<Literal, Refusal> {
    let class = crate::session::thing_at(state, path).map(|t| state.structure.things[t].class);
    let is_words = |class: ClassId| {
        let kind = &state.lowered.document.classes[class].kind;
        matches!(kind, ClassKind::Primitive(Primitive::Text | Primitive::Color))
    };
    if names_another(state, path)
        && !class.is_some_and(is_words)
        && let Some(other) = crate::parse_path(typed.trim())
    {
        find(state, &other)?;
        return Ok(Literal::Path(other));
    }
    let kind = class.map_or(lang::Wanted::Anything, lang::Wanted::Class);
    lang::read_literal(typed, kind, &state.lowered.document)
        .map_err(|d| refuse(d.hint.map_or(d.message.clone(), |h| format!("{}; {h}", d.message))))
}

/// Returns true for a part that names another: a `Path to C`, or an element of a list of such.
pub(crate) fn names_another(state: &State, path: &Path) -> bool {
    let Some((last, owner)) = path.0.split_last() else { return false };
    let structure = &state.structure;
    let Ok(owner) = structure.follow(kernel::DOCUMENT, &Path(owner.to_vec())) else { return false };
    let document = &state.lowered.document;
    let part = match last {
        Step::Part(name) => structure.part_named(owner, name),
        Step::Index(i) => structure.parts(owner).nth(*i as usize),
        Step::Last => structure.parts(owner).last(),
        Step::Owner => None,
    };
    let class = part.map(|p| &document.classes[structure.things[p].class].kind);
    matches!(class, Some(ClassKind::Reference(_)))
}

/// Returns what the undo list calls a command.
pub(crate) fn command_label(command: &Command) -> String {
    let paths =
        |paths: &[Path]| paths.iter().map(ToString::to_string).collect::<Vec<_>>().join(" = ");
    match command {
        Command::Set(t) | Command::Move(t) => {
            paths(&t.iter().map(|t| t.0.clone()).collect::<Vec<_>>())
        }
        Command::Merge(p) => format!("merge {}", paths(p)),
        Command::Unmerge(p) => format!("unmerge {p}"),
        Command::Delete(p) => format!("delete {p}"),
        Command::Edit { target, .. } if target.is_empty() => "add to the document".into(),
        Command::Edit { target, .. } => format!("edit {target}"),
        Command::Rename { from, to } => format!("rename {from} to {to}"),
        Command::Promote { path, class } => format!("promote {path} as {class}"),
        Command::Anchor { path, held: true } => format!("anchor {path}"),
        Command::Anchor { path, held: false } => format!("let go of {path}"),
        Command::Enable { path, on: true } => format!("switch {path} on"),
        Command::Enable { path, on: false } => format!("switch {path} off"),
        Command::Text(_) => "edit text".into(),
        Command::Undo => "undo".into(),
        Command::Redo => "redo".into(),
    }
}

/// Returns a document's title: what its text says of itself up to the first colon or full stop; else its name,
/// without folder and ending.
pub(crate) fn title(open: &Open) -> String {
    let doc = &open.state.lowered.doc;
    let end = doc.find([':', '.', '\n']).unwrap_or(doc.len());
    let title = doc[..end].trim();
    if !title.is_empty() && title.chars().count() <= 40 {
        return title.into();
    }
    let name = open.name.rsplit('/').next().unwrap_or(&open.name);
    name.strip_suffix(".thing").unwrap_or(name).replace(['-', '_'], " ")
}
