//! The history: every step that can be taken back or done again; a click goes there.

use crate::lab::Lab;
use crate::words;
use leptos::prelude::*;
use session::Command;

/// The steps of the open document, the latest first, and where it stands among them.
#[component]
pub fn History(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let steps = Memo::new(move |_| {
        lab.status.track();
        lab.id().map(|id| lab.ask(|session| session.history(id))).unwrap_or_default()
    });
    let undone = move || {
        let all = steps.with(|(_, undone)| undone.clone()).into_iter().enumerate().rev();
        all.map(|(n, label)| step(lab, label, n + 1, &Command::Redo, true)).collect_view()
    };
    let done = move || {
        let all = steps.with(|(done, _)| done.clone()).into_iter().enumerate();
        all.map(|(n, label)| step(lab, label, n, &Command::Undo, false)).collect_view()
    };
    view! {
        <section class="panel history" aria-label=words::HISTORY>
            <ol class="scroll">
                {undone}
                {done}
                {move || {
                    let all = steps.with(|(done, _)| done.len());
                    step(lab, String::from(words::AS_OPENED), all, &Command::Undo, false)
                }}
            </ol>
        </section>
    }
}

/// A step: pressed, the document is as it was after it, so many undos or redos away.
fn step(lab: Lab, label: String, times: usize, command: &Command, undone: bool) -> impl IntoView {
    let command = command.clone();
    let is_now = times == 0;
    view! {
        <li>
            <button class:undone=undone aria-current=is_now.then_some("step")
                on:click=move |_| {
                    lab.stop_edits();
                    (0..times).for_each(|_| {
                        lab.apply(&command);
                    });
                }>{label}</button>
        </li>
    }
}
