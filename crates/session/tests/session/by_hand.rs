//! What hands ask of a document that they work on, and what is inserted as it is drawn.

use crate::desk::{Desk, at};
use kernel::Path;
use session::Command;
use session::view::Pointer;

const CONVERTER: &str = "\
use calculator
times: Times { operand1.at = (0, 0)  operand2.at = (0, 100)  result.at = (100, 50) }
factor: Constant { node.at = (0, 100) }
merge times.operand2 = factor.node
";

fn place(desk: &mut Desk, class: &str, places: &[(f64, f64)]) {
    desk.session.take_tool(desk.id, class).expect("there is such a tool");
    let mut made = None;
    for &at in places {
        let pointer = Pointer { at, reach: 5.0, ..Pointer::default() };
        desk.session.tool_moved(desk.id, &pointer);
        made = desk.session.tool_set(desk.id, &pointer).expect("it can be there").command;
    }
    desk.apply(&made.expect("the last place makes it")).expect("it can be made");
    desk.session.drop_tool(desk.id);
}

#[test]
fn of_a_part_of_a_circuit_is_locked_what_it_is_given() {
    let desk =
        Desk::of("use circuits\nr: Resistor\nn: Node\nuse geometry\nl: Line\nmerge r.a.node = n\n");
    let meant = |path: &str| {
        let paths = desk.session.to_lock(desk.id, &at(path)).into_iter();
        paths.map(|path| path.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(meant("r"), ["r.resistance"]);
    // of what is where it lies, and of what is given nothing, all
    assert_eq!((meant("l"), meant("n")), (vec!["l".to_string()], vec!["n".to_string()]));
    assert_eq!(meant("l.p1"), ["l.p1"]);
}

#[test]
fn a_constant_shows_the_number_that_it_shares_with_its_node() {
    let mut desk = Desk::of(CONVERTER);
    let within = desk.session.values_within(desk.id, &at("factor"));
    let found: Vec<(&str, &str)> =
        within.iter().map(|w| (w.path.as_str(), w.row.as_str())).collect();
    assert_eq!(found[0], ("node.number", "times.operand2.number"));
    let shown = desk.session.value_shown(desk.id, &at("factor"), Some("0"));
    assert_eq!(shown.as_deref(), Some("times.operand2.number"));
    desk.type_in("times.operand2.number", "1.8").expect("it is a number");
    let shown = desk.session.value_shown(desk.id, &at("factor"), Some("1.8"));
    assert_eq!(shown.as_deref(), Some("times.operand2.number"));
}

#[test]
fn a_word_in_the_picture_is_the_number_of_its_unit() {
    let desk = Desk::of(
        "use circuits\nbattery: Battery\nground: Ground\nmeter: Voltmeter\n\
         merge battery.a.node = meter.a.node\nmerge battery.b.node = meter.b.node = ground.lead.node\n",
    );
    let shown = |path: &str, word: &str| desk.session.value_shown(desk.id, &at(path), Some(word));
    assert_eq!(shown("meter", "1.5 V").as_deref(), Some("meter.drop"));
    assert_eq!(shown("battery", "1.5 V").as_deref(), Some("battery.emf"));
    let alone = desk.session.value_shown(desk.id, &at("battery"), None);
    assert_eq!(alone.as_deref(), Some("battery.emf"));
}

#[test]
fn what_its_class_anchors_is_placed_by_hand_too() {
    let mut desk = Desk::of("use bridges\n");
    place(&mut desk, "FixedJoint", &[(30.0, 40.0)]);
    assert!(desk.text().contains("fixedJoint: FixedJoint { at = (30, 40) }"), "{}", desk.text());
}

#[test]
fn a_beam_that_is_drawn_between_free_joints_pulls_at_neither() {
    let mut desk = Desk::of("use bridges\n");
    place(&mut desk, "FreeJoint", &[(0.0, 0.0)]);
    place(&mut desk, "FreeJoint", &[(200.0, 0.0)]);
    place(&mut desk, "Beam", &[(0.0, 0.0), (200.0, 0.0)]);
    let number = |path: &str| {
        let rows = desk.session.values(desk.id);
        rows.iter().find(|row| row.path == path).and_then(|row| row.number)
    };
    assert_eq!(number("beam.rest"), Some(200.0), "{}", desk.text());
    assert_eq!(number("beam.tension"), Some(0.0));
    assert_eq!(number("freeJoint2.at.x"), Some(200.0));
}

#[test]
fn an_empty_document_counts_y_as_the_library_that_it_uses() {
    let mut desk = Desk::of("use geometry\n");
    let using = desk.session.using(desk.id, "circuits");
    desk.apply(&using).expect("there is such a library");
    assert_eq!(desk.text(), "use geometry\nuse circuits\ny down\n");
    let mut drawn = Desk::of("use geometry\np: Point = (1, 2)\n");
    let using = drawn.session.using(drawn.id, "circuits");
    drawn.apply(&using).expect("there is such a library");
    assert!(!drawn.text().contains("y down"), "{}", drawn.text());
}

#[test]
fn places_that_a_constraint_moves_are_written_where_they_are() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 10) }\nb: Line { p1 = (0, 50)  p2 = (90, 80) }\n",
    );
    let paths = [at("a"), at("b")];
    let offers = desk.session.offers(desk.id, &paths);
    let offer = offers.iter().find(|offer| offer.label == "equal length").expect("it is offered");
    desk.apply(&offer.command(None)).expect("it can be said");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert!(desk.session.status(desk.id).satisfied);
}

#[test]
fn what_is_joined_by_hand_is_given_once() {
    let mut desk = Desk::of("use circuits\n");
    place(&mut desk, "Battery", &[(0.0, 0.0), (0.0, 100.0)]);
    place(&mut desk, "Resistor", &[(0.0, 0.0), (90.0, 0.0)]);
    place(&mut desk, "Wire", &[(90.0, 0.0), (0.0, 100.0)]);
    let text = desk.text();
    assert!(text.contains("resistor: Resistor { b.node.at = (90, 0) }"), "{text}");
    assert!(text.contains("wire: Wire\n"), "{text}");
    desk.move_to("battery.a.node.at", 10.0, 5.0).expect("it is free");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn what_contradicts_is_asked_about_with_ways_out_that_hold() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nconstraint a.length = 100\n",
    );
    let offers = desk.session.offers(desk.id, &[at("a.p1"), at("a.p2")]);
    let offer = offers.iter().find(|offer| offer.label == "distance").expect("it is offered");
    assert_eq!(desk.session.over_constrained(desk.id, &offer.command(Some("100"))), None);
    let asked = desk.session.over_constrained(desk.id, &offer.command(Some("120")));
    let asked = asked.expect("both cannot hold");
    let labels: Vec<&str> = asked.choices.iter().map(|c| c.label.as_str()).collect();
    assert_eq!(
        labels,
        [
            "reference dimension: it only reads",
            "instead of “length of a = 100”",
            "keep it switched off",
            "keep it as a conflict",
        ]
    );
    let before = desk.text();
    for (n, wanted) in [(0, 100.0), (1, 120.0), (2, 100.0)] {
        desk.apply(&asked.choices[n].command).expect("it was tried");
        assert!(desk.session.status(desk.id).satisfied, "{}", desk.text());
        assert!((desk.number("a.length") - wanted).abs() < 1e-9, "{}", desk.text());
        desk.apply(&Command::Undo).expect("a step");
        assert_eq!(desk.text(), before);
    }
    let reference = &asked.choices[0].command;
    desk.apply(reference).expect("it was tried");
    assert!((desk.number("referenceDistance.reading") - 100.0).abs() < 1e-9);
}

#[test]
fn a_length_too_much_offered_to_break_an_arc_and_not_the_other_length() {
    let asked = |text: &str, members: &str| {
        let desk = Desk::of(text);
        let command = Command::Edit { target: Path::default(), members: members.into() };
        let asked = desk.session.over_constrained(desk.id, &command).expect("it cannot hold");
        asked.choices.into_iter().map(|choice| choice.label).collect::<Vec<_>>()
    };
    // four sides of a box: what is level or upright is not what a person wants to go
    let sides = "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nb: Line { p2 = (100, 50) }\n\
                 c: Line { p2 = (0, 50) }\nd: Line\nmerge a.p2 = b.p1\nmerge b.p2 = c.p1\n\
                 merge c.p2 = d.p1\nmerge d.p2 = a.p1\nconstraint a.p1.y = a.p2.y\n\
                 constraint b.p1.x = b.p2.x\nconstraint c.p1.y = c.p2.y\nconstraint d.p1.x = d.p2.x\n\
                 constraint a.length = 2 * 50\n";
    let labels = asked(sides, "constraint c.length = 120");
    assert!(labels[1].contains("length of a"), "{labels:?}");
    // the law of a class goes only where nothing else would do
    let arc = "use geometry\nc: Arc { center = (0, 0)  start = (40, 0)  end = (0, 40) }\n\
               constraint c.radius = 40\n";
    let labels = asked(arc, "constraint c.center.distance(to: c.end) = 50");
    assert!(labels[1].contains("radius of c = 40"), "{labels:?}");
    assert!(labels.iter().all(|label| !label.contains("round")), "{labels:?}");
}

#[test]
fn a_dimension_beside_a_contradiction_is_asked_of_only_where_it_is_one_more() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nb: Line { p1 = (0, 50)  p2 = (30, 90) }\n\
         constraint a.length = 100\nconstraint a.length = 150\n",
    );
    let dimension = |desk: &Desk, line: &str, value: &str| {
        let offers = desk.session.offers(desk.id, &[at(line)]);
        let offer = offers.iter().find(|offer| offer.label.starts_with("length")).expect("offered");
        offer.command(Some(value))
    };
    let apart = dimension(&desk, "b", "60");
    assert_eq!(desk.session.over_constrained(desk.id, &apart), None);
    let third = dimension(&desk, "a", "120");
    let asked = desk.session.over_constrained(desk.id, &third).expect("it breaks one more");
    let labels: Vec<&str> = asked.choices.iter().map(|c| c.label.as_str()).collect();
    assert!(labels.starts_with(&["reference dimension: it only reads"]), "{labels:?}");
    assert!(labels.ends_with(&["keep it switched off", "keep it as a conflict"]), "{labels:?}");
    desk.apply(&asked.choices[0].command).expect("it was tried");
    let reading = desk.number("referenceDistance.reading");
    assert!((reading - desk.number("a.length")).abs() < 1e-9, "{}", desk.text());
    desk.apply(&apart).expect("nothing is against it");
    assert!((desk.number("b.length") - 60.0).abs() < 1e-9, "{}", desk.text());
    // what is offered instead of others leaves no more broken than was, and says what was typed
    for choice in asked.choices.iter().filter(|choice| choice.label.starts_with("instead of")) {
        desk.apply(&choice.command).expect("it was tried");
        assert!((desk.number("a.length") - 120.0).abs() < 1e-9, "{}", desk.text());
        desk.apply(&Command::Undo).expect("a step");
    }
}

#[test]
fn a_coordinate_of_an_anchored_place_is_typed() {
    let mut desk = Desk::of("use bridges\nj: FixedJoint { at = (3, 4) }\n");
    desk.type_in("j.at.x", "160").expect("the place as a whole may be set");
    assert_eq!(desk.text(), "use bridges\nj: FixedJoint { at = (160, 4) }\n");
}

#[test]
fn a_text_is_offered_no_length() {
    let desk = Desk::of("t: Text = \"abc\"\n");
    let offers = desk.session.offers(desk.id, &[at("t")]);
    assert!(offers.iter().all(|offer| offer.label != "length"), "{offers:?}");
}

#[test]
fn what_is_said_of_one_things_parts_may_be_meant_of_its_class() {
    let mut desk = Desk::of(
        "use geometry\nclass Pair {\n    a: Line { p2 = (9, 1) }\n    b: Line { p1 = (0, 5)  p2 = (8, 9) }\n}\none: Pair\ntwo: Pair\n",
    );
    let offers = desk.session.offers(desk.id, &[at("one.a"), at("one.b")]);
    let offer = offers.iter().find(|offer| offer.label == "parallel").expect("it is offered");
    let asked = desk.session.over_constrained(desk.id, &offer.command(None)).expect("it is asked");
    let labels: Vec<&str> = asked.choices.iter().map(|c| c.label.as_str()).collect();
    assert_eq!(labels, ["only one", "every Pair"]);
    assert_eq!(desk.session.status(desk.id).freedom, 16);
    desk.apply(&asked.choices[1].command).expect("it can be said");
    assert_eq!(desk.session.status(desk.id).freedom, 14, "{}", desk.text());
    assert!(desk.text().contains("    constraint a.parallel(to: b)\n}"), "{}", desk.text());
}

#[test]
fn a_number_of_the_document_is_typed_with_or_without_its_name() {
    let mut desk = Desk::of("use geometry\na: Line\n");
    for (typed, said) in [
        ("turn = 30 deg", "turn: Angle = 30 deg"),
        ("2 * 40 mm", "b: Length = 2 * 40 mm"),
        ("k = 0.5", "k: Real = 0.5"),
    ] {
        let (command, name) = desk.session.number_typed(desk.id, typed).expect("it is a number");
        assert!(said.starts_with(&format!("{name}:")), "{name}");
        desk.apply(&command).expect("it can be said");
        assert!(desk.text().contains(said), "{}", desk.text());
    }
    assert_eq!(desk.wrong(), []);
    let why = |typed: &str| desk.session.number_typed(desk.id, typed).map_err(|r| r.message);
    assert_eq!(why("a = 3").map(drop), Err("there is a a already".into()));
    assert_eq!(
        why("K = 3").map(drop),
        Err("K: a number's name is one word with a small first letter".into())
    );
    assert!(why("c = nonsense").is_err() && why("c =").is_err());
}

#[test]
fn an_edited_class_leaves_no_warnings_at_things_put_by_hand() {
    let mut desk = Desk::of(
        "use geometry\nclass Pair {\n    a: Line { p2 = (9, 1) }\n    b: Line { p1 = (0, 5)  p2 = (8, 9) }\n}\n\
         one: Pair { a.p1 = (100, 100)  a.p2 = (150, 100)  b.p1 = (100, 120)  b.p2 = (160, 190) }\n",
    );
    let members = String::from("constraint a.parallel(to: b)");
    desk.apply(&Command::Edit { target: at("Pair"), members }).expect("it can be said");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    let status = desk.session.status(desk.id);
    assert!(status.satisfied && !status.message.contains("gave way"), "{}", status.message);
}

#[test]
fn a_slider_comes_to_short_numbers() {
    let mut desk = Desk::of("use geometry\nturn: Angle = 30 deg\nl: Length = 120\n");
    let wished = 257.4_f64.to_radians();
    let angle = desk.session.at_step(desk.id, &at("turn"), wished, 1.8_f64.to_radians());
    desk.set("turn", angle.expect("it is a number")).expect("it is free");
    assert!(desk.text().contains("turn: Angle = 257 deg\n"), "{}", desk.text());
    assert_eq!(desk.session.at_step(desk.id, &at("l"), 76.800_000_01, 1.2), Some(77.0));
    assert_eq!(desk.session.at_step(desk.id, &at("l"), 0.034_567, 0.001), Some(0.035));
    assert_eq!(desk.session.at_step(desk.id, &at("nothing"), 1.0, 0.1), None);
}

#[test]
fn several_parts_are_locked_and_let_go_in_one_step_each() {
    let mut desk = Desk::of(
        "use geometry\nline: Line { p1 = (0, 0)  p2 = (30, 40) }\nline2: Line { p1 = (90, 0)  p2 = (60, 40) }\n",
    );
    let grounds = ["line.p1", "line2.p1"].map(at);
    let before = desk.moment();
    let change = desk.session.hold(desk.id, &grounds, true).expect("they are free");
    assert_eq!(change.label, "lock line.p1, line2.p1");
    let locked = |desk: &Desk| ["line.p1.x", "line2.p1.y"].map(|path| desk.row(path).anchored);
    assert_eq!(locked(&desk), [true, true]);
    desk.undo();
    assert_eq!(desk.moment(), before);
    desk.redo();
    desk.session.hold(desk.id, &grounds, false).expect("they are locked");
    assert_eq!(locked(&desk), [false, false]);
    // what cannot be locked leaves the others as they are
    let before = desk.moment();
    let refused = desk.session.hold(desk.id, &[at("line.p1"), at("line.nothing")], true);
    assert!(refused.is_err());
    assert_eq!(desk.moment(), before);
}

#[test]
fn where_words_stand_is_no_degree_of_freedom_unless_it_is_a_corner() {
    let mut loose =
        Desk::of("use geometry\np: Point = (1, 2)\nc: Caption { at = (5, 6)  words = \"A\" }\n");
    assert_eq!(loose.session.status(loose.id).freedom, 2);
    let mut joined =
        Desk::of("use geometry\np: Point = (1, 2)\nc: Caption { words = \"A\" }\nmerge c.at = p\n");
    assert_eq!(joined.session.status(joined.id).freedom, 2);
}
