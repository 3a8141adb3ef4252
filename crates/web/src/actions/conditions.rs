//! What an action needs before it can be done; where that lacks, the reason in words.

use crate::lab::Lab;
use crate::words;
use leptos::prelude::*;
use session::drafting::view::{Prompt, Wants};
use session::view::{RowKind, StructureRow};

/// Whether things of a class can be made.
pub(super) fn class(lab: Lab, name: &str) -> Result<(), &'static str> {
    document(lab)?;
    lab.text.track();
    let there = lab.id().is_some_and(|id| lab.ask(|session| session.has_class(id, name)));
    // a file in which nothing stands yet becomes a new sheet
    let is_blank = || lab.text.with(|text| text.source.trim().is_empty());
    if there || is_blank() { Ok(()) } else { Err(words::NO_CLASS) }
}

/// Whether there is a document, and then whether it has unsaved changes.
pub(super) fn document(lab: Lab) -> Result<bool, &'static str> {
    lab.document.with(|document| document.as_ref().map(|d| d.dirty)).ok_or(words::NO_DOCUMENT)
}

/// The row of the selected thing.
pub(super) fn selected(lab: Lab) -> Result<StructureRow, &'static str> {
    document(lab)?;
    let path = lab.selected.get().ok_or(words::NOTHING_SELECTED)?;
    lab.structure
        .with(|rows| rows.iter().find(|r| r.path == path && r.kind.has_own_path()).cloned())
        .ok_or(words::NOTHING_SELECTED)
}

/// The paths of what is selected, where there is something.
pub(super) fn several(lab: Lab) -> Result<Vec<String>, &'static str> {
    document(lab)?;
    let selection = lab.selection();
    if selection.is_empty() { Err(words::NOTHING_SELECTED) } else { Ok(selection) }
}

/// The paths of what is meant to be locked of what is selected, where all are parts that can be.
pub(crate) fn lockable(lab: Lab) -> Result<Vec<String>, &'static str> {
    let selection = several(lab)?;
    let is_part = |path: &String| {
        lab.structure
            .with(|rows| rows.iter().any(|row| row.path == *path && row.kind == RowKind::Part))
    };
    if !selection.iter().all(is_part) {
        return Err(words::IS_A_CONSTRAINT);
    }
    let meant = lab.ask_of_shown(|session, id| {
        let paths = selection.iter().filter_map(|path| session::parse_path(path));
        paths.flat_map(|path| session.to_lock(id, &path)).map(|path| path.to_string()).collect()
    });
    Ok(meant.unwrap_or(selection))
}

/// The thing that a program draws which is selected, or of which something is.
pub(super) fn drawn(lab: Lab) -> Result<String, &'static str> {
    document(lab)?;
    let path = lab.selected.get().ok_or(words::NOTHING_SELECTED)?;
    lab.ask_of_shown(|session, id| session.instance_of(id, &path)).flatten().ok_or(words::NOT_DRAWN)
}

/// The placed thing of a program which is selected, or of which something is; and whether it is held in its place.
pub(super) fn instance(lab: Lab) -> Result<(String, bool), &'static str> {
    let thing = drawn(lab)?;
    let held = lab.ask_of_shown(|session, id| session.is_held_in_place(id, &thing)).flatten();
    held.map(|held| (thing, held)).ok_or(words::NOT_PLACED)
}

/// Whether a row is that of a thing of the document itself.
pub(super) fn is_thing(row: &StructureRow) -> bool {
    row.kind == RowKind::Part && row.depth == 1
}

/// Whether a row is that of a thing of the document itself, or of a figure that it computes.
pub(super) fn is_own(row: &StructureRow) -> bool {
    row.kind.is_thing() && row.depth == 1
}

/// Whether a constraint is selected that is on, or off, as is wanted.
pub(super) fn constraint(lab: Lab, on: bool) -> Result<(), &'static str> {
    let row = selected(lab)?;
    match row.kind {
        RowKind::Constraint if row.enabled == on => Ok(()),
        RowKind::Constraint if on => Err(words::IS_OFF),
        RowKind::Constraint => Err(words::IS_ON),
        RowKind::Part | RowKind::Virtual | RowKind::Merge | RowKind::Side => {
            Err(words::NOT_A_CONSTRAINT)
        }
    }
}

/// Whether a program is recorded.
pub(super) fn is_recorded(lab: Lab) -> Result<(), &'static str> {
    document(lab)?;
    lab.drafting.turned.track();
    let is_recorded = lab.ask_of_shown(|session, id| session.recorded(id).is_some());
    if is_recorded == Some(true) { Ok(()) } else { Err(words::NOT_RECORDED) }
}

/// Whether a program is recorded in which a block can be begun now.
pub(super) fn recorded(lab: Lab) -> Result<(), &'static str> {
    is_recorded(lab)?;
    let asks = |p: &Prompt| matches!(p.wants, Wants::Recurrence(_) | Wants::Ends(_));
    match lab.drafting.prompt.with(|prompt| prompt.as_ref().is_some_and(asks)) {
        true => Err(words::TURN_IS_ASKED),
        false => Ok(()),
    }
}
