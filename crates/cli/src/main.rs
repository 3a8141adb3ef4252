//! The `thinglab` command: every subcommand reads its arguments here and has a module of its own.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use commands::{Form, FormatMode, Leniency, Report};
use documents::{OpenError, Source};

mod commands;
mod disk;
mod documents;
mod embedded;
mod family;
mod import;
mod journal;
mod plot;
mod rows;
mod serve;

/// A constraint laboratory: documents whose constraints stay true.
#[derive(Debug, Parser)]
#[command(name = "thinglab", version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Answers with one JSON object, for programs.
    #[arg(long, global = true)]
    json: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Says what is wrong with documents, with the source line, a code and a hint.
    Check {
        /// Files, or folders with documents; `-` is standard input.
        #[arg(required = true)]
        files: Vec<PathBuf>,
        /// Warnings make it fail too.
        #[arg(long)]
        strict: bool,
    },
    /// Runs the `check` blocks of documents.
    Test {
        /// Files, or folders with documents; `-` is standard input.
        #[arg(required = true)]
        files: Vec<PathBuf>,
        /// Names each check, those that passed as well.
        #[arg(short, long)]
        verbose: bool,
    },
    /// Opens a document and prints its values.
    ///
    /// Marks: `=` given in the text, `!` anchored, `~` arbitrary, as nothing decides it.
    Run {
        #[command(flatten)]
        source: Source,
        /// Lists everything, where things are drawn and what pictures compute as well.
        #[arg(long)]
        all: bool,
    },
    /// Explains the plan of a document, or why one value is what it is.
    Explain {
        #[command(flatten)]
        source: Source,
        /// The path of the value, such as q.side1.p1.x.
        path: Option<String>,
    },
    /// Says which classes some parts of a document could be the parts of.
    Recognise {
        /// The document.
        file: PathBuf,
        /// The paths of the parts, at most six.
        #[arg(required = true)]
        parts: Vec<String>,
    },
    /// Says what is free in a document, what says nothing new, and what cannot hold together.
    Analyse {
        #[command(flatten)]
        source: Source,
    },
    /// Draws a document as SVG, or as DXF where the file that it is written to ends in `.dxf`.
    Draw {
        #[command(flatten)]
        source: Source,
        /// Where to write; standard output without it.
        #[arg(short, long)]
        output: Option<PathBuf>,
        /// With what constraints say: dimensions, and signs of relations.
        #[arg(long)]
        dimensions: bool,
    },
    /// Draws every row of a table with a program, each at scale, with an index of all.
    Family(family::Arguments),
    /// Plots numbers over a value that is swept through a range, as CSV or as a chart.
    Plot(plot::Arguments),
    /// Makes a document of a DXF drawing; points that coincide are merged, what is not understood is listed.
    Import {
        /// The drawing.
        file: PathBuf,
        /// Where to write; standard output without it.
        #[arg(short, long)]
        output: Option<PathBuf>,
    },
    /// Lays documents out as the language wants it, keeping comments.
    Fmt {
        /// Files, or folders with documents; `-` is standard input.
        #[arg(required = true)]
        files: Vec<PathBuf>,
        /// Only says which would change, and fails if any would.
        #[arg(long)]
        check: bool,
    },
    /// Opens the lab in the browser, on this machine alone.
    Serve(serve::Arguments),
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let form = if arguments.json { Form::Json } else { Form::Words };
    let report = match &arguments.command {
        Command::Serve(arguments) => return serve::run(arguments),
        Command::Check { files, strict } => {
            let most = if *strict { Leniency::Nothing } else { Leniency::Warnings };
            commands::check(files, form, most)
        }
        Command::Test { files, verbose } => {
            let checks = if *verbose { commands::Checks::All } else { commands::Checks::Failed };
            commands::test(files, checks, form)
        }
        Command::Run { source, all } => {
            let rows = if *all { commands::Rows::All } else { commands::Rows::OfLaw };
            commands::run(source, rows, form)
        }
        Command::Explain { source, path } => commands::explain(source, path.as_deref(), form),
        Command::Recognise { file, parts } => commands::recognise(file, parts, form),
        Command::Analyse { source } => commands::analyse(source, form),
        Command::Draw { source, output, dimensions } => {
            let dimensions = match dimensions {
                true => commands::Dimensions::Shown,
                false => commands::Dimensions::LeftOut,
            };
            commands::draw(source, output.as_deref(), dimensions, form)
        }
        Command::Family(arguments) => family::run(arguments, form),
        Command::Plot(arguments) => plot::run(arguments, form),
        Command::Import { file, output } => import::run(file, output.as_deref(), form),
        Command::Fmt { files, check } => {
            let mode = if *check { FormatMode::Check } else { FormatMode::Write };
            commands::fmt(files, mode, form)
        }
    };
    finish(report, form)
}

/// Prints a report: 0 if all is well, 1 if something is wrong with the documents, 2 without an answer.
fn finish(report: Result<Report, OpenError>, form: Form) -> ExitCode {
    match report {
        Ok(report) => {
            // A reader that went away has read enough.
            let _ = std::io::stdout().write_all(report.text.as_bytes());
            let _ = std::io::stderr().write_all(report.aside.as_bytes());
            if report.good { ExitCode::SUCCESS } else { ExitCode::FAILURE }
        }
        Err(error) => {
            if form == Form::Json {
                let told = serde_json::json!({ "error": error.to_string() });
                let _ = writeln!(std::io::stdout(), "{told}");
            }
            let _ = writeln!(std::io::stderr(), "thinglab: {error}");
            ExitCode::from(2)
        }
    }
}
