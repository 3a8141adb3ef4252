//! Programs: how long rows of families and drags that run a program again take.
//!
//! Rows are run and measured, and nothing is written, as `thinglab family` without a folder does. Columns: the
//! median time of one row in microseconds, and that of ten thousand in seconds, on one core. Drags: a place moves on
//! which a program depends; the median time of a step, and of a step with the picture, in microseconds.

use crate::gallery::{Library, median, top};
use base::number::{cos, sin};
use session::view::{Refusal, RowFormats};
use session::{DocumentId, Session, parse_path};
use std::fs;
use std::hint::black_box;
use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

/// So many rows of a family are drawn at least.
const LEAST_ROWS: usize = 500;

/// How many rows are told of together.
const MANY: f64 = 10_000.0;

/// A program of four entities a turn, that begins at a place of the document.
const DRAGGED: &str = "use geometry
program Chain(from: Point = (0, 0), turns: Integer in 1..1000 = 10) {
    column = repeat turns times with at = from {
        ring = Circle(center: at, radius: 5)
        hole = Circle.concentric(ring, radius: ring.radius / 2)
        next_center = Point.polar(at, distance: 12, angle: 30 deg)
        bar = Line(at, next_center)
        next at = next_center
    }
}
start: Point = (0, 0)
";

/// Prints the figures of the rows of every family in the gallery whose document's name begins so, and of drags.
pub(crate) fn table(out: &mut impl Write, filter: &str) -> std::io::Result<()> {
    let top = top();
    let mut documents: Vec<PathBuf> = Vec::new();
    for entry in fs::read_dir(top.join("gallery"))? {
        documents.push(entry?.path());
    }
    documents.retain(|path| path.extension().is_some_and(|e| e == "thing"));
    documents.sort();
    for path in documents {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if !name.starts_with(filter) {
            continue;
        }
        let mut session = Session::new(Box::new(Library(top.clone())));
        let id = session.open(&name, &fs::read_to_string(&path)?);
        for family in session.families(id) {
            let table = match &family.table {
                Some(file) => Some(fs::read_to_string(path.with_file_name(file))?),
                None => None,
            };
            match row(&session, id, &family.name, table.as_deref()) {
                Ok(micros) => {
                    let (family, many) = (family.name, micros * MANY / 1e6);
                    writeln!(out, "{family:16} {micros:9.1} µs a row, {many:7.2} s for 10 000")?;
                    if let Some(why) = session.why_interpreted(id, &family) {
                        writeln!(out, "{:16} by the interpreter: {why}", "")?;
                    }
                }
                Err(refusal) => writeln!(out, "{:16} {}", family.name, refusal.message)?,
            }
        }
    }
    for turns in [25, 250].into_iter().filter(|_| "drag".starts_with(filter)) {
        let (step, frame) = drag(turns);
        let made = 4 * turns;
        writeln!(out, "drag, {made:4} made {step:9.1} µs a step, {frame:9.1} µs with its picture")?;
    }
    Ok(())
}

/// Measures a row of a family: the median of all its rows.
fn row(session: &Session, id: DocumentId, name: &str, table: Option<&str>) -> Result<f64, Refusal> {
    let rows = session.family_rows(id, name, table)?.rows;
    let mut times = Vec::new();
    for row in rows.iter().cycle().take(LEAST_ROWS.max(rows.len())) {
        let start = Instant::now();
        black_box(session.draw_row(id, name, row, RowFormats::default())?);
        times.push(start.elapsed());
    }
    Ok(median(times))
}

/// Measures a drag of the place at which a chain of so many turns begins.
fn drag(turns: usize) -> (f64, f64) {
    let text = format!("{DRAGGED}chain: Chain {{ from = start  turns = {turns} }}\n");
    let mut session = Session::new(Box::new(Library(top())));
    let id = session.open("chain", &text);
    let (mut steps, mut frames) = (Vec::new(), Vec::new());
    if let Some(path) = parse_path("start")
        && session.press(id, &path).is_ok()
    {
        let mut picture = session.picture(id);
        for i in 0..200 {
            let turn = f64::from(i) / 20.0;
            let begin = Instant::now();
            black_box(session.drag(id, (10.0 * cos(turn), 10.0 * sin(turn))));
            steps.push(begin.elapsed());
            black_box(session.follow_picture(id, &mut picture));
            frames.push(begin.elapsed());
        }
    }
    (median(steps), median(frames))
}
