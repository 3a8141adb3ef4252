//! Large changes of sketches, beside a reference path of many small steps.
//!
//! Every sketch has one constraint whose value is changed: an angle that drives a mechanism, a length, a
//! radius. From where it stands the value is dragged in small steps to another; set there in one edit,
//! the sketch has to end at the same place, and set back, where it was. `THINGLAB_LONG` makes the steps
//! a thousand and the changes many.

use base::number::{cos, sin, sqrt};
use bench::case::{Case, Constraint};
use bench::document;
use bench::families::{Family, generate};
use bench::opened::Opened;
use bench::residual::largest;
use kernel::{Value, Values};
use plan::{EditKind, Planner, Target};

/// How far two ends may lie apart.
const SAME: f64 = 1e-6;
/// No point moves farther in a small step, as a part of the sketch's extent.
const JUMP: f64 = 0.05;

/// A sketch, the constraint whose value is changed, and between which values.
struct Shape {
    case: Case,
    constraint: usize,
    /// The value that it begins with.
    told: f64,
    between: [f64; 2],
}

fn shape(name: &str, start: Vec<[f64; 2]>, lines: &[[usize; 2]], rules: &[Constraint]) -> Case {
    Case {
        format: "gcs-case/1".into(),
        name: name.into(),
        well_constrained: true,
        truth: start.clone(),
        start,
        lines: lines.to_vec(),
        arcs: Vec::new(),
        constraints: rules.to_vec(),
        drag: None,
    }
}

fn fix(p: usize, x: f64, y: f64) -> Constraint {
    Constraint::Fix { p, x, y }
}
fn bar(p: usize, q: usize, v: f64) -> Constraint {
    Constraint::Distance { p, q, v }
}

/// A crank of 3 and a rod of 8, whose end slides along a level line.
fn slider_crank() -> Shape {
    let tip = [3.0 * cos(0.5), 3.0 * sin(0.5)];
    let slider = [tip[0] + sqrt(64.0 - tip[1] * tip[1]), 0.0];
    let rules = [
        fix(0, 0.0, 0.0),
        Constraint::Horizontal { l: 0 },
        bar(0, 1, 3.0),
        bar(1, 2, 8.0),
        Constraint::Angle { l: 0, m: 1, v: 0.5 },
    ];
    let case = shape("slider-crank", vec![[0.0; 2], tip, slider], &[[0, 2], [0, 1]], &rules);
    Shape { case, constraint: 4, told: 0.5, between: [-3.1, 3.1] }
}

/// Peaucellier's linkage: point 5 moves along a straight line while point 2 goes round a circle.
fn peaucellier() -> Shape {
    let (long, short, turn) = (8.0, 4.0, 0.7);
    let a = [3.0 + 3.0 * cos(turn), 3.0 * sin(turn)];
    let far = sqrt(a[0] * a[0] + a[1] * a[1]);
    let [u, w] = [a[0] / far, a[1] / far];
    let along = (far * far + long * long - short * short) / (2.0 * far);
    let aside = sqrt(long * long - along * along);
    let at = |along: f64, aside: f64| [along * u - aside * w, along * w + aside * u];
    let end = at((long * long - short * short) / far, 0.0);
    let start = vec![[0.0; 2], [3.0, 0.0], a, at(along, aside), at(along, -aside), end];
    let rules = [
        fix(0, 0.0, 0.0),
        fix(1, 3.0, 0.0),
        bar(1, 2, 3.0),
        bar(0, 3, long),
        bar(0, 4, long),
        bar(2, 3, short),
        bar(2, 4, short),
        bar(5, 3, short),
        bar(5, 4, short),
        Constraint::Angle { l: 0, m: 1, v: turn },
    ];
    let case = shape("peaucellier", start, &[[0, 1], [1, 2]], &rules);
    Shape { case, constraint: 9, told: turn, between: [-1.8, 1.8] }
}

/// A triangle by its sides; the third changes.
fn triangle() -> Shape {
    let rules = [
        fix(0, 0.0, 0.0),
        Constraint::Horizontal { l: 0 },
        bar(0, 1, 5.0),
        bar(1, 2, 4.0),
        bar(0, 2, 3.0),
    ];
    let start = vec![[0.0; 2], [5.0, 0.0], [1.8, 2.4]];
    let case = shape("triangle", start, &[[0, 1]], &rules);
    Shape { case, constraint: 4, told: 3.0, between: [1.01, 9.2] }
}

/// A quadrilateral by its sides and one angle; the side opposite changes.
fn quadrilateral() -> Shape {
    let corner = [6.0 * cos(1.2), 6.0 * sin(1.2)];
    let rules = [
        fix(0, 0.0, 0.0),
        Constraint::Horizontal { l: 0 },
        bar(0, 1, 7.0),
        bar(0, 3, 6.0),
        bar(1, 2, 5.0),
        bar(2, 3, 6.0),
        Constraint::Angle { l: 0, m: 1, v: 1.2 },
    ];
    // the corner opposite lies where circles about its neighbours meet, on the far side
    let [x, y] = [corner[0] - 7.0, corner[1]];
    let far = sqrt(x * x + y * y);
    let along = (25.0 - 36.0 + far * far) / (2.0 * far);
    let aside = sqrt(25.0 - along * along);
    let opposite = [7.0 + (along * x + aside * y) / far, (along * y - aside * x) / far];
    let start = vec![[0.0; 2], [7.0, 0.0], opposite, corner];
    let case = shape("quadrilateral", start, &[[0, 1], [0, 3]], &rules);
    Shape { case, constraint: 5, told: 6.0, between: [2.5, 12.2] }
}

/// Lines joined by arcs that touch them; a radius changes.
fn arcs() -> Shape {
    let mut case = generate(Family::Arcs, 6, 2);
    case.start.clone_from(&case.truth);
    let radius = |c: &Constraint| matches!(c, Constraint::ArcRadius { .. });
    let constraint = case.constraints.iter().position(radius).expect("an arc has a radius");
    Shape { case, constraint, told: 5.0, between: [3.6, 12.0] }
}

struct Bench {
    shape: Shape,
    opened: Opened,
    planner: Planner,
    values: Values,
    told: f64,
    extent: f64,
}

#[derive(Default, Debug)]
struct Count {
    reached: u32,
    refused: u32,
    unreachable: u32,
}

impl Bench {
    fn new(shape: Shape) -> Self {
        let opened = Opened::new(&document::text(&shape.case)).expect("a sketch can be said");
        let (planner, values, report) = opened.solve();
        assert!(report.unmet.is_empty(), "{} begins where it holds", shape.case.name);
        let told = shape.told;
        let size = |p: &[f64; 2]| p[0].abs().max(p[1].abs());
        let extent = shape.case.start.iter().map(size).fold(0.0, f64::max);
        Self { shape, opened, planner, values, told, extent }
    }

    fn points(&self, values: &Values) -> Vec<[f64; 2]> {
        let place = |i: usize| {
            let slots = self.opened.slots(&format!("p{i}"));
            [values.numbers[slots[0]], values.numbers[slots[1]]]
        };
        (0..self.shape.case.start.len()).map(place).collect()
    }

    /// Goes in small steps; returns where that ends, unless it is stopped on the way.
    fn small_steps(&mut self, to: f64, steps: u32, wrong: &mut Vec<String>) -> Option<Values> {
        let thing = self.opened.thing(&format!("c{}.value", self.shape.constraint));
        let targets = [Target::Thing(thing.expect("the constraint has a value"))];
        let mut values = self.values.clone();
        let press = self.planner.press(self.opened.model(), &values, &targets);
        let mut press = press.expect("a value can be dragged");
        let mut last = self.points(&values);
        for i in 1..=steps {
            let value = self.told + (to - self.told) * f64::from(i) / f64::from(steps);
            let (model, host) = (self.opened.model(), &mut self.opened.host());
            if !self.planner.drag(model, &mut press, &mut values, &[value], host).reached {
                return None;
            }
            let now = self.points(&values);
            let far = apart(&last, &now);
            if far > JUMP * self.extent {
                wrong.push(format!("{}: a jump of {far} at {value}", self.shape.case.name));
            }
            last = now;
        }
        Some(values)
    }

    fn edit(&mut self, values: &mut Values, kind: EditKind, to: f64) -> bool {
        let thing = self.opened.thing(&format!("c{}.value", self.shape.constraint));
        let thing = thing.expect("the constraint has a value");
        let targets = [(Target::Thing(thing), vec![Value::Number(to)])];
        let (model, host) = (self.opened.model(), &mut self.opened.host());
        let report = self.planner.edit(model, values, kind, &targets, host);
        report.refusal.is_none() && report.reached
    }

    /// Changes the value, beside the reference path, and goes on from where that ends.
    fn change(&mut self, to: f64, steps: u32, count: &mut Count, wrong: &mut Vec<String>) {
        let from = self.told;
        let name = format!("{} from {from:.4} to {to:.4}", self.shape.case.name);
        let Some(end) = self.small_steps(to, steps, wrong) else {
            count.unreachable += 1;
            let mut values = self.values.clone();
            if !self.edit(&mut values, EditKind::Set, to) && values != self.values {
                wrong.push(format!("{name}: refused, and yet changed"));
            }
            return;
        };
        for kind in [EditKind::Set, EditKind::Move] {
            let mut values = self.values.clone();
            if !self.edit(&mut values, kind, to) {
                count.refused += 1;
                wrong.push(format!("{name}, {kind:?}: refused"));
                continue;
            }
            count.reached += 1;
            let off = apart(&self.points(&values), &self.points(&end));
            if off > SAME {
                wrong.push(format!("{name}, {kind:?}: {off} away from the path's end"));
                continue;
            }
            let back = self.edit(&mut values, kind, from);
            let off = apart(&self.points(&values), &self.points(&self.values));
            if !back || off > SAME {
                wrong.push(format!("{name}, {kind:?}: back {off} away from where it began"));
            }
        }
        let mut rules = self.shape.case.constraints.clone();
        let c = self.shape.constraint;
        rules[c] = self.shape.case.with_value(c, to).expect("it has a value");
        let error = largest(&self.shape.case, &rules, &self.points(&end));
        if error > 1e-8 {
            wrong.push(format!("{name}: a constraint is {error} off"));
        }
        (self.values, self.told) = (end, to);
    }
}

fn apart(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let far = |(p, q): (&[f64; 2], &[f64; 2])| (p[0] - q[0]).abs().max((p[1] - q[1]).abs());
    a.iter().zip(b).map(far).fold(0.0, f64::max)
}

#[test]
fn large_changes_of_every_shape_end_where_small_steps_do() {
    let is_long = std::env::var_os("THINGLAB_LONG").is_some();
    let (changes, steps) = if is_long { (200, 1000) } else { (12, 300) };
    let (mut all, mut wrong) = (Count::default(), Vec::new());
    for shape in [slider_crank(), peaucellier(), triangle(), quadrilateral(), arcs()] {
        let [low, high] = shape.between;
        let mut bench = Bench::new(shape);
        let mut count = Count::default();
        for i in 0..changes {
            // an irrational part of the range fills it evenly
            let part = ((f64::from(i) + 0.5) * 0.754_877_666).fract();
            bench.change(low + (high - low) * part, steps, &mut count, &mut wrong);
        }
        assert!(count.reached > 0, "{}: {count:?}", bench.shape.case.name);
        all.reached += count.reached;
        all.refused += count.refused;
        all.unreachable += count.unreachable;
    }
    assert!(wrong.is_empty(), "{all:?}\n{}", wrong.join("\n"));
}

#[test]
fn peaucelliers_linkage_draws_a_straight_line() {
    let (mut bench, mut wrong) = (Bench::new(peaucellier()), Vec::new());
    // |OE| |OA| = 8² - 4² and A's circle through O has the diameter 6: E's line is 48 / 6 from O
    for turn in [1.6, -1.6, 0.0, 1.1] {
        let end = bench.small_steps(turn, 100, &mut wrong).expect("the bars reach");
        let [x, _] = bench.points(&end)[5];
        assert!((x - 8.0).abs() < 1e-9, "at {turn} it stands at {x}");
        (bench.values, bench.told) = (end, turn);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
