//! An `if` by two demonstrations: the condition is given, the branch that is taken now is drawn; then the other one,
//! with the same values or under others.
//!
//! While the other branch is drawn with the same values, its condition is turned round in the text, so that it
//! is the one that runs; under other values it is turned round twice. What the example's values were comes back when the
//! `if` is ended. Until then both branches stand in the text: by one that is empty, or a condition that is turned round, an
//! `if` that was broken off is known.

use super::blocks::{self, Block, Kind};
use super::outcome::{self, Worth};
use super::own_values::{self, Meanwhile};
use super::view::{OpenKind, Prompt, Wants};
use super::{Around, Home, recording, text};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::{Change, Refusal};
use crate::words;
use syntax::ast::{AstNode, Body, Else, If, Value};

/// An `if` that is demonstrated.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Choice {
    /// When its first branch is taken.
    condition: String,
    /// Whether the branch that is drawn is that of the condition.
    is_then: bool,
    /// Whether the other branch is drawn.
    is_second: bool,
    /// Whether it is asked how the other branch shall be drawn.
    asks: bool,
    /// The example in the document's text when it was begun.
    example: Option<String>,
}

impl Choice {
    /// What it is, and what is drawn in it now.
    pub(crate) fn view(&self) -> (OpenKind, String) {
        let kind = if self.is_second { OpenKind::Otherwise } else { OpenKind::Then };
        let condition = &self.condition;
        let words = match self.is_then {
            true => format!("draw what is done if {condition}"),
            false => format!("draw what is done unless {condition}"),
        };
        (kind, words)
    }

    /// Whether the other branch is drawn.
    pub(crate) fn is_second(&self) -> bool {
        self.is_second
    }

    /// The branch that is drawn.
    pub(crate) fn branch(&self) -> &'static str {
        if self.is_then { "then" } else { "else" }
    }

    /// The first branch is drawn again, where values that took the other one, or the step that began it, were taken
    /// back; the other one, where they came again.
    pub(crate) fn agree(&mut self, state: &State, outside: &Home, it: &If) {
        let is_other = || worth(state, outside, &self.condition) == Some(!self.is_then);
        let is_second = match (it.turned_round(), it.turned_twice()) {
            (Some(_), _) => true,
            (None, Some(_)) => self.is_second != is_other(),
            (None, None) => false,
        };
        if self.is_second != is_second {
            (self.is_then, self.is_second) = (!self.is_then, is_second);
        }
    }

    /// What an `if` that was broken off is demonstrated by; nothing for one that is whole. Where it was drawn under other
    /// values, what the example was is the next of those that are kept.
    pub(crate) fn broken_off(
        state: &State,
        outside: &Home,
        (it, kept): (&If, &mut dyn Iterator<Item = String>),
    ) -> Option<Self> {
        let written = it.condition()?.syntax().text().to_string();
        let takes_then = worth(state, outside, written.trim()).unwrap_or(true);
        let choice = |condition: String, is_second, example| Self {
            condition,
            is_then: takes_then,
            is_second,
            asks: false,
            example,
        };
        if let Some(condition) = it.turned_twice() {
            return Some(choice(condition, true, kept.next()));
        }
        let own = || match outside {
            Home::Program { example, .. } => span_of(example, &state.text),
            Home::Document => None,
        };
        let own = own().map(|span| state.text[span].to_string());
        if let Some(condition) = it.turned_round() {
            return Some(choice(condition, true, own));
        }
        let bodies = Bodies::of(it)?;
        let is_second = match (bodies.then.is_empty(), bodies.other?.is_empty()) {
            (false, false) => return None,
            (true, true) => false,
            (is_then_empty, _) => is_then_empty == takes_then,
        };
        Some(choice(written.trim().into(), is_second, own))
    }

    /// What is waited for.
    pub(crate) fn prompt(&self) -> Option<Prompt> {
        let Self { condition, is_then, .. } = self;
        let holds = if *is_then { "does not hold" } else { "holds" };
        self.asks.then(|| Prompt {
            label: "Otherwise".into(),
            words: format!(
                "how is the other case drawn: with the same values, or with others? Set those first, so that {condition} {holds}"
            ),
            wants: Wants::Otherwise,
            ..Prompt::default()
        })
    }
}

/// What stands in the branches of an `if`.
struct Bodies {
    then: String,
    /// Nothing where there is no `else`.
    other: Option<String>,
}

impl Bodies {
    /// Reads them; nothing for a chain of `else if`.
    fn of(it: &If) -> Option<Self> {
        let inside = |body: Body| {
            let text = body.syntax().text().to_string();
            let inner = text.trim().strip_prefix('{').and_then(|rest| rest.strip_suffix('}'));
            inner.unwrap_or(&text).trim().to_string()
        };
        let other = match it.else_branch() {
            Some(Else::Body(body)) => Some(inside(body)),
            Some(Else::If(_)) => return None,
            None => None,
        };
        Some(Self { then: inside(it.then_body()?), other })
    }
}

/// Whether a condition holds, where that can be told.
fn worth(state: &State, outside: &Home, condition: &str) -> Option<bool> {
    match outcome::worth(state, outside, condition) {
        Ok(Worth::Truth(truth)) => Some(truth),
        Ok(Worth::Number(_) | Worth::Other(_)) | Err(_) => None,
    }
}

/// Begins an `if`: asks for its condition.
///
/// # Errors
/// Nothing is recorded.
pub(crate) fn ask(open: &mut Open) -> Result<(), Refusal> {
    open.dialogue = None;
    blocks::recorded(open)?.asks_condition = true;
    Ok(())
}

/// Begins the branch that a condition takes now.
///
/// # Errors
/// It is no condition; the text is none.
pub(crate) fn begin(open: &mut Open, host: &dyn Host, condition: &str) -> Result<Change, Refusal> {
    let home = Home::of(Some(blocks::recorded(open)?));
    let condition = &plain(condition);
    let is_then = match outcome::worth(&open.state, &home, condition)? {
        Worth::Truth(truth) => truth,
        Worth::Number(n) => {
            return Err(words::refuse(format!("{condition} is {n}, where a yes or no is wanted")));
        }
        Worth::Other(kind) => {
            return Err(words::refuse(format!(
                "{condition} is {kind}, where a yes or no is wanted"
            )));
        }
    };
    let segment = blocks::next_segment(&text::Source::now(&open.state), &home);
    let lines = format!("if {condition} {{\n}} else {{\n}}");
    let choice = Choice {
        condition: condition.into(),
        is_then,
        is_second: false,
        asks: false,
        example: example_text(open),
    };
    let address = format!("{segment}.{}", choice.branch());
    let around = Around { address, name: None, turn: None };
    let label = format!("if {condition}");
    let change = blocks::begin(open, host, (&lines, label), (around, Kind::Choice(choice)))?;
    if let Some(recording) = &mut open.recording {
        recording.asks_condition = false;
    }
    Ok(change)
}

fn opened(open: &mut Open) -> Result<(&mut Block, Choice), Refusal> {
    let none = || words::refuse("no `if` is open".into());
    let block = blocks::recorded(open)?.blocks.last_mut().ok_or_else(none)?;
    match &block.kind {
        Kind::Choice(choice) => {
            let choice = choice.clone();
            Ok((block, choice))
        }
        Kind::Loop(_) | Kind::Visited => Err(none()),
    }
}

/// The first branch is drawn: the other one is asked for.
///
/// # Errors
/// No `if` is open, or its second branch is.
pub(crate) fn otherwise(open: &mut Open) -> Result<(), Refusal> {
    let (block, choice) = opened(open)?;
    if choice.is_second {
        return Err(words::refuse("both cases are drawn: press `End if`".into()));
    }
    block.kind = Kind::Choice(Choice { asks: true, ..choice });
    open.dialogue = None;
    Ok(())
}

/// Goes on drawing the first branch.
pub(crate) fn back(open: &mut Open) {
    if let Ok((block, choice)) = opened(open) {
        block.kind = Kind::Choice(Choice { asks: false, ..choice });
    }
}

/// Begins the other branch: with the same values, or with those that the example has now.
///
/// # Errors
/// No `if` is open; the values do not take the other branch.
pub(crate) fn second(open: &mut Open, host: &dyn Host, is_same: bool) -> Result<Change, Refusal> {
    let (_, choice) = opened(open)?;
    let home = Home::of(open.recording.as_ref());
    let Home::Program { program, mut way, example, .. } = home else {
        return Err(words::refuse("nothing is recorded".into()));
    };
    let segment = way.pop().map_or(String::new(), |around| around.segment().to_string());
    let outside = Home::Program { program: program.clone(), example, way, before: None };
    let address = text::joined(&text::address_of(&outside), &segment);
    let now = outcome::worth(&open.state, &outside, &choice.condition)?;
    let is_other = now == Worth::Truth(!choice.is_then);
    if !is_same && !is_other {
        let (is, wanted) =
            if choice.is_then { ("holds", "does not") } else { ("does not hold", "does") };
        let message = format!(
            "{} still {is}: set parameters so that it {wanted}, or draw with the same values",
            choice.condition
        );
        return Err(words::refuse(message));
    }
    let source = text::Source::now(&open.state);
    let gone = || words::refuse("the `if` is gone".into());
    let Some(Value::If(it)) = text::step_at(&source, &program, &address).and_then(|s| s.value)
    else {
        return Err(gone());
    };
    let mut edited = source.to_string();
    if choice.is_then && it.else_branch().is_none() {
        let end = it.span().end as usize;
        let indent =
            "    ".repeat(address.split('.').filter(|s| !matches!(*s, "then" | "else")).count());
        edited.insert_str(end, &format!(" else {{\n{indent}}}"));
    }
    let condition = it.condition().ok_or_else(gone)?.span();
    let turned = match is_other {
        false => format!("not (({}))", choice.condition),
        true => format!("not (not (({})))", choice.condition),
    };
    edited.replace_range(condition.start as usize..condition.end as usize, &turned);
    if is_other
        && let Some(own) = &choice.example
        && let Some(now) = example_span(open, &edited)
    {
        edited = own_values::with(&edited, now.start, (Meanwhile::OtherCase, own));
    }
    let change = match edited == open.state.text {
        true => Change::default(),
        false => {
            let label = format!("otherwise {}", choice.condition);
            recording::retext(open, host, edited, label)?
        }
    };
    let choice = Choice { is_then: !choice.is_then, is_second: true, asks: false, ..choice };
    if let Some(block) = open.recording.as_mut().and_then(|r| r.blocks.last_mut()) {
        block.around.address = format!("{segment}.{}", choice.branch());
        block.kind = Kind::Choice(choice);
    }
    Ok(change)
}

/// Returns a condition that is none of those that are turned round.
fn plain(condition: &str) -> String {
    let mut condition = condition.trim().to_string();
    while let Some(inner) = If::inside_turned(&condition) {
        condition = format!("not ({})", inner.trim());
    }
    condition
}

/// Ends the `if`: the condition and the example's values are again what they were. It is one step.
///
/// # Errors
/// No `if` is open.
pub(crate) fn end(open: &mut Open, host: &dyn Host) -> Result<Change, Refusal> {
    let (_, choice) = opened(open)?;
    let Home::Program { program, mut way, example, .. } = Home::of(open.recording.as_ref()) else {
        return Err(words::refuse("nothing is recorded".into()));
    };
    let segment = way.pop().map_or(String::new(), |around| around.segment().to_string());
    let outside = Home::Program { program: program.clone(), example, way, before: None };
    let address = text::joined(&text::address_of(&outside), &segment);
    let mut edited = open.state.text.clone();
    let mut is_turned_twice = false;
    if let Some(Value::If(it)) =
        text::step_at(&text::Source::of(edited.clone()), &program, &address).and_then(|s| s.value)
        && let Some(condition) = it.condition()
    {
        is_turned_twice = it.turned_twice().is_some();
        let span = condition.span();
        edited.replace_range(span.start as usize..span.end as usize, &choice.condition);
    }
    edited = without_empty(&text::Source::of(edited), &program, (&address, &choice.condition))?;
    let mut own = choice.example;
    if is_turned_twice && let Some(now) = example_span(open, &edited) {
        let (without, kept) = own_values::taken(&edited, now.start, Meanwhile::OtherCase);
        (edited, own) = (without, own.or(kept));
    }
    if let Some(own) = own
        && let Some(now) = example_span(open, &edited)
    {
        edited.replace_range(now, &own);
    }
    let change = match edited == open.state.text {
        true => Change::default(),
        false => recording::retext(open, host, edited, format!("if {}", choice.condition))?,
    };
    blocks::leave(open);
    open.label_last(format!("if {}", choice.condition));
    Ok(change)
}

/// Returns a text in which an `if` has no empty branch.
///
/// # Errors
/// Both are empty.
fn without_empty(
    source: &text::Source,
    program: &str,
    (address, condition): (&str, &str),
) -> Result<String, Refusal> {
    let Some(Value::If(it)) = text::step_at(source, program, address).and_then(|s| s.value) else {
        return Ok(source.to_string());
    };
    let Some((then, Bodies { then: inside, other: Some(other) })) =
        it.then_body().zip(Bodies::of(&it))
    else {
        return Ok(source.to_string());
    };
    let (start, end) = (it.span().start as usize, it.span().end as usize);
    let (before, after) = (&source[..start], &source[end..]);
    let body = source[then.span().start as usize..then.span().end as usize].to_string();
    Ok(match (inside.is_empty(), other.is_empty()) {
        (false, false) => source.to_string(),
        (true, true) => {
            let message = "nothing is drawn in either case: draw something, or undo the `if`";
            return Err(words::refuse(message.into()));
        }
        (false, true) => format!("{before}if {condition} {body}{after}"),
        (true, false) => {
            let Some(Else::Body(other)) = it.else_branch() else { return Ok(source.to_string()) };
            let body = &source[other.span().start as usize..other.span().end as usize];
            let negated = plain(&format!("not ({condition})"));
            format!("{before}if {negated} {body}{after}")
        }
    })
}

/// Where the declaration of the example stands in a text.
pub(super) fn example_span(open: &Open, source: &str) -> Option<std::ops::Range<usize>> {
    span_of(&open.recording.as_ref()?.example, source)
}

fn span_of(example: &str, source: &str) -> Option<std::ops::Range<usize>> {
    let file = syntax::parse(base::FileId(0), source).file();
    file.members().find_map(|member| match member {
        syntax::ast::Member::Part(part) => {
            let is_it = part.names().any(|word| word.text() == example);
            let span = syntax::ast::span_without_doc(part.syntax());
            is_it.then_some(span.start as usize..span.end as usize)
        }
        _ => None,
    })
}

/// The declaration of the example in the document's text.
pub(super) fn example_text(open: &Open) -> Option<String> {
    let source = &open.state.text;
    example_span(open, source).map(|span| source[span].to_string())
}
