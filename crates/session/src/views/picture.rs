//! The picture: elements with the things that they picture, and what can be gripped.

use crate::state::State;
use crate::view::{Grip, PictureView};
use crate::words;
use kernel::{DOCUMENT, ThingId, Values, Vertical};

/// Returns the picture for some values of a state.
pub(crate) fn picture(state: &State, values: &Values, status: &plan::Status) -> PictureView {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let made = state.evaluator(values).picture(DOCUMENT);
    let mut drawing = made.drawing;
    drawing.vertical = match document.vertical {
        Vertical::Up => drawing::Vertical::Up,
        Vertical::Down => drawing::Vertical::Down,
    };
    // what a view of the structure does not show, cannot be gripped
    let unseen = |part: &ThingId| {
        crate::general::named(state, *part, "structure").is_some_and(|shown| shown.is_empty())
    };
    let unseen: Vec<ThingId> = structure.parts(DOCUMENT).filter(unseen).collect();
    let is_seen = |grip: &&eval::Grip| {
        let owners = std::iter::successors(Some(grip.thing), |&t| structure.things[t].owner);
        unseen.is_empty() || !owners.into_iter().any(|t| unseen.contains(&t))
    };
    let grips = made.grips.iter().filter(is_seen).map(|grip| {
        let slots = structure.slots_under(grip.thing);
        Grip {
            path: structure.path(document, grip.thing).to_string(),
            x: grip.at.x,
            y: grip.at.y,
            anchored: slots.iter().all(|&s| structure.slots[s].anchored),
        }
    });
    PictureView {
        drawing,
        paths: made.things.iter().map(|&t| structure.path(document, t).to_string()).collect(),
        freedom: made.things.iter().map(|&t| words::freedom_of(structure, status, t)).collect(),
        grips: grips.collect(),
    }
}

/// Says why some things have no picture, each reason once.
pub(crate) fn undrawn(state: &State, values: &Values) -> Vec<String> {
    let mut said: Vec<String> = Vec::new();
    for fault in state.evaluator(values).picture(DOCUMENT).faults {
        if !said.contains(&fault.message) {
            said.push(fault.message);
        }
    }
    said
}

/// Returns the elements of a picture that look otherwise with these values than with those of the state.
pub(crate) fn changed(state: &State, values: &Values, status: &plan::Status) -> drawing::Drawing {
    let now = picture(state, &state.values, status).drawing;
    let mut made = picture(state, values, status).drawing;
    made.elements.retain(|element| !now.elements.contains(element));
    made
}

/// Returns a picture as SVG, each element with the path of its thing.
pub(crate) fn svg(picture: &PictureView) -> String {
    let path = |tag: drawing::Tag| picture.paths.get(tag.0 as usize).cloned();
    let options =
        drawing::svg::SvgOptions { pixels_per_unit: 1.0, margin: 16.0, title: None, path: &path };
    drawing::svg::write(&picture.drawing, &options)
}
