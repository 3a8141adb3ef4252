//! The gallery: every document as a card with its picture, its title and its first sentence.

use crate::first::Invitation;
use crate::lab::Lab;
use crate::marked::marked;
use crate::picture::thumbnail::Thumbnail;
use crate::{actions, lesson, route, words};
use leptos::prelude::*;
use presentation::find::has_words;
use presentation::palette::Listed;
use presentation::sentences::first_sentence;
use session::view::DocumentId;

/// What was read of a document for its card.
#[derive(Clone, PartialEq, Debug)]
struct Read {
    id: DocumentId,
    title: String,
    sentence: String,
    dirty: bool,
    is_blank: bool,
}

impl Read {
    fn of(lab: Lab, id: DocumentId, title: String, dirty: bool) -> Self {
        let doc = lab.ask(|session| session.preamble(id));
        let is_blank = lab.ask(|session| {
            let drawn = [session.picture(id).drawing, session.to_trace(id)];
            drawn.iter().all(|drawing| drawing.elements.is_empty())
        });
        Self { id, sentence: first_sentence(&doc, &title), title, dirty, is_blank }
    }
}

/// A document that is offered. What is read of it serves each shelf on which it stands.
#[derive(Clone, PartialEq, Debug)]
struct Card {
    listed: Listed,
    read: RwSignal<Option<Read>>,
    /// Whether no file has it: what is known of it is a draft.
    is_kept: bool,
}

impl Card {
    /// Begins to read a document for as long as its gallery is there.
    fn begun(lab: Lab, listed: Listed) -> Self {
        let read = RwSignal::new(None::<Read>);
        let path = listed.path.clone();
        let is_seen = move || read.try_get_untracked().is_some();
        leptos::task::spawn_local(async move {
            if let Some(opened) = lab.load_for_card(&path, is_seen).await {
                read.try_set(Some(Read::of(lab, opened.id, opened.title, opened.dirty)));
            }
        });
        Self { listed, read, is_kept: false }
    }

    /// A document that is not saved yet: what is kept of it is read.
    fn kept(lab: Lab, path: &str) -> Self {
        let read = RwSignal::new(None::<Read>);
        let name = String::from(path);
        let is_seen = move || read.try_get_untracked().is_some();
        leptos::task::spawn_local(async move {
            if let Some(id) = lab.load_kept_for_card(&name, is_seen).await {
                read.try_set(Some(Read::of(lab, id, name, false)));
            }
        });
        let listed = Listed { path: path.into(), title: path.into(), in_gallery: false };
        Self { listed, read, is_kept: true }
    }

    /// Whether it has the wanted words in its title, its first sentence or its path.
    fn has(&self, wanted: &str) -> bool {
        let read = self.read.get();
        let (title, sentence) = read.map(|read| (read.title, read.sentence)).unwrap_or_default();
        has_words(
            &[&self.listed.path, &self.listed.title, &title, &sentence].map(|s| &**s).join(" "),
            wanted,
        )
    }
}

/// All documents that the server offers, and what begins one.
#[component]
pub fn Gallery(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let listed = RwSignal::new(None::<Result<Vec<Listed>, String>>);
    let wanted = RwSignal::new(String::new());
    leptos::task::spawn_local(async move {
        let answer = lab.fetch_list().await;
        listed.try_set(Some(answer));
    });
    view! {
        <main class="gallery">
            <header>
                <h1>{words::LAB}</h1>
                <p class="lead">{words::GALLERY_LEAD}</p>
                <div class="begin">
                    <button class="primary" on:click=move |_| actions::run(actions::named("new"), lab)>{words::NEW}</button>
                    <button on:click=move |_| actions::run(actions::named("open"), lab)>{words::OPEN_FILE}</button>
                    <input type="search" placeholder=words::FIND_DOCUMENT aria-label=words::FIND_DOCUMENT
                        on:input=move |e| wanted.set(event_target_value(&e)) />
                </div>
            </header>
            <Invitation lab=lab />
            {move || match listed.get() {
                None => view! { <p class="quiet" role="status">{words::LOADING}</p> }.into_any(),
                Some(Err(message)) => view! { <p class="notice" role="alert">{marked(&message)}</p> }.into_any(),
                Some(Ok(all)) if all.is_empty() => view! { <p class="quiet">{words::NO_DOCUMENTS}</p> }.into_any(),
                Some(Ok(all)) => view! { <Shelves lab=lab listed=all wanted=wanted /> }.into_any(),
            }}
        </main>
    }
}

/// The shelves: what was shown last, what lies in the folder, lessons, the gallery.
#[component]
fn Shelves(lab: Lab, listed: Vec<Listed>, wanted: RwSignal<String>) -> impl IntoView {
    let recent = lab.recent(&listed);
    let unsaved = recent.iter().filter(|path| !listed.iter().any(|one| one.path == **path));
    let others: Vec<Card> = unsaved.map(|path| Card::kept(lab, path)).collect();
    let all: Vec<Card> = listed.into_iter().map(|one| Card::begun(lab, one)).collect();
    let at = |path: &String| others.iter().chain(&all).find(|card| card.listed.path == *path);
    let recent: Vec<Card> = recent.iter().filter_map(at).cloned().collect();
    let searched: Vec<Card> = others.into_iter().chain(all.clone()).collect();
    let (gallery, own): (Vec<_>, Vec<_>) = all.into_iter().partition(|one| one.listed.in_gallery);
    let (lessons, gallery): (Vec<_>, Vec<_>) =
        gallery.into_iter().partition(|one| lesson::is_lesson(&one.listed.path));
    let (below, own): (Vec<_>, Vec<_>) =
        own.into_iter().partition(|one| one.listed.path.contains('/'));
    let is_searched = Memo::new(move |_| !wanted.with(|wanted| wanted.trim().is_empty()));
    let found = Memo::new(move |_| {
        let wanted = wanted.get();
        searched.iter().filter(|card| card.has(&wanted)).cloned().collect::<Vec<_>>()
    });
    view! {
        <div hidden=move || is_searched.get()>
            <Shelf lab=lab heading=words::RECENT cards=recent />
            <Shelf lab=lab heading=words::YOUR_DOCUMENTS cards=own />
            <Shelf lab=lab heading=words::LESSONS cards=lessons />
            <Shelf lab=lab heading=words::GALLERY cards=gallery />
            <Shelf lab=lab heading=words::DOCUMENTS_BELOW cards=below />
        </div>
        <Show when=move || is_searched.get()>
            <p class="quiet" role="status">{move || found.with(Vec::is_empty).then_some(words::NONE_FOUND)}</p>
            <ul class="cards">
                <For each=move || found.get() key=|card| card.listed.path.clone() let:card>
                    <CardView lab=lab card=card />
                </For>
            </ul>
        </Show>
    }
}

#[component]
fn Shelf(lab: Lab, heading: &'static str, cards: Vec<Card>) -> impl IntoView {
    (!cards.is_empty()).then(|| {
        let cards = cards.into_iter().map(|card| view! { <CardView lab=lab card=card /> });
        view! {
            <section aria-label=heading>
                <h2>{heading}</h2>
                <ul class="cards">{cards.collect_view()}</ul>
            </section>
        }
    })
}

#[component]
fn CardView(lab: Lab, card: Card) -> impl IntoView {
    let lively = RwSignal::new(false);
    let Card { listed, read, is_kept } = card;
    let title = listed.title.clone();
    on_cleanup(move || lively.set(false));
    view! {
        <li>
            <a class="card" href=route::to(&listed.path)
                on:pointerenter=move |_| lively.set(true)
                on:pointerleave=move |_| lively.set(false)
                on:focus=move |_| lively.set(true)
                on:blur=move |_| lively.set(false)>
                <div class="frame">
                    {move || (is_kept && read.with(Option::is_none))
                        .then(|| view! { <span class="quiet">{words::KEPT_HERE}</span> })}
                    {move || read.with(|read| read.as_ref().map(|read| (read.id, read.is_blank)))
                        .map(|(id, is_blank)| if is_blank {
                            view! { <span class="quiet">{words::BLANK_CARD}</span> }.into_any()
                        } else {
                            view! { <Thumbnail lab=lab id=id lively=lively /> }.into_any()
                        })}
                </div>
                <h3>{move || read.with(|read| read.as_ref().map_or_else(|| title.clone(), |r| r.title.clone()))}
                    {move || read.with(|read| read.as_ref().is_some_and(|r| r.dirty))
                        .then(|| view! { <span class="dirty" title=words::NOT_SAVED>"•"</span> })}</h3>
                <p>{move || read.with(|read| read.as_ref().map(|read| read.sentence.clone()))}</p>
                {move || (is_kept && read.with(Option::is_some))
                    .then(|| view! { <p class="quiet">{words::KEPT_HERE}</p> })}
                <p class="path">{listed.path.clone()}</p>
            </a>
        </li>
    }
}
