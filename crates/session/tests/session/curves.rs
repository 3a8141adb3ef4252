//! Curves by places and poles, measured by pointing.

use crate::desk::Desk;
use session::drafting::view::{MeasureKind, Turn};
use session::view::Pointer;

fn enter(desk: &mut Desk, typed: &str) -> Turn {
    let turn = desk.session.enter(desk.id, typed);
    turn.unwrap_or_else(|refusal| panic!("{typed}: {}\n{}", refusal.message, desk.text()))
}

/// Takes a measure by picks, and draws a circle so large.
fn measured(desk: &mut Desk, kind: MeasureKind, picks: &[(f64, f64)]) -> String {
    desk.session.begin(desk.id, "Circle").expect("there are circles");
    enter(desk, "0, -200");
    desk.session.begin_measure(desk.id, kind);
    let mut taken = None;
    for &at in picks {
        let pointer = Pointer { at, reach: 1.0, ..Pointer::default() };
        let turn =
            desk.session.point(desk.id, &pointer).unwrap_or_else(|r| panic!("{}", r.message));
        let Turn::Wants(prompt) = turn else { panic!("a radius is wanted") };
        taken = prompt.insert;
    }
    let written = taken.expect("it is taken");
    let Turn::Made { name, .. } = enter(desk, &written) else { panic!("it is a radius") };
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    desk.session.give_up(desk.id);
    let says = desk.session.comes_to(desk.id, &format!("bow.{name}.radius"));
    format!("{written} = {}", says.expect("it has a radius"))
}

#[test]
fn curves_are_measured_by_pointing() {
    let mut desk = Desk::of(
        "use drafting
unit mm
program Bow(r: Length = 20) {
    corner = Nurbs([Point(r, 0), Point(r, r), Point(0, r)], weights: [1, cos(45 deg), 1])
    wave = Spline([Point(100, 0), Point(130, 40), Point(160, 80)])
    rim = Circle(center: Point(200, 0), radius: r / 2)
    point = Point(30, 30)
}
bow: Bow
",
    );
    desk.session.record(desk.id, "Bow").expect("it is there");
    let quarter = (14.142, 14.142);
    let found = measured(&mut desk, MeasureKind::Length, &[quarter]);
    assert_eq!(found, "corner.length = 31.4159 mm");
    let found = measured(&mut desk, MeasureKind::Length, &[(115.0, 20.0)]);
    assert_eq!(found, "wave.length = 100 mm");
    let found = measured(&mut desk, MeasureKind::Length, &[(210.0, 0.0)]);
    assert_eq!(found, "2 * pi() * rim.radius = 62.8319 mm");
    for picks in [[quarter, (30.0, 30.0)], [(30.0, 30.0), quarter]] {
        let found = measured(&mut desk, MeasureKind::Distance, &picks);
        assert_eq!(found, "corner.clearance(to: point) = 22.4264 mm");
    }
    // the nearest point goes where a point is wanted
    desk.session.begin(desk.id, "Circle").expect("there are circles");
    enter(&mut desk, "corner.nearest(to: point)");
    let Turn::Made { text, name, .. } = enter(&mut desk, "2") else { panic!("it is made") };
    assert!(text.contains("center: corner.nearest(to: point)"), "{text}");
    let found = desk.session.comes_to(desk.id, &format!("bow.{name}.center"));
    assert_eq!(found.as_deref(), Some("(14.1421, 14.1421)"));
}

#[test]
fn the_nearest_point_of_a_drawn_curve_is_a_tool() {
    let mut desk = Desk::of(
        "use drafting
unit mm
program Bow(r: Length = 20) {
    wave = Spline([Point(100, 0), Point(130, 40), Point(160, 80)])
    oval = Ellipse(Point(0, 0), Point(r, 0), 10)
    point = Point(0, 30)
}
bow: Bow
",
    );
    desk.session.record(desk.id, "Bow").expect("it is there");
    let all = desk.session.constructions(desk.id);
    let tool = all.iter().find(|row| row.label == "Nearest point of a curve").expect("it is one");
    assert!(tool.also.contains("closest"), "{tool:?}");
    for (on, found) in [((115.0, 20.0), "(100, 0)"), ((20.0, 0.0), "(0, 10)")] {
        desk.session.begin(desk.id, &tool.id).expect("it is in scope");
        let pick = |desk: &mut Desk, at| {
            let pointer = Pointer { at, reach: 1.0, ..Pointer::default() };
            desk.session.point(desk.id, &pointer).unwrap_or_else(|r| panic!("{}", r.message))
        };
        pick(&mut desk, on);
        let turn = pick(&mut desk, (0.0, 30.0));
        let Turn::Made { name, .. } = turn else { panic!("all is given: {turn:?}") };
        let says = desk.session.comes_to(desk.id, &format!("bow.{name}"));
        assert_eq!(says.as_deref(), Some(found), "{}", desk.text());
    }
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}
