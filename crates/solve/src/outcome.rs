//! Outcomes: what a run tells, and the host that runs what only it can.

use crate::block::Workspace;
use crate::system::SlotIndex;

/// What the solver cannot do itself: texts, and methods and rules that the host alone knows.
pub trait Host {
    /// Runs a relation's method. Numbers are read from `values`, texts on the host's side; the
    /// method's targets that are numbers are returned in `out`, by their position among its targets,
    /// and its texts are written on the host's side.
    ///
    /// # Errors
    /// What the method failed with; the edit is refused, and the host takes its texts back.
    fn compute(
        &mut self,
        source: u32,
        method: usize,
        values: &[f64],
        out: &mut [f64],
    ) -> Result<(), String>;
    /// Returns true if a rule that the host alone can test holds.
    fn holds(&mut self, source: u32, values: &[f64]) -> bool;
}

/// A host for systems without opaque relations.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoHost;

impl Host for NoHost {
    fn compute(&mut self, _: u32, _: usize, _: &[f64], _: &mut [f64]) -> Result<(), String> {
        Err("no host computes here".to_owned())
    }
    fn holds(&mut self, _: u32, _: &[f64]) -> bool {
        false
    }
}

/// How a run ended.
#[derive(Clone, PartialEq, Debug)]
pub enum Status {
    /// Every required relation holds.
    Solved,
    /// Not every required relation can hold. The values are as they came; after a drag, those of the
    /// last state in which they did.
    Stopped(Reason),
}

/// Why a run stopped.
#[derive(Clone, PartialEq, Debug)]
pub enum Reason {
    /// The branch ends on the way: this part of the way was gone; of a long way that is gone in short ones,
    /// of the last of these.
    Limit {
        /// From 0 (nothing) to 1.
        fraction: f64,
    },
    /// A step found no solution.
    NoSolution {
        /// Its index in the plan.
        step: u32,
    },
    /// No solution was found before the search over the roots of steps reached its bound.
    NotDecided {
        /// How many ways to choose them were tried.
        tried: u32,
    },
    /// What the run may cost was spent before a solution was found.
    Spent,
    /// A part of the way cost what it may before it was gone.
    GivenUp {
        /// How much, in multiplications.
        bound: u64,
    },
    /// Required relations contradict: they are unmet.
    Conflict,
    /// A host's method failed.
    Method {
        /// The step's index in the plan.
        step: u32,
        /// What the host said.
        message: String,
    },
}

/// A relation that does not hold.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Unmet {
    /// Its index in the system.
    pub relation: u32,
    /// The largest difference between the sides of its equations; one for an opaque relation.
    pub error: f64,
    /// The difference that it allows.
    pub tolerance: f64,
}

/// Something worth saying about a solution.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Note {
    /// Two solutions coincide here: the slot is known to half the digits only.
    DoubleRoot {
        /// The slot.
        slot: SlotIndex,
    },
}

/// What a run tells.
#[derive(Clone, PartialEq, Debug)]
pub struct Outcome {
    /// How it ended.
    pub status: Status,
    /// Every relation that does not hold in the state that it speaks of: the present one, or where the
    /// values were taken back, the refused one.
    pub unmet: Vec<Unmet>,
    /// Remarks.
    pub notes: Vec<Note>,
}

impl Outcome {
    /// Returns true if every required relation holds.
    pub fn is_solved(&self) -> bool {
        self.status == Status::Solved
    }
    /// Says that what may be spent was spent, where that is so and no solution was found.
    pub(crate) fn note_spent(&mut self, work: &Workspace) {
        if !self.is_solved() && work.is_spent() {
            self.status = Status::Stopped(Reason::Spent);
        }
    }
}
