//! Instances in the table: many things of one class are planned once.

use bench::documents::linkages;
use bench::opened::Opened;
use std::io::Write;
use std::time::Instant;

/// Opening documents of many four-bar linkages: how many systems were planned.
pub(crate) fn table(out: &mut impl Write) -> std::io::Result<()> {
    writeln!(
        out,
        "{:16} {:>9} {:>9} {:>9} {:>9} {:>9}",
        "ms", "things", "solve", "planned", "reused", "µs each"
    )?;
    for n in [1, 1000, 10_000] {
        let opened = match Opened::new(&linkages(n)) {
            Ok(opened) => opened,
            Err(why) => return writeln!(out, "{why}"),
        };
        let begin = Instant::now();
        let (planner, _, report) = opened.solve();
        let solve = begin.elapsed().as_secs_f64();
        let counts = planner.plan_counts();
        let state = if report.unmet.is_empty() { "" } else { "  NOT SOLVED" };
        writeln!(
            out,
            "{:16} {:9.1} {:9.2} {:9} {:9} {:9.2}{state}",
            format!("{n} linkages"),
            opened.made_in * 1e3,
            solve * 1e3,
            counts.planned,
            counts.reused,
            solve * 1e6 / n as f64,
        )?;
    }
    Ok(())
}
