//! The unit of a sheet: taken over from the first length that a hand types with one.

use crate::desk::{Desk, at, edited};
use session::drafting::view::NewParameter;
use session::view::{Pointer, TypedLength};
use session::{Command, Path, Relations};

const LINE: &str = "use geometry\nline: Line { p1 = (-200, 107)  p2 = (100, 7) }\n";

fn say(members: &str) -> Command {
    Command::Edit { target: Path::default(), members: members.into() }
}

fn shown(desk: &Desk, path: &str) -> String {
    let row = desk.row(path);
    format!("{} {}", row.text, row.unit)
}

#[test]
fn a_dimension_in_millimetres_does_not_shrink_a_drawn_line_to_nothing() {
    let mut desk = Desk::of(LINE);
    let change = desk.apply(&say("constraint line.length = 30 mm")).expect("it can be so long");
    assert_eq!(change.unit.as_deref(), Some("mm"));
    assert_eq!(edited(LINE, &change), desk.text());
    assert!(desk.text().starts_with("use geometry\nunit mm\nline: Line {"), "{}", desk.text());
    // the end that stays is where it was, in millimetres
    assert_eq!(shown(&desk, "line.length"), "30 mm");
    assert_eq!(
        (shown(&desk, "line.p1.x"), shown(&desk, "line.p1.y")),
        ("-200 mm".into(), "107 mm".into())
    );
    assert_eq!(desk.wrong(), []);
    assert_eq!(desk.session.history(desk.id).0.len(), 1, "one step");
    desk.undo();
    assert_eq!(desk.text(), LINE);
}

#[test]
fn a_value_in_inches_is_not_set_among_metres() {
    let mut desk = Desk::of(LINE);
    let change = desk.type_in("line.p2.x", "4 in").expect("it is free");
    assert_eq!(change.unit.as_deref(), Some("in"));
    assert_eq!(shown(&desk, "line.p2.x"), "4 in");
    assert_eq!(shown(&desk, "line.p1.x"), "-200 in");
    assert_eq!(edited(LINE, &change), desk.text());
}

#[test]
fn a_program_recorded_on_an_empty_sheet_is_in_the_unit_of_its_parameters() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.record(desk.id, "Disc").expect("a new program");
    let new = NewParameter { name: "r".into(), example: "30 mm".into(), ..NewParameter::default() };
    let change = desk.session.define_parameter(desk.id, &new).expect("it is new");
    assert_eq!(change.unit.as_deref(), Some("mm"));
    desk.session.begin(desk.id, "Circle").expect("there are circles");
    for operand in ["0,0", "r"] {
        desk.session.enter(desk.id, operand).expect("it is one");
    }
    let text = desk.text();
    assert!(text.contains("\nunit mm\n") && text.contains("r: Length = 30 mm"), "{text}");
    // 30 on the sheet, not 0.03
    let drawn = desk.session.picture(desk.id).drawing;
    let reaches = drawn.elements.iter().any(|e| format!("{:?}", e.shape).contains("30.0"));
    assert!(reaches, "{drawn:?}");
}

#[test]
fn a_construction_by_hand_takes_its_unit_to_the_sheet() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.begin(desk.id, "Line.horizontal(from,length)").expect("there are such lines");
    for operand in ["12, 0", "3 cm"] {
        desk.session.enter(desk.id, operand).expect("it is one");
    }
    assert!(desk.text().starts_with("use geometry\nunit cm\n"), "{}", desk.text());
}

#[test]
fn a_sheet_with_quantities_made_of_lengths_stays_in_metres() {
    let text = format!("{LINE}load: Force = 4 N\n");
    let mut desk = Desk::of(&text);
    let change = desk.apply(&say("constraint line.length = 30 mm")).expect("it can be so long");
    assert_eq!(change.unit, None);
    assert!(!desk.text().contains("unit mm"));
}

#[test]
fn what_is_refused_leaves_the_sheet_without_a_unit() {
    let mut desk = Desk::of(LINE);
    let before = desk.moment();
    desk.apply(&say("constraint line.length = 30 mm +")).expect_err("that is no rule");
    desk.type_in("line.direction", "30 mm").expect_err("that is no angle");
    assert_eq!(desk.moment(), before);
    assert!(desk.session.history(desk.id).0.is_empty());
}

#[test]
fn a_sheet_stays_in_metres_where_a_library_has_some() {
    let text = "use geometry\nuse trusses\nline: Line { p1 = (-200, 107)  p2 = (100, 7) }\n";
    let mut desk = Desk::of(text);
    let change = desk.type_in("line.p2.x", "30 mm").expect("it is free");
    assert_eq!(change.unit, None);
    assert!(!desk.text().contains("unit mm"));
}

#[test]
fn copies_bring_the_unit_of_their_sheet() {
    let source =
        Desk::of("use geometry\nunit mm\nring: Circle { center = (0, 0)  radius = 5 cm }\n");
    let clip = source.session.copied(source.id, &[at("ring")], Relations::Own);
    let mut desk = Desk::of("use geometry\n");
    let clip = clip.expect("it is a thing");
    let (command, _) = desk.session.pasting(desk.id, &clip, 1).expect("it is known here");
    desk.apply(&command).expect("it stands");
    assert!(desk.text().contains("unit mm"), "{}", desk.text());
    assert_eq!(shown(&desk, "ring.radius"), "5 cm");
}

#[test]
fn a_circle_drawn_with_a_typed_radius_takes_its_unit_over_and_keeps_it() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.take_tool(desk.id, "Circle").expect("there are circles");
    desk.session.tool_set(desk.id, &Pointer::default()).expect("its middle");
    let length = TypedLength::read("30 mm");
    let typed = Pointer { at: (5.0, 0.0), length, ..Pointer::default() };
    let view = desk.session.tool_moved(desk.id, &typed).expect("a tool is held");
    assert!(view.hint.contains("digits: its radius"), "{}", view.hint);
    let view = desk.session.tool_set(desk.id, &typed).expect("its radius");
    let change = desk.apply(&view.command.expect("it is drawn")).expect("it can be made");
    assert_eq!(change.unit.as_deref(), Some("mm"));
    assert_eq!(shown(&desk, "circle.radius"), "30 mm");
    assert!(desk.text().contains("constraint circle.radius = 30 mm"), "{}", desk.text());
}

#[test]
fn a_drawing_is_written_in_millimetres_however_its_text_counts() {
    let line = "use geometry\nuse constants\nl: Line { p1 = (0 m, 0 m)  p2 = (3 m, 4 m) }\n";
    let photon = "energy: Energy = constants.h * constants.c / l.length\n";
    let end = "11\n3000.0\n21\n4000.0\n";
    for text in [line.to_string(), format!("{line}{photon}")] {
        let desk = Desk::of(&text);
        assert!(desk.session.dxf(desk.id).replace('\r', "").contains(end), "{text}");
    }
    let bare = Desk::of("use geometry\nl: Line { p1 = (0, 0)  p2 = (3, 4) }\n");
    assert!(bare.session.dxf(bare.id).replace('\r', "").contains("11\n3.0\n21\n4.0\n"));
}
