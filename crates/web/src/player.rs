//! Playing a value: it is led through its range and back, as a hand would drag it.
//!
//! In: a row of the values and its range. Out: a drag, one step of it a frame, until something else is changed. Then
//! it is released, and the whole is one step of the undo list; Escape takes it back instead. Selecting, zooming and
//! looking around go on meanwhile.

use crate::lab::{Lab, Zoom};
use crate::values::whole_turn;
use crate::{icons, js, sheet, words};
use drawing::{Bounds, Drawing, Shape};
use leptos::prelude::*;
use presentation::course::Course;
use presentation::numbers::ends_between;
use session::view::ValueRow;

/// How long the way through the range takes, in milliseconds.
const THROUGH: f64 = 4000.0;
/// The longest step, in milliseconds: after a pause one goes on from where one was.
const LONGEST_STEP: f64 = 50.0;
/// What is played.
#[derive(Clone, PartialEq, Debug)]
pub struct Playing {
    /// The value's path.
    pub path: String,
    /// The drag that plays it, among all of the visit.
    number: u32,
}

/// The plays of a lab.
#[derive(Clone, Copy, Debug)]
pub struct Player {
    /// What is played now.
    pub now: RwSignal<Option<Playing>>,
    /// How many there have been.
    count: StoredValue<u32>,
}

impl Default for Player {
    fn default() -> Self {
        Self { now: RwSignal::new(None), count: StoredValue::new(0) }
    }
}

impl Lab {
    /// Plays a value between the ends of a range, or stops where it is played.
    pub fn play(self, row: usize, ends: (f64, f64)) {
        let found = self.values.with_untracked(|rows| rows.get(row).cloned());
        let Some((of, at)) = found.and_then(|row| row.number.map(|at| (row, at))) else { return };
        let (is_turn, is_computed) = (whole_turn(&of) == Some(ends), of.is_virtual);
        let path = of.path;
        let was = self.player.now.get_untracked();
        self.stop_playing();
        if was.as_ref().is_some_and(|was| was.path == path) || self.press(&path).is_none() {
            return;
        }
        let ends = (ends.0.min(at), ends.1.max(at));
        let covered = (!self.looked.get_value()).then(|| self.covered());
        let grows = at < ends.1;
        let seen = [None, None];
        let mut course = Course { ends, at, grows, is_turn, is_computed, seen, turns: 0, covered };
        course.see(|| self.numbers_beside(row));
        let playing = Playing { path, number: self.player.count.get_value() + 1 };
        self.player.count.set_value(playing.number);
        self.player.now.set(Some(playing.clone()));
        request_animation_frame(move || frame(self, row, playing, course, js::now()));
    }

    /// Plays the number that is selected, or stops what is played.
    pub fn play_selection(self) {
        if self.player.now.with_untracked(Option::is_some) {
            return self.stop_playing();
        }
        if let Some((row, ends)) = untrack(|| self.playable()) {
            self.play(row, ends);
        }
    }

    /// Returns the row of the number that is selected, and the ends of its slider.
    pub fn playable(self) -> Option<(usize, (f64, f64))> {
        let path = self.selected.get()?;
        self.values.with(|rows| {
            let is_it = |row: &ValueRow| row.path == path || row.shortest == path;
            let at = rows.iter().position(is_it)?;
            let row = &rows[at];
            let asked = row.range.unwrap_or_default();
            Some((at, ends_between(row.number?, asked, whole_turn(row), None)))
        })
    }

    /// Returns all numbers but those of a row: the other values, and where the picture lies.
    fn numbers_beside(self, row: usize) -> Vec<f64> {
        let mut numbers: Vec<f64> = self.values.with_untracked(|rows| {
            let others = rows.iter().enumerate().filter(|(n, _)| *n != row);
            others.filter_map(|(_, other)| other.number).collect()
        });
        self.picture.with_untracked(|picture| {
            for element in &picture.drawing.elements {
                // a word may tell the number that is played
                if matches!(element.shape, Shape::Text { .. }) {
                    continue;
                }
                let elements = vec![element.clone()];
                let lies = sheet::bounds(&Drawing { elements, ..Drawing::default() });
                numbers.extend([lies.least.x, lies.least.y, lies.most.x, lies.most.y]);
            }
        });
        numbers
    }

    /// Returns the box around the picture.
    fn covered(self) -> Bounds {
        self.picture.with_untracked(|picture| sheet::bounds(&picture.drawing))
    }

    /// Ends what is played where it is; one step of the undo list.
    pub fn stop_playing(self) {
        if self.player.now.with_untracked(Option::is_some) {
            self.player.now.set(None);
            if self.dragging.with_untracked(Option::is_some) {
                self.release();
            }
        }
    }
}

fn frame(lab: Lab, row: usize, playing: Playing, mut course: Course, before: f64) {
    if lab.player.now.with_untracked(|now| now.as_ref() != Some(&playing)) {
        return;
    }
    // Escape has taken the drag back
    if lab.dragging.with_untracked(Option::is_none) {
        lab.player.now.set(None);
        return;
    }
    let time = js::now();
    course.step((time - before).clamp(0.0, LONGEST_STEP) / THROUGH);
    lab.drag((course.at, 0.0));
    if let Some(before) = course.covered.filter(|_| !lab.looked.get_value()) {
        let now = lab.covered();
        let all = before.with(now.least).with(now.most);
        if all != before {
            course.covered = Some(all);
            lab.zoom.set(Some(Zoom::Over(all)));
        }
    }
    let stopped = lab.dragging.with_untracked(|d| d.as_ref().is_some_and(|d| d.limit.is_some()));
    if stopped {
        let at = lab.values.with_untracked(|rows| rows.get(row).and_then(|r| r.number));
        if !course.turn_at(at.unwrap_or(course.at)) {
            return lab.stop_playing();
        }
    } else {
        course.turns = 0;
        course.see(|| lab.numbers_beside(row));
    }
    request_animation_frame(move || frame(lab, row, playing, course, time));
}

/// The button beside a slider.
#[component]
pub fn Play(
    /// The lab.
    lab: Lab,
    /// Which of the values.
    at: usize,
    /// Its path.
    path: Memo<String>,
    /// The ends of its slider.
    ends: Memo<(f64, f64)>,
) -> impl IntoView {
    let plays = Memo::new(move |_| {
        let now = lab.player.now.get();
        now.is_some_and(|now| path.with(|path| now.path == *path))
    });
    let label = move || match plays.get() {
        true => words::stops(&path.get()),
        false => words::plays(&path.get()),
    };
    view! {
        <button class="play bare" aria-label=label title=label
            on:click=move |_| lab.play(at, ends.get_untracked())>
            {move || if plays.get() { icons::stop() } else { icons::play() }}
        </button>
    }
}

/// What is played, wherever one looks, and how it stops.
#[component]
pub fn NowPlaying(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    move || {
        lab.player.now.get().map(|now| {
            view! {
                <button class="playing" on:click=move |_| lab.stop_playing()>
                    {icons::stop()} {words::stops(&now.path)}
                </button>
            }
        })
    }
}
