//! Edits that a worker executes: what an edit comes to is found in a copy of the document, which then takes it over as it
//! takes a step that is done again. Nothing is solved for that.
//!
//! In: an edit, and the document's text. Out: the change, and the state that it led to. It is taken over only by a
//! document in the very state that the copy was in, bit for bit; any other executes the edit itself.

use crate::apply;
use crate::document::{Open, Step};
use crate::plain::{plain_enum, plain_struct};
use crate::session::{Session, thing_at};
use crate::state::{Found, State};
use crate::view::{Change, DocumentId, Refusal};
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
    /// A command.
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
    change: Change,
    /// The state that the copy was in.
    before: u64,
    /// Where it led; nothing where nothing changed.
    after: Option<After>,
}

/// The state after an edit, apart from its text.
#[derive(Clone, PartialEq, Debug)]
struct After {
    state: u64,
    values: Plainly,
    double_roots: Vec<u32>,
    /// Values alone are others.
    has_form: bool,
    edited: Vec<u32>,
    wishes: Vec<(u32, f64)>,
    came: Option<Plainly>,
}

/// Values as plain data.
#[derive(Clone, PartialEq, Debug)]
struct Plainly {
    numbers: Vec<f64>,
    texts: Vec<(u32, String)>,
}

plain_enum!(LongEdit { 0: Command(command), 1: Typed { path, typed } });
plain_struct!(Executed { change, before, after });
plain_struct!(After { state, values, double_roots, has_form, edited, wishes, came });
plain_struct!(Plainly { numbers, texts });

impl From<&Values> for Plainly {
    fn from(values: &Values) -> Self {
        let texts = values.texts.iter().map(|(slot, text)| (slot.0, text.to_string()));
        Self { numbers: values.numbers.iter().map(|(_, x)| *x).collect(), texts: texts.collect() }
    }
}

impl From<&Plainly> for Values {
    fn from(plainly: &Plainly) -> Self {
        let mut values = Self::new(plainly.numbers.len());
        for (slot, x) in (0..).map(SlotId).zip(&plainly.numbers) {
            values.numbers[slot] = *x;
        }
        let texts = plainly.texts.iter();
        values.texts =
            texts.map(|(slot, text)| (SlotId(*slot), Arc::from(text.as_str()))).collect();
        values
    }
}

impl LongEdit {
    fn execute(&self, session: &mut Session, id: DocumentId) -> Result<Change, Refusal> {
        match self {
            Self::Command(command) => session.apply(id, command),
            Self::Typed { path, typed } => session.set_typed(id, path, typed),
        }
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
        let things = own.iter().chain(others).filter_map(|path| thing_at(&state, path));
        let slots: BTreeSet<SlotId> =
            things.flat_map(|thing| state.structure.slots_under(thing)).collect();
        !slots.is_empty() && open.planner.connected(state.model(), &slots).len() > MANY
    }

    /// Executes an edit in a document that is the copy of another.
    ///
    /// # Errors
    /// Why it was refused.
    pub(crate) fn execute(
        &mut self,
        id: DocumentId,
        edit: &LongEdit,
    ) -> Result<Option<Executed>, Refusal> {
        let before = self.document(id).state.clone();
        self.document_mut(id).done.clear();
        let change = edit.execute(self, id)?;
        let open = self.document(id);
        let after = match &open.done[..] {
            [] => None,
            [step] if !open.state.has_errors() => Some(After::of(open, step, &before)),
            _ => return Ok(None),
        };
        Ok(Some(Executed { change, before: print(&before), after }))
    }

    /// Takes over what an edit came to in a copy, as one step; nothing, and nothing has changed, where the document is
    /// not what the copy was.
    pub fn take_over(&mut self, id: DocumentId, executed: &Executed) -> Option<Change> {
        let (open, beside) = self.beside_others(id);
        if open.drag.is_some() || print(&open.state) != executed.before {
            return None;
        }
        let Executed { change, after, .. } = executed;
        let Some(after) = after else { return Some(change.clone()) };
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
                open.planner.give_plans(plans);
                open.back_on_course();
                return None;
            }
        };
        if print(&state) != after.state {
            open.give_up(planner);
            return None;
        }
        let status = state.status(&mut planner);
        let edited = after.edited.iter().copied().map(SlotId).collect();
        open.step_with(change.label.clone(), edited, (state, planner, status));
        if let Some(step) = open.done.last_mut() {
            step.wishes = after.wishes.iter().map(|&(slot, x)| (SlotId(slot), x)).collect();
            step.came = after.came.as_ref().map(Values::from);
        }
        let mut change = change.clone();
        if !change.edits.is_empty() {
            change.documents = self.reach(id);
        }
        Some(change)
    }

    /// Takes a step back that is not to be done again: of two that are one, the second was refused.
    pub fn withdraw(&mut self, id: DocumentId) {
        let (open, beside) = self.beside_others(id);
        if apply::apply(open, &beside, &Command::Undo).is_ok() {
            open.undone.clear();
        }
    }

    /// Makes one step of the last two.
    pub fn join_steps(&mut self, id: DocumentId) {
        let open = self.document_mut(id);
        open.one_step(open.done.len().saturating_sub(2));
    }
}

impl After {
    fn of(open: &Open, step: &Step, before: &State) -> Self {
        let state = &open.state;
        Self {
            state: print(state),
            values: Plainly::from(&state.values),
            double_roots: state.double_roots.iter().map(|slot| slot.0).collect(),
            has_form: state.has_form_of(before),
            edited: step.edited.iter().map(|slot| slot.0).collect(),
            wishes: step.wishes.iter().map(|&(slot, x)| (slot.0, x)).collect(),
            came: step.came.as_ref().map(Plainly::from),
        }
    }
}

/// A mixture of a state's text, of its values, to the bit, and of the units that they count in.
fn print(state: &State) -> u64 {
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
