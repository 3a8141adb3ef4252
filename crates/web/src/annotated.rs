//! What constraints say, on the drawing: shown, picked, typed anew; and the tool that gives things their sizes.

use crate::lab::{Lab, Notice};
use crate::{theme, words};
use leptos::prelude::*;
use presentation::annotations::{self, Moved, Note};
use presentation::marks::Marked;
use presentation::paint::{DisplayList, Mark};
use presentation::paths::covers;
use session::Session;
use session::view::{Annotation, Offer, PictureView};

/// Of more annotations than this only those of the selection are shown.
const MOST: usize = 60;
/// In a picture of more things than this none are shown while something is dragged.
const MOST_MOVING: usize = 2000;
const KEY: &str = "thinglab/annotations";

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
    pub sizing: RwSignal<bool>,
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
            sizing: RwSignal::new(false),
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
                let shown: Vec<Annotation> = all
                    .iter()
                    .filter(|one| all.len() <= MOST || is_of(one, marked))
                    .cloned()
                    .collect();
                let moved = self.annotated.moved;
                let made = moved.with(|m| annotations::notes(&shown, picture, &view, m));
                annotations::paint(list, &made, &view, |path| mark_of(marked, path));
                made
            })
        });
        notes.set_value(made);
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

    /// Gives the selection a size: asks for its value. Where nothing is selected that can have one, the next thing that
    /// is clicked is asked for; the same again ends that.
    pub fn dimension(self) {
        let constraint = self.selected.get_untracked();
        let typed = untrack(|| constraint.and_then(|path| self.typed_by(&path)));
        let offered = || untrack(|| self.offers()).into_iter().find(|offer| offer.value.is_some());
        if let Some(offer) = typed.or_else(offered) {
            self.take_offer(&offer);
        } else if self.annotated.sizing.get_untracked() {
            self.stop_sizing();
        } else {
            self.draft_end();
            self.drop_tool();
            self.select(None);
            self.notice.set(None);
            self.annotated.sizing.set(true);
        }
    }

    /// No further things are given sizes; returns whether any were to be.
    pub fn stop_sizing(self) -> bool {
        let was = self.annotated.sizing.get_untracked();
        if was {
            self.annotated.sizing.set(false);
        }
        was
    }

    /// What was clicked at a place of the window is given a size, alone or with what was clicked before; with Shift
    /// another thing may follow. Of a dimension that stands there another value is typed; a sign is no thing.
    pub fn size_picked(self, (path, at): (Option<String>, (f64, f64)), goes_on: bool) {
        let Some(path) = path else { return self.select(None) };
        let ask = |offer: Offer| {
            self.annotated.clicked.set_value(Some(at));
            self.take_offer(&offer);
        };
        let is_said = |all: &Vec<Annotation>| all.iter().any(|one| one.path == path);
        if self.annotated.all.with_untracked(is_said) {
            if let Some(offer) = untrack(|| self.typed_by(&path)) {
                self.select(Some(path));
                ask(offer);
            }
            return;
        }
        if self.selected.with_untracked(Option::is_some) {
            self.select_also(&path);
        } else {
            self.select(Some(path));
        }
        let offered = untrack(|| self.offers()).into_iter().find(|offer| offer.value.is_some());
        match offered {
            Some(offer) if !goes_on => ask(offer),
            Some(_) => {}
            None if self.also.with_untracked(|also| also.len() > 1) => {
                self.select(None);
                self.notice.set(Some(Notice::Said(String::from(words::NO_DIMENSION))));
            }
            None => {}
        }
    }
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
