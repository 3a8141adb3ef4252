//! Counts that depend on values: whatever was tried with them, rules speak of as many as there are.

use crate::desk::{Desk, Moment, at};

/// As many numbers of a list as `n` says, of which there are four.
const LISTED: &str = "n: Integer = 2\nxs: List of 4 Real = [1, 2, 3, 4]\ntotal: Real\n\
                      constraint total = (0..n).map(i => xs[i]).sum\n";
/// As many as `n` says, which may be more than a rule may speak of.
const MANY: &str = "n: Integer = 2\ntotal: Real\nconstraint total = (0..n).map(i => i).sum\n";
/// As many as come of a number, which may come to none that counts, or to no number.
const COMPUTED: &str =
    "n: Real = 2\ntotal: Real\nconstraint total = (0..sqrt(n - 1)).map(i => i + 1).sum\n";
/// A corner that is not there where there are few.
const CORNERED: &str = "use geometry\nhex: RegularPolygon { center = (0, 0)  corner = (50, 0) }\n\
                        p: Point = (1, 2)\nn: Integer\nmerge n = hex.sides\nconstraint hex.corners[5] = p\n";
/// A count that does not settle.
const RESTLESS: &str = "n: Integer = 5\nm: Integer\nconstraint m = (0..n - 1).count\n\
                        constraint n = if m > 3 then 2 else 5\n";
/// A count that may not be large.
const BOUNDED: &str = "n: Integer = 2\nm: Real = 3\nconstraint m = (1..n).map(i => i).sum\n\
                       constraint m <= 10\n";

/// What an edit came to: whether it was made, and all that is there.
fn came(desk: &mut Desk, n: f64) -> (Option<String>, Moment) {
    let refusal = desk.set("n", n).err().map(|refusal| refusal.message);
    (refusal, desk.moment())
}

/// Sets a count anew after something else was tried; a desk that knows nothing of that comes to the same.
fn tried_and_set(text: &str, next: f64, attempt: impl Fn(&mut Desk)) {
    let mut desk = Desk::of(text);
    attempt(&mut desk);
    let mut fresh = Desk::of(&desk.text());
    assert_eq!(desk.moment(), fresh.moment());
    let problems = desk.session.problems(desk.id);
    assert_eq!(problems, fresh.session.problems(fresh.id), "{text}");
    assert_eq!(came(&mut desk, next), came(&mut fresh, next), "{text} to {next}");
}

#[test]
fn a_count_that_was_refused_changes_nothing_of_later_edits() {
    let mut desk = Desk::of(LISTED);
    desk.set("n", 9.0).expect_err("there are four");
    desk.set("n", 3.0).expect("there are as many");
    assert_eq!((desk.number("total"), desk.number("xs[0]")), (10.0, 1.0));
    let mut desk = Desk::of(MANY);
    desk.set("n", 50_000_000.0).expect_err("that is more than a rule speaks of");
    desk.set("n", 3.0).expect("so many it may speak of");
    assert_eq!(desk.number("total"), 6.0);
}

#[test]
fn a_corner_moves_after_too_few_were_tried() {
    let mut desk = Desk::of(CORNERED);
    desk.set("hex.sides", 5.0).expect_err("one of six is spoken of");
    desk.move_to("p", 3.0, 40.0).expect("the corner follows");
    let (x, y) = desk.place("hex.corners[5]");
    assert!((x - 3.0).abs() < 1e-9 && (y - 40.0).abs() < 1e-9, "{x}, {y}");
}

#[test]
fn whatever_count_was_tried_the_next_edit_comes_to_what_it_comes_to_without() {
    for text in [LISTED, MANY, COMPUTED, CORNERED, RESTLESS, BOUNDED] {
        for tried in [-1.0, 1.0, 4.0, 9.0] {
            for next in [0.0, 3.0, 6.0] {
                tried_and_set(text, next, |desk| drop(desk.set("n", tried)));
            }
        }
    }
}

#[test]
fn whatever_count_was_dragged_to_the_next_edit_comes_to_what_it_comes_to_without() {
    for text in [LISTED, COMPUTED, CORNERED, RESTLESS, BOUNDED] {
        for tried in [0.0, 9.0] {
            tried_and_set(text, 5.0, |desk| {
                desk.hold("n", &[(tried, 0.0)]);
                desk.session.cancel(desk.id);
            });
            tried_and_set(text, 5.0, |desk| {
                desk.hold("n", &[(tried, 0.0)]);
                drop(desk.session.release(desk.id));
            });
        }
    }
}

#[test]
fn a_count_that_is_wished_too_far_stops_at_the_last_that_holds() {
    let mut desk = Desk::of(BOUNDED);
    desk.apply(&session::Command::Move(vec![(at("n"), session::Literal::Number(6.0))]))
        .expect("it goes as far as it can");
    assert_eq!((desk.number("n"), desk.number("m")), (4.0, 10.0));
    for along in [&[6.0][..], &[3.0, 20.0], &[20.0, 1.0, 6.0]] {
        let mut desk = Desk::of(BOUNDED);
        let along: Vec<(f64, f64)> = along.iter().map(|&x| (x, 0.0)).collect();
        let state = desk.hold("n", &along);
        assert!(!state.reached, "{state:?}");
        assert_eq!((desk.number("n"), desk.number("m")), (4.0, 10.0), "{along:?}");
        desk.session.release(desk.id).expect("it is kept");
        assert_eq!((desk.number("n"), desk.number("m")), (4.0, 10.0), "{along:?}");
    }
    let mut desk = Desk::of(LISTED);
    desk.drag("n", &[(9.4, 0.0)]);
    assert_eq!((desk.number("n"), desk.number("total")), (3.0, 10.0));
}

#[test]
fn a_count_that_is_wished_far_too_far_stops_as_near() {
    for wish in [1e3, 1e6, 1e13] {
        let mut desk = Desk::of(BOUNDED);
        desk.apply(&session::Command::Move(vec![(at("n"), session::Literal::Number(wish))]))
            .expect("it goes as far as it can");
        assert_eq!((desk.number("n"), desk.number("m")), (4.0, 10.0), "{wish}");
    }
}

#[test]
fn a_count_of_one_thing_stops_though_that_of_another_is_wrong() {
    let mut desk = Desk::of(
        "class C {\n    n: Integer = 2\n    xs: List of 4 Real = [1, 2, 3, 4]\n    total: Real\n    \
         constraint total = (0..n).map(i => xs[i]).sum\n}\na: C { n = 9 }\nb: C\n",
    );
    desk.apply(&session::Command::Move(vec![(at("b.n"), session::Literal::Number(9.0))]))
        .expect("it goes as far as it can");
    assert_eq!((desk.number("b.n"), desk.number("b.total")), (3.0, 10.0));
}

#[test]
fn what_cannot_be_planned_for_a_count_is_told_where_an_edit_comes_to_it() {
    let mut desk = Desk::of(&LISTED.replace("constraint", "weak constraint"));
    assert_eq!(desk.wrong(), vec![]);
    desk.set("n", 9.0).expect("a weak rule may give way");
    assert_eq!(desk.wrong(), vec![("wrong-kind".into(), 4)]);
    desk.set("n", 3.0).expect("there are as many");
    assert_eq!(desk.wrong(), vec![]);
}

#[test]
fn what_cannot_be_planned_for_a_count_is_told_once() {
    let mut desk = Desk::of(&LISTED.replace("constraint", "weak constraint"));
    let told = |desk: &mut Desk| {
        let problems = desk.session.problems(desk.id).into_iter();
        problems.filter(|p| p.message.contains("no xs[4]")).count()
    };
    assert_eq!(told(&mut desk), 0);
    desk.set("n", 9.0).expect("a weak rule may give way");
    let all = desk.session.text(desk.id).diagnostics;
    assert_eq!(all.iter().filter(|d| d.message.contains("no xs[4]")).count(), 1);
    assert_eq!(told(&mut desk), 0, "it is said of the text already");
}

#[test]
fn to_give_nothing_up_leaves_a_count_that_does_not_settle_as_it_was_opened() {
    let mut desk = Desk::of(RESTLESS);
    let wrong = desk.session.problems(desk.id);
    desk.session.cancel(desk.id);
    assert_eq!(desk.session.problems(desk.id), wrong);
    desk.session.press(desk.id, &at("n")).expect("it can be dragged");
    desk.session.cancel(desk.id);
    assert_eq!(desk.session.problems(desk.id), wrong);
}

#[test]
fn a_computed_count_is_told_as_it_counts() {
    let mut desk = Desk::of(
        "half: Real = 20\nwidth: Real\nconstraint width = 2 * half\nrows: Real\n\
         constraint rows = (1..floor(width / 10)).count\n",
    );
    let change = desk.set("half", 25.0).expect("the rows follow");
    let said: Vec<&str> = change.modes.iter().map(|mode| mode.message.as_str()).collect();
    assert_eq!((said, desk.number("rows")), (vec!["width counts 5, not 4"], 5.0));
}

#[test]
fn what_counts_otherwise_in_a_drag_is_told_against_the_press() {
    let text = "n: Integer = 2\nw: Real\nconstraint w = 10 * n\nrows, sum: Real\n\
                constraint rows = (1..floor(w / 10)).count\nconstraint sum = (0..n).sum\n";
    for along in [&[4.0][..], &[3.0, 4.0], &[4.0, 4.1], &[6.0, 1.0, 4.0]] {
        let mut desk = Desk::of(text);
        let along: Vec<(f64, f64)> = along.iter().map(|&x| (x, 0.0)).collect();
        let state = desk.hold("n", &along);
        let said: Vec<String> = state.modes.into_iter().map(|mode| mode.message).collect();
        assert_eq!(
            (said.as_slice(), state.reached),
            (&["w counts 4, not 2".to_string()][..], true),
            "{along:?}"
        );
    }
}

#[test]
fn a_count_is_told_from_numbers_and_knows_its_range() {
    let desk = Desk::of(
        "use geometry\nclass Ladder {\n    n: Integer in 1..40 = 6\n    rungs: List of n Line\n    m: Integer = 2\n}\nladder: Ladder\n",
    );
    assert!(desk.session.is_count(desk.id, &at("ladder.n")));
    assert!(!desk.session.is_count(desk.id, &at("ladder.m")));
    assert_eq!(desk.row("ladder.n").range, Some((Some(1.0), Some(40.0))));
    assert_eq!(desk.row("ladder.m").range, None);
}
