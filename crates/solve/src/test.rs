//! Tests: which equations do not hold at a state.
//!
//! In: relations, by their places in the plan, and values. Out: the equations whose sides differ by
//! more than they may. Equations of one pattern that follow one another are evaluated in lanes.

use crate::pattern::{Pattern, PatternId};
use crate::plan::Plan;
use base::number::Tolerance;
use expr::{LANES, Lanes};

/// An equation that does not hold.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Failing {
    /// The relation that it belongs to.
    pub(crate) relation: u32,
    /// Its place in the system.
    pub(crate) row: u32,
    /// By how much its sides differ.
    pub(crate) error: f64,
    /// By how much they may.
    pub(crate) tolerance: f64,
}

/// Working space for tests.
#[derive(Clone, Debug, Default)]
pub(crate) struct TestScratch {
    /// Relation, place and tolerance of the equations at hand, all of one pattern.
    batch: Vec<(u32, u32, Tolerance)>,
    arguments: Vec<Lanes>,
    registers: Vec<Lanes>,
    out: Vec<Lanes>,
}

impl Plan {
    /// Calls `fails` for every equation of these relations that does not hold, in their order.
    pub(crate) fn each_failing(
        &self,
        relations: impl Iterator<Item = u32>,
        values: &[f64],
        scratch: &mut TestScratch,
        fails: &mut impl FnMut(Failing),
    ) {
        let system = self.system();
        let mut at_hand: Option<(PatternId, &Pattern)> = None;
        for r in relations {
            let relation = &self.relations[r as usize];
            for row in relation.first_row..relation.first_row + relation.rows {
                let equation = system.equations[row as usize];
                let same = at_hand.is_some_and(|(id, _)| id == equation.pattern);
                if !same || scratch.batch.len() == LANES {
                    if let Some((_, pattern)) = at_hand {
                        flush(pattern, scratch, fails);
                    }
                    if !same {
                        let pattern = self.pattern(equation.pattern);
                        at_hand = Some((equation.pattern, pattern));
                        let arity = pattern.arity().max(scratch.arguments.len());
                        scratch.arguments.resize(arity, [0.0; LANES]);
                    }
                }
                let lane = scratch.batch.len();
                let arguments = system.arguments(equation.arguments);
                for (lanes, &slot) in scratch.arguments.iter_mut().zip(arguments) {
                    lanes[lane] = values[slot as usize];
                }
                scratch.batch.push((r, row, relation.within));
            }
        }
        if let Some((_, pattern)) = at_hand {
            flush(pattern, scratch, fails);
        }
    }
}

/// Tests the equations at hand, all of this pattern.
fn flush(pattern: &Pattern, scratch: &mut TestScratch, fails: &mut impl FnMut(Failing)) {
    let mut sides = [[0.0; LANES]; 2];
    let mut sways = None;
    let TestScratch { batch, arguments, registers, out } = scratch;
    let arguments = &arguments[..pattern.arity()];
    pattern.values().run_lanes(arguments, registers, &mut sides);
    for (lane, (relation, row, within)) in batch.drain(..).enumerate() {
        let [left, right] = sides.map(|side| side[lane]);
        let error = if left == right { 0.0 } else { (left - right).abs() };
        let error = if error.is_nan() { f64::INFINITY } else { error };
        if error <= within.allowed(left, right) {
            continue;
        }
        let sways = sways.get_or_insert_with(|| pattern.sways(arguments, registers, out));
        let tolerance = within.allowed_with(left, right, sways[lane]);
        if error > tolerance {
            fails(Failing { relation, row, error, tolerance });
        }
    }
}
