//! Straights of other figures.

use crate::algebra::Algebra;
use crate::build::NoConstruction;
use crate::construction::Construction;
use crate::figure::Figure;
use crate::work::{Ends, Work, point};

impl<A: Algebra> Work<'_, A> {
    pub(crate) fn straight(
        &mut self,
        what: Construction,
        of: &[Figure<A::N>],
        numbers: &[A::N],
    ) -> Option<Figure<A::N>> {
        let (from, to) = match (what, of, numbers) {
            (Construction::Directed, [from], [angle]) => {
                let from = point(*from)?;
                let direction = [self.a.cos(*angle), self.a.sin(*angle)];
                (from, self.plus(from, direction))
            }
            (Construction::Parallel, [line @ Figure::Straight { from, to }], [distance]) => {
                let ray = self.ray(*line)?;
                (self.further(*from, *distance, ray.left), self.further(*to, *distance, ray.left))
            }
            (
                Construction::ParallelThrough,
                [line @ Figure::Straight { from, to }, through],
                [],
            ) => {
                self.ray(*line)?;
                let (way, through) = (self.minus(*to, *from), point(*through)?);
                (through, self.plus(through, way))
            }
            (Construction::Perpendicular, [line @ Figure::Straight { from, to }, through], []) => {
                self.ray(*line)?;
                let (way, through) = (self.minus(*to, *from), point(*through)?);
                let left = self.left(way);
                (through, self.plus(through, left))
            }
            (Construction::PerpendicularFrom, [from, line], []) => {
                let from = point(*from)?;
                let foot = self.projection(from, *line)?;
                self.way(from, foot, NoConstruction::Coincident);
                (from, foot)
            }
            (Construction::TangentFrom, [Figure::Point(_), Figure::Circle { .. }], [])
            | (
                Construction::TangentToCircles,
                [Figure::Circle { .. }, Figure::Circle { .. }],
                [],
            ) => self.common_tangent(of[0], of[1])?,
            (Construction::TangentAlong, [Figure::Circle { center, radius }, along], []) => {
                let ray = self.ray(*along)?;
                let back = self.a.neg(*radius);
                let from = self.further(*center, back, ray.left);
                (from, self.further(from, ray.length, ray.along))
            }
            (Construction::Bisector, [first, second], []) => self.bisector(*first, *second)?,
            (Construction::PerpendicularBisector, [p, q], []) => {
                let (p, q) = (point(*p)?, point(*q)?);
                let (way, _) = self.way(p, q, NoConstruction::Coincident);
                let (middle, left) = (self.middle(p, q), self.left(way));
                (middle, self.plus(middle, left))
            }
            _ => return None,
        };
        Some(Figure::Straight { from, to })
    }

    /// Returns where the straight that has both circles to its left, each by its radius, touches the first and the
    /// second.
    fn common_tangent(&mut self, first: Figure<A::N>, second: Figure<A::N>) -> Option<Ends<A>> {
        let ((c1, r1), (c2, r2)) = (self.round(first)?, self.round(second)?);
        let (way, d) = self.way(c1, c2, NoConstruction::Concentric);
        let rise = self.a.sub(r2, r1);
        // d² = along² + rise²
        let (low, high) = (self.a.sub(d, rise), self.a.add(d, rise));
        let square = self.a.mul(low, high);
        let beside = self.square(d);
        self.needs_more(square, beside, NoConstruction::Inside);
        let along = self.a.sqrt(square);
        let left = self.left(way);
        let (forward, back) = (self.times(way, along), self.times(left, rise));
        let direction = self.minus(forward, back);
        let direction = self.over(direction, beside);
        let left = self.left(direction);
        let (b1, b2) = (self.a.neg(r1), self.a.neg(r2));
        Some((self.further(c1, b1, left), self.further(c2, b2, left)))
    }

    /// Returns two points of the straight as far to the left of one as it is to the right of the other.
    fn bisector(&mut self, first: Figure<A::N>, second: Figure<A::N>) -> Option<Ends<A>> {
        let (p, q) = (self.ray(first)?, self.ray(second)?);
        let along = self.plus(p.along, q.along);
        let (square, one) = (self.dot(along, along), self.a.constant(1.0));
        self.needs_more(square, one, NoConstruction::Opposite);
        let left = self.left(along);
        // (n₁ + n₂) · x = n₂ · way, seen from the first's beginning
        let way = self.minus(q.from, p.from);
        let offset = self.dot(q.left, way);
        let offset = self.a.div(offset, square);
        let from = self.further(p.from, offset, left);
        let size = self.a.sqrt(square);
        let reach = self.a.div(p.length, size);
        Some((from, self.further(from, reach, along)))
    }
}
