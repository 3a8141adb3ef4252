//! Where two curves cross under a pointer: a place that follows them is meant there, not one of the sheet.

use super::dialogue::Operand;
use super::outcome::{self, Chosen};
use super::scene::Found;
use super::{Home, catalogue};
use crate::state::State;
use crate::view::Pointer;

/// The construction of the place.
const TOOL: &str = "Point.intersection(first,second)";

/// How many of the nearest curves are tried with one another: of two that cover each other a third one may cross both.
const TRIED: usize = 4;

/// Returns the intersection of two curves that a pointer is at; nothing where none is within its reach, or the pointer
/// is to be left alone.
pub(super) fn at(state: &State, home: &Home, all: &[Found], pointer: &Pointer) -> Option<Chosen> {
    if pointer.alone {
        return None;
    }
    let is_curve = |f: &&Found| !f.curve.is_point() && f.side.is_none();
    let away = |f: &Found| f.curve.distance(pointer.at);
    let near = all.iter().filter(is_curve).map(|f| (away(f), f));
    let mut near: Vec<(f64, &Found)> = near.filter(|(away, _)| *away <= pointer.reach).collect();
    if near.len() < 2 {
        return None;
    }
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
    let tool = catalogue::tool(state, home, TOOL)?;
    near.retain(|(_, f)| tool.slots.first().is_some_and(|slot| slot.takes(state, f.class)));
    near.truncate(TRIED);
    let pairs = (1..near.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
    let operand = |i: usize| Operand::new(near[i].1.text.clone(), None);
    let mut crossings = pairs.filter_map(|(a, b)| {
        let given = (&tool, &[operand(a), operand(b)][..], Some(pointer.at), 0);
        outcome::choose(state, home, given).ok()
    });
    let is_here = |chosen: &Chosen| {
        chosen.curve.is_some_and(|curve| curve.distance(pointer.at) <= pointer.reach)
    };
    crossings.find(is_here)
}
