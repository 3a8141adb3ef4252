//! Drags: out and back, slow and fast, limits.

use crate::builder::{Sheet, bits, close};
use crate::who::quadrilateral;
use solve::{Drag, NoHost, Reason, SlotIndex, Status};

#[test]
fn out_and_back_restores_every_bit() {
    let (mut s, p) = quadrilateral();
    let w = s.wish(&p[6]);
    let plan = s.plan();
    let mut drag = s.drag(&plan, &w);
    let home = [s.x0[w[0] as usize], s.x0[w[1] as usize]];
    for k in 0..50 {
        let target = [home[0] + f64::from(k) * 1.7, home[1] - f64::from(k * k) * 0.3];
        assert!(drag.follow(&plan, &target, &mut NoHost).is_solved());
    }
    assert!(drag.follow(&plan, &home, &mut NoHost).is_solved());
    assert_eq!(bits(drag.values()), bits(&s.x0));
}

/// An anchored elbow of two bars of 10, its tip at (12, 0), its knee above.
fn elbow() -> (Sheet, [[u32; 2]; 2], Vec<u32>) {
    let mut s = Sheet::default();
    let shoulder = s.anchor(0.0, 0.0);
    let knee = s.place(6.0, 8.0);
    let tip = s.place(12.0, 0.0);
    for (a, b) in [(shoulder, knee), (knee, tip)] {
        let (d, ten) = (s.distance(a, b), s.c(10.0));
        s.require(d, ten);
    }
    let w = s.wish(&tip);
    (s, [knee, tip], w)
}

#[test]
fn an_elbow_does_not_flip_and_fast_is_slow() {
    let (s, [knee, tip], w) = elbow();
    let plan = s.plan();
    let goal = [-4.0, 9.0];
    let mut fast = s.drag(&plan, &w);
    assert!(fast.follow(&plan, &goal, &mut NoHost).is_solved());
    let mut slow = s.drag(&plan, &w);
    for k in 1..=1000 {
        let part = f64::from(k) / 1000.0;
        let target = [12.0 + part * (goal[0] - 12.0), part * goal[1]];
        let outcome = slow.follow(&plan, &target, &mut NoHost);
        assert!(outcome.is_solved() && outcome.unmet.is_empty(), "{k}: {outcome:?}");
    }
    for slot in [knee, tip].concat() {
        close(fast.values()[slot as usize], slow.values()[slot as usize], 1e-8);
    }
    let v = fast.values();
    let [kx, ky, tx, ty] = [knee[0], knee[1], tip[0], tip[1]].map(|i| v[i as usize]);
    assert!(kx * ty - ky * tx < 0.0, "the knee stays on its side");
}

#[test]
fn an_elbow_stops_at_its_reach_pointing_at_the_mouse() {
    let (s, [knee, tip], w) = elbow();
    let plan = s.plan();
    let mut drag = s.drag(&plan, &w);
    let outcome = drag.follow(&plan, &[24.0, 32.0], &mut NoHost);
    assert!(outcome.is_solved(), "{outcome:?}");
    assert_eq!(outcome.unmet.len(), 2, "both wishes are unmet");
    close(drag.values()[tip[0] as usize], 12.0, 1e-7);
    close(drag.values()[tip[1] as usize], 16.0, 1e-7);
    close(drag.values()[knee[0] as usize], 6.0, 1e-6);
    // round the outside, then back in: the knee is on the side where it was
    for target in [[30.0, 20.0], [40.0, 0.0], [30.0, -10.0]] {
        assert!(drag.follow(&plan, &target, &mut NoHost).is_solved());
    }
    assert!(drag.follow(&plan, &[12.0, 0.0], &mut NoHost).is_solved());
    close(drag.values()[knee[0] as usize], 6.0, 1e-9);
    close(drag.values()[knee[1] as usize], 8.0, 1e-9);
}

#[test]
fn a_required_wish_stops_at_the_limit() {
    // x^2 + y^2 = 25, x is driven: y ends at x = 5
    let mut s = Sheet::default();
    let x = s.fixed(3.0);
    let y = s.kept(4.0);
    let (vx, vy) = (s.v(x), s.v(y));
    let (a, b) = (s.mul(vx, vx), s.mul(vy, vy));
    let (sum, all) = (s.add(a, b), s.c(25.0));
    s.require(sum, all);
    let plan = s.plan();
    let mut drag = s.drag(&plan, &[x]);
    let outcome = drag.follow(&plan, &[7.0], &mut NoHost);
    match outcome.status {
        Status::Stopped(Reason::Limit { fraction }) => close(fraction, 0.5, 1e-5),
        other => panic!("{other:?}"),
    }
    close(drag.values()[x as usize], 5.0, 1e-5);
    assert!(drag.follow(&plan, &[4.0], &mut NoHost).is_solved());
    close(drag.values()[y as usize], 3.0, 1e-12);
}

#[test]
fn a_held_point_does_not_move() {
    let mut s = Sheet::default();
    let p = s.anchor(1.0, 2.0);
    let w = s.wish(&p);
    let plan = s.plan();
    let mut drag = s.drag(&plan, &w);
    let outcome = drag.follow(&plan, &[5.0, 5.0], &mut NoHost);
    assert!(outcome.is_solved() && outcome.unmet.len() == 2);
    assert_eq!(drag.values()[..2], [1.0, 2.0]);
}

/// Bars of 10, up and down in turn, between a crank's end and an anchor; returns the crank's end too.
fn chain_of_bars(joints: u32) -> (Sheet, [SlotIndex; 2]) {
    let mut s = Sheet::default();
    let at = |k: u32| [5.0 + 6.0 * f64::from(k), 75f64.sqrt() + 8.0 * f64::from(k % 2)];
    let crank = s.anchor(at(0)[0], at(0)[1]);
    let mut before = crank;
    for k in 1..=joints + 1 {
        let [x, y] = at(k);
        let joint = if k > joints { s.anchor(x, y) } else { s.place(x, y) };
        let (length, ten) = (s.distance(before, joint), s.c(10.0));
        s.require(length, ten);
        before = joint;
    }
    (s, crank)
}

#[test]
fn a_chain_of_bars_follows_as_a_whole_and_comes_back() {
    for joints in [7, 50] {
        let (s, crank) = chain_of_bars(joints);
        let plan = s.plan();
        let mut drag = s.drag(&plan, &crank);
        let turn = |drag: &mut Drag, degrees: f64| {
            let angle = (60.0 + degrees).to_radians();
            let before = drag.values().to_vec();
            let target = [10.0 * base::number::cos(angle), 10.0 * base::number::sin(angle)];
            let outcome = drag.follow(&plan, &target, &mut NoHost);
            assert!(outcome.is_solved(), "{joints}, {degrees}: {outcome:?}");
            for (a, b) in before.iter().zip(drag.values()) {
                // the crank's end moves by 0.087
                close(*a, *b, 0.15);
            }
        };
        for step in (1..=100).chain((0..100).rev()) {
            turn(&mut drag, f64::from(step) * 0.5);
        }
        for (a, b) in s.x0.iter().zip(drag.values()) {
            close(*a, *b, 1e-7);
        }
    }
}

/// `n` rows each of `p = k a + c`, a chain of `b' = k b + c`, and `q k = a`, whose formula divides by `k`.
fn rows_of_one_k(n: u32) -> (Sheet, SlotIndex) {
    let mut sheet = Sheet::default();
    let k = sheet.kept(1.25);
    let c = sheet.given(0.5);
    let mut before = sheet.given(1.0);
    for i in 0..n {
        let a = sheet.given(0.1 * f64::from(i) - 0.7);
        let [p, b, q] = [(); 3].map(|()| sheet.free(0.0));
        let [vk, vc, va, vp, vb, vq] = [k, c, a, p, b, q].map(|s| sheet.v(s));
        let vbefore = sheet.v(before);
        let line = sheet.mul(vk, va);
        let line = sheet.add(line, vc);
        sheet.require(vp, line);
        let next = sheet.mul(vk, vbefore);
        let next = sheet.add(next, vc);
        sheet.require(vb, next);
        let product = sheet.mul(vq, vk);
        sheet.require(product, va);
        before = b;
    }
    sheet.open();
    (sheet, k)
}

#[test]
fn rows_of_one_formula_have_the_bits_of_single_steps() {
    for n in [1, 3, 11, 40] {
        let (mut sheet, k) = rows_of_one_k(n);
        let wish = sheet.wish(&[k]);
        let plan = sheet.plan();
        let mut drag = sheet.drag(&plan, &wish);
        for value in [1.5, -0.3, 7.0, 1.0, 1.25] {
            let outcome = drag.follow(&plan, &[value], &mut NoHost);
            assert!(outcome.is_solved() && outcome.unmet.is_empty(), "{outcome:?}");
            let (single, _) = sheet.run(&plan, &[(wish[0], value)], &mut NoHost);
            assert_eq!(bits(drag.values()), bits(&single), "{n} rows at {value}");
        }
        assert_eq!(bits(drag.values()), bits(&sheet.x0), "{n} rows come back");
    }
}

#[test]
fn where_one_row_of_many_has_no_solution_none_moves() {
    let (mut sheet, k) = rows_of_one_k(20);
    let wish = sheet.wish(&[k]);
    let plan = sheet.plan();
    let mut drag = sheet.drag(&plan, &wish);
    assert!(drag.follow(&plan, &[2.0], &mut NoHost).is_solved());
    let there = bits(drag.values());
    drag.follow(&plan, &[0.0], &mut NoHost);
    let q = |values: &[f64]| values[5];
    assert!(q(drag.values()).is_finite() && drag.values()[k as usize] > 0.0);
    assert!(drag.follow(&plan, &[2.0], &mut NoHost).is_solved());
    assert_eq!(bits(drag.values()), there);
}

#[test]
fn a_press_where_all_holds_runs_what_is_downstream_alone() {
    let (mut sheet, k) = rows_of_one_k(5);
    // m = n stands upstream of nothing that moves, beyond its tolerance's last bit
    let [m, n] = [sheet.kept(3.0), sheet.kept(3.0 + 1e-12)];
    let (vm, vn) = (sheet.v(m), sheet.v(n));
    let twice = sheet.add(vn, vn);
    let sum = sheet.add(vm, vm);
    sheet.require(sum, twice);
    let wish = sheet.wish(&[k]);
    let plan = sheet.plan();
    let mut drag = sheet.drag(&plan, &wish);
    assert!(drag.follow(&plan, &[1.5], &mut NoHost).is_solved());
    assert!(drag.moved().is_some_and(|moved| !moved.contains(&m) && !moved.contains(&n)));
    assert_eq!(drag.values()[n as usize].to_bits(), (3.0 + 1e-12_f64).to_bits());
}

/// What a plan knows of where its last drag ended tells no other state.
#[test]
fn a_drag_is_the_same_whatever_its_plan_was_used_for() {
    let (mut sheet, k) = rows_of_one_k(5);
    let [m, n] = [sheet.kept(3.0), sheet.kept(3.0)];
    let (vm, vn) = (sheet.v(m), sheet.v(n));
    let (sum, twice) = (sheet.add(vm, vm), sheet.add(vn, vn));
    sheet.require(sum, twice);
    let wish = sheet.wish(&[k]);
    let used = sheet.plan();
    let mut first = sheet.drag(&used, &wish);
    assert!(first.follow(&used, &[1.5], &mut NoHost).is_solved());
    sheet.x0 = first.values().to_vec();
    first.end(&used);
    // where the first ended, and where what no drag moves does not hold
    for off in [0.0, 2.0] {
        sheet.x0[m as usize] += off;
        let fresh = sheet.plan();
        let [one, other] = [&used, &fresh].map(|plan| {
            let mut drag = sheet.drag(plan, &wish);
            assert!(drag.follow(plan, &[1.75], &mut NoHost).is_solved());
            assert_eq!(drag.moved().is_some_and(|moved| !moved.contains(&m)), off == 0.0);
            drag.values().to_vec()
        });
        assert_eq!(bits(&one), bits(&other));
        close(one[m as usize], one[n as usize], 1e-9);
    }
}

/// Drags a chain of fifty joints there and back in so many frames; returns the states at every tenth of the
/// way, and the largest move in a frame of a unit.
fn there_and_back(far: [f64; 2], frames: u32) -> (Vec<Vec<f64>>, f64) {
    let (s, crank) = chain_of_bars(50);
    let plan = s.plan();
    let home = crank.map(|slot| s.x0[slot as usize]);
    let mut drag = s.drag(&plan, &crank);
    let (mut states, mut fastest) = (Vec::new(), 0.0_f64);
    let away = [far[0] - home[0], far[1] - home[1]];
    let length = (away[0] * away[0] + away[1] * away[1]).sqrt();
    for frame in (1..=frames).chain((0..frames).rev()) {
        let part = f64::from(frame) / f64::from(frames);
        let target = [home[0] + part * away[0], home[1] + part * away[1]];
        let before = drag.values().to_vec();
        let outcome = drag.follow(&plan, &target, &mut NoHost);
        assert!(outcome.is_solved(), "{target:?}: {outcome:?}");
        let moved = furthest(&before, drag.values());
        fastest = fastest.max(moved / length * f64::from(frames));
        if frame % (frames / 10) == 0 {
            states.push(drag.values().to_vec());
        }
    }
    assert_eq!(bits(drag.values()), bits(&s.x0), "{far:?} in {frames} frames");
    (states, fastest)
}

fn furthest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn a_long_chain_comes_back_as_it_went_however_the_frames_fall() {
    // the first two leave the branch of least change from the press, four times and once
    for far in [[200.0, 200.0], [60.0, 200.0], [150.0, 20.0], [0.0, -200.0]] {
        let (states, fastest) = there_and_back(far, 700);
        assert!(fastest < 4.0, "{far:?}: a joint moves {fastest} times as fast as the end");
        for (out, back) in states[..9].iter().zip(states[10..19].iter().rev()) {
            assert!(furthest(out, back) < 1e-9, "{far:?}: {:e} off", furthest(out, back));
        }
        for frames in [30, 90] {
            for (one, other) in states.iter().zip(&there_and_back(far, frames).0) {
                let off = furthest(one, other);
                assert!(off < 1e-9, "{far:?} in {frames} frames: {off:e} off");
            }
        }
    }
}

#[test]
fn a_long_chain_that_is_led_round_does_not_jump() {
    let (s, crank) = chain_of_bars(50);
    let plan = s.plan();
    let home = crank.map(|slot| s.x0[slot as usize]);
    let mut drag = s.drag(&plan, &crank);
    let mut from = home;
    for to in [[200.0, 200.0], [0.0, 200.0], home] {
        let mut largest = 0.0_f64;
        for frame in 1..=500 {
            let part = f64::from(frame) / 500.0;
            let target = [0, 1].map(|i| from[i] + part * (to[i] - from[i]));
            let before = drag.values().to_vec();
            assert!(drag.follow(&plan, &target, &mut NoHost).is_solved());
            largest = largest.max(furthest(&before, drag.values()));
        }
        assert!(largest < 1.0, "a joint moves by {largest} on the way to {to:?}");
        from = to;
    }
}
