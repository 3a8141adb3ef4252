//! What the solver answers, by numbers: failures first, then who yields, which way, how much, drags.
mod builder;
mod bridge;
mod contradictions;
mod drags;
mod idle;
mod measure;
mod random;
mod ways;
mod who;
