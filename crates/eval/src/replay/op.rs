//! Operations: what the interpreter does to numbers, each by itself, so that it can be done again.

use base::number;
use geometry::{Construction, Figure};

/// An operation on one number.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Unary {
    Negate,
    Sqrt,
    Abs,
    Ceil,
    Floor,
    Round,
    Sign,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Exp,
    Ln,
    Log10,
    Log2,
    Sinh,
    Cosh,
    Tanh,
    Asinh,
    Acosh,
    Atanh,
    Cbrt,
}

/// An operation on two numbers.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    Power,
    Min,
    Max,
    Atan2,
    Hypot,
}

impl Unary {
    /// Computes it.
    pub(crate) fn apply(self, x: f64) -> f64 {
        match self {
            Self::Negate => 0.0 - x,
            Self::Sqrt => number::sqrt(x),
            Self::Abs => x.abs(),
            Self::Ceil => 0.0 - (0.0 - x).floor(),
            Self::Floor => x.floor(),
            Self::Round => x.round(),
            Self::Sign => f64::from(u8::from(x > 0.0)) - f64::from(u8::from(x < 0.0)),
            Self::Sin => number::sin(x),
            Self::Cos => number::cos(x),
            Self::Tan => number::tan(x),
            Self::Asin => number::asin(x),
            Self::Acos => number::acos(x),
            Self::Atan => number::atan(x),
            Self::Exp => number::exp(x),
            Self::Ln => number::ln(x),
            Self::Log10 => number::log10(x),
            Self::Log2 => number::log2(x),
            Self::Sinh => number::sinh(x),
            Self::Cosh => number::cosh(x),
            Self::Tanh => number::tanh(x),
            Self::Asinh => number::asinh(x),
            Self::Acosh => number::acosh(x),
            Self::Atanh => number::atanh(x),
            Self::Cbrt => number::cbrt(x),
        }
    }
}

impl Binary {
    /// Computes it.
    pub(crate) fn apply(self, x: f64, y: f64) -> f64 {
        match self {
            Self::Add => x + y,
            Self::Subtract => x - y,
            Self::Multiply => x * y,
            Self::Divide => x / y,
            Self::Remainder => x - y * (x / y).floor(),
            Self::Power => power(x, y),
            Self::Min => f64::min(x, y),
            Self::Max => f64::max(x, y),
            Self::Atan2 => number::atan2(x, y),
            Self::Hypot => number::sqrt(x * x + y * y),
        }
    }
}

/// Computes a power; small whole exponents by multiplication, so that squares are exact.
fn power(x: f64, y: f64) -> f64 {
    if y == 2.0 {
        x * x
    } else if y == 1.0 {
        x
    } else {
        number::pow(x, y)
    }
}

/// What a figure is that a construction takes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Taken {
    Point,
    Straight,
    Circle,
}

impl Taken {
    /// Returns what a figure is; nothing for an arc, which is taken as its circle.
    pub(crate) fn of<N>(figure: &Figure<N>) -> Option<Self> {
        match figure {
            Figure::Point(_) => Some(Self::Point),
            Figure::Straight { .. } => Some(Self::Straight),
            Figure::Circle { .. } => Some(Self::Circle),
            Figure::Arc { .. } => None,
        }
    }
    /// Reads a figure of this kind from numbers in order.
    fn figure(self, next: &mut impl FnMut() -> f64) -> Figure<f64> {
        let mut place = || [next(), next()];
        match self {
            Self::Point => Figure::Point(place()),
            Self::Straight => Figure::Straight { from: place(), to: place() },
            Self::Circle => Figure::Circle { center: place(), radius: next() },
        }
    }
}

/// A construction of what stands in registers.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Constructed {
    pub(crate) what: Construction,
    /// The figures that it takes.
    pub(crate) figures: Box<[Taken]>,
    /// The registers of these, number by number, then those of the numbers that it takes.
    pub(crate) of: Box<[u32]>,
}

impl Constructed {
    /// So many figures and numbers a construction takes at most.
    const MOST: usize = 3;

    /// Computes it; nothing where it has no answer.
    pub(crate) fn compute(&self, registers: &[f64]) -> Option<Figure<f64>> {
        let mut at = self.of.iter();
        let mut next = || at.next().map_or(f64::NAN, |&r| registers[r as usize]);
        let mut figures = [Figure::Point([0.0; 2]); Self::MOST];
        for (figure, taken) in figures.iter_mut().zip(&self.figures) {
            *figure = taken.figure(&mut next);
        }
        let mut numbers = [0.0; Self::MOST];
        let count = self.what.takes().1.min(Self::MOST);
        numbers[..count].iter_mut().for_each(|x| *x = next());
        let figures = figures.get(..self.figures.len())?;
        geometry::construct(self.what, figures, &numbers[..count]).ok()
    }
}
