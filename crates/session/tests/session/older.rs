//! Recording among what is drawn already: parameters of every class, what is taken along, other solutions.

use crate::desk::Desk;
use session::drafting::view::{NewParameter, OlderUse, Turn, Wants};
use session::view::Pointer;

const OLDER: &str = "\
use geometry
floor: Axis { p1 = (0, 0)  p2 = (100, 0) }
size: Length = 8
peg: Circle { center = (40, 30)  radius = 10 }
lid => Axis.parallel(to: floor, distance: 5 * size)
";

fn pointer(x: f64, y: f64) -> Pointer {
    Pointer { at: (x, y), reach: 3.0, ..Pointer::default() }
}

fn point(desk: &mut Desk, x: f64, y: f64) -> Turn {
    desk.session.point(desk.id, &pointer(x, y)).expect("something lies there")
}

fn recording(tool: &str) -> Desk {
    let mut desk = Desk::of(OLDER);
    desk.session.record(desk.id, "Ball").expect("a new program");
    desk.session.begin(desk.id, tool).expect("it is in scope");
    desk
}

fn asked(turn: &Turn) -> Option<&str> {
    match turn {
        Turn::Wants(prompt) => match &prompt.wants {
            Wants::Older { path } => Some(path),
            _ => None,
        },
        Turn::Made { .. } => None,
    }
}

#[test]
fn something_older_becomes_a_parameter_of_its_class() {
    let mut desk = recording("Circle.concentric(with,radius)");
    let turn = point(&mut desk, 50.0, 30.0);
    assert_eq!(asked(&turn), Some("peg"));
    desk.session.take_older(desk.id, OlderUse::Parameter).expect("a circle can be one");
    desk.session.enter(desk.id, "2 * peg2.radius").expect("the parameter has a radius");
    let text = desk.text();
    assert!(text.contains("peg2: Circle = Circle(center: Point(40, 30), radius: 10)"), "{text}");
    assert!(
        text.contains("circle = Circle.concentric(with: peg2, radius: 2 * peg2.radius)"),
        "{text}"
    );
    // the example follows what was picked
    desk.type_in("peg.radius", "12").expect("it is free");
    assert_eq!(desk.session.comes_to(desk.id, "ball.circle.radius").as_deref(), Some("24"));
    // defined and given is one step
    assert_eq!(desk.session.history(desk.id).0.len(), 4, "{:?}", desk.session.history(desk.id).0);
}

#[test]
fn something_older_is_taken_along_with_what_it_is_drawn_by() {
    let mut desk = recording("Circle.tangent(first,second,radius)");
    assert_eq!(asked(&point(&mut desk, 70.0, 40.0)), Some("lid"));
    let turn = desk.session.take_older(desk.id, OlderUse::Along).expect("it can be copied");
    assert!(asked(&turn).is_none());
    let text = desk.text();
    let program = text.split_once("program Ball").expect("it is there").1;
    for line in [
        "floor = Axis(p1: Point(0, 0), p2: Point(100, 0))",
        "size = 8",
        "lid = Axis.parallel(to: floor, distance: 5 * size)",
    ] {
        assert!(program.contains(line), "{line}: {program}");
    }
    // a second pick finds the copy
    assert!(asked(&point(&mut desk, 20.0, 0.0)).is_none());
    desk.session.back(desk.id).expect("the other line is wanted");
    desk.session.enter(desk.id, "Axis.vertical(x: 0)").expect("a line");
    desk.session.enter(desk.id, "20").expect("a circle of this radius lies between");
    assert_eq!(desk.session.comes_to(desk.id, "ball.circle.radius").as_deref(), Some("20"));
    // the copy stays where it is
    desk.type_in("size", "3").expect("it is free");
    assert_eq!(desk.session.comes_to(desk.id, "ball.circle.radius").as_deref(), Some("20"));
}

#[test]
fn the_question_is_taken_back_and_nothing_has_changed() {
    let mut desk = recording("Circle.concentric(with,radius)");
    let before = desk.text();
    assert_eq!(asked(&point(&mut desk, 50.0, 30.0)), Some("peg"));
    assert!(desk.session.enter(desk.id, "3").is_err());
    let prompt = desk.session.back(desk.id).expect("the construction goes on waiting");
    assert_eq!(prompt.wants, Wants::Operand);
    assert_eq!(desk.text(), before);
    assert!(desk.session.take_older(desk.id, OlderUse::Along).is_err());
}

#[test]
fn a_parameter_has_a_class_and_a_range() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.record(desk.id, "Ball").expect("a new program");
    let mut define = |name: &str, example: &str, class: &str, range: &str| {
        let new = NewParameter {
            name: name.into(),
            example: example.into(),
            class: class.into(),
            range: range.into(),
            ..NewParameter::default()
        };
        desk.session.define_parameter(desk.id, &new).map_err(|refusal| refusal.message)
    };
    define("at", "3,4", "", "").expect("a place");
    define("rim", "Circle(center: Point(0, 0), radius: 5)", "", "").expect("a circle");
    define("turns", "6", "Integer", "1..12").expect("a whole number");
    define("part", "0.5", "Real", "").expect("a number");
    let wrong = define("few", "20", "Integer", "1-12").expect_err("no range");
    assert_eq!(
        wrong,
        "`1-12` is no range and no table: wanted is from..to, as 1 mm..100 mm, or > 0 mm, values, as 3, 4, 5 mm, or a column, as bolts.csv.d"
    );
    define("round", "2", "Circle", "").expect_err("a number is no circle");
    let text = desk.text();
    for line in [
        "at: Point = Point(3, 4)",
        "rim: Circle = Circle(center: Point(0, 0), radius: 5)",
        "turns: Integer in 1..12 = 6",
        "part: Real = 0.5",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
    assert!(!text.contains("few") && !text.contains("round"), "{text}");
}

#[test]
fn another_solution_is_asked_for_before_and_after_it_is_drawn() {
    let mut desk = Desk::of("use geometry\n");
    desk.session.record(desk.id, "Ball").expect("a new program");
    for (tool, at) in [("Axis.horizontal(y)", "0"), ("Axis.vertical(x)", "0")] {
        desk.session.begin(desk.id, tool).expect("it is in scope");
        desk.session.enter(desk.id, at).expect("a coordinate");
    }
    let mut centers = Vec::new();
    for turns in 0..5 {
        desk.session.begin(desk.id, "Circle.tangent(first,second,radius)").expect("in scope");
        point(&mut desk, 20.0, 0.0);
        point(&mut desk, 0.0, 20.0);
        for _ in 0..turns {
            desk.session.turn_round(desk.id).expect("a construction waits");
        }
        desk.session.enter(desk.id, "20").expect("there is one");
        let name = if turns == 0 { "circle".into() } else { format!("circle{}", turns + 1) };
        let center = desk.session.comes_to(desk.id, &format!("ball.{name}.center"));
        centers.push(center.expect("it is drawn"));
    }
    assert_eq!(centers[0], "(20, 20)");
    // there are four of them, and they come in turn
    let mut all = centers[..4].to_vec();
    all.sort();
    assert_eq!(all, ["(-20, -20)", "(-20, 20)", "(20, -20)", "(20, 20)"]);
    assert_eq!(centers[4], centers[0]);
    let radius = |desk: &Desk| desk.session.comes_to(desk.id, "ball.circle.radius");
    let before = radius(&desk).expect("it is drawn");
    desk.session.turn_step_round(desk.id, ("Ball", "circle")).expect("it is a curve");
    let turned = radius(&desk).expect("it is drawn");
    assert_eq!(turned.trim_start_matches('-'), before.trim_start_matches('-'));
    assert_ne!(turned, before);
    desk.session.turn_step_round(desk.id, ("Ball", "circle")).expect("and back");
    assert_eq!(radius(&desk), Some(before));
}

#[test]
fn values_leave_and_come_as_a_table() {
    let text = "use geometry\nunit mm\nprogram Disc(rim: Length = 20 mm, turns: Integer = 3) {\n    edge = Circle(center: Point(0, 0), radius: rim)\n}\ndisc: Disc\n";
    let mut desk = Desk::of(text);
    let table = desk.session.parameter_table(desk.id, "disc").expect("a program draws it");
    assert_eq!(table, "name,value\nrim,20 mm\nturns,3\n");
    let read = "# of the week\nname,value,unit\nturns,4\nrim,3,cm\n";
    desk.session.read_parameter_table(desk.id, "disc", read).expect("both are values");
    let table = desk.session.parameter_table(desk.id, "disc").expect("a program draws it");
    assert_eq!(table, "name,value\nrim,30 mm\nturns,4\n");
    let before = desk.text();
    let mut wrong = |table: &str| {
        let refused = desk.session.read_parameter_table(desk.id, "disc", table);
        refused.expect_err("it is wrong").message
    };
    assert_eq!(
        wrong("rim,5 mm\nhub,3\n"),
        "line 2: disc has no parameter hub: wanted are rim, turns"
    );
    assert!(wrong("rim,5 mm\n# and\n\nhub,3\n").starts_with("line 4: "), "comments are lines");
    assert!(wrong("rim,5 kg\n").starts_with("rim: "));
    assert_eq!(wrong("name,value\n"), "the table has no line with a name and a value");
    assert_eq!(desk.text(), before);
}
