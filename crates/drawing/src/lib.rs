//! A drawing: exact curves and text in layers, the only way out to painters and writers.
//!
//! Coordinates are in the document's units of length on the sheet; `y` runs as the drawing says.
//! Every element has a [`Tag`](element::Tag), which the session maps to the path of a thing.
pub mod element;

pub use element::{
    Anchoring, Color, Drawing, Element, Layer, Line, Placement, Point, Shape, Style, Tag, Vertical,
};
