//! Rules: what the classes of a thing say of its parts, once these are made.

use super::body::{Body, Member, Waiting};
use super::merge::merge_pair;
use super::{FaultKind, Maker};
use crate::class::{ClassId, ClassKind, Merge};
use crate::path::Path;
use crate::structure::{ConstraintInstance, StayInstance, ThingId};
use crate::term::OriginId;
use base::{IdVec, Name};
use std::rc::Rc;

/// Applies what a thing's classes say: its merges, then constraints, stays and set members.
///
/// What its parts could not apply, from `waiting` on, is tried again.
pub(super) fn apply(maker: &mut Maker<'_>, body: &mut Body, thing: ThingId, waiting: usize) {
    let document = maker.document;
    let line = document.primary_line(body.things[thing].class);
    for (above, &class) in line.iter().enumerate().rev() {
        let masked = |name: &Option<Name>| document.is_masked(&line[..above], name.as_ref());
        let c = &document.classes[class];
        let mut wait = |member| body.waiting.push(Waiting { thing, class, member });
        for (index, merge) in (0..).zip(&c.merges) {
            if !masked(&merge.name) {
                wait(Member::Merge(index));
            }
        }
        (0..c.stays.len() as u32).for_each(|i| wait(Member::Stay(i)));
        (0..c.inserts.len() as u32).for_each(|i| wait(Member::Insert(i)));
        for (index, constraint) in (0..).zip(&c.constraints) {
            if !masked(&constraint.name) {
                let constraint = ConstraintInstance { owner: thing, class, index };
                Rc::make_mut(&mut body.constraints).push(constraint);
            }
        }
    }
    merge_waiting(maker, body, waiting);
    follow_waiting(maker, body, waiting);
}

/// Makes the merges whose paths can be followed, until no merge opens up another.
fn merge_waiting(maker: &mut Maker<'_>, body: &mut Body, from: usize) {
    let mut more = true;
    while std::mem::take(&mut more) {
        let waiting = body.waiting.split_off(from);
        for w in waiting {
            let Some(merge) = merge_of(maker, w) else {
                body.waiting.push(w);
                continue;
            };
            let paths = body.paths(&maker.layouts);
            let all: Result<Vec<_>, _> =
                merge.paths.iter().map(|p| paths.follow(w.thing, p)).collect();
            let Ok(things) = all else {
                body.waiting.push(w);
                continue;
            };
            more = true;
            for pair in things.windows(2) {
                merge_pair(maker, body, pair[0], pair[1], merge.origin);
            }
        }
    }
}

fn merge_of<'d>(maker: &Maker<'d>, waiting: Waiting) -> Option<&'d Merge> {
    let document = maker.document;
    match waiting.member {
        Member::Merge(index) => Some(&document.classes[waiting.class].merges[index as usize]),
        Member::Stay(_) | Member::Insert(_) => None,
    }
}

/// Finds the things of stays and set members, where their paths can be followed.
fn follow_waiting(maker: &Maker<'_>, body: &mut Body, from: usize) {
    for w in body.waiting.split_off(from) {
        let class = &maker.document.classes[w.class];
        let paths = body.paths(&maker.layouts);
        match w.member {
            Member::Merge(_) => {}
            Member::Stay(index) => {
                let stay = &class.stays[index as usize];
                if let Ok(at) = paths.follow(w.thing, &stay.path) {
                    body.stays.push(StayInstance { thing: at, strength: stay.strength });
                    continue;
                }
            }
            Member::Insert(index) => {
                let insert = &class.inserts[index as usize];
                let set = paths.follow(w.thing, &insert.set);
                if let (Ok(part), Ok(set)) = (paths.follow(w.thing, &insert.part), set) {
                    body.members.push((set, part));
                    continue;
                }
            }
        }
        body.waiting.push(w);
    }
}

/// Reports every path that could not be followed in the whole document.
pub(super) fn give_up(maker: &mut Maker<'_>, body: &mut Body) {
    for w in std::mem::take(&mut body.waiting) {
        let class = &maker.document.classes[w.class];
        match w.member {
            Member::Merge(index) => {
                let merge = &class.merges[index as usize];
                astray(maker, body, w.thing, &merge.paths, merge.origin);
            }
            Member::Stay(index) => {
                let stay = &class.stays[index as usize];
                astray(maker, body, w.thing, std::slice::from_ref(&stay.path), stay.origin);
            }
            Member::Insert(index) => {
                let insert = &class.inserts[index as usize];
                let paths = [insert.part.clone(), insert.set.clone()];
                astray(maker, body, w.thing, &paths, insert.origin);
            }
        }
    }
}

fn astray(maker: &mut Maker<'_>, body: &Body, thing: ThingId, paths: &[Path], origin: OriginId) {
    for path in paths {
        if let Err(astray) = body.paths(&maker.layouts).follow(thing, path) {
            let class = body.things[astray.at].class;
            let step = Path(vec![path.0[astray.step].clone()]);
            let name = &maker.document.classes[class].name;
            let (kind, message) = match maker.document.classes[class].kind {
                ClassKind::Reference(_) => (
                    FaultKind::UnknownPart,
                    format!("{path} goes through a reference; say where that part is itself"),
                ),
                ClassKind::List(_) if body.things[astray.at].parts == 0 => (
                    FaultKind::NoElement,
                    format!("the list has no elements: there is no {step}, in {path}"),
                ),
                _ => (FaultKind::UnknownPart, format!("{name} has no part {step}, in {path}")),
            };
            maker.fault(origin, kind, message);
        }
    }
}

/// Ends what the classes of a body's own thing say: what is merged names the first of all.
pub(super) fn settle(body: &mut Body) {
    body.settle_merges();
    keep_each_once(body);
}

/// Keeps of the constraints that merged things have in common the first.
fn keep_each_once(body: &mut Body) {
    let mut is_shared = IdVec::filled(false, body.len());
    let mut any = false;
    for (thing, &first) in body.merged.iter().filter(|(thing, first)| thing != *first) {
        (is_shared[thing], is_shared[first], any) = (true, true, true);
    }
    if !any {
        return;
    }
    let shared = (0..).zip(body.constraints.iter()).filter(|(_, c)| is_shared[c.owner]);
    let mut shared: Vec<(ThingId, ClassId, u32, u32)> =
        shared.map(|(at, c)| (body.merged[c.owner], c.class, c.index, at)).collect();
    shared.sort_unstable();
    let mut is_again = vec![false; body.constraints.len()];
    for pair in shared.windows(2) {
        let [(a, class, index, _), (b, other, number, at)] = [pair[0], pair[1]];
        is_again[at as usize] = (a, class, index) == (b, other, number);
    }
    if is_again.contains(&true) {
        let kept = body.constraints.iter().zip(is_again).filter(|(_, is_again)| !is_again);
        body.constraints = Rc::new(kept.map(|(c, _)| *c).collect());
    }
}
