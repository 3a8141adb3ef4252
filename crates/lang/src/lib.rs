//! Text and things: names, dimensions, checking; what a text means, and the smallest edits of it.
//!
//! Three nouns. [`lower`] turns a text into [`Lowered`]: a `kernel::Document`, its checks, and
//! [`Origins`], which know where every member was written. [`write_values`] and [`edits_for`] go the
//! other way: from values and Commands to the smallest edits of the text.
//!
//! ```
//! use kernel::{Literal, Path};
//! let text = "a: Real = 1  // one\nb: Real\nconstraint b = 2 * a\n";
//! let lowered = lang::lower(text, &|_| None, None);
//! assert!(lowered.diagnostics.is_empty());
//! let edits = lang::write_values(&lowered, &[(Path::of(&["a"]), Literal::Number(3.0))]);
//! let written = syntax::edit::apply(text, &edits);
//! assert_eq!(written, "a: Real = 3  // one\nb: Real\nconstraint b = 2 * a\n");
//! ```
//!
//! **Invariants**: lowering never fails; a member with an error is left out, or what it said before
//! stays in force; reading a number that was written gives its bits.
//!
//! Reading order: `origins`, `lower`, `lowering`, `files`, `tables`, `visible`, `classes`, `scope`, `members`, `programs`, `families`, `loops`,
//! `rules`, `switches`, `kept`, `names`, `hints`, `paths`, `refine`, `terms`, `components`, `calls`, `functions`, `kin`, `kinds`,
//! `settle`, `restore`,
//! `alone`, `checks`, `lessons`, `views`,
//! `numbers`, `operations`, `mixed`, `quotients`, `narrower`, `write`, `uses`,
//! `edits`, `references`, `mentions`.
mod alone;
mod angles;
mod answers;
mod bindings;
mod calls;
mod checks;
mod choices;
mod classes;
mod colours;
mod components;
mod connections;
mod constraints;
mod counts;
mod edits;
mod ends;
mod families;
mod files;
mod functions;
mod handles;
mod hints;
mod inserts;
mod kept;
mod kin;
mod kinds;
mod lengths;
mod lessons;
mod loops;
mod lower;
mod lowering;
mod members;
mod mentions;
mod misread;
mod mixed;
mod names;
mod narrower;
mod numbers;
mod operations;
mod origins;
mod outwards;
mod paths;
mod placed;
mod programs;
mod quotients;
mod references;
mod refine;
mod replaced;
mod restore;
mod rewritten;
mod rings;
mod rules;
mod scale;
mod scope;
mod settle;
mod statics;
mod switches;
pub mod tables;
mod terms;
mod trails;
mod twice;
mod uses;
mod views;
mod visible;
mod write;

pub use alone::{Alone, read_alone};
pub use checks::{Check, Counted, Expectation, PlanKind, Statement, StatementKind, without_checks};
pub use edits::{
    Restructuring, edits_for, edits_to_delete, for_every, is_count, of_constraint, write_sides,
};
pub use families::{Family, Row as FamilyRow};
pub use files::File;
pub use kinds::with_article;
pub use lessons::{Goal, Lesson, LessonStep, Task};
pub use lower::{Lowered, lower, lower_asking, lower_written, mentions};
pub use lowering::Lowering;
pub use mentions::{Meant, Mention};
pub use mixed::is_unit_of_sheet;
pub use numbers::{Wanted, read_literal, show_limit, unit_typed};
pub use origins::Origins;
pub use placed::PLACED;
pub use terms::operator_of;
pub use views::{PlotOf, Toolbox};
pub use write::{quoted, write_rounded, write_unit, write_values};
