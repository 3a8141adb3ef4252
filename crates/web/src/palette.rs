//! The palette: every action by name, with its key or with the reason why not now; every construction and every class
//! of the bin that has the words; every document.

use crate::actions::{self, ACTIONS, Action};
use crate::lab::Lab;
use crate::{route, words};
use leptos::ev::KeyboardEvent;
use leptos::html::Input;
use leptos::prelude::*;
use presentation::palette::{self, Choice, Drawn, Makeable};

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
    let drawn = Memo::new(move |_| drawn(lab));
    lab.read_libraries();
    let found = Memo::new(move |_| {
        let wanted = wanted.get();
        let actions = ACTIONS.iter().map(|action| (action, action.id, action.label));
        let actions: Vec<palette::Named<&'static Action>> = actions.collect();
        let mut found = lab
            .listed
            .with(|listed| drawn.with(|drawn| palette::matching(&wanted, &actions, listed, drawn)));
        if wanted.is_empty() {
            // who looks what there is sees first what can be done now
            let place = |choice: &Choice<&'static Action>| match choice {
                Choice::Do(action) if untrack(|| (action.enabled)(lab)).is_ok() => 0,
                Choice::Do(_) => 1,
                Choice::Draw(_) | Choice::Insert(_) | Choice::Select(_) | Choice::Open(_) => 2,
            };
            found.sort_by_key(place);
        }
        found
    });
    leptos::task::spawn_local(async move {
        // Without the list there are still the actions.
        let _ = lab.fetch_list().await;
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
        let Some(choice) = found.with_untracked(|found| found.get(n).cloned()) else { return };
        close();
        match choice {
            Choice::Do(action) => actions::run(action, lab),
            Choice::Draw(row) => lab.begin_construction(&row.id),
            Choice::Insert(one) => {
                if lab.with_library(&one, Lab::take_tool) {
                    crate::keyboard::focus("#picture");
                }
            }
            Choice::Select(path) => lab.select(Some(path)),
            Choice::Open(listed) => route::go(&route::to(&listed.path)),
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
            // the keyboard stays in what lies over the page
            "Tab" => {}
            _ => return,
        }
        e.prevent_default();
        e.stop_propagation();
    };
    let rows = move || {
        let list = found.get().into_iter().enumerate();
        list.map(|(n, choice)| view! { <Entry lab=lab choice=choice n=n at=at choose=choose /> })
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
                    on:input=move |e| {
                        wanted.set(event_target_value(&e));
                        at.set(0);
                    }
                    on:keydown=key />
                <ul id="actions" role="listbox" aria-label=words::PALETTE>{rows}</ul>
                <Show when=move || found.with(Vec::is_empty)>
                    <p class="quiet">{words::NO_SUCH_ACTION}</p>
                </Show>
            </div>
        </div>
    }
}

fn drawn(lab: Lab) -> Drawn {
    let constructions = lab.ask_of_shown(session::Session::constructions).unwrap_or_default();
    let own = lab.ask_of_shown(session::Session::bin_names).unwrap_or_default();
    let own = own.into_iter().map(|class| Makeable { class, unused: None });
    let unused = lab.in_unused_libraries().into_iter();
    let other = unused.map(|one| Makeable { class: one.class, unused: Some(one.library) });
    let things = lab.structure.with(|rows| palette::named_things(rows));
    (constructions, own.chain(other).collect(), things)
}

#[component]
fn Entry(
    lab: Lab,
    choice: Choice<&'static Action>,
    n: usize,
    at: RwSignal<usize>,
    choose: impl Fn(usize) + Copy + 'static,
) -> impl IntoView {
    let (name, label, action) = match choice {
        Choice::Do(action) => (String::from(action.id), String::from(action.label), Some(action)),
        Choice::Draw(row) => (row.operands, row.label, None),
        Choice::Insert(Makeable { class, unused }) => {
            (unused.unwrap_or_else(|| class.clone()), words::place_one(&class), None)
        }
        Choice::Select(path) => {
            (String::from(words::PART_OF_THIS), format!("{} {path}", words::SELECT_ONE), None)
        }
        Choice::Open(listed) => (listed.path, format!("{} {}", words::OPEN, listed.title), None),
    };
    // of a document where it is, of a construction what it is made of
    let path = if action.is_none() { name.clone() } else { String::new() };
    let why = Memo::new(move |_| action.and_then(|action| (action.enabled)(lab).err()));
    let key = action.and_then(|action| action.keys.first());
    view! {
        <li id=format!("action-{n}") role="option" data-action=name
            aria-selected=move || (at.get() == n).to_string()
            aria-disabled=move || why.get().is_some().to_string()
            // one that rests where the list comes up chooses nothing
            on:pointermove=move |e| {
                let has_moved = e.movement_x() != 0 || e.movement_y() != 0;
                if has_moved && at.get_untracked() != n {
                    at.set(n);
                }
            }
            on:click=move |_| choose(n)>
            <span class="label">{label}</span>
            <span class="reason">{path}{why}</span>
            {key.map(|key| view! { <kbd>{*key}</kbd> })}
        </li>
    }
}
