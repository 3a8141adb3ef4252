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
    // what follows is told while it does
    assert_eq!(desk.session.dragged_along(desk.id), ["rings.radius 48 mm"]);
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

#[test]
fn the_structure_shows_what_a_program_drew_step_by_step() {
    let desk = Desk::of(&gallery("rings"));
    let rows = desk.session.structure(desk.id);
    let row = |path: &str| {
        let found = rows.iter().position(|r| r.path == path);
        &rows[found.unwrap_or_else(|| panic!("there is no row {path}"))]
    };
    assert_eq!(row("rings.column").detail, "6 turns");
    assert_eq!(row("rings.column[2]").name, "[2]");
    // a ring and a hole, each with its centre and radius
    assert_eq!(row("rings.column[2]").descendants, 6);
    assert_eq!(row("rings.column[2].ring").detail, "Circle");
    assert_eq!(row("rings.column[2].ring.radius").value.as_deref(), Some("10 mm"));
    assert_eq!(row("rings.column[0].ring.center").value.as_deref(), Some("(-40 mm, 40 mm)"));
    assert_eq!(row("rings.floor").detail, "Axis, a guide");
    // it leads to where the step is written
    let text = desk.session.text(desk.id).source;
    let (from, _) = row("rings.column[2].ring").span.expect("the step is in this text");
    assert!(
        text[from as usize..].starts_with("ring = Circle.tangent("),
        "{}",
        &text[from as usize..]
    );
    // and the picture tells the same apart
    let picture = desk.session.picture(desk.id);
    let tag = picture.paths.iter().position(|p| p == "rings.column[2].ring").expect("a tag");
    assert_eq!(picture.drawn_by[tag].as_deref(), Some("rings"));
    let own: Vec<_> = picture
        .drawing
        .elements
        .iter()
        .filter(|e| e.tag.0 == tag as u32)
        .map(|e| &e.shape)
        .collect();
    assert!(matches!(own[..], [drawing::Shape::Circle { radius: 10.0, .. }]), "{own:?}");
}

#[test]
fn a_long_run_is_cut_and_says_how_much_there_is_more() {
    let text = "use geometry\nprogram Row(n: Integer = 340) {\n    posts = repeat n times with x = 0 {\n        post = Point(x, 0)\n        next x = x + 1\n    }\n}\nr: Row\n";
    let desk = Desk::of(text);
    let rows = desk.session.structure(desk.id);
    let last = rows.last().expect("there are rows");
    assert_eq!((last.name.as_str(), last.path.as_str()), ("… 240 more", "r.posts"));
    assert!(rows.iter().any(|r| r.path == "r.posts[99].post"));
}

#[test]
fn an_entity_without_a_place_is_dragged_by_the_thing_that_draws_it() {
    let text = "use geometry\nprogram Disc(at: Point = (3, 4), size: Length = 10) {\n    rim = Circle(at, size)\n}\nd: Disc\n";
    let mut desk = Desk::of(text);
    let path = session::parse_path("d.rim").expect("a path");
    let held = desk.session.press(desk.id, &path).expect("its program has a place");
    assert_eq!(held, (3.0, 4.0));
    desk.session.drag(desk.id, (13.0, 4.0));
    desk.session.release(desk.id).expect("it can be kept");
    assert_eq!(value(&desk, "d.at.x"), "13");
}
