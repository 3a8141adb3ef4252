//! Stops: the places that a tool can be brought to by a key, one after the other, and not only by a pointer.

use super::Tool;
use super::catch::Catch;
use crate::state::State;
use crate::view::{Along, Pointer};
use base::number::hypot;
use drawing::Shape;

impl Tool {
    /// Returns the next place along the picture that the present stage would join, or lie in the middle of; none past
    /// the last, but where something is begun, which may end at any, behind the last comes the first. A pointer that is
    /// near a stop stands at it.
    pub(crate) fn stop(
        &self,
        state: &State,
        pointer: &Pointer,
        along: Along,
    ) -> Option<(f64, f64)> {
        let far = |a: (f64, f64), b: (f64, f64)| hypot(a.0 - b.0, a.1 - b.1);
        let is_one = |a: (f64, f64), b: (f64, f64)| far(a, b) <= 1e-6 * pointer.reach;
        let grips = self.picture.grips.iter().map(|grip| (grip.x, grip.y));
        let middles = self.picture.drawing.elements.iter().filter_map(|e| match &e.shape {
            Shape::Segment(a, b) => Some((f64::midpoint(a.x, b.x), f64::midpoint(a.y, b.y))),
            _ => None,
        });
        let mut stops: Vec<(f64, f64)> = Vec::new();
        for at in grips.chain(middles) {
            if !stops.iter().any(|known| is_one(*known, at)) {
                stops.push(at);
            }
        }
        let near = stops.iter().enumerate().map(|(n, at)| (far(*at, pointer.at), n));
        let now = near.filter(|(far, _)| *far <= pointer.reach).min_by(|a, b| a.0.total_cmp(&b.0));
        let last = self.set.last().map(|catch| catch.at);
        let holds = |at: &(f64, f64)| {
            let pointer = Pointer { at: *at, reach: 1e-6 * pointer.reach, ..pointer.clone() };
            let Catch { joins, rules, is_level, .. } = self.catch(state, &pointer);
            let is_caught = joins.is_some() || !rules.is_empty();
            is_caught && !is_level && last.is_none_or(|last| !is_one(last, *at))
        };
        let (ahead, behind) = match now {
            Some((_, n)) => (&stops[n + 1..], &stops[..n]),
            None => (&stops[..], &stops[..]),
        };
        let goes_round = now.is_some() && last.is_some();
        let round = |rest| if goes_round { rest } else { &[][..] };
        match along {
            Along::Next => ahead.iter().chain(round(behind)).copied().find(holds),
            Along::Back => {
                behind.iter().rev().chain(round(ahead).iter().rev()).copied().find(holds)
            }
        }
    }
}
