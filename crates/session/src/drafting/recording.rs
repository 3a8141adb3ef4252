//! Recording: each figure that is drawn is a line of the program's text, and one undo step.

use super::view::NewParameter;
use super::{Dialogue, Home, Recording, outcome, text};
use crate::apply;
use crate::document::Open;
use crate::host::Host;
use crate::recognise;
use crate::state::State;
use crate::view::{Change, Refusal};
use crate::words;
use base::{Name, Severity};
use eval::Answer;
use expr::dimension::Dimension;
use kernel::{ClassId, Command, DOCUMENT, Path};

/// A line of text that makes something.
pub(crate) struct Line {
    /// What it is called.
    pub(crate) name: String,
    /// The line.
    pub(crate) text: String,
}

/// Returns the line that makes a figure in a home.
pub(crate) fn line(state: &State, home: &Home, dialogue: &Dialogue, made: &str) -> Line {
    let class = &dialogue.tool.class;
    match home {
        Home::Document => {
            let name = free_name(state, state.lowered.document.root, class);
            let text = format!("{name} => {made}");
            Line { name, text }
        }
        Home::Program { program, .. } => {
            let document = &state.lowered.document;
            let of = class_of_home(state, home)
                .or_else(|| document.class_named(program))
                .unwrap_or(document.root);
            let name = free_name(state, of, class);
            let guide = if dialogue.is_guide { "guide " } else { "" };
            let text = format!("{guide}{name} = {made}");
            Line { name, text }
        }
    }
}

/// Returns the class whose messages the steps of a home are.
fn class_of_home(state: &State, home: &Home) -> Option<ClassId> {
    let evaluator = state.evaluator(&state.values);
    let answer = evaluator.at(&home.path()).ok()?;
    evaluator.class_of(&answer)
}

/// Returns the first error of a state that the one before it has not.
pub(crate) fn new_error(before: &State, after: &State) -> Option<String> {
    let is_new = |d: &&base::Diagnostic| {
        d.severity == Severity::Error && before.diagnostics.iter().all(|b| b.message != d.message)
    };
    after.diagnostics.iter().find(is_new).map(|d| d.message.clone())
}

/// Returns a name that no part and nothing computed of a class has, for a thing of another.
fn free_name(state: &State, of: ClassId, class: &Name) -> String {
    let small = |(at, c): (usize, char)| if at == 0 { c.to_ascii_lowercase() } else { c };
    let word: String = class.chars().enumerate().map(small).collect();
    let document = &state.lowered.document;
    let is_free = |name: &String| {
        let of = &document.classes[of];
        of.parts.iter().all(|part| *part.name != **name)
            && of.messages.iter().all(|message| *message.name != **name)
            && document.class_named(name).is_none()
    };
    let names = std::iter::once(word.clone()).chain((2..).map(|i| format!("{word}{i}")));
    { names }.find(is_free).unwrap_or_default()
}

/// Writes a line into a home, as one step.
///
/// # Errors
/// The text would be wrong.
pub(crate) fn write(
    open: &mut Open,
    host: &dyn Host,
    home: &Home,
    line: &Line,
) -> Result<Change, Refusal> {
    match home {
        Home::Document => {
            let edit = Command::Edit { target: Path::default(), members: line.text.clone() };
            apply::apply(open, host, &edit)
        }
        Home::Program { .. } => {
            let text = text::with_members(&open.state.text, home, &line.text)?;
            retext(open, host, text, format!("draw {}", line.name))
        }
    }
}

/// Makes a text the document's own, as one step, unless it is wrong where the present one is not.
///
/// # Errors
/// What is wrong with it.
pub(crate) fn retext(
    open: &mut Open,
    host: &dyn Host,
    text: String,
    label: String,
) -> Result<Change, Refusal> {
    let before = open.state.clone();
    let plans = open.planner.take_plans();
    let (state, planner) = State::of(text, Some(&before), host, plans);
    let is_error = |d: &&base::Diagnostic| d.severity == Severity::Error;
    let errors = |s: &State| s.diagnostics.iter().filter(is_error).count();
    if errors(&state) > errors(&before) {
        let is_new =
            |d: &&base::Diagnostic| before.diagnostics.iter().all(|b| b.message != d.message);
        let new: Vec<_> =
            state.diagnostics.iter().filter(is_error).filter(is_new).cloned().collect();
        open.planner.give_plans(planner.into_plans());
        return Err(words::refusal_of_text(&state, &new));
    }
    Ok(apply::step_to(open, label, state, planner))
}

/// Begins to record a program.
///
/// # Errors
/// The name is none for a program, or something else is called so.
pub(crate) fn begin(open: &mut Open, host: &dyn Host, name: &str) -> Result<Change, Refusal> {
    let name = name.trim();
    let starts_well = name.chars().next().is_some_and(char::is_uppercase);
    if !starts_well || !name.chars().all(|c| c.is_alphanumeric() || c == '_') {
        let message =
            format!("`{name}` is no name for a program: a word that begins with a capital is");
        return Err(words::refuse(message));
    }
    let program = Name::new(name);
    let change = if text::program(&open.state.text, name).is_some() {
        match example_of(&open.state, &program) {
            Some(_) => Change::default(),
            None => {
                let example = recognise::free_name(&open.state, &program);
                let members = format!("{example}: {name}");
                apply::apply(open, host, &Command::Edit { target: Path::default(), members })?
            }
        }
    } else if open.state.lowered.document.class_named(name).is_some() {
        return Err(words::refuse(format!("there is a class {name} already")));
    } else {
        let example = recognise::free_name(&open.state, &program);
        let members = format!("program {name}() {{\n}}\n{example}: {name}");
        let text = format!("{}\n\n{members}\n", open.state.text.trim_end());
        retext(open, host, text.trim_start().into(), format!("record {name}"))?
    };
    let none = || words::refuse(format!("there is no example of {name}"));
    let example = example_of(&open.state, &program).ok_or_else(none)?;
    open.recording = Some(Recording { program, example, block: None });
    open.dialogue = None;
    Ok(change)
}

/// Returns the first thing of the document that a program draws.
fn example_of(state: &State, program: &Name) -> Option<Name> {
    let document = &state.lowered.document;
    let class = document.class_named(program)?;
    let mut own = state.structure.parts(DOCUMENT);
    let example = own.find(|&part| document.is_a(state.structure.things[part].class, class))?;
    state.structure.field_name(document, example).cloned()
}

/// Defines a parameter.
///
/// # Errors
/// Nothing is recorded, the name is taken or none, the example is no value.
pub(crate) fn define(
    open: &mut Open,
    host: &dyn Host,
    home: &Home,
    new: &NewParameter,
) -> Result<Change, Refusal> {
    let Home::Program { program, .. } = home else {
        return Err(words::refuse("a parameter is one of a program: record one first".into()));
    };
    let (name, example) = (new.name.trim(), new.example.trim());
    let starts_well = name.chars().next().is_some_and(char::is_alphabetic);
    if !starts_well || !name.chars().all(|c| c.is_alphanumeric() || c == '_') {
        return Err(words::refuse(format!("`{name}` is no name for a parameter")));
    }
    let class = match new.class.trim() {
        "" => class_of_example(&open.state, host, example)?,
        class => class.into(),
    };
    let prompt = match new.prompt.trim() {
        "" => String::new(),
        prompt => format!(" \"{}\"", prompt.replace(['"', '\\'], "")),
    };
    let written = format!("{name}: {class} = {example}{prompt}");
    let text = text::with_parameter(&open.state.text, program, &written)?;
    retext(open, host, text, format!("define {name}"))
}

/// Returns the class that an example is of.
fn class_of_example(state: &State, host: &dyn Host, example: &str) -> Result<String, Refusal> {
    let mut class = Err(words::refuse(format!("`{example}` is no value of a parameter")));
    let texts = [example.to_string()];
    let is_bare = example.parse::<f64>().is_ok();
    let wrong =
        outcome::try_all(state, host, &Home::Document, &texts, &mut |tried, _, _, answer| {
            let document = &tried.lowered.document;
            class = match answer {
                Ok(Answer::Bool(_)) => Ok("Bool".into()),
                // what a draughtsman says without a unit is a length
                Ok(Answer::Number(..)) if is_bare => Ok("Length".into()),
                Ok(Answer::Number(_, d)) if d == Dimension::LENGTH => Ok("Length".into()),
                Ok(Answer::Number(_, d)) if d == Dimension::ANGLE => Ok("Angle".into()),
                Ok(Answer::Number(_, d)) if d == Dimension::NONE => Ok("Real".into()),
                Ok(Answer::Text(_)) => Ok("Text".into()),
                Ok(Answer::Option(of, _)) => Ok(document.classes[of].name.to_string()),
                Ok(other) => Err(words::refuse(format!("{example} is {}, no value", other.kind()))),
                Err(fault) => Err(words::refuse(format!("{example}: {}", fault.message))),
            };
        });
    match wrong {
        Some(message) => Err(words::refuse(format!("{example}: {message}"))),
        None => class,
    }
}
