//! Sparse kernels: patterns, pivots, LU, LDLᵀ and damped least squares.
//!
//! Scalar, every sum in one written order: the same bits everywhere. What is decided by structure
//! (pivots, fill) is decided once for a pattern; numbers are put in as often as they change.
pub(crate) mod pattern;

mod shelves;

pub(crate) mod pivot;

pub(crate) mod degree;

pub(crate) mod lu;

mod band;

pub(crate) mod ldl;

pub(crate) mod damped;

pub(crate) use ldl::{Ldl, Symmetric};
pub(crate) use lu::{Lu, Symbolic};
pub(crate) use pattern::Pattern;
