//! The steps of a program as the page lists them.

use crate::desk::Desk;

#[test]
fn the_step_that_drew_what_is_selected_is_told() {
    let text = "use geometry
unit mm
program Row(n: Integer = 3, d: Length = 10) {
    turns = repeat n times with at = Point(0, 0) {
        if d > 5 { ring = Circle(center: at, radius: d) } else { ring = Circle(center: at, radius: 5) }
        next at = Point(at.x + 30, 0)
    }
    edge = Line(Point(0, -20), Point(90, -20))
}
class Sheet { row: Row }
row: Row
sheet: Sheet
";
    let desk = Desk::of(text);
    assert_eq!(desk.wrong(), []);
    for (selected, example, step) in [
        ("row.edge", "row", Some("edge")),
        ("row.edge.p1", "row", Some("edge")),
        ("row.turns[1].ring", "row", Some("turns.#0.then.ring")),
        ("sheet.row.edge", "sheet.row", Some("edge")),
        ("row", "row", None),
        ("row.d", "row", None),
    ] {
        let steps = desk.session.steps(desk.id, Some(selected)).expect("a program draws it");
        assert_eq!((&*steps.example, steps.selected.as_deref()), (example, step), "{selected}");
        assert_eq!(steps.program, "Row");
    }
    assert!(desk.session.steps(desk.id, Some("sheet")).is_none());
}
