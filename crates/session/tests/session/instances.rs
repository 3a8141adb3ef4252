//! Things of programs: placed where there is room, held in their place, unlinked; and what their steps say, changed.

use crate::desk::{Desk, at};
use session::Command;
use session::drafting::view::{Go, StepOperand, Turn, Wants};
use session::view::{Pointer, RowUse};

const WASHER: &str = "\
use geometry

program Washer(inner: Length = 4, outer: Length = 10) {
    hole = Circle(center: Point(0, 0), radius: inner / 2)
    rim = Circle.concentric(with: hole, radius: outer / 2)
}

family Sold of Washer {
    rows: (\"M5\", 5, 10)  (\"M8\", 8, 16)
}

washer: Washer
";

fn number(desk: &Desk, path: &str) -> f64 {
    let rows = desk.session.values(desk.id);
    let row = rows.iter().find(|row| row.path == path);
    let number = row.and_then(|row| row.number);
    number.unwrap_or_else(|| panic!("{path} has a number: {row:?}"))
}

/// Where circles lie on the sheet, by their paths: centre and radius.
fn circle(desk: &Desk, path: &str) -> [f64; 3] {
    ["center.x", "center.y", "radius"].map(|part| number(desk, &format!("{path}.{part}")))
}

#[test]
fn rows_are_placed_beside_one_another() {
    let mut desk = Desk::of(WASHER);
    let grid = desk.session.family_grid(desk.id, "Sold", None).expect("there is one");
    let mut things = Vec::new();
    for row in &grid.rows {
        let used = desk.session.use_family_row(desk.id, ("Sold", row), &RowUse::Place);
        things.push(used.expect("there is room").1);
    }
    assert_eq!(things, ["m5", "m8"]);
    assert!(desk.text().contains("m8: Placed of Washer {"), "{}", desk.text());
    let of = ["washer", "m5", "m8"].map(|thing| circle(&desk, &format!("{thing}.rim")));
    assert_eq!(of.map(|[_, _, radius]| radius), [5.0, 5.0, 8.0]);
    for (i, a) in of.iter().enumerate() {
        for b in &of[..i] {
            let apart = base::number::hypot(a[0] - b[0], a[1] - b[1]);
            assert!(apart > a[2] + b[2], "{of:?}");
        }
    }
    // the tile of the bin does the same, and one undo takes it back
    let before = desk.text();
    let insert = desk.session.insertion(desk.id, "Washer").expect("there is room");
    desk.apply(&insert).expect("it is a part");
    assert!(desk.text().contains("washer2: Placed of Washer"), "{}", desk.text());
    desk.undo();
    assert_eq!(desk.text(), before);
}

#[test]
fn a_program_asks_for_its_values_and_its_place() {
    let mut desk = Desk::of(WASHER);
    let prompt = desk.session.begin(desk.id, "Washer").expect("it is in scope");
    let slots: Vec<&str> = prompt.operands.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(slots, ["inner", "outer", "at"]);
    for typed in ["6", "12", "100,50"] {
        desk.session.enter(desk.id, typed).expect("it fits");
    }
    assert_eq!(circle(&desk, "washer2.rim"), [100.0, 50.0, 6.0]);
    assert!(desk.text().contains("washer2: Placed of Washer {"), "{}", desk.text());
}

#[test]
fn a_program_that_asks_for_its_place_is_asked_for_one() {
    let text = "use geometry\nprogram Peg(at: Point = (0, 0), d: Length = 8) { rim = Circle(at, d / 2) }\npeg: Peg\n";
    let mut desk = Desk::of(text);
    let peg = |desk: &Desk, name: &str| {
        ["at.x", "at.y", "rim.radius"].map(|part| number(desk, &format!("{name}.{part}")))
    };
    desk.session.begin(desk.id, "Peg").expect("a program is a construction");
    for typed in ["50, 20", "6"] {
        desk.session.enter(desk.id, typed).expect("it fits");
    }
    assert_eq!(peg(&desk, "peg2"), [50.0, 20.0, 3.0]);
    desk.drag("peg2", &[(60.0, 20.0)]);
    assert_eq!(peg(&desk, "peg2"), [60.0, 20.0, 3.0]);
    // out of the bin, too
    desk.session.take_tool(desk.id, "Peg").expect("it can be placed");
    let pointer = Pointer { at: (90.0, 0.0), ..Pointer::default() };
    desk.session.tool_moved(desk.id, &pointer).expect("a tool is in the hand");
    let view = desk.session.tool_set(desk.id, &pointer).expect("it is laid down");
    desk.apply(&view.command.expect("all of it is said")).expect("it is made");
    assert_eq!(peg(&desk, "peg3"), [90.0, 0.0, 4.0]);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    // a step of that name is none
    let step = "use geometry\nprogram Peg(d: Length = 8) {\n    at = Point(0, 0)\n    rim = Circle(at, d / 2)\n}\n";
    let mut desk = Desk::of(step);
    let asked = desk.session.begin(desk.id, "Peg").expect("a program is a construction");
    assert_eq!(asked.operands.len(), 2, "{:?}", asked.operands);
}

#[test]
fn what_is_placed_is_dragged_and_held_in_its_place_it_is_fitted() {
    let mut desk = Desk::of(
        &WASHER.replace("washer: Washer\n", "washer: Placed of Washer { at = (20, 0) }\n"),
    );
    // each value stands there once, by a name that a text can say
    let paths: Vec<String> = desk.session.values(desk.id).into_iter().map(|row| row.path).collect();
    assert!(paths.iter().all(|path| session::parse_path(path).is_some()), "{paths:?}");
    desk.drag("washer.rim.center", &[(30.0, 5.0)]);
    assert_eq!(circle(&desk, "washer.rim"), [30.0, 5.0, 5.0]);
    assert_eq!(desk.session.is_held_in_place(desk.id, "washer"), Some(false));
    desk.session.hold_in_place(desk.id, "washer", true).expect("it is placed");
    assert_eq!(desk.session.is_held_in_place(desk.id, "washer"), Some(true));
    desk.drag("washer.rim.radius", &[(7.0, 0.0)]);
    assert_eq!(circle(&desk, "washer.rim"), [30.0, 5.0, 7.0]);
    assert_eq!(number(&desk, "washer.outer"), 14.0);
    let before = desk.text();
    desk.session.hold_in_place(desk.id, "washer", false).expect("it is placed");
    desk.undo();
    assert_eq!(desk.text(), before);
    let refused = desk.session.hold_in_place(desk.id, "nothing", true).expect_err("it is none");
    assert_eq!(refused.message, "nothing is no placed thing of a program");
}

/// Drags what lies at a place to another.
fn drag_at(desk: &mut Desk, thing: &str, from: (f64, f64), to: (f64, f64)) {
    let pointer = Pointer { at: from, reach: 0.5, ..Pointer::default() };
    let held = desk.session.press_at(desk.id, &[at(thing)], &pointer);
    let (x, y) = held.expect("it can be held there");
    desk.session.drag(desk.id, (x + to.0 - from.0, y + to.1 - from.1));
    desk.session.release(desk.id).expect("the drag can be kept");
}

#[test]
fn a_rim_of_what_has_no_place_is_dragged_larger() {
    let mut desk = Desk::of(WASHER);
    drag_at(&mut desk, "washer", (0.0, 5.0), (0.0, 8.0));
    assert_eq!(circle(&desk, "washer.rim"), [0.0, 0.0, 8.0]);
    assert_eq!(number(&desk, "washer.outer"), 16.0);
    desk.undo();
    assert_eq!(desk.text(), WASHER);
    // aside of the way outwards it comes as near as it can
    drag_at(&mut desk, "washer", (3.0, 4.0), (7.0, 6.0));
    let [_, _, radius] = circle(&desk, "washer.rim");
    assert!((radius - 9.0).abs() < 1e-6, "{radius}");
    let aside = Pointer { at: (5.4, 7.2), reach: 0.5, ..Pointer::default() };
    desk.session.press_at(desk.id, &[at("washer")], &aside).expect("it can be held there");
    let told = desk.session.drag(desk.id, (6.1, 7.9));
    assert_eq!(told.message, None, "that is no limit");
    let told = desk.session.drag(desk.id, (6.1, 7.9));
    assert_eq!(told.message, None, "nor is it one where the pointer rests");
    desk.session.cancel(desk.id);
    // what follows has the decimals that the pointer tells
    desk.undo();
    drag_at(&mut desk, "washer", (0.0, 5.0), (3.1, 10.0234));
    assert!(desk.text().contains("outer = 20.05"), "{}", desk.text());
    assert_eq!(number(&desk, "washer.outer"), 20.05);
    // what is placed moves, until it is held where it is
    let placed = WASHER.replace("washer: Washer\n", "washer: Placed of Washer { at = (20, 0) }\n");
    let mut desk = Desk::of(&placed);
    drag_at(&mut desk, "washer", (25.0, 0.0), (28.0, 0.0));
    assert_eq!(circle(&desk, "washer.rim"), [23.0, 0.0, 5.0]);
    desk.session.hold_in_place(desk.id, "washer", true).expect("it is placed");
    drag_at(&mut desk, "washer", (28.0, 0.0), (30.0, 0.0));
    assert_eq!(circle(&desk, "washer.rim"), [23.0, 0.0, 7.0]);
}

#[test]
fn an_angle_and_a_ratio_that_a_rim_moves_have_few_digits() {
    let fan = |turn: &str, thing: &str| {
        format!(
            "use geometry\nprogram Fan(turn: Angle = {turn}) {{\n    hub = Point(0, 0)\n    \
             blade = Line.polar(from: hub, length: 50, angle: turn)\n}}\n{thing}\n"
        )
    };
    // the end of a blade of 50 lies at (30, 40) by 53.1301 degrees, 0.9273 in radians; a tenth of a degree moves it by 0.087
    for (text, written) in [
        (fan("30 deg", "fan: Fan"), "turn = 53.13 deg"),
        (fan("0.5", "fan: Fan"), "turn = 53.13 deg"),
        (fan("30 deg", "fan: Fan { turn = 40 deg }"), "turn = 53.13 deg"),
        (fan("30 deg", "fan: Fan { turn = 0.5 }"), "turn = 0.9273"),
    ] {
        let mut desk = Desk::of(&text);
        let [x, y] = ["x", "y"].map(|of| number(&desk, &format!("fan.blade.p2.{of}")));
        drag_at(&mut desk, "fan", (x, y), (30.0, 40.0));
        assert!(desk.text().contains(written), "{}", desk.text());
    }
    let text = "use geometry\nprogram Ring(part: Real = 0.5) {\n    hole = Circle(Point(0, 0), 7 * part)\n}\nring: Ring\n";
    let mut desk = Desk::of(text);
    drag_at(&mut desk, "ring", (0.0, 3.5), (0.0, 5.0));
    assert!(desk.text().contains("part = 0.714"), "{}", desk.text());
    assert_eq!(number(&desk, "ring.part"), 0.714);
}

#[test]
fn two_parameters_that_are_dragged_are_written_by_their_names() {
    let text = "use geometry\nprogram Peg(across: Length = 10, up: Length = 5) {\n    rim = Circle(Point(across, up), 3)\n}\npeg: Peg\n";
    let mut desk = Desk::of(text);
    desk.drag("peg.rim.center", &[(12.0, 7.0)]);
    assert!(desk.text().ends_with("peg: Peg { across = 12; up = 7 }\n"), "{}", desk.text());
    assert_eq!(circle(&desk, "peg.rim"), [12.0, 7.0, 3.0]);
}

#[test]
fn a_rim_that_is_held_where_it_is_tells_what_holds_it() {
    let bounded = WASHER.replace("outer: Length =", "outer: Length in 2..30 =");
    assert_ne!(bounded, WASHER);
    let mut desk = Desk::of(&bounded);
    let pointer = Pointer { at: (0.0, 5.0), reach: 0.5, ..Pointer::default() };
    desk.session.press_at(desk.id, &[at("washer")], &pointer).expect("it can be held there");
    let told = desk.session.drag(desk.id, (0.0, 100.0));
    let limit = "(0, 15) is the limit of washer.rim; held by washer.outer_range";
    assert_eq!(told.message.as_deref(), Some(limit));
    desk.session.release(desk.id).expect("the drag can be kept");
    assert_eq!(number(&desk, "washer.outer"), 30.0);
}

#[test]
fn a_curve_that_follows_no_value_is_no_handle() {
    let text = "use geometry\nprogram P(r: Length = 5) { c = Circle(Point(0, 0), 5) }\np: P\n";
    let mut desk = Desk::of(text);
    let pointer = Pointer { at: (3.0, 4.0), reach: 0.5, ..Pointer::default() };
    let refused = desk.session.press_at(desk.id, &[at("p")], &pointer).expect_err("it is fixed");
    assert_eq!(refused.message, "p has no place that could be dragged");
}

#[test]
fn an_arc_that_runs_to_the_right_is_held_where_the_pointer_is() {
    let text = "use geometry\nprogram P(r: Length = 5) { a = Arc(Point(0, 0), Point(0, r), Point(r, 0)).reversed }\np: P\n";
    let mut desk = Desk::of(text);
    drag_at(&mut desk, "p", (-3.0, 4.0), (-6.0, 8.0));
    assert!(desk.text().contains("p: P { r = 10 }"), "{}", desk.text());
}

#[test]
fn what_is_unlinked_is_plain_figures_where_it_was() {
    let text = WASHER
        .replace("washer: Washer\n", "washer: Placed of Washer { at = (20, 0)  scale = 2 }\n");
    let mut desk = Desk::of(&text);
    let (_, names) = desk.session.unlink(desk.id, "washer").expect("circles are plain");
    assert_eq!(names, ["washer_hole", "washer_rim"]);
    assert_eq!(circle(&desk, "washer_rim"), [20.0, 0.0, 10.0]);
    assert!(!desk.text().contains("Placed"), "{}", desk.text());
    desk.undo();
    assert_eq!(desk.text(), text);
    // what something else speaks of stays
    let mut desk = Desk::of(&format!("{text}gap: Length => washer.rim.radius\n"));
    let before = desk.text();
    let refused = desk.session.unlink(desk.id, "washer").expect_err("gap speaks of it");
    assert!(refused.message.contains("washer") || !refused.diagnostics.is_empty(), "{refused:?}");
    assert_eq!(desk.text(), before);
}

const RINGS: &str = "\
use geometry

program Rings(radius: Length = 40, minimum: Length = 2) {
    floor = Axis.horizontal(y: 0)
    wall = Axis.vertical(x: 0)
    turns = repeat with under = floor, size = radius {
        ring = Circle.tangent(under, wall, radius: size)
        hole = Circle.concentric(with: ring, radius: ring.radius / 2)
        dot = Circle.concentric(with: ring, radius: 1)
        next under = -ring, size = ring.radius / 2
    } until ring.radius < minimum
    if minimum > 3 {
        mark = Circle(center: Point(0, 0), radius: minimum)
    } else {
        mark = Point(0, 0)
    }
}

rings: Rings
";

fn operand(desk: &Desk, step: &str, slot: &str) -> StepOperand {
    let all = desk.session.step_operands(desk.id, ("rings", step), None);
    let found = all.iter().find(|operand| operand.slot == slot).cloned();
    found.unwrap_or_else(|| panic!("{slot} of {step}: {all:?}"))
}

#[test]
fn a_steps_numbers_stand_where_they_belong_and_are_changed() {
    let mut desk = Desk::of(RINGS);
    let radius = operand(&desk, "turns.ring", "radius");
    assert_eq!((radius.says.as_str(), radius.value.as_deref()), ("size", Some("40")));
    // from the centre of the first ring, (-40, 40), to its rim
    let [from, to] = radius.along.expect("it is a radius");
    assert_eq!(from, (-40.0, 40.0));
    assert!((base::number::hypot(to.0 + 40.0, to.1 - 40.0) - 40.0).abs() < 1e-9);
    let before = desk.text();
    desk.session
        .set_operand(desk.id, ("rings", "turns.hole", "radius"), "ring.radius / 4")
        .expect("it is a number");
    assert!(desk.text().contains("with: ring, radius: ring.radius / 4"), "{}", desk.text());
    desk.undo();
    assert_eq!(desk.text(), before);
    for typed in ["", "ring.radius /", "under", "nothing"] {
        let step = ("rings", "turns.hole", "radius");
        let refused = desk.session.set_operand(desk.id, step, typed);
        refused.expect_err("it is no number");
        assert_eq!(desk.text(), before);
    }
    let found = desk.session.step_of(desk.id, "rings.turns[2].hole");
    assert_eq!(found, Some(("rings".into(), "turns.hole".into())));
}

#[test]
fn a_steps_number_stands_at_the_turn_that_is_selected_or_visited() {
    let mut desk = Desk::of(RINGS);
    let radius = |desk: &Desk, selected: Option<&str>| {
        let all = desk.session.step_operands(desk.id, ("rings", "turns.ring"), selected);
        let found = all.iter().find(|operand| operand.slot == "radius").cloned();
        let found = found.expect("a ring has a radius");
        let [from, to] = found.along.expect("it is a radius");
        let away = base::number::hypot(to.0 - from.0, to.1 - from.1);
        (found.value.unwrap_or_default(), (away * 1e6).round() / 1e6)
    };
    assert_eq!(radius(&desk, None), ("40".into(), 40.0));
    // what is selected is made in the same turn, or is all of it
    for selected in ["rings.turns[2].hole", "rings.turns[2].ring.center", "rings.turns[2]"] {
        assert_eq!(radius(&desk, Some(selected)), ("10".into(), 10.0), "{selected}");
    }
    // of another thing, or outside of the loop, it says nothing
    for selected in ["rings.mark", "other.turns[2].ring", "rings"] {
        assert_eq!(radius(&desk, Some(selected)), ("40".into(), 40.0), "{selected}");
    }
    desk.session.record(desk.id, "Rings").expect("it is recorded again");
    desk.session.visit(desk.id, &Go::UntilDrawn("turns[3].hole".into())).expect("it is drawn");
    assert_eq!(radius(&desk, Some("rings.turns[2].hole")), ("5".into(), 5.0));
}

#[test]
fn a_visit_until_what_lies_along_a_guide_goes_to_what_is_drawn() {
    let mut desk = Desk::of(
        "use geometry\nprogram Bore(d: Length = 40) {\n    guide rim = Circle(Point(0, 0), d / 2)\n    \
         arc = Arc(rim.center, rim.point(at: 120 deg), rim.point(at: 60 deg))\n}\nbore: Bore\n",
    );
    desk.session.record(desk.id, "Bore").expect("it is recorded again");
    let mut until = |x: f64, y: f64| {
        let pointer = Pointer { at: (x, y), reach: 2.0, ..Pointer::default() };
        desk.session.visit(desk.id, &Go::UntilPicked(pointer)).expect("something is drawn there");
        desk.session.step_next(desk.id).map(|(_, step)| step)
    };
    assert_eq!(until(0.0, -20.0).as_deref(), Some("arc"));
    // where nothing is drawn the guide is
    assert_eq!(until(0.0, 20.0).as_deref(), Some("rim"));
}

#[test]
fn a_step_that_fails_by_what_another_construction_supplies_tells_what_that_was_given() {
    let desk = Desk::of(
        "use geometry\nprogram Key(w: Length = 50) {\n    rim = Circle(Point(0, 0), 20)\n    \
         side = Axis.vertical(x: w / 2)\n    \
         line = Line(Point.intersection(-rim, side), Point(1, 2))\n}\nkey: Key\n",
    );
    let said: Vec<String> =
        desk.session.text(desk.id).diagnostics.into_iter().map(|d| d.message).collect();
    let said = said.join("; ");
    assert!(said.contains("-rim is ") && said.contains("side is "), "{said}");
    assert!(!said.contains("operand"), "{said}");
}

#[test]
fn answers_and_conditions_of_a_loop_are_opened_again() {
    let mut desk = Desk::of(RINGS);
    let slots: Vec<String> =
        { desk.session.step_operands(desk.id, ("rings", "turns"), None).into_iter() }
            .map(|operand| format!("{}: {}", operand.slot, operand.says))
            .collect();
    let wanted = [
        "under: floor",
        "size: radius",
        "until: ring.radius < minimum",
        "next under: -ring",
        "next size: ring.radius / 2",
    ];
    assert_eq!(slots, wanted);
    assert_eq!(desk.session.comes_to(desk.id, "rings.turns").as_deref(), Some("6 turns"));
    desk.session.record(desk.id, "Rings").expect("it is recorded again");
    let prompt = desk.session.begin_change(desk.id, ("turns", "until"), None).expect("it is one");
    assert!(prompt.is_some_and(|p| p.is_value && p.wants == Wants::Change("ring.radius < minimum".into())));
    let refused = desk.session.enter(desk.id, "ring.radius <").expect_err("it is no condition");
    assert!(!refused.message.is_empty());
    desk.session.enter(desk.id, "ring.radius < 2 * minimum").expect("it is one");
    assert_eq!(desk.session.comes_to(desk.id, "rings.turns").as_deref(), Some("5 turns"));
    // a recurrence answer is picked on the drawing: from the hole of the turn before
    desk.session.begin_change(desk.id, ("turns", "next size"), None).expect("it is one");
    desk.session.enter(desk.id, "hole.radius / 2").expect("it is a number");
    assert!(desk.text().contains("size = hole.radius / 2"), "{}", desk.text());
    desk.undo();
    desk.undo();
    assert_eq!(desk.text(), RINGS);
    // an object with which a turn has no outcome is refused, another one taken
    desk.session.begin_change(desk.id, ("turns.ring", "second"), None).expect("it is one");
    let at = |x, y| Pointer { at: (x, y), reach: 2.0, ..Pointer::default() };
    let refused = desk.session.point(desk.id, &at(30.0, 0.0)).expect_err("both are the floor");
    assert!(refused.message.contains("the lines are parallel"), "{}", refused.message);
    assert_eq!(desk.text(), RINGS);
    desk.session.begin_change(desk.id, ("turns.dot", "with"), None).expect("it is one");
    let turn = desk.session.point(desk.id, &at(-60.0, 40.0)).expect("the hole lies there");
    assert!(matches!(turn, Turn::Made { .. }), "{turn:?}");
    assert!(desk.text().contains("Circle.concentric(with: hole, radius: 1)"), "{}", desk.text());
}

#[test]
fn a_branch_that_is_not_taken_is_visited_by_other_values() {
    let mut desk = Desk::of(RINGS);
    desk.session.record(desk.id, "Rings").expect("it is recorded again");
    desk.session.visit(desk.id, &Go::To("#0".into())).expect("it is a step");
    let typed = [("minimum".to_string(), "5".to_string())];
    desk.session.visit_by(desk.id, &typed).expect("it is a value");
    desk.session.visit(desk.id, &Go::In).expect("a block comes next");
    let steps = desk.session.steps(desk.id, None).expect("it is recorded");
    assert_eq!(steps.at.as_deref(), Some("#0.then.mark"));
    assert!(steps.by_others);
    desk.session
        .set_operand(desk.id, ("rings", "#0.then.mark", "radius"), "2 * minimum")
        .expect("it is a number");
    desk.session.visit_by(desk.id, &[("minimum".into(), "none".into())]).expect_err("it is none");
    desk.session.stop_recording(desk.id).expect("nothing is open");
    assert!(desk.text().ends_with("rings: Rings\n"), "{}", desk.text());
    assert!(desk.text().contains("radius: 2 * minimum"), "{}", desk.text());
}

#[test]
fn a_region_that_is_unlinked_stays_where_it_was() {
    let mut desk = Desk::of(
        "use drafting
use contours

unit mm

program Plate(d: Length = 6, w: Length = 40) {
    guide hole = Circle(center: Point(w / 2, 10), radius: d / 2)
    guide box = Contour.box(Rectangle(Point(0, 0), w, 20))
    region = Region.difference(box, Contour.circle(hole))
    edge = Line(Point(0, 0), Point(w, 0))
    wave = Spline([Point(0, 0), Point(w / 2, 5), Point(w, 0)])
}

plate: Placed of Plate { at = (7, 3)  turn = 30 deg }
",
    );
    assert_eq!(desk.wrong(), []);
    let before = desk.text();
    let picture = desk.session.picture(desk.id);
    let (_, names) = desk.session.unlink(desk.id, "plate").expect("all of it can be said");
    assert_eq!(names, ["plate_region", "plate_edge", "plate_wave"]);
    assert!(!desk.text().contains("Placed"), "{}", desk.text());
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    let [was, is] = [picture, desk.session.picture(desk.id)].map(|p| drawing::bounds(&p.drawing));
    let (was, is) = (was.expect("it is drawn"), is.expect("it is drawn"));
    let near =
        |a: drawing::Point, b: drawing::Point| (a.x - b.x).abs() < 1e-9 && (a.y - b.y).abs() < 1e-9;
    assert!(near(was.least, is.least) && near(was.most, is.most), "{was:?} {is:?}");
    desk.undo();
    assert_eq!(desk.text(), before);
}

#[test]
fn a_text_is_unlinked_in_quotes_and_a_second_thing_by_another_name() {
    let text = r#"use drafting
use contours

program Sign(w: Length = 40) {
    region = Contour.box(Rectangle(Point(0, 0), w, 20))
    note = Note(Point(1, 1), "to the left, {w}")
}

sign: Sign
"#;
    let mut desk = Desk::of(text);
    assert_eq!(desk.wrong(), []);
    let (_, names) = desk.session.unlink(desk.id, "sign").expect("all of it can be said");
    assert_eq!(names, ["sign_region", "sign_note"]);
    assert!(desk.text().contains("\"to the left, "), "{}", desk.text());
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    let members = "sign: Sign".to_string();
    desk.apply(&Command::Edit { target: session::Path::default(), members }).expect("it is free");
    let (_, names) = desk.session.unlink(desk.id, "sign").expect("it has other names");
    assert_eq!(names, ["sign_region_2", "sign_note_2"]);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}
