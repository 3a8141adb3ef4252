//! Oriented geometry: figures, and the constructions that make one of others.
//!
//! Three nouns. A [`Figure`] is an oriented point, straight, circle or arc; a [`Construction`] is a way to make
//! one of others; what is [`Built`] is a figure and the margins by which it exists. Every closed form is written
//! once, over an [`Algebra`]: [`Plain`] computes numbers, the planner's builds expressions, so that what is drawn
//! and what is solved are the same formula.
//!
//! ```
//! use geometry::{Construction, Figure, Plain, construct};
//! let floor = Figure::Straight { from: [0.0, 0.0], to: [1.0, 0.0] };
//! let axis = Figure::Straight { from: [0.0, 0.0], to: [0.0, 1.0] };
//! let ring = construct(Construction::TangentToTwo, &[floor, axis], &[40.0]);
//! assert_eq!(ring, Ok(Figure::Circle { center: [-40.0, 40.0], radius: 40.0 }));
//! // the next one rolls between it, turned round, and the axis
//! let below = ring.unwrap().reversed(&mut Plain);
//! let Ok(Figure::Circle { center: [x, y], .. }) =
//!     construct(Construction::TangentToTwo, &[below, axis], &[20.0]) else { panic!() };
//! assert!((x + 20.0).abs() < 1e-12 && (y - 96.568_542_494_923_8).abs() < 1e-9);
//! ```
//!
//! # Orientation
//! A straight runs from its first to its second point; a circle runs to the left around its centre where its radius
//! is positive, to the right where it is negative. Two curves touch *coherently*: where they meet they run the same
//! way. So the centre of a circle of radius r that touches a straight lies r to its left, and two circles that touch
//! have centres |r₁ - r₂| apart. Where two mirror answers are left the order of the operands decides: along the new
//! circle, from the first contact to the second is less than half a turn.
//!
//! A region is what contours of segments and arcs surround. Regions are combined and offset as numbers alone
//! ([`combine`], [`offset`]), contours made of edges and edges found by what they come from ([`contour`],
//! [`edges_from`]): how many edges an outcome has depends on values, so that there is no formula for it.
//!
//! Invariants:
//! - a construction has one answer, or says why it has none;
//! - no answer depends on where a pointer was, nor on which of the figures is drawn first;
//! - figures are moved to the first operand before anything is computed, so that far away is as exact as near.
mod algebra;
mod build;
mod circles;
mod construction;
mod contour;
mod figure;
mod lines;
mod points;
mod region;
mod three;
mod work;

pub use algebra::{Algebra, Plain};
pub use build::{Built, NoConstruction, build, construct};
pub use construction::{Construction, Made};
pub use contour::{
    NoContour, Side, Source, contour, edges_from, edges_of, extent, meets, order, sides_of,
};
pub use figure::Figure;
pub use region::{Bend, Combination, NoRegion, Ring, Surface, combine, offset};
