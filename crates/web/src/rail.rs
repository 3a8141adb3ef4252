//! The rail of tools, and what the hand does with one: it asks the session and shows what that answers.

use crate::actions::{self, ACTIONS, Action, Group};
use crate::annotated::Sizing;
use crate::lab::{Lab, Notice, Zoom};
use crate::{icons, keyboard, words};
use drawing::Bounds;
use leptos::prelude::*;
use presentation::palette::Makeable;
use presentation::typing::{adds, pointed};
use session::view::{Along, Pointer, Refusal, RowKind, ToolView};

/// The library whose things the tools of the rail draw.
const SHEET_LIBRARY: &str = "geometry";

/// The tools, one below the other; those that the document has no classes for say why not.
#[component]
pub fn Rail(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let tools = ACTIONS.iter().filter(|action| action.group == Group::Tool);
    // one stop of Tab: arrows lead from tool to tool
    Effect::new(|_| keyboard::one_stop(RAIL));
    view! {
        <nav class="rail" aria-label=words::TOOLS on:keydown=|e| keyboard::go_in(RAIL, &e)>
            {tools.map(|action| view! { <Button lab=lab action=action /> }).collect_view()}
        </nav>
    }
}

#[component]
fn Button(lab: Lab, action: &'static Action) -> impl IntoView {
    let why = Memo::new(move |_| (action.enabled)(lab).err());
    let is_of = move |class: &str| action.id == format!("tool-{}", class.to_lowercase());
    let drawn = move || {
        lab.drafting
            .prompt
            .with(|p| p.as_ref().map(|p| p.tool.clone()).filter(|tool| !tool.is_empty()))
    };
    let held = Memo::new(move |_| match lab.tool.get().or_else(drawn) {
        Some(tool) => is_of(tool.strip_suffix(BY_CORNERS).unwrap_or(&tool)),
        None if lab.annotated.sizing.get() != Sizing::Off => action.id == "dimension",
        None => action.id == "select",
    });
    let title = move || {
        let says = match why.get() {
            Some(why) => format!("{}: {why}", action.label),
            None => String::from(action.label),
        };
        action.keys.first().map_or(says.clone(), |key| format!("{says} ({key})"))
    };
    view! {
        <button class="tool" data-action=action.id title=title aria-label=action.label
            aria-pressed=move || held.get().to_string()
            aria-disabled=move || why.get().is_some().to_string()
            on:click=move |_| actions::run(action, lab)>
            {icons::of_tool(action.id)}
        </button>
    }
}

/// The rail.
const RAIL: &str = ".rail";

/// What a rectangle is drawn by as a step: from corner to corner, as without a program.
const BY_CORNERS: &str = ".between(first,second)";

/// How far an arrow key moves the pointer of the keyboard, in pixels.
const STEP: f64 = 10.0;

impl Lab {
    /// Takes the tool that places things of a class.
    pub fn take_tool(self, class: &str) {
        self.flush_text();
        if self.takes_step(class) {
            return;
        }
        match self.tell(|session, id| session.take_tool(id, class)) {
            Some(Ok(view)) => {
                // what is drawn must not move under the hand
                self.fits.set_value(false);
                self.notice.set(None);
                self.hover(None);
                self.stop_sizing();
                self.tool.set(Some(String::from(class)));
                self.show_tool(aside(view));
            }
            Some(Err(refusal)) => {
                self.drop_tool();
                self.notice.set(Some(Notice::Refused(refusal)));
            }
            None => {}
        }
    }

    /// While a program is recorded its tools draw steps: begins the construction that a tool is, or says that there is
    /// none. Returns whether a program is recorded.
    fn takes_step(self, class: &str) -> bool {
        let recorded =
            self.ask_of_shown(|session, id| session.recorded(id).map(String::from)).flatten();
        let Some(program) = recorded else { return false };
        let all = self.ask_of_shown(session::Session::constructions).unwrap_or_default();
        let by_corners = format!("{class}{BY_CORNERS}");
        let tool =
            [by_corners.as_str(), class].into_iter().find(|id| all.iter().any(|row| row.id == *id));
        if let Some(tool) = tool {
            self.begin_construction(tool);
        } else {
            let message = words::no_step(class, &program);
            self.notice.set(Some(Notice::Refused(Refusal { message, ..Refusal::default() })));
        }
        true
    }

    fn show_tool(self, view: ToolView) {
        self.typed.update(String::clear);
        self.keyed.set(None);
        self.tool_view.set(view);
    }

    /// Lays the tool down, that for sizes as any other.
    pub fn drop_tool(self) {
        self.stop_sizing();
        self.tell(session::Session::drop_tool);
        self.tool.set(None);
        self.carried.set_value(false);
        self.cursor.set(None);
        self.show_tool(ToolView::default());
    }

    /// Takes the tool again, where something else has changed the document meanwhile.
    pub fn renew_tool(self) {
        if let Some(class) = self.tool.get_untracked()
            && let Some(Ok(view)) = self.tell(|session, id| session.take_tool(id, &class))
        {
            self.show_tool(view);
        }
    }

    /// Escape: ends what goes on, the innermost first; then nothing is selected.
    pub fn escape(self) {
        if self.band.with_untracked(Option::is_some) {
            self.band.set(None);
        } else if self.dragging.with_untracked(Option::is_some) {
            self.cancel();
        } else if self.asks_size() {
            self.end_size();
        } else if self.put_note_back() {
            // the hand holds nothing any longer
        } else if self.stop_job() || self.stop_sweeping() {
            // what else there is, another Esc ends
        } else if self.leave_measure() {
            // what it is for is still asked
        } else if self.drafts() {
            self.draft_end();
        } else if self.tool.with_untracked(Option::is_some) {
            self.escape_tool();
        } else if self.selected.with_untracked(Option::is_none) && self.stop_sizing() {
            // the hand selects again
        } else if self.selected.with_untracked(Option::is_none)
            && self.notice.with_untracked(Option::is_none)
        {
            self.leave_class();
        } else {
            self.select(None);
            self.notice.set(None);
        }
    }

    /// Escape: what was begun is given up; without anything begun the tool is laid down.
    pub fn escape_tool(self) {
        match self.tool.get_untracked() {
            Some(class) if self.tool_view.with_untracked(|view| view.begun) => {
                self.take_tool(&class);
            }
            _ => self.drop_tool(),
        }
    }

    /// The pointer is elsewhere, the tool with it.
    pub fn tool_moved(self, pointer: &Pointer) {
        if let Some(Some(view)) = self.tell(|session, id| session.tool_moved(id, pointer)) {
            self.tool_view.set(view);
        }
    }

    /// Takes away the preview of a tool that has begun nothing, or that shows what the pointer has caught, until the
    /// pointer comes again.
    pub fn put_aside(self) {
        let is_over = self.tool_view.with_untracked(|view| view.caught.is_some() || !view.begun);
        if is_over && self.tool.with_untracked(Option::is_some) {
            self.tool_view.update(|view| *view = aside(std::mem::take(view)));
        }
    }

    /// The tool sets what it is about to set; with the last place the thing is made, and the tool goes on.
    pub fn tool_set(self, pointer: &Pointer) {
        let view = match self.tell(|session, id| session.tool_set(id, pointer)) {
            Some(Ok(view)) => view,
            Some(Err(refusal)) => {
                self.notice.set(Some(Notice::Refused(refusal)));
                return;
            }
            None => return,
        };
        let Some(command) = view.command.clone() else {
            self.show_tool(view);
            return;
        };
        let class = self.tool.get_untracked();
        self.tool.set(None);
        let made = self.apply_as_meant(&command);
        self.tool.set(class.clone());
        if !made {
            self.renew_tool();
            return;
        }
        if pointer.length.is_some() {
            self.look_at_size();
        }
        self.select(Some(view.makes.clone()));
        if class.as_deref() == Some("Caption") {
            // what it says is typed at once
            self.drop_tool();
            let at = self.view.with_untracked(|v| {
                v.screen_from_sheet(drawing::Point { x: pointer.at.0, y: pointer.at.1 })
            });
            self.edit_in_place(&view.makes, None, at);
            return;
        }
        match self.tell(session::Session::take_tool_again) {
            Some(Some(view)) => self.show_tool(aside(view)),
            _ => self.drop_tool(),
        }
    }

    /// What a key does while a tool is held and the picture has the keyboard; returns whether it does anything.
    pub fn tool_key(self, key: &str, far: bool, size: (f64, f64)) -> bool {
        if self.tool.with_untracked(Option::is_none) {
            return false;
        }
        let step = if far { 1.0 } else { STEP };
        let by = match key {
            "ArrowLeft" => (-step, 0.0),
            "ArrowRight" => (step, 0.0),
            "ArrowUp" => (0.0, -step),
            "ArrowDown" => (0.0, step),
            "Enter" => {
                let pointer = self.keyboard_pointer(size);
                let told = self.typed.with_untracked(|typed| pointed(typed, pointer));
                match told {
                    Some(pointer) => {
                        self.set_cursor(pointer.at);
                        self.tool_set(&pointer);
                        // a place that was typed may lie anywhere
                        if pointer.is_typed {
                            let p = drawing::Point { x: pointer.at.0, y: pointer.at.1 };
                            let all = self.drawn_box().map_or(Bounds::at(p), |drawn| drawn.with(p));
                            self.zoom.set(Some(Zoom::Over(all)));
                        }
                    }
                    None => self.say_refused(self.typed.with_untracked(|t| words::no_length(t))),
                }
                return true;
            }
            "Tab" => {
                let along = if far { Along::Back } else { Along::Next };
                // before keys or a pointer have been anywhere it begins with the first
                let is_nowhere = self.cursor.with_untracked(Option::is_none);
                let nowhere = || self.pointer_at((-1e6, -1e6), 12.0, false);
                let pointer = if is_nowhere { nowhere() } else { self.keyboard_pointer(size) };
                let stop = self.ask_of_shown(|session, id| session.tool_stop(id, &pointer, along));
                let Some(at) = stop.flatten() else { return false };
                self.set_cursor(at);
                self.follow_keys(size);
                return true;
            }
            "Backspace" => {
                self.typed.update(|typed| {
                    let _ = typed.pop();
                });
                self.follow_typed(size);
                return true;
            }
            one if self.typed.with_untracked(|typed| adds(typed, one)) => {
                self.typed.update(|typed| typed.push_str(one));
                self.follow_typed(size);
                return true;
            }
            _ => return false,
        };
        let at = self.cursor.get_untracked().unwrap_or((size.0 / 2.0, size.1 / 2.0));
        self.cursor.set(Some((at.0 + by.0, at.1 + by.1)));
        self.follow_keys(size);
        true
    }

    /// The tool follows the pointer of the keyboard.
    fn follow_keys(self, size: (f64, f64)) {
        let pointer = self.keyboard_pointer(size);
        self.tool_moved(&pointer);
        self.keyed.set(Some(pointer.at));
    }

    /// The tool shows what would come of what is typed, where that is something.
    fn follow_typed(self, size: (f64, f64)) {
        let told = self.typed.with_untracked(|t| pointed(t, self.keyboard_pointer(size)));
        told.inspect(|pointer| self.tool_moved(pointer));
    }

    /// Brings the pointer of the keyboard to a place of the sheet.
    fn set_cursor(self, (x, y): (f64, f64)) {
        let at = self.view.with_untracked(|v| v.screen_from_sheet(drawing::Point { x, y }));
        self.cursor.set(Some(at));
    }

    /// Keeps the pointer of the keyboard where it was on the sheet, since the view was another.
    pub fn keep_cursor(self, before: crate::sheet::View) {
        if let Some(at) = self.cursor.get_untracked() {
            let place = before.sheet_from_screen(at);
            self.set_cursor((place.x, place.y));
        }
    }

    /// The pointer of the keyboard: where the arrow keys, or the mouse, have brought it.
    fn keyboard_pointer(self, size: (f64, f64)) -> Pointer {
        let at = self.cursor.get_untracked().unwrap_or((size.0 / 2.0, size.1 / 2.0));
        Pointer { seen: self.in_sight(size), ..self.pointer_at(at, 12.0, false) }
    }

    /// A pointer at a place of the canvas, which finds what is so many pixels from it.
    pub fn pointer_at(self, at: (f64, f64), reach: f64, alone: bool) -> Pointer {
        self.view.with_untracked(|view| {
            let p = view.sheet_from_screen(at);
            let decimals = view.decimals();
            let round = |x: f64| base::number::rounded(x, decimals).parse().unwrap_or(x);
            let at = (round(p.x), round(p.y));
            Pointer {
                at,
                reach: reach / view.scale,
                alone,
                grid: view.tidy(),
                ..Pointer::default()
            }
        })
    }

    /// Two opposite corners of what a canvas of a size shows, on the sheet.
    pub fn in_sight(self, (width, height): (f64, f64)) -> Option<[(f64, f64); 2]> {
        let corner = |at| {
            let p = self.view.with_untracked(|view| view.sheet_from_screen(at));
            (p.x, p.y)
        };
        (width > 0.0).then(|| [corner((0.0, 0.0)), corner((width, height))])
    }

    /// Inserts a thing of a class where there is room.
    pub fn insert(self, class: &str) {
        self.flush_text();
        let Some(id) = self.id() else { return };
        match self.ask(|session| session.insertion(id, class)) {
            Ok(command) => {
                // the first part of a sheet is as large as it is placed by the pointer
                self.fits.set_value(false);
                self.list();
                let before = self.structure.with_untracked(Vec::len);
                self.apply_as_meant(&command);
                self.list();
                self.zoom.set(Some(Zoom::Within));
                let made = self.structure.with_untracked(|rows| {
                    let mut own =
                        rows.iter().filter(|row| row.depth == 1 && row.kind == RowKind::Part);
                    own.next_back().map(|row| row.path.clone()).filter(|_| rows.len() > before)
                });
                self.select(made);
            }
            Err(refusal) => self.notice.set(Some(Notice::Refused(refusal))),
        }
    }

    /// Does something with a class; the document uses its library from then on. Returns whether it does.
    pub fn with_library(self, one: &Makeable, act: fn(Self, &str)) -> bool {
        let is_used = one.unused.as_ref().is_none_or(|library| self.use_library(library));
        if is_used {
            act(self, &one.class);
        }
        is_used
    }

    /// Takes the tool that draws things of a class; a file in which nothing stands yet becomes a new sheet.
    pub fn draw_with(self, class: &str) {
        let is_blank = self.text.with_untracked(|text| text.source.trim().is_empty());
        if !is_blank || self.use_library(SHEET_LIBRARY) {
            self.take_tool(class);
        }
    }

    /// Has the document use a library; returns whether it does.
    pub fn use_library(self, name: &str) -> bool {
        self.flush_text();
        let Some(id) = self.id() else { return false };
        let command = self.ask(|session| session.using(id, name));
        let is_used = self.apply_as_meant(&command);
        if is_used {
            let shelves = document().query_selector(".bin .scroll").ok().flatten();
            shelves.inspect(|shelves| shelves.set_scroll_top(0));
        }
        is_used
    }
}

/// A tool that nobody sees yet: where its thing would lie is known once the pointer comes.
fn aside(view: ToolView) -> ToolView {
    ToolView { preview: drawing::Drawing::default(), caught: None, ..view }
}
