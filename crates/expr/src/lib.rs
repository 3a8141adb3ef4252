//! Expressions of numbers: hash-consed arena, simplify, isolate, derivatives, dimensions, tape.
pub mod dimension;
