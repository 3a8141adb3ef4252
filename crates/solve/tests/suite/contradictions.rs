//! What cannot hold: contradictions, redundancies, degenerate and empty systems.

use crate::builder::{Sheet, bits};
use solve::{Level, Reason, Status};

#[test]
fn an_empty_system_is_solved() {
    let sheet = Sheet::default();
    let plan = sheet.plan();
    assert!(plan.steps().is_empty() && plan.report.freedom == 0);
    assert!(sheet.run(&plan, &[], &mut solve::NoHost).1.is_solved());
}

#[test]
fn all_fixed_is_only_tested() {
    let mut s = Sheet::default();
    let (a, b) = (s.fixed(2.0), s.fixed(3.0));
    let (va, vb) = (s.v(a), s.v(b));
    let r = s.require(va, vb);
    let plan = s.plan();
    assert_eq!(plan.report.rejected.len(), 1);
    assert!(plan.report.rejected[0].circuit.is_empty());
    let (values, outcome) = s.run(&plan, &[], &mut solve::NoHost);
    assert_eq!(outcome.status, Status::Stopped(Reason::Conflict));
    assert_eq!((outcome.unmet[0].relation, outcome.unmet[0].error), (r, 1.0));
    assert_eq!(values, [2.0, 3.0]);
    assert!(s.set(&[(a, 3.0)]).1.is_solved());
}

#[test]
fn a_contradiction_names_its_circuit_and_changes_nothing() {
    let mut s = Sheet::default();
    let (x, y) = (s.kept(1.0), s.kept(2.0));
    let (vx, vy) = (s.v(x), s.v(y));
    let sum = s.add(vx, vy);
    let twice = s.add(sum, sum);
    let (three, eight) = (s.c(3.0), s.c(8.0));
    let first = s.require(sum, three);
    let other = s.kept(7.0);
    let vo = s.v(other);
    let unrelated = s.mul(vo, vo);
    let fortynine = s.c(49.0);
    s.require(unrelated, fortynine);
    s.require(twice, eight);
    let plan = s.plan();
    assert_eq!(plan.report.rejected[0].circuit, [(first, 0)]);
    let (values, outcome) = s.run(&plan, &[], &mut solve::NoHost);
    assert_eq!(outcome.status, Status::Stopped(Reason::Conflict));
    assert_eq!(bits(&values), bits(&s.x0));
}

#[test]
fn setting_both_sides_against_a_rule_is_refused() {
    let mut s = Sheet::default();
    let (c, f) = (s.given(20.0), s.kept(68.0));
    let (vc, vf) = (s.v(c), s.v(f));
    let (k, o) = (s.c(1.8), s.c(32.0));
    let product = s.mul(vc, k);
    let left = s.add(product, o);
    s.require(left, vf);
    let (values, outcome, _) = s.set(&[(c, 10.0), (f, 10.0)]);
    assert_eq!(outcome.status, Status::Stopped(Reason::Conflict));
    assert_eq!(values[c as usize], 10.0, "refused: as they came");
}

#[test]
fn a_redundant_rule_frees_nothing() {
    // the sum of currents at two nodes of one loop: the second says what the first says
    let mut s = Sheet::default();
    let v = s.given(1.5);
    let resistors = [s.given(100.0), s.given(100.0)];
    let (i1, i2) = (s.kept(0.0075), s.kept(0.0075));
    let middle = s.kept(0.75);
    let (a, b) = (s.v(i1), s.v(i2));
    let zero = s.c(0.0);
    let (d, e) = (s.sub(a, b), s.sub(b, a));
    s.require(d, zero);
    s.require(e, zero);
    let (vv, vm) = (s.v(v), s.v(middle));
    let upper = s.sub(vv, vm);
    for (drop, (i, r)) in [(upper, (a, resistors[0])), (vm, (b, resistors[1]))] {
        let r = s.v(r);
        let product = s.mul(i, r);
        s.require(drop, product);
    }
    let plan = s.plan();
    assert!(plan.report.yielded.is_empty(), "{:?}", plan.report);
    assert_eq!(plan.report.rejected.len(), 1);
    assert_eq!(plan.report.freedom, 0);
    let (values, outcome, plan) = s.set(&[(resistors[1], 300.0)]);
    assert!(outcome.is_solved() && plan.report.yielded.is_empty());
    crate::builder::close(values[i1 as usize], 0.00375, 1e-15);
    crate::builder::close(values[middle as usize], 1.125, 1e-12);
}

#[test]
fn a_zero_divisor_stores_nothing() {
    let mut s = Sheet::default();
    let (x, y) = (s.given(2.0), s.kept(3.0));
    let (vx, vy) = (s.v(x), s.v(y));
    let product = s.mul(vx, vy);
    let six = s.c(6.0);
    s.require(product, six);
    let (values, outcome, _) = s.set(&[(x, 0.0)]);
    assert!(!outcome.is_solved());
    assert!(values.iter().all(|v| v.is_finite()));
    assert_eq!(values[y as usize], 3.0);
}

#[test]
fn a_zero_divisor_moves_nothing_where_the_rule_holds() {
    let mut s = Sheet::default();
    let (v, i, r) = (s.given(2.0), s.kept(1.0), s.given(2.0));
    let (vv, vi, vr) = (s.v(v), s.v(i), s.v(r));
    let product = s.mul(vi, vr);
    s.require(vv, product);
    let (values, outcome, _) = s.set(&[(v, 0.0), (r, 0.0)]);
    assert!(outcome.is_solved(), "{outcome:?}");
    assert_eq!(values[i as usize], 1.0);
}

#[test]
fn the_root_of_a_negative_number_is_refused() {
    let mut s = Sheet::default();
    let (x, y) = (s.given(4.0), s.kept(2.0));
    let (vx, vy) = (s.v(x), s.v(y));
    let square = s.mul(vy, vy);
    s.require(square, vx);
    let (values, outcome, _) = s.set(&[(x, -1.0)]);
    assert!(matches!(outcome.status, Status::Stopped(Reason::Limit { .. })), "{outcome:?}");
    assert_eq!(values[y as usize], 2.0);
    let (values, outcome, _) = s.set(&[(x, 9.0)]);
    assert!(outcome.is_solved());
    assert_eq!(values[y as usize], 3.0);
}

#[test]
fn a_soft_rule_against_a_required_one_is_unmet_and_refuses_nothing() {
    let mut s = Sheet::default();
    let x = s.kept(1.0);
    let vx = s.v(x);
    let (one, five) = (s.c(1.0), s.c(5.0));
    s.require(vx, one);
    let soft = s.relate(Level::Strong, &[(vx, five)]);
    let plan = s.plan();
    let (values, outcome) = s.run(&plan, &[], &mut solve::NoHost);
    assert!(outcome.is_solved());
    assert_eq!((outcome.unmet[0].relation, outcome.unmet[0].error), (soft, 4.0));
    assert_eq!(values, [1.0]);
}

#[test]
fn a_repeated_rule_is_redundant_on_opening() {
    let mut s = Sheet::default();
    let (y, z) = (s.free(0.0), s.free(0.0));
    let (vy, vz, one) = (s.v(y), s.v(z), s.c(1.0));
    let sum = s.add(vz, one);
    s.require(vy, sum);
    let again = s.require(sum, vy);
    let plan = s.plan();
    assert_eq!(plan.report.rejected.len(), 1);
    assert_eq!(plan.report.rejected[0].relation, again);
    assert_eq!(plan.report.freedom, 1);
    let (values, outcome) = s.run(&plan, &[], &mut solve::NoHost);
    assert!(outcome.is_solved() && outcome.unmet.is_empty(), "{outcome:?}");
    crate::builder::close(values[0], 0.5, 1e-15);
    crate::builder::close(values[1], -0.5, 1e-15);
}

#[test]
fn a_repeated_equality_is_redundant_and_a_second_number_contradicts() {
    let mut s = Sheet::default();
    let (x, y) = (s.kept(1.0), s.kept(1.0));
    let (vx, vy, one, two) = (s.v(x), s.v(y), s.c(1.0), s.c(2.0));
    s.require(vx, vy);
    let again = s.require(vy, vx);
    let plan = s.plan();
    assert_eq!(plan.report.rejected.len(), 1);
    assert_eq!(plan.report.rejected[0].circuit, [(0, 0)]);
    assert_eq!(plan.report.rejected[0].relation, again);
    assert_eq!(plan.report.freedom, 1);
    let first = s.require(vx, one);
    s.require(vy, two);
    let plan = s.plan();
    assert_eq!(plan.report.rejected[1].circuit, [(0, 0), (first, 0)]);
    assert!(!s.run(&plan, &[], &mut solve::NoHost).1.is_solved());
}
