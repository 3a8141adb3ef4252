//! The catalogue: every construction that is in scope, with the slots that it waits for.
//!
//! Whatever a class answers to itself is a construction, and so is what its things answer by making another of
//! their kind. A new one in a library is a new tool.

use super::parameters::{self, Asks};
use super::view::ConstructionRow;
use super::{Home, compound, outcome, synonyms, text};
use crate::offers::words_of;
use crate::recognise;
use crate::state::State;
use base::{Name, Span};
use kernel::{Class, ClassId, ClassKind, Document, Message, PartRef, Primitive, Term};
use std::collections::BTreeSet;
use syntax::ast::{AstNode, Expr, span_without_doc};

/// A construction, as a tool.
#[derive(Clone, Debug)]
pub(crate) struct Tool {
    /// What it is asked for by: `Circle.tangent(first,second,radius)`.
    pub(crate) id: String,
    /// The class of what it makes.
    pub(crate) class: Name,
    /// `Circle that touches two curves`
    pub(crate) label: String,
    /// What what it makes is called, where nothing else is called so.
    pub(crate) base: String,
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
    /// `Washer(inner: d).moved(by: place)`: the last slot is its place. In a document it is a placed thing.
    Placed,
    /// `Terminal(at: place)`: it asks for its place itself. In a document it is a thing.
    Thing,
    /// `line.mirrored(about: axis)`: the first slot is what it is sent to.
    Message(String),
    /// Many of a set, one after the other: the set, how each is led on to the next, how many.
    Pattern(Pattern, First),
    /// The value itself, as it is given.
    Value,
}

/// How the figures of a pattern lie.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Pattern {
    /// Around a point, all the way.
    Polar,
    /// In a row.
    Row,
}

/// Whether the first of a pattern is made with it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum First {
    /// It is made: what the pattern is of is drawn for construction alone.
    Made,
    /// It is there: what the pattern is of is drawn, and is not drawn twice.
    There,
}

impl Pattern {
    fn written(self, first: First, operands: &[String]) -> String {
        let of = |at: usize| operands.get(at).map_or("", String::as_str);
        let (what, by, count) = (bracketed(of(0)), of(1), bracketed(of(2)));
        let one = match self {
            Self::Polar => format!("{what}.turned(about: {by}, by: nth * 360 deg / {count})"),
            Self::Row => {
                let by = bracketed(by);
                format!("{what}.moved(by: Point(nth * {by}.x, nth * {by}.y))")
            }
        };
        format!("({}..{count} - 1).map(nth => {one})", first.written())
    }
}

impl First {
    /// The number of the first that a pattern makes.
    pub(crate) fn written(self) -> &'static str {
        match self {
            Self::Made => "0",
            Self::There => "1",
        }
    }
}

/// A pattern, as a formula says it.
pub(crate) struct Written {
    /// How the figures lie.
    pub(crate) pattern: Pattern,
    /// Whether it makes the first.
    pub(crate) first: First,
    /// Where that is written.
    pub(crate) from: Span,
    /// The set, how each is led on to the next, how many; what is written twice, twice.
    pub(crate) parts: Vec<(&'static str, Expr)>,
}

/// Reads what a pattern is made of, where a formula is one.
pub(crate) fn pattern_of(formula: &Expr) -> Option<Written> {
    let Expr::Field(map) = formula else { return None };
    let Expr::Paren(range) = map.receiver()? else { return None };
    let Expr::Range(range) = range.inner()? else { return None };
    let from = span_without_doc(range.start()?.syntax());
    let Expr::Binary(last) = range.end()? else { return None };
    let Expr::Lambda(each) = map.args()?.args().next()?.value()? else { return None };
    let Expr::Field(one) = each.body()? else { return None };
    let arguments: Vec<Expr> = one.args()?.args().filter_map(|a| a.value()).collect();
    let (what, count) = (one.receiver()?, last.left()?);
    let (pattern, parts) = match (one.name()?.text(), arguments.as_slice()) {
        ("turned", [about, Expr::Binary(by)]) => {
            let parts = vec![
                ("what", what),
                ("about", about.clone()),
                ("count", count),
                ("count", by.right()?),
            ];
            (Pattern::Polar, parts)
        }
        ("moved", [Expr::Call(place)]) => {
            let steps: Vec<Expr> = place.args()?.args().filter_map(|a| a.value()).collect();
            let by = |step: &Expr| match step {
                Expr::Binary(product) => match product.right()? {
                    Expr::Field(part) => part.receiver(),
                    _ => None,
                },
                _ => None,
            };
            let [x, y] = steps.as_slice() else { return None };
            (Pattern::Row, vec![("what", what), ("by", by(x)?), ("by", by(y)?), ("count", count)])
        }
        _ => return None,
    };
    let raw = |slot: &str| {
        let said = parts.iter().find(|(name, _)| *name == slot);
        said.map(|(_, e)| e.syntax().text().to_string())
    };
    let says = |slot: &str| raw(slot).map(|said| unbracketed(&said));
    // what nothing goes on from is written as it is given
    let by = raw("about").or_else(|| says("by"))?;
    let operands = [says("what")?, by, says("count")?];
    let plain = |text: &str| text.split_whitespace().collect::<String>();
    let said = plain(&formula.syntax().text().to_string());
    let is_it = |&first: &First| plain(&pattern.written(first, &operands)) == said;
    let first = [First::Made, First::There].into_iter().find(is_it)?;
    Some(Written { pattern, first, from, parts })
}

/// An expression without the brackets around all of it.
pub(crate) fn unbracketed(text: &str) -> String {
    let text = text.trim();
    let inner = text.strip_prefix('(').and_then(|t| t.strip_suffix(')'));
    inner.filter(|inner| bracketed(inner) == text).unwrap_or(text).into()
}

/// An expression as others can go on from it.
pub(crate) fn bracketed(text: &str) -> String {
    let is_path = |t: &str| t.chars().all(text::is_of_path);
    // `Point(10, 0)`
    let is_call = text.split_once('(').is_some_and(|(head, rest)| {
        is_path(head) && rest.strip_suffix(')').is_some_and(|inner| !inner.contains(['(', ')']))
    });
    let is_list = text.strip_prefix('[').is_some_and(|rest| rest.find(']') == Some(rest.len() - 1));
    if is_path(text) || is_call || is_list { text.into() } else { format!("({text})") }
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
    /// Other classes that are as good.
    also: Vec<Name>,
    /// What can fill it.
    pub(crate) kind: SlotKind,
    /// Whether many values are wanted, one after the other.
    pub(crate) is_list: bool,
    /// The options of the choice that it is one of.
    pub(crate) options: Vec<String>,
    /// What a program asks of it.
    pub(crate) asks: Option<Asks>,
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
    /// A figure of any class that understands the message, or a set of them.
    Set,
    /// Lines and arcs that hang together.
    Edges,
    /// Points, or any places of the sheet, as many as are given.
    Places,
}

/// Labels that need no writing: the place of the operand tells.
const BY_PLACE: [&str; 4] = ["first", "second", "third", "curve"];

impl Slot {
    fn of(document: &Document, name: &str, label: Option<String>, class: ClassId) -> Self {
        let (found, is_list) = match document.classes[class].kind {
            ClassKind::List(element) => (&document.classes[element], true),
            _ => (&document.classes[class], false),
        };
        let kind = match found.kind {
            ClassKind::Composite if is_list && *found.name == *"Edge" => SlotKind::Edges,
            ClassKind::Composite if is_list && *found.name == *"Point" => SlotKind::Places,
            ClassKind::Composite if *found.name == *"Point" => SlotKind::Point,
            ClassKind::Composite => SlotKind::Curve,
            _ => SlotKind::Value,
        };
        let options = match found.kind {
            ClassKind::Primitive(Primitive::Choice(of)) => document.classes[of].options.as_slice(),
            _ => &[],
        };
        // a circle covers its disc
        let discs = document.class_named("Circle").filter(|_| *found.name == *"Planar");
        Self {
            name: name.into(),
            label,
            class: found.name.clone(),
            also: discs.map(|c| document.classes[c].name.clone()).into_iter().collect(),
            is_list: is_list && kind == SlotKind::Value,
            kind,
            options: options.iter().map(Name::to_string).collect(),
            asks: None,
        }
    }

    /// The values that are allowed, where they are few.
    pub(crate) fn choices(&self) -> Vec<String> {
        let allowed = self.asks.as_ref().map_or_else(Vec::new, Asks::choices);
        match *self.class == *"Bool" {
            _ if !allowed.is_empty() => allowed,
            true => vec!["yes".into(), "no".into()],
            false => self.options.clone(),
        }
    }

    /// Whether a figure of a class fills it.
    pub(crate) fn takes(&self, state: &State, class: ClassId) -> bool {
        let document = &state.lowered.document;
        let mut wanted = self.classes().filter_map(|c| document.class_named(c));
        wanted.any(|wanted| document.is_a(class, wanted))
    }

    /// What fills it, in words.
    pub(crate) fn in_words(&self) -> String {
        match (self.kind, self.class.as_str()) {
            (SlotKind::Value, "Integer") => "count".into(),
            (_, "Straight") => "line".into(),
            (_, "Curve") => "line, circle or arc".into(),
            (_, "Round") => "circle or arc".into(),
            (SlotKind::Set, _) => "figure".into(),
            (SlotKind::Edges, _) => "line, arc or curve".into(),
            (_, "Planar") => "contour, surface, region or circle".into(),
            (_, "Outlined") => "contour, surface or region".into(),
            (_, class) => words_of(class),
        }
    }

    /// The classes that fill it.
    pub(crate) fn classes(&self) -> impl Iterator<Item = &Name> {
        std::iter::once(&self.class).chain(&self.also)
    }
}

impl Tool {
    /// Whether what it makes takes the place of its first operand, which is erased: the class of that declares so.
    pub(crate) fn is_in_place(&self, state: &State, home: &Home, of: &str) -> bool {
        let Call::Message(word) = &self.call else { return false };
        let mut found = false;
        outcome::try_all(state, home, &[of.to_string()], &mut |_, evaluator, answer| {
            let class = answer.ok().and_then(|answer| evaluator.class_of(&answer));
            let name = Name::new(word);
            let declared = class.and_then(|c| evaluator.document.find_message(c, &name, None));
            found = declared.is_some_and(|(_, message)| message.is_replacing);
        });
        found
    }

    /// Writes the construction with operands for its first slots.
    pub(crate) fn written(&self, operands: &[String]) -> String {
        let (to, rest) = match &self.call {
            Call::Value => return operands.first().cloned().unwrap_or_default(),
            Call::Pattern(pattern, first) => return pattern.written(*first, operands),
            Call::Class(word) => (format!("{}.{word}", self.class), 0),
            Call::Make | Call::Placed | Call::Thing => (self.class.to_string(), 0),
            Call::Message(word) => {
                let of = operands.first().map_or("", String::as_str);
                (format!("{}.{word}", bracketed(of)), 1)
            }
        };
        let written = |(slot, operand): (&Slot, &String)| match &slot.label {
            Some(label) => format!("{label}: {operand}"),
            None => operand.clone(),
        };
        let mut all: Vec<String> =
            self.slots.iter().zip(operands).skip(rest).map(written).collect();
        let place = match self.call {
            Call::Placed if operands.len() == self.slots.len() => all.pop(),
            _ => None,
        };
        let made = format!("{to}({})", all.join(", "));
        match (place, operands.last()) {
            (Some(_), Some(place)) => format!("{made}.moved(by: {place})"),
            _ => made,
        }
    }

    /// Writes the thing of a document that it makes, by its name, of operands for all of its slots.
    pub(crate) fn thing(&self, name: &str, operands: &[String]) -> String {
        let value = |(slot, operand): (&Slot, &String)| format!("    {} = {operand}", slot.name);
        let values: Vec<String> = self.slots.iter().zip(operands).map(value).collect();
        let placed = if self.call == Call::Placed { "Placed of " } else { "" };
        format!("{name}: {placed}{} {{\n{}\n}}", self.class, values.join("\n"))
    }

    /// Where the page lists it.
    fn shelf(&self) -> String {
        match &self.call {
            Call::Message(_) | Call::Pattern(..) if self.class.is_empty() => "Copy".into(),
            Call::Value if *self.class == *"Real" => "Value".into(),
            _ => self.class.to_string(),
        }
    }

    /// What the page shows of it.
    pub(crate) fn row(&self) -> ConstructionRow {
        let slots: Vec<&str> = self.slots.iter().map(|slot| slot.name.as_str()).collect();
        ConstructionRow {
            id: self.id.clone(),
            class: self.shelf(),
            label: self.label.clone(),
            operands: slots.join(", "),
            doc: self.doc.clone(),
            also: synonyms::of(&self.id),
        }
    }
}

/// Returns the constructions in scope, in the order of the classes that they are of.
pub(crate) fn tools(state: &State, home: &Home) -> Vec<Tool> {
    let document = &state.lowered.document;
    let is_last = |id: ClassId, class: &Class| document.class_named(&class.name) == Some(id);
    let served = serving(state);
    let mut all: Vec<Tool> = Vec::new();
    for (id, class) in document.classes.iter() {
        if !recognise::is_candidate(state, id, class) || !is_last(id, class) {
            continue;
        }
        let is_program = document.program(id).is_some();
        let is_drawn = compound::is_drawn(document, id);
        if is_program && !served.contains(&id) || is_drawn && !matches!(home, Home::Document) {
            let is_placed = is_program && matches!(home, Home::Document);
            let mut tool = constructor(document, id, is_program);
            if let (Some(tool), true) = (&mut tool, is_program) {
                let mut asked = parameters::asked(state, &class.name);
                for slot in &mut tool.slots {
                    let at = asked.iter().position(|(name, _)| *name == slot.name);
                    slot.asks = at.map(|at| asked.swap_remove(at).1);
                }
            }
            if let (Some(tool), true, Some(point)) =
                (&mut tool, is_placed, document.class_named("Point"))
            {
                match recognise::asks_for_its_place(document, id) {
                    true => tool.call = Call::Thing,
                    false => {
                        tool.call = Call::Placed;
                        tool.slots.push(Slot::of(document, "at", None, point));
                    }
                }
            }
            all.extend(tool);
        }
        let own = class.messages.iter().chain(from_above(document, id));
        for tool in own.filter_map(|m| of_message(document, id, m)) {
            match all.iter_mut().find(|known| is_alike(known, &tool)) {
                Some(known) => join(known, tool),
                None => all.push(tool),
            }
        }
    }
    take_compounds(document, &mut all);
    if all.iter().any(|tool| *tool.class == *"Point") {
        let moved = moved(document);
        // one construction moves whatever can be moved
        all.retain(|tool| !moved.as_ref().is_some_and(|moved| is_alike(moved, tool)));
        all.extend(moved);
        all.extend([Pattern::Polar, Pattern::Row].into_iter().filter_map(|p| pattern(document, p)));
    }
    if !matches!(home, Home::Document) {
        all.extend(value(document));
    }
    // what was recorded here is looked for first
    let source = text::Source::now(state);
    let own = |tool: &Tool| {
        matches!(tool.call, Call::Make | Call::Placed | Call::Thing)
            && text::program(&source, &tool.class).is_some()
    };
    all.sort_by_cached_key(|tool| !own(tool));
    all
}

/// The programs of used texts by which constructions of these draw: hands have those.
pub(crate) fn serving(state: &State) -> BTreeSet<ClassId> {
    let document = &state.lowered.document;
    let is_own = |origin| state.lowered.own_span(origin).is_some();
    // what places a program is no construction of a library
    let is_written = |class: &Class| !class.name.starts_with(recognise::PLACED_OF);
    let classes = document.classes.iter().filter(|(_, class)| is_written(class));
    let messages = classes.flat_map(|(_, class)| &class.messages);
    let constructions = messages.filter(|m| m.is_of_class() && !is_own(m.origin));
    let mut made = BTreeSet::new();
    let mut left: Vec<&Term> = constructions.map(|m| &*m.answer).collect();
    while let Some(term) = left.pop() {
        if let Term::Make { class, .. } = term {
            made.insert(*class);
        }
        left.extend(term.operands());
    }
    made.retain(|class| {
        document.program(*class).is_some() && !is_own(document.classes[*class].origin)
    });
    made
}

/// The messages that a class has of abstract ones, which have no things that they could be sent to.
fn from_above(document: &Document, id: ClassId) -> Vec<&Message> {
    let line = document.primary_line(id);
    let above =
        line.iter().enumerate().skip(1).take_while(|(_, c)| document.classes[**c].is_abstract);
    let is_own = |at: usize, m: &Message| {
        let below = line[..at].iter().flat_map(|c| &document.classes[*c].messages);
        { below }.any(|other| other.name == m.name)
    };
    let all = above.flat_map(|(at, c)| {
        let own = document.classes[*c].messages.iter();
        own.filter(move |m| !m.is_of_class() && !is_own(at, m)).collect::<Vec<_>>()
    });
    all.collect()
}

/// Finds a construction.
pub(crate) fn tool(state: &State, home: &Home, id: &str) -> Option<Tool> {
    tools(state, home).into_iter().find(|tool| tool.id == id)
}

/// Whether two messages are one construction for things of several classes: `mirrored(about)`.
fn is_alike(a: &Tool, b: &Tool) -> bool {
    let rest = |tool: &Tool| -> Vec<(String, Name)> {
        tool.slots.iter().skip(1).map(|s| (s.name.clone(), s.class.clone())).collect()
    };
    matches!(&a.call, Call::Message(_)) && a.call == b.call && rest(a) == rest(b)
}

/// Lets a construction take what another takes.
fn join(known: &mut Tool, other: Tool) {
    if known.class != other.class {
        let Call::Message(word) = &known.call else { return };
        known.base = word.clone();
        known.class = Name::new("");
    }
    let (Some(slot), Some(more)) = (known.slots.first_mut(), other.slots.into_iter().next()) else {
        return;
    };
    if !slot.classes().any(|class| *class == more.class) {
        slot.also.push(more.class);
    }
    slot.kind = SlotKind::Set;
}

/// Lets copies take figures that are made of others, where these answer to them.
fn take_compounds(document: &Document, all: &mut [Tool]) {
    let compounds = document.classes.iter();
    let compounds = compounds.filter(|(id, _)| compound::of(document, *id).is_some());
    let compounds = compounds.collect::<Vec<_>>();
    for tool in all {
        let Call::Message(word) = &tool.call else { continue };
        let Some((slot, rest)) = tool.slots.split_first_mut() else { continue };
        let answers = |(id, _): &&(ClassId, &Class)| {
            let labels = rest.len();
            let found = document.find_message(*id, &Name::new(word), None);
            found.is_some_and(|(_, message)| message.parameters.len() == labels)
        };
        let taken = compounds.iter().filter(answers).map(|(_, class)| class.name.clone());
        if slot.kind == SlotKind::Set {
            slot.also.extend(taken);
        }
    }
}

/// Returns the tool that moves a set, or any figure of it.
fn moved(document: &Document) -> Option<Tool> {
    let point = document.class_named("Point")?;
    let slots = [("what", None, point), ("by", Some("by".to_string()), point)];
    let mut slots = slots.map(|(name, label, class)| Slot::of(document, name, label, class));
    slots[0].kind = SlotKind::Set;
    let is_figure = |id: ClassId| compound::is_drawn(document, id) || is_planar(document, id);
    let figures = document.classes.iter().filter(|(id, _)| is_figure(*id));
    slots[0].also = figures.map(|(_, class)| class.name.clone()).collect();
    let doc = "Moved so far to the right and up as a point lies from the origin: all turns of a loop, or \
               what a program drew.";
    Some(Tool {
        id: ":moved(by)".into(),
        class: Name::new(""),
        label: "Moved so far to the right and up".into(),
        // every thing is `moved` by itself: no step can be called so
        base: "shifted".into(),
        doc: doc.into(),
        call: Call::Message("moved".into()),
        slots: slots.into(),
    })
}

/// Whether a class covers a part of the plane.
fn is_planar(document: &Document, id: ClassId) -> bool {
    document.lineage(id).iter().any(|&c| *document.classes[c].name == *"Planar")
}

/// Returns the tool that makes a pattern of a set, or of any figure.
fn pattern(document: &Document, pattern: Pattern) -> Option<Tool> {
    let (point, integer) = (document.class_named("Point")?, document.class_named("Integer")?);
    let figure = moved(document)?.slots.into_iter().next()?;
    let (by, label, doc) = match pattern {
        Pattern::Polar => (
            "about",
            "Polar pattern",
            "So many of a figure, or of a set, evenly around a point; itself is the first.",
        ),
        Pattern::Row => (
            "by",
            "Pattern in a row",
            "So many of a figure, or of a set, itself the first; each lies as far from the one before as a point from the origin.",
        ),
    };
    let slots = vec![
        figure,
        Slot::of(document, by, None, point),
        Slot::of(document, "count", None, integer),
    ];
    Some(Tool {
        id: format!(":pattern({by},count)"),
        class: Name::new(""),
        label: label.into(),
        base: "pattern".into(),
        doc: doc.into(),
        call: Call::Pattern(pattern, First::Made),
        slots,
    })
}

/// Returns the tool that names a value.
fn value(document: &Document) -> Option<Tool> {
    let class = document.class_named("Real")?;
    Some(Tool {
        id: "value".into(),
        class: Name::new("Real"),
        label: "Value by calculator".into(),
        base: "value".into(),
        doc: "A number or a yes or no that later steps speak of.".into(),
        call: Call::Value,
        slots: vec![Slot::of(document, "value", None, class)],
    })
}

/// Returns the tool that makes a thing of its parts; of a program, of its parameters.
fn constructor(document: &Document, id: ClassId, is_program: bool) -> Option<Tool> {
    let class = &document.classes[id];
    let name = class.name.to_string();
    let is_of_places = compound::is_of_places(document, id);
    let is_by_place =
        is_of_places || matches!(name.as_str(), "Point" | "Line" | "Axis" | "Arc" | "ClockwiseArc");
    let is_plain = is_by_place
        || name == "Circle"
        || compound::of(document, id).is_some()
        || compound::is_freeform(document, id);
    if !is_program && !is_plain {
        return None;
    }
    let slot = |field| {
        let name = document.field_name(field).to_string();
        let slot = Slot::of(document, &name, None, document.field_class(field));
        // what comes behind many places is told from them
        let is_plain = is_by_place && !(is_of_places && slot.kind != SlotKind::Places);
        Slot { label: (!is_plain).then_some(name), ..slot }
    };
    // what such a class says itself is not asked for
    let is_asked =
        |f: &PartRef| !is_of_places || !compound::is_given(document, id, document.field_name(*f));
    if name == "Point" {
        // a place is picked, or typed, at once
        return Some(Tool {
            id: name.clone(),
            class: class.name.clone(),
            label: "Point at a place".into(),
            base: small(&name),
            doc: class.doc.clone(),
            call: Call::Value,
            slots: vec![Slot::of(document, "at", None, id)],
        });
    }
    Some(Tool {
        id: name.clone(),
        class: class.name.clone(),
        label: if is_program { name.clone() } else { titled(&class.doc, &name) },
        base: small(&name),
        doc: class.doc.clone(),
        call: Call::Make,
        slots: document.layout(id).into_iter().filter(is_asked).map(slot).collect(),
    })
}

/// Returns the tool that a message is, if it makes a figure of what it is given.
fn of_message(document: &Document, id: ClassId, message: &Message) -> Option<Tool> {
    let class = &document.classes[id];
    let is_drawn = compound::is_drawn(document, id);
    if !is_drawn && !is_planar(document, id) {
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
    let made = document.classes[made].name.clone();
    Some(Tool {
        id: format!("{}{separator}{}", class.name, message.name),
        label: titled(&message.doc, &format!("{} {word}", class.name)),
        base: small(&made),
        class: made,
        doc: message.doc.clone(),
        call,
        slots,
    })
}

/// The first clause of what a library says, as a title; a plain name where it says nothing.
fn titled(doc: &str, plain: &str) -> String {
    let doc = doc.strip_prefix("It, ").unwrap_or(doc);
    let clause = doc.split([':', ';', '.', ',', '\n']).next().unwrap_or_default().trim();
    let clause =
        ["The ", "A ", "An ", "Its "].iter().find_map(|w| clause.strip_prefix(w)).unwrap_or(clause);
    let mut letters = clause.chars();
    match letters.next() {
        Some(first) => first.to_uppercase().chain(letters).collect(),
        None => plain.into(),
    }
}

/// A class's name as that of one of its things: `circle`, `clockwiseArc`.
fn small(class: &str) -> String {
    let mut letters = class.chars();
    letters.next().map_or(String::new(), |first| first.to_lowercase().chain(letters).collect())
}

/// Returns the class of the new thing that a message answers for what it is given, if it does.
fn made_by(message: &Message) -> Option<ClassId> {
    let mut answer = &*message.answer;
    while let Term::Let(_, _, body) = answer {
        answer = body;
    }
    match answer {
        Term::Make { class, .. } if !message.parameters.is_empty() => Some(*class),
        _ => None,
    }
}
