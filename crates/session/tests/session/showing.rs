//! Views that classes define, toolboxes, the calculator.

use crate::desk::{Desk, at};

const SPRING: &str = "\
class Spring {
    length: Real = 10
    force: Real
    constraint hooke: force = 2 * (length - 10)
    view \"Force\" => plot(force, over: length, from: 0, to: 100)
}
class Damped is Spring { view \"Force\" => plot(force, length, over: length, from: 10, to: 20) }
class Other { }
toolbox \"Mechanics\" { Damped, Spring }
s: Spring
d: Damped
";

#[test]
fn a_view_of_a_class_is_a_plot_of_each_of_its_things() {
    let desk = Desk::of(SPRING);
    let codes = desk.session.text(desk.id).diagnostics;
    assert!(codes.is_empty(), "{codes:?}");
    let views = desk.session.views_of(desk.id, &at("s"));
    assert_eq!(views.len(), 1);
    assert_eq!(views[0].title, "Force");
    assert_eq!(views[0].request.show, ["s.force"]);
    let plot = desk.session.plot(desk.id, &views[0].request).expect("it can be swept");
    let points = &plot.curves[0].points;
    assert_eq!(
        (points.first(), points.last()),
        (Some(&Some((0.0, -20.0))), Some(&Some((100.0, 180.0))))
    );
    // a subclass's view of that name takes its place
    let views = desk.session.views_of(desk.id, &at("d"));
    assert_eq!(views.len(), 1);
    assert_eq!(views[0].request.show, ["d.force", "d.length"]);
    assert!(desk.session.views_of(desk.id, &at("s.length")).is_empty());
}

#[test]
fn a_toolbox_comes_first_in_the_bin_and_in_its_order() {
    let desk = Desk::of(SPRING);
    let bin = desk.session.bin(desk.id);
    let named: Vec<(&str, Option<&str>)> =
        bin.iter().map(|e| (e.class.as_str(), e.toolbox.as_deref())).collect();
    let mechanics = Some("Mechanics");
    assert_eq!(named[..2], [("Damped", mechanics), ("Spring", mechanics)]);
    assert!(named.contains(&("Other", None)), "{named:?}");
    let desk = Desk::of("use calculator\n");
    assert_eq!(desk.session.bin(desk.id)[0].toolbox.as_deref(), Some("Calculator"));
}

#[test]
fn a_library_that_is_not_used_yet_shows_what_it_has() {
    let desk = Desk::of("use geometry\n");
    let bin = desk.session.bin_of_library("circuits");
    let resistor = bin.iter().find(|entry| entry.class == "Resistor").expect("circuits has it");
    assert!(!resistor.picture.elements.is_empty() && !resistor.doc.is_empty());
    assert!(bin.iter().all(|entry| entry.library == "circuits"), "and not what it uses");
    assert!(desk.session.bin_of_library("nowhere").is_empty());
    assert_eq!(desk.session.text(desk.id).source, "use geometry\n");
}

#[test]
fn a_view_or_toolbox_that_means_nothing_is_told_at_its_place() {
    let told = |text: &str| {
        let diagnostics = Desk::of(text).session.text(session::DocumentId(0)).diagnostics;
        diagnostics.into_iter().map(|d| format!("{}:{}", d.line, d.code)).collect::<Vec<_>>()
    };
    assert_eq!(told("class C { a: Real  view \"V\" => a }\n"), ["1:not-a-view"]);
    assert_eq!(told("class C { a: Real  view \"V\" => plot(a, over: a) }\n"), ["1:not-a-view"]);
    assert_eq!(
        told("class C { a: Real  view \"V\" => plot(b, over: a, from: 0, to: 1) }\n"),
        ["1:unknown-name"]
    );
    assert_eq!(
        told("class C { a: Real  view \"V\" => plot(a / 2, over: a, from: 0, to: 1) }\n"),
        ["1:not-a-path"]
    );
    assert_eq!(told("class C { }\ntoolbox \"T\" { C, D }\n"), ["2:unknown-class"]);
}

#[test]
fn the_calculator_follows_the_document() {
    let mut desk = Desk::of("use geometry\nl: Line { p1 = (0, 0)  p2 = (30, 40) }\n");
    let sums =
        ["l.length * 2", "l.midpoint", "1 +", "nobody", "\"{l.length} long\""].map(String::from);
    let values = desk.session.calculate(desk.id, &sums);
    assert_eq!(values[0].as_deref(), Ok("100"));
    assert_eq!(values[1].as_deref(), Ok("(15, 20)"));
    assert!(values[2].is_err());
    assert!(values[3].as_ref().is_err_and(|why| why.contains("nobody")), "{values:?}");
    assert_eq!(values[4].as_deref(), Ok("50 long"));
    desk.session.press(desk.id, &at("l.p2")).expect("it is free");
    desk.session.drag(desk.id, (60.0, 80.0));
    assert_eq!(desk.session.calculate(desk.id, &sums)[0].as_deref(), Ok("200"));
}

#[test]
fn parts_without_places_do_not_lie_on_one_another() {
    let text = "use circuits\nb: Battery\nr1: Resistor\nr2: Resistor\nr3: Resistor\nm: Ammeter\nv: Voltmeter\n";
    let desk = Desk::of(text);
    let grips = desk.session.picture(desk.id).grips;
    assert_eq!(grips.len(), 12);
    for (n, one) in grips.iter().enumerate() {
        for other in &grips[n + 1..] {
            let far = base::number::hypot(one.x - other.x, one.y - other.y);
            assert!(far > 20.0, "{} and {} are {far} apart", one.path, other.path);
        }
    }
}

/// Where a circuit's words and its earth are seen, with `y` up and with `y` down: how far to the right, and how far up.
fn circuit_seen(vertical: &str) -> Vec<(String, f64, f64)> {
    let text = format!(
        "use circuits\n{vertical}\nr: Resistor {{ a.node.at = (0, 0)  b.node.at = (100, 0) }}\n\
         b: Battery {{ a.node.at = (0, 0)  b.node.at = (0, 100) }}\n\
         s: Resistor {{ a.node.at = (100, 0)  b.node.at = (0, 100) }}\n\
         g: Ground {{ lead.node.at = (0, 100) }}\n"
    );
    let drawing = Desk::of(&text).session.picture(session::DocumentId(0)).drawing;
    let up = if drawing.vertical == drawing::Vertical::Up { 1.0 } else { -1.0 };
    let least = drawing.elements.iter().filter_map(|element| match &element.shape {
        // the shortest line of the earth
        drawing::Shape::Segment(p, q) if (q.x - p.x - 4.0).abs() < 1e-9 => {
            Some((String::from("earth"), p.x + 2.0, up * (p.y - 100.0)))
        }
        drawing::Shape::Text { at, text, anchoring: drawing::Anchoring::Away(from), .. } => {
            Some((text.clone(), at.x - from.x, up * (at.y - from.y)))
        }
        _ => None,
    });
    least.collect()
}

#[test]
fn a_circuit_with_y_upward_has_its_words_above_and_beside_what_they_are_of() {
    let half = 14.0 / f64::sqrt(2.0);
    let lies = |vertical, slanted: (f64, f64)| {
        let expected = [
            ("100 Ω", 0.0, 14.0),
            ("1.5 V", 13.0, 0.0),
            ("100 Ω", slanted.0, slanted.1),
            ("earth", 0.0, -22.0),
        ];
        let seen = circuit_seen(vertical);
        assert_eq!(seen.len(), expected.len(), "{seen:?}");
        for ((text, x, y), (words, right, above)) in seen.iter().zip(expected) {
            let is_near = (x - right).abs() < 1e-9 && (y - above).abs() < 1e-9;
            assert!(text == words && is_near, "{vertical}: {seen:?}");
        }
    };
    // what is slanted goes down to the right in one, and up in the other
    lies("", (half, half));
    lies("y down", (-half, half));
}
