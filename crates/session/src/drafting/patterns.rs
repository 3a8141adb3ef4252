//! Whether a pattern makes the first of its figures: not where what it is of is drawn already.
//!
//! The run tells what is drawn, and what it is for. Where that changes, the patterns of it are settled again.

use super::catalogue::{self, First};
use super::{Home, recording, scene, text, typed, visit};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::Refusal;
use crate::words;
use base::{Name, Span};
use std::collections::BTreeMap;
use syntax::ast::{AstNode, Expr, UnaryOp, Value};

/// Returns whether a pattern of something makes the first.
pub(crate) fn first_of(state: &State, home: &Home, of: &str) -> First {
    let all = scene::standings(state, home);
    let is_there = typed::expression(of).and_then(|of| is_drawn(&all, &of));
    if is_there == Some(true) { First::There } else { First::Made }
}

/// Whether all of an expression is drawn; nothing where it speaks of something that was not made. What is only typed is
/// never drawn.
fn is_drawn(all: &BTreeMap<String, bool>, of: &Expr) -> Option<bool> {
    match of {
        Expr::List(list) => {
            let each: Option<Vec<bool>> = list.elements().map(|one| is_drawn(all, &one)).collect();
            each.map(|each| each.into_iter().all(|one| one))
        }
        Expr::Paren(paren) => is_drawn(all, &paren.inner()?),
        Expr::Unary(unary) if unary.op() == Some(UnaryOp::Negate) => {
            is_drawn(all, &unary.operand()?)
        }
        _ => {
            let path: String = of.syntax().text().to_string().split_whitespace().collect();
            if !path.chars().all(text::is_of_path) {
                return Some(false);
            }
            let head = path.split(['.', '[']).next().unwrap_or_default();
            // what something answers is drawn nowhere
            let is_made = |path: &String| path.split(['.', '[']).next() == Some(head);
            all.get(&path).copied().or_else(|| all.keys().any(is_made).then_some(false))
        }
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
        let is_there =
            home.and_then(|home| is_drawn(&scene::standings(&state, &home), &pattern.what));
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
