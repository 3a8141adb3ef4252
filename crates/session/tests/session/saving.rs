//! Saving: the text after an edit differs from the text before by the fewest numbers.

use crate::desk::{Desk, at, edited, gallery};
use session::Command;

/// Opens a text, does something, and returns the text after it; opening that gives the same values.
fn after(text: &str, act: impl FnOnce(&mut Desk) -> session::view::Change) -> String {
    let mut desk = Desk::of(text);
    let change = act(&mut desk);
    let saved = desk.text();
    assert_eq!(edited(text, &change), saved, "the change's edits give the new text");
    assert_eq!(Desk::of(&saved).bits(), desk.bits(), "opening it again gives the same bits");
    assert_eq!(desk.session.complaints(desk.id), Vec::<String>::new());
    saved
}

#[test]
fn a_document_that_was_only_opened_is_as_it_was() {
    for name in ["quadrilateral", "temperature", "voltage-divider", "bridge", "text-box"] {
        let text = gallery(name);
        let mut desk = Desk::of(&text);
        assert_eq!(desk.text(), text);
        let nothing = desk.session.release(desk.id).expect("nothing was pressed");
        assert_eq!((nothing.edits.len(), desk.undo_label()), (0, None));
    }
}

#[test]
fn an_edit_that_changes_nothing_is_no_step() {
    let text = "a: Real = 1.50 // as it was typed\n";
    let mut desk = Desk::of(text);
    let change = desk.set("a", 1.5).expect("it is so already");
    assert_eq!((change.edits.len(), change.moved.len()), (0, 0));
    assert_eq!((desk.text().as_str(), desk.undo_label()), (text, None));
}

#[test]
fn a_set_number_is_the_only_change() {
    let text = "// two\n  a:   Real =  1   /* one */\nb: Real = 2 // kept\nc: Real\n\n\nconstraint   c = a+b // odd\n";
    let saved = after(text, |d| d.set("a", 10.25).expect("a is free to be set"));
    assert_eq!(saved, text.replace("=  1   /*", "=  10.25   /*"));
}

#[test]
fn a_computed_number_that_is_set_rewrites_what_gave_way() {
    let text = "a: Real = 1 // gives way\nb: Real = 2 // stays\nc: Real\nanchor b\nconstraint sum: c = a + b\n";
    let saved = after(text, |d| d.set("c", 10.0).expect("a can give way"));
    assert_eq!(saved, text.replace("a: Real = 1 ", "a: Real = 8 "));
}

#[test]
fn a_unit_is_kept_as_it_was_written() {
    let text = "r: Resistance =   4.7 kohm   // a usual one\nd: Length = 30\n";
    let saved = after(text, |d| d.set("r", 4800.0).expect("r is free"));
    assert_eq!(saved, text.replace("4.7 kohm", "4.8 kohm"));
}

#[test]
fn a_dragged_place_keeps_its_layout() {
    let text = "use geometry\n\nl: Line {  p1 = ( 0,0 ) /* left */   p2 = (10 ,  5) // right\n}\n";
    let saved = after(text, |d| d.drag("l.p2", &[(11.0, 5.0), (12.5, 5.0)]));
    assert_eq!(saved, text.replace("(10 ,", "(12.5 ,"));
}

#[test]
fn coordinates_written_apart_are_rewritten_apart() {
    let text = "use geometry\np: Point { x = 1 // across\n    y = 2 // up\n}\n";
    let saved = after(text, |d| d.drag("p", &[(1.0, 7.0)]));
    assert_eq!(saved, text.replace("y = 2", "y = 7"));
}

#[test]
fn a_negative_number_may_follow_a_positive_one() {
    let text = "use geometry\np: Point = (1, -2) // there\n";
    let saved = after(text, |d| d.drag("p", &[(-3.0, 4.0)]));
    assert_eq!(saved, "use geometry\np: Point = (-3, 4) // there\n");
}

#[test]
fn what_a_class_gives_of_a_place_is_not_written_again() {
    let text =
        "class Spot { x: Real = 10  y: Real = 5 }\na: Spot\nb: Spot { y = 6 } // the other\n";
    let mut desk = Desk::of(text);
    desk.set("a.x", 30.0).expect("it is free");
    assert_eq!(desk.text(), text.replace("a: Spot", "a: Spot { x = 30 }"));
    desk.set("b.y", 7.0).expect("it is free");
    assert_eq!(
        desk.text(),
        text.replace("a: Spot", "a: Spot { x = 30 }").replace("y = 6", "y = 7")
    );
    // so that the class may have one part more
    let more = Command::Edit { target: at("Spot"), members: "label: Text = \"here\"".into() };
    desk.apply(&more).expect("no value stands for a part by its position");
    assert_eq!((desk.number("a.x"), desk.number("b.y")), (30.0, 7.0));
    // where all of it changes, it is a place
    let saved = after(text, |d| d.type_in("a", "(1, 2)").expect("it is free"));
    assert_eq!(saved, text.replace("a: Spot", "a: Spot = (1, 2)"));
}

#[test]
fn a_class_default_is_overridden_in_the_thing_itself() {
    let text = "class Box { wide: Real = 3 }\na: Box\nb: Box // the other\n";
    let saved = after(text, |d| d.set("b.wide", 5.0).expect("it is free"));
    assert_eq!(saved, "class Box { wide: Real = 3 }\na: Box\nb: Box { wide = 5 } // the other\n");
}

#[test]
fn a_default_of_a_library_is_overridden_in_the_document() {
    let text = "use geometry\nl: Line // from the library\n";
    let saved = after(text, |d| d.drag("l.p1", &[(60.0, 100.0)]));
    assert_eq!(saved, "use geometry\nl: Line { p1 = (60, 100) } // from the library\n");
}

#[test]
fn a_corner_of_the_quadrilateral_is_written_once() {
    let text = gallery("quadrilateral");
    let saved = after(&text, |d| d.drag("q.outer.side3.p1", &[(455.0, 154.0), (465.0, 164.0)]));
    let written = "q: MidpointQuadrilateral { outer.side2.p2 = (465, 164) }";
    assert_eq!(saved, text.replace("q: MidpointQuadrilateral", written));
}

#[test]
fn a_midpoint_writes_the_corner_that_gave_way() {
    let text = gallery("quadrilateral");
    let saved = after(&text, |d| d.drag("q.inner.side3.p1", &[(394.0, 228.0)]));
    let written = "q: MidpointQuadrilateral { outer.side3.p2 = (343, 312) }";
    assert_eq!(saved, text.replace("q: MidpointQuadrilateral", written));
}

#[test]
fn the_mercury_writes_the_temperature() {
    let text = gallery("temperature");
    let saved = after(&text, |d| d.drag("celsius.mercury.p1", &[(174.0, 80.0), (174.0, 78.0)]));
    assert_eq!(saved, text.replacen("node.number = 72.5", "node.number = 82.5", 1));
}

#[test]
fn a_resistor_of_the_divider_is_the_only_change() {
    let text = gallery("voltage-divider");
    let mut desk = Desk::of(&text);
    let rows = desk.session.values(desk.id);
    let resistances: Vec<_> = rows.iter().filter(|r| r.path.ends_with(".resistance")).collect();
    assert_eq!(resistances.len(), 2);
    let path = resistances[1].path.clone();
    desk.type_in(&path, "300 ohm").expect("the resistance is free");
    let saved = desk.text();
    let changed: Vec<_> = text.lines().zip(saved.lines()).filter(|(a, b)| a != b).collect();
    assert_eq!(changed.len(), 1, "{changed:?}");
    assert!(changed[0].1.contains("300 ohm"), "{changed:?}");
    assert_eq!(Desk::of(&saved).bits(), desk.bits());
}

#[test]
fn a_computed_value_that_was_moved_is_given_itself() {
    let text =
        "c: Real\nd: Real\ne: Real\nconstraint twice: d = 2 * c\nconstraint thrice: e = 3 * c\n";
    let saved = after(text, |d| d.set("d", 4.0).expect("c can give way"));
    assert_eq!(saved, text.replace("d: Real", "d: Real = 4"));
}

#[test]
fn a_text_is_written_with_its_quotes() {
    let text = "t: Text = \"one\" // words\n";
    let saved = after(text, |d| d.type_in("t", "say \"two\" \\ three").expect("it is free"));
    assert_eq!(saved, "t: Text = \"say \\\"two\\\" \\\\ three\" // words\n");
}

#[test]
fn a_value_without_a_given_gets_one() {
    let text = "a: Real // nothing yet\n";
    let saved = after(text, |d| d.set("a", 2.0).expect("it is free"));
    assert_eq!(saved, "a: Real = 2 // nothing yet\n");
}

#[test]
fn what_merged_parts_are_worth_stands_under_the_first_path() {
    let text = "use geometry\na: Line { p1 = (0, 0)  p2 = (9, 9) }\nb: Line { p1 = (5, 5)  p2 = (30, 0) }\nmerge a.p2 = b.p1\n";
    let saved = after(text, |d| d.drag("b.p1", &[(8.0, 9.0)]));
    assert_eq!(saved, text.replace("p2 = (9, 9)", "p2 = (8, 9)"));
}

#[test]
fn numbers_survive_to_the_last_bit() {
    let text = "a: Real = 1\n";
    let third = 1.0 / 3.0;
    let saved = after(text, |d| d.set("a", third).expect("it is free"));
    assert_eq!(saved, "a: Real = 0.3333333333333333\n");
    assert_eq!(Desk::of(&saved).number("a").to_bits(), third.to_bits());
}

/// The digits of every number of a text, without leading zeros.
fn digits(text: &str) -> Vec<usize> {
    let numbers = text.split(|c: char| !(c.is_ascii_digit() || c == '.'));
    let digits = |number: &str| number.replace('.', "").trim_start_matches('0').len();
    numbers.map(digits).collect()
}

#[test]
fn what_a_rule_makes_of_a_drag_is_written_as_a_draughtsman_would() {
    let mut desk = Desk::of(
        "use geometry\ncircle: Circle { center = (0, 0)  radius = 150 }\np: Point = (150, 0)\n\
         constraint circle.passes(through: p)\nanchor circle.center\nanchor circle.radius\n",
    );
    desk.drag("p", &[(120.0, 70.0), (100.0, 120.0)]);
    let text = desk.text();
    assert!(digits(&text).into_iter().all(|n| n <= 11), "{text}");
    let (x, y) = (desk.number("p.x"), desk.number("p.y"));
    assert!((base::number::hypot(x, y) - 150.0).abs() < 1e-8, "({x}, {y})");
    assert_eq!(Desk::of(&text).bits(), desk.bits());
    // what somebody says is written as it was said
    desk.set("circle.radius", 1.0 / 3.0).expect("nothing forbids it");
    assert!(desk.text().contains("radius = 0.3333333333333333"), "{}", desk.text());
    assert_eq!(Desk::of(&desk.text()).bits(), desk.bits());
}

#[test]
fn what_a_dimension_makes_of_what_is_drawn_is_written_as_a_draughtsman_would() {
    let mut desk = Desk::of(
        "use geometry\nline: Line { p1 = (-300, -193)  p2 = (-240, -43) }\n\
         line2: Line { p2 = (0, 7) }\nmerge line.p2 = line2.p1\n",
    );
    for members in ["constraint line.length = 160", "constraint line2.length = 250"] {
        let members = String::from(members);
        desk.apply(&Command::Edit { target: session::Path::default(), members })
            .expect("it is free");
    }
    let text = desk.text();
    assert!(digits(&text).into_iter().all(|n| n <= 11), "{text}");
    let ends = ["line.p1.x", "line.p1.y", "line.p2.x", "line.p2.y"].map(|path| desk.number(path));
    let length = base::number::hypot(ends[2] - ends[0], ends[3] - ends[1]);
    assert!((length - 160.0).abs() < 1e-8, "{length}");
    assert_eq!(Desk::of(&text).bits(), desk.bits());
}

#[test]
fn fewer_digits_give_nothing_that_all_digits_do_not() {
    let mut desk = Desk::of(
        "use geometry\ncircle: Circle { center = (0, 0)  radius = 150 }\np: Point = (150, 0)\nq: Point\n\
         constraint circle.passes(through: p)\nanchor circle.center\nanchor circle.radius\n\
         constraint q.x = 100000 * (p.y - 115.233)\nconstraint q.y = 7 * p.x\n",
    );
    let before = desk.moment();
    desk.drag("p", &[(120.0, 70.0), (100.0, 120.0)]);
    // a ten-millionth of p is a hundredth of q
    assert!(desk.text().contains("\nq: Point\n"), "{}", desk.text());
    assert!(digits(&desk.text()).into_iter().any(|n| n > 11), "{}", desk.text());
    let after = desk.moment();
    assert_eq!(Desk::of(&desk.text()).bits(), after.1);
    desk.undo();
    assert_eq!(desk.moment(), before);
    desk.redo();
    assert_eq!(desk.moment(), after);
}

#[test]
fn a_value_typed_in_a_circuit_without_a_ground_gives_no_voltage_that_nothing_decides() {
    let circuit = "use circuits
battery: Battery { emf = 9 V }
upper: Resistor { resistance = 1 kohm }
lower: Resistor { resistance = 2 kohm }
merge upper.a.node = battery.a.node
merge lower.a.node = upper.b.node
merge lower.b.node = battery.b.node
";
    let desk = &mut Desk::of(circuit);
    let types = [
        ("upper.resistance", "2k2", "1 kohm", "2.2 kohm"),
        ("lower.resistance", "3.3 kohm", "= 2 kohm", "= 3.3 kohm"),
        ("battery.emf", "12", "9 V", "12 V"),
    ];
    let mut text = circuit.to_owned();
    for (path, typed, was, is) in types {
        desk.type_in(path, typed).expect("it is free to be set");
        text = text.replace(was, is);
        assert_eq!(desk.text(), text);
    }
    // 12 V over 5.5 kohm
    assert!((desk.number("lower.drop") - 7.2).abs() < 1e-12);
    assert_eq!(Desk::of(&text).bits(), desk.bits(), "opening it again gives the same bits");
    // a voltage that is typed is given
    desk.type_in("battery.b.node.voltage", "0 V").expect("it is free to be set");
    assert!((desk.number("battery.a.node.voltage") - 12.0).abs() < 1e-12);
    assert!(desk.text().contains("b.node.voltage = 0 V"), "{}", desk.text());
}

#[test]
fn a_value_typed_with_a_unit_stands_in_that_unit() {
    let typed = |body: &str, typed: &str| {
        let text = format!("use circuits\nr: Resistor{body}\n");
        let saved = after(&text, |d| d.type_in("r.resistance", typed).expect("it is free"));
        saved.lines().last().expect("it has lines").to_owned()
    };
    assert_eq!(typed("", "2k2"), "r: Resistor { resistance = 2.2 kohm }");
    assert_eq!(
        typed(" { resistance = 470 ohm }", "2.2 kohm"),
        "r: Resistor { resistance = 2.2 kohm }"
    );
    assert_eq!(
        typed(" { resistance = 4.7 kohm }", "4800 ohm"),
        "r: Resistor { resistance = 4800 ohm }"
    );
    assert_eq!(
        typed(" { resistance = 470 ohm }", "2 * 2 kohm"),
        "r: Resistor { resistance = 4000 ohm }"
    );
    // one step
    let text = "use circuits\nr: Resistor\n";
    let desk = &mut Desk::of(text);
    desk.type_in("r.resistance", "2k2").expect("it is free");
    assert_eq!(
        (desk.row("r.resistance").text, desk.row("r.resistance").unit),
        ("2.2".into(), "kohm".into())
    );
    desk.undo();
    assert_eq!(desk.text(), text);
    desk.redo();
    assert!(desk.text().contains("2.2 kohm"));
}

#[test]
fn a_value_set_over_an_expression_of_constants_takes_its_place() {
    let text = "use constants
class Pendulum {
    g: Acceleration = constants.g
    length: Length = 1 m
    period => 2 * pi * sqrt(length / g)
}
here: Pendulum
twice: Acceleration = 2 * constants.g // of two
";
    let desk = &mut Desk::of(text);
    assert!((desk.number("here.period") - 2.006_409).abs() < 1e-6);
    desk.type_in("here.g", "1.62 m/s^2").expect("it is set itself");
    assert!((desk.number("here.period") - 4.936_537).abs() < 1e-6);
    let moon = text.replace("here: Pendulum", "here: Pendulum { g = 1.62 m/s^2 }");
    assert_eq!((desk.text(), desk.undo_label()), (moon.clone(), Some("set here.g".into())));
    desk.set("twice", 3.5).expect("it is set itself");
    assert_eq!(desk.text(), moon.replace("2 * constants.g", "3.5 m/s^2"));
    desk.undo();
    desk.undo();
    assert_eq!(desk.text(), text);
    // no constant yields
    desk.set("here.period", 2.0).expect("the length can be another");
    assert_eq!(desk.number("here.g"), 9.80665);
    // what an anchor holds may be let go: the expression stays
    let text = "w: Real = 3\nanchor w\nsize: Real = 2 * w\n";
    let desk = &mut Desk::of(text);
    assert!(desk.set("size", 10.0).is_err());
    assert_eq!(desk.text(), text);
}
