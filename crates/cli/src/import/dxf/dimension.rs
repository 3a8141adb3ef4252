//! Dimensions: what they measure is read, how they look is not.

use super::blocks::apart;
use super::{Drawing, Entity, Figure, Measured, Read, What, found};
use base::number::{atan2, cos, rounded, sin};
use drawing::{Point, metrics};
use std::collections::BTreeMap;

/// How high words are where no style says it, in millimetres.
const USUAL: f64 = 3.5;

/// Finds how high the words of each style of dimensions are, in units of the drawing.
pub(super) fn styles<'t>(pairs: &[(i32, &'t str)]) -> BTreeMap<&'t str, f64> {
    let entries = super::section(pairs, "TABLES").unwrap_or_default();
    let style = |entry: &Entity<'t>| {
        let name = entry.values.iter().find(|(code, _)| *code == 2).map(|(_, v)| v.trim())?;
        let scale = entry.number(40).filter(|k| *k > 0.0).unwrap_or(1.0);
        Some((name, scale * entry.number(140).filter(|h| *h > 0.0)?))
    };
    entries.iter().filter(|e| e.kind == "DIMSTYLE").filter_map(style).collect()
}

impl Drawing<'_> {
    /// Reads a DIMENSION.
    pub(super) fn dimension(&self, entity: &Entity<'_>, read: &mut Read) {
        let at = |code: i32| entity.point(code, self.scale);
        let kind = entity.number(70).map_or(0, |kind| kind as i64 & 15);
        let style = entity.text(3).and_then(|name| self.styles.get(name.trim()));
        let size = style.map_or(USUAL, |height| height * self.scale);
        let what = match kind {
            0 | 1 => linear(entity, kind == 1, at),
            3 | 4 => round(kind == 3, size, at),
            2 => angle_between(at),
            5 => angle_at(at),
            _ => {
                read.notes.push("DIMENSION of a kind that is not understood".into());
                return;
            }
        };
        let Some(what) = what else {
            read.notes.push("DIMENSION without all of its numbers, or turned".into());
            return;
        };
        if entity.text(1).is_some_and(|words| !matches!(words.trim(), "" | "<>")) {
            read.notes.push("the words of a DIMENSION: it says what it measures".into());
        }
        read.found.push(found(Figure::Dimension(Measured { what, size })));
    }
}

fn linear(
    entity: &Entity<'_>,
    is_aligned: bool,
    at: impl Fn(i32) -> Option<Point>,
) -> Option<What> {
    let (line, from, to) = (at(10)?, at(13)?, at(14)?);
    if is_aligned {
        let length = apart(from, to);
        let aside = (to.x - from.x) * (line.y - from.y) - (to.y - from.y) * (line.x - from.x);
        return (length > 0.0).then(|| What::Aligned { from, to, aside: aside / length });
    }
    let angle = entity.number(50).unwrap_or(0.0).rem_euclid(180.0);
    let beside = |line: f64, a: f64, b: f64| {
        if line >= f64::midpoint(a, b) { line - a.max(b) } else { line - a.min(b) }
    };
    if angle.min(180.0 - angle) < 1e-9 {
        let aside = beside(line.y, from.y, to.y);
        return Some(What::Horizontal { from, to, aside });
    }
    let aside = beside(line.x, from.x, to.x);
    ((angle - 90.0).abs() < 1e-9).then_some(What::Vertical { from, to, aside })
}

fn round(is_across: bool, size: f64, at: impl Fn(i32) -> Option<Point>) -> Option<What> {
    let (first, end) = (at(10)?, at(15)?);
    let center = match is_across {
        true => Point { x: f64::midpoint(first.x, end.x), y: f64::midpoint(first.y, end.y) },
        false => first,
    };
    let radius = apart(center, end);
    let angle = atan2(end.y - center.y, end.x - center.x);
    // where the line to the words has its elbow, as they stand beside it
    let (c, s) = (cos(angle), sin(angle));
    let says = if is_across {
        format!("Ø{}", rounded(2.0 * radius, 3))
    } else {
        format!("R{}", rounded(radius, 3))
    };
    let wide = 1.5 * size + 0.5 * metrics::text_width(&says, size);
    let beyond = at(11).map(|words| {
        let x = words.x - if c >= 0.0 { wide } else { -wide } - center.x;
        let y = words.y - center.y;
        c * x + s * y - radius
    });
    let beyond = beyond.filter(|b| *b > 0.0).unwrap_or(0.25 * radius);
    (radius > 0.0).then_some(What::Radius { center, radius, angle, beyond, is_across })
}

fn angle_between(at: impl Fn(i32) -> Option<Point>) -> Option<What> {
    sector((at(13)?, at(14)?), (at(15)?, at(10)?), at(16)?)
}

fn angle_at(at: impl Fn(i32) -> Option<Point>) -> Option<What> {
    let corner = at(15)?;
    sector((corner, at(13)?), (corner, at(14)?), at(10)?)
}

/// Returns the angle between two lines in which a point of the arc lies.
fn sector(a: (Point, Point), b: (Point, Point), arc: Point) -> Option<What> {
    let way = |(p, q): (Point, Point)| Point { x: q.x - p.x, y: q.y - p.y };
    let cross = |p: Point, q: Point| p.x * q.y - p.y * q.x;
    let (u, v) = (way(a), way(b));
    let across = cross(u, v);
    if across.abs() <= 1e-12 * (u.x.abs() + u.y.abs()) * (v.x.abs() + v.y.abs()) {
        return None;
    }
    let part = cross(way((a.0, b.0)), v) / across;
    let corner = Point { x: a.0.x + part * u.x, y: a.0.y + part * u.y };
    let out = way((corner, arc));
    // how far along each line the arc lies: where behind the corner, the line is run the other way
    let (along, beside) = (cross(out, v) / across, cross(u, out) / across);
    let run = |(p, q): (Point, Point), is_ahead: bool| if is_ahead { (p, q) } else { (q, p) };
    let (first, second) = (run(a, along >= 0.0), run(b, beside >= 0.0));
    let (from, to) =
        if cross(way(first), way(second)) >= 0.0 { (first, second) } else { (second, first) };
    Some(What::Angle { from, to, away: apart(corner, arc) })
}
