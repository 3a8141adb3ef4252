//! What is printed: the picture in lines, under the document's title.

use crate::lab::Lab;
use leptos::ev;
use leptos::prelude::*;

/// What is printed of the document: it is made when the browser is about to print, and gone when it has.
#[component]
pub fn Printed(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let (title, sheet) = (NodeRef::<leptos::html::H1>::new(), NodeRef::<leptos::html::Div>::new());
    let put = move |(words, svg, is_fitted): (String, String, bool)| {
        if let (Some(title), Some(sheet)) = (title.get_untracked(), sheet.get_untracked()) {
            title.set_text_content(Some(&words));
            sheet.set_inner_html(&svg);
            sheet.set_class_name(if is_fitted { "fitted" } else { "" });
        }
    };
    let on = |name: &'static str, act: Box<dyn Fn()>| {
        window_event_listener(ev::Custom::<web_sys::Event>::new(name), move |_| act())
    };
    let before = on("beforeprint", Box::new(move || lab.printed().map(put).unwrap_or_default()));
    let after = on("afterprint", Box::new(move || put((String::new(), String::new(), false))));
    on_cleanup(move || {
        before.remove();
        after.remove();
    });
    view! {
        <section class="printed" aria-hidden="true">
            <h1 node_ref=title></h1>
            <div node_ref=sheet></div>
        </section>
    }
}
