//! One table of what can be done: it makes the buttons, the menu, the palette and the shortcuts.

use crate::js;
use crate::lab::{Lab, Notice};
use leptos::ev::KeyboardEvent;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use wasm_bindgen::closure::Closure;

mod conditions;
pub(crate) use conditions::lockable;
mod instances;
mod of_class;
mod recording;
mod table;
pub use table::ACTIONS;

/// Something that can be done; two are the same if they have one name.
#[derive(Debug)]
pub struct Action {
    /// Its name for scripts and tests.
    pub id: &'static str,
    /// Where menus have it.
    pub group: Group,
    /// On what the context menu offers it.
    pub contexts: &'static [Context],
    /// What it is called.
    pub label: &'static str,
    /// The keys that do it, the first of which is shown.
    pub keys: &'static [&'static str],
    /// Whether it can be done now, or why not.
    pub enabled: fn(Lab) -> Result<(), &'static str>,
    /// Does it.
    pub run: fn(Lab),
}

/// What actions stand together in menus.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Group {
    /// Documents.
    File,
    /// Changes.
    Edit,
    /// Merges.
    Join,
    /// What the hand does in the picture.
    Tool,
    /// What one sees.
    View,
    /// Where the keyboard is.
    Go,
}

/// What the context menu was asked for on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Context {
    /// The empty sheet.
    Sheet,
    /// Something selected.
    Thing,
    /// A value of a table.
    Value,
    /// A class of the document's own, in the bin.
    Class,
}

impl PartialEq for Action {
    fn eq(&self, other: &Self) -> bool {
        self.id == other.id
    }
}

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

/// Does what a key stands for; returns whether there is such an action.
pub fn key(lab: Lab, e: &KeyboardEvent) -> bool {
    let pressed = chord(e);
    let Some(action) = ACTIONS.iter().find(|action| action.keys.contains(&pressed.as_str())) else {
        return false;
    };
    // the browser says these itself, with the clipboard
    if ["copy", "cut", "paste"].contains(&action.id) {
        return false;
    }
    let plain = !(e.ctrl_key() || e.meta_key() || e.alt_key());
    if (plain || action.id == "select-all") && is_written_in(e) {
        return false;
    }
    run(action, lab);
    true
}

/// Copies, cuts and pastes by the clipboard, where the browser says so.
pub fn follow_clipboard(lab: Lab) {
    let take = move |kind: String| {
        let action = named(if kind == "cut" { "cut" } else { "copy" });
        if untrack(|| (action.enabled)(lab)).is_err() {
            return None;
        }
        if kind == "cut" { lab.cut_selection() } else { lab.copy_selection() }
    };
    let put = move |text: String| {
        if untrack(|| (named("paste").enabled)(lab)).is_ok() {
            lab.paste_text(&text);
        }
    };
    let take = Closure::<dyn FnMut(String) -> Option<String>>::new(take);
    let put = Closure::<dyn FnMut(String)>::new(put);
    js::on_clipboard(take.into_js_value().unchecked_ref(), put.into_js_value().unchecked_ref());
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

/// Names and keys are told apart: seen where the page is compiled, since no other program has this table.
const _: () = {
    let mut at = 0;
    while at < ACTIONS.len() {
        let (one, mut other) = (&ACTIONS[at], 0);
        while other < ACTIONS.len() {
            let is_other = other != at;
            assert!(!is_other || !is_same(one.id, ACTIONS[other].id), "two actions have one name");
            let mut key = 0;
            while key < one.keys.len() {
                let mut those = 0;
                while those < ACTIONS[other].keys.len() {
                    let is_other = is_other || those != key;
                    let is_same = is_other && is_same(one.keys[key], ACTIONS[other].keys[those]);
                    assert!(!is_same, "two actions have one key");
                    those += 1;
                }
                key += 1;
            }
            other += 1;
        }
        at += 1;
    }
};

/// Whether two texts are the same, told while the page is compiled.
const fn is_same(one: &str, other: &str) -> bool {
    let (one, other) = (one.as_bytes(), other.as_bytes());
    let mut same = one.len() == other.len();
    let mut at = 0;
    while same && at < one.len() {
        same = one[at] == other[at];
        at += 1;
    }
    same
}
