//! What every thing answers, where its class says otherwise than Object: what it accepts, how it
//! moves, what it holds once it is merged.

use crate::session::thing_at;
use crate::state::State;
use crate::view::Refusal;
use crate::words;
use base::Name;
use eval::Answer;
use expr::Dimension;
use kernel::{
    Argument, ClassId, ClassKind, Command, Document, Path, Primitive, SlotId, Term, ThingId, Value,
};
use std::sync::Arc;

/// Returns true if the class of a thing defines a message that every thing has.
pub(crate) fn defines(state: &State, thing: ThingId, name: &str) -> bool {
    let document = &state.lowered.document;
    let class = state.structure.things[thing].class;
    let found = document.find_message(class, name, None);
    found.is_some_and(|(definer, _)| !document.classes[definer].supers.is_empty())
}

/// Asks every thing on the way to what is changed, the outermost first, whether it accepts that.
///
/// # Errors
/// Which one does not.
pub(crate) fn accept(state: &State, path: &Path) -> Result<(), Refusal> {
    for n in 0..path.0.len() {
        let owner = Path(path.0[..n].to_vec());
        let Some(thing) = thing_at(state, &owner) else { return Ok(()) };
        if !defines(state, thing, "accepts") {
            continue;
        }
        let change = Path(path.0[n..].to_vec()).to_string();
        let term = sent(Term::Me, "accepts", "change", Term::Text(change.clone()));
        let evaluator = state.evaluator(&state.values);
        if let Ok(Answer::Bool(false)) = evaluator.evaluate(&term, thing) {
            let who = if owner.is_empty() { "the document".into() } else { owner.to_string() };
            return Err(words::refuse(format!("refused: {who} accepts no change of {change}")));
        }
    }
    Ok(())
}

/// Returns the paths that a command changes something at.
pub(crate) fn changed(command: &Command) -> Vec<&Path> {
    match command {
        Command::Set(targets) | Command::Move(targets) => targets.iter().map(|t| &t.0).collect(),
        Command::Merge(paths) => paths.iter().collect(),
        Command::Unmerge(path)
        | Command::Delete(path)
        | Command::Anchor { path, .. }
        | Command::Enable { path, .. } => vec![path],
        Command::Edit { .. }
        | Command::Rename { .. }
        | Command::Promote { .. }
        | Command::Text(_)
        | Command::Undo
        | Command::Redo => Vec::new(),
    }
}

/// Returns what a thing holds when it is moved, where its class says how: of every slot.
pub(crate) fn moved(state: &State, thing: ThingId, way: (f64, f64)) -> Option<Vec<(SlotId, f64)>> {
    let document = &state.lowered.document;
    let class = state.structure.things[thing].class;
    let (_, message) = document.find_message(class, &Name::new("moved"), None)?;
    // the way is of the class that the message asks for; where it asks for none, any place will do
    let asked = message.parameters.first().and_then(|p| p.class);
    let any = || document.classes.ids().find(|&c| measure_of_place(document, c).is_some());
    let place = asked.or_else(any)?;
    let dimension = measure_of_place(document, place)?;
    let length = |value| Term::Number { value, dimension, bare: false };
    let argument = |value| Argument { label: None, value: length(value) };
    let arguments = vec![argument(way.0), argument(way.1)];
    let term = sent(Term::Me, "moved", "by", Term::Make { class: place, arguments });
    let evaluator = state.evaluator(&state.values);
    let answer = evaluator.evaluate(&term, thing).ok()?;
    let number = |(slot, value)| match value {
        Value::Number(x) => Some((slot, x)),
        Value::Text(_) => None,
    };
    Some(held(state, thing, &answer).into_iter().filter_map(number).collect())
}

/// Returns what the coordinates of a place measure: of a class that consists of two numbers x and y.
fn measure_of_place(document: &Document, class: ClassId) -> Option<Dimension> {
    let [x, y] = document.layout(class)[..] else { return None };
    let named = **document.field_name(x) == *"x" && **document.field_name(y) == *"y";
    let kind = |field| &document.classes[document.field_class(field)].kind;
    match kind(x) {
        ClassKind::Primitive(Primitive::Real(dimension)) if named && kind(y) == kind(x) => {
            Some(*dimension)
        }
        ClassKind::Primitive(_)
        | ClassKind::Composite
        | ClassKind::List(_)
        | ClassKind::Set(_)
        | ClassKind::Reference(_) => None,
    }
}

/// Returns what the first of things that are to be merged holds then, where its class says so.
pub(crate) fn merged(state: &State, paths: &[Path]) -> Vec<(Path, Value)> {
    let things: Vec<ThingId> = paths.iter().filter_map(|p| thing_at(state, p)).collect();
    let [first, others @ ..] = things.as_slice() else { return Vec::new() };
    if !defines(state, *first, "merged") {
        return Vec::new();
    }
    // what it holds with one of them is asked what it holds with the next
    let with = |held: Term, other: &ThingId| {
        let path = state.structure.path(&state.lowered.document, *other);
        sent(held, "merged", "with", Term::at(Term::Document, &path))
    };
    let term = others.iter().fold(Term::Me, with);
    let evaluator = state.evaluator(&state.values);
    let Ok(answer) = evaluator.evaluate(&term, *first) else { return Vec::new() };
    let holds = held(state, *first, &answer);
    holds.into_iter().map(|(slot, value)| (state.slot_path(slot), value)).collect()
}

fn sent(to: Term, name: &str, label: &str, value: Term) -> Term {
    let argument = Argument { label: Some(Name::new(label)), value };
    Term::Send { to: Box::new(to), name: Name::new(name), arguments: vec![argument], search: None }
}

/// Returns what an answer says that is to be in the slots of a thing.
fn held(state: &State, thing: ThingId, answer: &Answer<'_>) -> Vec<(SlotId, Value)> {
    let structure = &state.structure;
    let fields = match answer {
        Answer::Made(made) => &made.fields[..],
        Answer::List(items) => items,
        Answer::Number(x, _) => {
            return structure.slot_of(thing).map(|s| (s, Value::Number(*x))).into_iter().collect();
        }
        Answer::Bool(b) => {
            let x = Value::Number(f64::from(u8::from(*b)));
            return structure.slot_of(thing).map(|s| (s, x)).into_iter().collect();
        }
        Answer::Option(_, at) => {
            let x = Value::Number(f64::from(*at));
            return structure.slot_of(thing).map(|s| (s, x)).into_iter().collect();
        }
        Answer::Text(text) => {
            let text = Value::Text(Arc::from(&**text));
            return structure.slot_of(thing).map(|s| (s, text)).into_iter().collect();
        }
        Answer::Thing(other) => {
            let (to, from) = (structure.slots_under(thing), structure.slots_under(*other));
            let same = to.len() == from.len();
            let both = to.into_iter().zip(from).filter(|_| same);
            return both.map(|(to, from)| (to, state.values.get(from))).collect();
        }
        Answer::Context(_) | Answer::Picture(_) | Answer::Function(_) => return Vec::new(),
    };
    let parts = structure.parts(thing).zip(fields);
    parts.flat_map(|(part, field)| held(state, part, field)).collect()
}

/// Returns the parts that a message of a thing's class names, for a view; nothing where its class
/// says no more than Object.
pub(crate) fn named(state: &State, thing: ThingId, view: &str) -> Option<Vec<ThingId>> {
    if !defines(state, thing, view) {
        return None;
    }
    let evaluator = state.evaluator(&state.values);
    let answer = evaluator.ask(thing, &Name::new(view)).ok()?;
    let Answer::List(items) = answer else { return None };
    let part = |item: &Answer<'_>| match item {
        Answer::Thing(t) => Some(*t),
        Answer::Text(name) => state.structure.part_named(thing, name),
        _ => None,
    };
    Some(items.iter().filter_map(part).collect())
}
