//! Drafting at the boundary: what the page asks of a session.

use super::steps;
use super::view::{
    ConstructionRow, Hover, NewParameter, Prompt, RecurrenceQuestion, StepsView, Turn,
};
use super::{Dialogue, Home, Operand, SlotKind, catalogue, outcome, recording, repeat, typed};
use crate::document::Open;
use crate::host::Beside;
use crate::session::Session;
use crate::view::{Change, DocumentId, Pointer, Refusal};
use crate::words;

/// Where an open document's drawing goes.
pub(crate) fn home(open: &Open) -> Home {
    Home::of(open.recording.as_ref())
}

impl Session {
    /// Returns the constructions that can be begun: what the classes in scope make of figures and numbers.
    pub fn constructions(&self, id: DocumentId) -> Vec<ConstructionRow> {
        let open = self.document(id);
        let tools = catalogue::tools(&open.state, &home(open));
        tools.iter().map(catalogue::Tool::row).collect()
    }

    /// Begins a construction, which then waits for its operands one by one.
    ///
    /// # Errors
    /// There is none of that name in scope.
    pub fn begin(&mut self, id: DocumentId, tool: &str) -> Result<Prompt, Refusal> {
        let open = self.document_mut(id);
        let home = home(open);
        let found = catalogue::tool(&open.state, &home, tool);
        let found =
            found.ok_or_else(|| words::refuse(format!("there is no construction {tool}")))?;
        let is_guide = open.dialogue.as_ref().is_some_and(|d| d.is_guide);
        let dialogue = Dialogue { is_guide, ..Dialogue::new(found) };
        let prompt = dialogue.prompt();
        open.tool = None;
        open.dialogue = Some(dialogue);
        Ok(prompt)
    }

    /// Returns what a pointer, with what is typed so far, would do for the construction that waits.
    pub fn hover(&mut self, id: DocumentId, pointer: &Pointer, typed: &str) -> Hover {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = &mut self.documents[id.0 as usize];
        let (state, home) = (open.state.clone(), home(open));
        match &mut open.dialogue {
            Some(dialogue) => {
                dialogue.pointer = Some(pointer.at);
                dialogue.hover(&state, &beside, &home, (pointer, typed))
            }
            None => Hover::default(),
        }
    }

    /// Gives the operand that is wanted by what lies under a pointer. Of a value it is a measure, which the
    /// prompt then offers to be inserted.
    ///
    /// # Errors
    /// Nothing that fits lies there, or there is no such figure; the construction waits as before.
    pub fn point(&mut self, id: DocumentId, pointer: &Pointer) -> Result<Turn, Refusal> {
        let open = self.document_mut(id);
        let (state, home) = (open.state.clone(), home(open));
        let Some(dialogue) = &mut open.dialogue else {
            return Err(words::refuse("no construction waits".into()));
        };
        let operand = dialogue.pick(&state, &home, pointer)?;
        if dialogue.slot().is_some_and(|slot| slot.kind == SlotKind::Value) {
            let insert = Some(operand.text);
            return Ok(Turn::Wants(Prompt { insert, ..dialogue.prompt() }));
        }
        dialogue.pointer = None;
        self.give(id, operand)
    }

    /// Gives the operand that is wanted by what is typed: `x,y`, `@dx,dy`, `length<angle`, any expression.
    ///
    /// # Errors
    /// It is none, or there is no such figure; the construction waits as before.
    pub fn enter(&mut self, id: DocumentId, typed: &str) -> Result<Turn, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = self.document(id);
        let Some((dialogue, slot)) = open.dialogue.as_ref().and_then(|d| Some((d, d.slot()?)))
        else {
            return Err(words::refuse("no construction waits".into()));
        };
        let text = typed::operand(slot, typed, dialogue.last_point.as_deref())?;
        outcome::fits(&open.state, &beside, &home(open), (&text, &slot.class, slot.kind))?;
        self.give(id, Operand { text, at: None })
    }

    fn give(&mut self, id: DocumentId, operand: Operand) -> Result<Turn, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = &mut self.documents[id.0 as usize];
        let home = home(open);
        let Some(dialogue) = &mut open.dialogue else {
            return Err(words::refuse("no construction waits".into()));
        };
        let is_point = dialogue.slot().is_some_and(|slot| slot.kind == SlotKind::Point);
        let mut filled = dialogue.filled.clone();
        if is_point {
            dialogue.last_point = Some(operand.text.clone());
        }
        filled.push(operand);
        if filled.len() < dialogue.tool.slots.len() {
            dialogue.filled = filled;
            return Ok(Turn::Wants(dialogue.prompt()));
        }
        let given = (&dialogue.tool, &filled[..], dialogue.pointer);
        let chosen = outcome::choose(&open.state, &beside, &home, given)?;
        let line = recording::line(&open.state, &home, dialogue, &chosen.text);
        let change = recording::write(open, &beside, &home, &line)?;
        let next = match &mut open.dialogue {
            Some(dialogue) => {
                dialogue.filled.clear();
                dialogue.pointer = None;
                dialogue.prompt()
            }
            None => Prompt::default(),
        };
        let change = self.with_reach(id, change);
        Ok(Turn::Made { change, name: line.name, text: chosen.text, next })
    }

    fn with_reach(&mut self, id: DocumentId, mut change: Change) -> Box<Change> {
        if !change.edits.is_empty() {
            change.documents = self.reach(id);
        }
        Box::new(change)
    }

    /// Takes the latest operand back; without one the construction is given up. Returns what is wanted then.
    pub fn back(&mut self, id: DocumentId) -> Option<Prompt> {
        let dialogue = &mut self.document_mut(id).dialogue;
        match dialogue.as_mut().map(|d| d.filled.pop()) {
            Some(Some(_)) => dialogue.as_ref().map(Dialogue::prompt),
            _ => {
                *dialogue = None;
                None
            }
        }
    }

    /// Gives the construction up.
    pub fn give_up(&mut self, id: DocumentId) {
        self.document_mut(id).dialogue = None;
    }

    /// Says whether what a construction makes is drawn for construction alone.
    pub fn draw_guides(&mut self, id: DocumentId, are_guides: bool) {
        if let Some(dialogue) = &mut self.document_mut(id).dialogue {
            dialogue.is_guide = are_guides;
        }
    }

    /// Begins to record a program: a new one, with an example of it in the document, or more of one that is there.
    ///
    /// # Errors
    /// The name is none for a program, or something else is called so.
    pub fn record(&mut self, id: DocumentId, name: &str) -> Result<Change, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let change = recording::begin(&mut self.documents[id.0 as usize], &beside, name)?;
        Ok(*self.with_reach(id, change))
    }

    /// Ends the recording: what is drawn then belongs to the document.
    pub fn stop_recording(&mut self, id: DocumentId) {
        let open = self.document_mut(id);
        open.recording = None;
        open.dialogue = None;
    }

    /// Begins a loop in the program that is recorded; what is drawn next is its first turn.
    ///
    /// # Errors
    /// Nothing is recorded, a loop is open already, the name is none or taken.
    pub fn begin_loop(&mut self, id: DocumentId, name: &str) -> Result<Change, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let change = repeat::begin(&mut self.documents[id.0 as usize], &beside, name)?;
        Ok(*self.with_reach(id, change))
    }

    /// Ends the first turn of the loop; returns what is asked of the second.
    ///
    /// # Errors
    /// No loop is open, or nothing is drawn in it.
    pub fn end_turn(&mut self, id: DocumentId) -> Result<Option<RecurrenceQuestion>, Refusal> {
        repeat::end_turn(self.document_mut(id))
    }

    /// Returns what lies under a pointer of what is drawn, by the name that it has where things are drawn now.
    pub fn object_at(&self, id: DocumentId, pointer: &Pointer) -> Option<String> {
        let open = self.document(id);
        super::object_at(&open.state, &home(open), pointer)
    }

    /// Answers what is asked of the second turn: nothing for the same, else an object of the turn before, or an
    /// expression over it. Where it was picked decides which way round a curve is taken.
    ///
    /// # Errors
    /// Nothing is asked, or the second turn would have no outcome.
    pub fn answer_recurrence(
        &mut self,
        id: DocumentId,
        answer: Option<&str>,
        at: Option<(f64, f64)>,
    ) -> Result<Option<RecurrenceQuestion>, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        repeat::answer(&mut self.documents[id.0 as usize], &beside, (answer, at))
    }

    /// Closes the loop by what ends it: `until ring.radius < least`, `while r > least`, `6 times`.
    ///
    /// # Errors
    /// No loop is open, something is asked still, or the condition is none.
    pub fn close_loop(&mut self, id: DocumentId, ends: &str) -> Result<Change, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let change = repeat::close(&mut self.documents[id.0 as usize], &beside, ends)?;
        Ok(*self.with_reach(id, change))
    }

    /// Defines a parameter of the program that is recorded.
    ///
    /// # Errors
    /// Nothing is recorded, the name is taken, the example is no value.
    pub fn define_parameter(
        &mut self,
        id: DocumentId,
        parameter: &NewParameter,
    ) -> Result<Change, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = &mut self.documents[id.0 as usize];
        let change = recording::define(open, &beside, &home(open), parameter)?;
        Ok(*self.with_reach(id, change))
    }

    /// Returns the steps of the program that is recorded, or of that of a thing.
    pub fn steps(&self, id: DocumentId, thing: Option<&str>) -> Option<StepsView> {
        let open = self.document(id);
        let block = open.recording.as_ref().and_then(|recording| recording.block.as_ref());
        let open_loop = block.map(repeat::Loop::view);
        let view = steps::view(&open.state, open.values(), &home(open), thing)?;
        Some(StepsView { open_loop, ..view })
    }

    /// Returns what something comes to, in words: a number, a place, a circle's centre and radius. Of whatever a path
    /// leads to, what is drawn and computed too; nothing where it leads nowhere.
    pub fn comes_to(&self, id: DocumentId, path: &str) -> Option<String> {
        let open = self.document(id);
        steps::comes_to(&open.state, open.values(), path)
    }

    /// Returns what a step of a program drew in its example.
    pub fn step_drawing(&self, id: DocumentId, example: &str, step: &str) -> drawing::Drawing {
        let open = self.document(id);
        steps::drawing(&open.state, open.values(), example, step)
    }

    /// Returns the steps that speak of a step, or of one that does: what goes when it is deleted.
    pub fn step_dependents(&self, id: DocumentId, program: &str, step: &str) -> Vec<String> {
        steps::dependents(&self.document(id).state.text, program, step)
    }

    /// Deletes a step, with those that speak of it.
    ///
    /// # Errors
    /// There is no such step; its text cannot go.
    pub fn delete_step(
        &mut self,
        id: DocumentId,
        program: &str,
        step: &str,
    ) -> Result<Change, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = &mut self.documents[id.0 as usize];
        let text = steps::without(&open.state.text, program, step)?;
        let change = recording::retext(open, &beside, text, format!("delete {step}"))?;
        Ok(*self.with_reach(id, change))
    }

    /// Says anew what a step does; it keeps its name, and what speaks of it.
    ///
    /// # Errors
    /// There is no such step; the text is none that a step can have, or steps after it no longer fit.
    pub fn replace_step(
        &mut self,
        id: DocumentId,
        (program, step): (&str, &str),
        formula: &str,
    ) -> Result<Change, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = &mut self.documents[id.0 as usize];
        let text = steps::with_formula(&open.state.text, program, step, formula)?;
        let change = recording::retext(open, &beside, text, format!("replace {step}"))?;
        Ok(*self.with_reach(id, change))
    }
}
