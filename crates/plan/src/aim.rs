//! Aims: which slots and expressions an edit speaks of, and what they shall be.

use crate::course::Guard;
use crate::edit::{EditKind, RefusalReason, Target};
use crate::evaluate::Opening;
use crate::fault::Trouble;
use crate::meaning::{Frame, Meaning};
use crate::planner::{Model, Planner};
use crate::rule::Formula;
use crate::say::lone_slot;
use crate::task::{Holding, Wish};
use base::number::shortest;
use expr::{Arena, Var};
use kernel::{Primitive, SlotId, Structure, Value, Values};
use solve::{Level, Patterns};
use std::collections::{BTreeMap, BTreeSet};

/// What an edit does to the slots, before anything is solved.
#[derive(Clone, Debug, Default)]
pub(crate) struct Aim {
    /// Slots that take a value as it is.
    pub(crate) fixed: BTreeMap<SlotId, Value>,
    /// Expressions that are wished, and what they shall be.
    pub(crate) wishes: Vec<Wish>,
    pub(crate) wanted: Vec<Vec<f64>>,
    /// Slots that are wished themselves.
    pub(crate) alone: BTreeSet<SlotId>,
    /// Whether it sets several things at once.
    pub(crate) sets_several: bool,
    /// The course on which programs draw what is wished.
    pub(crate) guards: Vec<Guard>,
}

impl Planner {
    /// Returns true if every wish is met and every set slot has its value; what only stays if it can is no wish.
    pub(crate) fn reached(&self, aim: &Aim, values: &Values) -> bool {
        let met = |(wish, wanted): (&Wish, &Vec<f64>)| {
            wish.level == Level::MediumStay
                || wish.formulas.iter().zip(wanted).all(|(f, &w)| {
                    let is = f.value(self.plans.patterns(), &values.numbers);
                    base::number::close(is, w)
                })
        };
        aim.wishes.iter().zip(&aim.wanted).all(met)
            && aim.fixed.iter().all(|(&s, v)| values.get(s).same_bits(v))
    }

    /// Finds which slots and expressions an edit speaks of. What programs draw is meant on the course that they take
    /// at `on`.
    pub(crate) fn aim(
        &mut self,
        model: Model<'_>,
        (values, on): (&Values, &Values),
        kind: EditKind,
        targets: &[(Target<'_>, Vec<Value>)],
    ) -> Result<Aim, RefusalReason> {
        let sets_several = kind == EditKind::Set && targets.len() > 1;
        let mut aim = Aim { sets_several, ..Aim::default() };
        for (target, wanted) in targets {
            let found = self.leaves(model, *target, on);
            let (leaves, guards) = found.map_err(|t| RefusalReason::Target(t.message))?;
            aim.guards.extend(guards);
            if leaves.len() != wanted.len() {
                let message = format!("{} values for {} numbers", wanted.len(), leaves.len());
                return Err(RefusalReason::Target(message));
            }
            let mut wish = Wish { level: Level::Move, formulas: Vec::new() };
            let mut numbers = Vec::new();
            for (leaf, value) in leaves.into_iter().zip(wanted) {
                let near = match leaf {
                    Leaf::Slot(slot) if kind == EditKind::Move => nearest(model, slot, value),
                    Leaf::Slot(_) | Leaf::Formula(_) => None,
                };
                match (leaf, near.as_ref().unwrap_or(value)) {
                    (Leaf::Slot(slot), value) if !storable(model, slot, value) => {
                        if model.structure.ranges.contains_key(&slot) && kind == EditKind::Set {
                            return Err(RefusalReason::OutOfRange(slot));
                        }
                        let wanted = match model.structure.slots[slot].primitive {
                            Primitive::Real(_) => "a number",
                            Primitive::Integer => "a whole number",
                            Primitive::Bool => "true or false",
                            Primitive::Choice(_) => "one of its options",
                            Primitive::Text => "a text",
                            Primitive::Color => "a colour",
                        };
                        let message = format!("wanted {wanted}, not {}", in_words(value));
                        return Err(RefusalReason::Target(message));
                    }
                    (Leaf::Slot(_), Value::Text(_)) if kind == EditKind::Move => {
                        let message = "a text is set, not moved";
                        return Err(RefusalReason::Target(message.into()));
                    }
                    (Leaf::Slot(slot), Value::Number(x)) if kind == EditKind::Move => {
                        aim.alone.insert(slot);
                        wish.formulas.push(self.itself(slot));
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
                    (Leaf::Formula(formula), Value::Number(x)) if x.is_finite() => {
                        wish.formulas.push(formula);
                        numbers.push(x + 0.0);
                    }
                    (Leaf::Formula(_), value) => {
                        let message = format!("wanted a number, not {}", in_words(value));
                        return Err(RefusalReason::Target(message));
                    }
                }
            }
            if kind == EditKind::Set {
                wish.level = Level::Required;
            }
            if !wish.formulas.is_empty() {
                aim.wishes.push(wish);
                aim.wanted.push(numbers);
            }
        }
        Ok(aim)
    }

    /// Finds what is moved from where it is at `values`, and what stays there meanwhile if it can.
    pub(crate) fn aim_keeping(
        &mut self,
        model: Model<'_>,
        (values, on): (&Values, &Values),
        targets: &[Target<'_>],
        kept: &[Target<'_>],
    ) -> Result<Aim, RefusalReason> {
        let wanted = with_present_values(self, model, values, targets)?;
        let mut aim = self.aim(model, (values, on), EditKind::Move, &wanted)?;
        let stays = with_present_values(self, model, values, kept)?;
        let stays = self.aim(model, (values, on), EditKind::Move, &stays)?;
        for (wish, wanted) in stays.wishes.into_iter().zip(stays.wanted) {
            aim.wishes.push(Wish { level: Level::MediumStay, ..wish });
            aim.wanted.push(wanted);
        }
        aim.guards.extend(stays.guards);
        Ok(aim)
    }

    /// Returns a slot as an expression.
    fn itself(&mut self, slot: SlotId) -> Formula<SlotId> {
        let mut arena = Arena::new();
        let variable = arena.var(Var(slot.0));
        Formula::of(self.plans.patterns_mut(), &arena, &[variable])
    }

    /// Aims a wish at one number, whatever it shall be.
    pub(crate) fn aim_at(&mut self, slot: SlotId) -> Aim {
        let itself = self.itself(slot);
        Aim {
            fixed: BTreeMap::new(),
            wishes: vec![Wish { level: Level::Move, formulas: vec![itself] }],
            wanted: vec![vec![0.0]],
            alone: BTreeSet::from([slot]),
            sets_several: false,
            guards: Vec::new(),
        }
    }

    /// Returns the slots and expressions of a target, in order.
    fn leaves(
        &mut self,
        model: Model<'_>,
        target: Target<'_>,
        on: &Values,
    ) -> Result<(Vec<Leaf>, Vec<Guard>), Trouble> {
        match target {
            Target::Thing(thing) => {
                let slots = model.structure.slots_under(thing).into_iter();
                Ok((slots.map(Leaf::Slot).collect(), Vec::new()))
            }
            Target::Term { me, term } => {
                let mut opening = Opening::new(model.document, model.structure);
                opening.at = Some(on);
                opening.begin(me);
                let meaning = opening.meaning(term, &Frame::of(me))?;
                let mut leaves = Vec::new();
                flatten(&mut opening, self.plans.patterns_mut(), &meaning, &mut leaves)?;
                Ok((leaves, opening.guards(self.plans.patterns_mut())))
            }
        }
    }
}

impl Aim {
    /// Returns what holds a slot in the edit.
    pub(crate) fn holding(&self, structure: &Structure, slot: SlotId) -> Holding {
        if self.fixed.contains_key(&slot) {
            return Holding::Fixed;
        }
        match Planner::resting_hold(structure, slot) {
            Holding::Fixed => Holding::Fixed,
            _ if self.alone.contains(&slot) => Holding::Alone,
            held => held,
        }
    }
    /// Returns the slots that an edit speaks of, by themselves or in an expression's name.
    pub(crate) fn slots(&self) -> BTreeSet<SlotId> {
        self.fixed.keys().copied().chain(self.alone.iter().copied()).collect()
    }
}

/// Gives every target the values that it has.
fn with_present_values<'t>(
    planner: &mut Planner,
    model: Model<'_>,
    values: &Values,
    targets: &[Target<'t>],
) -> Result<Vec<(Target<'t>, Vec<Value>)>, RefusalReason> {
    let present = |target: &Target<'t>| {
        let (leaves, _) = planner.leaves(model, *target, values)?;
        let value = |leaf: Leaf| match leaf {
            Leaf::Slot(slot) => values.get(slot),
            Leaf::Formula(f) => Value::Number(f.value(planner.plans.patterns(), &values.numbers)),
        };
        Ok((*target, leaves.into_iter().map(value).collect()))
    };
    let present: Result<Vec<_>, Trouble> = targets.iter().map(present).collect();
    present.map_err(|t| RefusalReason::Target(t.message))
}

/// What an edit can give a value to.
enum Leaf {
    Slot(SlotId),
    Formula(Formula<SlotId>),
}

fn flatten<'a>(
    opening: &mut Opening<'a>,
    patterns: &mut Patterns,
    meaning: &Meaning<'a>,
    leaves: &mut Vec<Leaf>,
) -> Result<(), Trouble> {
    if let Some(slot) = lone_slot(opening, meaning) {
        leaves.push(Leaf::Slot(slot));
        return Ok(());
    }
    match meaning {
        Meaning::Number(id) => {
            leaves.push(Leaf::Formula(Formula::of(patterns, &opening.arena, &[*id])));
        }
        Meaning::Thing(t) => {
            leaves.extend(opening.structure.slots_under(*t).into_iter().map(Leaf::Slot));
        }
        Meaning::Made(made) => {
            for (_, field) in &made.fields {
                flatten(opening, patterns, field, leaves)?;
            }
        }
        Meaning::List(items) => {
            for item in items.iter() {
                flatten(opening, patterns, item, leaves)?;
            }
        }
        Meaning::Opaque(_) => {
            return Err(Trouble::not_yet(match (opening.meets_counts, opening.has_courses) {
                (true, _) => {
                    "how many there are follows one way only: this is not edited through it"
                }
                (false, true) => "what is drawn here follows from its program one way only",
                (false, false) => "a computed text cannot be edited yet",
            }));
        }
        Meaning::Lambda(_) => return Err(Trouble::wrong("a function cannot be edited")),
        Meaning::Drawn(drawn) => {
            for entry in drawn.made.iter().filter(|e| e.is_result) {
                flatten(opening, patterns, &entry.meaning, leaves)?;
            }
        }
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
pub(crate) fn storable(model: Model<'_>, slot: SlotId, value: &Value) -> bool {
    let s = &model.structure.slots[slot];
    match value {
        Value::Text(_) => !s.primitive.is_number(),
        Value::Number(x) => match s.primitive {
            Primitive::Real(_) => x.is_finite(),
            Primitive::Integer | Primitive::Choice(_) => {
                let range = model.structure.ranges.get(&slot);
                let is_in = |&(low, high): &(i64, i64)| (low as f64..=high as f64).contains(x);
                x.is_finite() && *x == x.trunc() && range.is_none_or(is_in)
            }
            Primitive::Bool => *x == 0.0 || *x == 1.0,
            Primitive::Text | Primitive::Color => false,
        },
    }
}

/// Returns the value that a slot may hold which is nearest to a number: of whole numbers the nearest in their domain.
/// Nothing for what is near to none.
pub(crate) fn nearest(model: Model<'_>, slot: SlotId, value: &Value) -> Option<Value> {
    let Value::Number(x) = *value else { return None };
    let (low, high) = match model.structure.slots[slot].primitive {
        Primitive::Integer | Primitive::Choice(_) => match model.structure.ranges.get(&slot) {
            Some(&(low, high)) => (low as f64, high as f64),
            None => (f64::NEG_INFINITY, f64::INFINITY),
        },
        Primitive::Bool => (0.0, 1.0),
        Primitive::Real(_) | Primitive::Text | Primitive::Color => return None,
    };
    let near = x.round().max(low).min(high) + 0.0;
    near.is_finite().then_some(Value::Number(near))
}

/// Writes a value as people do.
pub(crate) fn in_words(value: &Value) -> String {
    match value {
        Value::Number(x) => shortest(*x),
        Value::Text(text) => format!("\"{text}\""),
    }
}

fn without_negative_zero(value: &Value) -> Value {
    match value {
        Value::Number(x) => Value::Number(x + 0.0),
        Value::Text(t) => Value::Text(t.clone()),
    }
}
