//! Menus: some actions of the table at a place of the page, each with its key or with why not now.

use crate::actions::{self, ACTIONS, Action, Context, Group};
use crate::apart::apart;
use crate::lab::Lab;
use crate::words;
use leptos::ev::{KeyboardEvent, MouseEvent};
use leptos::html::Div;
use leptos::prelude::*;
use wasm_bindgen::JsCast;

/// A menu that is open.
#[derive(Clone, PartialEq, Debug)]
pub struct Menu {
    /// Where its corner lies, in pixels of the page.
    pub at: (f64, f64),
    /// What it is the menu of.
    pub label: &'static str,
    /// What it offers, in order.
    pub actions: Vec<&'static Action>,
}

/// Opens the menu of a group below the button that was pressed; pressed again it closes.
pub fn open_below(lab: Lab, e: &MouseEvent, group: Group) {
    let button = e.current_target().and_then(|t| t.dyn_into::<web_sys::Element>().ok());
    let Some(rect) = button.map(|button| button.get_bounding_client_rect()) else { return };
    let actions = ACTIONS.iter().filter(|action| action.group == group).collect();
    let menu = Menu { at: (rect.left(), rect.bottom() + 4.0), label: words::FILE, actions };
    lab.menu.update(|open| *open = if open.is_some() { None } else { Some(menu) });
}

/// Opens the menu of what was pressed at a place of the page.
pub fn open_at(lab: Lab, at: (f64, f64), context: Context) {
    // of a thing only what can be done with it: what is of another kind need not say why not
    let can =
        |action: &&Action| context == Context::Sheet || untrack(|| (action.enabled)(lab)).is_ok();
    let actions = ACTIONS.iter().filter(|action| action.contexts.contains(&context));
    let actions = actions.filter(can).collect();
    lab.menu.set(Some(Menu { at, label: words::MENU, actions }));
}

/// The open menu, if there is one.
#[component]
pub fn MenuView(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    move || lab.menu.get().map(|menu| apart(|| view! { <Open lab=lab menu=menu /> }))
}

#[component]
fn Open(lab: Lab, menu: Menu) -> impl IntoView {
    let list = NodeRef::<Div>::new();
    let before = StoredValue::new_local(document().active_element());
    let at = RwSignal::new(menu.at);
    let focus = move |by: isize, from: Option<usize>| {
        let Some(list) = list.get_untracked() else { return };
        let items = list.children();
        let count = items.length() as isize;
        if count == 0 {
            return;
        }
        let next = from.map_or(0, |from| (from as isize + by).rem_euclid(count));
        if let Some(item) = items.item(next as u32) {
            // What was focused is still there until the menu closes.
            let _ = item.unchecked_into::<web_sys::HtmlElement>().focus();
        }
    };
    Effect::new(move |_| {
        let Some(list) = list.get() else { return };
        let rect = list.get_bounding_client_rect();
        let size = |value: Result<wasm_bindgen::JsValue, _>| {
            value.ok().and_then(|v| v.as_f64()).unwrap_or(f64::INFINITY)
        };
        let (width, height) = (size(window().inner_width()), size(window().inner_height()));
        let inside = |at: f64, size: f64, most: f64| at.min(most - size - 4.0).max(4.0);
        at.update(|at| {
            *at = (inside(at.0, rect.width(), width), inside(at.1, rect.height(), height));
        });
        focus(0, None);
    });
    let close = move || {
        lab.menu.set(None);
        if let Some(element) = before.get_value() {
            // What had the keyboard may be gone.
            let _ = element.unchecked_into::<web_sys::HtmlElement>().focus();
        }
    };
    let key = move |n: usize, e: &KeyboardEvent| {
        match e.key().as_str() {
            "ArrowDown" => focus(1, Some(n)),
            "ArrowUp" => focus(-1, Some(n)),
            "Home" => focus(0, None),
            "End" => focus(-1, Some(0)),
            "Escape" | "Tab" => close(),
            _ => return,
        }
        e.prevent_default();
        e.stop_propagation();
    };
    // a finger that opened the menu by lying still clicks what is below it when it is lifted
    let is_pressed = StoredValue::new(false);
    let items = menu.actions.into_iter().enumerate().map(|(n, action)| {
        let why = Memo::new(move |_| (action.enabled)(lab).err());
        let go = move |e: MouseEvent| {
            let is_meant = e.detail() == 0 || is_pressed.get_value();
            if is_meant && why.get_untracked().is_none() {
                close();
                actions::run(action, lab);
            }
        };
        view! {
            <button class="item" role="menuitem" tabindex="-1" data-action=action.id
                aria-disabled=move || why.get().is_some().to_string()
                title=move || why.get()
                on:click=go
                on:keydown=move |e: KeyboardEvent| key(n, &e)>
                <span>{action.label}</span>
                {action.keys.first().map(|key| view! { <kbd>{*key}</kbd> })}
            </button>
        }
    });
    view! {
        <div class="veil" on:pointerdown=move |_| close() on:contextmenu=|e| e.prevent_default()></div>
        <nav aria-label=menu.label>
            <div class="menu" role="menu" aria-label=menu.label node_ref=list
                on:pointerdown=move |_| is_pressed.set_value(true)
                style:left=move || format!("{}px", at.get().0)
                style:top=move || format!("{}px", at.get().1)>
                {items.collect_view()}
            </div>
        </nav>
    }
}
