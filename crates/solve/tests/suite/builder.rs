//! A small language for systems in tests: `number` makes slots, operators make equations.

use expr::{Arena, Binary, ExprId, Var};
use solve::{
    Drag, Host, Level, Method, MethodBody, NoHost, Outcome, Patterns, Plan, Relation, RelationBody,
    Runner, Slot, SlotIndex, Stay, System,
};
use std::rc::Rc;

/// A system under construction, with the state that it starts from.
#[derive(Default)]
pub(crate) struct Sheet {
    pub(crate) system: System,
    patterns: Patterns,
    pub(crate) arena: Arena,
    pub(crate) x0: Vec<f64>,
    groups: u32,
}

impl Sheet {
    pub(crate) fn slot(&mut self, stay: Stay, scale: u16, value: f64) -> SlotIndex {
        self.system.slots.push(Slot { stay, scale, is_number: true, is_discrete: false });
        self.x0.push(value);
        self.x0.len() as u32 - 1
    }
    pub(crate) fn fixed(&mut self, value: f64) -> SlotIndex {
        self.slot(Stay::Fixed, 0, value)
    }
    pub(crate) fn given(&mut self, value: f64) -> SlotIndex {
        self.slot(Stay::Given(solve::Giver::Document), 0, value)
    }
    pub(crate) fn free(&mut self, start: f64) -> SlotIndex {
        self.slot(Stay::Free, 0, start)
    }
    pub(crate) fn kept(&mut self, value: f64) -> SlotIndex {
        self.groups += 1;
        self.slot(Stay::Kept { group: self.groups }, 0, value)
    }
    /// A place: two slots that yield as one.
    pub(crate) fn place(&mut self, x: f64, y: f64) -> [SlotIndex; 2] {
        self.groups += 1;
        let stay = Stay::Kept { group: self.groups };
        [self.slot(stay, 0, x), self.slot(stay, 0, y)]
    }
    pub(crate) fn anchor(&mut self, x: f64, y: f64) -> [SlotIndex; 2] {
        [self.fixed(x), self.fixed(y)]
    }
    pub(crate) fn text(&mut self, stay: Stay) -> SlotIndex {
        self.system.slots.push(Slot { stay, scale: 9, is_number: false, is_discrete: false });
        self.x0.push(0.0);
        self.x0.len() as u32 - 1
    }
    pub(crate) fn v(&mut self, slot: SlotIndex) -> ExprId {
        self.arena.var(Var(slot))
    }
    pub(crate) fn c(&mut self, value: f64) -> ExprId {
        self.arena.constant(value)
    }
    pub(crate) fn add(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.arena.add(a, b)
    }
    pub(crate) fn sub(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.arena.sub(a, b)
    }
    pub(crate) fn mul(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.arena.mul(a, b)
    }
    pub(crate) fn div(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.arena.div(a, b)
    }
    pub(crate) fn binary(&mut self, op: Binary, a: ExprId, b: ExprId) -> ExprId {
        self.arena.binary(op, a, b)
    }
    pub(crate) fn distance(&mut self, a: [SlotIndex; 2], b: [SlotIndex; 2]) -> ExprId {
        let mut sum = self.c(0.0);
        for (p, q) in a.into_iter().zip(b) {
            let (p, q) = (self.v(p), self.v(q));
            let d = self.sub(p, q);
            let square = self.arena.square(d);
            sum = self.add(sum, square);
        }
        self.arena.sqrt(sum)
    }
    /// States a relation with derived methods; returns its index.
    pub(crate) fn relate(&mut self, level: Level, sides: &[(ExprId, ExprId)]) -> u32 {
        let equations: Vec<_> = sides
            .iter()
            .map(|&(left, right)| {
                let (pattern, slots) = self.patterns.intern(&self.arena, &[left, right]);
                (pattern, slots.into_iter().map(|v| v.0))
            })
            .collect();
        let equations = self.system.add_equations(equations);
        let index = self.system.relations.len() as u32;
        self.system.relations.push(Relation {
            level,
            body: RelationBody::Equations(equations),
            methods: Default::default(),
            derived: true,
            reads: Default::default(),
            within: base::number::Tolerance::Relative,
            source: index,
            rests: false,
        });
        index
    }
    pub(crate) fn require(&mut self, left: ExprId, right: ExprId) -> u32 {
        self.relate(Level::Required, &[(left, right)])
    }
    /// A written method: one target, one value.
    pub(crate) fn method(&mut self, relation: u32, target: SlotIndex, value: ExprId) {
        let (pattern, slots) = self.patterns.intern(&self.arena, &[value]);
        let arguments = self.system.add_arguments(slots.into_iter().map(|v| v.0));
        let relation = &mut self.system.relations[relation as usize];
        relation.derived = false;
        let body = MethodBody::Formulas { pattern, arguments };
        relation.methods.push(Method { targets: vec![target], body });
    }
    pub(crate) fn reads(&mut self, relation: u32, slot: SlotIndex) {
        let known = self.system.reads(&self.system.relations[relation as usize]).to_vec();
        let reads = self.system.add_arguments(known.into_iter().chain([slot]));
        self.system.relations[relation as usize].reads = reads;
    }
    /// A wish that `slots` be where the pointer is; returns the pointer's slots.
    pub(crate) fn wish(&mut self, slots: &[SlotIndex]) -> Vec<SlotIndex> {
        slots
            .iter()
            .map(|&s| {
                let w = self.fixed(self.x0[s as usize]);
                let (a, b) = (self.v(s), self.v(w));
                self.relate(Level::Move, &[(a, b)]);
                w
            })
            .collect()
    }
    pub(crate) fn plan(&self) -> Plan {
        self.plan_of(self.system.clone())
    }
    fn plan_of(&self, system: System) -> Plan {
        solve::plan(&Rc::new(system), &self.patterns)
    }
    /// Makes slots known for one edit, as `set` does, and runs it.
    pub(crate) fn set(&self, edits: &[(SlotIndex, f64)]) -> (Vec<f64>, Outcome, Plan) {
        let mut system = self.system.clone();
        for &(slot, _) in edits {
            system.slots[slot as usize].stay = Stay::Fixed;
        }
        let plan = self.plan_of(system);
        let (values, outcome) = self.run(&plan, edits, &mut NoHost);
        (values, outcome, plan)
    }
    pub(crate) fn run(
        &self,
        plan: &Plan,
        edits: &[(SlotIndex, f64)],
        host: &mut dyn Host,
    ) -> (Vec<f64>, Outcome) {
        let mut values = self.x0.clone();
        for &(slot, value) in edits {
            values[slot as usize] = value;
        }
        let changed: Vec<SlotIndex> = edits.iter().map(|e| e.0).collect();
        let outcome = solve::run(plan, &mut Runner::new(), &self.x0, &mut values, &changed, host);
        (values, outcome)
    }
    /// Opens: what is not given is computed; the result becomes the state, held from now on.
    pub(crate) fn open(&mut self) -> Outcome {
        let plan = self.plan();
        let (values, outcome) = self.run(&plan, &[], &mut NoHost);
        assert!(outcome.is_solved(), "{outcome:?}\n{}", lines(&plan));
        self.x0 = values;
        for slot in &mut self.system.slots {
            if slot.stay == Stay::Free {
                self.groups += 1;
                slot.stay = Stay::Kept { group: self.groups };
            }
        }
        outcome
    }
    pub(crate) fn drag(&self, plan: &Plan, inputs: &[SlotIndex]) -> Drag {
        Drag::begin(plan, &self.x0, inputs)
    }
}

pub(crate) fn lines(plan: &Plan) -> String {
    plan.describe(&|s| format!("s{s}")).join("\n")
}

pub(crate) fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|v| v.to_bits()).collect()
}

pub(crate) fn close(a: f64, b: f64, within: f64) {
    assert!((a - b).abs() <= within, "{a} is not {b} to {within}");
}
