//! What is drawn twice: a line or an arc that is an edge of a ring beside it, drawn in the same way.
//!
//! In: elements in order. Out: those without the doubles. The ring stays, since it says more: its edges hang together.
//! A whole circle stays beside it, since it says more, too: it can be drilled.

use super::layer_of;
use crate::element::{Corner, Element, Line, Point, Shape, Tag};
use crate::{curve, spline};
use base::number::{cos, sin};
use std::f64::consts::TAU;

/// Within what part of the extent of an edge places are one.
const NEAR: f64 = 1e-9;

/// An edge, by its ends and what lies half-way between.
struct Edge {
    ends: [Point; 2],
    middle: Point,
}

/// How something is drawn: only what is drawn alike is drawn twice.
type Way = (Option<String>, String, Line);

/// Returns the elements without those that are an edge of a ring.
pub(super) fn without_doubles<'e>(
    elements: Vec<&'e Element>,
    group: &dyn Fn(Tag) -> Option<String>,
) -> Vec<&'e Element> {
    let way = |e: &&Element| (group(e.tag), layer_of(e), e.style.line);
    let ways: Vec<Way> = elements.iter().map(way).collect();
    let mut edges: Vec<(&Way, Edge)> = Vec::new();
    for (element, way) in elements.iter().zip(&ways) {
        // what has no line, or is shown as a dimension, draws no edge
        let is_drawn = element.style.line != Line::None && element.style.dimension.is_none();
        if let (Shape::Region(rings), true) = (&element.shape, is_drawn) {
            edges.extend(rings.iter().flat_map(|ring| of_ring(ring)).map(|edge| (way, edge)));
        }
    }
    edges.sort_by(|(_, a), (_, b)| a.middle.x.total_cmp(&b.middle.x));
    let is_double = |element: &Element, own_way: &Way| {
        let Some(own) = of_shape(&element.shape).filter(|_| element.style.dimension.is_none())
        else {
            return false;
        };
        let reach = NEAR * own.extent();
        let from = edges.partition_point(|(_, e)| e.middle.x < own.middle.x - reach);
        let near = edges[from..].iter().take_while(|(_, e)| e.middle.x <= own.middle.x + reach);
        { near }.any(|(way, edge)| *way == own_way && edge.is_one_with(&own, reach))
    };
    let all = elements.into_iter().zip(&ways);
    all.filter(|(element, way)| !is_double(element, way)).map(|(element, _)| element).collect()
}

/// Returns the elements with rings bared that have Bézier curves, where all of their line is drawn beside them in the
/// same way: an ellipse says more than the curves that stand for it. Nothing where there is no such ring.
pub(super) fn bared(
    elements: &[Element],
    group: &dyn Fn(Tag) -> Option<String>,
) -> Option<Vec<Element>> {
    let is_curved = |e: &Element| match &e.shape {
        Shape::Region(rings) => rings.iter().flatten().any(|corner| corner.poles.is_some()),
        _ => false,
    };
    if !elements.iter().any(is_curved) {
        return None;
    }
    let way = |e: &Element| (group(e.tag), layer_of(e), e.style.line);
    let mut drawn: Vec<(Way, Edge)> = Vec::new();
    for element in elements.iter().filter(|e| e.style.dimension.is_none()) {
        let corners = curve::corners_along(&element.shape).unwrap_or_default();
        drawn.extend(corners.windows(2).map(|pair| (way(element), Edge::of(pair[0], pair[1]))));
    }
    drawn.sort_by(|(_, a), (_, b)| a.middle.x.total_cmp(&b.middle.x));
    let is_beside = |own: &Edge, own_way: &Way| {
        let reach = NEAR * own.extent();
        let from = drawn.partition_point(|(_, e)| e.middle.x < own.middle.x - reach);
        let near = drawn[from..].iter().take_while(|(_, e)| e.middle.x <= own.middle.x + reach);
        { near }.any(|(way, edge)| way == own_way && edge.is_one_with(own, reach))
    };
    let bare = |element: &Element| {
        let mut bare = element.clone();
        if let (true, Shape::Region(rings)) = (is_curved(element), &element.shape) {
            let own_way = way(element);
            let mut edges = rings.iter().flat_map(|ring| of_ring(ring));
            if edges.all(|edge| is_beside(&edge, &own_way)) {
                bare.style.line = Line::None;
            }
        }
        bare
    };
    Some(elements.iter().map(bare).collect())
}

impl Edge {
    fn of(from: Corner, to: Corner) -> Self {
        let middle = match from.poles {
            Some([p, q]) => spline::at([from.at, p, q, to.at], 0.5),
            None => half_way(&from, to.at),
        };
        Self { ends: [from.at, to.at], middle }
    }
    fn extent(&self) -> f64 {
        let [p, q] = self.ends;
        distance(p, q).max(distance(p, self.middle))
    }
    /// Whether another is the same edge, whichever way it runs.
    fn is_one_with(&self, other: &Self, reach: f64) -> bool {
        let meets = |p, q| distance(p, q) <= reach;
        let [[p, q], [r, s]] = [self.ends, other.ends];
        meets(self.middle, other.middle)
            && (meets(p, r) && meets(q, s) || meets(p, s) && meets(q, r))
    }
}

fn of_shape(shape: &Shape) -> Option<Edge> {
    match *shape {
        Shape::Segment(p, q) => Some(Edge { ends: [p, q], middle: between(p, q) }),
        Shape::Arc { center, radius, start, sweep } if sweep.abs() < TAU => {
            let at = |angle: f64| Point {
                x: center.x + radius * cos(angle),
                y: center.y + radius * sin(angle),
            };
            Some(Edge { ends: [at(start), at(start + sweep)], middle: at(start + sweep / 2.0) })
        }
        _ => None,
    }
}

/// Returns the edges of a ring.
fn of_ring(ring: &[Corner]) -> Vec<Edge> {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| Edge::of(*a, *b)).collect()
}

/// Returns what lies half-way along an edge that leaves a corner.
fn half_way(from: &Corner, to: Point) -> Point {
    let p = from.at;
    let middle = between(p, to);
    // the sagitta is the bulge times half the chord, to the right of the chord where the arc turns left
    let rise = from.bulge / 2.0;
    Point { x: middle.x + rise * (to.y - p.y), y: middle.y - rise * (to.x - p.x) }
}

fn between(p: Point, q: Point) -> Point {
    Point { x: f64::midpoint(p.x, q.x), y: f64::midpoint(p.y, q.y) }
}

fn distance(p: Point, q: Point) -> f64 {
    base::number::sqrt((p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_an_edge_of_a_ring_is_drawn_once() {
        let at = |x, y| Point { x, y };
        let corner = |x, y, bulge| Corner::new(at(x, y), bulge);
        // a half disc, and a hole of two half turns
        let ring = vec![corner(-5.0, 0.0, 0.0), corner(5.0, 0.0, 1.0)];
        let hole = vec![corner(1.0, 2.0, 1.0), corner(-1.0, 2.0, 1.0)];
        let all = [
            Shape::Region(vec![ring, hole]),
            Shape::Segment(at(5.0, 0.0), at(-5.0, 0.0)),
            Shape::Arc { center: at(0.0, 0.0), radius: 5.0, start: 0.0, sweep: TAU / 2.0 },
            // a hole that is drilled, the other half, and a part of an edge
            Shape::Circle { center: at(0.0, 2.0), radius: 1.0 },
            Shape::Arc { center: at(0.0, 0.0), radius: 5.0, start: 0.0, sweep: -TAU / 2.0 },
            Shape::Segment(at(0.0, 0.0), at(5.0, 0.0)),
        ];
        let mut all: Vec<Element> = all.into_iter().map(Element::new).collect();
        let mut dashed = all[1].clone();
        dashed.style.line = Line::Dashed;
        all.push(dashed);
        let left = without_doubles(all.iter().collect(), &|_| None);
        let wanted: Vec<&Element> = [0, 3, 4, 5, 6].map(|i| &all[i]).into();
        assert_eq!(left, wanted);
    }

    #[test]
    fn an_ellipse_around_a_surface_is_drawn_once_and_as_an_ellipse() {
        let at = |x, y| Point { x, y };
        let ellipse = Shape::Ellipse {
            center: at(0.0, 0.0),
            major: at(6.0, 0.0),
            ratio: 0.5,
            start: 0.0,
            sweep: TAU / 2.0,
        };
        let lines = [ellipse, Shape::Segment(at(6.0, 0.0), at(-6.0, 0.0))];
        let ring = curve::ring_along(&lines).expect("they follow one another");
        let mut all: Vec<Element> = lines.into_iter().map(Element::new).collect();
        all.push(Element::new(Shape::Region(vec![ring])));
        let bare = bared(&all, &|_| None).expect("there is such a ring");
        assert_eq!((bare[2].style.line, &bare[..2]), (Line::None, &all[..2]));
        // what is not all there takes nothing away
        assert_eq!(bared(&all[1..], &|_| None).expect("there is")[1], all[2]);
        assert_eq!(bared(&all[..2], &|_| None), None);
    }

    #[test]
    fn what_is_no_ring_on_the_sheet_takes_no_edge_away() {
        let at = |x, y| Point { x, y };
        let ring = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0)].map(|(x, y)| Corner::new(at(x, y), 0.0));
        let mut region = Element::new(Shape::Region(vec![ring.into()]));
        let side = Element::new(Shape::Segment(at(0.0, 0.0), at(4.0, 0.0)));
        let left = |region: &Element| without_doubles(vec![region, &side], &|_| None).len();
        assert_eq!(left(&region), 1);
        let points = vec![at(0.0, 0.0), at(4.0, 0.0)];
        let measured = crate::Dimension { kind: crate::DimensionKind::Aligned, points };
        region.style.dimension = Some(std::sync::Arc::new(measured));
        assert_eq!(left(&region), 2);
        region.style.dimension = None;
        region.style.line = Line::None;
        assert_eq!(left(&region), 2);
    }
}
