//! Tests: which equations do not hold at a state.
//!
//! In: equations, by their places in the system, and values. Out: those whose sides differ by more than
//! they may. Equations of one pattern are laid out together once and evaluated in lanes. Whether
//! rounding explains a difference is asked only of an equation whose sides differ, and only where
//! somebody wants to know.

use crate::block::Workspace;
use crate::lanes::WIDE;
use crate::pattern::{Pattern, Plain};
use crate::plan::Plan;
use crate::system::SlotIndex;
use base::number::Tolerance;
use expr::LANES;
use std::ops::ControlFlow;

/// An equation that does not hold.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Failing {
    /// The relation that it belongs to.
    pub(crate) relation: u32,
    /// By how much its sides differ.
    pub(crate) error: f64,
    /// By how much they may.
    pub(crate) tolerance: f64,
}

/// An equation whose sides differ by more than rounding of the sides explains.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Differing {
    pub(crate) place: Place,
    left: f64,
    right: f64,
}

/// An equation to be tested.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Place {
    /// The relation that it belongs to.
    pub(crate) relation: u32,
    /// Its place in the system.
    pub(crate) row: u32,
}

/// Equations to be tested, those of one pattern together.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tests {
    /// Those of one pattern, then those of the next.
    places: Vec<Place>,
    /// The place of every pattern among those that the system uses, and where its equations end.
    groups: Vec<(u32, u32)>,
}

/// Working space for tests.
#[derive(Clone, Debug, Default)]
pub(crate) struct TestScratch {
    differing: Vec<Differing>,
}

impl Tests {
    /// Lays out the equations of these relations.
    pub(crate) fn new(plan: &Plan, relations: &(impl Iterator<Item = u32> + Clone)) -> Self {
        let all = || relations.clone().flat_map(|r| plan.places(r));
        let mut groups: Vec<(u32, u32)> =
            (0..plan.pattern_count() as u32).map(|p| (p, 0)).collect();
        all().for_each(|place| groups[plan.pattern_place(place.row)].1 += 1);
        // where they begin, until they are put there
        let mut count = 0;
        for (_, end) in &mut groups {
            count += std::mem::replace(end, count);
        }
        let mut places = vec![Place { relation: 0, row: 0 }; count as usize];
        for place in all() {
            let (_, next) = &mut groups[plan.pattern_place(place.row)];
            places[*next as usize] = place;
            *next += 1;
        }
        // of a pattern that has none nothing is asked
        groups.dedup_by_key(|group| group.1);
        Self { places, groups }
    }
    /// Returns the equations of every pattern, by its place among those that the system uses.
    fn by_pattern(&self) -> impl Iterator<Item = (u32, &[Place])> {
        let mut start = 0;
        self.groups.iter().map(move |&(pattern, end)| {
            (pattern, &self.places[std::mem::replace(&mut start, end as usize)..end as usize])
        })
    }
}

impl Plan {
    /// Calls `differs` for the equations whose sides differ, until it breaks off.
    pub(crate) fn each_differing(
        &self,
        tests: &Tests,
        values: &[f64],
        work: &mut Workspace,
        differs: &mut impl FnMut(Differing, &mut Workspace) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        for (pattern, places) in tests.by_pattern() {
            let pattern = self.pattern_at(pattern as usize);
            let mut compare = |place: Place, [left, right]: [f64; 2], work: &mut Workspace| {
                let within = self.relation(place.relation).within;
                if within.is_met(left, right) {
                    return ControlFlow::Continue(());
                }
                differs(Differing { place, left, right }, work)
            };
            if pattern.plain() == Some(Plain::Same) {
                for &place in places {
                    let [a, b] = *self.arguments(place.row) else { unreachable!("it has two") };
                    compare(place, [a, b].map(|s| values[s as usize]), work)?;
                }
                continue;
            }
            for some in places.chunks(LANES) {
                if some.len() < WIDE {
                    for &place in some {
                        let sides = self.sides(place.row, pattern, values, work);
                        compare(place, sides, work)?;
                    }
                    continue;
                }
                let of = |lane: usize| self.arguments(some[lane].row);
                let outs = work.lanes.run(pattern.values(), some.len(), of, values, 2);
                let mut sides = [[0.0; 2]; LANES];
                for (lane, sides) in sides[..some.len()].iter_mut().enumerate() {
                    *sides = [0, 1].map(|side| outs.of(lane).get(side));
                }
                for (&place, sides) in some.iter().zip(sides) {
                    compare(place, sides, work)?;
                }
            }
        }
        ControlFlow::Continue(())
    }

    /// Calls `fails` for the equations that do not hold, one relation's together.
    pub(crate) fn each_failing(
        &self,
        tests: &Tests,
        values: &[f64],
        work: &mut Workspace,
        scratch: &mut TestScratch,
        fails: &mut impl FnMut(Failing),
    ) {
        let mut differing = std::mem::take(&mut scratch.differing);
        differing.clear();
        let add = &mut |d, _: &mut Workspace| {
            differing.push(d);
            ControlFlow::Continue(())
        };
        // never broken off
        let _ = self.each_differing(tests, values, work, add);
        differing.sort_unstable_by_key(|d| d.place.row);
        differing.iter().filter_map(|&d| self.failing(d, values, work)).for_each(fails);
        scratch.differing = differing;
    }

    /// Returns what an equation fails by whose sides differ; nothing where rounding explains it.
    fn failing(&self, differing: Differing, values: &[f64], w: &mut Workspace) -> Option<Failing> {
        let Differing { place: Place { relation, row }, left, right } = differing;
        let error = (left - right).abs();
        let error = if error.is_nan() { f64::INFINITY } else { error };
        let within = self.relation(relation).within;
        let sway = match within {
            Tolerance::Relative => self.sway(row, values, w),
            Tolerance::Within(_) | Tolerance::Part(_) => 0.0,
        };
        let tolerance = within.allowed_with(left, right, sway);
        (error > tolerance).then_some(Failing { relation, error, tolerance })
    }

    /// Returns true if rounding explains by how much the sides of an equation differ.
    pub(crate) fn is_rounding(
        &self,
        differing: Differing,
        values: &[f64],
        work: &mut Workspace,
    ) -> bool {
        let Differing { place: Place { relation, row }, left, right } = differing;
        let within = self.relation(relation).within;
        within.is_met_with(left, right, || self.sway(row, values, work))
    }

    /// Returns true if an equation of a relation holds.
    pub(crate) fn holds(&self, place: Place, values: &[f64], work: &mut Workspace) -> bool {
        let pattern = self.pattern_at(self.pattern_place(place.row));
        let [left, right] = self.sides(place.row, pattern, values, work);
        let within = self.relation(place.relation).within;
        within.is_met(left, right)
            || self.is_rounding(Differing { place, left, right }, values, work)
    }

    /// Returns true if slots of an equation that are one to the plan differ in a state, or one of them lies apart from
    /// what it is one with: what the equation says there is not what is left of it where they are one.
    pub(crate) fn is_parted(&self, place: Place, values: &[f64]) -> bool {
        if self.stood_for.is_empty() {
            return false;
        }
        let one = |slot: SlotIndex| {
            let at = self.stood_for.binary_search_by_key(&slot, |&(slot, _)| slot);
            at.map_or(slot, |at| self.stood_for[at].1)
        };
        let value = |&slot: &SlotIndex| (one(slot), (values[slot as usize] + 0.0).to_bits());
        let mut all: Vec<(SlotIndex, u64)> = self.arguments(place.row).iter().map(value).collect();
        let is_apart = |&slot: &SlotIndex| {
            !base::number::close(values[slot as usize], values[one(slot) as usize])
        };
        all.sort_unstable();
        self.arguments(place.row).iter().any(is_apart)
            || all.windows(2).any(|pair| pair[0].0 == pair[1].0 && pair[0].1 != pair[1].1)
    }

    fn arguments(&self, row: u32) -> &[SlotIndex] {
        let system = self.system();
        system.arguments(system.equations[row as usize].arguments)
    }
    fn sway(&self, row: u32, values: &[f64], work: &mut Workspace) -> f64 {
        let pattern = self.pattern_at(self.pattern_place(row));
        work.sway(pattern.kernel(), self.arguments(row), values)
    }
    fn sides(&self, row: u32, pattern: &Pattern, values: &[f64], w: &mut Workspace) -> [f64; 2] {
        let sides = w.run(pattern.values(), self.arguments(row), values, 2);
        [sides[0], sides[1]]
    }
}
