//! Tasks: one component in one edit, stated as a system with slots and rules numbered within it.
//!
//! Equal components have equal systems whatever their slots and rules are called in the document,
//! so that one plan serves all of them.

use crate::component::Component;
use crate::plans::Plans;
use crate::rule::{Body, Formula, How, Rule, Source};
use base::IdVec;
use indexmap::IndexMap;
use kernel::{Primitive, SlotId, Structure};
use solve::{
    Level, Method, MethodBody, PatternId, Patterns, Plan, Relation, RelationBody, SlotIndex, Span,
    Stay, System,
};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// What holds a slot of the document in an edit.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Holding {
    /// Anchored, or set in this edit.
    Fixed,
    /// A given number.
    Given,
    /// Its present value, with the other coordinates of its place.
    Kept,
    /// Its present value, alone: a coordinate that the edit speaks of.
    Alone,
    /// Nothing yet.
    Free,
}

/// Expressions that shall take the values of a target.
#[derive(Clone, Debug)]
pub(crate) struct Wish {
    pub(crate) level: Level,
    /// One for each coordinate.
    pub(crate) formulas: Vec<Formula>,
}

impl Wish {
    /// Returns the slots that it speaks of, in order.
    pub(crate) fn slots(&self) -> Vec<SlotId> {
        let all: BTreeSet<SlotId> = self.formulas.iter().flat_map(|f| f.slots.to_vec()).collect();
        all.into_iter().collect()
    }
}

/// One component in one edit.
#[derive(Clone, Debug)]
pub(crate) struct Task {
    pub(crate) system: Rc<System>,
    pub(crate) plan: Rc<Plan>,
    /// The rules and slots of the document that it is about. Its slots are the system's first.
    pub(crate) component: Component,
    /// Slots of the system that hold what another had when the edit began.
    pub(crate) holds: Vec<(SlotIndex, SlotId)>,
    /// Slots of the system that hold coordinates of wishes: wish and coordinate.
    pub(crate) targets: Vec<(SlotIndex, u32, u32)>,
    /// For every source in the system, the rule or the wish that it is.
    pub(crate) relations: Vec<Origin>,
}

/// What a relation of a system comes from.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Origin {
    /// The rule of this index.
    Rule(u32),
    /// The wish of this index in the edit.
    Wish(u32),
}

/// What makes a task besides its component.
pub(crate) struct Setting<'s> {
    pub(crate) structure: &'s Structure,
    pub(crate) rules: &'s [Rule],
    pub(crate) holding: &'s dyn Fn(SlotId) -> Holding,
    /// Wishes by their index in the edit.
    pub(crate) wishes: &'s [Wish],
}

/// States a component as a system and plans it.
pub(crate) fn task(plans: &mut Plans, setting: &Setting<'_>, component: &Component) -> Task {
    let mut making = Making::new(setting, plans.patterns_mut().same(), component);
    for &rule in &component.rules {
        making.rule(rule);
    }
    for (index, wish) in (0..).zip(setting.wishes) {
        making.wish(plans.patterns_mut(), index, wish);
    }
    let Making { system, holds, targets, relations, .. } = making;
    let (system, plan) = plans.plan(system);
    let component = component.clone();
    Task { system, plan, component, holds, targets, relations }
}

struct Making<'s> {
    setting: &'s Setting<'s>,
    local: BTreeMap<SlotId, SlotIndex>,
    /// What says that two slots are equal.
    same: PatternId,
    system: System,
    holds: Vec<(SlotIndex, SlotId)>,
    targets: Vec<(SlotIndex, u32, u32)>,
    relations: Vec<Origin>,
}

impl<'s> Making<'s> {
    fn new(setting: &'s Setting<'s>, same: PatternId, component: &Component) -> Self {
        let mut scales = IndexMap::new();
        let mut groups = IndexMap::new();
        let mut system = System::default();
        for &slot in &component.slots {
            let s = &setting.structure.slots[slot];
            let stay = match (setting.holding)(slot) {
                Holding::Fixed => Stay::Fixed,
                Holding::Given => Stay::Given,
                Holding::Free => Stay::Free,
                Holding::Kept => {
                    let place = s.place.unwrap_or(s.thing);
                    Stay::Kept { group: number_of(&mut groups, place) }
                }
                Holding::Alone => Stay::Kept { group: number_of(&mut groups, s.thing) },
            };
            let dimension = match s.primitive {
                Primitive::Real(dimension) => Some(dimension),
                Primitive::Integer | Primitive::Bool | Primitive::Text | Primitive::Color => None,
            };
            let is_discrete = match s.primitive {
                Primitive::Integer | Primitive::Bool => true,
                Primitive::Real(_) | Primitive::Text | Primitive::Color => false,
            };
            let scale = number_of(&mut scales, dimension.unwrap_or_default()) as u16;
            let is_number = s.primitive.is_number();
            system.slots.push(solve::Slot { stay, scale, is_number, is_discrete });
        }
        Self {
            setting,
            same,
            local: component.slots.iter().copied().zip(0..).collect(),
            system,
            holds: Vec::new(),
            targets: Vec::new(),
            relations: Vec::new(),
        }
    }

    fn local(&self, slots: &[SlotId]) -> Vec<SlotIndex> {
        slots.iter().map(|s| self.local[s]).collect()
    }

    /// Adds the slots of a formula as arguments.
    fn arguments(&mut self, slots: &[SlotId]) -> Span {
        let local = &self.local;
        self.system.add_arguments(slots.iter().map(|s| local[s]))
    }

    /// Adds a known slot of the same kind as another.
    fn known_like(&mut self, slot: SlotIndex) -> SlotIndex {
        let like = self.system.slots[slot as usize].clone();
        self.system.slots.push(solve::Slot { stay: Stay::Fixed, ..like });
        self.system.slots.len() as SlotIndex - 1
    }

    fn rule(&mut self, index: u32) {
        let rule = &self.setting.rules[index as usize];
        let body = match &rule.body {
            Body::Equations(equations) => {
                let local = &self.local;
                RelationBody::Equations(self.system.add_equations(
                    equations.iter().map(|e| (e.pattern, e.slots.iter().map(|s| local[s]))),
                ))
            }
            Body::Opaque(slots) => RelationBody::Opaque { slots: self.local(slots) },
            Body::Hold(slots) => {
                // What has no value yet cannot be held.
                let slots: Vec<SlotId> = slots
                    .iter()
                    .copied()
                    .filter(|&s| (self.setting.holding)(s) != Holding::Free)
                    .collect();
                if slots.is_empty() {
                    return;
                }
                let mut equations = Vec::new();
                for slot in slots {
                    let local = self.local[&slot];
                    let known = self.known_like(local);
                    self.holds.push((known, slot));
                    equations.push((self.same, [local, known]));
                }
                RelationBody::Equations(self.system.add_equations(equations))
            }
        };
        let methods = rule.methods.iter().map(|m| Method {
            targets: self.local(&m.targets),
            body: match &m.how {
                How::Formulas(f) => {
                    MethodBody::Formulas { pattern: f.pattern, arguments: self.arguments(&f.slots) }
                }
                How::Host(_) | How::Copy => MethodBody::Opaque { reads: self.local(&m.reads) },
            },
        });
        let methods = methods.collect();
        let source = self.relations.len() as u32;
        self.relations.push(Origin::Rule(index));
        self.system.relations.push(Relation {
            level: rule.level,
            body,
            methods,
            derived: rule.derived,
            reads: self.local(&rule.reads),
            within: rule.within.to_bits(),
            source,
        });
    }

    /// Adds a wish if it speaks of this component.
    fn wish(&mut self, patterns: &mut Patterns, index: u32, wish: &Wish) {
        let mut equations = Vec::new();
        for (coordinate, formula) in (0..).zip(&wish.formulas) {
            let locals: Option<Vec<SlotIndex>> =
                formula.slots.iter().map(|s| self.local.get(s).copied()).collect();
            let moves = |&&i: &&SlotIndex| self.system.slots[i as usize].stay != Stay::Fixed;
            let Some(locals) = locals else { continue };
            let Some(&first) = locals.iter().find(moves) else { continue };
            let known = self.known_like(first);
            self.targets.push((known, index, coordinate));
            let mut arguments = locals;
            arguments.push(known);
            equations.push((patterns.wanting(formula.pattern), arguments));
        }
        if equations.is_empty() {
            return;
        }
        let equations = self.system.add_equations(equations);
        let source = self.relations.len() as u32;
        self.relations.push(Origin::Wish(index));
        self.system.relations.push(Relation {
            level: wish.level,
            body: RelationBody::Equations(equations),
            methods: Vec::new(),
            derived: true,
            reads: Vec::new(),
            within: base::number::RULE_TOLERANCE.to_bits(),
            source,
        });
    }
}

fn number_of<K: std::hash::Hash + Eq>(numbers: &mut IndexMap<K, u32>, key: K) -> u32 {
    let next = numbers.len() as u32;
    *numbers.entry(key).or_insert(next)
}

impl Task {
    /// Returns what a relation of the system comes from.
    pub(crate) fn source(&self, rules: &[Rule], relation: u32) -> Source {
        match self.relations[self.system.relations[relation as usize].source as usize] {
            Origin::Rule(r) => rules[r as usize].source,
            Origin::Wish(w) => Source::Wish(w),
        }
    }
    /// Reads the numbers of the document into the system's slots; targets are left at zero.
    pub(crate) fn gather(&self, numbers: &IdVec<SlotId, f64>) -> Vec<f64> {
        let mut local = vec![0.0; self.system.slots.len()];
        for (x, &slot) in local.iter_mut().zip(&self.component.slots) {
            *x = numbers[slot];
        }
        for &(known, slot) in &self.holds {
            local[known as usize] = numbers[slot];
        }
        local
    }
}
