//! Numbers of other orders of magnitude beside one another, and places that come to lie at one.

use crate::builder::{Sheet, bits, close};
use solve::{Drag, NoHost, SlotIndex};

/// A principal, a rate and `principal * rate^2 - 3.5e-3 * principal = rest`, as it opens.
fn interest(principal: f64) -> (Sheet, [SlotIndex; 3]) {
    let mut s = Sheet::default();
    let [capital, rate] = [principal, 0.06].map(|value| s.given(value));
    let rest = s.kept(1e-4 * principal);
    let (a, b, c) = (s.v(capital), s.v(rate), s.v(rest));
    let cost = s.c(3.5e-3 * principal);
    let square = s.mul(b, b);
    let interest = s.mul(a, square);
    let left = s.sub(interest, cost);
    s.require(left, c);
    (s, [capital, rate, rest])
}

#[test]
fn a_small_given_number_beside_a_large_one_changes_as_little_as_it_has_to() {
    for principal in [1e3, 1e6, 1e9, 1e12] {
        let (s, [capital, rate, rest]) = interest(principal);
        let (values, outcome, _) = s.set(&[(rest, 1.005e-4 * principal)]);
        assert!(outcome.is_solved(), "{principal}: {outcome:?}");
        // of a large principal next to nothing moves: its slope is 2e-6 / principal of the rate's
        close(values[capital as usize] / principal, 1.0, 1e-9);
        let wanted = base::number::sqrt(3.6005e-3);
        close(values[rate as usize], wanted, 1e-9 * wanted + 1e-8 / principal);
    }
}

#[test]
fn a_small_computed_number_beside_a_large_one_changes_as_little_as_it_has_to() {
    // the same of numbers that are not given: x * y^2 = z, x a million times as large
    let mut s = Sheet::default();
    let [x, y, z] = [1e6, 0.06, 3600.0].map(|value| s.kept(value));
    let (a, b, c) = (s.v(x), s.v(y), s.v(z));
    let square = s.mul(b, b);
    let product = s.mul(a, square);
    s.require(product, c);
    let (values, outcome, _) = s.set(&[(z, 3600.5)]);
    assert!(outcome.is_solved(), "{outcome:?}");
    close(values[x as usize], 1e6, 1e-6);
    close(values[y as usize], base::number::sqrt(3600.5e-6), 1e-12);
}

/// A bar of a given length from (100, 30) to a place in direction (0.6, 0.8): the place, and the length.
fn bar(length: f64) -> (Sheet, [SlotIndex; 2], SlotIndex) {
    let mut s = Sheet::default();
    let start = s.anchor(100.0, 30.0);
    let end = s.place(100.0 + 0.6 * length, 30.0 + 0.8 * length);
    let size = s.given(length);
    let (distance, given) = (s.distance(start, end), s.v(size));
    s.require(distance, given);
    (s, end, size)
}

#[test]
fn a_bar_without_length_gets_one_again() {
    let (mut s, end, size) = bar(50.0);
    let (values, outcome, _) = s.set(&[(size, 0.0)]);
    assert!(outcome.is_solved(), "{outcome:?}");
    close(values[end[0] as usize], 100.0, 1e-8);
    close(values[end[1] as usize], 30.0, 1e-8);
    for x0 in [values, bar(0.0).0.x0] {
        s.x0 = x0;
        // no direction is nearer than another, but there is one
        let (again, outcome, _) = s.set(&[(size, 50.0)]);
        assert!(outcome.is_solved(), "{outcome:?}");
        let [dx, dy] = [again[end[0] as usize] - 100.0, again[end[1] as usize] - 30.0];
        close(base::number::sqrt(dx * dx + dy * dy), 50.0, 1e-7);
        let (same, ..) = s.set(&[(size, 50.0)]);
        assert_eq!(bits(&same), bits(&again));
    }
}

#[test]
fn a_joint_of_two_bars_without_length_gets_its_length_again() {
    // both bars from one place, as long as one another, and a third place as far from the joint
    let mut s = Sheet::default();
    let start = s.anchor(100.0, 30.0);
    let [p, q] = [0, 1].map(|_| s.place(100.0, 30.0));
    let size = s.given(0.0);
    for (a, b) in [(start, p), (start, q), (p, q)] {
        let (distance, given) = (s.distance(a, b), s.v(size));
        s.require(distance, given);
    }
    let (values, outcome, _) = s.set(&[(size, 20.0)]);
    assert!(outcome.is_solved(), "{outcome:?}");
    let at = |p: [SlotIndex; 2]| p.map(|i| values[i as usize]);
    for (a, b) in [(start, p), (start, q), (p, q)] {
        let [[ax, ay], [bx, by]] = [at(a), at(b)];
        close(base::number::sqrt((ax - bx) * (ax - bx) + (ay - by) * (ay - by)), 20.0, 1e-7);
    }
}

#[test]
fn a_triangle_that_came_to_nothing_gets_its_shape_again() {
    // two corners as far from the first as a given length, and 1.2 of it from one another
    let mut s = Sheet::default();
    let hub = s.anchor(0.0, 0.0);
    let [p, q] = [6.0, -6.0].map(|x| s.place(x, 8.0));
    let radius = s.given(10.0);
    let factor = s.c(1.2);
    for (a, b) in [(hub, p), (hub, q), (p, q)] {
        let (distance, given) = (s.distance(a, b), s.v(radius));
        let wanted = if a == hub { given } else { s.mul(factor, given) };
        s.require(distance, wanted);
    }
    for length in [0.0, 10.0, 1e-3, 10.0, 1e-8, 5.0, 1e-6, 1e6] {
        let within = 1e-8_f64.max(1e-9 * length);
        let (values, outcome, _) = s.set(&[(radius, length)]);
        assert!(outcome.is_solved(), "{length}: {outcome:?}");
        for (a, b, wanted) in [(hub, p, length), (hub, q, length), (p, q, 1.2 * length)] {
            let [dx, dy] = [0, 1].map(|i| values[a[i] as usize] - values[b[i] as usize]);
            close(base::number::sqrt(dx * dx + dy * dy), wanted, within);
        }
        s.x0 = values;
    }
}

#[test]
fn a_bar_grows_from_any_length_to_any() {
    for from in [1e-8, 1e-6, 1e-3, 1.0] {
        let (s, end, size) = bar(from);
        let (values, outcome, _) = s.set(&[(size, 5.0)]);
        assert!(outcome.is_solved(), "{from}: {outcome:?}");
        // numbers about 100 tell the direction of so short a bar to some digits alone
        let within = 1e-7f64.max(1e-13 / from);
        close(values[end[0] as usize], 103.0, within);
        close(values[end[1] as usize], 34.0, within);
    }
}

/// Bars a-b of 2 and b-c of 3, free, on a line.
fn chain() -> (Sheet, [[SlotIndex; 2]; 3]) {
    let mut s = Sheet::default();
    let places = [0.0, 2.0, 5.0].map(|x| s.place(x, 0.0));
    for (ends, length) in [([0, 1], 2.0), ([1, 2], 3.0)] {
        let (distance, length) = (s.distance(places[ends[0]], places[ends[1]]), s.c(length));
        s.require(distance, length);
    }
    (s, places)
}

/// How far a state is from the least change of `a` and `b` from the press where `c` stands: the pulls of the two
/// bars balance what the ends have gone. Each end's change is along its bars.
fn off_least(x0: &[f64], x: &[f64], [a, b, c]: [[SlotIndex; 2]; 3]) -> f64 {
    let gone = |p: [SlotIndex; 2]| p.map(|i| x[i as usize] - x0[i as usize]);
    let bar =
        |p: [SlotIndex; 2], q: [SlotIndex; 2]| [0, 1].map(|i| x[p[i] as usize] - x[q[i] as usize]);
    let across = |u: [f64; 2], v: [f64; 2]| (u[0] * v[1] - u[1] * v[0]).abs();
    let (to_a, to_b) = (bar(a, b), bar(b, c));
    let both = [0, 1].map(|i| gone(a)[i] + gone(b)[i]);
    let size = |u: [f64; 2]| base::number::sqrt(u[0] * u[0] + u[1] * u[1]);
    (across(gone(a), to_a) / 2.0 / size(gone(a))).max(across(both, to_b) / 3.0 / size(both))
}

#[test]
fn a_chain_that_is_turned_inside_out_is_as_near_to_the_press_as_it_can_be() {
    let (mut s, places) = chain();
    let c = places[2];
    // out, back through itself, and out again
    for y in [100.0, 5.0, 100.0, 5.0] {
        let (values, outcome, _) = s.set(&[(c[0], 2.0), (c[1], y)]);
        assert!(outcome.is_solved(), "{y}: {outcome:?}");
        let off = off_least(&s.x0, &values, places);
        assert!(off < 1e-6, "{y}: {off}");
        s.x0 = values;
    }
}

#[test]
fn a_chain_that_is_dragged_inside_out_is_as_near_to_the_press_as_it_can_be() {
    let (mut s, places) = chain();
    let c = places[2];
    let (values, outcome, _) = s.set(&[(c[0], 2.0), (c[1], 100.0)]);
    assert!(outcome.is_solved(), "{outcome:?}");
    s.x0 = values;
    for slot in c {
        s.system.slots[slot as usize].stay = solve::Stay::Fixed;
    }
    let plan = s.plan();
    for frames in [1, 7, 100] {
        let mut drag: Drag = s.drag(&plan, &c);
        for k in 1..=frames {
            let y = 100.0 - 95.0 * f64::from(k) / f64::from(frames);
            assert!(drag.follow(&plan, &[2.0, y], &mut NoHost).is_solved());
        }
        let off = off_least(&s.x0, drag.values(), places);
        assert!(off < 1e-6, "{frames}: {off}");
        let [x, y] = places[0].map(|i| drag.values()[i as usize]);
        close(x, 1.99678, 1e-4);
        close(y, 10.0, 1e-4);
    }
}
