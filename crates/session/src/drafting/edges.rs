//! Edges: those that a contour is made of, picked one by one or followed from end to end; and those of contours and
//! regions that are spoken of by what they come from.

use super::Home;
use super::catalogue::{Slot, SlotKind};
use super::scene::{self, Found};
use crate::state::State;
use crate::view::{Pointer, Refusal};
use crate::words;
use geometry::{Source, edges_of};

/// Returns edges with those that go on from their ends, as far as a single one does.
pub(crate) fn followed(state: &State, home: &Home, picked: &[String]) -> Vec<String> {
    let all = edges(state, home);
    let of = |text: &String| all.iter().find(|found| found.text == *text);
    let mut chain: Vec<&Found> = picked.iter().filter_map(of).collect();
    if chain.len() < picked.len() {
        // what is typed leads nowhere by itself
        return picked.to_vec();
    }
    loop {
        let ends = chain.iter().flat_map(|found| found.curve.ends()).flatten();
        let mut open: Vec<[f64; 2]> = Vec::new();
        for end in ends {
            match open.iter().position(|other| is_near(*other, end)) {
                Some(other) => _ = open.remove(other),
                None => open.push(end),
            }
        }
        let next = open.iter().rev().find_map(|&end| {
            let goes_on = |found: &&Found| {
                let is_there = chain.iter().any(|other| other.text == found.text);
                !is_there
                    && found.curve.ends().is_some_and(|ends| ends.iter().any(|e| is_near(*e, end)))
            };
            let mut next = all.iter().filter(goes_on);
            next.next().filter(|_| next.next().is_none())
        });
        match next {
            Some(next) => chain.push(next),
            None => return chain.iter().map(|found| found.text.clone()).collect(),
        }
    }
}

/// Lists the lines and arcs that a contour can be made of.
pub(crate) fn edges(state: &State, home: &Home) -> Vec<Found> {
    let all = scene::scene(state, home).into_iter();
    all.filter(|found| found.side.is_none() && found.curve.ends().is_some()).collect()
}

fn is_near(a: [f64; 2], b: [f64; 2]) -> bool {
    let size = a.iter().chain(&b).fold(0.0, |most: f64, x| most.max(x.abs()));
    base::number::hypot(a[0] - b[0], a[1] - b[1]) <= 1e-9 * size
}

/// Names the edge of a contour or region under a pointer, or its corner, by what it comes from; nothing where no such
/// edge lies there, or a slot wants none.
///
/// # Errors
/// It comes from nothing that has a name here.
pub(crate) fn by_origin(
    state: &State,
    slot: &Slot,
    all: &[Found],
    pointer: &Pointer,
) -> Option<Result<String, Refusal>> {
    let document = &state.lowered.document;
    let class_of =
        |found: &Found| document.class_named(if found.side?.bulge == 0.0 { "Line" } else { "Arc" });
    let fits = |found: &&Found| match slot.kind {
        SlotKind::Curve => class_of(found).is_some_and(|class| slot.takes(state, class)),
        SlotKind::Point => found.corner_at(pointer).is_some(),
        SlotKind::Edges | SlotKind::Set | SlotKind::Value => false,
    };
    // what was drawn last lies above
    let found =
        scene::nearest(all.iter().rev().filter(|f| f.side.is_some()).filter(fits), pointer)?;
    let corner = match slot.kind {
        SlotKind::Point => found.corner_at(pointer),
        _ => None,
    };
    let none = || {
        let message =
            format!("this edge of {} comes from nothing that has a name here", found.text);
        words::refuse(message)
    };
    let edge = named(all, found).ok_or_else(none);
    Some(edge.map(|(edge, is_reversed)| match (corner, found.side) {
        (Some(at_end), Some(side)) => {
            let ends = if side.bulge == 0.0 { ["p1", "p2"] } else { ["start", "end"] };
            format!("{edge}.{}", ends[usize::from(at_end != is_reversed)])
        }
        _ => edge,
    }))
}

/// An edge as it is written by what it comes from, and whether it runs the other way then.
fn named(all: &[Found], edge: &Found) -> Option<(String, bool)> {
    let side = edge.side?;
    let sides: Vec<_> = all.iter().filter(|f| f.text == edge.text).filter_map(|f| f.side).collect();
    let sources = all.iter().filter(|found| found.side.is_none() && !found.is_place);
    let named = sources.filter_map(|found| {
        let edges = edges_of(&sides, &source(found)?);
        let at = edges.iter().position(|other| other.is_one_with(&side))?;
        Some((found, edges, at))
    });
    // of several that it could come from the one that fewest edges come from, then the first
    let (found, edges, at) = { named }.min_by_key(|(_, edges, _)| edges.len())?;
    let is_reversed = match side.bulge == 0.0 {
        true => !edges[at].runs_as(&side),
        // an arc that is found runs to the left
        false => side.bulge < 0.0,
    };
    let class = if side.bulge == 0.0 { "Line" } else { "Arc" };
    let nth = if edges.len() > 1 { format!(", nth: {at}") } else { String::new() };
    let text = format!("{class}.edge(of: {}, from: {}{nth})", edge.text, found.text);
    Some((text, is_reversed))
}

/// What edges can come from a figure.
fn source(found: &Found) -> Option<Source> {
    found.curve.source()
}
