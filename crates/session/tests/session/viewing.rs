//! Views: every row once.

use crate::desk::{Desk, at, gallery};
use session::Command;
use session::view::{MovedView, RowKind};
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
            let is_own = row.kind.has_own_path();
            let what = if is_own { String::new() } else { row.detail };
            let key = (row.path, is_own, what);
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
    let rows = desk.session.structure(desk.id);
    assert!(rows.iter().all(|r| !r.path.starts_with("masters")), "{rows:?}");
}

#[test]
fn a_document_says_what_its_views_show() {
    let desk = Desk::of(
        "structure => [\"a\"]\nvalues => [(\"b\", b), (\"twice\", 2 * b)]\na: Real = 1\nb: Real = 2\n",
    );
    let values: Vec<(String, String)> =
        desk.session.values(desk.id).into_iter().map(|r| (r.path, r.text)).collect();
    assert_eq!(values, [("b".into(), "2".into()), ("twice".into(), "4".into())]);
    let rows = desk.session.structure(desk.id);
    let paths: Vec<&str> = rows.iter().map(|r| r.path.as_str()).collect();
    assert_eq!(paths, ["", "a"]);
}

#[test]
fn a_merge_that_is_masked_is_not_shown() {
    let desk = Desk::of(
        "class Pair { a, b: Real  merge one: a = b }\nclass Loose is Pair { without one }\nl: Loose\np: Pair\n",
    );
    let rows = desk.session.structure(desk.id);
    let merges: Vec<&str> =
        rows.iter().filter(|r| r.kind == RowKind::Merge).map(|r| r.path.as_str()).collect();
    assert_eq!(merges, ["p"]);
    let one = rows.iter().find(|r| r.kind == RowKind::Merge).expect("a merge");
    assert_eq!(
        (one.detail.as_str(), &one.makes_one[..]),
        ("a = b", &["p.a".into(), "p.b".into()][..])
    );
}

const WHEEL: &str = "use geometry
class Wheel { hub: Point = (0, 0)  rim: Point = (10, 0) }
wheel: Placed of Wheel { at = (10, 20)  turn = 0 deg  scale = 1 }
other: Placed of Wheel { at = (100, 20) }
";

#[test]
fn a_placed_thing_is_turned_and_scaled_by_hand() {
    let mut desk = Desk::of(WHEEL);
    let rim = |desk: &mut Desk| desk.place("wheel.rim");
    desk.drag("wheel.turn", &[(0.5, 0.0), (std::f64::consts::FRAC_PI_2, 0.0)]);
    let (x, y) = rim(&mut desk);
    assert!((x - 10.0).abs() < 1e-9 && (y - 30.0).abs() < 1e-9, "{x} {y}");
    desk.undo();
    desk.drag("wheel.scale", &[(1.5, 0.0), (2.0, 0.0)]);
    assert_eq!(rim(&mut desk), (30.0, 20.0));
    assert_eq!(desk.place("other.rim"), (110.0, 20.0));
}

#[test]
fn a_computed_place_is_dragged_like_a_stored_one() {
    let mut desk = Desk::of(WHEEL);
    let change = desk.drag("wheel.rim", &[(12.0, 25.0), (10.0, 40.0)]);
    assert_eq!(change.label, "move wheel.rim");
    assert_eq!((desk.place("wheel.rim"), desk.place("wheel.at")), ((10.0, 40.0), (0.0, 40.0)));
    assert_eq!(desk.place("other.rim"), (110.0, 20.0));
    desk.undo();
    assert_eq!(desk.place("wheel.rim"), (20.0, 20.0));
    assert_eq!(desk.text(), WHEEL);
}

#[test]
fn a_computed_number_is_dragged_as_far_as_it_goes() {
    let mut desk = Desk::of(
        "use geometry\nl: Line { p1 = (0, 0)  p2 = (30, 40) }\nanchor l.p1\nconstraint l.length <= 60\nmiddle => Point((l.p1.x + l.p2.x) / 2, (l.p1.y + l.p2.y) / 2)\nname => \"x\"\n",
    );
    desk.drag("l.length", &[(52.0, 0.0), (55.0, 0.0)]);
    assert!((desk.number("l.length") - 55.0).abs() < 1e-9);
    let short = desk.hold("l.length", &[(80.0, 0.0)]);
    assert!(!short.reached, "{short:?}");
    assert_eq!(short.limit.map(|l| (l.path, l.value)), Some(("l.length".into(), "60".into())));
    desk.session.cancel(desk.id);
    desk.undo();
    desk.drag("middle", &[(10.0, 10.0)]);
    assert_eq!(desk.place("l.p2"), (20.0, 20.0));
    let press = |path| session::parse_path(path).expect("a path");
    assert!(desk.session.press(desk.id, &press("name")).is_err());
    let unknown = desk.session.press(desk.id, &press("l.lenght")).expect_err("there is none");
    assert!(unknown.message.contains("lenght"), "{}", unknown.message);
}

#[test]
fn the_limit_of_what_is_computed_has_its_unit() {
    let text =
        "a: Force = 1 N\nconstraint a <= 2 N\nanchor b\nb: Force = 3 N\nboth: Force => a + b\n";
    let mut desk = Desk::of(text);
    let state = desk.hold("both", &[(9.0, 0.0)]);
    assert_eq!(state.limit.map(|l| l.value).as_deref(), Some("5 N"));
}

#[test]
fn the_status_says_which_given_numbers_gave_way() {
    let text = "v1, v2, v: Real\nv1 = 1\nv2 = 2\nconstraint v1 = v\nconstraint v2 = v\n";
    let mut desk = Desk::of(text);
    let status = desk.session.status(desk.id);
    assert!(status.satisfied);
    assert_eq!(
        status.notes,
        ["given values gave way: v1 is 1.5, given as 1, v2 is 1.5, given as 2"]
    );
    // what an edit comes to is what the text gives from then on
    desk.set("v", 4.0).expect("both follow");
    assert!(desk.session.status(desk.id).notes.is_empty());
}

#[test]
fn a_value_that_gave_way_is_read_in_a_unit_of_its_size_and_to_as_many_digits_as_tell() {
    let told = |text: &str| {
        let desk = Desk::of(text);
        let all = desk.session.text(desk.id).diagnostics;
        all.into_iter().map(|d| d.message).collect::<Vec<_>>().join("\n")
    };
    assert_eq!(
        told("v: Voltage = 1 V\nconstraint 2 * v = 9.17038 mV\n"),
        "v is given here as 1 V, and became 4.58519 mV, because of “2 * v = 9.17038 mV”"
    );
    assert_eq!(
        told("f: Force = -1000 N\nconstraint 2 * f = -2000.000004 N\n"),
        "f is given here as -1000 N, and became -1000.000002 N, because of “2 * f = -2000.000004 N”"
    );
    // what is as it was written keeps its unit
    let row = Desk::of("v: Voltage = 0.0045 V\n").row("v");
    assert_eq!([row.text, row.unit], ["0.0045", "V"]);
}

#[test]
fn a_list_of_whole_numbers_that_gave_way_says_because_of_what() {
    let desk = Desk::of(
        "n: List of Integer in 0..9 = [1, 2, 3]\nconstraint allDifferent(n)\nconstraint first: n[0] = 2\n",
    );
    let all = desk.session.text(desk.id).diagnostics;
    assert!(all[0].message.ends_with(", because of first"), "{}", all[0].message);
}

#[test]
fn a_document_is_called_what_it_says_of_itself_or_by_its_name() {
    let title = |text: &str| {
        let mut desk = Desk::of("");
        let id = desk.session.open("rooms/a-desk.thing", text);
        desk.session.title(id)
    };
    assert_eq!(
        title("/// Four bars: they turn.\nuse geometry\n\n/// A bar.\nclass Bar {}\n"),
        "Four bars"
    );
    assert_eq!(title("/// Beams\nunit mm\nx: Real = 1\n"), "Beams");
    assert_eq!(title("use geometry\n\n/// A bar with a handle.\nclass Handle {}\n"), "a desk");
    assert_eq!(title("/// A bar with a handle.\nclass Handle {}\n"), "a desk");
}

#[test]
fn everything_in_the_gallery_is_drawn() {
    for name in GALLERY {
        let desk = Desk::of(&gallery(name));
        assert_eq!(desk.session.undrawn(desk.id), Vec::<String>::new(), "{name}");
    }
}

#[test]
fn a_picture_without_end_is_said_not_to_be_there() {
    let desk = Desk::of(
        "class Leaf { size: Real = 3  picture => Leaf(size: size + 1).picture }\nl: Leaf\n",
    );
    let said = desk.session.undrawn(desk.id);
    assert!(matches!(&said[..], [why] if why.starts_with("messages call each other")), "{said:?}");
}

/// A corner on the way, and a crank that is led round: what moves is not known at the press.
const WAYS: [(f64, f64); 4] = [(7.0, -3.0), (40.0, 25.0), (-30.0, 60.0), (0.0, 0.0)];

#[test]
fn a_picture_that_is_followed_is_the_one_that_is_made_anew() {
    let others = ["four-bar", "resistor-grid", "warren-truss", "layout", "polar-point"];
    for name in GALLERY.into_iter().chain(others) {
        let text = gallery(name);
        let mut desk = Desk::of(&text);
        let grips = desk.session.picture(desk.id).grips;
        for grip in grips.iter().step_by(1 + grips.len() / 4) {
            let path = session::parse_path(&grip.path).unwrap();
            let mut view = desk.session.picture(desk.id);
            let Ok(from) = desk.session.press(desk.id, &path) else { continue };
            for way in WAYS {
                let to = (from.0 + way.0, from.1 + way.1);
                desk.session.drag(desk.id, to);
                let before = view.drawing.clone();
                let moved = desk.session.follow_picture(desk.id, &mut view);
                // nobody has asked for this one's picture before
                let mut once = Desk::of(&text);
                once.session.press(once.id, &path).unwrap();
                for way in WAYS.iter().take_while(|other| **other != way).chain([&way]) {
                    once.session.drag(once.id, (from.0 + way.0, from.1 + way.1));
                }
                let anew = once.session.picture(once.id);
                assert_eq!(view.drawing.elements, anew.drawing.elements, "{name}: {}", grip.path);
                assert_eq!(view.grips, anew.grips, "{name}: {}", grip.path);
                assert_eq!(view.paths, anew.paths, "{name}: {}", grip.path);
                if let MovedView::These { elements: moved, .. } = moved {
                    for (at, element) in before.elements.iter().enumerate() {
                        let same = *element == anew.drawing.elements[at];
                        assert!(same || moved.contains(&(at as u32)), "{name}: element {at}");
                    }
                }
            }
            if grip.path != grips[0].path {
                desk.session.cancel(desk.id);
                continue;
            }
            // after the release, and after that is taken back, it is that of the text that stands then
            for command in [None, Some(Command::Undo)] {
                let done = match &command {
                    None => desk.session.release(desk.id).is_ok_and(|c| !c.edits.is_empty()),
                    Some(command) => desk.session.apply(desk.id, command).is_ok(),
                };
                desk.session.follow_picture(desk.id, &mut view);
                let opened = Desk::of(&desk.session.text(desk.id).source);
                let anew = opened.session.picture(opened.id);
                assert_eq!(view.drawing.elements, anew.drawing.elements, "{name}: {}", grip.path);
                assert_eq!(view.grips, anew.grips, "{name}: {}", grip.path);
                assert_eq!(view.freedom, anew.freedom, "{name}: {}", grip.path);
                if !done {
                    break;
                }
            }
        }
    }
}

#[test]
fn a_document_that_is_opened_stage_by_stage_is_the_one_that_is_opened_at_once() {
    for name in GALLERY {
        let text = gallery(name);
        let mut desk = Desk::of(&text);
        let mut opening = desk.session.begin_opening("again", &text);
        while !opening.is_over() {
            opening = desk.session.go_on_opening(opening);
        }
        let again = desk.session.end_opening(opening);
        assert_eq!(desk.session.values(again), desk.session.values(desk.id), "{name}");
        assert_eq!(desk.session.status(again), desk.session.status(desk.id), "{name}");
    }
}

#[test]
fn rows_that_are_made_one_by_one_are_those_that_are_made_at_once() {
    for name in GALLERY {
        let desk = Desk::of(&gallery(name));
        let mut listing = desk.session.begin_listing(desk.id);
        let mut turns = 0;
        while !listing.go_on(&mut || false) {
            turns += 1;
        }
        let (structure, values) = listing.finished();
        assert!(turns >= structure.len(), "{name}: {turns} turns");
        assert_eq!(structure, desk.session.structure(desk.id), "{name}");
        assert_eq!(values, desk.session.values(desk.id), "{name}");
    }
}

/// Twelve points in a row, ten apart: the first pushes the second, these the third, and so on.
#[test]
fn what_moves_one_after_the_other_is_set_apart_in_few_steps() {
    let mut text = String::from("use geometry\nrow: List of 12 Point\nrest: List of 9 Point\n");
    for i in 0..12 {
        text += &format!("row[{i}] = ({}, 0)\n", 10 * i);
    }
    for i in 1..12 {
        text += &format!("constraint row[{i}].x >= row[{}].x + 5\n", i - 1);
    }
    for i in 0..9 {
        text += &format!("rest[{i}] = ({i}, 100)\n");
    }
    let mut desk = Desk::of(&text);
    let path = session::parse_path("row[0]").unwrap();
    let mut view = desk.session.picture(desk.id);
    desk.session.press(desk.id, &path).unwrap();
    let (mut told, mut moving): (Vec<MovedView>, Vec<usize>) = (Vec::new(), Vec::new());
    for step in 1..60 {
        let before = view.grips.clone();
        desk.session.drag(desk.id, (f64::from(step), 0.0));
        let moved = desk.session.follow_picture(desk.id, &mut view);
        let pairs = before.iter().zip(&view.grips);
        moving.push(pairs.filter(|(a, b)| a != b).count());
        if told.last() != Some(&moved) {
            told.push(moved);
        }
    }
    assert!(moving.first() == Some(&1) && moving.last() == Some(&12), "{moving:?}");
    assert!(told.len() <= 4, "{told:?}");
    let Some(MovedView::These { elements, grips }) = told.last() else { panic!("{told:?}") };
    assert_eq!((elements.len(), grips.len()), (12, 12));
}

#[test]
fn a_parameter_of_a_program_says_what_it_asks_and_in_which_range() {
    let desk = Desk::of(
        "unit mm\nprogram Disc(d: Length in 2 mm..50 mm = 10 mm \"How wide?\", t: Length in 5 mm.. = 8 mm, n: Integer = 3) {\n}\ndisc: Disc\n",
    );
    let wide = desk.row("disc.d");
    assert_eq!((wide.number, wide.range), (Some(10.0), Some((Some(2.0), Some(50.0)))));
    // one end alone is asked
    assert_eq!(desk.row("disc.t").range, Some((Some(5.0), None)));
    assert_eq!(wide.doc, "How wide?");
    assert_eq!(desk.row("disc.n").range, None);
}

#[test]
fn a_computed_corner_says_what_and_where_it_is() {
    let text = "use geometry\nbox: Rectangle { corner = (10, 20)  width = 30  height = 40 }\n";
    let desk = Desk::of(text);
    let rows = desk.session.computed_rows(desk.id, &at("box.far"));
    assert_eq!((rows[0].path.as_str(), rows[0].detail.as_str()), ("box.far", "Point"));
    assert_eq!(rows[0].value.as_deref(), Some("(40, 60)"));
    assert_eq!(rows[0].doc, "The corner opposite.");
    assert!(desk.session.computed_rows(desk.id, &at("box.nothing")).is_empty());
}

#[test]
fn sides_of_a_polygon_are_told_apart() {
    let text = "use geometry\nhex: RegularPolygon { center = (0, 0)  corner = (20, 0) }\n";
    let desk = Desk::of(text);
    let picture = desk.session.picture(desk.id);
    assert!(picture.paths.iter().any(|path| path == "hex.edges[2]"));
    // the first corner is a part, and gripped as that
    let corners = picture.grips.iter().filter(|grip| grip.path.starts_with("hex.corners"));
    assert_eq!(corners.count(), 5);
}

/// Returns the rows of a document as lines.
fn rows_of(desk: &Desk) -> Vec<String> {
    let rows = desk.session.values(desk.id);
    rows.iter()
        .map(|r| format!("{} {} {}", r.path, r.text, r.unit).trim_end().to_string())
        .collect()
}

#[test]
fn what_a_merged_thing_has_beyond_the_first_is_shown() {
    let desk = Desk::of(
        "class Worker { hours: Real = 40  pay => hours }\n\
         class Chief is Worker { bonus: Real = 500  pay => super.pay + bonus  half => hours / 2 }\n\
         w: Worker\nc: Chief { bonus = 7 }\nmerge w = c\n",
    );
    assert_eq!(rows_of(&desk), ["w.hours 40", "w.pay 40", "c.bonus 7", "c.pay 47", "c.half 20"]);
    let rows = desk.session.structure(desk.id);
    let children =
        rows.iter().filter(|row| row.path.starts_with("c.") && row.merged_with.is_none());
    assert!(children.map(|row| row.path.as_str()).any(|path| path == "c.bonus"));
}

#[test]
fn a_number_is_shown_in_the_unit_that_is_written_for_it() {
    let desk = Desk::of(
        "use circuits\nclass Loan { from, to: Real  rate: Real }\nloan: Loan = Loan(0.5, 1, 10%)\n\
         class Slab { long, wide: Length }\nslab: Slab = Slab(5 ft, 3 in)\ncount: Real = 1234567\n\
         r: Resistor\nconstraint r.resistance = count / 1000000 * 3 kohm\n",
    );
    let wanted = [
        "loan.from 0.5",
        "loan.to 1",
        "loan.rate 10 %",
        "slab.long 5 ft",
        "slab.wide 3 in",
        "count 1234567",
        "r.resistance 3.7037 kohm",
    ];
    let rows = rows_of(&desk);
    let rows: Vec<_> = rows.iter().filter(|row| wanted.contains(&row.as_str())).collect();
    assert_eq!(rows, wanted);
}

#[test]
fn of_a_text_that_is_bound_twice_the_outer_one_is_edited() {
    let mut desk = Desk::of(
        "class Card { words: Text = \"plain\"  size: Real = 2 }\n\
         class Box { card: Card { words = \"in {size}\" } }\nx: Real = 7\n\
         box: Box { card.words = \"out {x}\" }\n",
    );
    let rows = desk.session.values(desk.id);
    let row = rows.iter().find(|row| row.path == "box.card.words").expect("it is a value");
    assert_eq!((row.text.as_str(), row.exact.as_str()), ("out 7", "out {x}"));
    desk.type_in("box.card.words", "now {x}").expect("a text");
    assert!(desk.text().contains("card.words = \"now {x}\""), "{}", desk.text());
    assert!(desk.text().contains("words = \"in {size}\""), "{}", desk.text());
}

#[test]
fn a_text_with_values_in_it_is_typed_by_hand() {
    let mut desk = Desk::of(
        "use geometry\nline: Line { p1 = (0, 0)  p2 = (3, 4) }\ncaption: Caption { at = (0, 10) }\n\
         other: Caption { at = (0, 20)  words = \"here\" }\n",
    );
    let row = |desk: &Desk, path: &str| {
        let rows = desk.session.values(desk.id);
        let row = rows.into_iter().find(|row| row.path == path).expect("it is a value");
        (row.text, row.exact)
    };
    for path in ["caption.words", "other.words"] {
        let before = desk.text();
        desk.type_in(path, "side {line.length} long").expect("a text");
        let shown = ("side 5 long".to_string(), "side {line.length} long".to_string());
        assert_eq!(row(&desk, path), shown, "{}", desk.text());
        desk.set("line.p2.x", 0.0).expect("it is free");
        assert_eq!(row(&desk, path).0, "side 4 long");
        desk.apply(&Command::Undo).expect("a step");
        // what is typed over it is words again, or other values
        desk.type_in(path, "\"{line.direction}\"").expect("a text");
        assert_eq!(row(&desk, path).0, "\"53.1301 deg\"", "{}", desk.text());
        desk.type_in(path, "none").expect("a text");
        assert_eq!(row(&desk, path), ("none".to_string(), "none".to_string()));
        // braces without a value in them are braces
        desk.type_in(path, "{nothing}").expect("a text");
        assert_eq!(row(&desk, path).0, "{nothing}", "{}", desk.text());
        for _ in 0..4 {
            desk.apply(&Command::Undo).expect("a step");
        }
        assert_eq!(desk.text(), before);
    }
    assert_eq!(desk.wrong(), []);
}

#[test]
fn a_computed_list_is_shown_element_by_element() {
    let text = "use geometry\nxs: List of 2 Real = [1, 2]\nys => xs.map(x => 2 * x)\n\
                turns: List of Angle => xs.map(x => x * 90 deg)\np => Point(3, 5)\n\
                counted: List of 2 Angle => xs.map(x => x * 45 deg)\n";
    let mut desk = Desk::of(text);
    let wanted = [
        "xs[0] 1",
        "xs[1] 2",
        "ys[0] 2",
        "ys[1] 4",
        "turns[0] 90 deg",
        "turns[1] 180 deg",
        "p.x 3",
        "p.y 5",
        "counted[0] 45 deg",
        "counted[1] 90 deg",
    ];
    assert_eq!(rows_of(&desk), wanted);
    let mut rows = desk.session.values(desk.id);
    desk.set("xs[1]", 3.0).unwrap();
    desk.session.renew_values(desk.id, rows.iter_mut());
    assert_eq!(rows[3].text, "6");
    let anew = desk.session.values(desk.id);
    assert_eq!(rows, anew, "a row that is renewed says what a new one does");
    assert_eq!((&*rows[9].text, &*rows[9].unit, &*rows[9].class), ("135", "deg", "Angle"));
}

#[test]
fn a_computed_figure_is_shown_number_by_number() {
    // the circle through (0, 0), (4, 0) and (1, 3) is the one around (2, 1) of radius √5
    let desk = Desk::of(
        "use geometry\na: Point = Point(0, 0)\nb: Point = Point(4, 0)\nc: Point = Point(1, 3)\n\
         round => Circle.through(a, b, c)\nclass Turn { by: Angle  way: Length }\n\
         turn => Turn(by: 30 deg, way: 2 m)\n",
    );
    let wanted = [
        "round.center.x 2 m",
        "round.center.y 1 m",
        "round.radius 2.23607 m",
        "turn.by 30 deg",
        "turn.way 2 m",
    ];
    assert_eq!(rows_of(&desk)[6..], wanted);
    let mut rows = desk.session.values(desk.id);
    desk.session.renew_values(desk.id, rows.iter_mut());
    assert_eq!(
        rows,
        desk.session.values(desk.id),
        "a row that is renewed says what a new one does"
    );
}

#[test]
fn a_long_computed_list_says_how_much_more_there_is() {
    let desk = Desk::of("xs => (1..1200).map(i => 2 * i)\ny => 3\n");
    let rows = rows_of(&desk);
    assert_eq!(rows[999..], ["xs[999] 2000", "xs and 200 more", "y 3"]);
}

#[test]
fn what_fails_inside_a_message_with_parameters_is_warned_of_where_it_is_asked() {
    let warned = |text: &str| {
        let mut desk = Desk::of(text);
        let found = desk.session.problems(desk.id).into_iter();
        found.map(|d| d.message).collect::<Vec<_>>()
    };
    let divided = |name: &str| format!("{name} has no value: 1 divided by zero");
    let text = "x: Real = 0\nf(t: Real) => 1 / t\ny => f(x)\nz => 2 * y\n";
    assert_eq!(warned(text), [divided("y")]);
    let text = "class A { x: Real  own => 1 / x }\na: A\ny => a.own\n";
    assert_eq!(warned(text), [divided("a.own")]);
}

#[test]
fn what_has_no_value_says_why_in_its_row() {
    let mut desk = Desk::of("x: Real = 2\ny => 1 / x\nz => [1 / x]\n");
    let mut rows = desk.session.values(desk.id);
    assert_eq!(rows_of(&desk)[1], "y 0.5");
    desk.set("x", 0.0).unwrap();
    let none = "no value: 1 divided by zero";
    assert_eq!(rows_of(&desk)[1..], [format!("y {none}"), format!("z {none}")]);
    desk.session.renew_values(desk.id, rows.iter_mut());
    assert_eq!(rows[1].text, none);
}

#[test]
fn what_a_program_computes_of_angles_is_shown_in_degrees() {
    let desk = Desk::of(
        "program Dial(n: Integer = 8, minute: Integer = 40) {\n\
         marks = for i in 0..<n { a = 360 deg * i / n }\n\
         m = 90 deg - 6 deg * minute\n\
         back = -m\n\
         plain = m * 180 / pi()\n\
         hands = repeat 2 times with h = 30 deg { next h = h + 30 deg }\n}\n\
         dial: Dial\nthird => 3 * 90 deg\nplain => third * 180 / pi()\n",
    );
    let shown = |path: &str| {
        let row = desk.row(path);
        format!("{} {}", row.text, row.unit)
    };
    assert_eq!(shown("dial.marks[3].a"), "135 deg");
    assert_eq!(shown("dial.m"), "-150 deg");
    assert_eq!(shown("dial.back"), "150 deg");
    assert_eq!(shown("dial.plain"), "-150 ");
    assert_eq!(shown("dial.hands[1].h"), "60 deg");
    assert_eq!(shown("third"), "270 deg");
    assert_eq!(shown("plain"), "270 ");
}

#[test]
fn miles_over_gallons_are_no_inverse_areas() {
    let shown = |text: &str| {
        let row = Desk::of(text).row("lasts");
        format!("{} {}", row.text, row.unit)
    };
    let text = "way: Length = 300 mi\nused: Volume = 10 gal\nlasts => way / used\n";
    assert_eq!(shown(text), "30 mi/gal");
    let text = "way: Length = 500 km\nused: Volume = 40 L\nlasts => way / used\n";
    assert_eq!(shown(text), "12.5 km/L");
}
