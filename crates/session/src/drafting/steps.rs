//! The steps of a program in words, with what each made in its example; and steps deleted and said anew.

use super::scene::Curve;
use super::view::{ParameterRow, StepRow, StepsView};
use super::{Home, text};
use crate::state::State;
use crate::view::Refusal;
use crate::words;
use base::number::shortest;
use eval::{Answer, Evaluator};
use kernel::program::{Block, Says, Step};
use kernel::{DOCUMENT, Path, Values};
use std::collections::BTreeSet;
use syntax::ast::{AstNode, Member};

/// Returns the steps of what is recorded, or of the program of a thing.
pub(crate) fn view(
    state: &State,
    values: &Values,
    home: &Home,
    thing: Option<&str>,
) -> Option<StepsView> {
    let example = match (home, thing) {
        (Home::Program { example, .. }, _) => example.to_string(),
        (Home::Document, Some(thing)) => thing.to_string(),
        (Home::Document, None) => return None,
    };
    let document = &state.lowered.document;
    let path = crate::session::parse_path(&example)?;
    let thing = state.structure.follow(DOCUMENT, &path).ok()?;
    let class = state.structure.things[thing].class;
    let program = document.program(class)?;
    let evaluator = state.evaluator(values);
    let mut rows = Rows { state, evaluator: &evaluator, example: &example, rows: Vec::new() };
    rows.block(&program.body, "", "", 0);
    let parameter = |asked: &kernel::program::Asked| ParameterRow {
        name: asked.name.to_string(),
        prompt: asked.prompt.clone(),
        value: evaluator
            .at(&path.then(kernel::Step::Part(asked.name.clone())))
            .map_or_else(|fault| fault.message, |value| value_words(state, &evaluator, &value)),
    };
    Some(StepsView {
        program: document.classes[class].name.to_string(),
        is_recorded: *home != Home::Document,
        parameters: program.parameters.iter().map(parameter).collect(),
        rows: rows.rows,
        open_loop: None,
        example,
    })
}

struct Rows<'e, 'a> {
    state: &'a State,
    evaluator: &'e Evaluator<'a>,
    example: &'e str,
    rows: Vec<StepRow>,
}

impl<'a> Rows<'_, 'a> {
    /// Lists a block. `way` are the names around it, `made` leads to what it made in the example.
    fn block(&mut self, block: &'a Block, way: &str, made: &str, depth: usize) {
        for step in &block.steps {
            let own = if step.name.is_empty() { "block" } else { step.name.as_str() };
            let (path, made) = (format!("{way}{own}"), format!("{made}{own}"));
            let says = self.says(step);
            let (words, inner): (String, Vec<&'a Block>) = match &step.says {
                Says::Value(_) => (in_words(&says), Vec::new()),
                Says::If { then, otherwise, .. } => {
                    (says.clone(), std::iter::once(then).chain(otherwise).collect())
                }
                Says::Repeat { block, .. } | Says::Each { block, .. } => {
                    (says.clone(), vec![block])
                }
                Says::Erase(names) => {
                    let names: Vec<String> = names.iter().map(ToString::to_string).collect();
                    (format!("no longer part of the result: {}", names.join(", ")), Vec::new())
                }
                Says::Unclear => ("its text is wrong".into(), Vec::new()),
            };
            let value = crate::session::parse_path(&format!("{}.{made}", self.example))
                .and_then(|path| self.evaluator.at(&path).ok())
                .map(|answer| value_words(self.state, self.evaluator, &answer));
            let is_guide = step.is_guide;
            self.rows.push(StepRow {
                path: path.clone(),
                depth,
                words,
                formula: says,
                value,
                is_guide,
            });
            let turn = match step.says {
                Says::Repeat { .. } | Says::Each { .. } => "[0]",
                _ => "",
            };
            for block in inner {
                self.block(block, &format!("{path}."), &format!("{made}{turn}."), depth + 1);
            }
        }
    }

    /// What the text says of a step, in one line, without its name.
    fn says(&self, step: &Step) -> String {
        let place = self.state.lowered.place(step.origin);
        let file = self.state.lowered.files.get(place.file);
        let text =
            file.and_then(|f| f.text.get(place.span.start as usize..place.span.end as usize));
        let line = text.unwrap_or_default().trim().lines().next().unwrap_or_default();
        let line = line.strip_prefix("guide ").unwrap_or(line).trim();
        let says = match line.strip_prefix(step.name.as_str()) {
            Some(rest) if !step.name.is_empty() => rest.trim_start().trim_start_matches('=').trim(),
            _ => line,
        };
        says.trim_end_matches('{').trim().into()
    }
}

/// Says a formula as a draughtsman does: `circle tangent: -under, axis, radius r`.
fn in_words(formula: &str) -> String {
    let Some((head, arguments)) = formula.split_once('(') else { return formula.into() };
    let arguments = arguments.strip_suffix(')').unwrap_or(arguments);
    let is_class = head.chars().next().is_some_and(char::is_uppercase);
    let head = match head.split_once('.') {
        Some((class, word)) if is_class => format!("{} {word}", class.to_lowercase()),
        Some((of, word)) => format!("{word} of {of}"),
        None if is_class => head.to_lowercase(),
        None => return formula.into(),
    };
    format!("{head}: {}", arguments.replace(": ", " "))
}

fn value_words<'a>(state: &'a State, evaluator: &Evaluator<'a>, answer: &Answer<'a>) -> String {
    if let Some(curve) = Curve::of(evaluator, state, answer) {
        return curve.words();
    }
    match answer {
        Answer::Number(x, _) => shortest(*x),
        Answer::List(items) => match items.len() {
            1 => "1 turn".into(),
            n => format!("{n} turns"),
        },
        Answer::Context(context) => format!("{} figures", context.result().count()),
        other => evaluator.text_of(other),
    }
}

/// Returns what a path leads to, in words.
pub(crate) fn comes_to(state: &State, values: &Values, path: &str) -> Option<String> {
    let evaluator = state.evaluator(values);
    let answer = evaluator.at(&crate::session::parse_path(path)?).ok()?;
    Some(value_words(state, &evaluator, &answer))
}

/// Returns what a step drew; of a block all of its turns.
pub(crate) fn drawing(
    state: &State,
    values: &Values,
    example: &str,
    step: &str,
) -> drawing::Drawing {
    let evaluator = state.evaluator(values);
    let mut elements = Vec::new();
    let names: Vec<&str> = step.split('.').collect();
    let start = crate::session::parse_path(example).unwrap_or_default();
    collect(&evaluator, &start, &names, &mut elements);
    drawing::Drawing { elements, ..drawing::Drawing::default() }
}

fn collect(evaluator: &Evaluator<'_>, at: &Path, names: &[&str], into: &mut Vec<drawing::Element>) {
    let Some((name, rest)) = names.split_first() else {
        if let Ok(answer) = evaluator.at(at) {
            match &answer {
                Answer::List(items) => {
                    into.extend(items.iter().flat_map(|i| evaluator.elements(i)));
                }
                _ => into.extend(evaluator.elements(&answer)),
            }
        }
        return;
    };
    let next = at.then(kernel::Step::Part((*name).into()));
    match evaluator.at(&next) {
        Ok(Answer::List(items)) if !rest.is_empty() => {
            for turn in 0..items.len() as u32 {
                collect(evaluator, &next.then(kernel::Step::Index(turn)), rest, into);
            }
        }
        Ok(_) => collect(evaluator, &next, rest, into),
        Err(_) => {}
    }
}

/// Returns the steps of a program's body that speak of one, or of one that does, in order.
pub(crate) fn dependents(text: &str, program: &str, step: &str) -> Vec<String> {
    let Some(body) = text::program(text, program).and_then(|p| p.body()) else { return Vec::new() };
    let mut gone = BTreeSet::from([step.to_string()]);
    let mut found = Vec::new();
    for member in body.members() {
        let Member::Assign(assign) = &member else { continue };
        let name = assign.target().map(|t| t.syntax().text().to_string().trim().to_string());
        let Some(name) = name.filter(|name| !gone.contains(name)) else { continue };
        let says = assign.value().map(|v| v.syntax().text().to_string()).unwrap_or_default();
        if gone.iter().any(|g| !text::places_of(&says, g).is_empty()) {
            gone.insert(name.clone());
            found.push(name);
        }
    }
    found
}

/// Returns a text without a step and those that speak of it.
///
/// # Errors
/// There is no such step.
pub(crate) fn without(text: &str, program: &str, step: &str) -> Result<String, Refusal> {
    let mut gone = dependents(text, program, step);
    gone.insert(0, step.into());
    let mut text = text.to_string();
    // from the last, so that what is before keeps its place
    for name in gone.iter().rev() {
        let none = || words::refuse(format!("{program} has no step {name}"));
        let (span, _) = text::step(&text, program, name).ok_or_else(none)?;
        let (mut start, mut end) = (span.start as usize, span.end as usize);
        start = text[..start].rfind('\n').map_or(start, |i| i + 1);
        end += text[end..].find('\n').map_or(0, |i| i + 1);
        text.replace_range(start..end, "");
    }
    Ok(text)
}

/// Returns a text in which a step says something else.
///
/// # Errors
/// There is no such step, or nothing is said.
pub(crate) fn with_formula(
    text: &str,
    program: &str,
    step: &str,
    formula: &str,
) -> Result<String, Refusal> {
    let none = || words::refuse(format!("{program} has no step {step}"));
    let (_, span) = text::step(text, program, step).ok_or_else(none)?;
    let formula = formula.trim();
    if formula.is_empty() {
        return Err(words::refuse(format!("what {step} does is wanted")));
    }
    let (start, end) = (span.start as usize, span.end as usize);
    Ok(format!("{}{formula}{}", &text[..start], &text[end..]))
}
