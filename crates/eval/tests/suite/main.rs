//! Evaluation, pictures, verdicts and the checker, on documents built by hand.

mod build;
// what only the room itself knows stands beside its tests, and is compiled with them here
#[path = "../../src/checker/blocks.rs"]
mod blocks;
#[path = "../../src/measure.rs"]
mod measure;
#[path = "../../src/numerals.rs"]
mod numerals;
#[path = "../../src/rings.rs"]
mod rings;

/// What these files know of the room.
mod fault {
    pub(crate) use eval::{Fault, FaultKind};
}

mod check;
mod express;
mod paint;
mod rules;
mod wishes;
