//! Standard parts, drawn once by hand: what comes of them is that of the programs that the gallery has of them.

use crate::desk::Desk;
use session::drafting::view::{NewParameter, Turn};
use session::view::Pointer;

fn record(name: &str, parameters: &[(&str, &str)]) -> Desk {
    let mut desk = Desk::of("use geometry\nunit mm\n");
    desk.session.record(desk.id, name).expect("a new program");
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

/// An operand: typed, or picked.
#[derive(Clone, Copy)]
enum By<'t> {
    Typed(&'t str),
    At(f64, f64),
}
use By::{At, Typed};

/// Draws by a construction.
fn draw(desk: &mut Desk, tool: &str, operands: &[By<'_>]) -> String {
    drawn(desk, (tool, false), operands)
}

/// Draws for construction alone.
fn guide(desk: &mut Desk, tool: &str, operands: &[By<'_>]) -> String {
    drawn(desk, (tool, true), operands)
}

fn drawn(desk: &mut Desk, (tool, is_guide): (&str, bool), operands: &[By<'_>]) -> String {
    desk.session.begin(desk.id, tool).unwrap_or_else(|r| panic!("{tool}: {}", r.message));
    desk.session.draw_guides(desk.id, is_guide);
    let mut last = None;
    for operand in operands {
        let turn = match *operand {
            Typed(text) => desk.session.enter(desk.id, text),
            At(x, y) => {
                let pointer = Pointer { at: (x, y), reach: 0.4, ..Pointer::default() };
                desk.session.hover(desk.id, &pointer, "");
                desk.session.point(desk.id, &pointer)
            }
        };
        last = Some(turn.unwrap_or_else(|r| panic!("{tool}: {}\n{}", r.message, desk.text())));
    }
    match last {
        Some(Turn::Made { name, .. }) => name,
        other => panic!("{tool} waits: {other:?}"),
    }
}

fn value(desk: &Desk, path: &str) -> String {
    desk.session.comes_to(desk.id, path).unwrap_or_else(|| panic!("{path}: {}", desk.text()))
}

#[test]
fn a_nut_is_a_flat_in_a_polar_pattern() {
    let mut desk = record("Nut", &[("s", "16"), ("d", "10")]);
    guide(&mut desk, "Point", &[Typed("0"), Typed("0")]);
    guide(&mut desk, "Point", &[Typed("0"), Typed("s / (2 * cos(30 deg))")]);
    guide(&mut desk, "Point:turned", &[At(0.0, 9.24), At(0.0, 0.0), Typed("60")]);
    draw(&mut desk, "Line", &[At(0.0, 9.24), At(-8.0, 4.62)]);
    let six = draw(&mut desk, ":pattern(about,count)", &[At(-4.0, 6.93), At(0.0, 0.0), Typed("6")]);
    assert_eq!(six, "pattern");
    draw(&mut desk, "Circle", &[At(0.0, 0.0), Typed("d / 2")]);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "nut.pattern"), "6 figures");
    // the flat opposite of the first one; corners lie 16 / √3 from the middle
    assert_eq!(value(&desk, "nut.pattern[3]"), "(0, -9.2376) to (8, -4.6188)");
    desk.set("nut.s", 24.0).expect("a parameter can be set");
    assert_eq!(value(&desk, "nut.pattern[3]"), "(0, -13.8564) to (12, -6.9282)");
    // a row of figures, each as far on as a point from the origin
    let row = draw(&mut desk, ":pattern(by,count)", &[At(5.0, 0.0), Typed("30,0"), Typed("3")]);
    assert_eq!(value(&desk, &format!("nut.{row}[2]")), "centre (60, 0), radius 5");
}

#[test]
fn a_retaining_ring_has_the_lug_that_its_size_asks_for() {
    let parameters = [("d1", "20"), ("d3", "18.5"), ("a", "4"), ("b", "2.6"), ("d5", "2")];
    let mut desk = record("Ring", &parameters);
    guide(&mut desk, "Point", &[Typed("0"), Typed("0")]);
    guide(&mut desk, "Circle", &[At(0.0, 0.0), Typed("d3 / 2")]);
    guide(&mut desk, "Circle", &[Typed("Point(0, -b / 5)"), Typed("d3 / 2 + 4 * b / 5")]);
    guide(&mut desk, "Axis.vertical(x)", &[Typed("a / 5")]);
    let eye = "Point.intersection(Axis.vertical(x: 7 * a / 10), Circle(center: point, radius: d3 / 2 + a / 2))";
    draw(&mut desk, "Circle", &[Typed(eye), Typed("d5 / 2")]);
    // the lug of a small ring is round, that of a larger one goes out to a circle
    desk.session.begin_choice(desk.id).expect("it is recorded");
    desk.session.enter(desk.id, "d1 < 10").expect("it is a condition");
    draw(&mut desk, "Circle", &[At(0.0, 0.0), Typed("d3 / 2 + a")]);
    desk.session.otherwise(desk.id).expect("the first branch is drawn");
    desk.set("ring.d1", 8.0).expect("a parameter can be set");
    desk.session.other_branch(desk.id, false).expect("the values take it");
    draw(&mut desk, "Circle.concentric(with,radius)", &[Typed("circle3"), Typed("a / 2")]);
    desk.session.end_choice(desk.id).expect("it is open");
    // either lug is one thing to what follows
    draw(&mut desk, "Point:mirrored", &[Typed("circle4"), Typed("Axis.vertical(x: 0)")]);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "ring.circle4"), "centre (0, 0), radius 13.25");
    for (d1, lug) in
        [(8.0, "centre (-2.8, 10.896), radius -2"), (25.0, "centre (0, 0), radius -13.25")]
    {
        desk.set("ring.d1", d1).expect("a parameter can be set");
        assert_eq!(value(&desk, "ring.mirrored"), lug, "{d1}");
    }
}
