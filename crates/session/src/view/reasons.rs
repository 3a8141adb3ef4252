//! Reasons: how values come about, what is free, what contradicts.

use super::Choice;
use serde::Serialize;

/// The plan and the reasons, in words.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Explanation {
    /// What was asked.
    pub about: String,
    /// One paragraph.
    pub summary: String,
    /// The steps, in order.
    pub steps: Vec<ExplainedStep>,
    /// What is approached step by step, without a proof that this ends at an answer.
    pub warnings: Vec<String>,
}

/// One step of a plan.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ExplainedStep {
    /// The paths that it computes.
    pub targets: Vec<String>,
    /// How: `method 1 of 2`, `its rule, solved for it`, `4 linear equations, solved together`, ….
    pub method: String,
    /// The method that ran, or the rules, in the language.
    pub formula: String,
    /// Why this way: the constraint it comes from and what decided its direction.
    pub reason: String,
    /// The values that it gave.
    pub values: Vec<String>,
}

/// Why a thing does not move.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct HeldView {
    /// One sentence.
    pub message: String,
    /// The constraints that would have to give way, by path and name.
    pub constraints: Vec<String>,
    /// The anchored places that take part.
    pub anchors: Vec<String>,
}

/// What is free, what says nothing new, what cannot hold together.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Analysis {
    /// The degrees of freedom.
    pub freedom: u32,
    /// The paths of the places and numbers that can move.
    pub free: Vec<String>,
    /// The ways to move, those of one place first; at most 64 of each connected part, and [`crate::MOST_MOTIONS`] of
    /// all.
    pub motions: Vec<MotionView>,
    /// The required constraints that say nothing new.
    pub redundant: Vec<RedundantView>,
    /// The required constraints that cannot hold together.
    pub contradictions: Vec<ContradictionView>,
    /// Second views that would let what is solved together be computed one after the other.
    pub advice: Vec<Advice>,
}

/// A second view of things that would make a plan lighter; it was tried.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Advice {
    /// One sentence.
    pub message: String,
    /// The members of the document that would make it.
    pub members: String,
}

/// A way to move while every required constraint goes on holding.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct MotionView {
    /// One sentence.
    pub summary: String,
    /// What moves, in order.
    pub moves: Vec<Velocity>,
}

/// How a place or a number moves in a motion.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Velocity {
    /// Its path.
    pub path: String,
    /// Its velocity by coordinate; the largest number in a motion is 1.
    pub direction: Vec<f64>,
}

/// A required constraint that says nothing new.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct RedundantView {
    /// Its path and name.
    pub constraint: String,
    /// The constraints that imply it.
    pub implied_by: Vec<String>,
    /// Why it is superfluous, in words.
    pub because: String,
}

/// Required constraints that cannot hold together, none of which can be spared.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ContradictionView {
    /// Their paths and names.
    pub constraints: Vec<String>,
    /// The anchored places that take part.
    pub anchors: Vec<String>,
    /// False if the search ended before it was known which can be spared.
    pub decided: bool,
    /// One sentence.
    pub message: String,
    /// What would work, each tried.
    pub repairs: Vec<String>,
    /// The same as commands, where one command does it.
    #[serde(skip)]
    pub choices: Vec<Choice>,
}
