//! Edits: opening a document, setting values, moving parts; and what came of it.

use crate::component::Component;
use crate::drag::move_at_once;
use crate::evaluate::Opening;
use crate::fault::Trouble;
use crate::holds::agree;
use crate::host::{Failure, Host};
use crate::meaning::{Frame, Meaning};
use crate::planner::{Latest, Model, Planner, Unmet};
use crate::rule::{Source, lone_slot};
use crate::run::{Ran, run};
use crate::task::{Holding, Task, Wish};
use base::IdVec;
use expr::ExprId;
use kernel::{SlotId, Term, ThingId, Value, Values};
use solve::Level;
use std::collections::{BTreeMap, BTreeSet};

/// What an edit is about.
#[derive(Clone, Copy, Debug)]
pub enum Target<'a> {
    /// A stored part: a number, a text, a place, any thing.
    Thing(ThingId),
    /// A virtual part, or any expression of numbers, of a thing.
    Term {
        /// What is `Me` in it.
        me: ThingId,
        /// The expression.
        term: &'a Term,
    },
}

/// How an edit wants its targets.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum EditKind {
    /// Required for this edit; lifts the anchor of exactly what it sets.
    Set,
    /// A wish; never lifts an anchor.
    Move,
}

/// What came of an edit.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct EditReport {
    /// Why nothing was changed; nothing if the edit was made.
    pub refusal: Option<RefusalReason>,
    /// The slots whose values differ in any bit, in order.
    pub changed: Vec<SlotId>,
    /// The constraints around what changed that do not hold (in a refused edit: that would not have).
    pub unmet: Vec<Unmet>,
    /// What stood against what: a rule that could not be had, and the rules that it depends on.
    pub conflicts: Vec<Conflict>,
    /// True if every target has the value that was wanted.
    pub reached: bool,
}

/// Why an edit changed nothing.
#[derive(Clone, PartialEq, Debug)]
pub enum RefusalReason {
    /// Required constraints would not hold.
    Unmet,
    /// An anchor holds this slot.
    Anchored(SlotId),
    /// A written method failed.
    Method(Failure),
    /// The values do not fit the target, or it cannot be edited.
    Target(String),
}

/// A rule that could not be accepted, and the others that it depends on.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Conflict {
    /// The rule.
    pub source: Source,
    /// Rules that were accepted before it; with them it is a minimal dependent set.
    pub circuit: Vec<Source>,
}

/// What an edit does to the slots, before anything is solved.
#[derive(Debug, Default)]
pub(crate) struct Aim {
    /// Slots that take a value as it is.
    pub(crate) fixed: BTreeMap<SlotId, Value>,
    /// Expressions that are wished, and what they shall be.
    pub(crate) wishes: Vec<Wish>,
    pub(crate) wanted: Vec<Vec<f64>>,
    /// Slots that are wished themselves.
    pub(crate) alone: BTreeSet<SlotId>,
}

impl Planner {
    /// Opens a document: given values are taken from the host, the others are what rules make them.
    ///
    /// `values` are overwritten. Rules that cannot hold are reported; nothing is refused.
    pub fn open(
        &mut self,
        model: Model<'_>,
        values: &mut Values,
        host: &mut dyn Host,
    ) -> EditReport {
        let n = model.structure.slots.len();
        *values = Values::new(n);
        let mut has_value: IdVec<SlotId, bool> = IdVec::filled(false, n);
        for (slot, s) in model.structure.slots.iter() {
            if s.primitive.is_number() {
                continue;
            }
            values.put(slot, Value::Text("".into()));
        }
        for slot in model.structure.slots.ids() {
            if let Some(value) = host.given(slot, values) {
                if storable(model, slot, &value) {
                    values.put(slot, value);
                    has_value[slot] = true;
                }
            }
        }
        let holding = |slot: SlotId| {
            let resting = Self::resting_hold(model.structure, slot);
            if has_value[slot] { resting } else { Holding::Free }
        };
        let components = self.net.all(&self.rules, &|s| holding(s) == Holding::Fixed);
        let tasks = self.tasks(model.structure, &components, &holding, &[]);
        let mut report = EditReport { reached: true, ..EditReport::default() };
        let before = values.clone();
        for task in &tasks {
            let ran = run(self, model, task, &Aim::default(), &before, values, host);
            note(&mut report, ran);
        }
        report.unmet = self.unmet(model, 0..self.rules.len() as u32, values, host);
        report.changed = values.changed(&before).collect();
        self.latest = Latest { tasks, edited: None };
        report
    }

    /// Sets or moves targets, each to its values in order, as one edit.
    ///
    /// A refused edit leaves every bit as it was. A move that cannot reach its target comes as near
    /// as it can and says so; when it has ended, soft constraints act again.
    pub fn edit(
        &mut self,
        model: Model<'_>,
        values: &mut Values,
        kind: EditKind,
        targets: &[(Target<'_>, Vec<Value>)],
        host: &mut dyn Host,
    ) -> EditReport {
        let aim = match self.aim(model, values, kind, targets) {
            Ok(aim) => aim,
            Err(refusal) => return EditReport { refusal: Some(refusal), ..EditReport::default() },
        };
        match kind {
            EditKind::Move => move_at_once(self, model, values, aim, host),
            EditKind::Set => self.set(model, values, &aim, host),
        }
    }

    fn set(
        &mut self,
        model: Model<'_>,
        values: &mut Values,
        aim: &Aim,
        host: &mut dyn Host,
    ) -> EditReport {
        let mut scratch = values.clone();
        let tasks = self.plan_edit(model, aim);
        for (&slot, value) in &aim.fixed {
            scratch.put(slot, value.clone());
        }
        let mut report = EditReport::default();
        for task in &tasks {
            let ran = run(self, model, task, aim, values, &mut scratch, host);
            note(&mut report, ran);
        }
        let rules: BTreeSet<u32> =
            tasks.iter().flat_map(|t| t.component.rules.iter().copied()).collect();
        self.latest = Latest { tasks, edited: Some(aim.slots()) };
        report.unmet = self.unmet(model, rules.iter().copied(), &scratch, host);
        let was_unmet = self.unmet(model, rules, values, host);
        let is_new = |u: &Unmet| {
            u.level == Level::Required && was_unmet.iter().all(|w| w.source != u.source)
        };
        report.reached = self.reached(aim, &scratch);
        if report.refusal.is_none() && (report.unmet.iter().any(is_new) || !report.reached) {
            report.refusal = Some(RefusalReason::Unmet);
        }
        if report.refusal.is_none() {
            report.changed = scratch.changed(values).collect();
            *values = scratch;
        }
        report
    }

    /// Plans what an edit starts.
    pub(crate) fn plan_edit(&mut self, model: Model<'_>, aim: &Aim) -> Vec<Task> {
        let structure = model.structure;
        let holding = |slot: SlotId| {
            if aim.fixed.contains_key(&slot) {
                return Holding::Fixed;
            }
            match Self::resting_hold(structure, slot) {
                Holding::Fixed => Holding::Fixed,
                _ if aim.alone.contains(&slot) => Holding::Alone,
                held => held,
            }
        };
        let tied: Vec<Vec<SlotId>> =
            aim.wishes.iter().map(|w| slots_of(&self.arena, &w.expressions)).collect();
        let start: BTreeSet<SlotId> =
            aim.slots().into_iter().chain(tied.iter().flatten().copied()).collect();
        let is_fixed = |s| holding(s) == Holding::Fixed;
        let components = self.net.around(start, &self.rules, &is_fixed, &tied);
        self.tasks(structure, &components, &holding, &aim.wishes)
    }

    /// Lets soft constraints act when the wishes are withdrawn.
    pub(crate) fn settle(
        &mut self,
        model: Model<'_>,
        components: &[Component],
        values: &mut Values,
        host: &mut dyn Host,
    ) -> Option<Failure> {
        let is_soft = |&&r: &&u32| self.rules[r as usize].level != Level::Required;
        let soft: Vec<SlotId> = components
            .iter()
            .flat_map(|c| c.rules.iter().filter(is_soft))
            .flat_map(|&r| self.rules[r as usize].slots.clone())
            .collect();
        if soft.is_empty() {
            return None;
        }
        let holding = |s| Self::resting_hold(model.structure, s);
        let is_fixed = |s| holding(s) == Holding::Fixed;
        let components = self.net.around(soft, &self.rules, &is_fixed, &[]);
        let tasks = self.tasks(model.structure, &components, &holding, &[]);
        let start = values.clone();
        let aim = Aim::default();
        tasks.iter().find_map(|task| run(self, model, task, &aim, &start, values, host).failure)
    }

    /// Returns true if every wish is met and every set slot has its value.
    pub(crate) fn reached(&self, aim: &Aim, values: &Values) -> bool {
        let met = |(wish, wanted): (&Wish, &Vec<f64>)| {
            wish.expressions.iter().zip(wanted).all(|(&e, &w)| {
                let is = self.arena.evaluate(e, values.numbers.as_slice());
                agree(is, w, base::number::RULE_TOLERANCE)
            })
        };
        aim.wishes.iter().zip(&aim.wanted).all(met)
            && aim.fixed.iter().all(|(&s, v)| values.get(s).same_bits(v))
    }

    /// Finds which slots and expressions an edit speaks of.
    pub(crate) fn aim(
        &mut self,
        model: Model<'_>,
        values: &Values,
        kind: EditKind,
        targets: &[(Target<'_>, Vec<Value>)],
    ) -> Result<Aim, RefusalReason> {
        let mut aim = Aim::default();
        for (target, wanted) in targets {
            let leaves =
                self.leaves(model, *target).map_err(|t| RefusalReason::Target(t.message))?;
            if leaves.len() != wanted.len() {
                let message = format!("{} values for {} numbers", wanted.len(), leaves.len());
                return Err(RefusalReason::Target(message));
            }
            let mut wish = Wish { level: Level::Move, expressions: Vec::new() };
            let mut numbers = Vec::new();
            for (leaf, value) in leaves.into_iter().zip(wanted) {
                match (leaf, value) {
                    (Leaf::Slot(slot), value) if !storable(model, slot, value) => {
                        let primitive = model.structure.slots[slot].primitive;
                        let message = format!("{value:?} is no value for {primitive:?}");
                        return Err(RefusalReason::Target(message));
                    }
                    (Leaf::Slot(_), Value::Text(_)) if kind == EditKind::Move => {
                        let message = "a text is set, not moved";
                        return Err(RefusalReason::Target(message.into()));
                    }
                    (Leaf::Slot(slot), Value::Number(x)) if kind == EditKind::Move => {
                        aim.alone.insert(slot);
                        wish.expressions.push(self.arena.var(expr::Var(slot.0)));
                        numbers.push(x + 0.0);
                    }
                    (Leaf::Slot(slot), value) => {
                        let value = without_negative_zero(value);
                        if !lifts(model, *target, slot) && !values.get(slot).same_bits(&value) {
                            return Err(RefusalReason::Anchored(slot));
                        }
                        if aim.fixed.insert(slot, value.clone()).is_some_and(|v| v != value) {
                            let message = "one part is to have two values";
                            return Err(RefusalReason::Target(message.into()));
                        }
                    }
                    (Leaf::Expression(id), Value::Number(x)) if x.is_finite() => {
                        wish.expressions.push(id);
                        numbers.push(x + 0.0);
                    }
                    (Leaf::Expression(_), value) => {
                        let message = format!("{value:?} is not a number");
                        return Err(RefusalReason::Target(message));
                    }
                }
            }
            if kind == EditKind::Set {
                wish.level = Level::Required;
            }
            if !wish.expressions.is_empty() {
                aim.wishes.push(wish);
                aim.wanted.push(numbers);
            }
        }
        Ok(aim)
    }

    /// Aims a wish at one number, whatever it shall be.
    pub(crate) fn aim_at(&mut self, slot: SlotId) -> Aim {
        let variable = self.arena.var(expr::Var(slot.0));
        Aim {
            fixed: BTreeMap::new(),
            wishes: vec![Wish { level: Level::Move, expressions: vec![variable] }],
            wanted: vec![vec![0.0]],
            alone: BTreeSet::from([slot]),
        }
    }

    /// Returns the slots and expressions of a target, in order.
    fn leaves(&mut self, model: Model<'_>, target: Target<'_>) -> Result<Vec<Leaf>, Trouble> {
        match target {
            Target::Thing(thing) => {
                Ok(model.structure.slots_under(thing).into_iter().map(Leaf::Slot).collect())
            }
            Target::Term { me, term } => {
                let mut opening = Opening::new(model.document, model.structure, &mut self.arena);
                let meaning = opening.meaning(term, &Frame::of(me))?;
                let mut leaves = Vec::new();
                flatten(&mut opening, &meaning, &mut leaves)?;
                Ok(leaves)
            }
        }
    }
}

fn note(report: &mut EditReport, ran: Ran) {
    report.conflicts.extend(ran.conflicts);
    if report.refusal.is_none() {
        report.refusal = ran.failure.map(RefusalReason::Method);
    }
}

impl Aim {
    /// Returns the slots that an edit speaks of, by themselves or in an expression's name.
    pub(crate) fn slots(&self) -> BTreeSet<SlotId> {
        self.fixed.keys().copied().chain(self.alone.iter().copied()).collect()
    }
}

/// Gives every target the values that it has.
pub(crate) fn with_present_values<'t>(
    planner: &mut Planner,
    model: Model<'_>,
    values: &Values,
    targets: &[Target<'t>],
) -> Result<Vec<(Target<'t>, Vec<Value>)>, RefusalReason> {
    let present = |target: &Target<'t>| {
        let leaves = planner.leaves(model, *target)?;
        let value = |leaf: Leaf| match leaf {
            Leaf::Slot(slot) => values.get(slot),
            Leaf::Expression(id) => {
                Value::Number(planner.arena.evaluate(id, values.numbers.as_slice()))
            }
        };
        Ok((*target, leaves.into_iter().map(value).collect()))
    };
    let present: Result<Vec<_>, Trouble> = targets.iter().map(present).collect();
    present.map_err(|t| RefusalReason::Target(t.message))
}

/// What an edit can give a value to.
enum Leaf {
    Slot(SlotId),
    Expression(ExprId),
}

fn flatten<'a>(
    opening: &mut Opening<'a, '_>,
    meaning: &Meaning<'a>,
    leaves: &mut Vec<Leaf>,
) -> Result<(), Trouble> {
    if let Some(slot) = lone_slot(opening, meaning) {
        leaves.push(Leaf::Slot(slot));
        return Ok(());
    }
    match meaning {
        Meaning::Number(id) => leaves.push(Leaf::Expression(*id)),
        Meaning::Thing(t) => {
            leaves.extend(opening.structure.slots_under(*t).into_iter().map(Leaf::Slot));
        }
        Meaning::Made(made) => {
            for (_, field) in &made.fields {
                flatten(opening, field, leaves)?;
            }
        }
        Meaning::List(items) => {
            for item in items.iter() {
                flatten(opening, item, leaves)?;
            }
        }
        Meaning::Opaque(_) => {
            return Err(Trouble::not_yet("a computed text cannot be edited yet"));
        }
        Meaning::Lambda(_) => return Err(Trouble::wrong("a function cannot be edited")),
    }
    Ok(())
}

/// Returns true if the slot is not anchored, or by an anchor of exactly this target alone.
fn lifts(model: Model<'_>, target: Target<'_>, slot: SlotId) -> bool {
    let structure = model.structure;
    if !structure.slots[slot].anchored {
        return true;
    }
    let Target::Thing(thing) = target else { return false };
    structure
        .stays
        .iter()
        .filter(|s| s.strength.is_none() && structure.slots_under(s.thing).contains(&slot))
        .all(|s| structure.merged[s.thing] == structure.merged[thing])
}

/// Returns true if a slot may hold this value.
fn storable(model: Model<'_>, slot: SlotId, value: &Value) -> bool {
    let s = &model.structure.slots[slot];
    match value {
        Value::Text(_) => !s.primitive.is_number(),
        Value::Number(x) => match s.primitive {
            kernel::Primitive::Real(_) => x.is_finite(),
            kernel::Primitive::Integer => x.is_finite() && *x == x.trunc(),
            kernel::Primitive::Bool => *x == 0.0 || *x == 1.0,
            kernel::Primitive::Text | kernel::Primitive::Color => false,
        },
    }
}

fn without_negative_zero(value: &Value) -> Value {
    match value {
        Value::Number(x) => Value::Number(x + 0.0),
        Value::Text(t) => Value::Text(t.clone()),
    }
}

fn slots_of(arena: &expr::Arena, ids: &[ExprId]) -> Vec<SlotId> {
    let all: BTreeSet<SlotId> =
        ids.iter().flat_map(|&id| crate::meaning::slots_of_expression(arena, id)).collect();
    all.into_iter().collect()
}
