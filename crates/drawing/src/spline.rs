//! Splines: chains of cubic Bézier curves, and the smooth curve through places.

use crate::element::Point;
use base::number::{hypot, sqrt};

/// The four poles of a cubic Bézier curve.
pub type Piece = [Point; 4];

/// Returns the curves of a chain; poles that make no whole curve are left out.
pub fn pieces(poles: &[Point]) -> impl Iterator<Item = Piece> + '_ {
    let n = poles.len().saturating_sub(1) / 3;
    (0..n).map(|i| [0, 1, 2, 3].map(|k| poles[3 * i + k]))
}

/// Returns the knots of a chain as a B-spline: each between two of its curves stands three times.
pub(crate) fn knots(poles: &[Point]) -> Vec<f64> {
    let n = pieces(poles).count();
    let times = |knot| if knot == 0 || knot == n { 4 } else { 3 };
    (0..=n).flat_map(|knot| vec![knot as f64; times(knot)]).collect()
}

/// Returns the point of a curve at a parameter from 0 to 1.
pub fn at(piece: Piece, t: f64) -> Point {
    let s = 1.0 - t;
    let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
    let sum = |of: fn(Point) -> f64| {
        let [a, b, c, d] = piece.map(of);
        weights[0] * a + weights[1] * b + weights[2] * c + weights[3] * d
    };
    Point { x: sum(|p| p.x), y: sum(|p| p.y) }
}

/// Returns the parameters between the ends of a curve where it is furthest along an axis.
pub(crate) fn extremes(piece: Piece) -> impl Iterator<Item = f64> {
    let along = |of: fn(Point) -> f64| {
        let [a, b, c, d] = piece.map(of);
        // a third of the derivative is p t² + q t + r
        let (p, q, r) = (d - 3.0 * c + 3.0 * b - a, 2.0 * (c - 2.0 * b + a), b - a);
        let under = q * q - 4.0 * p * r;
        if under < 0.0 {
            return [f64::NAN; 2];
        }
        // the root without cancellation, and the other one by their product
        let far = -0.5 * (q + if q < 0.0 { -sqrt(under) } else { sqrt(under) });
        [far / p, r / far]
    };
    let both = [along(|p| p.x), along(|p| p.y)].concat();
    both.into_iter().filter(|t| 0.0 < *t && *t < 1.0)
}

/// Returns the poles of the natural cubic spline through places, its parameter the length of the chords: its first and
/// second derivative are continuous, and at its ends it does not bend.
///
/// **Source:** de Boor, *A Practical Guide to Splines*, 1978, chapter IV.
///
/// ```
/// use drawing::{Point, spline};
/// let places = [(0.0, 0.0), (3.0, 4.0), (6.0, 0.0)].map(|(x, y)| Point { x, y });
/// let poles = spline::through(&places);
/// assert_eq!((poles.len(), poles[3]), (7, places[1]));
/// // level at the top, by symmetry
/// assert!((poles[2].y - 4.0).abs() < 1e-15 && (poles[4].y - 4.0).abs() < 1e-15);
/// ```
pub fn through(places: &[Point]) -> Vec<Point> {
    let mut places = places.to_vec();
    places.dedup();
    let n = places.len();
    if n < 2 {
        return places;
    }
    let chords: Vec<f64> =
        places.windows(2).map(|w| hypot(w[1].x - w[0].x, w[1].y - w[0].y)).collect();
    let slopes = [bent(&places, &chords, |p| p.x), bent(&places, &chords, |p| p.y)];
    let mut poles = vec![places[0]];
    for (i, &h) in chords.iter().enumerate() {
        let third = |k: usize, sign: f64| Point {
            x: places[k].x + sign * h / 3.0 * slopes[0][k],
            y: places[k].y + sign * h / 3.0 * slopes[1][k],
        };
        poles.extend([third(i, 1.0), third(i + 1, -1.0), places[i + 1]]);
    }
    poles
}

/// Returns the derivatives of one coordinate of the natural spline at its places.
fn bent(places: &[Point], chords: &[f64], of: fn(Point) -> f64) -> Vec<f64> {
    let n = places.len();
    let steep: Vec<f64> =
        (0..n - 1).map(|i| (of(places[i + 1]) - of(places[i])) / chords[i]).collect();
    // rows (below, own, above | wanted), eliminated on the way down; at the ends the second derivative is 0
    let mut above = vec![0.0; n];
    let mut wanted = vec![0.0; n];
    for i in 0..n {
        let (below, own, next, value) = match i {
            0 => (0.0, 2.0, 1.0, 3.0 * steep[0]),
            i if i == n - 1 => (1.0, 2.0, 0.0, 3.0 * steep[n - 2]),
            i => {
                let (h, k) = (chords[i - 1], chords[i]);
                (k, 2.0 * (h + k), h, 3.0 * (k * steep[i - 1] + h * steep[i]))
            }
        };
        let (before, solved) = if i == 0 { (0.0, 0.0) } else { (above[i - 1], wanted[i - 1]) };
        let pivot = own - below * before;
        above[i] = next / pivot;
        wanted[i] = (value - below * solved) / pivot;
    }
    for i in (0..n - 1).rev() {
        wanted[i] -= above[i] * wanted[i + 1];
    }
    wanted
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point {
        Point { x, y }
    }
    #[test]
    fn places_in_a_line_give_the_line() {
        let places = [p(0.0, 0.0), p(1.0, 2.0), p(4.0, 8.0)];
        for (i, q) in through(&places).into_iter().enumerate() {
            assert!((q.y - 2.0 * q.x).abs() < 1e-14, "{i}: {q:?}");
        }
    }
    #[test]
    fn the_second_derivative_goes_on_and_ends_at_nothing() {
        let places = [p(0.0, 0.0), p(2.0, 3.0), p(3.0, -1.0), p(7.0, 0.5), p(7.0, 4.0)];
        let poles = through(&places);
        let chords: Vec<f64> =
            places.windows(2).map(|w| hypot(w[1].x - w[0].x, w[1].y - w[0].y)).collect();
        let all: Vec<Piece> = pieces(&poles).collect();
        let second = |q: [f64; 3], h: f64| 6.0 * (q[0] - 2.0 * q[1] + q[2]) / (h * h);
        let begins = |i: usize| second([all[i][0].y, all[i][1].y, all[i][2].y], chords[i]);
        let ends = |i: usize| second([all[i][1].y, all[i][2].y, all[i][3].y], chords[i]);
        assert!(begins(0).abs() < 1e-12 && ends(3).abs() < 1e-12);
        for i in 0..3 {
            assert!((ends(i) - begins(i + 1)).abs() < 1e-12, "{i}");
        }
    }
    #[test]
    fn a_curve_is_furthest_where_its_derivative_is_nothing() {
        let piece = [p(0.0, 0.0), p(1.0, 4.0), p(2.0, 4.0), p(3.0, 0.0)];
        let found: Vec<f64> = extremes(piece).collect();
        assert_eq!(found, [0.5]);
        assert_eq!(at(piece, 0.5), p(1.5, 3.0));
    }
}
