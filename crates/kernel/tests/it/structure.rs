//! Structures of documents built by hand: parts, given values, merges, sets, faults.

use crate::builder::{Builder, ORIGIN};
use kernel::{
    Argument, ClassId, ClassKind, Count, Document, FaultKind, Given, Insert, Path, Primitive,
    SlotId, Stay, Step, Structure, Term, ThingId, check, instantiate,
};
use std::rc::Rc;

fn make(document: &Document) -> Structure {
    let (structure, faults) = instantiate(document);
    assert_eq!(faults, []);
    check::structure(document, &structure).expect("the structure keeps its invariants");
    structure
}

fn at(structure: &Structure, path: &[&str]) -> ThingId {
    structure.follow(kernel::DOCUMENT, &Path::of(path)).expect("the path leads somewhere")
}

fn given_number(structure: &Structure, path: &[&str]) -> Option<f64> {
    let slot = structure.slot_of(at(structure, path)).expect("a number has a slot");
    match &*structure.given(slot)?.term {
        Term::Number { value, .. } => Some(*value),
        other => panic!("given {other:?}"),
    }
}

fn pair(x: f64, y: f64) -> Term {
    Term::Tuple(vec![Term::number(x), Term::number(y)])
}

/// Point {x, y}, Line {p1, p2} with a given p2, and an empty document class.
fn plane() -> (Builder, ClassId, ClassId, ClassId) {
    let (mut b, object, real) = Builder::new();
    let point = b.composite("Point", object, &[("x", real), ("y", real)]);
    let line = b.composite("Line", object, &[("p1", point), ("p2", point)]);
    b.given(line, &["p2"], pair(200.0, 100.0));
    let root = b.composite("document", object, &[]);
    (b, point, line, root)
}

#[test]
fn an_empty_document_is_one_thing() {
    let (b, _, _, root) = plane();
    let structure = make(&b.document(root));
    assert_eq!(structure.things.len(), 1);
    assert_eq!(structure.slots.len(), 0);
}

#[test]
fn a_body_overrides_a_default_and_a_coordinate_a_place() {
    let (mut b, _, line, root) = plane();
    b.part(root, "a", line, None);
    b.part(root, "b", line, None);
    b.given(root, &["b", "p2", "x"], Term::number(7.0));
    let s = make(&b.document(root));
    assert_eq!(given_number(&s, &["a", "p2", "x"]), Some(200.0));
    assert_eq!(given_number(&s, &["b", "p2", "x"]), Some(7.0));
    assert_eq!(given_number(&s, &["b", "p2", "y"]), Some(100.0));
    assert_eq!(given_number(&s, &["b", "p1", "x"]), None);
}

#[test]
fn slots_follow_declaration_through_the_parts() {
    let (mut b, point, line, root) = plane();
    b.part(root, "a", line, None);
    b.part(root, "p", point, None);
    let d = b.document(root);
    let s = make(&d);
    let paths: Vec<String> =
        s.slots.iter().map(|(_, slot)| s.path(&d, slot.thing).to_string()).collect();
    assert_eq!(paths, ["a.p1.x", "a.p1.y", "a.p2.x", "a.p2.y", "p.x", "p.y"]);
    assert_eq!(s.slots[SlotId(2)].place, Some(at(&s, &["a", "p2"])));
}

#[test]
fn merged_points_share_their_slots_and_the_first_given_value() {
    let (mut b, _, line, root) = plane();
    b.part(root, "a", line, None);
    b.part(root, "b", line, None);
    b.merge(root, &[&["b", "p2"], &["a", "p1"]]);
    b.given(root, &["b", "p2"], pair(1.0, 2.0));
    let s = make(&b.document(root));
    assert_eq!(s.slots.len(), 6);
    assert_eq!(s.merged[at(&s, &["b", "p2"])], at(&s, &["a", "p1"]));
    assert_eq!(given_number(&s, &["a", "p1", "y"]), Some(2.0));
}

#[test]
fn the_order_of_merges_never_matters() {
    let rings = [
        [["a", "b"], ["b", "c"], ["c", "d"]],
        [["c", "d"], ["a", "b"], ["d", "a"]],
        [["d", "b"], ["c", "a"], ["b", "a"]],
    ];
    for ring in rings {
        let (mut b, point, _, root) = plane();
        for name in ["a", "b", "c", "d"] {
            b.part(root, name, point, None);
        }
        for [one, other] in ring {
            b.merge(root, &[&[one], &[other]]);
        }
        let s = make(&b.document(root));
        assert_eq!(s.slots.len(), 2, "{ring:?}");
        assert_eq!(s.merged_with(at(&s, &["d"])).len(), 4);
        assert_eq!(s.merged_with(at(&s, &["d"]))[0], at(&s, &["a"]));
    }
}

#[test]
fn things_merge_through_their_nearest_common_ancestor() {
    let (mut b, _, line, root) = plane();
    let level = b.composite("Level", line, &[]);
    b.constraint(level, "level");
    let real = b.0.iter().find(|(_, c)| c.name == "Real").map(|(id, _)| id).expect("there is Real");
    let sized = b.composite("Sized", line, &[("size", real)]);
    b.constraint(sized, "rigid");
    b.part(root, "side", line, None);
    b.part(root, "level", level, None);
    b.part(root, "sized", sized, None);
    b.merge(root, &[&["level"], &["side"]]);
    b.merge(root, &[&["side"], &["sized"]]);
    let s = make(&b.document(root));
    assert_eq!(s.slots.len(), 5);
    assert_eq!(s.constraints.len(), 2);
    // an extra part is reached through any of the merged things
    assert_eq!(at(&s, &["level", "size"]), at(&s, &["sized", "size"]));
}

#[test]
fn a_path_through_a_merge_is_followed_when_the_merge_is_made() {
    let (mut b, point, line, root) = plane();
    let real = b.0.iter().find(|(_, c)| c.name == "Real").map(|(id, _)| id).expect("there is Real");
    let sized = b.composite("Sized", line, &[("size", real)]);
    b.part(root, "plain", line, None);
    b.part(root, "sized", sized, None);
    b.part(root, "number", real, None);
    b.part(root, "p", point, None);
    b.merge(root, &[&["plain", "size"], &["number"]]);
    b.merge(root, &[&["plain"], &["sized"]]);
    let s = make(&b.document(root));
    assert_eq!(s.merged[at(&s, &["number"])], at(&s, &["sized", "size"]));
}

#[test]
fn superclasses_merge_into_one() {
    let (mut b, object, _) = Builder::new();
    let real = ClassId(1);
    let triangle = b.composite("Triangle", object, &[("side", real)]);
    let isosceles = b.composite("Isosceles", triangle, &[]);
    b.constraint(isosceles, "equal");
    let flat = b.composite("Flat", triangle, &[]);
    b.constraint(flat, "level");
    let both = b.class("Both", ClassKind::Composite, &[triangle, isosceles, flat]);
    b.merge(both, &[&["triangle"], &["isosceles"], &["flat"]]);
    let root = b.composite("document", object, &[("it", both)]);
    let s = make(&b.document(root));
    assert_eq!(s.slots.len(), 1);
    assert_eq!(s.constraints.len(), 2);
    assert_eq!(s.slots_under(at(&s, &["it", "flat", "side"])), [SlotId(0)]);
}

#[test]
fn a_merged_set_holds_every_member_once() {
    let (mut b, object, real) = Builder::new();
    let set = b.class("Set of Real", ClassKind::Set(real), &[object]);
    let node = b.composite("Node", object, &[("currents", set)]);
    let lead = b.composite("Lead", object, &[("node", node), ("current", real)]);
    let insert = Insert {
        part: Path::of(&["current"]),
        set: Path::of(&["node", "currents"]),
        origin: ORIGIN,
    };
    b.0[lead].inserts.push(insert);
    let root = b.composite("document", object, &[("a", lead), ("b", lead), ("c", lead)]);
    b.merge(root, &[&["a", "node"], &["b", "node"], &["c", "node"]]);
    b.merge(root, &[&["b", "current"], &["c", "current"]]);
    let s = make(&b.document(root));
    let members = &s.sets[&at(&s, &["a", "node", "currents"])];
    assert_eq!(*members, [at(&s, &["a", "current"]), at(&s, &["b", "current"])]);
}

#[test]
fn lists_take_their_elements_from_a_given_list() {
    let (mut b, object, real) = Builder::new();
    let list = b.class("List of Real", ClassKind::List(real), &[object]);
    let root = b.composite("document", object, &[]);
    b.part(root, "bars", list, Some(Count::Given));
    b.part(root, "cells", list, Some(Count::Fixed(4)));
    b.given(root, &["bars"], Term::List(vec![Term::number(3.0), Term::number(7.0)]));
    let last = Path(vec![Step::Part("cells".into()), Step::Last]);
    b.0[root].givens.push(Rc::new(Given {
        path: last.clone(),
        value: Term::number(9.0),
        origin: ORIGIN,
    }));
    let s = make(&b.document(root));
    assert_eq!(s.parts(at(&s, &["bars"])).len(), 2);
    assert_eq!(s.slots.len(), 6);
    let cell = s.follow(kernel::DOCUMENT, &last).expect("there is a last cell");
    assert_eq!(s.things[cell].field, 3);
}

#[test]
fn a_given_thing_is_handed_to_its_parts_by_name() {
    let (mut b, point, _, root) = plane();
    b.part(root, "p", point, None);
    let argument = |label: &str, x| Argument { label: Some(label.into()), value: Term::number(x) };
    let value =
        Term::Make { class: point, arguments: vec![argument("y", 2.0), argument("x", 1.0)] };
    b.given(root, &["p"], value);
    let s = make(&b.document(root));
    assert_eq!(given_number(&s, &["p", "x"]), Some(1.0));
    assert_eq!(given_number(&s, &["p", "y"]), Some(2.0));
}

#[test]
fn anchors_hold_every_slot_below() {
    let (mut b, _, line, root) = plane();
    b.part(root, "a", line, None);
    let stay = Stay { path: Path::of(&["a", "p1"]), strength: None, origin: ORIGIN };
    b.0[root].stays.push(stay);
    let s = make(&b.document(root));
    let held: Vec<bool> = s.slots.iter().map(|(_, slot)| slot.anchored).collect();
    assert_eq!(held, [true, true, false, false]);
}

fn faults_of(b: Builder, root: ClassId) -> Vec<FaultKind> {
    let document = b.document(root);
    let (structure, faults) = instantiate(&document);
    check::structure(&document, &structure).expect("what is left keeps the invariants");
    faults.into_iter().map(|f| f.kind).collect()
}

#[test]
fn a_thing_that_would_be_part_of_itself() {
    let (mut b, object, _) = Builder::new();
    let inner = b.composite("Box", object, &[]);
    b.part(inner, "inside", inner, None);
    let root = b.composite("document", object, &[("box", inner)]);
    assert_eq!(faults_of(b, root), [FaultKind::EndlessParts]);
}

#[test]
fn more_things_than_fit() {
    let (mut b, object, real) = Builder::new();
    let list = b.class("List of Real", ClassKind::List(real), &[object]);
    let root = b.composite("document", object, &[]);
    b.part(root, "cells", list, Some(Count::Fixed(u32::MAX)));
    assert_eq!(faults_of(b, root), [FaultKind::TooManyThings]);
}

#[test]
fn parts_of_parts_without_measure() {
    let (mut b, object, real) = Builder::new();
    let classes = (0..3000)
        .fold(real, |inner, i| b.composite(&format!("Box{i}"), object, &[("inside", inner)]));
    let root = b.composite("document", object, &[("box", classes)]);
    assert_eq!(faults_of(b, root), [FaultKind::TooDeep]);
}

#[test]
fn lists_of_lists_that_do_not_fit() {
    let (mut b, object, real) = Builder::new();
    let mut inner = real;
    for i in 0..8 {
        let list = b.class(&format!("List {i}"), ClassKind::List(inner), &[object]);
        inner = b.composite(&format!("Rows{i}"), object, &[]);
        b.part(inner, "rows", list, Some(Count::Fixed(1000)));
    }
    let root = b.composite("document", object, &[("all", inner)]);
    assert_eq!(faults_of(b, root), [FaultKind::TooManyThings]);
}

#[test]
fn a_list_in_a_part_takes_as_many_elements_as_its_owner_gives() {
    let (mut b, object, real) = Builder::new();
    let list = b.class("List of Real", ClassKind::List(real), &[object]);
    let row = b.composite("Row", object, &[]);
    b.part(row, "cells", list, Some(Count::Given));
    let root = b.composite("document", object, &[("two", row), ("none", row), ("one", row)]);
    let cells = |n: usize| Term::List((0..n).map(|i| Term::number(i as f64)).collect());
    b.given(root, &["two", "cells"], cells(2));
    b.given(root, &["one", "cells"], cells(1));
    let s = make(&b.document(root));
    let counts = ["two", "none", "one"].map(|row| s.parts(at(&s, &[row, "cells"])).len());
    assert_eq!(counts, [2, 0, 1]);
    let last = s.parts(at(&s, &["two", "cells"])).last().and_then(|cell| s.slot_of(cell));
    let given = last.and_then(|slot| s.given(slot)).map(|g| Term::clone(&g.term));
    assert_eq!(given, Some(Term::number(1.0)));
}

#[test]
fn a_path_that_leads_out_of_its_class_is_followed_where_it_leads() {
    let (mut b, _, line, root) = plane();
    let object = ClassId(0);
    let inner = b.composite("Inner", object, &[("side", line)]);
    let outside = Path(vec![Step::Owner, Step::Part("spot".into())]);
    let paths = vec![Path::of(&["side", "p1"]), outside.clone()];
    b.0[inner].merges.push(kernel::Merge { name: None, paths, origin: ORIGIN });
    b.0[inner].stays.push(Stay { path: outside, strength: None, origin: ORIGIN });
    let point = ClassId(2);
    let outer = b.composite("Outer", object, &[("spot", point), ("inner", inner)]);
    b.part(root, "first", outer, None);
    b.part(root, "second", outer, None);
    let s = make(&b.document(root));
    for name in ["first", "second"] {
        let spot = at(&s, &[name, "spot"]);
        assert_eq!(s.identity(at(&s, &[name, "inner", "side", "p1"])), spot);
        assert!(s.slots_under(spot).iter().all(|&slot| s.slots[slot].anchored));
    }
    assert_eq!(s.slots.len(), 8);
}

#[test]
fn merges_that_cannot_be() {
    let (mut b, point, line, root) = plane();
    let text = b.class("Text", ClassKind::Primitive(Primitive::Text), &[]);
    let object = ClassId(0);
    let circle = b.composite("Circle", object, &[("center", point)]);
    b.part(root, "line", line, None);
    b.part(root, "circle", circle, None);
    b.part(root, "text", text, None);
    b.merge(root, &[&["line"], &["circle"]]);
    b.merge(root, &[&["line", "p1", "x"], &["text"]]);
    b.merge(root, &[&["line", "p3"], &["circle", "center"]]);
    let expected = [FaultKind::VacuousMerge, FaultKind::UnlikeMerge, FaultKind::UnknownPart];
    assert_eq!(faults_of(b, root), expected);
}

#[test]
fn paths_overlap_where_one_begins_the_other() {
    let path = |names: &[&str]| Path::of(names);
    assert!(path(&["side1", "p1"]).overlaps(&path(&["side1", "p1", "x"])));
    assert!(path(&["side1", "p1"]).overlaps(&path(&["side1"])));
    assert!(path(&[]).overlaps(&path(&["side1"])));
    assert!(!path(&["side1", "p1"]).overlaps(&path(&["side1", "p2"])));
}

#[test]
fn a_clone_of_a_document_shares_the_classes_that_neither_changes() {
    let (b, object, real) = Builder::new();
    let (one, mut other) = (b.0.clone(), b.0);
    other[real].name = "Number".into();
    assert!(std::ptr::eq(&one[object], &other[object]));
    assert_eq!((&*one[real].name, &*other[real].name), ("Real", "Number"));
}
