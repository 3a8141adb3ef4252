//! Small controls that several views share: a value's field, its lock.

use crate::lab::Lab;
use crate::{icons, structure, words};
use leptos::ev::KeyboardEvent;
use leptos::html::Input;
use leptos::prelude::*;
use presentation::numbers::{exactly, to_read};

/// Brings an element into sight within the panel that it scrolls in, if it is there. The page itself stays:
/// what is selected in the picture must not take the picture away.
pub fn scroll_to(id: &str) {
    let Some(element) = document().get_element_by_id(id) else { return };
    let Some(panel) = element.closest(".scroll").ok().flatten() else { return };
    let (own, frame) = (element.get_bounding_client_rect(), panel.get_bounding_client_rect());
    let above = own.top() - frame.top();
    let below = own.bottom() - frame.bottom();
    let by = if above < 0.0 { above } else { below.max(0.0) };
    panel.set_scroll_top(panel.scroll_top() + by.round() as i32);
}

/// A field that is open only while a value is typed.
#[component]
pub fn Edit(
    /// The lab.
    lab: Lab,
    /// Whose value.
    path: Memo<String>,
    /// The value now.
    value: String,
    /// What happens when it is done, or given up.
    done: impl Fn() + Copy + Send + 'static,
) -> impl IntoView {
    let input = NodeRef::<Input>::new();
    let shown = to_read(&value);
    let begun = StoredValue::new(value);
    let error = RwSignal::new(None::<String>);
    let over = StoredValue::new(false);
    let sent = StoredValue::new(false);
    Effect::new(move |_| {
        if let Some(input) = input.get() {
            request_animation_frame(move || {
                // A field that has gone meanwhile needs no focus.
                let _ = input.focus();
                input.select();
            });
        }
    });
    let accept = move || {
        let Some(field) = input.get_untracked() else { return };
        if sent.try_update_value(|sent| std::mem::replace(sent, true)) == Some(true) {
            return;
        }
        let typed = begun.with_value(|value| exactly(&field.value(), value));
        // the field may have gone until it is known what came of it
        lab.set_typed(&path.get_untracked(), &typed, move |outcome| {
            let is_gone = sent.try_set_value(false).is_some();
            match outcome {
                Ok(()) if is_gone => {}
                Ok(()) => {
                    over.set_value(true);
                    done();
                }
                Err(refusal) => {
                    if let Some(why) = error.try_set(Some(refusal.in_a_line())).flatten() {
                        lab.say_refused(why);
                    }
                }
            }
        });
    };
    let key = move |e: KeyboardEvent| {
        e.stop_propagation();
        match e.key().as_str() {
            "Enter" => accept(),
            "Escape" => {
                over.set_value(true);
                done();
            }
            _ => {}
        }
    };
    view! {
        <span class="edit" on:click=|e| e.stop_propagation() on:dblclick=|e| e.stop_propagation()>
            <input node_ref=input prop:value=shown aria-label=path
                aria-invalid=move || error.with(Option::is_some).to_string()
                on:keydown=key
                on:blur=move |_| {
                    if over.try_get_value() == Some(false) && error.with_untracked(Option::is_none) {
                        done();
                    }
                } />
            {move || error.get().map(|error| view! { <span class="error" role="alert">{error}</span> })}
        </span>
    }
}

/// The button that locks a value.
#[component]
pub fn Lock(
    /// The lab.
    lab: Lab,
    /// Whose value.
    path: Memo<String>,
    /// Whether it is locked.
    anchored: Memo<bool>,
) -> impl IntoView {
    view! {
        <button class="lock" tabindex="-1" class:held=anchored
            aria-pressed=move || anchored.get().to_string()
            aria-label=move || format!("{} {}", words::LOCK_NAME, path.get())
            title=move || if anchored.get() { words::LOCKED } else { words::UNLOCKED }
            on:click=move |e: leptos::ev::MouseEvent| {
                e.stop_propagation();
                structure::toggle_lock(lab, &[path.get_untracked()]);
            }>
            {move || if anchored.get() { icons::locked() } else { icons::unlocked() }}
        </button>
    }
}
