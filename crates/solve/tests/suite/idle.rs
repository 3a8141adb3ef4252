//! What does not change: bits, plans.

use crate::builder::{Sheet, bits, lines};
use crate::who::{divider, quadrilateral};
use solve::NoHost;

#[test]
fn solving_a_solved_state_changes_no_bit() {
    let (s, _) = divider();
    let plan = s.plan();
    let (values, outcome) = s.run(&plan, &[], &mut NoHost);
    assert!(outcome.is_solved());
    assert_eq!(bits(&values), bits(&s.x0));
}

#[test]
fn a_state_within_tolerance_is_left_as_it_is() {
    let (mut s, [i, ..]) = divider();
    s.x0[i as usize] *= 1.0 + 1e-13;
    let plan = s.plan();
    assert_eq!(bits(&s.run(&plan, &[], &mut NoHost).0), bits(&s.x0));
}

#[test]
fn equal_systems_have_equal_plans_whatever_their_values() {
    let (s, places) = quadrilateral();
    let (mut other, _) = quadrilateral();
    for (i, v) in other.x0.iter_mut().enumerate() {
        *v = 1.0 / (1.0 + i as f64);
    }
    let both = [s, other].map(|mut sheet| {
        sheet.wish(&places[6]);
        lines(&sheet.plan())
    });
    assert_eq!(both[0], both[1]);
}

#[test]
fn an_equal_number_follows_and_so_does_its_place() {
    let mut s = Sheet::default();
    let (p, q) = (s.place(0.0, 5.0), s.place(10.0, 5.0));
    let (py, qy) = (s.v(p[1]), s.v(q[1]));
    s.require(py, qy);
    let w = s.wish(&q);
    let plan = s.plan();
    let (values, outcome) = s.run(&plan, &[(w[0], 12.0), (w[1], 7.0)], &mut NoHost);
    assert!(outcome.is_solved());
    assert_eq!(values[..4], [0.0, 7.0, 12.0, 7.0], "{}", lines(&plan));
}
