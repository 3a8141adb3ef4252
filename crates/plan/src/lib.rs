//! Structure and edit in, plans out: names things, caches plans, lowers rules to systems, explains.
//!
//! Three nouns. A [`Planner`] has every rule of a structure as equations over slots, and the plans
//! made so far. An edit ([`Planner::edit`], [`Planner::press`]) picks the components that it touches,
//! states each as a `solve::System`, and runs its plan; an [`EditReport`] says what came of it. A
//! [`Host`] computes what is not numbers: texts, given terms, methods over them.
//!
//! Rules are opened symbolically: messages and virtual parts into their definitions, lists and sets
//! into their members, equality of things part by part. Equal components have equal systems, so a
//! thousand instances of a class are planned once.
//!
//! ```no_run
//! use kernel::{Document, Value, Values, instantiate};
//! use plan::{EditKind, Host, Model, Planner, Plans, Target};
//!
//! fn double_the_first_part(document: &Document, host: &mut dyn Host) -> Option<Values> {
//!     let (structure, _) = instantiate(document);
//!     let model = Model { document, structure: &structure };
//!     let (mut planner, _faults) = Planner::new(model, Plans::default());
//!     let mut values = Values::default();
//!     planner.open(model, &mut values, host);
//!     let first = structure.parts(kernel::DOCUMENT).next()?;
//!     let wanted = 2.0 * values.numbers[structure.slot_of(first)?];
//!     let targets = [(Target::Thing(first), vec![Value::Number(wanted)])];
//!     let report = planner.edit(model, &mut values, EditKind::Set, &targets, host);
//!     report.refusal.is_none().then_some(values)
//! }
//! ```
//!
//! **Invariants**: a refused edit changes no bit; an edit changes only slots of the components of its
//! targets; a drag depends on the press and the present wish alone; what is asked for by slot or rule
//! is answered by slot or rule: words are made elsewhere.
//!
//! Reading order: [`rule`] and the lowering (meanings, evaluation, what a rule says; programs, counting and
//! the courses of both), components, tasks, [`planner`], [`edit`], [`drag`], [`status`], [`diagnose`], [`explain`].
pub mod rule;

mod builtin;
mod counting;
mod course;
mod equality;
mod evaluate;
mod lower;
mod making;
mod meaning;
mod operator;
mod program;
mod reach;
mod say;
mod template;

pub mod fault;
pub mod host;

mod component;
mod construct;
mod holds;
mod past;
pub mod plans;
mod recent;
mod task;

pub mod planner;

mod aim;
pub mod drag;
pub mod edit;
mod limit;
mod run;
mod vanish;

pub mod modal;
mod whole;

pub mod diagnose;
pub mod explain;
mod ghost;
mod sides;
pub mod status;

pub use course::{CourseChange, Decided};
pub use diagnose::Analysis;
pub use diagnose::combination::{Combination, Said};
pub use diagnose::conflict::{Certainty, Contradiction};
pub use diagnose::held::Held;
pub use diagnose::motion::{Freedom, Motion, MotionKind};
pub use diagnose::redundancy::{Redundancy, Redundant, RedundantKind, Surplus};
pub use diagnose::repair::Repair;
pub use drag::Press;
pub use edit::{Conflict, EditKind, EditReport, NotDecided, RefusalReason, Target};
pub use explain::{ExplainedKind, ExplainedStep, PlanKind, Root, RootKind, Uncountable, Why};
pub use fault::{Fault, FaultKind};
pub use ghost::{Ghost, GhostKind};
pub use host::{Failure, Host};
pub use limit::{Limit, LimitKind};
pub use modal::{Acting, ActingKind, ModeChange};
pub use planner::{Latest, Model, Planner, Unmet};
pub use plans::{PlanCounts, Plans};
pub use rule::{SideOf, Source, Turns, Way};
pub use status::{SlotState, Status};
pub use template::Templates;
