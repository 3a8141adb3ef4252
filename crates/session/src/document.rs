//! One open document: its present state, and those before and after.

use crate::host::Host;
use crate::state::State;
use crate::views::picture::Shown;
use kernel::{SlotId, Values};
use plan::{Planner, Plans};
use std::cell::RefCell;
use std::rc::Rc;

/// A step that can be taken back or done again.
pub(crate) struct Step {
    /// What the undo list calls it.
    pub(crate) label: String,
    /// The document on the other side of the step.
    pub(crate) state: Rc<State>,
    /// What holds and what is free there.
    pub(crate) status: plan::Status,
    /// The slots that an edit of values was about; none for a step of any other kind.
    pub(crate) edited: Vec<SlotId>,
    /// What the pointer wished of slots at last, where it was a drag.
    pub(crate) wishes: Vec<(SlotId, f64)>,
    /// What an edit of values came to, where the text leaves some of it undecided.
    pub(crate) came: Option<Values>,
}

/// An open document.
pub(crate) struct Open {
    /// The name it was opened under.
    pub(crate) name: String,
    /// What it is now.
    pub(crate) state: Rc<State>,
    /// The planner for it.
    pub(crate) planner: Planner,
    /// What holds and what is free.
    pub(crate) status: plan::Status,
    /// How much more was free than the form says in the state before, where only values are others since then.
    pub(crate) presumed: Option<usize>,
    /// What it was before each step, the latest last.
    pub(crate) done: Vec<Step>,
    /// What it was after each step that was taken back, the latest last.
    pub(crate) undone: Vec<Step>,
    /// What the hand holds besides, to place things with.
    pub(crate) tool: Option<crate::tools::Tool>,
    /// A construction that waits for its operands.
    pub(crate) dialogue: Option<crate::drafting::Dialogue>,
    /// How the hand picks for it.
    pub(crate) picking: crate::drafting::Picking,
    /// The program that is recorded, if any.
    pub(crate) recording: Option<crate::drafting::Recording>,
    /// What was tried for the second turn of a loop.
    pub(crate) tried: crate::drafting::Tried,
    /// A drag between press and release.
    pub(crate) drag: Option<crate::drag::Drag>,
    /// What the calculator shows.
    pub(crate) sums: Option<crate::calculator::Sums>,
    /// The lesson that someone is in.
    pub(crate) study: Option<crate::lessons::Study>,
    /// Whose prototype it shows, where it is a pane.
    pub(crate) pane: Option<crate::prototype::pane::Pane>,
    /// What of drags is plotted.
    pub(crate) trace: Option<crate::plotting::Trace>,
    /// The picture as it was asked for last.
    pub(crate) shown: RefCell<Option<Shown>>,
}

/// Which way along the steps.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Direction {
    /// Undo.
    Back,
    /// Redo.
    Forth,
}

impl Open {
    /// Opens a text.
    pub(crate) fn of(name: &str, text: String, host: &dyn Host) -> Self {
        Self::again(name, text, None, host, Plans::default())
    }
    /// Opens a text, of which a state may be known already, with the plans of those before.
    pub(crate) fn again(
        name: &str,
        text: String,
        known: Option<&State>,
        host: &dyn Host,
        plans: Plans,
    ) -> Self {
        Self::new(name.into(), State::of(text, known, host, plans))
    }
    /// Makes a document of its state.
    pub(crate) fn new(name: String, (state, mut planner): (State, Planner)) -> Self {
        let status = state.status(&mut planner);
        Self::at(name, Rc::new(state), planner, status)
    }
    /// Makes a document of a state that was made before, and what holds in it, with the plans of those before.
    pub(crate) fn beginning(
        name: &str,
        (state, status): (Rc<State>, plan::Status),
        plans: Plans,
    ) -> Self {
        let (planner, _) = Planner::new(state.model(), plans);
        let mut open = Self::at(name.into(), state, planner, status);
        open.back_on_course();
        open
    }
    fn at(name: String, state: Rc<State>, planner: Planner, status: plan::Status) -> Self {
        Self {
            name,
            state,
            planner,
            status,
            presumed: None,
            done: Vec::new(),
            undone: Vec::new(),
            tool: None,
            dialogue: None,
            picking: crate::drafting::Picking::default(),
            recording: None,
            drag: None,
            tried: crate::drafting::Tried::default(),
            sums: None,
            study: None,
            pane: None,
            trace: None,
            shown: RefCell::new(None),
        }
    }
    /// Asks something of the picture, brought up to date.
    pub(crate) fn with_picture<T>(&self, ask: impl FnOnce(&Shown) -> T) -> T {
        let mut shown = self.shown.borrow_mut();
        let shown =
            shown.get_or_insert_with(|| Shown::of(&self.state, self.values(), &self.status));
        shown.renew(&self.state, self.values(), &self.status);
        ask(shown)
    }
    /// From now on, the picture tells what the drag moves that was just begun.
    pub(crate) fn rest_picture(&self) {
        let reach = self.drag.as_ref().map(crate::drag::Drag::reach).unwrap_or_default();
        if let Some(shown) = &mut *self.shown.borrow_mut() {
            shown.rest(reach);
        }
    }
    /// Makes `state` the present one, as one step; `edited` is what an edit of values was about.
    pub(crate) fn step_to(
        &mut self,
        label: String,
        edited: Vec<SlotId>,
        state: State,
        mut planner: Planner,
    ) {
        let status = state.status(&mut planner);
        self.step_with(label, edited, (state, planner, status));
    }
    /// The same, where it is known what holds and what is free.
    pub(crate) fn step_with(
        &mut self,
        label: String,
        edited: Vec<SlotId>,
        (state, planner, status): (State, Planner, plan::Status),
    ) {
        self.presumed = self.presumed_in(&state);
        let state = std::mem::replace(&mut self.state, Rc::new(state));
        let status = std::mem::replace(&mut self.status, status);
        self.done.push(Step { label, state, status, edited, wishes: Vec::new(), came: None });
        self.undone.clear();
        self.planner = planner;
    }
    /// Takes a step back or does it again; returns its label, or nothing if there is none.
    pub(crate) fn travel(&mut self, direction: Direction) -> Option<String> {
        let step = match direction {
            Direction::Back => self.done.pop()?,
            Direction::Forth => self.undone.pop()?,
        };
        self.presumed = self.presumed_in(&step.state);
        let state = std::mem::replace(&mut self.state, step.state);
        let status = std::mem::replace(&mut self.status, step.status);
        let label = step.label.clone();
        let to = match direction {
            Direction::Back => &mut self.undone,
            Direction::Forth => &mut self.done,
        };
        to.push(Step { state, status, ..step });
        let plans = self.planner.take_plans();
        (self.planner, _) = Planner::new(self.state.model(), plans);
        self.back_on_course();
        // what is asked of a step is asked of the text as it was
        if let Some(recording) = &mut self.recording {
            (recording.removing, recording.changing) = (None, None);
        }
        Some(label)
    }
    /// Returns how much more is presumed to be free than the form says in a state that comes after the present one.
    fn presumed_in(&self, next: &State) -> Option<usize> {
        self.status.more.or(self.presumed).filter(|_| next.has_form_of(&self.state))
    }
    /// Returns how much is free, and whether that is all as far as is known: there may be more until it is counted.
    pub(crate) fn freedom(&self) -> (usize, bool) {
        let more = self.status.more.or(self.presumed);
        (self.status.freedom + more.unwrap_or_default(), more.is_some())
    }
    /// Returns a copy to try something in: the same state, without its steps. Nothing is read or solved.
    pub(crate) fn trial(&self) -> Self {
        let state = (self.state.clone(), self.status.clone());
        Self::beginning(&self.name, state, Plans::default())
    }
    /// Counts how much is free, which may take a solve for each component; returns what is superfluous.
    pub(crate) fn count(&mut self) -> Vec<plan::Source> {
        let found = self.state.surplus(&mut self.planner, &self.status);
        self.status.more = Some(found.motions);
        found.constraints
    }
    /// Returns how much is free, counted where that was not done yet.
    pub(crate) fn counted(&mut self) -> usize {
        if self.status.more.is_none() {
            self.count();
        }
        self.freedom().0
    }
    /// Has the planner on the course of the present state, whatever was tried with it.
    pub(crate) fn back_on_course(&mut self) {
        self.planner.take_course(self.state.model(), &self.state.values);
    }
    /// Gives up a state that was tried: takes back the plans that it was tried with.
    pub(crate) fn give_up(&mut self, planner: Planner) {
        self.planner.give_plans(planner.into_plans());
        self.back_on_course();
    }
    /// Tries something of several steps: where it is refused none of them was done, and what was undone can still be done
    /// again.
    ///
    /// # Errors
    /// It is refused.
    pub(crate) fn tried<T, E>(
        &mut self,
        act: impl FnOnce(&mut Self) -> Result<T, E>,
    ) -> Result<T, E> {
        let since = self.done.len();
        let undone = std::mem::take(&mut self.undone);
        let outcome = act(self);
        if outcome.is_err() {
            while self.done.len() > since {
                self.travel(Direction::Back);
            }
        }
        if self.done.len() == since {
            self.undone = undone;
        }
        outcome
    }
    /// Makes one step of all that were done since there were so many.
    pub(crate) fn one_step(&mut self, since: usize) {
        let Some(label) = self.done.last().map(|last| last.label.clone()) else { return };
        self.done.truncate(since + 1);
        if let Some(step) = self.done.get_mut(since) {
            *step = Step {
                label,
                state: step.state.clone(),
                status: step.status.clone(),
                edited: Vec::new(),
                wishes: Vec::new(),
                came: None,
            };
        }
    }
    /// Calls the latest step otherwise.
    pub(crate) fn label_last(&mut self, label: String) {
        if let Some(step) = self.done.last_mut() {
            step.label = label;
        }
    }
    /// Makes the state of the same text anew, from what it uses as that is now.
    pub(crate) fn read_again(&mut self, host: &dyn Host) {
        self.read(self.state.text.clone(), host);
    }
    /// Makes the state of another text, which is no step.
    pub(crate) fn read(&mut self, text: String, host: &dyn Host) {
        self.drag = None;
        let plans = self.planner.take_plans();
        let (state, planner) = State::of(text, Some(&self.state), host, plans);
        self.presumed = None;
        self.state = Rc::new(state);
        self.planner = planner;
        self.status = self.state.status(&mut self.planner);
    }
}
