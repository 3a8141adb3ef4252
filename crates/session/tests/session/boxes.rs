//! Rectangles, regular polygons and splines as steps: drawn from corner to corner and through places, picked by their
//! sides and corners, copied whole.

use crate::desk::Desk;
use session::drafting::view::{Ends, Go, NewParameter, Turn};
use session::view::Pointer;

fn begin(desk: &mut Desk, tool: &str) {
    desk.session.begin(desk.id, tool).unwrap_or_else(|r| panic!("{tool}: {}", r.message));
}

fn enter(desk: &mut Desk, typed: &str) -> Turn {
    let turn = desk.session.enter(desk.id, typed);
    turn.unwrap_or_else(|r| panic!("{typed}: {}\n{}", r.message, desk.text()))
}

/// Draws by a construction whose operands are typed.
fn draw(desk: &mut Desk, tool: &str, operands: &[&str]) -> String {
    begin(desk, tool);
    let turns = operands.iter().map(|typed| enter(desk, typed));
    text(turns.last().expect("it has an operand"))
}

fn pick(desk: &mut Desk, x: f64, y: f64) -> Turn {
    let pointer = Pointer { at: (x, y), reach: 1.0, ..Pointer::default() };
    desk.session.hover(desk.id, &pointer, "");
    desk.session.point(desk.id, &pointer).unwrap_or_else(|r| panic!("{}", r.message))
}

fn text(turn: Turn) -> String {
    match turn {
        Turn::Made { text, .. } => text,
        Turn::Wants(prompt) => panic!("it waits: {prompt:?}"),
    }
}

fn value(desk: &Desk, path: &str) -> String {
    desk.session.comes_to(desk.id, path).expect("it has a value")
}

#[test]
fn a_rectangle_is_a_step_from_corner_to_corner() {
    let mut desk = Desk::recording("Floor", &[("width", "90"), ("depth", "48")]);
    let room = draw(&mut desk, "Rectangle.between(first,second)", &["0,0", "@width, depth"]);
    assert_eq!(room, "Rectangle.between(Point(0, 0), Point(width, depth))");
    // the other one goes on from its corner, and has a third of its width
    begin(&mut desk, "Rectangle");
    pick(&mut desk, 0.0, 0.0);
    enter(&mut desk, "width / 3");
    let table = text(enter(&mut desk, "depth"));
    assert_eq!(table, "Rectangle(corner: rectangle.corner, width: width / 3, height: depth)");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    desk.set("floor.width", 120.0).expect("a parameter can be set");
    assert_eq!(value(&desk, "floor.rectangle2.far.x"), "40 mm");
    // it is told as it is typed, and by its corners
    let steps = desk.session.steps(desk.id, None).expect("it is recorded");
    assert_eq!(steps.rows[0].words, "rectangle between: (0, 0), (width, depth)");
    assert_eq!(steps.rows[0].value.as_deref(), Some("(0, 0) to (120, 48)"));
    begin(&mut desk, "Rectangle.between(first,second)");
    pick(&mut desk, 120.0, 48.0);
    text(enter(&mut desk, "@-width / 2, depth"));
    let steps = desk.session.steps(desk.id, None).expect("it is recorded");
    assert_eq!(steps.rows[2].words, "rectangle between: rectangle.far, @(-width / 2, depth)");
}

#[test]
fn a_side_of_a_rectangle_is_a_line_and_a_copy_takes_all_of_it() {
    let mut desk = Desk::recording("Floor", &[("w", "20"), ("n", "3")]);
    draw(&mut desk, "Rectangle", &["0, 0", "w", "w"]);
    begin(&mut desk, "Line.perpendicular(from,to)");
    enter(&mut desk, "30, 10");
    let across = text(pick(&mut desk, 20.0, 7.0));
    assert_eq!(across, "Line.perpendicular(from: Point(30, 10), to: rectangle.side2)");
    begin(&mut desk, ":pattern(by,count)");
    pick(&mut desk, 19.5, 20.0);
    enter(&mut desk, "w, w");
    let row = text(enter(&mut desk, "n"));
    assert!(row.starts_with("pattern in a row: rectangle, by (w, w), count n"), "{row}");
    // a mirror image has its sides
    begin(&mut desk, "Point:mirrored");
    pick(&mut desk, 7.0, 20.0);
    let image = text(enter(&mut desk, "Axis.vertical(x: -10)"));
    assert!(image.starts_with("rectangle.mirrored("), "{image}");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "floor.pattern[1].far.x"), "60 mm");
    assert_eq!(value(&desk, "floor.mirrored"), "(-20, 0) to (-40, 20)");
}

#[test]
fn a_rectangle_stays_one_where_it_is_turned_mirrored_and_scaled() {
    let mut desk = Desk::recording("Floor", &[("w", "20")]);
    draw(&mut desk, "Rectangle", &["0, 0", "w", "w / 2"]);
    begin(&mut desk, "Point:turned");
    pick(&mut desk, 7.0, 0.0);
    enter(&mut desk, "0, 0");
    text(enter(&mut desk, "90 deg"));
    // any side of what was turned is all of it, and its sides are lines
    begin(&mut desk, "Point:mirrored");
    pick(&mut desk, -10.0, 7.0);
    let image = text(enter(&mut desk, "Axis.horizontal(y: 30)"));
    assert!(image.starts_with("turned.mirrored("), "{image}");
    begin(&mut desk, "Point:scaled");
    pick(&mut desk, -5.0, 60.0);
    enter(&mut desk, "0, 60");
    text(enter(&mut desk, "2"));
    begin(&mut desk, "Line.perpendicular(from,to)");
    enter(&mut desk, "30, 10");
    let across = text(pick(&mut desk, -10.0, 13.0));
    assert_eq!(across, "Line.perpendicular(from: Point(30, 10), to: turned.side3)");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "floor.turned"), "(0, 0) to (-10, 20)");
    assert_eq!(value(&desk, "floor.mirrored"), "(0, 60) to (-10, 40)");
    assert_eq!(value(&desk, "floor.scaled"), "(0, 60) to (-20, 20)");
    assert_eq!(value(&desk, "floor.scaled.area"), "800 mm^2");
}

#[test]
fn a_rounded_outline_is_taken_by_a_side_of_its_rectangle() {
    let mut desk = Desk::recording("Floor", &[("w", "60"), ("r", "8")]);
    draw(&mut desk, "Rectangle.between(first,second)", &["0, 0", "w, w / 2"]);
    begin(&mut desk, "Contour.rounded(of,radius)");
    pick(&mut desk, 30.0, 0.0);
    let outline = text(enter(&mut desk, "r"));
    assert_eq!(outline, "Contour.rounded(of: rectangle, radius: r)");
    // words are typed as they are
    begin(&mut desk, "Caption");
    pick(&mut desk, 60.0, 30.0);
    let words = text(enter(&mut desk, "Cover, left"));
    assert_eq!(words, "Caption(at: rectangle.far, words: \"Cover, left\")");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn one_side_alone_is_copied_after_tab() {
    let mut desk = Desk::recording("Floor", &[("w", "20")]);
    draw(&mut desk, "Rectangle", &["0, 0", "w", "w"]);
    begin(&mut desk, ":moved(by)");
    desk.session.pick_wider(desk.id);
    pick(&mut desk, 7.0, 20.0);
    let moved = text(enter(&mut desk, "0, w"));
    assert_eq!(moved, "rectangle.side3.moved(by: Point(0, w))");
    // what was moved is a step like any other
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "floor.shifted.p1.y"), "40 mm");
}

#[test]
fn a_polygon_is_picked_by_its_sides_and_turned_whole() {
    let mut desk = Desk::recording("Floor", &[("s", "16")]);
    draw(&mut desk, "RegularPolygon", &["0, 0", "s, 0", "4"]);
    begin(&mut desk, "Point.middle(first,second)");
    pick(&mut desk, 16.0, 0.0);
    let middle = text(pick(&mut desk, 0.0, 16.0));
    assert_eq!(middle, "Point.middle(regularPolygon.edges[0].p1, regularPolygon.edges[0].p2)");
    begin(&mut desk, "Point:turned");
    pick(&mut desk, 8.0, -8.0);
    enter(&mut desk, "40, 0");
    let turned = text(enter(&mut desk, "90 deg"));
    assert!(turned.starts_with("regularPolygon.turned("), "{turned}");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn what_is_drawn_after_a_replacement_stands_at_the_end_again() {
    let mut desk = Desk::recording("Floor", &[("w", "20")]);
    draw(&mut desk, "Circle", &["0, 0", "w"]);
    draw(&mut desk, "Circle", &["50, 0", "w"]);
    desk.session.begin_replace(desk.id, "circle").expect("it is no block");
    draw(&mut desk, "Rectangle.between(first,second)", &["0, 0", "@w, w"]);
    draw(&mut desk, "Circle", &["90, 0", "w"]);
    let steps = desk.session.steps(desk.id, None).expect("it is recorded");
    let names: Vec<&str> = steps.rows.iter().map(|row| row.name.as_str()).collect();
    assert_eq!(names, ["circle", "circle2", "circle3"]);
    assert!(steps.rows[0].words.starts_with("rectangle between"), "{}", steps.rows[0].words);
}

#[test]
fn a_stair_begins_its_next_step_where_the_last_one_ends() {
    let mut desk = Desk::recording("Floor", &[("rise", "17"), ("going", "29"), ("n", "5")]);
    desk.session.begin_loop(desk.id, "").expect("a program is recorded");
    draw(&mut desk, "Line.vertical(from,length)", &["0, 0", "rise"]);
    begin(&mut desk, "Line.horizontal(from,length)");
    pick(&mut desk, 0.0, 17.0);
    text(enter(&mut desk, "going"));
    desk.session.give_up(desk.id);
    desk.session.end_turn(desk.id, Ends::Times).expect("a turn is drawn");
    // the place where it began is asked for, too
    let asked = desk.session.prompt(desk.id).expect("it asks").words;
    assert!(asked.contains("was (0, 0)") && asked.contains("how far on, `@dx,dy`"), "{asked}");
    pick(&mut desk, 29.0, 17.0);
    for _ in 0..2 {
        desk.session.same(desk.id).expect("it may be the same");
    }
    enter(&mut desk, "n");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "floor.turns"), "5 turns");
    assert_eq!(value(&desk, "floor.turns.last.line2.p2"), "(145, 85)");
}

/// A rectangle of 60 by 30 with words at its far corner, as steps.
fn labelled() -> Desk {
    let mut desk = Desk::recording("Floor", &[("w", "60"), ("r", "8")]);
    draw(&mut desk, "Rectangle.between(first,second)", &["0, 0", "w, w / 2"]);
    desk
}

#[test]
fn a_box_around_a_rectangle_catches_it_and_none_of_its_corners() {
    let mut desk = labelled();
    desk.session.begin_each(desk.id, ((-5.0, -5.0), (65.0, 35.0))).expect("it lies there");
    assert!(desk.text().contains(" in [rectangle] {"), "{}", desk.text());
    let mut desk = labelled();
    // where a side is outside, the others are lines
    desk.session.begin_each(desk.id, ((-5.0, -5.0), (65.0, 5.0))).expect("one lies there");
    assert!(desk.text().contains(" in [rectangle.side1] {"), "{}", desk.text());
}

#[test]
fn a_rectangle_is_taken_near_its_corners_and_its_middle() {
    for (x, y) in [(0.3, 0.2), (60.0, 30.0), (30.0, 15.0)] {
        let mut desk = labelled();
        begin(&mut desk, "Contour.rounded(of,radius)");
        pick(&mut desk, x, y);
        let outline = text(enter(&mut desk, "r"));
        assert_eq!(outline, "Contour.rounded(of: rectangle, radius: r)", "{x}, {y}");
    }
}

#[test]
fn words_are_copied_by_where_they_lie() {
    let mut desk = labelled();
    begin(&mut desk, "Caption");
    pick(&mut desk, 60.0, 30.0);
    text(enter(&mut desk, "Cover"));
    begin(&mut desk, ":moved(by)");
    pick(&mut desk, 60.0, 30.0);
    let moved = text(enter(&mut desk, "0, w"));
    assert_eq!(moved, "caption.moved(by: Point(0, w))");
    // its place is a point as before
    begin(&mut desk, "Circle");
    desk.session.pick_wider(desk.id);
    pick(&mut desk, 60.0, 30.0);
    let circle = text(enter(&mut desk, "r"));
    assert!(circle.contains("rectangle.far") || circle.contains("caption.at"), "{circle}");
}

#[test]
fn a_polygon_is_copied_whole_near_a_vertex() {
    let mut desk = Desk::recording("Floor", &[("s", "16")]);
    draw(&mut desk, "RegularPolygon", &["0, 0", "s, 0", "4"]);
    begin(&mut desk, ":moved(by)");
    pick(&mut desk, 15.9, 0.1);
    let moved = text(enter(&mut desk, "0, s"));
    assert_eq!(moved, "regularPolygon.moved(by: Point(0, s))");
}

#[test]
fn a_replacement_that_is_given_up_is_no_place_to_return_to() {
    let mut desk = Desk::recording("Floor", &[("w", "20")]);
    for at in ["0, 0", "50, 0", "100, 0"] {
        draw(&mut desk, "Circle", &[at, "w"]);
    }
    desk.session.begin_replace(desk.id, "circle").expect("it is no block");
    begin(&mut desk, "Circle");
    desk.session.give_up(desk.id);
    desk.session.begin_replace(desk.id, "circle2").expect("it is no block");
    draw(&mut desk, "Circle", &["60, 0", "w"]);
    let steps = desk.session.steps(desk.id, None).expect("it is recorded");
    assert_eq!(steps.at, None, "recording goes on at the end");
}

#[test]
fn a_radius_of_more_than_half_the_shorter_side_rounds_no_corner() {
    let mut desk = labelled();
    begin(&mut desk, "Contour.rounded(of,radius)");
    pick(&mut desk, 30.0, 0.0);
    for (radius, why) in [("16", "at_most_half_the_height"), ("-1", "not_negative")] {
        let refused = desk.session.enter(desk.id, radius).expect_err("no such outline");
        assert!(refused.message.contains(why), "{}", refused.message);
    }
    let outline = text(enter(&mut desk, "15"));
    assert_eq!(outline, "Contour.rounded(of: rectangle, radius: 15)");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

/// A program with a spline through three places, `width` across.
fn wave() -> Desk {
    let mut desk = Desk::of("use drafting\nuse contours\nunit mm\n");
    desk.session.record(desk.id, "Wave").expect("a new program");
    let width =
        NewParameter { name: "width".into(), example: "60".into(), ..NewParameter::default() };
    desk.session.define_parameter(desk.id, &width).expect("it is new");
    begin(&mut desk, "Spline");
    for place in ["0,0", "20,15", "width, 0"] {
        enter(&mut desk, place);
    }
    text(enter(&mut desk, ""));
    desk
}

#[test]
fn a_spline_is_picked_by_its_curve_and_at_its_places() {
    let mut desk = wave();
    // between its places, where it bulges above them
    begin(&mut desk, "Point:mirrored");
    let on_it = Pointer { at: (10.5, 9.5), reach: 3.0, ..Pointer::default() };
    assert_eq!(desk.session.hover(desk.id, &on_it, "").finds.as_deref(), Some("spline"));
    desk.session.point(desk.id, &on_it).expect("it can be mirrored");
    assert_eq!(
        text(enter(&mut desk, "Axis.vertical(x: 0 mm)")),
        "spline.mirrored(about: Axis.vertical(x: 0 mm))"
    );
    begin(&mut desk, "Circle");
    pick(&mut desk, 20.0, 15.0);
    assert_eq!(text(enter(&mut desk, "3")), "Circle(center: spline.places[1], radius: 3)");
    // it is an edge of a contour, which is open without more
    begin(&mut desk, "Contour.along(edges)");
    desk.session.point(desk.id, &on_it).expect("it is an edge");
    let open = desk.session.enter(desk.id, "").expect_err("it is open");
    assert!(open.message.contains("it is open"), "{}", open.message);
    desk.session.give_up(desk.id);
    // a band takes it where all of it lies within
    let half = desk.session.begin_each(desk.id, ((-5.0, -5.0), (30.0, 30.0))).expect("a circle");
    assert!(desk.text().contains("in [circle] {"), "{half:?}");
    desk.undo();
    // a spline and a circle are what a contour may run along, and are turned and mirrored alike
    desk.session.begin_each(desk.id, ((-5.0, -5.0), (70.0, 30.0))).expect("both are edges");
    assert!(desk.text().contains("in [spline, circle] {"), "{}", desk.text());
    desk.undo();
    assert_eq!(desk.wrong(), []);
}

#[test]
fn the_angles_of_an_elliptic_arc_are_told_in_degrees() {
    let mut desk = Desk::of("use drafting\nuse geometry\nprogram Cam() { }\ncam: Cam\n");
    desk.session.record(desk.id, "Cam").expect("it is there");
    draw(&mut desk, "EllipticArc", &["0,0", "60,0", "30", "-90 deg", "180 deg"]);
    let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
    let told = "EllipticArc(Point(0, 0), Point(60, 0), 30, -90 deg, 180 deg)";
    assert_eq!(rows[0].value.as_deref(), Some(told));
}

#[test]
fn a_contour_goes_along_a_spline_and_is_picked_by_it() {
    let mut desk = wave();
    begin(&mut desk, "Line");
    enter(&mut desk, "width, 0");
    text(enter(&mut desk, "0,0"));
    begin(&mut desk, "Surface.filled(edges)");
    // one pick follows, whichever it is
    let on_it = Pointer { at: (10.5, 9.5), reach: 3.0, ..Pointer::default() };
    desk.session.point(desk.id, &on_it).expect("it is an edge");
    assert!(
        desk.text().contains("surface = Surface.filled(edges: [spline, line])"),
        "{}",
        desk.text()
    );
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    let drawn = desk.session.picture(desk.id).drawing.elements;
    assert!(
        drawn.iter().any(|e| e.style.fill.is_some() && e.shape != drawing::Shape::Region(vec![]))
    );
    // it is copied as a whole, and no region is made of it
    begin(&mut desk, "Point:mirrored");
    desk.session.point(desk.id, &on_it).expect("it can be mirrored");
    let said = text(enter(&mut desk, "Axis.vertical(x: -9 mm)"));
    assert!(said.contains("surface") || said.contains("spline"), "{said}");
    begin(&mut desk, "Region.offset(of,by)");
    enter(&mut desk, "surface");
    let refused = desk.session.enter(desk.id, "3").expect_err("it has a spline");
    assert!(refused.message.contains("lines and arcs alone"), "{}", refused.message);
    desk.session.give_up(desk.id);
    assert_eq!(desk.wrong(), []);
}

#[test]
fn each_place_of_a_spline_is_asked_about_and_changed_by_itself() {
    let mut desk = wave();
    let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
    assert_eq!(rows[0].words, "spline: (0, 0), (20, 15), (width, 0)");
    desk.session.begin_change(desk.id, ("spline", "second"), None).expect("it has three");
    enter(&mut desk, "@5,-20");
    assert_eq!(value(&desk, "wave.spline.places[1]"), "(25, -5)");
    // it is found by its curve, which is near its middle where its places are not
    desk.session.visit(desk.id, &Go::Start).expect("it is recorded");
    let on_it = Pointer { at: (45.0, -5.5), reach: 4.0, ..Pointer::default() };
    desk.session.visit(desk.id, &Go::UntilPicked(on_it)).expect("it drew it");
    desk.session.visit(desk.id, &Go::End).expect("there is one");
    desk.undo();
    // a place that parameters say is dragged; one of numbers alone is said where that can be changed
    let at = |i: usize| [session::parse_path(&format!("wave.spline.places[{i}]")).expect("a path")];
    let refused = desk.session.press_all(desk.id, &at(1)).expect_err("it says (20, 15)");
    assert!(refused.message.contains("click the step"), "{}", refused.message);
    desk.session.press_all(desk.id, &at(2)).expect("it says (width, 0)");
    desk.session.drag(desk.id, (80.0, 0.0));
    desk.session.release(desk.id).expect("the width follows");
    assert_eq!(value(&desk, "wave.width"), "80 mm");
    // a second wave begins where the first one ends
    let mut desk = Desk::of("use drafting\nunit mm\n");
    desk.session.record(desk.id, "Waves").expect("a new program");
    desk.session.begin_loop(desk.id, "").expect("a loop");
    begin(&mut desk, "Spline");
    for place in ["0,0", "20,15", "40,0"] {
        enter(&mut desk, place);
    }
    text(enter(&mut desk, ""));
    desk.session.end_turn(desk.id, Ends::Times).expect("it is drawn");
    assert!(desk.session.enter(desk.id, "").is_err(), "nothing was said of a place yet");
    match enter(&mut desk, "@40,0") {
        Turn::Wants(prompt) => {
            let offered = "Enter takes `@40,0` for all places left of spline";
            assert!(prompt.words.contains(offered), "{}", prompt.words);
        }
        other => panic!("{other:?}"),
    }
    enter(&mut desk, "");
    enter(&mut desk, "3");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "waves.turns[2].spline.places[1]"), "(100, 15)");
}

#[test]
fn a_spline_is_drawn_through_places_that_are_picked_and_typed() {
    let mut desk = Desk::of("use drafting\n");
    desk.session.record(desk.id, "Wave").expect("a new program");
    let width =
        NewParameter { name: "width".into(), example: "60".into(), ..NewParameter::default() };
    desk.session.define_parameter(desk.id, &width).expect("it is new");
    begin(&mut desk, "Point");
    text(enter(&mut desk, "0,0"));
    begin(&mut desk, "Spline");
    assert!(desk.session.enter(desk.id, "").is_err(), "there is no place yet");
    pick(&mut desk, 0.0, 0.0);
    enter(&mut desk, "@width / 2, 20");
    let ghost = desk.session.hover(desk.id, &Pointer { at: (50.0, 5.0), ..Pointer::default() }, "");
    assert_eq!((ghost.ghost.elements.len(), ghost.why), (1, None));
    enter(&mut desk, "width, 10");
    // what was given last is taken back
    desk.session.back(desk.id);
    enter(&mut desk, "width, 0");
    let drawn = text(enter(&mut desk, ""));
    assert_eq!(
        drawn,
        "Spline([point, Point(point.x + (width / 2), point.y + 20), Point(width, 0)])"
    );
    assert!(desk.text().contains("    spline = Spline([point, "), "{}", desk.text());
    // what draws it is one step, and follows its operands
    desk.session
        .set_parameters(desk.id, "wave", &[("width".into(), "80".into())])
        .expect("a value");
    assert_eq!(value(&desk, "wave.spline.finish"), "(80, 0)");
    assert_eq!(value(&desk, "wave.spline"), "3 places");
    assert_eq!(desk.session.value_parameters(desk.id), ["width"]);
    assert_eq!(desk.wrong(), []);
}

#[test]
fn a_curve_by_poles_is_drawn_with_its_weights() {
    let mut desk = Desk::of("use drafting\nuse contours\nunit mm\n");
    desk.session.record(desk.id, "Bow").expect("a new program");
    let pull =
        NewParameter { name: "pull".into(), example: "0.5".into(), ..NewParameter::default() };
    desk.session.define_parameter(desk.id, &pull).expect("it is new");
    begin(&mut desk, "Nurbs");
    for place in ["10,0", "10,10", "0,10"] {
        enter(&mut desk, place);
    }
    match desk.session.enter(desk.id, "").expect("the weights are left") {
        Turn::Wants(prompt) => {
            assert_eq!(prompt.words, "weights: type a value for each, as `1, 2, 1`");
        }
        other => panic!("{other:?}"),
    }
    let few = desk.session.enter(desk.id, "1, pull").expect_err("there are three poles");
    assert!(few.message.contains("2 weights, where there are 3 poles"), "{}", few.message);
    let drawn = text(enter(&mut desk, "1, pull, 1"));
    assert_eq!(
        drawn,
        "Nurbs([Point(10, 0), Point(10, 10), Point(0, 10)], weights: [1, pull, 1]); pull is a plain number now"
    );
    // (10 + 2 * 0.5 * 10) / 3
    begin(&mut desk, "Point");
    enter(&mut desk, "nurbs.at(parameter: 0.5)");
    assert_eq!(value(&desk, "bow.point"), "(6.6667, 6.6667)");
    // each pole and the weights are changed by themselves
    desk.session.begin_change(desk.id, ("nurbs", "weights"), None).expect("it has some");
    enter(&mut desk, "1, 3 * pull, 1");
    desk.session.begin_change(desk.id, ("nurbs", "second"), None).expect("it has three");
    enter(&mut desk, "20,20");
    assert!(
        desk.text()
            .contains("[Point(10, 0), Point(20, 20), Point(0, 10)], weights: [1, 3 * pull, 1])"),
        "{}",
        desk.text()
    );
    // it is picked by its curve, here at a quarter: (0.5625 (10, 0) + 0.5625 (20, 20) + 0.0625 (0, 10)) / 1.1875
    begin(&mut desk, "Point:mirrored");
    let on_it = Pointer { at: (14.2, 10.0), reach: 1.0, ..Pointer::default() };
    assert_eq!(desk.session.hover(desk.id, &on_it, "").finds.as_deref(), Some("nurbs"));
    desk.session.give_up(desk.id);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

/// A disc with a tooth of a rounded box on it, `wide` across.
fn tooth() -> Desk {
    let mut desk = Desk::recording("Gear", &[("wide", "8")]);
    draw(&mut desk, "Circle", &["0,0", "40"]);
    draw(&mut desk, "Rectangle", &["-wide / 2, 37", "wide", "11"]);
    begin(&mut desk, "Contour.rounded(of,radius)");
    pick(&mut desk, 0.0, 48.0);
    text(enter(&mut desk, "wide / 4"));
    desk
}

#[test]
fn a_copy_takes_the_rounded_outline_before_the_box_below_it() {
    let mut desk = tooth();
    begin(&mut desk, ":pattern(about,count)");
    pick(&mut desk, 0.0, 48.0);
    enter(&mut desk, "0,0");
    let pattern = text(enter(&mut desk, "12"));
    assert!(pattern.starts_with("polar pattern: contour, about (0, 0)"), "{pattern}");
    // Tab goes on to the box
    begin(&mut desk, "Point:mirrored");
    let on_both = Pointer { at: (0.0, 48.0), reach: 3.0, ..Pointer::default() };
    assert_eq!(desk.session.hover(desk.id, &on_both, "").finds.as_deref(), Some("contour"));
    desk.session.pick_wider(desk.id);
    let box_below = desk.session.hover(desk.id, &on_both, "").finds;
    assert_eq!(box_below.as_deref(), Some("rectangle"));
}

#[test]
fn a_surface_is_picked_where_it_is_filled_and_not_taken_from_itself() {
    let mut desk = tooth();
    begin(&mut desk, "Region.union(first,second)");
    pick(&mut desk, -40.0, 0.0);
    text(pick(&mut desk, 0.0, 48.0));
    draw(&mut desk, "Circle", &["0,0", "10"]);
    begin(&mut desk, "Region.difference(first,second)");
    // far from any edge
    pick(&mut desk, -25.0, 0.0);
    assert!(
        desk.session
            .point(desk.id, &Pointer { at: (-25.0, 0.0), reach: 2.0, ..Pointer::default() })
            .is_err()
    );
    assert_eq!(text(pick(&mut desk, 10.0, 0.0)), "Region.difference(region, circle2)");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn a_value_by_which_a_step_has_no_outcome_is_told_at_the_step_and_in_the_status() {
    let mut desk = tooth();
    assert_eq!(desk.session.status(desk.id).message, "all constraints hold; nothing is free");
    desk.session
        .set_parameters(desk.id, "gear", &[("wide".into(), "30".into())])
        .expect("it is a length");
    let told = desk.session.status(desk.id).message;
    assert!(
        told.starts_with("gear is not drawn to its end: the step contour has no outcome"),
        "{told}"
    );
    let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
    let why = |name: &str| rows.iter().find(|row| row.name == name).expect("a step").why.clone();
    assert_eq!((why("circle"), why("rectangle")), (None, None));
    assert!(why("contour").is_some_and(|why| why.contains("at_most_half_the_height is not met")));
    desk.undo();
    assert_eq!(desk.session.status(desk.id).message, "all constraints hold; nothing is free");
}

#[test]
fn tab_means_the_last_turn_however_many_there_are() {
    let mut desk = Desk::recording("Shaft", &[("steps", "4"), ("d", "40"), ("drop", "6")]);
    desk.session.begin_loop(desk.id, "").expect("a loop");
    draw(&mut desk, "Rectangle", &["0, -d / 2", "20", "d"]);
    desk.session.end_turn(desk.id, Ends::Times).expect("it is drawn");
    enter(&mut desk, "@20, drop / 2");
    enter(&mut desk, "rectangle.height - drop");
    enter(&mut desk, "steps");
    // the upper right corner of the fourth step
    let corner = Pointer { at: (80.0, 11.0), reach: 1.0, ..Pointer::default() };
    let finds = |desk: &mut Desk| desk.session.hover(desk.id, &corner, "").finds;
    begin(&mut desk, "Circle");
    assert_eq!(finds(&mut desk).as_deref(), Some("turns[3].rectangle.far"));
    desk.session.pick_wider(desk.id);
    assert_eq!(finds(&mut desk).as_deref(), Some("turns.last.rectangle.far"));
    desk.session.point(desk.id, &corner).expect("it is a point");
    let circle = text(enter(&mut desk, "2"));
    assert_eq!(circle, "Circle(center: turns.last.rectangle.far, radius: 2)");
    for (steps, x) in [("2", "40"), ("6", "120")] {
        desk.session
            .set_parameters(desk.id, "shaft", &[("steps".into(), steps.into())])
            .expect("it is a count");
        assert!(value(&desk, "shaft.circle").contains(&format!("({x}, ")), "{steps}");
    }
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}
