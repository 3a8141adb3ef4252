//! The parameters of a program that is recorded: defined, changed, taken away.

use super::view::NewParameter;
use super::{Home, outcome, recording, text, typed};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::{Change, Refusal};
use crate::words;
use base::{Name, Span};
use eval::Answer;
use expr::dimension::Dimension;
use kernel::{ClassKind, Primitive};
use lang::tables::Reading;
use syntax::ast::{AstNode, Expr, Param, span_without_doc};

/// A parameter as its program declares it.
pub(crate) struct Declared {
    /// Its name.
    pub(crate) name: String,
    /// Its class.
    pub(crate) class: String,
    /// The values that are allowed; nothing for all.
    pub(crate) range: String,
    /// Its example.
    pub(crate) example: String,
    /// What is asked; nothing where nothing is.
    pub(crate) prompt: String,
    /// Where its name stands.
    pub(super) named: Span,
    /// How it is written.
    node: Param,
}

/// An end of a range, as it is written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Bound {
    value: String,
    /// Whether it is not allowed itself.
    is_outside: bool,
}

/// The values that are allowed, as they are written.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Allowed {
    /// A range, of which an end may be missing.
    Range {
        /// The least value that is allowed.
        least: Option<Bound>,
        /// The largest one.
        most: Option<Bound>,
    },
    /// A table of values.
    OneOf(Vec<String>),
    /// The values of a column of a table beside the document.
    Column {
        /// The name of the file.
        file: String,
        /// The name of the column.
        column: String,
        /// Its values; none before the file is looked at.
        values: Vec<String>,
    },
}

/// Where the values of a column may be said to be many: then they are not listed in words.
const MANY: usize = 12;

impl Allowed {
    /// Reads `1..10`, `1..<10`, `0.5..`, `..10`, `> 0`, `[3 mm, 4 mm]` and `3, 4, 5 mm`, `"bolts.csv".d` and `bolts.csv.d`; nothing else.
    pub(crate) fn of(text: &str) -> Option<Self> {
        if let Some(column) = column_of(text) {
            return Some(column);
        }
        if let Some(range) = open_range(text) {
            return Some(range);
        }
        let said = |of: Expr| of.syntax().text().to_string().trim().to_string();
        match typed::expression(text) {
            Some(Expr::Range(range)) => {
                let bound = |value: Expr, is_outside| Bound { value: said(value), is_outside };
                Some(Self::Range {
                    least: Some(bound(range.start()?, false)),
                    most: Some(bound(range.end()?, range.is_open())),
                })
            }
            Some(Expr::List(list)) => {
                let values: Vec<String> = list.elements().map(said).collect();
                (!values.is_empty()).then_some(Self::OneOf(values))
            }
            Some(_) => None,
            None => {
                let text = text.trim().strip_prefix("one of ").unwrap_or(text);
                let Some(Expr::List(list)) = typed::expression(&format!("[{text}]")) else {
                    return None;
                };
                let mut values: Vec<String> = list.elements().map(said).collect();
                // `3, 4, 5 mm`: the unit of the last is that of all
                let unit = values.last()?.split_once(' ').filter(|(x, unit)| {
                    typed::is_number(x) && syntax::units::unit_length(unit) == unit.len()
                });
                let unit = unit.map(|(_, unit)| unit.to_string());
                let is_bare = values.split_last()?.1.iter().all(|value| typed::is_number(value));
                if let (Some(unit), true) = (unit, is_bare) {
                    let last = values.len() - 1;
                    values[..last].iter_mut().for_each(|value| *value = format!("{value} {unit}"));
                }
                Some(Self::OneOf(values))
            }
        }
    }

    /// Looks its values up, where they are those of a column, as values of a class are written: in the tables that stand
    /// beside a text.
    ///
    /// # Errors
    /// There is no such file, or no such column.
    pub(crate) fn looked_up(
        self,
        (state, class): (&State, &str),
        read: &dyn Fn(&str) -> Option<Reading>,
    ) -> Result<Self, String> {
        let Self::Column { file, column, .. } = self else { return Ok(self) };
        if !lang::tables::is_name(&file) {
            return Err(format!("`{file}` is no name of a table"));
        }
        let table =
            read(&file).ok_or_else(|| format!("there is no table {file} beside the document"))?;
        let table = table.map_err(|why| format!("{file} cannot be read: {why}"))?;
        let document = &state.lowered.document;
        let class = document.class_named(class).or_else(|| document.class_named("Real"));
        let cells = class.and_then(|class| table.values(&column, (document, class)));
        let cells = cells.ok_or_else(|| {
            format!("{file} has no column {column}: it has {}", table.names().join(", "))
        })?;
        let is_text = class.is_some_and(|class| {
            let kind = &document.classes[class].kind;
            matches!(kind, ClassKind::Primitive(Primitive::Text | Primitive::Color))
        });
        let written = |cell: String| if is_text { lang::quoted(&cell) } else { cell };
        let values = cells.into_iter().map(|(_, cell)| written(cell)).collect();
        Ok(Self::Column { file, column, values })
    }

    /// The same in what a document has read; `user` is the name of the text that says it.
    fn known(self, state: &State, (user, class): (&str, &str)) -> Option<Self> {
        let read = |name: &str| {
            let name = lang::tables::beside(user, name);
            let mut files = state.lowered.files.iter().map(|(_, file)| file);
            files.find(|file| file.is_table() && file.name == name)?.table.clone()
        };
        self.looked_up((state, class), &read).ok()
    }

    /// Says it: `1 to 10`, `1 to less than 10`, `3 mm, 4 mm or 5 mm`.
    pub(crate) fn in_words(&self) -> String {
        match self {
            Self::Range { least: Some(least), most: Some(most) } => {
                let less = if most.is_outside { "less than " } else { "" };
                format!("{} to {less}{}", least.value, most.value)
            }
            Self::Range { least, most } => {
                let one = |bound: &Option<Bound>, [outside, with]: [&str; 2]| {
                    let bound = bound.as_ref()?;
                    let way = if bound.is_outside { outside } else { with };
                    Some(format!("{way} {}", bound.value))
                };
                let least = one(least, ["more than", "at least"]);
                least.or_else(|| one(most, ["less than", "at most"])).unwrap_or_default()
            }
            Self::Column { file, column, values } if values.is_empty() || values.len() > MANY => {
                format!("those of column {column} of {file}")
            }
            Self::OneOf(values) | Self::Column { values, .. } => match values.split_last() {
                Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
                _ => values.concat(),
            },
        }
    }

    /// As a program declares it, numbers without a unit in the one that is given.
    pub(crate) fn written(&self, unit: Option<&str>) -> String {
        let own = |text: &String| unit.map_or_else(|| text.clone(), |unit| in_unit(text, unit));
        match self {
            Self::Range { least: Some(Bound { value, is_outside: true }), .. } => {
                format!("> {}", own(value))
            }
            Self::Range { least, most } => {
                let end = |bound: &Option<Bound>| bound.as_ref().map(|b| own(&b.value));
                let is_outside = most.as_ref().is_some_and(|most| most.is_outside);
                let dots = if is_outside { "..<" } else { ".." };
                let [least, most] = [least, most].map(|bound| end(bound).unwrap_or_default());
                match (least.is_empty(), is_outside) {
                    (true, true) => format!("< {most}"),
                    _ => format!("{least}{dots}{most}"),
                }
            }
            Self::OneOf(values) => {
                format!("[{}]", values.iter().map(own).collect::<Vec<_>>().join(", "))
            }
            Self::Column { file, column, .. } => format!("{}.{column}", lang::quoted(file)),
        }
    }

    /// The condition that a value is allowed.
    pub(crate) fn condition(&self, value: &str) -> String {
        match self {
            Self::Range { least, most } => {
                let sign = |bound: &Bound| if bound.is_outside { "<" } else { "<=" };
                let least = least.as_ref().map(|b| format!("{} {} ({value})", b.value, sign(b)));
                let most = most.as_ref().map(|b| format!("({value}) {} {}", sign(b), b.value));
                [least, most].into_iter().flatten().collect::<Vec<_>>().join(" and ")
            }
            Self::OneOf(values) | Self::Column { values, .. } => {
                format!("({value}) in [{}]", values.join(", "))
            }
        }
    }

    /// What is said in it.
    fn values(&self) -> Vec<&String> {
        match self {
            Self::Range { least, most } => {
                [least, most].into_iter().flatten().map(|bound| &bound.value).collect()
            }
            Self::OneOf(values) | Self::Column { values, .. } => values.iter().collect(),
        }
    }

    /// The values of a table; none of a range.
    fn table(self) -> Vec<String> {
        match self {
            Self::OneOf(values) | Self::Column { values, .. } => values,
            Self::Range { .. } => Vec::new(),
        }
    }
}

/// Reads a range that is open at an end: `0.5..`, `..10`, `> 0`, `<= 10`.
fn open_range(text: &str) -> Option<Allowed> {
    let text = text.trim();
    let bound = |value: &str, is_outside| {
        let value = value.trim();
        let found = typed::expression(value)?;
        let is_value = !matches!(found, Expr::Range(_) | Expr::List(_));
        is_value.then(|| Some(Bound { value: value.into(), is_outside }))
    };
    if let Some(least) = text.strip_suffix("..") {
        return Some(Allowed::Range { least: bound(least, false)?, most: None });
    }
    let most = [("..<", true), ("..", false), ("<=", false), ("≤", false), ("<", true)];
    let least = [(">=", false), ("≥", false), (">", true)];
    let begins = |ends: &[(&str, bool)]| {
        let one = |&(sign, is_outside): &(&str, bool)| bound(text.strip_prefix(sign)?, is_outside);
        ends.iter().find_map(one)
    };
    match (begins(&most), begins(&least)) {
        (None, None) => None,
        (most, least) => Some(Allowed::Range { least: least.flatten(), most: most.flatten() }),
    }
}

/// Reads the column of a table: `"bolts.csv".d`, or as it is typed, `bolts.csv.d`.
fn column_of(text: &str) -> Option<Allowed> {
    let text = text.trim();
    let column =
        |file: String, column: String| Allowed::Column { file, column, values: Vec::new() };
    if let Some(found) = typed::expression(text).and_then(|e| lang::tables::column_of(&e)) {
        return Some(column(found.file(), found.name().into()));
    }
    let (stem, name) = text.split_once(".csv")?;
    let name = name.trim_start_matches(['.', ' ', ':']);
    let is_file = !stem.is_empty() && !stem.contains(['"', ',', '[']);
    (is_file && is_name(name)).then(|| column(format!("{stem}.csv"), name.into()))
}

/// Lists the values of a table of those that a text of a name allows of a parameter; none where all are, or those of a
/// range.
pub(crate) fn table_of(state: &State, (user, of): (&str, &Declared)) -> Vec<String> {
    let known = Allowed::of(&of.range).and_then(|range| range.known(state, (user, &of.class)));
    known.map_or_else(Vec::new, Allowed::table)
}

/// The unit of angles that are typed without one.
pub(super) const DEGREES: &str = "deg";

/// What is typed, in a unit where it is a number without one.
pub(super) fn in_unit(typed: &str, unit: &str) -> String {
    if typed::is_number(typed) { format!("{typed} {unit}") } else { typed.into() }
}

/// Lists the parameters that a program of a text declares, in order.
pub(crate) fn declared(source: &text::Source, program: &str) -> Vec<Declared> {
    let list = text::program(source, program).and_then(|program| program.params());
    let written = |node: Option<String>| node.unwrap_or_default().trim().to_string();
    let one = |param: Param| {
        Some(Declared {
            name: param.name()?.text().into(),
            class: written(param.class().map(|c| c.syntax().text().to_string())),
            range: written(param.domain().map(|d| d.syntax().text().to_string())),
            example: written(param.value().map(|v| v.syntax().text().to_string())),
            prompt: param.prompt().map_or_else(String::new, |word| word.unquoted()),
            named: param.name()?.span(),
            node: param,
        })
    };
    list.into_iter().flat_map(|list| list.params()).filter_map(one).collect()
}

/// What a construction asks of a parameter, where that is one of a program.
#[derive(Clone, Debug)]
pub(crate) struct Asks {
    /// The question; nothing where none is written.
    pub(crate) prompt: String,
    /// What is taken where nothing is typed; nothing where that depends on other parameters.
    pub(crate) usual: Option<String>,
    /// The values that are allowed, where they are constants.
    pub(crate) range: Option<Allowed>,
}

/// Lists what a program of a document, or of what it uses, asks of each parameter, by name.
pub(crate) fn asked(state: &State, program: &str) -> Vec<(String, Asks)> {
    let sources = state.lowered.files.iter().map(|(_, file)| text::Source::of_file(file));
    let declared = sources.map(|source| declared(&source, program)).enumerate();
    let (file, all) = { declared }.find(|(_, all)| !all.is_empty()).unwrap_or_default();
    let user = state.lowered.files.iter().nth(file).map_or("", |(_, file)| file.name.as_str());
    let is_constant = |text: &str| all.iter().all(|d| text::places_of(text, &d.name).is_empty());
    let unit_of = |nth: usize| {
        let lines = state.lowered.files.iter().nth(nth)?.1.parse.syntax().children();
        lines.filter_map(syntax::ast::UnitLine::cast).next().map(|line| line.unit())
    };
    // a bare length of another file may be one of other units
    let is_of_same_unit = file == 0 || unit_of(file) == unit_of(0);
    let is_here = |d: &Declared, text: &str| {
        let is_plain = matches!(d.class.as_str(), "Integer" | "Real" | "Bool" | "Text");
        let has_unit =
            text.split_once(' ').is_some_and(|(number, _)| number.parse::<f64>().is_ok());
        !text.is_empty() && is_constant(text) && (is_of_same_unit || is_plain || has_unit)
    };
    let one = |d: &Declared| {
        let usual = Some(d.example.clone()).filter(|example| is_here(d, example));
        let range = Allowed::of(&d.range).and_then(|range| range.known(state, (user, &d.class)));
        let range = range.filter(|range| range.values().into_iter().all(|text| is_here(d, text)));
        (d.name.clone(), Asks { prompt: d.prompt.clone(), usual, range })
    };
    all.iter().map(one).collect()
}

impl Asks {
    /// The values of the table of those that are allowed.
    pub(crate) fn choices(&self) -> Vec<String> {
        self.range.clone().map_or_else(Vec::new, Allowed::table)
    }

    /// Checks that a value is allowed.
    ///
    /// # Errors
    /// It is none of the values that are, or has no value.
    pub(crate) fn allows(
        &self,
        state: &State,
        home: &Home,
        (name, value): (&str, &str),
    ) -> Result<(), Refusal> {
        let Some(range) = &self.range else { return Ok(()) };
        match outcome::worth(state, home, &range.condition(value)) {
            Ok(outcome::Worth::Truth(false)) => {
                let message = format!("{name} is {value}: {} are allowed", range.in_words());
                Err(words::refuse(message))
            }
            Ok(_) => Ok(()),
            // what has no value in the home is allowed as it is written, and not otherwise
            Err(_) if range.values().into_iter().any(|allowed| allowed == value) => Ok(()),
            Err(refusal) => Err(refusal),
        }
    }
}

/// Defines a parameter, or says anew what one is.
///
/// # Errors
/// Nothing is recorded, the name is taken or none, the example is no value, a step needs it to be what it was.
pub(crate) fn define(
    open: &mut Open,
    host: &dyn Host,
    home: &Home,
    new: &NewParameter,
) -> Result<Change, Refusal> {
    let Home::Program { program, .. } = home else {
        return Err(words::refuse("a parameter is one of a program: record one first".into()));
    };
    let name = new.name.trim();
    if !is_name(name) {
        return Err(words::refuse(format!("`{name}` is no name for a parameter")));
    }
    let instead = new.instead_of.trim();
    if instead.is_empty() {
        let said = Said::of(&open.state, new, None)?;
        let written = said.written(name);
        let text = text::with_parameter(&text::Source::now(&open.state), program, &written)?;
        return recording::retext(open, host, text, format!("define {name}"));
    }
    let since = open.done.len();
    let change = open.tried(|open| {
        if instead != name {
            let text = renamed(&open.state, (program, instead), name)?;
            recording::retext(open, host, text, format!("rename {instead}"))?;
        }
        said_anew(open, host, (program, name), new)
    })?;
    if open.done.len() > since + 1 {
        open.one_step(since);
    }
    Ok(change)
}

/// Whether something can be the name of a parameter.
pub(crate) fn is_name(name: &str) -> bool {
    let starts_well = name.chars().next().is_some_and(char::is_alphabetic);
    starts_well && name.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// What is wrong with what is no range.
pub(crate) const NO_RANGE: &str = "no range and no table: wanted is from..to, as 1 mm..100 mm, or > 0 mm, values, as 3, 4, 5 mm, or a column, as bolts.csv.d";

/// Returns the class of a parameter and its example, as the language writes it.
///
/// # Errors
/// The example is no value.
pub(crate) fn understood(state: &State, new: &NewParameter) -> Result<(String, String), Refusal> {
    let new = NewParameter { range: String::new(), ..new.clone() };
    Said::of(state, &new, None).map(|said| (said.class, said.example))
}

/// Takes a parameter from a program.
///
/// # Errors
/// There is none of that name, steps speak of it.
pub(crate) fn remove(
    open: &mut Open,
    host: &dyn Host,
    home: &Home,
    name: &str,
) -> Result<Change, Refusal> {
    let Home::Program { program, .. } = home else {
        return Err(words::refuse("nothing is recorded: record a program first".into()));
    };
    let source = text::Source::now(&open.state);
    let speaking: Vec<String> = steps_that_speak(&source, program, name).collect();
    if !speaking.is_empty() {
        let message =
            format!("{name} is spoken of by {}: change or delete these first", speaking.join(", "));
        return Err(words::refuse(message));
    }
    let none = || words::refuse(format!("{program} has no parameter {name}"));
    let known = declared(&source, program).into_iter().find(|d| d.name == name).ok_or_else(none)?;
    let given: Vec<text::Given> = spoken_of(&open.state, known.named)
        .into_iter()
        .filter_map(|span| text::given_at(&source, span))
        .collect();
    let mut gone: Vec<Span> = given.iter().map(|given| given.span).collect();
    gone.push(text::with_lines_of(&source, known.node.span()));
    gone.sort_by_key(|span| std::cmp::Reverse(span.start));
    let text = gone.into_iter().fold(source.to_string(), |text, span| replaced(&text, span, ""));
    let change = recording::retext(open, host, text, format!("delete {name}"))?;
    Ok(Change { along: given.into_iter().map(|given| given.says).collect(), ..change })
}

/// What is said of a parameter.
pub(super) struct Said {
    pub(super) class: String,
    pub(super) range: String,
    pub(super) example: String,
    pub(super) prompt: String,
}

impl Said {
    /// Reads what is said of a parameter; what it was already stays as it is written.
    fn of(state: &State, new: &NewParameter, old: Option<&Declared>) -> Result<Self, Refusal> {
        let is_old =
            |text: &str, get: fn(&Declared) -> &String| old.is_some_and(|old| get(old) == text);
        let mut example = new.example.trim().to_string();
        let keeps_example = is_old(&example, |old| &old.example);
        let is_text = new.class.trim() == "Text";
        if !keeps_example && !is_text {
            // a place that is typed is no expression
            let is_place = typed::expression(&example).is_none();
            let place = typed::pair(&example, ',').filter(|_| is_place);
            example = match place {
                Some((x, y)) => format!("Point({x}, {y})"),
                None => typed::truth(&example).into(),
            };
        }
        let class = match new.class.trim() {
            "" => class_of_example(state, &example).map_err(|why| or_a_text(why, &example))?,
            // a number said anew for a place was meant as one before: `8,4`
            class if !new.instead_of.trim().is_empty() && !keeps_example => {
                let of_example = class_of_example(state, &example).ok();
                let is_place = |class: &str| class == "Point";
                let other = of_example.filter(|other| is_place(other) != is_place(class));
                other.unwrap_or_else(|| class.into())
            }
            class => class.into(),
        };
        if is_text && !keeps_example && class_of_example(state, &example).is_err() {
            // words that name nothing are the text itself, braces and all
            example = quoted(&example).replace('{', "{{").replace('}', "}}");
        }
        let mut range = new.range.trim().to_string();
        let keeps_range = is_old(&range, |old| &old.range);
        let read = Allowed::of(&range).filter(|_| !range.is_empty());
        if read.is_none() && !range.is_empty() && !keeps_range {
            return Err(words::refuse(format!("`{range}` is {NO_RANGE}")));
        }
        if let (Some(read), false) = (&read, keeps_range) {
            range = read.written(None);
        }
        if class == "Angle" {
            let becomes = old.is_some_and(|old| old.class != "Angle");
            if becomes || !keeps_example {
                example = in_unit(&example, DEGREES);
            }
            if becomes || !keeps_range {
                range = read.map_or(range, |range| range.written(Some(DEGREES)));
            }
        }
        Ok(Self { class, range, example, prompt: new.prompt.trim().into() })
    }

    /// Writes a parameter as a program declares it.
    fn written(&self, name: &str) -> String {
        let Self { class, range, example, prompt } = self;
        let range = if range.is_empty() { String::new() } else { format!(" in {range}") };
        let prompt = if prompt.is_empty() { String::new() } else { format!(" {}", quoted(prompt)) };
        format!("{name}: {class}{range} = {example}{prompt}")
    }

    /// Returns a text in which a parameter says this; what is the same is not touched, and comments stay.
    pub(super) fn instead_of(&self, source: &text::Source, old: &Declared) -> String {
        let own = |node: &syntax::SyntaxNode| {
            let span = span_without_doc(node);
            let text = &source[span.start as usize..span.end as usize];
            Span::new(span.start, span.start + text.trim_end().len() as u32)
        };
        let node = &old.node;
        let spans = (node.class(), node.value());
        let (Some(class), Some(value)) = spans else {
            let whole = own(node.syntax());
            return replaced(source, whole, &self.written(&old.name));
        };
        let (class, value) = (own(class.syntax()), own(value.syntax()));
        let range = node.domain().map(|range| own(range.syntax()));
        let prompt = node.prompt().map(|word| word.span());
        let mut edits: Vec<(Span, String)> = Vec::new();
        if self.prompt != old.prompt {
            edits.push(match (prompt, self.prompt.as_str()) {
                (Some(at), "") => (Span::new(value.end, at.end), String::new()),
                (Some(at), text) => (at, quoted(text)),
                (None, text) => (Span::new(value.end, value.end), format!(" {}", quoted(text))),
            });
        }
        if self.example != old.example {
            edits.push((value, self.example.clone()));
        }
        if self.range != old.range {
            edits.push(match (range, self.range.as_str()) {
                (Some(at), "") => (Span::new(class.end, at.end), String::new()),
                (Some(at), text) => (at, text.into()),
                (None, text) => (Span::new(class.end, class.end), format!(" in {text}")),
            });
        }
        if self.class != old.class {
            edits.push((class, self.class.clone()));
        }
        // from the last to the first
        edits
            .into_iter()
            .fold(source.to_string(), |text, (span, with)| replaced(&text, span, &with))
    }
}

/// Says how words are written that were to be a text, where they may be that.
fn or_a_text(why: Refusal, example: &str) -> Refusal {
    let is_words = example.chars().all(|c| c.is_alphanumeric() || c.is_whitespace());
    match is_words && example.chars().any(char::is_alphabetic) {
        true => Refusal {
            message: format!("{}; a text stands in quotes: {}", why.message, quoted(example)),
            ..why
        },
        false => why,
    }
}

/// A question as the language writes it.
fn quoted(question: &str) -> String {
    format!("\"{}\"", question.replace('\\', "\\\\").replace('"', "\\\""))
}

/// Returns the text with a parameter called otherwise, wherever it is spoken of.
fn renamed(state: &State, (program, from): (&Name, &str), to: &str) -> Result<String, Refusal> {
    let source = text::Source::now(state);
    if text::words_in(&source, program).contains(to) {
        return Err(words::refuse(format!("{to} stands for something else in {program}")));
    }
    let none = || words::refuse(format!("{program} has no parameter {from}"));
    let named = declared(&source, program).into_iter().find(|d| d.name == from).ok_or_else(none)?;
    let mut spoken = spoken_of(state, named.named);
    spoken.push(named.named);
    spoken.sort_by_key(|span| std::cmp::Reverse(span.start));
    Ok(spoken.into_iter().fold(source.to_string(), |text, span| replaced(&text, span, to)))
}

/// Where the document's own text speaks of a parameter, apart from where it declares it.
pub(super) fn spoken_of(state: &State, named: Span) -> Vec<Span> {
    let used = |name: &str| {
        let mut files = state.lowered.files.iter().skip(1).map(|(_, file)| file);
        files.find(|file| file.name == name).map(|file| file.text.to_string())
    };
    let mentions = lang::mentions(&state.text, &used);
    let is_it = |m: &lang::Mention| m.declared == Some((String::new(), named)) && m.span != named;
    mentions.iter().filter(|m| is_it(m)).map(|m| m.span).collect()
}

fn said_anew(
    open: &mut Open,
    host: &dyn Host,
    (program, name): (&Name, &str),
    new: &NewParameter,
) -> Result<Change, Refusal> {
    let source = text::Source::now(&open.state);
    let none = || words::refuse(format!("{program} has no parameter {name}"));
    let old = declared(&source, program).into_iter().find(|d| d.name == name).ok_or_else(none)?;
    let said = Said::of(&open.state, new, Some(&old))?;
    let are_others = (said.class == "Angle") != (old.class == "Angle");
    if are_others && !spoken_of(&open.state, old.named).is_empty() {
        // a number without a unit is a millimetre of a length and a radian of an angle
        let message = format!(
            "{name} is spoken of elsewhere as of the class {}: define another one of the class {}",
            old.class, said.class
        );
        return Err(words::refuse(message));
    }
    let text = said.instead_of(&source, &old);
    recording::retext(open, host, text, format!("change {name}"))
}

fn replaced(text: &str, span: Span, with: &str) -> String {
    format!("{}{with}{}", &text[..span.start as usize], &text[span.end as usize..])
}

/// The steps of a program that speak of a parameter; of blocks the outermost.
pub(super) fn steps_that_speak(
    source: &text::Source,
    program: &str,
    name: &str,
) -> impl Iterator<Item = String> {
    let body = text::block(source, program, "");
    let steps = body.map(|body| text::steps_of(&body)).unwrap_or_default();
    let speaks = |step: text::StepNode| {
        let said = &source[step.span.start as usize..step.span.end as usize];
        let is_it = !text::places_of(said, name).is_empty();
        is_it.then(|| step.name.unwrap_or_else(|| "a branch".into()))
    };
    steps.into_iter().filter_map(speaks)
}

/// Returns the class that an example is of.
fn class_of_example(state: &State, example: &str) -> Result<String, Refusal> {
    let mut class = Err(words::refuse(format!("`{example}` is no value of a parameter")));
    let texts = [example.to_string()];
    let is_bare = example.parse::<f64>().is_ok();
    let wrong = outcome::try_all(state, &Home::Document, &texts, &mut |_, evaluator, answer| {
        let document = evaluator.document;
        class = match answer {
            Ok(Answer::Bool(_)) => Ok("Bool".into()),
            // what a draughtsman says without a unit is a length
            Ok(Answer::Number(..)) if is_bare => Ok("Length".into()),
            Ok(Answer::Number(_, d)) if d == Dimension::LENGTH => Ok("Length".into()),
            Ok(Answer::Number(_, d)) if d == Dimension::ANGLE => Ok("Angle".into()),
            Ok(Answer::Number(_, d)) if d == Dimension::NONE => Ok("Real".into()),
            Ok(Answer::Text(_)) => Ok("Text".into()),
            Ok(Answer::Option(of, _)) => Ok(document.classes[of].name.to_string()),
            Ok(other) => {
                let made = evaluator.class_of(&other).map(|class| document.named_class(class));
                let made = made.filter(|&class| document.figure(class).is_some());
                made.map(|class| document.classes[class].name.to_string()).ok_or_else(|| {
                    words::refuse(format!("{example} is {}, no value", other.kind()))
                })
            }
            Err(fault) => Err(words::refuse(format!("{example}: {}", fault.message))),
        };
    });
    match wrong {
        Some(message) => Err(words::refuse(format!("{example}: {message}"))),
        None => class,
    }
}
