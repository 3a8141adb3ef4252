//! Where is drawn what says no place.

use crate::desk::{Desk, at};
use base::number::hypot;
use kernel::{Command, Path};

/// Two resistors on a battery, and a voltmeter over the second, joined and nowhere placed.
const DIVIDER: &str = "use circuits\ny down\nbattery: Battery\nmeter: Ammeter\nr1: Resistor\nr2: Resistor\n\
    bottom: Wire\ntop: Wire\nvoltmeter: Voltmeter\nback: Wire\nground: Ground\n\
    merge battery.a.node = meter.a.node\nmerge meter.b.node = r1.a.node\n\
    merge r1.b.node = r2.a.node = top.a.node\nmerge top.b.node = voltmeter.a.node\n\
    merge voltmeter.b.node = back.a.node\nmerge r2.b.node = bottom.b.node = back.b.node\n\
    merge battery.b.node = bottom.a.node = ground.lead.node\n";

/// Where the two ends of a part are.
fn ends(desk: &mut Desk, part: &str) -> [(f64, f64); 2] {
    ["a", "b"].map(|end| desk.place(&format!("{part}.{end}.node.at")))
}

/// Twice the area of a triangle, negative where it turns the other way.
fn side(a: (f64, f64), b: (f64, f64), c: (f64, f64)) -> f64 {
    (b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)
}

fn cross([a, b]: [(f64, f64); 2], [c, d]: [(f64, f64); 2]) -> bool {
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

fn crossings(desk: &mut Desk, parts: &[&str]) -> usize {
    let lines: Vec<_> = parts.iter().map(|part| ends(desk, part)).collect();
    let pairs = (0..lines.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
    pairs.filter(|&(a, b)| cross(lines[a], lines[b])).count()
}

#[test]
fn a_typed_divider_stands_in_rows_and_columns() {
    let mut desk = Desk::of(DIVIDER);
    let parts = ["battery", "meter", "r1", "r2", "bottom", "top", "voltmeter", "back"];
    for part in parts {
        let [a, b] = ends(&mut desk, part);
        assert!((a.0 == b.0) != (a.1 == b.1), "{part} from {a:?} to {b:?}");
    }
    assert_eq!(crossings(&mut desk, &parts), 0);
    // the battery stands to the left, its positive pole above
    let [plus, minus] = ends(&mut desk, "battery");
    assert!(plus.0 == minus.0 && plus.1 < minus.1);
    assert!(parts.iter().all(|part| ends(&mut desk, part).iter().all(|end| end.0 >= plus.0)));
}

#[test]
fn where_the_sheet_has_its_y_upward_the_divider_stands_the_same_way_up() {
    let mut desk = Desk::of(&DIVIDER.replace("y down\n", ""));
    let [plus, minus] = ends(&mut desk, "battery");
    assert!(plus.0 == minus.0 && plus.1 > minus.1);
}

#[test]
fn no_wires_of_a_typed_bridge_cross() {
    let mut desk = Desk::of(
        "use circuits\nbattery: Battery\nr1, r2, r3, r4: Resistor\nmeter: Ammeter\n\
         merge battery.a.node = r1.a.node = r3.a.node\nmerge r1.b.node = r2.a.node = meter.a.node\n\
         merge r3.b.node = r4.a.node = meter.b.node\nmerge battery.b.node = r2.b.node = r4.b.node\n",
    );
    let parts = ["battery", "r1", "r2", "r3", "r4", "meter"];
    assert_eq!(crossings(&mut desk, &parts), 0);
    let places: std::collections::BTreeSet<String> =
        parts.iter().flat_map(|part| ends(&mut desk, part)).map(|at| format!("{at:?}")).collect();
    assert_eq!(places.len(), 4);
}

#[test]
fn parts_across_the_same_two_nodes_stand_side_by_side() {
    let mut desk = Desk::of(
        "use circuits\ny down\nbattery: Battery\nr1, r2, r3: Resistor\nwire: Wire\n\
         merge battery.a.node = r1.a.node = r2.b.node = r3.a.node = wire.a.node\n\
         merge battery.b.node = r1.b.node = r2.a.node = r3.b.node\n",
    );
    let middles = ["battery", "r1", "r2", "r3"].map(|part| {
        let [a, b] = ends(&mut desk, part);
        let lane = desk.number(&format!("{part}.lane"));
        // square to the way from lead to lead
        let long = hypot(b.0 - a.0, b.1 - a.1);
        (
            (a.0 + b.0) / 2.0 - lane * (b.1 - a.1) / long,
            (a.1 + b.1) / 2.0 + lane * (b.0 - a.0) / long,
        )
    });
    for (n, one) in middles.iter().enumerate() {
        for other in &middles[..n] {
            let apart = hypot(one.0 - other.0, one.1 - other.1);
            assert!(apart > 40.0, "{middles:?}");
        }
    }
    // the first goes straight on, and so does what shares one node alone
    assert_eq!([desk.number("battery.lane"), desk.number("wire.lane")], [0.0, 0.0]);
}

#[test]
fn a_part_that_is_joined_by_hand_across_the_nodes_of_another_stands_beside_it() {
    let mut desk = Desk::of("use circuits\ny down\nr1: Resistor\nr2: Resistor\n");
    for end in ["a", "b"] {
        let both = ["r1", "r2"].map(|part| at(&format!("{part}.{end}.node")));
        desk.apply(&Command::Merge(both.to_vec())).expect("alike");
    }
    assert_eq!(
        ["r1.lane", "r2.lane"].map(|lane| desk.number(lane)),
        [0.0, 48.0],
        "{}",
        desk.text()
    );
    assert!(!desk.text().contains("lane"), "{}", desk.text());
    // nobody asked for it: it is no row of the structure
    let rows = desk.session.structure(desk.id);
    assert!(rows.iter().any(|row| row.path == "r2.resistance"));
    assert!(rows.iter().all(|row| row.name != "lane"));
    desk.apply(&Command::Unmerge(at("r2.b.node"))).expect("it is merged");
    assert_eq!(desk.number("r2.lane"), 0.0, "{}", desk.text());
}

#[test]
fn a_part_beside_another_stands_where_less_hangs_together_with_both() {
    let mut desk = Desk::of(
        "use circuits\ny down\nbattery: Battery\nr1, r2, load: Resistor\n\
         merge battery.a.node = r1.a.node\nmerge r1.b.node = r2.a.node = load.a.node\n\
         merge battery.b.node = r2.b.node = load.b.node\n",
    );
    let [a, b] = ends(&mut desk, "load");
    let [one, other] = ends(&mut desk, "r1");
    let third = if one == a || one == b { other } else { one };
    let lane = desk.number("load.lane");
    assert_eq!(lane.abs(), 48.0);
    let beside = (b.0 - a.0) * (third.1 - a.1) - (b.1 - a.1) * (third.0 - a.0);
    assert!(beside * lane < 0.0, "{a:?} {b:?} {third:?} {lane}");
}

/// A net of resistors, so many nodes wide and high, nowhere placed.
fn net_of_resistors(wide: usize, high: usize) -> (String, Vec<String>) {
    let mut text = String::from("use circuits\ny down\n");
    let mut parts = Vec::new();
    let mut ends = vec![Vec::new(); wide * high];
    for node in 0..wide * high {
        let right = (node % wide + 1 < wide).then_some(node + 1);
        let below = (node / wide + 1 < high).then_some(node + wide);
        for to in [right, below].into_iter().flatten() {
            let name = format!("r{node}to{to}");
            text.push_str(&format!("{name}: Resistor\n"));
            ends[node].push(format!("{name}.a.node"));
            ends[to].push(format!("{name}.b.node"));
            parts.push(name);
        }
    }
    for node in ends.iter().filter(|node| node.len() > 1) {
        text.push_str(&format!("merge {}\n", node.join(" = ")));
    }
    (text, parts)
}

#[test]
fn more_parts_that_hang_together_than_are_compared_stand_in_rows_too() {
    for (wide, high) in [(7, 6), (40, 1), (20, 2)] {
        let (text, parts) = net_of_resistors(wide, high);
        let mut desk = Desk::of(&text);
        for part in &parts {
            let [a, b] = ends(&mut desk, part);
            assert!((a.0 == b.0) != (a.1 == b.1), "{wide} by {high}: {part} from {a:?} to {b:?}");
        }
        let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
        assert_eq!(crossings(&mut desk, &parts), 0, "{wide} by {high}");
    }
}

#[test]
fn what_hangs_together_with_a_place_that_is_given_is_laid_out_from_there() {
    let mut desk = Desk::of(
        "use circuits\ny down\nr: Resistor { a.node.at = (1000, 1000) }\nw: Wire\n\
         merge r.b.node = w.a.node\n",
    );
    let [_, b] = ends(&mut desk, "r");
    let [_, end] = ends(&mut desk, "w");
    // the first stands, what follows goes on
    assert_eq!((b, end), ((1000.0, 1120.0), (1120.0, 1120.0)));
}

#[test]
fn a_part_that_is_added_by_hand_moves_none_that_says_no_place() {
    let mut desk = Desk::of(DIVIDER);
    let parts = ["battery", "meter", "r1", "r2", "bottom", "top", "voltmeter", "back"];
    let before = parts.map(|part| ends(&mut desk, part));
    let members = "r3: Resistor { a.node.at = (500, 500)  b.node.at = (600, 500) }".into();
    desk.apply(&Command::Edit { target: Path::default(), members }).expect("there is such a class");
    assert_eq!(parts.map(|part| ends(&mut desk, part)), before);
    desk.apply(&Command::Merge(vec![at("voltmeter.b.node"), at("r3.a.node")])).expect("alike");
    assert_eq!(parts.map(|part| ends(&mut desk, part)), before);
}
