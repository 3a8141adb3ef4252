//! `cargo verify`: everything that can be checked, counted in one last line.
//!
//! Format, lints, documentation and the page's bundle count as one each, every test as one; a step
//! that breaks off (a test that does not compile) counts as one failure. The linter compiles what it
//! reads, and the documentation is read beside what it made: every room is compiled once for this machine.
//! Usually `web` is compiled for the browser alone, and there linted and documented, which counts as one each; with
//! `--no-browser`, `--long` or Debian's compiler it is linted with the other rooms.

use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::sync::OnceLock;
use std::sync::mpsc::{self, Receiver, Sender};
use std::time::Instant;

use crate::bundle::{self, Effort};
use crate::compiled;
use crate::documentation;
use crate::say;
use crate::tools::{self, Missing, Tool, WasmCompiler};

/// What the command line asks for.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Wish {
    missing: Missing,
    browser: Browser,
    length: Length,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Browser {
    Test,
    LeaveOut,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Length {
    Usual,
    Long,
}

/// How many checks passed and failed.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
struct Count {
    passed: usize,
    failed: usize,
}

impl Count {
    fn one(passed: bool) -> Count {
        Count { passed: usize::from(passed), failed: usize::from(!passed) }
    }

    fn add(&mut self, other: Count) {
        self.passed += other.passed;
        self.failed += other.failed;
    }
}

/// Reads the command line.
///
/// # Errors
/// A sentence about the first argument that is not one.
pub(crate) fn parse(arguments: &[String]) -> Result<Wish, String> {
    let mut wish = Wish { missing: Missing::Name, browser: Browser::Test, length: Length::Usual };
    for argument in arguments {
        match argument.as_str() {
            "--install" => wish.missing = Missing::Install,
            "--no-browser" => wish.browser = Browser::LeaveOut,
            "--long" => wish.length = Length::Long,
            other => return Err(format!("unknown argument {other}")),
        }
    }
    Ok(wish)
}

/// Runs everything, whatever fails on the way, and ends with the line that counts it.
pub(crate) fn run(wish: &Wish) -> ExitCode {
    let mut needed = vec![Tool::Rustfmt, Tool::Clippy];
    if wish.browser == Browser::Test {
        needed.extend([Tool::WasmCompiler, Tool::Browser]);
    }
    let lacking = tools::require(&needed, wish.missing);
    if lacking > 0 {
        say!("{}", last_line(Count { passed: 0, failed: lacking }, wish.browser));
        return ExitCode::from(2);
    }
    let page = page(wish);
    let count = match wish.browser {
        Browser::LeaveOut => native(wish, page, None),
        // rooms are compiled one after the other: two such chains keep two cores busy
        Browser::Test => std::thread::scope(|scope| {
            let (compiled, programs) = mpsc::channel();
            let browser = scope.spawn(move || in_the_browser(wish.length, page, &programs));
            let mut count = native(wish, page, Some(compiled));
            count.add(browser.join().unwrap_or(Count { passed: 0, failed: 1 }));
            count
        }),
    };
    say!("{}", last_line(count, wish.browser));
    if count.failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Where the room `web` is linted and documented. It has no tests, and what it stands on is compiled for nothing else.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Page {
    /// Where it is compiled for the browser tests.
    AsItIsBuilt,
    /// With the other rooms: it is not built for tests, or by a compiler without a linter.
    WithTheRooms,
}

fn page(wish: &Wish) -> Page {
    let is_built = wish.browser == Browser::Test && wish.length == Length::Usual;
    match tools::wasm_compiler() {
        Some(WasmCompiler::Toolchain) if is_built => Page::AsItIsBuilt,
        Some(WasmCompiler::Toolchain | WasmCompiler::Debian { .. }) | None => Page::WithTheRooms,
    }
}

/// The packages that every command here compiles.
fn selection(browser: Browser, page: Page) -> &'static [&'static str] {
    match (browser, page) {
        (Browser::Test, Page::AsItIsBuilt) => &bundle::NATIVE,
        (Browser::Test, Page::WithTheRooms) => &["--workspace", "--exclude", "bindgen"],
        (Browser::LeaveOut, _) => &["--workspace", "--exclude", "bindgen", "--exclude", "browser"],
    }
}

fn last_line(count: Count, browser: Browser) -> String {
    let Count { passed, failed } = count;
    match browser {
        Browser::Test => format!("{passed} passed, {failed} failed"),
        Browser::LeaveOut => format!(
            "{passed} passed, {failed} failed, 2 skipped (--no-browser: the page's bundle, the browser tests)"
        ),
    }
}

/// What the browser tests want besides the page.
struct Programs {
    thinglab: PathBuf,
    tests: PathBuf,
}

/// All but what is done in the browser, for which two programs are compiled first.
fn native(wish: &Wish, page: Page, compiled: Option<Sender<Programs>>) -> Count {
    let selection = selection(wish.browser, page);
    let mut count = step("format", &mut tools::cargo(&["fmt", "--all", "--check"]));
    let thinglab = bundle::build_command(Effort::Tests, selection);
    count.add(Count::one(thinglab.is_ok()));
    if let (Some(compiled), Ok(thinglab)) = (compiled, &thinglab) {
        let made = compiled::make(tools::cargo, &["--test", "lab"], selection);
        match made.executable("test", "lab") {
            // who waits for it has ended only where it broke off, which is counted there
            Some(tests) => drop(compiled.send(Programs { thinglab: thinglab.clone(), tests })),
            None => say!("the browser tests did not compile"),
        }
    }
    heading("compiling the tests, and lints");
    // the tests of the page are waited for longest: they and what they want go first
    let made = compiled::make(tools::cargo_behind, &[], selection);
    count.add(Count::one(made.is_whole));
    count.add(Count::one(made.is_clean));
    heading("documentation");
    count.add(Count::one(documentation::write(&made)));
    match thinglab {
        // no part of the project needs it: without it the audit is left out, which is said
        Ok(thinglab) => match tools::require(&[Tool::Ezdxf], wish.missing) {
            0 => count.add(audit(&thinglab)),
            _ => say!("left out: the audit of DXF files"),
        },
        Err(why) => say!("{why}; the audit of DXF files cannot run"),
    }
    let mut tests = tools::cargo_behind(&["test", "--quiet", "--no-fail-fast"]);
    lengthen(tools::lint(tests.args(selection)), wish.length);
    count.add(tested(tests.args(["--", "--skip", "in_the_browser::"]), "tests", Show::AtOnce));
    count
}

/// Builds the page, and tests it once the programs for that are there; what else is compiled and tested goes on
/// meanwhile.
fn in_the_browser(length: Length, page: Page, programs: &Receiver<Programs>) -> Count {
    let effort = match length {
        Length::Usual => Effort::Tests,
        Length::Long => Effort::Full,
    };
    let built = bundle::build(&tools::wasm_compiler().expect("required above"), effort);
    let mut count = Count::one(built.is_ok());
    if built.is_ok() {
        heading("the page is built");
    }
    match &built {
        Ok(Some(made)) if page == Page::AsItIsBuilt => {
            count.add(Count::one(made.is_clean));
            count.add(Count::one(documentation::write_for_the_browser("web", made)));
        }
        Ok(_) => {}
        Err(why) => say!("{why}"),
    }
    match (built, programs.recv()) {
        (Ok(_), Ok(Programs { thinglab, tests })) => {
            let mut tests = Command::new(tests);
            // one more than there are cores: pages wait, too
            let cores = std::thread::available_parallelism().map_or(1, usize::from);
            tests.arg("--quiet").args(["--test-threads", &(cores + 1).to_string()]);
            tests.env("THINGLAB", thinglab);
            if let Some(chromium) = tools::browser() {
                tests.env("CHROMIUM", chromium);
            }
            lengthen(&mut tests, length);
            count.add(tested(&mut tests, "browser tests", Show::AtTheEnd));
        }
        (Err(_), _) | (_, Err(_)) => {
            say!("the browser tests cannot run");
            count.failed += 1;
        }
    }
    count
}

fn lengthen(tests: &mut Command, length: Length) {
    if length == Length::Long {
        tests.env("THINGLAB_LONG", "1");
    }
}

/// Writes the gallery as DXF, and has every file audited by another program.
fn audit(thinglab: &Path) -> Count {
    let (gallery, to) = (crate::top().join("gallery"), crate::top().join("target/dxf"));
    let entries = std::fs::create_dir_all(&to).and_then(|()| std::fs::read_dir(gallery));
    let mut documents: Vec<_> =
        entries.into_iter().flatten().map_while(Result::ok).map(|e| e.path()).collect();
    documents.retain(|path| path.extension().is_some_and(|e| e == "thing"));
    documents.sort();
    let (mut count, mut written) = (Count::default(), Vec::new());
    for document in documents {
        let file = to.join(document.file_stem().unwrap_or_default()).with_extension("dxf");
        let mut draw = Command::new(thinglab);
        draw.arg("draw").arg(&document).arg("--output").arg(&file);
        count.add(step(&format!("drawing {}", document.display()), &mut draw));
        written.push(file);
    }
    let mut audit = Command::new(tools::ezdxf());
    audit.arg(crate::top().join("xtask/dxf_audit.py")).args(written);
    count.add(step("audit of DXF files", &mut audit));
    count
}

/// Says what begins or has ended, and how long after the first of these.
fn heading(name: &str) {
    static BEGAN: OnceLock<Instant> = OnceLock::new();
    let seconds = BEGAN.get_or_init(Instant::now).elapsed().as_secs();
    say!("== {}:{:02} {name}", seconds / 60, seconds % 60);
}

fn step(name: &str, command: &mut Command) -> Count {
    heading(name);
    let passed = command.stdin(Stdio::null()).status().is_ok_and(|status| status.success());
    if !passed {
        say!("{name} failed");
    }
    Count::one(passed)
}

/// When the lines of a command are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Show {
    AtOnce,
    /// For what runs beside something that is shown at once.
    AtTheEnd,
}

/// Runs tests, showing what they print under a heading.
fn tested(command: &mut Command, name: &str, show: Show) -> Count {
    if show == Show::AtOnce {
        heading(name);
    }
    let child = command.stdin(Stdio::null()).stdout(Stdio::piped()).spawn();
    let Ok(mut child) = child else { return Count::one(false) };
    let (mut count, mut kept) = (Count::default(), Vec::new());
    let printed = child.stdout.take().expect("piped");
    for line in BufReader::new(printed).split(b'\n').map_while(Result::ok) {
        let line = String::from_utf8_lossy(&line).into_owned();
        count.add(counted(&line).unwrap_or_default());
        match show {
            Show::AtOnce => say!("{line}"),
            Show::AtTheEnd => kept.push(line),
        }
    }
    let ended_well = child.wait().is_ok_and(|status| status.success());
    if show == Show::AtTheEnd {
        // at once, since another thread prints beside it
        heading(&format!("{name}\n{}", kept.join("\n")));
    }
    if !ended_well && count.failed == 0 {
        say!("{name}: they broke off");
        count.failed = 1;
    }
    count
}

/// What a test program's last line counts: `test result: ok. 3 passed; 0 failed; …`.
fn counted(line: &str) -> Option<Count> {
    let (_, figures) = line.strip_prefix("test result: ")?.split_once(". ")?;
    let figure = |what: &str| {
        let words = figures.split(';').find_map(|part| part.trim().strip_suffix(what))?;
        words.trim().parse().ok()
    };
    Some(Count { passed: figure("passed")?, failed: figure("failed")? })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_test_programs_last_line_is_counted() {
        let line =
            "test result: FAILED. 12 passed; 3 failed; 0 ignored; 0 measured; 1 filtered out";
        assert_eq!(counted(line), Some(Count { passed: 12, failed: 3 }));
        assert_eq!(counted("test result"), None);
        assert_eq!(counted("test some::test ... ok"), None);
    }

    #[test]
    fn the_last_line_says_what_was_not_run() {
        let count = Count { passed: 7, failed: 1 };
        assert_eq!(last_line(count, Browser::Test), "7 passed, 1 failed");
        assert_eq!(
            last_line(count, Browser::LeaveOut),
            "7 passed, 1 failed, 2 skipped (--no-browser: the page's bundle, the browser tests)"
        );
    }

    #[test]
    fn a_wrong_argument_is_named() {
        assert_eq!(parse(&[String::from("--fast")]).unwrap_err(), "unknown argument --fast");
    }
}
