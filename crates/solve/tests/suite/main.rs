//! What the solver answers, by numbers: failures first, then who yields, which way, how much, drags.
mod bridge;
mod builder;
mod closed;
mod contradictions;
mod crests;
mod drags;
mod idle;
mod measure;
mod peeled;
mod random;
mod reach;
mod roots;
mod searching;
mod spread;
mod ways;
mod who;
