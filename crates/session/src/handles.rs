//! Handles: places by which a hand changes a thing while others of it stay, as its class declares them. The corner of
//! a rectangle resizes it, since the one opposite stays.
//!
//! Dragged across what stays, a thing is not turned inside out: the handle that lies there is held instead. The corner
//! at the upper right becomes the one at the upper left, and the width is positive again. Where that one is locked, or
//! joined to something else, the handle stops where the thing is flat.

use crate::apply::Aim;
use crate::by_hand::class_at;
use crate::drag::{coordinates, numbers_of};
use crate::prototype::Lone;
use crate::session::thing_at;
use crate::state::State;
use eval::{Answer, Evaluator};
use kernel::{DOCUMENT, Handle, Path, SlotId, Step, Structure, Term, ThingId, Values};
use plan::{EditReport, Host, Planner, Press, Target};
use std::cell::LazyCell;
use std::collections::BTreeSet;

/// How often the way to where a thing is flat is halved.
const HALVINGS: usize = 40;

/// A handle and what it keeps.
#[derive(Clone)]
struct Way {
    dragged: Path,
    keeps: Vec<Path>,
    /// Of a handle that keeps one place, on which side of that it lies: the sign of each coordinate.
    side: Vec<i8>,
}

/// What stays while a handle is dragged.
pub(crate) struct Keeping {
    /// The things whose handle it is: of merged corners several.
    wholes: Vec<Path>,
    /// Its handles; the first is the one that was pressed.
    ways: Vec<Way>,
    /// Which of them is held.
    present: usize,
    /// Where what stays was at the press.
    stays: Vec<f64>,
    /// Whether the handle stopped where the thing is flat, as of the last event.
    is_flat: bool,
    /// The values at the press.
    start: Values,
}

/// Finds out what stays while something is dragged. Nothing where it is no handle.
pub(crate) fn keeping(state: &State, path: &Path, aim: &Aim) -> Option<Keeping> {
    let mut names = vec![path.clone()];
    if let Aim::Thing(thing) = aim {
        let merged = state.structure.merged_with(*thing).into_iter();
        names.extend(merged.map(|t| state.structure.path(&state.lowered.document, t)));
    }
    let mut ways: Vec<Way> = Vec::new();
    let mut wholes: Vec<Path> = Vec::new();
    for name in &names {
        for (whole, way) in ways_at(state, name) {
            if !wholes.contains(&whole) {
                // what is merged as a whole is one, whatever it is called
                wholes.extend(names_of(state, &whole));
                ways.push(way);
            }
        }
    }
    let (first, whole) = (ways.first()?.clone(), wholes.first()?.clone());
    let others: Vec<Path> = ways.iter().skip(1).flat_map(|way| way.keeps.clone()).collect();
    let ways = match others.is_empty() {
        true => {
            let beside = handles_of(state, &whole).filter(|way| way.dragged != first.dragged);
            let beside: Vec<Way> = beside.filter(|way| !way.side.is_empty()).collect();
            std::iter::once(first).chain(beside).collect()
        }
        false => {
            let keeps = first.keeps.iter().cloned().chain(others).collect();
            vec![Way { keeps, side: Vec::new(), ..first }]
        }
    };
    let (stays, start) = (Vec::new(), state.values.clone());
    let mut keeping = Keeping { wholes, ways, present: 0, stays, is_flat: false, start };
    let kept = &keeping.ways[0].keeps;
    let stays: Option<Vec<Vec<f64>>> =
        kept.iter().map(|path| place_at(state, &state.values, path)).collect();
    keeping.stays = stays?.concat();
    Some(keeping)
}

/// Returns the paths to what is merged with the thing at a path, which comes first; of what is computed, the path.
fn names_of(state: &State, path: &Path) -> Vec<Path> {
    let thing = thing_at(state, path);
    let merged = thing.map(|thing| state.structure.merged_with(thing)).unwrap_or_default();
    let others = merged.into_iter().map(|t| state.structure.path(&state.lowered.document, t));
    let others: Vec<Path> = others.filter(|other| other != path).collect();
    std::iter::once(path.clone()).chain(others).collect()
}

/// Returns the handles that a path leads to, each with the thing whose it is.
fn ways_at(state: &State, path: &Path) -> Vec<(Path, Way)> {
    let found = |n: usize| {
        let whole = Path(path.0[..n].to_vec());
        // of a list of places each is a handle
        let list = path.0.split_last().filter(|(step, _)| matches!(step, Step::Index(_)));
        let is_it = |way: &Way| {
            way.dragged == *path || list.is_some_and(|(_, list)| *way.dragged.0 == *list)
        };
        let way = handles_of(state, &whole).find(is_it)?;
        Some((whole, Way { dragged: path.clone(), ..way }))
    };
    (0..path.0.len()).filter_map(found).collect()
}

/// Returns the handles of the thing at a path.
fn handles_of(state: &State, whole: &Path) -> impl Iterator<Item = Way> {
    let document = &state.lowered.document;
    let class = match thing_at(state, whole) {
        Some(thing) => Some(state.structure.things[thing].class),
        // only what is computed in a class that has handles is asked for
        None if document.classes.iter().all(|(_, class)| class.handles.is_empty()) => None,
        None => class_at(state, whole),
    };
    let handles = class.map(|class| document.handles(class)).unwrap_or_default();
    let prototype = LazyCell::new(|| Lone::of(document, class?));
    let way = |handle: &Handle| {
        let dragged = whole.join(&handle.place);
        let kept = handle.keeps.iter().map(|kept| whole.join(kept));
        let keeps: Vec<Path> = kept.flat_map(|kept| elements(state, kept)).collect();
        let side = match keeps.as_slice() {
            [kept] => {
                let side = side_of(state, &state.values, (&dragged, kept)).unwrap_or_default();
                as_in_class(|| prototype.as_ref(), handle, side)
            }
            _ => Vec::new(),
        };
        Way { dragged, keeps, side }
    };
    handles.into_iter().map(way).collect::<Vec<_>>().into_iter()
}

/// Returns the paths of the elements of a list; of anything else, its own.
fn elements(state: &State, path: Path) -> Vec<Path> {
    let evaluator = state.evaluator(&state.values);
    match evaluator.at(&path) {
        Ok(Answer::List(all)) => (0..all.len()).map(|i| path.then(Step::Index(i as u32))).collect(),
        Ok(_) | Err(_) => vec![path],
    }
}

/// Returns the numbers of the place at a path.
fn place_at(state: &State, values: &Values, path: &Path) -> Option<Vec<f64>> {
    place_in((&state.structure, values), &state.evaluator(values), path)
}

fn place_in(
    (structure, values): (&Structure, &Values),
    evaluator: &Evaluator<'_>,
    path: &Path,
) -> Option<Vec<f64>> {
    if let Ok(thing) = structure.follow(DOCUMENT, path) {
        let slots = coordinates(structure, thing)?;
        return Some(slots.map(|(_, slot)| values.numbers[slot]).to_vec());
    }
    let numbers = numbers_of(&evaluator.at(path).ok()?)?;
    Some(numbers.into_iter().map(|(x, _)| x).collect())
}

/// Returns on which side a handle lies, where a thing that is flat does not say it: the one of its class's prototype.
fn as_in_class<'l>(
    prototype: impl FnOnce() -> Option<&'l Lone>,
    handle: &Handle,
    side: Vec<i8>,
) -> Vec<i8> {
    let lone = if side.contains(&0) { prototype() } else { None };
    let Some(lone) = lone else { return side };
    let (values, _) = eval::given_values(&lone.document, &lone.structure);
    let evaluator = Evaluator::new(&lone.document, &lone.structure, &values);
    let whole = lone.structure.path(&lone.document, lone.thing);
    let place = |place: &Path| place_in((&lone.structure, &values), &evaluator, &whole.join(place));
    let (Some(held), Some(kept)) = (place(&handle.place), handle.keeps.first().and_then(place))
    else {
        return side;
    };
    let own = side.into_iter().zip(signs(&held, &kept));
    own.map(|(sign, usual)| if sign == 0 { usual } else { sign }).collect()
}

/// Returns true for the signs of a coordinate on two sides.
fn is_turned((now, was): &(&i8, &i8)) -> bool {
    **now * **was < 0
}

/// Returns on which side of another a place lies.
fn side_of(state: &State, values: &Values, (place, other): (&Path, &Path)) -> Option<Vec<i8>> {
    let (place, other) = (place_at(state, values, place)?, place_at(state, values, other)?);
    Some(signs(&place, &other))
}

fn signs(place: &[f64], other: &[f64]) -> Vec<i8> {
    let sign = |(a, b): (&f64, &f64)| i8::from(a > b) - i8::from(a < b);
    place.iter().zip(other).map(sign).collect()
}

impl Keeping {
    /// Presses on the handle that is held, where it was at first.
    pub(crate) fn press(&self, state: &State, planner: &mut Planner) -> Option<Press> {
        let way = &self.ways[self.present];
        let dragged = held(state, &way.dragged);
        let kept: Vec<Held> = way.keeps.iter().flat_map(|path| held(state, path)).collect();
        let [dragged, kept] =
            [&dragged, &kept].map(|all| all.iter().map(Held::target).collect::<Vec<_>>());
        planner.press_keeping(state.model(), &self.start, &dragged, &kept).ok()
    }

    /// Follows the pointer; what is dragged across what stays is held by the handle that lies there, or stops at it.
    pub(crate) fn follow(
        &mut self,
        state: &State,
        planner: &mut Planner,
        (press, values): (&mut Press, &mut Values),
        to: &[f64],
        host: &mut dyn Host,
    ) -> EditReport {
        let wished: Vec<f64> = to.iter().chain(&self.stays).copied().collect();
        self.is_flat = false;
        let report = planner.drag(state.model(), press, values, &wished, host);
        let Some(turned) = self.turned(state, values) else { return report };
        // what has no handles across is as good on every side
        if !self.has_mirrors(&turned) {
            return report;
        }
        let Some(across) = self.beyond(&turned) else {
            return self.flat(state, planner, (press, values), (&wished, report), host);
        };
        let turned = report.reached.then(|| values.clone());
        let before = self.present;
        self.present = across;
        if let Some(mut other) = self.press(state, planner) {
            let mut there = self.start.clone();
            let found = planner.drag(state.model(), &mut other, &mut there, &wished, host);
            let leads = turned.is_some_and(|turned| self.leads_others(state, &turned, &there));
            if found.reached && !leads && self.turned(state, &there).is_none() {
                (*press, *values) = (other, there);
                return found;
            }
        }
        self.present = before;
        self.flat(state, planner, (press, values), (&wished, report), host)
    }

    /// Stops at what stays, along the coordinates in which the handle has been dragged across it.
    fn flat(
        &mut self,
        state: &State,
        planner: &mut Planner,
        (press, values): (&mut Press, &mut Values),
        (wished, report): (&[f64], EditReport),
        host: &mut dyn Host,
    ) -> EditReport {
        let way = &self.ways[self.present];
        let (Some(side), [kept]) = (self.turned(state, values), way.keeps.as_slice()) else {
            return report;
        };
        let Some(kept) = place_at(state, values, kept) else { return report };
        let mut nearer = wished.to_vec();
        for (i, pair) in side.iter().zip(&way.side).enumerate() {
            if is_turned(&pair) && kept.len() == side.len() {
                nearer[i] = kept[i];
            }
        }
        let mut there = values.clone();
        let found = planner.drag(state.model(), press, &mut there, &nearer, host);
        let found = match self.is_flat_or_not_turned(state, &there) {
            true => found,
            false => self.up_to_flat(state, planner, (press, &mut there), wished, host),
        };
        *values = there;
        self.is_flat = true;
        EditReport { reached: false, ..found }
    }

    /// Follows the hand on the straight way from the press to what is wished, up to where it is dragged across.
    fn up_to_flat(
        &self,
        state: &State,
        planner: &mut Planner,
        (press, values): (&mut Press, &mut Values),
        wished: &[f64],
        host: &mut dyn Host,
    ) -> EditReport {
        let dragged = place_at(state, &self.start, &self.ways[self.present].dragged);
        let from: Vec<f64> = dragged.into_iter().flatten().chain(self.stays.clone()).collect();
        let mut follow = |part: f64, values: &mut Values| {
            let mid: Vec<f64> = from.iter().zip(wished).map(|(a, b)| a + part * (b - a)).collect();
            values.clone_from(&self.start);
            planner.drag(state.model(), press, values, &mid, host)
        };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let mid = 0.5 * (low + high);
            follow(mid, values);
            match self.turned(state, values) {
                None => low = mid,
                Some(_) => high = mid,
            }
        }
        follow(low, values)
    }

    /// Returns true where the handle was not dragged across, or lies at what stays but for rounding.
    fn is_flat_or_not_turned(&self, state: &State, values: &Values) -> bool {
        let way = &self.ways[self.present];
        let Some(side) = self.turned(state, values) else { return true };
        let [kept] = way.keeps.as_slice() else { return true };
        let place = |path| place_at(state, values, path).unwrap_or_default();
        let (held, kept) = (place(&way.dragged), place(kept));
        let pairs = side.iter().zip(&way.side).zip(held.iter().zip(&kept));
        pairs.into_iter().all(|(pair, (&a, &b))| !is_turned(&pair) || base::number::close(a, b))
    }

    /// Returns true where the class has the handles across: one for each coordinate that is turned, alone.
    fn has_mirrors(&self, turned: &[i8]) -> bool {
        let side = &self.ways[self.present].side;
        let is_across = |at: usize, way: &Way| {
            let pairs = way.side.iter().zip(side).enumerate();
            way.side.len() == side.len()
                && pairs.into_iter().all(|(i, pair)| is_turned(&pair) == (i == at))
        };
        let coordinates = turned.iter().zip(side).enumerate().filter(|(_, pair)| is_turned(pair));
        coordinates.into_iter().all(|(at, _)| self.ways.iter().any(|way| is_across(at, way)))
    }

    /// Returns on which side of what stays the handle that is held has come to, if it was dragged across it.
    fn turned(&self, state: &State, values: &Values) -> Option<Vec<i8>> {
        let way = &self.ways[self.present];
        let [kept] = way.keeps.as_slice() else { return None };
        let side = side_of(state, values, (&way.dragged, kept))?;
        side.iter().zip(&way.side).any(|pair| is_turned(&pair)).then_some(side)
    }

    /// Returns the handle that lies on a side.
    fn beyond(&self, side: &[i8]) -> Option<usize> {
        let fits = |way: &Way| side.iter().zip(&way.side).all(|pair| !is_turned(&pair));
        self.ways.iter().position(fits)
    }

    /// Returns the thing that stopped where it is flat, if it did.
    pub(crate) fn flat_whole(&self) -> Option<&Path> {
        self.wholes.first().filter(|_| self.is_flat)
    }

    /// Returns true where a place that is no part of the thing alone would lie elsewhere than if the thing were turned
    /// inside out: what is joined to a corner neither lets go of the hand nor goes along with it.
    fn leads_others(&self, state: &State, turned: &Values, there: &Values) -> bool {
        let own: BTreeSet<SlotId> = self.slots(state).into_iter().collect();
        let structure = &state.structure;
        let is_within = |thing: ThingId| {
            let path = structure.path(&state.lowered.document, thing);
            self.wholes.iter().any(|whole| path.0.starts_with(&whole.0))
        };
        let is_alone = |slot: SlotId, place: ThingId| {
            own.contains(&slot) && structure.merged_with(place).into_iter().all(is_within)
        };
        turned.changed(there).any(|slot| {
            let place = structure.slots[slot].place.filter(|&place| !is_alone(slot, place));
            place.is_some() && !base::number::close(turned.numbers[slot], there.numbers[slot])
        })
    }

    /// Returns the path of the handle that is held, if it is not the one that was pressed.
    pub(crate) fn instead(&self) -> Option<&Path> {
        (self.present != 0).then(|| &self.ways[self.present].dragged)
    }

    /// Returns the numbers of the things whose handle it is.
    pub(crate) fn slots(&self, state: &State) -> Vec<SlotId> {
        let things = self.wholes.iter().filter_map(|whole| thing_at(state, whole));
        let all: BTreeSet<SlotId> = things.flat_map(|t| state.structure.slots_under(t)).collect();
        all.into_iter().collect()
    }
}

/// What an edit can hold.
enum Held {
    Thing(ThingId),
    Term(Term),
}

/// Returns what is held of the place at a path: its coordinates, or what it is computed by.
fn held(state: &State, path: &Path) -> Vec<Held> {
    let Some(thing) = thing_at(state, path) else {
        return vec![Held::Term(Term::at(Term::Me, path))];
    };
    match coordinates(&state.structure, thing) {
        // a place yields as one
        Some([(_, x), (_, y)]) if state.structure.slots_under(thing) == [x, y] => {
            vec![Held::Thing(thing)]
        }
        Some([(x, _), (y, _)]) => vec![Held::Thing(x), Held::Thing(y)],
        None => Vec::new(),
    }
}

impl Held {
    fn target(&self) -> Target<'_> {
        match self {
            Self::Thing(thing) => Target::Thing(*thing),
            Self::Term(term) => Target::Term { me: DOCUMENT, term },
        }
    }
}
