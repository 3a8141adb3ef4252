//! Lanes: parts that stand between the same two places lie side by side.
//!
//! In: a structure. Out: how far each such part stands beside the straight way, in the number of layout that its class
//! has for that (`layout lane: Length`).

use super::standing;
use kernel::{Document, SlotId, Structure, Values};
use plan::Planner;
use std::collections::BTreeMap;

/// How far lanes lie apart, in units of the sheet: a symbol with its words has room between two.
const LANE: f64 = 48.0;

/// Gives every part that shares both its places with others a lane of its own, in order of declaration.
///
/// The first keeps the straight way; the others stand to its one side and its other in turn. A lane is a number of
/// layout that the part itself has. One that is given, or of which a constraint speaks, stays as it is. Which side is
/// which is told by the first of them alone, and by no place, so that no drag changes it.
pub(super) fn place_in_lanes(
    document: &Document,
    structure: &Structure,
    planner: &Planner,
    values: &mut Values,
) {
    let mut between: BTreeMap<[[SlotId; 2]; 2], Vec<(SlotId, bool)>> = BTreeMap::new();
    for (thing, places) in standing(document, structure) {
        let [from, to] = places[..] else { continue };
        let own = structure.parts(thing).filter_map(|part| structure.slot_of(part));
        let Some(lane) = { own }.find(|&slot| structure.slots[slot].is_layout) else { continue };
        if from != to {
            between.entry([from.min(to), from.max(to)]).or_default().push((lane, from < to));
        }
    }
    for parts in between.into_values().filter(|parts| parts.len() > 1) {
        let is_first_forward = parts[0].1;
        for (n, (slot, is_forward)) in parts.into_iter().enumerate() {
            let s = &structure.slots[slot];
            if s.given.is_none() && !s.anchored && planner.is_lone(slot) {
                let lane = LANE * n.div_ceil(2) as f64;
                let is_other_side = n % 2 == 0;
                let is_negative = is_other_side != (is_forward != is_first_forward);
                // never a negative zero
                values.numbers[slot] = if is_negative { -lane + 0.0 } else { lane };
            }
        }
    }
}
