//! Why a thing does not move, in words.

use crate::document::Open;
use crate::state::State;
use crate::texts::Texts;
use crate::view::HeldView;
use crate::{rules, words};
use kernel::{Path, SlotId};
use plan::Source;

/// What stands in the way of some numbers alike.
#[derive(PartialEq)]
struct Hold {
    constraints: Vec<Source>,
    /// The first coordinate of each anchored place.
    anchors: Vec<SlotId>,
}

/// Says what holds the thing at a path; nothing where it can move, or where there is none.
pub(crate) fn view(open: &mut Open, about: &Path) -> Option<HeldView> {
    let state = open.state.clone();
    let thing = words::find(&state, about).ok()?;
    let slots = state.structure.slots_under(thing);
    let numbers = slots.into_iter().filter(|&s| state.structure.slots[s].primitive.is_number());
    let mut texts = Texts::new(&state.lowered.document, &state.structure);
    let mut holds: Vec<(Hold, Vec<SlotId>)> = Vec::new();
    let mut loose = Vec::new();
    for slot in numbers {
        let Some(by) = open.planner.held(state.model(), &state.values, slot, &mut texts) else {
            loose.push(slot);
            continue;
        };
        let mut hold = Hold { constraints: Vec::new(), anchors: Vec::new() };
        by.constraints.into_iter().for_each(|source| push_new(&mut hold.constraints, source));
        for anchor in by.anchors {
            let place = state.structure.slots[anchor].place;
            let first = place.and_then(|place| state.structure.slots_under(place).first().copied());
            push_new(&mut hold.anchors, first.unwrap_or(anchor));
        }
        match holds.iter_mut().find(|known| known.0 == hold) {
            Some(known) => known.1.push(slot),
            None => holds.push((hold, vec![slot])),
        }
    }
    let whole = |slots: &[SlotId]| words::slots_listed(&state, slots);
    let only = holds.len() == 1 && loose.is_empty();
    let mut sentences = Vec::new();
    for (hold, slots) in &holds {
        let (names, number) =
            if only { (vec![about.to_string()], 1) } else { (whole(slots), whole(slots).len()) };
        let (moves, is) = if number == 1 { ("does", "it is") } else { ("do", "they are") };
        let names = words::listed(&names);
        let by = words::listed(&rules::all_told(&state, &hold.constraints));
        let reason = match (hold.constraints.is_empty(), hold.anchors.is_empty()) {
            (true, _) if slots.iter().all(|&slot| state.is_constant(slot)) => {
                format!("{is} constant")
            }
            (true, _) => format!("{is} anchored"),
            (false, true) => format!("held by {by}"),
            (false, false) => {
                format!("held by {by}, and by {}", held_at(&state, &hold.anchors))
            }
        };
        sentences.push(format!("{names} {moves} not move: {reason}"));
    }
    if sentences.is_empty() {
        return None;
    }
    if !loose.is_empty() {
        sentences.push(format!("{} can move", words::listed(&whole(&loose))));
    }
    let (mut constraints, mut anchors) = (Vec::new(), Vec::new());
    for (hold, _) in holds {
        let names = hold.constraints.iter().filter_map(|&s| words::source_name(&state, s));
        names.for_each(|name| push_new(&mut constraints, name));
        let paths = hold.anchors.iter().map(|&a| state.place_path(a).to_string());
        paths.for_each(|path| push_new(&mut anchors, path));
    }
    Some(HeldView { message: sentences.join("; "), constraints, anchors })
}

/// Names anchored places in a row, constants apart: `the constant g and the anchor of a, b`.
fn held_at(state: &State, anchors: &[SlotId]) -> String {
    let (constants, others): (Vec<SlotId>, Vec<SlotId>) =
        anchors.iter().partition(|&&slot| state.is_constant(slot));
    let names = |slots: &[SlotId]| {
        let names: Vec<String> = slots.iter().map(|&a| state.place_path(a).to_string()).collect();
        words::listed(&names)
    };
    let constant = if constants.len() == 1 { "the constant" } else { "the constants" };
    match (constants.as_slice(), others.as_slice()) {
        ([], others) => format!("the anchor of {}", names(others)),
        (constants, []) => format!("{constant} {}", names(constants)),
        (constants, others) => {
            format!("{constant} {} and the anchor of {}", names(constants), names(others))
        }
    }
}

fn push_new<T: PartialEq>(names: &mut Vec<T>, name: T) {
    if !names.contains(&name) {
        names.push(name);
    }
}
