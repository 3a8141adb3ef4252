//! Constructions, and what each takes and makes.

/// A way to make a figure of others. Each says what it takes, figures first, then numbers.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Construction {
    /// A point so far from a point, in a direction: a point; a distance, an angle.
    Polar,
    /// Where two curves meet. Of two places the one where the second runs to the left across the first.
    Intersection,
    /// The place on a curve that is nearest to a point: the point, the curve.
    Projection,
    /// A straight from a point in a direction: a point; an angle.
    Directed,
    /// A straight so far to the left of another: a straight; a distance.
    Parallel,
    /// A straight through a point that runs as another does: a straight, a point.
    ParallelThrough,
    /// A straight through a point, a quarter turn to the left of another: a straight, a point.
    Perpendicular,
    /// The straight from a point to where it is projected on another: a point, a straight.
    PerpendicularFrom,
    /// The straight from a point to where it touches a circle: a point, a circle.
    TangentFrom,
    /// The straight from where it touches one circle to where it touches another: two circles.
    TangentToCircles,
    /// The straight that touches a circle and runs as another does: a circle, a straight.
    TangentAlong,
    /// The straight between two others that runs as both do on the whole: two straights.
    Bisector,
    /// The straight through the middle of two points, a quarter turn to the left of the way from the first to the
    /// second: two points.
    PerpendicularBisector,
    /// A circle around one point through another: two points.
    Around,
    /// The circle around a point that touches a curve, where that is nearer: a curve, a point.
    TangentAround,
    /// The circle that touches a curve where a point is projected on it: a curve, a point; a radius.
    TangentAt,
    /// The circle that touches two curves, or goes through points: two figures; a radius.
    TangentToTwo,
    /// The circle that touches three curves, or goes through points, in this order: three figures.
    TangentToThree,
    /// The arc to the left that touches two curves, from the first to the second: two figures; a radius.
    Fillet,
    /// The same arc, to the right.
    ClockwiseFillet,
    /// The arc to the left from a point through a second to a third: three points.
    ArcThrough,
    /// The same arc, to the right.
    ClockwiseArcThrough,
}

/// What a construction makes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Made {
    /// A point.
    Point,
    /// A straight.
    Straight,
    /// A circle.
    Circle,
    /// An arc.
    Arc,
}

impl Construction {
    /// Every construction.
    pub const ALL: [Self; 22] = [
        Self::Polar,
        Self::Intersection,
        Self::Projection,
        Self::Directed,
        Self::Parallel,
        Self::ParallelThrough,
        Self::Perpendicular,
        Self::PerpendicularFrom,
        Self::TangentFrom,
        Self::TangentToCircles,
        Self::TangentAlong,
        Self::Bisector,
        Self::PerpendicularBisector,
        Self::Around,
        Self::TangentAround,
        Self::TangentAt,
        Self::TangentToTwo,
        Self::TangentToThree,
        Self::Fillet,
        Self::ClockwiseFillet,
        Self::ArcThrough,
        Self::ClockwiseArcThrough,
    ];
    /// Returns how many figures and how many numbers it takes.
    pub fn takes(self) -> (usize, usize) {
        match self {
            Self::Polar => (1, 2),
            Self::Directed | Self::Parallel => (1, 1),
            Self::Intersection
            | Self::Projection
            | Self::ParallelThrough
            | Self::Perpendicular
            | Self::PerpendicularFrom
            | Self::TangentFrom
            | Self::TangentToCircles
            | Self::TangentAlong
            | Self::Bisector
            | Self::PerpendicularBisector
            | Self::Around
            | Self::TangentAround => (2, 0),
            Self::TangentAt | Self::TangentToTwo | Self::Fillet | Self::ClockwiseFillet => (2, 1),
            Self::TangentToThree | Self::ArcThrough | Self::ClockwiseArcThrough => (3, 0),
        }
    }
    /// Returns what it makes.
    pub fn makes(self) -> Made {
        match self {
            Self::Polar | Self::Intersection | Self::Projection => Made::Point,
            Self::Directed
            | Self::Parallel
            | Self::ParallelThrough
            | Self::Perpendicular
            | Self::PerpendicularFrom
            | Self::TangentFrom
            | Self::TangentToCircles
            | Self::TangentAlong
            | Self::Bisector
            | Self::PerpendicularBisector => Made::Straight,
            Self::Around
            | Self::TangentAround
            | Self::TangentAt
            | Self::TangentToTwo
            | Self::TangentToThree => Made::Circle,
            Self::Fillet | Self::ClockwiseFillet | Self::ArcThrough | Self::ClockwiseArcThrough => {
                Made::Arc
            }
        }
    }
}
