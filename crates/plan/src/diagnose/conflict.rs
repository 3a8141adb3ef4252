//! Contradictions: which required constraints cannot hold together, and what would help.
//!
//! A set is tried by solving it alone: from where the last one held, from the present values and from several
//! scattered starts, everything moved at once; where that does not say enough, by a plan of its own too. What speaks
//! of the same numbers is tried first, then what depends on each other by structure. QuickXplain halves the suspects,
//! those next to what does not hold kept longest, until no constraint of the set can be spared: without any one of
//! them the others hold. That they hold is seen; that they cannot is only likely. Where what is left at last can hold,
//! something on the way there was wrongly taken for contradictory: the search goes back to the smallest set that still
//! looks so when it is tried harder, and on from there. A repair is told only if it was tried and everything else then
//! holds.
//!
//! **Source:** Junker, *QuickXplain: preferred explanations and relaxations for over-constrained
//! problems*, AAAI 2004.

use crate::aim::Aim;
use crate::component::Component;
use crate::diagnose::combination::Combination;
use crate::diagnose::gradient::is_linear;
use crate::diagnose::repair::{Repair, Suspects};
use crate::diagnose::trial::{Setup, Trial, perturbed, perturbed_by};
use crate::edit::{Conflict, NotDecided};
use crate::host::Host;
use crate::planner::{Model, Planner, Unmet};
use crate::rule::Source;
use crate::task::Holding;
use base::number::close;
use kernel::{SlotId, Values};
use solve::{Level, Rejected};
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// How many sets are tried before the search is given up, and how many constraints in all of them.
const TRIALS: usize = 1000;
const TRIED: usize = 200_000;
/// After so many multiplications, roughly, too.
const WORK: u64 = 3_000_000_000;
/// What trying one set may cost, at first and where that was too little.
const SHORT: u64 = WORK / 100;
const LONG: u64 = WORK / 10;
/// How far from the present values everything is moved at once from, in parts of the extent.
const FROM: [f64; 8] =
    [0.0, 1.0 / 128.0, 1.0 / 16.0, 1.0 / 16.0, 1.0 / 4.0, 1.0 / 4.0, 1.0 / 4.0, 1.0];
/// What looking for a further contradiction may cost.
const FURTHER: u64 = WORK / 20;
/// What trying the repairs of one contradiction may cost.
const REPAIR: u64 = 1_000_000_000;
/// How many sets are asked first of either kind.
const CIRCUITS: usize = 32;
/// How many contradictions of one component are told apart.
const APART: usize = 4;
/// From how many starts a set is tried, at least.
const STARTS: usize = 2 + FROM.len();
/// From so many further starts, so far away, a set is tried before it is said to have no solution.
const FURTHER_STARTS: usize = 40;
const FAR: [f64; 4] = [0.25, 1.0, 0.5, 4.0];

/// Required constraints that cannot all hold.
#[derive(Clone, PartialEq, Debug)]
pub struct Contradiction {
    /// The constraints, in order of declaration.
    pub constraints: Vec<Source>,
    /// Anchored slots that take part: if their place could move, the constraints would hold.
    pub anchors: Vec<SlotId>,
    /// How sure this is.
    pub certainty: Certainty,
    /// The sum that proves it, where all of it is linear.
    pub proof: Option<Combination>,
    /// What would work, each tried.
    pub repairs: Vec<Repair>,
}

/// How sure a contradiction is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Certainty {
    /// One is a combination of the others that says otherwise; none can be spared.
    Contradiction,
    /// No solution was found; none can be spared.
    NoSolution {
        /// From how many starts.
        starts: usize,
    },
    /// Not decided: the search ended before it was known which can be spared.
    NotDecided {
        /// How many sets were tried.
        trials: usize,
    },
    /// Not decided: no solution was found, and the search for one was given up.
    GivenUp(NotDecided),
    /// They are no contradiction: all of the component can hold, though they do not.
    Holds,
}

/// A constraint with its rules.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Unit {
    pub(crate) source: Source,
    pub(crate) rules: Vec<u32>,
}

/// Joins the rules of units.
pub(crate) fn rules_of(units: &[Unit]) -> Vec<u32> {
    units.iter().flat_map(|u| u.rules.iter().copied()).collect()
}

impl Planner {
    /// Finds minimal sets of required constraints that cannot hold together, and repairs.
    ///
    /// `unmet` are the constraints that do not hold. Cost: a few hundred solves of parts of the
    /// components in which something does not hold, at most.
    pub fn contradictions(
        &mut self,
        model: Model<'_>,
        values: &Values,
        unmet: &[Unmet],
        host: &mut dyn Host,
    ) -> Vec<Contradiction> {
        let required = unmet.iter().filter(|u| u.level == Level::Required);
        let unmet: BTreeSet<Source> = required.map(|u| u.source).collect();
        if unmet.is_empty() {
            return Vec::new();
        }
        let holding = |s| Self::resting_hold(model.structure, s);
        let setup = Setup { model, holding: &holding, aim: &Aim::default() };
        let mut found = Vec::new();
        for component in self.whole(model.structure).components.clone() {
            let units = self.units(component.rules());
            if !units.iter().any(|u| unmet.contains(&u.source)) {
                continue;
            }
            let given_up = self.given_up.iter().find(|(c, _)| c.rules() == component.rules());
            if let Some(&(_, bound)) = given_up {
                // parts of it would be searched as long
                let constraints = units.iter().map(|u| u.source);
                found.push(Contradiction {
                    constraints: constraints.filter(|s| unmet.contains(s)).collect(),
                    anchors: Vec::new(),
                    certainty: Certainty::GivenUp(bound),
                    proof: None,
                    repairs: Vec::new(),
                });
                continue;
            }
            let most = (TRIED / units.len()).clamp(20, TRIALS);
            let until = self.spent() + WORK;
            let units = nearest_first(units, &unmet, |r| self.rules.get(r).slots);
            let first = self.first_suspects(&setup, &units, &unmet);
            let mut search = Search::new(self, &setup, values, host, most, until);
            search.first = first.into();
            let sets = search.all(units.clone());
            if sets.is_empty() {
                let state = search.last;
                found.extend(self.that_holds(
                    model,
                    &component,
                    &units,
                    &unmet,
                    (values, state),
                    host,
                ));
                continue;
            }
            // a repair of one is tried with the others' last constraints left out
            let spared: Vec<Source> =
                sets.iter().filter_map(|(set, _)| set.last().map(|u| u.source)).collect();
            for (i, (set, certainty)) in sets.into_iter().enumerate() {
                let is_spared =
                    |u: &Unit| (0..).zip(&spared).any(|(j, s)| j != i && *s == u.source);
                let whole: Vec<Unit> = units.iter().filter(|u| !is_spared(u)).cloned().collect();
                self.try_until(Some(self.spent() + REPAIR));
                let mut suspects =
                    Suspects { planner: self, setup: &setup, values, set: &set, whole: &whole };
                let anchors = suspects.anchors(host);
                let repairs = suspects.repairs(&anchors, host);
                self.try_until(None);
                let constraints = set.iter().map(|u| u.source).collect();
                let proof = self.combination(&setup, &set, values);
                let certainty = if proof.is_some() { Certainty::Contradiction } else { certainty };
                found.push(Contradiction { constraints, anchors, certainty, proof, repairs });
            }
        }
        found
    }

    /// Says that all of a component can hold, where in this state it does, though some of it does not.
    fn that_holds(
        &self,
        model: Model<'_>,
        component: &Component,
        units: &[Unit],
        unmet: &BTreeSet<Source>,
        (values, state): (&Values, Option<Values>),
        host: &mut dyn Host,
    ) -> Option<Contradiction> {
        let state = state?;
        let changes = component.slots().iter().map(|&slot| (slot, state.numbers[slot]));
        let changes: Vec<(SlotId, f64)> =
            changes.filter(|&(slot, to)| !close(values.numbers[slot], to)).collect();
        // given numbers that yielded are as they were in it
        let rules = component.rules().iter().copied();
        let holds =
            self.unmet(model, rules, &state, host).iter().all(|u| u.level != Level::Required);
        Some(Contradiction {
            constraints: units.iter().map(|u| u.source).filter(|s| unmet.contains(s)).collect(),
            anchors: Vec::new(),
            certainty: Certainty::Holds,
            proof: None,
            repairs: if holds { vec![Repair::Move { to: changes }] } else { Vec::new() },
        })
    }

    /// Finds what stands against an edit: the constraints of these rules that cannot hold together
    /// with it. Nothing where they can, or where it would take too long.
    pub(crate) fn against(
        &mut self,
        setup: &Setup<'_>,
        rules: &[u32],
        values: &Values,
        host: &mut dyn Host,
    ) -> Option<Conflict> {
        /// A refusal is wanted at once.
        const MOST: usize = 400;
        const SOON: u64 = WORK / 30;
        let mut units = self.units(rules);
        if units.len() > MOST {
            return None;
        }
        // what speaks of nothing else than what the edit says, and of what is held, is named first
        let said = setup.aim.slots();
        let is_said = |s: &SlotId| said.contains(s) || (setup.holding)(*s) == Holding::Fixed;
        let slots = |r: &u32| self.rules.get(*r).slots;
        units.sort_by_key(|unit| !unit.rules.iter().all(|r| slots(r).iter().all(is_said)));
        let most = TRIED / MOST;
        let until = self.spent() + SOON;
        let mut search = Search::new(self, setup, values, host, most, until);
        let (set, certainty) = search.minimal(&units)?;
        if matches!(certainty, Certainty::NotDecided { .. }) {
            return None;
        }
        let mut sources = set.iter().map(|u| u.source);
        let source = sources.next()?;
        Some(Conflict { source, circuit: sources.collect() })
    }

    /// Returns the sets of units among which contradictions most often are: what speaks of the same numbers, one of
    /// them not met; then what depends on each other by structure, small sets first.
    fn first_suspects(
        &mut self,
        setup: &Setup<'_>,
        units: &[Unit],
        unmet: &BTreeSet<Source>,
    ) -> Vec<BTreeSet<Source>> {
        let moves = |s: &SlotId| !matches!((setup.holding)(*s), Holding::Fixed | Holding::Given(_));
        let mut alike: BTreeMap<BTreeSet<SlotId>, BTreeSet<Source>> = BTreeMap::new();
        for unit in units {
            let slots = unit.rules.iter().flat_map(|&r| self.rules.get(r).slots).copied();
            alike.entry(slots.filter(moves).collect()).or_default().insert(unit.source);
        }
        let are_suspect = |s: &BTreeSet<Source>| s.len() > 1 && !s.is_disjoint(unmet);
        let mut first: Vec<BTreeSet<Source>> = alike.into_values().filter(are_suspect).collect();
        first.truncate(CIRCUITS);
        let mark = self.plans.mark();
        let tasks = self.tasks_of(setup, &rules_of(units));
        let known: BTreeSet<Source> = units.iter().map(|u| u.source).collect();
        let mut circuits: Vec<BTreeSet<Source>> = Vec::new();
        for task in &tasks {
            let level = |r: &Rejected| task.system.relations[r.relation as usize].level;
            for mut conflict in self.conflicts(task, |r| level(r) == Level::Required) {
                conflict.circuit.push(conflict.source);
                let all = conflict.circuit.into_iter();
                circuits.push(all.filter(|s| known.contains(s)).collect());
            }
        }
        self.plans.forget_since(mark);
        circuits.sort_by_key(BTreeSet::len);
        circuits.truncate(CIRCUITS);
        first.extend(circuits);
        first
    }

    /// Groups the required ones of these rules by constraint.
    fn units(&self, rules: &[u32]) -> Vec<Unit> {
        let mut units: BTreeMap<Source, Vec<u32>> = BTreeMap::new();
        for &r in rules {
            let rule = self.rules.get(r);
            if rule.shape.level == Level::Required {
                units.entry(rule.source).or_default().push(r);
            }
        }
        units.into_iter().map(|(source, rules)| Unit { source, rules }).collect()
    }
}

/// How hard a set is tried, and what that may cost.
#[derive(Clone, Copy, Debug)]
enum Effort {
    /// Everything moved at once.
    AtOnce { most: u64 },
    /// By a plan of its own too.
    Planned { most: u64 },
}

const QUICK: Effort = Effort::AtOnce { most: LONG };
const FIRM: Effort = Effort::Planned { most: SHORT };
const HARDEST: Effort = Effort::Planned { most: LONG };

/// How hard sets are tried, round by round; where a set was taken for contradictory that can hold, how hard those
/// that it was found in are tried again.
const ROUNDS: [[Effort; 2]; 6] = [
    [QUICK, FIRM],
    [QUICK, FIRM],
    [QUICK, FIRM],
    [FIRM, HARDEST],
    [FIRM, HARDEST],
    [HARDEST, HARDEST],
];

/// A search for what cannot hold together.
struct Search<'s> {
    planner: &'s mut Planner,
    setup: &'s Setup<'s>,
    values: &'s Values,
    host: &'s mut dyn Host,
    trials: usize,
    /// The sets that are asked first, as far as they were not yet.
    first: VecDeque<BTreeSet<Source>>,
    /// The state in which the last set that can hold was found to, what is given as it is: the next one is much
    /// the same.
    last: Option<Values>,
    /// States in which sets that were taken for contradictory were found to hold: what looked so may hold near them.
    escapes: Vec<Values>,
    /// The sets that were taken for contradictory, each a part of the one before.
    chain: Vec<Vec<Unit>>,
    /// How hard one is tried.
    effort: Effort,
    /// How many there may be, and what the planner may have spent.
    most: usize,
    until: u64,
}

impl<'s> Search<'s> {
    fn new(
        planner: &'s mut Planner,
        setup: &'s Setup<'s>,
        values: &'s Values,
        host: &'s mut dyn Host,
        most: usize,
        until: u64,
    ) -> Self {
        Self {
            planner,
            setup,
            values,
            host,
            trials: 0,
            first: VecDeque::new(),
            last: None,
            escapes: Vec::new(),
            chain: Vec::new(),
            effort: FIRM,
            most,
            until,
        }
    }

    /// Finds contradictions one after the other, the last constraint of each left out for the next,
    /// until leaving out one constraint would do. Of further ones only those are told that are found soon.
    fn all(&mut self, mut units: Vec<Unit>) -> Vec<(Vec<Unit>, Certainty)> {
        let mut found = Vec::new();
        while found.len() < APART {
            let Some((set, certainty)) = self.minimal(&units) else { break };
            if !found.is_empty() && self.has_ended() {
                break;
            }
            self.until = self.until.min(self.planner.spent() + FURTHER);
            let is_all = set.iter().any(|u| self.can_hold(&without(&units, Some(u)), &[]));
            units = without(&units, set.last());
            found.push((set, certainty));
            if is_all {
                break;
            }
        }
        found
    }

    /// Finds a minimal set of units that cannot hold together, and how sure that is; nothing if all of them can.
    ///
    /// What takes long counts as not found. Where that was wrong, and the set can hold, more is tried.
    fn minimal(&mut self, units: &[Unit]) -> Option<(Vec<Unit>, Certainty)> {
        while let Some(suspects) = self.first.pop_front() {
            let is_suspect = |u: &&Unit| suspects.contains(&u.source);
            let part: Vec<Unit> = units.iter().filter(is_suspect).cloned().collect();
            if part.len() < suspects.len() || part.len() == units.len() {
                continue;
            }
            let found = self.minimal_of(&part);
            if found.as_ref().is_some_and(|f| !matches!(f.1, Certainty::NotDecided { .. })) {
                return found;
            }
        }
        self.minimal_of(units)
    }

    fn minimal_of(&mut self, units: &[Unit]) -> Option<(Vec<Unit>, Certainty)> {
        self.effort = FIRM;
        if self.can_hold(&[], units) {
            return None;
        }
        self.escapes.clear();
        self.chain = vec![units.to_vec()];
        let mut found = (units.to_vec(), Certainty::NotDecided { trials: self.trials });
        for [effort, harder] in ROUNDS {
            self.effort = effort;
            let whole = self.chain.last().cloned().unwrap_or_default();
            let set = self.explain(&mut Vec::new(), 0, &whole);
            let certainty = self.certainty(&set);
            let is_decided = !matches!(certainty, Certainty::NotDecided { .. });
            found = (set, certainty);
            if is_decided || self.has_ended() {
                break;
            }
            self.escapes.extend(self.last.clone());
            if self.can_hold(&[], units) && !self.has_ended() {
                return None;
            }
            self.effort = harder;
            self.back_out();
        }
        let (mut set, certainty) = found;
        set.sort_by_key(|u| u.source);
        Some((set, certainty))
    }

    /// Drops from the chain what can hold after all, where the set that it ends in was found to.
    fn back_out(&mut self) {
        let mut chain = std::mem::take(&mut self.chain);
        // the first cannot hold
        let (mut low, mut high) = (1, chain.len());
        self.escapes.extend(self.last.clone());
        while low < high {
            let middle = low.midpoint(high);
            if self.can_hold(&chain[middle], &[]) {
                self.escapes.extend(self.last.clone());
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        chain.truncate(low);
        self.chain = chain;
    }

    /// QuickXplain: the units among `suspects` without which those of `known` could hold.
    ///
    /// `added` is how many came to the known ones last.
    fn explain(&mut self, known: &mut Vec<Unit>, added: usize, suspects: &[Unit]) -> Vec<Unit> {
        if added > 0 && !self.can_hold(known, &[]) {
            self.chain.push(known.clone());
            return Vec::new();
        }
        if suspects.len() <= 1 {
            return suspects.to_vec();
        }
        let (first, second) = suspects.split_at(suspects.len() / 2);
        let size = known.len();
        known.extend_from_slice(first);
        let from_second = self.explain(known, first.len(), second);
        known.truncate(size);
        known.extend_from_slice(&from_second);
        let mut set = self.explain(known, from_second.len(), first);
        known.truncate(size);
        set.extend(from_second);
        set
    }

    /// Returns true if it was given up: what it found may not be minimal.
    fn has_ended(&self) -> bool {
        self.trials >= self.most || self.planner.spent() >= self.until
    }

    /// Returns true if these can hold together. Where the search has ended they are said to: what is named then
    /// still cannot hold together, but some of it might be spared.
    fn can_hold(&mut self, known: &[Unit], more: &[Unit]) -> bool {
        if self.has_ended() {
            return true;
        }
        self.trials += 1;
        let rules: Vec<u32> = known.iter().chain(more).flat_map(|u| u.rules.clone()).collect();
        // one that was not tried to its end says nothing
        self.try_out(&rules, self.effort) == Trial::Holds || self.has_ended()
    }

    /// Tries rules: from the state in which the last set held, then by their plan, then from many starts.
    fn try_out(&mut self, rules: &[u32], effort: Effort) -> Trial {
        let Self { planner, setup, values, host, .. } = self;
        let (Effort::AtOnce { most } | Effort::Planned { most }) = effort;
        planner.try_until(Some(self.until.min(planner.spent() + most)));
        let mut state = self.last.as_ref().unwrap_or(values).clone();
        let mut trial = Trial::NotFound;
        if planner.try_at_once(setup, rules, &mut state, *host) {
            trial = Trial::Holds;
        } else if let Effort::Planned { .. } = effort {
            state.clone_from(values);
            trial = planner.can_hold(setup, rules, &mut state, *host);
        }
        if trial == Trial::NotFound {
            let slots: BTreeSet<SlotId> =
                rules.iter().flat_map(|&r| planner.rules.get(r).slots).copied().collect();
            let moves =
                |s: &SlotId| !matches!((setup.holding)(*s), Holding::Fixed | Holding::Given(_));
            let slots: Vec<SlotId> = slots.into_iter().filter(moves).collect();
            let scattered = (0..)
                .zip(FROM)
                .map(|(seed, part)| perturbed_by(part, seed, setup.model, &slots, values));
            for start in self.escapes.iter().cloned().chain(scattered) {
                state = start;
                if planner.try_at_once(setup, rules, &mut state, *host) {
                    trial = Trial::Holds;
                    break;
                }
            }
        }
        planner.try_until(None);
        if trial == Trial::Holds {
            for &s in rules.iter().flat_map(|&r| planner.rules.get(r).slots) {
                if matches!((setup.holding)(s), Holding::Fixed | Holding::Given(_)) {
                    state.put(s, values.get(s));
                }
            }
            self.last = Some(state);
        }
        trial
    }

    /// Returns true if rules hold in a state far from that of now.
    fn holds_far_away(&mut self, rules: &[u32]) -> bool {
        let Self { planner, setup, values, host, .. } = self;
        planner.try_until(Some(self.until.min(planner.spent() + LONG)));
        let slots: BTreeSet<SlotId> =
            rules.iter().flat_map(|&r| planner.rules.get(r).slots).copied().collect();
        let moves = |s: &SlotId| !matches!((setup.holding)(*s), Holding::Fixed | Holding::Given(_));
        let slots: Vec<SlotId> = slots.into_iter().filter(moves).collect();
        let parts = FAR.iter().copied().cycle();
        let seeds = (FROM.len() as u32..).take(FURTHER_STARTS);
        let found = seeds.zip(parts).find_map(|(seed, part)| {
            let mut state = perturbed_by(part, seed, setup.model, &slots, values);
            planner.try_at_once(setup, rules, &mut state, *host).then_some(state)
        });
        planner.try_until(None);
        let holds = found.is_some();
        self.last = found.or_else(|| self.last.take());
        holds
    }

    /// Says how sure it is that a set cannot hold together.
    fn certainty(&mut self, set: &[Unit]) -> Certainty {
        let ended = self.has_ended();
        let rules = rules_of(set);
        let mut trial = if ended { Trial::NotFound } else { self.try_out(&rules, HARDEST) };
        if trial == Trial::NotFound && !self.has_ended() && self.holds_far_away(&rules) {
            trial = Trial::Holds;
        }
        match trial {
            Trial::Contradicts => Certainty::Contradiction,
            Trial::NotFound if !self.has_ended() => {
                Certainty::NoSolution { starts: STARTS + FURTHER_STARTS }
            }
            Trial::NotFound | Trial::Holds => Certainty::NotDecided { trials: self.trials },
        }
    }
}

/// Orders units by how many steps from slot to slot they are from those that are not met: what is named
/// first is spared last, and a contradiction is best told by what stands next to it.
fn nearest_first<'s>(
    units: Vec<Unit>,
    unmet: &BTreeSet<Source>,
    slots: impl Fn(u32) -> &'s [SlotId],
) -> Vec<Unit> {
    let slots = |u: &Unit| u.rules.iter().flat_map(|&r| slots(r)).copied().collect::<Vec<_>>();
    let mut by_slot: BTreeMap<SlotId, Vec<usize>> = BTreeMap::new();
    for (i, unit) in units.iter().enumerate() {
        slots(unit).into_iter().for_each(|s| by_slot.entry(s).or_default().push(i));
    }
    let step = |u: &Unit| if unmet.contains(&u.source) { 0 } else { usize::MAX };
    let mut steps: Vec<usize> = units.iter().map(step).collect();
    let mut next: VecDeque<usize> = (0..units.len()).filter(|&i| steps[i] == 0).collect();
    while let Some(i) = next.pop_front() {
        for j in slots(&units[i]).iter().filter_map(|s| by_slot.remove(s)).flatten() {
            if steps[j] == usize::MAX {
                steps[j] = steps[i] + 1;
                next.push_back(j);
            }
        }
    }
    let mut ordered: Vec<(usize, Unit)> = steps.into_iter().zip(units).collect();
    ordered.sort_by_key(|(step, _)| *step);
    ordered.into_iter().map(|(_, unit)| unit).collect()
}

/// Returns the other units.
fn without(units: &[Unit], unit: Option<&Unit>) -> Vec<Unit> {
    units.iter().filter(|u| Some(*u) != unit).cloned().collect()
}

impl Planner {
    /// Tries rules from these values and, where a row has several solutions, from elsewhere; given numbers
    /// that do not yield are what they are. Leaves the state in which they hold.
    pub(crate) fn can_hold(
        &mut self,
        setup: &Setup<'_>,
        rules: &[u32],
        values: &mut Values,
        host: &mut dyn Host,
    ) -> Trial {
        let mut yielding = BTreeSet::new();
        let start = values.clone();
        let first = self.try_rules_noting(setup, rules, values, &mut yielding, host);
        let patterns = self.plans.patterns();
        let all_linear = rules.iter().all(|&r| is_linear(patterns, self.rules.get(r)));
        if first == Trial::Holds || (all_linear && first == Trial::Contradicts) {
            return first;
        }
        let moves = |s: &SlotId| match (setup.holding)(*s) {
            Holding::Fixed => false,
            Holding::Given(_) => yielding.contains(s),
            Holding::Kept | Holding::Alone | Holding::Free => true,
        };
        let slots: BTreeSet<SlotId> =
            rules.iter().flat_map(|&r| self.rules.get(r).slots.to_vec()).filter(moves).collect();
        let slots: Vec<SlotId> = slots.into_iter().collect();
        *values = perturbed(setup.model, &slots, &start);
        match self.try_rules(setup, rules, values, host) {
            Trial::Holds => Trial::Holds,
            Trial::Contradicts => first,
            Trial::NotFound => Trial::NotFound,
        }
    }
}
