//! Blocks: what is drawn once and inserted elsewhere, turned and scaled.

use super::words::turned;
use super::{Drawing, Entity, Figure, Read, What};
use base::number::{atan2, cos, hypot, sin};
use drawing::{Corner, Point};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// So deep blocks may be inserted in one another.
const DEEPEST: u32 = 16;
/// So many figures a drawing may have.
const MOST: usize = 100_000;
/// So often blocks are inserted and figures placed, those that are placed again included.
const MOST_PLACED: u32 = 1_000_000;

/// A block: its base point, in units, and what is drawn in it.
pub(super) struct Block<'t> {
    base: Point,
    entities: Vec<Entity<'t>>,
}

/// Finds the blocks.
pub(super) fn blocks<'t>(pairs: &[(i32, &'t str)]) -> BTreeMap<&'t str, Block<'t>> {
    let mut all = BTreeMap::new();
    let mut open: Option<(&'t str, Block<'t>)> = None;
    for entity in super::section(pairs, "BLOCKS").unwrap_or_default() {
        match (entity.kind, &mut open) {
            ("BLOCK", _) => {
                let name = entity.values.iter().find(|(code, _)| *code == 2).map(|(_, v)| v.trim());
                let base = entity.point(10, 1.0).unwrap_or_default();
                open = name.map(|name| (name, Block { base, entities: Vec::new() }));
            }
            ("ENDBLK", _) => all.extend(open.take()),
            (_, Some((_, block))) => block.entities.push(entity),
            (_, None) => {}
        }
    }
    all
}

/// How a block lies where it is inserted: about its base it is scaled, each way by itself, turned and moved.
#[derive(Clone, Copy)]
struct Placing {
    base: Point,
    scale: (f64, f64),
    angle: f64,
    to: Point,
}

impl Placing {
    fn is_mirrored(&self) -> bool {
        (self.scale.0 < 0.0) != (self.scale.1 < 0.0)
    }
    /// Returns true where circles do not stay circles.
    fn is_stretched(&self) -> bool {
        let (x, y) = (self.scale.0.abs(), self.scale.1.abs());
        (x - y).abs() > 1e-9 * x.max(y)
    }
    fn way(&self, p: Point) -> Point {
        turned(Point { x: self.scale.0 * p.x, y: self.scale.1 * p.y }, self.angle)
    }
    fn place(&self, p: Point) -> Point {
        let way = self.way(Point { x: p.x - self.base.x, y: p.y - self.base.y });
        Point { x: self.to.x + way.x, y: self.to.y + way.y }
    }
    /// Places an ellipse, by the way from its centre to the end of a half axis, and how long the other is.
    ///
    /// Where its half axes go to is a pair of conjugate half diameters; its own half axes are found from these.
    fn ellipse(
        &self,
        center: Point,
        (major, across): (Point, f64),
        sweep: Option<(f64, f64)>,
    ) -> Figure {
        let ratio = across / hypot(major.x, major.y);
        let u = self.way(major);
        let v = self.way(Point { x: -ratio * major.y, y: ratio * major.x });
        let (skew, uneven) = (2.0 * dot(u, v), dot(u, u) - dot(v, v));
        let shift = if skew.abs() <= 1e-14 * dot(u, u) { 0.0 } else { 0.5 * atan2(skew, uneven) };
        let (c, s) = (cos(shift), sin(shift));
        let axis = Point { x: c * u.x + s * v.x, y: c * u.y + s * v.y };
        let other = Point { x: c * v.x - s * u.x, y: c * v.y - s * u.y };
        let center = self.place(center);
        Figure::Ellipse {
            center,
            end: Point { x: center.x + axis.x, y: center.y + axis.y },
            across: hypot(other.x, other.y),
            sweep: sweep.map(|(from, sweep)| match self.is_mirrored() {
                true => (shift - from - sweep, sweep),
                false => (from - shift, sweep),
            }),
        }
    }
    /// Places a figure.
    ///
    /// # Errors
    /// Why it would be something else there.
    fn figure(&self, figure: &Figure) -> Result<Figure, &'static str> {
        let k = self.scale.0.abs();
        let sign = if self.is_mirrored() { -1.0 } else { 1.0 };
        Ok(match figure {
            Figure::Point(p) => Figure::Point(self.place(*p)),
            Figure::Line(p, q) => Figure::Line(self.place(*p), self.place(*q)),
            Figure::Circle { center, radius } if self.is_stretched() => {
                self.ellipse(*center, (Point { x: *radius, y: 0.0 }, *radius), None)
            }
            Figure::Circle { center, radius } => {
                Figure::Circle { center: self.place(*center), radius: k * radius }
            }
            Figure::Arc { center, start, end, is_clockwise } if self.is_stretched() => {
                let [from, to] = if *is_clockwise { [end, start] } else { [start, end] };
                let angle = |p: &Point| atan2(p.y - center.y, p.x - center.x);
                let (radius, from, to) = (apart(*center, *from), angle(from), angle(to));
                let sweep = (from, if to > from { to - from } else { to - from + TAU });
                self.ellipse(*center, (Point { x: radius, y: 0.0 }, radius), Some(sweep))
            }
            Figure::Arc { center, start, end, is_clockwise } => {
                let [center, start, end] = [center, start, end].map(|p| self.place(*p));
                let is_clockwise = *is_clockwise != self.is_mirrored();
                Figure::Arc { center, start, end, is_clockwise }
            }
            Figure::Ellipse { center, end, across, sweep } => {
                let major = Point { x: end.x - center.x, y: end.y - center.y };
                self.ellipse(*center, (major, *across), *sweep)
            }
            Figure::Curves(poles) => Figure::Curves(poles.iter().map(|p| self.place(*p)).collect()),
            Figure::Rational(curve) => Figure::Rational(curve.moved(|p| self.place(p))),
            Figure::Surface(rings)
                if self.is_stretched() && rings.iter().flatten().any(|c| c.bulge != 0.0) =>
            {
                return Err("HATCH with arcs in a block that is stretched");
            }
            Figure::Surface(rings) => {
                let corner = |c: &Corner| Corner {
                    poles: c.poles.map(|poles| poles.map(|p| self.place(p))),
                    ..Corner::new(self.place(c.at), sign * c.bulge)
                };
                Figure::Surface(rings.iter().map(|r| r.iter().map(corner).collect()).collect())
            }
            // words are read as they were, along where their line goes
            Figure::Words { at, words, size, turn } => {
                let along = self.way(Point { x: cos(*turn), y: sin(*turn) });
                let (at, size) = (self.place(*at), self.scale.1.abs() * size);
                let turn = atan2(along.y, along.x);
                Figure::Words { at, words: words.clone(), size, turn }
            }
            Figure::Dimension(_) if self.is_stretched() => {
                return Err("DIMENSION in a block that is stretched");
            }
            Figure::Dimension(measured) => {
                let mut measured = measured.clone();
                measured.size *= k;
                let is_plain = self.angle == 0.0 && !self.is_mirrored() && self.scale.0 > 0.0;
                match &mut measured.what {
                    What::Aligned { from, to, aside } => {
                        (*from, *to) = (self.place(*from), self.place(*to));
                        *aside *= sign * k;
                    }
                    What::Horizontal { from, to, aside } | What::Vertical { from, to, aside }
                        if is_plain =>
                    {
                        (*from, *to) = (self.place(*from), self.place(*to));
                        *aside *= k;
                    }
                    What::Radius { .. }
                    | What::Angle { .. }
                    | What::Horizontal { .. }
                    | What::Vertical { .. } => {
                        return Err("DIMENSION in a block that is turned");
                    }
                }
                Figure::Dimension(measured)
            }
        })
    }
}

impl<'t> Drawing<'t> {
    /// Reads an INSERT: the figures of its block where it lies.
    pub(super) fn insert(&self, entity: &Entity<'t>, depth: u32, read: &mut Read) {
        let name = entity.text(2).map(str::trim);
        let Some((block, to)) =
            name.and_then(|name| self.blocks.get(name)).zip(entity.point(10, self.scale))
        else {
            read.notes.push("INSERT of a block that is not there".into());
            return;
        };
        if !self.is_room() {
            read.notes.push("INSERT of blocks in one another without an end".into());
            return;
        }
        if depth >= DEEPEST {
            read.notes.push(format!("INSERT of blocks in one another more than {DEEPEST} deep"));
            return;
        }
        let (x, y) = (entity.number(41).unwrap_or(1.0), entity.number(42).unwrap_or(1.0));
        if x == 0.0 || y == 0.0 {
            read.notes.push("INSERT that leaves nothing of its block".into());
            return;
        }
        let mut inner = Read::default();
        self.figures_of(&block.entities, depth + 1, &mut inner);
        read.notes.append(&mut inner.notes);
        let angle = entity.number(50).unwrap_or(0.0).to_radians();
        let times = |code: i32| entity.number(code).map_or(1, |n| (n as i64).clamp(1, 1000));
        let apart = |code: i32| self.scale * entity.number(code).unwrap_or(0.0);
        let base = Point { x: self.scale * block.base.x, y: self.scale * block.base.y };
        for row in 0..times(71) {
            for column in 0..times(70) {
                let step = Point { x: column as f64 * apart(44), y: row as f64 * apart(45) };
                let step = turned(step, angle);
                let to = Point { x: to.x + step.x, y: to.y + step.y };
                let placing = Placing { base, scale: (x, y), angle, to };
                for figure in &inner.found {
                    if read.found.len() >= MOST || !self.is_room() {
                        read.notes.push(format!("what is beyond {MOST} figures"));
                        return;
                    }
                    let placed = match placing.figure(&figure.figure) {
                        Ok(placed) => placed,
                        Err(why) => {
                            read.notes.push(why.into());
                            continue;
                        }
                    };
                    let mut figure = figure.clone();
                    figure.figure = placed;
                    // what is on layer 0 of a block is on that of its insert
                    if figure.layer == "0" {
                        figure.layer = entity.text(8).unwrap_or("0").to_string();
                    }
                    let is_words = matches!(figure.figure, Figure::Words { .. });
                    if is_words && (placing.is_mirrored() || placing.is_stretched()) {
                        read.notes.push("that a TEXT is mirrored or stretched by its block".into());
                    }
                    read.found.push(figure);
                }
            }
        }
    }
}

impl Drawing<'_> {
    /// Counts one more insert or figure; returns false where there are too many.
    fn is_room(&self) -> bool {
        self.placed.set(self.placed.get() + 1);
        self.placed.get() <= MOST_PLACED
    }
}

fn dot(u: Point, v: Point) -> f64 {
    u.x * v.x + u.y * v.y
}

/// Returns how far two points are apart.
pub(super) fn apart(p: Point, q: Point) -> f64 {
    hypot(p.x - q.x, p.y - q.y)
}
