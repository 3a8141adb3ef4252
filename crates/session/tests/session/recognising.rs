//! Recognition: which classes some parts could be the parts of.

use super::desk::{Desk, at};

const SHAPES: &str = "use geometry
class Corner { one, two: Line  merge one.p2 = two.p1 }
class Elbow is Corner { constraint even: one.length = two.length }
class Plumb is Corner { constraint square: one.p2.x = two.p2.x }
class Couple { first: HorizontalLine  second: Line }
a: Line { p1 = (0, 0)  p2 = (30, 40) }
b: Line { p1 = (30, 40)  p2 = (30, 90) }
far: Line { p1 = (500, 0)  p2 = (600, 0) }
level: HorizontalLine { p1 = (0, 7)  p2 = (9, 7) }
n: Real = 4
";

fn classes(desk: &Desk, paths: &[&str]) -> Vec<(String, u32)> {
    let paths: Vec<_> = paths.iter().map(|p| at(p)).collect();
    let found = desk.session.recognise(desk.id, &paths).expect("the parts are there");
    let own = found.into_iter().filter(|r| SHAPES.contains(&format!("class {} ", r.class)));
    own.map(|r| (r.class, r.constraints)).collect()
}

#[test]
fn a_class_is_recognised_by_what_is_true_of_its_parts() {
    let desk = Desk::of(SHAPES);
    let three = [("Elbow".to_string(), 2), ("Plumb".to_string(), 2), ("Corner".to_string(), 1)];
    // the order of selection does not matter: they are put where they fit
    assert_eq!(classes(&desk, &["a", "b"]), three);
    assert_eq!(classes(&desk, &["b", "a"]), three);
    let found = desk.session.recognise(desk.id, &[at("b"), at("a")]).unwrap();
    let elbow = found.iter().find(|r| r.class == "Elbow").expect("it is one");
    assert_eq!(elbow.parts, [("one".into(), "a".into()), ("two".into(), "b".into())]);
    let members = "elbow: Elbow\nmerge a = elbow.one\nmerge b = elbow.two\n";
    assert_eq!(elbow.members, members);
    assert_eq!(classes(&desk, &["a", "far"]), []);
    assert_eq!(classes(&desk, &["far", "level"]), [("Couple".to_string(), 0)]);
    assert_eq!(classes(&desk, &["n", "far"]), []);
}

#[test]
fn recognition_changes_nothing_and_refuses_what_it_cannot_ask() {
    let desk = Desk::of(SHAPES);
    let before = desk.moment();
    let refused = |paths: &[&str]| {
        let paths: Vec<_> = paths.iter().map(|p| at(p)).collect();
        desk.session.recognise(desk.id, &paths).unwrap_err().message
    };
    assert_eq!(refused(&[]), "select one to 6 parts; here are 0");
    assert_eq!(refused(&["a"; 7]), "select one to 6 parts; here are 7");
    assert_eq!(refused(&["a", "a"]), "a is selected twice");
    assert_eq!(refused(&["a", "nothing"]), "there is no nothing here");
    assert_eq!(desk.moment(), before);
}

#[test]
fn a_line_that_runs_the_other_way_is_recognised_too() {
    let mut desk = Desk::of(&SHAPES.replace(
        "b: Line { p1 = (30, 40)  p2 = (30, 90) }",
        "b: Line { p1 = (30, 90)  p2 = (30, 40) }",
    ));
    let found = desk.session.recognise(desk.id, &[at("a"), at("b")]).expect("they are there");
    let elbow = found.iter().find(|r| r.class == "Elbow").expect("it is one");
    let members =
        "elbow: Elbow\nmerge a = elbow.one\nmerge b.p1 = elbow.two.p2\nmerge b.p2 = elbow.two.p1\n";
    assert_eq!(elbow.members, members);
    let command =
        session::Command::Edit { target: session::Path::default(), members: members.into() };
    desk.apply(&command).expect("it can be said");
    assert_eq!(desk.place("b.p1"), (30.0, 90.0), "{}", desk.text());
    assert!(desk.session.status(desk.id).satisfied);
}

#[test]
fn a_disc_is_not_recognised_with_its_rim_as_its_centre() {
    let text = |first: &str, second: &str| {
        format!(
            "use geometry
class Disc {{ center: Point  rim: Point }}
class Chain {{ one, two: Disc  constraint touching: one.rim.x = two.center.x }}
a: Disc {{ center = {first}  rim = {second} }}
b: Disc {{ center = (30, 0)  rim = (50, 0) }}
"
        )
    };
    let found = |desk: &Desk| {
        let found = desk.session.recognise(desk.id, &[at("a"), at("b")]).expect("they are there");
        found.into_iter().find(|r| r.class == "Chain").map(|r| r.members)
    };
    let members = "chain: Chain\nmerge a = chain.one\nmerge b = chain.two\n";
    assert_eq!(found(&Desk::of(&text("(0, 0)", "(30, 40)"))), Some(members.into()));
    assert_eq!(found(&Desk::of(&text("(30, 40)", "(0, 0)"))), None);
}

#[test]
fn a_class_with_a_parameter_is_recognised_in_parts_of_another_size() {
    let mut desk = Desk::of(
        "use geometry
unit mm
class Elbow {
    side, turn: Length = 20
    a, b: Line
    merge a.p2 = b.p1
    constraint a.length = side
    constraint turn = 2 * side
    constraint b.length = turn
    constraint a.horizontal
}
k: Line { p1 = (0, 0)  p2 = (30, 0) }
l: Line { p1 = (30, 0)  p2 = (30, 60) }
",
    );
    let found = desk.session.recognise(desk.id, &[at("l"), at("k")]).expect("they are there");
    let elbow = found.iter().find(|r| r.class == "Elbow").expect("it is one with a side of 30");
    let said = "elbow: Elbow { side = 30; turn = 60 }\nmerge k = elbow.a\nmerge l = elbow.b\n";
    assert_eq!(elbow.members, said);
    let members = elbow.members.clone();
    desk.apply(&session::Command::Edit { target: session::Path::default(), members })
        .expect("it can be made one");
    assert_eq!(desk.place("l.p2"), (30.0, 60.0));
    assert_eq!(desk.wrong(), []);
    // a dimension is no more than its value: everything would be one
    let alone = desk.session.recognise(desk.id, &[at("k")]).expect("it is there");
    assert!(alone.iter().all(|r| r.class != "LineLength"), "{alone:?}");
}
