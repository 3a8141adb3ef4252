//! What programs draw, and what classes declare of their figures: the way through it, and the grips of its places, which
//! pull on the parameters.

use crate::state::State;
use crate::view::Grip;
use base::Name;
use eval::{Answer, Context, Evaluator, Standing};
use kernel::{ClassId, ClassKind, DOCUMENT, Document, ThingId};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::rc::Rc;

/// So many places of what one program draws can be gripped.
const MOST: usize = 200;
/// So many things can be gripped at the places that their classes declare.
const MOST_DECLARING: usize = 100;
/// What lies at the end of a longer path is not looked into.
const LONGEST_PATH: usize = 1000;

/// Returns what the program of a thing drew, where it is shown: moved and turned, if the thing is placed.
pub(crate) fn shown<'a>(evaluator: &Evaluator<'a>, thing: ThingId) -> Option<Rc<Context<'a>>> {
    match evaluator.ask(thing, &Name::new(lang::PLACED)) {
        Ok(Answer::Context(placed)) => Some(placed),
        Ok(_) | Err(_) => evaluator.run(thing).ok()?,
    }
}

/// Goes through what was drawn, from `path` on: what a step made, turn by turn, and the parts of that. `visit` is told
/// what is there, what for, and the path to it, and answers whether to go into it.
pub(crate) fn walk<'a>(
    document: &Document,
    (answer, standing): (&Answer<'a>, Standing),
    path: &mut String,
    visit: &mut dyn FnMut(&Answer<'a>, Standing, &str) -> bool,
) {
    if path.len() > LONGEST_PATH || !visit(answer, standing, path) {
        return;
    }
    let end = path.len();
    let mut into = |step: std::fmt::Arguments<'_>, next: (&Answer<'a>, Standing)| {
        let _ = path.write_fmt(step);
        walk(document, next, path, visit);
        path.truncate(end);
    };
    let dot = if end == 0 { "" } else { "." };
    match answer {
        Answer::Made(made) => {
            for (field, answer) in document.layout(made.class).into_iter().zip(&made.fields) {
                into(format_args!("{dot}{}", document.field_name(field)), (answer, standing));
            }
        }
        Answer::Context(context) => {
            for entry in context.made.iter().filter(|e| !e.name.is_empty()) {
                into(format_args!("{dot}{}", entry.name), (&entry.answer, entry.standing));
            }
        }
        Answer::List(items) => {
            for (i, item) in items.iter().enumerate() {
                into(format_args!("[{i}]"), (item, standing));
            }
        }
        Answer::Number(..)
        | Answer::Bool(_)
        | Answer::Option(..)
        | Answer::Text(_)
        | Answer::Thing(_)
        | Answer::Picture(_)
        | Answer::Function(_) => {}
    }
}

/// Returns the entities that the program of a thing drew, with their paths, in the order of drawing.
pub(crate) fn entities<'a>(
    state: &State,
    evaluator: &Evaluator<'a>,
    thing: ThingId,
) -> Vec<(String, Answer<'a>)> {
    /// So many are told apart; those beyond are the thing's.
    const MOST: usize = 5000;
    let document = &state.lowered.document;
    let mut found = Vec::new();
    let Some(run) = shown(evaluator, thing) else { return found };
    let mut path = state.structure.path(document, thing).to_string();
    let drawn = (&Answer::Context(run), Standing::Result);
    walk(document, drawn, &mut path, &mut |answer, standing, path| {
        if standing != Standing::Result || found.len() >= MOST {
            return false;
        }
        match answer {
            Answer::Made(_) | Answer::Thing(_) | Answer::Picture(_) => {
                found.push((path.to_string(), answer.clone()));
                false
            }
            Answer::Context(_) | Answer::List(_) => true,
            Answer::Number(..)
            | Answer::Bool(_)
            | Answer::Option(..)
            | Answer::Text(_)
            | Answer::Function(_) => false,
        }
    });
    found
}

/// Returns the grips of what the programs of a document's things draw, in order.
pub(crate) fn grips(state: &State, evaluator: &Evaluator<'_>) -> Vec<Grip> {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let mut grips = corners(state, evaluator);
    if document.classes.iter().all(|(_, class)| class.program.is_none()) {
        return grips;
    }
    for thing in structure.things.ids().filter(|&t| structure.merged[t] == t) {
        if document.program(structure.things[thing].class).is_none() || is_held(state, thing) {
            continue;
        }
        let Some(run) = shown(evaluator, thing) else { continue };
        let most = grips.len() + MOST;
        let mut path = structure.path(document, thing).to_string();
        let drawn = (&Answer::Context(run), Standing::Result);
        walk(document, drawn, &mut path, &mut |answer, standing, path| {
            let is_seen = standing == Standing::Result && grips.len() < most;
            match place(document, answer).filter(|_| is_seen) {
                Some((x, y)) => {
                    let path = path.into();
                    grips.push(Grip { path, x, y, drawn: true, ..Grip::default() });
                    false
                }
                None => is_seen,
            }
        });
    }
    grips
}

/// Returns the names of the figures that a class declares and computes: `top: Line => …`, and lists of such.
pub(crate) fn declared(document: &Document, class: ClassId) -> Vec<&Name> {
    let is_figure = |class: ClassId| {
        let kind = &document.classes[class].kind;
        let of = if let ClassKind::List(of) = kind { *of } else { class };
        document.classes[of].kind == ClassKind::Composite
    };
    let classes = document.primary_line(class).into_iter();
    // what every thing answers is no part of it
    let classes = classes.filter(|&class| !document.classes[class].supers.is_empty());
    let own = classes.flat_map(|class| &document.classes[class].messages);
    own.filter(|m| m.parameters.is_empty() && !m.is_of_class() && m.class.is_some_and(is_figure))
        .map(|message| &message.name)
        .collect()
}

/// Returns the figures that a thing's class declares, with their paths.
pub(crate) fn figures<'a>(
    state: &State,
    evaluator: &Evaluator<'a>,
    thing: ThingId,
) -> Vec<(String, Answer<'a>)> {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let mut found = Vec::new();
    let mut path = structure.path(document, thing).to_string();
    let end = path.len();
    for name in declared(document, structure.things[thing].class) {
        let Ok(answer) = evaluator.ask(thing, name) else { continue };
        let _ = write!(path, ".{name}");
        walk(document, (&answer, Standing::Result), &mut path, &mut |answer, _, path| {
            if let Answer::Made(_) = answer {
                found.push((path.to_string(), answer.clone()));
            }
            matches!(answer, Answer::List(_))
        });
        path.truncate(end);
    }
    found
}

/// Returns the things whose classes declare figures, in order.
pub(crate) fn declaring(state: &State) -> Vec<ThingId> {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let declares: BTreeSet<ClassId> = { document.classes.ids() }
        .filter(|&class| document.program(class).is_none() && !declared(document, class).is_empty())
        .collect();
    if declares.is_empty() {
        return Vec::new();
    }
    let is_one = |&thing: &ThingId| {
        thing != DOCUMENT
            && structure.merged[thing] == thing
            && declares.contains(&structure.things[thing].class)
    };
    structure.things.ids().filter(is_one).collect()
}

/// Returns the grips of the places that classes declare, where a figure that they declare ends there and nothing else is
/// gripped: the corners of a rectangle.
fn corners(state: &State, evaluator: &Evaluator<'_>) -> Vec<Grip> {
    let document = &state.lowered.document;
    let mut grips = Vec::new();
    for thing in declaring(state).into_iter().take(MOST_DECLARING) {
        if is_held(state, thing) {
            continue;
        }
        let figures = figures(state, evaluator, thing);
        let ends: Vec<(f64, f64)> = { figures.iter() }
            .flat_map(|(_, figure)| match figure {
                Answer::Made(made) => made.fields.as_slice(),
                _ => &[],
            })
            .filter_map(|end| place(document, end))
            .collect();
        let own = state.structure.parts(thing);
        let own = own.filter_map(|part| crate::drag::coordinates(&state.structure, part));
        let number = |slot| evaluator.values.numbers[slot];
        let mut known: Vec<(f64, f64)> =
            own.map(|[(_, x), (_, y)]| (number(x), number(y))).collect();
        for (path, figure) in &figures {
            match place(document, figure) {
                Some(at) if ends.contains(&at) && !known.contains(&at) => {
                    known.push(at);
                    let path = path.clone();
                    grips.push(Grip { path, x: at.0, y: at.1, drawn: true, ..Grip::default() });
                }
                _ => {}
            }
        }
    }
    grips
}

/// Returns true if no parameter can follow.
fn is_held(state: &State, thing: ThingId) -> bool {
    let structure = &state.structure;
    structure.slots_under(thing).into_iter().all(|slot| structure.slots[slot].anchored)
}

/// Returns where a place is that was made.
fn place(document: &Document, answer: &Answer<'_>) -> Option<(f64, f64)> {
    match answer {
        Answer::Made(made) if document.is_place(made.class) => match made.fields[..] {
            [Answer::Number(x, _), Answer::Number(y, _)] => Some((x, y)),
            _ => None,
        },
        _ => None,
    }
}
