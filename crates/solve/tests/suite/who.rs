//! Who yields: places whole, later ones first, given numbers last.

use crate::builder::{Sheet, close, lines};
use solve::{Level, NoHost};

/// 1979's quadrilateral: corners, then midpoints.
pub(crate) fn quadrilateral() -> (Sheet, Vec<[u32; 2]>) {
    let mut s = Sheet::default();
    let corners = [(174.0, 178.0), (329.0, 26.0), (445.0, 144.0), (323.0, 312.0)];
    let mut places: Vec<[u32; 2]> = corners.iter().map(|&(x, y)| s.place(x, y)).collect();
    for i in 0..4 {
        let (a, b) = (corners[i], corners[(i + 1) % 4]);
        places.push(s.place((a.0 + b.0) / 2.0, (a.1 + b.1) / 2.0));
    }
    for i in 0..4 {
        let mut sides = Vec::new();
        let ends = places[i].into_iter().zip(places[(i + 1) % 4]);
        for ((a, b), middle) in ends.zip(places[4 + i]) {
            let (a, b, middle, two) = (s.v(a), s.v(b), s.v(middle), s.c(2.0));
            let sum = s.add(a, b);
            let half = s.div(sum, two);
            sides.push((middle, half));
        }
        s.relate(Level::Required, &sides);
    }
    (s, places)
}

#[test]
fn dragging_a_midpoint_moves_one_corner_and_what_hangs_on_it() {
    let (mut s, p) = quadrilateral();
    let w = s.wish(&p[6]);
    let plan = s.plan();
    assert_eq!(plan.report.freedom, 8);
    let edits = [(w[0], s.x0[w[0] as usize] + 10.0), (w[1], s.x0[w[1] as usize])];
    let (values, outcome) = s.run(&plan, &edits, &mut NoHost);
    assert!(outcome.is_solved() && outcome.unmet.is_empty());
    let at = |place: [u32; 2]| (values[place[0] as usize], values[place[1] as usize]);
    assert_eq!(at(p[3]), (343.0, 312.0));
    assert_eq!(at(p[7]), (258.5, 245.0));
    let moved: Vec<usize> =
        (0..s.x0.len()).filter(|&i| values[i].to_bits() != s.x0[i].to_bits()).collect();
    let expected = [p[3][0], p[6][0], p[7][0], w[0]].map(|i| i as usize);
    assert_eq!(moved, expected, "{}", lines(&plan));
}

#[test]
fn dragging_a_corner_moves_two_midpoints_by_half() {
    let (mut s, p) = quadrilateral();
    let w = s.wish(&p[2]);
    let plan = s.plan();
    let edits = [(w[0], 445.0 + 8.0), (w[1], 144.0 - 6.0)];
    let (values, outcome) = s.run(&plan, &edits, &mut NoHost);
    assert!(outcome.is_solved());
    for m in [p[5], p[6]] {
        assert_eq!(values[m[0] as usize], s.x0[m[0] as usize] + 4.0);
        assert_eq!(values[m[1] as usize], s.x0[m[1] as usize] - 3.0);
    }
    for still in [p[0], p[1], p[3], p[4], p[7]] {
        for c in still {
            assert_eq!(values[c as usize].to_bits(), s.x0[c as usize].to_bits());
        }
    }
}

#[test]
fn a_place_is_never_half_held() {
    // a bar of required length 5 from an anchor; the other end is told its distance from elsewhere
    let mut s = Sheet::default();
    let a = s.anchor(0.0, 0.0);
    let p = s.place(3.0, 4.0);
    let length = s.fixed(5.0);
    let (d, l) = (s.distance(a, p), s.v(length));
    s.require(d, l);
    let plan = s.plan();
    let (values, outcome) = s.run(&plan, &[(length, 10.0)], &mut NoHost);
    assert!(outcome.is_solved(), "{outcome:?}");
    // the nearest point of the circle is straight out, not along one axis
    close(values[p[0] as usize], 6.0, 1e-9);
    close(values[p[1] as usize], 8.0, 1e-9);
}

#[test]
fn a_given_number_yields_only_where_nothing_else_can() {
    let mut s = Sheet::default();
    let (a, b, sum) = (s.given(2.0), s.kept(3.0), s.kept(5.0));
    let (va, vb, vs) = (s.v(a), s.v(b), s.v(sum));
    let left = s.add(va, vb);
    s.require(left, vs);
    let (values, outcome, plan) = s.set(&[(sum, 9.0)]);
    assert!(outcome.is_solved() && plan.report.yielded.is_empty());
    assert_eq!(values, [2.0, 7.0, 9.0]);
    let (values, _, plan) = s.set(&[(sum, 9.0), (b, 3.0)]);
    assert_eq!(plan.report.yielded, [a]);
    assert_eq!(values, [6.0, 3.0, 9.0]);
}

#[test]
fn all_given_numbers_of_a_circuit_yield_together() {
    let mut s = Sheet::default();
    let (a, b, sum, apart) = (s.given(2.0), s.given(4.0), s.kept(6.0), s.given(9.0));
    let (va, vb, vs) = (s.v(a), s.v(b), s.v(sum));
    let left = s.add(va, vb);
    s.require(left, vs);
    let (values, outcome, plan) = s.set(&[(sum, 10.0)]);
    assert!(outcome.is_solved(), "{outcome:?}");
    assert_eq!(plan.report.yielded, [a, b]);
    close(values[a as usize], 4.0, 1e-12);
    close(values[b as usize], 6.0, 1e-12);
    assert_eq!(values[apart as usize], 9.0);
}

/// A battery and two resistors: voltage, current, both resistances, the voltage between them.
pub(crate) fn divider() -> (Sheet, [u32; 4]) {
    let mut s = Sheet::default();
    let battery = s.fixed(1.5);
    let r1 = s.slot(solve::Stay::Given(solve::Giver::Document), 1, 100.0);
    let r2 = s.slot(solve::Stay::Given(solve::Giver::Document), 1, 100.0);
    let i = s.slot(solve::Stay::Free, 2, 0.0);
    let out = s.free(0.0);
    let (vb, v1, v2, vi, vo) = (s.v(battery), s.v(r1), s.v(r2), s.v(i), s.v(out));
    let upper = s.sub(vb, vo);
    let (p1, p2) = (s.mul(vi, v1), s.mul(vi, v2));
    s.require(upper, p1);
    s.require(vo, p2);
    s.open();
    (s, [i, r1, r2, out])
}

#[test]
fn a_divider_computes_and_each_pair_gives_the_others() {
    let (s, [i, r1, r2, out]) = divider();
    close(s.x0[i as usize], 0.0075, 1e-15);
    close(s.x0[out as usize], 0.75, 1e-12);
    let (values, outcome, plan) = s.set(&[(r2, 300.0)]);
    assert!(outcome.is_solved() && plan.report.yielded.is_empty());
    close(values[i as usize], 0.00375, 1e-15);
    close(values[out as usize], 1.125, 1e-12);
    // 1.5 V, 200 ohm and 400 ohm: 2.5 mA, 1 V
    let solution = [(i, 0.0025), (r1, 200.0), (r2, 400.0), (out, 1.0)];
    for a in 0..4 {
        for b in a + 1..4 {
            let (values, outcome, plan) = s.set(&[solution[a], solution[b]]);
            assert!(outcome.is_solved(), "{a} {b}: {outcome:?}\n{}", lines(&plan));
            for (slot, expected) in solution {
                close(values[slot as usize] / expected, 1.0, 1e-9);
            }
        }
    }
}
