//! Programs drawn and programs solved: what the interpreter draws, step by step, and what the planner opens into
//! expressions on the course that was taken have the same bits, for random programs of every control structure.

use base::Dice;
use bench::opened::Opened;
use eval::{Answer, Context, Evaluator, Known};
use kernel::{Path, Step, ThingId, Value, Values};
use plan::{EditKind, Model, Target};
use std::fmt::Write as _;

/// How many programs are made.
const PROGRAMS: u64 = 40;
/// How many of its numbers are looked at for each.
const LOOKED_AT: usize = 6;

/// What makes a number of turns a length.
const COUNTED: &str = " * 1 mm";

/// What every document here has: a program that is called, and one that calls itself.
const HEAD: &str = "use geometry
unit mm
program Sub(u: Length = 4 mm, v: Length = 7 mm) {
    guide far = Point(u, v).turned(about: Point(0, 0), by: 25 deg)
    row = repeat 3 times with k = u { z = 0.7 * k + far.y next k = k + v }
    out = row.last.z - far.x
}
program Rec(u: Length = 9 mm, depth: Integer in 0..5 = 2) {
    if depth = 0 {
        out = 0.3 * u
    } else {
        inner = Rec(u: 0.6 * u + 1 mm, depth: depth - 1)
        out = inner.out + u
    }
}
";

/// What every program ends with: what is carried changes its kind, steps are erased, sets are mirrored, lists gone
/// through.
const TAIL: &str = "rings = repeat with under = Axis.horizontal(y: 0 mm), r = a + 1 mm {
        ring = Circle.tangent(under, Axis.vertical(x: 0 mm), radius: r)
        guide hole = Circle.concentric(ring, radius: r / 2)
        next under = -ring, r = r / 2
    } until ring.radius < b
    away = Line(Point(0 mm, a), Point(a, b))
    erase away
    mirrored = rings.mirrored(about: Axis.vertical(x: b))
    row = for i in 1..n { at = Point(i * a, b) }
    branch = if n in [2, 3] and a > b { one = Point.middle(row[0].at, row[1].at) } else { two = Line(row.last.at, away.p1) }
";

/// A program in the making.
struct Made {
    dice: Dice,
    text: String,
    steps: u32,
}

impl Made {
    /// Writes a length over names that are known.
    fn length(&mut self, names: &[String], depth: u32) -> String {
        if depth == 0 || self.dice.below(3) == 0 {
            return match self.dice.below(4) {
                0 => format!("{} mm", self.dice.between(-9.0, 20.0)),
                _ => names[self.dice.below(names.len())].clone(),
            };
        }
        let (a, b) = (self.length(names, depth - 1), self.length(names, depth - 1));
        let k = self.dice.between(0.2, 1.9);
        match self.dice.below(7) {
            0 => format!("({a} + {b})"),
            1 => format!("({a} - {b})"),
            2 => format!("{k} * {a}"),
            3 => format!("sqrt({a}^2 + {b}^2)"),
            4 => format!("abs({a})"),
            5 => format!("max({a}, {b})"),
            _ => format!("(if {a} > {b} then {a} else {k} * {b})"),
        }
    }
    fn condition(&mut self, names: &[String]) -> String {
        let (a, b) = (self.length(names, 1), self.length(names, 1));
        match self.dice.below(3) {
            0 => format!("{a} > {b}"),
            1 => format!("{a} <= {b} or {a} > 12 mm"),
            _ => format!("not ({a} < {b}) and {b} < 30 mm"),
        }
    }
    fn name(&mut self) -> String {
        self.steps += 1;
        format!("s{}", self.steps)
    }
    /// Writes some steps; what they make is known from then on.
    fn block(&mut self, names: &mut Vec<String>, depth: u32, steps: u32) {
        for _ in 0..steps {
            self.step(names, depth);
        }
    }
    fn step(&mut self, names: &mut Vec<String>, depth: u32) {
        let (s, e) = (self.name(), self.length(names, 2));
        let mut known = Vec::new();
        match self.dice.below(if depth == 0 { 5 } else { 10 }) {
            0 => {
                let _ = writeln!(self.text, "{s} = {e}");
                known.push(s);
            }
            1 => {
                let f = self.length(names, 2);
                let _ = writeln!(
                    self.text,
                    "guide {s} = Point({e}, {f}).turned(about: Point({f}, 2 mm), by: 40 deg)"
                );
                known.extend([format!("{s}.x"), format!("{s}.y")]);
            }
            2 => {
                let axes = "Axis.horizontal(y: 3 mm), Axis(Point(0, 0), Point(1, 2))";
                let _ =
                    writeln!(self.text, "{s} = Circle.tangent({axes}, radius: abs({e}) + 1 mm)");
                known.extend([format!("{s}.center.x"), format!("{s}.radius")]);
            }
            3 => {
                let f = self.length(names, 1);
                let _ = writeln!(
                    self.text,
                    "{s} = Point.projection(Point({e}, {f}), onto: Axis(Point(1, 0), Point(3, 5)))"
                );
                known.push(format!("{s}.y"));
            }
            4 => {
                let f = self.length(names, 1);
                let _ = writeln!(self.text, "{s} = Sub(u: {e}, v: {f})");
                known.extend([
                    format!("{s}.out"),
                    format!("{s}.row[1].z"),
                    format!("{s}.row.last.z"),
                ]);
            }
            5 => {
                let depth = self.dice.below(4);
                let _ = writeln!(self.text, "{s} = Rec(u: {e}, depth: {depth})");
                known.push(format!("{s}.out"));
            }
            6 => {
                let c = self.condition(names);
                let _ = writeln!(self.text, "if {c} {{");
                self.branch(names, depth, &s);
                let _ = writeln!(self.text, "}} else {{");
                self.branch(names, depth, &s);
                let _ = writeln!(self.text, "}}");
                known.push(s);
            }
            7 => {
                let times = if self.dice.below(2) == 0 { "n".to_string() } else { "3".to_string() };
                self.turns(
                    names,
                    depth,
                    &format!("{s} = repeat {times} times with k{s} = {e}"),
                    &s,
                );
                let _ = writeln!(self.text, "next k{s} = 0.8 * k{s} + 1 mm }}");
                known.extend([format!("{s}.last.v{s}"), format!("{s}[0].v{s}")]);
            }
            8 => {
                self.turns(names, depth, &format!("{s} = repeat with k{s} = abs({e}) + 2 mm"), &s);
                let _ = writeln!(self.text, "next k{s} = 1.6 * k{s} }} until k{s} > 30 mm");
                let each = self.length(names, 1);
                let _ = writeln!(self.text, "f{s} = for q{s} in {s} {{ m = q{s}.v{s} + {each} }}");
                known.extend([
                    format!("{s}.last.v{s}"),
                    format!("f{s}.last.m"),
                    format!("f{s}[0].m"),
                ]);
            }
            _ => {
                self.turns(
                    names,
                    depth,
                    &format!("{s} = while k{s} < 25 mm with k{s} = abs({e}) + 2 mm"),
                    &s,
                );
                let _ = writeln!(self.text, "next k{s} = 1.7 * k{s} }}");
                known.push(format!("{s}.turns{COUNTED}"));
            }
        }
        names.extend(known);
    }
    fn branch(&mut self, names: &[String], depth: u32, result: &str) {
        let mut inner = names.to_vec();
        let n = self.dice.below(3) as u32;
        self.block(&mut inner, depth - 1, n);
        let e = self.length(&inner, 2);
        let _ = writeln!(self.text, "{result} = {e}");
    }
    fn turns(&mut self, names: &[String], depth: u32, head: &str, s: &str) {
        let _ = writeln!(self.text, "{head} {{");
        let mut inner = names.to_vec();
        inner.push(format!("k{s}"));
        let n = self.dice.below(3) as u32;
        self.block(&mut inner, depth - 1, n);
        let e = self.length(&inner, 2);
        let _ = writeln!(self.text, "v{s} = {e}");
    }
}

/// Returns a document with a program and numbers that follow some of what it draws, and the paths of these.
fn document(seed: u64) -> (String, Vec<String>) {
    let mut made = Made { dice: Dice::new(seed), text: HEAD.to_string(), steps: 0 };
    let _ = writeln!(
        made.text,
        "program Any(a: Length = 13 mm, b: Length = 5 mm, n: Integer in 1..6 = 3) {{"
    );
    let mut names = vec!["a".to_string(), "b".to_string()];
    let steps = 3 + made.dice.below(4) as u32;
    made.block(&mut names, 2, steps);
    made.text += TAIL;
    let (a, b) = (made.dice.between(1.0, 25.0), made.dice.between(1.0, 25.0));
    let n = 1 + made.dice.below(4);
    let _ = writeln!(made.text, "}}\np: Any {{ a = {a} mm  b = {b} mm  n = {n} }}");
    // what it drew last is made of what it drew before
    let drawn: Vec<String> = names.split_off(2).into_iter().rev().take(LOOKED_AT).collect();
    for (i, name) in drawn.iter().enumerate() {
        let _ = writeln!(made.text, "q{i}: Length = p.{name}");
    }
    (made.text, drawn)
}

/// Returns the path of a step: `s3[0].v`, `s3.last.v`.
fn path(name: &str) -> Path {
    let name = name.trim_end_matches(COUNTED);
    let mut steps = vec![Step::Part("p".into())];
    for part in name.split('.') {
        match part.split_once('[') {
            Some((part, index)) => {
                steps.push(Step::Part(part.into()));
                let index = index.trim_end_matches(']').parse().expect("a number");
                steps.push(Step::Index(index));
            }
            None => steps.push(Step::Part(part.into())),
        }
    }
    Path(steps)
}

/// Returns how long a millimetre is in what a document stores.
fn millimetre(model: Model<'_>) -> f64 {
    let document = model.document;
    0.001 * document.units_per_metre * document.scale.factor(expr::Dimension::LENGTH)
}

/// Compares what was solved with what is drawn; returns how many numbers were.
fn compare(
    opened: &Opened,
    model: Model<'_>,
    values: &Values,
    names: &[String],
    text: &str,
) -> usize {
    let evaluator = Evaluator::new(model.document, model.structure, values);
    let mut compared = 0;
    for (i, name) in names.iter().enumerate() {
        let drawn = match evaluator.at(&path(name)) {
            Ok(Answer::Number(x, _)) => x,
            other => panic!("{name}: {other:?}\n{text}"),
        };
        let slot = opened.slots(&format!("q{i}"))[0];
        let solved = values.numbers[slot];
        let drawn = if name.ends_with(COUNTED) { drawn * millimetre(model) } else { drawn };
        assert_eq!(solved.to_bits(), (drawn + 0.0).to_bits(), "{name}: {solved} {drawn}\n{text}");
        compared += 1;
    }
    compared
}

#[test]
fn what_is_drawn_and_what_is_solved_have_the_same_bits() {
    let (mut compared, mut moved) = (0, 0);
    for seed in 1..=PROGRAMS {
        let (text, names) = document(seed);
        let opened = Opened::new(&text).unwrap_or_else(|why| panic!("{why}\n{text}"));
        let (mut planner, mut values, report) = opened.solve();
        assert!(report.unmet.is_empty() && report.not_decided.is_none(), "{report:?}\n{text}");
        compared += compare(&opened, opened.model(), &values, &names, &text);
        // other parameters take other branches, and as many turns as these ask for
        let mut dice = Dice::new(1000 + seed);
        for _ in 0..3 {
            let parameter = ["p.a", "p.b"][dice.below(2)];
            let thing = opened.thing(parameter).expect("it has one");
            let to = dice.between(1.0, 30.0) * millimetre(opened.model());
            let targets = [(Target::Thing(thing), vec![Value::Number(to)])];
            let host = &mut opened.host();
            let report = planner.edit(opened.model(), &mut values, EditKind::Set, &targets, host);
            if report.refusal.is_none() {
                moved += 1;
                compared += compare(&opened, opened.model(), &values, &names, &text);
            }
        }
    }
    assert!(
        compared > 3 * PROGRAMS as usize * LOOKED_AT && moved > 2 * PROGRAMS,
        "{compared} {moved}"
    );
}

/// Returns true if two answers are the same, every number to the bit.
fn same(a: &Answer<'_>, b: &Answer<'_>) -> bool {
    let all = |a: &[Answer<'_>], b: &[Answer<'_>]| {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
    };
    match (a, b) {
        (Answer::Number(x, dx), Answer::Number(y, dy)) => x.to_bits() == y.to_bits() && dx == dy,
        (Answer::Bool(x), Answer::Bool(y)) => x == y,
        (Answer::Option(x, i), Answer::Option(y, j)) => x == y && i == j,
        (Answer::Text(x), Answer::Text(y)) => x == y,
        (Answer::Thing(x), Answer::Thing(y)) => x == y,
        (Answer::Made(x), Answer::Made(y)) => x.class == y.class && all(&x.fields, &y.fields),
        (Answer::List(x), Answer::List(y)) => all(x, y),
        (Answer::Picture(x), Answer::Picture(y)) => x == y,
        (Answer::Context(x), Answer::Context(y)) => same_run(x, y),
        _ => false,
    }
}

pub(crate) fn same_run(a: &Context<'_>, b: &Context<'_>) -> bool {
    let of = match (&a.of, &b.of) {
        (Some(a), Some(b)) => same(a, b),
        (None, None) => true,
        _ => false,
    };
    let entries = || {
        a.made.iter().zip(&b.made).all(|(a, b)| {
            a.name == b.name && a.standing == b.standing && same(&a.answer, &b.answer)
        })
    };
    of && a.class == b.class && a.ended == b.ended && a.made.len() == b.made.len() && entries()
}

#[test]
fn what_was_drawn_is_drawn_again_as_the_interpreter_draws_it() {
    /// So many times values change by little, and then by much.
    const TIMES: usize = 12;
    let (mut asked, mut replayed) = (0, 0);
    for seed in 1..=PROGRAMS {
        let (text, _) = document(seed);
        let opened = Opened::new(&text).unwrap_or_else(|why| panic!("{why}\n{text}"));
        let model = opened.model();
        let drawn: ThingId = opened.thing("p").expect("it has a program");
        let (known, mut values, mut dice) =
            (Known::default(), opened.given().clone(), Dice::new(seed));
        for time in 0..TIMES {
            let reference = Evaluator::new(model.document, model.structure, &values);
            let again = Evaluator::knowing(model.document, model.structure, &values, &known);
            let [a, b] =
                [&reference, &again].map(|e| e.run(drawn).expect("a run").expect("a program"));
            assert!(same_run(&a, &b), "{time}: {a:?}\n{b:?}\n{text}");
            let [a, b] = [reference, again].map(|e| e.picture(drawn).drawing.elements);
            assert_eq!(a, b, "{time}\n{text}");
            let slot = opened.slots(["p.a", "p.b"][dice.below(2)])[0];
            let x = if time % 4 == 3 {
                dice.between(1.0, 30.0) * millimetre(model)
            } else {
                values.numbers[slot] * dice.between(0.99, 1.01)
            };
            values.put(slot, Value::Number(x));
        }
        let (all, again) = known.replays();
        asked += all;
        replayed += again;
    }
    assert!(2 * replayed > asked, "{replayed} of {asked}");
}

/// Runs what `p` is drawn by a dozen times, some of its numbers a hundredth larger each time: what was noted gives the
/// same run and the same picture as the interpreter, and is run again most times. Gives how many elements it has at the least.
fn drawn_again(text: &str, program: &str, parts: &[&str]) -> usize {
    let opened = Opened::new(text).unwrap_or_else(|why| panic!("{why}"));
    let model = opened.model();
    let drawn: ThingId = opened.thing("p").expect("it has a program");
    let class = model.document.class_named(program).expect("the program");
    let (known, mut values) = (Known::default(), opened.given().clone());
    let mut least = usize::MAX;
    for time in 0..12 {
        let reference = Evaluator::new(model.document, model.structure, &values);
        let again = Evaluator::knowing(model.document, model.structure, &values, &known);
        let [a, b] = [&reference, &again].map(|e| e.run(drawn).expect("a run").expect("a program"));
        assert!(same_run(&a, &b), "{time}: {a:?}\n{b:?}");
        let [a, b] = [&reference, &again].map(|e| e.picture(drawn).drawing.elements);
        assert_eq!(a, b, "{time}");
        assert_eq!(again.why_interpreted(class), None);
        least = least.min(a.len());
        for part in parts {
            let slot = opened.slots(part)[0];
            values.put(slot, Value::Number(values.numbers[slot] * 1.01));
        }
    }
    let (asked, replayed) = known.replays();
    assert!(2 * replayed > asked, "{replayed} of {asked}");
    least
}

#[test]
fn curves_by_places_and_poles_are_drawn_and_measured_again_as_the_interpreter_does() {
    let text = "use drafting\nprogram Blade(w: Length = 90, h: Length = 50) {\n    \
                edge = Spline([Point(0, 0), Point(w / 2, h), Point(w, 0)])\n    \
                tip = Nurbs([Point(w, 0), Point(w + h, 0), Point(w + h, h)], weights: [1, 1 + h / w, 1])\n    \
                foot = edge.nearest(to: Point(w / 3, h / 4))\n    \
                hole = Circle(center: Point(w / 2, h / 3), radius: edge.clearance(to: Point(w / 2, h / 3)) / 2)\n    \
                area => picture(edge, Line(Point(0, 0), Point(w, 0))).area\n    \
                long => edge.length + tip.length\n}\np: Blade\n";
    drawn_again(text, "Blade", &["p.w", "p.h"]);
}
#[test]
fn contours_of_curves_are_drawn_again_as_the_interpreter_does() {
    let text = "use contours\nuse drafting\nprogram Cam(w: Length = 90, h: Length = 50, n: Integer = 4) {\n    \
                turns = repeat n times with x = 0 mm {\n        \
                top = EllipticArc(center: Point(x, 0), end: Point(x + w / 2, 0), across: h, from: 0 deg, sweep: 180 deg)\n        \
                side = Arc(Point(x, 0), Point(x - w / 2, 0), Point(x, -w / 2))\n        \
                foot = Spline([Point(x + w / 2, 0), Point(x + w / 3, -h), Point(x, -w / 2)])\n        \
                cam = Contour.along(edges: [foot, top, side])\n        \
                eye = Contour.along(edges: [Ellipse(center: Point(x, 0), end: Point(x + h / 9, 0), across: h / 7)])\n        \
                plate = Surface(cam, [eye])\n        \
                next x = x + 2 * w\n    }\n    \
                area => turns[0].plate.area\n}\np: Cam\n";
    assert!(drawn_again(text, "Cam", &["p.w", "p.h"]) > 8);
}
#[test]
fn what_lines_surround_is_filled_anew_and_the_reason_is_told() {
    let text = "use geometry\nclass Panel {\n    a, b, c: Point\n    picture => picture(segment(a, b), segment(b, c), \
                segment(c, a)).filled(\"silver\")\n}\nprogram Sheet(long: Length = 3) {\n    \
                face = Panel(Point(0, 0), Point(long, 0), Point(0, 4))\n}\np: Sheet\n";
    let opened = Opened::new(text).unwrap_or_else(|why| panic!("{why}"));
    let model = opened.model();
    let drawn: ThingId = opened.thing("p").expect("it has a program");
    let class = model.document.class_named("Sheet").expect("the program");
    let (known, mut values) = (Known::default(), opened.given().clone());
    for time in 0..4 {
        let reference = Evaluator::new(model.document, model.structure, &values);
        let again = Evaluator::knowing(model.document, model.structure, &values, &known);
        let [a, b] = [&reference, &again].map(|e| e.picture(drawn).drawing.elements);
        assert_eq!(a, b, "{time}");
        assert_eq!(a.iter().filter(|e| e.style.fill.is_some()).count(), 1);
        if time == 3 {
            let why = again.why_interpreted(class);
            assert_eq!(why.as_deref(), Some("what lines surround is not noted"));
        }
        let slot = opened.slots("p.long")[0];
        values.put(slot, Value::Number(values.numbers[slot] * 1.01));
    }
}
