//! Starts that have the right shape and lie elsewhere, and dimensions that are typed anew: which solution is come to.
//!
//! In: a case whose truth is known. Out: the same case with the truth shifted, turned or scaled as its start; and
//! whether what came out is the truth, or another solution that mirrors a part of it.

use crate::case::{Case, Constraint};
use crate::document;
use crate::measure::SOLVED;
use crate::residual::largest;
use base::number::{cos, sin};
use base::scrambled;
use session::{Command, Host, Literal, Path, Session};
use std::collections::BTreeMap;

/// How a start lies to the truth: every point by the same map, about the middle of the sketch.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Displacement {
    /// Moved by up to half its extent each way, told by a seed.
    Shifted(u64),
    /// Turned to the left by so many degrees.
    Turned(f64),
    /// Made so many times as large.
    Scaled(f64),
}

/// The displacements of the table, by what they do; each is done three times.
pub const DISPLACEMENTS: [(&str, [Displacement; 3]); 4] = [
    ("shifted", [Displacement::Shifted(1), Displacement::Shifted(2), Displacement::Shifted(3)]),
    (
        "turned",
        [Displacement::Turned(25.0), Displacement::Turned(-25.0), Displacement::Turned(24.0)],
    ),
    ("halved", [Displacement::Scaled(0.5), Displacement::Scaled(0.55), Displacement::Scaled(0.45)]),
    ("doubled", [Displacement::Scaled(2.0), Displacement::Scaled(1.9), Displacement::Scaled(2.1)]),
];

/// What a solve came to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Reached {
    /// The intended solution.
    Intended,
    /// Another one: some part lies on another side.
    Mirrored,
    /// None.
    Unsolved,
}

/// Returns the case with its truth, displaced, as its start.
pub fn displaced(case: &Case, by: Displacement) -> Case {
    let along = |axis: usize| case.truth.iter().map(move |p| p[axis]);
    let ends = [0, 1].map(|axis| {
        let low = along(axis).fold(f64::INFINITY, f64::min);
        (low, along(axis).fold(f64::NEG_INFINITY, f64::max))
    });
    let middle = ends.map(|(low, high)| (low + high) / 2.0);
    let extent = ends.iter().map(|(low, high)| high - low).fold(0.0, f64::max);
    let part = |seed: u64| (scrambled(seed) >> 11) as f64 / (1u64 << 53) as f64 - 0.5;
    let moved = |p: &[f64; 2]| {
        let [x, y] = [p[0] - middle[0], p[1] - middle[1]];
        let [x, y] = match by {
            Displacement::Shifted(seed) => {
                [x + extent * part(2 * seed), y + extent * part(2 * seed + 1)]
            }
            Displacement::Turned(degrees) => {
                let (s, c) = (sin(degrees.to_radians()), cos(degrees.to_radians()));
                [c * x - s * y, s * x + c * y]
            }
            Displacement::Scaled(times) => [times * x, times * y],
        };
        [x + middle[0], y + middle[1]]
    };
    Case { start: case.truth.iter().map(moved).collect(), drag: None, ..case.clone() }
}

/// Says which solution some points are, of a case whose truth is its only intended one.
pub fn reached(case: &Case, points: &[[f64; 2]]) -> Reached {
    let error = largest(case, &case.constraints, points);
    // what is not a number is no solution
    if error.is_nan() || error > SOLVED {
        return Reached::Unsolved;
    }
    if is_near(points, &case.truth) { Reached::Intended } else { Reached::Mirrored }
}

fn is_near(points: &[[f64; 2]], truth: &[[f64; 2]]) -> bool {
    let apart = |(p, q): (&[f64; 2], &[f64; 2])| (p[0] - q[0]).abs().max((p[1] - q[1]).abs());
    points.iter().zip(truth).map(apart).all(|d| d < 1e-5)
}

/// What became of a dimension that was typed anew in a document that held.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Typed {
    /// It lies as where it is set by hand, by the text edited and by that text opened again.
    Alike,
    /// The text edited, or opened again, comes to another solution.
    Flipped,
    /// Set by hand it is refused: there is nothing to compare.
    Refused,
}

struct Alone;

impl Host for Alone {
    fn read(&self, name: &str) -> Option<String> {
        crate::opened::library(name)
    }
}

/// Types another value of constraint `c` into the document of a case that starts at its truth, and sets it in
/// another; nothing where that constraint has no value.
pub fn typed(case: &Case, c: usize, times: f64) -> Option<Typed> {
    let v = match case.constraints[c] {
        Constraint::Distance { v, .. }
        | Constraint::ArcRadius { v, .. }
        | Constraint::Angle { v, .. } => v * times,
        _ => return None,
    };
    let held = Case { start: case.truth.clone(), drag: None, ..case.clone() };
    let mut changed = held.clone();
    changed.constraints[c] = held.with_value(c, v)?;
    let mut session = Session::new(Box::new(Alone));
    let set = session.open("set", &document::text(&held));
    let path = Path::of(&[&format!("c{c}"), "value"]);
    if session.apply(set, &Command::Set(vec![(path, Literal::Number(v))])).is_err() {
        return Some(Typed::Refused);
    }
    let typed = session.open("typed", &document::text(&held));
    session.apply(typed, &Command::Text(document::text(&changed))).ok()?;
    let again = session.text(typed).source;
    let again = session.open("again", &again);
    let wanted = points(&session, set, case.start.len());
    let alike =
        [typed, again].iter().all(|&id| is_near(&points(&session, id, wanted.len()), &wanted));
    Some(if alike { Typed::Alike } else { Typed::Flipped })
}

/// Returns where the points of a case's document are in a session; what is merged with one before it is told of that
/// one alone, and lies at nothing.
fn points(session: &Session, id: session::DocumentId, count: usize) -> Vec<[f64; 2]> {
    let rows = session.values(id);
    let numbers: BTreeMap<&str, f64> =
        rows.iter().filter_map(|row| Some((row.path.as_str(), row.number?))).collect();
    let number = |path: String| numbers.get(path.as_str()).copied().unwrap_or(0.0);
    (0..count).map(|p| [number(format!("p{p}.x")), number(format!("p{p}.y"))]).collect()
}
