//! Rings: pieces joined end to end, and which of them are holes in which.

use crate::region::arrange::Arrangement;
use crate::region::edge::{Carrier, Edge, V, cross, distance, dot, minus};
use crate::region::{Bend, Ring, Surface};
use base::number::{atan2, tan};
use std::f64::consts::{PI, TAU};

/// What one arc of a ring turns through at most, so that its bulge says it well.
const MOST_SWEEP: f64 = 1.9 * PI;

/// Joins pieces, the inside to the left of each, to rings that touch in vertices at most; nothing where one does not
/// close.
///
/// `chosen` is a piece and whether it is run against.
pub(crate) fn joined(of: &Arrangement, chosen: &[(usize, bool)]) -> Option<Vec<Vec<Edge>>> {
    let run = |&(k, against): &(usize, bool)| {
        let piece = &of.pieces[k];
        match against {
            false => (piece.from, piece.to, piece.edge),
            true => (piece.to, piece.from, piece.edge.reversed()),
        }
    };
    let runs: Vec<(usize, usize, Edge)> = chosen.iter().map(run).collect();
    let mut leaving: Vec<Vec<usize>> = vec![Vec::new(); of.vertices.len()];
    // how far from a vertex the order of what leaves and arrives is looked at
    let mut far = vec![f64::INFINITY; of.vertices.len()];
    for (i, (from, to, edge)) in runs.iter().enumerate() {
        leaving[*from].push(i);
        for &v in [from, to] {
            far[v] = far[v].min(0.25 * edge.chord());
        }
    }
    let mut is_used = vec![false; runs.len()];
    let mut rings = Vec::new();
    for first in 0..runs.len() {
        if is_used[first] {
            continue;
        }
        let (mut ring, mut at) = (Vec::new(), first);
        loop {
            is_used[at] = true;
            let (_, v, edge) = &runs[at];
            ring.push(*edge);
            let back = direction(&edge.reversed(), of.vertices[*v], far[*v]);
            let turn = |i: usize| {
                let turn = back - direction(&runs[i].2, of.vertices[*v], far[*v]);
                if turn <= 0.0 { turn + TAU } else { turn }
            };
            let next = leaving[*v].iter().copied().min_by(|&i, &j| turn(i).total_cmp(&turn(j)))?;
            if next == first {
                break;
            }
            if is_used[next] {
                return None;
            }
            at = next;
        }
        rings.push(ring);
    }
    Some(rings)
}

fn direction(edge: &Edge, vertex: V, far: f64) -> f64 {
    let [x, y] = minus(edge.off(far), vertex);
    atan2(y, x)
}

/// Makes what goes on as it was one edge.
pub(crate) fn simplified(mut ring: Vec<Edge>, near: f64) -> Vec<Edge> {
    if let Some(halves) = whole_circle(&ring, near) {
        return halves;
    }
    // begin where something ends
    let n = ring.len();
    let start = (0..n).find(|&i| one_of(&ring[(i + n - 1) % n], &ring[i], near).is_none());
    ring.rotate_left(start.unwrap_or(0));
    let mut whole: Vec<Edge> = Vec::with_capacity(n);
    for edge in ring {
        match whole.last_mut() {
            Some(last) => match one_of(last, &edge, near) {
                Some(both) => *last = both,
                None => whole.push(edge),
            },
            None => whole.push(edge),
        }
    }
    whole
}

/// Makes a ring that is a circle two half turns.
fn whole_circle(ring: &[Edge], near: f64) -> Option<Vec<Edge>> {
    let first = ring.first()?;
    let Carrier::Round { center, radius } = first.carrier else { return None };
    let is_same = ring.iter().all(|e| same_round(first, e, near));
    if !is_same {
        return None;
    }
    let across = [2.0 * center[0] - first.from[0], 2.0 * center[1] - first.from[1]];
    let half = |from, to| {
        let carrier = Carrier::Round { center, radius };
        Edge { from, to, carrier, sweep: if radius < 0.0 { -PI } else { PI } }
    };
    Some(vec![half(first.from, across), half(across, first.from)])
}

fn same_round(e: &Edge, f: &Edge, near: f64) -> bool {
    match (e.carrier, f.carrier) {
        (Carrier::Round { center: c, radius: r }, Carrier::Round { center: d, radius: s }) => {
            distance(c, d) <= 4.0 * near && (r - s).abs() <= 4.0 * near
        }
        _ => false,
    }
}

/// Makes two edges, the second where the first ends, one, where the second goes on as the first did.
fn one_of(e: &Edge, f: &Edge, near: f64) -> Option<Edge> {
    match (e.carrier, f.carrier) {
        (Carrier::Straight, Carrier::Straight) => {
            let both = Edge::segment(e.from, f.to);
            let goes_on = dot(e.way(0.0), f.way(0.0)) > 0.5;
            (goes_on && both.distance(e.to) <= near).then_some(both)
        }
        (Carrier::Round { center, radius }, Carrier::Round { .. }) => {
            let sweep = e.sweep + f.sweep;
            let goes_on = same_round(e, f, near) && sweep.abs() <= MOST_SWEEP;
            let carrier = Carrier::Round { center, radius };
            goes_on.then_some(Edge { from: e.from, to: f.to, carrier, sweep })
        }
        _ => None,
    }
}

/// Returns the corners of a ring.
pub(crate) fn corners(ring: &[Edge], origin: V) -> Ring {
    let corner = |e: &Edge| Bend {
        at: [e.from[0] + origin[0], e.from[1] + origin[1]],
        bulge: tan(0.25 * e.sweep),
    };
    ring.iter().map(corner).collect()
}

/// Returns how often edges that close run around a place that is not on one of them.
pub(crate) fn winding<'a>(edges: impl IntoIterator<Item = &'a Edge>, p: V) -> i32 {
    let seen = |e: &Edge| {
        let (a, b) = (minus(e.from, p), minus(e.to, p));
        // on the chord it is seen as from the left: no zero is negative
        let turn = cross(a, b) + 0.0;
        let chord = atan2(turn, dot(a, b));
        let Carrier::Round { center, radius } = e.carrier else { return chord };
        if distance(p, center) >= radius.abs() {
            return chord;
        }
        // a place between an arc and its chord sees the arc the other way round
        match (radius > 0.0, turn < 0.0) {
            (true, true) => chord + TAU,
            (false, false) => chord - TAU,
            _ => chord,
        }
    };
    (edges.into_iter().map(seen).sum::<f64>() / TAU).round() as i32
}

/// Says of rings that do not cross which are holes in which; nothing where one is in none.
pub(crate) fn nested(rings: Vec<Vec<Edge>>, origin: V) -> Option<Vec<Surface>> {
    let with_area = |ring: Vec<Edge>| (ring.iter().map(Edge::area).sum::<f64>(), ring);
    let (outers, holes): (Vec<_>, Vec<_>) =
        rings.into_iter().map(with_area).partition(|(area, _)| *area > 0.0);
    let surface =
        |(_, ring): &(f64, Vec<Edge>)| Surface { outer: corners(ring, origin), holes: Vec::new() };
    let mut surfaces: Vec<Surface> = outers.iter().map(surface).collect();
    for (_, hole) in &holes {
        let inside = hole.first()?.at(0.5);
        let around = outers.iter().enumerate().filter(|(_, (_, outer))| winding(outer, inside) > 0);
        let (i, _) = around.min_by(|(_, (a, _)), (_, (b, _))| a.total_cmp(b))?;
        surfaces[i].holes.push(corners(hole, origin));
    }
    Some(surfaces)
}
