//! Rings: what segments and arcs of a picture surround, so that it can be filled.

use base::number::{cos, hypot, sin, tan};
use drawing::{Corner, Element, Layer, Line, Point, Shape};

/// Ends that are closer than this part of how far the pieces reach meet: they are computed on several ways.
const MEET: f64 = 1e-9;

/// A segment or an arc, from one end to the other.
#[derive(Clone, Copy)]
struct Piece {
    from: Point,
    to: Point,
    bulge: f64,
}

impl Piece {
    fn of(shape: &Shape) -> Option<Self> {
        match *shape {
            Shape::Segment(from, to) => Some(Self { from, to, bulge: 0.0 }),
            Shape::Arc { center, radius, start, sweep } => {
                let at = |angle: f64| Point {
                    x: center.x + radius * cos(angle),
                    y: center.y + radius * sin(angle),
                };
                Some(Self { from: at(start), to: at(start + sweep), bulge: tan(sweep / 4.0) })
            }
            Shape::Dot(_)
            | Shape::Polyline { .. }
            | Shape::Circle { .. }
            | Shape::Ellipse { .. }
            | Shape::Spline(_)
            | Shape::Region(_)
            | Shape::Text { .. } => None,
        }
    }
    fn reversed(self) -> Self {
        Self { from: self.to, to: self.from, bulge: -self.bulge }
    }
}

/// Returns true for what may be a piece of a ring.
pub(crate) fn is_piece(element: &Element) -> bool {
    matches!(element.shape, Shape::Segment(..) | Shape::Arc { .. }) && !element.style.is_unbounded
}

/// Finds the rings that segments and arcs close, each piece in one ring at most: the surface of each, which has no
/// line, and the places of its pieces.
///
/// Cost: for every piece of a ring, that of looking at the pieces once.
pub(crate) fn rings(elements: &[Element]) -> Vec<(Element, Vec<usize>)> {
    let piece = |(i, e): (usize, &Element)| Some((i, Piece::of(&e.shape).filter(|_| is_piece(e))?));
    let mut left: Vec<(usize, Piece)> = elements.iter().enumerate().filter_map(piece).collect();
    let all = left.iter().flat_map(|(_, piece)| [piece.from, piece.to]);
    let reach = all.fold(0.0_f64, |reach, p| reach.max(p.x.abs()).max(p.y.abs()));
    let meet = |p: Point, q: Point| hypot(p.x - q.x, p.y - q.y) <= MEET * reach;
    let mut rings = Vec::new();
    while !left.is_empty() {
        let (first, begun) = left.remove(0);
        let (mut chain, mut at) = (vec![(first, begun)], begun.to);
        let mut open = left.clone();
        while !meet(at, begun.from) {
            let next = open.iter().position(|(_, p)| meet(p.from, at) || meet(p.to, at));
            let Some((i, piece)) = next.map(|next| open.remove(next)) else { break };
            let piece = if meet(piece.from, at) { piece } else { piece.reversed() };
            at = piece.to;
            chain.push((i, piece));
        }
        if chain.len() > 1 && meet(at, begun.from) {
            left = open;
            let corners = chain.iter().map(|(_, p)| Corner { at: p.from, bulge: p.bulge });
            let mut surface = Element {
                shape: Shape::Region(vec![corners.collect()]),
                layer: Layer::Back,
                ..elements[first].clone()
            };
            surface.style.line = Line::None;
            rings.push((surface, chain.into_iter().map(|(i, _)| i).collect()));
        }
    }
    rings
}

#[cfg(test)]
mod tests {
    use super::rings;
    use drawing::{Element, Point, Shape};

    fn segment(a: (f64, f64), b: (f64, f64)) -> Element {
        let point = |(x, y)| Point { x, y };
        Element::new(Shape::Segment(point(a), point(b)))
    }

    #[test]
    fn sides_close_whichever_way_they_run_and_open_ones_do_not() {
        let sides = [
            segment((0.0, 0.0), (4.0, 0.0)),
            segment((9.0, 9.0), (8.0, 8.0)),
            segment((4.0, 3.0), (4.0, 0.0)),
            segment((4.0, 3.0), (0.0, 0.0)),
        ];
        let found = rings(&sides);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].1, [0, 2, 3]);
        assert!(rings(&sides[..3]).is_empty());
    }

    #[test]
    fn a_half_circle_and_its_chord_close() {
        let center = Point { x: 1e3, y: 0.0 };
        let arc = Shape::Arc { center, radius: 7.0, start: 0.0, sweep: std::f64::consts::PI };
        let found = rings(&[Element::new(arc), segment((993.0, 0.0), (1007.0, 0.0))]);
        let Shape::Region(corners) = &found[0].0.shape else { panic!("a region") };
        assert!((corners[0][0].bulge - 1.0).abs() < 1e-12);
    }
}
