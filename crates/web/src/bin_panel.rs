//! The bin: a tile for each class that things can be made of.

use crate::js::Painter;
use crate::lab::Lab;
use crate::paint::{Part, display_list};
use crate::picture::{new_painter, paint};
use crate::sheet::fit;
use crate::words;
use leptos::html::Canvas;
use leptos::prelude::*;
use session::view::{BinEntry, PictureView};

/// The classes in use, with a field that finds them, and the libraries that could be used besides.
#[component]
pub fn Bin(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let wanted = RwSignal::new(String::new());
    let entries = Memo::new(move |_| {
        lab.text.track();
        lab.id().map(|id| lab.ask(|session| session.bin(id))).unwrap_or_default()
    });
    let found = Memo::new(move |_| {
        let wanted = wanted.get().to_lowercase();
        let has = |entry: &BinEntry| {
            entry.class.to_lowercase().contains(&wanted)
                || entry.doc.to_lowercase().contains(&wanted)
        };
        entries.with(|all| all.iter().filter(|entry| has(entry)).cloned().collect::<Vec<_>>())
    });
    let shelves = Memo::new(move |_| {
        found.with(|found| {
            let mut shelves: Vec<(String, Vec<BinEntry>)> = Vec::new();
            for entry in found {
                let name = entry.toolbox.as_ref().unwrap_or(&entry.library);
                match shelves.iter_mut().find(|(shelf, _)| shelf == name) {
                    Some((_, shelf)) => shelf.push(entry.clone()),
                    None => shelves.push((name.clone(), vec![entry.clone()])),
                }
            }
            shelves
        })
    });
    let libraries = Memo::new(move |_| {
        let text = lab.text.with(|text| text.source.clone());
        let used = |name: &String| text.lines().any(|line| line.trim() == format!("use {name}"));
        lab.libraries().into_iter().filter(|name| !used(name)).collect::<Vec<_>>()
    });
    view! {
        <section class="panel bin" aria-label=words::BIN>
            <div class="head">
                <input type="search" placeholder=words::FILTER aria-label=words::FILTER_BIN
                    on:input=move |e| wanted.set(event_target_value(&e)) />
            </div>
            <div class="scroll">
                <For each=move || shelves.get() key=|shelf| (shelf.0.clone(), shelf.1.len()) let(shelf)>
                    <h3>{if shelf.0.is_empty() { String::from(words::OWN_CLASSES) } else { shelf.0.clone() }}</h3>
                    <ul class="tiles">
                        {shelf.1.into_iter().map(|entry| view! { <Tile lab=lab entry=entry /> }).collect_view()}
                    </ul>
                </For>
                <Show when=move || !libraries.with(Vec::is_empty)>
                    <h3>{words::MORE_LIBRARIES}</h3>
                    <p class="choices">
                        <For each=move || libraries.get() key=Clone::clone let(name)>
                            {
                                let (label, library) = (format!("use {name}"), name.clone());
                                view! {
                                    <button data-library=name.clone()
                                        on:click=move |_| lab.use_library(&library)>{label}</button>
                                }
                            }
                        </For>
                    </p>
                </Show>
            </div>
        </section>
    }
}

/// A tile: a click takes the tool that places such a thing, Enter inserts one where there is room.
#[component]
fn Tile(lab: Lab, entry: BinEntry) -> impl IntoView {
    let canvas = NodeRef::<Canvas>::new();
    let size = RwSignal::new((0.0, 0.0));
    let painter = StoredValue::new_local(None::<Painter>);
    let picture = PictureView { drawing: entry.picture.clone(), ..PictureView::default() };
    let is_drawn = !entry.picture.elements.is_empty();
    Effect::new(move |_| {
        if let Some(canvas) = canvas.get() {
            painter.set_value(Some(new_painter(&canvas, size)));
        }
    });
    on_cleanup(move || painter.with_value(|p| p.as_ref().map(Painter::stop)).unwrap_or_default());
    Effect::new(move |last: Option<(Vec<String>, Vec<String>)>| {
        lab.colors.changes.track();
        painter.with_value(|p| p.as_ref().map(Painter::look));
        let size = size.get();
        let list = display_list(&picture, Part::Whole, &[], &[]);
        let view = fit(&picture.drawing, size, 8.0);
        painter
            .with_value(|painter| {
                let painter = painter.as_ref().filter(|_| size.0 > 0.0)?;
                Some(paint(painter, &list, Vec::new(), &view, last.unwrap_or_default()))
            })
            .unwrap_or_default()
    });
    let (class, name) = (StoredValue::new(entry.class.clone()), entry.class.clone());
    let held = Memo::new(move |_| lab.tool.get() == Some(class.get_value()));
    view! {
        <li>
            <button class="tile" title=entry.doc data-class=entry.class.clone()
                aria-pressed=move || held.get().to_string()
                on:pointerdown=move |e| {
                    if e.button() == 0 {
                        e.prevent_default();
                        lab.take_tool(&class.get_value());
                        lab.carried.set_value(true);
                    }
                }
                on:pointerup=move |_| lab.carried.set_value(false)
                on:keydown=move |e| {
                    if e.key() == "Enter" || e.key() == " " {
                        e.prevent_default();
                        e.stop_propagation();
                        lab.insert(&class.get_value());
                    }
                }>
                {is_drawn.then(|| view! { <canvas node_ref=canvas aria-hidden="true"></canvas> })}
                <span>{name}</span>
            </button>
        </li>
    }
}
