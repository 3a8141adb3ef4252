//! Curves among what was noted: the smooth curve through places, and what is measured of lines.
//!
//! In: shapes whose numbers are marked. Out: numbers in the next registers, as many as in the run that was noted.

use super::record::{Recorder, place_of};
use super::routine::Op;
use drawing::{Point, Shape, measure, spline};
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
