//! The suite: documents that say what must come of them.
//!
//! Every file below `tests/suite`, `gallery` and `library` is opened, and every example of the book. Lines that begin with `//~` say
//! what is expected:
//!
//! - `//~ error[code] LINE:COLUMN` (place optional): a diagnostic; without any, there must be none
//! - `//~ warning[code] LINE:COLUMN` (place optional): the same of a warning; in the gallery, the library and the book
//!   there are none but these, in the suite only in a file that names one
//! - `//~ value PATH = TEXT`: what the values view shows, unit included
//! - `//~ note WORDS`: something that the status says, by its first words
//! - `//~ problem[code] LINE:COLUMN: MESSAGE` (place optional): what was found while solving; a file that names one
//!   names all
//! - `//~ redundant NAME`: a required constraint that says nothing new; a file that names one names all
//! - `//~ unsatisfied NAME`: a required constraint that does not hold; without any, all must hold
//!
//! The `check` blocks of every file must pass, and the independent checker must agree with the status.
//! Laying a text out anew changes neither its values nor its checks; the gallery's and the library's
//! are laid out already.

use session::view::DiagnosticView;
use session::{DocumentId, Host, Session};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

pub(crate) struct Library(pub(crate) PathBuf);

impl Host for Library {
    fn read(&self, name: &str) -> Option<String> {
        fs::read_to_string(self.0.join("library").join(name).with_extension("thing")).ok()
    }
}

pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .expect("tests stand in the project")
        .to_path_buf()
}

pub(crate) fn documents(folder: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("the folder is there") {
            let path = entry.expect("its entries can be read").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "thing") {
                found.push(path);
            }
        }
    }
    found.sort();
    assert!(!found.is_empty(), "there are documents in {folder}");
    found
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).expect("the document can be read")
}

fn opened(path: &Path, text: &str) -> (Session, DocumentId) {
    let mut session = Session::new(Box::new(Library(root())));
    let name = path.file_stem().expect("a document has a name").to_string_lossy().into_owned();
    let id = session.open(&name, text);
    (session, id)
}

/// Opens a document and returns everything that differs from what it says of itself.
fn differences(path: &Path, text: &str) -> String {
    let (mut session, id) = opened(path, text);
    let mut out = String::new();
    let wanted = |word: &str| {
        let prefix = format!("//~ {word}");
        let lines = text.lines().filter_map(|l| l.trim().strip_prefix(&prefix).map(str::to_string));
        lines.collect::<Vec<String>>()
    };
    let wants_no_more = !path.starts_with(root().join("tests/suite"));
    let mut found = session.text(id).diagnostics;
    let mut claimed = wanted("error[");
    claimed.extend(wanted("warning["));
    if !wants_no_more && wanted("warning[").is_empty() {
        found.retain(|d| d.severity != "warning");
    }
    compare_diagnostics(found, claimed, &mut out);
    for claim in wanted("value ") {
        let (path, value) = claim.split_once(" = ").expect("a value claim is PATH = TEXT");
        let rows = session.values(id);
        let row = rows.iter().find(|r| r.path == path);
        let found = row.map(|r| format!("{} {}", r.text, r.unit).trim().to_string());
        if found.as_deref() != Some(value) {
            let _ = writeln!(out, "  {path} is {found:?}, not {value}");
        }
    }
    let least = session.standing(id);
    for claim in wanted("note ") {
        let notes = &least.notes;
        if !notes.iter().any(|n| n.starts_with(&claim)) {
            let _ = writeln!(out, "  nothing is noted like {claim}: {notes:?}");
        }
    }
    compare_problems(&mut session, id, &wanted("problem["), &mut out);
    let broken = wanted("unsatisfied ");
    let status = session.status(id);
    if least.freedom > status.freedom || least.counted && least.freedom != status.freedom {
        let _ =
            writeln!(out, "  \"{}\" at once, \"{}\" when counted", least.message, status.message);
    }
    let redundant = wanted("redundant ");
    if !redundant.is_empty() && redundant != status.redundant {
        let _ = writeln!(out, "  redundant are {:?}, not {redundant:?}", status.redundant);
    }
    for unmet in &status.unmet {
        let named = broken.iter().any(|b| unmet.constraint.ends_with(b.as_str()));
        if !named && unmet.strength == "required" {
            let _ = writeln!(out, "  {} does not hold: {}", unmet.constraint, unmet.rule);
        }
    }
    if !broken.is_empty() && status.satisfied {
        let _ = writeln!(out, "  everything holds");
    }
    let complaints = session.complaints(id);
    if complaints.is_empty() != status.satisfied {
        let _ = writeln!(out, "  {}; the checker: {complaints:?}", status.message);
    }
    for check in session.run_checks(id).iter().filter(|c| !c.passed) {
        let _ = writeln!(out, "  check \"{}\"", check.title);
        for s in &check.shortfalls {
            let _ = writeln!(out, "    line {}: {}: {}", s.line, s.statement, s.message);
        }
    }
    out
}

/// Compares what was found while solving with what a file says of it, if it says something: `CODE] LINE:COLUMN: WORDS`,
/// the words being the first of the message.
fn compare_problems(session: &mut Session, id: DocumentId, wanted: &[String], out: &mut String) {
    if wanted.is_empty() {
        return;
    }
    let found = session.problems(id);
    let said: Vec<String> = found
        .iter()
        .map(|d| format!("{}] {}:{}: {}", d.code, d.line, d.column, d.message))
        .collect();
    let is_alike = |(found, wanted): (&String, &String)| found.starts_with(wanted);
    if said.len() != wanted.len() || !said.iter().zip(wanted).all(is_alike) {
        let _ = writeln!(out, "  found while solving: {said:#?}");
    }
}

fn compare_diagnostics(mut found: Vec<DiagnosticView>, wanted: Vec<String>, out: &mut String) {
    for claim in wanted {
        let (code, place) = claim.split_once(']').expect("a claim is error[code] PLACE");
        let place: Vec<u32> = place.trim().split(':').filter_map(|n| n.parse().ok()).collect();
        let same = |d: &DiagnosticView| {
            d.code == code
                && place.first().is_none_or(|&l| l == d.line)
                && place.get(1).is_none_or(|&c| c == d.column)
        };
        if !found.iter().any(same) {
            let _ = writeln!(out, "  no {code} at {place:?}");
        }
        if place.is_empty() {
            found.retain(|d| !same(d));
        } else if let Some(i) = found.iter().position(same) {
            found.remove(i);
        }
    }
    for d in found {
        let _ =
            writeln!(out, "  {}:{} {}[{}]: {}", d.line, d.column, d.severity, d.code, d.message);
    }
}

/// The folder of the suite that takes as long as all others: it is tested beside them.
const SOLVING: &str = "tests/suite/solving";

fn assert_as_written(documents: &[PathBuf]) {
    let mut failures = String::new();
    for path in documents {
        let difference = differences(path, &read(path));
        if !difference.is_empty() {
            let shown = path.strip_prefix(root()).unwrap_or(path).display();
            let _ = write!(failures, "{shown}\n{difference}");
        }
    }
    assert!(failures.is_empty(), "\n{failures}");
}

#[test]
fn the_suite_of_solving_comes_out_as_it_says() {
    assert_as_written(&documents(SOLVING));
}

#[test]
fn the_suite_comes_out_as_it_says() {
    let mut others = documents("tests/suite");
    others.retain(|path| !path.starts_with(root().join(SOLVING)));
    assert_as_written(&others);
}

/// What a document is told: a line for each diagnostic, with its hint below.
fn told(text: &str) -> String {
    let (session, id) = opened(Path::new("mistake"), text);
    let mut out = String::new();
    let said = session.text(id).diagnostics;
    let is_wrong = said.iter().any(|d| d.severity == "error");
    // warnings count where nothing is wrong
    for d in said.into_iter().filter(|d| !is_wrong || d.severity == "error") {
        let _ = writeln!(out, ">> {} {}:{} {}", d.code, d.line, d.column, d.message);
        if let Some(hint) = d.hint {
            let _ = writeln!(out, "   {hint}");
        }
    }
    out
}

/// Every mistake of the table is told by its code, at its place, in these words; none is told twice or not at all. With
/// `UPDATE_MISTAKES` set, the table is written anew.
#[test]
fn mistakes_of_beginners_are_told_as_a_teacher_would() {
    let path = root().join("tests/suite/diagnostics/mistakes.txt");
    let table = read(&path);
    let mut blocks = table.split("\n== ");
    let mut renewed = blocks.next().expect("the table begins with its explanation").to_string();
    let mut count = 0;
    for block in blocks {
        count += 1;
        let (title, rest) = block.split_once('\n').expect("a title has a document");
        let is_answer = |line: &&str| line.starts_with(">> ");
        let document: Vec<&str> = rest.lines().take_while(|line| !is_answer(line)).collect();
        let document = document.join("\n");
        let answer = told(&document);
        assert!(!answer.is_empty(), "{title}: nobody says a word");
        let _ = write!(renewed, "\n== {title}\n{document}\n{}", answer.trim_end());
    }
    assert!(count >= 60, "the table has {count} mistakes");
    if std::env::var_os("UPDATE_MISTAKES").is_some() {
        fs::write(&path, format!("{renewed}\n")).expect("the table can be written");
    } else {
        let differing = renewed.lines().zip(table.lines()).find(|(now, was)| now != was);
        assert!(renewed.trim_end() == table.trim_end(), "now and in the table: {differing:#?}");
    }
}

/// The tables of the language's own words, as the manual shows them.
fn tables_of_words() -> String {
    use session::vocabulary::{
        functions, messages_of_lists, messages_of_numbers, messages_of_texts,
    };
    use session::vocabulary::{prefixes, quantities, units};
    let mut out = String::from("| function | of | where | |\n|---|---|---|---|\n");
    for f in functions().iter().filter(|f| !f.answers.contains("picture")) {
        let _ = writeln!(out, "| `{}` | {} | {} | {} |", f.call, f.takes, f.domain, f.doc);
    }
    let messages = [
        ("text", messages_of_texts()),
        ("list or set", messages_of_lists()),
        ("number", messages_of_numbers()),
    ];
    for (of, messages) in messages {
        let _ = write!(out, "\n| of a {of} | answers | |\n|---|---|---|\n");
        for m in messages {
            let _ = writeln!(out, "| `.{}` | {} | {} |", m.call, m.answers, m.doc);
        }
    }
    out += "\n| units | of |\n|---|---|\n";
    let mut rows: Vec<(String, Vec<String>)> = Vec::new();
    for unit in units() {
        let star = if unit.is_prefixed { "\\*" } else { "" };
        let word = format!("`{}`{star} {}", unit.spelling, unit.name);
        match rows.iter_mut().find(|(quantity, _)| *quantity == unit.quantity) {
            Some((_, words)) => words.push(word),
            None => rows.push((unit.quantity.clone(), vec![word])),
        }
    }
    for (quantity, words) in rows {
        let _ = writeln!(out, "| {} | {quantity} |", words.join(", "));
    }
    let prefixes = prefixes().map(|(letter, name, _)| format!("`{letter}` {name}"));
    let _ = writeln!(out, "\nUnits with a star take every prefix of SI: {}.", prefixes.join(", "));
    let quantity = |(name, unit): (&str, String)| match unit.is_empty() {
        true => format!("`{name}`"),
        false => format!("`{name}` ({unit})"),
    };
    let quantities: Vec<String> = quantities().into_iter().map(quantity).collect();
    let _ = writeln!(out, "\nThe quantities are {}.", quantities.join(", "));
    out
}

/// The page lists every function, unit and quantity that there is. With `UPDATE_BOOK` set, the lists are written anew.
#[test]
fn the_book_lists_the_words_of_the_language() {
    const FIRST: &str = "<!-- words -->\n";
    const LAST: &str = "<!-- end of words -->";
    let path = root().join("book/language.md");
    let page = read(&path);
    let (before, rest) = page.split_once(FIRST).expect("the page has a place for them");
    let (written, after) = rest.split_once(LAST).expect("the place has an end");
    let words = tables_of_words();
    if std::env::var_os("UPDATE_BOOK").is_some() {
        fs::write(&path, format!("{before}{FIRST}{words}{LAST}{after}"))
            .expect("it can be written");
    } else {
        let differing = words.lines().zip(written.lines()).find(|(now, was)| now != was);
        assert!(words == written, "in the table and in the book: {differing:#?}");
    }
}

#[test]
fn the_gallery_comes_out_as_it_says() {
    assert_as_written(&documents("gallery"));
}

/// The documents between the fences of a page, with the line before each.
fn examples(page: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut lines = page.lines().enumerate();
    while let Some((at, line)) = lines.next() {
        if line.trim() == "```thing" {
            let text = lines.by_ref().map(|(_, line)| line).take_while(|line| *line != "```");
            found.push((at + 1, text.collect::<Vec<_>>().join("\n")));
        }
    }
    found
}

#[test]
fn the_examples_of_the_book_come_out_as_they_say() {
    let page = root().join("book/language.md");
    let examples = examples(&read(&page));
    assert!(examples.len() > 5, "the page has its examples");
    for (line, text) in examples {
        let difference = differences(&page, &text);
        assert!(difference.is_empty(), "the example after line {line}:\n{difference}");
    }
}

#[test]
fn the_library_has_no_faults() {
    assert_as_written(&documents("library"));
}

/// What a document comes to: its values, bit for bit, and how its checks end.
fn outcome(path: &Path, text: &str) -> Vec<String> {
    let (session, id) = opened(path, text);
    let values = session.values(id).into_iter();
    let values = values.map(|v| format!("{} {} {:?}", v.path, v.text, v.number.map(f64::to_bits)));
    let checks = session.run_checks(id).into_iter();
    values.chain(checks.map(|c| format!("{} {}", c.title, c.passed))).collect()
}

/// One in three of the documents that are not laid out comes out again, the first of a folder with them; all of them
/// with `THINGLAB_LONG`.
#[test]
fn laying_a_text_out_changes_neither_values_nor_checks() {
    let one_in = if std::env::var_os("THINGLAB_LONG").is_some() { 1 } else { 3 };
    for folder in ["gallery", "library", "tests/suite"] {
        let mut changed = 0;
        for path in documents(folder) {
            let text = read(&path);
            let formatted = session::format(&text);
            assert_eq!(session::format(&formatted), formatted, "{}: twice", path.display());
            if formatted != text {
                if changed % one_in == 0 {
                    assert_eq!(
                        outcome(&path, &formatted),
                        outcome(&path, &text),
                        "{}",
                        path.display()
                    );
                }
                changed += 1;
            }
        }
    }
}

#[test]
fn the_gallery_and_the_library_are_laid_out() {
    for path in ["gallery", "library"].into_iter().flat_map(documents) {
        let text = read(&path);
        assert_eq!(session::format(&text), text, "{}", path.display());
    }
}
