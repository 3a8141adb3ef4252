//! The DXF reader: text in, figures in millimetres out. Blocks that are inserted are taken apart.
//!
//! **Source:** Autodesk, *DXF Reference*, release 2000.

mod blocks;
mod dimension;
mod hatch;
mod spline;
mod words;

use base::number::{cos, sin};
use drawing::nurbs::Nurbs;
use drawing::{Corner, Point, Shape, curve};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// What a drawing holds.
#[derive(Default, Debug)]
pub(crate) struct Read {
    pub(crate) found: Vec<Found>,
    /// What is not understood, once for each time.
    pub(crate) notes: Vec<String>,
}

/// A figure with where it was found.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    pub(crate) figure: Figure,
    pub(crate) layer: String,
    pub(crate) line_type: String,
    /// Whether it is an edge of a closed polyline.
    is_of_ring: bool,
}

/// What an entity is, in millimetres.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Figure {
    Point(Point),
    Line(Point, Point),
    Circle {
        center: Point,
        radius: f64,
    },
    Arc {
        center: Point,
        start: Point,
        end: Point,
        is_clockwise: bool,
    },
    /// With the parameter of its start and what it runs through, where it is no whole one.
    Ellipse {
        center: Point,
        end: Point,
        across: f64,
        sweep: Option<(f64, f64)>,
    },
    /// Bézier curves, by their poles.
    Curves(Vec<Point>),
    /// A rational B-spline.
    Rational(Nurbs),
    /// What the first ring surrounds, without what the others do.
    Surface(Vec<Vec<Corner>>),
    Dimension(Measured),
    /// From the left end of its base line, which is turned to the left.
    Words {
        at: Point,
        words: String,
        size: f64,
        turn: f64,
    },
}

/// What a dimension measures, and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Measured {
    pub(crate) what: What,
    /// How high its words are.
    pub(crate) size: f64,
}

/// The kinds of dimensions, with their points.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum What {
    /// From one point to another, so far to the left of the way.
    Aligned { from: Point, to: Point, aside: f64 },
    /// How far they are apart to the right, so far above the upper one; below the lower one where negative.
    Horizontal { from: Point, to: Point, aside: f64 },
    /// How far they are apart upwards, so far to the right of both, or to the left.
    Vertical { from: Point, to: Point, aside: f64 },
    /// A radius, in a direction, its words so far beyond the circle; or a diameter.
    Radius { center: Point, radius: f64, angle: f64, beyond: f64, is_across: bool },
    /// From one line to the other, turning left, so far from where they meet.
    Angle { from: (Point, Point), to: (Point, Point), away: f64 },
}

/// An entity: its kind, and its values by their codes.
#[derive(Debug)]
struct Entity<'t> {
    kind: &'t str,
    values: Vec<(i32, &'t str)>,
}

impl Entity<'_> {
    fn text(&self, code: i32) -> Option<&str> {
        self.values.iter().find(|(c, _)| *c == code).map(|(_, value)| *value)
    }
    fn number(&self, code: i32) -> Option<f64> {
        self.text(code)?.trim().parse().ok().filter(|x: &f64| x.is_finite())
    }
    /// Returns the point of a code in millimetres.
    fn point(&self, code: i32, scale: f64) -> Option<Point> {
        Some(Point { x: scale * self.number(code)?, y: scale * self.number(code + 10)? })
    }
    /// Returns true where it lies in the plane of the sheet, seen from above.
    fn is_flat(&self) -> bool {
        let upright = self.number(230).is_none_or(|z| (z - 1.0).abs() < 1e-9);
        upright && [30, 31, 38].iter().all(|&z| self.number(z).is_none_or(|z| z == 0.0))
    }
}

/// Reads a drawing.
///
/// # Errors
/// What is no DXF text: the line at which it is none.
pub(crate) fn read(text: &str) -> Result<Read, String> {
    if text.starts_with("AutoCAD Binary DXF") {
        return Err("found a binary DXF, wanted a text: save it as text".into());
    }
    let pairs = pairs(text)?;
    let mut read = Read::default();
    let drawing = Drawing {
        scale: scale(&pairs, &mut read.notes),
        blocks: blocks::blocks(&pairs),
        styles: dimension::styles(&pairs),
        placed: Cell::new(0),
    };
    let entities = entities(&pairs)?;
    drawing.figures_of(&entities, 0, &mut read);
    hatch::without_edges(&mut read.found);
    Ok(read)
}

/// What entities refer to.
struct Drawing<'t> {
    /// How many millimetres a unit has.
    scale: f64,
    blocks: BTreeMap<&'t str, blocks::Block<'t>>,
    /// How high the words of dimensions are, in units, by the names of their styles.
    styles: BTreeMap<&'t str, f64>,
    /// How often blocks were inserted and figures placed.
    placed: Cell<u32>,
}

impl<'t> Drawing<'t> {
    /// Reads entities, those of blocks inside so many others.
    fn figures_of(&self, entities: &[Entity<'t>], depth: u32, read: &mut Read) {
        let scale = self.scale;
        let mut all = entities.iter().peekable();
        while let Some(entity) = all.next() {
            let before = read.found.len();
            if entity.kind == "POLYLINE" {
                let mut corners = Vec::new();
                while let Some(vertex) = all.next_if(|e| e.kind == "VERTEX") {
                    corners.extend(corner(vertex, scale));
                }
                all.next_if(|e| e.kind == "SEQEND");
                let is_closed = entity.number(70).is_some_and(|flags| flags as i64 & 1 == 1);
                along(&corners, is_closed, entity, read);
            } else if !entity.is_flat() {
                read.notes.push(format!("{} that does not lie flat on the sheet", entity.kind));
            } else if entity.kind == "INSERT" {
                self.insert(entity, depth, read);
                let before = read.found.len();
                while let Some(words) = all.next_if(|e| e.kind == "ATTRIB") {
                    words::given(words, scale, read);
                }
                all.next_if(|e| e.kind == "SEQEND");
                set_layer(&mut read.found[before..], entity);
                continue;
            } else if entity.kind == "DIMENSION" {
                self.dimension(entity, read);
            } else {
                figures(entity, scale, read);
            }
            set_layer(&mut read.found[before..], entity);
        }
    }
}

/// Says of what was found which layer it is on.
fn set_layer(all: &mut [Found], entity: &Entity<'_>) {
    for found in all {
        found.layer = entity.text(8).unwrap_or("0").to_string();
        found.line_type = entity.text(6).unwrap_or("ByLayer").to_string();
    }
}

/// Reads codes and values, two lines each.
fn pairs(text: &str) -> Result<Vec<(i32, &str)>, String> {
    let mut lines = text.lines().enumerate();
    let mut pairs = Vec::new();
    while let Some((at, code)) = lines.next() {
        if code.trim().is_empty() && lines.clone().all(|(_, rest)| rest.trim().is_empty()) {
            break;
        }
        let number = code.trim().parse::<i32>();
        let number = number.map_err(|_| {
            let found: String = code.chars().take(40).collect();
            format!("line {}: found `{found}`, wanted a group code of DXF", at + 1)
        })?;
        let value = lines.next();
        let (_, value) = value.ok_or_else(|| format!("line {}: a code without a value", at + 1))?;
        pairs.push((number, value.trim_end_matches('\r')));
    }
    Ok(pairs)
}

/// Returns how many millimetres a unit of the drawing has.
fn scale(pairs: &[(i32, &str)], notes: &mut Vec<String>) -> f64 {
    let units = pairs.windows(2).find(|w| w[0] == (9, "$INSUNITS")).map(|w| w[1].1.trim());
    match units {
        Some("1") => 25.4,
        Some("2") => 304.8,
        Some("4") => 1.0,
        Some("5") => 10.0,
        Some("6") => 1000.0,
        Some("0") | None => {
            notes.push("a unit, which the drawing does not say: taken for millimetres".into());
            1.0
        }
        Some(other) => {
            notes.push(format!("the unit {other}: taken for millimetres"));
            1.0
        }
    }
}

/// Finds the entities.
fn entities<'t>(pairs: &[(i32, &'t str)]) -> Result<Vec<Entity<'t>>, String> {
    let section = section(pairs, "ENTITIES");
    section.ok_or_else(|| "found no section ENTITIES, wanted a drawing in DXF".into())
}

/// Returns what a section holds; nothing where there is none.
fn section<'t>(pairs: &[(i32, &'t str)], name: &str) -> Option<Vec<Entity<'t>>> {
    let is_start = |w: &[(i32, &str)]| w[0] == (0, "SECTION") && w[1] == (2, name);
    let start = pairs.windows(2).position(is_start)?;
    let mut entities: Vec<Entity<'t>> = Vec::new();
    for &(code, value) in &pairs[start + 2..] {
        match (code, entities.last_mut()) {
            (0, _) if value.trim() == "ENDSEC" => break,
            (0, _) => entities.push(Entity { kind: value.trim(), values: Vec::new() }),
            (code, Some(entity)) => entity.values.push((code, value)),
            (_, None) => {}
        }
    }
    Some(entities)
}

/// Reads one entity.
fn figures(entity: &Entity<'_>, scale: f64, read: &mut Read) {
    let figure = match entity.kind {
        "POINT" => entity.point(10, scale).map(Figure::Point),
        "LINE" => {
            entity.point(10, scale).zip(entity.point(11, scale)).map(|(p, q)| Figure::Line(p, q))
        }
        "CIRCLE" => circle(entity, scale),
        "ARC" => arc(entity, scale),
        "ELLIPSE" => ellipse(entity, scale),
        "TEXT" => words::line(entity, 73, scale, &mut read.notes),
        "MTEXT" => return words::lines(entity, scale, read),
        "SPLINE" => return spline::curves(entity, scale, read),
        "HATCH" => return hatch::surfaces(entity, scale, read),
        "LWPOLYLINE" => {
            let corners = light_corners(entity, scale);
            let is_closed = entity.number(70).is_some_and(|flags| flags as i64 & 1 == 1);
            return along(&corners, is_closed, entity, read);
        }
        other => {
            read.notes.push(format!("{other}, which is not understood"));
            return;
        }
    };
    match figure {
        Some(Figure::Line(p, q)) if p == q => read.notes.push("LINE of no length".into()),
        Some(figure) => read.found.push(found(figure)),
        None => read.notes.push(format!("{} without all of its numbers", entity.kind)),
    }
}

fn found(figure: Figure) -> Found {
    Found { figure, layer: String::new(), line_type: String::new(), is_of_ring: false }
}

fn circle(entity: &Entity<'_>, scale: f64) -> Option<Figure> {
    let radius = entity.number(40).filter(|r| *r > 0.0)?;
    Some(Figure::Circle { center: entity.point(10, scale)?, radius: scale * radius })
}

fn arc(entity: &Entity<'_>, scale: f64) -> Option<Figure> {
    let Some(Figure::Circle { center, radius }) = circle(entity, scale) else { return None };
    let at = |code| {
        let angle = entity.number(code)?.to_radians();
        Some(Point { x: center.x + radius * cos(angle), y: center.y + radius * sin(angle) })
    };
    Some(Figure::Arc { center, start: at(50)?, end: at(51)?, is_clockwise: false })
}

fn ellipse(entity: &Entity<'_>, scale: f64) -> Option<Figure> {
    let (center, major) = (entity.point(10, scale)?, entity.point(11, scale)?);
    let across = entity.number(40)? * curve::half_axis(major);
    let end = Point { x: center.x + major.x, y: center.y + major.y };
    let from = entity.number(41).unwrap_or(0.0);
    let sweep = entity.number(42).unwrap_or(TAU) - from;
    let sweep = if sweep < 0.0 { sweep + TAU } else { sweep };
    let is_whole = sweep > TAU - 1e-9;
    Some(Figure::Ellipse { center, end, across, sweep: (!is_whole).then_some((from, sweep)) })
}

fn corner(vertex: &Entity<'_>, scale: f64) -> Option<Corner> {
    Some(Corner::new(vertex.point(10, scale)?, vertex.number(42).unwrap_or(0.0)))
}

fn light_corners(entity: &Entity<'_>, scale: f64) -> Vec<Corner> {
    let mut corners: Vec<Corner> = Vec::new();
    for &(code, value) in &entity.values {
        let number = value.trim().parse::<f64>().unwrap_or_default();
        match (code, corners.last_mut()) {
            (10, _) => corners.push(Corner::new(Point { x: scale * number, y: 0.0 }, 0.0)),
            (20, Some(last)) => last.at.y = scale * number,
            (42, Some(last)) => last.bulge = number,
            _ => {}
        }
    }
    corners
}

/// Takes a polyline apart: its segments and arcs.
fn along(corners: &[Corner], is_closed: bool, entity: &Entity<'_>, read: &mut Read) {
    if corners.len() < 2 {
        read.notes.push(format!("{} of fewer than two corners", entity.kind));
        return;
    }
    let edges = if is_closed { corners.len() } else { corners.len() - 1 };
    for i in 0..edges {
        let (from, to) = (corners[i], corners[(i + 1) % corners.len()]);
        if from.at == to.at {
            read.notes.push(format!("an edge of no length of a {}", entity.kind));
            continue;
        }
        read.found.push(Found { is_of_ring: is_closed, ..found(edge(from, to)) });
    }
}

/// Returns what joins two corners.
fn edge(from: Corner, to: Corner) -> Figure {
    match curve::edge(from, to) {
        Shape::Arc { center, sweep, .. } => {
            Figure::Arc { center, start: from.at, end: to.at, is_clockwise: sweep < 0.0 }
        }
        Shape::Spline(poles) => Figure::Curves(poles),
        _ => Figure::Line(from.at, to.at),
    }
}
