//! Ghosts: other states that the rules allow as well, of a thing that they determine.
//!
//! In: a state that holds, and a thing. Out: states in which the thing is elsewhere, because a constraint
//! holds by another of its alternatives, because equations have another root, or because whole numbers are
//! others. What the thing is made of is looked for anew; everything else that is given stays, or, where it has
//! to follow, is left to. Then the same is asked of what constraints tie to it: it may follow that.

use crate::aim::Aim;
use crate::host::Host;
use crate::modal::{Acting, attempt_in_mode};
use crate::planner::{Model, Planner, is_any_new};
use crate::run::{Adapter, compute, ground, leans, scatter};
use crate::task::{Course, Holding, Task};
use crate::whole;
use kernel::{SlotId, Structure, ThingId, Values};
use solve::{Ended, Modes, Plan, SlotIndex, decide};
use std::collections::BTreeSet;
use std::rc::Rc;

/// At most so many states are found.
const MOST: usize = 8;
/// With more slots than this nothing is looked for: every ghost is a whole solve.
const LARGEST: usize = 2_000;
/// With more slots than this nothing around the thing is asked.
const LARGEST_AROUND: usize = 300;
/// At most so many places and numbers around it are asked.
const MOST_AROUND: usize = 12;

/// Another state that the rules allow.
#[derive(Clone, PartialEq, Debug)]
pub struct Ghost {
    /// What is otherwise in it.
    pub kind: GhostKind,
    /// The state.
    pub values: Values,
}

/// What is otherwise in a ghost.
#[derive(Clone, PartialEq, Debug)]
pub enum GhostKind {
    /// A constraint holds by this alternative.
    Taken(Acting),
    /// Equations have another root.
    Root {
        /// What they are about, besides what they are solved for.
        reads: Vec<SlotId>,
    },
    /// Whole numbers are others.
    Whole,
}

/// What becomes of everything but the thing.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Rest {
    /// What is given stays, what is not is computed.
    Stays,
    /// It yields where it has to.
    Follows,
}

impl Planner {
    /// Finds other states of a thing that the rules allow, at most eight, nearest roots first: those that it
    /// can come to itself, then those that it follows into, when something around it is elsewhere.
    ///
    /// Nothing where the rules leave the thing free. Cost: two plans of its component, one more for each of a
    /// dozen around it, and a solve for each state that is found. What was planned for this alone is forgotten.
    pub fn ghosts(
        &mut self,
        model: Model<'_>,
        values: &Values,
        thing: ThingId,
        host: &mut dyn Host,
    ) -> Vec<Ghost> {
        let structure = model.structure;
        let under = structure.slots_under(thing);
        let is_whole = structure.slot_of(thing).is_none();
        let own: BTreeSet<SlotId> = under
            .into_iter()
            .filter(|&slot| match Self::resting_hold(structure, slot) {
                Holding::Fixed => false,
                // numbers that a thing is given make it what it is
                Holding::Given(_) => !is_whole,
                Holding::Kept | Holding::Alone | Holding::Free => true,
            })
            .collect();
        let is_elsewhere = |ghost: &Ghost| {
            let values_of = &ghost.values.numbers;
            own.iter().any(|&s| values_of[s].to_bits() != values.numbers[s].to_bits())
        };
        let mark = self.plans.mark();
        let alike = std::mem::take(&mut self.alike);
        let mut found: Vec<Ghost> = Vec::new();
        for rest in [Rest::Stays, Rest::Follows] {
            self.lifted(model, values, &own, rest, LARGEST, host, &mut found);
        }
        found.retain(is_elsewhere);
        for unit in self.units_around(structure, &own) {
            self.lifted(model, values, &unit, Rest::Follows, LARGEST_AROUND, host, &mut found);
            found.retain(is_elsewhere);
        }
        self.alike = alike;
        self.plans.forget_since(mark);
        found
    }

    /// Finds other roots of the equations that determine some slots, nearest first, while everything that is given stays.
    pub(crate) fn roots(
        &mut self,
        model: Model<'_>,
        values: &Values,
        own: &BTreeSet<SlotId>,
        host: &mut dyn Host,
    ) -> Vec<Ghost> {
        let alike = std::mem::take(&mut self.alike);
        let mut found = Vec::new();
        self.lifted(model, values, own, Rest::Stays, LARGEST, host, &mut found);
        self.alike = alike;
        found
    }

    /// Adds the states that some slots can come to with their own stays lifted, in components of at `most` so
    /// many slots.
    #[expect(clippy::too_many_arguments, reason = "a ghost is all of these")]
    fn lifted(
        &mut self,
        model: Model<'_>,
        values: &Values,
        own: &BTreeSet<SlotId>,
        rest: Rest,
        most: usize,
        host: &mut dyn Host,
        found: &mut Vec<Ghost>,
    ) {
        let structure = model.structure;
        let holding = |slot: SlotId| {
            let resting = Self::resting_hold(structure, slot);
            match (resting, rest) {
                (Holding::Fixed, _) => Holding::Fixed,
                _ if own.contains(&slot) => Holding::Free,
                (_, Rest::Follows) => resting,
                (_, Rest::Stays) if structure.slots[slot].given.is_some() => Holding::Fixed,
                (_, Rest::Stays) => Holding::Free,
            }
        };
        let is_fixed = |slot| holding(slot) == Holding::Fixed;
        let mut components = self.net.around(own.iter().copied(), &self.rules, &is_fixed, &[]);
        components.retain(|c| c.slots().len() <= most);
        for task in self.tasks(structure, components, &holding, &[], None) {
            self.ghosts_of(model, &task, own, values, host, found);
        }
    }

    /// Returns places and numbers that constraints tie to these slots, nearest first; no given numbers.
    fn units_around(&self, structure: &Structure, own: &BTreeSet<SlotId>) -> Vec<BTreeSet<SlotId>> {
        let mut seen = own.clone();
        let mut reached: Vec<SlotId> = own.iter().copied().collect();
        let mut units: Vec<BTreeSet<SlotId>> = Vec::new();
        let mut at = 0;
        while at < reached.len() && units.len() < MOST_AROUND {
            let slot = reached[at];
            at += 1;
            let rules = self.net.rules_of(slot).iter();
            for next in rules.flat_map(|&rule| self.rules.get(rule).slots).copied() {
                match Self::resting_hold(structure, next) {
                    Holding::Fixed | Holding::Given(_) => continue,
                    Holding::Kept | Holding::Alone | Holding::Free => {}
                }
                if seen.contains(&next) {
                    continue;
                }
                let mut unit = BTreeSet::from([next]);
                unit.extend(self.net.place_of(next));
                seen.extend(&unit);
                reached.extend(&unit);
                units.push(unit);
            }
        }
        units.truncate(MOST_AROUND);
        units
    }

    /// Adds the states that one component can come to.
    fn ghosts_of(
        &self,
        model: Model<'_>,
        task: &Task,
        own: &BTreeSet<SlotId>,
        values: &Values,
        host: &mut dyn Host,
        found: &mut Vec<Ghost>,
    ) {
        match &task.course {
            Course::Plan => self.other_roots(model, task, &task.plan, values, host, found),
            Course::Modes(modes, _) => {
                let mut now = task.gather(&values.numbers);
                compute(self, model, task, values, host, &mut now);
                let mode = modes.first(&now, &now);
                let (_, plan) = self.in_mode(modes, &mode);
                self.other_roots(model, task, &plan, values, host, found);
                self.other_alternatives(model, task, modes, values, host, found);
            }
            Course::Search(puzzle) => {
                let local = (0..).zip(task.component.slots());
                let own: Vec<SlotIndex> =
                    local.filter(|(_, slot)| own.contains(slot)).map(|(i, _)| i).collect();
                for other in puzzle.others(&task.gather(&values.numbers), &own, MOST) {
                    self.add(model, task, &other, GhostKind::Whole, values, host, found);
                }
            }
        }
        for other in whole::others(self, model, task, own, values, host) {
            self.add(model, task, &other, GhostKind::Whole, values, host, found);
        }
    }

    fn other_roots(
        &self,
        model: Model<'_>,
        task: &Task,
        plan: &Rc<Plan>,
        values: &Values,
        host: &mut dyn Host,
        found: &mut Vec<Ghost>,
    ) {
        let mut x0 = ground(self, task, &Aim::default(), values, values).x0;
        compute(self, model, task, values, host, &mut x0);
        let mut trial = values.clone();
        let mut adapter = Adapter { planner: self, model, task, values: &mut trial, host };
        for other in solve::others(plan, &x0, None, MOST, &mut adapter) {
            let reads = plan.steps()[other.step as usize].reads.iter();
            let reads = reads.filter_map(|&r| task.component.slots().get(r as usize).copied());
            let kind = GhostKind::Root { reads: reads.collect() };
            self.add(model, task, &other.values, kind, values, host, found);
        }
    }

    fn other_alternatives(
        &self,
        model: Model<'_>,
        task: &Task,
        modes: &Rc<Modes>,
        values: &Values,
        host: &mut dyn Host,
        found: &mut Vec<Ghost>,
    ) {
        let mut ground = ground(self, task, &Aim::default(), values, values);
        ground.compute(self, model, task, values, host);
        let leans = leans(model, task);
        for (mode, standing) in modes.other_ways(&modes.first(&ground.x0, &ground.x0)) {
            let mut trial = values.clone();
            let mut attempt = |mode: &solve::Mode| {
                attempt_in_mode(self, model, task, modes, mode, &ground, &leans, &mut trial, host)
            };
            let decision = decide(modes, &mode, &ground.x0, &mut attempt);
            if decision.ended == Ended::Settled && decision.mode.taken == mode.taken {
                let kind = GhostKind::Taken(task.acting_by(self, standing));
                self.add(model, task, &decision.tried.values, kind, values, host, found);
            }
        }
    }

    /// Adds a state, if it is another one and all that holds now holds in it.
    #[expect(clippy::too_many_arguments, reason = "a ghost is all of these")]
    fn add(
        &self,
        model: Model<'_>,
        task: &Task,
        local: &[f64],
        kind: GhostKind,
        values: &Values,
        host: &mut dyn Host,
        found: &mut Vec<Ghost>,
    ) {
        let mut state = values.clone();
        scatter(task, local, &mut state);
        let slots = task.component.slots();
        let is_near = |other: &Values| {
            slots.iter().all(|&s| {
                let (a, b) = (state.numbers[s], other.numbers[s]);
                (a - b).abs() <= 1e-6 * a.abs().max(b.abs()).max(1e-3)
            })
        };
        if found.len() == MOST || is_near(values) || found.iter().any(|g| is_near(&g.values)) {
            return;
        }
        let rules = || task.component.rules().iter().copied();
        let was_unmet = self.unmet(model, rules(), values, host);
        let unmet = self.unmet(model, rules(), &state, host);
        if !is_any_new(&unmet, &was_unmet) {
            // what did not move keeps its bits
            for &s in slots {
                if base::number::close(state.numbers[s], values.numbers[s]) {
                    state.numbers[s] = values.numbers[s];
                }
            }
            found.push(Ghost { kind, values: state });
        }
    }
}
