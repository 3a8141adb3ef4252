//! What is offered for a selection, and that taking it does what it says.

use crate::desk::{Desk, at};
use session::view::Offer;

const FIGURE: &str = "\
use geometry
a: Line { p1 = (0, 0)  p2 = (100, 10) }
b: Line { p1 = (0, 50)  p2 = (90, 80) }
p: Point = (40, 120)
c: Circle { center = (200, 50)  radius = 20 }
d: Circle { center = (300, 50)  radius = 30 }
";

fn offers(desk: &Desk, paths: &[&str]) -> Vec<Offer> {
    let paths: Vec<_> = paths.iter().map(|path| at(path)).collect();
    desk.session.offers(desk.id, &paths)
}

fn labels(desk: &Desk, paths: &[&str]) -> Vec<String> {
    offers(desk, paths).into_iter().map(|offer| offer.label).collect()
}

fn take(desk: &mut Desk, paths: &[&str], label: &str, value: Option<&str>) {
    let all = offers(desk, paths);
    let offer = all.iter().find(|offer| offer.label == label).expect("it is offered");
    let command = offer.command(value);
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
    has(&["a", "b"], &["parallel", "perpendicular", "equal length", "angle"]);
    has(&["p", "a"], &["midpoint", "on"]);
    has(&["p", "c"], &["on"]);
    has(&["a.p2", "b.p1"], &["merge", "horizontal", "vertical", "distance"]);
    has(&["c", "d"], &["equal radius", "concentric"]);
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
    // it is a thing of its own, whose value can be typed
    desk.type_in("distance.value", "20").expect("it can be set");
}

#[test]
fn an_offer_is_foreseen_and_nothing_changes() {
    let desk = Desk::of(FIGURE);
    let before = desk.moment();
    let all = offers(&desk, &["a"]);
    let level = all.iter().find(|offer| offer.label == "horizontal").expect("it is offered");
    let seen = desk.session.foreseen(desk.id, &level.command(None)).expect("it can be said");
    assert!(!seen.elements.is_empty());
    assert_eq!(desk.moment(), before);
}
