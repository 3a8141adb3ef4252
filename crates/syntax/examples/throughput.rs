//! How fast a text becomes a tree: parses every file named, repeated to some megabytes, and prints MB/s.
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a command that prints a figure")]

use base::FileId;
use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let mut text = String::new();
    for path in std::env::args().skip(1) {
        match std::fs::read_to_string(&path) {
            Ok(file) => text += &file,
            Err(error) => {
                eprint!("{path}: {error}");
                return ExitCode::FAILURE;
            }
        }
    }
    let text = text.repeat(8_000_000 / text.len().max(1) + 1);
    let start = Instant::now();
    let parse = syntax::parse(FileId(0), &text);
    let seconds = start.elapsed().as_secs_f64();
    print!(
        "{:.1} MB/s, {} diagnostics",
        text.len() as f64 / 1e6 / seconds,
        parse.diagnostics().len()
    );
    ExitCode::SUCCESS
}
