//! `thinglab family`: tables, what is odd about them, what is written, and what is not drawn again.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const DISC: &str = "use geometry
unit mm
program Disc(r: Length in 1 mm..50 mm = 4 mm, hole: Length = 1 mm) {
    constraint wall: hole < r
    rim = Circle(center: Point(0, 0), radius: r)
    bore = Circle(center: Point(0, 0), radius: hole)
}
family Discs of Disc { table \"discs.csv\" }
";

/// A fresh folder with a document and its table.
fn folder(name: &str, table: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("thinglab-family-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("there is a folder for such files");
    fs::write(folder.join("disc.thing"), DISC).expect("it can be written");
    fs::write(folder.join("discs.csv"), table).expect("it can be written");
    folder
}

/// Draws into `out` below the folder; returns whether all was drawn, and what was said.
fn drawn(folder: &Path, name: &str, about: &[&str]) -> (bool, String) {
    let mut thinglab = Command::new(env!("CARGO_BIN_EXE_thinglab"));
    thinglab.current_dir(folder).args(["family", "disc.thing", name]).args(about);
    let said = thinglab.output().expect("the command starts");
    let words = [said.stdout, said.stderr].concat();
    (said.status.success(), String::from_utf8(words).expect("words are printed"))
}

const TABLE: &str = "# discs, r in millimetres
disc,r [mm],hole [cm]
small,2,0.1
middle,4,
large,8,0.2
";

#[test]
fn a_table_is_read_with_its_units_and_its_empty_cells() {
    let folder = folder("units", TABLE);
    let (good, words) = drawn(&folder, "Discs", &["--out", "out", "--format", "dxf,svg"]);
    assert!(good && words.contains("3 rows: 3 drawn, 0 outside"), "{words}");
    let read = |name: &str| fs::read_to_string(folder.join("out").join(name)).expect("it is there");
    let circle = |r: &str| format!("AcDbCircle\n10\n0.0\n20\n0.0\n30\n0.0\n40\n{r}\n");
    assert!(read("middle.dxf").contains(&circle("4.0")));
    assert!(read("middle.dxf").contains(&circle("1.0")), "an empty cell is the program's own");
    assert!(read("large.dxf").contains(&circle("2.0")), "0.2 cm");
    assert!(read("index.html").contains("small.svg"));
}

#[test]
fn rows_that_fail_say_why_and_the_others_go_on() {
    let table = format!("{TABLE}thin,5,0.6\nwrong,wide,0.1\nhuge,60,0.1\n");
    let folder = folder("rows", &table);
    let (good, words) = drawn(&folder, "Discs", &["--out", "out"]);
    assert!(!good, "{words}");
    assert!(words.contains("6 rows: 3 drawn, 2 outside, 1 failed, 0 too long"), "{words}");
    assert!(words.contains("thin: outside: wall is not met"), "{words}");
    assert!(words.contains("wrong: failed: r: "), "{words}");
    // before anything is drawn, too
    let mut thinglab = Command::new(env!("CARGO_BIN_EXE_thinglab"));
    let said = thinglab.current_dir(&folder).args(["check", "disc.thing"]).output();
    let words = String::from_utf8(said.expect("the command starts").stdout).expect("words");
    assert!(words.contains("1 file, 0 errors, 3 warnings"), "{words}");
    assert!(words.contains("the row thin is outside: wall is not met"), "{words}");
    assert!(words.contains("  --> discs.csv:6:1"), "{words}");
    assert!(words.contains("r has to be from 1 mm to 50 mm; r is 60 mm"), "{words}");
    fs::remove_file(folder.join("discs.csv")).expect("it is there");
    let mut thinglab = Command::new(env!("CARGO_BIN_EXE_thinglab"));
    let said = thinglab.current_dir(&folder).args(["check", "disc.thing"]).output();
    let said = said.expect("the command starts");
    let words = String::from_utf8(said.stdout).expect("words");
    assert!(!said.status.success() && words.contains("there is no table discs.csv"), "{words}");
}

#[test]
fn what_a_step_is_given_is_told_with_its_units_and_a_rule_as_it_is_written() {
    let folder = folder("gap", "disc,r [mm]\n");
    let text = "use geometry
unit mm
program Gap(r: Length = 4 mm, far: Length = 30 mm) {
    constraint r < far
    left = Circle(center: Point(0, 0), radius: r)
    right = Circle(center: Point(far, 0), radius: r)
    ring = Circle.tangent(left, right, radius: r / 2)
}
family Gaps of Gap { rows: (4 mm, 30 mm) (6 mm, 5 mm) }
";
    fs::write(folder.join("disc.thing"), text).expect("it can be written");
    let (_, words) = drawn(&folder, "Gaps", &[]);
    assert!(words.contains("right is Circle(Point(30 mm, 0 mm), 4 mm), radius is 2 mm"), "{words}");
    assert!(words.contains("2: outside: r < far is not met; r is 6 mm, far is 5 mm"), "{words}");
}

#[test]
fn what_is_odd_about_a_table_is_noted() {
    let table = "disc,r [mm]\na,2\nb,3\nc,4\nd,5\ne,6\nf,5.5\ng,8\na,9\nh,9\n";
    let (_, words) = drawn(&folder("odd", table), "Discs", &["--out", "out"]);
    assert!(words.contains("note: a stands in the table more than once"), "{words}");
    assert!(words.contains("note: a and h have the same values"), "{words}");
    assert!(
        words.contains("note: r [mm] grows, but is 6 at e and 5.5 at f")
            || words.contains("note: r grows, but is 6 at e and 5.5 at f"),
        "{words}"
    );
}

#[test]
fn the_same_bytes_for_any_number_of_threads_and_nothing_twice() {
    let rows: String = (1..200).map(|i| format!("d{i},{}\n", 2.0 + f64::from(i) / 10.0)).collect();
    let folder = folder("threads", &format!("disc,r [mm]\n{rows}"));
    for (out, jobs) in [("one", "1"), ("three", "3")] {
        let (good, words) = drawn(&folder, "Discs", &["--out", out, "--jobs", jobs]);
        assert!(good && words.contains("199 drawn"), "{words}");
    }
    for name in ["manifest.jsonl", "d7.svg", "d199.svg", "index.html"] {
        let read = |out: &str| fs::read(folder.join(out).join(name)).expect("it is there");
        assert!(read("one") == read("three"), "{name} differs");
    }
    let (_, words) = drawn(&folder, "Discs", &["--out", "one"]);
    assert!(words.contains("199 were there already"), "{words}");
    // a row with other values is another drawing, and so is one whose file is gone
    fs::write(
        folder.join("discs.csv"),
        format!("disc,r [mm]\n{}", rows.replace("d5,2.5", "d5,2.55")),
    )
    .expect("it can be written");
    fs::remove_file(folder.join("one/d9.svg")).expect("it is there");
    let (_, words) = drawn(&folder, "Discs", &["--out", "one"]);
    assert!(words.contains("197 were there already"), "{words}");
}

#[test]
fn a_name_that_is_wrong_is_answered_with_those_that_there_are() {
    let folder = folder("names", TABLE);
    let (good, words) = drawn(&folder, "Washers", &["--out", "out"]);
    assert!(!good);
    assert!(words.contains("of families there is Discs of Disc, of programs Disc"), "{words}");
    let (_, words) = drawn(&folder, "Disc", &["--out", "out"]);
    assert!(words.contains("Disc is a program: its family is Discs"), "{words}");
    fs::remove_file(folder.join("discs.csv")).expect("it is there");
    assert!(!drawn(&folder, "Discs", &["--out", "out"]).0);
}

#[test]
fn the_only_family_need_not_be_named() {
    let folder = folder("unnamed", TABLE);
    let mut thinglab = Command::new(env!("CARGO_BIN_EXE_thinglab"));
    let said = thinglab.current_dir(&folder).args(["family", "disc.thing"]).output();
    let said = String::from_utf8(said.expect("the command starts").stdout).expect("words");
    assert!(said.contains("3 rows: 3 could be drawn"), "{said}");
}

#[test]
fn a_wrong_row_of_the_document_fails_and_is_counted() {
    let folder = folder("wrong-rows", TABLE);
    let rows = "table \"discs.csv\"";
    let text = DISC.replace(rows, "rows: (2 mm, 1 mm) (3 mm, 1 mm, 7) (\"M4\", 4 mm, \"wide\")");
    fs::write(folder.join("disc.thing"), text).expect("it can be written");
    let (good, words) = drawn(&folder, "Discs", &[]);
    assert!(!good && words.contains("3 rows: 1 could be drawn, 0 outside, 2 failed"), "{words}");
    assert!(words.contains("2: failed: Disc has 2 parameters, here are 3 values"), "{words}");
    assert!(words.contains("M4: failed: "), "{words}");
}

#[test]
fn a_second_table_is_compared() {
    let folder = folder("compare", TABLE);
    let other = "disc,r [cm],hole [mm]\nsmall,0.2,1\nmiddle,0.5,\nhuge,4,2\n";
    fs::write(folder.join("other.csv"), other).expect("it can be written");
    let (good, words) = drawn(&folder, "Discs", &["--compare", "other.csv"]);
    assert!(good && words.contains("3 rows: 3 could be drawn, 0 outside"), "{words}");
    for note in [
        "note: middle: r is 4, in the second table 5",
        "note: large is not in the second table",
        "note: huge is in the second table alone",
    ] {
        assert!(words.contains(note), "{note}: {words}");
    }
    assert!(!words.contains("small"), "0.2 cm are 2 mm: {words}");
    assert!(!folder.join("out").exists());
    // rows without names in common are told apart by the first column
    fs::write(folder.join("other.csv"), "r [mm],hole [mm]\n8,2.5\n").expect("it can be written");
    let (_, words) = drawn(&folder, "Discs", &["--compare", "other.csv"]);
    assert!(words.contains("large: hole is 2, in the second table 2.5"), "{words}");
}

#[test]
fn what_was_drawn_before_an_end_by_force_is_not_drawn_again() {
    let folder = folder("force", TABLE);
    assert!(drawn(&folder, "Discs", &["--out", "out"]).0);
    let out = folder.join("out");
    // as it stands where nothing came after the second row
    let manifest = fs::read_to_string(out.join("manifest.jsonl")).expect("it is there");
    let lines: Vec<&str> = manifest.lines().collect();
    fs::write(out.join("manifest.jsonl.part"), lines[..2].join("\n")).expect("it can be written");
    fs::remove_file(out.join("manifest.jsonl")).expect("it is there");
    let (_, words) = drawn(&folder, "Discs", &["--out", "out"]);
    assert!(words.contains("3 rows: 3 drawn") && words.contains("2 were there already"), "{words}");
    assert_eq!(fs::read_to_string(out.join("manifest.jsonl")).expect("it is there"), manifest);
    assert!(!out.join("manifest.jsonl.part").exists());
}

#[test]
fn every_row_of_every_family_of_the_gallery_is_drawn() {
    let gallery = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gallery");
    for (file, family, rows) in [
        ("washer", "Plain", 15),
        ("nut", "Regular", 19),
        ("bolt", "Hexagon", 38),
        ("bolt", "Threaded", 19),
        ("bearing", "Series62", 11),
        ("screw", "SocketHead", 20),
        ("plate", "Square", 3),
        ("rings", "StandardRings", 4),
        ("koch", "Refinements", 5),
        ("retaining-ring", "Din471", 76),
    ] {
        let file = format!("{file}.thing");
        let mut thinglab = Command::new(env!("CARGO_BIN_EXE_thinglab"));
        let said = thinglab.current_dir(&gallery).args(["family", &file, family]).output();
        let said = said.expect("the command starts");
        let words = String::from_utf8(said.stdout).expect("words are printed");
        let all = format!("{rows} rows: {rows} could be drawn, 0 outside, 0 failed, 0 too long\n");
        assert_eq!(words, all, "{file}: {family}");
    }
}

#[test]
fn rules_speak_of_columns_that_the_program_does_not_ask_for() {
    let table = "disc,r [mm],hole [mm],across [cm]\nright,4,1,0.8\nwrong,5,1,0.9\n";
    let folder = folder("columns", table);
    let family = "family Discs of Disc {\n    across: Length\n    table \"discs.csv\"\n    constraint across = 2 * r\n}\n";
    let text = DISC.replace("family Discs of Disc { table \"discs.csv\" }\n", family);
    fs::write(folder.join("disc.thing"), text).expect("it can be written");
    let (good, words) = drawn(&folder, "Discs", &["--out", "out"]);
    assert!(!good && words.contains("2 rows: 1 drawn, 1 outside"), "{words}");
    let said = "across = 2 * r is not met; across is 9 mm, r is 5 mm";
    assert!(words.contains(said), "{words}");
}
