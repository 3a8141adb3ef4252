//! Sketches: a case's document with its things made, ready to be solved and dragged.

use crate::case::{Case, Constraint, Drag};
use crate::document;
use kernel::{ConstraintInstance, DOCUMENT, SlotId, Structure, ThingId, Value, Values};
use lang::Lowered;
use plan::{Host, Model, Planner, Plans, Target, Way};

const GEOMETRY: &str = include_str!("../../library/geometry.thing");

/// A sketch before it is solved.
#[derive(Debug)]
pub struct Sketch {
    lowered: Lowered,
    structure: Structure,
    /// What the text gives.
    given: Values,
    /// Where the coordinates of each point are.
    points: Vec<[SlotId; 2]>,
}

impl Sketch {
    /// Makes the things of a case's document.
    ///
    /// # Errors
    /// What the language says against the document: a case that no document can say.
    pub fn new(case: &Case) -> Result<Self, String> {
        let text = document::text(case);
        let load = |name: &str| (name == "geometry").then(|| GEOMETRY.to_owned());
        let lowered = lang::lower(&text, &load, None);
        let (structure, faults) = kernel::instantiate(&lowered.document);
        let wrong =
            lowered.diagnostics.iter().chain(&lowered.fault_diagnostics(&faults)).next().cloned();
        if let Some(wrong) = wrong {
            return Err(wrong.message);
        }
        let (given, _) = eval::given_values(&lowered.document, &structure);
        let mut sketch = Self { lowered, structure, given, points: Vec::new() };
        for i in 0..case.start.len() {
            let point = sketch.thing(&format!("p{i}")).ok_or("a point is missing")?;
            let slots = sketch.structure.slots_under(point);
            sketch.points.push([slots[0], slots[1]]);
        }
        Ok(sketch)
    }

    /// Returns what every question to a planner is about.
    pub fn model(&self) -> Model<'_> {
        Model { document: &self.lowered.document, structure: &self.structure }
    }

    /// Solves from the start as a document is opened: rules, plan and numbers, nothing kept.
    pub fn solve(&self) -> (Planner, Values) {
        let (mut planner, _) = Planner::new(self.model(), Plans::default());
        let mut values = Values::default();
        planner.open(self.model(), &mut values, &mut Given(&self.given));
        (planner, values)
    }

    /// Solves from the start by the plan that the planner has: numbers alone.
    pub fn solve_again(&self, planner: &mut Planner) -> Values {
        let mut values = self.given.clone();
        planner.satisfy(self.model(), &mut values, &mut Given(&self.given));
        values
    }

    /// Begins the drag of a case.
    ///
    /// # Errors
    /// Why the point or the value cannot be dragged.
    pub fn press(
        &self,
        planner: &mut Planner,
        values: &Values,
        drag: &Drag,
    ) -> Result<plan::Press, String> {
        let path = match drag {
            Drag::Param { c, .. } => format!("c{c}.value"),
            Drag::Point { p, .. } => format!("p{p}"),
        };
        let thing = self.thing(&path).ok_or_else(|| format!("there is no {path}"))?;
        let targets = [Target::Thing(thing)];
        let press = planner.press(self.model(), values, &targets, &mut Given(&self.given));
        press.map_err(|reason| format!("{path} cannot be dragged: {reason:?}"))
    }

    /// Follows one step of a drag; returns true if what was wished for was reached.
    pub fn follow(
        &self,
        planner: &Planner,
        press: &mut plan::Press,
        values: &mut Values,
        wanted: &[f64],
    ) -> bool {
        planner.drag(self.model(), press, values, wanted, &mut Given(&self.given)).reached
    }

    /// Says how a solved sketch stands: what is free, what says nothing new, what does not hold.
    pub fn status(&self, planner: &mut Planner, values: &Values) -> plan::Status {
        planner.status(self.model(), values, &mut Given(&self.given))
    }

    /// Returns where the points are.
    pub fn points(&self, values: &Values) -> Vec<[f64; 2]> {
        self.points.iter().map(|slots| slots.map(|s| values.numbers[s])).collect()
    }

    fn thing(&self, path: &str) -> Option<ThingId> {
        path.split('.').try_fold(DOCUMENT, |at, name| self.structure.part_named(at, name))
    }
}

/// Returns the constraints that hold after step `i` of a drag.
pub fn constraints_at(case: &Case, drag: &Drag, i: usize) -> Vec<Constraint> {
    let mut constraints = case.constraints.clone();
    if let Drag::Param { c, values } = drag {
        constraints[*c] = case.with_value(*c, values[i]).unwrap_or(constraints[*c]);
    }
    constraints
}

/// Returns what is wished for at every step of a drag.
pub fn wishes(drag: &Drag) -> Vec<Vec<f64>> {
    match drag {
        Drag::Param { values, .. } => values.iter().map(|&v| vec![v]).collect(),
        Drag::Point { path, .. } => path.iter().map(|at| at.to_vec()).collect(),
    }
}

/// Answers the planner: sketches are numbers throughout.
struct Given<'a>(&'a Values);

impl Host for Given<'_> {
    fn given(&mut self, slot: SlotId, _: &Values) -> Option<Value> {
        Some(self.0.get(slot))
    }
    fn compute(
        &mut self,
        _: ConstraintInstance,
        _: Way,
        _: &Values,
    ) -> Result<Vec<(SlotId, Value)>, String> {
        Err("a sketch has no texts".into())
    }
    fn holds(&mut self, _: ConstraintInstance, _: &Values) -> bool {
        false
    }
}
