//! The value of any expression on things: the reference semantics, pictures, and the checker.
//!
//! Three nouns. An [`Evaluator`] stands in one state of a document and computes the [`Answer`] of
//! any [`kernel::Term`] read in any of its things. What has no value is a [`Fault`] that says what
//! was found and what was wanted; nothing here panics or runs for ever. A [`Picture`] is what the
//! document's things answer to `picture`, with what each element stands for.
//!
//! ```
//! use eval::{Evaluator, Fault, given_values};
//! use kernel::{DOCUMENT, Document, Term, instantiate};
//!
//! fn shown(document: &Document, term: &Term) -> Result<String, Fault> {
//!     let (structure, _) = instantiate(document);
//!     let (values, _) = given_values(document, &structure);
//!     let evaluator = Evaluator::new(document, &structure, &values);
//!     let answer = evaluator.evaluate(term, DOCUMENT)?;
//!     Ok(evaluator.text_of(&answer))
//! }
//! ```
//!
//! [`checker`] tests states and edits from the rules alone; it shares no code with planner or solver.
//!
//! **Invariants**: numbers in answers are finite; evaluation writes nothing; the same state gives
//! the same bits; messages call each other at most [`DEEPEST_MESSAGES`] deep.
//!
//! Reading order: `answer`, `evaluator`, `lookup`, `operate`, `measure`, `send`, `make`, `compare`,
//! `builtin`, `shapes`, `verdict`, `sway`, `write`, `given`, [`programs`], `replay`, `picture`, `scene`, [`checker`].
mod answer;
mod builtin;
pub mod checker;
mod compare;
mod construct;
mod culprit;
mod evaluator;
mod fault;
mod fixed;
mod given;
mod lookup;
mod make;
mod measure;
mod numerals;
mod operate;
mod picture;
pub mod programs;
mod replay;
mod rings;
mod scene;
mod send;
mod shapes;
mod sway;
mod texts;
mod verdict;
mod write;

pub use answer::{Answer, Closure, Made};
pub use culprit::Culprit;
pub use evaluator::{DEEPEST_MESSAGES, Evaluator};
pub use fault::{Fault, FaultKind};
pub use given::given_values;
pub use lookup::Known;
pub use picture::{Grip, Picture};
pub use programs::{Context, Ended, Entry, Standing, Why, allowed_table};
pub use replay::Measures;
pub use scene::{Moved, Scene};
pub use verdict::Verdict;
pub use write::Side;
