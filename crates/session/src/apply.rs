//! Commands applied: each gives the next state, or a refusal that changed nothing.

use crate::difference::{difference, label_of_text};
use crate::document::{Direction, Open};
use crate::drag::{self, coordinates};
use crate::expected::Unasked;
use crate::following;
use crate::general;
use crate::host::Host;
use crate::limits;
use crate::over_constants;
use crate::prototype;
use crate::state::State;
use crate::texts::Texts;
use crate::view::{Change, DragState, Limit, Refusal};
use crate::views::analysis::only_reading;
use crate::words;
use crate::write_back::{Edited, differing, sides_after, write_back, write_sides};
use base::number::Toward;
use kernel::{
    ClassId, Command, DOCUMENT, Literal, Path, SlotId, Step, Term, ThingId, Value, Values,
};
use plan::{EditKind, LimitKind, NotDecided, Planner, RefusalReason, Target};
use std::collections::BTreeSet;
use std::sync::Arc;

mod structure;

use structure::restructure;
pub(crate) use structure::{along, preview, restructured_by, restructuring};

/// Applies a command to a document.
///
/// # Errors
/// Why it was refused; then nothing has changed.
pub(crate) fn apply(
    open: &mut Open,
    host: &dyn Host,
    command: &Command,
) -> Result<Change, Refusal> {
    let before = open.state.clone();
    let change = apply_by(open, host, command, Mover::Lab)?;
    crate::drafting::settle(open);
    if let Command::Set(_) | Command::Move(_) = command {
        crate::drafting::keep_own(open, host, &before);
    }
    Ok(change)
}

/// Applies a command as a hand gives it: a handle that is moved is dragged.
///
/// # Errors
/// Why it was refused; then nothing has changed.
pub(crate) fn by_hand(
    open: &mut Open,
    host: &dyn Host,
    command: &Command,
) -> Result<Change, Refusal> {
    apply_by(open, host, command, Mover::Hand)
}

/// Who moves something.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Mover {
    /// A hand: what a handle keeps stays meanwhile.
    Hand,
    /// The lab itself: places go where they are to be, and nothing is kept.
    Lab,
}

pub(crate) fn apply_by(
    open: &mut Open,
    host: &dyn Host,
    command: &Command,
    mover: Mover,
) -> Result<Change, Refusal> {
    for path in general::changed(command) {
        general::accept(&open.state, path)?;
    }
    // of a class, too: its prototype has values, constraints are said in its text
    if let Command::Set(targets) = command
        && targets.iter().any(|t| lang::of_constraint(&open.state.lowered, &t.0).is_some())
    {
        return restructure(open, host, command);
    }
    if let Command::Set(targets) = command
        && let Some(change) = over_constants::set(open, host, targets)
    {
        return change;
    }
    if let Command::Set(targets) | Command::Move(targets) = command
        && !targets.iter().all(|(_, value)| matches!(value, Literal::Path(_)))
        && let Some(class) = targets.first().and_then(|t| prototype::class_of(&open.state, &t.0))
    {
        return prototype::edit(open, host, (command, mover), targets, class);
    }
    if let (Mover::Hand, Command::Move(targets)) = (mover, command)
        && let [(path, to @ Literal::Tuple(_))] = targets.as_slice()
        && drag::is_handle(&open.state, path)
    {
        return drag::at_once(open, host, path, to);
    }
    match command {
        Command::Set(targets) if targets.iter().any(|t| is_structure(&open.state, t)) => {
            restructure(open, host, command)
        }
        Command::Set(targets) => edit(open, host, EditKind::Set, targets),
        Command::Move(targets) => edit(open, host, EditKind::Move, targets),
        Command::Text(text) => Ok(take_text(open, host, text)),
        Command::Undo => travel(open, host, Direction::Back),
        Command::Redo => travel(open, host, Direction::Forth),
        Command::Merge(_)
        | Command::Unmerge(_)
        | Command::Delete(_)
        | Command::Edit { .. }
        | Command::Rename { .. }
        | Command::Promote { .. }
        | Command::Anchor { .. }
        | Command::Enable { .. } => restructure(open, host, command),
    }
}

/// Returns true for what is set by an edit of the structure: counts, and what a part names.
fn is_structure(state: &State, (path, value): &(Path, Literal)) -> bool {
    matches!(value, Literal::Path(_)) || lang::is_count(&state.lowered, path)
}

/// What an edit speaks of: a thing, or a virtual part of one.
pub(crate) enum Aim {
    Thing(ThingId),
    Term(Term),
}

fn edit(
    open: &mut Open,
    host: &dyn Host,
    kind: EditKind,
    targets: &[(Path, Literal)],
) -> Result<Change, Refusal> {
    let state = open.state.clone();
    let label = label(kind, &state, targets);
    let mut aims: Vec<(Aim, Vec<Value>)> = Vec::new();
    let parts: Vec<(Path, Literal)> = targets.iter().flat_map(|t| in_parts(&state, t)).collect();
    for (path, literal) in &parts {
        aims.push((aim(&state, path)?, flat(literal)));
    }
    let targets: Vec<(Target<'_>, Vec<Value>)> = aims
        .iter()
        .map(|(aim, values)| {
            let target = match aim {
                Aim::Thing(thing) => Target::Thing(*thing),
                Aim::Term(term) => Target::Term { me: DOCUMENT, term },
            };
            (target, values.clone())
        })
        .collect();
    let mut values = state.values.clone();
    let mut texts = Texts::new(&state.lowered.document, &state.structure);
    let report = open.planner.edit(state.model(), &mut values, kind, &targets, &mut texts);
    if let Some(reason) = &report.refusal {
        let refusal = words::refusal_for(&state, reason, &report);
        let refusal = while_anchored(open, refusal, reason, &report, &aims);
        let refusal = one_way(open, refusal, reason, &report, &aims);
        let refusal = of_computed(refusal, &aims);
        let refusal = too_hard(open, refusal, reason, &aims);
        return Err(match report.limit {
            Some(limit) => limited(&state, refusal, &aims, limit),
            None => match (reason, &aims[..]) {
                (RefusalReason::NotDecided(NotDecided::Work(_)), [(Aim::Thing(thing), wanted)]) => {
                    as_dragged(&state, &mut open.planner, refusal, *thing, wanted)
                }
                _ => refusal,
            },
        });
    }
    let slots = aims.iter().flat_map(|(aim, _)| slots_of(&state, aim)).collect();
    let edited = Edited { slots, ..Edited::default() };
    let mut change = keep(open, host, label, edited, &values, &report.undecided)?;
    if report.reached {
        change.modes.extend(limits::courses(&state, &report.courses));
    }
    if kind == EditKind::Set {
        change.modes.extend(limits::sprung_back(&open.state, &aims));
        let things = aims.iter().filter(|(aim, _)| matches!(aim, Aim::Thing(_)));
        let spoken = things.flat_map(|(aim, _)| slots_of(&state, aim)).collect();
        change.modes.extend(Unasked::of(&state, &open.state, &spoken).view());
    }
    Ok(change)
}

/// Says of what was too hard how many values hang together with what was to change.
fn too_hard(
    open: &mut Open,
    refusal: Refusal,
    reason: &RefusalReason,
    aims: &[(Aim, Vec<Value>)],
) -> Refusal {
    if !matches!(reason, RefusalReason::NotDecided(_)) {
        return refusal;
    }
    let slots = aims.iter().flat_map(|(aim, _)| slots_of(&open.state, aim)).collect();
    let together = words::solved_together(open, &slots);
    Refusal { message: format!("{}; {together}", refusal.message), ..refusal }
}

/// Says of constraints that would not hold what they only read: there is no way back to that.
fn one_way(
    open: &Open,
    refusal: Refusal,
    reason: &RefusalReason,
    report: &plan::EditReport,
    aims: &[(Aim, Vec<Value>)],
) -> Refusal {
    let sources = words::refusing(&open.state, report).0;
    let aimed = aims.iter().flat_map(|(aim, _)| slots_of(&open.state, aim)).collect();
    match only_reading(open, &sources, &aimed).filter(|_| *reason == RefusalReason::Unmet) {
        Some(reads) => Refusal { message: format!("{}; {reads}", refusal.message), ..refusal },
        None => refusal,
    }
}

/// Says of constraints that would not hold which anchored places they speak of, those that are edited apart.
fn while_anchored(
    open: &Open,
    refusal: Refusal,
    reason: &RefusalReason,
    report: &plan::EditReport,
    aims: &[(Aim, Vec<Value>)],
) -> Refusal {
    if *reason != RefusalReason::Unmet {
        return refusal;
    }
    let state = &open.state;
    let sources: BTreeSet<_> = words::refusing(state, report).0.into_iter().collect();
    let is_anchored = |s: &SlotId| state.structure.slots[*s].anchored;
    let slots = |(aim, _): &(Aim, Vec<Value>)| slots_of(state, aim);
    let mut anchors = match sources.is_empty() {
        true => aims.iter().flat_map(slots).filter(is_anchored).collect(),
        false => open.planner.anchors_of(&state.structure, &sources),
    };
    // what is set itself is held by no anchor
    let is_thing = |(aim, _): &&(Aim, Vec<Value>)| matches!(aim, Aim::Thing(_));
    let set: Vec<SlotId> = aims.iter().filter(is_thing).flat_map(slots).collect();
    anchors.retain(|anchor| !set.contains(anchor));
    if anchors.is_empty() {
        return refusal;
    }
    let (constants, others): (Vec<SlotId>, Vec<SlotId>) =
        anchors.into_iter().partition(|&slot| state.is_constant(slot));
    let told = [(constants, "constant"), (others, "anchored")].into_iter();
    let told = told.filter(|(slots, _)| !slots.is_empty()).map(|(slots, held)| {
        let names = words::slots_listed(state, &slots);
        let are = if names.len() == 1 { "is" } else { "are" };
        format!("{} {are} {held}", words::listed(&names))
    });
    let told: Vec<String> = told.collect();
    let message = format!("{} while {}", refusal.message, told.join(" and "));
    Refusal { message, ..refusal }
}

/// Returns what an edit of a whole says of its parts: by the name of a primary superclass, of those that come
/// from there; of a place by two numbers, of its coordinates. Any other edit is returned as it is.
fn in_parts(state: &State, (path, literal): &(Path, Literal)) -> Vec<(Path, Literal)> {
    let whole = || vec![(path.clone(), literal.clone())];
    let (Literal::Tuple(items), Some((Step::Part(name), owner))) = (literal, path.0.split_last())
    else {
        return whole();
    };
    let owner = crate::session::thing_at(state, &Path(owner.to_vec()));
    let thing = crate::session::thing_at(state, path);
    let Some(owner) = owner.filter(|_| owner == thing) else {
        return of_coordinates(state, path, items).unwrap_or_else(whole);
    };
    let document = &state.lowered.document;
    let line = document.primary_line(state.structure.things[owner].class);
    let above = line.iter().find_map(|&c| {
        let first = document.classes[c].supers.first()?;
        (first.name == *name).then_some(first.class)
    });
    let fields = above.map(|class| document.layout(class)).unwrap_or_default();
    if fields.len() != items.len() {
        return whole();
    }
    let part = |field| path.then(Step::Part(document.field_name(field).clone()));
    fields.into_iter().map(part).zip(items.iter().cloned()).collect()
}

/// Returns what two numbers for a place that has more than its coordinates say of these.
fn of_coordinates(state: &State, path: &Path, items: &[Literal]) -> Option<Vec<(Path, Literal)>> {
    let thing = crate::session::thing_at(state, path)?;
    let [x, y] = items else { return None };
    let [of_x, of_y] = coordinates(&state.structure, thing)?;
    let has_more = state.structure.slots_under(thing).len() > items.len();
    let path = |(thing, _)| state.structure.path(&state.lowered.document, thing);
    has_more.then(|| vec![(path(of_x), x.clone()), (path(of_y), y.clone())])
}

/// Says in a refusal what of an edit is computed, so that something else would have had to change.
fn of_computed(refusal: Refusal, aims: &[(Aim, Vec<Value>)]) -> Refusal {
    let path = |(aim, _): &(Aim, Vec<Value>)| match aim {
        Aim::Thing(_) => None,
        Aim::Term(term) => Some(words::term_path(term)),
    };
    let computed: Vec<String> = aims.iter().filter_map(path).collect();
    if computed.is_empty() {
        return refusal;
    }
    let message = format!("{}; {} is computed", refusal.message, words::listed(&computed));
    Refusal { message, ..refusal }
}

/// Says in a refusal how far the edit could have gone; of a limit that is open, what it never comes to.
fn limited(
    state: &State,
    refusal: Refusal,
    aims: &[(Aim, Vec<Value>)],
    plan::Limit { part, kind }: plan::Limit,
) -> Refusal {
    let limit = |(aim, wanted): &(Aim, Vec<Value>)| match aim {
        Aim::Thing(thing) => limits::of_thing(state, *thing, wanted, part),
        Aim::Term(term) => limits::of_term(state, term, wanted, part),
    };
    let limits: Option<Vec<Limit>> = aims.iter().map(limit).collect();
    let Some(limit) = limits.and_then(limits::together) else { return refusal };
    let why = refusal.message.strip_prefix("refused: ").unwrap_or(&refusal.message);
    let words = match kind {
        LimitKind::Last => limits::in_words(&limit),
        LimitKind::Open => limits::open_in_words(&limit),
        LimitKind::AtLeast => limits::seen_in_words(&limit),
    };
    let message = format!("refused: {words}; {why}");
    let limit = (kind != LimitKind::Open).then(|| Box::new(limit));
    Refusal { message, limit, ..refusal }
}

/// How many wishes of a drag are tried to say how far an edit could have gone that was given up.
const WISHES: usize = 4;

/// Says in a refusal of an edit that was given up how far the hand would come, where it soon comes to an end.
fn as_dragged(
    state: &State,
    planner: &mut Planner,
    refusal: Refusal,
    thing: ThingId,
    wanted: &[Value],
) -> Refusal {
    let to = match *wanted {
        [Value::Number(x)] => (x, 0.0),
        [Value::Number(x), Value::Number(y)] => (x, y),
        _ => return refusal,
    };
    let latest = planner.take_latest();
    let path = state.structure.path(&state.lowered.document, thing);
    let ended = drag::press(state, planner, &[thing], path).ok().and_then(|mut drag| {
        let mut wishes = (0..WISHES).map(|_| drag.to(state, planner, to));
        wishes.find(|came| came.reached || came.limit.is_some())
    });
    planner.take_course(state.model(), &state.values);
    planner.restore_latest(latest);
    match ended {
        Some(DragState { message: Some(words), limit: Some(limit), .. }) => {
            let message = format!("{}; by hand: {words}", refusal.message);
            Refusal { message, limit: Some(Box::new(limit)), ..refusal }
        }
        Some(_) | None => refusal,
    }
}

/// Returns the slots that an aim is about: those of a thing, or those that an expression reads.
pub(crate) fn slots_of(state: &State, aim: &Aim) -> Vec<SlotId> {
    match aim {
        Aim::Thing(thing) => state.structure.slots_under(*thing),
        Aim::Term(term) => {
            let evaluator = state.evaluator(&state.values);
            let (_, read) = evaluator.listening(|| evaluator.evaluate(term, DOCUMENT));
            read.into_iter().collect()
        }
    }
}

/// Returns what the undo list calls an edit of values.
fn label(kind: EditKind, state: &State, targets: &[(Path, Literal)]) -> String {
    let verb = match kind {
        EditKind::Set => "set",
        EditKind::Move => "move",
    };
    let path = |(path, _): &(Path, Literal)| match crate::session::thing_at(state, path) {
        Some(thing) => state.structure.path(&state.lowered.document, thing).to_string(),
        None => path.to_string(),
    };
    let paths: Vec<String> = targets.iter().map(path).collect();
    format!("{verb} {}", paths.join(", "))
}

/// Finds what a path leads to: a thing, or something computed.
///
/// # Errors
/// It leads nowhere.
pub(crate) fn aim(state: &State, path: &Path) -> Result<Aim, Refusal> {
    if let Some(thing) = crate::session::thing_at(state, path) {
        return Ok(Aim::Thing(thing));
    }
    let term = Term::at(Term::Me, path);
    let evaluator = state.evaluator(&state.values);
    match evaluator.evaluate(&term, DOCUMENT) {
        Ok(_) => Ok(Aim::Term(term)),
        Err(fault) => Err(words::refuse(format!("{path}: {}", fault.message))),
    }
}

/// Returns the values of a literal, one after the other.
pub(crate) fn flat(literal: &Literal) -> Vec<Value> {
    match literal {
        Literal::Number(x) => vec![Value::Number(*x)],
        Literal::Bool(b) => vec![Value::Number(f64::from(u8::from(*b)))],
        Literal::Text(t) => vec![Value::Text(Arc::from(t.as_str()))],
        Literal::Tuple(items) => items.iter().flat_map(flat).collect(),
        // what a part names is no value of a slot
        Literal::Path(_) => Vec::new(),
    }
}

/// Makes values the document's own, as one step: written back, opened anew. `undecided` is which way slots
/// go whose values do not say on which of two branches they lie.
///
/// # Errors
/// That the text cannot say them, because what would have to say them is wrong; or that a required
/// constraint that held would not.
pub(crate) fn keep(
    open: &mut Open,
    host: &dyn Host,
    label: String,
    edited: Edited,
    values: &Values,
    undecided: &[(SlotId, Toward)],
) -> Result<Change, Refusal> {
    let before = open.state.clone();
    if values.changed(&before.values).next().is_none() {
        return Ok(Change { label, ..Change::default() });
    }
    let latest = open.planner.take_latest();
    let plans = open.planner.take_plans();
    let (state, planner) = write_back(&before, values, &edited, host, plans);
    let sides = sides_after(&before, values, undecided);
    let (state, mut planner) = write_sides(state, planner, &sides, host);
    let status = state.status(&mut planner);
    let unsaid = differing(&state, values).next().filter(|_| state.has_errors());
    let refusal = match unsaid {
        Some(slot) => {
            let path = before.slot_path(slot);
            let message = format!("refused: where {path} would be written, the text has an error");
            Some(words::refuse(message))
        }
        None if open.status.satisfied => words::refusal_of_status(&state, &status),
        None => None,
    };
    if let Some(refusal) = refusal {
        open.give_up(planner);
        open.planner.restore_latest(latest);
        return Err(refusal);
    }
    planner.restore_latest(latest);
    let texts = &mut Texts::new(&state.lowered.document, &state.structure);
    let modes = planner.mode_changes(state.model(), &before.values, values, texts);
    let came = differing(&state, values).next().map(|_| values.clone());
    open.step_with(label.clone(), edited.slots, (state, planner, status));
    if let Some(step) = open.done.last_mut() {
        step.came = came;
    }
    crate::drafting::keep_own(open, host, &before);
    let mut modes = limits::modes(&open.state, &modes);
    modes.extend(limits::sides(&before, &open.state));
    Ok(Change { modes, ..change(label, &before, &open.state) })
}

/// Takes a text as it was typed. It may be wrong: what was right before stays in force.
fn take_text(open: &mut Open, host: &dyn Host, text: &str) -> Change {
    let before = open.state.clone();
    if before.text == text {
        return Change { label: "edit text".into(), ..Change::default() };
    }
    let held = open.status.satisfied;
    let plans = open.planner.take_plans();
    let mut opened = State::of(text.into(), Some(&before), host, plans);
    if held {
        opened = following::follow(&before, opened, host);
    }
    let (state, planner) = opened;
    step_to(open, label_of_text(&before, &state), state, planner)
}

fn travel(open: &mut Open, host: &dyn Host, direction: Direction) -> Result<Change, Refusal> {
    let before = open.state.clone();
    match open.travel(direction) {
        Some(label) => {
            // the step was made beside what a used document was then
            catch_up(open, host);
            Ok(change(label, &before, &open.state))
        }
        None => {
            let nothing = match direction {
                Direction::Back => "there is nothing to undo",
                Direction::Forth => "there is nothing to redo",
            };
            Err(words::refuse(nothing.into()))
        }
    }
}

/// Makes a text the document's own, as one step.
pub(crate) fn take_state(open: &mut Open, host: &dyn Host, text: String, label: String) -> Change {
    let before = open.state.clone();
    let plans = open.planner.take_plans();
    let (state, planner) = State::of(text, Some(&before), host, plans);
    step_to(open, label, state, planner)
}

/// Reads again what a document uses; its own text stays, and it is no step of its own.
///
/// Returns the constraints that could be satisfied before and cannot be now; nothing if all is as it was.
pub(crate) fn catch_up(open: &mut Open, host: &dyn Host) -> Option<Vec<String>> {
    if open.state.is_up_to_date(host) {
        return None;
    }
    let before = words::unmet_in_words(&open.state, &open.status);
    open.read_again(host);
    let mut unsatisfied = words::unmet_in_words(&open.state, &open.status);
    unsatisfied.retain(|path| !before.contains(path));
    Some(unsatisfied)
}

/// Makes a state the present one, and says which constraints could be satisfied before and cannot be now.
pub(crate) fn step_to(open: &mut Open, label: String, state: State, planner: Planner) -> Change {
    let before = open.state.clone();
    let unmet = words::unmet_in_words(&before, &open.status);
    open.step_to(label.clone(), Vec::new(), state, planner);
    let mut unsatisfied = words::unmet_in_words(&open.state, &open.status);
    unsatisfied.retain(|path| !unmet.contains(path));
    Change { unsatisfied, ..change(label, &before, &open.state) }
}

/// Says what is different between two states.
pub(crate) fn change(label: String, before: &State, after: &State) -> Change {
    let structure = before.structure.slots.len() != after.structure.slots.len()
        || before.structure.constraints != after.structure.constraints
        || before.structure.merged != after.structure.merged
        || counts(before) != counts(after);
    let moved = if structure {
        Vec::new()
    } else {
        let slots = after.values.changed(&before.values);
        slots.map(|s| after.slot_path(s).to_string()).collect()
    };
    let edits = difference(&before.text, &after.text);
    Change { label, edits, moved, structure, ..Change::default() }
}

/// Returns what says how many and which parts things have, by their classes' counts.
fn counts(state: &State) -> Vec<(ThingId, &(base::Name, i64))> {
    let document = &state.lowered.document;
    if document.classes.iter().all(|(_, class)| class.counts.is_empty()) {
        return Vec::new();
    }
    let things = state.structure.things.iter();
    let of = |(id, class): (ThingId, ClassId)| {
        document.classes[class].counts.iter().map(move |count| (id, count))
    };
    things.map(|(id, thing)| (id, thing.class)).flat_map(of).collect()
}
