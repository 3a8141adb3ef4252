//! What the planner promises, on documents made by hand.
mod bridge;
mod builder;
mod circuits;
mod diagnosing;
mod moving;
mod opening_rules;
mod reasons;
mod setting;
