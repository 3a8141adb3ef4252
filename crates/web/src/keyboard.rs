//! Where the keyboard is: what gets it, and what has it again when something that had it is gone.

use crate::lab::Lab;
use leptos::ev::KeyboardEvent;
use leptos::prelude::{GetUntracked, Set, WithUntracked, document, request_animation_frame};
use wasm_bindgen::JsCast;
use web_sys::{Element, HtmlElement};

/// The row of the structure that Tab leads to.
const STOP_OF_TREE: &str = "[role=treeitem][tabindex='0']";

/// Which part of the page keys go to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum KeysAt {
    /// The picture, or nothing.
    Picture,
    /// The tree of the structure.
    Structure,
    /// The bin.
    Bin,
    /// The strip of what fits the selection.
    Strip,
    /// Anything else.
    Elsewhere,
}

/// Follows keys: what the status line says is for who uses them, until a pointer is pressed.
pub fn follow_key(lab: Lab, e: &KeyboardEvent) {
    // held down with the pointer, these are no keys of their own
    if !["Shift", "Control", "Alt", "Meta"].contains(&e.key().as_str()) {
        set_keys(lab, Some(keys_at()));
        // what had the keyboard may go with what the key does, and nothing tells
        request_animation_frame(move || follow_focus(lab));
    }
}

/// Follows who has the keyboard, while keys are what is used.
pub fn follow_focus(lab: Lab) {
    if lab.keys.with_untracked(Option::is_some) {
        set_keys(lab, Some(keys_at()));
    }
}

/// A pointer is used instead.
pub fn follow_pointer(lab: Lab) {
    set_keys(lab, None);
}

fn set_keys(lab: Lab, now: Option<KeysAt>) {
    if lab.keys.get_untracked() != now {
        lab.keys.set(now);
    }
}

fn keys_at() -> KeysAt {
    let Some(held) = holder().filter(|held| held.tag_name() != "BODY") else {
        return KeysAt::Picture;
    };
    let is_in = |selector| held.closest(selector).is_ok_and(|found| found.is_some());
    match () {
        () if is_in("#picture") => KeysAt::Picture,
        () if is_in("[role=tree]") => KeysAt::Structure,
        () if is_in(".bin") => KeysAt::Bin,
        () if is_in(".strip") => KeysAt::Strip,
        () => KeysAt::Elsewhere,
    }
}

/// Gives the keyboard to the first element of a selector, if there is one.
pub fn focus(selector: &str) {
    if let Some(element) = document().query_selector(selector).ok().flatten() {
        focus_element(&element);
    }
}

/// Who has the keyboard now.
pub fn holder() -> Option<Element> {
    document().active_element()
}

/// With the next frame, gives the keyboard to who had it before, if by then nobody has it; to the picture where that
/// one is gone from the page, too. A row of the structure that has been made anew is not gone.
pub fn give_back(before: Option<Element>) {
    let is_row = |before: &Element| before.get_attribute("role").is_some_and(|r| r == "treeitem");
    let row = before.as_ref().filter(|before| is_row(before)).map(|_| STOP_OF_TREE);
    request_animation_frame(move || {
        let has_none = holder().is_none_or(|holder| holder.tag_name() == "BODY");
        let is_shown = |stop: &&str| document().query_selector(stop).ok().flatten().is_some();
        match before.filter(|before| before.is_connected() && before.tag_name() != "BODY") {
            Some(before) if has_none => focus_element(&before),
            None if has_none => focus(row.filter(is_shown).unwrap_or("#picture")),
            _ => {}
        }
    });
}

/// With the next frame, gives the keyboard to the first element of a selector, if by then nobody has it.
pub fn rest_at(selector: &'static str) {
    request_animation_frame(move || {
        if holder().is_none_or(|holder| holder.tag_name() == "BODY") {
            focus(selector);
        }
    });
}

/// With the next frame, does what gives one of some elements the keyboard, unless by then an element that is none of them
/// has taken it: of keys that come faster than frames the last one counts.
pub fn unless_taken(own: &'static str, then: impl FnOnce() + 'static) {
    let before = holder();
    request_animation_frame(move || {
        let is_other =
            |now: &Element| now.tag_name() != "BODY" && !now.matches(own).unwrap_or(false);
        let is_before = |now: &Element| before.is_some_and(|before| before.is_same_node(Some(now)));
        let is_taken = holder().filter(is_other).is_some_and(|now| !is_before(&now));
        if !is_taken {
            then();
        }
    });
}

/// The buttons of a list, and the heads of its shelves, in order: those that no shut shelf hides.
fn buttons(list: &str) -> Vec<HtmlElement> {
    of_list(list, "")
}

/// Those of them that a selector finds.
fn of_list(list: &str, filter: &str) -> Vec<HtmlElement> {
    let Ok(Some(list)) = document().query_selector(list) else { return Vec::new() };
    let wanted = format!("button{filter}, summary{filter}");
    let Ok(found) = list.query_selector_all(&wanted) else { return Vec::new() };
    let all = (0..found.length()).filter_map(|i| found.item(i)?.dyn_into::<HtmlElement>().ok());
    all.filter(|e| !is_shut_away(e)).collect()
}

/// Whether a shut shelf hides it, rather than is its head. A button that is hidden otherwise is a stop as the others.
fn is_shut_away(e: &HtmlElement) -> bool {
    let shut = e.closest("details:not([open])").ok().flatten();
    shut.is_some_and(|shelf| {
        let is_its = e.parent_element().is_some_and(|owner| owner.is_same_node(Some(&shelf)));
        e.tag_name() != "SUMMARY" || !is_its
    })
}

/// With the next frame, makes the buttons of a list one stop of Tab: the one that is chosen, or comes next, or was it
/// last, or the first. To be said again where its rows are others.
pub fn one_stop(list: &'static str) {
    request_animation_frame(move || {
        // of a long list few are looked at: those that are stops already, as each new one is
        let stops = of_list(list, ":not([tabindex='-1'])");
        let held = holder().and_then(|held| held.dyn_into::<HtmlElement>().ok());
        let held = held.filter(|held| is_in(held, list));
        let first = |filter| of_list(list, filter).into_iter().next();
        let stop = held
            .or_else(|| first("[aria-selected='true']"))
            .or_else(|| first("[aria-current='step']"))
            // a new button has no such word of its own
            .or_else(|| first("[tabindex='0']"))
            .or_else(|| first(""));
        let is_it = |b: &HtmlElement| stop.as_ref().is_some_and(|stop| b.is_same_node(Some(stop)));
        for other in stops.iter().filter(|b| !is_it(b)) {
            other.set_tab_index(-1);
        }
        if let Some(stop) = stop {
            stop.set_tab_index(0);
        }
    });
}

/// Whether a button, or the head of a shelf, belongs to a list.
fn is_in(e: &HtmlElement, list: &str) -> bool {
    let is_button = e.matches("button, summary").unwrap_or(false);
    is_button && e.closest(list).is_ok_and(|list| list.is_some()) && !is_shut_away(e)
}

fn stop_at(all: &[HtmlElement], at: usize) {
    for (i, button) in all.iter().enumerate() {
        button.set_tab_index(if i == at { 0 } else { -1 });
    }
}

/// What a key does in a list that is one stop: down and up lead from row to row, right and left from button to button,
/// Home and End to the ends.
pub fn go_in(list: &str, e: &KeyboardEvent) {
    let all = buttons(list);
    let held = holder();
    let is_held = |b: &HtmlElement| held.as_ref().is_some_and(|held| b.is_same_node(Some(held)));
    let Some(at) = all.iter().position(is_held) else { return };
    let row = |i: usize| all[i].closest("li").ok().flatten();
    let is_other = |a: usize, b: usize| match (row(a), row(b)) {
        (Some(a), Some(b)) => !a.is_same_node(Some(&b)),
        _ => true,
    };
    let begins = |&i: &usize| i == 0 || is_other(i - 1, i);
    let to = match e.key().as_str() {
        "ArrowDown" => (at + 1..all.len()).find(begins),
        "ArrowUp" => {
            let own = (0..=at).rev().find(begins).unwrap_or(0);
            (0..own).rev().find(begins)
        }
        "ArrowRight" => (at + 1 < all.len()).then_some(at + 1),
        "ArrowLeft" => at.checked_sub(1),
        "Home" => Some(0),
        "End" => (0..all.len()).rev().find(begins),
        _ => return,
    };
    e.prevent_default();
    e.stop_propagation();
    if let Some(to) = to {
        stop_at(&all, to);
        focus_element(&all[to]);
    }
}

/// What an arrow key does in a row of buttons, each of which is a stop of Tab: it leads to the next one.
pub fn go_beside(list: &str, e: &KeyboardEvent) {
    let all = buttons(list);
    let held = holder();
    let is_held = |b: &HtmlElement| held.as_ref().is_some_and(|held| b.is_same_node(Some(held)));
    let Some(at) = all.iter().position(is_held) else { return };
    let to = match e.key().as_str() {
        "ArrowRight" | "ArrowDown" => (at + 1) % all.len(),
        "ArrowLeft" | "ArrowUp" => (at + all.len() - 1) % all.len(),
        _ => return,
    };
    e.prevent_default();
    e.stop_propagation();
    focus_element(&all[to]);
}

/// Gives the keyboard to the first button of a list that is one stop.
pub fn enter_list(list: &str) {
    enter_list_at(list, "button");
}

/// Gives the keyboard to the first button of a list that is one stop, of those that a selector finds.
pub fn enter_list_at(list: &str, selector: &str) {
    let all = buttons(list);
    let Some(first) = all.iter().position(|button| button.matches(selector).unwrap_or(false))
    else {
        return;
    };
    stop_at(&all, first);
    focus_element(&all[first]);
}

fn focus_element(element: &Element) {
    if let Some(element) = element.dyn_ref::<HtmlElement>() {
        // What cannot be focused stays as it is.
        let _ = element.focus();
    }
}
