//! Where edits and drags have to stop, in numbers, and what begins to act on the way.

use crate::desk::{Desk, at};
use session::{Command, Literal};

const WALL: &str = "\
class Point { x, y: Length   picture => dot(x, y) }
p: Point = (50, 20)
constraint wall: p.x <= 100
";

/// Ground 12, all bars 10: crank tip and foot are 20 apart where the cosine is (144 + 100 - 400) / 240.
const LINKAGE: &str = "\
use geometry
a: Point = (0, 10)
b: Point = (9.68, 12.04)
o: Point = (0, 0)
c: Point = (12, 0)
ground: Line
arm: Line
merge ground.p1 = arm.p1 = o
merge ground.p2 = c
merge arm.p2 = a
anchor o
anchor c
turn: AngleBetween { value = 90 deg }
merge turn.from = ground
merge turn.to = arm
crank: Distance { value = 10 }
coupler: Distance { value = 10 }
rocker: Distance { value = 10 }
merge crank.from = o
merge crank.to = coupler.from = a
merge coupler.to = rocker.from = b
merge rocker.to = c
";

const ELBOW: &str = "\
use geometry
upper: ConstantLengthLine { p1 = (0, 0)  p2 = (50, 0)  size = 50 }
lower: ConstantLengthLine { p2 = (50, 50)  size = 50 }
merge upper.p2 = lower.p1
anchor upper.p1
";

#[test]
fn a_number_that_cannot_be_set_says_how_far_it_could_go() {
    let mut desk = Desk::of("x: Real = 50\nconstraint wall: x <= 100\n");
    let refusal = desk.set("x", 150.0).expect_err("the wall forbids it");
    assert_eq!(refusal.message, "refused: 100 is the limit of x; wall would not hold");
    let limit = refusal.limit.expect("it could have gone some way");
    assert_eq!((limit.path.as_str(), limit.value.as_str()), ("x", "100"));
    desk.type_in("x", &limit.value).expect("what is told can be set");
    let refusal = desk.set("x", 150.0).expect_err("the wall still forbids it");
    assert_eq!(refusal.limit, Some(limit), "where it is at its limit, the limit is where it is");
}

#[test]
fn a_limit_that_is_never_reached_is_told_as_that() {
    let mut desk = Desk::of("x: Real = 4\nz: Real\nconstraint lg: z = ln(x)\n");
    let refusal = desk.set("x", -1.0).expect_err("there is no logarithm");
    assert_eq!(refusal.message, "refused: x has to stay short of 0; lg would not hold");
    assert_eq!(refusal.limit, None);
    desk.set("x", 0.001).expect("short of it anything can be set");
}

#[test]
fn a_limit_that_is_nothing_beside_its_way_is_told_in_the_unit_of_the_beginning() {
    let mut desk =
        Desk::of("use electrical\nr: Resistance = 100 ohm\nconstraint more: r > 0 ohm\n");
    let refusal = desk.type_in("r", "-5").expect_err("there is no such resistance");
    assert_eq!(refusal.message, "refused: r has to stay short of 0 ohm; more would not hold");
}

/// A chain of bars of length 1 from an anchored place, each at an angle that is up to `rough` off the first axis.
fn chain(bars: u32, rough: f64) -> String {
    let mut text = String::from("use geometry\np0: Point = (0, 0)\nanchor p0\n");
    let (mut x, mut y) = (0.0, 0.0);
    for k in 1..=bars {
        let angle = rough * base::number::sin(f64::from(k * k));
        (x, y) = (x + base::number::cos(angle), y + base::number::sin(angle));
        let before = k - 1;
        text += &format!("p{k}: Point = ({x}, {y})\n");
        text += &format!("constraint p{before}.distance(to: p{k}) = 1\n");
    }
    text
}

#[test]
fn a_long_chain_set_out_of_reach_tells_its_reach() {
    for (bars, rough) in [(40_u32, 0.3), (80, 2.5), (120, 0.3), (320, 0.3)] {
        let mut desk = Desk::of(&chain(bars, rough));
        let end = format!("p{bars}");
        let x = desk.number(&format!("{end}.x"));
        let wanted = 1.1 * f64::from(bars);
        let place = Literal::Tuple(vec![Literal::Number(wanted), Literal::Number(0.0)]);
        let command = Command::Set(vec![(at(&end), place)]);
        let refusal = desk.apply(&command).expect_err("it is out of reach");
        let reach = format!("by hand: reach {bars} of {wanted} from p0");
        assert!(refusal.message.contains(&reach), "{}", refusal.message);
        assert_eq!(desk.number(&format!("{end}.x")).to_bits(), x.to_bits());
    }
}

#[test]
fn what_cannot_move_at_all_has_no_limit() {
    let mut desk = Desk::of("a: Real = 1\nanchor a\nb: Real\nconstraint b = a + 1\n");
    assert_eq!(desk.set("b", 7.0).expect_err("an anchor forbids it").limit, None);
}

#[test]
fn an_angle_that_bars_do_not_reach_is_told_in_degrees() {
    let mut desk = Desk::of(LINKAGE);
    let refusal = desk.type_in("turn.value", "150 deg").expect_err("the bars are too short");
    let told = "refused: 130.5° is the limit of turn.value; ";
    assert!(refusal.message.starts_with(told), "{}", refusal.message);
    let limit = refusal.limit.expect("it could have gone some way");
    assert_eq!(limit.value, "130.5 deg");
    desk.type_in("turn.value", &limit.value).expect("what is told can be set");
    desk.type_in("turn.value", "130.6 deg").expect_err("130.5416° is where the bars are straight");
}

#[test]
fn the_limit_of_an_angle_that_the_document_computes_is_told_in_degrees() {
    let mut desk = Desk::of(
        "use geometry\np: Point { x = 10  y = 0 }\nconstraint p.x = 10\nconstraint p.y <= 10\n\
         turn: Angle => atan2(p.y, p.x)\n",
    );
    let refusal = desk.type_in("turn", "80 deg").expect_err("it is too steep");
    assert!(refusal.message.starts_with("refused: 45° is the limit of turn"), "{refusal:?}");
}

#[test]
fn a_hand_out_of_reach_says_how_far_the_arm_reaches() {
    let mut desk = Desk::of(ELBOW);
    let drag = desk.hold("lower.p2", &[(300.0, 400.0)]);
    assert!(!drag.reached);
    assert_eq!(drag.message.as_deref(), Some("reach 100 of 500 from upper.p1"));
    assert_eq!(drag.limit.map(|l| l.value).as_deref(), Some("(60, 80)"));
}

#[test]
fn a_dragged_number_says_its_limit_and_what_holds_it() {
    let mut desk = Desk::of(WALL);
    let drag = desk.hold("p.x", &[(130.0, 0.0)]);
    assert_eq!(drag.message.as_deref(), Some("100 is the limit of p.x; held by wall"));
    let drag = desk.hold("p", &[(130.0, 20.0)]);
    let told = "(100, 20) is as far as it goes, 30 short; held by wall";
    assert_eq!(drag.message.as_deref(), Some(told));
}

#[test]
fn a_bound_that_begins_to_act_is_told_while_it_acts() {
    let mut desk = Desk::of(WALL);
    let told = |modes: &[session::view::ModeView]| {
        modes.iter().map(|m| m.message.clone()).collect::<Vec<_>>()
    };
    let at_bound = ["wall is at its bound: p.x <= 100"];
    assert_eq!(told(&desk.hold("p", &[(130.0, 30.0)]).modes), at_bound);
    assert!(desk.session.drag(desk.id, (80.0, 30.0)).modes.is_empty());
    let drag = desk.session.drag(desk.id, (130.0, 40.0));
    let (start, end) = drag.modes[0].span.expect("it is written here");
    assert_eq!(&desk.text()[start as usize..end as usize], "constraint wall: p.x <= 100");
    let change = desk.session.release(desk.id).expect("the drag can be kept");
    assert_eq!(told(&change.modes), at_bound);
    let change = desk.move_to("p", 60.0, 40.0).expect("it can go back");
    assert_eq!(told(&change.modes), ["wall is off its bound: p.x <= 100"]);
    let change = desk.move_to("p", 70.0, 40.0).expect("nothing is in the way");
    assert_eq!(change.modes, []);
}

#[test]
fn another_alternative_is_told() {
    let mut desk =
        Desk::of("use geometry\np: Point = (5, 0)\nconstraint axis: p.x = 0 or p.y = 0\n");
    let place = Literal::Tuple(vec![Literal::Number(0.0), Literal::Number(4.0)]);
    let change = desk.apply(&Command::Set(vec![(at("p"), place)])).expect("it lies on an axis");
    let told: Vec<String> = change.modes.into_iter().map(|m| m.message).collect();
    assert_eq!(told, ["axis holds by alternative 1 of 2: p.x = 0"]);
}

#[test]
fn several_things_that_are_set_have_one_limit_together() {
    let mut desk = Desk::of("a: Real = 2\nb: Real = 4\nconstraint most: a + b <= 12\n");
    let to = |path, x| (at(path), Literal::Number(x));
    let refusal = desk.apply(&Command::Set(vec![to("a", 6.0), to("b", 12.0)]));
    let refusal = refusal.expect_err("together they are too large");
    assert!(refusal.message.starts_with("refused: 4, 8 is the limit of a, b; "), "{refusal:?}");
    let limit = refusal.limit.expect("they can go a part of the way");
    assert_eq!((limit.path.as_str(), limit.value.as_str()), ("a, b", "4, 8"));
    desk.apply(&Command::Set(vec![to("a", 4.0), to("b", 8.0)])).expect("what is told can be set");
}

/// A bridge of five resistors. To let less current through the third, all of them change as little as they can;
/// where that takes the fifth to nothing, near 0.0117 A by an independent search of least change, no near answer
/// is left.
const BRIDGE: &str = "\
use circuits
battery: Battery { emf = 10 V  anchor emf }
ground: Ground
r1: Resistor { resistance = 100 ohm }
r2: Resistor { resistance = 200 ohm }
r3: Resistor { resistance = 300 ohm }
r4: Resistor { resistance = 400 ohm }
r5: Resistor { resistance = 50 ohm }
merge battery.a.node = r1.a.node = r2.a.node
merge r1.b.node = r3.a.node = r5.a.node
merge r2.b.node = r4.a.node = r5.b.node
merge r3.b.node = r4.b.node = battery.b.node = ground.lead.node
";

#[test]
fn a_limit_too_dear_to_find_out_is_told_as_far_as_it_was_seen() {
    let mut desk = Desk::of(BRIDGE);
    let refusal = desk.type_in("r3.current", "0.01 A").expect_err("no near answer is left");
    let limit = refusal.limit.expect("it could have gone some way");
    let told = format!("refused: r3.current goes to {}, and how much further", limit.value);
    assert!(refusal.message.starts_with(&told), "{}", refusal.message);
    desk.type_in("r3.current", &limit.value).expect("what is told can be set");
    let came: Option<f64> = limit.value.strip_suffix(" mA").and_then(|x| x.parse().ok());
    assert!(came.is_some_and(|x| (11.6..12.0).contains(&x)), "{limit:?}");
}

#[test]
fn what_is_set_against_a_weaker_constraint_says_that_it_springs_back() {
    let mut desk = Desk::of("y: Real\nweak constraint home: y = 4\nz: Real = 1\n");
    let change = desk.set("y", 9.0).expect("nothing stands in the way");
    let told: Vec<&str> = change.modes.iter().map(|mode| &*mode.message).collect();
    assert_eq!(told, ["y springs back to 4: home, which is weaker, acts again once it is set"]);
    assert!(desk.set("z", 2.0).expect("it is given").modes.is_empty());
}

#[test]
fn a_check_that_falls_short_says_what_sprang_back_and_shows_lists() {
    let desk = Desk::of(
        "y: Real\nweak constraint home: y = 4\nxs: List of Real = [1, 2, 3, 4]\n\
         check \"a\" {\n    set y to 9\n    expect y = 9\n    expect xs = [1, 2, 3, 5]\n}\n",
    );
    let report = desk.session.run_checks(desk.id).remove(0);
    let told: Vec<&str> = report.shortfalls.iter().map(|s| &*s.message).collect();
    let back = "y springs back to 4: home, which is weaker, acts again once it is set";
    assert_eq!(told, [format!("4 and 9; {back}"), "[1, 2, 3, 4] and [1, 2, 3, 5]".into()]);
}

const PRICE: &str = "net: Real = 100\ntax: Real = 19 %\ngross: Real = net * (1 + tax)\n";

#[test]
fn a_check_that_falls_short_says_what_moved_unasked_and_how_it_is_held() {
    let told = |check: &str| -> Vec<String> {
        let desk = Desk::of(&format!("{PRICE}check \"a\" {{\n{check}\n}}\n"));
        let report = desk.session.run_checks(desk.id).remove(0);
        report.shortfalls.into_iter().map(|s| s.message).collect()
    };
    let moved = "net moved from 100 to 100.028, tax moved from 19 % to 137.933 %";
    // what is asked to move is not what is to be held
    assert_eq!(
        told("set gross to 238\nexpect net = 200"),
        [format!("100.028 and 200\n{moved}; `anchor tax` holds it")]
    );
    assert_eq!(
        told("set gross to 238\nexpect tax = 19 %\nexpect net = 200"),
        [format!("137.933 % and 19 %\n{moved}; `anchor tax` holds it"), "100.028 and 200".into()]
    );
    assert_eq!(
        told("set gross to 238\nexpect net > 10 and tax < 20 %"),
        [format!("tax < 20 %: 137.933 % and 20 %\n{moved}; `anchor tax` holds it")]
    );
    // nothing else moved, or all that did was spoken of
    assert_eq!(told("anchor tax\nset gross to 238\nexpect net = 201"), ["200 and 201"]);
    assert_eq!(told("set net to 3, tax to 1\nexpect gross = 7"), ["6 and 7"]);
}

#[test]
fn a_number_that_was_set_says_which_others_moved_where_there_was_a_choice() {
    let mut desk = Desk::of(PRICE);
    let change = desk.set("gross", 238.0).expect("something yields");
    let told: Vec<&str> = change.modes.iter().map(|mode| &*mode.message).collect();
    let moved = "net moved from 100 to 100.028, tax moved from 19 % to 137.933 %";
    assert_eq!(told, [format!("lock what shall stay: {moved}")]);
    assert!(desk.set("net", 50.0).expect("it is given").modes.is_empty());
    let mut desk = Desk::of(&format!("{PRICE}anchor tax\n"));
    assert!(desk.set("gross", 238.0).expect("the net price yields").modes.is_empty());
}

#[test]
fn sides_of_an_expectation_are_told_apart_in_the_unit_that_it_writes() {
    let desk = Desk::of(
        "use geometry\nl: Length = 4 m\na: Angle = 30 deg\np: Point = (1 m, 2 m)\ncheck \"a\" {\n\
         expect l = 400.0001 cm\nexpect a = 31 deg\nexpect p = (1 m, 3 m)\n}\n",
    );
    let report = desk.session.run_checks(desk.id).remove(0);
    let told: Vec<&str> = report.shortfalls.iter().map(|s| &*s.message).collect();
    assert_eq!(told, ["400 cm and 400.0001 cm", "30 deg and 31 deg", "(1 m, 2 m) and (1 m, 3 m)"]);
}

#[test]
fn places_that_move_for_a_dimension_are_no_choice() {
    let mut desk = Desk::of(
        "use geometry\na: Point = (0, 0)\nb: Point = (3, 4)\nlong: Length = a.distance(to: b)\n\
         check \"a\" { set long to 10  expect a.x = 5 }\n",
    );
    let report = desk.session.run_checks(desk.id).remove(0);
    assert!(report.shortfalls.iter().all(|s| !s.message.contains("moved")), "{report:?}");
    assert_eq!(desk.set("long", 10.0).expect("the points yield").modes, []);
}
