//! The hand on the picture: mouse, pen, one finger or two.
//!
//! A press does nothing until the pointer moves; then it drags what was under it, or the sheet.

use super::sheet_point;
use crate::actions::Context;
use crate::js;
use crate::keyboard;
use crate::lab::Lab;
use crate::menu;
use crate::sheet::View;
use drawing::Point;
use leptos::ev::{MouseEvent, PointerEvent};
use leptos::html::Canvas;
use leptos::prelude::*;
use presentation::annotations::Note;
use presentation::band::{Take, banded};
use presentation::paths::covers;
use presentation::pick::{pick, pick_word};
use session::view::{Caught, Grip, PictureView, Pointer};
use std::time::Duration;

/// How near a grip the pointer must be, in pixels: a mouse's, a finger's.
const REACH: (f64, f64) = (10.0, 24.0);
/// How near a grip under words the pointer must be, in pixels: about as large as it is drawn.
const GRIP: f64 = 5.0;
/// How far a pressed pointer moves before it drags, in pixels.
const STIR: f64 = 2.0;
/// How far a pressed tool moves before letting go sets its next place, in pixels.
const PULL: f64 = 8.0;

/// Whether the space bar, which makes every press a pan, is held down.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Space {
    Down,
    Up,
}

#[derive(Clone, PartialEq, Debug)]
enum Mode {
    /// Nothing is pressed.
    Idle,
    /// A thing is pressed that may be dragged; with it all that is selected with it, or else it is selected alone.
    Pressed { path: String, start: (f64, f64) },
    /// A thing is dragged; the pointer is this far from it, on the sheet, and it was last to go there.
    Drag { offset: (f64, f64), wish: Option<(f64, f64)> },
    /// The sheet is dragged.
    Pan { last: (f64, f64) },
    /// A tool has set something where the pointer was pressed, or a construction has taken what is there.
    Tool { start: (f64, f64) },
    /// A finger with a tool, or for a construction: nothing is set until it moves or is let go, as it may be the first
    /// of two.
    Finger { start: (f64, f64) },
    /// What lies there is to have a size, once it is let go: it may be the first of two fingers. The place is on the
    /// canvas and in the window.
    Size { start: (f64, f64), clicked: (f64, f64) },
    /// A rubber band is drawn for a program's loop.
    Band { start: (f64, f64) },
    /// A band is drawn over what is to be selected, besides what is selected already.
    Select { start: (f64, f64), besides: Vec<String> },
    /// What a constraint says is pressed, and moved with the hand: by its key.
    Note { key: String, last: (f64, f64), is_moved: bool },
    /// Two fingers: their middle and their distance.
    Pinch { middle: (f64, f64), distance: f64 },
}

#[derive(Debug)]
struct State {
    mode: Mode,
    pointers: Vec<(i32, (f64, f64))>,
    /// The latest position that no frame has taken up yet.
    latest: Option<(f64, f64)>,
    space: Space,
    /// Where the grips were when a drag was pressed.
    rest: Vec<(String, (f64, f64))>,
    /// Whether guides and joints are wanted: Shift suppresses those of a tool, Alt those of a drag.
    shift: bool,
    alt: bool,
    /// How many fingers have come down so far.
    presses: u32,
    /// Which of them lies still, and where.
    still: Option<(u32, (f64, f64))>,
}

/// A handle to the hand.
#[derive(Clone, Copy)]
pub(super) struct Hand {
    lab: Lab,
    canvas: NodeRef<Canvas>,
    state: StoredValue<State>,
}

/// Returns where a client position lies on the canvas.
pub(super) fn on_canvas(canvas: NodeRef<Canvas>, (x, y): (f64, f64)) -> (f64, f64) {
    let Some(canvas) = canvas.get_untracked() else { return (x, y) };
    let rect = canvas.get_bounding_client_rect();
    (x - rect.left(), y - rect.top())
}

fn distance(a: (f64, f64), b: (f64, f64)) -> f64 {
    ((a.0 - b.0) * (a.0 - b.0) + (a.1 - b.1) * (a.1 - b.1)).sqrt()
}

impl Hand {
    pub(super) fn new(lab: Lab, canvas: NodeRef<Canvas>) -> Self {
        let state = State {
            mode: Mode::Idle,
            pointers: Vec::new(),
            latest: None,
            space: Space::Up,
            rest: Vec::new(),
            shift: false,
            alt: false,
            presses: 0,
            still: None,
        };
        Self { lab, canvas, state: StoredValue::new(state) }
    }

    pub(super) fn hold_space(self, space: Space) {
        self.state.update_value(|state| state.space = space);
    }

    fn at(self, e: &PointerEvent) -> (f64, f64) {
        on_canvas(self.canvas, (f64::from(e.client_x()), f64::from(e.client_y())))
    }

    fn mode(self) -> Mode {
        self.state.with_value(|state| state.mode.clone())
    }

    fn set_mode(self, mode: Mode) {
        self.state.update_value(|state| state.mode = mode);
    }

    fn pick(self, at: (f64, f64)) -> Option<String> {
        self.pick_in(at, None)
    }

    /// Picks what a press chooses where something is chosen already.
    fn pick_deeper(self, at: (f64, f64)) -> Option<String> {
        self.pick_in(at, self.lab.selected.get_untracked().as_deref())
    }

    /// Picks what is chosen besides something: beside a figure of one thing that of another, not all of it.
    fn pick_beside(self, at: (f64, f64)) -> Option<String> {
        let chosen = self.lab.selected.get_untracked();
        let is_figure = self.lab.picture.with_untracked(|picture| {
            let mut drawn = picture.paths.iter().zip(&picture.drawn_by);
            drawn.any(|(path, whole)| whole.is_some() && chosen.as_ref() == Some(path))
        });
        match self.pick(at).filter(|_| is_figure) {
            Some(whole) => self.pick_in(at, Some(&whole)),
            None => self.pick_deeper(at),
        }
    }

    /// How far from a thing it is still meant, in pixels.
    fn reach(self) -> f64 {
        if self.lab.touch.get_untracked() { REACH.1 } else { REACH.0 }
    }

    fn pick_in(self, at: (f64, f64), chosen: Option<&str>) -> Option<String> {
        if let Some(note) = self.note_at(at) {
            return Some(note.path);
        }
        let reach = self.reach();
        let view = self.lab.view.get_untracked();
        self.lab.picture.with_untracked(|picture| pick(picture, &view, at, (reach, chosen)))
    }

    /// The note whose words are at a place on the canvas; a grip under them is taken all the same.
    fn note_at(self, at: (f64, f64)) -> Option<Note> {
        let note = self.lab.note_at(at)?;
        let view = self.lab.view.get_untracked();
        let is_at = |x, y| distance(view.screen_from_sheet(Point { x, y }), at) <= GRIP;
        let is_gripped =
            |picture: &PictureView| picture.grips.iter().any(|grip| is_at(grip.x, grip.y));
        let is_gripped = self.lab.picture.with_untracked(is_gripped);
        (!is_gripped).then_some(note)
    }

    pub(super) fn down(self, e: &PointerEvent) {
        let at = self.at(e);
        self.lab.pressed.set_value(true);
        if let Some(canvas) = self.canvas.get_untracked() {
            js::capture(&canvas, e.pointer_id());
        }
        if e.button() == 1 {
            e.prevent_default();
        }
        self.state.update_value(|state| {
            (state.shift, state.alt) = (e.shift_key(), e.alt_key());
            state.pointers.retain(|(id, _)| *id != e.pointer_id());
            state.pointers.push((e.pointer_id(), at));
        });
        if e.pointer_type() == "touch" {
            self.wait_for_menu(e, at);
        }
        // a pen has no keys either
        self.lab.touched(e.pointer_type() != "mouse");
        let space = self.state.with_value(|state| state.space);
        if let Some(pinch) = self.pinch() {
            if let Mode::Drag { .. } = self.mode() {
                self.lab.cancel();
            }
            self.lab.put_note_back();
            self.set_mode(pinch);
        } else if e.button() == 1 || (e.button() == 0 && space == Space::Down) {
            self.set_mode(Mode::Pan { last: at });
        } else if e.button() == 0 && self.lab.takes_band() {
            if self.lab.drafts() {
                // The keyboard stays with what is typed.
                e.prevent_default();
            }
            self.set_mode(Mode::Band { start: at });
        } else if e.button() == 0 && self.lab.drafting.seeking.get_untracked() {
            self.lab.visit_picked(&self.pointer(at));
            e.prevent_default();
            self.set_mode(Mode::Idle);
        } else if e.button() == 0 && self.has_tool() && e.pointer_type() == "touch" {
            if self.lab.drafts() {
                // The keyboard stays with what is typed.
                e.prevent_default();
            }
            self.set_mode(Mode::Finger { start: at });
        } else if e.button() == 0 && self.lab.drafts() {
            self.lab.draft_point(&self.pointer(at));
            // The keyboard stays with what is typed.
            e.prevent_default();
            let goes_on = self.lab.wants_another_pick();
            self.set_mode(if goes_on { Mode::Tool { start: at } } else { Mode::Idle });
        } else if e.button() == 0 && self.lab.tool.with_untracked(Option::is_some) {
            self.lab.tool_set(&self.pointer(at));
            self.set_mode(Mode::Tool { start: at });
        } else if e.button() == 0 && self.lab.attachers.with_untracked(Option::is_some) {
            self.pick(at).inspect(|path| self.lab.toggle_attacher(path));
            self.set_mode(Mode::Idle);
        } else if e.button() == 0 && self.lab.is_sizing() {
            // what is asked for has the keyboard
            e.prevent_default();
            let clicked = (f64::from(e.client_x()), f64::from(e.client_y()));
            self.set_mode(Mode::Size { start: at, clicked });
        } else if e.button() == 0 && !self.lab.settle_size() {
            // it is said why; it is still asked
            e.prevent_default();
            self.set_mode(Mode::Idle);
        } else if e.button() == 0
            && (e.ctrl_key() || e.meta_key() || e.shift_key())
            && self.lab.take_of_set_at(&self.lab.pointer_at(at, self.reach(), true))
        {
            self.set_mode(Mode::Idle);
        } else if e.button() == 0 {
            let adding = self.lab.adding.get_untracked();
            let besides = e.ctrl_key() || e.meta_key() || e.shift_key() || adding;
            let picked = if besides { self.pick_beside(at) } else { self.pick_deeper(at) };
            if picked.is_none() {
                self.lab.adding.set(false);
            }
            if besides {
                if let Some(path) = &picked {
                    self.lab.select_also(path);
                }
            } else if picked.as_ref().is_none_or(|path| self.together(path).is_none()) {
                self.lab.select(picked.clone());
            }
            self.set_mode(match (self.note_at(at), picked) {
                (Some(Note { key, .. }), _) => Mode::Note { key, last: at, is_moved: false },
                (None, Some(path)) => Mode::Pressed { path, start: at },
                // a finger moves the sheet
                (None, None) if e.pointer_type() == "touch" => Mode::Pan { last: at },
                (None, None) => Mode::Select { start: at, besides: self.lab.selection_untracked() },
            });
        }
    }

    /// Whether a press sets something: by a tool, or for a construction.
    fn has_tool(self) -> bool {
        self.lab.drafts() || self.lab.tool.with_untracked(Option::is_some)
    }

    /// Sets what a finger was to set that came down at a place; returns what it does from there on.
    fn set_by_finger(self, start: (f64, f64)) -> Mode {
        if !self.lab.drafts() {
            self.lab.tool_set(&self.pointer(start));
            return Mode::Tool { start };
        }
        self.lab.draft_point(&self.pointer(start));
        if self.lab.wants_another_pick() { Mode::Tool { start } } else { Mode::Idle }
    }

    /// Opens the editor of what was clicked twice: of the value that a word shows, or of the thing's own.
    pub(super) fn edit(self, e: &MouseEvent) {
        if self.lab.tool.with_untracked(Option::is_some) {
            return;
        }
        let at = on_canvas(self.canvas, (f64::from(e.client_x()), f64::from(e.client_y())));
        if let Some(note) = self.note_at(at) {
            if let Some(offer) = untrack(|| self.lab.typed_by(&note.path)) {
                self.lab.take_offer(&offer);
            }
            return;
        }
        let view = self.lab.view.get_untracked();
        let word = self.lab.picture.with_untracked(|picture| pick_word(picture, &view, at));
        match word {
            Some((path, word)) => self.lab.edit_in_place(&path, Some(&word), at),
            None => {
                if let Some(path) = self.pick(at) {
                    self.lab.edit_in_place(&path, None, at);
                }
            }
        }
    }

    /// The pointer as a tool takes it.
    fn pointer(self, at: (f64, f64)) -> Pointer {
        let alone = self.state.with_value(|state| state.shift);
        self.lab.cursor.set(Some(at));
        keyboard::follow_pointer(self.lab);
        if self.lab.keyed.with_untracked(Option::is_some) {
            self.lab.keyed.set(None);
        }
        let size = self.canvas.get_untracked().map(|canvas| canvas.get_bounding_client_rect());
        let size = size.map(|rect| (rect.width(), rect.height())).unwrap_or_default();
        let seen = self.lab.in_sight(size);
        Pointer { seen, ..self.lab.pointer_at(at, self.reach(), alone) }
    }

    /// Opens the menu of what lies under the pointer, and selects it; of a tool's hand it is laid down.
    pub(super) fn menu(self, e: &MouseEvent) {
        e.prevent_default();
        if self.lab.tool.with_untracked(Option::is_some) {
            self.lab.drop_tool();
            return;
        }
        self.open_menu((f64::from(e.client_x()), f64::from(e.client_y())));
    }

    /// Opens the menu once a finger has lain still for a while: not every browser makes a press of the second button
    /// of that.
    fn wait_for_menu(self, e: &PointerEvent, start: (f64, f64)) {
        /// Longer than browsers wait that do.
        const STILL: Duration = Duration::from_millis(700);
        let place = (f64::from(e.client_x()), f64::from(e.client_y()));
        let still = self.state.try_update_value(|state| {
            state.presses += 1;
            // of two fingers none asks for the menu, nor does the one that stays
            state.still = (state.pointers.len() == 1).then_some((state.presses, start));
            state.still
        });
        let open = move || {
            let is_still = self.state.try_with_value(|state| {
                let is_held = matches!(
                    state.mode,
                    Mode::Pressed { .. } | Mode::Pan { .. } | Mode::Note { is_moved: false, .. }
                );
                is_held && state.pointers.len() == 1 && Some(state.still) == still
            });
            if still.flatten().is_some() && is_still == Some(true) {
                self.open_menu(place);
            }
        };
        set_timeout(open, STILL);
    }

    /// Opens the menu of what lies at a place of the window.
    fn open_menu(self, place: (f64, f64)) {
        if self.lab.dragging.with_untracked(Option::is_some) {
            self.lab.cancel();
        }
        let picked = self.pick(on_canvas(self.canvas, place));
        let selection = self.lab.selection_untracked();
        if let Some(path) = &picked
            && !selection.contains(path)
        {
            self.lab.select(picked.clone());
        }
        let context = if picked.is_some() { Context::Thing } else { Context::Sheet };
        menu::open_at(self.lab, place, context);
        self.state.update_value(|state| {
            state.pointers.clear();
            state.mode = Mode::Idle;
        });
    }

    /// Returns what two fingers do, if there are two.
    fn pinch(self) -> Option<Mode> {
        self.state.with_value(|state| match state.pointers[..] {
            [(_, a), (_, b), ..] => Some(Mode::Pinch {
                middle: (f64::midpoint(a.0, b.0), f64::midpoint(a.1, b.1)),
                distance: distance(a, b).max(1.0),
            }),
            [] | [_] => None,
        })
    }

    pub(super) fn moved(self, e: &PointerEvent) {
        let at = self.at(e);
        let waiting = self.state.try_update_value(|state| {
            if let Some(pointer) = state.pointers.iter_mut().find(|(id, _)| *id == e.pointer_id()) {
                pointer.1 = at;
            }
            // one that has gone away and come back has not lain still
            state.still = state.still.filter(|(_, start)| distance(at, *start) < PULL);
            (state.shift, state.alt) = (e.shift_key(), e.alt_key());
            state.latest.replace(at).is_some()
        });
        if waiting == Some(false) {
            request_animation_frame(move || self.frame());
        }
    }

    /// Does what the latest position asks for.
    fn frame(self) {
        let latest = self.state.try_update_value(|state| state.latest.take());
        let Some(at) = latest.flatten() else { return };
        match self.mode() {
            Mode::Idle | Mode::Tool { .. } if self.lab.tool.with_untracked(Option::is_some) => {
                self.lab.tool_moved(&self.pointer(at));
            }
            Mode::Idle | Mode::Tool { .. } if self.lab.drafts() => {
                self.lab.draft_hover(&self.pointer(at));
            }
            Mode::Tool { .. } | Mode::Size { .. } => {}
            // Escape may have laid the tool down already.
            Mode::Finger { start } if distance(at, start) > PULL && self.has_tool() => {
                let mode = self.set_by_finger(start);
                self.set_mode(mode);
                self.state.update_value(|state| state.latest = Some(at));
                self.frame();
            }
            Mode::Finger { .. } => {}
            Mode::Idle => self.lab.hover(self.pick_deeper(at)),
            Mode::Pressed { path, start } => {
                if distance(at, start) >= STIR {
                    self.begin_drag(&path, start);
                    // how it moves was planned: the first move is work enough for another frame
                    self.state.update_value(|state| state.latest = Some(at));
                    request_animation_frame(move || self.frame());
                }
            }
            Mode::Drag { .. } => self.drag_to(at),
            Mode::Note { is_moved: false, last, .. } if distance(at, last) < STIR => {}
            Mode::Note { key, last, is_moved } => {
                if !is_moved {
                    self.lab.take_note();
                }
                // Escape may have put it back already.
                if self.lab.holds_note() {
                    self.lab.move_note(&key, (at.0 - last.0, at.1 - last.1));
                }
                self.set_mode(Mode::Note { key, last: at, is_moved: true });
            }
            Mode::Band { start } => self.lab.show_band(start, at),
            Mode::Select { start, .. } => {
                if distance(start, at) >= STIR {
                    self.lab.band.set(Some([start, at]));
                }
            }
            Mode::Pan { last } => {
                self.lab.look_at(|view| view.panned(at.0 - last.0, at.1 - last.1));
                self.set_mode(Mode::Pan { last: at });
            }
            Mode::Pinch { middle, distance } => {
                let Some(Mode::Pinch { middle: m, distance: d }) = self.pinch() else { return };
                self.lab.look_at(|view| {
                    view.panned(m.0 - middle.0, m.1 - middle.1).zoomed(d / distance, m)
                });
                self.set_mode(Mode::Pinch { middle: m, distance: d });
            }
        }
    }

    fn begin_drag(self, path: &str, start: (f64, f64)) {
        let several = self.together(path);
        let paths = several.unwrap_or_else(|| vec![String::from(path)]);
        let Some(handle) = self.lab.press_at(&paths, &self.pointer(start)) else {
            self.set_mode(Mode::Pan { last: start });
            return;
        };
        let rest = self.lab.picture.with_untracked(|picture| {
            picture.grips.iter().map(|grip| (grip.path.clone(), (grip.x, grip.y))).collect()
        });
        self.state.update_value(|state| state.rest = rest);
        let p = sheet_point(self.lab, start);
        let offset = (handle.0 - p.x, handle.1 - p.y);
        self.set_mode(Mode::Drag { offset, wish: None });
    }

    /// Returns what moves with a thing: all that is selected, where it is of several that are, itself first.
    fn together(self, path: &str) -> Option<Vec<String>> {
        let mut selection = self.lab.selection_untracked();
        let own = selection.iter().position(|whole| covers(whole, path))?;
        if selection.len() < 2 {
            return None;
        }
        selection.swap(0, own);
        Some(selection)
    }

    /// Selects what lies in a band.
    fn take(self, start: (f64, f64), at: (f64, f64), besides: Vec<String>) {
        let corners = (sheet_point(self.lab, start), sheet_point(self.lab, at));
        let take = if at.0 < start.0 { Take::Crossed } else { Take::Within };
        let found = self.lab.picture.with_untracked(|picture| banded(picture, corners, take));
        let new = found.into_iter().filter(|path| !besides.contains(path)).collect::<Vec<_>>();
        self.lab.select_all(&[besides, new].concat());
    }

    fn drag_to(self, at: (f64, f64)) {
        let Mode::Drag { offset, wish } = self.mode() else { return };
        if let Some(came) = self.lab.dragging.get_untracked() {
            let p = sheet_point(self.lab, at);
            let decimals = self.lab.view.with_untracked(View::decimals);
            let round = |x: f64| base::number::rounded(x, decimals).parse().unwrap_or(x);
            let to = (round(p.x + offset.0), round(p.y + offset.1));
            self.lab.look_for_joint(&self.near(to));
            let joint = self.lab.dropping.with_untracked(|d| d.as_ref().map(|(_, c)| c.at));
            let now = joint.unwrap_or(to);
            // what is there already, as while another has caught it, has no further to go; a long way goes on
            let goes_on = !came.reached && came.limit.is_none();
            if goes_on || wish != Some(now) {
                self.set_mode(Mode::Drag { offset, wish: Some(now) });
                self.lab.drag(now);
            }
        }
    }

    /// The places near one that is dragged, nearest first; none while Alt is held, or where a whole is dragged. What moves
    /// along is none.
    fn near(self, (x, y): (f64, f64)) -> Vec<Caught> {
        let alt = self.state.with_value(|state| state.alt);
        let pixel = 1.0 / self.lab.view.with_untracked(|view| view.scale);
        let reach = self.reach() * pixel;
        let dragged = self.lab.selected.get_untracked().unwrap_or_default();
        let is_single = self.lab.also.with_untracked(Vec::is_empty);
        self.lab.picture.with_untracked(|picture| {
            let is_place = picture.grips.iter().any(|grip| grip.path == dragged);
            if !is_place || alt || !is_single {
                return Vec::new();
            }
            // few are near: only of these it is looked up where they were
            let far = |grip: &Grip| distance((grip.x, grip.y), (x, y));
            let mut near: Vec<(f64, Caught)> = { &picture.grips }
                .iter()
                .filter(|grip| far(grip) <= reach && grip.path != dragged)
                .filter(|grip| {
                    self.state.with_value(|state| {
                        let was = state.rest.iter().find(|(path, _)| *path == grip.path);
                        was.is_none_or(|(_, was)| distance(*was, (grip.x, grip.y)) <= pixel)
                    })
                })
                .map(|g| (far(g), Caught { at: (g.x, g.y), word: g.path.clone() }))
                .collect();
            near.sort_by(|a, b| a.0.total_cmp(&b.0));
            near.into_iter().map(|(_, caught)| caught).collect()
        })
    }

    pub(super) fn up(self, e: &PointerEvent) {
        let at = self.at(e);
        self.lab.pressed.set_value(false);
        if self.lab.carried.get_value() && self.mode() == Mode::Idle {
            self.lab.carried.set_value(false);
            self.lab.tool_set(&self.pointer(at));
        }
        self.state.update_value(|state| state.latest = Some(at));
        self.frame();
        // a drag that began just now
        self.frame();
        let mode = self.mode();
        self.let_go(e);
        if e.pointer_type() == "touch" {
            // a finger that has gone is nowhere
            self.lab.put_aside();
        }
        match mode {
            // what is pressed, dragged and let go is set at both ends
            Mode::Tool { start } if distance(start, at) > PULL && self.lab.drafts() => {
                self.lab.draft_point(&self.pointer(at));
            }
            // Escape may have laid the tool down already.
            Mode::Tool { start }
                if distance(start, at) > PULL && self.lab.tool.with_untracked(Option::is_some) =>
            {
                self.lab.tool_set(&self.pointer(at));
            }
            Mode::Finger { start } if self.has_tool() => drop(self.set_by_finger(start)),
            // Escape may have laid the tool down already.
            Mode::Size { start, clicked } if self.lab.is_sizing() => {
                let picked = match self.lab.selected.with_untracked(Option::is_some) {
                    true => self.pick_beside(start),
                    false => self.pick_deeper(start),
                };
                self.lab.size_picked((picked, Some(clicked)), e.shift_key());
            }
            Mode::Band { start } if distance(start, at) > PULL => self.lab.take_band(start, at),
            Mode::Band { start } if self.lab.drafts() => self.lab.draft_point(&self.pointer(start)),
            // Escape may have ended the band already.
            Mode::Select { start, besides } if self.lab.band.with_untracked(Option::is_some) => {
                self.lab.band.set(None);
                self.take(start, at, besides);
            }
            Mode::Pressed { path, .. }
                if !(e.shift_key()
                    || e.ctrl_key()
                    || e.meta_key()
                    || self.lab.adding.get_untracked()) =>
            {
                self.lab.select(Some(path));
            }
            Mode::Note { .. } => self.lab.drop_note(),
            // Escape may have ended the drag already.
            Mode::Drag { .. } if self.lab.dragging.with_untracked(Option::is_some) => {
                match self.lab.dropping.get_untracked() {
                    Some((target, _)) => self.lab.release_onto(&target),
                    None => self.lab.release(),
                }
            }
            _ => {}
        }
    }

    pub(super) fn lost(self, e: &PointerEvent) {
        let dragged = matches!(self.mode(), Mode::Drag { .. });
        self.lab.pressed.set_value(false);
        self.lab.put_note_back();
        self.lab.band.set(None);
        self.let_go(e);
        if dragged {
            self.lab.cancel();
        }
    }

    /// The pointer is gone; another finger that is still there goes on panning.
    fn let_go(self, e: &PointerEvent) {
        self.state.update_value(|state| {
            state.latest = None;
            state.pointers.retain(|(id, _)| *id != e.pointer_id());
            state.mode = match state.pointers.first() {
                Some((_, last)) => Mode::Pan { last: *last },
                None => Mode::Idle,
            };
        });
    }

    /// The pointer has left the canvas.
    pub(super) fn left(self) {
        if self.mode() == Mode::Idle {
            self.lab.hover(None);
        }
    }
}
