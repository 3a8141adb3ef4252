//! The ground floor: what every room of the house stands on.
//!
//! Five subjects and no sixth: [`id`] (identity in arenas), [`text`] (files and spans), [`diagnostic`] (what is
//! said to the user), [`number`] (the same bits on every machine), [`dice`] (chance that is the same in every run).
//!
//! ```
//! use base::{Diagnostic, FileId, Place, Span};
//! let place = Place { file: FileId(0), span: Span::new(4, 9) };
//! let d = Diagnostic::error("unknown-name", place, "no part named `cetner` in Rectangle")
//!     .hint("did you mean `center`?");
//! assert_eq!(d.code, "unknown-name");
//! ```
pub mod diagnostic;
pub mod dice;
pub mod id;
pub mod number;
pub mod text;

pub use diagnostic::{Diagnostic, Fix, Label, Severity};
pub use dice::{Dice, scrambled};
pub use id::{Id, IdVec, Mixer};
pub use text::{FileId, LineIndex, Name, Place, Span};
