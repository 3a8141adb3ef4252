//! Bounds: the smallest upright box around a drawing.

use crate::curve;
use crate::element::{Drawing, Element, Lie, Placement, Point, Shape, Vertical};
use crate::{metrics, spline};
use base::number::{cos, sin};
use std::f64::consts::{FRAC_PI_2, TAU};

/// An upright box, not empty.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bounds {
    /// The corner with the smallest coordinates.
    pub least: Point,
    /// The corner with the largest coordinates.
    pub most: Point,
}

impl Bounds {
    /// Returns the box that holds one point.
    pub fn at(p: Point) -> Self {
        Self { least: p, most: p }
    }
    /// Returns the smallest box that holds this one and a point.
    #[must_use]
    pub fn with(self, p: Point) -> Self {
        Self {
            least: Point { x: self.least.x.min(p.x), y: self.least.y.min(p.y) },
            most: Point { x: self.most.x.max(p.x), y: self.most.y.max(p.y) },
        }
    }
    /// Returns how wide the box is.
    pub fn width(self) -> f64 {
        self.most.x - self.least.x
    }
    /// Returns how high the box is.
    pub fn height(self) -> f64 {
        self.most.y - self.least.y
    }
}

/// Returns the smallest box around a drawing; nothing if it is empty.
///
/// Exact for segments, circles and arcs, within [`crate::nurbs::TOLERANCE`] for rational splines; line widths are not counted. What has a constant size on
/// the screen counts as the point where it lies; words on the sheet are as large as
/// [`metrics`] says.
///
/// ```
/// use drawing::{Drawing, Element, Point, Shape, bounds};
/// let center = Point { x: 1.0, y: 2.0 };
/// let circle = Element::new(Shape::Circle { center, radius: 3.0 });
/// let b = bounds(&Drawing { elements: vec![circle], ..Drawing::default() }).unwrap();
/// assert_eq!((b.least.x, b.most.y, b.width()), (-2.0, 5.0, 6.0));
/// ```
pub fn bounds(drawing: &Drawing) -> Option<Bounds> {
    bounds_of(&drawing.elements, drawing.vertical)
}

/// Returns the smallest box around some elements of a drawing, as [`fn@bounds`] does around all.
pub fn bounds_of<'e>(
    elements: impl IntoIterator<Item = &'e Element>,
    vertical: Vertical,
) -> Option<Bounds> {
    let mut all: Option<Bounds> = None;
    for element in elements {
        corners(element, vertical, &mut |p| {
            all = Some(all.map_or(Bounds::at(p), |b| b.with(p)));
        });
    }
    all
}

/// Names points whose smallest box is the element's.
fn corners(element: &Element, vertical: Vertical, say: &mut dyn FnMut(Point)) {
    match &element.shape {
        Shape::Dot(p) => say(*p),
        Shape::Segment(p, q) => [*p, *q].into_iter().for_each(say),
        Shape::Polyline { points, .. } => points.iter().copied().for_each(say),
        Shape::Circle { center, radius } => {
            say(Point { x: center.x - radius, y: center.y - radius });
            say(Point { x: center.x + radius, y: center.y + radius });
        }
        Shape::Arc { center, radius, start, sweep } => {
            arc_corners(*center, *radius, *start, *sweep, say);
        }
        Shape::Ellipse { center, major, ratio, start, sweep } => {
            let extremes = curve::extremes(*major, *ratio, *start, *sweep).into_iter();
            extremes.map(|at| curve::on_ellipse(*center, *major, *ratio, at)).for_each(say);
        }
        Shape::Spline(poles) => spline_corners(poles, say),
        Shape::Nurbs(curve) => spline_corners(&curve.cubics(), say),
        Shape::Region(rings) => {
            for shape in rings.iter().flat_map(|ring| curve::edges(ring)) {
                corners(&Element::new(shape), vertical, say);
            }
        }
        Shape::Text { at, text, anchoring, placement, turn } => match placement {
            Placement::OnScreen(_) => say(*at),
            Placement::OnSheet(size) => {
                let width = metrics::text_width(text, *size);
                let (left, down) =
                    anchoring.start(text, *size, Lie { at: *at, turn: *turn, vertical });
                let lines_below = text.split('\n').count() as f64 - 1.0;
                let above = metrics::ASCENT * size - down;
                let below = down + (metrics::DESCENT + lines_below * metrics::LINE_HEIGHT) * size;
                let (top, bottom) = match vertical {
                    Vertical::Up => (above, -below),
                    Vertical::Down => (-above, below),
                };
                let (c, s) = (cos(*turn), sin(*turn));
                for (x, y) in [left, left + width].into_iter().flat_map(|x| [(x, top), (x, bottom)])
                {
                    say(Point { x: at.x + x * c - y * s, y: at.y + x * s + y * c });
                }
            }
        },
    }
}

/// Names the ends of Bézier curves, and where they are furthest along an axis.
fn spline_corners(poles: &[Point], say: &mut dyn FnMut(Point)) {
    for piece in spline::pieces(poles) {
        say(piece[0]);
        say(piece[3]);
        spline::extremes(piece).map(|t| spline::at(piece, t)).for_each(&mut *say);
    }
}

/// Names the ends of an arc, and the quarter points that it passes.
fn arc_corners(center: Point, radius: f64, start: f64, sweep: f64, say: &mut dyn FnMut(Point)) {
    say(point_on_circle(center, radius, start));
    say(point_on_circle(center, radius, start + sweep));
    let quarters = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
    for (k, (x, y)) in quarters.into_iter().enumerate() {
        let from_start = k as f64 * FRAC_PI_2 - start;
        let turn = if sweep >= 0.0 { from_start } else { -from_start };
        if turn.rem_euclid(TAU) <= sweep.abs() {
            say(Point { x: center.x + radius * x, y: center.y + radius * y });
        }
    }
}

/// Returns the point of a circle at an angle, in radians from the x axis towards the y axis.
pub fn point_on_circle(center: Point, radius: f64, angle: f64) -> Point {
    Point { x: center.x + radius * cos(angle), y: center.y + radius * sin(angle) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn of(shape: Shape) -> Option<Bounds> {
        bounds(&Drawing { elements: vec![Element::new(shape)], ..Drawing::default() })
    }
    fn near(b: Bounds, expected: [f64; 4]) {
        let found = [b.least.x, b.least.y, b.most.x, b.most.y];
        for (a, e) in found.into_iter().zip(expected) {
            assert!((a - e).abs() < 1e-12, "{found:?} is not {expected:?}");
        }
    }
    const ORIGIN: Point = Point { x: 0.0, y: 0.0 };

    #[test]
    fn nothing_has_no_bounds() {
        assert_eq!(bounds(&Drawing::default()), None);
        assert_eq!(of(Shape::Polyline { points: Vec::new(), closed: true }), None);
    }
    #[test]
    fn a_quarter_arc_does_not_reach_the_other_side() {
        let arc = |start, sweep| Shape::Arc { center: ORIGIN, radius: 2.0, start, sweep };
        near(of(arc(0.0, FRAC_PI_2)).unwrap(), [0.0, 0.0, 2.0, 2.0]);
        near(of(arc(FRAC_PI_2, -FRAC_PI_2)).unwrap(), [0.0, 0.0, 2.0, 2.0]);
    }
    #[test]
    fn an_arc_over_the_top_reaches_it() {
        let h = 2.0 * sin(PI / 4.0);
        let arc = Shape::Arc { center: ORIGIN, radius: 2.0, start: PI / 4.0, sweep: FRAC_PI_2 };
        near(of(arc).unwrap(), [-h, h, h, 2.0]);
        let back = Shape::Arc { center: ORIGIN, radius: 2.0, start: -PI / 4.0, sweep: -1.5 * PI };
        near(of(back).unwrap(), [-2.0, -2.0, h, 2.0]);
    }
    #[test]
    fn words_on_the_screen_count_as_a_point() {
        let text = |placement| Shape::Text {
            at: ORIGIN,
            text: "MM".into(),
            anchoring: crate::Anchoring::Middle,
            placement,
            turn: 0.0,
        };
        near(of(text(Placement::OnScreen(12.0))).unwrap(), [0.0; 4]);
        near(of(text(Placement::OnSheet(10.0))).unwrap(), [-8.33, -2.07, 8.33, 7.18]);
        let centered = Shape::Text {
            at: ORIGIN,
            text: "MM\nM".into(),
            anchoring: crate::Anchoring::Center,
            placement: Placement::OnSheet(10.0),
            turn: 0.0,
        };
        // the capitals reach as far up as the last base line lies below
        near(of(centered).unwrap(), [-8.33, -9.59 - 2.07, 8.33, 9.59]);
        let mut upright = text(Placement::OnSheet(10.0));
        if let Shape::Text { turn, .. } = &mut upright {
            *turn = FRAC_PI_2;
        }
        near(of(upright).unwrap(), [-7.18, -8.33, 2.07, 8.33]);
    }
    #[test]
    fn words_beyond_a_place_lie_nowhere_across() {
        for vertical in [Vertical::Up, Vertical::Down] {
            for (step, turn) in (0..24).zip([0.0, 0.4].into_iter().cycle()) {
                let angle = f64::from(step) * PI / 12.0;
                let (x, y) = (cos(angle), sin(angle));
                let text = |turn, anchoring| {
                    let (text, placement) = (String::from("750 mV"), Placement::OnSheet(10.0));
                    let at = Point { x: 20.0 * x, y: 20.0 * y };
                    let shape = Shape::Text { at, text, anchoring, placement, turn };
                    let mut corners = Vec::new();
                    super::corners(&Element::new(shape), vertical, &mut |p| corners.push(p));
                    // how far its nearest corner is beyond the line across; letters may reach below their base line
                    corners.into_iter().map(|p| p.x * x + p.y * y).fold(f64::INFINITY, f64::min)
                };
                let away = text(turn, crate::Anchoring::Away(ORIGIN));
                assert!((20.0..=23.5 + 1e-9).contains(&away), "{away} at {angle} and {turn}");
            }
        }
    }
}
