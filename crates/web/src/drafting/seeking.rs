//! Visiting a program until something is drawn: what that is, is clicked, or found by the arrow keys.

use crate::lab::{Lab, Notice};
use crate::{keyboard, words};
use leptos::prelude::*;
use session::drafting::view::Go;
use session::view::Pointer;

impl Lab {
    /// What comes next says until where the program is visited; or it does not any more.
    pub(super) fn seek(self) {
        let seeks = !self.drafting.seeking.get_untracked();
        self.drafting.seeking.set(seeks);
        self.drafting.sought.set(None);
        self.notice.set(seeks.then(|| Notice::Said(words::VISIT_PICK.into())));
        match seeks {
            true => keyboard::focus("#picture"),
            // what was found is lit no more
            false => self.show_waiting(),
        }
    }

    /// The visit goes on until what is under the pointer is drawn.
    pub fn visit_picked(self, pointer: &Pointer) {
        self.seek_by(&Go::UntilPicked(pointer.clone()));
    }

    fn seek_by(self, go: &Go) {
        // where nothing lies another one is waited for
        if self.visit(go) {
            self.drafting.seeking.set(false);
            self.drafting.sought.set(None);
        }
    }

    /// Takes a key in the picture while it is asked until where the program is visited; returns whether it meant
    /// something.
    pub fn seek_key(self, key: &str, is_back: bool) -> bool {
        if !self.drafting.seeking.get_untracked() {
            return false;
        }
        match (key, is_back) {
            ("ArrowRight" | "ArrowDown", _) => self.seek_next(1, true),
            ("ArrowLeft" | "ArrowUp", _) => self.seek_next(-1, true),
            // past the last one the key goes on to the next panel
            ("Tab", false) => self.seek_next(1, false),
            ("Tab", true) => self.seek_next(-1, false),
            ("Enter", _) => {
                if let Some(name) = self.drafting.sought.get_untracked() {
                    self.seek_by(&Go::UntilDrawn(name));
                }
                true
            }
            ("Escape", _) => {
                self.seek();
                true
            }
            _ => false,
        }
    }

    /// Lights the next of what the program draws, or the one before.
    fn seek_next(self, by: isize, is_round: bool) -> bool {
        let all = self.ask_of_shown(session::Session::drawn_names).unwrap_or_default();
        let sought = self.drafting.sought.get_untracked();
        let now = sought.and_then(|name| all.iter().position(|other| *other == name));
        let n = all.len() as isize;
        let next = match now {
            Some(now) if is_round && n > 0 => Some((now as isize + by).rem_euclid(n) as usize),
            Some(now) => now.checked_add_signed(by),
            None if by > 0 => Some(0),
            None => all.len().checked_sub(1),
        };
        let Some(name) = next.and_then(|next| all.get(next)) else { return false };
        let made = self.ask_of_shown(|session, id| session.drawn_by_name(id, name));
        self.show_made(made.unwrap_or_default());
        self.notice.set(Some(Notice::Said(words::visit_until(name))));
        self.drafting.sought.set(Some(name.clone()));
        true
    }
}
