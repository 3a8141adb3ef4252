//! The subcommands that work on documents: each returns what to print and whether all is well.
//!
//! With `--json` each prints one JSON object: `check` {files: [{path, diagnostics, problems, lessons, status}], errors,
//! warnings}, `test` {files: [{path, checks, diagnostics}], passed, failed}, `run` {path, values,
//! arbitrary, status, diagnostics}, `explain` the explanation, with what holds the thing in `held`, where else it could be in
//! `ghosts` and what would make less to be solved together in `advice`, `analyse` the analysis, `recognise`
//! {path, classes}, `draw` {path, svg, undrawn, unpictured}, `fmt` {files: [{path, changed, error}]}, with the `text` of
//! standard input. What cannot be read at all is {error}. The shapes of their parts are those of `session::view`.

use crate::documents::{self, OpenError, Opened, Source, find, is_standard_input, open};
use crate::family::Format;
use crate::rows::{self, Row};
use presentation::annotations::{self, Moved};
use serde_json::{Value, json};
use session::view::{Advice, CheckReport, DiagnosticView, Explanation, PictureView, ValueRow};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// What a command has to say.
pub(crate) struct Report {
    /// For standard output.
    pub(crate) text: String,
    /// For people beside it, where standard output is for a program.
    pub(crate) aside: String,
    /// Whether the command found everything in order.
    pub(crate) good: bool,
}

/// How a command answers.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Form {
    /// For people.
    Words,
    /// For programs.
    Json,
}

/// What `check` lets pass.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Leniency {
    /// Warnings; errors fail.
    Warnings,
    /// Nothing: warnings fail too.
    Nothing,
}

fn report(form: Form, good: bool, words: String, json: &Value) -> Report {
    let text = match form {
        Form::Words => words,
        Form::Json => format!("{json}\n"),
    };
    Report { text, aside: String::new(), good }
}

/// The code of what is given and gives way.
const GIVES_WAY: &str = "given-yields";

/// Prints the diagnostics of documents, with their source lines.
///
/// # Errors
/// If a file cannot be read.
pub(crate) fn check(
    arguments: &[PathBuf],
    form: Form,
    most: Leniency,
) -> Result<Report, OpenError> {
    let (mut words, mut files, mut errors, mut warnings) = (String::new(), Vec::new(), 0, 0);
    for path in find(arguments)? {
        let mut opened = open(&path)?;
        let mut diagnostics = opened.session.text(opened.id).diagnostics;
        diagnostics.extend(opened.session.tables_outside(opened.id));
        let problems = opened.session.problems(opened.id);
        // what cannot hold may well follow from what is missing
        let is_broken = diagnostics.iter().any(|d| d.severity == "error");
        let told = if is_broken { &[] } else { problems.as_slice() };
        // so may what gives way
        let (kept, later): (Vec<_>, Vec<_>) =
            diagnostics.iter().partition(|d| !is_broken || d.code != GIVES_WAY);
        for d in kept.into_iter().chain(told) {
            words.push_str(&show_diagnostic(&opened, d));
            match d.severity.as_str() {
                _ if d.code == session::MORE => {}
                "error" => errors += 1,
                _ => warnings += 1,
            }
        }
        let untold = opened.session.untold(opened.id);
        errors += untold.errors;
        warnings += untold.warnings;
        let lessons = opened.session.run_lessons(opened.id);
        for lesson in lessons.iter().filter(|lesson| !lesson.passed) {
            words.push_str(&show_report(&path, lesson, "lesson"));
            errors += 1;
        }
        let status = opened.session.status(opened.id);
        let is_told = |note: &&String| {
            let mut all = diagnostics.iter().chain(&problems);
            let yields = all.any(|told| told.code == GIVES_WAY);
            is_broken || yields && note.starts_with(session::GAVE_WAY)
        };
        for note in status.notes.iter().filter(|note| !is_told(note)) {
            let _ = writeln!(words, "{}: {note}", path.display());
        }
        if told.len() < problems.len() || !later.is_empty() {
            let rest = "what cannot hold, or gives way, is told once the text has no errors";
            let _ = writeln!(words, "{}: {rest}", path.display());
        }
        let found = json!({
            "path": path,
            "diagnostics": in_files(&path, diagnostics),
            "problems": in_files(&path, problems),
            "lessons": lessons,
            "status": status,
        });
        files.push(found);
    }
    let counts = [(files.len(), "file"), (errors, "error"), (warnings, "warning")].map(counted);
    let _ = writeln!(words, "{}", counts.join(", "));
    Ok(report(
        form,
        errors == 0 && (most == Leniency::Warnings || warnings == 0),
        words,
        &json!({ "files": files, "errors": errors, "warnings": warnings }),
    ))
}

/// Gives what is said of a document's own text the path by which it was asked for.
fn in_files(path: &Path, mut diagnostics: Vec<DiagnosticView>) -> Vec<DiagnosticView> {
    let own = path.display().to_string();
    for d in &mut diagnostics {
        let files = d.labels.iter_mut().map(|label| &mut label.file).chain([&mut d.file]);
        files.filter(|file| file.is_empty()).for_each(|file| file.clone_from(&own));
    }
    diagnostics
}

/// Returns a number of things of a kind in words: `1 file`, `0 files`.
fn counted((count, kind): (usize, &str)) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{count} {kind}{ending}")
}

/// So many characters of a line are shown.
const WIDEST: usize = 120;
/// So many bytes of a line are looked at on either side: more than are shown.
const FARTHEST: usize = 8 * WIDEST;

/// Returns what is shown of the line around a byte of a text, and how many characters stand before it there.
fn around(text: &str, at: usize) -> (String, usize) {
    let (before, after) = text.split_at_checked(at).unwrap_or((text, ""));
    let near = &before[before.floor_char_boundary(before.len().saturating_sub(FARTHEST))..];
    let before = near.rsplit('\n').next().unwrap_or_default();
    let near = &after[..after.floor_char_boundary(FARTHEST)];
    let after = near.lines().next().unwrap_or_default();
    let is_short = before.len() + after.len() <= WIDEST;
    // of a long line, half the width comes before
    let most = if is_short { WIDEST } else { WIDEST / 2 };
    let mut shown: Vec<char> = before.chars().rev().take(most).collect();
    shown.reverse();
    let count = shown.len();
    let shown = shown.into_iter().chain(after.chars()).take(WIDEST);
    // what would move the terminal's cursor is left out
    (shown.map(|c| if c.is_control() { ' ' } else { c }).collect(), count)
}

fn show_diagnostic(opened: &Opened, d: &DiagnosticView) -> String {
    let mut words = String::new();
    let own = || opened.path.display().to_string();
    let file = if d.file.is_empty() { own() } else { d.file.clone() };
    let _ = writeln!(words, "{}[{}]: {}", d.severity, d.code, d.message);
    let _ = writeln!(words, "  --> {file}:{}:{}", d.line, d.column);
    if d.file.is_empty() {
        let (line, before) = around(&opened.text, d.start as usize);
        let marked = opened.text.get(d.start as usize..d.end as usize).unwrap_or_default();
        let width = marked.chars().take(WIDEST - before).take_while(|c| *c != '\n');
        let width = width.count().max(1);
        let gutter = d.line.to_string();
        let blank = " ".repeat(gutter.len());
        let indent = " ".repeat(before);
        let _ = writeln!(
            words,
            "{blank} |\n{gutter} | {line}\n{blank} | {indent}{}",
            "^".repeat(width)
        );
    }
    for label in &d.labels {
        let file = if label.file.is_empty() { own() } else { label.file.clone() };
        let _ = writeln!(words, "  {file}:{}:{}: {}", label.line, label.column, label.message);
    }
    if let Some(hint) = &d.hint {
        let _ = writeln!(words, "  hint: {hint}");
    }
    for fix in &d.fixes {
        let _ = writeln!(words, "  fix: {}", fix.title);
    }
    words.push('\n');
    words
}

/// Runs the `check` blocks of documents.
///
/// # Errors
/// If a file cannot be read.
pub(crate) fn test(arguments: &[PathBuf], which: Checks, form: Form) -> Result<Report, OpenError> {
    let (mut words, mut files, mut passed, mut failed) = (String::new(), Vec::new(), 0, 0);
    for path in find(arguments)? {
        let opened = open(&path)?;
        let diagnostics: Vec<DiagnosticView> = opened.session.text(opened.id).diagnostics;
        let broken: Vec<_> = diagnostics.iter().filter(|d| d.severity == "error").collect();
        for d in &broken {
            words.push_str(&show_diagnostic(&opened, d));
        }
        let checks = opened.session.run_checks(opened.id);
        for check in &checks {
            passed += usize::from(check.passed);
            failed += usize::from(!check.passed);
            words.push_str(&show_check(&path, check, which));
        }
        failed += usize::from(!broken.is_empty());
        let diagnostics = in_files(&path, diagnostics);
        files.push(json!({ "path": path, "checks": checks, "diagnostics": diagnostics }));
    }
    let _ = writeln!(words, "{passed} passed, {failed} failed");
    Ok(report(
        form,
        failed == 0,
        words,
        &json!({ "files": files, "passed": passed, "failed": failed }),
    ))
}

/// Which checks `test` names.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Checks {
    /// Those that fell short.
    Failed,
    /// Each.
    All,
}

fn show_check(path: &Path, check: &CheckReport, which: Checks) -> String {
    if check.passed {
        return match which {
            Checks::Failed => String::new(),
            Checks::All => {
                format!("{}:{}: check \"{}\" passed\n", path.display(), check.line, check.title)
            }
        };
    }
    show_report(path, check, "check")
}

/// Says what fell short of a check or a lesson.
fn show_report(path: &Path, report: &CheckReport, kind: &str) -> String {
    let mut words = String::new();
    let (path, line, title) = (path.display(), report.line, &report.title);
    let _ = writeln!(words, "{path}:{line}: {kind} \"{title}\" fell short");
    for shortfall in &report.shortfalls {
        let _ = writeln!(words, "  line {}: {}", shortfall.line, shortfall.statement);
        for line in shortfall.message.lines() {
            let _ = writeln!(words, "    {line}");
        }
    }
    words
}

/// Which values `run` lists.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Rows {
    /// Those that are not of layout alone.
    OfLaw,
    /// All.
    All,
}

/// Opens a document and prints its values: to six digits in an engineer's units, or exactly with `--json`.
///
/// # Errors
/// If the file cannot be read, or a value not set.
pub(crate) fn run(source: &Source, which: Rows, form: Form) -> Result<Report, OpenError> {
    let path = &source.file;
    let mut opened = source.open_sparingly()?;
    let mut words = String::new();
    let diagnostics = opened.session.text(opened.id).diagnostics;
    for d in &diagnostics {
        words.push_str(&show_diagnostic(&opened, d));
    }
    let arbitrary = opened.session.arbitrary(opened.id);
    opened.session.forget_plans(opened.id);
    if form == Form::Words {
        let mut rows: Vec<Row> = Vec::new();
        // a row that is kept as it is would take more room than the document itself, where that is large
        opened.session.each_value(opened.id, &mut |row: ValueRow| {
            if which == Rows::All || !row.is_layout {
                let mark = mark(&row, &arbitrary);
                rows.push(Row::of(row, mark));
            }
        });
        words.push_str(&rows::written(&rows));
        if rows.iter().any(|row| row.mark == '~') {
            words.push_str("~ arbitrary: nothing decides it\n");
        }
    }
    let status = opened.session.status(opened.id);
    let _ = writeln!(words, "{}", status.message);
    let good = status.satisfied && diagnostics.iter().all(|d| d.severity != "error");
    let json = |opened: &Opened| {
        json!({
            "path": path,
            "values": opened.session.values_in_si(opened.id),
            "arbitrary": arbitrary,
            "status": status,
            "diagnostics": in_files(path, diagnostics.clone()),
        })
    };
    Ok(match form {
        Form::Words => Report { text: words, aside: String::new(), good },
        Form::Json => report(form, good, words, &json(&opened)),
    })
}

/// Marks how a value comes about.
fn mark(row: &ValueRow, arbitrary: &BTreeSet<String>) -> char {
    if row.anchored {
        '!'
    } else if row.given {
        '='
    } else if !row.is_virtual && arbitrary.contains(&row.path) {
        '~'
    } else {
        ' '
    }
}

/// Explains the plan of a document, or why one value is what it is.
///
/// # Errors
/// If the file cannot be read.
pub(crate) fn explain(
    source: &Source,
    about: Option<&str>,
    form: Form,
) -> Result<Report, OpenError> {
    let mut opened = source.open()?;
    let about = match about.map(session::parse_path) {
        Some(None) => {
            let words =
                "that is no path: write it as in the language, such as q.side1.p1.x\n".to_string();
            return Ok(report(form, false, words.clone(), &json!({ "error": words })));
        }
        Some(path) => path,
        None => None,
    };
    let explanation: Explanation = opened.session.explain(opened.id, about.as_ref());
    let held = about.as_ref().and_then(|path| opened.session.held(opened.id, path));
    let ghosts = about.as_ref().map(|path| opened.session.ghosts(opened.id, path));
    let leads_somewhere = !matches!(ghosts, Some(Err(_)));
    let ghosts = ghosts.and_then(Result::ok).unwrap_or_default();
    let mut words = format!("{}\n", explanation.summary);
    for warning in &explanation.warnings {
        let _ = writeln!(words, "warning: {warning}.");
    }
    let advice = if about.is_none() { opened.session.advice(opened.id) } else { Vec::new() };
    write_advice(&mut words, &advice);
    for ghost in &ghosts {
        let _ = writeln!(words, "It could also be: {}.", ghost.label);
    }
    if let Some(held) = &held {
        let _ = writeln!(words, "{}.", held.message);
    }
    for (i, step) in explanation.steps.iter().enumerate() {
        let (targets, values) = (first_ones(&step.targets), first_ones(&step.values));
        let _ = writeln!(words, "\n{:3}. {targets}: {}", i + 1, step.method);
        if !step.formula.is_empty() {
            let _ = writeln!(words, "       {}", step.formula.replace('\n', "\n       "));
        }
        if !step.reason.is_empty() {
            let _ = writeln!(words, "     because {}", step.reason);
        }
        if !values.is_empty() {
            let _ = writeln!(words, "     now {values}");
        }
    }
    let mut json = json!(explanation);
    json["held"] = json!(held);
    json["ghosts"] = json!(ghosts);
    json["advice"] = json!(advice);
    Ok(report(form, leads_somewhere, words, &json))
}

/// Lists the first dozen, and how many more there are.
fn first_ones(items: &[String]) -> String {
    const MOST: usize = 12;
    let first = items[..items.len().min(MOST)].join(", ");
    match items.len().saturating_sub(MOST) {
        0 => first,
        more => format!("{first} and {more} more"),
    }
}

/// Says which classes some parts of a document could be the parts of.
///
/// # Errors
/// If the file cannot be read.
pub(crate) fn recognise(path: &Path, parts: &[String], form: Form) -> Result<Report, OpenError> {
    let opened = open(path)?;
    let paths: Option<Vec<session::Path>> = parts.iter().map(|p| session::parse_path(p)).collect();
    let found = match paths.map(|paths| opened.session.recognise(opened.id, &paths)) {
        Some(Ok(found)) => found,
        wrong => {
            let refusal = wrong.and_then(Result::err).map(|r| r.message);
            let message = refusal.unwrap_or_else(|| "that is no path".to_string());
            let json = json!({ "path": path, "error": message });
            return Ok(report(form, false, format!("{message}\n"), &json));
        }
    };
    let mut words = String::new();
    for class in &found {
        let parts = class.parts.iter().map(|(field, part)| format!("{field} = {part}"));
        let parts = parts.collect::<Vec<_>>().join(", ");
        let _ = writeln!(words, "{} ({} rules): {parts}", class.class, class.constraints);
    }
    if found.is_empty() {
        words.push_str("these are the parts of no class in scope\n");
    }
    Ok(report(form, !found.is_empty(), words, &json!({ "path": path, "classes": found })))
}

/// Says what is free in a document, what is superfluous and what cannot hold together.
///
/// # Errors
/// If the file cannot be read.
pub(crate) fn analyse(source: &Source, form: Form) -> Result<Report, OpenError> {
    let mut opened = source.open()?;
    let analysis = opened.session.analysis(opened.id);
    let mut words = format!("degrees of freedom: {}\n", analysis.freedom);
    for motion in &analysis.motions {
        let _ = writeln!(words, "  {}", motion.summary);
    }
    if analysis.motions.len() == session::MOST_MOTIONS {
        let told = analysis.motions.len() as u32;
        let _ = writeln!(words, "  and {} more", analysis.freedom.saturating_sub(told));
    }
    if !analysis.redundant.is_empty() {
        let _ = writeln!(words, "constraints that say nothing new: {}", analysis.redundant.len());
    }
    for redundant in &analysis.redundant {
        let _ = writeln!(words, "  {}: {}", redundant.constraint, redundant.because);
    }
    for contradiction in &analysis.contradictions {
        let _ = writeln!(words, "{}", contradiction.message);
        for repair in &contradiction.repairs {
            let _ = writeln!(words, "  this would help: {repair}");
        }
    }
    write_advice(&mut words, &analysis.advice);
    let good = analysis.contradictions.is_empty();
    // as plain data it would take several times the room of the document
    Ok(match form {
        Form::Words => Report { text: words, aside: String::new(), good },
        Form::Json => report(form, good, words, &json!(analysis)),
    })
}

/// Names second views, with the members that make them.
fn write_advice(words: &mut String, advice: &[Advice]) {
    for advice in advice {
        let members = advice.members.trim_end().replace('\n', "\n    ");
        let _ = writeln!(words, "{}:\n    {members}", advice.message);
    }
}

/// Whether what constraints say stands on a drawing: dimensions, signs of relations.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Dimensions {
    Shown,
    LeftOut,
}

/// A document as it is drawn.
fn drawn(opened: &Opened, dimensions: Dimensions, format: Format) -> String {
    let (session, id) = (&opened.session, opened.id);
    let said = match dimensions {
        Dimensions::Shown => session.annotations(id),
        Dimensions::LeftOut => Vec::new(),
    };
    let with_said = |picture: &mut PictureView, pixels| {
        annotations::draw(picture, &said, &Moved::default(), pixels);
    };
    match format {
        Format::Svg if said.is_empty() => session.svg(id),
        Format::Dxf if said.is_empty() => session.dxf(id),
        Format::Svg => {
            let mut picture = session.picture(id);
            let pixels = session::roomy(&picture);
            with_said(&mut picture, pixels);
            session::svg_at(&picture, pixels)
        }
        Format::Dxf => {
            let mut picture = session.picture(id);
            annotations::draw_for_dxf(&mut picture, with_said);
            session.dxf_of(id, &picture)
        }
    }
}

/// Returns what a drawing is written as into a file, by the end of its name; SVG where that says nothing.
fn format_of(output: &Path) -> Result<Format, OpenError> {
    let end = output.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match &*end {
        "" | "svg" => Ok(Format::Svg),
        "dxf" => Ok(Format::Dxf),
        _ => Err(OpenError::Refused(format!(
            "{}: a drawing is written as .svg or .dxf, not as .{end}",
            output.display()
        ))),
    }
}

/// Draws a document as SVG, into a file or onto standard output; as DXF into a file of that kind.
///
/// # Errors
/// If the file cannot be read or written, or is of another kind.
pub(crate) fn draw(
    source: &Source,
    output: Option<&Path>,
    dimensions: Dimensions,
    form: Form,
) -> Result<Report, OpenError> {
    let format = output.map_or(Ok(Format::Svg), format_of)?;
    let path = &source.file;
    let opened = source.open()?;
    let written = drawn(&opened, dimensions, format);
    // what nobody asks for is not made: a large drawing takes its time
    let svg = match form {
        Form::Words => String::new(),
        Form::Json if format == Format::Dxf => drawn(&opened, dimensions, Format::Svg),
        Form::Json => written.clone(),
    };
    let undrawn = opened.session.undrawn(opened.id);
    let is_whole = undrawn.is_empty();
    let unpictured = opened.session.unpictured(opened.id);
    let mut wrong = opened.session.text(opened.id).diagnostics;
    wrong.retain(|d| d.severity == "error");
    let is_good = is_whole && wrong.is_empty();
    let json = json!({
        "path": path,
        "svg": svg,
        "undrawn": undrawn,
        "unpictured": unpictured,
        "diagnostics": in_files(path, wrong.clone()),
    });
    // what is wrong is not drawn, or as it was before
    let mut missing: String = wrong.iter().map(|d| show_diagnostic(&opened, d)).collect();
    missing.extend(unpictured.map(|said| format!("{said}\n")));
    let why: String =
        undrawn.iter().map(|why| format!("something is not drawn: {why}\n")).collect();
    let Some(output) = output else {
        // what is printed is to be an SVG or nothing
        let words = if is_whole { written } else { why };
        let aside = if form == Form::Words { missing } else { String::new() };
        return Ok(Report { aside, ..report(form, is_good, words, &json) });
    };
    std::fs::write(output, &written)
        .map_err(|source| OpenError::Unreadable { path: output.to_path_buf(), source })?;
    Ok(report(form, is_good, format!("{}\n{why}{missing}", output.display()), &json))
}

/// Lays documents out as the language wants, keeping comments; `write` false only says which would change.
///
/// # Errors
/// If a file cannot be read or written.
pub(crate) fn fmt(
    arguments: &[PathBuf],
    mode: FormatMode,
    form: Form,
) -> Result<Report, OpenError> {
    let (mut words, mut files, mut good) = (String::new(), Vec::new(), true);
    for path in find(arguments)? {
        let text = documents::read(&path)?;
        if let Some((line, column, message)) = session::misspelled(&text) {
            good = false;
            let _ = writeln!(words, "{}:{line}:{column}: not laid out: {message}", path.display());
            files.push(json!({ "path": path, "changed": false, "error": message }));
            continue;
        }
        let formatted = session::format(&text);
        if is_standard_input(&path) && mode == FormatMode::Write {
            files.push(json!({ "path": path, "text": formatted }));
            words.push_str(&formatted);
            continue;
        }
        let changed = formatted != text;
        if changed {
            match mode {
                FormatMode::Write => documents::replace(&path, &text, &formatted)?,
                FormatMode::Check => good = false,
            }
            let verb = if mode == FormatMode::Write { "formatted" } else { "would change" };
            let _ = writeln!(words, "{verb} {}", path.display());
        }
        files.push(json!({ "path": path, "changed": changed }));
    }
    Ok(report(form, good, words, &json!({ "files": files })))
}

/// Whether `fmt` writes.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum FormatMode {
    /// Writes what changes.
    Write,
    /// Only says so.
    Check,
}

#[cfg(test)]
mod tests {
    use super::around;

    #[test]
    fn of_a_long_line_what_is_around_is_shown() {
        assert_eq!(around("a\nx: Real = y\nb", 12), ("x: Real = y".into(), 10));
        let long = format!("a\n{}\u{1b}y{}\nb", "x".repeat(1000), "z".repeat(1000));
        let (shown, before) = around(&long, 1003);
        assert_eq!((shown.len(), before), (120, 60));
        assert!(shown.starts_with("xxx") && shown.ends_with("zzz"));
        assert_eq!(&shown[58..62], "x yz");
    }
}
