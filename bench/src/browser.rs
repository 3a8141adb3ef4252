//! What is measured in the browser: clocks there tell no less than 5 to 100 µs, so that every figure is one of
//! many runs.

use crate::case::{Case, Drag};
use crate::documents::chain;
use crate::families::{Family, generate};
use crate::opened::Opened;
use crate::sketch::{Sketch, wishes};
use plan::{Planner, Plans, Target, Templates};
use std::fmt::Write as _;
use std::hint::black_box;
use web_time::Instant;

/// Sketches, and what a step of their drags should take at most, in microseconds.
const DRAGS: [(Family, usize, &str); 4] = [
    (Family::Linkage, 4, "2.5"),
    (Family::Linkage, 50, ""),
    (Family::Linkage, 200, ""),
    (Family::Linkdrag, 200, ""),
];
/// How long something is done again and again for one figure, in seconds, and how often there is one.
const ENOUGH: f64 = 0.02;
const TIMES: usize = 20;
/// How many first solves are timed together: the clock adds up what it rounds.
const BATCH: usize = 20;

/// Returns the table: for each sketch a first solve and a step of its drag; for a long document its opening, and
/// what a hand waits for that presses it.
pub fn table() -> String {
    let mut out = format!("{:16} {:>9} {:>9} {:>9}\n", "µs", "solve", "step", "goal");
    for (family, size, goal) in DRAGS {
        let case = generate(family, size, 1);
        let said = match figures(&case) {
            Ok([solve, step]) => format!("{:9.1} {:9.2} {goal:>9}", solve * 1e6, step * 1e6),
            Err(why) => why,
        };
        // a String takes all that is written
        let _ = writeln!(out, "{:16} {said}", case.name);
    }
    let _ = writeln!(out, "{}", long(20_000).unwrap_or_else(|why| why));
    out
}

/// Measures a first solve and a step of the drag, in seconds.
fn figures(case: &Case) -> Result<[f64; 2], String> {
    let drag = case.drag.as_ref().ok_or("it has no drag")?;
    let sketch = Sketch::new(case)?;
    let mut templates: Vec<Templates> = Vec::new();
    let solve = least(|| {
        templates.extend((0..BATCH).map(|_| sketch.templates()));
        let begin = Instant::now();
        templates.drain(..).for_each(|templates| drop(black_box(sketch.solve(templates))));
        (begin.elapsed().as_secs_f64(), BATCH)
    });
    let (mut planner, mut values) = sketch.solve(sketch.templates());
    let mut press = sketch.press(&mut planner, &values, drag)?;
    let there = wishes(drag);
    let way: Vec<&Vec<f64>> = there.iter().chain(there.iter().rev()).collect();
    let mut missed = 0;
    let step = least(|| {
        let begin = Instant::now();
        for wish in &way {
            missed += usize::from(!sketch.follow(&mut planner, &mut press, &mut values, wish));
        }
        (begin.elapsed().as_secs_f64(), way.len())
    });
    match drag {
        Drag::Param { .. } if missed > 0 => Err(format!("{missed} values are not reached")),
        Drag::Param { .. } | Drag::Point { .. } => Ok([solve, step]),
    }
}

/// Does something again and again, which says how long it took and how many times it was done; returns the least
/// time that one took.
fn least(mut run: impl FnMut() -> (f64, usize)) -> f64 {
    let one = |_| {
        let (mut seconds, mut count) = (0.0, 0);
        while seconds < ENOUGH {
            let (took, done) = run();
            seconds += took;
            count += done;
        }
        seconds / count as f64
    };
    (0..TIMES).map(one).fold(f64::INFINITY, f64::min)
}

/// Measures a chain of rows: text to things, opening, the first press and another, a step.
fn long(rows: usize) -> Result<String, String> {
    let opened = Opened::new(&chain(rows))?;
    let begin = Instant::now();
    let (_, values, _) = opened.solve();
    let opening = begin.elapsed().as_secs_f64() * 1e3;
    let (mut planner, _) = Planner::new(opened.model(), Plans::default());
    let thing = opened.thing("k").ok_or("there is no k")?;
    let mut press = || {
        let begin = Instant::now();
        let pressed = planner.press(opened.model(), &values, &[Target::Thing(thing)]);
        (begin.elapsed().as_secs_f64() * 1e3, pressed.is_ok())
    };
    let [(first, _), (again, _)] = [press(), press()];
    Ok(format!(
        "{rows} rows, ms: things {:.1}  opening {opening:.1}  press {first:.1}  again {again:.2}",
        opened.made_in * 1e3,
    ))
}
