//! A document at one moment: its text, what the text means, and the values that it comes to.
//!
//! A state is made from a text and never changed. What a member with an error meant before is taken
//! from the state before it; apart from that the text alone decides, bit for bit.

use crate::host::Host;
use crate::texts::Texts;
use base::Diagnostic;
use eval::Evaluator;
use kernel::{SlotId, Structure, Values};
use lang::Lowered;
use plan::{Model, Planner, Plans, Status};

/// A document at one moment.
pub(crate) struct State {
    /// The text.
    pub(crate) text: String,
    /// What the text means.
    pub(crate) lowered: Lowered,
    /// Its things.
    pub(crate) structure: Structure,
    /// What is in their slots.
    pub(crate) values: Values,
    /// What is wrong with the text, in its order.
    pub(crate) diagnostics: Vec<Diagnostic>,
}

impl State {
    /// Makes the state of a text, and the planner for it. Never fails.
    pub(crate) fn of(
        text: String,
        before: Option<&Self>,
        host: &dyn Host,
        plans: Plans,
    ) -> (Self, Planner) {
        let load = |name: &str| host.read(name);
        let lowered = lang::lower(&text, &load, before.map(|b| &b.lowered));
        let (structure, faults) = kernel::instantiate(&lowered.document);
        debug_assert_eq!(kernel::check::structure(&lowered.document, &structure), Ok(()));
        let model = Model { document: &lowered.document, structure: &structure };
        let (mut planner, unplanned) = Planner::new(model, plans);
        let mut diagnostics = lowered.diagnostics.clone();
        diagnostics.extend(lowered.fault_diagnostics(&faults));
        diagnostics.extend(
            unplanned.iter().map(|f| {
                Diagnostic::error(f.kind.code(), lowered.place(f.origin), f.message.clone())
            }),
        );
        diagnostics.sort_by_key(|d| (d.place.file, d.place.span.start));
        let mut values = Values::new(structure.slots.len());
        let mut texts = Texts::new(&lowered.document, &structure);
        planner.open(model, &mut values, &mut texts);
        debug_assert_eq!(kernel::check::values(&structure, &values), Ok(()));
        (Self { text, lowered, structure, values, diagnostics }, planner)
    }
    /// Returns what every question to the planner is about.
    pub(crate) fn model(&self) -> Model<'_> {
        Model { document: &self.lowered.document, structure: &self.structure }
    }
    /// Returns what holds and what is free.
    pub(crate) fn status(&self, planner: &mut Planner) -> Status {
        let mut texts = Texts::new(&self.lowered.document, &self.structure);
        planner.status(self.model(), &self.values, &mut texts)
    }
    /// Returns an evaluator of this state, or of other values of it.
    pub(crate) fn evaluator<'a>(&'a self, values: &'a Values) -> Evaluator<'a> {
        Evaluator::new(&self.lowered.document, &self.structure, values)
    }
    /// Returns the path of the first thing of a slot, as the language writes it.
    pub(crate) fn slot_path(&self, slot: SlotId) -> kernel::Path {
        self.structure.path(&self.lowered.document, self.structure.slots[slot].thing)
    }
}
