//! Ghosts: where else a thing could be, and the command that picks it.

use crate::desk::{Desk, at, gallery};
use session::Command;
use session::jobs::{Desk as Copies, LongAnswer, LongQuestion};
use session::plain::{read, written};
use session::view::Ghost;

/// A place 7 from (0, 0) and from (10, 0), above them, and one that hangs on it.
const TRIANGLE: &str = "use geometry
a: Point = (0, 0)
b: Point = (10, 0)
c: Point = (5, 4.898979485566356)
constraint left: a.distance(to: c) = 7
constraint right: b.distance(to: c) = 7
d: Point = (5, 9.898979485566356)
constraint above: d.y = c.y + 5
constraint beside: d.x = c.x
anchor a
anchor b
";

fn ghosts(desk: &mut Desk, path: &str) -> Vec<Ghost> {
    desk.session.ghosts(desk.id, &at(path)).expect("there is such a thing")
}

fn labels(desk: &mut Desk, path: &str) -> Vec<String> {
    ghosts(desk, path).into_iter().map(|g| g.label).collect()
}

#[test]
fn nothing_else_is_shown_of_what_is_free_or_held() {
    let mut desk = Desk::of(&format!("{TRIANGLE}free: Point = (1, 2)\nn: Real = 3\n"));
    for path in ["a", "free", "n"] {
        assert_eq!(labels(&mut desk, path), [""; 0], "{path}");
    }
    let refusal = desk.session.ghosts(desk.id, &at("e")).expect_err("there is no e");
    assert!(refusal.message.starts_with("there is no e"), "{}", refusal.message);
}

#[test]
fn two_circles_meet_on_the_other_side_too_and_what_hangs_there_goes_along() {
    let mut desk = Desk::of(TRIANGLE);
    let before = desk.text();
    let ghosts = ghosts(&mut desk, "c");
    let [other] = &ghosts[..] else { panic!("{ghosts:?}") };
    assert!(other.label.starts_with("c on the other side of a and b: c = (5, -4.89"), "{other:?}");
    let moved: Vec<&str> = other.moves.iter().map(|m| m.path.as_str()).collect();
    assert_eq!(moved, ["c", "d"]);
    assert!(!other.picture.elements.is_empty());
    assert_eq!(desk.text(), before, "looking writes nothing");
    desk.apply(&other.command).expect("what is shown can be picked");
    assert!((desk.number("c.y") + 24f64.sqrt()).abs() < 1e-9, "{}", desk.text());
    assert!((desk.number("d.y") - 5.0 + 24f64.sqrt()).abs() < 1e-9, "{}", desk.text());
    assert!(desk.session.status(desk.id).satisfied);
    // opened again it is where it was picked, and there it stays
    let mut again = Desk::of(&desk.text());
    assert!((again.number("c.y") + 24f64.sqrt()).abs() < 1e-9, "{}", again.text());
    assert!(labels(&mut again, "c")[0].contains("c = (5, 4.89"));
    desk.undo();
    assert_eq!(desk.text(), before, "one step");
}

#[test]
fn a_square_has_two_roots_and_the_picked_one_is_kept() {
    let mut desk = Desk::of("a: Real = 9\nx: Real = 3\nconstraint square: x * x = a { reads a }\n");
    let ghosts = ghosts(&mut desk, "x");
    let [other] = &ghosts[..] else { panic!("{ghosts:?}") };
    assert_eq!(other.label, "x = -3");
    desk.apply(&other.command).expect("what is shown can be picked");
    desk.set("a", 16.0).expect("it has a root");
    assert_eq!(desk.number("x"), -4.0);
}

#[test]
fn every_other_alternative_is_shown_by_its_rule_and_picked_by_values() {
    let mut desk = Desk::of(
        "a: Real = 10\nx: Real = 0\nconstraint stop: x = 0 or x = a or x = 50 { reads a }\n",
    );
    assert_eq!(
        labels(&mut desk, "x"),
        [
            "stop holds by alternative 2 of 3: x = a; x = 10",
            "stop holds by alternative 3 of 3: x = 50; x = 50"
        ]
    );
    let second = ghosts(&mut desk, "x").swap_remove(0);
    desk.apply(&second.command).expect("what is shown can be picked");
    assert_eq!((desk.number("x"), desk.number("a")), (10.0, 10.0));
    desk.set("a", 20.0).expect("x follows");
    assert_eq!(desk.number("x"), 20.0, "the alternative that was picked is kept");
}

#[test]
fn a_thing_has_ghosts_where_it_is_elsewhere_itself() {
    let further = "e: Point = (13, 5)\nconstraint c.distance(to: e) = 8.000637729704143\n\
        constraint b.distance(to: e) = 5.830951894845301\n";
    let mut desk = Desk::of(&format!("{TRIANGLE}{further}"));
    // e has another side too, and goes along
    let labels = labels(&mut desk, "c");
    assert_eq!(labels.len(), 1, "{labels:?}");
    let of_e = ghosts(&mut desk, "e");
    assert_eq!(of_e.len(), 2, "{of_e:?}");
    assert!(of_e.iter().all(|g| g.moves.iter().any(|m| m.path == "e")), "{of_e:?}");
}

#[test]
fn a_ghost_breaks_no_rule() {
    // the other side is forbidden, and what hangs on it could not follow
    let mut desk = Desk::of(&format!("{TRIANGLE}constraint above_all: c.y >= 0\n"));
    assert_eq!(labels(&mut desk, "c"), [""; 0]);
    let mut desk = Desk::of(&format!("{TRIANGLE}anchor d\n"));
    assert_eq!(labels(&mut desk, "c"), [""; 0]);
}

#[test]
fn a_rocker_has_another_side_and_a_crank_that_is_free_to_turn_one_too() {
    let mut desk = Desk::of(&gallery("four-bar"));
    let labels = |desk: &mut Desk, path| {
        let labels = labels(desk, path);
        labels
            .iter()
            .map(|l| l.split(':').next().unwrap_or_default().to_string())
            .collect::<Vec<_>>()
    };
    let rocker = ["coupler.p2 on the other side of ground.p2 and crank.p2"];
    assert_eq!(labels(&mut desk, "coupler.p2"), rocker);
    // with the coupler where it is, the crank's tip has two places
    let crank = ["crank.p2 on the other side of ground.p1 and coupler.p2"];
    assert_eq!(labels(&mut desk, "crank.p2"), crank);
    let other = ghosts(&mut desk, "coupler.p2").swap_remove(0);
    desk.apply(&other.command).expect("what is shown can be picked");
    // and the drag goes on from there, on that side
    desk.drag("crank.p2", &[(0.0, 40.0), (-40.0, 1.0), (0.0, -40.0), (40.0, 0.0)]);
    assert!((desk.number("coupler.p2.y") + 113.712600689438).abs() < 1e-6, "{}", desk.text());
}

#[test]
fn what_hangs_on_a_thing_is_elsewhere_where_that_is() {
    let mut desk = Desk::of(TRIANGLE);
    let ghosts = ghosts(&mut desk, "d");
    let [other] = &ghosts[..] else { panic!("{ghosts:?}") };
    let moved: Vec<&str> = other.moves.iter().map(|m| m.path.as_str()).collect();
    assert_eq!(moved, ["c", "d"]);
    desk.apply(&other.command).expect("what is shown can be picked");
    assert!((desk.number("d.y") - 5.0 + 24f64.sqrt()).abs() < 1e-9, "{}", desk.text());
}

#[test]
fn other_whole_numbers_are_shown_nearest_first() {
    let text = "x: Integer in 0..9\ny: Integer in 0..9\nconstraint x + y = 5\nconstraint x < y\n";
    let mut desk = Desk::of(text);
    let now = desk.number("x");
    let labels = labels(&mut desk, "x");
    let all = ["x = 0, y = 5", "x = 1, y = 4", "x = 2, y = 3"];
    let mut others = all.into_iter().filter(|l| !l.starts_with(&format!("x = {now}")));
    assert_eq!(labels.len(), 2, "{labels:?}");
    assert!(others.all(|l| labels.iter().any(|shown| shown == l)), "{labels:?}");
    let picked = ghosts(&mut desk, "x").swap_remove(1);
    let wanted = picked.moves[0].value.clone();
    desk.apply(&picked.command).expect("what is shown can be picked");
    assert_eq!(desk.row("x").text, wanted);
}

#[test]
fn a_whole_number_among_real_ones_could_be_a_step_larger() {
    let text = "length: Real = 100\nn: Integer in 1..20\npitch: Real\n\
        constraint pitch = length / n { reads length }\nconstraint pitch <= 30\n";
    let mut desk = Desk::of(text);
    assert_eq!(desk.number("n"), 4.0);
    let labels = labels(&mut desk, "n");
    assert_eq!(labels.first().map(String::as_str), Some("n = 5, pitch = 20"), "{labels:?}");
    assert!(!labels.iter().any(|l| l.starts_with("n = 3")), "a bound forbids it: {labels:?}");
    let five = ghosts(&mut desk, "n").swap_remove(0);
    desk.apply(&five.command).expect("what is shown can be picked");
    assert_eq!((desk.number("n"), desk.number("pitch")), (5.0, 20.0));
}

#[test]
fn what_lies_next_to_the_infinite_is_no_other_state() {
    let mut desk = Desk::of(
        "use geometry
a: Point = (0, 0)
b: Point = (100, 0)
c: Point = (130, 90)
n: Point
r: Length
constraint n.distance(to: a) = r
constraint n.distance(to: b) = r
constraint n.distance(to: c) = r
",
    );
    // of three places there is one centre alone
    assert_eq!(labels(&mut desk, "n"), [""; 0]);
}

#[test]
fn a_worker_finds_what_the_session_finds_and_tells_it_in_bytes() {
    let mut desk = Desk::of(TRIANGLE);
    let asked = |desk: &Desk, question: LongQuestion| {
        let job = read(&written(&desk.session.job(desk.id, question))).expect("a job");
        let mut copies = Copies::default();
        copies.take(job);
        let answer = copies.answer(0).expect("one answer");
        read::<LongAnswer>(&written(&answer)).expect("an answer")
    };
    let here = ghosts(&mut desk, "c");
    assert!(!here.is_empty());
    assert_eq!(asked(&desk, LongQuestion::Elsewhere(at("c"))), LongAnswer::Elsewhere(here));
    let level =
        Command::Edit { target: session::Path::default(), members: "constraint a.y = c.y".into() };
    for command in [level, Command::Delete(at("nobody"))] {
        let here = desk.session.foreseen(desk.id, &command).map_err(|refusal| refusal.in_a_line());
        assert_eq!(asked(&desk, LongQuestion::Foreseen(command)), LongAnswer::Foreseen(here));
    }
}
