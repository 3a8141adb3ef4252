//! What constructions make in a document: it is seen in every view, picked, spoken of, copied, put into classes; and a
//! class takes constructions as the document does.

use crate::desk::{Desk, at};
use session::drafting::view::Turn;
use session::view::{ClassPlan, Pointer, RowKind};
use session::{Command, Path, Relations};

/// A triangle with the foot of an altitude, a segment to it, and a circle.
const ALTITUDE: &str = "\
use geometry
base: Line { p1 = (0, 0)  p2 = (100, 0) }
side: Line { p2 = (30, 80) }
merge base.p2 = side.p1
foot => Point.projection(of: side.p2, onto: base)
altitude => Line.perpendicular(from: side.p2, to: base)
ring => Circle.through(base.p1, base.p2, side.p2)
";

fn paths(names: &[&str]) -> Vec<Path> {
    names.iter().map(|name| at(name)).collect()
}

fn labels(desk: &Desk, names: &[&str]) -> Vec<String> {
    let offers = desk.session.offers(desk.id, &paths(names)).into_iter();
    offers.map(|offer| offer.label).collect()
}

#[test]
fn each_figure_is_picked_by_its_name_and_has_rows() {
    let desk = Desk::of(ALTITUDE);
    let picture = desk.session.picture(desk.id);
    let tagged = |name: &str| {
        let tags: Vec<usize> = picture.drawing.elements.iter().map(|e| e.tag.0 as usize).collect();
        tags.into_iter().filter(|&tag| picture.paths[tag] == name).count()
    };
    assert_eq!(["foot", "altitude", "ring"].map(tagged), [1, 1, 1]);
    let rows = desk.session.structure(desk.id);
    let row = |path: &str| rows.iter().find(|row| row.path == path).expect("it has a row");
    assert_eq!(
        (row("foot").kind, row("foot").value.as_deref()),
        (RowKind::Virtual, Some("(30, 0)"))
    );
    assert_eq!((row("ring").depth, row("ring").detail.as_str()), (1, "Circle"));
    assert_eq!(row("ring.center").value.as_deref(), Some("(50, 26.875)"));
}

#[test]
fn what_cannot_be_made_now_has_a_row_that_says_why() {
    let desk = Desk::of("use geometry\na: Axis\nb: Axis\nx => Point.intersection(a, b)\n");
    let rows = desk.session.structure(desk.id);
    let row = rows.iter().find(|row| row.path == "x").expect("it can be deleted there");
    assert!(row.value.is_none() && !row.detail.is_empty(), "{row:?}");
}

#[test]
fn figures_are_spoken_of_measured_and_not_merged() {
    let mut desk = Desk::of(ALTITUDE);
    let two = labels(&desk, &["foot", "base.p1"]);
    assert!(two.contains(&"distance".into()) && !two.contains(&"merge".into()), "{two:?}");
    assert!(labels(&desk, &["altitude", "side"]).contains(&"equal length".into()));
    let offers = desk.session.offers(desk.id, &paths(&["foot", "base.p1"]));
    let distance = offers.iter().find(|o| o.label == "distance").expect("it is offered");
    let read = desk.session.only_read(desk.id, distance).expect("there is such a dimension");
    desk.apply(&read).expect("it can be read");
    assert_eq!(desk.number("referenceDistance.reading"), 30.0);
    let held = desk.session.said(desk.id, distance, Some("40")).expect("it fits");
    desk.apply(&held).expect("it can be said");
    assert!(desk.session.status(desk.id).satisfied, "{}", desk.text());
    assert_eq!(desk.number("referenceDistance.reading"), 40.0);
}

#[test]
fn a_point_that_is_drawn_lies_at_a_constructed_one() {
    let mut desk = Desk::of(ALTITUDE);
    let pointer = Pointer { at: (31.0, 1.0), reach: 5.0, ..Pointer::default() };
    desk.session.take_tool(desk.id, "Point").expect("geometry has points");
    desk.session.tool_moved(desk.id, &pointer);
    let view = desk.session.tool_set(desk.id, &pointer).expect("it can be there");
    desk.apply(&view.command.expect("one place makes it")).expect("it can be made");
    assert!(desk.text().contains("constraint point = foot"), "{}", desk.text());
}

#[test]
fn a_tool_names_its_thing_otherwise_than_a_construction() {
    let mut desk = Desk::of("use geometry\nc: Circle\npoint => Point.middle(c.center, c.center)\n");
    desk.session.take_tool(desk.id, "Point").expect("geometry has points");
    let pointer = Pointer { at: (7.0, 9.0), reach: 1.0, ..Pointer::default() };
    let view = desk.session.tool_set(desk.id, &pointer).expect("it can be there");
    assert_eq!(view.makes, "point2");
    desk.apply(&view.command.expect("one place makes it")).expect("it can be made");
    assert_eq!(desk.wrong(), []);
}

#[test]
fn figures_go_along_when_all_is_dragged_copied_or_deleted() {
    let mut desk = Desk::of(ALTITUDE);
    let all = paths(&["base", "side", "foot", "altitude", "ring"]);
    desk.session.press_all(desk.id, &all).expect("they move together");
    desk.session.drag(desk.id, (10.0, 5.0));
    desk.session.release(desk.id).expect("they can be there");
    assert_eq!(desk.place("foot"), (40.0, 5.0));
    let clip = desk.session.copied(desk.id, &all, Relations::Own).expect("they stand alone");
    let (command, names) = desk.session.pasting(desk.id, &clip, 1).expect("they can stand here");
    assert_eq!(names, ["line", "line2", "point", "line3", "circle"]);
    desk.apply(&command).expect("they can be made");
    assert!(
        desk.text().contains("point => Point.projection(of: line2.p2, onto: line)"),
        "{}",
        desk.text()
    );
    assert_eq!(desk.place("point"), (60.0, 25.0));
    desk.apply(&Command::Delete(at("foot"))).expect("it can go");
    assert!(!desk.text().contains("foot"), "{}", desk.text());
}

#[test]
fn a_class_of_a_construction_draws_it() {
    let mut desk = Desk::of(ALTITUDE);
    let all = paths(&["base", "side", "foot", "ring", "altitude"]);
    let scopes = Vec::new();
    let plan = ClassPlan { name: "Tent".into(), scopes, attachers: Vec::new() };
    let (command, name) = desk.session.class_of(desk.id, &all, &plan).expect("they are its parts");
    desk.apply(&command).expect("it can be made");
    let text = desk.text();
    assert!(text.contains("foot: Point = Point.projection(of: side.p2, onto: base)"), "{text}");
    assert_eq!(desk.place(&format!("{name}.foot")), (30.0, 0.0));
    assert!(desk.session.status(desk.id).satisfied, "{text}");
}

#[test]
fn a_class_takes_constructions_in_its_own_pane() {
    let text = "use geometry\nclass Tent {\n    base: Line { p1 = (0, 0)  p2 = (100, 0) }\n    \
                side: Line { p2 = (30, 80) }\n    merge base.p2 = side.p1\n}\na: Tent\n\
                b: Tent { base.p1 = (0, 200)  base.p2 = (100, 200)  side.p2 = (60, 260) }\n";
    let mut desk = Desk::of(text);
    let pane = desk.session.open_prototype(desk.id, "Tent").expect("it is declared");
    let point = |desk: &mut Desk, x: f64, y: f64| {
        let pointer = Pointer { at: (x, y), reach: 3.0, ..Pointer::default() };
        desk.session.point(pane, &pointer).expect("something fits there")
    };
    desk.session.begin(pane, "Point.projection(of,onto)").expect("it is in scope");
    point(&mut desk, 30.0, 80.0);
    let turn = point(&mut desk, 60.0, 0.0);
    assert!(matches!(turn, Turn::Made { next: Some(_), .. }), "{turn:?}");
    let wanted = "point: Point = Point.projection(of: side.p2, onto: base)";
    assert!(desk.text().contains(wanted), "{}", desk.text());
    assert_eq!(desk.place("a.point"), (30.0, 0.0));
    assert_eq!(desk.place("b.point"), (60.0, 200.0));
    // what makes no figure is no part of a class
    desk.session.begin(pane, "value").expect_err("a value is no figure");
    // the next one goes on from what the class has now
    desk.session.begin(pane, "Point.middle(first,second)").expect("it is in scope");
    point(&mut desk, 30.0, 0.0);
    point(&mut desk, 30.0, 80.0);
    assert!(
        desk.text().contains("point2: Point = Point.middle(point, side.p2)"),
        "{}",
        desk.text()
    );
    desk.undo();
    desk.undo();
    assert_eq!(desk.text(), text);
}

#[test]
fn what_follows_already_is_told_and_not_offered() {
    let desk = Desk::of(ALTITUDE);
    let told = |names: &[&str]| desk.session.offers_and_held(desk.id, &paths(names));
    let (offers, held) = told(&["foot", "base"]);
    assert_eq!(held, ["on"]);
    assert!(offers.iter().all(|offer| offer.label != "on"), "{offers:?}");
    assert_eq!(told(&["altitude", "base"]).1, ["perpendicular"]);
}

#[test]
fn a_theorem_is_told_where_no_constraint_says_it() {
    let desk = Desk::of(
        "use geometry\na: Line { p1 = (-219, -182)  p2 = (263, -130) }\nb: Line { p2 = (-28, 146) }\n\
         merge a.p2 = b.p1\nc: Line\nmerge b.p2 = c.p1\nmerge a.p1 = c.p2\n\
         foot => Point.projection(of: b.p2, onto: a)\nm => Point.middle(a.p1, a.p2)\n\
         n => Point.middle(b.p1, b.p2)\nl => Point.middle(c.p1, c.p2)\nring => Circle.through(m, n, l)\n",
    );
    // the circle through the midpoints goes through the feet of the altitudes
    assert_eq!(desk.session.offers_and_held(desk.id, &paths(&["foot", "ring"])).1, ["on"]);
    // what only happens to be so is offered
    let desk =
        Desk::of("use geometry\np: Point = (3, 4)\nring: Circle { center = (0, 0)  radius = 5 }\n");
    let (offers, held) = desk.session.offers_and_held(desk.id, &paths(&["p", "ring"]));
    assert!(held.is_empty() && offers.iter().any(|offer| offer.label == "on"), "{offers:?}");
}

#[test]
fn several_constructed_figures_are_deleted() {
    let mut desk = Desk::of(ALTITUDE);
    let two = paths(&["foot", "ring"]);
    let (command, along) = desk.session.deletion(desk.id, &two).expect("they can go");
    assert!(along.is_empty(), "{along:?}");
    desk.apply(&command).expect("they can go");
    let text = desk.text();
    assert!(
        !text.contains("foot") && !text.contains("ring") && text.contains("altitude"),
        "{text}"
    );
    desk.undo();
    // what is selected does not only go along
    let two = paths(&["base", "foot"]);
    let (_, along) = desk.session.deletion(desk.id, &two).expect("they can go");
    assert!(along.iter().any(|said| said.contains("altitude")), "{along:?}");
    assert!(along.iter().all(|said| !said.contains("foot")), "{along:?}");
}

#[test]
fn lists_and_what_cannot_be_made_now_go_along_with_all() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (90, 0) }\nb: Line { p1 = (0, 50)  p2 = (90, 50) }\n\
         parts => a.divided(into: 3)\nx => Point.intersection(a, b)\n",
    );
    let rows = desk.session.structure(desk.id);
    let own = rows.iter().filter(|row| row.kind.is_thing() && row.depth == 1);
    let own: Vec<Path> = own.map(|row| at(&row.path)).collect();
    assert_eq!(own, paths(&["a", "b", "parts", "x"]));
    desk.session.press_all(desk.id, &own).expect("they move together");
    desk.session.drag(desk.id, (10.0, 5.0));
    desk.session.release(desk.id).expect("they can be there");
    assert_eq!(desk.place("a.p1"), (10.0, 5.0));
    let clip = desk.session.copied(desk.id, &own, Relations::Own).expect("they stand alone");
    let (command, names) = desk.session.pasting(desk.id, &clip, 1).expect("they can stand here");
    desk.apply(&command).expect("they can be made");
    let text = desk.text();
    assert_eq!(names.len(), 4);
    assert!(text.contains(&format!("{} => line.divided(into: 3)", names[2])), "{text}");
    assert!(text.contains(&format!("{} => Point.intersection(line, line2)", names[3])), "{text}");
}

#[test]
fn a_class_keeps_the_comments_of_a_construction() {
    let text = ALTITUDE
        .replace("foot => Point", "/// Where it ends: a => b.\nfoot => // below\n    Point");
    let mut desk = Desk::of(&text);
    let all = paths(&["base", "side", "foot", "ring", "altitude"]);
    let plan = ClassPlan { name: "Tent".into(), scopes: Vec::new(), attachers: Vec::new() };
    let (command, _) = desk.session.class_of(desk.id, &all, &plan).expect("they are its parts");
    desk.apply(&command).expect("it can be made");
    let text = desk.text();
    let doc = text.find("/// Where it ends: a => b.\n").expect("its comment stays");
    assert!(text[doc..].contains("    foot: Point = // below\n"), "{text}");
    assert_eq!(desk.wrong(), [], "{text}");
}
