//! The second turn of a loop, as the answers so far make it.

use super::{Loop, Opened, closed, opened, way_of};
use crate::document::Open;
use crate::drafting::{outcome, recording, scene, text};
use crate::host::Host;
use crate::state::State;
use kernel::Path;
use std::rc::Rc;

/// States in which a loop took two turns, the latest last: what was asked of them is asked again while the pointer moves.
#[derive(Default)]
pub(crate) struct Tried(Vec<Trial>);

/// A state that was tried.
struct Trial {
    of: Rc<State>,
    written: String,
    outcome: Result<Rc<State>, String>,
}

/// So many states are kept: both ways of the latest answer, that before it, and one that is told apart from them.
const MOST_TRIED: usize = 4;

/// Returns the state in which the loop takes two turns, with the answers so far.
fn with_two_turns(
    open: &mut Open,
    host: &dyn Host,
    (opened, it): (&Opened, &Loop),
) -> Result<Rc<State>, String> {
    let state = open.state.clone();
    let head = if it.each.is_some() { None } else { Some("repeat 2 times") };
    let written = closed(&text::Source::now(&state), (opened, it), (head, ""));
    let written = written.map_err(|refusal| refusal.message)?;
    let all = &mut open.tried.0;
    all.retain(|trial| Rc::ptr_eq(&trial.of, &state));
    if let Some(known) = all.iter().position(|trial| trial.written == written) {
        // the one that was asked for last is forgotten last
        let known = all.remove(known);
        let outcome = known.outcome.clone();
        all.push(known);
        return outcome;
    }
    let (tried, _) = State::of(written.clone(), Some(&state), host, plan::Plans::default());
    let outcome = match recording::new_error(&state, &tried) {
        Some(wrong) => Err(wrong),
        None => Ok(Rc::new(tried)),
    };
    if all.len() == MOST_TRIED {
        all.remove(0);
    }
    all.push(Trial { of: state, written, outcome: outcome.clone() });
    outcome
}

/// The path to the second turn.
fn second_path(opened: &Opened) -> Path {
    let mut path = opened.home.path();
    path.0.pop();
    path.then(kernel::Step::Index(1))
}

/// Runs the second turn with the answers so far; says how far the step of a question lies from a place.
pub(super) fn run(
    open: &mut Open,
    host: &dyn Host,
    (opened, it, i): (&Opened, &Loop, usize),
    at: Option<(f64, f64)>,
) -> Result<f64, String> {
    let tried = with_two_turns(open, host, (opened, it))?;
    let evaluator = tried.evaluator(&tried.values);
    let example = opened.home.path().0.first().cloned();
    let thing =
        example.and_then(|step| tried.structure.follow(kernel::DOCUMENT, &Path(vec![step])).ok());
    // what failed in the second turn ended the run
    if let Some(Ok(Some(run))) = thing.map(|thing| evaluator.run(thing))
        && let Some(ended) = &run.ended
        && ended.step.contains(&format!("{}[1]", opened.name))
    {
        return Err(ended.reason.clone());
    }
    let turn = second_path(opened);
    let made = { it.asked[i].step.split('.') }.filter(|s| text::is_name(s));
    let path = made.fold(turn, |path, name| path.then(kernel::Step::Part(name.into())));
    // what the second turn does not come to has no place
    let curve = evaluator.at(&path).ok().and_then(|a| scene::Curve::of(&evaluator, &a));
    Ok(curve.zip(at).map_or(0.0, |(curve, at)| curve.distance(at)))
}

/// Runs the second turn as it will be asked for: with no answer yet, or with what is picked next of what lies at a
/// place. What is wrong with it is told when it is asked for.
pub(crate) fn foresee(open: &mut Open, host: &dyn Host, picks: Option<(&str, (f64, f64))>) {
    let Ok(opened) = opened(open) else { return };
    if let Some((found, at)) = picks {
        let _ = way_of(open, host, (Some(found), Some(at)));
        return;
    }
    let source = text::Source::now(&open.state);
    let body = text::block(&source, &opened.program, &opened.address);
    if opened.it.asked.is_empty() && body.is_some_and(|body| !text::steps_of(&body).is_empty()) {
        let _ = with_two_turns(open, host, (&opened, &opened.it));
    }
}

/// Returns what is asked about now, and the second turn as the answers so far make it.
pub(crate) fn asked_drawing(open: &mut Open, host: &dyn Host) -> drawing::Drawing {
    let state = open.state.clone();
    let Ok(opened) = opened(open) else { return drawing::Drawing::default() };
    let Some(question) = opened.it.question() else { return drawing::Drawing::default() };
    let mut elements = Vec::new();
    for name in names_in(&question.first) {
        elements.extend(scene::drawing_of(&state, &opened.home, &name).elements);
    }
    // what is no name is lit as what it comes to: `Point(pitch / 2, 0)`
    let first = [question.first.clone()];
    outcome::try_all(&state, &opened.home, &first, &mut |_, evaluator, answer| {
        elements.extend(answer.iter().flat_map(|answer| scene::elements_of(evaluator, answer)));
    });
    if let Ok(tried) = with_two_turns(open, host, (&opened, &opened.it)) {
        let evaluator = tried.evaluator(&tried.values);
        if let Ok(answer) = evaluator.at(&second_path(&opened)) {
            elements.extend(scene::elements_of(&evaluator, &answer));
        }
    }
    drawing::Drawing { elements, ..drawing::Drawing::default() }
}

/// The paths that an expression speaks of.
fn names_in(text: &str) -> Vec<String> {
    text.split(|c| !text::is_of_path(c))
        .filter(|w| w.starts_with(char::is_alphabetic))
        .map(String::from)
        .collect()
}
