//! Views: every row once.

use crate::desk::{Desk, gallery};
use session::view::RowKind;
use std::collections::BTreeSet;

const GALLERY: [&str; 10] = [
    "bar-chart",
    "bridge-1979",
    "bridge",
    "quadratic",
    "quadrilateral",
    "square-root",
    "temperature",
    "text-box",
    "triangles",
    "voltage-divider",
];

#[test]
fn a_message_that_a_subclass_defines_anew_is_one_value() {
    let desk = Desk::of(&gallery("temperature"));
    let rows = desk.session.values(desk.id);
    let signs: Vec<_> = rows.iter().filter(|r| r.path == "times.sign").collect();
    assert_eq!(signs.len(), 1);
    assert_eq!((signs[0].text.as_str(), signs[0].doc.as_str()), ("×", "The sign in the box."));
}

#[test]
fn no_row_is_there_twice() {
    for name in GALLERY {
        let desk = Desk::of(&gallery(name));
        let mut seen = BTreeSet::new();
        for row in desk.session.values(desk.id) {
            assert!(row.path != "picture" && !row.path.ends_with(".picture"), "{name}");
            assert!(seen.insert(row.path.clone()), "{name}: {} is there twice", row.path);
        }
        let mut seen = BTreeSet::new();
        for row in desk.session.structure(desk.id) {
            // Merges are rows of what they stand in, told apart by what they say.
            let what = if row.kind == RowKind::Merge { row.detail } else { String::new() };
            let key = (row.path, row.kind == RowKind::Merge, what);
            assert!(seen.insert(key.clone()), "{name}: {key:?} is there twice");
        }
    }
}

#[test]
fn rows_below_a_row_are_counted() {
    for name in GALLERY {
        let desk = Desk::of(&gallery(name));
        let rows = desk.session.structure(desk.id);
        for (i, row) in rows.iter().enumerate() {
            let below = rows[i + 1..].iter().take_while(|r| r.depth > row.depth).count();
            assert_eq!(row.descendants as usize, below, "{name}: {}", row.path);
        }
    }
}

/// A thing whose class says otherwise than Object what its views show, and how it moves.
const WEIGHT: &str = "use geometry
class Weight {
    at: Point = (10, 10)
    load: Force = 5 N
    sag: Length => load * 2 m/N
    description => \"a weight of \" + (load / 1 N).text + \" N\"
    values => [\"load\", \"sag\"]
    structure => [\"at\"]
    moved(by way: Point) => Weight(at: Point(at.x + way.x, at.y), load: load)
}
w: Weight
";

#[test]
fn a_class_says_what_its_views_show() {
    let desk = Desk::of(WEIGHT);
    let values: Vec<String> = desk.session.values(desk.id).into_iter().map(|r| r.path).collect();
    assert_eq!(values, ["w.load", "w.sag"]);
    let rows = desk.session.structure(desk.id);
    let w = rows.iter().position(|r| r.path == "w").expect("the weight is there");
    assert_eq!(rows[w].detail, "a weight of 5 N");
    assert!(rows.iter().any(|r| r.path == "w.at") && !rows.iter().any(|r| r.path == "w.load"));
}

#[test]
fn a_class_says_how_a_whole_moves() {
    let mut desk = Desk::of(WEIGHT);
    let path = session::parse_path("w").expect("a path");
    let from = desk.session.press(desk.id, &path).expect("it can be dragged");
    assert_eq!(from, (10.0, 10.0));
    desk.session.drag(desk.id, (25.0, 40.0));
    desk.session.release(desk.id).expect("nothing holds it");
    let grips = desk.session.picture(desk.id).grips;
    assert_eq!(grips.iter().map(|g| (g.x, g.y)).collect::<Vec<_>>(), [(25.0, 10.0)]);
}

#[test]
fn masters_are_seen_where_they_are_placed_alone() {
    let desk = Desk::of(
        "use geometry\nclass Gear { rim: Point = (10, 0) }\nwheel: Placed of Gear { at = (10, 20) }\n",
    );
    let values = desk.session.values(desk.id);
    assert!(values.iter().all(|r| !r.path.starts_with("masters")), "{values:?}");
    let grips = desk.session.picture(desk.id).grips;
    let paths: Vec<&str> = grips.iter().map(|g| g.path.as_str()).collect();
    assert_eq!(paths, ["wheel.at"]);
}
