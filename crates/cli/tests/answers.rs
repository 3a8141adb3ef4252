//! What the command answers to the shell: nothing was in order where it says why not.

use std::io::Write as _;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

/// Runs the command on a document of that text.
fn asked(name: &str, text: &str, command: &str, about: &[&str]) -> Output {
    let path: PathBuf = std::env::temp_dir().join(format!("thinglab-{name}.thing"));
    std::fs::write(&path, text).expect("there is a folder for such files");
    let mut thinglab = Command::new(env!("CARGO_BIN_EXE_thinglab"));
    thinglab.arg(command).arg(&path).args(about).output().expect("the command starts")
}

#[test]
fn what_is_not_there_cannot_be_explained() {
    let explain = |name: &str, about: &str| asked(name, "a: Real = 3\n", "explain", &[about]);
    let there = explain("explain-there", "a");
    assert!(there.status.success() && there.stdout.starts_with(b"a is 3"), "{there:?}");
    assert!(!explain("explain-missing", "b.c").status.success());
}

#[test]
fn what_is_said_names_the_file_as_it_was_asked_for() {
    let text = "x: Real = 1 m\n";
    for command in ["check", "test", "run"] {
        let told = asked(&format!("file-of-{command}"), text, command, &["--json"]);
        let told: serde_json::Value = serde_json::from_slice(&told.stdout).expect("it is JSON");
        let of_file = if told["files"].is_array() { &told["files"][0] } else { &told };
        let path = &of_file["path"];
        assert!(path.as_str().is_some_and(|path| !path.is_empty()), "{told}");
        assert_eq!(&of_file["diagnostics"][0]["file"], path, "{command}");
    }
}

#[test]
fn a_table_may_have_dots_and_spaces_in_its_name_and_lies_beside_its_document() {
    let folder = std::env::temp_dir().join("thinglab-tables");
    std::fs::create_dir_all(folder.join("inner")).expect("there is a folder for such files");
    for table in ["inner/iso.4014.csv", "inner/M8 bolts.csv", "outside.csv"] {
        std::fs::write(folder.join(table), "d [mm]\n8\n").expect("it is written");
    }
    std::fs::create_dir_all(folder.join("inner/none.csv")).expect("it is made");
    for (table, wanted) in [
        ("iso.4014.csv", ""),
        ("M8 bolts.csv", ""),
        ("../outside.csv", "`../outside.csv` is no name of a table"),
        ("none.csv", "there is no table none.csv beside this one"),
    ] {
        let text = format!("program Bolt(d: Length in \"{table}\".d = 8 mm) {{ }}\n");
        let said = printed("tables/inner/desk", &text, "check", &["--json"]);
        let told: serde_json::Value = serde_json::from_str(&said).expect("it is JSON");
        let message = &told["files"][0]["diagnostics"][0]["message"];
        assert_eq!(message.as_str().unwrap_or_default(), wanted, "{table}: {told}");
    }
}

#[test]
fn a_picture_without_end_is_no_empty_drawing() {
    let endless =
        "class Leaf { size: Real = 3  picture => Leaf(size: size + 1).picture }\nl: Leaf\n";
    let drawn = asked("draw-endless", endless, "draw", &[]);
    assert!(!drawn.status.success());
    assert!(drawn.stdout.starts_with(b"something is not drawn: messages call each other"));
    let nothing = "class Leaf { size: Real = 3  picture => picture() }\nl: Leaf\n";
    assert!(asked("draw-nothing", nothing, "draw", &[]).stdout.starts_with(b"<svg"));
}

#[test]
fn what_is_set_is_quoted_or_not_and_degrees_have_their_unit() {
    let text = "name: Text = \"Al\"\nturn: Angle = 30 deg\n";
    let set = |setting: &str| asked("set-typed", text, "run", &["--set", setting]);
    for name in ["name=Bob", "name=\"Bob\""] {
        let told = set(name);
        assert!(String::from_utf8_lossy(&told.stdout).contains("name = Bob\n"), "{told:?}");
    }
    let told = set("turn=45");
    assert!(!told.status.success());
    let why = String::from_utf8_lossy(&told.stderr);
    assert!(why.contains("turn is an angle: say `45 deg`"), "{why}");
    assert!(String::from_utf8_lossy(&set("turn=45 deg").stdout).contains("45 deg"));
}

#[test]
fn what_is_wrong_with_a_text_is_told_aside_of_its_drawing() {
    let text = "use geometry\np: Point = Point(1, 2)\nq: Pont\n";
    let drawn = asked("draw-wrong", text, "draw", &[]);
    assert_eq!(drawn.status.code(), Some(1));
    assert!(drawn.stdout.starts_with(b"<svg"));
    let told = String::from_utf8_lossy(&drawn.stderr);
    assert!(told.contains("draw-wrong.thing:3:4\n") && told.contains("no class Pont"), "{told}");
}

/// Returns what a command printed.
fn printed(name: &str, text: &str, command: &str, about: &[&str]) -> String {
    String::from_utf8(asked(name, text, command, about).stdout).expect("words are printed")
}

const DIVIDER: &str = "use circuits
battery: Battery { emf = 10 V  anchor emf }
r1: Resistor { resistance = 1 kohm }
r2: Resistor { resistance = 500 ohm }
ground: Ground
merge battery.a.node = r1.a.node
merge r1.b.node = r2.a.node
merge r2.b.node = battery.b.node = ground.lead.node
";

#[test]
fn values_are_read_in_units_of_engineers_without_what_pictures_compute() {
    let words = printed("run-divider", DIVIDER, "run", &[]);
    let row = |path: &str| words.lines().find(|line| line.split(' ').next() == Some(path));
    let value = |path: &str| {
        let row = row(path).map(|row| row.split_once(' ').map_or("", |(_, rest)| rest.trim()));
        row.unwrap_or_else(|| panic!("no {path} in\n{words}")).to_string()
    };
    assert_eq!(value("r1.current"), "6.66667 mA");
    assert_eq!(value("r1.drop"), "6.66667 V");
    assert_eq!(value("r1.resistance"), "=   1 kohm");
    assert_eq!(value("r2.resistance"), "= 500 ohm");
    assert_eq!(value("battery.emf"), "!  10 V");
    for helper in ["r1.span", "r1.half", "r1.reach", "battery.a.node.at.x"] {
        assert_eq!(row(helper), None);
    }
    assert!(words.ends_with("all constraints hold; nothing is free\n"), "{words}");
    let all = printed("run-all", DIVIDER, "run", &["--all"]);
    assert!(all.contains("r1.span ") && all.contains("battery.a.node.at.x "), "{all}");
    let exact = printed("run-json", DIVIDER, "run", &["--json"]);
    assert!(exact.contains("0.006666666666666667"), "{exact}");
}

#[test]
fn numbers_in_json_are_in_si() {
    let number = |name: &str, text: &str, path: &str| {
        let told = printed(name, text, "run", &["--json"]);
        let told: serde_json::Value = serde_json::from_str(&told).expect("it is JSON");
        let rows = told["values"].as_array().expect("it has values").clone();
        let row = rows.into_iter().find(|row| row["path"] == path).expect("it is there");
        row["number"].as_f64().expect("it is a number")
    };
    let is = |x: f64, wanted: f64| (x - wanted).abs() < 1e-12 * wanted;
    // a text of wavelengths counts in units of its own
    let slit = "lambda: Length = 632.8 nm\nd: Length = 0.25 mm\ns: Length = lambda * 2 m / d\n";
    assert!(is(number("si-slit", slit, "lambda"), 632.8e-9));
    assert!(is(number("si-slit", slit, "s"), 632.8e-9 * 2.0 / 0.25e-3));
    let sheet = "unit mm\nl: Length = 5\np: Pressure = 2 bar\n";
    assert!(is(number("si-sheet", sheet, "l"), 5.0));
    assert!(is(number("si-sheet", sheet, "p"), 2e5));
}

#[test]
fn what_nothing_decides_is_marked() {
    let text = "a: Real = 2\nb, c, phi: Real\nturn: Angle\nconstraint b + c = a\nconstraint turn = 30 deg\n";
    let words = printed("run-arbitrary", text, "run", &[]);
    let wanted = "a    =  2\nb    ~  1\nc    ~  1\nphi  ~  0\nturn   30 deg\n~ arbitrary: nothing decides it\n";
    assert!(words.starts_with(wanted), "{words}");
}

#[test]
fn a_contradiction_is_told_at_the_line_of_each_of_its_constraints() {
    let text = "a, b: Length\nconstraint first: a = 3 m\nconstraint second: b = a\nconstraint third: b = 4 m\n";
    let checked = asked("check-contradiction", text, "check", &[]);
    let words = String::from_utf8_lossy(&checked.stdout).into_owned();
    assert!(!checked.status.success());
    assert!(
        words.starts_with("error[contradiction]: first, second, third contradict each other"),
        "{words}"
    );
    for line in [":2:1: first: a = 3 m", ":3:1: second: b = a", ":4:1: third: b = 4 m"] {
        assert!(words.contains(line), "{line} in\n{words}");
    }
    assert!(words.contains("hint: delete first or switch it off; then a is 4"), "{words}");
}

#[test]
fn each_check_is_named_where_that_is_asked_for() {
    let text = "a: Real = 1\ncheck \"one\" { expect a = 1 }\n";
    assert_eq!(printed("test-quiet", text, "test", &[]), "1 passed, 0 failed\n");
    let words = printed("test-verbose", text, "test", &["--verbose"]);
    assert!(words.contains(":2: check \"one\" passed\n1 passed, 0 failed"), "{words}");
}

#[test]
fn what_cannot_be_laid_out_is_said_and_stays() {
    let text = "a:Real = 1\nb: Real = (\n";
    let laid = asked("fmt-broken", text, "fmt", &[]);
    let words = String::from_utf8_lossy(&laid.stdout).into_owned();
    assert!(!laid.status.success() && words.contains(": not laid out: "), "{words}");
    let path = std::env::temp_dir().join("thinglab-fmt-broken.thing");
    assert_eq!(std::fs::read_to_string(path).expect("it is there"), text);
}

#[test]
fn a_drawing_fits_whatever_the_units_and_says_what_it_lacks() {
    let metres = "use geometry\nunit km\nl: Line { p1 = (0, 0)  p2 = (3, 0.4) }\nclass Plain { x: Real }\np: Plain\n";
    let drawn = asked("draw-small", metres, "draw", &[]);
    assert!(String::from_utf8_lossy(&drawn.stdout).contains("width=\"432\""), "{drawn:?}");
    assert_eq!(String::from_utf8_lossy(&drawn.stderr), "p has no picture\n");
}

#[test]
fn what_constraints_say_is_drawn_where_it_is_asked_for() {
    let text = "use geometry\nunit mm\nl: Line { p1 = (0, 0)  p2 = (45, 0) }\n\
                constraint l.length = 45 mm\n";
    let words = |svg: &str| svg.lines().filter(|line| line.contains("45 mm")).count();
    assert_eq!(words(&printed("draw-without", text, "draw", &[])), 0);
    assert_eq!(words(&printed("draw-dimensions", text, "draw", &["--dimensions"])), 1);
    let dxf = std::env::temp_dir().join("thinglab-draw-dimensions.dxf");
    let to = ["--dimensions", "-o", dxf.to_str().expect("a plain path")];
    assert!(asked("draw-dimensions-dxf", text, "draw", &to).status.success());
    let written = std::fs::read_to_string(dxf).expect("it is written");
    assert!(written.contains("DIMENSIONS") && written.contains("45 mm"), "{written}");
}

#[test]
fn a_drawing_is_written_as_what_its_file_is_called() {
    let pdf = std::env::temp_dir().join("thinglab-draw.pdf");
    let to = ["-o", pdf.to_str().expect("a plain path")];
    let refused = asked("draw-pdf", "use geometry\np: Point\n", "draw", &to);
    let told = String::from_utf8_lossy(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{told}");
    assert!(told.contains("a drawing is written as .svg or .dxf, not as .pdf"), "{told}");
    assert!(!pdf.exists());
}

#[test]
fn what_has_no_place_is_drawn_apart() {
    let svg = printed("draw-unplaced", DIVIDER, "draw", &[]);
    // what the words of the three things stand at
    let labels: Vec<(f64, f64)> = { svg.lines().filter(|line| line.starts_with("<text")) }
        .map(|line| {
            let number = |key: &str| {
                let (_, rest) = line.split_once(&format!("{key}=\"")).expect("a place");
                rest.split('"').next().and_then(|x| x.parse().ok()).expect("a number")
            };
            (number("x"), number("y"))
        })
        .collect();
    assert_eq!(labels.len(), 3, "{svg}");
    for (i, (x, y)) in labels.iter().enumerate() {
        // in pixels 64, more than a value with its unit is wide
        let apart = |(a, b): &(f64, f64)| base::number::hypot(a - x, b - y) > 25.0;
        assert!(labels[..i].iter().all(apart), "{svg}");
    }
    assert!(!svg.contains("NaN"));
}

#[test]
fn alike_things_of_a_list_are_a_table() {
    let text = "class Post { x: Length  name: Text }\nposts: List of 3 Post = [(2 mm, \"a\"), (13 mm, \"b\"), (1.5 mm, \"c\")]\n\
                two: List of 2 Post = [(2 mm, \"a\"), (13 mm, \"b\")]\nnumbers: List of 3 Real = [1, 2, 3]\n";
    let printed = printed("run-table", text, "run", &[]);
    let wanted = "posts     x          name\nposts[0]  =  2 mm    = a\nposts[1]  = 13 mm    = b\n\
                  posts[2]  =  1.5 mm  = c\ntwo[0].x    =  2 mm\n";
    assert!(printed.starts_with(wanted), "{printed}");
    assert!(printed.contains("numbers[0]  =  1\n"), "{printed}");
}

#[test]
fn the_book_shows_what_is_printed() {
    let top = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let page = std::fs::read_to_string(format!("{top}/book/reading.md")).expect("it is there");
    let mut blocks = 0;
    for block in page.split("```console\n").skip(1) {
        let block = block.split("```").next().expect("a block ends");
        let mut lines = block.lines();
        let asked = lines.next().and_then(|l| l.strip_prefix("$ thinglab ")).expect("a command");
        let mut thinglab = Command::new(env!("CARGO_BIN_EXE_thinglab"));
        let said = thinglab.args(asked.split(' ')).current_dir(top).output().expect("it starts");
        let said = String::from_utf8(said.stdout).expect("words are printed");
        let mut printed = said.lines();
        for line in lines.filter(|line| *line != "…") {
            assert!(printed.any(|p| p == line), "{asked}: {line:?} is not in\n{said}");
        }
        blocks += 1;
    }
    assert!(blocks >= 4, "{blocks}");
}

#[test]
fn a_sweep_is_printed_as_a_table_and_drawn_as_a_chart() {
    let range = ["r2.drop", "r1.current", "--sweep", "r2.resistance", "--from", "1 kohm"];
    let range: Vec<&str> = range.into_iter().chain(["--to", "4kohm", "--steps", "3"]).collect();
    let table = printed("plot-divider", DIVIDER, "plot", &range);
    let mut rows = table.lines();
    assert_eq!(rows.next(), Some("r2.resistance [ohm],r2.drop [V],r1.current [mA]"));
    for (row, r) in rows.zip(1..) {
        let cells: Vec<f64> = row.split(',').map(|cell| cell.parse().expect("a number")).collect();
        let r = f64::from(r);
        let wanted = [1000.0 * r, 10.0 * r / (1.0 + r), 10.0 / (1.0 + r)];
        assert!(
            cells.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-6),
            "{row}, not {wanted:?}"
        );
    }
    assert_eq!(table.lines().count(), 5);
    let chart = std::env::temp_dir().join("thinglab-plot-divider.svg");
    let written: Vec<&str> =
        range.into_iter().chain(["-o", chart.to_str().expect("a path")]).collect();
    assert!(asked("plot-divider", DIVIDER, "plot", &written).status.success());
    let drawn = std::fs::read_to_string(&chart).expect("it was written");
    assert_eq!(drawn.matches("<polyline").count(), 2);
    let wrong = asked(
        "plot-divider",
        DIVIDER,
        "plot",
        &["r9.drop", "--sweep", "r2.resistance", "--from", "0", "--to", "1"],
    );
    assert!(
        !wrong.status.success() && String::from_utf8_lossy(&wrong.stderr).contains("r9"),
        "{wrong:?}"
    );
}

#[test]
fn a_name_of_more_letters_than_a_line_has_is_printed() {
    let name = "x".repeat(70_000);
    let words = printed("long-name", &format!("{name}: Real = 3\ny: Real = 4\n"), "run", &[]);
    assert!(words.starts_with(&format!("{name} = 3\n")), "{}", words.len());
    assert!(words.lines().nth(1).is_some_and(|line| line.trim_end().ends_with("= 4")));
}

#[test]
fn a_document_may_come_in_by_standard_input() {
    let mut thinglab = Command::new(env!("CARGO_BIN_EXE_thinglab"));
    let thinglab = thinglab.args(["run", "-"]).stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut running = thinglab.spawn().expect("the command starts");
    let mut to = running.stdin.take().expect("it is piped");
    to.write_all(b"use geometry\nx: Real = 3\n").expect("it is read");
    drop(to);
    let said = running.wait_with_output().expect("it ends").stdout;
    assert!(said.starts_with(b"x = 3\n"), "{}", String::from_utf8_lossy(&said));
}

#[test]
fn a_file_that_is_not_there_is_an_answer_in_json_too() {
    let mut thinglab = Command::new(env!("CARGO_BIN_EXE_thinglab"));
    let said = thinglab.args(["run", "--json", "no-such.thing"]).output().expect("it starts");
    let told: serde_json::Value = serde_json::from_slice(&said.stdout).expect("it is JSON");
    assert!(told["error"].as_str().is_some_and(|e| e.starts_with("no-such.thing: ")), "{told}");
    assert_eq!(said.status.code(), Some(2));
}

#[test]
fn a_value_may_be_set_for_one_run_and_the_file_stays() {
    let text = "use electrical\nv: Voltage = 9 V\nr: Resistance = 300 ohm\n\
                i: Current = v / r\na: Real = 3\nb: Real = a + 1\n";
    let run = |about: &[&str]| asked("set-for-one-run", text, "run", about);
    let told = run(&["--set", "v = 12 V", "--set", "r=2 kohm", "--json"]);
    let told: serde_json::Value = serde_json::from_slice(&told.stdout).expect("it is JSON");
    let values = told["values"].as_array().expect("a list of them");
    let of = |path: &str| values.iter().find(|row| row["path"] == path).map(|row| &row["number"]);
    assert_eq!(of("i").and_then(serde_json::Value::as_f64), Some(0.006), "{told}");
    let kept = std::fs::read_to_string(std::env::temp_dir().join("thinglab-set-for-one-run.thing"));
    assert_eq!(kept.expect("it is there"), text);
    for (setting, wanted) in
        [("v", "write PATH=VALUE"), ("w=3", "no part or message `w`"), ("r=3 V", "Resistance")]
    {
        let refused = run(&["--set", setting]);
        assert_eq!(refused.status.code(), Some(2), "{setting}: {refused:?}");
        let said = String::from_utf8_lossy(&refused.stderr);
        assert!(said.contains(wanted) && said.contains(setting), "{said}");
    }
}
