//! Displaced starts and typed dimensions in the table: how often the intended solution is come to.

use bench::case::Case;
use bench::displaced::{DISPLACEMENTS, Reached, Typed, displaced, reached, typed};
use bench::sketch::Sketch;
use std::io::Write;

/// Sketches with more points are left out: whoever keeps the sides of a hundred keeps those of a thousand.
const LARGEST: usize = 1000;
/// How many dimensions of a sketch are typed anew, and by how much.
const TYPED: usize = 7;
const TIMES: [f64; 2] = [1.2, 0.8];

/// Counts the intended solutions, the mirrored ones and those not found, of each displacement; goal: 95 % intended,
/// none unsolved. Then dimensions changed by typing, which shall lie as where they are set; goal: none flips.
pub(crate) fn table(out: &mut impl Write, filter: &str) -> std::io::Result<()> {
    let mut cases = super::sketches::read()?;
    cases.retain(|c| c.well_constrained && c.start.len() <= LARGEST && c.name.starts_with(filter));
    writeln!(
        out,
        "{:10} {:>8} {:>9} {:>9} {:>9} {:>6} {:>6}  other than intended",
        "", "solves", "intended", "mirrored", "unsolved", "%", "ezpz"
    )?;
    for (name, by) in DISPLACEMENTS {
        let mut counts = [0; 3];
        let (mut peer, mut short) = (0, Vec::new());
        for case in &cases {
            for by in by {
                let start = displaced(case, by);
                let came = solved(&start).map_or(Reached::Unsolved, |p| reached(case, &p));
                counts[came as usize] += 1;
                if came != Reached::Intended && !short.contains(&case.name) {
                    short.push(case.name.clone());
                }
                peer += usize::from(
                    by_peer(&start).is_some_and(|p| reached(case, &p) == Reached::Intended),
                );
            }
        }
        let [intended, mirrored, unsolved] = counts;
        let solves: usize = counts.iter().sum();
        let part = 100.0 * intended as f64 / solves.max(1) as f64;
        writeln!(
            out,
            "{name:10} {solves:8} {intended:9} {mirrored:9} {unsolved:9} {part:6.1} {peer:6}  {}",
            short.join(" ")
        )?;
    }
    let mut counts = [0; 3];
    let mut short = Vec::new();
    for case in cases.iter().filter(|c| c.start.len() <= 100) {
        let valued: Vec<usize> =
            (0..case.constraints.len()).filter(|&c| case.with_value(c, 1.0).is_some()).collect();
        let step = valued.len().div_ceil(TYPED).max(1);
        for (&c, times) in valued.iter().step_by(step).flat_map(|c| TIMES.map(|times| (c, times))) {
            let Some(came) = typed(case, c, times) else { continue };
            counts[came as usize] += 1;
            if came == Typed::Flipped {
                short.push(format!("{}:c{c}", case.name));
            }
        }
    }
    let [alike, flipped, refused] = counts;
    writeln!(
        out,
        "typed: {alike} as set, {flipped} flipped, {refused} refused  {}",
        short.join(" ")
    )
}

fn solved(case: &Case) -> Option<Vec<[f64; 2]>> {
    let sketch = Sketch::new(case).ok()?;
    let (_, values) = sketch.solve(sketch.templates());
    Some(sketch.points(&values))
}

#[cfg(feature = "ezpz")]
fn by_peer(case: &Case) -> Option<Vec<[f64; 2]>> {
    bench::peer::solved(case)
}

#[cfg(not(feature = "ezpz"))]
fn by_peer(_: &Case) -> Option<Vec<[f64; 2]>> {
    None
}
