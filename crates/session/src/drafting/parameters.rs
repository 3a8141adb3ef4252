//! The parameters of a program that is recorded: defined, changed, taken away; and what one is told by where it is used.
//!
//! A number without a unit is a length. Where such a parameter is first used as a count, an angle or a plain number it
//! becomes one, in the same step, and the hand is told so. Where it is a length for other steps already it stays one.

use super::view::{NewParameter, Prompt, Turn};
use super::{Home, outcome, recording, text};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::{Change, Refusal};
use crate::words;
use base::{Name, Span};
use eval::Answer;
use expr::dimension::Dimension;
use syntax::ast::{AstNode, Param};

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
    named: Span,
    /// Where all of it stands.
    span: Span,
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
            prompt: param
                .prompt()
                .map_or_else(String::new, |word| word.text().trim_matches('"').into()),
            named: param.name()?.span(),
            span: syntax::ast::span_without_doc(param.syntax()),
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
    /// The least and the largest value that are allowed, where these are constants.
    pub(crate) range: Option<(String, String)>,
}

/// Lists what a program of a document, or of what it uses, asks of each parameter, by name.
pub(crate) fn asked(state: &State, program: &str) -> Vec<(String, Asks)> {
    let sources = state.lowered.files.iter().map(|(_, file)| text::Source::of_file(file));
    let declared = sources.map(|source| declared(&source, program)).enumerate();
    let (file, all) = { declared }.find(|(_, all)| !all.is_empty()).unwrap_or_default();
    let is_constant = |text: &str| all.iter().all(|d| text::places_of(text, &d.name).is_empty());
    // a bare length of another file may be one of other units
    let is_here = |d: &Declared, text: &str| {
        let is_plain = matches!(d.class.as_str(), "Integer" | "Real" | "Bool" | "Text");
        let has_unit =
            text.split_once(' ').is_some_and(|(number, _)| number.parse::<f64>().is_ok());
        !text.is_empty() && is_constant(text) && (file == 0 || is_plain || has_unit)
    };
    let one = |d: &Declared| {
        let range =
            d.range.split_once("..").map(|(a, b)| (a.trim().to_string(), b.trim().to_string()));
        let usual = Some(d.example.clone()).filter(|example| is_here(d, example));
        let range = range.filter(|(a, b)| is_here(d, a) && is_here(d, b));
        (d.name.clone(), Asks { prompt: d.prompt.clone(), usual, range })
    };
    all.iter().map(one).collect()
}

impl Asks {
    /// Checks that a value is allowed.
    ///
    /// # Errors
    /// It lies outside of the range.
    pub(crate) fn allows(
        &self,
        state: &State,
        home: &Home,
        (name, value): (&str, &str),
    ) -> Result<(), Refusal> {
        let Some((least, most)) = &self.range else { return Ok(()) };
        let is_within = format!("{least} <= ({value}) and ({value}) <= {most}");
        match outcome::worth(state, home, &is_within) {
            Ok(outcome::Worth::Truth(false)) => {
                let message = format!("{name} is {value}: {least} to {most} are allowed");
                Err(words::refuse(message))
            }
            Ok(_) | Err(_) => Ok(()),
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
    let written = written(&open.state, name, new)?;
    let instead = new.instead_of.trim();
    if instead.is_empty() {
        let text = text::with_parameter(&text::Source::now(&open.state), program, &written)?;
        return recording::retext(open, host, text, format!("define {name}"));
    }
    let since = open.done.len();
    if instead != name {
        let text = renamed(&open.state, host, (program, instead), name)?;
        recording::retext(open, host, text, format!("rename {instead}"))?;
    }
    match said_anew(open, host, (program, name), &written) {
        Ok(change) => {
            open.one_step(since);
            Ok(change)
        }
        Err(refusal) => {
            take_back(open, since);
            Err(refusal)
        }
    }
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
    let mut gone: Vec<Span> = spoken_of(&open.state, host, known.named)
        .into_iter()
        .filter_map(|span| text::given_at(&source, span))
        .collect();
    gone.push(with_comma(&source, known.span));
    gone.sort_by_key(|span| std::cmp::Reverse(span.start));
    let text = gone.into_iter().fold(source.to_string(), |text, span| replaced(&text, span, ""));
    recording::retext(open, host, text, format!("delete {name}"))
}

/// A parameter with the comma after it and the white space before it.
fn with_comma(text: &str, span: Span) -> Span {
    let (before, after) = (&text[..span.start as usize], &text[span.end as usize..]);
    let rest = after.trim_start().strip_prefix(',');
    let end = rest.map_or(span.end as usize, |rest| text.len() - rest.len());
    Span::new(before.trim_end().len() as u32, end as u32)
}

/// Writes a parameter as a program declares it.
fn written(state: &State, name: &str, new: &NewParameter) -> Result<String, Refusal> {
    let starts_well = name.chars().next().is_some_and(char::is_alphabetic);
    if !starts_well || !name.chars().all(|c| c.is_alphanumeric() || c == '_') {
        return Err(words::refuse(format!("`{name}` is no name for a parameter")));
    }
    let example = new.example.trim();
    let place = super::typed::pair(example, ',').map(|(x, y)| format!("Point({x}, {y})"));
    let example = place.as_deref().unwrap_or_else(|| super::typed::truth(example));
    let class = match new.class.trim() {
        "" => class_of_example(state, example)?,
        class => class.into(),
    };
    let prompt = match new.prompt.trim() {
        "" => String::new(),
        prompt => format!(" \"{}\"", prompt.replace(['"', '\\'], "")),
    };
    let range = match new.range.trim() {
        "" => String::new(),
        range if range.contains("..") => format!(" in {range}"),
        range => {
            let message = format!("`{range}` is no range: wanted is from..to, as 1 mm..100 mm");
            return Err(words::refuse(message));
        }
    };
    Ok(format!("{name}: {class}{range} = {example}{prompt}"))
}

/// Returns the text with a parameter called otherwise, wherever it is spoken of.
fn renamed(
    state: &State,
    host: &dyn Host,
    (program, from): (&Name, &str),
    to: &str,
) -> Result<String, Refusal> {
    let source = text::Source::now(state);
    if text::words_in(&source, program).contains(to) {
        return Err(words::refuse(format!("{to} stands for something else in {program}")));
    }
    let none = || words::refuse(format!("{program} has no parameter {from}"));
    let named = declared(&source, program).into_iter().find(|d| d.name == from).ok_or_else(none)?;
    let mut spoken = spoken_of(state, host, named.named);
    spoken.push(named.named);
    spoken.sort_by_key(|span| std::cmp::Reverse(span.start));
    Ok(spoken.into_iter().fold(source.to_string(), |text, span| replaced(&text, span, to)))
}

/// Where the document's own text speaks of a parameter, apart from where it declares it.
fn spoken_of(state: &State, host: &dyn Host, named: Span) -> Vec<Span> {
    let mentions = lang::mentions(&state.text, &|name| host.read(name));
    let is_it = |m: &lang::Mention| m.declared == Some((String::new(), named)) && m.span != named;
    mentions.iter().filter(|m| is_it(m)).map(|m| m.span).collect()
}

fn said_anew(
    open: &mut Open,
    host: &dyn Host,
    (program, name): (&Name, &str),
    written: &str,
) -> Result<Change, Refusal> {
    let source = text::Source::now(&open.state);
    let none = || words::refuse(format!("{program} has no parameter {name}"));
    let old = declared(&source, program).into_iter().find(|d| d.name == name).ok_or_else(none)?;
    let text = replaced(&source, old.span, written);
    recording::retext(open, host, text, format!("change {name}"))
}

fn replaced(text: &str, span: Span, with: &str) -> String {
    format!("{}{with}{}", &text[..span.start as usize], &text[span.end as usize..])
}

/// Goes back to how many steps were done; what is left cannot be done again.
fn take_back(open: &mut Open, since: usize) {
    while open.done.len() > since {
        open.travel(crate::document::Direction::Back);
        open.undone.pop();
    }
}

/// The steps of a program that speak of a parameter; of blocks the outermost.
fn steps_that_speak(
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

/// A parameter that may be something else than a length: what it would be, and the text that says so.
struct Other {
    name: String,
    class: &'static str,
    text: String,
    /// Whether steps speak of it as a length.
    is_used: bool,
}

/// Lists what the parameters that an expression speaks of may be where a class is wanted: those that were defined by a
/// number without a unit, whose example has no value of its own.
fn others(state: &State, home: &Home, typed: &str, wanted: &str) -> Vec<Other> {
    let Home::Program { program, example, .. } = home else { return Vec::new() };
    let source = text::Source::now(state);
    let is_alone = |name: &str| typed.trim() == name;
    let one = |d: Declared| {
        let is_plain = d.class == "Length" && d.example.parse::<f64>().is_ok();
        if !is_plain || text::places_of(typed, &d.name).is_empty() {
            return None;
        }
        let is_used = steps_that_speak(&source, program, &d.name).next().is_some();
        let is_whole = d.example.parse::<u32>().is_ok();
        let class = match wanted {
            "Integer" if is_whole => "Integer",
            "Angle" if is_alone(&d.name) => "Angle",
            "Real" | "Angle" | "Integer" if is_whole && !is_alone(&d.name) => "Integer",
            "Real" | "Angle" => "Real",
            _ => return None,
        };
        let unit = if class == "Angle" { " deg" } else { "" };
        // lengths would be none of an angle: a range, or one that the example has of its own
        let is_own = !unit.is_empty() && (!d.range.is_empty() || has_own_value(state, example, &d));
        let old = &source[d.span.start as usize..d.span.end as usize];
        let said = old.replacen(": Length", &format!(": {class}"), 1);
        let said = said.replacen(&format!("= {}", d.example), &format!("= {}{unit}", d.example), 1);
        let text = replaced(&source, d.span, &said);
        (!is_own && said != old).then_some(Other { name: d.name, class, text, is_used })
    };
    declared(&source, program).into_iter().filter_map(one).collect()
}

/// Whether the example has another value of a parameter than the program gives it.
fn has_own_value(state: &State, example: &Name, parameter: &Declared) -> bool {
    let is_as_declared = format!("{example}.{} = {}", parameter.name, parameter.example);
    let worth = outcome::worth(state, &Home::Document, &is_as_declared);
    !matches!(worth, Ok(outcome::Worth::Truth(true)))
}

/// Says what a parameter would become where a class is wanted.
pub(crate) fn may_become(
    state: &State,
    home: &Home,
    (typed, wanted): (&str, &str),
) -> Option<String> {
    let other = others(state, home, typed, wanted).into_iter().find(|other| !other.is_used)?;
    Some(format!("{} becomes {}", other.name, class_in_words(other.class)))
}

/// Does something again with a parameter as what is wanted of it, where that was refused: as a count, an angle, a plain
/// number. What is done is one step with it, and says so.
///
/// # Errors
/// What was refused, where no parameter can be something else.
pub(crate) fn retried(
    open: &mut Open,
    host: &dyn Host,
    (home, typed, wanted): (&Home, &str, &str),
    refused: Refusal,
    again: &dyn Fn(&mut Open) -> Result<Turn, Refusal>,
) -> Result<Turn, Refusal> {
    let others = others(&open.state, home, typed, wanted);
    let since = open.done.len();
    let dialogue = open.dialogue.clone();
    for other in others.iter().filter(|other| !other.is_used) {
        let label = format!("{} is {}", other.name, class_in_words(other.class));
        if recording::retext(open, host, other.text.clone(), label).is_err() {
            continue;
        }
        match again(open) {
            Ok(Turn::Made { change, name, text, next }) => {
                open.one_step(since);
                let now = format!("{} is {} now", other.name, class_in_words(other.class));
                let next = next.map(|p| Prompt { words: format!("{now}. {}", p.words), ..p });
                return Ok(Turn::Made { change, name, text: format!("{text}; {now}"), next });
            }
            // further operands are wanted: what it is now stands
            Ok(Turn::Wants(prompt)) => {
                let words = format!(
                    "{} is {} now. {}",
                    other.name,
                    class_in_words(other.class),
                    prompt.words
                );
                return Ok(Turn::Wants(Prompt { words, ..prompt }));
            }
            Err(_) => {
                take_back(open, since);
                open.dialogue.clone_from(&dialogue);
            }
        }
    }
    match others.first() {
        Some(other) if other.is_used && other.name == typed.trim() => Err(words::refuse(format!(
            "{} is a length for other steps: where {} is wanted, define one of the class {}",
            other.name,
            class_in_words(other.class),
            other.class,
        ))),
        Some(_) | None => Err(refused),
    }
}

/// What a parameter of a class is, in words.
fn class_in_words(class: &str) -> &'static str {
    match class {
        "Integer" => "a count",
        "Angle" => "an angle",
        _ => "a plain number",
    }
}
