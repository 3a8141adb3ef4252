//! Measures of lines: how long they are, which of their places is nearest to a point, and how much they surround.
//!
//! In: shapes. Each is read as *strokes*, smooth pieces with a place and a direction at each parameter. Straight strokes and
//! arcs are measured in closed form; of the others the speed is integrated, and the foot of a perpendicular is bracketed
//! and halved.

use crate::curve::{edges, on_ellipse};
use crate::element::{Point, Shape};
use crate::nurbs::Nurbs;
use crate::spline::{self, Piece};
use base::number::{atan2, cos, hypot, sin};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Between so many places of a stroke the foot of a perpendicular is looked for.
const BRACKETS: u32 = 64;
/// A bracket is halved so often: to the last bit.
const HALVINGS: u32 = 60;
/// An integral is halved no deeper than this.
const DEPTH: u32 = 24;
/// How far an integral may be from its halves, as a part of it.
const TOLERANCE: f64 = 1e-13;
/// Ends that are no further from each other than this part of how far the lines reach are one.
const NEAR: f64 = 1e-9;

/// A smooth piece of a line.
enum Stroke<'a> {
    Straight(Point, Point),
    Arc { center: Point, radius: f64, start: f64, sweep: f64 },
    Ellipse { center: Point, major: Point, ratio: f64, start: f64, sweep: f64 },
    Cubic(Piece),
    Rational(&'a Nurbs, usize),
}

/// Returns how long the lines of shapes are; nothing where there are none, as of words.
///
/// Accuracy: 1e-12 of it, where a curve has no cusp. Cost: some hundred evaluations a curve.
///
/// ```
/// use drawing::{Point, Shape, measure};
/// let p = |x, y| Point { x, y };
/// let half = Shape::Arc { center: p(0.0, 0.0), radius: 2.0, start: 0.0, sweep: std::f64::consts::PI };
/// assert_eq!(measure::length(&[half]), Some(2.0 * std::f64::consts::PI));
/// ```
pub fn length<'a>(of: impl IntoIterator<Item = &'a Shape>) -> Option<f64> {
    let all: Vec<Stroke<'_>> = of.into_iter().flat_map(strokes).collect();
    (!all.is_empty()).then(|| all.iter().map(Stroke::length).sum())
}

/// Returns the place on the lines of shapes that is nearest to a point; nothing where there are no lines.
///
/// Of two that are as near, the first along the lines.
pub fn nearest<'a>(of: impl IntoIterator<Item = &'a Shape>, to: Point) -> Option<Point> {
    let away = |p: &Point| hypot(p.x - to.x, p.y - to.y);
    let feet = of.into_iter().flat_map(strokes).flat_map(|stroke| stroke.feet(to));
    feet.min_by(|a, b| away(a).total_cmp(&away(b)))
}

/// Returns the area that the lines of shapes surround, in whichever order and whichever way they run.
///
/// Cost: n log n in the number of lines.
///
/// # Errors
/// They are open, or branch.
pub fn area<'a>(of: impl IntoIterator<Item = &'a Shape>) -> Result<f64, &'static str> {
    let all: Vec<Stroke<'_>> = of.into_iter().flat_map(strokes).collect();
    if all.is_empty() {
        return Err("there are no lines");
    }
    let ends = Ends::of(&all);
    let mut is_left = vec![true; all.len()];
    let mut total = 0.0;
    for first in (0..all.len()).rev() {
        if !std::mem::take(&mut is_left[first]) {
            continue;
        }
        let [from, mut at] = all[first].ends();
        let mut ring = all[first].beside(from);
        while !ends.are_one(at, from) {
            let (next, is_back) = ends.that_follows(at, &is_left)?;
            is_left[next] = false;
            let [p, q] = all[next].ends();
            let beside = all[next].beside(from);
            ring += if is_back { -beside } else { beside };
            at = if is_back { p } else { q };
        }
        total += ring.abs();
    }
    Ok(total)
}

/// The ends of strokes, found by where they are: each lies in a cell as wide as ends that are one may be apart.
struct Ends {
    near: f64,
    /// Of each cell the strokes that end there, each with the place and whether it is the last of the stroke.
    cells: BTreeMap<[u64; 2], Vec<(usize, Point, bool)>>,
}

impl Ends {
    fn of(strokes: &[Stroke<'_>]) -> Self {
        let reach = { strokes.iter().flat_map(Stroke::ends) }
            .fold(0.0_f64, |most, p| most.max(p.x.abs()).max(p.y.abs()));
        let mut ends = Self { near: NEAR * reach, cells: BTreeMap::new() };
        for (i, stroke) in strokes.iter().enumerate() {
            for (p, is_last) in stroke.ends().into_iter().zip([false, true]) {
                let cell = ends.cell(p, [0.0, 0.0]);
                ends.cells.entry(cell).or_default().push((i, p, is_last));
            }
        }
        ends
    }

    fn are_one(&self, p: Point, q: Point) -> bool {
        hypot(p.x - q.x, p.y - q.y) <= self.near
    }

    /// Returns the cell of a place, or one so many further.
    fn cell(&self, p: Point, further: [f64; 2]) -> [u64; 2] {
        // where all ends are one, so are the cells; a sum with zero is never the negative zero
        let width = self.near.max(f64::MIN_POSITIVE);
        let [x, y] = further;
        [((p.x / width).floor() + x + 0.0).to_bits(), ((p.y / width).floor() + y + 0.0).to_bits()]
    }

    /// Returns the stroke that is left and goes on from a place, and whether it does so backwards.
    fn that_follows(&self, at: Point, is_left: &[bool]) -> Result<(usize, bool), &'static str> {
        let mut found: Option<(usize, bool)> = None;
        let beside = [-1.0, 0.0, 1.0];
        for cell in beside.iter().flat_map(|&x| beside.map(|y| self.cell(at, [x, y]))) {
            for &(i, p, is_last) in self.cells.get(&cell).into_iter().flatten() {
                if !is_left[i] || !self.are_one(p, at) {
                    continue;
                }
                match found {
                    None => found = Some((i, is_last)),
                    // one that comes back to where it began goes on forwards
                    Some((known, was)) if known == i => found = Some((i, was && is_last)),
                    Some(_) => {
                        return Err("the lines branch: more than two end at one place");
                    }
                }
            }
        }
        found.ok_or("the lines surround nothing: an end of one is no end of another")
    }
}

/// Reads the line of a shape piece by piece.
fn strokes(shape: &Shape) -> Vec<Stroke<'_>> {
    match shape {
        Shape::Dot(_) | Shape::Text { .. } => Vec::new(),
        Shape::Segment(p, q) => vec![Stroke::Straight(*p, *q)],
        Shape::Polyline { points, closed } => {
            let back = points.last().zip(points.first()).filter(|_| *closed);
            let pairs = points.windows(2).map(|w| (w[0], w[1]));
            let all = pairs.chain(back.map(|(p, q)| (*p, *q)));
            all.map(|(p, q)| Stroke::Straight(p, q)).collect()
        }
        Shape::Circle { center, radius } => {
            vec![Stroke::Arc { center: *center, radius: *radius, start: 0.0, sweep: TAU }]
        }
        Shape::Arc { center, radius, start, sweep } => {
            vec![Stroke::Arc { center: *center, radius: *radius, start: *start, sweep: *sweep }]
        }
        Shape::Ellipse { center, major, ratio, start, sweep } => {
            let (center, major) = (*center, *major);
            let (ratio, sweep) = (*ratio, sweep / 4.0);
            let quarter = |i: i32| {
                let start = start + sweep * f64::from(i);
                Stroke::Ellipse { center, major, ratio, start, sweep }
            };
            (0..4).map(quarter).collect()
        }
        Shape::Spline(poles) => spline::pieces(poles).map(Stroke::Cubic).collect(),
        Shape::Nurbs(curve) => curve.spans().map(|span| Stroke::Rational(curve, span)).collect(),
        Shape::Region(rings) => {
            let all = rings.iter().flat_map(|ring| edges(ring));
            let own = |edge: Shape| match edge {
                Shape::Segment(p, q) => Some(Stroke::Straight(p, q)),
                Shape::Arc { center, radius, start, sweep } => {
                    Some(Stroke::Arc { center, radius, start, sweep })
                }
                Shape::Spline(poles) => spline::pieces(&poles).next().map(Stroke::Cubic),
                _ => None,
            };
            all.filter_map(own).collect()
        }
    }
}

impl Stroke<'_> {
    /// The parameters of its ends.
    fn range(&self) -> (f64, f64) {
        match self {
            Self::Straight(..) | Self::Cubic(_) => (0.0, 1.0),
            Self::Arc { start, sweep, .. } | Self::Ellipse { start, sweep, .. } => {
                (*start, start + sweep)
            }
            Self::Rational(curve, span) => (curve.knots()[*span], curve.knots()[span + 1]),
        }
    }

    /// Its place at a parameter, and the derivative there.
    fn at(&self, t: f64) -> (Point, Point) {
        match *self {
            Self::Straight(p, q) => {
                let way = Point { x: q.x - p.x, y: q.y - p.y };
                (Point { x: p.x + t * way.x, y: p.y + t * way.y }, way)
            }
            Self::Arc { center, radius, .. } => {
                let (x, y) = (radius * cos(t), radius * sin(t));
                (Point { x: center.x + x, y: center.y + y }, Point { x: -y, y: x })
            }
            Self::Ellipse { center, major, ratio, .. } => {
                let (c, s) = (ratio * cos(t), sin(t));
                let slope = Point { x: -s * major.x - c * major.y, y: -s * major.y + c * major.x };
                (on_ellipse(center, major, ratio, t), slope)
            }
            Self::Cubic(piece) => {
                let s = 1.0 - t;
                let along = |of: fn(Point) -> f64| {
                    let [a, b, c, d] = piece.map(of);
                    3.0 * (s * s * (b - a) + 2.0 * s * t * (c - b) + t * t * (d - c))
                };
                (spline::at(piece, t), Point { x: along(|p| p.x), y: along(|p| p.y) })
            }
            Self::Rational(curve, span) => curve.in_span(span, t),
        }
    }

    fn ends(&self) -> [Point; 2] {
        let (from, to) = self.range();
        [self.at(from).0, self.at(to).0]
    }

    fn length(&self) -> f64 {
        match *self {
            Self::Straight(p, q) => hypot(q.x - p.x, q.y - p.y),
            Self::Arc { radius, sweep, .. } => radius * sweep.abs(),
            Self::Ellipse { .. } | Self::Cubic(_) | Self::Rational(..) => {
                let speed = |t| {
                    let (_, slope) = self.at(t);
                    hypot(slope.x, slope.y)
                };
                integral(&speed, self.range()).abs()
            }
        }
    }

    /// How much lies between it and a place beside it, to its left.
    fn beside(&self, from: Point) -> f64 {
        let swept = |t| {
            let (p, slope) = self.at(t);
            0.5 * ((p.x - from.x) * slope.y - (p.y - from.y) * slope.x)
        };
        match *self {
            Self::Straight(..) => swept(0.0),
            Self::Arc { center, radius, sweep, .. } => {
                let [p, q] = self.ends();
                let way = Point { x: center.x - from.x, y: center.y - from.y };
                let chord = way.x * (q.y - p.y) - way.y * (q.x - p.x);
                0.5 * (radius * radius * sweep + chord)
            }
            Self::Ellipse { .. } | Self::Cubic(_) | Self::Rational(..) => {
                integral(&swept, self.range())
            }
        }
    }

    /// Its ends, and its places from which a point is seen at a right angle, in their order.
    fn feet(&self, to: Point) -> Vec<Point> {
        let (from, until) = self.range();
        let mut all = vec![self.at(from).0];
        match *self {
            Self::Straight(p, _) => {
                let (_, way) = self.at(0.0);
                let along = (to.x - p.x) * way.x + (to.y - p.y) * way.y;
                let part = along / (way.x * way.x + way.y * way.y);
                if 0.0 < part && part < 1.0 {
                    all.push(self.at(part).0);
                }
            }
            Self::Arc { center, sweep, .. } => {
                // towards the point, within the turn
                let angle = atan2(to.y - center.y, to.x - center.x);
                let turned = (angle - from) * sweep.signum();
                let turned = turned - TAU * (turned / TAU).floor();
                if turned < sweep.abs() {
                    all.push(self.at(from + turned * sweep.signum()).0);
                }
            }
            Self::Ellipse { .. } | Self::Cubic(_) | Self::Rational(..) => {
                // below 0 where it comes nearer
                let parts = |i: u32| from + (until - from) * f64::from(i) / f64::from(BRACKETS);
                let parts: Vec<f64> = (0..=BRACKETS).map(parts).collect();
                let leaves = |t: f64| {
                    let (p, slope) = self.at(t);
                    (p.x - to.x) * slope.x + (p.y - to.y) * slope.y
                };
                let signs: Vec<bool> = parts.iter().map(|&t| leaves(t) >= 0.0).collect();
                for (i, is_foot) in signs.windows(2).map(|w| !w[0] && w[1]).enumerate() {
                    if is_foot {
                        let (mut near, mut far) = (parts[i], parts[i + 1]);
                        for _ in 0..HALVINGS {
                            let middle = 0.5 * (near + far);
                            *(if leaves(middle) < 0.0 { &mut near } else { &mut far }) = middle;
                        }
                        all.push(self.at(far).0);
                    }
                }
            }
        }
        all.push(self.at(until).0);
        all
    }
}

/// Integrates a function by Gauss's rule of five places, in halves until these agree with the whole.
fn integral(of: &impl Fn(f64) -> f64, (from, to): (f64, f64)) -> f64 {
    let whole = gauss(of, (from, to));
    let size = gauss(&|t| of(t).abs(), (from, to)).abs();
    halved(of, (from, to), (whole, TOLERANCE * size), DEPTH)
}

fn halved(
    of: &impl Fn(f64) -> f64,
    (from, to): (f64, f64),
    (whole, allowed): (f64, f64),
    left: u32,
) -> f64 {
    let middle = 0.5 * (from + to);
    let [a, b] = [(from, middle), (middle, to)].map(|part| gauss(of, part));
    if left == 0 || (a + b - whole).abs() <= allowed {
        return a + b;
    }
    let allowed = 0.5 * allowed;
    halved(of, (from, middle), (a, allowed), left - 1)
        + halved(of, (middle, to), (b, allowed), left - 1)
}

/// **Source:** Abramowitz, Stegun, *Handbook of Mathematical Functions*, table 25.4.
fn gauss(of: &impl Fn(f64) -> f64, (from, to): (f64, f64)) -> f64 {
    const PLACES: [(f64, f64); 3] = [
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.906_179_845_938_664, 0.236_926_885_056_189_08),
    ];
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let [(_, center), inner, outer] = PLACES;
    let pair = |(x, w): (f64, f64)| w * (of(middle - half * x) + of(middle + half * x));
    half * (center * of(middle) + pair(inner) + pair(outer))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point {
        Point { x, y }
    }
    fn quarter() -> Shape {
        let poles = vec![p(10.0, 0.0), p(10.0, 10.0), p(0.0, 10.0)];
        let weights = vec![1.0, 0.5_f64.sqrt(), 1.0];
        Shape::Nurbs(Nurbs::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], poles, weights).unwrap())
    }
    #[test]
    fn a_rational_quarter_of_a_circle_is_as_long_as_the_arc() {
        let found = length(&[quarter()]).unwrap();
        assert!((found - 5.0 * std::f64::consts::PI).abs() < 1e-11, "{found}");
    }
    #[test]
    fn a_parabola_is_as_long_as_its_closed_form_says() {
        // y = x² from 0 to 1, as a cubic
        let third = 1.0 / 3.0;
        let curve =
            Shape::Spline(vec![p(0.0, 0.0), p(third, 0.0), p(2.0 * third, third), p(1.0, 1.0)]);
        let wanted = 0.5 * 5.0_f64.sqrt() + 0.25 * 2.0_f64.asinh();
        assert!((length(&[curve]).unwrap() - wanted).abs() < 1e-12);
    }
    #[test]
    fn an_ellipse_is_as_long_as_ramanujan_says() {
        let shape = crate::curve::ellipse(p(1.0, 2.0), p(3.0, 0.0), 2.0, 0.0, TAU);
        let found = length(&[shape]).unwrap();
        let h: f64 = 1.0 / 25.0;
        let near = std::f64::consts::PI * 5.0 * (1.0 + 3.0 * h / (10.0 + (4.0 - 3.0 * h).sqrt()));
        assert!((found - near).abs() < 1e-8 * near, "{found} {near}");
    }
    #[test]
    fn the_nearest_place_is_the_best_of_many() {
        let spline =
            Shape::Spline(spline::through(&[p(0.0, 0.0), p(4.0, 5.0), p(9.0, -2.0), p(3.0, -4.0)]));
        for (shape, to) in [
            (spline.clone(), p(5.0, 1.0)),
            (spline.clone(), p(3.0, 9.0)),
            (spline, p(-3.0, -3.0)),
            (quarter(), p(20.0, 20.0)),
            (crate::curve::ellipse(p(1.0, 2.0), p(3.0, 1.0), 1.0, 0.0, TAU), p(1.5, 2.2)),
        ] {
            let found = nearest([&shape], to).unwrap();
            let own = hypot(found.x - to.x, found.y - to.y);
            let mut best = f64::MAX;
            for stroke in strokes(&shape) {
                let (from, until) = stroke.range();
                for i in 0..=20_000 {
                    let (q, _) = stroke.at(from + (until - from) * f64::from(i) / 20_000.0);
                    best = best.min(hypot(q.x - to.x, q.y - to.y));
                }
            }
            assert!(own <= best + 1e-12 && own > best - 1e-6, "{own} {best}");
        }
    }
    #[test]
    fn what_curves_and_segments_surround_is_measured_whichever_way_they_run() {
        let legs =
            [Shape::Segment(p(0.0, 0.0), p(10.0, 0.0)), Shape::Segment(p(0.0, 0.0), p(0.0, 10.0))];
        let all = [&legs[0], &quarter(), &legs[1]];
        let found = area(all).unwrap();
        assert!((found - 25.0 * std::f64::consts::PI).abs() < 1e-10, "{found}");
        let half = Shape::Arc { center: p(5.0, 5.0), radius: 2.0, start: 1.0, sweep: -0.5 * TAU };
        let (from, to) = (
            on_ellipse(p(5.0, 5.0), p(2.0, 0.0), 1.0, 1.0),
            on_ellipse(p(5.0, 5.0), p(2.0, 0.0), 1.0, 1.0 - 0.5 * TAU),
        );
        let found = area([&half, &Shape::Segment(from, to)]).unwrap();
        assert!((found - 2.0 * std::f64::consts::PI).abs() < 1e-12, "{found}");
        assert!(area(&legs).unwrap_err().contains("no end of another"));
        assert!(area(&[Shape::Dot(p(0.0, 0.0))]).is_err());
    }
    #[test]
    fn words_have_no_length() {
        assert_eq!(length(&[Shape::Dot(p(0.0, 0.0))]), None);
        assert_eq!(nearest(&[], p(0.0, 0.0)), None);
    }

    #[test]
    fn an_outline_of_many_lines_is_followed_in_whatever_order_they_stand() {
        // a comb of 20 000 teeth: compared with each other, its ends would take minutes
        let p = |x: i32, y: i32| Point { x: f64::from(x), y: f64::from(y) };
        let n = 20_000;
        let mut places = vec![p(2 * n, 0), p(0, 0)];
        for i in 0..n {
            let (x, up) = (2 * i, 2 + i % 3);
            places.extend([p(x, up), p(x + 1, up), p(x + 1, 1), p(x + 2, 1)]);
        }
        let sides = (0..places.len()).map(|i| {
            let (from, to) = (places[i], places[(i + 1) % places.len()]);
            if i % 2 == 0 { Shape::Segment(from, to) } else { Shape::Segment(to, from) }
        });
        let mut sides: Vec<Shape> = sides.collect();
        let half = sides.len() / 2;
        sides.rotate_left(half / 3);
        sides.swap(7, half);
        let teeth: i32 = (0..n).map(|i| 2 + i % 3).sum();
        assert_eq!(area(&sides), Ok(f64::from(teeth + n)));
    }
}
