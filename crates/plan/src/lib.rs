//! Structure, edit and mode in, Plan out: names, caches, lowers rules to systems, explains.
mod builtin;
mod component;
pub mod drag;
pub mod edit;
mod equality;
mod evaluate;
pub mod explain;
pub mod fault;
mod holds;
pub mod host;
mod meaning;
pub mod planner;
pub mod rule;
mod run;
pub mod status;
mod task;

pub use drag::{Drag, DragStep};
pub use edit::{Conflict, EditKind, EditReport, RefusalReason, Target};
pub use explain::{ExplainedKind, ExplainedStep, PlanKind, Root, RootKind, Why};
pub use fault::{Fault, FaultKind};
pub use host::{Failure, Host};
pub use planner::{Model, PlanCounts, Planner, Unmet};
pub use rule::{Source, Way};
pub use status::{SlotState, Status};
