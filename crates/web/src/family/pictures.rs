//! The rows of a family as a sheet of pictures; those that are not drawn say why.

use super::{Family, MOST_ROWS};
use crate::words;
use leptos::prelude::*;
use session::view::FamilyRow;

/// The sheet.
#[component]
pub fn Pictures(
    /// What is shown.
    family: Family,
) -> impl IntoView {
    let Family { grid, outcomes, thing, .. } = family;
    let more = move || grid.with(|grid| grid.rows.len().saturating_sub(MOST_ROWS));
    let card = move |(at, row): (usize, FamilyRow)| {
        let (name, mark) = (row.name.clone(), row.name.clone());
        let outcome =
            Memo::new(move |_| outcomes.with(|all| all.get(at).cloned()).unwrap_or_default());
        let is_bad = move || outcome.with(|o| !o.outcome.is_empty() && o.outcome != "drawn");
        let alt = name.clone();
        let picture = move || {
            let svg = outcome.with(|outcome| outcome.svg.clone());
            (!svg.is_empty()).then(|| {
                let source = String::from(js_sys::encode_uri_component(&svg));
                view! { <img alt=alt.clone() src=format!("data:image/svg+xml,{source}") /> }
            })
        };
        let why = move || {
            // what is drawn may be doubtful
            (is_bad() || outcome.with(|o| !o.message.is_empty())).then(|| {
                let outcome = outcome.get();
                view! { <span class="error">{outcome.outcome}": "{outcome.message}</span> }
            })
        };
        let apply = move |_| family.apply_row(&row);
        view! {
            <li class="specimen" class:bad=is_bad data-picture=mark>
                <button class="bare" disabled=move || thing.with(Option::is_none)
                    title=move || thing.get().map(|thing| words::applied_to(&thing)) on:click=apply>
                    {picture}<b>{name}</b>{why}
                </button>
            </li>
        }
    };
    let cards = move || {
        let rows = grid.with(|grid| grid.rows.iter().take(MOST_ROWS).cloned().collect::<Vec<_>>());
        rows.into_iter().enumerate().map(card).collect_view()
    };
    let is_empty = move || grid.with(|grid| grid.rows.is_empty());
    view! {
        <div class="scroll">
            <ul class="specimens">{cards}</ul>
            {move || is_empty().then(|| view! { <p class="quiet">{words::NO_ROWS}</p> })}
            {move || (more() > 0).then(|| view! { <p class="quiet">{words::more_rows(more())}</p> })}
        </div>
    }
}
