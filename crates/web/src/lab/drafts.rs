//! Drafts: unsaved texts, kept in the browser outside the bundle's memory and by the server on disk, for when the page
//! or the whole browser goes without warning.
//!
//! A draft says where a program was recorded, too: brought back, the recording goes on there.
//!
//! Each tab keeps drafts of its own: two that show one document do not write over each other. Those of tabs that have
//! gone are offered, one after the other, until somebody has decided about each. A draft remembers which state of the
//! file it began from: brought back over a file that has changed since, it is not saved over that unasked.

use super::{Lab, Notice};
use crate::{js, server, theme, words};
use js_sys::Array;
use leptos::prelude::*;
use presentation::drafts::{Draft, Journal, place, place_of};
use session::{Command, Session};

/// A draft that is offered, and where it is kept.
#[derive(Clone, PartialEq, Debug)]
pub struct Offered {
    /// The draft.
    pub draft: Draft,
    place: String,
}

/// Where this tab does.
fn own_place(path: &str) -> String {
    place(&js::tab_name(), path)
}

/// The drafts of a document that say something else than its file and are of no tab that lives, the newest first: of
/// each tab the newer of what the browser and the server keep.
fn left_behind(
    lab: Lab,
    (path, saved): (&str, &str),
    live: &[String],
    on_disk: Vec<(String, String)>,
) -> Vec<Offered> {
    let is_left = |name: &String| {
        place_of(name).is_some_and(|(tab, of)| of == path && !live.iter().any(|l| l == tab))
    };
    let places = theme::names().into_iter();
    let kept = places.filter_map(|place| theme::keep(&place).map(|kept| (place, kept)));
    let on_disk = on_disk.into_iter().map(|(tab, kept)| (place(&tab, path), kept));
    let mut all: Vec<Offered> = Vec::new();
    for (place, kept) in kept.chain(on_disk).filter(|(place, _)| is_left(place)) {
        let Some(draft) = Draft::read(&kept) else { continue };
        match all.iter_mut().find(|known| known.place == place) {
            Some(known) if known.draft.kept >= draft.kept => {}
            Some(known) => known.draft = draft,
            None => all.push(Offered { draft, place }),
        }
    }
    let (mut found, needless): (Vec<Offered>, Vec<Offered>) =
        all.into_iter().partition(|offered| offered.draft.text != saved);
    for offered in needless {
        lab.put_draft(&offered.place, None);
    }
    found.sort_by(|a, b| b.draft.kept.total_cmp(&a.draft.kept));
    found
}

impl Lab {
    /// Offers the unsaved text of a tab that has gone, where there is one.
    pub(super) fn offer_draft(self, path: &str) {
        self.draft.set(None);
        let path = String::from(path);
        leptos::task::spawn_local(async move {
            let mut live: Vec<String> =
                Array::from(&js::live_tabs().await).iter().filter_map(|n| n.as_string()).collect();
            live.push(js::tab_name());
            let on_disk = self.drafts_on_disk(&path).await;
            if self.current.with_untracked(|current| *current != Some(path.clone())) {
                return;
            }
            let saved = self.document.with_untracked(|d| d.as_ref().map(|d| d.saved.clone()));
            let of = (path.as_str(), saved.unwrap_or_default());
            let found = left_behind(self, (of.0, &of.1), &live, on_disk);
            self.draft.set(found.into_iter().next());
        });
    }

    /// The newest text that is kept of a document, of whichever tab.
    pub(super) async fn latest_draft(self, path: &str) -> Option<String> {
        let is_it = |name: &String| place_of(name).is_some_and(|(_, of)| of == path);
        let here = theme::names().into_iter().filter(is_it).filter_map(|name| theme::keep(&name));
        let on_disk = self.drafts_on_disk(path).await.into_iter().map(|(_, kept)| kept);
        let all = here.chain(on_disk).filter_map(|kept| Draft::read(&kept));
        all.max_by(|a, b| a.kept.total_cmp(&b.kept)).map(|draft| draft.text)
    }

    /// Keeps a text of the shown document, or no text any more where that is what is saved.
    pub(super) fn keep_draft(self, text: &str) {
        let Some(path) = self.current.get_untracked() else { return };
        let place = own_place(&path);
        let left = self.ask_of_shown(Session::left_at).flatten();
        self.kept_at.set_value(left.clone());
        let draft = self.document.with_untracked(|document| {
            let document = document.as_ref().filter(|document| document.saved != text)?;
            let (version, text) = (document.version.clone(), String::from(text));
            Some(Draft { version, kept: js_sys::Date::now(), left, text }.written())
        });
        let is_kept = self.put_draft(&place, draft.as_deref());
        if draft.is_some() && !is_kept && !self.is_unkept.get_value() {
            self.notice.set(Some(Notice::Said(String::from(words::DRAFT_NOT_KEPT))));
        }
        self.is_unkept.set_value(draft.is_some() && !is_kept);
    }

    /// Keeps the draft with where something is recorded, where that is elsewhere than before.
    pub fn keep_place(self) {
        let left = self.ask_of_shown(Session::left_at).flatten();
        if self.kept_at.with_value(|kept| *kept != left)
            && let Some(text) = self.ask_of_shown(|session, id| session.text(id).source)
        {
            self.keep_draft(&text);
        }
    }

    /// Forgets what this tab keeps of a document that stands under another name now.
    pub(super) fn forget_draft(self, path: &str) {
        self.put_draft(&own_place(path), None);
    }

    /// Keeps a draft in a place, or nothing any more, here and with the server; returns false where the browser keeps
    /// nothing.
    fn put_draft(self, place: &str, draft: Option<&str>) -> bool {
        let is_begun =
            self.journal.try_update_value(|journal| journal.put(place, draft)).unwrap_or(false);
        if is_begun {
            leptos::task::spawn_local(self.write_journal());
        }
        theme::put(place, draft)
    }

    /// What the server keeps of a document, once it has been told all; without what it could not be told.
    async fn drafts_on_disk(self, path: &str) -> Vec<(String, String)> {
        loop {
            let is_told = self.journal.with_value(|journal| !journal.is_telling());
            let mut found = server::drafts(path).await;
            if is_told {
                self.journal.with_value(|journal| {
                    found.retain(|(tab, _)| !journal.is_waiting(&place(tab, path)));
                });
                return found;
            }
        }
    }

    /// Tells the server what is to be kept, one after the other. Where it does not answer, the browser alone keeps the
    /// rest, until the next draft.
    async fn write_journal(self) {
        while let Some(next) = self.journal.try_update_value(Journal::to_tell).flatten() {
            let (place, draft) = &next;
            let is_answered = match place_of(place) {
                Some((tab, path)) => server::keep_draft(path, tab, draft.as_deref()).await,
                None => true,
            };
            if !is_answered {
                self.journal.update_value(Journal::unanswered);
                return;
            }
            self.journal.update_value(|journal| journal.answered(&next));
        }
    }

    /// Takes up the unsaved text that is offered, or forgets it; then the one before it is offered.
    pub fn decide_draft(self, restore: bool) {
        let (Some(Offered { draft, place }), Some(path)) =
            (self.draft.get_untracked(), self.current.get_untracked())
        else {
            return;
        };
        self.draft.set(None);
        if restore {
            self.flush_text();
            self.update_document(|document| document.version = draft.version);
            // from now on this tab keeps it
            self.apply(&Command::Text(draft.text));
            if let Some(left) = draft.left {
                self.return_to(&left);
            }
        }
        // where there is no room for both, the older one stays until this one is saved
        if !restore || !self.is_unkept.get_value() {
            self.put_draft(&place, None);
        }
        self.offer_draft(&path);
    }
}
