//! Chains that are exactly straight when an edit begins: to first order no joint can give way, and no side is
//! nearer than the other. Pushed together they buckle, always alike; they are not stuck.

use bench::case::{Case, Constraint};
use bench::document;
use bench::opened::Opened;
use kernel::{Value, Values};
use plan::{EditKind, Target};

/// What lengths may be off by.
const EXACT: f64 = 1e-8;

/// A chain along a direction from a pin, pinned at its end too where it is a rope.
fn chain(bars: usize, along: [f64; 2], pins: &[usize]) -> Case {
    let at = |k: usize| along.map(|d| d * k as f64);
    let points: Vec<[f64; 2]> = (0..=bars).map(at).collect();
    let length = base::number::sqrt(along[0] * along[0] + along[1] * along[1]);
    let pin = |&p: &usize| Constraint::Fix { p, x: points[p][0], y: points[p][1] };
    let bar = |p: usize| Constraint::Distance { p, q: p + 1, v: length };
    Case {
        format: "gcs-case/1".into(),
        name: "chain".into(),
        well_constrained: false,
        truth: points.clone(),
        start: points.clone(),
        lines: Vec::new(),
        arcs: Vec::new(),
        constraints: (0..bars).map(bar).chain(pins.iter().map(pin)).collect(),
        drag: None,
    }
}

fn place(opened: &Opened, values: &Values, p: usize) -> [f64; 2] {
    let slots = opened.slots(&format!("p{p}"));
    [values.numbers[slots[0]], values.numbers[slots[1]]]
}

/// Returns how much the bar that is off most is off by.
fn torn(opened: &Opened, values: &Values, bars: usize) -> f64 {
    let length = |k: usize| {
        let ([a, b], [c, d]) = (place(opened, values, k), place(opened, values, k + 1));
        base::number::sqrt((c - a) * (c - a) + (d - b) * (d - b))
    };
    (0..bars).map(|k| (length(k) - 1.0).abs()).fold(0.0, f64::max)
}

/// Drags a joint towards the pin, in frames, to that part of its distance; returns where it all is then.
///
/// # Panics
/// If a wish is not reached or a bar does not keep its length.
fn pushed(case: &Case, joint: usize, frames: u32, part: f64, back: bool) -> Vec<[f64; 2]> {
    let opened = Opened::new(&document::text(case)).expect("a chain can be said");
    let (mut planner, mut values, report) = opened.solve();
    assert!(report.unmet.is_empty(), "it lies straight");
    let thing = opened.thing(&format!("p{joint}")).expect("it has this joint");
    let (model, host) = (opened.model(), &mut opened.host());
    let press = planner.press(model, &values, &[Target::Thing(thing)]);
    let mut press = press.expect("a joint can be dragged");
    let bars = case.start.len() - 1;
    let there = (1..=frames).map(|frame| f64::from(frame) / f64::from(frames));
    let again = (0..frames).rev().map(|frame| f64::from(frame) / f64::from(frames));
    for way in there.chain(again.filter(|_| back)) {
        let wish = case.start[joint].map(|x| x * (1.0 + (part - 1.0) * way));
        let moved = planner.drag(model, &mut press, &mut values, &wish, host);
        let told = format!("{bars} bars by joint {joint}, {way} of the way");
        assert!(moved.reached, "{told}: not reached");
        let off = torn(&opened, &values, bars);
        assert!(off <= EXACT, "{told}: a bar is off by {off:e}");
    }
    (0..=bars).map(|p| place(&opened, &values, p)).collect()
}

#[test]
fn a_straight_chain_buckles_where_it_is_pushed_together() {
    for along in [[1.0, 0.0], [0.6, -0.8]] {
        for (bars, joint) in [(3, 3), (10, 10), (10, 5), (80, 80), (80, 40)] {
            pushed(&chain(bars, along, &[0]), joint, 20, 0.7, false);
        }
    }
}

#[test]
fn three_bars_buckle_as_little_as_they_can() {
    // with ends two apart the joints are nearest to where they were where |(x1 - 1)² + ..| is least; by the symmetry
    // of the first direction, one up and one down
    let ends = [1, 20].map(|frames| pushed(&chain(3, [1.0, 0.0], &[0]), 3, frames, 0.99, false));
    for joints in &ends {
        let ([_, up], [_, down]) = (joints[1], joints[2]);
        assert!(up > 0.0 && down < 0.0, "{joints:?}");
        // to second order half of 9 / 2 times the square is what the bars are shorter by
        assert!(
            (up - down - 2.0 * up).abs() < 0.02 && (3.0 * up * up - 0.03).abs() < 3e-3,
            "{joints:?}"
        );
    }
    for (p, q) in ends[0].iter().zip(&ends[1]) {
        assert!((p[0] - q[0]).abs().max((p[1] - q[1]).abs()) < 1e-3, "{ends:?}");
    }
}

#[test]
fn pushed_together_and_pulled_again_it_is_straight() {
    for bars in [2, 3] {
        let joints = pushed(&chain(bars, [1.0, 0.0], &[0]), bars, 10, 0.8, true);
        for (k, [x, y]) in joints.into_iter().enumerate() {
            assert!((x - k as f64).abs().max(y.abs()) < 1e-4, "{bars} bars, joint {k}: {x}, {y}");
        }
    }
}

#[test]
fn a_rope_between_anchors_sags_where_one_of_them_is_set_nearer() {
    for bars in [2, 3, 10, 80] {
        let case = chain(bars, [1.0, 0.0], &[0, bars]);
        let opened = Opened::new(&document::text(&case)).expect("a rope can be said");
        let (mut planner, mut values, _) = opened.solve();
        // after the bars come the pins
        let thing = opened.thing(&format!("c{}.x", bars + 1)).expect("its end is pinned");
        let nearer = vec![Value::Number(0.8 * bars as f64)];
        let targets = [(Target::Thing(thing), nearer)];
        let host = &mut opened.host();
        let report = planner.edit(opened.model(), &mut values, EditKind::Set, &targets, host);
        assert_eq!(report.refusal, None, "{bars} bars");
        assert!(torn(&opened, &values, bars) <= EXACT, "{bars} bars");
        let [x, _] = place(&opened, &values, bars);
        assert!((x - 0.8 * bars as f64).abs() <= EXACT, "{bars} bars: {x}");
    }
}

#[test]
fn a_rope_that_is_given_straight_sags_when_it_is_opened() {
    // an odd number and an even one, short ropes, and some of which all rows are solved by sparse factors
    for bars in [2, 3, 10, 40, 77, 120, 200] {
        for part in [0.99, 0.9, 0.5] {
            let mut case = chain(bars, [1.0, 0.0], &[]);
            case.start.iter_mut().for_each(|[x, _]| *x *= part);
            let ends = [0, bars].map(|p| Constraint::Fix { p, x: case.start[p][0], y: 0.0 });
            case.constraints.extend(ends);
            let opened = Opened::new(&document::text(&case)).expect("a rope can be said");
            let (_, values, report) = opened.solve();
            let told = format!("{bars} bars, ends at {part} of their length");
            assert!(report.unmet.is_empty(), "{told}: {} do not hold", report.unmet.len());
            let off = torn(&opened, &values, bars);
            assert!(off <= EXACT, "{told}: a bar is off by {off:e}");
            // bars that together are longer than the way between the ends go up or down
            let high = (0..=bars).map(|p| place(&opened, &values, p)[1].abs()).fold(0.0, f64::max);
            assert!(high > 0.05, "{told}: {high}");
        }
    }
}
