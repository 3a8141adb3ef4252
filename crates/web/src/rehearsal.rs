//! The rehearsal: what a hand does first is done once beforehand, with a small document that nobody sees.
//!
//! A browser compiles a function when it is first called: the first drag that is let go would take several times as
//! long as the next.

use crate::files::Files;
use crate::js;
use crate::lab::Lab;
use leptos::prelude::*;
use session::view::Refusal;
use session::{Command, Path, Session, parse_path};

/// It uses no library, which would take longer to read than all the rest.
const DOCUMENT: &str = "a: Real = 1
b: Real = 2
c: Real = 4
constraint b = 2 * a
";

impl Lab {
    /// Fetches what is missing of the page's code, and tries it where it came by itself.
    pub async fn fetch_rest(self) {
        if js::fetch_rest().await.is_falsy() {
            return;
        }
        if let Err(refusal) = self.rehearse().await {
            leptos::logging::warn!("rehearsal: {}", refusal.message);
        }
    }

    /// Opens a document, drags one of its numbers, joins two and takes that back; the page has its turn between.
    ///
    /// # Errors
    /// Why something of it could not be done.
    async fn rehearse(self) -> Result<(), Refusal> {
        let mut session = Session::new(Box::new(Files(self.files)));
        let mut opening = session.begin_opening("", DOCUMENT);
        while !opening.is_over() {
            opening = session.go_on_opening(opening);
            self.rest().await;
        }
        let id = session.end_opening(opening);
        let [one, other]: [Path; 2] = ["a", "c"].map(|path| parse_path(path).unwrap_or_default());
        session.press_all(id, std::slice::from_ref(&one))?;
        session.drag(id, (5.0, 0.0));
        self.rest().await;
        session.release(id)?;
        self.rest().await;
        session.apply(id, &Command::Merge(vec![one, other]))?;
        self.rest().await;
        session.apply(id, &Command::Undo)?;
        Ok(())
    }

    /// Lets the page have its turn, and nobody who drags wait.
    async fn rest(self) {
        js::pause().await;
        while self.dragging.try_with_untracked(Option::is_some) == Some(true) {
            js::painted().await;
        }
    }
}
