//! Commands that change structure: of one thing, of a class and all its things.

use super::desk::{Desk, at, edited};
use session::{Command, Path};

const STRUTS: &str = "use geometry
class Strut is Line {
    size: Length = 80
    constraint rigid: length = size
}
a: Strut { p1 = (0, 0)  p2 = (80, 0) }
b: Strut { p1 = (100, 0)  p2 = (180, 0) }
";

fn edit(target: &str, members: &str) -> Command {
    let target = if target.is_empty() { Path::default() } else { at(target) };
    Command::Edit { target, members: members.into() }
}

#[test]
fn an_edit_of_a_class_reaches_every_thing_of_it() {
    let mut desk = Desk::of(STRUTS);
    let before = desk.moment();
    let change = desk.apply(&edit("Strut", "constraint low: p1.y = 5")).expect("it can be said");
    assert_eq!(change.class.as_deref(), Some("Strut"));
    assert_eq!((change.class_of_one, change.unsatisfied), (None, vec![]));
    assert_eq!((desk.number("a.p1.y"), desk.number("b.p1.y")), (5.0, 5.0));
    desk.undo();
    assert_eq!(desk.moment(), before);
}

#[test]
fn an_edit_of_one_thing_asks_first_and_leaves_the_others() {
    let mut desk = Desk::of(STRUTS);
    let command = edit("a", "constraint low: p1.y = 5");
    let question = desk.session.preview(desk.id, &command).unwrap().expect("there is a question");
    assert_eq!(question.message, "edit a: for a alone, or for every Strut (2 here)?");
    let labels: Vec<&str> = question.choices.iter().map(|c| c.label.as_str()).collect();
    assert_eq!(labels, ["only a", "every Strut"]);
    assert_eq!(question.choices[1].command, edit("Strut", "constraint low: p1.y = 5"));
    let change = desk.apply(&command).expect("it can be said");
    assert_eq!(change.class_of_one.as_deref(), Some("a"));
    assert_eq!((desk.number("a.p1.y"), desk.number("b.p1.y")), (5.0, 0.0));
    // it is one already: there is nothing to ask any more
    let again = desk.session.preview(desk.id, &edit("a", "n: Real")).unwrap();
    assert_eq!(again, None);
}

#[test]
fn what_belongs_to_the_class_is_refused_with_the_way_out() {
    let mut desk = Desk::of(STRUTS);
    let before = desk.moment();
    let refusal = desk.apply(&Command::Delete(at("a.size"))).unwrap_err();
    assert_eq!(refusal.repairs, ["delete Strut.size"]);
    assert_eq!(desk.moment(), before);
    let question = desk.session.preview(desk.id, &Command::Delete(at("a.size")));
    let question = question.unwrap().expect("there is a question");
    let change = desk.apply(&question.choices[0].command).expect("nothing else speaks of it");
    assert_eq!(change.along, ["constraint rigid: length = size"]);
    assert!(!desk.text().contains("size"));
}

#[test]
fn things_that_cannot_be_satisfied_are_told() {
    let mut desk = Desk::of(&format!("{STRUTS}c: Strut {{ constraint long: length = 100 }}\n"));
    let told = desk.apply(&edit("Strut", "constraint big: size = 80")).expect("it can be said");
    assert_eq!(told.unsatisfied, ["c.rigid", "c.long"]);
    desk.undo();
    assert!(desk.session.status(desk.id).satisfied);
}

/// Returns true for a part that is merged with none before it.
fn is_of_its_own(desk: &Desk, path: &str) -> bool {
    desk.session.values(desk.id).iter().any(|row| row.path == path)
}

#[test]
fn a_merge_within_one_thing_changes_that_alone() {
    let mut desk = Desk::of("use geometry\nclass Pair { a, b: Line }\np: Pair\nq: Pair\n");
    let merge = Command::Merge(vec![at("p.a.p2"), at("p.b.p1")]);
    let change = desk.apply(&merge).expect("they can be merged");
    assert_eq!(change.class_of_one.as_deref(), Some("p"));
    assert!(desk.text().contains("p: Pair { merge a.p2 = b.p1 }"));
    assert!(!is_of_its_own(&desk, "p.b.p1.x") && is_of_its_own(&desk, "q.b.p1.x"));
    let all = Command::Merge(vec![at("Pair.a.p2"), at("Pair.b.p1")]);
    desk.undo();
    desk.apply(&all).expect("they can be merged in the class");
    assert!(!is_of_its_own(&desk, "p.b.p1.x") && !is_of_its_own(&desk, "q.b.p1.x"));
}

#[test]
fn an_inherited_merge_is_undone_at_one_thing_and_every_path_keeps_its_place() {
    let text = "use geometry\nclass Pair { a, b: Line  merge joint: a.p2 = b.p1 }\np: Pair { a.p2 = (7, 9) }\nq: Pair\n";
    let mut desk = Desk::of(text);
    assert!(!is_of_its_own(&desk, "p.b.p1.x"));
    desk.apply(&Command::Unmerge(at("p.b.p1"))).expect("it can be taken out");
    assert!(desk.text().contains("without joint"), "{}", desk.text());
    assert_eq!((desk.number("p.b.p1.x"), desk.number("p.b.p1.y")), (7.0, 9.0));
    desk.move_to("p.a.p2", 1.0, 2.0).expect("it is free");
    assert_eq!(desk.number("p.b.p1.x"), 7.0);
}

#[test]
fn a_change_is_several_small_stretches() {
    let mut desk = Desk::of("a: Real = 1\nb: Real = 2\nc: Real = 3\nconstraint c = a + 2\n");
    let text = desk.text();
    let change = desk.apply(&Command::Rename { from: at("a"), to: "first".into() }).unwrap();
    assert_eq!(change.edits.len(), 2, "{:?}", change.edits);
    assert_eq!(edited(&text, &change), desk.text());
}

#[test]
fn a_name_in_a_branch_that_no_turn_takes_is_renamed_with_its_part() {
    let mut desk = Desk::of(
        "a: Real = 1\nb: Real = 2\ny: List of 3 Real\n\
         for i in 0..2 { constraint y[i] = if i = 5 then a else b }\n",
    );
    desk.apply(&Command::Rename { from: at("a"), to: "first".into() }).expect("it is free");
    assert!(desk.text().contains("if i = 5 then first else b"), "{}", desk.text());
}

#[test]
fn a_constraint_is_switched_off_and_on_and_values_stay() {
    let mut desk = Desk::of("a: Real = 3\nb: Real\nconstraint twice: b = 2 * a\n");
    let before = desk.moment();
    let enable = |on| Command::Enable { path: at("twice"), on };
    let change = desk.apply(&enable(false)).expect("it can be switched off");
    assert_eq!(change.class_of_one, None);
    assert_eq!(desk.number("b"), 6.0);
    desk.set("a", 5.0).expect("nothing holds it");
    assert_eq!(desk.number("b"), 6.0);
    let row = desk.session.structure(desk.id).into_iter().find(|r| r.path == "twice");
    let row = row.expect("it is still there");
    assert_eq!((row.enabled, row.value.as_deref()), (false, Some("off")));
    desk.apply(&enable(true)).expect("it can be switched on");
    assert!(desk.session.status(desk.id).satisfied);
    for _ in 0..3 {
        desk.undo();
    }
    assert_eq!(desk.moment(), before);
}

#[test]
fn places_that_a_switch_moved_are_given_where_they_are_seen() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\nconstraint short: a.length = 100\n\
         constraint long: a.p1.distance(to: a.p2) = 120\n",
    );
    desk.apply(&Command::Enable { path: at("short"), on: false }).expect("it is switched off");
    assert!(desk.text().contains("p2 = (120, 0)"), "{}", desk.text());
    desk.apply(&Command::Enable { path: at("long"), on: false }).expect("it is switched off");
    desk.apply(&Command::Enable { path: at("short"), on: true }).expect("it is switched on");
    assert!(desk.text().contains("p2 = (100, 0)"), "{}", desk.text());
}

#[test]
fn a_merge_within_one_of_several_things_asks_first() {
    let text = "use geometry\nclass Pair { a, b: Line }\np: Pair\nq: Pair\n";
    let mut desk = Desk::of(text);
    let merge = Command::Merge(vec![at("p.a.p2"), at("p.b.p1")]);
    let question = desk.session.preview(desk.id, &merge).unwrap().expect("there is a question");
    let labels: Vec<&str> = question.choices.iter().map(|c| c.label.as_str()).collect();
    assert_eq!(labels, ["only p", "every Pair"]);
    assert_eq!(desk.text(), text);
    desk.apply(&question.choices[1].command).expect("they can be merged in the class");
    assert!(!is_of_its_own(&desk, "p.b.p1.x") && !is_of_its_own(&desk, "q.b.p1.x"));
    desk.undo();
    // one undo step, with what it implies
    desk.apply(&question.choices[0].command).expect("they can be merged in the thing");
    assert!(!is_of_its_own(&desk, "p.b.p1.x") && is_of_its_own(&desk, "q.b.p1.x"));
    desk.undo();
    assert_eq!(desk.text(), text);
}

#[test]
fn what_a_part_names_is_set_by_its_path() {
    let text = "class Box { n: Real }\na: Box { n = 1 }\nb: Box { n = 2 }\nq: Path to Box = a\nm: Real\nconstraint m = q.n\nt: Text\n";
    let mut desk = Desk::of(text);
    assert_eq!(desk.number("m"), 1.0);
    let change = desk.type_in("q", "b").expect("it is a box");
    assert_eq!(change.edits.len(), 1);
    assert_eq!(desk.text(), text.replace("= a\n", "= b\n"));
    assert_eq!(desk.number("m"), 2.0);
    let moment = desk.moment();
    for wrong in ["c", "t", "a.n", "7"] {
        assert!(desk.type_in("q", wrong).is_err(), "{wrong}");
        assert_eq!(desk.moment(), moment);
    }
    desk.undo();
    assert_eq!(desk.text(), text);
    assert_eq!(desk.number("m"), 1.0);
}
