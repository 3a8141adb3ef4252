//! Explanations: the latest plan and the reasons for a value, as data.

use crate::edit::Conflict;
use crate::modal::Acting;
use crate::planner::{Model, Planner};
use crate::rule::{Body, Condition, Source};
use crate::task::{Course, Holding, Task};
use kernel::{SlotId, Values};
use solve::{
    COUNTING, Count, Level, Proofs, Rejected, RelationBody, Standing, Step, StepKind, System,
};
use std::collections::{BTreeMap, BTreeSet};

/// One step of a plan, in the document's terms.
#[derive(Clone, PartialEq, Debug)]
pub struct ExplainedStep {
    /// How the targets are computed.
    pub kind: ExplainedKind,
    /// The slots that it computes.
    pub targets: Vec<SlotId>,
    /// The slots that it reads.
    pub reads: Vec<SlotId>,
    /// The constraints, stays and wishes that hold by it.
    pub sources: Vec<Source>,
    /// Where an inequality that holds by it is at its bound, what would go beyond: of that the strongest.
    pub beyond: Vec<Source>,
}

/// How a step computes its targets.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ExplainedKind {
    /// A part takes the value of another that equals it.
    Alias,
    /// A part takes a number.
    Number,
    /// A written method.
    Method {
        /// Which one, counted from 0.
        index: u32,
        /// How many were written.
        of: u32,
    },
    /// An equation solved for one unknown by formula.
    Isolated {
        /// How many solutions the formula has.
        roots: u32,
    },
    /// Linear equations solved together.
    Linear {
        /// How many unknowns.
        unknowns: u32,
    },
    /// Two equations solved together by formula, as where two circles meet.
    Closed,
    /// Equations solved together by Newton's method.
    Newton {
        /// How many unknowns.
        unknowns: u32,
    },
    /// Fewer equations than unknowns: the least change that makes them hold.
    LeastChange {
        /// How many unknowns.
        unknowns: u32,
        /// Whether the equations are curved; what linear ones allow is found without fail.
        curved: bool,
    },
    /// Wishes that cannot all be had, met as nearly as they can be.
    Compromise {
        /// How many unknowns.
        unknowns: u32,
        /// Whether the equations are curved.
        curved: bool,
    },
    /// Whole numbers, searched.
    Search {
        /// How many unknowns.
        unknowns: u32,
    },
}

/// The heaviest kind of step in a plan.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum PlanKind {
    /// Every step computes its targets by a formula or a method.
    OnePass,
    /// Equations are solved together.
    Block,
    /// The answer is approached: least change or compromise.
    Relaxation,
    /// Whole numbers are searched.
    Search,
}

/// Why a slot has its value.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Why {
    /// The steps that lead to it, in order.
    pub steps: Vec<ExplainedStep>,
    /// Where they begin.
    pub roots: Vec<Root>,
}

/// Solutions that are not counted: a whole number stands among real unknowns.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Uncountable {
    /// The whole number.
    pub slot: SlotId,
}

/// A value that nothing else explains.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Root {
    /// The slot.
    pub slot: SlotId,
    /// What holds it there.
    pub kind: RootKind,
}

/// What holds a value that nothing else explains.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum RootKind {
    /// An anchor.
    Anchored,
    /// It is written in the text.
    Given,
    /// It was there before.
    Kept,
    /// The latest edit wanted it.
    Edited,
}

impl Planner {
    /// Returns the steps of the latest edit, in order: those downstream of it. All, after opening.
    pub fn explain(&self) -> Vec<ExplainedStep> {
        let mut explained = Vec::new();
        for task in &self.latest.tasks {
            explained.extend(self.search_in_words(task));
            explained.extend(self.ran(task).filter_map(|step| self.in_words(task, step)));
        }
        explained
    }

    /// Returns for each of some slots that the latest edit computed the constraints that hold by the step which did,
    /// those included that make it equal to what another step computed; of what no step did, as of what was looked for,
    /// those that speak of it.
    ///
    /// Cost: linear in the steps of the components that have one of them.
    pub fn behind(&self, slots: &BTreeSet<SlotId>) -> BTreeMap<SlotId, BTreeSet<Source>> {
        let mut behind: BTreeMap<SlotId, BTreeSet<Source>> = BTreeMap::new();
        let has = |task: &&Task| task.component.slots().iter().any(|slot| slots.contains(slot));
        for task in self.latest.tasks.iter().filter(has) {
            for step in task.plan.steps() {
                let targets = step.targets.iter();
                let relations = step.relations.iter();
                let mut sources: BTreeSet<Source> =
                    relations.map(|&r| task.source(&self.rules, r)).collect();
                let slot_of = |l: &u32| task.component.slots().get(*l as usize).copied();
                if matches!(step.kind, StepKind::Alias) {
                    let read = step.reads.iter().filter_map(slot_of);
                    sources.extend(read.filter_map(|s| behind.get(&s)).flatten());
                }
                for slot in targets.filter_map(slot_of) {
                    behind.entry(slot).or_default().extend(&sources);
                }
            }
            let is_told = |slot: &SlotId| behind.contains_key(slot) || !slots.contains(slot);
            let untold: BTreeSet<SlotId> =
                task.component.slots().iter().copied().filter(|slot| !is_told(slot)).collect();
            for (relation, r) in task.system.relations.iter().zip(0..) {
                let source = task.source(&self.rules, r);
                let arguments = task.system.equations_of(relation).iter();
                let arguments = arguments.flat_map(|e| task.system.arguments(e.arguments));
                let named = match &relation.body {
                    RelationBody::Opaque { slots } => &**slots,
                    RelationBody::Equations(_) => &[],
                };
                let named = arguments.chain(named).filter_map(|&l| {
                    task.component.slots().get(l as usize).filter(|slot| untold.contains(slot))
                });
                for &slot in named {
                    behind.entry(slot).or_default().insert(source);
                }
            }
        }
        behind.retain(|slot, _| slots.contains(slot));
        behind
    }

    /// Returns what acts in the modes of the latest edit: inequalities at their bounds, conditions,
    /// alternatives.
    pub fn acting(&self) -> Vec<Acting> {
        self.latest.tasks.iter().flat_map(|t| t.acting(self)).collect()
    }

    /// Counts the solutions of what is searched, with nothing edited and given numbers held, until there are
    /// `enough` or it is too hard; nothing where nothing is searched.
    ///
    /// # Errors
    /// If whole numbers stand among real unknowns: these are not counted.
    pub fn solutions(
        &mut self,
        model: Model<'_>,
        values: &Values,
        enough: u64,
    ) -> Result<Option<Count>, Uncountable> {
        self.plan_resting(model.structure);
        let mut left = COUNTING;
        let mut all: Option<Count> = None;
        let mut among_reals = None;
        for task in self.resting() {
            let numbers = task.gather(&values.numbers);
            let one = match (&task.course, task.whole()) {
                (Course::Search(puzzle), _) => puzzle.count(&numbers, enough, &mut left),
                (_, None) => continue,
                (_, Some(whole)) => {
                    let Some(puzzle) = whole.puzzle(self.plans.patterns()) else {
                        let slot = whole.slots().next().map(|s| task.component.slots()[s as usize]);
                        among_reals = among_reals.or(slot);
                        continue;
                    };
                    puzzle.count(&numbers, enough, &mut left)
                }
            };
            all = Some(all.map_or(one, |all| all.and(one)));
        }
        // what no rule speaks of may be any of its numbers
        let spoken: BTreeSet<SlotId> =
            self.resting().iter().flat_map(|t| t.component.slots().iter().copied()).collect();
        let is_free =
            |slot: &SlotId| !spoken.contains(slot) && model.structure.given(*slot).is_none();
        let free = model.structure.ranges.iter().filter(|(slot, _)| is_free(slot));
        let ways = free.map(|(_, (low, high))| u64::try_from(high - low + 1).unwrap_or(0));
        if let Some(count) = &mut all {
            count.solutions = ways.fold(count.solutions, u64::saturating_mul);
        }
        match (all, among_reals) {
            (None, Some(slot)) => Err(Uncountable { slot }),
            (all, _) => Ok(all),
        }
    }

    /// Returns the heaviest kind of step of the latest edit; nothing to do is one pass.
    pub fn latest_kind(&self) -> PlanKind {
        let steps = self.explain();
        steps.iter().map(|s| s.kind.plan_kind()).max().unwrap_or(PlanKind::OnePass)
    }

    /// Returns the steps that lead to a slot's value, and where they begin.
    ///
    /// The plan of the latest edit is asked where it computed the slot, else that of the document at
    /// rest, which [`Planner::status`] makes. There a given number needs no other reason, but for those that
    /// gave way to constraints: they have other values than they are given.
    pub fn why(&self, model: Model<'_>, slot: SlotId, gave_way: &BTreeSet<SlotId>) -> Why {
        let computes = |t: &&Task| {
            let is_searched =
                |s| matches!(t.course, Course::Search(_)) || t.looked_for().contains(&s);
            local(t, slot).is_some_and(|s| is_searched(s) || producer(t, s).is_some())
        };
        let latest = self.latest.tasks.iter().find(computes);
        let is_edited = latest.is_some() && self.latest.edited.is_some();
        let is_as_given = |s: SlotId| {
            let is_given = matches!(Self::resting_hold(model.structure, s), Holding::Given(_));
            is_given && !is_edited && !gave_way.contains(&s)
        };
        let task = latest.or_else(|| self.resting().iter().find(|t| local(t, slot).is_some()));
        let Some(task) = task.filter(|_| !is_as_given(slot)) else {
            return Why { steps: Vec::new(), roots: vec![self.root(model, slot)] };
        };
        let search = self.search_in_words(task);
        if let (Course::Search(_), Some(search)) = (&task.course, &search) {
            let search = search.clone();
            let roots = search.reads.iter().map(|&slot| self.root(model, slot)).collect();
            return Why { steps: vec![search], roots };
        }
        let mut wanted: BTreeSet<u32> = local(task, slot).into_iter().collect();
        let mut begins: BTreeSet<u32> = BTreeSet::new();
        let mut steps = Vec::new();
        let stays = |local: &u32| {
            task.component.slots().get(*local as usize).is_some_and(|&s| is_as_given(s))
        };
        let all = task.plan.steps();
        let mut leads: Vec<bool> = vec![false; all.len()];
        let mut grows = true;
        // what decides a condition may be computed after what that decides
        while std::mem::take(&mut grows) {
            for (step, leads) in all.iter().zip(&mut leads).rev() {
                if *leads || !step.targets.iter().any(|t| wanted.contains(t)) {
                    continue;
                }
                (*leads, grows) = (true, true);
                let read: Vec<u32> =
                    step.reads.iter().copied().chain(decided_by(task, step)).collect();
                begins.extend(step.targets.iter().chain(&read).filter(|&l| stays(l)));
                wanted.extend(read.iter().filter(|&l| !stays(l)));
            }
        }
        for (step, _) in all.iter().zip(&leads).rev().filter(|(_, leads)| **leads) {
            step.targets.iter().for_each(|t| {
                wanted.remove(t);
            });
            steps.extend(self.in_words(task, step));
        }
        if let Some(search) =
            search.filter(|_| task.looked_for().iter().any(|s| wanted.contains(s)))
        {
            task.looked_for().iter().for_each(|s| {
                wanted.remove(s);
            });
            steps.push(search);
        }
        steps.reverse();
        begins.extend(wanted);
        let slots = task.component.slots();
        let begins = begins.into_iter().filter_map(|local| slots.get(local as usize));
        let roots = begins.map(|&slot| self.root(model, slot)).collect();
        Why { steps, roots }
    }

    /// Returns what stands against a slot's moving: the rules that its own wish would depend on.
    ///
    /// Empty where the slot can move, where it is a text, or where an anchor holds it.
    pub fn why_not(&mut self, model: Model<'_>, slot: SlotId) -> Vec<Conflict> {
        let tasks = self.wishing(model, slot);
        self.against_wish(&tasks)
    }

    /// Plans that a slot moves, where it is a number.
    pub(crate) fn wishing(&mut self, model: Model<'_>, slot: SlotId) -> Vec<Task> {
        if !model.structure.slots[slot].primitive.is_number() {
            return Vec::new();
        }
        let aim = self.aim_at(slot);
        self.plan_edit(model, &aim)
    }

    /// Returns what stands against the one wish of these tasks.
    pub(crate) fn against_wish(&self, tasks: &[Task]) -> Vec<Conflict> {
        let is_wish =
            |task: &Task, r: &Rejected| task.source(&self.rules, r.relation) == Source::Wish(0);
        tasks.iter().flat_map(|task| self.conflicts(task, |r| is_wish(task, r))).collect()
    }

    /// Returns what a rule only reads: the slots that no method of its computes, where it is no equation that
    /// could be solved for them.
    pub fn only_read(&self, source: Source) -> BTreeSet<SlotId> {
        let of_source = self.rules.iter().filter(|r| r.source == source);
        let opaque = of_source.filter(|r| matches!(r.shape.body, Body::Opaque(_)));
        let read = opaque.flat_map(|rule| {
            let targets = rule.shape.methods.iter().flat_map(|m| rule.slots_at(&m.targets));
            let computed: BTreeSet<SlotId> = targets.collect();
            rule.slots.iter().copied().filter(move |s| !computed.contains(s))
        });
        read.collect()
    }

    /// Returns what some rejected rows of a task conflict with: the accepted rows and the equalities
    /// that they depend on.
    pub(crate) fn conflicts(
        &self,
        task: &Task,
        is_meant: impl Fn(&Rejected) -> bool,
    ) -> Vec<Conflict> {
        let mut proofs = None;
        let mut conflicts: Vec<Conflict> = Vec::new();
        for rejected in task.plan.report.rejected.iter().filter(|r| is_meant(r)) {
            let mut rows = rejected.circuit.clone();
            rows.push((rejected.relation, rejected.row));
            let proofs =
                proofs.get_or_insert_with(|| Proofs::new(&task.system, self.plans.patterns()));
            let equalities = proofs.connecting(&rows);
            let circuit = rejected.circuit.iter().chain(&equalities);
            let circuit: BTreeSet<Source> =
                circuit.map(|c| task.source(&self.rules, c.0)).collect();
            let source = task.source(&self.rules, rejected.relation);
            let circuit = circuit.into_iter().filter(|s| *s != source).collect();
            let conflict = Conflict { source, circuit };
            if !conflicts.contains(&conflict) {
                conflicts.push(conflict);
            }
        }
        conflicts
    }

    fn root(&self, model: Model<'_>, slot: SlotId) -> Root {
        let edited = self.latest.edited.as_ref().is_some_and(|e| e.contains(&slot));
        let kind = match Self::resting_hold(model.structure, slot) {
            _ if edited => RootKind::Edited,
            Holding::Fixed => RootKind::Anchored,
            Holding::Given(_) => RootKind::Given,
            Holding::Kept | Holding::Alone | Holding::Free => {
                if model.structure.slots[slot].given.is_some() {
                    RootKind::Given
                } else {
                    RootKind::Kept
                }
            }
        };
        Root { slot, kind }
    }

    /// Returns the steps of a task that the latest edit ran.
    fn ran<'t>(&self, task: &'t Task) -> impl Iterator<Item = &'t Step> + use<'t> {
        let everything = self.latest.edited.is_none();
        let mut touched: BTreeSet<u32> = task.targets().iter().map(|t| t.0).collect();
        for &slot in self.latest.edited.iter().flatten() {
            touched.extend(local(task, slot));
        }
        touched.extend(task.looked_for());
        task.plan.steps().iter().filter(move |step| {
            let mut reads = step.reads.iter().copied().chain(decided_by(task, step));
            let runs = everything || reads.any(|r| touched.contains(&r));
            if runs {
                touched.extend(&step.targets);
            }
            runs
        })
    }

    /// Returns the step of a task in which whole numbers are searched, alone or among real unknowns.
    fn search_in_words(&self, task: &Task) -> Option<ExplainedStep> {
        let looked_for = task.looked_for();
        let is_searched = match task.course {
            Course::Search(_) => true,
            Course::Plan | Course::Modes(..) => !looked_for.is_empty(),
        };
        if !is_searched {
            return None;
        }
        let is_fixed = |i: usize| task.system.slots[i].stay == solve::Stay::Fixed;
        let is_target = |i: usize| match task.course {
            Course::Search(_) => !is_fixed(i),
            Course::Plan | Course::Modes(..) => looked_for.contains(&(i as u32)),
        };
        let slots = task.component.slots().iter().enumerate();
        let slots = slots.filter(|(i, _)| is_target(*i) || is_fixed(*i));
        let (targets, reads): (Vec<_>, Vec<_>) = slots.partition(|(i, _)| is_target(*i));
        let of = |all: Vec<(usize, &SlotId)>| all.into_iter().map(|(_, &s)| s).collect();
        let relations = 0..task.system.relations.len() as u32;
        let mut sources: Vec<Source> = relations.map(|r| task.source(&self.rules, r)).collect();
        sources.dedup();
        let unknowns = targets.len() as u32;
        let kind = ExplainedKind::Search { unknowns };
        let (targets, reads) = (of(targets), of(reads));
        Some(ExplainedStep { kind, targets, reads, sources, beyond: Vec::new() })
    }

    /// Returns what a step computes from what; nothing for one that computes only what stands beside a rule, which
    /// others read from where it does.
    fn in_words(&self, task: &Task, step: &Step) -> Option<ExplainedStep> {
        let known = |slots: &[u32]| -> Vec<SlotId> {
            slots.iter().filter_map(|&i| task.component.slots().get(i as usize).copied()).collect()
        };
        let targets = known(&step.targets);
        if targets.is_empty() {
            return None;
        }
        let read: BTreeSet<u32> = decided_by(task, step).into_iter().collect();
        let read: Vec<u32> = step.reads.iter().copied().chain(read).collect();
        let mut reads = known(&read);
        for (_, number) in task.computed().filter(|(slot, _)| read.contains(slot)) {
            let rule = self.rules.get(number.rule);
            let condition = number.when.map(|at| &rule.shape.when[at as usize].condition);
            match (condition, &rule.shape.body) {
                (Some(Condition::Host(by)), _) => reads.extend(rule.slots_at(&by.reads)),
                (None, Body::Beside(beside)) => reads.extend(rule.slots_at(&beside.reads)),
                _ => {}
            }
        }
        let mut met = BTreeSet::new();
        reads.retain(|&slot| met.insert(slot));
        let mut sources: Vec<Source> = Vec::new();
        for &relation in &step.relations {
            let source = task.source(&self.rules, relation);
            if !sources.contains(&source) {
                sources.push(source);
            }
        }
        let beyond = self.beyond(task, step);
        Some(ExplainedStep { kind: kind(&task.system, step), targets, reads, sources, beyond })
    }

    /// Returns what an inequality stands against that a step holds at its bound: the strongest of the rules that it
    /// and others leave no room for.
    fn beyond(&self, task: &Task, step: &Step) -> Vec<Source> {
        let Course::Modes(modes, mode) = &task.course else { return Vec::new() };
        let at_bound = |standing: Standing| match standing {
            Standing::AtBound { relation } if step.relations.contains(&relation) => {
                Some(task.source(&self.rules, relation))
            }
            Standing::AtBound { .. } | Standing::Assumed { .. } | Standing::Taken { .. } => None,
        };
        let bounds: Vec<Source> = modes.standings(mode).into_iter().filter_map(at_bound).collect();
        if bounds.is_empty() {
            return Vec::new();
        }
        let level = |r: &Rejected| task.system.relations[r.relation as usize].level;
        let levels: BTreeSet<Level> = task.plan.report.rejected.iter().map(level).collect();
        let of_level = |at: Level| -> Vec<Source> {
            let against = self.conflicts(task, |r| level(r) == at).into_iter();
            let against = against.filter(|c| c.circuit.iter().any(|s| bounds.contains(s)));
            against.map(|c| c.source).collect()
        };
        levels.into_iter().map(of_level).find(|found| !found.is_empty()).unwrap_or_default()
    }
}

impl ExplainedKind {
    /// Returns what kind of plan a plan is at least that has such a step.
    pub fn plan_kind(self) -> PlanKind {
        match self {
            Self::Alias | Self::Number | Self::Method { .. } | Self::Isolated { .. } => {
                PlanKind::OnePass
            }
            Self::Linear { unknowns } | Self::Newton { unknowns } => {
                if unknowns > 1 {
                    PlanKind::Block
                } else {
                    PlanKind::OnePass
                }
            }
            Self::Closed => PlanKind::Block,
            Self::LeastChange { .. } | Self::Compromise { .. } => PlanKind::Relaxation,
            Self::Search { .. } => PlanKind::Search,
        }
    }
    /// Returns true if a step goes towards its answer by steps of its own, without a proof that they converge:
    /// 1979's relaxation. Those of one unknown, of linear equations and of formulas have one.
    pub fn is_approached(self) -> bool {
        match self {
            Self::Alias
            | Self::Number
            | Self::Method { .. }
            | Self::Isolated { .. }
            | Self::Linear { .. }
            | Self::Closed
            | Self::Search { .. } => false,
            Self::Newton { unknowns } => unknowns > 1,
            Self::LeastChange { unknowns, curved } | Self::Compromise { unknowns, curved } => {
                curved && unknowns > 1
            }
        }
    }
}

fn kind(system: &System, step: &Step) -> ExplainedKind {
    let unknowns = step.targets.len() as u32;
    match step.kind {
        StepKind::Alias if step.reads.is_empty() => ExplainedKind::Number,
        StepKind::Alias => ExplainedKind::Alias,
        StepKind::Method { relation, method } | StepKind::Opaque { relation, method } => {
            let of = system.relations[relation as usize].methods.len() as u32;
            ExplainedKind::Method { index: method, of }
        }
        StepKind::Inverse { roots } => ExplainedKind::Isolated { roots },
        StepKind::Linear => ExplainedKind::Linear { unknowns },
        StepKind::Closed => ExplainedKind::Closed,
        StepKind::Newton => ExplainedKind::Newton { unknowns },
        StepKind::LeastChange => ExplainedKind::LeastChange { unknowns, curved: step.is_curved() },
        StepKind::Compromise => ExplainedKind::Compromise { unknowns, curved: step.is_curved() },
    }
}

/// Returns the slots that the conditions ask for under which the relations of a step hold.
fn decided_by(task: &Task, step: &Step) -> Vec<u32> {
    let Course::Modes(modes, _) = &task.course else { return Vec::new() };
    let relations = step.relations.iter();
    relations.flat_map(|&r| modes.conditional().conditions_of(r)).collect()
}

fn local(task: &Task, slot: SlotId) -> Option<u32> {
    task.component.slots().binary_search(&slot).ok().map(|i| i as u32)
}

fn producer(task: &Task, slot: u32) -> Option<&Step> {
    task.plan.steps().iter().find(|s| s.targets.contains(&slot))
}
