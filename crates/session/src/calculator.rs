//! The calculator: expressions over a document, with their values as they are now.

use crate::document::Open;
use crate::plotting;
use crate::state::State;
use crate::words;
use base::number::significant;
use eval::Answer;
use kernel::{DOCUMENT, Term, Values};
use std::rc::Rc;

/// So many digits of a coordinate are shown.
const DIGITS: usize = 6;

/// Expressions that were read in a state of the document.
pub(crate) struct Sums {
    state: Rc<State>,
    written: Vec<String>,
    terms: Vec<Result<Term, String>>,
}

/// Returns the value of each expression in words, as of the drag where one goes on, or why it has none. What was
/// read is kept while document and expressions are the same.
pub(crate) fn values(open: &mut Open, written: &[String]) -> Vec<Result<String, String>> {
    let is_known = |sums: &Sums| Rc::ptr_eq(&sums.state, &open.state) && sums.written == *written;
    if !open.sums.as_ref().is_some_and(is_known) {
        let read = |text: &String| match plotting::read(&open.state, &[text]) {
            Ok(mut terms) => terms.pop().ok_or_else(String::new),
            Err(refusal) => Err(refusal.message),
        };
        let terms = written.iter().map(read).collect();
        open.sums = Some(Sums { state: open.state.clone(), written: written.to_vec(), terms });
    }
    let Some(sums) = &open.sums else { return Vec::new() };
    let evaluator = open.state.evaluator(open.values());
    let mut values = Vec::with_capacity(sums.terms.len());
    for term in &sums.terms {
        let answer = term
            .as_ref()
            .map_err(Clone::clone)
            .and_then(|term| evaluator.evaluate(term, DOCUMENT).map_err(|fault| fault.message));
        values.push(answer.and_then(|answer| {
            in_words(&open.state, open.values(), &answer)
                .ok_or_else(|| format!("this is {}, and has no value to show", answer.kind()))
        }));
    }
    values
}

/// Returns an answer in words: a value with its unit, a place by its coordinates, a list by its elements.
fn in_words(state: &State, values: &Values, answer: &Answer<'_>) -> Option<String> {
    let document = &state.lowered.document;
    match answer {
        Answer::Thing(thing) => words::show_thing(state, *thing, values),
        Answer::Made(made) => {
            let fields: Option<Vec<String>> = made
                .fields
                .iter()
                .map(|field| match field {
                    Answer::Number(x, _) if document.is_place(made.class) => {
                        Some(significant(*x, DIGITS))
                    }
                    other => in_words(state, values, other),
                })
                .collect();
            Some(format!("({})", fields?.join(", ")))
        }
        Answer::List(items) => {
            let items: Option<Vec<String>> =
                items.iter().map(|item| in_words(state, values, item)).collect();
            Some(format!("[{}]", items?.join(", ")))
        }
        other => crate::views::answers::in_words(document, other),
    }
}
