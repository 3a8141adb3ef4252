//! Orientation: followed while values decide it, written where they do not, and read again.

use crate::desk::{Desk, at};
use session::Command;

/// Two circles about (0, 0) and (10, 0) that meet in `c`; flat where the radii are 3 and 7.
fn triangle(c: &str, more: &str) -> String {
    format!(
        "use geometry
a: Point = (0, 0)
b: Point = (10, 0)
ra: Length = 3
rb: Length = 7
c: Point = {c}
constraint left: a.distance(to: c) = ra {{ reads ra }}
constraint right: b.distance(to: c) = rb {{ reads rb }}
anchor a
anchor b
{more}"
    )
}

/// A crank of 40 and a rod of 100; the slider runs along the axis, 140 away at most.
fn slider(tip: f64) -> String {
    format!(
        "use geometry
o: Point = (0, 0)
tip: Point = (0, {tip})
s: Point = (91.6515138991168, 0)
anchor o
anchor s.y
crank: Distance {{ value = 40 }}
rod: Distance {{ value = 100 }}
merge crank.from = o
merge crank.to = rod.from = tip
merge rod.to = s
"
    )
}

fn sides(desk: &Desk) -> Vec<String> {
    let text = desk.text();
    let lines = text.lines().filter(|line| line.starts_with("side "));
    lines.map(ToString::to_string).collect()
}

#[test]
fn a_flat_triangle_goes_on_to_the_side_that_is_written() {
    for (side, sign) in [("up", 1.0), ("down", -1.0)] {
        let mut desk = Desk::of(&triangle("(3, 0)", &format!("side c: {side}\n")));
        assert_eq!(desk.wrong(), []);
        desk.set("ra", 6.0).expect("it can open");
        // x = (36 + 100 - 49) / 20, y = sqrt(36 - x^2)
        assert!((desk.number("c.x") - 4.35).abs() < 1e-9, "{}", desk.text());
        assert!((desk.number("c.y") - sign * 4.132493194186).abs() < 1e-9, "{}", desk.text());
        assert_eq!(sides(&desk), [""; 0], "now the values say it");
    }
}

#[test]
fn where_an_edit_ends_flat_the_side_is_written() {
    for (y, side) in [("4.898979485566356", "side c: up"), ("-4.898979485566356", "side c: down")] {
        let text = triangle(&format!("(5, {y})"), "").replace("ra: Length = 3", "ra: Length = 7");
        let mut desk = Desk::of(&text);
        let change = desk.set("ra", 3.0).expect("it can be flat");
        assert_eq!(sides(&desk), [side]);
        let told =
            format!("two branches meet at c: it goes on {}, which is written (side)", &side[8..]);
        assert!(change.modes.iter().any(|m| m.message == told), "{:?}", change.modes);
        // values that cannot say it: the very place where the branches meet
        let flat = Desk::of(&desk.text()).text();
        let start = flat.find("c: Point = (").expect("the place is written");
        let end = start + flat[start..].find('\n').expect("the line ends");
        let mut again = Desk::of(&format!("{}c: Point = (3, 0){}", &flat[..start], &flat[end..]));
        again.set("rb", 8.0).expect("it can open");
        assert_eq!(again.number("c.y") > 0.0, side == "side c: up");
        assert_eq!(sides(&again), [""; 0]);
        desk.undo();
        assert_eq!(desk.text(), text);
    }
}

#[test]
fn a_slider_goes_back_from_its_dead_centre_as_it_came() {
    for (tip, side) in [(40.0, "side tip: up"), (-40.0, "side tip: down")] {
        let mut desk = Desk::of(&slider(tip));
        desk.drag("s.x", &[(120.0, 0.0), (200.0, 0.0)]);
        assert!((desk.number("s.x") - 140.0).abs() < 1e-6, "{}", desk.text());
        assert_eq!(sides(&desk), [side]);
        let mut again = Desk::of(&desk.text());
        again.drag("s.x", &[(130.0, 0.0), (91.6515138991168, 0.0)]);
        assert!((again.number("tip.y") - tip).abs() < 1e-5, "{}", again.text());
        assert_eq!(sides(&again), [""; 0]);
    }
}

#[test]
fn a_root_goes_back_to_its_own_side_of_zero() {
    let mut desk =
        Desk::of("a: Real = 9\nx: Real\nconstraint square: x * x = a { reads a }\nx = -3\n");
    desk.set("a", 0.0).expect("nothing has a root of itself");
    assert_eq!(sides(&desk), ["side x: less"]);
    desk.set("a", 4.0).expect("it has a root");
    assert!((desk.number("x") + 2.0).abs() < 1e-9, "{}", desk.text());
    assert_eq!(sides(&desk), [""; 0]);
}

#[test]
fn a_side_that_is_written_makes_way_for_another() {
    // on a circle of radius 5, from where it is widest in x to where it is widest in y
    let mut desk = Desk::of("x: Real = 3\ny: Real\nconstraint x^2 + y^2 = 25\nend: Real = 1\n");
    desk.set("x", 5.0).expect("the circle is 5 wide");
    assert_eq!(sides(&desk), ["side y: more"], "{}", desk.text());
    desk.set("y", 5.0).expect("the circle is 5 high");
    assert_eq!(sides(&desk), ["side x: more"], "{}", desk.text());
    assert!(desk.number("x").abs() < 1e-9, "{}", desk.text());
    desk.set("y", 3.0).expect("it lies on the circle");
    assert!((desk.number("x") - 4.0).abs() < 1e-9, "{}", desk.text());
    assert_eq!(sides(&desk), [""; 0]);
}

#[test]
fn a_side_stays_while_nothing_moves_what_it_speaks_of() {
    let mut desk = Desk::of(&triangle("(3, 0)", "side c: up\nelse_where: Real = 1\n"));
    desk.set("else_where", 2.0).expect("nothing forbids it");
    assert_eq!(sides(&desk), ["side c: up"]);
    let why = desk.session.explain(desk.id, Some(&at("c"))).summary;
    let told = "Two branches meet at c: it goes on up, as is written (side).";
    assert!(why.ends_with(told), "{why}");
    desk.apply(&Command::Rename { from: at("c"), to: "apex".into() }).expect("a part has a name");
    assert_eq!(sides(&desk), ["side apex: up"]);
}

#[test]
fn a_wrong_side_is_told() {
    let codes = |side: &str| Desk::of(&triangle("(3, 0)", side)).wrong();
    assert_eq!(codes("side c: sideways\n"), [("unknown-side".to_string(), 11)]);
    assert_eq!(codes("side ra: up\n"), [("unknown-side".to_string(), 11)]);
    assert_eq!(codes("side left: up\n").len(), 1);
    assert_eq!(codes("n: Text\nside n: less\n"), [("side-of-nothing".to_string(), 12)]);
}

/// A triangle of three lengths that stands on (0, 0) and (10, 0), flat as it is given.
const FLAT: &str = "use geometry
class Tent {
    a: Point = (0, 0)
    b: Point = (10, 0)
    c: Point = (3, 0)
    ra: Length = 3
    rb: Length = 7
    constraint left: a.distance(to: c) = ra { reads ra }
    constraint right: b.distance(to: c) = rb { reads rb }
    anchor a
    anchor b
    side c: up
}
";

#[test]
fn a_class_says_which_way_its_things_open_and_a_body_says_otherwise() {
    let text =
        format!("{FLAT}plain: Tent\nturned: Tent {{ side c: down }}\nlast: List of 2 Tent\n");
    let mut desk = Desk::of(&format!("{text}side last[1].c: down\n"));
    assert_eq!(desk.wrong(), []);
    let all = [("plain", 1.0), ("turned", -1.0), ("last[0]", 1.0), ("last[1]", -1.0)];
    for (path, sign) in all {
        desk.set(&format!("{path}.ra"), 6.0).expect("it can open");
        let y = desk.number(&format!("{path}.c.y"));
        assert!((y - sign * 4.132493194186).abs() < 1e-9, "{path}: {y}\n{}", desk.text());
    }
    // the document's own line has done its work, what bodies say of their parts is their default
    assert_eq!(sides(&desk), [""; 0]);
    assert!(desk.text().contains("side c: up") && desk.text().contains("side c: down"));
}

#[test]
fn a_body_in_which_two_branches_meet_gets_the_line_in_the_document_where_it_says_otherwise() {
    let mut desk =
        Desk::of(&format!("{FLAT}t: Tent {{ c = (4.35, -4.132493194186773)  ra = 6 }}\n"));
    assert_eq!(desk.wrong(), []);
    desk.set("t.ra", 3.0).expect("it can be flat");
    assert_eq!(sides(&desk), ["side t.c: down"], "{}", desk.text());
    desk.set("t.ra", 6.0).expect("it can open again");
    assert!((desk.number("t.c.y") + 4.132493194186).abs() < 1e-6, "{}", desk.text());
    assert_eq!(sides(&desk), [""; 0]);
    // coming the way that the class says, there is nothing to be written
    let mut desk =
        Desk::of(&format!("{FLAT}t: Tent {{ c = (4.35, 4.132493194186773)  ra = 6 }}\n"));
    desk.set("t.ra", 3.0).expect("it can be flat");
    assert_eq!(sides(&desk), [""; 0], "{}", desk.text());
    desk.set("t.ra", 6.0).expect("it can open again");
    assert!(desk.number("t.c.y") > 4.0, "{}", desk.text());
}

#[test]
fn what_is_written_of_sides_is_a_row_of_the_structure() {
    let desk = Desk::of(&format!("{FLAT}t: Tent\n"));
    let rows = desk.session.structure(desk.id);
    let told: Vec<(&str, &str)> = rows
        .iter()
        .filter(|row| row.kind == session::view::RowKind::Side)
        .map(|row| (row.path.as_str(), row.detail.as_str()))
        .collect();
    assert_eq!(told, [("t", "side c: up")]);
}
