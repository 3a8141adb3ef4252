//! The values view: a row for every value, virtual parts included.

use crate::doubts;
use crate::state::State;
use crate::view::ValueRow;
use crate::views::answers::{
    Cell, angle_of, answer_class, class_of_answer, class_of_field, element_class, entry, is_value,
    show_answer, without_value,
};
use crate::views::drawn::walk;
use crate::words;
use base::Name;
use eval::{Answer, Evaluator, Fault, Standing};
use indexmap::IndexMap;
use kernel::builtin::{FUNCTIONS, Kind, PICTURE_MESSAGES, find};
use kernel::program::{Allowed, Bound};
use kernel::{
    ClassId, ClassKind, Document, Message, Path, Primitive, Quantity, Shown, SlotId, Step, Term,
    ThingId, Values,
};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::rc::Rc;

/// So many things are listed before what is to be kept of their rows is asked.
const PORTION: usize = 1000;
/// Of what a program drew at most this many values are shown; what is beyond is reached by its path.
const MOST_DRAWN: usize = 1000;

/// Returns the rows, in order of declaration, merged values once.
pub(crate) fn rows(state: &State, values: &Values, status: &plan::Status) -> Vec<ValueRow> {
    let mut work = Work::default();
    work.go_on((state, values, status), &mut || true);
    work.rows
}

/// Tells of the rows one by one. Of large documents all would take more room than these themselves.
pub(crate) fn each_row(
    (state, values, status): (&State, &Values, &plan::Status),
    tell: &mut dyn FnMut(ValueRow),
) {
    let mut work = Work::default();
    loop {
        let mut left = PORTION;
        let mut has_time = || {
            left -= 1;
            left > 0
        };
        let is_over = work.go_on((state, values, status), &mut has_time);
        work.rows.drain(..).for_each(&mut *tell);
        if is_over {
            return;
        }
    }
}

/// What is done and left to do of the rows.
pub(crate) struct Work {
    /// What is still to be added, the next last.
    open: Vec<Open>,
    /// The virtual parts of every class met so far.
    virtual_parts: BTreeMap<ClassId, Rc<[Answers]>>,
    /// The things whose rows are being added: what a class says may lead back to them.
    within: Vec<ThingId>,
    /// The rows so far.
    pub(crate) rows: Vec<ValueRow>,
}

/// What is to be added, with the path that leads there.
enum Open {
    Thing(ThingId, String),
    /// What a thing answers, after its parts.
    Answers(ThingId, String),
    /// A row that is made already.
    Row(Box<ValueRow>),
    /// All of the innermost thing is added.
    Shut,
}

impl Default for Work {
    fn default() -> Self {
        Self {
            open: vec![Open::Thing(kernel::DOCUMENT, String::new())],
            virtual_parts: BTreeMap::new(),
            within: Vec::new(),
            rows: Vec::new(),
        }
    }
}

impl Work {
    /// Goes on while there is time; returns true at the end.
    pub(crate) fn go_on(
        &mut self,
        (state, values, status): (&State, &Values, &plan::Status),
        has_time: &mut dyn FnMut() -> bool,
    ) -> bool {
        let evaluator = state.evaluator(values);
        let mut maker = Maker { state, values, status, evaluator, work: self };
        while let Some(next) = maker.work.open.pop() {
            match next {
                Open::Thing(thing, path) => maker.add(thing, path),
                Open::Answers(thing, path) => maker.add_virtual(thing, path),
                Open::Row(row) => maker.work.rows.push(*row),
                Open::Shut => drop(maker.work.within.pop()),
            }
            if !has_time() {
                return maker.work.open.is_empty();
            }
        }
        true
    }
}

/// Brings rows up to date with other values of the same state. Cost: that of these rows alone.
pub(crate) fn renew<'r>(
    state: &State,
    values: &Values,
    rows: impl Iterator<Item = &'r mut ValueRow>,
) {
    let evaluator = state.evaluator(values);
    let mut last = None;
    for row in rows {
        let Some(path) = crate::session::parse_path(&row.path) else { continue };
        let shown = match row.is_virtual {
            true => renewed(state, &evaluator, &path, &mut last),
            false => crate::session::thing_at(state, &path)
                .and_then(|thing| state.structure.slot_of(thing))
                .map(|slot| show(state, values, slot)),
        };
        if let Some(shown) = shown {
            let Shown { text, unit, exact } = shown.words;
            (row.text, row.unit, row.exact, row.number) = (text, unit, exact, shown.number);
        }
    }
}

/// What a thing answered, whose elements are shown one after the other.
type Asked<'a> = Option<((ThingId, Name), Result<Answer<'a>, Fault>)>;

/// Shows what a thing answers, or a value in it: of a list, or of what a program drew. `last` is asked once for all rows
/// in it.
fn renewed<'a>(
    state: &'a State,
    evaluator: &Evaluator<'a>,
    path: &Path,
    last: &mut Asked<'a>,
) -> Option<Cell> {
    let document = &state.lowered.document;
    let at = |end: usize| crate::session::thing_at(state, &Path(path.0[..end].to_vec()));
    let (end, owner) = (0..path.0.len()).rev().find_map(|end| Some((end, at(end)?)))?;
    let Step::Part(name) = &path.0[end] else { return None };
    let within = &path.0[end + 1..];
    if within.is_empty() {
        return show_virtual(state, evaluator, owner, name);
    }
    let asked = (owner, name.clone());
    if last.as_ref().is_none_or(|(known, _)| *known != asked) {
        *last = Some((asked, evaluator.ask(owner, name)));
    }
    let (_, answer) = last.as_ref()?;
    let (step, around) = within.split_last()?;
    let around = answer.clone().and_then(|answer| evaluator.from(answer, around));
    let of_step = match (&around, step) {
        (Ok(Answer::Context(turn)), Step::Part(step)) => angle_of(document, turn.class, step),
        (Ok(Answer::Made(made)), Step::Part(step)) => class_of_field(document, made.class, step),
        _ => "",
    };
    let value = around.and_then(|around| evaluator.from(around, std::slice::from_ref(step)));
    match value {
        Ok(value) => {
            let class = state.structure.things[owner].class;
            let class = match of_step {
                "" => element_class(document, class_of_answer(document, class, name)),
                known => known,
            };
            show_answer(document, &value, class).map(|shown| shown.0)
        }
        Err(fault) => without_value(&fault),
    }
}

fn show(state: &State, values: &Values, slot: SlotId) -> Cell {
    let is_number = match state.structure.slots[slot].primitive {
        Primitive::Real(_) | Primitive::Integer => true,
        Primitive::Bool | Primitive::Choice(_) | Primitive::Text | Primitive::Color => false,
    };
    let number = is_number.then(|| values.numbers[slot]);
    Cell { words: words::show_slot(state, slot, values), number }
}

fn show_virtual(
    state: &State,
    evaluator: &Evaluator<'_>,
    owner: ThingId,
    name: &Name,
) -> Option<Cell> {
    let document = &state.lowered.document;
    let class = answer_class(document, state.structure.things[owner].class, name);
    let answer = evaluator.ask(owner, name).or_else(|fault| {
        let table = evaluator.ask(owner, &Name::new("values"))?;
        let Answer::List(items) = table else { return Err(fault) };
        let named = items.iter().filter_map(entry).find(|(n, _)| **n == **name);
        named.map(|(_, value)| value).ok_or(fault)
    });
    match answer {
        Ok(answer) => show_answer(document, &answer, class).map(|shown| shown.0),
        Err(fault) => without_value(&fault),
    }
}

/// Returns true for what belongs to a text that is used: a constant of a library, `constants.c`.
pub(crate) fn is_of_library(state: &State, path: &str) -> bool {
    let first = path.split('.').next().unwrap_or_default();
    let mut used = state.lowered.files.iter().map(|(_, file)| file).filter(|f| !f.is_table());
    !first.is_empty() && used.any(|file| file.name.rsplit('.').next() == Some(first))
}

struct Maker<'a> {
    state: &'a State,
    values: &'a Values,
    status: &'a plan::Status,
    evaluator: Evaluator<'a>,
    work: &'a mut Work,
}

impl<'a> Maker<'a> {
    /// Adds the row of a value; of anything else what it is made of is to be added next.
    fn add(&mut self, thing: ThingId, path: String) {
        let state = self.state;
        let (document, structure) = (&state.lowered.document, &state.structure);
        if structure.merged[thing] != thing && !structure.adds(document, thing) {
            return;
        }
        if let Some(slot) = structure.slot_of(thing) {
            let s = &structure.slots[slot];
            let Cell { words: Shown { text, unit, exact }, number } =
                show(state, self.values, slot);
            let is_of_library = is_of_library(state, &path);
            let options = match options(document, s.primitive) {
                none if none.is_empty() => self.asked_options(thing, (&text, &unit)),
                known => known,
            };
            self.work.rows.push(ValueRow {
                path,
                shortest: shortest_path(state, thing),
                class: document.classes[structure.things[thing].class].name.to_string(),
                text,
                unit,
                exact,
                number,
                options,
                given: s.given.is_some(),
                is_virtual: false,
                anchored: s.anchored,
                is_layout: s.is_layout || s.anchored && is_of_library,
                freedom: words::freedom_of(structure, self.status, thing),
                doc: words::doc_of(state, thing),
                range: self.asked_range(thing),
            });
            return;
        }
        if self.work.within.contains(&thing) {
            return;
        }
        self.work.within.push(thing);
        self.work.open.push(Open::Shut);
        let from = self.work.open.len();
        if crate::general::defines(state, thing, "values") {
            self.open_table(thing, path);
        } else {
            self.open_parts(thing, path);
        }
        self.work.open[from..].reverse();
    }

    /// What a program allows of the parameter that a thing is, and whose that is.
    fn asked(&self, thing: ThingId) -> Option<(&'a Allowed, ThingId)> {
        let state: &'a State = self.state;
        let (document, structure) = (&state.lowered.document, &state.structure);
        let owner = structure.things[thing].owner?;
        let program = document.program(structure.things[owner].class)?;
        let name = structure.field_name(document, thing)?;
        let asked = program.parameters.iter().find(|asked| asked.name == *name)?;
        Some((asked.allowed.as_ref()?, owner))
    }

    /// Lists the values of the table that a program allows of the parameter that a thing is, in a unit; none where
    /// they are of other units, or the value itself is not among them.
    fn asked_options(&self, thing: ThingId, (text, unit): (&str, &str)) -> Vec<String> {
        let document = &self.state.lowered.document;
        let Some((Allowed::OneOf(values), owner)) = self.asked(thing) else { return Vec::new() };
        let class = &document.classes[self.state.structure.things[thing].class].name;
        let one = |term: &'a Term| match self.evaluator.evaluate(term, owner).ok()? {
            Answer::Number(x, dimension) => {
                let quantity = Quantity { dimension, class, written: "" };
                let shown = kernel::show_quantity(x, quantity, document);
                (shown.unit == unit).then_some(shown.text)
            }
            Answer::Text(text) => Some(text.to_string()),
            _ => None,
        };
        let all: Option<Vec<String>> = values.iter().map(one).collect();
        all.filter(|all| all.iter().any(|known| known == text)).unwrap_or_default()
    }

    /// Returns the range that a program gives the parameter that a thing is, or a class the whole number.
    fn asked_range(&self, thing: ThingId) -> Option<(Option<f64>, Option<f64>)> {
        let slot = self.state.structure.slot_of(thing)?;
        if let Some(&(least, most)) = self.state.structure.ranges.get(&slot) {
            return Some((Some(least as f64), Some(most as f64)));
        }
        let (Allowed::Range { least, most }, owner) = self.asked(thing)? else {
            return None;
        };
        let end =
            |bound: &'a Option<Bound>| match self.evaluator.evaluate(&bound.as_ref()?.value, owner)
            {
                Ok(Answer::Number(x, _)) => Some(x),
                _ => None,
            };
        Some((end(least), end(most)))
    }

    /// Opens a thing's parts and what it answers, in order.
    fn open_parts(&mut self, thing: ThingId, mut path: String) {
        let (document, structure) = (&self.state.lowered.document, &self.state.structure);
        let end = path.len();
        for part in structure.parts(thing).filter(|&p| !structure.is_unseen(document, p)) {
            append_field(self.state, part, &mut path);
            self.work.open.push(Open::Thing(part, path.clone()));
            path.truncate(end);
        }
        if document.classes[structure.things[thing].class].kind == ClassKind::Composite {
            self.work.open.push(Open::Answers(thing, path));
        }
    }

    /// Opens what a thing's class says, in order: parts and messages by name, or names with values.
    fn open_table(&mut self, thing: ThingId, mut path: String) {
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
                        append(&mut path, name);
                        self.work.open.push(Open::Thing(part, path.clone()));
                        path.truncate(end);
                        continue;
                    }
                    None => (name.to_string(), self.evaluator.ask(thing, &Name::new(name)).ok()),
                },
                Answer::Thing(part) => {
                    let to = structure.path(document, *part).to_string();
                    self.work.open.push(Open::Thing(*part, to));
                    continue;
                }
                pair => match entry(pair) {
                    Some((name, value)) => (name.to_string(), Some(value)),
                    None => continue,
                },
            };
            append(&mut path, &name);
            let row = value.and_then(|v| answered(document, &path, &v, ["", ""], false));
            self.work.open.extend(row.map(Box::new).map(Open::Row));
            path.truncate(end);
        }
    }

    fn add_virtual(&mut self, thing: ThingId, mut path: String) {
        let document = &self.state.lowered.document;
        let class = self.state.structure.things[thing].class;
        let parts =
            self.work.virtual_parts.entry(class).or_insert_with(|| virtual_parts(document, class));
        let end = path.len();
        let draws = document.program(class).is_some();
        let most = self.work.rows.len() + MOST_DRAWN;
        let (first, definer) = (self.state.structure.merged[thing], |class, name: &Name| {
            document.find_message(class, name, None).map(|(definer, _)| definer)
        });
        let first = (first != thing).then(|| self.state.structure.things[first].class);
        for Answers { name, doc, is_pictured, class: written } in parts.clone().iter() {
            // what it answers alike is told of what is declared before it
            if first.is_some_and(|first| definer(first, name) == definer(class, name)) {
                continue;
            }
            let (answer, read) = self.evaluator.listening(|| self.evaluator.ask(thing, name));
            let slots = &self.state.structure.slots;
            let is_layout = read.iter().all(|&slot| slots[slot].is_layout)
                && (*is_pictured || !read.is_empty());
            append(&mut path, name);
            let said = [written.map_or("", |c| &document.classes[c].name), doc.as_str()];
            match answer {
                Ok(answer) if doubts::is_none(name, &answer) => {}
                Ok(answer) => match answered(document, &path, &answer, said, is_layout) {
                    None if draws => self.add_drawn(&answer, &mut path, most),
                    None if is_table(&answer, thing) => {
                        self.add_each(
                            &answer,
                            &mut path,
                            [element_class(document, *written), doc],
                            is_layout,
                        );
                    }
                    row => self.work.rows.extend(row),
                },
                // what another branch would have drawn is not missing
                Err(_) if draws => {}
                Err(fault) => {
                    let cell = without_value(&fault);
                    let row = cell.map(|cell| row_of(&path, cell, said, is_layout));
                    self.work.rows.extend(row);
                }
            }
            path.truncate(end);
        }
    }

    /// Adds the rows of the values that a list or a figure consists of, and how many there are beyond.
    fn add_each(
        &mut self,
        answer: &Answer<'_>,
        path: &mut String,
        [class, doc]: [&str; 2],
        is_layout: bool,
    ) {
        let (document, rows) = (&self.state.lowered.document, &mut self.work.rows);
        let most = rows.len() + MOST_DRAWN;
        let mut beyond = 0;
        // the figures around what is visited, each with where its path ends
        let mut figures: Vec<(usize, ClassId)> = Vec::new();
        walk(document, (answer, Standing::Result), path, &mut |answer, _, path| {
            while figures.pop_if(|(end, _)| *end >= path.len()).is_some() {}
            if let Answer::Made(made) = answer {
                figures.push((path.len(), made.class));
            }
            if rows.len() >= most {
                let is_value = is_value(answer);
                beyond += usize::from(is_value);
                return !is_value;
            }
            let of = match (answer, figures.last()) {
                (Answer::Number(..), None) => class,
                (Answer::Number(..), Some(&(end, made))) => {
                    class_of_field(document, made, path[end..].trim_start_matches('.'))
                }
                _ => "",
            };
            let row = answered(document, path, answer, [of, doc], is_layout);
            let is_value = row.is_some();
            rows.extend(row);
            !is_value
        });
        if beyond > 0 {
            let cell = Cell { words: words::plain(format!("and {beyond} more")), number: None };
            rows.push(row_of(path, cell, ["", doc], is_layout));
        }
    }

    /// Adds the rows of what a program drew: the numbers of its figures, turn by turn.
    fn add_drawn(&mut self, answer: &Answer<'_>, path: &mut String, most: usize) {
        let (document, rows) = (&self.state.lowered.document, &mut self.work.rows);
        let from = rows.len();
        // the turns around what is visited, each with where its path ends
        let mut turns: Vec<(usize, ClassId)> = Vec::new();
        walk(document, (answer, Standing::Result), path, &mut |answer, _, path| {
            if rows.len() >= most {
                return false;
            }
            while turns.pop_if(|(end, _)| *end >= path.len()).is_some() {}
            if let Answer::Context(turn) = answer {
                turns.push((path.len(), turn.class));
            }
            let class = match (answer, turns.last()) {
                (Answer::Number(..), Some(&(end, turn))) => {
                    angle_of(document, turn, path[end..].trim_start_matches('.'))
                }
                _ => "",
            };
            let row = answered(document, path, answer, [class, ""], false);
            let is_value = row.is_some();
            rows.extend(row);
            !is_value
        });
        let beside = |a: &ValueRow, b: &ValueRow| a.class == b.class && around(a) == around(b);
        rows[from..].chunk_by_mut(beside).for_each(|rows| settle(document, rows));
    }
}

/// Returns the path of what has a value.
fn around(row: &ValueRow) -> &str {
    row.path.rsplit_once('.').map_or("", |(whole, _)| whole)
}

/// Shows numbers of one thing as nothing that are no more than rounding beside the others.
fn settle(document: &Document, rows: &mut [ValueRow]) {
    let size = |row: &ValueRow| row.number.map_or(0.0, f64::abs);
    let largest = rows.iter().map(size).fold(0.0, f64::max);
    for row in rows
        .iter_mut()
        .filter(|row| size(row) > 0.0 && size(row) < crate::rounding::ROUNDING * largest)
    {
        let Some(dimension) = expr::Dimension::by_name(&row.class) else { continue };
        let quantity = Quantity { dimension, class: &row.class, written: "" };
        let nothing = kernel::show_quantity(0.0, quantity, document);
        (row.text, row.unit) = (nothing.text, nothing.unit);
    }
}

/// Returns the row of what a thing answers; nothing where that is no value.
fn answered(
    document: &Document,
    path: &str,
    answer: &Answer<'_>,
    [class, doc]: [&str; 2],
    is_layout: bool,
) -> Option<ValueRow> {
    let (cell, class) = show_answer(document, answer, class)?;
    Some(row_of(path, cell, [class, doc], is_layout))
}

/// Returns the row of what a thing answers, in words.
fn row_of(path: &str, cell: Cell, [class, doc]: [&str; 2], is_layout: bool) -> ValueRow {
    let Cell { words, number } = cell;
    ValueRow {
        path: path.into(),
        shortest: path.into(),
        class: class.into(),
        text: words.text,
        unit: words.unit,
        exact: words.exact,
        number,
        options: Vec::new(),
        given: false,
        is_virtual: true,
        anchored: false,
        is_layout,
        freedom: None,
        doc: doc.into(),
        range: None,
    }
}

/// Returns true for what is shown value by value: lists of values, and of the document itself also figures and lists
/// of these.
fn is_table(answer: &Answer<'_>, thing: ThingId) -> bool {
    match answer {
        Answer::List(items) => {
            let mut items = items.iter();
            items.all(|item| is_value(item) || is_table(item, thing))
        }
        Answer::Made(made) => {
            let mut fields = made.fields.iter();
            thing == kernel::DOCUMENT
                && fields.all(|field| is_value(field) || is_table(field, thing))
        }
        _ => false,
    }
}

/// Returns what there is to choose for a value.
fn options(document: &Document, primitive: Primitive) -> Vec<String> {
    match primitive {
        Primitive::Choice(of) => {
            document.classes[of].options.iter().map(ToString::to_string).collect()
        }
        Primitive::Bool => vec!["true".into(), "false".into()],
        Primitive::Real(_) | Primitive::Integer | Primitive::Text | Primitive::Color => Vec::new(),
    }
}

/// Returns the shortest path to a thing, the first declared of several.
fn shortest_path(state: &State, thing: ThingId) -> String {
    if !state.structure.is_merged(thing) {
        let mut path = String::new();
        append_path(state, thing, &mut path);
        return path;
    }
    let paths = state.structure.merged_with(thing).into_iter();
    let paths = paths.map(|t| state.structure.path(&state.lowered.document, t));
    // an element is as near as its list
    let length = |path: &Path| path.0.iter().filter(|step| !matches!(step, Step::Index(_))).count();
    let shortest = paths.min_by_key(length);
    shortest.map_or_else(String::new, |path| path.to_string())
}

/// Writes the path to a thing as a [`Path`] is written: most rows have one of their own.
fn append_path(state: &State, thing: ThingId, path: &mut String) {
    let Some(owner) = state.structure.things[thing].owner else { return };
    append_path(state, owner, path);
    append_field(state, thing, path);
}

/// Adds the step that leads to a thing from what it is stored in.
fn append_field(state: &State, thing: ThingId, path: &mut String) {
    match state.structure.field_name(&state.lowered.document, thing) {
        Some(name) => append(path, name),
        None => {
            let _ = write!(path, "[{}]", state.structure.things[thing].field);
        }
    }
}

/// Adds a step to the part of this name.
fn append(path: &mut String, name: &str) {
    if !path.is_empty() {
        path.push('.');
    }
    path.push_str(name);
}

/// A message that reads as a value.
struct Answers {
    name: Name,
    doc: String,
    /// Whether a picture speaks of it.
    is_pictured: bool,
    /// The class that is written for its answer.
    class: Option<ClassId>,
}

/// Returns the messages that read as values, with what `///` says of them, in order of declaration.
///
/// One that a subclass defines anew stands where it was first declared, once. What the lab shows in
/// views of its own is no value, whatever it answers, and a picture is none.
fn virtual_parts(document: &Document, class: ClassId) -> Rc<[Answers]> {
    let mut found: IndexMap<&Name, (&str, bool)> = IndexMap::new();
    let line: Vec<ClassId> = document.primary_line(class).into_iter().rev().collect();
    // of each name all that the line defines, from above
    let mut named: BTreeMap<&Name, Vec<&Message>> = BTreeMap::new();
    for message in line.iter().flat_map(|&class| &document.classes[class].messages) {
        named.entry(&message.name).or_default().push(message);
    }
    // that of the nearest class counts
    let mut classes: BTreeMap<&Name, Option<ClassId>> = BTreeMap::new();
    for message in line.iter().rev().flat_map(|&class| &document.classes[class].messages) {
        classes.entry(&message.name).or_insert(message.class);
    }
    // a part takes the place of a message that a class above answers
    let parts = line.iter().flat_map(|&class| &document.classes[class].parts);
    let stored: BTreeSet<&Name> = parts.map(|part| &part.name).collect();
    for &class in &line {
        if document.classes[class].supers.is_empty() {
            continue;
        }
        let messages = document.classes[class].messages.iter();
        let is_read = |m: &&Message| !m.is_asked && !is_view(&m.name) && !stored.contains(&m.name);
        for message in messages.filter(is_read) {
            let (doc, is_drawn) = found.entry(&message.name).or_default();
            if !message.doc.is_empty() {
                *doc = &message.doc;
            }
            *is_drawn = is_picture(&message.answer);
        }
    }
    // what pictures speak of, and what that speaks of in turn
    let mut pictured: BTreeSet<&Name> = BTreeSet::new();
    let is_drawn = |m: &&Message| m.name.as_str() == "picture" || is_picture(&m.answer);
    let mut open: Vec<&Message> = named.values().flatten().copied().filter(is_drawn).collect();
    while let Some(message) = open.pop() {
        let mut terms = vec![&*message.answer];
        while let Some(term) = terms.pop() {
            terms.extend(term.operands());
            if let Term::Send { to, name, .. } = term
                && **to == Term::Me
                && pictured.insert(name)
            {
                open.extend(named.get(name).into_iter().flatten());
            }
        }
    }
    // what is placed stands there by its own names
    let is_read = |name: &Name, is_drawn: bool| !is_drawn && name.as_str() != lang::PLACED;
    let read = found.into_iter().filter(|(name, (_, is_drawn))| is_read(name, *is_drawn));
    read.map(|(name, (doc, _))| Answers {
        name: name.clone(),
        doc: doc.to_string(),
        is_pictured: pictured.contains(name),
        class: classes.get(name).copied().flatten(),
    })
    .collect()
}

/// Returns true if a term answers a picture, whatever it is asked of.
fn is_picture(term: &Term) -> bool {
    match term {
        Term::Call { name, .. } => {
            find(FUNCTIONS, name).is_some_and(|function| function.result == Kind::Picture)
        }
        Term::Send { to, name, .. } => {
            let message = find(PICTURE_MESSAGES, name);
            is_picture(to) && message.is_some_and(|message| message.result == Kind::Picture)
        }
        Term::If(_, a, b) => is_picture(a) && is_picture(b),
        Term::Let(_, _, term) => is_picture(term),
        _ => false,
    }
}

fn is_view(name: &Name) -> bool {
    matches!(name.as_str(), "picture" | "structure" | "values" | "inserted")
}
