//! Rectangles and regular polygons as steps: drawn from corner to corner, picked by their sides and corners, copied whole.

use crate::desk::Desk;
use session::drafting::view::{NewParameter, Turn};
use session::view::Pointer;

fn record(parameters: &[(&str, &str)]) -> Desk {
    let mut desk = Desk::of("use geometry\nunit mm\n");
    desk.session.record(desk.id, "Floor").expect("a new program");
    for (name, example) in parameters {
        let new = NewParameter {
            name: (*name).into(),
            example: (*example).into(),
            ..NewParameter::default()
        };
        desk.session.define_parameter(desk.id, &new).expect("it is new");
    }
    desk
}

fn begin(desk: &mut Desk, tool: &str) {
    desk.session.begin(desk.id, tool).unwrap_or_else(|r| panic!("{tool}: {}", r.message));
}

fn enter(desk: &mut Desk, typed: &str) -> Turn {
    let turn = desk.session.enter(desk.id, typed);
    turn.unwrap_or_else(|r| panic!("{typed}: {}\n{}", r.message, desk.text()))
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
    let mut desk = record(&[("width", "90"), ("depth", "48")]);
    begin(&mut desk, "Rectangle.between(first,second)");
    enter(&mut desk, "0,0");
    let room = text(enter(&mut desk, "@width, depth"));
    assert_eq!(room, "Rectangle.between(Point(0, 0), Point(0 + width, 0 + depth))");
    // the other one goes on from its corner, and has a third of its width
    begin(&mut desk, "Rectangle");
    pick(&mut desk, 0.0, 0.0);
    enter(&mut desk, "width / 3");
    let table = text(enter(&mut desk, "depth"));
    assert_eq!(
        table,
        "Rectangle(corner: rectangle.corner, width: width / 3, height: depth)"
    );
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    desk.set("floor.width", 120.0).expect("a parameter can be set");
    assert_eq!(value(&desk, "floor.rectangle2.far.x"), "40 mm");
}

#[test]
fn a_side_of_a_rectangle_is_a_line_and_a_copy_takes_all_of_it() {
    let mut desk = record(&[("w", "20"), ("n", "3")]);
    begin(&mut desk, "Rectangle");
    for typed in ["0, 0", "w"] {
        enter(&mut desk, typed);
    }
    text(enter(&mut desk, "w"));
    begin(&mut desk, "Line.perpendicular(from,to)");
    enter(&mut desk, "30, 10");
    let across = text(pick(&mut desk, 20.0, 7.0));
    assert_eq!(across, "Line.perpendicular(from: Point(30, 10), to: rectangle.side2)");
    begin(&mut desk, ":pattern(by,count)");
    pick(&mut desk, 7.0, 20.0);
    enter(&mut desk, "w, w");
    let row = text(enter(&mut desk, "n"));
    assert!(row.contains("rectangle.moved(by: Point("), "{row}");
    // a mirror image has its sides
    begin(&mut desk, "Point:mirrored");
    pick(&mut desk, 7.0, 20.0);
    let image = text(enter(&mut desk, "Axis.vertical(x: -10)"));
    assert!(image.starts_with("rectangle.mirrored("), "{image}");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "floor.pattern[1].far.x"), "60 mm");
    assert_eq!(value(&desk, "floor.mirrored[1].p1.x"), "-40 mm");
}

#[test]
fn one_side_alone_is_copied_after_tab() {
    let mut desk = record(&[("w", "20")]);
    begin(&mut desk, "Rectangle");
    for typed in ["0, 0", "w"] {
        enter(&mut desk, typed);
    }
    text(enter(&mut desk, "w"));
    begin(&mut desk, ":moved(by)");
    desk.session.pick_wider(desk.id);
    pick(&mut desk, 7.0, 20.0);
    let moved = text(enter(&mut desk, "0, w"));
    assert_eq!(moved, "rectangle.side3.moved(by: Point(0, w))");
}

#[test]
fn a_polygon_is_picked_by_its_sides_and_turned_whole() {
    let mut desk = record(&[("s", "16")]);
    begin(&mut desk, "RegularPolygon");
    for typed in ["0, 0", "s, 0"] {
        enter(&mut desk, typed);
    }
    text(enter(&mut desk, "4"));
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
