//! Two equations in two unknowns by formula: where circles, lines and products meet.

use crate::builder::{Sheet, bits, close, lines};
use expr::Binary;
use solve::{NoHost, Note, Reason, SlotIndex, Status};

/// A place at these distances from two others.
fn meeting(sheet: &mut Sheet, start: [f64; 2], ties: [([f64; 2], f64); 2]) -> [SlotIndex; 2] {
    let place = sheet.place(start[0], start[1]);
    for ([x, y], length) in ties {
        let from = sheet.anchor(x, y);
        let (distance, length) = (sheet.distance(from, place), sheet.c(length));
        sheet.require(distance, length);
    }
    place
}

/// A place as far as this from (0, 0), in a direction from there that can be set.
fn polar(sheet: &mut Sheet, start: [f64; 2], radius: f64, angle: f64) -> ([SlotIndex; 2], u32) {
    let (place, direction) = (sheet.place(start[0], start[1]), sheet.given(angle));
    let center = sheet.anchor(0.0, 0.0);
    let (distance, length) = (sheet.distance(center, place), sheet.c(radius));
    sheet.require(distance, length);
    let [x, y] = place.map(|s| sheet.v(s));
    let (turned, wanted) = (sheet.binary(Binary::Atan2, y, x), sheet.v(direction));
    sheet.require(turned, wanted);
    (place, direction)
}

fn solved(sheet: &Sheet, place: [SlotIndex; 2], wanted: [f64; 2], within: f64) -> Vec<f64> {
    let plan = sheet.plan();
    assert!(lines(&plan).contains("closed form"), "{}", lines(&plan));
    let (values, outcome) = sheet.run(&plan, &[], &mut NoHost);
    assert!(outcome.is_solved() && outcome.notes.is_empty(), "{outcome:?}");
    for (slot, wanted) in place.into_iter().zip(wanted) {
        close(values[slot as usize], wanted, within);
    }
    values
}

#[test]
fn circles_that_do_not_meet_are_refused() {
    for ties in [[([0.0, 0.0], 2.0), ([5.0, 0.0], 2.9)], [([0.0, 0.0], 5.0), ([1.0, 0.0], 2.0)]] {
        let mut s = Sheet::default();
        meeting(&mut s, [2.0, 1.0], ties);
        let (values, outcome) = s.run(&s.plan(), &[], &mut NoHost);
        let refused = Status::Stopped(Reason::NoSolution { step: 0 });
        assert_eq!(outcome.status, refused);
        assert_eq!(bits(&values), bits(&s.x0));
    }
}

#[test]
fn circles_that_touch_have_a_double_solution() {
    let mut s = Sheet::default();
    let p = meeting(&mut s, [2.5, 0.7], [([0.0, 0.0], 2.0), ([5.0, 0.0], 3.0)]);
    let (values, outcome) = s.run(&s.plan(), &[], &mut NoHost);
    assert!(outcome.is_solved(), "{outcome:?}");
    assert_eq!(outcome.notes, [Note::DoubleRoot { slot: p[1] }]);
    close(values[p[0] as usize], 2.0, 1e-7);
    close(values[p[1] as usize], 0.0, 1e-4);
}

#[test]
fn circles_meet_on_the_side_of_the_start_and_stay_there() {
    // 3-4-5 triangles above and below the line of centres
    let ties = [([0.0, 0.0], 5.0), ([6.0, 0.0], 5.0)];
    for (start, side) in [([2.0, 0.4], 1.0), ([40.0, 90.0], 1.0), ([2.9, -0.1], -1.0)] {
        let mut s = Sheet::default();
        let p = meeting(&mut s, start, ties);
        s.x0 = solved(&s, p, [3.0, 4.0 * side], 1e-14);
        let again = solved(&s, p, [3.0, 4.0 * side], 1e-14);
        assert_eq!(bits(&again), bits(&s.x0));
    }
}

#[test]
fn far_from_the_origin_the_solution_is_as_good_as_its_numbers() {
    let far = 1e6;
    let mut s = Sheet::default();
    let ties = [([far, far], 5.0), ([far + 6.0, far], 5.0)];
    let p = meeting(&mut s, [far + 2.0, far + 1.0], ties);
    solved(&s, p, [far + 3.0, far + 4.0], 4.0 * f64::EPSILON * far);
}

#[test]
fn what_lies_the_wrong_way_of_a_direction_is_no_solution() {
    // 120° from where it starts: the nearer crossing of line and circle is the opposite one
    let mut s = Sheet::default();
    let (p, _) = polar(&mut s, [10.0, 1.0], 10.0, 2.0 * std::f64::consts::FRAC_PI_3);
    solved(&s, p, [-5.0, 5.0 * base::number::sqrt(3.0)], 1e-14);
}

#[test]
fn a_direction_is_followed_all_the_way_round() {
    let mut s = Sheet::default();
    let (p, direction) = polar(&mut s, [10.0, 0.0], 10.0, 0.0);
    for degrees in [30.0, 90.0, 170.0, -170.0_f64] {
        let angle = degrees.to_radians();
        let (values, outcome, _) = s.set(&[(direction, angle)]);
        assert!(outcome.is_solved(), "{degrees}: {outcome:?}");
        close(values[p[0] as usize], 10.0 * base::number::cos(angle), 1e-12);
        close(values[p[1] as usize], 10.0 * base::number::sin(angle), 1e-12);
    }
}

#[test]
fn two_directions_cross() {
    // 45° from (0, 0) and 135° from (10, 0)
    let mut s = Sheet::default();
    let p = s.place(3.0, 1.0);
    for (x, eighths) in [(0.0, 1.0), (10.0, 3.0)] {
        let (px, py, from) = (s.v(p[0]), s.v(p[1]), s.c(x));
        let across = s.sub(px, from);
        let turned = s.binary(Binary::Atan2, py, across);
        let wanted = s.c(eighths * std::f64::consts::FRAC_PI_4);
        s.require(turned, wanted);
    }
    solved(&s, p, [5.0, 5.0], 1e-14);
}

#[test]
fn a_sum_and_a_product_are_solved_by_formula() {
    let mut s = Sheet::default();
    let p = s.place(1.5, 4.0);
    let [x, y] = p.map(|slot| s.v(slot));
    let (sum, product) = (s.add(x, y), s.mul(x, y));
    let (five, six) = (s.c(5.0), s.c(6.0));
    s.require(sum, five);
    s.require(product, six);
    solved(&s, p, [2.0, 3.0], 1e-14);
}

#[test]
fn a_place_that_two_bars_hold_follows_where_their_feet_go() {
    // a bar of 5 from (0, 0), one of 5 from a foot that is dragged from (6, 0) along the ground
    let mut s = Sheet::default();
    let (left, foot) = (s.anchor(0.0, 0.0), s.anchor(6.0, 0.0));
    let p = s.place(3.0, 4.0);
    for from in [left, foot] {
        let (distance, five) = (s.distance(from, p), s.c(5.0));
        s.require(distance, five);
    }
    let plan = s.plan();
    let mut drag = s.drag(&plan, &foot);
    for x in [7.0, 2.0, 9.5] {
        assert!(drag.follow(&plan, &[x, 0.0], &mut NoHost).is_solved());
        let height = base::number::sqrt(25.0 - x * x / 4.0);
        close(drag.values()[p[0] as usize], x / 2.0, 1e-12);
        close(drag.values()[p[1] as usize], height, 1e-12);
    }
    // it cannot be farther than both bars reach, and comes back to the bits that it had
    let outcome = drag.follow(&plan, &[10.5, 0.0], &mut NoHost);
    let Status::Stopped(Reason::Limit { fraction }) = outcome.status else { panic!("{outcome:?}") };
    close(9.5 + fraction, 10.0, 1e-6);
    assert!(drag.follow(&plan, &[6.0, 0.0], &mut NoHost).is_solved());
    assert_eq!(bits(drag.values()), bits(&s.x0));
}
