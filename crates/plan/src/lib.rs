//! Structure, edit and mode in, Plan out: names, caches, lowers rules to systems, explains.
mod builtin;
mod component;
pub mod edit;
mod equality;
mod evaluate;
pub mod fault;
mod holds;
pub mod host;
mod meaning;
pub mod planner;
pub mod rule;
mod run;
mod task;

pub use edit::{Conflict, EditKind, EditReport, RefusalReason, Target};
pub use fault::{Fault, FaultKind};
pub use host::{Failure, Host};
pub use planner::{Model, PlanCounts, Planner, Unmet};
pub use rule::{Source, Way};
