//! The rows of a family as a sheet of pictures; those that are not drawn say why.

use super::{Family, MOST_ROWS};
use crate::words;
use leptos::prelude::*;

/// The sheet.
#[component]
pub fn Pictures(
    /// What is shown.
    family: Family,
) -> impl IntoView {
    let Family { grid, outcomes, thing, .. } = family;
    let more = move || grid.with(|grid| grid.rows.len().saturating_sub(MOST_ROWS));
    let cards = move || {
        let rows = grid.with(|grid| grid.rows.iter().take(MOST_ROWS).cloned().collect::<Vec<_>>());
        let card = |(row, outcome): (session::view::FamilyRow, session::view::RowOutcome)| {
            let name = row.name.clone();
            let mark = name.clone();
            let picture = (!outcome.svg.is_empty()).then(|| {
                let source = String::from(js_sys::encode_uri_component(&outcome.svg));
                view! { <img alt=name.clone() src=format!("data:image/svg+xml,{source}") /> }
            });
            let why = (outcome.outcome != "drawn").then(|| {
                view! { <span class="error">{outcome.outcome.clone()}": "{outcome.message.clone()}</span> }
            });
            let is_bad = outcome.outcome != "drawn";
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
        rows.into_iter().zip(outcomes.get()).map(card).collect_view()
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
