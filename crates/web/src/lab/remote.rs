//! Edits that may take long: a worker executes them on its copy of the document, and the page goes on meanwhile.
//!
//! In: an edit. Out: what came of it, at once or once the worker has said. Edits are done in the order in which they
//! were asked for. Where the document has changed meanwhile, or no worker can be had, the page does them itself.

use super::{Kind, Lab, Notice, Told};
use crate::words;
use leptos::prelude::*;
use session::jobs::{LongAnswer, LongQuestion};
use session::remote::{Came, LongEdit};
use session::view::Refusal;
use session::{DocumentId, Path};
use std::cell::RefCell;

/// What came of an edit; nothing where it was stopped, or its document is shown no more.
pub(crate) type Outcome = Option<Result<Came, Refusal>>;

impl Lab {
    /// Does an edit of the shown document, by the worker where it may take long.
    pub(crate) fn edit(self, edit: LongEdit, then: impl FnOnce(Outcome) + 'static) {
        match self.is_long(&edit, &[]) {
            true => self.have_executed(edit, then),
            false => then(self.tell(|session, id| edit.apply(session, id))),
        }
    }

    /// Whether an edit is one for the worker: many values hang together with what it is about, or with some other
    /// things.
    pub(crate) fn is_long(self, edit: &LongEdit, others: &[Path]) -> bool {
        let may_take_long =
            |session: &mut session::Session, id| session.may_take_long(id, edit, others);
        self.is_worker_free() && self.tell(may_take_long) == Some(true)
    }

    /// Has the worker execute an edit of the shown document.
    pub(crate) fn have_executed(self, edit: LongEdit, then: impl FnOnce(Outcome) + 'static) {
        let Some(id) = self.id() else { return };
        let question = LongQuestion::Edit(edit.clone());
        let waiting = RefCell::new(Some((edit, then)));
        let executed = RefCell::new(None);
        self.ask_long(Kind::Edit, question, move |told| match told {
            Told::Part(LongAnswer::Edited(answer)) => *executed.borrow_mut() = Some(answer),
            Told::Part(_) => {}
            Told::Over => {
                let Some((edit, then)) = waiting.take() else { return };
                let taken = executed.take();
                let outcome = self.order(|session| {
                    let taken = taken.and_then(|executed| session.take_over(id, &executed));
                    taken.unwrap_or_else(|| edit.apply(session, id))
                });
                then(self.is_shown(id).then_some(outcome));
            }
            Told::Stopped => {
                if let Some((_, then)) = waiting.take() {
                    then(None);
                }
            }
            Told::Failed(why) => {
                if let Some((_, then)) = waiting.take() {
                    let message = words::job_failed(&why);
                    then(self.is_shown(id).then(|| Err(Refusal { message, ..Refusal::default() })));
                }
            }
        });
    }

    fn is_shown(self, id: DocumentId) -> bool {
        self.id() == Some(id)
    }

    /// Does at once what the worker has not done yet: a hand begins something that goes on from there.
    pub(crate) fn finish_edits(self) {
        self.end_edits(|| Told::Over);
    }

    /// Gives up what the worker has not done yet; returns whether there was something.
    pub(crate) fn stop_edits(self) -> bool {
        let has_stopped = self.end_edits(|| Told::Stopped);
        if has_stopped {
            self.notice.set(Some(Notice::Said(String::from(words::JOB_STOPPED))));
        }
        has_stopped
    }

    /// Ends a drag where it joins something: one step for the undo list. Where the joining takes long what is dragged
    /// lies there meanwhile.
    pub fn release_onto(self, target: &Path) {
        self.dragging.set(None);
        self.dropping.set(None);
        self.select_held();
        let Some(id) = self.id() else { return };
        let released = self.order(|session| session.release_to_join(id, target));
        let (command, since) = match released {
            Ok(released) => released,
            Err(refusal) => {
                self.settle(Some(Err(refusal)));
                return;
            }
        };
        let edit = LongEdit::Command(command);
        let then = move |outcome: Outcome| {
            if let Some(since) = since {
                let is_done = outcome.as_ref().is_some_and(Result::is_ok);
                self.order(|session| session.joined(id, since, is_done));
            }
            if outcome.is_none() {
                self.refresh();
            }
            self.settle_edit(outcome);
        };
        if self.is_long(&edit, &[]) {
            self.refresh();
            self.have_executed(edit, then);
        } else {
            then(self.tell(|session, id| edit.apply(session, id)));
        }
    }

    /// Shows what came of an edit; returns whether it is done.
    pub(crate) fn settle_edit(self, outcome: Outcome) -> bool {
        match outcome {
            Some(Ok(Came::Changed(change))) => self.settle(Some(Ok(change))),
            Some(Ok(Came::Asked(question))) => {
                self.notice.set(Some(Notice::Asked(question)));
                false
            }
            Some(Err(refusal)) => self.settle(Some(Err(refusal))),
            None => false,
        }
    }
}
