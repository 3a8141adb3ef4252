//! Elements: what a drawing is made of.

use crate::metrics;
use crate::nurbs::Nurbs;
use base::number::{cos, hypot, sin};
use std::sync::Arc;

/// A point on the sheet.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Point {
    /// To the right.
    pub x: f64,
    /// Up or down, as the drawing says.
    pub y: f64,
}

/// Which thing an element pictures: a number that whoever made the drawing can resolve.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Tag(pub u32);

/// Which way `y` runs.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Vertical {
    /// Up, as in mathematics.
    #[default]
    Up,
    /// Down, as on a screen.
    Down,
}

/// In front of what an element lies: drawn in this order.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub enum Layer {
    /// Behind: fills, grids.
    Back,
    /// Lines and curves.
    #[default]
    Lines,
    /// Points, which one grips.
    Points,
    /// Words.
    Words,
}

/// A colour by its part in the picture, so that light and dark pages both read well.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub enum Color {
    /// The foreground.
    #[default]
    Ink,
    /// A quieter foreground.
    Faint,
    /// The colour that catches the eye.
    Accent,
    /// A colour that the document names: a CSS name or `#rrggbb`.
    Named(String),
}

/// How a line is drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Line {
    /// In one go.
    #[default]
    Solid,
    /// In dashes: construction geometry.
    Dashed,
    /// In dots.
    Dotted,
    /// In long and short dashes by turns: middle lines.
    Chained,
    /// Not at all: a fill alone.
    None,
}

/// How an element looks.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Style {
    /// The colour of its line or text.
    pub color: Color,
    /// What it is filled with.
    pub fill: Option<Color>,
    /// How its line is drawn.
    pub line: Line,
    /// The line's width in screen pixels at a zoom of 1; 0 for the usual.
    pub width: f64,
    /// Whether a segment is a piece of a line without ends, which a screen shows as far as it reaches.
    pub is_unbounded: bool,
    /// The layer of the sheet that it is on, where the document names one.
    pub sheet_layer: Option<Arc<str>>,
    /// The dimension that it is drawn for: what has the same one is one dimension.
    pub dimension: Option<Arc<Dimension>>,
}

/// A kind of dimension, as drawings that are exported know them.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum DimensionKind {
    /// How far two points are apart: these, and the end and the start of the line beside them.
    Aligned,
    /// How far apart they are along the line: the same points.
    Linear,
    /// A radius: the centre and a point of the circle.
    Radius,
    /// A diameter: two points of the circle, opposite each other.
    Diameter,
    /// An angle: the ends of two lines, and a point of the arc between them.
    Angle,
}

impl DimensionKind {
    /// Returns how many points a dimension of the kind has.
    pub fn points(self) -> usize {
        match self {
            Self::Aligned | Self::Linear => 4,
            Self::Radius | Self::Diameter => 2,
            Self::Angle => 5,
        }
    }
}

/// What a dimension measures.
#[derive(Clone, PartialEq, Debug)]
pub struct Dimension {
    /// Its kind.
    pub kind: DimensionKind,
    /// Its points, as the kind says.
    pub points: Vec<Point>,
}

/// Which point of a text lies at its position.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum Anchoring {
    /// The left end of the base line.
    #[default]
    Start,
    /// The middle of the base line.
    Middle,
    /// The right end of the base line.
    End,
    /// The middle both ways, between the top of the first line's capitals and the last base line.
    Center,
    /// None: all of it lies beyond the position, as seen from another point, with a little room between.
    Away(Point),
}

/// How a text lies: at which position, how far it is turned around that, and which way `y` runs.
#[derive(Clone, Copy, Debug)]
pub struct Lie {
    /// Its position.
    pub at: Point,
    /// How far it is turned from the x axis towards the y axis, in radians.
    pub turn: f64,
    /// Which way `y` runs on its sheet.
    pub vertical: Vertical,
}

/// The room between a position and a text beyond it, in multiples of the text's size.
const ROOM: f64 = 0.35;

impl Anchoring {
    /// Returns how far to the right of a text's position its first line begins, and how far below its position the
    /// first base line is; both as the text is read, in the units of `size`.
    pub fn start(self, text: &str, size: f64, lie: Lie) -> (f64, f64) {
        let before = match self {
            Self::Start => 0.0,
            Self::Middle | Self::Center | Self::Away(_) => 0.5,
            Self::End => 1.0,
        };
        let (right, down) = self.held(text, size, lie);
        (right - before * metrics::text_width(text, size), down)
    }

    /// Returns where the point of the first base line is by which the text is held, its left end, middle or right end:
    /// how far to the right of the position, and how far below, as the text is read, in the units of `size`.
    pub fn held(self, text: &str, size: f64, lie: Lie) -> (f64, f64) {
        let below = (text.split('\n').count() as f64 - 1.0) * metrics::LINE_HEIGHT * size;
        let above = metrics::ASCENT * size;
        let centered = (above - below) / 2.0;
        match self {
            Self::Start | Self::Middle | Self::End => (0.0, 0.0),
            Self::Center => (0.0, centered),
            Self::Away(from) => {
                let (right, down) = lie.seen(from);
                let (width, height) = (metrics::text_width(text, size), above + below);
                let reach = 0.5 * (width * right.abs() + height * down.abs()) + ROOM * size;
                (reach * right, centered + reach * down)
            }
        }
    }
}

impl Lie {
    /// Returns the direction from a point to the text's position, as the text is read: how much of it goes to the
    /// right, and how much down. It has no length where both are one.
    fn seen(self, from: Point) -> (f64, f64) {
        let (x, y) = (self.at.x - from.x, self.at.y - from.y);
        let length = hypot(x, y);
        if length == 0.0 || !length.is_finite() {
            return (0.0, 0.0);
        }
        let (c, s) = (cos(self.turn), sin(self.turn));
        let (right, along) = ((x * c + y * s) / length, (y * c - x * s) / length);
        (right, if self.vertical == Vertical::Up { -along } else { along })
    }
}

/// How a text lies on the sheet.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Placement {
    /// Its height is in the sheet's units and grows with the zoom.
    OnSheet(f64),
    /// Its height is in screen pixels, whatever the zoom.
    OnScreen(f64),
}

/// A corner of a ring, and how what leaves it bends.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Corner {
    /// Where it is.
    pub at: Point,
    /// The tangent of a quarter of the angle that the arc to the next corner turns; 0 for a segment, positive where
    /// it turns from the x axis towards the y axis.
    pub bulge: f64,
    /// The two poles between the ends of the cubic Bézier curve to the next corner, where it is one and no arc.
    pub poles: Option<[Point; 2]>,
}

impl Corner {
    /// Makes a corner that a segment or an arc leaves.
    pub fn new(at: Point, bulge: f64) -> Self {
        Self { at, bulge, poles: None }
    }
}

/// What an element is. Curves are exact.
#[derive(Clone, PartialEq, Debug)]
pub enum Shape {
    /// A dot of a constant size on the screen.
    Dot(Point),
    /// A straight segment.
    Segment(Point, Point),
    /// Straight segments in a row.
    Polyline {
        /// The corners.
        points: Vec<Point>,
        /// Whether the last is joined to the first.
        closed: bool,
    },
    /// A circle.
    Circle {
        /// The centre.
        center: Point,
        /// The radius, not negative.
        radius: f64,
    },
    /// A circular arc.
    Arc {
        /// The centre.
        center: Point,
        /// The radius, not negative.
        radius: f64,
        /// The angle of its start, in radians from the x axis towards the y axis.
        start: f64,
        /// The signed angle that it turns through, in radians.
        sweep: f64,
    },
    /// An ellipse, or an arc of one.
    Ellipse {
        /// The centre.
        center: Point,
        /// The way from the centre to the end of the longer half axis.
        major: Point,
        /// How long the shorter half axis is, as a part of the longer: above 0, at most 1.
        ratio: f64,
        /// The parameter of its start, in radians from the longer axis.
        start: f64,
        /// The signed parameter that it runs through, in radians.
        sweep: f64,
    },
    /// Cubic Bézier curves, each from where the one before ends: poles in threes after the first.
    Spline(Vec<Point>),
    /// A rational B-spline.
    Nurbs(Nurbs),
    /// Closed rings of segments, arcs and Bézier curves; what an odd number of them surrounds is inside.
    Region(Vec<Vec<Corner>>),
    /// A text in one or more lines.
    Text {
        /// Where its anchor point lies.
        at: Point,
        /// The words; lines end at `\n`.
        text: String,
        /// Which point of it lies there.
        anchoring: Anchoring,
        /// How high it is.
        placement: Placement,
        /// How far its base line is turned from the x axis towards the y axis, in radians, around its position.
        turn: f64,
    },
}

impl Shape {
    /// Visits its numbers, in the order in which they are declared.
    pub fn each_number(&mut self, visit: &mut impl FnMut(&mut f64)) {
        let mut point = |p: &mut Point| {
            visit(&mut p.x);
            visit(&mut p.y);
        };
        match self {
            Self::Dot(at) => point(at),
            Self::Segment(p, q) => {
                point(p);
                point(q);
            }
            Self::Polyline { points, closed: _ } | Self::Spline(points) => {
                points.iter_mut().for_each(point);
            }
            Self::Nurbs(curve) => curve.each_number(visit),
            Self::Circle { center, radius } => {
                point(center);
                visit(radius);
            }
            Self::Arc { center, radius, start, sweep } => {
                point(center);
                [radius, start, sweep].into_iter().for_each(visit);
            }
            Self::Ellipse { center, major, ratio, start, sweep } => {
                point(center);
                point(major);
                [ratio, start, sweep].into_iter().for_each(visit);
            }
            Self::Region(rings) => {
                for corner in rings.iter_mut().flatten() {
                    visit(&mut corner.at.x);
                    visit(&mut corner.at.y);
                    visit(&mut corner.bulge);
                    for pole in corner.poles.iter_mut().flatten() {
                        visit(&mut pole.x);
                        visit(&mut pole.y);
                    }
                }
            }
            Self::Text { at, text: _, anchoring, placement, turn } => {
                point(at);
                match anchoring {
                    Anchoring::Away(from) => point(from),
                    Anchoring::Start | Anchoring::Middle | Anchoring::End | Anchoring::Center => {}
                }
                match placement {
                    Placement::OnSheet(height) | Placement::OnScreen(height) => visit(height),
                }
                visit(turn);
            }
        }
    }
}

/// A shape with its style, its layer and the thing that it pictures.
#[derive(Clone, PartialEq, Debug)]
pub struct Element {
    /// What it is.
    pub shape: Shape,
    /// How it looks.
    pub style: Style,
    /// In front of what.
    pub layer: Layer,
    /// What it pictures.
    pub tag: Tag,
}

impl Element {
    /// Makes an element of the usual style, in the layer where such shapes lie.
    pub fn new(shape: Shape) -> Self {
        let layer = match shape {
            Shape::Dot(_) => Layer::Points,
            Shape::Text { .. } => Layer::Words,
            Shape::Segment(..)
            | Shape::Polyline { .. }
            | Shape::Circle { .. }
            | Shape::Arc { .. }
            | Shape::Ellipse { .. }
            | Shape::Spline(_)
            | Shape::Nurbs(_)
            | Shape::Region(_) => Layer::Lines,
        };
        Self { shape, style: Style::default(), layer, tag: Tag::default() }
    }
}

/// Elements in order; the layers first by [`Layer`], within a layer as listed.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Drawing {
    /// The elements.
    pub elements: Vec<Element>,
    /// Which way `y` runs.
    pub vertical: Vertical,
}
