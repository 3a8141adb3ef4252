//! Joining: what becomes one where something is dropped on something else.
//!
//! In: what is held or selected, mostly places, since these are what a pointer finds. Out: what sticks there. A
//! class says which of its parts do (`attachers`): of a resistor's end that is its node and not the place where
//! the node is drawn. What sticks joins any part of a class like its own.

use crate::session::thing_at;
use crate::state::State;
use crate::view::Refusal;
use crate::words;
use kernel::{ClassId, ClassKind, Document, Path};

/// Returns the paths that are to be merged where things at some paths are joined, in the same order.
///
/// # Errors
/// A path leads nowhere, two are one already, or nothing of them is alike.
pub(crate) fn joined(state: &State, paths: &[Path]) -> Result<Vec<Path>, Refusal> {
    for path in paths {
        words::find(state, path)?;
    }
    let [first, others @ ..] = paths else {
        return Err(words::refuse("there is nothing to join".into()));
    };
    let mut refused = None;
    for own in chain(state, first) {
        let found: Result<Vec<Path>, Refusal> =
            others.iter().map(|other| partner(state, &own, other)).collect();
        match found {
            Ok(found) => return Ok(std::iter::once(own).chain(found).collect()),
            Err(refusal) => refused = refused.or(Some(refusal)),
        }
    }
    let nothing = || words::refuse(format!("{first} sticks to nothing"));
    Err(refused.unwrap_or_else(nothing))
}

/// Returns what of one end a part joins with: the outermost that is like it.
fn partner(state: &State, own: &Path, other: &Path) -> Result<Path, Refusal> {
    let document = &state.lowered.document;
    let class = |path: &Path| thing_at(state, path).map(|t| state.structure.things[t].class);
    let found = class(own).and_then(|class| partner_of(state, class, other));
    let Some(found) = found else {
        let name = |path: &Path| class(path).map(|c| document.classes[c].name.to_string());
        let (a, b) = (name(own).unwrap_or_default(), name(other).unwrap_or_default());
        return Err(words::refuse(format!("{own} ({a}) and {other} ({b}) are unlike")));
    };
    let identity = |path: &Path| thing_at(state, path).map(|t| state.structure.identity(t));
    if identity(own) == identity(&found) {
        return Err(words::refuse(format!("{own} and {found} are one already")));
    }
    Ok(found)
}

/// Returns what at a path joins with a thing of a class: the outermost that is like it.
pub(crate) fn partner_of(state: &State, class: ClassId, path: &Path) -> Option<Path> {
    let document = &state.lowered.document;
    let mut candidates = chain(state, path);
    if candidates.len() == 1 && !document.is_place(class) {
        // nothing sticks there, but a part further out may be what is wanted
        candidates = (1..=path.0.len()).map(|n| Path(path.0[..n].to_vec())).collect();
    }
    candidates.into_iter().find(|candidate| {
        let thing = thing_at(state, candidate);
        thing.is_some_and(|t| are_alike(document, class, state.structure.things[t].class))
    })
}

/// Returns what could be joined at a path, outermost first: from what sticks there down to the path itself.
fn chain(state: &State, path: &Path) -> Vec<Path> {
    let from = sticking(state, path).unwrap_or(path.0.len());
    (from..=path.0.len()).map(|n| Path(path.0[..n].to_vec())).collect()
}

/// Returns how long the path is that leads to what sticks at a place, if a class around it says so.
fn sticking(state: &State, path: &Path) -> Option<usize> {
    let level = |n: usize| {
        let owner = thing_at(state, &Path(path.0[..n].to_vec()))?;
        let class = state.structure.things[owner].class;
        let attachers = attachers(&state.lowered.document, class);
        let sticks = attachers.iter().filter(|a| path.0[n..].starts_with(&a.0));
        sticks.map(|a| n + a.0.len()).min()
    };
    (1..path.0.len()).filter_map(level).min()
}

/// Returns the parts of a class's things that stick when one is placed: its own, else those of the nearest
/// class above.
pub(crate) fn attachers(document: &Document, class: ClassId) -> &[Path] {
    let line = document.lineage(class);
    let of = |class: ClassId| document.classes.get(class).map(|c| c.attachers.as_slice());
    line.into_iter().filter_map(of).find(|list| !list.is_empty()).unwrap_or_default()
}

/// Returns true if things of two classes can become one: one is of the other's class, or both come from a class
/// that has parts.
pub(crate) fn are_alike(document: &Document, a: ClassId, b: ClassId) -> bool {
    if document.is_a(a, b) || document.is_a(b, a) {
        return document.classes[a].kind != ClassKind::Composite
            || !document.layout(a).is_empty() && !document.layout(b).is_empty();
    }
    let above = document.primary_line(a);
    above.into_iter().any(|c| document.is_a(b, c) && !document.layout(c).is_empty())
}
