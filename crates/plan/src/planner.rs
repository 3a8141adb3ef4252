//! The planner: rules lowered once for a structure, components, and plans by shape.

use crate::component::{Component, Net, Partition};
use crate::course::Guard;
use crate::edit::NotDecided;
use crate::fault::{Fault, Trouble};
use crate::holds;
use crate::host::Host;
use crate::past::CameId;
use crate::plans::{PlanCounts, Plans};
use crate::recent::Recent;
use crate::rule::{Rules, Source};
use crate::task::{Alike, Holding, Locals, Setting, Task, Wish, at_rest, task};
use crate::template::{LoweringReport, On};
use kernel::{Document, Form, OriginId, SlotId, Structure, Values};
use solve::{Giver, Lean, Level, Mode, Modes, Plan, Runner, Scratch, System};
use std::cell::RefCell;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// What planning a mode costs for every slot, in multiplications, roughly.
const PLANNING: u64 = 1000;

/// A document and its structure: what every question to the planner is about.
#[derive(Clone, Copy, Debug)]
pub struct Model<'a> {
    /// The classes.
    pub document: &'a Document,
    /// The things.
    pub structure: &'a Structure,
}

/// Rules, components and plans of one form. Made anew when the form changes.
#[derive(Debug)]
pub struct Planner {
    form: Rc<Form>,
    /// What was noted while the rules were lowered.
    pub(crate) lowering: Rc<LoweringReport>,
    pub(crate) rules: Rc<Rules>,
    pub(crate) net: Rc<Net>,
    pub(crate) plans: Plans,
    pub(crate) alike: Alike,
    /// Every component with nothing edited; found when first asked for.
    whole: Option<Partition>,
    pub(crate) recent: Recent,
    /// The tasks of the latest edit, and what it changed.
    pub(crate) latest: Latest,
    /// One task for each component, with nothing edited; made when first asked for.
    resting: Option<Vec<Task>>,
    /// For every component, what opening the document came to, if that is remembered.
    pub(crate) came: Vec<Option<CameId>>,
    /// The components for which opening found no solution before a search was given up.
    pub(crate) given_up: Vec<(Component, NotDecided)>,
    /// What runs plans, kept for what it has allocated; not here while it runs.
    runner: RefCell<Option<Box<Runner>>>,
}

/// What was found of a form, for the next planner of the same.
#[derive(Debug)]
pub(crate) struct Kept {
    form: Rc<Form>,
    lowering: Rc<LoweringReport>,
    rules: Rc<Rules>,
    net: Rc<Net>,
    alike: Alike,
    whole: Option<Partition>,
    recent: Recent,
    resting: Option<Vec<Task>>,
}

impl Kept {
    pub(crate) fn is_on_a_course(&self) -> bool {
        self.lowering.has_courses && self.lowering.on != On::Nothing
    }
}

/// What the latest edit planned: what an explanation is about.
#[derive(Debug, Default)]
pub struct Latest {
    pub(crate) tasks: Vec<Task>,
    /// The slots that the edit set or moved; nothing on opening, when everything is computed.
    pub(crate) edited: Option<BTreeSet<SlotId>>,
    /// The rules that they are of, once taken out.
    pub(crate) of: Option<Rc<Rules>>,
}

impl Planner {
    /// Lowers every constraint and declared stay. What cannot be planned is left out and reported.
    ///
    /// `plans` are those that an earlier planner made; the default is none. Cost: linear in what
    /// the rules open into; nothing where the earlier planner was of the same form.
    pub fn new(model: Model<'_>, mut plans: Plans) -> (Self, Vec<Fault>) {
        let form = &model.structure.form;
        let kept = plans.kept.take().map(|kept| *kept).filter(|kept| Rc::ptr_eq(&kept.form, form));
        let kept = kept.unwrap_or_else(|| {
            let (rules, lowering) = plans.lower(model, None);
            let net = Net::new(model.structure, &rules);
            Kept {
                form: form.clone(),
                lowering: Rc::new(lowering),
                rules: Rc::new(rules),
                net: Rc::new(net),
                alike: Alike::default(),
                whole: None,
                recent: Recent::default(),
                resting: None,
            }
        });
        let faults = kept.lowering.faults.clone();
        let Kept { form, lowering, rules, net, alike, whole, recent, resting } = kept;
        let planner = Self {
            form,
            lowering,
            rules,
            net,
            plans,
            alike,
            whole,
            recent,
            latest: Latest::default(),
            resting,
            came: Vec::new(),
            given_up: Vec::new(),
            runner: RefCell::default(),
        };
        (planner, faults)
    }

    /// Lowers the rules anew where they take another course at these values: what they speak of a program draws, or
    /// they speak of as many as a value says. Returns true if it did. Whoever asks about a state that was not opened or
    /// edited by this planner calls it first.
    pub fn take_course(&mut self, model: Model<'_>, values: &Values) -> bool {
        let unsettled = self.lowering.unsettled.clone();
        match unsettled.filter(|unsettled| self.is_on_course(unsettled, values)) {
            Some(_) if self.lowering.on == On::Unsettled => false,
            Some(unsettled) => {
                self.lower_on(model, None);
                self.note_unsettled(unsettled);
                true
            }
            None => self.take_course_at(model, values),
        }
    }
    /// Does the same without a look at where no course was found before.
    pub(crate) fn take_course_at(&mut self, model: Model<'_>, values: &Values) -> bool {
        let LoweringReport { guards, has_courses, on, .. } = &*self.lowering;
        if !has_courses || *on == On::Course && self.is_on_course(guards, values) {
            return false;
        }
        self.lower_on(model, Some(values));
        true
    }
    /// Returns true if something cannot be planned on the course that is taken that could be on another.
    pub(crate) fn is_faulty_beside(&self, other: &LoweringReport) -> bool {
        !self.lowering.left_out.is_subset(&other.left_out)
    }
    /// Returns what cannot be planned on the course that is taken, besides what cannot be planned on any.
    pub fn course_faults(&self) -> &[Fault] {
        &self.lowering.course_faults
    }
    /// Notes that no course was found on which rules speak of as many as they say, and how it is decided there.
    pub(crate) fn note_unsettled(&mut self, unsettled: Rc<[Guard]>) {
        let message = "how many this speaks of does not settle: it changes with what the rule does";
        let mut lowering = (*self.lowering).clone();
        let faults = lowering.awaiting.iter().map(|&o| Trouble::not_yet(message).at(o));
        lowering.course_faults = faults.collect();
        (lowering.on, lowering.guards) = (On::Unsettled, unsettled.to_vec());
        lowering.unsettled = Some(unsettled);
        self.lowering = Rc::new(lowering);
    }
    /// Lowers the rules on the course that programs take at these values.
    pub(crate) fn lower_on(&mut self, model: Model<'_>, values: Option<&Values>) {
        let faults = self.lowering.faults.clone();
        let unsettled = self.lowering.unsettled.clone();
        let (rules, mut lowering) = self.plans.lower(model, values);
        lowering.unsettled = unsettled;
        let known: BTreeSet<OriginId> = faults.iter().map(|fault| fault.origin).collect();
        lowering.course_faults = std::mem::replace(&mut lowering.faults, faults);
        lowering.course_faults.retain(|fault| !known.contains(&fault.origin));
        self.net = Rc::new(Net::new(model.structure, &rules));
        self.rules = Rc::new(rules);
        self.lowering = Rc::new(lowering);
        (self.alike, self.recent) = (Alike::default(), Recent::default());
        (self.whole, self.resting) = (None, None);
        self.latest = Latest::default();
        (self.came, self.given_up) = (Vec::new(), Vec::new());
    }

    /// Takes what runs plans, and says how the states lean that it starts from; what a host's method runs
    /// in the meantime has another one.
    pub(crate) fn take_runner(&self, leans: Vec<Lean>) -> Box<Runner> {
        let mut runner = self.runner.take().unwrap_or_default();
        runner.lean(leans);
        runner
    }
    /// Puts back what was taken.
    pub(crate) fn put_back(&self, runner: Box<Runner>) {
        self.runner.replace(Some(runner));
    }
    /// Returns what runs have cost so far, in multiplications, roughly.
    pub(crate) fn spent(&self) -> u64 {
        self.runner.borrow().as_ref().map_or(0, |runner| runner.spent())
    }
    /// Returns true if what runs may cost was spent.
    pub(crate) fn is_spent(&self) -> bool {
        self.left() == Some(0)
    }
    /// Counts what was run without that.
    pub(crate) fn spend(&self, multiplications: u64) {
        self.runner.borrow_mut().get_or_insert_default().spend(multiplications);
    }
    /// Returns what runs may still cost, where that is bounded.
    pub(crate) fn left(&self) -> Option<u64> {
        self.runner.borrow().as_ref().and_then(|runner| runner.left())
    }
    /// Says what runs may cost until then, by what they have cost: those that come to that find no solution.
    pub(crate) fn end_at(&self, bound: Option<u64>) {
        let mut runner = self.runner.borrow_mut();
        runner.get_or_insert_default().end_at(bound);
    }
    /// Does the same for trials: of solutions that are searched for any will do.
    pub(crate) fn try_until(&self, bound: Option<u64>) {
        let mut runner = self.runner.borrow_mut();
        runner.get_or_insert_default().try_until(bound);
    }

    /// Returns the slots that rules tie to these, and these themselves.
    pub fn tied_to(&self, slots: impl IntoIterator<Item = SlotId>) -> BTreeSet<SlotId> {
        let start: BTreeSet<SlotId> = slots.into_iter().collect();
        let components = self.net.around(start.iter().copied(), &self.rules, &|_| false, &[]);
        let tied = components.iter().flat_map(|c| c.slots().iter().copied());
        start.iter().copied().chain(tied).collect()
    }
    /// Returns the slots that nothing gives, that rules tie to given ones and to no place.
    pub fn tied_to_given(&mut self, structure: &Structure) -> BTreeSet<SlotId> {
        let is_given = |&s: &SlotId| structure.slots[s].given.is_some();
        let is_of_place = |&s: &SlotId| structure.slots[s].place.is_some();
        let components = self.whole(structure).components.iter().map(Component::slots);
        let tied = components.filter(|slots| slots.iter().any(is_given));
        let tied = tied.filter(|slots| !slots.iter().any(is_of_place)).flatten();
        tied.copied().filter(|s| !is_given(s)).collect()
    }
    /// Returns the plans made so far, to be handed to the next planner.
    pub fn into_plans(mut self) -> Plans {
        self.take_plans()
    }
    /// Takes the plans made so far out, to be handed to the next planner.
    pub fn take_plans(&mut self) -> Plans {
        let mut plans = std::mem::take(&mut self.plans);
        plans.kept = Some(Box::new(Kept {
            form: self.form.clone(),
            lowering: self.lowering.clone(),
            rules: self.rules.clone(),
            net: self.net.clone(),
            alike: std::mem::take(&mut self.alike),
            whole: self.whole.take(),
            recent: std::mem::take(&mut self.recent),
            resting: self.resting.take(),
        }));
        plans
    }
    /// Forgets every plan, and what plans came to: what is asked next is planned anew. For a document that is looked at
    /// and so large that its plans take more room than it does itself.
    pub fn forget_plans(&mut self) {
        self.plans.forget_all();
        (self.alike, self.recent) = (Alike::default(), Recent::default());
        (self.latest, self.resting) = (Latest::default(), None);
        self.came.clear();
        *self.runner.borrow_mut() = None;
    }
    /// Gives plans back that another planner was tried with.
    pub fn give_plans(&mut self, mut plans: Plans) {
        let is_of_these = |kept: &Kept| Rc::ptr_eq(&kept.rules, &self.rules);
        if let Some(kept) = plans.kept.take().filter(|kept| is_of_these(kept)) {
            (self.alike, self.whole) = (kept.alike, kept.whole);
            (self.recent, self.resting) = (kept.recent, kept.resting);
        }
        self.plans = plans;
    }
    /// Takes out what the latest edit planned.
    pub fn take_latest(&mut self) -> Latest {
        Latest { of: Some(self.rules.clone()), ..std::mem::take(&mut self.latest) }
    }
    /// Makes explanations speak of this edit again; its structure must be that of this planner.
    pub fn restore_latest(&mut self, latest: Latest) {
        // rules that were opened anew on another course are others
        let is_other = latest.of.as_ref().is_some_and(|of| !Rc::ptr_eq(of, &self.rules));
        if !(is_other && self.lowering.has_courses) {
            self.latest = latest;
        }
    }

    /// Returns how many systems were planned, and how many found their plan made.
    pub fn plan_counts(&self) -> PlanCounts {
        self.plans.counts()
    }

    /// Returns the plain system of a mode, and its plan; planning counts as running does.
    pub(crate) fn in_mode(&self, modes: &Modes, mode: &Mode) -> (Rc<System>, Rc<Plan>) {
        let (system, plan, is_new) = self.plans.in_mode(modes, mode);
        if is_new {
            self.spend(PLANNING * system.slots.len() as u64);
        }
        (system, plan)
    }

    /// Returns what holds a slot while nothing is edited.
    pub(crate) fn resting_hold(structure: &Structure, slot: SlotId) -> Holding {
        let s = &structure.slots[slot];
        if s.anchored {
            Holding::Fixed
        } else if let Some(given) = structure.given(slot).filter(|_| s.place.is_none()) {
            Holding::Given(if given.of_class { Giver::Class } else { Giver::Document })
        } else {
            Holding::Kept
        }
    }

    /// Plans these components.
    pub(crate) fn tasks(
        &mut self,
        structure: &Structure,
        components: Vec<Component>,
        holding: &dyn Fn(SlotId) -> Holding,
        wishes: &[Wish],
        is_edited: Option<&dyn Fn(SlotId) -> bool>,
    ) -> Vec<Task> {
        let (rules, net) = (&self.rules, &self.net);
        let setting = Setting { structure, rules, net, holding, wishes, is_edited };
        let mut locals = Locals::new(structure);
        // what is planned first and alone is like nothing else
        let is_first = components.len() == 1 && self.plans.is_empty();
        let (plans, mut alike) = (&mut self.plans, Some(&mut self.alike).filter(|_| !is_first));
        let task = |c| task(plans, alike.as_deref_mut(), &setting, &mut locals, c);
        components.into_iter().map(task).collect()
    }

    /// Plans every component with nothing edited, unless that was done.
    pub(crate) fn plan_resting(&mut self, structure: &Structure) {
        if self.resting.is_none() {
            let holding = &|s| Self::resting_hold(structure, s);
            let components = self.whole(structure).components.clone();
            let (rules, net) = (&self.rules, &self.net);
            let (wishes, is_edited) = (&[][..], None);
            let setting = Setting { structure, rules, net, holding, wishes, is_edited };
            let (plans, alike, mut locals) = (&mut self.plans, &mut self.alike, None);
            let opened = self.latest.tasks.iter().map(Some).chain(std::iter::repeat(None));
            let task = |known| at_rest(plans, alike, &setting, &mut locals, known);
            self.resting = Some(components.into_iter().zip(opened).map(task).collect());
        }
    }

    /// Returns every component, where what is anchored is fixed; found once.
    pub(crate) fn whole(&mut self, structure: &Structure) -> &Partition {
        let is_fixed = |s: SlotId| structure.slots[s].anchored;
        self.whole.get_or_insert_with(|| self.net.all(&self.rules, is_fixed))
    }

    /// Returns the components of these slots, where what is anchored is fixed; each of `tied` speaks of several
    /// slots and ties them together.
    pub(crate) fn resting_around(
        &mut self,
        structure: &Structure,
        slots: &BTreeSet<SlotId>,
        tied: &[Vec<SlotId>],
    ) -> Vec<Component> {
        let all = self.whole(structure);
        let found = all.around(slots.iter().copied(), tied.iter().map(Vec::as_slice));
        found.unwrap_or_else(|| {
            let is_fixed = |s: SlotId| structure.slots[s].anchored;
            self.net.around(slots.iter().copied(), &self.rules, &is_fixed, tied)
        })
    }

    /// Takes the tasks of all components with nothing edited out, to plan others beside them.
    pub(crate) fn take_resting(&mut self) -> Vec<Task> {
        self.resting.take().unwrap_or_default()
    }
    /// Gives them back.
    pub(crate) fn give_resting(&mut self, tasks: Vec<Task>) {
        self.resting = Some(tasks);
    }

    /// Returns the tasks of all components with nothing edited, once they are planned.
    pub(crate) fn resting(&self) -> &[Task] {
        self.resting.as_deref().unwrap_or_default()
    }

    /// Returns the rules among these that do not hold, in their order.
    pub(crate) fn unmet(
        &self,
        model: Model<'_>,
        rules: impl IntoIterator<Item = u32>,
        values: &Values,
        host: &mut dyn Host,
    ) -> Vec<Unmet> {
        let mut unmet: Vec<Unmet> = Vec::new();
        let mut place_of: BTreeMap<Source, usize> = BTreeMap::new();
        let patterns = self.plans.patterns();
        let mut scratch = Scratch::default();
        for index in rules {
            let rule = self.rules.get(index);
            let Some(error) =
                holds::fails(patterns, model.structure, rule, values, host, &mut scratch)
            else {
                continue;
            };
            // A constraint of several rules is told once.
            match place_of.entry(rule.source) {
                Entry::Occupied(place) => {
                    let known = &mut unmet[*place.get()];
                    known.error = holds::larger(known.error, error);
                }
                Entry::Vacant(place) => {
                    place.insert(unmet.len());
                    unmet.push(Unmet { source: rule.source, level: rule.shape.level, error });
                }
            }
        }
        unmet
    }
}

/// A constraint that does not hold.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Unmet {
    /// Where it comes from.
    pub source: Source,
    /// How strongly it wants to hold.
    pub level: Level,
    /// The greatest difference of its sides, in base units; nothing where it has none.
    pub error: Option<f64>,
}

/// Returns true if a required one of these is not among those of before.
pub(crate) fn is_any_new(unmet: &[Unmet], before: &[Unmet]) -> bool {
    let before: BTreeSet<Source> = before.iter().map(|b| b.source).collect();
    unmet.iter().any(|u| u.level == Level::Required && !before.contains(&u.source))
}
