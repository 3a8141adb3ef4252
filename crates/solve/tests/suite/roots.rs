//! Several roots: where one leads nowhere, another does; and a search that ends.

use crate::builder::{Sheet, bits, close};
use solve::{NoHost, Reason, Runner, SlotIndex, Status};

/// A place at these distances from two others.
fn tied(sheet: &mut Sheet, start: [f64; 2], ties: [([SlotIndex; 2], f64); 2]) -> [SlotIndex; 2] {
    let place = sheet.place(start[0], start[1]);
    for (from, length) in ties {
        let (distance, length) = (sheet.distance(from, place), sheet.c(length));
        sheet.require(distance, length);
    }
    place
}

/// A knee between two walls, almost stretched: up or down by 0.0316 from half way between them.
fn knee(sheet: &mut Sheet, height: f64) -> [SlotIndex; 2] {
    let (left, right) = (sheet.anchor(0.0, 0.0), sheet.anchor(10.0, 0.0));
    tied(sheet, [5.0, height], [(left, 5.0001), (right, 5.0001)])
}

#[test]
fn what_no_root_allows_is_refused_and_changes_nothing() {
    let mut s = Sheet::default();
    let p = knee(&mut s, 0.3);
    let below = s.anchor(5.0, -3.0);
    // neither from 0.0316 nor from -0.0316 do 1 and 1.9 reach
    tied(&mut s, [5.0, -1.0], [(p, 1.0), (below, 1.9)]);
    let plan = s.plan();
    let (values, outcome) = s.run(&plan, &[], &mut NoHost);
    assert!(matches!(outcome.status, Status::Stopped(Reason::NoSolution { .. })), "{outcome:?}");
    assert_eq!(bits(&values), bits(&s.x0));
}

#[test]
fn an_earlier_step_takes_its_other_root_where_a_later_one_finds_none() {
    let mut s = Sheet::default();
    // it starts above, and above it is found; from there 1 and 1.99 do not reach 3.0316 far
    let p = knee(&mut s, 0.3);
    let below = s.anchor(5.0, -3.0);
    let q = tied(&mut s, [5.1, -1.0], [(p, 1.0), (below, 1.99)]);
    let (values, outcome) = s.run(&s.plan(), &[], &mut NoHost);
    assert!(outcome.is_solved(), "{outcome:?}");
    let height = -base::number::sqrt(5.0001 * 5.0001 - 25.0);
    close(values[p[1] as usize], height, 1e-6);
    let [x, y] = q.map(|s| values[s as usize]);
    close(base::number::hypot(x - 5.0, y + 3.0), 1.99, 1e-9);
    assert!(x > 5.0, "of its own two roots it takes the nearer");
}

#[test]
fn a_drag_from_a_state_that_does_not_hold_takes_another_root_too() {
    let mut s = Sheet::default();
    let p = knee(&mut s, 0.3);
    let below = s.anchor(5.0, -3.0);
    tied(&mut s, [5.1, -1.0], [(p, 1.0), (below, 1.99)]);
    let plan = s.plan();
    let mut drag = s.drag(&plan, &below);
    let height = -base::number::sqrt(5.0001 * 5.0001 - 25.0);
    // and stays there, where the other one would do as well
    for to in [-3.001, -3.0, -2.9] {
        let outcome = drag.follow(&plan, &[5.0, to], &mut NoHost);
        assert!(outcome.is_solved() && outcome.unmet.is_empty(), "{to}: {outcome:?}");
        close(drag.values()[p[1] as usize], height, 1e-6);
    }
}

#[test]
fn what_has_no_part_in_a_failure_keeps_the_nearest_root() {
    let mut s = Sheet::default();
    let p = knee(&mut s, 0.3);
    let below = s.anchor(5.0, -3.0);
    // a second knee between the first and the wall that fails, with no part in it
    let (left, right) = (s.anchor(20.0, 0.0), s.anchor(30.0, 0.0));
    let other = tied(&mut s, [25.0, 0.3], [(left, 5.0001), (right, 5.0001)]);
    tied(&mut s, [25.0, 1.0], [(other, 1.0), (left, 5.1)]);
    tied(&mut s, [5.1, -1.0], [(p, 1.0), (below, 1.99)]);
    let (values, outcome) = s.run(&s.plan(), &[], &mut NoHost);
    assert!(outcome.is_solved(), "{outcome:?}");
    assert!(values[other[1] as usize] > 0.0, "{}", values[other[1] as usize]);
}

#[test]
fn a_surplus_row_chooses_the_root_on_which_it_holds() {
    let mut s = Sheet::default();
    let p = knee(&mut s, 0.3);
    let below = s.anchor(5.0, -3.0);
    let height = 3.0 - base::number::sqrt(5.0001 * 5.0001 - 25.0);
    let (distance, length) = (s.distance(below, p), s.c(height));
    s.require(distance, length);
    let plan = s.plan();
    assert_eq!(plan.report.rejected.len(), 1);
    let (values, outcome) = s.run(&plan, &[], &mut NoHost);
    assert!(outcome.is_solved(), "{outcome:?}");
    close(values[p[1] as usize], height - 3.0, 1e-6);
}

#[test]
fn a_state_has_others_where_a_step_takes_its_other_root() {
    let mut s = Sheet::default();
    let (left, right) = (s.anchor(0.0, 0.0), s.anchor(6.0, 0.0));
    let p = tied(&mut s, [3.0, 4.0], [(left, 5.0), (right, 5.0)]);
    // above p, and to its right
    let q = tied(&mut s, [6.0, 8.0], [(left, 10.0), (p, 5.0)]);
    let plan = s.plan();
    let others = solve::others(&plan, &s.x0, None, 8, &mut NoHost);
    let places: Vec<[f64; 4]> = others
        .iter()
        .map(|o| [p[0], p[1], q[0], q[1]].map(|slot| o.values[slot as usize]))
        .collect();
    // q is where left, p and q lie on one line: a double root that is no other
    assert_eq!(places.len(), 1, "{places:?}");
    for (at, wanted) in places[0].iter().zip([3.0, -4.0, 6.0, -8.0]) {
        close(*at, wanted, 1e-6);
    }
    assert!(solve::others(&plan, &s.x0, None, 0, &mut NoHost).is_empty());
}

#[test]
fn the_coupler_of_a_four_bar_has_another_side() {
    let mut s = Sheet::default();
    let (tip, foot) = (s.anchor(40.0, 0.0), s.anchor(160.0, 0.0));
    let p = tied(&mut s, [365.0 / 3.0, 113.712_600_689_437_92], [(tip, 140.0), (foot, 120.0)]);
    let others = solve::others(&s.plan(), &s.x0, None, 8, &mut NoHost);
    let [other] = &others[..] else { panic!("{others:?}") };
    close(other.values[p[0] as usize], 365.0 / 3.0, 1e-9);
    close(other.values[p[1] as usize], -113.712_600_689_437_92, 1e-9);
}

#[test]
fn a_run_that_may_cost_nothing_finds_nothing_and_changes_nothing() {
    let mut s = Sheet::default();
    let (from, to) = (s.anchor(0.0, 0.0), s.place(3.0, 4.0));
    let (distance, length) = (s.distance(from, to), s.c(7.0));
    s.require(distance, length);
    let (plan, mut runner, mut values) = (s.plan(), Runner::new(), s.x0.clone());
    runner.end_at(Some(0));
    let outcome = solve::run(&plan, &mut runner, &s.x0, &mut values, &[], &mut NoHost);
    assert!(matches!(outcome.status, Status::Stopped(_)), "{outcome:?}");
    assert_eq!(bits(&values), bits(&s.x0));
    runner.end_at(None);
    let outcome = solve::run(&plan, &mut runner, &s.x0, &mut values, &[], &mut NoHost);
    assert!(outcome.is_solved(), "{outcome:?}");
    let [x, y] = to.map(|s| values[s as usize]);
    close(base::number::hypot(x, y), 7.0, 1e-9);
}
