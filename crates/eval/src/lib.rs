//! The value of any expression on things: the reference semantics, pictures, and the checker.
//!
//! Three nouns. An [`Evaluator`] stands in one state of a document and computes the [`Answer`] of
//! any [`kernel::Term`] read in any of its things. What has no value is a [`Fault`] that says what
//! was found and what was wanted; nothing here panics or runs for ever. A [`Picture`] is what the
//! document's things answer to `picture`, with what each element stands for.
//!
//! [`checker`] tests states and edits from the rules alone; it shares no code with planner or solver.
//!
//! **Invariants**: numbers in answers are finite; evaluation writes nothing; the same state gives
//! the same bits; messages call each other at most [`DEEPEST_MESSAGES`] deep.
//!
//! Reading order: `answer`, `evaluator`, `send`, `make`, `compare`, `builtin`, `shapes`, `verdict`,
//! `write`, `picture`, [`checker`].
mod answer;
mod builtin;
pub mod checker;
mod compare;
mod evaluator;
mod fault;
mod make;
mod measure;
mod picture;
mod send;
mod shapes;
mod verdict;
mod write;

pub use answer::{Answer, Closure, Made};
pub use evaluator::{DEEPEST_MESSAGES, Evaluator, MOST_TERMS};
pub use fault::{Fault, FaultKind};
pub use picture::{Grip, Picture};
pub use verdict::Verdict;
pub use write::given_values;
