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

/// Two coordinates of a place.
type Place = [SlotId; 2];

/// Gives every part that shares both its places with others a lane of its own, in order of declaration.
///
/// The first keeps the straight way; the others stand to its one side and its other in turn, first where less of what
/// hangs together with both places is. A lane is a number of layout that the part itself has. One that is given, or of
/// which a constraint speaks, stays as it is.
pub(super) fn place_in_lanes(
    document: &Document,
    structure: &Structure,
    planner: &Planner,
    values: &mut Values,
) {
    let mut between: BTreeMap<[Place; 2], Vec<(SlotId, bool)>> = BTreeMap::new();
    for (thing, places) in standing(document, structure) {
        let [from, to] = places[..] else { continue };
        let own = structure.parts(thing).filter_map(|part| structure.slot_of(part));
        let Some(lane) = { own }.find(|&slot| structure.slots[slot].is_layout) else { continue };
        if from != to {
            between.entry([from.min(to), from.max(to)]).or_default().push((lane, from < to));
        }
    }
    let mut beside: BTreeMap<Place, Vec<Place>> = BTreeMap::new();
    for &[a, b] in between.keys() {
        beside.entry(a).or_default().push(b);
        beside.entry(b).or_default().push(a);
    }
    for ([least, most], parts) in between.into_iter().filter(|(_, parts)| parts.len() > 1) {
        let is_first_forward = parts[0].1;
        let way = if is_first_forward { [least, most] } else { [most, least] };
        let is_turned = is_crowded(way, &beside, values);
        for (n, (slot, is_forward)) in parts.into_iter().enumerate() {
            let s = &structure.slots[slot];
            if s.given.is_none() && !s.anchored && planner.is_lone(slot) {
                let lane = LANE * n.div_ceil(2) as f64;
                let is_other_side = (n % 2 == 0) != is_turned;
                let is_negative = is_other_side != (is_forward != is_first_forward);
                // never a negative zero
                values.numbers[slot] = if is_negative { -lane + 0.0 } else { lane };
            }
        }
    }
}

/// Returns true where what hangs together with the ends of a way lies on the side to which its lanes count, on the whole.
fn is_crowded(way: [Place; 2], beside: &BTreeMap<Place, Vec<Place>>, values: &Values) -> bool {
    let at = |place: Place| place.map(|slot| values.numbers[slot]);
    let [[x, y], [to_x, to_y]] = way.map(at);
    let side = |&place: &Place| {
        let [a, b] = at(place);
        (to_x - x) * (b - y) - (to_y - y) * (a - x)
    };
    let others = way.iter().flat_map(|end| &beside[end]).filter(|place| !way.contains(place));
    others.map(side).sum::<f64>() > 0.0
}
