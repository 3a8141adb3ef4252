//! A drag: from press to release nothing is written, and nothing but numbers is computed.

use crate::angles;
use crate::apply::{self, Aim};
use crate::by_hand::class_at;
use crate::document::Open;
use crate::general;
use crate::handles::{self, Keeping};
use crate::host::Host;
use crate::limits;
use crate::session::thing_at;
use crate::state::State;
use crate::texts::Texts;
use crate::view::{Change, DragState, Refusal};
use crate::words;
use crate::write_back::Edited;
use base::number::rounded;
use eval::Answer;
use expr::Dimension;
use kernel::{Argument, BinaryOperator, DOCUMENT, Literal, Path, Primitive, SlotId, Step};
use kernel::{Structure, Term, ThingId, Value, Values};
use plan::{NotDecided, Planner, Press, RefusalReason, Target};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// How an angle is followed that is computed: `atan2` leaps by a whole turn where it comes past half of one.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Turning {
    /// It is none, or a stored one, which goes on by itself.
    No,
    /// As it is.
    Plain,
    /// As what it has turned since it was this angle.
    From(f64),
}

/// A drag between press and release.
pub(crate) struct Drag {
    /// What is dragged, for the undo list.
    pub(crate) path: Path,
    /// What is dragged with it.
    others: Vec<Path>,
    /// The thing and where its first place was at the press, where its class says how it moves.
    moved: Option<(ThingId, (f64, f64))>,
    /// The expression, where what is dragged is computed.
    computed: Option<Term>,
    /// Of an angle that is computed, how it goes on past half a turn.
    turning: Turning,
    /// What holds its numbers; of what is computed, the numbers that it is computed from.
    slots: Vec<SlotId>,
    /// Where each of its numbers was at the press.
    start: Vec<f64>,
    press: Press,
    /// What stays meanwhile, where a handle is dragged.
    keeping: Option<Box<Keeping>>,
    /// Where each of them was wished at the last event.
    wanted: Vec<f64>,
    /// The values as of the last event.
    pub(crate) values: Values,
    /// Where the pointer was then, on the sheet.
    pub(crate) wish: [f64; 2],
    /// Where a point of a curve is held, to how many decimals numbers follow it. Aside of its way it comes as near as it
    /// can.
    pub(crate) grasp: Option<usize>,
}

/// Begins a drag of some things in a document, and returns where its handle is on the sheet: that of the first.
///
/// # Errors
/// Why they cannot be dragged; of several, each must be a thing with places of its own.
pub(crate) fn begin(open: &mut Open, paths: &[Path]) -> Result<(f64, f64), Refusal> {
    let [path] = paths else { return begin_several(open, paths) };
    let state = open.state.clone();
    let aim = apply::aim(&state, path);
    let aim = aim.map_err(|r| words::find(&state, path).err().unwrap_or(r))?;
    if let Some(drag) = begin_handle(&state, &mut open.planner, path, &aim) {
        let handle = drag.handle();
        open.drag = Some(drag);
        return Ok(handle);
    }
    let drag = match aim {
        // what has no place of its own is held by one that is computed
        Aim::Thing(thing) if computed_place(&state, thing).is_some() => {
            let place = computed_place(&state, thing).unwrap_or_default();
            let term = Term::at(Term::Me, &path.join(&place));
            press_computed(&state, &mut open.planner, term, path.clone())
        }
        Aim::Thing(thing) => press(&state, &mut open.planner, &[thing], path.clone()),
        Aim::Term(term) => {
            let answer = state.evaluator(&state.values).at(path).ok();
            let held = answer.as_ref().map(|answer| held_by(&state, answer)).unwrap_or_default();
            match (answer.as_ref().and_then(numbers_of), path.0.split_last()) {
                // what a program drew that is no place is held by what it is a part of
                (None, Some((_, whole))) if !whole.is_empty() => {
                    return begin(open, &[Path(whole.to_vec())]);
                }
                // a figure is held by the things that it is made about
                (None, Some(_)) if !held.is_empty() => {
                    press(&state, &mut open.planner, &held, path.clone())
                }
                _ => press_computed(&state, &mut open.planner, term, path.clone())
                    .and_then(|drag| follows(&state, drag)),
            }
        }
    };
    let drag =
        drag.map_err(|reason| words::refusal_for(&state, &reason, &plan::EditReport::default()))?;
    let handle = drag.handle();
    open.drag = Some(drag);
    Ok(handle)
}

/// Refuses a drag that no number could follow.
fn follows(state: &State, drag: Drag) -> Result<Drag, RefusalReason> {
    if !drag.reach().is_empty() {
        return Ok(drag);
    }
    let path = &drag.path;
    let owner = path.0.first().and_then(|first| class_at(state, &Path(vec![first.clone()])));
    let why = match owner.and_then(|class| state.lowered.document.program(class)) {
        Some(_) => "its step says where it is; click the step to change what it says",
        None => "no number that it is computed of can change",
    };
    Err(RefusalReason::Target(format!("{path} cannot be dragged: {why}")))
}

/// The most decimals of a number that follows a grasp.
pub(crate) const MOST_DECIMALS: usize = 15;

/// So many numbers are named that follow a drag.
const MOST_FOLLOWING: usize = 3;

impl Drag {
    /// Which numbers follow where what is dragged is computed of them, with what they are now.
    pub(crate) fn following(&self, state: &State) -> Vec<String> {
        let is_same = |slot: SlotId| self.values.numbers[slot] == state.values.numbers[slot];
        let told = |&slot: &SlotId| {
            if is_same(slot) {
                return None;
            }
            let now = words::slot_in_words(state, slot, &self.values);
            let is_other = now != words::slot_in_words(state, slot, &state.values);
            is_other.then(|| format!("{} {now}", state.slot_path(slot)))
        };
        let is_computed = self.computed.is_some();
        self.slots.iter().filter(|_| is_computed).filter_map(told).take(MOST_FOLLOWING).collect()
    }
}

/// Begins a drag of a handle, while what it keeps stays. Nothing where it is none, or cannot be dragged so.
fn begin_handle(state: &State, planner: &mut Planner, path: &Path, aim: &Aim) -> Option<Drag> {
    let keeping = handles::keeping(state, path, aim)?;
    let pressed = match aim {
        Aim::Thing(thing) => press(state, planner, &[*thing], path.clone()),
        Aim::Term(term) => press_computed(state, planner, term.clone(), path.clone()),
    };
    let mut drag = pressed.ok()?;
    drag.press = keeping.press(state, planner)?;
    drag.keeping = Some(Box::new(keeping));
    Some(drag)
}

/// Returns true for a place by which its class says a hand changes a thing.
pub(crate) fn is_handle(state: &State, path: &Path) -> bool {
    apply::aim(state, path).is_ok_and(|aim| handles::keeping(state, path, &aim).is_some())
}

/// Drags a handle to a place in one step, from press to release.
///
/// # Errors
/// Why it cannot be dragged or what came of it not be kept.
pub(crate) fn at_once(
    open: &mut Open,
    host: &dyn Host,
    path: &Path,
    to: &Literal,
) -> Result<Change, Refusal> {
    let wanted = apply::flat(to);
    let [Value::Number(x), Value::Number(y)] = wanted.as_slice() else {
        return Err(words::refuse(format!("{path} is a place: it is moved to `(x, y)`")));
    };
    begin(open, std::slice::from_ref(path))?;
    let state = open.state.clone();
    let Some(mut drag) = open.drag.take() else { return Ok(Change::default()) };
    drag.to(&state, &mut open.planner, (*x, *y));
    drag.release(open, host)
}

/// Begins a drag of several things, which move as one. What is computed goes along with what it is computed from.
fn begin_several(open: &mut Open, paths: &[Path]) -> Result<(f64, f64), Refusal> {
    let state = open.state.clone();
    let figures = state.evaluator(&state.values).computed_figures(DOCUMENT);
    let is_figure = |path: &Path| match path.0.as_slice() {
        [Step::Part(name)] => figures.contains(name),
        _ => false,
    };
    let mut moving: Vec<(Path, ThingId)> = Vec::new();
    let mut computed: Vec<(&Path, Term)> = Vec::new();
    // what is not there has no place; by itself it is told why
    let is_made =
        |path: &&Path| !is_figure(path) || state.evaluator(&state.values).at(path).is_ok();
    for path in paths.iter().filter(is_made) {
        match apply::aim(&state, path)? {
            Aim::Thing(thing) if !places(&state.structure, &[thing]).is_empty() => {
                moving.push((path.clone(), thing));
            }
            Aim::Thing(_) => {
                let message =
                    format!("{path} has no place of its own: it is not dragged with others");
                return Err(words::refuse(message));
            }
            Aim::Term(term) => {
                let answer = state.evaluator(&state.values).at(path).ok();
                let about = answer.filter(|_| is_figure(path)).map(|a| held_by(&state, &a));
                match about.unwrap_or_default() {
                    about if about.is_empty() => computed.push((path, term)),
                    about => moving.extend(about.into_iter().map(|thing| (path.clone(), thing))),
                }
            }
        }
    }
    all_go_along(&state, &open.planner, &moving, &computed)?;
    let alone = match moving.as_slice() {
        [] => computed.first().map(|(path, _)| *path).or(paths.first()),
        [(path, _)] => Some(path),
        _ => None,
    };
    if let Some(path) = alone {
        return begin(open, std::slice::from_ref(path));
    }
    let (mut paths, mut things): (Vec<Path>, Vec<ThingId>) = moving.into_iter().unzip();
    paths.dedup();
    let mut seen = BTreeSet::new();
    things.retain(|thing| seen.insert(*thing));
    let Some(path) = paths.first() else { return Err(words::refuse("nothing is selected".into())) };
    let drag = press(&state, &mut open.planner, &things, path.clone());
    let mut drag =
        drag.map_err(|reason| words::refusal_for(&state, &reason, &plan::EditReport::default()))?;
    drag.others = paths[1..].to_vec();
    let handle = drag.handle();
    open.drag = Some(drag);
    Ok(handle)
}

/// Finds out whether all that is computed follows from what moves; where nothing moves by itself, from what the first
/// follows from.
///
/// # Errors
/// One does not.
fn all_go_along(
    state: &State,
    planner: &Planner,
    moving: &[(Path, ThingId)],
    computed: &[(&Path, Term)],
) -> Result<(), Refusal> {
    let Some((_, first)) = computed.first() else { return Ok(()) };
    let slots = moving.iter().flat_map(|(_, thing)| state.structure.slots_under(*thing));
    let moved = if moving.is_empty() { read_by(state, first) } else { slots.collect() };
    let moved = planner.tied_to(moved);
    match computed.iter().find(|(_, term)| read_by(state, term).is_disjoint(&moved)) {
        Some((path, _)) => {
            let message =
                format!("{path} is computed from none of these: it is not dragged with them");
            Err(words::refuse(message))
        }
        None => Ok(()),
    }
}

/// Returns the numbers that an expression follows from.
fn read_by(state: &State, term: &Term) -> BTreeSet<SlotId> {
    let evaluator = state.evaluator(&state.values);
    let (_, read) = evaluator.listening(|| evaluator.evaluate(term, DOCUMENT));
    read.into_iter().collect()
}

/// Lists the things of the document that a figure is made about and moves with, each once; none where one of its places
/// is computed otherwise, which would stay behind.
fn held_by(state: &State, figure: &Answer<'_>) -> Vec<ThingId> {
    let mut things = BTreeSet::new();
    let is_held = match figure {
        Answer::Thing(_) => false,
        _ => moves_with(state, figure, &mut things),
    };
    if is_held { things.into_iter().collect() } else { Vec::new() }
}

/// Adds the things that what was made moves with; returns false where that is not all of it.
fn moves_with(state: &State, answer: &Answer<'_>, things: &mut BTreeSet<ThingId>) -> bool {
    match answer {
        Answer::Thing(thing) => {
            things.insert(*thing);
            !places(&state.structure, &[*thing]).is_empty()
        }
        Answer::Made(made) => {
            let is_place = state.lowered.document.is_place(made.class);
            !is_place && made.fields.iter().all(|field| moves_with(state, field, things))
        }
        Answer::List(list) => list.iter().all(|element| moves_with(state, element, things)),
        Answer::Number(..) | Answer::Bool(_) | Answer::Option(..) | Answer::Text(_) => true,
        Answer::Context(_) | Answer::Picture(_) | Answer::Function(_) => false,
    }
}

/// Begins a drag: of a number, of a place, or of things with all the places that they are made of.
///
/// # Errors
/// Why they cannot be dragged.
pub(crate) fn press(
    state: &State,
    planner: &mut Planner,
    things: &[ThingId],
    path: Path,
) -> Result<Drag, RefusalReason> {
    let structure = &state.structure;
    general::accept(state, &path).map_err(|r| RefusalReason::Target(r.message))?;
    // how a thing moves that says so itself is known of it alone
    let single = if let [thing] = things { Some(*thing) } else { None };
    let otherwise = single.and_then(|thing| Some((thing, otherwise(state, thing)?)));
    let number = single.filter(|&thing| structure.slot_of(thing).is_some());
    let handles: Vec<Vec<ThingId>> = match (number, &otherwise) {
        (Some(thing), _) => vec![vec![thing]],
        (None, Some((_, moves))) => moves.iter().map(|&s| vec![structure.slots[s].thing]).collect(),
        (None, None) => places(structure, things),
    };
    let slots = |&t: &ThingId| structure.slots_under(t);
    let is_held =
        |handle: &Vec<ThingId>| handle.iter().flat_map(slots).all(|s| structure.slots[s].anchored);
    let Some(first) = handles.first().and_then(|h| h.iter().flat_map(slots).next()) else {
        return Err(RefusalReason::Target(format!("{path} has no place that could be dragged")));
    };
    // an anchored corner stays where it is while the others are dragged
    let free: Vec<ThingId> = handles.into_iter().filter(|h| !is_held(h)).flatten().collect();
    if free.is_empty() {
        return Err(RefusalReason::Anchored(first));
    }
    let targets: Vec<Target<'_>> = free.iter().map(|&t| Target::Thing(t)).collect();
    let dragged: Vec<SlotId> = free.iter().flat_map(slots).collect();
    let press = planner.press(state.model(), &state.values, &targets)?;
    let start: Vec<f64> = dragged.iter().map(|&s| state.values.numbers[s]).collect();
    let number = |s: Option<&SlotId>| s.map_or(0.0, |&s| state.values.numbers[s]);
    let moved = otherwise.map(|(thing, _)| {
        let first = places(structure, &[thing]).into_iter().next().unwrap_or_default();
        let first: Vec<SlotId> = first.iter().flat_map(slots).collect();
        (thing, (number(first.first()), number(first.get(1))))
    });
    let wish = [start[0], start.get(1).copied().unwrap_or(0.0)];
    let values = state.values.clone();
    Ok(Drag {
        path,
        others: Vec::new(),
        moved,
        computed: None,
        turning: Turning::No,
        slots: dragged,
        wanted: start.clone(),
        start,
        press,
        keeping: None,
        values,
        wish,
        grasp: None,
    })
}

/// Begins a drag of a number or a place that is computed.
///
/// # Errors
/// Why it cannot be dragged.
pub(crate) fn press_computed(
    state: &State,
    planner: &mut Planner,
    term: Term,
    path: Path,
) -> Result<Drag, RefusalReason> {
    general::accept(state, &path).map_err(|r| RefusalReason::Target(r.message))?;
    let evaluator = state.evaluator(&state.values);
    let (answer, read) = evaluator.listening(|| evaluator.evaluate(&term, DOCUMENT));
    let answer = answer.map_err(|fault| RefusalReason::Target(fault.message))?;
    if let Answer::Thing(thing) = answer {
        return press(state, planner, &[thing], path);
    }
    let Some(start) = numbers_of(&answer) else {
        return Err(RefusalReason::Target(format!("{path} is no number and no place")));
    };
    let start: Vec<f64> = start.into_iter().map(|(x, _)| x).collect();
    let press = planner.press(
        state.model(),
        &state.values,
        &[Target::Term { me: DOCUMENT, term: &term }],
    )?;
    let wish = [start[0], start.get(1).copied().unwrap_or(0.0)];
    let (slots, values) = (read.into_iter().collect(), state.values.clone());
    let turning = if angles::is_path_of_one(state, &path) { Turning::Plain } else { Turning::No };
    Ok(Drag {
        turning,
        path,
        others: Vec::new(),
        moved: None,
        computed: Some(term),
        slots,
        wanted: start.clone(),
        start,
        press,
        keeping: None,
        values,
        wish,
        grasp: None,
    })
}

/// Returns an angle without its whole turns.
fn within_half_a_turn(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// Returns the expression for how far an angle has turned since it was another, less than half a turn either way.
fn turned_since(angle: &Term, from: f64) -> Term {
    let call = |name: &str, of: Vec<Term>| Term::Call {
        name: name.into(),
        arguments: of.into_iter().map(|value| Argument { label: None, value }).collect(),
    };
    let from = Term::Number { value: from, dimension: Dimension::NONE, bare: false };
    let way = Term::Binary(BinaryOperator::Subtract, Box::new(angle.clone()), Box::new(from));
    call("atan2", vec![call("sin", vec![way.clone()]), call("cos", vec![way])])
}

/// Returns the way to a place that is computed in a thing that has none of its own, neither in its parts: the
/// first that its class, or one above it, answers with.
pub(crate) fn computed_place(state: &State, thing: ThingId) -> Option<Path> {
    let (structure, document) = (&state.structure, &state.lowered.document);
    if structure.slot_of(thing).is_some() || !places(structure, &[thing]).is_empty() {
        return None;
    }
    let evaluator = state.evaluator(&state.values);
    let mut classes = document.primary_line(structure.things[thing].class).into_iter();
    let is_place = |name: &base::Name| {
        let answer = evaluator.ask(thing, name).ok();
        answer.is_some_and(|answer| match &answer {
            Answer::Made(made) => document.is_place(made.class) && numbers_of(&answer).is_some(),
            _ => false,
        })
    };
    classes.find_map(|class| {
        let messages = document.classes[class].messages.iter();
        let mut own = messages.filter(|m| m.parameters.is_empty() && !m.is_default);
        let found = own.find(|m| is_place(&m.name))?;
        Some(Path(vec![Step::Part(found.name.clone())]))
    })
}

/// Returns the number that an answer is, or the two of a place.
pub(crate) fn numbers_of(answer: &Answer<'_>) -> Option<Vec<(f64, Dimension)>> {
    let number = |answer: &Answer<'_>| match answer {
        Answer::Number(x, dimension) => Some((*x, *dimension)),
        Answer::Bool(_)
        | Answer::Option(..)
        | Answer::Text(_)
        | Answer::Thing(_)
        | Answer::Made(_)
        | Answer::Context(_)
        | Answer::List(_)
        | Answer::Picture(_)
        | Answer::Function(_) => None,
    };
    match answer {
        Answer::Made(made) if made.fields.len() == 2 => made.fields.iter().map(number).collect(),
        other => number(other).map(|x| vec![x]),
    }
}

/// Returns the numbers that move with a thing whose class says itself how it moves.
fn otherwise(state: &State, thing: ThingId) -> Option<Vec<SlotId>> {
    if !general::defines(state, thing, "moved") {
        return None;
    }
    let mut moves: Vec<SlotId> = Vec::new();
    for way in [(1.0, 0.0), (0.0, 1.0)] {
        let there = general::moved(state, thing, way)?;
        let other = |(slot, x): (SlotId, f64)| (state.values.numbers[slot] != x).then_some(slot);
        moves.extend(there.into_iter().filter_map(other));
    }
    moves.sort();
    moves.dedup();
    Some(moves).filter(|m| !m.is_empty())
}

/// Returns the numbers x and y of a thing that has such parts, with their slots.
pub(crate) fn coordinates(structure: &Structure, thing: ThingId) -> Option<[(ThingId, SlotId); 2]> {
    let coordinate = |name| {
        let part = structure.part_named(thing, name)?;
        Some((part, structure.slot_of(part)?))
    };
    Some([coordinate("x")?, coordinate("y")?])
}

/// Returns true for a thing that has a place to be dragged by.
pub(crate) fn has_place(structure: &Structure, thing: ThingId) -> bool {
    !places(structure, &[thing]).is_empty()
}

/// Whether a thing has places of its own, of which some are not anchored.
pub(crate) fn moves(structure: &Structure, thing: ThingId) -> bool {
    let is_held = |slot: &SlotId| structure.slots[*slot].anchored;
    let slots = |t: &ThingId| structure.slots_under(*t);
    places(structure, &[thing])
        .iter()
        .any(|place| !place.iter().flat_map(slots).all(|s| is_held(&s)))
}

/// Returns the places that things are made of, each merged one once: themselves, or those of their parts. A
/// place that has more than its coordinates, two numbers x and y, is dragged by these.
fn places(structure: &Structure, things: &[ThingId]) -> Vec<Vec<ThingId>> {
    let mut places: Vec<Vec<ThingId>> = Vec::new();
    let mut known: BTreeSet<[SlotId; 2]> = BTreeSet::new();
    let mut stack: Vec<ThingId> = things.iter().rev().copied().collect();
    while let Some(t) = stack.pop() {
        let Some([(x, of_x), (y, of_y)]) = coordinates(structure, t) else {
            stack.extend(structure.parts(t).rev());
            continue;
        };
        let is_new = known.insert([of_x, of_y]);
        if structure.slots_under(t) == [of_x, of_y] {
            places.extend(is_new.then(|| vec![t]));
        } else {
            places.extend(is_new.then(|| vec![x, y]));
            stack.extend(structure.parts(t).filter(|p| ![x, y].contains(p)).rev());
        }
    }
    places
}

impl Drag {
    /// Returns where the first of its places was at the press: what the pointer drags.
    pub(crate) fn handle(&self) -> (f64, f64) {
        match self.moved {
            Some((_, first)) => first,
            None => (self.start[0], self.start.get(1).copied().unwrap_or(0.0)),
        }
    }
    /// Returns what a computed angle reads, within half a turn, where it is wished to be beyond that, in radians.
    pub(crate) fn leapt(&self, angle: f64) -> Option<f64> {
        let is_beyond = angle.abs() > std::f64::consts::PI && self.turning != Turning::No;
        is_beyond.then(|| within_half_a_turn(angle))
    }
    /// Returns the numbers that are dragged, as they were at the press.
    pub(crate) fn start(&self) -> &[f64] {
        &self.start
    }
    /// Returns the path of what the hand holds now: what was pressed, or the handle that lies there instead of it.
    pub(crate) fn held_path(&self) -> &Path {
        self.instead().unwrap_or(&self.path)
    }
    /// Returns the path of the handle that is held instead of the one that was pressed, if it is another.
    fn instead(&self) -> Option<&Path> {
        self.keeping.as_ref()?.instead()
    }
    /// Returns the numbers of the handle that is held, each with what it was at the press; none of what is computed.
    pub(crate) fn handle_slots(&self, state: &State) -> Vec<(SlotId, f64)> {
        let pressed = || if self.computed.is_some() { &[] } else { self.slots.as_slice() };
        let slots: Vec<SlotId> = match self.instead() {
            Some(path) => {
                let place = thing_at(state, path).and_then(|t| coordinates(&state.structure, t));
                place.into_iter().flatten().map(|(_, slot)| slot).collect()
            }
            None => pressed().to_vec(),
        };
        slots.into_iter().zip(self.start.iter().copied()).take(2).collect()
    }
    /// Returns the numbers of what is computed and held, as of the last event.
    pub(crate) fn computed_now(&self, state: &State) -> Option<Vec<(f64, Dimension)>> {
        let evaluator = state.evaluator(&self.values);
        let answer = match (self.instead(), &self.computed) {
            (Some(path), _) if thing_at(state, path).is_some() => return None,
            (Some(path), _) => evaluator.at(path),
            (None, Some(term)) => evaluator.evaluate(term, DOCUMENT),
            (None, None) => return None,
        };
        numbers_of(&answer.ok()?)
    }
    /// Returns what computes the handle, where it is computed and no other is held instead.
    pub(crate) fn computed_term(&self) -> Option<&Term> {
        self.computed.as_ref().filter(|_| self.instead().is_none())
    }
    /// Returns the slots that it depends on and cannot move.
    pub(crate) fn held(&self) -> Vec<SlotId> {
        self.press.held()
    }
    /// Returns the slots that it may change, and more.
    pub(crate) fn reach(&self) -> Vec<SlotId> {
        self.press.reach().collect()
    }
    /// Follows the pointer to a place on the sheet; a number follows the first of its coordinates.
    /// The first place goes there, the others as far and in the same direction.
    pub(crate) fn to(&mut self, state: &State, planner: &mut Planner, to: (f64, f64)) -> DragState {
        let mut texts = Texts::new(&state.lowered.document, &state.structure);
        let (x0, y0) = self.handle();
        let there = self.moved.and_then(|(t, _)| general::moved(state, t, (to.0 - x0, to.1 - y0)));
        let to: Vec<f64> = match there {
            Some(there) => {
                let place = |slot: &SlotId| there.iter().find(|(s, _)| s == slot).map(|(_, x)| *x);
                self.slots.iter().zip(&self.start).map(|(s, x)| place(s).unwrap_or(*x)).collect()
            }
            None => self
                .start
                .iter()
                .enumerate()
                .map(|(i, start)| match i {
                    0 => to.0,
                    1 => to.1,
                    _ if i % 2 == 0 => start + (to.0 - x0),
                    _ => start + (to.1 - y0),
                })
                .collect(),
        };
        let wished = self.turned(state, planner, &to);
        let report = match &mut self.keeping {
            Some(keeping) => {
                let way = (&mut self.press, &mut self.values);
                keeping.follow(state, planner, way, &wished, &mut texts)
            }
            None => {
                let (press, values) = (&mut self.press, &mut self.values);
                planner.drag(state.model(), press, values, &wished, &mut texts)
            }
        };
        self.wish = [to[0], to.get(1).copied().unwrap_or(0.0)];
        self.wanted = to;
        let changes = self.press.mode_changes(planner, state.model(), &self.values, &mut texts);
        let mut modes = limits::modes(state, &changes);
        if report.reached {
            modes.extend(limits::courses(state, &report.courses));
            return DragState { reached: true, modes, ..DragState::default() };
        }
        let is_cut = matches!(report.not_decided, Some(NotDecided::Work(_)));
        let holds = words::what_holds(state, &report, &self.press.acting(planner));
        // what nothing holds is as near to the pointer as its way comes
        if self.grasp.is_some() && holds.is_none() && report.courses.is_empty() && !is_cut {
            return DragState { modes, ..DragState::default() };
        }
        let (limit, words) = limits::of_drag(state, self);
        if is_cut && limits::reach(state, self).is_none() {
            let came = limit.value;
            let message = format!("{came} is as far as it has come: the way is long, and goes on");
            return DragState { message: Some(message), modes, ..DragState::default() };
        }
        let mut message = match holds {
            Some(holds) => format!("{words}; {holds}"),
            None => words,
        };
        for change in &report.courses {
            message += &format!("; beyond it {}", words::course(state, change));
        }
        if let Some(whole) = self.keeping.as_ref().and_then(|keeping| keeping.flat_whole()) {
            message += &format!("; beyond it {whole} would be inside out");
        }
        let short = limits::shortfall(state, self);
        DragState { reached: false, message: Some(message), limit: Some(limit), short, modes }
    }
    /// Returns the numbers that are wished of the planner. An angle that is computed goes on past half a turn: near there
    /// it is pressed anew, as what it turns from now on.
    fn turned(&mut self, state: &State, planner: &mut Planner, to: &[f64]) -> Vec<f64> {
        /// An angle beyond this, in radians, is near where it leaps.
        const NEAR: f64 = 3.0;
        /// What has turned further than this, in radians, is pressed anew.
        const FAR: f64 = 2.0;
        /// An angle that leaps is never beyond this, in radians: half a turn and a little slack.
        const MOST: f64 = std::f64::consts::PI + 1e-6;
        let ([angle], Some(term)) = (to, &self.computed) else { return to.to_vec() };
        if self.turning == Turning::No {
            return to.to_vec();
        }
        let now = self.computed_now(state).and_then(|now| now.first().map(|(x, _)| *x));
        let is_beyond = angle.abs().max(now.map_or(0.0, f64::abs)) > MOST;
        let is_far = match self.turning {
            Turning::No | Turning::Plain => angle.abs() > NEAR,
            Turning::From(from) => within_half_a_turn(angle - from).abs() > FAR,
        };
        let turning = match now {
            _ if is_beyond => Turning::Plain,
            Some(now) if is_far => Turning::From(now),
            _ => self.turning,
        };
        if turning != self.turning {
            let term = match turning {
                Turning::From(from) => turned_since(term, from),
                Turning::No | Turning::Plain => term.clone(),
            };
            let target = Target::Term { me: DOCUMENT, term: &term };
            if let Ok(press) = planner.press(state.model(), &self.values, &[target]) {
                (self.press, self.turning) = (press, turning);
            }
        }
        match self.turning {
            Turning::From(from) => vec![within_half_a_turn(angle - from)],
            Turning::No | Turning::Plain => to.to_vec(),
        }
    }
    /// Gives the numbers that follow a grasp its decimals, where what is held moves by no more than these; what is no
    /// length, as an angle, gets the fewest in its own unit that leave what is held where it is.
    fn shorten(&mut self, state: &State, planner: &mut Planner) {
        let (Some(decimals), Some(before)) = (self.grasp, self.computed_now(state)) else { return };
        let of = |slot: SlotId| state.structure.slots[slot].primitive;
        let is_length = |slot: SlotId| {
            before.iter().all(|(_, dimension)| of(slot) == Primitive::Real(*dimension))
        };
        let follows = |slot: SlotId| {
            matches!(of(slot), Primitive::Real(_))
                && state.values.numbers[slot] != self.values.numbers[slot]
        };
        let slots: Vec<SlotId> = self.slots.iter().copied().filter(|&s| follows(s)).collect();
        if slots.is_empty() {
            return;
        }
        let tries = if slots.iter().all(|&s| is_length(s)) { 1 } else { MOST_DECIMALS };
        let least = (0..decimals).fold(1.0, |step, _| step / 10.0);
        for fewest in 0..tries {
            let short = |&slot: &SlotId| match is_length(slot) {
                true => {
                    let x = self.values.numbers[slot];
                    rounded(x, decimals).parse().unwrap_or(x)
                }
                false => words::shortened(state, slot, &self.values, fewest),
            };
            let wished: Vec<f64> = slots.iter().map(short).collect();
            let Some((press, values)) = self.tried(state, planner, (&slots, &wished)) else {
                continue;
            };
            let long = std::mem::replace(&mut self.values, values);
            let now = self.computed_now(state).unwrap_or_default();
            let is_near = |((a, _), (b, _)): (&(f64, _), &(f64, _))| (a - b).abs() <= least;
            if now.len() == before.len() && now.iter().zip(&before).all(is_near) {
                self.press = press;
                return;
            }
            self.values = long;
        }
    }
    /// Gives numbers other values, and returns what came of it where they reached these.
    fn tried(
        &self,
        state: &State,
        planner: &mut Planner,
        (slots, wished): (&[SlotId], &[f64]),
    ) -> Option<(Press, Values)> {
        let targets: Vec<Target<'_>> =
            slots.iter().map(|&s| Target::Thing(state.structure.slots[s].thing)).collect();
        let mut press = planner.press(state.model(), &self.values, &targets).ok()?;
        let mut texts = Texts::new(&state.lowered.document, &state.structure);
        let mut values = self.values.clone();
        let report = planner.drag(state.model(), &mut press, &mut values, wished, &mut texts);
        report.reached.then_some((press, values))
    }
    /// Lets go: soft constraints act again, and the change is written.
    ///
    /// # Errors
    /// Why it could not be kept; then all is as it was before the press.
    pub(crate) fn release(mut self, open: &mut Open, host: &dyn Host) -> Result<Change, Refusal> {
        let state = open.state.clone();
        self.shorten(&state, &mut open.planner);
        let mut texts = Texts::new(&state.lowered.document, &state.structure);
        let dragged = std::iter::once(self.held_path()).chain(&self.others);
        let dragged: Vec<String> = dragged.map(Path::to_string).collect();
        let report = open.planner.release(state.model(), self.press, &mut self.values, &mut texts);
        if let Some(reason) = &report.refusal {
            return Err(words::refusal_for(&state, reason, &report));
        }
        let label = format!("move {}", words::listed(&dragged));
        // a handle speaks of the whole thing: what stays was wished as well
        let whole = self.keeping.as_ref().map(|keeping| keeping.slots(&state));
        let wishes = match (&self.computed, &whole) {
            (None, None) => self.slots.iter().copied().zip(self.wanted).collect(),
            _ => Vec::new(),
        };
        let is_apart = whole.as_ref().is_some_and(|whole| {
            state.values.changed(&self.values).any(|slot| !whole.contains(&slot))
        });
        let edited =
            Edited { slots: whole.unwrap_or(self.slots), by_hand: Some(self.wish.to_vec()) };
        let steps = open.done.len();
        let kept = apply::keep(open, host, label, edited, &self.values, &report.undecided)?;
        if let Some(step) = open.done.get_mut(steps) {
            step.wishes = wishes;
            // the checker knows no stays of a drag alone: of what moved beside the thing it tests the rules
            if is_apart {
                step.edited.clear();
            }
        }
        Ok(kept)
    }
}
