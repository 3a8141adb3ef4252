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
