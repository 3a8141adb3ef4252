//! Moving: who yields, and what springs back.

use crate::builder::{
    Builder, LENGTH, Lab, POINT, REAL, add, both, div, equal, mul, n, p, pair, sub,
};
use kernel::{ClassId, Strength};

fn midpoint_line(builder: &mut Builder) -> ClassId {
    let class = builder.class("MidpointLine", &[("p1", POINT), ("p2", POINT), ("mid", POINT)]);
    let half = |c: &str| {
        let sum = add(p(&format!("p1.{c}")), p(&format!("p2.{c}")));
        equal(div(sum, n(2.0)), p(&format!("mid.{c}")))
    };
    builder.constraint(class, both(half("x"), half("y")));
    class
}

fn quadrilateral() -> Lab {
    let mut builder = Builder::new();
    let side = midpoint_line(&mut builder);
    let root = builder
        .class("document", &[("side1", side), ("side2", side), ("side3", side), ("side4", side)]);
    let corners = [(174.0, 178.0), (329.0, 26.0), (445.0, 144.0), (323.0, 312.0)];
    for (i, (x, y)) in corners.into_iter().enumerate() {
        builder.given(root, &format!("side{}.p1", i + 1), pair(x, y));
        let next = (i + 1) % 4 + 1;
        builder.merge(root, &[&format!("side{}.p2", i + 1), &format!("side{next}.p1")]);
    }
    builder.open(root)
}

fn place(lab: &Lab, path: &str) -> (f64, f64) {
    (lab.number(&format!("{path}.x")), lab.number(&format!("{path}.y")))
}

#[test]
fn a_midpoint_takes_the_later_corner_along_and_nothing_else() {
    let mut lab = quadrilateral();
    assert_eq!(place(&lab, "side3.mid"), (384.0, 228.0));
    let report = lab.move_to("side3.mid", &[394.0, 228.0]);
    assert!(report.reached);
    assert_eq!(place(&lab, "side4.p1"), (343.0, 312.0));
    assert_eq!(place(&lab, "side4.mid"), (258.5, 245.0));
    assert_eq!(lab.moved(&report), ["side3.p2.x", "side3.mid.x", "side4.mid.x"]);
}

#[test]
fn a_corner_moves_two_midpoints_by_half() {
    let mut lab = quadrilateral();
    let (m2, m3) = (place(&lab, "side2.mid"), place(&lab, "side3.mid"));
    let report = lab.move_to("side3.p1", &[455.0, 124.0]);
    assert_eq!(place(&lab, "side2.mid"), (m2.0 + 5.0, m2.1 - 10.0));
    assert_eq!(place(&lab, "side3.mid"), (m3.0 + 5.0, m3.1 - 10.0));
    assert_eq!(report.changed.len(), 6);
}

#[test]
fn a_weak_wish_springs_back_when_the_move_ends() {
    let mut builder = Builder::new();
    let root = builder.class("document", &[("x", LENGTH), ("y", LENGTH)]);
    builder.constraint(root, equal(p("x"), n(100.0))).strength = Strength::Weak;
    builder.constraint(root, equal(p("y"), mul(n(2.0), p("x"))));
    let mut lab = builder.open(root);
    assert_eq!((lab.number("x"), lab.number("y")), (100.0, 200.0));
    lab.move_to("y", &[50.0]);
    assert_eq!((lab.number("x"), lab.number("y")), (100.0, 200.0));
    lab.set("y", &[50.0]);
    assert_eq!((lab.number("x"), lab.number("y")), (25.0, 50.0));
}

#[test]
fn a_move_never_lifts_an_anchor() {
    let mut builder = Builder::new();
    let root = builder.class("document", &[("p", POINT)]);
    builder.given(root, "p", pair(1.0, 2.0));
    builder.stay(root, "p", None);
    let mut lab = builder.open(root);
    let report = lab.move_to("p", &[5.0, 5.0]);
    assert!(!report.reached);
    assert_eq!(place(&lab, "p"), (1.0, 2.0));
    lab.set("p", &[5.0, 6.0]);
    assert_eq!(place(&lab, "p"), (5.0, 6.0));
}

#[test]
fn a_point_without_rules_goes_where_it_is_moved() {
    let mut builder = Builder::new();
    let root = builder.class("document", &[("p", POINT)]);
    let mut lab = builder.open(root);
    let report = lab.move_to("p", &[5.0, -0.0]);
    assert!(report.reached);
    assert_eq!(place(&lab, "p"), (5.0, 0.0));
    assert!(lab.number("p.y").is_sign_positive());
}

#[test]
fn a_given_number_is_kept_while_another_can_yield() {
    let mut builder = Builder::new();
    let root = builder.class("document", &[("size", REAL), ("a", REAL), ("b", REAL)]);
    builder.given(root, "size", n(80.0));
    builder.given(root, "a", n(10.0));
    builder.constraint(root, equal(sub(p("b"), p("a")), p("size")));
    let mut lab = builder.open(root);
    assert_eq!(lab.number("b"), 90.0);
    let report = lab.move_to("b", &[100.0]);
    assert_eq!(report.refusal, None, "{report:?}");
    assert_eq!(lab.number("b"), 100.0);
    assert_eq!(lab.number("a") + lab.number("size"), 100.0);
}
