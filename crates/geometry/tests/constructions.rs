//! Every construction against everything that could be meant: the answers of all signs and roots are enumerated,
//! those that do not run as they should are left out, and what is left has to be what was built.
//!
//! Nothing here is a closed form of the room: loci are met by their own formulas, radii are found by bisection, and
//! orientation is read off directions at contacts.

use base::Dice;
use geometry::{Algebra, Construction, Figure, NoConstruction, Plain, construct};

type P = [f64; 2];
type F = Figure<f64>;

const SETS: usize = 1000;

fn sub(p: P, q: P) -> P {
    [p[0] - q[0], p[1] - q[1]]
}
fn add(p: P, k: f64, q: P) -> P {
    [p[0] + k * q[0], p[1] + k * q[1]]
}
fn size(p: P) -> f64 {
    base::number::hypot(p[0], p[1])
}
fn angle(p: P) -> f64 {
    base::number::atan2(p[1], p[0])
}
fn toward(a: f64) -> P {
    [base::number::cos(a), base::number::sin(a)]
}
/// How far one turns left from one direction to another: 0 to 2π.
fn turn(from: P, to: P) -> f64 {
    let t = angle(to) - angle(from);
    if t < 0.0 { t + std::f64::consts::TAU } else { t }
}

/// Where two loci meet, each a straight (a point, an angle) or a circle (centre, size).
#[derive(Clone, Copy)]
enum Locus {
    Straight(P, f64),
    Circle(P, f64),
}

fn meet(a: Locus, b: Locus) -> Vec<P> {
    match (a, b) {
        (Locus::Straight(p, a), Locus::Straight(q, b)) => {
            // seen along the first, how high does the second begin, how steep is it
            let (w, along, up) = (sub(q, p), toward(a), toward(a + std::f64::consts::FRAC_PI_2));
            let (x, y) = (w[0] * along[0] + w[1] * along[1], w[0] * up[0] + w[1] * up[1]);
            let steep = base::number::tan(b - a);
            if steep == 0.0 { Vec::new() } else { vec![add(p, x - y / steep, along)] }
        }
        (Locus::Straight(p, a), Locus::Circle(c, r)) => {
            let d = toward(a);
            let w = sub(c, p);
            let near = w[0] * d[0] + w[1] * d[1];
            let off = size(sub(add(p, near, d), c));
            if off > r {
                return Vec::new();
            }
            let half = r * base::number::sin(base::number::acos(off / r));
            vec![add(p, near - half, d), add(p, near + half, d)]
        }
        (Locus::Circle(..), Locus::Straight(..)) => meet(b, a),
        (Locus::Circle(c, r), Locus::Circle(e, s)) => {
            let w = sub(e, c);
            let d = size(w);
            if d == 0.0 || d > r + s || d < (r - s).abs() {
                return Vec::new();
            }
            // by the law of cosines
            let at = base::number::acos((d * d + r * r - s * s) / (2.0 * d * r));
            [at, -at].map(|at| add(c, r, toward(angle(w) + at))).to_vec()
        }
    }
}

fn carrier(f: F) -> Locus {
    match f {
        Figure::Straight { from, to } => Locus::Straight(from, angle(sub(to, from))),
        Figure::Circle { center, radius } => Locus::Circle(center, radius.abs()),
        Figure::Point(p) => Locus::Circle(p, 0.0),
        Figure::Arc { .. } => unreachable!("no operand is an arc"),
    }
}
fn foot(f: F, p: P) -> P {
    match carrier(f) {
        Locus::Straight(q, a) => {
            let (d, w) = (toward(a), sub(p, q));
            add(q, w[0] * d[0] + w[1] * d[1], d)
        }
        Locus::Circle(c, r) => add(c, r, toward(angle(sub(p, c)))),
    }
}
/// The direction in which a figure runs at a place on it; a point runs any way.
fn runs(f: F, at: P) -> Option<P> {
    match f {
        Figure::Straight { from, to } => Some(toward(angle(sub(to, from)))),
        Figure::Circle { center, radius } => {
            let quarter = std::f64::consts::FRAC_PI_2 * radius.signum();
            Some(toward(angle(sub(at, center)) + quarter))
        }
        Figure::Point(_) | Figure::Arc { .. } => None,
    }
}
/// Where a circle touches a figure and both run the same way, if it does.
fn touches(circle: F, f: F) -> Option<P> {
    let Figure::Circle { center, radius } = circle else { return None };
    let scale = radius.abs() + 1.0;
    // of a circle the nearest place and the farthest may be the contact
    let near = foot(f, center);
    let mut places = vec![near];
    if let Figure::Circle { center: c, .. } = f {
        places.push(add(c, -1.0, sub(near, c)));
    }
    places.into_iter().find(|&at| {
        let on = (size(sub(at, center)) - radius.abs()).abs() < 1e-6 * scale;
        let alike = match (runs(circle, at), runs(f, at)) {
            (Some(a), Some(b)) => a[0] * b[0] + a[1] * b[1] > 0.0,
            _ => true,
        };
        on && alike
    })
}
/// How far one goes along a circle from one place on it to another, as a turn.
fn along(circle: F, from: P, to: P) -> f64 {
    let Figure::Circle { center, radius } = circle else { return f64::NAN };
    match radius > 0.0 {
        true => turn(sub(from, center), sub(to, center)),
        false => turn(sub(to, center), sub(from, center)),
    }
}
/// Every circle of a radius that touches two figures, however they run.
fn all_of_radius(a: F, b: F, radius: f64) -> Vec<F> {
    let loci = |f: F| match carrier(f) {
        Locus::Straight(p, a) => {
            let up = toward(a + std::f64::consts::FRAC_PI_2);
            [radius, -radius].map(|r| Locus::Straight(add(p, r, up), a))
        }
        Locus::Circle(c, r) => {
            [r + radius.abs(), (r - radius.abs()).abs()].map(|s| Locus::Circle(c, s))
        }
    };
    let pairs = loci(a).into_iter().flat_map(|x| loci(b).map(|y| (x, y)));
    pairs.flat_map(|(x, y)| meet(x, y)).map(|center| Figure::Circle { center, radius }).collect()
}
fn in_order(circle: F, of: &[F]) -> bool {
    let contacts: Option<Vec<P>> = of.iter().map(|&f| touches(circle, f)).collect();
    let is_straight = |f: &F| matches!(f, Figure::Straight { .. });
    match contacts.as_deref() {
        // straights leave one circle
        Some(_) if of.iter().all(is_straight) => true,
        Some([a, b]) => along(circle, *a, *b) < std::f64::consts::PI,
        Some([a, b, c]) => along(circle, *a, *b) < along(circle, *a, *c),
        _ => false,
    }
}
/// Every circle that touches three figures, found by looking through the radii.
fn all_of_three(of: [F; 3]) -> Vec<F> {
    let [a, b, c] = of;
    let gap = |circle: F, to: F| -> Vec<f64> {
        let Figure::Circle { center, radius } = circle else { return Vec::new() };
        match carrier(to) {
            Locus::Straight(..) => vec![size(sub(foot(to, center), center)) - radius.abs()],
            Locus::Circle(e, s) => {
                let d = size(sub(center, e));
                vec![d - (s + radius.abs()), d - (s - radius.abs()).abs()]
            }
        }
    };
    let gaps = |radius: f64| -> Vec<f64> {
        let all = all_of_radius(a, b, radius);
        if all.len() < 8 && matches!((a, b), (Figure::Circle { .. }, Figure::Circle { .. })) {
            return Vec::new();
        }
        all.into_iter().flat_map(|f| gap(f, c)).collect()
    };
    let mut found = Vec::new();
    for sign in [1.0, -1.0] {
        let radii: Vec<f64> =
            (0..700).map(|i| sign * base::number::exp(-4.0 + 0.0125 * f64::from(i))).collect();
        for pair in radii.windows(2) {
            let (low, high) = (gaps(pair[0]), gaps(pair[1]));
            if low.len() != high.len() {
                continue;
            }
            for i in 0..low.len() {
                if low[i] * high[i] >= 0.0 {
                    continue;
                }
                let (mut p, mut q) = (pair[0], pair[1]);
                for _ in 0..60 {
                    let half = 0.5 * (p + q);
                    let g = gaps(half);
                    if g.len() == low.len() && g[i] * low[i] > 0.0 { p = half } else { q = half }
                }
                found.extend(all_of_radius(a, b, 0.5 * (p + q)));
            }
        }
    }
    found
}

fn a_point(dice: &mut Dice) -> P {
    [dice.between(-10.0, 10.0), dice.between(-10.0, 10.0)]
}
fn a_straight(dice: &mut Dice) -> F {
    Figure::Straight { from: a_point(dice), to: a_point(dice) }
}
fn a_radius(dice: &mut Dice) -> f64 {
    let r = dice.between(0.3, 7.0);
    if dice.below(2) == 0 { r } else { -r }
}
fn a_circle(dice: &mut Dice) -> F {
    Figure::Circle { center: a_point(dice), radius: a_radius(dice) }
}
fn a_curve(dice: &mut Dice) -> F {
    if dice.below(2) == 0 { a_straight(dice) } else { a_circle(dice) }
}
fn anything(dice: &mut Dice) -> F {
    match dice.below(5) {
        0 => Figure::Point(a_point(dice)),
        _ => a_curve(dice),
    }
}

/// Operands that a construction takes.
fn operands(what: Construction, dice: &mut Dice) -> (Vec<F>, Vec<f64>) {
    use Construction as C;
    let point = |dice: &mut Dice| Figure::Point(a_point(dice));
    let of = match what {
        C::Polar | C::Directed => vec![point(dice)],
        C::Intersection => vec![a_curve(dice), a_curve(dice)],
        C::Projection => vec![point(dice), a_curve(dice)],
        C::Parallel => vec![a_straight(dice)],
        C::ParallelThrough | C::Perpendicular => vec![a_straight(dice), point(dice)],
        C::PerpendicularFrom => vec![point(dice), a_straight(dice)],
        C::TangentFrom => vec![point(dice), a_circle(dice)],
        C::TangentToCircles => vec![a_circle(dice), a_circle(dice)],
        C::TangentAlong => vec![a_circle(dice), a_straight(dice)],
        C::Bisector => vec![a_straight(dice), a_straight(dice)],
        C::PerpendicularBisector | C::Around => vec![point(dice), point(dice)],
        C::TangentAround | C::TangentAt => vec![a_curve(dice), point(dice)],
        C::TangentToTwo | C::Fillet | C::ClockwiseFillet => vec![anything(dice), anything(dice)],
        C::TangentToThree => vec![anything(dice), anything(dice), anything(dice)],
        C::ArcThrough | C::ClockwiseArcThrough => vec![point(dice), point(dice), point(dice)],
    };
    let numbers = match what.takes().1 {
        2 => vec![dice.between(0.1, 9.0), dice.between(-3.0, 3.0)],
        1 if matches!(what, C::Fillet | C::ClockwiseFillet) => vec![dice.between(0.1, 7.0)],
        1 => vec![a_radius(dice)],
        _ => Vec::new(),
    };
    (of, numbers)
}

/// Everything that a construction could mean, and is: enumerated, then left out where it runs wrongly.
#[expect(clippy::too_many_lines, reason = "one table of what every construction means")]
fn meant(what: Construction, of: &[F], numbers: &[f64]) -> Vec<F> {
    use Construction as C;
    let quarter = std::f64::consts::FRAC_PI_2;
    let straight = |from: P, a: f64| Figure::Straight { from, to: add(from, 1.0, toward(a)) };
    let way = |f: F| angle(runs(f, foot(f, [0.0; 2])).expect("it runs"));
    let at = |f: F| if let Figure::Point(p) = f { p } else { [f64::NAN; 2] };
    let left_of = |f: F, p: P| {
        let Figure::Straight { from, .. } = f else { return f64::NAN };
        size(sub(p, foot(f, p))) * base::number::sin(turn(toward(way(f)), sub(p, from))).signum()
    };
    match (what, of, numbers) {
        (C::Polar, [p], [d, a]) => vec![Figure::Point(add(at(*p), *d, toward(*a)))],
        (C::Intersection, [a, b], []) => {
            let both = meet(carrier(*a), carrier(*b));
            let only = both.len() == 1;
            let turns = |p: &P| {
                let (u, v) = (runs(*a, *p).expect("it runs"), runs(*b, *p).expect("it runs"));
                only || turn(u, v) < std::f64::consts::PI
            };
            both.into_iter().filter(turns).map(Figure::Point).collect()
        }
        (C::Projection, [p, curve], []) => vec![Figure::Point(foot(*curve, at(*p)))],
        (C::Directed, [p], [a]) => vec![straight(at(*p), *a)],
        (C::Parallel, [l @ Figure::Straight { from, .. }], [d]) => [*d, -*d]
            .into_iter()
            .map(|d| straight(add(*from, d, toward(way(*l) + quarter)), way(*l)))
            .filter(|f| matches!(f, Figure::Straight { from, .. } if (left_of(*l, *from) - d).abs() < 1e-6))
            .collect(),
        (C::ParallelThrough, [l, p], []) => vec![straight(at(*p), way(*l))],
        (C::Perpendicular, [l, p], []) => vec![straight(at(*p), way(*l) + quarter)],
        (C::PerpendicularFrom, [p, l], []) => {
            vec![straight(at(*p), angle(sub(foot(*l, at(*p)), at(*p))))]
        }
        (C::TangentFrom | C::TangentToCircles, [a, b], []) => {
            // the contacts on the second circle see the first at a right angle: looked for by angle
            let (Locus::Circle(c, r), Locus::Circle(e, s)) = (carrier(*a), carrier(*b)) else {
                return Vec::new();
            };
            let d = size(sub(e, c));
            let base = angle(sub(e, c));
            let mut all = Vec::new();
            for reach in [r + s, r - s, s - r, -r - s] {
                if reach.abs() >= d {
                    continue;
                }
                for normal in [1.0, -1.0].map(|k| base + k * base::number::acos(reach / d)) {
                    for (p, q) in [(r, s), (r, -s), (-r, s), (-r, -s)] {
                        let (from, to) = (add(c, p, toward(normal)), add(e, q, toward(normal)));
                        let line = Figure::Straight { from, to };
                        let on = |f: F, at: P| {
                            let way = angle(sub(to, from));
                            let alike = runs(f, at).is_none_or(|u| {
                                u[0] * toward(way)[0] + u[1] * toward(way)[1] > 1.0 - 1e-9
                            });
                            alike && (size(sub(foot(line, center(f)), center(f))) - size(sub(at, center(f)))).abs() < 1e-9
                        };
                        if size(sub(to, from)) > 1e-6 && on(*a, from) && on(*b, to) {
                            all.push(line);
                        }
                    }
                }
            }
            all
        }
        (C::TangentAlong, [c @ Figure::Circle { center, radius }, l], []) => [1.0, -1.0]
            .into_iter()
            .map(|k| add(*center, k * radius, toward(way(*l) + quarter)))
            .filter(|&p| {
                let (u, v) = (runs(*c, p).expect("it runs"), toward(way(*l)));
                u[0] * v[0] + u[1] * v[1] > 0.0
            })
            .map(|p| straight(p, way(*l)))
            .collect(),
        (C::Bisector, [a, b], []) => {
            // of the two angles between, the one that both run along; as far to the left of one as to the right
            let corner = meet(carrier(*a), carrier(*b));
            let turned = turn(toward(way(*a)), toward(way(*b)));
            let half = if turned > std::f64::consts::PI { 0.5 * turned - std::f64::consts::PI } else { 0.5 * turned };
            corner.into_iter().map(|p| straight(p, way(*a) + half)).collect()
        }
        (C::PerpendicularBisector, [p, q], []) => {
            let (p, q) = (at(*p), at(*q));
            vec![straight(add(p, 0.5, sub(q, p)), angle(sub(q, p)) + quarter)]
        }
        (C::Around, [p, q], []) => {
            vec![Figure::Circle { center: at(*p), radius: size(sub(at(*q), at(*p))) }]
        }
        (C::TangentAround, [curve, p], []) => {
            let radius = size(sub(foot(*curve, at(*p)), at(*p)));
            [radius, -radius]
                .map(|radius| Figure::Circle { center: at(*p), radius })
                .into_iter()
                .filter(|c| {
                    let near = foot(*curve, at(*p));
                    let (u, v) = (runs(*c, near).expect("it runs"), runs(*curve, near).expect("it runs"));
                    u[0] * v[0] + u[1] * v[1] > 0.0
                })
                .collect()
        }
        (C::TangentAt, [curve, p], [radius]) => {
            let contact = foot(*curve, at(*p));
            let way = angle(runs(*curve, contact).expect("it runs"));
            [quarter, -quarter]
                .map(|q| Figure::Circle { center: add(contact, radius.abs(), toward(way + q)), radius: *radius })
                .into_iter()
                .filter(|c| {
                    let u = runs(*c, contact).expect("it runs");
                    u[0] * toward(way)[0] + u[1] * toward(way)[1] > 0.0
                })
                .collect()
        }
        (C::TangentToTwo, [a, b], [radius]) => {
            let all = all_of_radius(*a, *b, *radius).into_iter();
            all.filter(|c| in_order(*c, of)).collect()
        }
        (C::TangentToThree, [a, b, c], []) => {
            let all = all_of_three([*a, *b, *c]).into_iter();
            all.filter(|c| in_order(*c, of)).collect()
        }
        (C::Fillet | C::ClockwiseFillet, [a, b], [radius]) => {
            let radius = if what == C::Fillet { *radius } else { -radius };
            let circles = all_of_radius(*a, *b, radius).into_iter();
            circles
                .filter_map(|c| {
                    let Figure::Circle { center, .. } = c else { return None };
                    let (start, end) = (touches(c, *a)?, touches(c, *b)?);
                    let is_short = along(c, start, end) < std::f64::consts::PI;
                    is_short.then_some(Figure::Arc { center, start, end })
                })
                .collect()
        }
        (C::ArcThrough | C::ClockwiseArcThrough, [p, q, r], []) => {
            let (p, q, r) = (at(*p), at(*q), at(*r));
            let bisector = |p: P, q: P| {
                Locus::Straight(add(p, 0.5, sub(q, p)), angle(sub(q, p)) + quarter)
            };
            let centers = meet(bisector(p, q), bisector(q, r));
            let sign = if what == C::ArcThrough { 1.0 } else { -1.0 };
            centers
                .into_iter()
                .filter(|&center| {
                    let c = Figure::Circle { center, radius: sign };
                    along(c, p, q) < along(c, p, r)
                })
                .map(|center| Figure::Arc { center, start: p, end: r })
                .collect()
        }
        _ => panic!("{what:?} takes other operands"),
    }
}
fn radius(f: F) -> f64 {
    if let Figure::Circle { radius, .. } = f { radius.abs() } else { f64::NAN }
}
fn center(f: F) -> P {
    match f {
        Figure::Circle { center, .. } => center,
        Figure::Point(p) => p,
        Figure::Straight { .. } | Figure::Arc { .. } => [f64::NAN; 2],
    }
}

/// How far apart two figures are; straights as lines.
fn apart(a: F, b: F) -> f64 {
    match (a, b) {
        (Figure::Straight { from, to }, Figure::Straight { from: p, to: q }) => {
            let (u, v) = (sub(to, from), sub(q, p));
            let turned = turn(u, v);
            turned.min(std::f64::consts::TAU - turned) + size(sub(from, foot(b, from)))
        }
        _ => {
            let pairs = a.numbers().into_iter().zip(b.numbers());
            pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
        }
    }
}

#[test]
fn every_construction_is_the_one_that_is_meant() {
    for what in Construction::ALL {
        let mut dice = Dice::new(what as u64 + 1);
        let (mut built, mut none, mut enumerated) = (0, 0, 0);
        for set in 0..SETS {
            let (of, numbers) = operands(what, &mut dice);
            let answer = construct(what, &of, &numbers);
            let meant = meant(what, &of, &numbers);
            let said =
                format!("{what:?} {set}: {of:?} {numbers:?}\n  is {answer:?}\n  meant {meant:?}");
            match answer {
                Ok(answer) => {
                    built += 1;
                    enumerated += usize::from(!meant.is_empty());
                    let scale = answer.numbers().iter().fold(1.0, |m: f64, x| m.max(x.abs()));
                    let is_smaller = |other: &&F| {
                        what == Construction::TangentToThree
                            && radius(answer) * (1.0 + 1e-6) < radius(**other)
                    };
                    for other in meant.iter().filter(|other| !is_smaller(other)) {
                        assert!(apart(answer, *other) < 1e-5 * scale, "{said}");
                    }
                    // radii are looked for in a range: what lies outside of it is at least as it should be
                    if what == Construction::TangentToThree {
                        assert!(in_order(answer, &of), "{said}");
                    } else {
                        assert!(!meant.is_empty(), "{said}");
                    }
                }
                Err(_) => {
                    none += 1;
                    assert!(meant.is_empty(), "{said}");
                }
            }
        }
        assert!(
            built > SETS / 10 && enumerated > built / 2,
            "{what:?}: {built}, {none}, {enumerated}"
        );
    }
}

fn moved(f: F, to: impl Fn(P) -> P, scale: f64) -> F {
    match f {
        Figure::Point(p) => Figure::Point(to(p)),
        Figure::Straight { from, to: end } => Figure::Straight { from: to(from), to: to(end) },
        Figure::Circle { center, radius } => {
            Figure::Circle { center: to(center), radius: scale * radius }
        }
        Figure::Arc { center, start, end } => {
            Figure::Arc { center: to(center), start: to(start), end: to(end) }
        }
    }
}

#[test]
fn replay_takes_the_same_side_in_every_place_and_size() {
    for what in Construction::ALL {
        let mut dice = Dice::new(what as u64 + 77);
        for _ in 0..200 {
            let (of, numbers) = operands(what, &mut dice);
            let Ok(answer) = construct(what, &of, &numbers) else { continue };
            assert_eq!(construct(what, &of, &numbers), Ok(answer));
            for scale in [1e-9, 1.0, 1e9] {
                let way = toward(dice.between(-3.0, 3.0));
                let turned = |p: P| {
                    [
                        scale * (p[0] * way[0] - p[1] * way[1]),
                        scale * (p[0] * way[1] + p[1] * way[0]),
                    ]
                };
                let there: Vec<F> = of.iter().map(|f| moved(*f, turned, scale)).collect();
                let numbers: Vec<f64> = match what {
                    Construction::Polar => vec![scale * numbers[0], numbers[1] + angle(way)],
                    Construction::Directed => vec![numbers[0] + angle(way)],
                    _ => numbers.iter().map(|x| scale * x).collect(),
                };
                let again = construct(what, &there, &numbers);
                let want = moved(answer, turned, scale);
                let again =
                    again.unwrap_or_else(|why| panic!("{what:?} {of:?} at {scale}: {why:?}"));
                let largest = want.numbers().iter().fold(scale, |m: f64, x| m.max(x.abs()));
                let off = match (again, want) {
                    (Figure::Straight { from, to }, Figure::Straight { from: p, to: q }) => {
                        let t = turn(sub(to, from), sub(q, p));
                        t.min(std::f64::consts::TAU - t) + size(sub(from, p)) / largest
                    }
                    _ => apart(again, want) / largest,
                };
                assert!(off < 1e-5, "{what:?} {of:?} at {scale}: {again:?}, wanted {want:?}");
            }
        }
    }
}
#[test]
#[expect(clippy::too_many_lines, reason = "one table of cases")]
fn degenerate_operands_get_a_reason() {
    use Construction as C;
    use NoConstruction as N;
    let point = |x: f64, y: f64| Figure::Point([x, y]);
    let line = |a: P, b: P| Figure::Straight { from: a, to: b };
    let ring = |x: f64, y: f64, radius: f64| Figure::Circle { center: [x, y], radius };
    for scale in [1e-9, 1.0, 1e9] {
        let s = |f: F| moved(f, |p| [scale * p[0], scale * p[1]], scale);
        let flat = s(line([0.0, 0.0], [4.0, 0.0]));
        let above = s(line([1.0, 3.0], [6.0, 3.0]));
        let none = s(line([2.0, 2.0], [2.0, 2.0]));
        let cases: Vec<(C, Vec<F>, Vec<f64>, N)> = vec![
            (C::Intersection, vec![flat, above], vec![], N::Parallel),
            (C::Intersection, vec![flat, none], vec![], N::NoDirection),
            (C::Intersection, vec![flat, s(ring(0.0, 5.0, 3.0))], vec![], N::Apart),
            (
                C::Intersection,
                vec![s(ring(0.0, 5.0, 3.0)), s(ring(0.0, 5.0, 2.0))],
                vec![],
                N::Concentric,
            ),
            (C::Intersection, vec![flat, s(ring(0.0, 0.0, 0.0))], vec![], N::NoRadius),
            (
                C::Projection,
                vec![s(point(1.0, 2.0)), s(ring(1.0, 2.0, 3.0))],
                vec![],
                N::Coincident,
            ),
            (C::Parallel, vec![none], vec![1.0], N::NoDirection),
            (C::PerpendicularFrom, vec![s(point(3.0, 0.0)), flat], vec![], N::Coincident),
            (C::TangentFrom, vec![s(point(0.0, 1.0)), s(ring(0.0, 0.0, 2.0))], vec![], N::Inside),
            (
                C::TangentToCircles,
                vec![s(ring(0.0, 0.0, 5.0)), s(ring(1.0, 0.0, 2.0))],
                vec![],
                N::Inside,
            ),
            (
                C::TangentToCircles,
                vec![s(ring(1.0, 0.0, 5.0)), s(ring(1.0, 0.0, 2.0))],
                vec![],
                N::Concentric,
            ),
            (C::Bisector, vec![flat, s(line([6.0, 3.0], [1.0, 3.0]))], vec![], N::Opposite),
            (
                C::PerpendicularBisector,
                vec![s(point(1.0, 1.0)), s(point(1.0, 1.0))],
                vec![],
                N::Coincident,
            ),
            (C::Around, vec![s(point(1.0, 1.0)), s(point(1.0, 1.0))], vec![], N::Coincident),
            (C::TangentAround, vec![flat, s(point(9.0, 0.0))], vec![], N::NoRadius),
            (C::TangentAt, vec![flat, s(point(9.0, 4.0))], vec![0.0], N::NoRadius),
            (C::TangentToTwo, vec![flat, above], vec![scale], N::Parallel),
            (C::TangentToTwo, vec![flat, above], vec![0.0], N::NoRadius),
            (
                C::TangentToTwo,
                vec![s(ring(0.0, 0.0, 1.0)), s(ring(50.0, 0.0, 1.0))],
                vec![3.0 * scale],
                N::Apart,
            ),
            (
                C::TangentToTwo,
                vec![s(ring(0.0, 0.0, 1.0)), s(ring(0.0, 0.0, 2.0))],
                vec![3.0 * scale],
                N::Concentric,
            ),
            (
                C::TangentToTwo,
                vec![s(point(1.0, 1.0)), s(point(1.0, 1.0))],
                vec![scale],
                N::Concentric,
            ),
            (
                C::TangentToThree,
                vec![flat, above, s(line([0.0, 9.0], [5.0, 9.0]))],
                vec![],
                N::Parallel,
            ),
            (
                C::TangentToThree,
                vec![s(point(0.0, 0.0)), s(point(1.0, 1.0)), s(point(2.0, 2.0))],
                vec![],
                N::Collinear,
            ),
            (
                C::TangentToThree,
                vec![s(point(0.0, 0.0)), s(point(0.0, 0.0)), s(point(2.0, 2.0))],
                vec![],
                N::Collinear,
            ),
            (C::Fillet, vec![flat, s(line([0.0, 0.0], [0.0, 3.0]))], vec![-scale], N::Turn),
            (
                C::ArcThrough,
                vec![s(point(0.0, 0.0)), s(point(1.0, 1.0)), s(point(2.0, 0.0))],
                vec![],
                N::Turn,
            ),
            (
                C::ArcThrough,
                vec![s(point(0.0, 0.0)), s(point(1.0, 1.0)), s(point(2.0, 2.0))],
                vec![],
                N::Collinear,
            ),
            (
                C::ArcThrough,
                vec![s(point(0.0, 0.0)), s(point(1.0, 1.0)), s(point(1.0, 1.0))],
                vec![],
                N::Coincident,
            ),
            (C::Polar, vec![point(f64::NAN, 0.0)], vec![1.0, 1.0], N::NotFinite),
            (C::Polar, vec![flat], vec![1.0, 1.0], N::Operands),
            (C::TangentFrom, vec![flat], vec![], N::Operands),
        ];
        for (what, of, numbers, why) in cases {
            assert_eq!(construct(what, &of, &numbers), Err(why), "{what:?} {of:?} {numbers:?}");
        }
    }
}

#[test]
fn parallel_lines_have_a_bisector_between_them() {
    let low = Figure::Straight { from: [0.0, 0.0], to: [4.0, 0.0] };
    let high = Figure::Straight { from: [1.0, 3.0], to: [6.0, 3.0] };
    let between = Figure::Straight { from: [0.0, 1.5], to: [4.0, 1.5] };
    assert_eq!(construct(Construction::Bisector, &[low, high], &[]), Ok(between));
}

#[test]
fn the_rings_of_the_worked_example_come_out_as_told() {
    let axis = Figure::Straight { from: [0.0, 0.0], to: [0.0, 1.0] };
    let mut under = Figure::Straight { from: [0.0, 0.0], to: [1.0, 0.0] };
    let (mut radius, mut centers) = (40.0, Vec::new());
    while centers.len() < 6 {
        let ring = construct(Construction::TangentToTwo, &[under, axis], &[radius]);
        let ring = ring.expect("every ring has its place");
        centers.push(center(ring));
        under = ring.reversed(&mut Plain);
        radius = Plain.mul(radius, 0.5);
    }
    assert_eq!(centers[0], [-40.0, 40.0]);
    let second = 40.0 + base::number::sqrt(3200.0);
    assert!((centers[1][0] + 20.0).abs() < 1e-12 && (centers[1][1] - second).abs() < 1e-9);
    assert_eq!(radius, 0.625);
}
