//! Where an edit or a drag has to stop, and what begins or ceases to act on the way, in words.

use crate::apply::Aim;
use crate::drag::Drag;
use crate::state::State;
use crate::view::{Limit, ModeView};
use crate::{angles, rules, words};
use base::number::{Toward, close};
use expr::Dimension;
use kernel::{DOCUMENT, Primitive, Quantity, SlotId, Strength, Term, ThingId, Value};
use plan::{ActingKind, CourseChange, ModeChange, Source};
use std::collections::BTreeSet;

/// How straight a place, the pointer and an anchored place lie for a reach: as a sine.
const STRAIGHT: f64 = 1e-4;

/// Returns the last value on the way of a refused edit: of a number or a place, which is wanted to have
/// the `wanted` numbers, and can go a part of the way.
pub(crate) fn of_thing(
    state: &State,
    thing: ThingId,
    wanted: &[Value],
    part: f64,
) -> Option<Limit> {
    let slots = state.structure.slots_under(thing);
    if slots.len() != wanted.len() {
        return None;
    }
    let number = |(&slot, wanted): (&SlotId, &Value)| {
        let Value::Number(wanted) = wanted else { return None };
        let from = state.values.numbers[slot];
        Some(show(state, slot, from + (wanted - from) * part, from))
    };
    let numbers: Option<Vec<String>> = slots.iter().zip(wanted).map(number).collect();
    let path = state.structure.path(&state.lowered.document, thing).to_string();
    Some(Limit { path, value: tuple(&numbers?) })
}

/// Returns the same of a virtual part.
pub(crate) fn of_term(state: &State, term: &Term, wanted: &[Value], part: f64) -> Option<Limit> {
    let evaluator = state.evaluator(&state.values);
    let (&[Value::Number(wanted)], Ok(eval::Answer::Number(from, dimension))) =
        (wanted, evaluator.evaluate(term, DOCUMENT))
    else {
        return None;
    };
    let limit = from + (wanted - from) * part;
    let document = &state.lowered.document;
    let quantity = of_computed(state, dimension, term);
    let (text, unit) = lang::show_limit(limit, from, quantity, document);
    Some(Limit { path: words::term_path(term), value: words::with_unit(text, &unit) })
}

/// Returns the limit of several things that go the same part of their ways; nothing of none.
pub(crate) fn together(limits: Vec<Limit>) -> Option<Limit> {
    let joined = |a: String, b: String| format!("{a}, {b}");
    let both = |a: Limit, b: Limit| Limit {
        path: joined(a.path, b.path),
        value: joined(a.value, b.value),
    };
    limits.into_iter().reduce(both)
}

/// Says a limit as people say it.
pub(crate) fn in_words(limit: &Limit) -> String {
    let Limit { path, value } = limit;
    match value.strip_suffix(" deg") {
        Some(degrees) => format!("{degrees}° is the limit of {path}"),
        None => format!("{value} is the limit of {path}"),
    }
}

/// Says of a limit that is open what is never reached.
pub(crate) fn open_in_words(limit: &Limit) -> String {
    let Limit { path, value } = limit;
    format!("{path} has to stay short of {value}")
}

/// Says of a value that can be had what was not found out.
pub(crate) fn seen_in_words(limit: &Limit) -> String {
    let Limit { path, value } = limit;
    format!("{path} goes to {value}, and how much further was not decided")
}

/// Says where a drag has stopped short of the pointer: of a number, the limit; of a place, its reach from
/// an anchored place where that is what ends, else how far it is from the pointer.
pub(crate) fn of_drag(state: &State, drag: &Drag) -> (Limit, String) {
    let path = drag.held_path().to_string();
    if let Some(now) = drag.computed_now(state) {
        let show = |(&(x, dimension), &from): (&(f64, Dimension), &f64)| {
            // a point somewhere on a curve is known as well as the pointer tells
            let rounded = |decimals| base::number::rounded(x, decimals).parse().unwrap_or(x);
            let x = drag.grasp.map_or(x, rounded);
            let document = &state.lowered.document;
            let quantity = match drag.computed_term() {
                Some(term) => of_computed(state, dimension, term),
                None => Quantity { dimension, ..Quantity::default() },
            };
            let (text, unit) = lang::show_limit(x, from, quantity, document);
            words::with_unit(text, &unit)
        };
        let shown: Vec<String> = now.iter().zip(drag.start()).map(show).collect();
        let limit = Limit { path, value: tuple(&shown) };
        let words = in_words(&limit);
        return (limit, words);
    }
    let shown: Vec<String> = drag
        .handle_slots(state)
        .into_iter()
        .map(|(slot, start)| show(state, slot, drag.values.numbers[slot], start))
        .collect();
    let limit = Limit { path, value: tuple(&shown) };
    let Some((x, at)) = place_of(state, drag) else {
        let words = in_words(&limit);
        return (limit, words);
    };
    let short = away(at, drag.wish);
    let words = reach(state, drag).unwrap_or_else(|| {
        format!("{} is as far as it goes, {} short", limit.value, show(state, x, short, short))
    });
    (limit, words)
}

/// Returns how far a place that is dragged has stopped from the pointer, in units of the sheet; nothing of a number.
pub(crate) fn shortfall(state: &State, drag: &Drag) -> Option<f64> {
    place_of(state, drag).map(|(_, at)| away(at, drag.wish))
}

/// Says how far a place that is dragged reaches from an anchored place, where it lies straight between that and the
/// pointer.
pub(crate) fn reach(state: &State, drag: &Drag) -> Option<String> {
    let (x, at) = place_of(state, drag)?;
    let short = away(at, drag.wish);
    let place = |length: f64, from: f64| show(state, x, length, from);
    anchored_places(state, drag).find_map(|(thing, from)| {
        let (reach, wanted) = (away(from, at), away(from, drag.wish));
        let aside =
            (at[0] - from[0]) * (drag.wish[1] - at[1]) - (at[1] - from[1]) * (drag.wish[0] - at[0]);
        let is_straight = aside.abs() <= STRAIGHT * reach * short && wanted > reach;
        is_straight.then(|| {
            let name = state.structure.path(&state.lowered.document, thing);
            let (reach, wanted) = (place(reach, 0.0), place(wanted, wanted));
            format!("reach {reach} of {wanted} from {name}")
        })
    })
}

/// Returns where a place is that is dragged, with the slot of its first coordinate.
fn place_of(state: &State, drag: &Drag) -> Option<(SlotId, [f64; 2])> {
    let slots: Vec<SlotId> = drag.handle_slots(state).into_iter().map(|(slot, _)| slot).collect();
    let &[x, y] = slots.as_slice() else { return None };
    Some((x, [drag.values.numbers[x], drag.values.numbers[y]]))
}

/// The places that a drag depends on and cannot move.
fn anchored_places<'s>(
    state: &'s State,
    drag: &'s Drag,
) -> impl Iterator<Item = (ThingId, [f64; 2])> + 's {
    let mut held = drag.held();
    held.sort_unstable();
    let place = move |&slot: &SlotId| {
        let thing = state.structure.slots[slot].place?;
        let &[x, y] = state.structure.slots_under(thing).as_slice() else { return None };
        let numbers = &drag.values.numbers;
        (x == slot).then(|| (thing, [numbers[x], numbers[y]]))
    };
    held.iter().filter_map(place).collect::<Vec<_>>().into_iter()
}

fn away(from: [f64; 2], to: [f64; 2]) -> f64 {
    base::number::hypot(to[0] - from[0], to[1] - from[1])
}

/// Shows a number at the end of a way, in the unit that its value is written in.
fn show(state: &State, slot: SlotId, limit: f64, from: f64) -> String {
    if !matches!(state.structure.slots[slot].primitive, Primitive::Real(_)) {
        return base::number::shortest(limit);
    }
    let written = words::written_for(state, slot);
    let quantity = words::quantity_of(state, slot, &written);
    let (text, unit) = lang::show_limit(limit, from, quantity, &state.lowered.document);
    words::with_unit(text, &unit)
}

/// Returns what is known of a computed number: an angle is one by what computes it.
fn of_computed(state: &State, dimension: Dimension, term: &Term) -> Quantity<'static> {
    let evaluator = state.evaluator(&state.values);
    let class = angles::class_of_sides(state, &evaluator, DOCUMENT, [term, term]);
    Quantity { dimension, class, ..Quantity::default() }
}

fn tuple(numbers: &[String]) -> String {
    match numbers {
        [one] => one.clone(),
        several => format!("({})", several.join(", ")),
    }
}

/// Says which orientations are written that were not, and which are not any more.
pub(crate) fn sides(before: &State, after: &State) -> Vec<ModeView> {
    let told = |state: &State, other: &State, slot: SlotId, toward: Toward| {
        let (path, way) = state.structure.side_of(&state.lowered.document, slot, toward);
        (other.structure.sides.get(&slot) != Some(&toward)).then(|| (path, way.word()))
    };
    let new = after.structure.sides.iter().filter_map(|(&slot, &toward)| {
        let (path, way) = told(after, before, slot, toward)?;
        let message =
            format!("two branches meet at {path}: it goes on {way}, which is written (side)");
        Some(ModeView { constraint: path.to_string(), message, span: None })
    });
    let old = before.structure.sides.iter().filter_map(|(&slot, &toward)| {
        let (path, way) = told(before, after, slot, toward)?;
        let decided = !after.structure.sides.contains_key(&slot);
        let message = format!("{path} has gone {way}: its values say it now");
        decided.then(|| ModeView { constraint: path.to_string(), message, span: None })
    });
    new.chain(old).collect()
}

/// Says what was set and is not what it was set to, since weaker constraints act again once it is set.
pub(crate) fn sprung_back(state: &State, aims: &[(Aim, Vec<Value>)]) -> Vec<ModeView> {
    let is_other = |slot: SlotId, wanted: &Value| matches!(wanted, Value::Number(x) if !close(state.values.numbers[slot], *x));
    let told = |(aim, wanted): &(Aim, Vec<Value>)| {
        let Aim::Thing(thing) = aim else { return None };
        let both = state.structure.slots_under(*thing).into_iter().zip(wanted);
        let back = both.filter(|(slot, wanted)| is_other(*slot, wanted)).map(|(slot, _)| slot);
        let back: BTreeSet<SlotId> = back.collect();
        if back.is_empty() {
            return None;
        }
        let soft = (0..state.structure.constraints.len() as u32).map(Source::Constraint);
        let soft: Vec<Source> = soft
            .filter(|source| is_soft(state, *source))
            .filter(|&source| !words::read_by(state, &[source]).is_disjoint(&back))
            .collect();
        let by = match rules::all_told(state, &soft) {
            none if none.is_empty() => "weaker constraints act".to_string(),
            one if one.len() == 1 => format!("{}, which is weaker, acts", one[0]),
            several => format!("{}, which are weaker, act", words::listed(&several)),
        };
        let path = state.structure.path(&state.lowered.document, *thing).to_string();
        let is = words::show_thing(state, *thing, &state.values)?;
        let message = format!("{path} springs back to {is}: {by} again once it is set");
        Some(ModeView { constraint: path, message, span: None })
    };
    aims.iter().filter_map(told).collect()
}

/// Returns true for a constraint that is not required.
fn is_soft(state: &State, source: Source) -> bool {
    let Source::Constraint(c) = source else { return false };
    let instance = state.structure.constraints[c as usize];
    let strength = state.structure.strength(&state.lowered.document, instance);
    strength != Strength::Required && state.structure.is_on(instance)
}

/// Says which courses programs take otherwise than before.
pub(crate) fn courses(state: &State, changes: &[CourseChange]) -> Vec<ModeView> {
    let view = |change: &CourseChange| ModeView {
        constraint: state.structure.path(&state.lowered.document, change.of).to_string(),
        message: words::course(state, change),
        span: None,
    };
    changes.iter().map(view).collect()
}

/// Says what acts otherwise than before.
pub(crate) fn modes(state: &State, changes: &[ModeChange]) -> Vec<ModeView> {
    changes.iter().filter_map(|change| mode(state, *change)).collect()
}

/// Says how a constraint acts, with its rule as it is written.
pub(crate) fn mode(state: &State, change: ModeChange) -> Option<ModeView> {
    let constraint = words::source_name(state, change.acting.source)?;
    let Source::Constraint(index) = change.acting.source else { return None };
    let instance = state.structure.constraints[index as usize];
    let class = &state.lowered.document.classes[instance.class];
    let declared = &class.constraints[instance.index as usize];
    let rule = &words::rule_alone(state, index);
    let unnamed = rules::unnamed(state, index);
    let told = unnamed.as_deref().unwrap_or(&constraint);
    let acts = words::acting(state, told, change.acting.kind);
    let message = match (change.acting.kind, change.begins) {
        (ActingKind::AtBound, true) if unnamed.is_some() => acts,
        (ActingKind::AtBound, true) => format!("{acts}: {rule}"),
        (ActingKind::AtBound, false) if unnamed.is_some() => format!("{told} is off its bound"),
        (ActingKind::AtBound, false) => format!("{constraint} is off its bound: {rule}"),
        (ActingKind::Taken { way, of }, _) => match alternative(rule, way, of) {
            Some(way) => format!("{acts}: {way}"),
            None => acts,
        },
        (ActingKind::Whole { .. } | ActingKind::Assumed(_), _) => acts,
    };
    let span = state.lowered.own_span(declared.origin).map(|s| (s.start, s.end));
    Some(ModeView { constraint, message, span })
}

/// Returns an alternative of a rule as it is written, where the rule is plainly alternatives.
fn alternative(rule: &str, way: u32, of: u32) -> Option<&str> {
    let ways: Vec<&str> = rule.split(" or ").collect();
    let is_whole = |w: &&str| w.matches('(').count() == w.matches(')').count();
    (ways.len() == of as usize && ways.iter().all(is_whole)).then(|| ways[way as usize].trim())
}
