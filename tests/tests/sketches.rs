//! Sketches: every case below `tests/cases/geometry` is solved from its start, and dragged.
//!
//! What came out is tested by the cases' own arithmetic (`bench::residual`): every constraint to 1e-8,
//! every point where it is meant to be if the sketch is well constrained, no step of a drag failed,
//! and no point further in one step than the best of other solvers take it. Generated cases of every
//! family are tested alike; `THINGLAB_LONG` takes larger ones, and ten seeds of each.

use bench::case::{Case, Constraint};
use bench::families::{Family, generate};
use bench::measure::{Figures, Repeat, measure_case};
use std::fs;
use std::path::Path;

/// The largest move of a point in one step of a drag, in the sketch's unit: what the smoothest of
/// SolveSpace, planegcs and ezpz needs, and a tenth more; in the long chain a fifth, because they change
/// least from step to step, which depends on the steps, and we from the press.
const MOVES: [(&str, f64); 5] = [
    ("linkage-4", 0.112),
    ("linkage-10", 0.098),
    ("linkage-50", 0.130),
    ("linkdrag-4", 0.255),
    ("linkdrag-10", 0.155),
];

/// The same for any other: the worst of those, and a tenth more. The crank's own tip moves by 0.087.
const SMOOTH: f64 = 0.28;

/// Rigid frameworks with several solutions: any of them will do.
const SEVERAL_SOLUTIONS: &str = "henneberg2";

fn cases() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/geometry");
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("the folder is there") {
        let path = entry.expect("its entries can be read").path();
        let name = path.file_stem().expect("a case has a name").to_string_lossy().into_owned();
        found.push((name, fs::read_to_string(&path).expect("a case can be read")));
    }
    found.sort();
    found
}

fn shortfalls(name: &str, case: &Case) -> Vec<String> {
    let figures = match measure_case(case, Repeat::Once) {
        Ok(figures) => figures,
        Err(why) => return vec![why],
    };
    let mut found = Vec::new();
    if !figures.is_solved() {
        found.push(format!("solve: a constraint is {:e} off", figures.residual));
    }
    if case.well_constrained && !name.starts_with(SEVERAL_SOLUTIONS) {
        let away = furthest(&figures.points, &case.truth);
        if away.is_nan() || away > 1e-6 {
            found.push(format!("solve: a point is {away} away from where it is meant to be"));
        }
    }
    found.extend(drag_shortfalls(name, &figures));
    found
}

fn drag_shortfalls(name: &str, figures: &Figures) -> Vec<String> {
    let Some(drag) = &figures.drag else { return Vec::new() };
    let mut found = Vec::new();
    if drag.failed > 0 {
        found.push(format!("drag: {} of {} steps failed", drag.failed, drag.steps.len()));
    }
    let bound = MOVES.iter().find(|(of, _)| *of == name).map_or(SMOOTH, |found| found.1);
    let largest = drag.largest_move();
    if largest > bound {
        found.push(format!("drag: a point moves by {largest} in one step, not {bound}"));
    }
    found
}

fn furthest(points: &[[f64; 2]], from: &[[f64; 2]]) -> f64 {
    assert_eq!(points.len(), from.len(), "every point has a place");
    let away = |(p, q): (&[f64; 2], &[f64; 2])| (p[0] - q[0]).abs().max((p[1] - q[1]).abs());
    points.iter().zip(from).map(away).fold(0.0, f64::max)
}

#[test]
fn every_sketch_is_solved_and_dragged_without_a_jump() {
    let mut failures = String::new();
    for (name, text) in cases() {
        let case = Case::read(&text).expect("a case is one");
        for shortfall in shortfalls(&name, &case) {
            failures += &format!("{name}: {shortfall}\n");
        }
    }
    assert!(failures.is_empty(), "\n{failures}");
}

/// Families, a size that is tried at once, and sizes that are tried where there is time.
const FAMILIES: [(Family, usize, &[usize]); 10] = [
    (Family::Rects, 20, &[100, 300, 1000]),
    (Family::Rectsc, 20, &[100, 300]),
    (Family::Indep, 20, &[100, 300]),
    (Family::Arcs, 20, &[100, 300]),
    (Family::Truss, 30, &[100, 300, 1000]),
    (Family::Henneberg2, 60, &[10, 30, 50, 100, 300]),
    (Family::Grid, 8, &[5, 10, 20, 30]),
    (Family::Gridr, 6, &[5, 10, 20]),
    (Family::Linkage, 20, &[4, 10, 50, 100, 200]),
    (Family::Linkdrag, 20, &[4, 10, 50, 100, 200]),
];

#[test]
fn sketches_of_every_family_are_solved_whatever_their_seed() {
    let is_long = std::env::var_os("THINGLAB_LONG").is_some();
    let mut failures = String::new();
    for (family, size, sizes) in FAMILIES {
        let (sizes, seeds) = if is_long { (sizes, 1..=10) } else { (&[size][..], 1..=3) };
        for &size in sizes {
            for seed in seeds.clone() {
                let case = generate(family, size, seed);
                let name = format!("{} of seed {seed}", case.name);
                for shortfall in shortfalls(&name, &case) {
                    failures += &format!("{name}: {shortfall}\n");
                }
            }
        }
    }
    assert!(failures.is_empty(), "\n{failures}");
}

/// Frameworks whose triangles, solved one after the other, magnify how rough the start is until two
/// circles do not meet; damped Newton steps of everything at once end a third of a bar from the start.
const ROUGH: [(usize, u64); 3] = [(200, 12), (300, 1), (300, 4)];

#[test]
fn a_large_framework_is_found_near_its_rough_start() {
    for (size, seed) in ROUGH {
        let case = generate(Family::Henneberg2, size, seed);
        let figures = measure_case(&case, Repeat::Once).expect("a case is one");
        assert!(figures.is_solved(), "{size} of seed {seed}: {}", figures.residual);
        let away = furthest(&figures.points, &case.start);
        assert!(away < 0.5, "{size} of seed {seed}: a point is {away} away from its start");
    }
}

/// A framework of triangles with one bar given two lengths: those two stand against each other, whatever else
/// is pulled off its place by them.
#[test]
fn two_lengths_of_one_bar_are_all_that_conflicts_in_a_framework() {
    let mut case = generate(Family::Truss, 300, 1);
    let is_bar = |c: &&Constraint| matches!(c, Constraint::Distance { .. });
    let Some(&Constraint::Distance { p, q, v }) = case.constraints.iter().filter(is_bar).nth(7)
    else {
        panic!("a framework has bars")
    };
    case.constraints.push(Constraint::Distance { p, q, v: v + 1.0 });
    case.well_constrained = false;
    let figures = measure_case(&case, Repeat::Once).expect("a case is one");
    assert!(!figures.is_solved(), "two lengths of one bar hold together");
    assert_eq!(figures.conflicting, 2);
}
