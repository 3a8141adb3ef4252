//! The steps of a program as the page lists them.

use crate::desk::Desk;
use session::drafting::view::Go;
use session::view::Pointer;

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
    desk.session.begin_change(desk.id, ("circle2", "radius"), None).expect("it has one");
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

#[test]
fn the_steps_and_what_they_say_are_those_of_the_turn_that_made_what_is_selected() {
    let mut desk = Desk::of(
        "use geometry
program Rings(radius: Length = 40) {
    wall = Axis.vertical(x: 0)
    turns = repeat 3 times with under = Axis.horizontal(y: 0), size = radius {
        ring = Circle.tangent(under, wall, radius: size)
        dots = repeat 2 times with r = size {
            dot = Circle.concentric(with: ring, radius: r / 4)
            next r = r / 2
        }
        next under = -ring, size = ring.radius / 2
    }
}
rings: Rings
",
    );
    assert_eq!(desk.wrong(), []);
    let told = |desk: &Desk, selected: &str| {
        let steps = desk.session.steps(desk.id, Some(selected)).expect("a program draws it");
        let of = |name: &str| {
            let row = steps.rows.iter().find(|row| row.name == name);
            row.and_then(|row| row.value.clone()).unwrap_or_default()
        };
        [of("turns"), of("dots"), of("dot")]
    };
    let radius = |desk: &Desk, step: &str, selected: &str| {
        let all = desk.session.step_operands(desk.id, ("rings", step), Some(selected));
        all.into_iter().find(|o| o.slot == "radius").and_then(|o| o.value).expect("a number")
    };
    let first = told(&desk, "rings");
    assert_eq!(first[..2], ["3 turns", "2 turns"]);
    assert!(first[2].contains("radius 10"), "{first:?}");
    let dot = "rings.turns[2].dots[1].dot";
    let third = told(&desk, dot);
    assert_eq!(third[..2], ["turn 3 of 3", "turn 2 of 2"]);
    assert!(third[2].contains("radius 1.25"), "{third:?}");
    assert_eq!(told(&desk, "rings.turns[1].ring")[..2], ["turn 2 of 3", "2 turns"]);
    assert_eq!(radius(&desk, "turns.dots.dot", dot), "1.25");
    // what is picked for one of them is of that turn
    desk.session.record(desk.id, "Rings").expect("it is recorded");
    for (selected, is_there) in [("rings.turns[0].ring", false), (dot, true)] {
        let step = ("turns.dots.dot", "with");
        desk.session.begin_change(desk.id, step, Some(selected)).expect("it is one");
        // the top of the third ring
        let top = Pointer { at: (-10.0, 134.85), reach: 0.5, ..Pointer::default() };
        let turn = desk.session.point(desk.id, &top);
        assert_eq!(turn.is_ok(), is_there, "{selected}: {turn:?}");
        desk.session.give_up(desk.id);
    }
    // what is visited comes before what is selected
    desk.session.visit(desk.id, &Go::UntilDrawn("turns[1].dots[0].dot".into())).expect("drawn");
    assert_eq!(told(&desk, dot)[..2], ["turn 2 of 3", "turn 1 of 2"]);
    assert_eq!(radius(&desk, "turns.dots.dot", dot), "5");
}
