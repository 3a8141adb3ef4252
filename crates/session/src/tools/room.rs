//! Room: where on the sheet a thing goes that nobody has placed.

use super::Tool;
use crate::document::Open;
use crate::host::Host;
use crate::session::thing_at;
use crate::state::State;
use crate::view::{Pointer, Refusal};
use base::Name;
use drawing::{Bounds, Drawing, Element, Point, bounds};
use kernel::{Command, Path, Step};

/// The least distance from what is there already, on the sheet.
const GAP: f64 = 40.0;
/// How many places are tried along a row, and how many rows.
const TRIES: (usize, usize) = (6, 40);

/// Returns the command that inserts a thing of a class where nothing lies yet.
///
/// # Errors
/// There is no such class, or it has no place.
pub(crate) fn insertion(open: &Open, host: &dyn Host, class: &str) -> Result<Command, Refusal> {
    in_room(open, Tool::new(open, host, class)?, host)
}

/// Returns the command that inserts what a tool makes where nothing lies yet.
///
/// # Errors
/// It cannot be there.
pub(crate) fn in_room(open: &Open, mut tool: Tool, host: &dyn Host) -> Result<Command, Refusal> {
    let elements = &tool.picture.drawing.elements;
    let there: Vec<Bounds> =
        elements.iter().filter_map(|element| around(std::slice::from_ref(element))).collect();
    let origin = Bounds::at(Point { x: 0.0, y: 0.0 });
    let all = around(elements).unwrap_or(origin);
    let spots = tool.layout_spots();
    let own = match spots.is_empty() {
        true => around(&tool.view().preview.elements).unwrap_or(origin),
        false => spots.iter().fold(Bounds::at(Point { x: 0.0, y: 0.0 }), |b, s| Bounds {
            least: Point { x: b.least.x.min(s.0), y: b.least.y.min(s.1 - GAP / 2.0) },
            most: Point { x: b.most.x.max(s.0), y: b.most.y.max(s.1 + GAP / 2.0) },
        }),
    };
    let first = tool.first_place().filter(|_| spots.is_empty());
    let first = first.unwrap_or(Point { x: 0.0, y: 0.0 });
    let (width, height) = (own.width() + GAP, own.height() + GAP);
    let is_empty = there.is_empty();
    let corners = (0..TRIES.1).flat_map(|row| (0..TRIES.0).map(move |column| (column, row)));
    let spot = |(column, row): (usize, usize)| {
        let corner =
            Point { x: all.least.x + column as f64 * width, y: all.least.y + row as f64 * height };
        (corner.x - own.least.x, corner.y - own.least.y)
    };
    let is_free = |&(dx, dy): &(f64, f64)| {
        there.iter().all(|b| {
            own.most.x + dx + GAP / 2.0 < b.least.x
                || own.least.x + dx - GAP / 2.0 > b.most.x
                || own.most.y + dy + GAP / 2.0 < b.least.y
                || own.least.y + dy - GAP / 2.0 > b.most.y
        })
    };
    let below = (all.least.x - own.least.x, all.most.y + GAP - own.least.y);
    let by = match is_empty {
        true => (0.0, 0.0),
        false => { corners.map(spot) }.find(is_free).unwrap_or(below),
    };
    let at = (first.x + by.0, first.y + by.1);
    match spots.is_empty() {
        true => tool.place_whole(at, host),
        false => tool.place_each(&open.state, at, &spots, host),
    }
}

/// The box around some elements; nothing for none.
fn around(elements: &[Element]) -> Option<Bounds> {
    bounds(&Drawing { elements: elements.to_vec(), ..Drawing::default() })
}

impl Tool {
    /// Where the first of its places is.
    fn first_place(&self) -> Option<Point> {
        match self.stages.first()? {
            super::Stage::Place { place, .. } => self.place_now(place),
            super::Stage::Reach { .. } | super::Stage::Far { .. } => None,
        }
    }

    /// Where its places go, from the first, where they only say how it is drawn; nothing where they mean more.
    fn layout_spots(&self) -> Vec<(f64, f64)> {
        let trial = &self.trial.state;
        let is_layout = |stage: &super::Stage| {
            let super::Stage::Place { place, .. } = stage else { return false };
            let path = Path(vec![Step::Part(Name::new(&self.name))]).join(place);
            let slots = thing_at(trial, &path).map(|t| trial.structure.slots_under(t));
            slots.is_some_and(|s| s.iter().all(|&slot| trial.structure.slots[slot].is_layout))
        };
        let all = self.stages.len();
        match all > 1 && self.stages.iter().all(is_layout) {
            true => (0..all).map(|n| super::stages::spot(all, n)).collect(),
            false => Vec::new(),
        }
    }

    /// Sets place after place, each at its spot from a corner.
    fn place_each(
        &mut self,
        state: &State,
        (x, y): (f64, f64),
        spots: &[(f64, f64)],
        host: &dyn Host,
    ) -> Result<Command, Refusal> {
        for spot in spots {
            let at = (x + spot.0, y + spot.1);
            let pointer = Pointer { at, alone: true, ..Pointer::default() };
            self.set(state, &pointer, host)?;
        }
        Ok(self.command(host))
    }

    /// Sets the whole by its first place, all else as the prototype has it.
    fn place_whole(&mut self, at: (f64, f64), host: &dyn Host) -> Result<Command, Refusal> {
        let pointer = Pointer { at, alone: true, ..Pointer::default() };
        self.follow(pointer.at, host);
        if let Some(drag) = self.trial.drag.take() {
            drag.release(&mut self.trial, host)?;
        }
        self.take_inserted(host);
        Ok(self.command(host))
    }
}
