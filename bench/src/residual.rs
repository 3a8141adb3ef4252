//! How far a sketch is from what its case asks for, by arithmetic of its own.

use crate::case::{Case, Constraint, End};
use base::number::{atan2, cos, hypot, sin};

/// Returns the largest error of the constraints and of the arcs' own rule: lengths in the sketch's
/// unit, angles in radians, tangency as the part of the radius that runs along the line.
pub fn largest(case: &Case, constraints: &[Constraint], points: &[[f64; 2]]) -> f64 {
    let rows = constraints.iter().map(|c| error(case, c, points));
    let arcs = case
        .arcs
        .iter()
        .map(|&[c, s, e]| (distance(points[c], points[s]) - distance(points[c], points[e])).abs());
    rows.chain(arcs).fold(0.0, |worst: f64, e| if e > worst || e.is_nan() { e } else { worst })
}

fn error(case: &Case, constraint: &Constraint, points: &[[f64; 2]]) -> f64 {
    let ends = |l: usize| (points[case.lines[l][0]], points[case.lines[l][1]]);
    let along = |l: usize| {
        let (p, q) = ends(l);
        [q[0] - p[0], q[1] - p[1]]
    };
    match *constraint {
        Constraint::Fix { p, x, y } => (points[p][0] - x).abs().max((points[p][1] - y).abs()),
        Constraint::Coincident { p, q } => distance(points[p], points[q]),
        Constraint::Horizontal { l } => along(l)[1].abs(),
        Constraint::Vertical { l } => along(l)[0].abs(),
        Constraint::Distance { p, q, v } => (distance(points[p], points[q]) - v).abs(),
        Constraint::EqualLength { l, m } => {
            let ((p, q), (r, s)) = (ends(l), ends(m));
            (distance(p, q) - distance(r, s)).abs()
        }
        Constraint::ArcRadius { a, v } => {
            let [c, s, _] = case.arcs[a];
            (distance(points[c], points[s]) - v).abs()
        }
        Constraint::TangentArcLine { a, l, at } => {
            let [c, s, e] = case.arcs[a];
            let end = match at {
                End::Start => s,
                End::End => e,
            };
            let [x, y] = along(l);
            let radius = [points[end][0] - points[c][0], points[end][1] - points[c][1]];
            ((x * radius[0] + y * radius[1]) / hypot(x, y)).abs()
        }
        Constraint::Angle { l, m, v } => {
            let ([x, y], [u, w]) = (along(l), along(m));
            let (cross, inner) = (x * w - y * u, x * u + y * w);
            let (s, c) = (sin(v), cos(v));
            atan2(cross * c - inner * s, inner * c + cross * s).abs()
        }
    }
}

fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    let (x, y) = (q[0] - p[0], q[1] - p[1]);
    (x * x + y * y).sqrt()
}
