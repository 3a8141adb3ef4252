//! Deciding: from the first mode to one in which everything holds.
//!
//! In: modes and a way to try one. Out: the mode whose answer breaks nothing. Inequalities: one that
//! the answer breaks acts from then on, the first by declaration; one that would hold without acting
//! is let go. Conditions: the first that was assumed wrongly is switched. Where that comes back to
//! where it was, or where a mode contradicts itself, assumptions are gone through depth first, and a
//! set of assumptions that was seen to fail is never tried again. Where that finds nothing, or leaves a
//! wish unmet, conditions act at their bounds too (`nearest.rs`).
//!
//! **Source:** Goldfarb and Idnani (1983), for what acts; Murty, *Linear Complementarity* (1988), §4.1,
//! for the first wrong condition; Stallman and Sussman (1977), for assumptions and what is learnt from
//! their failure.

use super::{Mode, Modes};
use crate::conditional::Conditional;
use crate::outcome::{Outcome, Reason, Status};
use crate::plan::{Plan, StepKind};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// How many modes are tried before the matter is left undecided.
pub const MOST_MODES: usize = 2_000;

/// So many slots are planned in all the modes of the pieces of equations, before it is.
const MOST_OF_PIECES: usize = 200_000;
/// So many where one is known, for another that is nearer.
const MOST_OF_BETTER_PIECES: usize = 20_000;

/// What came of trying a mode.
#[derive(Clone, Debug)]
pub struct Tried {
    /// The plan of the mode's system.
    pub plan: Rc<Plan>,
    /// How it ended.
    pub outcome: Outcome,
    /// The state that it came to.
    pub values: Vec<f64>,
}

/// A mode, and how sure it is.
#[derive(Clone, Debug)]
pub struct Decision {
    /// The mode; where none was found, the first.
    pub mode: Mode,
    /// What came of trying it.
    pub tried: Rc<Tried>,
    /// How the decision ended.
    pub ended: Ended,
}

/// How a decision ended.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Ended {
    /// Nothing is broken in the mode.
    Settled,
    /// There is no such mode: these relations stand against each other.
    Contradiction(Vec<u32>),
    /// None was found among so many modes, and there may be one.
    NotDecided(usize),
}

/// How many are tried before conditions act at their bounds too.
const MOST_WITHOUT_BOUNDS: usize = 256;

/// How many are looked at in which nothing yields that does not in the first, before others are.
const MOST_SPARING: usize = 128;
/// So many more modes are tried where one is known, for another in which fewer given numbers yield.
const MOST_BETTER: usize = 64;

/// Finds the mode in which everything holds; of several, one in which few given numbers yield.
/// What changed is measured from `start`.
pub fn decide(
    modes: &Modes,
    first: &Mode,
    start: &[f64],
    attempt: &mut dyn FnMut(&Mode) -> Tried,
) -> Decision {
    decide_within(modes, first, start, attempt, MOST_MODES, false)
}

/// Finds the mode in which everything holds at a wish of a drag. What is assumed where the drag stands is kept while
/// nothing more yields in it, and what acts there is what acts, less what would hold without, where everything
/// holds so.
pub fn decide_along(
    modes: &Modes,
    standing: &Mode,
    start: &[f64],
    attempt: &mut dyn FnMut(&Mode) -> Tried,
) -> Decision {
    let first = Mode { active: BTreeSet::new(), ..standing.clone() };
    if standing.active.is_empty() {
        return decide_within(modes, &first, start, attempt, MOST_MODES, true);
    }
    let mut tried = BTreeMap::new();
    let mut once = |mode: &Mode| tried.entry(mode.clone()).or_insert_with(|| attempt(mode)).clone();
    let mut deciding = Deciding::new(modes, &mut once, MOST_MODES);
    match deciding.as_it_stands(standing, &first) {
        Some(found) => deciding.decision(found, Ended::Settled),
        None => decide_within(modes, &first, start, &mut once, MOST_MODES, true),
    }
}

/// Finds the mode in which everything holds, among fewer where the system is large.
pub fn decide_pieces(
    modes: &Modes,
    first: &Mode,
    start: &[f64],
    attempt: &mut dyn FnMut(&Mode) -> Tried,
) -> Decision {
    let most = MOST_OF_PIECES / modes.conditional.system.slots.len().max(1);
    decide_within(modes, first, start, attempt, most.clamp(8, MOST_MODES), false)
}

/// Finds the nearest mode in which everything holds among a few, where the state has come to other pieces of
/// equations than it began on.
pub fn decide_nearest_pieces(
    modes: &Modes,
    first: &Mode,
    start: &[f64],
    attempt: &mut dyn FnMut(&Mode) -> Tried,
) -> Decision {
    let most = MOST_OF_BETTER_PIECES / modes.conditional.system.slots.len().max(1);
    Deciding::new(modes, attempt, most.clamp(8, MOST_BETTER)).nearest_of(first, start)
}

fn decide_within(
    modes: &Modes,
    first: &Mode,
    start: &[f64],
    attempt: &mut dyn FnMut(&Mode) -> Tried,
    most: usize,
    is_along: bool,
) -> Decision {
    let has_bounds = modes.bounds.iter().any(Option::is_some);
    let without_bounds = if has_bounds { most.min(MOST_WITHOUT_BOUNDS) } else { most };
    let mut deciding = Deciding::new(modes, attempt, without_bounds);
    let decided = deciding.sparing(first, start, is_along);
    let is_cut = has_bounds && matches!(decided.ended, Ended::NotDecided(_));
    let nearest = deciding.nearest(first, start, decided);
    if !is_cut || nearest.ended == Ended::Settled {
        return nearest;
    }
    (deciding.most, deciding.at_bounds) = (most, false);
    deciding.sparing(first, start, is_along)
}

/// Which given numbers may yield in the modes that are looked for.
#[derive(Debug)]
pub(super) enum Yielding {
    Any,
    /// Those that do in the first mode.
    Known(BTreeSet<u32>),
    /// Fewer than so many.
    Fewer([usize; 2]),
}

pub(super) struct Deciding<'a> {
    pub(super) modes: &'a Modes,
    attempt: &'a mut dyn FnMut(&Mode) -> Tried,
    /// How many modes are tried.
    pub(super) most: usize,
    /// True once a try has spent what may be spent: nothing else is tried.
    is_spent: bool,
    pub(super) tried: BTreeMap<Mode, Rc<Tried>>,
    /// Relations that took part in failures.
    blamed: BTreeSet<u32>,
    /// A mode in which every condition that is assumed wrongly is at its bound.
    edge: Option<Mode>,
    pub(super) yielding: Yielding,
    /// True where conditions act at their bounds.
    pub(super) at_bounds: bool,
    /// True where no other alternative is taken.
    pub(super) keeps_taken: bool,
    /// True if something fails whatever is assumed.
    pub(super) is_hopeless: bool,
}

/// What came of one set of assumptions.
enum Inner {
    Holds(Mode),
    /// These relations cannot all hold; nothing where that is not known.
    Fails(Option<BTreeSet<u32>>),
}

/// A choice of a mode: a condition or an alternative.
pub(super) type Assumption = (usize, u32);

impl<'a> Deciding<'a> {
    fn new(modes: &'a Modes, attempt: &'a mut dyn FnMut(&Mode) -> Tried, most: usize) -> Self {
        Self {
            modes,
            attempt,
            most,
            is_spent: false,
            tried: BTreeMap::new(),
            blamed: BTreeSet::new(),
            edge: None,
            yielding: Yielding::Any,
            at_bounds: false,
            keeps_taken: false,
            is_hopeless: false,
        }
    }
}

impl Deciding<'_> {
    /// Finds the mode in which everything holds as assumed, beginning with what acts where a drag stands, if no given
    /// number yields in it that does not where nothing acts.
    fn as_it_stands(&mut self, standing: &Mode, bare: &Mode) -> Option<Mode> {
        self.yields_as_in(bare);
        match self.act(standing.clone()) {
            Inner::Holds(found) if self.wrong(&found).is_empty() => Some(found),
            Inner::Holds(_) | Inner::Fails(_) => None,
        }
    }

    /// Has nothing yield that does not in this mode.
    fn yields_as_in(&mut self, mode: &Mode) {
        let yielded = self.try_mode(mode).plan.report.yielded.iter().copied().collect();
        self.yielding = Yielding::Known(yielded);
    }

    /// Finds a mode in which everything holds: one in which nothing yields that does not in the first, where
    /// there is one, else any; then others in which fewer given numbers yield, and no further.
    fn sparing(&mut self, first: &Mode, start: &[f64], is_along: bool) -> Decision {
        self.yields_as_in(first);
        let most = self.most;
        self.most = most.min(MOST_SPARING);
        let mut found = self.look(first);
        self.most = most;
        if found.ended != Ended::Settled {
            self.yielding = Yielding::Any;
            found = self.look(first);
        } else if is_along && found.mode.assumes_as(first) {
            return found;
        }
        if found.ended != Ended::Settled || first.assumed.is_empty() && first.taken.is_empty() {
            return found;
        }
        self.most = self.most.min(self.tried.len() + MOST_BETTER);
        loop {
            let yielded = found.tried.plan.yields();
            if yielded == [0; 2] {
                return found;
            }
            self.yielding = Yielding::Fewer(yielded);
            let Some(better) = self.go_through_to_less(first, start, &found.tried) else {
                return found;
            };
            found = self.decision(better, Ended::Settled);
        }
    }

    /// Goes through the assumptions for a mode in which given numbers move no further than at another try.
    fn go_through_to_less(&mut self, first: &Mode, start: &[f64], than: &Tried) -> Option<Mode> {
        let mut learnt = Vec::new();
        loop {
            let mode = self.explore(first, &mut learnt)?;
            let tried = self.try_mode(&mode);
            if self.modes.moves_no_more(&tried, than, start) {
                return Some(mode);
            }
            learnt.push(self.assumptions(&mode, None));
        }
    }

    /// Finds the mode in which everything holds, the first wrong condition switched first.
    fn look(&mut self, first: &Mode) -> Decision {
        let mut seen = BTreeSet::new();
        let mut mode = first.clone();
        while seen.insert((mode.assumed.clone(), mode.taken.clone())) {
            let Inner::Holds(found) = self.act(mode.clone()) else { break };
            let wrong = self.wrong(&found);
            let Some(&first) = wrong.first() else {
                return self.decision(found, Ended::Settled);
            };
            mode = Mode { active: BTreeSet::new(), ..found };
            mode.assumed[first] = !mode.assumed[first];
        }
        if let Some(found) = self.go_through(first).or_else(|| self.edge.take()) {
            return self.decision(found, Ended::Settled);
        }
        let ended = if self.may_try() {
            let relations = self.modes.conditional.system.relations.len() as u32;
            Ended::Contradiction(self.blamed.range(..relations).copied().collect())
        } else {
            Ended::NotDecided(self.tried.len().min(self.most))
        };
        self.decision(first.clone(), ended)
    }

    /// Returns true while more modes may be tried.
    pub(super) fn may_try(&self) -> bool {
        !self.is_spent && self.tried.len() < self.most
    }

    pub(super) fn try_mode(&mut self, mode: &Mode) -> Rc<Tried> {
        if let Some(tried) = self.tried.get(mode) {
            return tried.clone();
        }
        let tried = Rc::new((self.attempt)(mode));
        self.is_spent |= tried.outcome.status == Status::Stopped(Reason::Spent);
        self.tried.insert(mode.clone(), tried.clone());
        tried
    }

    /// Finds the inequalities that act, for the conditions and alternatives of a mode.
    fn act(&mut self, mut mode: Mode) -> Inner {
        let mut seen = BTreeSet::new();
        let mut blamed = BTreeSet::new();
        while seen.insert(mode.active.clone()) && self.may_try() {
            let tried = self.try_mode(&mode);
            if !tried.outcome.is_solved() {
                let relations = blame(&tried);
                blamed.extend(relations.iter().flatten());
                match self.let_go(&mode, &seen) {
                    Some(looser) => mode = looser,
                    None => return Inner::Fails(relations.map(|_| blamed)),
                }
                continue;
            }
            if let Some(behind) = self.behind_yielding(&tried.plan) {
                blamed.extend(behind);
                return Inner::Fails(Some(blamed));
            }
            match self.breaks(&mode, &tried.values) {
                Broken::Nothing => match self.let_go(&mode, &seen) {
                    Some(looser) => mode = looser,
                    None => return Inner::Holds(mode),
                },
                Broken::Comparison(c) => {
                    blamed.insert(self.modes.comparisons[c as usize].relation);
                    mode.active.insert(c);
                }
                Broken::Relation(relation) => {
                    blamed.insert(relation);
                    blamed.extend(self.behind(&tried.plan, &self.slots_of(relation)));
                    return Inner::Fails(Some(blamed));
                }
            }
        }
        Inner::Fails(None)
    }

    /// Returns the relations for which given numbers yield that should not.
    fn behind_yielding(&self, plan: &Plan) -> Option<BTreeSet<u32>> {
        let yielded = &plan.report.yielded;
        let too_many: Vec<u32> = match &self.yielding {
            Yielding::Any => Vec::new(),
            Yielding::Known(known) => {
                yielded.iter().copied().filter(|s| !known.contains(s)).collect()
            }
            Yielding::Fewer(count) if plan.yields() < *count => Vec::new(),
            Yielding::Fewer(_) => yielded.clone(),
        };
        (!too_many.is_empty()).then(|| self.behind(plan, &too_many))
    }

    /// Lets go of the first acting inequality that would hold if it did not act.
    fn let_go(&mut self, mode: &Mode, seen: &BTreeSet<BTreeSet<u32>>) -> Option<Mode> {
        for &c in &mode.active {
            let mut looser = mode.clone();
            looser.active.remove(&c);
            if seen.contains(&looser.active) {
                continue;
            }
            let tried = self.try_mode(&looser);
            if tried.outcome.is_solved() && self.modes.comparison_holds(c, &tried.values) {
                return Some(looser);
            }
        }
        None
    }

    /// Returns the first thing that a state breaks.
    fn breaks(&self, mode: &Mode, values: &[f64]) -> Broken {
        for want in self.modes.wants_in(mode) {
            if self.modes.tree_holds(&want.tree, values) {
                continue;
            }
            match self.modes.breaks_in(&want.tree, mode, values) {
                Some(c) => return Broken::Comparison(c),
                None if self.modes.is_required(want.relation) => {
                    return Broken::Relation(want.relation);
                }
                None => {}
            }
        }
        let bound = self.at_bounds.then(|| self.modes.bound_to_act(mode, values)).flatten();
        bound.map_or(Broken::Nothing, Broken::Comparison)
    }

    /// Returns the conditions that are not as assumed.
    fn wrong(&mut self, mode: &Mode) -> Vec<usize> {
        let tried = self.try_mode(mode);
        let is_wrong = |&c: &usize| self.modes.is_true(c, &tried.values) != mode.assumed[c];
        let wrong: Vec<usize> = (0..mode.assumed.len()).filter(is_wrong).collect();
        let on_edge = |&c: &usize| self.modes.is_on_edge(c, &tried.values);
        if self.edge.is_none() && wrong.iter().all(on_edge) {
            self.edge = Some(mode.clone());
        }
        wrong
    }

    /// Goes through the assumptions depth first, learning from every failure.
    fn go_through(&mut self, first: &Mode) -> Option<Mode> {
        let mut learnt = Vec::new();
        let found = self.explore(first, &mut learnt);
        self.is_hopeless = learnt.iter().any(Vec::is_empty);
        found
    }

    /// Returns the next mode in which everything holds, but for what is known to fail.
    pub(super) fn explore(
        &mut self,
        first: &Mode,
        learnt: &mut Vec<Vec<Assumption>>,
    ) -> Option<Mode> {
        while self.may_try() {
            let mode = self.next(first, learnt)?;
            let relevant = match self.act(mode.clone()) {
                Inner::Holds(found) => {
                    let wrong = self.wrong(&found);
                    let Some(&first) = wrong.first() else { return Some(found) };
                    let tried = self.try_mode(&found);
                    let behind = self.behind(&tried.plan, &self.modes.conditions[first].arguments);
                    let mut relevant = self.assumptions(&mode, Some(&behind));
                    relevant.push((first, u32::from(mode.assumed[first])));
                    self.blamed.extend(behind);
                    relevant
                }
                Inner::Fails(relations) => {
                    self.blamed.extend(relations.iter().flatten());
                    self.assumptions(&mode, relations.as_ref())
                }
            };
            learnt.push(relevant);
        }
        None
    }

    pub(super) fn decision(&mut self, mode: Mode, ended: Ended) -> Decision {
        let tried = self.try_mode(&mode);
        Decision { mode, tried, ended }
    }

    /// Returns the first assumptions, in order, that contain nothing that is known to fail.
    ///
    /// Where one cannot be made either way, what stood in each way together fails too: that is learnt, and the search
    /// goes back to the last assumption that has a part in it.
    fn next(&self, first: &Mode, learnt: &mut Vec<Vec<Assumption>>) -> Option<Mode> {
        let conditions = first.assumed.len();
        let count = conditions + first.taken.len();
        // the alternatives of every assumption, the first mode's own first
        let ways = |i: usize, turn: u32| -> Option<u32> {
            let (own, of) = if i < conditions {
                (u32::from(first.assumed[i]), 2)
            } else if self.keeps_taken {
                (first.taken[i - conditions], 1)
            } else {
                (first.taken[i - conditions], self.modes.choices[i - conditions].1)
            };
            match turn {
                0 => Some(own),
                t if t >= of => None,
                t => Some(if t <= own { t - 1 } else { t }),
            }
        };
        if learnt.iter().any(Vec::is_empty) {
            return None;
        }
        // what is known to fail, by the last assumption in it
        let mut by_last: BTreeMap<Assumption, Vec<usize>> = BTreeMap::new();
        for (known, set) in learnt.iter().enumerate() {
            by_last.entry(*set.iter().max()?).or_default().push(known);
        }
        let (mut values, mut made) = (Vec::<u32>::new(), vec![Made::default()]);
        while let Some(top) = made.last_mut() {
            let i = values.len();
            if i == count {
                return Some(assuming(first, &values));
            }
            if let Some(value) = ways(i, top.turn) {
                values.push(value);
                let is_made = |set: &&usize| learnt[**set].iter().all(|&(i, v)| values[i] == v);
                match by_last.get(&(i, value)).and_then(|sets| sets.iter().find(is_made)) {
                    Some(&failing) => {
                        top.stands_against(&learnt[failing], i);
                        values.pop();
                    }
                    None => made.push(Made::default()),
                }
                continue;
            }
            let failing: Vec<Assumption> = std::mem::take(&mut top.against).into_iter().collect();
            let &(back, value) = failing.last()?;
            made.truncate(back + 1);
            values.truncate(back);
            made[back].stands_against(&failing, back);
            by_last.entry((back, value)).or_default().push(learnt.len());
            learnt.push(failing);
        }
        None
    }

    /// Returns the assumptions of a mode on which relations depend; all where they are not known.
    pub(super) fn assumptions(
        &self,
        mode: &Mode,
        relations: Option<&BTreeSet<u32>>,
    ) -> Vec<Assumption> {
        let concerns = |r: u32| relations.is_none_or(|all| all.contains(&r));
        let Conditional { guards, system, .. } = &*self.modes.conditional;
        // the bound of a condition is a relation after all others
        let own = |c: usize| (system.relations.len() + c) as u32;
        let guards = |c: usize| guards.iter().filter(move |g| g.condition as usize == c);
        let conditions = (0..mode.assumed.len())
            .filter(|&c| concerns(own(c)) || guards(c).any(|g| concerns(g.relation)))
            .map(|c| (c, u32::from(mode.assumed[c])));
        let choices = self.modes.choices.iter().enumerate();
        let taken = choices
            .filter(|(_, (relation, _))| concerns(*relation))
            .map(|(i, _)| (mode.assumed.len() + i, mode.taken[i]));
        conditions.chain(taken).collect()
    }

    /// Returns the relations that a plan computes slots from.
    fn behind(&self, plan: &Plan, slots: &[u32]) -> BTreeSet<u32> {
        let mut wanted: BTreeSet<u32> = slots.iter().copied().collect();
        let mut relations = BTreeSet::new();
        for step in plan.steps().iter().rev() {
            if step.targets.iter().any(|t| wanted.contains(t)) {
                wanted.extend(&step.reads);
                relations.extend(&step.relations);
            }
        }
        relations
    }

    fn slots_of(&self, relation: u32) -> Vec<u32> {
        let own = self.modes.comparisons.iter().filter(|c| c.relation == relation);
        own.flat_map(|c| c.arguments.iter().copied()).collect()
    }
}

/// An assumption that is being made: which way it is tried next, and what stood in the others.
#[derive(Debug, Default)]
struct Made {
    turn: u32,
    against: BTreeSet<Assumption>,
}

impl Made {
    /// Goes on to the next way: of what fails, the other assumptions stand in this one of assumption `own`.
    fn stands_against(&mut self, failing: &[Assumption], own: usize) {
        self.against.extend(failing.iter().filter(|(i, _)| *i != own));
        self.turn += 1;
    }
}

/// Returns a mode that assumes these values, conditions first, in which nothing acts.
fn assuming(first: &Mode, values: &[u32]) -> Mode {
    let (assumed, taken) = values.split_at(first.assumed.len());
    Mode {
        assumed: assumed.iter().map(|&v| v != 0).collect(),
        taken: taken.to_vec(),
        active: BTreeSet::new(),
        ..first.clone()
    }
}

enum Broken {
    Nothing,
    /// An inequality that can act.
    Comparison(u32),
    /// A relation that nothing in this mode can mend.
    Relation(u32),
}

/// Returns the relations that stand against each other in a failed attempt, where that is known.
pub(super) fn blame(tried: &Tried) -> Option<BTreeSet<u32>> {
    let unmet: BTreeSet<u32> = tried.outcome.unmet.iter().map(|u| u.relation).collect();
    if unmet.is_empty() {
        return None;
    }
    let mut blamed = unmet.clone();
    for rejected in &tried.plan.report.rejected {
        if unmet.contains(&rejected.relation) {
            blamed.extend(rejected.circuit.iter().map(|c| c.0));
        }
    }
    // what makes slots equal, or numbers of them, stands in no circuit
    let mut slots: BTreeSet<u32> = blamed.iter().flat_map(|&r| tried.plan.mentions(r)).collect();
    let aliases = tried.plan.steps().iter().filter(|s| s.kind == StepKind::Alias);
    for step in aliases.rev() {
        if step.targets.iter().any(|t| slots.contains(t)) {
            slots.extend(&step.reads);
            blamed.extend(&step.relations);
        }
    }
    // what is unmet without a circuit failed for reasons that the plan does not know
    let is_known = |r: &u32| tried.plan.report.rejected.iter().any(|x| x.relation == *r);
    unmet.iter().all(is_known).then_some(blamed)
}
