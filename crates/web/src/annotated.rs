//! What constraints say, on the drawing: shown, picked, typed anew; and the tool that gives things their sizes.

use crate::dialog::Wish;
use crate::lab::{Lab, Notice};
use crate::{theme, words};
use leptos::prelude::*;
use presentation::annotations::{self, Moved, Note};
use presentation::marks::Marked;
use presentation::numbers::exactly;
use presentation::paint::{DisplayList, Mark};
use presentation::paths::covers;
use session::Session;
use session::view::{Annotation, Offer, PictureView, RowKind};

/// Of more annotations than this only those of the selection are shown.
const MOST: usize = 60;
/// In a picture of more things than this none are shown while something is dragged.
const MOST_MOVING: usize = 2000;
const KEY: &str = "thinglab/annotations";

/// Whether a click gives a thing a size.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sizing {
    /// It selects.
    Off,
    /// While the size of what was selected is asked for: a click on another thing is the first of the tool.
    Asked,
    /// The tool is held.
    Held,
}

/// What stands on the drawing.
#[derive(Clone, Copy, Debug)]
pub struct Annotated {
    /// Whether annotations are shown at all.
    pub shown: RwSignal<bool>,
    /// Those of the document.
    all: RwSignal<Vec<Annotation>>,
    /// Where they were painted last.
    pub notes: StoredValue<Vec<Note>>,
    /// How far a hand has moved them, while the page shows the document.
    moved: RwSignal<Moved>,
    /// How far they had been moved when a hand took one.
    held: StoredValue<Option<Moved>>,
    /// Whether the next thing that is clicked is given a size.
    pub sizing: RwSignal<Sizing>,
    /// What has been typed of the size that is asked for.
    pub typed: StoredValue<Option<String>>,
    /// Why that was refused.
    pub refused: RwSignal<Option<String>>,
    /// Where what is given a size was clicked, in the window: it is asked for there.
    pub clicked: StoredValue<Option<(f64, f64)>>,
}

impl Annotated {
    /// None yet; they are shown unless somebody has hidden them.
    pub fn new() -> Self {
        Self {
            shown: RwSignal::new(theme::keep(KEY).is_none_or(|kept| kept != "off")),
            all: RwSignal::new(Vec::new()),
            notes: StoredValue::new(Vec::new()),
            moved: RwSignal::new(Moved::new()),
            held: StoredValue::new(None),
            sizing: RwSignal::new(Sizing::Off),
            typed: StoredValue::new(None),
            refused: RwSignal::new(None),
            clicked: StoredValue::new(None),
        }
    }
}

impl Default for Annotated {
    fn default() -> Self {
        Self::new()
    }
}

/// Keeps what the constraints say up to date; during a drag they say what they said.
pub fn follow(lab: Lab) {
    Effect::new(move |_| {
        lab.current.track();
        lab.annotated.moved.set(Moved::new());
    });
    Effect::new(move |_| {
        lab.text.track();
        lab.values.track();
        if lab.dragging.with(Option::is_some) {
            return;
        }
        let all = match lab.annotated.shown.get() {
            true => lab.ask_of_shown(Session::annotations).unwrap_or_default(),
            false => Vec::new(),
        };
        if lab.annotated.all.with_untracked(|was| *was != all) {
            lab.annotated.all.set(all);
        }
    });
}

impl Lab {
    /// Adds to what is painted what the constraints say.
    pub fn annotate(self, list: &mut DisplayList, picture: &PictureView) {
        let Annotated { all, notes, .. } = self.annotated;
        let is_moving = self.dragging.with(Option::is_some);
        let made = all.with(|all| {
            if all.is_empty() || is_moving && picture.paths.len() > MOST_MOVING {
                return Vec::new();
            }
            let view = self.view.get();
            self.marked.with(|marked| {
                let moved = self.annotated.moved;
                let made =
                    moved.with(|m| annotations::notes(&seen(all, marked), picture, &view, m));
                annotations::paint(list, &made, &view, |path| mark_of(marked, path));
                made
            })
        });
        notes.set_value(made);
    }

    /// Adds to a picture that is exported what the constraints say, as far as it is shown, where a unit has so many
    /// pixels.
    pub fn draw_notes(self, picture: &mut PictureView, pixels: f64) {
        let Annotated { all, moved, .. } = self.annotated;
        let shown = untrack(|| all.with(|all| self.marked.with(|marked| seen(all, marked))));
        let times = pixels / self.view.with_untracked(|view| view.scale);
        let moved = moved.with_untracked(|moved| annotations::scaled(moved, times));
        annotations::draw(picture, &shown, &moved, pixels);
    }

    /// Whether anything is said on the drawing.
    pub fn shows_notes(self) -> bool {
        self.annotated.notes.with_value(|notes| !notes.is_empty())
    }

    /// The note whose words are at a place on the canvas.
    pub fn note_at(self, at: (f64, f64)) -> Option<Note> {
        self.annotated.notes.with_value(|notes| annotations::at(notes, at).cloned())
    }

    /// A hand takes a note, to move it.
    pub fn take_note(self) {
        self.annotated.held.set_value(Some(self.annotated.moved.get_untracked()));
    }

    /// Puts the note that a hand has taken where it was; returns whether one has been.
    pub fn put_note_back(self) -> bool {
        let before = self.annotated.held.try_update_value(Option::take).flatten();
        before.map(|before| self.annotated.moved.set(before)).is_some()
    }

    /// Whether a hand has taken a note, and Escape has not put it back.
    pub fn holds_note(self) -> bool {
        self.annotated.held.with_value(Option::is_some)
    }

    /// Moves a note on, as far as a hand went on the canvas.
    pub fn move_note(self, key: &str, way: (f64, f64)) {
        self.annotated.notes.with_value(|notes| {
            self.annotated.moved.update(|moved| annotations::shift(notes, key, way, moved));
        });
    }

    /// Moves the words of the constraint that is selected; returns whether it has any.
    pub fn nudge_note(self, way: (f64, f64)) -> bool {
        let Some(selected) = self.selected.get_untracked() else { return false };
        let key = self.annotated.notes.with_value(|notes| {
            notes.iter().find(|note| note.path == selected).map(|note| note.key.clone())
        });
        key.inspect(|key| self.move_note(key, way)).is_some()
    }

    /// Lets go of a note; says, when the first one has been moved, how long it stands there.
    pub fn drop_note(self) {
        let before = self.annotated.held.try_update_value(Option::take).flatten();
        if before.is_some_and(|before| before.is_empty()) {
            self.notice.set(Some(Notice::Said(String::from(words::NOTE_MOVED))));
        }
    }

    /// What types another value of the dimension that a constraint gives; also says it to a panel, as it changes.
    pub fn typed_by(self, constraint: &str) -> Option<Offer> {
        let of = |all: &[Annotation]| {
            all.iter().find(|one| one.path == constraint).and_then(|one| one.typed.clone())
        };
        if self.annotated.shown.get() {
            return self.annotated.all.with(|all| of(all));
        }
        self.text.track();
        of(&self.ask_of_shown(Session::annotations).unwrap_or_default())
    }

    /// Shows or hides what the constraints say, and remembers it.
    pub fn toggle_annotations(self) {
        self.annotated.shown.update(|shown| *shown = !*shown);
        let kept = if self.annotated.shown.get_untracked() { "on" } else { "off" };
        theme::put(KEY, Some(kept));
    }

    /// Gives the selection a size: asks for its value, and while it is asked for a click goes on to another thing. Where
    /// nothing is selected that can have one, the next thing that is clicked is asked for; the same again ends that.
    pub fn dimension(self) {
        let constraint = self.selected.get_untracked();
        let typed = untrack(|| constraint.and_then(|path| self.typed_by(&path)));
        if let Some(offer) = typed.or_else(|| self.size_offered()) {
            if self.annotated.sizing.get_untracked() == Sizing::Off {
                self.annotated.sizing.set(Sizing::Asked);
            }
            self.take_offer(&offer);
        } else if self.is_sizing() {
            self.stop_sizing();
        } else {
            self.draft_end();
            self.drop_tool();
            self.select(None);
            self.notice.set(None);
            self.annotated.sizing.set(Sizing::Held);
        }
    }

    /// The size that what is selected can be given.
    fn size_offered(self) -> Option<Offer> {
        untrack(|| self.offers()).into_iter().find(|offer| offer.value.is_some())
    }

    /// Whether a click gives a thing a size.
    pub fn is_sizing(self) -> bool {
        self.annotated.sizing.get_untracked() != Sizing::Off
    }

    /// No further things are given sizes; returns whether any were to be.
    pub fn stop_sizing(self) -> bool {
        let was = self.is_sizing();
        if was {
            self.annotated.sizing.set(Sizing::Off);
            if self.asks_size() {
                self.wish.set(None);
            }
        }
        was
    }

    /// Whether a size is asked for.
    pub fn asks_size(self) -> bool {
        self.wish.with_untracked(|wish| matches!(wish, Some(Wish::Dimension(_))))
    }

    /// Asks for a size no longer. With the tool the next thing is another.
    pub fn end_size(self) {
        self.wish.set(None);
        match self.annotated.sizing.get_untracked() {
            Sizing::Off => {}
            Sizing::Asked => self.annotated.sizing.set(Sizing::Off),
            Sizing::Held => self.select(None),
        }
    }

    /// A hand is at something else: what has been typed of the size that is asked for is taken, and it is asked for no
    /// longer. Returns whether it is so; what is refused stays, and what contradicts is asked first.
    pub fn settle_size(self) -> bool {
        let Some(Wish::Dimension(offer)) = self.wish.get_untracked() else { return true };
        if let Some(typed) = self.annotated.typed.get_value() {
            let value = exactly(&typed, offer.value.as_deref().unwrap_or_default());
            match self.set_dimension(&offer, &value) {
                Ok(holds) => {
                    self.end_size();
                    return holds;
                }
                Err(sentence) => {
                    self.annotated.refused.set(Some(sentence));
                    return false;
                }
            }
        }
        self.end_size();
        true
    }

    /// The next thing, or the one before, between which and what a size is asked of there is one, as long as nothing is
    /// typed.
    pub fn size_beside(self, from: Option<&str>, is_forth: bool) -> Option<String> {
        let [one] = &self.selection_untracked()[..] else { return None };
        if self.annotated.typed.with_value(Option::is_some) {
            return None;
        }
        let own = session::parse_path(one)?;
        let has_size = |path: &String| {
            let both = [own.clone(), session::parse_path(path)?];
            let offers = self.ask_of_shown(|session, id| session.offers(id, &both))?;
            offers.iter().any(|offer| offer.value.is_some()).then(|| path.clone())
        };
        self.list();
        let all: Vec<String> = self.structure.with_untracked(|rows| {
            let things = rows.iter().filter(|row| row.kind == RowKind::Part);
            things.map(|row| row.path.clone()).filter(|path| !covers(one, path)).collect()
        });
        let at = from.and_then(|from| all.iter().position(|path| path == from));
        match is_forth {
            true => all[at.map_or(0, |at| at + 1)..].iter().find_map(has_size),
            false => all[..at.unwrap_or(all.len())].iter().rev().find_map(has_size),
        }
    }

    /// What was clicked at a place of the window is given a size, alone or with what was clicked before and not answered;
    /// with Shift another thing may follow. Of a dimension that stands there another value is typed; a sign is no thing.
    /// A click beside all things, by which other programs place a dimension, takes back no question.
    pub fn size_picked(self, (path, at): (Option<String>, Option<(f64, f64)>), goes_on: bool) {
        let asks = self.asks_size();
        let is_open = asks && self.annotated.typed.with_value(Option::is_none);
        let again = path.as_ref().is_none_or(|path| self.selection_untracked().contains(path));
        if is_open && again {
            return;
        }
        let before = self.selection_untracked();
        self.notice.set(None);
        if !self.settle_size() {
            return;
        }
        if asks {
            self.select(None);
        }
        let Some(path) = path else { return self.select(None) };
        // from here on it is the tool that is held
        self.annotated.sizing.set(Sizing::Held);
        if is_open {
            self.select_all(&before);
        }
        let ask = |offer: Offer| {
            self.annotated.clicked.set_value(at);
            self.take_offer(&offer);
        };
        let is_said = |all: &Vec<Annotation>| all.iter().any(|one| one.path == path);
        if self.annotated.all.with_untracked(is_said) {
            self.select(Some(path.clone()));
            if let Some(offer) = untrack(|| self.typed_by(&path)) {
                ask(offer);
            }
            return;
        }
        if self.selected.with_untracked(Option::is_some) {
            self.select_also(&path);
        } else {
            self.select(Some(path.clone()));
        }
        if goes_on {
            return;
        }
        if let Some(offer) = self.size_offered() {
            ask(offer);
        } else if self.also.with_untracked(|also| !also.is_empty())
            && (is_open || !before.is_empty())
        {
            // what has no size with the one before begins anew
            self.select(Some(path));
            match self.size_offered() {
                Some(offer) => ask(offer),
                None => self.notice.set(Some(Notice::Said(String::from(words::NO_DIMENSION)))),
            }
        }
    }
}

/// Those annotations that are seen: of many only those of the selection.
fn seen(all: &[Annotation], marked: &Marked) -> Vec<Annotation> {
    all.iter().filter(|one| all.len() <= MOST || is_of(one, marked)).cloned().collect()
}

/// Whether an annotation is of what is selected, or is itself.
fn is_of(one: &Annotation, marked: &Marked) -> bool {
    let is_it = |path: &String| *path == one.path || one.of.iter().any(|of| covers(path, of));
    marked.selected.iter().any(is_it)
}

fn mark_of(marked: &Marked, path: &str) -> Mark {
    match () {
        () if marked.selected.iter().any(|selected| selected == path) => Mark::Selected,
        () if marked.hovered.as_deref() == Some(path) => Mark::Hovered,
        () => Mark::None,
    }
}
