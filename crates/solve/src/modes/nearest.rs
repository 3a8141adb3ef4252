//! The nearest mode: where none holds as it is, or a wish is left unmet, of all modes with the bounds of their
//! conditions.
//!
//! In: what was decided without such bounds. Out: the best of the modes that hold: wishes met better, fewer given
//! numbers yielding, less changed; of equals one in which nothing stops short of a bound, then the first.

use super::decide::{Assumption, Deciding, Decision, Ended, Tried, Yielding, blame};
use super::{Mode, Modes};
use crate::moved::{Moved, moved};
use crate::system::Level;
use crate::truth::Comparing;

/// So many more modes are tried where none is known.
const MOST_AT_BOUNDS: usize = 256;
/// So many more where one is known that leaves a wish unmet.
const MOST_NEARER: usize = 32;
/// Errors that differ by less than this part of them count as equal, and ways that differ by less than this part
/// of the extent: what lies between a bound and short of it.
const ALIKE: f64 = 1e-6;

/// What a mode in which everything holds comes to; less is better, the first first.
#[derive(Debug)]
struct Worth {
    /// The sum of squared errors at every level that is not required.
    unmet: [f64; Level::SOFT.len()],
    /// How many given numbers yield: of the document, then defaults.
    yielded: [usize; 2],
    /// How far given numbers moved, then all others: squared, in parts of the extent of what is measured alike.
    moved: Moved,
    /// How many bounds are stopped short of.
    short: usize,
}

impl Worth {
    fn is_better(&self, other: &Self) -> bool {
        let differ = |a: f64, b: f64, by: f64| ((a - b).abs() > by).then_some(a < b);
        let yields = (self.yielded != other.yielded).then(|| self.yielded < other.yielded);
        let mut unmet = self.unmet.iter().zip(&other.unmet);
        let mut moved = self.moved.iter().zip(&other.moved);
        unmet
            .find_map(|(&a, &b)| differ(a, b, ALIKE * a.max(b)))
            .or(yields)
            .or_else(|| moved.find_map(|(a, b)| differ(a.sqrt(), b.sqrt(), ALIKE)))
            .unwrap_or(self.short < other.short)
    }
}

impl Modes {
    fn worth(&self, mode: &Mode, tried: &Tried, start: &[f64]) -> Worth {
        let system = &self.conditional.system;
        let mut unmet = [0.0; Level::SOFT.len()];
        for u in &tried.outcome.unmet {
            let relation = system.relations.get(u.relation as usize);
            if let Some(rank) = relation.and_then(|r| r.level.rank()) {
                unmet[rank] += u.error * u.error;
            }
        }
        let moved = moved(&system.slots, start, &tried.values);
        let is_strict = |c: &&u32| self.comparisons[**c as usize].comparing == Comparing::Less;
        let short = mode.active.iter().filter(is_strict).count();
        Worth { unmet, yielded: tried.plan.yields(), moved, short }
    }

    /// Returns true if given numbers move no further than at another try.
    pub(super) fn moves_no_more(&self, tried: &Tried, than: &Tried, start: &[f64]) -> bool {
        let slots = &self.conditional.system.slots;
        let [ways, most] = [tried, than].map(|t| moved(slots, start, &t.values).map(f64::sqrt));
        let mut given = ways.into_iter().zip(most).take(2);
        let differ = |(a, b): (f64, f64)| ((a - b).abs() > ALIKE).then_some(a < b);
        given.find_map(differ).unwrap_or(true)
    }

    /// Returns true if something that is wished is not reached.
    fn is_missed(&self, tried: &Tried) -> bool {
        let relations = &self.conditional.system.relations;
        let is_wish = |r: u32| relations.get(r as usize).is_some_and(|r| r.level == Level::Move);
        tried.outcome.unmet.iter().any(|u| is_wish(u.relation))
    }
}

impl Deciding<'_> {
    /// Returns the best mode, bounds of conditions acting, where that is better than what was decided without.
    pub(super) fn nearest(&mut self, first: &Mode, start: &[f64], decided: Decision) -> Decision {
        let is_known = decided.ended == Ended::Settled;
        let is_content = is_known && !self.modes.is_missed(&decided.tried);
        if first.assumed.is_empty() || !is_known && self.is_hopeless || is_content {
            return decided;
        }
        let more = if is_known { MOST_NEARER } else { MOST_AT_BOUNDS };
        self.most = self.tried.len() + more.min(self.most);
        self.yielding = Yielding::Any;
        self.at_bounds = true;
        self.keeps_taken = is_known;
        let mut best = is_known.then(|| {
            (self.modes.worth(&decided.mode, &decided.tried, start), decided.mode.clone())
        });
        let mut learnt = Vec::new();
        while let Some(found) = self.explore(first, &mut learnt) {
            let tried = self.try_mode(&found);
            let worth = self.modes.worth(&found, &tried, start);
            learnt.push(self.behind_unmet(&found, &tried));
            if best.as_ref().is_none_or(|(best, _)| worth.is_better(best)) {
                best = Some((worth, found));
            }
        }
        match best {
            Some((_, mode)) => self.decision(mode, Ended::Settled),
            None if self.may_try() => decided,
            None => Decision { ended: Ended::NotDecided(self.tried.len()), ..decided },
        }
    }

    /// Returns the best of the modes in which everything holds, among as many as are tried.
    pub(super) fn nearest_of(&mut self, first: &Mode, start: &[f64]) -> Decision {
        let mut best: Option<(Worth, Mode)> = None;
        let mut learnt = Vec::new();
        while let Some(found) = self.explore(first, &mut learnt) {
            let worth = self.modes.worth(&found, &self.try_mode(&found), start);
            learnt.push(self.assumptions(&found, None));
            if best.as_ref().is_none_or(|(best, _)| worth.is_better(best)) {
                best = Some((worth, found));
            }
        }
        match best {
            Some((_, mode)) => self.decision(mode, Ended::Settled),
            None => self.decision(first.clone(), Ended::NotDecided(self.tried.len())),
        }
    }

    /// Returns the assumptions with which a mode leaves unmet what it does: all where that is not known, or where
    /// everything is met.
    fn behind_unmet(&self, mode: &Mode, tried: &Tried) -> Vec<Assumption> {
        self.assumptions(mode, blame(tried).as_ref())
    }
}
