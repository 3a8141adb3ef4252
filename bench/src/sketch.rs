//! Sketches: a case's document with its things made, ready to be solved and dragged.

use crate::case::{Case, Constraint, Drag};
use crate::document;
use crate::opened::Opened;
use kernel::{SlotId, Values};
use plan::{Certainty, Planner, Press, Target, Templates, Unmet};
use std::collections::BTreeSet;

/// A sketch before it is solved.
#[derive(Debug)]
pub struct Sketch {
    opened: Opened,
    /// Where the coordinates of each point are.
    points: Vec<[SlotId; 2]>,
}

impl Sketch {
    /// Makes the things of a case's document.
    ///
    /// # Errors
    /// What the language says against the document: a case that no document can say.
    pub fn new(case: &Case) -> Result<Self, String> {
        Self::of(case, &document::text(case))
    }

    /// Makes the things of a case whose document has been written.
    ///
    /// # Errors
    /// What the language says against the document.
    pub fn of(case: &Case, text: &str) -> Result<Self, String> {
        let opened = Opened::new(text)?;
        let place = |i: usize| match opened.slots(&format!("p{i}"))[..] {
            [x, y] => Ok([x, y]),
            _ => Err(format!("point {i} has no place")),
        };
        let points = (0..case.start.len()).map(place).collect::<Result<_, _>>()?;
        Ok(Self { opened, points })
    }

    /// Opens and compiles what the constraints of the classes say: the last of making the things.
    pub fn templates(&self) -> Templates {
        self.opened.templates()
    }

    /// Solves from the start as a document is opened: which slots the rules are of, plan and numbers.
    /// Nothing is kept of a solve before, given templates that no planner was made with.
    pub fn solve(&self, templates: Templates) -> (Planner, Values) {
        let (planner, values, _) = self.opened.solve_over(templates);
        (planner, values)
    }

    /// Solves from the start by the plan that the planner has: numbers alone.
    pub fn solve_again(&self, planner: &mut Planner) -> Values {
        let mut values = self.opened.given().clone();
        planner.satisfy(self.opened.model(), &mut values, &mut self.opened.host());
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
    ) -> Result<Press, String> {
        let path = match drag {
            Drag::Param { c, .. } => format!("c{c}.value"),
            Drag::Point { p, .. } => format!("p{p}"),
        };
        let thing = self.opened.thing(&path).ok_or_else(|| format!("there is no {path}"))?;
        let targets = [Target::Thing(thing)];
        let press = planner.press(self.opened.model(), values, &targets);
        press.map_err(|reason| format!("{path} cannot be dragged: {reason:?}"))
    }

    /// Follows one step of a drag; returns true if what was wished for was reached.
    pub fn follow(
        &self,
        planner: &mut Planner,
        press: &mut Press,
        values: &mut Values,
        wanted: &[f64],
    ) -> bool {
        planner.drag(self.opened.model(), press, values, wanted, &mut self.opened.host()).reached
    }

    /// Says how a solved sketch stands: what is free, what says nothing new, what does not hold.
    pub fn analyse(&self, planner: &mut Planner, values: &Values) -> plan::Analysis {
        planner.analyse(self.opened.model(), values, &mut self.opened.host())
    }

    /// Counts the constraints of the contradictions behind what does not hold: none can be spared, wherever that
    /// could be decided; where no contradiction was found, it counts what does not hold.
    pub fn conflicting(&self, planner: &mut Planner, values: &Values, unmet: &[Unmet]) -> usize {
        let host = &mut self.opened.host();
        let sets = planner.contradictions(self.opened.model(), values, unmet, host);
        let is_one = |c: Certainty| !matches!(c, Certainty::GivenUp(_) | Certainty::Holds);
        let named = sets.into_iter().filter(|set| is_one(set.certainty));
        let named: BTreeSet<_> = named.flat_map(|set| set.constraints).collect();
        if named.is_empty() { unmet.len() } else { named.len() }
    }

    /// Returns where the points are.
    pub fn points(&self, values: &Values) -> Vec<[f64; 2]> {
        self.points.iter().map(|slots| slots.map(|s| values.numbers[s])).collect()
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
