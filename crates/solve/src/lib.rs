//! Anonymous equations and unknowns: who may yield, which way, how much. No things.
//!
//! A [`System`](system::System) is one connected component: slots with their stays, relations with
//! their strengths and methods. `plan` makes a `Plan` of it once; the plan runs for any values.
pub mod system;

pub use system::{Equation, Level, Method, MethodBody, Relation, RelationBody, Slot, SlotIndex, Stay, System};
