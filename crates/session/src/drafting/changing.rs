//! What a step says, changed one by one: an operand of a construction, what a loop begins with, carries on and ends by,
//! a condition. Another object is picked or typed for it; the step keeps its name, and what speaks of it.

use super::operands::{self, Occurrence};
use super::scene::{self, Curve};
use super::view::{Prompt, StepOperand, Wants};
use super::{
    Around, Home, blocks, catalogue, edges, outcome, patterns, recording, remove, steps, text,
    typed, visit,
};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::{Change, Pointer, Refusal};
use crate::views::answers;
use crate::words;
use base::Name;
use eval::Answer;
use kernel::{Path, Step};
use syntax::ast::Value;

/// A part of what a step says that is about to be changed.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Changing {
    /// The step, by its address.
    step: String,
    /// The turns of the loops around it in which it is looked at.
    turns: Vec<u32>,
    /// What of it.
    slot: String,
    /// What it is now.
    says: String,
    /// Whether it is a number or a yes or no.
    is_value: bool,
    /// Whether it is a place.
    is_place: bool,
}

impl Changing {
    /// What is waited for.
    pub(crate) fn prompt(&self) -> Prompt {
        let Self { step, slot, says, is_value, is_place, .. } = self;
        let says = &steps::as_typed(says, "").unwrap_or_else(|| says.clone());
        let how = match (is_value, is_place) {
            (true, _) => "type another value, or measure one",
            (_, true) => "pick another place, or type `x,y`, from here `@dx,dy`, `length<angle`",
            _ => "pick another object",
        };
        Prompt {
            label: format!("{slot} of {}", text::told(step)),
            words: format!("is {says}: {how}"),
            is_value: *is_value,
            takes_sets: !is_value,
            goes_wider: !is_value,
            wants: Wants::Change(self.says.clone()),
            ..Prompt::default()
        }
    }
}

/// Where what a step says is read: before it, or at the end of a turn of it.
fn home_of(
    source: &text::Source,
    (program, example): (&Name, &Name),
    (address, turns): (&str, &[u32]),
    is_within: bool,
) -> Option<Home> {
    let outer = visit::home_of(source, (program, example), address, turns)?;
    let Home::Program { mut way, before, .. } = outer.clone() else { return None };
    if !is_within {
        return Some(outer);
    }
    let name = text::step_at(source, program, address)?.name.as_deref().map(Name::new);
    let around = way.iter().filter(|around| around.turn.is_some()).count();
    let turn = turns.get(around).copied().or(Some(0));
    way.push(Around { address: before?, name, turn });
    Some(Home::Program { program: program.clone(), example: example.clone(), way, before: None })
}

/// Finds a part of what a step says.
fn find(
    source: &text::Source,
    program: &str,
    (address, slot): (&str, &str),
) -> Option<(Occurrence, bool)> {
    let step = text::step_at(source, program, address)?;
    operands::of_step(&step).into_iter().find(|(found, _)| found.slot == slot)
}

/// Lists what a step of a thing's program says that can be changed; of numbers with the place where they are shown.
pub(crate) fn list(
    state: &State,
    (program, example): (&Name, &Name),
    (address, turns): (&str, &[u32]),
) -> Vec<StepOperand> {
    let Some(step) = text::step_at(&text::Source::now(state), program, address) else {
        return Vec::new();
    };
    let curve = curve_of(state, example, (address, turns));
    let one = |(found, is_within): (Occurrence, bool)| {
        let at = (address, turns);
        let home = home_of(&text::Source::now(state), (program, example), at, is_within);
        let value = home.and_then(|home| in_words(state, &home, &found.first));
        let is_number = value.is_some() && matches!(step.value, Some(Value::Expr(_)));
        let curve = curve.filter(|_| is_number);
        let along = curve.and_then(|curve| curve.reach_of_number(&found.slot));
        let at = match along {
            Some([a, b]) => Some(((a.0 + b.0) / 2.0, (a.1 + b.1) / 2.0)),
            None => curve.map(|curve| curve.place_of_number(&found.slot)),
        };
        StepOperand { slot: found.slot, says: found.first, value, at, along }
    };
    operands::of_step(&step).into_iter().map(one).collect()
}

/// What an expression comes to, if it is a number or a yes or no.
fn in_words(state: &State, home: &Home, says: &str) -> Option<String> {
    let mut found = None;
    outcome::try_all(state, home, &[says.to_string()], &mut |_, evaluator, answer| {
        found = match answer {
            Ok(Answer::Bool(truth)) => Some(truth.to_string()),
            Ok(answer @ (Answer::Number(..) | Answer::Option(..))) => {
                answers::in_words(evaluator.document, &answer)
            }
            Ok(_) | Err(_) => None,
        };
    });
    found
}

/// Where a step's figure lies in the example, in such turns of the loops around it, else the first.
fn curve_of(state: &State, example: &Name, (address, turns): (&str, &[u32])) -> Option<Curve> {
    let evaluator = state.evaluator(&state.values);
    let mut path = Path::of(&[example]);
    let mut turns = turns.iter().copied();
    for name in address.split('.').filter(|s| text::is_name(s)) {
        if matches!(evaluator.at(&path), Ok(Answer::List(_))) {
            path = path.then(Step::Index(turns.next().unwrap_or(0)));
        }
        path = path.then(Step::Part(name.into()));
    }
    Curve::of(&evaluator, &evaluator.at(&path).ok()?)
}

/// Begins to change a part of what a step says.
///
/// # Errors
/// Nothing is recorded, the step is demonstrated, or it is asked how one goes on; it says nothing of that name.
pub(crate) fn begin(
    open: &mut Open,
    (address, slot): (&str, &str),
    selected: Option<&str>,
) -> Result<(), Refusal> {
    let recording = blocks::changeable(open, address)?;
    let (program, example) = (recording.program.clone(), recording.example.clone());
    let turns = visit::turns_looked_at(&Home::of(Some(recording)), (&example, address), selected);
    let state = open.state.clone();
    let none = || words::refuse(format!("{} has no {slot}", text::told(address)));
    let source = text::Source::now(&state);
    let (found, is_within) = find(&source, &program, (address, slot)).ok_or_else(none)?;
    let at = (address, &turns[..]);
    let home = home_of(&source, (&program, &example), at, is_within).ok_or_else(none)?;
    let is_value = in_words(&state, &home, &found.first).is_some();
    let is_place = outcome::place(&state, &home, &found.first).is_some();
    open.dialogue = None;
    if let Some(recording) = &mut open.recording {
        recording.removing = None;
        let (step, slot) = (address.to_string(), slot.to_string());
        let says = found.first;
        recording.changing = Some(Changing { step, turns, slot, says, is_value, is_place });
    }
    Ok(())
}

/// Where the step that is changed reads its names.
pub(crate) fn home(open: &Open) -> Option<Home> {
    let recording = open.recording.as_ref()?;
    let Changing { step, turns, slot, .. } = recording.changing.as_ref()?;
    let source = text::Source::now(&open.state);
    let (_, is_within) = find(&source, &recording.program, (step, slot))?;
    home_of(&source, (&recording.program, &recording.example), (step, turns), is_within)
}

/// Gives what is changed another object or value: as it is typed, or as a pointer finds it.
///
/// # Errors
/// Nothing is changed; nothing that can be meant lies there; the step has no outcome with it.
pub(crate) fn give(
    open: &mut Open,
    host: &dyn Host,
    (typed, picked): (&str, Option<(&Pointer, usize)>),
) -> Result<Change, Refusal> {
    let recording = blocks::recorded(open)?;
    let program = recording.program.clone();
    let none = || words::refuse("nothing is changed".into());
    let Changing { step, slot, says, .. } = recording.changing.clone().ok_or_else(none)?;
    let home_now = home(open).ok_or_else(none)?;
    let is_place = outcome::place(&open.state, &home_now, &says).is_some();
    let typed = match picked {
        // a place goes on from where it was
        None if is_place => typed::at(typed, &says)?,
        None => typed.trim().to_string(),
        Some((pointer, level)) => {
            let all = scene::scene(&open.state, &home_now);
            let nothing = || words::refuse(remove::why_nothing(open, &step, pointer));
            let picked = match scene::nearest_instead(all.iter(), &says, pointer) {
                Some(found) => found.at_level(level, false),
                None if is_place && !remove::lies_there(open, pointer) => typed::place(pointer),
                None => return Err(nothing()),
            };
            match is_edges(&slot, &says) {
                true => {
                    let (state, home) = (&open.state, home(open).ok_or_else(none)?);
                    edges::written(state, &home, &edges::followed(state, &home, &[picked]))
                }
                false => picked,
            }
        }
    };
    let change = set(open, host, (&program, &step, &slot), &typed)?;
    if let Some(recording) = &mut open.recording {
        recording.changing = None;
    }
    Ok(change)
}

/// Whether a part of what a step says is the edges of a contour, as a list.
fn is_edges(slot: &str, says: &str) -> bool {
    slot == "edges" && says.starts_with('[')
}

/// Lets a step say something else in one place, as one step.
///
/// # Errors
/// The step says nothing of that name; what is typed means nothing there; the program is not drawn to its end with it,
/// though it was.
pub(crate) fn set(
    open: &mut Open,
    host: &dyn Host,
    (program, address, slot): (&Name, &str, &str),
    typed: &str,
) -> Result<Change, Refusal> {
    let typed = typed.trim();
    if typed.is_empty() {
        return Err(words::refuse(format!("type what {slot} of {} shall be", text::told(address))));
    }
    let none = || words::refuse(format!("{} has no {slot}", text::told(address)));
    let source = text::Source::now(&open.state);
    let (found, _) = find(&source, program, (address, slot)).ok_or_else(none)?;
    // the text goes on from what stands twice, from what a message is sent to, and from a count
    let is_gone_on_from = found.again.is_some() || matches!(slot, "what" | "count");
    // of a list the elements are typed
    let listed = found.first.starts_with('[').then(|| edges::as_list(typed)).flatten();
    let typed = listed.as_deref().unwrap_or(typed);
    let typed = if is_gone_on_from { catalogue::bracketed(typed) } else { typed.into() };
    let mut edited = source.to_string();
    for span in found.again.iter().chain([&found.span]) {
        edited.replace_range(span.start as usize..span.end as usize, &typed);
    }
    let ended = |state: &State| {
        let said = state.diagnostics.iter().filter(|d| d.code == "run-ended");
        said.map(|d| d.message.clone()).collect::<Vec<_>>()
    };
    let before = ended(&open.state);
    let edited = match slot {
        "what" => patterns::settled(open, host, program, (edited, &[address.to_string()]))?,
        _ => edited,
    };
    open.tried(|open| {
        let label = format!("{slot} of {}", text::told(address));
        let change = recording::retext(open, host, edited, label)?;
        let after = ended(&open.state);
        match after.into_iter().find(|_| before.is_empty()) {
            Some(why) => Err(words::refuse(why)),
            None => Ok(change),
        }
    })
}
