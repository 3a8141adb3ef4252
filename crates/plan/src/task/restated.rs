//! Tasks stated otherwise, when an edit runs and shows that it has to be: with rules that are tested and never solved
//! for, or with numbers that let go.

use super::{Course, Known, Origin, Stated, Task};
use crate::plans::Plans;
use crate::vanish::Vanished;
use base::number::Tolerance;
use kernel::SlotId;
use solve::{Level, Modes, Patterns, Relation, RelationBody, Slot, SlotIndex, Stay, System};
use std::collections::BTreeSet;
use std::rc::Rc;

/// Up to this many slots numbers let go.
pub(crate) const LETTING_GO: usize = 200;

impl Task {
    /// Returns what it is with these rules tested after each step and never solved for; nothing where it speaks of
    /// none of them, or is searched.
    pub(crate) fn with_tested(&self, rules: &BTreeSet<u32>, plans: &Plans) -> Option<Self> {
        let known = self.testing(rules, plans)?;
        Some(Self::of(known, self.component.clone()))
    }
    fn testing(&self, rules: &BTreeSet<u32>, plans: &Plans) -> Option<Known> {
        let is_one = |r: &Relation| match self.origin(r.source) {
            Origin::Rule(rule) => rules.contains(&rule),
            Origin::Number(_) | Origin::Wish(_) => false,
        };
        if !self.system.relations.iter().any(is_one) {
            return None;
        }
        let leave_to_test = |system: &mut System| {
            for i in (0..system.relations.len()).filter(|&i| is_one(&self.system.relations[i])) {
                let equations = system.equations_of(&system.relations[i]).iter();
                let slots = equations.flat_map(|e| system.arguments(e.arguments));
                let slots: BTreeSet<SlotIndex> = slots.copied().collect();
                let relation = &mut system.relations[i];
                relation.body = RelationBody::Opaque { slots: slots.into_iter().collect() };
                relation.methods.clear();
            }
        };
        self.restated(plans, leave_to_test)
    }

    /// Returns what it is with the rules left to the test that others imply by a theorem, whatever the state, if that
    /// is known of components like it.
    pub(crate) fn known_without_implied(&self) -> Option<Option<Self>> {
        let known = self.stated.implied.get()?;
        Some(known.clone().map(|known| Self::of(known, self.component.clone())))
    }
    /// The same, where it is these rules.
    pub(crate) fn knowing_implied(&self, rules: &BTreeSet<u32>, plans: &Plans) -> Option<Self> {
        let known = self.stated.implied.get_or_init(|| self.testing(rules, plans));
        known.clone().map(|known| Self::of(known, self.component.clone()))
    }

    /// Returns what it is where places stay as far apart as a known number says, one for each pair, after its slots.
    /// Nothing where it is searched.
    pub(crate) fn kept_apart(&self, pairs: &[Vanished], plans: &Plans) -> Option<Self> {
        let local = |slot: SlotId| {
            self.component.slots().iter().position(|&s| s == slot).map(|at| at as SlotIndex)
        };
        let slots = |pair: &Vanished| pair.slots.map(local).into_iter().collect::<Option<_>>();
        let slots: Vec<Vec<SlotIndex>> = pairs.iter().map(slots).collect::<Option<_>>()?;
        let keep = |system: &mut System| {
            for (pair, slots) in pairs.iter().zip(&slots) {
                let is_its = |origin: &Origin| *origin == Origin::Rule(pair.position);
                let source = self.stated.relations.iter().position(is_its).unwrap_or_default();
                let known = system.slots.len() as SlotIndex;
                let like = system.slots[slots[0] as usize].clone();
                system.slots.push(Slot { stay: Stay::Fixed, ..like });
                let arguments = slots.iter().copied().chain([known]);
                let equations = system.add_equations([(Patterns::APART, arguments)]);
                system.relations.push(Relation {
                    level: Level::Required,
                    body: RelationBody::Equations(equations),
                    methods: Default::default(),
                    derived: true,
                    rests: false,
                    reads: Default::default(),
                    within: Tolerance::Relative,
                    source: source as u32,
                });
            }
        };
        let known = self.restated(plans, keep)?;
        Some(Self::of(known, self.component.clone()))
    }

    /// Returns what it is where the computed numbers that its plan holds yield as well, as one place with what does,
    /// or the places, where it holds no such numbers. Nothing where it holds neither or lets nothing computed yield,
    /// where it opens, is large or is searched.
    pub(crate) fn letting_go(&self, plans: &Plans) -> Option<Self> {
        let find = || self.with_numbers_free(plans);
        let known = match self.course {
            Course::Plan => self.stated.letting_go.get_or_init(find).clone(),
            // the mode at hand, which need not be the one that was stated
            Course::Modes(..) => find(),
            Course::Search(_) => None,
        };
        known.map(|known| Self::of(known, self.component.clone()))
    }
    fn with_numbers_free(&self, plans: &Plans) -> Option<Known> {
        let slots = &self.system.slots[..self.component.slots().len()];
        if slots.len() > LETTING_GO || slots.iter().any(|s| s.stay == Stay::Free) {
            return None;
        }
        let mut yields = vec![false; self.system.slots.len()];
        self.plan.targets().for_each(|slot| yields[slot as usize] = true);
        let is_kept = |slot: &Slot| matches!(slot.stay, Stay::Kept { .. });
        let (_, with) =
            yields.iter().zip(slots).find(|(yields, slot)| **yields && is_kept(slot))?;
        let is_alone = |slot: &Slot| slots.iter().filter(|s| s.stay == slot.stay).nth(1).is_none();
        let lets_go = |&i: &usize| {
            let slot = &slots[i];
            let is_other = is_kept(slot) && slot.stay != with.stay;
            !yields[i] && is_other && slot.is_number && !slot.is_discrete
        };
        let held: Vec<usize> = (0..slots.len()).filter(lets_go).collect();
        let alone: Vec<usize> = held.iter().copied().filter(|&i| is_alone(&slots[i])).collect();
        let held = if alone.is_empty() { held } else { alone };
        if held.is_empty() {
            return None;
        }
        let let_go = |system: &mut System| {
            held.iter().for_each(|&i| system.slots[i].stay = with.stay);
            system.relations.iter_mut().for_each(|relation| relation.rests = false);
        };
        self.restated(plans, let_go)
    }
    /// Plans it with its system changed, all that is told of it the same; nothing where it is searched.
    fn restated(&self, plans: &Plans, change: impl Fn(&mut System)) -> Option<Known> {
        let (system, plan, course) = match &self.course {
            Course::Plan => {
                let mut system = (*self.system).clone();
                change(&mut system);
                let (system, plan) = plans.plan_later(system);
                (system, plan, Course::Plan)
            }
            Course::Modes(modes, _) => {
                let mut conditional = modes.conditional().clone();
                change(&mut conditional.system);
                let modes = Rc::new(Modes::known(conditional, plans.patterns())?);
                let mode = modes.blank();
                let (system, plan, _) = plans.in_mode(&modes, &mode);
                (system, plan, Course::Modes(modes, Box::new(mode)))
            }
            Course::Search(_) => return None,
        };
        Some((system, plan, course, Rc::new(self.stated.again())))
    }
}

impl Stated {
    /// Says the same of a system that is stated otherwise.
    fn again(&self) -> Self {
        let Self { holds, targets, numbers, relations, whole, .. } = self;
        let (holds, targets, relations) = (holds.clone(), targets.clone(), relations.clone());
        let (numbers, whole) = (numbers.clone(), whole.clone());
        Self { holds, targets, numbers, relations, whole, ..Self::default() }
    }
}
