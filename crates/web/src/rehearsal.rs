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

const FIGURE: &str = "use geometry
a: Line = Line(Point(0, 0), Point(4, 0))
b: Line = Line(Point(4, 0), Point(4, 3))
c: Point = (9, 9)
merge b.p1 = a.p2
constraint b.length = 3
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

    /// Opens a figure, drags one of its points, joins two and takes that back; the page has its turn between.
    ///
    /// # Errors
    /// Why something of it could not be done.
    async fn rehearse(self) -> Result<(), Refusal> {
        let mut session = Session::new(Box::new(Files(self.files)));
        let mut opening = session.begin_opening("", FIGURE);
        while !opening.is_over() {
            opening = session.go_on_opening(opening);
            self.rest().await;
        }
        let id = session.end_opening(opening);
        let [end, free]: [Path; 2] = ["b.p2", "c"].map(|path| parse_path(path).unwrap_or_default());
        session.press_all(id, std::slice::from_ref(&end))?;
        session.drag(id, (5.0, 4.0));
        self.rest().await;
        session.release(id)?;
        self.rest().await;
        session.apply(id, &Command::Merge(vec![end, free]))?;
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
