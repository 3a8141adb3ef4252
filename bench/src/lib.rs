//! Figures: sketches solved and measured, beside a peer and beside plain Rust.
//!
//! A [`case::Case`] is a sketch as its file says it; [`document::text`] writes it as a document made of
//! the library's classes; a [`sketch::Sketch`] is that document with its things made, and solves by the
//! rooms that every document is solved by. [`residual::largest`] tests what came out against the case
//! alone. Nothing here is a second solver.
//!
//! Reading order: [`case`], [`document`], [`opened`], [`sketch`], [`residual`], [`measure`], [`displaced`],
//! [`report`], [`families`], [`documents`], [`browser`].
pub mod browser;
pub mod case;
pub mod displaced;
pub mod document;
pub mod documents;
pub mod families;
pub mod measure;
pub mod opened;
#[cfg(feature = "ezpz")]
pub mod peer;
pub mod report;
pub mod residual;
pub mod sketch;
