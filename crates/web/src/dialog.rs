//! The dialog that asks for one line: a document's name, a thing's new name.

use crate::lab::{Lab, Notice};
use crate::words;
use leptos::ev::{KeyboardEvent, SubmitEvent};
use leptos::html::Input;
use leptos::prelude::*;
use session::Command;
use session::view::Offer;

/// What a person is asked to type.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Wish {
    /// The name that the document is saved under.
    SaveAs,
    /// The name of the class that the selection becomes the parts of.
    ClassOf,
    /// The value of a dimension.
    Dimension(Offer),
    /// Another name for what a path leads to.
    Rename(String),
}

/// The dialog, while something is asked.
#[component]
pub fn Dialog(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    move || lab.wish.get().map(|wish| view! { <Open lab=lab wish=wish /> })
}

#[component]
fn Open(lab: Lab, wish: Wish) -> impl IntoView {
    let input = NodeRef::<Input>::new();
    let error = RwSignal::new(None::<String>);
    let (label, value) = match &wish {
        Wish::SaveAs => {
            let path = lab.current.get_untracked().unwrap_or_default();
            let name = path.strip_suffix(".thing").unwrap_or(&path);
            (String::from(words::NAME_OF_DOCUMENT), String::from(name))
        }
        Wish::Rename(path) => {
            let name = path.rsplit('.').next().unwrap_or_default();
            (words::new_name_of(path), String::from(name))
        }
        Wish::ClassOf => (String::from(words::NAME_OF_CLASS), String::new()),
        Wish::Dimension(offer) => {
            (words::value_of(&offer.label), offer.value.clone().unwrap_or_default())
        }
    };
    Effect::new(move |_| {
        if let Some(input) = input.get() {
            request_animation_frame(move || {
                // It stands in the page, so it takes the focus.
                let _ = input.focus();
                input.select();
            });
        }
    });
    let wish = StoredValue::new(wish);
    let accept = move |e: SubmitEvent| {
        e.prevent_default();
        let Some(typed) = input.get_untracked().map(|input| input.value()) else { return };
        match wish.get_value() {
            Wish::SaveAs => leptos::task::spawn_local(async move {
                match lab.save_as(&typed).await {
                    Ok(()) => lab.wish.set(None),
                    Err(sentence) => {
                        // The dialog may be gone meanwhile.
                        let _ = error.try_set(Some(sentence));
                    }
                }
            }),
            Wish::ClassOf => match lab.class_of_selection(typed.trim()) {
                Ok(()) => lab.wish.set(None),
                Err(sentence) => error.set(Some(sentence)),
            },
            Wish::Dimension(offer) => match lab.set_dimension(&offer, typed.trim()) {
                Ok(()) => lab.wish.set(None),
                Err(sentence) => error.set(Some(sentence)),
            },
            Wish::Rename(path) => match rename(lab, &path, typed.trim()) {
                Ok(()) => lab.wish.set(None),
                Err(sentence) => error.set(Some(sentence)),
            },
        }
    };
    let key = move |e: KeyboardEvent| {
        e.stop_propagation();
        if e.key() == "Escape" {
            lab.wish.set(None);
        }
    };
    let name = label.clone();
    view! {
        <div class="shade" on:pointerdown=move |_| lab.wish.set(None)>
            <form class="asking" role="dialog" aria-modal="true" aria-label=name
                on:pointerdown=|e| e.stop_propagation() on:submit=accept on:keydown=key>
                <label for="asked">{label}</label>
                <input id="asked" node_ref=input type="text" prop:value=value spellcheck="false"
                    autocomplete="off" aria-invalid=move || error.with(Option::is_some).to_string() />
                {move || error.get().map(|error| view! { <p class="error" role="alert">{error}</p> })}
                <p class="choices">
                    <button class="primary" type="submit">{words::DONE}</button>
                    <button type="button" on:click=move |_| lab.wish.set(None)>{words::CANCEL}</button>
                </p>
            </form>
        </div>
    }
}

impl Lab {
    /// Makes a class of what is selected.
    ///
    /// # Errors
    /// Why not, in one sentence.
    pub fn class_of_selection(self, class: &str) -> Result<(), String> {
        self.flush_text();
        let Some(id) = self.id() else { return Ok(()) };
        let paths: Vec<_> =
            self.selection_untracked().iter().filter_map(|p| session::parse_path(p)).collect();
        let made = self.ask(|session| session.class_of(id, &paths, class));
        let (command, name) = made.map_err(|refusal| crate::field::reason(&refusal))?;
        if self.apply_as_meant(&command) {
            self.select(Some(name));
            return Ok(());
        }
        refused(self)
    }

    /// Says a dimension with the value that was typed.
    ///
    /// # Errors
    /// Why not, in one sentence.
    pub fn set_dimension(self, offer: &Offer, typed: &str) -> Result<(), String> {
        if self.apply(&offer.command(Some(typed))) {
            return Ok(());
        }
        refused(self)
    }
}

/// Takes what was refused out of the notices, to be said in the dialog.
fn refused(lab: Lab) -> Result<(), String> {
    match lab.notice.get_untracked() {
        Some(Notice::Refused(refusal)) => {
            lab.notice.set(None);
            Err(crate::field::reason(&refusal))
        }
        _ => Ok(()),
    }
}

/// Gives a thing another name.
fn rename(lab: Lab, path: &str, to: &str) -> Result<(), String> {
    let Some(from) = session::parse_path(path) else { return Ok(()) };
    if lab.apply(&Command::Rename { from, to: String::from(to) }) {
        let renamed =
            path.rsplit_once('.').map_or(String::from(to), |(owner, _)| format!("{owner}.{to}"));
        lab.select(Some(renamed));
        return Ok(());
    }
    refused(lab)
}
