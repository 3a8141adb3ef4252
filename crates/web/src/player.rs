//! Playing a value: it is led through its range and back, as a hand would drag it.
//!
//! In: a row of the values and its range. Out: a drag, one step of it a frame, until something else is changed. Then
//! it is released, and the whole is one step of the undo list; Escape takes it back instead. Selecting, zooming and
//! looking around go on meanwhile.

use crate::lab::{Lab, Zoom};
use crate::values::{slider_range, whole_turn};
use crate::{icons, js, sheet, words};
use drawing::Bounds;
use leptos::prelude::*;
use session::view::ValueRow;

/// How long the way through the range takes, in milliseconds.
const THROUGH: f64 = 4000.0;
/// The longest step, in milliseconds: after a pause one goes on from where one was.
const LONGEST_STEP: f64 = 50.0;
/// After so many turns without a way between them there is none.
const MOST_TURNS: u32 = 2;

/// What is played.
#[derive(Clone, PartialEq, Debug)]
pub struct Playing {
    /// The value's path.
    pub path: String,
    /// The drag that plays it, among all of the visit.
    number: u32,
}

/// A value on its way.
#[derive(Clone, PartialEq, Debug)]
struct Course {
    /// The ends of the range.
    ends: (f64, f64),
    /// The value that is wanted now.
    at: f64,
    /// Whether it grows.
    grows: bool,
    /// Whether the ends are one place, as those of a whole turn: then it goes on through them.
    goes_round: bool,
    /// How often it has turned since it last got on.
    turns: u32,
    /// What the picture has covered of the sheet so far, while the view is one that fits.
    covered: Option<Bounds>,
}

impl Course {
    /// Goes on by a part of the range, and turns round at its ends, or goes through them.
    fn step(&mut self, part: f64) {
        let (least, most) = self.ends;
        let way = part * (most - least);
        self.at += if self.grows { way } else { -way };
        if self.goes_round {
            self.at = least + (self.at - least).rem_euclid(most - least);
            return;
        }
        if self.at >= most || self.at <= least {
            self.grows = self.at <= least;
            self.at = self.at.clamp(least, most);
        }
    }

    /// Turns round where the value has stopped short; returns false where it can go neither way.
    fn turn_at(&mut self, stopped: f64) -> bool {
        self.grows = !self.grows;
        self.at = stopped;
        self.turns += 1;
        self.turns <= MOST_TURNS
    }
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
        // an angle that is computed has no value beyond its ends
        let goes_round = !of.is_virtual && whole_turn(&of) == Some(ends);
        let path = of.path;
        let was = self.player.now.get_untracked();
        self.stop_playing();
        if was.as_ref().is_some_and(|was| was.path == path) || self.press(&path).is_none() {
            return;
        }
        let ends = (ends.0.min(at), ends.1.max(at));
        let covered = self.fits.get_value().then(|| self.covered());
        let grows = at < ends.1;
        let course = Course { ends, at, grows, goes_round, turns: 0, covered };
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
            let around = slider_range(row.number?, whole_turn(row), None);
            Some((at, row.range.unwrap_or(around)))
        })
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
    if let Some(before) = course.covered.filter(|_| lab.fits.get_value()) {
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

#[cfg(test)]
mod tests {
    use super::Course;

    fn course() -> Course {
        Course {
            ends: (0.0, 10.0),
            at: 8.0,
            grows: true,
            goes_round: false,
            turns: 0,
            covered: None,
        }
    }

    #[test]
    fn a_whole_turn_goes_on_through_its_ends() {
        let mut course = Course { goes_round: true, ..course() };
        course.step(0.5);
        assert_eq!((course.at, course.grows), (3.0, true));
        course.grows = false;
        course.step(0.5);
        assert_eq!((course.at, course.grows), (8.0, false));
    }

    #[test]
    fn a_value_turns_round_at_the_ends_of_its_range() {
        let mut course = course();
        course.step(0.25);
        assert_eq!((course.at, course.grows), (10.0, false));
        course.step(0.25);
        assert_eq!((course.at, course.grows), (7.5, false));
        course.step(1.0);
        assert_eq!((course.at, course.grows), (0.0, true));
    }

    #[test]
    fn where_it_stops_short_it_goes_back_and_gives_up_between_two_walls() {
        let mut course = course();
        assert!(course.turn_at(6.0));
        assert_eq!((course.at, course.grows), (6.0, false));
        assert!(course.turn_at(6.0));
        assert!(!course.turn_at(6.0));
    }
}
