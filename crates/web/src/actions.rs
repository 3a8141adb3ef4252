//! One table of what can be done: it makes the buttons, the menu, the palette and the shortcuts.

use crate::lab::{Lab, Notice, Zoom};
use crate::{route, structure, words};
use leptos::ev::KeyboardEvent;
use leptos::prelude::*;
use session::view::{RowKind, StructureRow};
use session::{Command, Path};
use wasm_bindgen::JsCast;

/// Something that can be done; two are the same if they have one name.
#[derive(Debug)]
pub struct Action {
    /// Its name for scripts and tests.
    pub id: &'static str,
    /// What it is called.
    pub label: &'static str,
    /// The keys that do it, the first of which is shown.
    pub keys: &'static [&'static str],
    /// Whether it can be done now, or why not.
    pub enabled: fn(Lab) -> Result<(), &'static str>,
    /// Does it.
    pub run: fn(Lab),
}

impl PartialEq for Action {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

/// Everything that can be done, in the order of the menu.
pub const ACTIONS: &[Action] = &[
    Action {
        id: "save",
        label: words::SAVE,
        keys: &["Ctrl+S"],
        enabled: |lab| {
            let dirty = document(lab)?;
            if dirty { Ok(()) } else { Err(words::NOTHING_TO_SAVE) }
        },
        run: Lab::save,
    },
    Action {
        id: "undo",
        label: words::UNDO,
        keys: &["Ctrl+Z"],
        enabled: |lab| {
            let step = lab.status.with(|status| status.undo.is_some());
            document(lab).and(if step { Ok(()) } else { Err(words::NOTHING_TO_UNDO) })
        },
        run: |lab| apply(lab, &Command::Undo),
    },
    Action {
        id: "redo",
        label: words::REDO,
        keys: &["Ctrl+Shift+Z", "Ctrl+Y"],
        enabled: |lab| {
            let step = lab.status.with(|status| status.redo.is_some());
            document(lab).and(if step { Ok(()) } else { Err(words::NOTHING_TO_REDO) })
        },
        run: |lab| apply(lab, &Command::Redo),
    },
    Action {
        id: "explain",
        label: words::EXPLAIN,
        keys: &["W"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| lab.why.update(|why| *why = !*why),
    },
    Action {
        id: "lock",
        label: words::LOCK,
        keys: &["L"],
        enabled: |lab| match selected(lab)?.kind {
            RowKind::Part => Ok(()),
            RowKind::Virtual | RowKind::Constraint | RowKind::Merge | RowKind::Side => {
                Err(words::IS_A_CONSTRAINT)
            }
        },
        run: |lab| {
            if let Some(path) = lab.selected.get_untracked() {
                structure::toggle_lock(lab, &path);
            }
        },
    },
    Action {
        id: "merge",
        label: words::MERGE,
        keys: &["M"],
        enabled: |lab| match several(lab)?.len() {
            0 | 1 => Err(words::ONE_SELECTED),
            _ => Ok(()),
        },
        run: |lab| {
            let paths = lab.selection().iter().filter_map(|p| session::parse_path(p)).collect();
            lab.apply(&Command::Merge(paths));
        },
    },
    Action {
        id: "recognise",
        label: words::RECOGNISE,
        keys: &["R"],
        enabled: |lab| several(lab).map(drop),
        run: Lab::recognise,
    },
    Action {
        id: "unmerge",
        label: words::UNMERGE,
        keys: &[],
        enabled: |lab| {
            let row = selected(lab)?;
            let merged = row.merged_with.is_some()
                || lab.structure.with(|rows| {
                    rows.iter().any(|other| other.merged_with.as_deref() == Some(&row.path))
                });
            if merged { Ok(()) } else { Err(words::NOT_MERGED) }
        },
        run: |lab| on_selection(lab, Command::Unmerge),
    },
    Action {
        id: "enable",
        label: words::ENABLE,
        keys: &[],
        enabled: |lab| constraint(lab, false),
        run: |lab| on_selection(lab, |path| Command::Enable { path, on: true }),
    },
    Action {
        id: "disable",
        label: words::DISABLE,
        keys: &[],
        enabled: |lab| constraint(lab, true),
        run: |lab| on_selection(lab, |path| Command::Enable { path, on: false }),
    },
    Action {
        id: "delete",
        label: words::DELETE,
        keys: &["Delete"],
        enabled: |lab| selected(lab).map(drop),
        run: |lab| on_selection(lab, Command::Delete),
    },
    Action {
        id: "deselect",
        label: words::DESELECT,
        keys: &["Escape"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| {
            if lab.dragging.with_untracked(Option::is_some) {
                lab.cancel();
            } else {
                lab.select(None);
                lab.notice.set(None);
            }
        },
    },
    Action {
        id: "fit",
        label: words::FIT,
        keys: &["F"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| lab.zoom.set(Some(Zoom::Fit)),
    },
    Action {
        id: "zoom-in",
        label: words::ZOOM_IN,
        keys: &["+", "="],
        enabled: |lab| document(lab).map(drop),
        run: |lab| lab.zoom.set(Some(Zoom::By(1.25))),
    },
    Action {
        id: "zoom-out",
        label: words::ZOOM_OUT,
        keys: &["-"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| lab.zoom.set(Some(Zoom::By(0.8))),
    },
    Action {
        id: "grid",
        label: words::GRID,
        keys: &["G"],
        enabled: |lab| document(lab).map(drop),
        run: Lab::toggle_grid,
    },
    Action {
        id: "go-picture",
        label: words::GO_PICTURE,
        keys: &["Alt+1"],
        enabled: |lab| document(lab).map(drop),
        run: |_| focus("#picture"),
    },
    Action {
        id: "go-structure",
        label: words::GO_STRUCTURE,
        keys: &["Alt+2"],
        enabled: |lab| document(lab).map(drop),
        run: |_| focus("[role=treeitem][tabindex='0']"),
    },
    Action {
        id: "go-values",
        label: words::GO_VALUES,
        keys: &["Alt+3"],
        enabled: |lab| document(lab).map(drop),
        run: |_| focus(".values .field"),
    },
    Action {
        id: "go-text",
        label: words::GO_TEXT,
        keys: &["Alt+4"],
        enabled: |lab| document(lab).map(drop),
        run: |_| focus(".cm-content"),
    },
    Action {
        id: "download",
        label: words::DOWNLOAD,
        keys: &[],
        enabled: |lab| document(lab).map(drop),
        run: Lab::download,
    },
    Action {
        id: "gallery",
        label: words::OPEN_GALLERY,
        keys: &[],
        enabled: |_| Ok(()),
        run: |_| route::go(route::GALLERY),
    },
    Action {
        id: "theme",
        label: words::THEME,
        keys: &[],
        enabled: |_| Ok(()),
        run: |lab| lab.colors.theme.update(|theme| *theme = theme.next()),
    },
    Action {
        id: "palette",
        label: words::PALETTE,
        keys: &["Ctrl+K", "Ctrl+Shift+P"],
        enabled: |_| Ok(()),
        run: |lab| lab.palette.update(|open| *open = !*open),
    },
];

/// Returns the action of that name.
pub fn named(id: &str) -> &'static Action {
    ACTIONS.iter().find(|action| action.id == id).expect("the page names actions of its own table")
}

/// Does an action if it can be done; says why not if it cannot.
pub fn run(action: &Action, lab: Lab) {
    match untrack(|| (action.enabled)(lab)) {
        Ok(()) => (action.run)(lab),
        Err(why) => lab.notice.set(Some(Notice::Said(format!("{}: {why}", action.label)))),
    }
}

/// Whether there is a document, and then whether it has unsaved changes.
fn document(lab: Lab) -> Result<bool, &'static str> {
    lab.document.with(|document| document.as_ref().map(|d| d.dirty)).ok_or(words::NO_DOCUMENT)
}

/// The row of the selected thing.
fn selected(lab: Lab) -> Result<StructureRow, &'static str> {
    document(lab)?;
    let path = lab.selected.get().ok_or(words::NOTHING_SELECTED)?;
    lab.structure
        .with(|rows| rows.iter().find(|r| r.path == path && r.kind.has_own_path()).cloned())
        .ok_or(words::NOTHING_SELECTED)
}

/// The paths of what is selected, where there is something.
fn several(lab: Lab) -> Result<Vec<String>, &'static str> {
    document(lab)?;
    let selection = lab.selection();
    if selection.is_empty() { Err(words::NOTHING_SELECTED) } else { Ok(selection) }
}

/// Whether a constraint is selected that is on, or off, as is wanted.
fn constraint(lab: Lab, on: bool) -> Result<(), &'static str> {
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

fn apply(lab: Lab, command: &Command) {
    lab.apply(command);
}

fn on_selection(lab: Lab, command: impl FnOnce(Path) -> Command) {
    let path = lab.selected.get_untracked().and_then(|path| session::parse_path(&path));
    if let Some(path) = path {
        lab.apply(&command(path));
    }
}

fn focus(selector: &str) {
    if let Some(element) = leptos::prelude::document().query_selector(selector).ok().flatten() {
        // What cannot be focused stays as it is.
        let _ = element.unchecked_into::<web_sys::HtmlElement>().focus();
    }
}

/// Does what a key stands for; returns whether there is such an action.
pub fn key(lab: Lab, e: &KeyboardEvent) -> bool {
    let pressed = chord(e);
    let Some(action) = ACTIONS.iter().find(|action| action.keys.contains(&pressed.as_str())) else {
        return false;
    };
    let plain = !(e.ctrl_key() || e.meta_key() || e.alt_key());
    if plain && is_written_in(e) {
        return false;
    }
    run(action, lab);
    true
}

/// What is pressed, written as in the table; the command key of a Mac counts as Ctrl.
fn chord(e: &KeyboardEvent) -> String {
    let key = e.key();
    let letter = key.chars().count() == 1;
    let shift = e.shift_key() && (!letter || key.chars().all(char::is_alphabetic));
    let modifiers =
        [(e.ctrl_key() || e.meta_key(), "Ctrl+"), (e.alt_key(), "Alt+"), (shift, "Shift+")];
    let held = modifiers.iter().filter(|(held, _)| *held).map(|(_, name)| *name);
    let key = if letter { key.to_uppercase() } else { key };
    held.collect::<String>() + &key
}

/// Whether a key goes to a field or to the editor.
fn is_written_in(e: &KeyboardEvent) -> bool {
    let target = e.target().and_then(|target| target.dyn_into::<web_sys::Element>().ok());
    target.is_some_and(|target| {
        target
            .closest("input, textarea, select, [contenteditable='true']")
            .is_ok_and(|found| found.is_some())
    })
}

#[cfg(test)]
mod tests {
    use super::ACTIONS;
    use std::collections::BTreeSet;

    #[test]
    fn names_and_keys_are_told_apart() {
        let names: BTreeSet<&str> = ACTIONS.iter().map(|action| action.id).collect();
        assert_eq!(names.len(), ACTIONS.len());
        let keys: Vec<&str> = ACTIONS.iter().flat_map(|action| action.keys).copied().collect();
        assert_eq!(keys.iter().collect::<BTreeSet<_>>().len(), keys.len());
    }
}
