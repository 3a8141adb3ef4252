//! Anonymous equations and unknowns: who may yield, which way, how much. No things.
//!
//! A [`System`] is one connected component: slots with their stays, relations with their strengths
//! and methods. [`plan()`] makes a [`Plan`] of it once, without looking at a value; [`run()`] takes it
//! through an edit and [`Drag`] through a drag, for any values.
//!
//! ```
//! use solve::{Level, NoHost, Patterns, Relation, RelationBody, Runner, Slot, Stay, System};
//! // 1.8 c + 32 = f, over argument 0 and argument 1
//! let mut arena = expr::Arena::new();
//! let (c, f) = (arena.var(expr::Var(0)), arena.var(expr::Var(1)));
//! let (factor, offset) = (arena.constant(1.8), arena.constant(32.0));
//! let scaled = arena.mul(c, factor);
//! let left = arena.add(scaled, offset);
//! let mut patterns = Patterns::default();
//! let (pattern, _) = patterns.intern(&arena, &[left, f]);
//! // celsius is set, fahrenheit follows
//! let mut system = System::default();
//! let slot = |stay| Slot { stay, scale: 0, is_number: true, is_discrete: false };
//! system.slots = vec![slot(Stay::Fixed), slot(Stay::Kept { group: 0 })];
//! let equations = system.add_equations([(pattern, [0, 1])]);
//! system.relations = vec![Relation {
//!     level: Level::Required,
//!     body: RelationBody::Equations(equations),
//!     methods: Default::default(),
//!     derived: true,
//!     reads: Default::default(),
//!     within: Default::default(),
//!     source: 0,
//!     rests: false,
//! }];
//! let plan = solve::plan(&system.into(), &patterns);
//! let mut values = [100.0, 68.0];
//! let outcome =
//!     solve::run(&plan, &mut Runner::new(), &[20.0, 68.0], &mut values, &[0], &mut NoHost);
//! assert!(outcome.is_solved());
//! assert_eq!(values, [100.0, 212.0]);
//! ```
//!
//! Invariants: equal systems have equal plans; a run that is refused changes nothing; what is not
//! downstream of a change keeps its bits; a second run changes no bit; no value is ever infinite or
//! not a number.
pub mod few;
pub mod pattern;
pub mod seldom;
pub mod system;

mod lists;
mod stated;
mod substitute;
mod union;

pub mod proof;

mod number;
mod residue;
mod rest;

mod tableau;

pub mod echelon;

mod rows;

mod accept;
mod exact;
mod matching;
mod tie;

mod deflate;
mod direct;

mod order;
mod peel;
mod view;

pub mod plan;

mod kernel;

mod lanes;

mod follows;
mod lower;

mod block;

mod dense;
mod sparse;

mod square;

mod least;
mod measure;

mod joint;

pub mod outcome;

mod strip;

mod slice;
mod test;

mod attempt;

pub mod fork;

pub mod run;

mod moved;

pub mod conditional;

mod truth;

pub mod pieces;

pub mod modes;

pub mod search;

pub mod whole;

pub use attempt::others::Other;
pub use conditional::{Condition, Conditional, Demand, DemandKind, Guard, SlotRange};
pub use few::Few;
pub use fork::Lean;
pub use modes::{
    Decision, Ended, Mode, Modes, Standing, Tried, decide, decide_along, decide_nearest_pieces,
    decide_pieces,
};
pub use moved::{Moved, moved};
pub use outcome::{Host, NoHost, Note, Outcome, Reason, Status, Unmet};
pub use pattern::{Pattern, PatternId, Patterns, Scratch};
pub use plan::{Plan, Rejected, Report, Step, StepKind, plan};
pub use proof::Proofs;
pub use run::{Drag, PATIENCE, Runner, are_continuous, forks, leaning, leap, near, others, run};
pub use search::{COUNTING, Count, Puzzle, Verdict};
pub use seldom::Seldom;
pub use system::{
    Equation, Giver, Level, Method, MethodBody, PLAIN, Relation, RelationBody, Slot, SlotIndex,
    Span, Stay, System, TRUTH,
};
pub use truth::{Comparing, Comparison, comparisons};
pub use whole::{Constants, Looked, Trial, Wholes};
