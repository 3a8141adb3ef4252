//! Numbers typed into the text of a document that holds: followed, as where they are set.

use crate::desk::Desk;

/// A line that begins at a height, as long as it is said to be, drawn upwards.
fn line(length: f64, height: f64) -> String {
    format!(
        "use geometry
l: Line {{ p1 = (0, 0)  p2 = (30, 40) }}
length: Length = {length}
height: Length = {height}
constraint l.length = length {{ reads length }}
constraint l.p1.x = 0
constraint l.p1.y = height {{ reads height }}
constraint l.p2.x = 30
"
    )
}

/// A corner above two anchored ones, given a little above the line between them.
fn corner(b: &str) -> String {
    format!(
        "use geometry
a: Point = (0, 0)
b: Point = {b}
c: Point = (5, 0.25)
constraint left: a.distance(to: c) = 6
constraint right: b.distance(to: c) = 6
anchor a
anchor b
"
    )
}

#[test]
fn a_line_drawn_upwards_goes_on_upwards_whatever_is_typed() {
    let mut desk = Desk::of(&line(50.0, 0.0));
    assert!((desk.number("l.p2.y") - 40.0).abs() < 1e-9);
    for (length, height) in [(78.0, 0.0), (34.0, 0.0), (50.0, 0.0), (50.0, 200.0), (34.0, -300.0)] {
        let rise = (length * length - 900.0_f64).sqrt();
        let text = line(length, height);
        desk.type_text(&text);
        let up = desk.number("l.p2.y") - height;
        assert!((up - rise).abs() < 1e-6, "{length} from {height}: {up}, not {rise}");
        let again = Desk::of(&desk.text());
        assert_eq!(again.bits(), desk.bits(), "{length} from {height}, opened again");
        let bare = Desk::of(&text);
        let up = bare.number("l.p2.y") - height;
        assert!(
            (up - rise).abs() < 1e-6,
            "{length} from {height}, opened from what is typed: {up}"
        );
    }
}

#[test]
fn where_opening_would_flip_the_typed_number_is_followed_and_written() {
    let mut desk = Desk::of(&corner("(10, 0)"));
    assert!(desk.number("c.y") > 3.0);
    // from here the start of the corner lies below the line
    desk.type_text(&corner("(10, 2)"));
    let y = desk.number("c.y");
    let opened = Desk::of(&corner("(10, 2)"));
    assert!(opened.number("c.y") < 0.0, "opened it lies below: {}", opened.number("c.y"));
    assert!(y > 3.0, "it stays above: {y}; {}", desk.text());
    assert!(desk.text().contains("b: Point = (10, 2)"), "{}", desk.text());
    assert!(!desk.text().contains("(5, 0.25)"), "where it came to is written: {}", desk.text());
    assert_eq!(Desk::of(&desk.text()).bits(), desk.bits());
    desk.undo();
    assert_eq!(desk.text(), corner("(10, 0)"));
    assert!(desk.number("c.y") > 3.0);
}

#[test]
fn where_both_ways_agree_the_text_stays_as_it_was_typed() {
    let mut desk = Desk::of(&corner("(10, 0)"));
    desk.type_text(&corner("(9, 0)"));
    assert_eq!(desk.text(), corner("(9, 0)"));
    assert!(desk.number("c.y") > 3.0);
}

#[test]
fn what_cannot_be_followed_is_opened_and_says_so() {
    let mut desk = Desk::of(&corner("(10, 0)"));
    let text = corner("(100, 0)");
    desk.type_text(&text);
    assert_eq!(desk.text(), text);
    assert!(!desk.session.status(desk.id).satisfied);
}

#[test]
fn a_given_number_that_would_have_to_yield_is_told_of_and_not_rewritten() {
    let text = |a: f64| format!("a: Real = {a}\nb: Real = 2\nconstraint b = a + 1\n");
    let mut desk = Desk::of(&text(1.0));
    desk.type_text(&text(4.0));
    let opened = Desk::of(&text(4.0));
    assert_eq!(desk.moment(), opened.moment());
}
