//! Contours of edges that hang together, and the edges of regions by what they come from.
//!
//! Which way an edge was drawn, and in which order, plays no part: where ends meet, the contour goes on. So it has one
//! answer, that runs as its first edge does, or a reason why there is none.

use crate::region::edge::{Carrier, Edge, cross, distance, dot, minus};
use crate::region::{Bend, Frame, NEAR, NoRegion, Ring, Surface};
use std::f64::consts::TAU;

/// So many edges a contour may have.
const MOST_EDGES: usize = 4000;

/// An edge: from where to where it runs, and how it bends between.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Side {
    /// Where it begins.
    pub from: [f64; 2],
    /// Where it ends.
    pub to: [f64; 2],
    /// The tangent of a quarter of the angle that it turns left; 0 for a segment.
    pub bulge: f64,
}

/// Why edges make no contour. Edges are counted from 1, as they were given.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NoContour {
    /// There are none.
    Empty,
    /// Nothing goes on from an end of this one.
    Open(usize),
    /// Several go on from an end of this one.
    Branches(usize),
    /// This one is no part of the ring that the first is in.
    Apart(usize),
    /// More edges than can be looked at.
    TooLarge,
}

impl NoContour {
    /// Returns the reason in words.
    pub fn words(self) -> String {
        match self {
            Self::Empty => "it has no edges".into(),
            Self::Open(edge) => format!("it is open: nothing goes on where edge {edge} ends"),
            Self::Branches(edge) => format!("more than one edge goes on where edge {edge} ends"),
            Self::Apart(edge) => format!("edge {edge} hangs apart from the first"),
            Self::TooLarge => "it has more than 4000 edges".into(),
        }
    }
}

impl Side {
    /// Returns the centre of the circle that it is a part of; nothing for a segment.
    pub fn center(&self) -> Option<[f64; 2]> {
        match Edge::bent(self.from, self.to, self.bulge).carrier {
            Carrier::Round { center, .. } => Some(center),
            Carrier::Straight => None,
        }
    }

    /// Whether another is the same edge, whichever way it runs.
    pub fn is_one_with(&self, other: &Self) -> bool {
        *self == *other || self.reversed() == *other
    }

    /// Whether another, the same edge, runs as it does.
    pub fn runs_as(&self, other: &Self) -> bool {
        self.from == other.from && self.to == other.to
    }

    fn reversed(self) -> Self {
        // a straight edge keeps its zero: negative zero is nowhere
        Self { from: self.to, to: self.from, bulge: 0.0 - self.bulge }
    }
}

/// Whether two places are one, among edges that take up `extent` the longer way; all in one unit of length.
pub fn meets(p: [f64; 2], q: [f64; 2], extent: f64) -> bool {
    distance(p, q) <= NEAR * extent
}

/// Makes one ring of edges, whichever way and in whichever order they are given; it runs as the first does.
///
/// ```
/// use geometry::{NoContour, Side, contour};
/// let side = |from, to, bulge| Side { from, to, bulge };
/// let lid = side([1.0, 0.0], [-1.0, 0.0], 1.0);
/// let floor = side([1.0, 0.0], [-1.0, 0.0], 0.0);
/// assert_eq!(contour(&[lid, floor]).unwrap().len(), 2);
/// assert_eq!(contour(&[lid]), Err(NoContour::Open(1)));
/// // what has no length plays no part
/// let dot = side([1.0, 0.0], [1.0, 0.0], 0.0);
/// assert_eq!(contour(&[dot, lid, dot, floor]), contour(&[lid, floor]));
/// ```
///
/// # Errors
/// They are open somewhere, branch, or are several rings.
pub fn contour(sides: &[Side]) -> Result<Ring, NoContour> {
    let bend = |(i, is_back): (usize, bool)| {
        let side = if is_back { sides[i].reversed() } else { sides[i] };
        Bend { at: side.from, bulge: side.bulge }
    };
    Ok(order(sides)?.into_iter().map(bend).collect())
}

/// Puts edges in the order in which one ring runs through them; returns of each its place among them, counted from 0,
/// and whether it is run through backwards.
///
/// # Errors
/// They are open somewhere, branch, or are several rings.
pub fn order(sides: &[Side]) -> Result<Vec<(usize, bool)>, NoContour> {
    // what has no length leads nowhere
    let mut is_used: Vec<bool> = sides.iter().map(|side| side.from == side.to).collect();
    let begin = is_used.iter().position(|is_used| !is_used).ok_or(NoContour::Empty)?;
    let first = sides[begin];
    if sides.len() > MOST_EDGES {
        return Err(NoContour::TooLarge);
    }
    let extent = extent(sides);
    let meets = |p: [f64; 2], q: [f64; 2]| meets(p, q, extent);
    let mut ring = vec![(begin, false)];
    is_used[begin] = true;
    let (mut last, mut at) = (begin, first.to);
    loop {
        let goes_on =
            |&i: &usize| !is_used[i] && (meets(sides[i].from, at) || meets(sides[i].to, at));
        let mut next = (0..sides.len()).filter(goes_on);
        match (next.next(), next.next()) {
            (Some(only), None) if !meets(at, first.from) => {
                let side = sides[only];
                let is_back = !meets(side.from, at);
                ring.push((only, is_back));
                is_used[only] = true;
                (last, at) = (only, if is_back { side.from } else { side.to });
            }
            (Some(_), _) => return Err(NoContour::Branches(last + 1)),
            (None, _) => break,
        }
    }
    match is_used.iter().position(|is_used| !is_used) {
        _ if ring.len() < 2 || !meets(at, first.from) => Err(NoContour::Open(last + 1)),
        Some(apart) => Err(NoContour::Apart(apart + 1)),
        None => Ok(ring),
    }
}

/// What an edge can come from.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Source {
    /// A segment.
    Line([f64; 2], [f64; 2]),
    /// A straight line without ends.
    Axis([f64; 2], [f64; 2]),
    /// A whole circle, by its centre and radius.
    Circle([f64; 2], f64),
    /// A part of one, by what it bends.
    Arc(Side),
}

/// Finds the edges of a region that come from something: that lie on it, in part at least. They are in the order in
/// which it runs through them, a circle from its right, and run as it does.
///
/// # Errors
/// The region cannot be read.
pub fn edges_from(region: &[Surface], source: &Source) -> Result<Vec<Side>, NoRegion> {
    Frame::of(&[region])?;
    let sides: Vec<Side> = region.iter().flat_map(sides_of).collect();
    Ok(edges_of(&sides, source))
}

/// Lists the edges of a surface, as they were given, without those that have no length.
pub fn sides_of(surface: &Surface) -> impl Iterator<Item = Side> {
    let rings = [&surface.outer].into_iter().chain(&surface.holes);
    let sides = rings.flat_map(|ring| {
        let next = ring.iter().skip(1).chain(ring.first());
        ring.iter().zip(next).map(|(a, b)| Side { from: a.at, to: b.at, bulge: a.bulge })
    });
    sides.filter(|side| side.from != side.to)
}

/// Finds those of some edges that come from something, as [`edges_from`] does for a region.
pub fn edges_of(sides: &[Side], source: &Source) -> Vec<Side> {
    let near = NEAR * extent(sides);
    // so that far away is as exact as near
    let origin = sides.first().map_or([0.0; 2], |side| side.from);
    let own = source.moved(origin);
    let mut found: Vec<(f64, Side)> = Vec::new();
    for &side in sides {
        let along = |side: Side| {
            let edge = Edge::bent(minus(side.from, origin), minus(side.to, origin), side.bulge);
            own.begins(&edge, near).map(|at| (at, side))
        };
        found.extend(along(side).or_else(|| along(side.reversed())));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|(_, side)| side).collect()
}

/// Returns how large what edges take up is, the longer way, in their unit of length.
pub fn extent(sides: &[Side]) -> f64 {
    let of = |i: usize| sides.iter().flat_map(move |s| [s.from[i], s.to[i]]);
    let span = |i| of(i).fold(f64::NEG_INFINITY, f64::max) - of(i).fold(f64::INFINITY, f64::min);
    f64::max(span(0), span(1))
}

impl Source {
    fn moved(self, origin: [f64; 2]) -> Self {
        let own = |p| minus(p, origin);
        match self {
            Self::Line(a, b) => Self::Line(own(a), own(b)),
            Self::Axis(a, b) => Self::Axis(own(a), own(b)),
            Self::Circle(center, radius) => Self::Circle(own(center), radius),
            Self::Arc(side) => Self::Arc(Side { from: own(side.from), to: own(side.to), ..side }),
        }
    }

    /// How far along it an edge begins that lies on it and runs as it does; nothing for any other edge.
    fn begins(&self, edge: &Edge, near: f64) -> Option<f64> {
        match (*self, edge.carrier) {
            (Self::Line(a, b), Carrier::Straight) => {
                let [begins, ends] = on_straight([a, b], edge, near)?;
                let common = ends.min(distance(a, b)) - begins.max(0.0);
                (common > near).then_some(begins)
            }
            (Self::Axis(a, b), Carrier::Straight) => Some(on_straight([a, b], edge, near)?[0]),
            (Self::Circle(center, radius), Carrier::Round { .. }) => {
                let right = [center[0] + radius.abs(), center[1]];
                on_round((center, radius), right, edge, near)
            }
            (Self::Arc(side), Carrier::Round { .. }) => {
                let own = Edge::bent(side.from, side.to, side.bulge);
                let Carrier::Round { center, radius } = own.carrier else { return None };
                let begins = on_round((center, radius), own.from, edge, near)?;
                let is_common =
                    own.distance(edge.at(0.5)) <= near || edge.distance(own.at(0.5)) <= near;
                is_common.then_some(begins)
            }
            _ => None,
        }
    }
}

/// From where to where along a straight an edge lies that runs as it does.
fn on_straight([a, b]: [[f64; 2]; 2], edge: &Edge, near: f64) -> Option<[f64; 2]> {
    let (way, length) = (minus(b, a), distance(a, b));
    let is_on = |p| cross(way, minus(p, a)).abs() <= near * length;
    let along = |p| dot(way, minus(p, a)) / length;
    let [begins, ends] = [along(edge.from), along(edge.to)];
    (length > 0.0 && is_on(edge.from) && is_on(edge.to) && begins < ends).then_some([begins, ends])
}

/// How far around a circle, from one of its places on and as it runs, an edge begins that lies on it and runs so.
fn on_round(
    (center, radius): ([f64; 2], f64),
    from: [f64; 2],
    edge: &Edge,
    near: f64,
) -> Option<f64> {
    let Carrier::Round { center: c, radius: r } = edge.carrier else { return None };
    if distance(c, center) > near || (r - radius).abs() > near {
        return None;
    }
    let angle = |p: [f64; 2]| base::number::atan2(p[1] - center[1], p[0] - center[0]);
    let turn = (angle(edge.from) - angle(from)) * radius.signum();
    let turn = if turn < -near / radius.abs() { turn + TAU } else { turn };
    // what begins just before its start begins there
    Some(if turn > TAU - near / radius.abs() { 0.0 } else { turn })
}
