//! Sentences in which names stand between grave accents, as comments and messages write them.

use leptos::prelude::*;

/// A sentence, its names set as code.
pub fn marked(text: &str) -> impl IntoView + use<> {
    let part = |(n, part): (usize, &str)| match n % 2 {
        1 => view! { <code>{String::from(part)}</code> }.into_any(),
        _ => String::from(part).into_any(),
    };
    text.split('`').enumerate().map(part).collect_view()
}
