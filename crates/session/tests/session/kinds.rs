//! Classes grown by hand: a kind of a thing, which inherits; and what one thing has of its own, said of every one.

use crate::desk::{Desk, at};
use session::view::RowKind;

const STRUTS: &str = "use geometry
class Strut {
    line: Line { p1 = (0, 0)  p2 = (100, 0) }
    attachers line.p1, line.p2
}
a: Strut
b: Strut { line.p1 = (0, 200)  line.p2 = (100, 200) }
constraint b.line.p1.y = b.line.p2.y
";

#[test]
fn a_kind_of_a_thing_inherits_and_says_what_was_said_of_it_alone() {
    let mut desk = Desk::of(STRUTS);
    let kind = desk.session.kind_of(desk.id, &at("b"), "LevelStrut").expect("it can be a class");
    desk.apply(&kind).expect("it can be kept");
    assert_eq!(
        desk.text(),
        "use geometry
class Strut {
    line: Line { p1 = (0, 0)  p2 = (100, 0) }
    attachers line.p1, line.p2
}
a: Strut
class LevelStrut is Strut {
    constraint line.p1.y = line.p2.y
}

b: LevelStrut {
    line.p1 = (0, 200)
    line.p2 = (100, 200)
}
"
    );
    assert_eq!(desk.wrong(), []);
    assert_eq!(desk.session.status(desk.id).freedom, 7);
    // one of the same kind is level, too
    let another = desk.session.insertion(desk.id, "LevelStrut").expect("it is in the bin");
    desk.apply(&another).expect("there is room");
    assert_eq!(desk.session.status(desk.id).freedom, 10);
    // a kind of a thing that has nothing of its own
    let plain = desk.session.kind_of(desk.id, &at("a"), "OtherStrut").expect("it can be a class");
    desk.apply(&plain).expect("it can be kept");
    assert!(
        desk.text().contains("class OtherStrut is Strut\n\na: OtherStrut\n"),
        "{}",
        desk.text()
    );
    let why = |path: &str, class: &str| {
        desk.session.kind_of(desk.id, &at(path), class).map_err(|refusal| refusal.message)
    };
    assert_eq!(why("b.line", "X"), Err("b.line is a part: choose the whole".into()));
    assert_eq!(why("b", "Strut"), Err("there is a class Strut already".into()));
}

#[test]
fn a_rule_of_one_thing_becomes_that_of_every_one() {
    let mut desk = Desk::of(STRUTS);
    let rows = desk.session.structure(desk.id);
    let rule = rows.iter().find(|row| row.kind == RowKind::Constraint).expect("a rule");
    let every = desk.session.of_every(desk.id, &at(&rule.path)).expect("it can be said of all");
    desk.apply(&every).expect("it can be kept");
    let text = desk.text();
    assert!(text.contains("    constraint line.p1.y = line.p2.y\n}"), "{text}");
    assert!(!text.contains("constraint b."), "{text}");
    assert_eq!(desk.session.status(desk.id).freedom, 6);
    assert_eq!(desk.wrong(), []);

    // a part that one thing has of its own, with what it says of it
    let mut desk = Desk::of(&STRUTS.replace(
        "constraint b.line.p1.y = b.line.p2.y\n",
        "c: Strut {\n    middle: Point\n    constraint middle = line.midpoint\n}\n",
    ));
    let every = desk.session.of_every(desk.id, &at("c.middle")).expect("it can be of all");
    desk.apply(&every).expect("it can be kept");
    assert_eq!(desk.wrong(), []);
    let rows = desk.session.structure(desk.id);
    assert!(rows.iter().any(|row| row.path == "a.middle"), "{}", desk.text());
    assert!(desk.text().contains("    constraint middle = line.midpoint\n"), "{}", desk.text());

    // of a class of a library nothing can be said here
    let desk = Desk::of("use geometry\na: Line\nconstraint a.length = 3\n");
    let rows = desk.session.structure(desk.id);
    let rule = rows.iter().rfind(|row| row.kind == RowKind::Constraint).expect("a rule");
    let why = desk.session.of_every(desk.id, &at(&rule.path)).map_err(|refusal| refusal.message);
    assert_eq!(why, Err("a is a Line, which this document does not declare".into()));
}
