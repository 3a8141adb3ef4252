//! Unsaved texts as the browser and the server keep them, and what the server is still to be told of them.

use std::collections::VecDeque;

/// Where drafts are kept: the tab and the document's path follow.
const PLACE: &str = "thinglab/draft/";

/// An unsaved text.
#[derive(Clone, PartialEq, Debug)]
pub struct Draft {
    /// The version on disk that it began from.
    pub version: String,
    /// When it was kept, in milliseconds since 1970.
    pub kept: f64,
    /// Where in it a program was recorded, as the session says it.
    pub left: Option<String>,
    /// The text.
    pub text: String,
}

impl Draft {
    /// As the browser keeps it: version, time and where something was recorded have a line of their own.
    pub fn written(&self) -> String {
        let left = self.left.as_ref().map(|left| format!(" {left}")).unwrap_or_default();
        format!("{} {}{left}\n{}", self.version, self.kept, self.text)
    }

    /// Reads what [`Draft::written`] wrote; nothing where it is something else.
    pub fn read(kept: &str) -> Option<Self> {
        let (head, text) = kept.split_once('\n')?;
        let mut head = head.splitn(3, ' ');
        let version = String::from(head.next()?);
        let kept = head.next().and_then(|kept| kept.parse().ok()).unwrap_or(0.0);
        Some(Self { version, kept, left: head.next().map(String::from), text: String::from(text) })
    }
}

/// What the server is still to keep: of each place the latest, nothing for what it is to forget.
#[derive(Debug, Default)]
pub struct Journal {
    /// The places in the order in which the server is told of them.
    waiting: VecDeque<(String, Option<String>)>,
    /// Whether it is being told.
    is_telling: bool,
}

impl Journal {
    /// Takes up what is to be kept in a place. Returns true where the server is to be told from now on.
    pub fn put(&mut self, place: &str, draft: Option<&str>) -> bool {
        let draft = draft.map(String::from);
        match self.waiting.iter_mut().find(|(known, _)| known == place) {
            Some((_, known)) => *known = draft,
            None => self.waiting.push_back((String::from(place), draft)),
        }
        !std::mem::replace(&mut self.is_telling, true)
    }

    /// What the server is to be told next. When there is nothing more, telling is over.
    pub fn to_tell(&mut self) -> Option<(String, Option<String>)> {
        let next = self.waiting.front().cloned();
        self.is_telling = next.is_some();
        next
    }

    /// The server has answered for what was next; it is done unless its place has something else by now.
    pub fn answered(&mut self, told: &(String, Option<String>)) {
        if self.waiting.front() == Some(told) {
            self.waiting.pop_front();
        }
    }

    /// The server has not answered: what was next waits behind the others, until telling begins again.
    pub fn unanswered(&mut self) {
        if let Some(first) = self.waiting.pop_front() {
            self.waiting.push_back(first);
        }
        self.is_telling = false;
    }

    /// Whether the server does not know the latest of a place yet.
    pub fn is_waiting(&self, place: &str) -> bool {
        self.waiting.iter().any(|(known, _)| known == place)
    }

    /// Whether it is being told.
    pub fn is_telling(&self) -> bool {
        self.is_telling
    }
}

/// Where a tab keeps the draft of a document.
pub fn place(tab: &str, path: &str) -> String {
    format!("{PLACE}{tab}/{path}")
}

/// The tab and the path that a place is for; nothing where no draft is kept.
pub fn place_of(name: &str) -> Option<(&str, &str)> {
    name.strip_prefix(PLACE)?.split_once('/')
}

#[cfg(test)]
mod tests {
    use super::{Draft, Journal, place, place_of};

    #[test]
    fn a_draft_is_read_as_it_was_written() {
        for text in ["", "x: Real\n", "\nfirst line empty", "a\r\nb\n\n"] {
            for left in [None, Some(String::from("Comb [1 0] teeth.#0.then.axis"))] {
                let (version, kept) = (String::from("absent"), 1.75e12);
                let draft = Draft { version, kept, left, text: String::from(text) };
                assert_eq!(Draft::read(&draft.written()), Some(draft));
            }
        }
        assert_eq!(Draft::read("no line"), None);
    }

    #[test]
    fn a_place_tells_the_tab_and_the_document() {
        assert_eq!(place_of("thinglab/draft/7e-1/a/b.thing"), Some(("7e-1", "a/b.thing")));
        assert_eq!(place_of("thinglab/dock"), None);
        assert_eq!(place_of(&place("7e-1", "a/b.thing")), Some(("7e-1", "a/b.thing")));
    }

    #[test]
    fn a_draft_that_the_server_did_not_answer_for_is_told_again() {
        let mut journal = Journal::default();
        assert!(journal.put("a", Some("1")));
        assert!(!journal.put("b", None));
        let first = journal.to_tell().expect("it waits");
        assert_eq!(first, ("a".into(), Some("1".into())));
        journal.unanswered();
        assert!(journal.is_waiting("a") && journal.is_waiting("b"));
        // the next draft begins anew; what was not answered does not stand in the way of the others
        assert!(journal.put("c", Some("3")));
        let mut told = Vec::new();
        while let Some(next) = journal.to_tell() {
            journal.answered(&next);
            told.push(next.0);
        }
        assert_eq!(told, ["b", "a", "c"]);
        assert!(journal.put("a", None));
    }

    #[test]
    fn a_draft_that_changes_while_the_server_is_told_is_told_again() {
        let mut journal = Journal::default();
        journal.put("a", Some("1"));
        let first = journal.to_tell().expect("it waits");
        assert!(!journal.put("a", Some("2")));
        journal.answered(&first);
        assert_eq!(journal.to_tell(), Some(("a".into(), Some("2".into()))));
    }
}
