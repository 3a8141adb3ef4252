//! The values view: a row for every value, virtual parts included.

use crate::state::State;
use crate::view::ValueRow;
use crate::words;
use base::Name;
use eval::Answer;
use indexmap::IndexMap;
use kernel::{ClassId, ClassKind, Document, Step, ThingId, Values};

/// Returns the rows, in order of declaration, merged values once.
pub(crate) fn rows(state: &State, values: &Values, status: &plan::Status) -> Vec<ValueRow> {
    let mut rows = Vec::new();
    add(state, values, status, kernel::DOCUMENT, &mut rows);
    rows
}

fn add(
    state: &State,
    values: &Values,
    status: &plan::Status,
    thing: ThingId,
    rows: &mut Vec<ValueRow>,
) {
    let (document, structure) = (&state.lowered.document, &state.structure);
    if structure.merged[thing] != thing {
        return;
    }
    if let Some(slot) = structure.slot_of[thing] {
        let s = &structure.slots[slot];
        let (text, unit) = words::show_slot(state, slot, values);
        rows.push(ValueRow {
            path: structure.path(document, thing).to_string(),
            class: document.classes[structure.things[thing].class].name.to_string(),
            text,
            unit,
            number: s.primitive.is_number().then(|| values.numbers[slot]),
            given: s.given.is_some(),
            is_virtual: false,
            anchored: s.anchored,
            freedom: words::freedom_of(structure, status, thing),
            doc: words::doc_of(state, thing),
        });
        return;
    }
    for part in structure.parts(thing) {
        add(state, values, status, part, rows);
    }
    let class = structure.things[thing].class;
    if document.classes[class].kind == ClassKind::Composite {
        add_virtual(state, values, thing, rows);
    }
}

fn add_virtual(state: &State, values: &Values, thing: ThingId, rows: &mut Vec<ValueRow>) {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let evaluator = state.evaluator(values);
    let path = structure.path(document, thing);
    for (name, doc) in virtual_parts(document, structure.things[thing].class) {
        let (text, unit, number, kind) = match evaluator.ask(thing, name) {
            Ok(Answer::Number(x, dimension)) => {
                let (text, unit) = lang::show_number(x, dimension, document);
                (text, unit, Some(x), dimension.named().unwrap_or("Real"))
            }
            Ok(Answer::Text(t)) => (t.to_string(), String::new(), None, "Text"),
            Ok(Answer::Bool(b)) => (b.to_string(), String::new(), None, "Bool"),
            Ok(
                Answer::Thing(_)
                | Answer::Made(_)
                | Answer::List(_)
                | Answer::Picture(_)
                | Answer::Function(_),
            )
            | Err(_) => continue,
        };
        rows.push(ValueRow {
            path: path.then(Step::Part(name.clone())).to_string(),
            class: kind.into(),
            text,
            unit,
            number,
            given: false,
            is_virtual: true,
            anchored: false,
            freedom: None,
            doc: doc.to_string(),
        });
    }
}

/// Returns the messages that read as values, with what `///` says of them, in order of declaration.
///
/// One that a subclass defines anew stands where it was first declared, once. The picture is no value,
/// whatever it answers.
fn virtual_parts(document: &Document, class: ClassId) -> IndexMap<&Name, &str> {
    let mut found: IndexMap<&Name, &str> = IndexMap::new();
    for class in document.primary_line(class).into_iter().rev() {
        let messages = document.classes[class].messages.iter();
        for message in messages.filter(|m| m.parameters.is_empty() && *m.name != *"picture") {
            let doc = found.entry(&message.name).or_default();
            if !message.doc.is_empty() {
                *doc = &message.doc;
            }
        }
    }
    found
}
