//! What an edit may cost: it ends, and says that it was not decided, and where it was given up.

use bench::opened::Opened;
use kernel::Value;
use plan::{EditKind, NotDecided, RefusalReason, Target};
use std::fmt::Write as _;

/// A chain of bars of length one from a pin, each a little aside of the one before.
fn chain(bars: u32) -> String {
    let mut text =
        "use geometry\npin: Pin { x = 0  y = 0 }  merge pin.point = p0\np0: Point = (0, 0)\n"
            .to_owned();
    let mut at = [0.0, 0.0];
    for k in 1..=bars {
        let angle = 0.3 * base::number::sin(f64::from(k * k));
        at = [at[0] + base::number::cos(angle), at[1] + base::number::sin(angle)];
        writeln!(text, "p{k}: Point = ({}, {})", at[0], at[1]).expect("a string");
        let bar = format!("bar{k}: Distance {{ value = 1 }}  merge bar{k}.from = p{}", k - 1);
        writeln!(text, "{bar}  merge bar{k}.to = p{k}").expect("a string");
    }
    text
}

#[test]
fn a_set_that_comes_to_no_end_is_given_up_and_says_where() {
    let bars = 120;
    let opened = Opened::new(&chain(bars)).expect("a chain can be said");
    let (mut planner, mut values, report) = opened.solve();
    assert!(report.unmet.is_empty() && report.not_decided.is_none(), "it opens as it stands");
    let thing = opened.thing(&format!("p{bars}")).expect("it has an end");
    let host = &mut opened.host();
    let mut set = |to: [f64; 2]| {
        let targets = [(Target::Thing(thing), to.map(Value::Number).to_vec())];
        planner.edit(opened.model(), &mut values, EditKind::Set, &targets, host)
    };
    // farther than all bars reach: least change is measured anew over and over where they come to lie straight
    let far = set([1.1 * f64::from(bars), 0.0]);
    let Some(RefusalReason::NotDecided(NotDecided::Work(bound))) = far.refusal else {
        panic!("{far:?}")
    };
    let slots = 2 * u64::from(bars);
    // one part of the way alone comes to no end
    assert!(bound > 300_000_000 + 100_000 * slots, "it grows with what is solved: {bound}");
    assert!(bound < 400_000_000, "{bound}");
    // what was given up once is no hindrance to what comes next
    let near = set([0.5 * f64::from(bars), 3.0]);
    assert_eq!((near.refusal, near.not_decided), (None, None));
}

/// A grid of 300 by 300 nodes, with its resistors, is a document like any other.
#[test]
fn a_grid_of_300_by_300_nodes_is_no_document_of_too_many_things() {
    let things = |k: usize| {
        let opened = Opened::new(&bench::documents::resistor_grid(k)).expect("nothing is wrong");
        opened.model().structure.things.len()
    };
    // nodes by k², resistors by k² - k: three grids tell how many there are of any
    let [ten, twenty, thirty] = [10, 20, 30].map(things).map(|n| n as i64);
    let square = (thirty - 2 * twenty + ten) / 200;
    let side = (twenty - ten) / 10 - 30 * square;
    let rest = ten - 100 * square - 10 * side;
    let all = 90_000 * square + 300 * side + rest;
    assert!(all < kernel::MOST_THINGS as i64, "{all}: {square} {side} {rest}");
}
