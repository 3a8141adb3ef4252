//! The dialog that asks for one line: a document's name, a thing's new name.

use crate::apart::apart;
use crate::lab::{Lab, Notice};
use crate::{keyboard, words};
use leptos::ev::{self, FocusEvent, KeyboardEvent, SubmitEvent};
use leptos::html::Input;
use leptos::prelude::*;
use presentation::numbers::{exactly, to_read};
use session::view::{Deed, Offer};
use session::{Command, Session};
use std::time::Duration;
use wasm_bindgen::JsCast;
use web_sys::{Element, EventTarget};

/// What a person is asked to type.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Wish {
    /// The name that the document is saved under.
    SaveAs,
    /// The value of a dimension.
    Dimension(Offer),
    /// An equation, as it is begun.
    Equation(String),
    /// A number of the document, with its name.
    Number,
    /// Another name for what a path leads to.
    Rename(String),
    /// The name of a class that inherits from that of the thing at a path.
    Kind(String),
}

/// The dialog, while something is asked.
#[component]
pub fn Dialog(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    move || lab.wish.get().map(|wish| apart(|| view! { <Open lab=lab wish=wish /> }))
}

#[component]
fn Open(lab: Lab, wish: Wish) -> impl IntoView {
    let input = NodeRef::<Input>::new();
    let is_size = matches!(wish, Wish::Dimension(_));
    let error = if is_size { lab.annotated.refused } else { RwSignal::new(None::<String>) };
    if is_size {
        error.set(None);
        lab.annotated.typed.set_value(None);
        end_where_document_changes(lab, wish.clone());
    }
    let end = move || if is_size { lab.end_size() } else { lab.wish.set(None) };
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
        Wish::Dimension(offer) => {
            (words::value_of(&offer.label), to_read(offer.value.as_deref().unwrap_or_default()))
        }
        Wish::Equation(begun) => (String::from(words::ASK_EQUATION), begun.clone()),
        Wish::Kind(path) => (words::name_of_kind(path), String::new()),
        Wish::Number => (String::from(words::ASK_NUMBER), String::new()),
    };
    let is_whole = !matches!(wish, Wish::Equation(_));
    Effect::new(move |_| {
        if let Some(input) = input.get() {
            request_animation_frame(move || {
                // It stands in the page, so it takes the focus.
                let _ = input.focus();
                if is_whole {
                    input.select();
                }
            });
        }
    });
    // whoever had the keyboard has it again
    let before = StoredValue::new_local(keyboard::holder());
    on_cleanup(move || {
        keyboard::give_back(before.try_get_value().flatten());
    });
    // a size is asked for where the thing is
    let clicked = lab.annotated.clicked.try_update_value(Option::take).flatten();
    let near = clicked.or_else(|| lab.seen_at()).filter(|_| is_size);
    // what only follows is told to do so
    let follows = matches!(&wish, Wish::Dimension(Offer { deed: Deed::Rule(_), .. }));
    let wish = StoredValue::new(wish);
    // by keys a size is asked for between two things, as by a click on another
    let other: StoredValue<Option<String>> = StoredValue::new(None);
    // by keys alone nothing else says so
    let is_keyed = is_size && clicked.is_none() && lab.size_beside(None, true).is_some();
    let said = [(follows, words::ONLY_FOLLOWS), (is_keyed, words::SIZE_BESIDE)];
    let said = said.into_iter().find_map(|(is_so, says)| is_so.then(|| String::from(says)));
    let foreseen = RwSignal::new(said);
    let typing = StoredValue::new(0_u32);
    let look = move || {
        let Some(typed) = input.get_untracked().map(|input| input.value()) else { return };
        let command = match wish.get_value() {
            Wish::Dimension(offer) => {
                let value = exactly(&typed, offer.value.as_deref().unwrap_or_default());
                let said = |session: &Session, id| session.said(id, &offer, Some(&value));
                match lab.ask_of_shown(said) {
                    Some(Ok(command)) => command,
                    Some(Err(refusal)) => {
                        return foreseen.set(Some(refusal.in_a_line()));
                    }
                    None => return,
                }
            }
            Wish::Equation(_) => equation(&typed),
            Wish::SaveAs | Wish::Rename(_) | Wish::Kind(_) | Wish::Number => return,
        };
        lab.foresee_then(&command, move |found| {
            // the dialog may be gone meanwhile
            let said = found.map_or_else(|why| why, |found| words::would_move(&found.moved));
            foreseen.try_set(Some(said));
        });
    };
    let change = move |_| {
        error.set(None);
        // an empty field is no answer
        let typed = input.get_untracked().map(|input| input.value());
        let typed = typed.filter(|typed| is_size && !typed.trim().is_empty());
        lab.annotated.typed.set_value(typed);
        typing.update_value(|n| *n += 1);
        let mine = typing.get_value();
        let later = move || {
            if typing.try_get_value() == Some(mine) {
                look();
            }
        };
        set_timeout(later, Duration::from_millis(200));
    };
    on_cleanup(move || {
        lab.foresee_command(None);
        if other.try_get_value().flatten().is_some() {
            lab.hover(None);
        }
    });
    let accept = move |e: SubmitEvent| {
        e.prevent_default();
        if let Some(other) = other.get_value()
            && lab.annotated.typed.with_value(Option::is_none)
        {
            return lab.size_picked((Some(other), None), false);
        }
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
            Wish::Dimension(offer) => {
                let value = exactly(&typed, offer.value.as_deref().unwrap_or_default());
                match lab.set_dimension(&offer, &value) {
                    Ok(_) => lab.end_size(),
                    Err(sentence) => error.set(Some(sentence)),
                }
            }
            Wish::Equation(_) => match lab.say_equation(&typed) {
                Ok(()) => lab.wish.set(None),
                Err(sentence) => error.set(Some(sentence)),
            },
            Wish::Number => match lab.add_number(&typed) {
                Ok(()) => lab.wish.set(None),
                Err(sentence) => error.set(Some(sentence)),
            },
            Wish::Kind(path) => match lab.make_kind(&path, typed.trim()) {
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
        match e.key().as_str() {
            "Escape" => end(),
            arrow @ ("ArrowDown" | "ArrowUp") if is_size => {
                let from = other.get_value();
                let next = lab.size_beside(from.as_deref(), arrow == "ArrowDown");
                if let Some(next) = next {
                    e.prevent_default();
                    foreseen.set(Some(words::size_to(&next)));
                    lab.hover(Some(next.clone()));
                    other.set_value(Some(next));
                }
            }
            _ => {}
        }
    };
    // a size is in nobody's way: whoever goes elsewhere has given it
    let leave = move |e: FocusEvent| {
        if is_size && is_outside(e.related_target(), "[role=dialog]") {
            lab.settle_size();
        }
    };
    let pressed = window_event_listener(ev::pointerdown, move |e| {
        // the picture knows what is meant by a press there
        if is_size && is_outside(e.target(), "[role=dialog], #picture") {
            lab.settle_size();
        }
    });
    on_cleanup(move || pressed.remove());
    let name = label.clone();
    let only_read = wish.with_value(|wish| match wish {
        Wish::Dimension(offer) => {
            lab.ask_of_shown(|session, id| session.only_read(id, offer)).flatten()
        }
        _ => None,
    });
    let only_read = StoredValue::new(only_read);
    view! {
        <div class="shade" class:near=near.is_some() class:through=is_size on:pointerdown=move |_| end()>
            <div role="dialog" aria-modal=(!is_size).then_some("true") aria-label=name
                on:pointerdown=|e| e.stop_propagation() on:focusout=leave
                style:--x=near.map(|(x, _)| format!("{x}px")) style:--y=near.map(|(_, y)| format!("{y}px"))>
            <form class="asking" on:submit=accept on:keydown=key>
                <label for="asked">{label}</label>
                <input id="asked" node_ref=input type="text" prop:value=value spellcheck="false"
                    autocomplete="off" on:input=change aria-invalid=move || error.with(Option::is_some).to_string() />
                {move || error.get().map(|error| view! { <p class="error" role="alert">{error}</p> })}
                {move || foreseen.get().filter(|_| error.with(Option::is_none)).map(|says| view! { <p class="quiet" aria-live="polite">{says}</p> })}
                <p class="choices">
                    <button class="primary" type="submit">{words::DONE}</button>
                    {only_read.get_value().map(|command| view! {
                        <button type="button" title=words::ONLY_READ_HELP on:click=move |_| {
                            end();
                            lab.apply(&command);
                        }>{words::ONLY_READ}</button>
                    })}
                    <button type="button" on:click=move |_| end()>{words::CANCEL}</button>
                </p>
            </form>
            </div>
        </div>
    }
}

/// Whether something of the page is in nothing that a selector finds.
fn is_outside(target: Option<EventTarget>, selector: &str) -> bool {
    let element = target.and_then(|target| target.dyn_into::<Element>().ok());
    element.is_some_and(|element| element.closest(selector).ok().flatten().is_none())
}

/// Asks for a size no longer once the document is another, or says another text: what was asked may not be there. What
/// has been typed of it stays meanwhile, and is judged when it is taken.
fn end_where_document_changes(lab: Lab, asked: Wish) {
    let (document, before) =
        (lab.current.get_untracked(), lab.text.with_untracked(|text| text.source.clone()));
    Effect::new(move |_| {
        let is_another = lab.current.with(|current| *current != document);
        let is_changed = lab.text.with(|text| text.source != before);
        let is_open = lab.annotated.typed.with_value(Option::is_none);
        // what was clicked next may be asked for already
        let is_asked = || lab.wish.with_untracked(|wish| wish.as_ref() == Some(&asked));
        if (is_another || is_changed && is_open) && is_asked() {
            lab.end_size();
        }
    });
}

impl Lab {
    /// Asks for an equation over what is selected.
    pub fn begin_equation(self) {
        self.flush_text();
        let paths: Vec<_> =
            self.selection_untracked().iter().filter_map(|p| session::parse_path(p)).collect();
        let begun = self.ask_of_shown(|session, id| session.equation_begun(id, &paths));
        self.wish.set(Some(Wish::Equation(begun.unwrap_or_default())));
    }

    /// Gives the document a number as it was typed, and selects it.
    ///
    /// # Errors
    /// Why not, in one sentence.
    fn add_number(self, typed: &str) -> Result<(), String> {
        match self.ask_of_shown(|session, id| session.number_typed(id, typed)) {
            Some(Ok((command, name))) => {
                if !self.apply(&command) {
                    return refused(self);
                }
                self.select(Some(name));
                Ok(())
            }
            Some(Err(refusal)) => Err(refusal.in_a_line()),
            None => Ok(()),
        }
    }

    /// Says an equation as it was typed.
    ///
    /// # Errors
    /// Why not, in one sentence.
    fn say_equation(self, typed: &str) -> Result<(), String> {
        if self.apply(&equation(typed)) {
            return Ok(());
        }
        refused(self)
    }

    /// Says a dimension with the value that was typed; answers whether it holds now, or something is asked first.
    ///
    /// # Errors
    /// Why not, in one sentence.
    pub fn set_dimension(self, offer: &Offer, typed: &str) -> Result<bool, String> {
        match self.say_offer(offer, Some(typed)) {
            Ok(true) => Ok(true),
            Ok(false) => refused(self).map(|()| false),
            Err(refusal) => Err(refusal.in_a_line()),
        }
    }
}

/// The command that says an equation of the document.
fn equation(typed: &str) -> Command {
    let members = format!("constraint {}", typed.trim());
    Command::Edit { target: session::Path::default(), members }
}

/// Takes what was refused out of the notices, to be said in the dialog.
fn refused(lab: Lab) -> Result<(), String> {
    match lab.notice.get_untracked() {
        Some(Notice::Refused(refusal)) => {
            lab.notice.set(None);
            Err(refusal.in_a_line())
        }
        _ => Ok(()),
    }
}

/// Gives a thing another name.
fn rename(lab: Lab, path: &str, to: &str) -> Result<(), String> {
    let Some(from) = session::parse_path(path) else { return Ok(()) };
    let is_class = lab.id().is_some_and(|id| lab.ask(|session| session.has_class(id, path)));
    if lab.apply(&Command::Rename { from, to: String::from(to) }) {
        if is_class {
            return Ok(());
        }
        let renamed =
            path.rsplit_once('.').map_or(String::from(to), |(owner, _)| format!("{owner}.{to}"));
        lab.select(Some(renamed));
        return Ok(());
    }
    refused(lab)
}
