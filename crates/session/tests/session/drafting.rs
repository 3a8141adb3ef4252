//! Constructions chosen and given their operands; programs recorded so.

use crate::desk::{Desk, at};
use session::drafting::view::{
    Ends, Go, MeasureKind, NewParameter, RecurrenceQuestion, Turn, Wants,
};
use session::view::Pointer;

fn pointer(x: f64, y: f64) -> Pointer {
    Pointer { at: (x, y), reach: 3.0, ..Pointer::default() }
}

/// Gives an operand by pointing.
fn point(desk: &mut Desk, x: f64, y: f64) -> Turn {
    desk.session.point(desk.id, &pointer(x, y)).expect("something fits there")
}

/// Gives an operand by typing.
fn enter(desk: &mut Desk, typed: &str) -> Turn {
    desk.session.enter(desk.id, typed).expect("it fits")
}

fn begin(desk: &mut Desk, tool: &str) {
    desk.session.begin(desk.id, tool).expect("it is in scope");
}

fn made(turn: Turn) -> String {
    match turn {
        Turn::Made { text, .. } => text,
        Turn::Wants(prompt) => panic!("it waits: {prompt:?}"),
    }
}

fn value(desk: &Desk, path: &str) -> String {
    desk.session.comes_to(desk.id, path).expect("it has a value")
}

const CORNER: &str = "\
use geometry
floor: Axis { p1 = (0, 0)  p2 = (100, 0) }
wall: Axis { p1 = (0, 0)  p2 = (0, 100) }
";

#[test]
fn every_construction_of_the_library_is_a_tool() {
    let desk = Desk::of("use geometry\n");
    let tools = desk.session.constructions(desk.id);
    let has = |id: &str| tools.iter().any(|tool| tool.id == id);
    for id in [
        "Circle.tangent(first,second,radius)",
        "Point.intersection(first,second)",
        "Axis.directed(from,angle)",
        "Arc.fillet(first,second,radius)",
        "Point:mirrored",
        "Line:at",
    ] {
        assert!(has(id), "{id}: {:?}", tools.iter().map(|t| &t.id).collect::<Vec<_>>());
    }
}

#[test]
fn what_a_library_keeps_for_itself_is_no_tool() {
    let desk = Desk::of(
        "use contours\nprogram Own(d: Length = 1) {\n}\nabstract program Part(d: Length = 1) {\n}\n",
    );
    let tools = desk.session.constructions(desk.id);
    let has = |id: &str| tools.iter().any(|tool| tool.id == id);
    assert!(has("Own") && has("Contour.slot(from,to,radius)"));
    assert!(!has("Rounding") && !has("Part"));
    // one construction moves contours, too
    assert!(has(":moved(by)") && !has("Contour:moved"));
}

#[test]
fn a_copy_of_a_small_circle_is_one_of_the_circle_not_of_its_centre() {
    let mut desk = Desk::recording("Flange", &[("n", "6")]);
    begin(&mut desk, "Circle");
    enter(&mut desk, "45,0");
    made(enter(&mut desk, "2"));
    begin(&mut desk, ":pattern(about,count)");
    // both are within reach
    point(&mut desk, 46.5, 0.0);
    enter(&mut desk, "0,0");
    // all of the further ones are seen before
    let ghost = desk.session.hover(desk.id, &pointer(0.0, 80.0), "6").ghost;
    assert_eq!(ghost.elements.len(), 5);
    let pattern = made(enter(&mut desk, "n"));
    assert_eq!(pattern, "polar pattern: circle, about (0, 0), count n; n is a count now");
    assert!(desk.text().contains("=> circle.turned("), "{}", desk.text());
}

#[test]
fn a_comparison_in_a_place_is_not_taken_for_length_and_angle() {
    let mut desk = Desk::recording("Choice", &[("d", "10")]);
    begin(&mut desk, "Line");
    enter(&mut desk, "if d < 5 then Point(0, 0) else Point(3, 4)");
    let text = made(enter(&mut desk, "@if d < 5 then 1 else 2, 3"));
    assert!(!text.contains("polar"), "{text}");
    assert_eq!(value(&desk, "choice.line"), "(3, 4) to (5, 7)");
    enter(&mut desk, "if d < 5 then 1 else 2, 3");
    let wrong = desk.session.enter(desk.id, "@@@5<3").expect_err("one sign is enough").message;
    assert_eq!(wrong, "@@@5<3: one `@` is wanted");
    let wrong = desk.session.enter(desk.id, "@5").expect_err("it is one number").message;
    assert_eq!(wrong, "@5: `@dx,dy` is wanted");
    made(enter(&mut desk, "@20<90"));
    assert_eq!(value(&desk, "choice.line2"), "(2, 3) to (2, 23)");
    assert_eq!(desk.wrong(), []);
}

const CROSSED: &str = "\
use geometry
class Beam is Line {
    extended(by l: Length) => Line(p2, p1)
}
program Trim() {
    guide line = Line(Point(0, 0), Point(100, 0))
    line2 = Line(Point(60, -20), Point(60, 20))
    beam = Beam(p1: Point(0, 50), p2: Point(9, 50))
}
trim: Trim
";

#[test]
fn a_guide_that_is_trimmed_stays_a_guide() {
    let mut desk = Desk::of(CROSSED);
    desk.session.record(desk.id, "Trim").expect("it is there");
    begin(&mut desk, "Line:trimmed");
    enter(&mut desk, "line");
    made(enter(&mut desk, "line2"));
    let lines = "    guide trimmed = line.trimmed(at: line2)\n    erase line\n";
    assert!(desk.text().contains(lines), "{}", desk.text());
    assert_eq!(desk.wrong(), []);
}

#[test]
fn what_is_drawn_is_not_erased_for_a_guide() {
    let mut desk = Desk::of(CROSSED);
    desk.session.record(desk.id, "Trim").expect("it is there");
    begin(&mut desk, "Line:trimmed");
    desk.session.draw_guides(desk.id, true);
    enter(&mut desk, "line2");
    made(enter(&mut desk, "line"));
    assert!(desk.text().contains("guide trimmed = line2.trimmed(at: line)"), "{}", desk.text());
    assert!(!desk.text().contains("erase"), "{}", desk.text());
}

#[test]
fn what_a_message_of_the_documents_own_is_sent_to_is_not_erased() {
    let mut desk = Desk::of(CROSSED);
    desk.session.record(desk.id, "Trim").expect("it is there");
    begin(&mut desk, "Line:extended");
    enter(&mut desk, "beam");
    assert_eq!(made(enter(&mut desk, "5")), "beam.extended(by: 5)");
    assert!(!desk.text().contains("erase"), "{}", desk.text());
}

#[test]
fn what_a_message_that_replaces_is_sent_to_is_erased() {
    let own = CROSSED.replace("    extended(by", "    replacing extended(by");
    let mut desk = Desk::of(&own);
    desk.session.record(desk.id, "Trim").expect("it is there");
    begin(&mut desk, "Line:extended");
    enter(&mut desk, "beam");
    made(enter(&mut desk, "5"));
    let lines = " = beam.extended(by: 5)\n    erase beam\n";
    assert!(desk.text().contains(lines), "{}", desk.text());
    assert_eq!(desk.wrong(), []);
}

#[test]
fn a_line_before_the_loop_that_is_trimmed_in_it_stays_and_is_told() {
    let mut desk = Desk::of(CROSSED);
    desk.session.record(desk.id, "Trim").expect("it is there");
    desk.session.begin_loop(desk.id, "").expect("a program is recorded");
    begin(&mut desk, "Line:trimmed");
    enter(&mut desk, "line");
    assert_eq!(
        made(enter(&mut desk, "line2")),
        "line.trimmed(at: line2); line stays: it was drawn before this repeat or `if`"
    );
    assert!(desk.text().contains("        guide trimmed = "), "{}", desk.text());
    assert!(!desk.text().contains("erase"), "{}", desk.text());
}

#[test]
fn a_line_is_trimmed_and_lengthened_in_its_place() {
    let mut desk = Desk::recording("Trim", &[]);
    for ends in [["0,0", "100,0"], ["60,-20", "60,20"]] {
        begin(&mut desk, "Line");
        enter(&mut desk, ends[0]);
        made(enter(&mut desk, ends[1]));
    }
    begin(&mut desk, "Line:trimmed");
    point(&mut desk, 30.0, 0.5);
    made(point(&mut desk, 60.0, 10.0));
    assert!(desk.text().contains("trimmed = "), "{}", desk.text());
    assert_eq!(value(&desk, "trim.trimmed"), "(0, 0) to (60, 0)");
    // the line that it was is seen no more; all of it is one step
    assert!(
        desk.text().contains("trimmed = line.trimmed(at: line2)\n    erase line\n"),
        "{}",
        desk.text()
    );
    assert_eq!(desk.wrong(), []);
    begin(&mut desk, "Line:extended");
    point(&mut desk, 60.0, -10.0);
    made(enter(&mut desk, "5"));
    assert_eq!(value(&desk, "trim.line3"), "(60, -20) to (60, 25)");
    desk.undo();
    desk.undo();
    assert!(!desk.text().contains("erase"), "{}", desk.text());
    assert!(desk.text().contains("line2 = "), "{}", desk.text());
}

#[test]
fn a_loop_that_was_broken_off_goes_on_when_its_program_is_recorded_again() {
    let text = "use geometry\nprogram Row(n: Integer = 3) {\n    turns = repeat {\n        turns2 = repeat {\n            circle = Circle(center: Point(1, 0), radius: 3)\n        }\n    }\n    late = Point(0, 0)\n}\nrow: Row\n";
    let mut desk = Desk::of(text);
    desk.session.record(desk.id, "Row").expect("it is there");
    let steps = desk.session.steps(desk.id, None).expect("it is recorded");
    assert_eq!(steps.open.len(), 2);
    for by in ["@10,0", "@0,10"] {
        desk.session.end_turn(desk.id, Ends::Times).expect("its turn is drawn");
        while let Some(Wants::Recurrence(question)) = desk.session.prompt(desk.id).map(|p| p.wants)
        {
            match question.is_value {
                true => drop(desk.session.same(desk.id)),
                false => drop(enter(&mut desk, by)),
            }
        }
        enter(&mut desk, "n");
    }
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "row.turns[1].turns2[2].circle.center"), "(21, 10)");
    desk.session.stop_recording(desk.id).expect("nothing is open");
}

#[test]
fn the_next_hole_is_so_far_from_the_one_before() {
    let mut desk = Desk::recording("Row", &[("pitch", "20"), ("n", "4")]);
    desk.session.begin_loop(desk.id, "").expect("a program is recorded");
    begin(&mut desk, "Circle");
    enter(&mut desk, "100,5");
    made(enter(&mut desk, "3"));
    desk.session.end_turn(desk.id, Ends::Times).expect("a turn is drawn");
    let asked = desk.session.prompt(desk.id).expect("it asks").words;
    assert!(asked.contains("was (100, 5)"), "{asked}");
    enter(&mut desk, "@pitch,0");
    enter(&mut desk, "n");
    assert_eq!(value(&desk, "row.turns.last.circle"), "centre (160, 5), radius 3");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn a_step_is_moved_to_another_place_that_is_picked_or_typed() {
    let mut desk = Desk::recording("Row", &[]);
    begin(&mut desk, "Circle");
    enter(&mut desk, "100,5");
    made(enter(&mut desk, "3"));
    let change = |desk: &mut Desk| {
        desk.session.begin_change(desk.id, ("circle", "center"), None).expect("it has a centre");
    };
    change(&mut desk);
    point(&mut desk, 40.0, 50.0);
    assert_eq!(value(&desk, "row.circle.center"), "(40, 50)");
    change(&mut desk);
    enter(&mut desk, "@5,-10");
    assert_eq!(value(&desk, "row.circle.center"), "(45, 40)");
    change(&mut desk);
    enter(&mut desk, "7,8");
    assert!(desk.text().contains("Circle(center: Point(7, 8), radius: 3)"), "{}", desk.text());
}

#[test]
fn the_place_of_a_point_in_a_loop_is_asked_for() {
    let mut desk = Desk::recording("Row", &[("pitch", "20")]);
    desk.session.begin_loop(desk.id, "").expect("a program is recorded");
    begin(&mut desk, "Point");
    made(enter(&mut desk, "0,0"));
    begin(&mut desk, "Circle");
    point(&mut desk, 0.0, 0.0);
    made(enter(&mut desk, "3"));
    desk.session.end_turn(desk.id, Ends::Times).expect("a turn is drawn");
    let asked = desk.session.prompt(desk.id).expect("it asks").words;
    assert!(asked.starts_with("at of point was (0, 0)"), "{asked}");
    enter(&mut desk, "@pitch,0");
    enter(&mut desk, "3");
    assert_eq!(value(&desk, "row.turns.last.circle"), "centre (40, 0), radius 3");
}

#[test]
fn a_small_circle_and_not_its_centre_is_the_object_of_the_turn_before() {
    let mut desk = Desk::recording("Row", &[]);
    begin(&mut desk, "Circle");
    enter(&mut desk, "0,0");
    made(enter(&mut desk, "2"));
    desk.session.give_up(desk.id);
    desk.session.begin_loop(desk.id, "").expect("a program is recorded");
    begin(&mut desk, ":moved(by)");
    point(&mut desk, 2.0, 0.0);
    made(enter(&mut desk, "20,0"));
    desk.session.give_up(desk.id);
    desk.session.end_turn(desk.id, Ends::Times).expect("a turn is drawn");
    // the centre is as near as a hand is steady
    let hover = desk.session.hover(desk.id, &pointer(22.0, 0.0), "");
    assert_eq!(hover.finds.as_deref(), Some("shifted"));
    point(&mut desk, 22.0, 0.0);
    desk.session.same(desk.id).expect("it may be the same");
    enter(&mut desk, "3");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "row.turns.last.shifted"), "centre (60, 0), radius 2");
}

#[test]
fn all_holes_of_a_loop_are_taken_from_a_plate_by_one_pick() {
    let mut desk = Desk::of(
        "use contours\nprogram Plate() {\n    box = Contour.box(of: Rectangle.between(first: Point(0, 0), second: Point(60, 20)))\n    holes = for x in [10, 30, 50] {\n        hole = Circle(center: Point(x, 10), radius: 3)\n    }\n}\nplate: Plate\n",
    );
    desk.session.record(desk.id, "Plate").expect("it is there");
    begin(&mut desk, "Region.difference(first,second)");
    point(&mut desk, 30.0, 0.0);
    let edge = pointer(30.0, 13.0);
    assert_eq!(desk.session.hover(desk.id, &edge, "").finds.as_deref(), Some("holes[1].hole"));
    while desk.session.hover(desk.id, &edge, "").finds.as_deref() != Some("holes") {
        desk.session.pick_wider(desk.id);
    }
    made(point(&mut desk, 30.0, 13.0));
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    // 60 by 20 without three discs of radius 3: 1200 - 27 pi
    let covered = value(&desk, "plate.region.area");
    assert!(covered.starts_with("1115.17") || covered.starts_with("1115.18"), "{covered}");
}

/// What is drawn: its places are on no other curve.
const FAR: &str = "\
use contours
program Far() {
    point = Point(13, 4)
    line = Line(Point(0, 0), Point(10, 0))
    upright = Line(Point(40, 0), Point(40, 10))
    axis = Axis(Point(0, -50), Point(1, -50))
    circle = Circle(Point(100, 0), 5)
    inner = Circle(Point(100.5, 0), 4)
    arc = Arc(Point(0, 100), Point(5, 100), Point(0, 105))
    box = Contour.box(of: Rectangle.between(first: Point(10, 200), second: Point(20, 210)))
}
far: Far
";

/// Takes a distance between what lies at two places; returns what is written, and what it comes to.
fn far(from: (f64, f64), to: (f64, f64)) -> (String, String) {
    let mut desk = Desk::of(FAR);
    desk.session.record(desk.id, "Far").expect("it is there");
    begin(&mut desk, "Circle");
    enter(&mut desk, "500,500");
    desk.session.begin_measure(desk.id, MeasureKind::Distance);
    point(&mut desk, from.0, from.1);
    let Turn::Wants(prompt) = point(&mut desk, to.0, to.1) else { panic!("it is a radius") };
    let written = prompt.insert.expect("it is taken");
    made(enter(&mut desk, &written));
    assert_eq!(desk.wrong(), []);
    (written, value(&desk, "far.circle2.radius"))
}

#[test]
fn a_distance_is_that_to_the_nearest_of_what_is_picked() {
    let (point, line, upright, axis) = ((13.0, 4.0), (5.0, 0.0), (40.0, 5.0), (5.0, -50.0));
    let (circle, inner, arc, box_) = ((100.0, 5.0), (100.5, -4.0), (3.54, 103.54), (10.0, 205.0));
    let far = |from, to| far(from, to).1;
    // right triangles with sides 3, 4, 5, and differences along one axis
    assert_eq!(far(point, line), "5");
    assert_eq!(far(line, point), "5");
    assert_eq!(far(line, upright), "30");
    assert_eq!(far(axis, upright), "50");
    assert_eq!(far(line, circle), "85");
    assert_eq!(far(axis, circle), "45");
    // one within the other
    assert_eq!(far(circle, inner), "0.5");
    // an arc, and not the circle that it is a part of: from its ends
    assert_eq!(far(arc, line), "100");
    assert_eq!(far(arc, axis), "150");
    assert_eq!(far(circle, arc), "132.931");
    assert_eq!(far(box_, point), "196");
    let mut desk = Desk::of(FAR);
    desk.session.record(desk.id, "Far").expect("it is there");
    begin(&mut desk, "Circle");
    enter(&mut desk, "500,500");
    desk.session.begin_measure(desk.id, MeasureKind::Distance);
    self::point(&mut desk, box_.0, box_.1);
    let wrong = desk.session.point(desk.id, &pointer(line.0, line.1));
    let wrong = wrong.expect_err("contours are measured to points").message;
    assert_eq!(wrong, "distance: pick the point that is so far from it");
}

#[test]
fn a_short_line_is_picked_between_its_ends_by_a_finger() {
    let mut desk = Desk::recording("Nut", &[]);
    begin(&mut desk, "Line");
    enter(&mut desk, "0,0");
    made(enter(&mut desk, "30,0"));
    // its ends are drawn, too, and within reach
    for at in ["0,0", "30,0"] {
        begin(&mut desk, "Point");
        made(enter(&mut desk, at));
    }
    begin(&mut desk, ":pattern(about,count)");
    let finger = |at| Pointer { at, reach: 18.0, ..Pointer::default() };
    let picked = |desk: &mut Desk, at| {
        let hover = desk.session.hover(desk.id, &finger(at), "");
        hover.finds.expect("it lies there")
    };
    assert_eq!(picked(&mut desk, (15.0, 0.0)), "line");
    assert_eq!(picked(&mut desk, (4.0, 0.0)), "point");
    // beyond an end the line is no nearer than that
    assert_eq!(picked(&mut desk, (-12.0, 5.0)), "point");
    assert_eq!(picked(&mut desk, (41.3, -6.7)), "point2");
}

#[test]
fn a_measure_is_given_up_alone() {
    let mut desk = Desk::recording("Row", &[]);
    begin(&mut desk, "Circle");
    enter(&mut desk, "1,2");
    desk.session.begin_measure(desk.id, MeasureKind::Distance);
    assert!(desk.session.leave_measure(desk.id) && !desk.session.leave_measure(desk.id));
    // the construction waits still
    made(enter(&mut desk, "3"));
}

#[test]
fn a_slot_is_taken_round_by_its_edge() {
    let mut desk = Desk::recording("Flange", &[("n", "4")]);
    begin(&mut desk, "Contour.slot(from,to,radius)");
    // before any point was given, an angle is one of the sheet
    enter(&mut desk, "30<90");
    enter(&mut desk, "@20<0");
    made(enter(&mut desk, "4"));
    assert_eq!(value(&desk, "flange.contour"), "4 edges, area 210.265 mm^2");
    begin(&mut desk, ":pattern(about,count)");
    point(&mut desk, 10.0, 34.5);
    enter(&mut desk, "0,0");
    made(enter(&mut desk, "n"));
    assert_eq!(value(&desk, "flange.pattern"), "3 figures");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn a_construction_of_ones_own_is_a_tool_at_once() {
    let text = "use geometry\nclass Slope is Line {\n    /// A steep one.\n    static steep(over p: Point, run: Length) => Slope(p, Point(p.x + run, p.y + 2 * run))\n}\n";
    let desk = Desk::of(text);
    let tools = desk.session.constructions(desk.id);
    let own = tools.iter().find(|tool| tool.id == "Slope.steep(over,run)").expect("it is one");
    assert_eq!(own.operands, "over, run");
    assert_eq!(own.doc, "A steep one.");
}

#[test]
fn the_nearest_of_four_circles_in_a_corner_is_drawn() {
    // a circle of radius 20 that touches both axes has its centre at (±20, ±20)
    for (sx, sy) in [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)] {
        let mut desk = Desk::of(CORNER);
        begin(&mut desk, "Circle.tangent(first,second,radius)");
        point(&mut desk, sx * 20.0, 0.5);
        point(&mut desk, 0.5, sy * 20.0);
        made(enter(&mut desk, "20"));
        assert_eq!(value(&desk, "circle.center"), format!("({}, {})", sx * 20.0, sy * 20.0));
        assert_eq!(value(&desk, "circle.radius"), "20");
        assert_eq!(desk.session.history(desk.id).0.len(), 1);
    }
}

#[test]
fn fewest_reversals_are_written_where_outcomes_are_alike() {
    let mut desk = Desk::of(CORNER);
    begin(&mut desk, "Circle.tangent(first,second,radius)");
    point(&mut desk, -20.0, 0.0);
    point(&mut desk, 0.0, 20.0);
    assert_eq!(made(enter(&mut desk, "20")), "Circle.tangent(floor, wall, radius: 20)");
}

#[test]
fn operands_are_typed_as_draughtsmen_type_them() {
    let mut desk = Desk::of("use geometry\n");
    begin(&mut desk, "Circle.through(first,second,third)");
    enter(&mut desk, "10,0");
    enter(&mut desk, "@-10,10");
    made(enter(&mut desk, "Point(-10, 0)"));
    assert_eq!(value(&desk, "circle.radius"), "10");
    begin(&mut desk, "Line.polar(from,length,angle)");
    enter(&mut desk, "0,0");
    enter(&mut desk, "2 * circle.radius");
    made(enter(&mut desk, "90"));
    assert!(desk.text().contains("angle: 90 deg"), "{}", desk.text());
    assert_eq!(value(&desk, "line.length"), "20");
    begin(&mut desk, "Circle.around(center,through)");
    enter(&mut desk, "0,0");
    made(enter(&mut desk, "5<30"));
    assert_eq!(value(&desk, "circle2.radius"), "5");
}

#[test]
fn a_step_from_a_point_that_is_a_choice_goes_on_from_all_of_it() {
    for first in [
        "if d > 5 then 1 else 2, 0",
        "let far = d > 5 in if far then 1 else 2, 0",
        "if d > 5 then Point(1, 0) else Point(2, 0)",
    ] {
        let mut desk = Desk::of("use geometry\nd: Real = 10\n");
        begin(&mut desk, "Circle.around(center,through)");
        enter(&mut desk, first);
        let text = made(enter(&mut desk, "@3,0"));
        assert_eq!(value(&desk, "circle.radius"), "3", "{text}");
    }
}

#[test]
fn what_does_not_fit_is_refused_and_waited_for() {
    let mut desk = Desk::of(CORNER);
    begin(&mut desk, "Circle.tangent(first,second,radius)");
    let refused = |desk: &mut Desk, typed: &str| {
        desk.session.enter(desk.id, typed).expect_err("it does not fit").message
    };
    assert_eq!(refused(&mut desk, "floor.p1"), "floor.p1 is a Point, where a Curve is wanted");
    assert!(refused(&mut desk, "ceiling").contains("ceiling"));
    let place = refused(&mut desk, "3,4");
    assert_eq!(place, "3,4 is a place, but first is a figure: pick it, or type its name");
    let nothing = desk.session.point(desk.id, &pointer(50.0, 50.0)).expect_err("nothing is there");
    assert_eq!(nothing.message, "there is no line, circle or arc here");
    enter(&mut desk, "floor");
    enter(&mut desk, "floor");
    let place = refused(&mut desk, "3,4");
    assert!(place.ends_with("radius is a value, whose tenths stand after a point: 3.4"), "{place}");
    let none = refused(&mut desk, "10");
    assert!(none.contains("there is no such Circle"), "{none}");
    assert_eq!(desk.text(), CORNER);
    assert!(desk.session.back(desk.id).is_some());
    enter(&mut desk, "wall");
    made(enter(&mut desk, "10"));
}

#[test]
fn a_ghost_shows_what_will_be_drawn() {
    let mut desk = Desk::of(CORNER);
    begin(&mut desk, "Circle.tangent(first,second,radius)");
    point(&mut desk, 20.0, 0.0);
    point(&mut desk, 0.0, 20.0);
    let hover = desk.session.hover(desk.id, &pointer(30.0, 30.0), "20");
    assert_eq!(hover.why, None);
    // the circle, and which way it runs
    assert_eq!(hover.ghost.elements.len(), 2);
    desk.session.give_up(desk.id);
    // nothing is complained of before the pointer has left what it picked
    begin(&mut desk, "Point.intersection(first,second)");
    point(&mut desk, 20.0, 0.0);
    let still = desk.session.hover(desk.id, &pointer(20.0, 0.0), "");
    assert_eq!((still.finds, still.why), (None, None));
    desk.session.give_up(desk.id);
    begin(&mut desk, "Circle.tangent(first,second,radius)");
    point(&mut desk, 20.0, 0.0);
    point(&mut desk, 0.0, 20.0);
    // a measure is what is picked for a value; mostly it is typed, and nothing is said before a click
    let hover = desk.session.hover(desk.id, &pointer(0.0, 50.0), "");
    assert_eq!((hover.finds, hover.why), (None, None), "an axis has no length");
    let none = desk.session.point(desk.id, &pointer(0.0, 50.0)).expect_err("an axis has no length");
    assert_eq!(none.message, "there is no length here");
    assert_eq!(desk.text(), CORNER);
}

#[test]
fn a_place_picked_where_two_guides_cross_follows_them() {
    let mut desk = Desk::recording("Key", &[("width", "12"), ("bore", "40")]);
    for (tool, at) in [
        ("Axis.vertical(x)", "width / 2"),
        ("Axis.vertical(x)", "-width / 2"),
        ("Axis.horizontal(y)", "bore / 2 + 4"),
    ] {
        begin(&mut desk, tool);
        made(enter(&mut desk, at));
    }
    begin(&mut desk, "Circle");
    enter(&mut desk, "0,0");
    made(enter(&mut desk, "bore / 2"));
    begin(&mut desk, "Line");
    let hover = desk.session.hover(desk.id, &pointer(6.0, 24.0), "");
    assert_eq!(hover.finds.as_deref(), Some("Point.intersection(axis, axis3)"));
    assert!(!hover.ghost.elements.is_empty(), "it is lit");
    point(&mut desk, 6.0, 24.0);
    let text = made(point(&mut desk, -6.0, 24.0));
    let wanted = "Line(Point.intersection(axis, axis3), Point.intersection(axis2, axis3))";
    assert_eq!(text, wanted);
    // of two that a circle has with a line that which is picked
    for (from, to) in [((6.0, 24.0), (6.0, 19.08)), ((-6.0, 19.08), (-6.0, -19.08))] {
        point(&mut desk, from.0, from.1);
        made(point(&mut desk, to.0, to.1));
    }
    assert_eq!(value(&desk, "key.line2"), "(6, 24) to (6, 19.0788)");
    assert_eq!(value(&desk, "key.line3"), "(-6, 19.0788) to (-6, -19.0788)");
    // beside what crosses, and with Shift, it is a place of the sheet
    point(&mut desk, 6.0, 10.0);
    let alone = Pointer { alone: true, ..pointer(6.0, -19.08) };
    let text = made(desk.session.point(desk.id, &alone).expect("a place"));
    assert_eq!(text, "Line(Point(6, 10), Point(6, -19.08))");
}

#[test]
fn operands_that_are_given_wait_while_another_construction_supplies_the_next() {
    let mut desk = Desk::recording("Part", &[]);
    for (tool, at) in [("Axis.horizontal(y)", "0"), ("Axis.vertical(x)", "0")] {
        begin(&mut desk, tool);
        made(enter(&mut desk, at));
    }
    begin(&mut desk, "Line");
    enter(&mut desk, "5,5");
    made(enter(&mut desk, "9,5"));
    // it goes on, and has its first end again
    enter(&mut desk, "50,50");
    begin(&mut desk, "Point.intersection(first,second)");
    enter(&mut desk, "axis");
    let text = made(enter(&mut desk, "axis2"));
    assert_eq!(text, "Line(Point(50, 50), Point.intersection(axis, axis2))");
    // without any operand it has made what it should
    begin(&mut desk, "Point.middle(first,second)");
    enter(&mut desk, "line.p1");
    assert_eq!(made(enter(&mut desk, "line.p2")), "Point.middle(line.p1, line.p2)");
    // so may a copy
    begin(&mut desk, "Line");
    enter(&mut desk, "line.p1");
    begin(&mut desk, "Point:turned");
    point(&mut desk, 9.0, 5.0);
    enter(&mut desk, "line.p1");
    let text = made(enter(&mut desk, "90"));
    assert_eq!(text, "Line(line.p1, line.p2.turned(about: line.p1, by: 90 deg))");
    assert_eq!(value(&desk, "part.line3"), "(5, 5) to (5, 9)");
}

#[test]
fn the_newest_of_outlines_with_a_common_edge_is_meant() {
    let mut desk = Desk::of(
        "use contours
plate => Contour.box(of: Rectangle(Point(0, 0), 100, 60))
left: Circle { center = (20, 30)  radius = 8 }
right: Circle { center = (80, 30)  radius = 8 }
",
    );
    begin(&mut desk, "Region.difference(first,second)");
    for (x, text) in
        [(28.0, "Region.difference(plate, left)"), (72.0, "Region.difference(region, right)")]
    {
        point(&mut desk, 50.0, 0.0);
        assert_eq!(made(point(&mut desk, x, 30.0)), text);
    }
}

#[test]
fn what_is_typed_is_shown_with_what_it_comes_to() {
    let mut desk = Desk::recording("Nut", &[("s", "16")]);
    begin(&mut desk, "Circle");
    enter(&mut desk, "0,0");
    let nowhere = Pointer { reach: -1.0, ..Pointer::default() };
    let hover = desk.session.hover(desk.id, &nowhere, "s / (2 * cos(30 deg))");
    assert_eq!(hover.finds.as_deref(), Some("s / (2 * cos(30 deg)) = 9.2376 mm"));
    assert_eq!((hover.ghost.elements.len(), hover.why), (1, None));
    let hover = desk.session.hover(desk.id, &nowhere, "8");
    assert_eq!(hover.finds.as_deref(), Some("8"));
}

fn parameter(name: &str, example: &str, prompt: &str) -> NewParameter {
    NewParameter {
        name: name.into(),
        example: example.into(),
        prompt: prompt.into(),
        ..NewParameter::default()
    }
}

/// Records the rims of a washer.
fn washer() -> Desk {
    let mut desk = Desk::of("use geometry\nunit mm\n");
    desk.session.record(desk.id, "Washer").expect("a new program");
    for (name, example, prompt) in
        [("inner", "8.4", "Clearance hole?"), ("outer", "16", "Outer diameter?")]
    {
        let new = parameter(name, example, prompt);
        desk.session.define_parameter(desk.id, &new).expect("it is new");
    }
    begin(&mut desk, "Circle");
    enter(&mut desk, "0,0");
    made(enter(&mut desk, "inner / 2"));
    point(&mut desk, 0.1, 0.1);
    made(enter(&mut desk, "outer / 2"));
    desk
}

#[test]
fn a_washer_is_recorded() {
    let mut desk = washer();
    let text = desk.text();
    let wanted = "\
use geometry
unit mm

program Washer(
    inner: Length = 8.4 \"Clearance hole?\",
    outer: Length = 16 \"Outer diameter?\",
) {
    circle = Circle(center: Point(0, 0), radius: inner / 2)
    circle2 = Circle(center: circle.center, radius: outer / 2)
}
washer: Washer
";
    assert_eq!(text, wanted);
    assert_eq!(desk.wrong(), []);
    // begun, two parameters, two circles
    assert_eq!(desk.session.history(desk.id).0.len(), 5);
    desk.set("washer.inner", 10.0).expect("a parameter can be set");
    assert_eq!(value(&desk, "washer.circle.radius"), "5 mm");
    desk.session.stop_recording(desk.id).expect("nothing is open");
    assert!(desk.session.bin(desk.id).iter().any(|entry| entry.class == "Washer"));
    let other = desk.session.insertion(desk.id, "Washer");
    assert!(other.is_ok(), "{other:?}");
}

#[test]
fn steps_are_told_in_words_with_their_values() {
    let desk = washer();
    let view = desk.session.steps(desk.id, None).expect("it is recorded");
    assert_eq!(view.program, "Washer");
    assert_eq!(view.parameters[0].value, "8.4 mm");
    assert_eq!(view.rows[1].path, "circle2");
    assert_eq!(view.rows[1].words, "circle: center circle.center, radius outer / 2");
    assert_eq!(view.rows[1].value.as_deref(), Some("centre (0, 0), radius 8"));
    assert_eq!(desk.session.step_drawing(desk.id, "washer", "circle").elements.len(), 1);
}

#[test]
fn no_yes_or_no_is_offered_where_a_length_is_wanted() {
    let mut desk = Desk::recording("Bore", &[("d", "20"), ("keyed", "yes"), ("n", "4")]);
    begin(&mut desk, "Circle");
    enter(&mut desk, "0,0");
    assert_eq!(desk.session.value_parameters(desk.id), ["d", "n"]);
    made(enter(&mut desk, "d / 2"));
    desk.session.give_up(desk.id);
    // a value that is kept, and a condition, may be one
    begin(&mut desk, "value");
    assert_eq!(desk.session.value_parameters(desk.id), ["d", "keyed", "n"]);
    desk.session.give_up(desk.id);
    desk.session.begin_choice(desk.id).expect("it is recorded");
    assert_eq!(desk.session.value_parameters(desk.id), ["d", "keyed", "n"]);
}

#[test]
fn a_class_of_two_words_is_told_as_two_words() {
    let document = "use drafting
program Part(rim: EllipticArc) {
    arc = EllipticArc(Point(0, 0), 20, 10, 0 deg, 0 deg, 90 deg)
    arc2 = ClockwiseArc.through(Point(0, 0), Point(5, 5), Point(10, 0))
}
part: Part
";
    let mut desk = Desk::of(document);
    desk.session.record(desk.id, "Part").expect("it is recorded");
    let view = desk.session.steps(desk.id, None).expect("it is recorded");
    let words: Vec<&str> = view.rows.iter().map(|row| row.words.as_str()).collect();
    assert!(words[0].starts_with("elliptic arc: "), "{words:?}");
    assert!(words[1].starts_with("clockwise arc through: "), "{words:?}");
    begin(&mut desk, "Part");
    let prompt = desk.session.prompt(desk.id).expect("it asks");
    assert!(prompt.words.contains("pick an elliptic arc"), "{}", prompt.words);
}

#[test]
fn a_step_is_deleted_with_what_speaks_of_it_and_said_anew() {
    let mut desk = washer();
    assert_eq!(desk.session.step_dependents(desk.id, "Washer", "circle"), ["circle2"]);
    let refused = desk.session.replace_step(desk.id, ("Washer", "circle2"), "Circle(nowhere, 3)");
    assert!(refused.is_err());
    let formula = "Circle(center: circle.center, radius: outer)";
    desk.session.replace_step(desk.id, ("Washer", "circle2"), formula).expect("it fits");
    assert_eq!(value(&desk, "washer.circle2.radius"), "16 mm");
    desk.session.delete_step(desk.id, "Washer", "circle").expect("it can go");
    let view = desk.session.steps(desk.id, None).expect("it is recorded");
    assert!(view.rows.is_empty());
    desk.apply(&session::Command::Undo).expect("it comes back");
    assert_eq!(desk.session.steps(desk.id, None).expect("it is recorded").rows.len(), 2);
}

#[test]
fn a_name_of_a_class_is_none_for_a_program() {
    let mut desk = Desk::of(CORNER);
    let refused = desk.session.record(desk.id, "Circle").expect_err("there is one");
    assert_eq!(refused.message, "there is a class Circle already");
}

/// Records figure 7.6 up to the end of its first turn: two lines, then a ring that touches both and one around its
/// centre, whose radius is given.
fn rings(second_radius: &str) -> Desk {
    let mut desk = Desk::of("use geometry\nunit mm\n");
    desk.session.record(desk.id, "Rings").expect("a new program");
    for (name, example) in [("radius", "40"), ("least", "2")] {
        desk.session.define_parameter(desk.id, &parameter(name, example, "")).expect("it is new");
    }
    begin(&mut desk, "Axis.horizontal(y)");
    made(enter(&mut desk, "0"));
    begin(&mut desk, "Axis.vertical(x)");
    made(enter(&mut desk, "0"));
    desk.session.begin_loop(desk.id, "column").expect("a loop");
    begin(&mut desk, "Circle.tangent(first,second,radius)");
    point(&mut desk, -40.0, 0.0);
    point(&mut desk, 0.0, 40.0);
    assert_eq!(made(enter(&mut desk, "radius")), "Circle.tangent(axis, axis2, radius: radius)");
    begin(&mut desk, "Circle.concentric(with,radius)");
    point(&mut desk, -80.0, 40.0);
    made(enter(&mut desk, second_radius));
    desk
}

/// What is asked of the second turn now.
fn asked(desk: &Desk) -> Option<RecurrenceQuestion> {
    match desk.session.prompt(desk.id)?.wants {
        Wants::Recurrence(question) => Some(question),
        _ => None,
    }
}

#[test]
fn figure_7_6_is_drawn_by_its_first_turn_and_the_answers_for_the_second() {
    let mut desk = rings("circle.radius / 2");
    desk.session.end_turn(desk.id, Ends::Until).expect("the turn is drawn");
    let ask = asked(&desk).expect("it is asked");
    assert_eq!((ask.number, ask.of, &*ask.step, &*ask.first), (1, 3, "circle", "axis"));
    // the horizontal becomes the ring before, which is picked on the side of the vertical
    point(&mut desk, -20.0, 76.0);
    assert_eq!(asked(&desk).expect("it is asked").first, "axis2");
    desk.session.same(desk.id).expect("the same");
    let ask = asked(&desk).expect("it is asked");
    assert_eq!((&*ask.first, ask.is_value), ("radius", true));
    // of a value a pick is a measure
    match desk.session.point(desk.id, &pointer(-80.0, 40.0)).expect("a circle lies there") {
        Turn::Wants(prompt) => assert_eq!(prompt.insert.as_deref(), Some("circle.radius")),
        Turn::Made { .. } => panic!("it waits"),
    }
    enter(&mut desk, "circle.radius / 2");
    assert_eq!(asked(&desk), None);
    enter(&mut desk, "circle.radius < least");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    // 40, 20, 10, 5, 2.5, 1.25
    assert_eq!(value(&desk, "rings.column"), "6 turns");
    assert_eq!(value(&desk, "rings.column[5].circle.radius"), "1.25 mm");
    assert_eq!(value(&desk, "rings.column[5].circle2.radius"), "0.625 mm");
    // the centres are 60 apart, 20 of it sideways
    assert_eq!(value(&desk, "rings.column[1].circle"), "centre (-20, 96.5685), radius 20");
    desk.set("rings.least", 5.0).expect("a parameter can be set");
    assert_eq!(value(&desk, "rings.column"), "5 turns");
    let steps = desk.session.history(desk.id).0;
    assert_eq!(steps.iter().filter(|step| step.contains("column")).count(), 1, "{steps:?}");
    // the whole loop is mirrored by a pick of any of its circles
    begin(&mut desk, "Point:mirrored");
    desk.session.pick_wider(desk.id);
    desk.session.pick_wider(desk.id);
    point(&mut desk, -80.0, 40.0);
    assert_eq!(made(point(&mut desk, 0.0, 20.0)), "column.mirrored(about: axis2)");
    assert_eq!(value(&desk, "rings.mirrored"), "5 turns");
    assert_eq!(
        value(&desk, "rings.mirrored[1].circle"),
        "centre (20, 96.5685), radius 20, clockwise"
    );
}

#[test]
fn parameters_are_asked_about_in_whatever_letters_they_are_written() {
    for name in ["Radius", "半径"] {
        let mut desk = Desk::of("use geometry\nunit mm\n");
        desk.session.record(desk.id, "Rings").expect("a new program");
        desk.session.define_parameter(desk.id, &parameter(name, "40", "")).expect("it is new");
        desk.session.begin_loop(desk.id, "").expect("a loop");
        begin(&mut desk, "Circle");
        enter(&mut desk, "0,0");
        made(enter(&mut desk, name));
        desk.session.end_turn(desk.id, Ends::Until).expect("the turn is drawn");
        desk.session.same(desk.id).expect("the same place");
        let ask = asked(&desk).expect("it is asked");
        assert_eq!((&*ask.operand, &*ask.first), ("radius", name));
        enter(&mut desk, "circle.radius / 2");
        enter(&mut desk, "circle.radius < 2");
        assert_eq!(desk.wrong(), [], "{}", desk.text());
        assert_eq!(value(&desk, "rings.turns[5].circle.radius"), "1.25 mm");
    }
}

#[test]
fn an_answer_that_has_no_turn_is_refused() {
    let mut desk = rings("circle.radius / 2");
    desk.session.end_turn(desk.id, Ends::Until).expect("the turn is drawn");
    let refused = |desk: &mut Desk, typed: &str| {
        desk.session.enter(desk.id, typed).expect_err("it does not fit").message
    };
    assert!(refused(&mut desk, "circle9").contains("circle9"));
    assert!(!refused(&mut desk, "radius").is_empty(), "a number where a curve is wanted");
    let refused = desk.session.stop_recording(desk.id).expect_err("a loop is open");
    assert_eq!(refused.message, "column is open still: end it, or undo it, first");
}

/// Records figure 7.6 whole, with a wrong second circle: half of the parameter, not of the first circle's radius.
fn wrong_rings() -> Desk {
    let mut desk = rings("radius / 2");
    desk.session.end_turn(desk.id, Ends::Until).expect("the turn is drawn");
    point(&mut desk, -20.0, 76.0);
    desk.session.same(desk.id).expect("the same");
    enter(&mut desk, "circle.radius / 2");
    desk.session.same(desk.id).expect("half of the parameter in every turn");
    enter(&mut desk, "circle.radius < least");
    desk
}

#[test]
fn a_wrong_step_is_found_by_what_it_drew_and_replaced() {
    let mut desk = wrong_rings();
    assert_eq!(value(&desk, "rings.column[2].circle2.radius"), "20 mm");
    // the third turn's outer circle is picked, at its left: the program is run until it is drawn
    let third = value(&desk, "rings.column[2].circle");
    assert_eq!(third, "centre (-10, 124.8528), radius 10");
    desk.session.visit(desk.id, &Go::UntilPicked(pointer(-20.0, 124.85))).expect("it lies there");
    let view = desk.session.steps(desk.id, None).expect("it is recorded");
    assert_eq!(view.at.as_deref(), Some("column.circle"));
    // without a pointer it is one of what the program draws, by its name
    desk.session.visit(desk.id, &Go::End).expect("there is one");
    let names = desk.session.drawn_names(desk.id);
    assert!(names.contains(&"column[2].circle".to_string()), "{names:?}");
    assert!(!desk.session.drawn_by_name(desk.id, "column[2].circle").elements.is_empty());
    desk.session.visit(desk.id, &Go::UntilDrawn("column[2].circle".into())).expect("it is drawn");
    let view = desk.session.steps(desk.id, None).expect("it is recorded");
    assert_eq!(view.at.as_deref(), Some("column.circle"));
    let none = desk.session.visit(desk.id, &Go::UntilDrawn("nothing".into())).expect_err("none");
    assert_eq!(none.message, "Rings draws no nothing");
    // the rows tell the third turn, and say so
    let told = |desk: &Desk, path: &str| {
        let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
        rows.into_iter().find(|row| row.path == path).and_then(|row| row.value)
    };
    assert_eq!(told(&desk, "column").as_deref(), Some("turn 3 of 6"));
    assert_eq!(told(&desk, "column.circle"), Some(third));
    let radius = |desk: &Desk| {
        let operands = desk.session.step_operands(desk.id, ("rings", "column.circle"), None);
        let radius = operands.into_iter().find(|operand| operand.slot == "radius");
        radius.and_then(|radius| Some((radius.value?, radius.along?[0])))
    };
    let (size, (x, y)) = radius(&desk).expect("a circle has a radius");
    assert_eq!(size, "10 mm");
    assert!((x + 10.0).abs() < 1e-4 && (y - 124.8528).abs() < 1e-4, "{x} {y}");
    // a row of it leads to that turn, and not to the first
    desk.session.visit(desk.id, &Go::To("column.circle2".into())).expect("it is a step");
    assert_eq!(told(&desk, "column").as_deref(), Some("turn 3 of 6"));
    desk.session.visit(desk.id, &Go::To("column.circle".into())).expect("it is a step");
    // they tell it as well while a loop is drawn in it
    desk.session.begin_loop(desk.id, "").expect("it is written there");
    assert_eq!(told(&desk, "column").as_deref(), Some("turn 3 of 6"));
    desk.undo();
    assert_eq!(told(&desk, "column").as_deref(), Some("turn 3 of 6"));
    // two turns are drawn before it, and both lines
    let drawn = desk.session.drawn_so_far(desk.id).expect("it is visited");
    assert_eq!(drawn.elements.len(), 2 + 4);
    // the second circle is drawn anew: half of the first circle's radius
    desk.session.begin_replace(desk.id, "column.circle2").expect("it is a step");
    begin(&mut desk, "Circle.concentric(with,radius)");
    point(&mut desk, -20.0, 124.85);
    made(enter(&mut desk, "circle.radius / 2"));
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "rings.column[5].circle2.radius"), "0.625 mm");
    assert_eq!(value(&desk, "rings.column"), "6 turns");
    desk.apply(&session::Command::Undo).expect("one step");
    assert_eq!(value(&desk, "rings.column[2].circle2.radius"), "20 mm");
}

#[test]
fn a_visit_leaves_a_turn_that_is_no_longer_come_to() {
    let mut desk = wrong_rings();
    desk.session.visit(desk.id, &Go::UntilPicked(pointer(-20.0, 124.85))).expect("it lies there");
    let told = |desk: &Desk| {
        let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
        rows.into_iter().find(|row| row.path == "column").and_then(|row| row.value)
    };
    assert_eq!(told(&desk).as_deref(), Some("turn 3 of 6"));
    // the second circle's radius of 20 is less
    let by = [("least".to_string(), "25".to_string())];
    desk.session.visit_by(desk.id, &by).expect("it is a value");
    assert_eq!(told(&desk).as_deref(), Some("turn 2 of 2"));
    let view = desk.session.steps(desk.id, None).expect("it is recorded");
    assert_eq!(view.at.as_deref(), Some("column.circle"));
    // the lines, both of the first turn's circles
    let drawn = desk.session.drawn_so_far(desk.id).expect("it is visited");
    assert_eq!(drawn.elements.len(), 2 + 2);
}

#[test]
fn what_undo_takes_back_is_recorded_no_longer() {
    let mut desk = Desk::recording("Ring", &[]);
    desk.session.begin_loop(desk.id, "").expect("it is written");
    desk.undo();
    let view = desk.session.steps(desk.id, None).expect("it is recorded");
    assert!(view.open.is_empty());
    desk.undo();
    assert_eq!(
        (desk.session.recorded(desk.id), desk.session.recorded_example(desk.id)),
        (None, None)
    );
}

#[test]
fn a_visit_goes_step_by_step_and_what_is_drawn_is_inserted() {
    let mut desk = wrong_rings();
    let at = |desk: &Desk| desk.session.steps(desk.id, None).expect("recorded").at;
    let go = |desk: &mut Desk, go: Go| desk.session.visit(desk.id, &go).expect("there is a way");
    go(&mut desk, Go::Start);
    assert_eq!(at(&desk).as_deref(), Some("axis"));
    go(&mut desk, Go::Step);
    go(&mut desk, Go::Step);
    assert_eq!(at(&desk).as_deref(), Some("column"));
    go(&mut desk, Go::In);
    assert_eq!(at(&desk).as_deref(), Some("column.circle"));
    go(&mut desk, Go::Step);
    assert_eq!(at(&desk).as_deref(), Some("column.circle2"));
    begin(&mut desk, "Point.projection(of,onto)");
    // what comes later cannot be picked: the inner circle is not made yet
    point(&mut desk, -40.0, 40.0);
    assert_eq!(
        made(point(&mut desk, -40.0, 0.0)),
        "Point.projection(of: circle.center, onto: axis)"
    );
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "rings.column[0].point"), "(-40, 0)");
    go(&mut desk, Go::Back);
    go(&mut desk, Go::Back);
    assert_eq!(at(&desk).as_deref(), Some("column.circle"));
    go(&mut desk, Go::Out);
    assert_eq!(at(&desk), None);
    go(&mut desk, Go::End);
    begin(&mut desk, "Axis.horizontal(y)");
    made(enter(&mut desk, "-10"));
    assert!(desk.text().contains("least\n    axis3 = "), "{}", desk.text());
}

#[test]
fn a_step_is_deleted_and_each_dependent_asked_for_another_object() {
    let mut desk = washer();
    begin(&mut desk, "Circle");
    enter(&mut desk, "30,0");
    made(enter(&mut desk, "3"));
    // circle3 does not fit circle2: it is made later
    desk.session.begin_delete(desk.id, "circle").expect("it is a step");
    match desk.session.prompt(desk.id).expect("it is asked").wants {
        Wants::Substitute { step, gone } => assert_eq!((&*step, &*gone), ("circle2", "circle")),
        other => panic!("{other:?}"),
    }
    let late = desk.session.enter(desk.id, "circle3.center").expect_err("it is made later");
    assert!(late.message.contains("circle3"), "{}", late.message);
    desk.session.back(desk.id);
    assert_eq!(desk.session.prompt(desk.id), None);
    desk.session.begin_delete(desk.id, "circle").expect("it is a step");
    desk.session.delete_along(desk.id).expect("it is asked");
    let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
    assert_eq!(rows.iter().map(|row| &*row.path).collect::<Vec<_>>(), ["circle3"]);
    desk.apply(&session::Command::Undo).expect("one step");
    // a line between two centres, of which one goes
    begin(&mut desk, "Line");
    point(&mut desk, 30.0, 0.0);
    made(point(&mut desk, 0.0, 0.0));
    assert!(desk.text().contains("line = Line(circle3.center, circle.center)"), "{}", desk.text());
    desk.session.begin_delete(desk.id, "circle3").expect("it is a step");
    // the line speaks of a circle: another one is picked
    point(&mut desk, 0.0, 8.0);
    assert!(desk.text().contains("line = Line(circle2.center, circle.center)"), "{}", desk.text());
    assert_eq!(desk.wrong(), []);
}

#[test]
fn an_if_is_drawn_by_two_demonstrations() {
    let mut desk = Desk::of("use geometry\nunit mm\n");
    desk.session.record(desk.id, "Bolt").expect("a new program");
    for (name, example) in [("d", "10"), ("length", "60")] {
        desk.session.define_parameter(desk.id, &parameter(name, example, "")).expect("it is new");
    }
    let condition = |desk: &mut Desk, text: &str| {
        desk.session.begin_choice(desk.id).expect("it is recorded");
        enter(desk, text);
    };
    let measured = |desk: &mut Desk, text: &str| {
        begin(desk, "value");
        made(enter(desk, text));
    };
    condition(&mut desk, "length <= 125");
    measured(&mut desk, "2 * d + 6");
    desk.session.otherwise(desk.id).expect("the first branch is drawn");
    let early = desk.session.other_branch(desk.id, false).expect_err("the values are the same");
    assert!(early.message.contains("still holds"), "{}", early.message);
    desk.set("bolt.length", 150.0).expect("a parameter can be set");
    desk.session.other_branch(desk.id, false).expect("the values take it");
    // the third way stands in the second
    condition(&mut desk, "length <= 200");
    measured(&mut desk, "2 * d + 12");
    desk.session.otherwise(desk.id).expect("the first branch is drawn");
    desk.session.other_branch(desk.id, true).expect("with the same values");
    measured(&mut desk, "2 * d + 25");
    assert_eq!(value(&desk, "bolt.value"), "45 mm");
    desk.session.end_choice(desk.id).expect("it is open");
    assert_eq!(value(&desk, "bolt.value"), "32 mm");
    desk.session.end_choice(desk.id).expect("it is open");
    // the example has its own values again, and the value is one, whichever branch ran
    assert_eq!(value(&desk, "bolt.length"), "60 mm");
    assert_eq!(value(&desk, "bolt.value"), "26 mm");
    // only the branch that is taken says what it made
    let said = |desk: &Desk| -> Vec<Option<String>> {
        let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
        rows.into_iter().filter(|row| row.name == "value").map(|row| row.value).collect()
    };
    assert_eq!(said(&desk), [Some("26 mm".into()), None, None]);
    begin(&mut desk, "Line.horizontal(from,length)");
    enter(&mut desk, "0,0");
    made(enter(&mut desk, "value"));
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    // thread lengths of ISO 4014
    for (length, thread) in [(60.0, "26"), (140.0, "32"), (220.0, "45")] {
        desk.set("bolt.length", length).expect("a parameter can be set");
        assert_eq!(value(&desk, "bolt.line.length"), format!("{thread} mm"));
    }
    assert_eq!(said(&desk), [None, None, Some("45 mm".into())]);
    let steps = desk.session.history(desk.id).0;
    assert_eq!(steps.iter().filter(|step| step.starts_with("if ")).count(), 1, "{steps:?}");
}

/// A program that draws two circles and has begun a loop over both.
fn each_of_two_circles() -> Desk {
    let mut desk = Desk::recording("Plate", &[]);
    for at in ["10,10", "50,10"] {
        begin(&mut desk, "Circle");
        enter(&mut desk, at);
        made(enter(&mut desk, "4"));
    }
    desk.session.begin_each(desk.id, ((0.0, 0.0), (100.0, 100.0))).expect("two circles");
    desk
}

#[test]
fn what_stands_on_each_of_a_set_is_drawn_on_each_and_not_on_the_one_before() {
    for answers in
        [["element.center", "element.radius * 2"], ["circle2.center", "circle2.radius * 2"]]
    {
        let mut desk = Desk::recording("Plate", &[]);
        for (at, radius) in [("10,10", "4"), ("50,10", "2"), ("90,70", "5")] {
            begin(&mut desk, "Circle");
            enter(&mut desk, at);
            made(enter(&mut desk, radius));
        }
        desk.session.begin_each(desk.id, ((0.0, 0.0), (100.0, 100.0))).expect("three circles");
        begin(&mut desk, "Circle");
        enter(&mut desk, "circle.center");
        made(enter(&mut desk, "circle.radius * 2"));
        desk.session.end_turn(desk.id, Ends::Until).expect("it is drawn");
        // the second of the set may be shown for what it is in turn
        for answer in answers {
            enter(&mut desk, answer);
        }
        let each = "circle4 = Circle(center: element.center, radius: element.radius * 2)";
        assert!(desk.text().contains(each), "{}", desk.text());
        assert_eq!(value(&desk, "plate.turns[1].circle4"), "centre (50, 10), radius 4");
        assert_eq!(value(&desk, "plate.turns[2].circle4"), "centre (90, 70), radius 10");
    }
}

#[test]
fn what_is_asked_of_the_first_of_a_set_is_forgotten_where_undo_brings_another() {
    let mut desk = each_of_two_circles();
    begin(&mut desk, "Circle");
    enter(&mut desk, "circle2.center");
    made(enter(&mut desk, "1"));
    desk.session.take_of_set(desk.id, "circle").expect("nothing is drawn for it");
    desk.session.end_turn(desk.id, Ends::Until).expect("it is drawn");
    assert_eq!(asked(&desk).expect("it is asked").first, "circle2.center");
    desk.undo();
    let stale = desk.session.enter(desk.id, "element").expect_err("circle is the first now");
    assert_eq!(stale.message, "nothing can be typed now: choose what to draw first");
    assert!(asked(&desk).is_none());
    let open = desk.session.steps(desk.id, None).expect("it is recorded").open;
    assert_eq!(open[0].words, "turns: draw what is done for circle, the first of the set");
}

#[test]
fn comments_in_a_set_stay_where_it_is_changed() {
    let mut desk = Desk::recording("Plate", &[]);
    for at in ["10,10", "50,10", "90,70"] {
        begin(&mut desk, "Circle");
        enter(&mut desk, at);
        made(enter(&mut desk, "4"));
    }
    desk.session.begin_each(desk.id, ((0.0, 0.0), (100.0, 100.0))).expect("three circles");
    let noted = "in [\n        circle, // the first, by the edge\n        circle2, // by the slot\n        \
                 circle3 // up there\n    ] {";
    let edited = desk.text().replace("in [circle, circle2, circle3] {", noted);
    desk.type_text(&edited);
    let comments = ["// the first, by the edge", "// by the slot", "// up there"];
    for left_out in ["circle2", "circle3", "circle"] {
        for _ in ["left out", "taken in"] {
            desk.session.take_of_set(desk.id, left_out).expect("two are left");
            let text = desk.text();
            assert!(comments.iter().all(|comment| text.contains(comment)), "{left_out}: {text}");
            assert_eq!(desk.wrong(), [], "{text}");
        }
        let open = desk.session.steps(desk.id, None).expect("it is recorded").open;
        assert_eq!(open[0].words, "turns: draw what is done for circle, the first of the set");
    }
}

#[test]
fn a_figure_that_stands_twice_in_a_set_is_left_out_wherever_it_stands() {
    let mut desk = each_of_two_circles();
    let twice = "in [circle, circle2, circle2] {";
    desk.type_text(&desk.text().replace("in [circle, circle2] {", twice));
    assert!(desk.text().contains(twice), "{}", desk.text());
    desk.session.take_of_set(desk.id, "circle2").expect("one is left");
    assert!(desk.text().contains("in [circle] {"), "{}", desk.text());
    assert_eq!(desk.wrong(), []);
}

#[test]
fn a_loop_runs_over_what_a_rubber_band_catches() {
    let mut desk = Desk::of("use geometry\nunit mm\n");
    desk.session.record(desk.id, "Plate").expect("a new program");
    for at in ["10,10", "50,10", "90,70"] {
        begin(&mut desk, "Circle");
        enter(&mut desk, at);
        made(enter(&mut desk, "4"));
    }
    let nothing = desk.session.begin_each(desk.id, ((200.0, 200.0), (300.0, 300.0)));
    assert!(nothing.is_err());
    begin(&mut desk, "Rectangle.between(first,second)");
    enter(&mut desk, "0,-60");
    made(enter(&mut desk, "40,-50"));
    desk.session.begin_each(desk.id, ((0.0, 0.0), (100.0, 100.0))).expect("three circles");
    let first = |desk: &Desk| {
        let open = desk.session.steps(desk.id, None).expect("it is recorded").open;
        open[0].words.clone()
    };
    assert_eq!(first(&desk), "turns: draw what is done for circle, the first of the set");
    // one is left out by a click, and comes back to its place by its name
    let figure = desk.session.of_set_at(desk.id, &pointer(14.0, 10.0)).expect("it lies there");
    desk.session.take_of_set(desk.id, &figure).expect("two are left");
    assert!(desk.text().contains("for element in [circle2, circle3] {"), "{}", desk.text());
    assert_eq!(first(&desk), "turns: draw what is done for circle2, the first of the set");
    assert_eq!(desk.session.set_drawing(desk.id).elements.len(), 2);
    desk.undo();
    assert_eq!(first(&desk), "turns: draw what is done for circle, the first of the set");
    desk.session.take_of_set(desk.id, "circle").expect("two are left");
    desk.session.take_of_set(desk.id, "circle").expect("it was caught");
    assert!(desk.text().contains("for element in [circle, circle2, circle3] {"), "{}", desk.text());
    let of_two_kinds = desk.session.take_of_set(desk.id, "rectangle").expect_err("it is no circle");
    assert_eq!(
        of_two_kinds.message,
        "a loop goes over figures of one kind: 3 Circle and 1 Rectangle would be in this one"
    );
    desk.session.take_of_set(desk.id, "circle3").expect("two are left");
    let of_two_kinds = desk.session.take_of_set(desk.id, "rectangle").expect_err("it is no circle");
    assert!(of_two_kinds.message.contains("2 Circle and 1 Rectangle"), "{}", of_two_kinds.message);
    desk.session.take_of_set(desk.id, "circle3").expect("it was caught");
    begin(&mut desk, "Circle.concentric(with,radius)");
    point(&mut desk, 14.0, 10.0);
    made(enter(&mut desk, "circle.radius + 2"));
    for none in ["", "circle2, circle3", "turns", "element"] {
        let refused = desk.session.take_of_set(desk.id, none).expect_err("it is no figure");
        assert_eq!(refused.message, format!("no figure called `{none}` was drawn before the loop"));
    }
    // what is drawn in the turn is none of the set
    assert_eq!(desk.session.of_set_at(desk.id, &pointer(16.0, 10.0)), Some("circle".into()));
    begin(&mut desk, "Circle");
    enter(&mut desk, "200,0");
    made(enter(&mut desk, "1"));
    assert_eq!(desk.session.of_set_at(desk.id, &pointer(201.0, 0.0)), None);
    desk.undo();
    let begun = desk.session.take_of_set(desk.id, "circle").expect_err("it is drawn for this one");
    assert!(begun.message.starts_with("the first turn is drawn for circle"), "{}", begun.message);
    desk.session.end_turn(desk.id, Ends::Until).expect("it is drawn");
    assert_eq!(desk.session.of_set_at(desk.id, &pointer(54.0, 10.0)), None, "it is asked about");
    // both the circle and its radius: each in turn
    for answer in ["element", "element.radius + 2"] {
        let question = asked(&desk).expect("it is asked");
        assert_eq!(question.in_turn.as_deref(), Some(answer));
        enter(&mut desk, answer);
    }
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "plate.turns"), "3 turns");
    assert_eq!(value(&desk, "plate.turns[2].circle4"), "centre (90, 70), radius 6");
    let everything = ((-10.0, -10.0), (100.0, 220.0));
    desk.session.begin_each(desk.id, everything).expect("six circles");
    let none_twice = "turns2 = for element2 in \
                      [circle, circle2, circle3, turns[0].circle4, turns[1].circle4, turns[2].circle4] {";
    assert!(desk.text().contains(none_twice), "{}", desk.text());
    desk.undo();
    begin(&mut desk, "Rectangle.between(first,second)");
    enter(&mut desk, "0,200");
    made(enter(&mut desk, "10,210"));
    let mixed = desk.session.begin_each(desk.id, everything).expect_err("they are of two kinds");
    assert_eq!(
        mixed.message,
        "6 Circle and 1 Rectangle lie in that rectangle: a loop goes over figures of one kind, so draw it \
         around those"
    );
}

#[test]
fn a_plate_is_perforated_by_a_loop_in_a_loop() {
    let mut desk = Desk::of("use geometry\nunit mm\n");
    desk.session.record(desk.id, "Plate").expect("a new program");
    for (name, example) in [("pitch", "8"), ("hole", "5")] {
        desk.session.define_parameter(desk.id, &parameter(name, example, "")).expect("it is new");
    }
    for (name, example) in [("rows", "5"), ("columns", "8")] {
        let whole = NewParameter { class: "Integer".into(), ..parameter(name, example, "") };
        desk.session.define_parameter(desk.id, &whole).expect("it is new");
    }
    desk.session.begin_loop(desk.id, "grid").expect("a loop");
    desk.session.begin_loop(desk.id, "row").expect("a loop in it");
    begin(&mut desk, "Circle");
    enter(&mut desk, "pitch / 2,pitch / 2");
    made(enter(&mut desk, "hole / 2"));
    desk.session.end_turn(desk.id, Ends::Times).expect("it is drawn");
    enter(&mut desk, "Point(circle.center.x + pitch, circle.center.y)");
    desk.session.same(desk.id).expect("the hole is the same");
    enter(&mut desk, "columns");
    assert_eq!(value(&desk, "plate.grid[0].row"), "8 turns");
    desk.session.end_turn(desk.id, Ends::Times).expect("it is drawn");
    let mut answered = Vec::new();
    while let Some(question) = asked(&desk) {
        let words = desk.session.prompt(desk.id).expect("it is asked").words;
        answered.push((question.operand.clone(), words.contains("how far on")));
        assert!(answered.len() < 20, "{question:?}");
        match question.first.starts_with("Point(pitch / 2") {
            true => {
                let next = "Point(row[0].circle.center.x, row[0].circle.center.y + pitch)";
                enter(&mut desk, next);
            }
            false => _ = desk.session.same(desk.id).expect("the same"),
        }
    }
    // what the inner loop carries on goes on from a place within it
    let last = answered.last().map(|(operand, goes_on)| (operand.as_str(), *goes_on));
    assert_eq!(last, Some(("next center", false)), "{answered:?}");
    enter(&mut desk, "rows");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "plate.grid"), "5 turns");
    assert_eq!(value(&desk, "plate.grid[4].row[7].circle"), "centre (60, 36), radius 2.5");
    // the third hole of the second row is picked: its rows and numbers are those of both turns
    let rim = Pointer { reach: 0.5, ..pointer(22.5, 12.0) };
    desk.session.visit(desk.id, &Go::UntilPicked(rim)).expect("it lies there");
    let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
    let told: Vec<_> = rows.into_iter().filter_map(|row| Some((row.path, row.value?))).collect();
    let wanted = [
        ("grid", "turn 2 of 5"),
        ("grid.row", "turn 3 of 8"),
        ("grid.row.circle", "centre (20, 12), radius 2.5"),
    ];
    assert_eq!(told, wanted.map(|(path, value)| (path.to_string(), value.to_string())));
    let operands = desk.session.step_operands(desk.id, ("plate", "grid.row.circle"), None);
    let radius = operands.into_iter().find(|operand| operand.slot == "radius").expect("it has one");
    assert_eq!(radius.along.expect("it is seen")[0], (20.0, 12.0));
    let drawn = desk.session.drawn_so_far(desk.id).expect("it is visited");
    assert_eq!(drawn.elements.len(), 8 + 2);
}

#[test]
fn the_curve_of_koch_is_drawn_by_applying_the_program_within_itself() {
    let mut desk = Desk::of("use geometry\nunit mm\n");
    desk.session.record(desk.id, "Koch").expect("a new program");
    for (name, class, example) in
        [("from", "Point", "(0, 0)"), ("to", "Point", "(90, 0)"), ("depth", "", "0")]
    {
        let new = NewParameter { class: class.into(), ..parameter(name, example, "") };
        desk.session.define_parameter(desk.id, &new).expect("it is new");
    }
    desk.session.begin_choice(desk.id).expect("it is recorded");
    enter(&mut desk, "depth = 0");
    begin(&mut desk, "Line");
    enter(&mut desk, "from");
    made(enter(&mut desk, "to"));
    desk.session.otherwise(desk.id).expect("the first branch is drawn");
    desk.set("koch.depth", 1.0).expect("a parameter can be set");
    desk.session.other_branch(desk.id, false).expect("the values take it");
    for ratio in ["1 / 3", "2 / 3"] {
        begin(&mut desk, "Point.dividing(first,second,ratio)");
        enter(&mut desk, "from");
        enter(&mut desk, "to");
        made(enter(&mut desk, ratio));
    }
    begin(&mut desk, "Point:turned");
    point(&mut desk, 60.0, 0.0);
    point(&mut desk, 30.0, 0.0);
    made(enter(&mut desk, "60"));
    for (from, to) in
        [("from", "point"), ("point", "turned"), ("turned", "point2"), ("point2", "to")]
    {
        begin(&mut desk, "Koch");
        enter(&mut desk, from);
        enter(&mut desk, to);
        made(enter(&mut desk, "depth - 1"));
        // what counts the calls is no length, which it was defined as
        assert!(desk.text().contains("    depth: Integer = 0,\n"), "{}", desk.text());
    }
    desk.session.end_choice(desk.id).expect("it is open");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    desk.set("koch.depth", 3.0).expect("a parameter can be set");
    // sides of a twenty-seventh
    assert_eq!(value(&desk, "koch.koch.koch.koch.line.length"), "3.33333 mm");
}

/// The formula of every step of what is recorded, by its address.
fn formulas(desk: &Desk) -> std::collections::BTreeMap<String, String> {
    let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
    rows.into_iter().map(|row| (row.path, row.formula)).collect()
}

/// Numbers that look random, the same in every run.
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % n.max(1)
    }
}

#[test]
fn random_insertions_replacements_and_deletions_change_no_other_step() {
    for seed in 0..3 {
        let mut dice = Dice(seed);
        let mut desk = Desk::of("use geometry\nunit mm\n");
        desk.session.record(desk.id, "Part").expect("a new program");
        for round in 0..12 {
            let (text, before) = (desk.text(), formulas(&desk));
            let names: Vec<String> = before.keys().cloned().collect();
            let (undo, _) = desk.session.history(desk.id);
            let mut touched: Vec<String> = Vec::new();
            let drawn = |desk: &mut Desk, dice: &mut Dice| {
                // a circle about a point, or about another circle's centre, where one can be spoken of
                begin(desk, "Circle");
                let place = format!("{},{}", dice.below(90), dice.below(90));
                let of = names.get(dice.below(2 * names.len().max(1)));
                let center = of.map_or(place.clone(), |name| format!("{name}.center"));
                if desk.session.enter(desk.id, &center).is_err() {
                    enter(desk, &place);
                }
                desk.session.enter(desk.id, &format!("{}", 1 + dice.below(9))).is_ok()
            };
            match (dice.below(4), names.get(dice.below(names.len()))) {
                (0, Some(step)) => {
                    desk.session.begin_replace(desk.id, step).expect("it is a step");
                    if !drawn(&mut desk, &mut dice) {
                        desk.session.give_up(desk.id);
                    }
                    touched.push(step.clone());
                }
                (1, Some(step)) => {
                    let told = desk.session.step_dependents(desk.id, "Part", step);
                    desk.session.begin_delete(desk.id, step).expect("it is a step");
                    touched.push(step.clone());
                    while let Some(Wants::Substitute { step: user, .. }) =
                        desk.session.prompt(desk.id).map(|prompt| prompt.wants)
                    {
                        assert!(told.contains(&user), "{user} was not told: {told:?}");
                        touched.push(user);
                        let other = names.get(dice.below(3 * names.len())).cloned();
                        let is_given =
                            other.is_some_and(|other| desk.session.enter(desk.id, &other).is_ok());
                        if !is_given {
                            desk.session.delete_along(desk.id).expect("it is asked");
                        }
                    }
                }
                (_, step) => {
                    let place = step.map_or(Go::End, |step| Go::To(step.clone()));
                    desk.session.visit(desk.id, &place).expect("there is such a place");
                    drawn(&mut desk, &mut dice);
                }
            }
            desk.session.give_up(desk.id);
            let after = formulas(&desk);
            assert_eq!(desk.wrong(), [], "seed {seed}, round {round}: {}", desk.text());
            for (step, formula) in before.iter().filter(|(step, _)| !touched.contains(step)) {
                assert_eq!(after.get(step), Some(formula), "seed {seed}, round {round}: {step}");
            }
            for _ in undo.len()..desk.session.history(desk.id).0.len() {
                desk.apply(&session::Command::Undo).expect("a step");
            }
            assert_eq!(desk.text(), text, "undo is exact");
            for _ in undo.len()..undo.len() + desk.session.history(desk.id).1.len() {
                desk.apply(&session::Command::Redo).expect("a step");
            }
            assert_eq!(formulas(&desk), after);
        }
    }
}

#[test]
fn what_a_program_drew_is_deleted_by_erasing_it_or_its_step() {
    let text = "use geometry
program Plate(width: Length = 40 mm) {
    hole = Circle(center: (0, 0), radius: width / 4)
    rim = Circle(center: hole.center, radius: width / 2)
    rows = repeat 3 times with x = 0 mm {
        dot = Point(x, width)
        next x = x + 10 mm
    }
}
plate: Plate
other: Plate { width = 60 mm }
";
    let mut desk = Desk::of(text);
    let asked = |desk: &Desk, path: &str| {
        let question = desk.session.drawn_deletion(desk.id, &at(path)).expect("it can go");
        question.expect("a program drew it")
    };
    let question = asked(&desk, "plate.hole");
    assert_eq!(question.message, "hole is drawn by the program Plate: all 2 here change with it.");
    let labels: Vec<&str> = question.choices.iter().map(|c| c.label.as_str()).collect();
    assert_eq!(
        labels,
        ["erase hole; one step still needs it", "delete the step hole, and with it rim"]
    );
    desk.apply(&question.choices[0].command).expect("it can be erased");
    let rows = "    }\n}\nplate";
    assert_eq!(desk.text(), text.replace(rows, "    }\n    erase hole\n}\nplate"));
    assert_eq!(desk.wrong(), []);
    desk.undo();
    assert_eq!(desk.text(), text);
    desk.apply(&question.choices[1].command).expect("the step can go");
    assert!(!desk.text().contains("rim") && desk.text().contains("dot"), "{}", desk.text());
    desk.undo();
    // in a loop, all its turns; a place of a circle means the circle
    let question = asked(&desk, "other.rows[1].dot");
    desk.apply(&question.choices[0].command).expect("it can be erased");
    assert!(desk.text().contains("        erase dot\n    }"), "{}", desk.text());
    assert!(asked(&desk, "plate.rim.center").message.starts_with("rim is drawn"));
    // a parameter is no drawing, nor is anything that no program made
    for path in ["plate.width", "plate"] {
        assert_eq!(desk.session.drawn_deletion(desk.id, &at(path)), Ok(None));
    }
}
