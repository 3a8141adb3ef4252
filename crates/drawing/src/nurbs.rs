//! Rational B-splines: curves by poles, each of which draws the curve as strongly as its weight says.
//!
//! **Source:** Piegl, Tiller, *The NURBS Book*, 2nd edition 1997, chapters 3 and 4.

use crate::element::Point;
use crate::spline::{self, Piece};
use base::number::hypot;

/// How far the cubic curves may be from a rational one that they stand for, as a part of how far its poles reach.
pub const TOLERANCE: f64 = 1e-6;
/// How often a piece is halved at most for that.
const HALVINGS: u32 = 10;

/// A place times its weight, and the weight.
type Weighted = [f64; 3];

/// A rational B-spline.
#[derive(Clone, PartialEq, Debug)]
pub struct Nurbs {
    degree: usize,
    knots: Vec<f64>,
    poles: Vec<Point>,
    weights: Vec<f64>,
}

impl Nurbs {
    /// Makes a curve.
    ///
    /// # Errors
    /// Says what is wrong with the numbers.
    pub fn new(
        degree: usize,
        knots: Vec<f64>,
        poles: Vec<Point>,
        weights: Vec<f64>,
    ) -> Result<Self, String> {
        let n = poles.len();
        if degree == 0 || n <= degree {
            return Err(format!("{n} poles, where a curve of degree {degree} has more than that"));
        }
        if weights.len() != n {
            return Err(format!("{} weights, where there are {n} poles", weights.len()));
        }
        if knots.len() != n + degree + 1 {
            let wanted = n + degree + 1;
            return Err(format!("{} knots, where there are to be {wanted}", knots.len()));
        }
        let is_finite = poles.iter().flat_map(|p| [p.x, p.y]).chain(knots.iter().copied());
        if !is_finite.chain(weights.iter().copied()).all(f64::is_finite) {
            return Err("a number that is not finite".into());
        }
        if weights.iter().any(|w| *w <= 0.0) {
            return Err("a weight that is not above 0".into());
        }
        if knots.windows(2).any(|w| w[0] > w[1]) || knots[degree] >= knots[n] {
            return Err("knots that do not grow".into());
        }
        // where a knot inside stands more often the curve is torn
        if knots[1..knots.len() - 1].windows(degree + 1).any(|w| w[0] >= w[degree]) {
            return Err(format!("a knot that stands more than {degree} times inside"));
        }
        Ok(Self { degree, knots, poles, weights })
    }

    /// Returns its degree.
    pub fn degree(&self) -> usize {
        self.degree
    }
    /// Returns its knots.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }
    /// Returns its poles.
    pub fn poles(&self) -> &[Point] {
        &self.poles
    }
    /// Returns the weight of each pole.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }
    /// Returns the curve with its poles where a map of the plane that keeps straight lines puts them.
    #[must_use]
    pub fn moved(&self, to: impl Fn(Point) -> Point) -> Self {
        Self { poles: self.poles.iter().map(|p| to(*p)).collect(), ..self.clone() }
    }
    /// Returns the curve with other poles and weights, as many as it has.
    #[must_use]
    pub fn with(self, poles: Vec<Point>, weights: Vec<f64>) -> Self {
        Self { poles, weights, ..self }
    }
    /// Visits its numbers.
    pub(crate) fn each_number(&mut self, visit: &mut impl FnMut(&mut f64)) {
        for pole in &mut self.poles {
            visit(&mut pole.x);
            visit(&mut pole.y);
        }
        self.weights.iter_mut().chain(&mut self.knots).for_each(visit);
    }

    /// Returns the point at a parameter, which runs from the first knot of a span to the last.
    ///
    /// ```
    /// use drawing::{Point, nurbs::Nurbs};
    /// let poles = [(1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Point { x, y });
    /// let weights = vec![1.0, 0.5_f64.sqrt(), 1.0];
    /// let knots = vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
    /// let quarter = Nurbs::new(2, knots, poles.to_vec(), weights).unwrap();
    /// let Point { x, y } = quarter.at(0.3);
    /// assert!((x.hypot(y) - 1.0).abs() < 1e-15);
    /// ```
    pub fn at(&self, t: f64) -> Point {
        let mut spans = self.spans().rev();
        let first = self.degree;
        let span = spans.find(|&k| self.knots[k] <= t).unwrap_or(first);
        self.in_span(span, t).0
    }

    /// The spans of its knots that are not empty, by their first knot.
    pub(crate) fn spans(&self) -> impl DoubleEndedIterator<Item = usize> + '_ {
        (self.degree..self.poles.len()).filter(|&k| self.knots[k] < self.knots[k + 1])
    }

    /// The point and the derivative at a parameter, by the curve of one span: the recursion of de Boor.
    pub(crate) fn in_span(&self, k: usize, t: f64) -> (Point, Point) {
        let p = self.degree;
        let weighted = |i: usize| -> Weighted {
            let (w, pole) = (self.weights[i], self.poles[i]);
            [w * pole.x, w * pole.y, w]
        };
        let mut row: Vec<Weighted> = (k - p..=k).map(weighted).collect();
        let mut slope = [0.0; 3];
        for r in 1..=p {
            if r == p {
                let by = p as f64 / (self.knots[k + 1] - self.knots[k]);
                slope = [0, 1, 2].map(|c| by * (row[p][c] - row[p - 1][c]));
            }
            for j in (r..=p).rev() {
                let i = j + k - p;
                let (from, to) = (self.knots[i], self.knots[i + p + 1 - r]);
                let part = (t - from) / (to - from);
                row[j] = [0, 1, 2].map(|c| (1.0 - part) * row[j - 1][c] + part * row[j][c]);
            }
        }
        let [x, y, w] = row[p];
        let at = Point { x: x / w, y: y / w };
        let slope =
            Point { x: (slope[0] - slope[2] * at.x) / w, y: (slope[1] - slope[2] * at.y) / w };
        (at, slope)
    }

    /// Returns the poles of cubic Bézier curves that are the curve, within [`TOLERANCE`] where it is not cubic itself.
    pub fn cubics(&self) -> Vec<Point> {
        let mut least = self.poles[0];
        let mut most = least;
        for p in &self.poles {
            least = Point { x: least.x.min(p.x), y: least.y.min(p.y) };
            most = Point { x: most.x.max(p.x), y: most.y.max(p.y) };
        }
        let allowed = TOLERANCE * hypot(most.x - least.x, most.y - least.y);
        let mut chain = Vec::new();
        for span in self.spans() {
            let ends = (self.knots[span], self.knots[span + 1]);
            if chain.is_empty() {
                chain.push(self.in_span(span, ends.0).0);
            }
            self.halved(span, ends, (allowed, HALVINGS), &mut chain);
        }
        chain
    }

    /// Adds the cubic curves for a part of a span: each has the place and the derivative of the curve at its ends.
    fn halved(
        &self,
        span: usize,
        (from, to): (f64, f64),
        (allowed, left): (f64, u32),
        chain: &mut Vec<Point>,
    ) {
        let third = (to - from) / 3.0;
        let [(a, da), (d, dd)] = [from, to].map(|t| self.in_span(span, t));
        let b = Point { x: a.x + third * da.x, y: a.y + third * da.y };
        let c = Point { x: d.x - third * dd.x, y: d.y - third * dd.y };
        let piece: Piece = [a, b, c, d];
        let is_near = |part: f64| {
            let (own, other) =
                (self.in_span(span, from + part * (to - from)).0, spline::at(piece, part));
            hypot(own.x - other.x, own.y - other.y) <= allowed
        };
        if left == 0 || [0.25, 0.5, 0.75].into_iter().all(is_near) {
            chain.extend([b, c, d]);
            return;
        }
        let middle = 0.5 * (from + to);
        self.halved(span, (from, middle), (allowed, left - 1), chain);
        self.halved(span, (middle, to), (allowed, left - 1), chain);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point {
        Point { x, y }
    }
    fn quarter() -> Nurbs {
        let weights = vec![1.0, 0.5_f64.sqrt(), 1.0];
        let poles = vec![p(10.0, 0.0), p(10.0, 10.0), p(0.0, 10.0)];
        Nurbs::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], poles, weights).unwrap()
    }
    #[test]
    fn a_quarter_of_a_circle_is_on_the_circle() {
        let quarter = quarter();
        assert_eq!((quarter.at(0.0), quarter.at(1.0)), (p(10.0, 0.0), p(0.0, 10.0)));
        for i in 0..=1000 {
            let q = quarter.at(f64::from(i) / 1000.0);
            assert!((hypot(q.x, q.y) - 10.0).abs() < 1e-12, "{i}: {q:?}");
        }
    }
    #[test]
    fn the_cubic_curves_of_a_quarter_are_within_the_tolerance() {
        let cubics = quarter().cubics();
        assert!(cubics.len() > 4 && cubics.len() < 200, "{}", cubics.len());
        for piece in spline::pieces(&cubics) {
            for i in 0..=50 {
                let q = spline::at(piece, f64::from(i) / 50.0);
                let off = (hypot(q.x, q.y) - 10.0).abs();
                assert!(off < TOLERANCE * 200.0_f64.sqrt(), "{off}");
            }
        }
    }
    #[test]
    fn a_cubic_spline_without_weights_is_one_curve_a_span() {
        let poles = vec![p(0.0, 0.0), p(1.0, 3.0), p(4.0, 3.0), p(5.0, -2.0), p(8.0, 0.0)];
        let knots: Vec<f64> = (0..9).map(f64::from).collect();
        let curve = Nurbs::new(3, knots, poles, vec![2.0; 5]).unwrap();
        let cubics = curve.cubics();
        assert_eq!(cubics.len(), 7);
        // at a knot of an even spline the poles around it count a sixth, two thirds and a sixth
        let (q, wanted) = (cubics[3], p(22.0 / 6.0, 13.0 / 6.0));
        assert!(hypot(q.x - wanted.x, q.y - wanted.y) < 1e-14, "{q:?}");
    }
    #[test]
    fn a_pole_draws_the_curve_as_strongly_as_its_weight() {
        let middle = |weight: f64| {
            let mut curve = quarter();
            curve.weights[1] = weight;
            curve.at(0.5)
        };
        // (P0 + 2 w P1 + P2) / (2 + 2 w)
        assert_eq!(middle(3.0), p(8.75, 8.75));
        assert_eq!(middle(1.0), p(7.5, 7.5));
    }
    #[test]
    fn what_is_no_curve_is_refused() {
        let poles = vec![p(0.0, 0.0), p(1.0, 1.0), p(2.0, 0.0)];
        let refused = |degree, knots: &[f64], weights: &[f64]| {
            Nurbs::new(degree, knots.to_vec(), poles.clone(), weights.to_vec()).unwrap_err()
        };
        let knots = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
        assert!(refused(3, &knots, &[1.0; 3]).contains("3 poles"));
        assert!(refused(2, &knots, &[1.0; 2]).contains("2 weights"));
        assert!(refused(2, &knots[1..], &[1.0; 3]).contains("5 knots"));
        assert!(refused(2, &knots, &[1.0, 0.0, 1.0]).contains("not above 0"));
        assert!(refused(2, &[0.0, 0.0, 1.0, 0.5, 1.0, 1.0], &[1.0; 3]).contains("grow"));
        assert!(refused(1, &[0.0, 0.0, 0.0, 1.0, 1.0], &[1.0; 3]).contains("more than 1"));
    }
}
