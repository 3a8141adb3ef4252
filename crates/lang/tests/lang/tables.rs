//! Tables beside a text, whose cells are values and nothing else.

use kernel::Term;
use kernel::program::Allowed;
use lang::tables::{Table, is_name};

const CELLS: &str = "\
name, d [mm], n [pcs], grade, of, on
# the small ones

# and one more
M3,   3,      2,       a,     k,  true
M8,   8,      4,       b,     8,  false
M8x,  8,      5,       a,     k,  true
";

const PROGRAM: &str = "program Bolt(d: Length in \"t.csv\".d = 8 mm, n: Integer in \"t.csv\".n = 4, \
                       grade: Text in \"t.csv\".grade = \"b\", on: Bool in \"t.csv\".on = true) { }\n";

fn load(name: &str) -> Option<String> {
    match name {
        "t.csv" | "parts/t.csv" => Some(CELLS.into()),
        "parts.bolts" => Some("program Nut(k: Length in \"gone.csv\".d = 1 mm) { }\n".into()),
        _ => None,
    }
}

#[test]
fn cells_are_read_as_values_of_the_class_of_the_parameter() {
    let lowered = lang::lower(PROGRAM, &load, None);
    assert_eq!(lowered.diagnostics, []);
    let class = lowered.document.class_named("Bolt").expect("it is declared");
    let program = lowered.document.program(class).expect("it is a program");
    let values = |name: &str| {
        let asked = program.parameters.iter().find(|asked| *asked.name == *name);
        match asked.and_then(|asked| asked.allowed.clone()) {
            Some(Allowed::OneOf(values)) => values,
            other => panic!("{name}: {other:?}"),
        }
    };
    assert_eq!(values("d").len(), 2);
    let counts: Vec<f64> = values("n").iter().map(number).collect();
    assert_eq!(counts, [2.0, 4.0, 5.0]);
    assert_eq!(values("grade"), [Term::Text("a".into()), Term::Text("b".into())]);
    assert_eq!(values("on"), [Term::Bool(true), Term::Bool(false)]);
}

fn number(term: &Term) -> f64 {
    let Term::Number { value, .. } = term else { panic!("{term:?}") };
    *value
}

#[test]
fn a_cell_is_never_taken_as_a_name_of_the_program() {
    let text = "program Bolt(k: Length = 1 mm, d: Length in \"t.csv\".of = 8 mm) { }\n";
    let lowered = lang::lower(text, &load, None);
    let said: Vec<&str> = lowered.diagnostics.iter().map(|d| d.message.as_str()).collect();
    assert_eq!(said.len(), 1, "{said:?}");
    // the comments and the empty line before the row are lines, too
    assert!(said[0].starts_with("found `k` in line 5 of t.csv, column of"), "{said:?}");
    // and what is renamed does not reach into a table
    let at = u32::try_from(text.find("k:").expect("it is there")).expect("it is short");
    let of = base::Span::new(at, at + 1);
    let spoken: Vec<base::Span> = lang::mentions(text, &load)
        .into_iter()
        .filter(|m| m.declared.as_ref().is_some_and(|(_, named)| *named == of))
        .map(|m| m.span)
        .collect();
    assert!(spoken.iter().all(|span| *span == of), "{spoken:?}");
}

#[test]
fn what_is_missing_is_known_by_the_name_it_was_asked_for() {
    let lowered = lang::lower("use parts.bolts\nuse nowhere\n", &load, None);
    let missing: Vec<&str> = lowered.missing.iter().map(String::as_str).collect();
    assert_eq!(missing, ["nowhere", "parts/gone.csv"]);
}

#[test]
fn a_table_is_no_text_of_the_language() {
    let lowered = lang::lower("use t.csv\n", &load, None);
    let said: Vec<_> = lowered.diagnostics.iter().map(|d| (d.code, d.message.as_str())).collect();
    assert_eq!(said, [("not-a-text", "t.csv is a table, and no text of the language")]);
    let text = PROGRAM.replace("t.csv", "../../t.csv");
    let lowered = lang::lower(&text, &|name| panic!("{name} is asked for"), None);
    assert_eq!(lowered.diagnostics[0].message, "`../../t.csv` is no name of a table");
}

#[test]
fn names_of_tables_may_have_dots_and_spaces() {
    for name in ["bolts.csv", "iso.4014.csv", "M8 bolts.csv", "parts/M8 bolts.csv"] {
        assert!(is_name(name), "{name}");
    }
    for name in
        ["bolts", ".csv", "..csv", "../a.csv", "a/../b.csv", "/a.csv", "a.b/c.csv", " a.csv"]
    {
        assert!(!is_name(name), "{name}");
    }
}

#[test]
fn lines_are_counted_with_comments_and_both_kinds_of_ends() {
    for end in ["\n", "\r\n"] {
        let text = CELLS.replace('\n', end);
        let table = Table::read(&text).expect("it is one");
        let lines: Vec<u32> = table.rows.iter().map(|row| row.line).collect();
        assert_eq!(lines, [5, 6, 7], "{end:?}");
    }
}

#[test]
fn a_row_that_begins_as_a_comment_does_is_known_where_it_is_missed() {
    let load =
        |name: &str| (name == "t.csv").then(|| "size, d\n#8, 4.2\n\"#6\", 3.5\n".to_string());
    let text = "program Bolt(size: Text in \"t.csv\".size = \"#8\") { }\n";
    let lowered = lang::lower(text, &load, None);
    let hint =
        "a line that begins with `#` is a comment of the table: `\"#8\"` in quotes is a value";
    assert_eq!(lowered.missed_row("#8").as_deref(), Some(hint));
    assert_eq!(lowered.missed_row("#6"), None);
    assert_eq!(lowered.missed_row("M3"), None);
}

#[test]
fn a_table_that_is_not_there_is_told_once() {
    let text = PROGRAM.replace("t.csv", "gone.csv");
    let lowered = lang::lower(&text, &load, None);
    let said: Vec<&str> = lowered.diagnostics.iter().map(|d| d.message.as_str()).collect();
    assert_eq!(said, ["there is no table gone.csv beside this one"]);
}

#[test]
fn a_table_is_refused_for_the_signs_between_its_cells_alone() {
    let columns = |text: &str| Table::read(text).map(|table| table.names().join("|"));
    assert_eq!(columns("d\t\n3\n"), Ok("d".into()));
    assert_eq!(columns("\"a;b\"\n3\n"), Ok("a;b".into()));
    for text in ["a;b\n3;4\n", "\na;b\n3;4\n", "# two\n\na;b\n3;4\n", "\"a\";\"b\"\n3;4\n"] {
        let why = columns(text).expect_err(text);
        assert!(why.starts_with("`;` stand between its cells"), "{text}: {why}");
    }
    assert!(columns("a\tb\n3\t4\n").expect_err("it has tabs").starts_with("tabs stand"));
    assert!(columns("a\n\u{fffd}\n").expect_err("it is lost").starts_with("it has U+FFFD"));
}
