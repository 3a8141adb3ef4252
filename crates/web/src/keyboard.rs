//! Where the keyboard is: what gets it, and what has it again when something that had it is gone.

use leptos::prelude::{document, request_animation_frame};
use wasm_bindgen::JsCast;
use web_sys::{Element, HtmlElement};

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
/// one is gone from the page, too.
pub fn give_back(before: Option<Element>) {
    request_animation_frame(move || {
        let has_none = holder().is_none_or(|holder| holder.tag_name() == "BODY");
        match before.filter(|before| before.is_connected() && before.tag_name() != "BODY") {
            Some(before) if has_none => focus_element(&before),
            None if has_none => focus("#picture"),
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

fn focus_element(element: &Element) {
    if let Some(element) = element.dyn_ref::<HtmlElement>() {
        // What cannot be focused stays as it is.
        let _ = element.focus();
    }
}
