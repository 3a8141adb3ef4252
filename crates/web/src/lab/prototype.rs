//! The prototype of a class, shown instead of the document that declares it: what is done there is done to the class.

use super::{Lab, Notice, Zoom};
use crate::sheet::View;
use crate::words;
use leptos::prelude::*;
use session::view::DocumentId;
use session::{Path, Session};

/// The class whose prototype is shown.
#[derive(Clone, PartialEq, Debug)]
pub struct Shown {
    /// What the class is called.
    pub class: String,
    /// The document that declares it.
    pub home: DocumentId,
    /// How one saw the document, and whether that fitted all of it.
    seen: (View, bool),
}

impl Lab {
    /// The class that is meant by what is selected: the nearest that the document declares.
    pub fn class_around_selection(self) -> Option<String> {
        let path = self.selected.get().and_then(|path| session::parse_path(&path))?;
        self.structure.track();
        self.ask_of_shown(|session, id| session.class_around(id, &path)).flatten()
    }

    /// Shows the prototype of a class, to be edited.
    pub fn edit_class(self, class: &str) {
        self.flush_text();
        match self.tell(|session, id| session.open_prototype(id, class)) {
            Some(Ok(pane)) => {
                let home = self.ask(|session| session.home(pane));
                let before = self.prototype.with_untracked(|shown| shown.as_ref().map(|s| s.seen));
                let now = || (self.view.get_untracked(), self.fits.get_value());
                let seen = before.unwrap_or_else(now);
                self.prototype.set(Some(Shown { class: String::from(class), home, seen }));
                self.show_of_document(pane);
                self.zoom.set(Some(Zoom::Fit));
            }
            Some(Err(refusal)) => self.notice.set(Some(Notice::Refused(refusal))),
            None => {}
        }
    }

    /// Goes back to the document, where a class's prototype is shown.
    pub fn leave_class(self) {
        if let Some(shown) = self.prototype.get_untracked() {
            self.flush_text();
            self.prototype.set(None);
            self.show_of_document(shown.home);
            // one goes on where one was, unless nothing is left there
            let (view, fits) = shown.seen;
            self.view.set(view);
            self.fits.set_value(fits);
            self.zoom.set(Some(if fits { Zoom::Fit } else { Zoom::Seen }));
        }
    }

    /// Shows a document of the session as the present one, or what is in it of a class.
    fn show_of_document(self, id: DocumentId) {
        self.drop_tool();
        self.select(None);
        self.hovered.set(None);
        self.attachers.set(None);
        self.plotting.clear();
        self.notice.set(None);
        self.update_document(|document| document.id = id);
        self.renew_drafting();
        self.refresh();
        crate::keyboard::focus("#picture");
    }

    /// After a change: the class may have another name now, or be gone.
    pub(super) fn follow_prototype(self) {
        let Some(shown) = self.prototype.get_untracked() else { return };
        match self.ask_of_shown(Session::prototype_shown).flatten() {
            Some(class) if class == shown.class => {}
            Some(class) => self.prototype.set(Some(Shown { class, ..shown })),
            None => self.leave_class(),
        }
    }

    /// Makes a class that inherits from that of what is selected, by its example.
    ///
    /// # Errors
    /// Why not, in one sentence.
    pub fn make_kind(self, path: &str, class: &str) -> Result<(), String> {
        let Some(path) = session::parse_path(path) else { return Ok(()) };
        let made = self.ask_of_shown(|session, id| session.kind_of(id, &path, class));
        match made {
            Some(Ok(command)) => {
                self.apply_called(&command, &words::make_class(class));
                Ok(())
            }
            Some(Err(refusal)) => Err(refusal.in_a_line()),
            None => Ok(()),
        }
    }

    /// Says what is selected, a rule or a part of one thing, of every thing of its class.
    pub fn say_of_every(self) {
        self.flush_text();
        let path = self.selected.get_untracked().and_then(|path| session::parse_path(&path));
        let path: Path = path.unwrap_or_default();
        match self.ask_of_shown(|session, id| session.of_every(id, &path)) {
            Some(Ok(command)) => drop(self.apply_called(&command, words::OF_EVERY)),
            Some(Err(refusal)) => self.notice.set(Some(Notice::Refused(refusal))),
            None => {}
        }
    }
}
