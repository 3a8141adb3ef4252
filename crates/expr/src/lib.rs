//! Expressions of numbers: hash-consed arena, simplify, isolate, derivatives, dimensions, tape.
pub mod arena;
pub mod derivative;
pub mod dimension;
pub mod isolate;
pub mod op;
mod polynomial;
pub mod tape;
pub mod units;

pub use arena::{Arena, ExprId, Node, Var};
pub use derivative::{derivative, gradient};
pub use dimension::Dimension;
pub use isolate::{Guard, Root, is_linear_in, isolate};
pub use op::{Binary, Unary};
pub use tape::Tape;
