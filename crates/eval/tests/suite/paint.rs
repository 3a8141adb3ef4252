//! Pictures: what things draw, what the elements stand for, where things can be gripped.

use crate::build::{Build, call, num, op, part, send, text, tuple};
use drawing::{Color, Line, Point, Shape};
use eval::{Evaluator, Picture, given_values};
use kernel::{BinaryOperator, ClassKind, Count, DOCUMENT, Stay, Term};

fn picture(b: &Build) -> (Picture, Vec<String>) {
    let structure = b.structure();
    let (values, faults) = given_values(&b.document, &structure);
    assert_eq!(faults, []);
    let picture = Evaluator::new(&b.document, &structure, &values).picture(DOCUMENT);
    let path = |t: &kernel::ThingId| structure.path(&b.document, *t).to_string();
    let paths = picture.things.iter().map(path).collect();
    (picture, paths)
}

#[test]
fn an_empty_document_draws_nothing() {
    let (picture, paths) = picture(&Build::new());
    assert!(picture.drawing.elements.is_empty() && picture.grips.is_empty());
    assert!(paths.is_empty() && picture.faults.is_empty());
}

#[test]
fn a_line_is_a_segment_with_two_grips() {
    let mut b = Build::new();
    b.part(b.root(), "line", b.line);
    b.given(b.root(), "line.p2", tuple(3.0, 4.0));
    let stay =
        Stay { path: crate::build::path("line.p1"), strength: None, origin: kernel::OriginId(0) };
    let root = b.root();
    b.document.classes[root].stays.push(stay);
    let (picture, paths) = picture(&b);
    let q = Point { x: 3.0, y: 4.0 };
    assert_eq!(picture.drawing.elements.len(), 1);
    assert_eq!(picture.drawing.elements[0].shape, Shape::Segment(Point::default(), q));
    assert_eq!(paths, ["line"]);
    let grips: Vec<(Point, bool)> = picture.grips.iter().map(|g| (g.at, g.anchored)).collect();
    assert_eq!(grips, [(Point::default(), true), (q, false)]);
}

#[test]
fn merged_things_are_drawn_and_gripped_once() {
    let mut b = Build::new();
    let joint = b.class("Joint", &[]);
    b.part(joint, "at", b.point);
    let bar = b.class("Bar", &[]);
    b.part(bar, "a", joint);
    b.part(bar, "b", joint);
    let ends = vec![part("a.at"), part("b.at")];
    let all = vec![call("segment", ends), part("a.picture"), part("b.picture")];
    b.message(bar, "picture", &[], call("picture", all));
    for name in ["one", "two"] {
        b.part(b.root(), name, bar);
    }
    b.merge(b.root(), &["one.b", "two.a"]);
    b.given(b.root(), "one.b.at", tuple(5.0, 5.0));
    b.given(b.root(), "two.b.at", tuple(9.0, 5.0));
    let (picture, paths) = picture(&b);
    assert_eq!(picture.grips.len(), 3);
    // Two segments and three dots: the joint that both bars draw is there once.
    assert_eq!(picture.drawing.elements.len(), 5);
    assert_eq!(paths, ["one", "one.a.at", "one.b.at", "two", "two.b.at"]);
}

#[test]
fn a_part_without_a_picture_leaves_the_others_alone() {
    let mut b = Build::new();
    let broken = b.class("Broken", &[]);
    let nowhere = op(BinaryOperator::Divide, num(1.0), num(0.0));
    b.message(broken, "picture", &[], call("dot", vec![nowhere, num(0.0)]));
    b.part(b.root(), "broken", broken);
    b.part(b.root(), "line", b.line);
    let (picture, _) = picture(&b);
    assert_eq!(picture.drawing.elements.len(), 1);
    assert_eq!(picture.faults.len(), 1);
    assert_eq!(picture.faults[0].message, "1 divided by zero");
    let origin = b.document.classes[broken].messages[0].origin;
    assert_eq!(picture.faults[0].origin, Some(origin));
}

#[test]
fn styles_apply_to_whole_pictures() {
    let mut b = Build::new();
    let square = b.class("Mark", &[]);
    let corners = vec![tuple(0.0, 0.0), tuple(2.0, 1.0)];
    let filled = send(call("rectangle", corners), "filled", vec![text("steelblue")]);
    let words = send(call("label", vec![tuple(1.0, 1.0), text("hi")]), "centered", vec![]);
    let both = call("picture", vec![filled, words]);
    let styled = send(send(both, "dashed", vec![]), "accent", vec![]);
    b.message(square, "picture", &[], styled);
    b.part(b.root(), "mark", square);
    let (picture, _) = picture(&b);
    let [box_, words] = picture.drawing.elements.as_slice() else { panic!("two elements") };
    assert_eq!(box_.style.fill, Some(Color::Named("steelblue".into())));
    assert_eq!((box_.style.line, &box_.style.color), (Line::Dashed, &Color::Accent));
    let Shape::Polyline { points, closed: true } = &box_.shape else { panic!("a closed shape") };
    assert_eq!(points[2], Point { x: 2.0, y: 1.0 });
    let Shape::Text { anchoring, .. } = &words.shape else { panic!("words") };
    assert_eq!(*anchoring, drawing::Anchoring::Center);
}

#[test]
fn what_lines_surround_is_filled_once() {
    let corners = || vec![tuple(0.0, 0.0), tuple(4.0, 0.0), tuple(0.0, 3.0)];
    let sides = || {
        let [a, b, c] = [0, 1, 2].map(|i| corners()[i].clone());
        vec![
            call("segment", vec![a.clone(), b.clone()]),
            call("segment", vec![c.clone(), b]),
            call("segment", vec![c, a]),
        ]
    };
    let drawn = |of: Vec<Term>| {
        let mut b = Build::new();
        let class = b.class("Mark", &[]);
        let filled = send(call("picture", of), "filled", vec![text("steelblue")]);
        b.message(class, "picture", &[], filled);
        b.part(b.root(), "mark", class);
        let (picture, _) = picture(&b);
        assert_eq!(picture.faults, []);
        picture.drawing.elements
    };
    let is_filled = |e: &drawing::Element| e.style.fill.is_some();
    let found = drawn(sides());
    let fills: Vec<bool> = found.iter().map(is_filled).collect();
    assert_eq!(fills, [true, false, false, false]);
    assert_eq!(found[0].style.line, Line::None);
    // a region beside its edges, whichever way these run
    let mut beside = vec![call("region", vec![Term::List(corners())])];
    beside.extend(sides());
    let found = drawn(beside);
    let fills: Vec<bool> = found.iter().map(is_filled).collect();
    assert_eq!(fills, [true, false, false, false]);
    assert_eq!(found[0].style.line, Line::Solid);
    // what a dimension is shown by closes no ring
    let mut sides = sides();
    let ends = Term::List([0, 1, 0, 1].map(|i| corners()[i].clone()).to_vec());
    sides[0] = send(sides[0].clone(), "measured", vec![text("aligned"), ends]);
    assert_eq!(drawn(sides).len(), 3);
}

#[test]
fn several_superclasses_draw_together() {
    let mut b = Build::new();
    let dot = b.class("Dot", &[]);
    b.message(dot, "picture", &[], call("dot", vec![num(7.0), num(8.0)]));
    let both = b.class("LineAndDot", &[("line", b.line), ("dot", dot)]);
    b.part(b.root(), "it", both);
    let (drawn, _) = picture(&b);
    assert_eq!(drawn.drawing.elements.len(), 2);
    // A picture of its own is the whole picture.
    b.message(both, "picture", &[], part("dot.picture"));
    assert_eq!(picture(&b).0.drawing.elements.len(), 1);
}

#[test]
fn five_thousand_lines_are_drawn_within_the_budget_of_steps() {
    let mut b = Build::new();
    let lines = b.kind("List of Line", ClassKind::List(b.line));
    b.part(b.root(), "lines", lines);
    let root = b.root();
    b.document.classes[root].parts[0].count = Some(Count::Fixed(5000));
    let structure = b.structure();
    let mut values = kernel::Values::new(structure.slots.len());
    for (i, slot) in structure.slots.ids().enumerate() {
        values.put(slot, kernel::Value::Number(i as f64));
    }
    let evaluator = Evaluator::new(&b.document, &structure, &values);
    let picture = evaluator.picture(DOCUMENT);
    assert_eq!(picture.drawing.elements.len(), 5000);
    assert_eq!(picture.grips.len(), 10_000);
    assert_eq!(picture.faults, []);
}
