//! Filling: a thing without parts in, its parts and all below them out.

use super::body::{Body, ROOT};
use super::givens::{Binding, ShareOf, own_bindings, put, shares};
use super::{Fault, FaultKind, MOST_COPIES, MOST_THINGS, Maker, rules};
use crate::class::{ClassId, ClassKind, Count};
use crate::document::{Document, PartRef, PartRole};
use crate::structure::ThingId;
use crate::term::{OriginId, Term};
use std::rc::Rc;

/// How deep parts may lie in parts, elements of lists included: what the stack holds, here and wherever parts
/// are gone through.
const DEEPEST: usize = 200;

/// Makes what is below a thing; returns how many levels of parts that is. `bindings` are given values from its
/// owners, the outermost last.
fn fill<'d>(
    maker: &mut Maker<'d>,
    body: &mut Body,
    thing: ThingId,
    bindings: &[Binding<'d>],
    origin: OriginId,
) -> usize {
    let document = maker.document;
    let class = body.things[thing].class;
    if document.classes[class].is_abstract {
        let name = &document.classes[class].name;
        let message = format!("{name} is abstract: it has no things of its own");
        let kind = FaultKind::AbstractPart;
        maker.faults.push(Fault { origin, kind, message, class: Some(class) });
    }
    let below = match document.classes[class].kind {
        ClassKind::Primitive(_) | ClassKind::Reference(_) | ClassKind::Set(_) => 0,
        ClassKind::List(element) => {
            return fill_list(maker, body, thing, element, bindings, origin);
        }
        ClassKind::Composite => {
            let Some(known) = body_of(maker, class, origin) else { return 0 };
            if known.counts_givens && !bindings.is_empty() {
                return fill_fields(maker, body, thing, bindings).unwrap_or(0);
            }
            if is_too_deep(maker, known.below, origin)
                || !has_room(maker, body, known.len(), origin)
            {
                return 0;
            }
            body.copy(thing, &known);
            known.below
        }
    };
    bindings.iter().for_each(|&b| put(maker, body, thing, b));
    below
}

/// Tests whether so many levels of parts may not lie below what is being filled; reports it where they may not.
fn is_too_deep(maker: &mut Maker<'_>, below: usize, origin: OriginId) -> bool {
    let is_too_deep = maker.depth + below > DEEPEST;
    if is_too_deep {
        let message = format!("parts of parts more than {DEEPEST} deep");
        maker.fault(origin, FaultKind::TooDeep, message);
    }
    is_too_deep
}

/// Returns the body of a class: what its things have below them where nothing else is given.
pub(super) fn body_of(maker: &mut Maker<'_>, class: ClassId, origin: OriginId) -> Option<Rc<Body>> {
    if let Some(body) = &maker.bodies[class] {
        return Some(body.clone());
    }
    if maker.on_the_way.contains(&class) {
        let name = &maker.document.classes[class].name;
        let message = format!("{name} would have another {name} as a part, without end");
        maker.fault(origin, FaultKind::EndlessParts, message);
        return None;
    }
    if is_too_deep(maker, 1, origin) {
        return None;
    }
    let body = Rc::new(make_body(maker, class));
    maker.bodies[class] = Some(body.clone());
    Some(body)
}

/// Makes what things of a class have below them.
fn make_body(maker: &mut Maker<'_>, class: ClassId) -> Body {
    let mut body = Body::new(class);
    body.below = fill_fields(maker, &mut body, ROOT, &[]).unwrap_or(0);
    rules::settle(&mut body);
    body
}

/// Tests whether a body may have so many things more; reports it once where it may not.
pub(super) fn has_room(maker: &mut Maker<'_>, body: &Body, more: usize, origin: OriginId) -> bool {
    maker.copied = maker.copied.saturating_add(more);
    let is_within = body.len().saturating_add(more) <= MOST_THINGS;
    let fits = is_within && maker.copied <= MOST_COPIES;
    if !fits && !std::mem::replace(&mut maker.is_full, true) {
        let message = match is_within {
            true => format!("more than {MOST_COPIES} things are made on the way to the document"),
            false => format!("more than {MOST_THINGS} things, which is what a document may have"),
        };
        maker.fault(origin, FaultKind::TooManyThings, message);
    }
    fits
}

/// How many things take as much room as the term by which an element of a list is computed.
const TERM: usize = 5;

fn fill_list<'d>(
    maker: &mut Maker<'d>,
    body: &mut Body,
    thing: ThingId,
    element: ClassId,
    bindings: &[Binding<'d>],
    origin: OriginId,
) -> usize {
    // what comes to a list only when it is evaluated gives elements values, and makes none
    let whole = bindings.iter().rev().filter(|b| b.path.is_empty());
    let mut written = whole.filter_map(|b| match &*maker.givens[b.given.value].term {
        Term::List(items) => Some(items.len()),
        _ => None,
    });
    let given = written.next().unwrap_or(0);
    let is_computed = given == 0 && bindings.iter().any(|b| b.path.is_empty());
    // a narrower list knows better than where it was declared
    let own = maker.document.classes[body.things[thing].class].count.map(Count::Fixed);
    let count = match own.or_else(|| declared(maker, body, thing)?.1) {
        Some(Count::Fixed(n)) => n as usize,
        Some(Count::Given) | None => {
            body.counts_givens = true;
            given
        }
    };
    if is_computed {
        maker.copied = maker.copied.saturating_add(count.saturating_mul(TERM));
    }
    if is_too_deep(maker, 1, origin) || !has_room(maker, body, count, origin) {
        return 0;
    }
    let elements = &maker.document.classes[body.things[thing].class].elements;
    let class = |i| elements.get(i).copied().unwrap_or(element);
    body.add_parts(thing, (0..count).map(class));
    fill_parts(maker, body, thing, bindings, |_| origin)
}

/// Returns the field that a thing is, and how many elements its declaration says.
fn declared(maker: &Maker<'_>, body: &Body, thing: ThingId) -> Option<(PartRef, Option<Count>)> {
    let t = &body.things[thing];
    let layout = maker.layouts[body.things[t.owner?].class].as_ref()?;
    let field = *layout.fields.get(t.field as usize)?;
    Some((field, maker.document.declared(field)?.count))
}

fn fill_fields<'d>(
    maker: &mut Maker<'d>,
    body: &mut Body,
    thing: ThingId,
    bindings: &[Binding<'d>],
) -> Option<usize> {
    let waiting = body.waiting.len();
    let below = grow(maker, body, thing, bindings)?;
    rules::apply(maker, body, thing, waiting);
    Some(below)
}

/// Makes the parts of a thing, of which its classes have still to speak; returns how many levels of parts it then
/// has, none where there is no room for them.
pub(super) fn grow<'d>(
    maker: &mut Maker<'d>,
    body: &mut Body,
    thing: ThingId,
    bindings: &[Binding<'d>],
) -> Option<usize> {
    let document = maker.document;
    let class = body.things[thing].class;
    let layout = maker.layout(class);
    let origin = document.classes[class].origin;
    if is_too_deep(maker, 1, origin) || !has_room(maker, body, layout.fields.len(), origin) {
        return None;
    }
    body.add_parts(thing, layout.classes.iter().copied());
    let mut all = own_bindings(maker, thing, class);
    all.extend(bindings);
    maker.on_the_way.push(class);
    let below = fill_parts(maker, body, thing, &all, |i| field_origin(document, layout.fields[i]));
    maker.on_the_way.pop();
    Some(below)
}

/// Fills the parts of a thing in order, each with its share of the given values; returns how many levels of parts
/// the thing then has.
fn fill_parts<'d>(
    maker: &mut Maker<'d>,
    body: &mut Body,
    thing: ThingId,
    bindings: &[Binding<'d>],
    origin: impl Fn(usize) -> OriginId,
) -> usize {
    maker.depth += 1;
    let shared = shares(maker, body, thing, bindings);
    let mut rest = shared.as_slice();
    let mut of_part = Vec::new();
    let mut rank = body.rank[thing] + 1;
    let mut below = 0;
    for i in 0..body.things[thing].parts as usize {
        let here = rest.iter().take_while(|s| s.part == i as u32).count();
        of_part.clear();
        of_part.extend(rest[..here].iter().map(|s: &ShareOf<'d>| s.binding));
        rest = &rest[here..];
        let part = body.part(thing, i);
        Rc::make_mut(&mut body.rank)[part] = rank;
        let before = body.len();
        below = below.max(1 + fill(maker, body, part, &of_part, origin(i)));
        rank += 1 + (body.len() - before) as u32;
    }
    maker.depth -= 1;
    below
}

fn field_origin(document: &Document, field: PartRef) -> OriginId {
    match field.role {
        PartRole::Part => document.classes[field.class].parts[field.index].origin,
        PartRole::Superclass => document.classes[field.class].origin,
    }
}
