//! Writing back: the values that an edit came to, as the fewest changes of the text.
//!
//! In: a state, and the values after an edit. Out: the text whose state has these values. Given numbers that changed
//! are rewritten where they stand, after what is done by hand without digits that only computing has made; then the
//! text is opened, and while a value differs from what the edit came to, one that does is given as well: one whose
//! class gives it a value, else one that the edit was about, else the first. Given numbers that the edit left alone and
//! that come to other bits, since they give way whenever the text is opened, are written as they are. What is bound to
//! others keeps what it is bound by. Where the fewer digits do not say the same, all are written. A quantity that
//! nothing decides and that nothing is placed by, as the voltages of a circuit without a ground, is not written: it is
//! what opening the text gives, unless what the edit was about is bound to it.

use crate::host::Host;
use crate::state::State;
use crate::texts::Texts;
use crate::tools::digits;
use base::number::{RULE_TOLERANCE, Toward, close};
use kernel::{
    GivenIn, GivenTerm, Literal, Path, Primitive, SideWay, SlotId, Term, ThingId, Value, Values,
};
use plan::{Planner, Plans};
use std::collections::{BTreeMap, BTreeSet};

/// What an edit was about.
#[derive(Default)]
pub(crate) struct Edited {
    /// Its slots.
    pub(crate) slots: Vec<SlotId>,
    /// The numbers that it gave itself, of what is done by hand: these are written to the last digit, and what follows
    /// from them to those that are more than rounding. What is set is written with all that comes of it.
    pub(crate) by_hand: Option<Vec<f64>>,
}

/// Makes the state whose text gives these values, and its planner.
///
/// The state's values agree with `wanted` to the tolerance of rules; it is they that count from now
/// on, so that a saved document opens as it was left, bit for bit.
pub(crate) fn write_back(
    state: &State,
    wanted: &Values,
    edited: &Edited,
    host: &dyn Host,
    plans: Plans,
) -> (State, Planner) {
    let Some(given) = &edited.by_hand else {
        return written(state, wanted, &edited.slots, None, (host, plans));
    };
    let (next, mut planner) = written(state, wanted, &edited.slots, Some(given), (host, plans));
    if is_as_exact(&next, wanted, &edited.slots, &mut planner) {
        return (next, planner);
    }
    written(state, wanted, &edited.slots, None, (host, planner.into_plans()))
}

/// Whether a text that was written with fewer digits says what it should: what holds as it is given, so that nothing
/// gives way when it is opened, and values that are the same for everybody who looks at them, however small they are.
fn is_as_exact(next: &State, wanted: &Values, edited: &[SlotId], planner: &mut Planner) -> bool {
    if next.structure.slots.len() != wanted.numbers.len() {
        return false;
    }
    let changed: Vec<SlotId> = next.values.changed(wanted).collect();
    if changed.is_empty() {
        return true;
    }
    let given = eval::given_values(&next.lowered.document, &next.structure).0;
    let stands = |&slot: &SlotId| given.get(slot).same_bits(&next.values.get(slot));
    let is_given = |slot: &&SlotId| next.structure.given(**slot).is_some();
    let mut meant = wanted.clone();
    let (_, undecided) = decided(next, changed.clone(), edited, planner);
    for slot in undecided {
        meant.numbers[slot] = next.values.numbers[slot];
    }
    changed.iter().filter(is_given).all(stands)
        && digits::has_values(next, &meant, RULE_TOLERANCE)
        && next.status(planner).satisfied
}

/// Parts slots whose values differ after opening: those that something decides, that the edit was about, or that
/// something drawn may be placed by, and the others.
fn decided(
    next: &State,
    differing: Vec<SlotId>,
    edited: &[SlotId],
    planner: &mut Planner,
) -> (Vec<SlotId>, Vec<SlotId>) {
    let is_quantity = |slot: &SlotId| {
        let s = &next.structure.slots[*slot];
        let places = [expr::Dimension::NONE, expr::Dimension::LENGTH];
        let is_other = matches!(s.primitive, Primitive::Real(d) if !places.contains(&d));
        is_other && s.given.is_none() && !edited.contains(slot)
    };
    if !differing.iter().any(is_quantity) {
        return (differing, Vec::new());
    }
    let mut texts = Texts::new(&next.lowered.document, &next.structure);
    let arbitrary = planner.arbitrary(next.model(), &next.values, &mut texts);
    differing.into_iter().partition(|slot| !(is_quantity(slot) && arbitrary.contains(slot)))
}

/// Returns which of the numbers that are written are to have all their digits: those that a hand gave, and those that
/// something has that stays as it is.
fn meant(
    state: &State,
    wanted: &Values,
    given: &[f64],
    writes: &[(Path, Literal)],
) -> BTreeSet<u64> {
    let mut numbers = BTreeSet::new();
    let mut literals: Vec<&Literal> = writes.iter().map(|(_, literal)| literal).collect();
    while let Some(literal) = literals.pop() {
        match literal {
            Literal::Number(x) => {
                numbers.insert(x.to_bits());
            }
            Literal::Tuple(items) => literals.extend(items),
            Literal::Bool(_) | Literal::Text(_) | Literal::Path(_) => {}
        }
    }
    let was = &state.values.numbers;
    let stays = wanted.numbers.iter().map(|(slot, x)| (x.to_bits(), was[slot].to_bits()));
    let stays = stays.filter(|(is, was)| is == was && numbers.contains(is)).map(|(is, _)| is);
    given.iter().map(|x| x.to_bits()).chain(stays).collect()
}

/// Makes the state whose text gives these values, and its planner: numbers to the digits that are meant, or all; of what
/// is done by hand, `given` are the numbers that it gave.
fn written(
    state: &State,
    wanted: &Values,
    edited: &[SlotId],
    given: Option<&[f64]>,
    (host, mut plans): (&dyn Host, Plans),
) -> (State, Planner) {
    let unit = |slot: SlotId| unit_of_change(state, wanted, slot);
    let is_given = |slot: SlotId| {
        let given = state.structure.given(slot);
        // a lone number that is given would hold, whoever gives it
        let is_lone = state.structure.slots[slot].place.is_none();
        given.is_some_and(|g| is_lone || state.lowered.is_own_given(g.origin))
    };
    let is_same = |slot: SlotId| wanted.get(slot).same_bits(&state.values.get(slot));
    let changed = wanted.changed(&state.values);
    let mut written: BTreeSet<ThingId> = changed.filter(|&slot| is_given(slot)).map(unit).collect();
    // where something is drawn that says no place depends on all that is drawn: what was put somewhere says so
    let is_layout = |slot: &SlotId| {
        state.structure.slots[*slot].is_layout && state.structure.given(*slot).is_none()
    };
    written.extend(edited.iter().copied().filter(is_layout).map(unit));
    let mut more = 1;
    loop {
        let writes: Vec<(Path, Literal)> = written
            .iter()
            .flat_map(|&t| {
                let at = written_at(state, t);
                std::iter::once(at).chain(given_alike(state, at))
            })
            .map(|t| (state.structure.path(&state.lowered.document, t), literal(state, t, wanted)))
            .collect();
        let edits = match given {
            Some(given) => {
                let meant = meant(state, wanted, given, &writes);
                lang::write_rounded(&state.lowered, &writes, &meant)
            }
            None => lang::write_values(&state.lowered, &writes),
        };
        let text = syntax::edit::apply(&state.text, &edits);
        let (next, mut planner) = State::written(text, state, host, plans);
        if next.structure.slots.len() != state.structure.slots.len() {
            // what was written decides how many things there are: these are others
            return (next, planner);
        }
        let rank = |slot: &SlotId| match state.structure.slots[*slot].given {
            Some(_) => 0,
            None if edited.contains(slot) => 1,
            None => 2,
        };
        // what is bound to others comes of these: a number in its place would be the end of what the writer bound it by
        let is_missing = |slot: &SlotId| {
            !written.contains(&unit(*slot)) && !state.structure.bound.contains(slot)
        };
        let mut missing: Vec<SlotId> = differing(&next, wanted).filter(is_missing).collect();
        // what is bound, and was set, comes of what nothing else decides: that is written then
        let is_lost = |slot: &SlotId| next.structure.bound.contains(slot) && edited.contains(slot);
        if !differing(&next, wanted).any(|slot| is_lost(&slot)) {
            missing = decided(&next, missing, edited, &mut planner).0;
        }
        // what is off for want of digits is not to be given: then all digits are written
        if given.is_some() && !missing.is_empty() && !missing.iter().any(|s| edited.contains(s)) {
            return (next, planner);
        }
        missing.sort_by_key(rank);
        missing.truncate(more);
        if missing.is_empty() {
            // what the edit left alone has the bits that it had, where it is given and gave way when it was opened
            let moved = next.values.changed(wanted).filter(|&slot| is_given(slot) && is_same(slot));
            let moved: BTreeSet<ThingId> = moved.map(unit).collect();
            if moved.is_subset(&written) {
                return (next, planner);
            }
            written.extend(moved);
            plans = planner.into_plans();
            continue;
        }
        written.extend(missing.into_iter().map(unit));
        // One at a time while there are few: the first may determine the others.
        more = if written.len() < 8 { 1 } else { more * 2 };
        plans = planner.into_plans();
    }
}

/// Whether a number is how large something is drawn: a length that stands beside a place, as a radius beside a centre.
fn is_size(state: &State, slot: SlotId) -> bool {
    let structure = &state.structure;
    let s = &structure.slots[slot];
    let is_length = s.primitive == Primitive::Real(expr::Dimension::LENGTH);
    let owner = structure.things[s.thing].owner.filter(|&owner| owner != kernel::DOCUMENT);
    let document = &state.lowered.document;
    is_length
        && owner.is_some_and(|owner| {
            structure.parts(owner).any(|part| document.is_place(structure.things[part].class))
        })
}

/// Has the text give places, and sizes beside them, as they are that gave way to what a hand has just said, so that
/// they open as they are seen. What a class gives, and other numbers, stay as they are written.
pub(crate) fn settle_places(
    before: &State,
    state: State,
    planner: Planner,
    host: &dyn Host,
) -> (State, Planner) {
    if state.has_errors() {
        return (state, planner);
    }
    let is_told = |slot: &SlotId| {
        let s = &state.structure.slots[*slot];
        let is_own = state.structure.given(*slot).is_some_and(|given| !given.of_class);
        is_own && (s.place.is_some() || is_size(&state, *slot))
    };
    let slots = state.gave_way.iter().map(|(slot, _)| *slot).filter(is_told);
    let units: BTreeSet<ThingId> = slots.map(|slot| unit_of_writing(&state, slot)).collect();
    if units.is_empty() {
        return (state, planner);
    }
    let document = &state.lowered.document;
    let path = |t: ThingId| state.structure.path(document, written_at(&state, t));
    let writes: Vec<(Path, Literal)> =
        units.iter().map(|&t| (path(t), literal(&state, t, &state.values))).collect();
    let apply = |edits: &[syntax::TextEdit]| syntax::edit::apply(&state.text, edits);
    let short = apply(&lang::write_rounded(&state.lowered, &writes, &BTreeSet::new()));
    let (next, mut planner) = State::written(short, &state, host, planner.into_plans());
    if is_as_exact(&next, &state.values, &[], &mut planner) {
        return (next, planner);
    }
    let whole = apply(&lang::write_values(&state.lowered, &writes));
    let (next, planner) = State::written(whole, &state, host, planner.into_plans());
    match is_same(&next, &state) {
        true => (next, planner),
        false => State::of(state.text, Some(before), host, planner.into_plans()),
    }
}

/// Whether two states are of the same things with the same values.
fn is_same(next: &State, state: &State) -> bool {
    next.structure.slots.len() == state.structure.slots.len()
        && differing(next, &state.values).next().is_none()
}

/// Returns which way slots go from where two branches meet, after an edit: as the edit says, and as is
/// written of what it did not move. Where values decide, nothing is to be written.
pub(crate) fn sides_after(
    before: &State,
    values: &Values,
    undecided: &[(SlotId, Toward)],
) -> BTreeMap<SlotId, Toward> {
    let mut sides: BTreeMap<SlotId, Toward> = undecided.iter().copied().collect();
    for (&slot, &toward) in &before.structure.sides {
        let unit = unit_of_writing(before, slot);
        let is_told = undecided.iter().any(|&(s, _)| unit_of_writing(before, s) == unit);
        let stays =
            |s: &SlotId| values.numbers[*s].to_bits() == before.values.numbers[*s].to_bits();
        if !is_told && before.structure.slots_under(unit).iter().all(stays) {
            sides.insert(slot, toward);
        }
    }
    sides
}

/// Makes the state whose text says these sides, and its planner. Besides, bodies say sides of their parts, and what is
/// given no value keeps the side that is written of it, where the text opens elsewhere without.
pub(crate) fn write_sides(
    state: State,
    planner: Planner,
    sides: &BTreeMap<SlotId, Toward>,
    host: &dyn Host,
) -> (State, Planner) {
    let is_open = |slot: &SlotId| state.structure.given(*slot).is_none();
    let leaves = |slot: &SlotId| is_open(slot) && !sides.contains_key(slot);
    let leaving: BTreeMap<SlotId, Toward> =
        state.structure.sides.iter().map(|(&s, &t)| (s, t)).filter(|(s, _)| leaves(s)).collect();
    let Some(text) = saying_sides(&state, sides) else { return (state, planner) };
    let (next, planner) = State::written(text, &state, host, planner.into_plans());
    if leaving.is_empty() || is_same(&next, &state) {
        return (next, planner);
    }
    let sides = sides.iter().chain(&leaving).map(|(&slot, &toward)| (slot, toward)).collect();
    match saying_sides(&state, &sides) {
        Some(text) => State::written(text, &state, host, planner.into_plans()),
        None => State::written(state.text.clone(), &state, host, planner.into_plans()),
    }
}

/// Returns the text of a state with these sides and, besides what bodies say of their parts, no others; nothing where
/// it says so.
fn saying_sides(state: &State, sides: &BTreeMap<SlotId, Toward>) -> Option<String> {
    if *sides == state.structure.sides {
        return None;
    }
    let document = &state.lowered.document;
    let is_said =
        |(slot, toward): &(&SlotId, &Toward)| state.structure.sides.get(*slot) == Some(*toward);
    let (kept, new): (Vec<_>, Vec<_>) = sides.iter().partition(is_said);
    let [kept, new] = [kept, new].map(|sides: Vec<(&SlotId, &Toward)>| -> Vec<(Path, SideWay)> {
        let written = sides.into_iter().map(|(&slot, &toward)| (slot, toward));
        written.map(|(slot, toward)| state.structure.side_of(document, slot, toward)).collect()
    });
    let edits = lang::write_sides(&state.lowered, &kept, &new);
    (!edits.is_empty()).then(|| syntax::edit::apply(&state.text, &edits))
}

/// Returns the slots whose values differ by more than rounding.
pub(crate) fn differing<'a>(
    next: &'a State,
    wanted: &'a Values,
) -> impl Iterator<Item = SlotId> + 'a {
    next.values.changed(wanted).filter(|&slot| match (next.values.get(slot), wanted.get(slot)) {
        (Value::Number(a), Value::Number(b)) => !close(a, b),
        (a, b) => !a.same_bits(&b),
    })
}

/// Returns the place that a slot is a coordinate of, where that is nothing else, else its own thing.
pub(crate) fn unit_of_writing(state: &State, slot: SlotId) -> ThingId {
    let slots = &state.structure.slots;
    let is_all = |&place: &ThingId| {
        let of_place = |&s: &SlotId| slots[s].place == Some(place);
        state.structure.slots_under(place).iter().all(of_place)
    };
    slots[slot].place.filter(is_all).unwrap_or(slots[slot].thing)
}

/// Returns what is written where a slot changes: a place as a whole, but for one whose class gives a
/// coordinate that stays as it is. Of that the others are written by their names.
fn unit_of_change(state: &State, wanted: &Values, slot: SlotId) -> ThingId {
    let structure = &state.structure;
    let unit = unit_of_writing(state, slot);
    let stays = |&s: &SlotId| {
        let of_class = |g: GivenIn| {
            g.me == unit && !state.lowered.is_own_given(structure.givens[g.value].origin)
        };
        structure.slots[s].given.is_some_and(of_class)
            && wanted.get(s).same_bits(&state.values.get(s))
    };
    match structure.slots_under(unit).iter().any(stays) {
        true => structure.slots[slot].thing,
        false => unit,
    }
}

/// Returns the thing by whose path a thing's value is written: of merged ones the one that gives it, if the
/// text itself does, else the first.
fn written_at(state: &State, unit: ThingId) -> ThingId {
    let structure = &state.structure;
    let class = |t: ThingId| structure.things[t].class;
    let mut others = structure.merged_with(unit);
    others.retain(|&t| class(t) == class(unit));
    if others.len() < 2 {
        return unit;
    }
    let gives = |&t: &ThingId| {
        let leaves =
            if structure.slot_of(t).is_some() { vec![t] } else { structure.parts(t).collect() };
        leaves.iter().any(|&leaf| {
            let Some(slot) = structure.slot_of(leaf) else { return false };
            let (given, own) = (structure.given(slot), structure.given_apart(leaf));
            given.is_some_and(|g| Some(g) == own && state.lowered.is_own_given(g.origin))
        })
    };
    others.into_iter().find(gives).unwrap_or(unit)
}

/// Returns what else the text gives of what is merged with a thing, where it gives the same numbers: they go on agreeing.
fn given_alike(state: &State, at: ThingId) -> Vec<ThingId> {
    let structure = &state.structure;
    let number = |given: Option<&GivenTerm>| {
        let given = given?;
        let Term::Number { value, .. } = *given.term else { return None };
        state.lowered.is_own_given(given.origin).then_some((value, given.origin))
    };
    let is_alike = |&leaf: &ThingId| {
        let given = structure.slot_of(leaf).and_then(|slot| number(structure.given(slot)));
        let both = given.zip(number(structure.given_apart(leaf)));
        both.is_some_and(|((is, by), (own, at))| by != at && is.to_bits() == own.to_bits())
    };
    let class = |t: ThingId| structure.things[t].class;
    let others = structure.merged_with(at).into_iter();
    let others = others.filter(|&t| t != at && class(t) == class(at));
    let alike = others.filter_map(|t| {
        let leaves = match structure.slot_of(t) {
            Some(_) => vec![t],
            None => structure.parts(t).collect(),
        };
        let is_given = |leaf: &ThingId| number(structure.given_apart(*leaf)).is_some();
        let given: Vec<ThingId> = leaves.into_iter().filter(is_given).collect();
        // of a place that is elsewhere no coordinate follows
        given.iter().all(is_alike).then_some(given)
    });
    alike.flatten().collect()
}

/// Returns what a thing is worth, as the language writes it.
pub(crate) fn literal(state: &State, thing: ThingId, values: &Values) -> Literal {
    match state.structure.slot_of(thing) {
        Some(slot) => match (state.structure.slots[slot].primitive, values.get(slot)) {
            (Primitive::Bool, Value::Number(x)) => Literal::Bool(x != 0.0),
            (_, Value::Number(x)) => Literal::Number(x),
            (_, Value::Text(t)) => Literal::Text(t.to_string()),
        },
        None => {
            let parts = state.structure.parts(thing);
            Literal::Tuple(parts.map(|p| literal(state, p, values)).collect())
        }
    }
}
