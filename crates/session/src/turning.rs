//! An angle that is told turns a line: the line stays as long as it was, and the end that it hangs by stays.
//!
//! In: a document that holds, and a command that tells the angle between two straight things, or the direction of one.
//! Out: the text that says so, with the far end turned to where it then lies. Solved from where the things are, the end
//! would come to the nearest place in the new direction, which may leave a stump of the line. Nothing where no line can
//! be turned so: then the command alone is the answer.

use crate::apply;
use crate::document::Open;
use crate::drag::coordinates;
use crate::host::Host;
use crate::session::{parse_path, thing_at};
use crate::state::State;
use crate::texts::Texts;
use crate::write_back::{Edited, write_back};
use base::Name;
use base::number::{atan2, close, cos, hypot, sin};
use kernel::{Command, DOCUMENT, Path, SlotId, Step, ThingId, Value, Values};
use plan::Plans;

type Place = (f64, f64);

/// What the number of an offer is called that says which way something runs.
const ANGLES: [&str; 4] = ["angle", "supplement", "direction", "ruling angle"];

/// Whether an offer of a name tells an angle.
pub(crate) fn is_angle(label: &str) -> bool {
    ANGLES.contains(&label)
}

/// A straight thing that an angle is told of.
struct Side {
    ends: [Path; 2],
    /// Where its ends are before the angle is told.
    was: [Place; 2],
    /// Where they come to where each goes to the nearest place.
    nearest: [Place; 2],
}

/// An end that is turned about the other one of its side.
struct Way<'s> {
    side: &'s Side,
    /// Which of the two ends.
    far: usize,
    /// How far, in radians.
    by: f64,
}

/// Returns the command that says the same and turns a line of those that `members` speak of.
pub(crate) fn turned(
    open: &Open,
    host: &dyn Host,
    members: &str,
    command: &Command,
) -> Option<Command> {
    let before = &open.state;
    let text = match command {
        Command::Text(text) => text.clone(),
        command => {
            let edits = apply::restructuring(before, command).ok()?.edits;
            syntax::edit::apply(&before.text, &edits)
        }
    };
    let paths = straight(before, members);
    let (mut state, mut planner) = State::of(text, Some(before), host, Plans::default());
    if state.has_errors() || !open.status.satisfied || !state.status(&mut planner).satisfied {
        return None;
    }
    let sides: Option<Vec<Side>> = paths.iter().map(|path| side(before, &state, path)).collect();
    let sides = sides?;
    let stands = as_before(before, &state);
    for way in ways(before, &sides) {
        let mut values = stands.clone();
        put(&state, &mut values, &way.side.ends[way.far], way.to())?;
        let mut texts = Texts::new(&state.lowered.document, &state.structure);
        let holds = planner.satisfy_since(state.model(), &state.values, &mut values, &mut texts);
        if !holds || !sides.iter().all(|side| is_as_long(&state, &values, side)) {
            continue;
        }
        let edited = Edited { by_hand: Some(Vec::new()), ..Edited::default() };
        (state, planner) = write_back(&state, &values, &edited, host, planner.into_plans());
        let is_said = !state.has_errors()
            && state.status(&mut planner).satisfied
            && sides.iter().all(|side| is_as_long(&state, &state.values, side));
        return is_said.then(|| Command::Text(state.text.clone()));
    }
    None
}

/// Returns the straight things that a member speaks of, the one that was drawn last at the end.
fn straight(state: &State, members: &str) -> Vec<Path> {
    let words = members.split(|c: char| !(c.is_alphanumeric() || "_.[]".contains(c)));
    let mut found: Vec<(ThingId, Path)> = Vec::new();
    for path in words.filter_map(parse_path) {
        let whole = (1..=path.0.len()).rev().find_map(|n| {
            let path = Path(path.0[..n].to_vec());
            let thing = thing_at(state, &path)?;
            is_straight(state, thing).then_some((thing, path))
        });
        found.extend(whole);
    }
    found.sort();
    found.dedup();
    found.into_iter().map(|(_, path)| path).collect()
}

fn is_straight(state: &State, thing: ThingId) -> bool {
    let document = &state.lowered.document;
    let class = document.class_named("Straight");
    class.is_some_and(|of| document.is_a(state.structure.things[thing].class, of))
}

/// Returns a straight thing that has places for its ends.
fn side(before: &State, after: &State, path: &Path) -> Option<Side> {
    let ends = ["p1", "p2"].map(|name| path.then(Step::Part(Name::new(name))));
    let places = |state: &State| {
        Some([place(state, &state.values, &ends[0])?, place(state, &state.values, &ends[1])?])
    };
    let (was, nearest) = (places(before)?, places(after)?);
    Some(Side { ends, was, nearest })
}

/// The slots of a place.
fn slots(state: &State, path: &Path) -> Option<[SlotId; 2]> {
    let thing = state.structure.follow(DOCUMENT, path).ok()?;
    Some(coordinates(&state.structure, thing)?.map(|(_, slot)| slot))
}

fn place(state: &State, values: &Values, path: &Path) -> Option<Place> {
    let [x, y] = slots(state, path)?;
    Some((values.numbers[x], values.numbers[y]))
}

fn put(state: &State, values: &mut Values, path: &Path, (x, y): Place) -> Option<()> {
    let [of_x, of_y] = slots(state, path)?;
    values.put(of_x, Value::Number(x));
    values.put(of_y, Value::Number(y));
    Some(())
}

/// The values of a state, as they were before where the same is there.
fn as_before(before: &State, after: &State) -> Values {
    let mut values = after.values.clone();
    for slot in after.structure.slots.ids() {
        let thing = before.structure.follow(DOCUMENT, &after.slot_path(slot)).ok();
        if let Some(was) = thing.and_then(|thing| before.structure.slot_of(thing)) {
            values.put(slot, before.values.get(was));
        }
    }
    values
}

/// Which ends may be turned, the likeliest first: one to which nothing is joined, of what was drawn last.
fn ways<'s>(state: &State, sides: &'s [Side]) -> Vec<Way<'s>> {
    let mut ways = match sides {
        [one] => Vec::from([1, 0].map(|far| Way { side: one, far, by: one.turn() })),
        [a, b] => {
            let by = b.turn() - a.turn();
            let apart = |&(i, j): &(usize, usize)| distance(a.was[i], b.was[j]);
            let pairs = [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter();
            let corner = pairs.min_by(|one, other| apart(one).total_cmp(&apart(other)));
            let (i, j) = corner.unwrap_or_default();
            vec![Way { side: b, far: 1 - j, by }, Way { side: a, far: 1 - i, by: -by }]
        }
        _ => Vec::new(),
    };
    let is_held = |way: &Way<'_>| {
        let slots = slots(state, &way.side.ends[way.far]);
        slots.is_some_and(|slots| slots.iter().any(|&slot| state.structure.slots[slot].anchored))
    };
    ways.retain(|way| !close(way.by, 0.0) && !is_held(way));
    ways.sort_by_key(|way| is_joined(state, &way.side.ends[way.far]));
    ways
}

fn is_joined(state: &State, path: &Path) -> bool {
    let thing = thing_at(state, path);
    thing.is_some_and(|thing| state.structure.merged_with(thing).len() > 1)
}

impl Side {
    /// How far it has turned.
    fn turn(&self) -> f64 {
        direction(self.nearest) - direction(self.was)
    }
}

impl Way<'_> {
    /// Where the end comes to.
    fn to(&self) -> Place {
        let (end, about) = (self.side.was[self.far], self.side.was[1 - self.far]);
        let (dx, dy) = (end.0 - about.0, end.1 - about.1);
        let (cosine, sine) = (cos(self.by), sin(self.by));
        (about.0 + cosine * dx - sine * dy, about.1 + sine * dx + cosine * dy)
    }
}

fn is_as_long(state: &State, values: &Values, side: &Side) -> bool {
    let ends = (place(state, values, &side.ends[0]), place(state, values, &side.ends[1]));
    matches!(ends, (Some(a), Some(b)) if close(distance(a, b), distance(side.was[0], side.was[1])))
}

fn distance(a: Place, b: Place) -> f64 {
    hypot(b.0 - a.0, b.1 - a.1)
}

fn direction([a, b]: [Place; 2]) -> f64 {
    atan2(b.1 - a.1, b.0 - a.0)
}
