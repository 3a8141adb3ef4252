//! The structure view: the tree of parts, constraints and merges, the picture's accessible twin.
//!
//! All rows are equally high; only those in sight, and the one that has the keyboard, are in the page.

use crate::actions::Context;
use crate::lab::{Lab, Notice};
use crate::{field, icons, keyboard, menu, words};
use leptos::attr::custom::custom_attribute;
use leptos::ev::{FocusEvent, KeyboardEvent};
use leptos::html::Div;
use leptos::prelude::*;
use presentation::rows::{Shown, called, is_unnamed, rule_alone, shown};
use session::Command;
use session::view::{RowKind, StructureRow};
use std::collections::BTreeSet;
use wasm_bindgen::JsCast;
use web_sys::Element;

/// At first so many levels are open as show no more rows than this.
const FIRST_ROWS: usize = 30;

/// So many rows above and below those in sight are in the page as well.
const SPARE_ROWS: usize = 10;

/// Which rows are open or shut against the rule, and which one has the keyboard.
#[derive(Clone, Copy, Debug)]
struct Tree {
    lab: Lab,
    /// Rows above this depth are open unless they are toggled; 0 before there are any.
    open_depth: Memo<u32>,
    toggled: RwSignal<BTreeSet<String>>,
    /// The rows that were opened for what is selected, and are shut again with the next selection.
    revealed: StoredValue<BTreeSet<String>>,
    current: RwSignal<usize>,
    editing: RwSignal<Option<usize>>,
    /// The rows that no shut row hides.
    visible: Memo<Vec<Shown>>,
    /// What scrolls, and what is as high as all rows are.
    frame: NodeRef<Div>,
    sheet: NodeRef<Div>,
}

impl Tree {
    fn new(lab: Lab) -> Self {
        let open_depth = Memo::new(move |known: Option<&u32>| match known {
            Some(&depth) if depth > 0 => depth,
            _ => lab.structure.with(|rows| if rows.is_empty() { 0 } else { first_depth(rows) }),
        });
        let toggled = RwSignal::new(BTreeSet::new());
        let visible = Memo::new(move |_| {
            let depth = open_depth.get();
            let is_open = |row: &StructureRow| toggled.with(|toggled| is_open(row, depth, toggled));
            lab.structure.with(|rows| shown(rows, is_open))
        });
        Self {
            lab,
            open_depth,
            toggled,
            revealed: StoredValue::new(BTreeSet::new()),
            current: RwSignal::new(0),
            editing: RwSignal::new(None),
            visible,
            frame: NodeRef::new(),
            sheet: NodeRef::new(),
        }
    }

    fn is_open(self, row: &StructureRow) -> bool {
        self.toggled.with(|toggled| is_open(row, self.open_depth.get(), toggled))
    }

    /// The height of a row, in pixels; nothing before there are any, and once the tree is gone.
    fn row_height(self) -> Option<f64> {
        let sheet = self.sheet.try_get_untracked().flatten()?;
        let rows = self.visible.try_with_untracked(Vec::len)?;
        let height = f64::from(sheet.offset_height()) / rows as f64;
        (height > 0.0).then_some(height)
    }

    /// The places of the rows in sight, among the visible ones; nothing once the tree is gone.
    fn in_sight(self) -> Option<std::ops::Range<usize>> {
        let most = self.visible.try_with_untracked(Vec::len)?;
        Some(match (self.frame.try_get_untracked().flatten(), self.row_height()) {
            (Some(frame), Some(height)) => {
                let top = f64::from(frame.scroll_top()) / height;
                let rows = f64::from(frame.client_height()) / height;
                let from = (top as usize).saturating_sub(SPARE_ROWS).min(most);
                from..(from + rows as usize + 2 * SPARE_ROWS).min(most)
            }
            _ => 0..most.min(FIRST_ROWS + SPARE_ROWS),
        })
    }

    /// Brings a row into sight; the tree may be gone by the frame that asks for it.
    fn scroll_to(self, at: usize) {
        let place = |visible: &Vec<Shown>| visible.iter().position(|v| v.at == at);
        let (Some(place), Some(frame), Some(height)) = (
            self.visible.try_with_untracked(place).flatten(),
            self.frame.try_get_untracked().flatten(),
            self.row_height(),
        ) else {
            return;
        };
        let (top, sight) = (f64::from(frame.scroll_top()), f64::from(frame.client_height()));
        let above = place as f64 * height;
        if above < top + height {
            frame.set_scroll_top((above - height).max(0.0) as i32);
        } else if above + 2.0 * height > top + sight {
            frame.set_scroll_top((above + 2.0 * height - sight) as i32);
        }
    }

    fn row(self, at: usize) -> Option<StructureRow> {
        self.lab.structure.with_untracked(|rows| rows.get(at).cloned())
    }

    fn toggle(self, row: &StructureRow) {
        self.revealed.update_value(|revealed| _ = revealed.remove(&row.path));
        self.turn(&BTreeSet::from([row.path.clone()]));
    }

    /// Opens the rows of some paths that are shut, and shuts those that are open.
    fn turn(self, paths: &BTreeSet<String>) {
        if !paths.is_empty() {
            self.toggled.update(|toggled| *toggled = &*toggled ^ paths);
        }
    }

    /// Gives a row the keyboard and selects its thing.
    fn go_to(self, at: usize) {
        self.lab.select(self.row(at).and_then(thing_of));
        self.take_keyboard(at);
    }

    /// Parts what a merge makes one: the last goes. What has no path and is no merge stays as it is.
    fn delete(self, row: &StructureRow) {
        match row.makes_one.last().and_then(|path| session::parse_path(path)) {
            Some(path) => {
                self.lab.apply(&Command::Unmerge(path));
            }
            None => self.lab.notice.set(Some(Notice::Said(words::NO_PATH.into()))),
        }
    }

    /// Gives a row the keyboard and leaves the selection as it is.
    fn take_keyboard(self, at: usize) {
        self.current.set(at);
        self.focus(at);
    }

    /// Adds a row's thing to the selection, or takes it out.
    fn choose_also(self, at: usize) {
        let row = self.row(at).filter(|row| !row.path.is_empty() && row.kind.has_own_path());
        if let Some(row) = row {
            self.lab.select_also(&row.path);
        }
        self.take_keyboard(at);
    }

    /// Gives a row the keyboard with the next frame, unless what was done meanwhile asks for it.
    fn focus(self, at: usize) {
        keyboard::unless_taken("[role=treeitem]", move || {
            self.scroll_to(at);
            if let Some(row) = document().get_element_by_id(&format!("row-{at}")) {
                let row: web_sys::HtmlElement = JsCast::unchecked_into(row);
                // A row that has gone meanwhile needs no focus.
                let _ = row.focus();
            }
        });
    }

    fn key(self, at: usize, e: &KeyboardEvent) {
        if e.alt_key() || self.editing.get_untracked().is_some() {
            return;
        }
        let visible = self.visible.get_untracked();
        let Some(place) = visible.iter().position(|v| v.at == at) else { return };
        let Some(row) = self.row(at) else { return };
        let apart = e.ctrl_key() || e.meta_key();
        let go = |place: Option<usize>| {
            if let Some(next) = place.and_then(|p| visible.get(p)) {
                if apart { self.take_keyboard(next.at) } else { self.go_to(next.at) }
            }
        };
        let parent = || {
            self.lab
                .structure
                .with_untracked(|rows| rows[..at].iter().rposition(|above| above.depth < row.depth))
        };
        let open = row.descendants > 0 && untrack(|| self.is_open(&row));
        match e.key().as_str() {
            "ArrowDown" => go(Some(place + 1)),
            "ArrowUp" => go(place.checked_sub(1)),
            " " if apart => self.choose_also(at),
            "Home" => go(Some(0)),
            "End" => go(visible.len().checked_sub(1)),
            _ if apart => return,
            "ArrowRight" if row.descendants > 0 && !open => self.toggle(&row),
            "ArrowRight" => go(Some(place + 1)),
            "ArrowLeft" if open => self.toggle(&row),
            "ArrowLeft" => {
                if let Some(parent) = parent() {
                    self.go_to(parent);
                }
            }
            "Enter" if is_editable(&row) => self.editing.set(Some(at)),
            "Enter" | " " if row.descendants > 0 => self.toggle(&row),
            // what hides nothing has nothing to open
            "Enter" | " " => {}
            "Delete" if !row.kind.has_own_path() => self.delete(&row),
            _ => return,
        }
        e.prevent_default();
        e.stop_propagation();
    }
}

/// The path of the thing that a row speaks of: of a merge, what it makes one.
fn thing_of(row: StructureRow) -> Option<String> {
    let path = row.makes_one.into_iter().next().unwrap_or(row.path);
    (!path.is_empty()).then_some(path)
}

/// Whether a row is open: by its depth, unless it was toggled.
fn is_open(row: &StructureRow, open_depth: u32, toggled: &BTreeSet<String>) -> bool {
    (row.depth < open_depth) != toggled.contains(&row.path)
}

/// Returns how many levels to open at first: at least the document's own.
fn first_depth(rows: &[StructureRow]) -> u32 {
    let shown = |depth: u32| rows.iter().filter(|row| row.depth <= depth).count();
    let deepest = rows.iter().map(|row| row.depth).max().unwrap_or(0);
    (1..=deepest).rev().find(|depth| shown(*depth) <= FIRST_ROWS).unwrap_or(1)
}

/// A row's name; the document's is its title.
fn named(row: &StructureRow, title: Option<String>) -> String {
    if row.depth == 0 { title.unwrap_or_default() } else { row.name.clone() }
}

/// Whether a row's value can be typed.
fn is_editable(row: &StructureRow) -> bool {
    match row.kind {
        RowKind::Part | RowKind::Virtual => row.value.is_some(),
        RowKind::Constraint | RowKind::Merge | RowKind::Side => false,
    }
}

/// The tree of the open document.
#[component]
pub fn Structure(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let tree = Tree::new(lab);
    let window = RwSignal::new(tree.in_sight().unwrap_or_default());
    let look = move || {
        // another view may have taken the tree's place since the frame was asked for
        let Some(now) = tree.in_sight() else { return };
        if window.try_with_untracked(|window| *window != now) == Some(true) {
            window.set(now);
        }
    };
    Effect::new(move |_| {
        tree.visible.track();
        request_animation_frame(look);
    });
    let listener = window_event_listener(leptos::ev::resize, move |_| look());
    on_cleanup(move || {
        listener.remove();
        // the lab may have gone with the page
        let _ = lab.shown_things.try_set_value(Vec::new());
    });
    let rows = Memo::new(move |_| {
        let (window, current) = (window.get(), tree.current.get());
        tree.visible.with(|visible| {
            let rows = visible.iter().copied().enumerate();
            let rows = rows.filter(|(place, row)| window.contains(place) || row.at == current);
            let rows: Vec<(usize, Shown)> = rows.collect();
            tree.lab.shown_things.set_value(rows.iter().map(|(_, row)| row.at).collect());
            rows
        })
    });
    // what is chosen beside it moves nothing: the keyboard stays at its row, as at one that speaks of it
    let chosen = Memo::new(move |_| lab.selected.get());
    Effect::new(move |_| {
        let path = chosen.get();
        let current = tree.current.get_untracked();
        let is_seen = tree.visible.with_untracked(|all| all.iter().any(|row| row.at == current));
        let spoken_of = tree.row(current).filter(|_| is_seen).and_then(thing_of);
        if spoken_of != path || path.is_none() {
            // the tree may have gone with its tab
            let is_so = move |path: &Option<String>| {
                chosen.try_get_untracked().is_some_and(|chosen| chosen == *path)
            };
            lab.behind_hand(
                1,
                Box::new(move || {
                    if is_so(&path) {
                        reveal(tree, path.as_deref());
                    }
                }),
            );
        }
    });
    // a row that is made anew, since rows above it have come or gone, has the keyboard again
    let held = StoredValue::new(false);
    Effect::new(move |_| {
        rows.track();
        if held.get_value() {
            request_animation_frame(move || {
                let is_nowhere =
                    keyboard::holder().is_none_or(|holder| holder.tag_name() == "BODY");
                if let Some(at) = tree.current.try_get_untracked().filter(|_| is_nowhere) {
                    tree.focus(at);
                }
            });
        }
    });
    let leave = move |e: FocusEvent| {
        if e.related_target().is_some() {
            return held.set_value(false);
        }
        // a row that is still there has been left, be it for nothing
        let row = e.target().and_then(|target| target.dyn_into::<Element>().ok());
        request_animation_frame(move || {
            let is_there = row.is_some_and(|row| row.is_connected());
            let is_held = keyboard::holder().is_some_and(|holder| holder.id().starts_with("row-"));
            if is_there && !is_held {
                // the tree may have gone meanwhile
                let _ = held.try_set_value(false);
            }
        });
    };
    view! {
        <section class="panel structure" aria-label=words::STRUCTURE>
            <h2>{words::STRUCTURE}</h2>
            <div class="scroll" node_ref=tree.frame on:scroll=move |_| look()>
                <div class="rows" role="tree" aria-label=words::STRUCTURE aria-multiselectable="true"
                    node_ref=tree.sheet
                    style:--rows=move || tree.visible.with(Vec::len).to_string()
                    on:focusin=move |_| held.set_value(true) on:focusout=leave
                    on:pointerleave=move |_| lab.hover(None)>
                    <For each=move || rows.get() key=|row| *row let(row)>
                        <Row tree=tree place=row.0 shown=row.1 />
                    </For>
                </div>
            </div>
        </section>
    }
}

/// Opens what hides a thing's row, shuts what was opened for the one before, and makes it the tree's present row; of
/// nothing, only shuts.
fn reveal(tree: Tree, path: Option<&str>) {
    let is_shut = |row: &StructureRow| !untrack(|| tree.is_open(row));
    let found = tree.lab.structure.with_untracked(|rows| {
        let is_it = |row: &StructureRow| Some(row.path.as_str()) == path && row.kind.has_own_path();
        let at = rows.iter().position(is_it);
        let above: Vec<StructureRow> = at.map(|at| above(rows, at).cloned().collect())?;
        Some((at?, above))
    });
    let (at, above) = match (path, found) {
        // a row that is not there yet leaves the tree as it is
        (Some(_), None) => return,
        (Some(_), Some((at, above))) => (Some(at), above),
        (None, _) => (None, Vec::new()),
    };
    let held: BTreeSet<String> = above.iter().map(|row| row.path.clone()).collect();
    let opened: BTreeSet<String> =
        above.iter().filter(|row| is_shut(row)).map(|row| row.path.clone()).collect();
    let before = tree.revealed.get_value();
    tree.turn(&(&(&before - &held) | &opened));
    tree.revealed.set_value(&(&before & &held) | &opened);
    // of a row that is shut away, what hides it has the keyboard
    let now = at.unwrap_or_else(|| {
        let current = tree.current.get_untracked();
        tree.lab.structure.with_untracked(|rows| match rows.get(current) {
            Some(_) => above_shut(rows, current, is_shut),
            None => current,
        })
    });
    if tree.current.get_untracked() != now {
        tree.current.set(now);
    }
    if let Some(at) = at {
        request_animation_frame(move || tree.scroll_to(at));
    }
}

/// The rows that a row lies within, the innermost first.
fn above(rows: &[StructureRow], at: usize) -> impl Iterator<Item = &StructureRow> {
    let mut depth = rows[at].depth;
    rows[..at].iter().rev().filter(move |row| {
        let is_above = row.depth < depth;
        depth = depth.min(row.depth);
        is_above
    })
}

/// A row, or the outermost one that is shut and hides it.
fn above_shut(rows: &[StructureRow], at: usize, is_shut: impl Fn(&StructureRow) -> bool) -> usize {
    let hides = above(rows, at).filter(|row| is_shut(row)).last();
    hides.and_then(|hides| rows.iter().position(|row| row.path == hides.path)).unwrap_or(at)
}

/// The class of a row of some kind in the page's style sheet.
const fn kind_class(kind: RowKind) -> &'static str {
    match kind {
        RowKind::Part => "part",
        RowKind::Virtual => "virtual",
        RowKind::Constraint => "constraint",
        RowKind::Merge => "merge",
        RowKind::Side => "branch",
    }
}

/// No row is laid out as a panel: seen where the page is compiled, since no other program has its style sheet.
const _: () = {
    let style = include_str!("../assets/style.css");
    let kinds =
        [RowKind::Part, RowKind::Virtual, RowKind::Constraint, RowKind::Merge, RowKind::Side];
    let mut at = 0;
    while at < kinds.len() {
        let is_laid_out = has_rule_for(style, kind_class(kinds[at]));
        assert!(!is_laid_out, "the class of a kind of rows is a class of the page's layout");
        at += 1;
    }
    assert!(has_rule_for(style, "side"), "the page's panels are not found in its style sheet");
};

/// Whether a style sheet has a rule for a class, by itself or with what is in it; told while the page is compiled.
const fn has_rule_for(style: &str, class: &str) -> bool {
    let (style, class) = (style.as_bytes(), class.as_bytes());
    let mut line = 0;
    while line + class.len() + 2 < style.len() {
        if style[line] == b'\n' && style[line + 1] == b'.' {
            let mut same = 0;
            while same < class.len() && style[line + 2 + same] == class[same] {
                same += 1;
            }
            if same == class.len() && style[line + 2 + same] == b' ' {
                return true;
            }
        }
        line += 1;
    }
    false
}

#[component]
fn Row(tree: Tree, place: usize, shown: Shown) -> impl IntoView {
    let at = shown.at;
    let lab = tree.lab;
    let row = Memo::new(move |_| lab.structure.with(|rows| rows.get(at).cloned()));
    let of = move |read: fn(&StructureRow) -> String| {
        Memo::new(move |_| row.with(|row| row.as_ref().map(read).unwrap_or_default()))
    };
    let path = of(|row| row.path.clone());
    let kind = of(|row| String::from(kind_class(row.kind)));
    let name = Memo::new(move |_| {
        let title = lab.document.with(|d| d.as_ref().map(|d| d.title.clone()));
        row.with(|row| row.as_ref().map(|row| named(row, title)).unwrap_or_default())
    });
    let detail = of(|row| match row.kind == RowKind::Constraint && is_unnamed(row) {
        true => called(row),
        false => String::from(rule_alone(row)),
    });
    let doc = of(|row| row.doc.clone());
    let state = of(|row| row.freedom.map(words::freedom).map(String::from).unwrap_or_default());
    let value = Memo::new(move |_| {
        let dragged = lab.dragged_values.with(|values| values.get(&at).cloned());
        dragged.or_else(|| row.with(|row| row.as_ref().and_then(|row| row.value.clone())))
    });
    let exact = Memo::new(move |_| row.with(|row| row.as_ref().and_then(|r| r.exact.clone())));
    let merged = Memo::new(move |_| row.with(|r| r.as_ref().and_then(|r| r.merged_with.clone())));
    let depth = Memo::new(move |_| row.with(|row| row.as_ref().map_or(0, |row| row.depth)));
    let open = Memo::new(move |_| {
        row.with(|row| row.as_ref().filter(|r| r.descendants > 0).map(|r| tree.is_open(r)))
    });
    let has_own_path =
        Memo::new(move |_| row.with(|r| r.as_ref().is_some_and(|r| r.kind.has_own_path())));
    let selected = Memo::new(move |_| {
        has_own_path.get()
            && path.with(|path| {
                lab.selected.with(|selected| selected.as_ref() == Some(path))
                    || lab.also.with(|also| also.contains(path))
            })
    });
    let hovered = Memo::new(move |_| {
        let first = merged.get().unwrap_or_else(|| path.get());
        !first.is_empty()
            && has_own_path.get()
            && lab.marked.with(|marked| marked.hovered.as_ref() == Some(&first))
    });
    let lockable = Memo::new(move |_| {
        row.with(|r| r.as_ref().is_some_and(|r| r.kind == RowKind::Part && r.value.is_some()))
    });
    let anchored = Memo::new(move |_| row.with(|row| row.as_ref().is_some_and(|r| r.anchored)));
    let enabled = Memo::new(move |_| row.with(|row| row.as_ref().is_none_or(|r| r.enabled)));
    let unnamed = Memo::new(move |_| row.with(|row| row.as_ref().is_some_and(is_unnamed)));
    let holds = Memo::new(move |_| value.with(|value| value.as_deref() == Some("holds")));
    let toggle = move |e: leptos::ev::MouseEvent| {
        e.stop_propagation();
        if let Some(row) = tree.row(at) {
            tree.toggle(&row);
        }
    };
    view! {
        <div
            id=format!("row-{at}")
            data-path=path
            class=move || format!("row {}", kind.get())
            class:selected=selected
            class:hovered=hovered
            class:off=move || !enabled.get()
            class:unnamed=unnamed
            class:holds=holds
            style:--depth=move || depth.get().to_string()
            style:--place=place.to_string()
            role="treeitem"
            aria-posinset=shown.position.0.to_string()
            aria-setsize=shown.position.1.to_string()
            {..custom_attribute("aria-level", move || (depth.get() + 1).to_string())}
            aria-expanded=move || open.get().map(|open| open.to_string())
            aria-selected=move || selected.get().to_string()
            tabindex=move || if tree.current.get() == at { "0" } else { "-1" }
            title=doc
            on:click=move |e: leptos::ev::MouseEvent| {
                if e.ctrl_key() || e.meta_key() || e.shift_key() || lab.adding.get_untracked() {
                    tree.choose_also(at);
                } else {
                    tree.go_to(at);
                }
            }
            on:dblclick=move |_| {
                if tree.row(at).is_some_and(|row| is_editable(&row)) {
                    tree.editing.set(Some(at));
                }
            }
            on:contextmenu=move |e: leptos::ev::MouseEvent| {
                e.prevent_default();
                if !selected.get_untracked() {
                    tree.go_to(at);
                }
                let is_some = lab.selected.with_untracked(Option::is_some);
                let context = if is_some { Context::Thing } else { Context::Sheet };
                menu::open_at(lab, (f64::from(e.client_x()), f64::from(e.client_y())), context);
            }
            on:pointerenter=move |_| lab.hover(tree.row(at).and_then(thing_of))
            on:keydown=move |e: KeyboardEvent| tree.key(at, &e)
        >
            <button class="twist" tabindex="-1" aria-hidden="true" on:click=toggle
                class:open=move || open.get() == Some(true)
                class:leaf=move || open.get().is_none()>{icons::chevron()}</button>
            <span class="kind" aria-hidden="true">{move || kind_sign(&kind.get())}</span>
            <span class="name">{name}</span>
            <span class="detail">{detail}</span>
            {move || merged.get().map(|first| view! {
                <button class="link" tabindex="-1" title=format!("{} {first}", words::MERGED_WITH)
                    on:click={
                        let first = first.clone();
                        move |e: leptos::ev::MouseEvent| {
                            e.stop_propagation();
                            lab.select(Some(first.clone()));
                        }
                    }>{icons::link()}</button>
            })}
            {move || if tree.editing.get() == Some(at) {
                view! {
                    <field::Edit lab=lab path=path value=exact.get_untracked().unwrap_or_default()
                        done=move || { tree.editing.set(None); tree.focus(at); } />
                }.into_any()
            } else {
                view! { <span class="value">{move || value.get()}</span> }.into_any()
            }}
            <span class=move || format!("state {}", state.get()) title=state>
                <span class="unseen">{state}</span>
            </span>
            {move || kind.with(|kind| kind == "constraint").then(|| view! {
                <button class="switch" role="switch" tabindex="-1"
                    aria-checked=move || enabled.get().to_string()
                    aria-label=move || format!("{} {}", path.get(), words::ENABLED)
                    title=move || if enabled.get() { words::DISABLE } else { words::ENABLE }
                    on:click=move |e: leptos::ev::MouseEvent| {
                        e.stop_propagation();
                        toggle_switch(lab, &path.get_untracked(), !enabled.get_untracked());
                    }></button>
            })}
            {move || lockable.get().then(|| view! { <field::Lock lab=lab path=path anchored=anchored /> })}
        </div>
    }
}

fn kind_sign(kind: &str) -> &'static str {
    match kind {
        "constraint" => "=",
        "merge" => "⋈",
        "branch" => "⤴",
        "virtual" => "ƒ",
        _ => "",
    }
}

/// Switches a constraint on or off.
fn toggle_switch(lab: Lab, path: &str, on: bool) {
    if let Some(path) = session::parse_path(path) {
        lab.apply(&Command::Enable { path, on });
    }
}

/// Locks all of some parts, or lets them go where all are locked.
pub(crate) fn toggle_lock(lab: Lab, paths: &[String]) {
    lab.flush_text();
    lab.list();
    let held = !untrack(|| paths.iter().all(|path| is_locked(lab, path)));
    let others = paths.iter().filter(|path| untrack(|| is_locked(lab, path)) != held);
    let paths: Option<Vec<_>> = others.map(|path| session::parse_path(path)).collect();
    match paths.as_deref() {
        // of one thing it is asked where it could be meant of all of its class
        Some([path]) => _ = lab.apply(&Command::Anchor { path: path.clone(), held }),
        Some(paths) => _ = lab.settle(lab.tell(|session, id| session.hold(id, paths, held))),
        None => {}
    }
}

/// Whether a part is locked.
pub(crate) fn is_locked(lab: Lab, path: &str) -> bool {
    lab.structure.with(|rows| rows.iter().any(|row| row.path == path && row.anchored))
        || lab.values.with(|rows| rows.iter().any(|row| row.path == path && row.anchored))
}
