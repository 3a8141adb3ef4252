//! Setting what an expression of constants gives: `g: Acceleration = constants.g`.
//!
//! A value that is set over an expression is solved back to what that speaks of. Constants never yield: as what an
//! anchor holds, such a part is changed by a set on exactly its path, which takes the place of the expression.

use crate::apply;
use crate::document::Open;
use crate::host::Host;
use crate::session::thing_at;
use crate::state::State;
use crate::view::{Change, Refusal};
use crate::words;
use kernel::{Command, Literal, Path, ThingId};

/// Sets some parts, those that are given by expressions of constants in their text; nothing where none is.
pub(crate) fn set(
    open: &mut Open,
    host: &dyn Host,
    targets: &[(Path, Literal)],
) -> Option<Result<Change, Refusal>> {
    let state = open.state.clone();
    let is_over =
        |path: &Path| thing_at(&state, path).is_some_and(|at| is_of_constants(&state, at));
    let (over, others): (Vec<_>, Vec<_>) = targets.iter().cloned().partition(|t| is_over(&t.0));
    if over.is_empty() {
        return None;
    }
    let since = open.done.len();
    let done = open.tried(|open| {
        let change = write_over(open, host, &over)?;
        match others.is_empty() {
            true => Ok(change),
            false => apply::apply(open, host, &Command::Set(others)),
        }
    });
    Some(done.map(|change| {
        open.one_step(since);
        let whole = apply::change(change.label.clone(), &state, &open.state);
        Change { edits: whole.edits, moved: whole.moved, structure: whole.structure, ..change }
    }))
}

/// Whether a part is given by an expression that speaks of constants alone. What an anchor holds may be let go.
fn is_of_constants(state: &State, part: ThingId) -> bool {
    let (document, structure) = (&state.lowered.document, &state.structure);
    if !structure.slots_under(part).iter().any(|slot| structure.bound.contains(slot)) {
        return false;
    }
    let evaluator = state.evaluator(&state.values);
    structure.constraints.iter().any(|instance| {
        let class = &document.classes[instance.class];
        let at = class.bindings.binary_search_by_key(&instance.index, |b| b.constraint);
        let of = |path: &Path| structure.follow(instance.owner, path).ok();
        let Some(binding) = at.ok().map(|at| &class.bindings[at]) else { return false };
        let methods = &class.constraints[instance.index as usize].methods;
        let Some(value) = methods.first().and_then(|method| method.values.first()) else {
            return false;
        };
        if of(&binding.path) != Some(part) {
            return false;
        }
        let (_, read) = evaluator.listening(|| evaluator.evaluate(value, instance.owner));
        !read.is_empty() && read.iter().all(|slot| state.is_constant(*slot))
    })
}

/// Has the text give parts these values where it gives expressions.
fn write_over(
    open: &mut Open,
    host: &dyn Host,
    over: &[(Path, Literal)],
) -> Result<Change, Refusal> {
    let state = open.state.clone();
    let edits = lang::write_values(&state.lowered, over);
    let text = syntax::edit::apply(&state.text, &edits);
    let (next, mut planner) = State::written(text, &state, host, open.planner.take_plans());
    let status = next.status(&mut planner);
    let refusal = words::refusal_of_status(&next, &status).filter(|_| open.status.satisfied);
    let refusal = match next.has_errors() && !state.has_errors() {
        true => Some(words::refusal_of_text(&next, &next.diagnostics)),
        false => refusal,
    };
    if let Some(refusal) = refusal {
        open.give_up(planner);
        return Err(refusal);
    }
    let label = words::command_label(&Command::Set(over.to_vec()));
    Ok(apply::step_to(open, format!("set {label}"), next, planner))
}
