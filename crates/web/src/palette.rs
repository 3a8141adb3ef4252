//! The palette: every action by name, with its key, or with the reason why not now.

use crate::actions::{self, ACTIONS, Action};
use crate::lab::Lab;
use crate::words;
use leptos::ev::KeyboardEvent;
use leptos::html::Input;
use leptos::prelude::*;

/// The palette, while it is open.
#[component]
pub fn Palette(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    view! { <Show when=move || lab.palette.get()><Open lab=lab /></Show> }
}

#[component]
fn Open(lab: Lab) -> impl IntoView {
    let input = NodeRef::<Input>::new();
    let wanted = RwSignal::new(String::new());
    let at = RwSignal::new(0_usize);
    let before = StoredValue::new_local(document().active_element());
    let found = Memo::new(move |_| {
        at.set(0);
        matching(&wanted.get())
    });
    Effect::new(move |_| {
        if let Some(input) = input.get() {
            // It stands in the page, so it takes the focus.
            let _ = input.focus();
        }
    });
    let close = move || {
        lab.palette.set(false);
        if let Some(element) = before.get_value() {
            let element: web_sys::HtmlElement = wasm_bindgen::JsCast::unchecked_into(element);
            // What had the keyboard may be gone.
            let _ = element.focus();
        }
    };
    let choose = move |n: usize| {
        if let Some(action) = found.with_untracked(|found| found.get(n).map(|at| &ACTIONS[*at])) {
            close();
            actions::run(action, lab);
        }
    };
    let key = move |e: KeyboardEvent| {
        let count = found.with_untracked(Vec::len).max(1);
        match e.key().as_str() {
            "ArrowDown" => at.update(|at| *at = (*at + 1) % count),
            "ArrowUp" => at.update(|at| *at = (*at + count - 1) % count),
            "Enter" => choose(at.get_untracked()),
            "Escape" => close(),
            "k" if e.ctrl_key() || e.meta_key() => close(),
            _ => return,
        }
        e.prevent_default();
        e.stop_propagation();
    };
    let rows = move || {
        let list = found.get().into_iter().enumerate();
        list.map(|(n, action)| {
            view! { <Entry lab=lab action=&ACTIONS[action] n=n at=at choose=choose /> }
        })
        .collect_view()
    };
    view! {
        <div class="shade" on:pointerdown=move |_| close()>
            <div class="palette" role="dialog" aria-modal="true" aria-label=words::PALETTE
                on:pointerdown=|e| e.stop_propagation()>
                <input node_ref=input type="text" role="combobox" aria-expanded="true"
                    aria-controls="actions" aria-autocomplete="list"
                    aria-activedescendant=move || format!("action-{}", at.get())
                    aria-label=words::PALETTE placeholder=words::PALETTE
                    spellcheck="false" autocomplete="off"
                    on:input=move |e| wanted.set(event_target_value(&e))
                    on:keydown=key />
                <ul id="actions" role="listbox" aria-label=words::PALETTE>{rows}</ul>
                <Show when=move || found.with(Vec::is_empty)>
                    <p class="quiet">{words::NO_SUCH_ACTION}</p>
                </Show>
            </div>
        </div>
    }
}

#[component]
fn Entry(
    lab: Lab,
    action: &'static Action,
    n: usize,
    at: RwSignal<usize>,
    choose: impl Fn(usize) + Copy + 'static,
) -> impl IntoView {
    let why = Memo::new(move |_| (action.enabled)(lab).err());
    view! {
        <li id=format!("action-{n}") role="option" data-action=action.id
            aria-selected=move || (at.get() == n).to_string()
            aria-disabled=move || why.get().is_some().to_string()
            on:pointerenter=move |_| at.set(n)
            on:click=move |_| choose(n)>
            <span class="label">{action.label}</span>
            <span class="reason">{why}</span>
            {action.keys.first().map(|key| view! { <kbd>{*key}</kbd> })}
        </li>
    }
}

/// The actions whose label has all letters of what is wanted, in order; whole words first.
fn matching(wanted: &str) -> Vec<usize> {
    let wanted = wanted.trim().to_lowercase();
    let rank = |label: &str| {
        let label = label.to_lowercase();
        if label.contains(&wanted) { Some(0) } else { scattered(&label, &wanted).then_some(1) }
    };
    let mut found: Vec<(i32, usize)> = ACTIONS
        .iter()
        .enumerate()
        .filter_map(|(n, action)| rank(action.label).map(|rank| (rank, n)))
        .collect();
    found.sort();
    found.into_iter().map(|(_, n)| n).collect()
}

fn scattered(label: &str, wanted: &str) -> bool {
    let mut letters = label.chars();
    wanted.chars().all(|letter| letters.any(|found| found == letter))
}

#[cfg(test)]
mod tests {
    use super::matching;
    use crate::actions::ACTIONS;

    #[test]
    fn the_palette_finds_by_words_before_letters() {
        assert_eq!(matching("").len(), ACTIONS.len());
        let first = |wanted| matching(wanted).first().map(|n| ACTIONS[*n].id);
        assert_eq!(first("zoom in"), Some("zoom-in"));
        assert_eq!(first("und"), Some("undo"));
        assert_eq!(first("ftp"), Some("fit"));
        assert_eq!(first("qqq"), None);
    }
}
