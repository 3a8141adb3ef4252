//! A hundred thousand rows in the table: planning a projection and a chain, and running them beside
//! plain Rust of the same arithmetic.

use bench::documents::{chain, projection};
use bench::measure::{Repeat, median, repeated};
use bench::opened::Opened;
use plan::{Planner, Plans, Target};
use std::hint::black_box;
use std::io::Write;
use std::time::Instant;

const ROWS: usize = 100_000;

/// Nanoseconds a row: rules from things, plans from rules at a press, the same with the plan kept, a
/// step of the drag that computes every row anew, and a loop in Rust that does.
pub(crate) fn table(out: &mut impl Write, filter: &str) -> std::io::Result<()> {
    writeln!(
        out,
        "{:12} {:>9} {:>9} {:>9} {:>6} {:>9} {:>9} {:>9} {:>7}",
        "ns a row", "rules", "press", "planning", "goal", "again", "step", "Rust", "times"
    )?;
    let projected = (projection(ROWS), "k", plain_projection as fn(f64) -> f64);
    let chained = (chain(ROWS), "k", plain_chain as fn(f64) -> f64);
    for (name, (text, grip, plain)) in [("projection", projected), ("chain", chained)] {
        if name.starts_with(filter) {
            measure(out, name, &text, grip, plain)?;
        }
    }
    Ok(())
}

fn measure(
    out: &mut impl Write,
    name: &str,
    text: &str,
    grip: &str,
    plain: fn(f64) -> f64,
) -> std::io::Result<()> {
    let opened = match Opened::new(text) {
        Ok(opened) => opened,
        Err(why) => return writeln!(out, "{name:12} {why}"),
    };
    let (_, values, report) = opened.solve();
    assert!(report.unmet.is_empty(), "a projection and a chain have a solution");
    let each = |seconds: f64| seconds * 1e9 / ROWS as f64;
    let (rules, (mut planner, _)) = timed(|| Planner::new(opened.model(), Plans::default()));
    let Some(thing) = opened.thing(grip) else { return Ok(()) };
    let targets = [Target::Thing(thing)];
    let mut press = || timed(|| planner.press(opened.model(), &values, &targets));
    let (first, _) = press();
    let (again, pressed) = press();
    let Ok(mut pressed) = pressed else { return writeln!(out, "{name:12} cannot be pressed") };
    let mut dragged = values.clone();
    let mut wish = 1.0;
    let (steps, _) = repeated(Repeat::Enough, || {
        wish += 1e-9;
        let report =
            planner.drag(opened.model(), &mut pressed, &mut dragged, &[wish], &mut opened.host());
        assert!(report.reached, "the wish is reached");
    });
    let (loops, _) = repeated(Repeat::Enough, || plain(black_box(1.000_000_1)));
    let (step, rust) = (median(&steps).unwrap_or(f64::NAN), median(&loops).unwrap_or(f64::NAN));
    writeln!(
        out,
        "{name:12} {:9.1} {:9.1} {:9.1} {:>6} {:9.1} {:9.2} {:9.2} {:7.1}",
        each(rules),
        each(first),
        each(rules + first),
        "60",
        each(again),
        each(step),
        each(rust),
        step / rust,
    )
}

fn plain_projection(k: f64) -> f64 {
    let a: Vec<f64> = (0..ROWS).map(|i| 0.25 * i as f64).collect();
    let mut b = vec![0.0; ROWS];
    for (b, a) in b.iter_mut().zip(&a) {
        *b = k * a + 0.5;
    }
    black_box(&b)[ROWS - 1]
}

fn plain_chain(k: f64) -> f64 {
    let mut b = vec![0.0; ROWS];
    let mut a = 1.0;
    for b in &mut b {
        a = k * a + 0.5;
        *b = a;
    }
    black_box(&b)[ROWS - 1]
}

fn timed<T>(run: impl FnOnce() -> T) -> (f64, T) {
    let begin = Instant::now();
    let result = run();
    (begin.elapsed().as_secs_f64(), result)
}
