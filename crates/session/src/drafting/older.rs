//! What is drawn outside of the program that is recorded, and picked for it: it becomes a parameter, or its
//! construction is taken along.

use super::catalogue::SlotKind;
use super::scene::{self, Found};
use super::view::{OlderUse, Prompt, Wants};
use super::{Dialogue, Home, compound, recording, steps, text};
use crate::apply;
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::{Pointer, Refusal};
use crate::words;
use base::Name;
use eval::{Answer, Evaluator};
use kernel::{Command, DOCUMENT, Path, Step};
use std::collections::BTreeSet;
use syntax::ast::{AstNode, Member};

/// Something that was picked, and is asked about.
#[derive(Clone, Debug)]
pub(crate) struct Older {
    /// Its path from the document.
    pub(crate) path: String,
    /// Where it was picked.
    pub(crate) at: (f64, f64),
}

impl Older {
    /// What is asked.
    pub(super) fn prompt(&self, of: Prompt) -> Prompt {
        let path = &self.path;
        Prompt {
            words: format!(
                "{path} stands outside of the program: is it a parameter, or is its construction taken along?"
            ),
            wants: Wants::Older { path: path.clone() },
            is_value: false,
            takes_sets: false,
            goes_wider: false,
            ..of
        }
    }
}

/// What lies under a pointer outside of the program, and would fit.
pub(super) fn find(
    state: &State,
    home: &Home,
    dialogue: &Dialogue,
    pointer: &Pointer,
) -> Option<Older> {
    let Home::Program { example, .. } = home else { return None };
    let slot = dialogue.slot().filter(|slot| slot.kind != SlotKind::Value)?;
    let is_own = |f: &Found| {
        let rest = f.text.strip_prefix(example.as_str());
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
    };
    let mut all = scene::scene(state, &Home::Document);
    all.retain(|f| !is_own(f));
    let found = super::dialogue::nearest(state, slot, &all, pointer)?;
    Some(Older { path: found.text.clone(), at: pointer.at })
}

/// Does what is answered; returns how the operand is written then.
///
/// # Errors
/// The text cannot say it; then nothing has changed.
pub(super) fn settle(
    open: &mut Open,
    host: &dyn Host,
    home: &Home,
    (older, to): (&Older, OlderUse),
) -> Result<String, Refusal> {
    let Home::Program { program, example, way, before } = home else {
        return Err(words::refuse("nothing is recorded".into()));
    };
    match to {
        OlderUse::Parameter => parameter(open, host, (program, example), &older.path),
        OlderUse::Along => {
            // it stands before the blocks that are open
            let before = way.first().map(|a| a.segment().to_string()).or_else(|| before.clone());
            let (program, example) = (program.clone(), example.clone());
            let outer = Home::Program { program, example, way: Vec::new(), before };
            along(open, host, &outer, &older.path)
        }
    }
}

/// Defines a parameter of the class of something, which is given it in the example.
fn parameter(
    open: &mut Open,
    host: &dyn Host,
    (program, example): (&Name, &Name),
    path: &str,
) -> Result<String, Refusal> {
    let state = open.state.clone();
    let evaluator = state.evaluator(&state.values);
    let none = || words::refuse(format!("{path} cannot be a parameter"));
    let inner = crate::session::parse_path(path).ok_or_else(none)?;
    let answer = evaluator.at(&inner).map_err(|fault| words::refuse(fault.message))?;
    let class = class_name(&state, &evaluator, &answer).ok_or_else(none)?;
    let value = constructed(&state, &evaluator, &answer).ok_or_else(none)?;
    let name = free_name(&state, program, path);
    let written = format!("{name}: {class} = {value}");
    let text = text::with_parameter(&text::Source::now(&state), program, &written)?;
    let since = open.done.len();
    recording::retext(open, host, text, format!("define {name}"))?;
    let members = format!("{name} = {path}");
    let given = Command::Edit { target: Path::of(&[example]), members };
    if let Err(refusal) = apply::apply(open, host, &given) {
        apply::apply(open, host, &Command::Undo)?;
        open.undone.clear();
        return Err(refusal);
    }
    if let Some(step) = open.done.last_mut() {
        step.label = format!("define {name}");
    }
    open.one_step(since);
    Ok(name)
}

/// Copies how something was drawn into the program, with all that this speaks of.
fn along(open: &mut Open, host: &dyn Host, home: &Home, path: &str) -> Result<String, Refusal> {
    let state = open.state.clone();
    let Home::Program { program, .. } = home else { return Ok(path.into()) };
    let mut taken = Taken {
        state: &state,
        evaluator: state.evaluator(&state.values),
        program,
        used: text::words_in(&text::Source::now(&state), program),
        lines: Vec::new(),
        open: Vec::new(),
    };
    let operand = taken.take(path)?;
    if !taken.lines.is_empty() {
        let text = text::with_members(&text::Source::now(&state), home, &taken.lines.join("\n"))?;
        recording::retext(open, host, text, format!("take {path} along"))?;
    }
    Ok(operand)
}

struct Taken<'a> {
    state: &'a State,
    evaluator: Evaluator<'a>,
    program: &'a Name,
    /// The names that the program uses.
    used: BTreeSet<String>,
    /// What is written into it.
    lines: Vec<String>,
    /// What is being taken: nothing speaks of itself.
    open: Vec<String>,
}

impl Taken<'_> {
    /// Takes along what a path begins with, as a whole figure; returns how the program speaks of what it leads to.
    fn take(&mut self, path: &str) -> Result<String, Refusal> {
        let none = || words::refuse(format!("{path} cannot be taken along"));
        let steps = crate::session::parse_path(path).ok_or_else(none)?.0;
        let document = &self.state.lowered.document;
        let is_whole = |n: &usize| {
            let answer = self.evaluator.at(&Path(steps[..*n].to_vec())).ok();
            answer.is_some_and(|answer| {
                let class = self.evaluator.class_of(&answer);
                matches!(answer, Answer::Number(..) | Answer::Bool(_))
                    || class.is_some_and(|class| compound::is_drawn(document, class))
            })
        };
        let n = (1..=steps.len()).find(is_whole).ok_or_else(none)?;
        let (own, rest) = (Path(steps[..n].to_vec()), &steps[n..]);
        let name = Step::Part(self.whole(&own)?.as_str().into());
        let all = std::iter::once(name).chain(rest.iter().cloned());
        Ok(Path(all.collect()).to_string())
    }

    fn whole(&mut self, path: &Path) -> Result<String, Refusal> {
        let written = path.to_string();
        let none = || words::refuse(format!("{written} cannot be taken along"));
        if self.open.contains(&written) {
            return Err(none());
        }
        let formula = match self.definition(path) {
            Some(formula) => {
                self.open.push(written.clone());
                let formula = self.within(&formula)?;
                self.open.pop();
                formula
            }
            None => {
                let answer = self.evaluator.at(path).map_err(|f| words::refuse(f.message))?;
                constructed(self.state, &self.evaluator, &answer).ok_or_else(none)?
            }
        };
        let base = last_name(&written);
        // what was taken along before is there
        let is_there = |name: &String| {
            let step = text::step(&text::Source::now(self.state), self.program, name);
            let says = |span: base::Span| &self.state.text[span.start as usize..span.end as usize];
            step.is_some_and(|(_, value)| says(value).trim() == formula)
                || self.lines.iter().any(|line| *line == format!("{name} = {formula}"))
        };
        if is_there(&base) {
            return Ok(base);
        }
        let mut names = std::iter::once(base.clone()).chain((2..).map(|i| format!("{base}{i}")));
        let name = names.find(|name| !self.used.contains(name)).unwrap_or_default();
        self.used.insert(name.clone());
        self.lines.push(format!("{name} = {formula}"));
        Ok(name)
    }

    /// How something that the document computes is written.
    fn definition(&self, path: &Path) -> Option<String> {
        let [Step::Part(name)] = path.0.as_slice() else { return None };
        let file = self.state.file();
        let of = |member: Member| match member {
            Member::Message(message) => {
                let named = message.name().is_some_and(|word| word.text() == name.as_str());
                named.then(|| message.definition()).flatten()
            }
            _ => None,
        };
        let formula = file.members().find_map(of)?;
        Some(formula.syntax().text().to_string().trim().to_string())
    }

    /// Takes along what a formula speaks of; returns it as the program says it.
    fn within(&mut self, formula: &str) -> Result<String, Refusal> {
        let document = &self.state.lowered.document;
        let root = &document.classes[document.root];
        let parts = root.parts.iter().map(|part| part.name.to_string());
        let names = parts.chain(root.messages.iter().map(|message| message.name.to_string()));
        let names: BTreeSet<String> =
            names.filter(|name| !text::places_of(formula, name).is_empty()).collect();
        let mut formula = formula.to_string();
        for name in names {
            // from the end, so that places stay where they are
            for at in text::places_of(&formula, &name).into_iter().rev() {
                let rest = &formula[at..];
                let chain = &rest[..rest.find(|c| !text::is_of_path(c)).unwrap_or(rest.len())];
                // a message with arguments is no part of the path
                let is_sent = rest[chain.len()..].starts_with('(');
                let chain = match chain.rfind('.') {
                    Some(dot) if is_sent => &chain[..dot],
                    _ => chain,
                };
                let chain = chain.to_string();
                let taken = self.take(&chain)?;
                formula.replace_range(at..at + chain.len(), &taken);
            }
        }
        Ok(formula)
    }
}

fn last_name(path: &str) -> String {
    let last = path.rsplit('.').next().unwrap_or(path);
    last.split('[').next().unwrap_or(last).to_string()
}

/// A name for something that a program does not use, and that hides nothing of the document from its example.
fn free_name(state: &State, program: &Name, path: &str) -> String {
    let used = text::words_in(&text::Source::now(state), program);
    let is_used = |name: &String| {
        used.contains(name)
            || steps::addresses(&text::Source::now(state), program).contains(name)
            || state.structure.follow(DOCUMENT, &Path::of(&[name.as_str()])).is_ok()
            || path.split(['.', '[']).next() == Some(name.as_str())
    };
    let base = last_name(path);
    let mut names = std::iter::once(base.clone()).chain((2..).map(|i| format!("{base}{i}")));
    names.find(|name| !is_used(name)).unwrap_or_default()
}

/// The name of the class of an answer; of a class of one that which it comes from.
fn class_name<'a>(state: &State, evaluator: &Evaluator<'a>, of: &Answer<'a>) -> Option<String> {
    let document = &state.lowered.document;
    let class = document.named_class(evaluator.class_of(of)?);
    Some(document.classes[class].name.to_string())
}

/// Writes a value as what makes it anew: `Circle(center: Point(3, 4), radius: 5)`.
pub(super) fn constructed<'a>(
    state: &'a State,
    evaluator: &Evaluator<'a>,
    of: &Answer<'a>,
) -> Option<String> {
    match of {
        Answer::Number(..) | Answer::Bool(_) | Answer::Option(..) | Answer::Text(_) => {
            return Some(evaluator.text_of(of));
        }
        _ => {}
    }
    let document = &state.lowered.document;
    let class = document.named_class(evaluator.class_of(of)?);
    let name = &document.classes[class].name;
    let field = |field| {
        let label = document.field_name(field);
        let value = constructed(state, evaluator, &evaluator.of_part(of, label).ok()?)?;
        let is_place = **name == *"Point";
        Some(if is_place { value } else { format!("{label}: {value}") })
    };
    let fields = document.layout(class).into_iter().map(field).collect::<Option<Vec<_>>>()?;
    (!fields.is_empty()).then(|| format!("{name}({})", fields.join(", ")))
}
