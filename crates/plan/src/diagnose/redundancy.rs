//! Redundancy: required constraints that say nothing new.
//!
//! Two tests, one after the other. A row that is a combination of others at a generic point is so
//! everywhere: where it holds, it is superfluous by its *form*. A row that depends on others only at
//! the present state is a candidate: all candidates are left out, the rest is solved from a perturbed
//! start, and those that hold there all the same follow from the rest by a *theorem*. Two curves that
//! touch by design are dependent here and fail there: they are not superfluous.

use crate::aim::Aim;
use crate::diagnose::dependence::{Candidate, Hold, candidates, core, dependents, rejected_rows};
use crate::diagnose::trial::{Setup, Trial, perturbed, scattered};
use crate::host::Host;
use crate::planner::{Model, Planner, Unmet};
use crate::rule::{Body, Source};
use crate::task::{Course, Holding, Task};
use kernel::{SlotId, Structure, Values};
use solve::{Level, PATIENCE};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// A required constraint that holds and says nothing new.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Redundant {
    /// The constraint.
    pub source: Source,
    /// Why it is superfluous.
    pub kind: RedundantKind,
    /// Constraints that imply it, in order of declaration.
    pub implied_by: Vec<Source>,
}

/// Why a constraint is superfluous.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum RedundantKind {
    /// It is a combination of others, whatever the values.
    Form,
    /// Wherever the others hold, it does.
    Theorem,
}

/// What is superfluous in a state.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Redundancy {
    /// The constraints, in order of declaration.
    pub constraints: Vec<Redundant>,
    /// For every component in which some are so by a theorem, how many more motions it has than its form says.
    pub(crate) theorems: BTreeMap<usize, usize>,
}

impl Redundancy {
    /// Adds what is superfluous in one component.
    pub(crate) fn add(&mut self, component: usize, (found, motions): (Vec<Redundant>, usize)) {
        if motions > 0 {
            self.theorems.insert(component, motions);
        }
        self.constraints.extend(found);
    }
    /// Puts the constraints in order of declaration.
    pub(crate) fn sorted(mut self) -> Self {
        self.constraints.sort();
        self
    }
}

/// How many constraints are superfluous, and how much more is free since some follow from others by a theorem.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Surplus {
    /// The constraints, in order of declaration.
    pub constraints: Vec<Source>,
    /// How many more motions there are than [`crate::Status::freedom`] counts.
    pub motions: usize,
}

/// What is superfluous in one component.
struct Found {
    /// By its form.
    surplus: Vec<Redundant>,
    /// By a theorem.
    theorems: BTreeMap<u32, Candidate>,
    /// How many more motions there are than its form says.
    motions: usize,
}

/// Up to so many slots of a component it is asked which rules imply another.
const MOST_ASKED: usize = 60;
/// Of so many rules of a component.
const MOST_ASKED_RULES: usize = 16;
/// Up to so many slots it is asked whether rules follow from others for the given numbers as they are, and which do by a
/// theorem where given numbers would yield.
const MOST_WITH_GIVEN: usize = 400;

impl Planner {
    /// Finds the required constraints that say nothing new; `values` are those of the document at rest,
    /// and `unmet` is what does not hold there.
    ///
    /// Plans what was not planned yet. Cost: an elimination of the rows that are not linear, and one
    /// solve for each component with a candidate.
    pub fn redundancy(
        &mut self,
        model: Model<'_>,
        values: &Values,
        unmet: &[Unmet],
        host: &mut dyn Host,
    ) -> Redundancy {
        let required = unmet.iter().filter(|u| u.level == Level::Required);
        let unmet: BTreeSet<Source> = required.map(|u| u.source).collect();
        self.plan_resting(model.structure);
        let tasks = self.take_resting();
        let mut out = Redundancy::default();
        for (index, task) in tasks.iter().enumerate() {
            out.add(index, self.redundant(model, task, values, &unmet, host));
        }
        self.give_resting(tasks);
        out.sorted()
    }

    /// Finds what says nothing new, and how much more is free because of it, and asks no further which constraints
    /// imply another. Plans what was not planned yet; otherwise the cost is that of [`Planner::redundancy`] less that.
    pub fn surplus(
        &mut self,
        model: Model<'_>,
        values: &Values,
        unmet: &[Unmet],
        host: &mut dyn Host,
    ) -> Surplus {
        let required = unmet.iter().filter(|u| u.level == Level::Required);
        let unmet: BTreeSet<Source> = required.map(|u| u.source).collect();
        self.plan_resting(model.structure);
        let tasks = self.take_resting();
        let mut out = Surplus::default();
        for task in &tasks {
            let in_mode = task.by_values(self, model, values, host);
            let task = in_mode.as_ref().unwrap_or(task);
            let found = self.found(model, task, values, &unmet, host);
            let theorems = found.theorems.keys().map(|&rule| self.rules.source(rule));
            out.constraints.extend(found.surplus.into_iter().map(|r| r.source).chain(theorems));
            if !task.is_of_layout(model.structure) {
                out.motions += found.motions;
            }
        }
        self.give_resting(tasks);
        out.constraints.sort();
        out
    }

    /// Returns true if some constraint of a component at rest may follow from others by a theorem: if some row depends
    /// on others here, though not by its form. Solves nothing.
    pub(crate) fn may_follow(
        &self,
        model: Model<'_>,
        task: &Task,
        values: &Values,
        unmet: &BTreeSet<Source>,
        host: &mut dyn Host,
    ) -> bool {
        if self.fails(task, unmet) {
            return false;
        }
        let in_mode = task.by_values(self, model, values, host);
        let task = in_mode.as_ref().unwrap_or(task);
        let resting = (task, Self::resting_hold as Hold);
        let none = BTreeSet::new();
        if !may_follow_from_given(model, task) {
            return self.some_depend(&none, model, resting, values, host);
        }
        let given = (task, hold_given as Hold);
        // what depends on nothing while given numbers are held does not where they may yield
        if !self.some_depend(&none, model, given, values, host) {
            return false;
        }
        let everywhere = self.dependent_elsewhere(model, given, values, host);
        everywhere.is_empty()
            || self.some_depend(&everywhere, model, given, values, host)
            || self.some_depend(&none, model, resting, values, host)
    }

    /// Returns true if some row depends on others here, though not by its form, without some rows that are known to.
    fn some_depend(
        &self,
        known: &BTreeSet<(u32, u32)>,
        model: Model<'_>,
        setting: (&Task, Hold),
        values: &Values,
        host: &mut dyn Host,
    ) -> bool {
        let rejected = rejected_rows(setting.0);
        let whole = self.wholly_rejected(&rejected);
        let mut depend =
            |core: &[(u32, u32)]| !candidates(self, model, setting, core, values, host).is_empty();
        depend(&self.core_of_accepted(model, setting, &(&rejected | known)))
            || whole.len() < rejected.len()
                && depend(&core(self, model, setting, &(&whole | known)))
    }

    /// Returns true if a component has a constraint that is unmet.
    pub(crate) fn fails(&self, task: &Task, unmet: &BTreeSet<Source>) -> bool {
        let fails = |&r: &u32| unmet.contains(&self.rules.source(r));
        !unmet.is_empty() && task.component.rules().iter().any(fails)
    }

    /// Finds the required constraints of one component at rest that say nothing new; those that do not hold are
    /// `unmet`.
    fn found(
        &mut self,
        model: Model<'_>,
        task: &Task,
        values: &Values,
        unmet: &BTreeSet<Source>,
        host: &mut dyn Host,
    ) -> Found {
        let fails = self.fails(task, unmet);
        let (theorems, with_given) = match fails {
            true => Default::default(),
            false => self.theorems_and_motions(model, task, values, host),
        };
        let rules: BTreeSet<u32> = theorems.keys().copied().collect();
        // what one of these stood against may say something once that is left out
        let left = task.with_tested(&rules, &self.plans);
        let left = left.map(|left| left.by_values(self, model, values, host).unwrap_or(left));
        let left = left.as_ref().unwrap_or(task);
        let is_theorem = |source: Source| rules.iter().any(|&r| self.rules.source(r) == source);
        let mut surplus = surplus(self, left);
        surplus.retain(|r| !unmet.contains(&r.source) && !is_theorem(r.source));
        if fails {
            // what speaks of the same as one that does not hold may be what it stands against
            let slots = |is_of: &dyn Fn(Source) -> bool| -> BTreeSet<SlotId> {
                let own = task.component.rules().iter().filter(|&&r| is_of(self.rules.source(r)));
                own.flat_map(|&r| self.rules.get(r).slots.iter().copied()).collect()
            };
            let off = slots(&|source| unmet.contains(&source));
            surplus.retain(|r| slots(&|source| source == r.source).is_disjoint(&off));
        }
        let motions = left.plan.report.freedom.saturating_sub(task.plan.report.freedom);
        Found { surplus, theorems, motions: motions + with_given }
    }

    /// Finds the required constraints of one component at rest that say nothing new, with what implies them, and how
    /// many more motions there are than its form says; those that do not hold are `unmet`.
    fn redundant(
        &mut self,
        model: Model<'_>,
        task: &Task,
        values: &Values,
        unmet: &BTreeSet<Source>,
        host: &mut dyn Host,
    ) -> (Vec<Redundant>, usize) {
        let in_mode = task.by_values(self, model, values, host);
        let task = in_mode.as_ref().unwrap_or(task);
        let Found { surplus: mut found, theorems, motions } =
            self.found(model, task, values, unmet, host);
        let rules: BTreeSet<u32> = theorems.keys().copied().collect();
        let may_ask = task.component.slots().len() <= MOST_ASKED;
        for (count, (rule, Candidate { circuit, .. })) in theorems.into_iter().enumerate() {
            let implied_by = match may_ask && count < MOST_ASKED_RULES {
                true => self.implying(model, task, (rule, circuit), &rules, values, host),
                false => circuit,
            };
            let source = self.rules.source(rule);
            let implied_by = implied_by.into_iter().map(|r| self.rules.source(r));
            let implied_by = implied_by.filter(|s| *s != source).collect();
            found.push(Redundant { source, kind: RedundantKind::Theorem, implied_by });
        }
        (found, motions)
    }

    /// Returns the rules of a component that follow from others by a theorem, and how many motions there are because
    /// rules follow from others for the given numbers as they are: a ball as thick as the gap between a ring and a
    /// hub rolls round.
    fn theorems_and_motions(
        &mut self,
        model: Model<'_>,
        task: &Task,
        values: &Values,
        host: &mut dyn Host,
    ) -> (BTreeMap<u32, Candidate>, usize) {
        let may_follow = may_follow_from_given(model, task);
        let for_given = may_follow.then(|| self.theorems(model, task, hold_given, values, host));
        let for_given = match for_given {
            // what depends on nothing while given numbers are held does not where they may yield
            Some(Theorems { is_independent: true, .. }) => return Default::default(),
            Some(found) => found.rules,
            None => BTreeMap::new(),
        };
        let theorems = self.theorems(model, task, Self::resting_hold, values, host).rules;
        let motions = for_given.into_iter().filter(|(rule, _)| !theorems.contains_key(rule));
        let motions = motions.map(|(_, c)| c.rows).sum();
        (theorems, motions)
    }

    /// Returns the rules of a component that depend on others at the present state alone and hold after the rest is
    /// solved without them from elsewhere, slots held so.
    fn theorems(
        &mut self,
        model: Model<'_>,
        task: &Task,
        hold: Hold,
        values: &Values,
        host: &mut dyn Host,
    ) -> Theorems {
        let found = self.theorems_but(&BTreeSet::new(), model, (task, hold), values, host);
        if std::ptr::fn_addr_eq(hold, Self::resting_hold as Hold) || found.rules.is_empty() {
            return found;
        }
        // what depends on others wherever they are while slots are held so, as what is said of these alone, takes no
        // more from them here
        let everywhere = self.dependent_elsewhere(model, (task, hold), values, host);
        if everywhere.is_empty() {
            return found;
        }
        let found = self.theorems_but(&everywhere, model, (task, hold), values, host);
        Theorems { is_independent: false, ..found }
    }

    /// Returns the rows that depend on others at a state that is not special, slots held so: rule and equation.
    fn dependent_elsewhere(
        &self,
        model: Model<'_>,
        setting: (&Task, Hold),
        values: &Values,
        host: &mut dyn Host,
    ) -> BTreeSet<(u32, u32)> {
        let core = core(self, model, setting, &rejected_rows(setting.0));
        // what is anchored may lie anyhow as well
        let slots = setting.0.component.slots();
        let mut elsewhere = perturbed(model, slots, values);
        for &s in slots.iter().filter(|&&s| model.structure.slots[s].anchored) {
            elsewhere.numbers[s] += values.numbers[s].abs().max(1.0) * scattered(s.0);
        }
        let states = [values, &elsewhere];
        let found = dependents(self, model, setting, &core, states, host);
        found.into_iter().map(|d| d.row).collect()
    }

    /// The same without some rows, rule and equation, that are known to depend on others.
    fn theorems_but(
        &mut self,
        known: &BTreeSet<(u32, u32)>,
        model: Model<'_>,
        (task, hold): (&Task, Hold),
        values: &Values,
        host: &mut dyn Host,
    ) -> Theorems {
        let setting = (task, hold);
        let rejected = rejected_rows(task);
        let core_of_accepted = self.core_of_accepted(model, setting, &(&rejected | known));
        let found = self.theorems_of(model, setting, &core_of_accepted, values, host);
        // a part of a rule that depends on others at a generic point may be what makes one of these superfluous
        let whole = self.wholly_rejected(&rejected);
        let with_parts = (whole.len() < rejected.len()).then(|| {
            let core = core(self, model, setting, &(&whole | known));
            self.theorems_of(model, setting, &core, values, host)
        });
        let count = |found: &Option<Theorems>| found.as_ref().map(|found| found.rules.len());
        let found = with_parts.filter(|more| count(more) > count(&found)).unwrap_or(found);
        if found.is_some() || rejected.is_empty() {
            return found.unwrap_or_default();
        }
        // what depends on others at a generic point may say here what these do not say
        let core = core(self, model, setting, known);
        self.theorems_of(model, setting, &core, values, host).unwrap_or_default()
    }

    /// Returns the rows that may depend on others at some state, but for those that are left out: all that are rejected
    /// at least. While nothing is edited they are found once for all components that are alike.
    fn core_of_accepted<'t>(
        &self,
        model: Model<'_>,
        (task, hold): (&'t Task, Hold),
        left_out: &BTreeSet<(u32, u32)>,
    ) -> Cow<'t, [(u32, u32)]> {
        let find = || core(self, model, (task, hold), left_out);
        let is_resting = std::ptr::fn_addr_eq(hold, Self::resting_hold as Hold);
        if is_resting { task.core(find) } else { find().into() }
    }

    /// Returns of the rows that are rejected those of rules that are so as a whole.
    fn wholly_rejected(&self, rejected: &BTreeSet<(u32, u32)>) -> BTreeSet<(u32, u32)> {
        let is_whole = |&&(rule, _): &&(u32, u32)| self.is_surplus(rule, rejected);
        rejected.iter().filter(is_whole).copied().collect()
    }

    /// Returns true if all rows of a rule are among these.
    fn is_surplus(&self, rule: u32, rows: &BTreeSet<(u32, u32)>) -> bool {
        match &self.rules.get(rule).shape.body {
            Body::Equations(equations) => {
                rows.range((rule, 0)..=(rule, u32::MAX)).count() == equations.len()
            }
            _ => true,
        }
    }

    /// The same of some rows; nothing where no solution of the others is found elsewhere.
    fn theorems_of(
        &mut self,
        model: Model<'_>,
        (task, hold): (&Task, Hold),
        core: &[(u32, u32)],
        values: &Values,
        host: &mut dyn Host,
    ) -> Option<Theorems> {
        let setting = (task, hold);
        let mut rules = candidates(self, model, setting, core, values, host);
        if rules.is_empty() {
            return Some(Theorems { rules, is_independent: true });
        }
        let is_left =
            |r: &u32| self.rules.get(*r).shape.level == Level::Required && !rules.contains_key(r);
        let rest: Vec<u32> = task.component.rules().iter().copied().filter(is_left).collect();
        let holding = |s| hold(model.structure, s);
        let slots = task.component.slots();
        let mut start = perturbed(model, slots, values);
        for &s in slots.iter().filter(|&&s| holding(s) == Holding::Fixed) {
            start.numbers[s] = values.numbers[s];
        }
        let mut holds_elsewhere = |holding: &dyn Fn(SlotId) -> Holding| {
            let setup = Setup { model, holding, aim: &Aim::default() };
            let mut elsewhere = start.clone();
            let trial = self.try_rules(&setup, &rest, &mut elsewhere, host);
            let holds = |&rule: &u32| self.unmet(model, [rule], &elsewhere, host).is_empty();
            (trial == Trial::Holds)
                .then(|| rules.keys().copied().filter(holds).collect::<BTreeSet<u32>>())
        };
        let mut found = holds_elsewhere(&holding);
        let is_short = found.as_ref().is_none_or(|found| found.len() < rules.len());
        if is_short && slots.len() <= MOST_ASKED {
            // places that stay may leave the others nothing but to come together
            let free = |s| match holding(s) {
                Holding::Kept | Holding::Alone => Holding::Free,
                held @ (Holding::Fixed | Holding::Given(_) | Holding::Free) => held,
            };
            let more = holds_elsewhere(&free);
            let count = |found: &Option<BTreeSet<u32>>| found.as_ref().map(BTreeSet::len);
            if count(&more) > count(&found) {
                found = more;
            }
        }
        let found = found?;
        rules.retain(|rule, _| found.contains(rule));
        Some(Theorems { rules, is_independent: false })
    }

    /// Returns rules that imply another by a theorem, and none that could be spared: those of its circuit if they do
    /// elsewhere too; else of all that are not theorems themselves.
    fn implying(
        &mut self,
        model: Model<'_>,
        task: &Task,
        (rule, circuit): (u32, BTreeSet<u32>),
        theorems: &BTreeSet<u32>,
        values: &Values,
        host: &mut dyn Host,
    ) -> BTreeSet<u32> {
        let may_imply =
            |&r: &u32| !theorems.contains(&r) && self.rules.get(r).shape.level == Level::Required;
        let mut left: Vec<u32> = task.component.rules().iter().copied().filter(may_imply).collect();
        let holding = |s| Self::resting_hold(model.structure, s);
        let setup = Setup { model, holding: &holding, aim: &Aim::default() };
        let mut imply = |rules: &[u32]| {
            let mut elsewhere = perturbed(model, task.component.slots(), values);
            self.try_rules(&setup, rules, &mut elsewhere, host) == Trial::Holds
                && self.unmet(model, [rule], &elsewhere, host).is_empty()
        };
        let own: Vec<u32> = circuit.iter().copied().filter(|&r| r != rule).collect();
        if imply(&own) {
            return circuit;
        }
        for r in left.clone().into_iter().rev() {
            let without: Vec<u32> = left.iter().copied().filter(|&q| q != r).collect();
            if imply(&without) {
                left = without;
            }
        }
        left.into_iter().collect()
    }

    /// Returns a task with the rules left to the test that others imply by a theorem, wherever these hold, if some do:
    /// nobody yields for such a rule. Of a small component, found once for all that are alike in a `state` that holds.
    pub(crate) fn without_theorems(
        &mut self,
        model: Model<'_>,
        task: &Task,
        state: &Values,
        host: &mut dyn Host,
    ) -> Option<Task> {
        let has_one_form = match &task.course {
            Course::Plan => true,
            Course::Modes(modes, _) => modes.has_inequalities_alone(),
            Course::Search(_) => false,
        };
        // where a given number would yield, it is worth more to know
        let most = if task.plan.report.yielded.is_empty() { MOST_ASKED } else { MOST_WITH_GIVEN };
        if task.component.slots().len() > most || !has_one_form {
            return None;
        }
        if let Some(known) = task.known_without_implied() {
            return known;
        }
        if !self.required_hold(model, task, state, host) {
            return None;
        }
        let in_mode = task.by_values(self, model, state, host);
        let find = |planner: &mut Self| {
            let task = in_mode.as_ref().unwrap_or(task);
            let found = planner.theorems(model, task, Self::resting_hold, state, host);
            found.rules.into_keys().collect()
        };
        let implied = self.soon(find);
        task.knowing_implied(&implied, &self.plans)
    }

    /// Returns a task with the rules left to the test that others imply by a theorem in a state, if some do. To the
    /// plan they say something, and may hold what they do not hold.
    pub(crate) fn without_implied(
        &mut self,
        model: Model<'_>,
        task: &Task,
        state: &Values,
        host: &mut dyn Host,
    ) -> Option<Task> {
        let implied = self.soon(|planner| planner.implied_rules(model, task, state, host));
        task.with_tested(&implied, &self.plans)
    }

    /// Does what has to be done soon, unless what may be spent is bounded already.
    fn soon<T>(&mut self, act: impl FnOnce(&mut Self) -> T) -> T {
        let has_bound = self.left().is_some();
        if !has_bound {
            self.try_until(Some(self.spent() + PATIENCE));
        }
        let done = act(self);
        if !has_bound {
            self.try_until(None);
        }
        done
    }

    /// Returns true if what is required in a component holds.
    fn required_hold(
        &self,
        model: Model<'_>,
        task: &Task,
        values: &Values,
        host: &mut dyn Host,
    ) -> bool {
        let required = |&r: &u32| self.rules.get(r).shape.level == Level::Required;
        let required = task.component.rules().iter().copied().filter(required);
        self.unmet(model, required, values, host).is_empty()
    }

    /// Returns the rules of a component that follow from the others by a theorem, in a state in which all that is
    /// required holds; nothing in any other.
    fn implied_rules(
        &mut self,
        model: Model<'_>,
        task: &Task,
        values: &Values,
        host: &mut dyn Host,
    ) -> BTreeSet<u32> {
        if !self.required_hold(model, task, values, host) {
            return BTreeSet::new();
        }
        let in_mode = task.by_values(self, model, values, host);
        let task = in_mode.as_ref().unwrap_or(task);
        let theorems = self.theorems(model, task, Self::resting_hold, values, host);
        let mut implied: BTreeSet<u32> = theorems.rules.into_keys().collect();
        if may_follow_from_given(model, task) {
            implied.extend(self.theorems(model, task, hold_given, values, host).rules.into_keys());
        }
        implied
    }
}

/// Holds given numbers as they are.
fn hold_given(structure: &Structure, slot: SlotId) -> Holding {
    match Planner::resting_hold(structure, slot) {
        Holding::Given(_) => Holding::Fixed,
        other => other,
    }
}

/// Returns true for a component of few slots in which a given number stands and none yields.
fn may_follow_from_given(model: Model<'_>, task: &Task) -> bool {
    let slots = task.component.slots();
    let is_given =
        |&s: &SlotId| matches!(Planner::resting_hold(model.structure, s), Holding::Given(_));
    slots.len() <= MOST_WITH_GIVEN
        && task.plan.report.yielded.is_empty()
        && slots.iter().any(is_given)
}

/// Rules that follow from others by a theorem.
#[derive(Default)]
struct Theorems {
    rules: BTreeMap<u32, Candidate>,
    /// True if no row depends on others at the present state: there are none, and no other would be one.
    is_independent: bool,
}

/// Returns the required constraints all of whose rows depend on others everywhere.
fn surplus(planner: &Planner, task: &Task) -> Vec<Redundant> {
    let mut rejected: BTreeMap<u32, (usize, BTreeSet<Source>)> = BTreeMap::new();
    for r in &task.plan.report.rejected {
        let (rows, circuit) = rejected.entry(r.relation).or_default();
        *rows += 1;
        circuit.extend(r.circuit.iter().map(|c| task.source(&planner.rules, c.0)));
    }
    let one = |(r, (n, circuit)): (u32, (usize, BTreeSet<Source>))| {
        let relation = &task.system.relations[r as usize];
        let rows = match &relation.body {
            solve::RelationBody::Equations(span) => span.len as usize,
            solve::RelationBody::Opaque { .. } => 1,
        };
        let source = task.source(&planner.rules, r);
        (relation.level == Level::Required && rows == n).then(|| Redundant {
            source,
            kind: RedundantKind::Form,
            implied_by: circuit.into_iter().filter(|s| *s != source).collect(),
        })
    };
    rejected.into_iter().filter_map(one).collect()
}
