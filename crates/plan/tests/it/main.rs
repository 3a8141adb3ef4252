//! What the planner promises, on documents made by hand.
mod builder;
mod circuits;
mod moving;
mod opening_rules;
mod reasons;
mod setting;
