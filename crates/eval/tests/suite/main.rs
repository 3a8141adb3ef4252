//! Evaluation, pictures, verdicts and the checker, on documents built by hand.

mod build;
mod check;
mod express;
mod paint;
mod rules;
mod wishes;
