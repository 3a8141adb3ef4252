//! Plans by shape: what is planned once serves every component of the same shape.

use expr::{ExprId, Node};
use indexmap::IndexMap;
use solve::{Plan, Relation, System};
use std::rc::Rc;

/// Everything that two systems have to agree in to have one plan.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
struct Shape {
    slots: Vec<solve::Slot>,
    relations: Vec<Relation>,
    nodes: Vec<Node>,
}

/// Plans by the shape of their systems.
#[derive(Debug, Default)]
pub struct Plans {
    by_shape: IndexMap<Shape, (Rc<System>, Rc<Plan>)>,
    reused: usize,
}

impl Plans {
    /// Returns how many systems were planned, and how many found their plan made.
    pub fn counts(&self) -> PlanCounts {
        PlanCounts { planned: self.by_shape.len(), reused: self.reused }
    }
    /// Returns the plan of a system, and a system that it is the plan of.
    pub(crate) fn plan(&mut self, system: System) -> (Rc<System>, Rc<Plan>) {
        let shape = Shape {
            slots: system.slots.clone(),
            relations: system.relations.clone(),
            nodes: (0..system.arena.len()).map(|i| system.arena.node(ExprId(i as u32))).collect(),
        };
        if let Some((system, plan)) = self.by_shape.get(&shape) {
            self.reused += 1;
            return (system.clone(), plan.clone());
        }
        let plan = Rc::new(solve::plan(&system));
        let system = Rc::new(system);
        self.by_shape.insert(shape, (system.clone(), plan.clone()));
        (system, plan)
    }
}

/// How much was planned.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct PlanCounts {
    /// Systems for which a plan was made.
    pub planned: usize,
    /// Systems whose plan was there already.
    pub reused: usize,
}
