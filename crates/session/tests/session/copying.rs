//! Copies, and several things at once: relations kept or cut, dragged together, deleted together.

use crate::desk::{Desk, at};
use session::{Command, Relations};

fn holds(desk: &Desk) {
    let status = desk.session.standing(desk.id);
    assert!(status.satisfied, "{}", status.message);
}

/// What a value is, by any of its paths.
fn shown(desk: &Desk, path: &str) -> String {
    desk.session.shown_value(desk.id, &at(path)).expect("it has a value")
}

#[test]
fn a_copy_has_the_values_of_its_model_and_shares_nothing() {
    let mut desk = Desk::of(
        "use circuits\n/// The load.\nload: Resistor { a.node.at = (0, 0)  b.node.at = (0, 100)  resistance = 50 ohm }\n",
    );
    let copied = copy(&desk, &["load"], Relations::Own).expect("it stands alone");
    assert_eq!(copied.1, ["resistor"]);
    desk.apply(&copied.0).expect("it can be made");
    holds(&desk);
    assert_eq!(shown(&desk, "resistor.resistance"), "50 ohm");
    assert_eq!(desk.place("resistor.b.node.at"), (20.0, 120.0));
    desk.type_in("resistor.resistance", "70 ohm").expect("it is its own");
    assert_eq!(shown(&desk, "load.resistance"), "50 ohm");
    let part = copy(&desk, &["load.a"], Relations::Own).expect_err("it is a part");
    assert_eq!(part, "load.a is a part: copy the whole that it is a part of");
}

/// A corner of three lines: level, upright, and one that holds on to them.
const HOOK: &str = "use geometry\na: Line { p1 = (0, 0)  p2 = (90, 0) }\nb: Line { p2 = (90, 60) }\nmerge a.p2 = b.p1\nconstraint a.p1.y = a.p2.y\nconstraint a.length = 90\nc: Line { p2 = (0, 60) }\nmerge a.p1 = c.p1\n";

fn copy(
    desk: &Desk,
    names: &[&str],
    relations: Relations,
) -> Result<(Command, Vec<String>), String> {
    let paths: Vec<_> = names.iter().map(|name| at(name)).collect();
    let clip = desk.session.copied(desk.id, &paths, relations).map_err(|r| r.message)?;
    desk.session.pasting(desk.id, &clip, 1).map_err(|r| r.message)
}

#[test]
fn what_is_copied_together_keeps_what_is_said_between_it_and_leaves_the_rest() {
    let mut desk = Desk::of(HOOK);
    let (command, names) = copy(&desk, &["a", "b"], Relations::Own).expect("they stand together");
    assert_eq!(names, ["line", "line2"]);
    desk.apply(&command).expect("they can be made");
    holds(&desk);
    assert_eq!(desk.place("line.p1"), (20.0, 20.0));
    assert_eq!(desk.place("line2.p2"), (110.0, 80.0));
    let text = desk.text();
    assert!(text.contains("merge line.p2 = line2.p1"), "{text}");
    assert!(text.contains("constraint line.p1.y = line.p2.y"), "{text}");
    assert!(!text.contains("merge line.p1"), "c is not copied: {text}");
    // a, b and c are as they were, and the copies are free of them
    assert_eq!(desk.place("c.p1"), (0.0, 0.0));
    desk.apply(&Command::Undo).expect("one step");
    assert_eq!(desk.text(), HOOK);
}

#[test]
fn a_copy_with_its_relations_is_joined_to_what_its_model_is_joined_to() {
    let mut desk = Desk::of(HOOK);
    let (command, names) = copy(&desk, &["b"], Relations::All).expect("a stays");
    desk.apply(&command).expect("it can be made");
    holds(&desk);
    assert!(desk.text().contains(&format!("merge a.p2 = {}.p1", names[0])), "{}", desk.text());
    assert_eq!(desk.place(&format!("{}.p1", names[0])), (90.0, 0.0));
    assert_eq!(desk.place("a.p2"), (90.0, 0.0));
}

#[test]
fn a_copy_that_speaks_of_what_is_not_copied_is_refused_and_says_so() {
    let desk =
        Desk::of("use geometry\na: Line { p2 = (30, 0) }\nr: Circle { radius = a.length / 2 }\n");
    let refused = copy(&desk, &["r"], Relations::Own).expect_err("a is not copied");
    assert!(refused.starts_with("the copy speaks of what is not copied"), "{refused}");
    assert!(copy(&desk, &["r"], Relations::All).is_ok());
    assert!(copy(&desk, &["a", "r"], Relations::Own).is_ok());
    assert_eq!(copy(&desk, &[], Relations::Own), Err("nothing is selected".into()));
}

#[test]
fn a_copy_of_what_is_partly_locked_keeps_its_form() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (90, 0) }\nb: Line { p2 = (90, 60) }\nmerge a.p2 = b.p1\n\
         c: Line\nmerge c.p1 = b.p2\nmerge c.p2 = a.p1\nanchor a\nanchor b.p2.x\n",
    );
    let (command, names) =
        copy(&desk, &["a", "b", "c"], Relations::Own).expect("they stand together");
    desk.apply(&command).expect("they can be made");
    holds(&desk);
    let [a, b, _] = &names[..] else { panic!("three copies") };
    let place = |path: String| ["x", "y"].map(|part| desk.number(&format!("{path}.{part}")));
    let places = [format!("{a}.p1"), format!("{a}.p2"), format!("{b}.p2")].map(place);
    assert_eq!(places, [[20.0, 20.0], [110.0, 20.0], [110.0, 80.0]], "{}", desk.text());
    assert!(desk.text().contains(&format!("anchor {a}")), "{}", desk.text());
}

#[test]
fn copies_are_put_down_in_another_document_under_free_names() {
    let one = Desk::of(HOOK);
    let clip = one.session.copied(one.id, &[at("a"), at("b")], Relations::Own).expect("a clip");
    let mut other = Desk::of("use geometry\na: Point\n");
    let (command, names) =
        other.session.pasting(other.id, &clip, 0).expect("its classes are there");
    assert_eq!(names, ["line", "b"]);
    other.apply(&command).expect("they can be made");
    assert_eq!(other.place("b.p1"), (90.0, 0.0));
}

#[test]
fn several_things_are_dragged_as_one_in_one_step() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (50, 0) }\nk: Circle { center = (10, 40)  radius = 7 }\np: Point { x = 90  y = 90 }\nn: Real = 3\n",
    );
    let handle = desk.session.press_all(desk.id, &[at("k"), at("a")]).expect("both have places");
    assert_eq!(handle, (10.0, 40.0));
    assert!(desk.session.drag(desk.id, (30.0, 35.0)).reached);
    let change = desk.session.release(desk.id).expect("it is kept");
    assert!(!change.edits.is_empty());
    assert_eq!(
        [desk.place("k.center"), desk.place("a.p1"), desk.place("a.p2"), desk.place("p")],
        [(30.0, 35.0), (20.0, -5.0), (70.0, -5.0), (90.0, 90.0)]
    );
    assert_eq!(desk.session.history(desk.id).0, ["move k, a"]);
    let refused = desk.session.press_all(desk.id, &[at("k"), at("n")]).expect_err("a number");
    assert_eq!(refused.message, "n has no place of its own: it is not dragged with others");
}

#[test]
fn several_things_are_deleted_with_what_speaks_of_them() {
    let mut desk = Desk::of(HOOK);
    let (command, along) =
        desk.session.deletion(desk.id, &[at("a"), at("b")]).expect("they can go");
    assert_eq!(along.len(), 4, "{along:?}");
    desk.apply(&command).expect("it is a text");
    assert_eq!(desk.text(), "use geometry\nc: Line { p2 = (0, 60)  p1 = (0, 0) }\n");
}

#[test]
fn a_copy_is_a_text_that_another_document_can_take() {
    let desk = Desk::of(HOOK);
    let paths = [at("a"), at("b")];
    let clip = desk.session.copied(desk.id, &paths, Relations::Own).expect("they stand together");
    let written = clip.written();
    assert!(written.starts_with("use geometry\na: Line {"), "{written}");
    // elsewhere what it uses comes along, once
    let mut other = Desk::of("x: Real = 3\n");
    let read = other.session.copies_in(other.id, &written).expect("it says something of things");
    let (command, names) = other.session.pasting(other.id, &read, 1).expect("it can stand there");
    assert_eq!(names, ["a", "b"]);
    other.apply(&command).expect("it can be made");
    holds(&other);
    assert_eq!(other.wrong(), []);
    let text = other.text();
    assert!(text.contains("merge a.p2 = b.p1") && text.contains("x: Real = 3"), "{text}");
    let (command, _) = other.session.pasting(other.id, &read, 2).expect("again");
    other.apply(&command).expect("it can be made");
    assert_eq!(other.text().matches("use geometry").count(), 1, "{}", other.text());
    assert_eq!(other.wrong(), []);
    // what says nothing of things is no copy
    for text in ["", "hello world", "use geometry\n", "a: Nonsense\n"] {
        assert_eq!(other.session.copies_in(other.id, text), None, "{text}");
    }
    // a few lines of a text that uses what this one does
    let lines = "b: Line { p1 = (0, 0)  p2 = (50, 10) }\nconstraint b.length = 60\n";
    let clip = other.session.copies_in(other.id, lines).expect("they say something of things");
    let (command, _) = other.session.pasting(other.id, &clip, 1).expect("they can stand here");
    other.apply(&command).expect("it can be made");
    assert_eq!(other.wrong(), []);
    assert!(other.text().contains(".length = 60"), "{}", other.text());
    // a class of the document's own comes along, too
    let desk = Desk::of("use geometry\nclass Strut { line: Line }\ns: Strut\n");
    let clip = desk.session.copied(desk.id, &[at("s")], Relations::Own).expect("it stands alone");
    let mut other = Desk::of("use geometry\n");
    let read =
        other.session.copies_in(other.id, &clip.written()).expect("it says something of things");
    let (command, _) = other.session.pasting(other.id, &read, 1).expect("it can stand there");
    other.apply(&command).expect("it can be made");
    assert_eq!(other.wrong(), []);
    assert!(other.text().contains("class Strut"), "{}", other.text());
}

#[test]
fn a_copy_of_what_is_joined_lies_as_its_model_does() {
    let mut desk = Desk::of(
        "use circuits\na: Resistor { a.node.at = (0, 0)  b.node.at = (0, 100) }\n\
         b: Resistor { b.node.at = (90, 40) }\nmerge a.b.node = b.a.node\n",
    );
    let copied = copy(&desk, &["b"], Relations::Own).expect("it stands alone");
    desk.apply(&copied.0).expect("it can be made");
    holds(&desk);
    assert_eq!(desk.place("resistor.a.node.at"), (20.0, 120.0));
    assert_eq!(desk.place("resistor.b.node.at"), (110.0, 60.0));
    assert_eq!(desk.place("b.b.node.at"), (90.0, 40.0));
}

#[test]
fn copies_of_a_rectangle_are_as_large_as_it_is() {
    const TEXT: &str =
        "use geometry\nbox: Rectangle { corner = (10, 10)  width = 30  height = 40 }\n";
    let mut desk = Desk::of(TEXT);
    let clip = desk.session.copied(desk.id, &[at("box")], Relations::Own).expect("it stands alone");
    let mut copies = Vec::new();
    for aside in [1, 2] {
        let (command, names) = desk.session.pasting(desk.id, &clip, aside).expect("it can stand");
        desk.apply(&command).expect("it can be made");
        copies.push((names[0].clone(), 10.0 + 20.0 * f64::from(aside)));
    }
    let (command, names) = copy(&desk, &["box"], Relations::All).expect("it can stand");
    desk.apply(&command).expect("it can be made");
    copies.push((names[0].clone(), 30.0));
    for (name, lies) in copies {
        let found = ["corner.x", "corner.y", "width", "height"];
        let found = found.map(|part| desk.number(&format!("{name}.{part}")));
        assert_eq!(found, [lies, lies, 30.0, 40.0], "{name}: {}", desk.text());
    }
    (0..3).for_each(|_| desk.undo());
    assert_eq!(desk.text(), TEXT);
}

/// A slot: two arcs of radius 20, tangent to two lines.
const SLOT: &str = "use geometry\na: Arc { center = (0.1, 0)  start = (0.1, 20)  end = (0.1, -20) }\nb: Arc { center = (99.7, 0)  start = (99.7, -20)  end = (99.7, 20) }\nc: Line { p1 = (0.1, 20)  p2 = (99.7, 20) }\nd: Line { p1 = (0.1, -20)  p2 = (99.7, -20) }\nmerge a.start = c.p1\nmerge a.end = d.p1\nmerge b.end = c.p2\nmerge b.start = d.p2\nconstraint a.tangent(to: c)\nconstraint b.tangent(to: c)\nconstraint a.tangent(to: d)\nconstraint b.tangent(to: d)\nconstraint c.horizontal\nconstraint a.radius = 20\n";

#[test]
fn numbers_of_a_constrained_copy_are_as_short_as_their_models() {
    for relations in [Relations::Own, Relations::All] {
        let mut desk = Desk::of(SLOT);
        for _ in 0..3 {
            let (command, _) = copy(&desk, &["a", "b", "c", "d"], relations).expect("it stands");
            desk.apply(&command).expect("it can be made");
            holds(&desk);
        }
        let text = desk.text();
        let numbers = text.split(|c: char| !c.is_ascii_digit() && c != '.');
        let longest = numbers.max_by_key(|number| number.len()).expect("numbers");
        assert!(longest.len() <= 6, "{longest}: {text}");
        assert_eq!(desk.wrong(), []);
    }
}

/// Pastes all of a text into another, and returns what that is then.
fn pasted(from: &str, into: &str) -> Desk {
    let mut desk = Desk::of(into);
    let clip = desk.session.copies_in(desk.id, from).expect("it says something of things");
    let (command, _) = desk.session.pasting(desk.id, &clip, 0).map_err(|r| r.message).expect("ok");
    desk.apply(&command).expect("it can be pasted");
    holds(&desk);
    desk
}

const PLATE: &str = "use geometry\nunit mm\nplate: Rectangle { corner = (10, 20)  width = 80  height = 50 mm }\nhole: Circle { center = (50, 45)  radius = 6 }\nconstraint hole.radius = 6\nconstraint plate.width = 2 * (plate.height - 10)\n";

#[test]
fn a_copy_in_a_sheet_of_another_unit_is_as_large() {
    let desk = pasted(PLATE, "use geometry\nunit cm\np: Point = (1, 1)\n");
    let text = desk.text();
    for said in [
        "width = 80 mm  height = 50 mm",
        "radius = 6 mm",
        "constraint hole.radius = 6 mm",
        "constraint plate.width = 2 * (plate.height - 10 mm)",
    ] {
        assert!(text.contains(said), "{text}");
    }
    assert!((desk.number("plate.width") - 8.0).abs() < 1e-9, "{text}");
    assert!((desk.number("hole.radius") - 0.6).abs() < 1e-9, "{text}");
    let apart = desk.number("hole.center.x") - desk.number("plate.corner.x");
    assert!((apart - 4.0).abs() < 1e-9, "{text}");
}

#[test]
fn what_would_be_of_another_size_in_a_sheet_of_another_unit_is_not_pasted() {
    let desk = Desk::of("use geometry\nunit cm\np: Point = (1, 1)\n");
    let area = format!("{PLATE}wanted: Area = 4000\n");
    let clip = desk.session.copies_in(desk.id, &area).expect("it says something of things");
    let refused =
        desk.session.pasting(desk.id, &clip, 0).map(|_| ()).expect_err("of 4000 mm² 4000 cm²");
    assert_eq!(
        refused.message,
        "the copy is of a sheet in mm, this one counts in cm: its lengths would be others here"
    );
    let desk = pasted(PLATE, "use geometry\nunit mm\np: Point = (1, 1)\n");
    assert!(desk.text().contains("width = 80  height = 50 mm"), "{}", desk.text());
}

#[test]
fn what_has_no_unit_is_pasted_as_it_stands() {
    let plain = PLATE.replace("unit mm\n", "").replace("50 mm", "50");
    let desk = pasted(&plain, "use geometry\nunit cm\np: Point = (1, 1)\n");
    assert!(desk.text().contains("width = 80  height = 50"), "{}", desk.text());
}

#[test]
fn a_copy_in_a_sheet_of_centimetres_lies_near() {
    let mut desk = Desk::of("use geometry\nunit cm\np: Point = (1, 1)\n");
    let (command, _) = copy(&desk, &["p"], Relations::Own).expect("it stands alone");
    desk.apply(&command).expect("it can be made");
    assert_eq!(desk.place("point"), (3.0, 3.0));
}

#[test]
fn a_copy_of_what_is_computed_stays_as_it_is_and_opens_so_again() {
    let text = "class Q { x: Real }\na: Real = 3\nq: Q\nconstraint q.x = 2 * a\n\
        r: Q = copy of q\nhalf: Real\nconstraint half = r.x / 2\n";
    let mut desk = Desk::of(text);
    let arbitrary = desk.session.arbitrary(desk.id);
    assert!(arbitrary.is_empty(), "all follows from what is given: {arbitrary:?}");
    desk.set("a", 5.0).expect("q follows");
    for desk in [&desk, &Desk::of(&desk.text())] {
        let values = ["q.x", "r.x", "half"].map(|path| shown(desk, path));
        assert_eq!(values, ["10", "6", "3"], "{}", desk.text());
    }
    desk.apply(&Command::Undo).expect("one step");
    assert_eq!(desk.text(), text);
    desk.type_text(&text.replace("a: Real = 3", "a: Real = 4"));
    for desk in [&desk, &Desk::of(&desk.text())] {
        assert_eq!(["q.x", "r.x"].map(|path| shown(desk, path)), ["8", "6"], "{}", desk.text());
    }
    desk.type_text(&text.replace(" = 3", "").replace("q: Q\n", "q: Q\nq.x = 8\n"));
    let values = ["a", "q.x", "r.x"].map(|path| shown(&desk, path));
    assert_eq!(values, ["4", "8", "8"], "what is given is copied as it is given");
}
