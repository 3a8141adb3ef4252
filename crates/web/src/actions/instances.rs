//! What is done with a thing that a program draws.

use super::conditions::{drawn, instance};
use crate::lab::{Lab, Notice};
use crate::words;
use leptos::prelude::*;

impl Lab {
    /// Holds the selected thing of a program in its place, so that drags fit the program, or lets it go.
    pub(super) fn hold_in_place(self) {
        let Ok((thing, held)) = untrack(|| instance(self)) else { return };
        if self.settle(self.tell(|session, id| session.hold_in_place(id, &thing, !held))) {
            let said = if held { words::let_go(&thing) } else { words::held_in_place(&thing) };
            self.notice.set(Some(Notice::Said(said)));
        }
    }

    /// Makes plain figures of what a program drew.
    pub(super) fn unlink(self) {
        let Ok(thing) = untrack(|| drawn(self)) else { return };
        match self.tell(|session, id| session.unlink(id, &thing)) {
            Some(Ok((change, names))) => {
                self.settle(Some(Ok(change)));
                self.select(names.first().cloned());
                self.notice.set(Some(Notice::Said(words::unlinked(&thing, &names))));
            }
            Some(Err(refusal)) => self.notice.set(Some(Notice::Refused(refusal))),
            None => {}
        }
    }
}
