//! Grids of resistors and trusses in the table: whole documents, from the text to the answer.

use bench::documents::{braced_truss, resistor_grid, warren_truss};
use bench::opened::Opened;
use std::io::Write;
use std::time::Instant;

/// The voltage at the corner with 1 A. **Source:** SuperLU on the nodal equations; ngspice agrees.
const CORNERS: [(usize, Option<f64>, &str); 5] = [
    (10, Some(3.011_669_564_896_55), ""),
    (30, None, ""),
    (100, Some(5.940_830_286_643_118), "0.15 s whole"),
    (200, None, ""),
    (300, None, "1.5 s + 1.5 s"),
];

/// How far the middle sinks, in metres. **Source:** virtual work, exactly; OpenSees for 1000.
const MIDDLES: [(usize, f64, &str); 3] =
    [(10, -0.056_875, ""), (100, -521.312_5, ""), (1000, -5_208_381.25, "30 ms whole")];

/// What the left support of a braced truss carries: half of the load, in newtons.
const REACTIONS: [(usize, f64); 3] = [(10, 55e3), (100, 505e3), (1000, 5_005e3)];

/// Grids of resistors, in milliseconds.
pub(crate) fn grids(out: &mut impl Write, filter: &str) -> std::io::Result<()> {
    head(out)?;
    for (k, voltage, goal) in CORNERS {
        if filter.is_empty() || filter == k.to_string() {
            let name = format!("{k} x {k}");
            whole(out, &name, &resistor_grid(k), "nodes.0.voltage", voltage, goal)?;
        }
    }
    Ok(())
}

/// Warren trusses, in milliseconds.
pub(crate) fn trusses(out: &mut impl Write, filter: &str) -> std::io::Result<()> {
    head(out)?;
    for (n, sag, goal) in MIDDLES {
        if filter.is_empty() || filter == n.to_string() {
            let name = format!("{n} bays");
            let middle = format!("below.{}.uy", n / 2 - 1);
            whole(out, &name, &warren_truss(n), &middle, Some(sag), goal)?;
        }
    }
    for (n, reaction) in REACTIONS {
        if filter.is_empty() || filter == n.to_string() {
            let name = format!("{n} braced");
            whole(out, &name, &braced_truss(n), "pin.reactionY", Some(reaction), "")?;
        }
    }
    Ok(())
}

fn head(out: &mut impl Write) -> std::io::Result<()> {
    writeln!(
        out,
        "{:12} {:>9} {:>9} {:>9} {:>14}  {:>20} {:>9}",
        "ms", "things", "solve", "whole", "goal", "answer", "error"
    )
}

fn whole(
    out: &mut impl Write,
    name: &str,
    text: &str,
    asked: &str,
    known: Option<f64>,
    goal: &str,
) -> std::io::Result<()> {
    let opened = match Opened::new(text) {
        Ok(opened) => opened,
        Err(why) => return writeln!(out, "{name:12} {why}"),
    };
    let begin = Instant::now();
    let (_, values, report) = opened.solve();
    let solve = begin.elapsed().as_secs_f64();
    let answer = opened.slots(asked).first().map_or(f64::NAN, |&slot| values.numbers[slot]);
    let error =
        known.map_or(String::new(), |known| format!("{:.1e}", (answer / known - 1.0).abs()));
    let state = if report.unmet.is_empty() { "" } else { "  NOT SOLVED" };
    writeln!(
        out,
        "{name:12} {:9.1} {:9.1} {:9.1} {goal:>14}  {answer:20.13} {error:>9}{state}",
        opened.made_in * 1e3,
        solve * 1e3,
        (opened.made_in + solve) * 1e3,
    )
}
