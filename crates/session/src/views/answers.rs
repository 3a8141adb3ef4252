//! Answers in words: what messages answer, as rows and sentences show it.
//!
//! In: an answer, and the class that is written for it. Out: its words and its unit.

use crate::words;
use base::Name;
use eval::{Answer, Fault};
use kernel::{ClassId, ClassKind, Document, Quantity, Shown};

/// A value in words, and its number if it is one.
pub(super) struct Cell {
    pub(super) words: Shown,
    pub(super) number: Option<f64>,
}

/// Says why something has no value; nothing where that is said of what is missing.
pub(super) fn without_value(fault: &Fault) -> Option<Cell> {
    let text = format!("no value: {}", fault.message);
    (!fault.kind.is_of_missing()).then(|| Cell { words: words::plain(text), number: None })
}

/// Returns the name of the class that is written for what a message answers; empty where none is.
pub(crate) fn answer_class<'d>(document: &'d Document, class: ClassId, name: &Name) -> &'d str {
    class_of_answer(document, class, name).map_or("", |c| &document.classes[c].name)
}

pub(super) fn class_of_answer(document: &Document, class: ClassId, name: &str) -> Option<ClassId> {
    let mut line = document.primary_line(class).into_iter();
    let message = line.find_map(|c| document.classes[c].messages.iter().find(|m| *m.name == *name));
    message.and_then(|m| m.class)
}

/// Returns a plain number in percent.
pub(crate) fn in_percent(document: &Document, x: f64) -> String {
    let quantity = Quantity { written: "%", ..Quantity::default() };
    let shown = kernel::show_quantity(x, quantity, document);
    words::with_unit(shown.text, &shown.unit)
}

/// Returns the class of angles for a step that is one, else none.
pub(super) fn angle_of<'d>(document: &'d Document, turn: ClassId, step: &str) -> &'d str {
    let class = class_of_answer(document, turn, step).map(|c| &*document.classes[c].name);
    class.filter(|class| *class == "Angle").unwrap_or_default()
}

/// Returns the name of the class of a field of what is made; empty where there is none.
pub(super) fn class_of_field<'d>(document: &'d Document, made: ClassId, name: &str) -> &'d str {
    let mut fields = document.layout(made).into_iter();
    let field = fields.find(|&field| **document.field_name(field) == *name);
    field.map_or("", |field| &document.classes[document.field_class(field)].name)
}

/// Returns the name of the class of the numbers in what is listed as of a class; empty where none is.
pub(super) fn element_class(document: &Document, listed: Option<ClassId>) -> &str {
    let mut found = listed;
    while let Some(class) = found {
        match &document.classes[class].kind {
            ClassKind::List(of) | ClassKind::Set(of) => found = Some(*of),
            ClassKind::Primitive(_) => return &document.classes[class].name,
            ClassKind::Composite | ClassKind::Reference(_) => break,
        }
    }
    ""
}

/// Returns the name and the value that a row of a table consists of.
pub(super) fn entry<'r, 'd>(row: &'r Answer<'d>) -> Option<(&'r str, Answer<'d>)> {
    let Answer::List(pair) = row else { return None };
    match &pair[..] {
        [Answer::Text(name), value] => Some((name, value.clone())),
        _ => None,
    }
}

/// Returns an answer of a class in words, and its class; nothing where it is no value.
pub(super) fn show_answer<'d>(
    document: &'d Document,
    answer: &Answer<'d>,
    class: &'d str,
) -> Option<(Cell, &'d str)> {
    let plain = |text: String| Cell { words: words::plain(text), number: None };
    match answer {
        Answer::Number(x, dimension) => {
            let quantity = Quantity { dimension: *dimension, class, written: "" };
            let words = kernel::show_quantity(*x, quantity, document);
            let class = if class.is_empty() { dimension.named().unwrap_or("Real") } else { class };
            Some((Cell { words, number: Some(*x) }, class))
        }
        Answer::Text(t) => Some((plain(t.to_string()), "Text")),
        Answer::Bool(b) => Some((plain(b.to_string()), "Bool")),
        Answer::Option(of, at) => {
            let name = document.option_at(*of, f64::from(*at))?;
            Some((plain(name.to_string()), &document.classes[*of].name))
        }
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
    in_words_as(document, answer, "")
}

/// Returns the same of an answer that is of a class.
pub(crate) fn in_words_as<'d>(
    document: &'d Document,
    answer: &Answer<'d>,
    class: &'d str,
) -> Option<String> {
    let (Cell { words: Shown { text, unit, .. }, .. }, _) = show_answer(document, answer, class)?;
    Some(words::with_unit(text, &unit))
}

/// Returns true for what one row shows.
pub(super) fn is_value(answer: &Answer<'_>) -> bool {
    matches!(answer, Answer::Number(..) | Answer::Text(_) | Answer::Bool(_) | Answer::Option(..))
}
