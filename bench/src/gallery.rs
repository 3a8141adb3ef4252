//! The gallery: how long the lab takes for what people do, on every document of it.
//!
//! Columns: opening from the text; a press; one step of a drag on a circle around the grip, from the
//! pointer's event to the new values; the same with the picture evaluated anew; the release, which
//! writes the text and opens it. Each is the median of many, in microseconds.

use base::number::{cos, sin};
use session::{Host, Path as ThingPath, Session, parse_path};
use std::fs;
use std::hint::black_box;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How many steps a drag has: two turns, and a third of another.
const STEPS: usize = 840;

/// Reads the library in a copy of the project.
pub(crate) struct Library(pub(crate) PathBuf);

impl Host for Library {
    fn read(&self, name: &str) -> Option<String> {
        fs::read_to_string(self.0.join("library").join(name).with_extension("thing")).ok()
    }
}

struct Figures {
    open: f64,
    press: f64,
    step: f64,
    frame: f64,
    release: f64,
}

/// Prints one row for every document whose name begins with the filter; `grip` is what is dragged.
pub(crate) fn table(out: &mut impl Write, filter: &str, grip: Option<&str>) -> std::io::Result<()> {
    let top = top();
    let mut documents: Vec<PathBuf> = Vec::new();
    for entry in fs::read_dir(top.join("gallery"))? {
        documents.push(entry?.path());
    }
    documents.sort();
    writeln!(
        out,
        "{:24} {:>9} {:>9} {:>9} {:>9} {:>9}",
        "µs", "open", "press", "step", "frame", "release"
    )?;
    for path in documents {
        let text = fs::read_to_string(&path)?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if !name.starts_with(filter) {
            continue;
        }
        let Some(f) = measure(&top, &name, &text, grip) else { continue };
        writeln!(
            out,
            "{name:24} {:9.1} {:9.1} {:9.2} {:9.2} {:9.1}",
            f.open, f.press, f.step, f.frame, f.release
        )?;
    }
    Ok(())
}

/// Returns the folder of the project.
pub(crate) fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new(".")).to_path_buf()
}

/// Measures one document; nothing if it has no grip that can be pressed.
fn measure(top: &Path, name: &str, text: &str, grip: Option<&str>) -> Option<Figures> {
    let open_once = || {
        let mut session = Session::new(Box::new(Library(top.to_path_buf())));
        let id = session.open(name, text);
        (session, id)
    };
    let opened: Vec<Duration> = (0..15).map(|_| timed(|| drop(black_box(open_once())))).collect();
    let (mut session, id) = open_once();
    let grips = session.picture(id).grips;
    let (path, x, y): (ThingPath, f64, f64) = grips
        .iter()
        .filter(|g| grip.map_or(!g.anchored, |path| path == g.path))
        .find_map(|g| parse_path(&g.path).map(|p| (p, g.x, g.y)))?;
    let around = |i: usize| {
        let turn = std::f64::consts::TAU * (i as f64) / 360.0;
        (x + 10.0 * cos(turn) - 10.0, y + 10.0 * sin(turn))
    };
    let (mut presses, mut steps, mut frames, mut releases) = (vec![], vec![], vec![], vec![]);
    for round in 0..5 {
        presses.push(timed(|| {
            let _ = black_box(session.press(id, &path));
        }));
        // what is let go is not where it was let go before
        for i in 0..STEPS + 7 * round {
            let to = around(i);
            let step = timed(|| {
                black_box(session.drag(id, to));
            });
            if round % 2 == 0 {
                steps.push(step);
            } else {
                frames.push(step + timed(|| drop(black_box(session.picture(id)))));
            }
        }
        releases.push(timed(|| {
            let _ = black_box(session.release(id));
        }));
    }
    Some(Figures {
        open: median(opened),
        press: median(presses),
        step: median(steps),
        frame: median(frames),
        release: median(releases),
    })
}

fn timed(run: impl FnOnce()) -> Duration {
    let start = Instant::now();
    run();
    start.elapsed()
}

/// Returns the middle one, in microseconds.
pub(crate) fn median(mut all: Vec<Duration>) -> f64 {
    all.sort();
    all.get(all.len() / 2).map_or(0.0, |d| d.as_secs_f64() * 1e6)
}
