//! Figures: what constructions take and make.

use crate::algebra::Algebra;

/// An oriented figure; lengths are in sheet units, y runs up.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Figure<N> {
    /// A point; a circle of radius 0 where something touches it.
    Point([N; 2]),
    /// A straight through two points, from the first to the second; it goes on beyond them.
    Straight {
        /// Where it begins.
        from: [N; 2],
        /// Where it goes to.
        to: [N; 2],
    },
    /// A circle, to the left around its centre where its radius is positive.
    Circle {
        /// Its centre.
        center: [N; 2],
        /// Its radius; negative where it runs to the right.
        radius: N,
    },
    /// A part of a circle, made by a construction: which way it runs is said by that.
    Arc {
        /// The circle's centre.
        center: [N; 2],
        /// Where it begins.
        start: [N; 2],
        /// Where it ends.
        end: [N; 2],
    },
}

impl<N: Copy> Figure<N> {
    /// Returns the same figure, turned round.
    #[must_use]
    pub fn reversed(self, a: &mut impl Algebra<N = N>) -> Self {
        match self {
            Self::Point(at) => Self::Point(at),
            Self::Straight { from, to } => Self::Straight { from: to, to: from },
            Self::Circle { center, radius } => Self::Circle { center, radius: a.neg(radius) },
            Self::Arc { center, start, end } => Self::Arc { center, start: end, end: start },
        }
    }
    /// Returns the same figure of other numbers, made of its own in the order in which they are declared.
    pub fn map<M>(self, mut of: impl FnMut(N) -> M) -> Figure<M> {
        match self {
            Self::Point(at) => Figure::Point(at.map(of)),
            Self::Straight { from, to } => {
                Figure::Straight { from: from.map(&mut of), to: to.map(of) }
            }
            Self::Circle { center, radius } => {
                Figure::Circle { center: center.map(&mut of), radius: of(radius) }
            }
            Self::Arc { center, start, end } => Figure::Arc {
                center: center.map(&mut of),
                start: start.map(&mut of),
                end: end.map(of),
            },
        }
    }
    /// Returns its numbers, in the order in which they are declared.
    pub fn numbers(&self) -> Vec<N> {
        match *self {
            Self::Point(at) => at.to_vec(),
            Self::Straight { from, to } => [from, to].concat(),
            Self::Circle { center: [x, y], radius } => vec![x, y, radius],
            Self::Arc { center, start, end } => [center, start, end].concat(),
        }
    }
}
