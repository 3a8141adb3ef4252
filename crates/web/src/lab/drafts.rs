//! Drafts: unsaved texts, kept in the browser outside the bundle's memory, for when the page goes without warning.
//!
//! A draft remembers which state of the file it began from: brought back over a file that has changed since, it is
//! not saved over that unasked. One that nobody has decided about is not lost to newer changes; it is offered after these.

use super::Lab;
use crate::theme;
use leptos::prelude::*;
use session::Command;

/// An unsaved text.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Draft {
    /// The version on disk that it began from.
    pub version: String,
    /// The text.
    pub text: String,
}

impl Draft {
    /// As the browser keeps it: the version has a line of its own.
    fn written(&self) -> String {
        format!("{}\n{}", self.version, self.text)
    }

    fn read(kept: &str) -> Option<Self> {
        let (version, text) = kept.split_once('\n')?;
        Some(Self { version: String::from(version), text: String::from(text) })
    }
}

/// Where the draft of a document is kept, and one before it that was not decided about.
fn places(path: &str) -> [String; 2] {
    [format!("thinglab/draft/{path}"), format!("thinglab/earlier-draft/{path}")]
}

/// The drafts of a document that say something else than its file, the newest first, each with its place.
fn kept(path: &str, saved: &str) -> Vec<(String, Draft)> {
    let at = |place: String| Some((place.clone(), Draft::read(&theme::keep(&place)?)?));
    places(path).into_iter().filter_map(at).filter(|(_, draft)| draft.text != saved).collect()
}

impl Lab {
    /// Offers the unsaved text of an earlier visit, where there is one.
    pub(super) fn offer_draft(self, path: &str) {
        let found = self.document.with_untracked(|document| {
            let document = document.as_ref().filter(|document| !document.dirty)?;
            kept(path, &document.saved).into_iter().next().map(|(_, draft)| draft)
        });
        self.draft.set(found);
    }

    /// Keeps a text of the shown document, or no text any more where that is what is saved.
    pub(super) fn keep_draft(self, text: &str) {
        let Some(path) = self.current.get_untracked() else { return };
        let Some(document) = self.document.get_untracked() else { return };
        let [place, earlier] = places(&path);
        let offered = self.draft.get_untracked();
        if document.saved == text {
            if offered.is_none() {
                theme::put(&place, None);
            }
            return;
        }
        if let Some(offered) = offered.map(|offered| offered.written())
            && theme::keep(&place).as_ref() == Some(&offered)
        {
            theme::put(&earlier, Some(&offered));
        }
        let draft = Draft { version: document.version, text: String::from(text) };
        theme::put(&place, Some(&draft.written()));
    }

    /// Forgets what is kept of a document that stands under another name now.
    pub(super) fn forget_draft(path: &str) {
        for place in places(path) {
            theme::put(&place, None);
        }
    }

    /// Takes up the unsaved text of an earlier visit, or forgets it; then the one before it is offered.
    pub fn decide_draft(self, restore: bool) {
        let (Some(draft), Some(path)) = (self.draft.get_untracked(), self.current.get_untracked())
        else {
            return;
        };
        self.draft.set(None);
        for place in places(&path) {
            if theme::keep(&place) == Some(draft.written()) {
                theme::put(&place, None);
            }
        }
        if restore {
            self.flush_text();
            self.update_document(|document| document.version = draft.version);
            self.apply(&Command::Text(draft.text));
        } else {
            self.keep_draft(&self.written());
            self.offer_draft(&path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Draft;

    #[test]
    fn a_draft_is_read_as_it_was_written() {
        for text in ["", "x: Real\n", "\nfirst line empty", "a\r\nb\n\n"] {
            let draft = Draft { version: String::from("absent"), text: String::from(text) };
            assert_eq!(Draft::read(&draft.written()), Some(draft));
        }
        assert_eq!(Draft::read("no line"), None);
    }
}
