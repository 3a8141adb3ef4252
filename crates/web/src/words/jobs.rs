//! The words of long jobs.

use crate::lab::Kind;

pub const NO_WORKER: &str =
    "The browser refuses a worker: long jobs run in the page, which may stand still meanwhile";
pub const JOB_STOPPED: &str = "Stopped";
pub const STOP_JOB: &str = "Stop";
pub const ANALYSING: &str = "Looking what is free and what contradicts …";
pub const ANALYSIS_STOPPED: &str =
    "What is free and what contradicts was not looked up to the end.";
pub const ROWS_STOPPED: &str =
    "Not all rows were drawn: the drawing was stopped. Another edit draws them again.";
pub const MAP_STOPPED: &str = "The map was stopped. Another range makes it again.";
pub const ANALYSE_AGAIN: &str = "Look again";

pub const FILES_STOPPED: &str = "The files were not made: the drawing was stopped.";

/// What a job is called while it goes on.
pub fn job(kind: Kind) -> &'static str {
    match kind {
        Kind::Analysis => "Analysing",
        Kind::Foreseen => "Trying it",
        Kind::Elsewhere => "Looking where else it could be",
        Kind::Edit => "Computing what follows",
        Kind::Freedom => "Counting what is free",
        Kind::Rows => "Drawing rows",
        Kind::Map => "Making the map",
        Kind::Svg | Kind::Dxf => "Drawing the files of a family",
    }
}

/// Why a job came to no end.
pub fn job_failed(why: &str) -> String {
    format!("It came to no end: {why}")
}
