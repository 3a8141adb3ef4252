//! Slices: what a drag can change.
//!
//! In: a plan and the known slots that move. Out: the steps downstream of them, put together where
//! they can run together, and what has to be tested after them. Made once for a plan and its inputs.

use crate::lists::Lists;
use crate::lower::{Program, is_within_reach};
use crate::peel::Peeled;
use crate::plan::{Plan, Step};
use crate::strip::{Links, Portion, Writers, portions};
use crate::system::{Level, SlotIndex, Stay};
use crate::test::Tests;
use crate::union::Union;

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
        match plan.peeled() {
            Some(peeled) => Self::of_peeled(plan, peeled, inputs),
            None => Self::of_steps(plan, inputs),
        }
    }

    /// Finds it where each step is a row that is solved by formula.
    fn of_peeled(plan: &Plan, peeled: &Peeled, inputs: &[SlotIndex]) -> Self {
        let mut is_reached = vec![false; plan.slots().len()];
        for &slot in inputs {
            is_reached[slot as usize] = true;
        }
        let regions = Approachable::of(plan, peeled);
        let mut is_region_reached = vec![false; regions.lists.len()];
        let mut is_settled = vec![false; peeled.rows.len()];
        let is_free = plan.slots().iter().any(|s| s.stay == Stay::Free);
        let mut made = Self { inputs: inputs.to_vec(), is_held: !is_free, ..Self::default() };
        let mut steps: Vec<u32> = Vec::with_capacity(peeled.order.len());
        for (index, &solved) in (0..).zip(&peeled.order) {
            let target = solved.target;
            let mentions = peeled.rows.mentions(solved.row as usize);
            if !mentions.iter().any(|&s| s != target && is_reached[s as usize]) {
                continue;
            }
            steps.push(index);
            is_reached[target as usize] = true;
            is_settled[solved.row as usize] = peeled.is_stated(solved);
            if let Some(region) = regions.of_slot(target)
                && !std::mem::replace(&mut is_region_reached[region as usize], true)
            {
                regions.lists.of(region).iter().for_each(|&u| is_reached[u as usize] = true);
            }
        }
        made.targets = steps.iter().map(|&s| peeled.order[s as usize].target).collect();
        made.portions = portions(Links::Peeled(plan, peeled), &steps);
        let mut tests = Vec::new();
        let rows = &peeled.rows;
        let mut next = 0;
        while next < rows.len() {
            let (first, relation) = (next, rows[next].relation);
            while next < rows.len() && rows[next].relation == relation {
                next += 1;
            }
            let is_asked = |r: usize| rows.mentions(r).iter().any(|&s| is_reached[s as usize]);
            if (first..next).any(is_asked) {
                made.relations.push(relation);
                if !is_settled[first..next].iter().all(|&settled| settled) {
                    tests.push(relation);
                }
            }
        }
        made.tests = Tests::new(plan, &tests.iter().copied());
        made
    }

    /// Finds it among steps of any kind.
    fn of_steps(plan: &Plan, inputs: &[SlotIndex]) -> Self {
        let mut is_reached = vec![false; plan.slots().len()];
        for &slot in inputs {
            is_reached[slot as usize] = true;
        }
        let mut is_region_reached = vec![false; plan.regions().len()];
        let writers = Writers::of(plan);
        let mut is_settled = vec![false; plan.system().equations.len()];
        let is_free = plan.slots().iter().any(|s| s.stay == Stay::Free);
        let mut made = Self { inputs: inputs.to_vec(), is_held: !is_free, ..Self::default() };
        let mut steps: Vec<u32> = Vec::new();
        for (index, step) in (0..).zip(plan.steps()) {
            if matches!(step.program, Program::Host { .. }) {
                let texts = step.targets.iter().filter(|&&t| !plan.slots()[t as usize].is_number);
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
            if let Some(region) = plan.regions().get(step.region as usize)
                && region.can_approach
                && region.is_within_reach()
                && !std::mem::replace(&mut is_region_reached[step.region as usize], true)
            {
                for &u in &region.problem.unknowns {
                    is_reached[u as usize] = true;
                }
            }
        }
        made.portions = portions(Links::Steps(plan, &writers), &steps);
        let mut tests = Vec::new();
        for r in 0..plan.relation_count() {
            if !plan.mentions(r).any(|s| is_reached[s as usize]) {
                continue;
            }
            let rows = plan.rows_of(r);
            let rows = rows.start as usize..rows.end as usize;
            made.relations.push(r);
            if plan.opaque.binary_search(&r).is_ok() {
                made.opaque.push(r);
            } else if !is_settled[rows].iter().all(|&settled| settled) {
                tests.push(r);
            }
        }
        made.tests = Tests::new(plan, &tests.iter().copied());
        made
    }
}

/// The regions of a plan that may be approached and are not too large for it.
struct Approachable {
    /// For every slot, its region; none where that is not such a one.
    region_of: Vec<u32>,
    /// The unknowns of every region.
    lists: Lists,
}

impl Approachable {
    const NONE: u32 = u32::MAX;

    /// Finds them; every step has one target.
    fn of(plan: &Plan, peeled: &Peeled) -> Self {
        let rows = &peeled.rows;
        let steps = || peeled.order.iter().map(|&solved| (solved, solved.target));
        let is_soft = |row: u32| rows[row as usize].level != Level::Required;
        let soft: Vec<SlotIndex> =
            steps().filter(|(solved, _)| is_soft(solved.row)).map(|(_, target)| target).collect();
        if soft.is_empty() || Self::are_none(plan, peeled) {
            return Self { region_of: Vec::new(), lists: Lists::default() };
        }
        let mut is_unknown = vec![false; plan.slots().len()];
        let mut union = Union::new(plan.slots().len());
        for (solved, target) in steps() {
            is_unknown[target as usize] = true;
            for &s in rows.mentions(solved.row as usize).iter().filter(|s| is_unknown[**s as usize])
            {
                union.unite(target as usize, s as usize);
            }
        }
        // how many unknowns a region has, and which have a curved row
        let mut sizes = vec![0_u32; plan.slots().len()];
        let mut is_curved = vec![false; plan.slots().len()];
        for (solved, target) in steps() {
            let root = union.find(target as usize);
            sizes[root] += 1;
            is_curved[root] |= peeled.is_curved(solved);
        }
        let mut number = vec![Self::NONE; plan.slots().len()];
        let mut count = 0;
        for target in soft {
            let root = union.find(target as usize);
            let is_near = is_within_reach(sizes[root] as usize, !is_curved[root]);
            if is_near && number[root] == Self::NONE {
                number[root] = count;
                count += 1;
            }
        }
        if count == 0 {
            return Self { region_of: Vec::new(), lists: Lists::default() };
        }
        let of = |s: usize| match is_unknown[s] {
            true => number[union.find(s)],
            false => Self::NONE,
        };
        let region_of: Vec<u32> = (0..plan.slots().len()).map(of).collect();
        let pairs = region_of.iter().copied().zip(0..).filter(|p| p.0 != Self::NONE);
        let lists = Lists::new(count as usize, pairs);
        Self { region_of, lists }
    }
    /// Returns true if what comes of soft rows alone is too much for each of their regions.
    fn are_none(plan: &Plan, peeled: &Peeled) -> bool {
        if is_within_reach(peeled.order.len(), false) {
            return false;
        }
        // for every slot, the first of the soft rows that it comes of, and of each how many do and whether by bends
        let mut comes_of = vec![Self::NONE; plan.slots().len()];
        let mut sizes: Vec<(usize, bool)> = Vec::new();
        for &solved in &peeled.order {
            let mentions = peeled.rows.mentions(solved.row as usize);
            let known = mentions.iter().map(|&s| comes_of[s as usize]).find(|&n| n != Self::NONE);
            let is_soft = peeled.rows[solved.row as usize].level != Level::Required;
            let number = match known {
                Some(number) => number,
                None if is_soft => {
                    sizes.push((0, false));
                    sizes.len() as u32 - 1
                }
                None => continue,
            };
            comes_of[solved.target as usize] = number;
            let (size, is_curved) = &mut sizes[number as usize];
            (*size, *is_curved) = (*size + 1, *is_curved | peeled.is_curved(solved));
        }
        sizes.iter().all(|&(size, is_curved)| !is_within_reach(size, !is_curved))
    }
    fn of_slot(&self, slot: SlotIndex) -> Option<u32> {
        self.region_of.get(slot as usize).copied().filter(|&region| region != Self::NONE)
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
