//! Hatches of the DXF writer: rings of segments and arcs are polylines, those with Bézier curves are edge by edge.

use super::{Writer, degrees};
use crate::curve::runs;
use crate::element::{Corner, Element, Point, Shape};
use crate::spline;

impl Writer {
    /// Fills rings.
    pub(super) fn hatch(&mut self, element: &Element, rings: &[Vec<Corner>]) {
        self.begin("HATCH", "AcDbHatch", element);
        self.at(10, Point::default());
        self.pair(210, "0.0\n220\n0.0\n230\n1.0");
        self.pair(2, "SOLID");
        self.pair(70, 1);
        self.pair(71, 0);
        self.pair(91, rings.len());
        for (i, ring) in rings.iter().enumerate() {
            // the first one is outside of the others
            let outside = u8::from(i == 0);
            if ring.iter().any(|corner| corner.poles.is_some()) {
                self.edges(outside, &runs(ring));
                continue;
            }
            // a polyline
            self.pair(92, 2 + outside);
            self.pair(72, 1);
            self.pair(73, 1);
            self.pair(93, ring.len());
            self.corners(ring);
            self.pair(97, 0);
        }
        self.pair(75, 0);
        self.pair(76, 1);
        self.pair(98, 0);
    }
    /// Writes a ring edge by edge.
    fn edges(&mut self, outside: u8, edges: &[Shape]) {
        self.pair(92, outside);
        self.pair(93, edges.len());
        for edge in edges {
            match edge {
                Shape::Segment(p, q) => {
                    self.pair(72, 1);
                    self.flat(10, *p);
                    self.flat(11, *q);
                }
                Shape::Arc { center, radius, start, sweep } => {
                    self.pair(72, 2);
                    self.flat(10, *center);
                    self.real(40, self.length(*radius));
                    // where it runs to the right, its angles are counted to the right
                    let is_left = self.sign * sweep > 0.0;
                    let sign = if is_left { self.sign } else { -self.sign };
                    let [from, to] = [*start, start + sweep].map(|angle| degrees(sign * angle));
                    self.real(50, from);
                    self.real(51, to);
                    self.pair(73, u8::from(is_left));
                }
                Shape::Spline(poles) => {
                    let knots = spline::knots(poles);
                    self.pair(72, 4);
                    self.pair(94, 3);
                    self.pair(73, 0);
                    self.pair(74, 0);
                    self.pair(95, knots.len());
                    self.pair(96, poles.len());
                    knots.iter().for_each(|knot| self.real(40, *knot));
                    poles.iter().for_each(|p| self.flat(10, *p));
                }
                Shape::Dot(_)
                | Shape::Polyline { .. }
                | Shape::Circle { .. }
                | Shape::Ellipse { .. }
                | Shape::Nurbs(_)
                | Shape::Region(_)
                | Shape::Text { .. } => {}
            }
        }
        self.pair(97, 0);
    }
    /// Writes a place in the plane.
    fn flat(&mut self, code: u16, p: Point) {
        self.real(code, self.length(p.x));
        self.real(code + 10, self.sign * self.length(p.y));
    }
}
