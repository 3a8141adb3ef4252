//! Undo and redo: every step comes back bit for bit, whatever kind it was.

use crate::desk::{Desk, at, gallery};
use session::Command;

#[test]
fn a_released_drag_is_one_step() {
    let mut desk = Desk::of(&gallery("quadrilateral"));
    let before = desk.moment();
    let many: Vec<(f64, f64)> = (0..30).map(|i| (445.0 + f64::from(i), 144.0)).collect();
    let change = desk.drag("q.outer.side3.p1", &many);
    assert_eq!(change.label, "move q.outer.side3.p1");
    assert_eq!(desk.undo_label().as_deref(), Some("move q.outer.side3.p1"));
    let after = desk.moment();
    desk.undo();
    assert_eq!(desk.moment(), before);
    assert_eq!(desk.undo_label(), None);
    desk.redo();
    assert_eq!(desk.moment(), after);
}

#[test]
fn nothing_is_written_before_the_release() {
    let mut desk = Desk::of(&gallery("quadrilateral"));
    let text = desk.text();
    desk.hold("q.outer.side3.p1", &[(465.0, 164.0)]);
    assert_eq!(desk.text(), text);
    assert_eq!(desk.number("q.outer.side2.p2.x"), 465.0);
    assert_eq!(desk.undo_label(), None);
}

#[test]
fn a_cancelled_drag_never_was() {
    let mut desk = Desk::of(&gallery("quadrilateral"));
    let before = desk.moment();
    desk.hold("q.inner.side3.p1", &[(394.0, 228.0), (1e6, -3.0)]);
    assert_ne!(desk.bits(), before.1);
    desk.session.cancel(desk.id);
    assert_eq!((desk.moment(), desk.undo_label()), (before, None));
}

#[test]
fn a_drag_out_and_back_changes_nothing() {
    let mut desk = Desk::of(&gallery("quadrilateral"));
    let before = desk.moment();
    let change = desk.drag("q.outer.side3.p1", &[(500.0, 200.0), (400.0, 0.0), (445.0, 144.0)]);
    assert_eq!((change.edits.len(), desk.moment()), (0, before));
}

#[test]
fn every_kind_of_step_comes_back() {
    let mut desk = Desk::of("use geometry\n// two lines\na: Line { p2 = (9, 9) }\nb: Line\n");
    type Act = fn(&mut Desk);
    let acts: [Act; 7] = [
        |d| drop(d.move_to("a.p1", 1.0, 2.0).expect("free")),
        |d| drop(d.apply(&Command::Merge(vec![at("a.p2"), at("b.p1")])).expect("both are points")),
        |d| drop(d.drag("b.p1", &[(20.0, 20.0), (30.0, 10.0)])),
        |d| drop(d.apply(&Command::Anchor { path: at("a.p1"), held: true }).expect("a place")),
        |d| d.type_text(&d.text().replace("// two lines", "// two lines, joined")),
        |d| drop(d.apply(&Command::Unmerge(at("b.p1"))).expect("it is merged")),
        |d| d.type_text(&format!("{}c: Real = 1 +\n", d.text())),
    ];
    let mut moments = vec![desk.moment()];
    for act in acts {
        act(&mut desk);
        moments.push(desk.moment());
    }
    for round in 0..2 {
        for moment in moments.iter().rev().skip(1) {
            desk.undo();
            assert_eq!(desk.moment(), *moment, "round {round}");
        }
        for moment in moments.iter().skip(1) {
            desk.redo();
            assert_eq!(desk.moment(), *moment, "round {round}");
        }
    }
}

#[test]
fn an_unmerged_part_keeps_its_place() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (9, 9) }\nb: Line { p1 = (5, 5)  p2 = (30, 0) }\nmerge a.p2 = b.p1\n",
    );
    assert_eq!(desk.row("a.p2.x").number, Some(9.0));
    desk.apply(&Command::Unmerge(at("b.p1"))).expect("it is merged");
    assert_eq!((desk.number("a.p2.x"), desk.number("b.p1.x")), (9.0, 9.0));
    assert_eq!((desk.number("a.p2.y"), desk.number("b.p1.y")), (9.0, 9.0));
    assert_eq!(
        desk.text(),
        "use geometry\na: Line { p1 = (0, 0)  p2 = (9, 9) }\nb: Line { p1 = (9, 9)  p2 = (30, 0) }\n"
    );
}

#[test]
fn what_a_deleted_part_held_stays_where_it_was() {
    let mut desk = Desk::of("a: Real = 1\nb: Real\nc: Real\nconstraint b = a + 2\n");
    desk.apply(&Command::Delete(at("a"))).expect("nothing forbids it");
    assert_eq!(desk.text(), "b: Real = 3\nc: Real\n");
    desk.undo();
    assert_eq!(desk.number("a"), 1.0);
}

#[test]
fn a_new_step_ends_what_could_be_redone() {
    let mut desk = Desk::of("a: Real = 1\n");
    desk.set("a", 2.0).expect("free");
    desk.undo();
    desk.set("a", 3.0).expect("free");
    assert_eq!(desk.session.status(desk.id).redo, None);
    desk.undo();
    assert_eq!(desk.text(), "a: Real = 1\n");
}

#[test]
fn what_gave_way_to_a_merge_keeps_its_value_when_it_is_parted() {
    let sum = "class Sum { a: Real = 1  b: Real = 2  c: Real  constraint c = a + b }\n";
    let mut desk = Desk::of(&format!("{sum}p: Sum {{ a = 10 }}\nq: Sum {{ a = 1 }}\nfree: Sum\n"));
    desk.apply(&Command::Merge(vec![at("p.c"), at("q.a")])).expect("both are numbers");
    let merged: Vec<f64> = ["p.a", "p.b", "p.c"].iter().map(|path| desk.number(path)).collect();
    assert_ne!(merged[..2], [10.0, 2.0], "something has to give way");
    let change = desk.apply(&Command::Unmerge(at("q.a"))).expect("it is merged");
    assert_eq!([desk.number("p.a"), desk.number("p.b"), desk.number("q.a")], merged[..]);
    assert!((desk.number("p.c") - merged[2]).abs() < 1e-12, "it is computed from what stays");
    assert_eq!(change.label, "unmerge q.a");
    // what is given by a class is written for the thing, and what had no part in it is not
    let [a, b, c] = merged[..] else { unreachable!() };
    let text = format!("{sum}p: Sum {{ a = {a}  b = {b} }}\nq: Sum {{ a = {c} }}\nfree: Sum\n");
    let plain =
        |text: &str| text.replace(';', " ").split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(plain(&desk.text()), plain(&text));
    desk.undo();
    assert_eq!(desk.number("p.c"), merged[2]);
}

#[test]
fn the_undo_list_calls_a_place_by_its_name() {
    let mut desk = Desk::of("class Spot { x, y: Length = 0  size: Length = 3 }\ns: Spot\n");
    let change = desk.move_to("s", 4.0, 5.0).expect("nothing holds it");
    assert_eq!(change.label, "move s");
    assert_eq!((desk.number("s.x"), desk.number("s.size")), (4.0, 3.0));
}

#[test]
fn a_whole_is_parted_whose_parts_are_one() {
    let classes = "class Spot { x: Real = 3  y: Real = 4 }\nclass Bar { p, q: Spot }\n";
    let bars =
        "a: Bar { p = (1, 2)  q = (5, 6)  merge p = q }\nb: Bar { p = (7, 8)  q = (9, 9) }\n";
    let mut desk = Desk::of(&format!("{classes}{bars}merge a = b\n"));
    desk.apply(&Command::Unmerge(at("b"))).expect("it is merged");
    assert_eq!([desk.number("b.p.x"), desk.number("b.q.y")], [1.0, 2.0]);
    desk.undo();
    desk.apply(&Command::Unmerge(at("a"))).expect("it is merged");
    assert_eq!([desk.number("a.p.x"), desk.number("b.q.x"), desk.number("b.p.y")], [1.0, 1.0, 2.0]);
}

#[test]
fn what_is_added_is_undone_by_its_name() {
    let mut desk = Desk::of("use geometry\nbeam: Line { p1 = (0, 0)  p2 = (0, 30) }\n");
    for (members, label) in [
        ("line: Line { p1 = (0, 0)  p2 = (40, 0) }\nconstraint line.p1.y = line.p2.y", "add line"),
        ("constraint line.length = 50", "constrain line.length = 50"),
        ("merge line.p1 = beam.p1", "merge line.p1 = beam.p1"),
        ("use circuits", "use circuits"),
    ] {
        let command =
            Command::Edit { target: session::Path::default(), members: String::from(members) };
        desk.apply(&command).unwrap_or_else(|refused| panic!("{members}: {refused:?}"));
        assert_eq!(desk.undo_label().as_deref(), Some(label), "{members}");
    }
    assert_eq!(desk.undo_label().as_deref(), Some("use circuits"));
}

#[test]
fn several_that_are_deleted_are_undone_by_their_names() {
    let mut desk = Desk::of("use geometry\na: Point = (1, 2)\nb: Point = (3, 4)\nc: Point\n");
    let (command, _) =
        desk.session.deletion(desk.id, &[at("a"), at("b")]).expect("nothing needs them");
    desk.apply(&command).expect("they can go");
    assert_eq!(desk.undo_label().as_deref(), Some("delete a, b"));
}

#[test]
fn an_edit_of_the_text_is_called_by_what_came_only_where_nothing_else_changed() {
    let text = "use geometry\na: Circle { radius = 30 }\nb: Point = (1, 2)\nc: Point\n";
    for (typed, label) in [
        (format!("{text}p: Point\n"), "add p"),
        (text.replace("b: Point", "p: Point\nb: Point") + "q: Point\n", "add p, q"),
        (text.replace("radius = 30", "radius = 50") + "p: Point\n", "edit text"),
        (text.replace("radius = 30", "radius = 305") + "p: Point\n", "edit text"),
        (text.replace("c: Point\n", ""), "delete c"),
        (text.replace("b: Point = (1, 2)\n", "").replace("30", "31"), "edit text"),
        (text.replace("c: Point", "d: Point"), "edit text"),
    ] {
        let mut desk = Desk::of(text);
        desk.type_text(&typed);
        assert_eq!(desk.undo_label().as_deref(), Some(label), "{typed}");
        desk.undo();
        assert_eq!(desk.text(), text);
    }
}

#[test]
fn two_that_are_deleted_apart_are_undone_by_their_names() {
    let mut desk = Desk::of("use geometry\na: Point\nb: Point\nc: Point\n");
    let (command, _) =
        desk.session.deletion(desk.id, &[at("a"), at("c")]).expect("nothing needs them");
    desk.apply(&command).expect("they can go");
    assert_eq!(desk.undo_label().as_deref(), Some("delete a, c"));
}

#[test]
fn a_constraint_without_a_name_is_told_by_what_it_says_in_the_list_of_steps() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (30, 40) }\nconstraint a.length = 50\nconstraint level: a.horizontal\n",
    );
    let label = |desk: &Desk| desk.undo_label();
    let off = |path: &str| Command::Enable { path: at(path), on: false };
    desk.apply(&off("constraint1")).expect("it can be off");
    assert_eq!(label(&desk).as_deref(), Some("switch “length of a = 50” off"));
    desk.apply(&off("level")).expect("it can be off");
    assert_eq!(label(&desk).as_deref(), Some("switch level off"));
}
