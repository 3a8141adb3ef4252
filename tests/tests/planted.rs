//! Sketches that hold, with one contradiction planted: a point is put where the others do not let it be.
//! The planted one is among what is named, and nearly always it is decided that this cannot hold together.
//! `THINGLAB_LONG` makes them many.

use bench::case::Constraint;
use bench::document;
use bench::families::{FAMILIES, Family, generate};
use bench::opened::Opened;
use plan::{Certainty, Source};

/// What one planted contradiction came to.
#[derive(Default)]
struct Told {
    planted: usize,
    decided: usize,
    wrong: Vec<String>,
}

/// Plants a contradiction and reads what is told of it.
fn plant(family: Family, name: &str, size: usize, seed: u64, told: &mut Told) {
    let mut case = generate(family, size, seed);
    case.start = case.truth.clone();
    let point = seed as usize * 7 % case.truth.len();
    let [x, y] = case.truth[point];
    case.constraints.push(Constraint::Fix { p: point, x: x + 3.0, y: y - 2.0 });
    case.constraints.push(Constraint::Fix { p: point, x, y });
    let text = document::text(&case);
    let opened = Opened::new(&text).expect("the document can be opened");
    let (mut planner, values, report) = opened.solve();
    let what = format!("{name}-{size} seed {seed} point {point}");
    told.planted += 1;
    if report.unmet.is_empty() {
        told.wrong.push(format!("{what}: nothing is said to be wrong"));
        return;
    }
    let found = planner.contradictions(opened.model(), &values, &report.unmet, &mut opened.host());
    let Some(first) = found.first() else {
        told.wrong.push(format!("{what}: no contradiction is named"));
        return;
    };
    let model = opened.model();
    let owner = |s: &Source| match s {
        Source::Constraint(c) => {
            let owner = model.structure.constraints[*c as usize].owner;
            model.structure.path(model.document, owner).to_string()
        }
        Source::Stay(_) | Source::Wish(_) => String::new(),
    };
    let named: Vec<String> = first.constraints.iter().map(owner).collect();
    let pins = [1, 2].map(|back| format!("c{}", case.constraints.len() - back));
    if !named.iter().any(|n| pins.contains(n)) {
        told.wrong.push(format!("{what}: {} are not among {named:?}", pins.join(" and ")));
    }
    match first.certainty {
        Certainty::Contradiction | Certainty::NoSolution { .. } => told.decided += 1,
        Certainty::NotDecided { .. } | Certainty::GivenUp(_) => {}
    }
}

#[test]
fn a_planted_contradiction_is_named() {
    let seeds = if std::env::var_os("THINGLAB_LONG").is_some() { 40 } else { 2 };
    let mut told = Told::default();
    for (name, family) in FAMILIES {
        for seed in 0..seeds {
            plant(family, name, 4 + seed as usize % 5, seed, &mut told);
        }
    }
    assert!(
        told.wrong.is_empty(),
        "{} of {}\n{}",
        told.wrong.len(),
        told.planted,
        told.wrong.join("\n")
    );
    // of 100, five may end undecided
    assert!(20 * told.decided >= 19 * told.planted, "{} of {}", told.decided, told.planted);
}
