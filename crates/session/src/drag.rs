//! A drag: from press to release nothing is written, and nothing but numbers is computed.

use crate::apply;
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::texts::Texts;
use crate::view::{Change, DragState, Refusal};
use crate::words;
use kernel::{Path, SlotId, ThingId, Values};
use plan::{Planner, Press, RefusalReason, Target};

/// A drag between press and release.
pub(crate) struct Drag {
    /// What is dragged, for the undo list.
    pub(crate) path: Path,
    /// What holds its numbers.
    slots: Vec<SlotId>,
    press: Press,
    /// The values as of the last event.
    pub(crate) values: Values,
}

/// Begins a drag of a place.
///
/// # Errors
/// Why the thing cannot be dragged.
pub(crate) fn press(
    state: &State,
    planner: &mut Planner,
    thing: ThingId,
    path: Path,
) -> Result<Drag, RefusalReason> {
    let mut texts = Texts::new(&state.lowered.document, &state.structure);
    let targets = [Target::Thing(thing)];
    let press = planner.press(state.model(), &state.values, &targets, &mut texts)?;
    let slots = state.structure.slots_under(thing);
    Ok(Drag { path, slots, press, values: state.values.clone() })
}

impl Drag {
    /// Follows the pointer to a place on the sheet; a number follows the first of its coordinates.
    pub(crate) fn to(&mut self, state: &State, planner: &Planner, to: &[f64]) -> DragState {
        let mut texts = Texts::new(&state.lowered.document, &state.structure);
        let to = &to[..self.slots.len().min(to.len())];
        let report = planner.drag(state.model(), &mut self.press, &mut self.values, to, &mut texts);
        let message = (!report.reached).then(|| words::why_not_reached(state, &report));
        DragState { reached: report.reached, message }
    }
    /// Lets go: soft constraints act again, and the change is written.
    ///
    /// # Errors
    /// Why it could not be kept; then all is as it was before the press.
    pub(crate) fn release(mut self, open: &mut Open, host: &dyn Host) -> Result<Change, Refusal> {
        let state = open.state.clone();
        let mut texts = Texts::new(&state.lowered.document, &state.structure);
        let report = open.planner.release(state.model(), self.press, &mut self.values, &mut texts);
        if let Some(reason) = &report.refusal {
            return Err(words::refusal_for(&state, reason, &report));
        }
        let label = format!("move {}", self.path);
        apply::keep(open, host, label, self.slots, &self.values)
    }
}
