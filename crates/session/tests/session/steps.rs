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

/// A ring with holes, which is recorded further.
fn holes() -> Desk {
    let mut desk = Desk::recording("Ring", &[("count", "4")]);
    for (tool, operands) in [
        ("Circle", &["0, 0", "50"][..]),
        ("Circle", &["30, 0", "5"]),
        (":pattern(about,count)", &["circle2", "circle.center", "count"]),
    ] {
        desk.session.begin(desk.id, tool).expect("it is in scope");
        for typed in operands {
            desk.session.enter(desk.id, typed).unwrap_or_else(|r| panic!("{}", r.message));
        }
        desk.session.give_up(desk.id);
    }
    desk
}

#[test]
fn an_undo_leaves_the_question_that_a_deletion_asked() {
    let mut desk = holes();
    desk.session.begin_delete(desk.id, "circle").expect("it is a step");
    let asked = desk.session.prompt(desk.id).expect("the pattern speaks of it").words;
    assert!(asked.starts_with("pattern is drawn from circle"), "{asked}");
    let text = desk.text();
    desk.undo();
    assert_eq!(desk.session.prompt(desk.id), None);
    desk.session.delete_along(desk.id).expect_err("nothing is asked");
    desk.redo();
    assert_eq!((desk.text(), desk.session.prompt(desk.id)), (text, None));
    // what of a step is changed, too
    desk.session.begin_change(desk.id, ("circle2", "radius")).expect("it has one");
    desk.undo();
    assert_eq!(desk.session.prompt(desk.id), None);
}

#[test]
fn a_pattern_of_one_has_no_further_figures() {
    let mut desk = holes();
    let says = |desk: &Desk| {
        let steps = desk.session.steps(desk.id, None).expect("it is recorded");
        steps.rows.into_iter().find(|row| row.name == "pattern").and_then(|row| row.value)
    };
    assert_eq!(says(&desk).as_deref(), Some("3 figures"));
    desk.type_in("ring.count", "1").expect("one hole");
    assert_eq!(says(&desk).as_deref(), Some("0 figures"));
}
