//! Rows that are solved one after the other, whichever way they are declared.

use crate::builder::{Sheet, bits, close};
use solve::{NoHost, SlotIndex};

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
