//! Views: what of them is made anew after a command, and when.
//!
//! At once there are the picture, the status line and, where no more than values are others, the rows in sight. All
//! rows follow while the page rests, a few at a time; where others are to be seen, a short list of them is there at
//! once. Whoever has to know them all before asks for them by [`Lab::list`]. During a drag only what is in sight is
//! made.

use super::Lab;
use super::jobs::{Kind, Told};
use crate::js;
use leptos::prelude::*;
use session::Listing;
use session::jobs::{LongAnswer, LongQuestion};
use session::view::{DocumentId, MovedView, PictureView, RowKind, StructureRow};
use std::collections::BTreeMap;
use std::time::Duration;

/// Rows are made for so many milliseconds before the page has its turn.
const A_WHILE: f64 = 8.0;
/// So many rows are made between two looks at the clock.
const BETWEEN_LOOKS: u32 = 16;
/// A list of so many rows is short.
const SHORT: u32 = 400;
/// While something is dragged, they wait so long.
const PAUSE: Duration = Duration::from_millis(100);

/// Rows that are being made, and for the how-manieth time.
#[derive(Debug, Default)]
pub(super) struct Rows {
    number: u32,
    /// Of which document; its picture is shown as well.
    of: Option<DocumentId>,
    listing: Option<Listing>,
}

impl Lab {
    /// Makes the views that a drag changes, as far as they are in the page.
    pub(super) fn repaint(self) {
        let Some(id) = self.id() else { return };
        self.follow_picture(id);
        self.renew_rows(id);
    }

    /// Makes all views of a document that was not shown before.
    pub(super) fn show_views(self) {
        self.structure.set(Vec::new());
        self.values.set(Vec::new());
        self.value_rows.update(|n| *n += 1);
        let Some(id) = self.id() else { return };
        self.follow_picture(id);
        self.tell_state(id);
        let number = self.begin_listing(id);
        set_timeout(move || self.go_on_listing(number), Duration::ZERO);
    }

    /// Brings the views up to date after a command.
    pub(super) fn refresh(self) {
        let Some(id) = self.id() else { return };
        let is_anew = self.follow_picture(id) == MovedView::Everything;
        self.tell_state(id);
        let number = self.begin_listing(id);
        if is_anew {
            let is_in_sight = |rows: StoredValue<Vec<usize>>| rows.with_value(|at| !at.is_empty());
            let is_seen = is_in_sight(self.shown_things) || is_in_sight(self.shown_values);
            if is_seen && self.make_short_list() {
                return self.list();
            }
        } else {
            self.renew_rows(id);
        }
        // the picture comes first
        js::after_painting(move || self.go_on_listing(number));
    }

    /// Brings the picture up to date, and says what of it moves.
    fn follow_picture(self, id: DocumentId) -> MovedView {
        if self.listing.with_value(|rows| rows.of != Some(id)) {
            // nothing of it is of this document
            let _ = self.picture.try_update_untracked(|view| *view = PictureView::default());
        }
        let followed = self
            .picture
            .try_update_untracked(|view| self.ask(|session| session.follow_picture(id, view)));
        let moved = followed.unwrap_or(MovedView::Everything);
        // which way the sheet counts y may have been said just now
        let vertical = self.picture.with_untracked(|picture| picture.drawing.vertical);
        let view = self.view.get_untracked();
        if vertical != view.vertical {
            let middle = self.drawn_box().map_or(0.0, |drawn| (drawn.least.y + drawn.most.y) / 2.0);
            self.view.set(view.turned_over(vertical, middle));
        }
        if self.moved.with_untracked(|before| *before != moved) {
            self.moved.set(moved.clone());
        }
        self.picture.notify();
        moved
    }

    /// Says how the document stands, and keeps its text as a draft.
    fn tell_state(self, id: DocumentId) {
        let (text, status, title) =
            self.ask(|session| (session.text(id), session.standing(id), session.title(id)));
        self.status.set(status);
        self.update_document(|document| {
            document.dirty = document.saved != text.source;
            document.title = title;
        });
        self.keep_draft(&text.source);
        self.text.set(text);
        self.follow_lesson();
    }

    /// Brings the rows up to date that are in the page.
    fn renew_rows(self, id: DocumentId) {
        let dragged = self.structure.with_untracked(|rows| {
            let shown = self.shown_things.get_value();
            self.ask(|session| {
                let part = |at: &usize| rows.get(*at).filter(|row| row.kind == RowKind::Part);
                let value =
                    |row: &StructureRow| session.shown_value(id, &session::parse_path(&row.path)?);
                let of = |at: usize| Some((at, part(&at).and_then(value)?));
                shown.into_iter().filter_map(of).collect()
            })
        });
        self.dragged_values.set(dragged);
        let mut shown = self.shown_values.get_value();
        shown.extend(self.inspected_values.get_value());
        shown.sort_unstable();
        shown.dedup();
        self.values.update(|rows| {
            let mut shown = shown.iter().peekable();
            let rows = rows.iter_mut().enumerate();
            let rows = rows.filter(|(at, _)| shown.next_if(|next| *next == at).is_some());
            self.ask(|session| session.renew_values(id, rows.map(|(_, row)| row)));
        });
    }

    /// Begins to make all rows, instead of any that are being made; returns which ones they are.
    fn begin_listing(self, id: DocumentId) -> u32 {
        let listing = self.ask(|session| session.begin_listing(id));
        let number = self.listing.try_update_value(|rows| {
            let number = rows.number + 1;
            *rows = Rows { number, of: Some(id), listing: Some(listing) };
            rows.number
        });
        number.unwrap_or_default()
    }

    /// Makes as many rows as a short list has; returns true where these are all.
    fn make_short_list(self) -> bool {
        let mut made = 0_u32;
        let mut is_short = || {
            made += 1;
            made < SHORT
        };
        let is_done = self.listing.try_update_value(|rows| {
            rows.listing.as_mut().is_none_or(|listing| listing.go_on(&mut is_short))
        });
        is_done == Some(true)
    }

    /// Goes on for a while, and again later until all rows are made or others have taken their place.
    fn go_on_listing(self, number: u32) {
        let again = move |after: Duration| set_timeout(move || self.go_on_listing(number), after);
        // the lab may have gone with the page
        let is_it = self.listing.try_with_value(|rows| rows.number == number);
        if is_it != Some(true) {
            return;
        }
        if self.dragging.with_untracked(Option::is_some) {
            return again(PAUSE);
        }
        let until = js::now() + A_WHILE;
        let mut made = 0_u32;
        let mut has_time = || {
            made += 1;
            !made.is_multiple_of(BETWEEN_LOOKS) || js::now() < until
        };
        let is_done = self.listing.try_update_value(|rows| {
            rows.listing.as_mut().is_none_or(|listing| listing.go_on(&mut has_time))
        });
        match is_done {
            Some(true) => self.list(),
            _ => again(Duration::ZERO),
        }
    }

    /// Shows all rows, those as well that are still to be made.
    pub fn list(self) {
        let listing = self.listing.try_update_value(|rows| rows.listing.take()).flatten();
        let Some(listing) = listing else { return };
        let (structure, values) = listing.finished();
        self.values.set(values);
        self.value_rows.update(|n| *n += 1);
        self.structure.set(structure);
        self.dragged_values.update(BTreeMap::clear);
        self.count_freedom();
    }

    /// Has it counted how much is free, where that could not be said at once; until then there is at least so much.
    fn count_freedom(self) {
        if self.status.with_untracked(|status| status.counted) {
            return;
        }
        let number = self.listing.with_value(|rows| rows.number);
        let is_it = move || self.listing.try_with_value(|rows| rows.number == number) == Some(true);
        let hear = move |told| {
            let Some(id) = self.id().filter(|_| is_it()) else { return };
            let Told::Part(LongAnswer::More { form, more }) = told else { return };
            self.order(|session| session.note_more(id, form, more));
            self.tell_freedom(id);
        };
        // panels that hear of the edit ask first
        let ask = move || {
            if is_it() {
                self.ask_long(Kind::Freedom, LongQuestion::More, hear);
            }
        };
        set_timeout(ask, Duration::ZERO);
    }

    /// Says how the document stands once what is free is counted.
    pub(super) fn tell_freedom(self, id: DocumentId) {
        let status = self.ask(|session| session.standing(id));
        let is_as_said = self.status.with_untracked(|s| s.message == status.message);
        // nobody has to hear of what they were told before
        match is_as_said {
            true => drop(self.status.try_update_untracked(|s| *s = status)),
            false => self.status.set(status),
        }
    }
}
