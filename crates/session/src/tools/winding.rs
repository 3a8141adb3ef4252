//! Which way round something is drawn that is set by a centre, a start and an end: the way that the hand goes.
//!
//! In: where the hand is, after the start is set. Out: the trial, made anew of the class of those that run the other
//! way whenever the hand has gone round the centre that way.

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

/// The two classes of which one is made, by the way of the hand.
pub(super) struct Winding {
    /// The texts of the trials: of what turns left, and of what turns right.
    texts: [String; 2],
    /// How far the hand has gone round since the start was set, and where it was last.
    turned: f64,
    last: Option<(f64, f64)>,
    /// Whether the trial is of the second.
    is_right: bool,
}

impl Winding {
    /// Returns how a thing is tried of each class, where those that run the other way round are of another one: that
    /// which the class's message `reversed` makes.
    pub(super) fn of(
        state: &State,
        class: ClassId,
        text: impl Fn(&Name) -> String,
    ) -> Option<Self> {
        let document = &state.lowered.document;
        let (_, reversed) = document.find_message(class, &Name::new("reversed"), None)?;
        let Term::Make { class: other, .. } = *reversed.answer else { return None };
        if other == class || !document.is_a(other, class) {
            return None;
        }
        let texts = [class, other].map(|class| text(&document.classes[class].name));
        Some(Self { texts, turned: 0.0, last: None, is_right: false })
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
        let [center, start] = self.set.as_slice() else { return };
        let (center, start) = (center.at, start.at);
        let Some(winding) = &mut self.winding else { return };
        let is_right = winding.follow(center, start, at);
        if is_right == winding.is_right {
            return;
        }
        let text = winding.texts[usize::from(is_right)].clone();
        let mut trial = Box::new(Open::of(&self.trial.name, text, host));
        stages::spread(&mut trial, &self.stages, host);
        let before = (std::mem::replace(&mut self.trial, trial), self.offset);
        let set = std::mem::take(&mut self.set);
        let again = set.iter().try_fold((), |(), catch| {
            if self.set.is_empty() {
                self.begin()?;
            }
            self.set_to(catch.clone(), host)
        });
        match again {
            Ok(()) => {
                if let Some(winding) = &mut self.winding {
                    winding.is_right = is_right;
                }
            }
            // then it stays as it runs
            Err(_) => ((self.trial, self.offset), self.set) = (before, set),
        }
    }
}
