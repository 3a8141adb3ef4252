//! What is offered for a selection, and that taking it does what it says.

use crate::desk::{Desk, Library, at};
use session::view::{Annotation, Offer, Shows};
use session::{Command, Host, Relations, Session};
use std::cell::Cell;
use std::rc::Rc;

const FIGURE: &str = "\
use geometry
a: Line { p1 = (0, 0)  p2 = (100, 10) }
b: Line { p1 = (0, 50)  p2 = (90, 80) }
p: Point = (40, 120)
c: Circle { center = (200, 50)  radius = 20 }
d: Circle { center = (300, 50)  radius = 30 }
";

pub(crate) fn offers(desk: &Desk, paths: &[&str]) -> Vec<Offer> {
    let paths: Vec<_> = paths.iter().map(|path| at(path)).collect();
    desk.session.offers(desk.id, &paths)
}

pub(crate) fn labels(desk: &Desk, paths: &[&str]) -> Vec<String> {
    offers(desk, paths).into_iter().map(|offer| offer.label).collect()
}

pub(crate) fn take(desk: &mut Desk, paths: &[&str], label: &str, value: Option<&str>) {
    let all = offers(desk, paths);
    let offer = all.iter().find(|offer| offer.label == label).expect("it is offered");
    let command = desk.session.said(desk.id, offer, value).expect("it fits");
    desk.apply(&command).expect("it can be said");
    let status = desk.session.status(desk.id);
    assert!(status.satisfied, "{label}: {}", status.message);
    // the places that the text gives have to yield, or to become one
    let others: Vec<_> = desk
        .wrong()
        .into_iter()
        .filter(|(code, _)| code != "given-yields" && code != "unlike-given")
        .collect();
    assert_eq!(others, [], "{label}: {}", desk.text());
}

#[test]
fn a_selection_is_offered_what_fits_it() {
    let desk = Desk::of(FIGURE);
    let has = |paths: &[&str], wanted: &[&str]| {
        let found = labels(&desk, paths);
        for label in wanted {
            assert!(found.iter().any(|l| l == label), "{label} for {paths:?}: {found:?}");
        }
    };
    has(&["a"], &["horizontal", "vertical", "length"]);
    has(&["a", "b"], &["parallel", "perpendicular", "equal length", "angle", "ratio"]);
    has(&["p", "a"], &["midpoint", "on"]);
    has(&["p", "c"], &["on"]);
    has(&["a.p2", "b.p1"], &["merge", "horizontal", "vertical", "distance"]);
    has(&["c", "d"], &["equal radius", "concentric", "ratio"]);
    let three = "use geometry\na: Line\nb: Line { p1 = (0, 90) }\nc: Line { p1 = (90, 0) }\n";
    let three = labels(&Desk::of(three), &["a", "b", "c"]);
    assert!(three.iter().any(|l| l == "equal length"), "{three:?}");
    assert!(three.iter().all(|l| l != "merge"), "{three:?}");
    has(&["c"], &["radius"]);
    let of_point = labels(&desk, &["p"]);
    assert!(of_point.iter().all(|l| l != "horizontal"), "{of_point:?}");
    assert!(labels(&desk, &["nowhere"]).is_empty());
    assert!(labels(&desk, &[]).is_empty());
}

#[test]
fn what_is_offered_holds_once_it_is_taken() {
    let mut desk = Desk::of(FIGURE);
    take(&mut desk, &["a"], "horizontal", None);
    assert_eq!(desk.place("a.p1").1, desk.place("a.p2").1);
    take(&mut desk, &["a", "b"], "parallel", None);
    assert_eq!(desk.place("b.p1").1, desk.place("b.p2").1);
    take(&mut desk, &["p", "a"], "midpoint", None);
    let ends = (desk.place("a.p1").0, desk.place("a.p2").0);
    assert!((desk.place("p").0 - f64::midpoint(ends.0, ends.1)).abs() < 1e-9);
    take(&mut desk, &["c", "d"], "concentric", None);
    assert_eq!(desk.place("c.center"), desk.place("d.center"));
}

#[test]
fn a_dimension_begins_with_what_is_measured_and_takes_another_value() {
    let mut desk = Desk::of("use geometry\np: Point = (0, 0)\nq: Point = (30, 40)\n");
    let distance = offers(&desk, &["p", "q"]).into_iter().find(|o| o.label == "distance");
    let distance = distance.expect("it is offered");
    assert_eq!(distance.value.as_deref(), Some("50"));
    let before = (desk.place("p"), desk.place("q"));
    desk.apply(&distance.command(None)).expect("it can be said");
    assert_eq!((desk.place("p"), desk.place("q")), before, "nothing moves");
    desk.undo();
    take(&mut desk, &["p", "q"], "distance", Some("100"));
    let (p, q) = (desk.place("p"), desk.place("q"));
    assert!((base::number::hypot(q.0 - p.0, q.1 - p.1) - 100.0).abs() < 1e-9);
    // it is typed anew where it stands on the drawing
    let said = desk.session.annotations(desk.id).pop().expect("it stands there");
    assert_eq!((said.words.as_str(), said.of.join(" ").as_str()), ("100", "p q"));
    let typed = said.typed.expect("it can be typed anew");
    let command = desk.session.said(desk.id, &typed, Some("20")).expect("it fits");
    desk.apply(&command).expect("it can be said");
    let (p, q) = (desk.place("p"), desk.place("q"));
    assert!((base::number::hypot(q.0 - p.0, q.1 - p.1) - 20.0).abs() < 1e-9);
    assert!(desk.text().ends_with("constraint p.distance(to: q) = 20\n"), "{}", desk.text());
}

#[test]
fn an_offer_is_foreseen_and_nothing_changes() {
    let desk = Desk::of(FIGURE);
    let before = desk.moment();
    let all = offers(&desk, &["a"]);
    let level = all.iter().find(|offer| offer.label == "horizontal").expect("it is offered");
    let seen = desk.session.foreseen(desk.id, &level.command(None)).expect("it can be said");
    assert!(!seen.picture.elements.is_empty() && !seen.moved.is_empty());
    assert_eq!(desk.moment(), before);
}

#[test]
fn what_holds_by_a_constraint_is_not_offered_again() {
    let mut desk = Desk::of("use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\n");
    // it is level, but nothing says so
    assert!(labels(&desk, &["a"]).iter().any(|label| label == "horizontal"));
    take(&mut desk, &["a"], "horizontal", None);
    let again = labels(&desk, &["a"]);
    assert!(again.iter().all(|label| label != "horizontal"), "{again:?}");
    assert!(again.iter().any(|label| label == "vertical"), "{again:?}");
}

const ELBOW: &str = "use geometry
a: Line { p1 = (0, 100)  p2 = (0, 0) }
b: Line { p2 = (200, 0) }
merge a.p2 = b.p1
constraint a.p1.x = a.p2.x
constraint b.p1.y = b.p2.y
";

#[test]
fn a_corner_is_rounded_where_two_lines_meet() {
    for selected in [&["a.p2"][..], &["b.p1"], &["a", "b"]] {
        let mut desk = Desk::of(ELBOW);
        let free = desk.session.status(desk.id).freedom;
        take(&mut desk, selected, "round", Some("10"));
        assert_eq!(desk.place("a.p1"), (0.0, 100.0));
        assert_eq!(desk.place("b.p2"), (200.0, 0.0));
        let (a, b) = (desk.place("a.p2"), desk.place("b.p1"));
        let near = |p: (f64, f64), q: (f64, f64)| base::number::hypot(p.0 - q.0, p.1 - q.1) < 1e-6;
        assert!(near(a, (0.0, 10.0)) && near(b, (10.0, 0.0)), "{a:?} {b:?}\n{}", desk.text());
        assert_eq!(desk.wrong(), [], "{}", desk.text());
        assert_eq!(desk.session.status(desk.id).freedom, free, "{}", desk.text());
        let sweep = desk.number("arc.sweep");
        assert!((sweep - std::f64::consts::FRAC_PI_2).abs() < 1e-6, "{sweep}");
    }
    let desk = Desk::of(ELBOW);
    let round = offers(&desk, &["a.p2"]).into_iter().find(|offer| offer.label == "round");
    let refused = desk.session.said(desk.id, &round.expect("it is offered"), Some("500"));
    let refused = refused.expect_err("it is longer than the lines");
    assert_eq!(refused.message, "500 is no radius that fits this corner");
}

#[test]
fn where_three_lines_meet_or_two_are_in_line_nothing_is_rounded() {
    let three = format!("{ELBOW}c: Line {{ p2 = (50, -80) }}\nmerge b.p1 = c.p1\n");
    let level = ELBOW.replace("(0, 100)", "(-100, 0)").replace("constraint a.p1.x = a.p2.x\n", "");
    for text in [three, level] {
        let desk = Desk::of(&text);
        assert!(labels(&desk, &["a.p2"]).iter().all(|label| label != "round"), "{text}");
    }
}

#[test]
fn a_rectangle_becomes_its_four_lines() {
    let mut desk =
        Desk::of("use geometry\nr: Rectangle { corner = (10, 20)  width = 30; height = 40 }\n");
    take(&mut desk, &["r"], "four lines", None);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert!(!desk.text().contains("Rectangle"), "{}", desk.text());
    assert_eq!((desk.place("line.p1"), desk.place("line3.p1")), ((10.0, 20.0), (40.0, 60.0)));
    assert_eq!(desk.session.status(desk.id).freedom, 4);
    // what something else speaks of stays
    let spoken = Desk::of("use geometry\nr: Rectangle\np: Point\nconstraint p = r.center\n");
    assert!(labels(&spoken, &["r"]).iter().all(|label| label != "four lines"));
}

#[test]
fn what_a_class_has_said_is_not_offered_again() {
    let mut desk = Desk::of(FIGURE);
    take(&mut desk, &["a.p1", "a.p2", "b"], "symmetric points", None);
    let again = labels(&desk, &["a.p1", "a.p2", "b"]);
    assert!(!again.contains(&"symmetric points".into()), "{again:?}");
    assert!(!labels(&desk, &["c", "d"]).contains(&"equal radii".into()));
}

#[test]
fn radii_that_a_hand_makes_equal_are_given_so() {
    let mut desk = Desk::of(FIGURE);
    take(&mut desk, &["c", "d"], "equal radius", None);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert!(desk.text().contains("radius = 25"), "{}", desk.text());
}

#[test]
fn a_dimension_that_is_said_already_is_given_another_value() {
    let mut desk = Desk::of(FIGURE);
    take(&mut desk, &["a"], "length", Some("120"));
    take(&mut desk, &["a"], "length", Some("90"));
    assert_eq!(desk.text().matches("a.length").count(), 1, "{}", desk.text());
    assert!(desk.text().contains("constraint a.length = 90"), "{}", desk.text());
    // its ends are given where they lie now
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn an_offer_that_is_no_dimension_leaves_what_is_said() {
    let mut desk =
        Desk::of(&format!("{FIGURE}constraint a.length = 100\nconstraint a.p1.y = 40\n"));
    take(&mut desk, &["a", "b"], "equal length", None);
    take(&mut desk, &["a"], "horizontal", None);
    let text = desk.text();
    for said in ["a.length = 100", "a.length = b.length", "a.p1.y = 40", "a.p1.y = a.p2.y"] {
        assert!(text.contains(&format!("constraint {said}\n")), "{said}: {text}");
    }
}

#[test]
fn a_typed_number_takes_the_place_of_a_number_alone() {
    let said = |text: &str| {
        let desk = Desk::of(&format!("{FIGURE}{text}"));
        let length = offers(&desk, &["a"]).into_iter().find(|offer| offer.label == "length");
        desk.session.said(desk.id, &length.expect("it is offered"), Some("90")).expect("it fits")
    };
    let Command::Text(text) = said("// As built.\nconstraint a.length = 100 // short\n") else {
        panic!("the number is replaced");
    };
    assert!(text.contains("// As built.\nconstraint a.length = 90 // short\n"), "{text}");
    let formula = said("constraint a.length = 2 * b.length\n");
    assert!(matches!(formula, Command::Edit { .. }), "{formula:?}");
    // one that yields stays; what is in force is another
    let Command::Text(text) = said("weak constraint a.length = 100\nconstraint a.length = 80\n")
    else {
        panic!("the number is replaced");
    };
    assert!(text.contains("weak constraint a.length = 100\nconstraint a.length = 90\n"), "{text}");
}

#[test]
fn what_only_happens_to_be_so_is_offered_whatever_stands_first() {
    let lines = "use geometry\ne: Line { p1 = (0, 0)  p2 = (10, 30) }\nf: Line { p1 = (50, 0)  p2 = (90, 70) }\n\
                 c: Line { p1 = (0, 100)  p2 = (50, 110) }\nd: Line { p1 = (0, 200)  p2 = (100, 220) }\n";
    let told = |desk: &Desk| desk.session.offers_and_held(desk.id, &[at("c"), at("d")]);
    let (offers, held) = told(&Desk::of(lines));
    assert!(held.is_empty() && offers.iter().any(|offer| offer.label == "parallel"), "{held:?}");
    let said = format!("{lines}constraint c.parallel(to: e)\nconstraint e.parallel(to: d)\n");
    assert_eq!(told(&Desk::of(&said)).1, ["parallel"]);
}

#[test]
fn a_dimension_only_reads_what_it_can_measure() {
    let desk = Desk::of(&format!("{FIGURE}arc: Arc\n"));
    let reads = |path: &str, label: &str| {
        let offer = offers(&desk, &[path]).into_iter().find(|offer| offer.label == label);
        desk.session.only_read(desk.id, &offer.expect("it is offered")).is_some()
    };
    assert!(reads("a", "length") && reads("c", "radius"));
    assert!(!reads("arc", "length") && !reads("arc", "radius"));
}

#[test]
fn sides_of_a_rectangle_are_picked_constrained_and_rounded() {
    let text = "use geometry\nr: Rectangle { corner = (0, 0)  width = 300; height = 200 }\nl: Line { p1 = (0, 300)  p2 = (100, 350) }\n";
    let mut desk = Desk::of(text);
    let picture = desk.session.picture(desk.id);
    let tag = picture.paths.iter().position(|path| path == "r.side3").expect("it is seen");
    assert_eq!(picture.drawn_by[tag].as_deref(), Some("r"));
    let is_top = |e: &&drawing::Element| e.tag.0 == tag as u32;
    assert_eq!(picture.drawing.elements.iter().filter(is_top).count(), 1);
    // a corner that is computed is gripped as well, each once
    let grips: Vec<&str> = picture.grips.iter().map(|grip| grip.path.as_str()).collect();
    assert_eq!(grips, ["r.corner", "l.p1", "l.p2", "r.corner2", "r.far", "r.corner4"]);
    desk.drag("r.far", &[(310.0, 220.0)]);
    assert_eq!((desk.number("r.width"), desk.number("r.corner.y")), (310.0, 0.0));
    desk.undo();
    take(&mut desk, &["r.side3", "l"], "equal length", None);
    take(&mut desk, &["r.side4"], "length", Some("150"));
    assert!((desk.number("r.height") - 150.0).abs() < 1e-9, "{}", desk.text());
    take(&mut desk, &["r.far", "l.p1"], "coincident", None);
    assert!((desk.number("l.p1.y") - 150.0).abs() < 1e-9, "{}", desk.text());

    let mut round = Desk::of(text);
    take(&mut round, &["r.far"], "round", Some("25"));
    assert!((round.number("arc.center.x") - 275.0).abs() < 1e-6, "{}", round.text());
    assert!((round.number("arc.center.y") - 175.0).abs() < 1e-6, "{}", round.text());
    let sides = Desk::of(text);
    assert!(labels(&sides, &["r.side4", "r.side1"]).iter().any(|label| label == "round"));
    assert!(labels(&sides, &["r.side4", "r.side2"]).iter().all(|label| label != "round"));
}

#[test]
fn a_dimension_goes_with_what_it_measures() {
    let text = "use geometry\na: Line { p1 = (0, 0)  p2 = (30, 40) }\nb: Line { p1 = (0, 90)  p2 = (30, 90) }\nlong: ReferenceDistance { from = a.p1  to = a.p2 }\nfar: Distance { value = 50 }\nmerge a.p2 = far.from\nmerge b.p1 = far.to\nother: ReferenceDistance { from = b.p1  to = b.p2 }\n";
    let desk = Desk::of(text);
    assert!(desk.session.is_measured(desk.id, &at("a")));
    let (command, along) = desk.session.deletion(desk.id, &[at("a")]).expect("it can go");
    assert!(along.iter().any(|said| said.starts_with("long: ReferenceDistance")), "{along:?}");
    assert!(along.iter().any(|said| said.starts_with("far: Distance")), "{along:?}");
    let Command::Text(rest) = command else { panic!("{command:?}") };
    assert!(!rest.contains("long") && !rest.contains("far"), "{rest}");
    assert!(rest.contains("other: ReferenceDistance { from = b.p1  to = b.p2 }"), "{rest}");
    let lone = Desk::of("use geometry\na: Line\nb: Line\nmerge a.p1 = b.p1\n");
    assert!(!lone.session.is_measured(lone.id, &at("a")));
}

#[test]
fn a_dimension_stays_where_what_its_value_was_said_by_goes() {
    let text = "use geometry\na: Line { p1 = (0, 0)  p2 = (30, 40) }\nw: Length = 50\nd: Distance { from = a.p1  to = a.p2  value = w }\n";
    let desk = Desk::of(text);
    assert!(!desk.session.is_measured(desk.id, &at("w")));
    let (_, along) = desk.session.deletion(desk.id, &[at("w")]).expect("it can go");
    assert!(along.iter().all(|said| !said.starts_with("d: Distance")), "{along:?}");
    assert!(desk.session.is_measured(desk.id, &at("a")));
    // what goes alone is deleted by its name
    let lone = Desk::of("use geometry\na: Line\nb: Line\n");
    let (command, along) = lone.session.deletion(lone.id, &[at("a")]).expect("it can go");
    assert_eq!((command, along), (Command::Delete(at("a")), Vec::new()));
}

/// The libraries, and how often one was read.
struct Counted(Rc<Cell<u32>>);

impl Host for Counted {
    fn read(&self, name: &str) -> Option<String> {
        self.0.set(self.0.get() + 1);
        Library.read(name)
    }
}

#[test]
fn nothing_is_read_anew_for_what_fits_a_selection() {
    let read = Rc::new(Cell::new(0));
    let mut session = Session::new(Box::new(Counted(Rc::clone(&read))));
    let id = session.open("desk", FIGURE);
    read.set(0);
    assert_eq!(session.offers_and_held(id, &[]), (Vec::new(), Vec::new()));
    assert_eq!(read.get(), 0);
    assert_ne!(session.offers_and_held(id, &[at("a")]).0, []);
    let sums = ["a.length", "[1, 2, 4].sum", "[[1, 2], [3, 5]][1].sum"].map(String::from);
    let answers = session.calculate(id, &sums).into_iter().collect::<Result<Vec<_>, _>>();
    assert_eq!(answers.expect("all mean something")[1..], ["7", "8"]);
    assert_eq!(read.get(), 0, "what is asked is read alone");
}

#[test]
fn what_constraints_say_stands_on_the_drawing_and_is_typed_anew() {
    let mut desk = Desk::of(
        "use geometry\nunit mm\n\
         a: Line { p1 = (0, 0)  p2 = (30, 0) }\nb: Line { p2 = (30, 20) }\nmerge a.p2 = b.p1\n\
         c: Circle { center = (80, 0)  radius = 5 }\nd: Circle { center = (80, 40)  radius = 5 }\n\
         constraint a.p1.y = a.p2.y\nconstraint a.length = 3 cm\nconstraint 20 mm = b.length\n\
         constraint a.perpendicular(to: b)\nconstraint c.radius = 5\nconstraint d.radius = c.radius\n\
         constraint b.angle(to: a) = -90 deg\nconstraint a.p1.x = 0\nconstraint a.length + b.length = 50 mm\n",
    );
    let seen =
        |one: &Annotation| (one.words.clone(), one.shows, one.of.join(" "), one.typed.is_some());
    let all = desk.session.annotations(desk.id);
    let of =
        |words: &str, shows, of: &str, typed| (String::from(words), shows, String::from(of), typed);
    // where an end of one is that of another, it goes by its first name; a sum and a coordinate stand nowhere
    assert_eq!(
        all.iter().map(seen).collect::<Vec<_>>(),
        [
            of("H", Shows::Relation, "a.p1 a.p2", false),
            of("30 mm", Shows::Length, "a", true),
            of("20 mm", Shows::Length, "b", false),
            of("⟂", Shows::Relation, "a b", false),
            of("R 5 mm", Shows::Radius, "c", true),
            of("=", Shows::Relation, "d c", false),
            of("-90°", Shows::Angle([false; 2]), "b a", true),
        ]
    );
    assert!(all.iter().all(|one| one.holds));
    // the same line has another length
    let typed = all[4].typed.clone().expect("it can be typed anew");
    let command = desk.session.said(desk.id, &typed, Some("8")).expect("it fits");
    desk.apply(&command).expect("it can be said");
    assert!(desk.text().contains("constraint c.radius = 8\n"), "{}", desk.text());
    assert_eq!(desk.session.annotations(desk.id)[4].words, "R 8 mm");
    assert!(desk.session.status(desk.id).satisfied);
    // what is switched off says nothing
    desk.apply(&Command::Enable { path: at("constraint2"), on: false })
        .expect("it is switched off");
    assert_eq!(desk.session.annotations(desk.id).len(), 6);
}

#[test]
fn a_relation_that_is_a_thing_has_its_sign_on_the_drawing() {
    let desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (30, 0) }\nb: Line { p1 = (0, 9)  p2 = (30, 9) }\n\
         parallel: Parallel\nmerge a = parallel.a\nmerge b = parallel.b\n\
         box: Quadrilateral\nconstraint a.p1.y = a.p2.y\n\
         class Both { a, b: Line  constraint a.parallel(to: b) }\nboth: Both\n",
    );
    assert!(desk.wrong().is_empty(), "{:?}", desk.wrong());
    let all = desk.session.annotations(desk.id);
    let all: Vec<String> =
        all.iter().map(|one| format!("{} {} {}", one.path, one.words, one.of.join(" "))).collect();
    // what is drawn itself is seen as it is
    assert_eq!(all, ["parallel ∥ a b", "constraint1 H a.p1 a.p2"]);
}

/// The annotations of a desk: the path, the words and what each is of.
fn told(desk: &Desk) -> Vec<String> {
    let all = desk.session.annotations(desk.id);
    all.iter().map(|one| format!("{} {} {}", one.path, one.words, one.of.join(" "))).collect()
}

#[test]
fn every_relation_of_the_geometry_has_the_usual_sign() {
    let figures = "use geometry\nunit mm\np: Point = (0, 9)\nq: Point = (5, 9)\nr: Point = (2, 9)\n\
        k: Line { p1 = (0, 0)  p2 = (30, 0) }\nl: Line { p1 = (0, 50)  p2 = (30, 50) }\n\
        c: Circle { center = (100, 0)  radius = 9 }\nd: Circle { center = (200, 0)  radius = 9 }\n\
        a: Arc { center = (300, 0)  start = (310, 0)  end = (300, 10) }\n";
    let sign = |class: &str, parts: &[(&str, &str)]| {
        let merges = parts.iter().map(|(part, of)| format!("merge {of} = it.{part}\n"));
        let text = format!("{figures}it: {class}\n{}", merges.collect::<String>());
        let all = told(&Desk::of(&text));
        assert_eq!(all.len(), 1, "{class}: {all:?}");
        let of: Vec<&str> = parts.iter().map(|(_, of)| *of).collect();
        let of = format!(" {}", of.join(" "));
        let sign = all[0].strip_prefix("it ").and_then(|said| said.strip_suffix(&of));
        sign.unwrap_or_else(|| panic!("{class}: {all:?}")).to_string()
    };
    let lines = [("a", "k"), ("b", "l")];
    let circles = [("a", "c"), ("b", "d")];
    let at_arc = [("arc", "a"), ("line", "k")];
    let at_circle = [("line", "k"), ("circle", "c")];
    let ends = [("a", "p"), ("b", "q")];
    assert_eq!(sign("EqualLengths", &lines), "=");
    assert_eq!(sign("Parallel", &lines), "∥");
    assert_eq!(sign("Perpendicular", &lines), "⟂");
    assert_eq!(sign("PointOnLine", &[("line", "k"), ("point", "p")]), "on");
    assert_eq!(sign("PointOnCircle", &[("circle", "c"), ("point", "p")]), "on");
    assert_eq!(sign("PointOnArc", &[("arc", "a"), ("point", "p")]), "on");
    assert_eq!(sign("SymmetricPoints", &[&[("axis", "k")], &ends[..]].concat()), "sym");
    assert_eq!(sign("SymmetricAboutPoint", &[&[("center", "r")], &ends[..]].concat()), "sym");
    assert_eq!(sign("EqualRadii", &circles), "=");
    assert_eq!(sign("Concentric", &circles), "◎");
    assert_eq!(sign("TangentAtStart", &at_arc), "T");
    assert_eq!(sign("TangentAtEnd", &at_arc), "T");
    assert_eq!(sign("TangentOnLeft", &at_circle), "T");
    assert_eq!(sign("TangentOnRight", &at_circle), "T");
    assert_eq!(sign("TangentOutside", &circles), "T");
    assert_eq!(sign("TangentInside", &circles), "T");
    assert_eq!(sign("OffsetFromLine", &[("line", "k"), ("point", "p")]), "50 mm");
    assert_eq!(sign("AngleBetween", &[("from", "k"), ("to", "l")]), "90°");
}

#[test]
fn the_value_of_a_relation_that_is_a_thing_is_typed_on_the_drawing() {
    let mut desk = Desk::of(
        "use geometry\nunit mm\nk: Line { p1 = (0, 0)  p2 = (30, 0) }\np: Point = (9, 20)\n\
         it: OffsetFromLine { value = 20 }\nmerge k = it.line\nmerge p = it.point\n",
    );
    let said = desk.session.annotations(desk.id).pop().expect("it stands there");
    assert_eq!((said.shows, said.words.as_str()), (Shows::Length, "20 mm"));
    let typed = said.typed.expect("it can be typed");
    assert_eq!(typed.value.as_deref(), Some("20 mm"));
    let command = desk.session.said(desk.id, &typed, Some("35 mm")).expect("it fits");
    desk.apply(&command).expect("it can be said");
    let [(x, y), (x1, y1), (x2, y2)] = ["p", "k.p1", "k.p2"].map(|path| desk.place(path));
    let across = (x2 - x1) * (y - y1) - (y2 - y1) * (x - x1);
    let offset = across / base::number::hypot(x2 - x1, y2 - y1);
    assert!((offset - 35.0).abs() < 1e-9, "{offset}");
    assert_eq!(desk.session.annotations(desk.id)[0].words, "35 mm");
}

#[test]
fn a_dimension_that_only_follows_is_made_to_rule() {
    let text = "use geometry\nunit mm\na: Line { p1 = (0, 0)  p2 = (30, 40) }\n\
        c: Circle { center = (200, 0)  radius = 9 }\n\
        far: ReferenceDistance { from = a.p1  to = a.p2 }\nround: ReferenceRadius { circle = c }\n";
    let mut desk = Desk::of(text);
    let offer = |desk: &Desk, path: &str| {
        let all = offers(desk, &[path]).into_iter();
        all.into_iter().find(|offer| offer.label.starts_with("ruling")).expect("it is offered")
    };
    let far = offer(&desk, "far");
    assert_eq!((far.label.as_str(), far.value.as_deref()), ("ruling distance", Some("50 mm")));
    let command = desk.session.said(desk.id, &far, Some("100 mm")).expect("it fits");
    desk.apply(&command).expect("it can be said");
    let (p, q) = (desk.place("a.p1"), desk.place("a.p2"));
    assert!((base::number::hypot(q.0 - p.0, q.1 - p.1) - 100.0).abs() < 1e-9, "{p:?} {q:?}");
    // it has taken the place of the one that followed
    assert!(!desk.text().contains("far:"), "{}", desk.text());
    assert_eq!(told(&desk), ["constraint1 100 mm a.p1 a.p2"]);
    take(&mut desk, &["round"], "ruling radius", Some("12 mm"));
    assert_eq!(desk.number("c.radius"), 12.0);
    // where it would contradict something that is left to be asked, as of any dimension
    let held = format!("{text}constraint a.length = 50 mm\n");
    let desk = Desk::of(&held);
    let command = desk.session.said(desk.id, &offer(&desk, "far"), Some("70 mm")).expect("it fits");
    let asked = desk.session.over_constrained(desk.id, &command).expect("it contradicts");
    assert!(asked.message.contains("length of a = 50 mm"), "{}", asked.message);
}

#[test]
fn what_speaks_of_a_dimension_that_follows_stays_when_it_is_made_to_rule() {
    let text = "use geometry\nunit mm\na: Line { p1 = (0, 0)  p2 = (30, 40) }\n\
        far: ReferenceDistance { from = a.p1  to = a.p2 }\n";
    let speaking = [
        "half: Length => far.reading / 2\n",
        "said: Text => far.shown\n",
        "k: Circle { radius = 50 }\nconstraint k.radius = far.reading\n",
        "q: Point\nmerge far.from = q\n",
        "check \"it is far\" { expect far.reading > 3 }\n",
    ];
    for more in speaking {
        let before = format!("{text}{more}");
        let mut desk = Desk::of(&before);
        take(&mut desk, &["far"], "ruling distance", Some("100 mm"));
        // it rules, and what followed is still read
        let after = desk.text();
        assert!(after.contains("constraint a.p1.distance(to: a.p2) = 100 mm"), "{after}");
        let last = more.lines().last().expect("it says something");
        assert!(after.contains("far: ReferenceDistance") && after.contains(last), "{after}");
        desk.undo();
        assert_eq!(desk.text(), before);
    }
    let two = format!(
        "{text}b: Line {{ p1 = (0, 0)  p2 = (30, 0) }}\nang: ReferenceAngle {{ from = a  to = b }}\n"
    );
    let desk = Desk::of(&two);
    let turned = offers(&desk, &["ang"]).pop().expect("it is offered");
    let refused =
        desk.session.said(desk.id, &turned, Some("200 deg")).expect_err("it is too large");
    assert!(refused.message.contains("at most 180 deg"), "{}", refused.message);
}

#[test]
fn what_is_computed_is_there_while_it_has_no_answer() {
    let mut desk = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (30, 0) }\nb: Line { p1 = (10, 9)  p2 = (10, -9) }\n\
         p: Point => Point.intersection(a, b)\nbox: RegularPolygon { sides = 6 }\n",
    );
    let is_there = |desk: &Desk, path: &str| desk.session.is_there(desk.id, &at(path));
    assert!(is_there(&desk, "p") && is_there(&desk, "box.edges[5]"));
    assert!(!is_there(&desk, "q") && !is_there(&desk, "p.nowhere"));
    // side by side they have no intersection, which is there all the same
    desk.move_to("b.p1", 40.0, -9.0).expect("it is free");
    assert!(is_there(&desk, "p"));
    desk.type_in("box.sides", "4").expect("it is a count");
    assert!(!is_there(&desk, "box.edges[5]"));
}

#[test]
fn how_far_lines_circles_and_points_are_apart_is_offered_first() {
    let figure = format!("{FIGURE}e: Line {{ p1 = (0, 80)  p2 = (100, 90) }}\n");
    let desk = Desk::of(&figure);
    let first = |paths: &[&str]| {
        let sized = offers(&desk, paths).into_iter().find(|offer| offer.value.is_some());
        let sized = sized.map(|offer| (offer.label, offer.members));
        let (label, members) = sized.expect("a size is offered");
        format!("{label}: {members}")
    };
    // what runs alongside is so far apart, what does not has an angle
    // and is kept so
    let kept = "distance: constraint a.parallel(to: e)\nconstraint a.distance(to: e.p1) = {}";
    assert_eq!(first(&["a", "e"]), kept);
    assert!(first(&["a", "b"]).starts_with("angle: "), "{}", first(&["a", "b"]));
    assert_eq!(first(&["p", "a"]), "distance: constraint a.distance(to: p) = {}");
    assert_eq!(first(&["a", "c"]), "distance: constraint a.distance(to: c.center) = {}");
    assert_eq!(first(&["c", "d"]), "distance: constraint c.center.distance(to: d.center) = {}");
    // what is said already is said anew, from either
    let stood = Desk::of(&format!(
        "{figure}constraint a.parallel(to: e)\nconstraint a.distance(to: e.p2) = 80\n"
    ));
    let again = |paths: &[&str]| offers(&stood, paths).into_iter().find(|o| o.label == "distance");
    let (one, other) = (again(&["a", "e"]), again(&["e", "a"]));
    let is_it = |offer: Offer| offer.stands && offer.members.contains("a.distance(to: e.p2)");
    assert!(one.is_some_and(is_it) && other.is_some_and(is_it));
    let level = |line: &str| format!("constraint {line}.p1.y = {line}.p2.y\n");
    let levels = Desk::of(&format!("{figure}{}{}", level("a"), level("e")));
    let distance = offers(&levels, &["a", "e"]).into_iter().find(|o| o.label == "distance");
    assert_eq!(distance.expect("offered").members, "constraint a.distance(to: e.p1) = {}");
    let mut desk = Desk::of(&figure);
    take(&mut desk, &["a", "e"], "distance", Some("60"));
    let number = |of: &str| desk.number(of);
    let sine = number("e.p2.y") - number("e.p1.y");
    let cosine = number("e.p2.x") - number("e.p1.x");
    let (dx, dy) = (number("a.p2.x") - number("a.p1.x"), number("a.p2.y") - number("a.p1.y"));
    assert!((dx * sine - dy * cosine).abs() < 1e-6, "{}", desk.text());
    let mut desk = Desk::of(&figure);
    take(&mut desk, &["p", "a"], "distance", Some("30"));
    let all = told(&desk);
    assert_eq!(all, ["constraint1 30 a p"]);
}

#[test]
fn a_number_that_a_dimension_says_is_typed_anew_where_the_value_stands() {
    let text = "use geometry\nunit mm\nc: Circle { center = (0, 0)  radius = 9 }\nconstraint c.radius = 9\n";
    let mut desk = Desk::of(text);
    desk.type_in("c.radius", "16 mm / 2").expect("it is told anew");
    assert_eq!(desk.number("c.radius"), 8.0);
    assert!(desk.text().ends_with("constraint c.radius = 16 mm / 2\n"), "{}", desk.text());
    desk.undo();
    assert_eq!(desk.text(), text);
    // what is switched off says nothing, and is left as it is
    let switched = format!("{text}constraint held: c.radius = 9 mm\n");
    let mut desk = Desk::of(&switched);
    desk.apply(&Command::Enable { path: at("constraint1"), on: false })
        .expect("it is switched off");
    desk.type_in("c.radius", "7").expect("the other one is told anew");
    assert!(desk.text().contains("constraint rule: c.radius = 9\n"), "{}", desk.text());
    assert!(desk.text().contains("constraint held: c.radius = 7\n"), "{}", desk.text());
    // what something else holds besides is refused as ever
    let both = format!("{text}constraint c.radius < 10\n");
    let mut desk = Desk::of(&both);
    let refused = desk.type_in("c.radius", "12").expect_err("it is held below 10");
    assert!(refused.message.contains("would not hold"), "{}", refused.message);
    assert_eq!(desk.text(), both);
}

#[test]
fn an_angle_between_two_lines_is_the_one_at_their_corner() {
    let triangle = "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\n\
        b: Line { p1 = (100, 0)  p2 = (50, 86.6025403784439) }\nmerge a.p2 = b.p1\n";
    let of_angle = |desk: &Desk| {
        let found = offers(desk, &["a", "b"]).into_iter();
        found.filter(|offer| ["angle", "supplement"].contains(&&*offer.label)).collect::<Vec<_>>()
    };
    let mut desk = Desk::of(triangle);
    // from one direction to the other it is 120 deg
    let offered = of_angle(&desk);
    let values: Vec<Option<&str>> = offered.iter().map(|offer| offer.value.as_deref()).collect();
    assert_eq!(values, [Some("60 deg"), Some("120 deg")]);
    take(&mut desk, &["a", "b"], "angle", Some("90 deg"));
    assert!(desk.text().contains("constraint b.angle(to: -a) = 90 deg\n"), "{}", desk.text());
    // the corner at (100, 0) is a right angle now
    let [x, y] = ["b.p2.x", "b.p2.y"].map(|path| desk.number(path));
    assert!((x - 100.0).abs() < 1e-9 && y > 0.0, "({x}, {y})");
    let [note] = &*desk.session.annotations(desk.id) else { panic!("one stands") };
    assert_eq!((&*note.words, note.shows), ("90°", Shows::Angle([false, true])));
    // told anew it is the same constraint, and the other way round as well
    for lines in [["a", "b"], ["b", "a"]] {
        let again: Vec<_> = offers(&desk, &lines).into_iter().filter(|o| o.stands).collect();
        assert_eq!(again.len(), 1, "{again:?}");
        assert_eq!(again[0].value.as_deref(), Some("90 deg"));
    }
    // where both run to their corner, both are turned round
    let mut to = Desk::of(
        &triangle
            .replace(
                "p1 = (100, 0)  p2 = (50, 86.6025403784439)",
                "p1 = (50, 86.6025403784439)  p2 = (100, 0)",
            )
            .replace("b.p1", "b.p2"),
    );
    take(&mut to, &["a", "b"], "angle", Some("90 deg"));
    assert!(to.text().contains("constraint (-b).angle(to: -a) = 90 deg\n"), "{}", to.text());
    assert_eq!(to.session.annotations(to.id)[0].shows, Shows::Angle([true; 2]));
    assert!((to.number("b.p1.x") - 100.0).abs() < 1e-9 && to.number("b.p1.y") > 0.0);
    let more = of_angle(&desk)[0].clone();
    let refused =
        desk.session.said(desk.id, &more, Some("200 deg")).expect_err("no angle is so large");
    assert_eq!(refused.message, "the angle is at most 180 deg: 200 deg is -160 deg");
    // what is no angle is told as such, not as too large
    let command = desk.session.said(desk.id, &more, Some("200 mm"));
    let refused = command.and_then(|command| desk.apply(&command)).expect_err("a length is none");
    assert!(!refused.message.contains("180 deg"), "{}", refused.message);
    // what a text says from direction to direction stands as well
    let mut desk = Desk::of(&format!("{triangle}constraint a.angle(to: b) = 120 deg\n"));
    assert!(of_angle(&desk)[0].stands);
    take(&mut desk, &["b", "a"], "angle", Some("100 deg"));
    assert!(desk.text().ends_with("constraint a.angle(to: b) = 100 deg\n"), "{}", desk.text());
}

#[test]
fn an_angle_that_is_typed_turns_a_line_which_stays_as_long_as_it_was() {
    // 400 long, at 2.5 deg
    let [x, y] = [399.619288632743, 17.447754946134];
    let lines = |more: &str| {
        format!(
            "use geometry\na: Line {{ p1 = (300, 0)  p2 = (0, 0) }}\n\
             b: Line {{ p1 = (0, 0)  p2 = ({x}, {y}) }}\nmerge a.p2 = b.p1\n{more}"
        )
    };
    let length = |desk: &Desk| {
        let of = |end: &str| desk.number(&format!("a.{end}"));
        base::number::hypot(of("p2.x") - of("p1.x"), of("p2.y") - of("p1.y"))
    };
    let stays = |desk: &Desk, path: &str, at: (f64, f64)| {
        let [x, y] = ["x", "y"].map(|part| desk.number(&format!("{path}.{part}")));
        // to the digits that are written of what is computed
        assert!(base::number::hypot(x - at.0, y - at.1) < 1e-8, "{path}: ({x}, {y}), not {at:?}");
    };
    let turned = (-200.0, 200.0 * 3_f64.sqrt());
    let mut desk = Desk::of(&lines(""));
    take(&mut desk, &["a", "b"], "angle", Some("120 deg"));
    assert!(desk.text().contains("constraint (-a).angle(to: b) = 120 deg\n"), "{}", desk.text());
    stays(&desk, "a.p1", (300.0, 0.0));
    stays(&desk, "a.p2", (0.0, 0.0));
    stays(&desk, "b.p2", turned);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    // told anew, and back
    take(&mut desk, &["a", "b"], "angle", Some("2.5 deg"));
    stays(&desk, "b.p2", (x, y));
    assert_eq!(desk.text().matches("angle").count(), 1, "{}", desk.text());
    // one step
    desk.undo();
    stays(&desk, "b.p2", turned);
    // the one that can: the other is held, or goes on
    let mut held = Desk::of(&lines("anchor b.p2\nanchor b.p1\n"));
    take(&mut held, &["a", "b"], "angle", Some("120 deg"));
    stays(&held, "b.p2", (x, y));
    assert!((length(&held) - 300.0).abs() < 1e-8, "{}", held.text());
    let next = format!("c: Line {{ p1 = ({x}, {y})  p2 = (500, 90) }}\nmerge b.p2 = c.p1\n");
    let mut chain = Desk::of(&lines(&next));
    take(&mut chain, &["a", "b"], "angle", Some("120 deg"));
    stays(&chain, "b.p2", (x, y));
    stays(&chain, "c.p2", (500.0, 90.0));
    assert!((length(&chain) - 300.0).abs() < 1e-8, "{}", chain.text());
    // a direction, of a line that hangs by its start
    let mut desk = Desk::of(&lines(""));
    take(&mut desk, &["b"], "direction", Some("90 deg"));
    stays(&desk, "a.p2", (0.0, 0.0));
    stays(&desk, "b.p2", (0.0, 400.0));
    // a corner whose ends are both held has an angle by its lengths alone
    let mut both = Desk::of(&lines("anchor a.p1\nanchor b.p2\n"));
    take(&mut both, &["a", "b"], "angle", Some("120 deg"));
    stays(&both, "b.p2", (x, y));
}

#[test]
fn a_dimension_that_stands_is_shown_and_edited() {
    let dimension = |desk: &Desk, paths: &[&str], label: &str| {
        let found = offers(desk, paths).into_iter().find(|offer| offer.label == label);
        found.unwrap_or_else(|| panic!("{label} of {paths:?} is offered"))
    };
    let mut desk = Desk::of("use geometry\na: Line { p1 = (0, 0)  p2 = (30, 40) }\n");
    assert!(!dimension(&desk, &["a.p1", "a.p2"], "distance").stands);
    take(&mut desk, &["a.p1", "a.p2"], "distance", Some("100"));
    // of the two places, either way round, and of the line between them
    let ways =
        [(&["a.p1", "a.p2"][..], "distance"), (&["a.p2", "a.p1"], "distance"), (&["a"], "length")];
    for (paths, label) in ways {
        let stands = dimension(&desk, paths, label);
        assert!(stands.stands, "{stands:?}");
        let command = desk.session.said(desk.id, &stands, Some("50")).expect("it fits");
        desk.apply(&command).expect("it holds");
        assert_eq!(desk.text().matches("distance").count(), 1, "{}", desk.text());
        assert!(desk.text().contains("a.p1.distance(to: a.p2) = 50"), "{}", desk.text());
        desk.undo();
    }
    take(&mut desk, &["a"], "direction", Some("90 deg"));
    assert!(dimension(&desk, &["a"], "direction").stands);
    // and of a thing that is the distance
    let text = "use geometry\na: Line { p1 = (0, 0)  p2 = (30, 40) }\nd: Distance { from = a.p1  to = a.p2  value = 50 }\n";
    let mut desk = Desk::of(text);
    assert!(dimension(&desk, &["a"], "length").stands);
    take(&mut desk, &["a.p2", "a.p1"], "distance", Some("25"));
    assert_eq!(
        desk.text().lines().last(),
        Some("d: Distance { from = a.p1  to = a.p2  value = 25 }")
    );
    // what is only given, a drag may change: it does not stand, and holds when it is told
    let mut desk = Desk::of(FIGURE);
    assert!(!dimension(&desk, &["c"], "radius").stands);
    take(&mut desk, &["c"], "radius", Some("25"));
    assert!(desk.text().ends_with("constraint c.radius = 25\n"), "{}", desk.text());
}

#[test]
fn a_named_number_stands_on_the_drawing_as_a_written_one_does() {
    let desk = Desk::of(
        "use geometry\nunit mm\nw: Length = 45\nlength: Length = 2 cm\n\
         a: Line { p1 = (0, 0)  p2 = (45, 0) }\nb: Line { p1 = (0, 20)  p2 = (20, 20) }\n\
         r: Rectangle { corner = (0, 40)  width = 60  height = 30 }\n\
         constraint a.length = w\nconstraint length = b.length\nconstraint r.width = 6 cm\n",
    );
    let all = desk.session.annotations(desk.id);
    let seen = all.iter().map(|one| (one.words.as_str(), one.of.join(" "), one.number));
    let of = |words, of: &str, number| (words, String::from(of), Some(number));
    assert_eq!(
        seen.collect::<Vec<_>>(),
        [of("45 mm", "a", 45.0), of("20 mm", "b", 20.0), of("60 mm", "r", 60.0)]
    );
    // beside one that is switched off, the other is typed anew
    let mut twice = Desk::of(
        "use geometry\na: Line { p1 = (0, 0)  p2 = (45, 0) }\n\
         constraint a.length = 20\nconstraint a.length = 45\n",
    );
    let off = Command::Enable { path: at("constraint1"), on: false };
    twice.apply(&off).expect("it is switched off");
    let said = twice.session.annotations(twice.id).pop().and_then(|one| one.typed);
    let said = said.expect("it can be typed anew");
    let command = twice.session.said(twice.id, &said, Some("50")).expect("it fits");
    twice.apply(&command).expect("it can be said");
    assert!(twice.text().contains("constraint a.length = 50\n"), "{}", twice.text());
    assert!(!twice.text().contains("= 45\n"), "{}", twice.text());
    // what another number gives is typed as the text has it, where it stands to the right
    let typed = all.iter().map(|one| one.typed.as_ref().and_then(|typed| typed.value.as_deref()));
    assert_eq!(typed.collect::<Vec<_>>(), [Some("w"), None, Some("6 cm")]);
}
/// Points that nothing joins, so many, each the same step to the right of the one before.
fn row(n: usize) -> String {
    let point = |i: usize| format!("p{i}: Point = ({}, 0)\n", 7 * i);
    std::iter::once(String::from("use geometry\n")).chain((0..n).map(point)).collect()
}

#[test]
fn thousands_are_copied_and_deleted_at_once() {
    let desk = Desk::of(&row(2000));
    let all: Vec<_> = (0..2000).map(|i| at(&format!("p{i}"))).collect();
    let clip = desk.session.copied(desk.id, &all, Relations::Own).expect("they are things");
    let (_, copies) = desk.session.pasting(desk.id, &clip, 1).expect("there is room");
    assert_eq!((copies.len(), copies[1999].as_str()), (2000, "point2000"));
    let (command, along) = desk.session.deletion(desk.id, &all).expect("nothing is in the way");
    assert_eq!((command, along), (Command::Text(String::from("use geometry\n")), Vec::new()));
}

#[test]
fn several_that_are_deleted_at_once_leave_what_they_leave_one_by_one() {
    let text = "use geometry\na: Line { p1 = (0, 0)  p2 = (30, 40) }; b: Line\nc, d: Point = (1, 2)\n\n// kept\ne: Point = (3, 4)\nw => a.length + b.length\nmerge a.p2 = b.p1 = e\nconstraint c.distance(to: e) = 5 and w > 1\nconstraint parallel: a.parallel(to: b)\nanchor e, c\n";
    for names in
        [vec!["a", "b"], vec!["a", "c"], vec!["c", "d"], vec!["b", "c", "d"], vec!["d", "a"]]
    {
        let desk = Desk::of(text);
        let paths: Vec<_> = names.iter().map(|name| at(name)).collect();
        let (command, _) = desk.session.deletion(desk.id, &paths).expect("nothing is in the way");
        let mut apart = Desk::of(text);
        for path in &paths {
            apart.apply(&Command::Delete(path.clone())).expect("nothing is in the way");
        }
        assert_eq!(command, Command::Text(apart.text()), "{names:?}");
    }
}
