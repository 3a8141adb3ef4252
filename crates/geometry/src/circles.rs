//! Circles and arcs that touch other figures.
//!
//! Where a circle (c, r) touches a circle (cᵢ, rᵢ) coherently there is a unit vector w with `c + r w = cᵢ + rᵢ w`, so
//! that `c - cᵢ = (rᵢ - r) w`; both run along w turned a quarter to the left there. Where it touches a straight w is a
//! quarter turn to the right of that. From the first contact to the second is less than half a turn where
//! `r (w₁ × w₂)` is positive.

use crate::algebra::Algebra;
use crate::build::NoConstruction;
use crate::construction::Construction;
use crate::figure::Figure;
use crate::work::{Touched, V, Work, place, point};

impl<A: Algebra> Work<'_, A> {
    pub(crate) fn circle(
        &mut self,
        what: Construction,
        of: &[Figure<A::N>],
        numbers: &[A::N],
    ) -> Option<Figure<A::N>> {
        let (center, radius) = match (what, of, numbers) {
            (Construction::Around, [center, through], []) => {
                let (center, through) = (point(*center)?, point(*through)?);
                let (_, radius) = self.way(center, through, NoConstruction::Coincident);
                (center, radius)
            }
            (Construction::TangentAround, [curve, center], []) => {
                let center = point(*center)?;
                (center, self.offset(*curve, center)?)
            }
            (Construction::TangentAt, [curve, at], [radius]) => {
                (self.touching_at(*curve, point(*at)?, *radius)?, *radius)
            }
            (Construction::TangentToTwo, [first, second], [radius]) => {
                (self.touching_two(*first, *second, *radius)?, *radius)
            }
            (Construction::TangentToThree, [first, second, third], []) => {
                self.touching_three([*first, *second, *third])?
            }
            _ => return None,
        };
        Some(Figure::Circle { center, radius })
    }

    /// Returns how far a point lies to the left of a curve: the radius of the circle around it that touches.
    fn offset(&mut self, curve: Figure<A::N>, of: V<A::N>) -> Option<A::N> {
        match curve {
            Figure::Straight { .. } => {
                let ray = self.ray(curve)?;
                let way = self.minus(of, ray.from);
                let offset = self.dot(ray.left, way);
                let beside = self.dot(way, way);
                self.needs_radius(offset, beside);
                Some(offset)
            }
            Figure::Circle { center, radius } => {
                let (way, sign) = (self.minus(of, center), self.a.sign(radius));
                let distance = self.length(way);
                let size = self.square(radius);
                self.needs_radius(radius, size);
                let distance = self.a.mul(sign, distance);
                let offset = self.a.sub(radius, distance);
                self.needs_radius(offset, size);
                Some(offset)
            }
            Figure::Point(_) | Figure::Arc { .. } => None,
        }
    }

    fn touching_at(&mut self, curve: Figure<A::N>, at: V<A::N>, radius: A::N) -> Option<V<A::N>> {
        let contact = self.projection(at, curve)?;
        let size = self.square(radius);
        self.needs_radius(radius, size);
        match curve {
            Figure::Straight { .. } => {
                let ray = self.ray(curve)?;
                Some(self.further(contact, radius, ray.left))
            }
            Figure::Circle { center, radius: around } => {
                let size = self.square(around);
                self.needs_radius(around, size);
                let (out, part) = (self.minus(contact, center), self.a.div(radius, around));
                let part = self.a.neg(part);
                Some(self.further(contact, part, out))
            }
            Figure::Point(_) | Figure::Arc { .. } => None,
        }
    }

    /// Returns the centre of the circle of a radius that touches two figures.
    fn touching_two(
        &mut self,
        first: Figure<A::N>,
        second: Figure<A::N>,
        radius: A::N,
    ) -> Option<V<A::N>> {
        let origin = place(first);
        let (p, q) = (self.touched(first, origin)?, self.touched(second, origin)?);
        let size = self.square(radius);
        self.needs_radius(radius, size);
        let turns = self.a.sign(radius);
        let center = match (p, q) {
            (
                Touched::Straight { left: m, offset: d },
                Touched::Straight { left: n, offset: e },
            ) => {
                // m · c = d + r, n · c = e + r
                let (d, e) = (self.a.add(d, radius), self.a.add(e, radius));
                self.meeting([m, n], [d, e])
            }
            (Touched::Straight { left, offset }, Touched::Round { center, radius: r }) => {
                self.beside((left, offset), (center, r), radius, turns)
            }
            (Touched::Round { center, radius: r }, Touched::Straight { left, offset }) => {
                let turns = self.a.neg(turns);
                self.beside((left, offset), (center, r), radius, turns)
            }
            (Touched::Round { radius: r1, .. }, Touched::Round { center: way, radius: r2 }) => {
                let (p, q) = (self.a.sub(r1, radius), self.a.sub(r2, radius));
                for reach in [p, q] {
                    let square = self.square(reach);
                    self.needs_more(square, size, NoConstruction::Concentric);
                }
                let (s, t) = (self.a.sign(p), self.a.sign(q));
                let sign = self.a.mul(s, t);
                let sign = self.a.mul(turns, sign);
                self.apex(way, [p, q], sign)
            }
        };
        Some(self.plus(origin, center))
    }

    /// Returns the point with these products with two unit vectors.
    fn meeting(&mut self, [m, n]: [V<A::N>; 2], [d, e]: [A::N; 2]) -> V<A::N> {
        let turn = self.cross(m, n);
        let (square, one) = (self.square(turn), self.a.constant(1.0));
        self.needs_more(square, one, NoConstruction::Parallel);
        let (x1, x2) = (self.a.mul(d, n[1]), self.a.mul(e, m[1]));
        let (y1, y2) = (self.a.mul(e, m[0]), self.a.mul(d, n[0]));
        let at = [self.a.sub(x1, x2), self.a.sub(y1, y2)];
        self.over(at, turn)
    }

    /// Returns the centre of a circle that touches a straight and something round; `turns` is 1 where the straight
    /// comes first and the circle runs to the left.
    fn beside(
        &mut self,
        (left, offset): (V<A::N>, A::N),
        (center, r): (V<A::N>, A::N),
        radius: A::N,
        turns: A::N,
    ) -> V<A::N> {
        let reach = self.a.sub(r, radius);
        let (square, size) = (self.square(reach), self.square(radius));
        self.needs_more(square, size, NoConstruction::Concentric);
        // from the round one's centre: so far to the left of the straight's direction, so far along it
        let (wanted, there) = (self.a.add(offset, radius), self.dot(left, center));
        let aside = self.a.sub(wanted, there);
        let (low, high) = (self.a.sub(reach, aside), self.a.add(reach, aside));
        let along = self.a.mul(low, high);
        let along = self.root(along, square, NoConstruction::Apart);
        let sign = self.a.sign(reach);
        let sign = self.a.mul(sign, turns);
        let along = self.a.mul(sign, along);
        // `left` turned a quarter to the right
        let back = self.left(left);
        let direction = [self.a.neg(back[0]), self.a.neg(back[1])];
        let at = self.further(center, aside, left);
        self.further(at, along, direction)
    }

    /// Returns where a circle that was built touches a figure.
    pub(crate) fn contact(
        &mut self,
        figure: Figure<A::N>,
        center: V<A::N>,
        radius: A::N,
    ) -> Option<V<A::N>> {
        match figure {
            Figure::Straight { .. } => {
                let ray = self.ray(figure)?;
                let back = self.a.neg(radius);
                Some(self.further(center, back, ray.left))
            }
            Figure::Point(at) => Some(at),
            Figure::Circle { center: c, radius: r } => {
                let (way, reach) = (self.minus(center, c), self.a.sub(r, radius));
                let part = self.a.div(r, reach);
                Some(self.further(c, part, way))
            }
            Figure::Arc { .. } => None,
        }
    }

    pub(crate) fn arc(
        &mut self,
        what: Construction,
        of: &[Figure<A::N>],
        numbers: &[A::N],
    ) -> Option<Figure<A::N>> {
        match (what, of, numbers) {
            (Construction::Fillet | Construction::ClockwiseFillet, [first, second], [radius]) => {
                let radius = match what {
                    Construction::ClockwiseFillet => self.a.neg(*radius),
                    _ => *radius,
                };
                let turn = match what {
                    Construction::ClockwiseFillet => self.a.neg(radius),
                    _ => radius,
                };
                self.needs(turn, NoConstruction::Turn);
                let center = self.touching_two(*first, *second, radius)?;
                let start = self.contact(*first, center, radius)?;
                let end = self.contact(*second, center, radius)?;
                // two straights leave one circle whatever their order is: the arc needs it
                let (u, v) = (self.minus(start, center), self.minus(end, center));
                let order = self.cross(u, v);
                let sign = self.a.sign(radius);
                let order = self.a.mul(order, sign);
                self.needs(order, NoConstruction::Order);
                Some(Figure::Arc { center, start, end })
            }
            (
                Construction::ArcThrough | Construction::ClockwiseArcThrough,
                [first, second, third],
                [],
            ) => {
                let (p, q, r) = (point(*first)?, point(*second)?, point(*third)?);
                let (u, v) = (self.minus(q, p), self.minus(r, p));
                let (a, b) = (self.dot(u, u), self.dot(v, v));
                let turn = self.cross(u, v);
                let (square, beside) = (self.square(turn), self.a.mul(a, b));
                self.way(p, q, NoConstruction::Coincident);
                self.way(q, r, NoConstruction::Coincident);
                self.way(r, p, NoConstruction::Coincident);
                self.needs_more(square, beside, NoConstruction::Collinear);
                let left = match what {
                    Construction::ArcThrough => turn,
                    _ => self.a.neg(turn),
                };
                self.needs(left, NoConstruction::Turn);
                // u · c = u² / 2, v · c = v² / 2
                let (d, e) = (self.half(a), self.half(b));
                let (x1, x2) = (self.a.mul(d, v[1]), self.a.mul(e, u[1]));
                let (y1, y2) = (self.a.mul(e, u[0]), self.a.mul(d, v[0]));
                let center = [self.a.sub(x1, x2), self.a.sub(y1, y2)];
                let center = self.over(center, turn);
                Some(Figure::Arc { center: self.plus(p, center), start: p, end: r })
            }
            _ => None,
        }
    }
}
