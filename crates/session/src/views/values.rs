//! The values view: a row for every value, virtual parts included.

use crate::state::State;
use crate::view::ValueRow;
use crate::words;
use base::Name;
use eval::{Answer, Evaluator};
use indexmap::IndexMap;
use kernel::builtin::{FUNCTIONS, Kind, PICTURE_MESSAGES, find};
use kernel::{ClassId, ClassKind, Document, Path, SlotId, Step, Term, ThingId, Values};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::rc::Rc;

/// Of what a program drew at most this many values are shown; what is beyond is reached by its path.
const MOST_DRAWN: usize = 1000;
/// Deeper than this what is drawn is not looked into.
const LONGEST_PATH: usize = 1000;

/// Returns the rows, in order of declaration, merged values once.
pub(crate) fn rows(state: &State, values: &Values, status: &plan::Status) -> Vec<ValueRow> {
    let evaluator = state.evaluator(values);
    let mut maker = Maker {
        state,
        values,
        status,
        evaluator,
        virtual_parts: BTreeMap::new(),
        open: Vec::new(),
        rows: Vec::new(),
    };
    maker.add(kernel::DOCUMENT, &mut String::new());
    maker.rows
}

/// Brings rows up to date with other values of the same state. Cost: that of these rows alone.
pub(crate) fn renew<'r>(
    state: &State,
    values: &Values,
    rows: impl Iterator<Item = &'r mut ValueRow>,
) {
    let evaluator = state.evaluator(values);
    for row in rows {
        let Some(path) = crate::session::parse_path(&row.path) else { continue };
        let shown = match path.0.split_last() {
            Some((Step::Part(name), owner)) if row.is_virtual => {
                match crate::session::thing_at(state, &Path(owner.to_vec())) {
                    Some(owner) => show_virtual(state, &evaluator, owner, name),
                    // of what a program drew
                    None => {
                        let answer = evaluator.at(&path).ok();
                        answer.and_then(|a| show_answer(&state.lowered.document, &a)).map(|s| s.0)
                    }
                }
            }
            _ => crate::session::thing_at(state, &path)
                .and_then(|thing| state.structure.slot_of(thing))
                .map(|slot| show(state, values, slot)),
        };
        if let Some(shown) = shown {
            (row.text, row.unit, row.number) = (shown.text, shown.unit, shown.number);
        }
    }
}

/// A value in words.
struct Shown {
    text: String,
    unit: String,
    number: Option<f64>,
}

fn show(state: &State, values: &Values, slot: SlotId) -> Shown {
    let (text, unit) = words::show_slot(state, slot, values);
    let is_number = state.structure.slots[slot].primitive.is_number();
    Shown { text, unit, number: is_number.then(|| values.numbers[slot]) }
}

fn show_virtual(
    state: &State,
    evaluator: &Evaluator<'_>,
    owner: ThingId,
    name: &Name,
) -> Option<Shown> {
    let document = &state.lowered.document;
    let answer = evaluator.ask(owner, name).or_else(|fault| {
        let table = evaluator.ask(owner, &Name::new("values"))?;
        let Answer::List(items) = table else { return Err(fault) };
        let named = items.iter().filter_map(entry).find(|(n, _)| **n == **name);
        named.map(|(_, value)| value).ok_or(fault)
    });
    show_answer(document, &answer.ok()?).map(|shown| shown.0)
}

/// Returns the name and the value that a row of a table consists of.
fn entry<'r, 'd>(row: &'r Answer<'d>) -> Option<(&'r str, Answer<'d>)> {
    let Answer::List(pair) = row else { return None };
    match &pair[..] {
        [Answer::Text(name), value] => Some((name, value.clone())),
        _ => None,
    }
}

/// Returns an answer in words, and its class; nothing where it is no value.
fn show_answer<'d>(document: &Document, answer: &Answer<'d>) -> Option<(Shown, &'d str)> {
    let plain = |text: String| Shown { text, unit: String::new(), number: None };
    match answer {
        Answer::Number(x, dimension) => {
            let (text, unit) = lang::show_number(*x, *dimension, document);
            let class = dimension.named().unwrap_or("Real");
            Some((Shown { text, unit, number: Some(*x) }, class))
        }
        Answer::Text(t) => Some((plain(t.to_string()), "Text")),
        Answer::Bool(b) => Some((plain(b.to_string()), "Bool")),
        Answer::Thing(_)
        | Answer::Made(_)
        | Answer::Context(_)
        | Answer::List(_)
        | Answer::Picture(_)
        | Answer::Function(_) => None,
    }
}

/// Returns an answer with its unit, as a person reads it; nothing where it is no value.
pub(crate) fn in_words(document: &Document, answer: &Answer<'_>) -> Option<String> {
    let (Shown { text, unit, .. }, _) = show_answer(document, answer)?;
    Some(words::with_unit(text, &unit))
}

struct Maker<'a> {
    state: &'a State,
    values: &'a Values,
    status: &'a plan::Status,
    evaluator: Evaluator<'a>,
    /// The virtual parts of every class met so far.
    virtual_parts: BTreeMap<ClassId, Rc<[(Name, String)]>>,
    /// The things whose rows are being added: what a class says may lead back to them.
    open: Vec<ThingId>,
    rows: Vec<ValueRow>,
}

impl Maker<'_> {
    /// Adds the rows of a thing; `path` leads there, and does so again afterwards.
    fn add(&mut self, thing: ThingId, path: &mut String) {
        let state = self.state;
        let (document, structure) = (&state.lowered.document, &state.structure);
        if structure.merged[thing] != thing {
            return;
        }
        if let Some(slot) = structure.slot_of(thing) {
            let s = &structure.slots[slot];
            let Shown { text, unit, number } = show(state, self.values, slot);
            self.rows.push(ValueRow {
                path: path.clone(),
                class: document.classes[structure.things[thing].class].name.to_string(),
                text,
                unit,
                number,
                given: s.given.is_some(),
                is_virtual: false,
                anchored: s.anchored,
                freedom: words::freedom_of(structure, self.status, thing),
                doc: words::doc_of(state, thing),
            });
            return;
        }
        if self.open.contains(&thing) {
            return;
        }
        self.open.push(thing);
        if crate::general::defines(state, thing, "values") {
            self.add_table(thing, path);
        } else {
            self.add_parts(thing, path);
        }
        self.open.pop();
    }

    /// Adds the rows of a thing's parts and of what it answers.
    fn add_parts(&mut self, thing: ThingId, path: &mut String) {
        let (document, structure) = (&self.state.lowered.document, &self.state.structure);
        let end = path.len();
        for part in structure.parts(thing) {
            match structure.field_name(document, part) {
                Some(name) => append(path, name),
                None => {
                    let _ = write!(path, "[{}]", structure.things[part].field);
                }
            }
            self.add(part, path);
            path.truncate(end);
        }
        if document.classes[structure.things[thing].class].kind == ClassKind::Composite {
            self.add_virtual(thing, path);
        }
    }

    /// Adds the rows that a thing's class says: parts and messages by name, or names with values.
    fn add_table(&mut self, thing: ThingId, path: &mut String) {
        let document = &self.state.lowered.document;
        let structure = &self.state.structure;
        let end = path.len();
        let Ok(Answer::List(items)) = self.evaluator.ask(thing, &Name::new("values")) else {
            return;
        };
        for item in items.iter() {
            let (name, value) = match item {
                Answer::Text(name) => match structure.part_named(thing, name) {
                    Some(part) => {
                        append(path, name);
                        self.add(part, path);
                        path.truncate(end);
                        continue;
                    }
                    None => (name.to_string(), self.evaluator.ask(thing, &Name::new(name)).ok()),
                },
                Answer::Thing(part) => {
                    let mut to = structure.path(document, *part).to_string();
                    self.add(*part, &mut to);
                    continue;
                }
                pair => match entry(pair) {
                    Some((name, value)) => (name.to_string(), Some(value)),
                    None => continue,
                },
            };
            append(path, &name);
            self.rows.extend(value.and_then(|v| answered(document, path, &v, "")));
            path.truncate(end);
        }
    }

    fn add_virtual(&mut self, thing: ThingId, path: &mut String) {
        let document = &self.state.lowered.document;
        let class = self.state.structure.things[thing].class;
        let parts =
            self.virtual_parts.entry(class).or_insert_with(|| virtual_parts(document, class));
        let end = path.len();
        let draws = document.program(class).is_some();
        let most = self.rows.len() + MOST_DRAWN;
        for (name, doc) in parts.clone().iter() {
            let Ok(answer) = self.evaluator.ask(thing, name) else { continue };
            append(path, name);
            match answered(document, path, &answer, doc) {
                None if draws => self.add_drawn(&answer, path, most),
                row => self.rows.extend(row),
            }
            path.truncate(end);
        }
    }

    /// Adds the rows of what a program drew: the numbers of its figures, turn by turn.
    fn add_drawn(&mut self, answer: &Answer<'_>, path: &mut String, most: usize) {
        let document = &self.state.lowered.document;
        if self.rows.len() >= most || path.len() > LONGEST_PATH {
            return;
        }
        if let Some(row) = answered(document, path, answer, "") {
            return self.rows.push(row);
        }
        let end = path.len();
        match answer {
            Answer::Made(made) => {
                for (field, answer) in document.layout(made.class).into_iter().zip(&made.fields) {
                    append(path, document.field_name(field));
                    self.add_drawn(answer, path, most);
                    path.truncate(end);
                }
            }
            Answer::Context(context) => {
                for entry in context.made.iter().filter(|e| !e.name.is_empty()) {
                    append(path, &entry.name);
                    self.add_drawn(&entry.answer, path, most);
                    path.truncate(end);
                }
            }
            Answer::List(items) => {
                for (i, item) in items.iter().enumerate() {
                    let _ = write!(path, "[{i}]");
                    self.add_drawn(item, path, most);
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

/// Returns the row of what a thing answers; nothing where that is no value.
fn answered(document: &Document, path: &str, answer: &Answer<'_>, doc: &str) -> Option<ValueRow> {
    let (shown, class) = show_answer(document, answer)?;
    Some(ValueRow {
        path: path.into(),
        class: class.into(),
        text: shown.text,
        unit: shown.unit,
        number: shown.number,
        given: false,
        is_virtual: true,
        anchored: false,
        freedom: None,
        doc: doc.into(),
    })
}

/// Adds a step to the part of this name.
fn append(path: &mut String, name: &str) {
    if !path.is_empty() {
        path.push('.');
    }
    path.push_str(name);
}

/// Returns the messages that read as values, with what `///` says of them, in order of declaration.
///
/// One that a subclass defines anew stands where it was first declared, once. What the lab shows in
/// views of its own is no value, whatever it answers, and a picture is none.
fn virtual_parts(document: &Document, class: ClassId) -> Rc<[(Name, String)]> {
    let mut found: IndexMap<&Name, (&str, bool)> = IndexMap::new();
    for class in document.primary_line(class).into_iter().rev() {
        if document.classes[class].supers.is_empty() {
            continue;
        }
        let messages = document.classes[class].messages.iter();
        for message in
            messages.filter(|m| m.parameters.is_empty() && !m.is_of_class() && !is_view(&m.name))
        {
            let (doc, is_drawn) = found.entry(&message.name).or_default();
            if !message.doc.is_empty() {
                *doc = &message.doc;
            }
            *is_drawn = is_picture(&message.answer);
        }
    }
    let read = found.into_iter().filter(|(_, (_, is_drawn))| !is_drawn);
    read.map(|(name, (doc, _))| (name.clone(), doc.to_string())).collect()
}

/// Returns true if a term answers a picture, whatever it is asked of.
fn is_picture(term: &Term) -> bool {
    match term {
        Term::Call { name, .. } => {
            find(FUNCTIONS, name).is_some_and(|function| function.result == Kind::Picture)
        }
        Term::Send { to, name, .. } => is_picture(to) && find(PICTURE_MESSAGES, name).is_some(),
        Term::If(_, a, b) => is_picture(a) && is_picture(b),
        Term::Let(_, _, term) => is_picture(term),
        _ => false,
    }
}

fn is_view(name: &Name) -> bool {
    matches!(name.as_str(), "picture" | "structure" | "values")
}
