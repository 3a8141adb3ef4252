//! Every construction in scope, by the class of what it makes.

use super::once_painted;
use crate::bin_panel::Uses;
use crate::lab::Lab;
use crate::{keyboard, words};
use leptos::prelude::*;
use presentation::find::has_words;
use session::drafting::view::ConstructionRow;
use session::view::BinEntry;
use std::collections::BTreeSet;

/// The list of all constructions.
const LIST: &str = ".drawing .shelves";

/// Every construction in scope, by the class of what it makes.
#[component]
pub fn Constructions(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let wanted = RwSignal::new(String::new());
    let track = move || {
        lab.text.track();
        lab.drafting.turned.track();
    };
    let all = once_painted(track, move || {
        lab.id().map(|id| lab.ask(|session| session.constructions(id)))
    });
    let found = Memo::new(move |_| {
        let wanted = wanted.get().to_lowercase();
        let fits = |row: &ConstructionRow| says(row, row.also, &wanted);
        all.with(|all| all.iter().flatten().filter(|row| fits(row)).cloned().collect::<Vec<_>>())
    });
    // what is looked for may be drawn by a library that is not used yet
    let offered = Memo::new(move |_| {
        let wanted = wanted.get();
        let has = |entry: &BinEntry| has_words(&[&*entry.class, &*entry.doc].join(" "), &wanted);
        let all = match wanted.trim().is_empty() {
            true => Vec::new(),
            false => lab.in_unused_libraries(),
        };
        let found = all.into_iter().filter(has).map(|entry| entry.library);
        found.collect::<BTreeSet<_>>().into_iter().collect::<Vec<_>>()
    });
    // Enter begins this one
    let best = Memo::new(move |_| {
        let wanted = wanted.get().trim().to_lowercase();
        let rank = |row: &ConstructionRow| match row.id.to_lowercase() == wanted {
            true => 0,
            false if row.label.to_lowercase().starts_with(&wanted) => 1,
            false if row.also.contains(&wanted) => 2,
            // what it is called counts more than what is said of it, and that more than other words for it
            false if has_words(&row.label, &wanted) => 3,
            false if says(row, "", &wanted) => 4,
            false => 5,
        };
        let first =
            found.with(|rows| rows.iter().min_by_key(|row| rank(row)).map(|r| r.id.clone()));
        first.filter(|_| !wanted.is_empty())
    });
    let shelves = move || {
        let mut shelves: Vec<(String, Vec<ConstructionRow>)> = Vec::new();
        for row in found.get() {
            match shelves.iter_mut().find(|(class, _)| *class == row.class) {
                Some((_, shelf)) => shelf.push(row),
                None => shelves.push((row.class.clone(), vec![row])),
            }
        }
        let shelf = |(class, rows): (String, Vec<ConstructionRow>)| {
            let one = |row| view! { <Construction lab=lab row=row best=best /> };
            view! {
                <h3>{class}</h3>
                <ul class="constructions">{rows.into_iter().map(one).collect_view()}</ul>
            }
        };
        shelves.into_iter().map(shelf).collect_view()
    };
    let key = move |e: leptos::ev::KeyboardEvent| match e.key().as_str() {
        "Enter" => {
            if let Some(best) = best.get_untracked() {
                e.prevent_default();
                // all are in sight for the next one
                wanted.set(String::new());
                lab.begin_construction(&best);
            }
        }
        "ArrowDown" => {
            e.prevent_default();
            keyboard::enter_list(LIST);
        }
        _ => {}
    };
    Effect::new(move |_| {
        found.track();
        keyboard::one_stop(LIST);
    });
    view! {
        <input type="search" name="construction" placeholder=words::FILTER aria-label=words::FILTER_CONSTRUCTIONS
            title=words::FILTER_HELP
            prop:value=move || wanted.get()
            on:input=move |e| {
                wanted.set(event_target_value(&e));
                lab.read_libraries();
            }
            on:keydown=key />
        <Show when=move || all.with(Option::is_some) && found.with(Vec::is_empty)>
            <p class="quiet">{words::NO_CONSTRUCTION}</p>
        </Show>
        <Show when=move || !offered.with(Vec::is_empty)>
            <h3>{words::NOT_USED_YET}</h3>
            <Uses names=offered take=move |name: String| { lab.use_library(&name); } />
        </Show>
        <div class="shelves" on:keydown=|e| keyboard::go_in(LIST, &e)>{shelves}</div>
    }
}

/// Whether a construction's words, with other words for it, have all that are wanted; `at` and `of` tell nothing.
fn says(row: &ConstructionRow, also: &str, wanted: &str) -> bool {
    let words = wanted.split_whitespace();
    let telling: Vec<&str> = words.filter(|word| word.chars().count() > 2).collect();
    let wanted = if telling.is_empty() { wanted.into() } else { telling.join(" ") };
    has_words(&[&row.label, &row.id, &row.operands, &row.doc, also].join(" "), &wanted)
}

#[component]
fn Construction(
    lab: Lab,
    row: ConstructionRow,
    /// The one that Enter begins.
    best: Memo<Option<String>>,
) -> impl IntoView {
    let id = StoredValue::new(row.id.clone());
    let is_best = Memo::new(move |_| best.with(|best| best.as_ref() == Some(&id.get_value())));
    let held = Memo::new(move |_| {
        lab.drafting.prompt.with(|p| p.as_ref().is_some_and(|p| p.tool == id.get_value()))
    });
    view! {
        <li>
            <button data-construction=row.id title=row.doc class:best=is_best aria-pressed=move || held.get().to_string()
                on:click=move |_| lab.begin_construction(&id.get_value())>
                {row.label}" "<span class="quiet">{row.operands}</span>
            </button>
        </li>
    }
}
