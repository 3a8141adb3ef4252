//! The bottom dock: text, table, plot, calculator and family, shut at first; and what a narrow page pulls up instead.

use crate::apart::apart;
use crate::calculator::Calculator;
use crate::family::Families;
use crate::lab::{Drawer, Lab};
use crate::plot::PlotPane;
use crate::splitter::{Splitter, Way};
use crate::text::Text;
use crate::values::Values;
use crate::{keyboard, theme, words};
use leptos::prelude::*;

/// The tabs of the dock.
const TABS: &str = ".dock .tabs";

const DOCK_KEY: &str = "thinglab/dock";

/// What the dock shows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Tab {
    /// The text of the document.
    Text,
    /// The table of its values.
    Table,
    /// Values over others, and loci.
    Plot,
    /// Expressions and their values.
    Calculator,
    /// Rows that a program draws.
    Family,
}

/// The tabs, in order.
const ALL: [Tab; 5] = [Tab::Text, Tab::Table, Tab::Plot, Tab::Calculator, Tab::Family];

impl Tab {
    fn label(self) -> &'static str {
        match self {
            Self::Text => words::TEXT,
            Self::Table => words::TABLE,
            Self::Plot => words::PLOT,
            Self::Calculator => words::CALCULATOR,
            Self::Family => words::FAMILY,
        }
    }
}

/// What a narrow page has pulled up over the picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sheet {
    /// Nothing: the picture has the screen.
    Shut,
    /// The drawer with structure, bin and history.
    Drawer,
    /// The inspector.
    Inspector,
    /// The dock.
    Dock,
}

impl Sheet {
    /// Its name in the page's style.
    pub fn name(self) -> &'static str {
        match self {
            Self::Shut => "shut",
            Self::Drawer => "drawer",
            Self::Inspector => "inspector",
            Self::Dock => "dock",
        }
    }
}

/// What the dock showed in the last visit.
pub fn kept() -> Option<Tab> {
    let kept = theme::keep(DOCK_KEY)?;
    ALL.into_iter().find(|tab| tab.label() == kept)
}

/// The dock below the picture.
#[component]
pub fn Dock(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let wrong = Memo::new(move |_| {
        let is_wrong = |d: &&session::view::DiagnosticView| d.severity != "recording";
        lab.told_diagnostics().iter().filter(is_wrong).count()
    });
    let mild = Memo::new(move |_| lab.told_diagnostics().iter().all(|d| d.severity != "error"));
    let tab = move |shown: Tab| {
        view! {
            <button role="tab" id=format!("tab-{}", shown.label().to_lowercase()) aria-controls="dock"
                aria-selected=move || (lab.dock.get() == Some(shown)).to_string()
                on:click=move |_| lab.toggle_dock(shown)>
                {shown.label()}
                {move || (shown == Tab::Text && wrong.get() > 0)
                    .then(|| view! { <span class="count" class:mild=mild>{wrong}</span> })}
            </button>
        }
    };
    Effect::new(move |_| {
        lab.dock.track();
        keyboard::one_stop(TABS);
    });
    view! {
        <Show when=move || lab.dock.get().is_some()>
            <Splitter name="dock" way=Way::Up least=120.0 most=800.0 />
        </Show>
        <div class="dock" class:open=move || lab.dock.get().is_some()>
            <div class="tabs" role="tablist" aria-label=words::DOCK on:keydown=|e| keyboard::go_in(TABS, &e)>{ALL.map(tab).into_iter().collect_view()}</div>
            <div class="shelf" id="dock" role="tabpanel" aria-label=words::DOCK>
                {move || match lab.dock.get() {
                    Some(Tab::Text) => apart(|| view! { <Text lab=lab /> }.into_any()),
                    Some(Tab::Table) => apart(|| view! { <Values lab=lab /> }.into_any()),
                    Some(Tab::Plot) => apart(|| view! { <PlotPane lab=lab /> }.into_any()),
                    Some(Tab::Calculator) => apart(|| view! { <Calculator lab=lab /> }.into_any()),
                    Some(Tab::Family) => apart(|| view! { <Families lab=lab /> }.into_any()),
                    None => ().into_any(),
                }}
            </div>
        </div>
    }
}

/// The handles of the sheet that a narrow page pulls up.
#[component]
pub fn Handles(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let handle = move |label: &'static str, sheet: Sheet| {
        let pull = move |_| {
            let open = lab.sheet.get_untracked();
            if sheet == Sheet::Dock && lab.dock.get_untracked().is_none() {
                lab.open_dock(Tab::Text);
            }
            lab.sheet.set(if open == sheet { Sheet::Shut } else { sheet });
        };
        view! {
            <button aria-pressed=move || (lab.sheet.get() == sheet).to_string() on:click=pull>{label}</button>
        }
    };
    view! {
        <nav class="handles" aria-label=words::SHEET>
            {handle(words::PARTS, Sheet::Drawer)}
            {handle(words::INSPECTOR, Sheet::Inspector)}
            {handle(words::DOCK, Sheet::Dock)}
        </nav>
    }
}

impl Lab {
    /// Opens the drawer with a tab; a narrow page pulls it up.
    pub fn open_drawer(self, tab: Drawer) {
        self.drawer.set(tab);
        self.sheet.set(Sheet::Drawer);
    }

    /// Opens the dock with a tab, and remembers it.
    pub fn open_dock(self, tab: Tab) {
        self.dock.set(Some(tab));
        self.sheet.set(Sheet::Dock);
        theme::put(DOCK_KEY, Some(tab.label()));
    }

    /// Opens the dock with a tab, and gives the keyboard to what a selector finds in it.
    pub fn go_to_dock(self, tab: Tab, selector: &'static str) {
        self.open_dock(tab);
        request_animation_frame(move || keyboard::focus(selector));
    }

    /// Opens the dock with a tab, or shuts it where that is open.
    pub fn toggle_dock(self, tab: Tab) {
        if self.dock.get_untracked() == Some(tab) {
            self.dock.set(None);
            self.sheet.set(Sheet::Shut);
            theme::put(DOCK_KEY, None);
        } else {
            self.open_dock(tab);
        }
    }
}
