//! Large changes of mechanisms of several kinds, beside a reference path of small steps.
//!
//! A mechanism stands somewhere and its input, the angle of a crank or the width of a scissor, is set
//! in one edit to a far value, is dragged there in one step, and is set back. Wherever small steps
//! arrive without passing where two branches meet, each must end where these do, and back is where it
//! began. `THINGLAB_LONG` tries more of them, in smaller steps.

use base::Dice;
use base::number::{cos, hypot, sin};
use bench::case::{Case, Constraint};
use bench::document;
use bench::opened::Opened;
use kernel::{Value, Values};
use plan::{EditKind, Planner, Target};

/// How far two ends may lie apart, of mechanisms of a size of about ten.
const SAME: f64 = 1e-6;
/// A small step that moves a point so many times as far as the last is near where two branches meet.
const JUMP: f64 = 3.0;

type Point = [f64; 2];

fn polar(from: Point, length: f64, angle: f64) -> Point {
    [from[0] + length * cos(angle), from[1] + length * sin(angle)]
}

fn apart(p: Point, q: Point) -> f64 {
    hypot(p[0] - q[0], p[1] - q[1])
}

/// Where two circles meet, to the left of the way from one centre to the other.
fn meet(p: Point, r: f64, q: Point, s: f64) -> Option<Point> {
    let d = apart(p, q);
    let along = (r * r - s * s + d * d) / (2.0 * d);
    let aside = (r * r - along * along > 0.05).then(|| (r * r - along * along).sqrt())?;
    let (x, y) = ((q[0] - p[0]) / d, (q[1] - p[1]) / d);
    Some([p[0] + along * x - aside * y, p[1] + along * y + aside * x])
}

/// A mechanism as it is put together.
#[derive(Default)]
struct Mechanism {
    points: Vec<Point>,
    lines: Vec<[usize; 2]>,
    constraints: Vec<Constraint>,
}

impl Mechanism {
    fn point(&mut self, at: Point) -> usize {
        self.points.push(at);
        self.points.len() - 1
    }
    fn pin(&mut self, at: Point) -> usize {
        let p = self.point(at);
        self.constraints.push(Constraint::Fix { p, x: at[0], y: at[1] });
        p
    }
    fn bar(&mut self, p: usize, q: usize) -> usize {
        let v = apart(self.points[p], self.points[q]);
        self.constraints.push(Constraint::Distance { p, q, v });
        self.constraints.len() - 1
    }
    fn bars(&mut self, pairs: &[[usize; 2]]) {
        for &[p, q] in pairs {
            self.bar(p, q);
        }
    }
    fn line(&mut self, p: usize, q: usize) -> usize {
        self.lines.push([p, q]);
        self.lines.len() - 1
    }
    fn level(&mut self, p: usize, q: usize) {
        let l = self.line(p, q);
        self.constraints.push(Constraint::Horizontal { l });
    }
    fn plumb(&mut self, p: usize, q: usize) {
        let l = self.line(p, q);
        self.constraints.push(Constraint::Vertical { l });
    }
    /// A crank of a length on a pin at an angle: pin, tip and the constraint of the angle.
    fn crank(&mut self, at: Point, length: f64, angle: f64) -> (usize, usize, usize) {
        let pin = self.pin(at);
        let east = self.pin([at[0] + 20.0, at[1]]);
        let tip = self.point(polar(at, length, angle));
        self.bar(pin, tip);
        let (l, m) = (self.line(pin, east), self.line(pin, tip));
        self.constraints.push(Constraint::Angle { l, m, v: angle });
        (pin, tip, self.constraints.len() - 1)
    }
    /// A point that two bars hold, on the left of the way from `p` to `q`.
    fn elbow(&mut self, p: usize, r: f64, q: usize, s: f64) -> Option<usize> {
        let joint = meet(self.points[p], r, self.points[q], s)?;
        let joint = self.point(joint);
        self.bars(&[[p, joint], [joint, q]]);
        Some(joint)
    }
}

/// A mechanism, the constraint of its input, what that is, and what it is set to.
type Made = (Mechanism, usize, f64, f64);

/// Puts one together, where lengths that are thrown let it.
type Make = fn(&mut Dice) -> Option<Made>;

const KINDS: [(&str, Make); 7] = [
    ("slider-crank", slider_crank),
    ("scotch yoke", scotch_yoke),
    ("pantograph", pantograph),
    ("Peaucellier", peaucellier),
    ("scissors", scissors),
    ("Watt", watt),
    ("Stephenson", stephenson),
];

fn angles(dice: &mut Dice) -> (f64, f64) {
    (dice.between(-3.1, 3.1), dice.between(-3.1, 3.1))
}

fn slider_crank(dice: &mut Dice) -> Option<Made> {
    let mut m = Mechanism::default();
    let (from, to) = angles(dice);
    let (r, rod, high) = (dice.between(1.0, 5.0), dice.between(3.0, 9.0), dice.between(-3.0, 3.0));
    let (_, tip, input) = m.crank([0.0, 0.0], r, from);
    let up = high - m.points[tip][1];
    let along = (rod * rod - up * up > 0.05).then(|| (rod * rod - up * up).sqrt())?;
    let rail = m.pin([-30.0, high]);
    let slider = m.point([m.points[tip][0] + along, high]);
    m.level(rail, slider);
    m.bar(tip, slider);
    Some((m, input, from, to))
}

fn scotch_yoke(dice: &mut Dice) -> Option<Made> {
    let mut m = Mechanism::default();
    let (from, to) = angles(dice);
    let (pin, tip, input) = m.crank([0.0, 0.0], dice.between(1.0, 5.0), from);
    let foot = m.point([m.points[tip][0], 0.0]);
    m.level(pin, foot);
    m.plumb(tip, foot);
    Some((m, input, from, to))
}

/// A parallelogram of bars with a triangle on each of two sides; it never lies flat, where it could fold.
fn pantograph(dice: &mut Dice) -> Option<Made> {
    let mut m = Mechanism::default();
    let turn = dice.between(-1.5, 1.5);
    let (from, to) = (turn - dice.between(0.1, 3.0), turn - dice.between(0.1, 3.0));
    let (a, b) = (dice.between(2.0, 6.0), dice.between(2.0, 6.0));
    let (pin, tip, input) = m.crank([0.0, 0.0], a, from);
    let (l, other) = (m.lines.len() - 2, m.point(polar([0.0, 0.0], b, turn)));
    m.bar(pin, other);
    let arm = m.line(pin, other);
    m.constraints.push(Constraint::Angle { l, m: arm, v: turn });
    let corner =
        m.point([m.points[tip][0] + m.points[other][0], m.points[tip][1] + m.points[other][1]]);
    m.bars(&[[tip, corner], [other, corner]]);
    m.elbow(tip, dice.between(2.0, 6.0), corner, dice.between(2.0, 6.0))?;
    m.elbow(corner, dice.between(2.0, 6.0), other, dice.between(2.0, 6.0))?;
    Some((m, input, from, to))
}

fn peaucellier(dice: &mut Dice) -> Option<Made> {
    let mut m = Mechanism::default();
    let (from, to) = (dice.between(-1.5, 1.5), dice.between(-1.5, 1.5));
    let (r, long, side) = (dice.between(2.0, 3.0), dice.between(8.0, 10.0), dice.between(3.0, 4.5));
    let (_, tip, input) = m.crank([r, 0.0], r, from);
    let pole = m.pin([0.0, 0.0]);
    let up = m.elbow(pole, long, tip, side)?;
    let down = m.elbow(tip, side, pole, long)?;
    let out = [0, 1].map(|k| m.points[up][k] + m.points[down][k] - m.points[tip][k]);
    let out = m.point(out);
    m.bars(&[[up, out], [down, out]]);
    Some((m, input, from, to))
}

fn scissors(dice: &mut Dice) -> Option<Made> {
    let mut m = Mechanism::default();
    let (stages, half) = (2 + dice.below(6), dice.between(2.0, 4.0));
    let (from, to) = (dice.between(0.3, 1.8) * half, dice.between(0.3, 1.8) * half);
    let high = (4.0 * half * half - from * from).sqrt();
    let left = m.pin([0.0, 0.0]);
    let right = m.point([from, 0.0]);
    m.level(left, right);
    let input = m.bar(left, right);
    let (mut left, mut right) = (left, right);
    for stage in 0..stages {
        let y = high * stage as f64;
        let middle = m.point([from / 2.0, y + high / 2.0]);
        let (up_left, up_right) = (m.point([0.0, y + high]), m.point([from, y + high]));
        m.bars(&[[left, middle], [right, middle], [middle, up_left], [middle, up_right]]);
        for [p, q] in [[left, up_right], [right, up_left]] {
            let (l, on) = (m.line(p, middle), m.line(middle, q));
            m.constraints.push(Constraint::Angle { l, m: on, v: 0.0 });
        }
        (left, right) = (up_left, up_right);
    }
    Some((m, input, from, to))
}

/// A four-bar: its crank's tip, its joint, its rocker's pin, and its input.
fn four_bar(m: &mut Mechanism, from: f64, dice: &mut Dice) -> Option<[usize; 4]> {
    let (_, tip, input) = m.crank([0.0, 0.0], dice.between(1.5, 5.0), from);
    let foot = m.pin([dice.between(4.0, 9.0), dice.between(-2.0, 2.0)]);
    let joint = m.elbow(tip, dice.between(4.0, 9.0), foot, dice.between(4.0, 9.0))?;
    Some([tip, joint, foot, input])
}

/// A dyad on the rocker of a four-bar.
fn watt(dice: &mut Dice) -> Option<Made> {
    let mut m = Mechanism::default();
    let (from, to) = angles(dice);
    let [_, joint, foot, input] = four_bar(&mut m, from, dice)?;
    let arm = m.elbow(joint, dice.between(2.0, 6.0), foot, dice.between(2.0, 6.0))?;
    let pin = m.pin([dice.between(10.0, 15.0), dice.between(-4.0, 4.0)]);
    m.elbow(arm, dice.between(4.0, 9.0), pin, dice.between(4.0, 9.0))?;
    Some((m, input, from, to))
}

/// A dyad on the coupler of a four-bar.
fn stephenson(dice: &mut Dice) -> Option<Made> {
    let mut m = Mechanism::default();
    let (from, to) = angles(dice);
    let [tip, joint, _, input] = four_bar(&mut m, from, dice)?;
    let arm = m.elbow(tip, dice.between(2.0, 6.0), joint, dice.between(2.0, 6.0))?;
    let pin = m.pin([dice.between(6.0, 12.0), dice.between(4.0, 9.0)]);
    m.elbow(arm, dice.between(4.0, 9.0), pin, dice.between(4.0, 9.0))?;
    Some((m, input, from, to))
}

/// A mechanism in its planner.
struct Standing {
    opened: Opened,
    planner: Planner,
    values: Values,
    input: String,
    points: usize,
}

impl Standing {
    fn new(m: &Mechanism, input: usize) -> Self {
        let case = Case {
            format: "gcs-case/1".into(),
            name: "mechanism".into(),
            well_constrained: true,
            truth: m.points.clone(),
            start: m.points.clone(),
            lines: m.lines.clone(),
            arcs: Vec::new(),
            constraints: m.constraints.clone(),
            drag: None,
        };
        let opened = Opened::new(&document::text(&case)).expect("a mechanism can be said");
        let (planner, values, report) = opened.solve();
        assert!(report.unmet.is_empty(), "it stands where it was put");
        let (input, points) = (format!("c{input}.value"), m.points.len());
        Self { opened, planner, values, input, points }
    }
    fn edit(&mut self, kind: EditKind, to: f64) -> bool {
        let thing = self.opened.thing(&self.input).expect("the input has a value");
        let targets = [(Target::Thing(thing), vec![Value::Number(to)])];
        let (model, values) = (self.opened.model(), &mut self.values);
        let report = self.planner.edit(model, values, kind, &targets, &mut self.opened.host());
        report.refusal.is_none() && report.reached
    }
    fn points(&self) -> Vec<Point> {
        let at = |p: usize| {
            let slots = self.opened.slots(&format!("p{p}"));
            [self.values.numbers[slots[0]], self.values.numbers[slots[1]]]
        };
        (0..self.points).map(at).collect()
    }
}

fn furthest(a: &[Point], b: &[Point]) -> f64 {
    a.iter().zip(b).map(|(&p, &q)| apart(p, q)).fold(0.0, f64::max)
}

/// Where small steps lead; nothing where they do not arrive, or pass near where two branches meet.
fn reference(m: &Mechanism, input: usize, from: f64, to: f64, steps: usize) -> Option<Vec<Point>> {
    let mut standing = Standing::new(m, input);
    let (mut now, mut stride) = (standing.points(), f64::INFINITY);
    for step in 1..=steps {
        let part = step as f64 / steps as f64;
        if !standing.edit(EditKind::Set, from + (to - from) * part) {
            return None;
        }
        let next = standing.points();
        let moved = furthest(&now, &next);
        if moved > JUMP * stride.max((to - from).abs() / steps as f64) {
            return None;
        }
        (now, stride) = (next, moved);
    }
    Some(now)
}

#[test]
fn large_changes_of_mechanisms_end_where_small_steps_do_and_come_back() {
    let is_long = std::env::var_os("THINGLAB_LONG").is_some();
    let (seeds, steps) = if is_long { (300, 1000) } else { (8, 200) };
    let (mut wrong, mut reached, mut missed) = (Vec::new(), 0_u32, 0_u32);
    for (kind, make) in KINDS {
        for seed in 0..seeds {
            let Some((m, input, from, to)) = make(&mut Dice::new(seed)) else { continue };
            let Some(end) = reference(&m, input, from, to, steps) else { continue };
            for edit in [EditKind::Set, EditKind::Move] {
                let told = format!("{kind} {seed} from {from:.3} to {to:.3}, {edit:?}");
                let mut standing = Standing::new(&m, input);
                let began = standing.points();
                if !standing.edit(edit, to) {
                    missed += 1;
                    wrong.push(format!("{told}: not reached"));
                    continue;
                }
                reached += 1;
                let off = furthest(&standing.points(), &end);
                if off > SAME {
                    wrong.push(format!("{told}: {off:.1e} off"));
                } else if !standing.edit(edit, from) || furthest(&standing.points(), &began) > SAME
                {
                    wrong.push(format!("{told}: back somewhere else"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{reached} reached, {missed} not\n{}", wrong.join("\n"));
    assert!(reached > 7 * 4, "there was something to try: {reached}");
}
