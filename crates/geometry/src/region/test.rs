//! Tests of outcomes: they share nothing with how outcomes are found but the edges themselves.

use crate::region::edge::{Edge, V, distance, further};
use crate::region::rings::winding;
use crate::region::{Combination, NoRegion};

/// How many places all over the regions are looked at.
const PLACES: u32 = 48;
/// How many edges are looked at on both sides.
const MOST_SIDES: usize = 64;
/// How far the two sides of a sum of areas may differ, as a part of the areas.
const AREAS: f64 = 1e-9;

/// What was combined, and what came of it.
pub(crate) struct Combined<'x> {
    pub(crate) how: Combination,
    pub(crate) sides: [&'x [Edge]; 2],
    pub(crate) rings: &'x [Vec<Edge>],
    pub(crate) near: f64,
    pub(crate) area: &'x dyn Fn(Combination) -> f64,
}

/// Tests what was combined: the areas of union and intersection are together those of the two, every end lies on
/// what was combined, and places are inside where the two say so.
pub(crate) fn combined(c: &Combined<'_>) -> Result<(), NoRegion> {
    let area = |edges: &[Edge]| edges.iter().map(Edge::area).sum::<f64>();
    let [a, b] = c.sides.map(area);
    let (union, both) = ((c.area)(Combination::Union), (c.area)(Combination::Intersection));
    let (less, outcome) = ((c.area)(Combination::Difference), (c.area)(c.how));
    let found: f64 = c.rings.iter().map(|ring| area(ring)).sum();
    let is_near = |x: f64, y: f64| (x - y).abs() <= AREAS * (a + b);
    if !(is_near(union + both, a + b) && is_near(less + both, a) && is_near(found, outcome)) {
        return Err(NoRegion::NotDecided);
    }
    let sources = || c.sides.iter().copied().flatten();
    let on_source = |p: V| sources().any(|e| e.distance(p) <= 4.0 * c.near);
    let result = || c.rings.iter().flatten();
    if !result().all(|e| on_source(e.from) && on_source(e.at(0.5))) {
        return Err(NoRegion::NotDecided);
    }
    let is_right = |p: V| {
        let inside = c.sides.map(|edges| winding(edges, p) > 0);
        winding(result(), p) == i32::from(c.how.of(inside[0], inside[1]))
    };
    all_places(&sources(), &result(), c.near, is_right)
}

/// Tests what was offset: it is so far from what it was offset from, and places are inside where that is nearer.
pub(crate) fn offset(of: &[Edge], by: f64, rings: &[Vec<Edge>], near: f64) -> Result<(), NoRegion> {
    let away = |p: V| of.iter().map(|e| e.distance(p)).fold(f64::INFINITY, f64::min);
    let result = || rings.iter().flatten();
    let is_so_far = |p: V| (away(p) - by.abs()).abs() <= 64.0 * near;
    if !result().all(|e| is_so_far(e.from) && is_so_far(e.at(0.5))) {
        return Err(NoRegion::NotDecided);
    }
    let is_right = |p: V| {
        let (is_within, far) = (winding(of, p) > 0, away(p));
        if (far - by.abs()).abs() <= 64.0 * near {
            return true;
        }
        let inside = if by > 0.0 { is_within || far < by } else { is_within && far > -by };
        winding(result(), p) == i32::from(inside)
    };
    all_places(&of.iter(), &result(), near, is_right)
}

/// Looks at places all over some edges, and at both sides of others, where these are not on one of them.
fn all_places<'a>(
    sources: &(impl Iterator<Item = &'a Edge> + Clone),
    result: &(impl Iterator<Item = &'a Edge> + Clone),
    near: f64,
    is_right: impl Fn(V) -> bool,
) -> Result<(), NoRegion> {
    let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for p in sources.clone().flat_map(|e| [e.from, e.at(0.5), e.to]) {
        for i in 0..2 {
            (least[i], most[i]) = (least[i].min(p[i]), most[i].max(p[i]));
        }
    }
    let is_clear = |p: V, room: f64| {
        let mut all = sources.clone().chain(result.clone());
        all.all(|e| e.distance(p) > room)
    };
    // Roberts, The unreasonable effectiveness of quasirandom sequences (2018)
    let spread = (1..=PLACES).map(|k| {
        let part =
            [0.754_877_666_246_692_8, 0.569_840_290_998_053_2].map(|x| (f64::from(k) * x).fract());
        [0, 1].map(|i| least[i] + part[i] * (most[i] - least[i]))
    });
    for p in spread.filter(|&p| is_clear(p, 16.0 * near)) {
        if !is_right(p) {
            return Err(NoRegion::NotDecided);
        }
    }
    for e in result.clone().chain(sources.clone()).take(MOST_SIDES) {
        let aside = 1e-3 * e.chord().max(distance(e.from, e.at(0.5)));
        let ([x, y], mid) = (e.way(0.5), e.at(0.5));
        for side in [aside, -aside] {
            let p = further(mid, side, [-y, x]);
            if aside > 64.0 * near && is_clear(p, 0.25 * aside) && !is_right(p) {
                return Err(NoRegion::NotDecided);
            }
        }
    }
    Ok(())
}
