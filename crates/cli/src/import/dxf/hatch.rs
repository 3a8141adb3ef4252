//! Hatches: what closed rings of segments, arcs, elliptic arcs and splines surround.

use super::{Entity, Figure, Found, Read, found, spline};
use base::number::{cos, sin, tan};
use drawing::curve::{self, corners_along};
use drawing::nurbs::Nurbs;
use drawing::{Corner, Point, Shape};
use std::f64::consts::TAU;

/// The values of an entity, read one after the other.
struct Values<'e> {
    values: &'e [(i32, &'e str)],
    scale: f64,
}

impl Values<'_> {
    /// Returns the next value of a code, and goes on behind it.
    fn next(&mut self, code: i32) -> Option<f64> {
        let at = self.values.iter().position(|(c, _)| *c == code)?;
        let value = self.values[at].1.trim().parse().ok().filter(|x: &f64| x.is_finite());
        self.values = &self.values[at + 1..];
        value
    }
    /// Returns the value of a code where it comes next.
    fn here(&mut self, code: i32) -> Option<f64> {
        let is_here = self.values.first().is_some_and(|(c, _)| *c == code);
        if is_here { self.next(code) } else { None }
    }
    fn point(&mut self, code: i32) -> Option<Point> {
        let (x, y) = (self.next(code)?, self.next(code + 10)?);
        Some(Point { x: self.scale * x, y: self.scale * y })
    }
}

/// Reads a HATCH: each outer path begins a surface, others are holes in it.
pub(super) fn surfaces(entity: &Entity<'_>, scale: f64, read: &mut Read) {
    let mut values = Values { values: &entity.values, scale };
    if entity.number(70) == Some(0.0) {
        read.notes.push("the pattern of a HATCH: it is filled".into());
    }
    let count = values.next(91).unwrap_or(0.0) as usize;
    let mut surfaces: Vec<Vec<Vec<Corner>>> = Vec::new();
    for _ in 0..count {
        let Some(kind) = values.next(92) else { break };
        let kind = kind as i64;
        let ring = if kind & 2 == 2 { polyline(&mut values) } else { edges(&mut values) };
        match ring {
            Some(ring) if ring.len() > 1 => match surfaces.last_mut() {
                Some(surface) if kind & (1 | 16) == 0 => surface.push(ring),
                _ => surfaces.push(vec![ring]),
            },
            _ => read.notes.push("a path of a HATCH that is no ring".into()),
        }
    }
    if surfaces.is_empty() {
        read.notes.push("HATCH without a path".into());
    }
    read.found.extend(surfaces.into_iter().map(|rings| found(Figure::Surface(rings))));
}

fn polyline(values: &mut Values<'_>) -> Option<Vec<Corner>> {
    let bends = values.next(72)? != 0.0;
    let count = values.next(93)? as usize;
    let mut ring = Vec::new();
    for _ in 0..count {
        let at = values.point(10)?;
        let bulge = if bends { values.here(42).unwrap_or(0.0) } else { 0.0 };
        ring.push(Corner::new(at, bulge));
    }
    Some(ring)
}

/// Reads a path of edges; nothing where one is of no known kind, or lacks some of its numbers.
fn edges(values: &mut Values<'_>) -> Option<Vec<Corner>> {
    let count = values.next(93)? as usize;
    let mut ring = Vec::new();
    for _ in 0..count {
        match values.next(72)? as i64 {
            1 => {
                let from = values.point(10)?;
                values.point(11)?;
                ring.push(Corner::new(from, 0.0));
            }
            2 => {
                let center = values.point(10)?;
                let radius = values.scale * values.next(40)?;
                let (start, end) = (values.next(50)?.to_radians(), values.next(51)?.to_radians());
                let is_left = values.next(73)? != 0.0;
                let sweep = (end - start).rem_euclid(TAU);
                let sweep = if sweep < 1e-9 { TAU } else { sweep };
                // where it runs to the right, its angles are counted to the right
                let sign = if is_left { 1.0 } else { -1.0 };
                let parts = if sweep > 0.5 * TAU { 2 } else { 1 };
                for i in 0..parts {
                    let part = sweep / f64::from(parts);
                    let angle = sign * (start + f64::from(i) * part);
                    let at = Point {
                        x: center.x + radius * cos(angle),
                        y: center.y + radius * sin(angle),
                    };
                    ring.push(Corner::new(at, sign * tan(0.25 * part)));
                }
            }
            3 => ring.extend(along(&elliptic_arc(values)?)?),
            4 => ring.extend(along(&curves(values)?)?),
            _ => return None,
        }
    }
    Some(ring)
}

/// Returns the corners along an edge, without the last, where the next edge begins.
fn along(edge: &Shape) -> Option<Vec<Corner>> {
    let mut corners = corners_along(edge)?;
    corners.pop();
    Some(corners)
}

/// Reads an elliptic arc; nothing for one that has no width.
fn elliptic_arc(values: &mut Values<'_>) -> Option<Shape> {
    let (center, major, ratio) = (values.point(10)?, values.point(11)?, values.next(40)?);
    let (start, end) = (values.next(50)?.to_radians(), values.next(51)?.to_radians());
    let is_left = values.next(73)? != 0.0;
    let sweep = (end - start).rem_euclid(TAU);
    let sweep = if sweep < 1e-9 { TAU } else { sweep };
    // where it runs to the right, its angles are counted to the right
    let sign = if is_left { 1.0 } else { -1.0 };
    let across = Point { x: -ratio * major.y, y: ratio * major.x };
    let is_sound = ratio > 0.0 && curve::half_axis(major) > 0.0;
    let across = curve::half_axis(across);
    is_sound.then(|| curve::ellipse(center, major, across, sign * start, sign * sweep))
}

/// Reads a spline as Bézier curves.
fn curves(values: &mut Values<'_>) -> Option<Shape> {
    let degree = values.next(94)? as usize;
    let is_rational = values.next(73)? != 0.0;
    let (knot_count, pole_count) = (values.next(95)? as usize, values.next(96)? as usize);
    // no more than there are: a count may be anything
    let most = values.values.len();
    let knots = (0..knot_count.min(most)).map(|_| values.next(40)).collect::<Option<Vec<f64>>>()?;
    let (mut poles, mut weights) = (Vec::new(), Vec::new());
    for _ in 0..pole_count.min(most) {
        poles.push(values.point(10)?);
        weights.push(if is_rational { values.here(42).unwrap_or(1.0) } else { 1.0 });
    }
    let is_plain = weights.windows(2).all(|w| w[0] == w[1]);
    match is_plain && degree <= 3 {
        true => spline::bezier(degree, &knots, &poles).map(Shape::Spline),
        false => Nurbs::new(degree, knots, poles, weights).ok().map(Shape::Nurbs),
    }
}

/// Leaves out the edges of rings that surround a surface which is drawn with its own: polylines drawn around a hatch.
pub(super) fn without_edges(all: &mut Vec<Found>) {
    let rings = all.iter().filter_map(|found| match &found.figure {
        Figure::Surface(rings) => Some(rings),
        _ => None,
    });
    let around: Vec<Figure> = rings
        .flatten()
        .flat_map(|ring| {
            let next = ring.iter().skip(1).chain(ring.first());
            ring.iter().zip(next).map(|(from, to)| super::edge(*from, *to)).collect::<Vec<_>>()
        })
        .collect();
    all.retain(|found| !(found.is_of_ring && around.contains(&found.figure)));
}
