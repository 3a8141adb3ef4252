//! Points of other figures.

use crate::algebra::Algebra;
use crate::build::NoConstruction;
use crate::construction::Construction;
use crate::figure::Figure;
use crate::work::{Ray, V, Work, point};

impl<A: Algebra> Work<'_, A> {
    pub(crate) fn point(
        &mut self,
        what: Construction,
        of: &[Figure<A::N>],
        numbers: &[A::N],
    ) -> Option<Figure<A::N>> {
        let at = match (what, of, numbers) {
            (Construction::Polar, [from], [distance, angle]) => {
                let direction = [self.a.cos(*angle), self.a.sin(*angle)];
                self.further(point(*from)?, *distance, direction)
            }
            (Construction::Intersection, [first, second], []) => {
                self.intersection(*first, *second)?
            }
            (Construction::Projection, [of, onto], []) => self.projection(point(*of)?, *onto)?,
            _ => return None,
        };
        Some(Figure::Point(at))
    }

    /// Finds where two curves meet; of two places the one where the second's direction is to the left of the first's.
    fn intersection(&mut self, first: Figure<A::N>, second: Figure<A::N>) -> Option<V<A::N>> {
        match (first, second) {
            (Figure::Straight { .. }, Figure::Straight { .. }) => {
                let (p, q) = (self.ray(first)?, self.ray(second)?);
                let turn = self.cross(p.along, q.along);
                let (square, one) = (self.square(turn), self.a.constant(1.0));
                self.needs_more(square, one, NoConstruction::Parallel);
                let way = self.minus(q.from, p.from);
                let reach = self.cross(way, q.along);
                let reach = self.a.div(reach, turn);
                Some(self.further(p.from, reach, p.along))
            }
            (Figure::Straight { .. }, Figure::Circle { center, radius }) => {
                let ray = self.ray(first)?;
                let sign = self.a.sign(radius);
                Some(self.on_chord(ray, center, radius, sign))
            }
            (Figure::Circle { center, radius }, Figure::Straight { .. }) => {
                let ray = self.ray(second)?;
                let sign = self.a.sign(radius);
                let sign = self.a.neg(sign);
                Some(self.on_chord(ray, center, radius, sign))
            }
            (
                Figure::Circle { center: c1, radius: r1 },
                Figure::Circle { center: c2, radius: r2 },
            ) => {
                self.needs_radius(r1, r1);
                self.needs_radius(r2, r2);
                let way = self.minus(c2, c1);
                let (s1, s2) = (self.a.sign(r1), self.a.sign(r2));
                let sign = self.a.mul(s1, s2);
                let at = self.apex(way, [r1, r2], sign);
                Some(self.plus(c1, at))
            }
            _ => None,
        }
    }

    /// Returns the end of the chord that a circle cuts from a straight: the later one where `sign` is 1.
    fn on_chord(&mut self, ray: Ray<A::N>, center: V<A::N>, radius: A::N, sign: A::N) -> V<A::N> {
        let square = self.square(radius);
        self.needs_radius(radius, square);
        let way = self.minus(center, ray.from);
        let (along, off) = (self.dot(ray.along, way), self.dot(ray.left, way));
        let (near, far) = (self.a.sub(radius, off), self.a.add(radius, off));
        let half = self.a.mul(near, far);
        let half = self.root(half, square, NoConstruction::Apart);
        let half = self.a.mul(sign, half);
        let reach = self.a.add(along, half);
        self.further(ray.from, reach, ray.along)
    }

    /// Returns the apex of a triangle over a way from the origin, with these distances from the way's ends: to
    /// the left of the way where `sign` is 1.
    pub(crate) fn apex(&mut self, way: V<A::N>, from: [A::N; 2], sign: A::N) -> V<A::N> {
        let square = self.dot(way, way);
        let [p, q] = from;
        let (pp, qq) = (self.square(p), self.square(q));
        let both = self.a.add(pp, qq);
        let beside = self.a.add(square, both);
        self.needs_more(square, beside, NoConstruction::Concentric);
        let d = self.a.sqrt(square);
        // 4 d² h² = ((d + p)² - q²) (q² - (d - p)²), by Heron
        let (dp, d_p) = (self.a.add(d, p), self.a.sub(d, p));
        let factors =
            [self.a.add(dp, q), self.a.sub(dp, q), self.a.add(q, d_p), self.a.sub(q, d_p)];
        let outer = self.a.mul(factors[0], factors[1]);
        let inner = self.a.mul(factors[2], factors[3]);
        let area = self.a.mul(outer, inner);
        let scale = self.square(beside);
        let area = self.root(area, scale, NoConstruction::Apart);
        let two = self.a.constant(2.0);
        let twice = self.a.mul(two, square);
        let up = self.a.mul(sign, area);
        let up = self.a.div(up, twice);
        // (d² + p² - q²) / 2d²
        let difference = self.a.sub(pp, qq);
        let along = self.a.add(square, difference);
        let along = self.a.div(along, twice);
        let (along, left) = (self.times(way, along), self.left(way));
        self.further(along, up, left)
    }

    /// Returns the place on a curve that is nearest to a point.
    pub(crate) fn projection(&mut self, p: V<A::N>, onto: Figure<A::N>) -> Option<V<A::N>> {
        match onto {
            Figure::Straight { .. } => {
                let ray = self.ray(onto)?;
                let way = self.minus(p, ray.from);
                let along = self.dot(ray.along, way);
                Some(self.further(ray.from, along, ray.along))
            }
            Figure::Circle { center, radius } => {
                let (way, length) = self.way(center, p, NoConstruction::Coincident);
                let sign = self.a.sign(radius);
                let size = self.a.mul(radius, sign);
                let part = self.a.div(size, length);
                Some(self.further(center, part, way))
            }
            Figure::Point(_) | Figure::Arc { .. } => None,
        }
    }
}
