//! Ghosts: where else a thing could be, as drawings and in words, each with the command that picks it.

use crate::apply::flat;
use crate::document::Open;
use crate::limits;
use crate::state::State;
use crate::texts::Texts;
use crate::view::{Ghost, GhostMove, Refusal};
use crate::views;
use crate::words;
use crate::write_back::{literal, unit_of_writing};
use kernel::{Command, Path, SlotId, ThingId, Value, Values};
use plan::{EditKind, GhostKind, ModeChange, Target};
use std::collections::BTreeSet;

/// So many values are named in a label.
const NAMED: usize = 3;

/// Returns the ghosts of the thing at a path: each can be picked as it is shown.
///
/// # Errors
/// That the path leads nowhere.
pub(crate) fn view(open: &mut Open, about: &Path) -> Result<Vec<Ghost>, Refusal> {
    let state = open.state.clone();
    let thing = words::find(&state, about)?;
    let mut texts = Texts::new(&state.lowered.document, &state.structure);
    let latest = open.planner.take_latest();
    let found = open.planner.ghosts(state.model(), &state.values, thing, &mut texts);
    let mut ghosts = Vec::new();
    for ghost in found {
        let units = moved(&state, &ghost.values);
        let value = |t: &ThingId| literal(&state, *t, &ghost.values);
        let targets: Vec<(Target<'_>, Vec<Value>)> =
            units.iter().map(|t| (Target::Thing(*t), flat(&value(t)))).collect();
        // what is shown is what picking it comes to
        let mut values = state.values.clone();
        let kind = EditKind::Set;
        let report = open.planner.edit(state.model(), &mut values, kind, &targets, &mut texts);
        if report.refusal.is_none() {
            let path = |t: &ThingId| state.structure.path(&state.lowered.document, *t);
            let picked = units.iter().map(|t| (path(t), value(t))).collect();
            ghosts.push(Ghost {
                label: label(&state, &ghost.kind, thing, &units, &values),
                moves: units.iter().map(|t| told(&state, *t, &values)).collect(),
                picture: views::picture::changed(&state, &values),
                command: Command::Set(picked),
            });
        }
    }
    open.planner.restore_latest(latest);
    Ok(ghosts)
}

/// The places and numbers that are elsewhere.
fn moved(state: &State, values: &Values) -> Vec<ThingId> {
    let changed = state.values.changed(values);
    let units: BTreeSet<ThingId> = changed.map(|slot| unit_of_writing(state, slot)).collect();
    units.into_iter().collect()
}

fn told(state: &State, thing: ThingId, values: &Values) -> GhostMove {
    let path = state.structure.path(&state.lowered.document, thing).to_string();
    GhostMove { path, value: words::show_thing(state, thing, values).unwrap_or_default() }
}

/// Says what is otherwise, and where that leads.
fn label(
    state: &State,
    kind: &GhostKind,
    about: ThingId,
    units: &[ThingId],
    values: &Values,
) -> String {
    let told = units.iter().take(NAMED).map(|&t| told(state, t, values));
    let mut places: Vec<String> = told.map(|m| format!("{} = {}", m.path, m.value)).collect();
    if units.len() > NAMED {
        places.push(format!("{} more", units.len() - NAMED));
    }
    let places = places.join(", ");
    match kind {
        GhostKind::Taken(acting) => {
            match limits::mode(state, ModeChange { acting: *acting, begins: true }) {
                Some(mode) => format!("{}; {places}", mode.message),
                None => places,
            }
        }
        GhostKind::Whole => places,
        GhostKind::Root { reads } => match other_side(state, about, units, reads, values) {
            Some(side) => format!("{side}: {places}"),
            None => places,
        },
    }
}

/// Says that a place, the one asked about or the only one that moves, is on the other side of the line of two
/// that do not.
fn other_side(
    state: &State,
    about: ThingId,
    units: &[ThingId],
    reads: &[SlotId],
    values: &Values,
) -> Option<String> {
    let place = match units {
        [only] => *only,
        _ => units.iter().copied().find(|&unit| unit == about)?,
    };
    let read = reads.iter().filter_map(|&s| state.structure.slots[s].place);
    let read: BTreeSet<ThingId> = read.filter(|other| !units.contains(other)).collect();
    let [from, to] = read.into_iter().collect::<Vec<_>>()[..] else { return None };
    let at = |place: ThingId, values: &Values| -> Option<[f64; 2]> {
        let [x, y] = state.structure.slots_under(place)[..] else { return None };
        Some([values.numbers[x], values.numbers[y]])
    };
    let side = |values: &Values| {
        let ([ax, ay], [bx, by]) = (at(from, values)?, at(to, values)?);
        let [x, y] = at(place, values)?;
        Some((bx - ax) * (y - ay) - (by - ay) * (x - ax))
    };
    let path = |t: ThingId| state.structure.path(&state.lowered.document, t);
    (side(&state.values)? * side(values)? < 0.0)
        .then(|| format!("{} on the other side of {} and {}", path(place), path(from), path(to)))
}
