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
