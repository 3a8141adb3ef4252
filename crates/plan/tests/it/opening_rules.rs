//! What rules open into: messages, virtual parts, whole things, lists; and plain faults.

use crate::builder::{
    Builder, POINT, REAL, SET_OF_REAL, add, binary, call, div, equal, mul, n, p, pair, send, sub,
};
use base::Name;
use kernel::{Argument, BinaryOperator, ClassId, Term, Value};
use plan::{EditKind, FaultKind, Target};

fn line(b: &mut Builder) -> ClassId {
    let line = b.class("Line", &[("p1", POINT), ("p2", POINT)]);
    let d = |c: &str| sub(p(&format!("p2.{c}")), p(&format!("p1.{c}")));
    let length = call("sqrt", vec![add(mul(d("x"), d("x")), mul(d("y"), d("y")))]);
    b.message(line, "length", &[], length);
    let middle = |c: &str| div(add(p(&format!("p1.{c}")), p(&format!("p2.{c}"))), n(2.0));
    let arguments = vec![middle("x"), middle("y")];
    let arguments = arguments.into_iter().map(|value| Argument { label: None, value }).collect();
    b.message(line, "middle", &[], Term::Make { class: POINT, arguments });
    let other = |path: &str| {
        let names = path.split('.');
        names.fold(Term::Local(Name::new("to")), Term::send)
    };
    let od = |c: &str| sub(other(&format!("p2.{c}")), other(&format!("p1.{c}")));
    let dot = add(mul(d("x"), od("x")), mul(d("y"), od("y")));
    b.message(line, "perpendicular", &["to"], equal(dot, n(0.0)));
    line
}

#[test]
fn messages_without_end_are_a_fault_at_their_constraint() {
    let mut b = Builder::new();
    let class = b.class("Loop", &[("x", REAL)]);
    b.message(class, "again", &[], add(p("again"), n(1.0)));
    let origin = b.constraint(class, equal(p("x"), p("again"))).origin;
    let root = b.class("document", &[("a", class)]);
    let lab = b.open(root);
    assert_eq!(lab.faults.len(), 1);
    assert_eq!(lab.faults[0].kind, FaultKind::Endless);
    assert_eq!(lab.faults[0].origin, origin);
}

#[test]
fn an_inequality_moves_no_further_than_its_bound() {
    let mut b = Builder::new();
    let root = b.class("document", &[("x", REAL), ("y", REAL)]);
    b.constraint(root, binary(BinaryOperator::LessEqual, n(5.0), p("x")));
    b.constraint(root, binary(BinaryOperator::LessEqual, p("y"), n(5.0)));
    let lab = b.open(root);
    assert!(lab.faults.is_empty());
    assert_eq!((lab.number("x"), lab.number("y")), (5.0, 0.0), "the nearest to zero");
    assert!(lab.opened.unmet.is_empty());
}

#[test]
fn a_difference_of_real_numbers_is_only_tested() {
    let mut b = Builder::new();
    let root = b.class("document", &[("x", REAL), ("y", REAL)]);
    b.constraint(root, binary(BinaryOperator::NotEqual, p("x"), p("y")));
    let lab = b.open(root);
    assert!(lab.faults.is_empty());
    assert_eq!(lab.opened.unmet.len(), 1);
}

#[test]
fn an_unknown_part_is_a_fault() {
    let mut b = Builder::new();
    let root = b.class("document", &[("q", POINT)]);
    b.constraint(root, equal(p("q.z"), n(1.0)));
    let lab = b.open(root);
    assert_eq!(lab.faults[0].kind, FaultKind::UnknownName);
    assert_eq!(lab.faults[0].message, "Point has no part or message `z`");
}

#[test]
fn a_constant_contradiction_is_unmet_and_a_constant_truth_is_not() {
    let mut b = Builder::new();
    let root = b.class("document", &[("x", REAL)]);
    b.constraint(root, equal(n(1.0), n(2.0)));
    b.constraint(root, equal(n(2.0), n(2.0)));
    let lab = b.open(root);
    assert_eq!(lab.opened.unmet.len(), 1);
    assert_eq!(lab.opened.unmet[0].error, Some(1.0));
}

#[test]
fn a_bool_message_is_opened_into_its_definition() {
    let mut b = Builder::new();
    let line = line(&mut b);
    let root = b.class("document", &[("l", line), ("m", line)]);
    b.given(root, "l.p1", pair(0.0, 0.0));
    b.given(root, "l.p2", pair(10.0, 0.0));
    b.given(root, "m.p1", pair(0.0, 0.0));
    b.given(root, "m.p2", pair(0.0, 5.0));
    b.constraint(root, send(p("l"), "perpendicular", vec![p("m")]));
    let mut lab = b.open(root);
    assert_eq!(lab.faults, vec![]);
    lab.move_to("l.p2", &[10.0, 10.0]);
    let (x, y) = (lab.number("m.p2.x"), lab.number("m.p2.y"));
    let (u, v) = (lab.number("m.p1.x"), lab.number("m.p1.y"));
    let (a, b) = (lab.number("l.p1.x"), lab.number("l.p1.y"));
    assert_eq!((lab.number("l.p2.x"), lab.number("l.p2.y")), (10.0, 10.0));
    let dot = (10.0 - a) * (x - u) + (10.0 - b) * (y - v);
    assert!(dot.abs() < 1e-6, "{dot}");
}

#[test]
fn whole_things_are_equal_part_by_part() {
    let mut b = Builder::new();
    let line = line(&mut b);
    let root = b.class("document", &[("l", line), ("q", POINT)]);
    b.given(root, "l.p1", pair(0.0, 2.0));
    b.given(root, "l.p2", pair(10.0, 4.0));
    b.constraint(root, equal(p("q"), p("l.middle")));
    let lab = b.open(root);
    assert_eq!((lab.number("q.x"), lab.number("q.y")), (5.0, 3.0));
}

#[test]
fn a_virtual_part_is_set_and_moved() {
    let mut b = Builder::new();
    let line = line(&mut b);
    let root = b.class("document", &[("l", line)]);
    b.given(root, "l.p2", pair(3.0, 4.0));
    b.given(root, "l.p1", pair(0.0, 0.0));
    let mut lab = b.open(root);
    let me = lab.thing("l");
    let (length, middle) = (p("length"), p("middle"));
    let target = Target::Term { me, term: &length };
    let report = lab.edit_targets(EditKind::Set, &[(target, vec![Value::Number(10.0)])]);
    assert_eq!(report.refusal, None, "{report:?}");
    let dx = lab.number("l.p2.x") - lab.number("l.p1.x");
    let dy = lab.number("l.p2.y") - lab.number("l.p1.y");
    assert!((base::number::hypot(dx, dy) - 10.0).abs() < 1e-8);
    let target = Target::Term { me, term: &middle };
    let wanted = vec![Value::Number(50.0), Value::Number(60.0)];
    let report = lab.edit_targets(EditKind::Move, &[(target, wanted)]);
    assert!(report.reached, "{report:?}");
    assert!((lab.number("l.p1.x") + lab.number("l.p2.x") - 100.0).abs() < 1e-6);
    assert!((lab.number("l.p1.y") + lab.number("l.p2.y") - 120.0).abs() < 1e-6);
}

/// The second pair is built as the first, the third not: its parts are one, and so is its slot.
#[test]
fn a_rule_opened_in_one_thing_serves_those_that_are_built_alike_alone() {
    let mut b = Builder::new();
    let pair_of = b.class("Pair", &[("a", REAL), ("b", REAL)]);
    b.constraint(pair_of, equal(add(p("a"), mul(n(2.0), p("b"))), n(12.0)));
    let root = b.class("document", &[("first", pair_of), ("second", pair_of), ("third", pair_of)]);
    b.merge(root, &["third.a", "third.b"]);
    b.given(root, "first.a", n(2.0));
    b.given(root, "second.a", n(4.0));
    let lab = b.open(root);
    assert!(lab.opened.unmet.is_empty());
    let numbers = ["first.b", "second.b", "third.a", "third.b"].map(|path| lab.number(path));
    assert_eq!(numbers, [5.0, 4.0, 4.0, 4.0]);
}

/// Sums of two, of two again and of three: the third is opened for itself.
#[test]
fn a_rule_over_a_set_counts_its_members() {
    let mut b = Builder::new();
    let sum = b.class("Sum", &[("terms", SET_OF_REAL), ("total", REAL)]);
    b.constraint(sum, equal(send(p("terms"), "sum", vec![]), p("total")));
    let term = b.class("Addend", &[("of", sum), ("value", REAL)]);
    b.insert(term, "value", "of.terms");
    let parts = [("x", sum), ("y", sum), ("z", sum)];
    let terms = ["t0", "t1", "t2", "t3", "t4", "t5", "t6"].map(|name| (name, term));
    let root = b.class("document", &[&parts[..], &terms[..]].concat());
    for (i, of) in ["x", "x", "y", "y", "z", "z", "z"].into_iter().enumerate() {
        b.merge(root, &[&format!("t{i}.of"), of]);
        b.given(root, &format!("t{i}.value"), n(f64::from(1 << i)));
    }
    let lab = b.open(root);
    assert!(lab.opened.unmet.is_empty());
    let totals = ["x.total", "y.total", "z.total"].map(|path| lab.number(path));
    assert_eq!(totals, [3.0, 12.0, 112.0]);
}

/// What a rule says depends on what its owner is merged with: the third is opened for itself.
#[test]
fn a_rule_is_opened_once_for_what_is_merged_with_things_of_the_same_classes() {
    let mut b = Builder::new();
    let sized = b.class("Sized", &[("size", REAL)]);
    let [double, triple] = [("Double", 2.0), ("Triple", 3.0)].map(|(name, factor)| {
        let class = b.subclass(name, sized, &[]);
        b.message(class, "factor", &[], n(factor));
        class
    });
    let twelve = b.subclass("Twelve", sized, &[]);
    b.constraint(twelve, equal(mul(p("size"), p("factor")), n(12.0)));
    let parts = [("d1", double), ("d2", double), ("t", triple)];
    let rules = ["r1", "r2", "r3"].map(|name| (name, twelve));
    let root = b.class("document", &[&parts[..], &rules[..]].concat());
    for pair in [["r1", "d1"], ["r2", "d2"], ["r3", "t"]] {
        b.merge(root, &pair);
    }
    let lab = b.open(root);
    assert_eq!(lab.faults, vec![]);
    assert!(lab.opened.unmet.is_empty());
    let sizes = ["d1.size", "d2.size", "t.size"].map(|path| lab.number(path));
    assert_eq!(sizes, [6.0, 6.0, 4.0]);
}
