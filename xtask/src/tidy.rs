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

/// A complaint about tests in the room that is compiled for the browser alone: nothing would run them.
fn check_place_of_tests(path: &str, text: &str) -> Option<String> {
    let is_lost = path.starts_with("crates/web/src/") && text.contains("#[test]");
    is_lost.then(|| format!("{path}: tests that nothing runs; their place is crates/presentation"))
}

#[test]
fn tests_are_where_they_are_run() {
    let read = |place: &PathBuf| fs::read_to_string(place).expect("text");
    let all = files().into_iter();
    let complaints: Vec<String> =
        all.filter_map(|(path, place)| check_place_of_tests(&path, &read(&place))).collect();
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
    assert!(check_place_of_tests("crates/web/src/lab.rs", "#[test]\nfn a() {}").is_some());
    assert!(check_place_of_tests("crates/presentation/src/rows.rs", "#[test]").is_none());
}
