//! A class by example: of what each part, value, constraint and merge is.

use crate::desk::{Desk, at};
use session::view::{ClassPlan, ItemKind, Scope};

const FIGURE: &str = "\
use geometry
a: Line { p1 = (0, 0)  p2 = (30, 40) }
b: Line { p2 = (60, 0) }
hole: Circle { center = (20, 5)  radius = 4 }
merge a.p2 = b.p1
constraint a.length = 50
constraint b.length = 50
";

fn plan(scopes: &[(&str, Scope)], desk: &Desk) -> ClassPlan {
    let items = desk.session.class_items(desk.id, &chosen());
    let scope = |says: &str| {
        let found = scopes.iter().find(|(wanted, _)| *wanted == says);
        found.map_or(Scope::Class, |(_, scope)| *scope)
    };
    let scopes = items.iter().map(|item| scope(&item.says)).collect();
    ClassPlan { name: "Wedge".into(), scopes, attachers: vec![at("a.p1"), at("b.p2")] }
}

fn chosen() -> Vec<session::Path> {
    ["a", "b", "hole"].map(at).to_vec()
}

#[test]
fn every_part_value_constraint_and_merge_is_asked_about() {
    let desk = Desk::of(FIGURE);
    let items = desk.session.class_items(desk.id, &chosen());
    let found: Vec<(ItemKind, &str, Option<&str>)> =
        items.iter().map(|i| (i.kind, i.says.as_str(), i.parameter.as_deref())).collect();
    let wanted = [
        (ItemKind::Part, "a: Line", None),
        (ItemKind::Value, "a.p1 = (0, 0)", None),
        (ItemKind::Value, "a.p2 = (30, 40)", None),
        (ItemKind::Part, "b: Line", None),
        (ItemKind::Value, "b.p2 = (60, 0)", None),
        (ItemKind::Part, "hole: Circle", None),
        (ItemKind::Value, "hole.center = (20, 5)", None),
        (ItemKind::Value, "hole.radius = 4", Some("radius")),
        (ItemKind::Merge, "merge a.p2 = b.p1", None),
        (ItemKind::Constraint, "constraint a.length = 50", Some("length")),
        (ItemKind::Constraint, "constraint b.length = 50", Some("length")),
    ];
    assert_eq!(found, wanted);
}

#[test]
fn what_is_a_parameter_differs_from_thing_to_thing_and_what_is_its_own_stays_with_it() {
    let mut desk = Desk::of(FIGURE);
    let plan = plan(
        &[
            ("hole.radius = 4", Scope::Parameter),
            ("constraint a.length = 50", Scope::Parameter),
            ("constraint b.length = 50", Scope::Own),
        ],
        &desk,
    );
    let made = desk.session.class_of(desk.id, &chosen(), &plan).expect("it can be one");
    desk.apply(&made.0).expect("it can be made");
    assert_eq!(
        desk.text(),
        "use geometry\nclass Wedge {\n    radius: Length = 4\n    length: Length = 50\n    \
         a: Line { p1 = (0, 0)  p2 = (30, 40) }\n    b: Line { p2 = (60, 0) }\n    \
         hole: Circle { center = (20, 5) }\n    merge radius = hole.radius\n    \
         merge a.p2 = b.p1\n    constraint a.length = length\n    attachers a.p1, b.p2\n}\n\n\
         wedge: Wedge {\n    constraint b.length = 50\n}\n"
    );
    assert!(desk.session.status(desk.id).satisfied);
    let another = desk.session.insertion(desk.id, "Wedge").expect("the bin has it");
    desk.apply(&another).expect("there is room");
    desk.type_in("wedge2.length", "70").expect("it is a parameter");
    assert_eq!(desk.number("wedge.length"), 50.0);
    assert!((desk.number("wedge2.a.length") - 70.0).abs() < 1e-9);
    assert!((desk.number("wedge.b.length") - 50.0).abs() < 1e-9);
}

#[test]
fn a_part_of_this_one_only_is_no_part_of_the_others() {
    let mut desk = Desk::of(FIGURE);
    let plan = plan(&[("hole: Circle", Scope::Own)], &desk);
    let made = desk.session.class_of(desk.id, &chosen(), &plan).expect("it can be one");
    desk.apply(&made.0).expect("it can be made");
    let another = desk.session.insertion(desk.id, "Wedge").expect("the bin has it");
    desk.apply(&another).expect("there is room");
    assert_eq!(desk.number("wedge.hole.radius"), 4.0);
    let rows = desk.session.values(desk.id);
    assert!(rows.iter().all(|row| !row.path.starts_with("wedge2.hole")), "{}", desk.text());
}

#[test]
fn a_second_linkage_does_not_lie_on_the_first_where_that_is_anchored() {
    let mut desk = Desk::of(
        "use geometry
ground: Line { p1 = (0, 0)  p2 = (160, 0) }
anchor ground
crank: Line { p2 = (0, 40) }
merge crank.p1 = ground.p1
constraint crank.length = 40
",
    );
    let paths = ["ground", "crank"].map(at);
    let items = desk.session.class_items(desk.id, &paths);
    let anchor = items.iter().find(|item| item.kind == ItemKind::Anchor).expect("it is asked");
    assert_eq!((anchor.says.as_str(), anchor.kind.usual()), ("anchor ground", Scope::Own));
    let plan = ClassPlan { name: "Drive".into(), ..ClassPlan::default() };
    let made = desk.session.class_of(desk.id, &paths, &plan).expect("it can be one");
    desk.apply(&made.0).expect("it can be made");
    assert!(desk.text().contains("drive: Drive {\n    anchor ground\n}"), "{}", desk.text());
    assert_eq!(desk.session.status(desk.id).freedom, 1);
    let another = desk.session.insertion(desk.id, "Drive").expect("the bin has it");
    desk.apply(&another).expect("there is room");
    assert_ne!(desk.place("drive2.ground.p1"), (0.0, 0.0), "{}", desk.text());
    assert_eq!(desk.wrong(), []);
}
