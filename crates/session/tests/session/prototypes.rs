//! The prototype of a class in a pane of its own: drawn, constrained and dragged there, every thing of the class
//! follows.

use crate::desk::{Desk, at};
use session::view::Pointer;
use session::{Command, DocumentId, Path};

const STRUTS: &str = "use geometry
class Strut {
    line: Line { p1 = (0, 0)  p2 = (100, 0) }
    attachers line.p1, line.p2
}
a: Strut
b: Strut { line.p1 = (0, 200)  line.p2 = (100, 240) }
";

/// A document, and the pane of its class.
fn pane() -> (Desk, DocumentId) {
    let mut desk = Desk::of(STRUTS);
    let shown = desk.session.open_prototype(desk.id, "Strut").expect("the class is declared");
    (desk, shown)
}

fn place(desk: &Desk, id: DocumentId, path: &str) -> (f64, f64) {
    let grips = desk.session.picture(id).grips;
    let grip = grips.iter().find(|grip| grip.path == path);
    grip.map(|grip| (grip.x, grip.y)).unwrap_or_else(|| panic!("no grip {path}"))
}

#[test]
fn a_corner_of_the_prototype_is_dragged_and_things_that_have_no_place_of_their_own_follow() {
    let (mut desk, shown) = pane();
    desk.session.press(shown, &at("strut.line.p2")).expect("it can be dragged");
    desk.session.drag(shown, (120.0, 30.0));
    desk.session.release(shown).expect("it can be kept");
    assert_eq!(desk.text(), STRUTS.replace("p2 = (100, 0)", "p2 = (120, 30)"));
    assert_eq!(place(&desk, shown, "strut.line.p2"), (120.0, 30.0));
    assert_eq!(place(&desk, desk.id, "a.line.p2"), (120.0, 30.0));
    assert_eq!(place(&desk, desk.id, "b.line.p2"), (100.0, 240.0));
    // it is a step of the document, which the pane can take back
    assert_eq!(desk.session.status(shown).undo.as_deref(), Some("move Strut.line.p2"));
    desk.session.apply(shown, &Command::Undo).expect("there is a step");
    assert_eq!(desk.text(), STRUTS);
    assert_eq!(place(&desk, shown, "strut.line.p2"), (100.0, 0.0));
}

#[test]
fn lines_drawn_in_the_pane_are_parts_of_every_one() {
    let (mut desk, shown) = pane();
    desk.session.take_tool(shown, "Line").expect("geometry has lines");
    for (x, y) in [(100.0, 0.0), (140.0, 80.0), (0.0, 0.0)] {
        let pointer = Pointer { at: (x, y), reach: 4.0, ..Pointer::default() };
        desk.session.tool_moved(shown, &pointer).expect("a tool is in the hand");
        let view = desk.session.tool_set(shown, &pointer).expect("the place can be set");
        if let Some(command) = &view.command {
            desk.session.apply(shown, command).expect("what was drawn can be made");
            assert!(desk.session.structure(shown).iter().any(|row| row.path == view.makes));
            desk.session.take_tool_again(shown);
        }
    }
    let text = desk.text();
    assert!(text.contains("    line2: Line"), "{text}");
    assert!(text.contains("    merge line.p2 = line2.p1"), "{text}");
    assert!(text.contains("    merge line2.p2 = line3.p1"), "{text}");
    assert!(text.contains("    merge line.p1 = line3.p2"), "{text}");
    // every one is a triangle now
    for thing in ["a", "b"] {
        let last = format!("{thing}.line3");
        assert!(desk.session.structure(desk.id).iter().any(|row| row.path == last), "{text}");
    }
    let status = desk.session.status(desk.id);
    assert_eq!((status.satisfied, status.freedom), (true, 12), "{}", status.message);
    assert_eq!(desk.session.complaints(desk.id), Vec::<String>::new());
    assert_eq!(desk.wrong(), []);
}

#[test]
fn a_dimension_in_the_pane_of_a_class_could_not_be_typed_anew() {
    let (mut desk, shown) = pane();
    let long = "constraint strut.line.length = 120";
    let long = Command::Edit { target: Path::default(), members: long.into() };
    desk.session.apply(shown, &long).expect("it can be said");
    let said = desk.session.annotations(shown);
    let offer = said.first().and_then(|one| one.typed.clone()).expect("it takes another number");
    assert_eq!(offer.value.as_deref(), Some("120"));
    let command = desk.session.said(shown, &offer, Some("80")).expect("it fits");
    desk.session.apply(shown, &command).expect("it holds");
    let text = desk.text();
    assert!(text.contains("    constraint line.length = 80\n"), "{text}");
    assert!(!text.contains("120"), "{text}");
    for thing in ["a", "b"] {
        assert!((desk.number(&format!("{thing}.line.length")) - 80.0).abs() < 1e-6, "{text}");
    }
    assert_eq!(desk.wrong(), [], "{text}");
}

#[test]
fn what_is_said_typed_and_deleted_in_the_pane_is_of_the_class() {
    let (mut desk, shown) = pane();
    let level = Command::Edit {
        target: Path::default(),
        members: "constraint strut.line.p1.y = strut.line.p2.y".into(),
    };
    assert_eq!(desk.session.preview(shown, &level), Ok(None));
    assert_eq!(desk.session.over_constrained(shown, &level), None);
    desk.session.apply(shown, &level).expect("it can be said");
    assert!(desk.text().contains("    constraint line.p1.y = line.p2.y\n"), "{}", desk.text());
    assert_eq!(desk.session.status(desk.id).freedom, 6);
    // it stands on the drawing of the class, and on none of the document
    let said = desk.session.annotations(shown);
    let said = said.iter().map(|one| (one.words.as_str(), one.of.join(" "))).collect::<Vec<_>>();
    assert_eq!(said, [("H", String::from("strut.line.p1 strut.line.p2"))]);
    assert_eq!(desk.session.annotations(desk.id), []);
    desk.session.set_typed(shown, "strut.line.p2.x", "150").expect("it can be typed");
    assert_eq!(place(&desk, desk.id, "a.line.p2"), (150.0, 0.0));
    let whole = desk.session.apply(shown, &Command::Delete(at("strut"))).map_err(|r| r.message);
    assert_eq!(
        whole.map(|change| change.label),
        Err("this is what every Strut is like: delete parts of it".to_string())
    );
    let rule = desk.session.structure(shown).into_iter().find(|row| row.detail.contains(" = "));
    let rule = rule.expect("the rule has a row").path;
    desk.session.apply(shown, &Command::Delete(at(&rule))).expect("it can be deleted");
    assert!(!desk.text().contains("constraint"), "{}", desk.text());
    // without its class there is nothing to show
    desk.type_text("use geometry\na: Line\n");
    assert_eq!(desk.session.prototype_shown(shown), None);
    let none = desk.session.open_prototype(desk.id, "Line").map_err(|refusal| refusal.message);
    assert_eq!(none, Err("the document declares no class Line".to_string()));
}

#[test]
fn a_length_typed_with_a_unit_in_a_pane_gives_the_document_that_unit() {
    let (mut desk, shown) = pane();
    let change = desk.session.set_typed(shown, "strut.line.p2.x", "30 mm").expect("it is free");
    assert_eq!(change.unit.as_deref(), Some("mm"));
    assert!(desk.text().starts_with("use geometry\nunit mm\n"), "{}", desk.text());
    assert!(desk.text().contains("p2 = (30 mm, 0)") || desk.text().contains("p2 = (30, 0)"));
    assert_eq!(place(&desk, shown, "strut.line.p2"), (30.0, 0.0));
    assert_eq!(place(&desk, desk.id, "a.line.p2"), (30.0, 0.0));
    assert_eq!(desk.session.history(desk.id).0.len(), 1, "one step");
    desk.session.apply(shown, &Command::Undo).expect("there is a step");
    assert_eq!(desk.text(), STRUTS);
    assert_eq!(place(&desk, shown, "strut.line.p2"), (100.0, 0.0));
}

#[test]
fn a_length_that_is_refused_in_a_pane_leaves_the_document_without_a_unit() {
    let (mut desk, shown) = pane();
    let hold = Command::Anchor { path: at("strut.line.p2"), held: true };
    desk.session.apply(shown, &hold).expect("it can be held");
    let said = "constraint strut.line.p2.x = 100";
    let said = Command::Edit { target: Path::default(), members: said.into() };
    desk.session.apply(shown, &said).expect("it is so");
    let before = desk.text();
    desk.session.set_typed(shown, "strut.line.p2.x", "30 mm").expect_err("it is 100");
    assert_eq!(desk.text(), before);
    assert_eq!(place(&desk, shown, "strut.line.p2"), (100.0, 0.0));
}

#[test]
fn a_tile_of_the_bin_shows_what_the_constraints_of_its_class_make() {
    let desk = Desk::of("use geometry\n");
    let ends = |class: &str| {
        let entry = desk.session.bin(desk.id).into_iter().find(|entry| entry.class == class);
        let elements = entry.expect("the bin has it").picture.elements;
        let ends = elements.into_iter().find_map(|element| match element.shape {
            drawing::Shape::Segment(a, b) => Some((a, b)),
            _ => None,
        });
        ends.expect("it is drawn as a segment")
    };
    let (a, b) = ends("HorizontalLine");
    assert!((a.y - b.y).abs() < 1e-9 && a.x != b.x, "{a:?} {b:?}");
    let (a, b) = ends("VerticalLine");
    assert!((a.x - b.x).abs() < 1e-9 && a.y != b.y, "{a:?} {b:?}");
}

#[test]
fn what_is_drawn_only_one_above_the_other_has_a_tile() {
    let desk = Desk::of("use drafting\n");
    let bin = desk.session.bin(desk.id);
    let picture = |class: &str| bin.iter().find(|entry| entry.class == class).map(|e| &e.picture);
    for class in ["VerticalDimension", "HorizontalDimension", "LinearDimension"] {
        let picture = picture(class).expect("it is in the bin");
        assert!(!picture.elements.is_empty(), "{class}");
    }
}

#[test]
fn the_tiles_of_an_edited_document_are_those_of_one_that_is_opened() {
    let mut desk = Desk::of("use geometry\np: Point = (1, 2)\n");
    for text in [
        "use geometry\ny down\np: Point = (1, 2)\n",
        "use geometry\nunit mm\nclass HorizontalLine is Line { p2 = (7, 9) }\n",
        "use calculator\n",
        "use geometry\np: Point = (1, 2)\nclass Sail is Line { p2 = (7, 9) }\n",
        "use geometry\np: Point = (1, 2)\nclass Sail is Line { p2 = (8, 9) }\n",
    ] {
        desk.type_text(text);
        let fresh = Desk::of(text);
        assert_eq!(desk.session.bin(desk.id), fresh.session.bin(fresh.id), "{text}");
    }
}

#[test]
fn no_tile_of_dimensions_and_notes_is_empty() {
    let desk = Desk::of("use drafting\n");
    let bin = desk.session.bin(desk.id);
    let empty: Vec<&str> = { bin.iter() }
        .filter(|entry| entry.library == "drafting" && entry.picture.elements.is_empty())
        .map(|entry| entry.class.as_str())
        .collect();
    let is_drawn = |text: &drawing::Shape| matches!(text, drawing::Shape::Text { text, .. } if !text.is_empty());
    let note = bin.iter().find(|entry| entry.class == "Note").expect("drafting has it");
    assert!(note.picture.elements.iter().any(|element| is_drawn(&element.shape)));
    assert_eq!(empty, [""; 0]);
}

#[test]
fn a_curve_by_a_list_of_points_has_a_tile_and_points_to_drag_when_it_is_inserted() {
    for class in ["Spline", "Bezier", "Nurbs"] {
        let mut desk = Desk::of("use drafting\n");
        let bin = desk.session.bin(desk.id);
        let tile = bin.iter().find(|entry| entry.class == class).expect("drafting has it");
        let around = drawing::bounds(&tile.picture).expect("something is drawn");
        assert!(around.width() > 50.0 && around.height() > 10.0, "{class}: {around:?}");
        let command = desk.session.insertion(desk.id, class).expect("there is room");
        desk.apply(&command).expect("it is inserted");
        let grips = desk.session.picture(desk.id).grips;
        assert!(grips.len() >= 4, "{class}: {grips:?} {}", desk.text());
    }
}
