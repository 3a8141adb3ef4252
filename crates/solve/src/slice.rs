//! Slices: what a drag can change.
//!
//! In: a plan and the known slots that move. Out: the steps downstream of them, put together where
//! they can run together, and what has to be tested after them. Made once for a plan and its inputs.

use crate::lower::Program;
use crate::plan::{Plan, Step};
use crate::strip::{Portion, Writers, portions};
use crate::system::{SlotIndex, Stay};
use crate::test::Tests;

/// What a drag can change.
#[derive(Debug, Default)]
pub(crate) struct Slice {
    /// The known slots that it moves.
    pub(crate) inputs: Vec<SlotIndex>,
    /// What runs at every wish, in order.
    pub(crate) portions: Vec<Portion>,
    /// The slots that those steps write.
    pub(crate) targets: Vec<SlotIndex>,
    /// The relations that speak of any of these slots, or of slots of a region that may be
    /// approached.
    pub(crate) relations: Vec<u32>,
    /// The equations of those of them that a run of the steps does not make hold by itself.
    pub(crate) tests: Tests,
    /// Those of them that the host tests.
    pub(crate) opaque: Vec<u32>,
    /// Steps upstream that have to run even where all their relations hold.
    pub(crate) restless: Vec<u32>,
    /// True if every slot has a stay, and no two given numbers are one.
    pub(crate) is_held: bool,
    /// True if the host runs a step of the plan.
    pub(crate) has_host: bool,
    /// Texts that the plan writes.
    pub(crate) texts: Vec<SlotIndex>,
}

impl Slice {
    /// Finds what is downstream of the inputs.
    pub(crate) fn new(plan: &Plan, inputs: &[SlotIndex]) -> Self {
        let mut is_reached = vec![false; plan.slots.len()];
        for &slot in inputs {
            is_reached[slot as usize] = true;
        }
        let mut is_region_reached = vec![false; plan.regions.len()];
        let writers = Writers::of(plan);
        let mut is_settled = vec![false; plan.system().equations.len()];
        let is_free = plan.slots.iter().any(|s| s.stay == Stay::Free);
        let mut made = Self {
            inputs: inputs.to_vec(),
            is_held: !is_free && plan.shared_given.is_empty(),
            ..Self::default()
        };
        let mut steps: Vec<u32> = Vec::new();
        for (index, step) in (0..).zip(&plan.steps) {
            if matches!(step.program, Program::Host { .. }) {
                let texts = step.targets.iter().filter(|&&t| !plan.slots[t as usize].is_number);
                made.texts.extend(texts);
                made.has_host = true;
            }
            if !step.reads.iter().any(|&r| is_reached[r as usize]) {
                if !rests(step) {
                    made.restless.push(index);
                }
                continue;
            }
            steps.push(index);
            made.targets.extend(&step.targets);
            for &t in &step.targets {
                is_reached[t as usize] = true;
            }
            if let (Program::Inverse(inverse), [row]) = (&step.program, &step.rows[..]) {
                is_settled[*row as usize] = inverse.is_stated() && writers.are_before(plan, index);
            }
            if let Some(region) = plan.regions.get(step.region as usize)
                && region.can_approach
                && region.is_within_reach()
                && !std::mem::replace(&mut is_region_reached[step.region as usize], true)
            {
                for &u in &region.problem.unknowns {
                    is_reached[u as usize] = true;
                }
            }
        }
        made.portions = portions(plan, &steps, &writers);
        let mut tests = Vec::new();
        for r in 0..plan.relations.len() as u32 {
            if !plan.mentions(r).any(|s| is_reached[s as usize]) {
                continue;
            }
            let relation = &plan.relations[r as usize];
            let rows = relation.first_row as usize..(relation.first_row + relation.rows) as usize;
            made.relations.push(r);
            if relation.opaque.is_some() {
                made.opaque.push(r);
            } else if !is_settled[rows].iter().all(|&settled| settled) {
                tests.push(r);
            }
        }
        made.tests = Tests::new(plan, &tests.iter().copied());
        made
    }
}

/// Returns true if a step whose reads and relations are as they were has nothing to do.
fn rests(step: &Step) -> bool {
    match step.program {
        Program::Formulas(..) | Program::Inverse(_) | Program::Square(_) | Program::Least(_) => {
            true
        }
        Program::Constant(_) | Program::Copy | Program::Measure(_) | Program::Host { .. } => false,
    }
}
