//! `thinglab family`: every row of a table drawn by a program, in parallel.
//!
//! Rows are drawn by several threads, each with the document open for itself; what is written depends on the
//! rows alone. `manifest.jsonl` says of each row what came of it; a row whose line there has the hash of the
//! same program, values and formats, and whose files stand, is not drawn again. While rows are drawn their lines go to
//! `manifest.jsonl.part`, so that what was drawn before an end by force is not drawn again either. `index.html` shows
//! all of them.

use crate::commands::{Form, Report};
use crate::documents::{OpenError, open};
use clap::ValueEnum;
use serde_json::{Value, json};
use session::view::{FamilyRow, RowFormats, RowOutcome};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::io::{IsTerminal as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;

/// How many rows a thread takes at once.
const CHUNK: usize = 64;
/// What is said of every row.
const MANIFEST: &str = "manifest.jsonl";
/// The same while rows are drawn.
const PART: &str = "manifest.jsonl.part";

/// What a drawing is written as.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum Format {
    /// SVG at scale.
    Svg,
    /// DXF in millimetres: arcs stay arcs.
    Dxf,
}

/// What is asked for.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The document.
    file: PathBuf,
    /// The program, or a family of it; without it the only family of the document.
    program: Option<String>,
    /// The table: CSV with a header of parameters, `inner [mm]`; of a family, its own without it.
    #[arg(long)]
    table: Option<PathBuf>,
    /// A second table: where it has other values is told.
    #[arg(long)]
    compare: Option<PathBuf>,
    /// The folder to write to; without it every row is run and the table looked at, and nothing is written.
    #[arg(long)]
    out: Option<PathBuf>,
    /// What to write each drawing as.
    #[arg(long, value_enum, value_delimiter = ',', default_value = "svg")]
    format: Vec<Format>,
    /// How many threads draw; as many as the machine has without it.
    #[arg(long)]
    jobs: Option<usize>,
}

/// A row that is done.
struct Done {
    at: usize,
    line: Value,
    outcome: String,
}

/// Returns the name of what draws: the one that is asked for, else the only family there is.
fn which<'n>(asked: Option<&'n str>, families: &[&'n str]) -> Result<&'n str, OpenError> {
    match (asked, families) {
        (Some(asked), _) => Ok(asked),
        (None, [only]) => Ok(only),
        (None, []) => Err(OpenError::Refused(
            "the document has no family: name the program, and its table by `--table`".into(),
        )),
        (None, several) => Err(OpenError::Refused(format!(
            "the document has several families: name one of {}",
            several.join(", ")
        ))),
    }
}

/// Draws every row.
///
/// # Errors
/// If a file cannot be read or written, or there is no such program or table.
pub(crate) fn run(arguments: &Arguments, form: Form) -> Result<Report, OpenError> {
    let opened = open(&arguments.file)?;
    let refused = |refusal: session::view::Refusal| OpenError::Refused(refusal.message);
    let families = opened.session.families(opened.id);
    let programs: Vec<&str> = families.iter().map(|f| f.name.as_str()).collect();
    let program = which(arguments.program.as_deref(), &programs)?;
    let family = families.iter().find(|f| f.name == program);
    let beside = arguments.file.parent().unwrap_or(Path::new("."));
    let named = family.and_then(|f| f.table.as_ref()).map(|table| beside.join(table));
    let table = match arguments.table.clone().or(named) {
        Some(path) => Some(read(&path)?),
        None => None,
    };
    let rows = opened.session.family_rows(opened.id, program, table.as_deref());
    let mut rows = rows.map_err(refused)?;
    if let Some(path) = &arguments.compare {
        let second = read(path)?;
        let told = opened.session.family_differences(opened.id, program, &rows, &second);
        rows.notes.extend(told.map_err(refused)?);
    }
    if let Some(out) = &arguments.out {
        fs::create_dir_all(out).map_err(|source| unreadable(out, source))?;
    }
    let has = |format| arguments.out.is_some() && arguments.format.contains(&format);
    let formats = RowFormats { svg: has(Format::Svg), dxf: has(Format::Dxf) };
    let source = format!("{}\n{}\n{:?}\n", opened.meaning(), program, arguments.format);
    let source = mixed(FNV, &source);
    let hashes: Vec<String> = rows
        .rows
        .iter()
        .map(|row| format!("{:016x}", mixed(source, &format!("{row:?}"))))
        .collect();
    let before = arguments.out.as_deref().map(manifest).unwrap_or_default();
    let files = session::file_names(&rows.rows);
    let is_done = |at: usize| {
        let line = before.get(&hashes[at])?;
        let (out, written) = (arguments.out.as_ref()?, line["files"].as_array()?);
        let stands = |file: &Value| file.as_str().is_some_and(|file| out.join(file).is_file());
        (line["row"] == json!(at) && written.iter().all(stands)).then(|| line.clone())
    };
    let todo: Vec<usize> = (0..rows.rows.len()).filter(|&at| is_done(at).is_none()).collect();
    let mut lines: BTreeMap<usize, Value> =
        (0..rows.rows.len()).filter_map(|at| Some((at, is_done(at)?))).collect();
    let skipped = lines.len();
    let work =
        Work { arguments, program, rows: &rows.rows, hashes: &hashes, files: &files, formats };
    let failure = work.draw(&todo, &mut lines);
    // what was drawn before something failed is kept
    let manifest: String = lines.values().map(|line| format!("{line}\n")).collect();
    if let Some(out) = &arguments.out {
        write(&out.join(MANIFEST), &manifest)?;
        let _ = fs::remove_file(out.join(PART));
    }
    if let Some(failure) = failure {
        return Err(failure);
    }
    if let Some(out) = &arguments.out {
        let index = index_page(program, &lines, &rows.notes);
        write(&out.join("index.html"), &index)?;
    }
    Ok(report((arguments, program), &lines, (&rows.notes, skipped), form))
}

/// Rows to be drawn, and how.
#[derive(Clone, Copy)]
struct Work<'w> {
    arguments: &'w Arguments,
    /// The program, or a family of it.
    program: &'w str,
    rows: &'w [FamilyRow],
    /// Of each row the hash of what it depends on.
    hashes: &'w [String],
    /// Of each row the name of its files.
    files: &'w [String],
    formats: RowFormats,
}

impl Work<'_> {
    /// Draws rows by several threads; says why it could not go on, where that is so.
    fn draw(&self, todo: &[usize], lines: &mut BTreeMap<usize, Value>) -> Option<OpenError> {
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let jobs = self
            .arguments
            .jobs
            .unwrap_or(cores)
            .clamp(1, 64)
            .min(todo.len().div_ceil(CHUNK).max(1));
        let next = AtomicUsize::new(0);
        let mut failure = None;
        std::thread::scope(|scope| {
            let (send, receive) = mpsc::channel::<Result<Done, OpenError>>();
            for _ in 0..jobs {
                let send = send.clone();
                let next = &next;
                scope.spawn(move || {
                    let work = || -> Result<(), OpenError> {
                        let opened = open(&self.arguments.file)?;
                        loop {
                            let from = next.fetch_add(CHUNK, Ordering::Relaxed);
                            if from >= todo.len() {
                                return Ok(());
                            }
                            for &at in &todo[from..(from + CHUNK).min(todo.len())] {
                                let row = &self.rows[at];
                                let (session, program) = (&opened.session, self.program);
                                let outcome =
                                    session.draw_row(opened.id, program, row, self.formats);
                                let outcome = outcome.map_err(|r| OpenError::Refused(r.message))?;
                                let done = self.finish(at, outcome)?;
                                // nobody listens where another thread failed
                                if send.send(Ok(done)).is_err() {
                                    return Ok(());
                                }
                            }
                        }
                    };
                    if let Err(error) = work() {
                        let _ = send.send(Err(error));
                    }
                });
            }
            drop(send);
            let mut progress = Progress::of(todo.len());
            let mut so_far = self.arguments.out.as_deref().and_then(|out| part(out, lines));
            for done in receive {
                match done {
                    Ok(done) => {
                        progress.step(&done.outcome);
                        // what cannot be noted is drawn again next time
                        let noted = so_far.as_mut().map(|file| writeln!(file, "{}", done.line));
                        if matches!(noted, Some(Err(_))) {
                            so_far = None;
                        }
                        lines.insert(done.at, done.line);
                    }
                    Err(error) => {
                        failure = Some(error);
                        break;
                    }
                }
            }
            progress.end();
        });
        failure
    }

    /// Writes a row's files, and says what came of it.
    fn finish(&self, at: usize, outcome: RowOutcome) -> Result<Done, OpenError> {
        let (row, file) = (&self.rows[at], &self.files[at]);
        let mut files = Vec::new();
        for format in &self.arguments.format {
            let (extension, bytes) = match format {
                Format::Svg => ("svg", &outcome.svg),
                Format::Dxf => ("dxf", &outcome.dxf),
            };
            if let (Some(out), false) = (&self.arguments.out, bytes.is_empty()) {
                let name = format!("{file}.{extension}");
                write(&out.join(&name), bytes)?;
                files.push(name);
            }
        }
        let measures: serde_json::Map<String, Value> =
            outcome.measures.iter().map(|(path, x)| (path.to_string(), json!(x))).collect();
        let line = json!({
            "row": at,
            "name": row.name,
            "line": row.line,
            "hash": self.hashes[at],
            "outcome": outcome.outcome,
            "step": outcome.step,
            "message": outcome.message,
            "files": files,
            "measures": measures,
        });
        Ok(Done { at, line, outcome: outcome.outcome })
    }
}

/// Says what came of the rows.
fn report(
    (arguments, program): (&Arguments, &str),
    lines: &BTreeMap<usize, Value>,
    (notes, skipped): (&[String], usize),
    form: Form,
) -> Report {
    let count = |outcome: &str| lines.values().filter(|l| l["outcome"] == outcome).count();
    let drawn = count("drawn");
    let mut words = String::new();
    for line in lines.values().filter(|l| l["outcome"] != "drawn" || l["message"] != "") {
        let text = |key: &str| line[key].as_str().unwrap_or_default().to_string();
        let _ = writeln!(words, "{}: {}: {}", text("name"), text("outcome"), text("message"));
    }
    for note in notes {
        let _ = writeln!(words, "note: {note}");
    }
    let _ = writeln!(
        words,
        "{} rows: {drawn} {}, {} outside, {} failed, {} too long{}",
        lines.len(),
        if arguments.out.is_some() { "drawn" } else { "could be drawn" },
        count("outside"),
        count("failed"),
        count("too-long"),
        match &arguments.out {
            Some(out) => {
                let index = out.join("index.html");
                format!("; {skipped} were there already; {}", index.display())
            }
            None => String::new(),
        }
    );
    let json = json!({
        "program": program,
        "rows": lines.values().collect::<Vec<_>>(),
        "notes": notes,
        "skipped": skipped,
    });
    let text = match form {
        Form::Words => words,
        Form::Json => format!("{json}\n"),
    };
    Report { text, aside: String::new(), good: drawn == lines.len() }
}

/// Reads what an earlier run said of its rows, by their hashes.
fn manifest(out: &Path) -> BTreeMap<String, Value> {
    let read = |name| fs::read_to_string(out.join(name)).unwrap_or_default();
    let text = read(MANIFEST) + &read(PART);
    let lines = text.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
    lines.filter_map(|line| Some((line["hash"].as_str()?.to_string(), line))).collect()
}

/// Begins to note what is done, with what was done before.
fn part(out: &Path, lines: &BTreeMap<usize, Value>) -> Option<fs::File> {
    let mut file = fs::File::create(out.join(PART)).ok()?;
    lines.values().try_for_each(|line| writeln!(file, "{line}")).ok()?;
    Some(file)
}

/// What a text is mixed into first. **Source:** FNV-1a, 64 bits.
const FNV: u64 = 0xcbf2_9ce4_8422_2325;

/// Mixes a text into what the texts before came to.
fn mixed(before: u64, text: &str) -> u64 {
    let mix = |h: u64, byte: u8| (h ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    text.bytes().fold(before, mix)
}

fn index_page(program: &str, lines: &BTreeMap<usize, Value>, notes: &[String]) -> String {
    let mut page = format!(
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>{0}</title>\n\
         <style>body{{font:15px system-ui,sans-serif;margin:2rem}}\
         .sheet{{display:grid;grid-template-columns:repeat(auto-fill,minmax(14rem,1fr));gap:1rem}}\
         figure{{margin:0;border:1px solid #ccc;padding:.5rem}}\
         img{{width:100%;height:11rem;object-fit:contain}}\
         figcaption b{{color:#b3401a}}</style>\n<h1>{0}</h1>\n",
        escaped(program)
    );
    for note in notes {
        let _ = writeln!(page, "<p>{}</p>", escaped(note));
    }
    page.push_str("<div class=\"sheet\">\n");
    for line in lines.values() {
        let text = |key: &str| escaped(line[key].as_str().unwrap_or_default());
        let name = text("name");
        let picture = line["files"].as_array().into_iter().flatten().filter_map(Value::as_str);
        let picture = picture.filter(|file| file.ends_with(".svg"));
        let picture =
            picture.map(|f| format!("<img src=\"{}\" alt=\"{name}\">", escaped(f))).next();
        let said = match line["outcome"].as_str() {
            Some("drawn") => String::new(),
            _ => format!(" <b>{}</b> {}", text("outcome"), text("message")),
        };
        let picture = picture.unwrap_or_default();
        let _ = writeln!(page, "<figure>{picture}<figcaption>{name}{said}</figcaption></figure>");
    }
    page.push_str("</div></html>\n");
    page
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

fn read(path: &Path) -> Result<String, OpenError> {
    fs::read_to_string(path).map_err(|source| unreadable(path, source))
}

fn unreadable(path: &Path, source: std::io::Error) -> OpenError {
    OpenError::Unreadable { path: path.to_path_buf(), source }
}

/// Writes a file beside its place, then puts it there: it is whole or as it was.
fn write(path: &Path, text: &str) -> Result<(), OpenError> {
    let mut aside = path.as_os_str().to_owned();
    aside.push(".part");
    let aside = PathBuf::from(aside);
    fs::write(&aside, text).map_err(|source| unreadable(&aside, source))?;
    fs::rename(&aside, path).map_err(|source| unreadable(path, source))
}

/// How far it is, on a terminal.
struct Progress {
    all: usize,
    done: usize,
    odd: usize,
    is_shown: bool,
}

impl Progress {
    /// How many characters the bar has.
    const WIDTH: usize = 30;

    fn of(all: usize) -> Self {
        Self { all, done: 0, odd: 0, is_shown: std::io::stderr().is_terminal() }
    }
    fn step(&mut self, outcome: &str) {
        self.done += 1;
        self.odd += usize::from(outcome != "drawn");
        if self.is_shown && (self.done.is_multiple_of(CHUNK) || self.done == self.all) {
            let full = Self::WIDTH * self.done / self.all.max(1);
            let bar = "#".repeat(full) + &"-".repeat(Self::WIDTH - full);
            let (done, all, odd) = (self.done, self.all, self.odd);
            let _ = write!(std::io::stderr(), "\r[{bar}] {done}/{all}, {odd} not drawn");
        }
    }
    fn end(&self) {
        if self.is_shown && self.done > 0 {
            let _ = writeln!(std::io::stderr());
        }
    }
}
