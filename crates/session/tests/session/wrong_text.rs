//! A wrong line: what it said last stays in force, and the rest goes on.

use crate::desk::{Desk, at};

const GOOD: &str =
    "use geometry\na: Real = 1\nb: Real\nconstraint sum: b = a + 2\np: Point = (1, 2)\n";

#[test]
fn the_last_good_version_stays_in_force() {
    let mut desk = Desk::of(GOOD);
    let wrong = GOOD.replace("b = a + 2", "b = a +");
    desk.type_text(&wrong);
    assert_eq!(desk.text(), wrong);
    assert_eq!(desk.wrong(), [("expected-expression".to_string(), 4)]);
    assert_eq!(desk.number("b"), 3.0);
    assert!(desk.session.status(desk.id).message.contains("one error in the text"));
}

#[test]
fn edits_elsewhere_go_on_and_leave_the_wrong_line_alone() {
    let mut desk = Desk::of(GOOD);
    let wrong = GOOD.replace("b = a + 2", "b = a + // what?");
    desk.type_text(&wrong);
    desk.set("a", 5.0).expect("a is free");
    assert_eq!(desk.number("b"), 7.0);
    assert_eq!(desk.text(), wrong.replace("a: Real = 1", "a: Real = 5"));
    desk.drag("p", &[(3.0, 4.0)]);
    assert_eq!(
        desk.text(),
        wrong.replace("a: Real = 1", "a: Real = 5").replace("(1, 2)", "(3, 4)")
    );
    assert_eq!(desk.number("b"), 7.0);
    assert_eq!(desk.wrong(), [("expected-expression".to_string(), 4)]);
}

#[test]
fn a_second_mistake_keeps_what_was_before_the_first() {
    let mut desk = Desk::of(GOOD);
    desk.type_text(&GOOD.replace("b = a + 2", "b = a +"));
    desk.type_text(&GOOD.replace("b = a + 2", "b ="));
    assert_eq!(desk.number("b"), 3.0);
    desk.type_text(&GOOD.replace("b = a + 2", "b = a + 4"));
    assert_eq!((desk.number("b"), desk.wrong()), (5.0, Vec::new()));
}

#[test]
fn mending_the_line_brings_everything_back() {
    let mut desk = Desk::of(GOOD);
    let before = desk.moment();
    desk.type_text(&GOOD.replace("p: Point", "p: Pont"));
    assert_eq!(desk.wrong(), [("unknown-class".to_string(), 5)]);
    assert_eq!(desk.number("p.x"), 1.0);
    desk.type_text(GOOD);
    assert_eq!(desk.moment(), before);
    assert_eq!(desk.wrong(), Vec::new());
}

#[test]
fn a_wrong_class_keeps_its_things() {
    let good =
        "class Pair {\n    x: Real = 1\n    y: Real\n    constraint twice: y = 2 * x\n}\np: Pair\n";
    let mut desk = Desk::of(good);
    let wrong = good.replace("y = 2 * x", "y = 2 * z");
    desk.type_text(&wrong);
    assert_eq!(desk.wrong(), [("unknown-name".to_string(), 4)]);
    assert_eq!(desk.number("p.y"), 2.0);
    desk.set("p.x", 4.0).expect("x is free");
    assert_eq!(desk.number("p.y"), 8.0);
    assert_eq!(desk.text(), wrong.replace("p: Pair", "p: Pair { x = 4 }"));
}

#[test]
fn a_value_inside_a_wrong_line_is_not_rewritten() {
    let mut desk = Desk::of(GOOD);
    let wrong = GOOD.replace("p: Point = (1, 2)", "p: Point = (1, 2");
    desk.type_text(&wrong);
    assert!(!desk.wrong().is_empty());
    let _ = desk.session.press(desk.id, &at("p"));
    desk.session.drag(desk.id, (30.0, 40.0));
    let _ = desk.session.release(desk.id);
    assert!(desk.text().contains("p: Point = (1, 2\n"), "{}", desk.text());
    let opened = desk.moment();
    desk.type_text(GOOD);
    desk.undo();
    assert_eq!(desk.moment(), opened);
}

#[test]
fn what_a_wrong_text_cannot_say_is_refused() {
    let good = "class Box {\n    wide: Real = 3\n    high: Real\n    constraint square: high = wide\n}\nb: Box { wide = 5 }\n";
    let mut desk = Desk::of(good);
    desk.type_text(&good.replace("    wide: Real = 3\n", ""));
    let before = (desk.moment(), desk.undo_label());
    let refusal = desk.set("b.wide", 6.0).expect_err("there is no line to write it in");
    assert_eq!(refusal.message, "refused: where b.wide would be written, the text has an error");
    assert_eq!((desk.moment(), desk.undo_label()), before);
}

#[test]
fn an_anchor_can_be_set_beside_a_wrong_line() {
    let mut desk = Desk::of(GOOD);
    let wrong = GOOD.replace("b = a + 2", "b = = a");
    desk.type_text(&wrong);
    let anchor = session::Command::Anchor { path: at("p"), held: true };
    desk.apply(&anchor).expect("p can be anchored");
    assert_eq!(desk.text(), format!("{wrong}anchor p\n"));
    assert!(desk.session.press(desk.id, &at("p")).is_err());
}
