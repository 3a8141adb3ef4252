//! Parts that are one and are given unlike values: a warning that says which of these counts.
//!
//! In: a state. Out: for every line of the document that gives a value which does not count, where another part's
//! does. What a class gives its things yields without a word, for that is what a default is for: but one that the class
//! anchors is told where it yields. Where both are anchored neither yields, and the merge is an error, of a class too.

use crate::state::State;
use crate::words::show_thing;
use crate::yielding;
use base::number::ROUNDING;
use base::{Diagnostic, IdVec, Place};
use eval::Answer;
use kernel::{Class, GivenTerm, Path, SlotId, Structure, Term, ThingId, Value, Values};
use std::collections::{BTreeMap, BTreeSet};

/// The code of the warning.
const CODE: &str = "unlike-given";

/// What one line gives that does not count.
struct Line {
    /// The part that the line speaks of, and the one that counts.
    parts: [ThingId; 2],
    /// Where the value that counts is given.
    counts: Place,
    /// By slot, what the line gives and what counts.
    values: Vec<(SlotId, [Value; 2])>,
    /// True if both are anchored at what they are given, in one coordinate at least.
    holds: bool,
    /// True if what does not count is what a class gives and anchors.
    of_class: bool,
}

/// Returns a warning for every line that gives what does not count.
///
/// Cost: a look at every thing that is merged.
pub(crate) fn warnings(state: &State) -> Vec<Diagnostic> {
    let structure = &state.structure;
    let mut lines: BTreeMap<(u32, u32, ThingId), (Place, Line)> = BTreeMap::new();
    let mut anchored: IdVec<ThingId, bool> = IdVec::filled(false, structure.things.len());
    let anchors = structure.stays.iter().filter(|stay| stay.strength.is_none());
    anchors.for_each(|stay| anchored[stay.thing] = true);
    let is_anchored = |thing: ThingId| around(structure, thing).any(|t| anchored[t]);
    let is_own = |(term, _): (&GivenTerm, ThingId)| state.lowered.is_own_given(term.origin);
    let mut bodies = Bodies::of(state);
    let merged = structure.merged.iter().filter(|(t, _)| structure.is_merged(*t));
    for (thing, _) in merged {
        let Some(slot) = structure.slot_of(thing) else { continue };
        let given = structure.given_in(slot).or_else(|| binding(structure, thing, slot));
        let (Some(given), Some(own)) = (given, structure.given_apart_in(thing)) else { continue };
        if given.0.origin == own.0.origin || is_own(own) && !is_own(given) {
            continue;
        }
        // a default yields, if it is not anchored
        if !is_own(own) && !is_anchored(thing) {
            continue;
        }
        let value = |(given, me): (&GivenTerm, ThingId)| value(state, &given.term, me);
        let (Some(is), Some(was)) = (value(given), value(own)) else { continue };
        if are_alike(&is, &was) {
            continue;
        }
        let counts = |t: &ThingId| structure.given_apart_in(*t) == Some(given);
        let Some(by) = structure.merged_with(thing).into_iter().find(counts) else { continue };
        let holds = is_anchored(thing) && is_anchored(by);
        if !is_own(own) {
            let is_held = match bodies.anchoring(thing) {
                Some(by) => holds || around(structure, by).any(|t| t == own.1),
                None => holds && !is_own(given),
            };
            if !is_held || bodies.is_connected(thing, own.1) {
                continue;
            }
        }
        let (of_class, giver) = (!is_own(own), own.1);
        let (given, own) = (given.0, own.0);
        let place = state.lowered.place(own.origin);
        let (_, line) =
            lines.entry((place.span.start, place.span.end, giver)).or_insert_with(|| {
                let parts = [whole(state, thing), whole(state, by)];
                let counts = state.lowered.place(given.origin);
                (place, Line { parts, counts, values: Vec::new(), holds: false, of_class })
            });
        line.holds |= holds;
        line.values.push((slot, [was, is]));
    }
    if lines.is_empty() { Vec::new() } else { told(bodies, lines.into_values()) }
}

#[cold]
#[inline(never)]
fn told(mut bodies: Bodies<'_>, lines: impl Iterator<Item = (Place, Line)>) -> Vec<Diagnostic> {
    let mut values = bodies.state.values.clone();
    lines.map(|(place, line)| warning(&mut bodies, &mut values, place, &line)).collect()
}

/// Returns what a slot is bound to: of the parts that are one, the first that is given by others.
fn binding(structure: &Structure, thing: ThingId, slot: SlotId) -> Option<(&GivenTerm, ThingId)> {
    if !structure.bound.contains(&slot) {
        return None;
    }
    let all = structure.merged_with(thing).into_iter();
    let mut given = all.filter_map(|thing| structure.given_apart_in(thing));
    given.find(|(given, _)| !matches!(*given.term, Term::Number { .. } | Term::Text(_)))
}

/// What bodies say of parts, by the thing whose body it is: found once for each.
struct Bodies<'a> {
    state: &'a State,
    connected: BTreeMap<ThingId, BTreeSet<ThingId>>,
    anchored: BTreeMap<ThingId, BTreeSet<ThingId>>,
    merged: BTreeMap<ThingId, Merges>,
}

/// The merges of a thing's class by what they name: which of them, and the how manieth path there.
type Merges = BTreeMap<ThingId, Vec<(usize, usize)>>;

impl<'a> Bodies<'a> {
    fn of(state: &'a State) -> Self {
        let (connected, anchored, merged) = Default::default();
        Self { state, connected, anchored, merged }
    }

    /// Returns what has a thing and anchors it by its class, the innermost; nothing where the document's own text does.
    fn anchoring(&mut self, thing: ThingId) -> Option<ThingId> {
        let state = self.state;
        around(&state.structure, thing).find(|&host| {
            let parts = self.anchored.entry(host).or_insert_with(|| {
                parts_of(state, host, |class| {
                    let stays = class.stays.iter().filter(|stay| {
                        stay.strength.is_none() && !state.lowered.is_own_given(stay.origin)
                    });
                    stays.map(|stay| &stay.path).collect()
                })
            });
            around(&state.structure, thing).any(|t| parts.contains(&t))
        })
    }

    /// Returns where the classes of what has a part say that it is one with another, or what has it is.
    fn merged_at(&mut self, thing: ThingId, other: ThingId) -> Option<Place> {
        let (state, structure) = (self.state, &self.state.structure);
        let all: BTreeSet<ThingId> =
            around(structure, thing).chain(around(structure, other)).collect();
        around(structure, thing).find_map(|host| {
            let named = self.merged.entry(host).or_insert_with(|| merges_of(state, host));
            let paths: BTreeSet<(usize, usize)> =
                all.iter().filter_map(|t| named.get(t)).flatten().copied().collect();
            let mut paths = paths.iter().map(|(merge, _)| *merge).zip(paths.iter().skip(1));
            let (merge, _) = paths.find(|(merge, (next, _))| merge == next)?;
            let class = &state.lowered.document.classes[structure.things[host].class];
            Some(state.lowered.place(class.merges[merge].origin))
        })
    }

    /// Returns true if a body of `giver`, or of what that is in, connects a thing with another.
    fn is_connected(&mut self, thing: ThingId, giver: ThingId) -> bool {
        let state = self.state;
        around(&state.structure, giver).any(|host| {
            let parts = self.connected.entry(host).or_insert_with(|| {
                parts_of(state, host, |class| class.connections.iter().map(|c| &c.path).collect())
            });
            around(&state.structure, thing).any(|t| parts.contains(&t))
        })
    }
}

/// Finds what the merges of a thing's class name. Cost: a look at each of them.
fn merges_of(state: &State, host: ThingId) -> Merges {
    let structure = &state.structure;
    let merges = &state.lowered.document.classes[structure.things[host].class].merges;
    let mut named = Merges::new();
    for (i, merge) in merges.iter().enumerate() {
        for (j, path) in merge.paths.iter().enumerate() {
            let Ok(thing) = structure.follow(host, path) else { continue };
            for thing in BTreeSet::from([thing, structure.merged[thing]]) {
                named.entry(thing).or_default().push((i, j));
            }
        }
    }
    named
}

/// Returns the parts of a thing that its classes speak of.
fn parts_of<'a>(
    state: &'a State,
    host: ThingId,
    paths: impl Fn(&'a Class) -> Vec<&'a Path>,
) -> BTreeSet<ThingId> {
    let (structure, document) = (&state.structure, &state.lowered.document);
    let line = document.primary_line(structure.things[host].class).into_iter();
    let said = line.flat_map(|class| paths(&document.classes[class]));
    said.filter_map(|path| structure.follow(host, path).ok()).collect()
}

/// Returns a thing and all that it is in: lists too, which own no part by its name.
pub(crate) fn around(structure: &Structure, thing: ThingId) -> impl Iterator<Item = ThingId> {
    std::iter::successors(Some(thing), |&t| structure.things[t].owner)
}

/// Returns the place that a coordinate belongs to, or the thing itself.
fn whole(state: &State, thing: ThingId) -> ThingId {
    let structure = &state.structure;
    let is_place = |t: &ThingId| state.lowered.document.is_place(structure.things[*t].class);
    structure.owner(thing).filter(is_place).unwrap_or(thing)
}

/// Returns what a given value comes to; nothing where that is not known.
fn value(state: &State, term: &Term, me: ThingId) -> Option<Value> {
    match term {
        Term::Number { value, .. } => Some(Value::Number(*value)),
        Term::Text(text) => Some(Value::Text(text.as_str().into())),
        computed => match state.evaluator(&state.values).evaluate(computed, me).ok()? {
            Answer::Number(x, _) => Some(Value::Number(x)),
            Answer::Text(text) => Some(Value::Text(text)),
            _ => None,
        },
    }
}

/// Returns true for values that nobody can tell apart: `1.1 in` and `27.94 mm` differ by rounding alone.
fn are_alike(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => (a - b).abs() <= ROUNDING * a.abs().max(b.abs()),
        _ => a == b,
    }
}

/// Tells of a line; `values` are those of the state.
fn warning(bodies: &mut Bodies<'_>, values: &mut Values, place: Place, line: &Line) -> Diagnostic {
    let state = bodies.state;
    let path = |thing| state.structure.path(&state.lowered.document, thing).to_string();
    let mut shown = |which: usize| {
        line.values.iter().for_each(|(slot, both)| values.put(*slot, both[which].clone()));
        let shown = show_thing(state, line.parts[0], values).unwrap_or_default();
        line.values.iter().for_each(|(slot, _)| values.put(*slot, state.values.get(*slot)));
        shown
    };
    let [part, other] = line.parts.map(path);
    let (was, is) = (shown(0), shown(1));
    let merged = bodies.merged_at(line.parts[0], line.parts[1]);
    if line.holds {
        let message =
            format!("{part} is anchored at {was}, and {other} at {is}: they cannot be one");
        let d = Diagnostic::error(CODE, merged.unwrap_or(place), message);
        return d.label(line.counts, "here").label(place, "here").hint("anchor one of them alone");
    }
    if line.of_class {
        let message = format!(
            "{part} is anchored by its class at {was}, and is one with {other}: {is} counts"
        );
        let d = Diagnostic::warning(yielding::CODE, merged.unwrap_or(place), message);
        let d = d.label(line.counts, "here").label(place, "here");
        return d.hint("give it this value in the body of the part, or take the other away");
    }
    let message = format!("{part} is given here as {was}, and is one with {other}: {is} counts");
    let d = Diagnostic::warning(CODE, place, message).label(line.counts, "here");
    let d = match merged {
        Some(merge) => d.label(merge, "they are made one here"),
        None => d,
    };
    d.hint("give the value once, where it counts")
}
