//! A drawing: exact curves and text in layers, the only way out to painters and writers.
//!
//! Coordinates are in the document's units of length on the sheet; `y` runs as the drawing says.
//! Every element has a [`Tag`], which the session maps to the path of a thing.
//!
//! Reading order: [`element`], [`metrics`], [`curve`], [`spline`], [`nurbs`], [`measure`], [`mod@bounds`], [`svg`], [`dxf`].
pub mod bounds;
pub mod color;
pub mod curve;
pub mod dxf;
pub mod element;
pub mod measure;
pub mod metrics;
pub mod nurbs;
pub mod spline;
pub mod svg;

pub use bounds::{Bounds, bounds, bounds_of};
pub use color::{color_of, components};
pub use element::{
    Anchoring, Color, Corner, Dimension, DimensionKind, Drawing, Element, Layer, Lie, Line,
    Placement, Point, Shape, Style, Tag, Vertical,
};
