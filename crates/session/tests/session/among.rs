//! What is offered for several things at once, and typed where it stands on the drawing.

use crate::desk::Desk;
use crate::offering::{labels, offers, take};
use session::Command;

#[test]
fn a_slot_took_twelve_clicks_to_be_tangent() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nb: Line { p1 = (100, 42)  p2 = (0, 40) }\n\
         c: Arc { center = (101, 20)  start = a.p2  end = b.p1 }\n\
         d: Arc { center = (0, 19)  start = b.p2  end = a.p1 }\n",
    );
    let all = ["a", "b", "c", "d"];
    let of = |desk: &Desk| offers(desk, &all).into_iter().find(|offer| offer.label == "tangent");
    let offer = of(&desk).expect("all four corners");
    assert_eq!(offer.members.lines().count(), 4, "{}", offer.members);
    take(&mut desk, &["a", "b", "c", "d"], "tangent", None);
    assert_eq!(of(&desk), None);
    // what is said of one corner already, is not said again
    desk.apply(&Command::Undo).expect("back");
    take(&mut desk, &["a", "c"], "tangent", None);
    let offer = of(&desk).expect("the other corners");
    assert_eq!(offer.members.lines().count(), 3, "{}", offer.members);
}

#[test]
fn a_dimension_by_an_expression_did_not_answer_a_double_click() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nb: Line { p1 = (0, 50)  p2 = (50, 50) }\n\
         constraint a.length = 2 * b.length\n",
    );
    let said = desk.session.annotations(desk.id).pop().expect("it stands on the drawing");
    let typed = said.typed.expect("it can be typed anew");
    assert_eq!(typed.value.as_deref(), Some("2 * b.length"));
    for value in ["3 * b.length", "120"] {
        let command = desk.session.said(desk.id, &typed, Some(value)).expect("it fits");
        desk.apply(&command).expect("it can be said");
        let text = desk.text();
        assert!(text.ends_with(&format!("constraint a.length = {value}\n")), "{text}");
        assert!(desk.session.status(desk.id).satisfied, "{text}");
    }
}

#[test]
fn three_lines_are_made_parallel_at_once() {
    let lines = "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 10) }\nb: Line { p1 = (0, 50)  p2 = (90, 80) }\n\
                 c: Line { p1 = (0, 90)  p2 = (90, 85) }\n";
    let mut desk = Desk::of(lines);
    take(&mut desk, &["a", "b", "c"], "parallel", None);
    // lines that meet would come to lie in one
    let chain = Desk::of(&format!("{lines}merge a.p2 = b.p1\n"));
    assert!(!labels(&chain, &["a", "b", "c"]).contains(&"parallel".into()));
}
