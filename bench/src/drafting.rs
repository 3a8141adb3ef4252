//! Drafting: how long a hand waits in a program of many steps.
//!
//! Columns, in milliseconds, medians: the ghost of a circle under the pointer whose other operands are given; the last
//! pick, until the circle is drawn and its step written; in a loop whose first turn has three steps, the second turn
//! as it is shown while a question waits, and an answer, until the next question waits.

use crate::gallery::{Library, median, top};
use session::drafting::view::Ends;
use session::view::{Pointer, Refusal};
use session::{DocumentId, Session};
use std::hint::black_box;
use std::io::Write;
use std::time::Instant;

/// How many steps the program has.
const STEPS: usize = 200;
/// How often each is measured.
const TIMES: usize = 11;

/// Prints the figures.
pub(crate) fn table(out: &mut impl Write) -> std::io::Result<()> {
    match figures() {
        Ok([ghost, pick, turn, answer]) => {
            writeln!(out, "{STEPS} steps: ghost {ghost:6.2} ms, last pick {pick:6.2} ms")?;
            writeln!(out, "{STEPS} steps: second turn {turn:6.2} ms, its answer {answer:6.2} ms")
        }
        Err(refusal) => writeln!(out, "{}", refusal.message),
    }
}

/// A program of circles in a row, each beside the one before it.
fn text() -> String {
    let mut text = String::from("use geometry\nprogram Long(size: Length = 4) {\n");
    text +=
        "    floor = Axis.horizontal(y: 0)\n    c1 = Circle(center: Point(0, 10), radius: size)\n";
    for i in 2..STEPS {
        let before = i - 1;
        text += &format!(
            "    c{i} = Circle.concentric(with: c{before}, radius: c{before}.radius + 0.5)\n"
        );
    }
    text + "}\nlong: Long\n"
}

fn figures() -> Result<[f64; 4], Refusal> {
    let mut session = Session::new(Box::new(Library(top())));
    let id = session.open("long", &text());
    session.record(id, "Long")?;
    let at = |x: f64, y: f64| Pointer { at: (x, y), reach: 2.0, ..Pointer::default() };
    let (mut ghosts, mut picks) = (Vec::new(), Vec::new());
    session.begin(id, "Circle")?;
    for i in 0..TIMES {
        let x = 200.0 + 3.0 * i as f64;
        session.point(id, &at(x, 0.5))?;
        let begin = Instant::now();
        black_box(session.hover(id, &at(x, 30.0), "size"));
        ghosts.push(begin.elapsed());
        let begin = Instant::now();
        session.enter(id, "size")?;
        black_box(session.picture(id));
        picks.push(begin.elapsed());
    }
    let (mut turns, mut answers) = (Vec::new(), Vec::new());
    session.begin_loop(id, "")?;
    session.begin(id, "Circle.concentric(with,radius)")?;
    for _ in 0..3 {
        session.point(id, &at(0.0, 14.0))?;
        session.enter(id, "size")?;
    }
    session.end_turn(id, Ends::Until)?;
    for _ in 0..TIMES {
        let begin = Instant::now();
        black_box(session.hover(id, &at(0.0, 14.0), ""));
        turns.push(begin.elapsed());
        answered(&mut session, id, &mut answers)?;
        session.back(id);
    }
    Ok([ghosts, picks, turns, answers].map(|times| median(times) / 1000.0))
}

/// Answers the question that waits by what lies under the pointer.
fn answered(
    session: &mut Session,
    id: DocumentId,
    into: &mut Vec<std::time::Duration>,
) -> Result<(), Refusal> {
    let begin = Instant::now();
    let pointer = Pointer { at: (0.0, 14.0), reach: 2.0, ..Pointer::default() };
    session.point(id, &pointer)?;
    into.push(begin.elapsed());
    Ok(())
}
