//! The hand on the picture: mouse, pen, one finger or two.
//!
//! A press does nothing until the pointer moves; then it drags what was under it, or the sheet.

use super::pick::pick;
use super::sheet_point;
use crate::js;
use crate::lab::Lab;
use crate::sheet::View;
use leptos::ev::PointerEvent;
use leptos::html::Canvas;
use leptos::prelude::*;

/// How near a grip the pointer must be, in pixels: a mouse's, a finger's.
const REACH: (f64, f64) = (10.0, 24.0);
/// How far a pressed pointer moves before it drags, in pixels.
const STIR: f64 = 2.0;

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
    /// A thing is pressed that may be dragged.
    Pressed { path: String, start: (f64, f64) },
    /// A thing is dragged; the pointer is this far from it, on the sheet.
    Drag { offset: (f64, f64) },
    /// The sheet is dragged.
    Pan { last: (f64, f64) },
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
    touch: bool,
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
            touch: js::coarse(),
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
        let reach = if self.state.with_value(|s| s.touch) { REACH.1 } else { REACH.0 };
        let view = self.lab.view.get_untracked();
        self.lab.picture.with_untracked(|picture| pick(picture, &view, at, reach))
    }

    pub(super) fn down(self, e: &PointerEvent) {
        let at = self.at(e);
        if let Some(canvas) = self.canvas.get_untracked() {
            js::capture(&canvas, e.pointer_id());
        }
        if e.button() == 1 {
            e.prevent_default();
        }
        self.state.update_value(|state| {
            state.touch = e.pointer_type() == "touch";
            state.pointers.retain(|(id, _)| *id != e.pointer_id());
            state.pointers.push((e.pointer_id(), at));
        });
        let space = self.state.with_value(|state| state.space);
        if let Some(pinch) = self.pinch() {
            if let Mode::Drag { .. } = self.mode() {
                self.lab.cancel();
            }
            self.set_mode(pinch);
        } else if e.button() == 1 || (e.button() == 0 && space == Space::Down) {
            self.set_mode(Mode::Pan { last: at });
        } else if e.button() == 0 {
            let picked = self.pick(at);
            if e.ctrl_key() || e.meta_key() || e.shift_key() {
                if let Some(path) = &picked {
                    self.lab.select_also(path);
                }
            } else {
                self.lab.select(picked.clone());
            }
            self.set_mode(match picked {
                Some(path) => Mode::Pressed { path, start: at },
                None => Mode::Pan { last: at },
            });
        }
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
            Mode::Idle => self.lab.hover(self.pick(at)),
            Mode::Pressed { path, start } => {
                if distance(at, start) >= STIR {
                    self.begin_drag(&path, start);
                    self.drag_to(at);
                }
            }
            Mode::Drag { .. } => self.drag_to(at),
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
        let Some(handle) = self.lab.press(path) else {
            self.set_mode(Mode::Pan { last: start });
            return;
        };
        let p = sheet_point(self.lab, start);
        self.set_mode(Mode::Drag { offset: (handle.0 - p.x, handle.1 - p.y) });
    }

    fn drag_to(self, at: (f64, f64)) {
        let Mode::Drag { offset } = self.mode() else { return };
        if self.lab.dragging.with_untracked(Option::is_some) {
            let p = sheet_point(self.lab, at);
            let decimals = self.lab.view.with_untracked(View::decimals);
            let round = |x: f64| base::number::rounded(x, decimals).parse().unwrap_or(x);
            self.lab.drag((round(p.x + offset.0), round(p.y + offset.1)));
        }
    }

    pub(super) fn up(self, e: &PointerEvent) {
        let at = self.at(e);
        self.state.update_value(|state| state.latest = Some(at));
        self.frame();
        let dragged = matches!(self.mode(), Mode::Drag { .. });
        self.let_go(e);
        // Escape may have ended the drag already.
        if dragged && self.lab.dragging.with_untracked(Option::is_some) {
            self.lab.release();
        }
    }

    pub(super) fn lost(self, e: &PointerEvent) {
        let dragged = matches!(self.mode(), Mode::Drag { .. });
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
