//! Loops by demonstration: the first turn is drawn; then each operand that comes from outside of it is asked for,
//! "the same, or which object of the turn before?"; then what ends the loop.
//!
//! The text of a loop whose questions are open is a block that takes one turn. What answers say is written when
//! the loop is closed: answers that differ from the first turn become what is carried from turn to turn.

use super::view::{LoopView, RecurrenceQuestion};
use super::{Home, outcome, recording, text};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::{Change, Refusal};
use crate::words;
use base::Name;
use kernel::Path;
use std::collections::BTreeSet;
use syntax::ast::{ArgList, AstNode, Member, Value};

/// A loop whose first turn is drawn.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Loop {
    /// Its step in the program.
    pub(crate) name: Name,
    /// How many steps could be taken back when it was begun.
    since: usize,
    /// Once the turn is drawn: what is asked of the second.
    asked: Vec<Asked>,
    /// Whether the turn is drawn.
    is_drawn: bool,
}

/// A question of the second turn.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Asked {
    /// The step of the turn.
    step: String,
    /// Its operand: the label, or the place.
    slot: String,
    /// What it is in the first turn.
    first: String,
    /// Where that stands in the text.
    span: base::Span,
    /// What it is in the next turn, as the turn before calls it; itself for the same.
    answer: Option<String>,
}

impl Loop {
    /// What the page shows of it.
    pub(crate) fn view(&self) -> LoopView {
        LoopView { name: self.name.to_string(), is_drawn: self.is_drawn, question: self.question() }
    }

    /// The question that is open, with what is known of it.
    pub(crate) fn question(&self) -> Option<RecurrenceQuestion> {
        let at = self.asked.iter().position(|asked| asked.answer.is_none())?;
        let asked = &self.asked[at];
        Some(RecurrenceQuestion {
            number: at + 1,
            of: self.asked.len(),
            step: asked.step.clone(),
            operand: asked.slot.clone(),
            first: asked.first.clone(),
        })
    }
}

/// Begins a loop in what is recorded: its first turn is drawn next.
///
/// # Errors
/// Nothing is recorded, a loop is open already, the name is none or taken.
pub(crate) fn begin(open: &mut Open, host: &dyn Host, name: &str) -> Result<Change, Refusal> {
    let Some(recording) = open.recording.clone() else {
        return Err(words::refuse("a loop is one of a program: record one first".into()));
    };
    if recording.block.is_some() {
        return Err(words::refuse("a loop is open already: end it first".into()));
    }
    let home = Home::of(Some(&recording));
    let text = text::with_members(&open.state.text, &home, &format!("{name} = repeat {{\n}}"))?;
    let since = open.done.len();
    let change = recording::retext(open, host, text, format!("repeat {name}"))?;
    let block = Loop { name: Name::new(name), since, asked: Vec::new(), is_drawn: false };
    open.recording = Some(super::Recording { block: Some(block), ..recording });
    open.dialogue = None;
    Ok(change)
}

/// Ends the first turn; returns the first question of the second, if there is any.
///
/// # Errors
/// No loop is open, or nothing is drawn in it.
pub(crate) fn end_turn(open: &mut Open) -> Result<Option<RecurrenceQuestion>, Refusal> {
    let text = open.state.text.clone();
    let Some((recording, block)) = opened(open) else {
        return Err(words::refuse("no loop is open".into()));
    };
    let body = text::block(&text, &recording.0, &block.name);
    let body = body.ok_or_else(|| words::refuse("the loop is gone".into()))?;
    block.asked = questions(&body);
    if body.members().next().is_none() {
        return Err(words::refuse("draw the first turn of the loop first".into()));
    }
    block.is_drawn = true;
    let question = block.question();
    open.dialogue = None;
    Ok(question)
}

/// Returns the loop that is open, with the program and example that are recorded.
fn opened(open: &mut Open) -> Option<((Name, Name), &mut Loop)> {
    let recording = open.recording.as_mut()?;
    let names = (recording.program.clone(), recording.example.clone());
    Some((names, recording.block.as_mut()?))
}

/// Answers the open question: nothing for the same, else an object of the turn before, or an expression over it.
/// Where it was picked decides which way round a curve is taken.
///
/// # Errors
/// No question is open; the answer does not fit, or the second turn would have no outcome.
pub(crate) fn answer(
    open: &mut Open,
    host: &dyn Host,
    (answer, at): (Option<&str>, Option<(f64, f64)>),
) -> Result<Option<RecurrenceQuestion>, Refusal> {
    let state = open.state.clone();
    let Some((names, block)) = opened(open) else {
        return Err(words::refuse("no loop is open".into()));
    };
    let Some(i) = block.asked.iter().position(|asked| asked.answer.is_none()) else {
        return Err(words::refuse("nothing is asked".into()));
    };
    let first = block.asked[i].first.clone();
    let ways: Vec<String> = match answer.map(str::trim) {
        None | Some("") => vec![first],
        Some(text) if at.is_some() => vec![text.into(), outcome::turned_round(text)],
        Some(text) => vec![text.into()],
    };
    let mut best: Option<(f64, String)> = None;
    let mut why = None;
    for way in ways {
        let mut tried = block.clone();
        tried.asked[i].answer = Some(way.clone());
        match second_turn(&state, host, (&names, &tried, i), at) {
            Ok(away) if best.as_ref().is_none_or(|(least, _)| away < *least - 1e-9) => {
                best = Some((away, way));
            }
            Ok(_) => {}
            Err(message) => {
                why.get_or_insert(message);
            }
        }
    }
    match best {
        Some((_, way)) => {
            block.asked[i].answer = Some(way);
            Ok(block.question())
        }
        None => Err(words::refuse(why.unwrap_or_else(|| "there is no such turn".into()))),
    }
}

/// Runs the second turn with the answers so far; says how far the step of a question lies from a place.
fn second_turn(
    state: &State,
    host: &dyn Host,
    (names, block, i): (&(Name, Name), &Loop, usize),
    at: Option<(f64, f64)>,
) -> Result<f64, String> {
    let written = closed(&state.text, (&names.0, block), "repeat 2 times", "")
        .map_err(|refusal| refusal.message)?;
    let (tried, _) = State::of(written, Some(state), host, plan::Plans::default());
    if let Some(wrong) = recording::new_error(state, &tried) {
        return Err(wrong);
    }
    let evaluator = tried.evaluator(&tried.values);
    let path = Path::of(&[&names.1, &block.name]);
    let step = kernel::Step::Part(block.asked[i].step.as_str().into());
    let answer = evaluator.at(&path.then(kernel::Step::Index(1)).then(step));
    let answer = answer.map_err(|fault| fault.message)?;
    let curve = super::scene::Curve::of(&evaluator, &tried, &answer);
    Ok(curve.zip(at).map_or(0.0, |(curve, at)| curve.distance(at)))
}

/// Closes the loop by what ends it: `until ring.radius < least`, `6 times`, `while r > least`. It is one step.
///
/// # Errors
/// No loop is open, a question is; the condition is none.
pub(crate) fn close(open: &mut Open, host: &dyn Host, ends: &str) -> Result<Change, Refusal> {
    let state = open.state.clone();
    let Some((names, block)) = opened(open) else {
        return Err(words::refuse("no loop is open".into()));
    };
    if let Some(question) = block.question() {
        let (step, operand) = (question.step, question.operand);
        return Err(words::refuse(format!("{operand} of {step} is asked first")));
    }
    let block = block.clone();
    let ends = ends.trim();
    let (head, tail) = match ends.split_once(' ') {
        Some(("until", condition)) => ("repeat".to_string(), format!(" until {condition}")),
        Some(("while", condition)) => (format!("while {condition}"), String::new()),
        _ if ends.ends_with(" times") => (format!("repeat {ends}"), String::new()),
        _ => {
            let wanted = "`until …`, `while …` or `… times` is wanted";
            return Err(words::refuse(format!("{ends}: {wanted}")));
        }
    };
    let text = closed(&state.text, (&names.0, &block), &head, &tail)?;
    let change = recording::retext(open, host, text, format!("repeat {}", block.name))?;
    open.one_step(block.since);
    if let Some(recording) = &mut open.recording {
        recording.block = None;
    }
    Ok(change)
}

/// Returns a text in which the loop says what its answers say.
fn closed(
    text: &str,
    (program, block): (&Name, &Loop),
    head: &str,
    tail: &str,
) -> Result<String, Refusal> {
    let none = || words::refuse("the loop is gone".into());
    let body = text::block(text, program, &block.name).ok_or_else(none)?;
    let mut taken: BTreeSet<String> = names_in(text, program);
    let mut carried: Vec<(String, String, String)> = Vec::new();
    let mut edits: Vec<(base::Span, String)> = Vec::new();
    for asked in &block.asked {
        let Some(answer) = asked.answer.as_ref().filter(|answer| **answer != asked.first) else {
            continue;
        };
        let same = carried.iter().find(|(_, first, next)| *first == asked.first && next == answer);
        let name = match same {
            Some((name, ..)) => name.clone(),
            None => {
                let plain = asked.slot.clone();
                let names =
                    std::iter::once(plain.clone()).chain((2..).map(|i| format!("{plain}{i}")));
                let name = { names }.find(|name| !taken.contains(name)).unwrap_or(plain);
                taken.insert(name.clone());
                carried.push((name.clone(), asked.first.clone(), answer.clone()));
                name
            }
        };
        edits.push((asked.span, name));
    }
    let span = body.span();
    let (start, end) = (span.start as usize, span.end as usize);
    let mut inside = text[start..end].to_string();
    edits.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
    for (at, name) in edits {
        inside.replace_range(at.start as usize - start..at.end as usize - start, &name);
    }
    let listed = |pairs: Vec<String>| pairs.join(", ");
    let with = listed(carried.iter().map(|(name, first, _)| format!("{name} = {first}")).collect());
    let next = listed(carried.iter().map(|(name, _, next)| format!("{name} = {next}")).collect());
    if !carried.is_empty() {
        let close = inside.rfind('}').unwrap_or(inside.len());
        let before = inside[..close].trim_end().to_string();
        inside = format!("{before}\n        next {next}\n    }}");
    }
    let begun = text[..start].rfind("repeat").ok_or_else(none)?;
    let with = if with.is_empty() { String::new() } else { format!(" with {with}") };
    Ok(format!("{}{head}{with} {inside}{tail}{}", &text[..begun], &text[end..]))
}

/// Returns the names that a program uses.
fn names_in(text: &str, program: &Name) -> BTreeSet<String> {
    let Some(program) = text::program(text, program) else { return BTreeSet::new() };
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let all = program.syntax().text().to_string();
    let named = |body: &str| body.split(|c| !is_word(c)).map(String::from).collect();
    // a label is no name
    named(&all.replace("first:", "").replace("second:", ""))
}

/// Returns what the second turn is asked: every operand, in order, that speaks of something from outside.
fn questions(body: &syntax::ast::Body) -> Vec<Asked> {
    let mut own: Vec<String> = Vec::new();
    let mut all = Vec::new();
    for member in body.members() {
        let Member::Assign(assign) = member else { continue };
        let name = assign.target().map(|t| t.syntax().text().to_string().trim().to_string());
        let step = name.unwrap_or_default();
        let list = match assign.value() {
            Some(Value::Expr(value)) => value.syntax().children().find_map(ArgList::cast),
            _ => None,
        };
        if let Some(list) = list {
            for (i, argument) in list.args().enumerate() {
                let Some(value) = argument.value() else { continue };
                let first = value.syntax().text().to_string().trim().to_string();
                let span = syntax::ast::span_without_doc(value.syntax());
                if !speaks_of_outside(&first, &own) {
                    continue;
                }
                let label = argument.label().map(|word| word.text().to_string());
                let slot = label.unwrap_or_else(|| ordinal(i));
                all.push(Asked { step: step.clone(), slot, first, span, answer: None });
            }
        }
        own.push(step);
    }
    all
}

/// What an operand without a label is called.
fn ordinal(i: usize) -> String {
    ["first", "second", "third"].get(i).map_or_else(|| format!("operand{}", i + 1), |n| (*n).into())
}

/// Whether an operand speaks of something that its turn has not made: not a literal, not a class or function.
fn speaks_of_outside(text: &str, own: &[String]) -> bool {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut rest = text;
    let mut before = ' ';
    while let Some(start) = rest.find(is_word) {
        if let Some(c) = rest[..start].chars().next_back() {
            before = c;
        }
        let word: String = rest[start..].chars().take_while(|&c| is_word(c)).collect();
        rest = &rest[start + word.len()..];
        let follows = rest.trim_start().chars().next();
        let is_name = word.starts_with(char::is_lowercase) && before != '.';
        let is_unit = before == ' '
            && text[..text.len() - rest.len() - word.len()]
                .trim_end()
                .ends_with(|c: char| c.is_ascii_digit());
        if is_name && !is_unit && !matches!(follows, Some('(' | ':')) && !own.contains(&word) {
            return true;
        }
        before = ' ';
    }
    false
}
