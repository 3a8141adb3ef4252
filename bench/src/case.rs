//! Cases: sketches with a start, constraints, sometimes a drag; the format `gcs-case/1`.

use serde::{Deserialize, Serialize};

/// A sketch to solve. Points are named by their index; so are lines, arcs and constraints.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Case {
    /// Always `gcs-case/1`.
    pub format: String,
    /// The family and its size: `rects-100`.
    pub name: String,
    /// False where free degrees of freedom remain; `truth` is then one of many answers.
    #[serde(default = "yes")]
    pub well_constrained: bool,
    /// Where the points are before.
    pub start: Vec<[f64; 2]>,
    /// The solution that is intended.
    #[serde(default)]
    pub truth: Vec<[f64; 2]>,
    /// From point to point.
    #[serde(default)]
    pub lines: Vec<[usize; 2]>,
    /// Centre, start, end; counter-clockwise, both ends equally far from the centre.
    #[serde(default)]
    pub arcs: Vec<[usize; 3]>,
    /// What shall hold.
    pub constraints: Vec<Constraint>,
    /// What is dragged after that.
    #[serde(default)]
    pub drag: Option<Drag>,
}

fn yes() -> bool {
    true
}

/// A constraint of a sketch. Lengths in the sketch's unit, angles in radians.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(tag = "t", rename_all = "snake_case")]
#[expect(missing_docs, reason = "each line says what its letters are")]
pub enum Constraint {
    /// Point `p` is at (x, y).
    Fix { p: usize, x: f64, y: f64 },
    /// Points `p` and `q` are one.
    Coincident { p: usize, q: usize },
    /// The ends of line `l` are at one height.
    Horizontal { l: usize },
    /// The ends of line `l` are one above the other.
    Vertical { l: usize },
    /// Points `p` and `q` are `v` apart.
    Distance { p: usize, q: usize, v: f64 },
    /// Lines `l` and `m` are equally long.
    EqualLength { l: usize, m: usize },
    /// The ends of arc `a` are `v` from its centre.
    ArcRadius { a: usize, v: f64 },
    /// Line `l` is tangent to arc `a` at one of the arc's ends.
    TangentArcLine { a: usize, l: usize, at: End },
    /// From the direction of line `l` to that of line `m` it is a turn of `v` to the left.
    Angle { l: usize, m: usize, v: f64 },
}

/// An end of an arc.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// Where it starts.
    Start,
    /// Where it ends.
    End,
}

/// What is dragged, step by step.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[expect(missing_docs, reason = "each line says what its letters are")]
pub enum Drag {
    /// Constraint `c` takes each value in turn.
    Param { c: usize, values: Vec<f64> },
    /// Point `p` follows the mouse.
    Point { p: usize, path: Vec<[f64; 2]> },
}

impl Case {
    /// Reads a case.
    ///
    /// # Errors
    /// Text that is no case, numbers that are not finite, indices that name nothing.
    pub fn read(text: &str) -> Result<Self, String> {
        let case: Self = serde_json::from_str(text).map_err(|e| e.to_string())?;
        if case.format != "gcs-case/1" {
            return Err(format!("the format is {}, not gcs-case/1", case.format));
        }
        case.check()?;
        Ok(case)
    }

    /// Returns a constraint with another value; nothing if it has none.
    pub fn with_value(&self, c: usize, v: f64) -> Option<Constraint> {
        match self.constraints[c] {
            Constraint::Distance { p, q, .. } => Some(Constraint::Distance { p, q, v }),
            Constraint::ArcRadius { a, .. } => Some(Constraint::ArcRadius { a, v }),
            Constraint::Angle { l, m, .. } => Some(Constraint::Angle { l, m, v }),
            Constraint::Fix { .. }
            | Constraint::Coincident { .. }
            | Constraint::Horizontal { .. }
            | Constraint::Vertical { .. }
            | Constraint::EqualLength { .. }
            | Constraint::TangentArcLine { .. } => None,
        }
    }

    fn check(&self) -> Result<(), String> {
        let point = |p: usize| within(p, self.start.len(), "point");
        let line = |l: usize| within(l, self.lines.len(), "line");
        let arc = |a: usize| within(a, self.arcs.len(), "arc");
        self.start.iter().flatten().try_for_each(|&x| finite(x))?;
        self.lines.iter().flatten().try_for_each(|&p| point(p))?;
        self.arcs.iter().flatten().try_for_each(|&p| point(p))?;
        for constraint in &self.constraints {
            match *constraint {
                Constraint::Fix { p, x, y } => point(p).and(finite(x)).and(finite(y)),
                Constraint::Coincident { p, q } => point(p).and(point(q)),
                Constraint::Horizontal { l } | Constraint::Vertical { l } => line(l),
                Constraint::Distance { p, q, v } => point(p).and(point(q)).and(finite(v)),
                Constraint::EqualLength { l, m } => line(l).and(line(m)),
                Constraint::ArcRadius { a, v } => arc(a).and(finite(v)),
                Constraint::TangentArcLine { a, l, .. } => arc(a).and(line(l)),
                Constraint::Angle { l, m, v } => line(l).and(line(m)).and(finite(v)),
            }?;
        }
        match &self.drag {
            None => Ok(()),
            Some(Drag::Param { c, values }) => {
                within(*c, self.constraints.len(), "constraint")?;
                let valued = self.with_value(*c, 1.0).map(|_| ());
                valued.ok_or_else(|| format!("constraint {c} has no value to drag"))?;
                values.iter().try_for_each(|&v| finite(v))
            }
            Some(Drag::Point { p, path }) => {
                point(*p)?;
                path.iter().flatten().try_for_each(|&x| finite(x))
            }
        }
    }
}

fn within(index: usize, count: usize, what: &str) -> Result<(), String> {
    if index < count {
        Ok(())
    } else {
        Err(format!("there is no {what} {index}: there are {count}"))
    }
}

fn finite(x: f64) -> Result<(), String> {
    if x.is_finite() { Ok(()) } else { Err(format!("{x} is no number to work with")) }
}
