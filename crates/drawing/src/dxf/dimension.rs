//! Dimensions: what is drawn of each is a block of its own, and the entity names it and what it measures.

use super::Writer;
use super::blocks::Block;
use crate::element::{Dimension, DimensionKind, Point, Shape};
use base::number::{atan2, hypot};

impl Writer {
    /// Writes a dimension's entity.
    pub(super) fn dimension(&mut self, of: &Dimension, block: &Block<'_>) {
        let Some(&first) = block.elements.first() else { return };
        let points = &of.points;
        let words = block.elements.iter().find_map(|e| match &e.shape {
            Shape::Text { at, .. } => Some(*at),
            _ => None,
        });
        let kind = of.kind;
        // what it is, that its block is its own, and that its words stand where they were put
        let (code, defining) = match kind {
            DimensionKind::Linear => (0, points[2]),
            DimensionKind::Aligned => (1, points[2]),
            DimensionKind::Angle => (2, points[3]),
            DimensionKind::Diameter => (3, points[0]),
            DimensionKind::Radius => (4, points[0]),
        };
        self.begin("DIMENSION", "AcDbDimension", first);
        self.pair(2, &block.name);
        self.at(10, defining);
        self.at(11, words.unwrap_or(defining));
        self.pair(70, code + 32 + 128);
        self.pair(71, 5);
        self.pair(3, "Standard");
        match kind {
            DimensionKind::Aligned | DimensionKind::Linear => {
                self.pair(100, "AcDbAlignedDimension");
                self.at(13, points[0]);
                self.at(14, points[1]);
                if kind == DimensionKind::Linear {
                    self.real(50, self.slope(points[3], points[2]));
                    self.pair(100, "AcDbRotatedDimension");
                }
            }
            DimensionKind::Radius | DimensionKind::Diameter => {
                let class = match kind {
                    DimensionKind::Radius => "AcDbRadialDimension",
                    _ => "AcDbDiametricDimension",
                };
                self.pair(100, class);
                self.at(15, points[1]);
                self.real(40, 0.0);
            }
            DimensionKind::Angle => {
                self.pair(100, "AcDb2LineAngularDimension");
                self.at(13, points[0]);
                self.at(14, points[1]);
                self.at(15, points[2]);
                self.at(16, points[4]);
            }
        }
    }

    /// Returns how a line is turned from the right, in degrees from 0 to 180.
    fn slope(&self, from: Point, to: Point) -> f64 {
        let (x, y) = (to.x - from.x, self.sign * (to.y - from.y));
        // a line along an axis is along it, whatever was rounded
        let length = hypot(x, y);
        if y.abs() <= 1e-12 * length {
            return 0.0;
        }
        if x.abs() <= 1e-12 * length {
            return 90.0;
        }
        super::degrees(atan2(y, x)) % 180.0
    }
}
