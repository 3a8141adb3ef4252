//! The catalogue: every construction that is in scope, with the slots that it waits for.
//!
//! Whatever a class answers to itself is a construction, and so is what its things answer by making another of
//! their kind. A new one in a library is a new tool.

use super::Home;
use super::view::ConstructionRow;
use crate::recognise;
use crate::state::State;
use base::Name;
use kernel::{Class, ClassId, ClassKind, Document, Message, Term};

/// A construction, as a tool.
#[derive(Clone, Debug)]
pub(crate) struct Tool {
    /// What it is asked for by: `Circle.tangent(first,second,radius)`.
    pub(crate) id: String,
    /// The class of what it makes.
    pub(crate) class: Name,
    /// `circle tangent`
    pub(crate) label: String,
    /// What the library says of it.
    pub(crate) doc: String,
    /// How it is written.
    pub(crate) call: Call,
    /// What it waits for, in order.
    pub(crate) slots: Vec<Slot>,
}

/// How a construction is written.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Call {
    /// `Circle.tangent(a, b, radius: r)`
    Class(String),
    /// `Line(a, b)`, `Washer(inner: d)`
    Make,
    /// `line.mirrored(about: axis)`: the first slot is what it is sent to.
    Message(String),
}

/// What a construction waits for.
#[derive(Clone, Debug)]
pub(crate) struct Slot {
    /// What it is called.
    pub(crate) name: String,
    /// The label in the text; none where the place tells.
    pub(crate) label: Option<String>,
    /// The class of what is wanted.
    pub(crate) class: Name,
    /// What can fill it.
    pub(crate) kind: SlotKind,
}

/// What can fill a slot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum SlotKind {
    /// A point, or any place of the sheet.
    Point,
    /// A line, circle or arc, which may be turned round.
    Curve,
    /// A number or truth value, typed or measured.
    Value,
}

/// Labels that need no writing: the place of the operand tells.
const BY_PLACE: [&str; 4] = ["first", "second", "third", "curve"];

impl Slot {
    fn of(document: &Document, name: &str, label: Option<String>, class: ClassId) -> Self {
        let found = &document.classes[class];
        let kind = match found.kind {
            ClassKind::Composite if *found.name == *"Point" => SlotKind::Point,
            ClassKind::Composite => SlotKind::Curve,
            _ => SlotKind::Value,
        };
        Self { name: name.into(), label, class: found.name.clone(), kind }
    }
}

impl Tool {
    /// Writes the construction with operands for its first slots.
    pub(crate) fn written(&self, operands: &[String]) -> String {
        let (to, rest) = match &self.call {
            Call::Class(word) => (format!("{}.{word}", self.class), 0),
            Call::Make => (self.class.to_string(), 0),
            Call::Message(word) => {
                let of = operands.first().map_or("", String::as_str);
                let is_path = of.chars().all(|c| c.is_alphanumeric() || "_.[]".contains(c));
                let of = if is_path { of.to_string() } else { format!("({of})") };
                (format!("{of}.{word}"), 1)
            }
        };
        let written = |(slot, operand): (&Slot, &String)| match &slot.label {
            Some(label) => format!("{label}: {operand}"),
            None => operand.clone(),
        };
        let all: Vec<String> = self.slots.iter().zip(operands).skip(rest).map(written).collect();
        format!("{to}({})", all.join(", "))
    }

    /// What the page shows of it.
    pub(crate) fn row(&self) -> ConstructionRow {
        let slots: Vec<&str> = self.slots.iter().map(|slot| slot.name.as_str()).collect();
        ConstructionRow {
            id: self.id.clone(),
            class: self.class.to_string(),
            label: self.label.clone(),
            operands: slots.join(", "),
            doc: self.doc.clone(),
        }
    }
}

/// Returns the constructions in scope, in the order of the classes that they are of.
pub(crate) fn tools(state: &State, home: &Home) -> Vec<Tool> {
    let document = &state.lowered.document;
    let is_last = |id: ClassId, class: &Class| document.class_named(&class.name) == Some(id);
    let mut all = Vec::new();
    for (id, class) in document.classes.iter() {
        if !recognise::is_candidate(state, id, class) || !is_last(id, class) {
            continue;
        }
        if matches!(home, Home::Program { program, .. } if *program == class.name) {
            continue;
        }
        let is_program = document.program(id).is_some();
        if is_program || document.figure(id).is_some() && !matches!(home, Home::Document) {
            all.extend(constructor(document, id, is_program));
        }
        all.extend(class.messages.iter().filter_map(|m| of_message(document, id, m)));
    }
    all
}

/// Finds a construction.
pub(crate) fn tool(state: &State, home: &Home, id: &str) -> Option<Tool> {
    tools(state, home).into_iter().find(|tool| tool.id == id)
}

/// Returns the tool that makes a thing of its parts; of a program, of its parameters.
fn constructor(document: &Document, id: ClassId, is_program: bool) -> Option<Tool> {
    let class = &document.classes[id];
    let name = class.name.to_string();
    let is_by_place = matches!(name.as_str(), "Point" | "Line" | "Axis" | "Arc" | "ClockwiseArc");
    let is_plain = is_by_place || name == "Circle";
    if !is_program && !is_plain {
        return None;
    }
    let slot = |field| {
        let name = document.field_name(field).to_string();
        let label = (!is_by_place).then(|| name.clone());
        Slot::of(document, &name, label, document.field_class(field))
    };
    Some(Tool {
        id: name.clone(),
        class: class.name.clone(),
        label: if is_program { name } else { name.to_lowercase() },
        doc: class.doc.clone(),
        call: Call::Make,
        slots: document.layout(id).into_iter().map(slot).collect(),
    })
}

/// Returns the tool that a message is, if it makes a figure of what it is given.
fn of_message(document: &Document, id: ClassId, message: &Message) -> Option<Tool> {
    let class = &document.classes[id];
    let is_planar = document.lineage(id).iter().any(|&c| *document.classes[c].name == *"Planar");
    if document.figure(id).is_none() && !is_planar {
        return None;
    }
    let word = message.word().to_string();
    let mut slots: Vec<Slot> = Vec::new();
    let call = match message.is_of_class() {
        true => Call::Class(word.clone()),
        false if made_by(message).is_some() => {
            slots.push(Slot::of(document, "what", None, id));
            Call::Message(word.clone())
        }
        false => return None,
    };
    for parameter in &message.parameters {
        let label = parameter.label.to_string();
        let written = (!BY_PLACE.contains(&label.as_str())).then(|| label.clone());
        slots.push(Slot::of(document, &label, written, parameter.class?));
    }
    let separator = if message.is_of_class() { "." } else { ":" };
    let made = made_by(message).filter(|_| !message.is_of_class()).unwrap_or(id);
    Some(Tool {
        id: format!("{}{separator}{}", class.name, message.name),
        class: document.classes[made].name.clone(),
        label: format!("{} {word}", class.name.to_lowercase()),
        doc: message.doc.clone(),
        call,
        slots,
    })
}

/// Returns the class of the new thing that a message answers for what it is given, if it does.
fn made_by(message: &Message) -> Option<ClassId> {
    let mut answer = &message.answer;
    while let Term::Let(_, _, body) = answer {
        answer = body;
    }
    match answer {
        Term::Make { class, .. } if !message.parameters.is_empty() => Some(*class),
        _ => None,
    }
}
