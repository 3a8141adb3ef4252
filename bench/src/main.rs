//! `cargo bench-table`: the figures, beside their goals, and beside ezpz where it can do the same.
//!
//! `cargo bench-table SECTION` prints one section, `cargo bench-table SECTION NAME` the rows whose names
//! begin so: `cargo bench-table sketches rects`. The sections: `sketches`, `drags`, `displaced`, `circuits`,
//! `trusses`, `rows`, `instances`, `programs`, `drafting`, `tape`, `things`, `gallery` (`gallery NAME GRIP` drags by one grip),
//! `browser` (in WebAssembly, in a browser), `lab` (the page as people get it). Figures to
//! read, not tests: nothing here fails for being slow.

mod circuits;
mod displacements;
mod drafting;
mod gallery;
mod instances;
mod programs;
mod rows;
mod sketches;
mod tape;
mod things;

use std::io::{self, Write};
use std::process::{Command, Stdio};

/// The sections, in the order in which they are printed.
const SECTIONS: [&str; 14] = [
    "sketches",
    "drags",
    "displaced",
    "circuits",
    "trusses",
    "rows",
    "instances",
    "programs",
    "drafting",
    "tape",
    "things",
    "gallery",
    "browser",
    "lab",
];

fn main() -> io::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let wanted = arguments.first().map(String::as_str);
    let filter = arguments.get(1).map_or("", String::as_str);
    let grip = arguments.get(2).map(String::as_str);
    if wanted.is_some_and(|w| !SECTIONS.contains(&w)) {
        writeln!(io::stderr(), "the sections are: {}", SECTIONS.join(", "))?;
        return Ok(());
    }
    let out = &mut io::stdout().lock();
    for section in SECTIONS.iter().filter(|s| wanted.is_none_or(|w| w == **s)) {
        writeln!(out, "\n== {section}")?;
        match *section {
            "sketches" => sketches::first_solves(out, filter)?,
            "drags" => sketches::drags(out, filter)?,
            "displaced" => displacements::table(out, filter)?,
            "circuits" => circuits::grids(out, filter)?,
            "trusses" => circuits::trusses(out, filter)?,
            "rows" => rows::table(out, filter)?,
            "instances" => instances::table(out)?,
            "programs" => programs::table(out, filter)?,
            "drafting" => drafting::table(out)?,
            "tape" => tape::table(out)?,
            "things" => things::table(out)?,
            "gallery" => gallery::table(out, filter, grip)?,
            "lab" => figures(out, &["lab"])?,
            _ => browser(out)?,
        }
    }
    Ok(())
}

/// Prints the figures that a browser can tell, native ones first; builds their page and has a browser print it.
fn browser(out: &mut impl Write) -> io::Result<()> {
    writeln!(out, "native\n{}in the browser", bench::browser::table())?;
    figures(out, &[])
}

/// Prints what a browser tells.
fn figures(out: &mut impl Write, of: &[&str]) -> io::Result<()> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let xtask = ["run", "--quiet", "--package", "xtask", "--", "figures"];
    let printed = Command::new(cargo).args(xtask).args(of).stderr(Stdio::inherit()).output()?;
    out.write_all(&printed.stdout)
}
