//! The circle that touches three figures: the problem of Apollonius, oriented.
//!
//! Seen as points (x, y, r) with the form `x² + y² - r²`, the circles that touch a straight coherently are a plane,
//! those that touch a circle a cone. The difference of two cones is a plane; so there is one cone (or plane) and two
//! planes, which meet in a line; on it lie two circles at most. They run through their contacts in opposite orders, so
//! that the order of the operands says which is meant; but where the three enclose a common point, in the same order:
//! there the smaller one is.
//!
//! **Source:** Cecil, *Lie sphere geometry*, Springer 2008, chapter 2.

use crate::algebra::Algebra;
use crate::build::NoConstruction;
use crate::figure::Figure;
use crate::work::{Touched, V, Work, place};

/// A plane of circles: `normal · (x, y, r) = offset`.
struct Plane<N> {
    normal: [N; 3],
    offset: N,
}

impl<A: Algebra> Work<'_, A> {
    pub(crate) fn touching_three(&mut self, figures: [Figure<A::N>; 3]) -> Option<(V<A::N>, A::N)> {
        let is_round = |f: &Figure<A::N>| matches!(f, Figure::Point(_) | Figure::Circle { .. });
        let base = figures.iter().position(is_round);
        let origin = place(figures[base.unwrap_or(0)]);
        let mut touched = Vec::new();
        for figure in figures {
            touched.push(self.touched(figure, origin)?);
        }
        let (mut planes, zero, one) = (Vec::new(), self.a.constant(0.0), self.a.constant(1.0));
        // the cone's own radius becomes 0: all others shrink by as much
        let shrink = match base.map(|b| touched[b]) {
            Some(Touched::Round { radius, .. }) => radius,
            Some(Touched::Straight { .. }) | None => zero,
        };
        for (i, t) in touched.iter().enumerate() {
            if base == Some(i) {
                continue;
            }
            planes.push(match *t {
                Touched::Straight { left, offset } => Plane {
                    normal: [left[0], left[1], self.a.neg(one)],
                    offset: self.a.add(offset, shrink),
                },
                Touched::Round { center, radius } => {
                    let radius = self.a.sub(radius, shrink);
                    let (p, q) = (self.dot(center, center), self.square(radius));
                    let twice = self.a.sub(p, q);
                    Plane {
                        normal: [center[0], center[1], self.a.neg(radius)],
                        offset: self.half(twice),
                    }
                }
            });
        }
        let solutions = match <[Plane<A::N>; 3]>::try_from(planes) {
            Ok(planes) => {
                let only = self.common(&planes);
                return Some((self.plus(origin, [only[0], only[1]]), only[2]));
            }
            Err(planes) => self.on_cone(&planes)?,
        };
        let mut found = Vec::new();
        for [x, y, r] in solutions {
            let radius = self.a.add(r, shrink);
            let order = self.order([x, y], radius, &touched);
            found.push(([x, y], radius, order));
        }
        let [(c1, r1, order), (c2, r2, other)] = <[_; 2]>::try_from(found).ok()?;
        let (s1, s2) = (self.square(r1), self.square(r2));
        let is_smaller = self.a.sub(s2, s1);
        // at least zero where the first is meant: it is in order, and smaller if the second is too
        let either = self.a.choose(other, is_smaller, order);
        let first = self.a.choose(order, either, order);
        let center = [self.a.choose(first, c1[0], c2[0]), self.a.choose(first, c1[1], c2[1])];
        let radius = self.a.choose(first, r1, r2);
        let order = self.a.choose(first, order, other);
        self.needs(order, NoConstruction::Order);
        let beside = self.square(radius);
        self.needs_radius(radius, beside);
        Some((self.plus(origin, center), radius))
    }

    /// Returns the point of three planes.
    fn common(&mut self, planes: &[Plane<A::N>; 3]) -> [A::N; 3] {
        let [p, q, r] = planes;
        let (qr, rp, pq) = (
            self.cross3(q.normal, r.normal),
            self.cross3(r.normal, p.normal),
            self.cross3(p.normal, q.normal),
        );
        let volume = self.dot3(p.normal, qr);
        let (square, one) = (self.square(volume), self.a.constant(1.0));
        self.needs_more(square, one, NoConstruction::Parallel);
        let mut at = [volume; 3];
        for (i, x) in at.iter_mut().enumerate() {
            let (a, b, c) = (
                self.a.mul(p.offset, qr[i]),
                self.a.mul(q.offset, rp[i]),
                self.a.mul(r.offset, pq[i]),
            );
            let sum = self.a.add(a, b);
            let sum = self.a.add(sum, c);
            *x = self.a.div(sum, volume);
        }
        let (radius, square) = (at[2], self.square(at[2]));
        let place = self.dot([at[0], at[1]], [at[0], at[1]]);
        let beside = self.a.add(square, place);
        self.needs_radius(radius, beside);
        at
    }

    /// Returns the two points of two planes on the cone `x² + y² = r²`.
    fn on_cone(&mut self, planes: &[Plane<A::N>]) -> Option<[[A::N; 3]; 2]> {
        let [p, q] = planes else { return None };
        let along = self.cross3(p.normal, q.normal);
        let (pp, qq) = (self.dot3(p.normal, p.normal), self.dot3(q.normal, q.normal));
        let (square, beside) = (self.dot3(along, along), self.a.mul(pp, qq));
        self.needs_more(square, beside, NoConstruction::Collinear);
        // the point of the line that is nearest to the origin
        let (u, v) = (self.cross3(q.normal, along), self.cross3(along, p.normal));
        let mut from = [square; 3];
        for (i, x) in from.iter_mut().enumerate() {
            let (a, b) = (self.a.mul(p.offset, u[i]), self.a.mul(q.offset, v[i]));
            let sum = self.a.add(a, b);
            *x = self.a.div(sum, square);
        }
        let size = self.a.sqrt(square);
        let along = along.map(|x| self.a.div(x, size));
        // a t² + 2 b t + c = 0
        let (a, b, c) = (self.form(along, along), self.form(from, along), self.form(from, from));
        let (bb, ac) = (self.square(b), self.a.mul(a, c));
        let square = self.a.sub(bb, ac);
        let root = self.root(square, bb, NoConstruction::Apart);
        let roots = [root, self.a.neg(root)].map(|root| {
            // (root - b) / a, and where both have one sign c / (-root - b): nothing cancels
            let (over, under) = (self.a.sub(root, b), self.a.add(root, b));
            let under = self.a.neg(under);
            let (first, second) = (self.a.div(over, a), self.a.div(c, under));
            let alike = self.a.mul(root, b);
            let alike = self.a.neg(alike);
            self.a.choose(alike, first, second)
        });
        Some(roots.map(|t| {
            let way = along.map(|x| self.a.mul(x, t));
            [0, 1, 2].map(|i| self.a.add(from[i], way[i]))
        }))
    }

    /// Returns a number that is positive where a circle runs through its three contacts in their order.
    fn order(&mut self, center: V<A::N>, radius: A::N, touched: &[Touched<A::N>]) -> A::N {
        let mut contacts = Vec::new();
        for t in touched {
            contacts.push(match *t {
                Touched::Straight { left, .. } => [self.a.neg(left[0]), self.a.neg(left[1])],
                Touched::Round { center: c, radius: r } => {
                    let (way, reach) = (self.minus(center, c), self.a.sub(r, radius));
                    self.over(way, reach)
                }
            });
        }
        let (u, v) = (self.minus(contacts[1], contacts[0]), self.minus(contacts[2], contacts[0]));
        let (turn, sign) = (self.cross(u, v), self.a.sign(radius));
        self.a.mul(turn, sign)
    }

    fn cross3(&mut self, p: [A::N; 3], q: [A::N; 3]) -> [A::N; 3] {
        [0, 1, 2].map(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            self.cross([p[j], p[k]], [q[j], q[k]])
        })
    }
    fn dot3(&mut self, p: [A::N; 3], q: [A::N; 3]) -> A::N {
        let (xy, z) = (self.dot([p[0], p[1]], [q[0], q[1]]), self.a.mul(p[2], q[2]));
        self.a.add(xy, z)
    }
    /// Returns `x x' + y y' - r r'`.
    fn form(&mut self, p: [A::N; 3], q: [A::N; 3]) -> A::N {
        let (xy, z) = (self.dot([p[0], p[1]], [q[0], q[1]]), self.a.mul(p[2], q[2]));
        self.a.sub(xy, z)
    }
}
