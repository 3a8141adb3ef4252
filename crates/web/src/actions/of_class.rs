//! What is done with a class of the document's own, whose tile in the bin was asked for its menu.

use super::{Action, Context, Group};
use crate::dialog::Wish;
use crate::lab::{Lab, Notice};
use crate::words;
use leptos::prelude::*;
use session::Command;

/// The class whose menu was asked for last, where the document still declares it.
fn asked(lab: Lab) -> Result<String, &'static str> {
    lab.text.track();
    let class = lab.of_tile.get().ok_or(words::NO_TILE)?;
    let is_there = lab.id().is_some_and(|id| lab.ask(|session| session.has_class(id, &class)));
    if is_there { Ok(class) } else { Err(words::NO_TILE) }
}

/// Does something with that class.
fn with(lab: Lab, act: impl FnOnce(&str)) {
    if let Ok(class) = untrack(|| asked(lab)) {
        act(&class);
    }
}

/// Inserts a thing of it where there is room.
pub(super) const INSERT: Action = Action {
    id: "class-insert",
    group: Group::Join,
    contexts: &[Context::Class],
    label: words::CLASS_INSERT,
    keys: &[],
    enabled: |lab| asked(lab).map(drop),
    run: |lab| with(lab, |class| lab.insert(class)),
};

/// Shows its prototype.
pub(super) const EDIT: Action = Action {
    id: "class-edit",
    group: Group::Join,
    contexts: &[Context::Class],
    label: words::CLASS_EDIT,
    keys: &[],
    enabled: |lab| asked(lab).map(drop),
    run: |lab| with(lab, |class| lab.edit_class(class)),
};

/// Asks for another name.
pub(super) const RENAME: Action = Action {
    id: "class-rename",
    group: Group::Join,
    contexts: &[Context::Class],
    label: words::CLASS_RENAME,
    keys: &[],
    enabled: |lab| asked(lab).map(drop),
    run: |lab| with(lab, |class| lab.wish.set(Some(Wish::Rename(String::from(class))))),
};

/// Takes it out of the document; while something is made of it, says what.
pub(super) const DELETE: Action = Action {
    id: "class-delete",
    group: Group::Join,
    contexts: &[Context::Class],
    label: words::CLASS_DELETE,
    keys: &[],
    enabled: |lab| asked(lab).map(drop),
    run: |lab| {
        with(lab, |class| {
            let Some(path) = session::parse_path(class) else { return };
            if lab.apply(&Command::Delete(path)) {
                lab.notice.set(Some(Notice::Said(words::class_deleted(class))));
            }
        });
    },
};
