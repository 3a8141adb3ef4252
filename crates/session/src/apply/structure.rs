//! Commands that change structure: the smallest edit of the text that says so, and what is carried over to it.
//!
//! In: a command, or the edits of one. Out: the step, or why the text cannot say it.

use super::step_to;
use crate::document::Open;
use crate::general;
use crate::host::Host;
use crate::parting;
use crate::placing::{keep_layout, place_new_parts};
use crate::prototype;
use crate::sheet;
use crate::state::State;
use crate::texts::Texts;
use crate::view::{Change, Choice, Question, Refusal};
use crate::words;
use crate::write_back::{Edited, differing, settle_places, write_back};
use kernel::{Command, DOCUMENT, Path, SlotId, Step, Value, Values};
use std::collections::BTreeSet;

/// Applies a command that changes structure: the smallest edit of the text that says so.
pub(super) fn restructure(
    open: &mut Open,
    host: &dyn Host,
    command: &Command,
) -> Result<Change, Refusal> {
    if let Command::Edit { members, .. } = command
        && let Some(unit) = sheet::unit_from(&open.state, members)
    {
        return sheet::with_unit(open, host, unit, |open| restructured(open, host, command));
    }
    restructured(open, host, command)
}

fn restructured(open: &mut Open, host: &dyn Host, command: &Command) -> Result<Change, Refusal> {
    let done = restructuring(&open.state, command)?;
    restructured_by(open, host, command, done)
}

/// The same by edits that are known: of a deletion, for instance, those of several.
///
/// # Errors
/// The text would be wrong in a way that it was not before, or parts that are merged would contradict each other.
pub(crate) fn restructured_by(
    open: &mut Open,
    host: &dyn Host,
    command: &Command,
    done: lang::Restructuring,
) -> Result<Change, Refusal> {
    let before = open.state.clone();
    let mut edits = done.edits;
    if let Command::Unmerge(path) = command {
        edits = parting::edits(open, path, edits);
    }
    let text = syntax::edit::apply(&before.text, &edits);
    let plans = open.planner.take_plans();
    let joins = done.class.is_some() || matches!(command, Command::Edit { .. } | Command::Merge(_));
    let (state, mut planner) = match joins {
        true => State::of_joined(text, &before, host, plans),
        false => State::of(text, Some(&before), host, plans),
    };
    // what a reference names may be deleted: that it names nothing is said at its place
    let may_be_wrong = |d: &base::Diagnostic| {
        matches!(command, Command::Delete(_)) && d.code == "unknown-reference"
    };
    let is_error = |d: &&base::Diagnostic| d.severity == base::Severity::Error && !may_be_wrong(d);
    let errors = |s: &State| s.diagnostics.iter().filter(is_error).count() + s.untold.errors;
    if errors(&state) > errors(&before) {
        let new: Vec<base::Diagnostic> = state
            .diagnostics
            .iter()
            .filter(|d| !before.diagnostics.iter().any(|b| b.message == d.message))
            .cloned()
            .collect();
        open.give_up(planner);
        return Err(words::refusal_of_text(&state, &new));
    }
    let class = done.class.map(|c| before.lowered.document.classes[c].name.to_string());
    let anew = match command {
        Command::Unmerge(path) => parting::computed_anew(&before, path, &state, &mut planner),
        _ => BTreeSet::new(),
    };
    let carried = carried_over(command, &before, &state, &anew);
    let carried = carried.filter(|values| differing(&state, values).next().is_some());
    let settles = matches!(command, Command::Enable { .. }) || joins && carried.is_none();
    let (state, planner) = match (carried, &class) {
        (Some(mut values), _) => {
            // what holds no more is computed anew, so that no given number has to yield to what is kept
            let mut texts = Texts::new(&state.lowered.document, &state.structure);
            planner.satisfy_since(state.model(), &state.values, &mut values, &mut texts);
            let edited = Edited { by_hand: Some(Vec::new()), ..Edited::default() };
            write_back(&state, &values, &edited, host, planner.into_plans())
        }
        (None, Some(class)) => place_new_parts(&before, state, planner, class, host),
        (None, None) => (state, planner),
    };
    let (state, planner) = match settles {
        true => settle_places(&before, state, planner, host),
        false => (state, planner),
    };
    let (state, mut planner) = keep_layout(&before, state, planner, host);
    if matches!(command, Command::Merge(_)) && open.status.satisfied {
        let status = state.status(&mut planner);
        if let Some(refusal) = words::refusal_of_status(&state, &status) {
            open.give_up(planner);
            return Err(refusal);
        }
    }
    let label = crate::rules::step_label(&before, command);
    let change = step_to(open, label, state, planner);
    let class_of_one = done.class_of_one.filter(|_| class.is_none()).map(|p| p.to_string());
    Ok(Change { class_of_one, class, along: done.along, ..change })
}

/// Returns the edits of a command that changes structure.
///
/// # Errors
/// Why the text cannot say it, and the command that would do it for a whole class.
pub(crate) fn restructuring(
    state: &State,
    command: &Command,
) -> Result<lang::Restructuring, Refusal> {
    lang::edits_for(&state.lowered, &state.structure, command).map_err(|d| {
        let every = lang::for_every(&state.lowered, command).filter(|_| d.code == "of-a-class");
        let repairs = every.iter().map(words::command_label).collect();
        Refusal { repairs, ..words::refusal_of_text(state, &[d]) }
    })
}

/// Returns what goes along when something is deleted, as it is written.
pub(crate) fn along(state: &State, path: &Path) -> Vec<String> {
    restructuring(state, &Command::Delete(path.clone())).map(|done| done.along).unwrap_or_default()
}

/// Returns what has to be asked before a command is applied: whether it is meant of one thing, which
/// becomes a class of one, or of all things of its class. Nothing where there is nothing to ask.
///
/// # Errors
/// Why the command would be refused.
pub(crate) fn preview(state: &State, command: &Command) -> Result<Option<Question>, Refusal> {
    match command {
        Command::Set(_) | Command::Move(_) | Command::Text(_) | Command::Undo | Command::Redo => {
            return Ok(None);
        }
        Command::Merge(_)
        | Command::Unmerge(_)
        | Command::Delete(_)
        | Command::Edit { .. }
        | Command::Rename { .. }
        | Command::Promote { .. }
        | Command::Anchor { .. }
        | Command::Enable { .. } => {}
    }
    let every = || lang::for_every(&state.lowered, command);
    let all = |command: Command| {
        let label = words::command_label(&command);
        Choice { label, command }
    };
    let done = match restructuring(state, command) {
        Ok(done) => done,
        Err(refusal) if refusal.repairs.is_empty() => return Err(refusal),
        Err(refusal) => {
            let choices = every().into_iter().map(all).collect();
            return Ok(Some(Question { message: refusal.message, choices }));
        }
    };
    let Some(path) = done.class_of_one.filter(|_| done.class.is_none()) else { return Ok(None) };
    let thing = words::find(state, &path)?;
    let class = words::class_name(state, thing);
    let this = Choice { label: format!("only {path}"), command: command.clone() };
    let every = every().map(|command| Choice { label: format!("every {class}"), command });
    let label = words::command_label(command);
    let message = match &every {
        None => format!("{label}: then {path} is no longer like every {class}"),
        Some(_) => {
            let its = state.structure.things[thing].class;
            let things = state.structure.things.iter();
            let alike = things.filter(|(_, t)| state.lowered.document.is_a(t.class, its));
            let number = alike.count();
            format!("{label}: for {path} alone, or for every {class} ({number} here)?")
        }
    };
    Ok(Some(Question { message, choices: std::iter::once(this).chain(every).collect() }))
}

/// Returns the values that a document keeps where a command only takes away what held it: every path
/// keeps its present value, those of parts that are no longer one, too; or where the class of what is
/// merged says what it holds then. Of what is computed `anew` the present values are those that it was given.
fn carried_over(
    command: &Command,
    before: &State,
    after: &State,
    anew: &BTreeSet<SlotId>,
) -> Option<Values> {
    match command {
        Command::Unmerge(_)
        | Command::Delete(_)
        | Command::Merge(_)
        | Command::Anchor { .. }
        | Command::Enable { on: false, .. } => {}
        Command::Set(_)
        | Command::Move(_)
        | Command::Edit { .. }
        | Command::Rename { .. }
        | Command::Promote { .. }
        | Command::Enable { on: true, .. }
        | Command::Text(_)
        | Command::Undo
        | Command::Redo => return None,
    }
    let mut values = after.values.clone();
    if let Command::Merge(paths) = command {
        let holds = general::merged(before, paths);
        let slot = |path: &Path| {
            let thing = after.structure.follow(DOCUMENT, path).ok()?;
            after.structure.slot_of(thing)
        };
        let holds: Vec<(SlotId, Value)> =
            holds.into_iter().filter_map(|(path, value)| Some((slot(&path)?, value))).collect();
        let any = !holds.is_empty();
        holds.into_iter().for_each(|(slot, value)| values.put(slot, value));
        return any.then_some(values);
    }
    // things are the same where only what is said of them is another
    let are_same = after.structure.has_things_of(&before.structure);
    for (slot, s) in after.structure.slots.iter() {
        let mut thing = Some(s.thing);
        if !are_same {
            let path = after.slot_path(slot);
            if lang::is_count(&after.lowered, &path) {
                continue;
            }
            let path = before_deletion(command, after, path);
            thing = before.structure.follow(DOCUMENT, &path).ok();
        }
        let was = thing.and_then(|t| before.structure.slot_of(t));
        // how far parts stand beside each other is told by what shares their places now
        let is_lane = s.is_layout && s.place.is_none();
        let is_told_anew = is_lane || anew.contains(&slot);
        let is_kept = |was: &SlotId| !is_told_anew || before.structure.given(*was).is_some();
        if let Some(was) = was.filter(is_kept) {
            values.put(slot, before.values.get(was));
        }
    }
    Some(values)
}

/// Returns the path by which something was reached before an element of a list was deleted, of one thing
/// or of all things of a class.
fn before_deletion(command: &Command, after: &State, mut path: Path) -> Path {
    let Command::Delete(deleted) = command else { return path };
    let Some((Step::Index(gone), list)) = deleted.0.split_last() else { return path };
    let class = prototype::class_of(after, deleted);
    let document = &after.lowered.document;
    let of_class = class.and_then(|name| document.class_named(name));
    let (starts, list) = match of_class {
        Some(_) => (path.0.len(), &list[1..]),
        None => (1, list),
    };
    for start in 0..starts {
        let (owner, rest) = path.0.split_at(start);
        let is_owner = of_class.is_none_or(|class| {
            let thing = after.structure.follow(DOCUMENT, &Path(owner.to_vec()));
            thing.is_ok_and(|t| document.is_a(after.structure.things[t].class, class))
        });
        let at = start + list.len();
        if is_owner
            && rest.starts_with(list)
            && let Some(Step::Index(i)) = path.0.get_mut(at)
            && *i >= *gone
        {
            *i += 1;
            break;
        }
    }
    path
}
