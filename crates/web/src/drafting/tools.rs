//! Every construction in scope, by the class of what it makes.

use crate::lab::Lab;
use crate::words;
use leptos::prelude::*;
use session::drafting::view::ConstructionRow;

/// Every construction in scope, by the class of what it makes.
#[component]
pub fn Constructions(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let wanted = RwSignal::new(String::new());
    let all = Memo::new(move |_| {
        lab.text.track();
        lab.drafting.turned.track();
        lab.id().map(|id| lab.ask(|session| session.constructions(id))).unwrap_or_default()
    });
    let shelves = move || {
        let wanted = wanted.get().to_lowercase();
        let mut shelves: Vec<(String, Vec<ConstructionRow>)> = Vec::new();
        for row in all.get() {
            let text =
                format!("{} {} {} {}", row.label, row.id, row.operands, row.doc).to_lowercase();
            if !wanted.split_whitespace().all(|word| text.contains(word)) {
                continue;
            }
            match shelves.iter_mut().find(|(class, _)| *class == row.class) {
                Some((_, shelf)) => shelf.push(row),
                None => shelves.push((row.class.clone(), vec![row])),
            }
        }
        let shelf = |(class, rows): (String, Vec<ConstructionRow>)| {
            view! {
                <h3>{class}</h3>
                <ul class="constructions">
                    {rows.into_iter().map(|row| view! { <Construction lab=lab row=row /> }).collect_view()}
                </ul>
            }
        };
        shelves.into_iter().map(shelf).collect_view()
    };
    view! {
        <input type="search" placeholder=words::FILTER aria-label=words::FILTER_CONSTRUCTIONS
            on:input=move |e| wanted.set(event_target_value(&e)) />
        {shelves}
    }
}

#[component]
fn Construction(lab: Lab, row: ConstructionRow) -> impl IntoView {
    let id = StoredValue::new(row.id.clone());
    let held = Memo::new(move |_| {
        lab.drafting.prompt.with(|p| p.as_ref().is_some_and(|p| p.tool == id.get_value()))
    });
    view! {
        <li>
            <button data-construction=row.id title=row.doc aria-pressed=move || held.get().to_string()
                on:click=move |_| lab.begin_construction(&id.get_value())>
                {row.label}" "<span class="quiet">{row.operands}</span>
            </button>
        </li>
    }
}
