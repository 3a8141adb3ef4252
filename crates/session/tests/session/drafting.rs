//! Constructions chosen and given their operands; programs recorded so.

use crate::desk::Desk;
use session::drafting::view::{NewParameter, Turn};
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
        "Circle:mirrored",
        "Circle:at",
    ] {
        assert!(has(id), "{id}: {:?}", tools.iter().map(|t| &t.id).collect::<Vec<_>>());
    }
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
fn what_does_not_fit_is_refused_and_waited_for() {
    let mut desk = Desk::of(CORNER);
    begin(&mut desk, "Circle.tangent(first,second,radius)");
    let refused = |desk: &mut Desk, typed: &str| {
        desk.session.enter(desk.id, typed).expect_err("it does not fit").message
    };
    assert_eq!(refused(&mut desk, "floor.p1"), "floor.p1 is a Point, where a Curve is wanted");
    assert!(refused(&mut desk, "ceiling").contains("ceiling"));
    let nothing = desk.session.point(desk.id, &pointer(50.0, 50.0)).expect_err("nothing is there");
    assert_eq!(nothing.message, "there is no curve here");
    enter(&mut desk, "floor");
    enter(&mut desk, "floor");
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
    assert_eq!(hover.ghost.elements.len(), 1);
    // a measure is what is picked for a value
    let hover = desk.session.hover(desk.id, &pointer(0.0, 50.0), "");
    assert!(hover.why.is_some(), "an axis has no length");
    assert_eq!(desk.text(), CORNER);
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
    assert_eq!(value(&desk, "washer.circle.radius"), "5");
    desk.session.stop_recording(desk.id);
    assert!(desk.session.bin(desk.id).iter().any(|entry| entry.class == "Washer"));
    let other = desk.session.insertion(desk.id, "Washer");
    assert!(other.is_ok(), "{other:?}");
}

#[test]
fn steps_are_told_in_words_with_their_values() {
    let desk = washer();
    let view = desk.session.steps(desk.id, None).expect("it is recorded");
    assert_eq!(view.program, "Washer");
    assert_eq!(view.parameters[0].value, "8.4");
    assert_eq!(view.rows[1].path, "circle2");
    assert_eq!(view.rows[1].words, "circle: center circle.center, radius outer / 2");
    assert_eq!(view.rows[1].value.as_deref(), Some("centre (0, 0), radius 8"));
    assert_eq!(desk.session.step_drawing(desk.id, "washer", "circle").elements.len(), 1);
}

#[test]
fn a_step_is_deleted_with_what_speaks_of_it_and_said_anew() {
    let mut desk = washer();
    assert_eq!(desk.session.step_dependents(desk.id, "Washer", "circle"), ["circle2"]);
    let refused = desk.session.replace_step(desk.id, ("Washer", "circle2"), "Circle(nowhere, 3)");
    assert!(refused.is_err());
    let formula = "Circle(center: circle.center, radius: outer)";
    desk.session.replace_step(desk.id, ("Washer", "circle2"), formula).expect("it fits");
    assert_eq!(value(&desk, "washer.circle2.radius"), "16");
    desk.session.delete_step(desk.id, "Washer", "circle").expect("it can go");
    let view = desk.session.steps(desk.id, None).expect("it is recorded");
    assert!(view.rows.is_empty());
    desk.apply(&session::Command::Undo).expect("it comes back");
    assert_eq!(desk.session.steps(desk.id, None).expect("it is recorded").rows.len(), 2);
}

#[test]
fn what_is_outside_of_a_recorded_program_cannot_be_picked() {
    let mut desk = Desk::of(CORNER);
    desk.session.record(desk.id, "Ball").expect("a new program");
    begin(&mut desk, "Circle.tangent(first,second,radius)");
    let refused = desk.session.point(desk.id, &pointer(50.0, 0.0)).expect_err("it is outside");
    assert_eq!(refused.message, "floor is outside of the program that is recorded");
    let refused = desk.session.record(desk.id, "Circle").expect_err("there is one");
    assert_eq!(refused.message, "there is a class Circle already");
}

/// Records figure 7.6 up to its loop: two lines, then a ring that touches both and one around its centre.
fn rings() -> Desk {
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
    made(enter(&mut desk, "circle.radius / 2"));
    desk
}

#[test]
fn figure_7_6_is_drawn_by_its_first_turn_and_the_answers_for_the_second() {
    let mut desk = rings();
    let ask = desk.session.end_turn(desk.id).expect("the turn is drawn").expect("it is asked");
    assert_eq!((ask.number, ask.of, &*ask.step, &*ask.first), (1, 3, "circle", "axis"));
    // the horizontal becomes the ring before, which is picked on the side of the vertical
    let at = Some((-20.0, 76.0));
    let ask = desk.session.answer_recurrence(desk.id, Some("circle"), at);
    let ask = ask.expect("it fits").expect("it is asked");
    assert_eq!(&*ask.first, "axis2");
    let ask = desk.session.answer_recurrence(desk.id, None, None).expect("the same");
    assert_eq!(&*ask.expect("it is asked").first, "radius");
    let early = desk.session.close_loop(desk.id, "until circle.radius < least").expect_err("early");
    assert_eq!(early.message, "radius of circle is asked first");
    let half = Some("circle.radius / 2");
    let ask = desk.session.answer_recurrence(desk.id, half, None).expect("an expression");
    assert_eq!(ask, None);
    desk.session.close_loop(desk.id, "until circle.radius < least").expect("it ends");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    // 40, 20, 10, 5, 2.5, 1.25
    assert_eq!(value(&desk, "rings.column"), "6 turns");
    assert_eq!(value(&desk, "rings.column[5].circle.radius"), "1.25");
    assert_eq!(value(&desk, "rings.column[5].circle2.radius"), "0.625");
    // the centres are 60 apart, 20 of it sideways
    assert_eq!(value(&desk, "rings.column[1].circle"), "centre (-20, 96.5685), radius 20");
    desk.set("rings.least", 5.0).expect("a parameter can be set");
    assert_eq!(value(&desk, "rings.column"), "5 turns");
    let steps = desk.session.history(desk.id).0;
    assert_eq!(steps.iter().filter(|step| step.contains("column")).count(), 1, "{steps:?}");
}

#[test]
fn an_answer_that_has_no_turn_is_refused() {
    let mut desk = rings();
    desk.session.end_turn(desk.id).expect("the turn is drawn");
    let refused = desk.session.answer_recurrence(desk.id, Some("circle9"), None);
    assert!(refused.expect_err("there is none").message.contains("circle9"));
    let refused = desk.session.answer_recurrence(desk.id, Some("radius"), None);
    assert!(refused.is_err(), "a number where a curve is wanted");
    let refused = desk.session.begin_loop(desk.id, "other").expect_err("one is open");
    assert_eq!(refused.message, "a loop is open already: end it first");
}
