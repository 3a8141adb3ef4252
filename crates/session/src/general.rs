//! What every thing answers, where its class says otherwise than Object: what it accepts, how it
//! moves, what it holds once it is merged.

use crate::session::thing_at;
use crate::state::State;
use crate::view::Refusal;
use crate::words;
use base::Name;
use eval::Answer;
use kernel::{
    Argument, ClassKind, Command, DOCUMENT, Path, Primitive, SlotId, Term, ThingId, Value,
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
        let term = sent("accepts", "change", Term::Text(change.clone()));
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
    let (place, dimension) = document.classes.ids().find_map(|c| {
        let fields = document.layout(c);
        let named = |name: &str, i: usize| {
            fields.get(i).is_some_and(|&f| **document.field_name(f) == *name)
        };
        let kind = &document.classes[document.field_class(*fields.first()?)].kind;
        match kind {
            ClassKind::Primitive(Primitive::Real(d)) if named("x", 0) && named("y", 1) => {
                (fields.len() == 2).then_some((c, *d))
            }
            _ => None,
        }
    })?;
    let length = |value| Term::Number { value, dimension, bare: false };
    let argument = |value| Argument { label: None, value: length(value) };
    let arguments = vec![argument(way.0), argument(way.1)];
    let term = sent("moved", "by", Term::Make { class: place, arguments });
    let evaluator = state.evaluator(&state.values);
    let answer = evaluator.evaluate(&term, thing).ok()?;
    let number = |(slot, value)| match value {
        Value::Number(x) => Some((slot, x)),
        Value::Text(_) => None,
    };
    Some(held(state, thing, &answer).into_iter().filter_map(number).collect())
}

/// Returns what the first of things that are to be merged holds then, where its class says so.
pub(crate) fn merged(state: &State, paths: &[Path]) -> Vec<(Path, Value)> {
    let things: Vec<ThingId> = paths.iter().filter_map(|p| thing_at(state, p)).collect();
    let [first, others @ ..] = things.as_slice() else { return Vec::new() };
    if !defines(state, *first, "merged") {
        return Vec::new();
    }
    let path = |&thing: &ThingId| {
        let path = state.structure.path(&state.lowered.document, thing);
        path.0.iter().fold(Term::Document, |to, step| match step {
            kernel::Step::Part(name) => Term::send(to, name),
            kernel::Step::Index(i) => {
                Term::Index(Box::new(to), Box::new(Term::number(f64::from(*i))))
            }
            kernel::Step::Last => Term::send(to, "last"),
            kernel::Step::Owner => Term::send(to, "owner"),
        })
    };
    let terms: Vec<Term> = others.iter().map(|o| sent("merged", "with", path(o))).collect();
    let evaluator = state.evaluator(&state.values);
    let mut holds = Vec::new();
    for term in &terms {
        if let Ok(answer) = evaluator.evaluate(term, *first) {
            holds = held(state, *first, &answer);
        }
    }
    holds.into_iter().map(|(slot, value)| (state.slot_path(slot), value)).collect()
}

fn sent(name: &str, label: &str, value: Term) -> Term {
    let argument = Argument { label: Some(Name::new(label)), value };
    Term::Send {
        to: Box::new(Term::Me),
        name: Name::new(name),
        arguments: vec![argument],
        search: None,
    }
}

/// Returns what an answer says that is to be in the slots of a thing.
fn held(state: &State, thing: ThingId, answer: &Answer<'_>) -> Vec<(SlotId, Value)> {
    let structure = &state.structure;
    let fields = match answer {
        Answer::Made(made) => &made.fields[..],
        Answer::List(items) => items,
        Answer::Number(x, _) => {
            return structure.slot_of[thing].map(|s| (s, Value::Number(*x))).into_iter().collect();
        }
        Answer::Bool(b) => {
            let x = Value::Number(f64::from(u8::from(*b)));
            return structure.slot_of[thing].map(|s| (s, x)).into_iter().collect();
        }
        Answer::Text(text) => {
            let text = Value::Text(Arc::from(&**text));
            return structure.slot_of[thing].map(|s| (s, text)).into_iter().collect();
        }
        Answer::Thing(_) | Answer::Picture(_) | Answer::Function(_) => return Vec::new(),
    };
    let parts = structure.parts(thing).zip(fields);
    parts.flat_map(|(part, field)| held(state, part, field)).collect()
}

/// Returns the parts that a message of a thing's class names, for a view; nothing where its class
/// says no more than Object.
pub(crate) fn named(state: &State, thing: ThingId, view: &str) -> Option<Vec<ThingId>> {
    if thing == DOCUMENT || !defines(state, thing, view) {
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
