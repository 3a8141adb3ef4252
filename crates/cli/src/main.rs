//! The `thinglab` command: every subcommand reads its arguments here and has a module of its own.

use std::process::ExitCode;

use clap::{Parser, Subcommand};

mod disk;
mod embedded;
mod serve;

/// A constraint laboratory: documents whose constraints stay true.
#[derive(Debug, Parser)]
#[command(name = "thinglab", version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Opens the lab in the browser, on this machine alone.
    Serve(serve::Arguments),
}

fn main() -> ExitCode {
    match Arguments::parse().command {
        Command::Serve(arguments) => serve::run(&arguments),
    }
}
