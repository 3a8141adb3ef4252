//! Refusals: nothing changes, and the words name what stands in the way.

use crate::desk::{Desk, at, gallery};
use session::view::{Change, Refusal};
use session::{Command, Literal};

/// Tries something that must be refused; the document must not show that it was tried.
fn refused(desk: &mut Desk, act: impl FnOnce(&mut Desk) -> Result<Change, Refusal>) -> Refusal {
    let before = (desk.moment(), desk.session.status(desk.id));
    let refusal = act(desk).expect_err("this cannot be");
    assert_eq!((desk.moment(), desk.session.status(desk.id)), before);
    refusal
}

#[test]
fn two_wishes_against_a_rule() {
    let mut desk = Desk::of("c: Real = 20\nf: Real\nconstraint convert: c * 1.8 + 32 = f\n");
    desk.set("c", 30.0).expect("c is free");
    let both =
        Command::Set(vec![(at("c"), Literal::Number(10.0)), (at("f"), Literal::Number(10.0))]);
    let refusal = refused(&mut desk, |d| d.apply(&both));
    assert_eq!(refusal.message, "refused: convert would not hold");
    assert_eq!(refusal.constraints, ["convert"]);
    desk.undo();
    assert_eq!(desk.number("c"), 20.0);
}

#[test]
fn a_method_that_fails() {
    let mut desk = Desk::of(&gallery("temperature"));
    let refusal = refused(&mut desk, |d| d.type_in("celsius.shown", "hot"));
    assert_eq!(refusal.constraints, ["celsius.correctText"]);
    assert!(refusal.message.starts_with("refused by celsius.correctText: "), "{}", refusal.message);
}

#[test]
fn no_real_root() {
    let mut desk = Desk::of(&gallery("square-root"));
    let refusal = refused(&mut desk, |d| d.set("product.node.number", -1.0));
    assert!(
        refusal.message.starts_with("refused: 0 is the limit of product.node.number; times.times"),
        "{}",
        refusal.message
    );
}

fn line() -> Literal {
    Literal::Tuple([1.0, 2.0, 3.0, 4.0].into_iter().map(Literal::Number).collect())
}

#[test]
fn an_anchored_place() {
    let mut desk = Desk::of("use geometry\nl: Line\nanchor l.p1\n");
    let pressed = desk.session.press(desk.id, &at("l.p1")).expect_err("an anchor holds it");
    assert_eq!(pressed.message, "refused: l.p1.x is anchored");
    let refusal = refused(&mut desk, |d| d.apply(&Command::Set(vec![(at("l"), line())])));
    assert_eq!(refusal.message, "refused: l.p1.x is anchored");
    let before = desk.moment();
    let change = desk.move_to("l.p1", 1.0, 1.0).expect("a wish may come to nothing");
    assert_eq!((change.edits.len(), desk.moment()), (0, before));
}

#[test]
fn a_rule_without_a_value() {
    let mut desk = Desk::of(&gallery("temperature"));
    let refusal = refused(&mut desk, |d| d.set("fahrenheit.degree", 0.0));
    assert_eq!(refusal.message, "refused: fahrenheit.height would not hold");
}

#[test]
fn what_is_not_there_and_what_is_no_value() {
    let mut desk = Desk::of("use geometry\nline: Line\n");
    let refusal = refused(&mut desk, |d| d.set("lime.p1.x", 1.0));
    assert!(refusal.message.contains("lime"), "{}", refusal.message);
    let refusal = refused(&mut desk, |d| d.type_in("line.p1.x", "wide"));
    assert!(refusal.message.starts_with("`wide` is no value"), "{}", refusal.message);
    let refusal = refused(&mut desk, |d| d.type_in("line.p1.x", "3 kohm"));
    assert_eq!(refusal.message, "`3 kohm` is Resistance (ohm), wanted is Length (m)");
    let refusal = refused(&mut desk, |d| d.set("line.p1.x", f64::NAN));
    assert!(!refusal.message.is_empty());
    let refusal = refused(&mut desk, |d| d.set("line.p1.x", f64::INFINITY));
    assert!(!refusal.message.is_empty());
}

#[test]
fn merges_that_say_nothing() {
    let mut desk = Desk::of("use geometry\nl: Line\na: Real = 1\n");
    let refusal = refused(&mut desk, |d| d.apply(&Command::Merge(vec![at("l.p1"), at("l.p9")])));
    assert!(refusal.message.contains("l.p9"), "{}", refusal.message);
    let refusal = refused(&mut desk, |d| d.apply(&Command::Merge(vec![at("l.p1"), at("a")])));
    assert!(!refusal.diagnostics.is_empty(), "{refusal:?}");
    let refusal = refused(&mut desk, |d| d.apply(&Command::Unmerge(at("l.p1"))));
    assert!(refusal.message.contains("l.p1"), "{}", refusal.message);
}

#[test]
fn nothing_to_undo_or_redo() {
    let mut desk = Desk::of("a: Real = 1\n");
    assert_eq!(refused(&mut desk, |d| d.apply(&Command::Undo)).message, "there is nothing to undo");
    assert_eq!(refused(&mut desk, |d| d.apply(&Command::Redo)).message, "there is nothing to redo");
}

#[test]
fn a_reason_that_would_take_long_to_find_is_left_out() {
    let mut desk = Desk::of(&gallery("bridge"));
    let refusal = refused(&mut desk, |d| d.set("bridge.beam2.tension", 200.0));
    assert_eq!(
        refusal.message,
        "refused: what stands fixed does not leave room for this; bridge.beam2.tension is computed"
    );
    assert!(refusal.constraints.is_empty(), "{refusal:?}");
}

#[test]
fn a_refusal_says_what_a_rule_without_a_name_says() {
    let mut desk = Desk::of(
        "w: Real = 10\nh: Real = 10\nconstraint w * h = 100\nweak constraint h = 10\nconstraint h >= 4\n",
    );
    let refusal = desk.set("w", 30.0).expect_err("the height would be less than four");
    assert_eq!(
        refusal.message,
        "refused: 25 is the limit of w; “w * h = 100”, “h >= 4” would not all hold"
    );
    assert_eq!(refusal.constraints, ["constraint1", "constraint3"]);
}

#[test]
fn a_refusal_names_what_a_constraint_only_reads() {
    let mut desk = Desk::of(
        "s, out, r, u: Real = 1\nconstraint drives: out = s { reads s }\n\
         constraint ohm: u = r * out\nanchor r\n",
    );
    let refusal = desk.set("u", 7.0).expect_err("nothing else could follow");
    assert_eq!(
        refusal.message,
        "refused: drives, ohm would not all hold while r is anchored; drives only reads s"
    );
}

#[test]
fn a_text_of_a_number_names_what_it_has_no_method_for() {
    let text = "n: Real = 3.25\nt: Text\nconstraint told: t = n.text\n";
    let refusal = refused(&mut Desk::of(text), |d| d.type_in("t", "1.5"));
    assert_eq!(refusal.message, "refused: told would not hold; told only reads n");
}

#[test]
fn a_refusal_names_what_is_anchored_among_what_would_not_hold() {
    let text = "use geometry\na: Point = (0, 0)\nb: Point = (10, 0)\nc: Point = (4, 3)\nanchor a, b\n\
        size: Length = 7 m\nconstraint left: a.distance(to: c) = 5 m\nconstraint right: c.distance(to: b) = size\n\
        constraint low: c.y >= 0 m\n";
    let refusal = refused(&mut Desk::of(text), |d| d.set("size", 20.0));
    assert_eq!(
        refusal.message,
        "refused: 15 m is the limit of size; left, right would not all hold while a, b are anchored"
    );
}

#[test]
fn what_is_computed_from_anchored_places_alone_names_them() {
    let mut desk = Desk::of("use geometry\nl: Line { p1 = (0, 0)  p2 = (10, 0) }\nanchor l\n");
    let refusal = refused(&mut desk, |d| d.set("l.length", 5.0));
    assert_eq!(
        refusal.message,
        "refused: what stands fixed does not leave room for this while l.p1, l.p2 are anchored; \
         l.length is computed"
    );
}
