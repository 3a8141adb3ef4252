//! Recording at the boundary: a program begun and ended, its parameters, loops and branches demonstrated.

use super::hands::{home, not_in_a_pane, object_at, prompt, turn_of};
use super::view::{Ends, NewParameter, ParameterReading, Prompt, Turn};
use super::{blocks, choice, parameters, reading, recording, repeat, scene};

use crate::session::Session;
use crate::view::{Change, DocumentId, Pointer, Refusal};
use crate::words;

impl Session {
    /// Begins to record a program: a new one, with an example of it in the document, or more of one that is there.
    ///
    /// # Errors
    /// The name is none for a program, or something else is called so.
    pub fn record(&mut self, id: DocumentId, name: &str) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        not_in_a_pane(open)?;
        let change = recording::begin(open, &beside, name)?;
        Ok(*self.with_reach(id, change))
    }

    /// Ends the recording: what is drawn then belongs to the document. The example has its own values again.
    ///
    /// # Errors
    /// A loop or an `if` is still demonstrated.
    pub fn stop_recording(&mut self, id: DocumentId) -> Result<Change, Refusal> {
        let open = self.document_mut(id);
        blocks::settle(open);
        if let Some(recording) = &open.recording
            && let Some(block) = recording.blocks.iter().find(|b| b.kind != blocks::Kind::Visited)
        {
            let what = match &block.around.name {
                Some(name) => name.to_string(),
                None => "the `if`".into(),
            };
            return Err(words::refuse(format!("{what} is open still: end it, or undo it, first")));
        }
        let is_recorded = open.recording.is_some();
        let change = if is_recorded { self.own_values(id)? } else { Change::default() };
        let open = self.document_mut(id);
        open.recording = None;
        open.dialogue = None;
        open.picking = super::Picking::default();
        Ok(change)
    }

    /// Begins a loop in the program that is recorded; what is drawn next is its first turn. Without a name it gets one.
    ///
    /// # Errors
    /// Nothing is recorded, the name is none or taken.
    pub fn begin_loop(&mut self, id: DocumentId, name: &str) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        let change = repeat::begin(open, &beside, name)?;
        Ok(*self.with_reach(id, change))
    }

    /// Begins a loop over what lies in a rectangle, each by its name; what is drawn next is done for each.
    ///
    /// # Errors
    /// Nothing is recorded, nothing lies there, or figures of several kinds.
    pub fn begin_each(
        &mut self,
        id: DocumentId,
        corners: ((f64, f64), (f64, f64)),
    ) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        blocks::recorded(open)?;
        let found = scene::within(&open.state, &home(open), corners);
        let set = scene::wholes_of(&open.state, &home(open), &found);
        let kinds = scene::kinds_in_words(&open.state, &found, &set);
        let of_one_kind = |refusal| match &kinds {
            None => refusal,
            Some(kinds) => words::refuse(format!(
                "{kinds} lie in that rectangle: a loop goes over figures of one kind, so draw it around those"
            )),
        };
        let change = repeat::begin_each(open, &beside, ("", &set)).map_err(of_one_kind)?;
        Ok(*self.with_reach(id, change))
    }

    /// Leaves a figure out of the set that the open loop goes over, by its name, or takes it in.
    ///
    /// # Errors
    /// No such loop is open, its first turn is drawn for this figure, none would be left, it is of another kind, or there
    /// was no such figure before the loop.
    pub fn take_of_set(&mut self, id: DocumentId, figure: &str) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        blocks::recorded(open)?;
        let mut names = blocks::taken(open);
        names.push(figure.into());
        let all = scene::scene(&open.state, &home(open).before_block());
        let kinds = scene::kinds_in_words(&open.state, &all, &names);
        let of_one_kind = |refusal| match &kinds {
            None => refusal,
            Some(kinds) => words::refuse(format!(
                "a loop goes over figures of one kind: {kinds} would be in this one"
            )),
        };
        let is_new = !blocks::caught(open).iter().any(|name| name == figure);
        if is_new && !all.iter().any(|found| scene::whole_of(found) == figure) {
            let message = format!("no figure called `{figure}` was drawn before the loop");
            return Err(words::refuse(message));
        }
        let change = repeat::take_of_set(open, &beside, figure)
            .map_err(|refusal| if is_new { of_one_kind(refusal) } else { refusal })?;
        Ok(*self.with_reach(id, change))
    }

    /// Returns what can be left out of the set of the open loop, or taken in, under a pointer; nothing where no set may
    /// be changed, or no figure lies there.
    pub fn of_set_at(&self, id: DocumentId, pointer: &Pointer) -> Option<String> {
        let open = self.document(id);
        let caught = blocks::caught(open);
        if caught.is_empty() {
            return None;
        }
        let all = scene::scene(&open.state, &home(open).before_block());
        let is_caught = |found: &&scene::Found| caught.contains(&scene::whole_of(found));
        let figures = all.iter().filter(|found| !found.is_place);
        let found = scene::nearest(figures.clone().filter(is_caught), pointer);
        found.or_else(|| scene::nearest(figures, pointer)).map(scene::whole_of)
    }

    /// Returns how the set of the open loop is drawn, as long as it may be changed.
    pub fn set_drawing(&self, id: DocumentId) -> drawing::Drawing {
        let open = self.document(id);
        let home = home(open);
        let set = blocks::taken(open);
        scene::drawing_of_all(&open.state, &home, &set)
    }

    /// Runs the second turn of the loop that is drawn ahead, while nobody waits: before its first turn is ended, or, where
    /// a question is open, with what lies under a pointer for an answer. It is shown at once then.
    pub fn foresee_turn(&mut self, id: DocumentId, pointer: Option<&Pointer>) {
        let (open, beside) = self.beside_others(id);
        let asked = blocks::prompt(open).filter(Prompt::asks_object);
        let (state, home, level) = (open.state.clone(), home(open), open.picking.level);
        let Some((asked, pointer)) = asked.zip(pointer) else {
            return repeat::foresee(open, &beside, None);
        };
        if let Ok(found) = object_at(&state, &home, asked.of_turn_before(), (pointer, level)) {
            repeat::foresee(open, &beside, Some((&found.text, pointer.at)));
        }
    }

    /// Ends the first turn of the loop, and says how the loop ends; what is asked of the second turn is then waited for.
    ///
    /// # Errors
    /// No loop is open, or nothing is drawn in it.
    pub fn end_turn(&mut self, id: DocumentId, ends: Ends) -> Result<Turn, Refusal> {
        let (open, beside) = self.beside_others(id);
        let closed = repeat::end_turn(open, &beside, ends)?;
        let turn = turn_of(open, closed, String::new());
        Ok(self.reached(id, turn))
    }

    /// Begins an `if`: its condition is waited for; the branch that it takes now is drawn then.
    ///
    /// # Errors
    /// Nothing is recorded.
    pub fn begin_choice(&mut self, id: DocumentId) -> Result<Option<Prompt>, Refusal> {
        let open = self.document_mut(id);
        choice::ask(open)?;
        Ok(prompt(open))
    }

    /// Ends the first branch of an `if`; how the other one shall be drawn is waited for.
    ///
    /// # Errors
    /// No `if` is open, or its second branch is.
    pub fn otherwise(&mut self, id: DocumentId) -> Result<Option<Prompt>, Refusal> {
        let open = self.document_mut(id);
        choice::otherwise(open)?;
        Ok(prompt(open))
    }

    /// Begins the other branch of an `if`: with the same values, or with those that were set meanwhile.
    ///
    /// # Errors
    /// No `if` is open; the values do not take the other branch.
    pub fn other_branch(&mut self, id: DocumentId, is_same: bool) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        let change = choice::second(open, &beside, is_same)?;
        Ok(*self.with_reach(id, change))
    }

    /// Ends an `if`. The example has its values again.
    ///
    /// # Errors
    /// No `if` is open.
    pub fn end_choice(&mut self, id: DocumentId) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        let change = choice::end(open, &beside)?;
        Ok(*self.with_reach(id, change))
    }

    /// Returns how what is typed so far of a parameter is understood, and what is wrong in which field.
    pub fn read_parameter(&mut self, id: DocumentId, new: &NewParameter) -> ParameterReading {
        let (open, beside) = self.beside_others(id);
        reading::read(open, &beside, (&home(open), new))
    }

    /// Defines a parameter of the program that is recorded, or says anew what one is.
    ///
    /// # Errors
    /// Nothing is recorded, the name is taken, the example is no value, a step needs it to be what it was.
    pub fn define_parameter(
        &mut self,
        id: DocumentId,
        parameter: &NewParameter,
    ) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        let change = parameters::define(open, &beside, &home(open), parameter)?;
        Ok(*self.with_reach(id, change))
    }

    /// Takes a parameter from the program that is recorded.
    ///
    /// # Errors
    /// Nothing is recorded, there is none of that name, steps speak of it.
    pub fn remove_parameter(&mut self, id: DocumentId, name: &str) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        let change = parameters::remove(open, &beside, &home(open), name)?;
        Ok(*self.with_reach(id, change))
    }
}
