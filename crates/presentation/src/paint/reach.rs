//! How much is shown of lines without ends.

use drawing::{Drawing, Point, Shape};

/// How far lines without ends are shown: as far around the middle of a picture as one is likely to look.
pub(super) struct Reach {
    middle: Point,
    length: f64,
}

/// The next power of two above a positive number.
fn power_of_two_above(x: f64) -> f64 {
    const MANTISSA_BITS: u32 = 52;
    f64::from_bits(((x.to_bits() >> MANTISSA_BITS) + 1) << MANTISSA_BITS)
}

impl Reach {
    pub(super) fn of(picture: &Drawing) -> Self {
        /// Where there is nothing else to go by, in units of the sheet.
        const ALONE: f64 = 2000.0;
        /// So many times as far as the picture is wide and high.
        const TIMES: f64 = 4.0;
        let ends = picture.elements.iter().filter(|e| !e.style.is_unbounded);
        match drawing::bounds_of(ends, picture.vertical) {
            // a picture that grows by a little shows them as they were
            Some(b) if b.most != b.least => {
                let length =
                    TIMES * power_of_two_above(b.most.x - b.least.x + b.most.y - b.least.y);
                let step = length / 32.0;
                let middle = |a, b| (f64::midpoint(a, b) / step).round() * step;
                let (x, y) = (middle(b.least.x, b.most.x), middle(b.least.y, b.most.y));
                Self { middle: Point { x, y }, length }
            }
            _ => Self { middle: Point::default(), length: ALONE },
        }
    }

    /// What is shown of a line without ends; nothing where it has no direction.
    pub(super) fn across(&self, (a, b): (Point, Point)) -> Option<Shape> {
        let (dx, dy) = (b.x - a.x, b.y - a.y);
        let length = base::number::hypot(dx, dy);
        if length <= 0.0 {
            return None;
        }
        let (ux, uy) = (dx / length, dy / length);
        let along = (self.middle.x - a.x) * ux + (self.middle.y - a.y) * uy;
        let at = |t: f64| Point { x: a.x + t * ux, y: a.y + t * uy };
        Some(Shape::Segment(at(along - self.length), at(along + self.length)))
    }
}
