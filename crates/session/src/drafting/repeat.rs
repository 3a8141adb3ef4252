//! Loops by demonstration: the first turn is drawn; then each operand that comes from outside of it is asked for,
//! "the same, or which object of the turn before?"; then what ends the loop.
//!
//! The text of a loop whose questions are open is a block that takes one turn. What answers say is written when
//! the loop is closed: answers that differ from the first turn become what is carried from turn to turn.
//! A loop over a set asks only of what speaks of the set's first element: each in turn, or always this one?

mod second_turn;

pub(crate) use second_turn::{Tried, asked_drawing, foresee};

use super::blocks::{self, Block, Kind};
use super::operands::{self, Occurrence};
use super::outcome::{self, Worth};
use super::view::{Ends, Prompt, RecurrenceQuestion, Wants};
use super::{Around, Home, recording, scene, steps, text, typed};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::{Change, Refusal};
use crate::words;
use base::{Name, Span};
use kernel::Path;
use std::collections::BTreeSet;
use syntax::SyntaxKind;
use syntax::ast::{AstNode, ListExpr};

/// A loop whose first turn is drawn.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct Loop {
    /// Once the turn is drawn: how the loop ends.
    ends: Option<Ends>,
    /// Once the turn is drawn: what is asked of the second.
    asked: Vec<Asked>,
    /// The set that it goes over, if it does.
    each: Option<Each>,
    /// How far on a place of a step was said to be last: the step, and what was typed.
    onward: Option<(String, String)>,
}

/// A set that a loop goes over.
#[derive(Clone, PartialEq, Eq, Debug)]
struct Each {
    /// What runs through it.
    element: String,
    /// Its first.
    first: String,
    /// What was caught, or taken in, in order: what is left out can be taken in again.
    caught: Vec<String>,
}

/// A question of the second turn.
#[derive(Clone, PartialEq, Debug)]
struct Asked {
    /// The step of the turn, by its address in the loop.
    step: String,
    /// Its operand: the label, or the place.
    slot: String,
    /// What it is in the first turn.
    first: String,
    /// Whether that is a number or a yes or no.
    is_value: bool,
    /// Whether it is what a block in the turn carries on.
    is_next: bool,
    /// What it is in the next turn, as the turn before calls it; itself for the same.
    answer: Option<String>,
}

impl Loop {
    /// Whether the first turn is drawn, so that the second is asked for.
    pub(crate) fn is_drawn(&self) -> bool {
        self.ends.is_some() || !self.asked.is_empty()
    }

    /// What runs through the set, of a loop over one.
    pub(crate) fn element(&self) -> Option<&str> {
        self.each.as_ref().map(|each| each.element.as_str())
    }

    /// The first of the set, of a loop over one.
    pub(crate) fn first_of_set(&self) -> Option<&str> {
        self.each.as_ref().map(|each| each.first.as_str())
    }

    /// What is said of the set's first, as it is said of each of the set: `element.radius * 2`.
    fn in_turn(&self, first: &str) -> Option<String> {
        self.each.as_ref().map(|each| text::renamed(first, &each.first, &each.element))
    }

    /// What was caught for the set, of a loop over one whose second turn is not asked about.
    pub(crate) fn caught(&self) -> &[String] {
        let each = self.each.as_ref().filter(|_| !self.is_drawn());
        each.map_or(&[], |each| &each.caught)
    }

    /// Makes it agree with the text, which undo may have changed. What was asked of another first figure is forgotten.
    pub(crate) fn agree(&mut self, set: &[String]) {
        if let (Some(each), Some(first)) = (&mut self.each, set.first())
            && each.first != *first
        {
            each.first.clone_from(first);
            self.asked.clear();
        }
    }

    /// The question that is open.
    pub(crate) fn question(&self) -> Option<RecurrenceQuestion> {
        let at = self.asked.iter().position(|asked| asked.answer.is_none())?;
        let asked = &self.asked[at];
        Some(RecurrenceQuestion {
            number: at + 1,
            of: self.asked.len(),
            step: asked.step.clone(),
            operand: match asked.is_next {
                true => operands::next(&asked.slot),
                false => asked.slot.clone(),
            },
            first: asked.first.clone(),
            is_value: asked.is_value,
            in_turn: self.in_turn(&asked.first),
        })
    }

    /// How far on a place of a step was said to be, where the last answer said so.
    fn onward_of(&self, step: &str) -> Option<&str> {
        self.onward.as_ref().filter(|(of, _)| of == step).map(|(_, typed)| typed.as_str())
    }

    /// What is waited for, once the turn is drawn.
    pub(crate) fn prompt(&self) -> Option<Prompt> {
        if let Some(question) = self.question() {
            let is_next = self.asked[question.number - 1].is_next;
            let RecurrenceQuestion { number, of, step, operand, first, .. } = &question;
            // an `if` has no name
            let step = match step.rsplit('.').next().is_some_and(text::is_name) {
                true => step.as_str(),
                false => "the block",
            };
            let place = steps::as_typed(first, "");
            let first = place.as_ref().unwrap_or(first);
            let words = match &question.in_turn {
                Some(_) => format!(
                    "{operand} of {step} is {first}: each of the set in turn, or always this one?"
                ),
                // what a block in the turn carries on goes on from a place within it
                None if place.is_some() && !is_next => format!(
                    "{operand} of {step} was {first}: the same, which object of the turn before, or how far on, `@dx,dy`?{}",
                    self.onward_of(&question.step).map_or(String::new(), |typed| format!(
                        " Enter takes `{typed}` for all places left of {step}"
                    ))
                ),
                None => {
                    let what = if question.is_value { "value" } else { "object" };
                    format!(
                        "{operand} of {step} was {first}: the same, or which {what} of the turn before?"
                    )
                }
            };
            return Some(Prompt {
                label: format!("Second turn, {number} of {of}"),
                words,
                is_value: question.is_value,
                takes_sets: !question.is_value,
                goes_wider: !question.is_value,
                wants: Wants::Recurrence(question),
                ..Prompt::default()
            });
        }
        let ends = self.ends?;
        let (label, words) = match ends {
            Ends::Until => {
                ("Until", "what is true after the last turn? Compare measures by the calculator")
            }
            Ends::While => {
                ("While", "what is true before every turn? Compare measures by the calculator")
            }
            Ends::Times => ("Times", "how many turns?"),
        };
        Some(Prompt {
            label: label.into(),
            words: words.into(),
            is_value: true,
            wants: Wants::Ends(ends),
            ..Prompt::default()
        })
    }
}

/// Begins a loop in what is recorded: its first turn is drawn next.
///
/// # Errors
/// Nothing is recorded, the name is none or taken.
pub(crate) fn begin(open: &mut Open, host: &dyn Host, name: &str) -> Result<Change, Refusal> {
    let program = blocks::recorded(open)?.program.clone();
    let name = blocks::name_for(&text::Source::now(&open.state), &program, (name, "turns"))?;
    let around = Around { address: name.to_string(), name: Some(name.clone()), turn: Some(0) };
    let lines = format!("{name} = repeat {{\n}}");
    blocks::begin(
        open,
        host,
        (&lines, format!("repeat {name}")),
        (around, Kind::Loop(Loop::default())),
    )
}

/// Begins a loop over a set of figures, each by its name; what is done for the first is drawn next.
///
/// # Errors
/// Nothing is recorded, the set is empty, the name is none or taken.
pub(crate) fn begin_each(
    open: &mut Open,
    host: &dyn Host,
    (name, set): (&str, &[String]),
) -> Result<Change, Refusal> {
    let program = blocks::recorded(open)?.program.clone();
    let Some(first) = set.first() else {
        return Err(words::refuse("there is nothing of the program in that rectangle".into()));
    };
    let name = blocks::name_for(&text::Source::now(&open.state), &program, (name, "turns"))?;
    let element = blocks::name_for(&text::Source::now(&open.state), &program, ("", "element"))?;
    let around = Around { address: name.to_string(), name: Some(name.clone()), turn: Some(0) };
    let lines = format!("{name} = for {element} in [{}] {{\n}}", set.join(", "));
    let (element, first, caught) = (element.to_string(), first.clone(), set.to_vec());
    let it = Loop { each: Some(Each { element, first, caught }), ..Loop::default() };
    blocks::begin(open, host, (&lines, format!("for each {name}")), (around, Kind::Loop(it)))
}

/// The figures that a loop goes over, as its text names them, and where that stands.
pub(crate) fn set_of(
    source: &text::Source,
    program: &str,
    address: &str,
) -> Option<(Vec<String>, Span)> {
    let list = list_of(source, program, address)?;
    let names = list.elements().map(|one| one.syntax().text().to_string().trim().to_string());
    Some((names.collect(), list.span()))
}

/// Returns a text in which a loop goes over its set without a figure; nothing where it is not in the set, or alone there.
pub(crate) fn without_figure(
    source: &text::Source,
    (program, address): (&str, &str),
    figure: &str,
) -> Option<String> {
    let (mut set, span) = set_of(source, program, address)?;
    let all = set.len();
    set.retain(|name| name != figure);
    let (start, end) = (span.start as usize, span.end as usize);
    let is_less = !set.is_empty() && set.len() < all;
    is_less.then(|| format!("{}[{}]{}", &source[..start], set.join(", "), &source[end..]))
}

/// The list that a loop goes over.
fn list_of(source: &text::Source, program: &str, address: &str) -> Option<ListExpr> {
    let step = text::step_at(source, program, address)?;
    let Some(syntax::ast::Value::For(each)) = step.value else { return None };
    let Some(syntax::ast::Expr::List(list)) = each.range() else { return None };
    Some(list)
}

/// Writes a figure into a list before the element at an index, or behind the last one. What else stands in the list
/// stays.
fn insert_element(text: &mut String, list: &ListExpr, (at, figure): (usize, &str)) {
    if let Some(next) = list.elements().nth(at) {
        text.insert_str(next.span().start as usize, &format!("{figure}, "));
    } else if let Some(last) = list.elements().last() {
        text.insert_str(last.span().end as usize, &format!(", {figure}"));
    }
}

/// Takes the element at an index out of a list, with the comma behind it; with the one before it where it is the last.
/// What else stands in the list stays: its comments, too.
fn remove_element(text: &mut String, list: &ListExpr, at: usize) {
    let Some(one) = list.elements().nth(at).map(|one| one.span()) else { return };
    let tokens = list.syntax().children_with_tokens();
    let commas: Vec<usize> = tokens
        .filter(|token| token.kind() == SyntaxKind::Comma)
        .map(|token| usize::from(token.text_range().start()))
        .collect();
    let (start, end) = (one.start as usize, one.end as usize);
    let behind = commas.iter().find(|comma| **comma >= end);
    let Some(comma) = behind.or(commas.iter().rfind(|comma| **comma < start)).copied() else {
        text.replace_range(start..end, "");
        return;
    };
    let rest = &text[comma + 1..];
    let comma_end = text.len() - rest.trim_start_matches(' ').len();
    // the later one first: the places before it stay
    let (first, second) = if comma >= end {
        (comma..comma_end, start..end)
    } else {
        (start..end, comma..comma_end.min(start))
    };
    text.replace_range(first, "");
    text.replace_range(second, "");
}

/// Leaves a figure out of the set that the open loop goes over, or takes it in, as long as the second turn is not asked
/// about. In the set it stands where it was caught.
///
/// # Errors
/// No such loop is open; the first turn is drawn for this figure; the others would be none, or it is of another kind.
pub(crate) fn take_of_set(
    open: &mut Open,
    host: &dyn Host,
    figure: &str,
) -> Result<Change, Refusal> {
    let none = || words::refuse("no loop over a set is open".into());
    let Opened { mut it, program, address, .. } = opened(open)?;
    if it.is_drawn() {
        let message = "its second turn is asked about: take the answers back first";
        return Err(words::refuse(message.into()));
    }
    let each = it.each.as_mut().ok_or_else(none)?;
    let source = text::Source::now(&open.state);
    let list = list_of(&source, &program, &address).ok_or_else(none)?;
    let (mut set, _) = set_of(&source, &program, &address).ok_or_else(none)?;
    let mut edited = source.to_string();
    let is_out = !set.iter().any(|name| name == figure);
    let label = match is_out {
        true => {
            if !each.caught.iter().any(|name| name == figure) {
                each.caught.push(figure.into());
            }
            let place = |name: &String| each.caught.iter().position(|caught| caught == name);
            let own = place(&figure.to_string());
            let at = set.iter().position(|name| place(name) > own).unwrap_or(set.len());
            set.insert(at, figure.into());
            insert_element(&mut edited, &list, (at, figure));
            format!("take {figure} in")
        }
        false => {
            // wherever it stands
            while let Some(at) = set.iter().position(|name| name == figure) {
                set.remove(at);
                let now = text::Source::of(edited.clone());
                let list = list_of(&now, &program, &address).ok_or_else(none)?;
                remove_element(&mut edited, &list, at);
            }
            format!("leave {figure} out")
        }
    };
    let Some(first) = set.first() else {
        let message = format!("{figure} is all that is left: a loop goes over one figure at least");
        return Err(words::refuse(message));
    };
    let body = text::block(&source, &program, &address).ok_or_else(none)?;
    if *first != each.first && !questions(&body, Some(&each.first)).is_empty() {
        let message = format!(
            "the first turn is drawn for {}: the set begins with it; undo what is drawn first",
            each.first
        );
        return Err(words::refuse(message));
    }
    each.first.clone_from(first);
    let change = recording::retext(open, host, edited, label)?;
    keep(open, it);
    Ok(change)
}

/// The loop that is open, its home, and its address.
struct Opened {
    it: Loop,
    program: Name,
    /// The home of the loop's first turn.
    home: Home,
    address: String,
    name: Name,
}

fn opened(open: &mut Open) -> Result<Opened, Refusal> {
    let recording = blocks::recorded(open)?;
    let home = Home::of(Some(recording));
    let program = recording.program.clone();
    match recording.innermost() {
        Some(Block { kind: Kind::Loop(it), around, .. }) => Ok(Opened {
            it: it.clone(),
            program,
            address: text::address_of(&home),
            home,
            name: around.name.clone().unwrap_or_else(|| Name::new("")),
        }),
        _ => Err(words::refuse("no loop is open".into())),
    }
}

fn keep(open: &mut Open, it: Loop) {
    if let Some(block) = open.recording.as_mut().and_then(|r| r.blocks.last_mut()) {
        block.kind = Kind::Loop(it);
    }
}

/// Ends the first turn, and says how the loop will end. What is asked of the second turn is then waited for; a loop
/// over a set of which nothing is asked is closed at once.
///
/// # Errors
/// No loop is open, or nothing is drawn in it.
pub(crate) fn end_turn(
    open: &mut Open,
    host: &dyn Host,
    ends: Ends,
) -> Result<Option<Change>, Refusal> {
    let Opened { mut it, program, home, address, .. } = opened(open)?;
    let body = text::block(&text::Source::now(&open.state), &program, &address);
    let body = body.ok_or_else(|| words::refuse("the loop is gone".into()))?;
    if text::steps_of(&body).is_empty() {
        return Err(words::refuse("draw the first turn of the loop first".into()));
    }
    it.ends = it.each.is_none().then_some(ends);
    it.asked = questions(&body, it.first_of_set());
    for asked in &mut it.asked {
        let worth = outcome::worth(&open.state, &home, &asked.first);
        asked.is_value = matches!(worth, Ok(Worth::Truth(_) | Worth::Number(_)));
    }
    open.dialogue = None;
    let is_settled = it.asked.is_empty() && it.each.is_some();
    keep(open, it);
    is_settled.then(|| close(open, host, "")).transpose()
}

/// Goes on drawing the first turn: what was answered is forgotten.
pub(crate) fn back_to_turn(open: &mut Open) {
    if let Ok(Opened { it, .. }) = opened(open) {
        keep(open, Loop { each: it.each, ..Loop::default() });
    }
}

/// Takes the latest answer back; the last one before that is what was said of the turn being drawn.
pub(crate) fn back(open: &mut Open) {
    let Ok(Opened { mut it, .. }) = opened(open) else { return };
    match it.asked.iter_mut().rev().find(|asked| asked.answer.is_some()) {
        Some(asked) => {
            asked.answer = None;
            keep(open, it);
        }
        None => back_to_turn(open),
    }
}

/// Answers the open question: nothing for the same, else an object of the turn before, or an expression over it.
/// Where it was picked decides which way round a curve is taken. A loop over a set of which nothing more is asked is
/// closed.
///
/// # Errors
/// No question is open; the answer does not fit, or the second turn would have no outcome.
pub(crate) fn answer(
    open: &mut Open,
    host: &dyn Host,
    (answer, at): (Option<&str>, Option<(f64, f64)>),
) -> Result<Option<Change>, Refusal> {
    let mut it = opened(open)?.it;
    let (i, way) = way_of(open, host, (answer, at))?;
    it.asked[i].answer = Some(way);
    let is_settled = it.each.is_some() && it.question().is_none();
    keep(open, it);
    is_settled.then(|| close(open, host, "")).transpose()
}

/// Returns which question an answer is for, and what it is: where it was picked decides which way round.
///
/// # Errors
/// No question is open; the second turn would have no outcome.
fn way_of(
    open: &mut Open,
    host: &dyn Host,
    (answer, at): (Option<&str>, Option<(f64, f64)>),
) -> Result<(usize, String), Refusal> {
    let loop_now = opened(open)?;
    let Some(i) = loop_now.it.asked.iter().position(|asked| asked.answer.is_none()) else {
        return Err(words::refuse("nothing is asked".into()));
    };
    let first = loop_now.it.asked[i].first.clone();
    let answer = answer.map(str::trim).filter(|text| !text.is_empty());
    let in_turn = answer.and_then(|text| of_each(&open.state, (&loop_now, &first), text));
    let ways: Vec<String> = match (answer, in_turn) {
        (_, Some(in_turn)) => vec![in_turn],
        (None, _) => vec![first],
        (Some(text), _) if at.is_some() => vec![text.into(), outcome::turned_round(text)],
        (Some(text), _) => vec![text.into()],
    };
    let mut best: Option<(f64, String)> = None;
    let mut why = None;
    for way in ways {
        let mut tried = loop_now.it.clone();
        tried.asked[i].answer = Some(way.clone());
        match second_turn::run(open, host, (&loop_now, &tried, i), at) {
            Ok(away) if best.as_ref().is_none_or(|(least, _)| away < *least - 1e-9) => {
                best = Some((away, way));
            }
            Ok(_) => {}
            Err(message) => {
                why.get_or_insert(message);
            }
        }
    }
    let none = || words::refuse(why.unwrap_or_else(|| "there is no such turn".into()));
    best.map(|(_, way)| (i, way)).ok_or_else(none)
}

/// What an answer is for each of the set, where it says of the second what the first turn says of the first: that one is
/// shown for what comes in turn.
fn of_each(state: &State, (opened, first): (&Opened, &str), answer: &str) -> Option<String> {
    let set = set_of(&text::Source::now(state), &opened.program, &opened.address);
    let second = set?.0.into_iter().nth(1)?;
    let of_second = text::renamed(first, opened.it.first_of_set()?, &second);
    opened.it.in_turn(first).filter(|_| answer == of_second)
}

/// Answers the open question by what is typed; nothing takes how far on the last place was, for all of the step, and a
/// value as it was.
///
/// # Errors
/// Nothing is typed and no place was said to be further on; the answer does not fit.
pub(crate) fn answer_typed(
    open: &mut Open,
    host: &dyn Host,
    (home, question): (&Home, &RecurrenceQuestion),
    typed: &str,
) -> Result<Option<Change>, Refusal> {
    let step = &question.step;
    if !typed.trim().is_empty() {
        let text = as_typed(&open.state, home, question, typed)?;
        let closed = answer(open, host, (Some(&text), None))?;
        if let (None, Ok(Opened { mut it, .. })) = (&closed, opened(open)) {
            it.onward = typed::goes_from(typed).then(|| (step.clone(), typed.trim().into()));
            keep(open, it);
        }
        return Ok(closed);
    }
    let none = "pick an object of the turn before, type one, or press `The same`";
    let it = opened(open)?.it;
    // of a set there are two such answers
    if question.is_value && question.in_turn.is_none() && it.onward_of(step).is_none() {
        return answer(open, host, (None, None));
    }
    let typed = it.onward_of(step).ok_or_else(|| words::refuse(none.into()))?;
    let mut left = Some(question.clone());
    let is_place = |open: &Open, next: &RecurrenceQuestion| {
        next.step == *step && outcome::place(&open.state, home, &next.first).is_some()
    };
    while let Some(place) = left.filter(|next| is_place(open, next)) {
        let text = as_typed(&open.state, home, &place, typed)?;
        if let Some(closed) = answer(open, host, (Some(&text), None))? {
            return Ok(Some(closed));
        }
        left = opened(open)?.it.question();
    }
    Ok(None)
}

/// Returns an answer that is typed as the language writes it. A place goes on from where it was in the turn before.
///
/// # Errors
/// It goes on from a place that nothing of that turn has.
fn as_typed(
    state: &State,
    home: &Home,
    question: &RecurrenceQuestion,
    typed: &str,
) -> Result<String, Refusal> {
    let Some(was) = outcome::place(state, home, &question.first) else {
        return Ok(typed.trim().into());
    };
    if !typed::goes_from(typed) {
        return typed::at(typed, "");
    }
    let step = &question.step;
    let is_there = |found: &scene::Found| {
        let owner = found.text.strip_prefix(step.as_str());
        owner.is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
            && found.curve == was
    };
    let all = scene::scene(state, home);
    let none = || words::refuse(format!("{step} has no such place that {typed} could go on from"));
    let from = all.iter().find(|found| is_there(found)).ok_or_else(none)?;
    typed::at(typed, &from.text)
}

/// Closes the loop by what ends it: a condition, or a number of turns. It is one step.
///
/// # Errors
/// No loop is open, a question is; the condition is none.
pub(crate) fn close(open: &mut Open, host: &dyn Host, condition: &str) -> Result<Change, Refusal> {
    let loop_now = opened(open)?;
    if let Some(question) = loop_now.it.question() {
        let (step, operand) = (question.step, question.operand);
        return Err(words::refuse(format!("{operand} of {step} is asked first")));
    }
    let condition = condition.trim();
    if condition.is_empty() && loop_now.it.each.is_none() {
        return Err(words::refuse("say when the loop ends".into()));
    }
    let before_turn = |condition: &str| {
        // before a turn its steps are not made: what is carried is meant
        carried(&loop_now.it, &text::Source::now(&open.state), &loop_now.program)
            .iter()
            .fold(condition.to_string(), |text, (name, first, _)| text::renamed(&text, first, name))
    };
    let (head, tail) = match loop_now.it.ends {
        None if loop_now.it.each.is_some() => (None, String::new()),
        Some(Ends::Until) => (Some("repeat".to_string()), format!(" until {condition}")),
        Some(Ends::While) => (Some(format!("while {}", before_turn(condition))), String::new()),
        Some(Ends::Times) => (
            Some(format!("repeat {} times", condition.trim_end_matches("times").trim())),
            String::new(),
        ),
        None => return Err(words::refuse("end the first turn of the loop first".into())),
    };
    let source = text::Source::now(&open.state);
    let text = closed(&source, (&loop_now, &loop_now.it), (head.as_deref(), &tail))?;
    let label = match loop_now.it.each {
        Some(_) => format!("for each {}", loop_now.name),
        None => format!("repeat {}", loop_now.name),
    };
    let change = recording::retext(open, host, text, label)?;
    if let Some(why) = ended_in(open, &loop_now) {
        // the loop as it was asked for stands: another answer or condition can be given
        open.travel(crate::document::Direction::Back);
        open.undone.pop();
        return Err(words::refuse(why));
    }
    blocks::leave(open);
    Ok(change)
}

/// Why a run ended in the loop, if it did.
fn ended_in(open: &Open, opened: &Opened) -> Option<String> {
    let evaluator = open.state.evaluator(&open.state.values);
    let Home::Program { example, .. } = &opened.home else { return None };
    let thing = open.state.structure.follow(kernel::DOCUMENT, &Path::of(&[example])).ok()?;
    let run = evaluator.run(thing).ok()??;
    let ended = run.ended.as_ref()?;
    let is_here = ended.step.split(['.', '[']).any(|part| *part == *opened.name.as_str());
    is_here.then(|| ended.to_string())
}

/// What is carried from turn to turn by the answers that differ from the first turn: name, first, next.
fn carried(it: &Loop, source: &text::Source, program: &Name) -> Vec<(String, String, String)> {
    let mut taken: BTreeSet<String> = text::words_in(source, program);
    let mut all: Vec<(String, String, String)> = Vec::new();
    for asked in &it.asked {
        let Some(answer) = asked.answer.as_ref().filter(|answer| **answer != asked.first) else {
            continue;
        };
        if it.in_turn(&asked.first).as_ref() == Some(answer)
            || all.iter().any(|(_, f, n)| *f == asked.first && n == answer)
        {
            continue;
        }
        let plain = asked.slot.clone();
        let names = std::iter::once(plain.clone()).chain((2..).map(|i| format!("{plain}{i}")));
        let name = { names }.find(|name| !taken.contains(name)).unwrap_or(plain);
        taken.insert(name.clone());
        all.push((name, asked.first.clone(), answer.clone()));
    }
    all
}

/// Returns a text in which the loop says what its answers say; without a head, that stays.
fn closed(
    source: &text::Source,
    (opened, it): (&Opened, &Loop),
    (head, tail): (Option<&str>, &str),
) -> Result<String, Refusal> {
    let none = || words::refuse("the loop is gone".into());
    let body = text::block(source, &opened.program, &opened.address).ok_or_else(none)?;
    let (_, value) = text::step(source, &opened.program, &opened.address).ok_or_else(none)?;
    let carried = carried(it, source, &opened.program);
    let operands = operands::operands(&body);
    let mut edits: Vec<(Span, String)> = Vec::new();
    let mut rest = operands.iter();
    for asked in &it.asked {
        let is_it = |o: &&Occurrence| {
            o.step == asked.step && o.slot == asked.slot && o.first == asked.first
        };
        // the turn may have been changed since it was asked about
        let changed = || words::refuse("the first turn has changed: end it again".into());
        let found = rest.find(is_it).ok_or_else(changed)?;
        let Some(answer) = asked.answer.as_ref().filter(|answer| **answer != asked.first) else {
            continue;
        };
        let name = carried.iter().find(|(_, first, next)| *first == asked.first && next == answer);
        let name = name.map_or_else(|| answer.clone(), |(name, ..)| name.clone());
        edits.extend(found.again.map(|again| (again, name.clone())));
        edits.push((found.span, name));
    }
    let span = body.span();
    let (start, end) = (span.start as usize, span.end as usize);
    let mut inside = source[start..end].to_string();
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
        let Home::Program { way, .. } = &opened.home else { return Err(none()) };
        let (indent, outer) = ("    ".repeat(way.len() + 1), "    ".repeat(way.len()));
        inside = format!("{before}\n{indent}next {next}\n{outer}}}");
    }
    let begun = value.start as usize;
    let head = head.map_or_else(|| source[begun..start].trim_end().to_string(), String::from);
    let with = if with.is_empty() { String::new() } else { format!(" with {with}") };
    Ok(format!("{}{head}{with} {inside}{tail}{}", &source[..begun], &source[end..]))
}

/// Returns what the second turn is asked: every operand, in order, that speaks of something from outside; of a loop
/// over a set, of the set's first.
fn questions(body: &syntax::ast::Body, first_of_set: Option<&str>) -> Vec<Asked> {
    let asked = |o: Occurrence| Asked {
        step: o.step,
        slot: o.slot,
        first: o.first,
        is_value: false,
        is_next: o.is_next,
        answer: None,
    };
    let speaks = |o: &Occurrence| match first_of_set {
        Some(first) => !text::places_of(&o.first, first).is_empty(),
        None => true,
    };
    operands::operands(body).into_iter().filter(speaks).map(asked).collect()
}
