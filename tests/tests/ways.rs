//! Sets beside drags: whichever way an edit is made, it comes to the same place.
//!
//! Documents of several kinds, in which least change may have to be measured anew on the way, or an inequality begins
//! or ceases to act: a place or a number is
//! set, and beside that dragged in many frames to the same value; then both go back. Where the drag arrives, the set
//! must arrive in the same state. `THINGLAB_LONG` tries more of them.

use base::Dice;
use base::number::{cos, hypot, sin};
use bench::opened::Opened;
use kernel::{Value, Values};
use plan::{EditKind, Planner, Target};
use std::fmt::Write as _;

/// How far two ends may lie apart, of sizes of about one: where least change is measured anew on the way, the place
/// where that is depends a little on the strides.
const SAME: f64 = 1e-3;
/// The frames of a drag.
const FRAMES: usize = 50;

/// A document, what is edited in it, and what that is to be.
struct Edit {
    text: String,
    path: &'static str,
    to: Vec<f64>,
}

type Point = [f64; 2];

fn on(from: Point, length: f64, angle: f64) -> Point {
    [from[0] + length * cos(angle), from[1] + length * sin(angle)]
}

fn place(text: &mut String, name: &str, at: Point) {
    writeln!(text, "{name}: Point = ({}, {})", at[0], at[1]).expect("a string");
}

fn pin(text: &mut String, name: &str, at: Point) {
    place(text, name, at);
    writeln!(
        text,
        "pin{name}: Pin {{ x = {}  y = {} }}  merge pin{name}.point = {name}",
        at[0], at[1]
    )
    .expect("a string");
}

fn bar(text: &mut String, (p, at): (&str, Point), (q, to): (&str, Point)) {
    let length = hypot(to[0] - at[0], to[1] - at[1]);
    writeln!(
        text,
        "bar{p}{q}: Distance {{ value = {length} }}  merge bar{p}{q}.from = {p}  merge bar{p}{q}.to = {q}"
    )
    .expect("a string");
}

fn rule(text: &mut String, rule: &str) {
    writeln!(text, "constraint {rule}").expect("a string");
}

fn document() -> String {
    "use geometry\n".to_owned()
}

/// A chain from a pin; its end is edited.
fn chain(dice: &mut Dice) -> Edit {
    bars(dice).0
}

/// A chain over a floor.
fn chain_over_floor(dice: &mut Dice) -> Edit {
    let (mut edit, names, floor) = bars(dice);
    names.iter().for_each(|name| rule(&mut edit.text, &format!("{name}.y >= {floor}")));
    edit.to[1] = edit.to[1].max(floor);
    edit
}

/// A chain from a pin, the names of the joints that are free, and a height below all of them.
fn bars(dice: &mut Dice) -> (Edit, &'static [&'static str], f64) {
    const NAMES: [&str; 5] = ["a", "b", "c", "d", "hand"];
    let bars = 2 + (dice.between(0.0, 3.0) as usize).min(2);
    let names = &NAMES[NAMES.len() - 1 - bars..];
    let (mut text, mut at, mut angle) = (document(), [0.0, 0.0], dice.between(-3.0, 3.0));
    pin(&mut text, names[0], at);
    let mut lowest = 0.0_f64;
    for pair in names.windows(2) {
        angle += dice.between(-1.4, 1.4);
        let next = on(at, 1.0, angle);
        place(&mut text, pair[1], next);
        bar(&mut text, (pair[0], at), (pair[1], next));
        at = next;
        lowest = lowest.min(at[1]);
    }
    let floor = lowest - dice.between(0.02, 0.3);
    let to = on([0.0, 0.0], dice.between(0.2, 0.9) * bars as f64, dice.between(-3.2, 3.2));
    (Edit { text, path: "hand", to: to.to_vec() }, &names[1..], floor)
}

/// A four-bar of which a wall stops the joint, its crank held by no angle; the joint's height is wished.
fn four_bar(dice: &mut Dice) -> Edit {
    let mut text = document();
    let (ground, angle) = (dice.between(3.5, 4.5), dice.between(0.3, 2.8));
    let tip = on([0.0, 0.0], 1.5, angle);
    let (rocker, coupler) = (dice.between(2.5, 3.5), dice.between(3.0, 4.0));
    let far = hypot(ground - tip[0], tip[1]);
    let along = ((coupler * coupler - rocker * rocker) / far + far) / 2.0;
    let aside = (coupler * coupler - along * along).max(0.0).sqrt();
    let (x, y) = ((ground - tip[0]) / far, -tip[1] / far);
    let joint = [tip[0] + along * x - aside * y, tip[1] + along * y + aside * x];
    // the tip rides on an arm that may be longer, as far as the wall
    pin(&mut text, "a", [0.0, 0.0]);
    pin(&mut text, "d", [ground, 0.0]);
    place(&mut text, "b", tip);
    place(&mut text, "c", joint);
    bar(&mut text, ("b", tip), ("c", joint));
    bar(&mut text, ("c", joint), ("d", [ground, 0.0]));
    rule(&mut text, &format!("b.x <= {}", tip[0] + dice.between(0.05, 0.6)));
    rule(&mut text, &format!("b.x >= {}", tip[0] - dice.between(0.05, 0.6)));
    rule(&mut text, &format!("b.y >= {}", tip[1] - dice.between(0.05, 0.6)));
    rule(&mut text, &format!("c.y <= {}", joint[1] + dice.between(0.05, 1.0)));
    let to = joint[0] + dice.between(-1.5, 1.5);
    Edit { text, path: "c.x", to: vec![to] }
}

/// A block on a rail and a bar from it to a place that a wall and a floor stop; the block is edited.
fn slider(dice: &mut Dice) -> Edit {
    let mut text = document();
    let (at, angle) = (dice.between(-1.0, 1.0), dice.between(0.4, 2.7));
    let end = on([at, 0.0], 1.5, angle);
    place(&mut text, "block", [at, 0.0]);
    place(&mut text, "end", end);
    rule(&mut text, "block.y = 0");
    bar(&mut text, ("block", [at, 0.0]), ("end", end));
    rule(&mut text, &format!("end.x <= {}", end[0] + dice.between(0.05, 0.8)));
    rule(&mut text, &format!("end.x >= {}", end[0] - dice.between(0.05, 0.8)));
    rule(&mut text, &format!("end.y >= {}", end[1] - dice.between(0.1, 0.6)));
    Edit { text, path: "block.x", to: vec![at + dice.between(-2.0, 2.0)] }
}

/// Numbers in a row, each some way past the one before, and a sum that may not grow too large; one is edited.
fn row(dice: &mut Dice) -> Edit {
    let mut text = document();
    let xs: Vec<f64> = (0..4).map(|i| f64::from(i) + dice.between(-0.2, 0.2)).collect();
    for (i, x) in xs.iter().enumerate() {
        writeln!(text, "n{i}: Real = {x}").expect("a string");
    }
    for i in 1..4 {
        rule(&mut text, &format!("n{i} >= n{} + {}", i - 1, dice.between(0.1, 0.5)));
    }
    let sum: f64 = xs.iter().sum();
    rule(&mut text, &format!("n0 + n1 + n2 + n3 <= {}", sum + dice.between(0.5, 2.0)));
    Edit { text, path: "n1", to: vec![xs[1] + dice.between(-2.0, 2.0)] }
}

/// A point on a circle beside a wall, and another held to it by a bar over a floor; the first is edited.
fn wheel(dice: &mut Dice) -> Edit {
    let mut text = document();
    let angle = dice.between(-3.0, 3.0);
    let rim = on([0.0, 0.0], 1.0, angle);
    let rod = on(rim, dice.between(1.5, 2.5), dice.between(-0.6, 0.6));
    pin(&mut text, "hub", [0.0, 0.0]);
    place(&mut text, "rim", rim);
    place(&mut text, "rod", rod);
    bar(&mut text, ("hub", [0.0, 0.0]), ("rim", rim));
    bar(&mut text, ("rim", rim), ("rod", rod));
    rule(&mut text, &format!("rod.y >= {}", rod[1] - dice.between(0.05, 0.5)));
    rule(&mut text, &format!("rod.y <= {}", rod[1] + dice.between(0.05, 0.5)));
    rule(&mut text, &format!("rod.x <= {}", rod[0] + dice.between(0.05, 0.5)));
    Edit { text, path: "rim.x", to: vec![dice.between(-0.95, 0.95)] }
}

type Make = fn(&mut Dice) -> Edit;

const KINDS: [(&str, Make); 6] = [
    ("chain", chain),
    ("chain over a floor", chain_over_floor),
    ("four-bar", four_bar),
    ("slider", slider),
    ("row", row),
    ("wheel", wheel),
];

/// A document that is open.
struct Stage {
    opened: Opened,
    planner: Planner,
    values: Values,
}

impl Stage {
    fn new(text: &str) -> Self {
        let opened = Opened::new(text).unwrap_or_else(|wrong| panic!("{wrong}\n{text}"));
        let (planner, values, report) = opened.solve();
        assert!(report.unmet.is_empty(), "{:?} do not hold at first\n{text}", report.unmet);
        Self { opened, planner, values }
    }
    fn numbers(&self, path: &str) -> Vec<f64> {
        self.opened.slots(path).iter().map(|&slot| self.values.numbers[slot]).collect()
    }
    /// Sets a thing; returns whether that was made.
    fn set(&mut self, path: &str, to: &[f64]) -> bool {
        let thing = self.opened.thing(path).expect("it is there");
        let to = to.iter().map(|&x| Value::Number(x)).collect();
        let targets = [(Target::Thing(thing), to)];
        let (model, values) = (self.opened.model(), &mut self.values);
        let kind = EditKind::Set;
        let report = self.planner.edit(model, values, kind, &targets, &mut self.opened.host());
        report.refusal.is_none() && report.reached
    }
    /// Drags a thing in many frames; returns whether every wish was reached, and what the independent checker says.
    fn drag(&mut self, path: &str, to: &[f64]) -> (bool, Vec<String>) {
        let (from, before) = (self.numbers(path), self.values.clone());
        let thing = self.opened.thing(path).expect("it is there");
        let (model, host) = (self.opened.model(), &mut self.opened.host());
        let press = self.planner.press(model, &self.values, &[Target::Thing(thing)]);
        let mut press = press.expect("it can be dragged");
        let acting = press.acting(&self.planner);
        let (mut arrives, mut is_in_one_mode) = (true, true);
        for frame in 1..=FRAMES {
            let part = frame as f64 / FRAMES as f64;
            let wish: Vec<f64> = from.iter().zip(to).map(|(a, b)| a + part * (b - a)).collect();
            arrives &= self.planner.drag(model, &mut press, &mut self.values, &wish, host).reached;
            is_in_one_mode &= press.acting(&self.planner) == acting;
        }
        self.planner.release(model, press, &mut self.values, host);
        let mut complaints = self.opened.complaints(&before, &self.values, path, to);
        // where least change is measured anew its end is no longer the least from where the drag began
        complaints.retain(|complaint| !complaint.contains("more than they had to"));
        // where a bound let go, and acted again beyond, sides are those of the way between
        complaints.retain(|complaint| is_in_one_mode || !complaint.contains("another side"));
        (arrives, complaints)
    }
}

fn apart(a: &Values, b: &Values) -> f64 {
    let both = a.numbers.iter().zip(b.numbers.iter());
    both.map(|((_, x), (_, y))| (x - y).abs()).fold(0.0, f64::max)
}

#[derive(Default, Debug)]
struct Count {
    tried: u32,
    arrived: u32,
    /// How many drags ended where the pointer was not reached, and could have come nearer to it.
    short: u32,
}

/// Edits one document both ways, out and back; what differs is told.
fn both_ways(edit: &Edit, count: &mut Count) -> Result<(), String> {
    let Edit { text, path, to } = edit;
    let [mut set, mut dragged] = [Stage::new(text), Stage::new(text)];
    let began = set.numbers(path);
    for (to, way) in [(to, "out"), (&began, "back")] {
        count.tried += 1;
        let (arrives, complaints) = dragged.drag(path, to);
        if !arrives && complaints.iter().all(|c| c.contains("nearer to the pointer")) {
            count.short += u32::from(!complaints.is_empty());
            return Ok(());
        }
        if !complaints.is_empty() {
            return Err(format!("{way} to {to:?}: {complaints:?}"));
        }
        count.arrived += 1;
        if !set.set(path, to) {
            return Err(format!("{way} to {to:?}: dragged, and yet refused"));
        }
        let off = apart(&set.values, &dragged.values);
        if off > SAME {
            return Err(format!("{way} to {to:?}: {off:.1e} off"));
        }
        // what comes next begins in one state
        dragged.values = set.values.clone();
    }
    Ok(())
}

#[test]
fn a_set_comes_to_where_a_drag_to_the_same_value_comes() {
    let seeds = if std::env::var_os("THINGLAB_LONG").is_some() { 400 } else { 12 };
    let mut wrong = Vec::new();
    for (name, make) in KINDS {
        let mut count = Count::default();
        for seed in 0..seeds {
            let edit = make(&mut Dice::new(seed));
            if let Err(told) = both_ways(&edit, &mut count) {
                wrong.push(format!("{name}, seed {seed}, {}: {told}", edit.path));
            }
        }
        // a chain that folds on its floor may stick there
        assert!(25 * count.short <= count.tried, "{name}: too many end short, {count:?}");
        assert!(3 * count.arrived > count.tried, "{name}: too few arrive, {count:?}");
    }
    assert!(wrong.is_empty(), "{} of {seeds} each\n{}", wrong.len(), wrong.join("\n"));
}
