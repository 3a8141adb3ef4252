//! The page: the top bar, the panels and where they lie.

use crate::actions::{self, Action};
use crate::apart::apart;
use crate::bin_panel::Bin;
use crate::by_example::ByExample;
use crate::class_pane::ClassPane;
use crate::dialog::Dialog;
use crate::dock::{Dock, Handles};
use crate::drafting::Drawing;
use crate::drafting::prompt::PromptLine;
use crate::gallery::Gallery;
use crate::history::History;
use crate::inspector::Inspector;
use crate::lab::{Drawer, Lab};
use crate::lesson::{Coach, PointedAt};
use crate::menu::{self, MenuView};
use crate::palette::Palette;
use crate::picture::Picture;
use crate::printed::Printed;
use crate::rail::Rail;
use crate::splitter::{Splitter, Way};
use crate::status::{Asked, Recognition, Refused, StatusLine};
use crate::strip::Strip;
use crate::structure::Structure;
use crate::why::Why;
use crate::{bench, icons, js, keyboard, probe, route, words};
use leptos::ev;
use leptos::prelude::*;
use std::time::Duration;

/// The whole page.
#[component]
pub fn Page() -> impl IntoView {
    let lab = Lab::new();
    let ready = RwSignal::new(false);
    probe::publish(lab);
    actions::follow_clipboard(lab);
    route::settle();
    leptos::task::spawn_local(async move {
        let is_served = lab.fetch_library().await;
        lab.welcome();
        // what a link carries has no place without the server
        let is_lost = !is_served && route::shared().is_some();
        let is_named = route::present().is_some() || route::shared().is_some();
        lab.arriving.set(is_named && !is_lost);
        ready.set(true);
        if !is_lost {
            follow(lab);
        }
    });
    let listeners = [
        window_event_listener(ev::hashchange, move |_| follow(lab)),
        window_event_listener(ev::focus, move |_| {
            lab.renew_tables();
            lab.renew_document();
        }),
        window_event_listener(ev::keydown, move |e| {
            keyboard::follow_key(lab, &e);
            if !e.default_prevented() && actions::key(lab, &e) {
                e.prevent_default();
            }
        }),
        window_event_listener(ev::beforeunload, move |e| {
            if lab.any_unsaved() {
                e.prevent_default();
            }
        }),
    ];
    on_cleanup(move || listeners.into_iter().for_each(WindowListenerHandle::remove));
    Effect::new(move |_| {
        let name =
            lab.document.with(|document| document.as_ref().map(|d| (d.title.clone(), d.dirty)));
        document().set_title(&match name {
            Some((title, true)) => format!("• {title} — {}", words::LAB),
            Some((title, false)) => format!("{title} — {}", words::LAB),
            None => String::from(words::LAB),
        });
    });
    Effect::new(move |was_there: Option<bool>| {
        let is_there = ready.get() && !lab.arriving.get();
        if is_there && was_there == Some(false) {
            js::after_painting(move || leptos::task::spawn_local(lab.fetch_rest()));
        }
        is_there || was_there == Some(true)
    });
    let shown = Memo::new(move |_| lab.current.get());
    view! {
        <div class="page" on:keydown:capture=move |e| keyboard::follow_key(lab, &e)
            on:pointerdown:capture=move |_| keyboard::follow_pointer(lab)
            on:focusin=move |_| keyboard::follow_focus(lab)>
            <Show when=move || shown.with(Option::is_some)>
                <a class="skip" href="#picture" on:click=move |e: ev::MouseEvent| {
                    e.prevent_default();
                    actions::run(actions::named("go-picture"), lab);
                }>{words::SKIP}</a>
            </Show>
            <TopBar lab=lab />
            {move || match (ready.get(), shown.get()) {
                (false, _) => view! { <main><p class="quiet" role="status">{words::LOADING}</p></main> }.into_any(),
                (true, Some(_)) => view! { <Document lab=lab /> }.into_any(),
                // a gallery that nobody asked for would be read and drawn first
                (true, None) if lab.arriving.get() => view! {
                    <main><p class="quiet" role="status">{words::LOADING}</p></main>
                }.into_any(),
                (true, None) => apart(|| view! {
                    <Refused lab=lab />
                    <Gallery lab=lab />
                }.into_any()),
            }}
            <Opening lab=lab />
            <Palette lab=lab />
            <MenuView lab=lab />
            <Dialog lab=lab />
        </div>
    }
}

/// Says how far a long opening is.
#[component]
fn Opening(lab: Lab) -> impl IntoView {
    view! {
        <Show when=move || lab.opening.with(Option::is_some)>
            <div class="notice opening" role="status">
                <p class="words">{words::OPENING}
                    <progress aria-label=words::OPENING max=session::Opening::STAGES.to_string()
                        value=move || lab.opening.get().unwrap_or_default().to_string()></progress></p>
                <button on:click=move |_| lab.give_openings_up()>{words::CANCEL}</button>
            </div>
        </Show>
    }
}

/// Shows what the page's address names.
fn follow(lab: Lab) {
    if let Some(packed) = route::shared() {
        lab.open_shared(&packed);
        return;
    }
    let Some(path) = route::present() else {
        lab.leave();
        return;
    };
    if lab.current.get_untracked().as_deref() == Some(&path)
        || lab.coming.with_value(|(_, coming)| coming.as_deref() == Some(&path))
    {
        return;
    }
    let mine = lab.coming.with_value(|(count, _)| count + 1);
    lab.coming.set_value((mine, Some(path.clone())));
    let before = keyboard::holder().filter(|holder| holder.tag_name() != "BODY");
    leptos::task::spawn_local(async move {
        let loaded = lab.load(&path).await;
        // what was begun after it speaks for itself
        if lab.coming.with_value(|(count, _)| *count != mine) {
            return;
        }
        match loaded {
            Ok(_) if route::present().as_deref() == Some(&path) => {
                lab.show(&path);
                // what was chosen in the gallery is gone with it
                if before.is_some() {
                    keyboard::give_back(before);
                }
            }
            Ok(_) => {}
            Err(message) => {
                // of what was given up the address does not speak any more
                if route::present().as_deref() == Some(&path) {
                    lab.leave();
                }
                lab.say_refused(format!("{path}: {message}"));
            }
        }
        lab.coming.set_value((mine, None));
        lab.arriving.set(false);
    });
}

#[component]
fn TopBar(lab: Lab) -> impl IntoView {
    let title = Memo::new(move |_| lab.document.with(|d| d.as_ref().map(|d| d.title.clone())));
    let dirty = Memo::new(move |_| lab.document.with(|d| d.as_ref().is_some_and(|d| d.dirty)));
    let read_only =
        Memo::new(move |_| lab.document.with(|d| d.as_ref().is_some_and(|d| !d.writable)));
    let theme_title = move || words::theme(lab.colors.theme.get());
    view! {
        <header class="bar">
            <a class="home" href=route::GALLERY title=words::OPEN_GALLERY>
                {icons::gallery()}<span>{words::LAB}</span>
            </a>
            <Show when=move || title.with(Option::is_some)>
                <h1 class="title">
                    {title}
                    <Show when=move || dirty.get()><span class="dirty" title=words::NOT_SAVED>"•"</span></Show>
                </h1>
                <Show when=move || read_only.get()><span class="tag" title=words::READ_ONLY>{words::BUILT_IN}</span></Show>
            </Show>
            <button class="file" aria-haspopup="menu" title=words::FILE
                on:click=move |e: ev::MouseEvent| menu::open_below(lab, &e, actions::Group::File)>
                {words::FILE}</button>
            <div class="tools" role="toolbar" aria-label=words::TOOLS>
                <Show when=move || title.with(Option::is_some)>
                    <Tool lab=lab action=actions::named("undo") icon=icons::undo
                        hint=Signal::derive(move || lab.status.with(|s| s.undo.as_deref().map(words::undo_step))) />
                    <Tool lab=lab action=actions::named("redo") icon=icons::redo
                        hint=Signal::derive(move || lab.status.with(|s| s.redo.as_deref().map(words::redo_step))) />
                    <Tool lab=lab action=actions::named("save") icon=icons::save
                        hint=Signal::derive(|| None) />
                </Show>
                <button class="search" title=words::PALETTE
                    on:click=move |_| lab.palette.set(true)>
                    {icons::search()}<span>{words::SEARCH}</span><kbd>"Ctrl K"</kbd>
                </button>
                <button class="tool" data-action="theme" title=theme_title aria-label=theme_title
                    on:click=move |_| actions::run(actions::named("theme"), lab)>{icons::theme()}</button>
            </div>
        </header>
    }
}

/// A button for an action; disabled it says why.
#[component]
fn Tool(
    lab: Lab,
    action: &'static Action,
    icon: fn() -> AnyView,
    hint: Signal<Option<String>>,
) -> impl IntoView {
    let why = Memo::new(move |_| (action.enabled)(lab).err());
    let hold = Hold::of(lab, action);
    let title = move || {
        let says = match why.get() {
            Some(why) => format!("{}: {why}", action.label),
            None => hint.get().unwrap_or_else(|| String::from(action.label)),
        };
        let says = action.keys.first().map_or(says.clone(), |key| format!("{says} ({key})"));
        if hold.has_list { format!("{says}; {}", words::HOLD_FOR_LIST) } else { says }
    };
    view! {
        <button class="tool" data-action=action.id title=title aria-label=action.label
            aria-disabled=move || why.get().is_some().to_string()
            on:pointerdown=move |_| hold.down()
            on:pointerup=move |_| hold.up()
            on:pointerleave=move |_| hold.up()
            on:contextmenu=move |e| if hold.shows() { e.prevent_default() }
            on:click=move |_| {
                let is_done = hold.is_shown.try_update_value(std::mem::take).unwrap_or(false);
                if !is_done && why.get_untracked().is_none() {
                    actions::run(action, lab);
                }
            }>
            {icon()}
        </button>
    }
}

/// A button of the steps that is held down, or clicked with the right button: it shows the list of all.
#[derive(Clone, Copy)]
struct Hold {
    lab: Lab,
    has_list: bool,
    /// How often it was pressed or let go.
    presses: StoredValue<u32>,
    /// Whether this press has shown the list, and is no click.
    is_shown: StoredValue<bool>,
}

impl Hold {
    /// So long it is pressed before the list is shown.
    const WAIT: Duration = Duration::from_millis(450);

    fn of(lab: Lab, action: &Action) -> Self {
        let has_list = matches!(action.id, "undo" | "redo");
        Self { lab, has_list, presses: StoredValue::new(0), is_shown: StoredValue::new(false) }
    }

    fn down(self) {
        self.is_shown.set_value(false);
        self.up();
        let mine = self.presses.get_value();
        let wait = move || {
            if self.presses.try_get_value() == Some(mine) && self.shows() {
                self.is_shown.set_value(true);
            }
        };
        if self.has_list {
            set_timeout(wait, Self::WAIT);
        }
    }

    fn up(self) {
        self.presses.update_value(|n| *n = n.wrapping_add(1));
    }

    /// Shows the list, where there is one.
    fn shows(self) -> bool {
        if self.has_list {
            self.lab.open_drawer(Drawer::History);
        }
        self.has_list
    }
}

/// The views of one document, side by side.
#[component]
fn Document(lab: Lab) -> impl IntoView {
    view! {
        <main class="document" data-sheet=move || lab.sheet.get().name()>
            <div class="notices">
                <Refused lab=lab />
                <Asked lab=lab />
                <Recognition lab=lab />
                <Conflict lab=lab />
            </div>
            <Coach lab=lab />
            <Drawer lab=lab />
            <Splitter name="left" way=Way::Right least=160.0 most=560.0 />
            <div class="centre">
                <Draft lab=lab />
                <div class="stage">
                    <Rail lab=lab />
                    <Picture lab=lab />
                    <Strip lab=lab />
                    <PromptLine lab=lab />
                    <ClassPane lab=lab />
                    <PointedAt lab=lab />
                </div>
                <Show when=move || lab.why.get()>
                    <Splitter name="why" way=Way::Up least=96.0 most=640.0 />
                    <Why lab=lab />
                </Show>
                <Dock lab=lab />
            </div>
            <Splitter name="right" way=Way::Left least=220.0 most=900.0 />
            <div class="side"><Inspector lab=lab /></div>
            <ByExample lab=lab />
            <Handles lab=lab />
            <Printed lab=lab />
            <Show when=bench::is_asked><bench::Bench lab=lab /></Show>
        </main>
        <StatusLine lab=lab />
    }
}

/// The tabs of the left drawer.
const DRAWERS: &str = ".drawer .tabs";

/// The left drawer: the structure, the bin, the history.
#[component]
fn Drawer(lab: Lab) -> impl IntoView {
    let tab = move |label: &'static str, shown: Drawer| {
        view! {
            <button role="tab" id=format!("tab-{}", label.to_lowercase()) aria-controls="drawer"
                aria-selected=move || (lab.drawer.get() == shown).to_string()
                on:click=move |_| lab.drawer.set(shown)>{label}</button>
        }
    };
    Effect::new(move |_| {
        lab.drawer.track();
        keyboard::one_stop(DRAWERS);
    });
    view! {
        <div class="drawer">
            <div class="tabs" role="tablist" aria-label=words::VIEWS
                on:keydown=|e| keyboard::go_in(DRAWERS, &e)>
                {tab(words::STRUCTURE, Drawer::Structure)}
                {tab(words::DRAW, Drawer::Draw)}
                {tab(words::BIN, Drawer::Bin)}
                {tab(words::HISTORY, Drawer::History)}
            </div>
            <div class="shelf" id="drawer" role="tabpanel" aria-label=words::VIEWS>
                <h2 class="unseen">{move || match lab.drawer.get() {
                    Drawer::Structure => words::STRUCTURE,
                    Drawer::Draw => words::DRAW,
                    Drawer::Bin => words::BIN,
                    Drawer::History => words::HISTORY,
                }}</h2>
                {move || match lab.drawer.get() {
                    Drawer::Draw => apart(|| view! { <Drawing lab=lab /> }.into_any()),
                    Drawer::Bin => apart(|| view! { <Bin lab=lab /> }.into_any()),
                    Drawer::History => apart(|| view! { <History lab=lab /> }.into_any()),
                    Drawer::Structure => view! { <Structure lab=lab /> }.into_any(),
                }}
            </div>
        </div>
    }
}

/// Offers the unsaved text of an earlier visit.
#[component]
fn Draft(lab: Lab) -> impl IntoView {
    view! {
        <Show when=move || lab.draft.with(Option::is_some)>
            <div class="notice draft" role="alert">
                <p class="words">{words::DRAFT_FOUND}</p>
                <button class="primary" on:click=move |_| lab.decide_draft(true)>{words::RESTORE}</button>
                <button on:click=move |_| lab.decide_draft(false)>{words::DISCARD}</button>
            </div>
        </Show>
    }
}

/// Asks what to do where the file has changed underneath.
#[component]
fn Conflict(lab: Lab) -> impl IntoView {
    let gone = Memo::new(move |_| lab.conflict.with(|theirs| matches!(theirs, Some(None))));
    view! {
        <Show when=move || lab.conflict.with(Option::is_some)>
            <div class="notice refused" role="alertdialog" aria-label=words::CONFLICT>
                <p class="words">{move || if gone.get() { words::CONFLICT_GONE } else { words::CONFLICT }}</p>
                <Show when=move || !gone.get()>
                    <button on:click=move |_| lab.take_theirs()>{words::TAKE_THEIRS}</button>
                </Show>
                <button class="primary" on:click=move |_| lab.overwrite()>{words::OVERWRITE}</button>
                <button class="bare" aria-label=words::CLOSE title=words::CLOSE
                    on:click=move |_| lab.conflict.set(None)>{icons::close()}</button>
            </div>
        </Show>
    }
}
