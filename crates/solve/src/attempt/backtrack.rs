//! Backtracking: where a step has no solution, another root of a step that it comes from.
//!
//! In: an attempt. Out: values for which every step has a solution and every surplus row holds, or why
//! none were found. A step with several roots is a choice. Where something fails, it or a step that it
//! comes from has to be chosen otherwise: such choices are laid by, each with how much farther from
//! the start it lies, and the nearest of all is tried next. So the answer is near, what has no part in a
//! failure is left as it is, and the search ends after an amount of work that the plan fixes. Where it is
//! long, or finds nothing, everything is moved at once as well ([`super::rough`]): each of many steps hands on
//! how rough the start is, so that hardly one root is wrong, and no other one right.

use super::roots::{Reach, Root};
use super::{Approach, Attempt, Buffers, Failure, Motion, Run, begin};
use crate::outcome::{Host, Reason};
use crate::system::{Level, SlotIndex};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::rc::Rc;

/// How often, at most, equations are solved and roots looked for, for every unknown and for all of them.
const ROUNDS: usize = 5000;
const WORK: usize = 3_000_000;
/// After how much of either everything is moved at once, at the latest; where so many unknowns may have several
/// values at once.
const SOON: usize = 2;
const SOON_WORK: usize = 2000;
const LONG: usize = 100;
/// How many choices are laid by.
const CHOICES: usize = 400;
/// How many steps with several roots, the nearest before a failure, are asked for others.
const SUSPECTS: usize = 100;

/// The state up to a step that takes another root than it took before.
#[derive(Debug)]
struct Choice {
    step: usize,
    /// How much farther from the start than where the search began.
    cost: f64,
    values: Vec<f64>,
    motion: Vec<Motion>,
    taken: Taken,
}

/// The steps that were chosen otherwise, in order, and the bits that they took.
type Taken = Vec<(usize, Vec<u64>)>;

/// Where an attempt failed: at a step, or at a surplus row, by its slots.
#[derive(Clone, Debug)]
enum Fault {
    Step(usize),
    Row(Vec<SlotIndex>),
}

/// A search under way.
struct Search<'a> {
    attempt: Attempt<'a>,
    /// After how much work everything is moved at once.
    soon: usize,
    /// How often roots were looked for, those that were known too.
    looks: usize,
    /// The step that writes a slot.
    writer: Vec<Option<usize>>,
    /// The nearest comes last.
    choices: Vec<Choice>,
    seen: BTreeSet<Taken>,
    /// Roots that were found, by step and by the bits of what it reads.
    known: BTreeMap<(usize, Vec<u64>), Rc<Vec<Root>>>,
    /// What the present choice costs, and what it took.
    cost: f64,
    taken: Taken,
}

impl Attempt<'_> {
    /// Runs the steps, going back to other roots where something fails. `values` comes with the last
    /// state in it, and the known slots set.
    pub(crate) fn search(
        self,
        values: &mut [f64],
        buffers: &mut Buffers,
        host: &mut dyn Host,
    ) -> Result<(), Failure> {
        let plan = self.plan;
        buffers.notes.clear();
        buffers.approached.clear();
        let set_out = values.to_vec();
        begin(plan, self.frame, values, buffers);
        let mut writer = vec![None; plan.slots().len()];
        let mut branching = 0;
        for (i, step) in plan.steps().iter().enumerate() {
            step.targets.iter().for_each(|&t| writer[t as usize] = Some(i));
            branching += if step.may_branch() { step.targets.len() } else { 0 };
        }
        let soon = match branching {
            _ if plan.has_whole_unknowns() => usize::MAX,
            LONG.. => 0,
            _ => (SOON * branching).max(SOON_WORK),
        };
        let mut search = Search {
            attempt: self,
            soon,
            looks: 0,
            writer,
            choices: Vec::new(),
            seen: BTreeSet::new(),
            known: BTreeMap::new(),
            cost: 0.0,
            taken: Taken::new(),
        };
        buffers.square.work = 0;
        if search.soon == 0 {
            search.soon = usize::MAX;
            if self.run_from_near(values, buffers, host) {
                return Ok(());
            }
            values.copy_from_slice(&set_out);
            begin(plan, self.frame, values, buffers);
        }
        let mut from = 0;
        let mut first = None;
        let mut tried = 0;
        loop {
            let Err((fault, failure)) = search.run(from, values, buffers, host) else {
                return Ok(());
            };
            tried += 1;
            let (values_then, motion_then) = (values.to_vec(), buffers.motion.clone());
            search.lay_by(&fault, Reach::Near, values, buffers, host);
            if search.work(buffers) > search.soon {
                search.soon = usize::MAX;
                if self.run_from_near(values, buffers, host) {
                    return Ok(());
                }
                values.copy_from_slice(&values_then);
                buffers.motion.clone_from(&motion_then);
                search.lay_by(&fault, Reach::Near, values, buffers, host);
            }
            let (fault, failure, begun, motion) =
                first.get_or_insert((fault, failure, values_then, motion_then));
            if search.work(buffers) > (ROUNDS * branching.max(1)).min(WORK) {
                let reason = Reason::NotDecided { tried };
                return Err(Failure { reason, region: failure.region });
            }
            if buffers.work.is_spent() {
                return Err(Failure { reason: Reason::Spent, region: failure.region });
            }
            if search.choices.is_empty() && !matches!(fault, Fault::Row(_)) {
                // nothing near by is left: the first step that failed is sought from farther away
                values.copy_from_slice(begun);
                buffers.motion.copy_from_slice(motion);
                (search.cost, search.taken) = (0.0, Taken::new());
                search.lay_by(fault, Reach::Far, values, buffers, host);
            }
            let Some(next) = search.choices.pop() else {
                let is_left = search.soon < usize::MAX;
                let is_found = is_left && self.run_from_near(values, buffers, host);
                return if is_found { Ok(()) } else { Err(failure.clone()) };
            };
            values.copy_from_slice(&next.values);
            buffers.motion.copy_from_slice(&next.motion);
            (search.cost, search.taken) = (next.cost, next.taken);
            from = next.step + 1;
        }
    }

    /// Finds a required relation that does not hold, of those with surplus rows and those that are tested alone;
    /// returns its slots.
    pub(crate) fn broken(
        self,
        values: &[f64],
        buffers: &mut Buffers,
        host: &mut dyn Host,
    ) -> Option<Vec<SlotIndex>> {
        let plan = self.plan;
        let mut rejected = plan.report.rejected.iter().map(|r| r.relation);
        let broken = rejected.find(|&r| {
            plan.relation(r).level == Level::Required
                && !plan.places(r).all(|place| plan.holds(place, values, &mut buffers.work))
        });
        let is_untrue = |&r: &u32| {
            let relation = plan.relation(r);
            relation.level == Level::Required && !host.holds(relation.source, values)
        };
        let broken = broken.or_else(|| plan.opaque.iter().copied().find(is_untrue));
        Some(plan.mentions(broken?).collect())
    }
}

impl Search<'_> {
    /// Returns how often equations were solved, and roots looked for.
    fn work(&self, buffers: &Buffers) -> usize {
        buffers.square.work + self.looks
    }

    /// Runs the steps from one on, then tests the surplus rows.
    fn run(
        &self,
        from: usize,
        values: &mut [f64],
        buffers: &mut Buffers,
        host: &mut dyn Host,
    ) -> Result<(), (Fault, Failure)> {
        for index in from..self.attempt.plan.step_count() {
            let ran = self.attempt.step(index, values, &Approach::Nowhere, buffers, host);
            ran.map_err(|failure| (Fault::Step(index), failure))?;
        }
        match self.attempt.broken(values, buffers, host) {
            None => Ok(()),
            Some(slots) => {
                let failure = Failure { reason: Reason::Conflict, region: u32::MAX };
                Err((Fault::Row(slots), failure))
            }
        }
    }

    /// Lays by the other roots of what has a part in a fault, until everything is to be moved at once. The
    /// values are left as they are.
    fn lay_by(
        &mut self,
        fault: &Fault,
        reach: Reach,
        values: &mut [f64],
        buffers: &mut Buffers,
        host: &mut dyn Host,
    ) {
        let Attempt { plan, frame, last, trust, part: _ } = self.attempt;
        let (failed, suspects) = match (fault, reach) {
            (Fault::Step(index), Reach::Far) => (Some(*index), vec![*index]),
            (Fault::Step(index), Reach::Near) => (Some(*index), self.suspects([*index].into())),
            (Fault::Row(slots), Reach::Near | Reach::Far) => {
                let writers = slots.iter().filter_map(|&s| self.writer[s as usize]);
                (None, self.suspects(writers.collect()))
            }
        };
        for suspect in suspects {
            if self.work(buffers) > self.soon {
                break;
            }
            self.looks += 1;
            let step = &plan.steps()[suspect];
            let index = suspect;
            let mut run = Run { plan, frame, last, values, trust, buffers, host, index };
            let now = run.targets(step);
            let known = if reach == Reach::Near {
                let reads = step.reads.iter().map(|&r| run.values[r as usize].to_bits()).collect();
                let known = self.known.entry((suspect, reads));
                Rc::clone(known.or_insert_with(|| Rc::new(run.roots(step, reach))))
            } else {
                Rc::new(run.roots(step, reach))
            };
            let stands = failed != Some(suspect);
            let present = if stands { run.distance(step, &now) } else { 0.0 };
            for root in known.iter() {
                if stands && run.is_same(step, &root.values, &now) {
                    continue;
                }
                let mut taken: Taken =
                    self.taken.iter().filter(|t| t.0 < suspect).cloned().collect();
                taken.push((suspect, root.values.iter().map(|v| v.to_bits()).collect()));
                if self.seen.contains(&taken) {
                    continue;
                }
                self.seen.insert(taken.clone());
                run.set_targets(step, &root.values);
                let inputs = run.inputs(&step.reads);
                if run.settle(step, inputs).is_ok() {
                    let (values, motion) = (run.values.to_vec(), run.buffers.motion.clone());
                    let cost = self.cost + root.distance - present;
                    self.choices.push(Choice { step: suspect, cost, values, motion, taken });
                }
            }
            run.set_targets(step, &now);
        }
        self.choices.sort_by(|a, b| b.cost.total_cmp(&a.cost));
        if self.choices.len() > CHOICES {
            self.choices.drain(..self.choices.len() - CHOICES);
        }
    }

    /// These steps and those that they come from, as far as they may have several roots, nearest first.
    fn suspects(&self, mut next: VecDeque<usize>) -> Vec<usize> {
        let steps = self.attempt.plan.steps();
        let mut seen: BTreeSet<usize> = next.iter().copied().collect();
        let mut found = Vec::new();
        while let Some(step) = next.pop_front() {
            if steps[step].may_branch() {
                found.push(step);
            }
            if found.len() == SUSPECTS {
                break;
            }
            for writer in steps[step].reads.iter().filter_map(|&r| self.writer[r as usize]) {
                if seen.insert(writer) {
                    next.push_back(writer);
                }
            }
        }
        found
    }
}
