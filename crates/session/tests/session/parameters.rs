//! Parameters of a program that is recorded: what a plain number is, and how one is said anew.

use crate::desk::Desk;
use session::drafting::view::{Ends, NewParameter, Turn};
use session::view::Pointer;

fn define(desk: &mut Desk, name: &str, example: &str) {
    let new =
        NewParameter { name: name.into(), example: example.into(), ..NewParameter::default() };
    desk.session.define_parameter(desk.id, &new).expect("it is new");
}

/// A flange whose holes were defined by a plain number, as all its lengths.
fn flange() -> Desk {
    let mut desk = Desk::of("use geometry\nunit mm\n");
    desk.session.record(desk.id, "Flange").expect("a new program");
    for (name, example) in [("round", "90"), ("holes", "6"), ("d", "11"), ("first", "30")] {
        define(&mut desk, name, example);
    }
    desk.session.begin(desk.id, "Circle").expect("there are circles");
    enter(&mut desk, "round / 2, 0");
    enter(&mut desk, "d / 2");
    desk
}

fn enter(desk: &mut Desk, typed: &str) -> Turn {
    let turn = desk.session.enter(desk.id, typed);
    turn.unwrap_or_else(|refusal| panic!("{typed}: {}\n{}", refusal.message, desk.text()))
}

fn pick(desk: &mut Desk, x: f64, y: f64) {
    let pointer = Pointer { at: (x, y), reach: 0.4, ..Pointer::default() };
    desk.session.hover(desk.id, &pointer, "");
    desk.session.point(desk.id, &pointer).expect("something lies there");
}

fn said(turn: Turn) -> String {
    match turn {
        Turn::Made { text, .. } => text,
        Turn::Wants(prompt) => prompt.words,
    }
}

fn class_of(desk: &Desk, name: &str) -> String {
    let steps = desk.session.steps(desk.id, None).expect("it is recorded");
    let row = steps.parameters.into_iter().find(|row| row.name == name);
    row.map(|row| row.class).unwrap_or_default()
}

#[test]
fn a_plain_number_becomes_a_count_where_it_counts() {
    let mut desk = flange();
    desk.session.begin(desk.id, ":pattern(about,count)").expect("there are patterns");
    pick(&mut desk, 50.5, 0.0);
    enter(&mut desk, "0, 0");
    let steps = desk.session.history(desk.id).0.len();
    let hover = desk.session.hover(desk.id, &Pointer::default(), "holes");
    assert_eq!(hover.why.as_deref(), Some("holes becomes a count"));
    let text = said(enter(&mut desk, "holes"));
    assert!(text.ends_with("; holes is a count now"), "{text}");
    assert_eq!(class_of(&desk, "holes"), "Integer");
    assert_eq!(desk.session.history(desk.id).0.len(), steps + 1);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(desk.session.comes_to(desk.id, "flange.pattern").as_deref(), Some("5 figures"));
}

#[test]
fn a_plain_number_becomes_a_count_before_further_operands_are_given() {
    let text = "program Washer(n: Real = 3, d: Length = 5) {
    circle = Circle(center: Point(0, 0), radius: n * d)
}
program G(holes: Length = 6) {
    point = Point(10, 0)
}
";
    let mut desk = recorded("G", text);
    desk.session.begin(desk.id, "Washer").expect("it is a tool");
    let Turn::Made { change, name, text, next } = enter(&mut desk, "exp(holes)") else {
        panic!("the text is another: {}", desk.text())
    };
    assert_eq!((&*name, &*text), ("holes is a count", ""));
    assert!(change.structure || !change.edits.is_empty(), "{change:?}");
    let words = next.expect("a diameter is wanted").words;
    assert!(words.starts_with("holes is a count now. "), "{words}");
    assert_eq!(class_of(&desk, "holes"), "Integer");
    said(enter(&mut desk, "7"));
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn a_unit_of_another_kind_is_told_before_the_parameter_is_changed() {
    let desk_of = |class: &str, example: &str| {
        let mut desk = flange();
        let id = desk.id;
        desk.session.read_parameter(id, &anew("d", (class, "", example), "")).wrong
    };
    let wrong = desk_of("Length", "60 kg");
    assert_eq!(wrong.len(), 1, "{wrong:?}");
    assert_eq!(wrong[0].1, "a length is wanted, and `60 kg` is none");
    for (class, example) in
        [("Length", "60"), ("Length", "6 cm"), ("Angle", "30"), ("Angle", "1 rad"), ("Real", "3")]
    {
        assert_eq!(desk_of(class, example), [], "{class} {example}");
    }
    assert_eq!(desk_of("Angle", "3 mm")[0].1, "an angle is wanted, and `3 mm` is none");
}

#[test]
fn an_inch_mark_in_a_question_or_comment_hides_no_names() {
    for is_asked in [true, false] {
        let mut desk = flange();
        if is_asked {
            let asks = anew("d", ("Length", "", "11"), "5\" or not");
            desk.session.define_parameter(desk.id, &asks).expect("it is there");
        } else {
            let noted = desk.text().replace("    circle =", "    // 6\" wide\n    circle =");
            desk.apply(&session::Command::Text(noted)).expect("a comment");
        }
        // what a turn draws is no part of the whole: the text alone tells its names
        desk.session.begin_loop(desk.id, "").expect("it is recorded");
        desk.session.begin(desk.id, "Circle").expect("there are circles");
        for typed in ["0, 0", "d", "0, 0", "2 * d"] {
            enter(&mut desk, typed);
        }
        assert!(desk.text().contains("    circle3 = "), "{}", desk.text());
    }
}

#[test]
fn a_plain_number_becomes_an_angle_where_it_turns() {
    let mut desk = flange();
    desk.session.begin(desk.id, "Point:turned").expect("figures are turned");
    pick(&mut desk, 50.5, 0.0);
    enter(&mut desk, "0, 0");
    enter(&mut desk, "first");
    assert!(desk.text().contains("first: Angle = 30 deg"), "{}", desk.text());
    // the diameter is a length for other steps already
    pick(&mut desk, 50.5, 0.0);
    enter(&mut desk, "0, 0");
    let before = desk.text();
    let refused = desk.session.enter(desk.id, "d").expect_err("it is a length");
    assert!(refused.message.starts_with("d is a length for other steps"), "{}", refused.message);
    assert_eq!(desk.text(), before);
}

#[test]
fn a_plain_number_becomes_a_count_of_turns() {
    let mut desk = flange();
    desk.session.begin_loop(desk.id, "").expect("it is recorded");
    desk.session.begin(desk.id, "Circle").expect("there are circles");
    enter(&mut desk, "0, 0");
    enter(&mut desk, "d");
    desk.session.end_turn(desk.id, Ends::Times).expect("a turn is drawn");
    while desk.session.prompt(desk.id).is_some_and(|p| p.label.starts_with("Second turn")) {
        desk.session.same(desk.id).expect("it is the same");
    }
    enter(&mut desk, "holes");
    assert!(desk.text().contains("holes: Integer = 6"), "{}", desk.text());
    assert_eq!(desk.session.comes_to(desk.id, "flange.turns").as_deref(), Some("6 turns"));
}

#[test]
fn a_parameter_is_said_anew_with_another_name() {
    let mut desk = flange();
    let anew = NewParameter {
        name: "hole".into(),
        example: "13".into(),
        prompt: "Hole?".into(),
        instead_of: "d".into(),
        ..NewParameter::default()
    };
    let steps = desk.session.history(desk.id).0.len();
    desk.session.define_parameter(desk.id, &anew).expect("it is there");
    let text = desk.text();
    assert!(text.contains("hole: Length = 13 \"Hole?\"") && text.contains("hole / 2"), "{text}");
    assert_eq!(desk.session.history(desk.id).0.len(), steps + 1);
    // what steps need it to be it stays
    let text = NewParameter { example: "true".into(), ..anew.clone() };
    let text = NewParameter { instead_of: "hole".into(), ..text };
    let before = desk.text();
    assert!(desk.session.define_parameter(desk.id, &text).is_err());
    assert_eq!(desk.text(), before);
    let refused =
        desk.session.remove_parameter(desk.id, "hole").expect_err("a circle speaks of it");
    assert_eq!(refused.message, "hole is spoken of by circle: change or delete these first");
    desk.set("flange.first", 4.0).expect("a parameter can be set");
    assert!(desk.text().contains("flange: Flange {"), "{}", desk.text());
    desk.session.remove_parameter(desk.id, "first").expect("nothing speaks of it");
    let wanted = "    holes: Length = 6,\n    hole: Length = 13 \"Hole?\",\n) {";
    assert!(desk.text().contains(wanted), "{}", desk.text());
    assert!(desk.text().ends_with("flange: Flange\n"), "{}", desk.text());
}

#[test]
fn a_loop_that_is_open_is_no_warning_while_it_is_recorded() {
    let mut desk = flange();
    desk.session.begin_loop(desk.id, "").expect("it is recorded");
    let all = desk.session.text(desk.id).diagnostics;
    let said: Vec<_> = all.iter().map(|d| (d.code.as_str(), d.severity.as_str())).collect();
    assert_eq!(said, [("open-block", "recording")]);
}

#[test]
fn a_program_is_applied_by_its_questions() {
    let mut desk = Desk::of(
        "use geometry
unit mm
program Hole(d: Length in 1..20 = 11 \"Diameter?\", deep: Length = 2 * d) {
    circle = Circle(center: Point(0, 0), radius: d / 2)
}
",
    );
    let all = desk.session.constructions(desk.id);
    assert_eq!(all[0].id, "Hole");
    let prompt = desk.session.begin(desk.id, "Hole").expect("it is a tool");
    let wanted =
        "Diameter? (d) type a value, pick a parameter or what has it, 1 to 20; Enter takes 11";
    assert_eq!(prompt.words, wanted);
    let refused = desk.session.enter(desk.id, "30").expect_err("it is too much");
    assert_eq!(refused.message, "d is 30: 1 to 20 are allowed");
    enter(&mut desk, "");
    // what depends on others is asked for
    assert!(desk.session.enter(desk.id, "").is_err());
    enter(&mut desk, "5");
    enter(&mut desk, "40, 0");
    assert!(desk.text().contains("d = 11"), "{}", desk.text());
}

#[test]
fn few_allowed_values_can_be_chosen_where_a_program_asks() {
    let mut desk = Desk::of(
        "use geometry
unit mm
choice Head { hexagon, socket }
program Screw(d: Length in [3, 4, 5] = 4, head: Head, long: Bool = true, grip: Length in 1..9 = 2) {
    circle = Circle(center: Point(0, 0), radius: if head = socket then d else 2 * d)
}
",
    );
    let mut wanted = desk.session.begin(desk.id, "Screw").expect("it is a tool");
    let mut asked = Vec::new();
    for answer in ["5", "socket", "no", ""] {
        asked.push(wanted.choices.join(" "));
        wanted = match desk.session.enter(desk.id, answer).expect("it is allowed") {
            Turn::Wants(prompt) => prompt,
            Turn::Made { .. } => panic!("it waits for its place"),
        };
    }
    asked.push(wanted.choices.join(" "));
    assert_eq!(asked, ["3 4 5", "hexagon socket", "yes no", "", ""]);
    enter(&mut desk, "40, 0");
    assert!(desk.text().contains("head = socket"), "{}", desk.text());
}

/// A parameter said anew.
fn anew(name: &str, (class, range, example): (&str, &str, &str), prompt: &str) -> NewParameter {
    NewParameter {
        name: name.into(),
        class: class.into(),
        range: range.into(),
        example: example.into(),
        prompt: prompt.into(),
        instead_of: name.into(),
    }
}

/// A desk where a program of a document is recorded further.
fn recorded(program: &str, text: &str) -> Desk {
    let mut desk = Desk::of(&format!("use geometry\nunit mm\n{text}"));
    assert_eq!(desk.wrong(), [], "{text}");
    desk.session.record(desk.id, program).expect("it is there");
    desk
}

#[test]
fn a_length_that_things_are_given_becomes_no_angle() {
    let text = "program G(first: Length = 30) {
    point = Point(10, 0)
}
g: G
h: G {
    first = 40
}
";
    let mut desk = recorded("G", text);
    let before = desk.text();
    desk.session.begin(desk.id, "Point:turned").expect("figures are turned");
    pick(&mut desk, 10.0, 0.0);
    enter(&mut desk, "0, 0");
    let refused = desk.session.enter(desk.id, "first").expect_err("h has one of 40 mm");
    let wanted =
        "first is a length elsewhere, too: where an angle is wanted, define one of the class Angle";
    assert_eq!(refused.message, wanted);
    let angle = anew("first", ("Angle", "", "30"), "");
    assert!(desk.session.define_parameter(desk.id, &angle).is_err());
    assert_eq!(desk.text(), before);
}

#[test]
fn a_number_of_a_parameter_that_is_said_to_be_an_angle_is_of_degrees() {
    let text = "program G(first: Length in 1..<90 = 30) {
    point = Point(10, 0)
}
g: G
";
    let mut desk = recorded("G", text);
    let angle = anew("first", ("Angle", "1..<90", "30"), "");
    desk.session.define_parameter(desk.id, &angle).expect("nothing speaks of it");
    assert!(desk.text().contains("(first: Angle in 1 deg..<90 deg = 30 deg)"), "{}", desk.text());
    assert_eq!(desk.wrong(), []);
}

#[test]
fn what_is_refused_keeps_what_can_be_done_again() {
    let mut desk = flange();
    define(&mut desk, "spare", "3");
    desk.undo();
    let text = NewParameter { name: "hole".into(), ..anew("d", ("", "", "true"), "") };
    let before = desk.text();
    assert!(desk.session.define_parameter(desk.id, &text).is_err());
    assert_eq!(desk.text(), before);
    desk.redo();
    assert!(desk.text().contains("spare: Length = 3"), "{}", desk.text());
}

#[test]
fn a_parameter_said_anew_keeps_what_is_the_same() {
    let text = "program G(
    by x: Length = 30, // as drawn
    note: Text = \"a, b\" \"Say \\\"big\\\"\",
) {
    point = Point(x, 0)
}
g: G
";
    let mut desk = recorded("G", text);
    let rows = desk.session.steps(desk.id, None).expect("it is recorded").parameters;
    assert_eq!(rows[1].prompt, "Say \"big\"");
    let note = anew("note", ("Text", "", "\"a, c\""), "Say \"small\"");
    desk.session.define_parameter(desk.id, &note).expect("a text");
    let x = anew("x", ("Length", "1..50", "40"), "");
    desk.session.define_parameter(desk.id, &x).expect("a length");
    for wanted in [
        "    by x: Length in 1..50 = 40, // as drawn\n",
        "    note: Text = \"a, c\" \"Say \\\"small\\\"\",\n",
    ] {
        assert!(desk.text().contains(wanted), "{}", desk.text());
    }
}

#[test]
fn a_range_may_leave_its_end_out() {
    let mut desk = Desk::of(
        "use geometry
unit mm
program Hole(holes: Integer in 1..<10 = 3) {
    circle = Circle(center: Point(0, 0), radius: holes * 1 mm)
}
",
    );
    let prompt = desk.session.begin(desk.id, "Hole").expect("it is a tool");
    assert!(prompt.words.contains(", 1 to less than 10;"), "{}", prompt.words);
    let refused = desk.session.enter(desk.id, "10").expect_err("it is the end");
    assert_eq!(refused.message, "holes is 10: 1 to less than 10 are allowed");
    enter(&mut desk, "9");
}

#[test]
fn a_parameter_that_is_deleted_takes_its_values_and_no_comments() {
    let text = "program G(
    // the sizes
    m: Length = 3, k: Length = 2,
) {
    point = Point(k, 0)
}
g: G { // as built
    m = 4
    // end
}
h: G {
    /// the small one
    m = 5
}
";
    let mut desk = recorded("G", text);
    let change = desk.session.remove_parameter(desk.id, "m").expect("no step speaks of it");
    assert_eq!(change.along, ["g.m = 4", "h.m = 5"]);
    let text = desk.text();
    assert!(text.contains("    // the sizes\n    k: Length = 2,\n"), "{text}");
    assert!(text.ends_with("g: G { // as built\n    // end\n}\nh: G\n"), "{text}");
    assert_eq!(desk.wrong(), [], "{text}");
}

#[test]
fn a_loop_that_is_open_in_another_program_stays_a_warning() {
    let mut desk = Desk::of(
        "use geometry
unit mm
program Other() {
    turns = repeat {
        circle = Circle(center: Point(0, 0), radius: 3)
    }
}
",
    );
    desk.session.record(desk.id, "Mine").expect("a new program");
    desk.session.begin_loop(desk.id, "").expect("it is recorded");
    let all = desk.session.text(desk.id).diagnostics;
    let said: Vec<_> = all.iter().filter(|d| d.code == "open-block").collect();
    let said: Vec<_> = said.iter().map(|d| d.severity.as_str()).collect();
    assert_eq!(said, ["warning", "recording"]);
}

#[test]
fn a_parameter_allows_the_values_of_a_table() {
    let mut desk = Desk::of("use geometry\nunit mm\n");
    desk.session.record(desk.id, "Rod").expect("a new program");
    let new = NewParameter {
        name: "d".into(),
        example: "4".into(),
        range: "3, 4, 5 mm".into(),
        ..NewParameter::default()
    };
    desk.session.define_parameter(desk.id, &new).expect("it is new");
    assert!(desk.text().contains("d: Length in [3 mm, 4 mm, 5 mm] = 4"), "{}", desk.text());
    desk.session.begin(desk.id, "Circle").expect("there are circles");
    desk.session.enter(desk.id, "0, 0").expect("a place");
    desk.session.enter(desk.id, "d / 2").expect("a radius");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    let row = desk.session.steps(desk.id, None).expect("it is recorded").parameters.remove(0);
    assert_eq!(row.choices, ["3 mm", "4 mm", "5 mm"]);
    desk.set("rod.d", 5.0).expect("it is one of them");
    let refused = desk.set("rod.d", 4.5).expect_err("it is none of them");
    assert!(
        refused.message.ends_with("d has to be one of 3 mm, 4 mm, 5 mm"),
        "{}",
        refused.message
    );
    desk.session.stop_recording(desk.id).expect("it is recorded");
    // who applies it is asked for one of them
    desk.session.begin(desk.id, "Rod").expect("it is in scope");
    let refused = desk.session.enter(desk.id, "4.5 mm").expect_err("it is none of them");
    assert_eq!(refused.message, "d is 4.5 mm: 3 mm, 4 mm or 5 mm are allowed");
    let summed = NewParameter { name: "s".into(), range: "3, 4, 5 + 1".into(), ..new.clone() };
    desk.session.record(desk.id, "Sum").expect("a new program");
    desk.session.define_parameter(desk.id, &summed).expect("it is new");
    assert!(desk.text().contains("s: Length in [3, 4, 5 + 1] = 4"), "{}", desk.text());
    desk.session.stop_recording(desk.id).expect("it is recorded");
    let strange = NewParameter { name: "w".into(), range: "3 to 5".into(), ..new };
    desk.session.record(desk.id, "Rod").expect("it is there");
    let refused = desk.session.define_parameter(desk.id, &strange).expect_err("it is no table");
    assert!(refused.message.contains("no range and no table"), "{}", refused.message);
}

#[test]
fn what_is_allowed_of_a_length_has_the_unit_that_the_sheet_takes_over() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.record(desk.id, "Bolt").expect("it is begun");
    for (range, is_within) in [("5..10", true), ("6, 8, 10", true), ("10..20", false)] {
        let (class, value, _, wrong) = read(&mut desk, ["d", "8 mm", "", range]);
        assert_eq!((class.as_str(), value.as_str()), ("Length", "8 mm"));
        assert_eq!(wrong.is_empty(), is_within, "{range}: {wrong:?}");
    }
}

/// What is understood of a parameter that is typed: class, value, what is allowed; and what is wrong.
fn read(desk: &mut Desk, fields: [&str; 4]) -> (String, String, String, Vec<String>) {
    let [name, example, class, range] = fields.map(String::from);
    let new = NewParameter { name, example, class, range, ..NewParameter::default() };
    let reading = desk.session.read_parameter(desk.id, &new);
    let wrong = reading.wrong.iter().map(|(field, why)| format!("{field:?}: {why}")).collect();
    (reading.class, reading.value, reading.allowed.unwrap_or_default(), wrong)
}

#[test]
fn what_is_typed_of_a_parameter_is_understood_before_it_is_defined() {
    let mut desk = flange();
    let none = Vec::<String>::new;
    for (fields, class, value, allowed) in [
        (["inner", "84", "", ""], "Length", "84 mm", ""),
        (["inner", "30 deg", "", ""], "Angle", "30 deg", ""),
        (["inner", "30", "Angle", "10..40"], "Angle", "30 deg", "10 to 40"),
        (["inner", "yes", "", ""], "Bool", "yes", ""),
        (["inner", "3,4", "", ""], "Point", "3,4", ""),
        (["inner", "6", "Integer", "4, 6"], "Integer", "6", "4 or 6"),
        (["inner", "8.4 mm", "", "1 mm..100 mm"], "Length", "8.4 mm", "1 mm to 100 mm"),
        (["", "", "", ""], "", "", ""),
    ] {
        let understood = (class.to_string(), value.to_string(), allowed.to_string(), none());
        assert_eq!(read(&mut desk, fields), understood, "{fields:?}");
    }
}

#[test]
fn what_is_wrong_of_a_parameter_is_said_of_its_field() {
    let mut desk = flange();
    for (fields, wrong) in [
        (["3x", "84", "", ""], "Name: `3x` is no name"),
        (["round", "84", "", ""], "Name: Flange has round already"),
        (["circle", "84", "", ""], "Name: Flange has circle already"),
        (["inner", "8 4", "", ""], "Example: "),
        (["inner", "2.5", "Integer", ""], "Example: a count is wanted"),
        (["inner", "7", "Bool", ""], "Example: yes or no is wanted"),
        (["inner", "84", "", "many"], "Allowed: no range and no table"),
        (["inner", "84", "", "1 mm..9 mm"], "Allowed: the example, 84 mm, is not among these"),
    ] {
        let (.., all) = read(&mut desk, fields);
        assert!(all.iter().any(|said| said.starts_with(wrong)), "{fields:?}: {all:?}");
    }
}

#[test]
fn words_that_were_to_be_a_text_are_told_how_it_is_written() {
    let mut desk = flange();
    let mut new =
        NewParameter { name: "drawn".into(), example: "Anna".into(), ..NewParameter::default() };
    let wrong = desk.session.define_parameter(desk.id, &new).expect_err("it names nothing");
    assert_eq!(
        wrong.message,
        "Anna: there is nothing called Anna here; a text stands in quotes: \"Anna\""
    );
    new.class = "Text".into();
    desk.session.define_parameter(desk.id, &new).expect("it is said to be a text");
    assert!(desk.text().contains("drawn: Text = \"Anna\""), "{}", desk.text());
    // nothing of it is read as a place, a truth or a value
    for (name, words, text) in [
        ("both", "Anna, Bob", "Anna, Bob"),
        ("kind", "yes", "yes"),
        ("bolt", "M{6} \"short\"", "M{{6}} \\\"short\\\""),
    ] {
        let new = NewParameter { name: name.into(), example: words.into(), ..new.clone() };
        desk.session.define_parameter(desk.id, &new).expect("it is said to be a text");
        let line = format!("{name}: Text = \"{text}\"");
        assert!(desk.text().contains(&line), "{line}: {}", desk.text());
    }
    assert_eq!(desk.wrong(), []);
}

#[test]
fn a_count_in_the_quotient_of_a_length_becomes_one() {
    let mut desk = Desk::recording("Bracket", &[("w", "80"), ("holes", "4")]);
    let mut given = |tool: &str, operands: &[&str]| {
        desk.session.begin(desk.id, tool).expect("it is in scope");
        let mut said = Vec::new();
        for typed in operands {
            said.push(match desk.session.enter(desk.id, typed) {
                Ok(Turn::Made { name, text, .. }) => format!("{name} {text}"),
                Ok(Turn::Wants(prompt)) => prompt.words,
                Err(refusal) => refusal.message,
            });
        }
        said
    };
    let said = given("Circle", &["w / (holes + 1), 20", "3"]);
    assert_eq!(said[0], "holes is a count ");
    assert_eq!(said[1], "circle Circle(center: Point(w / (holes + 1), 20), radius: 3)");
    // an area is no length by either
    let mut desk = Desk::recording("Bracket", &[("a", "3"), ("b", "4")]);
    desk.session.begin(desk.id, "Circle").expect("it is in scope");
    desk.session.enter(desk.id, "0,0").expect("a place");
    let refused = desk.session.enter(desk.id, "a * b").expect_err("an area is no radius");
    assert_eq!(refused.message, "either a or b is a count: define which");
    assert!(desk.text().contains("    a: Length = 3,\n    b: Length = 4,\n"), "{}", desk.text());
}

#[test]
fn a_decimal_comma_that_made_a_place_is_said_anew_as_a_number() {
    let mut desk = Desk::recording("Washer", &[("inner", "8,4")]);
    assert!(desk.text().contains("inner: Point = Point(8, 4)"), "{}", desk.text());
    let new = NewParameter {
        name: "inner".into(),
        class: "Point".into(),
        example: "8.4".into(),
        instead_of: "inner".into(),
        ..NewParameter::default()
    };
    desk.session.define_parameter(desk.id, &new).expect("nothing speaks of it");
    assert!(desk.text().contains("inner: Length = 8.4"), "{}", desk.text());
}

#[test]
fn a_range_that_is_open_at_an_end_is_typed_asked_about_and_kept() {
    let mut desk = Desk::of("use geometry\nunit mm\n");
    desk.session.record(desk.id, "Hole").expect("a new program");
    for (name, example, range, written) in [
        ("d", "8", "> 0", "d: Length in > 0 = 8"),
        ("least", "2", "0.5..", "least: Length in 0.5.. = 2"),
        ("most", "9", "<= 100 mm", "most: Length in ..100 mm = 9"),
        ("below", "9", "< 100", "below: Length in < 100 = 9"),
        ("holes", "3", ">= 1", "holes: Integer in 1.. = 3"),
    ] {
        let new = NewParameter {
            name: name.into(),
            class: if name == "holes" { "Integer".into() } else { "Length".into() },
            example: example.into(),
            range: range.into(),
            ..NewParameter::default()
        };
        desk.session.define_parameter(desk.id, &new).expect("it is new");
        assert!(desk.text().contains(written), "{written}\n{}", desk.text());
    }
    desk.session.stop_recording(desk.id).expect("it is recorded");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    let text = "use geometry\nunit mm\nprogram Hole(d: Length in > 0 mm = 8 mm \"How wide?\") {\n    circle = Circle(center: (0, 0), radius: d / 2)\n}\nh: Hole\n";
    let mut desk = Desk::of(text);
    let prompt = desk.session.begin(desk.id, "Hole").expect("it is a tool");
    assert!(prompt.words.contains("more than 0 mm"), "{}", prompt.words);
    let refused = desk.session.enter(desk.id, "0").expect_err("it is the end");
    assert!(refused.message.contains("more than 0 mm are allowed"), "{}", refused.message);
    desk.session.give_up(desk.id);
    desk.set("h.d", 0.0).expect_err("it is not allowed");
    desk.set("h.d", 0.5).expect("it is allowed");
}
