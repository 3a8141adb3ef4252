//! Openings: a document opened stage by stage, so that whoever waits for it goes on between.

use crate::document::Open;
use crate::host::Host;
use crate::state::{Planned, Solved, State, Structured};
use lang::Lowered;
use plan::{Planner, Plans};

/// A document that is being opened.
pub struct Opening {
    name: String,
    stage: Stage,
}

/// What there is of it.
enum Stage {
    Text(String),
    Lowered(String, Box<Lowered>),
    Structured(Box<Structured>),
    Planned(Box<Planned>),
    Solved(Box<Solved>),
    Told(Box<(State, Planner)>),
    Open(Box<Open>),
    /// All of it, and its picture.
    Drawn(Box<Open>),
}

impl std::fmt::Debug for Opening {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Opening").field("name", &self.name).finish_non_exhaustive()
    }
}

impl Opening {
    pub(crate) fn of(name: &str, text: &str) -> Self {
        Self { name: name.into(), stage: Stage::Text(text.into()) }
    }

    /// Returns the name of the document.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// How many stages there are.
    pub const STAGES: usize = 7;

    /// Returns how many stages are done.
    pub fn done(&self) -> usize {
        match self.stage {
            Stage::Text(_) => 0,
            Stage::Lowered(..) => 1,
            Stage::Structured(_) => 2,
            Stage::Planned(_) => 3,
            Stage::Solved(_) => 4,
            Stage::Told(_) => 5,
            Stage::Open(_) => 6,
            Stage::Drawn(_) => Self::STAGES,
        }
    }

    /// Returns true if nothing is left to do.
    pub fn is_over(&self) -> bool {
        matches!(self.stage, Stage::Drawn(_))
    }

    /// Goes through the next stage.
    pub(crate) fn go_on(self, host: &dyn Host) -> Self {
        let Self { name, stage } = self;
        let stage = match stage {
            Stage::Text(text) => {
                let lowered = lang::lower(&text, &|name: &str| host.read(name), None);
                Stage::Lowered(text, Box::new(lowered))
            }
            Stage::Lowered(text, of) => {
                Stage::Structured(Box::new(Structured::of(text, *of, None)))
            }
            Stage::Structured(of) => Stage::Planned(Box::new(of.planned(Plans::default()))),
            Stage::Planned(of) => Stage::Solved(Box::new(of.solved())),
            Stage::Solved(of) => Stage::Told(Box::new(of.told(host))),
            Stage::Told(of) => Stage::Open(Box::new(Open::new(name.clone(), *of))),
            Stage::Open(open) => {
                open.with_picture(|_| ());
                Stage::Drawn(open)
            }
            over @ Stage::Drawn(_) => over,
        };
        Self { name, stage }
    }

    /// Goes through what is left.
    pub(crate) fn finished(mut self, host: &dyn Host) -> Open {
        loop {
            match self.stage {
                Stage::Open(open) | Stage::Drawn(open) => return *open,
                _ => self = self.go_on(host),
            }
        }
    }
}
