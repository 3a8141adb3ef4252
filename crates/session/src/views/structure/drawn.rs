//! The rows of what is drawn and not stored: of a program its steps, their turns and entities, and the values of these;
//! of the document what it computes, as by a construction.

use super::{Maker, Work};
use crate::session::thing_at;
use crate::state::State;
use crate::view::{RowKind, StructureRow};
use crate::views::{answers, drawn};
use eval::{Answer, Context, Standing};
use kernel::{ClassId, Message, OriginId, Path, Step, ThingId, Values};
use std::collections::BTreeMap;

/// So many rows the run of one program has; what is beyond is reached by its path.
const MOST_ROWS: usize = 1000;
/// So many elements of a list or turns of a loop have rows.
const MOST_TURNS: usize = 100;

/// Returns the rows of what a thing computes at a path, which the tree does not show: the corner of a rectangle. Nothing
/// where nothing is computed there.
pub(crate) fn computed(
    state: &State,
    values: &Values,
    status: &plan::Status,
    path: &Path,
) -> Vec<StructureRow> {
    let evaluator = state.evaluator(values);
    let (Ok(answer), Some((last, whole))) = (evaluator.at(path), path.0.split_last()) else {
        return Vec::new();
    };
    let mut work = Work {
        open: Vec::new(),
        constraints: BTreeMap::new(),
        within: Vec::new(),
        rows: Vec::new(),
    };
    let maker = &mut Maker { state, values, status, work: &mut work };
    let whole = thing_at(state, &Path(whole.to_vec()));
    let class = whole.map(|thing| state.structure.things[thing].class);
    let said = match last {
        Step::Part(name) => class.and_then(|class| maker.message(class, name)),
        Step::Index(_) | Step::Last | Step::Owner => None,
    };
    let (written, name) = (path.to_string(), Path(vec![last.clone()]).to_string());
    let place = Place { path: &written, name, depth: 0, standing: Standing::Result, said };
    maker.entity(&answer, &place, MOST_ROWS);
    work.rows
}

/// Something that was drawn, and where it is.
struct Place<'p> {
    path: &'p str,
    name: String,
    depth: u32,
    standing: Standing,
    /// The message that answers it.
    said: Option<&'p Message>,
}

impl<'m> Maker<'m> {
    /// Adds the rows of what the program of a thing drew; nothing where it has none.
    pub(super) fn add_drawn(&mut self, thing: ThingId, depth: u32) {
        let state = self.state;
        let evaluator = state.evaluator(self.values);
        let Some(run) = drawn::shown(&evaluator, thing) else { return };
        let path = state.structure.path(&state.lowered.document, thing).to_string();
        let most = self.work.rows.len() + MOST_ROWS;
        self.steps(&run, &path, depth, most);
    }

    /// Adds the rows of what the document computes that is drawn with its parts.
    pub(super) fn add_computed(&mut self, depth: u32) {
        let state = self.state;
        let evaluator = state.evaluator(self.values);
        let class = state.structure.things[kernel::DOCUMENT].class;
        for name in evaluator.computed_figures(kernel::DOCUMENT) {
            let path = Path(vec![Step::Part(name.clone())]);
            let answer = evaluator.at(&path);
            // what cannot be made now has a row as well, so that it can be looked at and deleted
            let place = Place {
                path: &name,
                name: name.to_string(),
                depth,
                standing: Standing::Result,
                said: self.message(class, &name),
            };
            let most = self.work.rows.len() + MOST_ROWS;
            match answer {
                Ok(answer) => self.entity(&answer, &place, most),
                Err(fault) => self.failed(&place, &fault.message),
            }
        }
    }

    /// Adds the row of what cannot be made.
    fn failed(&mut self, place: &Place<'_>, why: &str) {
        let origin = place.said.map_or(OriginId(0), |message| message.origin);
        let (path, name) = (place.path.into(), place.name.clone());
        let mut row = self.row(path, place.depth, RowKind::Virtual, name, origin);
        row.detail = why.into();
        self.work.rows.push(row);
    }

    /// Adds the rows of the steps of a program or a turn.
    fn steps(&mut self, context: &Context<'_>, path: &str, depth: u32, most: usize) {
        let is_step =
            |e: &&eval::Entry<'_>| !e.name.is_empty() && !matches!(e.standing, Standing::Carried);
        let steps: Vec<&eval::Entry<'_>> = context.made.iter().filter(is_step).collect();
        for (shown, entry) in steps.iter().enumerate() {
            if self.work.rows.len() >= most {
                return self.add_more(steps.len() - shown, path, depth);
            }
            let own = if path.is_empty() {
                entry.name.to_string()
            } else {
                format!("{path}.{}", entry.name)
            };
            let said = self.message(context.class, &entry.name);
            let place = Place {
                path: &own,
                name: entry.name.to_string(),
                depth,
                standing: entry.standing,
                said,
            };
            self.entity(&entry.answer, &place, most);
        }
    }

    /// Adds the row of what a step made, or a part of that, and those below it.
    fn entity(&mut self, answer: &Answer<'_>, place: &Place<'_>, most: usize) {
        let at = self.work.rows.len();
        let origin = place.said.map(|message| message.origin);
        let mut row = self.row(
            place.path.into(),
            place.depth,
            RowKind::Virtual,
            place.name.clone(),
            OriginId(0),
        );
        row.span = origin.and_then(|origin| self.span(origin));
        row.doc = place.said.map_or_else(String::new, |message| message.doc.clone());
        row.value = self.in_words(answer);
        let what = self.described(answer);
        row.detail = match place.standing {
            Standing::Result | Standing::Carried => what,
            Standing::Guide => format!("{what}, a guide"),
            Standing::Erased => format!("{what}, erased"),
        };
        let is_value = row.value.is_some();
        self.work.rows.push(row);
        let document = &self.state.lowered.document;
        match answer {
            _ if is_value => {}
            Answer::Context(context) => self.steps(context, place.path, place.depth + 1, most),
            Answer::List(items) => {
                for (i, item) in items.iter().enumerate() {
                    if i >= MOST_TURNS || self.work.rows.len() >= most {
                        self.add_more(items.len() - i, place.path, place.depth + 1);
                        break;
                    }
                    let (path, name) = (format!("{}[{i}]", place.path), format!("[{i}]"));
                    let (depth, standing) = (place.depth + 1, Standing::Result);
                    let turn = Place { path: &path, name, depth, standing, said: None };
                    self.entity(item, &turn, most);
                }
            }
            Answer::Made(made) => {
                for (field, part) in document.layout(made.class).into_iter().zip(&made.fields) {
                    let name = document.field_name(field).to_string();
                    let path = format!("{}.{name}", place.path);
                    let (depth, standing) = (place.depth + 1, Standing::Result);
                    let part_of = Place { path: &path, name, depth, standing, said: None };
                    self.entity(part, &part_of, most);
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
        self.work.rows[at].descendants = (self.work.rows.len() - at - 1) as u32;
    }

    /// Adds the row that says how many more there are; it leads to what they are in.
    fn add_more(&mut self, more: usize, path: &str, depth: u32) {
        let name = format!("… {more} more");
        let row = self.row(path.into(), depth, RowKind::Virtual, name, OriginId(0));
        self.work.rows.push(row);
    }

    fn message(&self, class: ClassId, name: &base::Name) -> Option<&'m Message> {
        let state: &'m State = self.state;
        state.lowered.document.find_message(class, name, None).map(|(_, message)| message)
    }

    /// Returns a value, or a place, as a person reads it.
    fn in_words(&self, answer: &Answer<'_>) -> Option<String> {
        let document = &self.state.lowered.document;
        match answer {
            Answer::Made(made) if document.is_place(made.class) => {
                let parts = made.fields.iter().map(|part| answers::in_words(document, part));
                Some(format!("({})", parts.collect::<Option<Vec<_>>>()?.join(", ")))
            }
            other => answers::in_words(document, other),
        }
    }

    /// Says what something is.
    fn described(&self, answer: &Answer<'_>) -> String {
        let document = &self.state.lowered.document;
        let class = |class: ClassId| document.classes[document.named_class(class)].name.to_string();
        match answer {
            Answer::Made(made) => class(made.class),
            Answer::Context(context) if document.program(context.class).is_some() => {
                class(context.class)
            }
            Answer::Context(_) => "a turn".into(),
            Answer::List(items) if items.iter().all(|i| matches!(i, Answer::Context(_))) => {
                match items.len() {
                    1 => "1 turn".into(),
                    n => format!("{n} turns"),
                }
            }
            Answer::List(items) => format!("a list of {}", items.len()),
            Answer::Thing(thing) => crate::words::class_name(self.state, *thing),
            Answer::Number(_, dimension) => dimension.named().unwrap_or("Real").into(),
            Answer::Option(of, _) => class(*of),
            other @ (Answer::Bool(_)
            | Answer::Text(_)
            | Answer::Picture(_)
            | Answer::Function(_)) => other.kind().into(),
        }
    }
}
