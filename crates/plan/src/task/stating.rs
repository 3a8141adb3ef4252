//! Stating: a component in an edit, its slots, rules and wishes numbered within it, as a conditional system.

use super::{Holding, Locals, Number, Origin, Setting, Wish};
use crate::component::Component;
use crate::rule::{self, Beside, Body, ByHost, How, Position, Rule, SideOf, When};
use base::number::Tolerance;
use expr::Dimension;
use kernel::{Primitive, SlotId};
use solve::{
    Condition, Conditional, Demand, DemandKind, Guard, Level, Method, MethodBody, PatternId,
    Patterns, Relation, RelationBody, Seldom, SlotIndex, SlotRange, Span, Stay, System, TRUTH,
};

/// That a condition is true, or that it is false.
struct Guarding {
    condition: u32,
    truth: bool,
}

/// A system in the making.
pub(super) struct Making<'s> {
    setting: &'s Setting<'s>,
    component: &'s Component,
    locals: &'s mut Locals,
    pub(super) conditional: Conditional,
    pub(super) holds: Vec<(SlotIndex, SlotIndex)>,
    pub(super) targets: Vec<(SlotIndex, u32, u32)>,
    pub(super) numbers: Vec<(SlotIndex, Number)>,
    /// What the host computes that is true or not: where which constraint says it.
    truths: Vec<(Option<u32>, SideOf, SlotIndex)>,
    pub(super) relations: Vec<Origin>,
}

impl<'s> Making<'s> {
    pub(super) fn new(
        setting: &'s Setting<'s>,
        locals: &'s mut Locals,
        component: &'s Component,
    ) -> Self {
        // by their scales; truth values have none
        let mut dimensions = Vec::with_capacity(4);
        dimensions.extend([Some(Dimension::NONE), None]);
        debug_assert!(dimensions[usize::from(TRUTH)].is_none());
        // of a kind there are many, as a rule
        let mut latest: Option<(Primitive, solve::Slot)> = None;
        let mut groups = 0;
        let mut system = System::default();
        let rules = component.rules();
        let mentioned = |&r: &u32| {
            let rule = setting.rules.get(r);
            rule.slots.len() + rule.shape.reads.len()
        };
        let mentioned: usize = rules.iter().map(mentioned).sum();
        // what wishes add has room too, so that nothing is moved for the last few
        let wishes = setting.wishes;
        let coordinates: usize = wishes.iter().map(|w| w.formulas.len()).sum();
        let wished = wishes.iter().flat_map(|w| &w.formulas).map(|f| f.slots.len() + 1);
        system.slots.reserve(component.slots().len() + coordinates);
        system.relations.reserve(rules.len() + wishes.len());
        system.equations.reserve(rules.len() + coordinates);
        system.arguments.reserve(mentioned + wished.sum::<usize>());
        for &slot in component.slots() {
            let s = &setting.structure.slots[slot];
            let stay = match (setting.holding)(slot) {
                Holding::Fixed => Stay::Fixed,
                Holding::Given(giver) => Stay::Given(giver),
                Holding::Free => Stay::Free,
                held @ (Holding::Kept | Holding::Alone) => {
                    // the coordinates of a place have the group of the first that is kept with it
                    let place =
                        if held == Holding::Kept { setting.net.place_of(slot) } else { &[] };
                    let first = place
                        .iter()
                        .take_while(|&&s| s < slot)
                        .find(|&&s| {
                            (setting.holding)(s) == Holding::Kept
                                && component.slots().get(locals.0[s] as usize) == Some(&s)
                        })
                        .map(|&s| system.slots[locals.0[s] as usize].stay);
                    first.unwrap_or_else(|| {
                        groups += 1;
                        Stay::Kept { group: groups - 1 }
                    })
                }
            };
            let like = match &latest {
                Some((primitive, like)) if *primitive == s.primitive => like.clone(),
                Some(_) | None => {
                    let own = s.primitive.dimension();
                    let dimension = Some(own)
                        .filter(|_| !matches!(s.primitive, Primitive::Bool | Primitive::Choice(_)));
                    let known = dimensions.iter().position(|&d| d == dimension);
                    let scale = known.unwrap_or_else(|| {
                        dimensions.push(dimension);
                        dimensions.len() - 1
                    }) as u16;
                    let (is_number, is_discrete) =
                        (s.primitive.is_number(), s.primitive.is_whole());
                    let like = solve::Slot { stay, scale, is_number, is_discrete };
                    latest.insert((s.primitive, like)).1.clone()
                }
            };
            system.slots.push(solve::Slot { stay, ..like });
        }
        Self {
            setting,
            component,
            locals,
            conditional: Conditional { system, ..Conditional::default() },
            holds: Vec::new(),
            targets: Vec::new(),
            numbers: Vec::new(),
            truths: Vec::new(),
            relations: Vec::with_capacity(rules.len() + wishes.len()),
        }
    }

    /// Returns where a slot of the component stands in it.
    fn local(&self, slot: SlotId) -> SlotIndex {
        self.locals.0[slot]
    }
    fn locals(&self, rule: Rule<'_>, positions: &[Position]) -> Vec<SlotIndex> {
        rule.slots_at(positions).map(|s| self.local(s)).collect()
    }

    /// Adds a known slot of the same kind as another.
    fn known_like(&mut self, slot: SlotIndex) -> SlotIndex {
        let like = self.conditional.system.slots[slot as usize].clone();
        self.conditional.system.slots.push(solve::Slot { stay: Stay::Fixed, ..like });
        self.conditional.system.slots.len() as SlotIndex - 1
    }

    pub(super) fn rule(&mut self, position: u32, index: u32) {
        let rule = self.setting.rules.get(index);
        let shape = rule.shape;
        let whens: Vec<Guarding> = (0..)
            .zip(&shape.when)
            .map(|(at, when)| self.guarding(rule, (position, at), when))
            .collect();
        let body = match &shape.body {
            Body::Equations(equations) => {
                let locals = &self.locals.0;
                RelationBody::Equations(
                    self.conditional.system.add_equations(
                        equations
                            .iter()
                            .map(|e| (e.pattern, rule.slots_at(&e.slots).map(|s| locals[s]))),
                    ),
                )
            }
            Body::True(formula) => {
                let slots = self.locals(rule, &formula.slots);
                self.demand(formula.pattern, slots, DemandKind::True)
            }
            Body::Beside(beside) => {
                let mut slots = self.locals(rule, &beside.truth.slots);
                let number = self.number(rule, position, beside);
                slots.insert(beside.place as usize, number);
                self.demand(beside.truth.pattern, slots, DemandKind::True)
            }
            Body::Different(formula) => {
                let slots = self.locals(rule, &formula.slots);
                self.demand(formula.pattern, slots, DemandKind::Different)
            }
            Body::Opaque(slots) => RelationBody::Opaque { slots: self.locals(rule, slots).into() },
            Body::Hold(slots) => {
                // What has no value yet cannot be held.
                let held: Vec<SlotId> = rule
                    .slots_at(slots)
                    .filter(|&s| (self.setting.holding)(s) != Holding::Free)
                    .collect();
                if held.is_empty() {
                    return;
                }
                let mut equations = Vec::new();
                for slot in held {
                    let local = self.local(slot);
                    let known = self.known_like(local);
                    self.holds.push((known, local));
                    equations.push((Patterns::SAME, [local, known]));
                }
                RelationBody::Equations(self.conditional.system.add_equations(equations))
            }
        };
        let mut methods = Vec::with_capacity(shape.methods.len());
        for m in &shape.methods {
            let body = match &m.how {
                How::Formulas(f) => {
                    let locals = &self.locals.0;
                    let slots = rule.slots_at(&f.slots).map(|s| locals[s]);
                    let arguments = self.conditional.system.add_arguments(slots);
                    MethodBody::Formulas { pattern: f.pattern, arguments }
                }
                How::Host(_) | How::Copy => {
                    MethodBody::Opaque { reads: self.locals(rule, &m.reads) }
                }
            };
            methods.push(Method { targets: self.locals(rule, &m.targets), body });
        }
        whens.into_iter().for_each(|when| self.guard(when));
        let rests = shape.when.is_empty() && self.rests(rule);
        let source = self.relations.len() as u32;
        self.relations.push(Origin::Rule(position));
        let reads = match shape.reads[..] {
            [] => Span::default(),
            _ => {
                let reads = rule.slots_at(&shape.reads).map(|s| self.locals.0[s]);
                self.conditional.system.add_arguments(reads)
            }
        };
        self.conditional.system.relations.push(Relation {
            level: shape.level,
            body,
            methods: methods.into(),
            derived: shape.derived,
            reads,
            within: shape.within,
            source,
            rests,
        });
    }

    /// Returns true if equations hold where an edit begins, and speak of nothing that it gives a value.
    fn rests(&self, rule: Rule<'_>) -> bool {
        let Some(is_edited) = self.setting.is_edited else { return false };
        let holds = match rule.shape.body {
            Body::Equations(_) => rule.shape.level == Level::Required,
            Body::Hold(_) => true,
            Body::True(_) | Body::Beside(_) | Body::Different(_) | Body::Opaque(_) => false,
        };
        holds && !rule.slots.iter().any(|&slot| is_edited(slot))
    }

    /// Demands what no equation says, of the relation that is added next.
    fn demand(
        &mut self,
        pattern: PatternId,
        slots: Vec<SlotIndex>,
        kind: DemandKind,
    ) -> RelationBody {
        let relation = self.conditional.system.relations.len() as u32;
        let arguments = self.conditional.system.add_arguments(slots);
        self.conditional.demands.push(Demand { relation, kind, pattern, arguments });
        RelationBody::Equations(Span::default())
    }

    /// Adds a slot for what the host computes beside a comparison, and the relation that computes it.
    fn number(&mut self, rule: Rule<'_>, position: u32, beside: &Beside) -> SlotIndex {
        let reads = self.locals(rule, &beside.reads);
        let like = self.local(rule.slots[beside.truth.slots[0] as usize]);
        let scale = self.conditional.system.slots[like as usize].scale;
        self.computed(scale, reads, Number { rule: position, when: None })
    }

    /// Returns the slot for a truth value that the host computes; where there is none yet one is added.
    fn truth(&mut self, rule: Rule<'_>, (position, at): (u32, u32), by: &ByHost) -> SlotIndex {
        let constraint = by.constraint_of(rule);
        let known = self.truths.iter().find(|t| (t.0, t.1) == (constraint, by.side));
        if let Some(&(_, _, truth)) = known {
            return truth;
        }
        let reads = self.locals(rule, &by.reads);
        let truth = self.computed(TRUTH, reads, Number { rule: position, when: Some(at) });
        self.truths.push((constraint, by.side, truth));
        truth
    }

    /// Adds a slot for what the host computes from others, and the relation that computes it.
    fn computed(&mut self, scale: u16, reads: Vec<SlotIndex>, number: Number) -> SlotIndex {
        let slots = &mut self.conditional.system.slots;
        let group = |s: &solve::Slot| match s.stay {
            Stay::Kept { group } => Some(group),
            Stay::Fixed | Stay::Given(_) | Stay::Free => None,
        };
        let group = slots.iter().filter_map(group).max().map_or(0, |latest| latest + 1);
        let stay = Stay::Kept { group };
        slots.push(solve::Slot { stay, scale, is_number: true, is_discrete: false });
        let slot = slots.len() as SlotIndex - 1;
        self.numbers.push((slot, number));
        let source = self.relations.len() as u32;
        self.relations.push(Origin::Number(number));
        let body = MethodBody::Opaque { reads: reads.clone() };
        self.conditional.system.relations.push(Relation {
            level: Level::Required,
            body: RelationBody::Opaque { slots: reads.into_iter().chain([slot]).collect() },
            methods: vec![Method { targets: vec![slot], body }].into(),
            derived: false,
            reads: Span::default(),
            within: Tolerance::Relative,
            source,
            rests: false,
        });
        slot
    }

    /// States a condition under which a rule holds.
    fn guarding(&mut self, rule: Rule<'_>, at: (u32, u32), when: &When) -> Guarding {
        let (pattern, slots) = match &when.condition {
            rule::Condition::Numbers(formula) => {
                (formula.pattern, self.locals(rule, &formula.slots))
            }
            rule::Condition::Host(by) => (by.pattern, vec![self.truth(rule, at, by)]),
        };
        let same = |c: &Condition| {
            c.pattern == pattern && self.conditional.system.arguments(c.arguments) == slots
        };
        let condition = match self.conditional.conditions.iter().position(same) {
            Some(known) => known,
            None => {
                let arguments = self.conditional.system.add_arguments(slots);
                self.conditional.conditions.push(Condition { pattern, arguments });
                self.conditional.conditions.len() - 1
            }
        } as u32;
        Guarding { condition, truth: when.truth }
    }

    /// Makes the relation that is added next hold under a condition alone.
    fn guard(&mut self, Guarding { condition, truth }: Guarding) {
        let relation = self.conditional.system.relations.len() as u32;
        self.conditional.guards.push(Guard { relation, condition, truth });
    }

    /// States what the component's whole numbers may be.
    pub(super) fn ranges(&mut self) {
        let structure = self.setting.structure;
        for (&slot, local) in self.component.slots().iter().zip(0..) {
            let is_by_class = structure.slots[slot].primitive == Primitive::Bool;
            let by_class = is_by_class.then_some((0, 1));
            if let Some((low, high)) = structure.ranges.get(&slot).copied().or(by_class) {
                self.conditional.ranges.push(SlotRange { slot: local, low, high, is_by_class });
            }
        }
    }

    /// Returns where a slot stands in the component, if it does.
    fn find(&self, slot: SlotId) -> Option<SlotIndex> {
        let local = self.locals.0[slot];
        (self.component.slots().get(local as usize) == Some(&slot)).then_some(local)
    }

    /// Adds a wish if it speaks of this component.
    pub(super) fn wish(&mut self, patterns: &mut Patterns, index: u32, wish: &Wish) {
        let mut equations = Vec::new();
        for (coordinate, formula) in (0..).zip(&wish.formulas) {
            let locals: Option<Vec<SlotIndex>> =
                formula.slots.iter().map(|&s| self.find(s)).collect();
            let moves =
                |&&i: &&SlotIndex| self.conditional.system.slots[i as usize].stay != Stay::Fixed;
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
        let equations = self.conditional.system.add_equations(equations);
        let source = self.relations.len() as u32;
        self.relations.push(Origin::Wish(index));
        self.conditional.system.relations.push(Relation {
            level: wish.level,
            body: RelationBody::Equations(equations),
            methods: Seldom::default(),
            derived: true,
            reads: Span::default(),
            within: Tolerance::Relative,
            source,
            rests: false,
        });
    }
}
