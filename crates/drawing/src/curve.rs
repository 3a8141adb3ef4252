//! Curves: what the writers and painters need to know of ellipses and of rings with arcs.

use crate::element::{Corner, Point, Shape};
use crate::spline;
use base::number::{atan, atan2, cos, hypot, sin, sqrt, tan};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Returns the point of an ellipse at a parameter.
pub fn on_ellipse(center: Point, major: Point, ratio: f64, at: f64) -> Point {
    let (c, s) = (cos(at), ratio * sin(at));
    Point { x: center.x + c * major.x - s * major.y, y: center.y + c * major.y + s * major.x }
}

/// Returns the parameters between the ends of an elliptic arc where it is furthest along an axis, and its ends.
pub(crate) fn extremes(major: Point, ratio: f64, start: f64, sweep: f64) -> Vec<f64> {
    let across = [atan2(-ratio * major.y, major.x), atan2(ratio * major.x, major.y)];
    let (least, most) = (start.min(start + sweep), start.max(start + sweep));
    let mut found = vec![least, most];
    for first in across {
        for half in [0.0, 0.5 * TAU] {
            let turns = ((least - first - half) / TAU).ceil();
            let at = first + half + turns * TAU;
            if at < most {
                found.push(at);
            }
        }
    }
    found
}

/// Returns what joins a corner to the next: a segment, an arc where it bends, or a Bézier curve where it has poles.
pub fn edge(from: Corner, to: Corner) -> Shape {
    if let Some([p, q]) = from.poles {
        return Shape::Spline(vec![from.at, p, q, to.at]);
    }
    let (dx, dy) = (to.at.x - from.at.x, to.at.y - from.at.y);
    let chord = hypot(dx, dy);
    if from.bulge == 0.0 || chord == 0.0 {
        return Shape::Segment(from.at, to.at);
    }
    let bulge = from.bulge;
    // the centre lies beside the middle of the chord
    let aside = (1.0 - bulge * bulge) / (4.0 * bulge);
    let center = Point {
        x: 0.5 * (from.at.x + to.at.x) - aside * dy,
        y: 0.5 * (from.at.y + to.at.y) + aside * dx,
    };
    let start = atan2(from.at.y - center.y, from.at.x - center.x);
    let radius = chord * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
    Shape::Arc { center, radius, start, sweep: 4.0 * atan(bulge) }
}

/// Returns the edges of a ring, the last one back to its first corner.
pub fn edges(ring: &[Corner]) -> impl Iterator<Item = Shape> + '_ {
    let next = ring.iter().skip(1).chain(ring.first());
    ring.iter().zip(next).map(|(&from, &to)| edge(from, to))
}

/// Whether an odd number of closed rings surrounds a point.
pub fn covers(rings: &[Vec<Corner>], p: Point) -> bool {
    rings.iter().filter(|ring| surrounds(ring, p)).count() % 2 == 1
}

/// Returns the edges of a ring; Bézier curves that follow one another are one chain.
pub fn runs(ring: &[Corner]) -> Vec<Shape> {
    let mut runs: Vec<Shape> = Vec::new();
    for edge in edges(ring) {
        match (runs.last_mut(), edge) {
            (Some(Shape::Spline(chain)), Shape::Spline(poles)) => chain.extend(&poles[1..]),
            (_, edge) => runs.push(edge),
        }
    }
    runs
}

/// Makes a ring of lines that follow one another, each whichever way it runs; nothing for words and dots.
///
/// Accuracy: an elliptic arc becomes Bézier curves within 1e-7 of its longer half axis.
pub fn ring_along(lines: &[Shape]) -> Option<Vec<Corner>> {
    let lines = lines.iter().map(corners_along).collect::<Option<Vec<_>>>()?;
    let mut ring: Vec<Corner> = Vec::new();
    for (i, line) in lines.iter().enumerate() {
        let [first, .., last] = line.as_slice() else { return None };
        let away = |p: Point, q: Point| hypot(p.x - q.x, p.y - q.y);
        let is_back = match (ring.last(), lines.get(i + 1).and_then(|l| l.first().zip(l.last()))) {
            (Some(end), _) => away(end.at, last.at) < away(end.at, first.at),
            (None, Some((a, b))) => {
                let to_next = |p: Point| away(p, a.at).min(away(p, b.at));
                to_next(first.at) < to_next(last.at)
            }
            (None, None) => false,
        };
        ring.pop();
        match is_back {
            true => ring.extend(backwards(line)),
            false => ring.extend(line),
        }
    }
    // the last corner is the first
    ring.pop();
    Some(ring)
}

/// Returns where a line begins and ends; nothing for words, dots and regions.
pub fn ends(line: &Shape) -> Option<[Point; 2]> {
    let corners = corners_along(line)?;
    Some([corners.first()?.at, corners.last()?.at])
}

/// Returns the corners along a line, the last where it ends; nothing for words, dots and regions.
///
/// Accuracy: an elliptic arc becomes Bézier curves within 1e-7 of its longer half axis.
pub fn corners_along(line: &Shape) -> Option<Vec<Corner>> {
    let arc = |center: Point, radius: f64, (start, sweep): (f64, f64)| -> Vec<Corner> {
        let at = |part: f64| Point {
            x: center.x + radius * cos(start + part * sweep),
            y: center.y + radius * sin(start + part * sweep),
        };
        let bulge = tan(0.125 * sweep);
        vec![Corner::new(at(0.0), bulge), Corner::new(at(0.5), bulge), Corner::new(at(1.0), 0.0)]
    };
    let straight = |points: &[Point]| points.iter().map(|&p| Corner::new(p, 0.0)).collect();
    Some(match line {
        Shape::Segment(p, q) => straight(&[*p, *q]),
        Shape::Polyline { points, closed } => {
            let back = points.first().filter(|_| *closed);
            straight(&points.iter().chain(back).copied().collect::<Vec<_>>())
        }
        Shape::Circle { center, radius } => arc(*center, *radius, (0.0, TAU)),
        Shape::Arc { center, radius, start, sweep } => arc(*center, *radius, (*start, *sweep)),
        Shape::Ellipse { center, major, ratio, start, sweep } => {
            along_poles(&ellipse_poles((*center, *major, *ratio), (*start, *sweep)))
        }
        Shape::Spline(poles) => along_poles(poles),
        Shape::Nurbs(curve) => along_poles(&curve.cubics()),
        Shape::Dot(_) | Shape::Text { .. } | Shape::Region(_) => return None,
    })
}

fn along_poles(poles: &[Point]) -> Vec<Corner> {
    let mut corners: Vec<Corner> = spline::pieces(poles)
        .map(|[at, p, q, _]| Corner { at, bulge: 0.0, poles: Some([p, q]) })
        .collect();
    corners.extend(poles.last().map(|&at| Corner::new(at, 0.0)));
    corners
}

/// Returns the poles of Bézier curves along an elliptic arc, each for a sixteenth of a turn at most.
fn ellipse_poles(
    (center, major, ratio): (Point, Point, f64),
    (start, sweep): (f64, f64),
) -> Vec<Point> {
    let parts = (16.0 * sweep.abs() / TAU).ceil().max(1.0);
    let step = sweep / parts;
    let reach = 4.0 / 3.0 * tan(0.25 * step);
    let mut poles = vec![on_ellipse(center, major, ratio, start)];
    for i in 0..parts as u32 {
        let ends = [f64::from(i), f64::from(i + 1)].map(|i| start + i * step);
        let [p, q] = ends.map(|t| on_ellipse(center, major, ratio, t));
        // a quarter turn further is the derivative
        let zero = Point { x: 0.0, y: 0.0 };
        let [u, v] = ends.map(|t| on_ellipse(zero, major, ratio, t + FRAC_PI_2));
        poles.push(Point { x: p.x + reach * u.x, y: p.y + reach * u.y });
        poles.push(Point { x: q.x - reach * v.x, y: q.y - reach * v.y });
        poles.push(q);
    }
    poles
}

/// Returns the corners of a line the other way round.
fn backwards(line: &[Corner]) -> Vec<Corner> {
    let before = line.iter().rev().skip(1).map(|c| (-c.bulge, c.poles.map(|[p, q]| [q, p])));
    let before = before.chain([(0.0, None)]);
    let turned = line.iter().rev().zip(before);
    // a straight edge keeps its zero: negative zero is nowhere
    turned.map(|(c, (bulge, poles))| Corner { at: c.at, bulge: bulge + 0.0, poles }).collect()
}

/// Whether a ring surrounds a point: its chords do, or an arc bulges over the point; not both.
fn surrounds(ring: &[Corner], p: Point) -> bool {
    /// A Bézier curve counts as so many chords.
    const CHORDS: u32 = 32;
    let next = ring.iter().skip(1).chain(ring.first());
    ring.iter().zip(next).fold(false, |inside, (from, to)| {
        if let Some([q, r]) = from.poles {
            let piece = [from.at, q, r, to.at];
            let at = |i| spline::at(piece, f64::from(i) / f64::from(CHORDS));
            let chords: Vec<Corner> = (0..=CHORDS).map(|i| Corner::new(at(i), 0.0)).collect();
            // the way back along the chord of the ends crosses what the chord itself does
            let ends = [*from, *to].map(|c| Corner::new(c.at, 0.0));
            return inside ^ surrounds(&chords, p) ^ surrounds_by_chord(ends, p);
        }
        let left = left_of([*from, *to], p);
        let is_crossed = surrounds_by_chord([*from, *to], p);
        // what turns to the left lies to the right of its chord
        let is_under = match edge(*from, *to) {
            Shape::Arc { center, radius, .. } => {
                left * from.bulge < 0.0 && hypot(p.x - center.x, p.y - center.y) < radius
            }
            _ => false,
        };
        inside ^ is_crossed ^ is_under
    })
}

/// Whether a chord lies between a point and what is far to its right.
fn surrounds_by_chord([from, to]: [Corner; 2], p: Point) -> bool {
    let (a, b) = (from.at, to.at);
    (a.y > p.y) != (b.y > p.y) && (left_of([from, to], p) > 0.0) == (b.y > a.y)
}

/// Positive where a point lies to the left of a chord: twice the area between them.
fn left_of([from, to]: [Corner; 2], p: Point) -> f64 {
    let (a, b) = (from.at, to.at);
    (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)
}

/// Returns the longer half axis, the ratio and the parameters of an arc from any two half axes at a right angle: the
/// first as a direction, the second as a length to its left.
pub fn ellipse(center: Point, first: Point, second: f64, start: f64, sweep: f64) -> Shape {
    let length = hypot(first.x, first.y);
    if second.abs() <= length {
        let ratio = if length > 0.0 { second / length } else { 1.0 };
        return upright(center, first, ratio, start, sweep);
    }
    let k = second / length.max(f64::MIN_POSITIVE);
    let major = Point { x: -k * first.y, y: k * first.x };
    upright(center, major, length / second, start - FRAC_PI_2, sweep)
}

/// Turns an ellipse round whose shorter half axis lies to the right.
fn upright(center: Point, major: Point, ratio: f64, start: f64, sweep: f64) -> Shape {
    let turn = if ratio < 0.0 { -1.0 } else { 1.0 };
    Shape::Ellipse { center, major, ratio: ratio.abs(), start: turn * start, sweep: turn * sweep }
}

/// Returns how long the longer half axis is.
pub fn half_axis(major: Point) -> f64 {
    sqrt(major.x * major.x + major.y * major.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point {
        Point { x, y }
    }
    #[test]
    fn half_a_circle_bends_by_one() {
        let Shape::Arc { center, radius, start, sweep } =
            edge(Corner::new(p(1.0, 0.0), 1.0), Corner::new(p(-1.0, 0.0), 0.0))
        else {
            panic!("an arc")
        };
        assert_eq!((center, radius, start), (p(0.0, 0.0), 1.0, 0.0));
        assert!((sweep - 0.5 * TAU).abs() < 1e-15);
    }
    #[test]
    fn a_quarter_to_the_right_has_its_centre_there() {
        let bulge = -(std::f64::consts::SQRT_2 - 1.0);
        let shape = edge(Corner::new(p(0.0, 1.0), bulge), Corner::new(p(1.0, 0.0), 0.0));
        let Shape::Arc { center, radius, sweep, .. } = shape else { panic!("an arc") };
        assert!(center.x.abs() < 1e-15 && center.y.abs() < 1e-15 && (radius - 1.0).abs() < 1e-15);
        assert!((sweep + 0.25 * TAU).abs() < 1e-15);
    }
    #[test]
    fn the_longer_axis_of_an_ellipse_comes_first() {
        let shape = ellipse(p(0.0, 0.0), p(1.0, 0.0), 2.0, 0.0, TAU);
        let Shape::Ellipse { center, major, ratio, start, .. } = shape else { panic!("one") };
        assert_eq!((major, ratio), (p(0.0, 2.0), 0.5));
        let at = on_ellipse(center, major, ratio, start);
        assert!((at.x - 1.0).abs() < 1e-15 && at.y.abs() < 1e-15, "{at:?}");
    }
    #[test]
    fn rings_with_arcs_cover_what_lies_between_them() {
        let corner = |x, y, bulge| Corner::new(p(x, y), bulge);
        // a box whose right side bulges out by a half turn, and whose left side bulges in
        let outer = vec![
            corner(0.0, 0.0, 0.0),
            corner(10.0, 0.0, 1.0),
            corner(10.0, 4.0, 0.0),
            corner(0.0, 4.0, -1.0),
        ];
        let hole = vec![corner(4.0, 2.0, 1.0), corner(6.0, 2.0, 1.0)];
        let rings = [outer, hole];
        for (x, y, wanted) in [
            (8.0, 2.0, true),
            (11.5, 2.0, true),
            (12.5, 2.0, false),
            (1.0, 2.0, false),
            (1.0, 0.2, true),
            (5.0, 2.5, false),
            (5.0, 3.5, true),
            (-1.0, 2.0, false),
        ] {
            assert_eq!(covers(&rings, p(x, y)), wanted, "{x}, {y}");
        }
    }
}
