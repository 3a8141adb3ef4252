//! Sketches in the table: whole solves, numbers alone, analysis, drags, each beside the peer's.

use bench::case::Case;
use bench::families::{FAMILIES, Family, generate};
use bench::measure::{Figures, Repeat, measure_case, median};
use std::fs;
use std::io::Write;
use std::path::Path;

/// Generated cases beside those with files: larger ones, and families without a file.
const GENERATED: [(Family, usize); 12] = [
    (Family::Rectsc, 1000),
    (Family::Indep, 10),
    (Family::Indep, 100),
    (Family::Indep, 1000),
    (Family::Arcs, 500),
    (Family::Truss, 300),
    (Family::Henneberg2, 100),
    (Family::Henneberg2, 300),
    (Family::Grid, 30),
    (Family::Gridr, 20),
    (Family::Linkage, 200),
    (Family::Linkdrag, 200),
];

/// Whole solves from the start, and numbers alone, in milliseconds: solves again and again, *cold* with the
/// processor's caches full of something else, and *whole* from the document's text on.
///
/// Goals: none slower than the peer, 5 times as fast in the geometric mean, 10 times on grids and
/// coincident rectangles; numbers alone 20 times; freedom and redundancy in less time than the solve.
pub(crate) fn first_solves(out: &mut impl Write, filter: &str) -> std::io::Result<()> {
    writeln!(
        out,
        "{:16} {:>9} {:>9} {:>7} {:>6} {:>9} {:>9} {:>9} {:>9} {:>7} {:>6} {:>9} {:>8} {:>9}  state",
        "ms",
        "solve",
        "ezpz",
        "times",
        "goal",
        "cold",
        "ezpz",
        "whole",
        "numbers",
        "times",
        "goal",
        "analysis",
        "of solve",
        "ezpz"
    )?;
    let (mut first, mut again) = (Vec::new(), Vec::new());
    for case in cases(filter)? {
        let figures = figures(&case);
        let peer = peer(&case);
        let goal = match case.name.split('-').next() {
            Some("grid" | "gridr" | "rectsc") => "10",
            _ => "1",
        };
        let (solve, numbers) = (middle(&figures.solve), middle(&figures.numbers));
        let analysis = middle(&figures.analysis);
        let ratio = |of: f64| peer.solve / of;
        if peer.is_solved && figures.is_solved() {
            first.push(ratio(solve));
            again.push(ratio(numbers));
        }
        writeln!(
            out,
            "{:16} {:9.4} {:9.4} {:7.2} {goal:>6} {:9.4} {:9.4} {:9.4} {:9.4} {:7.1} {:>6} {:9.4} {:8.2} {:9.3}  {}",
            case.name,
            solve * 1e3,
            peer.solve * 1e3,
            ratio(solve),
            middle(&figures.cold) * 1e3,
            peer.cold * 1e3,
            middle(&figures.whole) * 1e3,
            numbers * 1e3,
            ratio(numbers),
            "20",
            analysis * 1e3,
            analysis / solve,
            peer.analysis * 1e3,
            state(&figures, &peer),
        )?;
    }
    writeln!(
        out,
        "{:16} {:>9} {:>9} {:7.2} {:>6} {:>9} {:>9} {:>9} {:>9} {:7.1} {:>6}",
        "geometric mean",
        "",
        "",
        mean(&first),
        "5",
        "",
        "",
        "",
        "",
        mean(&again),
        "20"
    )
}

/// Steps of drags, in microseconds; how far a point moves at most in one step.
pub(crate) fn drags(out: &mut impl Write, filter: &str) -> std::io::Result<()> {
    writeln!(
        out,
        "{:16} {:>9} {:>9} {:>9} {:>7} {:>9} {:>7} {:>9}",
        "µs", "press", "step", "ezpz", "times", "goal", "failed", "largest"
    )?;
    for case in cases(filter)?.iter().filter(|c| c.drag.is_some()) {
        let figures = figures(case);
        let Some(drag) = &figures.drag else { continue };
        let (step, peer) = (middle(&drag.steps), peer(case));
        let goal = match case.name.as_str() {
            "linkage-4" => "1",
            "linkage-200" => "100",
            _ => "",
        };
        writeln!(
            out,
            "{:16} {:9.1} {:9.2} {:9.2} {:7.1} {goal:>9} {:7} {:9.3}",
            case.name,
            drag.press * 1e6,
            step * 1e6,
            peer.step * 1e6,
            peer.step / step,
            drag.failed,
            drag.largest_move(),
        )?;
    }
    Ok(())
}

/// Reads the cases with files.
pub(crate) fn read() -> std::io::Result<Vec<Case>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/cases/geometry");
    let mut cases = Vec::new();
    for entry in fs::read_dir(folder)? {
        let text = fs::read_to_string(entry?.path())?;
        cases.push(Case::read(&text).map_err(std::io::Error::other)?);
    }
    cases.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(cases)
}

/// The cases with files and the generated ones, by family and size.
fn cases(filter: &str) -> std::io::Result<Vec<Case>> {
    let mut cases = read()?;
    cases.extend(GENERATED.map(|(family, size)| generate(family, size, 1)));
    cases.retain(|c| c.name.starts_with(filter));
    let place = |case: &Case| {
        let (family, size) = case.name.rsplit_once('-').unwrap_or((&case.name, ""));
        let family = FAMILIES.iter().position(|(name, _)| *name == family);
        (family, size.parse::<usize>().unwrap_or(0))
    };
    cases.sort_by_key(place);
    Ok(cases)
}

fn figures(case: &Case) -> Figures {
    apart(|| measure_case(case, Repeat::Enough).unwrap_or_default())
}

/// Measures in a thread of its own, so that neither solver pays for what the other left behind: kernels of
/// ezpz leave the upper halves of the vector registers in use, and whatever a thread computes after these is
/// up to two thirds slower; and the memory that one has freed lies in pieces for the other.
fn apart<T: Send + Default>(measure: impl FnOnce() -> T + Send) -> T {
    std::thread::scope(|scope| scope.spawn(measure).join()).unwrap_or_default()
}

fn state(figures: &Figures, peer: &Peer) -> String {
    let mut state = String::from(if figures.is_solved() { "solved" } else { "NOT SOLVED" });
    if !peer.is_solved {
        state += ", ezpz not";
    }
    if figures.redundant > 0 {
        state += &format!(", {} redundant", figures.redundant);
    }
    if figures.freedom > 0 {
        state += &format!(", {} free", figures.freedom);
    }
    state
}

/// Medians of the peer's figures, in seconds.
struct Peer {
    solve: f64,
    cold: f64,
    analysis: f64,
    step: f64,
    is_solved: bool,
}

#[cfg(feature = "ezpz")]
fn peer(case: &Case) -> Peer {
    let figures = apart(|| bench::peer::measure(case, Repeat::Enough));
    Peer {
        solve: middle(&figures.solve),
        cold: middle(&figures.cold),
        analysis: middle(&figures.analysis),
        step: middle(&figures.steps),
        // its own measure of satisfaction
        is_solved: figures.residual < 1e-4,
    }
}

#[cfg(not(feature = "ezpz"))]
fn peer(_: &Case) -> Peer {
    Peer { solve: f64::NAN, cold: f64::NAN, analysis: f64::NAN, step: f64::NAN, is_solved: false }
}

fn middle(times: &[f64]) -> f64 {
    median(times).unwrap_or(f64::NAN)
}

fn mean(ratios: &[f64]) -> f64 {
    let logarithms = ratios.iter().map(|&r| base::number::ln(r));
    base::number::exp(logarithms.sum::<f64>() / ratios.len() as f64)
}
