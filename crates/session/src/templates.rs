//! Texts with values in them, as hands type them: `side {line.length}` is written so, and is what an editor begins with.
//!
//! In: what is typed for a text. Out: the edit that writes it, where what stands in braces has a value in the document.
//! Else braces are braces, as in any text that is set.

use crate::calculator;
use crate::session::{Session, thing_at};
use crate::state::State;
use crate::view::{Change, DocumentId, Refusal};
use kernel::{Command, Path, Primitive, SlotId, Step, ThingId};
use syntax::TextEdit;

/// Returns what is written for a text with values in it, without its quotes; nothing for another one.
pub(crate) fn source(state: &State, slot: SlotId) -> Option<String> {
    let span = bound_at(state, slot)?;
    let written = state.text.get(span.range())?;
    let inner = written.strip_prefix('"')?.strip_suffix('"')?;
    Some(inner.replace("\\\"", "\"").replace("\\n", "\n").replace("\\\\", "\\"))
}

/// Returns where in the document's own text the value stands by which a text is bound to others.
fn bound_at(state: &State, slot: SlotId) -> Option<base::Span> {
    let structure = &state.structure;
    if structure.slots[slot].primitive != Primitive::Text || !structure.bound.contains(&slot) {
        return None;
    }
    let document = &state.lowered.document;
    let thing = structure.slots[slot].thing;
    let whole = structure.path(document, thing);
    let owner = |&thing: &ThingId| structure.things[thing].owner;
    let owners: Vec<ThingId> = std::iter::successors(owner(&thing), owner).collect();
    // of all that bind it the outermost counts
    let binding = owners.iter().rev().enumerate().find_map(|(from, &owner)| {
        let classes = document.lineage(structure.things[owner].class).into_iter();
        let mut bindings = classes.flat_map(|class| &document.classes[class].bindings);
        bindings.find(|binding| binding.path.0 == whole.0[from..])
    })?;
    let is_own = state.lowered.is_own_given(binding.value);
    is_own.then(|| state.lowered.own_span(binding.value)).flatten()
}

/// Writes a text in quotes that has values in braces.
fn template(typed: &str) -> String {
    lang::quoted(typed).replace("{{", "{").replace("}}", "}")
}

impl Session {
    /// Writes what is typed for a text, where that has values in braces, or takes the place of one that has; nothing
    /// where it is set as any other value.
    pub(crate) fn set_template(
        &mut self,
        id: DocumentId,
        path: &Path,
        typed: &str,
    ) -> Option<Result<Change, Refusal>> {
        let open = self.document_mut(id);
        let state = open.state.clone();
        let thing = thing_at(&state, path)?;
        let slot = state.structure.slot_of(thing)?;
        if state.structure.slots[slot].primitive != Primitive::Text {
            return None;
        }
        let bound = bound_at(&state, slot);
        let has_values = typed.contains('{') && {
            let read = calculator::values(open, &[template(typed)]);
            read.iter().all(Result::is_ok)
        };
        if !has_values && bound.is_none() {
            return None;
        }
        let literal = if has_values { template(typed) } else { lang::quoted(typed) };
        let given = || {
            let given = state.structure.given(slot)?;
            let is_own = state.lowered.is_own_given(given.origin);
            let span = state.lowered.own_span(given.origin).filter(|_| is_own)?;
            let written = state.text.get(span.range())?;
            written.starts_with('"').then_some(span)
        };
        let command = match bound.or_else(given) {
            Some(span) => {
                let edit = TextEdit { span, insert: literal };
                Command::Text(syntax::edit::apply(&state.text, &[edit]))
            }
            None => {
                let (last, owner) = path.0.split_last()?;
                let Step::Part(name) = last else { return None };
                let members = format!("{name} = {literal}");
                Command::Edit { target: Path(owner.to_vec()), members }
            }
        };
        Some(self.apply(id, &command))
    }
}
