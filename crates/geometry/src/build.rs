//! Building: operands in, a figure and the margins by which it exists out.

use crate::algebra::{Algebra, Plain};
use crate::construction::Construction;
use crate::figure::Figure;
use crate::work::Work;

/// Why a construction has no answer.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum NoConstruction {
    /// It takes other operands.
    Operands,
    /// A straight has no length, so that it runs nowhere.
    NoDirection,
    /// Points that have to differ coincide.
    Coincident,
    /// Straights run the same way, or opposite ways.
    Parallel,
    /// Straights run opposite ways.
    Opposite,
    /// A radius is zero.
    NoRadius,
    /// Two circles have one centre, or a circle would have the centre of what it has to touch.
    Concentric,
    /// Curves are too far from each other, or one lies inside the other.
    Apart,
    /// A point lies on the wrong side of a circle for its tangent.
    Inside,
    /// Three points lie on one straight.
    Collinear,
    /// Nothing touches the figures in this order, running as they do.
    Order,
    /// The arc would run the other way round.
    Turn,
    /// A number has no value, or is larger than any number can be.
    NotFinite,
}

impl NoConstruction {
    /// Returns the reason in words, as the end of a sentence.
    pub fn words(self) -> &'static str {
        match self {
            Self::Operands => "it takes other operands",
            Self::NoDirection => "a line has no length, so it has no direction",
            Self::Coincident => "two points coincide",
            Self::Parallel => "the lines are parallel",
            Self::Opposite => "the lines run opposite ways",
            Self::NoRadius => "a radius is zero",
            Self::Concentric => "two circles have one centre",
            Self::Apart => "the curves do not reach each other in this orientation",
            Self::Inside => "the point or circle lies inside the circle",
            Self::Collinear => "three points lie on one line",
            Self::Order => "nothing touches the curves in this order and orientation",
            Self::Turn => "the arc runs the other way round",
            Self::NotFinite => "a number has no value",
        }
    }
}

/// What a construction made.
#[derive(Clone, PartialEq, Debug)]
pub struct Built<N> {
    /// The figure; its numbers mean nothing where a margin is negative.
    pub figure: Figure<N>,
    /// Numbers that are zero at least, each with why there is no figure where it is less.
    pub margins: Vec<(N, NoConstruction)>,
}

/// Builds a construction of figures and numbers.
///
/// # Errors
/// It takes other operands.
pub fn build<A: Algebra>(
    a: &mut A,
    what: Construction,
    of: &[Figure<A::N>],
    numbers: &[A::N],
) -> Result<Built<A::N>, NoConstruction> {
    if (of.len(), numbers.len()) != what.takes() {
        return Err(NoConstruction::Operands);
    }
    let mut w = Work::new(a);
    let figure = match what {
        Construction::Polar | Construction::Intersection | Construction::Projection => {
            w.point(what, of, numbers)
        }
        Construction::Directed
        | Construction::Parallel
        | Construction::ParallelThrough
        | Construction::Perpendicular
        | Construction::PerpendicularFrom
        | Construction::TangentFrom
        | Construction::TangentToCircles
        | Construction::TangentAlong
        | Construction::Bisector
        | Construction::PerpendicularBisector => w.straight(what, of, numbers),
        Construction::Around
        | Construction::TangentAround
        | Construction::TangentAt
        | Construction::TangentToTwo
        | Construction::TangentToThree => w.circle(what, of, numbers),
        Construction::Fillet
        | Construction::ClockwiseFillet
        | Construction::ArcThrough
        | Construction::ClockwiseArcThrough => w.arc(what, of, numbers),
    };
    let figure = figure.ok_or(NoConstruction::Operands)?;
    Ok(Built { figure, margins: w.margins })
}

/// Computes a construction of figures and numbers.
///
/// # Errors
/// Why there is no answer.
pub fn construct(
    what: Construction,
    of: &[Figure<f64>],
    numbers: &[f64],
) -> Result<Figure<f64>, NoConstruction> {
    let given = of.iter().flat_map(Figure::numbers).chain(numbers.iter().copied());
    if !given.into_iter().all(f64::is_finite) {
        return Err(NoConstruction::NotFinite);
    }
    let built = build(&mut Plain, what, of, numbers)?;
    // the first reason explains those after it; a margin without a value is none that is met
    if let Some((_, why)) =
        built.margins.iter().find(|(margin, _)| margin.is_nan() || *margin < 0.0)
    {
        return Err(*why);
    }
    match built.figure.numbers().iter().all(|x| x.is_finite()) {
        true => Ok(built.figure.without_negative_zero()),
        false => Err(NoConstruction::NotFinite),
    }
}

impl Figure<f64> {
    /// Returns the figure with every negative zero made a plain one: it is never stored.
    fn without_negative_zero(self) -> Self {
        let plain = |p: [f64; 2]| p.map(|x| x + 0.0);
        match self {
            Self::Point(at) => Self::Point(plain(at)),
            Self::Straight { from, to } => Self::Straight { from: plain(from), to: plain(to) },
            Self::Circle { center, radius } => {
                Self::Circle { center: plain(center), radius: radius + 0.0 }
            }
            Self::Arc { center, start, end } => {
                Self::Arc { center: plain(center), start: plain(start), end: plain(end) }
            }
        }
    }
}
