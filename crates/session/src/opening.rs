//! Openings: a document opened stage by stage, so that whoever waits for it goes on between.

use crate::document::Open;
use crate::host::Host;
use crate::session::Session;
use crate::state::{Planned, Solved, State, Structured};
use crate::view::DocumentId;
use lang::{Lowered, Lowering};
use plan::{Planner, Plans};

/// A document that is being opened.
pub struct Opening {
    name: String,
    stage: Stage,
    /// Whether plans are forgotten once they have served.
    is_sparing: bool,
}

/// What there is of it.
enum Stage {
    Text(String),
    Lowering(String, Box<Lowering>),
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
        Self { name: name.into(), stage: Stage::Text(text.into()), is_sparing: false }
    }

    /// The same of a document that is looked at: what is planned to open it is forgotten once it has served.
    pub(crate) fn sparing(name: &str, text: &str) -> Self {
        Self { is_sparing: true, ..Self::of(name, text) }
    }

    /// Returns the name of the document.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// How many stages there are.
    pub const STAGES: usize = 8;

    /// Returns how many stages are done, and how much of the one that it is in.
    pub fn done(&self) -> f64 {
        match &self.stage {
            Stage::Text(_) => 0.0,
            Stage::Lowering(_, lowering) => 1.0 + lowering.done(),
            Stage::Lowered(..) => 2.0,
            Stage::Structured(_) => 3.0,
            Stage::Planned(_) => 4.0,
            Stage::Solved(_) => 5.0,
            Stage::Told(_) => 6.0,
            Stage::Open(_) => 7.0,
            Stage::Drawn(_) => Self::STAGES as f64,
        }
    }

    /// Returns true if nothing is left to do.
    pub fn is_over(&self) -> bool {
        matches!(self.stage, Stage::Drawn(_))
    }

    /// Goes through the next stage, or a part of it.
    pub(crate) fn go_on(self, host: &dyn Host) -> Self {
        let Self { name, stage, is_sparing } = self;
        let stage = match stage {
            Stage::Text(text) => {
                let lowering = Lowering::of(&text, &|name: &str| host.read(name));
                Stage::Lowering(text, Box::new(lowering))
            }
            Stage::Lowering(text, lowering) if lowering.is_over() => {
                Stage::Lowered(text, Box::new(lowering.lowered()))
            }
            Stage::Lowering(text, lowering) => Stage::Lowering(text, Box::new(lowering.go_on())),
            Stage::Lowered(text, of) => {
                Stage::Structured(Box::new(Structured::of(text, *of, None)))
            }
            Stage::Structured(of) => Stage::Planned(Box::new(of.planned(Plans::default()))),
            Stage::Planned(of) => Stage::Solved(Box::new(of.solved())),
            Stage::Solved(of) => Stage::Told(Box::new(of.told(host))),
            Stage::Told(mut of) => {
                if is_sparing {
                    of.1.forget_plans();
                }
                Stage::Open(Box::new(Open::new(name.clone(), *of)))
            }
            Stage::Open(open) => {
                open.with_picture(|_| ());
                Stage::Drawn(open)
            }
            over @ Stage::Drawn(_) => over,
        };
        Self { name, stage, is_sparing }
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

impl Session {
    /// Opens a document that is looked at, in as little room as it takes: its plans are forgotten once they have served,
    /// here and by [`Session::forget_plans`].
    pub fn open_sparingly(&mut self, name: &str, text: &str) -> DocumentId {
        self.end_opening(Opening::sparing(name, text))
    }
    /// Forgets the plans of a document. What asks for one plans anew.
    pub fn forget_plans(&mut self, id: DocumentId) {
        self.document_mut(id).planner.forget_plans();
    }
}
