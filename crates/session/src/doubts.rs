//! Doubts: what is drawn, but hardly as it was meant.
//!
//! A class tells them of its figures by a message `doubt` that is a text, and empty where there is none: a rectangle
//! whose width is negative is one, turned inside out. Nothing is refused for a doubt.

use crate::views::drawn;
use base::Name;
use eval::{Answer, Context, Evaluator, Standing};
use kernel::Document;
use std::rc::Rc;

/// The message by which a class tells them.
const DOUBT: &str = "doubt";
/// What is told of a run that has steps and no figure.
const NOTHING: &str = "the drawing is empty";
/// So many are told of a drawing.
const MOST: usize = 3;

/// Whether a message tells of doubts, and of none.
pub(crate) fn is_none(message: &Name, answer: &Answer<'_>) -> bool {
    message.as_str() == DOUBT && matches!(answer, Answer::Text(words) if words.is_empty())
}

/// Returns what a figure is doubtful for; nothing where its class tells of none.
pub(crate) fn of<'a>(
    document: &Document,
    evaluator: &Evaluator<'a>,
    answer: &Answer<'a>,
) -> Option<String> {
    document.find_message(evaluator.class_of(answer)?, DOUBT, None)?;
    match evaluator.of_part(answer, DOUBT).ok()? {
        Answer::Text(words) if !words.is_empty() => Some(words.to_string()),
        _ => None,
    }
}

/// Returns what the result of a run is doubtful for, the first of it, each with the path to the figure; empty where
/// nothing is.
pub(crate) fn of_run<'a>(
    document: &Document,
    evaluator: &Evaluator<'a>,
    run: &Rc<Context<'a>>,
) -> String {
    let mut found = Vec::new();
    let mut is_empty = true;
    let result = (&Answer::Context(run.clone()), Standing::Result);
    drawn::walk(document, result, &mut String::new(), &mut |answer, standing, path| {
        if standing != Standing::Result || found.len() >= MOST {
            return false;
        }
        is_empty &= matches!(answer, Answer::Context(_) | Answer::List(_));
        found.extend(of(document, evaluator, answer).map(|words| format!("{path}: {words}")));
        matches!(answer, Answer::Context(_) | Answer::List(_))
    });
    if is_empty && !run.made.is_empty() {
        return NOTHING.into();
    }
    found.join("; ")
}
