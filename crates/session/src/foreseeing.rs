//! Foreseeing: what a command would come to, found in a copy of the document.
//!
//! In: a command. Out: what of the picture would look otherwise, and what would move. This may take as long as doing it:
//! a page asks a worker ([`crate::jobs`]).

use crate::apply;
use crate::host::Beside;
use crate::plain::written;
use crate::session::{Session, thing_at};
use crate::state::State;
use crate::view::{DocumentId, Foreseen, Refusal};
use crate::views::picture::picture;
use base::number::close;
use drawing::{Element, Tag};
use kernel::{Command, Value};
use std::collections::BTreeSet;

impl Session {
    /// Returns what a command would come to, without doing it.
    ///
    /// # Errors
    /// Why it would be refused.
    pub fn foreseen(&self, id: DocumentId, command: &Command) -> Result<Foreseen, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let open = self.document(id);
        let mut trial = open.trial();
        apply::apply(&mut trial, &beside, command)?;
        let now = picture(&open.state, open.values(), &open.status).drawing;
        let mut then = picture(&trial.state, trial.values(), &trial.status).drawing;
        let now: BTreeSet<Vec<u8>> = now.elements.iter().map(looks).collect();
        then.elements.retain(|element| !now.contains(&looks(element)));
        Ok(Foreseen { picture: then, moved: moved(&open.state, &trial.state) })
    }
}

/// How an element looks, whatever it pictures; zeros are alike.
fn looks(element: &Element) -> Vec<u8> {
    let mut bare = Element { tag: Tag(0), ..element.clone() };
    bare.shape.each_number(&mut |x| *x += 0.0);
    written(&bare)
}

/// The paths of what has other values in another state, each once: of places as wholes.
fn moved(was: &State, is: &State) -> Vec<String> {
    let (structure, document) = (&was.structure, &was.lowered.document);
    let is_moved = |&slot: &kernel::SlotId| {
        let then = thing_at(is, &was.slot_path(slot)).and_then(|t| is.structure.slot_of(t));
        then.is_some_and(|then| match (was.values.get(slot), is.values.get(then)) {
            (Value::Number(a), Value::Number(b)) => !close(a, b),
            (a, b) => !a.same_bits(&b),
        })
    };
    let of = |slot| structure.slots[slot].place.unwrap_or(structure.slots[slot].thing);
    let mut told = BTreeSet::new();
    let things = structure.slots.ids().filter(is_moved).map(of).filter(|&thing| told.insert(thing));
    things.map(|thing| structure.path(document, thing).to_string()).collect()
}
