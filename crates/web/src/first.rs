//! The first minute: it opens by itself on a first visit that names no document, is offered in the gallery until it
//! was taken or skipped, and does not come again. What it is, its document says: the first lesson of the gallery.

use crate::lab::Lab;
use crate::{route, theme, words};
use leptos::prelude::*;

const KEY: &str = "thinglab/first-minute";
const LESSON: &str = "gallery/lesson-1-first-minute.thing";

/// Whether the first minute is offered in this browser.
pub fn is_offered() -> bool {
    theme::keep(KEY).is_none()
}

impl Lab {
    /// Opens the first minute by itself, where somebody is here for the first time and asked for no document.
    pub fn welcome(self) {
        let asks_for_nothing = route::present().is_none() && route::shared().is_none();
        if asks_for_nothing && self.first.get_untracked() {
            self.end_invitation();
            route::go(&route::to(LESSON));
        }
    }

    /// Offers the first minute no more.
    pub fn end_invitation(self) {
        self.first.set(false);
        theme::put(KEY, Some("over"));
    }
}

/// What the gallery says to someone who is here for the first time.
#[component]
pub fn Invitation(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let begin = move |_| {
        lab.end_invitation();
        route::go(&route::to(LESSON));
    };
    view! {
        <Show when=move || lab.first.get()>
            <div class="notice first" role="note">
                <p class="words lead">{words::FIRST_LEAD}</p>
                <button class="primary" on:click=begin>{words::FIRST_BEGIN}</button>
                <button class="bare" on:click=move |_| lab.end_invitation()>{words::FIRST_SKIP}</button>
            </div>
        </Show>
    }
}
