//! The bin: a tile for each class that things can be made of.

use crate::actions::Context;
use crate::dock::Sheet;
use crate::js::Painter;
use crate::lab::Lab;
use crate::paint::{Part, display_list};
use crate::picture::{new_painter, paint_alone};
use crate::sheet::{fit, with_words};
use crate::{icons, keyboard, menu, words};
use leptos::ev::MouseEvent;
use leptos::html::Canvas;
use leptos::prelude::*;
use presentation::find::has_words;
use presentation::palette::{Makeable, called};
use presentation::shelves::{Shelf, shelved};
use session::view::{BinEntry, PictureView};

/// What of the bin is one stop of Tab.
const LIST: &str = ".bin .scroll";
/// What filters it.
const FIELD: &str = ".bin input";

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
    let has = move |entry: &BinEntry| {
        wanted.with(|wanted| has_words(&[&*entry.class, &*entry.doc].join(" "), wanted))
    };
    let found = Memo::new(move |_| {
        entries.with(|all| all.iter().filter(|entry| has(entry)).cloned().collect::<Vec<_>>())
    });
    let is_filtered = move || wanted.with(|wanted| !wanted.trim().is_empty());
    let shelves = Memo::new(move |_| found.with(|found| shelved(found, is_filtered())));
    let libraries = Memo::new(move |_| lab.unused_libraries());
    let beside = Memo::new(move |_| lab.without_used(lab.beside()));
    // what is looked for may be in a library that is not used yet
    let offered = Memo::new(move |_| {
        let all = if is_filtered() { lab.in_unused_libraries() } else { Vec::new() };
        all.into_iter().filter(|entry| has(entry)).collect::<Vec<_>>()
    });
    let more = Memo::new(move |_| offered.with(|offered| shelved(offered, true)));
    list_beside(lab);
    // one stop of Tab: arrows lead from tile to tile
    Effect::new(move |_| {
        shelves.track();
        more.track();
        libraries.track();
        beside.track();
        keyboard::one_stop(LIST);
    });
    // Enter: the library or document of that name, else the class that is called so, or begins so, or is found alone
    let take = move || {
        let typed = wanted.get_untracked().trim().to_lowercase();
        if typed.is_empty() {
            return;
        }
        let is_typed = |name: &String| name.to_lowercase() == typed;
        let library = libraries.get_untracked().into_iter().find(is_typed);
        let document = beside.get_untracked().into_iter().find(is_typed);
        let makeable = |entry: BinEntry, is_used: bool| Makeable {
            class: entry.class,
            unused: (!is_used).then_some(entry.library),
        };
        let in_order = |shelves: Vec<Shelf>| shelves.into_iter().flat_map(|shelf| shelf.entries);
        let own = in_order(shelves.get_untracked()).map(|entry| makeable(entry, true));
        let other = in_order(more.get_untracked()).map(|entry| makeable(entry, false));
        let all: Vec<Makeable> = own.chain(other).collect();
        match (library, document, called(&all, &typed)) {
            (Some(library), ..) => {
                lab.use_library(&library);
            }
            (_, Some(document), _) => lab.use_document(document),
            (.., Some(one)) => {
                lab.with_library(one, Lab::insert);
            }
            _ => lab.say_refused(words::nothing_called(&typed)),
        }
    };
    view! {
        <section class="panel bin" aria-label=words::BIN on:pointerup=move |_| lab.carried.set_value(false)>
            <div class="head">
                <input type="search" placeholder=words::FILTER aria-label=words::FILTER_BIN
                    on:input=move |e| {
                        wanted.set(event_target_value(&e));
                        lab.read_libraries();
                    }
                    on:keydown=move |e| {
                        match e.key().as_str() {
                            "Enter" => take(),
                            "ArrowDown" => keyboard::enter_list_at(LIST, ".tile"),
                            _ => return,
                        }
                        e.prevent_default();
                        e.stop_propagation();
                    } />
            </div>
            <div class="scroll" on:keydown=|e| keyboard::go_in(LIST, &e)>
                <For each=move || shelves.get() key=Shelf::key let(shelf)>
                    <ShelfView lab=lab shelf=shelf is_used=true />
                </For>
                <Show when=move || !more.with(Vec::is_empty)>
                    <h3>{words::NOT_USED_YET}</h3>
                    <For each=move || more.get() key=Shelf::key let(shelf)>
                        <ShelfView lab=lab shelf=shelf is_used=false />
                    </For>
                </Show>
                <Show when=move || !libraries.with(Vec::is_empty)>
                    <h3>{words::MORE_LIBRARIES}</h3>
                    <Uses names=libraries take=move |name: String| {
                        lab.use_library(&name);
                        // the button is gone, and the keyboard with it
                        keyboard::focus(FIELD);
                    } />
                </Show>
                <Show when=move || !beside.with(Vec::is_empty)>
                    <details class="beside" on:toggle=|_| keyboard::one_stop(LIST)>
                        <summary>{words::DOCUMENTS_BESIDE}</summary>
                        <Uses names=beside take=move |name| lab.use_document(name) />
                    </details>
                </Show>
            </div>
        </section>
    }
}

/// Has the documents listed that lie beside the shown one.
fn list_beside(lab: Lab) {
    Effect::new(move |_| {
        lab.current.track();
        leptos::task::spawn_local(async move {
            // without a server nothing lies beside a document
            let _ = lab.fetch_list().await;
        });
    });
}

/// A button for each of what could be used.
#[component]
pub fn Uses(
    /// What could be used.
    names: Memo<Vec<String>>,
    /// What is done with a name.
    take: impl Fn(String) + Copy + Send + 'static,
) -> impl IntoView {
    view! {
        <p class="choices">
            <For each=move || names.get() key=Clone::clone let(name)>
                {
                    let label = format!("use {name}");
                    let named = name.clone();
                    view! {
                        <button data-library=named on:click=move |_| take(name.clone())>{label}</button>
                    }
                }
            </For>
        </p>
    }
}

/// Tiles that lie together, under their toolbox or library.
#[component]
fn ShelfView(lab: Lab, shelf: Shelf, is_used: bool) -> impl IntoView {
    let name = if shelf.name.is_empty() { words::OWN_CLASSES.into() } else { shelf.name };
    let tiles = shelf.entries.into_iter().map(move |entry| {
        view! { <Tile lab=lab entry=entry is_used=is_used /> }
    });
    view! {
        <details open=shelf.is_open on:toggle=|_| keyboard::one_stop(LIST)>
            <summary>{name}</summary>
            <ul class="tiles">{tiles.collect_view()}</ul>
        </details>
    }
}

/// A tile: a click takes the tool that places such a thing, Enter inserts one where there is room. Where its library is
/// not used yet, it is from then on.
#[component]
fn Tile(lab: Lab, entry: BinEntry, is_used: bool) -> impl IntoView {
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
        let list = display_list(&picture, Part::Whole, &[]);
        let view = with_words(&picture.drawing, fit(&picture.drawing, size, 8.0), size);
        painter
            .with_value(|painter| {
                let painter = painter.as_ref().filter(|_| size.0 > 0.0)?;
                Some(paint_alone(painter, &list, &view, last.unwrap_or_default()))
            })
            .unwrap_or_default()
    });
    let (class, name) = (StoredValue::new(entry.class.clone()), entry.class.clone());
    let made = StoredValue::new(Makeable {
        class: entry.class.clone(),
        unused: (!is_used).then(|| entry.library.clone()),
    });
    let take = move |take: fn(Lab, &str)| {
        lab.with_library(&made.get_value(), take);
    };
    let held = Memo::new(move |_| lab.tool.get() == Some(class.get_value()));
    let is_own = entry.library.is_empty();
    let open_menu = move |at: (f64, f64)| {
        lab.drop_tool();
        lab.carried.set_value(false);
        lab.of_tile.set(Some(class.get_value()));
        menu::open_at(lab, at, Context::Class);
    };
    let by_finger = StoredValue::new(false);
    view! {
        <li>
            <button class="tile" title=entry.doc data-class=entry.class.clone()
                aria-pressed=move || held.get().to_string()
                on:pointerdown=move |e| {
                    by_finger.set_value(e.pointer_type() == "touch");
                    if e.button() == 0 && !by_finger.get_value() {
                        e.prevent_default();
                        take(Lab::take_tool);
                        lab.carried.set_value(true);
                    }
                }
                on:click=move |_| {
                    // a finger that comes down may scroll the bin; what it takes is placed where the sheet was
                    if by_finger.get_value() {
                        take(Lab::take_tool);
                        lab.sheet.set(Sheet::Shut);
                    }
                }
                on:contextmenu=move |e: MouseEvent| {
                    if is_own {
                        e.prevent_default();
                        open_menu((f64::from(e.client_x()), f64::from(e.client_y())));
                    }
                }
                on:keydown=move |e| {
                    let asks = e.key() == "ContextMenu" || e.shift_key() && e.key() == "F10";
                    if asks && is_own {
                        e.prevent_default();
                        e.stop_propagation();
                        let tile: web_sys::Element = event_target(&e);
                        let rect = tile.get_bounding_client_rect();
                        open_menu((rect.left() + 8.0, rect.bottom()));
                    }
                    if e.key() == "Enter" || e.key() == " " {
                        e.prevent_default();
                        e.stop_propagation();
                        take(Lab::insert);
                    }
                }>
                {is_drawn.then(|| view! { <canvas node_ref=canvas aria-hidden="true"></canvas> })}
                <span>{humps(&name).into_iter().map(|hump| view! { {hump}<wbr /> }).collect_view()}</span>
            </button>
            {is_own.then(|| {
                let label = words::edit_class(&entry.class);
                view! {
                    <button class="bare edit" title=label.clone() aria-label=label
                        on:click=move |_| lab.edit_class(&class.get_value())>{icons::edit()}</button>
                }
            })}
        </li>
    }
}

/// A name in the pieces between which a line of it may break: `HorizontalLine` in two.
fn humps(name: &str) -> Vec<String> {
    let mut humps: Vec<String> = Vec::new();
    for c in name.chars() {
        match humps.last_mut() {
            Some(hump) if !c.is_uppercase() => hump.push(c),
            _ => humps.push(c.to_string()),
        }
    }
    humps
}
