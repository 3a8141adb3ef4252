//! Curves among what was noted: the smooth curve through places, what is measured of lines, and rings along them.
//!
//! In: shapes whose numbers are marked. Out: numbers in the next registers, as many as in the run that was noted.

use super::record::{Recorder, place_of};
use super::routine::Op;
use drawing::{Corner, Point, Shape, curve, measure, spline};
use geometry::{NoContour, Side};
use std::cmp::Ordering;
use std::rc::Rc;

/// What is made of lines.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Measure {
    /// How long they are.
    Length,
    /// How much they surround.
    Area,
    /// Their place that is nearest to a point, which stands behind them as a dot.
    Nearest,
    /// The poles of the smooth curve through places.
    Through,
    /// An ellipse from its centre, one end and how far it reaches across: these stand in the place of its numbers.
    Ellipse,
    /// Where each begins and ends.
    Ends,
    /// In which order they follow one another: the number of each, and whether it runs back.
    Order,
    /// The ring along lines that follow one another: of each corner its place and bulge, whether a Bézier curve leaves
    /// it, and the poles of that.
    Ring,
}

/// How many numbers a corner of a ring is.
const CORNER: usize = 8;

/// Returns in which order lines follow one another, each with whether it runs back.
pub(crate) fn order_of_lines(lines: &[Shape]) -> Result<Vec<(usize, bool)>, NoContour> {
    let ends = lines.iter().map(|line| curve::ends(line).unwrap_or_default());
    let side = |[p, q]: [Point; 2]| Side { from: [p.x, p.y], to: [q.x, q.y], bulge: 0.0 };
    let sides: Vec<Side> = ends.map(side).collect();
    match (&sides[..], curve::ring_along(lines)) {
        // one that comes back to where it began
        ([only], Some(ring)) if closes(only, &ring) => Ok(vec![(0, false)]),
        _ => geometry::order(&sides),
    }
}

/// Whether a line ends where it began: as a part of how far its corners lie apart.
fn closes(line: &Side, ring: &[Corner]) -> bool {
    let reach = |of: fn(&Corner) -> f64| {
        let all = || ring.iter().map(of);
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    };
    let extent = reach(|c| c.at.x).max(reach(|c| c.at.y));
    ring.len() > 1 && extent > 0.0 && geometry::meets(line.from, line.to, extent)
}

fn numbers_of_corner(corner: Corner) -> [f64; CORNER] {
    let [p, q] = corner.poles.unwrap_or_default();
    let is_curve = f64::from(u8::from(corner.poles.is_some()));
    [corner.at.x, corner.at.y, corner.bulge, is_curve, p.x, p.y, q.x, q.y]
}

/// Returns the corners of a ring from their numbers; `fixed` says what a number is, once and for all.
pub(crate) fn corners(numbers: &[f64], fixed: impl Fn(f64) -> f64) -> Vec<Corner> {
    let (all, _) = numbers.as_chunks::<CORNER>();
    let one = |&[x, y, bulge, is_curve, px, py, qx, qy]: &[f64; CORNER]| Corner {
        at: Point { x, y },
        bulge,
        poles: (fixed(is_curve) != 0.0).then_some([Point { x: px, y: py }, Point { x: qx, y: qy }]),
    };
    all.iter().map(one).collect()
}

impl Measure {
    /// Computes it.
    ///
    /// # Errors
    /// There is none, with the reason.
    pub(crate) fn of(self, shapes: &[Shape]) -> Result<Vec<f64>, &'static str> {
        const NONE: &str = "the picture has no lines";
        let numbers = |p: Point| vec![p.x, p.y];
        match self {
            Self::Length => measure::length(shapes).map(|x| vec![x]).ok_or(NONE),
            Self::Area => measure::area(shapes).map(|x| vec![x]),
            Self::Nearest => match shapes {
                [lines @ .., Shape::Dot(to)] => {
                    measure::nearest(lines, *to).map(numbers).ok_or(NONE)
                }
                _ => Err(NONE),
            },
            Self::Through => match shapes {
                [Shape::Spline(places)] => {
                    Ok(spline::through(places).into_iter().flat_map(numbers).collect())
                }
                _ => Err(NONE),
            },
            Self::Ellipse => match *shapes {
                [Shape::Ellipse { center, major: end, ratio: across, start, sweep }] => {
                    let major = Point { x: end.x - center.x, y: end.y - center.y };
                    let mut made = Vec::new();
                    let mut ellipse = curve::ellipse(center, major, across, start, sweep);
                    ellipse.each_number(&mut |x| made.push(*x));
                    Ok(made)
                }
                _ => Err(NONE),
            },
            Self::Ends => {
                let ends = shapes.iter().map(|line| curve::ends(line).ok_or(NONE));
                let ends = ends.collect::<Result<Vec<_>, _>>()?;
                Ok(ends.into_iter().flatten().flat_map(numbers).collect())
            }
            Self::Order => {
                let order = order_of_lines(shapes).map_err(|_| "the lines are no contour")?;
                let pair = |(i, is_back): (usize, bool)| [i as f64, f64::from(u8::from(is_back))];
                Ok(order.into_iter().flat_map(pair).collect())
            }
            Self::Ring => {
                let ring = curve::ring_along(shapes).ok_or("no ring goes along these")?;
                Ok(ring.into_iter().flat_map(numbers_of_corner).collect())
            }
        }
    }
}

/// What was made of lines, once in a run.
#[derive(Clone, Debug)]
pub(crate) struct Curved {
    what: Measure,
    /// The shapes, their numbers marked.
    shapes: Rc<[Shape]>,
    /// So many numbers come of it.
    count: usize,
    /// Which note of its run it is: the same measure of the same lines is taken twice.
    serial: usize,
}

impl PartialEq for Curved {
    fn eq(&self, other: &Self) -> bool {
        self.serial == other.serial
    }
}
impl Eq for Curved {}
impl PartialOrd for Curved {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Curved {
    fn cmp(&self, other: &Self) -> Ordering {
        self.serial.cmp(&other.serial)
    }
}

impl Curved {
    /// Computes it; nothing where there is none, or where it has more numbers or fewer.
    pub(crate) fn compute(&self, registers: &[f64]) -> Option<Vec<f64>> {
        let at = |x: f64| place_of(x).map_or(x, |place| registers[place as usize]);
        let made = self.what.of(&with_numbers(&self.shapes, at)).ok()?;
        (made.len() == self.count).then_some(made)
    }
}

impl Recorder {
    /// Makes something of lines, and notes that.
    pub(crate) fn measure(
        &mut self,
        what: Measure,
        shapes: &[Shape],
    ) -> Result<Vec<f64>, &'static str> {
        let mut is_marked = false;
        let plain = with_numbers(shapes, |x| {
            is_marked |= place_of(x).is_some();
            self.value(x)
        });
        let made = what.of(&plain)?;
        if !is_marked {
            return Ok(made);
        }
        let count = made.len();
        if self.is_full() {
            return Ok(vec![f64::NAN; count]);
        }
        let curved = Curved { what, shapes: shapes.into(), count, serial: self.notes.len() };
        let first = self.several(Op::Curve(Box::new(curved)), |registers| registers.extend(made));
        Ok((first..).take(count).map(Self::marked).collect())
    }
}

/// Returns shapes with other numbers.
fn with_numbers(shapes: &[Shape], mut of: impl FnMut(f64) -> f64) -> Vec<Shape> {
    let mut shapes = shapes.to_vec();
    shapes.iter_mut().for_each(|shape| shape.each_number(&mut |x| *x = of(*x)));
    shapes
}
