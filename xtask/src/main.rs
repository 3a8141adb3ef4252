//! `cargo lab` builds the lab and opens it; `cargo verify` tests everything.
//!
//! In reading order: what must be on the machine ([`tools`]), the page's bundle ([`bundle`]), the
//! two commands ([`lab`], [`verify`]), and the rules that the whole tree keeps (`tidy`, a test).

use std::path::{Path, PathBuf};
use std::process::ExitCode;

mod bundle;
mod compiled;
mod documentation;
mod figures;
mod lab;
#[cfg(test)]
mod tidy;
mod tools;
mod verify;

const USAGE: &str = "\
cargo lab [FILE] [--check] [--quick] [--install] [--port N] [--no-open]
    builds the lab, starts its server on this machine, opens a browser where there is one
    --check    build and exit
    --quick    for trying a change: a fast build of a large, slower page
    --install  get what is missing (rustup, or apt-get as root)
cargo verify [--install] [--no-browser] [--long]
    tests everything; the last line is `N passed, N failed`
    --no-browser  leave out the page's bundle and the browser tests
    --long        the properties with many more cases";

/// A line of progress, or of what went wrong.
macro_rules! say {
    ($($part:tt)*) => {{
        use std::io::Write as _;
        // Where standard output is gone, the exit code still tells.
        let _ = writeln!(std::io::stdout(), $($part)*);
    }};
}
use say;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let command = arguments.next().unwrap_or_default();
    let rest: Vec<String> = arguments.collect();
    let outcome = match command.as_str() {
        "lab" => lab::parse(&rest).map(|wish| lab::run(&wish)),
        "figures" => figures::parse(&rest).map(figures::run),
        "verify" => verify::parse(&rest).map(|wish| verify::run(&wish)),
        _ => Err(String::from("lab or verify?")),
    };
    outcome.unwrap_or_else(|why| {
        say!("{why}\n{USAGE}");
        ExitCode::from(2)
    })
}

/// The workspace's folder.
fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask lies in the workspace").into()
}
