//! Grips of what programs draw: its places are dragged, and the program's parameters follow.

use crate::state::State;
use crate::view::Grip;
use eval::{Answer, Evaluator};
use kernel::{ThingId, Values};

/// So many places of what one program draws can be gripped.
const MOST: usize = 200;
/// Deeper than this what is drawn is not looked into.
const DEEPEST: u32 = 16;

/// Returns the grips of what the programs of a document's things draw, in order.
pub(crate) fn grips(state: &State, values: &Values) -> Vec<Grip> {
    let (document, structure) = (&state.lowered.document, &state.structure);
    if document.classes.iter().all(|(_, class)| class.program.is_none()) {
        return Vec::new();
    }
    let evaluator = state.evaluator(values);
    let mut grips = Vec::new();
    for thing in structure.things.ids().filter(|&t| structure.merged[t] == t) {
        if document.program(structure.things[thing].class).is_none() || is_held(state, thing) {
            continue;
        }
        let Ok(Some(run)) = evaluator.run(thing) else { continue };
        let mut finder = Finder { evaluator: &evaluator, found: Vec::new() };
        let mut path = structure.path(document, thing).to_string();
        finder.find(&Answer::Context(run), &mut path, DEEPEST);
        grips.append(&mut finder.found);
    }
    grips
}

/// Returns true if no parameter can follow.
fn is_held(state: &State, thing: ThingId) -> bool {
    let structure = &state.structure;
    structure.slots_under(thing).into_iter().all(|slot| structure.slots[slot].anchored)
}

struct Finder<'e, 'a> {
    evaluator: &'e Evaluator<'a>,
    found: Vec<Grip>,
}

impl Finder<'_, '_> {
    fn find(&mut self, answer: &Answer<'_>, path: &mut String, deep: u32) {
        if self.found.len() >= MOST || deep == 0 {
            return;
        }
        let end = path.len();
        match answer {
            Answer::Made(made) => {
                let document = self.evaluator.document;
                let numbers = made.fields.iter().map(|f| match f {
                    Answer::Number(x, _) => Some(*x),
                    _ => None,
                });
                if let (true, [Some(x), Some(y)]) =
                    (document.is_place(made.class), &numbers.collect::<Vec<_>>()[..])
                {
                    let path = path.clone();
                    return self.found.push(Grip {
                        path,
                        x: *x,
                        y: *y,
                        anchored: false,
                        drawn: true,
                    });
                }
                for (field, answer) in document.layout(made.class).into_iter().zip(&made.fields) {
                    *path += &format!(".{}", document.field_name(field));
                    self.find(answer, path, deep - 1);
                    path.truncate(end);
                }
            }
            Answer::Context(context) => {
                for entry in context.result().filter(|e| !e.name.is_empty()) {
                    *path += &format!(".{}", entry.name);
                    self.find(&entry.answer, path, deep - 1);
                    path.truncate(end);
                }
            }
            Answer::List(items) => {
                for (i, item) in items.iter().enumerate() {
                    *path += &format!("[{i}]");
                    self.find(item, path, deep - 1);
                    path.truncate(end);
                }
            }
            Answer::Number(..)
            | Answer::Bool(_)
            | Answer::Text(_)
            | Answer::Thing(_)
            | Answer::Picture(_)
            | Answer::Function(_) => {}
        }
    }
}
