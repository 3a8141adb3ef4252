//! What the planner promises, on documents made by hand.
mod builder;
mod moving;
mod setting;
