//! Arrangements: edges cut where they meet, what coincides made one, and what lies on either side.

use crate::region::edge::{Carrier, Edge, V, cross, distance, meetings, minus};
use base::number::sqrt;
use std::collections::BTreeMap;

/// A part of an edge that nothing crosses, as high as it is low at one of its ends.
#[derive(Clone, Debug)]
pub(crate) struct Piece {
    /// The vertices where it begins and ends.
    pub(crate) from: usize,
    pub(crate) to: usize,
    pub(crate) edge: Edge,
    pub(crate) mid: V,
    /// How often each side's rings run along it, against it counted negative.
    pub(crate) runs: [i32; 2],
}

/// Edges that meet at vertices alone.
#[derive(Debug)]
pub(crate) struct Arrangement {
    pub(crate) vertices: Vec<V>,
    pub(crate) pieces: Vec<Piece>,
    /// Within what places are one.
    pub(crate) near: f64,
}

impl Arrangement {
    /// Cuts edges, each of one of two sides, where they meet.
    pub(crate) fn new(edges: &[(Edge, usize)], near: f64) -> Self {
        let mut cuts: Vec<Vec<f64>> = edges.iter().map(|(e, _)| e.turning()).collect();
        let boxes: Vec<[V; 2]> = edges.iter().map(|(e, _)| bounds(e)).collect();
        for i in 0..edges.len() {
            for j in 0..i {
                if apart(&boxes[i], &boxes[j], near) {
                    continue;
                }
                let (e, f) = (&edges[i].0, &edges[j].0);
                meetings(e, f, near, &mut |p| {
                    cuts[i].push(e.part(p));
                    cuts[j].push(f.part(p));
                });
            }
        }
        let mut all = Self { vertices: Vec::new(), pieces: Vec::new(), near };
        let mut cells = BTreeMap::new();
        // the ends first: what is cut there keeps their bits
        for (e, _) in edges {
            all.vertex(e.from, &mut cells);
            all.vertex(e.to, &mut cells);
        }
        let mut between: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
        for ((edge, side), cuts) in edges.iter().zip(&mut cuts) {
            cuts.retain(|part| 0.0 < *part && *part < 1.0);
            cuts.sort_by(f64::total_cmp);
            let mut from = all.vertex(edge.from, &mut cells);
            for &part in cuts.iter().chain(&[1.0]) {
                let p = if part < 1.0 { edge.at(part) } else { edge.to };
                let to = all.vertex(p, &mut cells);
                if from != to {
                    all.add(from, to, edge, *side, &mut between);
                }
                from = to;
            }
        }
        all
    }

    /// Returns the vertex at a place, a new one where there is none.
    fn vertex(&mut self, p: V, cells: &mut BTreeMap<(i64, i64), Vec<usize>>) -> usize {
        let cell = |x: f64| (x / (4.0 * self.near)).floor() as i64;
        let (i, j) = (cell(p[0]), cell(p[1]));
        for a in i - 1..=i + 1 {
            for b in j - 1..=j + 1 {
                let known = cells.get(&(a, b)).into_iter().flatten();
                let is_near = |&&v: &&usize| distance(self.vertices[v], p) <= 2.0 * self.near;
                if let Some(&v) = known.into_iter().find(is_near) {
                    return v;
                }
            }
        }
        self.vertices.push(p);
        cells.entry((i, j)).or_default().push(self.vertices.len() - 1);
        self.vertices.len() - 1
    }

    /// Adds a piece, or its runs to the one that it coincides with.
    fn add(
        &mut self,
        from: usize,
        to: usize,
        of: &Edge,
        side: usize,
        between: &mut BTreeMap<(usize, usize), Vec<usize>>,
    ) {
        let (p, q) = (self.vertices[from], self.vertices[to]);
        let edge = match of.carrier {
            Carrier::Straight => Edge::segment(p, q),
            Carrier::Round { center, radius } => Edge::around(center, radius, p, q),
        };
        let mid = edge.at(0.5);
        let known = between.entry((from.min(to), from.max(to))).or_default();
        let is_same = |&&k: &&usize| distance(self.pieces[k].mid, mid) <= 8.0 * self.near;
        let k = match known.iter().find(is_same) {
            Some(&k) => k,
            None => {
                known.push(self.pieces.len());
                self.pieces.push(Piece { from, to, edge, mid, runs: [0, 0] });
                self.pieces.len() - 1
            }
        };
        let piece = &mut self.pieces[k];
        piece.runs[side] += if piece.from == from { 1 } else { -1 };
    }

    /// Returns how often each side's rings run around what lies to the left of a piece, and to its right.
    ///
    /// A ray to the right of the middle of the piece counts what it crosses of the others; the ends of a piece that
    /// are no higher than the ray are below it, so that no vertex is counted twice.
    pub(crate) fn windings(&self, k: usize) -> ([i32; 2], [i32; 2]) {
        let piece = &self.pieces[k];
        let m = piece.mid;
        let mut around = [0, 0];
        for (i, other) in self.pieces.iter().enumerate() {
            let (a, b) = (self.vertices[other.from], self.vertices[other.to]);
            let (starts_below, ends_below) = (a[1] <= m[1], b[1] <= m[1]);
            if i == k || starts_below == ends_below || !is_right_of(other, a, b, m) {
                continue;
            }
            for (around, runs) in around.iter_mut().zip(other.runs) {
                *around += if starts_below { runs } else { -runs };
            }
        }
        let (a, b) = (self.vertices[piece.from], self.vertices[piece.to]);
        // the ray begins to the right of what runs up, and above or below what runs along it
        let began_left = match (a[1] <= m[1], b[1] <= m[1]) {
            (true, false) => false,
            (false, true) => true,
            (true, true) => b[0] > a[0],
            (false, false) => b[0] < a[0],
        };
        let beside = |sign: i32| [0, 1].map(|s| around[s] + sign * piece.runs[s]);
        if began_left { (around, beside(-1)) } else { (beside(1), around) }
    }
}

/// Returns true for a piece between heights that lies to the right of a place.
fn is_right_of(piece: &Piece, a: V, b: V, m: V) -> bool {
    match piece.edge.carrier {
        Carrier::Straight => {
            // no sign of an area is asked for where the ends say it, so that rounding does not count
            if m[0] < a[0].min(b[0]) {
                return true;
            }
            let aside = cross(minus(b, a), minus(m, a));
            m[0] <= a[0].max(b[0]) && if b[1] > a[1] { aside > 0.0 } else { aside < 0.0 }
        }
        Carrier::Round { center, radius } => {
            let up = m[1] - center[1];
            let half = sqrt((radius * radius - up * up).max(0.0));
            let x = if piece.mid[0] >= center[0] { center[0] + half } else { center[0] - half };
            x > m[0]
        }
    }
}

/// Returns an upright box around an edge.
pub(crate) fn bounds(e: &Edge) -> [V; 2] {
    let (a, b) = match e.carrier {
        Carrier::Round { center: [x, y], radius } => {
            let r = radius.abs();
            ([x - r, y - r], [x + r, y + r])
        }
        Carrier::Straight => (e.from, e.to),
    };
    [[a[0].min(b[0]), a[1].min(b[1])], [a[0].max(b[0]), a[1].max(b[1])]]
}

fn apart(a: &[V; 2], b: &[V; 2], near: f64) -> bool {
    (0..2).any(|i| a[0][i] > b[1][i] + near || b[0][i] > a[1][i] + near)
}
