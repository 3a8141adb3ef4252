//! Dynamic updating: an edit of a class reaches every thing of it, here and in documents that use it.

use super::desk::{Desk, at};
use session::view::RowUse;
use session::{Command, DocumentId, Host, Literal, Session};
use std::cell::RefCell;
use std::rc::Rc;

fn edit(target: &str, members: &str) -> Command {
    Command::Edit { target: at(target), members: members.into() }
}
fn set(path: &str, x: f64) -> Command {
    Command::Set(vec![(at(path), Literal::Number(x))])
}

const BARS: &str = "use geometry
class Bar {
    from: Point = (0, 0)
    to: Point = (100, 0)
}
here: Bar
there: Bar { from = (500, 40)  to = (600, 40) }
turned: Bar { from = (7, 0)  to = (7, 100) }
";

#[test]
fn a_new_part_lies_beside_its_neighbour_as_in_the_prototype() {
    let mut desk = Desk::of(BARS);
    let before = desk.moment();
    // 20 above the near end of the prototype
    desk.apply(&edit("Bar", "label: Point = (10, 20)")).expect("the class can be edited");
    assert_eq!((desk.number("here.label.x"), desk.number("here.label.y")), (10.0, 20.0));
    assert_eq!((desk.number("there.label.x"), desk.number("there.label.y")), (510.0, 60.0));
    assert_eq!((desk.number("turned.label.x"), desk.number("turned.label.y")), (17.0, 20.0));
    // what is where the prototype is has nothing of its own
    assert!(desk.text().contains("here: Bar\n"), "{}", desk.text());
    desk.undo();
    assert_eq!(desk.moment(), before);
}

#[test]
fn a_new_part_near_the_far_end_goes_with_that() {
    let mut desk = Desk::of(BARS);
    desk.apply(&edit("Bar", "cap: Point = (100, 5)")).expect("the class can be edited");
    assert_eq!((desk.number("there.cap.x"), desk.number("there.cap.y")), (600.0, 45.0));
    assert_eq!((desk.number("turned.cap.x"), desk.number("turned.cap.y")), (7.0, 105.0));
}

#[test]
fn what_constraints_and_merges_determine_is_where_they_want_it() {
    let mut desk = Desk::of(BARS);
    let members =
        "mid: Point = (1, 1)  constraint mid = Point((from.x + to.x) / 2, (from.y + to.y) / 2)";
    desk.apply(&edit("Bar", members)).expect("the class can be edited");
    assert_eq!((desk.number("there.mid.x"), desk.number("there.mid.y")), (550.0, 40.0));
    desk.undo();
    desk.apply(&edit("Bar", "end: Point  merge end = to")).expect("the class can be edited");
    assert!(desk.text().contains("there: Bar { from = (500, 40)  to = (600, 40) }"));
}

#[test]
fn each_thing_keeps_its_values() {
    let mut desk = Desk::of(BARS);
    desk.apply(&edit("Bar", "weight: Real = 3")).expect("the class can be edited");
    assert_eq!((desk.number("there.from.x"), desk.number("turned.to.y")), (500.0, 100.0));
    assert_eq!(desk.number("turned.weight"), 3.0);
}

#[test]
fn an_edit_of_the_prototype_changes_the_class() {
    let mut desk = Desk::of(BARS);
    let before = desk.moment();
    let change = desk.apply(&set("Bar.to.x", 120.0)).expect("the prototype can be edited");
    assert_eq!(change.class.as_deref(), Some("Bar"));
    assert!(desk.text().contains("to: Point = (120, 0)"), "{}", desk.text());
    // a thing without a value of its own follows; one with keeps it
    assert_eq!((desk.number("here.to.x"), desk.number("there.to.x")), (120.0, 600.0));
    desk.undo();
    assert_eq!(desk.moment(), before);
}

#[test]
fn the_prototype_keeps_its_constraints_and_what_gives_way_is_given() {
    let text = "use geometry
class Stick is Line { constraint level: p1.y = p2.y }
s: Stick
";
    let mut desk = Desk::of(text);
    desk.apply(&set("Stick.p1.y", 30.0)).expect("the prototype can be edited");
    assert_eq!((desk.number("s.p1.y"), desk.number("s.p2.y")), (30.0, 30.0));
    let place = Literal::Tuple(vec![Literal::Number(9.0), Literal::Number(8.0)]);
    desk.apply(&Command::Move(vec![(at("Stick.p2"), place)])).expect("it can be moved");
    assert_eq!((desk.number("s.p1.y"), desk.number("s.p2.x")), (8.0, 9.0));
    let refused = desk.apply(&set("Stick.nothing", 1.0)).unwrap_err();
    assert!(refused.message.contains("nothing"), "{}", refused.message);
}

#[test]
fn a_prototype_that_is_a_place_gives_its_coordinates() {
    let mut desk = Desk::of("class Spot { x: Real = 4  y: Real = 2 }\ns: Spot\n");
    desk.apply(&set("Spot.y", 6.0)).expect("the prototype can be edited");
    assert_eq!(desk.text(), "class Spot { x: Real = 4  y: Real = 6 }\ns: Spot\n");
}

/// A folder with two documents, one of which uses the other.
struct Folder;

const PARTS: &str = "class Peg { width: Real = 4  height: Real = 2  name: Text }\n";

const YARD: &str =
    "class Gate { width: Real = 3  ref level: Real -> document level  ref slack: Real -> owner.slack }
level: Real = 10
slack: Real = 1
gate: Gate
";

impl Host for Folder {
    fn read(&self, name: &str) -> Option<String> {
        let texts = [("parts", PARTS), ("yard", YARD)];
        texts.iter().find(|(known, _)| *known == name).map(|(_, text)| text.to_string())
    }
}

fn number(session: &Session, id: DocumentId, path: &str) -> Option<f64> {
    session.values(id).into_iter().find(|r| r.path == path).and_then(|r| r.number)
}

#[test]
fn an_edit_of_a_class_reaches_the_documents_that_use_it() {
    let mut session = Session::new(Box::new(Folder));
    let text = "use parts\np: Peg { height = 7 }\nconstraint wide: p.width = 4\n";
    let user = session.open("user", text);
    let alone = session.open("alone", "n: Real = 1\n");
    let parts = session.open("parts", PARTS);
    let change = session.apply(parts, &edit("Peg", "depth: Real = 9")).expect("it can be edited");
    let reached: Vec<DocumentId> = change.documents.iter().map(|a| a.document).collect();
    assert_eq!(reached, [user]);
    assert_eq!(number(&session, user, "p.depth"), Some(9.0));
    assert_eq!(number(&session, user, "p.height"), Some(7.0));
    assert_eq!(
        (session.text(user).source.as_str(), number(&session, alone, "n")),
        (text, Some(1.0))
    );
    // what cannot be satisfied there is told here
    let rule = edit("Peg", "constraint narrow: width = 3");
    let change = session.apply(parts, &rule).expect("it can be edited");
    assert_eq!(change.documents[0].unsatisfied.len(), 1, "{change:?}");
    assert!(!session.status(user).satisfied);
    session.apply(parts, &Command::Undo).expect("there is a step");
    assert!(session.status(user).satisfied);
}

#[test]
fn a_document_in_a_folder_is_used_by_its_name_there() {
    let mut session = Session::new(Box::new(Folder));
    let user = session.open("shop/user.thing", "use parts\np: Peg\n");
    let elsewhere = session.open("user.thing", "use parts\np: Peg\n");
    let parts = session.open("shop/parts.thing", PARTS);
    let change = session.apply(parts, &edit("Peg", "depth: Real = 9")).expect("it can be edited");
    let reached: Vec<DocumentId> = change.documents.iter().map(|a| a.document).collect();
    assert_eq!(reached, [user]);
    assert_eq!(number(&session, user, "p.depth"), Some(9.0));
    assert_eq!(number(&session, elsewhere, "p.depth"), None, "parts in its folder is another");
}

/// Folders that have a document of the same name each.
struct Folders;

impl Host for Folders {
    fn read(&self, _: &str) -> Option<String> {
        None
    }
    fn read_beside(&self, folder: &str, name: &str) -> Option<String> {
        let width = if folder == "shop/" { 4 } else { 9 };
        (name == "parts").then(|| format!("class Peg {{ width: Real = {width} }}\n"))
    }
}

#[test]
fn documents_in_two_folders_use_each_its_own() {
    let mut session = Session::new(Box::new(Folders));
    // what is open elsewhere by the same name is another one, while a document is opened too
    session.open("parts.thing", "class Peg { width: Real = 7 }\n");
    for (name, width) in [("shop/user.thing", 4.0), ("user.thing", 7.0), ("yard/user.thing", 9.0)] {
        let user = session.open(name, "use parts\np: Peg\n");
        assert_eq!(number(&session, user, "p.width"), Some(width), "{name}");
    }
}

/// A folder that has what was put into it.
#[derive(Clone, Default)]
struct Shelf(Rc<RefCell<Option<&'static str>>>);

impl Host for Shelf {
    fn read(&self, _: &str) -> Option<String> {
        self.0.borrow().map(String::from)
    }
}

#[test]
fn what_was_missing_is_read_once_it_is_there() {
    let shelf = Shelf::default();
    let mut session = Session::new(Box::new(shelf.clone()));
    let user = session.open("user.thing", "use parts\np: Peg\n");
    assert_eq!(session.text(user).diagnostics[0].code, "missing-file");
    assert_eq!(session.catch_up(user), None, "it is not there yet");
    shelf.0.replace(Some(PARTS));
    assert!(session.catch_up(user).is_some());
    assert_eq!(number(&session, user, "p.width"), Some(4.0));
    assert!(session.apply(user, &Command::Undo).is_err(), "it is no step");
    assert_eq!(session.catch_up(user), None);
}

#[test]
fn a_step_is_taken_back_beside_what_is_used_now() {
    let mut session = Session::new(Box::new(Folder));
    let user = session.open("user", "use parts\np: Peg\n");
    let parts = session.open("parts", PARTS);
    session.apply(user, &set("p.height", 5.0)).expect("it is free");
    session.apply(parts, &set("Peg.width", 6.0)).expect("the prototype can be edited");
    assert_eq!(number(&session, user, "p.width"), Some(6.0));
    session.apply(user, &Command::Undo).expect("there is a step");
    assert_eq!(session.text(user).source, "use parts\np: Peg\n");
    assert_eq!(number(&session, user, "p.width"), Some(6.0));
    assert_eq!(number(&session, user, "p.height"), Some(2.0));
}

#[test]
fn references_lead_where_their_text_says_in_whatever_document() {
    let mut session = Session::new(Box::new(Folder));
    let yard = session.open("yard", YARD);
    let farm = session.open(
        "farm",
        "use yard
mine: Gate
copied: Gate = copy of yard.gate
slack: Real = 7
ref theirs: Gate -> document yard.gate
constraint double: mine.width = 2 * theirs.width
above: Real
constraint over: above = copied.level + 1
levels: List of 3 Real = [yard.gate.level, mine.level, copied.level]
slacks: List of 3 Real = [yard.gate.slack, mine.slack, copied.slack]
",
    );
    // the widths that the class gives have to yield
    let yields = |d: &session::view::DiagnosticView| d.code == "given-yields";
    assert!(session.text(farm).diagnostics.iter().all(yields));
    // an absolute one leads to the same thing from everywhere, a relative one to what its owner has
    let read = |session: &Session, list: &str| {
        [0, 1, 2].map(|i| number(session, farm, &format!("{list}[{i}]")).expect("it is a number"))
    };
    assert_eq!(read(&session, "levels"), [10.0, 10.0, 10.0]);
    assert_eq!(read(&session, "slacks"), [1.0, 7.0, 7.0]);
    session.apply(farm, &set("mine.width", 8.0)).expect("what is referred to follows");
    assert_eq!(number(&session, farm, "yard.gate.width"), Some(4.0));
    session.apply(farm, &set("yard.level", 12.0)).expect("it is free");
    assert_eq!(number(&session, farm, "above"), Some(13.0));
    // what goes from the document that is used is said at the reference
    session.apply(yard, &Command::Delete(at("gate"))).expect("it can be deleted");
    let codes = |s: &Session| -> Vec<String> {
        s.text(farm).diagnostics.iter().map(|d| d.code.clone()).collect()
    };
    assert!(codes(&session).contains(&"unknown-reference".to_string()), "{:?}", codes(&session));
    session.apply(yard, &Command::Undo).expect("there is a step");
    assert_eq!(codes(&session), Vec::<String>::new());
    assert_eq!(number(&session, farm, "mine.width"), Some(8.0));
}

const CART: &str = "use geometry
program Wheel(radius: Length = 10) { rim = Circle(center: (0, 0), radius: radius) }
example: Wheel
axle: Line { p1 = (0, 0)  p2 = (50, 0) }
";

/// A folder with a program, and an example of it.
struct Workshop;

impl Host for Workshop {
    fn read(&self, name: &str) -> Option<String> {
        if name == "cart" {
            return Some(CART.into());
        }
        std::fs::read_to_string(format!(
            "{}/../../library/{name}.thing",
            env!("CARGO_MANIFEST_DIR")
        ))
        .ok()
    }
}

/// Returns what is drawn, the rows of the structure and of the values that a used text has, and what is free.
fn seen(session: &mut Session, text: &str) -> (usize, usize, usize, u32) {
    let id = session.open("user", text);
    let drawn = session.picture(id).drawing.elements.len();
    let is_used = |path: &str| path.starts_with("cart");
    let rows = session.structure(id).into_iter().filter(|row| is_used(&row.path)).count();
    let values = session.values(id).into_iter().filter(|row| is_used(&row.path)).count();
    (drawn, rows, values, session.status(id).freedom)
}

#[test]
fn the_example_of_a_used_text_is_not_drawn_nor_counted() {
    let mut session = Session::new(Box::new(Workshop));
    let alone = seen(&mut session, "use geometry\np: Point = (3, 4)\n");
    assert_eq!(seen(&mut session, "use geometry\nuse cart\np: Point = (3, 4)\n"), alone);
    let (drawn, ..) = seen(&mut session, "use cart\nw: Wheel { radius = 4 }\n");
    assert_eq!(drawn, 1, "the wheel of the document alone");
    // what speaks of one of them shows them, as it always did
    let text = "use geometry\nuse cart\np: Point = (3, 4)\nmerge p = cart.axle.p1\n";
    let (drawn, rows, values, free) = seen(&mut session, text);
    assert!(drawn >= 3 && rows > 2 && values > 2 && free >= 4, "{drawn} {rows} {values} {free}");
    let text = "use geometry\nuse cart\nl: Line\nconstraint l.length = cart.axle.length\n";
    let id = session.open("user", text);
    let length = session.values(id).into_iter().find(|row| row.path == "l.length");
    assert!(length.and_then(|row| row.number).is_some_and(|x| (x - 50.0).abs() < 1e-9));
    // so it is while the text is edited
    let command = Command::Text("use geometry\nuse cart\nl: Line\n".into());
    session.apply(id, &command).expect("it can be edited");
    assert_eq!(session.picture(id).drawing.elements.len(), 1);
    session.apply(id, &Command::Undo).expect("there is a step");
    assert_eq!(session.picture(id).drawing.elements.len(), 3);
}

/// A host beside whose document another one lies, in the unit of a sheet.
struct Shop(&'static str);

impl Host for Shop {
    fn read(&self, name: &str) -> Option<String> {
        match name {
            "flange" => Some(format!(
                "{}use geometry\nprogram Flange(\n    d: Length in 10..100 = 40 \"Bore?\",\n    n: Integer = 4,\n) {{\n    \
                 rim = Circle(Point(0, 0), d / 2)\n}}\nfamily Sizes of Flange {{\n    rows: (\"S\", 20)\n}}\n",
                self.0
            )),
            _ => crate::desk::Library.read(name),
        }
    }
    fn libraries(&self) -> Vec<String> {
        vec!["geometry".into()]
    }
}

#[test]
fn a_program_of_a_document_beside_asks_for_its_own_values_and_goes_on_being_listed() {
    let listed =
        |session: &Session, id| session.constructions(id).iter().any(|row| row.id == "Flange");
    for (theirs, own, is_usual) in
        [("", "", true), ("unit mm\n", "unit mm\n", true), ("", "unit mm\n", false)]
    {
        let mut session = Session::new(Box::new(Shop(theirs)));
        let id = session.open("desk", &format!("{own}use geometry\nuse flange\n"));
        let prompt = session.begin(id, "Flange").expect("it is listed");
        assert!(prompt.words.starts_with("Bore? (d)"), "{}", prompt.words);
        assert_eq!(
            prompt.words.contains("10 to 100; Enter takes 40"),
            is_usual,
            "{}",
            prompt.words
        );
        if is_usual {
            session.enter(id, "").expect("it has a value of its own");
            session.enter(id, "").expect("it has a value of its own");
            session.enter(id, "30,40").expect("it is placed");
            assert!(listed(&session, id), "{}", session.text(id).source);
        }
        session.give_up(id);
        let grid = session.family_grid(id, "Sizes", None).expect("there is one");
        let row = ("Sizes", &grid.rows[0]);
        session.use_family_row(id, row, &RowUse::Place).expect("a row is placed");
        assert!(listed(&session, id), "{}", session.text(id).source);
    }
}
