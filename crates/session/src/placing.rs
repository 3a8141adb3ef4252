//! Placing: where the new parts of a class are in the things that there are already.
//!
//! What constraints or merges determine is where these want it. Any other place is as far from its
//! neighbour as in the prototype: the neighbour is the prototype's nearest place that is given. A thing
//! that lies where its prototype does needs nothing; for any other the place is given in its own text.
//!
//! What a class only draws with (`layout at: Point`) and nobody gives is put where there is room when a document is
//! opened, along the parts that stand between such places. Parts that share both places stand side by side
//! (`placing/lanes.rs`).

mod gridded;
mod lanes;
mod linked;

use crate::document::Open;
use crate::host::Host;
use crate::joining;
use crate::prototype::Lone;
use crate::state::State;
use crate::texts::Texts;
use crate::tools::stages;
use crate::write_back::{Edited, differing, write_back};
use base::number::{close, hypot};
use kernel::{
    ClassId, DOCUMENT, Document, Path, SlotId, Structure, ThingId, Value, Values, Vertical,
};
use plan::{EditKind, Planner, SlotState, Target};
use std::collections::{BTreeMap, BTreeSet};

/// A place of a new part, and the place that it is put beside.
struct Place {
    path: Path,
    neighbour: Path,
    /// From the neighbour to the place, in the prototype.
    offset: Vec<f64>,
}

/// Puts the parts that a class has got since `before` into their places.
pub(crate) fn place_new_parts(
    before: &State,
    state: State,
    mut planner: Planner,
    class: &str,
    host: &dyn Host,
) -> (State, Planner) {
    let places = new_places(before, &state, class).unwrap_or_default();
    if places.is_empty() {
        return (state, planner);
    }
    let status = state.status(&mut planner);
    let free = |slot: SlotId| {
        let given = state.structure.given(slot);
        status.slots[slot] == SlotState::Free
            && !given.is_some_and(|g| state.lowered.is_own_given(g.origin))
    };
    let document = &state.lowered.document;
    let Some(class) = document.class_named(class) else { return (state, planner) };
    let is_of_class = |t: &ThingId| document.is_a(state.structure.things[*t].class, class);
    let things: Vec<ThingId> = state.structure.things.ids().filter(is_of_class).collect();
    let mut targets: Targets<'_> = Vec::new();
    for place in &places {
        let mut own: Targets<'_> = Vec::new();
        for &thing in &things {
            let at = state.structure.follow(thing, &place.path);
            let neighbour = state.structure.follow(thing, &place.neighbour);
            let (Ok(at), Ok(neighbour)) = (at, neighbour) else { continue };
            let slots = state.structure.slots_under(at);
            let is_alone = !state.structure.is_merged(at);
            let now = coordinates(&state.structure, &state.values, at);
            let near = coordinates(&state.structure, &state.values, neighbour);
            let to: Vec<f64> = near.iter().zip(&place.offset).map(|(a, b)| a + b).collect();
            let is_there = now.iter().zip(&to).all(|(a, b)| close(*a, *b));
            if is_alone && !is_there && slots.iter().all(|&s| free(s)) {
                own.push((Target::Thing(at), to.into_iter().map(Value::Number).collect()));
            }
        }
        // where the first drags others along, constraints determine the place
        let first = own.first().map(std::slice::from_ref);
        if first.is_some_and(|first| moved_alone(&state, &mut planner, first).is_some()) {
            targets.extend(own);
        }
    }
    match moved_alone(&state, &mut planner, &targets) {
        Some(values) if !targets.is_empty() => {
            let edited = Edited { slots: slots_of(&state, &targets), ..Edited::default() };
            write_back(&state, &values, &edited, host, planner.into_plans())
        }
        Some(_) | None => (state, planner),
    }
}

/// How far the spots for places without a place lie apart, in units of the sheet.
const APART: f64 = 100.0;
/// A sheet is looked at in squares of this side: in one with a place that is given, and next to it, is no room.
const ROOM: f64 = 50.0;

/// Puts every place of layout that neither is given nor is spoken of by a constraint on a spot of its own, where none
/// that is given lies near.
///
/// Places between which parts stand (two attachers of one thing) are laid out along these, and compared with each other
/// where they are few. All others lie on a spiral as the seeds of a sunflower do: evenly apart, and hardly ever three in a line.
/// Of these, those declared later come later, so that a new one moves none that was there.
/// **Source:** Vogel, *A better way to construct the sunflower head*, Math. Biosci. 44 (1979).
pub(crate) fn place_layout(
    document: &Document,
    structure: &Structure,
    planner: &Planner,
    values: &mut Values,
) {
    place_open(document, structure, planner, values);
    lanes::place_in_lanes(document, structure, planner, values);
}

/// Puts every such place on its spot.
fn place_open(document: &Document, structure: &Structure, planner: &Planner, values: &mut Values) {
    let places: Vec<[SlotId; 2]> = structure
        .slots
        .iter()
        .filter(|(_, slot)| slot.is_layout)
        .filter_map(|(id, slot)| {
            let own = structure.slots_under(slot.place?);
            <[SlotId; 2]>::try_from(own).ok().filter(|own| own[0] == id)
        })
        .collect();
    let is_open = |slot: &SlotId| {
        let s = &structure.slots[*slot];
        s.given.is_none() && !s.anchored && planner.is_lone(*slot)
    };
    let (open, taken): (Vec<_>, Vec<_>) = places.into_iter().partition(|p| p.iter().all(is_open));
    if open.is_empty() {
        return;
    }
    let mut taken: Vec<[f64; 2]> =
        taken.iter().map(|p| p.map(|slot| values.numbers[slot])).collect();
    let placed = place_linked(document, structure, &open, values);
    taken.extend(open.iter().filter(|p| placed.contains(*p)).map(|p| p.map(|s| values.numbers[s])));
    let cell = |at: [f64; 2]| at.map(|x| (x / ROOM).floor() as i64);
    let taken: BTreeSet<[i64; 2]> = taken.into_iter().map(cell).collect();
    let has_room = |at: &[f64; 2]| {
        let [x, y] = cell(*at);
        let mut around = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [i, j]));
        around.all(|[i, j]| !taken.contains(&[x.saturating_add(i), y.saturating_add(j)]))
    };
    let mut spots = (0..).map(spot).filter(has_room);
    for [x, y] in open.into_iter().filter(|p| !placed.contains(p)) {
        let Some([at_x, at_y]) = spots.next() else { return };
        (values.numbers[x], values.numbers[y]) = (at_x, at_y);
    }
}

/// Puts open places that hang together by things with several attachers along these things; returns which.
fn place_linked(
    document: &Document,
    structure: &Structure,
    open: &[[SlotId; 2]],
    values: &mut Values,
) -> BTreeSet<[SlotId; 2]> {
    let down = if document.vertical == Vertical::Up { -STEP } else { STEP };
    let open: BTreeSet<[SlotId; 2]> = open.iter().copied().collect();
    let (links, hanging) = links(document, structure);
    let mut placed = BTreeSet::new();
    // those without a given place stand in rows below all that is given
    let mut row = given_below(structure, &open, values, down);
    let (mut left, mut next_row) = (0.0, row);
    for group in groups(&links, &open) {
        let given = |p: &[SlotId; 2]| {
            let at = p.map(|slot| values.numbers[slot]);
            (!open.contains(p)).then_some([at[0] / STEP, at[1] / down])
        };
        let index = |p: &[SlotId; 2]| group.places.binary_search(p).ok();
        let net = linked::Net {
            given: group.places.iter().map(given).collect(),
            links: group.links.iter().filter_map(|[a, b]| Some([index(a)?, index(b)?])).collect(),
            hanging: hanging.iter().filter_map(index).collect(),
        };
        let mut cells = match net.given.len() {
            many if many > gridded::MOST => continue,
            many if many > linked::MOST => gridded::gridded(&net, 2.0 * ROW),
            _ => linked::arranged(&net),
        };
        if net.given.iter().all(Option::is_none) {
            let most = |axis: usize| cells.iter().fold(0.0, |most: f64, cell| most.max(cell[axis]));
            let (width, height) = (most(0), most(1));
            if left > 0.0 && left + width > ROW {
                (left, row, next_row) = (0.0, next_row, next_row);
            }
            cells.iter_mut().for_each(|cell| *cell = [cell[0] + left, cell[1] + row]);
            left += width + 2.0;
            next_row = next_row.max(row + height + 2.0);
        }
        for (place, [column, line]) in group.places.iter().zip(cells) {
            if open.contains(place) {
                let [x, y] = *place;
                // never a negative zero
                values.numbers[x] = (column * STEP).round() + 0.0;
                values.numbers[y] = (line * down).round() + 0.0;
                placed.insert(*place);
            }
        }
    }
    placed
}

/// How far columns and rows of places lie apart that hang together: a symbol with its words has room between.
const STEP: f64 = 120.0;
/// How many columns wide the rows of groups are that hang together with nothing given.
const ROW: f64 = 12.0;

/// Returns the first free row below all places that are given.
fn given_below(
    structure: &Structure,
    open: &BTreeSet<[SlotId; 2]>,
    values: &Values,
    down: f64,
) -> f64 {
    let places = structure.slots.iter().filter(|(_, slot)| slot.place.is_some());
    let given = places.filter_map(|(id, slot)| {
        let own = <[SlotId; 2]>::try_from(structure.slots_under(slot.place?)).ok()?;
        (own[0] == id && !open.contains(&own)).then_some(values.numbers[own[1]] / down)
    });
    let lowest = given.fold(None, |lowest: Option<f64>, y| Some(lowest.map_or(y, |l| l.max(y))));
    lowest.map_or(0.0, |lowest| lowest.ceil() + 2.0)
}

/// Two places between which a part stands.
type Link = [[SlotId; 2]; 2];

/// Returns the places of layout between which things stand, thing after thing, and those at which one stands alone.
fn links(document: &Document, structure: &Structure) -> (Vec<Link>, BTreeSet<[SlotId; 2]>) {
    let (mut links, mut hanging) = (Vec::new(), BTreeSet::new());
    for (_, places) in standing(document, structure) {
        if let [only] = places[..] {
            hanging.insert(only);
        }
        links.extend(places.windows(2).filter(|two| two[0] != two[1]).map(|two| [two[0], two[1]]));
    }
    (links, hanging)
}

/// Returns what sticks to places of layout, in order of declaration, with these places.
fn standing(
    document: &Document,
    structure: &Structure,
) -> impl Iterator<Item = (ThingId, Vec<[SlotId; 2]>)> {
    let mut attachers: BTreeMap<ClassId, &[Path]> = BTreeMap::new();
    structure.things.iter().filter_map(move |(id, thing)| {
        let paths = attachers
            .entry(thing.class)
            .or_insert_with(|| joining::attachers(document, thing.class));
        if paths.is_empty() || structure.identity(id) != id {
            return None;
        }
        let place = |path: &Path| {
            let slots = stages::coordinates_in(structure, structure.follow(id, path).ok()?)?;
            slots.iter().all(|&slot| structure.slots[slot].is_layout).then_some(slots)
        };
        Some((id, paths.iter().filter_map(place).collect()))
    })
}

/// Places that hang together, in order, and the links between them.
struct Group {
    places: Vec<[SlotId; 2]>,
    links: Vec<Link>,
}

/// Returns what hangs together by links through open places, in the order of its first links.
fn groups(links: &[Link], open: &BTreeSet<[SlotId; 2]>) -> Vec<Group> {
    let mut at: BTreeMap<[SlotId; 2], Vec<usize>> = BTreeMap::new();
    for (n, link) in links.iter().enumerate() {
        link.iter().for_each(|place| at.entry(*place).or_default().push(n));
    }
    let mut is_met = vec![false; links.len()];
    let mut groups = Vec::new();
    for first in 0..links.len() {
        let mut waiting = vec![first];
        let (mut own, mut places) = (BTreeSet::new(), BTreeSet::new());
        while let Some(link) = waiting.pop() {
            let is_of_it = links[link].iter().any(|place| open.contains(place));
            if is_of_it && !std::mem::replace(&mut is_met[link], true) {
                own.insert(link);
                for place in links[link] {
                    let is_new = places.insert(place) && open.contains(&place);
                    waiting.extend(at[&place].iter().filter(|_| is_new));
                }
            }
        }
        if !own.is_empty() {
            let links = own.into_iter().map(|link| links[link]).collect();
            groups.push(Group { places: places.into_iter().collect(), links });
        }
    }
    groups
}

/// The `k`th spot, to whole units.
fn spot(k: u32) -> [f64; 2] {
    /// The golden angle, in radians.
    const TURN: f64 = 2.399_963_229_728_653;
    let (k, away) = (f64::from(k), APART * base::number::sqrt(f64::from(k)));
    let (x, y) = (away * base::number::cos(k * TURN), away * base::number::sin(k * TURN));
    // whole, and never a negative zero
    [x.round() + 0.0, y.round() + 0.0]
}

/// Has the text say where a place of layout is that was put where it would be anyway: with other things about, it
/// would be elsewhere.
pub(crate) fn say_layout(open: &mut Open, host: &dyn Host, path: &Path) {
    let state = open.state.clone();
    let Ok(place) = state.structure.follow(DOCUMENT, path) else { return };
    let is_unsaid =
        |s: &SlotId| state.structure.slots[*s].is_layout && state.structure.given(*s).is_none();
    let slots: Vec<SlotId> =
        state.structure.slots_under(place).into_iter().filter(is_unsaid).collect();
    if slots.is_empty() {
        return;
    }
    let by_hand = Some(slots.iter().map(|&slot| state.values.numbers[slot]).collect());
    let plans = open.planner.take_plans();
    let edited = Edited { slots, by_hand };
    let (next, planner) = write_back(&state, &state.values, &edited, host, plans);
    open.step_to(format!("move {path}"), Vec::new(), next, planner);
}

/// Has the text give places of layout that a command would move which is about something else.
pub(crate) fn keep_layout(
    before: &State,
    state: State,
    planner: Planner,
    host: &dyn Host,
) -> (State, Planner) {
    // what a constraint speaks of is where that wants it
    let is_open = |slot: &SlotId| state.structure.given(*slot).is_none() && planner.is_lone(*slot);
    // a lane is told by what shares both places, which the command may be about
    let layout =
        state.structure.slots.iter().filter(|(_, slot)| slot.is_layout && slot.place.is_some());
    let open: Vec<SlotId> = layout.map(|(id, _)| id).filter(is_open).collect();
    if open.is_empty() {
        return (state, planner);
    }
    let mut values = state.values.clone();
    for slot in open {
        let was = before.structure.follow(DOCUMENT, &state.slot_path(slot)).ok();
        if let Some(was) = was.and_then(|thing| before.structure.slot_of(thing)) {
            values.put(slot, before.values.get(was));
        }
    }
    let slots: Vec<SlotId> = differing(&state, &values).collect();
    if slots.is_empty() {
        return (state, planner);
    }
    write_back(&state, &values, &Edited { slots, ..Edited::default() }, host, planner.into_plans())
}

/// What is moved, and where to.
type Targets<'t> = Vec<(Target<'t>, Vec<Value>)>;

/// Moves places; nothing if that is refused or moves anything else.
fn moved_alone(
    state: &State,
    planner: &mut Planner,
    targets: &[(Target<'_>, Vec<Value>)],
) -> Option<Values> {
    let mut values = state.values.clone();
    let mut texts = Texts::new(&state.lowered.document, &state.structure);
    let kind = EditKind::Move;
    let report = planner.edit(state.model(), &mut values, kind, targets, &mut texts);
    let own = slots_of(state, targets);
    let is_alone = values.changed(&state.values).all(|slot| own.binary_search(&slot).is_ok());
    (report.refusal.is_none() && is_alone).then_some(values)
}

/// Returns the slots of what is moved, in order.
fn slots_of(state: &State, targets: &[(Target<'_>, Vec<Value>)]) -> Vec<SlotId> {
    let slots = |(target, _): &(Target<'_>, Vec<Value>)| match target {
        Target::Thing(thing) => state.structure.slots_under(*thing),
        Target::Term { .. } => Vec::new(),
    };
    let mut all: Vec<SlotId> = targets.iter().flat_map(slots).collect();
    all.sort_unstable();
    all
}

/// Finds the places of a class's new parts, and what they lie beside in the prototype.
fn new_places(before: &State, state: &State, class: &str) -> Option<Vec<Place>> {
    let document = &state.lowered.document;
    let id = document.class_named(class)?;
    let old = before.lowered.document.class_named(class)?;
    let had = |name: &base::Name| {
        before.lowered.document.classes[old].parts.iter().any(|p| p.name == *name)
    };
    let new: Vec<&base::Name> =
        document.classes[id].parts.iter().map(|p| &p.name).filter(|n| !had(n)).collect();
    if new.is_empty() {
        return None;
    }
    let lone = Lone::of(document, id)?;
    let (values, _) = eval::given_values(&lone.document, &lone.structure);
    let all = places_under(&lone);
    let is_new = |path: &Path| match path.0.first() {
        Some(kernel::Step::Part(name)) => new.contains(&name),
        Some(_) | None => false,
    };
    let is_given = |thing: ThingId| {
        let slots = lone.structure.slots_under(thing);
        slots.iter().all(|&s| lone.structure.slots[s].given.is_some())
    };
    let at = |thing: ThingId| coordinates(&lone.structure, &values, thing);
    let beside = |(path, thing): &(Path, ThingId)| {
        let here = at(*thing);
        let distance = |other: ThingId| {
            let there = at(other);
            here.iter().zip(&there).fold(0.0, |d, (a, b)| hypot(d, a - b))
        };
        let given =
            all.iter().filter(|(p, t)| !is_new(p) && is_given(*t) && at(*t).len() == here.len());
        let nearest = given.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)))?;
        let offset = here.iter().zip(at(nearest.1)).map(|(a, b)| a - b).collect();
        Some(Place { path: path.clone(), neighbour: nearest.0.clone(), offset })
    };
    Some(all.iter().filter(|(path, _)| is_new(path)).filter_map(beside).collect())
}

/// Returns every place of a lone thing, by its path from the thing.
fn places_under(lone: &Lone) -> Vec<(Path, ThingId)> {
    let mut places = Vec::new();
    let mut waiting = vec![lone.thing];
    while let Some(thing) = waiting.pop() {
        if lone.document.is_place(lone.structure.things[thing].class) {
            let path = lone.structure.path(&lone.document, thing);
            places.push((Path(path.0[1..].to_vec()), thing));
        } else {
            waiting.extend(lone.structure.parts(thing).rev());
        }
    }
    places
}

fn coordinates(structure: &Structure, values: &Values, thing: ThingId) -> Vec<f64> {
    structure.slots_under(thing).into_iter().map(|s| values.numbers[s]).collect()
}
