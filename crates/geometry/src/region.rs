//! Regions: what contours of segments and arcs surround, combined and offset; arcs stay arcs.
//!
//! Edges are cut where they meet, what coincides is made one, and of the pieces those are kept that have the inside to
//! one side alone. So outcomes are regular: no edge dangles, and what touches in a place stays apart there. Every
//! outcome is tested before it is answered (`region/test.rs`); where a test fails, there is none.
//!
//! ```
//! use geometry::{Bend, Combination, Surface, combine};
//! let ring = |r: f64| vec![Bend { at: [r, 0.0], bulge: 1.0 }, Bend { at: [-r, 0.0], bulge: 1.0 }];
//! let disc = |r| vec![Surface { outer: ring(r), holes: Vec::new() }];
//! let washer = combine(Combination::Difference, &disc(8.0), &disc(4.2)).unwrap();
//! assert_eq!((washer.len(), washer[0].holes.len()), (1, 1));
//! assert!((washer[0].area() - std::f64::consts::PI * (64.0 - 17.64)).abs() < 1e-12 * 64.0);
//! ```
mod arrange;
pub(crate) mod edge;
mod rings;
mod test;

use crate::region::arrange::{Arrangement, bounds};
use crate::region::edge::{Carrier, Edge, V, cross, dot, further};
use crate::region::rings::{joined, nested, simplified, winding};

/// How many edges regions that are combined may have together.
const MOST_EDGES: usize = 4000;
/// Within what part of their extent places are one.
pub(crate) const NEAR: f64 = 1e-9;

/// A corner of a ring, and how what leaves it bends.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bend {
    /// Where it is.
    pub at: [f64; 2],
    /// The tangent of a quarter of the angle that the arc to the next corner turns left; 0 for a segment.
    pub bulge: f64,
}

/// Corners, from the last back to the first.
pub type Ring = Vec<Bend>;

/// What a ring surrounds, without what its holes surround; of outcomes the ring runs to the left, holes to the right.
#[derive(Clone, PartialEq, Debug)]
pub struct Surface {
    /// The ring around it.
    pub outer: Ring,
    /// Rings inside it that do not cross.
    pub holes: Vec<Ring>,
}

/// A way to make one region of two.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Combination {
    /// What either covers.
    Union,
    /// What the first covers and the second does not.
    Difference,
    /// What both cover.
    Intersection,
}

/// Why there is no region.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum NoRegion {
    /// A ring crosses itself or another of its region, or surrounds nothing.
    Crossing,
    /// What was found does not pass its tests.
    NotDecided,
    /// More edges than can be looked at.
    TooLarge,
}

impl NoRegion {
    /// Returns the reason in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Crossing => "a contour crosses itself or another, or surrounds nothing",
            Self::NotDecided => {
                "it is not decided: curves come so near that rounding would choose the outcome"
            }
            Self::TooLarge => "its contours have more than 4000 edges",
        }
    }
}

impl Surface {
    /// Returns how much it covers.
    pub fn area(&self) -> f64 {
        let area = |ring: &Ring| edges(ring, [0.0; 2]).iter().map(Edge::area).sum::<f64>().abs();
        area(&self.outer) - self.holes.iter().map(area).sum::<f64>()
    }
}

/// Combines two regions, each of surfaces that do not overlap.
///
/// # Errors
/// A contour that crosses itself; an outcome that is not decided.
pub fn combine(
    how: Combination,
    first: &[Surface],
    second: &[Surface],
) -> Result<Vec<Surface>, NoRegion> {
    let frame = Frame::of(&[first, second])?;
    let (a, b) = (frame.edges(first)?, frame.edges(second)?);
    let sided = |edges: &[Edge], side| edges.iter().map(|&e| (e, side)).collect::<Vec<_>>();
    let all = Arrangement::new(&[sided(&a, 0), sided(&b, 1)].concat(), frame.near);
    let windings: Vec<_> = (0..all.pieces.len()).map(|k| all.windings(k)).collect();
    let is_simple = |w: &[i32; 2]| w.iter().all(|w| (0..=1).contains(w));
    if !windings.iter().all(|(left, right)| is_simple(left) && is_simple(right)) {
        return Err(NoRegion::Crossing);
    }
    let chosen = |how: Combination| -> Vec<(usize, bool)> {
        let kept = windings.iter().map(|(left, right)| (how.keeps(*left), how.keeps(*right)));
        kept.enumerate().filter(|(_, (l, r))| l != r).map(|(k, (l, _))| (k, !l)).collect()
    };
    let rings = frame.rings(&all, &chosen(how))?;
    let area = |how| all.area(&chosen(how));
    test::combined(&test::Combined {
        how,
        sides: [&a, &b],
        rings: &rings,
        near: frame.near,
        area: &area,
    })?;
    nested(rings, frame.origin).ok_or(NoRegion::NotDecided)
}

/// Returns what is within a distance of a region; where that is negative, what is further than that inside it.
///
/// # Errors
/// A contour that crosses itself; an outcome that is not decided.
pub fn offset(of: &[Surface], by: f64) -> Result<Vec<Surface>, NoRegion> {
    // surfaces that touch are one here
    let of = combine(Combination::Union, of, &[])?;
    if by == 0.0 || of.is_empty() {
        return Ok(of);
    }
    let frame = Frame::of(&[&of])?;
    let frame = Frame { near: frame.near.max(NEAR * by.abs()), ..frame };
    let boundary = frame.edges(&of)?;
    let mut moved = Vec::new();
    for ring in of.iter().flat_map(|s| [&s.outer].into_iter().chain(&s.holes)) {
        moved.extend(aside(&edges(ring, frame.origin), by, frame.near));
    }
    if moved.len() > MOST_EDGES {
        return Err(NoRegion::TooLarge);
    }
    let sided: Vec<_> = moved.into_iter().map(|e| (e, 0)).collect();
    let all = Arrangement::new(&sided, frame.near);
    let away = |p: V| boundary.iter().map(|e| e.distance(p)).fold(f64::INFINITY, f64::min);
    let is_far = |k: &usize| {
        let mid = all.pieces[*k].mid;
        // where a contour turns back, what rounds it may be on the wrong side
        away(mid) >= by.abs() - 16.0 * frame.near && (winding(&boundary, mid) > 0) == (by < 0.0)
    };
    let runs = |k: usize| (all.pieces[k].runs[0] != 0).then_some((k, all.pieces[k].runs[0] < 0));
    let chosen: Vec<_> = (0..all.pieces.len()).filter(is_far).filter_map(runs).collect();
    let rings = frame.rings(&all, &chosen)?;
    test::offset(&boundary, by, &rings, frame.near)?;
    nested(rings, frame.origin).ok_or(NoRegion::NotDecided)
}

impl Combination {
    fn keeps(self, [first, second]: [i32; 2]) -> bool {
        self.of(first > 0, second > 0)
    }
    /// Returns whether a place is in the outcome, by whether it is in the first and in the second.
    fn of(self, first: bool, second: bool) -> bool {
        match self {
            Self::Union => first || second,
            Self::Difference => first && !second,
            Self::Intersection => first && second,
        }
    }
}

impl Arrangement {
    /// Returns the area of what pieces surround, the inside to their left.
    fn area(&self, chosen: &[(usize, bool)]) -> f64 {
        let area = |&(k, against): &(usize, bool)| {
            let area = self.pieces[k].edge.area();
            if against { -area } else { area }
        };
        chosen.iter().map(area).sum()
    }
}

/// Where and how large what is computed is.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    origin: V,
    near: f64,
}

impl Frame {
    /// Looks at regions: the origin is moved to their middle, so that far away is as exact as near.
    pub(crate) fn of(regions: &[&[Surface]]) -> Result<Self, NoRegion> {
        let surfaces = || regions.iter().copied().flatten();
        let rings = || surfaces().flat_map(|s| [&s.outer].into_iter().chain(&s.holes));
        let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        let mut n = 0;
        for edge in rings().flat_map(|ring| edges(ring, [0.0; 2])) {
            let [a, b] = bounds(&edge);
            for i in 0..2 {
                (least[i], most[i]) = (least[i].min(a[i]), most[i].max(b[i]));
            }
            n += 1;
        }
        if n == 0 {
            return Ok(Self { origin: [0.0; 2], near: NEAR });
        }
        if n > MOST_EDGES {
            return Err(NoRegion::TooLarge);
        }
        let origin = [0, 1].map(|i| 0.5 * (least[i] + most[i]));
        let extent = (most[0] - least[0]).max(most[1] - least[1]);
        let near = NEAR * extent;
        // places are counted in cells of this size
        let is_sound = near > 0.0 && extent.is_finite() && origin.iter().all(|x| x.is_finite());
        if is_sound { Ok(Self { origin, near }) } else { Err(NoRegion::Crossing) }
    }
    /// Returns the edges of a region, the inside to the left of each.
    fn edges(&self, of: &[Surface]) -> Result<Vec<Edge>, NoRegion> {
        let mut all = Vec::new();
        for surface in of {
            let rings = [(&surface.outer, true)].into_iter();
            for (ring, is_outer) in rings.chain(surface.holes.iter().map(|h| (h, false))) {
                let ring = edges(ring, self.origin);
                let area: f64 = ring.iter().map(Edge::area).sum();
                if area.abs() <= self.near * self.near {
                    return Err(NoRegion::Crossing);
                }
                match (area > 0.0) == is_outer {
                    true => all.extend(ring),
                    false => all.extend(ring.into_iter().rev().map(Edge::reversed)),
                }
            }
        }
        Ok(all)
    }
    fn rings(
        &self,
        all: &Arrangement,
        chosen: &[(usize, bool)],
    ) -> Result<Vec<Vec<Edge>>, NoRegion> {
        let rings = joined(all, chosen).ok_or(NoRegion::NotDecided)?;
        Ok(rings.into_iter().map(|ring| simplified(ring, self.near)).collect())
    }
}

/// Returns the edges of a ring, without those that have no length.
fn edges(ring: &Ring, origin: V) -> Vec<Edge> {
    let place = |b: &Bend| further(b.at, -1.0, origin);
    let next = ring.iter().skip(1).chain(ring.first());
    let edge = |(b, c): (&Bend, &Bend)| Edge::bent(place(b), place(c), b.bulge);
    ring.iter().zip(next).map(edge).filter(|e| e.from != e.to).collect()
}

/// Moves the edges of a ring to their right, to the left where `by` is negative, and rounds the corners that open.
fn aside(ring: &[Edge], by: f64, near: f64) -> Vec<Edge> {
    let mut moved = Vec::new();
    let right = |way: V| [way[1], -way[0]];
    let next = ring.iter().skip(1).chain(ring.first());
    for (edge, next) in ring.iter().zip(next) {
        let (begins, ends) = (edge.way(0.0), edge.way(1.0));
        let (from, to) = (further(edge.from, by, right(begins)), further(edge.to, by, right(ends)));
        match edge.carrier {
            Carrier::Straight => moved.push(Edge::segment(from, to)),
            // an arc that would turn the other way is nowhere at this distance
            Carrier::Round { center, radius } if (radius + by) * radius > near * radius.abs() => {
                let carrier = Carrier::Round { center, radius: radius + by };
                moved.push(Edge { from, to, carrier, sweep: edge.sweep });
            }
            Carrier::Round { .. } => {}
        }
        let leaves = next.way(0.0);
        let turn = cross(ends, leaves);
        let opens = turn * by > 1e-12 * by.abs() || dot(ends, leaves) < -1.0 + 1e-12;
        if opens {
            moved.push(Edge::around(edge.to, by, to, further(edge.to, by, right(leaves))));
        }
    }
    moved
}
