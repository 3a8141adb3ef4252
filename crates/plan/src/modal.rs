//! Modes: a component with conditions is solved in the mode in which everything holds.
//!
//! In: a task whose course are modes. Each mode is tried by its own plan, in an edit from where the
//! edit began, in a drag from where the drag was; `solve` decides which one stands.

mod limit;
mod within;

pub(crate) use within::attempt_in_mode;

use crate::edit::{Conflict, NotDecided};
use crate::host::Host;
use crate::planner::{Model, Planner};
use crate::rule::Source;
use crate::run::{Adapter, Ground, Ran, compute, leans, ran, scatter};
use crate::task::{Course, Task};
use kernel::{SlotId, Values};
use solve::{
    Constants, Decision, Ended, Lean, Level, Mode, Modes, PATIENCE, Plan, SlotIndex, Standing,
    System, Tried, decide, decide_along,
};
use std::collections::BTreeMap;
use std::rc::Rc;
use within::within_bounds;

/// A mode with its plain system and plan.
#[derive(Clone, Debug)]
pub(crate) struct Stands {
    modes: Rc<Modes>,
    system: Rc<System>,
    plan: Rc<Plan>,
    mode: Mode,
}

impl Stands {
    pub(crate) fn plan(&self) -> &Rc<Plan> {
        &self.plan
    }
}

/// What acts in the mode of a component: what a reader may want to know of it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Acting {
    /// The constraint.
    pub source: Source,
    /// How it acts.
    pub kind: ActingKind,
}

/// How a constraint acts in a mode.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum ActingKind {
    /// An inequality holds at its bound.
    AtBound,
    /// Its condition is taken to be true, or false.
    Assumed(bool),
    /// This alternative is taken.
    Taken {
        /// Which one, counted from 0.
        way: u32,
        /// How many there are.
        of: u32,
    },
    /// This whole number was looked for.
    Whole {
        /// Where it is.
        slot: SlotId,
        /// The whole number.
        value: f64,
    },
}

/// What acts otherwise than before an edit.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ModeChange {
    /// The constraint, and how it acts.
    pub acting: Acting,
    /// True if it acts so now and did not; false if it did and acts no more.
    pub begins: bool,
}

impl Planner {
    /// Says what acts otherwise in the components of the latest edit, from values before it to
    /// values after it: what begins, then what ends, each in order of declaration.
    pub fn mode_changes(
        &self,
        model: Model<'_>,
        before: &Values,
        after: &Values,
        host: &mut dyn Host,
    ) -> Vec<ModeChange> {
        let tasks = self.latest.tasks.iter();
        tasks.flat_map(|t| t.mode_changes(self, model, before, after, host)).collect()
    }
}

impl Task {
    /// Says what acts otherwise in the mode that stands, with values `after`, than in the mode that
    /// values `before` choose. An inequality acts where it is at its bound.
    pub(crate) fn mode_changes(
        &self,
        planner: &Planner,
        model: Model<'_>,
        before: &Values,
        after: &Values,
        host: &mut dyn Host,
    ) -> Vec<ModeChange> {
        let Course::Modes(modes, mode) = &self.course else { return Vec::new() };
        let stepped = self.stepped(planner, before, after);
        let mut local = self.gather(&before.numbers);
        compute(planner, model, self, before, host, &mut local);
        let before = modes.at_bounds(&modes.first(&local, &local), &local);
        let after = modes.at_bounds(mode, &self.gather(&after.numbers));
        let [before, after] = [before, after].map(|mode| self.acting_in(planner, modes, &mode));
        let begins = after.iter().filter(|a| !before.contains(a));
        let begins = begins.map(|&acting| ModeChange { acting, begins: true });
        // another alternative, or the opposite of a condition, says what ends by what begins
        let ends = before.iter().filter(|a| a.kind == ActingKind::AtBound && !after.contains(a));
        let ends = ends.map(|&acting| ModeChange { acting, begins: false });
        begins.chain(ends).chain(stepped).collect()
    }
    /// Returns the whole numbers that were looked for and are others than before.
    fn stepped(&self, planner: &Planner, before: &Values, after: &Values) -> Vec<ModeChange> {
        let step = |local: SlotIndex| {
            let slot = self.component.slots()[local as usize];
            let value = after.numbers[slot];
            let speaks = |r: &&u32| planner.rules.get(**r).slots.contains(&slot);
            let rule = self.component.rules().iter().find(speaks)?;
            let source = planner.rules.source(*rule);
            let acting = Acting { source, kind: ActingKind::Whole { slot, value } };
            (value != before.numbers[slot]).then_some(ModeChange { acting, begins: true })
        };
        self.looked_for().into_iter().filter_map(step).collect()
    }
    /// Returns the slots of whole numbers that were looked for among real unknowns, in the mode that
    /// stands.
    pub(crate) fn looked_for(&self) -> Vec<SlotIndex> {
        match (&self.course, self.whole()) {
            (Course::Modes(_, mode), Some(whole)) if mode.constants != Constants::None => {
                whole.slots().collect()
            }
            (Course::Plan | Course::Modes(..) | Course::Search(_), _) => Vec::new(),
        }
    }
    /// Puts a task into another mode.
    pub(crate) fn stand(&mut self, stands: Stands) {
        self.course = Course::Modes(stands.modes, Box::new(stands.mode));
        self.system = stands.system;
        self.plan = stands.plan;
    }
    /// Returns the mode of the same task with other stays as one of this task's.
    pub(crate) fn stands_as(&self, planner: &Planner, stands: &Stands) -> Option<Stands> {
        let Course::Modes(modes, _) = &self.course else { return None };
        Some(self::stands(planner, modes, stands.mode.clone()))
    }
    /// Returns a task in the mode that values choose, no inequality acting; none without modes.
    pub(crate) fn by_values(
        &self,
        planner: &Planner,
        model: Model<'_>,
        values: &Values,
        host: &mut dyn Host,
    ) -> Option<Self> {
        let Course::Modes(modes, _) = &self.course else { return None };
        let mut local = self.gather(&values.numbers);
        compute(planner, model, self, values, host, &mut local);
        let mut task = self.clone();
        task.stand(stands(planner, modes, modes.first(&local, &local)));
        Some(task)
    }
    /// Returns what acts in the mode that stands, in order of declaration.
    pub(crate) fn acting(&self, planner: &Planner) -> Vec<Acting> {
        let Course::Modes(modes, mode) = &self.course else { return Vec::new() };
        self.acting_in(planner, modes, mode)
    }
    fn acting_in(&self, planner: &Planner, modes: &Modes, mode: &Mode) -> Vec<Acting> {
        modes
            .standings(mode)
            .into_iter()
            .map(|standing| self.acting_by(planner, standing))
            .collect()
    }
    /// Says in the document's terms how a relation stands in a mode.
    pub(crate) fn acting_by(&self, planner: &Planner, standing: Standing) -> Acting {
        let (relation, kind) = match standing {
            Standing::AtBound { relation } => (relation, ActingKind::AtBound),
            Standing::Assumed { relation, truth } => (relation, ActingKind::Assumed(truth)),
            Standing::Taken { relation, way, of } => (relation, ActingKind::Taken { way, of }),
        };
        Acting { source: self.source(&planner.rules, relation), kind }
    }
}

/// Returns a mode with its plain system and plan.
pub(crate) fn stands(planner: &Planner, modes: &Rc<Modes>, mode: Mode) -> Stands {
    let (system, plan) = planner.in_mode(modes, &mode);
    Stands { modes: modes.clone(), system, plan, mode }
}

/// How the mode of a task is decided: what is tried first, and how each is tried.
pub(crate) type Decide = fn(&Modes, &Mode, &[f64], &mut dyn FnMut(&Mode) -> Tried) -> Decision;

/// Runs a task in the modes that it has: by a drag of what has changed where one leads there, else at once.
pub(crate) fn run_on(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    modes: &Rc<Modes>,
    ground: &Ground,
    values: &mut Values,
    host: &mut dyn Host,
) -> Ran {
    let texts = values.texts.clone();
    let numbers: Vec<f64> = task.numbers(&values.numbers).collect();
    let hands = &mut Hands { planner, model, values, host };
    if let Some(decision) = dragged(task, modes, ground, hands) {
        return tell(planner, stands(planner, modes, decision.mode.clone()), task, &decision);
    }
    values.texts = texts;
    scatter(task, &numbers, values);
    run(planner, model, task, (modes, decide), ground, values, host)
}

/// Drags what has changed from a state that holds to what it is to be; nothing where that does not arrive, or
/// no way leads there.
fn dragged(
    task: &Task,
    modes: &Rc<Modes>,
    ground: &Ground,
    hands: &mut Hands<'_>,
) -> Option<Decision> {
    let Ground { x0, local, changed, .. } = ground;
    let mut drag = ModalDrag::begin(modes, x0.clone(), changed.clone());
    if !drag.leads_on(task, hands) {
        return None;
    }
    let targets: Vec<f64> = changed.iter().map(|&slot| local[slot as usize]).collect();
    let decision = drag.arrive(task, &targets, u64::MAX, hands);
    (decision.ended == Ended::Settled).then_some(decision)
}

/// Runs a task with modes at once; where none is found the values are those of the last attempt.
pub(crate) fn run(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    (modes, decide): (&Rc<Modes>, Decide),
    ground: &Ground,
    values: &mut Values,
    host: &mut dyn Host,
) -> Ran {
    let texts = values.texts.clone();
    let leans = leans(model, task);
    let mut attempt = |mode: &Mode| {
        values.texts.clone_from(&texts);
        attempt_in_mode(planner, model, task, modes, mode, ground, &leans, values, host)
    };
    let first = modes.first(&ground.x0, &ground.local);
    let decision = decide(modes, &first, &ground.x0, &mut attempt);
    if has_texts(task) {
        // the host's texts are those of the mode that stands
        attempt(&decision.mode);
    }
    scatter(task, &decision.tried.values, values);
    tell(planner, stands(planner, modes, decision.mode.clone()), task, &decision)
}

pub(crate) fn has_texts(task: &Task) -> bool {
    task.system.slots.iter().any(|s| !s.is_number)
}

/// Says in the document's terms what a decision came to.
pub(crate) fn tell(planner: &Planner, stands: Stands, task: &Task, decision: &Decision) -> Ran {
    let mut task = task.clone();
    task.stand(stands.clone());
    let mut told = ran(planner, &task, &decision.tried.outcome);
    told.stands = Some(stands);
    match &decision.ended {
        Ended::Settled => {}
        Ended::Contradiction(relations) => {
            told.is_solved = false;
            let mut sources: Vec<Source> =
                relations.iter().map(|&r| task.source(&planner.rules, r)).collect();
            sources.dedup();
            if let (Some(source), true) = (sources.pop(), told.conflicts.is_empty()) {
                told.conflicts.push(Conflict { source, circuit: sources });
            }
        }
        Ended::NotDecided(tried) => {
            told.is_solved = false;
            told.not_decided = Some(NotDecided::Modes(*tried as u64));
        }
    }
    told
}

/// A drag through modes.
///
/// Each mode is dragged on its own; one that was not followed at the last wish goes on from where the drag stood
/// then, and measures from where that did. Where other inequalities act at a wish than at the last, the way there
/// is halved, so that the new mode is met near where it begins: it has other branches elsewhere.
#[derive(Debug)]
pub(crate) struct ModalDrag {
    x0: Vec<f64>,
    inputs: Vec<SlotIndex>,
    followed: BTreeMap<Mode, Followed>,
    met: Met,
    mode: Mode,
    now: Vec<f64>,
    wishes: u64,
}

/// The modes that a drag has met, with their systems and plans: each wish asks for them several times.
#[derive(Debug)]
struct Met {
    modes: Rc<Modes>,
    planned: BTreeMap<Mode, (Rc<System>, Rc<Plan>)>,
}

impl Met {
    fn plan(&mut self, planner: &Planner, mode: &Mode) -> &Rc<Plan> {
        &self.planned(planner, mode).1
    }

    fn stands(&mut self, planner: &Planner, mode: &Mode) -> Stands {
        let (system, plan) = self.planned(planner, mode).clone();
        Stands { modes: self.modes.clone(), system, plan, mode: mode.clone() }
    }

    fn planned(&mut self, planner: &Planner, mode: &Mode) -> &(Rc<System>, Rc<Plan>) {
        let Self { modes, planned } = self;
        planned.entry(mode.clone()).or_insert_with(|| planner.in_mode(modes, mode))
    }
}

#[derive(Debug)]
struct Followed {
    drag: solve::Drag,
    /// The wish that it followed last, and the first of those that it followed without a gap.
    wish: u64,
    since: u64,
}

impl Followed {
    /// Begins a drag in a mode at the press; `written` says which way blocks lean in which two branches meet.
    fn begin(
        modes: &Modes,
        mode: &Mode,
        plan: &Plan,
        x0: &[f64],
        inputs: &[SlotIndex],
        written: &[Lean],
    ) -> Self {
        let mut drag = solve::Drag::begin(plan, x0, inputs);
        let mut leans = written.to_vec();
        leans.extend(within_bounds(modes, mode, plan, x0, written));
        drag.lean(plan, &leans);
        Self { drag, wish: 0, since: 1 }
    }
}

/// How often the way to where other inequalities act is halved.
const HALVINGS: u32 = 10;

/// What a drag works with.
struct Hands<'a> {
    planner: &'a Planner,
    model: Model<'a>,
    values: &'a mut Values,
    host: &'a mut dyn Host,
}

impl ModalDrag {
    pub(crate) fn begin(modes: &Rc<Modes>, x0: Vec<f64>, inputs: Vec<SlotIndex>) -> Self {
        Self {
            met: Met { modes: modes.clone(), planned: BTreeMap::new() },
            inputs,
            followed: BTreeMap::new(),
            mode: modes.first(&x0, &x0),
            now: x0.clone(),
            x0,
            wishes: 0,
        }
    }

    /// Returns true if a way leads on from the press: its rules hold there, and what is moved are real numbers.
    fn leads_on(&mut self, task: &Task, hands: &mut Hands<'_>) -> bool {
        let plan = self.met.plan(hands.planner, &self.mode).clone();
        let relations = &task.system.relations;
        let is_required = |&r: &u32| relations[r as usize].level == Level::Required;
        let Self { met, x0, inputs, mode, .. } = self;
        solve::are_continuous(&plan, inputs)
            && !met.modes.broken(mode, x0).iter().any(is_required)
            && self.at_press(task, &plan, hands).drag.holds()
    }

    /// Returns the drag in the present mode, begun at the press where it was not.
    fn at_press(&mut self, task: &Task, plan: &Plan, hands: &Hands<'_>) -> &mut Followed {
        let Self { met, x0, inputs, followed, mode, .. } = self;
        let begin =
            || Followed::begin(&met.modes, mode, plan, x0, inputs, &leans(hands.model, task));
        followed.entry(mode.clone()).or_insert_with(begin)
    }

    /// Follows a wish, as far as a mode stands on the way to it; the numbers are put into `values`, and the task into
    /// the mode that stands.
    pub(crate) fn follow(
        &mut self,
        planner: &Planner,
        model: Model<'_>,
        task: &mut Task,
        targets: &[f64],
        values: &mut Values,
        host: &mut dyn Host,
    ) -> Ran {
        let until = planner.spent() + PATIENCE;
        let hands = &mut Hands { planner, model, values, host };
        let decision = self.arrive(task, targets, until, hands);
        if decision.ended != Ended::Settled {
            self.come_near(task, targets, until, hands);
        }
        let mut told = tell(planner, self.met.stands(planner, &decision.mode), task, &decision);
        if told.stands.take().is_some() {
            task.stand(self.met.stands(planner, &self.mode));
        }
        told
    }

    /// Goes to a wish in short ways; once so much was spent, in one.
    fn arrive(
        &mut self,
        task: &Task,
        targets: &[f64],
        until: u64,
        hands: &mut Hands<'_>,
    ) -> Decision {
        let from: Vec<f64> = self.inputs.iter().map(|&input| self.now[input as usize]).collect();
        let plan = self.met.plan(hands.planner, &self.mode).clone();
        let parts = self.at_press(task, &plan, hands).drag.parts(&plan, targets);
        for part in 1..parts {
            if hands.planner.spent() > until || hands.planner.is_spent() {
                break;
            }
            let part = f64::from(part) / f64::from(parts);
            let on = from.iter().zip(targets).map(|(a, b)| a + part * (b - a));
            let decision = self.go(task, &on.collect::<Vec<_>>(), HALVINGS, hands);
            if decision.ended != Ended::Settled {
                break;
            }
        }
        self.go(task, targets, HALVINGS, hands)
    }

    /// Goes to a wish, by halves where other inequalities act there, and where none of its modes is met without more
    /// giving way: one may begin on the way that has other roots here.
    fn go(
        &mut self,
        task: &Task,
        targets: &[f64],
        halvings: u32,
        hands: &mut Hands<'_>,
    ) -> Decision {
        let decision = self.decide(task, targets, hands);
        let is_settled = decision.ended == Ended::Settled;
        let alike = Mode { active: self.mode.active.clone(), ..decision.mode.clone() };
        let acts_otherwise = is_settled && decision.mode != self.mode && alike == self.mode;
        let yielded = self.yielded(hands);
        let arrives = |decision: &Decision| {
            decision.ended == Ended::Settled && decision.tried.plan.yields() <= yielded
        };
        let may_switch = !self.mode.assumed.is_empty() && !hands.planner.is_spent();
        if halvings > 0 && (acts_otherwise || may_switch && !arrives(&decision)) {
            self.forget_begun();
            let half = |(&input, to): (&SlotIndex, &f64)| 0.5 * (self.now[input as usize] + to);
            let middle: Vec<f64> = self.inputs.iter().zip(targets).map(half).collect();
            let half = self.go(task, &middle, halvings - 1, hands);
            if acts_otherwise || arrives(&half) {
                return self.go(task, targets, halvings - 1, hands);
            }
        }
        if is_settled {
            self.stand_in(task, &decision, hands);
        }
        decision
    }

    /// Returns how many given numbers yield where the drag stands.
    fn yielded(&mut self, hands: &Hands<'_>) -> [usize; 2] {
        self.met.plan(hands.planner, &self.mode).yields()
    }

    /// Goes on from what a wish came to.
    fn stand_in(&mut self, task: &Task, decision: &Decision, hands: &mut Hands<'_>) {
        self.now.clone_from(&decision.tried.values);
        self.mode.clone_from(&decision.mode);
        scatter(task, &self.now, hands.values);
    }

    /// Finds the mode that stands at a wish; the host's texts are then of that mode, where there is none as they were.
    fn decide(&mut self, task: &Task, targets: &[f64], hands: &mut Hands<'_>) -> Decision {
        self.wishes += 1;
        let Self { met, x0, inputs, followed, mode, now, wishes } = self;
        let modes = met.modes.clone();
        let Hands { planner, model, values, host } = hands;
        let texts = values.texts.clone();
        let leans = leans(*model, task);
        let standing = &*mode;
        let mut attempt = |attempted: &Mode| {
            let plan = met.plan(planner, attempted).clone();
            values.texts.clone_from(&texts);
            let mut adapter = Adapter { planner, model: *model, task, values, host: *host };
            let begin = || Followed::begin(&modes, attempted, &plan, x0, inputs, &leans);
            let is_kept = followed.get(attempted).is_some_and(|follow| follow.wish + 1 >= *wishes);
            let anchors =
                followed.get(standing).filter(|_| !is_kept).map(|f| f.drag.anchors().to_vec());
            let follow = followed.entry(attempted.clone()).or_insert_with(begin);
            if !is_kept {
                follow.drag.stand_at(&plan, now);
                follow.drag.measure_from(anchors.unwrap_or_default());
                follow.since = *wishes;
            }
            follow.wish = *wishes;
            if plan.asks_host() && attempted != standing {
                // the host's texts are those of the mode that stands
                follow.drag.run_anew();
            }
            let before = follow.drag.spent();
            follow.drag.end_at(planner.left().map(|left| before + left));
            let outcome = follow.drag.follow(&plan, targets, &mut adapter);
            planner.spend(follow.drag.spent() - before);
            Tried { plan, outcome, values: follow.drag.values().to_vec() }
        };
        let decision = decide_along(&modes, standing, x0, &mut attempt);
        if decision.ended != Ended::Settled {
            values.texts = texts;
        } else if has_texts(task) {
            attempt(&decision.mode);
        }
        decision
    }

    /// Has other modes that began at the last wish begin again where the drag stands.
    fn forget_begun(&mut self) {
        for (mode, follow) in &mut self.followed {
            if follow.since == self.wishes && *mode != self.mode {
                follow.wish = 0;
            }
        }
    }
}
