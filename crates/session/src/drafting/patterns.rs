//! Whether a pattern makes the first of its figures: not where what it is of is drawn already.
//!
//! The run tells what is drawn, and what it is for. Where that changes, the patterns of it are settled again.

use super::catalogue::{self, First};
use super::{Home, recording, scene, text, typed, visit};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::Refusal;
use crate::views::drawn;
use crate::words;
use base::{Name, Span};
use eval::{Answer, Standing};
use kernel::{DOCUMENT, Path};
use std::collections::BTreeMap;
use std::rc::Rc;
use syntax::ast::{self, AstNode, Expr, UnaryOp, Value};

/// Returns whether a pattern of something makes the first.
pub(crate) fn first_of(state: &State, home: &Home, of: &str) -> First {
    let is_there = typed::expression(of).and_then(|of| Drawn::of(state, home).is_there(&of));
    if is_there == Some(true) { First::There } else { First::Made }
}

/// What is drawn where a pattern stands.
struct Drawn<'s> {
    state: &'s State,
    home: &'s Home,
    /// Whether each figure, and each set of them, is drawn.
    all: BTreeMap<String, bool>,
}

impl<'s> Drawn<'s> {
    fn of(state: &'s State, home: &'s Home) -> Self {
        Self { state, home, all: scene::standings(state, home) }
    }

    /// Whether all of an expression is drawn; nothing where it speaks of something that was not made. What is only
    /// typed is never drawn.
    fn is_there(&self, of: &Expr) -> Option<bool> {
        match of {
            Expr::List(list) => {
                let each: Option<Vec<bool>> =
                    list.elements().map(|one| self.is_there(&one)).collect();
                each.map(|each| each.into_iter().all(|one| one))
            }
            Expr::Paren(paren) => self.is_there(&paren.inner()?),
            Expr::Unary(unary) if unary.op() == Some(UnaryOp::Negate) => {
                self.is_there(&unary.operand()?)
            }
            // it is the same figure that runs the other way
            Expr::Field(field) if is_word(field, "reversed") => self.is_there(&field.receiver()?),
            _ => {
                let path: String = of.syntax().text().to_string().split_whitespace().collect();
                if !path.chars().all(text::is_of_path) {
                    return Some(false);
                }
                self.is_path_there(&self.counted(&path))
            }
        }
    }

    fn is_path_there(&self, path: &str) -> Option<bool> {
        let head = |path: &str| path.split(['.', '[']).next().unwrap_or_default().to_string();
        // what something answers is drawn nowhere
        let is_made = |of: &String| head(of) == head(path);
        match self.all.get(path) {
            // what a turn begins with is no step, but may have been drawn by one
            Some(false) => Some(self.is_carried_there(path)),
            Some(true) => Some(true),
            None => self.all.keys().any(is_made).then_some(false),
        }
    }

    /// A path whose ends of lists are said by their numbers: `turns[2].c` for `turns.last.c`.
    fn counted(&self, path: &str) -> String {
        let mut said = String::new();
        for name in path.split('.') {
            let (word, index) = name.split_at(name.find('[').unwrap_or(name.len()));
            let set = format!("{said}[");
            let numbers = self.all.keys().filter_map(|of| of.strip_prefix(&set));
            let number = |rest: &str| rest.split(']').next().and_then(|n| n.parse::<usize>().ok());
            let end = match word {
                "first" => numbers.filter_map(number).min(),
                "last" => numbers.filter_map(number).max(),
                _ => None,
            };
            match end {
                Some(end) => said.push_str(&format!("[{end}]{index}")),
                None if said.is_empty() => said.push_str(name),
                None => said.push_str(&format!(".{name}")),
            }
        }
        said
    }

    /// Whether what turns begin with by a name was drawn, for each of the turns.
    fn is_carried_there(&self, name: &str) -> bool {
        let Home::Program { example, .. } = self.home else { return false };
        let evaluator = self.state.evaluator(&self.state.values);
        let Ok(thing) = self.state.structure.follow(DOCUMENT, &Path::of(&[example])) else {
            return false;
        };
        let Ok(Some(run)) = evaluator.run(thing) else { return false };
        let (mut drawn, mut begun) = (Vec::new(), Vec::new());
        let all = (&Answer::Context(run), Standing::Result);
        drawn::walk(
            &self.state.lowered.document,
            all,
            &mut String::new(),
            &mut |made, is, path| {
                match is {
                    Standing::Result => drawn.push(made.clone()),
                    Standing::Carried => begun.push((unnumbered(path), made.clone())),
                    Standing::Guide | Standing::Erased => {}
                }
                is == Standing::Result && !matches!(made, Answer::Made(_))
            },
        );
        let own = unnumbered(&self.home.path().to_string());
        let own = own.split_once('.').map_or("", |(_, own)| own);
        // a name is of the innermost loop that has it
        let around = (0..=own.len()).rev().filter(|&end| {
            own.is_char_boundary(end) && own[end..].chars().next().is_none_or(|next| next == '.')
        });
        let mut carried = around.map(|end| text::joined(&own[..end], name));
        let of = carried.find_map(|path| {
            let of: Vec<_> = begun.iter().filter(|(of, _)| *of == path).collect();
            (!of.is_empty()).then_some(of)
        });
        of.is_some_and(|of| of.iter().all(|(_, answer)| is_among(&drawn, answer)))
    }
}

/// Whether a field is a message without operands.
fn is_word(field: &ast::FieldExpr, word: &str) -> bool {
    field.args().is_none() && field.name().is_some_and(|name| name.text() == word)
}

/// A path without the numbers of turns and figures.
fn unnumbered(path: &str) -> String {
    let parts = path.split('[').enumerate();
    parts
        .map(|(i, part)| if i == 0 { part } else { part.split_once(']').map_or("", |p| p.1) })
        .collect()
}

/// Whether something, or all that is drawn of it, is among what was drawn.
fn is_among(drawn: &[Answer<'_>], answer: &Answer<'_>) -> bool {
    match answer {
        Answer::List(items) => items.iter().all(|item| is_among(drawn, item)),
        Answer::Context(turn) => {
            let mut result = turn.made.iter().filter(|e| e.standing == Standing::Result);
            result.all(|entry| is_among(drawn, &entry.answer))
        }
        _ => drawn.iter().any(|other| is_one(other, answer)),
    }
}

/// Whether two answers are one figure: of one class, with the same numbers.
fn is_one(a: &Answer<'_>, b: &Answer<'_>) -> bool {
    match (a, b) {
        (Answer::Made(a), Answer::Made(b)) => {
            let mut fields = a.fields.iter().zip(&b.fields);
            Rc::ptr_eq(a, b) || a.class == b.class && fields.all(|(a, b)| is_one(a, b))
        }
        (Answer::Number(a, _), Answer::Number(b, _)) => a.to_bits() == b.to_bits(),
        (Answer::Bool(a), Answer::Bool(b)) => a == b,
        (Answer::Text(a), Answer::Text(b)) => a == b,
        (Answer::Thing(a), Answer::Thing(b)) => a == b,
        (Answer::Option(_, a), Answer::Option(_, b)) => a == b,
        (Answer::List(a), Answer::List(b)) => {
            a.len() == b.len() && a.iter().zip(b.iter()).all(|(a, b)| is_one(a, b))
        }
        _ => false,
    }
}

/// A step that is a pattern.
struct Step {
    /// What it is of.
    what: Expr,
    /// Whether it makes the first.
    first: First,
    /// Where that is written.
    span: Span,
}

fn pattern_at(source: &text::Source, program: &str, address: &str) -> Option<Step> {
    let Some(Value::Expr(formula)) = text::step_at(source, program, address)?.value else {
        return None;
    };
    let catalogue::Written { first, from, parts, .. } = catalogue::pattern_of(&formula)?;
    let (_, what) = parts.into_iter().find(|(slot, _)| *slot == "what")?;
    Some(Step { what, first, span: from })
}

/// Lists the patterns in those of some steps that are loops: what a turn begins with may be drawn now, or no longer.
pub(crate) fn within(source: &text::Source, program: &str, steps: &[String]) -> Vec<String> {
    let mut found = Vec::new();
    let mut todo = steps.to_vec();
    while let Some(address) = todo.pop() {
        let Some(value) = text::step_at(source, program, &address).and_then(|step| step.value)
        else {
            continue;
        };
        for (branch, inner) in text::inner_steps(&value) {
            let around = text::joined(&address, branch);
            todo.extend(inner.iter().map(|step| text::joined(&around, &step.segment)));
        }
        if pattern_at(source, program, &address).is_some() && !steps.contains(&address) {
            found.push(address);
        }
    }
    found
}

/// Lists those of some steps that are patterns of what an address leads to.
pub(crate) fn among(
    source: &text::Source,
    program: &str,
    (steps, of): (&[String], &str),
) -> Vec<String> {
    let is_of = |step: &&String| {
        pattern_at(source, program, step).is_some_and(|pattern| {
            let what = pattern.what.syntax().text().to_string();
            of.split('.').any(|name| !text::places_of(&what, name).is_empty())
        })
    };
    steps.iter().filter(is_of).cloned().collect()
}

/// Returns an edited text in which patterns make the first, or do not, by what they are of then.
///
/// # Errors
/// The example does not draw what a pattern is of, so that nothing tells.
pub(crate) fn settled(
    open: &Open,
    host: &dyn Host,
    program: &Name,
    (edited, steps): (String, &[String]),
) -> Result<String, Refusal> {
    let source = text::Source::of(edited.clone());
    let patterns: Vec<(&String, Step)> =
        steps.iter().filter_map(|step| Some((step, pattern_at(&source, program, step)?))).collect();
    if patterns.is_empty() {
        return Ok(edited);
    }
    let (state, _) = State::of(edited.clone(), Some(&open.state), host, plan::Plans::default());
    if recording::new_error(&open.state, &state).is_some() {
        // what is wrong is said where the text is taken
        return Ok(edited);
    }
    let recorded = open.recording.as_ref().filter(|recording| recording.program == *program);
    let example = recorded.map(|recording| recording.example.clone());
    let example = example.or_else(|| recording::example_of(&state, program));
    let mut edits: Vec<(Span, First)> = Vec::new();
    for (address, pattern) in patterns {
        let home = example
            .as_ref()
            .and_then(|example| visit::home_of(&source, (program, example), address, &[]));
        let is_there = home.and_then(|home| Drawn::of(&state, &home).is_there(&pattern.what));
        let Some(is_there) = is_there else {
            let what = pattern.what.syntax().text().to_string();
            let name = address.rsplit('.').next().unwrap_or_default();
            let message = format!(
                "{name} is a pattern of {}, which is not drawn by these values: choose others first",
                what.trim()
            );
            return Err(words::refuse(message));
        };
        let first = if is_there { First::There } else { First::Made };
        if first != pattern.first {
            edits.push((pattern.span, first));
        }
    }
    edits.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
    let mut edited = edited;
    for (span, first) in edits {
        edited.replace_range(span.start as usize..span.end as usize, first.written());
    }
    Ok(edited)
}
