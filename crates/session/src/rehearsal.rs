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

/// What the document uses.
const LIBRARY: &str = "geometry";
/// How many steps its program has: enough that what runs for each of them is worth optimising.
const STEPS: usize = 60;
/// How often a hand does the same.
const TIMES: usize = 4;

/// The document: lines to drag and to join, two that give way within limits, and a program to go on with.
fn document() -> String {
    let mut text = format!("use {LIBRARY}\n");
    text += "a: Line { p1 = (40, 0)  p2 = (60, 0) }\nb: Line { p1 = (70, 0)  p2 = (90, 0) }\n";
    text += "constraint a.length = b.length\nrehearsed: Rehearsed\n";
    text +=
        "c: Line { p1 = (40, -40)  p2 = (60, -40) }\nd: Line { p1 = (70, -40)  p2 = (90, -40) }\n";
    text += "constraint c.length * d.length = 400\nconstraint c.length <= 22\n";
    text += "program Rehearsed(size: Length = 4) {\n    floor = Axis.horizontal(y: 0)\n";
    text += "    c0 = Circle(center: Point(0, 10), radius: size)\n";
    for i in 1..STEPS {
        let with = i - 1;
        let radius = format!("c{with}.radius + 0.1");
        text += &format!("    c{i} = Circle.concentric(with: c{with}, radius: {radius})\n");
    }
    text + "}\n"
}

impl Job {
    /// The job that rehearses; nothing where the library that it uses is not there.
    pub fn rehearsal(host: &dyn Host) -> Option<Self> {
        let files = vec![(String::from(LIBRARY), host.read(LIBRARY)?)];
        let (name, text) = (String::new(), document());
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
        let at = |x: f64, y: f64| Pointer { at: (x, y), reach: 2.0, ..Pointer::default() };
        // what follows one way, and what gives way by little, with limits that begin and cease to hold it
        for (dragged, y) in [("a.p2", 5.0), ("c.p2", -35.0)] {
            let dragged = parse_path(dragged).unwrap_or_default();
            for i in 0..TIMES {
                self.press_all(id, std::slice::from_ref(&dragged))?;
                for step in 0..TIMES {
                    self.drag(id, (55.0 + (i + 2 * step) as f64, y));
                }
                self.release(id)?;
                self.picture(id);
            }
        }
        self.apply(id, &Command::Merge(vec![end, begin]))?;
        self.picture(id);
        self.apply(id, &Command::Undo)?;
        self.record(id, "Rehearsed")?;
        self.begin(id, "Circle")?;
        for i in 0..TIMES {
            let x = 20.0 + 5.0 * i as f64;
            self.point(id, &at(x, 0.5))?;
            self.hover(id, &at(x, 30.0), "size");
            self.enter(id, "size")?;
            let _ = (self.picture(id), self.steps(id, None), self.constructions(id));
        }
        self.begin_loop(id, "")?;
        self.begin(id, "Circle.concentric(with,radius)")?;
        self.point(id, &at(0.0, 14.0))?;
        self.enter(id, "size")?;
        self.end_turn(id, Ends::Until)?;
        for _ in 0..TIMES {
            self.hover(id, &at(0.0, 14.0), "");
            self.point(id, &at(0.0, 14.0))?;
            let _ = (self.picture(id), self.steps(id, None));
            self.back(id);
        }
        Ok(())
    }
}
