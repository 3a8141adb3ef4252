//! Edits that a worker executes: what an edit comes to is found in a copy of the document, which then takes it over as it
//! takes a step that is done again. Nothing is solved for that.
//!
//! In: an edit, and the document's text. Out: the change, and the state that it led to. It is taken over only by a
//! document in the very state that the copy was in, bit for bit; any other executes the edit itself.

use crate::apply;
use crate::document::{Open, Step};
use crate::plain::{plain_enum, plain_struct};
use crate::session::Session;
use crate::state::{Found, State};
use crate::view::{Change, DocumentId, Question, Refusal};
use crate::words;
use base::Mixer;
use kernel::{Command, Path, SlotId, Values};
use std::collections::BTreeSet;
use std::hash::Hasher;
use std::sync::Arc;
use syntax::TextEdit;

/// Where more values hang together than these, an edit of one may take long: it goes to the worker.
const MANY: usize = 40;

/// An edit that may take long.
#[derive(Clone, PartialEq, Debug)]
pub enum LongEdit {
    /// A command of a hand: where it contradicts what holds, that is asked first.
    Command(Command),
    /// A value as a person types it.
    Typed {
        /// Of what.
        path: String,
        /// The words.
        typed: String,
    },
}

/// What an edit came to in a copy of the document.
#[derive(Clone, PartialEq, Debug)]
pub struct Executed {
    /// The state that the copy was in.
    before: u64,
    /// What was done; nothing where that is more than a step, so that it cannot be taken over.
    outcome: Result<Option<Done>, Refusal>,
}

/// What was done.
#[derive(Clone, PartialEq, Debug)]
struct Done {
    came: Came,
    /// Where it led; nothing where nothing changed.
    after: Option<After>,
}

/// What an edit came to.
#[derive(Clone, PartialEq, Debug)]
pub enum Came {
    /// It is done.
    Changed(Change),
    /// Something has to be asked first; nothing has changed.
    Asked(Question),
}

/// The state after an edit, apart from its text.
#[derive(Clone, PartialEq, Debug)]
struct After {
    state: u64,
    values: PlainValues,
    double_roots: Vec<u32>,
    /// Values alone are others.
    has_form: bool,
    edited: Vec<u32>,
    came: Option<PlainValues>,
}

/// Values as plain data.
#[derive(Clone, PartialEq, Debug)]
struct PlainValues {
    numbers: Vec<f64>,
    texts: Vec<(u32, String)>,
}

plain_enum!(LongEdit { 0: Command(command), 1: Typed { path, typed } });
plain_enum!(Came { 0: Changed(change), 1: Asked(question) });
plain_struct!(Question { message, choices });
plain_struct!(Executed { before, outcome });
plain_struct!(Done { came, after });
plain_struct!(After { state, values, double_roots, has_form, edited, came });
plain_struct!(PlainValues { numbers, texts });

impl From<&Values> for PlainValues {
    fn from(values: &Values) -> Self {
        let texts = values.texts.iter().map(|(slot, text)| (slot.0, text.to_string()));
        Self { numbers: values.numbers.iter().map(|(_, x)| *x).collect(), texts: texts.collect() }
    }
}

impl From<&PlainValues> for Values {
    fn from(plain: &PlainValues) -> Self {
        let mut values = Self::new(plain.numbers.len());
        for (slot, x) in (0..).map(SlotId).zip(&plain.numbers) {
            values.numbers[slot] = *x;
        }
        let texts = plain.texts.iter();
        values.texts =
            texts.map(|(slot, text)| (SlotId(*slot), Arc::from(text.as_str()))).collect();
        values
    }
}

impl LongEdit {
    /// Does it.
    ///
    /// # Errors
    /// Why it was refused; then nothing has changed.
    pub fn apply(&self, session: &mut Session, id: DocumentId) -> Result<Came, Refusal> {
        let change = match self {
            Self::Command(command) => match session.over_constrained(id, command) {
                Some(question) => return Ok(Came::Asked(question)),
                None => session.apply(id, command),
            },
            Self::Typed { path, typed } => session.set_typed(id, path, typed),
        };
        change.map(Came::Changed)
    }
    /// The paths of what it is about, where more may hang together with them.
    fn paths(&self) -> Vec<Path> {
        match self {
            Self::Command(Command::Set(targets) | Command::Move(targets)) => {
                targets.iter().map(|(path, _)| path.clone()).collect()
            }
            Self::Command(Command::Merge(paths)) => paths.clone(),
            Self::Command(
                Command::Unmerge(path)
                | Command::Anchor { path, .. }
                | Command::Enable { path, .. },
            ) => vec![path.clone()],
            Self::Command(_) => Vec::new(),
            Self::Typed { path, .. } => crate::parse_path(path).into_iter().collect(),
        }
    }
}

impl Session {
    /// Returns true for an edit that a worker should execute: many values hang together with what it is about, or with
    /// some other things, and the document is no more than a text and its values.
    pub fn may_take_long(&mut self, id: DocumentId, edit: &LongEdit, others: &[Path]) -> bool {
        let open = self.document_mut(id);
        let is_plain = open.pane.is_none()
            && open.recording.is_none()
            && open.dialogue.is_none()
            && open.drag.is_none()
            && !open.state.has_errors();
        if !is_plain {
            return false;
        }
        let state = open.state.clone();
        let own = edit.paths();
        let aims = own.iter().chain(others).filter_map(|path| apply::aim(&state, path).ok());
        let slots: BTreeSet<SlotId> = aims.flat_map(|aim| apply::slots_of(&state, &aim)).collect();
        !slots.is_empty() && open.planner.connected(state.model(), &slots).len() > MANY
    }

    /// Executes an edit in a document that is the copy of another.
    pub(crate) fn execute(&mut self, id: DocumentId, edit: &LongEdit) -> Executed {
        let before = self.document(id).state.clone();
        self.document_mut(id).done.clear();
        let outcome = edit.apply(self, id).map(|came| {
            let open = self.document(id);
            match &open.done[..] {
                [] => Some(Done { came, after: None }),
                [step] if !open.state.has_errors() => {
                    Some(Done { came, after: Some(After::of(open, step, &before)) })
                }
                _ => None,
            }
        });
        Executed { before: fingerprint(&before), outcome }
    }

    /// Takes over what an edit came to in a copy, as one step, or why it was refused there; nothing, and nothing has
    /// changed, where the document is not what the copy was.
    pub fn take_over(
        &mut self,
        id: DocumentId,
        executed: &Executed,
    ) -> Option<Result<Came, Refusal>> {
        let open = self.document(id);
        if open.drag.is_some() || fingerprint(&open.state) != executed.before {
            return None;
        }
        let Done { came, after } = match &executed.outcome {
            Ok(done) => done.as_ref()?,
            Err(refusal) => return Some(Err(refusal.clone())),
        };
        let mut came = came.clone();
        if let (Came::Changed(change), Some(after)) = (&mut came, after) {
            self.step_over(id, change, after)?;
            change.documents = self.reach(id);
        }
        Some(Ok(came))
    }

    /// Makes the state after an edit the present one, if it is what the copy found.
    fn step_over(&mut self, id: DocumentId, change: &Change, after: &After) -> Option<()> {
        let (open, beside) = self.beside_others(id);
        let before = open.state.clone();
        let edits: Vec<TextEdit> = change.edits.iter().map(TextEdit::from).collect();
        let text = syntax::edit::apply(&before.text, &edits);
        let found = Found {
            values: Values::from(&after.values),
            double_roots: after.double_roots.iter().copied().map(SlotId).collect(),
            has_form: after.has_form,
        };
        let plans = open.planner.take_plans();
        let (state, mut planner) = match State::found(text, &before, &beside, plans, found) {
            Ok(made) => made,
            Err(plans) => {
                open.planner.give_plans(*plans);
                open.back_on_course();
                return None;
            }
        };
        if fingerprint(&state) != after.state {
            open.give_up(planner);
            return None;
        }
        let status = state.status(&mut planner);
        let edited = after.edited.iter().copied().map(SlotId).collect();
        open.step_with(change.label.clone(), edited, (state, planner, status));
        if let Some(step) = open.done.last_mut() {
            step.came = after.came.as_ref().map(Values::from);
        }
        Some(())
    }

    /// Ends a drag on something that it joins. Returns the command that joins them, which is applied next and may take
    /// long; and if something moved, how many steps there were before: [`Session::joined`] is told what came of it.
    ///
    /// # Errors
    /// Why it could not be kept or joined; then all is as it was before the press.
    pub fn release_to_join(
        &mut self,
        id: DocumentId,
        target: &Path,
    ) -> Result<(Command, Option<usize>), Refusal> {
        let held = self.held_path(id).ok_or_else(|| words::refuse("nothing is held".into()))?;
        let command = self.join(id, &[target.clone(), held]).inspect_err(|_| self.cancel(id))?;
        let home = self.home(id);
        let steps = self.document(home).done.len();
        self.release(id)?;
        let has_moved = self.document(home).done.len() > steps;
        Ok((command, has_moved.then_some(steps)))
    }

    /// Ends what [`Session::release_to_join`] began, where something moved: both are one step, or neither. Where something
    /// else was done meanwhile the steps stay.
    pub fn joined(&mut self, id: DocumentId, since: usize, is_done: bool) {
        let home = self.home(id);
        let (open, beside) = self.beside_others(home);
        if is_done && open.done.len() <= since + 2 {
            open.one_step(since);
        } else if !is_done
            && open.done.len() == since + 1
            && apply::apply(open, &beside, &Command::Undo).is_ok()
        {
            open.undone.clear();
            self.renew_pane(id);
        }
    }
}

impl After {
    fn of(open: &Open, step: &Step, before: &State) -> Self {
        let state = &open.state;
        Self {
            state: fingerprint(state),
            values: PlainValues::from(&state.values),
            double_roots: state.double_roots.iter().map(|slot| slot.0).collect(),
            has_form: state.has_form_of(before),
            edited: step.edited.iter().map(|slot| slot.0).collect(),
            came: step.came.as_ref().map(PlainValues::from),
        }
    }
}

/// Returns a mixture of a state's text, of its values, to the bit, and of the units that they count in.
fn fingerprint(state: &State) -> u64 {
    let mut mixer = Mixer::default();
    mixer.write(state.text.as_bytes());
    state.lowered.document.scale.0.iter().for_each(|&power| mixer.write_i16(power));
    state.values.numbers.iter().for_each(|(_, x)| mixer.write_u64(x.to_bits()));
    for (slot, text) in &state.values.texts {
        mixer.write_u32(slot.0);
        mixer.write(text.as_bytes());
    }
    mixer.finish()
}
