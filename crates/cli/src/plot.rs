//! `thinglab plot`: numbers over a value that is swept through a range, as CSV or as a chart.

use crate::commands::{Form, Report};
use crate::documents::{OpenError, Source};
use serde_json::json;
use session::plotting::{Request, Sweep};
use std::path::PathBuf;

/// How large a chart is, in pixels.
const CHART: (f64, f64) = (720.0, 420.0);

#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    source: Source,
    /// What is shown: paths or expressions; a number makes a curve, a place its locus.
    #[arg(required = true)]
    show: Vec<String>,
    /// The path of the number that is swept.
    #[arg(long)]
    sweep: String,
    /// The value at one end, such as "0 ohm".
    #[arg(long, allow_hyphen_values = true)]
    from: String,
    /// The value at the other end.
    #[arg(long, allow_hyphen_values = true)]
    to: String,
    /// What the curves are shown over, where it is not what is swept.
    #[arg(long)]
    over: Option<String>,
    /// How many steps there are from end to end.
    #[arg(long, default_value_t = 200)]
    steps: u32,
    /// Where to write: a chart where it ends in `.svg`, else CSV; without it CSV onto standard output.
    #[arg(short, long)]
    output: Option<PathBuf>,
}

/// Makes the plot and writes it.
///
/// # Errors
/// If the file cannot be read or written, or there is nothing to plot.
pub(crate) fn run(arguments: &Arguments, form: Form) -> Result<Report, OpenError> {
    let Arguments { source, show, sweep, from, to, over, steps, output } = arguments;
    let file = &source.file;
    let opened = source.open()?;
    let [of, from, to] = [sweep, from, to].map(Clone::clone);
    let sweep = Some(Sweep { of, from, to, steps: *steps });
    let request = Request { show: show.clone(), over: over.clone(), sweep };
    let plot = opened.session.plot(opened.id, &request).map_err(|refusal| {
        OpenError::Refused(format!("{}: {}", file.display(), refusal.message))
    })?;
    let aside: String =
        plot.notes.iter().map(|note| format!("the plot ends early: {note}\n")).collect();
    let text = match output {
        None if form == Form::Json => format!("{}\n", json!({ "path": file, "plot": plot })),
        None => plot.csv(),
        Some(output) => {
            let is_chart = output.extension().is_some_and(|e| e.eq_ignore_ascii_case("svg"));
            let written = if is_chart { plot.svg(CHART) } else { plot.csv() };
            std::fs::write(output, written)
                .map_err(|source| OpenError::Unreadable { path: output.clone(), source })?;
            match form {
                Form::Words => format!("{}\n", output.display()),
                Form::Json => format!("{}\n", json!({ "path": file, "plot": plot })),
            }
        }
    };
    let aside = if form == Form::Words { aside } else { String::new() };
    Ok(Report { text, aside, good: true })
}
