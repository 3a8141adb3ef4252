//! The gallery: every document as a card with its picture, its title and its first sentence.

use crate::first::Invitation;
use crate::lab::Lab;
use crate::picture::thumbnail::Thumbnail;
use crate::{lesson, route, words};
use leptos::prelude::*;
use presentation::palette::Listed;
use presentation::sentences::first_sentence;
use session::view::DocumentId;

/// A document that has been read for its card.
#[derive(Clone, PartialEq, Debug)]
struct Card {
    id: DocumentId,
    title: String,
    sentence: String,
    dirty: bool,
}

/// All documents that the server offers.
#[component]
pub fn Gallery(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let listed = RwSignal::new(None::<Result<Vec<Listed>, String>>);
    leptos::task::spawn_local(async move {
        let answer = lab.fetch_list().await;
        listed.try_set(Some(answer));
    });
    view! {
        <main class="gallery">
            <header>
                <h1>{words::LAB}</h1>
                <p class="lead">{words::GALLERY_LEAD}</p>
            </header>
            <Invitation lab=lab />
            {move || match listed.get() {
                None => view! { <p class="quiet" role="status">{words::LOADING}</p> }.into_any(),
                Some(Err(message)) => view! { <p class="notice" role="alert">{message}</p> }.into_any(),
                Some(Ok(all)) if all.is_empty() => view! { <p class="quiet">{words::NO_DOCUMENTS}</p> }.into_any(),
                Some(Ok(all)) => {
                    let (gallery, own): (Vec<_>, Vec<_>) = all.into_iter().partition(|one| one.in_gallery);
                    let (lessons, gallery): (Vec<_>, Vec<_>) =
                        gallery.into_iter().partition(|one| lesson::is_lesson(&one.path));
                    let (below, own): (Vec<_>, Vec<_>) =
                        own.into_iter().partition(|one| one.path.contains('/'));
                    view! {
                        <Shelf lab=lab heading=words::YOUR_DOCUMENTS documents=own />
                        <Shelf lab=lab heading=words::LESSONS documents=lessons />
                        <Shelf lab=lab heading=words::GALLERY documents=gallery />
                        <Shelf lab=lab heading=words::DOCUMENTS_BELOW documents=below />
                    }.into_any()
                }
            }}
        </main>
    }
}

#[component]
fn Shelf(lab: Lab, heading: &'static str, documents: Vec<Listed>) -> impl IntoView {
    (!documents.is_empty()).then(|| {
        let cards =
            documents.into_iter().map(|listed| view! { <CardView lab=lab listed=listed /> });
        view! {
            <section aria-label=heading>
                <h2>{heading}</h2>
                <ul class="cards">{cards.collect_view()}</ul>
            </section>
        }
    })
}

#[component]
fn CardView(lab: Lab, listed: Listed) -> impl IntoView {
    let card = RwSignal::new(None::<Card>);
    let lively = RwSignal::new(false);
    let (path, title) = (listed.path.clone(), listed.title.clone());
    let is_seen = move || card.try_get_untracked().is_some();
    leptos::task::spawn_local(async move {
        if let Some(opened) = lab.load_for_card(&path, is_seen).await {
            let doc = lab.ask(|session| session.preamble(opened.id));
            card.try_set(Some(Card {
                id: opened.id,
                sentence: first_sentence(&doc, &opened.title),
                title: opened.title,
                dirty: opened.dirty,
            }));
        }
    });
    on_cleanup(move || lively.set(false));
    view! {
        <li>
            <a class="card" href=route::to(&listed.path)
                on:pointerenter=move |_| lively.set(true)
                on:pointerleave=move |_| lively.set(false)
                on:focus=move |_| lively.set(true)
                on:blur=move |_| lively.set(false)>
                <div class="frame">
                    {move || card.with(|card| card.as_ref().map(|card| card.id))
                        .map(|id| view! { <Thumbnail lab=lab id=id lively=lively /> })}
                </div>
                <h3>{move || card.with(|card| card.as_ref().map_or_else(|| title.clone(), |c| c.title.clone()))}
                    {move || card.with(|card| card.as_ref().is_some_and(|c| c.dirty))
                        .then(|| view! { <span class="dirty" title=words::NOT_SAVED>"•"</span> })}</h3>
                <p>{move || card.with(|card| card.as_ref().map(|card| card.sentence.clone()))}</p>
                <p class="path">{listed.path.clone()}</p>
            </a>
        </li>
    }
}
