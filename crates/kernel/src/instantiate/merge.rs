//! Merging: two things become one, with all that they have from their nearest common ancestor.

use super::body::Body;
use super::{FaultKind, Maker};
use crate::class::{ClassId, ClassKind};
use crate::document::Document;
use crate::structure::ThingId;
use crate::term::OriginId;

/// Makes two things one, recursively. What cannot be one is reported, and stays apart.
pub(super) fn merge_pair(
    maker: &mut Maker<'_>,
    body: &mut Body,
    a: ThingId,
    b: ThingId,
    origin: OriginId,
) {
    let mut pairs = vec![(a, b)];
    while let Some((a, b)) = pairs.pop() {
        let (first, last) = (body.identity(a), body.identity(b));
        if first == last {
            continue;
        }
        let classes = [a, b].map(|t| body.things[t].class);
        if classes[0] == classes[1] && !body.mixed.contains(&classes[0]) {
            // all that is merged with either is of this class
            match parts_in_common(maker, body, a, b) {
                Ok(n) => pairs.extend((0..n).map(|i| (body.part(a, i), body.part(b, i)))),
                Err((kind, message)) => return maker.fault(origin, kind, message),
            }
            body.make_one(first, last);
            continue;
        }
        for one in alike(body, a) {
            for other in alike(body, b) {
                match common_parts(maker, body, one, other, (one, other) == (a, b)) {
                    Ok(common) => pairs.extend(common),
                    Err((kind, message)) => return maker.fault(origin, kind, message),
                }
            }
        }
        unite(body, a, b);
    }
}

/// Returns how many parts two things of one class have in common: all, of lists of one length.
fn parts_in_common(
    maker: &Maker<'_>,
    body: &Body,
    a: ThingId,
    b: ThingId,
) -> Result<usize, (FaultKind, String)> {
    let [na, nb] = [a, b].map(|t| body.things[t].parts);
    match maker.document.classes[body.things[a].class].kind {
        ClassKind::Composite => Ok(na.min(nb) as usize),
        ClassKind::List(_) if na == nb => Ok(na as usize),
        ClassKind::List(_) => {
            let message = format!("a list of {na} and a list of {nb} cannot be one list");
            Err((FaultKind::UnlikeMerge, message))
        }
        ClassKind::Primitive(_) | ClassKind::Set(_) | ClassKind::Reference(_) => Ok(0),
    }
}

/// Returns one thing of each class among those merged with `thing`, `thing` itself first.
fn alike(body: &mut Body, thing: ThingId) -> Vec<ThingId> {
    let mut alike = vec![thing];
    if !body.unlike.is_empty() {
        let first = body.identity(thing);
        let class = body.things[thing].class;
        let others = body.unlike.get(&first).into_iter().flatten();
        alike.extend(others.filter(|&&t| body.things[t].class != class));
    }
    alike
}

/// Returns the parts that two things have from their nearest common ancestor, pair by pair.
///
/// `named` pairs must have some: an ancestor without parts is a vacuous merge.
fn common_parts(
    maker: &mut Maker<'_>,
    body: &Body,
    a: ThingId,
    b: ThingId,
    named: bool,
) -> Result<Vec<(ThingId, ThingId)>, (FaultKind, String)> {
    let document = maker.document;
    let (ca, cb) = (body.things[a].class, body.things[b].class);
    let pairs = |a: ThingId, b: ThingId, n: usize| {
        let n = n.min(body.things[a].parts as usize).min(body.things[b].parts as usize);
        (0..n).map(|i| (body.part(a, i), body.part(b, i))).collect::<Vec<_>>()
    };
    let name = |c: ClassId| &document.classes[c].name;
    let (ka, kb) = (&document.classes[ca].kind, &document.classes[cb].kind);
    match (ka, kb) {
        (ClassKind::Composite, ClassKind::Composite) if ca != cb => {}
        _ if ka == kb => return parts_in_common(maker, body, a, b).map(|n| pairs(a, b, n)),
        (ClassKind::Reference(_), _) | (_, ClassKind::Reference(_)) => {
            let (names, other) =
                if matches!(ka, ClassKind::Reference(_)) { (ca, cb) } else { (cb, ca) };
            let message = format!(
                "a {} only names a thing and cannot be one with {} itself: merge what it names",
                name(names),
                name(other)
            );
            return Err((FaultKind::UnlikeMerge, message));
        }
        _ => {
            let message = format!("{} and {} cannot be one part", name(ca), name(cb));
            return Err((FaultKind::UnlikeMerge, message));
        }
    }
    let common = kinship(maker, ca, cb);
    let seen = |t, kin: Kinship, side: usize| match kin.is_in_line[side] {
        true => Some(t),
        false => seen_as(maker, body, t, kin.ancestor),
    };
    let views = common.and_then(|kin| Some((seen(a, kin, 0)?, seen(b, kin, 1)?, kin)));
    let pairs = views.map_or_else(Vec::new, |(a, b, kin)| pairs(a, b, kin.parts));
    let general = |c| {
        let line = document.primary_line(c).into_iter();
        line.map(|c| document.classes[c].general.unwrap_or(c)).find(|&c| has_counts(document, c))
    };
    if named && pairs.is_empty() && general(ca).is_some() && general(ca) == general(cb) {
        let with = |c| {
            let line = document.primary_line(c).into_iter();
            let mut counts = line.flat_map(|c| &document.classes[c].counts);
            counts.next().map_or(String::new(), |(count, n)| format!(" with {count} = {n}"))
        };
        let message = format!(
            "this {}{} and this {}{} have different numbers of parts and cannot be one",
            name(ca),
            with(ca),
            name(cb),
            with(cb)
        );
        return Err((FaultKind::UnlikeMerge, message));
    }
    if named && pairs.is_empty() {
        let message = format!(
            "{} and {} have no parts in common: merging them would say nothing",
            name(ca),
            name(cb)
        );
        return Err((FaultKind::VacuousMerge, message));
    }
    Ok(pairs)
}

/// What two classes have in common.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kinship {
    /// Their nearest common ancestor.
    ancestor: ClassId,
    /// How many parts it has.
    parts: usize,
    /// For each of the two, whether its things have them first of all.
    is_in_line: [bool; 2],
}

/// Finds what two classes have in common, once.
fn kinship(maker: &mut Maker<'_>, a: ClassId, b: ClassId) -> Option<Kinship> {
    let document = maker.document;
    let find = || {
        let others = document.lineage(b);
        let ancestor = document.lineage(a).into_iter().find(|c| others.contains(c))?;
        let is_in_line = [a, b].map(|c| document.primary_line(c).contains(&ancestor));
        Some(Kinship { ancestor, parts: document.layout(ancestor).len(), is_in_line })
    };
    *maker.kinships.entry((a, b)).or_insert_with(find)
}

/// Returns true if some whole number of a class says how many parts its things have.
fn has_counts(document: &Document, class: ClassId) -> bool {
    !document.classes[class].counts.is_empty()
}

/// Finds the thing or superclass part that is `thing` seen as a `class`.
fn seen_as(maker: &Maker<'_>, body: &Body, thing: ThingId, class: ClassId) -> Option<ThingId> {
    let own = body.things[thing].class;
    if maker.document.primary_line(own).contains(&class) {
        return Some(thing);
    }
    let layout = maker.layouts[own].as_ref()?;
    let parts = body.things[thing].parts;
    let superclasses = layout.superclasses.iter().filter(|&&i| i < parts);
    superclasses.map(|&i| body.part(thing, i as usize)).find_map(|t| seen_as(maker, body, t, class))
}

/// Makes two things one: the one that was declared first.
fn unite(body: &mut Body, a: ThingId, b: ThingId) {
    let (a, b) = (body.identity(a), body.identity(b));
    let (first, last) = body.make_one(a, b);
    let known = body.unlike.remove(&first);
    let others = body.unlike.remove(&last);
    if known.is_none() && others.is_none() && body.things[a].class == body.things[b].class {
        return;
    }
    let mut classes = known.unwrap_or_else(|| vec![first]);
    for thing in others.unwrap_or_else(|| vec![last]) {
        let class = body.things[thing].class;
        if classes.iter().all(|&t| body.things[t].class != class) {
            classes.push(thing);
        }
    }
    if classes.len() > 1 {
        body.mixed.extend(classes.iter().map(|&t| body.things[t].class));
        body.unlike.insert(first, classes);
    }
}
