//! What is allowed of a parameter, from a column of a table beside the document.

use session::drafting::view::NewParameter;
use session::{DocumentId, Host, Session};
use std::fs;
use std::path::PathBuf;

const BOLTS: &str = "\
# thread sizes
name, d [mm], k [mm], grade
M3,  3,  2,   A
M8,  8,  5.3, A
M8x, 8,  5,   B
M10, 10, ,    some
";

const NUTS: &str = "use geometry\nprogram Nut(k: Length in \"bolts.csv\".k = 1 mm) {\n    \
                    rim = Circle(center: Point(0, 0), radius: k)\n}\n";

struct Shelf;

impl Host for Shelf {
    fn read(&self, name: &str) -> Option<String> {
        match name {
            "bolts.csv" => Some(BOLTS.into()),
            "sizes.csv" => Some("size, d\n#8, 4.2\n#10, 4.8\nM3, 3\n".into()),
            "empty.csv" => Some("d\n".into()),
            // a used text in a folder has a table of its own, by the same name there
            "parts/bolts.csv" => Some("k [mm]\n1\n2\n".into()),
            "parts.nuts" => Some(NUTS.into()),
            "parts.lost" => Some(NUTS.replace("bolts", "gone")),
            _ if name.ends_with(".csv") => None,
            _ => {
                let library = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../library");
                fs::read_to_string(library.join(name).with_extension("thing")).ok()
            }
        }
    }
}

fn opened(text: &str) -> (Session, DocumentId) {
    let mut session = Session::new(Box::new(Shelf));
    let id = session.open("desk", text);
    (session, id)
}

fn bolt(allowed: &str) -> String {
    format!(
        "use geometry\nunit mm\nprogram Bolt(d: Length in {allowed} = 8 mm \"Thread?\") {{\n    \
         rim = Circle(center: Point(0, 0), radius: d / 2)\n}}\nbolt: Bolt {{ d = 8 mm }}\n"
    )
}

fn told(text: &str) -> Vec<String> {
    let (session, id) = opened(text);
    session.text(id).diagnostics.iter().map(|d| format!("{}: {}", d.code, d.message)).collect()
}

#[test]
fn the_tables_of_a_document_are_those_that_it_uses_and_misses() {
    let text = "use parts.nuts\nuse parts.lost\n";
    let (session, id) = opened(&format!("{text}{}", bolt("\"sizes.csv\".d")));
    let tables: Vec<String> = session.tables(id).into_iter().collect();
    assert_eq!(tables, ["parts/bolts.csv", "parts/gone.csv", "sizes.csv"]);
}

#[test]
fn the_values_of_a_column_are_those_that_are_allowed() {
    let (mut session, id) = opened(&bolt("\"bolts.csv\".d"));
    assert!(session.text(id).diagnostics.is_empty());
    session.set_typed(id, "bolt.d", "10 mm").expect("the table has it");
    let refused = session.set_typed(id, "bolt.d", "9 mm").expect_err("the table has it not");
    assert!(refused.message.contains("d_range"), "{}", refused.message);
    // it is offered where a value is wanted
    let prompt = session.begin(id, "Bolt").expect("it is a construction");
    assert_eq!(prompt.choices, ["3 mm", "8 mm", "10 mm"]);
    assert!(prompt.words.contains("3 mm, 8 mm or 10 mm"), "{}", prompt.words);
    session.enter(id, "9 mm").expect_err("the table has it not");
    session.give_up(id);
    // and where it is shown
    let rows = session.values(id);
    let row = rows.iter().find(|row| row.path == "bolt.d").expect("it is shown");
    assert_eq!(row.options, ["3", "8", "10"]);
}

#[test]
fn what_is_wrong_with_a_table_is_told_where_it_is_named() {
    for (allowed, wanted) in [
        ("\"nuts.csv\".d", "missing-table: there is no table nuts.csv beside this one"),
        ("\"bolts.csv\".e", "no-column: bolts.csv has no column e"),
        ("\"empty.csv\".d", "no-column: column d of empty.csv has no values"),
        (
            "\"bolts.csv\".grade",
            "wrong-cell: found `A` in line 3 of bolts.csv, column grade, wanted Length (m)",
        ),
    ] {
        let said = told(&bolt(allowed));
        assert!(said.iter().any(|said| said == wanted), "{allowed}: {said:?}");
    }
}

#[test]
fn a_hand_names_a_column_as_a_file_and_its_heading() {
    let (mut session, id) = opened("use geometry\nunit mm\n");
    session.record(id, "Bolt").expect("a new program");
    let new = |range: &str| NewParameter {
        name: "d".into(),
        example: "8 mm".into(),
        range: range.into(),
        ..NewParameter::default()
    };
    let reading = session.read_parameter(id, &new("bolts.csv.d"));
    assert_eq!(reading.allowed.as_deref(), Some("3 mm, 8 mm or 10 mm"));
    assert_eq!(reading.wrong, []);
    let reading = session.read_parameter(id, &new("bolts.csv.e"));
    let said = &reading.wrong.first().expect("there is no such column").1;
    assert_eq!(said, "bolts.csv has no column e: it has name, d, k, grade");
    session.define_parameter(id, &new("bolts.csv.d")).expect("it is new");
    let text = session.text(id).source;
    assert!(text.contains("d: Length in \"bolts.csv\".d = 8 mm"), "{text}");
    let steps = session.steps(id, None).expect("it is recorded");
    assert_eq!(steps.parameters[0].choices, ["3 mm", "8 mm", "10 mm"]);
}

#[test]
fn a_table_is_that_of_the_folder_of_the_text_that_names_it() {
    let text = format!("use parts.nuts\n{}", bolt("\"bolts.csv\".d"));
    let (mut session, id) = opened(&text);
    assert_eq!(told(&text), [""; 0]);
    let choices = |session: &mut Session, tool| session.begin(id, tool).expect("it is one").choices;
    assert_eq!(choices(&mut session, "Bolt"), ["3 mm", "8 mm", "10 mm"]);
    session.give_up(id);
    assert_eq!(choices(&mut session, "Nut"), ["1 mm", "2 mm"]);
}

#[test]
fn a_column_of_words_is_a_table_of_texts() {
    let text =
        bolt("\"bolts.csv\".d").replace("(d:", "(grade: Text in \"bolts.csv\".grade = \"A\", d:");
    assert_eq!(told(&text), [""; 0]);
    let (mut session, id) = opened(&text);
    let prompt = session.begin(id, "Bolt").expect("it is a construction");
    assert_eq!(prompt.choices, ["\"A\"", "\"B\"", "\"some\""]);
    let refused = session.enter(id, "C").expect_err("it is none of them");
    assert!(
        refused.message.contains("\"A\", \"B\" or \"some\" are allowed"),
        "{}",
        refused.message
    );
    session.enter(id, "B").expect("it is one of them");
    session.give_up(id);
    // and it is understood as it is typed
    session.record(id, "Nut").expect("a new program");
    let new = |example: &str| NewParameter {
        name: "grade".into(),
        example: example.into(),
        range: "bolts.csv.grade".into(),
        ..NewParameter::default()
    };
    assert_eq!(session.read_parameter(id, &new("\"A\"")).wrong, []);
    let wrong = session.read_parameter(id, &new("\"C\"")).wrong;
    assert!(wrong.iter().any(|(_, why)| why.contains("is not among these")), "{wrong:?}");
}

#[test]
fn a_missing_table_of_a_used_text_is_not_read_for_ever() {
    let (mut session, id) = opened("use parts.lost\n");
    assert_eq!(session.text(id).diagnostics[0].code, "missing-table");
    assert_eq!(session.catch_up(id), None, "it is not there yet");
}

#[test]
fn a_thing_may_be_called_as_tables_end() {
    let (session, id) =
        opened(&format!("{}csv: Length = 3 mm\nanchor csv\n", bolt("\"bolts.csv\".d")));
    let rows = session.values(id);
    let row = rows.iter().find(|row| row.path == "csv").expect("it is shown");
    assert!(!row.is_layout);
}

#[test]
fn a_value_whose_row_is_a_comment_is_told_to_stand_in_quotes() {
    let (session, id) = opened(
        "program Screw(size: Text in \"sizes.csv\".size = \"M3\") { a = size }\n\
         screw: Screw { size = \"#8\" }\nother: Screw { size = \"M4\" }\n",
    );
    let found = session.text(id).diagnostics;
    let ended = found.iter().filter(|d| d.code == "run-ended");
    let hints: Vec<&str> = ended.map(|d| d.hint.as_deref().unwrap_or_default()).collect();
    let quoted =
        "a line that begins with `#` is a comment of the table: `\"#8\"` in quotes is a value";
    assert_eq!(hints, [quoted, ""]);
}
