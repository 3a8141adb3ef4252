//! Running a task: numbers out of the document, through the plan, and back.

mod otherwise;

use crate::aim::{Aim, in_words};
use crate::edit::{Conflict, NotDecided};
use crate::holds::{fails, truth};
use crate::host::{Failure, Host};
use crate::modal::{self, Decide, Stands};
use crate::planner::{Model, Planner};
use crate::rule::{Body, Condition, How, Rule, Source};
use crate::task::{Course, Number, Origin, Task};
use crate::whole::{self, Looking};
use base::number::Toward;
use kernel::{SlotId, Value, Values};
use otherwise::{or_at_once, or_kept_apart, or_letting_go};
use solve::{
    Lean, Level, Outcome, Plan, Puzzle, Reason, Scratch, SlotIndex, Status, Stay, Verdict, moved,
};
use std::collections::BTreeSet;
use std::sync::Arc;

/// What came of a task.
#[derive(Debug, Default)]
pub(crate) struct Ran {
    /// True if every required relation holds.
    pub(crate) is_solved: bool,
    /// True if something required does not hold though everything could be computed, or everything was searched.
    pub(crate) is_conflict: bool,
    /// True if what the pointer wishes is not reached.
    pub(crate) is_missed: bool,
    /// True if every relation of a task without modes holds.
    pub(crate) is_met: bool,
    pub(crate) conflicts: Vec<Conflict>,
    pub(crate) failure: Option<Failure>,
    /// Slots where two solutions coincide.
    pub(crate) double_roots: Vec<SlotId>,
    /// The mode that stands, with its system and plan, where there are modes.
    pub(crate) stands: Option<Stands>,
    /// Where it was given up.
    pub(crate) not_decided: Option<NotDecided>,
    /// Where the way of an edit ended that came to no end, in the slots of its system.
    pub(crate) limit: Option<Vec<f64>>,
}

impl Ran {
    /// Returns true if what it was for is not reached, and no method failed.
    pub(crate) fn falls_short(&self) -> bool {
        self.is_missed || !self.is_solved && self.failure.is_none()
    }
    /// Returns true if it holds on no way that was looked at, and no method failed.
    fn is_refused(&self) -> bool {
        !self.is_solved && self.failure.is_none() && self.not_decided.is_none()
    }
}

/// Where a task starts from, in the slots of its system.
pub(crate) struct Ground {
    /// The state when the edit began.
    pub(crate) x0: Vec<f64>,
    /// The same, with what the edit sets.
    pub(crate) local: Vec<f64>,
    /// Its texts, of that state.
    pub(crate) texts: Texts,
    pub(crate) changed: Vec<SlotIndex>,
}

impl Ground {
    /// Puts in what the host computes at the start.
    pub(crate) fn compute(
        &mut self,
        planner: &Planner,
        model: Model<'_>,
        task: &Task,
        start: &Values,
        host: &mut dyn Host,
    ) {
        compute(planner, model, task, start, host, &mut self.x0);
        task.computed().for_each(|(at, _)| self.local[at as usize] = self.x0[at as usize]);
    }
}

/// Puts what the host computes from values into the slots of a task that hold it.
pub(crate) fn compute(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    values: &Values,
    host: &mut dyn Host,
    local: &mut [f64],
) {
    for (at, number) in task.computed() {
        let number = computed(planner, model, number, values, host);
        local[at as usize] = number.unwrap_or(0.0);
    }
}

/// Computes what the host computes beside a rule.
fn computed(
    planner: &Planner,
    model: Model<'_>,
    Number { rule, when }: Number,
    values: &Values,
    host: &mut dyn Host,
) -> Result<f64, String> {
    let rule = planner.rules.get(rule);
    let condition = when.map(|at| &rule.shape.when[at as usize].condition);
    let number = match (condition, &rule.shape.body, rule.source) {
        (Some(Condition::Host(by)), ..) => truth(model.structure, rule, by, values, host)?,
        (None, Body::Beside(beside), Source::Constraint(c)) => {
            host.number(model.structure.constraints[c as usize], beside.side, values)?
        }
        _ => return Err("nothing is computed beside this".into()),
    };
    if number.is_finite() { Ok(number + 0.0) } else { Err(format!("{number} does not fit")) }
}

/// What texts were, where there were any.
pub(crate) type Texts = Vec<(SlotId, Option<Arc<str>>)>;

pub(crate) fn put_texts(texts: &[(SlotId, Option<Arc<str>>)], values: &mut Values) {
    for (slot, text) in texts {
        match text {
            Some(text) => values.texts.insert(*slot, text.clone()),
            None => values.texts.remove(slot),
        };
    }
}

/// What running a task may cost, and for every slot besides, in multiplications: a
/// thousand times what a large grid or truss needs, eight times what a tangled chain of 320 bars does.
const WORK: u64 = 3_000_000_000;
const SLOT_WORK: u64 = 100_000;

/// Runs a task of an edit: as long as whoever asks says, else as long as its size allows.
///
/// `start` is the state when the edit began; `values` has what the edit sets already in it.
pub(crate) fn run(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    aim: &Aim,
    start: &Values,
    values: &mut Values,
    host: &mut dyn Host,
) -> Ran {
    let mut ground = ground(planner, task, aim, start, values);
    ground.compute(planner, model, task, start, host);
    let bound = WORK + SLOT_WORK * task.system.slots.len() as u64;
    let has_bound = planner.left().is_some();
    if !has_bound {
        planner.end_at(Some(planner.spent() + bound));
    }
    let ran = by_course(planner, model, task, &ground, values, host);
    let ran = or_otherwise(planner, model, task, &ground, ran, values, host);
    let ran = or_letting_go(planner, model, task, &ground, ran, values, host);
    let ran = if aim.sets_several {
        or_at_once(planner, model, task, &ground, ran, values, host)
    } else {
        ran
    };
    let mut ran = or_kept_apart(planner, model, task, &ground, ran, values, host);
    if !has_bound {
        if planner.is_spent() && !ran.is_solved {
            ran.not_decided = Some(NotDecided::Work(bound));
        }
        planner.end_at(None);
    }
    let is_round = ran.not_decided == Some(NotDecided::Round);
    if !ran.is_solved && (is_round || !task.plan.opens()) {
        put_back(task, &ground, values);
    }
    ran
}

/// Gives what had a value the one that it had.
fn put_back(task: &Task, ground: &Ground, values: &mut Values) {
    let mut texts = ground.texts.iter();
    let slots = task.component.slots().iter().zip(&task.system.slots);
    for ((&slot, own), &number) in slots.zip(&ground.local) {
        let text = if own.is_number { None } else { texts.next() };
        if own.stay == Stay::Free {
            continue;
        }
        match text {
            Some(text) => put_texts(std::slice::from_ref(text), values),
            None if own.is_number => values.numbers[slot] = number + 0.0,
            None => {}
        }
    }
}

/// Looks further where what was run did not come to an end: for whole numbers, where some are looked for and it
/// made none; then for other pieces of equations, where it did not reach what is wished as well, or came to others
/// than it began on and something nearer may do.
pub(crate) fn or_otherwise(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    ground: &Ground,
    ran: Ran,
    values: &mut Values,
    host: &mut dyn Host,
) -> Ran {
    if ran.failure.is_some() {
        return ran;
    }
    // of whole numbers alone all are looked at together
    let search = || {
        let whole = task.whole().filter(|whole| !(ran.is_met && whole.is_whole(task, values)));
        whole.and_then(|whole| whole.puzzle(planner.plans.patterns()))
    };
    let searched = search().map(|puzzle| by_search(planner, task, puzzle, ground, values));
    let ran = match task.whole() {
        _ if let Some(found) = searched.filter(|found| found.is_solved) => found,
        Some(whole) if !(ran.is_solved && whole.is_whole(task, values)) => {
            // structure decides who may yield to a wish: what would if whole numbers were real ones
            let plan = ran.stands.as_ref().map_or(&task.plan, Stands::plan);
            let may_yield = !plan.report.yielded.is_empty();
            let looking = Looking { whole, decide: solve::decide, may_yield };
            let found = whole::run(planner, model, task, looking, ground, values, host);
            found.unwrap_or(Ran { is_solved: false, ..ran })
        }
        Some(_) | None => ran,
    };
    let is_reached = ran.is_solved && !ran.is_missed;
    if is_reached && !may_be_nearer(task, ground, &ran) {
        return ran;
    }
    let Some(pieces) = task.pieces(planner.plans.patterns()) else { return ran };
    let numbers: Vec<f64> = task.numbers(&values.numbers).collect();
    if is_reached && !pieces.is_on_others(ground, &numbers) {
        return ran;
    }
    let texts = values.texts.clone();
    // what was run wrote texts of its own
    put_texts(&ground.texts, values);
    let decide: Decide =
        if is_reached { solve::decide_nearest_pieces } else { solve::decide_pieces };
    let found = if task.whole().is_some() {
        let looking = Looking { whole: pieces, decide, may_yield: true };
        whole::run(planner, model, task, looking, ground, values, host).unwrap_or_default()
    } else {
        modal::run(planner, model, task, (&pieces.modes, decide), ground, values, host)
    };
    let moved = |numbers: &[f64]| moved(&task.system.slots, &ground.x0, numbers);
    let is_nearer = || moved(&task.numbers(&values.numbers).collect::<Vec<_>>()) < moved(&numbers);
    if found.is_solved && (!is_reached || is_nearer()) {
        return found;
    }
    values.texts = texts;
    scatter(task, &numbers, values);
    Ran { not_decided: ran.not_decided.or(found.not_decided), ..ran }
}

/// Returns true if given numbers yielded to an edit, so that others nearer to where they were may do as well.
pub(crate) fn may_be_nearer(task: &Task, ground: &Ground, ran: &Ran) -> bool {
    let plan = ran.stands.as_ref().map_or(&task.plan, Stands::plan);
    !ground.changed.is_empty() && !plan.report.yielded.is_empty()
}

/// Runs a task by its plan, its modes or its search.
fn by_course(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    ground: &Ground,
    values: &mut Values,
    host: &mut dyn Host,
) -> Ran {
    match &task.course {
        Course::Plan => {
            let Ground { x0, local: began, changed, .. } = ground;
            let mut runner = planner.take_runner(leans(model, task));
            let mut by_plan = |plan: &Plan| {
                let mut local = began.clone();
                let mut adapter = Adapter { planner, model, task, values, host };
                let outcome = solve::run(plan, &mut runner, x0, &mut local, changed, &mut adapter);
                (outcome, local, runner.stopped().map(<[f64]>::to_vec))
            };
            // rows that depend on others here, though not at a generic point, free no given number
            let held = planner.plans.with_given_held(&task.system, &task.plan);
            let held = held.map(|plan| by_plan(&plan));
            let held = held.filter(|(outcome, ..)| outcome.is_solved() && outcome.unmet.is_empty());
            let (outcome, local, limit) = held.unwrap_or_else(|| by_plan(&task.plan));
            planner.put_back(runner);
            scatter(task, &local, values);
            Ran { limit, ..ran(planner, task, &outcome) }
        }
        Course::Modes(modes, _) => modal::run_on(planner, model, task, modes, ground, values, host),
        Course::Search(puzzle) => by_search(planner, task, puzzle, ground, values),
    }
}

/// Searches for the nearest whole numbers.
fn by_search(
    planner: &Planner,
    task: &Task,
    puzzle: &Puzzle,
    ground: &Ground,
    values: &mut Values,
) -> Ran {
    let mut runner = planner.take_runner(Vec::new());
    let verdict = runner.nearest(puzzle, &ground.x0, &ground.local);
    planner.put_back(runner);
    if let Verdict::Found(found) = &verdict {
        scatter(task, found, values);
    }
    searched(&verdict)
}

pub(crate) fn ground(
    planner: &Planner,
    task: &Task,
    aim: &Aim,
    start: &Values,
    values: &Values,
) -> Ground {
    let mut x0 = task.gather(&start.numbers);
    let mut local = task.gather(&values.numbers);
    for (known, slot) in task.holds() {
        local[known as usize] = start.numbers[slot];
    }
    let mut changed: Vec<SlotIndex> = Vec::new();
    for &(known, wish, coordinate) in task.targets() {
        let formula = &aim.wishes[wish as usize].formulas[coordinate as usize];
        x0[known as usize] = formula.value(planner.plans.patterns(), &start.numbers);
        local[known as usize] = aim.wanted[wish as usize][coordinate as usize];
        changed.push(known);
    }
    let has_texts = !start.texts.is_empty() || !values.texts.is_empty();
    let mut texts = Texts::new();
    for (i, &slot) in (0..).zip(task.component.slots()) {
        let is_same = start.numbers[slot].to_bits() == values.numbers[slot].to_bits();
        if !is_same || has_texts && start.texts.get(&slot) != values.texts.get(&slot) {
            changed.push(i);
        }
        if has_texts && !task.system.slots[i as usize].is_number {
            texts.push((slot, values.texts.get(&slot).cloned()));
        }
    }
    Ground { x0, local, texts, changed }
}

/// Returns what is written of the slots of a task: which way they go from where two branches meet.
pub(crate) fn leans(model: Model<'_>, task: &Task) -> Vec<Lean> {
    let sides = &model.structure.sides;
    if sides.is_empty() {
        return Vec::new();
    }
    let slots = (0..).zip(task.component.slots());
    let lean =
        |(slot, id): (SlotIndex, &SlotId)| sides.get(id).map(|&toward| Lean { slot, toward });
    slots.filter_map(lean).collect()
}

impl Planner {
    /// Returns which way slots go that an edit brought to where two branches meet, so that the
    /// branch it came on goes on. Cost: a factorisation of every block with several solutions.
    pub(crate) fn undecided(
        &self,
        model: Model<'_>,
        tasks: &[Task],
        aim: &Aim,
        before: &Values,
        after: &Values,
    ) -> Vec<(SlotId, Toward)> {
        let mut undecided = Vec::new();
        let may_fork = |t: &&Task| !matches!(t.course, Course::Search(_)) && t.plan.may_fork();
        for task in tasks.iter().filter(may_fork) {
            let [x0, now] =
                [before, after].map(|values| ground(self, task, aim, values, values).x0);
            let slot = |lean: Lean| {
                let slot = task.component.slots().get(lean.slot as usize)?;
                Some((*slot, lean.toward))
            };
            let leaning = solve::leaning(&task.plan, &x0, &leans(model, task), &now);
            undecided.extend(leaning.into_iter().filter_map(slot));
        }
        undecided
    }
}

/// Says what came of a search.
pub(crate) fn searched(verdict: &Verdict) -> Ran {
    match verdict {
        Verdict::Found(_) => Ran { is_solved: true, ..Ran::default() },
        Verdict::Impossible => Ran { is_conflict: true, ..Ran::default() },
        Verdict::NotDecided { visited } => {
            Ran { not_decided: Some(NotDecided::Search(*visited)), ..Ran::default() }
        }
    }
}

/// Puts the numbers of a task's slots into the document's.
pub(crate) fn scatter(task: &Task, local: &[f64], values: &mut Values) {
    for (&slot, &x) in task.component.slots().iter().zip(local) {
        values.numbers[slot] = x + 0.0;
    }
}

/// Says in the document's terms what came of a run.
pub(crate) fn ran(planner: &Planner, task: &Task, outcome: &Outcome) -> Ran {
    let unmet: BTreeSet<u32> = outcome.unmet.iter().map(|u| u.relation).collect();
    let source = |relation: u32| task.source(&planner.rules, relation);
    let conflicts = planner.conflicts(task, |rejected| unmet.contains(&rejected.relation));
    let failure = match &outcome.status {
        Status::Stopped(Reason::Method { step, message }) => {
            let relation = task.plan.steps()[*step as usize].relations.first().copied();
            relation.map(|r| Failure { source: source(r), message: message.clone() })
        }
        Status::Solved
        | Status::Stopped(
            Reason::Limit { .. }
            | Reason::NoSolution { .. }
            | Reason::NotDecided { .. }
            | Reason::Spent
            | Reason::GivenUp { .. }
            | Reason::Conflict,
        ) => None,
    };
    let is_required = |&r: &u32| task.system.relations[r as usize].level == Level::Required;
    let required = || unmet.iter().copied().filter(is_required);
    let not_decided = match outcome.status {
        Status::Stopped(Reason::NotDecided { tried }) => Some(NotDecided::Roots(tried.into())),
        Status::Stopped(Reason::GivenUp { bound }) => Some(NotDecided::Work(bound)),
        Status::Stopped(Reason::Conflict) if task.plan.may_hold_elsewhere(required()) => {
            Some(NotDecided::Round)
        }
        Status::Solved | Status::Stopped(_) => None,
    };
    let double_roots = outcome.notes.iter().filter_map(|n| match n {
        solve::Note::DoubleRoot { slot } => task.component.slots().get(*slot as usize).copied(),
    });
    let is_solved = outcome.is_solved();
    let is_conflict = outcome.status == Status::Stopped(Reason::Conflict) && not_decided.is_none();
    let double_roots = double_roots.collect();
    let is_met = outcome.unmet.is_empty();
    let is_wish = |&r: &u32| task.system.relations[r as usize].level == Level::Move;
    let is_missed = unmet.iter().any(is_wish);
    Ran {
        is_solved,
        is_missed,
        is_conflict,
        is_met,
        conflicts,
        failure,
        double_roots,
        not_decided,
        ..Ran::default()
    }
}

/// The host as the solver sees it: relations by number, texts kept aside.
pub(crate) struct Adapter<'r> {
    pub(crate) planner: &'r Planner,
    pub(crate) model: Model<'r>,
    pub(crate) task: &'r Task,
    pub(crate) values: &'r mut Values,
    pub(crate) host: &'r mut dyn Host,
}

impl solve::Host for Adapter<'_> {
    fn compute(
        &mut self,
        source: u32,
        method: usize,
        values: &[f64],
        out: &mut [f64],
    ) -> Result<(), String> {
        let rule = match self.task.origin(source) {
            Origin::Rule(rule) => rule,
            Origin::Number(number) => {
                scatter(self.task, values, self.values);
                out[0] = computed(self.planner, self.model, number, self.values, self.host)?;
                return Ok(());
            }
            Origin::Wish(_) => return Err("a wish has no methods".into()),
        };
        let rule = self.planner.rules.get(rule);
        scatter(self.task, values, self.values);
        let method = &rule.shape.methods[method];
        let targets: Vec<SlotId> = rule.slots_at(&method.targets).collect();
        let written = match (&method.how, rule.source) {
            (How::Copy, _) => {
                let from = rule.slots[method.reads[0] as usize];
                vec![(targets[0], self.values.get(from))]
            }
            (How::Host(way), Source::Constraint(c)) => {
                let constraint = self.model.structure.constraints[c as usize];
                self.host.compute(constraint, *way, self.values)?
            }
            (How::Host(_) | How::Formulas(_), _) => {
                return Err("this method is not the host's".into());
            }
        };
        for (slot, value) in written {
            self.write(&targets, slot, value, out)?;
        }
        Ok(())
    }

    fn holds(&mut self, source: u32, values: &[f64]) -> bool {
        let rule = match self.task.origin(source) {
            Origin::Rule(rule) => rule,
            Origin::Number(number) => {
                scatter(self.task, values, self.values);
                let now = computed(self.planner, self.model, number, self.values, self.host);
                let mut known = self.task.computed().filter(|&(_, of)| of == number);
                return known.all(|(at, _)| now == Ok(values[at as usize]));
            }
            Origin::Wish(_) => return true,
        };
        scatter(self.task, values, self.values);
        let rule = self.planner.rules.get(rule);
        if let Some(holds) = self.holds_in_branch(rule) {
            return holds;
        }
        let structure = self.model.structure;
        let patterns = self.planner.plans.patterns();
        let scratch = &mut Scratch::default();
        fails(patterns, structure, rule, self.values, self.host, scratch).is_none()
    }
}

impl Adapter<'_> {
    /// Returns true if a rule under a condition holds, whether that is true or not: the mode says that it is, and it
    /// may hang on what is computed later. Nothing for other rules, and for those that no method of the host makes hold.
    fn holds_in_branch(&mut self, rule: Rule<'_>) -> Option<bool> {
        let method = rule.shape.methods.first()?;
        if rule.shape.when.is_empty() {
            return None;
        }
        let value = |position: u32| self.values.get(rule.slots[position as usize]);
        match (&method.how, rule.source) {
            (How::Copy, _) => Some(value(method.targets[0]).same_bits(&value(method.reads[0]))),
            (How::Host(way), Source::Constraint(c)) => {
                let constraint = self.model.structure.constraints[c as usize];
                let written = self.host.compute(constraint, *way, self.values);
                let stands = |(slot, v): &(SlotId, Value)| self.values.get(*slot).same_bits(v);
                Some(written.is_ok_and(|all| all.iter().all(stands)))
            }
            (How::Host(_) | How::Formulas(_), _) => None,
        }
    }

    fn write(
        &mut self,
        targets: &[SlotId],
        slot: SlotId,
        value: Value,
        out: &mut [f64],
    ) -> Result<(), String> {
        let Some(position) = targets.iter().position(|&t| t == slot) else { return Ok(()) };
        let wants_number = self.model.structure.slots[slot].primitive.is_number();
        match value {
            Value::Number(x) if wants_number && x.is_finite() => out[position] = x,
            Value::Text(_) if !wants_number => self.values.put(slot, value),
            Value::Number(_) | Value::Text(_) => {
                return Err(format!("{} does not fit", in_words(&value)));
            }
        }
        Ok(())
    }
}
