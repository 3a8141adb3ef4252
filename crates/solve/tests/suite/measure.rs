//! How much: soft rows, compromises, least change.

use crate::builder::{Sheet, bits, close};
use solve::{Level, NoHost, StepKind};

#[test]
fn a_weak_home_springs_back() {
    let mut s = Sheet::default();
    let x = s.kept(140.0);
    let vx = s.v(x);
    let home = s.c(100.0);
    s.relate(Level::Weak, &[(vx, home)]);
    let plan = s.plan();
    let (values, outcome) = s.run(&plan, &[], &mut NoHost);
    assert!(outcome.unmet.is_empty());
    assert_eq!(values, [100.0]);
    let w = s.wish(&[x]);
    let plan = s.plan();
    let (values, outcome) = s.run(&plan, &[(w[0], 120.0)], &mut NoHost);
    assert!(outcome.is_solved());
    assert_eq!(values[x as usize], 120.0);
    assert_eq!(outcome.unmet.len(), 1);
}

#[test]
fn two_weak_rules_meet_in_the_middle() {
    let mut s = Sheet::default();
    let x = s.kept(0.0);
    let vx = s.v(x);
    let (ten, thirty) = (s.c(10.0), s.c(30.0));
    s.relate(Level::Weak, &[(vx, ten)]);
    s.relate(Level::Weak, &[(vx, thirty)]);
    let plan = s.plan();
    assert_eq!(plan.steps()[0].kind, StepKind::Compromise);
    assert!(plan.report.rejected[0].compromises);
    let (values, outcome) = s.run(&plan, &[], &mut NoHost);
    close(values[0], 20.0, 1e-9);
    assert!(outcome.is_solved() && outcome.unmet.len() == 2);
    s.x0 = values.clone();
    assert_eq!(s.run(&plan, &[], &mut NoHost).0[0].to_bits(), values[0].to_bits());
}

#[test]
fn the_stronger_rule_wins() {
    let mut s = Sheet::default();
    let x = s.kept(0.0);
    let vx = s.v(x);
    let (ten, thirty) = (s.c(10.0), s.c(30.0));
    let weak = s.relate(Level::Weak, &[(vx, ten)]);
    s.relate(Level::Strong, &[(vx, thirty)]);
    let plan = s.plan();
    let (values, outcome) = s.run(&plan, &[], &mut NoHost);
    assert_eq!(values, [30.0]);
    assert_eq!(outcome.unmet[0].relation, weak);
}

#[test]
fn a_medium_pair_holds_and_a_weak_rule_gives_way() {
    let mut s = Sheet::default();
    let (x, y) = (s.kept(0.0), s.kept(0.0));
    let (vx, vy) = (s.v(x), s.v(y));
    let (two, three, seven) = (s.c(2.0), s.c(3.0), s.c(7.0));
    let (a, b, c) = (s.mul(two, vx), s.mul(three, vy), s.mul(seven, vy));
    let (first, second, third) = (s.add(a, b), s.add(vx, vy), s.add(vx, c));
    let (eight, zero) = (s.c(8.0), s.c(0.0));
    s.relate(Level::Medium, &[(first, eight)]);
    s.relate(Level::Medium, &[(second, three)]);
    s.relate(Level::Weak, &[(third, zero)]);
    let plan = s.plan();
    let (values, _) = s.run(&plan, &[], &mut NoHost);
    close(values[0], 1.0, 1e-12);
    close(values[1], 2.0, 1e-12);
}

#[test]
fn a_wish_on_a_circle_is_met_as_nearly_as_it_can() {
    let mut s = Sheet::default();
    let centre = s.anchor(0.0, 0.0);
    let p = s.place(5.0, 0.0);
    let (d, five) = (s.distance(centre, p), s.c(5.0));
    s.require(d, five);
    let w = s.wish(&p);
    let plan = s.plan();
    let (values, outcome) = s.run(&plan, &[(w[0], 6.0), (w[1], 8.0)], &mut NoHost);
    assert!(outcome.is_solved(), "{outcome:?}");
    close(values[p[0] as usize], 3.0, 1e-9);
    close(values[p[1] as usize], 4.0, 1e-9);
}

#[test]
fn nothing_determined_is_nearest_to_where_it_was() {
    let mut s = Sheet::default();
    let (x, y) = (s.free(0.0), s.free(0.0));
    let (vx, vy) = (s.v(x), s.v(y));
    let (sum, ten) = (s.add(vx, vy), s.c(10.0));
    s.require(sum, ten);
    let plan = s.plan();
    assert_eq!((plan.report.freedom, plan.report.free_slots.len()), (1, 1));
    let (values, _) = s.run(&plan, &[], &mut NoHost);
    close(values[0], 5.0, 1e-12);
    close(values[1], 5.0, 1e-12);
}

#[test]
fn what_structure_lets_yield_may_not_reach_and_then_all_yields() {
    // a chain of three bars of 10 between anchors 24 apart, drawn far too short: the last joint
    // alone cannot reach
    let mut s = Sheet::default();
    let joints = [s.anchor(0.0, 0.0), s.place(1.0, 1.0), s.place(2.0, 1.0), s.anchor(24.0, 0.0)];
    for pair in joints.windows(2) {
        let (d, ten) = (s.distance(pair[0], pair[1]), s.c(10.0));
        s.require(d, ten);
    }
    let plan = s.plan();
    let (values, outcome) = s.run(&plan, &[], &mut NoHost);
    assert!(outcome.is_solved(), "{outcome:?}");
    assert!(values[joints[1][0] as usize] > 4.0);
}

#[test]
fn a_crank_follows_a_wish_that_is_a_quarter_turn_away() {
    for wish in [[0.0, 40.0], [0.0, 41.0], [-0.01, 40.0], [0.0, -40.0]] {
        let mut s = Sheet::default();
        let hub = s.anchor(0.0, 0.0);
        let tip = [s.kept(40.0), s.kept(0.0)];
        let (length, forty) = (s.distance(hub, tip), s.c(40.0));
        s.require(length, forty);
        let w = s.wish(&tip);
        let plan = s.plan();
        let mut drag = s.drag(&plan, &w);
        let outcome = drag.follow(&plan, &wish, &mut NoHost);
        assert!(outcome.is_solved(), "{outcome:?}");
        let size = base::number::sqrt(wish[0] * wish[0] + wish[1] * wish[1]);
        close(drag.values()[tip[0] as usize], 40.0 * wish[0] / size, 1e-6);
        close(drag.values()[tip[1] as usize], 40.0 * wish[1] / size, 1e-6);
    }
}

/// 400 widths that want to be 7.5 in a row of 2 000, the first half more strongly: those have it, and the
/// others share what is left alike.
#[test]
fn a_large_compromise_is_made_level_by_level() {
    const BOXES: usize = 400;
    let mut s = Sheet::default();
    let edges: Vec<u32> = (0..=BOXES).map(|i| s.kept(i as f64)).collect();
    for (edge, at) in [(0, 0.0), (BOXES, 2_000.0)] {
        let (v, c) = (s.v(edges[edge]), s.c(at));
        s.require(v, c);
    }
    for i in 0..BOXES {
        let (left, right) = (s.v(edges[i]), s.v(edges[i + 1]));
        let (width, wanted) = (s.sub(right, left), s.c(7.5));
        let level = if i < BOXES / 2 { Level::Medium } else { Level::Weak };
        s.relate(level, &[(width, wanted)]);
    }
    let plan = s.plan();
    let (values, outcome) = s.run(&plan, &[], &mut NoHost);
    assert!(outcome.is_solved());
    assert_eq!(outcome.unmet.len(), BOXES / 2);
    for i in 0..BOXES {
        let wanted = if i < BOXES / 2 { 7.5 } else { 2.5 };
        let (left, right) = (edges[i] as usize, edges[i + 1] as usize);
        close(values[right] - values[left], wanted, 1e-9);
    }
    // and solving again changes no bit
    s.x0 = values.clone();
    assert_eq!(bits(&s.run(&plan, &[], &mut NoHost).0), bits(&values));
}
