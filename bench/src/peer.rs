//! The peer: ezpz, given the same cases, as its own documentation says.

use crate::case::{Case, Constraint, Drag, End};
use crate::measure::{Repeat, cold, repeated};
use crate::residual;
use crate::sketch::constraints_at;
use ezpz::datatypes::inputs::{DatumCircularArc, DatumLineSegment, DatumPoint};
use ezpz::datatypes::{Angle, AngleKind};
use ezpz::{Config, ConstraintRequest, Id, solve, solve_analysis};
use std::time::Instant;

/// What ezpz makes of a case. Times are in seconds.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct PeerFigures {
    /// Whole solves from the start.
    pub solve: Vec<f64>,
    /// The same with nothing of it in the processor's caches.
    pub cold: Vec<f64>,
    /// The largest error of a constraint; not a number where it gave up.
    pub residual: f64,
    /// Solving and saying which variables are free.
    pub analysis: Vec<f64>,
    /// Every step of the drag.
    pub steps: Vec<f64>,
}

/// More unknowns than this are not analysed: it would take minutes.
const ANALYSED: usize = 2000;

/// Solves, analyses and drags a case.
pub fn measure(case: &Case, repeat: Repeat) -> PeerFigures {
    let requests = requests(case, &case.constraints);
    let guesses = guesses(&case.start);
    let (times, solved) = repeated(repeat, || solve(&requests, guesses.clone(), Config::default()));
    let mut figures = PeerFigures { solve: times, residual: f64::NAN, ..PeerFigures::default() };
    if repeat == Repeat::Enough {
        figures.cold =
            cold(|| guesses.clone(), |guesses| solve(&requests, guesses, Config::default()));
    }
    let Ok(outcome) = solved else { return figures };
    let points = points(outcome.final_values());
    figures.residual = residual::largest(case, &case.constraints, &points);
    if guesses.len() <= ANALYSED {
        let analyse = || solve_analysis(&requests, guesses.clone(), Config::default());
        (figures.analysis, _) = repeated(repeat, analyse);
    }
    if let Some(drag) = &case.drag {
        figures.steps = follow(case, drag, points);
    }
    figures
}

/// Returns where ezpz puts the points of a case; nothing where it gives up.
pub fn solved(case: &Case) -> Option<Vec<[f64; 2]>> {
    let outcome =
        solve(&requests(case, &case.constraints), guesses(&case.start), Config::default());
    Some(points(outcome.ok()?.final_values()))
}

/// Every step begins where the last one ended; a mouse is a wish of lower priority.
fn follow(case: &Case, drag: &Drag, mut points: Vec<[f64; 2]>) -> Vec<f64> {
    let count = match drag {
        Drag::Param { values, .. } => values.len(),
        Drag::Point { path, .. } => path.len(),
    };
    let mut steps = Vec::new();
    for i in 0..count {
        let mut requests = requests(case, &constraints_at(case, drag, i));
        if let Drag::Point { p, path } = drag {
            let at = point(*p);
            for (id, x) in [(at.id_x(), path[i][0]), (at.id_y(), path[i][1])] {
                requests.push(ConstraintRequest::new(ezpz::Constraint::Fixed(id, x), 1));
            }
        }
        let guesses = guesses(&points);
        let begin = Instant::now();
        let solved = solve(&requests, guesses, Config::default());
        steps.push(begin.elapsed().as_secs_f64());
        if let Ok(outcome) = solved {
            points = self::points(outcome.final_values());
        }
    }
    steps
}

fn guesses(start: &[[f64; 2]]) -> Vec<(Id, f64)> {
    (0..).zip(start.iter().flatten().copied()).collect()
}

fn points(values: &[f64]) -> Vec<[f64; 2]> {
    values.chunks_exact(2).map(|p| [p[0], p[1]]).collect()
}

fn point(p: usize) -> DatumPoint {
    DatumPoint::new_xy(2 * p as Id, 2 * p as Id + 1)
}

fn requests(case: &Case, constraints: &[Constraint]) -> Vec<ConstraintRequest> {
    let line = |l: usize| {
        let [p, q] = case.lines[l];
        DatumLineSegment::new(point(p), point(q))
    };
    let arc = |a: usize| {
        let [center, start, end] = case.arcs[a].map(point);
        DatumCircularArc { center, start, end }
    };
    let mut all: Vec<ezpz::Constraint> = Vec::new();
    for constraint in constraints {
        let one = match *constraint {
            Constraint::Fix { p, x, y } => {
                all.push(ezpz::Constraint::Fixed(point(p).id_x(), x));
                ezpz::Constraint::Fixed(point(p).id_y(), y)
            }
            Constraint::Coincident { p, q } => {
                ezpz::Constraint::PointsCoincident(point(p), point(q))
            }
            Constraint::Horizontal { l } => ezpz::Constraint::Horizontal(line(l)),
            Constraint::Vertical { l } => ezpz::Constraint::Vertical(line(l)),
            Constraint::Distance { p, q, v } => ezpz::Constraint::Distance(point(p), point(q), v),
            Constraint::EqualLength { l, m } => {
                ezpz::Constraint::LinesEqualLength(line(l), line(m))
            }
            Constraint::ArcRadius { a, v } => ezpz::Constraint::ArcRadius(arc(a), v),
            Constraint::TangentArcLine { a, l, at } => {
                let arc = arc(a);
                let end = match at {
                    End::Start => arc.start,
                    End::End => arc.end,
                };
                let radius = DatumLineSegment::new(arc.center, end);
                ezpz::Constraint::lines_perpendicular([line(l), radius])
            }
            Constraint::Angle { l, m, v } => {
                let kind = AngleKind::Other(Angle::from_radians(v));
                ezpz::Constraint::LinesAtAngle(line(l), line(m), kind)
            }
        };
        all.push(one);
    }
    // the radius of an arc holds at both of its ends; an arc without one has its own rule
    let has_radius =
        |a| constraints.iter().any(|c| matches!(c, Constraint::ArcRadius { a: b, .. } if *b == a));
    let bare = (0..case.arcs.len()).filter(|&a| !has_radius(a));
    all.extend(bare.map(|a| ezpz::Constraint::Arc(arc(a))));
    all.into_iter().map(ConstraintRequest::highest_priority).collect()
}
