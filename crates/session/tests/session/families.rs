//! Families in the lab: rows changed cell by cell, used, and the map of a program.

use crate::desk::{Desk, gallery};
use session::view::{FamilyAxis, FamilyRow, RowFormats, RowUse};
use std::fs;

const DISCS: &str = "\
use geometry
unit mm

program Disc(
    rim: Length in 1 mm..100 mm = 20 mm \"Radius?\",
    hole: Length = 5 mm,
    spokes: Integer = 3,
) {
    constraint wall: hole < rim
    edge = Circle(center: Point(0, 0), radius: rim)
    bore = Circle(center: Point(0, 0), radius: hole)
}

/// Two that are sold.
family Sold of Disc {
    rows: (\"D10\", 10 mm, 2 mm)  (\"D30\", 30 mm)
    constraint even: rim < 90 mm
}

disc: Disc
";

#[test]
fn rows_that_are_called_alike_have_files_of_their_own() {
    let names = |rows: &[&str]| {
        let row = |name: &&str| FamilyRow { name: (*name).into(), ..FamilyRow::default() };
        session::file_names(&rows.iter().map(row).collect::<Vec<_>>())
    };
    assert_eq!(
        names(&["D 10", "d/10", "D\u{fc}\r\n", "", "."]),
        ["d-10", "d-10_2", "d\u{fc}", "row", "row_2"]
    );
    // one is called as another is numbered
    assert_eq!(names(&["a_2", "a", "a", "a"]), ["a_2", "a", "a_3", "a_4"]);
    assert_eq!(names(&["a", "a", "a_2", "a"]), ["a", "a_2", "a_2_2", "a_3"]);
    // what file systems take of a name is 255 bytes
    let long = names(&[&"\u{fc}".repeat(40_000), &"\u{fc}".repeat(50_000)]);
    assert!(long[0] != long[1] && long.iter().all(|name| name.len() < 250), "{long:?}");
}

fn cells(desk: &Desk, family: &str) -> Vec<(String, Vec<String>)> {
    let grid = desk.session.family_grid(desk.id, family, None).expect("there is one");
    let row = |at: usize| {
        let cells = (0..grid.columns.len()).map(|column| grid.cell(at, column).to_string());
        (grid.rows[at].name.clone(), cells.collect())
    };
    (0..grid.rows.len()).map(row).collect()
}

fn named(name: &str, cells: [&str; 3]) -> (String, Vec<String>) {
    (name.into(), cells.map(String::from).to_vec())
}

#[test]
fn a_family_is_a_grid_of_what_is_written() {
    let desk = Desk::of(DISCS);
    let grid = desk.session.family_grid(desk.id, "Sold", None).expect("there is one");
    assert!(grid.is_own && grid.program == "Disc" && grid.table.is_none());
    let columns: Vec<_> = grid
        .columns
        .iter()
        .map(|c| (c.name.as_str(), c.example.as_str(), c.prompt.as_str()))
        .collect();
    assert_eq!(columns, [("rim", "20 mm", "Radius?"), ("hole", "5 mm", ""), ("spokes", "3", "")]);
    let rows = [named("D10", ["10 mm", "2 mm", ""]), named("D30", ["30 mm", "", ""])];
    assert_eq!(cells(&desk, "Sold"), rows);
}

#[test]
fn a_cell_is_said_anew_and_a_step_takes_it_back() {
    let mut desk = Desk::of(DISCS);
    let set = |desk: &mut Desk, row, column, typed: &str| {
        desk.session.set_family_cell(desk.id, "Sold", (row, column), typed)
    };
    set(&mut desk, 1, Some("spokes"), "7").expect("it is a whole number");
    // what stands before it is the program's own value, which has to be written out
    assert!(desk.text().contains("(\"D30\", 30 mm, 5 mm, 7)"), "{}", desk.text());
    assert!(desk.text().contains("constraint even: rim < 90 mm"), "{}", desk.text());
    set(&mut desk, 0, None, "D 10 \"old\"").expect("it is a name");
    assert_eq!(cells(&desk, "Sold")[0], named("D 10 \"old\"", ["10 mm", "2 mm", ""]));
    set(&mut desk, 0, Some("hole"), "").expect("a cell may be empty");
    assert_eq!(cells(&desk, "Sold")[0].1, ["10 mm", "", ""]);
    let before = desk.text();
    let wrong = set(&mut desk, 0, Some("hole"), "3 kg").expect_err("a mass is no length");
    assert!(wrong.message.starts_with("hole: "), "{}", wrong.message);
    assert_eq!(desk.text(), before);
    for _ in 0..3 {
        desk.apply(&session::Command::Undo).expect("there is a step");
    }
    assert_eq!(desk.text(), DISCS);
}

#[test]
fn rows_are_added_from_what_is_drawn_and_deleted() {
    let mut desk = Desk::of(DISCS);
    desk.type_in("disc.rim", "40 mm").expect("it is free");
    desk.session.add_family_row(desk.id, "Sold", Some("disc")).expect("disc is one");
    desk.session.add_family_row(desk.id, "Sold", None).expect("the program has values");
    let rows = cells(&desk, "Sold");
    assert_eq!(rows[2], named("disc", ["40 mm", "5 mm", "3"]));
    assert_eq!(rows[3], named("4", ["20 mm", "5 mm", "3"]));
    for _ in 0..4 {
        desk.session.delete_family_row(desk.id, "Sold", 0).expect("there is a first row");
    }
    assert!(cells(&desk, "Sold").is_empty());
    assert!(desk.session.delete_family_row(desk.id, "Sold", 0).is_err());
    desk.session.add_family_row(desk.id, "Sold", None).expect("rows may be added again");
    assert_eq!(cells(&desk, "Sold"), [named("1", ["20 mm", "5 mm", "3"])]);
}

#[test]
fn a_block_of_cells_is_pasted_from_a_spreadsheet() {
    let mut desk = Desk::of(DISCS);
    let before = desk.text();
    let block = "12\t3 mm\n\"14 mm\"\t\n16\t4 mm\n";
    desk.session.set_family_cells(desk.id, "Sold", (1, 1), block).expect("all are lengths");
    let rows = cells(&desk, "Sold");
    assert_eq!(rows[1], named("D30", ["12", "3 mm", ""]));
    assert_eq!(rows[2], named("3", ["14 mm", "", ""]));
    assert_eq!(rows[3], named("4", ["16", "4 mm", ""]));
    desk.undo();
    assert_eq!(desk.text(), before);
    // a line break in quotes begins no row, and an empty line is one
    let block = "\"Long\r\nname\"\t12\r\n\r\nLast\t14\r\n";
    desk.session.set_family_cells(desk.id, "Sold", (1, 0), block).expect("all fit");
    let rows = cells(&desk, "Sold");
    assert_eq!(rows[1], named("Long\nname", ["12", "", ""]));
    assert_eq!(rows[2], named("3", ["", "", ""]));
    assert_eq!(rows[3], named("Last", ["14", "", ""]));
    desk.undo();
    // a row is made by what is typed in the one that is not there yet
    desk.session.set_family_cells(desk.id, "Sold", (2, 0), "D50").expect("it is a name");
    assert_eq!(cells(&desk, "Sold")[2], named("D50", ["", "", ""]));
    desk.session.set_family_cells(desk.id, "Sold", (3, 0), "\"D\" 60").expect("it is a name");
    assert_eq!(cells(&desk, "Sold")[3], named("\"D\" 60", ["", "", ""]));
    // a quote that nothing closes is one of the cell's own
    desk.session.set_family_cells(desk.id, "Sold", (4, 0), "\"A\t5\nB\t6").expect("two rows");
    assert_eq!(cells(&desk, "Sold")[4], named("\"A", ["5", "", ""]));
    assert_eq!(cells(&desk, "Sold")[5], named("B", ["6", "", ""]));
    for (from, block, why) in [
        ((0, 3), "3\t4", "what is pasted ends 1 column beyond the grid"),
        ((9, 1), "3", "Sold has no row 10"),
        ((0, 1), "10\tx", "hole: "),
    ] {
        let wrong = desk.session.set_family_cells(desk.id, "Sold", from, block);
        let wrong = wrong.expect_err("it does not fit").message;
        assert!(wrong.starts_with(why), "{wrong}");
    }
    assert!(!desk.session.programs(desk.id).contains(&"Rounding".to_string()));
}

#[test]
fn a_family_is_begun_and_leaves_and_comes_as_a_table() {
    let mut desk = Desk::of(DISCS);
    let (_, name) = desk.session.begin_family(desk.id, "Disc").expect("it has parameters");
    assert_eq!(name, "DiscSizes");
    let table = "part,rim [mm],hole\na,12,3 mm\nb,13.5,\n";
    desk.session.take_family_table(desk.id, &name, table).expect("it is a table");
    assert_eq!(
        cells(&desk, &name),
        [named("a", ["12 mm", "3 mm", ""]), named("b", ["13.5 mm", "", ""])]
    );
    let grid = desk.session.family_grid(desk.id, &name, None).expect("there is one");
    assert_eq!(grid.csv(), "name,rim [mm],hole [mm],spokes\na,12,3,\nb,13.5,,\n");
    let before = desk.text();
    let wrong = desk.session.take_family_table(desk.id, &name, "part,rim\na,wide\n");
    let wrong = wrong.expect_err("wide is no length").message;
    assert!(wrong.starts_with("line 2 of the table, a: rim: "), "{wrong}");
    assert_eq!(desk.text(), before);
}

#[test]
fn rows_of_a_file_are_read_alone_until_they_are_taken_in() {
    let mut desk = Desk::of(&gallery("bearing"));
    let csv = concat!(env!("CARGO_MANIFEST_DIR"), "/../../gallery/bearing.csv");
    let table = fs::read_to_string(csv).expect("the gallery has it");
    let grid = desk.session.family_grid(desk.id, "Series62", Some(&table)).expect("there is one");
    assert_eq!((grid.rows.len(), grid.is_own), (11, false));
    assert_eq!(grid.cell(4, 1), "47 mm");
    let refused = desk.session.set_family_cell(desk.id, "Series62", (0, Some("bore")), "9 mm");
    let refused = refused.expect_err("they stand in a file").message;
    assert_eq!(
        refused,
        "the rows stand in bearing.csv: take them into the document to change them"
    );
    desk.session.take_family_table(desk.id, "Series62", &table).expect("all are values");
    let taken = desk.session.family_grid(desk.id, "Series62", None).expect("there is one");
    assert!(taken.is_own);
    assert_eq!(taken.rows[4].name, "6204");
    let drawn = taken.rows.iter().map(|row| {
        let formats = RowFormats::default();
        desk.session.draw_row(desk.id, "Series62", row, formats).expect("it is one").outcome
    });
    assert_eq!(drawn.collect::<Vec<_>>(), vec!["drawn"; 11]);
}

#[test]
fn a_row_is_used_by_its_name() {
    let mut desk = Desk::of(DISCS);
    let grid = desk.session.family_grid(desk.id, "Sold", None).expect("there is one");
    desk.type_in("disc.spokes", "9").expect("it is free");
    let to = RowUse::Set("disc".into());
    desk.session.use_family_row(desk.id, ("Sold", &grid.rows[0]), &to).expect("disc is one");
    let comes_to = |desk: &Desk, path: &str| desk.session.comes_to(desk.id, path);
    assert_eq!(comes_to(&desk, "disc.rim").as_deref(), Some("10 mm"));
    // what the row does not say is the program's own value
    assert_eq!(comes_to(&desk, "disc.spokes").as_deref(), Some("3"));
    let placed = desk.session.use_family_row(desk.id, ("Sold", &grid.rows[1]), &RowUse::Place);
    assert_eq!(placed.expect("it can be placed").1, "d30");
    assert_eq!(comes_to(&desk, "d30.rim").as_deref(), Some("30 mm"));
    let again = desk.session.use_family_row(desk.id, ("Sold", &grid.rows[1]), &RowUse::Place);
    assert_eq!(again.expect("it can be placed").1, "d30_2");
    // while another program is recorded, it calls this one
    desk.session.record(desk.id, "Stack").expect("a new program");
    // what is being drawn is not filled with it
    desk.session.begin(desk.id, "Disc").expect("a program is a construction");
    desk.session.enter(desk.id, "40 mm").expect("it fits");
    let (text, prompt) = (desk.text(), desk.session.prompt(desk.id));
    let place = ("Sold", &grid.rows[0]);
    let waits = desk.session.use_family_row(desk.id, place, &RowUse::Place).expect_err("it waits");
    assert_eq!(
        waits.message,
        "Disc waits for an answer: give it one, or give it up, before a row is placed"
    );
    assert_eq!((desk.text(), desk.session.prompt(desk.id)), (text, prompt));
    desk.session.give_up(desk.id);
    let called = desk.session.use_family_row(desk.id, place, &RowUse::Place);
    assert_eq!(called.expect("it can be called").1, "stack.disc");
    assert!(
        desk.text().contains("    disc = Disc(rim: 10 mm, hole: 2 mm, spokes: 3)"),
        "{}",
        desk.text()
    );
    assert_eq!(desk.session.prompt(desk.id), None);
    assert_eq!(comes_to(&desk, "stack.disc.bore").as_deref(), Some("centre (0, 0), radius 2"));
}

#[test]
fn a_map_shows_where_a_program_draws() {
    let desk = Desk::of(DISCS);
    let axis = |parameter: &str, from: &str, to: &str| FamilyAxis {
        parameter: parameter.into(),
        from: from.into(),
        to: to.into(),
    };
    let (rim, hole) = (axis("rim", "10 mm", "103 mm"), axis("hole", "0 mm", "62 mm"));
    let map = desk.session.family_map(desk.id, ("Sold", Some("disc")), [&rim, &hole]);
    let map = map.expect("both are lengths");
    assert_eq!((map.across.values.len(), map.up.values.len()), (32, 32));
    for (at, reason) in map.places.iter().enumerate() {
        let (x, y) = (map.across.values[at % 32], map.up.values[at / 32]);
        let reason = reason.map(|r| map.reasons[r].step.as_str());
        // the range of the program, then its demand, then the rule of the family
        let wanted = match () {
            () if x > 100.0 => reason.filter(|&r| r != "even"),
            () if y >= x => Some("wall"),
            () if x >= 90.0 => Some("even"),
            () => None,
        };
        assert_eq!(reason, wanted, "{x} {y}");
        assert!(x <= 100.0 || reason.is_some(), "{x} {y}");
    }
    let place = map.place(10, 0).expect("it lies on the map");
    assert_eq!((place.across.as_str(), place.up.as_str(), place.why), ("40 mm", "0 mm", None));
    let wrong = desk.session.family_map(desk.id, ("Sold", None), [&rim, &rim]);
    assert!(wrong.is_err());
    let axes = desk.session.family_axes(desk.id, "Sold", Some("disc")).expect("it has numbers");
    assert_eq!(axes[0], axis("rim", "2 mm", "50 mm"));
    assert_eq!(axes[2].parameter, "spokes");
}

#[test]
fn what_a_table_says_besides_the_parameters_stays_in_the_table() {
    let text = DISCS.replace(
        "    rows: (\"D10\", 10 mm, 2 mm)  (\"D30\", 30 mm)\n    constraint even: rim < 90 mm\n",
        "    across: Length\n    table \"sold.csv\"\n    constraint even: rim < 90 mm\n    constraint across = 2 * rim\n",
    );
    let table = "name,rim [mm],across [mm]\nD10,10,20\nD30,30,61\n";
    let mut desk = Desk::of(&text);
    let (session, id) = (&mut desk.session, desk.id);
    let grid = session.family_grid(id, "Sold", Some(table)).expect("there is one");
    assert_eq!((grid.program.as_str(), grid.columns.len()), ("Disc", 3));
    let drawn = |at: usize| {
        let row = &grid.rows[at];
        session.draw_row(id, "Sold", row, RowFormats::default()).expect("it is a row").message
    };
    assert_eq!(drawn(0), "");
    assert_eq!(drawn(1), "across = 2 * rim is not met; across is 61 mm, rim is 30 mm");

    // a row is used as that of any program
    let set = session.use_family_row(id, ("Sold", &grid.rows[0]), &RowUse::Set("disc".into()));
    assert_eq!(set.expect("the disc takes it").1, "disc");
    // the map knows of rules for parameters alone
    let axis = |parameter: &str, from: &str, to: &str| FamilyAxis {
        parameter: parameter.into(),
        from: from.into(),
        to: to.into(),
    };
    let axes = [axis("rim", "10 mm", "80 mm"), axis("hole", "1 mm", "9 mm")];
    let map = session.family_map(id, ("Sold", None), [&axes[0], &axes[1]]).expect("it is made");
    assert!(map.places.iter().all(Option::is_none), "{:?}", map.reasons);
    // and rows that are written out have no place for it
    let refused = session.take_family_table(id, "Sold", table).expect_err("it cannot be said");
    assert!(refused.message.starts_with("across is a column that Disc does not ask for"));
}

#[test]
fn a_row_is_called_where_the_program_has_a_place_in_brackets() {
    let text = "use geometry
unit mm
program Tag(is_round: Bool = true, d: Length = 5 mm, at: Point = (0, 0)) { c = Circle(at, d) }
family Tags of Tag { rows: (\"T 1\", false, 6 mm) }
";
    let mut desk = Desk::of(text);
    let grid = desk.session.family_grid(desk.id, "Tags", None).expect("there is one");
    desk.session.record(desk.id, "Stack").expect("a new program");
    let row = ("Tags", &grid.rows[0]);
    let called = desk.session.use_family_row(desk.id, row, &RowUse::Place);
    assert_eq!(called.expect("it can be called").1, "stack.tag");
    let call = "tag = Tag(is_round: false, d: 6 mm, at: Point(0, 0))";
    assert!(desk.text().contains(call), "{}", desk.text());
    // and so a place may be typed
    desk.session.begin(desk.id, "Circle").expect("a construction");
    for typed in ["(3, 4)", "2"] {
        desk.session.enter(desk.id, typed).expect("it fits");
    }
    assert!(desk.text().contains("circle = Circle(center: Point(3, 4), radius: 2)"));
}

#[test]
fn yes_and_no_are_said_of_a_cell_and_of_a_parameter() {
    let mut desk = Desk::of(
        "use geometry
unit mm
program Tag(is_round: Bool = true, d: Length = 5 mm) { c = Circle(Point(0, 0), d) }
family Tags of Tag { rows: (\"T 1\", true, 6 mm) }
tag: Tag
",
    );
    let cell = |desk: &mut Desk, column, typed: &str| {
        desk.session.set_family_cell(desk.id, "Tags", (0, Some(column)), typed)
    };
    cell(&mut desk, "is_round", "No").expect("it is an answer");
    assert!(desk.text().contains("(\"T 1\", false, 6 mm)"), "{}", desk.text());
    let values = [("is_round".to_string(), "no".to_string())];
    desk.session.set_parameters(desk.id, "tag", &values).expect("it is an answer");
    assert!(desk.text().contains("is_round = false"), "{}", desk.text());
    let wrong = cell(&mut desk, "d", "8,5").expect_err("it has a comma").message;
    assert_eq!(wrong, "d: `8,5` is no value; the tenths of a number stand after a point: `8.5`");
}

#[test]
fn a_rectangle_turned_inside_out_by_its_parameters_is_told_at_its_step_and_in_its_row() {
    let text = "use geometry\nprogram Web(h: Length = 40, t: Length = 5) {\n    \
        rectangle = Rectangle(corner: Point(0, 0), width: t, height: h - 2 * t)\n}\n\
        family Webs of Web {\n    rows: (\"good\", 40)  (\"flat\", 8)\n}\nweb: Web\n";
    let mut desk = Desk::of(text);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    let doubt =
        |desk: &Desk| desk.session.steps(desk.id, Some("web")).unwrap().rows[0].doubt.clone();
    assert_eq!(doubt(&desk), None);
    desk.set("web.h", 6.0).expect("nothing is refused for it");
    assert!(doubt(&desk).is_some_and(|told| told.starts_with("its height is negative")));
    let grid = desk.session.family_grid(desk.id, "Webs", None).expect("a family");
    // in pictures and in the plain grid
    for svg in [true, false, false] {
        let formats = RowFormats { svg, dxf: false };
        let told = grid.rows.iter().map(|row| {
            let outcome = desk.session.draw_row(desk.id, "Webs", row, formats).expect("it is one");
            assert_eq!(outcome.outcome, "drawn");
            outcome.message
        });
        let told: Vec<String> = told.collect();
        assert_eq!(told[0], "");
        assert!(told[1].starts_with("rectangle: its height is negative"), "{}", told[1]);
    }
}

#[test]
fn a_row_by_which_no_step_draws_a_figure_says_so() {
    let text = "use geometry\nprogram Row(holes: Integer = 2) {\n    \
        turns = repeat holes times { c = Circle(center: Point(0, 0), radius: 4) }\n}\n\
        family Rows of Row {\n    rows: (\"two\", 2)  (\"none\", 0)\n}\n";
    let desk = Desk::of(text);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    let grid = desk.session.family_grid(desk.id, "Rows", None).expect("a family");
    for svg in [true, false] {
        let formats = RowFormats { svg, dxf: false };
        let told = grid.rows.iter().map(|row| {
            desk.session.draw_row(desk.id, "Rows", row, formats).expect("it is one").message
        });
        assert_eq!(told.collect::<Vec<_>>(), ["", "the drawing is empty"]);
    }
}

#[test]
fn a_doubt_is_a_value_where_there_is_one() {
    let mut desk = Desk::of("use geometry\nr: Rectangle { width = 4  height = 3 }\n");
    let is_row =
        |desk: &Desk, path: &str| desk.session.values(desk.id).iter().any(|row| row.path == path);
    assert!(is_row(&desk, "r.area") && !is_row(&desk, "r.doubt"));
    desk.set("r.height", -3.0).expect("nothing is refused for it");
    assert!(is_row(&desk, "r.doubt"));
}
