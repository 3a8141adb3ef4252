//! The steps of a program as the page lists them.

use crate::demonstrations::{By, draw, open_in, sheet};
use crate::desk::Desk;
use session::drafting::view::{Ends, Go, Wants};
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

#[test]
fn while_a_turn_or_a_branch_is_drawn_steps_before_it_and_in_it_go_and_are_changed() {
    let mut desk = Desk::recording("Row", &[("pitch", "20"), ("wide", "60")]);
    let step = |desk: &mut Desk, tool: &str, operands: &[&str]| {
        let operands: Vec<By<'_>> = operands.iter().map(|o| By::Typed(o)).collect();
        draw(desk, tool, &operands)
    };
    step(&mut desk, "Circle", &["0, 0", "5"]);
    step(&mut desk, "Circle", &["0, 0", "7"]);
    desk.session.begin_choice(desk.id).expect("it is recorded");
    desk.session.enter(desk.id, "wide > 10").expect("a condition");
    step(&mut desk, "Point", &["1, 1"]);
    desk.session.end_choice(desk.id).expect("one branch is enough");
    desk.session.begin_choice(desk.id).expect("it is recorded");
    desk.session.enter(desk.id, "circle2.radius > 1").expect("a condition");
    step(&mut desk, "Circle", &["circle.center", "2"]);
    desk.session.begin_loop(desk.id, "").expect("a loop");
    step(&mut desk, "Circle", &["pitch, 0", "3"]);
    step(&mut desk, "Line", &["0, 0", "circle4.center"]);
    let is_open = |desk: &Desk| {
        let open = open_in(desk);
        open.len() == 2 && open[0].ends_with("circle2.radius > 1") && open[1].contains("turns")
    };
    assert!(is_open(&desk), "{:?}", open_in(&desk));
    // what was drawn in the turn
    desk.session
        .begin_change(desk.id, ("#1.then.turns.circle4", "radius"), None)
        .expect("it is one");
    desk.session.enter(desk.id, "pitch / 4").expect("a number");
    assert!(desk.text().contains("circle4 = Circle(center: Point(pitch, 0), radius: pitch / 4)"));
    desk.session.begin_delete(desk.id, "#1.then.turns.circle4").expect("it is there");
    desk.session.enter(desk.id, "circle3").expect("a circle");
    assert!(desk.text().contains("line = Line(Point(0, 0), circle3.center)"), "{}", desk.text());
    assert!(!desk.text().contains("circle4"));
    assert!(is_open(&desk), "{:?}", open_in(&desk));
    // what was drawn before both: a whole `if`, and a circle that is asked about
    desk.session.begin_delete(desk.id, "#0").expect("it is there");
    assert!(!desk.text().contains("wide > 10") && is_open(&desk), "{:?}", open_in(&desk));
    desk.session.begin_delete(desk.id, "circle").expect("it is there");
    desk.session.enter(desk.id, "circle2").expect("a circle");
    assert!(desk.text().contains("circle3 = Circle(center: circle2.center, radius: 2)"));
    assert!(is_open(&desk), "{:?}", open_in(&desk));
    // what is being drawn, and what it was begun by, stays
    for (step, why) in [
        ("#0", "the `if` is still being drawn: end it first, or undo it"),
        ("#0.then.turns", "turns is still being drawn: end it first, or undo it"),
        (
            "circle2",
            "the `if` was begun by circle2, and is still being drawn: end it first, or undo it",
        ),
    ] {
        let refused = desk.session.begin_delete(desk.id, step).expect_err("it stays");
        assert_eq!(refused.message, why);
    }
    desk.session.begin_change(desk.id, ("#0", "condition"), None).expect_err("it is being drawn");
    // the second turn is asked about: now nothing goes
    step(&mut desk, "Circle", &["pitch, 0", "3"]);
    desk.session.end_turn(desk.id, Ends::Times).expect("the turn is drawn");
    let refused =
        desk.session.begin_delete(desk.id, "#0.then.turns.line").expect_err("it is asked");
    assert_eq!(refused.message, "turns waits for an answer: give it first, or undo it");
    let asked = |desk: &Desk| match desk.session.prompt(desk.id)?.wants {
        Wants::Recurrence(asked) => Some(asked.first),
        _ => None,
    };
    while let Some(first) = asked(&desk) {
        desk.session.enter(desk.id, &first).expect("the same");
    }
    desk.session.enter(desk.id, "2").expect("two turns");
    desk.session.end_choice(desk.id).expect("one branch is enough");
    desk.session.stop_recording(desk.id).expect("nothing is open");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    let whole = desk.text();
    while !desk.session.history(desk.id).0.is_empty() {
        desk.undo();
    }
    while !desk.session.history(desk.id).1.is_empty() {
        desk.redo();
    }
    assert_eq!(desk.text(), whole);
}

#[test]
fn where_the_step_that_comes_next_goes_the_visit_is_before_the_one_behind_it() {
    let mut desk = holes();
    desk.session.visit(desk.id, &Go::To("circle2".into())).expect("it is there");
    desk.session.begin_delete(desk.id, "circle2").expect("it is there");
    desk.session.enter(desk.id, "circle").expect("another circle");
    let steps = desk.session.steps(desk.id, None).expect("it is recorded");
    assert_eq!(steps.at.as_deref(), Some("pattern"));
}

#[test]
fn what_a_turn_began_with_is_visited_where_that_turn_begins() {
    let mut desk = sheet();
    for (picked, step, turns) in [
        ("turns[2].start", "turns.circle", "turn 3 of 3"),
        ("turns[1]", "turns.circle", "turn 2 of 3"),
        ("turns[1].turns2[1].from", "turns.turns2.circle2", "turn 2 of 3"),
        ("turns", "turns", "3 turns"),
    ] {
        desk.session.visit(desk.id, &Go::UntilDrawn(picked.into())).expect("it is drawn");
        let steps = desk.session.steps(desk.id, None).expect("it is recorded");
        let row = steps.rows[0].value.as_deref();
        assert_eq!((steps.at.as_deref(), row), (Some(step), Some(turns)), "{picked}");
    }
}

#[test]
fn of_the_set_that_a_loop_goes_over_one_goes_and_the_loop_stays() {
    let mut desk = Desk::of(
        "use geometry
program Flange(d: Length = 12) {
    circle = Circle(center: Point(0, 0), radius: d)
    circle2 = Circle(center: Point(40, 0), radius: d)
    turns = for element in [circle, circle2] {
        rim = Circle.concentric(with: element, radius: d / 2)
    }
    line = Line(circle2.center, Point(9, 9))
}
flange: Flange
",
    );
    desk.session.record(desk.id, "Flange").expect("it is there");
    let whole = desk.text();
    desk.session.begin_delete(desk.id, "circle2").expect("it is there");
    let prompt = desk.session.prompt(desk.id).expect("the line speaks of it");
    assert_eq!(prompt.label, "Delete circle2, 1 of 1");
    assert!(prompt.words.starts_with("line is drawn from circle2"), "{}", prompt.words);
    desk.session.enter(desk.id, "circle").expect("another circle");
    assert!(desk.text().contains("for element in [circle] {"), "{}", desk.text());
    assert!(desk.text().contains("line = Line(circle.center"), "{}", desk.text());
    assert_eq!(desk.wrong(), []);
    // the last of it is asked about
    desk.session.begin_delete(desk.id, "circle").expect("it is there");
    let prompt = desk.session.prompt(desk.id).expect("the loop has no other");
    assert!(prompt.words.starts_with("turns is drawn from circle"), "{}", prompt.words);
    desk.session.give_up(desk.id);
    desk.undo();
    assert_eq!(desk.text(), whole);
}
