//! Explanations: a plan and its reasons, as a page of a textbook has them.

use crate::desk::{Desk, at, gallery};
use session::view::Explanation;
use session::{Command, Path};
use std::fmt::Write as _;

fn page(explanation: &Explanation) -> String {
    let mut page = format!("{}\n", explanation.summary);
    for step in &explanation.steps {
        let _ = writeln!(page, "{}: {}; {}", step.targets.join(", "), step.method, step.reason);
        let _ = writeln!(page, "  {}", step.formula);
        let _ = writeln!(page, "  {}", step.values.join(", "));
    }
    page
}

#[test]
fn setting_celsius() {
    let mut desk = Desk::of(&gallery("temperature"));
    desk.set("celsius.node.number", 100.0).expect("it is free");
    let wanted = "\
set celsius.node.number: 6 steps, one after the other.
celsius.mercury.p1.y: method 1 of 2; celsius.height must hold, given celsius.node.number = 100, celsius.degree = 0.4 and celsius.mercury.p2.y = 141
  mercury.p1.y := mercury.p2.y - 30 - node.number * degree
  71
celsius.shown: method 1 of 2; celsius.correctText must hold, given celsius.node.number = 100
  shown := node.number.text(digits: 3)
  100
times.result.number: its rule, solved for it; times.times must hold, given celsius.node.number = 100 and factor.node.number = 1.8
  constraint times: result.number = operand1.number * operand2.number
  180
fahrenheit.node.number: method 1 of 3; plus.plus must hold, given offset.node.number = 32 and times.result.number = 180
  result.number := operand1.number + operand2.number
  212
fahrenheit.mercury.p1.y: method 1 of 2; fahrenheit.height must hold, given fahrenheit.node.number = 212, fahrenheit.degree = 0.4 and fahrenheit.mercury.p2.y = 145
  mercury.p1.y := mercury.p2.y - 30 - node.number * degree
  30.2
fahrenheit.shown: method 1 of 2; fahrenheit.correctText must hold, given fahrenheit.node.number = 212
  shown := node.number.text(digits: 3)
  212
";
    assert_eq!(page(&desk.session.explain(desk.id, None)), wanted);
}

#[test]
fn why_fahrenheit_is_what_it_is() {
    let desk = Desk::of(&gallery("temperature"));
    let about = at("fahrenheit.node.number");
    let wanted = "\
fahrenheit.node.number is 162.5, because celsius.node.number = 72.5 is given in the text and factor.node.number = 1.8 and offset.node.number = 32 are anchored.
times.result.number: its rule, solved for it; times.times must hold, given celsius.node.number = 72.5 and factor.node.number = 1.8
  constraint times: result.number = operand1.number * operand2.number
  130.5
fahrenheit.node.number: method 1 of 3; plus.plus must hold, given offset.node.number = 32 and times.result.number = 130.5
  result.number := operand1.number + operand2.number
  162.5
";
    assert_eq!(page(&desk.session.explain(desk.id, Some(&about))), wanted);
}

#[test]
fn why_a_given_number_is_what_it_is() {
    let desk = Desk::of(&gallery("temperature"));
    let why = |path: &str| desk.session.explain(desk.id, Some(&at(path))).summary;
    assert_eq!(why("celsius.node.number"), "celsius.node.number is 72.5: it is given in the text.");
    assert_eq!(why("factor.node.number"), "factor.node.number is 1.8: it is anchored.");
    assert_eq!(why("factor.mode"), "there is no mode in factor; did you mean node?");
}

#[test]
fn a_given_number_among_constraints_is_given() {
    let summary = |desk: &Desk, path: &str| desk.session.explain(desk.id, Some(&at(path))).summary;
    let text = "a: Real = 3\nb: Real = 4\nc: Real = 7\nd: Real\nconstraint one: c = a + b\nconstraint two: d = 2 * c\n";
    let mut desk = Desk::of(text);
    for (path, value) in [("a", 3), ("b", 4), ("c", 7)] {
        assert_eq!(summary(&desk, path), format!("{path} is {value}: it is given in the text."));
    }
    assert_eq!(summary(&desk, "d"), "d is 14, because c = 7 is given in the text.");
    // what an edit computed has that for its reason
    desk.set("c", 9.0).expect("a and b can give way");
    assert_eq!(summary(&desk, "d"), "d is 18, because c = 9 is what the edit wanted.");
    // a rule said twice takes nothing from what is given
    let text = "net: Real = 100\nrate: Real = 1.2\ngross: Real\nconstraint gross = net * rate\nconstraint net = gross / rate\n";
    let desk = Desk::of(text);
    assert_eq!(summary(&desk, "rate"), "rate is 1.2: it is given in the text.");
    let wanted = "gross is 120, because net = 100 and rate = 1.2 are given in the text.";
    assert_eq!(summary(&desk, "gross"), wanted);
    // numbers that gave way are not as they are given
    let desk = Desk::of("a: Real = 13\nb: Real = 4\nconstraint sum: a + b = 100\n");
    assert_eq!(summary(&desk, "a"), "a is 54.5: the least change with which the constraints hold.");
}

#[test]
fn equations_that_are_solved_together() {
    let desk =
        Desk::of("x: Real\ny: Real\nconstraint sum: x + y = 5\nconstraint product: x * y = 6\n");
    let explanation = desk.session.explain(desk.id, None);
    assert_eq!(explanation.about, "opening");
    assert_eq!(explanation.warnings, [""; 0]);
    let block = &explanation.steps[0];
    assert_eq!(block.method, "2 equations, solved together by formula");
    assert_eq!(block.formula, "constraint sum: x + y = 5\nconstraint product: x * y = 6");
    assert_eq!(block.reason, "sum and product must hold");
}

#[test]
fn equations_without_a_formula_are_approached() {
    let desk =
        Desk::of("x: Real\ny: Real\nconstraint sum: x + y = 5\nconstraint cubes: x^3 * y = 24\n");
    let explanation = desk.session.explain(desk.id, None);
    assert_eq!(explanation.warnings.len(), 1);
    let method = &explanation.steps[0].method;
    assert_eq!(method, "2 equations, solved together by Newton's method");
}

#[test]
fn what_does_not_move_names_what_holds_it() {
    let mut desk = Desk::of(
        "a: Real = 3\nb, c: Real\nanchor a\nconstraint next: b = a + 1\nconstraint free: c = c\n",
    );
    let mut held = |path: &str| desk.session.held(desk.id, &at(path)).map(|h| h.message);
    assert_eq!(held("a").as_deref(), Some("a does not move: it is anchored"));
    let next = "b does not move: held by next, and by the anchor of a";
    assert_eq!(held("b").as_deref(), Some(next));
    assert_eq!(held("c"), None);
}

#[test]
fn what_is_constant_is_called_so() {
    let mut desk = Desk::of(
        "constant g: Acceleration = 9.81 m/s^2\nclass Ball { constant mass: Mass = 2 kg }\n\
         b: Ball\nw: Force\nconstraint weight: w = b.mass * g\n",
    );
    let mut held = |path: &str| desk.session.held(desk.id, &at(path)).map(|h| h.message);
    assert_eq!(held("g").as_deref(), Some("g does not move: it is constant"));
    let weight = "w does not move: held by weight, and by the constants g, b.mass";
    assert_eq!(held("w").as_deref(), Some(weight));
    let message = desk.set("w", 5.0).expect_err("nothing may yield").message;
    assert_eq!(message, "refused: weight would not hold while g, b.mass are constant");
    let summary = desk.session.explain(desk.id, Some(&at("w"))).summary;
    assert!(
        summary.ends_with("because g = 9.81 m/s^2 and b.mass = 2 kg are constant."),
        "{summary}"
    );
}

#[test]
fn what_rounding_leaves_of_a_rule_is_shown_as_nothing() {
    // the ball goes on as before, and what is left of the other's velocity is -0.222 fm/s
    let desk = Desk::of(
        "m1: Mass = 2 kg\nm2: Mass = 1 kg\nu1: Velocity = 3 m/s\nu2: Velocity = 0 m/s\n\
         v1, v2: Velocity\nconstraint momentum: m1 * u1 + m2 * u2 = m1 * v1 + m2 * v2\n\
         constraint energy: m1 * u1^2 + m2 * u2^2 = m1 * v1^2 + m2 * v2^2\n",
    );
    let (one, other) = (desk.row("v1"), desk.row("v2"));
    let is_nothing = |row: &session::view::ValueRow| row.text == "0" && row.unit == "m/s";
    let is_four = |row: &session::view::ValueRow| row.text == "4" && row.unit == "m/s";
    assert!(is_nothing(&other) || is_four(&other), "{} {} {}", one.text, other.text, other.unit);
    // what is small and decides is no rounding
    let diode = Desk::of(
        "i: Current = 20 A\nx: Real = 36\nleast: Current\nconstraint i = least * (exp(x) - 1)\n",
    );
    assert_ne!(diode.row("least").text, "0");
}

const FLAT: &str = "use geometry
k: Line { p1 = (0, 60)  p2 = (30, 60) }
constraint flat: k.p1.y = k.p2.y
constraint long: k.length >= 40
anchor k.p1
";

#[test]
fn equalities_are_named_among_what_holds_a_thing() {
    let mut desk = Desk::of(FLAT);
    let mut held = |path: &str| desk.session.held(desk.id, &at(path)).map(|h| h.message);
    let flat = "k.p2.y does not move: held by flat, and by the anchor of k.p1";
    assert_eq!(held("k.p2.y").as_deref(), Some(flat));
    let whole = format!("k.p1 does not move: it is anchored; {flat}; k.p2.x can move");
    assert_eq!(held("k"), Some(whole));
}

#[test]
fn what_follows_from_others_for_the_given_numbers_holds_nothing() {
    // the second says what the first does: with two rules for two unknowns nothing would be left to move
    let text = "net: Real = 100\nrate: Real = 1.2\ngross: Real\n\
        constraint forth: gross = net * rate\nconstraint back: net = gross / rate\n";
    let held = |text: &str| {
        let mut desk = Desk::of(text);
        desk.session.held(desk.id, &at("rate")).map(|h| h.message)
    };
    assert_eq!(held(text), None);
    let anchored = held(&format!("{text}anchor net, gross\n"));
    let message = "rate does not move: held by forth, and by the anchor of net, gross";
    assert_eq!(anchored.as_deref(), Some(message));
}

#[test]
fn virtual_parts_constraints_and_wholes_are_explained() {
    let desk = Desk::of(FLAT);
    let why = |path: &str| desk.session.explain(desk.id, Some(&at(path))).summary;
    // the inequality made it longer than what is given
    let from = "because k.p1.x = 0 and k.p1.y = 60 are anchored";
    assert_eq!(why("k.length"), format!("k.length is 40, {from}."));
    assert_eq!(why("flat"), "flat holds, because k.p1.y = 60 is anchored.");
    assert_eq!(why("k"), format!("k is as it is, {from}."));
    assert_eq!(why("k.breadth"), "there is no breadth in k");
}

const DIVIDER: &str = "use circuits
battery: Battery { anchor emf }
r1: Resistor { resistance = 100 ohm }
r2: Resistor { resistance = 200 ohm }
ground: Ground
merge battery.a.node = r1.a.node
merge r1.b.node = r2.a.node
merge r2.b.node = battery.b.node = ground.lead.node
";

#[test]
fn what_is_solved_together_is_advised_a_second_view_that_was_tried() {
    let mut desk = Desk::of(DIVIDER);
    let advice = desk.session.analysis(desk.id).advice;
    let message = "equations about r1, r2 are solved together; with a SeriesResistors of them, one \
        after the other";
    let members = "seriesResistors: SeriesResistors\nmerge r1 = seriesResistors.first\n\
        merge r2 = seriesResistors.second\n";
    let found: Vec<_> = advice.iter().map(|a| (a.message.as_str(), a.members.as_str())).collect();
    assert_eq!(found, [(message, members)]);
    let before = desk.number("r1.b.node.voltage");
    desk.apply(&Command::Edit { target: Path::default(), members: members.into() }).unwrap();
    assert_eq!((before, desk.number("r1.b.node.voltage")), (1.0, 1.0));
    assert!(desk.session.explain(desk.id, None).summary.contains("one after the other"));
    assert_eq!(desk.session.analysis(desk.id).advice, []);
}

/// A hundred resistors in a row: of what is solved together the first are named, each rule is told once, and
/// no view of two of them is tried.
#[test]
fn of_what_many_equations_say_each_rule_is_told_once() {
    let desk = Desk::of(
        "use circuits\nbattery: Battery\nground: Ground\nrow: List of 100 Resistor\n\
        merge battery.a.node = row[0].a.node\n\
        merge battery.b.node = row[99].b.node = ground.lead.node\n\
        for i in 0..98 { merge row[i].b.node = row[i + 1].a.node }\n",
    );
    let told = desk.session.explain(desk.id, None);
    let together = told.steps.iter().find(|s| s.method.contains("solved together")).unwrap();
    assert_eq!(together.targets.len(), 99 + 100 + 99);
    let mut rules: Vec<&str> = together.formula.lines().collect();
    rules.sort_unstable();
    assert_eq!(rules.len(), 3, "{rules:?}");
    let said = "Node.kirchhoff (99 times), Resistor.through (99 times) and Resistor.ohm (100 times) must hold";
    assert!(together.reason.starts_with(said), "{}", together.reason);
    let given = "Resistor.resistance = 100 ohm (100 times)";
    assert!(together.reason.ends_with(given), "{}", together.reason);
    assert_eq!(desk.session.advice(desk.id), []);
}

#[test]
fn what_is_approached_step_by_step_is_warned_of_and_a_lighter_view_named() {
    // linear equations have one answer, and it is found
    let desk = Desk::of(DIVIDER);
    assert_eq!(desk.session.explain(desk.id, None).warnings, [""; 0]);
    assert_eq!(desk.session.advice(desk.id).len(), 1);
    let desk =
        Desk::of("total: Real = 900\nanchor total\na, b, c: Real\nconstraint a + b + c = total\n");
    let told = desk.session.explain(desk.id, None);
    assert_eq!(told.steps[0].method, "least change of 3 numbers");
    assert_eq!(told.warnings, [""; 0]);
    let desk = Desk::of(
        "use geometry\nfoot: Point = (0, 0)\nanchor foot\nknee: Point = (10, 0)\ntip: Point = (20, 0)\n\
        far: Point = (20, 10)\nanchor far\nconstraint foot.distance(to: knee) = 11\n\
        constraint knee.distance(to: tip) = 9\nconstraint tip.distance(to: far) = 8\n",
    );
    let warnings = desk.session.explain(desk.id, None).warnings;
    assert_eq!(
        warnings,
        ["knee, tip are approached step by step: from far away that may not converge"]
    );
    let of_knee = desk.session.explain(desk.id, Some(&at("knee")));
    assert_eq!(of_knee.warnings, warnings);
    assert_eq!(desk.session.explain(desk.id, Some(&at("foot"))).warnings, [""; 0]);
}

#[test]
fn how_a_place_moves_is_told_though_a_force_moves_a_million_times_as_fast() {
    let mut desk = Desk::of(
        "use geometry\np: Point = (1, 0)\nforce: Force\nconstraint force = 1e6 N/m * p.x\nanchor p.y\n",
    );
    let motions = desk.session.analysis(desk.id).motions;
    let summaries: Vec<&str> = motions.iter().map(|m| m.summary.as_str()).collect();
    assert_eq!(summaries, ["together: p along x, force"]);
}

#[test]
fn motions_where_branches_meet_are_told_though_none_of_a_first_basis_goes_on() {
    // a parallelogram that is a trapezium with equal legs as well: three motions are possible to first order, and of
    // those of one place alone none goes on
    let mut desk = Desk::of(
        "use geometry\na: Point = (0, 0)\nb: Point = (60, 0)\nc: Point = (60, 25)\nd: Point = (0, 25)\n\
         ab: Line { p1 = a  p2 = b }\nbc: Line { p1 = b  p2 = c }\ncd: Line { p1 = c  p2 = d }\n\
         da: Line { p1 = d  p2 = a }\nconstraint da.parallel(to: bc)\nconstraint ab.length = cd.length\n\
         anchor a\nanchor b\n",
    );
    let analysis = desk.session.analysis(desk.id);
    let summaries: Vec<&str> = analysis.motions.iter().map(|m| m.summary.as_str()).collect();
    assert_eq!(analysis.freedom, 2);
    assert_eq!(summaries, ["c, d slide together along x", "c, d slide together along y"]);
}

#[test]
fn a_condition_is_among_the_reasons() {
    let text = "b: Real = 4
mode: Text = \"on\"
f: Real
g: Real
constraint k: if b > 3 { f = 1 } else { f = 2 }
constraint l: if mode = \"on\" { g = b } else { g = 0 }
";
    let mut desk = Desk::of(text);
    let wanted = "\
f is 1, because b = 4 is given in the text.
f: equal to a number; k must hold, given b = 4
  constraint k: if b > 3
  1
";
    assert_eq!(page(&desk.session.explain(desk.id, Some(&at("f")))), wanted);
    let wanted = "\
g is 4, because b = 4 and mode = on are given in the text.
g: equal to another part; l must hold, given b = 4 and mode = on
  constraint l: if mode = \"on\"
  4
";
    assert_eq!(page(&desk.session.explain(desk.id, Some(&at("g")))), wanted);
    desk.set("b", 2.0).expect("it is free");
    let steps = desk.session.explain(desk.id, None).steps;
    assert!(steps.iter().any(|s| s.targets == ["f"] && s.values == ["2"]), "{steps:?}");
}

#[test]
fn what_would_go_beyond_a_bound_is_named() {
    let text = "x: Real
y: Real
constraint lim: 0 <= x <= 10
constraint d: y = 2 * x
weak constraint wy: y = 30
medium constraint my: y = 25
";
    let desk = Desk::of(text);
    let steps = desk.session.explain(desk.id, Some(&at("x"))).steps;
    let reasons: Vec<&str> = steps.iter().map(|s| s.reason.as_str()).collect();
    assert_eq!(reasons, ["lim must hold; my would go beyond"]);
}

#[test]
fn a_repair_is_a_command_that_mends_the_contradiction() {
    let mut desk = Desk::of("a: Real = 3\nconstraint one: a = 3\nconstraint two: a = 4\n");
    let found = desk.session.analysis(desk.id).contradictions;
    let choices = found[0].choices.clone();
    assert!(!choices.is_empty(), "{found:?}");
    for choice in choices {
        let mut desk = Desk::of("a: Real = 3\nconstraint one: a = 3\nconstraint two: a = 4\n");
        desk.apply(&choice.command).expect("it can be done");
        assert!(desk.session.status(desk.id).satisfied, "{}", choice.label);
    }
}

#[test]
fn what_a_message_lists_and_what_has_no_value_is_explained() {
    let text = "xs: List of 2 Real = [1, 2]\nys => xs.map(x => 3 * x)\nz => 1 / (xs[0] - 1)\n";
    let desk = Desk::of(text);
    let why = |path: &str| desk.session.explain(desk.id, Some(&at(path))).summary;
    assert_eq!(why("ys[1]"), "ys[1] is 6, because xs[0] = 1 and xs[1] = 2 are given in the text.");
    assert_eq!(
        why("z"),
        "z has no value, 1 divided by zero, because xs[0] = 1 is given in the text."
    );
    assert_eq!(why("q"), "there is no q here");
}

#[test]
fn what_a_loop_says_of_each_is_told_apart() {
    let mut desk = Desk::of(
        "use geometry
lines: List of 2 Line
for i in 0..1 { constraint lines[i].length = 10 }
         constraint lines[0].length = 20
",
    );
    let told = |desk: &mut Desk| desk.session.analysis(desk.id).contradictions[0].message.clone();
    let message = told(&mut desk);
    assert!(message.contains("constraint1 (“length of lines[i] = 10”)"), "{message}");
    assert!(message.contains(", “length of lines[0] = 20” together"), "{message}");
}
