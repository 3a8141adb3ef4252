//! The picture of a plot: axes with round numbers, curves, a legend; in pixels, `y` down.
//!
//! Where a plot has loci and no curves, these are drawn to one scale.

use super::{Axis, Plot};
use base::number::significant;
use drawing::{
    Anchoring, Color, Drawing, Element, Layer, Line, Placement, Point, Shape, Style, Vertical,
};

/// The height of letters, in pixels.
const LETTERS: f64 = 11.0;
/// What a mark on an axis takes at least of its length, in pixels.
const APART: (f64, f64) = (84.0, 36.0);
/// Free space beside the axes: left, top, right, bottom, in pixels.
const SPACE: [f64; 4] = [64.0, 26.0, 18.0, 38.0];
/// The colours of curves; beyond the first they come with lines of their own as well.
const COLORS: [&str; 4] = ["", "#3d9247", "#9a5bb8", "#b8860b"];
const LINES: [Line; 4] = [Line::Solid, Line::Dashed, Line::Chained, Line::Dotted];

/// The part of the plane that a chart shows, and how large.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Frame {
    /// Its width and height in pixels.
    pub size: (f64, f64),
    /// The least and the greatest number along it.
    pub x: (f64, f64),
    /// The least and the greatest number up it.
    pub y: (f64, f64),
}

/// Returns the stretches of points that have values, each of two at least.
pub(super) fn runs(points: &[Option<(f64, f64)>]) -> Vec<Vec<(f64, f64)>> {
    let runs = points.split(Option::is_none).map(|run| run.iter().copied().flatten().collect());
    runs.filter(|run: &Vec<(f64, f64)>| run.len() > 1).collect()
}

/// Returns a range that holds some numbers and a little more.
fn around(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    let range = numbers.fold(None, |range, x| match range {
        None => Some((x, x)),
        Some((least, most)) => Some((x.min(least), x.max(most))),
    });
    let (least, most): (f64, f64) = range.unwrap_or((0.0, 1.0));
    let wide = most - least;
    let size = least.abs().max(most.abs());
    // what is the same all along is drawn as such, whatever its last digit does
    let more = match size {
        0.0 => 1.0,
        size if wide > 1e-9 * size => 0.04 * wide,
        size => 0.1 * size,
    };
    (least - more, most + more)
}

/// Returns the round numbers of a range that lie so far apart at least.
fn marks((least, most): (f64, f64), apart: f64) -> Vec<f64> {
    if !(apart.is_finite() && apart > 0.0 && (most - least) / apart < 1000.0) {
        return Vec::new();
    }
    let exponent = format!("{apart:e}");
    let exponent = exponent.rsplit('e').next().unwrap_or("0").to_string();
    let ten: f64 = format!("1e{exponent}").parse().unwrap_or(1.0);
    let steps = [1.0, 2.0, 5.0, 10.0].map(|part| part * ten);
    let step = steps.into_iter().find(|step| *step >= apart).unwrap_or(10.0 * ten);
    let first = (least / step).ceil();
    let count = ((most / step).floor() - first).max(-1.0) + 1.0;
    (0..count as u32).map(|i| (first + f64::from(i)) * step).collect()
}

impl Frame {
    /// Returns the frame that holds all of a plot.
    pub fn of(plot: &Plot, size: (f64, f64)) -> Self {
        let points = || plot.shown().flat_map(|(_, points)| points.iter().flatten());
        let mut frame =
            Self { size, x: around(points().map(|p| p.0)), y: around(points().map(|p| p.1)) };
        if plot.curves.is_empty() {
            frame.even();
        }
        frame
    }
    /// Widens one of the ranges until both are to one scale.
    fn even(&mut self) {
        let (wide, high) = self.inner();
        let per_pixel = ((self.x.1 - self.x.0) / wide).max((self.y.1 - self.y.0) / high);
        for (range, pixels) in [(&mut self.x, wide), (&mut self.y, high)] {
            let more = 0.5 * (per_pixel * pixels - (range.1 - range.0));
            *range = (range.0 - more, range.1 + more);
        }
    }
    /// The width and height between the axes, in pixels.
    fn inner(&self) -> (f64, f64) {
        let [left, top, right, bottom] = SPACE;
        ((self.size.0 - left - right).max(1.0), (self.size.1 - top - bottom).max(1.0))
    }
    /// Returns where two numbers stand, in pixels from the left and the top.
    pub fn place(&self, (x, y): (f64, f64)) -> Point {
        let (wide, high) = self.inner();
        Point {
            x: SPACE[0] + wide * (x - self.x.0) / (self.x.1 - self.x.0),
            y: SPACE[1] + high * (self.y.1 - y) / (self.y.1 - self.y.0),
        }
    }
    /// Returns the numbers that stand at a place.
    pub fn numbers(&self, at: Point) -> (f64, f64) {
        let (wide, high) = self.inner();
        let x = self.x.0 + (self.x.1 - self.x.0) * (at.x - SPACE[0]) / wide;
        let y = self.y.1 - (self.y.1 - self.y.0) * (at.y - SPACE[1]) / high;
        (x, y)
    }
    /// Returns the frame that shows a factor more, with what is at a place where it is.
    #[must_use]
    pub fn zoomed(&self, factor: f64, at: Point) -> Self {
        let (x, y) = self.numbers(at);
        let wider = |range: (f64, f64), at: f64| {
            (at + factor * (range.0 - at), at + factor * (range.1 - at))
        };
        Self { size: self.size, x: wider(self.x, x), y: wider(self.y, y) }
    }
    /// Returns the frame shifted so that what is at one place comes to another.
    #[must_use]
    pub fn shifted(&self, from: Point, to: Point) -> Self {
        let ((x0, y0), (x1, y1)) = (self.numbers(from), self.numbers(to));
        let by = |range: (f64, f64), d: f64| (range.0 + d, range.1 + d);
        Self { size: self.size, x: by(self.x, x0 - x1), y: by(self.y, y0 - y1) }
    }
    /// Returns the part of a segment inside the axes, in pixels; nothing where none is.
    fn clipped(&self, a: Point, b: Point) -> Option<(Point, Point)> {
        let [left, top, ..] = SPACE;
        let (wide, high) = self.inner();
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        let sides =
            [(-dx, a.x - left), (dx, left + wide - a.x), (-dy, a.y - top), (dy, top + high - a.y)];
        for (p, q) in sides {
            if p == 0.0 && q < 0.0 {
                return None;
            }
            if p < 0.0 {
                from = from.max(q / p);
            } else if p > 0.0 {
                to = to.min(q / p);
            }
        }
        let at = |t: f64| Point { x: a.x + t * dx, y: a.y + t * dy };
        (from < to).then(|| (at(from), at(to)))
    }
}

impl Plot {
    /// What a chart shows: the curves, or the loci where there are none.
    fn shown(&self) -> impl Iterator<Item = (String, &[Option<(f64, f64)>])> {
        let no_curves = self.curves.is_empty();
        let curves = self.curves.iter().map(|c| (c.axis.in_words(), &c.points[..]));
        let loci = self.loci.iter().filter(move |_| no_curves);
        curves.chain(loci.map(|l| (l.label.clone(), &l.points[..])))
    }
    /// Returns the point of what is shown that is nearest to a place, and which curve it is of.
    pub fn nearest(&self, frame: &Frame, at: Point) -> Option<(usize, (f64, f64))> {
        let all = self.shown().enumerate().flat_map(|(which, (_, points))| {
            points.iter().flatten().map(move |p| (which, *p)).collect::<Vec<_>>()
        });
        let distance = |p: &(f64, f64)| {
            let there = frame.place(*p);
            base::number::hypot(there.x - at.x, there.y - at.y)
        };
        all.min_by(|a, b| distance(&a.1).total_cmp(&distance(&b.1)))
    }
    /// Says where a point of what is shown lies.
    pub fn in_words(&self, (which, (x, y)): (usize, (f64, f64))) -> String {
        let number = |x: f64, unit: &str| match unit {
            "" => significant(x, 6),
            unit => format!("{} {unit}", significant(x, 6)),
        };
        match (self.curves.get(which), self.loci.get(which)) {
            (Some(curve), _) => format!(
                "{} = {}, {} = {}",
                self.over.label,
                number(x, &self.over.unit),
                curve.axis.label,
                number(y, &curve.axis.unit)
            ),
            (None, Some(locus)) => {
                format!("{} = ({}, {})", locus.label, significant(x, 6), significant(y, 6))
            }
            (None, None) => String::new(),
        }
    }
    /// Draws it in a frame.
    pub fn chart(&self, frame: &Frame) -> Drawing {
        let mut elements = Vec::new();
        axes(&mut elements, frame);
        let mut legend = SPACE[0] + 4.0;
        for (i, (label, points)) in self.shown().enumerate() {
            let style = style_of(i);
            for run in runs(points) {
                let places: Vec<Point> = run.iter().map(|p| frame.place(*p)).collect();
                elements.extend(inside(frame, &places, &style));
            }
            let y = SPACE[1] - 12.0;
            let line = Shape::Segment(
                Point { x: legend, y: y - 4.0 },
                Point { x: legend + 22.0, y: y - 4.0 },
            );
            elements.push(Element { style, ..Element::new(line) });
            let words = words_at(Point { x: legend + 28.0, y }, label.clone(), Anchoring::Start);
            elements.push(words);
            legend += 46.0 + drawing::metrics::text_width(&label, LETTERS);
        }
        if !self.curves.is_empty() {
            let (wide, _) = frame.inner();
            let at = Point { x: SPACE[0] + wide, y: frame.size.1 - 6.0 };
            elements.push(words_at(at, self.over.in_words(), Anchoring::End));
        }
        Drawing { elements, vertical: Vertical::Down }
    }
    /// Writes the chart as SVG, in pixels.
    pub fn svg(&self, size: (f64, f64)) -> String {
        let title = self.shown().map(|(label, _)| label).collect::<Vec<_>>().join(", ");
        let title = match self.curves.is_empty() {
            true => title,
            false => format!("{title} over {}", self.over.in_words()),
        };
        let options =
            drawing::svg::SvgOptions { title: Some(&title), ..drawing::svg::SvgOptions::default() };
        drawing::svg::write(&self.chart(&Frame::of(self, size)), &options)
    }
}

impl Axis {
    /// Its label, with the unit where it has one.
    pub fn in_words(&self) -> String {
        if self.unit.is_empty() {
            self.label.clone()
        } else {
            format!("{} [{}]", self.label, self.unit)
        }
    }
}

fn style_of(curve: usize) -> Style {
    let color = match COLORS[curve % COLORS.len()] {
        "" => Color::Accent,
        named => Color::Named(named.into()),
    };
    Style { color, line: LINES[curve % LINES.len()], width: 1.75, ..Style::default() }
}

/// Adds the grid, the numbers on it, and the frame.
fn axes(elements: &mut Vec<Element>, frame: &Frame) {
    let [left, top, ..] = SPACE;
    let (wide, high) = frame.inner();
    let faint = |width: f64| Style { color: Color::Faint, width, ..Style::default() };
    let mut line = |a: Point, b: Point, width: f64| {
        let segment = Element { style: faint(width), ..Element::new(Shape::Segment(a, b)) };
        elements.push(Element { layer: Layer::Back, ..segment });
    };
    let per = |range: (f64, f64), pixels: f64| (range.1 - range.0) / pixels;
    let along = marks(frame.x, APART.0 * per(frame.x, wide));
    let up = marks(frame.y, APART.1 * per(frame.y, high));
    for &x in &along {
        let at = frame.place((x, frame.y.0)).x;
        line(Point { x: at, y: top }, Point { x: at, y: top + high }, 0.35);
    }
    for &y in &up {
        let at = frame.place((frame.x.0, y)).y;
        line(Point { x: left, y: at }, Point { x: left + wide, y: at }, 0.35);
    }
    let corners = [(0.0, 0.0), (wide, 0.0), (wide, high), (0.0, high)];
    let points = corners.map(|(x, y)| Point { x: left + x, y: top + y }).to_vec();
    let edge =
        Element { style: faint(1.0), ..Element::new(Shape::Polyline { points, closed: true }) };
    elements.push(edge);
    for (marks, is_along) in [(&along, true), (&up, false)] {
        for &mark in marks {
            // a number near zero among larger ones is zero
            let size = marks.iter().fold(0.0_f64, |size, m| size.max(m.abs()));
            let shown = if mark.abs() < 1e-9 * size { 0.0 } else { mark };
            let (at, anchoring) = match is_along {
                true => (
                    Point { x: frame.place((mark, frame.y.0)).x, y: top + high + 15.0 },
                    Anchoring::Middle,
                ),
                false => {
                    let y = frame.place((frame.x.0, mark)).y + 4.0;
                    (Point { x: left - 7.0, y }, Anchoring::End)
                }
            };
            elements.push(words_at(at, significant(shown, 6), anchoring));
        }
    }
}

fn words_at(at: Point, text: String, anchoring: Anchoring) -> Element {
    let placement = Placement::OnSheet(LETTERS);
    let words = Element::new(Shape::Text { at, text, anchoring, placement, turn: 0.0 });
    let style = Style { color: Color::Faint, ..Style::default() };
    Element { layer: Layer::Words, style, ..words }
}

/// Returns what of a curve lies between the axes.
fn inside(frame: &Frame, places: &[Point], style: &Style) -> Vec<Element> {
    let mut runs: Vec<Vec<Point>> = Vec::new();
    for pair in places.windows(2) {
        let Some((a, b)) = frame.clipped(pair[0], pair[1]) else { continue };
        match runs.last_mut() {
            Some(run) if run.last() == Some(&a) => run.push(b),
            _ => runs.push(vec![a, b]),
        }
    }
    let element = |points| Element {
        style: style.clone(),
        ..Element::new(Shape::Polyline { points, closed: false })
    };
    runs.into_iter().map(element).collect()
}

#[cfg(test)]
mod tests {
    use super::{Frame, marks};
    use crate::plotting::{Axis, Curve, Plot};
    use drawing::{Point, Shape};

    fn square() -> Plot {
        let points = (0..=10).map(|i| f64::from(i) / 5.0).map(|x| Some((x, x * x))).collect();
        let axis = Axis { label: String::from("area"), unit: String::from("mm^2") };
        Plot { curves: vec![Curve { axis, points }], ..Plot::default() }
    }

    #[test]
    fn axes_are_marked_with_round_numbers() {
        assert_eq!(marks((-0.1, 2.04), 0.4), [0.0, 0.5, 1.0, 1.5, 2.0]);
        assert_eq!(marks((0.0, 100.0), 21.0), [0.0, 50.0, 100.0]);
        assert!(marks((0.0, 0.0), 0.0).is_empty());
    }

    #[test]
    fn a_place_in_a_frame_leads_back_to_its_numbers() {
        let frame = Frame::of(&square(), (640.0, 360.0));
        let (x, y) = frame.numbers(frame.place((1.5, 2.25)));
        assert!((x - 1.5).abs() < 1e-12 && (y - 2.25).abs() < 1e-12);
        let at = Point { x: 300.0, y: 120.0 };
        let (before, after) = (frame.numbers(at), frame.zoomed(0.5, at).numbers(at));
        assert!((before.0 - after.0).abs() < 1e-12 && (before.1 - after.1).abs() < 1e-12);
    }

    #[test]
    fn a_curve_is_cut_off_at_the_axes() {
        let plot = square();
        let whole = Frame::of(&plot, (640.0, 360.0));
        let near = whole.zoomed(0.25, whole.place((1.0, 1.0)));
        for frame in [whole, near] {
            let (least, most) =
                (frame.place((frame.x.0, frame.y.1)), frame.place((frame.x.1, frame.y.0)));
            for element in &plot.chart(&frame).elements {
                let Shape::Polyline { points, closed: false } = &element.shape else { continue };
                for p in points {
                    assert!(p.x >= least.x - 1e-9 && p.x <= most.x + 1e-9, "{p:?}");
                    assert!(p.y >= least.y - 1e-9 && p.y <= most.y + 1e-9, "{p:?}");
                }
            }
        }
    }

    #[test]
    fn the_nearest_point_is_told_in_words() {
        let plot = square();
        let frame = Frame::of(&plot, (640.0, 360.0));
        let found =
            plot.nearest(&frame, frame.place((1.01, 1.0))).map(|found| plot.in_words(found));
        assert_eq!(found.as_deref(), Some(" = 1, area = 1 mm^2"));
    }
}
