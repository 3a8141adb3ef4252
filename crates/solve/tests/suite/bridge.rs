//! A bridge of springs under load: fourteen unknowns in one block, from a rough start.

use crate::builder::{Sheet, close};

const NODES: [(f64, f64); 9] = [
    (20.0, 94.0),
    (66.0, 32.0),
    (98.0, 108.0),
    (143.0, 45.0),
    (180.0, 118.0),
    (217.0, 45.0),
    (262.0, 108.0),
    (294.0, 32.0),
    (340.0, 94.0),
];
const BEAMS: [(usize, usize); 15] = [
    (1, 0),
    (1, 2),
    (0, 2),
    (1, 3),
    (3, 2),
    (3, 4),
    (2, 4),
    (3, 5),
    (5, 4),
    (5, 6),
    (4, 6),
    (5, 7),
    (7, 6),
    (7, 8),
    (6, 8),
];

/// Forces at every free node sum to zero; y points down and so does the load.
fn bridge(load: f64) -> (Sheet, Vec<[u32; 2]>, u32) {
    let mut s = Sheet::default();
    let places: Vec<[u32; 2]> = NODES
        .iter()
        .enumerate()
        .map(|(i, &(x, y))| if i % 8 == 0 { s.anchor(x, y) } else { [s.free(x), s.free(y)] })
        .collect();
    let load = s.slot(solve::Stay::Given(solve::Giver::Document), 1, load);
    for node in 1..8 {
        let mut sides = Vec::new();
        for axis in 0..2 {
            let mut sum = if (node, axis) == (4, 1) { s.v(load) } else { s.c(0.0) };
            for (a, b) in BEAMS {
                let other = if a == node {
                    b
                } else if b == node {
                    a
                } else {
                    continue;
                };
                let length = s.distance(places[node], places[other]);
                let rest = s.c(80.0);
                let force = s.sub(length, rest);
                let (here, there) = (s.v(places[node][axis]), s.v(places[other][axis]));
                let along = s.sub(there, here);
                let unit = s.div(along, length);
                let part = s.mul(force, unit);
                sum = s.add(sum, part);
            }
            let zero = s.c(0.0);
            sides.push((sum, zero));
        }
        s.relate(solve::Level::Required, &sides);
    }
    (s, places, load)
}

#[test]
fn the_bridge_finds_its_equilibria() {
    for (load, expected) in [
        (0.0, Some(94.0)),
        (2.0, Some(104.801_263)),
        (5.0, Some(124.512_604)),
        (10.0, None),
        (20.0, None),
    ] {
        let (mut s, p, _) = bridge(load);
        s.open();
        let y = s.x0[p[4][1] as usize];
        if let Some(expected) = expected {
            close(y, expected, 1e-6);
        }
        for k in 0..4 {
            let (a, b) = (p[k], p[8 - k]);
            close(s.x0[a[0] as usize] + s.x0[b[0] as usize], 360.0, 1e-6);
            close(s.x0[a[1] as usize], s.x0[b[1] as usize], 1e-6);
        }
    }
}

#[test]
fn the_load_is_dragged_along_one_branch() {
    let (mut s, p, load) = bridge(2.0);
    s.open();
    let mut last = 0.0;
    for target in [2.0, 3.0, 5.0, 10.0, 20.0] {
        let (values, outcome, _) = s.set(&[(load, target)]);
        assert!(outcome.is_solved(), "{target}: {outcome:?}");
        let y = values[p[4][1] as usize];
        assert!(y > last, "deflection grows with the load");
        last = y;
    }
    let (values, _, _) = s.set(&[(load, 5.0)]);
    close(values[p[4][1] as usize], 124.512_604, 1e-6);
}

#[test]
fn without_forces_the_length_changes_are_spread() {
    let mut s = Sheet::default();
    let places: Vec<[u32; 2]> = NODES
        .iter()
        .enumerate()
        .map(|(i, &(x, y))| if i % 8 == 0 { s.anchor(x, y) } else { s.place(x, y) })
        .collect();
    for (a, b) in BEAMS {
        let (length, rest) = (s.distance(places[a], places[b]), s.c(80.0));
        s.relate(solve::Level::Weak, &[(length, rest)]);
    }
    let plan = s.plan();
    let (values, outcome) = s.run(&plan, &[], &mut solve::NoHost);
    assert!(outcome.is_solved());
    let at = |i: usize| (values[places[i][0] as usize], values[places[i][1] as usize]);
    // the pulls of length - 80 at every free node sum to zero: the sum of squares is least
    for node in 1..8 {
        let mut pull = (0.0, 0.0);
        for (a, b) in BEAMS {
            if a == node || b == node {
                let (p, q) = (at(node), at(a + b - node));
                let (dx, dy) = (q.0 - p.0, q.1 - p.1);
                let length = base::number::sqrt(dx * dx + dy * dy);
                pull.0 += (length - 80.0) * dx / length;
                pull.1 += (length - 80.0) * dy / length;
            }
        }
        close(pull.0, 0.0, 1e-7);
        close(pull.1, 0.0, 1e-7);
    }
}
