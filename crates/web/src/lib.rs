//! The page: a Leptos shell that shows the session's views and hands Commands back.
//!
//! There is no domain logic here. Scripts that the browser gives better than Rust (the text
//! editor, requests with the token) stand in `assets/` and are reached through [`js`].

pub mod js;

use js_sys::{Array, Object};
use leptos::html::Div;
use leptos::prelude::*;

/// The whole page: the documents that the server offers, and a text editor.
#[component]
fn Page() -> impl IntoView {
    let documents = RwSignal::new(String::from("loading"));
    let place = NodeRef::<Div>::new();
    leptos::task::spawn_local(async move {
        let answer: Array = js::request("GET", "/api/documents", None).await;
        documents.set(answer.get(1).as_string().unwrap_or_default());
    });
    Effect::new(move |_| {
        if let Some(parent) = place.get() {
            let options = Object::new();
            js::set_option(&options, "text", &"base: HorizontalLine\n".into());
            js::create_editor(&parent, &options);
        }
    });
    view! {
        <main>
            <h1>"ThingLab"</h1>
            <p role="status">{move || documents.get()}</p>
            <div node_ref=place></div>
        </main>
    }
}

/// Puts the page into the document's body; called once, when the bundle has loaded.
pub fn start() {
    console_error_panic_hook::set_once();
    leptos::mount::mount_to_body(Page);
}
