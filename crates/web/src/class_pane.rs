//! What stands over the picture while it shows a class's prototype: which class it is, the document beside it, and the
//! way back.

use crate::actions;
use crate::lab::Lab;
use crate::picture::thumbnail::Thumbnail;
use crate::{icons, words};
use leptos::prelude::*;

/// The class that is edited, and the document whose things follow.
#[component]
pub fn ClassPane(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let leave = move |_| actions::run(actions::named("leave-class"), lab);
    let rests = RwSignal::new(false);
    move || {
        lab.prototype.get().map(|shown| {
            let (class, home) = (shown.class.clone(), shown.home);
            let title = Memo::new(move |_| {
                lab.document.with(|d| d.as_ref().map(|d| d.title.clone()).unwrap_or_default())
            });
            view! {
                <section class="class-pane" aria-label=words::class_shown(&class)>
                    <p><b>{class.clone()}</b>" "<span class="quiet">{words::EVERY_ONE_FOLLOWS}</span></p>
                    <button class="primary" on:click=leave>{words::BACK_TO_DOCUMENT}</button>
                </section>
                <button class="class-inset" title=words::LEAVE_CLASS aria-label=move || words::leave_class(&title.get())
                    on:click=leave>
                    {move || {
                        // a picture of it as it is after each change
                        lab.text.track();
                        view! { <Thumbnail lab=lab id=home lively=rests /> }
                    }}
                    <span>{icons::chevron()}{title}</span>
                </button>
            }
        })
    }
}
