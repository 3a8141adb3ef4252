//! Room: where on the sheet a thing goes that nobody has placed.

use super::Tool;
use crate::document::Open;
use crate::host::Host;
use crate::view::{Pointer, Refusal};
use drawing::{Bounds, Drawing, Element, Point, bounds};
use kernel::Command;

/// The least distance from what is there already, on the sheet.
const GAP: f64 = 40.0;
/// How many places are tried along a row, and how many rows.
const TRIES: (usize, usize) = (6, 40);

/// Returns the command that inserts a thing of a class where nothing lies yet.
///
/// # Errors
/// There is no such class, or it has no place.
pub(crate) fn insertion(open: &Open, host: &dyn Host, class: &str) -> Result<Command, Refusal> {
    let mut tool = Tool::new(open, host, class)?;
    let elements = &tool.picture.drawing.elements;
    let there: Vec<Bounds> =
        elements.iter().filter_map(|element| around(std::slice::from_ref(element))).collect();
    let origin = Bounds::at(Point { x: 0.0, y: 0.0 });
    let all = around(elements).unwrap_or(origin);
    let own = around(&tool.view().preview.elements).unwrap_or(origin);
    let first = tool.first_place().unwrap_or(Point { x: 0.0, y: 0.0 });
    let (width, height) = (own.width() + GAP, own.height() + GAP);
    let is_empty = there.is_empty();
    let spots = (0..TRIES.1).flat_map(|row| (0..TRIES.0).map(move |column| (column, row)));
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
        false => { spots.map(spot) }.find(is_free).unwrap_or(below),
    };
    tool.place_whole((first.x + by.0, first.y + by.1), host)
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

    /// Sets the whole by its first place, all else as the prototype has it.
    fn place_whole(&mut self, at: (f64, f64), host: &dyn Host) -> Result<Command, Refusal> {
        let pointer = Pointer { at, alone: true, ..Pointer::default() };
        self.follow(pointer.at);
        if let Some(drag) = self.trial.drag.take() {
            drag.release(&mut self.trial, host)?;
        }
        Ok(self.command())
    }
}
