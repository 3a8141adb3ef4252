//! Sentences in which names stand between grave accents, as comments and messages write them.

use leptos::prelude::*;
use presentation::sentences::parts;

/// A sentence, its names set as code.
pub fn marked(text: &str) -> impl IntoView + use<> {
    let part = |(is_name, part): (bool, String)| match is_name {
        true => view! { <code>{part}</code> }.into_any(),
        false => part.into_any(),
    };
    parts(text).into_iter().map(part).collect_view()
}
