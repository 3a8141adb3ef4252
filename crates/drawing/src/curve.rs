//! Curves: what the writers and painters need to know of ellipses and of rings with arcs.

use crate::element::{Corner, Point, Shape};
use base::number::{atan, atan2, cos, hypot, sin, sqrt};
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

/// Returns what joins a corner to the next: a segment, or an arc where it bends.
pub fn edge(from: Corner, to: Corner) -> Shape {
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

/// Whether a ring surrounds a point: its chords do, or an arc bulges over the point; not both.
fn surrounds(ring: &[Corner], p: Point) -> bool {
    let next = ring.iter().skip(1).chain(ring.first());
    ring.iter().zip(next).fold(false, |inside, (from, to)| {
        let (a, b) = (from.at, to.at);
        let left = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        let is_crossed = (a.y > p.y) != (b.y > p.y) && (left > 0.0) == (b.y > a.y);
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
            edge(Corner { at: p(1.0, 0.0), bulge: 1.0 }, Corner { at: p(-1.0, 0.0), bulge: 0.0 })
        else {
            panic!("an arc")
        };
        assert_eq!((center, radius, start), (p(0.0, 0.0), 1.0, 0.0));
        assert!((sweep - 0.5 * TAU).abs() < 1e-15);
    }
    #[test]
    fn a_quarter_to_the_right_has_its_centre_there() {
        let bulge = -(std::f64::consts::SQRT_2 - 1.0);
        let shape = edge(Corner { at: p(0.0, 1.0), bulge }, Corner { at: p(1.0, 0.0), bulge: 0.0 });
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
        let corner = |x, y, bulge| Corner { at: p(x, y), bulge };
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
