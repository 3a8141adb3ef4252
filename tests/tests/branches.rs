//! Large changes of linkages, beside a reference path of a thousand small steps.
//!
//! A four-bar stands at one angle of its crank and is set, in one edit, to another; it is dragged
//! there in one step; it is set back. Wherever the reference path arrives, each must end where that
//! does, and back is where it began. Where the bars cannot reach, the edit is refused and changes no bit.
//! The angles are those of a fixed sequence; `THINGLAB_LONG` tries more of them.

use base::number::{cos, sin};
use bench::case::{Case, Constraint};
use bench::document;
use bench::opened::Opened;
use kernel::{Value, Values};
use plan::{EditKind, Planner, Target};
use std::f64::consts::PI;

/// How far two ends may lie apart.
const SAME: f64 = 1e-6;
/// The steps of the reference path.
const STEPS: usize = 1000;
/// Ground, crank, coupler and rocker.
const LINKAGES: [[f64; 4]; 5] = [
    [4.0, 1.0, 3.5, 3.0],
    [12.0, 10.0, 10.0, 10.0],
    [5.0, 4.0, 3.0, 3.0],
    [2.0, 1.0, 2.5, 2.5],
    [6.0, 3.0, 4.0, 4.5],
];

/// Where crank tip and joint are when the crank has turned to an angle, the joint to the left of the
/// way from the tip to the rocker's foot; nothing where the bars cannot reach, or only just.
fn position([ground, crank, coupler, rocker]: [f64; 4], angle: f64) -> Option<[[f64; 2]; 2]> {
    let tip = [crank * cos(angle), crank * sin(angle)];
    let (x, y) = (ground - tip[0], -tip[1]);
    let far = (x * x + y * y).sqrt();
    let along = (coupler * coupler - rocker * rocker + far * far) / (2.0 * far);
    let square = coupler * coupler - along * along;
    let aside = (square > 0.01).then(|| square.sqrt())?;
    Some([tip, [tip[0] + (along * x - aside * y) / far, tip[1] + (along * y + aside * x) / far]])
}

struct FourBar {
    opened: Opened,
    planner: Planner,
    values: Values,
}

impl FourBar {
    fn new(bars: [f64; 4], angle: f64) -> Option<Self> {
        let [tip, joint] = position(bars, angle)?;
        let [ground, crank, coupler, rocker] = bars;
        let start = vec![[0.0, 0.0], tip, joint, [ground, 0.0]];
        let case = Case {
            format: "gcs-case/1".into(),
            name: "four-bar".into(),
            well_constrained: true,
            truth: start.clone(),
            start,
            lines: vec![[0, 3], [0, 1]],
            arcs: Vec::new(),
            constraints: vec![
                Constraint::Fix { p: 0, x: 0.0, y: 0.0 },
                Constraint::Fix { p: 3, x: ground, y: 0.0 },
                Constraint::Distance { p: 0, q: 1, v: crank },
                Constraint::Distance { p: 1, q: 2, v: coupler },
                Constraint::Distance { p: 2, q: 3, v: rocker },
                Constraint::Angle { l: 0, m: 1, v: angle },
            ],
            drag: None,
        };
        let opened = Opened::new(&document::text(&case)).expect("a four-bar can be said");
        let (planner, values, report) = opened.solve();
        assert!(report.unmet.is_empty(), "it begins where its bars reach");
        Some(Self { opened, planner, values })
    }

    fn edit(&mut self, kind: EditKind, angle: f64) -> bool {
        let thing = self.opened.thing("c5.value").expect("the angle has a value");
        let targets = [(Target::Thing(thing), vec![Value::Number(angle)])];
        let (model, values) = (self.opened.model(), &mut self.values);
        let report = self.planner.edit(model, values, kind, &targets, &mut self.opened.host());
        report.refusal.is_none() && report.reached
    }

    fn joint(&self) -> [f64; 2] {
        let slots = self.opened.slots("p2");
        [self.values.numbers[slots[0]], self.values.numbers[slots[1]]]
    }
}

fn same(p: [f64; 2], q: [f64; 2]) -> bool {
    (p[0] - q[0]).abs() <= SAME && (p[1] - q[1]).abs() <= SAME
}

/// Returns true if the joint stays to the left all the way from one angle to the other.
fn reachable(bars: [f64; 4], from: f64, to: f64) -> bool {
    (0..=STEPS).all(|i| position(bars, from + (to - from) * i as f64 / STEPS as f64).is_some())
}

#[derive(Default, Debug)]
struct Count {
    reached: u32,
    refused: u32,
    unreachable: u32,
}

/// Tries one change out and back; what went wrong is told.
fn out_and_back(bars: [f64; 4], from: f64, to: f64, count: &mut Count, wrong: &mut Vec<String>) {
    for kind in [EditKind::Set, EditKind::Move] {
        let Some(mut linkage) = FourBar::new(bars, from) else { return };
        let began = linkage.joint();
        let before = linkage.values.clone();
        let arrived = linkage.edit(kind, to);
        let told =
            format!("{bars:?} from {:.1}° to {:.1}°, {kind:?}", from.to_degrees(), to.to_degrees());
        if !reachable(bars, from, to) {
            count.unreachable += 1;
            if !arrived && kind == EditKind::Set && linkage.values != before {
                wrong.push(format!("{told}: refused, and yet changed"));
            }
            continue;
        }
        let [_, joint] = position(bars, to).expect("it can be reached");
        if !arrived {
            count.refused += 1;
            continue;
        }
        count.reached += 1;
        if !same(linkage.joint(), joint) {
            wrong.push(format!("{told}: at {:?}, not {joint:?}", linkage.joint()));
        } else if !linkage.edit(kind, from) || !same(linkage.joint(), began) {
            wrong.push(format!("{told}: back at {:?}, not {began:?}", linkage.joint()));
        }
    }
}

#[test]
fn large_changes_end_where_small_steps_do_and_come_back() {
    let pairs = if std::env::var_os("THINGLAB_LONG").is_some() { 400 } else { 16 };
    let (mut count, mut wrong) = (Count::default(), Vec::new());
    for bars in LINKAGES {
        for i in 0..pairs {
            // two irrational turns fill the square of angles evenly
            let turn = |by: f64| ((f64::from(i) + 0.5) * by).fract() * 2.0 * PI - PI;
            let (from, to) = (turn(0.754_877_666), turn(0.569_840_291));
            out_and_back(bars, from, to, &mut count, &mut wrong);
        }
    }
    assert!(wrong.is_empty(), "{count:?}\n{}", wrong.join("\n"));
    assert!(count.reached > 50, "there was something to try: {count:?}");
    let missed = f64::from(count.refused) / f64::from(count.reached + count.refused);
    assert!(missed <= 0.001, "reachable, and yet refused: {count:?}");
}

#[test]
fn ten_thousand_steps_of_a_drag_do_not_drift() {
    let bars = LINKAGES[0];
    let mut linkage = FourBar::new(bars, 0.0).expect("it begins where its bars reach");
    let thing = linkage.opened.thing("c5.value").expect("the angle has a value");
    let (model, host) = (linkage.opened.model(), &mut linkage.opened.host());
    let press = linkage.planner.press(model, &linkage.values, &[Target::Thing(thing)]);
    let mut press = press.expect("an angle can be dragged");
    for i in 1..=10_000 {
        // ten turns to the left and ten back
        let turned = if i <= 5000 { i } else { 10_000 - i };
        let angle = f64::from(turned) / 500.0 * 2.0 * PI;
        let report = linkage.planner.drag(model, &mut press, &mut linkage.values, &[angle], host);
        assert!(report.reached, "step {i}");
        let [_, joint] = position(bars, angle).expect("this crank turns round");
        let slots = linkage.opened.slots("p2");
        let at = [linkage.values.numbers[slots[0]], linkage.values.numbers[slots[1]]];
        assert!(same(at, joint), "step {i}: at {at:?}, not {joint:?}");
    }
}
