//! Plans by shape: what is planned once serves every component of the same shape.

use crate::past::Past;
use crate::planner::{Kept, Model};
use crate::rule::Rules;
use crate::template::{Known, LoweringReport, Templates, lower_all};
use crate::whole::Whole;
use base::Mixer;
use indexmap::IndexMap;
use indexmap::map::Entry;
use kernel::Values;
use solve::{Conditional, Mode, Modes, Patterns, Plan, Puzzle, SlotIndex, Stay, System};
use std::cell::RefCell;
use std::hash::BuildHasherDefault;
use std::rc::Rc;

/// Patterns of rules, and plans by the systems that they are of.
#[derive(Debug)]
pub struct Plans {
    patterns: Patterns,
    /// What constraints of classes are known to say, until a planner was made.
    known: Known,
    made: IndexMap<Rc<System>, Rc<Plan>, BuildHasherDefault<Mixer>>,
    modes: IndexMap<Rc<Conditional>, Rc<Modes>, BuildHasherDefault<Mixer>>,
    puzzles: IndexMap<Conditional, (Rc<System>, Rc<Puzzle>), BuildHasherDefault<Mixer>>,
    wholes: IndexMap<Conditional, Rc<Whole>, BuildHasherDefault<Mixer>>,
    /// Plans of systems in a mode: which mode, that given numbers hold, or that rules are but tested, is
    /// seen only when an edit runs.
    in_modes: RefCell<IndexMap<Rc<System>, Rc<Plan>, BuildHasherDefault<Mixer>>>,
    reused: usize,
    /// What plans came to.
    pub(crate) past: Past,
    /// What the planner that made them found of its form.
    pub(crate) kept: Option<Box<Kept>>,
}

impl Default for Plans {
    fn default() -> Self {
        Self::over(Templates::default())
    }
}

impl Plans {
    /// Makes room for the plans of a document whose classes these are of.
    pub fn over(templates: Templates) -> Self {
        let Templates { patterns, known } = templates;
        Self {
            patterns,
            known,
            made: IndexMap::default(),
            modes: IndexMap::default(),
            puzzles: IndexMap::default(),
            wholes: IndexMap::default(),
            in_modes: RefCell::default(),
            reused: 0,
            past: Past::default(),
            kept: None,
        }
    }
    /// Returns how many systems were planned, and how many found their plan made.
    pub fn counts(&self) -> PlanCounts {
        PlanCounts { planned: self.made.len(), reused: self.reused }
    }
    /// Returns what rules say.
    pub(crate) fn patterns(&self) -> &Patterns {
        &self.patterns
    }
    /// Returns what rules say, to be added to.
    pub(crate) fn patterns_mut(&mut self) -> &mut Patterns {
        &mut self.patterns
    }
    /// Lowers everything, by what is known of the classes; what programs draw, on the course that they take at `on`.
    pub(crate) fn lower(
        &mut self,
        model: Model<'_>,
        on: Option<&Values>,
    ) -> (Rules, LoweringReport) {
        lower_all((model, on), &mut self.patterns, &mut std::mem::take(&mut self.known))
    }
    /// Forgets the course that was taken in the document that they were made for: the next planner takes its own.
    #[must_use]
    pub fn without_course(mut self) -> Self {
        self.kept = self.kept.filter(|kept| !kept.is_on_a_course());
        self
    }
    /// Notes that a plan served once more.
    pub(crate) fn reuse(&mut self) {
        self.reused += 1;
    }
    /// Returns the plan of a system, a system that it is the plan of, and its number among those made.
    pub(crate) fn plan(&mut self, system: System) -> (Rc<System>, Rc<Plan>, u32) {
        let entry = self.made.entry(Rc::new(system));
        let number = entry.index() as u32;
        match entry {
            Entry::Occupied(known) => {
                self.reused += 1;
                (known.key().clone(), known.get().clone(), number)
            }
            Entry::Vacant(new) => {
                let system = new.key().clone();
                let plan = Rc::new(solve::plan(&system, &self.patterns));
                new.insert(plan.clone());
                (system, plan, number)
            }
        }
    }

    /// Returns true if nothing was planned yet.
    pub(crate) fn is_empty(&self) -> bool {
        self.made.is_empty()
    }
    /// Returns where what is made so far ends.
    pub(crate) fn mark(&self) -> Mark {
        Mark {
            made: self.made.len(),
            modes: self.modes.len(),
            puzzles: self.puzzles.len(),
            wholes: self.wholes.len(),
            in_modes: self.in_modes.borrow().len(),
        }
    }
    /// Forgets what was made since a mark.
    pub(crate) fn forget_since(&mut self, mark: Mark) {
        self.made.truncate(mark.made);
        self.modes.truncate(mark.modes);
        self.puzzles.truncate(mark.puzzles);
        self.wholes.truncate(mark.wholes);
        self.in_modes.get_mut().truncate(mark.in_modes);
    }
    /// Forgets all that was made, and what it came to.
    pub(crate) fn forget_all(&mut self) {
        let patterns = std::mem::take(&mut self.patterns);
        *self = Self::over(Templates { patterns, known: std::mem::take(&mut self.known) });
    }
    /// Returns a system with conditions, taken apart.
    pub(crate) fn modes(&mut self, stated: Conditional) -> Rc<Modes> {
        if let Some(modes) = self.modes.get(&stated) {
            return modes.clone();
        }
        let stated = Rc::new(stated);
        let modes = Rc::new(Modes::new(stated.clone(), &mut self.patterns));
        self.modes.insert(stated, modes.clone());
        modes
    }
    /// Returns how whole numbers among the real unknowns of a system are looked for.
    pub(crate) fn whole(&mut self, stated: Conditional) -> Rc<Whole> {
        if let Some(whole) = self.wholes.get(&stated) {
            return whole.clone();
        }
        let mut held = stated.clone();
        held.hold_what_is_only_read();
        let whole = Rc::new(Whole::new(self.modes(held)));
        self.wholes.insert(stated, whole.clone());
        whole
    }
    /// Returns the plain system of a mode, its plan, and whether that was made now.
    pub(crate) fn in_mode(&self, modes: &Modes, mode: &Mode) -> (Rc<System>, Rc<Plan>, bool) {
        let known = self.in_modes.borrow().len();
        let (system, plan) = self.plan_later(modes.system(mode));
        (system, plan, self.in_modes.borrow().len() > known)
    }
    /// Returns the plan in which the given numbers are constants where some yield in a plan of numbers alone, or
    /// all that has a value where a place with a value yields to what has none yet; nothing where none
    /// yields.
    pub(crate) fn with_given_held(&self, system: &System, plan: &Plan) -> Option<Rc<Plan>> {
        if !system.slots.iter().all(|s| s.is_number) {
            return None;
        }
        let is_kept = |s: SlotIndex| matches!(system.slots[s as usize].stay, Stay::Kept { .. });
        let opens = || system.slots.iter().any(|s| s.stay == Stay::Free);
        let places_yield = opens() && plan.targets().any(is_kept);
        if !places_yield && plan.report.yielded.is_empty() {
            return None;
        }
        let mut held = system.clone();
        let holds = |stay: Stay| stay.is_given() || places_yield && stay != Stay::Free;
        for slot in held.slots.iter_mut().filter(|s| holds(s.stay)) {
            slot.stay = Stay::Fixed;
        }
        Some(self.plan_later(held).1)
    }
    /// Returns the plan of a system that is met only when an edit runs, and a system that it is the plan of.
    pub(crate) fn plan_later(&self, system: System) -> (Rc<System>, Rc<Plan>) {
        if let Some((system, plan)) = self.in_modes.borrow().get_key_value(&system) {
            return (system.clone(), plan.clone());
        }
        let system = Rc::new(system);
        let plan = Rc::new(solve::plan(&system, &self.patterns));
        self.in_modes.borrow_mut().insert(system.clone(), plan.clone());
        (system, plan)
    }
    /// Returns what is searched for a system of whole numbers, and that system.
    pub(crate) fn puzzle(&mut self, stated: Conditional) -> (Rc<System>, Rc<Puzzle>) {
        if let Some(known) = self.puzzles.get(&stated) {
            return known.clone();
        }
        let puzzle = Rc::new(Puzzle::new(&stated, &self.patterns));
        let made = (Rc::new(stated.system.clone()), puzzle);
        self.puzzles.insert(stated, made.clone());
        made
    }
}

/// How much was made at some time, of each kind.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mark {
    made: usize,
    modes: usize,
    puzzles: usize,
    wholes: usize,
    in_modes: usize,
}

/// How much was planned.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct PlanCounts {
    /// Systems for which a plan was made.
    pub planned: usize,
    /// Systems whose plan was there already.
    pub reused: usize,
}
