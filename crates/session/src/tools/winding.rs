//! Which way round something is drawn that is set by a centre, a start and an end: the way that the hand goes.
//!
//! In: where the hand is, after the first end is set. Out: which of the two ends is the start. An arc runs to the left
//! from its start to its end; where the hand has gone round to the right, it runs towards where the hand began.

use super::{Tool, stages};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use base::Name;
use base::number::atan2;
use kernel::{ClassId, Term};
use std::f64::consts::PI;

/// What jumps by more than this, as a place that is typed, has gone no way round that could be told.
const TOLD: f64 = 0.97 * PI;

/// The way of the hand.
pub(super) struct Winding {
    /// The text of the trial, before anything is set.
    text: String,
    /// How far the hand has gone round since the first end was set, and where it was last.
    turned: f64,
    last: Option<(f64, f64)>,
    /// Whether the first end that was set is the end, and the second the start.
    pub(super) is_right: bool,
}

impl Winding {
    /// Returns the way of a hand that has not gone any yet, where things of a class run one way round alone: what its
    /// message `reversed` makes is of another class.
    pub(super) fn of(state: &State, class: ClassId, text: &str) -> Option<Self> {
        let document = &state.lowered.document;
        let (_, reversed) = document.find_message(class, &Name::new("reversed"), None)?;
        let Term::Make { class: other, .. } = *reversed.answer else { return None };
        let text = String::from(text);
        (other != class).then_some(Self { text, turned: 0.0, last: None, is_right: false })
    }

    /// The hand is elsewhere; returns whether it has gone round to the right.
    fn follow(&mut self, center: (f64, f64), start: (f64, f64), at: (f64, f64)) -> bool {
        let from = self.last.unwrap_or(start);
        let (a, b) = ((from.0 - center.0, from.1 - center.1), (at.0 - center.0, at.1 - center.1));
        let by = atan2(a.0 * b.1 - a.1 * b.0, a.0 * b.0 + a.1 * b.1);
        self.turned += if by.abs() > TOLD { by.abs() } else { by };
        self.last = Some(at);
        self.turned < 0.0
    }
}

impl Tool {
    /// Has what is drawn run round the way that the hand goes.
    pub(super) fn wind(&mut self, at: (f64, f64), host: &dyn Host) {
        let ([center, start], [_, _, _]) = (self.set.as_slice(), self.stages.as_slice()) else {
            return;
        };
        let (center, start) = (center.at, start.at);
        let Some(winding) = &mut self.winding else { return };
        let is_right = winding.follow(center, start, at);
        if is_right == winding.is_right {
            return;
        }
        let mut trial = Box::new(Open::of(&self.trial.name, winding.text.clone(), host));
        stages::spread(&mut trial, &self.stages, host);
        let before = (std::mem::replace(&mut self.trial, trial), self.offset);
        self.stages.swap(1, 2);
        let set = std::mem::take(&mut self.set);
        let mut again = self.begin();
        for catch in &set {
            again = again.and_then(|()| self.set_to(catch.clone(), host));
        }
        match (again, &mut self.winding) {
            (Ok(()), Some(winding)) => winding.is_right = is_right,
            // then it stays as it runs
            _ => {
                ((self.trial, self.offset), self.set) = (before, set);
                self.stages.swap(1, 2);
            }
        }
    }
}
