//! What programs draw, dragged: their parameters follow.

use crate::desk::{Desk, gallery};

/// The value of a row, in the document's words.
fn value(desk: &Desk, path: &str) -> String {
    let rows = desk.session.values(desk.id);
    let row = rows.into_iter().find(|r| r.path == path);
    row.map_or_else(|| panic!("there is no row {path}"), |r| r.text)
}

#[test]
fn the_third_ring_dragged_changes_the_first_radius_and_the_number_of_turns() {
    let mut desk = Desk::of(&gallery("rings"));
    let path = session::parse_path("rings.column[2].ring.center").expect("a path");
    let grips = desk.session.picture(desk.id).grips;
    assert!(grips.iter().any(|g| g.path == "rings.column[2].ring.center"), "{grips:?}");
    let (x, y) = desk.session.press(desk.id, &path).expect("it can be dragged");
    // the third ring's radius is a quarter of the first's, and it touches the axis
    assert!((x - -10.0).abs() < 1e-9, "{x}");
    // its centre lies on a ray through the corner: so much further out it is twice as large
    let there = desk.session.drag(desk.id, (1.2 * x, 1.2 * y));
    assert!(there.reached && there.modes.is_empty(), "{there:?}");
    let there = desk.session.drag(desk.id, (2.0 * x, 2.0 * y));
    assert!(there.reached, "{there:?}");
    assert_eq!(there.modes.len(), 1);
    assert_eq!(there.modes[0].message, "rings.column takes 7 turns, not 6");
    // and back, and there again
    let back = desk.session.drag(desk.id, (x, y));
    assert!(back.reached && back.modes.is_empty(), "{back:?}");
    desk.session.drag(desk.id, (2.0 * x, 2.0 * y));
    let change = desk.session.release(desk.id).expect("it can be kept");
    assert_eq!(change.edits.len(), 1);
    assert_eq!(value(&desk, "rings.radius"), "80");
    let text = desk.session.text(desk.id).source;
    assert!(text.contains("rings: Rings { radius = 80"), "{text}");
}

#[test]
fn a_drag_stops_where_neither_branch_holds_what_is_wished() {
    let mut desk = Desk::of(
        "use geometry\nunit mm\nprogram Bar(pitch: Length = 10 mm) {\n    if pitch > 15 mm { end = Point(2 * pitch, 0) } else { end = Point(pitch, 0) }\n}\nb: Bar\n",
    );
    let path = session::parse_path("b.end.x").expect("a path");
    desk.session.press(desk.id, &path).expect("it can be dragged");
    let there = desk.session.drag(desk.id, (20.0, 0.0));
    assert!(!there.reached);
    let message = there.message.unwrap_or_default();
    assert!(message.contains("beyond it b draws another branch"), "{message}");
    desk.session.release(desk.id).expect("it can be kept");
    assert_eq!(value(&desk, "b.pitch"), "15");
    desk.session.press(desk.id, &path).expect("it can be dragged");
    let there = desk.session.drag(desk.id, (40.0, 0.0));
    assert!(there.reached, "{there:?}");
    desk.session.release(desk.id).expect("it can be kept");
    assert_eq!(value(&desk, "b.pitch"), "20");
}

#[test]
fn a_value_that_follows_what_is_drawn_is_not_written() {
    let text = "use geometry\nunit mm\nprogram Posts(length: Length = 35 mm, pitch: Length = 10 mm) {\n    row = while at <= length with at = 0 mm {\n        post = Point(at, 0 mm)\n        next at = at + pitch\n    }\n}\nb: Posts\nfar: Length\nconstraint reach: far = b.row.last.post.x\n";
    let mut desk = Desk::of(text);
    let path = session::parse_path("b.length").expect("a path");
    let to = kernel::Literal::Number(45.0);
    let change = desk.session.apply(desk.id, &kernel::Command::Set(vec![(path, to)]));
    let change = change.expect("the course with one post more holds");
    assert!(change.modes.iter().any(|m| m.message == "b.row takes 5 turns, not 4"), "{change:?}");
    let text = desk.session.text(desk.id).source;
    assert!(text.contains("b: Posts { length = 45 }\nfar: Length\n"), "{text}");
}
