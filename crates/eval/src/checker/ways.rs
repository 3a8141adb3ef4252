//! Which way: a written method runs only where none that is written before it could.
//!
//! Told only where that is certain: the earlier method writes what nothing else speaks of and nothing
//! holds.

use super::{Edit, name};
use crate::evaluator::Evaluator;
use kernel::{ConstraintInstance, Document, Method, SlotId, Structure};
use std::collections::BTreeSet;

pub(crate) fn complaints(
    document: &Document,
    structure: &Structure,
    edit: Edit<'_>,
) -> Vec<String> {
    let changed: BTreeSet<SlotId> = edit.before.changed(edit.after).collect();
    let evaluator = Evaluator::new(document, structure, edit.after);
    let has_ways = |c: &&ConstraintInstance| {
        let written = &document.classes[c.class].constraints[c.index as usize];
        written.methods.len() > 1 && structure.is_on(**c)
    };
    let stays = structure.stays.iter().flat_map(|s| structure.slots_under(s.thing));
    let held: BTreeSet<SlotId> = stays.chain(edit.edited.iter().copied()).collect();
    let mut wrong = Vec::new();
    for &constraint in structure.constraints.iter().filter(has_ways) {
        let written = &document.classes[constraint.class].constraints[constraint.index as usize];
        let targets = |m: &Method| {
            let things = m.targets.iter().map(|t| structure.follow(constraint.owner, t).ok());
            let things: Option<Vec<_>> = things.collect();
            let slots = things?.into_iter().flat_map(|t| structure.slots_under(t));
            Some(slots.collect::<BTreeSet<SlotId>>())
        };
        let all: Option<Vec<BTreeSet<SlotId>>> = written.methods.iter().map(targets).collect();
        let Some(all) = all else { continue };
        let runs = |t: &BTreeSet<SlotId>| {
            t.iter().any(|s| changed.contains(s) && !edit.edited.contains(s))
        };
        let Some(used) = all.iter().position(runs) else { continue };
        // several ways may have the same targets, or run in another constraint's stead
        let is_free = |slot: &SlotId| {
            let own = &structure.slots[*slot];
            own.given.is_none() && !held.contains(slot) && !changed.contains(slot)
        };
        let earlier = all[..used].iter().position(|t| !t.is_empty() && t.iter().all(is_free));
        let Some(earlier) = earlier else { continue };
        let others = structure.constraints.iter().filter(|c| **c != constraint);
        let speaks = |c: &ConstraintInstance| {
            let (_, reads) = evaluator.listening(|| evaluator.test(*c));
            !reads.is_disjoint(&all[earlier])
        };
        if !others.into_iter().any(speaks) {
            let name = name(&evaluator, constraint);
            let (earlier, used) = (earlier + 1, used + 1);
            wrong.push(format!("{name} took its method {used}, and method {earlier} was possible"));
        }
    }
    wrong
}
