//! The rules that the whole tree keeps, as tests: ARCHITECTURE.md tells the truth about floors and
//! paths, the book about limits, no file is called after nothing, no line ends in a space.
//!
//! Each rule is a function from text to complaints, so that a planted fault can be shown to be seen.

mod limits;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::top;

/// Rows of the table `| floor | `crates/room` | … |`: each room's floor.
fn floors(architecture: &str) -> BTreeMap<String, u32> {
    let row = |line: &str| {
        let mut cells = line.strip_prefix('|')?.split('|').map(str::trim);
        let floor = cells.next()?.parse().ok()?;
        let room = cells.next()?.trim_matches('`').strip_prefix("crates/")?;
        Some((String::from(room), floor))
    };
    architecture.lines().filter_map(row).collect()
}

/// What a manifest depends on, but for its tests.
fn dependencies(manifest: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut inside = false;
    for line in manifest.lines().map(str::trim) {
        if let Some(section) = line.strip_prefix('[') {
            let section = section.trim_end_matches(']');
            let list = section.trim_start_matches("build-");
            inside = list == "dependencies";
            found.extend(list.strip_prefix("dependencies.").map(String::from));
        } else if inside && !line.is_empty() && !line.starts_with('#') {
            let name = line.split(['.', ' ', '=']).next().unwrap_or_default();
            found.push(String::from(name));
        }
    }
    found
}

/// Complaints about one room's manifest.
fn check_floor(room: &str, manifest: &str, floors: &BTreeMap<String, u32>) -> Vec<String> {
    let Some(own) = floors.get(room) else {
        return vec![format!("crates/{room} has no row in ARCHITECTURE.md")];
    };
    let above = |other: &String| floors.get(other).is_some_and(|floor| floor >= own);
    dependencies(manifest)
        .into_iter()
        .filter(above)
        .map(|other| format!("{room} on floor {own} uses {other} on floor {}", floors[&other]))
        .collect()
}

/// Paths in backticks: what has a slash and is no command, address or pattern.
fn paths_named(text: &str) -> Vec<&str> {
    let quoted = text.split('`').skip(1).step_by(2);
    let is_path = |word: &&str| {
        word.contains('/')
            && !word.contains([' ', '*', ':', '<', '='])
            && !word.starts_with(['-', '/'])
    };
    quoted.filter(is_path).collect()
}

/// Complaints about paths that do not exist, but for lines that say `planned`.
fn check_paths(text: &str, exists: impl Fn(&str) -> bool) -> Vec<String> {
    let lines = text.lines().filter(|line| !line.to_lowercase().contains("planned"));
    let named = lines.flat_map(paths_named);
    named
        .filter(|path| !exists(path))
        .map(|path| format!("{path} is named but not there"))
        .collect()
}

/// A complaint about a file's name that says nothing.
fn check_name(path: &str) -> Option<String> {
    let empty = ["common", "helper", "helpers", "misc", "util", "utils"];
    let stem = path.rsplit('/').next()?.split('.').next()?;
    empty.contains(&stem).then(|| format!("{path}: a name that says nothing"))
}

/// Complaints about lines that end in a space or a tab.
fn check_spaces(path: &str, text: &str) -> Vec<String> {
    let ends_badly = |line: &str| line.ends_with([' ', '\t']);
    let lines = text.lines().enumerate().filter(|(_, line)| ends_badly(line));
    lines.map(|(index, _)| format!("{path}:{}: a space at the end", index + 1)).collect()
}

/// The tree's own text files, by their paths from the top.
fn files() -> Vec<(String, PathBuf)> {
    let mut found = Vec::new();
    let mut open = vec![top()];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).expect("the tree can be read") {
            let path = entry.expect("the tree can be read").path();
            let name = path.file_name().expect("listed by name").to_string_lossy().into_owned();
            let made = [".git", "target", "target-web", "dist", "node_modules"].contains(&&*name);
            // A link's target is not the tree's own.
            if made || path.is_symlink() {
                continue;
            }
            if path.is_dir() {
                open.push(path);
            } else if is_ours(&name) {
                let short = path.strip_prefix(top()).expect("found below the top");
                found.push((short.to_string_lossy().into_owned(), path));
            }
        }
    }
    found.sort();
    found
}

/// Text that people write here; the vendored editor is neither.
fn is_ours(name: &str) -> bool {
    let endings = ["rs", "md", "toml", "thing", "html", "css", "js", "json"];
    let ending = Path::new(name).extension().and_then(|ending| ending.to_str());
    ending.is_some_and(|ending| endings.contains(&ending))
        && !["codemirror.js", "axe.min.js"].contains(&name)
}

fn architecture() -> String {
    fs::read_to_string(top().join("ARCHITECTURE.md")).expect("the tree has an ARCHITECTURE.md")
}

fn assert_none(complaints: &[String]) {
    assert!(complaints.is_empty(), "\n{}", complaints.join("\n"));
}

#[test]
fn rooms_use_lower_floors_only() {
    let floors = floors(&architecture());
    assert!(floors.len() >= 10, "the table of rooms was not understood: {floors:?}");
    let mut complaints = Vec::new();
    for entry in fs::read_dir(top().join("crates")).expect("the tree has crates") {
        let entry = entry.expect("the tree can be read");
        let room = entry.file_name().to_string_lossy().into_owned();
        let manifest = fs::read_to_string(entry.path().join("Cargo.toml")).unwrap_or_default();
        complaints.extend(check_floor(&room, &manifest, &floors));
    }
    assert_none(&complaints);
}

#[test]
fn paths_in_the_architecture_and_the_book_exist() {
    let book = fs::read_to_string(top().join("book/solver.md")).expect("the book is there");
    for text in [architecture(), book] {
        assert_none(&check_paths(&text, |path| top().join(path).exists()));
    }
}

#[test]
fn names_and_lines_are_tidy() {
    let files = files();
    assert!(files.len() > 50, "only {} files found", files.len());
    let mut complaints: Vec<String> =
        files.iter().filter_map(|(path, _)| check_name(path)).collect();
    // A case's every byte may be its point.
    for (path, place) in
        files.iter().filter(|(path, _)| !path.contains("tests/") || !path.ends_with(".thing"))
    {
        complaints.extend(check_spaces(path, &fs::read_to_string(place).expect("text")));
    }
    assert_none(&complaints);
}

/// Whether a text has a test: an attribute whose name ends so.
fn has_tests(text: &str) -> bool {
    let is_test = |line: &str| {
        let name =
            line.trim_start().strip_prefix("#[").and_then(|rest| rest.split(['(', ']']).next());
        name.is_some_and(|name| name.ends_with("test"))
    };
    text.lines().any(is_test)
}

/// Whether a manifest says that no tests are compiled with the library.
fn leaves_tests_out(manifest: &str) -> bool {
    let sections = manifest.split("\n[").filter_map(|section| section.split_once(']'));
    sections
        .filter(|(name, _)| name.trim_start_matches('[') == "lib")
        .flat_map(|(_, section)| section.lines())
        .any(|line| line.split_whitespace().collect::<String>() == "test=false")
}

/// The files that a test program compiles beside its own: their paths from the room's folder.
fn compiled_beside(text: &str) -> impl Iterator<Item = &str> {
    let paths = text.lines().filter_map(|line| line.trim_start().strip_prefix("#[path = \""));
    paths.filter_map(|path| path.split('"').next()).map(|path| path.trim_start_matches("../"))
}

/// Complaints about the tests beside a room's sources that nothing runs. Its files come by their paths from its folder.
fn check_place_of_tests(room: &str, manifest: &str, files: &[(&str, &str)]) -> Vec<String> {
    let place = match room {
        // it is compiled for the browser alone
        "web" => "their place is crates/presentation",
        _ if leaves_tests_out(manifest) => "no `#[path]` in the room's tests names them",
        _ => return Vec::new(),
    };
    let (tests, sources): (Vec<_>, Vec<_>) =
        files.iter().partition(|(path, _)| path.starts_with("tests/"));
    let run: Vec<&str> = tests.into_iter().flat_map(|(_, text)| compiled_beside(text)).collect();
    let is_lost = |(path, text): &(&str, &str)| has_tests(text) && !run.contains(path);
    let lost = sources.into_iter().filter(is_lost);
    lost.map(|(path, _)| format!("crates/{room}/{path}: tests that nothing runs; {place}"))
        .collect()
}

#[test]
fn tests_are_where_they_are_run() {
    let mut rooms: BTreeMap<String, Vec<(String, String)>> = BTreeMap::new();
    for (path, place) in files() {
        let in_room = path.strip_prefix("crates/").and_then(|path| path.split_once('/'));
        if let Some((room, path)) = in_room {
            let text = fs::read_to_string(place).expect("text");
            rooms.entry(room.into()).or_default().push((path.into(), text));
        }
    }
    assert!(rooms.len() >= 10, "only {} rooms found", rooms.len());
    let mut complaints = Vec::new();
    for (room, files) in &rooms {
        let texts: BTreeMap<&str, &str> = files.iter().map(|(p, t)| (&**p, &**t)).collect();
        let manifest = texts.get("Cargo.toml").copied().unwrap_or_default();
        let sources: Vec<_> = texts.into_iter().filter(|(path, _)| path.ends_with(".rs")).collect();
        complaints.extend(check_place_of_tests(room, manifest, &sources));
    }
    assert_none(&complaints);
}

#[test]
fn planted_faults_are_seen() {
    let table = "| floor | room |\n| 3 | `crates/plan` | x |\n| 2 | `crates/solve` | y |";
    let floors = floors(table);
    assert_eq!(
        check_floor("solve", "[dependencies]\nplan.workspace = true\n", &floors),
        ["solve on floor 2 uses plan on floor 3"]
    );
    assert_eq!(check_floor("solve", "[dependencies.solve]\n", &floors).len(), 1);
    assert!(
        check_floor("solve", "[dev-dependencies]\nplan.workspace = true\n", &floors).is_empty()
    );
    assert_eq!(check_floor("jit", "", &floors), ["crates/jit has no row in ARCHITECTURE.md"]);
    assert_eq!(
        check_paths("see `a/b.rs`, `x = 1/2`", |_| false),
        ["a/b.rs is named but not there"]
    );
    assert!(check_paths("planned: `a/b.rs`", |_| false).is_empty());
    assert!(check_name("crates/base/src/utils.rs").is_some());
    assert_eq!(check_spaces("a.md", "x \ny"), ["a.md:1: a space at the end"]);
}

#[test]
fn planted_tests_that_nothing_runs_are_seen() {
    let (sources, tests) = ("src/a/b.rs", "tests/suite/main.rs");
    let left_out = "[package]\nname = \"eval\"\n\n[lib]\ntest = false\n";
    let check = |room, manifest, source, tests_say| {
        check_place_of_tests(room, manifest, &[(sources, source), (tests, tests_say)])
    };
    for test in
        ["#[test]\nfn a() {}", "    #[tokio::test(start_paused = true)]", "#[wasm_bindgen_test]"]
    {
        let lost = check("eval", left_out, test, "mod a;");
        assert_eq!(lost.len(), 1, "{test}");
        assert!(lost[0].starts_with("crates/eval/src/a/b.rs: tests that nothing runs"));
        assert!(check("eval", left_out, test, "#[path = \"../../src/a/b.rs\"]\nmod b;").is_empty());
        assert!(
            check("eval", "[lib]\ndoctest = false\n[[bin]]\ntest = false", test, "").is_empty()
        );
        assert_eq!(check("web", "", test, "").len(), 1);
    }
    assert!(check("eval", left_out, "#[cfg(test)]\nmod tests;", "").is_empty());
    assert!(check("web", "", "let it = [path, row.shortest];", "").is_empty());
}
