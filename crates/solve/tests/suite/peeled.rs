//! Rows that are solved one after the other or two by two, whichever way they are declared.

use crate::builder::{Sheet, bits, close, lines};
use base::Dice;
use expr::Unary;
use solve::{NoHost, Plan, SlotIndex};
use std::collections::BTreeSet;

const ROWS: usize = 40;

/// `b = k*a + 0.5`, each `a` the `b` of the row before, the last row declared first; `k` is wished.
fn chain() -> (Sheet, SlotIndex, Vec<SlotIndex>, Vec<SlotIndex>) {
    let mut s = Sheet::default();
    let k = s.kept(1.0);
    let first = s.given(2.0);
    let links: Vec<SlotIndex> = (0..ROWS).map(|i| s.kept(2.5 + 0.5 * i as f64)).collect();
    for i in (0..ROWS).rev() {
        let before = if i == 0 { first } else { links[i - 1] };
        let [k, a, b] = [k, before, links[i]].map(|slot| s.v(slot));
        let half = s.c(0.5);
        let scaled = s.mul(k, a);
        let right = s.add(scaled, half);
        s.require(b, right);
    }
    let w = s.wish(&[k]);
    (s, k, links, w)
}

fn expected(k: f64) -> impl Iterator<Item = f64> {
    std::iter::successors(Some(2.0), move |a| Some(k * a + 0.5)).skip(1)
}

#[test]
fn a_chain_follows_its_factor_and_comes_back() {
    let (s, k, links, w) = chain();
    let plan = s.plan();
    let mut drag = s.drag(&plan, &w);
    for factor in [1.0, 1.01, 0.5, -0.25, 1.0] {
        let outcome = drag.follow(&plan, &[factor], &mut NoHost);
        assert!(outcome.is_solved() && outcome.unmet.is_empty(), "{outcome:?}");
        assert_eq!(drag.values()[k as usize], factor);
        for (&link, wanted) in links.iter().zip(expected(factor)) {
            assert_eq!(drag.values()[link as usize], wanted);
        }
    }
    assert_eq!(bits(drag.values()), bits(&s.x0));
}

#[test]
fn every_step_reads_what_stands_before_it() {
    let (s, k, links, w) = chain();
    let plan = s.plan();
    assert_eq!(plan.step_count(), ROWS + 1);
    assert_eq!(plan.steps().len(), ROWS + 1);
    assert_eq!(plan.report.freedom, 1, "the factor may move while nobody wishes");
    let mut there = vec![w[0], 1];
    for step in plan.steps() {
        assert!(step.reads.iter().all(|r| there.contains(r)), "{step:?}");
        there.extend(&step.targets);
    }
    assert!([k].iter().chain(&links).all(|slot| there.contains(slot)));
}

#[test]
fn a_chain_stops_where_a_formula_is_not_defined() {
    let (mut s, k, links, w) = chain();
    // the last is 22 at the press, and 1 / (b - 20) is defined on both sides of 20
    let last = links[ROWS - 1];
    let reciprocal = s.kept(1.0 / (s.x0[last as usize] - 20.0));
    let (r, b, twenty, one) = (s.v(reciprocal), s.v(last), s.c(20.0), s.c(1.0));
    let distance = s.sub(b, twenty);
    let product = s.div(one, distance);
    s.require(r, product);
    let plan = s.plan();
    let mut drag = s.drag(&plan, &w);
    // with no factor every link is one half, and on the way there one passes twenty
    let outcome = drag.follow(&plan, &[0.0], &mut NoHost);
    let at = |slot: SlotIndex| drag.values()[slot as usize];
    assert!(at(k).is_finite() && at(reciprocal).is_finite(), "{outcome:?}");
    close(at(reciprocal) * (at(last) - 20.0), 1.0, 1e-9);
    for (pair, wanted) in links.windows(2).zip(expected(at(k)).skip(1)) {
        close(at(pair[1]), wanted, 1e-6);
    }
}

#[test]
fn of_two_roots_the_one_at_hand_is_followed() {
    for sign in [1.0, -1.0] {
        let mut s = Sheet::default();
        let [area, side] = [s.kept(9.0), s.kept(3.0 * sign)];
        let (a, b) = (s.v(area), s.v(side));
        let square = s.mul(b, b);
        s.require(square, a);
        let w = s.wish(&[area]);
        let plan = s.plan();
        let mut drag = s.drag(&plan, &w);
        assert!(drag.follow(&plan, &[16.0], &mut NoHost).is_solved());
        close(drag.values()[side as usize], 4.0 * sign, 1e-12);
    }
}

/// Joints that hang by two bars each from two earlier ones, bars that are longer the larger a given number is,
/// and numbers that follow from these; all rows in any order. Returns the number, and where the joints are.
fn frame(seed: u64) -> (Sheet, SlotIndex, Vec<[SlotIndex; 2]>) {
    let mut dice = Dice::new(seed);
    let mut s = Sheet::default();
    let given = s.given(1.0);
    let mut joints = vec![s.anchor(0.0, 0.0), s.anchor(4.0, 0.5)];
    let mut bars: Vec<([SlotIndex; 2], [SlotIndex; 2], SlotIndex)> = Vec::new();
    for _ in 0..2 + dice.below(12) {
        let first = dice.below(joints.len());
        let second = (first + 1 + dice.below(joints.len() - 1)) % joints.len();
        let [from, to] = [joints[first], joints[second]];
        let at = |s: &Sheet, p: [SlotIndex; 2]| p.map(|slot| s.x0[slot as usize]);
        let ([ax, ay], [bx, by]) = (at(&s, from), at(&s, to));
        let (along, aside) = (dice.between(0.2, 0.8), dice.between(0.5, 1.5));
        let place = [
            ax + along * (bx - ax) - aside * (by - ay),
            ay + along * (by - ay) + aside * (bx - ax),
        ];
        let joint = s.place(place[0], place[1]);
        for other in [from, to] {
            let [ox, oy] = at(&s, other);
            let [dx, dy] = [place[0] - ox, place[1] - oy];
            let length = (dx * dx + dy * dy).sqrt();
            let bar = s.kept(length);
            bars.push((other, joint, bar));
        }
        joints.push(joint);
    }
    dice.shuffle(&mut bars);
    for &(from, to, bar) in &bars {
        let length = s.x0[bar as usize];
        let distance = s.distance(from, to);
        let (own, number, rest) = (s.v(bar), s.v(given), s.c(length - 1.0));
        let stated = s.add(number, rest);
        for (left, right) in if dice.below(2) == 0 {
            [(distance, own), (own, stated)]
        } else {
            [(own, stated), (distance, own)]
        } {
            let relation = s.require(left, right);
            s.reads(relation, given);
        }
    }
    (s, given, joints)
}

/// What every step does, but for those that write one of these.
fn steps(plan: &Plan, without: &[SlotIndex]) -> BTreeSet<String> {
    let others = plan.steps().iter().filter(|s| !s.targets.iter().any(|t| without.contains(t)));
    let told =
        |s: &solve::Step| format!("{:?} {:?} {:?} {:?}", s.kind, s.targets, s.reads, s.relations);
    others.map(told).collect()
}

#[test]
fn what_goes_two_by_two_is_planned_as_it_is_beside_what_does_not() {
    for seed in 0..60 {
        let (s, given, joints) = frame(seed);
        let plan = s.plan();
        assert_eq!(plan.step_count(), 3 * (joints.len() - 2), "{}", lines(&plan));
        let (mut beside, ..) = frame(seed);
        // a written method: nothing is peeled
        let free = [beside.kept(9.0), beside.kept(3.0)];
        let [square, root] = free.map(|slot| beside.v(slot));
        let product = beside.mul(root, root);
        let written = beside.require(square, product);
        beside.method(written, free[0], product);
        let other = beside.plan();
        assert_eq!(steps(&plan, &free), steps(&other, &free), "seed {seed}");
        assert_eq!((plan.report.freedom, other.report.freedom), (0, 1));
        assert!(plan.report.rejected.is_empty() && other.report.rejected.is_empty());
        for value in [1.0, 1.01, 0.97] {
            let (came, outcome, _) = s.set(&[(given, value)]);
            let (came_too, outcome_too, _) = beside.set(&[(given, value)]);
            assert_eq!(outcome.is_solved(), outcome_too.is_solved(), "seed {seed}: {outcome:?}");
            assert_eq!(bits(&came), bits(&came_too[..came.len()]), "seed {seed}");
        }
    }
}

#[test]
fn two_rows_that_say_the_same_of_a_place_do_not_determine_it() {
    let mut s = Sheet::default();
    let (anchor, place) = (s.anchor(0.0, 0.0), s.place(3.0, 4.0));
    let lengths = [s.fixed(5.0), s.fixed(5.0)];
    for length in lengths {
        let (distance, length) = (s.distance(anchor, place), s.v(length));
        s.require(distance, length);
    }
    let plan = s.plan();
    assert_eq!(plan.report.rejected.len(), 1, "{}", lines(&plan));
    assert_eq!(plan.report.freedom, 1);
}

#[test]
fn what_a_row_only_reads_is_computed_before_it() {
    let mut s = Sheet::default();
    let [number, half, whole, below] = [3.0, 6.5, 13.0, 6.0].map(|x| s.kept(x));
    let [n, h, w, b] = [number, half, whole, below].map(|slot| s.v(slot));
    let (two, rest) = (s.c(2.0), s.c(0.5));
    let doubled = s.mul(two, h);
    let first = s.require(w, doubled);
    s.reads(first, half);
    // a step that shows in no derivative
    let floor = s.arena.unary(Unary::Floor, h);
    s.require(b, floor);
    let product = s.mul(two, n);
    let stated = s.add(product, rest);
    let last = s.require(h, stated);
    s.reads(last, number);
    let (came, outcome, plan) = s.set(&[(number, 5.0)]);
    assert!(outcome.is_solved(), "{outcome:?}\n{}", lines(&plan));
    assert!(outcome.unmet.is_empty(), "{outcome:?}");
    assert_eq!([half, whole, below].map(|slot| came[slot as usize]), [10.5, 21.0, 10.0]);
}

#[test]
fn rows_that_read_each_other_are_solved_together() {
    // a = b / 2 + 1 and b = a / 2 + k, each solved for its left side alone
    let mut s = Sheet::default();
    let [a, b, k] = [2.0, 2.0, 1.0].map(|x| s.kept(x));
    let (two, one) = (s.c(2.0), s.c(1.0));
    let [left, right, number] = [a, b, k].map(|slot| s.v(slot));
    for (own, other, more, read) in [(left, right, one, b), (right, left, number, a)] {
        let half = s.div(other, two);
        let stated = s.add(half, more);
        let row = s.require(own, stated);
        s.reads(row, read);
        s.reads(row, k);
    }
    let (came, outcome, plan) = s.set(&[(k, 4.0)]);
    assert!(outcome.is_solved() && outcome.unmet.is_empty(), "{outcome:?}\n{}", lines(&plan));
    close(came[a as usize], 4.0, 1e-9);
    close(came[b as usize], 6.0, 1e-9);
}
