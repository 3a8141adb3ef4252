//! Regions against what they are made of: boxes, discs and slots, whose places are told without edges.

use base::Dice;
use base::number::{atan, cos, hypot, sin};
use geometry::{Bend, Combination, Ring, Surface, combine, offset};
use std::f64::consts::PI;

// what only the room itself knows stands beside its tests, and is compiled with them here
#[expect(dead_code, reason = "the room asks more of it")]
#[path = "../src/region/edge.rs"]
mod edge;

/// How many regions are looked at in each way.
const CASES: usize = 80;

/// A number on a grid, so that shapes touch and share edges, or anywhere.
fn number(dice: &mut Dice, on_grid: bool, least: f64, most: f64) -> f64 {
    let x = dice.between(least, most);
    if on_grid { x.round() } else { x }
}

#[derive(Clone, Copy, Debug)]
enum Shape {
    Box {
        at: [f64; 2],
        size: [f64; 2],
    },
    Disc {
        at: [f64; 2],
        radius: f64,
    },
    /// A box with half discs at its left and right.
    Slot {
        at: [f64; 2],
        length: f64,
        radius: f64,
    },
}

impl Shape {
    fn any(dice: &mut Dice, on_grid: bool) -> Self {
        let at = [number(dice, on_grid, -6.0, 6.0), number(dice, on_grid, -6.0, 6.0)];
        let mut size = |most| number(dice, on_grid, 0.6, most).max(if on_grid { 1.0 } else { 0.0 });
        let (a, b) = (size(6.0), size(4.0));
        match dice.below(3) {
            0 => Self::Box { at, size: [a, b] },
            1 => Self::Disc { at, radius: b },
            _ => Self::Slot { at, length: a, radius: b },
        }
    }
    fn ring(self, is_turned: bool) -> Ring {
        let bend = |x: f64, y: f64, bulge| Bend { at: [x, y], bulge };
        let mut ring = match self {
            Self::Box { at: [x, y], size: [w, h] } => vec![
                bend(x, y, 0.0),
                bend(x + w, y, 0.0),
                bend(x + w, y + h, 0.0),
                bend(x, y + h, 0.0),
            ],
            Self::Disc { at: [x, y], radius: r } => {
                vec![bend(x + r, y, 1.0), bend(x - r, y, 1.0)]
            }
            Self::Slot { at: [x, y], length: l, radius: r } => vec![
                bend(x, y - r, 0.0),
                bend(x + l, y - r, 1.0),
                bend(x + l, y + r, 0.0),
                bend(x, y + r, 1.0),
            ],
        };
        if is_turned {
            // the same ring, run through the other way
            let n = ring.len();
            let turned =
                |i: usize| Bend { at: ring[(n - i) % n].at, bulge: -ring[n - 1 - i].bulge };
            ring = (0..n).map(turned).collect();
        }
        ring
    }
    /// How far a place is inside; negative outside.
    fn depth(self, [px, py]: [f64; 2]) -> f64 {
        match self {
            Self::Box { at: [x, y], size: [w, h] } => {
                (px - x).min(x + w - px).min(py - y).min(y + h - py)
            }
            Self::Disc { at: [x, y], radius } => radius - hypot(px - x, py - y),
            Self::Slot { at: [x, y], length, radius } => {
                radius - hypot(px - px.clamp(x, x + length), py - y)
            }
        }
    }
    fn area(self) -> f64 {
        match self {
            Self::Box { size: [w, h], .. } => w * h,
            Self::Disc { radius, .. } => PI * radius * radius,
            Self::Slot { length, radius, .. } => 2.0 * length * radius + PI * radius * radius,
        }
    }
}

/// Whether a place is in surfaces: rings are crossed by a ray upwards, arcs as many chords.
fn is_in(surfaces: &[Surface], p: [f64; 2]) -> bool {
    let rings = surfaces.iter().flat_map(|s| [&s.outer].into_iter().chain(&s.holes));
    let crossed = rings.map(|ring| crossings(ring, p)).sum::<usize>();
    crossed % 2 == 1
}

fn crossings(ring: &Ring, [px, py]: [f64; 2]) -> usize {
    let mut n = 0;
    for (i, b) in ring.iter().enumerate() {
        let c = ring[(i + 1) % ring.len()].at;
        let mut from = b.at;
        let chords = if b.bulge == 0.0 { 1 } else { 200 };
        for k in 1..=chords {
            let to = if k == chords {
                c
            } else {
                on_arc(b.at, c, b.bulge, f64::from(k) / f64::from(chords))
            };
            if (from[0] <= px) != (to[0] <= px) {
                let y = from[1] + (to[1] - from[1]) * (px - from[0]) / (to[0] - from[0]);
                n += usize::from(y > py);
            }
            from = to;
        }
    }
    n
}

fn on_arc(a: [f64; 2], b: [f64; 2], bulge: f64, part: f64) -> [f64; 2] {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let aside = (1.0 - bulge * bulge) / (4.0 * bulge);
    let c = [0.5 * (a[0] + b[0]) - aside * dy, 0.5 * (a[1] + b[1]) + aside * dx];
    let angle = 4.0 * atan(bulge) * part;
    let (x, y) = (a[0] - c[0], a[1] - c[1]);
    [c[0] + x * cos(angle) - y * sin(angle), c[1] + x * sin(angle) + y * cos(angle)]
}

fn region(ring: Ring) -> Vec<Surface> {
    vec![Surface { outer: ring, holes: Vec::new() }]
}
fn area(of: &[Surface]) -> f64 {
    of.iter().map(Surface::area).sum()
}

/// Places that no boundary comes near to.
fn places(dice: &mut Dice, shapes: &[Shape], room: f64) -> Vec<[f64; 2]> {
    let any = (0..60).map(|_| [number(dice, false, -9.0, 16.0), number(dice, false, -9.0, 12.0)]);
    let is_clear = |p: &[f64; 2]| shapes.iter().all(|s| s.depth(*p).abs() > room);
    any.collect::<Vec<_>>().into_iter().filter(is_clear).collect()
}

fn combined(on_grid: bool, seed: u64) -> usize {
    let (mut dice, mut undecided) = (Dice::new(seed), 0);
    for case in 0..CASES {
        let (a, b, c) = (
            Shape::any(&mut dice, on_grid),
            Shape::any(&mut dice, on_grid),
            Shape::any(&mut dice, on_grid),
        );
        let [ra, rb, rc] = [a, b, c].map(|shape| region(shape.ring(dice.below(2) == 0)));
        let all = || -> Result<_, geometry::NoRegion> {
            let union = combine(Combination::Union, &ra, &rb)?;
            let both = combine(Combination::Intersection, &ra, &rb)?;
            let less = combine(Combination::Difference, &union, &rc)?;
            Ok((union, both, less))
        };
        let Ok((union, both, less)) = all() else {
            undecided += 1;
            continue;
        };
        let sum = a.area() + b.area();
        assert!((area(&union) + area(&both) - sum).abs() < 1e-9 * sum, "{case}: {a:?} {b:?}");
        for p in places(&mut dice, &[a, b, c], 1e-3) {
            let [a, b, c] = [a, b, c].map(|s| s.depth(p) > 0.0);
            assert_eq!(is_in(&union, p), a || b, "{case}: union at {p:?}");
            assert_eq!(is_in(&both, p), a && b, "{case}: both at {p:?}");
            assert_eq!(is_in(&less, p), (a || b) && !c, "{case}: less at {p:?}");
        }
    }
    undecided
}

#[test]
fn regions_anywhere_combine() {
    assert_eq!(combined(false, 1), 0);
}
#[test]
fn regions_that_touch_and_share_edges_combine() {
    assert_eq!(combined(true, 2), 0);
}
#[test]
fn what_is_offset_is_so_far_away() {
    let (mut dice, mut found) = (Dice::new(3), 0);
    for case in 0..CASES {
        let on_grid = case % 2 == 0;
        let shapes = [0; 3].map(|_| Shape::any(&mut dice, on_grid));
        let [a, b, c] = shapes.map(|s| region(s.ring(false)));
        let by = number(&mut dice, false, -1.5, 1.5);
        let by = if on_grid { (2.0 * by).round() / 2.0 } else { by };
        let of = combine(Combination::Union, &a, &b);
        let of = of.and_then(|of| combine(Combination::Difference, &of, &c));
        let of = of.unwrap_or_else(|why| panic!("{case}: {why:?}"));
        let moved = offset(&of, by).unwrap_or_else(|why| panic!("{case}: {why:?} {shapes:?} {by}"));
        found += usize::from(!moved.is_empty());
        // a box grows by its sides and by quarter discs at its corners
        if let (Shape::Box { size: [w, h], .. }, true) = (shapes[0], by > 0.0) {
            let grown = offset(&a, by).unwrap();
            let expected = w * h + 2.0 * (w + h) * by + PI * by * by;
            assert!((area(&grown) - expected).abs() < 1e-9 * expected, "{case}");
        }
        let (less, more) = (area(&of), area(&moved));
        assert!(if by < 0.0 { more <= less + 1e-9 } else { more >= less - 1e-9 }, "{case}");
        for p in places(&mut dice, &[], 0.0) {
            let (inside, far) = (is_in(&of, p), away(&of, p));
            if (far - by.abs()).abs() < 0.02 || far < 0.02 {
                continue;
            }
            let expected = if by > 0.0 { inside || far < by } else { inside && far > -by };
            assert_eq!(is_in(&moved, p), expected, "{case}: at {p:?} by {by} of {shapes:?}");
        }
    }
    assert!(3 * found > 2 * CASES, "{found}");
}

/// How far a place is from the boundary, by many places on it.
fn away(of: &[Surface], p: [f64; 2]) -> f64 {
    let rings = of.iter().flat_map(|s| [&s.outer].into_iter().chain(&s.holes));
    let mut least = f64::INFINITY;
    for ring in rings {
        for (i, b) in ring.iter().enumerate() {
            let c = ring[(i + 1) % ring.len()].at;
            for k in 0..=200 {
                let t = f64::from(k) / 200.0;
                let q = match b.bulge == 0.0 {
                    true => [b.at[0] + t * (c[0] - b.at[0]), b.at[1] + t * (c[1] - b.at[1])],
                    false => on_arc(b.at, c, b.bulge, t),
                };
                least = least.min(hypot(q[0] - p[0], q[1] - p[1]));
            }
        }
    }
    least
}

#[test]
fn arcs_stay_arcs() {
    let plate = region(Shape::Box { at: [0.0, 0.0], size: [10.0, 6.0] }.ring(false));
    let notch = region(Shape::Disc { at: [10.0, 3.0], radius: 2.0 }.ring(false));
    let cut = combine(Combination::Difference, &plate, &notch).unwrap();
    let outer = &cut[0].outer;
    assert_eq!((cut.len(), outer.len(), cut[0].holes.len()), (1, 6, 0));
    let bent: Vec<f64> = outer.iter().map(|b| b.bulge).filter(|b| *b != 0.0).collect();
    assert_eq!(bent.len(), 1);
    assert!((bent[0] + 1.0).abs() < 1e-12, "half a turn to the right: {bent:?}");
    assert!((area(&cut) - (60.0 - 2.0 * PI)).abs() < 1e-12 * 60.0);
}
#[test]
fn what_touches_in_a_corner_stays_apart() {
    let a = region(Shape::Box { at: [0.0, 0.0], size: [1.0, 1.0] }.ring(false));
    let b = region(Shape::Box { at: [1.0, 1.0], size: [1.0, 1.0] }.ring(true));
    let both = combine(Combination::Union, &a, &b).unwrap();
    assert_eq!(both.iter().map(|s| s.outer.len()).collect::<Vec<_>>(), [4, 4]);
    assert_eq!(combine(Combination::Intersection, &a, &b), Ok(Vec::new()));
}
#[test]
fn what_shares_an_edge_becomes_one() {
    let a = region(Shape::Box { at: [0.0, 0.0], size: [2.0, 1.0] }.ring(false));
    let b = region(Shape::Box { at: [2.0, 0.0], size: [2.0, 1.0] }.ring(false));
    let both = combine(Combination::Union, &a, &b).unwrap();
    assert_eq!((both.len(), both[0].outer.len()), (1, 4), "{both:?}");
    assert_eq!(combine(Combination::Difference, &a, &a), Ok(Vec::new()));
}
#[test]
fn a_contour_that_crosses_itself_is_refused() {
    let bend = |x, y| Bend { at: [x, y], bulge: 0.0 };
    let bow = region(vec![bend(0.0, 0.0), bend(2.0, 2.0), bend(2.0, 0.0), bend(0.0, 3.0)]);
    let a = region(Shape::Disc { at: [0.0, 0.0], radius: 1.0 }.ring(false));
    assert_eq!(combine(Combination::Union, &bow, &a), Err(geometry::NoRegion::Crossing));
    assert_eq!(offset(&bow, 0.1), Err(geometry::NoRegion::Crossing));
}
#[test]
fn it_is_as_exact_far_away_and_in_small() {
    for (scale, x) in [(1e-9, 0.0), (1e9, 0.0), (1.0, 1e7)] {
        let disc = |at: f64| {
            let ring = Shape::Disc { at: [at, 0.0], radius: 2.0 }.ring(false);
            let far = |b: Bend| Bend { at: [x + scale * b.at[0], scale * b.at[1]], ..b };
            region(ring.into_iter().map(far).collect())
        };
        let lens = combine(Combination::Intersection, &disc(0.0), &disc(2.0)).unwrap();
        // two circles through each other's centres
        let expected = scale * scale * 4.0 * (2.0 * PI / 3.0 - 0.75_f64.sqrt());
        assert!((area(&lens) - expected).abs() < 1e-7 * expected, "{scale} {x}");
    }
}
