//! `gcs FILE`: solves one sketch and prints one line of JSON.
//!
//! The file is a case of the format `gcs-case/1` ([`bench::case`]). Of the line: `status` is `solved`
//! where every constraint holds to 1e-8, `not decided` where the search for a solution was given up,
//! `unsolved` where there is none, or no answer in time, and `invalid` for a file that is no case; times
//! are in milliseconds. `build_ms` leads from the file to things whose classes are compiled; there begins
//! what `solve_ms` tells, which plans, and `replan_free_ms`, which has the plan. `gcs --text FILE` prints
//! the document that is solved; `gcs --make FAMILY SIZE SEED` prints a case of a family
//! ([`bench::families`]).

use bench::case::Case;
use bench::families::{FAMILIES, generate};
use bench::measure::{Repeat, measure};
use bench::{document, report};
use std::fs;
use std::io::{self, Write};
use std::process::ExitCode;
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

/// How long an answer is waited for.
const PATIENCE: Duration = Duration::from_secs(120);
/// Deep documents want a deep stack.
const STACK: usize = 256 << 20;

fn main() -> io::Result<ExitCode> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut out = io::stdout().lock();
    match &arguments[..] {
        [file] if !file.starts_with('-') => {
            writeln!(out, "{}", answer(file))?;
            Ok(ExitCode::SUCCESS)
        }
        [option, file] if option == "--text" => {
            let text = fs::read_to_string(file)?;
            let case = Case::read(&text).map_err(io::Error::other)?;
            write!(out, "{}", document::text(&case))?;
            Ok(ExitCode::SUCCESS)
        }
        [option, family, size, seed] if option == "--make" => {
            let family =
                FAMILIES.iter().find(|(name, _)| name == family).map(|(_, family)| *family);
            let (Some(family), Ok(size), Ok(seed)) = (family, size.parse(), seed.parse()) else {
                return usage();
            };
            writeln!(out, "{}", serde_json::to_string(&generate(family, size, seed))?)?;
            Ok(ExitCode::SUCCESS)
        }
        _ => usage(),
    }
}

fn usage() -> io::Result<ExitCode> {
    writeln!(io::stderr(), "usage: gcs FILE | gcs --text FILE | gcs --make FAMILY SIZE SEED")?;
    Ok(ExitCode::from(2))
}

fn answer(file: &str) -> serde_json::Value {
    let text = match fs::read_to_string(file) {
        Ok(text) => text,
        Err(e) => return report::of_failure("invalid", &format!("{file}: {e}")),
    };
    let (give, take) = mpsc::channel();
    let solving = move || {
        // nobody listens any more once the time is over
        let _ = give.send(measure(&text, Repeat::Enough));
    };
    let worker = thread::Builder::new().stack_size(STACK).spawn(solving);
    if let Err(e) = worker {
        return report::of_failure("unsolved", &e.to_string());
    }
    match take.recv_timeout(PATIENCE) {
        Ok(Ok(figures)) => report::of_figures(&figures),
        Ok(Err(why)) => report::of_failure("invalid", &why),
        Err(mpsc::RecvTimeoutError::Timeout) => {
            let seconds = PATIENCE.as_secs();
            report::of_failure("unsolved", &format!("no answer within {seconds} s"))
        }
        Err(mpsc::RecvTimeoutError::Disconnected) => {
            report::of_failure("unsolved", "the solver stopped at a fault of its own")
        }
    }
}
