//! What closed forms have in common: vectors, directions, margins.

use crate::algebra::Algebra;
use crate::build::NoConstruction;
use crate::figure::Figure;

/// How small is nothing, as a part of what is looked at.
const NOTHING: f64 = 1e-12;

/// A vector.
pub(crate) type V<N> = [N; 2];

/// Two points.
pub(crate) type Ends<A> = (V<<A as Algebra>::N>, V<<A as Algebra>::N>);

/// A straight by a point of it and its direction, of length 1.
#[derive(Clone, Copy)]
pub(crate) struct Ray<N> {
    pub(crate) from: V<N>,
    pub(crate) along: V<N>,
    /// A quarter turn to the left.
    pub(crate) left: V<N>,
    pub(crate) length: N,
}

/// What can be touched, the origin moved.
#[derive(Clone, Copy)]
pub(crate) enum Touched<N> {
    /// A straight: `left · p = offset` for its points.
    Straight { left: V<N>, offset: N },
    /// A circle, or a point of radius 0.
    Round { center: V<N>, radius: N },
}

/// A construction at work.
pub(crate) struct Work<'a, A: Algebra> {
    pub(crate) a: &'a mut A,
    pub(crate) margins: Vec<(A::N, NoConstruction)>,
}

impl<'a, A: Algebra> Work<'a, A> {
    pub(crate) fn new(a: &'a mut A) -> Self {
        Self { a, margins: Vec::new() }
    }
    pub(crate) fn plus(&mut self, p: V<A::N>, q: V<A::N>) -> V<A::N> {
        [self.a.add(p[0], q[0]), self.a.add(p[1], q[1])]
    }
    pub(crate) fn minus(&mut self, p: V<A::N>, q: V<A::N>) -> V<A::N> {
        [self.a.sub(p[0], q[0]), self.a.sub(p[1], q[1])]
    }
    pub(crate) fn times(&mut self, p: V<A::N>, k: A::N) -> V<A::N> {
        [self.a.mul(p[0], k), self.a.mul(p[1], k)]
    }
    pub(crate) fn over(&mut self, p: V<A::N>, k: A::N) -> V<A::N> {
        [self.a.div(p[0], k), self.a.div(p[1], k)]
    }
    /// Returns `p + k q`.
    pub(crate) fn further(&mut self, p: V<A::N>, k: A::N, q: V<A::N>) -> V<A::N> {
        let way = self.times(q, k);
        self.plus(p, way)
    }
    pub(crate) fn dot(&mut self, p: V<A::N>, q: V<A::N>) -> A::N {
        let (x, y) = (self.a.mul(p[0], q[0]), self.a.mul(p[1], q[1]));
        self.a.add(x, y)
    }
    /// Returns the area that two vectors span, positive where the second turns left.
    pub(crate) fn cross(&mut self, p: V<A::N>, q: V<A::N>) -> A::N {
        let (x, y) = (self.a.mul(p[0], q[1]), self.a.mul(p[1], q[0]));
        self.a.sub(x, y)
    }
    /// Turns a vector a quarter to the left.
    pub(crate) fn left(&mut self, p: V<A::N>) -> V<A::N> {
        [self.a.neg(p[1]), p[0]]
    }
    pub(crate) fn square(&mut self, x: A::N) -> A::N {
        self.a.mul(x, x)
    }
    pub(crate) fn length(&mut self, p: V<A::N>) -> A::N {
        let square = self.dot(p, p);
        self.a.sqrt(square)
    }
    pub(crate) fn half(&mut self, x: A::N) -> A::N {
        let half = self.a.constant(0.5);
        self.a.mul(x, half)
    }
    pub(crate) fn middle(&mut self, p: V<A::N>, q: V<A::N>) -> V<A::N> {
        let half = self.a.constant(0.5);
        let way = self.minus(q, p);
        self.further(p, half, way)
    }
    /// Notes that a number has to be zero at least.
    pub(crate) fn needs(&mut self, margin: A::N, else_: NoConstruction) {
        self.margins.push((margin, else_));
    }
    /// Notes that a square has to be more than nothing beside another.
    pub(crate) fn needs_more(&mut self, square: A::N, beside: A::N, else_: NoConstruction) {
        let nothing = self.a.constant(NOTHING * NOTHING);
        let least = self.a.mul(nothing, beside);
        let margin = self.a.sub(square, least);
        self.needs(margin, else_);
        // nothing beside nothing is none either
        let tiny = self.a.constant(f64::MIN_POSITIVE);
        let margin = self.a.sub(square, tiny);
        self.needs(margin, else_);
    }
    /// Returns a square root, and notes that there has to be one: what is below zero by rounding is zero.
    pub(crate) fn root(&mut self, square: A::N, beside: A::N, else_: NoConstruction) -> A::N {
        let rounding = self.a.constant(NOTHING);
        let slack = self.a.mul(rounding, beside);
        let margin = self.a.add(square, slack);
        self.needs(margin, else_);
        self.a.sqrt(square)
    }
    /// Notes that two points have to differ; returns the way from one to the other and its length.
    pub(crate) fn way(&mut self, p: V<A::N>, q: V<A::N>, else_: NoConstruction) -> (V<A::N>, A::N) {
        let way = self.minus(q, p);
        let (square, a, b) = (self.dot(way, way), self.dot(p, p), self.dot(q, q));
        let beside = self.a.add(a, b);
        self.needs_more(square, beside, else_);
        (way, self.a.sqrt(square))
    }
    /// Reads a straight.
    pub(crate) fn ray(&mut self, figure: Figure<A::N>) -> Option<Ray<A::N>> {
        let Figure::Straight { from, to } = figure else { return None };
        let (way, length) = self.way(from, to, NoConstruction::NoDirection);
        let along = self.over(way, length);
        let left = self.left(along);
        Some(Ray { from, along, left, length })
    }
    /// Reads a circle, or a point as one of radius 0.
    pub(crate) fn round(&mut self, figure: Figure<A::N>) -> Option<(V<A::N>, A::N)> {
        match figure {
            Figure::Point(at) => Some((at, self.a.constant(0.0))),
            Figure::Circle { center, radius } => Some((center, radius)),
            Figure::Straight { .. } | Figure::Arc { .. } => None,
        }
    }
    /// Reads what can be touched, seen from an origin.
    pub(crate) fn touched(
        &mut self,
        figure: Figure<A::N>,
        origin: V<A::N>,
    ) -> Option<Touched<A::N>> {
        match figure {
            Figure::Straight { .. } => {
                let ray = self.ray(figure)?;
                let from = self.minus(ray.from, origin);
                let offset = self.dot(ray.left, from);
                Some(Touched::Straight { left: ray.left, offset })
            }
            Figure::Point(_) | Figure::Circle { .. } => {
                let (center, radius) = self.round(figure)?;
                Some(Touched::Round { center: self.minus(center, origin), radius })
            }
            Figure::Arc { .. } => None,
        }
    }
    /// Notes that a radius has to be more than nothing beside a length.
    pub(crate) fn needs_radius(&mut self, radius: A::N, beside: A::N) {
        let square = self.square(radius);
        self.needs_more(square, beside, NoConstruction::NoRadius);
    }
}

/// Reads a point.
pub(crate) fn point<N: Copy>(figure: Figure<N>) -> Option<V<N>> {
    match figure {
        Figure::Point(at) => Some(at),
        Figure::Straight { .. } | Figure::Circle { .. } | Figure::Arc { .. } => None,
    }
}

/// Returns a place that a figure is near to.
pub(crate) fn place<N: Copy>(figure: Figure<N>) -> V<N> {
    match figure {
        Figure::Point(at) => at,
        Figure::Straight { from, .. } => from,
        Figure::Circle { center, .. } | Figure::Arc { center, .. } => center,
    }
}
