//! Drawing and inserting by hand: tools, what they catch, what they make.

use crate::desk::{Desk, at, gallery};
use session::Command;
use session::view::{Along, ClassPlan, Pointer, ToolView, TypedLength};

/// A pointer of a mouse on a sheet at 100 %.
fn pointer(x: f64, y: f64) -> Pointer {
    Pointer { at: (x, y), reach: 10.0, ..Pointer::default() }
}

/// Clicks with the tool in the hand; where that makes something, it is made.
fn click(desk: &mut Desk, pointer: &Pointer) -> ToolView {
    desk.session.tool_moved(desk.id, pointer).expect("a tool is in the hand");
    let view = desk.session.tool_set(desk.id, pointer).expect("the place can be set");
    if let Some(command) = &view.command {
        desk.apply(command).expect("what was drawn can be made");
        desk.session.take_tool_again(desk.id);
    }
    view
}

/// What a value is, by any of its paths.
fn shown(desk: &Desk, path: &str) -> String {
    desk.session.shown_value(desk.id, &at(path)).expect("it has a value")
}

fn holds(desk: &Desk) {
    let status = desk.session.standing(desk.id);
    assert!(status.satisfied, "{}", status.message);
    assert_eq!(desk.session.complaints(desk.id), Vec::<String>::new());
    assert_eq!(desk.wrong(), []);
}

#[test]
fn four_clicks_and_the_first_corner_again_make_a_ring_of_four_lines() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.take_tool(desk.id, "Line").expect("geometry has lines");
    for (x, y) in [(174.0, 178.0), (329.0, 26.0), (445.0, 144.0), (323.0, 312.0), (176.0, 181.0)] {
        // the second side stands nearly at a right angle to the first: Shift suppresses that it is caught
        click(&mut desk, &Pointer { alone: x == 445.0, ..pointer(x, y) });
    }
    holds(&desk);
    // four corners, free each
    assert_eq!(desk.session.status(desk.id).freedom, 8);
    assert_eq!(desk.place("line4.p2"), (174.0, 178.0));
    let text = desk.text();
    assert!(text.contains("merge line.p1 = line4.p2"), "{text}");
    // each line is one step
    desk.undo();
    assert_eq!(desk.session.status(desk.id).freedom, 8);
    assert!(!desk.text().contains("line4"), "{}", desk.text());
    // the ring is closed: the tool begins anew
    let begun = desk.session.take_tool(desk.id, "Line").expect("a tool").begun;
    assert!(!begun);
}

#[test]
fn a_bracket_drawn_by_eye_closes_with_an_upright_side() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.take_tool(desk.id, "Line").expect("geometry has lines");
    // before it begins a line shows no way, but where it would begin
    let moved = desk.session.tool_moved(desk.id, &pointer(-300.0, -193.0)).expect("a tool");
    assert_eq!(moved.preview.elements.len(), 1);
    let corners = [(0.0, 0.0), (401.0, -3.0), (398.0, 99.0), (100.0, 102.0), (102.0, 349.0)];
    for (x, y) in corners {
        click(&mut desk, &pointer(x, y));
    }
    // the last corner but one is level with the one before, and right above the first; only the first is a rule
    let seen = desk.session.tool_moved(desk.id, &pointer(2.0, 351.0)).expect("a tool");
    assert_eq!(seen.caught.map(|c| c.word).as_deref(), Some("horizontal"));
    assert_eq!(seen.preview.elements.len(), moved.preview.elements.len() + 2);
    click(&mut desk, &pointer(2.0, 351.0));
    assert_eq!(desk.place("line5.p2"), (0.0, 349.0));
    let closing = desk.session.tool_moved(desk.id, &pointer(1.0, 1.0)).expect("a tool");
    assert_eq!(closing.caught.map(|c| c.word).as_deref(), Some("joins line.p1, vertical"));
    click(&mut desk, &pointer(1.0, 1.0));
    holds(&desk);
    // six corners, each side upright or level
    assert_eq!(desk.session.status(desk.id).freedom, 6);
    // what begins right below a corner says so; with Shift it does not
    let below = desk.session.tool_moved(desk.id, &pointer(399.0, -80.0)).expect("a tool");
    assert!(below.caught.is_some_and(|c| c.word.starts_with("in line with line")));
    let alone = Pointer { alone: true, ..pointer(399.0, -80.0) };
    assert_eq!(desk.session.tool_moved(desk.id, &alone).expect("a tool").caught, None);
    // nor with a corner that is out of view
    let elsewhere = Some([(350.0, -200.0), (500.0, -10.0)]);
    let far = Pointer { seen: elsewhere, ..pointer(399.0, -80.0) };
    assert_eq!(desk.session.tool_moved(desk.id, &far).expect("a tool").caught, None);
}

#[test]
fn a_tool_goes_by_keys_from_corner_to_corner_and_from_middle_to_middle() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nb: Line { p1 = (0, 60)  p2 = (100, 90) }\n",
    );
    desk.session.take_tool(desk.id, "Line").expect("geometry has lines");
    let stop = |desk: &Desk, at: (f64, f64), along| {
        desk.session.tool_stop(desk.id, &pointer(at.0, at.1), along)
    };
    let mut way = vec![(500.0, 500.0)];
    while let Some(next) = stop(&desk, way[way.len() - 1], Along::Next) {
        way.push(next);
    }
    let stops = [(0.0, 0.0), (100.0, 0.0), (0.0, 60.0), (100.0, 90.0), (50.0, 0.0), (50.0, 75.0)];
    assert_eq!(way[1..], stops);
    assert_eq!(stop(&desk, stops[5], Along::Back), Some(stops[4]));
    assert_eq!(stop(&desk, stops[0], Along::Back), None);
    // what the line begins at is no place for its end
    click(&mut desk, &pointer(50.0, 0.0));
    assert_eq!(stop(&desk, stops[3], Along::Next), Some(stops[5]));
    // what is begun may end at any: behind the last comes the first
    assert_eq!(stop(&desk, stops[5], Along::Next), Some(stops[0]));
    assert_eq!(stop(&desk, stops[0], Along::Back), Some(stops[5]));
    click(&mut desk, &pointer(50.0, 75.0));
    holds(&desk);
    // two free lines, and one between their middles
    assert_eq!(desk.session.status(desk.id).freedom, 8);
}

#[test]
fn a_place_that_is_typed_joins_the_point_that_is_there() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.take_tool(desk.id, "Line").expect("geometry has lines");
    for (x, y) in [(0.0, 0.0), (40.0, 0.0), (40.0, 30.0), (0.0, 0.0)] {
        click(&mut desk, &Pointer { is_typed: true, ..pointer(x, y) });
    }
    holds(&desk);
    // a triangle of three corners, free each: nothing is level that was not said so
    assert_eq!(desk.session.status(desk.id).freedom, 6);
    assert!(desk.text().contains("merge line.p1 = line3.p2"), "{}", desk.text());
    // what is near, and not there, is another point
    desk.session.take_tool(desk.id, "Point").expect("geometry has points");
    click(&mut desk, &Pointer { is_typed: true, ..pointer(40.0, 1.0) });
    assert_eq!(desk.session.status(desk.id).freedom, 8);
}

#[test]
fn a_line_drawn_from_middle_to_middle_keeps_to_the_middles() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nb: Line { p1 = (0, 80)  p2 = (100, 120) }\n",
    );
    desk.session.take_tool(desk.id, "Line").expect("a tool");
    let word = desk.session.tool_moved(desk.id, &pointer(52.0, 3.0)).and_then(|v| v.caught);
    assert_eq!(word.map(|caught| caught.word), Some("midpoint of a".into()));
    click(&mut desk, &pointer(52.0, 3.0));
    click(&mut desk, &pointer(49.0, 103.0));
    holds(&desk);
    desk.drag("a.p2", &[(200.0, 40.0)]);
    assert_eq!(desk.place("line.p1"), (100.0, 20.0));
}

#[test]
fn the_centre_of_a_circle_through_three_points_is_caught_before_a_line_that_passes_by() {
    let mut desk = Desk::of(
        "use geometry\na: Point = (0, 0)\nb: Point = (80, 0)\nc: Point = (0, 60)\n\
         round => Circle.through(a, b, c)\nby: Line { p1 = (0, 33)  p2 = (120, 33) }\n",
    );
    desk.session.take_tool(desk.id, "Line").expect("a tool");
    // the middle of the longest side of a right triangle
    let word = desk.session.tool_moved(desk.id, &pointer(41.0, 32.0)).and_then(|v| v.caught);
    assert_eq!(word.map(|caught| caught.word), Some("centre of round".into()));
    click(&mut desk, &pointer(41.0, 32.0));
    click(&mut desk, &pointer(150.0, 90.0));
    holds(&desk);
    assert_eq!(desk.place("line.p1"), (40.0, 30.0));
    desk.drag("b", &[(120.0, 0.0)]);
    assert_eq!(desk.place("line.p1"), (60.0, 30.0));
}

#[test]
fn a_level_line_stays_level_and_shift_draws_it_free() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.take_tool(desk.id, "Line").expect("a tool");
    click(&mut desk, &pointer(0.0, 0.0));
    click(&mut desk, &pointer(90.0, 3.0));
    assert_eq!(desk.place("line.p2"), (90.0, 0.0));
    assert!(desk.text().contains("constraint line.p1.y = line.p2.y"), "{}", desk.text());
    desk.undo();
    desk.session.take_tool(desk.id, "Line").expect("a tool");
    for (x, y) in [(0.0, 0.0), (90.0, 3.0)] {
        click(&mut desk, &Pointer { alone: true, ..pointer(x, y) });
    }
    assert_eq!(desk.place("line.p2"), (90.0, 3.0));
    assert_eq!(desk.session.status(desk.id).freedom, 4);
}

#[test]
fn a_length_that_is_typed_holds() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.take_tool(desk.id, "Line").expect("a tool");
    click(&mut desk, &pointer(0.0, 0.0));
    click(&mut desk, &Pointer { length: Some(50.0.into()), ..pointer(6.0, 8.0) });
    holds(&desk);
    assert_eq!(desk.place("line.p2"), (30.0, 40.0));
    assert_eq!(desk.session.status(desk.id).freedom, 3);
}

#[test]
fn a_length_is_typed_with_its_unit_while_one_draws() {
    assert_eq!(TypedLength::read("12.5"), Some(12.5.into()));
    assert_eq!(
        TypedLength::read("3 cm"),
        Some(TypedLength { number: 3.0, unit: Some("cm".into()) })
    );
    assert_eq!(TypedLength::read("2.5e-1in").map(|length| length.number), Some(0.25));
    assert_eq!([TypedLength::read("3 kg"), TypedLength::read("cm")], [None, None]);
    let drawn = |text: &str, number: f64, unit: &'static str| {
        let mut desk = Desk::of(text);
        desk.session.take_tool(desk.id, "Line").expect("a tool");
        click(&mut desk, &pointer(0.0, 0.0));
        let length = Some(TypedLength { number, unit: Some(unit.into()) });
        click(&mut desk, &Pointer { length, ..pointer(6.0, 8.0) });
        holds(&desk);
        (desk.place("line.p2"), desk.session.text(desk.id).source)
    };
    let (place, text) = drawn("use geometry\nunit mm\n", 5.0, "cm");
    assert_eq!(place, (30.0, 40.0));
    assert!(text.contains("line.length = 5 cm"), "{text}");
    // a sheet without a unit takes over the one that is typed
    let (place, text) = drawn("use geometry\n", 50.0, "mm");
    assert_eq!(place, (30.0, 40.0));
    assert!(text.contains("unit mm\n") && text.contains("line.length = 50 mm"), "{text}");
}

#[test]
fn a_circle_is_set_by_its_centre_and_a_point_that_it_passes_through() {
    let mut desk = Desk::of("use geometry\np: Point = (30, 40)\n");
    desk.session.take_tool(desk.id, "Circle").expect("a tool");
    click(&mut desk, &pointer(0.0, 0.0));
    click(&mut desk, &pointer(31.0, 41.0));
    holds(&desk);
    assert_eq!(desk.number("circle.radius"), 50.0);
    // two places, one of which the radius holds
    assert_eq!(desk.session.status(desk.id).freedom, 3);
}

#[test]
fn an_arc_and_a_box_are_drawn_place_by_place() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.take_tool(desk.id, "Arc").expect("a tool");
    for (x, y) in [(0.0, 0.0), (60.0, 0.0), (0.0, 60.0)] {
        click(&mut desk, &pointer(x, y));
    }
    holds(&desk);
    assert_eq!(desk.place("arc.start"), (60.0, 0.0));
    desk.session.take_tool(desk.id, "Rectangle").expect("a tool");
    click(&mut desk, &pointer(100.0, 100.0));
    click(&mut desk, &pointer(180.0, 130.0));
    holds(&desk);
    assert_eq!((desk.number("rectangle.width"), desk.number("rectangle.height")), (80.0, 30.0));
}

#[test]
fn an_arc_runs_the_way_that_the_hand_went_round() {
    let drawn = |way: &[(f64, f64)]| {
        let mut desk = Desk::of("use geometry\n");
        desk.session.take_tool(desk.id, "Arc").expect("a tool");
        for at in [(0.0, 0.0), (60.0, 0.0)] {
            click(&mut desk, &pointer(at.0, at.1));
        }
        for &(x, y) in way {
            desk.session.tool_moved(desk.id, &pointer(x, y)).expect("a tool is in the hand");
        }
        let (x, y) = way[way.len() - 1];
        click(&mut desk, &pointer(x, y));
        holds(&desk);
        let begins = desk.place("arc.start") == (60.0, 0.0);
        assert!(begins || desk.place("arc.end") == (60.0, 0.0), "{}", desk.text());
        let sweep = desk.number("arc.sweep").to_degrees().round();
        let sweep = format!("{}{sweep}", if begins { "" } else { "-" });
        // the next arc begins as any does
        click(&mut desk, &pointer(200.0, 0.0));
        click(&mut desk, &pointer(260.0, 0.0));
        click(&mut desk, &pointer(200.0, 60.0));
        assert_eq!(desk.number("arc2.sweep").to_degrees().round(), 90.0);
        sweep
    };
    assert_eq!(drawn(&[(40.0, 45.0), (0.0, 60.0), (-60.0, 0.0)]), "180");
    assert_eq!(drawn(&[(40.0, -45.0), (0.0, -60.0), (-60.0, 0.0)]), "-180");
    assert_eq!(drawn(&[(0.0, -60.0), (-60.0, 0.0), (0.0, 60.0)]), "-270");
    // first the one way, then back over the start and the other way
    assert_eq!(drawn(&[(45.0, -40.0), (45.0, 40.0), (0.0, 60.0)]), "90");
    // what jumps to the other side has gone no way
    assert_eq!(drawn(&[(-60.0, -1.0)]), "181");
}

#[test]
fn a_point_on_an_existing_point_is_no_second_one() {
    let mut desk = Desk::of("use geometry\np: Point = (30, 40)\n");
    desk.session.take_tool(desk.id, "Point").expect("a tool");
    let (session, id) = (&mut desk.session, desk.id);
    session.tool_moved(id, &pointer(31.0, 41.0)).expect("a tool is in the hand");
    let refused = session.tool_set(id, &pointer(31.0, 41.0)).expect_err("there is one");
    assert_eq!(refused.message, "p is here already: hold Shift for another point");
    // beside it, or where it is wanted nevertheless, there is room
    click(&mut desk, &pointer(60.0, 80.0));
    click(&mut desk, &Pointer { alone: true, ..pointer(31.0, 41.0) });
    assert_eq!(desk.place("point2"), (31.0, 41.0));
}

#[test]
fn parts_of_a_circuit_stick_to_each_other_by_their_nodes() {
    let mut desk = Desk::of("use circuits\ny down\n");
    let part = |desk: &mut Desk, class: &str, a: (f64, f64), b: (f64, f64)| {
        desk.session.take_tool(desk.id, class).expect("circuits has it");
        click(desk, &pointer(a.0, a.1));
        click(desk, &pointer(b.0, b.1));
    };
    part(&mut desk, "Battery", (0.0, 0.0), (0.0, 200.0));
    part(&mut desk, "Resistor", (2.0, 1.0), (200.0, 0.0));
    part(&mut desk, "Resistor", (203.0, 1.0), (200.0, 200.0));
    part(&mut desk, "Wire", (198.0, 203.0), (1.0, 199.0));
    desk.session.take_tool(desk.id, "Ground").expect("circuits has it");
    click(&mut desk, &pointer(0.0, 198.0));
    holds(&desk);
    // 1.5 V over twice 100 ohm
    assert_eq!(shown(&desk, "resistor.current"), "7.5 mA");
    assert_eq!(shown(&desk, "resistor2.a.node.voltage"), "750 mV");
}

#[test]
fn terminals_that_are_joined_become_one_node_and_not_one_place() {
    let mut desk = Desk::of(
        "use circuits\nbattery: Battery { a.node.at = (0, 0)  b.node.at = (0, 100) }\n\
         r: Resistor { a.node.at = (50, 0)  b.node.at = (50, 100) }\nground: Ground\n\
         merge battery.b.node = ground.lead.node\n",
    );
    let join = |desk: &mut Desk, a: &str, b: &str| {
        let command = desk.session.join(desk.id, &[at(a), at(b)]).expect("they are alike");
        desk.apply(&command).expect("they can be joined");
    };
    join(&mut desk, "battery.a.node.at", "r.a.node.at");
    join(&mut desk, "battery.b.node.at", "r.b.node.at");
    assert!(desk.text().contains("battery.a.node = r.a.node"), "{}", desk.text());
    assert_eq!(shown(&desk, "r.current"), "15 mA");
    let again = desk.session.join(desk.id, &[at("battery.a.node.at"), at("r.a.node.at")]);
    let refusal = again.expect_err("they are one");
    assert_eq!(refusal.message, "battery.a.node and r.a.node are one already");
}

#[test]
fn what_is_dropped_on_a_corner_becomes_one_with_it_in_one_step() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nb: Line { p1 = (0, 80)  p2 = (100, 120) }\n",
    );
    let before = desk.moment();
    desk.hold("b.p1", &[(50.0, 50.0), (100.0, 0.0)]);
    assert_eq!(desk.session.joint(desk.id, &at("a.p2")), Some(at("a.p2")));
    desk.drop_on("a.p2").expect("they are alike");
    assert_eq!(desk.session.status(desk.id).freedom, 6);
    assert_eq!(desk.place("b.p1"), (100.0, 0.0));
    assert_eq!(desk.place("a.p2"), (100.0, 0.0));
    holds(&desk);
    desk.undo();
    assert_eq!(desk.moment(), before);
    desk.redo();
    assert_eq!(desk.session.status(desk.id).freedom, 6);
}

#[test]
fn things_inserted_by_the_keyboard_lie_beside_each_other() {
    let mut desk = Desk::of("use circuits\n");
    for class in ["Resistor", "Resistor", "Battery", "Ground", "Voltmeter"] {
        let command = desk.session.insertion(desk.id, class).expect("circuits has it");
        desk.apply(&command).expect("there is room");
    }
    let grips = desk.session.picture(desk.id).grips;
    for (i, a) in grips.iter().enumerate() {
        for b in &grips[i + 1..] {
            assert!((a.x - b.x).abs() + (a.y - b.y).abs() > 20.0, "{} on {}", a.path, b.path);
        }
    }
    let refusal = desk.session.insertion(desk.id, "TwoLead").expect_err("it is abstract");
    assert_eq!(refusal.message, "there is no class TwoLead to make things of");
}

#[test]
fn the_bin_has_every_class_in_use_and_says_where_it_comes_from() {
    let desk = Desk::of("use circuits\nclass Own { p: Point }\n");
    let bin = desk.session.bin(desk.id);
    let of = |class: &str| bin.iter().find(|e| e.class == class).expect("the bin has it");
    assert_eq!(of("Resistor").library, "circuits");
    assert_eq!(of("Line").library, "geometry");
    assert_eq!(of("Own").library, "");
    assert!(!of("Resistor").picture.elements.is_empty());
    assert!(bin.iter().all(|e| e.class != "TwoLead"), "nothing is made of abstract classes");
    let names: Vec<String> = bin.into_iter().map(|entry| entry.class).collect();
    assert_eq!(desk.session.bin_names(desk.id), names);
}

#[test]
fn a_tool_changes_nothing_before_its_last_click() {
    let mut desk = Desk::of(&gallery("quadrilateral"));
    let before = desk.moment();
    desk.session.take_tool(desk.id, "Line").expect("a tool");
    click(&mut desk, &pointer(10.0, 10.0));
    desk.session.tool_moved(desk.id, &pointer(50.0, 90.0));
    assert_eq!(desk.moment(), before);
    desk.session.drop_tool(desk.id);
    assert_eq!(desk.moment(), before);
    assert!(desk.session.tool_moved(desk.id, &pointer(1.0, 1.0)).is_none());
    assert!(desk.apply(&Command::Undo).is_err(), "there is nothing to undo");
}

#[test]
fn what_goes_along_with_something_deleted_is_told_before() {
    let desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (9, 0) }\nb: Line\nmerge a.p2 = b.p1\nconstraint a.length = b.length\n",
    );
    let along = desk.session.along_with(desk.id, &at("b"));
    assert_eq!(along, ["merge a.p2 = b.p1", "constraint a.length = b.length"]);
    assert!(desk.session.along_with(desk.id, &at("nowhere")).is_empty());
}

fn named(class: &str) -> ClassPlan {
    ClassPlan { name: class.into(), ..ClassPlan::default() }
}

#[test]
fn four_lines_that_are_equally_long_become_a_class_of_which_others_are_made() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.take_tool(desk.id, "Line").expect("a tool");
    for (x, y) in [(0.0, 0.0), (60.0, 30.0), (120.0, 0.0), (60.0, -30.0), (0.0, 0.0)] {
        click(&mut desk, &pointer(x, y));
    }
    let lines = ["line", "line2", "line3", "line4"].map(at);
    let offers = desk.session.offers(desk.id, &lines);
    let equal = offers.iter().find(|offer| offer.label == "equal length").expect("it fits");
    desk.apply(&equal.command(None)).expect("it can be said");
    assert_eq!(desk.session.status(desk.id).freedom, 5);
    let (command, name) =
        desk.session.class_of(desk.id, &lines, &named("Rhombus")).expect("it can be one");
    desk.apply(&command).expect("it can be made");
    assert_eq!(name, "rhombus");
    holds(&desk);
    assert_eq!(desk.session.status(desk.id).freedom, 5);
    assert_eq!(desk.place("rhombus.line2.p2"), (120.0, 0.0));
    for _ in 0..2 {
        let another = desk.session.insertion(desk.id, "Rhombus").expect("the bin has it");
        desk.apply(&another).expect("there is room");
    }
    holds(&desk);
    assert_eq!(desk.session.status(desk.id).freedom, 15);
    // what is said of the class all three follow
    let level = Command::Edit {
        target: at("Rhombus"),
        members: "constraint line.p1.y = line2.p2.y".into(),
    };
    desk.apply(&level).expect("a class can be edited");
    assert_eq!(desk.session.status(desk.id).freedom, 12);
    let again = desk
        .session
        .class_of(desk.id, &[at("rhombus")], &named("Rhombus"))
        .expect_err("it is there");
    assert_eq!(again.message, "there is a class Rhombus already");
}

#[test]
fn a_typed_length_is_meant_in_the_unit_of_the_document() {
    for unit in ["mm", "cm", "m"] {
        let mut desk = Desk::of(&format!("use geometry\nunit {unit}\n"));
        desk.session.take_tool(desk.id, "Line").expect("a tool");
        click(&mut desk, &pointer(0.0, 0.0));
        click(&mut desk, &Pointer { length: Some(50.0.into()), ..pointer(6.0, 8.0) });
        holds(&desk);
        assert_eq!(desk.place("line.p2"), (30.0, 40.0), "{unit}");
        let text = desk.session.text(desk.id).source;
        assert!(text.contains("line.length = 50"), "{text}");
    }
}

#[test]
fn a_box_is_drawn_from_any_of_its_corners() {
    for (from, to) in [((180.0, 130.0), (100.0, 100.0)), ((180.0, 100.0), (100.0, 130.0))] {
        let mut desk = Desk::of("use geometry\n");
        desk.session.take_tool(desk.id, "Rectangle").expect("a tool");
        click(&mut desk, &pointer(from.0, from.1));
        click(&mut desk, &pointer(to.0, to.1));
        holds(&desk);
        assert_eq!(desk.place("rectangle.corner"), (100.0, 100.0));
        assert_eq!((desk.number("rectangle.width"), desk.number("rectangle.height")), (80.0, 30.0));
    }
}

#[test]
fn a_line_is_drawn_along_across_and_touching_what_is_there() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 50) }\nc: Circle { center = (300, 0)  radius = 50 }\n",
    );
    let caught = |desk: &mut Desk, pointer: Pointer| {
        let view = desk.session.tool_moved(desk.id, &pointer).expect("a tool is held");
        view.caught.map(|caught| caught.word)
    };
    desk.session.take_tool(desk.id, "Line").expect("a tool");
    click(&mut desk, &pointer(0.0, 200.0));
    let near = pointer(101.0, 248.0);
    assert_eq!(caught(&mut desk, near.clone()).as_deref(), Some("parallel to a"));
    assert_eq!(
        caught(&mut desk, Pointer { alone: true, ..near.clone() }),
        None,
        "Shift suppresses it"
    );
    click(&mut desk, &near);
    // on from its end, at a right angle
    assert_eq!(
        caught(&mut desk, pointer(52.0, 349.0)).as_deref(),
        Some("perpendicular to a"),
        "{}",
        desk.text()
    );
    click(&mut desk, &pointer(52.0, 349.0));
    desk.session.take_tool(desk.id, "Line").expect("a tool");
    click(&mut desk, &pointer(170.0, 0.0));
    assert_eq!(caught(&mut desk, pointer(282.0, 47.0)).as_deref(), Some("touches c"));
    click(&mut desk, &pointer(282.0, 47.0));
    holds(&desk);
    let text = desk.text();
    for said in [
        "constraint line.parallel(to: a)",
        "constraint line2.perpendicular(to: a)",
        "constraint c.passes(through: line3.p2)",
        "constraint line3.perpendicular(to: Line(c.center, line3.p2))",
    ] {
        assert!(text.contains(said), "{said}: {text}");
    }
    let all = desk.session.annotations(desk.id);
    let touches = all.iter().find(|one| one.of == ["line3", "c"]).expect("it has a sign");
    assert_eq!(touches.words, "T");
    // 130 from the centre of a circle of radius 50, a tangent is 120 long
    assert!((desk.number("line3.length") - 120.0).abs() < 1e-9);
}

#[test]
fn a_typed_angle_is_the_direction_of_the_line() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.take_tool(desk.id, "Line").expect("a tool");
    click(&mut desk, &pointer(0.0, 0.0));
    let typed = Pointer { length: Some(50.0.into()), angle: Some(30.0), ..pointer(9.0, 1.0) };
    click(&mut desk, &typed);
    holds(&desk);
    let text = desk.text();
    let said = "constraint line.direction = 30 deg";
    assert!(text.contains(said), "{text}");
    let (x, y) = desk.place("line.p2");
    assert!((x - 25.0 * 3.0_f64.sqrt()).abs() < 1e-9 && (y - 25.0).abs() < 1e-9, "{x} {y}");
}

#[test]
fn a_regular_polygon_has_as_many_sides_as_is_typed() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.take_tool(desk.id, "RegularPolygon").expect("a tool");
    click(&mut desk, &pointer(0.0, 0.0));
    click(&mut desk, &pointer(40.0, 0.0));
    holds(&desk);
    assert!(
        (desk.number("regularPolygon.side") - 40.0).abs() < 1e-9,
        "a hexagon's side is its radius"
    );
    desk.type_in("regularPolygon.sides", "4").expect("a number");
    assert!((desk.number("regularPolygon.side") - 40.0 * 2.0_f64.sqrt()).abs() < 1e-9);
}

#[test]
fn an_equation_begins_with_what_is_picked_and_says_what_it_would_move() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nb: Line { p1 = (0, 50)  p2 = (80, 50) }\n",
    );
    let begun = desk.session.equation_begun(desk.id, &[at("a"), at("b")]);
    assert_eq!(begun, "a.length = b.length");
    let said = |rule: &str| Command::Edit {
        target: session::Path::default(),
        members: format!("constraint {rule}"),
    };
    let seen = desk.session.foreseen(desk.id, &said("a.length = 100")).expect("it can be said");
    assert_eq!(seen.moved, Vec::<String>::new());
    let seen = desk.session.foreseen(desk.id, &said("b.length = a.length / 2 + 10"));
    let moved = seen.expect("it can be said").moved;
    assert!(!moved.is_empty() && moved.iter().all(|path| path != "a.p1.x"), "{moved:?}");
    let wrong = desk.session.foreseen(desk.id, &said("b.length = 3 kg")).expect_err("no length");
    assert!(wrong.message.contains("Length"), "{}", wrong.message);
    desk.apply(&said("b.length = a.length / 2 + 10")).expect("it can be said");
    holds(&desk);
}

#[test]
fn the_last_side_of_a_box_is_as_upright_as_the_others() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.take_tool(desk.id, "Line").expect("a tool");
    for (x, y) in [(0.0, 0.0), (90.0, 0.0), (90.0, 60.0), (0.0, 60.0), (0.0, 0.0)] {
        click(&mut desk, &pointer(x, y));
    }
    holds(&desk);
    let text = desk.text();
    assert!(text.contains("line4.p1.x = line4.p2.x"), "{text}");
    assert_eq!(desk.session.status(desk.id).freedom, 4, "{text}");
}

#[test]
fn the_end_of_an_arc_is_written_without_the_solver_s_rounding() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.take_tool(desk.id, "Arc").expect("a tool");
    for (x, y) in [(0.0, 107.0), (200.0, 107.0), (100.0, 307.0)] {
        click(&mut desk, &pointer(x, y));
    }
    holds(&desk);
    let text = desk.text();
    assert!(text.contains("end = (89.4427191, 285.8854382)"), "{text}");
}

#[test]
fn an_angle_of_more_than_half_a_turn_that_is_typed_holds() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.take_tool(desk.id, "Line").expect("a tool");
    click(&mut desk, &pointer(0.0, 0.0));
    let typed = Pointer { length: Some(50.0.into()), angle: Some(270.0), ..pointer(9.0, 9.0) };
    click(&mut desk, &typed);
    holds(&desk);
    assert!(desk.text().contains("constraint line.direction = -90 deg"), "{}", desk.text());
    assert_eq!(desk.place("line.p2").1, -50.0);
}

#[test]
fn the_parts_of_a_relation_are_dropped_on_lines_and_circles() {
    let text = "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 10) }\nb: Line { p1 = (0, 60)  p2 = (90, 90) }\n\
                c: Circle { center = (200, 50)  radius = 40 }\n";
    let mut desk = Desk::of(text);
    let hint = desk.session.take_tool(desk.id, "Parallel").expect("geometry has it").hint;
    assert!(hint.starts_with("Parallel: click or press to set its line a;"), "{hint}");
    // nobody would see a line that is the relation's alone
    let nowhere =
        desk.session.tool_set(desk.id, &pointer(50.0, 300.0)).expect_err("nothing is there");
    assert_eq!(nowhere.message, "Parallel sticks to a Line: there is none here");
    let over = desk.session.tool_moved(desk.id, &pointer(51.0, 8.0)).expect("a tool");
    assert_eq!(over.caught.map(|c| c.word).as_deref(), Some("joins a"));
    click(&mut desk, &pointer(51.0, 8.0));
    let again = desk.session.tool_set(desk.id, &pointer(21.0, 3.0)).expect_err("it is that line");
    assert_eq!(again.message, "Parallel sticks to another Line: a is its part already");
    click(&mut desk, &pointer(45.0, 72.0));
    holds(&desk);
    let made = desk.text();
    assert!(made.contains("merge a = parallel.a\nmerge b = parallel.b\n"), "{made}");
    assert_eq!(desk.session.status(desk.id).freedom, 9, "{made}");
    assert!(desk.wrong().is_empty(), "{made}");
    // the first line stays where it was
    assert!(made.contains("a: Line { p1 = (0, 0)  p2 = (100, 10) }"), "{made}");
    let [ax, ay] = [desk.number("a.p2.x"), desk.number("a.p2.y")];
    let [bx, by] = [
        desk.number("b.p2.x") - desk.number("b.p1.x"),
        desk.number("b.p2.y") - desk.number("b.p1.y"),
    ];
    assert!((ax * by - ay * bx).abs() < 1e-6, "{made}");
    // a point by its place, a circle by its rim
    desk.session.take_tool(desk.id, "PointOnCircle").expect("geometry has it");
    click(&mut desk, &pointer(200.0, 91.0));
    click(&mut desk, &pointer(100.0, 10.0));
    let made = desk.text();
    assert!(made.contains("merge c = pointOnCircle.circle\n"), "{made}");
    assert!(made.contains("merge a.p2 = pointOnCircle.point\n"), "{made}");
    holds(&desk);
}

#[test]
fn an_arc_is_offered_its_radius_before_its_length() {
    let desk = Desk::of(
        "use geometry\na: Arc { center = (0, 0)  start = (50, 0)  end = (0, 50) }\n\
         b: Arc { center = (200, 0)  start = (230, 0)  end = (200, 30) }\nl: Line\n",
    );
    let labels = |paths: &[&str]| -> Vec<String> {
        let paths: Vec<_> = paths.iter().map(|path| at(path)).collect();
        let offers = desk.session.offers(desk.id, &paths);
        offers.into_iter().map(|offer| offer.label).collect()
    };
    let first = |labels: &[String], of: [&str; 2]| {
        let at = of.map(|label| labels.iter().position(|l| l == label));
        assert!(at[0].is_some_and(|a| at[1].is_none_or(|b| a < b)), "{labels:?}");
    };
    first(&labels(&["a"]), ["radius", "length"]);
    first(&labels(&["a", "b"]), ["equal radius", "equal length"]);
    first(&labels(&["a", "l"]), ["equal length", "equal radius"]);
}

#[test]
fn what_is_drawn_among_atoms_is_not_rounded_away() {
    let mut desk = Desk::of("use geometry\np: Point = (0, 0)\nq: Point = (3e-9, 1e-9)\n");
    desk.session.take_tool(desk.id, "Line").expect("a tool");
    let at = |x: f64, y: f64| Pointer { at: (x, y), reach: 2e-11, ..Pointer::default() };
    click(&mut desk, &at(2e-9, 2e-9));
    click(&mut desk, &at(2.5e-9, 1e-9));
    assert_eq!((desk.place("line.p1"), desk.place("line.p2")), ((2e-9, 2e-9), (2.5e-9, 1e-9)));
}

#[test]
fn a_circle_drawn_by_hand_on_a_very_small_sheet_has_a_radius() {
    let mut desk = Desk::of("use geometry\np: Point = (0, 0)\nq: Point = (3e-9, 1e-9)\n");
    desk.session.take_tool(desk.id, "Circle").expect("geometry has circles");
    let at = |x: f64, y: f64| Pointer { reach: 5e-11, alone: true, ..pointer(x, y) };
    click(&mut desk, &at(2e-9, 2e-9));
    click(&mut desk, &at(2.3e-9, 2.4e-9));
    assert_eq!(desk.number("circle.radius"), 5e-10, "{}", desk.text());
    holds(&desk);
}
