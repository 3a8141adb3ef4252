//! The rehearsal: what hands do first is done once beforehand, with a document that nobody sees.
//!
//! A browser compiles a function when it is first called, for all that run the same code: the first drag that is let
//! go, and the first turn that is repeated, would take several times as long as the next.

use crate::drafting::view::Ends;
use crate::host::Host;
use crate::jobs::{Job, LongQuestion};
use crate::session::{Session, parse_path};
use crate::view::{DocumentId, Pointer, Refusal};
use kernel::{Command, Path};

/// What it uses.
const LIBRARY: &str = "geometry";
/// Lines to drag and to join, and a program to go on with.
const DOCUMENT: &str = "use geometry
program Rehearsed(size: Length = 4) {
    floor = Axis.horizontal(y: 0)
    first = Circle(center: Point(0, 10), radius: size)
    second = Circle.concentric(with: first, radius: first.radius + 1)
}
rehearsed: Rehearsed
a: Line { p1 = (40, 0)  p2 = (60, 0) }
b: Line { p1 = (70, 0)  p2 = (90, 0) }
constraint a.length = b.length
";

impl Job {
    /// The job that rehearses; nothing where the library that it uses is not there.
    pub fn rehearsal(host: &dyn Host) -> Option<Self> {
        let files = vec![(String::from(LIBRARY), host.read(LIBRARY)?)];
        let (name, text) = (String::new(), String::from(DOCUMENT));
        Some(Self { name, text, files, question: LongQuestion::Rehearsal })
    }
}

impl Session {
    /// Drags, joins, undoes and records in the document of the rehearsal, and shows it after each.
    ///
    /// # Errors
    /// Why something of it could not be done.
    pub(crate) fn rehearse(&mut self, id: DocumentId) -> Result<(), Refusal> {
        let [end, begin]: [Path; 2] =
            ["a.p2", "b.p1"].map(|path| parse_path(path).unwrap_or_default());
        self.press_all(id, std::slice::from_ref(&end))?;
        self.drag(id, (55.0, 5.0));
        self.release(id)?;
        self.picture(id);
        self.apply(id, &Command::Merge(vec![end, begin]))?;
        self.picture(id);
        self.apply(id, &Command::Undo)?;
        self.record(id, "Rehearsed")?;
        let at = |x: f64, y: f64| Pointer { at: (x, y), reach: 2.0, ..Pointer::default() };
        self.begin(id, "Circle")?;
        self.point(id, &at(20.0, 0.5))?;
        self.hover(id, &at(20.0, 30.0), "size");
        self.enter(id, "size")?;
        self.picture(id);
        self.begin_loop(id, "")?;
        self.begin(id, "Circle.concentric(with,radius)")?;
        self.point(id, &at(0.0, 15.0))?;
        self.enter(id, "size")?;
        self.end_turn(id, Ends::Until)?;
        self.hover(id, &at(0.0, 15.0), "");
        self.point(id, &at(0.0, 15.0))?;
        self.picture(id);
        Ok(())
    }
}
