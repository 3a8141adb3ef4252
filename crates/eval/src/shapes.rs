//! Pictures: the functions that draw, and the messages that change how a picture looks.

use crate::answer::Answer;
use crate::evaluator::{Evaluator, Result};
use crate::fault::Fault;
use crate::measure;
use crate::operate::finite;
use crate::replay::{Measure, Unary, corners};
use crate::rings;
use base::Name;
use drawing::{
    Anchoring, Color, Corner, Dimension as Dimensioned, DimensionKind, Element, Layer, Line,
    Placement, Point, Shape, Tag, nurbs::Nurbs,
};
use expr::dimension::Dimension;
use kernel::builtin::{Function, PictureMessage};
use kernel::{ClassKind, ThingId};
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::rc::Rc;
use std::sync::Arc;

/// How high a label's letters are, in pixels.
const LABEL_PIXELS: f64 = 13.0;
/// How wide a thick line is, in pixels.
const THICK_PIXELS: f64 = 3.0;
/// Rings whose corners differ by no more than this part of how far they reach are one.
const NEAR: f64 = 1e-9;

impl<'a> Evaluator<'a> {
    /// Draws: calls one of the functions whose answer is a picture.
    pub(crate) fn draw(
        &self,
        function: Function,
        arguments: &[Answer<'a>],
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let place = |i: usize| self.place(&arguments[i]);
        let written = |i: usize| self.operand(&arguments[i]).map(|(x, _)| x);
        let size = |i: usize| written(i).map(|x| self.unary_number(Unary::Abs, x));
        let shape = match function {
            Function::Dot if arguments.len() == 2 => {
                Shape::Dot(Point { x: written(0)?, y: written(1)? })
            }
            Function::Dot => Shape::Dot(place(0)?),
            Function::Segment => Shape::Segment(place(0)?, place(1)?),
            Function::Polyline => self.corners(arguments, false)?,
            Function::Polygon => self.corners(arguments, true)?,
            Function::Circle => Shape::Circle { center: place(0)?, radius: size(1)? },
            Function::Arc => Shape::Arc {
                center: place(0)?,
                radius: size(1)?,
                start: written(2)?,
                sweep: written(3)?,
            },
            Function::Ellipse => {
                let (center, end) = (place(0)?, place(1)?);
                let start = if arguments.len() > 3 { written(3)? } else { 0.0 };
                let sweep = if arguments.len() > 4 { written(4)? } else { TAU };
                // its end and its height stand where it has its half axis and their ratio
                let given = Shape::Ellipse { center, major: end, ratio: written(2)?, start, sweep };
                let made = self.of_lines(Measure::Ellipse, &[given]).map_err(Fault::wrong)?;
                let point = |i: usize| Point { x: made[i], y: made[i + 1] };
                let (center, major, ratio) = (point(0), point(2), made[4]);
                Shape::Ellipse { center, major, ratio, start: made[5], sweep: made[6] }
            }
            Function::Spline => {
                let places = Shape::Spline(self.places(arguments)?);
                let poles = self.of_lines(Measure::Through, &[places]).map_err(Fault::wrong)?;
                let place = |p: &[f64]| Point { x: p[0], y: p[1] };
                Shape::Spline(poles.chunks_exact(2).map(place).collect())
            }
            Function::Bezier => {
                let poles = self.places(arguments)?;
                if poles.len() % 3 != 1 {
                    let n = poles.len();
                    let message =
                        format!("{n} poles, where a place and three for each curve are wanted");
                    return Err(Fault::wrong(message));
                }
                Shape::Spline(poles)
            }
            Function::Nurbs => self.nurbs(arguments)?,
            Function::Region => self.region_of(arguments, nearest)?,
            Function::Rectangle => {
                let (a, c) = (place(0)?, place(1)?);
                let (b, d) = (Point { x: c.x, y: a.y }, Point { x: a.x, y: c.y });
                Shape::Polyline { points: vec![a, b, c, d], closed: true }
            }
            Function::Label => self.words(arguments, Placement::OnScreen(LABEL_PIXELS))?,
            Function::Text => self.words(arguments, Placement::OnSheet(size(2)?))?,
            Function::Picture => return self.join_pictures(arguments, nearest),
            Function::Sqrt
            | Function::Cbrt
            | Function::Hypot
            | Function::Log10
            | Function::Log2
            | Function::Sinh
            | Function::Cosh
            | Function::Tanh
            | Function::Asinh
            | Function::Acosh
            | Function::Atanh
            | Function::Ceil
            | Function::Sign
            | Function::Clamp
            | Function::Abs
            | Function::Sin
            | Function::Cos
            | Function::Tan
            | Function::Asin
            | Function::Acos
            | Function::Atan
            | Function::Atan2
            | Function::Exp
            | Function::Ln
            | Function::Floor
            | Function::Round
            | Function::Min
            | Function::Max
            | Function::Pi
            | Function::Upward
            | Function::Rgb
            | Function::AllDifferent => {
                return Err(Fault::wrong("a number where a picture is wanted"));
            }
        };
        let element = Element { tag: Tag(self.structure.merged[nearest].0), ..Element::new(shape) };
        Ok(Answer::Picture(Rc::new(vec![element])))
    }

    /// Fills rings: of corners, of lines that meet, or of what is drawn.
    fn region_of(&self, arguments: &[Answer<'a>], nearest: ThingId) -> Result<Shape> {
        let ring = |ring: &Answer<'a>| {
            if let Answer::Picture(elements) = ring {
                return Ok(rings_in(elements));
            }
            let items = self.items(ring)?;
            let is_corner = |first: &Answer<'a>| self.bent(first).is_ok();
            match items.first().is_none_or(is_corner) {
                true => {
                    let corners = items.iter().map(|corner| self.bent(corner));
                    Ok(vec![corners.collect::<Result<_>>()?])
                }
                false => Ok(vec![self.ring_of_lines(&items, nearest)?]),
            }
        };
        let rings = self.rings(arguments)?;
        let rings = rings.iter().map(ring).collect::<Result<Vec<Vec<_>>>>()?;
        Ok(Shape::Region(rings.concat()))
    }

    fn corners(&self, arguments: &[Answer<'a>], closed: bool) -> Result<Shape> {
        Ok(Shape::Polyline { points: self.places(arguments)?, closed })
    }

    /// Reads poles, weights, the degree and knots.
    fn nurbs(&self, arguments: &[Answer<'a>]) -> Result<Shape> {
        let knots = self.items(&arguments[3])?;
        let knots = knots.iter().map(|x| Ok(self.number(x)?.0)).collect::<Result<Vec<_>>>()?;
        let poles = self.items(&arguments[0])?;
        let poles = poles.iter().map(|p| self.place(p)).collect::<Result<Vec<_>>>()?;
        let weights = self.items(&arguments[1])?;
        let weights = weights.iter().map(|x| Ok(self.operand(x)?.0)).collect::<Result<Vec<_>>>()?;
        let (degree, _) = self.number(&arguments[2])?;
        if !(degree >= 1.0 && degree.fract() == 0.0) {
            return Err(Fault::wrong(format!(
                "a degree of {degree}, where it is 1, 2, 3 and so on"
            )));
        }
        // of numbers that may be marked only the signs of the weights decide whether there is such a curve
        let read = |x: &f64| self.value_of(*x);
        let place = |p: &Point| Point { x: read(&p.x), y: read(&p.y) };
        let places = poles.iter().map(place).collect();
        let counts = weights.iter().map(read).collect();
        let curve = Nurbs::new(degree as usize, knots, places, counts).map_err(Fault::wrong)?;
        weights.iter().for_each(|&weight| {
            self.order_of(weight, 0.0);
        });
        Ok(Shape::Nurbs(curve.with(poles, weights)))
    }

    /// Measures the lines of a picture.
    pub(crate) fn measured(
        &self,
        message: PictureMessage,
        elements: &[Element],
        arguments: &[Answer<'a>],
    ) -> Result<Answer<'a>> {
        let mut shapes: Vec<Shape> = elements.iter().map(|e| e.shape.clone()).collect();
        let n = shapes.len() as u64;
        let what = match message {
            PictureMessage::Nearest => {
                shapes.push(Shape::Dot(self.place(&arguments[0])?));
                Measure::Nearest
            }
            PictureMessage::Area => Measure::Area,
            _ => Measure::Length,
        };
        self.burn_several(1 + n.saturating_mul(n) / 16)?;
        let made = self.of_lines(what, &shapes).map_err(Fault::no_answer)?;
        let dimension = match what {
            Measure::Area => measure::power(Dimension::LENGTH, 2.0),
            Measure::Length
            | Measure::Nearest
            | Measure::Through
            | Measure::Ellipse
            | Measure::Ends
            | Measure::Order
            | Measure::Ring => Dimension::LENGTH,
        };
        match made[..] {
            [x] => finite(x, dimension),
            _ => Ok(Answer::List(made.iter().map(|&x| Answer::Number(x, dimension)).collect())),
        }
    }

    /// Reads places: each an argument, or all in one list.
    fn places(&self, arguments: &[Answer<'a>]) -> Result<Vec<Point>> {
        let places = match arguments {
            [one @ Answer::List(_)] if self.place(one).is_err() => self.several(arguments)?,
            [Answer::Thing(_)] => self.several(arguments)?,
            _ => arguments.to_vec(),
        };
        places.iter().map(|p| self.place(p)).collect()
    }

    /// Returns rings: each an argument, or all in one list.
    fn rings(&self, arguments: &[Answer<'a>]) -> Result<Vec<Answer<'a>>> {
        if let [one] = arguments {
            let items = self.items(one)?;
            let is_ring = |of: &Answer<'a>| match of {
                Answer::List(_) => self.bent(of).is_err(),
                Answer::Picture(elements) => !rings_in(elements).is_empty(),
                _ => false,
            };
            if items.first().is_some_and(is_ring) {
                return Ok(items.to_vec());
            }
        }
        Ok(arguments.to_vec())
    }

    /// Reads a ring as the lines that follow one another along it.
    fn ring_of_lines(&self, lines: &[Answer<'a>], nearest: ThingId) -> Result<Vec<Corner>> {
        let lines = lines.iter().map(|line| self.line_of(line, nearest));
        let lines = lines.collect::<Result<Vec<Shape>>>()?;
        let numbers = self.of_lines(Measure::Ring, &lines).map_err(Fault::wrong)?;
        Ok(corners(&numbers, |x| self.fixed_number(x)))
    }

    /// Reads a corner of a ring: a place, which may have a part `bulge`, or `(place, bulge)`.
    pub(crate) fn bent(&self, corner: &Answer<'a>) -> Result<Corner> {
        if let Ok(at) = self.place(corner) {
            let name = &self.tables.bulge;
            let class = self.class_of(corner);
            let bends = class.is_some_and(|class| self.layout(class).index.contains_key(name));
            let bulge = match bends {
                true => {
                    let nearest = corner.thing().unwrap_or(kernel::DOCUMENT);
                    self.operand(&self.send(corner, name, Vec::new(), None, nearest)?)?.0
                }
                false => 0.0,
            };
            return Ok(Corner::new(at, bulge));
        }
        match &self.items(corner)?[..] {
            [at, bulge] => Ok(Corner::new(self.place(at)?, self.operand(bulge)?.0)),
            _ => Err(Fault::wrong("a corner of a ring is a place, or (place, bulge)")),
        }
    }

    fn words(&self, arguments: &[Answer<'a>], placement: Placement) -> Result<Shape> {
        let at = self.place(&arguments[0])?;
        let Answer::Text(text) = &arguments[1] else {
            let kind = self.kind(&arguments[1]);
            return Err(Fault::wrong(format!("{kind} where a text is wanted")));
        };
        let (text, anchoring) = (text.to_string(), Anchoring::Start);
        Ok(Shape::Text { at, text, anchoring, placement, turn: 0.0 })
    }

    /// Reads a place: a thing with `x` and `y`, or `(x, y)`.
    pub(crate) fn place(&self, answer: &Answer<'a>) -> Result<Point> {
        let (x, y) = match answer {
            Answer::List(items) if items.len() == 2 => (items[0].clone(), items[1].clone()),
            Answer::Thing(_) | Answer::Made(_) => {
                let nearest = if let Answer::Thing(t) = answer { *t } else { kernel::DOCUMENT };
                let ask = |name: &Name| self.send(answer, name, Vec::new(), None, nearest);
                (ask(&self.tables.x)?, ask(&self.tables.y)?)
            }
            Answer::Number(..)
            | Answer::Bool(_)
            | Answer::Option(..)
            | Answer::Text(_)
            | Answer::Context(_)
            | Answer::List(_)
            | Answer::Picture(_)
            | Answer::Function(_) => {
                return Err(Fault::wrong(format!("{} where a place is wanted", self.kind(answer))));
            }
        };
        Ok(Point { x: self.operand(&x)?.0, y: self.operand(&y)?.0 })
    }

    /// Makes several pictures, or lists of pictures, one.
    pub(crate) fn join_pictures(
        &self,
        pictures: &[Answer<'a>],
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        if let [picture @ Answer::Picture(_)] = pictures {
            return Ok(picture.clone());
        }
        let mut all = Vec::new();
        for picture in pictures {
            self.gather(picture, nearest, &mut all)?;
        }
        Ok(Answer::Picture(Rc::new(all)))
    }

    /// Adds a picture, that of a thing, or those of a list: numbers and texts among its elements draw
    /// nothing, and where a thing has a fault, the others go on without it.
    fn gather(&self, picture: &Answer<'a>, nearest: ThingId, all: &mut Vec<Element>) -> Result<()> {
        match picture {
            Answer::Picture(elements) => all.extend(elements.iter().cloned()),
            Answer::List(items) => {
                for item in items.iter().filter(|i| self.may_draw(i)) {
                    self.deeper(|| self.gather(item, nearest, all))?;
                }
            }
            Answer::Thing(_) | Answer::Made(_) | Answer::Context(_) if self.may_draw(picture) => {
                let name = &self.tables.picture;
                match self.deeper(|| self.send(picture, name, Vec::new(), None, nearest)) {
                    Ok(Answer::Picture(more)) => match Rc::try_unwrap(more) {
                        Ok(more) if all.is_empty() => *all = more,
                        Ok(more) => all.extend(more),
                        Err(shared) => all.extend(shared.iter().cloned()),
                    },
                    Ok(other) => {
                        let kind = self.kind(&other);
                        let fault = Fault::wrong(format!("{kind} where a picture is wanted"));
                        self.faults.borrow_mut().push(fault);
                    }
                    Err(fault) => self.faults.borrow_mut().push(fault),
                }
            }
            Answer::Thing(_) => {}
            other => {
                let kind = self.kind(other);
                return Err(Fault::wrong(format!("{kind} where a picture is wanted")));
            }
        }
        Ok(())
    }

    /// Returns true for what has a picture; the members of a set are parts of something else,
    /// and things of a used text of which nothing speaks are not shown.
    pub(crate) fn may_draw(&self, answer: &Answer<'a>) -> bool {
        match answer {
            Answer::Picture(_) | Answer::List(_) | Answer::Made(_) | Answer::Context(_) => true,
            Answer::Thing(t) => {
                !matches!(self.class_kind(*t), ClassKind::Set(_))
                    && !self.structure.is_unseen(self.document, *t)
            }
            Answer::Number(..)
            | Answer::Bool(_)
            | Answer::Option(..)
            | Answer::Text(_)
            | Answer::Function(_) => false,
        }
    }

    /// Changes how a picture looks.
    pub(crate) fn styled(
        &self,
        message: PictureMessage,
        elements: &Rc<Vec<Element>>,
        arguments: &[Answer<'a>],
    ) -> Result<Answer<'a>> {
        let layer = match (message, arguments.first()) {
            (PictureMessage::OnLayer, Some(Answer::Text(name))) => Some(Arc::from(&**name)),
            _ => None,
        };
        let measured = match (message, arguments) {
            (PictureMessage::Measured, [Answer::Text(kind), points]) => {
                Some(Arc::new(self.dimension(kind, points)?))
            }
            _ => None,
        };
        let turned = match message {
            PictureMessage::Turned => self.number(&arguments[0])?.0,
            _ => 0.0,
        };
        let away = match message {
            PictureMessage::Away => Some(self.place(&arguments[0])?),
            _ => None,
        };
        let color = match message {
            PictureMessage::Colored | PictureMessage::Filled => arguments.first(),
            _ => None,
        };
        let color = color.map(|a| self.color(a)).transpose()?;
        let mut elements = Vec::clone(elements);
        let (surfaces, in_rings) = match message {
            PictureMessage::Filled => self.surrounded(&elements)?,
            _ => Default::default(),
        };
        for (i, element) in elements.iter_mut().enumerate() {
            let style = &mut element.style;
            match message {
                PictureMessage::Dotted => style.line = Line::Dotted,
                PictureMessage::Chained => style.line = Line::Chained,
                PictureMessage::OnLayer => style.sheet_layer.clone_from(&layer),
                PictureMessage::Dashed => style.line = Line::Dashed,
                PictureMessage::Unbounded => style.is_unbounded = true,
                PictureMessage::Faint => style.color = Color::Faint,
                PictureMessage::Accent => style.color = Color::Accent,
                PictureMessage::Thick => style.width = THICK_PIXELS,
                PictureMessage::Colored => style.color = color.clone().unwrap_or_default(),
                // the surface that it surrounds is filled, and it stays a line
                PictureMessage::Filled if in_rings.contains(&i) => {}
                PictureMessage::Filled => {
                    style.fill = Some(color.clone().unwrap_or(Color::Faint));
                    if element.layer == Layer::Lines {
                        element.layer = Layer::Back;
                    }
                }
                PictureMessage::Measured => style.dimension.clone_from(&measured),
                PictureMessage::Turned => {
                    if let Shape::Text { turn, .. } = &mut element.shape {
                        *turn += turned;
                    }
                }
                PictureMessage::Centered => anchor(element, Anchoring::Center),
                // what is measured is no picture
                PictureMessage::Length | PictureMessage::Area | PictureMessage::Nearest => {}
                PictureMessage::Away => {
                    away.into_iter().for_each(|from| anchor(element, Anchoring::Away(from)));
                }
            }
        }
        let surfaces = surfaces.into_iter().map(|mut surface| {
            surface.style.fill = Some(color.clone().unwrap_or(Color::Faint));
            surface
        });
        elements.splice(0..0, surfaces);
        Ok(Answer::Picture(Rc::new(elements)))
    }

    /// Finds what open lines of a picture surround, and the places of these; what a region of the picture covers
    /// is no surface once more. Each piece is a step.
    fn surrounded(&self, elements: &[Element]) -> Result<(Vec<Element>, BTreeSet<usize>)> {
        let pieces = elements.iter().filter(|e| rings::is_piece(e)).count();
        if pieces < 2 {
            return Ok(Default::default());
        }
        if self.is_recording() {
            return Err(Fault::wrong("what lines surround is not noted"));
        }
        self.burn_several(pieces as u64)?;
        let found = rings::rings(elements);
        let in_rings = found.iter().flat_map(|(_, pieces)| pieces).copied().collect();
        let surfaces = found.into_iter().map(|(surface, _)| surface);
        let is_new = |surface: &Element| !elements.iter().any(|e| covers_alike(e, surface));
        Ok((surfaces.filter(is_new).collect(), in_rings))
    }

    /// Reads what a dimension of a drawing measures.
    fn dimension(&self, kind: &str, points: &Answer<'a>) -> Result<Dimensioned> {
        let kind = match kind {
            "aligned" => DimensionKind::Aligned,
            "linear" => DimensionKind::Linear,
            "radius" => DimensionKind::Radius,
            "diameter" => DimensionKind::Diameter,
            "angle" => DimensionKind::Angle,
            other => return Err(Fault::wrong(format!("there is no kind of dimension `{other}`"))),
        };
        let points: Vec<Point> = self.places(std::slice::from_ref(points))?;
        let (wanted, found) = (kind.points(), points.len());
        if wanted != found {
            let message = format!("{found} points, where such a dimension has {wanted}");
            return Err(Fault::wrong(message));
        }
        Ok(Dimensioned { kind, points })
    }

    fn color(&self, answer: &Answer<'a>) -> Result<Color> {
        match answer {
            Answer::Text(name) => Ok(match &**name {
                "ink" => Color::Ink,
                "faint" => Color::Faint,
                "accent" => Color::Accent,
                name => Color::Named(name.into()),
            }),
            other => Err(Fault::wrong(format!("{} where a colour is wanted", self.kind(other)))),
        }
    }
}

/// Returns the rings of the regions in a picture.
fn rings_in(elements: &[Element]) -> Vec<Vec<Corner>> {
    let rings = |e: &Element| match &e.shape {
        Shape::Region(rings) => rings.clone(),
        _ => Vec::new(),
    };
    elements.iter().flat_map(rings).collect()
}

/// Says which point of a text lies at its place.
fn anchor(element: &mut Element, how: Anchoring) {
    if let Shape::Text { anchoring, .. } = &mut element.shape {
        *anchoring = how;
    }
}

/// Returns true for a region with the one ring of another, from whichever corner and whichever way it runs.
fn covers_alike(of: &Element, other: &Element) -> bool {
    let (Shape::Region(rings), Shape::Region(others)) = (&of.shape, &other.shape) else {
        return false;
    };
    let ([ring], [other]) = (rings.as_slice(), others.as_slice()) else { return false };
    let edges = |ring: &[Corner]| -> Vec<(Point, Point, f64)> {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(a, b)| (a.at, b.at, a.bulge)).collect()
    };
    let back = |(from, to, bulge): &(Point, Point, f64)| (*to, *from, -bulge);
    let (own, left) = (edges(ring), edges(other));
    let right: Vec<_> = left.iter().rev().map(back).collect();
    let reach = ring.iter().fold(0.0_f64, |most, c| most.max(c.at.x.abs()).max(c.at.y.abs()));
    let is_near =
        |p: Point, q: Point| (p.x - q.x).abs() <= NEAR * reach && (p.y - q.y).abs() <= NEAR * reach;
    let is_one = |a: &(Point, Point, f64), b: &(Point, Point, f64)| {
        is_near(a.0, b.0) && is_near(a.1, b.1) && (a.2 - b.2).abs() <= NEAR
    };
    own.len() == left.len()
        && [left, right].iter().any(|other| {
            (0..other.len()).any(|first| {
                let turned = other.iter().cycle().skip(first);
                own.iter().zip(turned).all(|(a, b)| is_one(a, b))
            })
        })
}
