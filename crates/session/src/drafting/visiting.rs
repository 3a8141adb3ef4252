//! Programs at the boundary: visited, and their steps told, replaced and deleted.

use super::hands::{home, prompt, replaced, turn_of};
use super::own_values::{self, Meanwhile};
use super::view::{Go, Prompt, StepOperand, StepsView, Turn};
use super::{
    Home, blocks, changing, choice, patterns, recording, remove, scene, steps, text, visit,
};

use crate::session::Session;
use crate::view::{Change, DocumentId, Refusal};
use crate::words;
use eval::Answer;

impl Session {
    /// Goes somewhere in the program that is recorded: what is drawn then is inserted there.
    ///
    /// # Errors
    /// Nothing is recorded, a block is demonstrated; there is no such place.
    pub fn visit(&mut self, id: DocumentId, go: &Go) -> Result<(), Refusal> {
        let open = self.document_mut(id);
        visit::go(open, go)?;
        if let Some(recording) = &mut open.recording {
            recording.replaces = None;
            recording.returns = None;
            recording.removing = None;
            recording.changing = None;
        }
        open.picking = super::Picking::default();
        Ok(())
    }

    /// Lets the program that is recorded be visited by other values of its parameters, as they are typed: what its branches
    /// and turns are then can be seen and edited. The example's own come back by [`Session::own_values`], and where the
    /// recording ends.
    ///
    /// # Errors
    /// Nothing is recorded; there is no such parameter, what is typed is no value, or a constraint forbids it.
    pub fn visit_by(
        &mut self,
        id: DocumentId,
        typed: &[(String, String)],
    ) -> Result<Change, Refusal> {
        let open = self.document_mut(id);
        let example = blocks::recorded(open)?.example.to_string();
        self.set_parameters(id, &example, typed)
    }

    /// Gives the example of the program that is recorded its own values again.
    ///
    /// # Errors
    /// Nothing is recorded.
    pub fn own_values(&mut self, id: DocumentId) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        blocks::recorded(open)?;
        let kept = |text: &str| {
            let declared = choice::example_span(open, text)?;
            let (edited, own) = own_values::taken(text, declared.start, Meanwhile::Visit);
            let now = choice::example_span(open, &edited)?;
            own.map(|own| (edited, now, own))
        };
        let Some((mut edited, now, own)) = kept(&open.state.text) else {
            return Ok(Change::default());
        };
        edited.replace_range(now, &own);
        if edited == open.state.text {
            return Ok(Change::default());
        }
        let change = recording::retext(open, &beside, edited, "own values".into())?;
        blocks::settle(open);
        Ok(*self.with_reach(id, change))
    }

    /// Says where recording goes on, for [`Session::return_to`] with the same text: after the page has gone.
    pub fn left_at(&self, id: DocumentId) -> Option<String> {
        visit::left_at(self.document(id))
    }

    /// Goes on recording where [`Session::left_at`] said that it was left; at the program's end where the text has no such
    /// place. What is demonstrated goes on from what is open in the text.
    ///
    /// # Errors
    /// There is no such program.
    pub fn return_to(&mut self, id: DocumentId, left: &str) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        super::hands::not_in_a_pane(open)?;
        let change = visit::return_to(open, &beside, left)?;
        Ok(*self.with_reach(id, change))
    }

    /// Returns what a step of the program of a thing says that can be changed by itself: its operands; of a loop what it
    /// begins with, carries on and ends by. Of the turns of loops it is said in those that are visited, else in those
    /// that `selected` is made in, a path, else in the first.
    pub fn step_operands(
        &self,
        id: DocumentId,
        (example, step): (&str, &str),
        selected: Option<&str>,
    ) -> Vec<StepOperand> {
        let open = self.document(id);
        let state = &open.state;
        let Some(program) = steps::program_of(state, example) else { return Vec::new() };
        let turns = visit::turns_looked_at(&home(open), (example, step), selected);
        changing::list(state, (&program, &example.into()), (step, &turns))
    }

    /// Returns the step that made what a path leads to, with the thing whose program it is of.
    pub fn step_of(&self, id: DocumentId, path: &str) -> Option<(String, String)> {
        let state = &self.document(id).state;
        let (example, made) = path.split_once('.')?;
        let program = steps::program_of(state, example)?;
        let (step, _) = visit::place_of(&text::Source::now(state), &program, made)?;
        Some((example.into(), step))
    }

    /// Begins to change a part of what a step says: another object or value is waited for, in such turns of loops as
    /// [`Session::step_operands`] tells of.
    ///
    /// # Errors
    /// Nothing is recorded, a block is demonstrated; the step says nothing of that name.
    pub fn begin_change(
        &mut self,
        id: DocumentId,
        (step, slot): (&str, &str),
        selected: Option<&str>,
    ) -> Result<Option<Prompt>, Refusal> {
        let open = self.document_mut(id);
        changing::begin(open, (step, slot), selected)?;
        open.picking = super::Picking::default();
        Ok(prompt(open))
    }

    /// Lets a step of a thing's program say something else in one place; it keeps its name, and what speaks of it.
    ///
    /// # Errors
    /// The step says nothing of that name; what is typed means nothing there, or leaves a step without an outcome.
    pub fn set_operand(
        &mut self,
        id: DocumentId,
        (example, step, slot): (&str, &str, &str),
        typed: &str,
    ) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        let none = || words::refuse(format!("{example} is not drawn by a program"));
        let program = steps::program_of(&open.state, example).ok_or_else(none)?;
        let change = changing::set(open, &beside, (&program, step, slot), typed)?;
        Ok(*self.with_reach(id, change))
    }

    /// Returns what the program has drawn up to where it is visited; nothing where recording goes on at its end.
    pub fn drawn_so_far(&self, id: DocumentId) -> Option<drawing::Drawing> {
        let open = self.document(id);
        visit::is_inside(open).then(|| visit::drawn_so_far(&open.state, &home(open)))
    }

    /// Names what the program that is recorded draws, in order, each of its turns by itself; nothing where none is
    /// recorded. [`Go::UntilDrawn`](super::view::Go::UntilDrawn) takes such a name.
    pub fn drawn_names(&self, id: DocumentId) -> Vec<String> {
        visit::drawn(self.document(id))
    }

    /// Returns how one of these is drawn; nothing for any other name.
    pub fn drawn_by_name(&self, id: DocumentId, name: &str) -> drawing::Drawing {
        visit::drawing(self.document(id), name)
    }

    /// Returns what of what is recorded can be picked now and is no part of the drawing: what was drawn for construction
    /// alone, and the figures among the parameters.
    pub fn guides(&self, id: DocumentId) -> drawing::Drawing {
        let open = self.document(id);
        visit::guides(&open.state, &home(open))
    }

    /// Returns the program that is recorded.
    pub fn recorded(&self, id: DocumentId) -> Option<&str> {
        self.document(id).recording.as_ref().map(|recording| recording.program.as_str())
    }

    /// Returns the path of the example by which a program is recorded.
    pub fn recorded_example(&self, id: DocumentId) -> Option<&str> {
        self.document(id).recording.as_ref().map(|recording| recording.example.as_str())
    }

    /// Returns the names of the parameters of what is recorded that may be a value: numbers, truth values, words, options;
    /// where a construction waits for a length, an angle or a count, those that are numbers.
    pub fn value_parameters(&self, id: DocumentId) -> Vec<String> {
        let open = self.document(id);
        let (home, evaluator) = (home(open), open.state.evaluator(open.values()));
        let path = home.path();
        let example = kernel::Path(path.0.into_iter().take(1).collect());
        let slot = open.dialogue.as_ref().and_then(super::Dialogue::slot);
        let is_measure =
            slot.is_some_and(|slot| matches!(slot.class.as_str(), "Length" | "Angle" | "Integer"));
        let is_value = |name: &&base::Name| match evaluator
            .at(&example.then(kernel::Step::Part((*name).clone())))
        {
            Ok(Answer::Number(..)) => true,
            Ok(Answer::Bool(_) | Answer::Text(_) | Answer::Option(..)) => !is_measure,
            Ok(_) | Err(_) => false,
        };
        let names = scene::parameters(&open.state, &home).filter(is_value);
        names.map(ToString::to_string).collect()
    }

    /// Goes to a step, and lets what is drawn next take its place: it keeps its name, and what speaks of it. Returns what
    /// it is called.
    ///
    /// # Errors
    /// Nothing is recorded, a block is demonstrated; there is no such step, or it is a block.
    pub fn begin_replace(&mut self, id: DocumentId, step: &str) -> Result<String, Refusal> {
        let was = self.document(id).recording.as_ref();
        // from a step that was to be replaced and was not, one returns to where one was before it
        let was = was.map(|recording| match &recording.returns {
            Some(earlier) if recording.replaces.is_some() => earlier.clone(),
            _ => (recording.blocks.clone(), recording.before.clone()),
        });
        self.visit(id, &Go::To(step.into()))?;
        let open = self.document_mut(id);
        let told = text::told(step);
        let Some(recording) = &mut open.recording else { return Ok(told.into()) };
        let found = text::step_at(&text::Source::now(&open.state), &recording.program, step);
        if !matches!(found.and_then(|s| s.value), Some(syntax::ast::Value::Expr(_))) {
            return Err(words::refuse(format!(
                "{told} has steps in it: step into it, or delete it"
            )));
        }
        recording.replaces = Some(step.into());
        recording.returns = was;
        Ok(told.into())
    }

    /// Begins to delete a step: for each step that speaks of it another object is waited for, one by one.
    ///
    /// # Errors
    /// Nothing is recorded, a block is demonstrated, there is no such step.
    pub fn begin_delete(&mut self, id: DocumentId, step: &str) -> Result<Turn, Refusal> {
        let (open, beside) = self.beside_others(id);
        let done = remove::begin(open, &beside, step)?;
        let turn = turn_of(open, done, String::new());
        Ok(self.reached(id, turn))
    }

    /// Answers that the step which is asked about goes, too.
    ///
    /// # Errors
    /// Nothing is asked.
    pub fn delete_along(&mut self, id: DocumentId) -> Result<Turn, Refusal> {
        let (open, beside) = self.beside_others(id);
        let done = remove::along(open, &beside)?;
        let turn = turn_of(open, done, String::new());
        Ok(self.reached(id, turn))
    }

    /// Returns the steps of the program that is recorded, or of that of a thing.
    pub fn steps(&self, id: DocumentId, thing: Option<&str>) -> Option<StepsView> {
        let open = self.document(id);
        steps::view(open, &home(open), thing)
    }

    /// Returns the same without its steps.
    pub fn program_shown(&self, id: DocumentId, thing: Option<&str>) -> Option<StepsView> {
        let open = self.document(id);
        steps::head(open, &home(open), thing)
    }

    /// Returns the step that comes next where what is recorded is visited, with the thing that shows it; nothing at the
    /// end of a block.
    pub fn step_next(&self, id: DocumentId) -> Option<(String, String)> {
        let open = self.document(id);
        let home = home(open);
        let Home::Program { program, example, before: Some(before), .. } = &home else {
            return None;
        };
        let step = text::joined(&text::address_of(&home), before);
        let found = text::step_at(&text::Source::now(&open.state), program, &step);
        found.map(|_| (example.to_string(), step))
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
        steps::dependents(&text::Source::now(&self.document(id).state), program, step)
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
        let (open, beside) = self.beside_others(id);
        let mut gone = steps::dependents(&text::Source::now(&open.state), program, step);
        gone.push(step.into());
        let text = steps::without(&text::Source::now(&open.state), program, &gone)?;
        let change =
            recording::retext(open, &beside, text, format!("delete {}", text::told(step)))?;
        Ok(*self.with_reach(id, change))
    }

    /// Lets a step be drawn for construction alone, or be part of the result.
    ///
    /// # Errors
    /// There is no such step, or it has no name of its own.
    pub fn make_guide(
        &mut self,
        id: DocumentId,
        (program, step): (&str, &str),
        is_guide: bool,
    ) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        let source = text::Source::now(&open.state);
        let text = steps::with_guide(&source, (program, step), is_guide)?;
        let users = steps::users(&source, program, step);
        let mut patterns = patterns::among(&source, program, (&users, step));
        patterns.extend(patterns::within(&source, program, &users));
        let text = patterns::settled(open, &beside, &program.into(), (text, &patterns))?;
        let label =
            format!("{} {}", text::told(step), if is_guide { "as a guide" } else { "drawn" });
        let change = recording::retext(open, &beside, text, label)?;
        Ok(*self.with_reach(id, change))
    }

    /// Turns round what a step makes: a curve runs the other way, and what touches it goes to its other side.
    ///
    /// # Errors
    /// There is no such step, or it makes no curve; steps after it no longer fit.
    pub fn turn_step_round(
        &mut self,
        id: DocumentId,
        (program, step): (&str, &str),
    ) -> Result<Change, Refusal> {
        let source = &text::Source::now(&self.document(id).state);
        let found = text::step_at(source, program, step).and_then(|found| found.value);
        let Some(syntax::ast::Value::Expr(_)) = found else {
            return Err(words::refuse(format!(
                "{} is no step that makes a curve",
                text::told(step)
            )));
        };
        let (_, span) = text::step(source, program, step).unwrap_or_default();
        let formula = source[span.start as usize..span.end as usize].trim().to_string();
        let turned = match formula.strip_prefix("-(").and_then(|rest| rest.strip_suffix(')')) {
            Some(inner) => inner.to_string(),
            None => super::outcome::turned_round(&formula),
        };
        self.replace_step(id, (program, step), &turned)
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
        let (open, beside) = self.beside_others(id);
        let change = replaced(open, &beside, (program, step), formula)?;
        Ok(*self.with_reach(id, change))
    }
}
