//! Finishing: the document's body in, its structure out, with slots and sets.

use super::bind::bind;
use super::body::Body;
use super::copies::is_of_itself;
use super::counting::Counting;
use super::refer::refer;
use super::{FaultKind, Maker};
use crate::class::{Class, ClassId, ClassKind, Primitive};
use crate::document::{Document, Side};
use crate::structure::{Form, GivenIn, Givens, NO_SLOT, Slot, SlotId, ThingId, Unlike};
use crate::term::OriginId;
use base::IdVec;
use std::collections::BTreeMap;

/// Gives slots to the primitive things, and members to the sets.
pub(super) fn finish(maker: &mut Maker<'_>, body: Body, givens: &Givens) -> Form {
    let order = in_order(&body);
    let mut structure = Form {
        own_slots: IdVec::filled(NO_SLOT, body.things.len()),
        next_merged: rings(&body, &order),
        layouts: std::mem::take(&mut maker.layouts),
        ..Form::default()
    };
    structure.slots.reserve(body.things.len());
    give_slots(maker, &body, &order, givens, &mut structure);
    structure.slots.shrink_to_fit();
    let references = given_references(maker, &body);
    let first = |t: ThingId| body.merged[t];
    // by their ranks, which tell the things
    let rank = |&(set, part): &(ThingId, ThingId)| (body.rank[first(set)], body.rank[first(part)]);
    let mut members: Vec<(u32, u32)> = body.members.iter().map(rank).collect();
    members.sort_unstable();
    members.dedup();
    for own in members.chunk_by(|a, b| a.0 == b.0) {
        let parts = own.iter().map(|&(_, part)| order[part as usize]).collect();
        structure.sets.insert(order[own[0].0 as usize], parts);
    }
    structure.things = body.things;
    structure.merged = body.merged;
    structure.constraints = body.constraints;
    structure.stays = body.stays;
    let unlike = body.unlike.keys().map(|&t| (t, first_of_each(&structure, t)));
    structure.unlike = Unlike::new(unlike, &structure.merged);
    for index in 0..structure.stays.len() {
        let stay = structure.stays[index];
        if stay.strength.is_none() {
            for slot in structure.slots_under(stay.thing) {
                structure.slots[slot].anchored = true;
            }
        }
    }
    refer(maker, &mut structure, givens, &references);
    bind(maker.document, &mut structure, givens);
    say_sides(maker.document, &order, &mut structure);
    structure
}

/// Says which way slots go from where two branches meet: what a whole says counts more than what its parts
/// say of themselves, a class more than those above it.
fn say_sides(document: &Document, order: &[ThingId], structure: &mut Form) {
    if document.classes.iter().all(|(_, class)| class.sides.is_empty()) {
        return;
    }
    let mut said: BTreeMap<ClassId, Vec<&Side>> = BTreeMap::new();
    for &thing in order.iter().rev() {
        let class = structure.things[thing].class;
        let sides = said.entry(class).or_insert_with(|| {
            let lineage = document.lineage(class).into_iter().rev();
            lineage.flat_map(|c| &document.classes[c].sides).collect()
        });
        for side in sides {
            let part = structure.follow(thing, &side.path).ok();
            if let Some(slot) = part.and_then(|t| structure.slot_of_side(t, side.way)) {
                structure.sides.insert(slot, side.way.toward(document.vertical));
            }
        }
    }
}

/// Returns what is given to references.
fn given_references(maker: &Maker<'_>, body: &Body) -> BTreeMap<ThingId, GivenIn> {
    let names = |class: &Class| matches!(class.kind, ClassKind::Reference(_));
    if !maker.document.classes.iter().any(|(_, class)| names(class)) {
        return BTreeMap::new();
    }
    let given = |(thing, given): (ThingId, &Option<GivenIn>)| {
        let kind = &maker.document.classes[body.things[thing].class].kind;
        given.filter(|_| matches!(kind, ClassKind::Reference(_))).map(|g| (thing, g))
    };
    body.givens.iter().filter_map(given).collect()
}

/// Returns every thing in order of declaration.
fn in_order(body: &Body) -> Vec<ThingId> {
    let mut order = vec![ThingId(0); body.len()];
    for (thing, &rank) in body.rank.iter() {
        order[rank as usize] = thing;
    }
    order
}

/// Returns for every thing the next that it is merged with.
fn rings(body: &Body, order: &[ThingId]) -> IdVec<ThingId, ThingId> {
    let mut next: IdVec<ThingId, ThingId> = body.things.ids().collect();
    // From the last to the first, each is put right behind the one that is first of all.
    for &thing in order.iter().rev() {
        let first = body.merged[thing];
        if thing != first {
            next[thing] = next[first];
            next[first] = thing;
        }
    }
    next
}

/// Returns the first thing of each class in a ring.
fn first_of_each(structure: &Form, thing: ThingId) -> Vec<ThingId> {
    let mut found: Vec<ThingId> = Vec::new();
    for t in structure.merged_with(thing) {
        let class = structure.things[t].class;
        if found.iter().all(|&f| structure.things[f].class != class) {
            found.push(t);
        }
    }
    found
}

fn give_slots(
    maker: &mut Maker<'_>,
    body: &Body,
    order: &[ThingId],
    givens: &Givens,
    structure: &mut Form,
) {
    let document = maker.document;
    let has_range = |c: &Class| c.parts.iter().any(|p| p.range.is_some());
    let has_ranges = document.classes.iter().any(|(_, c)| has_range(c));
    let mut places: IdVec<ClassId, Option<usize>> = IdVec::filled(None, document.classes.len());
    let layout = of_layout(document, structure, body, order);
    let counting = Counting::new(document, body, givens);
    // of every slot, what gives it its value
    let mut givers: IdVec<SlotId, ThingId> = IdVec::new();
    for &thing in order {
        let t = &body.things[thing];
        let ClassKind::Primitive(primitive) = document.classes[t.class].kind else { continue };
        let first = body.merged[thing];
        let slot = structure.slot_of(first).unwrap_or_else(|| {
            let place = t.owner.filter(|&owner| {
                let class = body.things[owner].class;
                let count = || document.place_in(class).unwrap_or(0);
                (t.field as usize) < *places[class].get_or_insert_with(count)
            });
            let place = place.map(|owner| body.merged[owner]);
            givers.push(thing);
            structure.slots.push(Slot {
                thing: first,
                primitive,
                given: None,
                anchored: false,
                is_layout: true,
                place,
            })
        });
        if let Primitive::Choice(of) = primitive {
            let last = document.classes[of].options.len().saturating_sub(1);
            structure.ranges.insert(slot, (0, last as i64));
        }
        structure.slots[slot].is_layout &= layout[thing];
        structure.own_slots[first] = slot;
        structure.own_slots[thing] = slot;
        let given = body.givens[thing]
            .filter(|&given| !is_of_itself(body, &structure.layouts, givens, (thing, given)));
        if let Some(given) = given {
            let known = structure.slots[slot].given.map(|known| (givers[slot], known));
            if known.is_none_or(|known| !counting.is_first(structure, known, (thing, given))) {
                structure.slots[slot].given = Some(given);
                givers[slot] = thing;
            }
        }
        if !has_ranges {
            continue;
        }
        if let Some((range, origin)) = declared_range(document, structure, body, thing) {
            let known = structure.ranges.entry(slot).or_insert(range);
            let both = (known.0.max(range.0), known.1.min(range.1));
            if both.0 <= both.1 {
                *known = both;
                continue;
            }
            let ((a, b), (c, d)) = (*known, range);
            let message = format!("no whole number lies in both {a}..{b} and {c}..{d}");
            maker.fault(origin, FaultKind::UnlikeMerge, message);
        }
    }
}

/// Returns which things only say where something is drawn, or are parts of those.
fn of_layout(
    document: &Document,
    structure: &Form,
    body: &Body,
    order: &[ThingId],
) -> IdVec<ThingId, bool> {
    let mut found = IdVec::filled(false, body.len());
    if document.classes.iter().all(|(_, class)| class.parts.iter().all(|part| !part.is_layout)) {
        return found;
    }
    for &thing in order {
        let t = &body.things[thing];
        let Some(owner) = t.owner else { continue };
        let layout = structure.layouts[body.things[owner].class].as_ref();
        let field = layout.and_then(|layout| layout.fields.get(t.field as usize));
        let part = field.and_then(|field| document.declared(*field));
        found[thing] = found[owner] || part.is_some_and(|part| part.is_layout);
    }
    found
}

/// Returns the numbers that a thing may be, and where that is written.
fn declared_range(
    document: &Document,
    structure: &Form,
    body: &Body,
    thing: ThingId,
) -> Option<((i64, i64), OriginId)> {
    let t = &body.things[thing];
    let owner = body.things[t.owner?].class;
    if matches!(document.classes[owner].kind, ClassKind::List(_)) {
        return declared_range(document, structure, body, t.owner?);
    }
    let layout = structure.layouts[owner].as_ref()?;
    let part = document.declared(*layout.fields.get(t.field as usize)?)?;
    Some((part.range?, part.origin))
}
