//! Anonymous equations and unknowns: who may yield, which way, how much. No things.
//!
//! A [`System`] is one connected component: slots with their stays, relations with their strengths
//! and methods. [`plan()`] makes a [`Plan`] of it once, without looking at a value; [`run()`] takes it
//! through an edit and [`Drag`] through a drag, for any values.
//!
//! ```
//! use solve::{Equation, Level, NoHost, Relation, RelationBody, Runner, Slot, Stay, System};
//! let mut system = System::default();
//! let slot = |stay| Slot { stay, scale: 0, is_number: true, is_discrete: false };
//! // celsius is set, fahrenheit follows
//! system.slots = vec![slot(Stay::Fixed), slot(Stay::Kept { group: 0 })];
//! let (c, f) = (system.arena.var(expr::Var(0)), system.arena.var(expr::Var(1)));
//! let (factor, offset) = (system.arena.constant(1.8), system.arena.constant(32.0));
//! let scaled = system.arena.mul(c, factor);
//! let left = system.arena.add(scaled, offset);
//! system.relations = vec![Relation {
//!     level: Level::Required,
//!     body: RelationBody::Equations(vec![Equation { left, right: f }]),
//!     methods: Vec::new(),
//!     derived: true,
//!     reads: Vec::new(),
//!     within: 1e-9f64.to_bits(),
//!     source: 0,
//! }];
//! let plan = solve::plan(&system);
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
pub mod system;

mod substitute;

mod tableau;

mod rows;

mod accept;

mod direct;
mod eliminate;

mod order;

pub mod plan;

mod lower;

mod dense;

mod square;

mod measure;

pub mod outcome;

mod attempt;

pub mod run;

pub use outcome::{Host, NoHost, Note, Outcome, Reason, Status, Unmet};
pub use plan::{Plan, Rejected, Report, Step, StepKind, plan};
pub use run::{Drag, Runner, run};
pub use system::{
    Equation, Level, Method, MethodBody, Relation, RelationBody, Slot, SlotIndex, Stay, System,
};
