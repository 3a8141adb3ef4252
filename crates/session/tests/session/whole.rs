//! Whole numbers among real ones: they step over by ones, and what cannot be found is said.

use crate::desk::Desk;
use session::view::ModeView;

/// Posts at the ends and between, no further apart than 30.
const FENCE: &str = "\
use geometry
rail: Line { p1 = (0, 0)  p2 = (100, 0) }
anchor rail.p1
gaps: Integer in 1..200
gap: Length
constraint even: gap * gaps = rail.length
constraint close: gap <= 30
";

fn told(modes: &[ModeView]) -> Vec<&str> {
    modes.iter().map(|m| m.message.as_str()).collect()
}

#[test]
fn a_drag_steps_over_by_ones_and_tells_it() {
    let mut desk = Desk::of(FENCE);
    assert_eq!((desk.number("gaps"), desk.number("gap")), (4.0, 25.0));
    let drag = desk.hold("rail.p2", &[(110.0, 0.0)]);
    assert!(drag.reached && drag.modes.is_empty(), "{drag:?}");
    let drag = desk.session.drag(desk.id, (125.0, 0.0));
    assert_eq!(told(&drag.modes), ["gaps is 5 now"]);
    let drag = desk.session.drag(desk.id, (155.0, 0.0));
    assert_eq!(told(&drag.modes), ["gaps is 6 now"]);
    let change = desk.session.release(desk.id).expect("the drag can be kept");
    assert_eq!(told(&change.modes), ["gaps is 6 now"]);
    assert_eq!((desk.number("gaps"), desk.number("gap")), (6.0, 155.0 / 6.0));
}

#[test]
fn a_drag_out_and_back_depends_on_the_press_alone() {
    let mut desk = Desk::of(FENCE);
    desk.hold("rail.p2", &[(155.0, 0.0), (400.0, 0.0)]);
    desk.session.drag(desk.id, (100.0, 0.0));
    desk.session.release(desk.id).expect("the drag can be kept");
    assert_eq!((desk.number("gaps"), desk.number("gap")), (4.0, 25.0));
}

#[test]
fn whole_numbers_that_were_not_found_leave_it_undecided() {
    let text = "n: Integer\nx: Real\nconstraint wave: x = sin(n)\nconstraint half: x <= -0.99999\n";
    let desk = Desk::of(text);
    let n = desk.number("n");
    assert!(base::number::sin(n) <= -0.99999 + 1e-9, "{n}");
    let mut desk = Desk::of(&text.replace("x <= -0.99999", "x = 0.5"));
    let status = desk.session.status(desk.id);
    assert!(!status.satisfied);
    let analysis = desk.session.analysis(desk.id);
    let said = format!("{analysis:?}");
    assert!(
        said.contains("too hard: stopped after 40 thousand choices of whole numbers"),
        "{said}"
    );
}
